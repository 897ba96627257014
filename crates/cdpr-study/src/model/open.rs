//! A study read from its file and checked.

use crate::error::StudyError;
use crate::file::output::{AmplitudeSpec, Output, VectorOutput};
use crate::file::sensitivity_spec::SensitivitySpec;
use crate::file::study_file::{STUDY_FORMAT, SamplingSpec, StudyFile};
use crate::fs::files::open_robot_from;
use crate::fs::input::{from_text, read_text};
use crate::kind::InputKind;
use crate::model::errors::with_error_files;
use crate::model::nominal::Nominals;
use crate::model::prepare::FEWEST_OBSERVATIONS;
use crate::model::study::Study;
use crate::names::BLOCKS_NAME;
use cdpr_robot::{Coordinate, Robot, RobotError, TensionDistribution, TensionReference};
use cdpr_statics::{Load, check_lengths};
use std::path::Path;

/// Designs of a sampling besides the first: intervals of a quantile need no more.
const MOST_REPLICATES: usize = 10_000;

/// Confidence of an interval: beyond it the ends lie where rounding puts them.
const MOST_CONFIDENCE: f64 = 0.999_999;

/// Length of a name, which becomes part of the names of files.
const LONGEST_NAME: usize = 200;

/// Observations of a sampling in all its designs at all its poses: their blocks are 240 GB.
const MOST_OBSERVATIONS: u64 = 10_000_000_000;

/// Observations behind an expansion times uncertain parameters, which are held in memory together.
const MOST_ENTRIES: usize = 1 << 24;

/// Resamples of a bootstrap: the quantiles of intervals need no more.
const MOST_RESAMPLES: usize = 1_000_000;

impl Study {
    /// Reads and checks a study file and its robot file. Every surface and every sampling at one pose is
    /// prepared once, so that an error in the last one is found before the first one runs.
    ///
    /// # Errors
    /// [`StudyError`] naming file, field, value and what would be right.
    pub fn open(path: &Path) -> Result<Self, StudyError> {
        Self::from_json(&read_text(path, InputKind::Study)?, path)
    }

    /// Reads and checks a study from its text. `path` names the text in errors, and the robot file is
    /// searched in its folder.
    ///
    /// # Errors
    /// As [`Study::open`].
    pub fn from_json(text: &str, path: &Path) -> Result<Self, StudyError> {
        Self::read(text, path, None)
    }

    /// The same for a robot that is at hand, whatever robot the text names.
    ///
    /// # Errors
    /// As [`Study::open`].
    pub fn with_robot(text: &str, path: &Path, robot: Robot) -> Result<Self, StudyError> {
        Self::read(text, path, Some(robot))
    }

    fn read(text: &str, path: &Path, robot: Option<Robot>) -> Result<Self, StudyError> {
        let whole = with_error_files(text, path)?;
        let study = match robot {
            Some(robot) => from_text(&whole, path, InputKind::Study).map(|file| Self::of(file, robot, path)),
            None => Self::unchecked(&whole, path),
        };
        // Where files were put in, places of the whole text are not those of the user's.
        let study = study.map_err(|error| match &error {
            StudyError::Format { path: of, .. } if of == path && whole != text => error.placed(text),
            _ => error,
        })?;
        study.validate().map_err(|error| error.placed(text))?;
        Ok(study)
    }

    /// Checks a study of a robot that is at hand, whatever robot the study names. No file is opened for it
    /// unless an error model is in one.
    ///
    /// # Errors
    /// As [`Study::open`].
    pub fn of_robot(file: StudyFile, robot: Robot, path: &Path) -> Result<Self, StudyError> {
        let study = Self::of(file, robot, path);
        study.validate()?;
        Ok(study)
    }

    /// A study and its robot whose values together are not checked yet: enough to know them by their hash.
    pub(crate) fn unchecked(text: &str, path: &Path) -> Result<Self, StudyError> {
        let file: StudyFile = from_text(text, path, InputKind::Study)?;
        let robot = open_robot_from(path.parent().unwrap_or(Path::new(".")), &file.robot)?;
        Ok(Self::of(file, robot, path))
    }

    fn of(file: StudyFile, mut robot: Robot, path: &Path) -> Self {
        robot.choose(file.distribution, file.tension_reference.clone());
        Self { path: path.to_owned(), file, robot, nominals: Nominals::default() }
    }

    /// Gives the inverse model another choice of tensions, as [`Robot::choose`].
    ///
    /// # Errors
    /// [`StudyError::Invalid`] for a negative tension or another number of them than of cables, and for a
    /// distribution that jumps between observations; [`StudyError::Nominal`] for a pose that the nominal
    /// robot does not hold.
    pub fn choose_tensions(
        &mut self,
        distribution: Option<TensionDistribution>,
        reference: Option<TensionReference>,
    ) -> Result<(), StudyError> {
        self.robot.choose(distribution, reference);
        self.file.tension_reference = self.robot.tension_reference.clone();
        self.file.distribution = distribution;
        self.validate()
    }

    /// Gives every sampling this number of observations. If the file has more, the measures of sensitivity
    /// are shortened in proportion.
    ///
    /// # Errors
    /// [`StudyError::Setting`] for fewer than 3.
    pub fn set_observations(&mut self, observations: usize) -> Result<(), StudyError> {
        if observations < FEWEST_OBSERVATIONS {
            let expected = format!("at least {FEWEST_OBSERVATIONS}");
            return Err(StudyError::setting("observations", observations, expected));
        }
        let most = self.file.samplings.values().map(|sampling| sampling.observations).max();
        if let (Some(spec), Some(most)) = (&mut self.file.sensitivity, most)
            && observations < most
        {
            spec.shorten(observations as f64 / most as f64);
        }
        self.file.samplings.values_mut().for_each(|sampling| sampling.observations = observations);
        self.validate()
    }

    /// Gives every sampling this number of observations, if that is no fewer than it has. The measures of
    /// sensitivity stay what they are.
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
            return Err(StudyError::setting("observations", observations, expected));
        }
        self.set_observations(observations)
    }

    fn validate(&self) -> Result<(), StudyError> {
        let file = &self.file;
        self.check_settings()?;
        self.check_names()?;
        self.check_output()?;
        self.check_weather()?;
        for (name, model) in &file.error_models {
            self.error_model(name, model, &[])?;
        }
        for (name, spec) in &file.samplings {
            match &spec.lengths {
                Some(lengths) => self.check_lengths(name, spec, lengths)?,
                None => self.check_free(&format!("samplings.{name}"), &spec.free)?,
            }
            self.check_sampling(name, spec)?;
        }
        for (name, spec) in &file.surfaces {
            self.check_free(&format!("surfaces.{name}"), &spec.free)?;
            self.surface_axes(name, spec)?;
            self.nominal(name)?;
        }
        Ok(())
    }

    /// Values that need no other ones.
    fn check_settings(&self) -> Result<(), StudyError> {
        let file = &self.file;
        if file.format != STUDY_FORMAT {
            return Err(self.invalid("format", &file.format, STUDY_FORMAT));
        }
        for (field, vector) in [("force", file.force), ("moment", file.moment)] {
            if let Some(value) = vector.iter().find(|value| !value.is_finite()) {
                return Err(self.invalid(field, value, "finite components [N or N m]"));
            }
        }
        let is_loaded =
            file.load() != Load::none() || file.output != Output::Deflection || self.is_in_weather()?;
        if !(file.payload.is_finite() && file.payload >= 0.0 && is_loaded) {
            let expected = match file.output {
                Output::Deflection => {
                    "a finite mass above zero [kg], or a `force` or `moment`, or `weather`, whose effect is \
                     the deflection; output position needs none"
                }
                _ => "a finite mass, zero or more [kg]",
            };
            return Err(self.invalid("payload", file.payload, expected));
        }
        for (name, price) in &file.prices {
            let is_entry = |name: &str| file.error_models.values().any(|model| model.contains_key(name));
            if let Some((field, value, expected)) = price.invalid(name, is_entry) {
                return Err(self.invalid(&format!("prices.{name}{field}"), value, &expected));
            }
        }
        if !self.robot.distribution.is_smooth() {
            let expected =
                "nearest or least_2_norm, in the study or the robot: other norms jump between observations";
            return Err(self.invalid("distribution", self.robot.distribution.name(), expected));
        }
        if (file.tension_reference.is_some() || file.distribution.is_some())
            && let Err(RobotError::Invalid { field, value, expected }) = self.robot.validate()
        {
            return Err(self.invalid(&field, value, &expected));
        }
        if file.replicates == 1 || file.replicates > MOST_REPLICATES {
            let expected = format!("none (0), or 2 to {MOST_REPLICATES} for an interval");
            return Err(self.invalid("replicates", file.replicates, &expected));
        }
        if !(file.confidence > 0.0 && file.confidence <= MOST_CONFIDENCE) {
            let expected = format!("a number above 0, at most {MOST_CONFIDENCE}");
            return Err(self.invalid("confidence", file.confidence, &expected));
        }
        if !(1..=MOST_RESAMPLES).contains(&file.bootstrap_resamples) {
            let expected = format!("1 to {MOST_RESAMPLES}");
            return Err(self.invalid("bootstrap_resamples", file.bootstrap_resamples, &expected));
        }
        match file.sensitivity.as_ref().and_then(SensitivitySpec::invalid) {
            Some((field, value, expected)) => {
                Err(self.invalid(&format!("sensitivity.{field}"), value, &expected))
            }
            None => Ok(()),
        }
    }

    /// The robot has what the output needs.
    fn check_output(&self) -> Result<(), StudyError> {
        let output = self.file.output;
        if output.needs_inertia() && self.robot.lacks_inertia() {
            let expected = "a robot with `platform.inertia`, the inertia about the centre of mass, 3 x 3 in \
                            the platform frame [kg m²]: vibrations depend on it";
            return Err(self.invalid("output", output, expected));
        }
        match (output, self.file.amplitude) {
            (Output::Amplitude, None) => {
                let expected = "`amplitude`, too, such as {\"frequency\": 5}: what shakes the platform [Hz]";
                return Err(self.invalid("output", output, expected));
            }
            (Output::Amplitude, Some(spec)) => {
                if let Some((field, value, expected)) = spec.invalid() {
                    return Err(self.invalid(&format!("amplitude.{field}"), value, expected));
                }
            }
            (_, Some(AmplitudeSpec { frequency, .. })) => {
                let expected = "output amplitude, or a study without this field";
                return Err(self.invalid("amplitude", format!("{frequency} Hz"), expected));
            }
            (_, None) => {}
        }
        let vector = self.file.sensitivity.map_or(VectorOutput::Displacement, |spec| spec.vector);
        if !output.is_length() && vector != VectorOutput::Displacement {
            let expected = format!(
                "no pose, or \"deflection\" or \"position\" as output: the {output} belongs to no displacement"
            );
            return Err(self.invalid("sensitivity.vector", "pose", &expected));
        }
        Ok(())
    }

    /// There is a length for each cable, and nothing else asks for lengths for the pose.
    fn check_lengths(&self, name: &str, spec: &SamplingSpec, lengths: &[f64]) -> Result<(), StudyError> {
        let wrong = |value: String, expected: &str| {
            Err(self.invalid(&format!("samplings.{name}.lengths"), value, expected))
        };
        let cables = self.robot.cables.len();
        if lengths.len() != cables {
            return wrong(format!("{} lengths", lengths.len()), &format!("{cables}, one for each cable [m]"));
        }
        if let Some(length) = lengths.iter().find(|length| !(length.is_finite() && **length > 0.0)) {
            return wrong(length.to_string(), "finite lengths above zero [m]");
        }
        if spec.poses.is_some() || !spec.free.is_empty() {
            let of = if spec.poses.is_some() { "poses" } else { "free" };
            return wrong(format!("given with `{of}`"), "a sampling at one `pose`, near which they hold it");
        }
        if !self.file.output.is_length() {
            let expected = "output deflection or position, or a sampling without lengths";
            return wrong(format!("given with output {}", self.file.output), expected);
        }
        let entries = self.file.error_models.get(&spec.error_model);
        let errors = entries.map(|model| self.error_model(&spec.error_model, model, &[])).transpose()?;
        if errors.is_some_and(|(errors, _)| errors.has_offsets()) {
            let expected = "an error model without `dt`: there are no set-points of tensions";
            return wrong(format!("given with {}", spec.error_model), expected);
        }
        check_lengths(&self.robot, lengths).or_else(|error| wrong(format!("{lengths:?}"), &error.to_string()))
    }

    /// As many coordinates are free as cables are missing, each of them once and none that is held.
    fn check_free(&self, field: &str, free: &[Coordinate]) -> Result<(), StudyError> {
        let (cables, freedoms) = (self.robot.cables.len(), self.robot.freedoms());
        let missing = freedoms.count().saturating_sub(cables);
        let wrong =
            |(k, one): (usize, &Coordinate)| free[..k].contains(one) || !freedoms.contains(one.component());
        if free.len() == missing && !free.iter().enumerate().any(wrong) {
            return Ok(());
        }
        let names: Vec<_> = free.iter().map(ToString::to_string).collect();
        let expected = format!(
            "{missing} different ones of x, y, z, roll, pitch, yaw that `plane` and `point` leave free, for \
             {cables} cables and {} free motions",
            freedoms.count()
        );
        Err(self.invalid(&format!("{field}.free"), format!("[{}]", names.join(", ")), &expected))
    }

    /// There is a part of the study, and the names of all can be those of files: none is called as tables or
    /// figures of another one, or of all.
    pub(crate) fn check_names(&self) -> Result<(), StudyError> {
        let file = &self.file;
        if file.samplings.is_empty() && file.surfaces.is_empty() {
            return Err(self.invalid("samplings", "empty", "at least one sampling or surface"));
        }
        let samplings = file.samplings.keys().map(|name| ("samplings", name));
        let surfaces = file.surfaces.keys().map(|name| ("surfaces", name));
        for (kind, name) in samplings.chain(surfaces) {
            let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
            if name.len() > LONGEST_NAME {
                let expected = format!("at most {LONGEST_NAME} characters: they name files");
                return Err(self.invalid(kind, format!("{} characters", name.len()), &expected));
            }
            if name.is_empty() || !name.chars().all(plain) {
                let expected = "names of letters, digits, `_` and `-`: they name files";
                return Err(self.invalid(kind, name, expected));
            }
            if kind == "surfaces" && file.samplings.contains_key(name) {
                return Err(self.invalid(&format!("surfaces.{name}"), name, "a name that no sampling has"));
            }
            if let Some(writer) = file.other_writer(name) {
                let expected = format!("another name: {writer} would write over its files");
                return Err(self.invalid(&format!("{kind}.{name}"), name, &expected));
            }
        }
        Ok(())
    }

    /// Prepares a sampling at one pose. Whether the nominal robot holds each of several poses is found out
    /// only when the sampling runs.
    fn check_sampling(&self, name: &str, spec: &SamplingSpec) -> Result<(), StudyError> {
        let set = self.poses(name, spec)?;
        let field = |field: &str| format!("samplings.{name}.{field}");
        let observations = self.observations(name)?;
        if observations as u64 > MOST_OBSERVATIONS {
            let expected = format!("at most {MOST_OBSERVATIONS} with all replicates, measures and poses");
            return Err(self.invalid(&field("observations"), observations, &expected));
        }
        if set.several().is_none() {
            let nominal = self.nominal(name)?.deflection;
            let (errors, _, design) = self.design(name, spec, &[&nominal])?;
            self.correlation(name, spec, &design)?;
            let inputs = errors.inputs.len();
            if let Some(SensitivitySpec { observations, .. }) = self.file.sensitivity
                && observations > MOST_ENTRIES / inputs
            {
                let expected = format!(
                    "at most {} of the {inputs} uncertain parameters of {name}",
                    MOST_ENTRIES / inputs
                );
                return Err(self.invalid("sensitivity.observations", observations, &expected));
            }
            return Ok(());
        }
        if name == BLOCKS_NAME {
            let expected = "another name for a sampling at several poses: the folder of its tables would be \
                            that of the blocks";
            return Err(self.invalid("samplings", name, expected));
        }
        let design = self.design(name, spec, &[])?.2;
        self.correlation(name, spec, &design)?;
        self.check_poses(name, &set)
    }
}
