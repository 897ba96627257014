//! Local search by sequential quadratic programming (J. Nocedal, S. J. Wright, *Numerical Optimization*,
//! 2nd edition, chapter 18; for the least of the greatest of several functions in epigraph form).
//!
//! In coordinates u of the box between the bounds, 0 to 1, with the outputs f_p (in parts of that of the
//! start, signed so that less is better) and the excesses c_k, a step d from u solves
//!
//! ```text
//! minimize  ½ dᵀB d + s + ρ v    subject to  f_p + ∇f_p·d <= s,   c_k + ∇c_k·d <= v,   v >= 0,
//!                                             0 <= u + d <= 1                                   (Q1)
//! ```
//!
//! v keeps (Q1) solvable where the demands cannot be met at once. Of a mean there is one f. With the
//! multipliers λ and μ of its rows, `sum λ_p = 1`, B follows the curvature of
//!
//! ```text
//! L = sum λ_p f_p + sum μ_k c_k                                                                (Q2)
//! ```
//!
//! by BFGS updates with Powell's damping. The step is shortened until the merit `max f_p + ρ max(0, max
//! c_k)` falls enough; where a whole step does not, one correction with the values at its end is tried
//! first. A robot that is not held has no merit: the step is shortened, too. The search ends where the
//! residual of the optimality conditions,
//!
//! ```text
//! max( |u - [u - ∇L]|,  sum λ_p (max f - f_p),  sum μ_k |c_k|,  max(0, max c_k) ),               (Q3)
//! ```
//!
//! with [.] the nearest point of the box, is small.

use crate::design::evaluation::{Evaluation, Quantity};
use crate::design::file::Over;
use crate::design::goal::{Goal, sense};
use crate::design::problem::{DesignProblem, STEP};
use cdpr_statics::DMatrix;
use cdpr_tension::QuadraticProgram;

/// Residual (Q3) of an optimum.
pub(crate) const OPTIMAL: f64 = 1e-8;
/// The same with derivatives by differences, their error added.
pub(crate) const OPTIMAL_BY_DIFFERENCES: f64 = 1e-6;
/// Residual at which the search ends.
const AIM: f64 = 1e-10;
/// Excess of a demand that rounding leaves, as a share of its limit.
pub(crate) const MET: f64 = 1e-8;
/// Change of the merit that rounding of the models may hide: steps that promise less are taken as far as the
/// residual falls.
const ROUNDING: f64 = 1e-9;
/// Such steps without a smaller residual.
const PATIENCE: usize = 5;
/// Distance from a bound within which a coordinate is on it.
const ON_BOUND: f64 = 1e-9;
const MOST_STEPS: usize = 200;
const MOST_HALVINGS: usize = 40;
/// Greatest ρ.
const MOST_PENALTY: f64 = 1e7;

impl Found {
    /// Whether the residual is small enough for a local optimum.
    pub(crate) fn is_optimal(&self) -> bool {
        match self.gradient_error {
            None => self.residual <= OPTIMAL,
            Some(error) => self.residual + error <= OPTIMAL_BY_DIFFERENCES,
        }
    }
}

/// Where a search ended.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    /// Values of all variables.
    pub(crate) values: Vec<f64>,
    /// The objective in its unit, with its sign.
    pub(crate) objective: f64,
    /// Greatest excess of a demand.
    pub(crate) excess: f64,
    /// (Q3).
    pub(crate) residual: f64,
    /// ∇L by the variables, in units of the output; what a bound that is moved by a unit gains.
    pub(crate) gradient: Vec<f64>,
    /// Greatest change of ∇L if differences have steps twice as long; `None` where all derivatives are exact.
    pub(crate) gradient_error: Option<f64>,
    /// Multipliers of the excesses that are not zero, in units of the output.
    pub(crate) active: Vec<(usize, f64)>,
}

/// The signed objective of the outputs at the poses.
pub(crate) fn objective(over: Over, outputs: &[Quantity], sign: f64) -> f64 {
    over.of(outputs).iter().map(|f| sign * f.value).fold(f64::NEG_INFINITY, f64::max)
}

/// The greatest excess, at least zero.
pub(crate) fn excess(found: &Evaluation) -> f64 {
    found.excesses.iter().map(|c| c.value).fold(0.0, f64::max)
}

/// Functions of u at a point.
#[derive(Clone)]
struct Point {
    u: Vec<f64>,
    f: Vec<Quantity>,
    c: Vec<Quantity>,
}

/// A step (Q1) with the multipliers of all rows.
struct Step {
    d: Vec<f64>,
    /// Fall of the merit that the linearization predicts.
    fall: f64,
    lambda: Vec<f64>,
    mu: Vec<f64>,
}

/// A search from one start.
pub(crate) struct Search<'a> {
    problem: &'a DesignProblem,
    /// Variables with bounds.
    bounded: Vec<(usize, [f64; 2])>,
    /// Values of all variables, those of the choices set.
    values: Vec<f64>,
    /// The unit of f.
    scale: f64,
    evaluations: usize,
    penalty: f64,
}

impl Search<'_> {
    /// Searches from these values, coordinates of the variables with bounds at `start`; `None` where the
    /// robot is not held there. Also the number of evaluations at all poses.
    pub(crate) fn run(problem: &DesignProblem, values: Vec<f64>, start: Vec<f64>) -> (Option<Found>, usize) {
        let bounded = problem.bounded().collect();
        let mut search = Search { problem, bounded, values, scale: 1.0, evaluations: 0, penalty: 10.0 };
        (search.from(start), search.evaluations)
    }

    fn from(&mut self, start: Vec<f64>) -> Option<Found> {
        let first = self.at(start)?;
        self.scale = first.merit(0.0).abs();
        if self.scale == 0.0 {
            self.scale = 1.0;
        }
        let start = first.u.clone();
        let here = self.at(start)?;
        self.descend(here)
    }

    /// The functions at a point; `None` where the robot is not held or has no derivatives.
    fn at(&mut self, u: Vec<f64>) -> Option<Point> {
        self.with_step(u, STEP)
    }

    /// The same with differences over this step.
    fn with_step(&mut self, u: Vec<f64>, step: f64) -> Option<Point> {
        self.evaluations += 1;
        let Self { problem, bounded, scale, .. } = &*self;
        let found = problem.evaluate(&problem.placed(self.values.clone(), &u), Some(step)).ok()?;
        let in_box = |quantity: &Quantity, factor: f64| Quantity {
            value: factor * quantity.value,
            slopes: bounded
                .iter()
                .map(|(j, [low, high])| factor * quantity.slopes[*j] * (high - low))
                .collect(),
        };
        let factor = sense(problem.output) / *scale;
        let outputs: Vec<Quantity> = found.outputs.iter().map(|f| in_box(f, factor)).collect();
        let f = problem.over.of(&outputs);
        let c = found.excesses.iter().map(|c| in_box(c, 1.0)).collect();
        let point = Point { u, f, c };
        point.is_finite().then_some(point)
    }

    fn descend(&mut self, mut here: Point) -> Option<Found> {
        let n = here.u.len();
        let mut b = DMatrix::identity(n, n);
        let (mut is_fresh, mut waited) = (true, 0);
        let mut best: Option<(Point, Step, f64)> = None;
        for _ in 0..MOST_STEPS {
            let Some(step) = self.step(&here, &here, &b) else { break };
            let residual = here.residual(&step);
            let taken = if residual <= AIM { None } else { self.search_along(&here, &step, &b) };
            if let Some(next) = &taken {
                update(&mut b, &here, next, &step, is_fresh);
            }
            let is_rounding = step.fall <= ROUNDING;
            if is_rounding && best.as_ref().is_some_and(|(.., least)| residual >= *least) {
                waited += 1;
            } else {
                waited = 0;
                best = Some((here.clone(), step, residual));
            }
            match taken {
                _ if residual <= AIM || waited > PATIENCE => break,
                Some(next) => {
                    here = next;
                    is_fresh = false;
                }
                None if is_fresh => break,
                None => {
                    b = DMatrix::identity(n, n);
                    is_fresh = true;
                }
            }
        }
        let (here, step, residual) = best?;
        let per_value = |(g, (_, [low, high])): (f64, &(usize, [f64; 2]))| self.scale * g / (high - low);
        let mut gradient = vec![0.0; self.values.len()];
        let slopes = here.gradient(&step).into_iter().zip(&self.bounded).map(per_value);
        self.bounded.iter().zip(slopes).for_each(|((j, _), slope)| gradient[*j] = slope);
        let gradient_error =
            if self.problem.needs(Goal::Position) { Some(self.gradient_error(&here, &step)) } else { None };
        let active = step.mu.iter().enumerate().filter(|(_, mu)| **mu > 1e-6);
        Some(Found {
            values: self.problem.placed(self.values.clone(), &here.u),
            objective: self.scale * here.merit(0.0),
            excess: here.violation(),
            residual,
            gradient_error,
            gradient,
            active: active.map(|(k, mu)| (k, self.scale * mu)).collect(),
        })
    }

    /// Greatest change of ∇L if differences have steps twice as long. Where no robot is held so far away,
    /// four times that by steps half as long, which has the same size for an error of second order.
    fn gradient_error(&mut self, here: &Point, step: &Step) -> f64 {
        let gradient = here.gradient(step);
        let change = |again: &Point| {
            let pairs = gradient.iter().zip(again.gradient(step));
            pairs.map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
        };
        if let Some(again) = self.with_step(here.u.clone(), 2.0 * STEP) {
            return change(&again);
        }
        let halved = self.with_step(here.u.clone(), 0.5 * STEP);
        halved.map_or(f64::INFINITY, |again| 4.0 * change(&again))
    }

    /// The step (Q1) from `here`, with the slopes there and the values of `at`: those of `here`, or for a
    /// correction those at the end of a step, moved back by the slopes.
    fn step(&mut self, here: &Point, at: &Point, b: &DMatrix<f64>) -> Option<Step> {
        let n = here.u.len();
        let back = |of: &Quantity, end: &Quantity| {
            let moved =
                of.slopes.iter().zip(at.u.iter().zip(&here.u)).map(|(g, (end, here))| g * (end - here));
            end.value - moved.sum::<f64>()
        };
        // Only rows that can matter within the box.
        let reach = |of: &Quantity| of.slopes.iter().map(|slope| slope.abs()).sum::<f64>();
        let least = here.f.iter().map(|f| f.value - reach(f)).fold(f64::NEG_INFINITY, f64::max);
        let rows_f = (0..here.f.len()).filter(|p| here.f[*p].value + reach(&here.f[*p]) >= least);
        let rows_c = (0..here.c.len()).filter(|k| here.c[*k].value + reach(&here.c[*k]) >= 0.0);
        let (rows_f, rows_c): (Vec<usize>, Vec<usize>) = (rows_f.collect(), rows_c.collect());
        let row = |slopes: &[f64], level: [f64; 2]| slopes.iter().copied().chain(level).collect::<Vec<f64>>();
        let of_f =
            rows_f.iter().map(|p| (row(&here.f[*p].slopes, [-1.0, 0.0]), -back(&here.f[*p], &at.f[*p])));
        let of_c =
            rows_c.iter().map(|k| (row(&here.c[*k].slopes, [0.0, -1.0]), -back(&here.c[*k], &at.c[*k])));
        let bounds = here.u.iter().map(|u| [-u, 1.0 - u]);
        let mut program = QuadraticProgram {
            hessian: b.clone(),
            gradient: vec![0.0; n].into_iter().chain([1.0, self.penalty]).collect(),
            inequalities: of_f.chain(of_c).collect(),
            bounds: bounds.chain([[f64::NEG_INFINITY, f64::INFINITY], [0.0, f64::INFINITY]]).collect(),
        };
        let mut found = program.solve().ok()?;
        while found.values[n + 1] > MET.max(0.5 * here.violation()) && self.penalty < MOST_PENALTY {
            self.penalty *= 10.0;
            program.gradient[n + 1] = self.penalty;
            found = program.solve().ok()?;
        }
        let (mut lambda, mut mu) = (vec![0.0; here.f.len()], vec![0.0; here.c.len()]);
        let (of_f, of_c) = found.multipliers.split_at(rows_f.len());
        rows_f.iter().zip(of_f).for_each(|(p, y)| lambda[*p] = *y);
        rows_c.iter().zip(of_c).for_each(|(k, y)| mu[*k] = *y);
        let (s, v) = (found.values[n], found.values[n + 1].max(0.0));
        let fall = here.merit(self.penalty) - s - self.penalty * v;
        Some(Step { d: found.values[..n].to_vec(), fall, lambda, mu })
    }

    /// The next point along a step, corrected or shortened; `None` where the merit falls nowhere.
    fn search_along(&mut self, here: &Point, step: &Step, b: &DMatrix<f64>) -> Option<Point> {
        const ENOUGH: f64 = 1e-4;
        let merit = here.merit(self.penalty);
        let penalty = self.penalty;
        let hidden = if step.fall <= ROUNDING { ROUNDING } else { 0.0 };
        let falls =
            |next: &Point, share: f64| next.merit(penalty) <= merit - ENOUGH * share * step.fall + hidden;
        let mut share = 1.0;
        for halving in 0..MOST_HALVINGS {
            let u = here.moved(&step.d, share);
            if u == here.u {
                return None;
            }
            if let Some(next) = self.at(u) {
                if falls(&next, share) {
                    return Some(next);
                }
                if halving == 0
                    && let Some(corrected) = self.step(here, &next, b)
                    && let Some(next) = self.at(here.moved(&corrected.d, 1.0))
                    && falls(&next, 1.0)
                {
                    return Some(next);
                }
            }
            share *= 0.5;
        }
        None
    }
}

impl Point {
    fn is_finite(&self) -> bool {
        let finite = |q: &Quantity| q.value.is_finite() && q.slopes.iter().all(|slope| slope.is_finite());
        self.f.iter().chain(&self.c).all(finite)
    }

    fn violation(&self) -> f64 {
        self.c.iter().map(|c| c.value).fold(0.0, f64::max)
    }

    fn merit(&self, penalty: f64) -> f64 {
        let greatest = self.f.iter().map(|f| f.value).fold(f64::NEG_INFINITY, f64::max);
        if penalty == 0.0 { greatest } else { greatest + penalty * self.violation() }
    }

    /// ∇L, (Q2).
    fn gradient(&self, step: &Step) -> Vec<f64> {
        let mut sum = vec![0.0; self.u.len()];
        let rows = self.f.iter().zip(&step.lambda).chain(self.c.iter().zip(&step.mu));
        for (quantity, y) in rows.filter(|(_, y)| **y != 0.0) {
            sum.iter_mut().zip(&quantity.slopes).for_each(|(sum, slope)| *sum += y * slope);
        }
        sum
    }

    /// (Q3).
    fn residual(&self, step: &Step) -> f64 {
        let slopes = self.gradient(step);
        let projected = self.u.iter().zip(&slopes).map(|(u, g)| (u - (u - g).clamp(0.0, 1.0)).abs());
        let greatest = self.merit(0.0);
        let of_f: f64 = self.f.iter().zip(&step.lambda).map(|(f, y)| y * (greatest - f.value)).sum();
        let of_c: f64 = self.c.iter().zip(&step.mu).map(|(c, y)| y * c.value.abs()).sum();
        projected.fold(of_f.max(of_c).max(self.violation()), f64::max)
    }

    /// This point after a share of a step, on a bound where it comes near one.
    fn moved(&self, d: &[f64], share: f64) -> Vec<f64> {
        let of = |(u, d): (&f64, &f64)| match u + share * d {
            u if u <= ON_BOUND => 0.0,
            u if u >= 1.0 - ON_BOUND => 1.0,
            u => u,
        };
        self.u.iter().zip(d).map(of).collect()
    }
}

/// BFGS with Powell's damping (Nocedal, Wright, Procedure 18.2).
fn update(b: &mut DMatrix<f64>, here: &Point, next: &Point, step: &Step, is_fresh: bool) {
    let n = here.u.len();
    let s = DMatrix::from_fn(n, 1, |j, _| next.u[j] - here.u[j]);
    let (before, after) = (here.gradient(step), next.gradient(step));
    let y = DMatrix::from_fn(n, 1, |j, _| after[j] - before[j]);
    let sy = s.dot(&y);
    if is_fresh && sy > 0.0 {
        *b *= y.norm_squared() / sy;
    }
    let bs = &*b * &s;
    let sbs = s.dot(&bs);
    if sbs <= f64::MIN_POSITIVE {
        return;
    }
    let share = if sy >= 0.2 * sbs { 1.0 } else { 0.8 * sbs / (sbs - sy) };
    let r = y * share + &bs * (1.0 - share);
    let sr = s.dot(&r);
    *b += &r * r.transpose() / sr - &bs * bs.transpose() / sbs;
}
