//! The optimum (I1) of the inverse model near a start, by sequential quadratic programs.
//!
//! In the chord forces σ, with `F = sum w_i + w_ex`, `J_i = dw_i/dσ_i` and derivatives by σ_i as dashes,
//! each step d solves
//!
//! ```text
//! minimize  sum (c_i d_i + h_i d_i²/2),   J d + F = 0,   bounds on σ + d                            (I3)
//! c_i = (t_i - r_i) t_i',      h_i = t_i'² + (t_i - r_i) t_i'' + λ·w_i''
//! ```
//!
//! by its dual (`cdpr_tension::BoxProblem`), which also finds the active bounds. h is the exact second
//! derivative of the Lagrangian; where it is not clearly positive its size is taken instead, until a step on
//! the exact one is known to lead to a minimum. A merit function, the objective plus a multiple of |F|,
//! shortens steps that lead too far.

mod free_cables;

use super::cable::{CableAtPose, Row};
use super::problem::InverseProblem;
use crate::error::StaticsError;
use cdpr_cable::{Catenary, HeldCable};
use cdpr_robot::Vector6;
use cdpr_tension::{Bound, BoxProblem, BoxSolution, BoxUnknown};

/// The optimum, or the best near a start.
pub(super) struct Optimum<'a> {
    pub(super) catenaries: Vec<Catenary<'a>>,
    /// Chord forces [N].
    pub(super) chord_forces: Vec<f64>,
    /// Tensions [N]; exactly the limit where one is active.
    pub(super) tensions: Vec<f64>,
    pub(super) active: Vec<Option<Bound>>,
    /// λ of forces [N] and moments [N/m].
    pub(super) multipliers: Vector6<f64>,
    pub(super) iterations: usize,
    /// [N]
    pub(super) stationarity: f64,
}

/// All cables at their chord forces.
#[derive(Clone)]
pub(super) struct Point<'a> {
    pub(super) cables: Vec<CableAtPose<'a>>,
    pub(super) rows: Vec<Row>,
    /// w_ex, moments divided by the characteristic length.
    pub(super) external: Vector6<f64>,
    /// Length [m] by which moments are divided.
    pub(super) characteristic_length: f64,
    pub(super) multipliers: Vector6<f64>,
    pub(super) iterations: usize,
}

/// All cables at other chord forces.
pub(super) struct Moved<'a> {
    cables: Vec<HeldCable<'a>>,
    pub(super) rows: Vec<Row>,
}

const MAX_ITERATIONS: usize = 60;

/// Elasticity of the equations of a step: small enough that it is below rounding in a few steps, large enough
/// for a pose whose equations depend on each other.
pub(super) const ELASTICITY: f64 = 1e-9;

/// Least curvature of a step.
const LEAST_CURVATURE: f64 = 0.01;

/// A residual below this, relative to wrench and tensions, is rounding, or nearly.
pub(super) const ROUNDING: f64 = 1e-14;
pub(crate) const NEARLY_ROUNDING: f64 = 1e-11;

/// Steps near the optimum that gain nothing, before one keeps the balance exactly; next to rounding it is
/// one.
const MOST_STALLED: usize = 3;

/// A residual above this, relative to wrench and tensions, is far above what elastic equations leave.
const UNBALANCED: f64 = 1e-6;

impl<'a> Point<'a> {
    /// All cables at the chord forces nearest to `tensions` [N].
    pub(super) fn new(problem: &InverseProblem<'a>, tensions: &[f64]) -> Result<Self, StaticsError> {
        let cables = tensions.iter().enumerate().map(|(i, tension)| CableAtPose::new(problem, i, *tension));
        Ok(Self::of(problem, cables.collect::<Result<Vec<_>, _>>()?))
    }

    /// The cables as they are, without multipliers.
    pub(super) fn of(problem: &InverseProblem<'a>, cables: Vec<CableAtPose<'a>>) -> Self {
        let rows =
            cables.iter().map(|cable| cable.row(&cable.fixed, problem.characteristic_length)).collect();
        Self {
            cables,
            rows,
            external: problem.external,
            characteristic_length: problem.characteristic_length,
            multipliers: Vector6::zeros(),
            iterations: 0,
        }
    }

    /// F [N].
    pub(super) fn residual(&self) -> Vector6<f64> {
        self.rows.iter().fold(self.external, |sum, row| sum + row.wrench)
    }

    /// The forces that a residual is compared with [N].
    pub(super) fn size(&self) -> f64 {
        self.external.norm() + self.rows.iter().map(|row| row.wrench.norm()).sum::<f64>()
    }

    /// What is left of (I2) in the worst cable, in units of its own tension [N].
    pub(super) fn stationarity(&self) -> f64 {
        let each = self.rows.iter().zip(&self.cables).map(|(row, cable)| {
            let slope = row.gradient() + row.slope.dot(&self.multipliers);
            match cable.at_limit() {
                None => slope.abs(),
                Some(Bound::Min) => (-slope).max(0.0),
                Some(Bound::Max) => slope.max(0.0),
            }
        });
        each.fold(0.0, f64::max)
    }

    /// Every cable after a change of its chord force, within its limits. `None` where a cable cannot be
    /// closed.
    pub(super) fn moved(&self, step: &[f64]) -> Option<Moved<'a>> {
        let moved = self.cables.iter().zip(step).map(|(cable, d)| {
            let to = cable.fixed.chord_force + d;
            // A step to first order towards a limit does not leave the taut branch.
            let fixed = cable.at(to.max(0.1 * cable.fixed.chord_force)).ok()?;
            Some((fixed, cable.row(&fixed, self.characteristic_length)))
        });
        let (cables, rows) = moved.collect::<Option<(Vec<_>, Vec<_>)>>()?;
        Some(Moved { cables, rows })
    }

    /// Moves the cables.
    pub(super) fn set(&mut self, moved: Moved<'a>) {
        for (cable, fixed) in self.cables.iter_mut().zip(moved.cables) {
            cable.fixed = fixed;
        }
        self.rows = moved.rows;
    }

    /// The step of (I3) within the limits.
    fn step(&mut self, curvature: &[f64]) -> Option<(Vec<f64>, Vector6<f64>)> {
        let each = self.rows.iter().zip(curvature);
        let unknown = |(row, curvature): (&Row, &f64)| {
            let (gradient, column) = (row.gradient(), row.slope);
            BoxUnknown { gradient, curvature: *curvature, column, bounds: [0.0; 2] }
        };
        let BoxSolution { values, multipliers } =
            self.within_limits(each.map(unknown).collect(), self.multipliers)?;
        Some((values, multipliers))
    }

    /// Solves a program whose first unknowns are the changes of the chord forces, and computes the chord
    /// forces of all limits that they meet.
    pub(super) fn within_limits(
        &mut self,
        mut unknowns: Vec<BoxUnknown>,
        multipliers: Vector6<f64>,
    ) -> Option<BoxSolution> {
        let residual = self.residual();
        loop {
            for (unknown, cable) in unknowns.iter_mut().zip(&self.cables) {
                unknown.bounds = cable.step_bounds();
            }
            let solution = BoxProblem { unknowns: &unknowns, residual, multipliers }.solve();
            if !solution.values.iter().all(|d| d.is_finite()) {
                return None;
            }
            if !self.compute_reached_limits(&solution.values, &unknowns)? {
                return Some(solution);
            }
        }
    }

    /// Computes the chord force of each limit that a step reaches for the first time; true if there was one.
    fn compute_reached_limits(&mut self, values: &[f64], unknowns: &[BoxUnknown]) -> Option<bool> {
        let mut computed = false;
        for ((cable, d), unknown) in self.cables.iter_mut().zip(values).zip(unknowns) {
            for bound in Bound::BOTH {
                computed |= *d == unknown.bounds[bound as usize] && cable.know_limit(bound).ok()?;
            }
        }
        Some(computed)
    }

    /// The sum of all tensions [N].
    pub(super) fn total(&self) -> f64 {
        self.rows.iter().map(|row| row.tension).sum()
    }

    /// Twice the objective of (I1) [N²].
    pub(super) fn objective(&self) -> f64 {
        self.rows.iter().map(|row| (row.tension - row.reference).powi(2)).sum()
    }

    fn merit(rows: &[Row], external: Vector6<f64>, penalty: f64) -> f64 {
        let objective: f64 = rows.iter().map(|row| 0.5 * (row.tension - row.reference).powi(2)).sum();
        let residual = rows.iter().fold(external, |sum, row| sum + row.wrench);
        objective + penalty * residual.norm()
    }

    /// Computes the chord force of each limit that is violated for the first time; true if there was one.
    pub(super) fn compute_violated_limits(&mut self) -> Option<bool> {
        let mut computed = false;
        for cable in &mut self.cables {
            if let Some(bound) = cable.unknown_limit() {
                cable.compute_limit(bound).ok()?;
                computed = true;
            }
        }
        Some(computed)
    }

    /// Newton's method from here. Returns whether it ended at an optimum.
    pub(super) fn optimize(&mut self) -> bool {
        let mut before = f64::INFINITY;
        let (mut stalled, mut polished) = (0, false);
        for _ in 0..MAX_ITERATIONS {
            let (size, residual) = (self.size(), self.residual());
            let error = residual.norm().max(self.stationarity());
            let nearly = error <= NEARLY_ROUNDING * size && error >= 0.5 * before;
            if error <= ROUNDING * size || (nearly && polished) {
                match self.compute_violated_limits() {
                    Some(false) => return true,
                    Some(true) => {}
                    None => return false,
                }
            }
            let last_error = std::mem::replace(&mut before, error);
            self.iterations += 1;
            let largest = self.rows.iter().fold(0.0, |t: f64, row| t.max(row.tension));
            if self.multipliers.amax() > 1e4 * largest {
                self.multipliers = Vector6::zeros();
            }
            let exact = self.hessian();
            let convex: Vec<f64> = exact.iter().map(|h| h.abs().max(LEAST_CURVATURE)).collect();
            let Some((mut step, mut multipliers)) = self.step(&convex) else {
                return false;
            };
            // Within the limits no change of the tensions brings the balance nearer: the search for a balance
            // tells whether another point does.
            let linear = self.rows.iter().zip(&step).fold(residual, |sum, (row, d)| sum + row.slope * *d);
            if residual.norm() > UNBALANCED * size && linear.norm() > 0.99 * residual.norm() {
                return false;
            }
            let near = error <= 1e-3 * size;
            if near
                && exact.iter().zip(&convex).any(|(a, b)| a != b)
                && let Some(newton) = self.exact_step(&exact)
            {
                (step, multipliers) = newton;
            }
            // Full steps near the optimum; elsewhere those that the merit function accepts.
            if error <= 1e-7 * size {
                // Elastic equations move cables little that hardly span all wrenches, for large multipliers.
                // Next to rounding they leave a residual, which the tension of a slack cable magnifies.
                stalled = if error >= 0.5 * last_error { stalled + 1 } else { 0 };
                polished = nearly;
                if (nearly || stalled >= MOST_STALLED)
                    && let Some(newton) = self.inelastic_step(&exact)
                {
                    (step, multipliers) = newton;
                }
                let Some(moved) = self.moved(&step) else { return false };
                self.set(moved);
                self.multipliers = multipliers;
                continue;
            }
            if !self.search_along(&step, multipliers) {
                return false;
            }
        }
        false
    }

    /// Takes the part of a step that the merit function accepts.
    fn search_along(&mut self, step: &[f64], multipliers: Vector6<f64>) -> bool {
        let residual = self.residual();
        let penalty =
            2.0 * multipliers.norm() + 0.1 * self.rows.iter().map(|row| row.tension).fold(0.0, f64::max);
        let merit = Self::merit(&self.rows, self.external, penalty);
        let slope = self.rows.iter().zip(step).map(|(row, d)| row.gradient() * d).sum::<f64>()
            - penalty * residual.norm();
        let external = self.external;
        let is_accepted = |moved: &Moved, share: f64| {
            let accepted = merit + 1e-4 * share * slope.min(0.0);
            Self::merit(&moved.rows, external, penalty) <= accepted + 1e-14 * merit.abs()
        };
        let mut share = 1.0;
        while share > 1e-6 {
            let part: Vec<f64> = step.iter().map(|d| share * d).collect();
            if let Some(moved) = self.moved(&part) {
                if is_accepted(&moved, share) {
                    self.set(moved);
                    self.multipliers += (multipliers - self.multipliers) * share;
                    return true;
                }
                // Second-order correction: the same step with the balance at its end made good.
                let end = moved.rows.iter().fold(self.external, |sum, row| sum + row.wrench);
                if share == 1.0
                    && let Some(corrected) = self.corrected(step, end)
                    && let Some(moved) = self.moved(&corrected)
                    && is_accepted(&moved, share)
                {
                    self.set(moved);
                    self.multipliers = multipliers;
                    return true;
                }
            }
            share *= 0.5;
        }
        false
    }

    /// A step whose end balances, to second order: the least change of free cables that makes up for `end`.
    fn corrected(&self, step: &[f64], end: Vector6<f64>) -> Option<Vec<f64>> {
        let each = self.cables.iter().zip(&self.rows).zip(step);
        let unknowns: Vec<BoxUnknown> = each
            .map(|((cable, row), d)| BoxUnknown {
                gradient: 0.0,
                curvature: 1.0,
                column: row.slope,
                bounds: cable.step_bounds().map(|room| room - d),
            })
            .collect();
        let multipliers = Vector6::zeros();
        let change = BoxProblem { unknowns: &unknowns, residual: end, multipliers }.solve().values;
        Some(step.iter().zip(change).map(|(d, change)| d + change).collect())
    }

    /// Second derivatives of the Lagrangian, h of (I3).
    pub(super) fn hessian(&self) -> Vec<f64> {
        let each = self.cables.iter().zip(&self.rows);
        each.map(|(cable, row)| cable.hessian(row, &self.multipliers, self.characteristic_length)).collect()
    }

    /// The solution at an optimum.
    pub(super) fn optimum(&self) -> Optimum<'a> {
        let mut multipliers = self.multipliers;
        multipliers.fixed_rows_mut::<3>(3).unscale_mut(self.characteristic_length);
        let tension = |cable: &CableAtPose| {
            cable.at_limit().map_or_else(|| cable.fixed.tension(), |bound| cable.limit(bound))
        };
        Optimum {
            catenaries: self.cables.iter().map(|cable| cable.fixed.catenary).collect(),
            chord_forces: self.cables.iter().map(|cable| cable.fixed.chord_force).collect(),
            tensions: self.cables.iter().map(tension).collect(),
            active: self.cables.iter().map(CableAtPose::at_limit).collect(),
            multipliers,
            iterations: self.iterations,
            stationarity: self.stationarity(),
        }
    }
}
