//! Distributions against their optimality conditions, and the errors of infeasible and invalid problems.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

use cdpr_robot::{Matrix6xX, Pose, Robot, TensionLimits, Vector3, Vector6};
use cdpr_tension::{
    Bound, Distribution, DistributionMethod, Problem, TensionError, closed_form, distribute, offset,
};
use proptest::prelude::*;

fn caroca() -> Robot {
    Robot::from_json(include_str!("../../../data/robots/caroca.json")).unwrap()
}

/// Wrench matrix of CAROCA with straight cables, and the platform's weight.
fn straight(pose: &Pose) -> (Matrix6xX<f64>, Vector6<f64>) {
    let robot = caroca();
    let pulls: Vec<_> = (0..8).map(|i| -robot.span(pose, i).normalize()).collect();
    (robot.wrench_matrix(pose, &pulls), robot.weight(pose, 0.0).to_vector())
}

/// Largest violation of the optimality conditions of problem (T1), relative to the largest tension.
fn optimality_error(problem: &Problem, solution: &Distribution) -> f64 {
    let size = solution.tensions.iter().fold(1.0, |size: f64, t| size.max(t.abs()));
    let w = problem.wrench_matrix;
    let n = problem.reference.len();
    // Multipliers of the equality from the free cables, by least squares.
    let free: Vec<usize> = (0..n).filter(|i| solution.active[*i].is_none()).collect();
    let free_matrix = nalgebra::DMatrix::from_fn(free.len(), 6, |row, column| w[(column, free[row])]);
    let right = nalgebra::DVector::from_fn(free.len(), |i, _| {
        problem.reference[free[i]] - solution.tensions[free[i]]
    });
    let multipliers = free_matrix.svd(true, true).solve(&right, 1e-12).unwrap();
    let slopes = w.transpose() * multipliers;
    let mut error = solution.residual.norm() / size;
    for i in 0..n {
        let (t, slope) = (solution.tensions[i], solution.tensions[i] - problem.reference[i] + slopes[i]);
        error = error.max((problem.limits[i].min - t) / size).max((t - problem.limits[i].max) / size);
        error = error.max(match solution.active[i] {
            None => slope.abs() / size,
            Some(Bound::Min) => (-slope).max(t - problem.limits[i].min) / size,
            Some(Bound::Max) => slope.max(problem.limits[i].max - t) / size,
        });
    }
    error
}

#[test]
fn least_norm_tensions_are_closed_form_in_the_middle_of_the_workspace() {
    let (wrench_matrix, wrench) = straight(&Pose::at(0.0, 0.0, 1.75));
    let limits = &[TensionLimits { min: 1.0, max: 10290.0 }; 8];
    let problem = Problem { wrench_matrix: &wrench_matrix, wrench, reference: &[0.0; 8], limits };
    let solution = distribute(&problem).unwrap();
    assert_eq!(solution.method, DistributionMethod::ClosedForm);
    assert!(optimality_error(&problem, &solution) < 1e-12);
    let closed = closed_form(&problem).unwrap();
    assert!(solution.tensions.iter().zip(&closed).all(|(a, b)| a == b));
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 2000,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn every_distribution_meets_the_optimality_conditions(
        x in -3.2..3.2f64, y in -1.7..1.7f64, z in 0.2..3.2f64, yaw in -0.4..0.4f64,
        min in 1.0..400.0f64, width in 100.0..2000.0f64, reference in 0.0..1500.0f64,
    ) {
        let pose = Pose::at(x, y, z).moved(Vector3::zeros(), Vector3::new(0.1, -0.05, yaw));
        let (wrench_matrix, wrench) = straight(&pose);
        let limits = &[TensionLimits { min, max: min + width }; 8];
        let reference = [reference; 8];
        let problem = Problem { wrench_matrix: &wrench_matrix, wrench, reference: &reference, limits };
        match distribute(&problem) {
            Ok(solution) => {
                let by_clarabel = solution.method == DistributionMethod::InteriorPoint;
                let tolerance = if by_clarabel { 1e-6 } else { 1e-9 };
                let error = optimality_error(&problem, &solution);
                prop_assert!(error < tolerance, "{error:e} by {:?}", solution.method);
            }
            Err(TensionError::Infeasible { force, moment, tensions, .. }) => {
                prop_assert!(force.hypot(moment) > 1e-6 * wrench.norm(), "{force} N, {moment} N m");
                // The best attempt cannot be improved: the projected gradient of |W t + w|² vanishes.
                let residual = wrench + &wrench_matrix * nalgebra::DVector::from_column_slice(&tensions);
                let gradient = wrench_matrix.transpose() * residual;
                for (t, slope) in tensions.iter().zip(&gradient) {
                    let small = 1e-4 * wrench.norm();
                    let at_min = *t <= limits[0].min + small;
                    let at_max = *t >= limits[0].max - small;
                    let blocked = (at_min && *slope > 0.0) || (at_max && *slope < 0.0);
                    prop_assert!(slope.abs() < small || blocked, "{t} {slope}");
                }
            }
            Err(error) => prop_assert!(false, "{error}"),
        }
    }
}

#[test]
fn six_cables_have_one_distribution() {
    let robot = caroca();
    let pose = Pose::at(0.3, 0.2, 1.5);
    let (all, wrench) = straight(&pose);
    let wrench_matrix = Matrix6xX::from_fn(6, |row, column| all[(row, [0, 1, 3, 4, 5, 6][column])]);
    let wide = &[TensionLimits { min: -1e6, max: 1e6 }; 6];
    let problem = Problem { wrench_matrix: &wrench_matrix, wrench, reference: &[50.0; 6], limits: wide };
    let solution = distribute(&problem).unwrap();
    assert!(solution.residual.norm() < 1e-9 * robot.platform.mass * robot.gravity.magnitude());
}

#[test]
fn cables_from_above_cannot_push_a_lifted_platform_down_and_the_error_says_what_is_missing() {
    let (wrench_matrix, wrench) = straight(&Pose::at(0.0, 0.0, 1.75));
    let limits = &[TensionLimits { min: 1.0, max: 10290.0 }; 8];
    let up = -wrench;
    let error =
        distribute(&Problem { wrench_matrix: &wrench_matrix, wrench: up, reference: &[0.0; 8], limits })
            .unwrap_err();
    let TensionError::Infeasible { force, tensions, .. } = error else { panic!("{error}") };
    assert!((force - 1765.8).abs() < 5.0, "{force}");
    assert!(tensions.iter().all(|t| (t - 1.0).abs() < 1e-3), "{tensions:?}");
}

#[test]
fn an_offset_set_point_stays_within_the_limits_of_its_cable() {
    let limits =
        [(1.0, 100.0), (1.0, 100.0), (3.0, 9.0), (3.0, 9.0)].map(|(min, max)| TensionLimits { min, max });
    let set_points = offset(&[10.0, 10.0, 8.0, 8.0], &[5.0, -15.0, 2.0, -6.0], &limits);
    assert_eq!(set_points, [15.0, 1.0, 9.0, 3.0]);
}

#[test]
fn an_invalid_problem_is_refused_with_its_field() {
    let (wrench_matrix, wrench) = straight(&Pose::at(0.0, 0.0, 1.75));
    let limits = &[TensionLimits { min: 1.0, max: 100.0 }; 8];
    let problem = Problem { wrench_matrix: &wrench_matrix, wrench, reference: &[0.0; 8], limits };
    let field = |problem: Problem| match distribute(&problem) {
        Err(TensionError::Invalid { field, .. }) => field,
        other => panic!("{other:?}"),
    };
    assert_eq!(field(Problem { reference: &[0.0; 7], ..problem }), "reference");
    assert_eq!(field(Problem { wrench: Vector6::repeat(f64::NAN), ..problem }), "wrench");
    assert_eq!(field(Problem { limits: &[TensionLimits { min: 5.0, max: 1.0 }; 8], ..problem }), "limits");
}
