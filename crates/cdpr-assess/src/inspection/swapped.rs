//! Anchor points of two cables that were given for one another: the robot holds a pose, without cables that
//! touch, as soon as they are exchanged, or its layout becomes symmetric.

use super::pose::held;
use super::{Findings, Severity, symmetry};
use crate::clearance::HangingCables;
use cdpr_robot::{Robot, Vector3};

/// Cables at most of a robot all of whose pairs are tried.
const MOST_CABLES: usize = 12;

/// Pairs that are named, those with the least tensions first.
const MOST_PAIRS: usize = 4;

impl Findings<'_> {
    /// A note for all cables that share an exit point or an anchor point.
    pub(super) fn shared(&mut self, name: &str, points: &[Vector3<f64>]) {
        let first = |j: usize| points[..j].iter().position(|other| (other - points[j]).norm() < 1e-9);
        let pairs: Vec<[usize; 2]> = (0..points.len()).filter_map(|j| Some([first(j)?, j])).collect();
        let remedy = "nothing, if two cables meet there; else the point as measured";
        if let [[i, j]] = pairs[..] {
            let (field, value) = (format!("cables[{j}].{name}"), format!("{:?} m", points[j].as_slice()));
            let why = format!("the same place as that of cable {}", i + 1);
            self.add(Severity::Note, field, value, &why, remedy);
        } else if !pairs.is_empty() {
            let all: Vec<String> = pairs.iter().map(|[i, j]| format!("{} and {}", i + 1, j + 1)).collect();
            let value = format!("the same for cables {}", all.join(", "));
            self.add(Severity::Note, format!("cables[*].{name}"), value, "two cables at one place", remedy);
        }
    }

    /// Which two anchor points are to be exchanged, if the robot holds no pose or its cables touch.
    pub(super) fn swapped_anchors(&mut self) {
        let robot = self.robot;
        let n = robot.cables.len();
        if robot.platform.point || n > MOST_CABLES || !robot.is_fully_actuated() {
            return;
        }
        if effort(robot).is_some() {
            self.asymmetric();
            return;
        }
        let pairs = (0..n).flat_map(|j| (0..j).map(move |i| (i, j)));
        let tried = pairs.filter_map(|(i, j)| Some((effort(&exchanged(robot, i, j))?, i, j)));
        let mut found: Vec<_> = tried.collect();
        found.sort_by(|one, other| one.0.total_cmp(&other.0));
        if found.is_empty() {
            return;
        }
        let pairs: Vec<_> = found.iter().take(MOST_PAIRS).map(|(_, i, j)| numbers(*i, *j)).collect();
        self.add(
            Severity::Warning,
            "cables[*].anchor_point",
            format!("perhaps exchanged for cables {}", pairs.join(", or ")),
            "the other way round, the robot holds a pose at which no cables touch; as it is, it does not",
            "check which cable is at which anchor point",
        );
    }

    /// Which two anchor points are to be exchanged, if the layout is symmetric then.
    fn asymmetric(&mut self) {
        let found = symmetry::broken(self.robot);
        let pairs: Vec<_> = found.iter().take(MOST_PAIRS).map(|(i, j)| numbers(*i, *j)).collect();
        if pairs.is_empty() {
            return;
        }
        self.add(
            Severity::Warning,
            "cables[*].anchor_point",
            format!("perhaps exchanged for cables {}", pairs.join(", or ")),
            "the other way round, the layout is symmetric, as that of most robots; as it is, it is not",
            "check which cable is at which anchor point",
        );
    }
}

/// The robot with the anchor points of two cables exchanged.
fn exchanged(robot: &Robot, i: usize, j: usize) -> Robot {
    let mut other = robot.clone();
    other.cables[i].anchor_point = robot.cables[j].anchor_point;
    other.cables[j].anchor_point = robot.cables[i].anchor_point;
    other
}

/// Sum of the tensions [N] where the robot holds a pose at which no cables touch.
fn effort(robot: &Robot) -> Option<f64> {
    let (_, solution) = held(robot)?;
    let hanging = HangingCables::new(robot, &solution.lengths, &solution.equilibrium).ok()?;
    let free = (0..robot.cables.len()).all(|j| (0..j).all(|i| hanging.touching(i, j).is_none()));
    free.then(|| solution.tensions.iter().sum())
}

/// Two cables by their numbers, from 1.
fn numbers(i: usize, j: usize) -> String {
    format!("{} and {}", i + 1, j + 1)
}
