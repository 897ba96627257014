//! Every combination of the choices, and which of them cannot be the best.
//!
//! The objective of the worst pose is at least that of any pose,
//!
//! ```text
//! max over all poses  f_p  >=  max over some poses  f_p,                                        (Q7)
//! ```
//!
//! so that many configurations are left after some poses: they are proven to be worse than the two best ones
//! so far. Nothing is assumed of the variables. Without the two best ones and their order, every number
//! would depend on threads: the bound is therefore that of whole rounds.

use crate::design::evaluation::Evaluation;
use crate::design::file::Over;
use crate::design::goal::sense;
use crate::design::problem::DesignProblem;
use crate::design::search::{Found, MET, excess, objective};
use rayon::prelude::*;

/// Configurations of which all are evaluated at all poses.
const FEW: usize = 1000;
/// Poses that are evaluated together, in the lanes.
const TOGETHER: usize = 8;
/// Configurations of the first round, and at most: each has twice as many as the one before.
const ROUNDS: [usize; 2] = [64, 4096];

/// What configurations lead to.
pub(crate) struct Exhausted {
    pub(crate) found: Vec<Option<Found>>,
    /// Evaluations of a robot at all poses, those at some of them included.
    pub(crate) evaluations: usize,
    /// Configurations that were left by (Q7).
    pub(crate) left: usize,
}

/// What is known of a configuration.
enum Outcome {
    Found(Found),
    /// It is not held, or does not meet the limits, at this part of the poses.
    Not(usize),
    /// It is worse at this part of the poses.
    Worse(usize),
}

/// Evaluates all configurations.
pub(crate) fn exhausted(problem: &DesignProblem, count: usize) -> Exhausted {
    if count <= FEW || !is_bounded(problem) {
        let one = |number: usize| single(problem, problem.configuration(number));
        let found = (0..count).into_par_iter().map(one).collect();
        return Exhausted { found, evaluations: count, left: 0 };
    }
    let part = |poses: &[_]| DesignProblem { poses: poses.to_vec(), ..problem.clone() };
    let parts: Vec<DesignProblem> = problem.poses.chunks(TOGETHER).map(part).collect();
    // Parts at which most configurations end come first.
    let (mut order, mut ends): (Vec<usize>, _) = ((0..parts.len()).collect(), vec![0_usize; parts.len()]);
    let mut all = Exhausted { found: Vec::with_capacity(count), evaluations: count, left: 0 };
    let mut best = [f64::INFINITY; 2];
    let mut size = ROUNDS[0];
    while all.found.len() < count {
        let (first, one) = (all.found.len(), |number| outcome(problem, (&parts, &order), number, best[1]));
        let round: Vec<Outcome> = (first..count.min(first + size)).into_par_iter().map(one).collect();
        size = ROUNDS[1].min(2 * size);
        for outcome in round {
            match &outcome {
                Outcome::Found(found) if found.objective < best[0] => best = [found.objective, best[0]],
                Outcome::Found(found) => best[1] = best[1].min(found.objective),
                Outcome::Not(part) => ends[*part] += 1,
                Outcome::Worse(part) => {
                    ends[*part] += 1;
                    all.left += 1;
                }
            }
            all.found.push(if let Outcome::Found(found) = outcome { Some(found) } else { None });
        }
        order.sort_by_key(|part| std::cmp::Reverse(ends[*part]));
    }
    all
}

/// Whether (Q7) holds: the objective is that of the worst pose, and no number is of all poses together. The
/// best with each type of cable and both ends of a front are others than the two best ones.
fn is_bounded(problem: &DesignProblem) -> bool {
    problem.over == Over::Worst
        && problem.second.is_none()
        && problem.types.is_empty()
        && !problem.output.is_of_all_poses()
        && problem.limits.whole().next().is_none()
        && problem.poses.len() > TOGETHER
}

fn outcome(
    problem: &DesignProblem,
    (parts, order): (&[DesignProblem], &[usize]),
    number: usize,
    bound: f64,
) -> Outcome {
    let values = problem.configuration(number);
    let (mut worst, mut most) = (f64::NEG_INFINITY, 0.0_f64);
    for part in order {
        let Ok(at) = parts[*part].evaluate(&values, None) else { return Outcome::Not(*part) };
        worst = worst.max(objective(problem.over, &at.outputs, sense(problem.output)));
        most = most.max(excess(&at));
        if most > MET {
            return Outcome::Not(*part);
        }
        if worst > bound {
            return Outcome::Worse(*part);
        }
    }
    Outcome::Found(of(values, worst, most))
}

/// A robot alone, without derivatives.
pub(crate) fn single(problem: &DesignProblem, values: Vec<f64>) -> Option<Found> {
    let at: Evaluation = problem.evaluate(&values, None).ok()?;
    Some(of(values, objective(problem.over, &at.outputs, sense(problem.output)), excess(&at)))
}

fn of(values: Vec<f64>, objective: f64, excess: f64) -> Found {
    let (gradient, active) = (Vec::new(), Vec::new());
    Found { values, objective, excess, residual: 0.0, gradient_error: None, gradient, active }
}
