//! Sparse polynomial chaos expansion: a polynomial model of the output, whose coefficients give all Sobol'
//! indices.
//!
//! With products Ψ of the orthonormal polynomials of the inputs ([`crate::measure::expansion::basis`]),
//!
//! ```text
//! y = c_0 + Σ_α c_α Ψ_α(x),   V = Σ c_α²                                 (Ex1)
//! S_u = Σ c_α² / V over the α of the inputs u exactly                    (Ex2)
//! closed_u = Σ c_α² / V over the α of no input beyond u                  (Ex3)
//! T_u = Σ c_α² / V over the α of some input of u                         (Ex4)
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
use crate::measure::expansion::pursuit::{Column, Rows, pursue};
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

/// Sparse expansion (Ex1).
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
    /// Whether derivatives took part in the fit ([`crate::gradient_expansion`]).
    #[serde(default)]
    pub derivatives: bool,
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
    /// Share of the variance that the inputs cause without others, Eq. (Ex3). For one input it is its
    /// first-order index.
    pub closed: f64,
    /// Share of the variance in which the inputs take part, Eq. (Ex4).
    pub total: f64,
}

/// Index of a pair of inputs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct PairShare {
    /// Indices of the inputs, the smaller one first.
    pub inputs: [usize; 2],
    /// Share of the variance that the two cause together, beyond what each causes alone, Eq. (Ex2).
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
    truncation.check()?;
    let observed = Observed::new(design, outputs, Expansion::MIN_OUTPUTS)?;
    let inputs = design.inputs();
    let of_polynomials = |polynomials| fit(inputs, &observed, polynomials, None, truncation);
    best_of(choices(inputs, truncation.max_degree).map(of_polynomials))
}

/// Polynomials of the inputs: of their values and, where there is a choice, of their probabilities.
pub(crate) fn choices(inputs: &[Input], max_degree: usize) -> impl Iterator<Item = Vec<Polynomials>> {
    let of_probability = move |input: &Input| match Polynomials::has_choice(input) {
        true => Polynomials::of_probability(input, max_degree),
        false => Polynomials::new(input, max_degree),
    };
    let has_choice = inputs.iter().any(Polynomials::has_choice);
    let others = move || -> Vec<Polynomials> { inputs.par_iter().map(of_probability).collect() };
    let values: Vec<Polynomials> =
        inputs.par_iter().map(|input| Polynomials::new(input, max_degree)).collect();
    std::iter::once(values).chain(has_choice.then(others))
}

/// The expansion of the least error; of equal ones the first.
pub(crate) fn best_of(
    mut all: impl Iterator<Item = Result<Expansion, SensitivityError>>,
) -> Result<Expansion, SensitivityError> {
    let missing = SensitivityError::OutOfRange { field: "inputs", value: 0, minimum: 1, maximum: u64::MAX };
    let first = all.next().ok_or(missing)??;
    all.try_fold(first, |best, other| {
        let other = other?;
        Ok(if other.leave_one_out < best.leave_one_out { other } else { best })
    })
}

/// Expansion of the degree with the least error, in these polynomials of the inputs.
pub(crate) fn fit(
    inputs: &[Input],
    observed: &Observed,
    polynomials: Vec<Polynomials>,
    slopes: Option<&ScaledSlopes>,
    truncation: Truncation,
) -> Result<Expansion, SensitivityError> {
    let Found { degree, mean, terms, leave_one_out } =
        search(&observed.columns, &observed.outputs, slopes, &polynomials, truncation)?;
    let (inputs, failed, observed) = (inputs.to_vec(), observed.failed, observed.outputs.len());
    let derivatives = slopes.is_some();
    Ok(Expansion { inputs, polynomials, observed, failed, derivatives, degree, mean, terms, leave_one_out })
}

/// Derivatives of the output by each input, one per observation.
pub(crate) struct ScaledSlopes {
    /// By which each derivative is multiplied, in the unit of the input.
    pub(crate) scales: Vec<Vec<f64>>,
    /// The derivatives times these, in the unit of the output.
    pub(crate) slopes: Vec<Vec<f64>>,
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
    slopes: Option<&ScaledSlopes>,
    polynomials: &[Polynomials],
    truncation: Truncation,
) -> Result<Found, SensitivityError> {
    let (n, k) = (outputs.len(), columns.len());
    // values[input][observation][degree]
    let of_input = |(polynomials, column): (&Polynomials, &Vec<f64>)| -> Vec<Vec<f64>> {
        column.iter().map(|&x| polynomials.values(x)).collect()
    };
    let values: Vec<_> = polynomials.par_iter().zip(columns).map(of_input).collect();
    let of_input = |(input, (polynomials, column)): (usize, (&Polynomials, &Vec<f64>))| -> Vec<Vec<f64>> {
        let scales = slopes.into_iter().flat_map(|of| &of.scales[input]);
        let scaled = |(x, scale): (&f64, &f64)| polynomials.slopes(*x).iter().map(|of| scale * of).collect();
        column.iter().zip(scales).map(scaled).collect()
    };
    let derivatives: Vec<_> = polynomials.par_iter().zip(columns).enumerate().map(of_input).collect();
    // The product of a term at an observation, where one input has its derivative.
    let product = |powers: &[Power], i: usize, derived: Option<usize>| -> f64 {
        let of = |power: &Power| match derived == Some(power.input) {
            true => derivatives[power.input][i][power.degree],
            false => values[power.input][i][power.degree],
        };
        powers.iter().map(of).product()
    };
    let column = |powers: &Vec<Power>| {
        let part = |derived| -> Vec<f64> { (0..n).map(|i| product(powers, i, derived)).collect() };
        let of_slopes = powers.iter().filter(|_| slopes.is_some()).map(|power| power.input);
        let mut parts: Vec<_> = of_slopes.map(|input| (input, part(Some(input)))).collect();
        parts.push((if slopes.is_some() { k } else { 0 }, part(None)));
        Column(parts)
    };
    let rows = slopes.into_iter().flat_map(|of| of.slopes.iter().map(Vec::as_slice)).chain([outputs]);
    let rows = Rows(rows.collect());
    // An input of m levels has no polynomials above the degree m - 1.
    let exists = |power: &Power| power.degree <= polynomials[power.input].degree();
    let parts = if slopes.is_some() { 1 + truncation.interactions.min(k) } else { 1 };
    let limit = MAX_VALUES / n / parts;
    let of_degree = |degree| {
        let mut products =
            truncation.products(columns.len(), degree, limit).ok_or(SensitivityError::OutOfRange {
                field: "candidate terms",
                value: limit as u64 + 1,
                minimum: 1,
                maximum: limit as u64,
            })?;
        products.retain(|powers| powers.iter().all(exists));
        let columns: Vec<Column> = products.par_iter().map(column).collect();
        let found = pursue(&columns, &rows);
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

/// Shares (Ex3), (Ex4) of a group of inputs in the variance of terms.
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

    /// Variance V of the expansion, Eq. (Ex1), in the square of the unit of the output.
    #[must_use]
    pub fn variance(&self) -> f64 {
        self.terms.iter().map(|term| term.coefficient * term.coefficient).sum()
    }

    /// Indices of each input in the order of the design. All are 0 if no term improves on the mean.
    #[must_use]
    pub fn indices(&self) -> Vec<Shares> {
        (0..self.inputs.len()).map(|input| shares(&self.terms, &[input])).collect()
    }

    /// Index (Ex2) of each pair of inputs that occurs in a term, in ascending order of the inputs.
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

    /// Predicts the output by the expansion (Ex1) at a row of values of the inputs.
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
