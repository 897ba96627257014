//! The inertia of planar robots.

#![allow(clippy::unwrap_used, clippy::panic)]

use cdpr_robot::Robot;

#[test]
fn one_moment_of_inertia_is_enough_in_a_plane() {
    let text = |plane: &str, inertia: &str| {
        format!(
            r#"{{"format": "cdpr-robot/1", "name": "table", "gravity": 9.81, {plane}
            "platform": {{"mass": 4, "center_of_mass": [0, 0, 0], "inertia": {inertia}}},
            "cable": {{"diameter": 0.004, "linear_density": 0.06, "youngs_modulus": 1e11}},
            "tension_limits": {{"min": 1, "max": 1000}}, "cables": [
            {{"exit_point": [0, 0, 4], "anchor_point": [0, 0, 0.1]}},
            {{"exit_point": [2, 0, 4], "anchor_point": [0.1, 0, 0]}},
            {{"exit_point": [1, 0, 0], "anchor_point": [0, 0, -0.1]}}]}}"#
        )
    };
    let xz = r#""plane": "xz","#;
    for given in ["0.03", "[[0, 0, 0], [0, 0.03, 0], [0, 0, 0]]"] {
        let robot = Robot::from_json(&text(xz, given)).unwrap();
        let inertia = robot.platform.inertia.unwrap();
        assert_eq!(inertia.diagonal(), nalgebra::Vector3::new(0.015, 0.03, 0.015), "{given}");
        assert!(!robot.lacks_inertia());
        assert_eq!(Robot::from_json(&robot.to_json()).unwrap(), robot);
    }
    // A tensor that is whole stays as it is.
    let whole = Robot::from_json(&text(xz, "[[2, 0, 0], [0, 3, 0], [0, 0, 4]]")).unwrap();
    assert_eq!(whole.platform.inertia.unwrap().diagonal(), nalgebra::Vector3::new(2.0, 3.0, 4.0));
    for (plane, given, why) in [
        ("", "0.03", "three rows of three numbers"),
        (xz, "0", "finite, positive moment"),
        (xz, "[[0.03, 0, 0], [0, 0, 0], [0, 0, 0]]", "positive principal moments"),
        (xz, "[1, 2, 3]", "or of a planar robot the moment"),
    ] {
        let error = Robot::from_json(&text(plane, given)).unwrap_err().to_string();
        assert!(error.contains("inertia") && error.contains(why), "{given}: {error}");
    }
}
