//! The Pareto front of two objectives.
//!
//! With both signed so that less is better, the ends are the best robots by either one. Between their values
//! `ε_0` and `ε_n` of the second objective, equal steps bound it, and the first one is made as good as
//! possible,
//!
//! ```text
//! minimize  f(x)    subject to    g(x) <= ε_k,      k = 1 .. n - 1                              (Q6)
//! ```
//!
//! (Y. Y. Haimes, L. S. Lasdon, D. A. Wismer, IEEE Trans. Systems, Man, Cybernetics 1, 1971). Fronts that are
//! not convex are found, too. The multiplier μ of the bound is the rate of exchange, `df/dε = -μ`. Where
//! nothing has bounds, every configuration is evaluated, and the front is that of all of them.

use crate::design::cables::{ChosenCable, left_laws};
use crate::design::file::Over;
use crate::design::goal::{Goal, sense};
use crate::design::position::BASIS;
use crate::design::problem::DesignProblem;
use crate::design::search::{Found, objective};
use crate::design::starts::Searched;
use crate::error::AssessError;
use cdpr_robot::Robot;
use cdpr_study::StudyError;
use serde::Serialize;

/// Robots of which none is better in both of two objectives.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Front {
    /// Both outputs.
    pub outputs: [Goal; 2],
    /// Over the poses.
    pub over: [Over; 2],
    /// What tables call both objectives, with their units.
    pub names: [String; 2],
    /// What a position error is and assumes, where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub basis: Option<&'static str>,
    /// What becomes of measured laws of the cables where types are chosen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_laws: Option<String>,
    /// Number of poses.
    pub poses: usize,
    /// Combinations of the choices, all of them evaluated; 1 without choices.
    pub configurations: usize,
    /// Starts of the local search in each of them for each point; 0 where nothing has bounds.
    pub starts: usize,
    /// Evaluations of a robot at all poses.
    pub evaluations: usize,
    /// Robots that were left out: another one is as good in both objectives, or better.
    pub dominated: usize,
    /// Bounds (Q6) for which no search led to a robot that counts.
    pub lost: usize,
    /// Why the front has no point; `None` where it has points.
    pub reason: Option<String>,
    /// Names of the variables, and their SI units.
    pub variables: Vec<(String, &'static str)>,
    /// The front, from the best first objective to the best second one.
    pub points: Vec<FrontPoint>,
}

/// A robot of a front.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FrontPoint {
    /// Both objectives, in the units of their outputs.
    pub objectives: [f64; 2],
    /// Values of the variables.
    pub variables: Vec<f64>,
    /// The type of cable of each group, where types are chosen.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub cables: Vec<ChosenCable>,
    /// By how much the first objective changes along the front for each unit of the second one; `None` at the
    /// ends, and where nothing has bounds.
    pub exchange: Option<f64>,
    /// Residual of the optimality conditions, as that of a design.
    pub kkt_residual: Option<f64>,
    /// Error of derivatives by differences in it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gradient_error: Option<f64>,
    /// Whether it is small enough for a local optimum; true where nothing has bounds.
    pub optimal: bool,
    /// The robot.
    #[serde(skip)]
    pub robot: Robot,
}

/// Objectives whose relative difference is below this are equal.
const SAME: f64 = 1e-6;

/// Finds the Pareto front of both objectives of a problem.
///
/// The result does not depend on the number of threads.
///
/// # Errors
/// [`AssessError::Study`] for a problem without a second objective, and for more variables than Sobol's
/// sequence has dimensions.
pub fn front(problem: &DesignProblem) -> Result<Front, AssessError> {
    let Some((second, over)) = problem.second else {
        let expected = "a second objective, such as {\"output\": \"stiffness\", \"over\": \"worst\"}";
        return Err(StudyError::setting("pareto", "missing", expected).into());
    };
    let first = Searched::of(problem, &[])?;
    let mut front = Front {
        outputs: [problem.output, second],
        over: [problem.over, over],
        names: [name(problem.output, problem.over), name(second, over)],
        basis: problem.needs(Goal::Position).then_some(BASIS),
        left_laws: left_laws(&problem.types, &problem.variables, &problem.robot),
        poses: problem.poses.len(),
        configurations: first.found.len() / first.each,
        starts: first.starts,
        evaluations: first.evaluations,
        dominated: 0,
        lost: 0,
        reason: first.best().is_none().then(|| first.reason(problem, 0)),
        variables: problem
            .of_parameters()
            .map(|(_, one)| (one.name.clone(), one.parameters[0].0.unit()))
            .collect(),
        points: Vec::new(),
    };
    if first.starts == 0 {
        let points = first.feasible().filter_map(|(_, found)| front.point(problem, found, None));
        front.points = points.collect();
    } else if let Some((_, best)) = first.best() {
        front.between(problem, best.clone())?;
    }
    front.keep_best();
    Ok(front)
}

/// Name of an output over the poses.
fn name(output: Goal, over: Over) -> String {
    let name = output.name();
    match over {
        _ if output.is_of_all_poses() => name.to_owned(),
        Over::Mean => format!("mean_{name}"),
        Over::Worst => format!("worst_{name}"),
    }
}

impl Front {
    /// Adds both ends and the points (Q6) between them.
    fn between(&mut self, problem: &DesignProblem, best: Found) -> Result<(), AssessError> {
        let swapped = DesignProblem {
            output: self.outputs[1],
            over: self.over[1],
            second: Some((self.outputs[0], self.over[0])),
            ..problem.clone()
        };
        let other = Searched::of(&swapped, std::slice::from_ref(&best.values))?;
        self.evaluations += other.evaluations;
        let Some(start) = self.point(problem, &best, None) else { return Ok(()) };
        let mut from = best.values;
        let end = other.best().and_then(|(_, other)| self.point(problem, other, None));
        let [low, high] = [&start, end.as_ref().unwrap_or(&start)].map(|point| point.objectives[1]);
        self.points.push(start);
        let other = other.best().map_or_else(Vec::new, |(_, other)| vec![other.values.clone()]);
        for k in 1..problem.points.saturating_sub(1) {
            if (high - low).abs() <= SAME * low.abs() {
                break;
            }
            let bound = low + (high - low) * k as f64 / (problem.points - 1) as f64;
            let bounded = DesignProblem { bound: Some(bound), ..problem.clone() };
            let searched = Searched::of(&bounded, &[&other[..], &[from.clone()]].concat())?;
            self.evaluations += searched.evaluations;
            match searched.best() {
                Some((_, best)) => {
                    from.clone_from(&best.values);
                    self.points.extend(self.point(&bounded, best, Some(bound)));
                }
                None => self.lost += 1,
            }
        }
        self.points.extend(end);
        Ok(())
    }

    /// The point of a robot that was found.
    fn point(&self, problem: &DesignProblem, found: &Found, bound: Option<f64>) -> Option<FrontPoint> {
        let at = problem.evaluate(&found.values, None).ok()?;
        let sign = self.outputs.map(sense);
        let value = |i: usize, of| sign[i] * objective(self.over[i], of, sign[i]);
        let objectives = [value(0, &at.outputs), value(1, &at.seconds)];
        // The bound is the last of the excesses, in parts of its value.
        let first = problem.excesses_before_bound();
        let lengths: Vec<f64> = at.longest.iter().map(|length| length.value).collect();
        let multiplier = found.active.iter().filter(|(k, _)| *k >= first).map(|(_, mu)| mu).sum::<f64>();
        let has_bounds = problem.bounded().next().is_some();
        Some(FrontPoint {
            objectives,
            variables: problem.of_parameters().map(|(j, _)| found.values[j]).collect(),
            cables: problem.chosen(&found.values, &lengths),
            exchange: bound.map(|bound| -sign[0] * sign[1] * multiplier / bound.abs()),
            kkt_residual: has_bounds.then_some(found.residual),
            gradient_error: found.gradient_error,
            optimal: found.is_optimal(),
            robot: problem.robot_at(&found.values).ok()?,
        })
    }

    /// Leaves out what another point dominates, and all but one of equal points.
    fn keep_best(&mut self) {
        let sign = self.outputs.map(sense);
        let all = self.points.len();
        let mut points = std::mem::take(&mut self.points);
        points.sort_by(|a, b| {
            let by = |i: usize| (sign[i] * a.objectives[i]).total_cmp(&(sign[i] * b.objectives[i]));
            by(0).then(by(1))
        });
        // In ascending order of the first objective a point counts if the second one is better than before.
        for point in points {
            let value = sign[1] * point.objectives[1];
            let is_better = |last: &FrontPoint| {
                let before = sign[1] * last.objectives[1];
                value < before - SAME * before.abs()
            };
            if self.points.last().is_none_or(is_better) {
                self.points.push(point);
            }
        }
        self.dominated = all - self.points.len();
    }
}
