//! Distributions against their optimality conditions and the simplex method, and the errors of infeasible and
//! invalid problems.

#![allow(clippy::unwrap_used, clippy::panic)]

use cdpr_robot::{Pose, Robot, TensionLimits, Vector3};
use cdpr_tension::{
    Bound, Distribution, DistributionMethod, LinearProgram, Objective, Problem, TensionError, distribute,
    offset,
};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

fn caroca() -> Robot {
    Robot::from_json(include_str!("../../../data/robots/caroca.json")).unwrap()
}

/// Wrench matrix of CAROCA with straight cables, and the platform's weight.
fn straight(pose: &Pose) -> (DMatrix<f64>, DVector<f64>) {
    let robot = caroca();
    let pulls: Vec<_> = (0..8).map(|i| -robot.span(pose, i).normalize()).collect();
    let matrix = robot.wrench_matrix(pose, &pulls);
    let weight = robot.weight(pose, 0.0).to_vector();
    (DMatrix::from_column_slice(6, 8, matrix.as_slice()), DVector::from_column_slice(weight.as_slice()))
}

/// Largest violation of the optimality conditions of the nearest tensions, relative to the largest.
fn optimality_error(problem: &Problem, reference: &[f64], solution: &Distribution) -> f64 {
    let size = solution.tensions.iter().fold(1.0, |size: f64, t| size.max(t.abs()));
    let w = problem.wrench_matrix;
    let n = reference.len();
    // Multipliers of the equality from the free cables, by least squares.
    let free: Vec<usize> = (0..n).filter(|i| solution.active[*i].is_none()).collect();
    let free_matrix = DMatrix::from_fn(free.len(), 6, |row, column| w[(column, free[row])]);
    let right = DVector::from_fn(free.len(), |i, _| reference[free[i]] - solution.tensions[free[i]]);
    let multipliers = free_matrix.svd(true, true).solve(&right, 1e-12).unwrap();
    let slopes = w.transpose() * multipliers;
    let mut error = solution.residual.norm() / size;
    for i in 0..n {
        let (t, slope) = (solution.tensions[i], solution.tensions[i] - reference[i] + slopes[i]);
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
    let problem = Problem { wrench_matrix: &wrench_matrix, wrench: &wrench, limits };
    let solution = distribute(&problem, Objective::Nearest(&[0.0; 8])).unwrap();
    assert_eq!(solution.method, DistributionMethod::ClosedForm);
    assert!(optimality_error(&problem, &[0.0; 8], &solution) < 1e-12);
}

/// The value of an objective whose program is linear, by the simplex method; unknowns are the tensions, z,
/// and slacks.
fn by_simplex(problem: &Problem, objective: Objective) -> f64 {
    let n = problem.limits.len();
    let slacks = if let Objective::LeastGreatest = objective { n } else { 2 * n };
    let mut rows: Vec<Vec<f64>> = Vec::new();
    let mut right: Vec<f64> = Vec::new();
    for row in 0..6 {
        let mut coefficients: Vec<f64> = problem.wrench_matrix.row(row).iter().copied().collect();
        coefficients.push(if let Objective::GreatestWrench(d) = objective { d[row] } else { 0.0 });
        coefficients.extend(vec![0.0; slacks]);
        rows.push(coefficients);
        right.push(-problem.wrench[row]);
    }
    let mut add = |i: usize, of_z: f64, slack: usize, sign: f64, limit: f64| {
        let mut row = vec![0.0; n + 1 + slacks];
        (row[i], row[n], row[n + 1 + slack]) = (1.0, of_z, sign);
        rows.push(row);
        right.push(limit);
    };
    let mut of_z = [0.0, 1e5];
    let mut of_tensions = 0.0;
    let mut cost = 1.0;
    match objective {
        Objective::Nearest(_) => panic!("not linear"),
        Objective::LeastSum => (of_tensions, cost) = (-1.0, 0.0),
        Objective::LeastGreatest => {
            cost = -1.0;
            (0..n).for_each(|i| add(i, -1.0, i, 1.0, 0.0));
        }
        Objective::GreatestWrench(_) => {}
        Objective::GreatestMargin(limits) => {
            of_z = [-1e5, 1e5];
            for (i, TensionLimits { min, max }) in limits.iter().enumerate() {
                add(i, -1.0, 2 * i, -1.0, *min);
                add(i, 1.0, 2 * i + 1, 1.0, *max);
            }
        }
    }
    let mut coefficients = vec![of_tensions; n];
    coefficients.push(cost);
    coefficients.extend(vec![0.0; slacks]);
    let mut bounds: Vec<_> = problem.limits.iter().map(|limits| [limits.min, limits.max]).collect();
    bounds.push(of_z);
    bounds.extend(vec![[0.0, f64::INFINITY]; slacks]);
    let found = LinearProgram { objective: coefficients, rows, right, bounds, penalty: 1e4 }.solve().unwrap();
    assert!(found.residual < 1e-6, "{}", found.residual);
    if cost == 0.0 { found.values[..n].iter().sum() } else { found.values[n] }
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
        let problem = Problem { wrench_matrix: &wrench_matrix, wrench: &wrench, limits };
        match distribute(&problem, Objective::Nearest(&reference)) {
            Ok(solution) => {
                let by_clarabel = solution.method == DistributionMethod::InteriorPoint;
                let tolerance = if by_clarabel { 1e-6 } else { 1e-9 };
                let error = optimality_error(&problem, &reference, &solution);
                prop_assert!(error < tolerance, "{error:e} by {:?}", solution.method);
            }
            Err(TensionError::Infeasible { residual, tensions, certificate, .. }) => {
                prop_assert!(residual > 1e-6 * wrench.norm(), "{residual} N");
                // The certificate holds at the best of all tensions for it.
                let along = wrench_matrix.tr_mul(&certificate);
                let least = |slope: &f64| (slope * limits[0].min).min(slope * limits[0].max);
                prop_assert!(certificate.dot(&wrench) + along.iter().map(least).sum::<f64>() > 0.0);
                // The nearest tensions cannot be improved: the projected gradient of |W t + w|² vanishes.
                let open = &wrench + &wrench_matrix * DVector::from_column_slice(&tensions);
                for (t, slope) in tensions.iter().zip(&wrench_matrix.tr_mul(&open)) {
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

    #[test]
    fn norms_payloads_and_margins_are_those_of_the_simplex_method(
        x in -3.2..3.2f64, y in -1.7..1.7f64, z in 0.2..3.2f64, min in 1.0..400.0f64, width in 100.0..2000.0f64,
    ) {
        let (wrench_matrix, wrench) = straight(&Pose::at(x, y, z));
        let limits = &[TensionLimits { min, max: min + width }; 8];
        let problem = Problem { wrench_matrix: &wrench_matrix, wrench: &wrench, limits };
        let down = wrench.normalize();
        let wide = &[TensionLimits { min: 0.0, max: 1e5 }; 8];
        let margin = distribute(&Problem { limits: wide, ..problem }, Objective::GreatestMargin(limits)).unwrap();
        let expected = by_simplex(&Problem { limits: wide, ..problem }, Objective::GreatestMargin(limits));
        let near = |found: f64, expected: f64| (found - expected).abs() < 1e-6 * (1.0 + expected.abs());
        prop_assert!(near(margin.value, expected), "{} {expected}", margin.value);
        for objective in [Objective::LeastSum, Objective::LeastGreatest, Objective::GreatestWrench(&down)] {
            match distribute(&problem, objective) {
                Ok(found) => {
                    let expected = by_simplex(&problem, objective);
                    prop_assert!(near(found.value, expected), "{objective:?}: {} {expected}", found.value);
                    let size = found.tensions.iter().sum::<f64>();
                    prop_assert!(found.residual.norm() < 1e-8 * size, "{}", found.residual);
                    for (t, limits) in found.tensions.iter().zip(limits) {
                        prop_assert!((limits.min..=limits.max).contains(t));
                    }
                }
                Err(TensionError::Infeasible { .. }) => {
                    prop_assert!(margin.value < 0.0 || objective == Objective::GreatestWrench(&down));
                }
                Err(error) => prop_assert!(false, "{objective:?} {error}"),
            }
        }
    }
}

#[test]
fn six_cables_have_one_distribution() {
    let (all, wrench) = straight(&Pose::at(0.0, 0.0, 1.75));
    let wrench_matrix = all.select_columns(&[0, 1, 3, 4, 5, 6]);
    let wide = &[TensionLimits { min: 0.0, max: 1e6 }; 6];
    let problem = Problem { wrench_matrix: &wrench_matrix, wrench: &wrench, limits: wide };
    let solved = wrench_matrix.clone().lu().solve(&-&wrench).unwrap();
    match distribute(&problem, Objective::Nearest(&[50.0; 6])) {
        Ok(solution) => assert!((DVector::from_vec(solution.tensions) - solved).amax() < 1e-6),
        Err(TensionError::Infeasible { .. }) => assert!(solved.min() < 0.0),
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn cables_from_above_cannot_push_a_lifted_platform_down_and_the_error_says_what_is_missing() {
    let (wrench_matrix, wrench) = straight(&Pose::at(0.0, 0.0, 1.75));
    let limits = &[TensionLimits { min: 1.0, max: 10290.0 }; 8];
    let problem = Problem { wrench_matrix: &wrench_matrix, wrench: &-wrench, limits };
    for objective in [Objective::Nearest(&[0.0; 8]), Objective::LeastSum, Objective::LeastGreatest] {
        let error = distribute(&problem, objective).unwrap_err();
        let TensionError::Infeasible { residual, tensions, certificate, .. } = error else {
            panic!("{error}")
        };
        assert!((residual - 1765.8).abs() < 5.0, "{residual}");
        assert!(tensions.iter().all(|t| (t - 1.0).abs() < 1e-3), "{tensions:?}");
        assert!(certificate[2] > 0.9, "{certificate}");
    }
}

#[test]
fn a_lifted_platform_needs_a_mass_to_be_held() {
    // 1.1 times the weight pulls up: the least multiple of the weight is above zero, the greatest as without.
    let (wrench_matrix, weight) = straight(&Pose::at(0.0, 0.0, 1.75));
    let limits = &[TensionLimits { min: 1.0, max: 1000.0 }; 8];
    let lifted = -0.1 * &weight;
    let [held, without] = [&lifted, &weight].map(|wrench| {
        let problem = Problem { wrench_matrix: &wrench_matrix, wrench, limits };
        distribute(&problem, Objective::GreatestWrench(&weight)).unwrap().value
    });
    assert!((held - without - 1.1).abs() < 1e-8, "{held} {without}");
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
    let problem = Problem { wrench_matrix: &wrench_matrix, wrench: &wrench, limits };
    let field = |problem: Problem, objective: Objective| match distribute(&problem, objective) {
        Err(TensionError::Invalid { field, .. }) => field,
        other => panic!("{other:?}"),
    };
    assert_eq!(field(problem, Objective::Nearest(&[0.0; 7])), "reference");
    let unknown = DVector::repeat(6, f64::NAN);
    assert_eq!(field(Problem { wrench: &unknown, ..problem }, Objective::LeastSum), "wrench");
    assert_eq!(field(problem, Objective::GreatestWrench(&unknown)), "direction");
    for (min, max) in [(5.0, 1.0), (-1.0, 1.0)] {
        let wrong = &[TensionLimits { min, max }; 8];
        assert_eq!(field(Problem { limits: wrong, ..problem }, Objective::LeastSum), "limits");
        assert_eq!(field(problem, Objective::GreatestMargin(wrong)), "margin");
    }
}
