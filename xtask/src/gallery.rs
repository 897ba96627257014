//! `cargo xtask gallery`: docs/robots.md, a picture and a table for each robot of the library, and
//! docs/live.md, where they move.
//!
//! The picture is that of the study that `cdpr study new` writes, at its pose and under its load.

mod film;

use crate::cargo::{
    Outcome, answer, cdpr_command, made, number, read, read_json, root, text, text_of, write,
};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::Path;

/// What is behind the warnings of `cdpr robot check`.
const REMARKS: [(&str, &str); 1] = [(
    "copacabana-handling",
    "its upper exit points lead to the lower anchor points, so that cables pass each other closely",
)];

/// The page of the library, before its robots.
const HEAD: &str = "# Robots that are known

The library has these robots; every command takes their names, `cdpr robot check cogiro`. Each table has the pose at
the middle of the workspace that `cdpr study new` finds, the tensions that hold it, and how far the template's
payload, a tenth of the platform's mass, moves the platform. `cargo xtask gallery` makes this page and its
pictures.

";

/// The page on which robots move, before their names.
const LIVE: &str = "# Robots to move

Choose a robot; it computes in the frame below, in this browser and without a connection. [The
explorer](explorer.md) says what one can do with it, and `cdpr explore NAME` writes its page as a file. The
pages are part of the book that `cargo xtask dist` makes.

";

/// What comes after them.
const FRAME: &str = "
<iframe name=\"robot\" src=\"explorer/caroca.html\" title=\"The robot that was chosen\" loading=\"lazy\"
 style=\"width: 100%; height: 85vh; border: 1px solid\"></iframe>
";

/// Writes the pages and their pictures.
pub(crate) fn run() -> Outcome {
    let folder = root().join("target/gallery");
    made(&folder)?;
    film::run()?;
    let mut page = String::from(HEAD);
    let mut live = String::from(LIVE);
    let robots = answer(&["robot", "list"], &[0])?;
    let is_robot = |entry: &&Value| entry["kind"] == "robot";
    for robot in robots.as_array().ok_or("no list of robots")?.iter().filter(is_robot) {
        let name = text(&robot["name"]);
        eprintln!("{name}");
        section(&mut page, robot, &studied(name, &folder)?)?;
        let words = format!("{}</a> ({} cables)", text(&robot["title"]), robot["cables"]);
        writeln!(live, "<a href=\"explorer/{name}.html\" target=\"robot\">{words}")?;
    }
    write(&root().join("docs/live.md"), &(live + FRAME))?;
    write(&root().join("docs/robots.md"), &page)
}

/// The section of one robot.
fn section(page: &mut String, robot: &Value, rows: &[(&str, String)]) -> Outcome {
    let name = text(&robot["name"]);
    let findings = answer(&["robot", "check", name], &[0, 3])?;
    let provenance = answer(&["robot", "show", name], &[0])?;
    let findings = findings.as_array().ok_or("no list of findings")?;
    let warnings: Vec<_> = findings.iter().filter(|finding| finding["severity"] == "warning").collect();
    let extent = robot["exit_extent_m"].as_array().ok_or("no extent")?;
    let extent: Vec<_> = extent.iter().map(|side| format!("{:.1}", number(side))).collect();
    write!(
        page,
        "## {}\n\n![{}](images/robots/{name}.svg)\n\n| `{name}` | {} |\n|---|---|\n| cables | {} |\n\
         | platform | {} kg |\n| exit points | {} m |\n",
        text(&robot["title"]),
        text(&robot["title"]),
        text(&robot["grade"]),
        robot["cables"],
        robot["mass_kg"],
        extent.join(" x "),
    )?;
    for (what, value) in rows {
        writeln!(page, "| {what} | {value} |")?;
    }
    let notes = findings.len() - warnings.len();
    writeln!(page, "| `cdpr robot check` | warnings {}, notes {notes} |\n", warnings.len())?;
    for warning in &warnings {
        let behind = REMARKS.iter().find(|(robot, _)| *robot == name).map_or("not explained", |(_, why)| why);
        let said =
            format!("`check` warns of {}, {}: {behind}.", text(&warning["field"]), text(&warning["why"]));
        writeln!(page, "{}\n", wrapped(&said, ""))?;
    }
    writeln!(page, "{}\n", wrapped(&format!("Source: {}", text(&provenance["source"])), ""))?;
    let assumed = provenance["assumed"].as_array().ok_or("no list of assumptions")?;
    if !assumed.is_empty() {
        let lines: Vec<_> = assumed.iter().map(|one| wrapped(&format!("- {}", text(one)), "  ")).collect();
        writeln!(page, "Assumed:\n\n{}\n", lines.join("\n"))?;
    }
    Ok(())
}

/// Runs a small study of the template, keeps its picture, and reads its pose, tensions and deflection.
fn studied(name: &str, folder: &Path) -> Outcome<[(&'static str, String); 3]> {
    let mut study: Value = serde_json::from_str(&text_of(&mut cdpr_command(&["study", "new", name]), &[0])?)?;
    study.as_object_mut().map(|study| study.remove("sensitivity"));
    study["replicates"] = json!(0);
    study["samplings"]["all"]["observations"] = json!(32);
    for axis in ["x", "y"] {
        study["surfaces"]["modulus_mass"][axis]["points"] = json!(3);
    }
    let (file, results) = (folder.join(format!("{name}.json")), folder.join(name));
    write(&file, &study.to_string())?;
    let mut run = cdpr_command(&["study", "run", "--overwrite", "--out"]);
    text_of(run.arg(&results).arg(&file), &[0])?;
    let pictures = root().join("docs/images/robots");
    write(&pictures.join(format!("{name}.svg")), &read(&results.join("robot.svg"))?)?;
    let summary = read_json(&results.join("summary.json"))?;
    let all = &summary["studies"]["all"];
    let pose: Vec<_> = all["pose"].as_array().into_iter().flatten().map(ToString::to_string).collect();
    let rest = if study["samplings"]["all"]["free"].is_null() {
        ""
    } else {
        ", where it comes to rest with its own tilt"
    };
    let tensions = all["nominal"]["unloaded_tensions"].as_array().into_iter().flatten();
    let tensions: Vec<f64> = tensions.map(number).collect();
    let least = tensions.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = tensions.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let deflection = number(&all["magnitude_mm"]["nominal"]);
    Ok([
        ("pose", format!("({}) m{rest}", pose.join(", "))),
        ("tensions", format!("{least:.1} N to {greatest:.1} N")),
        ("deflection", format!("{deflection:.3} mm under {} kg", summary["payload"])),
    ])
}

/// A paragraph in lines of at most 110 columns; those after the first begin with `indent`.
fn wrapped(text: &str, indent: &str) -> String {
    let (mut wrapped, mut column) = (String::new(), 0);
    for word in text.split(' ') {
        let length = word.chars().count();
        if column > 0 && column + length >= 110 {
            wrapped += &format!("\n{indent}");
            column = indent.len();
        } else if column > 0 {
            wrapped.push(' ');
            column += 1;
        }
        wrapped += word;
        column += length;
    }
    wrapped
}
