//! `cargo xtask bench`: medians and instruction counts of all criterion benchmarks, compared with a baseline.

#![allow(clippy::print_stdout)]

mod measure;

use crate::cargo::root;
use measure::{BenchError, Benchmark, Run, measure, read};
use std::process::ExitCode;

/// A median is slower if the 95 % intervals do not overlap and it grew by more than this.
const TIME_NOISE: f64 = 0.10;

/// A count is worse if it grew by more than this.
const COUNT_NOISE: f64 = 0.01;

const BASELINE: &str = "data/benchmarks/baseline.json";
/// The same as a table of the book.
const BOOK: &str = "data/benchmarks/baseline.md";

/// A figure beside that of the baseline.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Change {
    /// New over old.
    ratio: f64,
    beyond_noise: bool,
}

impl Change {
    fn of_time(now: &Benchmark, then: &Benchmark) -> Self {
        let ratio = now.median_ns / then.median_ns;
        let apart = now.interval_ns[0] > then.interval_ns[1] || now.interval_ns[1] < then.interval_ns[0];
        Self { ratio, beyond_noise: apart && (ratio - 1.0).abs() > TIME_NOISE }
    }

    fn of_count(now: u64, then: u64) -> Self {
        let ratio = now as f64 / then as f64;
        Self { ratio, beyond_noise: (ratio - 1.0).abs() > COUNT_NOISE }
    }

    fn is_worse(self) -> bool {
        self.beyond_noise && self.ratio > 1.0
    }

    /// Text in percent, in brackets if it is noise.
    fn text(self) -> String {
        let percent = format!("{:+.1} %", 100.0 * (self.ratio - 1.0));
        if self.beyond_noise { percent } else { format!("({percent})") }
    }
}

/// A benchmark, its counterpart in the baseline and the changes.
struct Row<'a> {
    now: &'a Benchmark,
    then: Option<&'a Benchmark>,
    time: Option<Change>,
    count: Option<Change>,
}

impl<'a> Row<'a> {
    fn new(now: &'a Benchmark, baseline: &'a [Benchmark]) -> Self {
        let then = baseline.iter().find(|then| then.name == now.name);
        let counts = now.instructions.zip(then.and_then(|then| then.instructions));
        Self {
            now,
            then,
            time: then.map(|then| Change::of_time(now, then)),
            count: counts.map(|(now, then)| Change::of_count(now, then)),
        }
    }

    fn print(&self) {
        let Self { now, then, time, count } = self;
        let or_dash = |text: Option<String>| text.unwrap_or_else(|| "-".to_owned());
        let change = |change: &Option<Change>| or_dash(change.map(Change::text));
        println!(
            "{:<40}{:>11}{:>23}{:>11}{:>11}{:>11}{:>14}{:>11}",
            now.name,
            duration(now.median_ns),
            now.interval_ns.map(duration).join(" .. "),
            or_dash((now.elements > 1).then(|| duration(now.median_ns / now.elements as f64))),
            or_dash(then.map(|then| duration(then.median_ns))),
            change(time),
            or_dash(now.instructions.map(|count| count.to_string())),
            change(count),
        );
    }
}

/// Whether a slower median is a failure, as a larger count always is.
#[derive(Clone, Copy, PartialEq)]
enum Times {
    Reported,
    Strict,
}

/// Runs the benchmarks; `rest` holds options of this task, then those of criterion.
pub(crate) fn run(mut rest: Vec<String>) -> ExitCode {
    let mut take = |option: &str| {
        let before = rest.len();
        rest.retain(|argument| argument != option);
        rest.len() < before
    };
    let save = take("--save-baseline");
    let times = if take("--strict") { Times::Strict } else { Times::Reported };
    if save && !rest.is_empty() {
        eprintln!(
            "error: --save-baseline with `{}`: expected no further arguments, because a \
             baseline holds all benchmarks",
            rest.join(" ")
        );
        return ExitCode::FAILURE;
    }
    let outcome = measure(&rest).and_then(|now| {
        let code = compare(&now, times)?;
        if save { write_baseline(&now).map(|()| ExitCode::SUCCESS) } else { Ok(code) }
    });
    outcome.unwrap_or_else(|error| {
        eprintln!("error: {error}");
        ExitCode::FAILURE
    })
}

/// Prints the table, and the changes that are larger than noise.
fn compare(now: &Run, times: Times) -> Result<ExitCode, BenchError> {
    let path = root().join(BASELINE);
    let baseline: Option<Run> = if path.exists() { Some(read(&path)?) } else { None };
    let then = baseline.as_ref().map_or(&[][..], |run| &run.benchmarks);
    println!(
        "\n{:<40}{:>11}{:>23}{:>11}{:>11}{:>11}{:>14}{:>11}",
        "benchmark", "median", "95 % interval", "each", "baseline", "change", "instructions", "change"
    );
    let rows: Vec<Row> = now.benchmarks.iter().map(|benchmark| Row::new(benchmark, then)).collect();
    rows.iter().for_each(Row::print);
    println!("\n{}", now.machine.text());
    match &baseline {
        Some(run) => {
            println!("baseline: {}", run.machine.text());
            if run.machine.cpu != now.machine.cpu {
                println!("its times are those of another processor");
            }
            if run.machine.rustc != now.machine.rustc || run.machine.valgrind != now.machine.valgrind {
                println!("its instruction counts are those of other tools");
            }
        }
        None => println!("baseline: none, write one with `cargo xtask bench --save-baseline`"),
    }
    let worse = |change: fn(&Row) -> Option<Change>| {
        let worse = |row: &&Row| change(row).is_some_and(Change::is_worse);
        rows.iter().filter(worse).map(|row| row.now.name.as_str()).collect::<Vec<_>>()
    };
    let (slower, more) = (worse(|row| row.time), worse(|row| row.count));
    for (what, names) in [("slower", &slower), ("more instructions", &more)] {
        if !names.is_empty() {
            println!("{what}: {}", names.join(", "));
        }
    }
    let fails = !more.is_empty() || times == Times::Strict && !slower.is_empty();
    Ok(if fails { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

fn write_baseline(run: &Run) -> Result<(), BenchError> {
    let path = root().join(BASELINE);
    let text = serde_json::to_string_pretty(run)
        .map_err(|source| BenchError::Json { path: path.clone(), source })?;
    let folder = path.parent().map_or(Ok(()), std::fs::create_dir_all);
    let written = folder.and_then(|()| std::fs::write(&path, text + "\n"));
    written.map_err(|source| BenchError::File { path, source })?;
    let path = root().join(BOOK);
    std::fs::write(&path, table(run)).map_err(|source| BenchError::File { path, source })?;
    println!("written: {BASELINE}, {BOOK}");
    Ok(())
}

/// The baseline as the book has it.
fn table(run: &Run) -> String {
    let mut table = format!("{}\n\n", run.machine.text());
    table += "| benchmark | median | each | instructions |\n|---|---|---|---|\n";
    for Benchmark { name, elements, median_ns, instructions, .. } in &run.benchmarks {
        let each = if *elements > 1 { duration(median_ns / *elements as f64) } else { String::new() };
        let count = instructions.map_or_else(String::new, |count| count.to_string());
        table += &format!("| `{name}` | {} | {each} | {count} |\n", duration(*median_ns));
    }
    table
}

/// Duration with a unit and three digits, from 1 ns on.
fn duration(ns: f64) -> String {
    let units = [(1e9, "s"), (1e6, "ms"), (1e3, "µs"), (1.0, "ns")];
    let (size, unit) = units.into_iter().find(|(size, _)| ns >= *size).unwrap_or((1.0, "ns"));
    let value = ns / size;
    // 9.996 is printed as 10.0.
    let digits = if value < 9.995 { 2 } else { usize::from(value < 99.95) };
    format!("{value:.digits$} {unit}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn benchmark(median_ns: f64, half_width: f64) -> Benchmark {
        Benchmark {
            name: "direct/near".to_owned(),
            elements: 1,
            median_ns,
            interval_ns: [median_ns - half_width, median_ns + half_width],
            instructions: None,
        }
    }

    #[test]
    fn a_median_is_slower_beyond_both_the_intervals_and_the_threshold() {
        let then = benchmark(100.0, 2.0);
        let worse = |now| Change::of_time(&now, &then).is_worse();
        assert!(worse(benchmark(115.0, 2.0)));
        assert!(!worse(benchmark(109.0, 2.0)), "below the threshold");
        assert!(!worse(benchmark(115.0, 20.0)), "intervals that overlap");
    }

    #[test]
    fn a_faster_median_is_beyond_the_noise_but_not_worse() {
        let change = Change::of_time(&benchmark(80.0, 2.0), &benchmark(100.0, 2.0));
        assert!(change.beyond_noise && !change.is_worse());
        assert_eq!(change.text(), "-20.0 %");
    }

    #[test]
    fn a_count_is_worse_beyond_a_percent() {
        assert!(Change::of_count(10_150, 10_000).is_worse());
        assert!(!Change::of_count(10_050, 10_000).is_worse());
        assert!(!Change::of_count(9_000, 10_000).is_worse());
        assert_eq!(Change::of_count(10_050, 10_000).text(), "(+0.5 %)");
    }

    #[test]
    fn a_benchmark_is_compared_with_its_namesake_alone() {
        let baseline = [benchmark(100.0, 1.0)];
        let now = Benchmark { instructions: Some(7), ..benchmark(150.0, 1.0) };
        let row = Row::new(&now, &baseline);
        assert_eq!(row.time, Some(Change { ratio: 1.5, beyond_noise: true }));
        assert_eq!(row.count, None, "the baseline has no count");
        let other = Benchmark { name: "direct/far".to_owned(), ..now.clone() };
        assert!(Row::new(&other, &baseline).then.is_none());
    }

    #[test]
    fn durations_have_a_unit_and_three_digits() {
        assert_eq!([0.5, 9.996, 1_234.0, 2.5e8].map(duration), ["0.50 ns", "10.0 ns", "1.23 µs", "250 ms"]);
    }
}
