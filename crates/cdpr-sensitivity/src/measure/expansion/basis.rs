//! Orthonormal polynomials of a law, by their recurrence.
//!
//! ```text
//! b_(n+1) ψ_(n+1) = (ξ - a_n) ψ_n - b_n ψ_(n-1),   ψ_0 = 1,   ξ = (x - centre) / scale      (Ba1)
//! uniform:  a_n = 0,   b_n = n / √(4 n² - 1)          (Legendre)                            (Ba2)
//! normal:   a_n = 0,   b_n = √n                       (Hermite)                             (Ba3)
//! beta:     a_n, b_n of Jacobi (`jacobi`)
//! others:   a_n = E ξ ψ_n²,   b_(n+1) = √(E ((ξ - a_n) ψ_n - b_n ψ_(n-1))²)                 (Ba4)
//! ```
//!
//! A function of the logarithm of a lognormal input, or one with asymptotes, has no good polynomials in its
//! value. Legendre's polynomials of ξ = 2 F(x) - 1, the isoprobabilistic transform, are therefore the other
//! choice.
//!
//! - (Ba2), (Ba3): D. Xiu, G. E. Karniadakis, *The Wiener-Askey polynomial chaos for stochastic differential
//!   equations*, SIAM J. Sci. Comput. 24 (2002).
//! - (Ba4) is Stieltjes's procedure: W. Gautschi, *Orthogonal polynomials: computation and approximation*
//!   (2004), section 2.2.3. The means are sums over the levels of a stepped input, or Gauss-Legendre sums
//!   between quantiles of a continuous one (`quadrature`).

use serde::{Deserialize, Serialize};

use crate::design::input::Input;
use crate::law::{Law, Support};

/// Orthonormal polynomials (Ba1) of the law of an input.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct Polynomials {
    /// Law whose F(x) takes the place of x, `None` for polynomials of x itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub probability: Option<Law>,
    /// Value at which ξ is 0, in the unit of the input.
    pub centre: f64,
    /// Change over which ξ changes by 1.
    pub scale: f64,
    /// `a_0` .. of (Ba1).
    pub a: Vec<f64>,
    /// `b_1` .. of (Ba1), as many. An input of m levels has m - 1 of them.
    pub b: Vec<f64>,
}

impl Polynomials {
    /// Legendre's polynomials of 2 F(x) - 1 for a continuous input of any law.
    pub(crate) fn of_probability(input: &Input, degree: usize) -> Self {
        let probabilities = Input::continuous("", Law::Uniform { min: 0.0, max: 1.0 });
        Self { probability: Some(input.law), ..Self::new(&probabilities, degree) }
    }

    /// Whether an input has polynomials other than those of 2 F(x) - 1: those of a normal law do best in its
    /// value, and those of a uniform law or of levels are the same.
    pub(crate) fn has_choice(input: &Input) -> bool {
        input.steps.is_none() && !matches!(input.law, Law::Uniform { .. } | Law::Normal { .. })
    }

    /// Polynomials of the law of an input and its steps, up to a degree.
    pub(crate) fn new(input: &Input, degree: usize) -> Self {
        let degrees = (1..=degree).map(|n| n as f64);
        match (input.weighted_levels(), input.law) {
            (None, Law::Uniform { min, max }) => Self {
                probability: None,
                centre: 0.5 * (min + max),
                scale: 0.5 * (max - min),
                a: vec![0.0; degree],
                b: degrees.map(|n| n / (4.0 * n * n - 1.0).sqrt()).collect(),
            },
            (None, Law::Normal { mean, std }) => Self {
                probability: None,
                centre: mean,
                scale: std,
                a: vec![0.0; degree],
                b: degrees.map(f64::sqrt).collect(),
            },
            (None, Law::Beta { alpha, beta, min, max }) => {
                let (centre, scale) = (0.5 * (min + max), 0.5 * (max - min));
                let (a, b) = (0..degree).map(|n| jacobi(beta - 1.0, alpha - 1.0, n as f64)).unzip();
                Self { probability: None, centre, scale, a, b }
            }
            (None, law) => stieltjes(&quadrature(&law, degree), degree),
            (Some(levels), _) => stieltjes(&levels, degree),
        }
    }

    /// Polynomials of the values of a sample, each of the same weight.
    pub(crate) fn of_values(values: &[f64], degree: usize) -> Self {
        let nodes: Vec<(f64, f64)> = values.iter().map(|&x| (x, 1.0)).collect();
        stieltjes(&nodes, degree)
    }

    /// Largest degree of a polynomial that is not 0 throughout.
    pub(crate) fn degree(&self) -> usize {
        self.b.len()
    }

    /// `ψ_0` .. `ψ_degree` at x.
    pub(crate) fn values(&self, x: f64) -> Vec<f64> {
        let x = self.probability.map_or(x, |law| law.cdf(x));
        let xi = (x - self.centre) / self.scale;
        let (mut before, mut last, mut b_last) = (0.0, 1.0, 0.0);
        let mut values = vec![1.0];
        for (a, b) in self.a.iter().zip(&self.b) {
            (before, last, b_last) = (last, ((xi - a) * last - b_last * before) / b, *b);
            values.push(last);
        }
        values
    }

    /// Derivatives of `ψ_0` .. `ψ_degree` at x, per unit of the input.
    pub(crate) fn slopes(&self, x: f64) -> Vec<f64> {
        let values = self.values(x);
        let inner = self.probability.map_or(1.0, |law| law.ln_pdf(x).exp()) / self.scale;
        let xi = (self.probability.map_or(x, |law| law.cdf(x)) - self.centre) / self.scale;
        let (mut before, mut last, mut b_last) = (0.0, 0.0, 0.0);
        let mut slopes = vec![0.0];
        for ((a, b), value) in self.a.iter().zip(&self.b).zip(values) {
            (before, last, b_last) = (last, (value + (xi - a) * last - b_last * before) / b, *b);
            slopes.push(inner * last);
        }
        slopes
    }
}

/// `a_n` and `b_(n+1)` of Jacobi's polynomials on [-1, 1], of the weight (1 - ξ)^p (1 + ξ)^q: W. Gautschi
/// (2004), table 1.1.
fn jacobi(p: f64, q: f64, n: f64) -> (f64, f64) {
    let (sum, m) = (p + q, n + 1.0);
    let a = if n == 0.0 {
        (q - p) / (sum + 2.0)
    } else {
        (q * q - p * p) / ((2.0 * n + sum) * (2.0 * n + sum + 2.0))
    };
    let squared = if n == 0.0 {
        4.0 * (p + 1.0) * (q + 1.0) / ((sum + 2.0).powi(2) * (sum + 3.0))
    } else {
        let twice = 2.0 * m + sum;
        4.0 * m * (m + p) * (m + q) * (m + sum) / (twice * twice * (twice + 1.0) * (twice - 1.0))
    };
    (a, squared.sqrt())
}

/// Stieltjes's procedure (Ba4) for a law of these values and weights.
fn stieltjes(nodes: &[(f64, f64)], degree: usize) -> Polynomials {
    /// A smaller norm than this share of the scale is rounding: the law has no more values.
    const NONE: f64 = 1e-10;
    let total: f64 = nodes.iter().map(|(_, weight)| weight).sum();
    let mean = |f: &dyn Fn(f64) -> f64| nodes.iter().map(|&(x, weight)| weight * f(x)).sum::<f64>() / total;
    let centre = mean(&|x| x);
    let scale = mean(&|x| (x - centre).powi(2)).sqrt();
    let mut found = Polynomials { probability: None, centre, scale, a: vec![], b: vec![] };
    let (mut before, mut last, mut b_last) = (vec![0.0; nodes.len()], vec![1.0; nodes.len()], 0.0);
    for _ in 0..degree {
        let xi = || nodes.iter().map(|(x, weight)| ((x - centre) / scale, weight / total));
        let a: f64 = xi().zip(&last).map(|((xi, weight), psi)| weight * xi * psi * psi).sum();
        let next = xi().zip(last.iter().zip(&before));
        let mut next: Vec<f64> =
            next.map(|((xi, _), (last, before))| (xi - a) * last - b_last * before).collect();
        let b = xi().zip(&next).map(|((_, weight), next)| weight * next * next).sum::<f64>().sqrt();
        if b.is_nan() || b <= NONE {
            break;
        }
        next.iter_mut().for_each(|next| *next /= b);
        (before, last, b_last) = (last, next, b);
        found.a.push(a);
        found.b.push(b);
    }
    found
}

/// Values and weights whose sums are means under a continuous law, of polynomials up to twice a degree.
///
/// Each interval between quantiles of 2^-50 .. 1/4, 1/2, 3/4 .. 1 - 2^-50 has a Gauss-Legendre rule. On an
/// infinite side intervals of double length follow until the mean square of x^degree has no more to gain.
pub(crate) fn quadrature(law: &Law, degree: usize) -> Vec<(f64, f64)> {
    let Support { min, max } = law.support();
    let median = law.quantile(0.5);
    let tails = (1..=50).map(|k| 0.5_f64.powi(k));
    let mut edges: Vec<f64> = tails.flat_map(|u| [law.quantile(u), law.quantile(1.0 - u)]).collect();
    edges.extend([min, max].into_iter().filter(|end| end.is_finite()));
    if let Law::Triangular { mode, .. } = *law {
        edges.push(mode);
    }
    edges.sort_by(f64::total_cmp);
    edges.dedup();
    for (end, infinite) in [(edges[0], min.is_infinite()), (edges[edges.len() - 1], max.is_infinite())] {
        let weight = |x: f64| law.ln_pdf(x) + (2 * degree + 1) as f64 * (x - median).abs().ln();
        let mut greatest = f64::NEG_INFINITY;
        let farther = (0..).map(|k| median + (end - median) * 2.0_f64.powi(k));
        let mut farther = farther.take_while(|&x| {
            greatest = greatest.max(weight(x));
            weight(x) > greatest - 80.0
        });
        if infinite {
            edges.extend(farther.by_ref().skip(1).take(1000));
        }
    }
    edges.sort_by(f64::total_cmp);
    let rule = gauss_legendre(16 + degree);
    let panel = |ends: &[f64]| -> Vec<(f64, f64)> {
        let (middle, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
        rule.iter()
            .map(|(z, w)| (middle + half * z, half * w * law.ln_pdf(middle + half * z).exp()))
            .collect()
    };
    edges.windows(2).flat_map(panel).filter(|(_, weight)| *weight > 0.0).collect()
}

/// Nodes and weights of the Gauss-Legendre rule of n points on [-1, 1], by Newton's method.
pub(crate) fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    let count = n as f64;
    let node = |i: usize| {
        let mut z = (std::f64::consts::PI * (i as f64 + 0.75) / (count + 0.5)).cos();
        let mut slope = 1.0;
        // Convergence is quadratic from errors of 1 / n².
        for _ in 0..8 {
            let (mut before, mut last) = (1.0, z);
            for k in 2..=n {
                let k = k as f64;
                (before, last) = (last, ((2.0 * k - 1.0) * z * last - (k - 1.0) * before) / k);
            }
            slope = count * (z * last - before) / (z * z - 1.0);
            z -= last / slope;
        }
        (z, 2.0 / ((1.0 - z * z) * slope * slope))
    };
    (0..n).map(node).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::input::Steps;

    const RANGE: (f64, f64) = (-1.0, 2.0);

    /// Asserts `a_n` and `b_(n+1)` in the unit of the input.
    fn assert_recurrence(law: Law, known: impl Fn(f64) -> (f64, f64)) {
        let found = Polynomials::new(&Input::continuous("x", law), 6);
        for n in 0..6 {
            let (a, b) = known(n as f64);
            let (a_found, b_found) = (found.centre + found.scale * found.a[n], found.scale * found.b[n]);
            assert!((a_found - a).abs() < 1e-9 * (1.0 + a.abs()), "{law:?} a_{n}: {a_found} {a}");
            assert!((b_found - b).abs() < 1e-9 * b, "{law:?} b_{}: {b_found} {b}", n + 1);
        }
    }

    #[test]
    fn recurrences_are_those_of_the_known_families() {
        // Laguerre.
        assert_recurrence(Law::Weibull { shape: 1.0, scale: 1.0 }, |n| (2.0 * n + 1.0, n + 1.0));
        let (min, max) = RANGE;
        let legendre = |n: f64| (0.5, 1.5 * (n + 1.0) / (4.0 * (n + 1.0).powi(2) - 1.0).sqrt());
        assert_recurrence(Law::Beta { alpha: 1.0, beta: 1.0, min, max }, legendre);
        assert_recurrence(Law::TruncatedNormal { mean: 0.0, std: 1e6, min, max }, legendre);
        let wide = Law::TruncatedNormal { mean: 0.0, std: 1.0, min: -30.0, max: 30.0 };
        assert_recurrence(wide, |n| (0.0, (n + 1.0).sqrt()));
        // Chebyshev, first kind.
        let arcsine = Law::Beta { alpha: 0.5, beta: 0.5, min: -1.0, max: 1.0 };
        assert_recurrence(arcsine, |n| (0.0, if n == 0.0 { 0.5_f64.sqrt() } else { 0.5 }));
        // A density that rises linearly is that of a beta law.
        let linear = Law::Triangular { min, mode: max, max };
        let jacobi =
            Polynomials::new(&Input::continuous("x", Law::Beta { alpha: 2.0, beta: 1.0, min, max }), 6);
        assert_recurrence(linear, |n| {
            let n = n as usize;
            (jacobi.centre + jacobi.scale * jacobi.a[n], jacobi.scale * jacobi.b[n])
        });
        // Stieltjes and Wigert, q = exp(-σ²): T. S. Chihara, *An introduction to orthogonal polynomials*
        // (1978), section VI.2.
        let q = (-0.25_f64).exp();
        assert_recurrence(Law::LogNormal { log_mean: 0.0, log_std: 0.5 }, |n| {
            let m = n + 1.0;
            let a = q.powf(-2.0 * n - 0.5) * (1.0 + q - q.powf(m));
            (a, (q.powf(2.0 - 4.0 * m) * (1.0 - q.powf(m))).sqrt())
        });
    }

    #[test]
    fn polynomials_of_levels_are_orthonormal_over_these_and_end_with_their_number() {
        let (min, max) = RANGE;
        for law in [Law::Uniform { min, max }, Law::Triangular { min, mode: 0.0, max }] {
            let input = Input::stepped("x", law, Steps::Nearest { step: 0.5 });
            let found = Polynomials::new(&input, 10);
            let levels = input.weighted_levels().unwrap();
            assert_eq!((levels.len(), found.degree()), (7, 6));
            for i in 0..7 {
                for j in 0..7 {
                    let product = |(x, w): &(f64, f64)| w * found.values(*x)[i] * found.values(*x)[j];
                    let mean: f64 = levels.iter().map(product).sum();
                    assert!((mean - f64::from(u8::from(i == j))).abs() < 1e-10, "{i} {j} {mean}");
                }
            }
        }
    }
}
