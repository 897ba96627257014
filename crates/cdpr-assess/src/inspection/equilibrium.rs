//! Questions about where a platform was found to rest with given lengths: below the floor, turned over, on
//! some of its cables alone. Lengths of another robot, or in another order, lead there.

use cdpr_robot::{Doubt, Pose, Robot, Rotation3, UnitQuaternion, Vector3, frame, short};
use cdpr_statics::limits::{Limit, out_of_limits};
use cdpr_statics::{DirectSolution, Load};
use std::f64::consts::FRAC_PI_2;

/// Turn from the start beyond which a platform is turned over, or its cables are twisted [rad].
const TURNED: f64 = FRAC_PI_2;
/// Depth below the ground or floor that is an error of surveying, over the size of the frame.
const SURVEYED: f64 = 1e-4;
/// Depth over the size of the frame below the lowest exit point, where that is at or below the origin.
const BELOW_EXITS: f64 = 0.1;
/// The same where all exit points have one height: the robot is suspended, and its frame begins there.
const BELOW_LEVEL_EXITS: f64 = 2.0;
/// Heights that differ by less than this share of the frame's size are one.
const LEVEL: f64 = 0.1;
/// Robots of fewer cables may hang on half of them.
const FEW_CABLES: usize = 4;

const REMEDY: &str =
    "lengths of this robot, in m and in the order of its cables; a start near the pose that they hold";

/// A place where a platform hardly was to rest, found for these lengths [m] under a load from the start that
/// was stated, if any, or else a level one; `of` is its name, such as `the equilibrium`.
pub fn doubtful_rest(
    robot: &Robot,
    of: &str,
    (lengths, load): (&[f64], &Load),
    found: &DirectSolution,
    start: Option<&Pose>,
) -> Option<Doubt> {
    let pose = &found.equilibrium.pose;
    let first = start.map_or_else(Rotation3::identity, |start| start.rotation);
    let doubt = |(value, why): (String, String)| Doubt::new(of, value, why, REMEDY);
    let found = below_floor(robot, start, pose).or_else(|| turned(robot, pose, &first)).or_else(|| {
        // A load may leave cables slack; without one they were to be taut.
        let is_alone = *load == Load::none();
        is_alone.then(|| idle(robot, lengths, found)).flatten()
    });
    found.map(doubt)
}

/// The position of P where P or an anchor point of a platform that was at `start`, if that is known, is below
/// the ground, or, where the robot has none, below what robots stand on; and a sentence of how deep its
/// lowest point is.
pub fn below_floor(robot: &Robot, start: Option<&Pose>, pose: &Pose) -> Option<(String, String)> {
    let (floor, name) = floor(robot, start)?;
    let lowest = lowest(robot, pose);
    (lowest < floor).then(|| {
        let value = format!("at z = {} m", short(pose.position.z));
        (value, format!("its lowest point is at {} m, below {name}", short(lowest)))
    })
}

/// Height of the lowest of P and the anchor points [m].
fn lowest(robot: &Robot, pose: &Pose) -> f64 {
    let anchors = robot.cables.iter().map(|cable| (pose.rotation * cable.anchor_point).z);
    pose.position.z + anchors.fold(0.0, f64::min)
}

/// Whether P or an anchor point of a platform that was at `start` is below the ground or the floor.
pub(crate) fn is_below_floor(robot: &Robot, start: &Pose, pose: &Pose) -> bool {
    below_floor(robot, Some(start), pose).is_some()
}

/// The height that is taken for the ground of a robot whose file has none, for a platform that was at `start`
/// [m]; `None` where the file has one, or where nothing is assumed.
pub fn assumed_ground(robot: &Robot, start: &Pose) -> Option<f64> {
    let floor = || floor(robot, Some(start)).map(|(height, _)| height);
    robot.ground_z.is_none().then(floor).flatten()
}

/// The height below which no platform is expected [m], and what is there. Where the file has no ground it is
/// a guess, which a platform that starts below it refutes, and a base frame that is tilted.
fn floor(robot: &Robot, start: Option<&Pose>) -> Option<(f64, String)> {
    let frame = frame(robot);
    let size = frame.iter().map(|[low, high]| high - low).fold(0.0, f64::max);
    let [low, high] = frame[2];
    if let Some(ground) = robot.ground_z {
        return Some((ground - SURVEYED * size, format!("the ground, ground_z = {} m", short(ground))));
    }
    let guess = match low > 0.0 {
        true => (
            -SURVEYED * size,
            "the floor of the base frame, z = 0 (`ground_z` of the robot file sets another)".to_owned(),
        ),
        false => {
            let share = if high - low < LEVEL * size { BELOW_LEVEL_EXITS } else { BELOW_EXITS };
            let name = format!(
                "the lowest exit point, z = {} m, by more than {share} of the frame's size",
                short(low)
            );
            (low - share * size, name)
        }
    };
    let is_refuted = start.is_some_and(|start| lowest(robot, start) < guess.0);
    (robot.gravity.is_base_level() && !is_refuted).then_some(guess)
}

/// A platform that is turned by more than a right angle.
fn turned(robot: &Robot, pose: &Pose, start: &Rotation3<f64>) -> Option<(String, String)> {
    // Of matrices that are equal but for rounding the cosine may exceed 1.
    let [from, to] = [start, &pose.rotation].map(UnitQuaternion::from_rotation_matrix);
    let angle = from.angle_to(&to);
    if robot.platform.point || angle <= TURNED {
        return None;
    }
    let up = [start, &pose.rotation].map(|rotation| rotation * Vector3::z());
    let way = if up[0].angle(&up[1]) > TURNED { "turned over" } else { "turned" };
    let value = format!("{way} by {:.0} degrees from the start", angle.to_degrees());
    Some((
        value,
        "cables pull so that a platform stays near the rotation that they are laid out for".to_owned(),
    ))
}

/// A platform that at least half of the cables do not hold: they are slack or below their least tensions.
fn idle(robot: &Robot, lengths: &[f64], found: &DirectSolution) -> Option<(String, String)> {
    let below = out_of_limits(robot, lengths, &[&found.equilibrium]);
    let is_below = |i: usize| below.iter().any(|one| one.cable == i && one.limit == Limit::Min);
    let cables = robot.cables.len();
    let idle = (0..cables).filter(|i| found.report.slack.contains(i) || is_below(*i)).count();
    (cables >= FEW_CABLES && 2 * idle >= cables).then(|| {
        let value = format!("with {idle} of {cables} cables slack or below their least tensions");
        (
            value,
            "without a load, lengths are usually such that more than half of the cables are taut".to_owned(),
        )
    })
}
