//! What leaves the program: lines on the standard output, one line on the standard error for what went wrong, the exit code.

use std::error::Error;
use std::fmt;
use std::io::{self, ErrorKind, Write};
use std::process::ExitCode;
use std::sync::OnceLock;

/// Exit codes, as `cdpr --help` and docs/COMMANDS.md state them.
pub(crate) const EXIT_CODES: &str = "Exit codes:
  0    all that was asked for is done
  1    it cannot be done: a wrong or unreadable file, no answer, a place that cannot be written; the standard error says why
  2    wrong arguments; the standard error says why
  3    done, but something is wrong: `check` warns, a case of `direct --from` has no answer, `--certify` proves nothing
  130  a study was interrupted (Ctrl-C, the end of a job): what is done is kept, and the standard error says how to go on";

/// How a command ended that did all it could.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    /// All is well.
    Well,
    /// What was printed tells of something wrong.
    SomethingWrong,
}

/// Arguments that clap cannot judge one by one.
#[derive(Debug)]
pub(crate) struct Usage(pub(crate) String);

impl fmt::Display for Usage {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}\n\nFor more information, try '--help'.", self.0)
    }
}

impl Error for Usage {}

/// Why the standard output could not be written, the first time.
static UNPRINTED: OnceLock<io::Error> = OnceLock::new();

/// Prints a line as std's macro does, but without a panic where nobody reads on (`cdpr ... | head`): the command goes on and writes its
/// files; [`exit_code`] has the last word.
macro_rules! println {
    () => { $crate::output::print_line(format_args!("")) };
    ($($text:tt)*) => { $crate::output::print_line(format_args!($($text)*)) };
}

pub(crate) fn print_line(line: fmt::Arguments) {
    if UNPRINTED.get().is_none()
        && let Err(error) = writeln!(io::stdout().lock(), "{line}")
    {
        // The first reason is kept.
        let _ = UNPRINTED.set(error);
    }
}

/// Says on the standard error what went wrong, if anything. A reader that reads no further is nothing wrong.
pub(crate) fn exit_code(result: Result<Ending, Box<dyn Error>>) -> ExitCode {
    let unprinted = UNPRINTED.get().filter(|error| error.kind() != ErrorKind::BrokenPipe);
    let (code, message) = match (result, unprinted) {
        (Err(error), _) if error.is::<Usage>() => (2, Some(error.to_string())),
        (Err(error), _) => (1, Some(error.to_string())),
        (Ok(_), Some(error)) => (1, Some(format!("cannot write to the standard output: {error}"))),
        (Ok(Ending::SomethingWrong), None) => (3, None),
        (Ok(Ending::Well), None) => (0, None),
    };
    if let Some(message) = message {
        // Nothing is left to tell where this cannot be written either.
        let _ = writeln!(io::stderr(), "error: {message}");
    }
    ExitCode::from(code)
}
