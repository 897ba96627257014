//! Work on all cores without Python's lock, which Ctrl-C ends.

use crate::convert::error::{Answer, Raised};
use pyo3::prelude::*;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Threads at most.
const MOST_THREADS: usize = 1024;

/// Time between two looks at signals and callbacks.
const POLL: Duration = Duration::from_millis(50);

/// The pool of a process, with the number of the process.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// A pool of that many threads, or else the pool of this process: all cores, or `RAYON_NUM_THREADS`.
///
/// It is not rayon's global pool: a forked process inherits a pool without its threads and would wait for it
/// forever.
fn pool(threads: Option<usize>) -> Answer<Arc<ThreadPool>> {
    let make = |threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        pool.map(Arc::new).map_err(|error| {
            Raised::Input(format!("threads is {threads}: expected as many as can be started: {error}"))
        })
    };
    match threads {
        Some(0) => return Err(Raised::Input("threads is 0: expected one or more".to_owned())),
        Some(threads) if threads > MOST_THREADS => {
            return Err(Raised::Input(format!("threads is {threads}: expected 1 to {MOST_THREADS}")));
        }
        Some(threads) => return make(threads),
        None => {}
    }
    let mut known = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    if let Some((_, pool)) = known.as_ref().filter(|(owner, _)| *owner == process) {
        return Ok(pool.clone());
    }
    let made = make(0)?;
    // Dropping the parent's pool would wait for its threads, which are in the parent.
    std::mem::forget(known.replace((process, made.clone())));
    Ok(made)
}

/// Runs `work` on a pool without Python's lock, while this thread looks after signals and calls `poll`.
///
/// If one of them raises, the work is asked to stop, and its end is awaited.
pub(crate) fn watched<T: Send>(
    py: Python,
    threads: Option<usize>,
    mut poll: impl FnMut(Python) -> PyResult<()> + Send,
    work: impl FnOnce(&AtomicBool) -> T + Send,
) -> Answer<T> {
    let pool = pool(threads)?;
    let stop = AtomicBool::new(false);
    let (outcome, raised) = py.detach(|| {
        let (done, wait) = channel();
        let (pool, stop) = (&pool, &stop);
        std::thread::scope(|scope| {
            // It owns its end of the channel, which a panic drops.
            let worker = scope.spawn(move || {
                let outcome = pool.install(|| work(stop));
                // The receiver outlives this thread.
                let _ = done.send(());
                outcome
            });
            let mut raised = None;
            while let Err(RecvTimeoutError::Timeout) = wait.recv_timeout(POLL) {
                if raised.is_none()
                    && let Err(error) = Python::attach(|py| py.check_signals().and_then(|()| poll(py)))
                {
                    stop.store(true, Ordering::Relaxed);
                    raised = Some(error);
                }
            }
            (worker.join(), raised)
        })
    });
    match (outcome, raised) {
        (_, Some(error)) => Err(error.into()),
        (Ok(outcome), None) => Ok(outcome),
        (Err(panic), None) => Err(Raised::Fault(words(panic))),
    }
}

/// Does `work` here. A fault of the program is an exception like others, never the end of the interpreter.
pub(crate) fn guarded<T>(work: impl FnOnce() -> T) -> Answer<T> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| Raised::Fault(words(panic)))
}

/// What a panic says.
fn words(panic: Box<dyn Any + Send>) -> String {
    let text = panic.downcast_ref::<&str>().map(ToString::to_string);
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no message".to_owned())
}

/// Runs `work` on the pool of this process, with nothing to poll.
pub(crate) fn run<T: Send>(py: Python, work: impl FnOnce(&AtomicBool) -> T + Send) -> Answer<T> {
    watched(py, None, |_| Ok(()), work)
}

/// Computes `one` for each case in parallel; the results are in the order of the cases.
pub(crate) fn each<T: Send>(py: Python, cases: usize, one: impl Fn(usize) -> T + Sync) -> Answer<Vec<T>> {
    if cases == 1 {
        return Ok(vec![py.detach(|| guarded(|| one(0)))?]);
    }
    let all = run(py, |stop| {
        let one = |case| (!stop.load(Ordering::Relaxed)).then(|| one(case));
        (0..cases).into_par_iter().map(one).collect::<Option<Vec<T>>>()
    })?;
    // Only an exception stops the work, and it has been raised above.
    Ok(all.unwrap_or_default())
}
