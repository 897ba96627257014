//! The problems that `cargo xtask bench-peers` gives to other solvers, with this crate's own answers and
//! times, as JSON.
//!
//! `peer_problem FILE` writes
//!
//! ```text
//! gravity, section     shared numbers [m/s²], [m²]
//! parameters           nominal value of every uncertain parameter, in the order of `Parameter::of`
//! position             wanted position of P [m]; the wanted rotation is the identity
//! payload              mass added at the centre of mass [kg]
//! lengths, forces      direct problem: unstrained lengths [m]; (fx, fz) of every cable [N] at the start, where the
//!                      platform rests at `position` without the payload
//! deviations           observations: what is added to `parameters`, one row each
//! repeats              how often to solve, for a median time
//! cdpr                 direct_us, direct_position [m], observation_us, displacements [m]: solves one after the
//!                      other by `Tracker`, observations in batches by `Observer`
//! cdpr_alone           the same, each solve and observation alone
//! ```

use cdpr_robot::{Parameter, Pose, Robot};
use cdpr_statics::{Load, Observer, Start, Tracker, deflection, direct, inverse};
use serde_json::json;
use std::hint::black_box;
use std::time::Instant;

type Error = Box<dyn std::error::Error>;

const PAYLOAD: f64 = 50.0;
const OBSERVATIONS: usize = 5;
/// How often the observations are repeated in a batch.
const BATCH: usize = 50;
const SEED: u64 = 2017;
/// Solves of this crate for a median, and of a peer: one of its solves takes up to a second.
const REPEATS: usize = 3000;
const PEER_REPEATS: usize = 9;

fn main() -> Result<(), Error> {
    let path = std::env::args().nth(1).ok_or("usage: peer_problem FILE")?;
    let robot = Robot::from_json(include_str!("../../../data/robots/caroca.json"))?;
    let pose = Pose::at(0.0, 0.0, 1.75);
    let load = Load::payload(PAYLOAD);
    let parameters = Parameter::of(&robot);

    let wanted = inverse(&robot, &pose, &Load::none(), None)?;
    let start = &wanted.equilibrium;
    let solve = || direct(black_box(&robot), black_box(&wanted.lengths), &load, Start::Near(start));
    let loaded = solve()?;
    let direct_us = median((0..REPEATS).map(|_| microseconds(solve)).collect());
    // The tracker begins where the platform rests without the payload; every second solve takes it back
    // there.
    let mut tracker = Tracker::new(&robot, &wanted.lengths, &Load::none(), start)?;
    let mut tracked = Vec::new();
    for _ in 0..REPEATS {
        tracked.push(microseconds(|| tracker.update(black_box(&wanted.lengths), &load).is_ok()));
        tracker.update(&wanted.lengths, &Load::none())?;
    }
    let tracked_position = tracker.update(&wanted.lengths, &load)?.pose.position;

    let mut random = SplitMix(SEED);
    let deviations: Vec<Vec<f64>> = (0..OBSERVATIONS)
        .map(|_| parameters.iter().map(|parameter| half_range(parameter) * random.symmetric()).collect())
        .collect();
    let (mut displacements, mut times) = (Vec::new(), Vec::new());
    for deviation in &deviations {
        let observe = || -> Result<[f64; 3], Error> {
            let perturbed = robot.perturbed(black_box(deviation))?;
            let deflection = deflection(&perturbed.robot, &pose, &perturbed.tension_offsets, &load)?;
            Ok(deflection.displacement().into())
        };
        // The peers take tensions without bounds: none may be active.
        let held = inverse(&robot.perturbed(deviation)?.robot, &pose, &Load::none(), None)?;
        if held.active.iter().any(Option::is_some) || held.iterations != 1 {
            return Err("an observation has a tension on its bound: choose another seed".into());
        }
        displacements.push(observe()?);
        times.extend((0..REPEATS).map(|_| microseconds(observe)));
    }

    let observer = Observer::new(&robot, &pose, &load)?;
    let batch = deviations.concat().repeat(BATCH);
    let together = || observer.observe_all(black_box(&batch));
    let batch_us: Vec<f64> = (0..REPEATS).map(|_| microseconds(together)).collect();
    let observed = together().into_iter().take(OBSERVATIONS);
    let observed: Vec<[f64; 3]> =
        observed.map(|found| Ok(found?.displacement.into())).collect::<Result<_, Error>>()?;

    let answer = |solver: &str, direct: (f64, &[f64]), observation: (f64, &Vec<[f64; 3]>)| {
        json!({
            "version": env!("CARGO_PKG_VERSION"),
            "solver": solver,
            "direct_us": direct.0,
            "direct_position": direct.1,
            "observation_us": observation.0,
            "displacements": observation.1,
        })
    };
    let problem = json!({
        "gravity": robot.gravity.magnitude(),
        "section": robot.cables[0].properties.section,
        "parameters": parameters.iter().map(|parameter| parameter.nominal(&robot)).collect::<Vec<_>>(),
        "position": pose.position.as_slice(),
        "payload": PAYLOAD,
        "lengths": wanted.lengths,
        "forces": start.cable_forces.iter().map(|f| [f.x, f.y]).collect::<Vec<_>>(),
        "deviations": deviations,
        "repeats": PEER_REPEATS,
        "cdpr": answer(
            "Tracker, Observer",
            (median(tracked), tracked_position.as_slice()),
            (median(batch_us) / (BATCH * OBSERVATIONS) as f64, &observed),
        ),
        "cdpr_alone": answer(
            "direct, deflection",
            (direct_us, loaded.equilibrium.pose.position.as_slice()),
            (median(times), &displacements),
        ),
    });
    std::fs::write(path, format!("{problem:#}\n"))?;
    Ok(())
}

/// Half of the range of Table 3 of Baklouti, Caro, Courteille (CableCon 2017); for the centre of mass that of
/// the anchors.
fn half_range(parameter: &Parameter) -> f64 {
    match parameter {
        Parameter::Mass => 18.0,
        Parameter::LinearDensity => 0.01015,
        Parameter::YoungsModulus => 1.8e10,
        Parameter::AnchorPoint(..) | Parameter::CenterOfMass(_) => 0.015,
        Parameter::ExitPoint(..) => 0.03,
        Parameter::TensionOffset(_) => 15.0,
        _ => 0.0,
    }
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
