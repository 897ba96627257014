//! Following an equilibrium while lengths or load change, up to where it is lost.
//!
//! Between two settings everything changes linearly with a share from 0 to 1. From an equilibrium at one
//! share, the first step of Newton's method a step h later is the prediction of the linearization. A step is
//! taken only where the iteration ends near that prediction and at a stable equilibrium; otherwise h shrinks.
//! Near a turning point the pose moves like the square root of the share that remains up to it: steps then
//! fall geometrically. Where h is below 1e-9 the equilibrium is lost, unless the one downhill a millionth
//! later is the same (Allgower and Georg, *Introduction to Numerical Continuation Methods*, 2003, chapter 2)
//! or grows out of it: next to a symmetric equilibrium that becomes unstable, the platform moves away like
//! the square root of the share. So a jump of the platform is reported, not stepped over.

use crate::direct::near::{is_near_prediction, keeps_stiffness, motion};
use crate::direct::newton::newton;
use crate::direct::solution::{DirectMethod, DirectReport, DirectSolution, descend, solution};
use crate::error::{BranchEnd, StaticsError};
use crate::problem::DirectProblem;
use crate::state::Load;
use cdpr_robot::Robot;

/// Unstrained lengths and load, as they are set from outside.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Unstrained length of every cable [m].
    pub lengths: Vec<f64>,
    /// Load on the platform.
    pub load: Load,
}

/// Equilibria between two settings.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Stable equilibria in the order of their shares, the first at 0; the last at 1 unless the equilibrium
    /// was lost.
    pub steps: Vec<PathStep>,
    /// Where the equilibrium was lost, if it was.
    pub lost: Option<Loss>,
}

/// One equilibrium of a path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathStep {
    /// Share of the change, from 0 at the first setting to 1 at the second.
    pub share: f64,
    /// The equilibrium.
    pub solution: DirectSolution,
}

/// How an equilibrium ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LossKind {
    /// It meets an unstable one and both disappear: a turning point.
    TurningPoint,
    /// It goes on as an unstable one: a bifurcation.
    Bifurcation,
    /// It strains a cable by more than 10 %.
    Overstrained,
    /// It was not followed further, lost or not, after 10 000 steps.
    StepLimit,
}

/// The end of an equilibrium, and where the platform goes from there.
#[derive(Clone, Debug, PartialEq)]
pub struct Loss {
    /// Share of the change at which it is lost: of the last equilibrium, to 4e-9 for a turning point or
    /// bifurcation.
    pub share: f64,
    /// How it ends.
    pub kind: LossKind,
    /// The last stable equilibrium before.
    pub before: Box<DirectSolution>,
    /// The stable equilibrium downhill, a millionth of the change later, to which the platform jumps, or
    /// the reason why it was not found.
    pub after: Result<Box<DirectSolution>, StaticsError>,
}

/// Steps of the share below this are not taken.
const LEAST_STEP: f64 = 1e-9;

const MAX_STEPS: usize = 10_000;

/// An equilibrium nearer than this share of the robot's size is the same one behind a kink, such as a cable
/// that has become taut.
const SAME: f64 = 1e-5;

/// Share of the change behind a loss at which the equilibrium downhill is searched.
const BEYOND: f64 = 1e-6;

/// What the platform moves in this share, over what it moves in a hundred times of it, where it goes on from
/// where it stood: a tenth where it moves like the square root. A jump is as long in both.
const GROWING: f64 = 0.3;

/// The stable equilibrium under the load `to` that the one `from`, under another load, becomes while the load
/// changes in proportion and the lengths stay.
///
/// Where one step of the continuation is the whole change, that is Newton's method and no more.
///
/// # Errors
/// - [`StaticsError::BranchEnds`] where the equilibrium is lost before.
/// - [`StaticsError::Overstrained`] where it strains a cable by more than the models are valid for.
/// - [`StaticsError::Invalid`] as [`DirectProblem::new`]; [`StaticsError::DirectNotConverged`].
pub fn follow_load(
    robot: &Robot,
    lengths: &[f64],
    (load, from): (&Load, &DirectSolution),
    to: &Load,
) -> Result<DirectSolution, StaticsError> {
    if load == to {
        return Ok(from.clone());
    }
    follow_change(robot, ((lengths, load), from), (lengths, to))
}

/// The same while lengths and load change in proportion.
pub(crate) fn follow_change(
    robot: &Robot,
    (begin, from): ((&[f64], &Load), &DirectSolution),
    end: (&[f64], &Load),
) -> Result<DirectSolution, StaticsError> {
    let problem = DirectProblem::new(robot, end.0, end.1)?;
    let start = (&from.equilibrium, &from.stability);
    let found = newton(&problem, from.equilibrium.clone()).filter(|found| found.stability.is_stable());
    if let Some(found) = found
        && (is_near_prediction(&problem, &from.equilibrium, &found)
            || keeps_stiffness(&problem, start, &found))
    {
        return solution(&problem, found, DirectMethod::Newton);
    }
    let of_load = begin.0 == end.0;
    let [begin, end] = [begin, end].map(|(lengths, load)| Setting { lengths: lengths.to_vec(), load: *load });
    let end = follow_from(robot, &begin, &end, from.clone())?.end(from);
    end.map_err(|lost| {
        let (lost, iterations) = *lost;
        lost.into_error(iterations, of_load)
    })
}

impl Path {
    /// The last solution with the iterations of all steps after `first`, or where they were lost.
    pub(crate) fn end(mut self, first: &DirectSolution) -> Result<DirectSolution, Box<(Loss, usize)>> {
        let iterations = self.steps[1..].iter().map(|step| step.solution.report.iterations).sum();
        if let Some(lost) = self.lost {
            return Err(Box::new((lost, iterations)));
        }
        let mut last = self.steps.pop().map_or_else(|| first.clone(), |step| step.solution);
        last.report = DirectReport { method: DirectMethod::Continuation, iterations, ..last.report };
        Ok(last)
    }
}

impl Loss {
    /// The reason why there is no equilibrium at the end of a change, `of_load` alone or not.
    fn into_error(self, iterations: usize, of_load: bool) -> StaticsError {
        let Self { share, kind, before, after } = self;
        let pose = before.equilibrium.pose;
        match (kind, after) {
            (LossKind::Overstrained, Err(error)) => error,
            (LossKind::StepLimit, _) => {
                let residual = before.report.residual;
                StaticsError::DirectNotConverged { iterations, pose: Box::new(pose), residual }
            }
            (_, after) => StaticsError::BranchEnds(Box::new(BranchEnd {
                share,
                of_load,
                pose,
                falls_to: after.map(|after| after.equilibrium.pose),
            })),
        }
    }
}

pub(crate) fn follow_from(
    robot: &Robot,
    from: &Setting,
    to: &Setting,
    first: DirectSolution,
) -> Result<Path, StaticsError> {
    let mut steps = vec![PathStep { share: 0.0, solution: first.clone() }];
    let (mut share, mut now, mut step) = (0.0, first, 0.1);
    while share < 1.0 {
        let next = if share + step >= 1.0 { 1.0 } else { share + step };
        let setting = between(from, to, next);
        let problem = DirectProblem::new(robot, &setting.lengths, &setting.load)?;
        let found = newton(&problem, now.equilibrium.clone());
        let kind = match found.filter(|found| is_near_prediction(&problem, &now.equilibrium, found)) {
            Some(found) if found.stability.is_stable() => {
                match solution(&problem, found, DirectMethod::Continuation) {
                    Ok(solution) => now = solution,
                    Err(error) => {
                        let kind = LossKind::Overstrained;
                        let lost = Some(Loss { share, kind, before: Box::new(now), after: Err(error) });
                        return Ok(Path { steps, lost });
                    }
                }
                steps.push(PathStep { share: next, solution: now.clone() });
                (share, step) = (next, 2.0 * (next - share));
                continue;
            }
            Some(_) => LossKind::Bifurcation,
            None => LossKind::TurningPoint,
        };
        step = 0.25 * (next - share);
        let limit = steps.len() >= MAX_STEPS;
        if step < LEAST_STEP || limit {
            let kind = if limit { LossKind::StepLimit } else { kind };
            let after = match beyond(robot, (from, to), share, &now)? {
                Beyond::Same(next) if !limit => {
                    step = next.share - share;
                    (share, now) = (next.share, next.solution.clone());
                    steps.push(*next);
                    continue;
                }
                Beyond::Same(next) => Ok(Box::new(next.solution)),
                Beyond::Elsewhere(after) => after,
            };
            return Ok(Path { steps, lost: Some(Loss { share, kind, before: Box::new(now), after }) });
        }
    }
    Ok(Path { steps, lost: None })
}

/// What is downhill of an equilibrium that seems to be lost.
enum Beyond {
    /// The equilibrium itself a little later, behind a kink or next to one that has become unstable.
    Same(Box<PathStep>),
    /// Another one, to which the platform jumps.
    Elsewhere(Result<Box<DirectSolution>, StaticsError>),
}

/// What is downhill of the equilibrium `now` at a share.
fn beyond(
    robot: &Robot,
    (from, to): (&Setting, &Setting),
    share: f64,
    now: &DirectSolution,
) -> Result<Beyond, StaticsError> {
    let downhill = |further: f64| -> Result<(PathStep, f64), StaticsError> {
        let share = (share + further).min(1.0);
        let setting = between(from, to, share);
        let problem = DirectProblem::new(robot, &setting.lengths, &setting.load)?;
        let solution = descend(&problem, &now.equilibrium.pose)?;
        let moved = motion(&problem, &now.equilibrium, &solution.equilibrium).norm() / problem.size();
        Ok((PathStep { share, solution }, moved))
    };
    let (after, moved) = match downhill(BEYOND) {
        Ok(after) => after,
        Err(error) => return Ok(Beyond::Elsewhere(Err(error))),
    };
    if moved <= SAME {
        return Ok(Beyond::Same(Box::new(after)));
    }
    Ok(match downhill(100.0 * BEYOND) {
        Ok((later, farther)) if moved <= GROWING * farther => Beyond::Same(Box::new(later)),
        _ => Beyond::Elsewhere(Ok(Box::new(after.solution))),
    })
}

fn between(from: &Setting, to: &Setting, share: f64) -> Setting {
    let mix = |a: f64, b: f64| if share == 1.0 { b } else { a + share * (b - a) };
    Setting {
        lengths: from.lengths.iter().zip(&to.lengths).map(|(a, b)| mix(*a, *b)).collect(),
        load: from.load.between(&to.load, share),
    }
}
