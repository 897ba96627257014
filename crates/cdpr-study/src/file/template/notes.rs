//! What a template says of itself: the format of study files has no comments.

use super::tolerances::has_tolerance;
use cdpr_robot::{Parameter, Robot};

/// What the fields of a study file of this robot mean, for people.
pub fn template_notes(robot: &Robot) -> String {
    let parameters = Parameter::of(robot);
    let has = |group: &str| {
        parameters.iter().any(|parameter| parameter.group() == group && has_tolerance(robot, parameter))
    };
    let points = match has("a") {
        true => "    a, b, cog      anchor points, exit points, centre of mass [m]",
        false => "    b              exit points [m]",
    };
    let set_points = if has("dt") { "\n    dt             tension set-points [N]" } else { "" };
    let gravity = match has("gravity") {
        true => "\n    gravity        components of the vector of gravity [m/s\u{b2}]",
        false => "",
    };
    let pose = match robot.platform.point {
        true => "pose (position [m]) or poses (a list or a grid),",
        false => {
            "pose (position [m]; quaternion
                   [w, x, y, z] or rpy_deg) or poses (a list or a grid),"
        }
    };
    let free = match robot.is_fully_actuated() {
        true => "",
        false => {
            "
                   free: coordinates of the pose that are found, as many as
                   cables are missing;"
        }
    };
    let wrench =
        if robot.platform.point { "force [N] comes with it" } else { "force, moment [N, N m] come with it" };
    let pulleys = match has("r") {
        true => "\n    r, tilt        of pulleys: radii [m], tilts of swivel axes [rad]",
        false => "",
    };
    let lead = if has("lead") { "\n    lead           cable between winch and exit point [m]" } else { "" };
    let absolute = match has("lead") {
        true => {
            "; with position the lengths are absolute: no
                   lead if winches are referenced at a pose"
        }
        false => "",
    };
    format!(
        "\
The study runs as it is. Replace by what you know of your robot:
  payload          mass added to the platform, whose effect is the deflection
                   [kg]; {wrench}
  error_models     law of each parameter's deviation from the robot file, in SI
                   units
    mass           mass of the platform [kg]
    linear_density, youngs_modulus     of all cables [kg/m], [Pa]
{points}{set_points}{pulleys}{lead}{gravity}
    b3.x, ..       one parameter: its entry takes precedence over that of its
                   group
    law            uniform {{min, max}}, normal {{mean, std}}, truncated_normal,
                   triangular {{min, mode, max}}, beta
    steps          optional: {{nearest: {{step: 0.001}}}} rounds values to steps of
                   1 mm
  samplings        all parameters vary at once: {pose}
                   error model, observations;{free}
                   lengths: those that all robots have, instead of a pose's
  output           optional: position, stiffness, frequency or another, instead
                   of the deflection{absolute}
  surfaces         two parameters vary over a grid, all others are as in the
                   robot file
  replicates       scrambled samplings behind the intervals of signed effects
  sensitivity      all measures of sensitivity; without it the study is faster
  seed             the same seed gives the same numbers
All fields: docs/schemas/cdpr-study-1.schema.json. Then: cdpr study run FILE"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_notes_have_no_field_that_a_robot_does_not_have() {
        const FIELDS: [&str; 7] = ["cog", "dt ", "gravity ", "quaternion", "moment", "free:", "r, tilt"];
        let mut point = Robot::from_library("caroca").unwrap();
        point.platform.point = true;
        point.cables.truncate(4);
        let mut plane = Robot::from_library("caroca").unwrap();
        plane.plane = Some(cdpr_robot::Plane::Xz);
        let library = |name: &str| Robot::from_library(name).unwrap();
        for (robot, has) in [
            (point, &["dt "][..]),
            (plane, &["cog", "dt ", "quaternion", "moment"]),
            // The balance alone gives the tensions of six cables: none is set.
            (library("nist-robocrane"), &["cog", "quaternion", "moment"]),
            (library("four-cables"), &["cog", "quaternion", "moment", "free:"]),
            (library("ipanema-3"), &["cog", "dt ", "quaternion", "moment", "r, tilt"]),
        ] {
            let notes = template_notes(&robot);
            let found: Vec<&str> = FIELDS.into_iter().filter(|field| notes.contains(field)).collect();
            assert_eq!(found, has, "{}: {notes}", robot.name);
        }
    }
}
