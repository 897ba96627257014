//! A payload that comes and goes, on cables with hysteresis.

use crate::common::caroca;
use crate::elastic_law::law;
use cdpr_evidence::accept;
use cdpr_robot::{Pose, Pulley, Robot, Vector3};
use cdpr_statics::hysteresis::{HysteresisLaw, Unloading, load_cycle};
use cdpr_statics::{Load, StaticsError, deflection};

/// One law for all eight cables.
fn curves(loading: &[(f64, f64)], unloading: &[(f64, f64)]) -> Vec<HysteresisLaw> {
    let law = HysteresisLaw {
        loading: law(loading),
        unloading: law(unloading),
        turning_tension: 3087.0,
        unloading_from: Unloading::SameTension,
    };
    vec![law; 8]
}

const POSE: [f64; 3] = [0.0, 0.0, 1.75];

fn pose() -> Pose {
    Pose::at(POSE[0], POSE[1], POSE[2])
}

#[test]
fn without_hysteresis_the_platform_comes_back_and_nothing_is_lost() {
    let segments = [(0.0, 0.8), (600.0, 1.0)];
    let cycle = load_cycle(&caroca(), pose(), &curves(&segments, &segments), 50.0, 20).unwrap();
    assert!(cycle.residual().norm() < 1e-12, "{}", cycle.residual());
    assert!(cycle.payload_work.abs() < 1e-10 && cycle.dissipated.iter().all(|energy| energy.abs() < 1e-12));
}

#[test]
fn the_first_way_is_the_deflection_of_the_loading_curve() {
    let law = curves(&[(0.0, 0.8), (600.0, 1.0)], &[(0.0, 1.1)]);
    let cycle = load_cycle(&caroca(), pose(), &law, 50.0, 4).unwrap();
    let mut robot = caroca();
    robot.cables.iter_mut().for_each(|cable| cable.properties.law = Some(law[0].loading.clone()));
    let once = deflection(&robot, &pose(), &Load::payload(50.0)).unwrap();
    // The parts of a cable below the tension of its middle count as unloading: a few per thousand of half of
    // it.
    assert!((cycle.deflection() - once.displacement()).norm() < 5e-3 * once.magnitude());
}

#[test]
fn a_stiffer_way_back_leaves_the_platform_below_and_dissipates_the_loops_of_its_cables() {
    let law = curves(&[(0.0, 0.8), (600.0, 0.9)], &[(0.0, 1.1)]);
    let cycle = load_cycle(&caroca(), pose(), &law, 50.0, 200).unwrap();
    let (gone, residual) = (cycle.deflection().z, cycle.residual().z);
    println!("{gone:e} m down, {residual:e} m stay");
    assert!(gone < -1e-3 && residual < 0.05 * gone, "{gone} {residual}");
    let loops: f64 = cycle.dissipated.iter().sum();
    println!("payload {:e} J, loops {loops:e} J", cycle.payload_work);
    assert!(cycle.dissipated.iter().all(|energy| *energy > 0.0));
    // Second order in how much tensions vary along a cable by its weight, 4 N of 600 N.
    accept("V-HYSTERESIS-001", (cycle.payload_work / loops - 1.0).abs());
}

/// CAROCA hung up, over leads and pulleys whose axes may be tilted: the tension in them is that at the top,
/// and a whole length begins at the winch.
#[test]
fn over_leads_and_pulleys_the_payload_gives_what_the_loops_of_the_cables_dissipate() {
    let law = curves(&[(0.0, 0.8), (600.0, 0.9)], &[(0.0, 1.1)]);
    let mut heavy = caroca();
    heavy.cables.iter_mut().for_each(|cable| cable.properties.linear_density = 0.3);
    let residual = |lead: f64, axis: Option<Vector3<f64>>| {
        let mut robot = heavy.clone();
        for cable in &mut robot.cables {
            cable.lead = lead;
            cable.pulley = axis.map(|axis| Pulley { radius: 0.05, axis });
        }
        let cycle = load_cycle(&robot, pose(), &law, 50.0, 200).unwrap();
        let loops: f64 = cycle.dissipated.iter().sum();
        let off = cycle.payload_work / loops - 1.0;
        println!("lead {lead} m, axis {axis:?}: {off:e}, {:e} m stay", cycle.residual().z);
        accept("V-HYSTERESIS-002", off.abs());
        cycle.residual().z
    };
    residual(0.0, None);
    for lead in [2.0, 6.0, 12.0] {
        residual(lead, None);
        residual(lead, Some(Vector3::z()));
    }
    residual(6.0, Some(Vector3::new(0.1, -0.05, 1.0).normalize()));
}

/// `data/reference/robots/suspended-leads.json`: 75 kg on eight cables with leads of 12 m. The residual is
/// that of every part of a cable turning back at its own tension, to second order in how the tension varies.
#[test]
fn a_suspended_robot_with_long_leads_keeps_its_energy() {
    let file = include_str!("../../../data/reference/robots/suspended-leads.json");
    let robot = Robot::from_json(file).unwrap();
    let law = curves(&[(0.0, 0.7), (500.0, 0.8)], &[(0.0, 1.1)]);
    let cycle = load_cycle(&robot, Pose::at(0.0, 0.0, 1.5), &law, 40.0, 50).unwrap();
    let loops: f64 = cycle.dissipated.iter().sum();
    println!("{:e} of {loops:e} J, {:e} m", cycle.payload_work, cycle.residual().z);
    assert!((cycle.payload_work / loops - 1.0).abs() < 5e-4, "{} {loops}", cycle.payload_work);
    for (i, tensions) in cycle.tensions.iter().enumerate() {
        let equilibrium = &cycle.loading[0].solution.equilibrium;
        let exit = equilibrium.exit_tensions(&robot, &cycle.lengths)[i];
        let anchor = equilibrium.tensions()[i];
        // Two thirds of the cable or more lie in the lead and on the pulley, at the exit's tension.
        assert!(tensions[0] > anchor + 0.8 * (exit - anchor) && tensions[0] < exit, "cable {i}");
    }
}

#[test]
fn a_way_back_from_the_turning_point_begins_as_the_record_does() {
    // Stiff just below 3087 N, soft below 2900 N: cables around 600 N meet the stiff part only if the curve
    // moves with them.
    let soft = curves(&[(0.0, 0.8)], &[(0.0, 0.7), (2900.0, 1.2)]);
    let mut moved = soft.clone();
    moved.iter_mut().for_each(|law| law.unloading_from = Unloading::TurningPoint);
    let [soft, stiff] = [soft, moved].map(|law| load_cycle(&caroca(), pose(), &law, 50.0, 20).unwrap());
    assert!(soft.residual().z > 0.0 && soft.payload_work < 0.0);
    assert!(stiff.residual().z < 0.0 && stiff.payload_work > 0.0);
}

#[test]
fn weightless_cables_that_the_payload_makes_slack_come_back() {
    let mut robot = Robot::from_json(include_str!("../../../data/reference/robots/ipanema.json")).unwrap();
    robot.cables.iter_mut().for_each(|cable| cable.properties.linear_density = 0.0);
    let segments = [(0.0, 0.8), (600.0, 1.0)];
    let pose = Pose::at(0.2, 0.1, 1.0);
    for unloading_from in [Unloading::SameTension, Unloading::TurningPoint] {
        let laws: Vec<_> = curves(&segments, &segments)
            .into_iter()
            .map(|law| HysteresisLaw { unloading_from, turning_tension: 0.0, ..law })
            .collect();
        let cycle = load_cycle(&robot, pose, &laws, 400.0, 20).unwrap();
        let slack = cycle.tensions.iter().filter(|[_, loaded, _]| *loaded == 0.0).count();
        println!("{slack} cables slack under the payload");
        assert!(slack > 0);
        assert!(cycle.tensions.iter().all(|[before, _, after]| (before - after).abs() < 1e-6));
        assert!(cycle.residual().norm() < 1e-10, "{}", cycle.residual());
        assert!(cycle.dissipated.iter().all(|energy| energy.abs() < 1e-9), "{:?}", cycle.dissipated);
    }
}

#[test]
fn a_cycle_of_nothing_is_refused() {
    let law = curves(&[(0.0, 1.0)], &[(0.0, 1.0)]);
    for (payload, steps, name) in [(0.0, 1, "payload"), (f64::NAN, 1, "payload"), (50.0, 0, "steps")] {
        let refused = load_cycle(&caroca(), pose(), &law, payload, steps);
        assert!(matches!(refused, Err(StaticsError::Invalid { field, .. }) if field == name));
    }
    let refused = load_cycle(&caroca(), pose(), &law[1..], 50.0, 1);
    assert!(matches!(refused, Err(StaticsError::Invalid { field, .. }) if field == "laws"));
}
