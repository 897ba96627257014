//! Products of polynomials from which an expansion chooses.
//!
//! ```text
//! Ψ_α(x) = Π_i ψ_α_i(x_i),   (Σ α_i^q)^(1/q) ≤ p                         (Po1)
//! ```
//!
//! (Po1) is the hyperbolic truncation of G. Blatman, B. Sudret, *Adaptive sparse polynomial chaos expansion
//! based on least angle regression*, J. Comput. Phys. 230 (2011). A smaller q gives fewer interactions.

use serde::{Deserialize, Serialize};

use crate::error::{SensitivityError, check_range, require};

/// Degree of one input in a product.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Power {
    /// Index of the input.
    pub input: usize,
    /// Degree of its polynomial, at least 1.
    pub degree: usize,
}

/// Set of products from which an expansion chooses, Eq. (Po1).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
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
    /// Largest degree of an expansion.
    pub(crate) const MAX_DEGREE: usize = 100;

    /// Checks degree, norm and interactions.
    pub(crate) fn check(&self) -> Result<(), SensitivityError> {
        let Self { max_degree, norm, interactions } = *self;
        require(norm > 0.0 && norm <= 1.0, "norm", norm, "a number above 0, at most 1")?;
        check_range("degree", max_degree as u64, 1, Self::MAX_DEGREE as u64)?;
        check_range("interactions", interactions as u64, 1, u64::MAX)
    }

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
