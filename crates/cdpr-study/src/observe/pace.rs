//! How long samplings take that the scalar models observe, one robot at a time.

use crate::error::StudyError;
use crate::file::output::Recorded;
use crate::model::study::Study;
use crate::observe::observation::draw;
use cdpr_sensitivity::SampleDesign;
use cdpr_statics::batch::ScalarReason;
use std::fmt;
use std::time::Instant;

/// A sampling whose observations are left to the scalar models.
#[derive(Clone, Debug, PartialEq)]
pub struct ScalarSampling {
    /// Its name.
    pub name: String,
    /// Observations of all its designs.
    pub observations: usize,
    /// Why they are left to the scalar models.
    pub reason: ScalarReason,
    /// What they take on all threads, from the time that a few of them took [s].
    pub seconds: f64,
}

impl fmt::Display for ScalarSampling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, observations, reason, seconds } = self;
        write!(f, "{name}: {observations} observations will take about {seconds:.0} s, because {reason}")
    }
}

/// Observations that are timed.
const TIMED: usize = 4;

impl Study {
    /// The samplings at one pose that the scalar models observe, all or most of them.
    ///
    /// # Errors
    /// Those of [`Study::sampling`].
    pub fn scalar_samplings(&self) -> Result<Vec<ScalarSampling>, StudyError> {
        let mut slow = Vec::new();
        for (name, _) in self.file.samplings.iter().filter(|(_, spec)| spec.poses.is_none()) {
            let sampling = self.sampling(name)?;
            let rows = draw(&sampling.design, 0..TIMED.min(sampling.design.points()));
            let clock = Instant::now();
            let observed = sampling.observer.observe_inputs(&sampling.errors, &rows, Recorded::Output);
            let each = clock.elapsed().as_secs_f64() / observed.len() as f64;
            let reasons: Vec<_> = observed.iter().flatten().filter_map(|found| found.scalar).collect();
            if let (Some(reason), true) = (reasons.first(), 2 * reasons.len() > observed.len()) {
                let observations = self.observations(name)?;
                let seconds = each * observations as f64 / rayon::current_num_threads() as f64;
                slow.push(ScalarSampling { name: name.clone(), observations, reason: *reason, seconds });
            }
        }
        Ok(slow)
    }
}
