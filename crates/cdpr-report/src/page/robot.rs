//! The robot in space, and tables of its cables.

use crate::page::elements::{Section, cell, numeric, table};
use crate::scene::{Scene, ScenePose};
use crate::text;
use cdpr_assess::FoundRegion;
use cdpr_robot::{Robot, Vector3};
use cdpr_study::{Study, StudyError};
use maud::{Markup, html};
use serde::Serialize;
use std::collections::HashMap;

/// The region that is held, as the page draws it: points [m], and lines or triangles between them.
#[derive(Serialize)]
pub(crate) struct RegionInSpace {
    points: Vec<[f32; 3]>,
    /// Indices of the points of closed lines.
    lines: Vec<Vec<usize>>,
    /// Indices of the corners of triangles.
    triangles: Vec<[usize; 3]>,
}

impl RegionInSpace {
    pub(crate) fn new(region: &FoundRegion) -> Self {
        let (mut points, mut known) = (Vec::new(), HashMap::new());
        let mut index = |point: &Vector3<f64>| {
            // To a tenth of a millimetre.
            let place: [i64; 3] = point.map(|x| (1e4 * x).round() as i64).into();
            *known.entry(place).or_insert_with(|| {
                points.push(place.map(|x| (1e-4 * x as f64) as f32));
                points.len() - 1
            })
        };
        let lines = region.polygons.iter().map(|line| line.iter().map(&mut index).collect()).collect();
        let triangles = region.triangles.iter().map(|corners| corners.each_ref().map(&mut index)).collect();
        Self { points, lines, triangles }
    }
}

pub(crate) fn section(
    study: &Study,
    scene: &Result<Scene, StudyError>,
    region: Option<&FoundRegion>,
) -> Section {
    let load = text::load_word(&study.file.load());
    let body = match scene {
        Ok(scene) => html! { (view(&study.robot, scene, region, load)) (offer()) (cables(scene, load)) },
        Err(error) => html! { p.note { "The robot cannot be drawn: " (error) "." } (offer()) },
    };
    Section::new("robot", "The robot", body)
}

fn view(robot: &Robot, scene: &Scene, region: Option<&FoundRegion>, load: &str) -> Markup {
    let alt = format!(
        "{} in three dimensions with its {} sagging cables; the tables below have its numbers",
        robot.name,
        robot.cables.len()
    );
    html! {
        figure id="figure-robot" {
            form.controls {
                label { "Pose " select id="pose" {
                    @for (i, pose) in scene.poses.iter().enumerate() { option value=(i) { (pose.name) } }
                } }
                fieldset {
                    legend { "Load" }
                    label { input type="radio" name="state" value="unloaded"; " own weight" }
                    label { input type="radio" name="state" value="loaded" checked; " with " (load) }
                }
                label { "Sag drawn " output id="sag-times" for="sag" { "\u{d7}1" }
                    input type="range" id="sag" min="0" max="9" step="1" value="0"
                        aria-describedby="robot-note"; }
                label { "Deflection drawn " output id="motion-times" for="motion" { "\u{d7}1" }
                    input type="range" id="motion" min="0" max="9" step="1" value="0"; }
            }
            @if region.is_some() {
                form.controls { label { input type="checkbox" id="region" checked; " region held" } }
            }
            div.plot id="plot-robot" role="img" aria-label=(alt) tabindex="0" {}
            noscript { p.note { "Only the view in space needs JavaScript." } }
            figcaption {
                span id="robot-note" {} " The colour of a cable shows its tension at the platform. Grey "
                "posts and rings: a frame through the exit points, because a robot file describes no other. "
                "Drag to turn; click, then wheel or pinch to zoom; with the "
                "keyboard: arrows, + and \u{2212}."
                @if let Some(region) = region {
                    " The region in which tensions within the limits hold the platform with "
                    (text::digits(region.payload, 4)) " kg, "
                    (if region.way == "kept" { "with its lengths kept" } else { "tensions recomputed" })
                    ", has " (text::digits(region.measure, 4))
                    (if region.triangles.is_empty() { " m\u{b2}." } else { " m\u{b3}." })
                }
            }
        }
    }
}

/// The way to the robot that computes.
fn offer() -> Markup {
    html! {
        p.note id="live-offer" hidden {
            button type="button" id="live-open" { "Move this robot" }
            " computes it here, by the same models: at other poses, loads and tolerances, with what matters "
            "most there."
        }
    }
}

/// The window of the robot that computes, beside the page, whose styles are not for it.
pub(crate) fn live(robot: &Robot) -> Markup {
    html! {
        dialog id="live" aria-label={ (robot.name) ", computed here" } {
            button type="button" id="live-close" { "Back to the report" }
            div id="live-robot" {}
        }
    }
}

fn cables(scene: &Scene, load: &str) -> Markup {
    let tension = format!("Tension, {load} [N]");
    let head = [
        "Cable",
        "Unstrained length [m]",
        "Tension, own weight [N]",
        "Sag [mm]",
        tension.as_str(),
        "Sag [mm]",
    ];
    let rows = |pose: &ScenePose| -> Vec<Vec<Markup>> {
        let states = pose.unloaded.cables.iter().zip(&pose.loaded.cables);
        pose.lengths
            .iter()
            .zip(states)
            .enumerate()
            .map(|(i, (length, (unloaded, loaded)))| {
                let mut row = vec![cell((i + 1).to_string()), numeric(*length, 5)];
                for cable in [unloaded, loaded] {
                    row.extend([numeric(cable.tension, 4), numeric(cable.sag_mm, 3)]);
                }
                row
            })
            .collect()
    };
    html! {
        @for pose in &scene.poses {
            details {
                summary { "Cables at " (pose.name) ": deflection " (text::digits(pose.deflection_mm, 4))
                    " mm, greatest sag "
                    (text::digits(pose.unloaded.greatest_sag_mm(), 3)) " mm" }
                @let caption = format!(
                    "Cables of the nominal robot at {}; tensions at the platform, sag across the chord",
                    pose.name
                );
                (table(&caption, &head, &rows(pose)))
            }
        }
    }
}
