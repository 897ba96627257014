//! Tolerance budgets: that the limit is kept, at the least cost, and that what cannot be kept is said.

use cdpr_assess::{Limit, Limited, ToleranceBudget, tolerance_budget};
use cdpr_study::{IndexMap, Output, Study};
use std::path::Path;

fn study() -> Study {
    Study::open(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies/caroca.json"))).unwrap()
}

fn limit(of: Limited, limit_mm: f64) -> Limit {
    Limit { of: Some(of), limit_mm, quantile: 0.95, costs: IndexMap::new(), verified_with: 4000 }
}

fn budget(sampling: &str, limit: &Limit) -> Result<ToleranceBudget, String> {
    let study = study();
    tolerance_budget(&study.sampling(sampling).unwrap(), limit).map_err(|error| error.to_string())
}

fn factor(budget: &ToleranceBudget, name: &str) -> f64 {
    budget.tolerances.iter().find(|tolerance| tolerance.name == name).unwrap().factor
}

#[test]
fn the_modulus_is_what_to_tighten_for_the_deflection() {
    let found = budget("mechanical", &limit(Limited::Deflection, 1.4)).unwrap();
    assert!(found.now.quantile_mm.low > 1.4 && found.now.within.high < 0.7, "{:?}", found.now);
    // The limit is met, not undercut: the quantile of independent draws is as near as its interval says.
    let reached = found.tightened.quantile_mm;
    assert!(reached.low <= 1.4 && reached.high >= 1.395, "{reached:?}");
    assert_eq!(found.tolerances[0].name, "youngs_modulus");
    assert!(found.tolerances[0].factor < 0.35 && found.tolerances[1..].iter().all(|t| t.factor == 1.0));
    assert!(found.cost[1] > found.cost[0]);
    // Halving the modulus' tolerance halves nearly all that the tolerances add.
    let halved =
        (found.tolerances[0].halved_mm - found.least_mm) / (found.now.quantile_mm.value - found.least_mm);
    assert!((halved - 0.5).abs() < 0.02, "{halved}");
    assert!(found.explained.unwrap() > 0.95 && found.sentences().len() == 2, "{:?}", found.explained);
}

#[test]
fn the_position_depends_on_the_points_and_a_dearer_tolerance_is_tightened_less() {
    let cheap = limit(Limited::Position, 30.0);
    let even = budget("geometrical", &cheap).unwrap();
    assert!(even.least_mm < 1e-6);
    assert!(
        even.tightened.quantile_mm.low <= 30.0 && even.tightened.quantile_mm.high >= 29.0,
        "{:?}",
        even.tightened
    );
    assert!(factor(&even, "b") < factor(&even, "a") && factor(&even, "youngs_modulus") == 1.0);
    let dear = Limit { costs: [("b".to_owned(), 10.0)].into_iter().collect(), ..cheap };
    let dear = budget("geometrical", &dear).unwrap();
    assert!(factor(&dear, "b") > factor(&even, "b") && factor(&dear, "a") < factor(&even, "a"));
    assert!(dear.tightened.quantile_mm.low <= 30.0 && dear.tightened.quantile_mm.high >= 29.0);
}

#[test]
fn tension_offsets_alone_move_the_platform_in_proportion() {
    let study = Study::open(Path::new(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../data/studies/caroca-tension.json"
    )))
    .unwrap();
    let reached = |sampling| {
        let limit = limit(Limited::Position, 1.0);
        tolerance_budget(&study.sampling(sampling).unwrap(), &limit).unwrap()
    };
    let (wide, narrow) = (reached("no_feedback_alone"), reached("measured_alone"));
    assert!(wide.least_mm < 1e-6 && wide.now.quantile_mm.low > 0.05, "{wide:?}");
    let ratio = wide.now.quantile_mm.value / narrow.now.quantile_mm.value;
    assert!((ratio - 2.0).abs() < 1e-3, "{ratio}");
    // A narrower sample reaches what equation (B2) predicts from exact derivatives.
    assert!((wide.tolerances[0].halved_mm / narrow.now.quantile_mm.value - 1.0).abs() < 0.03, "{wide:?}");
}

#[test]
fn a_limit_that_holds_already_asks_for_nothing() {
    let found = budget("mechanical", &limit(Limited::Deflection, 2.0)).unwrap();
    assert!(found.tolerances.iter().all(|tolerance| tolerance.factor == 1.0));
    assert_eq!((found.cost[0], found.cost[1], found.rounds), (7.0, 7.0, 1));
    assert_eq!(found.now.within.value, 1.0);
}

#[test]
fn the_same_on_any_number_of_threads() {
    let limit = limit(Limited::Deflection, 1.4);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| budget("mechanical", &limit).unwrap())
    };
    assert_eq!(on(1), on(2));
}

#[test]
fn what_cannot_be_kept_is_said() {
    let deflection = |limit_mm| limit(Limited::Deflection, limit_mm);
    let message = |limit: Limit| budget("mechanical", &limit).unwrap_err();
    let below = message(deflection(1.3));
    assert!(
        below.starts_with("limit is 1.3 mm: expected one that tolerances reach")
            && below.contains("1.331")
            && below.contains("not above the deflection without any deviation"),
        "{below}"
    );
    for (limit, words) in [
        (deflection(f64::NAN), "limit is NaN: expected a positive finite number"),
        (deflection(0.0), "limit is 0: expected"),
        (Limit { quantile: 1.0, ..deflection(1.4) }, "quantile is 1: expected a share"),
        (Limit { verified_with: 0, ..deflection(1.4) }, "observations is 0: expected 1 to"),
        (
            Limit { costs: [("c".to_owned(), 1.0)].into_iter().collect(), ..deflection(1.4) },
            "costs is c: expected one of the tolerances mass, ",
        ),
        (
            Limit { costs: [("b".to_owned(), -1.0)].into_iter().collect(), ..deflection(1.4) },
            "costs.b is -1: expected a positive",
        ),
    ] {
        let message = message(limit);
        assert!(message.starts_with(words), "{message}");
    }
}

#[test]
fn robots_that_hold_no_pose_are_beyond_the_limit() {
    let mut study = study();
    let tensions = study.sampling("mechanical").unwrap().nominal.unloaded.equilibrium.tensions();
    // Cables that bear little more than the nominal platform: heavy ones are beyond them.
    study.robot.tension_limits.max = 1.08 * tensions.into_iter().fold(0.0, f64::max);
    let budget = |quantile| {
        let limit = Limit { quantile, ..limit(Limited::Deflection, 1.5) };
        tolerance_budget(&study.sampling("mechanical").unwrap(), &limit)
    };
    let found = budget(0.5).unwrap();
    let share = found.now.failed as f64 / found.now.robots as f64;
    assert!((0.02..0.4).contains(&share), "{share}");
    assert!(found.now.within.value < 1.0 - share + 1e-12, "{:?}", found.now);
    let message = budget(0.999).unwrap_err().to_string();
    assert!(
        message.starts_with("no equilibrium at the wanted pose for ") && message.contains(" of 64 robots"),
        "{message}"
    );
}

#[test]
fn the_error_is_the_studys_output_unless_the_limit_names_another() {
    let mut study = study();
    let with = |of, limit_mm| Limit { of, ..limit(Limited::Deflection, limit_mm) };
    study.file.output = Output::Position;
    let sampling = study.sampling("geometrical").unwrap();
    let found = tolerance_budget(&sampling, &with(None, 30.0)).unwrap();
    let named = tolerance_budget(&sampling, &with(Some(Limited::Position), 30.0)).unwrap();
    assert_eq!((found.of, &found), (Limited::Position, &named));
    // The deflection has its own observer, whatever the output.
    let deflection = tolerance_budget(&sampling, &with(Some(Limited::Deflection), 1.36)).unwrap();
    assert_eq!(deflection, budget("geometrical", &limit(Limited::Deflection, 1.36)).unwrap());

    // Frequencies need an inertia.
    study.robot.platform.inertia = Some(cdpr_robot::Matrix3::from_diagonal_element(30.0));
    for output in [Output::Stiffness, Output::Frequency] {
        study.file.output = output;
        let sampling = study.sampling("geometrical").unwrap();
        let error = tolerance_budget(&sampling, &with(None, 30.0)).unwrap_err().to_string();
        let said = format!("the study's output is {output}: expected deflection or position");
        assert!(error.contains(&said), "{error}");
        assert!(tolerance_budget(&sampling, &with(Some(Limited::Deflection), 1.36)).is_ok());
    }
}

#[test]
fn the_weather_stays_as_it_is_and_the_other_tolerances_are_tightened() {
    let file = serde_json::json!({
        "format": "cdpr-study/1", "name": "hall", "robot": "../robots/caroca.json", "payload": 50.0,
        "seed": 3, "replicates": 0, "confidence": 0.95, "bootstrap_resamples": 5,
        "weather": { "cable_expansion": 1.2e-5, "frame_expansion": 1.0e-5 },
        "error_models": { "hall": {
            "warmer": { "law": { "normal": { "mean": 0.0, "std": 2.0 } } },
            "youngs_modulus": { "law": { "uniform": { "min": -2e10, "max": 2e10 } } }
        } },
        "samplings": { "point": {
            "title": "Point", "pose": { "position": [0.0, 0.0, 1.75] }, "error_model": "hall",
            "observations": 3
        } }
    });
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies/hall.json"));
    let study = Study::from_json(&file.to_string(), path).unwrap();
    let sampling = study.sampling("point").unwrap();
    let of = |limit_mm: f64| Limit { verified_with: 300, ..limit(Limited::Deflection, limit_mm) };
    let wide = tolerance_budget(&sampling, &of(10.0)).unwrap();
    let (alone, now) = (wide.weather_mm.unwrap(), wide.now.quantile_mm.value);
    assert!(alone > wide.least_mm && now > 1.1 * alone, "{alone} {now}");
    let wanted = 0.5 * (alone + now);
    let found = tolerance_budget(&sampling, &of(wanted)).unwrap();
    let [modulus, warmer] = ["youngs_modulus", "warmer"].map(|name| factor(&found, name));
    assert!(modulus < 0.9 && warmer == 1.0, "{modulus}");
    // 300 robots know the quantile to their interval.
    let reached = found.tightened.quantile_mm;
    assert!(reached.low <= wanted && reached.high >= wanted && reached.value < now, "{reached:?} {wanted}");
    assert_eq!(found.tolerances.iter().map(|of| of.weather).collect::<Vec<_>>(), [false, true]);
    assert_eq!(found.cost[0], 1.0);
    let said = found.sentences().join(" ");
    assert!(said.contains("The weather in warmer cannot be bought"), "{said}");
    let refused = |limit: &Limit| tolerance_budget(&sampling, limit).unwrap_err().to_string();
    assert!(refused(&of(0.99 * alone)).contains("the weather alone"), "{}", refused(&of(0.99 * alone)));
    let bought = Limit { costs: [("warmer".to_owned(), 2.0)].into_iter().collect(), ..of(wanted) };
    assert!(refused(&bought).contains("one of the tolerances youngs_modulus"), "{}", refused(&bought));
    let position = Limit { of: Some(Limited::Position), ..of(10.0) };
    assert!(
        refused(&position).contains("point is position error: expected one with a known"),
        "{}",
        refused(&position)
    );
}

/// CAROCA's study with prices.
fn priced(prices: serde_json::Value) -> Result<Study, String> {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies/caroca.json"));
    let mut file: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    file["prices"] = prices;
    Study::from_json(&file.to_string(), path).map_err(|error| error.to_string())
}

#[test]
fn prices_of_the_reciprocal_law_are_the_costs_of_halving() {
    let costs = [("a", 2.0), ("b", 5.0), ("youngs_modulus", 1.0), ("mass", 1.0), ("linear_density", 1.0)];
    let costs: IndexMap<String, f64> =
        costs.into_iter().map(|(name, cost)| (name.to_owned(), cost)).collect();
    let prices = costs.iter().map(|(name, cost)| (name.clone(), serde_json::json!({"cost": cost})));
    let study = priced(serde_json::Value::Object(prices.collect())).unwrap();
    let limit = Limit { verified_with: 500, ..limit(Limited::Position, 30.0) };
    let by_prices = tolerance_budget(&study.sampling("geometrical").unwrap(), &limit).unwrap();
    let by_costs = budget("geometrical", &Limit { costs, ..limit }).unwrap();
    for name in ["a", "b"] {
        let [one, other] = [&by_prices, &by_costs].map(|found| factor(found, name));
        assert!(one < 1.0 && (one / other - 1.0).abs() < 1e-9, "{name}: {one} {other}");
    }
    // What a further unit buys is what budgets for other limits cost.
    let cost = |limit_mm: f64| {
        let limit = Limit { limit_mm, ..limit.clone() };
        tolerance_budget(&study.sampling("geometrical").unwrap(), &limit).unwrap().cost[1]
    };
    let rates: Vec<f64> =
        by_prices.tolerances.iter().filter(|of| of.factor < 1.0).filter_map(|of| of.mm_per_cost).collect();
    let wanted = 2.0 / (cost(29.0) - cost(31.0));
    // Each budget meets its limit within a thousandth.
    assert!(rates.len() == 2 && (rates[0] / rates[1] - 1.0).abs() < 1e-9, "{rates:?}");
    assert!((rates[0] / wanted - 1.0).abs() < 0.05, "{rates:?} {wanted}");
}

#[test]
fn a_calibration_is_bought_where_it_is_cheaper_than_grades() {
    let of = |survey: f64, limit_mm: f64| {
        let study = priced(serde_json::json!({
            "b": {"grades": [{"std": 0.01, "cost": 10}, {"std": 0.005, "cost": 40}]},
            "survey": {"cost": survey, "leaves": {"b": 0.0025}}
        }));
        let limit = Limit { verified_with: 400, ..limit(Limited::Position, limit_mm) };
        tolerance_budget(&study.unwrap().sampling("geometrical").unwrap(), &limit)
    };
    let wide = of(60.0, 1000.0).unwrap();
    assert_eq!((wide.cost, wide.calibrations[0].bought), ([0.0, 0.0], false));
    assert_eq!(wide.calibrations[0].saves, Some(-60.0));
    let std = wide.tolerances.iter().find(|of| of.name == "b").unwrap().std;
    let (now, room) = (wide.now.quantile_mm.value, |std_then: f64| std_then / std);
    assert!(room(0.01) < 1.0, "{std}");
    // The first grade suffices for a limit a little below what is there now.
    let little = of(60.0, 0.97 * now).unwrap();
    assert_eq!((little.cost[1], little.tolerances[0].by), (10.0, Some("grade")), "{little:?}");
    assert!(little.tightened.within.high >= 0.95);
    // Without the survey the second grade would be bought.
    let least = |limit_mm: f64, survey: f64| of(survey, limit_mm).unwrap();
    let strict = (1..20)
        .map(|k| 0.97 * now * (1.0 - 0.05 * f64::from(k)))
        .find(|limit_mm| least(*limit_mm, 60.0).cost[1] > 10.0)
        .unwrap();
    let [dear, cheap] = [60.0, 30.0].map(|survey| least(strict, survey));
    assert_eq!((dear.cost[1], dear.calibrations[0].saves), (40.0, Some(-20.0)));
    assert_eq!((cheap.cost[1], cheap.calibrations[0].saves), (30.0, Some(10.0)));
    assert_eq!((cheap.tolerances[0].by, cheap.calibrations[0].bought), (Some("calibration"), true));
    assert!(cheap.sentences()[0].contains("spend 30.00: do survey."), "{:?}", cheap.sentences());
    let unreached = of(60.0, 0.01 * now).unwrap_err().to_string();
    assert!(unreached.contains("the best tolerances and all calibrations do not reach it"), "{unreached}");
}

#[test]
fn a_price_that_no_tolerance_can_have_is_refused() {
    use serde_json::json;
    for (prices, said) in [
        (json!({"z": {"cost": 1}}), "prices.z"),
        (json!({"b": {"cost": -1}}), "prices.b.cost is -1: expected a positive finite number"),
        (json!({"b": {}}), "prices.b.cost is missing"),
        (json!({"b": {"cost": 1, "power": 0}}), "prices.b.power is 0"),
        (
            json!({"b": {"cost": 1, "grades": [{"std": 1e-3, "cost": 1}]}}),
            "prices.b.grades is given: expected either",
        ),
        (json!({"b": {"grades": [{"std": 1e-3, "cost": -1}]}}), "prices.b.grades[0].cost is -1"),
        (json!({"survey": {"leaves": {"b": 1e-4}}}), "prices.survey.cost is missing"),
        (
            json!({"survey": {"cost": 1, "leaves": {"z": 1e-4}}}),
            "prices.survey.leaves.z is z: expected an entry",
        ),
        (json!({"survey": {"cost": 1, "power": 2, "leaves": {"b": 1e-4}}}), "prices.survey.power is given"),
        (json!({"b": {"cost": 1, "leaves": {"a": 1e-4}}}), "prices.b.leaves is given"),
    ] {
        let message = priced(prices).map(|_| ()).unwrap_err();
        assert!(message.contains(said), "{message}");
    }
    let refused = |prices, limit: &Limit| {
        let study = priced(prices).unwrap();
        tolerance_budget(&study.sampling("geometrical").unwrap(), limit).unwrap_err().to_string()
    };
    let usual = limit(Limited::Position, 30.0);
    for (prices, said) in [
        (json!({"b": {"cost": 1, "least": 1}}), "prices.b.least is 1: expected a standard deviation below"),
        (json!({"b": {"grades": [{"std": 1, "cost": 1}]}}), "prices.b.grades[0].std is 1: expected"),
        (json!({"survey": {"cost": 1, "leaves": {"b": 1}}}), "prices.survey.leaves.b is 1: expected"),
    ] {
        let message = refused(prices, &usual);
        assert!(message.contains(said), "{message}");
    }
    let both = Limit { costs: [("b".to_owned(), 2.0)].into_iter().collect(), ..usual };
    let message = refused(json!({"b": {"cost": 1}}), &both);
    assert!(message.contains("costs.b is 2: expected none next to the `prices`"), "{message}");
}
