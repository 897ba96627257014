//! A study with its robot, and its parts ready to run.

use crate::error::StudyError;
use crate::file::output::Output;
use crate::file::study_file::StudyFile;
use crate::model::error_model::ErrorModel;
use crate::model::nominal::Nominals;
use crate::model::observer::OutputObserver;
use cdpr_robot::{Parameter, Pose, Robot};
use cdpr_sensitivity::{Group, SensitivityError, SobolDesign};
use cdpr_statics::{Deflection, Load};
use indexmap::IndexMap;
use std::path::PathBuf;

/// A study with its robot.
#[derive(Clone, Debug)]
pub struct Study {
    /// Path from which the study was read.
    pub path: PathBuf,
    /// Content of the study file.
    pub file: StudyFile,
    /// The nominal robot.
    pub robot: Robot,
    pub(crate) nominals: Nominals,
}

/// The nominal robot at a pose of a study.
#[derive(Clone, Debug)]
pub struct NominalPose {
    /// The wanted pose.
    pub pose: Pose,
    /// The deflection there.
    pub deflection: Deflection,
}

/// One sampling of a study, ready to run.
#[derive(Clone, Debug)]
pub struct Sampling<'a> {
    /// Name in the study; `NAME/0000`, ... of one at several poses.
    pub name: String,
    /// Title for tables and figures.
    pub title: &'a str,
    /// The nominal robot.
    pub robot: &'a Robot,
    /// Wanted pose.
    pub pose: Pose,
    /// The load whose effect is observed.
    pub load: Load,
    /// Uncertain inputs (deviations by name of the cause) at points of Sobol's sequence.
    pub design: SobolDesign,
    /// Correlation matrix of the inputs' normal scores, where some of them are correlated.
    pub correlation: Option<Vec<Vec<f64>>>,
    /// The groups of the study, of these inputs.
    pub groups: Vec<Group>,
    /// What each input of the design acts on.
    pub errors: ErrorModel,
    /// Least and greatest modulus of the cables' law at the tensions of pose and load [Pa], where the error
    /// model asks for them.
    pub operating_moduli: Option<[f64; 2]>,
    /// The nominal robot's deflection.
    pub nominal: Deflection,
    /// The nominal robot's output in its unit.
    pub nominal_value: f64,
    /// Observes the robot with deviations of its parameters.
    pub observer: OutputObserver<'a>,
    /// The rest of the study's settings.
    pub study: &'a Study,
}

impl Sampling<'_> {
    /// What is observed.
    pub fn output(&self) -> Output {
        self.study.file.output
    }
}

/// One axis of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceAxis {
    /// The parameter that deviates.
    pub parameter: Parameter,
    /// Its index in [`Parameter::of`].
    pub index: usize,
    /// Its deviations from the nominal value, in its SI unit.
    pub deviations: Vec<f64>,
}

/// One surface of a study, ready to run.
#[derive(Clone, Debug)]
pub struct Surface<'a> {
    /// Name in the study.
    pub name: &'a str,
    /// Title for tables and figures.
    pub title: &'a str,
    /// The nominal robot.
    pub robot: &'a Robot,
    /// Wanted pose.
    pub pose: Pose,
    /// The load whose effect is observed.
    pub load: Load,
    /// First axis.
    pub x: SurfaceAxis,
    /// Second axis.
    pub y: SurfaceAxis,
    /// What is observed.
    pub output: Output,
    /// The nominal robot's deflection.
    pub nominal: Deflection,
    /// The nominal robot's output in its unit.
    pub nominal_value: f64,
    /// Observes the robot with deviations of its parameters.
    pub observer: OutputObserver<'a>,
}

impl Study {
    pub(crate) fn statistics(&self, field: String, source: SensitivityError) -> StudyError {
        StudyError::Statistics { path: self.path.clone(), field, source }
    }

    pub(crate) fn invalid(&self, field: &str, value: impl ToString, expected: &str) -> StudyError {
        StudyError::invalid(&self.path, field, value, expected)
    }
}

pub(crate) fn keys<T>(map: &IndexMap<String, T>) -> String {
    format!("one of {}", map.keys().cloned().collect::<Vec<_>>().join(", "))
}
