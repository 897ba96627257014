//! A study read from its file and checked, ready to run.

use crate::comparison::Value;
use crate::error::StudyError;
use crate::error_model::{ErrorModel, Wrong};
use crate::file::{AxisSpec, InputSpec, STUDY_FORMAT, SamplingSpec, SensitivitySpec, Statistic, StudyFile};
use crate::folder::BLOCKS_NAME;
use crate::operating_point::{Moduli, resolved};
use crate::pose_set::Located;
use cdpr_robot::{Parameter, Pose, Robot, from_json};
use cdpr_sensitivity::{SensitivityError, SobolDesign};
use cdpr_statics::{Deflection, Load, Observer, deflection};
use indexmap::IndexMap;
use std::path::{Path, PathBuf};

/// A study with its robot.
#[derive(Clone, Debug)]
pub struct Study {
    /// Where it was read from.
    pub path: PathBuf,
    /// What the file says.
    pub file: StudyFile,
    /// The nominal robot.
    pub robot: Robot,
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
    /// What each input of the design acts on.
    pub errors: ErrorModel,
    /// Least and greatest modulus of the cables' law at the tensions of pose and load [Pa], where the error model asks for them.
    pub operating_moduli: Option<[f64; 2]>,
    /// The nominal robot's deflection.
    pub nominal: Deflection,
    /// Observes the robot with deviations of its parameters.
    pub observer: Observer<'a>,
    /// The rest of the study's settings.
    pub study: &'a Study,
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
    /// First axis: place in [`Parameter::all`] and deviations.
    pub x: (Parameter, usize, Vec<f64>),
    /// Second axis.
    pub y: (Parameter, usize, Vec<f64>),
    /// The nominal robot's deflection.
    pub nominal: Deflection,
    /// Observes the robot with deviations of its parameters.
    pub observer: Observer<'a>,
}

/// Points of one axis of a surface, which is held in memory as a whole.
const MOST_POINTS: usize = 10_000;

/// Observations of a sampling, for laws to be fitted.
const FEWEST_OBSERVATIONS: usize = 3;

/// Designs of a sampling besides the first: intervals of a quantile need no more.
const MOST_REPLICATES: usize = 10_000;

/// Resamples of a bootstrap: the quantiles of intervals need no more.
const MOST_RESAMPLES: usize = 1_000_000;

impl Study {
    /// Reads and checks a study file and its robot file. Every surface and sampling at one pose is prepared once, so that what is wrong
    /// with the last one is said before the first one runs.
    ///
    /// # Errors
    /// [`StudyError`] naming file, field, value and what would be right.
    pub fn open(path: &Path) -> Result<Self, StudyError> {
        Self::from_json(&read(path)?, path)
    }

    /// The same from text; `path` names the text in errors, and the robot file is looked for beside it.
    ///
    /// # Errors
    /// As [`Study::open`].
    pub fn from_json(text: &str, path: &Path) -> Result<Self, StudyError> {
        let file: StudyFile =
            from_json(text).map_err(|source| StudyError::Format { path: path.to_owned(), source })?;
        let robot_path = path.parent().unwrap_or(Path::new(".")).join(&file.robot);
        let robot = open_robot(&robot_path)?;
        let study = Self { path: path.to_owned(), file, robot };
        study.validate().map_err(|error| error.placed(text))?;
        Ok(study)
    }

    /// Gives every sampling this number of observations.
    ///
    /// # Errors
    /// [`StudyError::Setting`] for fewer than 3.
    pub fn set_observations(&mut self, observations: usize) -> Result<(), StudyError> {
        if observations < FEWEST_OBSERVATIONS {
            let expected = format!("at least {FEWEST_OBSERVATIONS}");
            return Err(StudyError::setting("--observations", observations, expected));
        }
        self.file.samplings.values_mut().for_each(|sampling| sampling.observations = observations);
        self.validate()
    }

    /// Gives every sampling this number of observations, if that is no fewer than it has.
    ///
    /// # Errors
    /// [`StudyError::Setting`] for fewer.
    pub fn extend(&mut self, observations: usize) -> Result<(), StudyError> {
        let most = self.file.samplings.values().map(|sampling| sampling.observations).max();
        let Some(most) = most else {
            return Err(self.invalid("samplings", "empty", "a sampling to extend"));
        };
        if observations < most {
            let expected = format!("at least {most}, as many as there are");
            return Err(StudyError::setting("--observations", observations, expected));
        }
        self.set_observations(observations)
    }

    fn validate(&self) -> Result<(), StudyError> {
        let file = &self.file;
        if file.format != STUDY_FORMAT {
            return Err(self.invalid("format", &file.format, STUDY_FORMAT));
        }
        if !(file.payload.is_finite() && file.payload > 0.0) {
            return Err(self.invalid("payload", file.payload, "a finite mass above zero [kg]"));
        }
        if file.replicates == 1 || file.replicates > MOST_REPLICATES {
            let expected = format!("none (0), or 2 to {MOST_REPLICATES} for an interval");
            return Err(self.invalid("replicates", file.replicates, &expected));
        }
        if !(file.confidence > 0.0 && file.confidence < 1.0) {
            return Err(self.invalid("confidence", file.confidence, "a number between 0 and 1"));
        }
        if !(1..=MOST_RESAMPLES).contains(&file.bootstrap_resamples) {
            let expected = format!("1 to {MOST_RESAMPLES}");
            return Err(self.invalid("bootstrap_resamples", file.bootstrap_resamples, &expected));
        }
        if let Some((field, value, expected)) = file.sensitivity.as_ref().and_then(SensitivitySpec::invalid) {
            return Err(self.invalid(&format!("sensitivity.{field}"), value, &expected));
        }
        if file.samplings.is_empty() && file.surfaces.is_empty() {
            return Err(self.invalid("samplings", "empty", "at least one sampling or surface"));
        }
        for name in file.samplings.keys().chain(file.surfaces.keys()) {
            let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
            if name.is_empty() || !name.chars().all(plain) {
                return Err(self.invalid(
                    "samplings",
                    name,
                    "names of letters, digits, `_` and `-`: they name files",
                ));
            }
        }
        if let Some(name) = file.surfaces.keys().find(|name| file.samplings.contains_key(*name)) {
            return Err(self.invalid(&format!("surfaces.{name}"), name, "a name that no sampling has"));
        }
        self.check_names()?;
        for (name, model) in &file.error_models {
            self.error_model(name, model, &[])?;
        }
        for (name, spec) in &file.samplings {
            self.check_sampling(name, spec)?;
        }
        for name in file.surfaces.keys() {
            self.surface(name)?;
        }
        for (i, row) in file.comparison.iter().enumerate() {
            let at_one_pose = file.samplings.get(&row.study).is_some_and(|spec| spec.pose.is_some());
            if !at_one_pose && !file.surfaces.contains_key(&row.study) {
                let field = format!("comparison[{i}].study");
                let expected = "the name of a sampling at one pose, or of a surface";
                return Err(self.invalid(&field, &row.study, expected));
            }
            let of_surface = matches!(row.statistic, Statistic::Min | Statistic::Max | Statistic::Spread);
            if file.surfaces.contains_key(&row.study) && !of_surface {
                let field = format!("comparison[{i}].statistic");
                return Err(self.invalid(
                    &field,
                    format!("{:?}", row.statistic),
                    "min, max or spread for a surface",
                ));
            }
            if matches!(row.paper, Value::Number(_)) && !(row.last_digit.is_finite() && row.last_digit > 0.0)
            {
                let field = format!("comparison[{i}].last_digit");
                return Err(self.invalid(
                    &field,
                    row.last_digit,
                    "the last printed digit of the number, such as 0.01",
                ));
            }
        }
        Ok(())
    }

    /// A sampling at one pose is prepared; of one at several, that there is an equilibrium is found out where it runs.
    fn check_sampling(&self, name: &str, spec: &SamplingSpec) -> Result<(), StudyError> {
        let set = self.poses(name, spec)?;
        if set.several().is_none() {
            return self.sampling(name).map(|_| ());
        }
        if name == BLOCKS_NAME {
            let expected = "another name for a sampling at several poses: its tables have a folder of that name, and the blocks, too";
            return Err(self.invalid("samplings", name, expected));
        }
        self.design(name, spec, &[])?;
        self.check_poses(name, &set)
    }

    /// Prepares the sampling called `name`; at several poses, that at one of them: `NAME/0000`, ....
    ///
    /// # Errors
    /// [`StudyError::Invalid`] for a name or setting that is none, [`StudyError::Nominal`] where the nominal robot cannot
    /// hold the pose.
    pub fn sampling(&self, name: &str) -> Result<Sampling<'_>, StudyError> {
        let Located { name, entry, spec, pose, field } = self.located(name)?;
        let load = Load::payload(self.file.payload);
        let (nominal, observer) = self.nominal(field, &pose, &load)?;
        let (errors, operating_moduli, design) = self.design(entry, spec, &[&nominal])?;
        Ok(Sampling {
            name,
            title: &spec.title,
            robot: &self.robot,
            pose,
            load,
            design,
            errors,
            operating_moduli,
            nominal,
            observer,
            study: self,
        })
    }

    /// What is uncertain in a sampling at the operating point of these deflections of the nominal robot, and the points at which it is
    /// observed.
    pub(crate) fn design(
        &self,
        name: &str,
        spec: &SamplingSpec,
        at: &[&Deflection],
    ) -> Result<(ErrorModel, Option<Moduli>, SobolDesign), StudyError> {
        let field = format!("samplings.{name}");
        let Some(model) = self.file.error_models.get(&spec.error_model) else {
            let expected = keys(&self.file.error_models);
            return Err(self.invalid(&format!("{field}.error_model"), &spec.error_model, &expected));
        };
        let (errors, moduli) = self.error_model(&spec.error_model, model, at)?;
        if spec.observations < FEWEST_OBSERVATIONS {
            return Err(self.invalid(
                &format!("{field}.observations"),
                spec.observations,
                "at least 3, for laws to be fitted",
            ));
        }
        let design = SobolDesign::new(errors.inputs.clone(), spec.first_index, spec.observations)
            .map_err(|source| self.statistics(format!("{field}.first_index"), source))?;
        Ok((errors, moduli, design))
    }

    /// Prepares the surface called `name`.
    ///
    /// # Errors
    /// As [`Study::sampling`].
    pub fn surface(&self, name: &str) -> Result<Surface<'_>, StudyError> {
        let field = format!("surfaces.{name}");
        let Some((name, spec)) = self.file.surfaces.get_key_value(name) else {
            return Err(self.invalid(&field, "missing", &keys(&self.file.surfaces)));
        };
        let pose = self.pose(&format!("{field}.pose"), &spec.pose)?;
        let load = Load::payload(self.file.payload);
        let x = self.axis(&format!("{field}.x"), &spec.x)?;
        let y = self.axis(&format!("{field}.y"), &spec.y)?;
        let (nominal, observer) = self.nominal(format!("{field}.pose.position"), &pose, &load)?;
        Ok(Surface { name, title: &spec.title, robot: &self.robot, pose, load, x, y, nominal, observer })
    }

    /// The error model called `name`, of deviations from the robot file.
    ///
    /// # Errors
    /// [`StudyError::Invalid`] for a name that is none, and for an operating point: that of a sampling is known from its pose and load.
    pub fn tolerances(&self, name: &str) -> Result<ErrorModel, StudyError> {
        let Some(model) = self.file.error_models.get(name) else {
            return Err(self.invalid("error_models", name, &keys(&self.file.error_models)));
        };
        if let Some((key, _)) = model.iter().find(|(_, spec)| spec.operating_point.is_some()) {
            let field = format!("error_models.{name}.{key}.operating_point");
            return Err(self.invalid(
                &field,
                "given",
                "an error model without one, as there is no pose and load of a sampling",
            ));
        }
        Ok(self.error_model(name, model, &[])?.0)
    }

    /// An error model for this robot, at the operating point of these deflections of the nominal one.
    fn error_model(
        &self,
        name: &str,
        model: &IndexMap<String, InputSpec>,
        at: &[&Deflection],
    ) -> Result<(ErrorModel, Option<Moduli>), StudyError> {
        let field = format!("error_models.{name}");
        let wrong = |wrong| match wrong {
            Wrong::Field(below, value, expected) => {
                self.invalid(&format!("{field}.{below}"), value, expected)
            }
            Wrong::Law(source) => self.statistics(field.clone(), source),
        };
        let (model, moduli) = resolved(model, &self.robot, at).map_err(wrong)?;
        let found = ErrorModel::new(&model, self.robot.cables.len()).map_err(wrong)?;
        if found.inputs.is_empty() {
            return Err(self.invalid(&field, "empty", "at least one uncertain parameter"));
        }
        Ok((found, moduli))
    }

    fn axis(&self, field: &str, spec: &AxisSpec) -> Result<(Parameter, usize, Vec<f64>), StudyError> {
        let parameters = Parameter::all(self.robot.cables.len());
        let known =
            spec.parameter.parse().ok().and_then(|p| Some((p, parameters.iter().position(|q| *q == p)?)));
        let Some((parameter, place)) = known else {
            return Err(self.invalid(
                &format!("{field}.parameter"),
                &spec.parameter,
                "a parameter of the robot",
            ));
        };
        if !(spec.min.is_finite() && spec.max.is_finite() && spec.min < spec.max) {
            let range = format!("{} to {}", spec.min, spec.max);
            return Err(self.invalid(field, range, "finite deviations, min below max"));
        }
        if !(2..=MOST_POINTS).contains(&spec.points) {
            let expected = format!("at least 2, at most {MOST_POINTS}");
            return Err(self.invalid(&format!("{field}.points"), spec.points, &expected));
        }
        let last = (spec.points - 1) as f64;
        // Weighted ends: the distance between them need not be a number, and the last point is `max` itself.
        let point = |k: usize| spec.min * ((last - k as f64) / last) + spec.max * (k as f64 / last);
        Ok((parameter, place, (0..spec.points).map(point).collect()))
    }

    fn nominal(
        &self,
        field: String,
        pose: &Pose,
        load: &Load,
    ) -> Result<(Deflection, Observer<'_>), StudyError> {
        let no_offsets = vec![0.0; self.robot.cables.len()];
        let nominal = || {
            let deflection = deflection(&self.robot, pose, &no_offsets, load)?;
            Ok((deflection, Observer::new(&self.robot, pose, load)?))
        };
        nominal().map_err(|source| StudyError::Nominal {
            path: self.path.clone(),
            field,
            value: format!("{:?}", pose.position.as_slice()),
            source: Box::new(source),
        })
    }

    fn statistics(&self, field: String, source: SensitivityError) -> StudyError {
        StudyError::Statistics { path: self.path.clone(), field, source }
    }

    pub(crate) fn invalid(&self, field: &str, value: impl ToString, expected: &str) -> StudyError {
        StudyError::Invalid {
            path: self.path.clone(),
            field: field.to_owned(),
            value: value.to_string(),
            expected: expected.to_owned(),
        }
    }
}

/// Reads and checks a robot file.
///
/// # Errors
/// [`StudyError::Read`]; [`StudyError::Robot`] naming file, field, value and what would be right.
pub fn open_robot(path: &Path) -> Result<Robot, StudyError> {
    let robot = Robot::from_json(&read(path)?);
    robot.map_err(|source| StudyError::Robot { path: path.to_owned(), source })
}

pub(crate) fn keys<T>(map: &IndexMap<String, T>) -> String {
    format!("one of {}", map.keys().cloned().collect::<Vec<_>>().join(", "))
}

pub(crate) fn read(path: &Path) -> Result<String, StudyError> {
    std::fs::read_to_string(path).map_err(|source| StudyError::Read { path: path.to_owned(), source })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_ends_at_its_ends_however_far_apart_they_are() {
        let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies/caroca.json"));
        let study = Study::open(path).unwrap();
        for (min, max) in [(-0.3, 0.1), (f64::MIN, f64::MAX), (-5e-324, 5e-324)] {
            let spec = AxisSpec { parameter: "mass".to_owned(), min, max, points: 7 };
            let (_, _, points) = study.axis("x", &spec).unwrap();
            assert_eq!((points[0], points[6]), (min, max));
            assert!(points.is_sorted() && points.iter().all(|point| point.is_finite()), "{points:?}");
        }
    }
}
