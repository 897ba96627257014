//! Tutorials, guides and commands of the book, and the README: commands print what the pages show, and draw
//! the pictures.
//!
//! A page runs in a folder of its own with the files of the folder of its name. `INSTA_UPDATE=always` writes
//! pages and pictures again, as it does with snapshots.

use crate::common::{is_progress, text};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// Pages with a test each, in the order of the table of contents.
const PAGES: [&str; 24] = [
    "../README",
    "tutorials/cogiro",
    "tutorials/my-robot",
    "tutorials/calibration",
    "tutorials/tolerances",
    "tutorials/caroca",
    "how-to/import",
    "how-to/matlab",
    "how-to/planner",
    "how-to/loads",
    "how-to/broken-cable",
    "how-to/exits",
    "how-to/blank-frame",
    "how-to/cluster",
    "how-to/figure",
    "how-to/table",
    "how-to/observations",
    "how-to/errors",
    "COMMANDS",
    "options",
    "hysteresis",
    "grab",
    "formats",
    "explorer",
];

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs")
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

/// A line whose long numbers have nine decimals: those that follow are rounding, which the processor decides.
fn without_last_digits(line: &str) -> String {
    let of_number = |c: char| c.is_ascii_digit() || ".e-".contains(c);
    let (mut found, mut rest) = (String::new(), line);
    while let Some(begin) = rest.find(of_number) {
        let length = rest[begin..].find(|c| !of_number(c)).unwrap_or(rest.len() - begin);
        let (text, number) = (&rest[..begin], &rest[begin..begin + length]);
        found += text;
        match number.parse::<f64>() {
            // A sum with zero has no sign where it is zero.
            Ok(value) if number.len() > 12 => {
                found += &format!("{:.9}", (1e9 * value).round() / 1e9 + 0.0);
            }
            _ => found += number,
        }
        rest = &rest[begin + length..];
    }
    found + rest
}

/// The page with the answers of now.
fn answered(page: &str, folder: &Path) -> String {
    let (mut answered, mut within) = (String::new(), false);
    for line in page.lines() {
        if line.starts_with("```") {
            within = line == "```console";
        } else if within {
            if let Some(command) = line.strip_prefix("$ ") {
                writeln!(answered, "{}", format!("$ {command}\n{}", printed(folder, command)).trim_end())
                    .unwrap();
            }
            continue;
        }
        writeln!(answered, "{line}").unwrap();
    }
    answered
}

/// The pictures of a page that its commands draw: links into the folder of its name.
fn pictures<'a>(page: &'a str, folder: &str) -> Vec<&'a str> {
    let inside = format!("]({folder}/");
    let links = page.split(inside.as_str()).skip(1).filter_map(|rest| rest.split(')').next());
    links.filter(|link| link.ends_with(".svg")).collect()
}

/// Asserts that the commands of a page print what it shows and draw its pictures, and returns the page.
fn checked(name: &str, prepare: impl FnOnce(&Path)) -> String {
    let folder = TempDir::new().unwrap();
    let own = docs().join(name);
    if let Ok(files) = std::fs::read_dir(&own) {
        for file in files.map(|file| file.unwrap().path()) {
            if file.is_file() && file.extension().is_none_or(|ending| ending != "svg") {
                std::fs::copy(&file, folder.path().join(file.file_name().unwrap())).unwrap();
            }
        }
    }
    prepare(folder.path());
    let path = docs().join(format!("{name}.md"));
    let page = std::fs::read_to_string(&path).unwrap();
    let now = answered(&page, folder.path());
    let update = std::env::var("INSTA_UPDATE").is_ok_and(|update| update == "always");
    if update {
        std::fs::write(path, &now).unwrap();
    } else {
        for (number, (shown, now)) in page.lines().zip(now.lines()).enumerate() {
            let [shown, now] = [shown, now].map(without_last_digits);
            assert_eq!(shown, now, "docs/{name}.md, line {}; INSTA_UPDATE=always writes it", number + 1);
        }
        assert_eq!(page.lines().count(), now.lines().count(), "docs/{name}.md");
    }
    for picture in pictures(&now, name.rsplit('/').next().unwrap()) {
        let (drawn, shown) = (std::fs::read_to_string(folder.path().join(picture)), own.join(picture));
        let drawn = drawn.unwrap_or_else(|error| panic!("docs/{name}.md: {picture} is not drawn: {error}"));
        if update {
            std::fs::create_dir_all(shown.parent().unwrap()).unwrap();
            std::fs::write(&shown, &drawn).unwrap();
        }
        let shown = std::fs::read_to_string(&shown).unwrap_or_default();
        assert!(shown == drawn, "docs/{name}/{picture} is out of date; INSTA_UPDATE=always writes it");
    }
    now
}

/// A checkout's folder `data`, as the pages name its files.
fn link_data(folder: &Path) {
    let data = docs().join("../data").canonicalize().unwrap();
    std::os::unix::fs::symlink(data, folder.join("data")).unwrap();
}

#[test]
fn the_readme_shows_what_its_command_prints() {
    checked("../README", |_| {});
}

#[test]
fn each_command_of_the_reference_answers_as_it_is_shown() {
    checked("COMMANDS", link_data);
}

#[test]
fn the_cable_of_caroca_is_measured_and_put_into_its_model() {
    checked("hysteresis", link_data);
}

#[test]
fn pages_with_single_commands_show_what_these_print() {
    for name in ["grab", "formats", "explorer"] {
        checked(name, link_data);
    }
}

#[test]
fn the_options_of_the_reference_are_those_of_the_program() {
    checked("options", |_| {});
}

#[test]
fn a_first_visitor_sees_cogiro_deflect() {
    let page = checked("tutorials/cogiro", |_| {});
    assert!(page.contains("CoGiRo at (0, 0, 2) m is displaced by 3.11215 mm"));
}

#[test]
fn a_student_comes_from_a_drawing_to_a_study() {
    let page = checked("tutorials/my-robot", |_| {});
    assert!(page.contains("remedy: coordinates in m, not in mm"));
}

#[test]
fn a_student_calibrates_the_robot_from_a_table() {
    let page = checked("tutorials/calibration", |_| {});
    assert!(page.contains("Lab robot: at these poses a coordinate is known to 0.1"));
}

#[test]
fn a_designer_finds_the_tolerance_to_tighten() {
    checked("tutorials/tolerances", |_| {});
}

#[test]
fn the_study_of_the_paper_runs_with_its_figures() {
    checked("tutorials/caroca", link_data);
}

#[test]
fn robots_of_other_programs_become_robot_files() {
    checked("how-to/import", link_data);
}

#[test]
fn poses_become_lengths_for_matlab() {
    checked("how-to/matlab", |_| {});
}

#[test]
fn an_engineer_of_a_stadium_flies_a_camera_along_a_planned_flight() {
    let page = checked("how-to/planner", |_| {});
    assert!(page.contains("5000 of 5000 poses held"));
}

#[test]
fn loads_are_wind_payloads_and_sets_of_wrenches() {
    checked("how-to/loads", |_| {});
}

#[test]
fn a_camera_hangs_on_three_cables_when_the_fourth_parts() {
    let page = checked("how-to/broken-cable", |_| {});
    assert!(
        page.contains("Stadium camera, cable 3 br... holds 134 of 315 positions (42.5 %), payload 0 kg.")
    );
}

#[test]
fn exits_go_where_the_load_deflects_least() {
    let page = checked("how-to/exits", |_| {});
    assert!(
        page.contains("best of 175\nconfigurations, all of them evaluated")
            && page.contains("a local optimum")
    );
}

#[test]
fn an_engineer_comes_from_a_blank_frame_to_a_robot_that_keeps_a_millimetre() {
    let page = checked("how-to/blank-frame", |_| {});
    assert!(page.contains("The tolerances suffice: nothing has to be tightened for 95 % of the robots."));
}

#[test]
fn shards_make_a_study_together() {
    checked("how-to/cluster", |_| {});
}

#[test]
fn figures_for_a_paper_are_drawn() {
    checked("how-to/figure", |_| {});
}

#[test]
fn a_statistician_learns_that_three_of_twelve_inputs_matter() {
    let page = checked("how-to/table", |_| {});
    assert!(page.contains("\ny: 3 of 12 inputs are certain to matter: x2 ("));
}

#[test]
fn observations_are_added_until_the_verdict_is_settled() {
    checked("how-to/observations", |_| {});
}

#[test]
fn failures_are_shown_with_their_remedies() {
    checked("how-to/errors", |_| {});
}

#[test]
fn every_tutorial_and_guide_shows_what_its_commands_print() {
    for kind in ["tutorials", "how-to"] {
        for file in std::fs::read_dir(docs().join(kind)).unwrap().map(|file| file.unwrap().path()) {
            if file.extension().is_some_and(|ending| ending == "md") {
                let name = format!("{kind}/{}", file.file_stem().unwrap().to_str().unwrap());
                assert!(PAGES.contains(&name.as_str()), "docs/{name}.md has no test");
                let page = std::fs::read_to_string(&file).unwrap();
                assert!(page.contains("```console\n"), "docs/{name}.md shows no command");
                assert!(!page.contains("```sh\n"), "docs/{name}.md: ```console blocks show their outputs");
            }
        }
    }
}
