//! Functions on which methods of sensitivity are compared.
//!
//! Borehole, OTL circuit and wing weight: S. Surjanovic, D. Bingham, *Virtual library of simulation
//! experiments*. Bratley's function: P. Bratley, B. L. Fox, H. Niederreiter (1992). Morris's function has
//! (-1)^i and (-1)^(i + j) for the coefficients that he draws at random.

use std::f64::consts::PI;

use cdpr_sensitivity::{Input, Law};

/// A model of some inputs.
pub(crate) struct Function {
    pub(crate) name: &'static str,
    pub(crate) inputs: Vec<Input>,
    pub(crate) model: fn(&[f64]) -> Option<f64>,
}

/// All of them.
pub(crate) fn all() -> Vec<Function> {
    let function = |name, laws: Vec<Law>, model| {
        let named = |(i, law)| Input::continuous(format!("x{}", i + 1), law);
        Function { name, inputs: laws.into_iter().enumerate().map(named).collect(), model }
    };
    let uniform = |min, max| Law::Uniform { min, max };
    let ranges = |ends: &[f64]| ends.chunks(2).map(|ends| uniform(ends[0], ends[1])).collect::<Vec<_>>();
    let of_borehole = [
        vec![Law::Normal { mean: 0.1, std: 0.016_181_2 }, Law::LogNormal { log_mean: 7.71, log_std: 1.0056 }],
        ranges(&[
            63070.0, 115_600.0, 990.0, 1110.0, 63.1, 116.0, 700.0, 820.0, 1120.0, 1680.0, 9855.0, 12045.0,
        ]),
    ];
    let otl = [50.0, 150.0, 25.0, 70.0, 0.5, 3.0, 1.2, 2.5, 0.25, 1.2, 50.0, 300.0];
    let wing = [
        150.0, 200.0, 220.0, 300.0, 6.0, 10.0, -10.0, 10.0, 16.0, 45.0, 0.5, 1.0, 0.08, 0.18, 2.5, 6.0,
        1700.0, 2500.0, 0.025, 0.08,
    ];
    vec![
        function("Ishigami", vec![uniform(-PI, PI); 3], ishigami),
        function("Ishigami, 5 % fail", vec![uniform(-PI, PI); 3], failing),
        function("Sobol' g", vec![uniform(0.0, 1.0); 8], sobol_g),
        function("Borehole", of_borehole.concat(), |x| Some(borehole(x))),
        function("OTL circuit", ranges(&otl), |x| {
            let (base, gain) = (12.0 * x[1] / (x[0] + x[1]), x[5] * (x[4] + 9.0));
            let parts = (base + 0.74) * gain + 11.35 * x[2];
            Some(parts / (gain + x[2]) + 0.74 * x[2] * gain / ((gain + x[2]) * x[3]))
        }),
        function("Wing weight", ranges(&wing), |x| {
            let sweep = (x[3] * PI / 180.0).cos();
            let area = 0.036 * x[0].powf(0.758) * x[1].powf(0.0035) * (x[2] / (sweep * sweep)).powf(0.6);
            let shape = x[4].powf(0.006) * x[5].powf(0.04) * (100.0 * x[6] / sweep).powf(-0.3);
            Some(area * shape * (x[7] * x[8]).powf(0.49) + x[0] * x[9])
        }),
        function("Morris", vec![uniform(0.0, 1.0); 20], morris),
        function("Bratley", vec![uniform(0.0, 1.0); 10], |x| {
            let mut product = 1.0;
            let mut term = |(i, x): (usize, &f64)| {
                product *= x;
                if i % 2 == 0 { -product } else { product }
            };
            Some(x.iter().enumerate().map(&mut term).sum())
        }),
        function("x1 x2", vec![uniform(-1.0, 1.0); 2], |x| Some(x[0] * x[1])),
        function("step", vec![uniform(0.0, 1.0); 3], |x| Some(f64::from(x[0] + 0.2 * x[1] > 0.7))),
        function("additive, 62, 5 % fail", vec![uniform(0.0, 1.0); 62], |x| {
            additive(x).filter(|_| observed(x))
        }),
        function("additive, 100", vec![uniform(0.0, 1.0); 100], additive),
    ]
}

/// Twelve functions of the table of all measures: the same with one that fails in place of two, and a
/// constant.
pub(crate) fn twelve() -> Vec<Function> {
    let one = |function: &Function| !function.name.starts_with("additive, 62");
    let mut functions: Vec<Function> = all().into_iter().filter(one).collect();
    let inputs = functions[0].inputs.clone();
    functions.push(Function { name: "constant", inputs, model: |_| Some(1.0) });
    functions
}

/// Flow of water through a borehole [m³/a].
pub(crate) fn borehole(x: &[f64]) -> f64 {
    let ratio = (x[1] / x[0]).ln();
    let resistance = ratio * (1.0 + 2.0 * x[6] * x[2] / (ratio * x[0] * x[0] * x[7]) + x[2] / x[4]);
    2.0 * PI * x[2] * (x[3] - x[5]) / resistance
}

fn ishigami(x: &[f64]) -> Option<f64> {
    Some(x[0].sin() + 7.0 * x[1].sin().powi(2) + 0.1 * x[2].powi(4) * x[0].sin())
}

fn additive(x: &[f64]) -> Option<f64> {
    Some(x.iter().enumerate().map(|(i, x)| x / (1.0 + i as f64)).sum())
}

fn failing(x: &[f64]) -> Option<f64> {
    ishigami(x).filter(|_| observed(x))
}

/// One observation in twenty fails, whatever its output.
fn observed(x: &[f64]) -> bool {
    let hash = x
        .iter()
        .fold(0_u64, |hash, x| (hash ^ x.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(23));
    hash >> 32 >= (1 << 32) / 20
}

fn sobol_g(x: &[f64]) -> Option<f64> {
    const A: [f64; 8] = [0.0, 1.0, 4.5, 9.0, 99.0, 99.0, 99.0, 99.0];
    Some(x.iter().zip(A).map(|(x, a)| ((4.0 * x - 2.0).abs() + a) / (1.0 + a)).product())
}

fn morris(x: &[f64]) -> Option<f64> {
    let curved = |i: usize, x: f64| if matches!(i, 2 | 4 | 6) { 1.1 * x / (x + 0.1) } else { x };
    let w: Vec<f64> = x.iter().enumerate().map(|(i, &x)| 2.0 * (curved(i, x) - 0.5)).collect();
    let sign = |sum: usize| if sum.is_multiple_of(2) { 1.0 } else { -1.0 };
    let mut y = 0.0;
    for i in 0..20 {
        y += w[i] * if i < 10 { 20.0 } else { sign(i + 1) };
        for j in i + 1..20 {
            y += w[i] * w[j] * if j < 6 { -15.0 } else { sign(i + j) };
            for l in j + 1..5 {
                y += w[i] * w[j] * w[l] * (-10.0 + 5.0 * w[l + 1..4.max(l + 1)].iter().sum::<f64>());
            }
        }
    }
    Some(y)
}
