//! `cargo xtask gallery`: docs/robots.md, a picture and a table for each robot of the library, and
//! docs/live.md, where they move.
//!
//! The picture is that of the study that `cdpr study new` writes, at its pose and under its load; a robot
//! with fewer cables than free motions is drawn with straight cables at the pose that `cdpr inverse --free`
//! finds.

mod film;

use crate::cargo::{answer, number, output, parsed, read, read_json, root, write};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;

/// Poses of the robots with fewer cables than free motions [m].
const FREE: [(&str, &str); 3] =
    [("four-cables", "0.5,0.3,2"), ("grab", "1.28,-0.19,-0.92"), ("irma4u", "0.2,0.1,0.8")];

/// What is behind the warnings of `cdpr robot check`.
const REMARKS: [(&str, &str); 1] = [(
    "copacabana-handling",
    "its upper exit points lead to the lower anchor points, so that cables pass each other closely",
)];

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
pub(crate) fn run() -> Result<(), String> {
    let folder = root().join("target/gallery");
    let pictures = root().join("docs/images/robots");
    for folder in [&folder, &pictures] {
        std::fs::create_dir_all(folder)
            .map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    }
    film::run()?;
    let mut page = String::from(
        "# Robots that are known

The library has these robots; every command takes their names, `cdpr robot check cogiro`. Each table has the pose at
the middle of the workspace that `cdpr study new` finds, the tensions that hold it, and how far the template's
payload, a tenth of the platform's mass, moves the platform. `cargo xtask gallery` makes this page and its
pictures.

",
    );
    let mut live = String::from(LIVE);
    let robots = answer(&["robot", "list"], &[0])?;
    for robot in robots["robots"].as_array().ok_or("no list of robots")? {
        let name = text(&robot["name"]);
        eprintln!("{name}");
        let rows = match FREE.iter().find(|(free, _)| *free == name) {
            Some((_, pose)) => suspended(name, pose, &pictures)?,
            None => studied(name, &folder, &pictures)?,
        };
        section(&mut page, robot, &rows)?;
        // Writing to a string cannot fail.
        let _ = writeln!(
            live,
            "<a href=\"explorer/{name}.html\" target=\"robot\">{}</a> ({} cables)",
            text(&robot["title"]),
            robot["cables"],
        );
    }
    write(&root().join("docs/live.md"), &(live + FRAME))?;
    write(&root().join("docs/robots.md"), &page)
}

/// The section of one robot.
fn section(page: &mut String, robot: &Value, rows: &[(&str, String)]) -> Result<(), String> {
    let name = text(&robot["name"]);
    let findings = answer(&["robot", "check", name], &[0, 3])?;
    let provenance = answer(&["robot", "show", name], &[0])?;
    let findings = findings.as_array().ok_or("no list of findings")?;
    let warnings: Vec<_> = findings.iter().filter(|finding| finding["severity"] == "warning").collect();
    let extent = robot["extent_m"].as_array().ok_or("no extent")?;
    let extent: Vec<_> = extent.iter().map(|side| format!("{:.1}", number(side))).collect();
    // Writing to a string cannot fail.
    let _ = write!(
        page,
        "## {}\n\n![{}](images/robots/{name}.svg)\n\n| `{name}` | {} |\n|---|---|\n| cables | {} |\n\
         | platform | {} kg |\n| exit points | {} m |\n",
        text(&robot["title"]),
        text(&robot["title"]),
        text(&robot["grade"]),
        robot["cables"],
        robot["mass_kg"],
        extent.join(" x "),
    );
    for (what, value) in rows {
        let _ = writeln!(page, "| {what} | {value} |");
    }
    let notes = findings.len() - warnings.len();
    let _ = writeln!(page, "| `cdpr robot check` | warnings {}, notes {notes} |\n", warnings.len());
    for warning in &warnings {
        let behind = REMARKS.iter().find(|(robot, _)| *robot == name).map_or("not explained", |(_, why)| why);
        let said =
            format!("`check` warns of {}, {}: {behind}.", text(&warning["field"]), text(&warning["why"]));
        let _ = writeln!(page, "{}\n", wrapped(&said, ""));
    }
    let _ = writeln!(page, "{}\n", wrapped(&format!("Source: {}", text(&provenance["source"])), ""));
    let assumed = provenance["assumed"].as_array().ok_or("no list of assumptions")?;
    if !assumed.is_empty() {
        let lines: Vec<_> = assumed.iter().map(|one| wrapped(&format!("- {}", text(one)), "  ")).collect();
        let _ = writeln!(page, "Assumed:\n\n{}\n", lines.join("\n"));
    }
    Ok(())
}

/// Runs a small study of the template, keeps its picture, and reads its pose, tensions and deflection.
fn studied(name: &str, folder: &Path, pictures: &Path) -> Result<Vec<(&'static str, String)>, String> {
    let mut study: Value = parsed(&output(&["study", "new", name], &[0])?)?;
    study.as_object_mut().map(|study| study.remove("sensitivity"));
    study["replicates"] = json!(0);
    study["samplings"]["all"]["observations"] = json!(32);
    for axis in ["x", "y"] {
        study["surfaces"]["modulus_mass"][axis]["points"] = json!(3);
    }
    let (file, results) = (folder.join(format!("{name}.json")), folder.join(name));
    write(&file, &study.to_string())?;
    let [file, out] = [&file, &results].map(|path| path.display().to_string());
    output(&["study", "run", &file, "--out", &out, "--overwrite"], &[0])?;
    write(&pictures.join(format!("{name}.svg")), &read(&results.join("robot.svg"))?)?;
    let summary = read_json(&results.join("summary.json"))?;
    let all = &summary["studies"]["all"];
    let pose = all["pose"].as_array().ok_or("no pose")?;
    let pose: Vec<_> = pose.iter().map(ToString::to_string).collect();
    Ok(vec![
        ("pose", format!("({}) m", pose.join(", "))),
        ("tensions", range(&all["nominal"]["unloaded_tensions"])?),
        (
            "deflection",
            format!("{:.3} mm under {} kg", number(&all["magnitude_mm"]["nominal"]), summary["payload"]),
        ),
    ])
}

/// Finds roll and pitch at a position, and draws the robot there.
fn suspended(name: &str, pose: &str, pictures: &Path) -> Result<Vec<(&'static str, String)>, String> {
    let found = answer(&["inverse", name, "--pose", pose, "--free", "roll,pitch"], &[0, 3])?;
    let robot = read_json(&root().join(format!("data/robots/{name}.json")))?;
    write(&pictures.join(format!("{name}.svg")), &drawn(&robot, &found)?)?;
    let angles = found["roll_pitch_yaw_deg"].as_array().ok_or("no angles")?;
    let [roll, pitch] = [0, 1].map(|i| format!("{:.2}", number(&angles[i])));
    Ok(vec![
        (
            "pose",
            format!(
                "({}) m, where it comes to rest with roll {roll}°, pitch {pitch}°",
                pose.replace(',', ", ")
            ),
        ),
        ("tensions", range(&found["tensions"])?),
    ])
}

/// The robot with straight cables, in the projection of the other pictures.
fn drawn(robot: &Value, found: &Value) -> Result<String, String> {
    let point = |value: &Value| [0, 1, 2].map(|axis| number(&value[axis]));
    let pose = &found["found_pose"];
    let [w, x, y, z] = [3, 4, 5, 6].map(|i| number(&pose[i]));
    let at = point(pose);
    let turned = |[a, b, c]: [f64; 3]| {
        let [tx, ty, tz] = [2.0 * (y * c - z * b), 2.0 * (z * a - x * c), 2.0 * (x * b - y * a)];
        [a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx]
    };
    let anchor = |cable: &Value| {
        let arm = turned(point(&cable["anchor_point"]));
        [0, 1, 2].map(|axis| at[axis] + arm[axis])
    };
    let cables = robot["cables"].as_array().ok_or("no cables")?;
    let lines: Vec<_> = cables.iter().map(|cable| (point(&cable["exit_point"]), anchor(cable))).collect();
    let ((sin, cos), (sin_up, cos_up)) = ((-1.05_f64).sin_cos(), 0.42_f64.sin_cos());
    let seen = |[x, y, z]: [f64; 3]| [y * cos - x * sin, -(z * cos_up - (x * cos + y * sin) * sin_up)];
    let ends: Vec<_> = lines.iter().flat_map(|(exit, anchor)| [seen(*exit), seen(*anchor)]).collect();
    let least = [0, 1].map(|axis| ends.iter().map(|end| end[axis]).fold(f64::INFINITY, f64::min));
    let most = [0, 1].map(|axis| ends.iter().map(|end| end[axis]).fold(f64::NEG_INFINITY, f64::max));
    let scale = (600.0 / (most[0] - least[0])).min(400.0 / (most[1] - least[1]));
    let pixel = |point: [f64; 3]| {
        let [x, y] = seen(point);
        format!("{:.1} {:.1}", 20.0 + scale * (x - least[0]), 20.0 + scale * (y - least[1]))
    };
    let path = |points: &[[f64; 3]], closed: bool, color: &str| {
        let points: Vec<_> = points.iter().map(|point| pixel(*point)).collect();
        let end = if closed { " Z" } else { "" };
        format!(
            "<path d=\"M {}{end}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2\"/>\n",
            points.join(" L ")
        )
    };
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0} {:.0}\">\n<rect width=\"100%\" \
         height=\"100%\" fill=\"white\"/>\n",
        40.0 + scale * (most[0] - least[0]),
        40.0 + scale * (most[1] - least[1]),
    );
    let (exits, anchors): (Vec<_>, Vec<_>) = lines.iter().copied().unzip();
    svg += &path(&exits, true, "#999999");
    svg += &path(&anchors, true, "#d55e00");
    lines.iter().for_each(|(exit, anchor)| svg += &path(&[*exit, *anchor], false, "#0072b2"));
    Ok(svg + "</svg>\n")
}

/// A paragraph in lines of at most 110 columns; those after the first begin with `indent`.
fn wrapped(text: &str, indent: &str) -> String {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let line = lines.last().map_or(0, |line| line.chars().count());
        if line > indent.len() && line + word.chars().count() >= 110 {
            lines.push(format!("{indent}{word}"));
            continue;
        }
        let between = if line == 0 { "" } else { " " };
        if let Some(line) = lines.last_mut() {
            *line += between;
            *line += word;
        }
    }
    lines.join("\n")
}

/// Least and greatest of a list of tensions [N].
fn range(tensions: &Value) -> Result<String, String> {
    let tensions: Vec<f64> = tensions.as_array().ok_or("no tensions")?.iter().map(number).collect();
    let least = tensions.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = tensions.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    Ok(format!("{least:.1} N to {greatest:.1} N"))
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}
