//! Quadratic and linear programs by Clarabel (P. J. Goulart, Y. Chen, *Clarabel: An interior-point solver for
//! conic programs with quadratic objectives*, arXiv:2405.12762). No other module names it.
//!
//! Its form is `min ½ xᵀPx + qᵀx  subject to  Ax + s = b, s in a cone`: zero for equations, the nonnegative
//! numbers for bounds.

use crate::problem::{Bound, TensionError};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus,
    SupportedConeT::{NonnegativeConeT, ZeroConeT},
};

/// `minimize ½ xᵀHx + sum (c_i x_i + h_i x_i²/2)  subject to  A x = b,  B x <= d,  l <= x <= u`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Program {
    /// c.
    pub(crate) gradient: Vec<f64>,
    /// h, zero or more.
    pub(crate) curvature: Vec<f64>,
    /// Columns of the positive semidefinite H of the first unknowns; their upper triangle is read.
    pub(crate) hessian: Vec<Vec<f64>>,
    /// Rows of A with b.
    pub(crate) equations: Vec<(Vec<f64>, f64)>,
    /// Rows of B with d.
    pub(crate) inequalities: Vec<(Vec<f64>, f64)>,
    /// l and u, which may be infinite.
    pub(crate) bounds: Vec<[f64; 2]>,
}

/// What Clarabel found.
pub(crate) enum Outcome {
    Solved(Solution),
    /// y that proves that no x within bounds and inequalities solves `A x = b`, for Clarabel's tolerances.
    Infeasible(Vec<f64>),
}

/// A solution of a [`Program`] to Clarabel's tolerances.
pub(crate) struct Solution {
    /// x.
    pub(crate) values: Vec<f64>,
    /// The bound that each unknown rests on: its distance is smaller than its multiplier.
    pub(crate) active: Vec<Option<Bound>>,
    /// Multiplier of each inequality, zero or more.
    pub(crate) multipliers: Vec<f64>,
}

/// Relative and absolute tolerance of residuals and gap.
const TOLERANCE: f64 = 1e-10;

impl Program {
    /// # Errors
    /// [`TensionError::Solver`] where Clarabel ends with neither a solution nor a proof of infeasibility.
    pub(crate) fn solve(&self) -> Result<Outcome, TensionError> {
        let (n, m) = (self.gradient.len(), self.equations.len());
        let rows: Vec<&(Vec<f64>, f64)> = self.equations.iter().chain(&self.inequalities).collect();
        let mut right: Vec<f64> = rows.iter().map(|(_, right)| *right).collect();
        let mut a = Columns::default();
        // Rows -x <= -l and x <= u of each unknown, where they are finite.
        let mut bound_rows = vec![[None; 2]; n];
        for (j, (of_bounds, [low, high])) in
            bound_rows.iter_mut().zip(self.bounds.iter().copied()).enumerate()
        {
            for (row, value) in of_bounds.iter_mut().zip([-low, high]).filter(|(_, value)| value.is_finite())
            {
                *row = Some(right.len());
                right.push(value);
            }
            let coefficients = rows.iter().map(|(row, _)| row[j]).enumerate().filter(|(_, a)| *a != 0.0);
            let own = of_bounds.iter().zip([-1.0, 1.0]).filter_map(|(row, sign)| Some(((*row)?, sign)));
            a.push(coefficients.chain(own));
        }
        let mut p = Columns::default();
        for (j, h) in self.curvature.iter().enumerate() {
            let (above, own) = self.hessian.get(j).map_or((&[][..], 0.0), |column| (&column[..j], column[j]));
            p.push(above.iter().copied().enumerate().chain([(j, own + h)]));
        }
        let (a, p) = (a.matrix(right.len()), p.matrix(n));
        let cones = [ZeroConeT(m), NonnegativeConeT(right.len() - m)];
        let mut solver =
            DefaultSolver::new(&p, &self.gradient, &a, &right, &cones, settings()?).map_err(refused)?;
        solver.solve();
        let found = &solver.solution;
        let near = |row: &Option<usize>| row.is_some_and(|row| found.s[row] < found.z[row]);
        match found.status {
            SolverStatus::Solved | SolverStatus::AlmostSolved => Ok(Outcome::Solved(Solution {
                values: found.x.clone(),
                multipliers: found.z[m..rows.len()].to_vec(),
                active: bound_rows
                    .iter()
                    .map(|[low, high]| match (near(low), near(high)) {
                        (true, _) => Some(Bound::Min),
                        (false, true) => Some(Bound::Max),
                        (false, false) => None,
                    })
                    .collect(),
            })),
            SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => {
                Ok(Outcome::Infeasible(found.z[..m].to_vec()))
            }
            status => Err(TensionError::Solver { status: status.to_string() }),
        }
    }
}

fn settings() -> Result<DefaultSettings<f64>, TensionError> {
    DefaultSettingsBuilder::default()
        .verbose(false)
        .presolve_enable(false)
        .tol_feas(TOLERANCE)
        .tol_gap_abs(TOLERANCE)
        .tol_gap_rel(TOLERANCE)
        .build()
        .map_err(refused)
}

fn refused(error: impl std::fmt::Display) -> TensionError {
    TensionError::Solver { status: error.to_string() }
}

/// A sparse matrix by columns.
struct Columns {
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
}

impl Default for Columns {
    fn default() -> Self {
        Self { starts: vec![0], rows: Vec::new(), values: Vec::new() }
    }
}

impl Columns {
    fn push(&mut self, entries: impl Iterator<Item = (usize, f64)>) {
        for (row, value) in entries {
            self.rows.push(row);
            self.values.push(value);
        }
        self.starts.push(self.rows.len());
    }

    fn matrix(self, rows: usize) -> CscMatrix {
        CscMatrix::new(rows, self.starts.len() - 1, self.starts, self.rows, self.values)
    }
}
