//! Robots whose cables have a piecewise linear law, by every model.

use crate::common::{alone, caroca, observed};
use cdpr_robot::{Parameter, PiecewiseLaw, Pose, Robot, Segment, UnitQuaternion, Vector3, deviations};
use cdpr_statics::batch::Observation;
use cdpr_statics::continuation::{Setting, follow};
use cdpr_statics::{
    DirectProblem, DirectStart, Load, Observer, StaticsError, Tracker, WantedPose, deflection, derivatives,
    direct, inverse,
};

/// A law from the tension at which each of its segments begins and its stiffness over the cable's.
pub(crate) fn law(segments: &[(f64, f64)]) -> PiecewiseLaw {
    let segment = |&(tension, ratio): &(f64, f64)| Segment { tension, ratio };
    PiecewiseLaw::new(0.0, &segments.iter().map(segment).collect::<Vec<_>>()).unwrap()
}

fn with(segments: &[(f64, f64)]) -> Robot {
    let mut robot = caroca();
    for cable in &mut robot.cables {
        cable.properties.law = Some(law(segments));
    }
    robot
}

/// The moduli of Table 2 while loading, in GPa from 0, 5, 10, 15, 20 % of the breaking force.
fn loading() -> Robot {
    let force = 10290.0;
    let moduli = [72.5, 83.2, 94.8, 102.067, 104.9];
    let segments: Vec<_> =
        moduli.iter().enumerate().map(|(k, modulus)| (0.05 * k as f64 * force, modulus / 102.2)).collect();
    with(&segments)
}

/// A law with kinks among the tensions of the loaded robot, hardly two cables on the same piece.
fn kinked() -> Robot {
    with(&[(0.0, 0.7), (545.0, 0.75), (560.0, 0.8), (575.0, 0.85), (690.0, 0.9), (715.0, 1.0)])
}

fn poses() -> [Pose; 2] {
    [Pose::at(0.0, 0.0, 1.75), Pose::at(0.7, -0.4, 1.5)]
}

#[test]
fn pieces_of_the_same_modulus_are_the_linear_robot() {
    let (linear, pieces) = (caroca(), with(&[(0.0, 1.0), (300.0, 1.0), (570.0, 1.0), (700.0, 1.0)]));
    for pose in poses() {
        let [a, b] = [&linear, &pieces].map(|robot| deflection(robot, &pose, &Load::payload(50.0)).unwrap());
        for (one, other) in a.lengths.iter().zip(&b.lengths) {
            assert!((one - other).abs() < 1e-12);
        }
        assert!((a.displacement() - b.displacement()).norm() < 1e-12);
    }
}

#[test]
fn the_direct_model_finds_the_pose_of_the_inverse_model() {
    for robot in [loading(), kinked()] {
        for pose in poses() {
            let wanted = inverse(&robot, &pose, &Load::payload(50.0)).unwrap();
            let off = Pose {
                position: pose.position + Vector3::new(0.1, -0.2, 0.15),
                rotation: UnitQuaternion::from_euler_angles(0.1, -0.05, 0.2).to_rotation_matrix(),
            };
            let found =
                direct(&robot, &wanted.lengths, &Load::payload(50.0), DirectStart::Pose(&off)).unwrap();
            assert!((found.equilibrium.pose.position - pose.position).norm() < 1e-11);
            assert!(found.stability.is_stable() && found.report.residual.force < 1e-8);
            for (one, other) in found.equilibrium.tensions().iter().zip(&wanted.tensions) {
                assert!((one - other).abs() < 1e-6, "{one} {other}");
            }
        }
    }
}

#[test]
fn derivatives_are_those_of_differences() {
    let load = Load::payload(50.0);
    for robot in [loading(), kinked()] {
        let pose = Pose::at(0.7, -0.4, 1.5);
        let exact = derivatives(&robot, &pose, &load).unwrap();
        let displacement = exact.displacement();
        for (name, step) in [
            ("youngs_modulus", 1e7),
            ("linear_density", 1e-5),
            ("mass", 1e-3),
            ("a2.x", 1e-6),
            ("b5.z", 1e-6),
        ] {
            let at = |h: f64| {
                let perturbed = robot.perturbed(&deviations(&robot, &[(name, h)]).unwrap()).unwrap();
                deflection(
                    &perturbed.robot,
                    WantedPose::at(&pose).tension_offsets(&perturbed.tension_offsets),
                    &load,
                )
                .unwrap()
                .displacement()
            };
            let slope = (at(step) - at(-step)) / (2.0 * step);
            let parameter: Parameter = name.parse().unwrap();
            let column = exact.inputs.parameters.iter().position(|p| *p == parameter).unwrap();
            let error = (slope - displacement.column(column)).norm();
            println!("{name}: {error:e} of {:e}", slope.norm());
            assert!(error < 1e-4 * slope.norm() + 1e-12 / step, "{name}: {error:e} of {:e}", slope.norm());
        }
    }
}

#[test]
fn a_deviation_of_the_modulus_scales_the_whole_law() {
    let robot = kinked();
    let softer =
        robot.perturbed(&deviations(&robot, &[("youngs_modulus", -0.1 * 1.022e11)]).unwrap()).unwrap().robot;
    for tension in [100.0, 550.0, 1000.0] {
        assert!((softer.modulus_at(0, tension) / robot.modulus_at(0, tension) - 0.9).abs() < 1e-12);
    }
}

#[test]
fn the_stiffness_is_that_of_small_loads() {
    let (robot, pose) = (loading(), Pose::at(0.0, 0.0, 1.75));
    let gone = deflection(&robot, &pose, &Load::payload(0.1)).unwrap();
    let predicted = gone.small_displacement(&robot, &Load::payload(0.1)).unwrap();
    assert!((gone.displacement() - predicted).norm() < 1e-3 * predicted.norm());
    let linearization = DirectProblem::new(&robot, &gone.lengths, &Load::none())
        .unwrap()
        .linearize(&gone.unloaded.equilibrium)
        .unwrap();
    assert!(linearization.symmetric_stiffness().symmetric_eigenvalues().min() > 0.0);
}

#[test]
fn lanes_and_certificates_never_take_such_a_cable_for_a_linear_one() {
    let (robot, pose, load) = (kinked(), Pose::at(0.0, 0.0, 1.75), Load::payload(50.0));
    let wanted = deflection(&robot, &pose, &load).unwrap();
    let observed = observed::<Observation>(&Observer::new(&robot, pose, &load).unwrap(), &[0.0; 62]);
    let displacement = observed[0].as_ref().unwrap().displacement;
    assert!((displacement - wanted.displacement()).norm() < 1e-12);
    let linear = deflection(&caroca(), &pose, &load).unwrap();
    assert!((wanted.displacement() - linear.displacement()).norm() > 1e-4);
    let mut tracker =
        Tracker::new(&robot, &wanted.lengths, &Load::none(), &wanted.unloaded.equilibrium).unwrap();
    let tracked = tracker.update(&wanted.lengths, &load).unwrap().pose.position;
    assert!((tracked - wanted.loaded.equilibrium.pose.position).norm() < 1e-12);
    let refused = DirectProblem::new(&robot, &wanted.lengths, &load).unwrap().certify(&wanted.loaded);
    assert!(matches!(refused, Err(StaticsError::NotCertified { .. })));
    let [from, to] = [Load::none(), load].map(|load| Setting { lengths: wanted.lengths.clone(), load });
    let path = follow(&robot, &from, &to, DirectStart::Near(&wanted.unloaded.equilibrium)).unwrap();
    let end = &path.steps.last().unwrap().solution.equilibrium;
    assert!(
        path.lost.is_none() && (end.pose.position - wanted.loaded.equilibrium.pose.position).norm() < 1e-11
    );
}

#[test]
fn cables_that_span_many_kinks_are_observed_in_lanes() {
    // Ten newtons of weight a cable, and a kink every newton.
    let segment = |k: u32| (400.0 + f64::from(k), 0.7 + 1e-3 * f64::from(k));
    let segments: Vec<_> = [(0.0, 0.7)].into_iter().chain((1..400).map(segment)).collect();
    let mut robot = with(&segments);
    for cable in &mut robot.cables {
        cable.properties.linear_density *= 2.0;
    }
    let (pose, load) = (Pose::at(0.7, -0.4, 1.5), Load::payload(50.0));
    let observer = Observer::new(&robot, pose, &load).unwrap();
    let mut row = [0.0; 62];
    for k in 0..5 {
        row[2] = 2e9 * f64::from(k);
        let [in_lanes, alone] = [observed(&observer, &row).remove(0), alone(&observer, &row)]
            .map(Result::<Observation, _>::unwrap);
        assert_eq!(in_lanes.scalar, None);
        assert!((in_lanes.displacement - alone.displacement).norm() < 1e-12);
    }
}

#[test]
fn a_weightless_cable_is_slack_up_to_its_length_at_rest() {
    let mut robot = caroca();
    let strain = 1e-3;
    for cable in &mut robot.cables {
        let properties = &mut cable.properties;
        properties.linear_density = 0.0;
        let at_rest = strain * properties.axial_stiffness();
        properties.law = Some(PiecewiseLaw::new(at_rest, &[Segment { tension: 0.0, ratio: 1.0 }]).unwrap());
    }
    let pose = Pose::at(0.0, 0.0, 1.75);
    let mut lengths = inverse(&robot, &pose, &Load::none()).unwrap().lengths;
    lengths[3] *= 1.1;
    let loose = direct(&robot, &lengths, &Load::none(), DirectStart::Pose(&pose)).unwrap();
    let chord = robot.span(&loose.equilibrium.pose, 3).norm();
    assert_eq!(loose.report.slack, [3]);
    // Its points are farther apart than its unstrained length, and nearer than its length without tension.
    lengths[3] = chord / (1.0 + 0.5 * strain);
    let found = direct(&robot, &lengths, &Load::none(), DirectStart::Near(&loose.equilibrium)).unwrap();
    let chord = robot.span(&found.equilibrium.pose, 3).norm();
    assert!(lengths[3] < chord && chord < lengths[3] * (1.0 + strain), "{} {chord}", lengths[3]);
    assert_eq!(found.equilibrium.tensions()[3], 0.0);
    assert_eq!(found.report.slack, [3]);
}
