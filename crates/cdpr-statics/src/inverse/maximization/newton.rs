//! Newton's method for the conditions of a maximum of (I7) whose active limits are known.
//!
//! With c the equations, those of the balance and of the active limits that z draws closer, and the
//! Lagrangian `L = z + λ·c`, a maximum has `∂L/∂(σ, z) = 0` and `c = 0`. Each step solves
//!
//! ```text
//! [ H  Aᵀ ] [ x ]   [ -∂z/∂(σ, z) ]
//! [ A  0  ] [ λ ] = [     -c      ]      H = ∂²L/∂(σ, z)²,  diagonal,      A = ∂c/∂(σ, z)        (I10)
//! ```
//!
//! for the chord forces of cables between their limits, and z. Where as many limits are active as there are
//! unknowns beyond the balance, A is square and H takes no part; where fewer are, only H makes the steps
//! converge.

use crate::dense::Indefinite;
use crate::inverse::cable::CableAtPose;
use crate::inverse::maximization::{BALANCE, Iterate, Maximization};
use cdpr_robot::Vector6;
use cdpr_tension::{Bound, LinearSolution};
use nalgebra::{DMatrix, DVector};

const MAX_ITERATIONS: usize = 20;

/// Greatest relative change of a chord force in one step.
const GREATEST_CHANGE: f64 = 1.0;

/// A relative change below this is rounding; one below the other if it does not decrease.
const ROUNDING: f64 = 1e-14;
const NEARLY_ROUNDING: f64 = 1e-8;

/// A distance from a limit drawn closer that is zero, relative to the forces.
const ON_LIMIT: f64 = 1e-12;

/// The limits that a program rests on.
struct Active {
    /// The limit of each cable that is active.
    fixed: Vec<Option<Bound>>,
    /// Cables at a limit that z draws closer, and which.
    drawn: Vec<(usize, Bound)>,
}

/// Multipliers of (I10).
struct Multipliers {
    balance: Vector6<f64>,
    /// Of the active limits drawn closer.
    drawn: Vec<f64>,
    /// Of the sum of the tensions in (I13).
    total: f64,
}

impl Maximization {
    /// The maximum with the limits that a program rests on; `None` where Newton's method does not lead to one
    /// within the other limits.
    pub(super) fn polished<'a>(
        &self,
        at: &Iterate<'a>,
        solution: &LinearSolution,
        size: f64,
    ) -> Option<Iterate<'a>> {
        let active = self.active(at, solution, size);
        let mut multipliers = self.multipliers(&active, solution);
        let mut at = at.clone();
        // Free cables and z.
        let unknowns = 1 + active.fixed.iter().filter(|fixed| fixed.is_none()).count();
        let mut before = f64::INFINITY;
        for _ in 0..MAX_ITERATIONS {
            let (step, factors, next) = self.newton_step(&at, &active, &multipliers)?;
            let n = at.point.cables.len();
            let relative =
                at.point.cables.iter().zip(&step).map(|(cable, d)| d.abs() / cable.fixed.chord_force);
            let change = relative.fold(0.0, f64::max);
            if change > GREATEST_CHANGE || !self.stays_within(&mut at, &active, &step)? {
                return None;
            }
            let is_last = change <= ROUNDING || (change <= NEARLY_ROUNDING && change >= 0.5 * before);
            at = at.moved(&step[..n], at.z + step[n])?;
            if !(self.range[0]..=self.range[1]).contains(&at.z) {
                return None;
            }
            (before, multipliers) = (change, next);
            if is_last {
                // The second derivatives of the Lagrangian are negative along all motions that keep the
                // equations where (I10) has as many negative eigenvalues as unknowns.
                let (_, negative) = factors.eigenvalues_by_sign();
                let is_maximum = self.open(&at) <= BALANCE * at.point.size() && negative == unknowns;
                return is_maximum.then_some(at);
            }
        }
        None
    }

    fn active(&self, at: &Iterate, solution: &LinearSolution, size: f64) -> Active {
        let n = at.point.cables.len();
        let fixed = |(cable, d): (&CableAtPose, &f64)| {
            let [low, high] = cable.step_bounds().map(|room| room / size);
            let met = [*d <= low, *d >= high];
            Bound::BOTH.into_iter().find(|bound| met[*bound as usize] && cable.limit_known(*bound))
        };
        let fixed = at.point.cables.iter().zip(&solution.values[..n]).map(fixed).collect();
        let slacks = solution.values[n + 1..].iter().enumerate();
        let drawn = slacks
            .filter(|(_, slack)| **slack <= ON_LIMIT)
            .map(|(k, _)| (k / 2, Bound::BOTH[k % 2]))
            .collect();
        Active { fixed, drawn }
    }

    fn multipliers(&self, active: &Active, solution: &LinearSolution) -> Multipliers {
        let mut balance = Vector6::zeros();
        for (k, y) in self.components.iter().zip(&solution.multipliers) {
            balance[*k] = -y;
        }
        let of_drawn = |(i, bound): &(usize, Bound)| {
            let multiplier = solution.multipliers[self.components.len() + 2 * i + *bound as usize];
            if *bound == Bound::Min { -multiplier } else { multiplier }
        };
        let total = if self.is_sum() { -solution.multipliers[self.components.len()] } else { 0.0 };
        Multipliers { balance, drawn: active.drawn.iter().map(of_drawn).collect(), total }
    }

    /// Changes of all chord forces and of z, the factors of (I10) and the multipliers.
    fn newton_step(
        &self,
        at: &Iterate,
        active: &Active,
        multipliers: &Multipliers,
    ) -> Option<(Vec<f64>, Indefinite, Multipliers)> {
        let point = &at.point;
        let n = point.cables.len();
        let free: Vec<usize> = (0..n).filter(|i| active.fixed[*i].is_none()).collect();
        let mut step: Vec<f64> = (point.cables.iter().zip(&active.fixed))
            .map(|(cable, fixed)| fixed.map_or(0.0, |bound| cable.step_bounds()[bound as usize]))
            .collect();
        let (k, m) = (free.len(), self.components.len());
        let (fixed_rows, is_sum) = (m + active.drawn.len(), self.is_sum());
        let rows = fixed_rows + usize::from(is_sum);
        let mut matrix = DMatrix::zeros(k + 1 + rows, k + 1 + rows);
        let mut right = DVector::zeros(k + 1 + rows);
        right[k] = -1.0;
        for (column, &i) in free.iter().enumerate() {
            let cable = &point.cables[i];
            let of_cable = active.drawn.iter().zip(&multipliers.drawn).filter(|((j, _), _)| *j == i);
            let of_tension =
                of_cable.map(|((_, bound), mu)| [*mu, -mu][*bound as usize]).sum::<f64>() + multipliers.total;
            matrix[(column, column)] = cable.bend(&multipliers.balance, point.characteristic_length)
                + of_tension * cable.tension_curvature();
        }
        let residual = point
            .rows
            .iter()
            .zip(&step)
            .fold(point.residual() + self.direction() * at.z, |sum, (row, d)| sum + row.slope * *d);
        let mut set = |row: usize, column: usize, value: f64| matrix[(k + 1 + row, column)] = value;
        for (row, &component) in self.components.iter().enumerate() {
            for (column, &i) in free.iter().enumerate() {
                set(row, column, point.rows[i].slope[component]);
            }
            set(row, k, self.direction()[component]);
            right[k + 1 + row] = -residual[component];
        }
        for (row, &(i, bound)) in active.drawn.iter().enumerate() {
            let limits = self.drawn()?[i];
            let sign = [1.0, -1.0][bound as usize];
            let slope = sign * point.rows[i].tension_slope;
            let limit = [limits.min, limits.max][bound as usize];
            if let Some(column) = free.iter().position(|j| *j == i) {
                set(m + row, column, slope);
            }
            set(m + row, k, -1.0);
            // Of a fixed cable the change is known.
            right[k + 1 + m + row] = -(sign * (point.rows[i].tension - limit) - at.z) - slope * step[i];
        }
        if is_sum {
            for (column, &i) in free.iter().enumerate() {
                set(fixed_rows, column, point.rows[i].tension_slope);
            }
            set(fixed_rows, k, 1.0);
            let of_fixed: f64 = point.rows.iter().zip(&step).map(|(row, d)| row.tension_slope * d).sum();
            right[k + 1 + fixed_rows] = -(point.total() + at.z) - of_fixed;
        }
        let factors = Indefinite::new(&matrix);
        let solution = factors.solve(&right)?;
        for (column, &i) in free.iter().enumerate() {
            step[i] = solution[column];
        }
        step.push(solution[k]);
        let mut balance = Vector6::zeros();
        for (row, component) in self.components.iter().enumerate() {
            balance[*component] = solution[k + 1 + row];
        }
        let drawn = solution.rows(k + 1 + m, active.drawn.len()).iter().copied().collect();
        let total = if is_sum { solution[k + 1 + fixed_rows] } else { 0.0 };
        Some((step, factors, Multipliers { balance, drawn, total }))
    }

    /// Whether cables between their limits stay there; computes the limits that a step meets.
    fn stays_within(&self, at: &mut Iterate, active: &Active, step: &[f64]) -> Option<bool> {
        for ((cable, d), fixed) in at.point.cables.iter_mut().zip(step).zip(&active.fixed) {
            if fixed.is_none() && cable.passed_limit(*d).ok()?.is_some() {
                return Some(false);
            }
        }
        Some(true)
    }
}
