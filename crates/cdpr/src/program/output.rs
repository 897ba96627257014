//! Output of the program: lines on the standard output, an error on the standard error, the exit code.

use crate::program::error::ProgramError;
use crate::program::questions;
use crate::program::said::{self, Said};
use cdpr_report::ReportError;
use cdpr_robot::{COLUMNS, broken, shown_lines, wrapped};
use cdpr_study::{IfExists, check_replaceable, write_file};
use comfy_table::{ContentArrangement, Table, presets};
use indicatif::{ProgressBar, ProgressState, ProgressStyle, WeakProgressBar};
use std::borrow::Cow;
use std::fmt;
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

/// Exit codes, as `cdpr --help` and docs/COMMANDS.md state them.
pub(crate) const EXIT_CODES: &str = "Exit codes:
  0    all that was requested is done
  1    it cannot be done: a wrong or unreadable file, no answer, a place that
       cannot be written; the standard error says why
  2    wrong arguments; the standard error says why
  3    done, but something is wrong: a value is questioned, `robot check` warns,
       a case of `direct --from` or a pose of `--poses` has no answer, a
       platform falls before the whole load is on it, cables cross each other or
       the platform, a certificate proves nothing, a tension is above
       tension_limits.max or a breaking force, less than half of the positions
       of a map or of the candidate poses are held, or of the observations have
       succeeded
  130  a study was interrupted (Ctrl-C, the end of a job): what is done is kept,
       and the standard error says how to go on";

/// How a command ended that did what it was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    /// All is well.
    Well,
    /// Something that was printed is wrong: a warning, a case without an answer.
    SomethingWrong,
}

impl Ending {
    /// The ending of both.
    pub(crate) fn and(self, other: Self) -> Self {
        if self == Self::Well { other } else { self }
    }
}

/// The file for the answer, and what is printed so far.
static ANSWER: Mutex<Option<AnswerFile>> = Mutex::new(None);

struct AnswerFile {
    path: PathBuf,
    if_exists: IfExists,
    text: String,
}

/// From now on, what is printed goes to a file, which is written when the command ends; `-` is the standard
/// output.
pub(crate) fn print_to(path: &Path, if_exists: IfExists) {
    if path.as_os_str() == "-" {
        return;
    }
    let mut answer = ANSWER.lock().unwrap_or_else(PoisonError::into_inner);
    if answer.is_none() {
        *answer = Some(AnswerFile { path: path.to_owned(), if_exists, text: String::new() });
    }
}

/// Writes the file for the answer, if there is one.
fn write_answer() -> Result<(), ProgramError> {
    let answer = ANSWER.lock().unwrap_or_else(PoisonError::into_inner).take();
    let Some(AnswerFile { path, if_exists, text }) = answer else { return Ok(()) };
    check_replaceable(&path, &text, if_exists)?;
    Ok(write_file(&path, &text, if_exists)?)
}

/// Why the standard output could not be written, the first time.
static UNPRINTED: OnceLock<io::Error> = OnceLock::new();

/// Prints a line as std's macro does, but never panics, and shows characters of names that a terminal would
/// obey.
///
/// Where nobody reads on (`cdpr ... | head`) the command continues and writes its files; [`exit_code`] tells
/// of any other failure to print.
macro_rules! println {
    () => { $crate::program::output::print_line(format_args!("")) };
    ($($text:tt)*) => { $crate::program::output::print_line(format_args!($($text)*)) };
}

/// Prints a message on the standard error, wrapped at 80 columns. A failure is ignored: there is no other
/// place to report it.
macro_rules! eprintln {
    ($($text:tt)*) => { $crate::program::output::tell_line(format_args!($($text)*)) };
}

/// What `eprintln!` expands to.
pub(crate) fn tell_line(line: fmt::Arguments) {
    let _ = writeln!(io::stderr().lock(), "{}", wrapped(&shown_lines(&line.to_string())));
}

/// What `println!` expands to.
pub(crate) fn print_line(line: fmt::Arguments) {
    let text = line.to_string();
    let line = shown_lines(&text);
    match ANSWER.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
        Some(answer) => {
            answer.text += &line;
            answer.text.push('\n');
        }
        None => write_line(&line),
    }
}

/// Prints a sentence on the standard output, also where the answer goes to a file.
pub(crate) fn print_apart(sentence: &str) {
    broken(sentence).iter().for_each(|line| write_line(&shown_lines(line)));
}

fn write_line(line: &str) {
    if UNPRINTED.get().is_none()
        && let Err(error) = writeln!(io::stdout().lock(), "{line}")
    {
        // The first reason is kept.
        let _ = UNPRINTED.set(error);
    }
}

/// Lets writing beyond the limit of a file's size (`ulimit -f`) fail like other writing. By itself the system
/// would end the process by a signal.
pub(crate) fn survive_file_limit() -> Result<(), ProgramError> {
    #[cfg(unix)]
    {
        use std::sync::atomic::AtomicBool;
        // Nobody reads it: the operation that fails says why.
        static BEYOND: AtomicBool = AtomicBool::new(false);
        signal_hook::flag::register(signal_hook::consts::SIGXFSZ, &BEYOND)
            .map_err(ProgramError::FileLimit)?;
    }
    Ok(())
}

/// Prints what went wrong on the standard error, and returns the exit code.
///
/// A reader that stops reading is no failure.
pub(crate) fn exit_code(result: Result<Ending, ProgramError>) -> ExitCode {
    let result = result.and_then(|ending| write_answer().map(|()| ending));
    let unprinted = UNPRINTED.get().filter(|error| error.kind() != ErrorKind::BrokenPipe);
    let (code, message) = match (result, unprinted) {
        (Err(error), _) => (error.exit_code(), Some(error.to_string())),
        (Ok(_), Some(error)) => (1, Some(format!("cannot write to the standard output: {error}"))),
        (Ok(Ending::SomethingWrong), None) => (3, None),
        (Ok(Ending::Well), None) if questions::were_asked() => (3, None),
        (Ok(Ending::Well), None) => (0, None),
    };
    if let Some(message) = message {
        eprintln!("error: {message}");
    }
    ExitCode::from(code)
}

/// Prints why arguments are refused, or the help that they ask for, and returns the exit code.
pub(crate) fn refused(error: &clap::Error) -> ExitCode {
    let message = error.to_string();
    let is_wide = message.lines().any(|line| line.chars().count() > COLUMNS);
    if error.use_stderr() && is_wide {
        eprintln!("{}", message.trim_end());
        return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
    }
    match error.print() {
        // There is no other place to report it.
        Err(unprinted) if unprinted.kind() != ErrorKind::BrokenPipe && !error.use_stderr() => {
            eprintln!("error: cannot write to the standard output: {unprinted}");
            ExitCode::FAILURE
        }
        _ => ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2)),
    }
}

/// How much is printed. Commands that have more than an answer of 80 columns share this flag.
#[derive(clap::Args)]
pub(crate) struct Details {
    /// Print all results, not only the answer and the table below it; JSON and reports have them in any case.
    #[arg(long)]
    pub(crate) details: bool,
}

/// Prints a sentence on lines of at most 80 columns. A long name of the robot is shortened where the first
/// sentence would have two lines.
pub(crate) fn print_sentence(sentence: &str) {
    broken(&brief(sentence, said::robot())).iter().for_each(|line| println!("{line}"));
}

/// Columns that a shortened name has at least.
const NAME_COLUMNS: usize = 20;

/// A sentence, or several, with a long name in it shortened to what lets the first one have one line.
pub(crate) fn brief<'a>(sentence: &'a str, name: &str) -> Cow<'a, str> {
    let columns = name.chars().count();
    let found = sentence.find(name).filter(|_| columns > NAME_COLUMNS);
    let Some(at) = found else { return Cow::Borrowed(sentence) };
    let (before, after) = (&sentence[..at], &sentence[at + name.len()..]);
    let first = after.find(". ").map_or(after, |end| &after[..=end]);
    let others = before.chars().count() + first.chars().count();
    if others + columns <= COLUMNS {
        return Cow::Borrowed(sentence);
    }
    let kept = COLUMNS.saturating_sub(others).max(NAME_COLUMNS);
    Cow::Owned(format!("{before}{}{after}", cut(name, kept)))
}

/// A name of at most this number of columns, with `...` for what is left out.
pub(crate) fn cut(name: &str, columns: usize) -> String {
    if name.chars().count() <= columns {
        return name.to_owned();
    }
    let kept: String = name.chars().take(columns.saturating_sub(3)).collect();
    format!("{}...", kept.trim_end())
}

/// An empty table whose long cells are broken, so that a line has at most 80 columns.
pub(crate) fn table(header: &[&str]) -> Table {
    let mut table = wide_table(header);
    table.set_content_arrangement(ContentArrangement::Dynamic).set_width(COLUMNS as u16);
    table
}

/// An empty table that is as wide as its cells, for `--details`.
pub(crate) fn wide_table(header: &[&str]) -> Table {
    let mut table = Table::new();
    table.load_style(presets::UTF8_FULL_CONDENSED).set_header(header);
    table
}

/// Time until progress is shown, and between two times that it is shown.
#[derive(Clone, Copy)]
struct Pace {
    first: Duration,
    step: Duration,
}

/// On a terminal.
const SEEN: Pace = Pace { first: Duration::from_secs(1), step: Duration::from_secs(1) };

/// In a log, a line each time.
const LOGGED: Pace = Pace { first: Duration::from_secs(5), step: Duration::from_secs(30) };

impl Pace {
    /// Shows progress until the work is done, whose end the channel tells by being closed.
    fn show(self, work: &Receiver<()>, mut show: impl FnMut()) {
        let mut wait = self.first;
        while work.recv_timeout(wait) == Err(RecvTimeoutError::Timeout) {
            wait = self.step;
            show();
        }
    }
}

/// Does what may take long and cannot count its steps; after a second, its time is shown.
pub(crate) fn patiently<T>(doing: &str, work: impl FnOnce() -> T) -> T {
    if !said::is_said(Said::Usual) {
        return work();
    }
    let clock = Instant::now();
    let (working, waiting) = std::sync::mpsc::channel::<()>();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            let line = || format!("{doing}, {} s", clock.elapsed().as_secs());
            if !io::stderr().is_terminal() {
                return LOGGED.show(&waiting, || eprintln!("{}", line()));
            }
            let bar = ProgressBar::new_spinner();
            SEEN.show(&waiting, || {
                bar.set_message(line());
                bar.tick();
            });
            bar.finish_and_clear();
        });
        let result = work();
        drop(working);
        result
    })
}

/// Writes a line now and then while a bar is not seen, such as in a log.
fn log_progress(bar: WeakProgressBar, unit: String) {
    std::thread::spawn(move || {
        let mut wait = LOGGED.first;
        loop {
            std::thread::sleep(wait);
            wait = LOGGED.step;
            let Some(bar) = bar.upgrade().filter(|bar| !bar.is_finished()) else { return };
            let (message, done, all) = (bar.message(), bar.position(), bar.length().unwrap_or_default());
            let separator = if message.is_empty() { "" } else { ": " };
            eprintln!("{message}{separator}{done}/{all} {unit}, {} s", bar.elapsed().as_secs());
        }
    });
}

/// A progress bar over `steps`, with rate, time so far and time left; in a log it is a line now and then.
pub(crate) fn progress(steps: usize, unit: &str) -> ProgressBar {
    let rate = |state: &ProgressState, out: &mut dyn fmt::Write| {
        // A terminal that takes no text cannot be helped.
        let _ = write!(out, "{:.0}/s", state.per_sec());
    };
    if !said::is_said(Said::Usual) {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(steps as u64);
    if !io::stderr().is_terminal() {
        log_progress(bar.downgrade(), unit.to_owned());
    }
    // What follows the last step takes time, too.
    bar.enable_steady_tick(SEEN.step);
    let template =
        format!("{{msg:24}} {{bar:30}} {{pos}}/{{len}} {unit}, {{rate}}, {{elapsed}}, {{eta}} left");
    match ProgressStyle::with_template(&template) {
        Ok(style) => bar.with_style(style.with_key("rate", rate)),
        Err(_) => bar,
    }
}

/// A figure with its name, or a note why it cannot be drawn: the results stand without it.
pub(crate) fn drawn(name: &str, svg: Result<String, ReportError>) -> Option<(String, String)> {
    let svg = svg.map_err(|error| said::note(format_args!("no figure {name}: {error}"))).ok()?;
    Some((name.to_owned(), svg))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_is_shown_at_first_then_at_each_step_until_the_work_is_done() {
        let pace = Pace { first: Duration::from_millis(1), step: Duration::from_millis(2) };
        let (working, waiting) = std::sync::mpsc::channel::<()>();
        let (mut shown, mut working) = (Vec::new(), Some(working));
        let clock = Instant::now();
        pace.show(&waiting, || {
            shown.push(clock.elapsed());
            if shown.len() == 3 {
                working = None;
            }
        });
        assert!(shown.len() == 3 && shown[2] >= Duration::from_millis(5), "{shown:?}");
    }

    #[test]
    fn a_long_name_is_shortened_where_the_first_sentence_would_have_two_lines() {
        let name = "a camera above the northern ".repeat(4);
        let name = name.trim_end();
        let one = " carries up to 12 kg.";
        for after in [one.to_owned(), format!("{one} It has 4 cables, and a second sentence is free.")] {
            let said = brief(&format!("{name} at (0, 0, 2) m{after}"), name).into_owned();
            let first = broken(&said)[0].clone();
            assert!(first.contains("... at (0, 0, 2) m carries up to 12 kg."), "{said}");
        }
        assert_eq!(brief("a robot of 9 kg.", "a robot"), "a robot of 9 kg.");
        let long = format!("{name}: {}", "word ".repeat(30));
        assert!(brief(&long, name).starts_with("a camera above th...: word"));
        assert_eq!(cut("b1234567.x", 8), "b1234...");
    }

    #[test]
    fn work_that_is_soon_done_shows_nothing() {
        let (working, waiting) = std::sync::mpsc::channel::<()>();
        drop(working);
        SEEN.show(&waiting, || panic!("progress is shown"));
        assert_eq!(patiently("adding", || 1 + 1), 2);
    }
}
