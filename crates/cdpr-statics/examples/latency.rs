//! Times of a step of the tracker, along a smooth path of each robot of the library with a load that changes.
//!
//! ```sh
//! cargo run --release -p cdpr-statics --example latency [STEPS]
//! ```
//!
//! A row for each robot: median, 99.99th percentile and greatest time, iterations at most, and steps that did
//! not converge. What else the machine does is in the times.

#![allow(clippy::print_stdout)]

use cdpr_robot::library::{ROBOTS, named};
use cdpr_robot::{Pose, Robot, Vector3};
use cdpr_statics::{InversePath, Load, StaticsError, Tracker};
use std::error::Error;
use std::time::Instant;

/// Robots, and the middle of the path of each [m].
const PATHS: [(&str, [f64; 3]); 17] = [
    ("acrobot", [0.57, 0.57, 0.9]),
    ("cable-robot-simulator", [5.93, 7.64, 4.3]),
    ("caroca", [0.0, 0.0, 1.75]),
    ("caroca-law", [0.0, 0.0, 1.75]),
    ("cogiro", [0.03, -0.03, 1.67]),
    ("copacabana-handling", [-0.09, 0.3, 1.18]),
    ("copacabana-inspection", [0.34, 0.21, 1.44]),
    ("expo2015-lucia", [-0.53, -0.02, 5.43]),
    ("expo2015-roberto", [0.43, -0.07, 5.43]),
    ("fast", [0.0, 0.0, 140.1]),
    ("hrpcables", [-0.03, 0.01, 0.72]),
    ("ipanema-1", [0.0, 0.0, 1.0]),
    ("ipanema-2", [-0.04, -0.06, 2.61]),
    ("ipanema-3", [-0.25, 0.17, 1.33]),
    ("macarm", [1.17, 1.17, 1.17]),
    ("nist-robocrane", [0.0, 0.0, 1.5]),
    ("segesta", [0.0, 0.0, 0.5]),
];

/// Set-points of a path, which is closed.
const POINTS: usize = 2000;

/// Half the width of a path, relative to the largest distance of an exit point from its middle.
const WIDTH: f64 = 0.02;

/// Lengths [m] and load of each set-point.
fn set_points(robot: &Robot, middle: [f64; 3]) -> Result<Vec<(Vec<f64>, Load)>, StaticsError> {
    let middle = Vector3::from(middle);
    let far = robot.cables.iter().map(|cable| (cable.exit_point - middle).norm()).fold(0.0, f64::max);
    let mut path = InversePath::new(robot);
    let at = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / POINTS as f64;
        let moved = WIDTH * far * Vector3::new(angle.cos(), angle.sin(), (2.0 * angle).sin());
        let pose = Pose { position: middle, ..Pose::at(0.0, 0.0, 0.0) }.moved(moved, Vector3::zeros());
        let lengths = path.solve(pose, &Load::none())?.solution.lengths;
        Ok((lengths, Load::payload(0.05 * robot.platform.mass * (1.0 + (3.0 * angle).sin()))))
    };
    (0..POINTS).map(at).collect()
}

fn row(name: &str, middle: [f64; 3], steps: usize) -> Result<String, Box<dyn Error>> {
    let robot = Robot::from_json(named(ROBOTS, name).ok_or("a robot of the library")?.text)?;
    let points = set_points(&robot, middle)?;
    let (lengths, load) = &points[0];
    let start = cdpr_statics::direct(
        &robot,
        lengths,
        load,
        cdpr_statics::DirectStart::Pose(&Pose { position: middle.into(), ..Pose::at(0.0, 0.0, 0.0) }),
    )?;
    let mut tracker = Tracker::new(&robot, lengths, load, &start.equilibrium)?;
    let (mut times, mut iterations, mut kept) = (Vec::with_capacity(steps), 0, 0);
    for (lengths, load) in points.iter().cycle().take(steps) {
        let begin = Instant::now();
        let step = tracker.step(lengths, load)?;
        times.push(1e6 * begin.elapsed().as_secs_f64());
        iterations = iterations.max(step.iterations);
        kept += usize::from(!step.converged);
    }
    times.sort_by(f64::total_cmp);
    let at = |share: f64| times[((share * steps as f64) as usize).min(steps - 1)];
    let cables = robot.cables.len();
    Ok(format!(
        "| {name} | {cables} | {:.2} | {:.1} | {:.1} | {iterations} | {kept} |",
        at(0.5),
        at(0.9999),
        at(1.0)
    ))
}

fn main() -> Result<(), Box<dyn Error>> {
    let steps = std::env::args().nth(1).map_or(Ok(20_000), |steps| steps.parse())?;
    if steps == 0 {
        return Err("expected one step at least".into());
    }
    println!("| robot | cables | median [us] | 99.99 % [us] | greatest [us] | iterations | not converged |");
    println!("|---|---|---|---|---|---|---|");
    for (name, middle) in PATHS {
        println!("{}", row(name, middle, steps).unwrap_or_else(|error| format!("| {name} | {error} |")));
    }
    Ok(())
}
