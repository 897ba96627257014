//! Exact derivatives of a deflection and of all that leads to it, by the implicit function theorem.
//!
//! The theorem is applied to the equations of the inverse model, of the set-points and of both equilibria.
//!
//! Cables respond to their inputs by (D1)-(D4) of `equations/partials.rs`.
//!
//! **Inverse model.** With `v_i = dF_i/dt_i` at fixed ends, the multipliers `λ = (λ_p, λ_r)` of the balance
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
//! The derivatives of v_i are second derivatives of the catenary
//! (`cdpr_cable::SpatialCable::tension_slopes`).
//!
//! **Active bounds stay active** while their multipliers are not zero. On limits at the platform `dt_i = 0`.
//! A cable whose weight demands more rests on a constant, a = 1.001, times the least tension over its
//! span. That least tension, a minimum over the length, changes as if the length at which it is taken were
//! constant: `dt_i = a u·(-K3 dr + k_ρ dρ + k_E dE)` of that catenary. A greatest tension T0 at the
//! exit point leaves t at the platform, which (C26) of `cdpr_cable` relates: `(1 + ε(t)) dt = w dz + z dw +
//! (1/EA ∫ ε) dEA` with the integral over the tension from T0 to t.
//!
//! **Set-points** are `t_i + dt_i`, or the bounds above where it is beyond them: then the offset changes
//! nothing.
//!
//! **Two sides.** Where a bound is left when an input grows and kept when it falls, or the other way round,
//! the right and the left derivative differ: `derivatives/optimum.rs` and `set_points.rs`. An offset of a
//! cable on its bound is such an input.
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

mod equilibrium;
mod in_weather;
mod optimum;
mod rest;
mod set_points;
mod softest;

pub use crate::equations::Inputs;
use crate::error::StaticsError;
use crate::inverse::{InverseSolution, lengths_at, require_smooth};
use crate::loading::{Deflection, SetPointLengths, deflection_from, lengths_at_rest};
use crate::problem::DirectProblem;
use crate::state::{Load, Wanted, WantedPose, one_by_one};
use cdpr_robot::Robot;
use equilibrium::split_off;
pub use equilibrium::{EquilibriumDerivatives, ForceDerivatives};
pub use in_weather::{WeatherDerivatives, WeatherInput, weather_derivatives};
use nalgebra::{DMatrix, Matrix3xX};
pub use optimum::AtBound;
use rest::Rest;
pub use set_points::OneSided;
use set_points::{AtSetPoints, SetPoints};

/// A deflection with its derivatives. Each matrix has a column for every input ([`Inputs`]): the parameters
/// of the robot, the payload, the wanted pose.
///
/// The columns of inputs in `one_sided` have the left derivatives, as the input falls; [`Derivatives::right`]
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
/// let robot = Robot::from_library("caroca")?;
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
) -> W::Results<Result<Derivatives, StaticsError>> {
    one_by_one(wanted, |wanted| {
        let offsets = wanted.offsets_of(robot);
        if !wanted.free.is_empty() {
            return with_free(robot, wanted, &offsets, load);
        }
        at_pose(robot, wanted, &offsets, load, &SetPointLengths::new(robot, wanted, &offsets)?)
    })
}

/// [`derivatives`] of the whole of a wanted pose, with the solution of the inverse model under the platform's
/// own weight at hand.
///
/// # Errors
/// As [`derivatives`].
pub fn derivatives_from<'a>(
    robot: &Robot,
    wanted: impl Into<WantedPose<'a>>,
    load: &Load,
    solution: InverseSolution,
) -> Result<Derivatives, StaticsError> {
    let wanted = wanted.into();
    let offsets = wanted.offsets_of(robot);
    let set_points = SetPointLengths::from(robot, &wanted.pose, &offsets, solution)?;
    at_pose(robot, &wanted, &offsets, load, &set_points)
}

/// The derivatives of the deflection with these lengths.
fn at_pose(
    robot: &Robot,
    wanted: &WantedPose,
    tension_offsets: &[f64],
    load: &Load,
    cables: &SetPointLengths,
) -> Result<Derivatives, StaticsError> {
    require_smooth(robot)?;
    let deflection = deflection_from(robot, cables.offset.lengths.clone(), load, &cables.offset.equilibrium)?;
    let WantedPose { pose, tension_reference, .. } = wanted;
    let at = AtSetPoints { robot, pose, reference: *tension_reference, inputs: Inputs::of(robot), cables };
    let set_points = at.set_points(tension_offsets)?;
    let lengths = at.lengths(&set_points.rows)?;
    of_lengths(robot, load, deflection, at.inputs, set_points, lengths)
}

/// The derivatives of the deflection of a robot with free coordinates.
fn with_free(
    robot: &Robot,
    wanted: &WantedPose,
    tension_offsets: &[f64],
    load: &Load,
) -> Result<Derivatives, StaticsError> {
    let rest = lengths_at(robot, wanted, &Load::none())?;
    let (unmoved, offset) = lengths_at_rest(robot, tension_offsets, rest)?;
    let deflection = deflection_from(robot, offset.lengths.clone(), load, &offset.equilibrium)?;
    let inputs = Inputs::of(robot);
    let WantedPose { pose, free, .. } = wanted;
    let rest = Rest { robot, wanted: pose, free, inputs: &inputs, unmoved: &unmoved, offset: &offset };
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
}
