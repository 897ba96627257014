//! Robots with fewer cables than six: suspended platforms, point masses, planar robots; against arithmetic of
//! 20 digits (`data/reference/README.md`) and closed forms.

use crate::common::cogiro;
use crate::equilibria::{number, vector};
use crate::pulleys::robot;
use crate::reference::rotation;
use cdpr_evidence::accept;
use cdpr_robot::{
    CableEnd, CableProperties, Parameter, Plane, Platform, Pose, Robot, RobotCable, TensionLimits, Vector3,
    Vector6, Wrench,
};
use cdpr_statics::stiffness::Mode;
use cdpr_statics::{
    DirectProblem, DirectSolution, DirectStart, Load, StaticsError, Unstable, direct, inverse, rough_pose,
};
use nalgebra::Matrix6;
use serde_json::Value;

pub(crate) fn cases() -> Vec<Value> {
    let text = include_str!("../../../data/reference/few_cables.json");
    let file: Value = serde_json::from_str(text).unwrap();
    file["cases"].as_array().unwrap().clone()
}

pub(crate) fn load(case: &Value) -> Load {
    Load::wrench(Wrench { force: vector(&case["force"]), moment: vector(&case["moment"]) })
}

pub(crate) fn pose(case: &Value) -> Pose {
    Pose { position: vector(&case["position"]), rotation: rotation(&case["rotation"]) }
}

#[test]
fn equilibria_on_few_cables_match_arithmetic_of_20_digits() {
    for case in cases() {
        let robot = robot(&case);
        robot.validate().unwrap();
        let kind = case["kind"].as_str().unwrap();
        let lengths = match &case["unstrained_lengths"] {
            Value::Null => &case["unstrained_lengths_found"],
            lengths => lengths,
        };
        let lengths: Vec<f64> = lengths.as_array().unwrap().iter().map(number).collect();
        let load = load(&case);
        let expected = pose(&case);
        let start = match &case["start_rotation"] {
            Value::Null => expected.moved(Vector3::new(0.02, -0.03, 0.05), Vector3::new(0.05, -0.02, 0.01)),
            // Nothing determines the yaw: from where the cable is taut, Newton's method keeps it.
            _ if kind == "one" => expected.moved(Vector3::new(0.0, 0.0, -1e-3), Vector3::zeros()),
            rows => Pose { position: vector(&case["start_position"]), rotation: rotation(rows) },
        };
        let problem = DirectProblem::new(&robot, &lengths, &load).unwrap();
        let found = problem.with_unstable(Unstable::Accepted).direct(DirectStart::Pose(&start)).unwrap();
        let mut motion = expected.motion_to(&found.equilibrium.pose);
        // A neutral motion may be any.
        for Mode { translation, rotation, .. } in found.stability.neutral() {
            let share = rotation.dot(&motion.fixed_rows::<3>(3)) / rotation.norm_squared();
            let [t, r] = [translation, rotation].map(|part| part * share);
            motion -= Vector6::new(t.x, t.y, t.z, r.x, r.y, r.z);
        }
        let (position, angle) = (motion.fixed_rows::<3>(0).norm(), motion.fixed_rows::<3>(3).norm());
        let tensions = case["cables"].as_array().unwrap();
        let tensions = tensions.iter().map(|cable| number(&cable["tension_at_anchor"]));
        let each = found.equilibrium.tensions().into_iter().zip(tensions);
        let worst = each.map(|(t, exact)| (t / exact - 1.0).abs()).fold(0.0, f64::max);
        let exact = Matrix6::from_fn(|i, j| number(&case["stiffness"][i][j]));
        let stiffness = *problem.linearize(&found.equilibrium).unwrap().stiffness();
        let off = (stiffness - exact).norm() / exact.norm();
        let line = format!(
            "{kind:22} {position:8.1e} m {angle:8.1e} rad, tensions {worst:8.1e}, stiffness {off:8.1e}, \
             {} {}",
            found.report.method, found.report.iterations
        );
        accept("V-DIRECT-007", position);
        accept("V-DIRECT-008", worst);
        accept("V-DIRECT-009", off);
        assert!(angle < 1e-9, "{line}");
        let stable = case["stable"].as_bool().unwrap_or(true);
        assert_eq!(found.stability.is_stable(), stable, "{line}");
        assert_eq!(found.stability.neutral().len(), usize::from(kind == "one"), "{line}");
        // A search by descent ends at a stable equilibrium, wherever that is.
        assert!(problem.direct(DirectStart::Pose(&start)).unwrap().stability.is_stable(), "{line}");
    }
}

/// Cables that stretch by 1e-3 under the load of a kilogram and weigh nothing.
pub(crate) fn string() -> CableProperties {
    CableProperties::linear(1.0, 0.0, 9810.0)
}

pub(crate) fn suspended(points: &[[[f64; 3]; 2]], properties: &CableProperties, platform: Platform) -> Robot {
    let cable = |[exit, anchor]: &[[f64; 3]; 2]| {
        RobotCable::between(Vector3::from(*exit), Vector3::from(*anchor), properties.clone())
    };
    let robot = Robot {
        name: "suspended".to_owned(),
        provenance: Default::default(),
        gravity: 9.81.into(),
        platform,
        tension_limits: TensionLimits { min: 1e-3, max: 1e6 },
        max_at: CableEnd::Anchor,
        ground_z: None,
        plane: None,
        tension_reference: None,
        distribution: Default::default(),
        cables: points.iter().map(cable).collect(),
    };
    robot.validate().unwrap();
    robot
}

fn point(mass: f64) -> Platform {
    Platform { point: true, ..Platform::new(mass, Vector3::zeros()) }
}

pub(crate) fn solve(robot: &Robot, lengths: &[f64], start: &Pose) -> DirectSolution {
    let solution = direct(robot, lengths, &Load::none(), DirectStart::Pose(start)).unwrap();
    assert!(solution.stability.is_stable());
    solution
}

#[test]
fn a_point_mass_on_three_strings_hangs_where_three_springs_hold_it() {
    // Exit points at 120 degrees, 3 m from the axis; the point hangs 4 m below, each string is 5 m long.
    let exit = |k: f64| {
        let angle: f64 = k * std::f64::consts::TAU / 3.0;
        [[3.0 * angle.cos(), 3.0 * angle.sin(), 4.0], [0.0; 3]]
    };
    let robot = suspended(&[exit(0.0), exit(1.0), exit(2.0)], &string(), point(6.0));
    // 3 t 4/5 = m g
    let tension = 6.0 * 9.81 / 3.0 * 1.25;
    let length = 5.0 / (1.0 + tension / 9810.0);
    let start = Pose::at(0.4, -0.3, 0.7).moved(Vector3::zeros(), Vector3::new(0.2, 0.1, 0.0));
    let found = solve(&robot, &[length; 3], &start);
    let DirectSolution { equilibrium, stability, .. } = &found;
    assert!(equilibrium.pose.position.norm() < 1e-12, "{}", equilibrium.pose.position);
    // Its rotation is held.
    assert!((equilibrium.pose.rotation.matrix() - start.rotation.matrix()).norm() < 1e-15);
    assert!(equilibrium.tensions().iter().all(|t| (t / tension - 1.0).abs() < 1e-12));
    // K = sum (EA/L - t/l) u uᵀ + t/l (1 - u uᵀ) with u = (3/5, 4/5)
    let (along, across) = (9810.0 / length, tension / 5.0);
    let vertical = 3.0 * (0.64 * along + 0.36 * across);
    let horizontal = 3.0 * across + 1.5 * 0.36 * (along - across);
    assert!(stability.neutral().is_empty());
    let [first, second, third] = stability.eigenvalues()[..] else { panic!("three motions") };
    assert!((first / horizontal - 1.0).abs() < 1e-9 && (second / horizontal - 1.0).abs() < 1e-9);
    assert!((third / vertical - 1.0).abs() < 1e-9);
    let lengths = [length; 3];
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    let linear = problem.linearize(equilibrium).unwrap();
    let wrench = Wrench { force: Vector3::new(2.0, 0.0, 3.0), moment: Vector3::new(1.0, 1.0, 1.0) };
    let displacement = linear.displacement(&wrench);
    let expected = Vector6::new(2.0 / horizontal, 0.0, 3.0 / vertical, 0.0, 0.0, 0.0);
    assert!((displacement - expected).norm() < 1e-9 * expected.norm(), "{displacement}");
    // Three cables for three freedoms: the inverse model has one answer.
    let held = inverse(&robot, &Pose::at(0.0, 0.0, 0.0), &Load::none()).unwrap();
    assert!(held.lengths.iter().all(|l| (l / length - 1.0).abs() < 1e-12));
    assert!(held.residual.force < 1e-10 && held.residual.moment == 0.0);
    assert_eq!(held.multipliers.fixed_rows::<3>(3).norm(), 0.0);
}

#[test]
fn a_planar_robot_is_the_spatial_one_whose_other_motions_are_held() {
    let platform = Platform::new(8.0, Vector3::new(0.02, 0.0, -0.1));
    let points = [
        [[-3.0, 0.0, 4.0], [-0.3, 0.0, 0.1]],
        [[3.0, 0.0, 4.0], [0.3, 0.0, 0.1]],
        [[0.5, 0.0, 5.0], [-0.1, 0.0, 0.2]],
    ];
    let rope = CableProperties::linear(1.0, 0.08, 5e4);
    let planar =
        |count: usize| Robot { plane: Some(Plane::Xz), ..suspended(&points[..count], &rope, platform) };
    let start = Pose::at(0.2, 0.0, 1.0).moved(Vector3::zeros(), Vector3::new(0.0, 0.1, 0.0));
    let held = inverse(&planar(3), &start, &Load::none()).unwrap();
    assert!(held.residual.force < 1e-10 && held.residual.moment < 1e-10);
    for count in [2, 3] {
        let robot = planar(count);
        let lengths = &held.lengths[..count];
        let found = solve(&robot, lengths, &start.moved(Vector3::new(0.2, 0.0, -0.2), Vector3::zeros()));
        let stability = &found.stability;
        assert_eq!((stability.eigenvalues().len(), stability.neutral().len()), (3, 0));
        // The platform lies in the plane of the cables, where nothing pushes it out of it.
        let space = Robot { plane: None, ..robot.clone() };
        let problem = DirectProblem::new(&space, lengths, &Load::none()).unwrap();
        let residual = problem.residual(&found.equilibrium).unwrap();
        assert!(residual.force < 1e-9 && residual.moment < 1e-9, "{residual:?}");
        // Held out of it, it stays there under any load.
        let push = Wrench { force: Vector3::new(0.0, 90.0, 0.0), moment: Vector3::new(7.0, 0.0, 9.0) };
        let pushed =
            direct(&robot, lengths, &Load::wrench(push), DirectStart::Near(&found.equilibrium)).unwrap();
        assert!(found.equilibrium.pose.motion_to(&pushed.equilibrium.pose).norm() < 1e-12);
        if count == 3 {
            assert!(start.motion_to(&found.equilibrium.pose).norm() < 1e-9);
        }
    }
}

#[test]
fn a_platform_on_one_string_is_a_pendulum_with_a_neutral_rotation() {
    let (mass, depth) = (5.0, 0.4);
    let platform = Platform::new(mass, Vector3::new(0.0, 0.0, -depth));
    let robot = suspended(&[[[1.0, 2.0, 3.0], [0.0; 3]]], &string(), platform);
    let tension = mass * 9.81;
    let length = 2.0 / (1.0 + tension / 9810.0);
    let start = Pose::at(1.3, 1.8, 0.8).moved(Vector3::zeros(), Vector3::new(0.3, -0.2, 0.5));
    let found = solve(&robot, &[length], &start);
    assert!((found.equilibrium.pose.position - Vector3::new(1.0, 2.0, 1.0)).norm() < 1e-10);
    let [yaw] = found.stability.neutral() else { panic!("{:?}", found.stability.neutral()) };
    assert!(yaw.translation.norm() < 1e-9 && yaw.rotation.xy().norm() < 1e-9 * yaw.rotation.z.abs());
    // K of the swing about each horizontal axis at ℓ = 2 mm: t/l along x, t d about y.
    let values = found.stability.eigenvalues();
    let length_of_motions = found.stability.characteristic_length();
    let swing = tension * depth / length_of_motions.powi(2);
    let mut expected = [tension / 2.0, tension / 2.0, swing, swing, 9810.0 / length];
    expected.sort_by(f64::total_cmp);
    for (value, expected) in values.iter().zip(expected) {
        assert!((value / expected - 1.0).abs() < 1e-6, "{values:?} {expected:?}");
    }
    // Where it hangs already, it stays, yaw included.
    let again = solve(&robot, &[length], &found.equilibrium.pose);
    assert!(found.equilibrium.pose.motion_to(&again.equilibrium.pose).norm() < 1e-12);
    // A force moves it as it moves a pendulum, and a moment about the cable is nobody's.
    let lengths = [length];
    let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
    let linear = problem.linearize(&found.equilibrium).unwrap();
    let wrench = Wrench { force: Vector3::new(1.0, 0.0, 0.0), moment: Vector3::new(0.0, 0.0, 2.0) };
    let displacement = linear.displacement(&wrench);
    let expected = Vector6::new(2.0 / tension, 0.0, 0.0, 0.0, 0.0, 0.0);
    assert!((displacement - expected).norm() < 1e-9, "{displacement}");
}

#[test]
fn four_cables_of_cogiro_carry_its_platform_from_any_start() {
    let whole = cogiro();
    // The center of mass lies below the anchor points of the upper cables.
    let cables: Vec<_> = [1, 3, 5, 7].map(|i| whole.cables[i].clone()).to_vec();
    let robot = Robot { cables, ..whole };
    let rest = Pose::at(0.4, -0.2, 2.0);
    let lengths: Vec<f64> = (0..4).map(|i| robot.span(&rest, i).norm()).collect();
    let mut found: Vec<DirectSolution> = Vec::new();
    for k in 0..6 {
        let k = f64::from(k);
        let start = rest.moved(
            Vector3::new(0.8 * k.sin(), 0.5 * k.cos(), -0.3 * k),
            0.1 * Vector3::new((2.0 * k).sin(), k.cos(), (3.0 * k).sin()),
        );
        found.push(solve(&robot, &lengths, &start));
    }
    found.push(solve(&robot, &lengths, &rough_pose(&robot, &lengths)));
    for other in &found {
        let motion = found[0].equilibrium.pose.motion_to(&other.equilibrium.pose);
        assert!(motion.norm() < 1e-9, "{motion}");
        assert!(other.stability.neutral().is_empty() && other.report.residual.force < 1e-8);
    }
}

#[test]
fn slack_cables_without_weight_and_a_platform_without_weight_have_no_pose() {
    let platform = Platform::new(5.0, Vector3::zeros());
    let points = [[[-1.0, 0.0, 2.0], [-0.1, 0.0, 0.0]], [[1.0, 0.0, 2.0], [0.1, 0.0, 0.0]]];
    let robot = Robot { gravity: 0.0.into(), ..suspended(&points, &string(), platform) };
    let start = Pose::at(0.0, 0.0, 1.0);
    let error = direct(&robot, &[4.0, 4.0], &Load::none(), DirectStart::Pose(&start)).unwrap_err();
    assert!(matches!(error, StaticsError::Indifferent { .. }), "{error}");
}

#[test]
fn derivatives_of_few_cables_are_those_of_differences() {
    let hung = {
        let platform = Platform::new(5.0, Vector3::new(0.02, -0.03, -0.4));
        suspended(&[[[1.0, 2.0, 3.0], [0.1, 0.0, 0.05]]], &CableProperties::linear(1.0, 0.3, 4e4), platform)
    };
    let four = Robot::from_json(include_str!("../../../data/robots/four-cables.json")).unwrap();
    let mut planar = Robot { plane: Some(Plane::Xz), ..four.clone() };
    planar.cables.truncate(2);
    planar.cables.iter_mut().for_each(|cable| (cable.exit_point.y, cable.anchor_point.y) = (0.0, 0.0));
    for (robot, start) in
        [(hung, Pose::at(1.0, 2.0, 1.2)), (four, Pose::at(0.3, 0.2, 2.0)), (planar, Pose::at(0.4, 0.0, 2.0))]
    {
        let lengths: Vec<f64> = (0..robot.cables.len()).map(|i| robot.span(&start, i).norm()).collect();
        let problem = DirectProblem::new(&robot, &lengths, &Load::none()).unwrap();
        let found = problem.direct(DirectStart::Pose(&start)).unwrap();
        let exact = problem.derivatives(&found.equilibrium).unwrap();
        let length = found.stability.characteristic_length();
        for (column, parameter) in Parameter::of(&robot).iter().enumerate() {
            if matches!(parameter, Parameter::TensionOffset(_)) {
                continue;
            }
            let h = if matches!(parameter, Parameter::YoungsModulus) {
                1e-4 * robot.cables[0].properties.youngs_modulus
            } else {
                1e-4
            };
            let at = |change: f64| {
                let mut deviations = vec![0.0; Parameter::of(&robot).len()];
                deviations[column] = change;
                let moved = robot.perturbed(&deviations).unwrap().robot;
                let near = DirectStart::Near(&found.equilibrium);
                let solution = direct(&moved, &lengths, &Load::none(), near).unwrap();
                let mut motion = found.equilibrium.pose.motion_to(&solution.equilibrium.pose);
                // What is pinned is not compared: neutral motions.
                for mode in found.stability.neutral() {
                    let along = mode.translation.dot(&motion.fixed_rows::<3>(0))
                        + length * length * mode.rotation.dot(&motion.fixed_rows::<3>(3));
                    let mut unit = Vector6::zeros();
                    unit.fixed_rows_mut::<3>(0).copy_from(&mode.translation);
                    unit.fixed_rows_mut::<3>(3).copy_from(&mode.rotation);
                    motion -= along * unit;
                }
                motion
            };
            let slope = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
            let error = (slope - exact.pose.column(column)).norm();
            let rounding = 1e-12 / h;
            assert!(
                error < 1e-6 * slope.norm() + rounding,
                "{} {parameter}: {error:e} of {}",
                robot.name,
                slope.norm()
            );
        }
    }
}
