//! Errors of expansions fitted to values and derivatives, beside those of values alone.

use cdpr_sensitivity::{
    Expansion, SensitivityError, Shares, SobolDesign, Truncation, expansion, gradient_expansion, observe,
};

use crate::brackets::{is_smooth, slopes};
use crate::exact::Exact;
use crate::functions::{Function, twelve};

const TRUNCATION: Truncation = Truncation { max_degree: 4, norm: 0.75, interactions: 2 };
/// Runs that a gradient costs by reverse differentiation, with its value (A. Griewank, 1989: at most 5).
const REVERSE: usize = 5;

/// Errors of the indices of all inputs over the studies.
#[derive(Default)]
struct Errors {
    square: f64,
    count: f64,
    greatest: Vec<f64>,
}

impl Errors {
    fn add(&mut self, found: &[Shares], exact: &Exact) {
        self.greatest.resize(2 * found.len(), 0.0);
        let first = found.iter().zip(&exact.first).map(|(of, exact)| of.closed - exact);
        let total = found.iter().zip(&exact.total).map(|(of, exact)| of.total - exact);
        for (sum, error) in self.greatest.iter_mut().zip(first.chain(total)) {
            *sum += error * error;
            self.square += error * error;
            self.count += 1.0;
        }
    }

    /// Root mean square error over all indices, and of the index where it is largest.
    fn text(&self, studies: u64) -> String {
        let greatest = self.greatest.iter().fold(0.0_f64, |most, of| most.max(*of));
        format!("{:.5} / {:.5}", (self.square / self.count).sqrt(), (greatest / studies as f64).sqrt())
    }
}

/// Prints, for each function with derivatives and number of points, the errors of the indices.
pub(crate) fn table(studies: u64, part: &str) -> Result<(), SensitivityError> {
    println!("{studies} studies each of N points of a sequence, degree up to 4: root mean square error");
    println!("of all indices S and T / of the index where it is largest; by N values, by N with gradients,");
    println!("by {REVERSE} N values (a reverse derivative) and by (k + 1) N values (by differences);");
    println!("share of the studies in which derivatives took part [%]");
    println!(
        "| function, k | N | values | with gradients | {REVERSE} N values | (k + 1) N values | took part |"
    );
    println!("|---|---|---|---|---|---|---|");
    let functions = twelve().into_iter().filter(|of| of.name.contains(part) && of.name != "constant");
    for function in functions.filter(|function| is_smooth(function) && function.inputs.len() <= 20) {
        let exact = Exact::of(&function)?;
        for points in [16, 32, 64, 128] {
            row(&function, &exact, points, studies)?;
        }
    }
    Ok(())
}

fn row(function: &Function, exact: &Exact, points: usize, studies: u64) -> Result<(), SensitivityError> {
    let k = function.inputs.len();
    let [mut own, mut enhanced, mut reverse, mut differences] = [(); 4].map(|()| Errors::default());
    let mut took_part = 0.0;
    for seed in 0..studies {
        let of_values = |points: usize| -> Result<Expansion, SensitivityError> {
            let design = SobolDesign::scrambled(function.inputs.clone(), points, seed)?;
            expansion(&design, &observe(&design, function.model)?, TRUNCATION)
        };
        let design = SobolDesign::scrambled(function.inputs.clone(), points, seed)?;
        let found = gradient_expansion(&design, &slopes(&design, function)?, TRUNCATION)?;
        took_part += if found.derivatives { 100.0 / studies as f64 } else { 0.0 };
        enhanced.add(&found.indices(), exact);
        own.add(&of_values(points)?.indices(), exact);
        reverse.add(&of_values(REVERSE * points)?.indices(), exact);
        differences.add(&of_values((k + 1) * points)?.indices(), exact);
    }
    let [own, enhanced, reverse, differences] =
        [own, enhanced, reverse, differences].map(|errors| errors.text(studies));
    println!(
        "| {}, {k} | {points} | {own} | {enhanced} | {reverse} | {differences} | {took_part:.0} |",
        function.name
    );
    Ok(())
}
