//! The direct model against equilibria computed in 40-digit arithmetic (`data/reference/README.md`).

use crate::equilibria::{number, robot, vector};
use cdpr_evidence::accept;
use cdpr_robot::{Matrix3, Pose, Rotation3, Vector3, Wrench};
use cdpr_statics::{DirectProblem, DirectStart, Load, direct};
use serde_json::Value;

pub(crate) fn rotation(value: &Value) -> Rotation3<f64> {
    Rotation3::from_matrix_unchecked(Matrix3::from_fn(|i, j| number(&value[i][j])))
}

#[test]
fn equilibria_match_40_digit_arithmetic() {
    let cases: Vec<Value> =
        serde_json::from_str(include_str!("../../../data/reference/equilibria.json")).unwrap();
    assert_eq!(cases.len(), 24);
    let mut failures = Vec::new();
    for case in &cases {
        let robot = robot(case);
        let lengths: Vec<f64> = case["unstrained_lengths"].as_array().unwrap().iter().map(number).collect();
        let wrench =
            Wrench { force: vector(&case["external_force"]), moment: vector(&case["external_moment"]) };
        let start =
            Pose { position: vector(&case["start_position"]), rotation: rotation(&case["start_rotation"]) };
        let expected = Pose { position: vector(&case["position"]), rotation: rotation(&case["rotation"]) };
        let solution = match direct(&robot, &lengths, &Load::wrench(wrench), DirectStart::Pose(&start)) {
            Ok(solution) => solution,
            Err(error) => {
                failures.push(format!("{}: {error}", robot.name));
                continue;
            }
        };
        let motion = expected.motion_to(&solution.equilibrium.pose);
        let (position, angle) = (motion.fixed_rows::<3>(0).norm(), motion.fixed_rows::<3>(3).norm());
        let force = solution
            .equilibrium
            .cable_forces
            .iter()
            .enumerate()
            .map(|(i, f)| {
                (f.x - number(&case["cable_force_horizontal"][i]))
                    .hypot(f.y - number(&case["cable_force_vertical"][i]))
            })
            .fold(0.0, f64::max);
        let report = &solution.report;
        let load = Load::wrench(wrench);
        let proof = DirectProblem::new(&robot, &lengths, &load).unwrap().certify(&solution).unwrap();
        let line = format!(
            "{:14} {:9.1e} m {:9.1e} rad {:9.1e} N (proved {:7.1e} m {:7.1e} rad {:7.1e} N), {:?} {} \
             iterations, \
             slack {:?}",
            robot.name,
            position,
            angle,
            force,
            proof.position,
            proof.rotation,
            proof.force,
            report.method,
            report.iterations,
            report.slack
        );
        accept("V-DIRECT-001", position);
        accept("V-DIRECT-002", angle);
        accept("V-DIRECT-003", force);
        // Inputs of the reference are decimal strings and `rho g` a rounded product: half a unit of each
        // moves the answer.
        let inputs = 2e-15;
        let far = expected.position.norm() + lengths.iter().copied().fold(0.0, f64::max);
        assert!(
            position <= proof.position + inputs * far && angle <= proof.rotation + inputs * far,
            "{line}"
        );
        assert!(proof.position < 1e-10 && proof.rotation < 1e-10 && proof.is_stable(), "{line}");
        let linearization =
            DirectProblem::new(&robot, &lengths, &load).unwrap().linearize(&solution.equilibrium).unwrap();
        let least = linearization.symmetric_stiffness().symmetric_eigenvalues().min();
        let expected_least = number(&case["stiffness_min_eigenvalue"]);
        // A moment has no Hessian; how the reference symmetrizes it is not said.
        if wrench.moment == Vector3::zeros() {
            assert!(
                (least - expected_least).abs() < 1e-3 * expected_least,
                "{line}: {least}, {expected_least} N/m"
            );
        }
        if !(position < 1e-9 && angle < 1e-9 && force < 1e-6) {
            failures.push(line);
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}
