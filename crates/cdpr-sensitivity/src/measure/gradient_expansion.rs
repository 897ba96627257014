//! Polynomial chaos expansion fitted to values and derivatives together.
//!
//! The expansion ([`crate::measure::expansion`], Eq. (Ex1)) is the least-squares solution of all equations
//!
//! ```text
//! y(x) = Σ c_α Ψ_α(x),   √τ_i(x_i) ∂y/∂x_i = √τ_i(x_i) Σ c_α ∂Ψ_α/∂x_i        (GE1)
//! τ(x) = (1 / p(x)) ∫_x^∞ (t - mean) p(t) dt,   E τ = std²                      (GE2)
//! uniform:  τ = (x - min) (max - x) / 2           normal:  τ = std²
//! beta:     τ = (x - min) (max - x) / (alpha + beta)
//! E τ ψ_m' ψ_n' = 0 for m ≠ n,   E τ ψ_1'² = 1                                          (GE3)
//! ```
//!
//! at each point: k + 1 of them, where k is the number of inputs.
//!
//! - (GE1): J. Peng, J. Hampton, A. Doostan, *On polynomial chaos expansion via gradient-enhanced
//!   l1-minimization*, J. Comput. Phys. 310 (2016), for normal inputs, where √τ is the standard deviation;
//!   L. Guo, A. Narayan, T. Zhou, *A gradient enhanced l1-minimization for sparse approximation of polynomial
//!   chaos expansions*, J. Comput. Phys. 367 (2018), for beta laws, with derivatives weighted so that they
//!   are orthogonal again. (GE2), the kernel of C. Stein (1986), is the weight of both and gives one for
//!   any other law.
//! - (GE3) holds for the laws of K. Pearson, of which the uniform, the normal, the beta and the
//!   exponential one are in use here. The columns of (GE1) are orthogonal in the mean then, and a
//!   derivative counts as much as a value in a linear term, more in a curved one.
//! - The leave-one-out error leaves out a point with all of its equations, and judges its value. The
//!   expansion of the values alone is the other choice: where it has the smaller error, it is the
//!   result. Derivatives then do not pay, such as at a kink, or where terms are missing whose slopes are
//!   steep.
//!
//! The steps of an input are disregarded in τ and in the derivatives.

use crate::design::IndependentSample;
use crate::design::input::Input;
use crate::design::observation::Observed;
use crate::error::SensitivityError;
use crate::law::Law;
use crate::measure::dgsm::{Slopes, checked};
use crate::measure::expansion::basis::{Polynomials, quadrature};
use crate::measure::expansion::polynomial::Truncation;
use crate::measure::expansion::{Expansion, ScaledSlopes, best_of, choices, expansion, fit};
use crate::parallel::*;

/// Fits an expansion to the output and gradient at each row of a design, `None` for a failed observation.
///
/// [`Expansion::derivatives`] says whether the derivatives took part.
///
/// # Errors
/// As [`crate::expansion`] and [`crate::dgsm`].
pub fn gradient_expansion<D: IndependentSample>(
    design: &D,
    slopes: &[Option<Slopes>],
    truncation: Truncation,
) -> Result<Expansion, SensitivityError> {
    checked(design, slopes)?;
    let outputs: Vec<Option<f64>> = slopes.iter().map(|of| of.as_ref().map(|of| of.output)).collect();
    let plain = expansion(design, &outputs, truncation)?;
    let observed = Observed::new(design, &outputs, Expansion::MIN_OUTPUTS)?;
    let inputs = design.inputs();
    let gradients: Vec<&Slopes> = slopes.iter().flatten().collect();
    let enhanced = choices(inputs, truncation.max_degree).map(|polynomials| {
        let scales: Vec<Vec<f64>> = (0..inputs.len())
            .into_par_iter()
            .map(|i| scales(&inputs[i], &polynomials[i], &observed.columns[i]))
            .collect();
        let scaled = |(i, scales): (usize, &Vec<f64>)| -> Vec<f64> {
            scales.iter().zip(&gradients).map(|(scale, of)| scale * of.gradient[i]).collect()
        };
        let slopes = scales.iter().enumerate().map(scaled).collect();
        fit(inputs, &observed, polynomials, Some(&ScaledSlopes { scales, slopes }), truncation)
    });
    best_of(std::iter::once(Ok(plain)).chain(enhanced))
}

/// √τ (GE2) at values of an input, or that of its probability per unit of the input.
fn scales(input: &Input, polynomials: &Polynomials, values: &[f64]) -> Vec<f64> {
    if let Some(law) = polynomials.probability {
        let of_probability = |x: &f64| {
            let u = law.cdf(*x);
            finite((0.5 * u * (1.0 - u)).sqrt() / law.ln_pdf(*x).exp())
        };
        return values.iter().map(of_probability).collect();
    }
    let kernel = SteinKernel::new(input.law);
    values.iter().map(|&x| kernel.at(x).sqrt()).collect()
}

/// The value, or zero for a place where the law has no density: its derivatives do not count.
fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { 0.0 }
}

/// τ (GE2) of a law.
struct SteinKernel {
    law: Law,
    /// Values in ascending order, and ∫ (t - mean) p dt beyond each, of laws without a formula.
    beyond: Vec<(f64, f64)>,
}

impl SteinKernel {
    fn new(law: Law) -> Self {
        let has_formula = matches!(law, Law::Uniform { .. } | Law::Normal { .. } | Law::Beta { .. });
        let mut nodes = if has_formula { vec![] } else { quadrature(&law, 1) };
        nodes.sort_by(|one, other| one.0.total_cmp(&other.0));
        let weight: f64 = nodes.iter().map(|node| node.1).sum();
        let mean = nodes.iter().map(|(x, w)| x * w).sum::<f64>() / weight;
        let mut rest = 0.0;
        // A node stands for the part on both sides of it: half of its weight is beyond it.
        let mut beyond: Vec<(f64, f64)> = nodes
            .iter()
            .rev()
            .map(|(x, w)| {
                let part = (x - mean) * w / weight;
                rest += part;
                (*x, rest - 0.5 * part)
            })
            .collect();
        beyond.reverse();
        Self { law, beyond }
    }

    fn at(&self, x: f64) -> f64 {
        match self.law {
            Law::Uniform { min, max } => (0.5 * (x - min) * (max - x)).max(0.0),
            Law::Normal { std, .. } => std * std,
            Law::Beta { alpha, beta, min, max } => ((x - min) * (max - x) / (alpha + beta)).max(0.0),
            law => {
                let place = self.beyond.partition_point(|(node, _)| *node <= x);
                let value = match (place.checked_sub(1).map(|i| self.beyond[i]), self.beyond.get(place)) {
                    (Some((x0, y0)), Some(&(x1, y1))) => y0 + (y1 - y0) * (x - x0) / (x1 - x0),
                    _ => 0.0,
                };
                finite(value.max(0.0) / law.ln_pdf(x).exp())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_kernel_has_the_variance_of_the_law_as_its_mean() {
        let laws = [
            Law::Uniform { min: -1.0, max: 2.0 },
            Law::Normal { mean: 1.0, std: 0.3 },
            Law::Beta { alpha: 2.0, beta: 3.0, min: -1.0, max: 2.0 },
            Law::TruncatedNormal { mean: 0.0, std: 1.0, min: -1.0, max: 2.0 },
            Law::Triangular { min: 0.0, mode: 0.2, max: 1.0 },
            Law::LogNormal { log_mean: 0.0, log_std: 0.5 },
            Law::Gumbel { location: 0.0, scale: 2.0 },
            Law::Weibull { shape: 1.5, scale: 1.0 },
        ];
        for law in laws {
            let kernel = SteinKernel::new(law);
            let mean: f64 = quadrature(&law, 2).iter().map(|(x, w)| w * kernel.at(*x)).sum();
            assert!((mean / law.std().powi(2) - 1.0).abs() < 1e-2, "{law:?} {mean}");
        }
        // τ = x for the exponential law.
        let kernel = SteinKernel::new(Law::Weibull { shape: 1.0, scale: 1.0 });
        for x in [0.1, 0.5, 1.0, 2.0, 5.0] {
            assert!((kernel.at(x) / x - 1.0).abs() < 1e-2, "{x} {}", kernel.at(x));
        }
    }
}
