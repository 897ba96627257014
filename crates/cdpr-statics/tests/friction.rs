//! Load cycles over pulleys with friction.

use crate::common::caroca;
use crate::equilibria::{number, vector};
use crate::reference::rotation;
use cdpr_evidence::accept;
use cdpr_robot::{Pose, Robot};
use cdpr_statics::StaticsError;
use cdpr_statics::hysteresis::{
    CycleStep, HysteresisLaw, LoadCycle, PulleyFriction, WinchReading, fit_friction, load_cycle,
    load_cycle_over_pulleys,
};
use serde_json::Value;

fn linear(robot: &Robot) -> Vec<HysteresisLaw> {
    vec![HysteresisLaw::linear().unwrap(); robot.cables.len()]
}

/// A robot of `data/robots` with leads [m].
fn library(name: &str, lead: f64) -> Robot {
    let file = format!("{}/../../data/robots/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let mut robot = Robot::from_json(&std::fs::read_to_string(file).unwrap()).unwrap();
    robot.cables.iter_mut().for_each(|cable| cable.lead = lead);
    robot
}

fn ran(robot: &Robot, pose: Pose, payload: f64, steps: usize, friction: PulleyFriction) -> LoadCycle {
    load_cycle_over_pulleys(robot, pose, &linear(robot), payload, steps, friction).unwrap()
}

fn steps(cycle: &LoadCycle) -> Vec<&CycleStep> {
    cycle.loading.iter().chain(cycle.unloading.iter().skip(1)).collect()
}

#[test]
fn load_cycles_with_friction_match_the_integration_of_another_program() {
    let file: Value = serde_json::from_str(include_str!("../../../data/reference/friction.json")).unwrap();
    let cases = file["cases"].as_array().unwrap();
    let mut slipping = 0;
    for case in cases {
        let robot = Robot::from_json(&case["robot"].to_string()).unwrap();
        let friction =
            PulleyFriction { friction: number(&case["friction"]), bearing: number(&case["bearing"]) };
        let [x, y, z] = vector(&case["pose"]).into();
        let count = case["steps"].as_u64().unwrap() as usize;
        let cycle = ran(&robot, Pose::at(x, y, z), number(&case["payload"]), count, friction);
        let found = case["found"].as_array().unwrap();
        assert_eq!(found.len(), steps(&cycle).len());
        let (mut moved, mut tensions, mut slips) = (0.0f64, 0.0f64, 0.0f64);
        for (expected, step) in found.iter().zip(steps(&cycle)) {
            assert!((number(&expected["payload"]) - step.payload).abs() < 1e-12);
            let exact =
                Pose { position: vector(&expected["position"]), rotation: rotation(&expected["rotation"]) };
            let motion = exact.motion_to(&step.solution.equilibrium.pose);
            moved = moved.max(motion.amax());
            for (i, pulley) in step.pulleys.iter().enumerate() {
                let of = |name: &str| number(&expected[name][i]);
                for (value, exact) in [
                    (pulley.tension, of("leave")),
                    (pulley.winch_tension, of("winch")),
                    (pulley.wrap, of("wrap")),
                ] {
                    tensions = tensions.max((value / exact - 1.0).abs());
                }
                slips = slips.max((pulley.slip - of("slip")).abs());
                slipping += usize::from(pulley.slip.abs() == 1.0);
            }
        }
        println!("{:30} {moved:8.1e} m, {tensions:8.1e}, slip {slips:8.1e}", case["kind"]);
        accept("V-HYSTERESIS-004", moved);
        accept("V-HYSTERESIS-005", tensions);
        assert!(slips < 1e-8, "{slips:e}");
    }
    assert!(slipping > 20);
}

#[test]
fn the_ratio_of_tensions_solves_the_balance_of_the_wheel() {
    for (friction, bearing) in [(0.0, 0.1), (0.1, 0.0), (0.2, 0.05), (0.5, 0.3)] {
        let of = PulleyFriction { friction, bearing };
        for wrap in [1e-3, 0.7, 1.6, 3.0, 4.0] {
            for slip in [-1.0, -0.3, 0.0, 0.4, 1.0] {
                let ratio = of.ratio(wrap, slip);
                let resultant = (1.0 + ratio * ratio - 2.0 * ratio * f64::cos(wrap)).sqrt();
                let balanced = f64::exp(slip * friction * wrap) + slip * bearing * resultant;
                let off = (ratio - balanced.max(0.0)).abs();
                assert!(off <= 1e-13 * balanced.max(1.0), "{of:?} {wrap} {slip}: {ratio} {balanced}");
            }
        }
    }
}

#[test]
fn without_friction_the_cycle_is_the_same_to_the_last_bit() {
    for (robot, pose) in
        [(library("ipanema-3", 2.0), Pose::at(0.0, 0.0, 1.5)), (caroca(), Pose::at(0.0, 0.0, 1.75))]
    {
        let plain = load_cycle(&robot, pose, &linear(&robot), 20.0, 5).unwrap();
        assert_eq!(ran(&robot, pose, 20.0, 5, PulleyFriction::default()), plain);
    }
}

#[test]
fn friction_of_a_robot_without_pulleys_is_refused() {
    for (friction, bearing, name) in [(0.1, 0.0, "friction"), (0.0, 0.1, "bearing")] {
        let friction = PulleyFriction { friction, bearing };
        for robot in [caroca(), library("ipanema-1", 1.0)] {
            let pose = Pose::at(0.0, 0.0, 1.0);
            let refused = load_cycle_over_pulleys(&robot, pose, &linear(&robot), 5.0, 2, friction);
            let Err(StaticsError::Invalid { field, value, expected }) = refused else {
                panic!("{refused:?}")
            };
            assert!(field == name && value == "0.1" && expected.contains("without pulleys"), "{expected}");
        }
    }
    let robot = library("ipanema-3", 0.0);
    for (friction, bearing, name) in
        [(-0.1, 0.0, "friction"), (0.0, 0.6, "bearing"), (f64::NAN, 0.0, "friction")]
    {
        let friction = PulleyFriction { friction, bearing };
        let refused =
            load_cycle_over_pulleys(&robot, Pose::at(0.0, 0.0, 1.0), &linear(&robot), 5.0, 2, friction);
        assert!(matches!(refused, Err(StaticsError::Invalid { field, .. }) if field == name));
    }
}

/// What wheels dissipate is the difference of the tensions times the cable that passes; a wheel that sticks
/// dissipates nothing but within its arc, which is short here. The loop is closed by a straight line from its
/// end to its beginning, over which the payload is zero.
#[test]
fn the_payload_gives_what_the_slipping_wheels_dissipate() {
    let mut robot = library("nist-robocrane", 6.0);
    for cable in &mut robot.cables {
        cable.pulley = Some(cdpr_robot::Pulley { radius: 1e-3, axis: cdpr_robot::Vector3::z() });
    }
    let friction = PulleyFriction { friction: 0.05, bearing: 0.02 };
    let cycle = ran(&robot, Pose::at(0.0, 0.0, 0.5), 60.0, 100, friction);
    let stiffness = robot.cables[0].properties.axial_stiffness();
    let mut dissipated = 0.0;
    let mut closed = steps(&cycle);
    closed.push(closed[0]);
    for pair in closed.windows(2) {
        for (a, b) in pair[0].pulleys.iter().zip(&pair[1].pulleys) {
            // Unstrained length that enters the lead of 6 m
            let [before, after] = [a, b].map(|at| 6.0 / (1.0 + at.winch_tension / stiffness));
            let drop = 0.5 * (a.winch_tension - a.tension + b.winch_tension - b.tension);
            dissipated += drop * (after - before);
        }
    }
    println!("{} J of the payload, {dissipated} J of the wheels", cycle.payload_work);
    assert!(dissipated > 0.0);
    accept("V-HYSTERESIS-006", (cycle.payload_work / dissipated - 1.0).abs());
    assert!(cycle.residual().z < 0.0 && cycle.gap() >= cycle.residual().norm());
}

#[test]
fn robots_of_the_library_come_back_the_further_off_the_longer_their_leads() {
    let friction = PulleyFriction { friction: 0.05, bearing: 0.01 };
    for (name, pose) in [("ipanema-3", Pose::at(0.0, 0.0, 1.5)), ("expo2015-lucia", Pose::at(0.0, 0.0, 2.0))]
    {
        let gaps = [0.0, 1.0, 4.0].map(|lead| {
            let cycle = ran(&library(name, lead), pose, 20.0, 10, friction);
            let difference =
                steps(&cycle).iter().flat_map(|step| &step.pulleys).fold(0.0f64, |most, pulley| {
                    let [least, greatest] =
                        [-1.0, 1.0].map(|slip| pulley.tension * friction.ratio(pulley.wrap, slip));
                    assert!((least..=greatest).contains(&pulley.winch_tension), "{pulley:?}");
                    most.max((pulley.winch_tension - pulley.tension).abs())
                });
            println!("{name}, lead {lead} m: {:e} m, {difference} N", cycle.gap());
            assert!(difference > 1.0);
            cycle.gap()
        });
        assert!(gaps[0] < gaps[1] && gaps[1] < gaps[2], "{gaps:?}");
    }
}

/// A law with kinks that the tension crosses on the wheel, against the sum over many short pieces.
#[test]
fn a_kinked_law_on_the_wheel_is_integrated_from_kink_to_kink() {
    let mut robot = library("nist-robocrane", 3.0);
    for cable in &mut robot.cables {
        cable.pulley = Some(cdpr_robot::Pulley { radius: 0.3, axis: cdpr_robot::Vector3::z() });
    }
    let law = crate::elastic_law::law(&[(0.0, 0.5), (200.0, 0.8), (260.0, 1.0), (300.0, 1.3)]);
    let laws = vec![HysteresisLaw::elastic(law.clone()); 6];
    let friction = PulleyFriction { friction: 0.15, bearing: 0.03 };
    let cycle = load_cycle_over_pulleys(&robot, Pose::at(0.2, 0.0, 0.5), &laws, 80.0, 4, friction).unwrap();
    let stiffness = robot.cables[0].properties.axial_stiffness();
    let inverse = |tension: f64| 1.0 / (1.0 + law.scaled_strain(tension) / stiffness);
    for pulley in steps(&cycle).iter().flat_map(|step| &step.pulleys) {
        let (pieces, own) = (20_000, inverse(pulley.tension));
        let arc: f64 = (0..pieces)
            .map(|k| (f64::from(k) + 0.5) / f64::from(pieces) * pulley.wrap)
            .map(|angle| own - inverse(pulley.tension * (pulley.slip * friction.friction * angle).exp()))
            .sum();
        let exact = arc * 0.3 * pulley.wrap / f64::from(pieces) + 3.0 * (own - inverse(pulley.winch_tension));
        assert!((pulley.longer - exact).abs() < 1e-9 * exact.abs() + 1e-15, "{} {exact}", pulley.longer);
    }
}

/// Readings of wheels that slip in both directions, some of them wrong by as much as `noise` [N].
fn readings(wraps: &[f64], truth: PulleyFriction, noise: f64) -> Vec<WinchReading> {
    let at = |k: usize| {
        let (wrap, slip) = (wraps[k % wraps.len()], if k.is_multiple_of(2) { 1.0 } else { -1.0 });
        let tension = 300.0 + 10.0 * (k % 31) as f64;
        // Without a generator: sines of great multiples are spread like noise.
        let error = noise * (1e4 * (k * k) as f64).sin() * std::f64::consts::SQRT_2;
        WinchReading { wrap, tension, winch_tension: tension * truth.ratio(wrap, slip) + error, slip }
    };
    (0..200).map(at).collect()
}

const TRUTH: PulleyFriction = PulleyFriction { friction: 0.04, bearing: 0.015 };

#[test]
fn wraps_that_differ_identify_both_coefficients() {
    let fit = fit_friction(&readings(&[0.5, 1.0, 1.6, 2.3, 2.9], TRUTH, 0.0)).unwrap();
    let [friction, bearing] = fit.coefficients.unwrap();
    assert!((friction.value - TRUTH.friction).abs() < 1e-10 && (bearing.value - TRUTH.bearing).abs() < 1e-10);
    let fit = fit_friction(&readings(&[0.5, 1.0, 1.6, 2.3, 2.9], TRUTH, 1.0)).unwrap();
    let both = fit.coefficients.unwrap();
    for (found, truth) in both.into_iter().zip([TRUTH.friction, TRUTH.bearing]) {
        println!("{} +- {} of {truth}", found.value, found.deviation);
        assert!((found.value - truth).abs() < 3.0 * found.deviation, "{found:?} {truth}");
    }
    assert!((fit.noise - 1.0).abs() < 0.2, "{}", fit.noise);
    assert!(both[0].deviation > 5.0 * fit.combined.deviation);
}

#[test]
fn equal_wraps_identify_one_sum_of_the_coefficients() {
    for noise in [0.0, 1.0] {
        let fit = fit_friction(&readings(&[1.6], TRUTH, noise)).unwrap();
        assert_eq!(fit.coefficients, None);
        // x = μ θ + 2 c sin(θ/2), over the length of its coefficients
        let (along, across) = (1.6, 2.0 * 0.8_f64.sin());
        let exact = (TRUTH.friction * along + TRUTH.bearing * across) / f64::hypot(along, across);
        println!("{:?}, exact {exact}", fit.combined);
        assert!((fit.combined.value - exact).abs() < 3.0 * fit.combined.deviation + 1e-5);
        assert!((fit.combination[0] / fit.combination[1] - along / across).abs() < 2e-3);
    }
}

/// Readings of a load history by the model itself, where its wheels slip.
#[test]
fn the_winches_of_a_load_history_identify_the_friction_that_made_it() {
    let mut robot = library("nist-robocrane", 5.0);
    for (i, cable) in robot.cables.iter_mut().enumerate() {
        let axis = if i.is_multiple_of(2) { 1.0 } else { -1.0 } * cdpr_robot::Vector3::z();
        cable.pulley = Some(cdpr_robot::Pulley { radius: 0.05, axis });
    }
    let cycle = ran(&robot, Pose::at(0.2, 0.1, 0.5), 80.0, 20, TRUTH);
    let slipping = steps(&cycle).into_iter().flat_map(|step| &step.pulleys).filter(|at| at.slip.abs() == 1.0);
    let readings: Vec<_> = slipping
        .map(|at| WinchReading {
            wrap: at.wrap,
            tension: at.tension,
            winch_tension: at.winch_tension,
            slip: at.slip,
        })
        .collect();
    let [friction, bearing] = fit_friction(&readings).unwrap().coefficients.unwrap();
    assert!((friction.value - TRUTH.friction).abs() < 1e-9 && (bearing.value - TRUTH.bearing).abs() < 1e-9);
}

#[test]
fn readings_that_are_no_readings_are_refused() {
    let good = readings(&[1.0, 2.0], TRUTH, 0.0);
    let refused = |change: &dyn Fn(&mut WinchReading), name: &str| {
        let mut readings = good.clone();
        change(&mut readings[4]);
        let found = fit_friction(&readings);
        assert!(matches!(&found, Err(StaticsError::Invalid { field, .. }) if field == name), "{found:?}");
    };
    refused(&|reading| reading.slip = 0.5, "slip[4]");
    refused(&|reading| reading.wrap = 0.0, "wrap[4]");
    refused(&|reading| reading.tension = -1.0, "tension[4]");
    refused(&|reading| reading.winch_tension = f64::NAN, "winch_tension[4]");
    assert!(
        matches!(fit_friction(&good[..2]), Err(StaticsError::Invalid { field, .. }) if field == "readings")
    );
}
