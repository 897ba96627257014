//! The assembled equations of an equilibrium, their Jacobian, and the step with the cables eliminated.

use cdpr_cable::end_force;
use cdpr_robot::{Pose, Robot, Vector2, Vector3, Wrench};
use cdpr_statics::{DirectProblem, Equilibrium, Load};
use nalgebra::DVector;
use proptest::prelude::*;

/// Each cable in its own equilibrium at a pose.
fn spanning(robot: &Robot, lengths: &[f64], pose: &Pose) -> Equilibrium {
    let force = |i: usize| {
        let span = robot.span(pose, i);
        let end = Vector2::new(span.xy().norm(), span.z);
        end_force(&robot.cable(i), lengths[i], end).unwrap().catenary.force
    };
    Equilibrium { pose: *pose, cable_forces: (0..lengths.len()).map(force).collect() }
}

fn moved(equilibrium: &Equilibrium, step: &DVector<f64>) -> Equilibrium {
    let cable_forces = equilibrium.cable_forces.iter().enumerate();
    Equilibrium {
        pose: equilibrium.pose.moved(step.fixed_rows::<3>(0).into(), step.fixed_rows::<3>(3).into()),
        cable_forces: cable_forces
            .map(|(i, force)| force + Vector2::new(step[6 + 2 * i], step[7 + 2 * i]))
            .collect(),
    }
}

/// CAROCA or CoGiRo somewhere, with cables from taut to slack and a wrench.
fn any_state() -> impl Strategy<Value = (Robot, Vec<f64>, Load, Pose)> {
    let slack = prop::collection::vec(prop_oneof![-1e-3..1e-3f64, 1e-3..0.2f64], 8);
    (any::<bool>(), prop::array::uniform6(-1.0..1.0f64), prop::array::uniform6(-1.0..1.0f64), slack).prop_map(
        |(caroca, m, w, slack)| {
            let (text, height) = if caroca {
                (include_str!("../../../data/robots/caroca.json"), 1.75)
            } else {
                (include_str!("../../../data/robots/cogiro.json"), 2.5)
            };
            let robot = Robot::from_json(text).unwrap();
            let pose = Pose::at(2.0 * m[0], m[1], height + m[2])
                .moved(Vector3::zeros(), 0.3 * Vector3::new(m[3], m[4], m[5]));
            let lengths = (0..8).map(|i| robot.span(&pose, i).norm() * (1.0 + slack[i])).collect();
            let wrench = Wrench {
                force: 100.0 * Vector3::new(w[0], w[1], w[2]),
                moment: 20.0 * Vector3::new(w[3], w[4], w[5]),
            };
            (robot, lengths, Load { payload: 20.0, wrench }, pose)
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 300, failure_persistence: None, ..ProptestConfig::default()
    })]

    #[test]
    fn the_jacobian_is_the_derivative_of_the_equations(
        (robot, lengths, load, pose) in any_state(), misfit in prop_oneof![Just(1.0), 0.5..2.0f64],
    ) {
        let problem = DirectProblem::new(&robot, &lengths, &load).unwrap();
        let mut state = spanning(&robot, &lengths, &pose);
        // Forces that need not fit the pose, too.
        state.cable_forces.iter_mut().for_each(|force| *force *= misfit);
        let jacobian = problem.jacobian(&state).unwrap();
        for column in 0..jacobian.ncols() {
            let force = state.cable_forces.get(column.wrapping_sub(6) / 2);
            let by_force = force.map_or(1.0, |f| 2e-4 * f.x.max(1e-3 * f.norm()));
            let h = if column < 6 { 1e-4 } else { by_force };
            let at = |h: f64| {
                let mut step = DVector::zeros(jacobian.nrows());
                step[column] = h;
                problem.equations(&moved(&state, &step)).unwrap()
            };
            let slope = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
            let error = (&slope - jacobian.column(column)).norm();
            let rounding = 1e-15 * (at(0.0).norm() + 1e4) / h;
            let allowed = 1e-6 * jacobian.column(column).norm() + rounding;
            prop_assert!(error < allowed, "column {column}: {error:e}");
        }
    }

    #[test]
    fn eliminating_the_cables_is_newtons_step_of_the_assembled_equations(
        (robot, lengths, load, pose) in any_state(), misfit in prop_oneof![Just(1.0), 0.8..1.25f64],
    ) {
        let problem = DirectProblem::new(&robot, &lengths, &load).unwrap();
        let mut state = spanning(&robot, &lengths, &pose);
        state.cable_forces.iter_mut().for_each(|force| *force *= misfit);
        let right = -problem.equations(&state).unwrap();
        let assembled = problem.jacobian(&state).unwrap().lu().solve(&right).unwrap();
        let expected = assembled.fixed_rows::<6>(0);
        let reduced = problem.newton_step(&state).unwrap();
        // The plane of a cable turns by the distance that it has, not by that of its two points.
        let close = if misfit == 1.0 { 1e-6 } else { 0.05 };
        prop_assert!((reduced - expected).norm() < close * expected.norm(), "{reduced} {expected}");
    }
}
