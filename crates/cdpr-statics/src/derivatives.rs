//! Exact derivatives of a deflection and of all that leads to it, by the implicit function theorem.
//!
//! The theorem is applied to the equations of the inverse model, of the set-points and of both equilibria.
//!
//! Cables answer to their inputs by (D1)-(D4) of `equations/partials.rs`.
//!
//! **Inverse model.** With `v_i = dF_i/dt_i` at held ends, the multipliers `λ = (λ_p, λ_r)` of the balance
//! make a twist that moves anchor point A_i by `μ_i = λ_p + λ_r x s_i`. Tensions without active bound and the
//! balance of the platform are equation (I2) of `inverse.rs` and Eq. (3),
//!
//! ```text
//! ρ_i = t_i - r_i + v_i·μ_i = 0,      G = sum [F_i; s_i x F_i] + w_ex = 0                         (D5)
//! ```
//!
//! Differentiated, with `c_i = [v_i; s_i x v_i]`, `D_i = 1 + μ_i·dv_i/dt_i` and partial derivatives ∂ at
//! constant t and λ,
//!
//! ```text
//! dt_i = -( ∂ρ_i + c_i·dλ )/D_i,      ∂ρ_i = μ_i·∂v_i + v_i·(λ_r x ∂s_i)                          (D6)
//! [ sum_free c_i c_iᵀ/D_i ] dλ = ∂G - sum_free c_i ∂ρ_i/D_i + sum_active c_i dt_i
//! ```
//!
//! The derivatives of v_i are second derivatives of the catenary (`cdpr_cable::TensionSlope`).
//!
//! **Active bounds stay active.** On the robot's own limits `dt_i = 0`. A cable whose weight demands more
//! rests on the constant [`ABOVE_LEAST`] times the least tension over its span. That least tension, a minimum
//! over the length, changes as if the length at which it is taken were held:
//! `dt_i = ABOVE_LEAST u·(-K3 dr + k_ρ dρ + k_E dE)` of that catenary.
//!
//! **Set-points** are `t_i + dt_i`, or the bounds above where that is less: then the offset changes nothing.
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

use crate::equations::{CableDerivatives, Inputs, Partials, Reading, Span, read, solve, tensions};
use crate::error::StaticsError;
use crate::inverse::{ABOVE_LEAST, InverseSolution};
use crate::loading::{Deflection, Wound, deflection_from, wind};
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Load};
use cdpr_cable::least_tension;
use cdpr_robot::{Matrix6xX, ParameterLayout, Pose, Robot, Vector3};
use cdpr_tension::Bound;
use nalgebra::{DMatrix, Matrix3xX, Matrix6};

/// A deflection with its derivatives. Each matrix has a column for every input ([`Inputs`]): the parameters
/// of the robot, the payload, the wanted pose.
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
}

/// Derivatives of an equilibrium; columns as in [`Derivatives`].
#[derive(Clone, Debug, PartialEq)]
pub struct EquilibriumDerivatives {
    /// Derivatives of the pose: (dp, dφ) in the base frame, `R <- exp(dφ) R`, 6 x count [m, rad per unit].
    pub pose: Matrix6xX<f64>,
    /// Derivatives of the tensions at the platform, n x count [N per unit].
    pub tensions: DMatrix<f64>,
}

/// Share of each parameter in the variance of |dp|, to first order and for independent parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct VarianceBudget {
    /// Share of each parameter, 0 to 1, in the order of [`Inputs::parameters`]; they add up to 1, or are zero
    /// where nothing varies.
    pub shares: Vec<f64>,
    /// Predicted standard deviation of |dp| [m].
    pub std: f64,
}

/// The deflection at a wanted pose as [`crate::deflection`] gives it, with its derivatives.
///
/// At the edge of a bound they are those of the side on which the bound is active.
///
/// ```
/// use cdpr_robot::{Parameter, Pose, Robot};
/// use cdpr_statics::{Load, derivatives};
///
/// let robot = Robot::from_json(include_str!("../../../data/robots/caroca.json"))?;
/// let found = derivatives(&robot, &Pose::at(0.0, 0.0, 1.75), &[0.0; 8], &Load::payload(50.0))?;
/// let modulus = found.inputs.column(Parameter::YoungsModulus);
/// let rms = found.rms()?; // [m per SI unit]
/// assert!(modulus.is_some_and(|column| (1e12 * rms[column] + 0.01289).abs() < 1e-5)); // [mm/GPa]
/// # Ok::<(), cdpr_statics::StaticsError>(())
/// ```
///
/// # Errors
/// Those of [`crate::deflection`]; [`StaticsError::NoDerivative`] where an equilibrium or the tension
/// distribution is at the border of its existence.
pub fn derivatives(
    robot: &Robot,
    pose: &Pose,
    tension_offsets: &[f64],
    load: &Load,
) -> Result<Derivatives, StaticsError> {
    let wound = wind(robot, pose, tension_offsets)?;
    let deflection = deflection_from(robot, wound.lengths.clone(), load, &wound.held)?;
    let stage = Stage { robot, pose, inputs: Inputs::new(robot.cables.len()), wound: &wound };
    let set_points = stage.set_points(tension_offsets)?;
    let lengths = stage.lengths(&set_points)?;
    let at = |load: &Load, equilibrium| {
        let problem = DirectProblem::new(robot, &wound.lengths, load)?;
        EquilibriumDerivatives::new(&problem, &stage.inputs, equilibrium, Some(&lengths))
    };
    let mut unloaded = at(&Load::none(), &deflection.unloaded.equilibrium)?;
    let loaded = at(load, &deflection.loaded.equilibrium)?;
    unloaded.pose.column_mut(stage.inputs.payload()).fill(0.0);
    unloaded.tensions.column_mut(stage.inputs.payload()).fill(0.0);
    Ok(Derivatives { deflection, inputs: stage.inputs, set_points, lengths, unloaded, loaded })
}

impl Derivatives {
    /// Derivatives of the deflection dp, 3 x count [m per unit].
    pub fn displacement(&self) -> Matrix3xX<f64> {
        self.loaded.pose.fixed_rows::<3>(0) - self.unloaded.pose.fixed_rows::<3>(0)
    }

    /// Derivatives of |dp| [m per unit], one for each input: `(dp/|dp|)·d(dp)`.
    ///
    /// # Errors
    /// [`StaticsError::NoDerivative`] where |dp| is so small that rounding decides its direction: a norm has
    /// no derivative at zero.
    pub fn rms(&self) -> Result<Vec<f64>, StaticsError> {
        let dp = self.deflection.displacement();
        let size = self.deflection.lengths.iter().fold(0.0, |size: f64, length| size.max(*length));
        if dp.norm() <= 1e-12 * size {
            let reason = "the load does not displace the platform";
            return Err(StaticsError::NoDerivative { quantity: "the norm of the deflection", reason });
        }
        Ok((dp.normalize().transpose() * self.displacement()).as_slice().to_vec())
    }

    /// Variance of |dp| from that of each parameter (squared SI units), to first order:
    /// `sum (d|dp|/dθ_j)² var_j`.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] unless there is one finite variance, not negative, for each parameter; as
    /// [`Derivatives::rms`].
    pub fn variance_budget(&self, variances: &[f64]) -> Result<VarianceBudget, StaticsError> {
        self.inputs.check("variances", variances)?;
        let parts = self.rms()?.into_iter().zip(variances).map(|(slope, variance)| slope * slope * variance);
        let parts: Vec<f64> = parts.collect();
        let variance: f64 = parts.iter().sum();
        let share = |part: &f64| if variance > 0.0 { part / variance } else { 0.0 };
        Ok(VarianceBudget { shares: parts.iter().map(share).collect(), std: variance.sqrt() })
    }
}

impl DirectProblem<'_> {
    /// Derivatives of an equilibrium for *given* lengths, which do not change with the parameters: neither
    /// tension offsets nor the wanted pose matter.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] unless the equilibrium is finite and has one force for each cable;
    /// [`StaticsError::NoDerivative`] at the border of stability.
    pub fn derivatives(&self, equilibrium: &Equilibrium) -> Result<EquilibriumDerivatives, StaticsError> {
        self.check("equilibrium", equilibrium)?;
        EquilibriumDerivatives::new(self, &Inputs::new(self.cables()), equilibrium, None)
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
        let Partials { mut balance, readings: mut tensions } = partials;
        if let Some(winding) = winding {
            let per_actuation: Vec<_> = cables.iter().map(CableDerivatives::wrench_per_actuation).collect();
            balance.gemm(1.0, &Matrix6xX::from_columns(&per_actuation), winding, 1.0);
            for (i, cable) in cables.iter().enumerate() {
                let mut row = tensions.row_mut(i);
                row += winding.row(i) * cable.direction.dot(&cable.per_actuation);
            }
        }
        balance.neg_mut();
        solve(hessian, &mut balance, "the equilibrium")?;
        tensions.gemm(1.0, &tensions_per_motion, &balance, 1.0);
        Ok(Self { pose: balance, tensions })
    }
}

const DISTRIBUTION: &str = "the tension distribution";

/// From the wanted pose to the lengths.
struct Stage<'a> {
    robot: &'a Robot,
    pose: &'a Pose,
    inputs: Inputs,
    wound: &'a Wound,
}

impl Stage<'_> {
    fn cables(
        &self,
        lengths: &[f64],
        equilibrium: &Equilibrium,
    ) -> Result<Vec<CableDerivatives>, StaticsError> {
        let problem = DirectProblem::new(self.robot, lengths, &Load::none())?;
        Ok(CableDerivatives::all(&problem, self.pose, &equilibrium.cable_forces))
    }

    /// Derivatives of the tensions of the inverse model, equation (D6); `bounds` has a row for each active
    /// bound.
    fn tensions(&self, bounds: &DMatrix<f64>) -> Result<DMatrix<f64>, StaticsError> {
        let InverseSolution { lengths, active, equilibrium, multipliers, .. } = &self.wound.wanted;
        let problem = DirectProblem::new(self.robot, lengths, &Load::none())?;
        let forces = equilibrium.cable_forces.iter().enumerate();
        let rates: Vec<_> = forces
            .map(|(i, force)| {
                let catenary = problem.catenary(i, *force);
                CableDerivatives::of_tension_slope(self.robot, self.pose, i, catenary)
            })
            .collect();
        let cables = CableDerivatives::all(&problem, self.pose, &equilibrium.cable_forces);
        let cables: Vec<_> = cables.iter().map(CableDerivatives::at_tension).collect();
        let [translation, rotation]: [Vector3<f64>; 2] =
            [0, 3].map(|row| multipliers.fixed_view::<3, 1>(row, 0).into());
        let motion = |cable: &CableDerivatives| translation + rotation.cross(&cable.arm);

        let Partials { mut balance, .. } =
            Partials::new(self.robot, &self.inputs, self.pose, &Load::none(), &cables, Reading::tension);
        let mut rows = read(&self.inputs, self.pose, &rates, |rate| Reading {
            per_force: motion(rate),
            per_arm: rate.force.cross(&rotation),
        });
        balance.column_mut(self.inputs.payload()).fill(0.0);
        let mut per_actuation = Matrix6xX::zeros(cables.len());
        // -c_i/D_i, zero for a cable on a bound.
        let mut answers = DMatrix::zeros(cables.len(), 6);
        for (i, (cable, rate)) in cables.iter().zip(&rates).enumerate() {
            let slope = cable.wrench_per_actuation();
            per_actuation.set_column(i, &slope);
            if active[i].is_some() {
                rows.set_row(i, &bounds.row(i));
                continue;
            }
            let d = 1.0 + motion(rate).dot(&rate.per_actuation);
            rows.row_mut(i).unscale_mut(-d);
            answers.set_row(i, &-(slope / d).transpose());
        }
        let matrix: Matrix6<f64> = (&per_actuation * &answers).fixed_columns::<6>(0).into();
        balance.gemm(1.0, &per_actuation, &rows, 1.0);
        balance.neg_mut();
        solve(matrix, &mut balance, DISTRIBUTION)?;
        rows.gemm(1.0, &answers, &balance, 1.0);
        Ok(rows)
    }

    /// Derivatives of the set-points.
    fn set_points(&self, tension_offsets: &[f64]) -> Result<DMatrix<f64>, StaticsError> {
        let Wound { wanted, set_points, held, .. } = self.wound;
        let least = self.robot.tension_limits.min;
        // What the weight of a cable demands is more than the robot's limit, or more than the set-point.
        let demanded = |i: &usize| wanted.active[*i] == Some(Bound::Min) && wanted.tensions[*i] > least;
        let raised = |i: &usize| held.cable_forces[*i].norm() > (1.0 + 1e-9) * set_points[*i];
        let n = set_points.len();
        let which: Vec<usize> = (0..n).filter(|i| demanded(i) || raised(i)).collect();
        let bounds = self.least_tensions(&which)?;
        let mut rows = self.tensions(&bounds)?;
        let layout = ParameterLayout::new(n);
        for i in 0..n {
            if raised(&i) {
                rows.set_row(i, &bounds.row(i));
            } else if wanted.tensions[i] + tension_offsets[i] <= least {
                rows.row_mut(i).fill(0.0);
            } else {
                rows[(i, layout.tension_offset(i))] += 1.0;
            }
        }
        Ok(rows)
    }

    /// Derivatives of the tensions that the weights of the cables in `which` demand; zero rows for all
    /// others.
    fn least_tensions(&self, which: &[usize]) -> Result<DMatrix<f64>, StaticsError> {
        let mut rows = self.inputs.zeros(self.wound.set_points.len());
        if which.is_empty() {
            return Ok(rows);
        }
        let mut cables = self.cables(&self.wound.lengths, &self.wound.held)?;
        for &i in which {
            let end = Span::new(self.robot.span(self.pose, i).into()).end.into();
            let catenary = least_tension(&self.robot.cable(i), end).map_err(StaticsError::cable(i))?;
            cables[i] = CableDerivatives::new(self.robot, self.pose, i, &catenary);
        }
        let least = tensions(&self.inputs, self.pose, &cables);
        which.iter().for_each(|i| rows.set_row(*i, &(ABOVE_LEAST * least.row(*i))));
        Ok(rows)
    }

    /// Derivatives of the lengths, equation (D7).
    fn lengths(&self, set_points: &DMatrix<f64>) -> Result<DMatrix<f64>, StaticsError> {
        let cables = self.cables(&self.wound.lengths, &self.wound.held)?;
        let mut rows = tensions(&self.inputs, self.pose, &cables);
        for (i, cable) in cables.iter().enumerate() {
            let per_length = cable.direction.dot(&cable.per_actuation);
            for (slope, set_point) in rows.row_mut(i).iter_mut().zip(set_points.row(i).iter()) {
                *slope = (set_point - *slope) / per_length;
            }
        }
        Ok(rows)
    }
}
