//! Poses of answers in JSON, so that one command takes what another one prints.

use crate::program::arguments::poses::pose_of;
use cdpr_robot::{Matrix3, Pose, Vector3, orthonormalized, shortened};
use serde_json::{Deserializer, Map, Value};

/// What is right.
const EXPECTED: &str = "expected a table, as --format csv prints it, or answers with poses: those of `direct`, or \
                        those to --poses";

/// The poses of an answer, of a list of them, or of one a line.
pub(super) fn poses(text: &str) -> Result<Vec<Pose>, String> {
    let mut answers = Vec::new();
    for value in Deserializer::from_str(text.trim_start_matches('\u{feff}')).into_iter() {
        match value.map_err(|error| format!("it is no JSON: {error}"))? {
            Value::Array(list) => answers.extend(list),
            answer => answers.push(answer),
        }
    }
    if answers.is_empty() {
        return Err(format!("the list is empty: {EXPECTED}"));
    }
    let of = |(k, answer): (usize, &Value)| {
        let found = answer.as_object().ok_or_else(|| format!("it is no answer: {EXPECTED}")).and_then(pose);
        found.map_err(|reason| format!("answer {}: {reason}", k + 1))
    };
    answers.iter().enumerate().map(of).collect()
}

/// The pose of an answer: the one that is found, or else the one that is asked for.
fn pose(answer: &Map<String, Value>) -> Result<Pose, String> {
    if let Some((name, value)) = ["found_pose", "pose"].iter().find_map(|name| answer.get_key_value(*name)) {
        let numbers_of = numbers(value).ok_or_else(|| format!("{name} is {}", shortened(&value.to_string())));
        return numbers_of.and_then(|numbers| pose_of(&numbers).map_err(|error| format!("{name}: {error}")));
    }
    if let Some(reason) = answer.get("error").and_then(|error| error.get("message")) {
        return Err(format!("it has no pose: {}", reason.as_str().unwrap_or_default()));
    }
    if answer.contains_key("loaded") {
        let expected = "expected the answer of `direct` to one of them";
        return Err(format!("it has two poses, with the load and without: {expected}"));
    }
    let read = || {
        let three = |value: &Value| Some(Vector3::from(<[f64; 3]>::try_from(numbers(value)?).ok()?));
        let rows: Vec<_> = answer.get("rotation")?.as_array()?.iter().map(three).collect::<Option<_>>()?;
        let [x, y, z] = rows.try_into().ok()?;
        let matrix = Matrix3::from_columns(&[x, y, z]).transpose();
        let is_rotation = (matrix * matrix.transpose() - Matrix3::identity()).amax() < 1e-6;
        let position = three(answer.get("position")?)?;
        is_rotation.then(|| Pose { position, rotation: orthonormalized(&matrix) })
    };
    read().ok_or_else(|| format!("it has no pose: {EXPECTED}"))
}

fn numbers(value: &Value) -> Option<Vec<f64>> {
    value.as_array()?.iter().map(Value::as_f64).collect()
}
