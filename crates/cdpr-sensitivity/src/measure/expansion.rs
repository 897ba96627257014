//! Sparse polynomial chaos expansion: a polynomial model of the output, whose coefficients give all Sobol'
//! indices.
//!
//! With products Ψ of the orthonormal polynomials of the inputs ([`crate::measure::expansion::basis`]),
//!
//! ```text
//! y = c_0 + Σ_α c_α Ψ_α(x),   V = Σ c_α²                                  (X1)
//! S_u = Σ c_α² / V over the α of the inputs u exactly                     (X2)
//! closed_u = Σ c_α² / V over the α of no input beyond u                   (X3)
//! T_u = Σ c_α² / V over the α of some input of u                          (X4)
//! ```
//!
//! B. Sudret, *Global sensitivity analysis using polynomial chaos expansions*, Reliab. Eng. Syst. Saf. 93
//! (2008). The corrected leave-one-out error decides which terms are included, up to which degree (see
//! `pursuit`), and whether the polynomials are those of the values of the inputs or of their probabilities.
//! This error is the share of the variance that the model does not predict. The indices are those of the
//! polynomial model: they are as close to those of the true model as it is.

pub mod basis;
pub mod polynomial;
mod pursuit;

use serde::{Deserialize, Serialize};

use crate::design::IndependentSample;
use crate::design::input::Input;
use crate::design::observation::Observed;
use crate::error::{SensitivityError, check_length};
use crate::measure::expansion::basis::Polynomials;
use crate::measure::expansion::polynomial::{Power, Truncation};
use crate::measure::expansion::pursuit::pursue;
use crate::parallel::*;

/// Largest number of values of candidate terms (terms times outputs): 1 GiB.
const MAX_VALUES: usize = 1 << 27;

/// One term of an expansion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Term {
    /// α: inputs of the product and their degrees.
    pub powers: Vec<Power>,
    /// Coefficient `c_α`, in the unit of the output.
    pub coefficient: f64,
}

/// Sparse expansion (X1).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Expansion {
    /// Inputs, in the order of the design.
    pub inputs: Vec<Input>,
    /// Orthonormal polynomials of each input.
    pub polynomials: Vec<Polynomials>,
    /// Number of observations to which the expansion is fitted.
    pub observed: usize,
    /// Number of failed observations.
    pub failed: usize,
    /// Chosen degree.
    pub degree: usize,
    /// Mean `c_0`, in the unit of the output.
    pub mean: f64,
    /// Terms in the order in which they were found.
    pub terms: Vec<Term>,
    /// Corrected leave-one-out error, as a share of the variance of the outputs.
    pub leave_one_out: f64,
}

/// Indices of one input, or of a group of inputs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Shares {
    /// Share of the variance that the inputs cause without others, Eq. (X3). For one input it is its
    /// first-order index.
    pub closed: f64,
    /// Share of the variance in which the inputs take part, Eq. (X4).
    pub total: f64,
}

/// Index of a pair of inputs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct PairShare {
    /// Indices of the inputs, the smaller one first.
    pub inputs: [usize; 2],
    /// Share of the variance that the two cause together, beyond what each causes alone, Eq. (X2).
    pub share: f64,
}

/// Fits an expansion to one output per row of the design, `None` for a failed observation.
///
/// # Errors
/// - [`SensitivityError::InvalidParameter`] for a norm of the truncation outside (0, 1];
/// - [`SensitivityError::OutOfRange`] for a degree of zero or above [`Expansion::MAX_DEGREE`], zero
///   interactions (1 excludes products of several inputs), candidate terms of more than 2^27 values, or fewer
///   than [`Expansion::MIN_OUTPUTS`] outputs;
/// - [`SensitivityError::LengthMismatch`] unless there is one output per row;
/// - [`SensitivityError::NotFinite`] for a value that is not finite;
/// - [`SensitivityError::ConstantSample`] if all outputs are equal.
pub fn expansion<D: IndependentSample>(
    design: &D,
    outputs: &[Option<f64>],
    truncation: Truncation,
) -> Result<Expansion, SensitivityError> {
    let max_degree = truncation.max_degree;
    truncation.check()?;
    let observed = Observed::new(design, outputs, Expansion::MIN_OUTPUTS)?;
    let inputs = design.inputs();
    let values = inputs.par_iter().map(|input| Polynomials::new(input, max_degree)).collect();
    let best = fit(inputs, &observed, values, truncation)?;
    if !inputs.iter().any(Polynomials::has_choice) {
        return Ok(best);
    }
    let of_probability = |input: &Input| match Polynomials::has_choice(input) {
        true => Polynomials::of_probability(input, max_degree),
        false => Polynomials::new(input, max_degree),
    };
    let other = fit(inputs, &observed, inputs.par_iter().map(of_probability).collect(), truncation)?;
    Ok(if other.leave_one_out < best.leave_one_out { other } else { best })
}

/// Expansion of the degree with the least error, in these polynomials of the inputs.
fn fit(
    inputs: &[Input],
    observed: &Observed,
    polynomials: Vec<Polynomials>,
    truncation: Truncation,
) -> Result<Expansion, SensitivityError> {
    let Found { degree, mean, terms, leave_one_out } =
        search(&observed.columns, &observed.outputs, &polynomials, truncation)?;
    let (inputs, failed, observed) = (inputs.to_vec(), observed.failed, observed.outputs.len());
    Ok(Expansion { inputs, polynomials, observed, failed, degree, mean, terms, leave_one_out })
}

/// What [`search`] finds, as an [`Expansion`] has it.
pub(crate) struct Found {
    pub(crate) degree: usize,
    pub(crate) mean: f64,
    pub(crate) terms: Vec<Term>,
    pub(crate) leave_one_out: f64,
}

/// The terms of the degree with the least error, in these polynomials of columns of values.
pub(crate) fn search(
    columns: &[Vec<f64>],
    outputs: &[f64],
    polynomials: &[Polynomials],
    truncation: Truncation,
) -> Result<Found, SensitivityError> {
    let n = outputs.len();
    // values[input][observation][degree]
    let of_input = |(polynomials, column): (&Polynomials, &Vec<f64>)| -> Vec<Vec<f64>> {
        column.iter().map(|&x| polynomials.values(x)).collect()
    };
    let values: Vec<_> = polynomials.par_iter().zip(columns).map(of_input).collect();
    let column = |powers: &Vec<Power>| -> Vec<f64> {
        let value = |i: usize| powers.iter().map(|power| values[power.input][i][power.degree]).product();
        (0..n).map(value).collect()
    };
    // An input of m levels has no polynomials above the degree m - 1.
    let exists = |power: &Power| power.degree <= polynomials[power.input].degree();
    let limit = MAX_VALUES / n;
    let of_degree = |degree| {
        let mut products =
            truncation.products(columns.len(), degree, limit).ok_or(SensitivityError::OutOfRange {
                field: "candidate terms",
                value: limit as u64 + 1,
                minimum: 1,
                maximum: limit as u64,
            })?;
        products.retain(|powers| powers.iter().all(exists));
        let columns: Vec<Vec<f64>> = products.par_iter().map(column).collect();
        let found = pursue(&columns, outputs);
        let term = |(j, coefficient): (usize, f64)| Term { powers: products[j].clone(), coefficient };
        let terms = found.terms.into_iter().map(term).collect();
        Ok(Found { degree, mean: found.constant, terms, leave_one_out: found.error })
    };
    let mut best = of_degree(1)?;
    for degree in 2..=truncation.max_degree {
        let other = of_degree(degree)?;
        if other.leave_one_out < best.leave_one_out {
            best = other;
        }
    }
    Ok(best)
}

/// Shares (X3), (X4) of a group of inputs in the variance of terms.
pub(crate) fn shares(terms: &[Term], group: &[usize]) -> Shares {
    let variance: f64 = terms.iter().map(|term| term.coefficient * term.coefficient).sum();
    let (mut closed, mut total) = (0.0, 0.0);
    for term in terms {
        let share = term.coefficient * term.coefficient / variance;
        let member = |power: &Power| group.contains(&power.input);
        if term.powers.iter().all(member) {
            closed += share;
        }
        if term.powers.iter().any(member) {
            total += share;
        }
    }
    Shares { closed, total }
}

impl Expansion {
    /// Least number of outputs that an expansion is fitted to.
    pub const MIN_OUTPUTS: usize = 10;
    /// Largest degree of an expansion.
    pub const MAX_DEGREE: usize = Truncation::MAX_DEGREE;

    /// Variance V of the expansion, Eq. (X1), in the square of the unit of the output.
    #[must_use]
    pub fn variance(&self) -> f64 {
        self.terms.iter().map(|term| term.coefficient * term.coefficient).sum()
    }

    /// Indices of each input in the order of the design. All are 0 if no term improves on the mean.
    #[must_use]
    pub fn indices(&self) -> Vec<Shares> {
        (0..self.inputs.len()).map(|input| shares(&self.terms, &[input])).collect()
    }

    /// Index (X2) of each pair of inputs that occurs in a term, in ascending order of the inputs.
    #[must_use]
    pub fn pairs(&self) -> Vec<PairShare> {
        let variance = self.variance();
        let mut pairs = std::collections::BTreeMap::new();
        for term in &self.terms {
            if let [one, other] = term.powers[..] {
                let share = term.coefficient * term.coefficient / variance;
                *pairs.entry([one.input, other.input]).or_insert(0.0) += share;
            }
        }
        pairs.into_iter().map(|(inputs, share)| PairShare { inputs, share }).collect()
    }

    /// Indices of a group of inputs, by their names.
    ///
    /// # Errors
    /// [`SensitivityError::UnknownInput`] for a name that no input has.
    pub fn group(&self, names: &[&str]) -> Result<Shares, SensitivityError> {
        let index = |name: &&str| {
            let found = self.inputs.iter().position(|input| input.name == *name);
            found.ok_or_else(|| SensitivityError::UnknownInput { name: (*name).to_owned() })
        };
        Ok(shares(&self.terms, &names.iter().map(index).collect::<Result<Vec<_>, _>>()?))
    }

    /// Predicts the output by the expansion (X1) at a row of values of the inputs.
    ///
    /// # Errors
    /// [`SensitivityError::LengthMismatch`] unless the row has one element per input.
    pub fn predict(&self, row: &[f64]) -> Result<f64, SensitivityError> {
        check_length("row", row.len(), self.inputs.len())?;
        let values: Vec<_> = self.polynomials.iter().zip(row).map(|(psi, &x)| psi.values(x)).collect();
        let of_term = |term: &Term| {
            let factors = term.powers.iter().map(|power| values[power.input][power.degree]);
            term.coefficient * factors.product::<f64>()
        };
        Ok(self.mean + self.terms.iter().map(of_term).sum::<f64>())
    }
}
