//! Contents of each figure, and results without a figure.

use crate::robustness_figures::robustness;
use cdpr_assess::ProtocolSummary;
use cdpr_report::{
    NamedSampling, Points, ReportError, Sheet, found_poses, histogram, point_effects, shares, signed_effects,
    success_share, surface,
};
use cdpr_robot::Robot;
use cdpr_sensitivity::{Family, Histogram, Law};
use cdpr_statics::StaticsError;
use cdpr_study::{
    Agreement, BestFit, Evidence, FitSummary, IndexMap, InputMeasures, NominalSummary, Output, PartVerdict,
    SamplingSummary, SensitivitySummary, SignedEffect, Study, SurfaceResult, SurfaceSummary, ValueSummary,
};

fn robot() -> Robot {
    Robot::from_json(include_str!("../../../data/robots/caroca.json")).unwrap()
}

fn named<'a>(name: &'a str, summary: &'a SamplingSummary) -> NamedSampling<'a> {
    NamedSampling { name, summary }
}

fn sampling() -> SamplingSummary {
    let fit = |law, parameters, aic| FitSummary {
        law,
        parameters,
        log_likelihood: 0.0,
        aic,
        bic: aic,
        ks: 0.01,
        p_value: 0.5,
        p_is_bound: false,
        probability: 0.5,
    };
    let magnitude = ValueSummary {
        mean: 1.35,
        std: 0.1375,
        min: 1.1,
        max: 1.6,
        nominal: 1.33,
        q01: 1.11,
        q25: 1.22,
        median: 1.35,
        q75: 1.47,
        q99: 1.59,
    };
    let effect = |effect, half| SignedEffect { effect, low: effect - half, high: effect + half };
    let t_student = (1..=8).flat_map(|i| ["x", "y", "z"].map(|axis| (format!("b{i}.{axis}"), i as f64)));
    SamplingSummary {
        verdict: PartVerdict::default(),
        title: "Everything, E < 104 & \"rest\"".to_owned(),
        output: Output::Deflection,
        pose: [0.0, 0.0, 1.75],
        quaternion: [1.0, 0.0, 0.0, 0.0],
        observations: 101,
        failed: [("infeasible_tension".to_owned(), 1)].into(),
        scalar: Default::default(),
        values: Some(magnitude),
        nominal: NominalSummary {
            displacement_mm: [0.0, 0.0, -1.33],
            small_displacement_magnitude_mm: Some(1.3),
            unloaded_tensions: vec![574.0; 8],
            loaded_tensions: vec![730.0; 8],
            out_of_limits: Vec::new(),
        },
        operating_moduli_gpa: None,
        fits: vec![
            fit(Family::Uniform, Law::Uniform { min: 1.1, max: 1.6 }, 10.0),
            fit(Family::Normal, Law::Normal { mean: 1.35, std: 0.1375 }, 25.0),
        ],
        best_fit: Some(BestFit {
            family: Family::Uniform,
            evidence: Evidence::Decided,
            probability: 0.99,
            p_value: 0.5,
            p_is_bound: false,
        }),
        histogram: Some(Histogram {
            edges: vec![1.1, 1.2, 1.3, 1.4, 1.5, 1.6],
            counts: vec![20, 22, 0, 38, 20],
        }),
        notes: Vec::new(),
        t_student: t_student.chain([("mass".to_owned(), 3.0)]).collect(),
        signed_effects: [
            ("mass".to_owned(), effect(-0.02, 0.004)),
            ("b2.x".to_owned(), effect(0.03, 0.005)),
            ("dt1".to_owned(), effect(0.001, 0.002)),
        ]
        .into(),
        replicates: 8,
        confidence: 0.95,
        sensitivity: None,
    }
}

/// Two inputs and three measures; the second input has an interval from below zero on.
fn measured() -> SamplingSummary {
    let input = |name: &str, share: f64| InputMeasures {
        input: name.to_owned(),
        derivative_share: Some(share),
        sobol_first: Some(share),
        sobol_first_low: Some(share - 0.02),
        sobol_first_high: Some(share + 0.02),
        sobol_total: Some(share),
        sobol_total_low: Some(share),
        sobol_total_high: Some(share),
        ..InputMeasures::default()
    };
    let agreement = Agreement {
        first: 1,
        inputs: vec!["b2.x".to_owned()],
        measures: ["derivative_share", "sobol_total"].map(str::to_owned).into(),
        rank_correlation: vec![vec![Some(1.0); 2]; 2],
    };
    let sensitivity = SensitivitySummary {
        inputs: vec![input("mass", 0.01), input("b2.x", 0.99)],
        groups: Vec::new(),
        subspace: None,
        methods: IndexMap::new(),
        sums: IndexMap::new(),
        agreement,
        vector: cdpr_study::VectorOutput::Displacement,
        notes: Vec::new(),
    };
    SamplingSummary { sensitivity: Some(sensitivity), ..sampling() }
}

fn grid() -> (SurfaceSummary, SurfaceResult) {
    let (x, y) = (vec![84.2e9, 102.2e9, 120.2e9], vec![162.0, 198.0]);
    let failure = || StaticsError::Invalid { field: "x".into(), value: "y".into(), expected: "z".into() };
    let values = vec![Ok(1.6), Ok(1.61), Err(failure()), Ok(1.35), Ok(1.1), Ok(1.12)];
    let result = SurfaceResult { x, y, values };
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies/caroca.json");
    let study = Study::open(file.as_ref()).unwrap();
    let mut summary = SurfaceSummary::new(&study.surface("surface_E_rho").unwrap(), &result);
    summary.title = "E and m".to_owned();
    summary.parameters[1] = "mass".to_owned();
    (summary, result)
}

/// All figures that these results have, on a sheet where they have one.
fn figures(sheet: Sheet) -> [String; 7] {
    let robustness = robustness();
    let (summary, result) = grid();
    let sampling = sampling();
    [
        histogram(&sampling, sheet).unwrap(),
        surface(&summary, &result, sheet).unwrap(),
        point_effects(
            &robot(),
            &[named("symmetric", &sampling), named("other", &sampling)],
            Points::Exit,
            sheet,
        )
        .unwrap(),
        signed_effects(&sampling, 20, sheet).unwrap(),
        shares(&measured(), 12, sheet).unwrap(),
        found_poses(&robustness).unwrap(),
        success_share(&ProtocolSummary::new(&robustness)).unwrap(),
    ]
}

/// Filled rectangles, without the background; in columns of many they are strokes.
pub(crate) fn rectangles(svg: &str) -> usize {
    svg.matches("<rect ").count() + svg.matches("<path stroke=").count() - 1
}

/// Lines; those of one pen are one path, in which each begins with a move.
pub(crate) fn lines(svg: &str) -> usize {
    let paths = svg.split(" d=\"").skip(1).filter_map(|rest| rest.split('"').next());
    paths.map(|path| path.matches('m').count()).sum()
}

/// Texts, in the order of the file.
pub(crate) fn texts(svg: &str) -> Vec<&str> {
    svg.split("<text ").skip(1).map(|rest| rest.split(['>', '<']).nth(1).unwrap().trim()).collect()
}

#[test]
fn every_figure_is_700_px_wide_and_has_only_finite_coordinates_inside_of_it() {
    for svg in figures(Sheet::SCREEN) {
        assert!(svg.starts_with("<svg width=\"700\" height=\""), "{}", &svg[..60]);
        assert!(svg.trim_end().ends_with("</svg>"));
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
        for attribute in [" x=\"", " x1=\"", " x2=\""] {
            for rest in svg.split(attribute).skip(1) {
                let x: f64 = rest.split('"').next().unwrap().parse().unwrap();
                assert!((0.0..=7000.0).contains(&x), "{x}");
            }
        }
    }
}

#[test]
fn letters_have_seven_to_eight_points_in_columns_and_on_pages_of_journals() {
    for width_mm in [88.0, 180.0] {
        // The last two have one sheet.
        for svg in figures(Sheet::paper(width_mm)).iter().take(5) {
            let number = |attribute: &str, text: &str| -> f64 {
                text.split(&format!("{attribute}=\""))
                    .nth(1)
                    .unwrap()
                    .split('"')
                    .next()
                    .unwrap()
                    .parse()
                    .unwrap()
            };
            let (width, height) = (number("<svg width", svg), number(" height", svg));
            assert!(height < 3.2 * width, "{width_mm} mm: {width} x {height}");
            let point = width_mm / 25.4 * 72.0 / (10.0 * width);
            for text in svg.split("<text ").skip(1) {
                let (size, x) = (point * number("font-size", text), number("x", text));
                assert!((7.0 - 0.01..8.01).contains(&size), "{width_mm} mm: {size} pt: {text:.200}");
                assert!((0.0..10.0 * width).contains(&x), "{width_mm} mm: {x}");
            }
        }
    }
}

#[test]
fn a_histogram_has_a_bar_for_each_bin_and_names_the_best_law() {
    let svg = histogram(&sampling(), Sheet::SCREEN).unwrap();
    assert_eq!(rectangles(&svg), 5);
    let texts = texts(&svg);
    for text in [
        "magnitude of the static deflection [mm]",
        "density [1/mm]",
        "mean 1.350, standard deviation 0.138, min 1.100, max 1.600, nominal 1.330 mm; 101 observations, 1 \
            failed",
        "uniform (preferred)",
        "normal (AIC +15)",
        "nominal",
    ] {
        assert!(texts.contains(&text), "{text}: {texts:?}");
    }
}

#[test]
fn the_bars_of_a_histogram_are_a_density() {
    // Heights in units of the picture; the bin of 20 of 100 in 0.1 mm is 2 / mm high, just as the uniform
    // law.
    let svg = histogram(&sampling(), Sheet::SCREEN).unwrap();
    let height = |bar: usize| -> f64 {
        let rect = svg.split("<rect ").nth(bar + 2).unwrap();
        rect.split("height=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
    };
    assert!((height(3) / height(0) - 1.9).abs() < 0.01);
    assert_eq!(height(2), 0.0);
    assert_eq!(height(4), height(0));
}

#[test]
fn titles_are_escaped() {
    let svg = histogram(&sampling(), Sheet::SCREEN).unwrap();
    assert!(svg.contains("Everything, E &lt; 104 &amp; &quot;rest&quot;"));
}

#[test]
fn a_surface_has_a_cell_for_each_point_and_shows_the_failed_ones() {
    let (summary, mut result) = grid();
    let svg = surface(&summary, &result, Sheet::SCREEN).unwrap();
    let failed = texts(&svg).join("\n");
    for text in
        ["E and m", "Young&apos;s modulus E [GPa]", "mass of the platform m [kg]", "magnitude [mm]", "failed"]
    {
        assert!(failed.contains(text), "{text}: {failed}");
    }
    assert!(texts(&svg).contains(&"100"), "GPa, not Pa");
    result.values[2] = Ok(1.3);
    let whole = surface(&summary, &result, Sheet::SCREEN).unwrap();
    assert_eq!(rectangles(&svg), rectangles(&whole));
    assert_eq!(rectangles(&whole), 6 + 128);
    assert!(!texts(&whole).contains(&"failed"));
}

#[test]
fn points_have_three_bars_each_and_a_panel_per_sampling() {
    let sampling = sampling();
    let svg = point_effects(
        &robot(),
        &[named("symmetric", &sampling), named("other", &sampling)],
        Points::Exit,
        Sheet::SCREEN,
    )
    .unwrap();
    assert_eq!(rectangles(&svg), 2 * 8 * 3);
    let texts = texts(&svg);
    for text in ["B1", "B8", "x", "y", "z", "t [-]", "8.0", "plan: x from −3.50 to 3.50 m"] {
        assert!(texts.contains(&text), "{text}: {texts:?}");
    }
    assert!(!texts.contains(&"A1"));
}

#[test]
fn signed_effects_are_sorted_by_size_and_cut_off() {
    let summary = sampling();
    let svg = signed_effects(&summary, 2, Sheet::SCREEN).unwrap();
    assert_eq!(rectangles(&svg), 2);
    let texts = texts(&svg);
    assert!(texts.contains(&"signed effect on the magnitude of the static deflection [mm]"));
    assert!(texts.contains(&"2 of 3 parameters; intervals of 95 % confidence from 8 replicates"));
    let line_of = |name| texts.iter().position(|text| *text == name);
    // Rows are drawn from the bottom up.
    assert!(line_of("mass").unwrap() < line_of("b2.x").unwrap());
    assert_eq!(line_of("dt1"), None);
}

#[test]
fn without_data_there_is_no_figure() {
    let mut empty = sampling();
    empty.histogram.as_mut().unwrap().counts = vec![0; 5];
    empty.signed_effects.clear();
    assert!(matches!(histogram(&empty, Sheet::SCREEN), Err(ReportError::Empty { .. })));
    assert!(matches!(signed_effects(&empty, 20, Sheet::SCREEN), Err(ReportError::Empty { .. })));
    assert!(matches!(signed_effects(&sampling(), 0, Sheet::SCREEN), Err(ReportError::Empty { .. })));
    assert!(matches!(
        point_effects(&robot(), &[], Points::Exit, Sheet::SCREEN),
        Err(ReportError::Empty { .. })
    ));
    assert!(matches!(
        point_effects(&robot(), &[named("a", &empty)], Points::Anchor, Sheet::SCREEN),
        Err(ReportError::Empty { .. })
    ));
    let (summary, mut result) = grid();
    let failure = result.values[2].clone();
    result.values.fill(failure);
    assert!(matches!(surface(&summary, &result, Sheet::SCREEN), Err(ReportError::Empty { .. })));
}

#[test]
fn a_value_that_cannot_be_drawn_is_refused() {
    let invalid = |figure: Result<String, ReportError>| matches!(figure, Err(ReportError::Invalid { .. }));
    let change = |change: fn(&mut SamplingSummary)| {
        let mut summary = sampling();
        change(&mut summary);
        summary
    };
    assert!(invalid(histogram(&change(|s| s.values.as_mut().unwrap().nominal = f64::NAN), Sheet::SCREEN)));
    assert!(invalid(histogram(
        &change(|s| {
            let edges = &mut s.histogram.as_mut().unwrap().edges;
            edges[2] = edges[1];
        }),
        Sheet::SCREEN
    )));
    assert!(invalid(histogram(&change(|s| s.histogram.as_mut().unwrap().edges.truncate(5)), Sheet::SCREEN)));
    let nan = change(|s| s.t_student.values_mut().for_each(|t| *t = f64::NAN));
    assert!(invalid(point_effects(&robot(), &[named("a", &nan)], Points::Exit, Sheet::SCREEN)));
    let wide = SignedEffect { effect: 0.0, low: f64::NEG_INFINITY, high: f64::INFINITY };
    let mut summary = sampling();
    summary.signed_effects.insert("mass".to_owned(), wide);
    assert!(invalid(signed_effects(&summary, 1, Sheet::SCREEN)));

    let (mut summary, mut result) = grid();
    result.values[0] = Ok(f64::INFINITY);
    assert!(invalid(surface(&summary, &result, Sheet::SCREEN)));
    result.values.pop();
    assert!(invalid(surface(&summary, &result, Sheet::SCREEN)));
    summary.parameters[0] = "modulus".to_owned();
    assert!(invalid(surface(&summary, &result, Sheet::SCREEN)));
}

#[test]
fn a_surface_on_which_nothing_varies_has_a_figure() {
    let (summary, mut result) = grid();
    for noise in [0.0, 2.3e-16] {
        result.values.fill(Ok(1.5));
        result.values[0] = Ok(1.5 + noise);
        assert_eq!(rectangles(&surface(&summary, &result, Sheet::SCREEN).unwrap()), 6 + 128);
    }
}

#[test]
fn shares_have_the_leading_input_on_top_and_a_dot_for_each_measure() {
    let svg = shares(&measured(), 12, Sheet::SCREEN).unwrap();
    let texts = texts(&svg);
    assert_eq!(svg.matches("<circle ").count(), 6);
    for text in ["derivatives", "Sobol&apos; first", "Sobol&apos; total", "0.01", "100", "b2.x", "mass"] {
        assert!(texts.contains(&text), "{text} is not in {texts:?}");
    }
    assert!(!texts.contains(&"expansion"), "what is not measured is not in the key");
    let line_of = |name| texts.iter().position(|text| *text == name).unwrap();
    assert!(line_of("mass") < line_of("b2.x"), "names are written from below");
    let one = shares(&measured(), 1, Sheet::SCREEN).unwrap();
    assert_eq!(one.matches("<circle ").count(), 3);

    assert_eq!(shares(&sampling(), 12, Sheet::SCREEN), Err(ReportError::Empty { what: "sensitivity" }));
    assert!(matches!(shares(&measured(), 0, Sheet::SCREEN), Err(ReportError::Empty { .. })));
    let mut spoiled = measured();
    spoiled.sensitivity.as_mut().unwrap().inputs[0].sobol_first_low = Some(f64::NAN);
    let error = shares(&spoiled, 12, Sheet::SCREEN).unwrap_err().to_string();
    assert!(error.contains("sensitivity.mass: Sobol' first is NaN"), "{error}");
}
