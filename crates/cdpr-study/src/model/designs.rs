//! The designs that a sampling is observed at: its own, scrambled replicates of it, and those of the measures
//! of sensitivity. A row follows from its index alone, so that blocks of a design stay what they are when it
//! grows.

use crate::error::StudyError;
use crate::file::output::Recorded;
use crate::file::sensitivity_spec::{SensitivitySpec, VERDICT_POINTS};
use crate::file::study_file::SamplingSpec;
use crate::model::study::{Sampling, Study};
use cdpr_sensitivity::{
    Correlated, Group, MorrisDesign, Order, RandomDesign, SaltelliDesign, SampleDesign, SensitivityError,
    ShapleyDesign, SobolDesign, derived_seed,
};

/// Name of the sampling's own design.
pub(crate) const OWN: &str = "sampling";

/// Name of Saltelli's blocks.
const SALTELLI: &str = "saltelli";

/// Rows of inputs, of a design of any type.
pub(crate) trait Points: Sync {
    /// Number of rows.
    fn size(&self) -> usize;

    /// Number of inputs, one a column.
    fn columns(&self) -> usize;

    /// Writes consecutive rows, one after the other, from that of observation `first` on: whole ones of the
    /// design.
    fn fill(&self, first: usize, rows: &mut [f64]);
}

impl<D: SampleDesign> Points for D {
    fn size(&self) -> usize {
        self.points()
    }

    fn columns(&self) -> usize {
        self.inputs().len()
    }

    fn fill(&self, first: usize, rows: &mut [f64]) {
        let drawn = self.rows(first, rows);
        debug_assert_eq!(drawn, Ok(()));
    }
}

/// A design by what it is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Design {
    Own,
    /// Number of the replicate, from 1.
    Replicate(usize),
    /// Levels of trajectories; without them, radial blocks.
    Morris(Option<u32>),
    /// Saltelli's blocks, of which this is kept.
    Saltelli(Recorded),
    Shapley,
    /// Independent rows, of which this is kept.
    Random(Recorded),
    /// One of these over groups, whose key tells them from other groups.
    Groups(Grouped, u32),
}

/// A design over groups of inputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Grouped {
    Morris(Option<u32>),
    Saltelli,
}

impl Design {
    pub(crate) fn name(self) -> String {
        match self {
            Self::Own => OWN.to_owned(),
            Self::Replicate(number) => replicate_name(number),
            Self::Morris(None) => "morris".to_owned(),
            Self::Morris(Some(levels)) => format!("morris-{levels}-levels"),
            Self::Saltelli(Recorded::Output) => SALTELLI.to_owned(),
            Self::Saltelli(Recorded::Motion) => format!("{SALTELLI}-poses"),
            Self::Shapley => "shapley".to_owned(),
            Self::Random(Recorded::Output) => "random".to_owned(),
            Self::Random(Recorded::Motion) => "random-poses".to_owned(),
            Self::Groups(Grouped::Morris(levels), key) => {
                format!("{}-of-groups-{key:08x}", Self::Morris(levels).name())
            }
            Self::Groups(Grouped::Saltelli, key) => {
                format!("{SALTELLI}-of-groups-{key:08x}")
            }
        }
    }

    /// What is kept of its observations.
    pub(crate) fn recorded(self) -> Recorded {
        match self {
            Self::Saltelli(recorded) | Self::Random(recorded) => recorded,
            _ => Recorded::Output,
        }
    }

    pub(crate) fn make(self, sampling: &Sampling) -> Result<Box<dyn Points>, SensitivityError> {
        let spec = sampling.study.file.sensitivity.unwrap_or_default();
        Ok(match self {
            Self::Own => sampling.own()?,
            Self::Replicate(number) => Box::new(sampling.replicate(number)),
            Self::Morris(_) => Box::new(sampling.morris_design(&spec)?),
            Self::Saltelli(_) => Box::new(sampling.saltelli_design(spec.saltelli_blocks)?),
            Self::Shapley => Box::new(sampling.shapley_design(spec.shapley_walks)?),
            Self::Random(_) => sampling.random_design(spec.bures_observations)?,
            Self::Groups(Grouped::Morris(_), _) => {
                Box::new(sampling.morris_design(&spec)?.grouped(sampling.groups.clone())?)
            }
            Self::Groups(Grouped::Saltelli, _) => {
                Box::new(sampling.saltelli_design(spec.saltelli_blocks)?.grouped(sampling.groups.clone())?)
            }
        })
    }
}

pub(crate) fn replicate_name(number: usize) -> String {
    format!("replicate-{number}")
}

impl Study {
    /// Observations that a run makes of a sampling of the study file, at all its poses: those of all designs,
    /// and those whose derivatives are taken.
    ///
    /// # Errors
    /// [`StudyError::Invalid`] for an unknown name.
    pub fn observations(&self, name: &str) -> Result<usize, StudyError> {
        let spec = self.entry(name)?.1;
        let of_designs = self.designs(name, spec)?.into_iter().map(|(_, points)| points).sum::<usize>();
        Ok(match self.poses(name, spec)?.several() {
            Some(poses) => poses * of_designs,
            None if !spec.correlations.is_empty() => of_designs,
            None => of_designs + self.file.sensitivity.map_or(VERDICT_POINTS, |spec| spec.derivative_points),
        })
    }

    /// Observations of all samplings and points of all surfaces: how much a whole run has to make.
    ///
    /// # Errors
    /// As [`Study::observations`].
    pub fn all_observations(&self) -> Result<usize, StudyError> {
        let samplings = self.file.samplings.keys().map(|name| self.observations(name));
        let surfaces = self.file.surfaces.values().map(|surface| surface.x.points * surface.y.points);
        Ok(samplings.sum::<Result<usize, _>>()? + surfaces.sum::<usize>())
    }

    /// All designs of a sampling and their numbers of points. At several poses there is its own alone.
    pub(crate) fn designs(
        &self,
        name: &str,
        spec: &SamplingSpec,
    ) -> Result<Vec<(Design, usize)>, StudyError> {
        let own = (Design::Own, spec.observations);
        if spec.poses.is_some() {
            return Ok(vec![own]);
        }
        let errors = self.design(name, spec, &[])?.0;
        let inputs = errors.inputs.len();
        let mut designs = vec![own];
        let is_correlated = !spec.correlations.is_empty();
        if !is_correlated {
            designs.extend((1..=self.file.replicates).map(|k| (Design::Replicate(k), spec.observations)));
        }
        let Some(measures) = self.file.sensitivity else { return Ok(designs) };
        if !is_correlated {
            let groups = self.groups(&errors)?;
            let (levels, key) = (measures.morris_levels, key(&groups));
            let morris = |moved: usize| measures.morris_blocks * (moved + 1);
            let saltelli = |exchanged: usize| measures.saltelli_blocks * (exchanged + 2);
            let of_saltelli = Design::Saltelli(measures.vector.recorded());
            designs.extend([(Design::Morris(levels), morris(inputs)), (of_saltelli, saltelli(inputs))]);
            if !groups.is_empty() {
                designs.extend([
                    (Design::Groups(Grouped::Morris(levels), key), morris(groups.len())),
                    (Design::Groups(Grouped::Saltelli, key), saltelli(groups.len())),
                ]);
            }
            designs.retain(|(_, points)| *points > 0);
        }
        if measures.bures_observations > 0 {
            designs.push((Design::Random(measures.vector.recorded()), measures.bures_observations));
        }
        if measures.shapley_walks > 0 {
            designs.push((Design::Shapley, measures.shapley_walks * (inputs + 1)));
        }
        Ok(designs)
    }
}

/// A number that tells groups of inputs from others; their names do not matter.
pub(crate) fn key(groups: &[Group]) -> u32 {
    let mut hasher = blake3::Hasher::new();
    for group in groups {
        hasher.update(format!("{:?}", group.inputs).as_bytes());
    }
    let [a, b, c, d, ..] = *hasher.finalize().as_bytes();
    u32::from_be_bytes([a, b, c, d])
}

impl Sampling<'_> {
    /// The sampling's own points, which may be correlated.
    pub(crate) fn own(&self) -> Result<Box<dyn Points>, SensitivityError> {
        Ok(match &self.correlation {
            Some(matrix) => Box::new(Correlated::new(self.design.clone(), matrix)?),
            None => Box::new(self.design.clone()),
        })
    }

    pub(crate) fn shapley_design(&self, walks: usize) -> Result<ShapleyDesign, SensitivityError> {
        let design = ShapleyDesign::new(self.design.inputs().to_vec(), walks, self.study.file.seed)?;
        match &self.correlation {
            Some(matrix) => design.correlated(matrix),
            None => Ok(design),
        }
    }

    /// Independent rows of the joint law.
    pub(crate) fn random_design(&self, points: usize) -> Result<Box<dyn Points>, SensitivityError> {
        let design = RandomDesign::new(self.design.inputs().to_vec(), points, self.study.file.seed)?;
        Ok(match &self.correlation {
            Some(matrix) => Box::new(Correlated::new(design, matrix)?),
            None => Box::new(design),
        })
    }

    /// A scrambled replicate of the sampling's design.
    pub(crate) fn replicate(&self, number: usize) -> SobolDesign {
        self.design.replicate(derived_seed(self.study.file.seed, number as u64))
    }

    pub(crate) fn morris_design(&self, spec: &SensitivitySpec) -> Result<MorrisDesign, SensitivityError> {
        let (inputs, blocks, seed) =
            (self.design.inputs().to_vec(), spec.morris_blocks, self.study.file.seed);
        match spec.morris_levels {
            Some(levels) => MorrisDesign::trajectories(inputs, blocks, levels, seed),
            None => MorrisDesign::radial(inputs, blocks, seed),
        }
    }

    pub(crate) fn saltelli_design(&self, blocks: usize) -> Result<SaltelliDesign, SensitivityError> {
        let inputs = self.design.inputs().to_vec();
        SaltelliDesign::scrambled(inputs, blocks, Order::First, self.study.file.seed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn replicates_of_neighbouring_seeds_share_no_point() {
        let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies/caroca.json"));
        let mut study = Study::open(path).unwrap();
        let mut rows = Vec::new();
        for seed in 1..=3 {
            study.file.seed = seed;
            let sampling = study.sampling("mechanical").unwrap();
            rows.extend((1..=3).map(|number| {
                let mut row = vec![0.0; sampling.design.inputs().len()];
                sampling.replicate(number).row(0, &mut row).unwrap();
                row
            }));
        }
        for (k, row) in rows.iter().enumerate() {
            assert!(!rows[..k].contains(row), "{k}");
        }
    }
}
