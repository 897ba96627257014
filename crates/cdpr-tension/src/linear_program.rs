//! Small dense linear programs with bounds, by the simplex method.
//!
//! ```text
//! maximize  c·x - M |b - A x|_1   subject to   l <= x <= u                                        (T6)
//! ```
//!
//! For a penalty M above the multipliers of the rows this is the program with `A x = b`, if that has a
//! solution; otherwise it is the least residual. The answer lies in a vertex, exact to rounding, with the
//! multipliers of its bounds. Interior-point methods give both to their tolerance only, which is why Clarabel
//! does not solve this program.
//!
//! The tableau method with bounded variables (Dantzig, *Linear Programming and Extensions*, 1963, chapter
//! 18): every unknown outside the basis stands at zero, after a shift by its lower bound or a reflection at
//! its upper one. The residuals of the rows are the first basis.

/// The program (T6).
#[derive(Clone, Debug, PartialEq)]
pub struct LinearProgram {
    /// c, one for each unknown.
    pub objective: Vec<f64>,
    /// Rows of A, each with one coefficient for each unknown.
    pub rows: Vec<Vec<f64>>,
    /// b, one for each row.
    pub right: Vec<f64>,
    /// l and u of each unknown, l finite.
    pub bounds: Vec<[f64; 2]>,
    /// M, positive.
    pub penalty: f64,
}

/// A vertex of a [`LinearProgram`].
#[derive(Clone, Debug, PartialEq)]
pub struct LinearSolution {
    /// x.
    pub values: Vec<f64>,
    /// By how much the objective grows with the bound that each unknown rests on; zero of those within.
    pub slopes: Vec<f64>,
    /// By how much the objective grows with b of each row.
    pub multipliers: Vec<f64>,
    /// |b - A x|_1.
    pub residual: f64,
}

/// Reduced costs and pivots below this, in a program of coefficients near one, are rounding.
const ROUNDING: f64 = 1e-11;

struct Tableau {
    /// Coefficients of all rows, each with its right side last.
    rows: Vec<f64>,
    /// Reduced costs.
    costs: Vec<f64>,
    /// The unknown of each row.
    basis: Vec<usize>,
    /// Upper bounds above the lower ones.
    widths: Vec<f64>,
    /// Unknowns that are reflected at their upper bound.
    reflected: Vec<bool>,
}

impl LinearProgram {
    /// The solution; `None` if the objective has no bound or rounding keeps the method from an end.
    pub fn solve(&self) -> Option<LinearSolution> {
        let (n, m) = (self.objective.len(), self.rows.len());
        let mut tableau = self.tableau();
        tableau.solve()?;
        let mut shifts = vec![0.0; n + 2 * m];
        for (row, unknown) in tableau.rows.chunks(n + 2 * m + 1).zip(&tableau.basis) {
            shifts[*unknown] = row[n + 2 * m];
        }
        let value = |j: usize| {
            let [low, high] = self.bounds[j];
            if tableau.reflected[j] { high - shifts[j] } else { low + shifts[j] }
        };
        let sign = |j: usize| if tableau.reflected[j] { -1.0 } else { 1.0 };
        Some(LinearSolution {
            values: (0..n).map(value).collect(),
            // Of an unknown at rest on its bound the reduced cost is the slope; in the basis it is zero.
            slopes: (0..n).map(|j| sign(j) * tableau.costs[j]).collect(),
            multipliers: (0..m).map(|i| -self.penalty - tableau.costs[n + 2 * i]).collect(),
            residual: shifts[n..].iter().sum(),
        })
    }

    /// Of each row an unknown that stands in no other, without upper bound and without cost, if there is one.
    fn own_unknowns(&self) -> Vec<Option<usize>> {
        let mut own = vec![None; self.rows.len()];
        let free = |j: &usize| self.objective[*j] == 0.0 && self.bounds[*j][1].is_infinite();
        for j in (0..self.objective.len()).filter(free) {
            let mut rows = (0..self.rows.len()).filter(|i| self.rows[*i][j] != 0.0);
            if let (Some(i), None) = (rows.next(), rows.next()) {
                own[i] = Some(j);
            }
        }
        own
    }

    /// The tableau whose basis are the residuals at the lower bounds.
    fn tableau(&self) -> Tableau {
        let (n, m) = (self.objective.len(), self.rows.len());
        let width = |[low, high]: &[f64; 2]| high - low;
        let widths = self.bounds.iter().map(width).chain(vec![f64::INFINITY; 2 * m]).collect();
        let (mut rows, mut basis) = (vec![0.0; m * (n + 2 * m + 1)], Vec::with_capacity(m));
        // The residuals cost M each, those beside the basis on top of what the basis costs.
        let mut costs: Vec<f64> = self.objective.clone();
        costs.extend(vec![-self.penalty; 2 * m]);
        costs.push(0.0);
        let own = self.own_unknowns();
        let each = self.rows.iter().zip(&self.right).zip(rows.chunks_mut(n + 2 * m + 1)).enumerate();
        for (i, ((coefficients, right), row)) in each {
            let open =
                coefficients.iter().zip(&self.bounds).fold(*right, |rest, (a, [low, _])| rest - a * low);
            let sign = if open < 0.0 { -1.0 } else { 1.0 };
            row.iter_mut().zip(coefficients).for_each(|(to, a)| *to = sign * a);
            row[n + 2 * i] = sign;
            row[n + 2 * i + 1] = -sign;
            row[n + 2 * m] = sign * open;
            if let Some(j) = own[i].filter(|j| row[*j] > 0.0) {
                let scale = 1.0 / row[j];
                row.iter_mut().for_each(|a| *a *= scale);
                basis.push(j);
                continue;
            }
            costs.iter_mut().zip(&*row).for_each(|(cost, a)| *cost += self.penalty * a);
            basis.push(n + 2 * i + usize::from(sign < 0.0));
        }
        Tableau { rows, costs, basis, widths, reflected: vec![false; n + 2 * m] }
    }
}

impl Tableau {
    fn solve(&mut self) -> Option<()> {
        let most = 50 * (self.basis.len() + self.widths.len());
        for pivot in 0..most {
            // The steepest unknown; the first one where pivots might go round in a circle (Bland's rule).
            let rising =
                (0..self.widths.len()).filter(|j| self.costs[*j] > ROUNDING && self.widths[*j] > 0.0);
            let entering = if pivot < most / 2 {
                rising.max_by(|i, j| self.costs[*i].total_cmp(&self.costs[*j]))
            } else {
                rising.min()
            };
            let Some(entering) = entering else { return Some(()) };
            self.enter(entering)?;
        }
        None
    }

    /// Lets an unknown grow until it or one of the basis meets a bound; `None` if none does.
    fn enter(&mut self, entering: usize) -> Option<()> {
        let last = self.widths.len();
        let mut most = self.widths[entering];
        let mut leaving = None;
        for (i, row) in self.rows.chunks(last + 1).enumerate() {
            let (slope, value, width) = (row[entering], row[last], self.widths[self.basis[i]]);
            let (room, at_upper) = match slope {
                s if s > ROUNDING => (value.max(0.0) / s, false),
                s if s < -ROUNDING => ((width - value).max(0.0) / -s, true),
                _ => continue,
            };
            if room < most {
                (most, leaving) = (room, Some((i, at_upper)));
            }
        }
        match leaving {
            None if most.is_infinite() => return None,
            None => self.reflect(entering),
            Some((i, at_upper)) => {
                if at_upper {
                    self.reflect_basic(i);
                }
                self.pivot(i, entering);
            }
        }
        Some(())
    }

    /// Measures an unknown outside the basis from its other bound.
    fn reflect(&mut self, j: usize) {
        let (width, last) = (self.widths[j], self.widths.len());
        for row in self.rows.chunks_mut(last + 1).chain([&mut self.costs[..]]) {
            row[last] -= row[j] * width;
            row[j] = -row[j];
        }
        self.reflected[j] = !self.reflected[j];
    }

    /// Measures the unknown of a row from its other bound.
    fn reflect_basic(&mut self, i: usize) {
        let (j, last) = (self.basis[i], self.widths.len());
        let row = &mut self.rows[i * (last + 1)..(i + 1) * (last + 1)];
        row.iter_mut().for_each(|a| *a = -*a);
        row[j] = 1.0;
        row[last] += self.widths[j];
        self.reflected[j] = !self.reflected[j];
    }

    fn pivot(&mut self, i: usize, entering: usize) {
        let length = self.widths.len() + 1;
        let (before, rest) = self.rows.split_at_mut(i * length);
        let (row, after) = rest.split_at_mut(length);
        let scale = 1.0 / row[entering];
        row.iter_mut().for_each(|a| *a *= scale);
        row[entering] = 1.0;
        let others = before.chunks_mut(length).chain(after.chunks_mut(length));
        for other in others.chain([&mut self.costs[..]]) {
            let share = other[entering];
            if share != 0.0 {
                other.iter_mut().zip(&*row).for_each(|(a, b)| *a -= share * b);
                other[entering] = 0.0;
            }
        }
        self.basis[i] = entering;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_program_with_bounds_ends_in_its_vertex() {
        // 3x + 2y on x + y = 4 within x <= 3, y <= 5: at (3, 1).
        let program = LinearProgram {
            objective: vec![3.0, 2.0],
            rows: vec![vec![1.0, 1.0]],
            right: vec![4.0],
            bounds: vec![[0.0, 3.0], [-1.0, 5.0]],
            penalty: 1e3,
        };
        let found = program.solve().unwrap();
        assert_eq!((found.values, found.slopes), (vec![3.0, 1.0], vec![1.0, 0.0]));
        assert!((found.multipliers[0] - 2.0).abs() < 1e-9 && found.residual == 0.0);
    }

    #[test]
    fn what_cannot_be_met_is_the_residual() {
        let program = LinearProgram {
            objective: vec![-1.0],
            rows: vec![vec![2.0]],
            right: vec![-6.0],
            bounds: vec![[-1.0, 4.0]],
            penalty: 1e3,
        };
        let found = program.solve().unwrap();
        assert_eq!((found.values[0], found.residual), (-1.0, 4.0));
    }

    proptest! {
        /// At an optimum the dual has the same value: c·x = y·b + sum of slope times bound.
        #[test]
        fn the_dual_has_the_same_value(
            a in prop::collection::vec(-1.0..1.0_f64, 27),
            c in prop::collection::vec(-1.0..1.0_f64, 9),
            low in prop::collection::vec(-1.0..1.0_f64, 9),
            width in prop::collection::vec(0.1..3.0_f64, 9),
            share in prop::collection::vec(0.0..1.0_f64, 9),
        ) {
            let rows: Vec<Vec<f64>> = a.chunks(9).map(<[f64]>::to_vec).collect();
            let inside: Vec<f64> = (0..9).map(|j| low[j] + share[j] * width[j]).collect();
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let program = LinearProgram {
                right: rows.iter().map(|row| dot(row, &inside)).collect(),
                rows,
                bounds: (0..9).map(|j| [low[j], low[j] + width[j]]).collect(),
                objective: c,
                penalty: 1e4,
            };
            let found = program.solve().unwrap();
            prop_assert!(found.residual < 1e-9);
            for (x, [low, high]) in found.values.iter().zip(&program.bounds) {
                prop_assert!(*x >= low - 1e-9 && *x <= high + 1e-9);
            }
            for (row, right) in program.rows.iter().zip(&program.right) {
                prop_assert!((dot(row, &found.values) - right).abs() < 1e-9);
            }
            let value = dot(&program.objective, &found.values);
            prop_assert!(value >= dot(&program.objective, &inside) - 1e-9);
            let dual = dot(&found.multipliers, &program.right) + dot(&found.slopes, &found.values);
            prop_assert!((value - dual).abs() < 1e-7, "{value} {dual}");
        }
    }
}
