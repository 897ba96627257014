//! Best constants C of Poincaré's inequality `Var g(x) ≤ C E g'(x)²` of the laws.
//!
//! 1 / C is the smallest positive eigenvalue λ of `-(ρ g')' = λ ρ g` with `ρ g' = 0` at both ends, where
//! ρ is the density:
//!
//! ```text
//! uniform:                    C = (max - min)² / π²                      (Pc1)
//! normal:                     C = std²                                   (Pc2)
//! logistic, Gumbel, Laplace:  C = 4 scale²                               (Pc3)
//! ```
//!
//! For (Pc3) the substitution g = h / √ρ gives Schrödinger's equation, whose potentials (of Pöschl and
//! Teller, of Morse, a well of no width) have no bound state but that of the constant; all other λ are at
//! least 1 / (4 scale²).
//!
//! The other laws have linear finite elements with lumped masses on a grid that is finer at the ends: O.
//! Roustant, F. Barthe, B. Iooss, *Poincaré inequalities on intervals - application to sensitivity
//! analysis*, Electron. J. Stat. 11 (2017). With ρ at the nodes `c_i` and at the ends `e_i` of the elements,
//! and their lengths h,
//!
//! ```text
//! λ ρ(c_i) h_i g_i = ρ(e_(i+1)) (g_i - g_(i+1)) / (c_(i+1) - c_i)        (Pc4)
//!                  + ρ(e_i) (g_i - g_(i-1)) / (c_i - c_(i-1))
//! ```
//!
//! The second eigenvalue is found by bisection with Sturm's count (G. H. Golub, C. F. Van Loan, *Matrix
//! computations*, 4th ed. (2013), section 8.4.1). The lognormal law and Weibull's of a shape below 1 have no
//! constant: their tails are heavier than exponential.

use std::f64::consts::PI;

use crate::law::{Law, Support};

/// Best constant of Poincaré's inequality, in the square of the unit of the variable. A law whose tails are
/// heavier than exponential has `None`.
#[must_use]
pub fn poincare_constant(law: &Law) -> Option<f64> {
    match *law {
        Law::Uniform { min, max } => Some(((max - min) / PI).powi(2)),
        Law::Normal { std, .. } => Some(std * std),
        Law::Logistic { scale, .. } | Law::Gumbel { scale, .. } | Law::Laplace { scale, .. } => {
            Some(4.0 * scale * scale)
        }
        Law::LogNormal { .. } => None,
        Law::Weibull { shape, .. } if shape < 1.0 => None,
        Law::TruncatedNormal { .. } | Law::Triangular { .. } | Law::Beta { .. } | Law::Weibull { .. } => {
            Some(by_elements(law))
        }
    }
}

/// Constant by the elements (Pc4). Its relative error is about 1e-6.
fn by_elements(law: &Law) -> f64 {
    const ELEMENTS: usize = 8000;
    let (min, max) = range(law);
    let end = |i: usize| min + (max - min) * (0.5 * PI * i as f64 / ELEMENTS as f64).sin().powi(2);
    let ends: Vec<f64> = (0..=ELEMENTS).map(end).collect();
    let nodes: Vec<f64> = ends.windows(2).map(|ends| 0.5 * (ends[0] + ends[1])).collect();
    // ρ / (c_(i+1) - c_i) between two nodes, over the masses of the lower and of the upper one. Ratios of ρ
    // do not underflow where ρ does.
    let couplings: Vec<[f64; 2]> = (1..ELEMENTS)
        .map(|i| {
            let over = |node: usize| {
                let ratio = (law.ln_pdf(ends[i]) - law.ln_pdf(nodes[node])).exp();
                ratio / ((nodes[i] - nodes[i - 1]) * (ends[node + 1] - ends[node]))
            };
            [over(i - 1), over(i)]
        })
        .collect();
    let below = |lambda: f64| {
        let (mut count, mut pivot, mut product) = (0, 1.0, 0.0);
        for i in 0..ELEMENTS {
            let lower = if i > 0 { couplings[i - 1][1] } else { 0.0 };
            let upper = couplings.get(i).map_or(0.0, |coupling| coupling[0]);
            pivot = lower + upper - lambda - product / pivot;
            if pivot == 0.0 {
                pivot = f64::MIN_POSITIVE;
            }
            count += usize::from(pivot < 0.0);
            product = couplings.get(i).map_or(0.0, |coupling| coupling[0] * coupling[1]);
        }
        count
    };
    // The identity shows λ <= 1 / Var x.
    let (mut low, mut high) = (0.0, 1.1 / (law.std() * law.std()));
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if below(middle) < 2 { low = middle } else { high = middle }
    }
    1.0 / high
}

/// The support, or the part of it beyond which the density is less than e^-600 times that of the median.
fn range(law: &Law) -> (f64, f64) {
    const NEGLIGIBLE: f64 = 600.0;
    let Support { min, max } = law.support();
    let median = law.quantile(0.5);
    let least = law.ln_pdf(median) - NEGLIGIBLE;
    let cut = |end: f64| {
        let (mut inner, mut outer) = (median, if end.is_finite() { end } else { 1e4 * median });
        if law.ln_pdf(outer.midpoint(median)) > least && end.is_finite() {
            return end;
        }
        for _ in 0..60 {
            let middle = inner.midpoint(outer);
            if law.ln_pdf(middle) > least { inner = middle } else { outer = middle }
        }
        inner
    };
    (cut(min), cut(max))
}
