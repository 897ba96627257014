//! Orthonormal polynomials of the laws, and the products of them from which an expansion chooses.
//!
//! ```text
//! uniform:  ξ = (2 x - min - max) / (max - min),   ψ_n = √(2n + 1) P_n(ξ)                   (Y1)
//!           (n+1) P_(n+1) = (2n+1) ξ P_n - n P_(n-1)
//! normal:   ξ = (x - mean) / std,   √(n+1) ψ_(n+1) = ξ ψ_n - √n ψ_(n-1)                     (Y2)
//! others:   ξ = 2 F(x) - 1,   ψ_n as in (Y1)                                                (Y3)
//! Ψ_α(x) = Π_i ψ_α_i(ξ_i),   (Σ α_i^q)^(1/q) ≤ p                                            (Y4)
//! ```
//!
//! - (Y1) and (Y2) are Legendre's and Hermite's polynomials, with a mean square of 1 under their law: D. Xiu,
//!   G. E. Karniadakis, *The Wiener-Askey polynomial chaos for stochastic differential equations*, SIAM J.
//!   Sci. Comput. 24 (2002).
//! - (Y3) is the isoprobabilistic transform to the uniform law.
//! - (Y4) is the hyperbolic truncation of G. Blatman, B. Sudret, *Adaptive sparse polynomial chaos expansion
//!   based on least angle regression*, J. Comput. Phys. 230 (2011). A smaller q gives fewer interactions.
//!
//! Steps are disregarded: the polynomials of a stepped input are those of its continuous law. Steps of h in a
//! uniform range R change the mean squares by a relative (h / R)².

use serde::{Deserialize, Serialize};

use crate::law::Law;

/// Degree of one input in a product.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Power {
    /// Index of the input.
    pub input: usize,
    /// Degree of its polynomial, at least 1.
    pub degree: usize,
}

/// Polynomials `ψ_0` .. `ψ_degree` of a law at x, Eq. (Y1) to (Y3).
pub(crate) fn polynomials(law: &Law, x: f64, degree: usize) -> Vec<f64> {
    let (xi, hermite) = match *law {
        Law::Normal { mean, std } => ((x - mean) / std, true),
        Law::Uniform { min, max } => ((2.0 * x - min - max) / (max - min), false),
        _ => (2.0 * law.cdf(x) - 1.0, false),
    };
    let mut values = vec![1.0];
    let (mut before, mut last) = (0.0, 1.0);
    for n in 0..degree {
        let m = n as f64;
        let next = if hermite {
            (xi * last - m.sqrt() * before) / (m + 1.0).sqrt()
        } else {
            ((2.0 * m + 1.0) * xi * last - m * before) / (m + 1.0)
        };
        (before, last) = (last, next);
        values.push(if hermite { next } else { (2.0 * m + 3.0).sqrt() * next });
    }
    values
}

/// Set of products from which an expansion chooses, Eq. (Y4).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Truncation {
    /// Largest degree p.
    pub max_degree: usize,
    /// Norm q in (0, 1]. With 1, all products up to the total degree p are included.
    pub norm: f64,
    /// Largest number of inputs in a product.
    pub interactions: usize,
}

impl Truncation {
    /// Products up to this degree without the constant one, or `None` if there are more than `limit`.
    pub(crate) fn products(&self, inputs: usize, degree: usize, limit: usize) -> Option<Vec<Vec<Power>>> {
        let mut products: Vec<Vec<Power>> = vec![vec![]];
        let room = |product: &[Power]| {
            // 1e-9 covers the rounding of the powers.
            let taken: f64 = product.iter().map(|power| (power.degree as f64).powf(self.norm)).sum();
            (degree as f64).powf(self.norm) - taken + 1e-9
        };
        // Each product extends an earlier one by a power of a later input.
        let mut done = 0;
        while done < products.len() {
            let product = products[done].clone();
            done += 1;
            if product.len() == self.interactions {
                continue;
            }
            let room = room(&product);
            let first = product.last().map_or(0, |power| power.input + 1);
            let degrees = (1..=degree).take_while(|&degree| (degree as f64).powf(self.norm) <= room);
            for degree in degrees {
                for input in first..inputs {
                    products.push([product.as_slice(), &[Power { input, degree }]].concat());
                    if products.len() > limit + 1 {
                        return None;
                    }
                }
            }
        }
        products.remove(0);
        Some(products)
    }
}
