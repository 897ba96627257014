//! The one place where inputs are opened: regular files, pipes and the standard input, `-`, of a size that
//! their kind can have. A pipe that nobody writes into is not waited for, and a device could feed a reader
//! for ever.

use crate::error::StudyError;
use crate::kind::InputKind;
use crate::table::{Table, TableError};
use cdpr_robot::library::ROBOTS;
use cdpr_robot::{JsonError, from_json};
use serde::de::{DeserializeOwned, IgnoredAny};
use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::Path;
use std::sync::OnceLock;
use std::time::Duration;

/// The text of a file, without the byte order mark that some editors put before it.
///
/// # Errors
/// [`StudyError::Read`]; [`StudyError::NotRegular`] for a folder, a device or a pipe without content;
/// [`StudyError::TooLarge`].
pub fn read_text(path: &Path, kind: InputKind) -> Result<String, StudyError> {
    let text = text_of(path, read_bytes(path, kind)?)?;
    // Parts of a folder of results and files of other programs have messages of their own.
    if text.trim().is_empty() && !matches!(kind, InputKind::Results | InputKind::Foreign) {
        let source = io::Error::new(ErrorKind::InvalidData, "the file is empty");
        return Err(StudyError::Read { path: path.to_owned(), source });
    }
    Ok(text)
}

/// The table of a file: CSV and its relatives.
///
/// # Errors
/// As [`read_text`] and [`check_table`]; [`StudyError::Table`] as [`Table::read`].
pub fn read_table(path: &Path, kind: InputKind) -> Result<Table, StudyError> {
    let bytes = read_bytes(path, kind)?;
    check_table(path, &bytes, kind)?;
    Table::read(&bytes).map_err(|source| StudyError::Table { path: path.to_owned(), source })
}

/// Refuses bytes that are no table but JSON, XML or HTML: read as lines of cells they make no sense.
/// Measurements may be JSON.
///
/// # Errors
/// [`StudyError::OtherKind`]; [`StudyError::Table`] for JSON that states no format of this program.
pub fn check_table(path: &Path, bytes: &[u8], kind: InputKind) -> Result<(), StudyError> {
    let Ok(text) = std::str::from_utf8(bytes) else { return Ok(()) };
    let text = text.trim_start_matches('\u{feff}').trim_start();
    let is_json =
        text.starts_with('{') || text.starts_with('[') && serde_json::from_str::<IgnoredAny>(text).is_ok();
    match other_kind(path, text, kind) {
        Some(other) if is_json || text.starts_with('<') => Err(other),
        _ if is_json && kind != InputKind::Measurements => {
            Err(StudyError::Table { path: path.to_owned(), source: TableError::NoText { found: "JSON" } })
        }
        _ => Ok(()),
    }
}

/// Whether every other byte of the beginning is zero, as that of letters in UTF-16.
fn is_wide(bytes: &[u8]) -> bool {
    let pairs = bytes.chunks_exact(2).take(8);
    let all = |place: usize| pairs.clone().all(|pair| pair[place] == 0 && pair[1 - place] != 0);
    bytes.len() > 1 && (all(0) || all(1))
}

/// The text that the bytes of a file are, as [`read_text`] has it.
pub(crate) fn text_of(path: &Path, bytes: Vec<u8>) -> Result<String, StudyError> {
    let unreadable = |reason: &str| StudyError::Read {
        path: path.to_owned(),
        source: io::Error::new(ErrorKind::InvalidData, reason),
    };
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) || is_wide(&bytes) {
        return Err(unreadable("its encoding is UTF-16 instead of UTF-8; save it as UTF-8"));
    }
    let text = String::from_utf8(bytes).map_err(|_| unreadable("it is not UTF-8"))?;
    Ok(text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text))
}

/// The bytes of a file.
///
/// # Errors
/// As [`read_text`].
pub fn read_bytes(path: &Path, kind: InputKind) -> Result<Vec<u8>, StudyError> {
    let unread = |source| StudyError::Read { path: path.to_owned(), source };
    let too_large = || StudyError::TooLarge { path: path.to_owned(), kind, most: kind.most_bytes() };
    let fits =
        |bytes: Vec<u8>| if bytes.len() as u64 > kind.most_bytes() { Err(too_large()) } else { Ok(bytes) };
    if is_standard_input(path) {
        return fits(standard_input().map_err(unread)?.to_vec());
    }
    if let Some(pipe) = open_pipe(path).map_err(unread)? {
        return match read_pipe(pipe, kind.most_bytes() + 1).map_err(unread)? {
            bytes if bytes.is_empty() => {
                Err(StudyError::NotRegular { path: path.to_owned(), found: "a pipe without content", kind })
            }
            bytes => fits(bytes),
        };
    }
    let file = open(path, kind)?;
    if file.metadata().map_err(unread)?.len() > kind.most_bytes() {
        return Err(too_large());
    }
    let mut bytes = Vec::new();
    // A file may grow while it is read, and those of the system do not tell their size.
    file.take(kind.most_bytes() + 1).read_to_end(&mut bytes).map_err(unread)?;
    fits(bytes)
}

/// Whether a path stands for the standard input, `-`.
pub fn is_standard_input(path: &Path) -> bool {
    path == Path::new("-")
}

/// All of the standard input, which is read once.
fn standard_input() -> io::Result<&'static [u8]> {
    static INPUT: OnceLock<Vec<u8>> = OnceLock::new();
    if let Some(bytes) = INPUT.get() {
        return Ok(bytes);
    }
    let mut bytes = Vec::new();
    io::stdin().lock().take(InputKind::MOST_BYTES + 1).read_to_end(&mut bytes)?;
    Ok(INPUT.get_or_init(|| bytes))
}

/// A pipe, opened without waiting for a writer; `None` for anything else.
fn open_pipe(path: &Path) -> io::Result<Option<File>> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::{FileTypeExt, OpenOptionsExt};
        if std::fs::metadata(path).is_ok_and(|found| found.file_type().is_fifo()) {
            return File::options().read(true).custom_flags(libc::O_NONBLOCK).open(path).map(Some);
        }
    }
    let _ = path;
    Ok(None)
}

/// What is written into a pipe, up to a number of bytes; nothing where there is no writer.
fn read_pipe(mut pipe: File, most: u64) -> io::Result<Vec<u8>> {
    let (mut bytes, mut part) = (Vec::new(), [0; 65_536]);
    while (bytes.len() as u64) < most {
        match pipe.read(&mut part) {
            Ok(0) => break,
            Ok(count) => bytes.extend_from_slice(&part[..count]),
            Err(error) if error.kind() == ErrorKind::WouldBlock => {
                std::thread::sleep(Duration::from_millis(1));
            }
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(bytes)
}

/// The content of a file of JSON, from its text; `path` names it in errors.
///
/// # Errors
/// [`StudyError::OtherKind`], [`StudyError::Format`].
pub fn from_text<T: DeserializeOwned>(text: &str, path: &Path, kind: InputKind) -> Result<T, StudyError> {
    from_json(text).map_err(|source| {
        let source = about_poses(source, text);
        let other = other_kind(path, text, kind);
        other.unwrap_or_else(|| StudyError::Format { path: path.to_owned(), source })
    })
}

/// Says of poses that are a bare list how they are written.
fn about_poses(error: JsonError, text: &str) -> JsonError {
    let row = text.lines().nth(error.line.saturating_sub(1)).unwrap_or_default();
    let at = row.get(error.column.saturating_sub(1)..).unwrap_or_default();
    match error.field == "poses" || error.field.ends_with(".poses") {
        true if at.starts_with('[') => JsonError {
            message: "a list: expected {\"list\": [{\"position\": [x, y, z]}, ..]} or {\"grid\": {..}}"
                .to_owned(),
            ..error
        },
        _ => error,
    }
}

/// The error of a text that was not read as one kind because it is of another.
pub fn other_kind(path: &Path, text: &str, kind: InputKind) -> Option<StudyError> {
    let found = InputKind::of_text(text)?;
    // Measurements and points to import may be tables, too.
    let is_other = found != kind && !(found == InputKind::Table && kind.may_be_table());
    is_other.then(|| StudyError::OtherKind { path: path.to_owned(), found, kind })
}

/// The first bytes of a file, so many at most.
///
/// # Errors
/// [`StudyError::Read`], [`StudyError::NotRegular`].
pub(crate) fn read_start(path: &Path, kind: InputKind, most: u64) -> Result<Vec<u8>, StudyError> {
    let mut start = Vec::new();
    let read = open(path, kind)?.take(most).read_to_end(&mut start);
    read.map(|_| start).map_err(|source| StudyError::Read { path: path.to_owned(), source })
}

/// Opens a regular file. A pipe without a writer is opened at first, too, instead of being waited for.
///
/// # Errors
/// [`StudyError::Read`], [`StudyError::NotRegular`].
pub(crate) fn open(path: &Path, kind: InputKind) -> Result<File, StudyError> {
    let unread = |source| StudyError::Read { path: path.to_owned(), source };
    let mut options = File::options();
    options.read(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::custom_flags(&mut options, libc::O_NONBLOCK | libc::O_NOCTTY);
    let file = options.open(path).map_err(|source| match kind {
        // The name of a robot where a study of it is expected.
        InputKind::Study if ROBOTS.iter().any(|robot| Path::new(robot.name) == path) => {
            StudyError::OtherKind { path: path.to_owned(), found: InputKind::Robot, kind }
        }
        _ => unread(source),
    })?;
    let found = file.metadata().map_err(unread)?.file_type();
    if !found.is_file() {
        let found = described(found);
        return Err(StudyError::NotRegular { path: path.to_owned(), found, kind });
    }
    Ok(file)
}

#[cfg(unix)]
fn described(found: std::fs::FileType) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    match found {
        found if found.is_dir() => "a folder",
        found if found.is_fifo() => "a pipe",
        found if found.is_socket() => "a socket",
        _ => "a device",
    }
}

#[cfg(not(unix))]
fn described(found: std::fs::FileType) -> &'static str {
    if found.is_dir() { "a folder" } else { "a device" }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(bytes: &[u8]) -> tempfile::NamedTempFile {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), bytes).unwrap();
        file
    }

    #[test]
    fn a_byte_order_mark_is_no_part_of_the_text() {
        let file = written(b"\xef\xbb\xbf{}");
        assert_eq!(read_text(file.path(), InputKind::Robot).unwrap(), "{}");
        let error = read_text(written(b"\xff\xfe{\0}\0").path(), InputKind::Robot).unwrap_err();
        assert!(error.to_string().contains("UTF-16 instead of UTF-8"), "{error}");
        // Without a mark, letters have every other byte zero.
        for wide in [u16::to_le_bytes, u16::to_be_bytes] {
            let bytes: Vec<u8> = "{\"format\": 1}".encode_utf16().flat_map(wide).collect();
            let error = read_text(written(&bytes).path(), InputKind::Robot).unwrap_err();
            assert!(error.to_string().contains("UTF-16 instead of UTF-8; save it as UTF-8"), "{error}");
        }
    }

    #[test]
    fn a_file_larger_than_its_kind_can_be_is_not_read() {
        let file = written(b"");
        file.as_file().set_len(InputKind::Robot.most_bytes()).unwrap();
        assert!(read_bytes(file.path(), InputKind::Robot).is_ok());
        file.as_file().set_len(InputKind::Robot.most_bytes() + 1).unwrap();
        let error = read_bytes(file.path(), InputKind::Robot).unwrap_err();
        assert!(error.to_string().ends_with("is larger than 4 MB: expected a robot file"), "{error}");
        assert!(read_bytes(file.path(), InputKind::Study).is_ok());
    }

    #[cfg(unix)]
    #[test]
    fn empty_pipes_devices_and_folders_are_refused_at_once() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        for (path, found) in [
            (pipe.as_path(), "a pipe without content"),
            (folder.path(), "a folder"),
            (Path::new("/dev/zero"), "a device"),
        ] {
            let error = read_text(path, InputKind::Study).unwrap_err().to_string();
            assert!(error.ends_with(&format!("is {found}: expected a study file")), "{error}");
        }
        let mut writer = std::process::Command::new("sh");
        let write = format!("(sleep 0.05; echo begun; sleep 0.05; echo done) > {}", pipe.display());
        let mut writer = writer.args(["-c", &write]).spawn().unwrap();
        // A pipe is not waited for before it has a writer.
        let begun = std::time::Instant::now();
        let text = loop {
            match read_text(&pipe, InputKind::Study) {
                Ok(text) => break text,
                Err(error) if begun.elapsed() > Duration::from_secs(20) => panic!("{error}"),
                Err(_) => std::thread::sleep(Duration::from_millis(1)),
            }
        };
        assert_eq!(text, "begun\ndone\n");
        assert!(writer.wait().unwrap().success());
    }
}
