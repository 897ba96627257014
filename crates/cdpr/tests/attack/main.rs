//! The program on bad files and arguments, each with limits of time and memory.
//!
//! Whatever a stranger's file or a careless user asks for, the program ends by itself, soon, without a panic,
//! and touches no file besides those of its own folder of results. It takes minutes, so that a
//! plain `cargo test` leaves it out; `cargo xtask attack` and `.ci/run` run it.

#![cfg(unix)]
#![allow(clippy::print_stdout)]

mod case;
mod cases;
mod folders;
mod options;

use case::{Case, MINE, OUT};
use std::collections::BTreeMap;
use std::error::Error;
use std::ffi::OsString;
use std::fmt;
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant, SystemTime};

/// The program.
const PROGRAM: &str = env!("CARGO_BIN_EXE_cdpr");
/// Most time of a case; each takes less than a second on a machine that does nothing else.
const TIME: Duration = Duration::from_secs(30);
/// Most address space of a case [KiB].
const MEMORY: usize = 1 << 20;
/// What must not happen.
enum Failure {
    Panic(String),
    Hang,
    /// The end by a signal: a crash, or memory beyond the limit.
    Killed(String),
    Touched(PathBuf),
    Succeeded,
    NotFinite(PathBuf),
    NoXml(PathBuf),
    Leaked,
    System(io::Error),
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Panic(text) => write!(f, "panics: {text}"),
            Self::Hang => write!(f, "takes more than {} s", TIME.as_secs()),
            Self::Killed(status) => write!(f, "{status}: a crash, or more than {MEMORY} KiB of memory"),
            Self::Touched(path) => write!(f, "touches {}", path.display()),
            Self::Succeeded => f.write_str("succeeds, though it cannot be right"),
            Self::NotFinite(path) => write!(f, "writes a number that is not finite: {}", path.display()),
            Self::NoXml(path) => write!(f, "writes a figure that is no XML: {}", path.display()),
            Self::Leaked => f.write_str("prints what a terminal would obey, or what no user can read"),
            Self::System(error) => write!(f, "cannot be run: {error}"),
        }
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::System(error)
    }
}

/// Runs the cases of one kind in a folder of their own.
///
/// `prepare` places their files there.
fn attack(
    prepare: impl Fn(&Path) -> io::Result<()>,
    cases: impl FnOnce() -> io::Result<Vec<Case>>,
) -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    cases::prepare(folder.path())?;
    prepare(folder.path())?;
    let before = contents(folder.path())?;
    let (mut count, mut failures) = (0, String::new());
    for case in cases()? {
        count += 1;
        if let Err(failure) = case.run(folder.path(), &before) {
            failures += &format!("{}\n    cdpr {}\n    {failure}\n", case.what, case.arguments.join(" "));
        }
    }
    println!("{count} cases");
    if failures.is_empty() { Ok(()) } else { Err(failures.into()) }
}

#[test]
fn bad_files_and_arguments_end_in_a_message() -> Result<(), Box<dyn Error>> {
    attack(|_| Ok(()), cases::all)
}

#[test]
fn files_of_other_people_are_left_alone() -> Result<(), Box<dyn Error>> {
    attack(folders::prepare, || Ok(folders::all()))
}

#[test]
fn bad_values_of_every_option_end_in_a_message() -> Result<(), Box<dyn Error>> {
    attack(options::prepare, options::all)
}

impl Case {
    fn run(&self, folder: &Path, before: &Contents) -> Result<(), Failure> {
        for (name, bytes) in &self.files {
            fs::write(folder.join(name), bytes)?;
        }
        if let Some(shell) = &self.shell {
            let prepared = Command::new("sh").args(["-ec", shell]).current_dir(folder).status()?;
            if !prepared.success() {
                return Err(Failure::System(io::Error::other(format!("{shell}: {prepared}"))));
            }
        }
        let given = contents(folder)?;
        let is_mine = |name: &PathBuf| fs::read(folder.join(name)).is_ok_and(|found| found == MINE);
        let mine = given.iter().filter(|(_, (length, _))| *length == MINE.len() as u64);
        let mine: Vec<_> = mine.map(|(name, _)| name).filter(|name| is_mine(name)).collect();
        let result = self.end(folder);
        let judged = result.and_then(|()| {
            let after = contents(folder)?;
            let is_out = |name: &&PathBuf| name.starts_with(OUT) && !mine.contains(name);
            let mut names = given.keys().chain(after.keys()).filter(|name| !is_out(name));
            match names.find(|name| given.get(*name) != after.get(*name)) {
                Some(name) => Err(Failure::Touched(name.clone())),
                None => finite(folder),
            }
        });
        for name in contents(folder)?.keys().filter(|name| !before.contains_key(*name)) {
            let _ = fs::remove_file(folder.join(name));
        }
        let _ = fs::remove_dir_all(folder.join(OUT));
        judged
    }

    /// Runs the program to its end, and judges how it ended.
    fn end(&self, folder: &Path) -> Result<(), Failure> {
        let around = if self.around.is_empty() { "exec \"$0\" \"$@\"" } else { self.around };
        let mut child = Command::new("sh")
            .args(["-c", &format!("ulimit -v {MEMORY}; {around}")])
            .arg(PROGRAM)
            .args(self.arguments.iter().map(|argument| raw(argument)))
            .current_dir(folder)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()?;
        let (stdout, stderr) = (child.stdout.take(), child.stderr.take());
        let outputs = [reader(stdout), reader(stderr)];
        let clock = Instant::now();
        let status = loop {
            if let Some(status) = child.try_wait()? {
                break status;
            }
            if clock.elapsed() > TIME {
                child.kill()?;
                child.wait()?;
                return Err(Failure::Hang);
            }
            std::thread::sleep(Duration::from_millis(2));
        };
        let texts = outputs.map(|output| output.join().unwrap_or_default());
        if let Some(panic) = texts[1].lines().find(|line| line.contains("panicked")) {
            return Err(Failure::Panic(panic.to_owned()));
        }
        if status.code().is_none() {
            return Err(Failure::Killed(status.to_string()));
        }
        let obeyed =
            |c: char| c.is_control() && c != '\n' && c != '\t' || ('\u{202a}'..='\u{202e}').contains(&c);
        let unreadable = texts[1].contains("did not match any variant");
        if unreadable || texts.iter().any(|text| text.contains(obeyed)) {
            return Err(Failure::Leaked);
        }
        if status.success() && !self.may_succeed { Err(Failure::Succeeded) } else { Ok(()) }
    }
}

/// An argument with the bytes that are not UTF-8.
fn raw(argument: &str) -> OsString {
    let parts: Vec<_> = argument.split('\u{fffd}').map(str::as_bytes).collect();
    std::os::unix::ffi::OsStringExt::from_vec(parts.join(&b"\xff"[..]))
}

/// Reads an output of a child to its end.
fn reader(output: Option<impl Read + Send + 'static>) -> std::thread::JoinHandle<String> {
    std::thread::spawn(move || {
        let mut bytes = Vec::new();
        // What could be read until an error is judged.
        let _ = output.map(|mut output| output.read_to_end(&mut bytes));
        String::from_utf8_lossy(&bytes).into_owned()
    })
}

/// Length and time of the last change of each file, by its path within a folder.
type Contents = BTreeMap<PathBuf, (u64, Option<SystemTime>)>;

fn contents(folder: &Path) -> io::Result<Contents> {
    let (mut folders, mut files) = (vec![PathBuf::new()], Contents::new());
    while let Some(inner) = folders.pop() {
        for entry in fs::read_dir(folder.join(&inner))? {
            let entry = entry?;
            let (kind, name) = (entry.file_type()?, inner.join(entry.file_name()));
            if kind.is_dir() {
                folders.push(name);
            } else {
                let found = entry.metadata()?;
                files.insert(name, (found.len(), found.modified().ok()));
            }
        }
    }
    Ok(files)
}

/// Whether all numbers in the results are finite, and figures have no character that XML forbids.
fn finite(folder: &Path) -> Result<(), Failure> {
    for name in contents(folder)?.into_keys().filter(|name| name.starts_with(OUT)) {
        let ending = name.extension().and_then(|ending| ending.to_str());
        let path = folder.join(&name);
        if !matches!(ending, Some("csv" | "json" | "svg")) || !path.symlink_metadata()?.is_file() {
            continue;
        }
        let text = String::from_utf8_lossy(&fs::read(path)?).into_owned();
        // Reasons of failures may speak of them.
        let mut cells = text.split([',', '\n', '[', ']', '"', ' ']).map(str::trim);
        if cells.any(|cell| ["NaN", "inf", "-inf"].contains(&cell)) {
            return Err(Failure::NotFinite(name));
        }
        if ending == Some("svg") && text.contains(|c: char| c.is_control() && !"\t\r\n".contains(c)) {
            return Err(Failure::NoXml(name));
        }
    }
    Ok(())
}
