//! What a template says of itself: the format of study files has no comments.

use super::tolerances::has_tolerance;
use cdpr_robot::{Parameter, Robot};

/// What the fields of a study file of this robot mean, for people.
pub fn template_notes(robot: &Robot) -> String {
    let parameters = Parameter::of(robot);
    let has = |group: &str| {
        parameters.iter().any(|parameter| parameter.group() == group && has_tolerance(robot, parameter))
    };
    let points = match robot.platform.point {
        true => "    b, dt          exit points [m], tension set-points [N]",
        false => {
            "    a, b, cog, dt  anchor points, exit points, centre of mass [m], tension
                   set-points [N]"
        }
    };
    let guides = match (has("r"), has("lead")) {
        (true, _) => "\n    r, lead, tilt  of pulleys: radii, leads [m], tilts of axes [rad]",
        (false, true) => "\n    lead           cable between winch and exit point [m]",
        (false, false) => "",
    };
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
                   [kg]; force, moment [N, N m] come with it
  error_models     law of each parameter's deviation from the robot file, in SI
                   units
    mass           mass of the platform [kg]
    linear_density, youngs_modulus     of all cables [kg/m], [Pa]
{points}{guides}
    gravity        components of a vector of gravity [m/s\u{b2}]; the entry of a
                   parameter, such as b3.x, takes precedence over that of its
                   group
    law            uniform {{min, max}}, normal {{mean, std}}, truncated_normal,
                   triangular {{min, mode, max}}, beta
    steps          optional: {{nearest: {{step: 0.001}}}} rounds values to steps of
                   1 mm
  samplings        all parameters vary at once: pose (position [m]; quaternion
                   [w, x, y, z] or rpy_deg) or poses (a list or a grid), error
                   model, observations; free: coordinates of the pose that are
                   found, for a robot with fewer cables than free motions;
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
