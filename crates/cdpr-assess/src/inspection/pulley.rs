//! Inspection of the pulleys of a robot at a pose: how far cables lie on their wheels, and wheels in one
//! place.

use super::{Findings, Severity};
use cdpr_statics::{DirectProblem, InverseSolution, Load};

/// A cable that turns by less than this [degrees] hardly needs its pulley: its axis may be the wrong way
/// round.
const LEAST_WRAP: f64 = 5.0;

/// A cable that turns by more than this [degrees] comes back beside itself.
const GREATEST_WRAP: f64 = 165.0;

impl Findings<'_> {
    /// Findings on the wheels at a pose with feasible tensions.
    pub(super) fn pulleys(&mut self, solution: &InverseSolution, at: &str) {
        let robot = self.robot;
        let load = Load::none();
        let Ok(problem) = DirectProblem::new(robot, &solution.lengths, &load) else { return };
        for (i, cable) in robot.cables.iter().enumerate() {
            let Some(pulley) = cable.pulley.filter(|pulley| pulley.radius > 0.0) else { continue };
            let Ok(shape) = problem.shape(&solution.equilibrium, i, 2, 2) else { continue };
            let wrap = shape.wrap.to_degrees();
            if wrap < LEAST_WRAP {
                self.add(
                    Severity::Warning,
                    format!("cables[{i}].pulley.axis"),
                    format!("{:?}", pulley.axis.as_slice()),
                    &format!("the cable lies on its wheel over {wrap:.1} degrees alone {at}"),
                    "the direction in which the cable enters, from the winch towards the pulley",
                );
            } else if wrap > GREATEST_WRAP {
                self.add(
                    Severity::Warning,
                    format!("cables[{i}].pulley.axis"),
                    format!("{:?}", pulley.axis.as_slice()),
                    &format!(
                        "the cable lies on its wheel over {wrap:.1} degrees {at}: it comes back next to \
                         itself, and nearer to the axis it would cut its wheel"
                    ),
                    "the direction in which the cable enters, or an exit point farther away",
                );
            }
            let near = robot.cables[..i].iter().position(|other| {
                let apart = (other.exit_point - cable.exit_point).norm();
                other.pulley.is_some_and(|other| apart < 0.5 * (other.radius + pulley.radius))
            });
            if let Some(other) = near {
                self.add(
                    Severity::Note,
                    format!("cables[{i}].pulley"),
                    format!("at {:?} m", cable.exit_point.as_slice()),
                    &format!("within the wheel of cable {}", other + 1),
                    "nothing, if exit points are rounded; else the points where the cables enter",
                );
            }
        }
    }
}
