//! Data files are valid, have a source, and match the paper; schemas in the docs are those of the code.

use cdpr_assess::{Severity, inspect};
use cdpr_robot::library::{CABLES, LibraryFile, ROBOTS, named, near};
use cdpr_robot::{CatalogueCable, Pose, Robot};
use cdpr_study::Study;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn files(folder: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(root().join(folder)).unwrap();
    entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
        .collect()
}

/// Names of the JSON files of a folder of data that state a format.
fn stems(folder: &str, format: &str) -> BTreeSet<String> {
    files(folder)
        .into_iter()
        .filter(|path| std::fs::read_to_string(path).unwrap().contains(format))
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect()
}

#[test]
fn the_library_has_every_robot_and_cable_file_by_its_name() {
    let names = |library: &[LibraryFile]| library.iter().map(|file| file.name.to_owned()).collect();
    assert_eq!(stems("data/robots", "cdpr-robot/1"), names(ROBOTS));
    assert_eq!(stems("data/cables", "cdpr-cable/1"), names(CABLES));
}

/// All pages of the repository that are written by hand.
pub(crate) fn pages(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        if path.is_dir() && !name.starts_with('.') && !["target", "vendor", "node_modules"].contains(&name) {
            pages(&path, found);
        } else if path.extension().is_some_and(|e| e == "md") {
            found.push(path);
        }
    }
}

/// Lines of a page that Markdown takes for an item of a list, though they continue a paragraph: a sign, or
/// the number 1, at the beginning of a wrapped line.
fn items_within_paragraphs(text: &str) -> Vec<usize> {
    let is_item = |line: &str| {
        let line = line.trim_start();
        ["- ", "+ ", "* ", "1. ", "1) "].iter().any(|mark| line.starts_with(mark))
    };
    let (mut fenced, mut in_list, mut before, mut wrong) = (false, false, "", Vec::new());
    for (index, line) in text.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
        } else if !fenced {
            if is_item(line) && !in_list && !before.trim().is_empty() && !before.starts_with(['#', '`']) {
                wrong.push(index + 1);
            }
            // A list ends with a line at the margin after an empty one.
            let ends = before.trim().is_empty() && !line.starts_with(' ') && !line.trim().is_empty();
            in_list = is_item(line) || (in_list && !ends);
        }
        before = line;
    }
    wrong
}

#[test]
fn no_line_of_a_paragraph_reads_as_an_item_of_a_list_and_no_place_is_left_to_fill() {
    assert_eq!(
        items_within_paragraphs("V(s) = fz - w (L\n- s), and\n\n- an item\n- and one\n\nText 1\n+ 2"),
        [2, 8]
    );
    let mut all = Vec::new();
    pages(&root(), &mut all);
    assert!(all.len() > 20);
    for page in all {
        let text = std::fs::read_to_string(&page).unwrap();
        assert!(!text.contains("@@"), "{}: a place that was to be filled", page.display());
        // A paper of JOSS begins with fields, which are no paragraph.
        let fields = text.strip_prefix("---\n").and_then(|rest| rest.find("\n---\n"));
        let wrong = items_within_paragraphs(&text[fields.map_or(0, |end| end + 8)..]);
        assert!(wrong.is_empty(), "{}: lines {wrong:?} begin as items", page.display());
    }
}

#[test]
fn every_robot_of_the_library_has_source_and_grade_and_every_cable_its_source() {
    for file in ROBOTS {
        let robot = Robot::from_json(file.text).unwrap_or_else(|error| panic!("{}: {error}", file.name));
        let provenance = &robot.provenance;
        assert!(provenance.source.is_some() && provenance.grade.is_some(), "{}", file.name);
    }
    for file in CABLES {
        let cable = CatalogueCable::from_json(file.text);
        let cable = cable.unwrap_or_else(|error| panic!("{}: {error}", file.name));
        assert!(cable.source.is_some(), "{}", file.name);
    }
}

#[test]
fn a_cable_that_is_assumed_is_the_one_of_the_catalogue() {
    let mut assumed = 0;
    for file in ROBOTS {
        let robot = Robot::from_json(file.text).unwrap();
        for text in &robot.provenance.assumed {
            let Some(rest) = text.split("catalogue cable ").nth(1) else { continue };
            let name = rest.split([' ', ':', ';', ',']).next().unwrap().trim_end_matches('.');
            let cable = named(CABLES, name).unwrap_or_else(|| panic!("{}: no cable {name}", file.name));
            let properties = CatalogueCable::from_json(cable.text).unwrap().properties;
            assert!(robot.cables.iter().all(|cable| cable.properties == properties), "{}", file.name);
            assumed += 1;
        }
    }
    assert!(assumed >= 10, "{assumed}");
}

#[test]
fn a_slip_in_a_name_finds_the_name() {
    assert_eq!(near(ROBOTS, "cogir0")[0], "cogiro");
    assert_eq!(near(ROBOTS, "CoGiRo")[0], "cogiro");
    assert_eq!(near(ROBOTS, "expo2015"), ["expo2015-lucia", "expo2015-roberto"]);
    assert!(near(ROBOTS, "zzz").is_empty());
}

#[test]
fn the_gallery_has_a_section_a_picture_and_a_live_page_of_every_robot() {
    let [page, live] = ["robots", "live"]
        .map(|name| std::fs::read_to_string(root().join(format!("docs/{name}.md"))).unwrap());
    for file in ROBOTS {
        let picture = format!("images/robots/{}.svg", file.name);
        assert!(page.contains(&format!("]({picture})")), "{}: run: cargo xtask gallery", file.name);
        assert!(root().join("docs").join(&picture).exists(), "{picture}: run: cargo xtask gallery");
        let link = format!("href=\"explorer/{}.html\"", file.name);
        assert!(live.contains(&link), "{}: run: cargo xtask gallery", file.name);
    }
}

#[test]
fn the_gallery_counts_the_findings_of_every_robot() {
    let page = std::fs::read_to_string(root().join("docs/robots.md")).unwrap();
    for file in ROBOTS {
        let section = page.split(&format!("| `{}` |", file.name)).nth(1).unwrap();
        let findings = inspect(&Robot::from_json(file.text).unwrap());
        let warnings = findings.iter().filter(|finding| finding.severity == Severity::Warning).count();
        let line = format!("warnings {warnings}, notes {} |", findings.len() - warnings);
        let shown = section.split("| `cdpr robot check` | ").nth(1).unwrap().lines().next().unwrap();
        assert_eq!(shown, line, "{}: run: cargo xtask gallery", file.name);
    }
}

#[test]
fn every_study_file_is_a_study_with_a_source() {
    let files = files("data/studies");
    assert!(!files.is_empty());
    for path in files {
        assert!(Study::open(&path).unwrap().file.source.is_some(), "{}", path.display());
    }
}

#[test]
fn the_schemas_in_the_docs_are_those_of_the_code() {
    for (file, schema) in [
        ("cdpr-robot-1", cdpr_robot::json_schema()),
        ("cdpr-cable-1", cdpr_robot::cable_schema()),
        ("cdpr-study-1", cdpr_study::json_schema()),
        ("cdpr-law-1", cdpr_study::law_schema()),
        ("cdpr-events-1", cdpr_dynamics::simulate::events_schema()),
        ("cdpr-design-1", cdpr_assess::design_schema()),
    ] {
        let path = root().join(format!("docs/schemas/{file}.schema.json"));
        assert_eq!(std::fs::read_to_string(path).unwrap(), schema, "run: cargo xtask schemas");
    }
}

#[test]
fn the_caroca_file_holds_table_1_of_the_paper() {
    let robot =
        Robot::from_json(&std::fs::read_to_string(root().join("data/robots/caroca.json")).unwrap()).unwrap();
    // Every exit point is a corner of the frame at 3.5 m, every anchor point a corner of the platform, each
    // of those once.
    for cable in &robot.cables {
        assert_eq!(cable.exit_point.abs().as_slice(), [3.5, 2.0, 3.5]);
        assert_eq!(cable.anchor_point.abs().as_slice(), [0.2, 0.15, 0.125]);
    }
    // Table 1 has B1 = B3, B2 = B4, B5 = B7, B6 = B8.
    for i in [0, 1, 4, 5] {
        assert_eq!(robot.cables[i].exit_point, robot.cables[i + 2].exit_point);
    }
    assert_eq!((robot.platform.mass, robot.cables[0].properties.linear_density), (180.0, 0.1015));
    assert!(robot.span(&Pose::at(0.0, 0.0, 1.75), 0).norm() > 4.0);
}
