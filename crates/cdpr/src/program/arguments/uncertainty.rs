//! An error model: as it is typed, of a file, or of a study.

use crate::program::arguments::{Named, named};
use crate::program::error::ProgramError;
use crate::program::questions;
use cdpr_robot::{Parameter, Robot, shown};
use cdpr_study::{ErrorModel, InputKind, StudyError};
use std::path::{Path, PathBuf};

/// What is uncertain.
#[derive(clap::Args)]
pub(crate) struct UncertaintyArgument {
    /// What is uncertain: standard deviations of parameters or groups of them in SI units,
    /// a=0.001,b=0.001,mass=0.5, or a file.
    ///
    /// A file is `cdpr-errors/1`, such as the posterior of a calibration, or an object as in a study's
    /// `error_models`, or a study; STUDY:NAME is one of the error models of a study.
    #[arg(long, value_name = "ERRORS", value_parser = uncertainty)]
    uncertainty: Option<Uncertainty>,
}

impl UncertaintyArgument {
    /// The error model for a robot, if one is given.
    pub(crate) fn model(&self, robot: &Robot) -> Result<Option<ErrorModel>, ProgramError> {
        self.uncertainty.as_ref().map(|given| given.model(robot)).transpose()
    }

    /// The error model for a robot, which the command needs.
    pub(crate) fn needed(&self, robot: &Robot) -> Result<ErrorModel, ProgramError> {
        let missing = "expected --uncertainty: what is uncertain, such as a=0.002,mass=0.5, or a file";
        self.model(robot)?.ok_or_else(|| ProgramError::Usage(missing.to_owned()))
    }
}

/// The values of `--uncertainty`.
#[derive(Clone, Debug)]
enum Uncertainty {
    /// Standard deviations of parameters or groups of them, in SI units.
    Typed(Named),
    /// A file: `cdpr-errors/1`, an error model, or a study with the name of one of its error models.
    File(PathBuf),
}

/// `a=0.002,mass=0.5`, or the name of a file: `FILE`, `STUDY:MODEL`.
fn uncertainty(text: &str) -> Result<Uncertainty, String> {
    if text.contains('=') && !Path::new(text).exists() {
        return named(text).map(Uncertainty::Typed);
    }
    if !text.contains(['.', ':', '/', '\\']) && text != "-" && !Path::new(text).exists() {
        return Err(format!(
            "`{text}`: expected name=number, such as a=0.002,mass=0.5, or the name of a file"
        ));
    }
    Ok(Uncertainty::File(PathBuf::from(text)))
}

impl Uncertainty {
    fn model(&self, robot: &Robot) -> Result<ErrorModel, ProgramError> {
        let path = match self {
            Self::Typed(Named(named)) => {
                let deviations = cdpr_study::uncertainties(robot, named);
                let deviations = deviations.map_err(|error| ProgramError::Usage(error.to_string()))?;
                let model = ErrorModel::normal(robot, &deviations);
                questions::about_model(robot, &model);
                return Ok(model);
            }
            Self::File(path) => path,
        };
        if let Some((study, name)) = of_study(path) {
            return study_errors(&study, &name, robot);
        }
        match questions::open_errors(path, robot) {
            Err(ProgramError::Study(StudyError::OtherKind { found: InputKind::Study, .. })) => {
                let study = questions::open_study(path)?;
                let names: Vec<&str> = study.file.error_models.keys().map(String::as_str).collect();
                match names[..] {
                    [only] => study_errors(path, only, robot),
                    _ => Err(ProgramError::Usage(format!(
                        "--uncertainty {0} is a study with several error models: expected {0}:NAME, \
                         one of {1}",
                        path.display(),
                        names.join(", ")
                    ))),
                }
            }
            opened => opened,
        }
    }
}

/// The study and the name of the error model in `STUDY:MODEL`. A study that is not there is named without the
/// model.
fn of_study(path: &Path) -> Option<(PathBuf, String)> {
    let (study, name) = path.to_str()?.rsplit_once(':')?;
    let is_study = Path::new(study).exists() || study.ends_with(".json") && !name.contains(['/', '\\']);
    (!path.exists() && is_study).then(|| (PathBuf::from(study), name.to_owned()))
}

/// An error model of a study, for a robot that has the same parameters as the study's.
fn study_errors(path: &Path, name: &str, robot: &Robot) -> Result<ErrorModel, ProgramError> {
    let study = questions::open_study(path)?;
    if Parameter::of(&study.robot) != Parameter::of(robot) {
        return Err(ProgramError::Usage(format!(
            "--uncertainty {}: the study is of the robot {}, whose parameters are not those of {}: \
             expected a study of this robot",
            path.display(),
            shown(&study.robot.name),
            shown(&robot.name)
        )));
    }
    Ok(study.tolerances(name)?)
}
