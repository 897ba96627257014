//! Assessments of a robot and its cables, as the commands `check`, `tolerances`, `robustness`, `hysteresis`,
//! `modulus` and `linear-density` make them. The package `cdpr.assess` makes classes of these.

use crate::convert::{Answer, Raised, Rows, guarded, run, to_json, watched, whole};
use crate::robot::Robot;
use crate::robot::inverse::coordinates;
use crate::source::Source;
use cdpr_assess::{
    Limit, Limited, PoseRegion, ProtocolSummary, RobustnessSummary, begin_robustness, inspect, protocols,
    run_robustness, tolerance_budget, write_robustness,
};
use cdpr_cable::{Measured, Phase, SecantModulus, Specimen};
use cdpr_robot::Pose;
use cdpr_statics::WantedPose;
use cdpr_statics::hysteresis::{
    CycleStep, HysteresisLaw, LoadCycle, PulleyFriction, PulleyState, Unloading, WinchReading, fit_friction,
    load_cycle_over_pulleys,
};
use cdpr_study::{CableLaw, IfExists, elastic_laws, open_robot_in_any_unit};
use pyo3::prelude::*;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What is odd about a robot and yet no error, as JSON.
#[pyfunction]
pub(crate) fn check(py: Python, robot: &Robot) -> Answer<String> {
    to_json(&run(py, |_| inspect(&robot.robot))?)
}

/// The same of a robot file, whatever its units.
#[pyfunction]
pub(crate) fn check_file(py: Python, path: PathBuf) -> Answer<String> {
    let findings = run(py, |_| open_robot_in_any_unit(&path).map(|robot| inspect(&robot)))?;
    to_json(&findings?)
}

/// The tolerances to tighten so that an error stays below a limit, as JSON.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub(crate) fn tolerances(
    py: Python,
    study: Source,
    robot: Option<&Robot>,
    sampling: &str,
    limit_mm: f64,
    of: Option<&str>,
    quantile: f64,
    costs: BTreeMap<String, f64>,
    observations: Bound<PyAny>,
    threads: Option<usize>,
) -> Answer<String> {
    let of = match of {
        None => None,
        Some("deflection") => Some(Limited::Deflection),
        Some("position") => Some(Limited::Position),
        Some(of) => return Err(Raised::Input(format!("of is {of:?}: expected deflection or position"))),
    };
    let verified_with = whole("observations", &observations)?;
    let limit = Limit { of, limit_mm, quantile, costs: costs.into_iter().collect(), verified_with };
    watched(
        py,
        threads,
        |_| Ok(()),
        |_| -> Answer<String> {
            let study = study.study(robot)?;
            let sampling = study.sampling(sampling)?;
            to_json(&tolerance_budget(&sampling, &limit)?)
        },
    )?
}

/// How often the direct model finds the true pose from a wrong start: `robustness.json`.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub(crate) fn robustness(
    py: Python,
    robot: &Robot,
    poses: Bound<PyAny>,
    modulus: Option<f64>,
    region: Option<([f64; 3], [f64; 3])>,
    free: Option<Vec<String>>,
    seed: Bound<PyAny>,
    out: Option<PathBuf>,
    overwrite: bool,
    progress: Option<Py<PyAny>>,
    threads: Option<usize>,
) -> Answer<String> {
    let (robot, free) = (&robot.robot, coordinates(free)?);
    let max_angle = PoseRegion::of(robot).max_angle;
    let region = region.map(|(low, high)| PoseRegion { low, high, max_angle });
    let protocols = protocols(robot, whole("poses", &poses)?, modulus, region, &free, whole("seed", &seed)?);
    let all: usize = protocols.iter().map(|protocol| protocol.poses + protocol.solves()).sum();
    let done = AtomicUsize::new(0);
    let poll = |py: Python| {
        let done = done.load(Ordering::Relaxed);
        progress.as_ref().map_or(Ok(()), |call| call.call1(py, (done, all)).map(|_| ()))
    };
    watched(py, threads, poll, |_| -> Answer<String> {
        protocols.iter().try_for_each(cdpr_assess::Protocol::validate)?;
        let folder =
            out.as_deref().map(|out| begin_robustness(out, IfExists::overwriting(overwrite))).transpose()?;
        let tick = || {
            done.fetch_add(1, Ordering::Relaxed);
        };
        let run = |protocol| run_robustness(robot, protocol, &tick);
        let results = protocols.iter().map(run).collect::<Result<Vec<_>, _>>()?;
        let summary = RobustnessSummary {
            robot: robot.name.clone(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            protocols: results
                .iter()
                .map(|result| (result.protocol.name.to_owned(), ProtocolSummary::new(result)))
                .collect(),
        };
        if let Some(folder) = folder {
            let figures = [
                ("found_poses", cdpr_report::found_poses(&results[0])),
                ("success_share", cdpr_report::success_share(&summary.protocols[0])),
            ];
            // A figure that cannot be drawn is left out, as by the program.
            let figures: Vec<(String, String)> =
                figures.into_iter().filter_map(|(name, svg)| Some((name.to_owned(), svg.ok()?))).collect();
            write_robustness(&folder, &summary, &results, &figures)?;
        }
        to_json(&summary)
    })?
}

/// A payload that is put on and taken off, in SI units as JSON.
///
/// The cables follow a record (with length and section of its specimen), a law file, or the robot's own laws.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub(crate) fn hysteresis(
    py: Python,
    robot: &Robot,
    pose: Bound<PyAny>,
    payload: f64,
    record: Option<Source>,
    length: Option<f64>,
    section: Option<f64>,
    law: Option<Source>,
    unloading: &str,
    steps: Bound<PyAny>,
    free: Option<Vec<String>>,
    friction: f64,
    bearing: f64,
) -> Answer<String> {
    let (robot, free) = (&robot.robot, coordinates(free)?);
    let friction = PulleyFriction { friction, bearing };
    let from = match unloading {
        "turning-point" => Unloading::TurningPoint,
        "same-tension" => Unloading::SameTension,
        _ => {
            let message = format!("unloading is {unloading:?}: expected turning-point or same-tension");
            return Err(Raised::Input(message));
        }
    };
    let (pose, steps) = (single(&pose, robot)?, whole("steps", &steps)?);
    let law = match (record, length, law) {
        (Some(_), _, Some(_)) => {
            return Err(Raised::Input("record and law are both given: expected one of them".to_owned()));
        }
        (Some(record), Some(length), None) => {
            let of_cables = robot.cables[0].properties.section;
            if section.is_none() && robot.cables.iter().any(|of| of.properties.section != of_cables) {
                let message = "the cables of the robot differ in their section: expected section, that of the \
                               record's specimen";
                return Err(Raised::Input(message.to_owned()));
            }
            let law = CableLaw::of_record(&record.record()?, length, section.unwrap_or(of_cables));
            Some(law.map_err(|error| Raised::Input(format!("{}: {error}", record.path().display())))?)
        }
        (Some(_), None, None) => {
            return Err(Raised::Input(
                "length is None: expected that of the record's specimen [m]".to_owned(),
            ));
        }
        (None, _, Some(law)) => Some(law.law()?),
        (None, _, None) => None,
    };
    let laws = match law {
        Some(law) => {
            let curves = |(i, cable): (usize, &cdpr_robot::RobotCable)| {
                let curves = law.curves(&cable.properties, from);
                curves.map_err(|error| Raised::Input(format!("cable {}: {error}", i + 1)))
            };
            robot.cables.iter().enumerate().map(curves).collect::<Answer<Vec<HysteresisLaw>>>()?
        }
        None => match elastic_laws(robot).map_err(|error| Raised::from(&error))? {
            Some(laws) => laws,
            None if friction.is_none() => {
                let expected = "expected record, law, or a `law` in the robot file";
                return Err(Raised::Input(format!("no cable of the robot has a law: {expected}")));
            }
            None => {
                let linear = HysteresisLaw::linear().map_err(|error| Raised::from(&error))?;
                vec![linear; robot.cables.len()]
            }
        },
    };
    let cycle = || {
        let wanted = WantedPose::at(&pose).free(&free);
        load_cycle_over_pulleys(robot, wanted, &laws, payload, steps, friction)
    };
    let cycle = run(py, |_| cycle())??;
    to_json(&followed(&cycle))
}

fn followed(cycle: &LoadCycle) -> Value {
    let steps: Vec<&CycleStep> = cycle.loading.iter().chain(&cycle.unloading).collect();
    let position = |step: &&CycleStep| -> [f64; 3] { step.solution.equilibrium.pose.position.into() };
    let of_pulleys = |get: fn(&PulleyState) -> f64| -> Vec<Vec<f64>> {
        steps.iter().map(|step| step.pulleys.iter().map(get).collect()).collect()
    };
    let has_friction = cycle.loading.first().is_some_and(|step| !step.pulleys.is_empty());
    let pulleys = has_friction.then(|| {
        json!({
            "wraps": of_pulleys(|pulley| pulley.wrap),
            "leave_tensions": of_pulleys(|pulley| pulley.tension),
            "winch_tensions": of_pulleys(|pulley| pulley.winch_tension),
            "slips": of_pulleys(|pulley| pulley.slip),
        })
    });
    json!({
        "gap": cycle.gap(),
        "pulleys": pulleys,
        "deflection": <[f64; 3]>::from(cycle.deflection()),
        "residual": <[f64; 3]>::from(cycle.residual()),
        "payload_work": cycle.payload_work,
        "dissipated": cycle.dissipated,
        "middle_tensions": cycle.tensions,
        "lengths": cycle.lengths,
        "turn": cycle.loading.len(),
        "payloads": steps.iter().map(|step| step.payload).collect::<Vec<_>>(),
        "positions": steps.iter().map(position).collect::<Vec<_>>(),
        "tensions": steps.iter().map(|step| step.solution.equilibrium.tensions()).collect::<Vec<_>>(),
    })
}

/// The friction of pulleys from tensions on both sides of wheels that slip, as JSON.
#[pyfunction]
pub(crate) fn pulley_friction(
    wraps: Vec<f64>,
    tensions: Vec<f64>,
    winch_tensions: Vec<f64>,
    slips: Vec<f64>,
) -> Answer<String> {
    for (name, list) in [("tensions", &tensions), ("winch_tensions", &winch_tensions), ("slips", &slips)] {
        if list.len() != wraps.len() {
            let (count, expected) = (list.len(), wraps.len());
            let message = format!("{name} has {count} values: expected {expected}, as many as wraps");
            return Err(Raised::Input(message));
        }
    }
    let reading = |k: usize| WinchReading {
        wrap: wraps[k],
        tension: tensions[k],
        winch_tension: winch_tensions[k],
        slip: slips[k],
    };
    let fit = guarded(|| fit_friction(&(0..wraps.len()).map(reading).collect::<Vec<_>>()))??;
    let pair = |estimate: cdpr_statics::hysteresis::Estimate| [estimate.value, estimate.deviation];
    to_json(&json!({
        "coefficients": fit.coefficients.map(|both| both.map(pair)),
        "combination": fit.combination,
        "combined": pair(fit.combined),
        "noise": fit.noise,
        "singular_values": fit.singular_values,
    }))
}

/// A pose that stands alone.
pub(crate) fn single(pose: &Bound<PyAny>, robot: &cdpr_robot::Robot) -> Answer<Pose> {
    let poses = Rows::poses("pose", pose, robot)?;
    if poses.number() == 1 {
        Ok(poses.pose(0)?)
    } else {
        Err(Raised::Input(format!("pose has {} rows: expected one pose", poses.number())))
    }
}

/// The secant moduli of a record over ranges of load, and the energy of its loop, as JSON.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub(crate) fn modulus(
    record: Source,
    length: f64,
    section: f64,
    breaking_force: f64,
    ranges: Vec<(f64, f64)>,
    force_error: f64,
    elongation_error: f64,
    length_error: f64,
    section_error: f64,
) -> Answer<String> {
    let record = guarded(|| record.record())??;
    let specimen = Specimen {
        breaking_force,
        section,
        length,
        force_error,
        elongation_error,
        length_error,
        section_error,
    };
    let range = |(low, high): (f64, f64)| -> Answer<Value> {
        let of = |phase| record.modulus(&specimen, phase, low, high).map(moduli);
        let error = |error: cdpr_cable::RecordError| Raised::Input(error.to_string());
        Ok(json!({
            "range": format!("{low}-{high} %"),
            "loading": of(Phase::Loading).map_err(error)?,
            "unloading": of(Phase::Unloading).map_err(error)?,
        }))
    };
    to_json(&json!({
        "ranges": guarded(|| ranges.into_iter().map(range).collect::<Answer<Vec<_>>>())??,
        "dissipated": record.dissipated_energy(),
    }))
}

fn moduli(found: SecantModulus) -> Value {
    json!({ "modulus": found.modulus, "standard": found.standard, "greatest": found.greatest })
}

/// Mass per length of a weighed piece of cable, and its greatest error [kg/m].
#[pyfunction]
pub(crate) fn linear_density(
    mass: f64,
    length: f64,
    mass_error: f64,
    length_error: f64,
) -> Answer<(f64, f64)> {
    let mass = Measured { value: mass, error: mass_error };
    let length = Measured { value: length, error: length_error };
    let found = guarded(|| cdpr_cable::linear_density(mass, length))?;
    let found = found.map_err(|error| Raised::from(&error))?;
    Ok((found.value, found.error))
}
