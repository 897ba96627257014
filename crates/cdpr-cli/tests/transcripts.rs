//! Whole tasks as users carry them out: the commands of `docs/examples` print what the pages show.
//!
//! `INSTA_UPDATE=always` writes the pages again, as it does with snapshots.

use crate::common::{is_progress, text};
use crate::verdict::ishigami_among_twelve;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/examples")
}

/// The flight of a camera as a planner saves it, 100 s at 50 Hz.
fn write_flight(folder: &Path) {
    let mut table = "t_s;x_m;y_m;z_m\n".to_owned();
    for k in 0..5000 {
        let angle = std::f64::consts::TAU * f64::from(k) / 5000.0;
        let [x, y, z] = [35.0 * angle.sin(), 20.0 * (2.0 * angle).sin(), 10.0 + 4.0 * (3.0 * angle).cos()];
        writeln!(table, "{:.2};{x:.4};{y:.4};{z:.4}", f64::from(k) / 50.0).unwrap();
    }
    std::fs::write(folder.join("flight.csv"), table.replace('.', ",")).unwrap();
}

/// What a command of a page prints, both outputs in their order, and its exit code unless that is 0.
fn printed(folder: &Path, command: &str) -> String {
    let program = Path::new(env!("CARGO_BIN_EXE_cdpr")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let mut shell = Command::new("sh");
    let shell = shell.args(["-c", &format!("{{ {command}\n}} 2>&1")]).env("PATH", path);
    let output = shell.current_dir(folder).output().unwrap();
    let printed = text(output.stdout);
    let mut printed: String = printed.lines().filter(|line| !is_progress(line)).map(without_times).collect();
    let code = output.status.code().unwrap();
    assert!(matches!(code, 0 | 1 | 3), "{command}: {printed}");
    if code != 0 {
        writeln!(printed, "[exit code {code}]").unwrap();
    }
    printed
}

/// A line without wall times and rounding, and its end.
fn without_times(line: &str) -> String {
    let words: Vec<&str> = line.split(' ').collect();
    let is_time = |at: usize| {
        at > 0
            && words[at - 1] == "in"
            && words.get(at + 1).is_some_and(|word| word.trim_end_matches(';') == "s")
    };
    let word = |(at, word): (usize, &&str)| match word.split_once("e-") {
        _ if is_time(at) => "...".to_owned(),
        Some((_, exponent)) if exponent.parse::<u32>().is_ok_and(|e| e > 9) => "1e-9".to_owned(),
        _ => (*word).to_owned(),
    };
    let words: Vec<String> = words.iter().enumerate().map(word).collect();
    words
        .join(" ")
        .replace("residuals: closure 0.0e0", "residuals: closure 1e-9")
        .replace("moment 0.0e0", "moment 1e-9")
        + "\n"
}

/// The page with the answers of now.
fn answered(page: &str, folder: &Path) -> String {
    let (mut answered, mut within) = (String::new(), false);
    for line in page.lines() {
        if line.starts_with("```") {
            within = line == "```console";
        } else if within {
            if let Some(command) = line.strip_prefix("$ ") {
                writeln!(answered, "$ {command}\n{}", printed(folder, command).trim_end()).unwrap();
            }
            continue;
        }
        writeln!(answered, "{line}").unwrap();
    }
    answered
}

/// Asserts that the commands of a page print what it shows, and returns the page.
fn checked(name: &str, prepare: impl FnOnce(&Path)) -> String {
    let folder = TempDir::new().unwrap();
    if let Ok(files) = std::fs::read_dir(examples().join(name)) {
        for file in files.map(Result::unwrap) {
            std::fs::copy(file.path(), folder.path().join(file.file_name())).unwrap();
        }
    }
    prepare(folder.path());
    let path = examples().join(format!("{name}.md"));
    let page = std::fs::read_to_string(&path).unwrap();
    let now = answered(&page, folder.path());
    if std::env::var("INSTA_UPDATE").is_ok_and(|update| update == "always") {
        std::fs::write(path, &now).unwrap();
        return now;
    }
    for (number, (shown, now)) in page.lines().zip(now.lines()).enumerate() {
        assert_eq!(shown, now, "docs/examples/{name}.md, line {}; INSTA_UPDATE=always writes it", number + 1);
    }
    assert_eq!(page.lines().count(), now.lines().count(), "docs/examples/{name}.md");
    now
}

#[test]
fn a_student_comes_from_a_drawing_to_a_calibrated_robot() {
    let page = checked("student", |_| {});
    assert!(page.contains("remedy: coordinates in m, not in mm"));
    assert!(page.contains("Lab robot: the position is known to 0.1"));
}

#[test]
fn an_engineer_of_a_stadium_flies_a_camera_in_the_wind_and_on_three_cables() {
    let page = checked("stadium", write_flight);
    assert!(page.contains("5000 of 5000 poses held"));
    assert!(page.contains("Stadium camera, cable 3 broken holds 134 of 315 positions"));
}

#[test]
fn a_statistician_learns_that_three_of_twelve_inputs_matter() {
    let page = checked("statistician", ishigami_among_twelve);
    assert!(page.contains("\ny: 3 of 12 inputs are certain to matter: x2 ("));
}
