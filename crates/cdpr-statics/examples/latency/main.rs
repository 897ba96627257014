//! Times and iterations of the steps of a tracker along random smooth courses of the robots of the library.
//!
//! ```sh
//! cargo xtask latency
//! ```
//!
//! prints them as JSON, an object for each robot. The course is followed five times. What the machine does
//! interrupts no step in all of them, so that the least of its times is that of the computation.
//!
//! With `count FILE` the example makes the step of most iterations of each robot in such a list again, for
//! valgrind to count its instructions.

#![allow(clippy::print_stdout)]

mod course;

use cdpr_robot::library::{ROBOTS, named};
use cdpr_robot::{Pose, Robot, Vector3, Vector6, Wrench};
use cdpr_statics::{DirectStart, Equilibrium, Load, StaticsError, Tracker, direct};
use course::Course;
use serde_json::{Value, json};
use std::cmp::Ordering;
use std::collections::HashMap;
use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

/// The middle of the course of each robot [m].
const MIDDLES: [(&str, [f64; 3]); 20] = [
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
    ("four-cables", [0.5, 0.3, 2.0]),
    ("grab", [1.29, -0.11, 0.0]),
    ("hrpcables", [-0.03, 0.01, 0.72]),
    ("ipanema-1", [0.0, 0.0, 1.0]),
    ("ipanema-2", [-0.04, -0.06, 2.61]),
    ("ipanema-3", [-0.25, 0.17, 1.33]),
    ("irma4u", [0.11, 0.06, 1.31]),
    ("macarm", [1.17, 1.17, 1.17]),
    ("nist-robocrane", [0.0, 0.0, 1.5]),
    ("segesta", [0.0, 0.0, 0.5]),
];

/// Set-points of a course.
const POINTS: usize = 20_000;
/// Times that a course is followed.
const PASSES: usize = 5;
const SEED: u64 = 51;
/// A histogram has this number of bins for each power of ten, from 0.1 us on.
const BINS_PER_DECADE: f64 = 10.0;
/// Iterations that a step may take.
const MOST_ITERATIONS: usize = 12;

/// What is known of a step.
#[derive(Clone, Copy)]
struct Step {
    iterations: usize,
    converged: bool,
    slack: usize,
}

/// Cables whose tension at the platform is less than their own weight.
fn slack(robot: &Robot, lengths: &[f64], tracker: &Tracker<&Robot>) -> usize {
    let forces = &tracker.equilibrium().cable_forces;
    let weight = |i: usize| robot.cable(i).weight_per_length * lengths[i];
    (0..lengths.len()).filter(|&i| forces[i].norm() < weight(i)).count()
}

/// The equilibria of steps that do not converge, by the step; `None` where the search finds no equilibrium.
type Rests = HashMap<usize, Option<Equilibrium>>;

/// Follows a course. Where a step does not converge, the tracker goes on from the new equilibrium, searched
/// for outside of what is measured and kept for the next pass. Returns times [us], steps, and how often there
/// was no such equilibrium.
fn follow(
    robot: &Robot,
    course: &Course,
    steps: usize,
    rests: &mut Rests,
) -> Result<(Vec<f64>, Vec<Step>, usize), StaticsError> {
    let started = |k: usize| {
        let (pose, lengths) = course.point(k);
        let start = direct(robot, lengths, &course.load(k), DirectStart::Pose(pose))?;
        Tracker::new(robot, lengths, &course.load(k), &start.equilibrium)
    };
    let mut tracker = started(0)?;
    let (mut times, mut made, mut lost) = (Vec::with_capacity(steps), Vec::with_capacity(steps), 0);
    for k in 1..=steps {
        let ((_, lengths), load) = (course.point(k), course.load(k));
        let begin = Instant::now();
        let step = tracker.step(lengths, &load)?;
        times.push(1e6 * begin.elapsed().as_secs_f64());
        if !step.converged {
            let rest = rests.entry(k).or_insert_with(|| match tracker.update(lengths, &load) {
                Ok(_) => Some(tracker.equilibrium().clone()),
                Err(_) => started(k).ok().map(|other| other.equilibrium().clone()),
            });
            match rest {
                Some(rest) => tracker = Tracker::new(robot, lengths, &load, rest)?,
                None => lost += 1,
            }
        }
        let slack = slack(robot, lengths, &tracker);
        made.push(Step { iterations: step.iterations, converged: step.converged, slack });
    }
    Ok((times, made, lost))
}

/// Median, 99.99th and 99.999th percentile, and the greatest time [us].
fn quantiles(times: &[f64]) -> Value {
    let mut sorted = times.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = |share: f64| sorted[((share * sorted.len() as f64).ceil() as usize).clamp(1, sorted.len()) - 1];
    json!({ "median": at(0.5), "p99.99": at(0.9999), "p99.999": at(0.99999), "greatest": at(1.0) })
}

/// Number of steps by time, ten bins for each power of ten from 0.1 us on.
fn histogram(times: &[f64]) -> Vec<usize> {
    let mut counts = Vec::new();
    for time in times {
        let bin = (BINS_PER_DECADE * (time / 0.1).log10()).floor().max(0.0) as usize;
        counts.resize(counts.len().max(bin + 1), 0);
        counts[bin] += 1;
    }
    counts
}

/// The step that took longest, and why.
fn worst(times: &[f64], passes: &[Vec<f64>], steps: &[Step]) -> Value {
    let longest =
        |times: &[f64]| (0..times.len()).max_by(|&a, &b| times[a].total_cmp(&times[b])).unwrap_or(0);
    let (k, interrupted) = (longest(times), longest(&passes[0]));
    let Step { iterations, converged, slack } = steps[k];
    let again: Vec<f64> = passes.iter().map(|pass| pass[interrupted]).collect();
    json!({
        "step": k + 1, "us": times[k], "iterations": iterations, "converged": converged,
        "slack_cables": slack,
        "of_first_pass": { "step": interrupted + 1, "us_in_each_pass": again },
    })
}

/// The step of most iterations, the longest of them: what is needed to make it again.
fn most_work(course: &Course, times: &[f64], steps: &[Step]) -> Value {
    let work = |k: usize| (steps[k - 1].iterations, times[k - 1]);
    let most = (1..=steps.len()).max_by(|&a, &b| work(a).partial_cmp(&work(b)).unwrap_or(Ordering::Equal));
    let at = |k: usize| {
        let ((pose, lengths), load) = (course.point(k), course.load(k));
        let wrench = load.wrench.to_vector();
        json!({
            "position": pose.position.as_slice(), "quaternion": pose.quaternion(), "lengths": lengths,
            "payload": load.payload, "wrench": wrench.as_slice(),
        })
    };
    let k = most.unwrap_or(1);
    json!({ "step": k, "iterations": steps[k - 1].iterations, "before": at(k - 1), "after": at(k) })
}

/// The same call everywhere, so that valgrind knows where to count.
#[inline(never)]
fn counted<T>(call: impl FnOnce() -> T) -> T {
    call()
}

/// Makes a step of [`most_work`] again. Returns its iterations.
fn again(robot: &Robot, step: &Value) -> Result<usize, Box<dyn Error>> {
    let numbers = |value: &Value| -> Vec<f64> {
        value.as_array().into_iter().flatten().filter_map(Value::as_f64).collect()
    };
    let given = |at: &Value| -> Result<(Pose, Vec<f64>, Load), Box<dyn Error>> {
        let position = Vector3::from_iterator(numbers(&at["position"]));
        let quaternion = numbers(&at["quaternion"]).try_into().map_err(|_| "expected a quaternion")?;
        let wrench = Wrench::from_vector(&Vector6::from_iterator(numbers(&at["wrench"])));
        let payload = at["payload"].as_f64().ok_or("expected a payload")?;
        let pose = Pose::with_quaternion(position, quaternion).ok_or("expected a rotation")?;
        Ok((pose, numbers(&at["lengths"]), Load { payload, wrench }))
    };
    let ((pose, lengths, load), (_, lengths_after, load_after)) =
        (given(&step["before"])?, given(&step["after"])?);
    let start = direct(robot, &lengths, &load, DirectStart::Pose(&pose))?.equilibrium;
    let mut tracker = Tracker::new(robot, &lengths, &load, &start)?;
    Ok(counted(|| black_box(tracker.step(&lengths_after, &load_after)))?.iterations)
}

/// Prints the iterations of the steps that are made again, one for each robot of a file that has one.
fn count(file: &str) -> Result<(), Box<dyn Error>> {
    let data: Value = serde_json::from_str(&std::fs::read_to_string(file)?)?;
    for of in data["robots"].as_array().into_iter().flatten().filter(|robot| robot["error"].is_null()) {
        let name = of["robot"].as_str().unwrap_or_default();
        let robot = Robot::from_json(named(ROBOTS, name).ok_or("a robot of the library")?.text)?;
        println!("{}", json!({ "robot": name, "iterations": again(&robot, &of["most_work"])? }));
    }
    Ok(())
}

fn measured(name: &str, middle: [f64; 3], steps: usize) -> Result<Value, Box<dyn Error>> {
    let robot = Robot::from_json(named(ROBOTS, name).ok_or("a robot of the library")?.text)?;
    let course = Course::new(&robot, middle.into(), POINTS.min(steps), SEED)?;
    let (mut passes, mut made, mut lost, mut rests) = (Vec::new(), Vec::new(), 0, Rests::new());
    for _ in 0..PASSES {
        let times;
        (times, made, lost) = follow(&robot, &course, steps, &mut rests)?;
        passes.push(times);
    }
    let least = |k: usize| passes.iter().map(|pass| pass[k]).fold(f64::INFINITY, f64::min);
    let times: Vec<f64> = (0..steps).map(least).collect();
    let by_iterations: Vec<usize> =
        (0..=MOST_ITERATIONS).map(|n| made.iter().filter(|step| step.iterations == n).count()).collect();
    Ok(json!({
        "robot": name,
        "cables": robot.cables.len(),
        "plain": robot.has_plain_cables(),
        "steps": steps,
        "profile": if cfg!(debug_assertions) { "dev" } else { "release" },
        "us": quantiles(&times),
        "us_of_first_pass": quantiles(&passes[0]),
        "steps_by_iterations": by_iterations,
        "not_converged": made.iter().filter(|step| !step.converged).count(),
        "without_equilibrium": lost,
        "with_slack_cables": made.iter().filter(|step| step.slack > 0).count(),
        "most_work": most_work(&course, &times, &made),
        "worst": worst(&times, &passes, &made),
        "histogram": histogram(&times),
        "histogram_of_first_pass": histogram(&passes[0]),
    }))
}

/// The row of a robot; one that a tracker does not take, or without a course, has the reason.
fn row(name: &str, steps: usize) -> Value {
    let Some((_, middle)) = MIDDLES.iter().find(|(robot, _)| *robot == name) else {
        return json!({ "robot": name, "error": "the middle of its course is not known" });
    };
    measured(name, *middle, steps)
        .unwrap_or_else(|error| json!({ "robot": name, "error": error.to_string() }))
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1).peekable();
    if arguments.next_if_eq("count").is_some() {
        return count(&arguments.next().ok_or("expected `count FILE`")?);
    }
    let steps = arguments.next().map_or(Ok(1_000_000), |steps| steps.parse())?;
    if steps == 0 {
        return Err("expected one step at least".into());
    }
    let chosen: Vec<String> = arguments.collect();
    for robot in
        ROBOTS.iter().filter(|robot| chosen.is_empty() || chosen.iter().any(|name| name == robot.name))
    {
        println!("{}", row(robot.name, steps));
    }
    Ok(())
}
