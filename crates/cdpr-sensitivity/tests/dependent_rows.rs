//! Tables of y = 2 x1 + x2 x3 + noise whose rows are of a sequence, in part, rounded or in another order.

use crate::common::{rows, unit};
use crate::known_tables::Source;
use cdpr_sensitivity::{
    Analyser, GivenData, Halton, LatinHypercube, RandomDesign, RowPattern, SensitivityError, SobolDesign,
    rank_indices,
};
use rayon::prelude::*;

const TABLES: u64 = 20;

/// What is said of tables.
#[derive(Debug, Default)]
struct Count {
    refused: usize,
    /// Indices whose interval leaves out the true one.
    missed: usize,
    /// Tables in which an inert input is certain to matter.
    wrong: usize,
    /// Tables in which x1 is certain.
    found: usize,
}

/// The table of some rows; `None` for a row that failed.
fn table(rows: &[Vec<f64>], keep: impl Fn(usize) -> bool, noise: &mut Source) -> GivenData {
    let noise = noise.uniforms(rows.len());
    // The noise has the variance 0.09.
    let y = |(row, x): (usize, &Vec<f64>)| {
        keep(row).then(|| 2.0 * x[0] + x[1] * x[2] + 0.3 * 12.0_f64.sqrt() * (noise[row] - 0.5))
    };
    let columns = (0..rows[0].len()).map(|input| rows.iter().map(|x| x[input]).collect()).collect();
    let names = (1..=rows[0].len()).map(|input| format!("x{input}")).collect();
    GivenData::new(names, columns, rows.iter().enumerate().map(y).collect()).unwrap()
}

fn counted(of: impl Fn(u64) -> GivenData + Sync) -> Count {
    let variance = 4.0 / 12.0 + 7.0 / 144.0 + 0.09;
    let truth = [1.0 / 3.0, 1.0 / 48.0, 1.0 / 48.0].map(|of| of / variance);
    let one = |seed: u64| {
        let data = of(seed);
        let indices = rank_indices(&data, 0.95, 1).ok();
        let misses = |i: usize, low: f64, high: f64| {
            let truth = truth.get(i).copied().unwrap_or_default();
            !(low..=high).contains(&truth)
        };
        let missed = indices.iter().flatten().enumerate().filter(|(i, of)| misses(*i, of.low, of.high));
        let certain = Analyser::new(seed).verdict(&data).unwrap().certain;
        let inert = |input: &str| !["x1", "x2", "x3"].contains(&input);
        Count {
            refused: usize::from(indices.is_none()),
            missed: missed.count(),
            wrong: usize::from(certain.iter().any(|of| inert(&of.input))),
            found: usize::from(certain.iter().any(|of| of.input == "x1")),
        }
    };
    let all: Vec<Count> = (0..TABLES).into_par_iter().map(one).collect();
    let sum = |of: fn(&Count) -> usize| all.iter().map(of).sum::<usize>();
    Count {
        refused: sum(|of| of.refused),
        missed: sum(|of| of.missed),
        wrong: sum(|of| of.wrong),
        found: sum(|of| of.found),
    }
}

fn sobol(inputs: usize, points: usize, seed: u64) -> Vec<Vec<f64>> {
    rows(&SobolDesign::scrambled(unit(inputs), points, seed).unwrap(), 1)
}

/// Rows of which a share is deleted, or has no output.
fn dropped(points: usize, share: f64, seed: u64, deleted: bool) -> GivenData {
    let mut source = Source::new(seed);
    let drawn = source.uniforms(points);
    let all = sobol(6, points, seed);
    if !deleted {
        return table(&all, |row| drawn[row] > share, &mut source);
    }
    let kept: Vec<Vec<f64>> =
        all.into_iter().zip(&drawn).filter(|(_, drawn)| **drawn > share).map(|of| of.0).collect();
    table(&kept, |_| true, &mut source)
}

/// Rows n a modulo 1 with the powers a of the inverse of the root of g^(d + 1) = g + 1.
fn kronecker(inputs: usize, points: usize, seed: u64) -> Vec<Vec<f64>> {
    let root = (0..60).fold(2.0_f64, |g, _| (1.0 + g).powf(1.0 / (inputs as f64 + 1.0)));
    let value = |row: usize, input: usize| {
        (0.137 * seed as f64 + (row + 1) as f64 * root.powi(-1 - i32::try_from(input).unwrap())).fract()
    };
    (0..points).map(|row| (0..inputs).map(|input| value(row, input)).collect()).collect()
}

#[test]
fn rows_of_a_sequence_have_no_indices_and_no_false_effect_though_some_are_deleted_failed_or_rounded() {
    let whole = |rows: Vec<Vec<f64>>, seed: u64| table(&rows, |_| true, &mut Source::new(seed));
    let of = |name: &str, tables: &(dyn Fn(u64) -> GivenData + Sync)| {
        let count = counted(tables);
        // Of 6 inputs and 20 tables, 5 % are 6.
        assert!(count.wrong <= 1 && count.missed <= 2 && count.refused >= 18, "{name}: {count:?}");
        assert!(count.found >= 18, "{name}: {count:?}");
    };
    for share in [0.15, 0.25, 0.4] {
        of(&format!("deleted {share}"), &|seed| dropped(256, share, seed, true));
        of(&format!("failed {share}"), &|seed| dropped(256, share, seed, false));
    }
    of("64 rows", &|seed| whole(sobol(4, 64, seed), seed));
    of("Halton, 6", &|seed| whole(rows(&Halton::scrambled(unit(6), 200, seed).unwrap(), 1), seed));
    of("Halton, 4", &|seed| whole(rows(&Halton::scrambled(unit(4), 150, seed).unwrap(), 1), seed));
    of("Kronecker", &|seed| whole(kronecker(4, 150, seed), seed));
    let rounded = |row: Vec<f64>| row.into_iter().map(|x| (100.0 * x).round() / 100.0).collect();
    of("rounded", &|seed| whole(sobol(4, 200, seed).into_iter().map(rounded).collect(), seed));
}

#[test]
fn random_rows_and_latin_hypercubes_have_indices() {
    let whole = |design: &dyn Fn(u64) -> Vec<Vec<f64>>, seed| {
        table(&design(seed), |_| true, &mut Source::new(1000 + seed))
    };
    for (inputs, points) in [(3, 40), (6, 200), (20, 300)] {
        let random = |seed| rows(&RandomDesign::new(unit(inputs), points, seed).unwrap(), 1);
        let latin = |seed| rows(&LatinHypercube::new(unit(inputs), points, seed).unwrap(), 1);
        for (name, count) in
            [("random", counted(|seed| whole(&random, seed))), ("Latin", counted(|seed| whole(&latin, seed)))]
        {
            assert!(count.refused == 0 && count.wrong <= 3, "{name}, {inputs}: {count:?}");
            assert!(count.missed <= 2 * inputs && count.found >= 18, "{name}, {inputs}: {count:?}");
        }
    }
}

/// Blocks of two points and of those with one input exchanged, with the output sin 6 x1, in random order.
fn saltelli(inputs: usize, blocks: usize, seed: u64) -> GivenData {
    let mut source = Source::new(seed);
    let mut rows = Vec::new();
    for _ in 0..blocks {
        let [a, b] = [0, 1].map(|_| source.uniforms(inputs));
        for input in 0..inputs {
            let mut exchanged = a.clone();
            exchanged[input] = b[input];
            rows.push(exchanged);
        }
        rows.extend([a, b]);
    }
    let keys = source.uniforms(rows.len());
    let mut order: Vec<usize> = (0..rows.len()).collect();
    order.sort_by(|&a, &b| keys[a].total_cmp(&keys[b]));
    let columns = (0..inputs).map(|input| order.iter().map(|&row| rows[row][input]).collect()).collect();
    let names = (1..=inputs).map(|input| format!("x{input}")).collect();
    GivenData::new(names, columns, order.iter().map(|&row| Some((6.0 * rows[row][0]).sin())).collect())
        .unwrap()
}

/// Inert inputs would have shares of 25 to 60 %.
#[test]
fn rows_with_inputs_of_others_have_no_shares_by_ranks() {
    for (inputs, blocks) in [(3, 40), (6, 25), (10, 20)] {
        for seed in 0..TABLES {
            let found = rank_indices(&saltelli(inputs, blocks, seed), 0.95, 1);
            let is_shared = |error: &SensitivityError| {
                matches!(error, SensitivityError::DependentRows { pattern: RowPattern::Shared { .. }, .. })
            };
            assert!(found.as_ref().is_err_and(is_shared), "{inputs} {seed}: {found:?}");
        }
    }
    // Rounded, random inputs, which depend on each other or not, have values in common, but no rows.
    for seed in 0..TABLES {
        let mut source = Source::new(seed);
        let common = source.uniforms(200);
        for share in [0.0, 0.7] {
            let column = |_| -> Vec<f64> {
                let own = source.uniforms(200);
                let mixed = own.iter().zip(&common).map(|(own, common)| share * common + (1.0 - share) * own);
                mixed.map(|value| (40.0 * value).round()).collect()
            };
            let columns: Vec<Vec<f64>> = (0..4).map(column).collect();
            let y = columns[0].iter().zip(&common).map(|(x, noise)| Some(x + 5.0 * noise)).collect();
            let names = (1..=4).map(|input| format!("x{input}")).collect();
            let found = rank_indices(&GivenData::new(names, columns, y).unwrap(), 0.95, 1);
            assert!(found.is_ok(), "{share} {seed}: {found:?}");
        }
    }
}
