//! The designs that a sampling is observed at: its own, scrambled replicates of it, and those of the measures of sensitivity. A row
//! follows from its index alone, so that blocks of a design stay what they are when it grows.

use crate::block::blocks;
use crate::error::StudyError;
use crate::observation::{Session, observe_block};
use crate::shard::Shard;
use crate::store::Place;
use crate::study::{Sampling, Study};
use cdpr_sensitivity::{MorrisDesign, Order, SaltelliDesign, SampleDesign, SensitivityError, SobolDesign};

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

    /// Writes consecutive rows, one after the other, from that of observation `first` on: whole ones of the design.
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

    fn make(self, sampling: &Sampling) -> Result<Box<dyn Points>, SensitivityError> {
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

impl Sampling<'_> {
    /// Observations that a run makes: those of all designs, and those whose derivatives are taken.
    pub fn observations(&self) -> usize {
        let derivatives = self.study.file.sensitivity.map_or(0, |spec| spec.derivative_points);
        self.designs().into_iter().map(|(_, points)| points).sum::<usize>() + derivatives
    }

    /// All designs and their numbers of points.
    pub(crate) fn designs(&self) -> Vec<(Design, usize)> {
        let (own, inputs) = (self.design.points(), self.errors.inputs.len());
        let replicates = (1..=self.study.file.replicates).map(|number| (Design::Replicate(number), own));
        let measures = self.study.file.sensitivity.map(|spec| {
            let (morris, saltelli) = (spec.morris_blocks * (inputs + 1), spec.saltelli_blocks * (inputs + 2));
            [(Design::Morris, morris), (Design::Saltelli, saltelli)]
        });
        [(Design::Own, own)].into_iter().chain(replicates).chain(measures.into_iter().flatten()).collect()
    }

    /// A scrambled replicate of the sampling's design.
    pub(crate) fn replicate(&self, number: usize) -> SobolDesign {
        self.design.replicate(self.study.file.seed.wrapping_add(number as u64))
    }

    pub(crate) fn morris_design(&self, blocks: usize) -> Result<MorrisDesign, SensitivityError> {
        MorrisDesign::radial(self.design.inputs().to_vec(), blocks, self.study.file.seed)
    }

    pub(crate) fn saltelli_design(&self, blocks: usize) -> Result<SaltelliDesign, SensitivityError> {
        let inputs = self.design.inputs().to_vec();
        SaltelliDesign::scrambled(inputs, blocks, Order::First, self.study.file.seed)
    }
}

impl Study {
    /// Blocks of all designs of all samplings: as many shards make one block each.
    ///
    /// # Errors
    /// None that a study which was read can have.
    pub fn blocks(&self) -> Result<usize, StudyError> {
        let of_sampling = |name: &String| {
            let designs = self.sampling(name)?.designs();
            Ok(designs.into_iter().map(|(_, points)| blocks(points).count()).sum::<usize>())
        };
        self.file.samplings.keys().map(of_sampling).sum()
    }
}

/// Makes the blocks of a shard that are not on disk; of each design in turn, so that all shards are as long.
///
/// # Errors
/// Those of the session's blocks; [`StudyError::Stopped`]; [`StudyError::Statistics`] for a design that cannot be made.
pub fn observe_shard(study: &Study, shard: Shard, session: &Session) -> Result<(), StudyError> {
    let mut count = 0;
    for name in study.file.samplings.keys() {
        let sampling = study.sampling(name)?;
        for (kind, points) in sampling.designs() {
            let design_name = kind.name();
            let mut design = None;
            for (number, range) in blocks(points) {
                count += 1;
                if !shard.has(count - 1) {
                    continue;
                }
                let place = Place { sampling: name, design: &design_name, number };
                if let Some(blocks) = session.blocks
                    && blocks.known(&place, session.warn)?.len() >= range.len()
                {
                    (session.tick)(range.len());
                    continue;
                }
                // Made when the first block needs it: Saltelli's takes seconds.
                let design = match &mut design {
                    Some(design) => design,
                    none => none.insert(kind.make(&sampling).map_err(|source| StudyError::Statistics {
                        path: study.path.clone(),
                        field: format!("samplings.{name}: design `{design_name}`"),
                        source,
                    })?),
                };
                let design = (design_name.as_str(), design.as_ref());
                observe_block(&sampling, design, (number, range), session, &|_| ())?;
            }
        }
    }
    Ok(())
}
