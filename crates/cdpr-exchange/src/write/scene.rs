//! What several formats need of a robot: its inertia, its plain cables, its texts.

use crate::error::ExchangeError;
use cdpr_robot::{Matrix3, Robot, Vector3};

/// A robot in the files of another program.
#[derive(Clone, Debug, PartialEq)]
pub struct Exported {
    /// Ends of the files' names, such as `.xml` and `_cables.xml`, with their texts.
    pub files: Vec<(&'static str, String)>,
    /// What was assumed, and what the format has no place for: a sentence each.
    pub notes: Vec<String>,
}

/// Inertia about the centre of mass [kg m²], and whether it was assumed: that of a ball as large as the
/// platform.
pub(crate) fn inertia(robot: &Robot) -> (Matrix3<f64>, bool) {
    let radius = robot.platform_size().max(0.01);
    let of_ball = || Matrix3::identity() * (0.4 * robot.platform.mass * radius * radius);
    (robot.platform.inertia.unwrap_or_else(of_ball), robot.platform.inertia.is_none())
}

/// Refuses what only cables between points in space can be written without.
pub(crate) fn check_plain(robot: &Robot) -> Result<(), ExchangeError> {
    let no_place = |field: String, value: String| Err(ExchangeError::NoPlace { field, value });
    if !robot.freedoms().are_all() {
        return no_place("plane or platform.point".to_owned(), "a held motion".to_owned());
    }
    for (i, cable) in robot.cables.iter().enumerate() {
        if let Some(pulley) = cable.pulley.filter(|pulley| pulley.radius > 0.0) {
            return no_place(
                format!("cables[{i}].pulley"),
                format!("a pulley of radius {} m", pulley.radius),
            );
        }
        if cable.lead > 0.0 {
            return no_place(format!("cables[{i}].lead"), format!("{} m", cable.lead));
        }
        if cable.properties.law.is_some() {
            return no_place(format!("cables[{i}].cable.law"), "an elastic law".to_owned());
        }
    }
    Ok(())
}

/// Three numbers to the last bit, separated by spaces.
pub(crate) fn words(vector: &Vector3<f64>) -> String {
    let [x, y, z]: [f64; 3] = (*vector).into();
    format!("{x:?} {y:?} {z:?}")
}

/// A text within XML.
pub(crate) fn escaped(text: &str) -> String {
    let plain: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    plain
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
        .replace("--", "- -")
}
