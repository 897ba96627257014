//! All measures on twelve functions: how far off they are, how often their intervals hold, and how long they
//! take. Each row goes to a file as well, from which `peers/run statistics` reads it.

use std::fs;
use std::time::SystemTime;

use cdpr_sensitivity::{
    Bootstrap, Bracket, Delta, Estimate, GivenData, LatinHypercube, MorrisDesign, Order, RandomDesign, Rows,
    SaltelliDesign, SensitivityError, ShapleyDesign, SobolDesign, SobolIndices, Truncation, brackets, delta,
    dependence, expansion, morris_effects, observe, pawn, rank_indices, regression, shapley_effects,
    sobol_indices,
};
use serde_json::{Value, json};

use crate::brackets::{is_smooth, slopes};
use crate::exact::{Exact, holds};
use crate::functions::{Function, twelve};

const FILE: &str = "target/statistics/measures.json";

/// What a measure says of each input in one study: an interval around a true value, or an estimate alone.
type Found = Vec<Estimate>;

/// Measures that one study of a seed estimates together.
struct Study<'a> {
    runs: usize,
    /// One study of many inputs takes long: a tenth of them have to do.
    is_dear: bool,
    /// Names and true values.
    measures: Vec<(&'static str, &'a [f64])>,
    of_seed: Box<dyn Fn(u64) -> Result<Vec<Found>, SensitivityError> + 'a>,
}

impl<'a> Study<'a> {
    fn new<const N: usize>(
        runs: usize,
        is_dear: bool,
        measures: [(&'static str, &'a Vec<f64>); N],
        of_seed: impl Fn(u64) -> Result<Vec<Found>, SensitivityError> + 'a,
    ) -> Self {
        let measures = measures.map(|(name, exact)| (name, exact.as_slice())).into();
        Self { runs, is_dear, measures, of_seed: Box::new(of_seed) }
    }
}

/// Prints a row for each function and measure whose names contain a part, or `FUNCTION/MEASURE`.
pub(crate) fn table(studies: u64, part: &str) -> Result<(), SensitivityError> {
    println!("error: largest root mean square error of an input; held: share of the intervals of 95 % that");
    println!("hold the true value [%], mean and least over the inputs; *: an interval that holds less than");
    println!("93 %; ms: CPU time of a study with its runs\n");
    println!("| function | measure | runs | studies | error | held | ms |");
    println!("|---|---|---|---|---|---|---|");
    let mut rows = Vec::new();
    // A part of the name of no function is that of measures.
    let is_function = twelve().iter().any(|function| function.name.contains(part));
    let (of_functions, of_measures) =
        part.split_once('/').unwrap_or(if is_function { (part, "") } else { ("", part) });
    for function in twelve().into_iter().filter(|of| of.name.contains(of_functions)) {
        if function.name == "constant" {
            if of_measures.is_empty() {
                constant(&function)?;
            }
            continue;
        }
        let mut exact = Exact::of(&function)?;
        if ["delta", "PAWN", "HSIC"].iter().any(|name| of_measures.is_empty() || of_measures.contains(name)) {
            exact = exact.with_tables(&function)?;
        }
        for study in plan(&function, &exact)
            .into_iter()
            .filter(|of| of.measures.iter().any(|(measure, _)| measure.contains(of_measures)))
        {
            let studies = if study.is_dear { studies.div_ceil(10) } else { studies };
            rows.extend(carry_out(&function, &study, studies)?);
        }
    }
    match fs::write(FILE, Value::from(rows).to_string()) {
        Ok(()) => println!("\nwritten: {FILE}"),
        Err(error) => println!("\n{FILE}: {error}"),
    }
    Ok(())
}

/// The studies of a function.
fn plan<'a>(function: &'a Function, exact: &'a Exact) -> Vec<Study<'a>> {
    let mut all = of_blocks(function, exact);
    all.extend(of_fits(function, exact));
    all.extend(of_tables(function, exact));
    all
}

/// Measures with designs of their own.
fn of_blocks<'a>(function: &'a Function, exact: &'a Exact) -> Vec<Study<'a>> {
    let inputs = || function.inputs.clone();
    let k = function.inputs.len();
    let mut all = Vec::new();
    for (blocks, [first, total]) in
        [(64, ["Sobol' S, 64", "Sobol' T, 64"]), (256, ["Sobol' S, 256", "Sobol' T, 256"])]
    {
        let measures = [(first, &exact.first), (total, &exact.total)];
        all.push(Study::new(blocks * (k + 2), k > 20, measures, move |seed| {
            let found = indices(function, blocks, seed)?.inputs;
            Ok(vec![found.iter().map(|of| of.first).collect(), found.iter().map(|of| of.total).collect()])
        }));
    }
    all.push(Study::new(256 * (k + 1), false, [("Shapley", &exact.shapley)], move |seed| {
        let design = ShapleyDesign::new(inputs(), 256, seed)?;
        let found = shapley_effects(&design, &observe(&design, function.model)?, 0.95)?;
        Ok(vec![found.into_iter().map(|of| of.effect).collect()])
    }));
    all.push(Study::new(64 * (k + 1), k > 20, [("Morris mu*", &exact.morris)], move |seed| {
        Ok(vec![trajectories(function, 64, seed)?])
    }));
    if is_smooth(function) {
        all.push(Study::new(256, k > 10, [("bounds of T", &exact.total)], move |seed| {
            let design = SobolDesign::scrambled(inputs(), 256, seed)?;
            let found = brackets(&design, &slopes(&design, function)?, 0.95, seed)?;
            let between = |of: &Bracket| Estimate {
                value: 0.5 * (of.total_lower.value + of.total_upper.value),
                low: of.total_lower.low,
                high: of.total_upper.high,
            };
            Ok(vec![found.iter().map(between).collect()])
        }));
    }
    all
}

/// Measures by a model that is fitted to few observations.
fn of_fits<'a>(function: &'a Function, exact: &'a Exact) -> Vec<Study<'a>> {
    let inputs = || function.inputs.clone();
    let k = function.inputs.len();
    let mut all = Vec::new();
    if k <= 20 {
        let measures = [("expansion S", &exact.first), ("expansion T", &exact.total)];
        all.push(Study::new(256, k > 10, measures, move |seed| {
            let design = LatinHypercube::new(inputs(), 256, seed)?;
            let outputs = observe(&design, function.model)?;
            let truncation = Truncation { max_degree: 4, norm: 0.75, interactions: 2 };
            let found = expansion(&design, &outputs, truncation)?.indices();
            let closed = found.iter().map(|of| point(of.closed)).collect();
            Ok(vec![closed, found.iter().map(|of| point(of.total)).collect()])
        }));
    }
    all.push(Study::new(256, k > 20, [("SRC2", &exact.first)], move |seed| {
        let design = LatinHypercube::new(inputs(), 256, seed)?;
        let found = regression(&design, &observe(&design, function.model)?)?;
        Ok(vec![found.inputs.iter().map(|of| point(of.share)).collect()])
    }));
    all
}

/// Measures of a table of independent rows.
fn of_tables<'a>(function: &'a Function, exact: &'a Exact) -> Vec<Study<'a>> {
    let mut all = vec![Study::new(256, false, [("S by ranks", &exact.first)], move |seed| {
        Ok(vec![rank_indices(&random(function, 256, seed)?, 0.95, seed)?])
    })];
    for (rows, name) in [(256, "delta, 256"), (1024, "delta, 1024"), (4096, "delta, 4096")] {
        all.push(Study::new(rows, true, [(name, &exact.tables.delta)], move |seed| {
            let found = delta(&random(function, rows, seed)?, 0.95, seed)?;
            let above = |of: &Delta| Estimate { value: of.delta, low: of.at_least, high: 1.0 };
            Ok(vec![found.iter().map(above).collect()])
        }));
    }
    let measures = [("PAWN", &exact.tables.pawn), ("HSIC R2", &exact.tables.r_squared)];
    all.push(Study::new(256, function.inputs.len() > 10, measures, move |seed| {
        let data = random(function, 256, seed)?;
        let dependent = dependence(&data, Rows { most: 256, seed })?;
        let medians = pawn(&data, seed)?.iter().map(|of| point(of.median)).collect();
        Ok(vec![medians, dependent.iter().map(|of| point(of.r_squared)).collect()])
    }));
    all
}

/// A table of independent rows.
pub(crate) fn random(function: &Function, rows: usize, seed: u64) -> Result<GivenData, SensitivityError> {
    let design = RandomDesign::new(function.inputs.clone(), rows, seed)?;
    GivenData::of_design(&design, &observe(&design, function.model)?)
}

fn point(value: f64) -> Estimate {
    Estimate { value, low: value, high: value }
}

/// Prints the rows of a study and returns them.
fn carry_out(function: &Function, study: &Study, studies: u64) -> Result<Vec<Value>, SensitivityError> {
    let k = function.inputs.len();
    let start = seconds();
    let mut sums = vec![vec![[0.0; 2]; k]; study.measures.len()];
    let mut has_interval = false;
    for seed in 0..studies {
        for ((found, (_, exact)), sums) in (study.of_seed)(seed)?.iter().zip(&study.measures).zip(&mut sums) {
            for ((found, exact), [squares, held]) in found.iter().zip(*exact).zip(sums) {
                *squares += (found.value - exact).powi(2) / studies as f64;
                *held += if holds(found, *exact) { 100.0 / studies as f64 } else { 0.0 };
                has_interval |= found.low < found.high;
            }
        }
    }
    let milliseconds = 1e3 * (seconds() - start) / studies as f64;
    let row = |((name, _), sums): (&(&str, &[f64]), Vec<[f64; 2]>)| {
        let error = sums.iter().fold(0.0_f64, |most, [square, _]| most.max(*square)).sqrt();
        let mean = sums.iter().map(|[_, held]| held).sum::<f64>() / k as f64;
        let least = sums.iter().map(|[_, held]| *held).fold(100.0, f64::min);
        let mark = if least < 93.0 { "*" } else { "" };
        let held = if has_interval { format!("{mean:.1} / {least:.1}{mark}") } else { "-".to_owned() };
        let Study { runs, .. } = study;
        println!(
            "| {} | {name} | {runs} | {studies} | {error:.5} | {held} | {milliseconds:.2} |",
            function.name
        );
        let held = has_interval.then_some([mean, least]);
        json!({"program": "cdpr", "function": function.name, "measure": name, "runs": runs,
            "studies": studies, "error": error, "held": held, "ms": milliseconds})
    };
    Ok(study.measures.iter().zip(sums).map(row).collect())
}

/// Indices of a study of this many blocks.
pub(crate) fn indices(
    function: &Function,
    blocks: usize,
    seed: u64,
) -> Result<SobolIndices, SensitivityError> {
    let design = SaltelliDesign::scrambled(function.inputs.clone(), blocks, Order::First, seed)?;
    let outputs = observe(&design, function.model)?;
    sobol_indices(&design, &outputs, Bootstrap { resamples: 200, seed }, 0.95)
}

/// Shares of a variance of zero are an error, elementary effects are zero.
fn constant(function: &Function) -> Result<(), SensitivityError> {
    match indices(function, 64, 1) {
        Err(error) => println!("| {} | all shares | | 1 | {error} | | |", function.name),
        Ok(_) => println!("| {} | Sobol' indices without an error | | 1 | | | |", function.name),
    }
    let most = trajectories(function, 64, 1)?.iter().map(|of| of.high).fold(0.0, f64::max);
    println!("| {} | Morris mu* | | 1 | at most {most} | | |", function.name);
    Ok(())
}

fn trajectories(function: &Function, blocks: usize, seed: u64) -> Result<Found, SensitivityError> {
    let design = MorrisDesign::trajectories(function.inputs.clone(), blocks, 4, seed)?;
    let found = morris_effects(&design, &observe(&design, function.model)?, 0.95)?;
    Ok(found.iter().map(|of| of.mean_absolute).collect())
}

/// CPU time of this process where the system states it (Linux), elsewhere the time of the clock [s].
///
/// The first of the three numbers of a thread's `schedstat` is its time on a processor [ns].
fn seconds() -> f64 {
    let of_thread = |task: std::io::Result<fs::DirEntry>| {
        let text = fs::read_to_string(task.ok()?.path().join("schedstat")).ok()?;
        Some(1e-9 * text.split(' ').next()?.parse::<f64>().ok()?)
    };
    let of_process = fs::read_dir("/proc/self/task").ok().and_then(|tasks| tasks.map(of_thread).sum());
    of_process.unwrap_or_else(|| SystemTime::UNIX_EPOCH.elapsed().map_or(f64::NAN, |time| time.as_secs_f64()))
}
