//! From where the inverse model is searched, and when a pose is called infeasible.
//!
//! The first start is the closed form of the straight-cable problem, each tension moved into its limits, by
//! `start`. Where the search from there fails, the second one is Clarabel's optimum of that problem, with
//! directions along the chords, and where no tensions balance the wrench in these directions, those that come
//! nearest. Where that fails, too, the residual of the balance itself is made least, by steps
//!
//! ```text
//! minimize  |J d + F|² + sum (max(F·w_i'', 0) + η/σ_i²) d_i²   within the limits,          (I4)
//! ```
//!
//! from that start, from the reference, from the middle of the limits and from tensions spread over them,
//! each cable's for itself: other optima mostly differ in one cable or two. From every point where the
//! wrench is balanced the optimum is searched again.
//!
//! An optimum is the least of all if the tension of each cable makes its part of the Lagrangian least,
//!
//! ```text
//! φ_i(t) = (t - r_i)²/2 + λ·w_i(t)   within the limits                                             (I11)
//! ```
//!
//! (H. Everett, *Generalized Lagrange multiplier method*, Operations Research 11, 1963). It is tried on a
//! grid of each cable's chord forces where cables sag: where one cable has a smaller φ_i elsewhere, that is
//! the next start; where none has, no other start is needed.
//!
//! A pose is infeasible if a direction y exists in which no cable can pull enough:
//! `min y·w_i(t_i)` over the limits of each cable, summed over all, exceeds `-y·w_ex`. Of straight cables
//! Clarabel's certificate is such a direction; of nearly straight ones the least residual has it, too, if one
//! exists. Both are tried. Bounds by the weight of each cable prove most of it; where they do not, bounds by
//! tangents on a grid of each cable's chord forces do, as far as `y·w_i` does not turn from convex to concave
//! between two of them. Then no other start is tried. Where straight cables have no balance, the proof is
//! tried first; next to a pose that was refused it is tried from the tensions that came nearest there.

use super::optimum::{NEARLY_ROUNDING, Optimum, Point};
use super::problem::InverseProblem;
use super::start::StraightStart;
use crate::error::{Blocked, StaticsError};
use cdpr_cable::CableError;
use cdpr_robot::{Matrix6xX, TensionLimits, Vector6};
use cdpr_tension::{BoxUnknown, Objective};

/// A residual below this, relative to wrench and tensions, balances.
pub(super) const BALANCED: f64 = 1e-8;

/// Least share of the residual that a step gains: down to rounding; and where a balance is near enough to be
/// told from none, because steps towards one gain nearly all of it.
const LEAST_GAIN: f64 = 1e-9;
const CLEAR_GAIN: f64 = 1e-3;

/// A residual of straight cables above this, relative to wrench and tensions, makes a balance doubtful.
const CLEAR_RESIDUE: f64 = 1e-3;

/// Slackness q from which (I11) is tried, at a sag of about a thirtieth of the chord, and from which all
/// starts are unless (I11) proves that no other optimum is better, at a tenth.
const SOME: f64 = 0.14;
const MUCH: f64 = 0.4;

/// The optimum: of cables that sag little from the first start that leads to one, else the best of all
/// starts.
pub(super) fn search<'a>(problem: &InverseProblem<'a>) -> Result<Optimum<'a>, StaticsError> {
    let mut iterations = 0;
    let closed_form = problem.closed_form();
    let start = closed_form.as_ref().map(|tensions| Point::new(problem, tensions)).transpose()?;
    let mut best = start.and_then(|start| start.optimized(&mut iterations));
    if let Some(best) = &mut best
        && best.needs_no_other_start(problem, &mut iterations)?
    {
        return Ok(Optimum { iterations, ..best.optimum() });
    }
    let StraightStart { tensions, residue, certificate, .. } =
        problem.straight(Objective::Nearest(&problem.reference));
    let first = Point::new(problem, &tensions)?;
    if best.is_none() {
        if residue > CLEAR_RESIDUE
            && let Some(refusal) = refused(problem, &first, certificate.as_ref())
        {
            return Err(refusal);
        }
        if closed_form != Some(tensions) {
            best = first.clone().optimized(&mut iterations);
            if let Some(best) = &mut best
                && best.needs_no_other_start(problem, &mut iterations)?
            {
                return Ok(Optimum { iterations, ..best.optimum() });
            }
        }
    }
    let mut nearest = first.clone();
    let others = starts(problem).map(|tensions| Point::new(problem, &tensions));
    for (k, start) in std::iter::once(Ok(first)).chain(others).enumerate() {
        let mut point = start?;
        let found = point.balance(LEAST_GAIN) && point.optimize();
        iterations += point.iterations;
        if found {
            if best.as_ref().is_none_or(|best| point.objective() < (1.0 - 1e-12) * best.objective()) {
                best = Some(point);
            }
        } else if best.is_none() && (k == 0 || point.residue() < nearest.residue()) {
            nearest = point;
            if nearest.residue() > BALANCED && nearest.is_refuted(certificate.as_ref()) {
                return Err(nearest.refusal(problem, k + 2, iterations, true));
            }
        }
    }
    match best {
        Some(mut best) => {
            best.improved(problem, &mut iterations)?;
            Ok(Optimum { iterations, ..best.optimum() })
        }
        None => {
            // A balance that is only near is one if the least residual is rounding.
            if nearest.residue() <= BALANCED {
                nearest.balance_to(NEARLY_ROUNDING, LEAST_GAIN);
            }
            Err(nearest.refusal(problem, STARTS, iterations, false))
        }
    }
}

/// The refusal of a pose that a certificate of straight cables, or the least residual near `start`, proves to
/// be infeasible.
pub(super) fn refused<'a>(
    problem: &InverseProblem<'a>,
    start: &Point<'a>,
    certificate: Option<&Vector6<f64>>,
) -> Option<StaticsError> {
    let mut point = start.clone();
    let refuted = !point.balance(LEAST_GAIN) && point.is_refuted(certificate);
    refuted.then(|| point.refusal(problem, 1, point.iterations, true))
}

/// Whether tensions within the limits that hold the pose are found from those of straight cables alone.
pub(super) fn has_tensions(problem: &InverseProblem) -> Result<bool, StaticsError> {
    if let Some(tensions) = problem.closed_form()
        && Point::new(problem, &tensions)?.balance(CLEAR_GAIN)
    {
        return Ok(true);
    }
    Ok(Point::new(problem, &problem.straight(Objective::Nearest(&problem.reference)).tensions)?
        .balance(CLEAR_GAIN))
}

/// Straight cables, a balance from there, and those of [`starts`].
const STARTS: usize = 9;

/// Further tensions to start from: the reference, the middle, and others spread over the limits.
fn starts(problem: &InverseProblem) -> [Vec<f64>; STARTS - 2] {
    let middle = problem.limits.iter().map(|limits| 0.5 * (limits.min + limits.max)).collect();
    // Multiples of a step that is another one for each cable, but for whole numbers: on the unit interval
    // these are spread evenly (additive recurrence of the plastic number).
    let spread = |k: u32| {
        let tension = |(i, limits): (usize, &TensionLimits)| {
            let step = ((i + 1) as f64 * 0.754_877_666_246_692_7).fract();
            limits.min * (limits.max / limits.min).powf((f64::from(k) * step).fract())
        };
        problem.limits.iter().enumerate().map(tension).collect()
    };
    let [a, b, c, d, e] = [1, 2, 3, 4, 5].map(spread);
    [problem.reference.clone(), middle, a, b, c, d, e]
}

impl<'a> Point<'a> {
    /// The optimum to which Newton's method leads from here.
    fn optimized(mut self, iterations: &mut usize) -> Option<Self> {
        let found = self.optimize();
        *iterations += self.iterations;
        found.then_some(self)
    }

    /// Whether an optimum is the one to return: cables sag little, or (I11) proves it to be the least of all,
    /// to which it may lead.
    fn needs_no_other_start(
        &mut self,
        problem: &InverseProblem<'a>,
        iterations: &mut usize,
    ) -> Result<bool, StaticsError> {
        let proved = self.sags(SOME) && self.improved(problem, iterations)?;
        Ok(proved || !self.sags(MUCH))
    }

    /// Makes the residual of the balance least, and forgets the multipliers, until a step gains less than a
    /// share of it. Returns whether it balances.
    fn balance(&mut self, least_gain: f64) -> bool {
        self.balance_to(BALANCED, least_gain)
    }

    /// The same down to a residual, relative to wrench and tensions.
    fn balance_to(&mut self, balanced: f64, least_gain: f64) -> bool {
        const MAX_ITERATIONS: usize = 60;
        self.multipliers = Vector6::zeros();
        let mut damping = 1e-6;
        let mut residual = self.residual().norm();
        for _ in 0..MAX_ITERATIONS {
            let size = self.size();
            if residual <= balanced * size {
                return true;
            }
            self.iterations += 1;
            let largest = self.rows.iter().map(|row| row.tension).fold(0.0, f64::max);
            let open = self.residual();
            let curvature: Vec<f64> = self
                .cables
                .iter()
                .map(|cable| {
                    damping * (1.0 + largest / cable.fixed.chord_force).powi(2)
                        + cable.bend(&open, self.characteristic_length).max(0.0)
                })
                .collect();
            let Some(step) = self.least_step(&curvature) else { return false };
            let next = self.moved(&step).map(|moved| {
                let sum = moved.rows.iter().fold(self.external, |sum, row| sum + row.wrench);
                (sum.norm(), moved)
            });
            match next {
                Some((next, moved)) if next < residual => {
                    let gained = residual - next;
                    self.set(moved);
                    residual = next;
                    damping = (0.1 * damping).max(1e-9);
                    if gained <= least_gain * residual {
                        return residual <= balanced * self.size();
                    }
                }
                _ => {
                    damping *= 10.0;
                    if damping > 1e6 {
                        return false;
                    }
                }
            }
        }
        residual <= balanced * self.size()
    }

    /// The step of (I4), followed by what it leaves of the balance.
    fn least_step(&mut self, curvature: &[f64]) -> Option<Vec<f64>> {
        let of_cables = self.rows.iter().zip(curvature).map(|(row, curvature)| (row.slope, *curvature));
        // What is left of the balance: J d + F - e = 0 with the least |e|².
        let left = (0..6).map(|k| (-Vector6::ith(k, 1.0), 1.0));
        let bounds = [f64::NEG_INFINITY, f64::INFINITY];
        let unknown = |(column, curvature)| BoxUnknown { gradient: 0.0, curvature, column, bounds };
        let unknowns = of_cables.chain(left).map(unknown).collect();
        self.within_limits(unknowns, Vector6::zeros()).map(|solution| solution.values)
    }

    /// |F|, relative to wrench and tensions.
    pub(super) fn residue(&self) -> f64 {
        self.residual().norm() / self.size()
    }

    /// Whether a cable has more than this slackness.
    fn sags(&self, slackness: f64) -> bool {
        self.cables.iter().any(|cable| cable.fixed.slackness() > slackness)
    }

    /// Moves an optimum to better ones as long as (I11) leads to them. Returns whether (I11) proves the last
    /// one to be the least of all.
    fn improved(
        &mut self,
        problem: &InverseProblem<'a>,
        iterations: &mut usize,
    ) -> Result<bool, StaticsError> {
        const MOST: usize = 4;
        /// A smaller gain may be rounding of the same optimum, where cables on their bounds leave few others.
        const BETTER: f64 = 1e-9;
        for _ in 0..MOST {
            let tensions = match self.better_start() {
                Ok(Some(tensions)) => tensions,
                Ok(None) => return Ok(true),
                Err(_) => break,
            };
            let mut point = Point::new(problem, &tensions)?;
            let found = point.balance(LEAST_GAIN) && point.optimize();
            *iterations += point.iterations;
            if !found || point.objective() >= (1.0 - BETTER) * self.objective() {
                break;
            }
            *self = point;
        }
        Ok(false)
    }

    /// The tensions of an optimum [N], with that cable's changed whose part (I11) of the Lagrangian gains
    /// most; `None` where none gains anything.
    fn better_start(&mut self) -> Result<Option<Vec<f64>>, CableError> {
        /// A gain below this share of a cable's part is rounding.
        const ROUNDING: f64 = 1e-9;
        let mut most = 0.0;
        let mut changed = None;
        for (i, cable) in self.cables.iter_mut().enumerate() {
            let (here, (tension, least)) =
                cable.lagrangians(&self.multipliers, self.characteristic_length)?;
            let gain = here - least;
            if gain > most && gain > ROUNDING * (here.abs() + least.abs()) {
                most = gain;
                changed = Some((i, tension));
            }
        }
        Ok(changed.map(|(i, tension)| {
            let mut tensions: Vec<f64> = self.cables.iter().map(|cable| cable.fixed.tension()).collect();
            tensions[i] = tension;
            tensions
        }))
    }

    /// Whether no tensions within the limits balance the wrench: along the certificate of straight cables, or
    /// in the direction of the residual.
    fn is_refuted(&mut self, certificate: Option<&Vector6<f64>>) -> bool {
        certificate.is_some_and(|direction| self.is_refuted_along(direction))
            || self.is_refuted_along(&self.residual().normalize())
    }

    /// Whether no tensions within the limits balance the wrench along a direction, by more than rounding.
    pub(super) fn is_refuted_along(&mut self, direction: &Vector6<f64>) -> bool {
        let clear = 1e-9 * self.size();
        let along = direction.dot(&self.external);
        let bounds = self.cables.iter().map(|cable| cable.bound_along(direction, self.characteristic_length));
        if bounds.sum::<Option<f64>>().is_some_and(|least| along + least > clear) {
            return true;
        }
        let mut least = along;
        for cable in &mut self.cables {
            match cable.least_along(direction, self.characteristic_length) {
                Ok(value) => least += value,
                Err(_) => return false,
            }
        }
        least > clear
    }

    pub(super) fn refusal(
        &self,
        problem: &InverseProblem,
        starts: usize,
        iterations: usize,
        refuted: bool,
    ) -> StaticsError {
        let residual = self.residual();
        if self.residue() <= NEARLY_ROUNDING {
            return StaticsError::InverseNotConverged {
                iterations,
                stationarity: self.optimum().stationarity,
            };
        }
        let blocked = self.cables.iter().zip(&self.rows).enumerate().filter_map(|(index, (cable, row))| {
            let limits = &problem.limits[index];
            let bound = cable.at_limit().or_else(|| Blocked::near(row.tension, limits.min, limits.max))?;
            Some(Blocked { index, bound, tension: cable.limit(bound) })
        });
        // Of straight cables: those that sag have no slope along a residual that is the least one.
        let rank_deficient = {
            let columns: Vec<_> =
                self.cables.iter().map(|cable| cable.chord_wrench(self.characteristic_length)).collect();
            let matrix = Matrix6xX::from_columns(&columns);
            // The singular values of a matrix that is not finite are never found.
            matrix.iter().all(|entry| entry.is_finite()) && {
                let values = matrix.select_rows(&problem.robot.freedoms().components()).singular_values();
                values.min() < 1e-9 * values.max()
            }
        };
        StaticsError::NoTensions {
            position: problem.pose.position.into(),
            min: problem.limits.iter().map(|limits| limits.min).fold(f64::INFINITY, f64::min),
            max: problem.limits.iter().map(|limits| limits.max).fold(0.0, f64::max),
            starts,
            refuted,
            rank_deficient,
            force: residual.fixed_rows::<3>(0).norm(),
            moment: residual.fixed_rows::<3>(3).norm() * self.characteristic_length,
            tensions: self.rows.iter().map(|row| row.tension).collect(),
            blocked: blocked.collect(),
        }
    }
}
