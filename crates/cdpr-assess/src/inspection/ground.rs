//! Inspection of the height of the ground.

use super::{Findings, Severity};
use cdpr_robot::Robot;
use cdpr_robot::plausible::FRAME;

impl Findings<'_> {
    /// A ground above the exit points, one without room for the platform, one far below; exit points in a
    /// pit.
    pub(super) fn ground(&mut self) {
        let Robot { cables, ground_z: Some(ground), .. } = self.robot else { return };
        let remedy = "the height of the ground in the base frame, in m, below exit and anchor points";
        let highest = cables.iter().map(|cable| cable.exit_point.z).fold(f64::NEG_INFINITY, f64::max);
        // Anchor points of a level platform are below the ground at every pose whose cables come from above.
        let anchors = cables.iter().map(|cable| cable.anchor_point.z);
        let tall = anchors.clone().fold(f64::NEG_INFINITY, f64::max) - anchors.fold(f64::INFINITY, f64::min);
        let room = highest - ground;
        if room < tall.max(f64::MIN_POSITIVE) || room > FRAME.end {
            let why = format!(
                "{room:.3} m below the highest exit point; the anchor points of the platform take {tall:.3} m"
            );
            self.add(Severity::Warning, "ground_z", format!("{ground} m"), &why, remedy);
            return;
        }
        for (i, cable) in cables.iter().enumerate().filter(|(_, cable)| cable.exit_point.z < *ground) {
            self.add(
                Severity::Note,
                format!("cables[{i}].exit_point"),
                format!("z = {} m", cable.exit_point.z),
                &format!("below the ground, ground_z = {ground} m"),
                "nothing, for a winch in a pit; else a point or ground_z that is right",
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::inspection::{Severity, inspect};
    use cdpr_robot::Robot;

    /// Severity and field of what is found about the ground at a height [m], with the first exit point at
    /// `exit`.
    fn found(ground: f64, exit: f64) -> Vec<(Severity, String)> {
        let mut robot = Robot::from_library("cogiro").unwrap();
        robot.cables[0].exit_point.z = exit;
        let before = inspect(&robot);
        let robot = Robot { ground_z: Some(ground), ..robot };
        let after = inspect(&robot).into_iter().filter(|finding| !before.contains(finding));
        after.map(|finding| (finding.severity, finding.field)).collect()
    }

    #[test]
    fn a_ground_above_the_robot_or_in_mm_is_questioned() {
        assert_eq!(found(0.0, 5.4), []);
        for ground in [8.0, 5.0, -2000.0] {
            assert_eq!(found(ground, 5.4), [(Severity::Warning, "ground_z".to_owned())], "{ground}");
        }
    }

    #[test]
    fn an_exit_point_below_the_ground_is_noted() {
        assert_eq!(found(0.6, 0.5), [(Severity::Note, "cables[0].exit_point".to_owned())]);
    }
}
