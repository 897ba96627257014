//! The stiffness at a pose against differences of the wrench on the platform, with moments.

use crate::common::robots;
use cdpr_cable::end_force;
use cdpr_evidence::accept;
use cdpr_robot::{Pose, Robot, Vector2, Vector3, Vector6, Wrench};
use cdpr_statics::stiffness::stiffness_at;
use cdpr_statics::{DirectProblem, DirectStart, Load, Unstable, inverse};
use nalgebra::Matrix6;

/// The wrench on the platform at a pose, of the cables with these lengths, the weight and the load.
fn unbalanced(robot: &Robot, lengths: &[f64], load: &Load, pose: &Pose) -> Vector6<f64> {
    let mut sum = (robot.weight(pose, load.payload) + load.wrench).to_vector();
    for (i, length) in lengths.iter().enumerate() {
        let span = robot.span(pose, i);
        let along = span.xy().normalize();
        let found = end_force(&robot.cable(i), *length, Vector2::new(span.xy().norm(), span.z)).unwrap();
        let [fx, fz] = found.catenary.force.into();
        let force = -Vector3::new(fx * along.x, fx * along.y, fz);
        sum += Wrench { force, moment: robot.anchor_arm(pose, i).cross(&force) }.to_vector();
    }
    sum
}

#[test]
fn the_stiffness_is_the_derivative_of_the_balance_under_a_moment() {
    for (robot, pose) in robots() {
        let size = robot.platform_size();
        let force = robot.platform.mass * robot.gravity.magnitude();
        let pose = pose.moved(Vector3::zeros(), Vector3::new(0.02, -0.01, 0.05));
        for share in [0.0, 0.02] {
            let moment = share * force * size * Vector3::new(1.0, -0.6, 0.8);
            let wrench = Wrench { force: share * force * Vector3::new(0.3, 0.5, -1.0), moment };
            let load = Load { payload: 0.1 * robot.platform.mass, wrench };
            let found = stiffness_at(&robot, pose, &load).unwrap();
            let lengths = inverse(&robot, &pose, &load).unwrap().lengths;
            // Differences of fourth order.
            let step = 1e-4 * size;
            let column = |j: usize| {
                let h = if j < 3 { step } else { step / size };
                let at = |h: f64| {
                    let mut motion = Vector6::zeros();
                    motion[j] = h;
                    let moved =
                        pose.moved(motion.fixed_rows::<3>(0).into(), motion.fixed_rows::<3>(3).into());
                    unbalanced(&robot, &lengths, &load, &moved)
                };
                (8.0 * (at(-h) - at(h)) - (at(-2.0 * h) - at(2.0 * h))) / (12.0 * h)
            };
            let expected = Matrix6::from_columns(&[0, 1, 2, 3, 4, 5].map(column));
            // In (dp, dφ times the size of the platform).
            let scale = Vector6::new(1.0, 1.0, 1.0, 1.0 / size, 1.0 / size, 1.0 / size);
            let scaled = |matrix: &Matrix6<f64>| matrix.component_mul(&(scale * scale.transpose()));
            let difference = scaled(&(found.matrix - expected)).amax() / scaled(&expected).amax();
            let skew = scaled(&(found.matrix - found.matrix.transpose()));
            println!(
                "{}, moment {:.0} N m: {difference:.1e} from differences, skew part {:.1e} of the largest \
                 entry",
                robot.name,
                moment.norm(),
                0.5 * skew.amax() / scaled(&expected).amax()
            );
            accept("V-DIRECT-013", difference);
            // Twice the skew part is the cross-product matrix of the moment, with the opposite sign.
            let cross =
                found.matrix.fixed_view::<3, 3>(3, 3) - found.matrix.fixed_view::<3, 3>(3, 3).transpose();
            let rounding = 1e-9 * found.matrix.fixed_view::<3, 3>(3, 3).amax();
            assert!((cross + moment.cross_matrix()).amax() < rounding, "{cross}");
            let symmetric = 0.5 * (found.matrix + found.matrix.transpose());
            assert_eq!(found.symmetric_part, symmetric);
            assert_eq!(found.symmetric_part, found.symmetric_part.transpose());

            // Displacements under a small wrench are those of the true tangent.
            let problem = DirectProblem::new(&robot, &lengths, &load).unwrap();
            let held = problem.with_unstable(Unstable::Accepted).direct(DirectStart::Pose(&pose)).unwrap();
            let linearization = problem.linearize(&held.equilibrium).unwrap();
            let motion = Vector6::new(1.0, -2.0, 0.5, 0.3 / size, 0.2 / size, -0.4 / size);
            let wrench = Wrench::from_vector(&(found.matrix * motion));
            let back = linearization.displacement(&wrench);
            let error = (back - motion).component_div(&scale).amax();
            assert!(error < 1e-6, "{}: {error:e}", robot.name);
        }
    }
}
