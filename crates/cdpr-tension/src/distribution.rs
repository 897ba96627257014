//! The solution of a distribution problem, in closed form or by Clarabel.

use crate::problem::{Bound, Objective, Problem, TensionError};
use crate::program::{Outcome, Program, Solution};
use cdpr_robot::TensionLimits;
use nalgebra::{DMatrix, DVector};

/// How a distribution was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DistributionMethod {
    /// The closed form (T2): no bound is active.
    ClosedForm,
    /// The optimality conditions (T3) with the active bounds that Clarabel found.
    OptimalityConditions,
    /// Clarabel's solution, to its tolerance of 1e-10.
    InteriorPoint,
}

/// Tensions that balance the wrench.
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution {
    /// Tensions t [N].
    pub tensions: Vec<f64>,
    /// The objective: of a distance, a norm or a margin [N]; a multiple of the wrench without unit.
    pub value: f64,
    /// The limit that each tension rests on, if any.
    pub active: Vec<Option<Bound>>,
    /// Residual wrench W t + w, with z d where there is a d [N, N m].
    pub residual: DVector<f64>,
    /// How it was found.
    pub method: DistributionMethod,
}

/// Chooses among the tensions within limits that balance a wrench.
///
/// # Errors
/// [`TensionError::Infeasible`] with the nearest tensions and a proof, checked here;
/// [`TensionError::Invalid`]; [`TensionError::Solver`].
pub fn distribute(problem: &Problem, objective: Objective) -> Result<Distribution, TensionError> {
    problem.validate(&objective)?;
    if let Objective::Nearest(reference) = objective
        && let Some(tensions) = problem.closed_form(reference)
        && tensions.iter().zip(problem.limits).all(|(t, limits)| limits.min <= *t && *t <= limits.max)
    {
        let value = DVector::from_column_slice(reference).metric_distance(&tensions);
        let tensions = tensions.as_slice().to_vec();
        let (active, residual) = (vec![None; tensions.len()], problem.residual(&tensions));
        return Ok(Distribution {
            tensions,
            value,
            active,
            residual,
            method: DistributionMethod::ClosedForm,
        });
    }
    let unit = problem.unit(if let Objective::Nearest(reference) = objective { reference } else { &[] });
    match program(problem, objective, unit).solve()? {
        Outcome::Solved(solution) => Ok(distribution(problem, objective, unit, solution)),
        Outcome::Infeasible(y) => Err(infeasible(problem, objective, DVector::from_vec(y))?),
    }
}

/// Set-points [N]: each tension with its offset added, kept within its limits.
pub fn offset(tensions: &[f64], offsets: &[f64], limits: &[TensionLimits]) -> Vec<f64> {
    let each = tensions.iter().zip(offsets).zip(limits);
    each.map(|((t, dt), limits)| (t + dt).max(limits.min).min(limits.max)).collect()
}

/// The program of an objective in units of force: unknowns are the tensions, and z where there is one.
fn program(problem: &Problem, objective: Objective, unit: f64) -> Program {
    let n = problem.limits.len();
    let w = problem.wrench_matrix;
    let mut gradient = vec![0.0; n];
    let mut curvature = vec![0.0; n];
    let mut bounds: Vec<_> =
        problem.limits.iter().map(|limits| [limits.min / unit, limits.max / unit]).collect();
    let mut inequalities = Vec::new();
    // A row of `sign t_i + z <= right`.
    let mut closer = |i: usize, sign: f64, of_z: f64, right: f64| {
        let mut row = vec![0.0; n + 1];
        (row[i], row[n]) = (sign, of_z);
        inequalities.push((row, right / unit));
    };
    let mut of_z = |cost: f64, range: [f64; 2]| {
        gradient.push(cost);
        curvature.push(0.0);
        bounds.push(range);
    };
    let mut direction = None;
    match objective {
        Objective::Nearest(reference) => {
            gradient = reference.iter().map(|t| -t / unit).collect();
            curvature = vec![1.0; n];
        }
        Objective::LeastSum => gradient = vec![1.0; n],
        Objective::LeastGreatest => {
            of_z(1.0, [f64::NEG_INFINITY, f64::INFINITY]);
            (0..n).for_each(|i| closer(i, 1.0, -1.0, 0.0));
        }
        Objective::GreatestWrench(wrench) => {
            of_z(-1.0, [0.0, f64::INFINITY]);
            direction = Some(wrench);
        }
        Objective::GreatestMargin(limits) => {
            of_z(-1.0, [f64::NEG_INFINITY, f64::INFINITY]);
            for (i, TensionLimits { min, max }) in limits.iter().enumerate() {
                closer(i, -1.0, 1.0, -min);
                closer(i, 1.0, 1.0, *max);
            }
        }
    }
    let has_z = gradient.len() > n;
    let equation = |row: usize| {
        let of_z = has_z.then(|| direction.map_or(0.0, |direction| direction[row]));
        let coefficients = w.row(row).iter().copied().chain(of_z).collect();
        (coefficients, -problem.wrench[row] / unit)
    };
    let equations = (0..w.nrows()).map(equation).collect();
    Program { gradient, curvature, equations, inequalities, bounds, ..Program::default() }
}

/// What Clarabel found, with the digits of the optimality conditions where these determine it.
fn distribution(problem: &Problem, objective: Objective, unit: f64, solution: Solution) -> Distribution {
    let n = problem.limits.len();
    let Solution { values, active, .. } = solution;
    let active = active[..n].to_vec();
    let within = |(t, limits): (&f64, &TensionLimits)| (t * unit).clamp(limits.min, limits.max);
    let mut tensions: Vec<f64> = values.iter().zip(problem.limits).map(within).collect();
    let mut method = DistributionMethod::InteriorPoint;
    let z = values.get(n).map_or(0.0, |z| z * unit);
    let value = match objective {
        Objective::Nearest(reference) => {
            if let Some(exact) = stationary(problem, reference, &active) {
                (tensions, method) = (exact, DistributionMethod::OptimalityConditions);
            }
            tensions.iter().zip(reference).map(|(t, r)| (t - r).powi(2)).sum::<f64>().sqrt()
        }
        Objective::LeastSum => tensions.iter().sum(),
        Objective::LeastGreatest => tensions.iter().fold(0.0, |most: f64, t| most.max(*t)),
        Objective::GreatestWrench(_) => z.max(0.0),
        Objective::GreatestMargin(_) => z,
    };
    let mut residual = problem.residual(&tensions);
    if let Objective::GreatestWrench(direction) = objective {
        residual += direction * value;
    }
    Distribution { tensions, value, active, residual, method }
}

/// Solves the optimality conditions (T3) as one linear system, with the given bounds active. `None` where the
/// free cables do not determine it, or where the solution leaves the limits by more than rounding.
fn stationary(problem: &Problem, reference: &[f64], active: &[Option<Bound>]) -> Option<Vec<f64>> {
    /// Beyond its limit, relative to the largest tension, and residual, relative to tensions and wrench.
    const ROUNDING: f64 = 1e-11;
    let (m, n) = problem.wrench_matrix.shape();
    let of_bound = |(bound, limits): (&Option<Bound>, &TensionLimits)| match bound {
        Some(Bound::Min) => limits.min,
        Some(Bound::Max) => limits.max,
        None => 0.0,
    };
    let mut tensions: Vec<f64> = active.iter().zip(problem.limits).map(of_bound).collect();
    let free: Vec<usize> = (0..n).filter(|i| active[*i].is_none()).collect();
    let k = free.len();
    if k < m {
        return None;
    }
    let free_matrix = problem.wrench_matrix.select_columns(&free);
    let mut matrix = DMatrix::zeros(k + m, k + m);
    matrix.view_mut((0, 0), (k, k)).fill_with_identity();
    matrix.view_mut((0, k), (k, m)).copy_from(&free_matrix.transpose());
    matrix.view_mut((k, 0), (m, k)).copy_from(&free_matrix);
    let open = problem.residual(&tensions);
    let right = DVector::from_fn(k + m, |i, _| if i < k { reference[free[i]] } else { -open[i - k] });
    let solution = matrix.lu().solve(&right)?;
    let size = solution.rows(0, k).amax().max(problem.wrench.amax());
    for (t, &i) in solution.iter().zip(&free) {
        let TensionLimits { min, max } = problem.limits[i];
        if !(min - ROUNDING * size..=max + ROUNDING * size).contains(t) {
            return None;
        }
        tensions[i] = t.clamp(min, max);
    }
    (problem.residual(&tensions).amax() <= ROUNDING * size).then_some(tensions)
}

/// The error of a problem that Clarabel calls infeasible along y.
fn infeasible(
    problem: &Problem,
    objective: Objective,
    y: DVector<f64>,
) -> Result<TensionError, TensionError> {
    let mut certificate = y;
    // z >= 0 of a wrench that pulls the other way could make up for what is missing.
    if let Objective::GreatestWrench(direction) = objective
        && certificate.dot(direction) < 0.0
    {
        certificate -= direction * (certificate.dot(direction) / direction.norm_squared());
    }
    certificate.normalize_mut();
    if !problem.refuted_along(&certificate) {
        let status = "infeasible, by a certificate that rounding may have caused".to_owned();
        return Err(TensionError::Solver { status });
    }
    let tensions = nearest(problem)?;
    Ok(TensionError::Infeasible {
        min: problem.limits.iter().map(|limits| limits.min).fold(f64::INFINITY, f64::min),
        max: problem.limits.iter().map(|limits| limits.max).fold(0.0, f64::max),
        residual: problem.residual(&tensions).norm(),
        tensions,
        certificate,
    })
}

/// The tensions within the limits with the least residual wrench `|W t + w|`; 1 N counts as much as 1 N m.
///
/// The residual `e = W t + w` takes part as further unknowns: the Hessian is one for e and zero for t, but
/// for 1e-9 that makes the tensions unique.
fn nearest(problem: &Problem) -> Result<Vec<f64>, TensionError> {
    const UNIQUE: f64 = 1e-9;
    let (m, n) = problem.wrench_matrix.shape();
    let unit = problem.unit(&[]);
    let Program { mut bounds, mut equations, .. } = program(problem, Objective::LeastSum, unit);
    bounds.extend(vec![[f64::NEG_INFINITY, f64::INFINITY]; m]);
    for (row, (coefficients, _)) in equations.iter_mut().enumerate() {
        coefficients.extend((0..m).map(|component| if component == row { -1.0 } else { 0.0 }));
    }
    let curvature = (0..n + m).map(|i| if i < n { UNIQUE } else { 1.0 }).collect();
    let gradient = vec![0.0; n + m];
    let least = Program { gradient, curvature, equations, bounds, ..Program::default() };
    match least.solve()? {
        Outcome::Solved(Solution { values, .. }) => {
            let tensions = values.iter().zip(problem.limits);
            Ok(tensions.map(|(t, limits)| (t * unit).clamp(limits.min, limits.max)).collect())
        }
        Outcome::Infeasible(_) => {
            Err(TensionError::Solver { status: "infeasible least residual".to_owned() })
        }
    }
}
