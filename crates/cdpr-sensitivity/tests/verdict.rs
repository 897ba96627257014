//! Verdicts of tables whose truth is known, and tables of few rows, ties and huge values.

use crate::known_tables::{KINDS, Source};
use cdpr_sensitivity::{
    Analyser, Concern, GivenData, Input, Law, LeadingInputs, Limit, Rows, SensitivityError, SobolDesign,
    Verdict, delta, dependence, given_expansion, halves, observe, pawn, rank_indices,
};
use rayon::prelude::*;

pub(crate) const TABLES: u64 = 30;

#[test]
fn an_inert_input_is_certain_in_at_most_five_of_a_hundred_tables_and_no_cause_is_missing() {
    let (mut all_wrong, mut all) = (0, 0);
    for (kind, make) in KINDS {
        let of_seed = |seed: u64| {
            let known = make(&mut Source::new(1_000_000 + seed));
            let verdict = Analyser::new(seed).verdict(&known.data).unwrap();
            let is = |list: &[cdpr_sensitivity::Finding], input: usize| {
                list.iter().any(|of| of.input == known.data.names()[input])
            };
            let wrong = known.inert.iter().any(|&input| is(&verdict.certain, input));
            let missing = known
                .causes
                .iter()
                .filter(|&&input| !is(&verdict.certain, input) && !is(&verdict.related, input))
                .count();
            let uncertain = known.causes.iter().filter(|&&input| !is(&verdict.certain, input)).count();
            let small = known.data.outputs().len() < 200;
            [
                usize::from(wrong),
                missing,
                if known.clean { uncertain } else { 0 },
                known.causes.len(),
                usize::from(small),
            ]
        };
        let found: Vec<[usize; 5]> = (0..TABLES).into_par_iter().map(of_seed).collect();
        let sum = |of: usize| found.iter().map(|counts| counts[of]).sum::<usize>();
        let (wrong, missing, uncertain, causes) = (sum(0), sum(1), sum(2), sum(3));
        // 5 % of 30 is 1.5 with a standard deviation of 1.2.
        assert!(wrong <= 5, "{kind}: {wrong} of {TABLES} tables");
        let allowed = if sum(4) > 0 { causes / 5 } else { 0 };
        assert!(missing <= allowed, "{kind}: {missing} of {causes} causes are missing");
        // Independent inputs seem to depend on each other in 5 % of the tables.
        assert!(uncertain <= causes / 5, "{kind}: {uncertain} of {causes} causes are not certain");
        (all_wrong, all) = (all_wrong + wrong, all + TABLES as usize);
    }
    assert!(20 * all_wrong <= all, "{all_wrong} of {all} tables");
}

fn verdict(name: &str, seed: u64) -> Verdict {
    let (_, make) = KINDS.iter().find(|(kind, _)| *kind == name).unwrap();
    Analyser::new(1).verdict(&make(&mut Source::new(seed)).data).unwrap()
}

pub(crate) fn concerns(verdict: &Verdict, concern: Concern) -> bool {
    verdict.conditions.iter().any(|condition| condition.concern == concern)
}

#[test]
fn a_verdict_says_which_condition_is_not_met() {
    let copy = verdict("copy 0.9, 500 rows", 3);
    assert!(concerns(&copy, Concern::DependentInputs), "{copy:?}");
    assert!(copy.related.iter().any(|of| of.input == "x2" && of.reasons[0].contains("depends on `x1`")));
    assert!(copy.sentences.iter().any(|line| line.starts_with("related, cause or not: ")), "{copy:?}");
    let ordered = verdict("rows in order, 0.9", 3);
    assert!(concerns(&ordered, Concern::RowsInOrder) && ordered.certain.is_empty(), "{ordered:?}");
    let repeated = verdict("every row four times, nothing", 3);
    assert!(concerns(&repeated, Concern::RepeatedRows) && repeated.rows == 50, "{repeated:?}");
    assert!(repeated.has_questions());
    let measured = verdict("four measurements of each setting", 3);
    assert!(concerns(&measured, Concern::RepeatedRows) && measured.rows == 40, "{measured:?}");
    assert!(!verdict("additive, 3 of 10", 3).has_questions());
}

pub(crate) fn table(columns: Vec<Vec<f64>>, outputs: Vec<f64>) -> GivenData {
    let names = (0..columns.len()).map(|input| format!("x{}", input + 1)).collect();
    GivenData::new(names, columns, outputs.into_iter().map(Some).collect()).unwrap()
}

#[test]
fn row_numbers_constant_columns_and_diverged_runs_are_questions() {
    let rows = 123;
    let wave = |row: usize, k: f64| (k * row as f64 * row as f64).sin();
    let column = |k: f64| (0..rows).map(|row| wave(row, k)).collect::<Vec<f64>>();
    let numbers: Vec<f64> = (1..=rows).map(|row| row as f64).collect();
    let mut outputs: Vec<f64> = (0..rows).map(|row| wave(row, 0.7) + 0.1 * wave(row, 1.3)).collect();
    outputs[60] = 1e6;
    let data = table(vec![column(0.7), vec![4.0; rows], numbers], outputs);
    let found = Analyser::new(1).verdict(&data).unwrap();
    for concern in [Concern::Constant, Concern::RowNumber, Concern::Diverged] {
        assert!(concerns(&found, concern), "{concern:?}: {found:?}");
    }
    assert_eq!(found.certain.iter().map(|of| of.input.as_str()).collect::<Vec<_>>(), ["x1"]);
    assert_eq!(found.doubtful[0].input, "x2");
    // A constant input is named by its condition alone, and counted among all.
    assert!(found.sentences[0].starts_with("1 of 3 inputs"), "{:?}", found.sentences);
    assert!(found.sentences.iter().all(|sentence| !sentence.contains("constant")), "{:?}", found.sentences);
}

#[test]
fn a_value_far_from_all_others_in_many_rows_is_questioned_and_a_level_is_not() {
    let mut source = Source::new(4);
    let [x, y] = [source.uniforms(100), source.uniforms(100)];
    let with = |value: f64, every: usize, column: &[f64]| -> Vec<f64> {
        column.iter().enumerate().map(|(row, x)| if row % every == 0 { value } else { *x }).collect()
    };
    let questioned = |x: Vec<f64>, y: Vec<f64>| {
        let found = Analyser::new(1).verdict(&table(vec![x], y)).unwrap();
        let of = found.conditions.iter().find(|of| of.concern == Concern::Sentinel).cloned();
        of.map(|of| (of.is_question(), of.inputs.len(), of.text))
    };
    for (value, every) in [(-999.0, 7), (9999.0, 4), (1e30, 15), (-999.0, 50)] {
        let (is_question, inputs, text) = questioned(with(value, every, &x), y.clone()).unwrap();
        assert!(is_question && inputs == 1, "{text}");
        assert!(questioned(x.clone(), with(value, every, &y)).is_some_and(|of| of.1 == 0), "{value}");
    }
    let (.., text) = questioned(with(-999.0, 7, &x), y.clone()).unwrap();
    assert!(text.starts_with("15 of 100 values of input `x1` are -999, all others from "), "{text}");
    // Levels, a value next to the others, and one of half of the rows.
    let levels: Vec<f64> =
        (0..100).map(|row| if row % 5 == 0 { 100.0 } else { f64::from(row % 3) }).collect();
    for x in [levels, with(2.0, 7, &x), with(-999.0, 2, &x), x.clone()] {
        assert_eq!(questioned(x, y.clone()), None);
    }
}

#[test]
fn inputs_that_depend_on_each_other_are_named_where_none_is_found() {
    let mut source = Source::new(11);
    let columns = [0, 1, 2].map(|_| source.uniforms(60)).to_vec();
    let b: Vec<f64> = columns[0].iter().zip(&columns[1]).map(|(a, own)| a + 0.3 * own).collect();
    // The noise is ten times the difference.
    let noise = source.uniforms(60);
    let y = (0..60).map(|row| columns[0][row] - b[row] + 3.0 * noise[row]).collect();
    let found = Analyser::new(1).verdict(&table(vec![columns[0].clone(), b, columns[2].clone()], y)).unwrap();
    assert!(found.certain.is_empty() && found.related.is_empty(), "{found:?}");
    let condition = found.conditions.iter().find(|of| of.concern == Concern::DependentInputs).unwrap();
    assert_eq!(condition.inputs, ["x1", "x2"]);
    assert!(condition.text.contains("(`x1` and `x2`)"), "{}", condition.text);
}

#[test]
fn repeated_settings_count_once_in_every_measure_and_each_row_in_the_failures_of_a_limit() {
    let mut source = Source::new(8);
    let settings: Vec<Vec<f64>> = (0..3).map(|_| source.uniforms(60)).collect();
    let columns: Vec<Vec<f64>> =
        settings.iter().map(|column| column.iter().flat_map(|&x| [x; 5]).collect()).collect();
    let noise = source.uniforms(300);
    let y: Vec<f64> = columns[0].iter().zip(&noise).map(|(x, noise)| x + 0.05 * noise).collect();
    let limit = Some(Limit::Below(0.5));
    let found = Analyser { limit, ..Analyser::new(1) }.analyse(&table(columns, y.clone())).unwrap();
    // Neighbours of five equal settings gave each input a share of almost 1.
    for inert in &found.inputs[1..] {
        assert!(inert.first.unwrap().low < 0.0 && inert.pawn.unwrap().median < 0.5, "{inert:?}");
        assert!(
            inert.delta.unwrap().at_least < 0.05 && inert.dependence.unwrap().p_value > 0.01,
            "{inert:?}"
        );
    }
    assert!(found.inputs[0].first.unwrap().low > 0.8, "{:?}", found.inputs[0]);
    assert_eq!((found.verdict.rows, found.limit.unwrap().rows), (60, 300));
    assert_eq!(found.limit.unwrap().count, y.iter().filter(|y| **y >= 0.5).count());
    let repeated = found.verdict.conditions.iter().find(|of| of.concern == Concern::RepeatedRows).unwrap();
    assert!(repeated.text.contains("verdict and measures take the mean output of each"), "{}", repeated.text);
}

#[test]
fn a_sequence_of_more_rows_than_tests_take_is_still_one_and_that_is_no_question() {
    let law = Law::Uniform { min: -1.0, max: 1.0 };
    let inputs = (1..=16).map(|i| Input::continuous(format!("x{i}"), law)).collect();
    let design = SobolDesign::new(inputs, 1, 12_000).unwrap();
    let outputs = observe(&design, |x| Some((x[2] + 0.3 * x[5]).exp())).unwrap();
    let found = Analyser::new(1).verdict(&GivenData::of_design(&design, &outputs).unwrap()).unwrap();
    assert_eq!(found.certain.iter().map(|of| of.input.as_str()).collect::<Vec<_>>(), ["x3", "x6"]);
    assert!(concerns(&found, Concern::Sequence) && !found.has_questions(), "{found:?}");
    // Without the rows that failed, eights are no longer in turn.
    let failed: Vec<Option<f64>> =
        outputs.iter().enumerate().map(|(row, y)| y.filter(|_| row % 9 > 0)).take(400).collect();
    let rows: Vec<Vec<f64>> = GivenData::of_design(&design, &outputs)
        .unwrap()
        .columns()
        .iter()
        .map(|x| x[..400].to_vec())
        .collect();
    let names = (1..=16).map(|i| format!("x{i}")).collect();
    let found = Analyser::new(1).verdict(&GivenData::new(names, rows, failed).unwrap()).unwrap();
    assert!(concerns(&found, Concern::Sequence) && found.certain[0].input == "x3", "{found:?}");
}

#[test]
fn an_input_of_two_levels_has_their_contrast_and_a_constant_one_nothing() {
    // 24 of 60 rows have the switch on; the mean of u is the same in both parts, and no row is there twice.
    let switch: Vec<f64> = (0..60).map(|row| f64::from(row % 5 < 2)).collect();
    let apart = [-0.01, 0.01, -0.02, 0.0, 0.02];
    let u: Vec<f64> = (0..60).map(|row| f64::from(row / 5) / 12.0 + apart[row as usize % 5]).collect();
    let outputs = switch.iter().zip(&u).map(|(on, u)| 5.0 * on + u).collect();
    let data = table(vec![switch, u, vec![2.5; 60]], outputs);
    let found = Analyser::new(1).analyse(&data).unwrap();
    let half = found.inputs[0].half.unwrap();
    assert!((half.effect - 5.0).abs() < 1e-12 && half.student.unwrap() > 50.0, "{half:?}");
    let share = found.inputs[0].first.unwrap();
    // 5² 0.4 0.6 of the variance, and that of u.
    let variance = 6.0 + (1.0 - 1.0 / 144.0) / 12.0;
    assert!((share.value - 6.0 / variance).abs() < 0.005 && share.low > 0.9, "{share:?}");
    let constant = &found.inputs[2];
    assert!(constant.half.is_none() && constant.first.is_none() && constant.dependence.is_none());
    assert!(constant.standardized.is_none() && constant.pawn.is_none() && constant.delta.is_none());
    assert!(constant.shares.is_none() && found.verdict.doubtful[0].reason == "it is constant");
}

#[test]
fn polynomials_of_a_balanced_design_have_its_exact_shares() {
    // A: 0, 10, 20; B: 6, 0, 6. Variances 200 / 3 and 8: shares 89.286 and 10.714 %.
    let of = |level: usize, list: [f64; 3]| list[level % 3];
    for times in [1, 4] {
        let rows = 0..9 * times;
        let a: Vec<f64> = rows.clone().map(|row| of(row / 3, [1.0, 2.0, 3.0])).collect();
        let b: Vec<f64> = rows.clone().map(|row| of(row, [1.0, 2.0, 3.0])).collect();
        let y = rows.map(|row| of(row / 3, [10.0, 20.0, 30.0]) + of(row, [6.0, 0.0, 6.0])).collect();
        let data = table(vec![a, b], y);
        let truncation = cdpr_sensitivity::Truncation { max_degree: 8, norm: 0.75, interactions: 2 };
        let Ok(found) = given_expansion(&data, truncation) else {
            assert_eq!(times, 1, "nine rows are too few");
            continue;
        };
        let shares = [0, 1].map(|input| found.shares(input).unwrap());
        assert!((shares[0].closed - 200.0 / 224.0).abs() < 1e-9, "{shares:?}");
        assert!((shares[1].total - 24.0 / 224.0).abs() < 1e-9, "{shares:?}");
        assert!(!found.of_ranks && found.terms.iter().all(|term| term.powers[0].degree <= 2), "{found:?}");
    }
}

#[test]
fn a_model_that_explains_nothing_has_no_shares_and_words_have_theirs() {
    // y = 2 a + 3 [blue]: a has 4/12, colour 9/4.
    let mut source = Source::new(5);
    let rows = 600;
    let a = source.uniforms(rows);
    let colour: Vec<f64> = source.uniforms(rows).into_iter().map(|u| f64::from(u < 0.5)).collect();
    let y: Vec<f64> = a.iter().zip(&colour).map(|(a, blue)| 2.0 * a + 3.0 * blue).collect();
    let labels = vec!["red".to_owned(), "blue".to_owned()];
    let exact = [(4.0 / 12.0) / (4.0 / 12.0 + 9.0 / 4.0), (9.0 / 4.0) / (4.0 / 12.0 + 9.0 / 4.0)];
    let alone = Analyser::new(1).analyse(&table(vec![a.clone()], y.clone())).unwrap();
    assert!(alone.inputs[0].shares.is_none(), "{:?}", alone.expansion);
    assert!(alone.notes.iter().any(|note| note.contains("say nothing")), "{:?}", alone.notes);
    let both = table(vec![a, colour], y).with_levels(1, labels).unwrap();
    let found = Analyser::new(1).analyse(&both).unwrap();
    for (input, exact) in found.inputs.iter().zip(exact) {
        let (first, shares) = (input.first.unwrap(), input.shares.unwrap());
        assert!((first.value - exact).abs() < 0.06, "{first:?} {exact}");
        assert!((shares.closed - exact).abs() < 0.03, "{shares:?} {exact}");
    }
    assert_eq!(found.verdict.certain.len(), 2, "{:?}", found.verdict);
    let levels = &found.inputs[1].levels;
    assert!(found.inputs[1].half.is_none() && levels.len() == 2);
    assert!((levels[0].mean - 4.0).abs() < 0.2 || (levels[0].mean - 1.0).abs() < 0.2, "{levels:?}");
    assert!(found.r_squared.unwrap() > 0.999);
}

/// Results and errors alike: nothing may panic.
fn all_estimators(data: &GivenData) {
    let truncation = cdpr_sensitivity::Truncation { max_degree: 8, norm: 0.75, interactions: 2 };
    let rows = Rows { most: 2000, seed: 1 };
    let _ = halves(data);
    let _ = rank_indices(data, 0.95, 1);
    let _ = dependence(data, rows);
    let _ = pawn(data, 1);
    let _ = delta(data, 0.95, 1);
    let _ = given_expansion(data, truncation);
    for limit in [None, Some(Limit::Below(0.0)), Some(Limit::AtLeast(2.0))] {
        if let Ok(found) = (Analyser { limit, ..Analyser::new(1) }).analyse(data) {
            let text = serde_json::to_string(&found).unwrap();
            assert!(!text.contains("NaN"), "{text}");
            for input in &found.inputs {
                assert!(input.half.is_none_or(|half| half.effect.is_finite()), "{input:?}");
            }
        }
    }
}

#[test]
fn an_input_that_acts_with_another_one_names_it_and_too_few_rows_have_no_table() {
    // y = 2 a + b c; d does nothing.
    let mut seed = 7_u64;
    let mut next = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (seed >> 33) as f64 / f64::from(1 << 30) - 1.0
    };
    let columns: Vec<Vec<f64>> = (0..4).map(|_| (0..600).map(|_| next()).collect()).collect();
    let outputs = |rows: usize| {
        (0..rows).map(|row| 0.5 * columns[0][row] + columns[1][row] * columns[2][row]).collect::<Vec<f64>>()
    };
    let found = Analyser::new(1).analyse(&table(columns.clone(), outputs(600))).unwrap();
    let partners: Vec<(&str, &str)> = (found.verdict.certain.iter())
        .filter_map(|of| Some((of.input.as_str(), of.with.as_deref()?)))
        .collect();
    let of_both = [("x2", "x3"), ("x3", "x2")];
    assert!(!partners.is_empty() && partners.iter().all(|of| of_both.contains(of)), "{:?}", found.verdict);
    let (input, other) = partners[0];
    let said = &found.verdict.sentences[0];
    assert!(said.contains(&format!("{input} (together with {other})")), "{said}");
    let word = format!("together with {other}");
    assert!(LeadingInputs::of(&found).rows.iter().any(|row| row[2] == word));
    let few = columns.iter().map(|column| column[..2].to_vec()).collect();
    let few = Analyser::new(1).analyse(&table(few, outputs(2))).unwrap();
    assert_eq!(LeadingInputs::of(&few), LeadingInputs { rows: vec![], captions: vec![] });
}

#[test]
fn no_estimator_panics_with_few_rows_ties_and_extremes() {
    let lists: [fn(usize) -> f64; 6] = [
        |row| row as f64,
        |_| 1.0,
        |row| (row % 2) as f64,
        |row| (row % 3) as f64 * 1e140,
        |row| if row == 0 { 1e-140 } else { 0.0 },
        |row| ((row * row) as f64).sin(),
    ];
    for size in 0..=12 {
        let column = |of: usize| (0..size).map(lists[of]).collect::<Vec<f64>>();
        for of_x in 0..lists.len() {
            for of_y in 0..lists.len() {
                let columns = vec![column(of_x), column((of_x + 1) % lists.len())];
                all_estimators(&table(columns.clone(), column(of_y)));
                let codes = (0..size).map(|row| (row % 3) as f64).collect();
                let words = ["a", "b", "c"].map(str::to_owned).to_vec();
                let words = table(vec![codes, columns[1].clone()], column(of_y)).with_levels(0, words);
                all_estimators(&words.unwrap());
            }
        }
    }
}

#[test]
fn values_whose_squares_overflow_and_counts_without_end_are_refused() {
    let names = || vec!["x".to_owned()];
    let outputs = || vec![Some(1.7e308), Some(-1.7e308), Some(1.0)];
    let error = GivenData::new(names(), vec![vec![1.0, 2.0, 3.0]], outputs()).unwrap_err();
    assert!(matches!(error, SensitivityError::Scale { index: 0, .. }), "{error}");
    assert!(error.to_string().contains("outputs[0] = 1.7e308"), "{error}");
    assert!(cdpr_sensitivity::Sample::new(&outputs()).is_err());
    let tiny = GivenData::new(names(), vec![vec![1e-200, 0.0, 3e-200]], vec![Some(1.0); 3]);
    assert!(matches!(tiny.unwrap_err(), SensitivityError::InvalidInput { .. }));
    let data = table(vec![(0..20).map(f64::from).collect()], (0..20).map(f64::from).collect());
    let error = Analyser { dependence_rows: 50_000, ..Analyser::new(1) }.analyse(&data).unwrap_err();
    assert_eq!(error.to_string(), "dependence_rows = 50000: expected 6 to 5000");
    let many = table(vec![(0..20).map(f64::from).collect(); 1001], (0..20).map(f64::from).collect());
    let error = Analyser::new(1).analyse(&many).unwrap_err();
    assert_eq!(error.to_string(), "inputs = 1001: expected 1 to 1000");
}

#[cfg(feature = "faer")]
#[test]
fn a_vector_of_too_many_components_is_refused_before_it_is_computed() {
    let column: Vec<f64> = (0..100).map(|row| f64::from(row).sin()).collect();
    let outputs: Vec<Option<Vec<f64>>> = column.iter().map(|x| Some(vec![*x; 80])).collect();
    let error = cdpr_sensitivity::wasserstein_bures(&[column], &outputs, 0.95, 1).unwrap_err();
    assert_eq!(error.to_string(), "components = 80: expected 1 to 32");
}

#[test]
fn rows_of_a_sequence_have_shares_by_a_model_that_explains_them_and_else_a_reason_in_plain_words() {
    let law = Law::Uniform { min: -1.0, max: 1.0 };
    let inputs: Vec<_> = (1..=8).map(|i| Input::continuous(format!("x{i}"), law)).collect();
    let design = SobolDesign::new(inputs, 1, 512).unwrap();
    let of = |model: fn(&[f64]) -> f64| {
        let outputs = observe(&design, |x| Some(model(x))).unwrap();
        Analyser::new(1).analyse(&GivenData::of_design(&design, &outputs).unwrap()).unwrap()
    };
    // Variances of 1/3 and 0.03: shares of 91.7 % and 8.3 %.
    let smooth = of(|x| x[2] + 0.3 * x[5]);
    assert!(smooth.inputs.iter().all(|input| input.first.is_none()));
    let LeadingInputs { rows, captions } = LeadingInputs::of(&smooth);
    for (row, name, share) in [(&rows[0], "x3", 91.7), (&rows[1], "x6", 8.3)] {
        let found: f64 = row[1].strip_suffix(" (expansion)").unwrap().parse().unwrap();
        // Variances of 512 rows are not quite those of the laws.
        assert!(row[0] == name && (found - share).abs() < 0.15, "{row:?}");
    }
    assert!(captions[1].starts_with("expansion: by a polynomial model, which leaves 0.0 %"), "{captions:?}");
    let rough = of(|x| (40.0 * x[2]).sin() + x[5]);
    let LeadingInputs { rows, captions } = LeadingInputs::of(&rough);
    assert!(rows.iter().all(|row| row[1] == "-"), "{rows:?}");
    let why =
        "no shares: shares by ranks need independent rows, and these are of a sequence (Sobol', Halton)";
    assert!(captions[1].starts_with(why), "{captions:?}");
}
