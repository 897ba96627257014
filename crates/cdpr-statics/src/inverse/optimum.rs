//! The optimum (I1) of the inverse model near a start, by sequential quadratic programs.
//!
//! In the chord forces σ, with `F = sum w_i + w_ex`, `J_i = dw_i/dσ_i` and derivatives by σ_i as dashes,
//! each step d solves
//!
//! ```text
//! minimise  sum (c_i d_i + h_i d_i²/2),   J d + F = 0,   bounds on σ + d                            (I3)
//! c_i = (t_i - r_i) t_i',      h_i = t_i'² + (t_i - r_i) t_i'' + λ·w_i''
//! ```
//!
//! by its dual (`cdpr_tension::BoxProblem`), which also finds the active bounds. h is the exact second
//! derivative of the Lagrangian; where it is not clearly positive its size is taken instead, until a step on
//! the exact one is known to lead to a minimum. A merit function, the objective plus a multiple of |F|,
//! shortens steps that lead too far.

use super::held::{Row, Strand};
use super::question::Question;
use crate::dense::Indefinite;
use crate::equations::Held;
use crate::error::StaticsError;
use cdpr_cable::Catenary;
use cdpr_robot::Vector6;
use cdpr_tension::{Bound, BoxProblem, BoxUnknown};
use nalgebra::{DMatrix, DVector};

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
    pub(super) strands: Vec<Strand<'a>>,
    pub(super) rows: Vec<Row>,
    /// w_ex, moments divided by the arm.
    pub(super) external: Vector6<f64>,
    /// Length [m] by which moments are divided.
    pub(super) arm: f64,
    pub(super) multipliers: Vector6<f64>,
    pub(super) iterations: usize,
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

/// Steps near the optimum that gain nothing, before one holds the balance exactly; next to rounding it is one.
const MOST_STALLED: usize = 3;

/// A residual above this, relative to wrench and tensions, is far above what elastic equations leave.
const UNBALANCED: f64 = 1e-6;

impl<'a> Point<'a> {
    /// All cables at the chord forces nearest to `tensions` [N].
    pub(super) fn new(question: &Question<'a>, tensions: &[f64]) -> Result<Self, StaticsError> {
        let strands = tensions.iter().enumerate().map(|(i, tension)| Strand::new(question, i, *tension));
        Ok(Self::of(question, strands.collect::<Result<Vec<_>, _>>()?))
    }

    /// The cables as they are, without multipliers.
    pub(super) fn of(question: &Question<'a>, strands: Vec<Strand<'a>>) -> Self {
        let arm = question.arm;
        let rows = strands.iter().map(|strand| strand.row(&strand.held, arm)).collect();
        Self { strands, rows, external: question.external, arm, multipliers: Vector6::zeros(), iterations: 0 }
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
        let each = self.rows.iter().zip(&self.strands).map(|(row, strand)| {
            let slope = row.gradient() + row.slope.dot(&self.multipliers);
            match strand.at_limit() {
                None => slope.abs(),
                Some(0) => (-slope).max(0.0),
                Some(_) => slope.max(0.0),
            }
        });
        each.fold(0.0, f64::max)
    }

    /// Moves every cable by a change of its chord force, within its limits. `None` where a cable cannot be
    /// closed.
    pub(super) fn moved(&self, step: &[f64]) -> Option<Vec<Held<'a>>> {
        let moved = self.strands.iter().zip(step).map(|(strand, d)| {
            let to = strand.held.chord_force() + d;
            // A step to first order towards a limit does not leave the taut branch.
            strand.at(to.max(0.1 * strand.held.chord_force())).ok()
        });
        moved.collect()
    }

    /// The rows of the cables as they would be.
    pub(super) fn rows_of(&self, moved: &[Held<'a>]) -> Vec<Row> {
        self.strands.iter().zip(moved).map(|(strand, held)| strand.row(held, self.arm)).collect()
    }

    /// Moves the cables, whose rows are those of [`Point::rows_of`].
    pub(super) fn set(&mut self, moved: Vec<Held<'a>>, rows: Vec<Row>) {
        for (strand, held) in self.strands.iter_mut().zip(moved) {
            strand.held = held;
        }
        self.rows = rows;
    }

    /// Solves a program for a step, and asks for the chord forces of all limits that it meets.
    fn step(&mut self, curvature: &[f64]) -> Option<(Vec<f64>, Vector6<f64>)> {
        let (elasticity, multipliers, residual) = (ELASTICITY, self.multipliers, self.residual());
        let each = self.rows.iter().zip(curvature);
        let mut unknowns: Vec<BoxUnknown> = each
            .map(|(row, curvature)| BoxUnknown {
                gradient: row.gradient(),
                curvature: *curvature,
                column: row.slope,
                bounds: [0.0; 2],
            })
            .collect();
        loop {
            for (unknown, strand) in unknowns.iter_mut().zip(&self.strands) {
                unknown.bounds = strand.room();
            }
            let solution = BoxProblem { unknowns: &unknowns, residual, elasticity, multipliers }.solve();
            if !solution.values.iter().all(|d| d.is_finite()) {
                return None;
            }
            if !self.learns_reached(&solution.values, &unknowns)? {
                return Some((solution.values, solution.multipliers));
            }
        }
    }

    /// Whether a step reaches a limit that has not been asked for; asks for it.
    pub(super) fn learns_reached(&mut self, values: &[f64], unknowns: &[BoxUnknown]) -> Option<bool> {
        let mut learned = false;
        for ((strand, d), unknown) in self.strands.iter_mut().zip(values).zip(unknowns) {
            for side in 0..2 {
                if *d == unknown.bounds[side] && !strand.knows(side) {
                    strand.learn(side).ok()?;
                    learned = true;
                }
            }
        }
        Some(learned)
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

    /// Whether a limit is violated that has not been asked for; asks for it.
    pub(super) fn learns_violated(&mut self) -> Option<bool> {
        let mut learned = false;
        for strand in &mut self.strands {
            if let Some(side) = strand.unknown_limit() {
                strand.learn(side).ok()?;
                learned = true;
            }
        }
        Some(learned)
    }

    /// Newton's method from here. Returns whether it ended at an optimum.
    pub(super) fn optimise(&mut self) -> bool {
        let mut before = f64::INFINITY;
        let (mut stalled, mut polished) = (0, false);
        for _ in 0..MAX_ITERATIONS {
            let (size, residual) = (self.size(), self.residual());
            let error = residual.norm().max(self.stationarity());
            let nearly = error <= NEARLY_ROUNDING * size && error >= 0.5 * before;
            if error <= ROUNDING * size || (nearly && polished) {
                match self.learns_violated() {
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
                let rows = self.rows_of(&moved);
                self.set(moved, rows);
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
        let mut share = 1.0;
        while share > 1e-6 {
            let part: Vec<f64> = step.iter().map(|d| share * d).collect();
            if let Some(moved) = self.moved(&part) {
                let next = self.rows_of(&moved);
                let accepted = merit + 1e-4 * share * slope.min(0.0);
                let rounding = 1e-14 * merit.abs();
                if Self::merit(&next, self.external, penalty) <= accepted + rounding {
                    self.set(moved, next);
                    self.multipliers += (multipliers - self.multipliers) * share;
                    return true;
                }
                // Second-order correction: the same step with the balance at its end made good.
                if share == 1.0 {
                    let end = next.iter().fold(self.external, |sum, row| sum + row.wrench);
                    if let Some(corrected) = self.corrected(step, end)
                        && let Some(moved) = self.moved(&corrected)
                        && let rows = self.rows_of(&moved)
                        && Self::merit(&rows, self.external, penalty) <= accepted + rounding
                    {
                        self.set(moved, rows);
                        self.multipliers = multipliers;
                        return true;
                    }
                }
            }
            share *= 0.5;
        }
        false
    }

    /// A step whose end balances, to second order: the least change of free cables that makes up for `end`.
    fn corrected(&self, step: &[f64], end: Vector6<f64>) -> Option<Vec<f64>> {
        let each = self.strands.iter().zip(&self.rows).zip(step);
        let unknowns: Vec<BoxUnknown> = each
            .map(|((strand, row), d)| BoxUnknown {
                gradient: 0.0,
                curvature: 1.0,
                column: row.slope,
                bounds: strand.room().map(|room| room - d),
            })
            .collect();
        let multipliers = Vector6::zeros();
        let program = BoxProblem { unknowns: &unknowns, residual: end, elasticity: ELASTICITY, multipliers };
        let change = program.solve().values;
        Some(step.iter().zip(change).map(|(d, change)| d + change).collect())
    }

    /// Newton's step on the free cables with the exact Hessian; `None` unless it leads to a minimum and stays
    /// within the limits.
    fn exact_step(&self, hessian: &[f64]) -> Option<(Vec<f64>, Vector6<f64>)> {
        self.step_on_free_cables(hessian, ELASTICITY)
    }

    /// The same with the balance held exactly, which needs cables that can pull in all directions.
    fn inelastic_step(&self, hessian: &[f64]) -> Option<(Vec<f64>, Vector6<f64>)> {
        let free = self.strands.iter().filter(|strand| strand.at_limit().is_none()).count();
        let balanced = (0..6).filter(|row| !self.is_held(*row)).count();
        let (step, multipliers) = self.step_on_free_cables(hessian, 0.0).filter(|_| free >= balanced)?;
        let small =
            step.iter().zip(&self.strands).all(|(d, strand)| d.abs() <= 1e-3 * strand.held.chord_force());
        small.then_some((step, multipliers))
    }

    fn step_on_free_cables(&self, hessian: &[f64], elasticity: f64) -> Option<(Vec<f64>, Vector6<f64>)> {
        let fixed: Vec<_> = self.strands.iter().map(|strand| strand.at_limit().map(|_| 0.0)).collect();
        let (step, multipliers) = self.newton_step(hessian, &fixed, elasticity)?;
        let within = self.strands.iter().zip(&step).zip(&fixed).all(|((strand, d), fixed)| {
            let [low, high] = strand.room();
            fixed.is_some() || (low..=high).contains(d)
        });
        within.then_some((step, multipliers))
    }

    /// Whether a row of the balance is of a motion that is held: no cable takes part in it.
    fn is_held(&self, row: usize) -> bool {
        self.rows.iter().all(|of_cable| of_cable.slope[row] == 0.0)
    }

    /// Second derivatives of the Lagrangian, h of (I3).
    pub(super) fn hessian(&self) -> Vec<f64> {
        let each = self.strands.iter().zip(&self.rows);
        each.map(|(strand, row)| strand.hessian(row, &self.multipliers, self.arm)).collect()
    }

    /// Newton's step and the new multipliers, with the steps of some cables given: the others are free.
    /// `None` unless it leads to a minimum over the free cables.
    pub(super) fn newton_step(
        &self,
        hessian: &[f64],
        fixed: &[Option<f64>],
        elasticity: f64,
    ) -> Option<(Vec<f64>, Vector6<f64>)> {
        let mut step: Vec<f64> = fixed.iter().map(|fixed| fixed.unwrap_or(0.0)).collect();
        let residual =
            self.rows.iter().zip(&step).fold(self.residual(), |sum, (row, d)| sum + row.slope * *d);
        let free: Vec<usize> = (0..fixed.len()).filter(|i| fixed[*i].is_none()).collect();
        let k = free.len();
        let mut kkt = DMatrix::zeros(k + 6, k + 6);
        let mut right = DVector::zeros(k + 6);
        for (column, &i) in free.iter().enumerate() {
            kkt[(column, column)] = hessian[i];
            right[column] = -self.rows[i].gradient();
            for row in 0..6 {
                kkt[(k + row, column)] = self.rows[i].slope[row];
                kkt[(column, k + row)] = self.rows[i].slope[row];
            }
        }
        for row in 0..6 {
            let elasticity = if self.is_held(row) { ELASTICITY } else { elasticity };
            kkt[(k + row, k + row)] = -elasticity;
            right[k + row] = -residual[row] - elasticity * self.multipliers[row];
        }
        // The reduced Hessian is positive where the matrix has as many positive eigenvalues as free cables.
        let factors = Indefinite::new(&kkt);
        if free.iter().any(|i| hessian[*i] <= 0.0) && factors.eigenvalues_by_sign().0 != k {
            return None;
        }
        let solution = factors.solve(&right)?;
        for (row, &i) in free.iter().enumerate() {
            step[i] = solution[row];
        }
        Some((step, solution.fixed_rows::<6>(k).into()))
    }

    /// The answer at an optimum.
    pub(super) fn optimum(&self) -> Optimum<'a> {
        let mut multipliers = self.multipliers;
        multipliers.fixed_rows_mut::<3>(3).unscale_mut(self.arm);
        let bound = |strand: &Strand| strand.at_limit().map(|side| [Bound::Min, Bound::Max][side]);
        let tension = |strand: &Strand| {
            let limits = [strand.limits.min, strand.limits.max];
            strand.at_limit().map_or_else(|| strand.held.tension(), |side| limits[side])
        };
        Optimum {
            catenaries: self.strands.iter().map(|strand| strand.held.catenary()).collect(),
            chord_forces: self.strands.iter().map(|strand| strand.held.chord_force()).collect(),
            tensions: self.strands.iter().map(tension).collect(),
            active: self.strands.iter().map(bound).collect(),
            multipliers,
            iterations: self.iterations,
            stationarity: self.stationarity(),
        }
    }
}
