//! Questions about the values of a robot file and about deviations: the field that is wrong is named.

#![allow(clippy::unwrap_used, clippy::panic)]

use cdpr_robot::{Doubt, Parameter, Plane, Pose, Robot, Vector3, Wrench, plausible, rotation_by_angles};

fn named(name: &str) -> Robot {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/robots");
    Robot::from_json(&std::fs::read_to_string(format!("{folder}/{name}.json")).unwrap()).unwrap()
}

fn only(doubts: Vec<Doubt>) -> Doubt {
    let [doubt] = &doubts[..] else { panic!("{doubts:?}") };
    doubt.clone()
}

#[test]
fn limits_in_kilonewtons_are_questioned_and_the_mass_is_not() {
    for name in ["caroca", "cogiro", "expo2015-lucia", "four-cables"] {
        let mut robot = named(name);
        robot.tension_limits.max *= 1e-3;
        robot.tension_limits.min = 1e-3;
        robot.tension_reference = None;
        let doubt = only(plausible::robot(&robot));
        assert_eq!(doubt.quantity, "tension_limits.max", "{name}: {doubt}");
        assert!(doubt.meant.ends_with("is in kN"), "{name}: {doubt}");
        // The mass in grams is the mass.
        let mut heavy = named(name);
        heavy.platform.mass *= 1e3;
        heavy.platform.inertia = None;
        let doubts = plausible::robot(&heavy);
        assert_eq!(doubts[0].quantity, "platform.mass", "{name}: {doubts:?}");
    }
}

#[test]
fn an_exit_point_with_a_lost_sign_is_questioned_where_heights_differ_a_little() {
    for z in [-3.5, -3.4, -3.3] {
        let mut robot = named("caroca");
        robot.cables[2].exit_point.z = z;
        let doubt = only(plausible::robot(&robot));
        assert_eq!((doubt.quantity.as_str(), doubt.meant), ("cables[2].exit_point", format!("z = {}", -z)));
    }
}

#[test]
fn a_mean_that_is_the_value_itself_is_questioned_however_large_deviations_may_be() {
    let mut robot = named("four-cables");
    let x: Parameter = "cog.x".parse().unwrap();
    let asked = |robot: &Robot, mean: f64| plausible::deviation(robot, x, "cog.x", [mean, 1e-3]);
    // Half of the reach of the platform is 0.27 m, its centre of mass 0.02 m from P.
    let doubt = asked(&robot, 0.02).unwrap();
    assert_eq!((doubt.quantity.as_str(), doubt.meant.as_str()), ("mean of cog.x", "mean 0 m"));
    assert_eq!(asked(&robot, 0.005), None);
    assert_eq!(asked(&robot, 0.0), None);
    // A difference of equal numbers is no mean.
    let doubt = asked(&robot, 0.1 * 0.2).unwrap();
    assert_eq!(doubt.meant, "mean 0 m");
    // An axis may go as far as the value, and a value may be rounding itself.
    assert_eq!(plausible::farthest(&robot, x, "cog.x", 0.02), None);
    robot.platform.center_of_mass.x = 6.9e-18;
    assert_eq!(asked(&robot, 6.9e-18), None);
}

#[test]
fn a_low_exit_point_on_the_other_side_of_the_floor_is_no_lost_sign() {
    let mut robot = named("caroca");
    for (cable, z) in robot.cables.iter_mut().zip([0.1, 0.09, -0.0875, 0.08]) {
        cable.exit_point.z = z;
    }
    assert_eq!(plausible::robot(&robot), []);
}

#[test]
fn the_assumed_inertia_moves_with_no_frame_and_grows_with_the_size() {
    let mut robot = named("caroca");
    let own = robot.assumed_inertia()[(0, 0)];
    let shift = nalgebra::Vector3::new(0.11, -0.07, 0.23);
    robot.cables.iter_mut().for_each(|cable| cable.anchor_point += shift);
    robot.platform.center_of_mass += shift;
    assert!((robot.assumed_inertia()[(0, 0)] / own - 1.0).abs() < 1e-12);
    for share in [0.01, 100.0] {
        let mut other = robot.clone();
        other.platform.center_of_mass *= share;
        for cable in &mut other.cables {
            cable.anchor_point *= share;
            cable.exit_point *= share;
        }
        let inertia = other.assumed_inertia()[(0, 0)];
        assert!((inertia / (own * share * share) - 1.0).abs() < 1e-12, "{share}: {inertia} {own}");
    }
}

#[test]
fn a_pose_out_of_the_plane_of_a_planar_robot_is_questioned() {
    let mut robot = named("caroca");
    robot.plane = Some(Plane::Xz);
    for cable in &mut robot.cables {
        cable.exit_point.y = 0.5;
        cable.anchor_point.y = 0.1;
    }
    let asked = |pose: &Pose| plausible::out_of_plane(&robot, "--pose", pose);
    assert_eq!(asked(&Pose::at(0.3, 0.4, 1.0)), None);
    assert_eq!(asked(&Pose::at(0.3, 0.401, 1.0)), None);
    let doubt = asked(&Pose::at(0.3, 0.0, 1.0)).unwrap();
    assert!(doubt.why.starts_with("out of the plane xz of its cables, where y is 0.4 m"), "{doubt}");
    assert!(doubt.meant.starts_with("y = 0.4 m"), "{doubt}");
    let turned = |angles| Pose { rotation: rotation_by_angles(angles), ..Pose::at(0.3, 0.4, 1.0) };
    assert_eq!(asked(&turned([0.0, 30.0, 0.0])), None);
    let doubt = asked(&turned([10.0, 0.0, 0.0])).unwrap();
    assert_eq!(doubt.value, "turned out of the plane by 10 degrees");
    // In space every pose is as good.
    robot.plane = None;
    assert_eq!(plausible::out_of_plane(&robot, "--pose", &Pose::at(0.3, 0.0, 1.0)), None);
}

#[test]
fn what_the_guide_of_a_planar_robot_takes_up_is_questioned() {
    let mut robot = named("cogiro");
    robot.plane = Some(Plane::Xz);
    let normal = Plane::Xz.normal();
    let doubts = |force: Vector3<f64>, moment: Vector3<f64>| {
        let found = plausible::wrench(&robot, "", &Wrench { force, moment });
        Vec::from_iter(found.iter().map(ToString::to_string)).join("\n")
    };
    let along = |k: usize| {
        let mut vector = Vector3::zeros();
        vector[k] = 1.0;
        vector
    };
    for k in 0..3 {
        let (force, moment) = (doubts(along(k), Vector3::zeros()), doubts(Vector3::zeros(), along(k)));
        assert_eq!(force.contains("whose guide takes it up"), k == normal, "{force}");
        assert_eq!(moment.contains("whose guide takes it up"), k != normal, "{moment}");
    }
}

#[test]
fn times_of_a_path_increase_and_have_no_gap_in_which_the_platform_moves() {
    let poses = |x: &[f64]| x.iter().map(|x| Pose::at(*x, 0.0, 2.0)).collect::<Vec<_>>();
    let doubt = |times: &[f64], x: &[f64]| plausible::times("t_s", &[2, 3, 4, 5, 7, 8], times, &poses(x));
    let even = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5];
    assert_eq!(doubt(&even, &even), None);
    // It stands still for 10 s.
    let late = [0.0, 0.1, 0.2, 0.3, 10.3, 10.4];
    assert_eq!(doubt(&late, &[0.0, 0.1, 0.2, 0.3, 0.3, 0.4]), None);
    let gap = doubt(&late, &late).unwrap();
    assert_eq!((gap.quantity.as_str(), gap.value.as_str()), ("line 7: t_s", "10.3 s"));
    assert!(gap.why.contains("10.0 s earlier, where 0.100 s are usual"), "{gap}");
    for wrong in [[0.0, 0.1, 0.2, 0.1, 0.4, 0.5], [0.0, 0.1, 0.2, 0.2, 0.3, 0.4]] {
        assert_eq!(doubt(&wrong, &even).unwrap().quantity, "line 5: t_s");
    }
}
