//! Tensions within limits that balance a wrench: the problem, what is chosen, and why there may be none.

use cdpr_robot::{TensionLimits, short};
use nalgebra::{DMatrix, DVector};

/// Tensions t within limits that balance a wrench w, (T1).
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a> {
    /// Wrench matrix W: a row for each component of the wrench, a column for each cable [1, m].
    pub wrench_matrix: &'a DMatrix<f64>,
    /// Sum w of all wrenches on the platform but the cables' [N, N m].
    pub wrench: &'a DVector<f64>,
    /// Limits of each tension, the least zero or more [N].
    pub limits: &'a [TensionLimits],
}

/// What is chosen among the tensions that balance the wrench.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Objective<'a> {
    /// The least `|t - r|` for a reference r [N]; zeros for the least 2-norm.
    Nearest(&'a [f64]),
    /// The least sum of tensions, their 1-norm.
    LeastSum,
    /// The least greatest tension, their infinity-norm.
    LeastGreatest,
    /// The greatest multiple z of a wrench d that is balanced, too: `W t + w + z d = 0`, z >= 0.
    GreatestWrench(&'a DVector<f64>),
    /// The greatest distance z of all tensions from limits of their own: `min_i + z <= t_i <= max_i - z`. It
    /// is negative where these limits leave no balance.
    GreatestMargin(&'a [TensionLimits]),
}

/// A bound that holds a tension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// The least tension.
    Min,
    /// The greatest tension.
    Max,
}

impl Bound {
    /// The least tension, then the greatest.
    pub const BOTH: [Self; 2] = [Self::Min, Self::Max];
}

/// Why there is no distribution.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TensionError {
    /// No tensions within the limits balance the wrench.
    #[error(
        "no tensions between {} N and {} N balance the wrench: the nearest leave a residual of {residual:.3} \
         N; change the pose, the load or the limits",
        short(*min), short(*max)
    )]
    Infeasible {
        /// Least tension allowed in any cable [N].
        min: f64,
        /// Greatest tension allowed in any cable [N].
        max: f64,
        /// `|W t + w|` of the nearest tensions, 1 N as much as 1 N m [N].
        residual: f64,
        /// The tensions within the limits with the least residual [N].
        tensions: Vec<f64>,
        /// The proof: a unit wrench y with `y·(W t + w) > 0` for all tensions within the limits.
        certificate: DVector<f64>,
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
    /// Clarabel stopped with neither a solution nor a proof of infeasibility.
    #[error("the solver of the tensions stopped with status {status}")]
    Solver {
        /// The status it reported.
        status: String,
    },
}

impl TensionError {
    fn invalid(field: &'static str, value: String, expected: &'static str) -> Self {
        Self::Invalid { field, value, expected }
    }
}

impl Problem<'_> {
    pub(crate) fn validate(&self, objective: &Objective) -> Result<(), TensionError> {
        let (rows, n) = self.wrench_matrix.shape();
        check_length("wrench", self.wrench.len(), rows, "one component for each row of the wrench matrix")?;
        check_length("limits", self.limits.len(), n, PER_COLUMN)?;
        check_finite("wrench_matrix", self.wrench_matrix.as_slice())?;
        check_finite("wrench", self.wrench.as_slice())?;
        check_limits("limits", self.limits)?;
        match objective {
            Objective::Nearest(reference) => {
                check_length("reference", reference.len(), n, PER_COLUMN)?;
                check_finite("reference", reference)
            }
            Objective::GreatestWrench(direction) => {
                check_length("direction", direction.len(), rows, "one component for each row")?;
                check_finite("direction", direction.as_slice())
            }
            Objective::GreatestMargin(limits) => {
                check_length("margin", limits.len(), n, PER_COLUMN)?;
                check_limits("margin", limits)
            }
            Objective::LeastSum | Objective::LeastGreatest => Ok(()),
        }
    }

    /// The tensions nearest to a reference [N] without regard to limits, the closed form (T2) [N]; `None`
    /// if W does not have full rank.
    pub fn closed_form(&self, reference: &[f64]) -> Option<DVector<f64>> {
        let w = self.wrench_matrix;
        let gram = w * w.transpose();
        // W Wᵀ has elements in 1, m and m²: its diagonal scales it.
        let scale = gram.diagonal().map(|d| 1.0 / d.sqrt());
        let scaled = gram.component_mul(&(&scale * scale.transpose()));
        let cholesky = scaled.cholesky()?;
        if cholesky.l_dirty().diagonal().min() < 1e-7 {
            return None;
        }
        let residual = self.residual(reference);
        let multipliers = cholesky.solve(&residual.component_mul(&scale)).component_mul(&scale);
        Some(DVector::from_column_slice(reference) - w.tr_mul(&multipliers))
    }

    /// Residual wrench W t + w [N, N m], Eq. (3).
    pub(crate) fn residual(&self, tensions: &[f64]) -> DVector<f64> {
        self.wrench + self.wrench_matrix * DVector::from_column_slice(tensions)
    }

    /// A unit of force [N] in which the numbers of the problem are near one.
    pub(crate) fn unit(&self, reference: &[f64]) -> f64 {
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |a: f64, b| a.max(b.abs()));
        let demanded = largest(&mut self.limits.iter().map(|limits| limits.min));
        let size = demanded.max(self.wrench.amax()).max(largest(&mut reference.iter().copied()));
        if size > 0.0 { size } else { largest(&mut self.limits.iter().map(|limits| limits.max)).max(1.0) }
    }

    /// Whether `y·(W t + w)` is clearly positive for all tensions within the limits, so that none balance the
    /// wrench: the inequality of Farkas, in floating point with a margin far above its rounding.
    pub(crate) fn refuted_along(&self, y: &DVector<f64>) -> bool {
        /// Share of the sum of the sizes of all terms.
        const MARGIN: f64 = 1e-9;
        let along = self.wrench_matrix.tr_mul(y);
        let [mut least, mut size] = [y.dot(self.wrench), y.component_mul(self.wrench).abs().sum()];
        for (slope, TensionLimits { min, max }) in along.iter().zip(self.limits) {
            let term = if *slope < 0.0 { slope * max } else { slope * min };
            least += term;
            size += term.abs();
        }
        least > MARGIN * size
    }
}

const PER_COLUMN: &str = "one for each column of the wrench matrix";

fn check_length(
    field: &'static str,
    length: usize,
    expected: usize,
    rule: &'static str,
) -> Result<(), TensionError> {
    if length == expected {
        return Ok(());
    }
    Err(TensionError::invalid(field, format!("a list of length {length}"), rule))
}

fn check_finite(field: &'static str, values: &[f64]) -> Result<(), TensionError> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(value) => Err(TensionError::invalid(field, value.to_string(), "finite numbers")),
        None => Ok(()),
    }
}

fn check_limits(field: &'static str, limits: &[TensionLimits]) -> Result<(), TensionError> {
    let valid =
        |limits: &&TensionLimits| 0.0 <= limits.min && limits.min <= limits.max && limits.max.is_finite();
    match limits.iter().find(|limits| !valid(limits)) {
        None => Ok(()),
        Some(TensionLimits { min, max }) => Err(TensionError::invalid(
            field,
            format!("{min} N to {max} N"),
            "finite tensions of zero or more, the least first",
        )),
    }
}
