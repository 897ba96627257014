//! Following an optimum of the inverse model from one problem to another.
//!
//! Pose, load and reference go straight from the old problem to the new one, in steps. After each step
//! Newton's method starts from the last optimum, on the equations of (I2) and the balance with the exact
//! second derivatives. With the cables at a limit as a set W it solves
//!
//! ```text
//! h_i d_i + J_i·λ = -c_i  for i not in W,    d_i = the way to the limit  for i in W,    J d + F = 0   (I5)
//! ```
//!
//! A cable enters W where its d_i passes a limit, and leaves it where its multiplier has the wrong sign,
//! until W is that of the solution. All cables do so at once, which may go in circles where a limit cuts off
//! the corner of two others. Then it is one cable at a time, the first in the order of the robot, which ends
//! (K. G. Murty, *Note on a Bard-type scheme for solving the complementarity problem*, Opsearch 11, 1974).
//!
//! The optimum lies on the branch of the last one if the method converges as it does near its limit: every
//! change is at most half of that before, and the reduced Hessian is positive at each. Otherwise the step is
//! halved. A strict minimum with a regular balance can always be followed by steps that are small enough;
//! where the least step fails, the branch has ended.

use super::cable::CableAtPose;
use super::optimum::{ELASTICITY, NEARLY_ROUNDING, Optimum, Point, ROUNDING};
use super::problem::InverseProblem;
use crate::state::Load;
use cdpr_robot::{Pose, Vector6};
use cdpr_tension::Bound;

/// The least step, as a share of the way.
const LEAST_STEP: f64 = 1e-6;

/// Greatest first change of a chord force, relative to itself.
const GREATEST_CHANGE: f64 = 0.5;

/// Ratio of one change to that before: an upper bound.
const CONTRACTION: f64 = 0.5;

/// Changes that contract so often are rounding.
const MAX_ITERATIONS: usize = 60;

/// A problem with its optimum, from which others are followed.
#[derive(Clone, Debug)]
pub(super) struct KnownOptimum {
    pose: Pose,
    load: Load,
    reference: Vec<f64>,
    /// [N]
    chord_forces: Vec<f64>,
    /// The limit of each cable that is active.
    limits: Vec<Option<Bound>>,
    /// λ of forces [N] and moments [N/m].
    multipliers: Vector6<f64>,
}

impl KnownOptimum {
    pub(super) fn new(problem: &InverseProblem, optimum: &Optimum) -> Self {
        Self {
            pose: *problem.pose,
            load: *problem.load,
            reference: problem.reference.clone(),
            chord_forces: optimum.chord_forces.clone(),
            limits: optimum.active.clone(),
            multipliers: optimum.multipliers,
        }
    }

    /// The optimum of `problem` on the branch of this one; `None` where the branch ends on the way.
    pub(super) fn followed<'a>(&self, problem: &InverseProblem<'a>) -> Option<Optimum<'a>> {
        let mut iterations = 0;
        let mut passed = None;
        let (mut share, mut step) = (0.0, 1.0);
        loop {
            let last = passed.as_ref().unwrap_or(self);
            if share + step >= 1.0 {
                if let Some(point) = last.corrected(problem, &mut iterations) {
                    return Some(Optimum { iterations, ..point.optimum() });
                }
                step = 1.0 - share;
            } else {
                let (pose, load, reference) = self.towards(problem, share + step);
                let between = problem.nearby(&pose, &load, reference);
                if let Some(point) = last.corrected(&between, &mut iterations) {
                    passed = Some(Self::new(&between, &point.optimum()));
                    share += step;
                    step *= 2.0;
                    continue;
                }
            }
            step *= 0.5;
            if step < LEAST_STEP {
                return None;
            }
        }
    }

    /// The problem at a share of the way to another.
    fn towards(&self, problem: &InverseProblem, share: f64) -> (Pose, Load, Vec<f64>) {
        let motion = self.pose.motion_to(problem.pose) * share;
        let pose = self.pose.moved(motion.fixed_rows::<3>(0).into(), motion.fixed_rows::<3>(3).into());
        let change = |from: f64, to: f64| from + share * (to - from);
        let load = self.load.between(problem.load, share);
        let references = self.reference.iter().zip(&problem.reference);
        (pose, load, references.map(|(from, to)| change(*from, *to)).collect())
    }

    /// The optimum of a problem nearby to which Newton's method with a merit function leads; it may be on
    /// another branch.
    pub(super) fn optimized<'a>(&self, problem: &InverseProblem<'a>) -> Option<Point<'a>> {
        let mut point = self.start(problem)?;
        point.optimize().then_some(point)
    }

    /// The cables as they are here, at the ends of a problem nearby.
    fn start<'a>(&self, problem: &InverseProblem<'a>) -> Option<Point<'a>> {
        let each = self.chord_forces.iter().zip(&self.limits).enumerate();
        let cables = each.map(|(i, (force, limit))| CableAtPose::near(problem, i, *force, *limit));
        let mut point = Point::of(problem, cables.collect::<Result<Vec<_>, _>>().ok()?);
        point.multipliers = self.multipliers;
        point.multipliers.fixed_rows_mut::<3>(3).scale_mut(point.characteristic_length);
        Some(point)
    }

    /// The optimum of a problem nearby, if it is on the same branch.
    pub(super) fn corrected<'a>(
        &self,
        problem: &InverseProblem<'a>,
        iterations: &mut usize,
    ) -> Option<Point<'a>> {
        let mut point = self.start(problem)?;
        let (mut error_before, mut greatest) = (f64::INFINITY, GREATEST_CHANGE);
        for _ in 0..MAX_ITERATIONS {
            let (error, size) = (point.residual().norm().max(point.stationarity()), point.size());
            let nearly = error <= NEARLY_ROUNDING * size;
            if (error <= ROUNDING * size || (nearly && error >= 0.5 * error_before))
                && !point.compute_violated_limits()?
            {
                return Some(point);
            }
            error_before = error;
            *iterations += 1;
            let (step, multipliers) = point.newton()?;
            let relative = point.cables.iter().zip(&step).map(|(cable, d)| d.abs() / cable.fixed.chord_force);
            let change = relative.fold(0.0, f64::max);
            if change > greatest {
                return (nearly && !point.compute_violated_limits()?).then_some(point);
            }
            greatest = CONTRACTION * change;
            let moved = point.moved(&step)?;
            point.set(moved);
            point.multipliers = multipliers;
        }
        // All cables at limits that do not balance have nothing left to change.
        None
    }
}

impl Point<'_> {
    /// The solution of (I5) with the set W that belongs to it; `None` where none is found or it is no
    /// minimum.
    fn newton(&mut self) -> Option<(Vec<f64>, Vector6<f64>)> {
        let hessian = self.hessian();
        let rounding = ROUNDING * self.size();
        let mut fixed: Vec<Option<Bound>> = self.cables.iter().map(CableAtPose::at_limit).collect();
        let all_at_once = fixed.len();
        for pass in 0..=4 * all_at_once {
            let way = |(cable, bound): (&CableAtPose, &Option<Bound>)| {
                bound.map(|bound| cable.step_bounds()[bound as usize])
            };
            let ways: Vec<Option<f64>> = self.cables.iter().zip(&fixed).map(way).collect();
            let (step, multipliers) = self.newton_step(&hessian, &ways, ELASTICITY)?;
            let mut changed = false;
            for (i, cable) in self.cables.iter_mut().enumerate() {
                if changed && pass >= all_at_once {
                    break;
                }
                match fixed[i] {
                    None => {
                        fixed[i] = cable.passed_limit(step[i]).ok()?;
                        changed |= fixed[i].is_some();
                    }
                    Some(bound) => {
                        let row = &self.rows[i];
                        let slope = row.gradient() + hessian[i] * step[i] + row.slope.dot(&multipliers);
                        if [-slope, slope][bound as usize] > rounding {
                            fixed[i] = None;
                            changed = true;
                        }
                    }
                }
            }
            if !changed {
                return Some((step, multipliers));
            }
        }
        None
    }
}
