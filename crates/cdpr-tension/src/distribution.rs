//! The solution of a distribution problem, in closed form or with active bounds.

use crate::problem::{Bound, Problem, TensionError};
use crate::quadratic_program::{Outcome, least_residual, solve};
use cdpr_robot::TensionLimits;
use nalgebra::{DMatrix, DVector, Vector6};

/// How a distribution was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DistributionMethod {
    /// The closed form (T2): no bound is active.
    ClosedForm,
    /// The optimality conditions (T3) with the active bounds of the optimum.
    ActiveSet,
    /// Clarabel's solution, to its tolerances: the conditions (T3) with its active bounds are singular.
    InteriorPoint,
}

/// Tensions that balance the wrench.
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution {
    /// Tensions t [N].
    pub tensions: Vec<f64>,
    /// The bound that holds each tension, if any.
    pub active: Vec<Option<Bound>>,
    /// Residual wrench W t + w [N, N m].
    pub residual: Vector6<f64>,
    /// How it was found.
    pub method: DistributionMethod,
}

/// A tension beyond its bound by less than this share of the largest tension is on the bound.
const ROUNDING: f64 = 1e-11;

/// A residual wrench below this, relative to tensions and wrench, is the rounding of a solved system.
const BALANCE: f64 = 1e-9;

/// Solves problem (T1).
///
/// # Errors
/// [`TensionError::Infeasible`] with the best attempt, [`TensionError::Invalid`], [`TensionError::Solver`].
pub fn distribute(problem: &Problem) -> Result<Distribution, TensionError> {
    problem.validate()?;
    let n = problem.reference.len();
    if let Some(tensions) = closed_form(problem)
        && tensions.iter().zip(problem.limits).all(|(t, limits)| limits.min <= *t && *t <= limits.max)
    {
        let solution = Bounded { tensions: tensions.as_slice().to_vec(), active: vec![None; n] };
        return Ok(problem.distribution(solution, DistributionMethod::ClosedForm));
    }
    if let Some(solution) = active_set(problem, vec![None; n]) {
        return Ok(problem.distribution(solution, DistributionMethod::ActiveSet));
    }
    match solve(problem)? {
        Outcome::Infeasible => Err(problem.infeasible()?),
        Outcome::Solved { tensions, active } => Ok(match active_set(problem, active.clone()) {
            Some(solution) => problem.distribution(solution, DistributionMethod::ActiveSet),
            None => problem.distribution(Bounded { tensions, active }, DistributionMethod::InteriorPoint),
        }),
    }
}

/// The closed form (T2), whether or not it respects the bounds. `None` if W does not have full rank.
pub fn closed_form(problem: &Problem) -> Option<DVector<f64>> {
    let w = problem.wrench_matrix;
    let reference = DVector::from_column_slice(problem.reference);
    let gram = w * w.transpose();
    let residual = problem.wrench + w * &reference;
    // W Wᵀ has elements in 1, m and m²: its diagonal scales it.
    let scale = gram.diagonal().map(|d| 1.0 / d.sqrt());
    let scaled = gram.component_mul(&(scale * scale.transpose()));
    let cholesky = scaled.cholesky()?;
    let pivots = cholesky.l_dirty().diagonal();
    if pivots.min() < 1e-7 {
        return None;
    }
    let multipliers = cholesky.solve(&residual.component_mul(&scale)).component_mul(&scale);
    Some(reference - w.transpose() * multipliers)
}

/// Set-points [N]: each tension with its offset added, kept within its limits.
pub fn offset(tensions: &[f64], offsets: &[f64], limits: &[TensionLimits]) -> Vec<f64> {
    let each = tensions.iter().zip(offsets).zip(limits);
    each.map(|((t, dt), limits)| (t + dt).max(limits.min).min(limits.max)).collect()
}

/// Tensions and the bounds that hold them.
struct Bounded {
    tensions: Vec<f64>,
    active: Vec<Option<Bound>>,
}

/// Solution of the optimality conditions (T3) for given active bounds.
struct Stationary {
    tensions: Vec<f64>,
    /// Slope `t_i - t_ref,i + w_i·λ` of the objective over each tension, zero for a free cable [N].
    slopes: Vec<f64>,
}

/// The optimum to rounding, from a guess of the active bounds.
///
/// Each iteration solves (T3), then adds the bound that is violated most or removes the one whose multiplier
/// has the wrong sign most. When none is left, the tensions are the optimum, because the problem is convex.
/// `None` if the iteration does not end, leaves fewer than six cables free, or leaves free cables that do not
/// span all wrenches.
fn active_set(problem: &Problem, mut active: Vec<Option<Bound>>) -> Option<Bounded> {
    for _ in 0..4 * active.len() {
        let Stationary { tensions, slopes } = stationary(problem, &active)?;
        let size = tensions.iter().fold(1.0, |size: f64, t| size.max(t.abs()));
        let wrong = |i: usize| {
            let TensionLimits { min, max } = problem.limits[i];
            // At a bound the objective must grow towards the interior.
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
            // The solution of a singular system, of free cables that cannot balance every wrench, is not
            // balanced.
            let balanced = problem.residual(&tensions).norm() <= BALANCE * (size + problem.wrench.norm());
            return balanced.then_some(Bounded { tensions, active });
        }
        active[i] = bound;
    }
    None
}

/// Solves the optimality conditions (T3) as one linear system, with the given bounds active.
fn stationary(problem: &Problem, active: &[Option<Bound>]) -> Option<Stationary> {
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
    let residual = problem.residual(&tensions);
    let right =
        DVector::from_fn(k + 6, |i, _| if i < k { problem.reference[free[i]] } else { -residual[i - k] });
    let solution = kkt.lu().solve(&right)?;
    for (position, i) in free.iter().enumerate() {
        tensions[*i] = solution[position];
    }
    let multipliers = Vector6::from_fn(|row, _| solution[k + row]);
    let slopes = w.transpose() * multipliers;
    let slopes = (0..active.len()).map(|i| tensions[i] - problem.reference[i] + slopes[i]).collect();
    Some(Stationary { tensions, slopes })
}

impl Problem<'_> {
    fn distribution(&self, solution: Bounded, method: DistributionMethod) -> Distribution {
        let Bounded { tensions, active } = solution;
        let residual = self.residual(&tensions);
        Distribution { tensions, active, residual, method }
    }

    fn infeasible(&self) -> Result<TensionError, TensionError> {
        let tensions = least_residual(self)?;
        let residual = self.residual(&tensions);
        Ok(TensionError::Infeasible {
            min: self.limits.iter().map(|limits| limits.min).fold(f64::INFINITY, f64::min),
            max: self.limits.iter().map(|limits| limits.max).fold(0.0, f64::max),
            force: residual.fixed_rows::<3>(0).norm(),
            moment: residual.fixed_rows::<3>(3).norm(),
            tensions,
        })
    }
}
