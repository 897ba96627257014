//! Every option, file and table is covered by the rules of inputs and outputs.

use crate::common::{cdpr, data_path, text};
use std::path::Path;

/// Options of the help with a unit in their description, by command.
fn options_with_units(command: &[&str]) -> Vec<String> {
    let help = text(cdpr(&[command, &["--help"]].concat()).stdout);
    let mut found = Vec::new();
    let mut option = None;
    for line in help.lines().map(str::trim) {
        if line.starts_with("--") || (line.starts_with('-') && line.contains(", --")) {
            option = line.split([' ', '=', ',']).find(|word| word.starts_with("--")).map(str::to_owned);
        }
        let units = ["[m]", "[kg]", "[N]", "[N m]", "[N, N m]", "[Pa]", "[N/m]", "[m\u{b2}]", "SI units"];
        if units.iter().any(|unit| line.contains(unit)) {
            found.extend(option.take());
        }
    }
    found
}

#[test]
fn every_option_with_a_unit_is_known_to_the_questions() {
    // What asks about the number of each option. A new option with a unit must ask, too: then it stands here.
    let known = [
        ("position", vec!["--pose", "--region", "--work"]),
        ("load, wrench", vec!["--payload", "--force", "--moment", "--wrench"]),
        ("lengths", vec!["--lengths"]),
        ("reference", vec!["--tension-reference"]),
        ("deviation", vec!["--uncertainty"]),
        ("noise, on_platform", vec!["--noise", "--limit", "--marker"]),
        ("robot, mass, modulus", vec!["--mass", "--center-of-mass", "--tension-limits"]),
        ("span, linear_density", vec!["--length", "--end"]),
        ("modulus of the record", vec!["--section", "--breaking-force"]),
        // Errors of a measurement widen an interval and enter nothing else; a tension ends a catenary.
        ("none", vec!["--tension", "--end-force", "--errors"]),
    ];
    let commands: [&[&str]; 22] = [
        &["cable", "catenary"],
        &["inverse"],
        &["direct"],
        &["deflection"],
        &["stiffness"],
        &["capacity"],
        &["path"],
        &["workspace"],
        &["study", "new"],
        &["study", "run"],
        &["calibrate", "fit"],
        &["calibrate", "identify"],
        &["calibrate", "plan"],
        &["calibrate", "pulleys"],
        &["calibrate", "simulate"],
        &["derivatives"],
        &["hysteresis"],
        &["cable", "density"],
        &["modes"],
        &["cable", "modulus"],
        &["robot", "export"],
        &["robot", "import"],
    ];
    for command in commands {
        for option in options_with_units(command) {
            assert!(
                known.iter().any(|(_, options)| options.contains(&option.as_str())),
                "{command:?} {option}"
            );
        }
    }
}

#[test]
fn robots_and_studies_are_opened_where_questions_are_asked() {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut folders = vec![sources];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let content = std::fs::read_to_string(&path).unwrap();
            let opens = [
                "Study::open(",
                "cdpr_study::open_robot(",
                "cdpr_study::take_results(",
                "cdpr_study::open_errors(",
            ];
            let imports = content.lines().any(|line| {
                let words = |name: &str| {
                    line.split(|c: char| !(c.is_alphanumeric() || c == '_')).any(|word| word == name)
                };
                line.starts_with("use cdpr_study")
                    && ["open_robot", "take_results", "open_errors"].iter().any(|n| words(n))
            });
            let is_home = path.file_name().unwrap() == "questions.rs";
            assert!(
                is_home || !imports && !opens.iter().any(|open| content.contains(open)),
                "{}",
                path.display()
            );
        }
    }
}

#[test]
fn tables_hold_no_number_that_is_not_finite() {
    let folder = tempfile::TempDir::new().unwrap();
    let out = folder.path().join("map");
    let arguments = "workspace caroca --region ::3,::3,1.75 --payload 50 --uncertainty a=1e300 --out";
    let arguments: Vec<_> = arguments.split(' ').chain([out.to_str().unwrap()]).collect();
    assert_eq!(cdpr(&arguments).status.code(), Some(3));
    let table = std::fs::read_to_string(out.join("workspace.csv")).unwrap();
    assert!(table.contains("std_mm is left out"), "{table}");
    let poses = data_path("poses/caroca.csv");
    let path = ["path", "caroca", "--poses", &poses, "--payload", "50", "--uncertainty", "a=1e300"];
    let path = text(cdpr(&path).stdout);
    assert!(path.contains("too large for the computer"), "{path}");
    for table in [table, path] {
        assert!(!table.split([',', '\n']).any(|cell| ["NaN", "inf", "-inf"].contains(&cell)), "{table}");
    }
}
