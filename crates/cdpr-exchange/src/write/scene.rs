//! What several formats need of a robot: its inertia, its plain cables, its texts.

use crate::error::ExchangeError;
use cdpr_robot::{CableEnd, Matrix3, Pose, Robot, RobotCable, Vector3, significant};
use cdpr_statics::{Load, inverse};

/// A robot in the files of another program.
#[derive(Clone, Debug, PartialEq)]
pub struct Exported {
    /// Ends of the files' names, such as `.xml` and `_cables.xml`, with their texts.
    pub files: Vec<(&'static str, String)>,
    /// What was assumed, and what the format has no place for: a sentence each.
    pub notes: Vec<String>,
}

/// Inertia about the centre of mass [kg m²]: that of a ball as large as the platform where it is not known,
/// which is noted.
pub(crate) fn inertia(robot: &Robot, notes: &mut Vec<String>) -> Matrix3<f64> {
    robot.platform.inertia.unwrap_or_else(|| {
        notes.push(
            "the inertia is that of a ball as large as the platform: the robot file has none".to_owned(),
        );
        robot.assumed_inertia()
    })
}

/// Refuses pulleys and leads.
pub(crate) fn check_from_points(robot: &Robot) -> Result<(), ExchangeError> {
    const FROM_POINTS: &str = "cables that come from points";
    for (i, cable) in robot.cables.iter().enumerate() {
        if let Some(pulley) = cable.pulley.filter(|pulley| pulley.radius > 0.0) {
            let value = format!("a pulley of radius {} m", pulley.radius);
            return Err(ExchangeError::no_place(format!("cables[{i}].pulley"), value, FROM_POINTS));
        }
        if cable.lead > 0.0 {
            let value = format!("{} m", cable.lead);
            return Err(ExchangeError::no_place(format!("cables[{i}].lead"), value, FROM_POINTS));
        }
    }
    Ok(())
}

/// Refuses what only cables between points in space can be written without.
pub(crate) fn check_plain(robot: &Robot) -> Result<(), ExchangeError> {
    const BODY: &str = "a platform with all six motions";
    if robot.platform.point {
        return Err(ExchangeError::no_place("platform.point", true, BODY));
    }
    if let Some(plane) = robot.plane {
        return Err(ExchangeError::no_place("plane", plane.name(), BODY));
    }
    check_from_points(robot)?;
    match robot.cables.iter().position(|cable| cable.properties.law.is_some()) {
        None => Ok(()),
        Some(i) => {
            let field = format!("cables[{i}].cable.law");
            Err(ExchangeError::no_place(field, "an elastic law", "cables with one modulus"))
        }
    }
}

/// Refuses a gravity that is not along -z.
pub(crate) fn check_upright(robot: &Robot) -> Result<(), ExchangeError> {
    let down = robot.gravity.vector();
    if down.xy().norm() > 1e-9 * down.norm() {
        let value = format!("{:?}", down.as_slice());
        return Err(ExchangeError::no_place("gravity", value, "gravity along -z"));
    }
    Ok(())
}

/// Axial stiffness of each cable [N] at the tensions of the pose without load, and a note on elastic laws, if
/// there are any. `letter` is what the format calls it. Without tensions there it is that of the modulus.
pub(crate) fn stiffness_at(robot: &Robot, pose: &Pose, letter: &str) -> (Vec<f64>, Option<String>) {
    let plain: Vec<f64> = robot.cables.iter().map(|cable| cable.properties.axial_stiffness()).collect();
    if robot.cables.iter().all(|cable| cable.properties.law.is_none()) {
        return (plain, None);
    }
    let no_place = "elastic laws of cables have no place";
    let Ok(found) = inverse(robot, pose, &Load::none()) else {
        let note = format!("{no_place}: {letter} is EA of youngs_modulus, as no tensions hold the pose");
        return (plain, Some(note));
    };
    let ratio = |(cable, tension): (&RobotCable, &f64)| {
        cable.properties.law.as_ref().map_or(1.0, |law| law.ratio(*tension))
    };
    let ratios: Vec<f64> = robot.cables.iter().zip(&found.tensions).map(ratio).collect();
    let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = ratios.iter().copied().fold(0.0, f64::max);
    let [least, greatest] = [least, greatest].map(|ratio| significant(ratio, 3));
    let ratio = if least == greatest { least } else { format!("{least} to {greatest}") };
    let note = format!(
        "{no_place}: {letter} is EA of the laws at the tensions of this pose, {ratio} times that of youngs_modulus"
    );
    (plain.iter().zip(&ratios).map(|(stiffness, ratio)| stiffness * ratio).collect(), Some(note))
}

/// What no other format has a place for.
pub(crate) fn unplaced(robot: &Robot) -> Vec<String> {
    let mut notes = Vec::new();
    if robot.tension_reference.is_some() {
        notes.push("the preferred tensions (tension_reference) have no place".to_owned());
    }
    if !robot.distribution.is_nearest() {
        notes.push("the choice of tensions (distribution) has no place".to_owned());
    }
    if (0..robot.cables.len()).any(|i| robot.max_at(i) == CableEnd::Exit) {
        notes.push("that the greatest tensions are those at the exit points has no place".to_owned());
    }
    notes
}

/// Three numbers to the last bit, separated by spaces.
pub(crate) fn words(vector: &Vector3<f64>) -> String {
    let [x, y, z]: [f64; 3] = (*vector).into();
    format!("{x:?} {y:?} {z:?}")
}

/// A text within an attribute of XML. Characters that XML has no place for are written as JSON escapes them.
pub(crate) fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            // As themselves they would be read as spaces.
            '\t' | '\n' | '\r' => escaped.push_str(&format!("&#{};", u32::from(c))),
            '\0'..'\u{20}' | '\u{fffe}' | '\u{ffff}' => escaped.push_str(&format!("\\u{:04x}", u32::from(c))),
            c => escaped.push(c),
        }
    }
    escaped
}
