//! All measures on twelve functions: how far off they are, how often their intervals hold, and how long they
//! take. The values that count as true, and the functions' names, go to a file for other programs.

use std::time::Instant;

use cdpr_sensitivity::{
    Bootstrap, Estimate, LatinHypercube, MorrisDesign, Order, RandomDesign, SaltelliDesign, SensitivityError,
    ShapleyDesign, SobolDesign, Truncation, brackets, expansion, morris_effects, observe, rank_indices,
    regression, shapley_effects, sobol_indices,
};

use crate::brackets::{is_smooth, slopes};
use crate::functions::{Function, twelve};

/// Blocks and walks behind the values that count as true.
const TRUE_BLOCKS: usize = 1 << 18;
const TRUE_WALKS: usize = 1 << 18;

/// Values that count as true.
struct Exact {
    first: Vec<f64>,
    total: Vec<f64>,
    morris: Vec<f64>,
    shapley: Vec<f64>,
}

/// What a measure says of each input in one study: an estimate, or an interval around a true value.
type Found = Vec<Estimate>;

/// A measure: what it is of, its runs, and how it is estimated in a study of a seed.
struct Measure<'a> {
    name: &'static str,
    runs: usize,
    exact: &'a [f64],
    has_interval: bool,
    of_seed: Box<dyn Fn(u64) -> Result<Found, SensitivityError> + 'a>,
}

/// Prints a row for each function and measure.
pub(crate) fn table(studies: u64) -> Result<(), SensitivityError> {
    println!("{studies} studies each. error: largest root mean square error of an input; held: share of the");
    println!(
        "intervals of 95 % that hold the true value [%], mean and least over the inputs; *: an interval"
    );
    println!("that holds less than 93 %; ms: time of a study with its runs");
    println!("{:19}{:16}{:>7}{:>11}{:>14}{:>10}", "function", "measure", "runs", "error", "held", "ms");
    let mut lines = Vec::new();
    for function in twelve() {
        if function.name == "constant" {
            constant(&function)?;
            continue;
        }
        let exact = exact(&function)?;
        let list =
            |values: &[f64]| values.iter().map(|value| format!("{value:e}")).collect::<Vec<_>>().join(", ");
        let [first, total] = [list(&exact.first), list(&exact.total)];
        lines.push(format!(r#"  "{}": {{"first": [{first}], "total": [{total}]}}"#, function.name));
        for measure in measures(&function, &exact) {
            row(&function, &measure, studies)?;
        }
    }
    let text = format!("{{\n{}\n}}\n", lines.join(",\n"));
    match std::fs::create_dir_all("target/statistics")
        .and_then(|()| std::fs::write("target/statistics/exact.json", text))
    {
        Ok(()) => println!("written: target/statistics/exact.json"),
        Err(error) => println!("target/statistics/exact.json: {error}"),
    }
    Ok(())
}

fn measures<'a>(function: &'a Function, exact: &'a Exact) -> Vec<Measure<'a>> {
    let k = function.inputs.len();
    let mut all: Vec<Measure> = Vec::new();
    let mut add = |name, runs, exact: &'a [f64], has_interval, of_seed| {
        all.push(Measure { name, runs, exact, has_interval, of_seed });
    };
    let point = |value: f64| Estimate { value, low: value, high: value };
    for blocks in [64, 256] {
        let of = move |seed, total: bool| {
            let found = indices(function, blocks, seed, 200)?;
            Ok(found.inputs.iter().map(|of| if total { of.total } else { of.first }).collect())
        };
        let names =
            if blocks == 64 { ["Sobol' S, 64", "Sobol' T, 64"] } else { ["Sobol' S, 256", "Sobol' T, 256"] };
        add(names[0], blocks * (k + 2), &exact.first, true, Box::new(move |seed| of(seed, false)) as Box<_>);
        add(names[1], blocks * (k + 2), &exact.total, true, Box::new(move |seed| of(seed, true)));
    }
    add(
        "S by ranks",
        256,
        &exact.first,
        true,
        Box::new(move |seed| {
            let design = RandomDesign::new(function.inputs.clone(), 256, seed)?;
            let outputs = observe(&design, function.model)?;
            rank_indices(&cdpr_sensitivity::GivenData::of_design(&design, &outputs)?, 0.95, seed)
        }),
    );
    add(
        "Shapley",
        256 * (k + 1),
        &exact.shapley,
        true,
        Box::new(move |seed| {
            let design = ShapleyDesign::new(function.inputs.clone(), 256, seed)?;
            let found = shapley_effects(&design, &observe(&design, function.model)?, 0.95)?;
            Ok(found.into_iter().map(|of| of.effect).collect())
        }),
    );
    add(
        "Morris mu*",
        64 * (k + 1),
        &exact.morris,
        true,
        Box::new(move |seed| {
            let found = trajectories(function, 64, seed)?;
            Ok(found)
        }),
    );
    if k <= 20 {
        for (name, total) in [("expansion S", false), ("expansion T", true)] {
            let exact = if total { &exact.total } else { &exact.first };
            add(
                name,
                256,
                exact,
                false,
                Box::new(move |seed| {
                    let design = LatinHypercube::new(function.inputs.clone(), 256, seed)?;
                    let outputs = observe(&design, function.model)?;
                    let truncation = Truncation { max_degree: 4, norm: 0.75, interactions: 2 };
                    let found = expansion(&design, &outputs, truncation)?.indices();
                    Ok(found.iter().map(|of| point(if total { of.total } else { of.closed })).collect())
                }),
            );
        }
    }
    if k < 100 {
        add(
            "SRC2",
            256,
            &exact.first,
            false,
            Box::new(move |seed| {
                let design = LatinHypercube::new(function.inputs.clone(), 256, seed)?;
                let found = regression(&design, &observe(&design, function.model)?)?;
                Ok(found.inputs.iter().map(|of| point(of.share)).collect())
            }),
        );
    }
    if is_smooth(function) && k <= 20 {
        add(
            "bounds of T",
            256,
            &exact.total,
            true,
            Box::new(move |seed| {
                let design = SobolDesign::scrambled(function.inputs.clone(), 256, seed)?;
                let found = brackets(&design, &slopes(&design, function)?, 0.95, seed)?;
                let between = |of: &cdpr_sensitivity::Bracket| Estimate {
                    value: 0.5 * (of.total_lower.value + of.total_upper.value),
                    low: of.total_lower.low,
                    high: of.total_upper.high,
                };
                Ok(found.iter().map(between).collect())
            }),
        );
    }
    all
}

fn row(function: &Function, measure: &Measure, studies: u64) -> Result<(), SensitivityError> {
    /// Errors of the values that count as true.
    const NEAR: f64 = 1e-4;
    let clock = Instant::now();
    let k = measure.exact.len();
    let (mut squares, mut held) = (vec![0.0; k], vec![0.0; k]);
    for seed in 0..studies {
        for (i, found) in (measure.of_seed)(seed)?.iter().enumerate() {
            let exact = measure.exact[i];
            squares[i] += (found.value - exact).powi(2) / studies as f64;
            let near = NEAR * exact.abs().max(1.0);
            let holds = found.low - near <= exact && exact <= found.high + near;
            held[i] += if holds { 100.0 / studies as f64 } else { 0.0 };
        }
    }
    let milliseconds = 1e3 * clock.elapsed().as_secs_f64() / studies as f64;
    let error = squares.iter().fold(0.0_f64, |most, square| most.max(*square)).sqrt();
    let (mean, least) = (held.iter().sum::<f64>() / k as f64, held.iter().copied().fold(100.0, f64::min));
    let held = match measure.has_interval {
        true => format!("{mean:.1} {least:.1}{}", if least < 93.0 { "*" } else { " " }),
        false => "-".to_owned(),
    };
    println!(
        "{:19}{:16}{:>7}{error:>11.5}{held:>14}{milliseconds:>10.2}",
        function.name, measure.name, measure.runs
    );
    Ok(())
}

/// Shares of a variance of zero are an error, elementary effects are zero.
fn constant(function: &Function) -> Result<(), SensitivityError> {
    match indices(function, 64, 1, 2) {
        Err(error) => println!("{:19}Sobol', Shapley, ranks, expansion: {error}", function.name),
        Ok(_) => println!("{:19}Sobol' indices without an error", function.name),
    }
    let most = trajectories(function, 64, 1)?.iter().map(|of| of.high).fold(0.0, f64::max);
    println!("{:19}Morris mu* at most {most}", function.name);
    Ok(())
}

fn exact(function: &Function) -> Result<Exact, SensitivityError> {
    let found = indices(function, TRUE_BLOCKS, u64::MAX, 2)?;
    let values = |of: Vec<Estimate>| of.into_iter().map(|of| of.value).collect::<Vec<f64>>();
    let walks = TRUE_WALKS / if function.inputs.len() > 20 { 4 } else { 1 };
    let design = ShapleyDesign::new(function.inputs.clone(), walks, u64::MAX)?;
    let shapley = shapley_effects(&design, &observe(&design, function.model)?, 0.95)?;
    Ok(Exact {
        first: found.inputs.iter().map(|of| of.first.value).collect(),
        total: found.inputs.iter().map(|of| of.total.value).collect(),
        morris: values(trajectories(function, TRUE_BLOCKS / 4, u64::MAX)?),
        shapley: shapley.iter().map(|of| of.effect.value).collect(),
    })
}

fn trajectories(function: &Function, blocks: usize, seed: u64) -> Result<Found, SensitivityError> {
    let design = MorrisDesign::trajectories(function.inputs.clone(), blocks, 4, seed)?;
    let found = morris_effects(&design, &observe(&design, function.model)?, 0.95)?;
    Ok(found.iter().map(|of| of.mean_absolute).collect())
}

fn indices(
    function: &Function,
    blocks: usize,
    seed: u64,
    resamples: usize,
) -> Result<cdpr_sensitivity::SobolIndices, SensitivityError> {
    let design = SaltelliDesign::scrambled(function.inputs.clone(), blocks, Order::First, seed)?;
    let outputs = observe(&design, function.model)?;
    sobol_indices(&design, &outputs, Bootstrap { resamples, seed }, 0.95)
}
