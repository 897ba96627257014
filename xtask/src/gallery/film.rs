//! The film of the README: CoGiRo after one of its cables has parted.

use crate::cargo::{Outcome, cdpr_command, number, read, read_json, root, text_of, write};
use serde_json::Value;

/// Where the platform rests at first, and what happens.
const POSE: &str = "0,0,2";
const EVENTS: &str = "data/events/cable-parts.json";
const CUT: usize = 0;
/// Length of the film [s], frames a second, and how many times as large motions are drawn.
const SECONDS: f64 = 3.0;
const RATE: usize = 16;
const MAGNIFICATION: f64 = 3.0;
/// Longest distance of two anchor points that is drawn as an edge [m].
const LONGEST_EDGE: f64 = 1.2;

type Point = [f64; 3];

/// Writes `docs/images/cable-parts.svg`.
pub(super) fn run() -> Outcome {
    let series = root().join("target/gallery/cable-parts.csv");
    let (seconds, rate) = (SECONDS.to_string(), RATE.to_string());
    let motion = ["simulate", "cogiro", "--pose", POSE, "--until", &seconds, "--rate", &rate];
    let mut command = cdpr_command(&[&motion[..], &["--damping", "2e-3", "--overwrite", "--out"]].concat());
    text_of(command.arg(&series).arg("--events").arg(root().join(EVENTS)), &[0, 3])?;
    let robot = read_json(&root().join("data/robots/cogiro.json"))?;
    let frames: Vec<[f64; 6]> = read(&series)?.lines().skip(1).filter_map(frame).collect();
    write(&root().join("docs/images/cable-parts.svg"), &film(&robot, &frames)?)
}

/// Position and rotation vector of a line of the series.
fn frame(line: &str) -> Option<[f64; 6]> {
    let numbers: Vec<f64> = line.split(',').skip(1).take(6).filter_map(|cell| cell.parse().ok()).collect();
    numbers.try_into().ok()
}

fn film(robot: &Value, frames: &[[f64; 6]]) -> Outcome<String> {
    let point = |value: &Value| [0, 1, 2].map(|axis| number(&value[axis]));
    let cables = robot["cables"].as_array().ok_or("no cables")?;
    let exits: Vec<Point> = cables.iter().map(|cable| point(&cable["exit_point"])).collect();
    let anchors: Vec<Point> = cables.iter().map(|cable| point(&cable["anchor_point"])).collect();
    let first = frames.first().ok_or("no frames")?;
    let placed = |frame: &[f64; 6], arm: Point| {
        let [dx, dy, dz, rx, ry, rz] = [0, 1, 2, 3, 4, 5].map(|k| MAGNIFICATION * (frame[k] - first[k]));
        let (shift, arm) = ([dx, dy, dz], rotated([rx, ry, rz], arm));
        [0, 1, 2].map(|k| first[k] + shift[k] + arm[k])
    };
    let duration = format!("dur=\"{SECONDS}s\" repeatCount=\"indefinite\"");
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"700\" height=\"380\" viewBox=\"0 0 700 380\">\n\
         <rect width=\"700\" height=\"380\" fill=\"#fff\"/>\n",
    );
    let mut line = |ends: &dyn Fn(&[f64; 6]) -> [Point; 2], style: &str| {
        let at: Vec<[[f64; 2]; 2]> = frames.iter().map(|frame| ends(frame).map(pixel)).collect();
        let (mut fixed, mut moved) = (String::new(), String::new());
        for (name, end, axis) in [("x1", 0, 0), ("y1", 0, 1), ("x2", 1, 0), ("y2", 1, 1)] {
            let values: Vec<String> = at.iter().map(|at| format!("{:.1}", at[end][axis])).collect();
            if values.iter().any(|value| *value != values[0]) {
                let values = values.join(";");
                moved += &format!("<animate attributeName=\"{name}\" values=\"{values}\" {duration}/>");
            }
            fixed += &format!(" {name}=\"{}\"", values[0]);
        }
        svg += &format!("<line{fixed} {style}>{moved}</line>\n");
    };
    for (i, (exit, anchor)) in exits.iter().zip(&anchors).enumerate() {
        let foot = [exit[0], exit[1], 0.0];
        line(&|_| [foot, *exit], "stroke=\"#bbb\" stroke-width=\"3\"");
        if i != CUT {
            line(&|frame| [*exit, placed(frame, *anchor)], "stroke=\"#0072b2\" stroke-width=\"1.5\"");
        }
    }
    for (i, one) in anchors.iter().enumerate() {
        // Edges and no diagonals of the body.
        let side =
            |other: &&Point| (0..3).map(|k| (one[k] - other[k]).powi(2)).sum::<f64>().sqrt() < LONGEST_EDGE;
        for other in anchors[..i].iter().filter(side) {
            line(&|frame| [placed(frame, *one), placed(frame, *other)], "stroke=\"#333\" stroke-width=\"1\"");
        }
    }
    Ok(svg + "</svg>\n")
}

/// A vector turned by a rotation vector (Rodrigues).
fn rotated(rotation: Point, arm: Point) -> Point {
    let angle = rotation.iter().map(|part| part * part).sum::<f64>().sqrt();
    if angle == 0.0 {
        return arm;
    }
    let axis = rotation.map(|part| part / angle);
    let along: f64 = (1.0 - angle.cos()) * (0..3).map(|k| axis[k] * arm[k]).sum::<f64>();
    let cross = [0, 1, 2].map(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        axis[i] * arm[j] - axis[j] * arm[i]
    });
    [0, 1, 2].map(|k| angle.cos() * arm[k] + angle.sin() * cross[k] + along * axis[k])
}

/// Where a point is seen, on the picture.
fn pixel([x, y, z]: Point) -> [f64; 2] {
    let ((sin, cos), (sin_up, cos_up)) = (0.38_f64.sin_cos(), 0.3_f64.sin_cos());
    let across = y * sin + x * cos;
    let depth = y * cos - x * sin;
    [350.0 + 33.0 * across, 290.0 - 33.0 * (z * cos_up + depth * sin_up)]
}
