//! Inspection of robots: what is odd in a file, and what is only worth knowing.

use cdpr_assess::{Severity, inspect};
use cdpr_robot::{Gravity, Robot, Vector3};

fn about_gravity(gravity: impl Into<Gravity>) -> Vec<(Severity, String)> {
    let mut robot = Robot::from_json(include_str!("../../../data/robots/caroca.json")).unwrap();
    robot.gravity = gravity.into();
    let findings = inspect(&robot).into_iter().filter(|finding| finding.field == "gravity");
    findings.map(|finding| (finding.severity, finding.why)).collect()
}

#[test]
fn a_tilted_base_is_noted_with_its_angle_and_gravity_is_compared_by_its_magnitude() {
    assert_eq!(about_gravity(9.81), []);
    assert_eq!(about_gravity(Vector3::new(0.0, 0.0, -9.81)), []);
    let note = |why: &str| (Severity::Note, why.to_owned());
    let tilt = 9.81 * Vector3::new(0.1_f64.sin(), 0.0, -0.1_f64.cos());
    assert_eq!(about_gravity(tilt), [note("the base is tilted by 5.73\u{b0}")]);
    let moon = 1.62 * Vector3::new(0.0, 0.6, -0.8);
    assert_eq!(
        about_gravity(moon),
        [note("the base is tilted by 36.87\u{b0}"), note("not that of the Earth's surface")]
    );
}
