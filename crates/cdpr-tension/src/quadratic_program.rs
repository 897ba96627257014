//! The two quadratic programs in Clarabel's form, `min ½ xᵀPx + qᵀx  subject to  Ax + s = b, s in a cone`.
//!
//! No other module names Clarabel.

use crate::problem::{Bound, Problem, TensionError};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus,
    SupportedConeT::{NonnegativeConeT, ZeroConeT},
};

/// What the solver says about problem (T1).
pub(crate) enum Outcome {
    /// Tensions, and as active bounds those whose slack is smaller than their multiplier.
    Solved { tensions: Vec<f64>, active: Vec<Option<Bound>> },
    /// The solver found a certificate of infeasibility.
    Infeasible,
}

/// Solves problem (T1) with P = I and q = -t_ref. The rows are W t = -w, then t <= t_max, then -t <= -t_min.
pub(crate) fn solve(problem: &Problem) -> Result<Outcome, TensionError> {
    let n = problem.reference.len();
    let size = problem.scale();
    let wrench = problem.wrench_matrix;
    let rows = (0..6).map(|row| (0..n).map(|column| wrench[(row, column)]).collect());
    let a = CscMatrix::from(&rows.chain(bound_rows(n, n)).collect::<Vec<Vec<f64>>>());
    let b: Vec<f64> = problem.wrench.iter().map(|w| -w / size).chain(bounds(problem, size)).collect();
    let q: Vec<f64> = problem.reference.iter().map(|t| -t / size).collect();
    let cones = [ZeroConeT(6), NonnegativeConeT(2 * n)];
    let mut solver =
        DefaultSolver::new(&CscMatrix::identity(n), &q, &a, &b, &cones, settings()?).map_err(refused)?;
    solver.solve();
    let solution = &solver.solution;
    match solution.status {
        SolverStatus::Solved | SolverStatus::AlmostSolved => {
            let (slack, multiplier) = (&solution.s[6..], &solution.z[6..]);
            let active = (0..n)
                .map(|i| {
                    if slack[n + i] < multiplier[n + i] {
                        Some(Bound::Min)
                    } else if slack[i] < multiplier[i] {
                        Some(Bound::Max)
                    } else {
                        None
                    }
                })
                .collect();
            Ok(Outcome::Solved { tensions: solution.x.iter().map(|t| t * size).collect(), active })
        }
        SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => Ok(Outcome::Infeasible),
        status => Err(TensionError::Solver { status: status.to_string() }),
    }
}

/// The tensions within the bounds with the least residual wrench `|W t + w|`; 1 N counts as much as 1 N m.
///
/// The residual `e = W t + w` takes part as six further unknowns: P is the identity for e and zero for t, but
/// for 1e-9 that makes the tensions unique.
pub(crate) fn least_residual(problem: &Problem) -> Result<Vec<f64>, TensionError> {
    let n = problem.reference.len();
    let size = problem.scale();
    let wrench = problem.wrench_matrix;
    let diagonal = |i: usize| if i < n { 1e-9 } else { 1.0 };
    let row_of_p = |i| (0..n + 6).map(|j| if i == j { diagonal(i) } else { 0.0 }).collect();
    let p = CscMatrix::from(&(0..n + 6).map(row_of_p).collect::<Vec<Vec<f64>>>());
    let rows = (0..6).map(|row| {
        let of_residual = |component| if component == row { -1.0 } else { 0.0 };
        (0..n).map(|column| wrench[(row, column)]).chain((0..6).map(of_residual)).collect()
    });
    let a = CscMatrix::from(&rows.chain(bound_rows(n, n + 6)).collect::<Vec<Vec<f64>>>());
    let b: Vec<f64> = problem.wrench.iter().map(|w| -w / size).chain(bounds(problem, size)).collect();
    let cones = [ZeroConeT(6), NonnegativeConeT(2 * n)];
    let mut solver =
        DefaultSolver::new(&p, &vec![0.0; n + 6], &a, &b, &cones, settings()?).map_err(refused)?;
    solver.solve();
    match solver.solution.status {
        SolverStatus::Solved | SolverStatus::AlmostSolved => {
            let tensions = solver.solution.x[..n].iter().zip(problem.limits);
            Ok(tensions.map(|(t, limits)| (t * size).clamp(limits.min, limits.max)).collect())
        }
        status => Err(TensionError::Solver { status: status.to_string() }),
    }
}

/// Rows of t <= t_max, then of -t <= -t_min, for n tensions among `columns` unknowns.
fn bound_rows(n: usize, columns: usize) -> impl Iterator<Item = Vec<f64>> {
    [1.0, -1.0].into_iter().flat_map(move |sign| {
        (0..n).map(move |i| (0..columns).map(|column| if column == i { sign } else { 0.0 }).collect())
    })
}

fn bounds(problem: &Problem, size: f64) -> impl Iterator<Item = f64> {
    let upper = problem.limits.iter().map(move |limits| limits.max / size);
    upper.chain(problem.limits.iter().map(move |limits| -limits.min / size))
}

fn settings() -> Result<DefaultSettings<f64>, TensionError> {
    DefaultSettingsBuilder::default()
        .verbose(false)
        .build()
        .map_err(|error| TensionError::Solver { status: error.to_string() })
}

fn refused(error: impl std::fmt::Display) -> TensionError {
    TensionError::Solver { status: error.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{closed_form, distribute};
    use cdpr_robot::{Pose, Robot, TensionLimits};
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// Clarabel is the oracle of the active-set method.
        #[test]
        fn the_qp_finds_the_distribution_with_active_bounds(
            x in -3.2..3.2f64, y in -1.7..1.7f64, z in 0.2..3.2f64,
            min in 100.0..500.0f64, reference in 0.0..1000.0f64,
        ) {
            let robot = Robot::from_json(include_str!("../../../data/robots/caroca.json")).unwrap();
            let pose = Pose::at(x, y, z);
            let pulls: Vec<_> = (0..8).map(|i| -robot.span(&pose, i).normalize()).collect();
            let problem = Problem {
                wrench_matrix: &robot.wrench_matrix(&pose, &pulls),
                wrench: robot.weight(&pose, 0.0).to_vector(),
                reference: &[reference; 8],
                limits: &[TensionLimits { min, max: 1500.0 }; 8],
            };
            match (distribute(&problem), solve(&problem).unwrap()) {
                (Ok(found), Outcome::Solved { tensions, .. }) => {
                    for (qp, found) in tensions.iter().zip(&found.tensions) {
                        prop_assert!((qp - found).abs() < 1e-4 * problem.scale(), "{qp} {found}");
                    }
                }
                (Err(TensionError::Infeasible { .. }), Outcome::Infeasible) => {}
                (found, _) => prop_assert!(false, "{found:?}"),
            }
        }

        #[test]
        fn where_no_bound_is_active_the_qp_finds_the_closed_form(
            x in -2.5..2.5f64, y in -1.2..1.2f64, z in 0.5..3.0f64, reference in 0.0..1000.0f64,
        ) {
            let robot = Robot::from_json(include_str!("../../../data/robots/caroca.json")).unwrap();
            let pose = Pose::at(x, y, z);
            let pulls: Vec<_> = (0..8).map(|i| -robot.span(&pose, i).normalize()).collect();
            let problem = Problem {
                wrench_matrix: &robot.wrench_matrix(&pose, &pulls),
                wrench: robot.weight(&pose, 0.0).to_vector(),
                reference: &[reference; 8],
                limits: &[robot.tension_limits; 8],
            };
            let closed = closed_form(&problem).unwrap();
            prop_assume!(closed.min() > robot.tension_limits.min && closed.max() < robot.tension_limits.max);
            let Outcome::Solved { tensions, active } = solve(&problem).unwrap() else { panic!("infeasible") };
            prop_assert!(active.iter().all(Option::is_none));
            // Clarabel stops at 1e-8, relative to the problem's scale.
            for (qp, closed) in tensions.iter().zip(&closed) {
                prop_assert!((qp - closed).abs() < 1e-4 * problem.scale(), "{qp} {closed}");
            }
        }
    }
}
