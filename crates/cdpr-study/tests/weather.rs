//! Studies in weather.

use crate::output::{opened, same};
use cdpr_robot::{Coordinate, Parameter, Robot, Vector3};
use cdpr_sensitivity::SampleDesign;
use cdpr_statics::batch::ScalarReason;
use cdpr_statics::weather::{Weather, Wind, WindProfile, in_weather};
use cdpr_statics::{DirectProblem, DirectStart, Load, StaticsError, WantedPose, inverse};
use cdpr_study::{
    Measured, Part, SamplingSummary, Session, Study, StudyError, analyse, observe, observe_into,
};
use serde_json::{Value, json};
use std::collections::HashMap;

/// Robots with a pose, the coordinates that are found there, and a speed of the wind that they bear [m/s]:
/// heavy and light ones, sagging and prestressed ones, on few cables, a point, over pulleys.
const ROBOTS: [(&str, [f64; 3], &[&str], f64); 7] = [
    ("../robots/caroca.json", [0.3, -0.2, 1.75], &[], 12.0),
    ("../robots/cogiro.json", [1.0, 0.5, 2.0], &[], 12.0),
    ("../robots/fast.json", [0.0, 0.0, 140.0], &[], 8.0),
    ("../robots/segesta.json", [0.05, 0.02, 0.5], &[], 3.0),
    ("../robots/four-cables.json", [0.2, 0.1, 1.5], &["roll", "pitch"], 5.0),
    (STADIUM, [20.0, 10.0, 12.0], &[], 8.0),
    ("../robots/ipanema-3.json", [0.5, 0.2, 1.5], &[], 8.0),
];

const STADIUM: &str = "../../docs/how-to/loads/stadium.json";

const EXPANSION: [f64; 2] = [1.2e-5, 1.0e-5];

const OBSERVATIONS: usize = 8;

/// A change of a study, and parts of the message that refuses it.
type Refused<'a> = (&'a dyn Fn(&mut Value), &'a [&'a str]);

/// A study whose weather and modulus deviate.
fn study((robot, position, free, speed): (&str, [f64; 3], &[&str], f64)) -> Value {
    json!({
        "format": "cdpr-study/1", "name": "a year", "robot": robot, "payload": 0.0, "force": [0.5, 0.2, 0.0],
        "seed": 5, "replicates": 0, "bootstrap_resamples": 5, "confidence": 0.9,
        "weather": {
            "cable_expansion": EXPANSION[0], "frame_expansion": EXPANSION[1],
            "wind_profile": { "roughness": 0.03, "reference": 10.0 }
        },
        "error_models": { "year": {
            "youngs_modulus": { "law": { "uniform": { "min": -1e8, "max": 1e8 } } },
            "b1.x": { "law": { "uniform": { "min": -0.001, "max": 0.001 } } },
            "wind_speed": { "law": { "weibull": { "shape": 2.0, "scale": speed } } },
            "wind_from_deg": { "law": { "uniform": { "min": 0.0, "max": 360.0 } } },
            "warmer": { "law": { "normal": { "mean": 0.0, "std": 9.0 } } },
            "ice": { "law": { "uniform": { "min": 0.0, "max": 0.0002 } } },
            "creep": { "law": { "uniform": { "min": 0.0, "max": 1e-5 } } }
        } },
        "samplings": { "point": {
            "title": "At a point", "pose": { "position": position }, "free": free, "error_model": "year",
            "observations": OBSERVATIONS
        } }
    })
}

/// The inputs of each observation by their names, and what was observed.
fn observed(study: &Study) -> Vec<(HashMap<String, f64>, Option<Measured>)> {
    let sampling = study.sampling("point").unwrap();
    let names: Vec<_> = sampling.design.inputs().iter().map(|input| input.name.clone()).collect();
    let mut found = Vec::new();
    let each = |part: &Part| part.clone();
    observe_into(&sampling, &Session::in_memory(), each, |part| {
        for (row, outcome) in part.rows.chunks_exact(names.len()).zip(part.outcomes) {
            let row = names.iter().cloned().zip(row.iter().copied()).collect();
            found.push((row, outcome.ok()));
        }
        Ok(())
    })
    .unwrap();
    found
}

/// The weather of a row.
fn weather(row: &HashMap<String, f64>) -> Weather {
    let of = |name: &str| row.get(name).copied().unwrap_or_default();
    let from = of("wind_from_deg").to_radians();
    let wind = Wind::new(-of("wind_speed") * Vector3::new(from.cos(), from.sin(), 0.0)).unwrap();
    let wind = wind.over_height(WindProfile { roughness: 0.03, reference: 10.0 }).unwrap();
    let [cable_expansion, frame_expansion] = if of("warmer") == 0.0 { [0.0; 2] } else { EXPANSION };
    Weather {
        wind,
        warmer: of("warmer"),
        cable_expansion,
        frame_expansion,
        ice: of("ice"),
        creep: of("creep"),
    }
}

/// The robot of a row.
fn deviating(robot: &Robot, row: &HashMap<String, f64>) -> Robot {
    let of = |name: &str| {
        let parameter: Parameter = name.parse().unwrap();
        (name.to_owned(), parameter.nominal(robot) + row.get(name).copied().unwrap_or_default())
    };
    let values = [of("youngs_modulus"), of("b1.x")];
    robot.with_values(&values.each_ref().map(|(name, value)| (name.as_str(), *value))).unwrap()
}

/// The displacement [mm] by a call for this observation alone.
fn alone(study: &Study, row: &HashMap<String, f64>) -> Result<Vector3<f64>, StaticsError> {
    let sampling = study.sampling("point").unwrap();
    let free: &[Coordinate] = &study.file.samplings["point"].free;
    let robot = deviating(&study.robot, row);
    let wanted = WantedPose::at(&sampling.pose).free(free);
    let (still, rest) = in_weather(&robot, wanted, &study.file.load(), &weather(row))?;
    Ok(1e3 * (rest.pose.position - still.unloaded.equilibrium.pose.position))
}

fn mean_and_deviation(values: &[f64]) -> [f64; 2] {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let squares = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
    [mean, (squares / (values.len() - 1) as f64).sqrt()]
}

#[test]
fn every_observation_is_that_of_a_call_for_it_alone() {
    for case in ROBOTS {
        let study = opened(&study(case)).unwrap();
        let (mut found, mut expected) = (Vec::new(), Vec::new());
        for (row, measured) in observed(&study) {
            let known = alone(&study, &row);
            assert_eq!(measured.is_some(), known.is_ok(), "{} {row:?}", case.0);
            let (Some(measured), Ok(known)) = (measured, known) else { continue };
            assert_eq!(measured.scalar, Some(ScalarReason::Weather));
            let apart = 1e3 * measured.quantity.displacement().unwrap() - known;
            assert!(apart.norm() < 1e-6 * known.norm() + 1e-5, "{} {row:?}: {apart}", case.0);
            found.push(measured.value());
            expected.push(known.norm());
        }
        assert!(found.len() + 1 >= OBSERVATIONS, "{}: {}", case.0, found.len());
        let [mean, deviation] = mean_and_deviation(&expected);
        let [own, spread] = mean_and_deviation(&found);
        assert!(
            (own - mean).abs() < 1e-6 * mean + 1e-5 && (spread - deviation).abs() < 1e-6 * deviation + 1e-5
        );
        assert!(deviation > 1e-2 * mean, "{}: {deviation} {mean}", case.0);
        let summary = summary(&study);
        let values = summary.values.as_ref().unwrap();
        assert!((values.mean - mean).abs() < 1e-6 * mean + 1e-5, "{} {mean}", values.mean);
        assert!((values.std - deviation).abs() < 1e-6 * deviation + 1e-5, "{} {deviation}", values.std);
    }
}

fn summary(study: &Study) -> SamplingSummary {
    let (sampling, session) = (study.sampling("point").unwrap(), Session::in_memory());
    analyse(&sampling, &observe(&sampling, &session).unwrap(), &session).unwrap()
}

#[test]
fn the_numbers_do_not_depend_on_the_threads() {
    let study = opened(&study(ROBOTS[1])).unwrap();
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| observed(&study))
    };
    let (one, three) = (on(1), on(3));
    let bits = |of: &[(_, Option<Measured>)]| -> Vec<_> {
        of.iter().map(|(_, found)| found.as_ref().map(|found| found.value().to_bits())).collect()
    };
    assert_eq!(bits(&one), bits(&three));
}

#[test]
fn a_wind_blows_from_where_it_is_said_to_and_whole_turns_change_nothing() {
    let value = |weather: Value, law: Value| {
        let mut value = study(ROBOTS[5]);
        value["weather"] = weather;
        value["error_models"]["year"] = json!({ "mass": { "law": law } });
        let study = opened(&value).unwrap();
        study.sampling("point").unwrap().nominal_value
    };
    let law = || json!({ "uniform": { "min": -1.0, "max": 1.0 } });
    let from = |degrees: f64| value(json!({ "wind_speed": 15.0, "wind_from_deg": degrees }), law());
    let velocity = [15.0 * 40f64.to_radians().cos(), 15.0 * 40f64.to_radians().sin(), 0.0];
    let towards = value(json!({ "wind": velocity }), law());
    same(from(220.0), towards, 1e-9);
    same(from(220.0 - 1080.0), towards, 1e-9);
    assert!((from(40.0) / towards - 1.0).abs() > 0.01);
    // A deviation of the direction is added to that of the velocity.
    let mut turned = study(ROBOTS[5]);
    turned["weather"] = json!({ "wind": velocity });
    turned["error_models"]["year"] =
        json!({ "wind_from_deg": { "law": { "uniform": { "min": 0.0, "max": 360.0 } } } });
    let turned = opened(&turned).unwrap();
    let quarter = observed(&turned).into_iter().find(|(row, _)| row["wind_from_deg"] == 90.0).unwrap();
    same(quarter.1.unwrap().value(), from(310.0), 1e-9);
}

#[test]
fn shares_by_derivatives_are_those_of_differences() {
    let windy =
        [("wind_speed", 9.0, 1.5), ("wind_from_deg", 35.0, 10.0), ("warmer", 8.0, 6.0), ("ice", 1e-3, 3e-4)];
    for (case, points) in [(ROBOTS[1], 2), (ROBOTS[5], 48)] {
        let mut value = study(case);
        let law = |std: f64| {
            json!({ "law": { "truncated_normal":
            { "mean": 0.0, "std": std, "min": -3.0 * std, "max": 3.0 * std } } })
        };
        let mut model = json!({ "youngs_modulus": law(3e8) });
        for (name, nominal, std) in windy {
            value["weather"][name] = json!(nominal);
            model[name] = law(std);
        }
        // A storm is warm: one cause of two numbers of the weather.
        model["storm"] =
            json!({ "law": law(1.0)["law"], "parameters": { "wind_speed": 0.5, "warmer": 2.0 } });
        value["error_models"]["year"] = model;
        value["sensitivity"] =
            json!({ "morris_blocks": 2, "saltelli_blocks": 0, "derivative_points": points });
        let study = opened(&value).unwrap();
        let summary = summary(&study);
        let found = summary.sensitivity.unwrap();
        let at = |name: &str, by: f64| {
            let mut row: HashMap<String, f64> = windy.iter().map(|of| (of.0.to_owned(), of.1)).collect();
            let causes = [("wind_speed", 0.5), ("warmer", 2.0)];
            let all: &[(&str, f64)] = if name == "storm" { &causes } else { &[(name, 1.0)] };
            all.iter().for_each(|(name, factor)| *row.entry((*name).to_owned()).or_default() += factor * by);
            alone(&study, &row).unwrap().norm()
        };
        let sampling = study.sampling("point").unwrap();
        let parts: Vec<f64> = sampling
            .design
            .inputs()
            .iter()
            .map(|input| {
                let step = 0.02 * input.law.std();
                let central = |step: f64| (at(&input.name, step) - at(&input.name, -step)) / (2.0 * step);
                ((4.0 * central(step) - central(2.0 * step)) / 3.0 * input.law.std()).powi(2)
            })
            .collect();
        let all: f64 = parts.iter().sum();
        for (input, part) in found.inputs.iter().zip(parts) {
            let share = input.derivative_share.unwrap();
            assert!((share - part / all).abs() < 1e-4, "{} {}: {share} {}", case.0, input.input, part / all);
            assert_eq!(
                input.total_upper.is_some() && input.first_lower.is_some(),
                points > 40,
                "{}",
                input.input
            );
        }
        let of_weather = found.sums["weather"]["derivative_share"];
        assert!(of_weather > 0.5 && of_weather < 1.0, "{of_weather}");
    }
}

#[test]
fn cables_over_pulleys_have_no_derivatives_in_wind_and_measures_without_them() {
    let mut value = study(ROBOTS[6]);
    value["samplings"]["point"]["observations"] = json!(12);
    value["sensitivity"] = json!({ "morris_blocks": 2, "saltelli_blocks": 0, "derivative_points": 2 });
    let found = summary(&opened(&value).unwrap()).sensitivity.unwrap();
    let why = found.notes.iter().find(|note| note.starts_with("derivatives:")).unwrap();
    assert!(why.contains("no derivative") || why.contains("derivative"), "{why}");
    assert!(found.inputs.iter().all(|input| input.derivative_share.is_none()));
    let speed = found.inputs.iter().find(|input| input.input == "wind_speed").unwrap();
    assert!(speed.regression_share.unwrap() > 0.0 && speed.morris_mean_absolute.unwrap() > 0.0);
}

#[test]
fn a_position_is_that_on_the_lengths_of_the_nominal_robot() {
    for case in [ROBOTS[1], ROBOTS[5]] {
        let mut value = study(case);
        value["output"] = json!("position");
        let study = opened(&value).unwrap();
        let pose = study.sampling("point").unwrap().pose;
        let lengths = inverse(&study.robot, &pose, &Load::none()).unwrap().lengths;
        for (row, measured) in observed(&study).into_iter().step_by(3) {
            let weather = weather(&row);
            let changed = weather.robot(&deviating(&study.robot, &row)).unwrap();
            let lengths = weather.lengths(&lengths);
            let problem = DirectProblem::new(&changed, &lengths, &Load::none()).unwrap();
            let rest = problem.direct(DirectStart::Pose(&pose)).unwrap();
            let rest = problem.in_wind(&weather.wind, &rest).unwrap();
            let expected = 1e3 * (rest.pose.position - pose.position).norm();
            let found = measured.unwrap().value();
            assert!((found - expected).abs() < 1e-6 * expected + 1e-5, "{found} {expected}");
        }
    }
}

#[test]
fn weather_that_cannot_be_is_refused_with_field_value_and_what_would_be_right() {
    let refused = |change: &dyn Fn(&mut Value)| -> String {
        let mut value = study(ROBOTS[5]);
        change(&mut value);
        let error: StudyError = opened(&value).unwrap_err();
        error.to_string().replace('\n', " ")
    };
    let cases: [Refused; 12] = [
        (&|of| of["weather"]["wind_speed"] = json!(-3.0), &["weather.wind_speed", "-3", "zero or more"]),
        (&|of| of["weather"]["wnd"] = json!([1, 0, 0]), &["wnd", "wind_from_deg"]),
        (&|of| of["weather"]["wind_speed"] = json!(300.0), &["weather.wind", "120 m/s"]),
        (
            &|of| of["weather"] = json!({ "wind": [1, 0, 0], "wind_speed": 3.0 }),
            &["weather.wind", "speed and direction"],
        ),
        (&|of| of["weather"]["ice"] = json!(3.0), &["weather.ice", "0 to 0.3 m"]),
        (&|of| of["weather"]["warmer"] = json!(1e3), &["weather.warmer", "-200 to 200 K"]),
        (
            &|of| {
                of["weather"] = json!({ "warmer": 20.0 });
                of["error_models"]["year"] =
                    json!({ "mass": { "law": { "uniform": { "min": -1.0, "max": 1.0 } } } });
            },
            &["weather.warmer", "expansion"],
        ),
        (&|of| of["weather"] = json!({}), &["error_models.year.warmer", "cable_expansion"]),
        (
            &|of| {
                of["error_models"]["year"]["wind_speed"]["law"] =
                    json!({ "normal": { "mean": 5.0, "std": 2.0 } });
            },
            &["error_models.year.wind_speed.law", "-inf", "weibull"],
        ),
        (
            &|of| of["error_models"]["year"]["wind_sped"] = of["error_models"]["year"]["wind_speed"].clone(),
            &["wind_sped", "wind_speed, wind_from_deg"],
        ),
        (&|of| of["output"] = json!("stiffness"), &["stiffness", "deflection or position"]),
        (
            &|of| {
                of["weather"] = json!({});
                of["force"] = json!([0, 0, 0]);
                of["error_models"]["year"] =
                    json!({ "mass": { "law": { "uniform": { "min": -1.0, "max": 1.0 } } } });
            },
            &["payload", "weather"],
        ),
    ];
    for (change, parts) in cases {
        let text = refused(change);
        assert!(parts.iter().all(|part| text.contains(part)), "{text}: {parts:?}");
    }
    // Cables without a diameter have no drag and no ice.
    let bare = study(("../robots/grab.json", [0.0, 0.0, 1.0], &["roll", "pitch"], 3.0));
    let error = opened(&bare).unwrap_err().to_string();
    assert!(error.contains("diameter") && error.contains("wind_speed"), "{error}");
}

#[test]
fn the_weather_is_part_of_what_is_observed() {
    let whole = opened(&study(ROBOTS[5])).unwrap();
    let mut other = study(ROBOTS[5]);
    other["weather"]["wind_profile"]["roughness"] = json!(0.3);
    assert_ne!(whole.hash().unwrap(), opened(&other).unwrap().hash().unwrap());
    // Commands that know no weather refuse its numbers.
    let error = whole.tolerances("year").unwrap_err().to_string();
    assert!(error.contains("without weather"), "{error}");
    let seconds = whole.scalar_samplings().unwrap();
    assert_eq!((seconds.len(), seconds[0].reason), (1, ScalarReason::Weather));
    assert!(seconds[0].to_string().contains("the fast models have no weather"), "{}", seconds[0]);
}
