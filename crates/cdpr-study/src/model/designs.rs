//! The designs that a sampling is observed at: its own, scrambled replicates of it, and those of the measures
//! of sensitivity. A row follows from its index alone, so that blocks of a design stay what they are when it
//! grows.

use crate::error::StudyError;
use crate::file::study_file::SamplingSpec;
use crate::model::study::{Sampling, Study};
use cdpr_sensitivity::{
    MorrisDesign, Order, SaltelliDesign, SampleDesign, SensitivityError, SobolDesign, derived_seed,
};

/// Name of the sampling's own design.
pub(crate) const OWN: &str = "sampling";

/// Name of the design of Morris's elementary effects.
pub(crate) const MORRIS: &str = "morris";

/// Name of the design of Sobol' indices.
pub(crate) const SALTELLI: &str = "saltelli";

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
    Morris,
    Saltelli,
}

impl Design {
    pub(crate) fn name(self) -> String {
        match self {
            Self::Own => OWN.to_owned(),
            Self::Replicate(number) => replicate_name(number),
            Self::Morris => MORRIS.to_owned(),
            Self::Saltelli => SALTELLI.to_owned(),
        }
    }

    pub(crate) fn make(self, sampling: &Sampling) -> Result<Box<dyn Points>, SensitivityError> {
        let spec = sampling.study.file.sensitivity.unwrap_or_default();
        Ok(match self {
            Self::Own => Box::new(sampling.design.clone()),
            Self::Replicate(number) => Box::new(sampling.replicate(number)),
            Self::Morris => Box::new(sampling.morris_design(spec.morris_blocks)?),
            Self::Saltelli => Box::new(sampling.saltelli_design(spec.saltelli_blocks)?),
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
            None => of_designs + self.file.sensitivity.map_or(0, |spec| spec.derivative_points),
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
        let inputs = self.design(name, spec, &[])?.0.inputs.len();
        let replicates =
            (1..=self.file.replicates).map(|number| (Design::Replicate(number), spec.observations));
        let measures = self.file.sensitivity.map(|spec| {
            let (morris, saltelli) = (spec.morris_blocks * (inputs + 1), spec.saltelli_blocks * (inputs + 2));
            [(Design::Morris, morris), (Design::Saltelli, saltelli)]
        });
        Ok([own].into_iter().chain(replicates).chain(measures.into_iter().flatten()).collect())
    }
}

impl Sampling<'_> {
    /// A scrambled replicate of the sampling's design.
    pub(crate) fn replicate(&self, number: usize) -> SobolDesign {
        self.design.replicate(derived_seed(self.study.file.seed, number as u64))
    }

    pub(crate) fn morris_design(&self, blocks: usize) -> Result<MorrisDesign, SensitivityError> {
        MorrisDesign::radial(self.design.inputs().to_vec(), blocks, self.study.file.seed)
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
