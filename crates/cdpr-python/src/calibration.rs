//! Calibration, as `cdpr calibrate` has it. The package `cdpr.calibration` makes classes of the answers.

use crate::convert::{Answer, Numbers, Raised, Rows, question, run, to_json, watched};
use crate::robot::Robot;
use crate::robot::inverse::coordinates;
use crate::source::Source;
use cdpr_calibration::{
    AtWork, Calibrated, Calibration, CalibrationError, Campaign, Combination, Criterion, Difference,
    FitSettings, Measurement, Noise, Quality, RobustLoss, SensorError, Simulated, Unknowns, carry_out, drawn,
    drawn_errors, read_measurements, write_measurements,
};
use cdpr_report::calibration_report;
use cdpr_robot::{CableEnd, Pose, Vector3};
use cdpr_statics::Load;
use cdpr_study::{ErrorModel, IfExists, uncertainties, write_file};
use pyo3::prelude::*;
use serde_json::{Map, Value, json};
use std::path::PathBuf;

/// Numbers by name.
type Named = Vec<(String, f64)>;

/// Fits the parameters of a robot to measurements, and writes all results to a folder if one is given.
///
/// Returns the calibrated robot, and as JSON the summary, what is known of the robot's errors, the residuals
/// and the poses.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub(crate) fn calibrate(
    py: Python,
    robot: &Robot,
    measurements: Source,
    out: Option<PathBuf>,
    noise: Named,
    uncertainty: Option<Uncertain>,
    parameters: Vec<String>,
    share: Vec<String>,
    unknown: Vec<(String, Option<f64>)>,
    bounds: Vec<(String, [f64; 2])>,
    markers: Vec<[f64; 3]>,
    loss: &str,
    starts: usize,
    seed: u64,
    only_identifiable: bool,
    folds: usize,
    overwrite: bool,
    threads: Option<usize>,
) -> Answer<(Robot, String)> {
    let robot = &robot.robot;
    let loss = match loss {
        "squares" => RobustLoss::Squares,
        "huber" => RobustLoss::Huber,
        "cauchy" => RobustLoss::Cauchy,
        _ => return Err(Raised::Input(format!("loss is {loss}: expected squares, huber or cauchy"))),
    };
    let settings = FitSettings { loss, starts, seed, only_identifiable, ..FitSettings::default() };
    let work = |_: &_| -> Answer<(Robot, String)> {
        let prior = uncertainty.map(|of| of.errors(robot)).transpose()?;
        let measured = read_measurements(&measurements.measurements()?, robot, &noise)?;
        let names: Vec<&str> = parameters.iter().map(String::as_str).collect();
        let share: Vec<&str> = share.iter().map(String::as_str).collect();
        let mut unknowns = Unknowns::sought(robot, prior.as_ref(), &names, &share)?;
        for (name, std) in &unknown {
            unknowns.add(robot, SensorError::from_name(name)?, *std, measured.markers);
        }
        for (name, bounds) in &bounds {
            unknowns.bound(robot, name, *bounds)?;
        }
        unknowns.set_markers(markers.into_iter().map(Vector3::from).collect());
        let name = measurements.path().file_name().map(|name| name.to_string_lossy().into_owned());
        let campaign = Campaign {
            robot,
            prior: prior.as_ref(),
            unknowns: &unknowns,
            measured: &measured,
            name: &name.unwrap_or_default(),
            settings,
            folds,
        };
        let out = out.as_deref().map(|out| (out, IfExists::overwriting(overwrite)));
        let made = carry_out(&campaign, out, calibration_report)?;
        let content = calibrated(&made)?;
        Ok((Robot { robot: made.robot }, content))
    };
    watched(py, threads, |_| Ok(()), work)?
}

/// Everything but the robot as JSON: a residual is measured less modelled, by the robot before and after.
fn calibrated(made: &Calibrated) -> Answer<String> {
    let of_row = |(before, after): (&Difference, &Difference)| {
        json!({
            "line": after.line,
            "column": after.quantity.to_string(),
            "unit": after.quantity.unit(),
            "before": before.difference,
            "after": after.difference,
            "std": after.std,
        })
    };
    let fit = &made.fit;
    to_json(&json!({
        "summary": made.summary,
        "posterior": made.posterior,
        "residuals": fit.before.iter().zip(&fit.after).map(of_row).collect::<Vec<_>>(),
        "poses": fit.poses.iter().map(numbers).collect::<Vec<_>>(),
        "poses_before": fit.poses_before.iter().map(numbers).collect::<Vec<_>>(),
    }))
}

/// A pose as calls take it: x, y, z, qw, qx, qy, qz.
fn numbers(pose: &Pose) -> Vec<f64> {
    [pose.position.as_slice(), &pose.quaternion()].concat()
}

/// The friction of pulleys from tensions at the winches, as JSON.
#[pyfunction]
pub(crate) fn calibrate_pulleys(
    py: Python,
    robot: &Robot,
    measurements: Source,
    pose: Option<Numbers>,
    noise: Named,
    free: Option<Vec<String>>,
) -> Answer<String> {
    let (robot, free) = (&robot.robot, coordinates(free)?);
    let poses = pose.map(|pose| Rows::poses("pose", &pose, robot)).transpose()?;
    let pose = match &poses {
        Some(poses) if poses.number() != 1 => {
            return Err(Raised::Input(format!("pose has {} rows: expected one pose", poses.number())));
        }
        poses => poses.as_ref().map(|poses| poses.pose(0)).transpose()?,
    };
    let found = run(py, |_| -> Answer<_> {
        let measured = read_measurements(&measurements.measurements()?, robot, &noise)?;
        Ok(cdpr_calibration::calibrate_pulleys(robot, &measured, pose.as_ref(), &free)?)
    });
    to_json(&found??)
}

/// What measurements at poses determine of uncertain parameters, as JSON.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub(crate) fn identify(
    py: Python,
    robot: &Robot,
    poses: Numbers,
    uncertainty: Uncertain,
    noise: Named,
    payload: f64,
    free: Option<Vec<String>>,
) -> Answer<String> {
    let poses = Rows::poses("poses", &poses, &robot.robot)?;
    let free = coordinates(free)?;
    run(py, |_| {
        let model = uncertainty.errors(&robot.robot)?;
        let calibration = Calibration::of_model(&robot.robot, &model)?.with_free(&free);
        let (calibration, held) = measured(calibration, &poses, payload, &noise)?;
        let found = calibration.identify(0..held.len());
        let part = |of: &Combination| {
            let weights: Map<String, Value> =
                of.weights.iter().map(|of| (of.cause.clone(), json!(of.value))).collect();
            json!({ "signal_to_noise": of.signal_to_noise, "weights": weights })
        };
        let remaining: Map<String, Value> =
            found.remaining.iter().map(|of| (of.parameter.to_string(), json!(of.value))).collect();
        to_json(&json!({
            "poses": held.len(),
            "identifiable": found.identifiable.iter().map(part).collect::<Vec<_>>(),
            "unidentifiable": found.unidentifiable.iter().map(part).collect::<Vec<_>>(),
            "remaining": remaining,
        }))
    })?
}

/// The set of candidate poses that leaves least uncertainty, as JSON.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub(crate) fn plan(
    py: Python,
    robot: &Robot,
    poses: Numbers,
    uncertainty: Uncertain,
    noise: Named,
    count: usize,
    criterion: &str,
    work: Option<Numbers>,
    of: &str,
    payload: f64,
    free: Option<Vec<String>>,
    seed: u64,
) -> Answer<String> {
    let poses = Rows::poses("poses", &poses, &robot.robot)?;
    let work = work.as_ref().map(|work| Rows::poses("work", work, &robot.robot)).transpose()?;
    let free = coordinates(free)?;
    let criterion = match criterion {
        "information" => Criterion::Information,
        "parameters" => Criterion::Parameters,
        "mean-at-work" => Criterion::MeanAtWork,
        "worst-at-work" => Criterion::WorstAtWork,
        _ => {
            let expected = "information, parameters, mean-at-work or worst-at-work";
            return Err(Raised::Input(format!("criterion is {criterion}: expected {expected}")));
        }
    };
    let of = match of {
        "position" => AtWork::Position,
        "deflection" => AtWork::Deflection,
        _ => return Err(Raised::Input(format!("of is {of}: expected position or deflection"))),
    };
    run(py, |_| {
        let model = uncertainty.errors(&robot.robot)?;
        let calibration = Calibration::of_model(&robot.robot, &model)?.with_free(&free);
        let (mut calibration, held) = measured(calibration, &poses, payload, &noise)?;
        let mut worked = 0;
        for k in 0..work.as_ref().map_or(0, Rows::number) {
            let pose = work.as_ref().map(|work| work.pose(k)).transpose()?;
            let added = pose.map(|pose| calibration.add_work(&pose, &Load::payload(payload), of));
            worked += usize::from(added.is_some_and(|added| added.is_ok()));
        }
        if worked == 0 && matches!(criterion, Criterion::MeanAtWork | Criterion::WorstAtWork) {
            let message = "work has no pose that the robot holds: expected where the robot works".to_owned();
            return Err(Raised::Input(message));
        }
        let found = calibration.plan(count, criterion, seed);
        let left = |of: &Quality| {
            json!({
                "information_bits": of.information,
                "parameters": of.parameters,
                "mean_at_work": of.mean_at_work,
                "worst_at_work": of.worst_at_work,
            })
        };
        to_json(&json!({
            "candidates": held.len(),
            "poses": found.poses.iter().map(|k| numbers(&held[*k])).collect::<Vec<_>>(),
            "plan": left(&found.quality),
            "random": left(&found.random),
            "outermost": left(&found.corners),
            "growing": found.growing.iter().map(left).collect::<Vec<_>>(),
        }))
    })?
}

/// What a campaign would read at poses with a robot that deviates from its file, written to a file if one is
/// given: the robot as it truly is, and the measurements as CSV.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub(crate) fn simulate(
    py: Python,
    robot: &Robot,
    poses: Numbers,
    out: Option<PathBuf>,
    uncertainty: Uncertain,
    noise: Named,
    unknown: Named,
    markers: Vec<[f64; 3]>,
    tension_at: &str,
    payload: f64,
    free: Option<Vec<String>>,
    seed: u64,
    overwrite: bool,
) -> Answer<(Robot, String)> {
    let robot = &robot.robot;
    let poses = Rows::poses("poses", &poses, robot)?;
    let poses = (0..poses.number()).map(|k| poses.pose(k)).collect::<Result<Vec<_>, _>>()?;
    let free = coordinates(free)?;
    let tension_at = match tension_at {
        "platform" => CableEnd::Anchor,
        "winch" => CableEnd::Exit,
        _ => return Err(Raised::Input(format!("tension_at is {tension_at:?}: expected platform or winch"))),
    };
    let markers: Vec<Vector3<f64>> = markers.into_iter().map(Vector3::from).collect();
    run(py, |_| -> Answer<(Robot, String)> {
        let deviations = drawn(&uncertainty.errors(robot)?, seed);
        let named = |(name, std): &(String, f64)| Ok((SensorError::from_name(name)?, *std));
        let errors = unknown.iter().map(named).collect::<Result<Vec<_>, CalibrationError>>()?;
        let rows = cdpr_calibration::simulate(&Simulated {
            nominal: robot,
            deviations: &deviations,
            poses: &poses,
            free: &free,
            load: Load::payload(payload),
            noise: Noise::named(&noise)?,
            markers: &markers,
            errors: &drawn_errors(robot, &errors, markers.len(), seed),
            tension_at,
            seed,
        })?;
        let (header, lines) = write_measurements(&rows);
        let lines = lines.iter().map(|line| line.join(",") + "\n").collect::<String>();
        let text = header.join(",") + "\n" + &lines;
        if let Some(out) = out {
            write_file(&out, &text, IfExists::overwriting(overwrite))?;
        }
        Ok((Robot { robot: robot.perturbed(&deviations)?.robot }, text))
    })?
}

/// The calibration with all poses that the robot holds, and these poses.
fn measured(
    mut calibration: Calibration,
    poses: &Rows,
    payload: f64,
    noise: &Named,
) -> Answer<(Calibration, Vec<Pose>)> {
    let measurements = Measurement::named(calibration.robot(), noise)?;
    let mut held = Vec::new();
    let mut reason = None;
    for k in 0..poses.number() {
        let pose = poses.pose(k)?;
        match calibration.add(&pose, &Load::payload(payload), &measurements) {
            Ok(()) => held.push(pose),
            Err(error) if error.kind() == "invalid_input" => return Err(error.into()),
            Err(error) => reason = Some(error),
        }
    }
    match reason {
        Some(reason) if held.is_empty() => Err(reason.into()),
        _ => Ok((calibration, held)),
    }
}

/// What is uncertain: standard deviations by name, or the laws of an error model.
#[derive(FromPyObject)]
pub(crate) enum Uncertain {
    Named(Named),
    Laws(Source),
}

impl Uncertain {
    /// The error model, whose deviations are questioned.
    fn errors(&self, robot: &cdpr_robot::Robot) -> Answer<ErrorModel> {
        match self {
            Self::Named(named) => {
                let model = ErrorModel::normal(robot, &uncertainties(robot, named)?);
                question(model.doubts(robot))?;
                Ok(model)
            }
            Self::Laws(source) => source.errors(robot),
        }
    }
}
