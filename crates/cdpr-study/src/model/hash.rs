//! The hashes by which a study and its blocks are recognized.

use crate::error::StudyError;
use crate::file::output::Output;
use crate::file::study_file::SamplingSpec;
use crate::model::study::Study;
use cdpr_robot::{Provenance, Robot};
use cdpr_sensitivity::POINTS_VERSION;
use cdpr_statics::Load;
use serde::Serialize;

impl Study {
    /// Hash of everything that determines the observations: robot, error models, poses, payload, output,
    /// seed, version of the program and of its designs. Names, titles, numbers of observations and statistics
    /// do not enter.
    ///
    /// # Errors
    /// A study that was read successfully has no errors here.
    pub fn hash(&self) -> Result<String, StudyError> {
        let mut file = self.file.clone();
        (file.name, file.source, file.robot) = Default::default();
        // All of these ask for more or fewer rows of the same designs, or for other statistics of them.
        (file.replicates, file.confidence, file.bootstrap_resamples, file.sensitivity) = Default::default();
        for sampling in file.samplings.values_mut() {
            (sampling.title, sampling.observations) = Default::default();
        }
        file.groups.clear();
        file.prices.clear();
        file.surfaces.clear();
        self.hash_of(&file)
    }

    /// Hash of everything that determines the observations of one sampling of the study file: the same, but
    /// no other sampling and no other error model.
    ///
    /// # Errors
    /// As [`Study::hash`].
    pub(crate) fn sampling_hash(&self, spec: &SamplingSpec) -> Result<String, StudyError> {
        let model = self.file.error_models.get(&spec.error_model);
        let spec = SamplingSpec {
            title: String::new(),
            observations: 0,
            error_model: String::new(),
            ..spec.clone()
        };
        let file = &self.file;
        let content = (spec, model, file.payload, file.seed);
        if let Some(weather) = &file.weather {
            return self.hash_of(&(content, file.output, file.amplitude, (file.force, file.moment), weather));
        }
        if file.load() != Load::payload(file.payload) {
            let wrench = (file.force, file.moment);
            return self.hash_of(&(content, file.output, file.amplitude, wrench));
        }
        match self.file.output {
            Output::Deflection => self.hash_of(&content),
            Output::Amplitude => self.hash_of(&(content, Output::Amplitude, self.file.amplitude)),
            output => self.hash_of(&(content, output)),
        }
    }

    fn hash_of(&self, content: &impl Serialize) -> Result<String, StudyError> {
        let mut hasher = blake3::Hasher::new();
        let whole = (env!("CARGO_PKG_VERSION"), POINTS_VERSION, content, nameless(&self.robot));
        serde_json::to_writer(&mut hasher, &whole)
            .map_err(|error| StudyError::Write { path: self.path.clone(), source: error.into() })?;
        // 128 bits distinguish studies, and can be read out.
        Ok(hasher.finalize().to_hex()[..32].to_owned())
    }
}

/// Hash of everything that determines what a robot does: of its file without name and provenance.
pub fn robot_hash(robot: &Robot) -> String {
    blake3::hash(nameless(robot).as_bytes()).to_hex()[..32].to_owned()
}

fn nameless(robot: &Robot) -> String {
    Robot { name: String::new(), provenance: Provenance::default(), ..robot.clone() }.to_json()
}
