//! Designs, effects, fits, indices and expansions over the number of observations N, for 62 uniform inputs as
//! in the paper.

use std::hint::black_box;
use std::time::Duration;

use cdpr_sensitivity::{
    Bootstrap, Family, Input, Law, MorrisDesign, Order, SaltelliDesign, Sample, SampleDesign,
    SensitivityError, SobolDesign, SobolIndex, Steps, Truncation, expansion, fit_all, observe, sobol_indices,
    student_effects,
};
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, Throughput};

const INPUTS: usize = 62;

fn inputs() -> Vec<Input> {
    let law = Law::Uniform { min: -0.03, max: 0.03 };
    let steps = Steps::Nearest { step: 0.0012 };
    (0..INPUTS).map(|i| Input::stepped(format!("x{i}"), law, steps)).collect()
}

/// All rows, one after the other.
fn rows(design: &impl SampleDesign) -> Result<Vec<f64>, SensitivityError> {
    let mut rows = vec![0.0; design.points() * INPUTS];
    design.rows(0, &mut rows)?;
    Ok(rows)
}

/// All points of the unit cube, one after the other.
fn unit_points(design: &impl SampleDesign) -> Result<Vec<f64>, SensitivityError> {
    let mut points = vec![0.0; design.points() * INPUTS];
    design.unit_points(0, &mut points)?;
    Ok(points)
}

/// Rows in which one input differs from another row.
fn blocks(group: &mut BenchmarkGroup<'_, WallTime>, blocks: usize) -> Result<(), SensitivityError> {
    let saltelli = SaltelliDesign::scrambled(inputs(), blocks, Order::First, 1)?;
    let radial = MorrisDesign::radial(inputs(), blocks, 1)?;
    let trajectories = MorrisDesign::trajectories(inputs(), blocks, 4, 1)?;
    group.throughput(Throughput::Elements(saltelli.points() as u64));
    group.bench_function(BenchmarkId::new("rows/saltelli", blocks), |b| b.iter(|| rows(&saltelli)));
    group.throughput(Throughput::Elements(radial.points() as u64));
    group.bench_function(BenchmarkId::new("rows/radial", blocks), |b| b.iter(|| rows(&radial)));
    group.bench_function(BenchmarkId::new("rows/trajectories", blocks), |b| b.iter(|| rows(&trajectories)));
    Ok(())
}

/// The sum of the inputs, for each row.
fn sums(design: &SobolDesign) -> Result<Vec<Option<f64>>, SensitivityError> {
    Ok(rows(design)?.chunks_exact(INPUTS).map(|row| Some(row.iter().sum())).collect())
}

/// Sobol' indices of the sum of the inputs: 1/62 each.
fn indices(group: &mut BenchmarkGroup<'_, WallTime>, blocks: usize) -> Result<(), SensitivityError> {
    group.throughput(Throughput::Elements(blocks as u64));
    let design = SaltelliDesign::scrambled(inputs(), blocks, Order::First, 1)?;
    let bootstrap = Bootstrap { resamples: 1000, seed: 1 };
    let sum = |x: &[f64]| Some(x.iter().sum());
    let outputs = observe(&design, sum)?;
    let found = sobol_indices(&design, &outputs, bootstrap, 0.95)?;
    // An additive model: the indices add up to 1, but for the errors of the estimates.
    let sum_of_totals = found.inputs.iter().map(|index| index.total.value).sum::<f64>();
    assert!((sum_of_totals - 1.0).abs() < 0.05, "{sum_of_totals}");
    let holding = |index: &&SobolIndex| (index.total.low..=index.total.high).contains(&(1.0 / INPUTS as f64));
    assert!(found.inputs.iter().filter(holding).count() >= 54);
    group.bench_function(BenchmarkId::new("rows_saltelli", blocks), |b| {
        b.iter(|| observe(black_box(&design), sum));
    });
    group.bench_function(BenchmarkId::new("sobol_indices", blocks), |b| {
        b.iter(|| sobol_indices(black_box(&design), &outputs, bootstrap, 0.95));
    });
    Ok(())
}

/// Chaos expansion of a model of 62 linear terms, 61 products and, as 1 % of its variance, what no candidate
/// explains.
fn chaos(group: &mut BenchmarkGroup<'_, WallTime>, points: usize) -> Result<(), SensitivityError> {
    group.throughput(Throughput::Elements(points as u64));
    // The errors of 500 points go from 0.075 to 0.10 with the seed, under independent coins just as well.
    let design = SobolDesign::scrambled(inputs(), points, 8)?;
    let model = |x: &[f64]| {
        let unit: Vec<f64> = x.iter().map(|x| x / 0.03).collect();
        let linear: f64 = unit.iter().enumerate().map(|(i, x)| x / (1.0 + i as f64 / 4.0)).sum();
        let products: f64 = unit.windows(2).map(|pair| 0.1 * pair[0] * pair[1]).sum();
        Some(linear + products + 0.15 * (1e4 * linear).sin())
    };
    let outputs = observe(&design, model)?;
    let truncation = Truncation { max_degree: 3, norm: 0.75, interactions: 2 };
    let found = expansion(&design, &outputs, truncation)?;
    assert!(found.terms.len() >= 25 && found.leave_one_out < 0.08, "{}", found.leave_one_out);
    group.bench_function(BenchmarkId::new("expansion", points), |b| {
        b.iter(|| expansion(black_box(&design), &outputs, truncation));
    });
    Ok(())
}

fn main() -> Result<(), SensitivityError> {
    let settings = Criterion::default()
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(2))
        .sample_size(10);
    let mut criterion = settings.configure_from_args();
    let mut group = criterion.benchmark_group("sensitivity");
    for points in [512, 2048, 8192] {
        let plain = SobolDesign::new(inputs(), 0, points)?;
        let scrambled = plain.replicate(1);
        let outputs = sums(&plain)?;
        let sample = Sample::new(&outputs)?;
        let bootstrap = Bootstrap { resamples: 200, seed: 1 };

        let effects = student_effects(&plain, &outputs)?;
        // Above the middle: levels 1 to 24 of full weight and level 25 of half of it, of mean 312.5 / 24.5.
        let mean = effects.effects.iter().map(|effect| effect.effect).sum::<f64>() / INPUTS as f64;
        assert!((mean / (2.0 * 0.0012 * 312.5 / 24.5) - 1.0).abs() < 0.02);
        // A sum of 62 variables: certainly no uniform law, and the deviation of the normal one is known.
        let fits = fit_all(&sample, bootstrap)?;
        assert_eq!(fits.last().map(|fit| fit.family), Some(Family::Uniform));
        let std = 0.03 * (INPUTS as f64 / 3.0).sqrt();
        let normal = fits.iter().find(|fit| fit.family == Family::Normal);
        assert!(normal.is_some_and(|fit| (fit.law.std() / std - 1.0).abs() < 0.1), "{normal:?}");
        for design in [&plain, &scrambled] {
            // Point 0 of the plain sequence, all inputs at -0.03, has no counterpart: -1.86 / N.
            assert!((Sample::new(&sums(design)?)?.summary().mean).abs() < 3.0 / points as f64);
        }

        group.throughput(Throughput::Elements(points as u64));
        group.bench_function(BenchmarkId::new("rows", points), |b| b.iter(|| rows(black_box(&plain))));
        group.bench_function(BenchmarkId::new("rows_scrambled", points), |b| {
            b.iter(|| rows(black_box(&scrambled)));
        });
        group.bench_function(BenchmarkId::new("points", points), |b| {
            b.iter(|| unit_points(black_box(&plain)));
        });
        group.bench_function(BenchmarkId::new("points_scrambled", points), |b| {
            b.iter(|| unit_points(black_box(&scrambled)));
        });
        group.bench_function(BenchmarkId::new("effects", points), |b| {
            b.iter(|| student_effects(black_box(&plain), &outputs));
        });
        group.bench_function(BenchmarkId::new("fit_all", points), |b| {
            b.iter(|| fit_all(black_box(&sample), bootstrap));
        });
    }
    blocks(&mut group, 64)?;
    for points in [1024, 4096] {
        indices(&mut group, points)?;
    }
    for points in [500, 2000] {
        chaos(&mut group, points)?;
    }
    group.finish();
    criterion.final_summary();
    Ok(())
}
