//! The blocks of a study in their order, which shards and the processes of a parallel run share out.

use crate::error::StudyError;
use crate::model::designs::{Design, Points};
use crate::model::pose_set::PoseSet;
use crate::model::study::{Sampling, Study};
use crate::observe::observation::{Session, Task, observe_block};
use crate::observe::shard::Shard;
use crate::store::block;
use crate::store::blocks::BlockId;
use std::ops::Range;

/// All blocks of a study, numbered from 0: those of each design, for each pose, for each sampling in turn.
/// Blocks of poses without feasible tensions are numbered, too, and stay empty: the blocks can be shared out
/// without solving any pose.
#[derive(Clone, Debug)]
pub struct Plan<'a> {
    study: &'a Study,
    parts: Vec<PlanPart<'a>>,
    blocks: usize,
}

/// The blocks of a sampling.
#[derive(Clone, Debug)]
struct PlanPart<'a> {
    name: &'a str,
    poses: PoseSet<'a>,
    designs: Vec<(Design, usize)>,
    /// Index of its first block.
    first: usize,
    /// Blocks of each pose.
    of_pose: usize,
}

/// A block of a study.
pub(crate) struct Planned<'a> {
    /// Name of the sampling in the study file.
    pub(crate) entry: &'a str,
    /// Name of the sampling at one pose.
    pub(crate) sampling: String,
    pub(crate) design: Design,
    /// Index in the design.
    pub(crate) number: usize,
    /// Indices of its observations.
    pub(crate) range: Range<usize>,
}

impl<'a> Plan<'a> {
    /// The plan of a study.
    ///
    /// # Errors
    /// A study that was read successfully has no errors here.
    pub fn new(study: &'a Study) -> Result<Self, StudyError> {
        let mut plan = Self { study, parts: Vec::new(), blocks: 0 };
        for (name, spec) in &study.file.samplings {
            let (poses, designs) = (study.poses(name, spec)?, study.designs(name, spec)?);
            let of_pose = designs.iter().map(|(_, points)| block::count(*points)).sum::<usize>();
            plan.parts.push(PlanPart { name, poses, designs, first: plan.blocks, of_pose });
            plan.blocks += of_pose * poses.several().unwrap_or(1);
        }
        Ok(plan)
    }

    /// Number of blocks.
    pub fn blocks(&self) -> usize {
        self.blocks
    }

    /// Observations of a shard: those of its blocks.
    pub fn observations(&self, shard: Shard) -> usize {
        self.of_shard(shard).filter_map(|block| self.block(block)).map(|block| block.range.len()).sum()
    }

    /// Indices of the blocks of a shard.
    fn of_shard(&self, shard: Shard) -> impl Iterator<Item = usize> {
        (0..self.blocks).filter(move |block| shard.has(*block))
    }

    /// The block with an index; `None` beyond the last one.
    pub(crate) fn block(&self, block: usize) -> Option<Planned<'a>> {
        if block >= self.blocks {
            return None;
        }
        let part = self.parts.iter().rfind(|part| part.first <= block)?;
        let (pose, mut rest) = ((block - part.first) / part.of_pose, (block - part.first) % part.of_pose);
        for (design, points) in &part.designs {
            let count = block::count(*points);
            if rest < count {
                let (entry, sampling) = (part.name, part.poses.name(part.name, pose));
                let range = block::range(*points, rest);
                return Some(Planned { entry, sampling, design: *design, number: rest, range });
            }
            rest -= count;
        }
        None
    }
}

/// Makes blocks in any order. Data that neighbours share are kept from one to the next.
pub struct BlockMaker<'a> {
    plan: &'a Plan<'a>,
    session: Session<'a>,
    /// `None` for a pose without feasible tensions.
    sampling: Option<(String, Option<Sampling<'a>>)>,
    design: Option<(Design, Box<dyn Points>)>,
}

impl<'a> BlockMaker<'a> {
    /// A maker of the blocks of a plan.
    pub fn new(plan: &'a Plan<'a>, session: Session<'a>) -> Self {
        Self { plan, session, sampling: None, design: None }
    }

    /// Makes a block, by its index in the plan, unless it is on disk. A pose without feasible tensions has no
    /// blocks.
    ///
    /// # Errors
    /// [`StudyError::Setting`] for an index outside the plan, those of the session's blocks;
    /// [`StudyError::Statistics`] for a design that cannot be made.
    pub fn make(&mut self, block: usize) -> Result<(), StudyError> {
        let Some(Planned { sampling: name, design: kind, number, range, .. }) = self.plan.block(block) else {
            let expected = format!("less than {}, the number of blocks", self.plan.blocks);
            return Err(StudyError::setting("block", block, expected));
        };
        let design_name = kind.name();
        let id = BlockId { sampling: &name, design: &design_name, number, recorded: kind.recorded() };
        if let Some(blocks) = self.session.blocks
            && blocks.known(&id, self.session.warn)?.len() >= range.len()
        {
            (self.session.tick)(range.len());
            return Ok(());
        }
        let study = self.plan.study;
        if self.sampling.as_ref().is_none_or(|(known, _)| *known != name) {
            self.design = None;
            self.sampling = Some((name.clone(), study.held(&name)?));
        }
        let Some((_, Some(sampling))) = &self.sampling else {
            (self.session.tick)(range.len());
            return Ok(());
        };
        // Made when the first block needs it: Saltelli's takes seconds.
        if self.design.as_ref().is_none_or(|(known, _)| *known != kind) {
            let field = || format!("samplings.{name}: design `{design_name}`");
            let design = kind.make(sampling).map_err(|source| study.statistics(field(), source))?;
            self.design = Some((kind, design));
        }
        if let Some((_, design)) = &self.design {
            let recorded = kind.recorded();
            let task = Task { name: &design_name, points: design.as_ref(), recorded };
            observe_block(sampling, task, (number, range), &self.session, &|_| ())?;
        }
        Ok(())
    }
}

/// Makes the blocks of a shard that are not on disk; of each design in turn, so that all shards are as long.
///
/// # Errors
/// As [`BlockMaker::make`].
pub fn observe_shard(study: &Study, shard: Shard, session: &Session) -> Result<(), StudyError> {
    let plan = Plan::new(study)?;
    let mut maker = BlockMaker::new(&plan, *session);
    plan.of_shard(shard).try_for_each(|block| maker.make(block))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn a_block_beyond_the_last_one_is_an_error() {
        let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies/caroca.json"));
        let mut study = Study::open(path).unwrap();
        study.file.replicates = 0;
        study.set_observations(3).unwrap();
        let plan = Plan::new(&study).unwrap();
        let mut maker = BlockMaker::new(&plan, Session::in_memory());
        assert!(maker.make(plan.blocks() - 1).is_ok());
        for beyond in [plan.blocks(), 2 * plan.blocks(), usize::MAX] {
            let error = maker.make(beyond).unwrap_err().to_string();
            assert!(error.starts_with(&format!("block is {beyond}: expected less than")), "{error}");
        }
    }
}
