//! Test functions with indices known in closed form.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use crate::common::uniform;
use cdpr_sensitivity::Input;

type Model = Box<dyn Fn(&[f64]) -> f64 + Sync>;

/// A function of inputs of one uniform law each, with its exact indices.
pub(crate) struct Function {
    pub(crate) name: &'static str,
    pub(crate) inputs: Vec<Input>,
    pub(crate) model: Model,
    pub(crate) first: Vec<f64>,
    pub(crate) total: Vec<f64>,
}

/// All of them.
pub(crate) fn all() -> [Function; 4] {
    [ishigami(), sobol_g(), linear(), morris()]
}

/// T. Ishigami, T. Homma (1990): sin x1 + 7 sin² x2 + 0.1 x3⁴ sin x1.
pub(crate) fn ishigami() -> Function {
    let (v1, v2) = (0.5 * (1.0 + 0.1 * PI.powi(4) / 5.0).powi(2), 49.0 / 8.0);
    let v13 = 0.01 * PI.powi(8) * 8.0 / 225.0;
    let variance = v1 + v2 + v13;
    Function {
        name: "Ishigami",
        inputs: uniform(3, -PI, PI),
        model: Box::new(|x| x[0].sin() + 7.0 * x[1].sin().powi(2) + 0.1 * x[2].powi(4) * x[0].sin()),
        first: [v1, v2, 0.0].map(|v| v / variance).to_vec(),
        total: [v1 + v13, v2, v13].map(|v| v / variance).to_vec(),
    }
}

/// I. M. Sobol' (1993): Π (|4 x - 2| + a) / (1 + a).
pub(crate) fn sobol_g() -> Function {
    const A: [f64; 5] = [0.0, 1.0, 4.5, 9.0, 99.0];
    let parts = A.map(|a| 1.0 / (3.0 * (1.0 + a) * (1.0 + a)));
    let all: f64 = parts.iter().map(|v| 1.0 + v).product();
    let variance = all - 1.0;
    Function {
        name: "Sobol G",
        inputs: uniform(5, 0.0, 1.0),
        model: Box::new(|x| x.iter().zip(A).map(|(x, a)| ((4.0 * x - 2.0).abs() + a) / (1.0 + a)).product()),
        first: parts.map(|v| v / variance).to_vec(),
        total: parts.map(|v| v * all / (1.0 + v) / variance).to_vec(),
    }
}

/// P. Bratley, B. L. Fox, H. Niederreiter (1992): -x1 + x1 x2 - x1 x2 x3 + .. of ten inputs.
///
/// With `s_i` = ∓1, `R_i = s_i + x_(i+1) R_(i+1)` and P the product of the inputs before i, it has the part
/// `P x_i R_i`.
pub(crate) fn bratley() -> Function {
    const K: usize = 10;
    let (mut mean, mut square) = ([0.0; K + 1], [0.0; K + 1]);
    for i in (0..K).rev() {
        let sign = if i % 2 == 0 { -1.0 } else { 1.0 };
        mean[i] = sign + 0.5 * mean[i + 1];
        square[i] = 1.0 + sign * mean[i + 1] + square[i + 1] / 3.0;
    }
    let variance = square[0] / 3.0 - 0.25 * mean[0] * mean[0];
    let share = |base: f64, i: usize, rest: f64| base.powi(i as i32) * rest / 12.0 / variance;
    Function {
        name: "Bratley",
        inputs: uniform(K, 0.0, 1.0),
        model: Box::new(|x| {
            let (mut product, mut sum) = (1.0, 0.0);
            for (i, x) in x.iter().enumerate() {
                product *= x;
                sum += if i % 2 == 0 { -product } else { product };
            }
            sum
        }),
        first: (0..K).map(|i| share(0.25, i, mean[i] * mean[i])).collect(),
        total: (0..K).map(|i| share(1.0 / 3.0, i, square[i])).collect(),
    }
}

/// x1 x2 + x1 / 10 + x3 / 1000 on -1..1: the last input matters little, and always alike.
pub(crate) fn with_a_small_part() -> Function {
    let parts = [0.01 / 3.0, 0.0, 1e-6 / 3.0];
    let variance = 1.0 / 9.0 + parts.iter().sum::<f64>();
    let total = [parts[0] + 1.0 / 9.0, 1.0 / 9.0, parts[2]];
    Function {
        name: "small part",
        inputs: uniform(3, -1.0, 1.0),
        model: Box::new(|x| x[0] * x[1] + 0.1 * x[0] + 0.001 * x[2]),
        first: parts.map(|v| v / variance).to_vec(),
        total: total.map(|v| v / variance).to_vec(),
    }
}

/// 5 x1 + 3 x2 - 2 x3 + 0 x4.
pub(crate) fn linear() -> Function {
    const B: [f64; 4] = [5.0, 3.0, -2.0, 0.0];
    let shares = B.map(|b| b * b / 38.0).to_vec();
    Function {
        name: "linear",
        inputs: uniform(4, 0.0, 1.0),
        model: Box::new(|x| x.iter().zip(B).map(|(x, b)| b * x).sum()),
        first: shares.clone(),
        total: shares,
    }
}

/// M. D. Morris (1991), 20 inputs, with (-1)^i and (-1)^(i + j) for the coefficients that he draws at random.
pub(crate) fn morris() -> Function {
    const K: usize = 20;
    /// w of Morris: of the inputs 3, 5 and 7 it is curved.
    fn w(i: usize, x: f64) -> f64 {
        2.0 * (if CURVED.contains(&i) { 1.1 * x / (x + 0.1) } else { x } - 0.5)
    }
    const CURVED: [usize; 3] = [2, 4, 6];
    let sign = |sum: usize| if sum.is_multiple_of(2) { 1.0 } else { -1.0 };
    let mut products: Vec<(Vec<usize>, f64)> = Vec::new();
    for i in 0..K {
        products.push((vec![i], if i < 10 { 20.0 } else { sign(i + 1) }));
        for j in i + 1..K {
            products.push((vec![i, j], if j < 6 { -15.0 } else { sign(i + j) }));
            for l in j + 1..5 {
                products.push((vec![i, j, l], -10.0));
                products.extend((l + 1..4).map(|s| (vec![i, j, l, s], 5.0)));
            }
        }
    }
    // Mean and mean square of x / (x + 0.1): 1 - 0.1 ln 11, 1 - 0.2 ln 11 + 0.01 (10 - 1 / 1.1).
    let (mean, square) = (1.0 - 0.1 * 11.0_f64.ln(), 1.0 - 0.2 * 11.0_f64.ln() + 0.01 * (10.0 - 1.0 / 1.1));
    let moments = |i: usize| match CURVED.contains(&i) {
        true => (2.2 * mean - 1.0, 4.84 * (square - mean * mean)),
        false => (0.0, 1.0 / 3.0),
    };
    // In the deviations of w from their means each product becomes those of all its subsets.
    let mut centred: BTreeMap<Vec<usize>, f64> = BTreeMap::new();
    for (inputs, coefficient) in &products {
        for subset in 1..1_u32 << inputs.len() {
            let (mut kept, mut factor) = (vec![], *coefficient);
            for (bit, &i) in inputs.iter().enumerate() {
                match subset >> bit & 1 {
                    1 => kept.push(i),
                    _ => factor *= moments(i).0,
                }
            }
            *centred.entry(kept).or_default() += factor;
        }
    }
    let variances: Vec<(Vec<usize>, f64)> = centred
        .into_iter()
        .map(|(inputs, c)| {
            let variance = inputs.iter().map(|&i| moments(i).1).product::<f64>();
            (inputs, c * c * variance)
        })
        .collect();
    let sum = |of: &dyn Fn(&[usize]) -> bool| -> f64 {
        variances.iter().filter(|(inputs, _)| of(inputs)).map(|(_, variance)| variance).sum()
    };
    let variance = sum(&|_| true);
    Function {
        name: "Morris",
        inputs: uniform(K, 0.0, 1.0),
        first: (0..K).map(|i| sum(&|inputs| *inputs == [i]) / variance).collect(),
        total: (0..K).map(|i| sum(&|inputs| inputs.contains(&i)) / variance).collect(),
        model: Box::new(move |x| {
            let w: Vec<f64> = x.iter().enumerate().map(|(i, &x)| w(i, x)).collect();
            products.iter().map(|(inputs, c)| c * inputs.iter().map(|&i| w[i]).product::<f64>()).sum()
        }),
    }
}
