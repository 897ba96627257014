//! Which tensions the inverse model chooses, within which limits, and which of them are named.

use crate::common::{caroca, cogiro, fast, ipanema, stadium};
use crate::pulleys::led;
use cdpr_robot::{CableEnd, Pose, Robot, TensionReference, Vector3};
use cdpr_statics::hysteresis::{HysteresisLaw, load_cycle};
use cdpr_statics::limits::{Limit, OutOfLimits, in_words, limits_at, out_of_limits};
use cdpr_statics::stiffness::stiffness_at;
use cdpr_statics::{
    Bound, InverseSolution, Load, StaticsError, WantedPose, deflection, inverse, is_feasible,
    set_point_lengths,
};

/// Robots of every kind at a pose that they hold, with a tension above those of least norm.
fn robots() -> Vec<(Robot, Pose, f64)> {
    let lawful = Robot::from_json(include_str!("../../../data/robots/caroca-law.json")).unwrap();
    vec![
        (caroca(), Pose::at(0.6, -0.4, 1.4), 900.0),
        (lawful, Pose::at(0.6, -0.4, 1.4), 900.0),
        (cogiro(), Pose::at(0.5, 1.0, 2.0), 1200.0),
        (ipanema(), Pose::at(0.3, 0.2, 1.5), 600.0),
        (stadium(), Pose::at(-8.0, -4.0, 10.0), 1500.0),
    ]
}

fn held(robot: &Robot, pose: &Pose) -> InverseSolution {
    let found = inverse(robot, pose, &Load::none()).unwrap();
    let largest = found.tensions.iter().copied().fold(0.0, f64::max);
    assert!(found.stationarity < 1e-9 * largest && found.residual.force < 1e-9 * largest, "{found:?}");
    found
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

fn largest(values: &[f64]) -> usize {
    (0..values.len()).max_by(|a, b| values[*a].total_cmp(&values[*b])).unwrap()
}

#[test]
fn tensions_come_nearer_to_those_that_the_robot_prefers() {
    for (mut robot, pose, tension) in robots() {
        let least_norm = held(&robot, &pose);
        let n = robot.cables.len();
        let zeros = vec![0.0; n];
        let steps = (0..n).map(|i| tension * (1.0 + 0.05 * i as f64)).collect();
        for preferred in
            [TensionReference::All(tension), TensionReference::Each(steps), TensionReference::MID]
        {
            robot.tension_reference = Some(preferred);
            let reference = robot.reference();
            let found = held(&robot, &pose);
            assert_eq!(
                found,
                inverse(&robot, WantedPose::at(&pose).tension_reference(&reference), &Load::none()).unwrap()
            );
            let (before, after) =
                (distance(&least_norm.tensions, &reference), distance(&found.tensions, &reference));
            assert!(after < before, "{}: {before} N, now {after} N", robot.name);
            let moved = distance(&found.tensions, &least_norm.tensions);
            assert!(moved > 0.01 * distance(&least_norm.tensions, &zeros), "{}: {moved} N", robot.name);
            assert!(distance(&found.tensions, &zeros) > distance(&least_norm.tensions, &zeros));
            // A reference of the call takes the place of the robot's.
            let again =
                inverse(&robot, WantedPose::at(&pose).tension_reference(&zeros), &Load::none()).unwrap();
            assert_eq!(again.tensions, least_norm.tensions);
        }
        let middle = 0.5 * (robot.tension_limits.min + robot.tension_limits.max);
        assert_eq!(robot.reference(), vec![middle; n]);
    }
    // Six cables have no choice.
    let pose = Pose::at(0.0, 0.0, 140.0);
    let preferring = Robot { tension_reference: Some(TensionReference::MID), ..fast() };
    let (free, chosen) = (held(&fast(), &pose).tensions, held(&preferring, &pose).tensions);
    assert!(distance(&free, &chosen) < 1e-9 * free[0], "{free:?} {chosen:?}");
}

#[test]
fn all_models_start_from_the_tensions_that_the_robot_prefers() {
    for (mut robot, pose, tension) in robots() {
        robot.tension_reference = Some(TensionReference::All(tension));
        let (found, n) = (held(&robot, &pose), robot.cables.len());
        let same = |tensions: &[f64], name: &str| {
            let error = distance(tensions, &found.tensions) / distance(&found.tensions, &vec![0.0; n]);
            assert!(error < 1e-7, "{}: {name} {error:e}", robot.name);
        };
        let load = Load::payload(0.1 * robot.platform.mass);
        same(&deflection(&robot, &pose, &load).unwrap().unloaded.equilibrium.tensions(), "deflection");
        same(&stiffness_at(&robot, pose, &Load::none()).unwrap().equilibrium.tensions(), "stiffness");
        let lengths = set_point_lengths(&robot, pose).unwrap();
        assert!(distance(&lengths, &found.lengths) < 1e-9 * found.lengths[0], "{}", robot.name);
        if let Some(law) = robot.cables[0].properties.law.clone() {
            let laws = vec![HysteresisLaw::elastic(law); n];
            let cycle = load_cycle(&robot, pose, &laws, 50.0, 2).unwrap();
            same(&cycle.loading[0].solution.equilibrium.tensions(), "load cycle");
        }
    }
}

#[test]
fn a_cable_keeps_its_own_limits_and_the_others_keep_the_robots() {
    for (mut robot, pose, tension) in robots() {
        robot.tension_reference = Some(TensionReference::All(tension));
        let free = held(&robot, &pose);
        let high = largest(&free.tensions);
        let low = largest(&free.tensions.iter().map(|t| -t).collect::<Vec<_>>());
        let (max, min) = (0.999 * free.tensions[high], 1.001 * free.tensions[low]);
        robot.cables[high].tension_limits.max = Some(max);
        robot.cables[low].tension_limits.min = Some(min);
        robot.validate().unwrap();
        let found = held(&robot, &pose);
        assert_eq!((found.active[high], found.tensions[high]), (Some(Bound::Max), max), "{}", robot.name);
        assert_eq!((found.active[low], found.tensions[low]), (Some(Bound::Min), min), "{}", robot.name);
        let limits = limits_at(&robot, &pose).unwrap();
        for (i, limits) in limits.iter().enumerate() {
            let own = [i == low, i == high];
            assert_eq!(limits.min, if own[0] { min } else { robot.tension_limits.min });
            assert_eq!(limits.max, if own[1] { max } else { robot.tension_limits.max });
        }
        // Set-points are kept within them, too.
        let mut offsets = vec![0.0; robot.cables.len()];
        (offsets[high], offsets[low]) = (0.5 * max, -0.5 * min);
        let unmoved = set_point_lengths(&robot, pose).unwrap();
        let wound = set_point_lengths(&robot, WantedPose::at(&pose).tension_offsets(&offsets)).unwrap();
        assert!(distance(&wound, &unmoved) < 1e-12 * wound[0], "{}", robot.name);
        // No pose is held by limits that leave no choice.
        robot.cables[high].tension_limits.max = Some(robot.tension_limits.min * 1.01);
        let tight = TensionReference::All(tension);
        robot.tension_reference = Some(tight);
        match inverse(&robot, &pose, &Load::none()) {
            Ok(found) => assert!(found.tensions[high] <= robot.tension_limits.min * 1.01, "{}", robot.name),
            Err(error) => {
                assert!(["infeasible_tension", "tension_too_small"].contains(&error.kind()), "{error}");
            }
        }
    }
}

#[test]
fn a_greatest_tension_at_the_exit_point_is_kept_there_also_where_it_is_on_a_pulley() {
    let led = |(robot, pose, tension): (Robot, Pose, f64)| (led(robot, 0.1, 3.0), pose, tension);
    for (mut robot, pose, tension) in robots().into_iter().chain(robots().into_iter().map(led)) {
        robot.tension_reference = Some(TensionReference::All(tension));
        let free = held(&robot, &pose);
        let exits = free.equilibrium.exit_tensions(&robot, &free.lengths);
        let high = largest(&exits);
        let max = 0.99 * exits[high];
        let own = &mut robot.cables[high].tension_limits;
        (own.max, own.max_at) = (Some(max), Some(CableEnd::Exit));
        let found = held(&robot, &pose);
        let exit = found.equilibrium.exit_tensions(&robot, &found.lengths)[high];
        assert_eq!(found.active[high], Some(Bound::Max), "{}", robot.name);
        assert!((exit - max).abs() < 1e-11 * max, "{}: {exit} N, not {max} N", robot.name);
        // At the platform it is the weight of the cable over the height that is missing, nearly.
        let weight = robot.cable(high).weight_per_length * robot.span(&pose, high).z;
        let difference = found.tensions[high] - exit;
        let on_pulley = robot.cables[high].pulley.is_some();
        assert!(
            on_pulley || (difference - weight).abs() < 2e-2 * weight.abs(),
            "{}: {difference} N",
            robot.name
        );
        assert!(!named(&robot, &found).iter().any(OutOfLimits::is_too_much), "{}", robot.name);
    }
}

/// The robot of the issue: 141 kN at the platform are 153 kN at the towers.
#[test]
fn a_telescope_is_refused_for_its_towers_though_its_platform_would_bear_it() {
    let (mut robot, pose) = (fast(), Pose::at(0.0, 0.0, 140.0));
    let free = held(&robot, &pose);
    let exit = free.equilibrium.exit_tensions(&robot, &free.lengths)[0];
    println!("{:.0} N at the platform, {exit:.0} N at the tower", free.tensions[0]);
    assert!((free.tensions[0] - 141_186.8).abs() < 0.1 && (exit - 153_395.1).abs() < 0.1);
    let cable = robot.cable(0);
    let known = |t: f64| t + t * t / (2.0 * cable.axial_stiffness);
    let weight = cable.weight_per_length * robot.span(&pose, 0).z;
    assert!((known(free.tensions[0]) - known(exit) - weight).abs() < 1e-12 * exit);
    for (max, end, feasible) in [
        (142e3, CableEnd::Anchor, true),
        (142e3, CableEnd::Exit, false),
        (exit * (1.0 + 1e-6), CableEnd::Exit, true),
        (exit * (1.0 - 1e-6), CableEnd::Exit, false),
    ] {
        (robot.tension_limits.max, robot.max_at) = (max, end);
        let found = inverse(&robot, &pose, &Load::none());
        assert_eq!(found.is_ok(), feasible, "{max} {end:?}: {found:?}");
        if let Err(error) = found {
            assert_eq!(error.kind(), "infeasible_tension");
        }
    }
    // The towers bear less than the weight of the cable below them.
    (robot.tension_limits.max, robot.tension_limits.min) = (21e3, 20e3);
    match inverse(&robot, &pose, &Load::none()) {
        Err(StaticsError::ExitLimit { index: 0, exit, depth, max, min }) => {
            assert_eq!((exit, min), (21e3, 20e3));
            assert!((depth - 140.0).abs() < 1e-9 && (max - (21e3 + weight)).abs() < 20.0, "{max}");
        }
        other => panic!("{other:?}"),
    }
}

fn named(robot: &Robot, found: &InverseSolution) -> Vec<OutOfLimits> {
    out_of_limits(robot, &found.lengths, &[&found.equilibrium])
}

#[test]
fn a_tension_is_named_by_the_most_serious_limit_that_it_passes_at_either_end() {
    let mut all = robots();
    all.push((fast(), Pose::at(0.0, 0.0, 140.0), 0.0));
    for (mut robot, pose, _) in all {
        let found = held(&robot, &pose);
        assert_eq!(named(&robot, &found), [], "{}", robot.name);
        let exits = found.equilibrium.exit_tensions(&robot, &found.lengths);
        let drops: Vec<_> = exits.iter().zip(&found.tensions).map(|(exit, t)| exit - t).collect();
        let (i, name) = (largest(&drops), robot.name.clone());
        let (t, exit) = (found.tensions[i], exits[i]);
        assert!(exit > t, "{name}");
        let mut named = |max: f64, max_at: CableEnd, breaking: Option<f64>| {
            let own = &mut robot.cables[i].tension_limits;
            (own.max, own.max_at) = (Some(max), Some(max_at));
            robot.cables[i].properties.breaking_force = breaking;
            let named = named(&robot, &found);
            assert!(named.iter().all(|one| one.cable == i), "{name}: {named:?}");
            named.first().map(|one| (one.limit, one.end, one.tension, one.is_too_much()))
        };
        use CableEnd::{Anchor, Exit};
        let (between, below, above) = (0.5 * (t + exit), 0.9 * t, 1.1 * exit);
        let near = |found: Option<(Limit, CableEnd, f64, bool)>, limit, end, tension: f64, too_much| {
            let (a, b, value, c) = found.unwrap();
            assert_eq!((a, b, c), (limit, end, too_much), "{name}");
            assert!((value - tension).abs() < 1e-9 * tension, "{name}");
        };
        near(named(below, Anchor, None), Limit::Max, Anchor, t, true);
        near(named(below, Exit, None), Limit::Max, Exit, exit, true);
        near(named(between, Exit, None), Limit::Max, Exit, exit, true);
        near(named(between, Anchor, None), Limit::MaxElsewhere, Exit, exit, false);
        near(named(above, Anchor, Some(between)), Limit::BreakingForce, Exit, exit, true);
        near(named(below, Anchor, Some(below)), Limit::BreakingForce, Anchor, t, true);
        assert_eq!(named(above, Exit, Some(above)), None, "{name}");
    }
    // A slack cable is worth knowing.
    let (mut robot, pose) = (caroca(), Pose::at(0.0, 0.0, 1.75));
    let found = held(&robot, &pose);
    robot.cables[4].tension_limits.min = Some(2.0 * found.tensions[4]);
    let named = named(&robot, &found);
    assert_eq!((named.len(), named[0].cable, named[0].limit), (1, 4, Limit::Min));
    assert!(!named[0].is_too_much());
    let words = named[0].to_string();
    assert!(
        words.starts_with("cable 5: its tension of ") && words.contains("below tension_limits.min"),
        "{words}"
    );
}

#[test]
fn cables_that_pass_one_limit_have_one_line_and_a_tension_never_reads_like_its_limit() {
    let named = |cable: usize, tension: f64, limit: Limit, value: f64| OutOfLimits {
        cable,
        end: CableEnd::Anchor,
        tension,
        limit,
        value,
    };
    let slack: Vec<_> = (4..8).map(|cable| named(cable, 1.0 - 1.5e-4, Limit::Min, 1.0)).collect();
    assert_eq!(in_words(&slack), ["cables 5 to 8: tension is up to 0.00015 N below tension_limits.min, 1 N"]);
    assert_eq!(slack[0].to_string(), "cable 5: its tension is 0.00015 N below tension_limits.min, 1 N");
    let broken = [(0, 720.0), (2, 750.0), (5, 710.0)].map(|(i, t)| named(i, t, Limit::BreakingForce, 700.0));
    let both = [&broken[..], &slack[..1]].concat();
    let words = "cables 1, 3, 6: tension up to 750.000 N is above its breaking force, 700 N";
    assert_eq!(in_words(&both), [words, &slack[0].to_string()]);
    assert_eq!(
        in_words(&broken[..1]),
        ["cable 1: its tension of 720.000 N is above its breaking force, 700 N"]
    );
}

#[test]
fn a_breaking_force_limits_tensions_as_a_greatest_one_does() {
    for (robot, pose, _) in robots() {
        let most = held(&robot, &pose).tensions.iter().copied().fold(0.0, f64::max);
        let poses: Vec<Pose> = (0..9)
            .map(|k| pose.moved(Vector3::new(0.01 * f64::from(k), 0.0, 0.0), Vector3::zeros()))
            .collect();
        let least = robot.limits(0).min;
        for force in [1.1 * most, 0.99 * most, 0.9 * most, 0.5 * most].map(|force| force.max(1.1 * least)) {
            let (mut limited, mut breaking) = (robot.clone(), robot.clone());
            for cables in [&mut limited.cables, &mut breaking.cables] {
                cables.iter_mut().for_each(|cable| cable.properties.breaking_force = None);
            }
            limited.tension_limits.max = force;
            breaking.cables.iter_mut().for_each(|cable| cable.properties.breaking_force = Some(force));
            let [found, known] = [&breaking, &limited].map(|robot| inverse(robot, &poses[..], &Load::none()));
            for (found, known) in found.into_iter().zip(known) {
                let tensions = |of: Result<InverseSolution, _>| of.map(|held| held.tensions).ok();
                assert_eq!(tensions(found), tensions(known), "{} {force}", robot.name);
            }
            let feasible = [&breaking, &limited].map(|robot| is_feasible(robot, &pose, &Load::none()).ok());
            assert_eq!(feasible[0], feasible[1]);
        }
    }
}
