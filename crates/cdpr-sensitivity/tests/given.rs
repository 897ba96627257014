//! Estimators of tables on functions and laws whose values are known.

use crate::common::unit;
use crate::global::functions;
use cdpr_sensitivity::{
    Analyser, Correlated, GivenData, Input, JointSample, LatinHypercube, Law, Limit, RandomDesign, Rows,
    SampleDesign, SensitivityError, SobolDesign, delta, dependence, dependence_of_event, given_expansion,
    halves, observe, pawn, rank_indices,
};

fn table(
    inputs: Vec<Input>,
    rows: usize,
    seed: u64,
    model: impl Fn(&[f64]) -> Option<f64> + Sync,
) -> GivenData {
    let design = RandomDesign::new(inputs, rows, seed).unwrap();
    GivenData::of_design(&design, &observe(&design, model).unwrap()).unwrap()
}

fn normal(count: usize) -> Vec<Input> {
    (0..count)
        .map(|i| Input::continuous(format!("x{}", i + 1), Law::Normal { mean: 0.0, std: 1.0 }))
        .collect()
}

#[test]
fn indices_by_ranks_are_within_four_of_their_deviations_of_the_known_ones() {
    for function in functions::all() {
        let data = table(function.inputs.clone(), 4000, 7, |x| Some((function.model)(x)));
        for (estimate, exact) in rank_indices(&data, 0.95, 1).unwrap().iter().zip(&function.first) {
            // Half of an interval of 95 % is two deviations.
            let off = (estimate.value - exact).abs() / (0.25 * estimate.width());
            assert!(off < 4.0, "{}: {estimate:?} {exact}", function.name);
            assert!(estimate.width() < 0.15, "{}: {estimate:?}", function.name);
        }
    }
}

#[test]
fn intervals_by_ranks_hold_the_index_as_often_as_their_level() {
    let ishigami = functions::ishigami();
    let (mut held, mut all) = (0, 0);
    for seed in 0..200 {
        let data = table(ishigami.inputs.clone(), 200, seed, |x| Some((ishigami.model)(x)));
        for (estimate, exact) in rank_indices(&data, 0.95, seed).unwrap().iter().zip(&ishigami.first) {
            held += usize::from(estimate.low <= *exact && *exact <= estimate.high);
            all += 1;
        }
    }
    // 95 % of 600 with a standard deviation of 0.9 %.
    assert!(held as f64 / f64::from(all) > 0.92, "{held} of {all}");
}

/// A model of normal inputs, and the first-order index of each.
type OfNormals = (fn(&[f64]) -> f64, [f64; 2]);

/// Share of the intervals that hold the indices, of those that leave anything out, in percent, and the share
/// of these.
fn held((model, exact): OfNormals, rows: usize, tables: u64) -> [f64; 2] {
    let (mut held, mut said) = (0, 0);
    for seed in 0..tables {
        let data = table(normal(2), rows, 1000 + seed, |x| Some(model(x)));
        for (first, exact) in rank_indices(&data, 0.95, seed).unwrap().into_iter().zip(exact) {
            if first.low > 0.0 || first.high < 1.0 {
                said += 1;
                held += usize::from(first.low <= exact && exact <= first.high);
            }
        }
    }
    [100.0 * held as f64 / f64::from(said), 50.0 * f64::from(said) / tables as f64]
}

#[test]
fn an_index_that_rows_leave_open_is_left_out_with_a_note() {
    let data = table(normal(2), 60, 5, |x| Some((2.0 * x[0] + x[1]).exp()));
    let found = Analyser::new(1).analyse(&data).unwrap();
    assert!(found.inputs.iter().all(|input| input.first.is_none()), "{found:?}");
    let note = "first-order indices: 60 rows, of which 2 dominate the variance, leave these open from 0 \
                to 1: \
                x1, x2";
    assert!(found.notes.iter().any(|found| found == note), "{:?}", found.notes);
}

#[test]
fn intervals_of_outputs_with_long_tails_hold_the_index_or_are_none() {
    // Of the sum a z1 + b z2 the exponential has (exp(a²) - 1) / (exp(a² + b²) - 1).
    let of = |part: f64, whole: f64| part.exp_m1() / whole.exp_m1();
    let tailed: OfNormals = (|x| (x[0] + 0.5 * x[1]).exp(), [of(1.0, 1.25), of(0.25, 1.25)]);
    let even: OfNormals = (|x| (0.7 * (x[0] + x[1])).exp(), [of(0.49, 0.98); 2]);
    let product: OfNormals = (|x| (1.0 + x[0]) * (1.0 + x[1]), [1.0 / 3.0; 2]);
    for (name, model, rows, least) in [
        ("lognormal", tailed, 100, 0.0),
        ("lognormal", tailed, 200, 0.0),
        ("lognormal of equals", even, 200, 50.0),
        ("product", product, 200, 95.0),
    ] {
        let [held, said] = held(model, rows, 400);
        // 95 % of 800 with a standard deviation of 0.8 %; a hundred where few say anything.
        assert!(held > 92.0 && said >= least, "{name}, {rows} rows: {held} % of {said} %");
    }
}

#[test]
fn intervals_by_ranks_hold_the_index_of_every_input_of_256_rows() {
    let ishigami = functions::ishigami();
    let studies = 1000;
    let mut held = [0; 3];
    for seed in 0..studies {
        let data = table(ishigami.inputs.clone(), 256, seed, |x| Some((ishigami.model)(x)));
        let found = rank_indices(&data, 0.95, seed).unwrap();
        for ((held, estimate), exact) in held.iter_mut().zip(&found).zip(&ishigami.first) {
            *held += usize::from(estimate.low <= *exact && *exact <= estimate.high);
        }
    }
    // 95 % of 1000 with a standard deviation of 0.7 %.
    assert!(held.iter().all(|held| *held >= 930), "{held:?}");
}

#[test]
fn outputs_that_vary_most_at_the_ends_of_an_input_do_not_bias_its_index_by_ranks() {
    // y = x1 x2 has the variance x1² / 3 given x1, and S = 0. Ends that count by half have a bias of 0.04.
    let product = |x: &[f64]| Some((2.0 * x[0] - 1.0) * (2.0 * x[1] - 1.0));
    let first = |seed| rank_indices(&table(unit(2), 50, seed, product), 0.95, seed).unwrap()[0].value;
    let mean = (0..4000).map(first).sum::<f64>() / 4000.0;
    // The deviation of an index of 50 rows is 0.18, that of the mean 0.003.
    assert!(mean.abs() < 0.01, "{mean}");
}

#[test]
fn an_interval_by_ranks_is_as_wide_as_without_an_effect_and_reaches_one_for_a_step() {
    let (rows, level) = (64, 0.95);
    // Student's factor of 8 degrees of freedom.
    let factor = 2.306;
    for (input, cuts) in [(0, true), (1, false)] {
        let model = |x: &[f64]| Some(if cuts { f64::from(x[0] > 0.3) } else { x[1] * x[0] });
        let found = rank_indices(&table(unit(2), rows, 3, model), level, 1).unwrap()[input];
        let least = factor * (1.0 - found.value) / (rows as f64).sqrt();
        assert!(found.high - found.value >= 0.999 * least && found.value - found.low >= 0.999 * least);
        assert!(!cuts || (found.value < 1.0 && found.high >= 1.0), "{found:?}");
    }
}

#[test]
fn a_dependence_without_a_trend_is_found_and_independence_is_not() {
    // x1 acts by its square, x2 on the scatter only, x3 not at all.
    let data = table(normal(4), 400, 3, |x| Some(x[0] * x[0] + (1.0 + x[1].abs()) * 0.3 * x[3]));
    let found = dependence(&data, Rows { most: 1000, seed: 1 }).unwrap();
    assert!(found[0].p_value < 1e-10 && found[3].p_value < 0.01 && found[2].p_value > 0.01, "{found:?}");
    assert!(found[0].r_squared > 5.0 * found[2].r_squared, "{found:?}");
    // A trend is not what it is: the halves see nothing.
    assert!(halves(&data).unwrap()[0].unwrap().student.unwrap() < 3.0);
}

#[test]
fn t_of_halves_is_that_of_students_test_of_two_means() {
    let data = |outputs: &[f64]| {
        let column = (0..outputs.len()).map(|row| row as f64).collect();
        let outputs = outputs.iter().copied().map(Some).collect();
        GivenData::new(vec!["x".to_owned()], vec![column], outputs).unwrap()
    };
    let half = |outputs: &[f64]| halves(&data(outputs)).unwrap()[0].unwrap();
    let found = half(&[1.0, 2.0, 4.0, 3.0, 5.0, 10.0]);
    assert!((found.effect - 11.0 / 3.0).abs() < 1e-14, "{found:?}");
    assert!((found.student.unwrap() - 11.0 / 46_f64.sqrt()).abs() < 1e-14, "{found:?}");
    // Without a variance within the halves there is no t.
    assert_eq!(half(&[0.1, 0.1, 0.1, 0.3, 0.3, 0.3]).student, None);
}

#[test]
fn a_dependence_is_the_same_for_all_units_and_without_a_variance_none() {
    let data = table(unit(2), 100, 5, |x| Some(x[0]));
    let rows = Rows { most: 1000, seed: 1 };
    let one = dependence(&data, rows).unwrap();
    let scaled = |k: usize| data.columns()[k].iter().map(|x| 1e3 * x - 7.0).collect::<Vec<f64>>();
    let columns = vec![scaled(0), vec![2.0; 100]];
    let outputs = data.outputs().iter().map(|y| y.map(|y| -1e-6 * y)).collect();
    let other = GivenData::new(vec!["a".to_owned(), "b".to_owned()], columns, outputs).unwrap();
    let other = dependence(&other, rows).unwrap();
    assert!((one[0].r_squared - other[0].r_squared).abs() < 1e-9, "{one:?} {other:?}");
    assert_eq!((other[1].r_squared, other[1].p_value), (0.0, 1.0));
    // The output is the input.
    assert!((one[0].r_squared - 1.0).abs() < 1e-9, "{one:?}");
}

#[test]
fn tests_of_independence_hold_their_level() {
    let studies = 400;
    let mut beyond = [0; 2];
    for seed in 0..studies {
        let data = table(normal(2), 50, seed, |x| Some(x[1].exp()));
        let rows = Rows { most: 1000, seed };
        beyond[0] += usize::from(dependence(&data, rows).unwrap()[0].p_value < 0.05);
        let happens: Vec<bool> = data.outputs().iter().map(|y| y.is_some_and(|y| y > 2.0)).collect();
        let event = dependence_of_event(data.columns(), &happens, rows).unwrap();
        beyond[1] += usize::from(event[0].p_value < 0.05);
    }
    // 5 % of 400 is 20 with a standard deviation of 4.4.
    assert!(beyond.iter().all(|beyond| (7..=37).contains(beyond)), "{beyond:?}");
}

#[test]
fn the_input_that_makes_a_limit_fail_is_found_with_its_side() {
    // Only large x1 fail; x2 moves the values that fail.
    let data = table(unit(3), 1000, 9, |x| Some(if x[0] > 0.9 { 10.0 + x[1] } else { 0.1 * x[2] }));
    let analyser = Analyser { limit: Some(Limit::Below(5.0)), ..Analyser::new(1) };
    let found = analyser.analyse(&data).unwrap();
    let limit = found.limit.unwrap();
    assert!(limit.share.low < 0.1 && 0.1 < limit.share.high, "{limit:?}");
    let at = |i: usize| found.inputs[i].limit.unwrap();
    assert!(at(0).target.p_value < 1e-10 && at(0).place.unwrap() > 0.9, "{:?}", at(0));
    assert!(at(1).target.p_value > 0.001 && at(1).conditional.unwrap().p_value < 1e-10, "{:?}", at(1));
    assert!(at(2).target.p_value > 0.001 && at(2).conditional.unwrap().p_value > 0.001, "{:?}", at(2));
}

#[test]
fn delta_and_pawn_of_a_normal_sum_are_those_by_quadrature() {
    // y = 2 x1 + x2: y given x1 is normal about 2 x1 with the deviation 1, y has the deviation √5.
    let law = |mean: f64, std: f64| Law::Normal { mean, std };
    let whole = law(0.0, 5.0_f64.sqrt());
    let steps = |n: usize, half: f64| (0..n).map(move |k| half * (2.0 * (k as f64 + 0.5) / n as f64 - 1.0));
    let distances = |slope: f64, rest: f64| {
        let given = |x: f64| {
            let part = law(slope * x, rest);
            let area: f64 =
                steps(2000, 15.0).map(|y| (part.ln_pdf(y).exp() - whole.ln_pdf(y).exp()).abs() * 0.015).sum();
            let reach = steps(2000, 15.0).map(|y| (part.cdf(y) - whole.cdf(y)).abs()).fold(0.0, f64::max);
            (0.5 * area, reach)
        };
        let probabilities = steps(200, 0.5).map(|u| u + 0.5);
        let all: Vec<(f64, f64)> =
            probabilities.map(|u| given(Law::Normal { mean: 0.0, std: 1.0 }.quantile(u))).collect();
        let mut reach: Vec<f64> = all.iter().map(|found| found.1).collect();
        reach.sort_by(f64::total_cmp);
        (all.iter().map(|found| found.0).sum::<f64>() / 200.0, reach[100])
    };
    let data = table(normal(3), 5000, 2, |x| Some(2.0 * x[0] + x[1]));
    let found = delta(&data, 0.95, 1).unwrap();
    let by_pawn = pawn(&data, 1).unwrap();
    for (input, (slope, rest)) in [(2.0, 1.0), (1.0, 2.0)].into_iter().enumerate() {
        let (exact, reach) = distances(slope, rest);
        let value = found[input].delta;
        assert!((value - exact).abs() < 0.03, "input {input}: {value} {exact}");
        let at_least = found[input].at_least;
        assert!(at_least < exact && exact - at_least < 0.06, "input {input}: {at_least} {exact}");
        assert!((by_pawn[input].median - reach).abs() < 0.04, "{:?} {reach}", by_pawn[input]);
        assert!(value > 3.0 * found[input].noise && by_pawn[input].median > 2.0 * by_pawn[input].noise);
    }
    assert!(found[2].delta < 1.5 * found[2].noise && by_pawn[2].median < 1.5 * by_pawn[2].noise, "{found:?}");
}

#[test]
fn lower_bounds_of_delta_are_above_it_as_seldom_as_their_level_allows() {
    // δ of a step y = 1 for x1 > 0.7 with the probability p = 0.3 is the mean of |1 - p| and |p|: 2 p (1 -
    // p).
    let (tables, exact) = (100, [2.0 * 0.3 * 0.7, 0.0]);
    let mut above = [0; 2];
    for seed in 0..tables {
        let data = table(unit(2), 100, seed, |x| Some(f64::from(x[0] > 0.7)));
        let found = delta(&data, 0.8, seed).unwrap();
        for ((found, exact), above) in found.iter().zip(exact).zip(&mut above) {
            *above += usize::from(found.at_least > exact + 1e-12);
        }
    }
    // At most 10 % of 100; 19 is three standard deviations more. The bound is not trivial.
    assert!(above.iter().all(|above| *above < 20), "{above:?}");
    let found = delta(&table(unit(2), 100, 1, |x| Some(f64::from(x[0] > 0.7))), 0.8, 1).unwrap();
    assert!(found[0].at_least > 0.5 * exact[0], "{found:?}");
}

#[test]
fn delta_knows_ranks_alone_and_inputs_of_few_values() {
    let levels = |x: f64| (3.0 * x).floor();
    let data = table(unit(2), 900, 3, |x| Some(x[0] + 0.1 * x[1]));
    let [columns, exponents] = [|x: f64| x, f64::exp].map(|f| -> Vec<Vec<f64>> {
        data.columns().iter().map(|column| column.iter().map(|x| f(*x)).collect()).collect()
    });
    let names = || data.names().to_vec();
    let stretched = data.outputs().iter().map(|y| y.map(|y| y.powi(3))).collect();
    let one = delta(&GivenData::new(names(), columns.clone(), data.outputs().to_vec()).unwrap(), 0.95, 1);
    let other = delta(&GivenData::new(names(), exponents, stretched).unwrap(), 0.95, 1);
    assert_eq!(one.unwrap(), other.unwrap());

    // y is the level of x: the densities do not overlap, and δ is 1 - 1/3.
    let of_levels = vec![columns[0].iter().map(|x| levels(*x)).collect(), vec![1.0; 900]];
    let outputs = columns[0].iter().map(|x| Some(levels(*x) + 5.0)).collect();
    let found = delta(&GivenData::new(names(), of_levels, outputs).unwrap(), 0.95, 1).unwrap();
    assert!((found[0].delta - 2.0 / 3.0).abs() < 0.02 && found[0].at_least > 0.6, "{found:?}");
    assert_eq!((found[1].delta, found[1].at_least, found[1].noise), (0.0, 0.0, 0.0));
}

#[test]
fn the_expansion_of_a_table_has_the_known_indices_without_knowing_the_laws() {
    // Lognormal inputs: y is a polynomial of degree 2 of values with long tails.
    let law = Law::LogNormal { log_mean: 0.0, log_std: 0.5 };
    let inputs = (0..3).map(|i| Input::continuous(format!("x{i}"), law)).collect();
    let data = table(inputs, 500, 4, |x| Some(x[0] + x[0] * x[1]));
    let truncation = cdpr_sensitivity::Truncation { max_degree: 3, norm: 1.0, interactions: 2 };
    let found = given_expansion(&data, truncation).unwrap();
    assert!(!found.of_ranks && found.leave_one_out < 1e-10, "{}", found.leave_one_out);
    // Mean m and variance v of each input: x1 alone (1 + m)² v, x2 alone m² v, both v².
    let (m, v) = (law.mean(), law.std().powi(2));
    let (one, two, both) = ((1.0 + m).powi(2) * v, m * m * v, v * v);
    let whole = one + two + both;
    // The shares are those of the laws of the sample, whose variance has an error of some percent.
    assert!((found.shares(0).unwrap().closed - one / whole).abs() < 0.05, "{:?}", found.shares(0));
    assert!((found.shares(1).unwrap().total - (two + both) / whole).abs() < 0.05, "{:?}", found.shares(1));
    assert!(found.shares(2).unwrap().total < 1e-20, "{:?}", found.shares(2));

    // A function of the logarithm has no polynomial in values.
    let inputs = vec![Input::continuous("x", Law::LogNormal { log_mean: 0.0, log_std: 2.0 })];
    let data = table(inputs, 300, 4, |x| Some((2.0 * x[0].ln()).sin()));
    assert!(given_expansion(&data, truncation).unwrap().of_ranks);
}

#[test]
fn an_analysis_is_the_same_on_any_number_of_threads_and_names_what_it_lacks() {
    let data = table(unit(2), 25, 1, |x| Some(x[0]).filter(|_| x[1] < 0.9));
    let analyse = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| Analyser::new(3).analyse(&data)).unwrap()
    };
    let found = analyse(1);
    assert_eq!(found, analyse(4));
    assert!(found.notes.iter().any(|note| note.starts_with("first-order indices")), "{:?}", found.notes);
    assert!(found.inputs[0].first.is_none() && found.inputs[0].standardized.is_some_and(|src| src > 0.99));
    let constant = GivenData::new(vec!["x".to_owned()], vec![vec![1.0; 9]], vec![Some(2.0); 9]).unwrap();
    let error = Analyser::new(3).analyse(&constant).unwrap_err();
    assert!(matches!(error, SensitivityError::ConstantSample { count: 9, .. }), "{error}");
    let wrong = GivenData::new(vec!["x".to_owned()], vec![vec![f64::NAN; 3]], vec![None; 3]).unwrap_err();
    assert!(wrong.to_string().contains("row[0] = NaN"), "{wrong}");
}

#[test]
fn correlated_inputs_are_related_and_constant_ones_have_no_measure() {
    let design = RandomDesign::new(unit(2), 300, 8).unwrap();
    let mut row = [0.0; 2];
    let (mut columns, mut outputs) = (vec![vec![], vec![], vec![]], vec![]);
    for index in 0..design.points() {
        design.row(index, &mut row).unwrap();
        columns[0].push(row[0]);
        columns[1].push(row[0] + 0.1 * row[1]);
        columns[2].push(4.0);
        outputs.push(Some(row[0] + 0.3 * row[1]));
    }
    let names = ["a", "b", "c"].map(str::to_owned).to_vec();
    let found = Analyser::new(1).analyse(&GivenData::new(names, columns, outputs).unwrap()).unwrap();
    let pair = found.most_correlated.unwrap();
    assert_eq!(pair.inputs, ["a", "b"]);
    assert!(pair.rank_correlation > 0.95 && found.verdict.certain.is_empty(), "{:?}", found.verdict);
    assert!(found.verdict.related.iter().all(|of| of.reasons[0].starts_with("depends on `")));
    let constant = &found.inputs[2];
    assert!(constant.standardized.is_none() && constant.dependence.is_none());
    assert!(constant.half.is_none() && constant.shares.is_none());
}

#[test]
fn first_order_indices_by_ranks_refuse_rows_of_a_sequence_and_take_random_ones_and_latin_hypercubes() {
    let sum = |x: &[f64]| Some(x.iter().enumerate().map(|(i, x)| x / (1.0 + i as f64)).sum());
    fn found<D: JointSample>(
        design: &D,
        model: impl Fn(&[f64]) -> Option<f64> + Sync,
    ) -> Result<Vec<cdpr_sensitivity::Estimate>, SensitivityError> {
        rank_indices(&GivenData::of_design(design, &observe(design, model).unwrap()).unwrap(), 0.95, 1)
    }
    for (inputs, rows) in [(5, 256), (20, 256), (62, 1024), (62, 5000)] {
        for design in [
            SobolDesign::new(unit(inputs), 1, rows).unwrap(),
            SobolDesign::scrambled(unit(inputs), rows, 1).unwrap(),
        ] {
            let error = found(&design, sum).unwrap_err();
            assert!(matches!(error, SensitivityError::DependentRows { .. }), "{error}");
        }
        for seed in 0..5 {
            found(&RandomDesign::new(unit(inputs), rows, seed).unwrap(), sum).unwrap();
            found(&LatinHypercube::new(unit(inputs), rows, seed).unwrap(), sum).unwrap();
        }
    }
    // Correlated inputs are not mistaken for a sequence.
    let matrix = [[1.0, 0.8, 0.0], [0.8, 1.0, 0.5], [0.0, 0.5, 1.0]].map(Vec::from);
    let correlated = Correlated::new(RandomDesign::new(unit(3), 2000, 1).unwrap(), &matrix).unwrap();
    found(&correlated, sum).unwrap();
}
