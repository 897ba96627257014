//! What a robot is, and where it can stand first.

use crate::answers::failure::Failure;
use crate::answers::observe::SAMPLING;
use crate::question::PoseGiven;
use cdpr_robot::{CableEnd, Coordinate, Parameter, Robot};
use cdpr_study::{STUDY_NAME, Study, StudyFile, template};
use serde::Serialize;
use std::path::Path;

/// A robot.
#[derive(Serialize)]
pub(crate) struct Description {
    name: String,
    source: Option<String>,
    /// Number of cables, and of free motions.
    cables: usize,
    freedoms: usize,
    /// Coordinates of a pose that are found, because cables are missing.
    free: Vec<Coordinate>,
    /// Coordinates that cannot change: of a point mass or a planar robot.
    held: Vec<Coordinate>,
    parameters: Vec<Named>,
    /// Exit points in the base frame, and anchor points in the platform frame [m].
    exits: Vec<[f64; 3]>,
    anchors: Vec<[f64; 3]>,
    center_of_mass: [f64; 3],
    mass: f64,
    limits: Vec<Limits>,
    /// Breaking forces [N].
    breaking: Vec<Option<f64>>,
    /// Whether `platform.inertia` is given, on which natural frequencies depend.
    inertia: bool,
    /// A pose that the robot holds with the payload; absent with a reason.
    start: Option<FirstPose>,
    start_reason: Option<String>,
    /// The study that was given, or one with tolerances that are assumed, as `cdpr study new` writes it.
    study: Option<StudyFile>,
}

/// A parameter.
#[derive(Serialize)]
struct Named {
    name: String,
    group: &'static str,
    unit: &'static str,
    nominal: f64,
}

/// Limits of a cable's tension.
#[derive(Serialize)]
struct Limits {
    /// [N].
    min: f64,
    max: f64,
    /// The end at which the greatest tension is limited.
    at: &'static str,
}

/// A pose and a payload [kg].
#[derive(Serialize)]
struct FirstPose {
    pose: PoseGiven,
    payload: f64,
}

pub(crate) fn describe(robot: &Robot, study: Option<StudyFile>) -> Description {
    let (study, first, start_reason) = match first(robot, study) {
        Ok((study, first)) => (Some(study), Some(first), None),
        Err(reason) => (None, None, Some(reason.reason)),
    };
    let sampling = study.as_ref().and_then(|study| study.samplings.get(SAMPLING));
    let freedoms = robot.freedoms();
    let point = |point: &cdpr_robot::Vector3<f64>| (*point).into();
    Description {
        name: robot.name.clone(),
        source: robot.provenance.source.clone(),
        cables: robot.cables.len(),
        freedoms: freedoms.count(),
        free: sampling.map_or_else(Vec::new, |sampling| sampling.free.clone()),
        held: Coordinate::ALL.into_iter().filter(|one| !freedoms.contains(one.component())).collect(),
        parameters: Parameter::of(robot)
            .iter()
            .map(|parameter| Named {
                name: parameter.to_string(),
                group: parameter.group(),
                unit: parameter.unit(),
                nominal: parameter.nominal(robot),
            })
            .collect(),
        exits: robot.cables.iter().map(|cable| point(&cable.exit_point)).collect(),
        anchors: robot.cables.iter().map(|cable| point(&cable.anchor_point)).collect(),
        center_of_mass: point(&robot.platform.center_of_mass),
        mass: robot.platform.mass,
        limits: (0..robot.cables.len())
            .map(|i| {
                let limits = robot.limits(i);
                let at = if robot.max_at(i) == CableEnd::Exit { "exit" } else { "anchor" };
                Limits { min: limits.min, max: limits.max, at }
            })
            .collect(),
        breaking: robot.cables.iter().map(|cable| cable.properties.breaking_force).collect(),
        inertia: robot.platform.inertia.is_some(),
        start: first,
        start_reason,
        study,
    }
}

/// The study, or that of the template of which only what is observed is left, and its pose.
fn first(robot: &Robot, given: Option<StudyFile>) -> Result<(StudyFile, FirstPose), Failure> {
    let file = given.map_or_else(|| assumed(robot), Ok)?;
    let study = Study::of_robot(file, robot.clone(), Path::new(STUDY_NAME))?;
    let pose = PoseGiven::from(&study.nominal(SAMPLING)?.pose);
    let first = FirstPose { pose, payload: study.file.payload };
    Ok((study.file, first))
}

fn assumed(robot: &Robot) -> Result<StudyFile, Failure> {
    let text = template(robot, &robot.name, None, None, &[])?;
    let mut file: StudyFile = serde_json::from_str(&text).map_err(|error| Failure::question(&error))?;
    file.surfaces.clear();
    file.sensitivity = None;
    Ok(file)
}
