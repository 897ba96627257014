//! Sparse polynomial expansion of a table.
//!
//! The laws of the inputs are not known. Their polynomials are orthonormal over the values in the table, for
//! each input by itself:
//!
//! ```text
//! Σ_j ψ_m(x_j) ψ_n(x_j) / n = 1 if m = n, 0 otherwise                                 (V1)
//! ```
//!
//! or Legendre's of the ranks, which suit values with long tails; the leave-one-out error decides. (V1): S.
//! Oladyshkin, W. Nowak, *Data-driven uncertainty quantification using the arbitrary polynomial chaos
//! expansion*, Reliab. Eng. Syst. Saf. 106 (2012). Terms, degree and indices are found as in
//! [`crate::measure::expansion`], Eq. (X1) to (X4) there. The inputs must be independent of each other. The
//! indices are those of the polynomial model: a leave-one-out error near 1 says that they mean nothing.

use serde::{Deserialize, Serialize};

use crate::design::input::Input;
use crate::design::observation::Observed;
use crate::error::SensitivityError;
use crate::given::data::GivenData;
use crate::law::Law;
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
    /// Indices of an input, by its number.
    #[must_use]
    pub fn shares(&self, input: usize) -> Shares {
        shares(&self.terms, &[input])
    }
}

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
    let degree = truncation.max_degree;
    let of_values: Vec<Polynomials> =
        observed.columns.iter().map(|column| Polynomials::of_values(column, degree)).collect();
    let by_values = search(&observed.columns, &observed.outputs, None, &of_values, truncation)?;
    let unit = Input::continuous("", Law::Uniform { min: 0.0, max: 1.0 });
    let legendre = vec![Polynomials::new(&unit, degree); observed.columns.len()];
    let n = observed.outputs.len() as f64;
    let share = |column: &Vec<f64>| ranks(column).into_iter().map(|rank| (rank - 0.5) / n).collect();
    let columns: Vec<Vec<f64>> = observed.columns.iter().map(share).collect();
    let by_ranks = search(&columns, &observed.outputs, None, &legendre, truncation)?;
    let of_ranks = by_ranks.leave_one_out < by_values.leave_one_out;
    let Found { degree, mean, terms, leave_one_out } = if of_ranks { by_ranks } else { by_values };
    Ok(GivenExpansion { of_ranks, degree, mean, terms, leave_one_out })
}
