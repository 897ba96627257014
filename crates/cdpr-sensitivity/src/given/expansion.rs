//! Sparse polynomial expansion of a table.
//!
//! The laws of the inputs are not known. Their polynomials are orthonormal over the values in the table, for
//! each input by itself:
//!
//! ```text
//! Σ_j ψ_m(x_j) ψ_n(x_j) / n = 1 if m = n, 0 otherwise                                (Ge1)
//! ```
//!
//! or those of the ranks (Legendre's, but for equal values), which suit values with long tails; the
//! leave-one-out error decides, unless both models are exact to rounding. An input of m levels has m - 1
//! polynomials: a table of a design has those of its levels, exactly orthonormal where it is balanced. (Ge1):
//! S. Oladyshkin, W. Nowak, *Data-driven uncertainty quantification using the arbitrary polynomial chaos
//! expansion*, Reliab. Eng. Syst. Saf. 106 (2012). Terms, degree and indices are found as in
//! [`crate::measure::expansion`], Eq. (Ex1) to (Ex4) there. The inputs must be independent of each other.

use serde::{Deserialize, Serialize};

use crate::design::observation::Observed;
use crate::error::SensitivityError;
use crate::given::data::GivenData;
use crate::measure::expansion::basis::Polynomials;
use crate::measure::expansion::polynomial::Truncation;
use crate::measure::expansion::{Expansion, Found, Shares, Term, search, shares};
use crate::measure::regression::ranks;

/// Expansion of a table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct GivenExpansion {
    /// Whether the polynomials are those of the ranks.
    pub of_ranks: bool,
    /// Chosen degree.
    pub degree: usize,
    /// Mean, in the unit of the output.
    pub mean: f64,
    /// Terms in the order in which they were found.
    pub terms: Vec<Term>,
    /// Corrected leave-one-out error, as a share of the variance of the outputs.
    pub leave_one_out: f64,
}

impl GivenExpansion {
    /// Shares of an input, by its number, in the variance of the outputs: those of the model times what it
    /// explains of them. A model without terms, or with a leave-one-out error above [`MOST_ERROR`], has none.
    #[must_use]
    pub fn shares(&self, input: usize) -> Option<Shares> {
        let explained = 1.0 - self.leave_one_out;
        let Shares { closed, total } = shares(&self.terms, &[input]);
        let scaled = Shares { closed: explained * closed, total: explained * total };
        (!self.terms.is_empty() && self.leave_one_out <= MOST_ERROR).then_some(scaled)
    }
}

/// Largest leave-one-out error at which shares of a model say something of the outputs.
pub const MOST_ERROR: f64 = 0.5;

/// Candidate values (terms times rows) of [`affordable`]: about a second.
const AFFORDABLE: usize = 1 << 22;

/// The largest degree up to 8, with products of two inputs and the norm 0.75, that takes about a second.
#[must_use]
pub fn affordable(inputs: usize, rows: usize) -> Truncation {
    let truncation = |max_degree| Truncation { max_degree, norm: 0.75, interactions: 2 };
    let fits =
        |degree: &usize| truncation(*degree).products(inputs, *degree, AFFORDABLE / rows.max(1)).is_some();
    truncation((2..=8).rev().find(fits).unwrap_or(1))
}

/// Leave-one-out error of a model that is exact to rounding.
const EXACT: f64 = 1e-12;

/// Fits an expansion.
///
/// # Errors
/// As [`crate::expansion`].
pub fn given_expansion(data: &GivenData, truncation: Truncation) -> Result<GivenExpansion, SensitivityError> {
    of_observed(&data.observed(Expansion::MIN_OUTPUTS)?, truncation)
}

pub(crate) fn of_observed(
    observed: &Observed,
    truncation: Truncation,
) -> Result<GivenExpansion, SensitivityError> {
    truncation.check()?;
    let polynomials = |columns: &[Vec<f64>]| -> Vec<Polynomials> {
        columns.iter().map(|column| Polynomials::of_values(column, truncation.max_degree)).collect()
    };
    let found =
        |columns: &[Vec<f64>]| search(columns, &observed.outputs, None, &polynomials(columns), truncation);
    let by_values = found(&observed.columns)?;
    let by_ranks = found(&observed.columns.iter().map(|column| ranks(column)).collect::<Vec<_>>())?;
    let of_ranks = by_ranks.leave_one_out < by_values.leave_one_out && by_values.leave_one_out > EXACT;
    let Found { degree, mean, terms, leave_one_out } = if of_ranks { by_ranks } else { by_values };
    Ok(GivenExpansion { of_ranks, degree, mean, terms, leave_one_out })
}
