//! The problems that `peers/run direct` gives to other solvers, with this crate's own answers and
//! times, as JSON.
//!
//! `peer_problem FILE` writes `repeats`, how often to solve for a median time, and `cases`, a list of
//!
//! ```text
//! name                 robot and pose, of data/benchmarks/throughput.json
//! gravity, section     shared numbers [m/s²], [m²]
//! parameters           nominal value of every uncertain parameter, in the order of `Parameter::of`
//! position             wanted position of P [m]; the wanted rotation is the identity
//! payload              mass added at the centre of mass [kg]
//! least, greatest      inverse model: limits of every cable's tension at the platform [N]
//! lengths, forces      direct problem: unstrained lengths [m]; (fx, fz) of every cable [N] at the start, where
//!                      the platform rests at `position` without the payload
//! deviations           observations: what is added to `parameters`, one row each
//! at_limits            tensions on a limit, in the nominal robot and in each row
//! cdpr                 direct_us, direct_position [m], inverse_us, tensions [N], observation_us,
//!                      displacements [m]: solves one after the other by `Tracker`, observations in batches
//!                      by `Observer`, `inverse` alone
//! cdpr_alone           each direct solve and observation alone; inverse_us and tensions are null
//! ```

use cdpr_robot::{CableEnd, Deviations, Parameter, Pose, Robot};
use cdpr_statics::batch::Observation;
use cdpr_statics::{
    DirectStart, InverseSolution, Load, Observer, Tracker, WantedPose, deflection, direct, inverse,
};
use serde_json::{Value, json};
use std::hint::black_box;
use std::time::Instant;

type Error = Box<dyn std::error::Error>;

/// Name and pose of the cases in data/benchmarks/throughput.json.
const CASES: [(&str, usize); 4] =
    [("CAROCA, symmetric pose", 0), ("Stadium of 100 m", 0), ("FAST", 0), ("IPAnema, active limits", POSE)];
const POSE: usize = 1;
const OBSERVATIONS: usize = 5;
/// How often the observations are repeated in a batch.
const BATCH: usize = 50;
const SEED: u64 = 2017;
/// Solves of this crate for a median, and of a peer: one of its solves takes up to a second.
const REPEATS: usize = 3000;
const PEER_REPEATS: usize = 3;

fn main() -> Result<(), Error> {
    let path = std::env::args().nth(1).ok_or("usage: peer_problem FILE")?;
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data");
    let list: Value =
        serde_json::from_str(&std::fs::read_to_string(format!("{data}/benchmarks/throughput.json"))?)?;
    let mut cases = Vec::new();
    for (name, pose) in CASES {
        let listed = list["cases"].as_array().and_then(|all| all.iter().find(|case| case["name"] == name));
        let listed = listed.ok_or_else(|| format!("throughput.json has no case {name}"))?;
        let file = listed["robot"].as_str().ok_or("a case has no robot")?;
        let robot = Robot::from_json(&std::fs::read_to_string(format!("{data}/{file}"))?)?;
        cases.push(case(&robot, listed, pose)?);
    }
    std::fs::write(path, format!("{:#}\n", json!({ "repeats": PEER_REPEATS, "cases": cases })))?;
    Ok(())
}

/// The problems of a robot at one of its poses, with our answers.
fn case(robot: &Robot, listed: &Value, pose: usize) -> Result<Value, Error> {
    let payload = listed["payload"].as_f64().ok_or("a case has no payload")?;
    let position: [f64; 3] = serde_json::from_value(listed["poses"][pose]["position"].clone())?;
    let (pose, load) = (Pose::at(position[0], position[1], position[2]), Load::payload(payload));
    let parameters = Parameter::of(robot);
    let cables = 0..robot.cables.len();
    if robot.reference().iter().any(|tension| *tension != 0.0)
        || cables.clone().any(|i| robot.max_at(i) != CableEnd::Anchor)
    {
        return Err("the peers know limits at the platform alone, and least-norm tensions".into());
    }

    let hold = || inverse(black_box(robot), &pose, &Load::none());
    let wanted = hold()?;
    let inverse_us = median((0..REPEATS).map(|_| microseconds(hold)).collect());
    let start = &wanted.equilibrium;
    let solve = || direct(black_box(robot), black_box(&wanted.lengths), &load, DirectStart::Near(start));
    let loaded = solve()?;
    let direct_us = median((0..REPEATS).map(|_| microseconds(solve)).collect());
    // The tracker begins where the platform rests without the payload; every second solve takes it back
    // there.
    let mut tracker = Tracker::new(robot, &wanted.lengths, &Load::none(), start)?;
    let mut tracked = Vec::new();
    for _ in 0..REPEATS {
        tracked.push(microseconds(|| tracker.update(black_box(&wanted.lengths), &load).is_ok()));
        tracker.update(&wanted.lengths, &Load::none())?;
    }
    let tracked_position = tracker.update(&wanted.lengths, &load)?.pose.position;

    let (deviations, alone) = observed_alone(robot, listed, &pose, &load)?;
    let mut at_limits = vec![on_limits(&wanted, robot)?];
    at_limits.extend(alone.at_limits);

    let observer = Observer::new(robot, pose, &load)?;
    let layout = observer.layout();
    let batch = Deviations::new(layout, parameters.len(), deviations.concat().repeat(BATCH))?;
    let together = || observer.observe::<Observation>(black_box(&batch));
    let batch_us: Vec<f64> = (0..REPEATS / 10).map(|_| microseconds(together)).collect();
    let observed = together().into_iter().take(OBSERVATIONS);
    let observed: Vec<[f64; 3]> =
        observed.map(|found| Ok(found?.displacement.into())).collect::<Result<_, Error>>()?;

    Ok(json!({
        "name": listed["name"],
        "gravity": robot.gravity.magnitude(),
        "section": robot.cables[0].properties.section,
        "parameters": parameters.iter().map(|parameter| parameter.nominal(robot)).collect::<Vec<_>>(),
        "position": position,
        "payload": payload,
        "least": cables.clone().map(|i| robot.limits(i).min).collect::<Vec<_>>(),
        "greatest": cables.map(|i| robot.limits(i).max).collect::<Vec<_>>(),
        "lengths": wanted.lengths,
        "forces": start.cable_forces.iter().map(|f| [f.x, f.y]).collect::<Vec<_>>(),
        "deviations": deviations,
        "at_limits": at_limits,
        "cdpr": {
            "version": env!("CARGO_PKG_VERSION"),
            "solver": "Tracker, inverse, Observer",
            "direct_us": median(tracked),
            "direct_position": tracked_position.as_slice(),
            "inverse_us": inverse_us,
            "tensions": wanted.tensions,
            "observation_us": median(batch_us) / (BATCH * OBSERVATIONS) as f64,
            "displacements": observed,
        },
        "cdpr_alone": {
            "version": env!("CARGO_PKG_VERSION"),
            "solver": "direct, deflection",
            "direct_us": direct_us,
            "direct_position": loaded.equilibrium.pose.position.as_slice(),
            "inverse_us": null,
            "tensions": null,
            "observation_us": median(alone.times),
            "displacements": alone.displacements,
        },
    }))
}

/// Observations one after the other.
struct Alone {
    displacements: Vec<[f64; 3]>,
    /// [us]
    times: Vec<f64>,
    /// Tensions on a limit in each row.
    at_limits: Vec<usize>,
}

/// Deviations, and the robots that have them observed alone.
fn observed_alone(
    robot: &Robot,
    listed: &Value,
    pose: &Pose,
    load: &Load,
) -> Result<(Vec<Vec<f64>>, Alone), Error> {
    let mut random = SplitMix(SEED);
    let half_ranges: Vec<f64> =
        Parameter::of(robot).iter().map(|parameter| half_range(&listed["errors"], parameter)).collect();
    let deviations: Vec<Vec<f64>> = (0..OBSERVATIONS)
        .map(|_| half_ranges.iter().map(|half| half * random.symmetric()).collect())
        .collect();
    let (mut displacements, mut times, mut at_limits) = (Vec::new(), Vec::new(), Vec::new());
    for deviation in &deviations {
        let observe = || -> Result<[f64; 3], Error> {
            let perturbed = robot.perturbed(black_box(deviation))?;
            let deflection = deflection(
                &perturbed.robot,
                WantedPose::at(pose).tension_offsets(&perturbed.tension_offsets),
                load,
            )?;
            Ok(deflection.displacement().into())
        };
        let held = inverse(&robot.perturbed(deviation)?.robot, pose, &Load::none())?;
        at_limits.push(on_limits(&held, robot)?);
        displacements.push(observe()?);
        times.extend((0..REPEATS).map(|_| microseconds(observe)));
    }
    Ok((deviations, Alone { displacements, times, at_limits }))
}

/// Number of tensions on a limit. What a cable's own weight demands is no limit to the peers.
fn on_limits(held: &InverseSolution, robot: &Robot) -> Result<usize, Error> {
    let on = |i: usize| {
        let (limits, tension) = (robot.limits(i), held.tensions[i]);
        (tension - limits.min).abs().min((tension - limits.max).abs()) <= 1e-9 * tension
    };
    let active: Vec<usize> = (0..held.active.len()).filter(|i| held.active[*i].is_some()).collect();
    match active.iter().find(|i| !on(**i)) {
        Some(i) => Err(format!("{}: cable {i} rests on its own weight", robot.name).into()),
        None => Ok(active.len()),
    }
}

/// Half of the range of a parameter, of throughput.json.
fn half_range(errors: &Value, parameter: &Parameter) -> f64 {
    let group = match parameter {
        Parameter::Mass => "mass",
        Parameter::LinearDensity => "linear_density",
        Parameter::YoungsModulus => "youngs_modulus",
        Parameter::AnchorPoint(..) => "a",
        Parameter::ExitPoint(..) => "b",
        Parameter::CenterOfMass(_) => "cog",
        Parameter::TensionOffset(_) => "dt",
        _ => return 0.0,
    };
    errors[group].as_f64().unwrap_or(0.0)
}

fn microseconds<T>(solve: impl FnOnce() -> T) -> f64 {
    let begin = Instant::now();
    black_box(solve());
    1e6 * begin.elapsed().as_secs_f64()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Steele, Lea, Flood, *Fast splittable pseudorandom number generators* (OOPSLA 2014): the same numbers
/// everywhere.
struct SplitMix(u64);

impl SplitMix {
    /// Uniform in [-1, 1).
    fn symmetric(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}
