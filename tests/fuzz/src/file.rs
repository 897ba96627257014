//! What must hold for a file, whatever its text.

use cdpr_cable::Phase;
use cdpr_robot::{Pose, Robot, Vector3};
use cdpr_statics::{
    DirectSolution, DirectStart, Equilibrium, InverseSolution, Load, Residual, direct, inverse,
};
use cdpr_study::{Study, read_record};
use serde_json::Value;
use std::path::Path;

/// More cables than this make a robot file slow to answer for, not wrong.
const MOST_CABLES: usize = 24;

/// A robot file is refused, or holds a robot that writes itself, and that the models answer for in numbers or
/// in words.
pub fn robot(text: &str) {
    let robot = match Robot::from_json(text) {
        Ok(robot) => robot,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    assert!(is_json(text), "accepted, but no JSON");
    assert_eq!(robot.validate(), Ok(()));
    let again = Robot::from_json(&robot.to_json());
    assert_eq!(again.as_ref(), Ok(&robot), "written and read again");
    let n = robot.cables.len();
    if n > MOST_CABLES {
        return;
    }
    let exits: Vector3<f64> = robot.cables.iter().map(|cable| cable.exit_point / n as f64).sum();
    let pose = Pose::at(exits.x, exits.y, exits.z);
    match inverse(&robot, &pose, &Load::none()) {
        Ok(InverseSolution { lengths, tensions, equilibrium, residual, .. }) => {
            finite("lengths", &lengths);
            finite("tensions", &tensions);
            finite_equilibrium(&equilibrium, &residual);
            assert_eq!((lengths.len(), tensions.len()), (n, n));
            match direct(&robot, &lengths, &Load::none(), DirectStart::Near(&equilibrium)) {
                Ok(DirectSolution { equilibrium, report, .. }) => {
                    finite_equilibrium(&equilibrium, &report.residual);
                }
                Err(error) => assert!(!error.to_string().is_empty()),
            }
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// A study file is refused, or holds a study whose parts are ready to run.
pub fn study(text: &str) {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies/fuzzed.json"));
    if !may_be_opened(text, path) {
        return;
    }
    match Study::from_json(text, path) {
        Ok(study) => {
            assert!(is_json(text), "accepted, but no JSON");
            let written = serde_json::to_string(&study.file).expect("a study file that can be written");
            let again = Study::from_json(&written, path).map(|again| again.file);
            assert_eq!(again.ok().as_ref(), Some(&study.file), "written and read again");
            for (name, spec) in &study.file.samplings {
                // That each of several poses is held is not checked before it runs.
                if spec.pose.is_some() {
                    let sampling = study.sampling(name).expect("a checked sampling");
                    assert!(sampling.nominal.magnitude().is_finite());
                }
            }
            for name in study.file.surfaces.keys() {
                let surface = study.surface(name).expect("a checked surface");
                finite("x", &surface.x.deviations);
                finite("y", &surface.y.deviations);
            }
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// A record is refused, or has laws whose tension grows with the strain, and moduli that are numbers.
pub fn record(text: &str) {
    let record = match read_record(text.as_bytes()) {
        Ok(record) => record,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    finite("dissipated energy", &[record.dissipated_energy()]);
    let (length, section) = (1.0, 1.2566370614e-5);
    for phase in [Phase::Loading, Phase::Unloading] {
        match record.moduli(phase, length, section) {
            Ok(pieces) => {
                assert!(pieces.iter().all(|piece| piece.modulus > 0.0), "{pieces:?}");
                assert!(pieces.windows(2).all(|pair| pair[0].tension < pair[1].tension), "{pieces:?}");
            }
            Err(error) => assert!(!error.to_string().is_empty()),
        }
    }
}

/// By another reading than that of the formats.
fn is_json(text: &str) -> bool {
    serde_json::from_str::<Value>(text).is_ok()
}

/// A study names the robot file to be read. Here, devices and pipes are not among them.
fn may_be_opened(text: &str, path: &Path) -> bool {
    // What is no JSON object, or names two robots, is refused before anything is opened.
    let Ok(Value::Object(entries)) = serde_json::from_str(text) else { return true };
    let Some(Value::String(robot)) = entries.get("robot") else { return true };
    let robot = path.with_file_name(robot);
    !robot.exists() || robot.is_file()
}

fn finite_equilibrium(equilibrium: &Equilibrium, residual: &Residual) {
    assert!(equilibrium.pose.is_finite(), "pose {:?}", equilibrium.pose);
    for force in &equilibrium.cable_forces {
        finite("cable force", force.as_slice());
    }
    finite("residual", &[residual.closure, residual.force, residual.moment]);
}

fn finite(what: &str, numbers: &[f64]) {
    assert!(numbers.iter().all(|number| number.is_finite()), "{what} is {numbers:?}");
}
