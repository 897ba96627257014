//! The greatest payload and the margin of the tensions at a pose, with tensions distributed anew.
//!
//! Both are the greatest z for which tensions exist,
//!
//! ```text
//! maximise  z   subject to   sum w_i(t_i) + w_ex + z w_z = 0,   min_i + κ z <= t_i <= max_i - κ z    (I7)
//! ```
//!
//! - The payload: w_z is the weight of 1 kg at the centre of mass, κ = 0 and z >= 0. A pose that a robot
//!   holds under each wrench of a set belongs to its wrench-feasible workspace (Bosscher, Riechel,
//!   Ebert-Uphoff, *Wrench-feasible workspace generation for cable-driven robots*, IEEE Trans. Robotics 22,
//!   2006; Bouchard, Gosselin, Moore, *On the ability of a cable-driven robot to generate a prescribed set of
//!   wrenches*, J. Mechanisms Robotics 2, 2010).
//! - The margin: w_z = 0 and κ = 1. It is how far every tension can stay away from both of its limits, and
//!   negative where no tensions within the limits balance the wrench: by how much all limits would have to
//!   give way. The capacity margin of Guay, Cardou, Cruz-Ruiz, Caro (*Measuring how well a structure supports
//!   varying external wrenches*, 2014) measures the same distance as a wrench; it has the same sign.
//!
//! Of straight cables w_i = u_i t_i and (I7) is a linear program. Sagging ones pull in a direction that
//! depends on the tension: the program linearised at the last chord forces is solved again and again
//! (Fletcher and Sainz de la Maza, *Nonlinear programming and nonsmooth optimization by successive linear
//! programming*, Math. Programming 43, 1989). A step that does not bring the residual of the balance and z
//! together forward is repeated within a smaller region. Where as many limits are active as there are
//! unknowns beyond the balance, which is the rule, this is Newton's method.

use super::HeldPose;
use super::feasible::{BALANCED, search, straight};
use super::held::Strand;
use super::optimum::{Optimum, Point};
use super::question::Question;
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Load, Residual};
use cdpr_robot::{Pose, Robot, TensionLimits, Vector6, Wrench};
use cdpr_tension::{Bound, LinearProgram, LinearSolution};

/// The greatest value that the limits of tension allow, with the tensions that reach it.
#[derive(Clone, Debug, PartialEq)]
pub struct Greatest {
    /// The value: a payload [kg] or a margin [N].
    pub value: f64,
    /// Tension of every cable at the platform [N].
    pub tensions: Vec<f64>,
    /// Unstrained length of every cable [m].
    pub lengths: Vec<f64>,
    /// The pose with the cables' forces.
    pub equilibrium: Equilibrium,
    /// The limits that block a greater value, the one that gives most first.
    pub blocking: Vec<Blocking>,
    /// Linear programs that were solved.
    pub iterations: usize,
    /// Residuals of all equations.
    pub residual: Residual,
}

/// A limit that blocks a greater value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blocking {
    /// Index of the cable, from 0.
    pub index: usize,
    /// Which of its limits.
    pub bound: Bound,
    /// The limit at the platform [N]; of a least tension, no less than what the weight of the cable demands.
    pub limit: f64,
    /// By how much the value grows where this limit gives way [kg/N or N/N].
    pub gain: f64,
}

/// The greatest mass [kg] at the platform's centre of mass that tensions within the limits hold at `pose`,
/// beside the `wrench` [N, N m] about P.
///
/// It is zero or more. Where the platform is held with a mass only, not by its own weight, it is that mass or
/// more.
///
/// # Errors
/// Those of [`super::inverse`]; [`StaticsError::NoTensions`] where no mass is held.
pub fn greatest_payload(robot: &Robot, pose: &Pose, wrench: &Wrench) -> Result<Greatest, StaticsError> {
    let gravity = robot.gravity.magnitude();
    let load = Load::wrench(*wrench);
    if gravity == 0.0 {
        return Err(StaticsError::invalid(
            "gravity".to_owned(),
            gravity,
            "an acceleration above zero, because a mass is weighed by it",
        ));
    }
    let question = Question::of_whole_pose(robot, pose, &load, None)?;
    let heaviest = question.limits.iter().map(|limits| limits.max).sum();
    // Of a weight of 1 N.
    let mut direction = robot.weight(pose, 0.0).to_vector() / (robot.platform.mass * gravity);
    direction.fixed_rows_mut::<3>(3).unscale_mut(question.arm);
    let direction = robot.freedoms().of_vector(&direction);
    let components = robot.freedoms().components();
    let rise = Rise { direction, limits: None, range: [0.0, heaviest], components };
    let (force, found) = rise.top(&question, &question)?;
    let payload = force / gravity;
    let load = Load { payload, ..load };
    Greatest::new(&question, payload, 1.0 / gravity, &load, found)
}

/// By how much every tension can stay away from its limits at `pose` under `load` [N].
///
/// Cables whose own weight demands more than their least tension rest on what it demands.
///
/// # Errors
/// Those of [`super::inverse`]; [`StaticsError::NoTensions`] where the load cannot be balanced by any pull of
/// the cables, whatever their limits; [`StaticsError::InverseNotConverged`] where tensions hold the pose and
/// their margin was not found.
pub fn tension_margin(robot: &Robot, pose: &Pose, load: &Load) -> Result<Greatest, StaticsError> {
    let own = Question::of_whole_pose(robot, pose, load, None)?;
    let (mut question, limits) = (own.clone(), own.limits.clone());
    let largest = limits.iter().map(|limits| limits.max).fold(question.external.norm(), f64::max);
    // Wider than any margin: what is left are the least tensions that the cables' weight demands.
    for wide in &mut question.limits {
        *wide = TensionLimits { min: 1e-9 * wide.min, max: 1.5 * WIDEST * largest };
    }
    let range = [-WIDEST * largest, largest];
    let components = robot.freedoms().components();
    let rise = Rise { direction: Vector6::zeros(), limits: Some(limits), range, components };
    let (margin, found) = rise.top(&question, &own)?;
    Greatest::new(&question, margin, 1.0, load, found)
}

/// Greatest tension over the greatest limit where a margin is looked for.
const WIDEST: f64 = 20.0;

/// z of (I7) as a question.
struct Rise {
    /// w_z, moments divided by the arm.
    direction: Vector6<f64>,
    /// The limits that z draws closer; `None` where they stay.
    limits: Option<Vec<TensionLimits>>,
    /// Values of z [N] among which it is looked for.
    range: [f64; 2],
    /// Components of a wrench that the cables have to balance.
    components: Vec<usize>,
}

/// Cables at a z.
#[derive(Clone)]
struct Climber<'a> {
    point: Point<'a>,
    z: f64,
}

/// The top that was found.
struct Top<'a> {
    point: Point<'a>,
    solution: LinearSolution,
    iterations: usize,
    /// The limits that the value stands for.
    limits: Vec<TensionLimits>,
}

impl Greatest {
    fn new(
        question: &Question,
        value: f64,
        unit: f64,
        load: &Load,
        Top { point, solution, iterations, limits }: Top,
    ) -> Result<Self, StaticsError> {
        let HeldPose { lengths, equilibrium } = HeldPose::new(
            question.pose,
            &point.strands.iter().map(|s| s.held.catenary()).collect::<Vec<_>>(),
        );
        let problem = DirectProblem::new(question.robot, &lengths, load)?;
        problem.check_strains(&equilibrium)?;
        let residual = Residual::of(&problem, &equilibrium);
        let n = point.strands.len();
        let mut blocking = Vec::new();
        for (index, row) in point.rows.iter().enumerate() {
            // A bound on the chord force, and those on the tension that z draws closer.
            let slope = unit * solution.slopes[index] / row.tension_slope;
            let drawn =
                |side: usize| solution.slopes.get(n + 1 + 2 * index + side).map(|slope| -unit * slope);
            let gains = [
                (-slope).max(0.0) + drawn(0).unwrap_or(0.0).max(0.0),
                slope.max(0.0) + drawn(1).unwrap_or(0.0).max(0.0),
            ];
            for (gain, bound) in gains.into_iter().zip([Bound::Min, Bound::Max]) {
                if gain > 0.0 {
                    let TensionLimits { min, max } = limits[index];
                    let limit = if bound == Bound::Min { min } else { max };
                    blocking.push(Blocking { index, bound, limit, gain });
                }
            }
        }
        blocking.sort_by(|a: &Blocking, b| b.gain.total_cmp(&a.gain));
        // Less than this is rounding.
        let least = 1e-6 * blocking.first().map_or(0.0, |first| first.gain);
        blocking.retain(|block| block.gain > least);
        let tensions = point.rows.iter().map(|row| row.tension).collect();
        Ok(Self { value, tensions, lengths, equilibrium, blocking, iterations, residual })
    }
}

/// A residual below this, relative to wrench and tensions, may become a balance from another start.
const NEARLY_BALANCED: f64 = 1e-3;

/// Largest growth of a chord force in a step at first.
const REGION: f64 = 100.0;

/// A region below this has no step left.
const LEAST_REGION: f64 = 1e-9;

/// What a unit of the residual costs, in units of z: more than z gains by it. The greater one is for poses at
/// which a moment has hardly an arm.
const LEAST_PENALTY: f64 = 1e3;
const GREATEST_PENALTY: f64 = 1e6;

/// Steps that hardly bring the balance nearer while even the linearised cables do not balance.
const MOST_STALLED: usize = 3;

/// A residual below this, relative to wrench and tensions, leaves nothing to z.
const BALANCE: f64 = 1e-11;

/// Least share of a chord force that a step leaves, as [`Point::moved`] has it.
const LEAST_SHARE: f64 = 0.1;

/// A step or a gain below this, relative to the forces, is rounding, or nearly.
const ROUNDING: f64 = 1e-12;
const NEARLY_ROUNDING: f64 = 1e-9;

const MAX_ITERATIONS: usize = 100;

impl Rise {
    /// The greatest z and the cables there; `own` is the question with the limits as they are.
    fn top<'a>(&self, question: &Question<'a>, own: &Question<'a>) -> Result<(f64, Top<'a>), StaticsError> {
        let (mut point, top) = self.climb(question, &straight(question).0)?;
        if let Some(top) = top {
            return Ok(top);
        }
        // What refutes a balance at z = 0 refutes one at any z, unless z pulls the other way.
        if point.residual().dot(&self.direction) >= 0.0 && point.residue() > BALANCED && point.refutes() {
            return Err(point.refusal(question, 1, point.iterations, true));
        }
        // Far from a balance within wide limits, another start is not worth its time.
        if self.limits.is_some() && point.residue() > NEARLY_BALANCED {
            return Err(point.refusal(question, 1, point.iterations, false));
        }
        let Optimum { tensions, iterations, stationarity, .. } = search(own)?;
        let (_, top) = self.climb(question, &tensions)?;
        top.ok_or(StaticsError::InverseNotConverged { iterations, stationarity })
    }

    /// Climbs from some tensions [N]; besides where it ends, the top if it is one.
    fn climb<'a>(
        &self,
        question: &Question<'a>,
        tensions: &[f64],
    ) -> Result<(Point<'a>, Option<(f64, Top<'a>)>), StaticsError> {
        let point = Point::new(question, tensions)?;
        let mut at = Climber { point, z: self.range[0].max(0.0) };
        let (mut region, mut penalty, mut stalled) = (REGION, LEAST_PENALTY, 0);
        for iteration in 1..=MAX_ITERATIONS {
            at.point.iterations += 1;
            let size = at.point.size();
            let Some(solution) = self.step(&mut at.point, size, region, penalty)? else { break };
            let unbalanced = solution.residual > BALANCED && region == REGION;
            if unbalanced && penalty < GREATEST_PENALTY {
                penalty = GREATEST_PENALTY;
                continue;
            }
            let step: Vec<f64> = solution.values.iter().map(|x| x * size).collect();
            let (changes, z) = (&step[..at.point.strands.len()], step[at.point.strands.len()]);
            let relative = at.point.strands.iter().zip(changes).map(|(s, d)| d.abs() / s.held.chord_force());
            let change = relative.fold(0.0, f64::max);
            let merit = |at: &Climber| at.z - penalty * self.open(at);
            let gain = z - penalty * solution.residual * size - merit(&at);
            // Other tensions may reach the same z.
            let still = z - at.z <= ROUNDING * size || change <= ROUNDING || region < LEAST_REGION;
            if still && self.open(&at) <= BALANCE * size {
                if gain > NEARLY_ROUNDING * penalty * size {
                    break;
                }
                let point = at.point.clone();
                let own = || point.strands.iter().map(|strand| strand.limits).collect();
                let limits = self.limits.clone().unwrap_or_else(own);
                let top = Top { point, solution, iterations: iteration, limits };
                return Ok((at.point, Some((at.z, top))));
            }
            if unbalanced && (change <= 1e-6 || stalled >= MOST_STALLED) {
                break;
            }
            let Some(moved) = at.point.moved(changes) else {
                region *= 0.25;
                continue;
            };
            let mut next = Climber { point: at.point.clone(), z };
            let rows = next.point.rows_of(&moved);
            next.point.set(moved, rows);
            let reached = merit(&next) - merit(&at);
            stalled += usize::from(unbalanced && self.open(&next) > 0.9 * self.open(&at));
            if reached >= 0.1 * gain - 0.1 * ROUNDING * penalty * size {
                if reached > 0.7 * gain {
                    region = (4.0 * region).min(REGION);
                }
                at = next;
            } else {
                region = 0.25 * region.min(change);
            }
        }
        Ok((at.point, None))
    }

    /// Solves the program for a step, and asks for the chord forces of all limits that it meets.
    fn step(
        &self,
        point: &mut Point,
        size: f64,
        region: f64,
        penalty: f64,
    ) -> Result<Option<LinearSolution>, StaticsError> {
        loop {
            let program = self.program(point, size, region, penalty);
            let Some(solution) = program.solve() else { return Ok(None) };
            let mut learned = false;
            for (i, strand) in point.strands.iter_mut().enumerate() {
                for side in 0..2 {
                    let room = strand.room()[side] / size;
                    let met = [solution.values[i] <= room, solution.values[i] >= room][side];
                    if met && !strand.knows(side) {
                        strand.learn(side).map_err(StaticsError::cable(i))?;
                        learned = true;
                    }
                }
            }
            if !learned {
                return Ok(Some(solution));
            }
        }
    }

    /// |F|_1 and by how much tensions pass the limits drawn closer [N].
    fn open(&self, Climber { point, z }: &Climber) -> f64 {
        let balance: f64 = (point.residual() + self.direction * *z).lp_norm(1);
        let passed = |(i, limits): (usize, &TensionLimits)| {
            let t = point.rows[i].tension;
            (limits.min + z - t).max(0.0) + (t - limits.max + z).max(0.0)
        };
        balance + self.limits.iter().flatten().enumerate().map(passed).sum::<f64>()
    }

    /// The program linearised at the cables, its forces in units of `size` [N]: unknowns are the changes of
    /// the chord forces, z, and the ways that tensions keep from limits drawn closer.
    fn program(&self, point: &Point, size: f64, region: f64, penalty: f64) -> LinearProgram {
        let n = point.strands.len();
        let slacks = self.limits.as_ref().map_or(0, |limits| 2 * limits.len());
        let within = |strand: &Strand| {
            let at = strand.held.chord_force();
            let [low, high] = strand.room();
            let least = low.max((1.0 / (1.0 + region)).max(LEAST_SHARE) * at - at);
            [least, high.min(region * at).max(least)].map(|d| d / size)
        };
        let mut bounds: Vec<[f64; 2]> = point.strands.iter().map(within).collect();
        bounds.push(self.range.map(|z| z / size));
        bounds.extend(vec![[0.0, f64::INFINITY]; slacks]);
        let mut objective = vec![0.0; n + 1 + slacks];
        objective[n] = 1.0;
        let residual = point.residual();
        let balance = self.components.iter().map(|&k| {
            let mut row: Vec<f64> = point.rows.iter().map(|row| row.slope[k]).collect();
            row.push(self.direction[k]);
            row.extend(vec![0.0; slacks]);
            (row, -residual[k] / size)
        });
        let drawn = self.limits.iter().flatten().enumerate().flat_map(|(i, limits)| {
            // t + t' d - z - p = min,  t + t' d + z + q = max
            [(-1.0, limits.min), (1.0, limits.max)].into_iter().enumerate().map(
                move |(side, (sign, limit))| {
                    let mut row = vec![0.0; n + 1 + slacks];
                    row[i] = point.rows[i].tension_slope;
                    row[n] = sign;
                    row[n + 1 + 2 * i + side] = sign;
                    (row, (limit - point.rows[i].tension) / size)
                },
            )
        });
        let (rows, right) = balance.chain(drawn).unzip();
        LinearProgram { objective, rows, right, bounds, penalty }
    }
}
