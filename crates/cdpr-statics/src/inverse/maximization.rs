//! The maximization (I7) by linear programs, and the least norms of the tensions, (I13), which are maxima,
//! too.
//!
//! Every iteration linearizes the balance at the cables' chord forces and solves a linear program within a
//! region about them. With the multipliers y of the balance in that program, steps are judged by
//!
//! ```text
//! m(σ, z) = z - M |F(σ, z)|_1,      M = 2 max |y|,      F = sum w_i + w_ex + z w_z                (I12)
//! ```
//!
//! where |F|_1 includes by how much tensions pass limits that z draws closer, and what (I13) leaves. A
//! greater M would allow only tiny steps along a balance that is curved. For the same reason a long step is
//! followed by one back to the balance, a second-order correction. Where a step gains nothing, `newton`
//! solves the conditions of a maximum with the limits that the program rests on. What is accepted as the
//! maximum is one to first order: no step within the limits gains anything.
//!
//! The least 1-norm and infinity-norm of the tensions are -z of
//!
//! ```text
//! maximize  z   subject to   sum w_i(t_i) + w_ex = 0,   min_i <= t_i <= max_i,
//!           sum t_i + z = 0,   or   t_i <= 0 - z  for all i                                        (I13)
//! ```

mod newton;

use crate::error::StaticsError;
use crate::inverse::cable::CableAtPose;
use crate::inverse::feasible::{BALANCED, search};
use crate::inverse::optimum::{Optimum, Point};
use crate::inverse::problem::InverseProblem;
use crate::inverse::start::StraightStart;
use cdpr_robot::{TensionLimits, Vector6};
use cdpr_tension::{Bound, BoxProblem, BoxUnknown, LinearProgram, LinearSolution, Objective};

/// What z of (I7) and (I13) is.
pub(super) enum Aim {
    /// The multiple of a wrench, its moment divided by the characteristic length.
    Wrench(Vector6<f64>),
    /// The distance from limits that it draws closer.
    Margin(Vec<TensionLimits>),
    /// The negative sum of all tensions, their least 1-norm.
    Sum,
    /// The negative greatest tension, their least infinity-norm: limits of zero that z draws closer, and none
    /// below.
    Greatest(Vec<TensionLimits>),
}

/// z and its range.
pub(super) struct Maximization {
    pub(super) aim: Aim,
    /// Least and greatest value of z [N].
    pub(super) range: [f64; 2],
    /// Components of a wrench that the cables have to balance.
    pub(super) components: Vec<usize>,
}

/// Cables and z between two steps.
#[derive(Clone)]
pub(super) struct Iterate<'a> {
    pub(super) point: Point<'a>,
    /// [N]
    pub(super) z: f64,
}

/// The maximum that was found.
pub(super) struct Maximum<'a> {
    /// z [N].
    pub(super) value: f64,
    pub(super) point: Point<'a>,
    /// The program whose solution gains nothing.
    pub(super) solution: LinearSolution,
    pub(super) iterations: usize,
}

/// A residual below this, relative to wrench and tensions, may become a balance from another start.
const NEARLY_BALANCED: f64 = 1e-3;

/// Largest growth of a chord force in a step at first.
const REGION: f64 = 100.0;

/// A region below this has no step left.
const LEAST_REGION: f64 = 1e-9;

/// What a unit of the residual costs in a program, in units of z: more than z gains by it. The greater one is
/// for poses at which a moment has hardly a lever arm.
const LEAST_COST: f64 = 1e2;
const GREATEST_COST: f64 = 1e6;

/// Share of its last value that M of (I12) keeps at least.
const KEPT_PENALTY: f64 = 0.3;

/// Steps that hardly bring the balance nearer while even the linearized cables do not balance.
const MOST_STALLED: usize = 3;

/// Steps back to the balance that follow a long one.
const MOST_BACK: usize = 3;

/// A residual below this, relative to wrench and tensions, leaves nothing to z.
pub(super) const BALANCE: f64 = 1e-11;

/// Least share of a chord force that a step leaves, as [`Point::moved`] has it.
const LEAST_SHARE: f64 = 0.1;

/// A step or a gain below this, relative to the forces, is rounding, or nearly.
const ROUNDING: f64 = 1e-12;
const NEARLY_ROUNDING: f64 = 1e-9;

const MAX_ITERATIONS: usize = 100;

/// The region of a program and the prices of a residual.
struct Trust {
    /// Largest relative change of a chord force.
    region: f64,
    /// Of a unit of the residual in a program.
    cost: f64,
    /// M of (I12).
    penalty: f64,
}

impl Maximization {
    /// The greatest z and the cables there; `own` is the problem with the limits of the robot.
    pub(super) fn solve<'a>(
        &self,
        problem: &InverseProblem<'a>,
        own: &InverseProblem<'a>,
    ) -> Result<Maximum<'a>, StaticsError> {
        let direction = problem.components_of(&self.direction());
        let (objective, sign) = match &self.aim {
            Aim::Wrench(_) => (Objective::GreatestWrench(&direction), 1.0),
            Aim::Margin(limits) => (Objective::GreatestMargin(limits), 1.0),
            Aim::Sum => (Objective::LeastSum, -1.0),
            Aim::Greatest(_) => (Objective::LeastGreatest, -1.0),
        };
        let StraightStart { tensions, value, certificate, .. } = problem.straight(objective);
        let (mut point, found) = self.climb(problem, &tensions, sign * value.unwrap_or(0.0))?;
        if let Some(found) = found {
            return Ok(found);
        }
        // What refutes a balance at z = 0 refutes one at any z, unless z pulls the other way.
        let pulls_away =
            |y: &Vector6<f64>| y.dot(&self.direction()) * self.range[1] >= -ROUNDING * point.size();
        let directions = [certificate, Some(point.residual().normalize())].into_iter().flatten();
        let directions: Vec<_> = directions.filter(pulls_away).collect();
        if point.residue() > BALANCED && directions.iter().any(|y| point.is_refuted_along(y)) {
            return Err(point.refusal(problem, 1, point.iterations, true));
        }
        // Far from a balance within wide limits, another start is not worth its time.
        if matches!(self.aim, Aim::Margin(_)) && point.residue() > NEARLY_BALANCED {
            return Err(point.refusal(problem, 1, point.iterations, false));
        }
        let Optimum { tensions, iterations, stationarity, .. } = search(own)?;
        let (_, found) = self.climb(problem, &tensions, 0.0)?;
        found.ok_or(StaticsError::InverseNotConverged { iterations, stationarity })
    }

    /// w_z of (I7).
    pub(super) fn direction(&self) -> Vector6<f64> {
        if let Aim::Wrench(direction) = &self.aim { *direction } else { Vector6::zeros() }
    }

    /// The limits that z draws closer.
    pub(super) fn drawn(&self) -> Option<&[TensionLimits]> {
        match &self.aim {
            Aim::Margin(limits) | Aim::Greatest(limits) => Some(limits),
            Aim::Wrench(_) | Aim::Sum => None,
        }
    }

    /// Whether z is the negative sum of the tensions.
    pub(super) fn is_sum(&self) -> bool {
        matches!(self.aim, Aim::Sum)
    }

    /// Climbs from some tensions and z [N]; returns where it ends, and the maximum if it is one.
    fn climb<'a>(
        &self,
        problem: &InverseProblem<'a>,
        tensions: &[f64],
        z: f64,
    ) -> Result<(Point<'a>, Option<Maximum<'a>>), StaticsError> {
        let mut at =
            Iterate { point: Point::new(problem, tensions)?, z: z.clamp(self.range[0], self.range[1]) };
        let mut trust = Trust { region: REGION, cost: LEAST_COST, penalty: 0.0 };
        let mut stalled = 0;
        for iterations in 1..=MAX_ITERATIONS {
            at.point.iterations += 1;
            let size = at.point.size();
            let Some(solution) = self.step(&mut at.point, size, &trust)? else { break };
            let unbalanced = solution.residual > BALANCED && trust.region == REGION;
            if unbalanced && trust.cost < GREATEST_COST {
                trust.cost *= 100.0;
                continue;
            }
            let multiplier = solution.multipliers.iter().fold(1.0, |most: f64, y| most.max(y.abs()));
            trust.penalty = (2.0 * multiplier).max(KEPT_PENALTY * trust.penalty);
            let step = Step::new(&solution, &at.point, size);
            let merit = self.merit(&at, trust.penalty);
            let gain = step.z - trust.penalty * solution.residual * size - merit;
            // Other tensions may reach the same z.
            let still = step.z - at.z <= ROUNDING * size
                || step.change <= ROUNDING
                || trust.region < LEAST_REGION
                || gain <= ROUNDING * trust.penalty * size;
            if still && self.open(&at) <= BALANCE * size {
                if gain > NEARLY_ROUNDING * trust.penalty * size {
                    break;
                }
                let point = at.point.clone();
                return Ok((at.point, Some(Maximum { value: at.z, point, solution, iterations })));
            }
            if unbalanced && (step.change <= 1e-6 || stalled >= MOST_STALLED) {
                break;
            }
            let wanted = merit + 0.1 * gain - 0.1 * ROUNDING * trust.penalty * size;
            let next = self.after(&at, &step, &trust, wanted);
            if let Some((next, reached)) = next.filter(|(_, reached)| *reached >= wanted) {
                stalled += usize::from(unbalanced && self.open(&next) > 0.9 * self.open(&at));
                if reached - merit > 0.7 * gain {
                    trust.region = (4.0 * trust.region).min(REGION);
                }
                at = next;
                continue;
            }
            let polished = self.polished(&at, &solution, size);
            match polished.filter(|next| self.merit(next, trust.penalty) > merit) {
                Some(next) => (at, trust.region) = (next, REGION),
                None => trust.region = 0.25 * trust.region.min(step.change),
            }
        }
        Ok((at.point, None))
    }

    /// The iterate after a step, with steps back to the balance until its merit is `wanted`, and its merit.
    /// `None` where a cable cannot be closed.
    fn after<'a>(
        &self,
        at: &Iterate<'a>,
        step: &Step,
        trust: &Trust,
        wanted: f64,
    ) -> Option<(Iterate<'a>, f64)> {
        let mut next = at.moved(&step.changes, step.z)?;
        let mut reached = self.merit(&next, trust.penalty);
        for _ in 0..MOST_BACK {
            if reached >= wanted {
                break;
            }
            let Some(back) = self.balanced(&next) else { break };
            let merit = self.merit(&back, trust.penalty);
            if merit <= reached {
                break;
            }
            (next, reached) = (back, merit);
        }
        Some((next, reached))
    }

    /// The least relative change of the chord forces that leads back to the balance, to first order.
    fn balanced<'a>(&self, at: &Iterate<'a>) -> Option<Iterate<'a>> {
        let point = &at.point;
        let largest = point.cables.iter().map(|cable| cable.fixed.chord_force).fold(0.0, f64::max);
        let unknown = |(i, cable): (usize, &CableAtPose)| {
            let row = &point.rows[i];
            let [mut low, mut high] = cable.step_bounds();
            if let Some(limits) = self.drawn().map(|drawn| drawn[i]) {
                low = low.max((limits.min + at.z - row.tension) / row.tension_slope);
                high = high.min((limits.max - at.z - row.tension) / row.tension_slope);
            }
            let curvature = (largest / cable.fixed.chord_force).powi(2);
            BoxUnknown { gradient: 0.0, curvature, column: row.slope, bounds: [low.min(high), high.max(low)] }
        };
        let unknowns: Vec<BoxUnknown> = point.cables.iter().enumerate().map(unknown).collect();
        let residual = point.residual() + self.direction() * at.z;
        let program = BoxProblem { unknowns: &unknowns, residual, multipliers: Vector6::zeros() };
        at.moved(&program.solve().values, at.z)
    }

    /// m of (I12) [N].
    fn merit(&self, at: &Iterate, penalty: f64) -> f64 {
        at.z - penalty * self.open(at)
    }

    /// |F|_1, by how much tensions pass the limits drawn closer, and what (I13) leaves [N].
    pub(super) fn open(&self, Iterate { point, z }: &Iterate) -> f64 {
        let balance: f64 = (point.residual() + self.direction() * *z).lp_norm(1);
        let passed = |(i, limits): (usize, &TensionLimits)| {
            let t = point.rows[i].tension;
            (limits.min + z - t).max(0.0) + (t - limits.max + z).max(0.0)
        };
        let total = if self.is_sum() { (point.total() + z).abs() } else { 0.0 };
        balance + self.drawn().into_iter().flatten().enumerate().map(passed).sum::<f64>() + total
    }

    /// Solves the program for a step, and computes the chord forces of all limits that it meets.
    fn step(
        &self,
        point: &mut Point,
        size: f64,
        trust: &Trust,
    ) -> Result<Option<LinearSolution>, StaticsError> {
        loop {
            let Some(solution) = self.program(point, size, trust).solve() else { return Ok(None) };
            let mut computed = false;
            for (i, cable) in point.cables.iter_mut().enumerate() {
                for bound in Bound::BOTH {
                    let way = cable.step_bounds()[bound as usize] / size;
                    let met = [solution.values[i] <= way, solution.values[i] >= way][bound as usize];
                    computed |= met && cable.know_limit(bound).map_err(StaticsError::cable(i))?;
                }
            }
            if !computed {
                return Ok(Some(solution));
            }
        }
    }

    /// The program linearized at the cables, its forces in units of `size` [N]: unknowns are the changes of
    /// the chord forces, z, and the distances of tensions from limits drawn closer.
    fn program(&self, point: &Point, size: f64, trust: &Trust) -> LinearProgram {
        let n = point.cables.len();
        let slacks = self.drawn().map_or(0, |limits| 2 * limits.len());
        let within = |cable: &CableAtPose| {
            let at = cable.fixed.chord_force;
            let [low, high] = cable.step_bounds();
            let least = low.max((1.0 / (1.0 + trust.region)).max(LEAST_SHARE) * at - at);
            [least, high.min(trust.region * at).max(least)].map(|d| d / size)
        };
        let mut bounds: Vec<[f64; 2]> = point.cables.iter().map(within).collect();
        bounds.push(self.range.map(|z| z / size));
        bounds.extend(vec![[0.0, f64::INFINITY]; slacks]);
        let mut objective = vec![0.0; n + 1 + slacks];
        objective[n] = 1.0;
        let residual = point.residual();
        let balance = self.components.iter().map(|&k| {
            let mut row: Vec<f64> = point.rows.iter().map(|row| row.slope[k]).collect();
            row.push(self.direction()[k]);
            row.extend(vec![0.0; slacks]);
            (row, -residual[k] / size)
        });
        let drawn = self.drawn().into_iter().flatten().enumerate().flat_map(|(i, limits)| {
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
        // (I13): sum t + sum t' d + z = 0
        let total = self.is_sum().then(|| {
            let slopes = point.rows.iter().map(|row| row.tension_slope);
            (slopes.chain([1.0]).collect(), -point.total() / size)
        });
        let (rows, right) = balance.chain(drawn).chain(total).unzip();
        LinearProgram { objective, rows, right, bounds, penalty: trust.cost }
    }
}

/// A step that a program leads to.
struct Step {
    /// Changes of the chord forces [N].
    changes: Vec<f64>,
    /// Where z goes [N].
    z: f64,
    /// The largest relative change of a chord force.
    change: f64,
}

impl Step {
    fn new(solution: &LinearSolution, point: &Point, size: f64) -> Self {
        let n = point.cables.len();
        let changes: Vec<f64> = solution.values[..n].iter().map(|x| x * size).collect();
        let relative = point.cables.iter().zip(&changes).map(|(s, d)| d.abs() / s.fixed.chord_force);
        let change = relative.fold(0.0, f64::max);
        Self { changes, z: solution.values[n] * size, change }
    }
}

impl<'a> Iterate<'a> {
    /// The cables with these changes of their chord forces [N], at z [N].
    pub(super) fn moved(&self, changes: &[f64], z: f64) -> Option<Self> {
        let moved = self.point.moved(changes)?;
        let mut next = Self { point: self.point.clone(), z };
        next.point.set(moved);
        Some(next)
    }
}
