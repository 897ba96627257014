//! Following an optimum of the inverse model from one question to another.
//!
//! Pose, load and reference go straight from the old question to the new one, in steps. After each step
//! Newton's method starts from the last optimum, on the equations of (I2) and the balance with the exact
//! second derivatives. With the cables at a limit as a set W it solves
//!
//! ```text
//! h_i d_i + J_i·λ = -c_i  for i not in W,    d_i = the way to the limit  for i in W,    J d + F = 0   (I5)
//! ```
//!
//! A cable enters W where its d_i passes a limit, and leaves it where its multiplier has the wrong sign,
//! until W is that of the solution. The optimum lies on the branch of the last one if the method converges as
//! it does near its limit: every change is at most half of that before, and the reduced Hessian is positive
//! at each. Otherwise the step is halved. A strict minimum with a regular balance can always be followed by
//! steps that are small enough; where the least step fails, the branch has ended.

use super::held::Strand;
use super::optimum::{ELASTICITY, NEARLY_ROUNDING, Optimum, Point, ROUNDING};
use super::question::Question;
use crate::state::Load;
use cdpr_robot::{Pose, Vector6, Wrench};
use cdpr_tension::Bound;

/// The least step, as a share of the way.
const LEAST_STEP: f64 = 1e-6;

/// Greatest first change of a chord force, relative to itself.
const GREATEST_CHANGE: f64 = 0.5;

/// Ratio of one change to that before: an upper bound.
const CONTRACTION: f64 = 0.5;

/// Changes that contract so often are rounding.
const MAX_ITERATIONS: usize = 60;

/// A question and its optimum, from which others are followed.
#[derive(Clone, Debug)]
pub(super) struct Answered {
    pose: Pose,
    load: Load,
    reference: Vec<f64>,
    /// [N]
    chord_forces: Vec<f64>,
    /// The limit of each cable, 0 the least and 1 the greatest, that it rests on.
    limits: Vec<Option<usize>>,
    /// λ of forces [N] and moments [N/m].
    multipliers: Vector6<f64>,
}

impl Answered {
    pub(super) fn new(question: &Question, optimum: &Optimum) -> Self {
        let side = |bound: Bound| match bound {
            Bound::Min => 0,
            Bound::Max => 1,
        };
        Self {
            pose: *question.pose,
            load: *question.load,
            reference: question.reference.clone(),
            chord_forces: optimum.chord_forces.clone(),
            limits: optimum.active.iter().map(|bound| bound.map(side)).collect(),
            multipliers: optimum.multipliers,
        }
    }

    /// The optimum of `question` on the branch of this answer; `None` where the branch ends on the way.
    pub(super) fn followed<'a>(&self, question: &Question<'a>) -> Option<Optimum<'a>> {
        let mut iterations = 0;
        let mut passed = None;
        let (mut share, mut step) = (0.0, 1.0);
        loop {
            let last = passed.as_ref().unwrap_or(self);
            if share + step >= 1.0 {
                if let Some(point) = last.corrected(question, &mut iterations) {
                    return Some(Optimum { iterations, ..point.optimum() });
                }
                step = 1.0 - share;
            } else {
                let (pose, load, reference) = self.towards(question, share + step);
                let between = question.nearby(&pose, &load, reference);
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

    /// The question at a share of the way to another.
    fn towards(&self, question: &Question, share: f64) -> (Pose, Load, Vec<f64>) {
        let motion = self.pose.motion_to(question.pose) * share;
        let pose = self.pose.moved(motion.fixed_rows::<3>(0).into(), motion.fixed_rows::<3>(3).into());
        let change = |from: f64, to: f64| from + share * (to - from);
        let (a, b) = (&self.load, question.load);
        let wrench = a.wrench.to_vector().zip_map(&b.wrench.to_vector(), change);
        let load = Load { payload: change(a.payload, b.payload), wrench: Wrench::from_vector(&wrench) };
        let references = self.reference.iter().zip(&question.reference);
        (pose, load, references.map(|(from, to)| change(*from, *to)).collect())
    }

    /// The optimum of a question nearby to which Newton's method with a merit function leads; it may be on
    /// another branch.
    pub(super) fn optimised<'a>(&self, question: &Question<'a>) -> Option<Point<'a>> {
        let mut point = self.start(question)?;
        point.optimise().then_some(point)
    }

    /// The cables as they are here, at the ends of a question nearby.
    fn start<'a>(&self, question: &Question<'a>) -> Option<Point<'a>> {
        let each = self.chord_forces.iter().zip(&self.limits).enumerate();
        let strands = each.map(|(i, (force, limit))| Strand::near(question, i, *force, *limit));
        let mut point = Point::of(question, strands.collect::<Result<Vec<_>, _>>().ok()?);
        point.multipliers = self.multipliers;
        point.multipliers.fixed_rows_mut::<3>(3).scale_mut(point.arm);
        Some(point)
    }

    /// The optimum of a question nearby, if it is on the same branch.
    pub(super) fn corrected<'a>(&self, question: &Question<'a>, iterations: &mut usize) -> Option<Point<'a>> {
        let mut point = self.start(question)?;
        let (mut error_before, mut greatest) = (f64::INFINITY, GREATEST_CHANGE);
        for _ in 0..MAX_ITERATIONS {
            let (error, size) = (point.residual().norm().max(point.stationarity()), point.size());
            let nearly = error <= NEARLY_ROUNDING * size;
            if (error <= ROUNDING * size || (nearly && error >= 0.5 * error_before))
                && !point.learns_violated()?
            {
                return Some(point);
            }
            error_before = error;
            *iterations += 1;
            let (step, multipliers) = point.newton()?;
            let relative =
                point.strands.iter().zip(&step).map(|(strand, d)| d.abs() / strand.held.chord_force());
            let change = relative.fold(0.0, f64::max);
            if change > greatest {
                return (nearly && !point.learns_violated()?).then_some(point);
            }
            greatest = CONTRACTION * change;
            let moved = point.moved(&step)?;
            let rows = point.rows_of(&moved);
            point.set(moved, rows);
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
        let mut fixed: Vec<Option<usize>> = self.strands.iter().map(Strand::at_limit).collect();
        for _ in 0..=2 * fixed.len() {
            let way = |(strand, side): (&Strand, &Option<usize>)| side.map(|side| strand.room()[side]);
            let ways: Vec<Option<f64>> = self.strands.iter().zip(&fixed).map(way).collect();
            let (step, multipliers) = self.newton_step(&hessian, &ways, ELASTICITY)?;
            let mut changed = false;
            for (i, strand) in self.strands.iter_mut().enumerate() {
                let passed = |strand: &Strand| {
                    let [low, high] = strand.room();
                    [step[i] < low, step[i] > high].iter().position(|passed| *passed)
                };
                match fixed[i] {
                    None => {
                        // The room towards a limit that has not been asked for is an estimate.
                        if let Some(side) = passed(strand)
                            && !strand.knows(side)
                        {
                            strand.learn(side).ok()?;
                        }
                        fixed[i] = passed(strand);
                        changed |= fixed[i].is_some();
                    }
                    Some(side) => {
                        let row = &self.rows[i];
                        let slope = row.gradient() + hessian[i] * step[i] + row.slope.dot(&multipliers);
                        if [-slope, slope][side] > rounding {
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
