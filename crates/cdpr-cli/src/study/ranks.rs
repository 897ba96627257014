//! A study shared out by MPI.
//!
//! Rank 0 hands the next block to whoever asks, and meanwhile makes blocks itself. Blocks go to the disk that
//! all ranks see, where rank 0 finds them when it analyses the whole. A message is one number: to rank 0, the
//! number of observations since the last message; from rank 0, the block to make next, or [`NO_MORE`]. A rank
//! that dies takes the others with it, as MPI has it; what is on the disk stays there for `--resume`.

use super::carry_out::whole;
use super::common::{RunSettings, begun};
use crate::error::ProgramError;
use crate::output::Ending;
use crate::questions::take_results;
use cdpr_study::{Access, BlockMaker, Plan, Session, StoredStudy, Study};
use mpi::Threading;
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, CommunicatorCollectives, Destination, Source};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

/// The message in place of a block when there are no more.
const NO_MORE: u64 = u64::MAX;

/// How long rank 0 waits before it looks for messages again: a receive that waits would occupy a core.
const LOOK_AGAIN: Duration = Duration::from_millis(1);

/// Runs `cdpr study run` on all ranks; `expected` is their number by the launcher.
pub(super) fn share_out(settings: &RunSettings, expected: usize) -> Result<Ending, ProgramError> {
    // All messages are sent and received by this thread.
    let universe = mpi::initialize_with_threading(Threading::Funneled);
    let Some((universe, _)) = universe else { return Err(ProgramError::Ranks { expected, found: 0 }) };
    let world = universe.world();
    let found = usize::try_from(world.size()).unwrap_or(0);
    let result = match world.rank() {
        _ if found != expected => Err(ProgramError::Ranks { expected, found }),
        0 => lead(&world, settings),
        _ => follow(&world, settings).map(|()| Ending::Well),
    };
    result.map_err(|error| {
        eprintln!("error: {error}");
        // The other ranks would wait for this one forever.
        world.abort(1)
    })
}

fn lead(world: &SimpleCommunicator, settings: &RunSettings) -> Result<Ending, ProgramError> {
    let (study, blocks) = begun(settings)?;
    blocks.share()?;
    // The folder is there: from now on the other ranks read the study in it.
    world.barrier();
    whole(&study, &settings.out, &blocks, &settings.common, |session| {
        hand_out(world, &study, session)?;
        // The other ranks have let go of the folder.
        world.barrier();
        Ok(blocks.take_alone()?)
    })
}

/// Hands out all blocks, some of which another thread of this process makes.
fn hand_out(world: &SimpleCommunicator, study: &Study, session: &Session) -> Result<(), ProgramError> {
    let plan = Plan::new(study)?;
    let handed_out = AtomicUsize::new(0);
    let next = || Some(handed_out.fetch_add(1, Ordering::Relaxed)).filter(|block| *block < plan.blocks());
    std::thread::scope(|scope| {
        let own = scope.spawn(|| {
            let mut maker = BlockMaker::new(&plan, *session);
            std::iter::from_fn(next).try_for_each(|block| maker.make(block))
        });
        let mut own = Some(own);
        let mut others = world.size() - 1;
        while others > 0 || own.is_some() {
            if let Some(finished) = own.take_if(|own| own.is_finished()) {
                match finished.join() {
                    Ok(result) => result?,
                    Err(panic) => std::panic::resume_unwind(panic),
                }
            }
            let Some(status) = world.any_process().immediate_probe() else {
                std::thread::sleep(LOOK_AGAIN);
                continue;
            };
            let rank = world.process_at_rank(status.source_rank());
            let (done, _): (u64, _) = rank.receive();
            (session.tick)(done as usize);
            let block = next();
            rank.send(&block.map_or(NO_MORE, |block| block as u64));
            others -= i32::from(block.is_none());
        }
        Ok(())
    })
}

/// Makes blocks until rank 0 has no more.
fn follow(world: &SimpleCommunicator, settings: &RunSettings) -> Result<(), ProgramError> {
    settings.common.threads.start()?;
    world.barrier();
    make_blocks(world, settings)?;
    world.barrier();
    Ok(())
}

/// Makes the blocks that rank 0 hands out, in a folder shared with it.
fn make_blocks(world: &SimpleCommunicator, settings: &RunSettings) -> Result<(), ProgramError> {
    let StoredStudy { study, blocks } = take_results(&settings.out, Access::Shared)?;
    let plan = Plan::new(&study)?;
    let done = AtomicUsize::new(0);
    let tick = |observations: usize| {
        done.fetch_add(observations, Ordering::Relaxed);
    };
    let warn = |damage: &_| eprintln!("warning: {damage}; it is made again");
    let mut maker =
        BlockMaker::new(&plan, Session { blocks: Some(&blocks), tick: &tick, warn: &warn, stop: &|| false });
    let leader = world.process_at_rank(0);
    loop {
        leader.send(&(done.swap(0, Ordering::Relaxed) as u64));
        let (block, _): (u64, _) = leader.receive();
        if block == NO_MORE {
            return Ok(());
        }
        maker.make(block as usize)?;
    }
}
