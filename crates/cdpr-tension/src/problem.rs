//! The distribution problem, and why it may have no solution.

use cdpr_robot::{TensionLimits, short};
use nalgebra::{DVector, Matrix6xX, Vector6};

/// A distribution problem (T1).
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a> {
    /// Wrench matrix W, 6 x n [1, m].
    pub wrench_matrix: &'a Matrix6xX<f64>,
    /// Sum w of all wrenches on the platform but the cables' [N, N m].
    pub wrench: Vector6<f64>,
    /// Reference tensions t_ref, n of them [N]; zeros for the least-norm distribution.
    pub reference: &'a [f64],
    /// Bounds of each tension, n of them [N].
    pub limits: &'a [TensionLimits],
}

/// A bound that holds a tension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// The least tension.
    Min,
    /// The greatest tension.
    Max,
}

/// Why there is no distribution.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TensionError {
    /// No tensions within the bounds balance the wrench.
    #[error(
        "no tensions between {} N and {} N balance the wrench: the best of them leave a residual of \
         {force:.3} N and {moment:.3} N m; change the pose, the load or the limits",
        short(*min), short(*max)
    )]
    Infeasible {
        /// Least tension allowed in any cable [N].
        min: f64,
        /// Greatest tension allowed in any cable [N].
        max: f64,
        /// Norm of the residual force in the best attempt [N].
        force: f64,
        /// Norm of the residual moment in the best attempt [N m].
        moment: f64,
        /// The tensions of that attempt [N]: those within the bounds with the least |W t + w|.
        tensions: Vec<f64>,
    },
    /// A value of the problem is not finite, or sizes differ.
    #[error("{field} is {value}: expected {expected}")]
    Invalid {
        /// Field of the problem.
        field: &'static str,
        /// What was given.
        value: String,
        /// What would be right.
        expected: &'static str,
    },
    /// The solver of the quadratic program stopped without an answer.
    #[error("the solver of the quadratic program stopped with status {status}")]
    Solver {
        /// The status it reported.
        status: String,
    },
}

impl Problem<'_> {
    pub(crate) fn validate(&self) -> Result<(), TensionError> {
        let n = self.wrench_matrix.ncols();
        if self.reference.len() != n {
            return Err(TensionError::Invalid {
                field: "reference",
                value: format!("a list of {} tensions", self.reference.len()),
                expected: "one reference tension for each column of the wrench matrix",
            });
        }
        if self.limits.len() != n {
            return Err(TensionError::Invalid {
                field: "limits",
                value: format!("a list of {} limits", self.limits.len()),
                expected: "one pair of limits for each column of the wrench matrix",
            });
        }
        let finite =
            |field, mut values: Box<dyn Iterator<Item = &f64> + '_>| match values.find(|v| !v.is_finite()) {
                Some(value) => {
                    Err(TensionError::Invalid { field, value: value.to_string(), expected: "finite numbers" })
                }
                None => Ok(()),
            };
        finite("wrench_matrix", Box::new(self.wrench_matrix.iter()))?;
        finite("wrench", Box::new(self.wrench.iter()))?;
        finite("reference", Box::new(self.reference.iter()))?;
        match self.limits.iter().find(|l| !(l.min.is_finite() && l.max.is_finite() && l.min <= l.max)) {
            None => Ok(()),
            Some(TensionLimits { min, max }) => {
                let value = format!("{min} N to {max} N");
                Err(TensionError::Invalid {
                    field: "limits",
                    value,
                    expected: "finite limits, the least first",
                })
            }
        }
    }

    /// Residual wrench W t + w_ex [N, N m], Eq. (3).
    pub(crate) fn residual(&self, tensions: &[f64]) -> Vector6<f64> {
        // Eq. (3)
        self.wrench + self.wrench_matrix * DVector::from_column_slice(tensions)
    }

    /// A tension that scales the problem [N], so that the solver's tolerances are relative: the wrench, the
    /// reference or the least tensions, whichever is largest.
    pub(crate) fn scale(&self) -> f64 {
        let force = self.wrench.fixed_rows::<3>(0).norm();
        let least = self.limits.iter().map(|limits| limits.min.abs());
        self.reference.iter().map(|t| t.abs()).chain(least).fold(force, f64::max).max(f64::MIN_POSITIVE)
    }
}
