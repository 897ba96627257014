//! Exact derivatives of a deflection and of all that leads to it, by the implicit function theorem.
//!
//! The theorem is applied to the equations of the inverse model, of the set-points and of both equilibria.
//!
//! Cables answer to their inputs by (D1)-(D4) of `equations/partials.rs`.
//!
//! **Inverse model.** With `v_i = dF_i/dt_i` at held ends, the multipliers `λ = (λ_p, λ_r)` of the balance
//! make a twist that moves anchor point A_i by `μ_i = λ_p + λ_r x s_i`. Tensions without active bound and
//! the balance of the platform are equation (I2) of `inverse.rs` and Eq. (3),
//!
//! ```text
//! ρ_i = t_i - r_i + v_i·μ_i = 0,      G = sum [F_i; s_i x F_i] + w_ex = 0                         (D5)
//! ```
//!
//! Differentiated, with `c_i = [v_i; s_i x v_i]`, `D_i = 1 + μ_i·dv_i/dt_i` and partial derivatives ∂ at
//! constant t and λ,
//!
//! ```text
//! dt_i = -( ∂ρ_i + c_i·dλ )/D_i,      ∂ρ_i = μ_i·∂v_i + v_i·(λ_r x ∂s_i)                (D6)
//! [ sum_free c_i c_iᵀ/D_i ] dλ = ∂G - sum_free c_i ∂ρ_i/D_i + sum_active c_i dt_i
//! ```
//!
//! The derivatives of v_i are second derivatives of the catenary (`cdpr_cable::TensionSlope`).
//!
//! **Active bounds stay active** while their multipliers are not zero. On limits at the platform `dt_i = 0`.
//! A cable whose weight demands more rests on a constant, a = 1.001, times the least tension over its
//! span. That least tension, a minimum over the length, changes as if the length at which it is taken were
//! held: `dt_i = a u·(-K3 dr + k_ρ dρ + k_E dE)` of that catenary. A greatest tension T0 at the
//! exit point leaves t at the platform, which (C26) of `cdpr_cable` relates: `(1 + ε(t)) dt = w dz + z dw +
//! (1/EA ∫ ε) dEA` with the integral over the tension from T0 to t.
//!
//! **Set-points** are `t_i + dt_i`, or the bounds above where it is beyond them: then the offset changes
//! nothing.
//!
//! **Two sides.** Where a bound is left when an input grows and kept when it falls, or the other way round,
//! the right and the left derivative differ: `derivatives/optimum.rs` and `winding.rs`. An offset of a cable
//! on its bound is such an input.
//!
//! **Lengths** follow from (D1) at the set-points:
//!
//! ```text
//! dL_i = ( dt_i - u_i·∂F_i )/(u_i·k_L)                                                            (D7)
//! ```
//!
//! **Equilibria.** With `∂G/∂(p, φ)`, minus the stiffness of the platform,
//!
//! ```text
//! ∂G/∂(p, φ) d(p, φ) = -∂G - sum [k_L; s x k_L] dL_i,
//! dt_i = u_i·( ∂F_i - K3_i (dp + dφ x s_i) + k_L dL_i )                                           (D8)
//! ```
//!
//! Nothing larger than 6 x 6 is factored: the cables are eliminated, as in Newton's method of the direct
//! model.

mod optimum;
mod rest;
mod softest;
mod winding;

pub use crate::equations::Inputs;
use crate::equations::{CableDerivatives, Partials, Pins, Reading, read, solve};
use crate::error::StaticsError;
use crate::inverse::{Branch, InverseSolution, require_smooth};
use crate::loading::{Deflection, Wound, deflection_from, wind, wind_free, wind_from, wind_near};
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Load, Wanted, WantedPose, one_by_one};
use cdpr_robot::{CableEnd, Matrix6xX, Pose, Robot, Vector3};
use nalgebra::{DMatrix, Matrix3xX};
pub use optimum::AtBound;
use rest::Rest;
use softest::AtRest;
pub use winding::OneSided;
use winding::{SetPoints, Winding};

/// A deflection with its derivatives. Each matrix has a column for every input ([`Inputs`]): the parameters
/// of the robot, the payload, the wanted pose.
///
/// The columns of inputs in `one_sided` hold the left derivatives, as the input falls; [`Derivatives::right`]
/// has the right ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Derivatives {
    /// The deflection that is differentiated.
    pub deflection: Deflection,
    /// What the columns stand for.
    pub inputs: Inputs,
    /// Derivatives of the tension set-points, offsets included, n x count [N per unit].
    pub set_points: DMatrix<f64>,
    /// Derivatives of the unstrained lengths, n x count [m per unit].
    pub lengths: DMatrix<f64>,
    /// Derivatives of the equilibrium under the platform's own weight.
    pub unloaded: EquilibriumDerivatives,
    /// Derivatives of the equilibrium with the load added.
    pub loaded: EquilibriumDerivatives,
    /// The inputs whose left and right derivatives differ, because a cable leaves a bound on one side.
    pub one_sided: Vec<OneSided>,
    /// By how much the right derivatives exceed the left ones, a column for each of `one_sided`.
    excess: Box<Excess>,
}

#[derive(Clone, Debug, PartialEq)]
struct Excess {
    set_points: DMatrix<f64>,
    lengths: DMatrix<f64>,
    unloaded: EquilibriumDerivatives,
    loaded: EquilibriumDerivatives,
}

/// Derivatives of an equilibrium; columns as in [`Derivatives`].
#[derive(Clone, Debug, PartialEq)]
pub struct EquilibriumDerivatives {
    /// Derivatives of the pose: (dp, dφ) in the base frame, `R <- exp(dφ) R`, 6 x count [m, rad per unit].
    pub pose: Matrix6xX<f64>,
    /// Derivatives of the tensions at the platform, n x count [N per unit].
    pub tensions: DMatrix<f64>,
}

/// The deflection at a wanted pose, or at each of many, as [`crate::deflection`] gives it, with its
/// derivatives.
///
/// Where a bound is left on one side of an input, left and right derivatives differ: [`OneSided`]. With free
/// coordinates set-points do not come from a distribution of tensions but from the rest of the platform, and
/// no derivative has two sides.
///
/// ```
/// use cdpr_robot::{Parameter, Pose, Robot};
/// use cdpr_statics::{Load, derivatives};
///
/// let robot = Robot::from_json(include_str!("../../../data/robots/caroca.json"))?;
/// let found = derivatives(&robot, &Pose::at(0.0, 0.0, 1.75), &Load::payload(50.0))?;
/// let modulus = found.inputs.column(Parameter::YoungsModulus);
/// let magnitude = found.magnitude()?; // [m per SI unit]
/// assert!(modulus.is_some_and(|column| (1e12 * magnitude[column] + 0.01289).abs() < 1e-5)); // [mm/GPa]
/// # Ok::<(), cdpr_statics::StaticsError>(())
/// ```
///
/// # Errors
/// Those of [`crate::deflection`]; [`StaticsError::NoDerivative`] where an equilibrium or the tension
/// distribution is at the border of its existence, and with free coordinates for an offset set-point that a
/// limit keeps; [`StaticsError::Invalid`] for the least 1-norm and infinity-norm of the tensions, which jump
/// from pose to pose.
pub fn derivatives<W: Wanted>(
    robot: &Robot,
    wanted: W,
    load: &Load,
) -> W::Answers<Result<Derivatives, StaticsError>> {
    one_by_one(wanted, |wanted| {
        let offsets = wanted.offsets_of(robot);
        if !wanted.free.is_empty() {
            return with_free(robot, wanted, &offsets, load);
        }
        of_wound(robot, wanted, &offsets, load, &wind(robot, wanted, &offsets)?)
    })
}

/// [`derivatives`] without offsets, with the answer of the inverse model under the platform's own weight at
/// hand.
///
/// # Errors
/// As [`derivatives`].
pub fn derivatives_from(
    robot: &Robot,
    pose: &Pose,
    load: &Load,
    wanted: InverseSolution,
) -> Result<Derivatives, StaticsError> {
    let offsets = vec![0.0; robot.cables.len()];
    let wound = wind_from(robot, pose, &offsets, wanted)?;
    of_wound(robot, &WantedPose::at(pose), &offsets, load, &wound)
}

/// [`derivatives`] of a robot that differs a little from the one whose inverse model is known.
///
/// # Errors
/// Those of [`derivatives`].
pub(crate) fn derivatives_near(
    branch: &Branch,
    robot: &Robot,
    pose: &Pose,
    tension_offsets: &[f64],
    load: &Load,
) -> Result<Derivatives, StaticsError> {
    let wound = wind_near(branch, robot, pose, tension_offsets)?;
    of_wound(robot, &WantedPose::at(pose), tension_offsets, load, &wound)
}

/// The derivatives of the deflection of cables that are wound.
fn of_wound(
    robot: &Robot,
    wanted: &WantedPose,
    tension_offsets: &[f64],
    load: &Load,
    wound: &Wound,
) -> Result<Derivatives, StaticsError> {
    require_smooth(robot)?;
    let deflection = deflection_from(robot, wound.lengths.clone(), load, &wound.held)?;
    let WantedPose { pose, tension_reference, .. } = wanted;
    let winding = Winding { robot, pose, reference: *tension_reference, inputs: Inputs::of(robot), wound };
    let set_points = winding.set_points(tension_offsets)?;
    let lengths = winding.lengths(&set_points.rows)?;
    of_lengths(robot, load, deflection, winding.inputs, set_points, lengths)
}

/// The derivatives of the deflection of a robot with free coordinates.
fn with_free(
    robot: &Robot,
    wanted: &WantedPose,
    tension_offsets: &[f64],
    load: &Load,
) -> Result<Derivatives, StaticsError> {
    let (unmoved, wound) = wind_free(robot, wanted, tension_offsets)?;
    let deflection = deflection_from(robot, wound.lengths.clone(), load, &wound.equilibrium)?;
    let inputs = Inputs::of(robot);
    let WantedPose { pose, free, .. } = wanted;
    let rest = Rest { robot, wanted: pose, free, inputs: &inputs, unmoved: &unmoved, wound: &wound };
    let (rows, lengths) = rest.slopes(tension_offsets)?;
    of_lengths(robot, load, deflection, inputs, SetPoints { rows, one_sided: Vec::new() }, lengths)
}

/// The derivatives of a deflection from those of its set-points and lengths.
fn of_lengths(
    robot: &Robot,
    load: &Load,
    deflection: Deflection,
    inputs: Inputs,
    SetPoints { rows: mut set_points, one_sided }: SetPoints,
    mut lengths: DMatrix<f64>,
) -> Result<Derivatives, StaticsError> {
    let at = |load: &Load, equilibrium| {
        let problem = DirectProblem::new(robot, &deflection.lengths, load)?;
        EquilibriumDerivatives::new(&problem, &inputs, equilibrium, Some(&lengths))
    };
    let mut unloaded = at(&Load::none(), &deflection.unloaded.equilibrium)?;
    let mut loaded = at(load, &deflection.loaded.equilibrium)?;
    unloaded.pose.column_mut(inputs.payload()).fill(0.0);
    unloaded.tensions.column_mut(inputs.payload()).fill(0.0);
    let count = inputs.count();
    let excess = Box::new(Excess {
        set_points: split_off(&mut set_points, count),
        lengths: split_off(&mut lengths, count),
        unloaded: unloaded.split_off(count),
        loaded: loaded.split_off(count),
    });
    Ok(Derivatives { deflection, inputs, set_points, lengths, unloaded, loaded, one_sided, excess })
}

fn add<'a>(sum: impl Iterator<Item = &'a mut f64>, more: impl Iterator<Item = &'a f64>) {
    sum.zip(more).for_each(|(sum, more)| *sum += more);
}

/// The columns from `count` on, which the matrix loses.
fn split_off(matrix: &mut DMatrix<f64>, count: usize) -> DMatrix<f64> {
    let last = matrix.columns(count, matrix.ncols() - count).into_owned();
    if last.ncols() > 0 {
        matrix.resize_horizontally_mut(count, 0.0);
    }
    last
}

impl Derivatives {
    /// The right derivatives: those of every input as it grows, with an empty `one_sided`. They differ from
    /// the left ones in the columns of the inputs in `one_sided`.
    pub fn right(&self) -> Self {
        let mut right = self.clone();
        let Excess { set_points, lengths, unloaded, loaded } = &*self.excess;
        for (k, OneSided { column, .. }) in self.one_sided.iter().enumerate() {
            add(right.set_points.column_mut(*column).iter_mut(), set_points.column(k).iter());
            add(right.lengths.column_mut(*column).iter_mut(), lengths.column(k).iter());
            for (at, more) in [(&mut right.unloaded, unloaded), (&mut right.loaded, loaded)] {
                add(at.pose.column_mut(*column).iter_mut(), more.pose.column(k).iter());
                add(at.tensions.column_mut(*column).iter_mut(), more.tensions.column(k).iter());
            }
        }
        right.one_sided.clear();
        right
    }

    /// Derivatives of the deflection dp, 3 x count [m per unit].
    pub fn displacement(&self) -> Matrix3xX<f64> {
        self.loaded.pose.fixed_rows::<3>(0) - self.unloaded.pose.fixed_rows::<3>(0)
    }

    /// Derivatives of |dp| [m per unit], one for each input: `(dp/|dp|)·d(dp)`.
    ///
    /// # Errors
    /// [`StaticsError::NoDerivative`] where |dp| is so small that rounding decides its direction: a norm has
    /// no derivative at zero.
    pub fn magnitude(&self) -> Result<Vec<f64>, StaticsError> {
        let dp = self.deflection.displacement();
        let size = self.deflection.lengths.iter().fold(0.0, |size: f64, length| size.max(*length));
        if dp.norm() <= 1e-12 * size {
            let reason = "the load does not displace the platform";
            return Err(StaticsError::NoDerivative { quantity: "the norm of the deflection", reason });
        }
        Ok((dp.normalize().transpose() * self.displacement()).as_slice().to_vec())
    }

    /// The lowest natural frequency [Hz] of `robot` under `load`, those of these derivatives, and its
    /// derivatives [Hz per unit], one for each input: see [`DirectProblem::lowest_frequency`].
    ///
    /// # Errors
    /// Those of [`DirectProblem::modes`]; [`StaticsError::NoDerivative`] where two motions have the lowest
    /// frequency or nothing resists any, and for a cable that hangs folded without width.
    pub fn frequency(&self, robot: &Robot, load: &Load) -> Result<(f64, Vec<f64>), StaticsError> {
        self.at_rest(robot, load).frequency()
    }

    /// The lowest stiffness [N/m] of `robot` under `load`, those of these derivatives, and its derivatives
    /// [N/m per unit], one for each input: see [`crate::Stability::least_stiffness`]. The characteristic length
    /// is that of `robot`, a constant.
    ///
    /// # Errors
    /// [`StaticsError::NoDerivative`] where two motions have the lowest stiffness or nothing resists any, and
    /// for a cable that hangs folded without width.
    pub fn least_stiffness(&self, robot: &Robot, load: &Load) -> Result<(f64, Vec<f64>), StaticsError> {
        self.least_stiffness_with(robot, load, self.deflection.loaded.stability.characteristic_length())
    }

    /// As [`Derivatives::least_stiffness`], with another characteristic length ℓ [m]: that of the nominal robot
    /// for one that deviates from it.
    ///
    /// # Errors
    /// As [`Derivatives::least_stiffness`].
    pub fn least_stiffness_with(
        &self,
        robot: &Robot,
        load: &Load,
        characteristic_length: f64,
    ) -> Result<(f64, Vec<f64>), StaticsError> {
        self.at_rest(robot, load).least_stiffness(characteristic_length)
    }

    fn at_rest<'a>(&'a self, robot: &'a Robot, load: &'a Load) -> AtRest<'a> {
        let Deflection { loaded: found, lengths, .. } = &self.deflection;
        let (length_slopes, pose_slopes) = (&self.lengths, &self.loaded.pose);
        AtRest { robot, load, inputs: &self.inputs, found, lengths, length_slopes, pose_slopes }
    }
}

impl DirectProblem<'_> {
    /// Derivatives of an equilibrium for *given* lengths, which do not change with the parameters: neither
    /// tension offsets nor the wanted pose matter. Along held motions and those that nothing resists they are
    /// zero.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] unless the equilibrium is finite and has one force for each cable;
    /// [`StaticsError::NoDerivative`] at the border of stability.
    pub fn derivatives(&self, equilibrium: &Equilibrium) -> Result<EquilibriumDerivatives, StaticsError> {
        self.check("equilibrium", equilibrium)?;
        EquilibriumDerivatives::new(self, &Inputs::of(self.robot), equilibrium, None)
    }
}

/// Derivatives of an equilibrium by all inputs and by the unstrained length of every cable.
///
/// Each matrix has the columns of [`Inputs`] followed by one for each length. A length changes alone; so does
/// an input, while all lengths stay the same.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceDerivatives {
    /// Derivatives of the pose: (dp, dφ) in the base frame, `R <- exp(dφ) R` [m, rad per unit].
    pub pose: Matrix6xX<f64>,
    /// Force with which each cable pulls at that end, in the base frame [N]: on the platform, or on its
    /// guide.
    pub forces: Vec<Vector3<f64>>,
    /// Derivatives of these forces, rows 3i to 3i + 2 for cable i [N per unit].
    pub per_input: DMatrix<f64>,
}

impl DirectProblem<'_> {
    /// Derivatives of an equilibrium, with those by the lengths and with the forces at an end of the cables
    /// as vectors: what measurements of any kind are compared with.
    ///
    /// # Errors
    /// As [`DirectProblem::derivatives`].
    pub fn force_derivatives(
        &self,
        equilibrium: &Equilibrium,
        end: CableEnd,
    ) -> Result<ForceDerivatives, StaticsError> {
        self.check("equilibrium", equilibrium)?;
        let inputs = Inputs::of(self.robot);
        let (n, count) = (self.cables(), inputs.count());
        let mut lengths = DMatrix::zeros(n, count + n);
        (0..n).for_each(|i| lengths[(i, count + i)] = 1.0);
        let pose = EquilibriumDerivatives::new(self, &inputs, equilibrium, Some(&lengths))?.pose;
        let mut cables = CableDerivatives::all(self, &equilibrium.pose, &equilibrium.cable_forces);
        if end == CableEnd::Exit {
            for (i, force) in equilibrium.cable_forces.iter().enumerate() {
                cables[i] = cables[i].of_pull(self.robot, &equilibrium.pose, i, &self.catenary(i, *force));
            }
        }
        let mut per_input = DMatrix::zeros(3 * n, count + n);
        let columns = inputs.pose();
        for (axis, unit) in [Vector3::x(), Vector3::y(), Vector3::z()].into_iter().enumerate() {
            let along = |_: &CableDerivatives| Reading { per_force: unit, per_arm: Vector3::zeros() };
            let mut at_rest = read(&inputs, &equilibrium.pose, &cables, along);
            let per_motion = at_rest.columns(columns.start, 6).into_owned();
            at_rest.columns_mut(columns.start, 6).fill(0.0);
            let moved = per_motion * &pose;
            for (i, cable) in cables.iter().enumerate() {
                let mut row = per_input.row_mut(3 * i + axis);
                row += moved.row(i);
                let mut of_inputs = row.columns_mut(0, count);
                of_inputs += at_rest.row(i);
                row[count + i] += cable.per_actuation[axis];
            }
        }
        Ok(ForceDerivatives { pose, forces: cables.iter().map(|cable| cable.force).collect(), per_input })
    }
}

impl EquilibriumDerivatives {
    /// Equation (D8), for lengths with the derivatives `winding`.
    fn new(
        problem: &DirectProblem,
        inputs: &Inputs,
        equilibrium: &Equilibrium,
        winding: Option<&DMatrix<f64>>,
    ) -> Result<Self, StaticsError> {
        let Equilibrium { pose, cable_forces } = equilibrium;
        let cables = CableDerivatives::all(problem, pose, cable_forces);
        let mut partials =
            Partials::new(problem.robot, inputs, pose, &problem.load, &cables, Reading::tension);
        let (hessian, tensions_per_motion) = partials.take_pose(inputs);
        let pins = Pins::new(problem, equilibrium, &(-0.5 * (hessian + hessian.transpose())));
        let Partials { mut balance, readings: mut tensions } = partials;
        if let Some(winding) = winding {
            if winding.ncols() > inputs.count() {
                balance.resize_horizontally_mut(winding.ncols(), 0.0);
                tensions.resize_horizontally_mut(winding.ncols(), 0.0);
            }
            let per_actuation: Vec<_> = cables.iter().map(CableDerivatives::wrench_per_actuation).collect();
            balance.gemm(1.0, &Matrix6xX::from_columns(&per_actuation), winding, 1.0);
            for (i, cable) in cables.iter().enumerate() {
                let mut row = tensions.row_mut(i);
                row += winding.row(i) * cable.direction.dot(&cable.per_actuation);
            }
        }
        balance.neg_mut();
        pins.take(&mut balance);
        solve(pins.pinned(&hessian, -1.0), &mut balance, "the equilibrium")?;
        tensions.gemm(1.0, &tensions_per_motion, &balance, 1.0);
        Ok(Self { pose: balance, tensions })
    }

    /// The columns from `count` on, which the derivatives lose.
    fn split_off(&mut self, count: usize) -> Self {
        let last = self.pose.columns(count, self.pose.ncols() - count).into_owned();
        if last.ncols() > 0 {
            self.pose.resize_horizontally_mut(count, 0.0);
        }
        Self { pose: last, tensions: split_off(&mut self.tensions, count) }
    }
}
