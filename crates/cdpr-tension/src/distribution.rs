//! The distribution problem, its closed form, and the polished solution of the bounded problem.

use crate::quadratic_program::{Outcome, least_residual, solve};
use cdpr_robot::TensionLimits;
use nalgebra::{DMatrix, DVector, Matrix6xX, Vector6};

/// What is to be distributed.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a> {
    /// Wrench matrix W, 6 x n [1, m].
    pub wrench_matrix: &'a Matrix6xX<f64>,
    /// Sum w of all wrenches on the platform but the cables' [N, N m].
    pub wrench: Vector6<f64>,
    /// Reference tensions t_ref, n of them [N]; zeros for the least-norm distribution.
    pub reference: &'a [f64],
    /// Bounds of each tension, n of them [N].
    pub limits: &'a [TensionLimits],
}

/// A bound that a tension rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// The least tension.
    Min,
    /// The greatest tension.
    Max,
}

/// How a distribution was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Equation (2): no bound is active.
    ClosedForm,
    /// The optimality conditions with the right bounds active.
    ActiveSet,
    /// Clarabel's solution, to its tolerances: the optimality conditions with its active bounds are singular.
    InteriorPoint,
}

/// Tensions that balance the wrench.
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution {
    /// Tensions t [N].
    pub tensions: Vec<f64>,
    /// The bound each tension rests on, if any.
    pub active: Vec<Option<Bound>>,
    /// Open wrench W t + w [N, N m].
    pub residual: Vector6<f64>,
    /// How it was found.
    pub method: Method,
}

/// Why there is no distribution.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TensionError {
    /// No tensions within the bounds balance the wrench.
    #[error(
        "no tensions between {min} N and {max} N balance the wrench: at best {force:.3} N and {moment:.3} N m stay open; \
         change the pose, the load or the limits"
    )]
    Infeasible {
        /// Least tension allowed in any cable [N].
        min: f64,
        /// Greatest tension allowed in any cable [N].
        max: f64,
        /// Norm of the open force in the best attempt [N].
        force: f64,
        /// Norm of the open moment in the best attempt [N m].
        moment: f64,
        /// The tensions of that attempt: least |W t + w| within the bounds [N].
        tensions: Vec<f64>,
    },
    /// A number of the problem is not finite, or sizes differ.
    #[error("{field} is {value}: expected {expected}")]
    Invalid {
        /// Part of the problem.
        field: &'static str,
        /// What was given.
        value: String,
        /// What would be right.
        expected: &'static str,
    },
    /// The QP solver gave up.
    #[error("the QP solver stopped with status {status}")]
    Solver {
        /// The status it reported.
        status: String,
    },
}

/// Relative size of rounding in the tensions that is not taken for a crossed bound.
const ROUNDING: f64 = 1e-11;

/// Open wrench, relative to tensions and wrench, that is taken for the rounding of a solved system.
const BALANCE: f64 = 1e-9;

/// Solves problem (1).
///
/// # Errors
/// [`TensionError::Infeasible`] with the best attempt, [`TensionError::Invalid`], [`TensionError::Solver`].
pub fn distribute(problem: &Problem) -> Result<Distribution, TensionError> {
    problem.validate()?;
    let n = problem.reference.len();
    if let Some(tensions) = closed_form(problem)
        && tensions.iter().zip(problem.limits).all(|(t, limits)| limits.min <= *t && *t <= limits.max)
    {
        return Ok(problem.distribution(tensions.as_slice().to_vec(), vec![None; n], Method::ClosedForm));
    }
    if let Some((tensions, active)) = active_set(problem, vec![None; n]) {
        return Ok(problem.distribution(tensions, active, Method::ActiveSet));
    }
    match solve(problem)? {
        Outcome::Infeasible => Err(problem.infeasible()?),
        Outcome::Solved { tensions, active } => Ok(match active_set(problem, active.clone()) {
            Some((tensions, active)) => problem.distribution(tensions, active, Method::ActiveSet),
            None => problem.distribution(tensions, active, Method::InteriorPoint),
        }),
    }
}

/// Equation (2), whether or not it respects the bounds. `None` if W does not have full rank.
pub fn closed_form(problem: &Problem) -> Option<DVector<f64>> {
    let w = problem.wrench_matrix;
    let reference = DVector::from_column_slice(problem.reference);
    let gram = w * w.transpose();
    let open = problem.wrench + w * &reference;
    // W Wᵀ mixes 1 and m²: its diagonal scales it.
    let scale = gram.diagonal().map(|d| 1.0 / d.sqrt());
    let scaled = gram.component_mul(&(scale * scale.transpose()));
    let cholesky = scaled.cholesky()?;
    let pivots = cholesky.l_dirty().diagonal();
    if pivots.min() < 1e-7 {
        return None;
    }
    let multipliers = cholesky.solve(&open.component_mul(&scale)).component_mul(&scale);
    Some(reference - w.transpose() * multipliers)
}

/// Set-points after an offset of each tension, kept at or above the least tension [N].
pub fn offset(tensions: &[f64], offsets: &[f64], limits: TensionLimits) -> Vec<f64> {
    tensions.iter().zip(offsets).map(|(t, dt)| (t + dt).max(limits.min)).collect()
}

/// Tensions, and the bound each rests on.
type Bounded = (Vec<f64>, Vec<Option<Bound>>);

/// The optimum to rounding from a guess of the active bounds: solve with those bounds, take in the bound that is crossed
/// most or let go the one whose multiplier has the wrong sign most, until neither is left: then it is the optimum, for the problem is
/// convex. `None` where that does not end, leaves fewer than six cables free, or free cables that
/// do not span all wrenches.
fn active_set(problem: &Problem, mut active: Vec<Option<Bound>>) -> Option<Bounded> {
    for _ in 0..4 * active.len() {
        let (tensions, slopes) = with_active(problem, &active)?;
        let size = tensions.iter().fold(1.0, |size: f64, t| size.max(t.abs()));
        let wrong = |i: usize| {
            let TensionLimits { min, max } = problem.limits[i];
            // At a bound the objective must grow into the interior.
            match active[i] {
                None if min - tensions[i] > tensions[i] - max => (min - tensions[i], Some(Bound::Min)),
                None => (tensions[i] - max, Some(Bound::Max)),
                Some(Bound::Min) => (-slopes[i], None),
                Some(Bound::Max) => (slopes[i], None),
            }
        };
        let worst = (0..active.len()).map(|i| (i, wrong(i))).max_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
        let (i, (violation, bound)) = worst;
        if violation <= ROUNDING * size {
            let clamped =
                tensions.iter().zip(problem.limits).map(|(t, limits)| t.clamp(limits.min, limits.max));
            let tensions: Vec<f64> = clamped.collect();
            // Free cables that cannot balance every wrench: the solution of a singular system balances none.
            let balanced = problem.open_wrench(&tensions).norm() <= BALANCE * (size + problem.wrench.norm());
            return balanced.then_some((tensions, active));
        }
        active[i] = bound;
    }
    None
}

/// With the given bounds active, the optimum solves `t_F = t_ref - W_Fᵀ λ`, `W t + w = 0` over the free cables F. Returns the
/// tensions and the slope `t_i - t_ref,i + w_iᵀ λ` of the objective with respect to each.
fn with_active(problem: &Problem, active: &[Option<Bound>]) -> Option<(Vec<f64>, Vec<f64>)> {
    let w = problem.wrench_matrix;
    let mut tensions: Vec<f64> = active
        .iter()
        .zip(problem.limits)
        .map(|(bound, limits)| match bound {
            Some(Bound::Min) => limits.min,
            Some(Bound::Max) => limits.max,
            None => 0.0,
        })
        .collect();
    let free: Vec<usize> = (0..active.len()).filter(|i| active[*i].is_none()).collect();
    let k = free.len();
    if k < 6 {
        return None;
    }
    let free_matrix = DMatrix::from_fn(6, k, |row, column| w[(row, free[column])]);
    let mut kkt = DMatrix::zeros(k + 6, k + 6);
    kkt.view_mut((0, 0), (k, k)).fill_with_identity();
    kkt.view_mut((0, k), (k, 6)).copy_from(&free_matrix.transpose());
    kkt.view_mut((k, 0), (6, k)).copy_from(&free_matrix);
    let open = problem.wrench + w * DVector::from_column_slice(&tensions);
    let right = DVector::from_fn(k + 6, |i, _| if i < k { problem.reference[free[i]] } else { -open[i - k] });
    let solution = kkt.lu().solve(&right)?;
    for (place, i) in free.iter().enumerate() {
        tensions[*i] = solution[place];
    }
    let multipliers = Vector6::from_fn(|row, _| solution[k + row]);
    let slopes = w.transpose() * multipliers;
    let slopes = (0..active.len()).map(|i| tensions[i] - problem.reference[i] + slopes[i]).collect();
    Some((tensions, slopes))
}

impl Problem<'_> {
    fn validate(&self) -> Result<(), TensionError> {
        let n = self.wrench_matrix.ncols();
        if self.reference.len() != n {
            return Err(TensionError::Invalid {
                field: "reference",
                value: format!("of {} tensions", self.reference.len()),
                expected: "one reference tension for each column of the wrench matrix",
            });
        }
        if self.limits.len() != n {
            return Err(TensionError::Invalid {
                field: "limits",
                value: format!("of {} cables", self.limits.len()),
                expected: "limits for each column of the wrench matrix",
            });
        }
        let finite =
            |field, mut values: Box<dyn Iterator<Item = &f64> + '_>| match values.find(|v| !v.is_finite()) {
                Some(value) => {
                    Err(TensionError::Invalid { field, value: value.to_string(), expected: "finite numbers" })
                }
                None => Ok(()),
            };
        finite("wrench_matrix", Box::new(self.wrench_matrix.iter()))?;
        finite("wrench", Box::new(self.wrench.iter()))?;
        finite("reference", Box::new(self.reference.iter()))?;
        match self.limits.iter().find(|l| !(l.min.is_finite() && l.max.is_finite() && l.min <= l.max)) {
            None => Ok(()),
            Some(TensionLimits { min, max }) => {
                let value = format!("{min} N to {max} N");
                Err(TensionError::Invalid {
                    field: "limits",
                    value,
                    expected: "finite limits, the least first",
                })
            }
        }
    }

    fn open_wrench(&self, tensions: &[f64]) -> Vector6<f64> {
        self.wrench + self.wrench_matrix * DVector::from_column_slice(tensions)
    }

    fn distribution(&self, tensions: Vec<f64>, active: Vec<Option<Bound>>, method: Method) -> Distribution {
        let residual = self.open_wrench(&tensions);
        Distribution { tensions, active, residual, method }
    }

    fn infeasible(&self) -> Result<TensionError, TensionError> {
        let tensions = least_residual(self)?;
        let open = self.open_wrench(&tensions);
        Ok(TensionError::Infeasible {
            min: self.limits.iter().map(|limits| limits.min).fold(f64::INFINITY, f64::min),
            max: self.limits.iter().map(|limits| limits.max).fold(0.0, f64::max),
            force: open.fixed_rows::<3>(0).norm(),
            moment: open.fixed_rows::<3>(3).norm(),
            tensions,
        })
    }
}
