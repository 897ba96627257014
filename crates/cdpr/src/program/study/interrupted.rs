//! What ends a run before its time: Ctrl-C, the end of a job on a cluster, a terminal that is closed.
//!
//! Other commands leave these signals to the system, which ends them at once. A run says first how it is
//! continued.

use crate::program::error::ProgramError;
use indicatif::ProgressBar;
use std::io::{self, Write};
use std::path::Path;

/// Exit code of an interrupted run, as shells have it.
const INTERRUPTED: i32 = 130;

/// Ends the process, when a signal asks for it, with a message of how to continue.
///
/// Nothing has to be put in order: a block is whole or not there.
pub(super) fn leave(progress: &ProgressBar, out: &Path, remedy: String) -> Result<(), ProgramError> {
    let (progress, out) = (progress.clone(), out.display().to_string());
    on_signal(move || {
        progress.abandon();
        // A terminal that was closed takes no text.
        let _ = writeln!(io::stderr(), "\ninterrupted: what is done is in {out}; {remedy}");
        std::process::exit(INTERRUPTED);
    })
}

#[cfg(unix)]
fn on_signal(end: impl FnOnce() + Send + 'static) -> Result<(), ProgramError> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let ending = if is_hangup_ignored() { vec![SIGINT, SIGTERM] } else { vec![SIGINT, SIGTERM, SIGHUP] };
    let system = |error| ProgramError::Signals(ctrlc::Error::System(error));
    let mut signals = signal_hook::iterator::Signals::new(ending).map_err(system)?;
    let wait = move || {
        if signals.forever().next().is_some() {
            end();
        }
    };
    std::thread::Builder::new().name("signals".to_owned()).spawn(wait).map_err(system)?;
    Ok(())
}

#[cfg(not(unix))]
fn on_signal(end: impl Fn() + Send + 'static) -> Result<(), ProgramError> {
    Ok(ctrlc::set_handler(end)?)
}

/// Whether the process was started so that it outlives its terminal, as `nohup` starts it. Linux says which
/// signals are ignored, as a number with a bit for each, of which that of a hangup is the first.
#[cfg(unix)]
fn is_hangup_ignored() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    ignored.and_then(|bits| u64::from_str_radix(bits.trim(), 16).ok()).is_some_and(|bits| bits & 1 == 1)
}
