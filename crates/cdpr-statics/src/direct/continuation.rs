//! Following an equilibrium while lengths or load change, up to where it is lost.
//!
//! Between two settings everything changes linearly with a share from 0 to 1. From an equilibrium at one
//! share, the first step of Newton's method a step h later is the prediction of the linearisation. A step is
//! taken only where the iteration ends near that prediction and at a stable equilibrium; otherwise h shrinks.
//! Near a turning point the pose moves like the square root of the share that remains up to it: steps then
//! fall geometrically. Where h is below 1e-9 the equilibrium is lost, unless the one downhill a millionth
//! later is the same (Allgower and Georg, *Introduction to Numerical Continuation Methods*, 2003, chapter 2).
//! So a jump of the platform is reported, not stepped over.

use crate::direct::newton::{Converged, newton};
use crate::direct::solution::{DirectMethod, DirectSolution, descend, solution};
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Load};
use cdpr_robot::{Robot, Vector6, Wrench};

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

/// Largest correction of a prediction, relative to it.
const MAX_CORRECTION: f64 = 0.2;

pub(crate) fn follow_from(
    robot: &Robot,
    from: &Setting,
    to: &Setting,
    first: DirectSolution,
) -> Result<Path, StaticsError> {
    let size = DirectProblem::new(robot, &from.lengths, &from.load)?.size();
    let mut steps = vec![PathStep { share: 0.0, solution: first.clone() }];
    let (mut share, mut now, mut step) = (0.0, first, 0.1);
    while share < 1.0 {
        let next = if share + step >= 1.0 { 1.0 } else { share + step };
        let setting = between(from, to, next);
        let problem = DirectProblem::new(robot, &setting.lengths, &setting.load)?;
        let found = newton(&problem, now.equilibrium.clone());
        let kind = match found.filter(|found| is_near_prediction(&problem, &now.equilibrium, found, size)) {
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
        let kind = if limit { LossKind::StepLimit } else { kind };
        if step < LEAST_STEP || limit {
            let beyond = (share + 1e-6).min(1.0);
            let setting = between(from, to, beyond);
            let problem = DirectProblem::new(robot, &setting.lengths, &setting.load)?;
            let after = descend(&problem, &now.equilibrium.pose);
            if let Ok(same) = &after
                && !limit
                && motion(&problem, &now.equilibrium, &same.equilibrium).norm() <= SAME * size
            {
                now = same.clone();
                steps.push(PathStep { share: beyond, solution: now.clone() });
                (share, step) = (beyond, 1e-6);
                continue;
            }
            let lost = Some(Loss { share, kind, before: Box::new(now), after: after.map(Box::new) });
            return Ok(Path { steps, lost });
        }
    }
    Ok(Path { steps, lost: None })
}

/// Whether the iteration ended near what its first step predicted: on the same branch.
fn is_near_prediction(problem: &DirectProblem, from: &Equilibrium, found: &Converged, size: f64) -> bool {
    let motion = motion(problem, from, &found.equilibrium);
    (motion - found.first_step).norm() <= MAX_CORRECTION * found.first_step.norm() + 1e-7 * size
}

/// (dp, ℓ dφ) from one equilibrium to another [m].
fn motion(problem: &DirectProblem, from: &Equilibrium, to: &Equilibrium) -> Vector6<f64> {
    let mut motion = from.pose.motion_to(&to.pose);
    motion.fixed_rows_mut::<3>(3).scale_mut(problem.characteristic_length());
    motion
}

fn between(from: &Setting, to: &Setting, share: f64) -> Setting {
    let mix = |a: f64, b: f64| if share == 1.0 { b } else { a + share * (b - a) };
    let (a, b) = (from.load.wrench.to_vector(), to.load.wrench.to_vector());
    Setting {
        lengths: from.lengths.iter().zip(&to.lengths).map(|(a, b)| mix(*a, *b)).collect(),
        load: Load {
            payload: mix(from.load.payload, to.load.payload),
            wrench: Wrench::from_vector(&a.zip_map(&b, mix)),
        },
    }
}
