//! Left and right derivatives where cables rest on bounds, against one-sided differences of the models.

use crate::common::robots;
use crate::derivatives::{Case, column};
use cdpr_robot::{Parameter, ParameterLayout, Pose, Robot};
use cdpr_statics::derivatives::AtBound;
use cdpr_statics::{Bound, Derivatives, InverseSolution, Load, WantedPose, derivatives, inverse};
use nalgebra::DVector;
use std::collections::BTreeMap;

/// Derivatives of all outputs with respect to an input on one side, by differences, and what these leave
/// open.
fn one_sided(case: &Case, exact: &Derivatives, input: usize, sign: f64) -> Vec<Option<(DVector<f64>, f64)>> {
    let (now, _) = case.outputs(&exact.deflection).unwrap();
    let mut best: Vec<Option<(DVector<f64>, f64)>> = vec![None; now.len()];
    for scale in [10.0, 1.0, 0.1, 1e-2, 1e-3] {
        let h = sign * scale * case.step(input);
        let at = |h: f64| case.moved(input, h).outputs(&exact.deflection);
        let steps: Result<Vec<_>, _> = [h, 0.5 * h, 0.25 * h, 0.125 * h].into_iter().map(at).collect();
        let Ok(steps) = steps else { continue };
        if steps.iter().any(|(_, regime)| *regime != steps[0].1) {
            continue;
        }
        for (output, best) in best.iter_mut().enumerate() {
            let value = |of: &Vec<(&'static str, Vec<f64>)>| DVector::from_column_slice(&of[output].1);
            let slopes: Vec<_> =
                (0..4).map(|k| (value(&steps[k].0) - value(&now)) * (f64::powi(2.0, k as i32) / h)).collect();
            // Extrapolated in h, in h² and in h³.
            let once: Vec<_> = slopes.windows(2).map(|pair| &pair[1] * 2.0 - &pair[0]).collect();
            let twice: Vec<_> = once.windows(2).map(|pair| (&pair[1] * 4.0 - &pair[0]) / 3.0).collect();
            let thrice = (&twice[1] * 8.0 - &twice[0]) / 7.0;
            let rounding = 1e-13 * value(&now).amax().max(1.0) * 100.0 / h.abs();
            // An error of the value in the middle, common to all slopes, is in the last extrapolation fifteen
            // times as large as in what that corrects; as much again covers those of the other values.
            let open = 30.0 * (&thrice - &twice[1]).amax() + rounding;
            if best.as_ref().is_none_or(|(_, least)| open < *least) {
                *best = Some((thrice, open));
            }
        }
    }
    best
}

/// Checks every input on both sides; returns the names of the one-sided parameters with their cables.
fn check(title: &str, case: &Case) -> BTreeMap<String, Vec<AtBound>> {
    let exact =
        derivatives(&case.robot, WantedPose::at(&case.pose).tension_offsets(&case.offsets), &case.load)
            .unwrap();
    let right = exact.right();
    let (names, _) = case.outputs(&exact.deflection).unwrap();
    let (mut compared, mut worst) = (0, 0.0_f64);
    for input in 0..exact.inputs.count() {
        let one = exact.one_sided.iter().any(|one| one.column == input);
        for (side, sign) in [(&exact, -1.0), (&right, 1.0)] {
            let expected = column(side, input);
            for ((found, exact), (name, _)) in
                one_sided(case, &exact, input, sign).into_iter().zip(expected).zip(&names)
            {
                let Some((found, open)) = found else { continue };
                let (error, scale) = ((&found - &exact).amax(), exact.amax());
                assert!(
                    error <= open + 1e-9 * scale,
                    "{title}, {}: {name}, input {input}, side {sign}, one-sided {one}: error {error:e} of \
                     {scale:e}, open {open:e}",
                    case.robot.name
                );
                if open < 1e-5 * scale {
                    compared += 1;
                    worst = worst.max(error / scale);
                }
            }
        }
    }
    println!(
        "{title}, {}: {} of {} inputs one-sided, {compared} derivatives compared, worst {worst:.1e}",
        case.robot.name,
        exact.one_sided.len(),
        exact.inputs.count()
    );
    assert!(compared > 500, "{compared}");
    let parameters = exact.one_sided.iter().filter_map(|one| {
        let name: Parameter = *exact.inputs.parameters.get(one.column)?;
        Some((name.to_string(), one.cables.clone()))
    });
    parameters.collect()
}

/// Each robot at its pose, with the tensions of the inverse model for low limits, and the cable of the least
/// tension that rests on no limit.
fn cases() -> Vec<(Case, Vec<f64>, usize)> {
    let case = |(mut robot, pose): (Robot, Pose)| {
        robot.tension_limits.min *= 0.1;
        let InverseSolution { tensions, active, .. } = inverse(&robot, &pose, &Load::none()).unwrap();
        let free = (0..tensions.len()).filter(|i| active[*i].is_none());
        let least = free.min_by(|i, j| tensions[*i].total_cmp(&tensions[*j])).unwrap();
        let load = Load::payload(0.2 * robot.platform.mass);
        (Case { offsets: vec![0.0; tensions.len()], robot, pose, load }, tensions, least)
    };
    robots().into_iter().map(case).collect()
}

fn offsets_of_cables_at_bounds(found: &BTreeMap<String, Vec<AtBound>>) -> bool {
    found.iter().all(|(name, cables)| match cables[..] {
        [AtBound { cable, bound: Bound::Min }] => *name == Parameter::TensionOffset(cable).to_string(),
        _ => false,
    })
}

#[test]
fn an_offset_of_a_cable_on_its_least_tension_acts_when_it_grows() {
    let mut robots = 0;
    for (mut case, tensions, least) in cases() {
        // Six cables have no choice.
        if tensions.len() == 6 {
            continue;
        }
        case.robot.tension_limits.min = 1.01 * tensions[least];
        let active = inverse(&case.robot, &case.pose, &Load::none()).unwrap().active;
        let found = check("on its least tension", &case);
        assert!(offsets_of_cables_at_bounds(&found));
        assert_eq!(found.len(), active.iter().flatten().count());
        robots += 1;

        let exact =
            derivatives(&case.robot, WantedPose::at(&case.pose).tension_offsets(&case.offsets), &case.load)
                .unwrap();
        let cable = active.iter().position(Option::is_some).unwrap();
        let dt = ParameterLayout::of(&case.robot).tension_offset(cable);
        assert_eq!(exact.lengths.column(dt).amax(), 0.0);
        assert!(exact.right().lengths[(cable, dt)] < 0.0);
        assert!(exact.right().one_sided.is_empty());
    }
    assert_eq!(robots, 4);
}

#[test]
fn where_a_bound_is_reached_without_a_multiplier_every_input_has_two_sides() {
    for (mut case, tensions, least) in cases() {
        if tensions.len() == 6 {
            continue;
        }
        let on_limit = tensions.contains(&case.robot.tension_limits.min);
        let greatest = (0..tensions.len()).max_by(|i, j| tensions[*i].total_cmp(&tensions[*j])).unwrap();
        let original = case.robot.tension_limits;
        case.robot.tension_limits.max = tensions[greatest];
        // With two cables on their least tension and one that reaches its greatest five are left, which
        // decide nothing.
        if on_limit {
            let refused = derivatives(
                &case.robot,
                WantedPose::at(&case.pose).tension_offsets(&case.offsets),
                &case.load,
            )
            .unwrap_err();
            assert_eq!(refused.kind(), "no_derivative");
            continue;
        }
        let found = check("greatest tension reached exactly", &case);
        assert_eq!(found["mass"], [AtBound { cable: greatest, bound: Bound::Max }]);
        // Both at once, and each may leave its bound or stay.
        case.robot.tension_limits.min = tensions[least];
        let found = check("both reached exactly", &case);
        assert!(found.values().any(|cables| cables.len() == 2));

        case.robot.tension_limits.max = original.max;
        let found = check("least tension reached exactly", &case);
        let cable = vec![AtBound { cable: least, bound: Bound::Min }];
        assert!(found["mass"] == cable && found.values().all(|cables| *cables == cable));
    }
}

#[test]
fn a_set_point_that_is_just_clipped_follows_its_tension_on_one_side() {
    for (mut case, tensions, least) in cases() {
        let limit = &mut case.robot.tension_limits.min;
        if !tensions.contains(limit) {
            *limit = 0.9 * tensions[least];
        }
        case.offsets[least] = *limit - tensions[least];
        let mut found = check("set-point on the limit", &case);
        let cable = vec![AtBound { cable: least, bound: Bound::Min }];
        assert_eq!(found["mass"], cable);
        found.retain(|_, cables| *cables != cable);
        assert!(offsets_of_cables_at_bounds(&found), "{found:?}");
    }
}

#[test]
fn where_no_cable_is_near_a_bound_nothing_is_one_sided() {
    for (case, tensions, _) in cases() {
        let low = case.robot.tension_limits.min;
        let found = check("within all limits", &case);
        // A fully constrained robot has its least tensions on the limit, however low it is.
        let on_limit = tensions.iter().filter(|tension| **tension == low).count();
        assert!(found.len() == on_limit && offsets_of_cables_at_bounds(&found));
    }
}

#[test]
fn where_too_few_cables_are_between_their_bounds_there_is_no_derivative() {
    // In the middle four cables of IPAnema 1 are on their least tension: the other four act on four motions.
    let robot = Robot::from_json(include_str!("../../../data/robots/ipanema-1.json")).unwrap();
    let load = Load::none();
    for height in [0.516, 0.732, 0.948, 1.164] {
        let pose = Pose::at(0.0, 0.0, height);
        let wanted = inverse(&robot, &pose, &load).unwrap();
        assert_eq!(wanted.active.iter().flatten().count(), 4);
        let error = derivatives(&robot, &pose, &Load::payload(1.0)).unwrap_err();
        assert!(error.to_string().contains("do not act on all motions"), "{error}");
    }
    let aside = Pose::at(-0.54, -0.36, 0.732);
    assert_eq!(inverse(&robot, &aside, &load).unwrap().active.iter().flatten().count(), 2);
    assert!(derivatives(&robot, &aside, &Load::payload(1.0)).is_ok());
}
