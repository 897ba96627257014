//! Single samples: the residual wrench, allocations, and what is refused.

use crate::common::{follow, loaded, robot};
use cdpr_observer::{Alarm, CableState, LoadObserver, ObserverSetting};
use cdpr_robot::{Plane, Pose, Robot, Vector3};
use cdpr_statics::{Load, StaticsError, deflection, inverse};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use std::hint::black_box;

#[test]
fn the_residual_wrench_is_the_weight_of_the_load_at_its_centre() {
    for (name, start, mass) in [
        ("caroca", [0.2, -0.1, 1.75], 5.0),
        ("ipanema-3", [0.2, 0.1, 1.25], 5.0),
        ("fast", [2.0, 1.0, 140.0], 500.0),
        ("four-cables", [0.3, 0.2, 1.5], 5.0),
    ] {
        let nominal = robot(name);
        let center = Vector3::new(0.1, -0.05, 0.2);
        let truth = loaded(&nominal, mass, center, 1.0);
        let path = follow(&nominal, &truth, start, [1e-3, if name == "fast" { 1e-3 } else { 0.05 }]);
        let setting = ObserverSetting::new(nominal.cables.len(), 0.2, 100.0 * mass, 1.0);
        let mut observer =
            LoadObserver::new(&nominal, &path.lengths[0], &Pose::at(start[0], start[1], start[2]), setting)
                .unwrap();
        let mut last = None;
        for (lengths, tensions) in path.lengths.iter().zip(&path.tensions).take(30) {
            last = Some(observer.update(lengths, tensions).unwrap());
        }
        let wrench = last.unwrap().wrench;
        let lever = path.poses[29].rotation * (nominal.platform.center_of_mass + center);
        let weight = mass * nominal.gravity.vector();
        assert!((wrench.force - weight).norm() < 5e-3 * weight.norm(), "{name}: {}", wrench.force);
        let estimate = observer.estimate();
        assert!((estimate.payload - mass).abs() < 1e-3 * mass, "{name}: {estimate:?}");
        if nominal.cables.len() < 6 {
            // The tilt of the platform, and with it the arms of the cables, follow from the centre too
            // weakly.
            continue;
        }
        assert!((wrench.moment - lever.cross(&weight)).norm() < 5e-3 * weight.norm(), "{name}: {wrench:?}");
        for k in 0..2 {
            let found = estimate.center[k].unwrap() - nominal.platform.center_of_mass[k];
            assert!((found - center[k]).abs() < 1e-3, "{name}: {estimate:?}");
        }
    }
}

/// A table carries the weight of what moves on it, and no cable does.
#[test]
fn what_a_plane_holds_is_no_load() {
    let mut table = robot("cogiro");
    table.plane = Some(Plane::Xy);
    table.cables.iter_mut().for_each(|cable| (cable.exit_point.z, cable.anchor_point.z) = (0.0, 0.0));
    let pose = Pose::at(0.4, -0.2, 0.0);
    let held = inverse(&table, &pose, &Load::none()).unwrap();
    let setting = ObserverSetting::new(table.cables.len(), 0.2, 10.0, 1.0);
    let mut observer = LoadObserver::new(&table, &held.lengths, &pose, setting).unwrap();
    let found = observer.update(&held.lengths, &held.tensions).unwrap().wrench;
    assert!(found.force.norm() < 1e-3 && found.moment.norm() < 1e-3, "{found:?}");
    assert_eq!((found.force.z, found.moment.x, found.moment.y), (0.0, 0.0, 0.0));
}

#[test]
fn nothing_is_allocated_by_a_sample() {
    for (name, start) in [
        ("caroca", [0.2, -0.1, 1.75]),
        ("ipanema-3", [0.2, 0.1, 1.25]),
        ("four-cables", [0.3, 0.2, 1.5]),
        ("fast", [2.0, 1.0, 140.0]),
    ] {
        let nominal = robot(name);
        let path = follow(
            &nominal,
            &loaded(&nominal, 5.0, Vector3::zeros(), 1.0),
            start,
            [1e-3, if name == "fast" { 1e-3 } else { 0.05 }],
        );
        let setting = ObserverSetting {
            length_std: 1e-5,
            modulus_std: 0.05,
            ..ObserverSetting::new(nominal.cables.len(), 5.0, 20.0, 0.1)
        };
        let mut observer = LoadObserver::new(&nominal, &path.lengths[0], &path.poses[0], setting).unwrap();
        let mut far = path.lengths[0].clone();
        far.iter_mut().for_each(|length| *length *= 0.01);
        let allocated = allocation_counter::measure(|| {
            for (k, (lengths, tensions)) in path.lengths.iter().zip(&path.tensions).enumerate() {
                let observed = if k < 10 {
                    observer.tare(lengths, tensions).unwrap()
                } else {
                    observer.update(lengths, tensions).unwrap()
                };
                assert!(observed.converged);
                black_box((observer.estimate(), observer.cable(0)));
            }
            // Lengths that no equilibrium fits nearby.
            assert!(!observer.update(&far, &path.tensions[0]).unwrap().converged);
        });
        assert_eq!(allocated.count_total, 0, "{name}");
        assert!(observer.update(&path.lengths[0], &path.tensions[0]).unwrap().converged);
    }
}

#[test]
fn a_slack_cable_of_the_model_is_no_alarm_and_a_changed_load_is_one() {
    let nominal = robot("caroca");
    let path = follow(&nominal, &nominal, [0.2, -0.1, 1.75], [0.0; 2]);
    let heavy = follow(&nominal, &loaded(&nominal, 8.0, Vector3::zeros(), 1.0), [0.2, -0.1, 1.75], [0.0; 2]);
    let setting = ObserverSetting::new(8, 2.0, 20.0, 0.1);
    let mut observer = LoadObserver::new(&nominal, &path.lengths[0], &path.poses[0], setting).unwrap();
    let mut slack = path.lengths[0].clone();
    for _ in 0..50 {
        assert_eq!(observer.update(&slack, &path.tensions[0]).unwrap().alarm, None);
    }
    let alarms: Vec<_> = (0..6).map(|_| observer.update(&slack, &heavy.tensions[0]).unwrap().alarm).collect();
    assert_eq!(alarms, [None, None, Some(Alarm::LoadChanged), None, None, None]);
    assert!((observer.estimate().payload - 8.0).abs() < 0.5);
    // A cable that is paid out is slack in the model, too.
    slack[1] += 0.2;
    let truth = loaded(&nominal, 8.0, Vector3::zeros(), 1.0);
    let found = cdpr_statics::direct(
        &truth,
        &slack,
        &cdpr_statics::Load::none(),
        cdpr_statics::DirectStart::Pose(&heavy.poses[0]),
    );
    let tensions = found.unwrap().equilibrium.tensions();
    for _ in 0..5 {
        assert_eq!(observer.update(&slack, &tensions).unwrap().alarm, None);
    }
    assert_eq!(observer.cable(1), Some(CableState::Slack));
    assert_eq!(observer.cable(8), None);
}

#[test]
fn a_load_that_is_there_from_the_first_sample_is_no_alarm() {
    // Where its cables become slack, or lose their sag, derivatives at no load say little of a load.
    let wall = Robot::from_json(include_str!("../../../data/reference/robots/wall.json")).unwrap();
    let setting = ObserverSetting::new(4, 1.5, 13.0, 0.1);
    for mass in [2.0, 3.0, 5.0] {
        let found = deflection(&wall, &Pose::at(1.5, 0.0, 1.2), &Load::payload(mass)).unwrap();
        let (lengths, tensions) = (&found.lengths, found.loaded.equilibrium.tensions());
        for seed in 0..60 {
            let mut rng = ChaCha8Rng::seed_from_u64(seed);
            let mut observer =
                LoadObserver::new(&wall, lengths, &Pose::at(1.5, 0.0, 1.2), setting.clone()).unwrap();
            for k in 0..30 {
                let read: Vec<f64> =
                    tensions.iter().map(|of| of + 1.5 * rng.sample::<f64, _>(StandardNormal)).collect();
                let observed = observer.update(lengths, &read).unwrap();
                assert_eq!(observed.alarm, None, "{mass} kg, seed {seed}, sample {k}");
            }
            let estimate = observer.estimate();
            assert!((estimate.payload - mass).abs() < 5.0 * estimate.payload_std, "{estimate:?}");
        }
    }
}

#[test]
fn a_memory_bounds_what_the_samples_say_of_each_unknown() {
    let nominal = robot("caroca");
    let path = follow(&nominal, &nominal, [0.2, -0.1, 1.75], [0.0; 2]);
    let stds = |memory: f64, samples: usize| {
        let setting =
            ObserverSetting { memory, modulus_std: 0.05, ..ObserverSetting::new(8, 5.0, 20.0, 0.1) };
        let mut observer = LoadObserver::new(&nominal, &path.lengths[0], &path.poses[0], setting).unwrap();
        for _ in 0..samples {
            observer.update(&path.lengths[0], &path.tensions[0]).unwrap();
        }
        let estimate = observer.estimate();
        [estimate.payload_std, estimate.modulus_std]
    };
    // Geometric weights with the sum `memory`, as of as many samples without forgetting.
    for (fading, lasting) in stds(200.0, 5000).iter().zip(stds(f64::INFINITY, 200)) {
        assert!((fading / lasting - 1.0).abs() < 1e-3, "{fading} {lasting}");
    }
}

#[test]
fn what_is_no_input_is_refused_by_name() {
    let nominal = robot("caroca");
    let path = follow(&nominal, &nominal, [0.2, -0.1, 1.75], [0.0; 2]);
    let (lengths, tensions, pose) = (&path.lengths[0], &path.tensions[0], &path.poses[0]);
    let setting = ObserverSetting::new(8, 2.0, 20.0, 0.1);
    let refused =
        |setting: ObserverSetting, name: &str| match LoadObserver::new(&nominal, lengths, pose, setting) {
            Err(StaticsError::Invalid { field, .. }) => assert_eq!(field, name),
            other => panic!("{name}: {:?}", other.map(|_| ())),
        };
    refused(ObserverSetting { tension_std: vec![2.0; 7], ..setting.clone() }, "tension_std");
    refused(ObserverSetting { tension_std: vec![0.0; 8], ..setting.clone() }, "tension_std[0]");
    refused(ObserverSetting { length_std: f64::NAN, ..setting.clone() }, "length_std");
    refused(ObserverSetting { payload_std: -1.0, ..setting.clone() }, "payload_std");
    refused(ObserverSetting { center_std: -1.0, ..setting.clone() }, "center_std");
    refused(ObserverSetting { modulus_std: 0.5, ..setting.clone() }, "modulus_std");
    refused(ObserverSetting { memory: 0.5, ..setting.clone() }, "memory");
    refused(ObserverSetting { false_alarm: 0.0, ..setting.clone() }, "false_alarm");
    refused(ObserverSetting { consecutive: 0, ..setting.clone() }, "consecutive");
    let mut observer = LoadObserver::new(&nominal, lengths, pose, setting).unwrap();
    let before = observer.estimate();
    for (lengths, tensions, name) in [
        (&lengths[..7], &tensions[..], "lengths"),
        (&lengths[..], &tensions[..7], "tensions"),
        (&[f64::NAN; 8][..], &tensions[..], "lengths[0]"),
        (&lengths[..], &[f64::INFINITY; 8][..], "tensions[0]"),
    ] {
        match observer.update(lengths, tensions) {
            Err(StaticsError::Invalid { field, .. }) => assert_eq!(field, name),
            other => panic!("{name}: {other:?}"),
        }
    }
    assert_eq!(observer.estimate(), before);
}
