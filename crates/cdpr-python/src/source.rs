//! What a caller has as a file, or as the text that such a file would have.

use crate::convert::{Answer, Raised, question};
use crate::robot::Robot;
use cdpr_assess::DesignProblem;
use cdpr_cable::Record;
use cdpr_robot::plausible;
use cdpr_study::{
    CableLaw, ErrorModel, InputKind, Study, check_table, open_record, read_bytes, read_errors, read_law,
    read_record, read_text,
};
use pyo3::prelude::*;
use std::path::{Path, PathBuf};

/// A file, or a text with the name that errors have for it.
#[derive(FromPyObject)]
pub(crate) enum Source {
    Text(PathBuf, String),
    File(PathBuf),
}

impl Source {
    /// The path of the file, or the name of the text.
    pub(crate) fn path(&self) -> &Path {
        match self {
            Self::Text(path, _) | Self::File(path) => path,
        }
    }

    fn text(&self, kind: InputKind) -> Answer<String> {
        match self {
            Self::Text(_, text) => Ok(text.clone()),
            Self::File(path) => Ok(read_text(path, kind)?),
        }
    }

    /// The study, of this robot or else of the one that it names. What is improbable of it is questioned.
    pub(crate) fn study(&self, robot: Option<&Robot>) -> Answer<Study> {
        let (text, path) = (self.text(InputKind::Study)?, self.path());
        let study = match robot {
            Some(Robot { robot }) => Study::with_robot(&text, path, robot.clone())?,
            None => Study::from_json(&text, path)?,
        };
        question(plausible::robot(&study.robot).into_iter().chain(study.doubts()))?;
        Ok(study)
    }

    /// The error model for a robot. What is improbable of its deviations is questioned.
    pub(crate) fn errors(&self, robot: &cdpr_robot::Robot) -> Answer<ErrorModel> {
        let model = read_errors(&self.text(InputKind::Errors)?, self.path(), robot)?;
        question(model.doubts(robot))?;
        Ok(model)
    }

    /// The design for a robot.
    pub(crate) fn design(&self, robot: &cdpr_robot::Robot) -> Answer<DesignProblem> {
        Ok(DesignProblem::from_json(&self.text(InputKind::Design)?, self.path(), robot.clone())?)
    }

    /// The law of a cable.
    pub(crate) fn law(&self) -> Answer<CableLaw> {
        Ok(read_law(&self.text(InputKind::Law)?, self.path())?)
    }

    /// The load-elongation record of a cable.
    pub(crate) fn record(&self) -> Answer<Record> {
        match self {
            Self::Text(name, text) => read_record(text.as_bytes())
                .map_err(|error| Raised::Input(format!("{}: {error}", name.display()))),
            Self::File(path) => Ok(open_record(path)?),
        }
    }

    /// The bytes of a table of measurements.
    pub(crate) fn measurements(&self) -> Answer<Vec<u8>> {
        match self {
            Self::Text(_, text) => Ok(text.clone().into_bytes()),
            Self::File(path) => {
                let bytes = read_bytes(path, InputKind::Measurements)?;
                check_table(path, &bytes, InputKind::Measurements)?;
                Ok(bytes)
            }
        }
    }
}
