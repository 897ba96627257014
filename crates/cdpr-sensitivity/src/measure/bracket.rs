//! Bounds of Sobol' indices on both sides, from outputs and their derivatives.
//!
//! With `e_n` the eigenfunctions of Poincaré's inequality for the law of input i, their eigenvalues `λ_n`,
//! and ψ the orthonormal polynomials of an input whose eigenfunctions have no closed form,
//!
//! ```text
//! uniform:  e_n = √2 cos(n π u),   λ_n = (n π / (max - min))²,   u = (x - min) / (max - min)     (Br1)
//! normal:   e_n = He_n(ξ) / √n!,   λ_n = n / std²,   ξ = (x - mean) / std
//! c_n = E f e_n = E (∂f/∂x_i e_n') / λ_n,   c_ij = E f e_1(x_i) e_1(x_j)                          (Br2)
//! Σ_n c_n² <= S_i V,   Σ_n c_n² + Σ_j c_ij² <= T_i V                                             (Br3)
//! T_i V <= ν_i / λ_1 - Σ_n c_n² (λ_n / λ_1 - 1),   ν_i = E (∂f/∂x_i)²                      (Br4)
//! T_i <= 1 - Σ_(j ≠ i) S_j                                                                          (Br5)
//! others:   c_n = E f ψ_n,   T_i V <= C_i ν_i (see `dgsm`)
//! ```
//!
//! - (Br2), (Br3): O. Roustant, F. Gamboa, B. Iooss, *Parseval inequalities and lower bounds for
//!   variance-based sensitivity indices*, Electron. J. Stat. 14 (2020). Each c² is a share of the variance
//!   that input i causes, and different ones do not overlap.
//! - (Br4): the part of f that depends on `x_i` is a sum over the `e_n`, the derivative has the same sum with
//!   weights `λ_n`. What (Br3) knows to be at n > 1 has used more of ν than its share. For one input
//!   without any known part this is the bound of `dgsm`. (Br5): the closed index of all other inputs is at
//!   least the sum of their first-order indices.
//! - Derivatives of models that are nearly linear vary little. Their mean is therefore separated, E (b e_n')
//!   = b E e_n' being known, and in the variance likewise the square of the linear part.
//! - A square of an estimate is too large by its variance, which is subtracted. Intervals are those of a
//!   jackknife over 20 groups of rows (B. Efron, C. Stein, *The jackknife estimate of variance*, 1981) for
//!   independent rows; those of a scrambled sequence scatter less. The upper bounds are means of squares,
//!   whose law is skewed: they have the interval of a positive estimate ([`crate::sample::interval`], Eq.
//!   (CI6)).
//! - Each upper bound has an interval of its own, and the lower upper end decides. The least of two estimates
//!   would be too small: (Br5) is a difference that scatters by the error of V, however small `T_i` is.
//! - Where few rows decide ν, most samples miss those that would decide it, and their interval is too short:
//!   (Br4) counts only where [`DerivativeMeasure::reliable`] is true. (Br5), which has no derivative with
//!   respect to `x_i`, bounds the others.
//!
//! The bounds are those of a continuous output and of independent inputs with the laws that they are given.
//! They are refused where an observation failed, because the inputs of the others have other laws; where
//! steps change the variance of an input by more than 1 % (shorter ones count as a wider law); and where the
//! upper bounds of all inputs add up to less than 1, because
//! total indices do not: the output jumps, and its derivatives do not see it. No unit.

use std::f64::consts::{PI, SQRT_2};

use rand::seq::SliceRandom;
use serde::{Deserialize, Serialize};

use crate::design::IndependentSample;
use crate::design::input::Input;
use crate::error::{SensitivityError, check_level, check_range};
use crate::law::Law;
use crate::measure::dgsm::{DerivativeMeasure, Slopes, checked};
use crate::measure::expansion::basis::Polynomials;
use crate::measure::poincare::poincare_constant;
use crate::parallel::*;
use crate::sample::interval::Estimate;
use crate::sample::random::stream;
use crate::sample::summary::{Spread, check_varies};

/// Bounds of the indices of one input.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Bracket {
    /// Name of the input.
    pub input: String,
    /// Lower bound (Br3) of its first-order index.
    pub first_lower: Estimate,
    /// Lower bound (Br3) of its total index.
    pub total_lower: Estimate,
    /// Upper bound (Br4) or (Br5) of its total index, which is one of its first-order index, too: that of the
    /// lower upper end.
    pub total_upper: Estimate,
}

/// Functions of an input, and polynomials of an input without known eigenfunctions.
const FUNCTIONS: usize = 10;
const POLYNOMIALS: usize = 2;
/// Groups of rows of the jackknife.
const GROUPS: usize = 20;

/// Estimates the bounds from the output and gradient at each row of a design, `None` for a failed
/// observation.
///
/// The intervals have the confidence `level` in (0, 1). The seed deals the rows to the groups of the
/// jackknife.
///
/// # Errors
/// As [`crate::dgsm`]; [`SensitivityError::OutOfRange`] for fewer than 40 observations;
/// [`SensitivityError::Failed`], [`SensitivityError::Stepped`] and [`SensitivityError::Jumps`] where the
/// bounds do not hold.
pub fn brackets<D: IndependentSample>(
    design: &D,
    slopes: &[Option<Slopes>],
    level: f64,
    seed: u64,
) -> Result<Vec<Bracket>, SensitivityError> {
    check_level(level)?;
    checked(design, slopes)?;
    let inputs = design.inputs();
    let failed = slopes.iter().filter(|slopes| slopes.is_none()).count();
    if failed > 0 {
        return Err(SensitivityError::Failed { failed, count: slopes.len() });
    }
    if let Some(input) = inputs.iter().find(|input| input.is_coarse()) {
        return Err(SensitivityError::Stepped { input: input.name.clone() });
    }
    let (mut rows, mut observed) = (Vec::new(), Vec::new());
    for (index, slopes) in slopes.iter().enumerate().filter_map(|(i, slopes)| Some((i, slopes.as_ref()?))) {
        let mut row = vec![0.0; inputs.len()];
        design.row(index, &mut row)?;
        rows.push(row);
        observed.push(slopes);
    }
    check_range("observed outputs", observed.len() as u64, 2 * GROUPS as u64, u64::MAX)?;
    let outputs: Vec<f64> = observed.iter().map(|slopes| slopes.output).collect();
    check_varies(&outputs)?;
    let column = |i: usize| -> Column {
        let values: Vec<f64> = rows.iter().map(|row| row[i]).collect();
        let slopes: Vec<f64> = observed.iter().map(|slopes| slopes.gradient[i]).collect();
        Column::new(&inputs[i], &values, slopes)
    };
    let columns: Vec<Column> = (0..inputs.len()).into_par_iter().map(column).collect();
    let table = Table { columns, outputs };

    let mut all: Vec<usize> = (0..observed.len()).collect();
    let whole = table.bounds(&all);
    all.shuffle(&mut stream(seed, 0));
    let without = |group: usize| {
        let kept = all.iter().enumerate().filter(|(place, _)| place % GROUPS != group);
        table.bounds(&kept.map(|(_, &row)| row).collect::<Vec<_>>())
    };
    let parts: Vec<Vec<Bounds>> = (0..GROUPS).into_par_iter().map(without).collect();
    let bracket = |(i, input): (usize, &Input)| {
        let (groups, whole) = (GROUPS as f64, &whole[i]);
        let variance = |of: fn(&Bounds) -> f64| {
            let values: Vec<f64> = parts.iter().map(|part| of(&part[i])).collect();
            (groups - 1.0) / groups * Spread::of(&values).squares
        };
        let below =
            |of: fn(&Bounds) -> f64| Estimate::of_variance(of(whole), variance(of), groups - 1.0, level);
        let above =
            |of: fn(&Bounds) -> f64| Estimate::of_positive(of(whole), variance(of), groups - 1.0, level);
        let squares: Vec<f64> = table.columns[i].slopes.iter().map(|slope| slope * slope).collect();
        let mut upper = above(|of| of.by_others)?;
        if whole.by_slopes.is_finite() && DerivativeMeasure::is_reliable(&squares) {
            let by_slopes = above(|of| of.by_slopes)?;
            upper = if by_slopes.high < upper.high { by_slopes } else { upper };
        }
        let share = |value: f64| value.clamp(0.0, 1.0);
        let first_lower = below(|of| of.first)?;
        // Many interactions of a small input are mostly noise: where they contradict the upper bound, the
        // first-order part is what is known of the total index, too.
        let total = below(|of| of.total)?;
        let total_lower = if total.low > upper.high { first_lower } else { total };
        Ok(Bracket {
            input: input.name.clone(),
            first_lower,
            total_lower,
            total_upper: Estimate { value: share(upper.value), low: upper.low, high: upper.high.min(1.0) },
        })
    };
    let found: Vec<Bracket> = inputs.iter().enumerate().map(bracket).collect::<Result<_, _>>()?;
    let sum: f64 = found.iter().map(|of| of.total_upper.high).sum();
    if sum < 1.0 - f64::EPSILON.sqrt() {
        return Err(SensitivityError::Jumps { sum });
    }
    Ok(found)
}

/// Bounds of one input as shares of the variance.
struct Bounds {
    /// (Br3) of S and of T.
    first: f64,
    total: f64,
    /// (Br4) of T, infinite for a law without a constant.
    by_slopes: f64,
    /// (Br5).
    by_others: f64,
}

/// What is known of one input at each row.
struct Column {
    /// ∂f/∂x.
    slopes: Vec<f64>,
    /// Mean and deviation of the law.
    std: f64,
    centred: Vec<f64>,
    basis: Basis,
}

/// Functions of an input at each row.
enum Basis {
    /// Eigenfunctions.
    Eigen {
        /// `e_1`.
        first: Vec<f64>,
        /// For each n: `λ_n`, `e_n'` at each row, and its mean under the law.
        derived: Vec<(f64, Vec<f64>, f64)>,
    },
    /// Polynomials `ψ_1`, .. and the constant C of Poincaré's inequality, if there is one.
    Polynomials { values: Vec<Vec<f64>>, constant: Option<f64> },
}

impl Column {
    fn new(input: &Input, values: &[f64], slopes: Vec<f64>) -> Self {
        let law = input.smooth_law();
        let mean = law.mean();
        let basis = match law {
            Law::Uniform { min, max } => {
                let place = |x: &f64| (x - min) / (max - min);
                let derived = (1..=FUNCTIONS).map(|n| {
                    let root = n as f64 * PI / (max - min);
                    let slope = |x: &f64| -SQRT_2 * root * (n as f64 * PI * place(x)).sin();
                    // The difference of e_n over the range.
                    let mean = if n % 2 == 1 { -2.0 * SQRT_2 / (max - min) } else { 0.0 };
                    (root * root, values.iter().map(slope).collect(), mean)
                });
                let first = values.iter().map(|x| SQRT_2 * (PI * place(x)).cos()).collect();
                Basis::Eigen { first, derived: derived.collect() }
            }
            Law::Normal { std, .. } => {
                let hermite = Polynomials::new(&Input::continuous("", law), POLYNOMIALS);
                let all: Vec<Vec<f64>> = values.iter().map(|&x| hermite.values(x)).collect();
                // e_n' = √n e_(n-1) / std.
                let derived = (1..=POLYNOMIALS).map(|n| {
                    let slope = |all: &Vec<f64>| (n as f64).sqrt() * all[n - 1] / std;
                    let mean = if n == 1 { 1.0 / std } else { 0.0 };
                    (n as f64 / (std * std), all.iter().map(slope).collect(), mean)
                });
                let derived = derived.collect();
                Basis::Eigen { first: all.iter().map(|all| all[1]).collect(), derived }
            }
            _ => {
                let psi = Polynomials::new(&Input::continuous("", law), POLYNOMIALS);
                let all: Vec<Vec<f64>> = values.iter().map(|&x| psi.values(x)).collect();
                let values = (1..=psi.degree()).map(|n| all.iter().map(|all| all[n]).collect()).collect();
                Basis::Polynomials { values, constant: poincare_constant(&law) }
            }
        };
        Self { slopes, std: law.std(), centred: values.iter().map(|x| x - mean).collect(), basis }
    }

    /// The function by which pairs are formed.
    fn first(&self) -> &[f64] {
        match &self.basis {
            Basis::Eigen { first, .. } => first,
            Basis::Polynomials { values, .. } => &values[0],
        }
    }
}

struct Table {
    columns: Vec<Column>,
    outputs: Vec<f64>,
}

impl Table {
    /// Bounds of each input from some rows.
    fn bounds(&self, rows: &[usize]) -> Vec<Bounds> {
        let slopes: Vec<f64> =
            self.columns.iter().map(|column| mean(rows.iter().map(|&row| column.slopes[row]))).collect();
        let rest = self.without_linear_part(rows, &slopes);
        let variance = self.variance(rows, &rest, &slopes);
        let alone: Vec<(f64, Option<f64>)> =
            (0..slopes.len()).map(|i| self.alone(i, rows, &rest, slopes[i])).collect();
        let k = slopes.len();
        let mut pairs = vec![0.0; k];
        for i in 0..k {
            for j in i + 1..k {
                let square = self.pair([i, j], rows, &rest, &slopes);
                pairs[i] += square;
                pairs[j] += square;
            }
        }
        let sum: f64 = alone.iter().map(|(lower, _)| lower.max(0.0)).sum();
        let bounds = |i: usize| {
            let (lower, upper) = (alone[i].0.max(0.0), alone[i].1.unwrap_or(f64::INFINITY));
            Bounds {
                first: lower / variance,
                total: (lower + pairs[i].max(0.0)) / variance,
                by_slopes: upper / variance,
                by_others: 1.0 - (sum - lower) / variance,
            }
        };
        (0..k).map(bounds).collect()
    }

    /// Outputs of the rows about their mean, less the linear part with the mean slopes.
    fn without_linear_part(&self, rows: &[usize], slopes: &[f64]) -> Vec<f64> {
        let linear = |row: usize| -> f64 {
            self.columns.iter().zip(slopes).map(|(column, slope)| slope * column.centred[row]).sum()
        };
        let mut rest: Vec<f64> = rows.iter().map(|&row| self.outputs[row] - linear(row)).collect();
        let mean = mean(rest.iter().copied());
        rest.iter_mut().for_each(|rest| *rest -= mean);
        rest
    }

    /// Variance of the output: that of the outputs, or with the exact variance of the linear part, whichever
    /// scatters less.
    fn variance(&self, rows: &[usize], rest: &[f64], slopes: &[f64]) -> f64 {
        let outputs: Vec<f64> = rows.iter().map(|&row| self.outputs[row]).collect();
        let spread = Spread::of(&outputs);
        let linear: f64 =
            self.columns.iter().zip(slopes).map(|(column, slope)| (slope * column.std).powi(2)).sum();
        let square = |(y, rest): (&f64, &f64)| {
            let (y, part) = (y - spread.mean, y - spread.mean - rest);
            [y * y, y * y - part * part]
        };
        let squares: Vec<[f64; 2]> = outputs.iter().zip(rest).map(square).collect();
        let [plain, reduced] = [0, 1].map(|of| {
            let values: Vec<f64> = squares.iter().map(|squares| squares[of]).collect();
            Spread::of(&values)
        });
        let by_parts = linear + reduced.mean;
        if reduced.variance() < plain.variance() && by_parts > 0.0 { by_parts } else { spread.variance() }
    }

    /// Lower bound (Br3) of S V and upper bound (Br4) of T V, if there is one.
    fn alone(&self, i: usize, rows: &[usize], rest: &[f64], slope: f64) -> (f64, Option<f64>) {
        let Column { slopes, basis, std, .. } = &self.columns[i];
        let nu = mean(rows.iter().map(|&row| slopes[row] * slopes[row]));
        match basis {
            Basis::Eigen { derived, .. } => {
                let lowest = derived[0].0;
                let (mut lower, mut upper) = (0.0, nu / lowest);
                for (lambda, derivative, of_one) in derived {
                    let terms = rows.iter().map(|&row| (slopes[row] - slope) * derivative[row]);
                    let square = unbiased_square(terms, slope * of_one) / (lambda * lambda);
                    lower += square;
                    upper -= square * (lambda / lowest - 1.0);
                }
                (lower, Some(upper))
            }
            Basis::Polynomials { values, constant } => {
                let mut lower = 0.0;
                for (n, psi) in values.iter().enumerate() {
                    let terms = rows.iter().zip(rest).map(|(&row, rest)| rest * psi[row]);
                    lower += unbiased_square(terms, if n == 0 { slope * std } else { 0.0 });
                }
                (lower, constant.map(|constant| constant * nu))
            }
        }
    }

    /// `c_ij²` of a pair, by derivatives of each input that has eigenfunctions.
    fn pair(&self, pair: [usize; 2], rows: &[usize], rest: &[f64], mean_slopes: &[f64]) -> f64 {
        let [one, other] = pair.map(|i| &self.columns[i]);
        let by = |of: &Column, with: &Column, slope: f64, row: usize| match &of.basis {
            Basis::Eigen { derived, .. } => {
                let (lambda, derivative, _) = &derived[0];
                Some((of.slopes[row] - slope) * derivative[row] * with.first()[row] / lambda)
            }
            Basis::Polynomials { .. } => None,
        };
        let term = |(&row, rest): (&usize, &f64)| {
            let found =
                [by(one, other, mean_slopes[pair[0]], row), by(other, one, mean_slopes[pair[1]], row)];
            match found {
                [Some(one), Some(other)] => 0.5 * (one + other),
                [Some(only), None] | [None, Some(only)] => only,
                [None, None] => rest * one.first()[row] * other.first()[row],
            }
        };
        unbiased_square(rows.iter().zip(rest).map(term), 0.0)
    }
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let n = values.len() as f64;
    values.sum::<f64>() / n
}

/// Square of the mean of terms and a known part, less the variance of that mean.
fn unbiased_square(terms: impl Iterator<Item = f64>, known: f64) -> f64 {
    let (mut n, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for term in terms {
        n += 1.0;
        sum += term;
        squares += term * term;
    }
    let mean = sum / n;
    let variance = (squares - n * mean * mean).max(0.0) / (n - 1.0);
    (mean + known).powi(2) - variance / n
}
