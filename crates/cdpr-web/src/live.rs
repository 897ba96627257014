//! A robot that answers.

use crate::answers::{deflect, describe, failure::Failure, follow, modes, observe, slice, stand};
use crate::question::Question;
use cdpr_robot::{Robot, RobotError};
use cdpr_study::Study;
use serde::Serialize;

/// A robot, and the study that was set last.
#[derive(Debug)]
pub struct Live {
    robot: Robot,
    study: Option<Study>,
}

/// An answer as JSON.
#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
enum Outcome<T> {
    Ok(T),
    Error(Failure),
}

impl Live {
    /// A robot from the text of its file (`cdpr-robot/1`).
    ///
    /// # Errors
    /// As [`Robot::from_json`].
    pub fn new(robot: &str) -> Result<Self, RobotError> {
        Ok(Self { robot: Robot::from_json(robot)?, study: None })
    }

    /// The answer to a question, which is one of [`Question`] as JSON.
    pub fn ask(&mut self, question: &str) -> String {
        match serde_json::from_str(question) {
            Ok(question) => self.answer(question),
            Err(error) => text::<()>(Err(Failure::question(&error))),
        }
    }

    fn answer(&mut self, question: Question) -> String {
        let robot = &self.robot;
        match question {
            Question::Describe { study } => text(Ok(describe::describe(robot, study.map(|study| *study)))),
            Question::Hold(given) => text(deflect::hold(robot, &given)),
            Question::Stand(given) => text(stand::stand(robot, &given)),
            Question::Wind(given) => text(follow::wind(robot, given)),
            Question::Modes(given) => text(modes::modes(robot, &given)),
            Question::Study { text: file } => {
                let set = observe::set(robot, *file);
                text(set.map(|(study, described)| {
                    self.study = Some(study);
                    described
                }))
            }
            Question::Observe(given) => text(self.study().and_then(|study| observe::observe(study, given))),
            Question::Table {} => text(self.study().and_then(observe::table)),
            Question::Effects { of } => text(self.study().and_then(|study| observe::effects(study, &of))),
            Question::Slice(given) => text(slice::slice(robot, &given)),
        }
    }

    fn study(&self) -> Result<&Study, Failure> {
        self.study.as_ref().ok_or_else(|| Failure::invalid("study", "missing", "a question `study` before"))
    }
}

fn text<T: Serialize>(outcome: Result<T, Failure>) -> String {
    let outcome = outcome.map_or_else(Outcome::Error, Outcome::Ok);
    // Only maps whose keys are no text cannot be written: no answer has one.
    serde_json::to_string(&outcome)
        .unwrap_or_else(|error| format!(r#"{{"error": {{"kind": "answer", "reason": "{error}"}}}}"#))
}
