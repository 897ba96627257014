//! Whether a search ends at the minimum, and says so only then: the stiff cables of a router, slack cables
//! without weight, elastic laws with kinks.

use cdpr_calibration::{
    Fit, FitSettings, FitStatus, Measurements, Noise, Quantity, Row, SensorError, Simulated, Unknowns, drawn,
    fit, read_measurements, simulate,
};
use cdpr_robot::{Axis, CableEnd, Parameter, Pose, Robot, Vector3};
use cdpr_statics::Load;
use cdpr_study::ErrorModel;

pub(crate) fn router() -> Robot {
    Robot::from_json(include_str!("../../../data/reference/router/nominal.json")).unwrap()
}

fn truth() -> Robot {
    Robot::from_json(include_str!("../../../data/reference/router/true.json")).unwrap()
}

fn table(which: &str) -> &'static str {
    match which {
        "2N" => include_str!("../../../data/reference/router/tension-2N.csv"),
        _ => include_str!("../../../data/reference/router/tension-60N.csv"),
    }
}

fn measured(which: &str, tension: f64) -> Measurements {
    let noise = [("length".to_owned(), 2e-4), ("tension".to_owned(), tension)];
    read_measurements(table(which).as_bytes(), &router(), &noise).unwrap()
}

fn sought(robot: &Robot) -> Unknowns {
    Unknowns::free(robot, &["b1.x", "b1.y", "b2.x", "b2.y", "b4.x"]).unwrap()
}

fn values(found: &Fit) -> Vec<f64> {
    let robot = &found.robot;
    let of = |i: usize, axis: Axis| robot.cables[i].exit_point[axis.index()];
    vec![of(0, Axis::X), of(0, Axis::Y), of(1, Axis::X), of(1, Axis::Y), of(3, Axis::X)]
}

/// Minima by SciPy's `least_squares` with poses and tensions as unknowns: with straight elastic cables, and
/// with the catenaries of data/reference/campaigns.py.
const MINIMA: [(&str, f64, Cables, f64, [f64; 5]); 3] = [
    ("2N", 2.0, Cables::Straight, 14.70847, [-0.011667, 2.115379, 3.007973, 2.093256, 3.014921]),
    ("60N", 60.0, Cables::Straight, 9.13050, [-0.011781, 2.115123, 3.008345, 2.092474, 3.015158]),
    ("2N", 2.0, Cables::Sagging, 14.73528, [-0.011666, 2.115377, 3.007972, 2.093253, 3.014920]),
];

#[derive(Clone, Copy, Debug, PartialEq)]
enum Cables {
    Straight,
    /// Out of the plane, by their weight.
    Sagging,
}

#[test]
fn a_router_with_stiff_cables_is_calibrated_down_to_the_minimum() {
    for (which, tension, cables, chi_square, wanted) in MINIMA {
        let mut robot = router();
        if cables == Cables::Straight {
            robot.cables.iter_mut().for_each(|cable| cable.properties.linear_density = 0.0);
        }
        let rows = measured(which, tension).rows;
        let found = fit(&robot, &rows, &sought(&robot), &FitSettings::default()).unwrap();
        println!("{which}: {} after {} steps, {:?}", found.chi_square, found.steps, found.starts);
        assert!((found.chi_square - chi_square).abs() < 1e-4, "{which}, {cables:?}: {}", found.chi_square);
        assert_eq!(found.status, FitStatus::Converged, "{which}");
        for (value, wanted) in values(&found).into_iter().zip(wanted) {
            assert!((value - wanted).abs() < 2e-6, "{which}: {value} {wanted}");
        }
    }
}

#[test]
fn every_start_leads_a_router_to_the_same_minimum() {
    let robot = router();
    let rows = measured("2N", 2.0).rows;
    let settings = FitSettings { starts: 6, ..FitSettings::default() };
    let found = fit(&robot, &rows, &sought(&robot), &settings).unwrap();
    assert!((found.chi_square - 14.73528).abs() < 1e-4, "{}", found.chi_square);
    assert!(found.starts[1] >= 5, "{:?}", found.starts);
}

#[test]
fn a_search_that_is_cut_short_or_made_once_does_not_say_converged() {
    let robot = router();
    let rows = measured("2N", 2.0).rows;
    let with = |settings| fit(&robot, &rows, &sought(&robot), &settings).unwrap();
    let short = with(FitSettings { max_steps: 1, starts: 1, ..FitSettings::default() });
    assert_eq!(short.status, FitStatus::AwayFromMinimum, "{}", short.distance);
    let once = with(FitSettings { starts: 1, ..FitSettings::default() });
    assert_eq!(once.status, FitStatus::OneStart);
    assert!(!short.converged() && !once.converged());
}

/// A campaign with the true router at a grid of poses.
fn campaign(noise: Noise) -> Vec<Row> {
    let (robot, truth) = (router(), truth());
    let parameters = Parameter::of(&robot);
    let deviations: Vec<f64> = parameters.iter().map(|p| p.nominal(&truth) - p.nominal(&robot)).collect();
    let at = |i: usize| [0.5, 1.5, 2.5][i % 3];
    let poses: Vec<Pose> = (0..9).map(|k| Pose::at(at(k), 0.5 + 0.5 * (k / 3) as f64, 0.0)).collect();
    simulate(&Simulated {
        nominal: &robot,
        deviations: &deviations,
        poses: &poses,
        free: &[],
        load: Load::none(),
        noise,
        markers: &[],
        errors: &[],
        tension_at: CableEnd::Anchor,
        seed: 1,
    })
    .unwrap()
}

#[test]
fn a_planar_robot_is_calibrated_in_its_plane() {
    let robot = router();
    let unknowns = Unknowns::free(&robot, &["b"]).unwrap();
    assert!(unknowns.all.iter().all(|unknown| !unknown.name.ends_with(".z")));
    let error = Unknowns::free(&robot, &["b1.z"]).unwrap_err().to_string();
    assert!(error.contains("in the plane of the robot"), "{error}");
    // Positions in the plane alone, from a tracker whose third coordinate is left out.
    let noise = Noise { position: Some(1e-4), length: Some(2e-4), tension: Some(2.0), ..Noise::default() };
    let mut rows = campaign(noise);
    for row in &mut rows {
        row.readings.retain(|of| of.quantity != Quantity::Position(Axis::Z));
    }
    let found = fit(&robot, &rows, &sought(&robot), &FitSettings::default()).unwrap();
    assert!(found.converged(), "{:?}", found.status);
    assert!(found.p_value().unwrap() > 1e-3, "{}", found.chi_square);
    assert!(found.poses.iter().all(|pose| pose.position.z == 0.0));
    let rows = measured("2N", 2.0).rows;
    let found = fit(&robot, &rows, &sought(&robot), &FitSettings::default()).unwrap();
    assert!(found.poses.iter().all(|pose| pose.position.z == 0.0));
}

#[test]
fn exact_lengths_of_stiff_cables_lead_to_the_minimum_or_to_a_doubt() {
    let robot = router();
    let rows = campaign(Noise { position: Some(1e-4), tension: Some(2.0), ..Noise::default() });
    let found = fit(&robot, &rows, &sought(&robot), &FitSettings::default()).unwrap();
    println!("{} of {}: {:?}", found.chi_square, found.degrees_of_freedom, found.status);
    assert!(found.p_value().unwrap() > 1e-3 || !found.converged(), "{}", found.chi_square);
}

/// Campaigns 28 and 32 of data/reference/campaigns.py with weightless cables over pulleys, of which
/// tolerances make some slack, and the least chi-squares that are known.
const SLACK: [(&str, f64); 2] = [
    (include_str!("../../../data/reference/pulleys-slack/campaign-28.csv"), 139.3425),
    (include_str!("../../../data/reference/pulleys-slack/campaign-32.csv"), 149.6101),
];

/// In the first, rows are at their best with cables between taut and slack; in the second all starts from the
/// robot of the file end with the wrong cables slack, at a chi-square of 9581.
#[test]
fn cables_between_taut_and_slack_do_not_keep_a_search_from_the_minimum() {
    let mut robot = Robot::from_json(include_str!("../../../data/robots/ipanema-3.json")).unwrap();
    robot.cables.iter_mut().for_each(|cable| cable.properties.linear_density = 0.0);
    let std = |parameter: &Parameter| match parameter.group() {
        "a" | "b" => 2e-3,
        "mass" => 0.01 * robot.platform.mass,
        "youngs_modulus" => 0.05 * parameter.nominal(&robot),
        _ => 0.0,
    };
    let stds: Vec<f64> = Parameter::of(&robot).iter().map(std).collect();
    let unknowns = Unknowns::of_model(&ErrorModel::normal(&robot, &stds));
    let noise = ["position", "rotation", "length"].map(|name| (name.to_owned(), 1e-4));
    for (table, least) in SLACK {
        let rows = read_measurements(table.as_bytes(), &robot, &noise).unwrap().rows;
        let found = fit(&robot, &rows, &unknowns, &FitSettings::default()).unwrap();
        println!("{} after {} steps, {:?}", found.chi_square, found.steps, found.starts);
        assert!(found.chi_square < least + 1e-3, "{} {least}", found.chi_square);
        assert_eq!(found.status, FitStatus::Converged, "{}", found.distance);
    }
}

/// A planar robot of steel ropes on pulleys: below 600 N their modulus is 60 GPa, above 95 GPa.
const PLOTTER: &str = r#"{
  "format": "cdpr-robot/1", "name": "Wall plotter of steel", "gravity": 9.81, "plane": "xz",
  "platform": {
    "mass": 15, "center_of_mass": [0.01, 0, -0.02],
    "inertia": [[0.12, 0, 0], [0, 0.3, 0], [0, 0, 0.35]]
  },
  "cable": {
    "diameter": 0.004, "section": 6.6e-6, "linear_density": 0.061, "youngs_modulus": 9e10,
    "law": { "segments": [{ "tension": 0, "modulus": 6e10 }, { "tension": 600, "modulus": 9.5e10 }] }
  },
  "pulley": { "radius": 0.04, "axis": [0, 0, 1] },
  "tension_limits": { "min": 80, "max": 3000 }, "tension_reference": 500,
  "cables": [
    { "exit_point": [0, 0, 0.1], "anchor_point": [-0.2, 0, -0.1], "lead": 0.8 },
    { "exit_point": [4, 0, 0], "anchor_point": [0.2, 0, -0.1], "lead": 0.7 },
    { "exit_point": [4.1, 0, 3], "anchor_point": [0.2, 0, 0.1], "lead": 1.2 },
    { "exit_point": [-0.1, 0, 3.1], "anchor_point": [-0.2, 0, 0.1], "lead": 1.1 }
  ]
}"#;

/// Positions and rotations of a campaign: at some of them a tension is near 600 N.
const POSES: [[f64; 3]; 20] = [
    [2.2627, 2.1355, 0.0577],
    [1.2630, 1.1803, 0.0782],
    [0.7132, 2.0140, 0.0622],
    [1.8698, 1.1849, -0.0464],
    [1.3372, 1.4121, 0.0010],
    [2.0837, 2.2928, 0.0613],
    [2.2554, 2.2823, -0.0596],
    [1.1005, 1.6801, -0.0955],
    [0.7892, 1.5238, -0.0071],
    [2.9929, 1.7068, 0.0030],
    [1.9422, 1.0960, -0.1022],
    [1.1810, 1.8073, -0.0627],
    [1.6238, 0.7060, 0.0691],
    [1.0862, 1.1282, 0.0797],
    [1.9745, 2.0554, 0.0293],
    [2.5544, 0.8464, 0.0086],
    [1.9694, 2.0941, -0.0291],
    [2.1955, 0.7948, -0.0235],
    [1.5076, 0.9403, 0.0663],
    [1.6486, 2.2660, 0.0188],
];

fn calibrated_plotter(robot: &Robot, seed: u64) -> Fit {
    let std = |parameter: &Parameter| match parameter.group() {
        "a" => 2e-3,
        "b" => 3e-3,
        _ => 0.0,
    };
    let model = ErrorModel::normal(robot, &Parameter::of(robot).iter().map(std).collect::<Vec<_>>());
    let at = |&[x, z, turn]: &[f64; 3]| {
        Pose::at(0.0, 0.0, 0.0).moved(Vector3::new(x, 0.0, z), Vector3::new(0.0, turn, 0.0))
    };
    let poses: Vec<Pose> = POSES.iter().map(at).collect();
    let noise = Noise { position: Some(1e-4), rotation: Some(2e-4), length: Some(2e-4), ..Noise::default() };
    let simulated = Simulated {
        nominal: robot,
        deviations: &drawn(&model, seed),
        poses: &poses,
        free: &[],
        load: Load::none(),
        noise,
        markers: &[],
        errors: &[],
        tension_at: CableEnd::Anchor,
        seed,
    };
    let rows = simulate(&simulated).unwrap();
    let mut unknowns = Unknowns::of_model(&model);
    unknowns.add(robot, SensorError::Frame, Some(0.02), 0);
    fit(robot, &rows, &unknowns, &FitSettings { starts: 1, ..FitSettings::default() }).unwrap()
}

/// By their weight cables have the kink over a range of tensions; without it, and on their leads, at one.
#[test]
fn tensions_at_a_kink_of_the_law_do_not_keep_a_search_from_the_minimum() {
    let heavy = Robot::from_json(PLOTTER).unwrap();
    let mut light = heavy.clone();
    light.cables.iter_mut().for_each(|cable| cable.properties.linear_density = 0.0);
    let mut sharp = light.clone();
    sharp.cables.iter_mut().for_each(|cable| (cable.pulley, cable.lead) = (None, 0.0));
    for (name, robot) in [("heavy", heavy), ("light", light), ("sharp", sharp)] {
        let (mut farthest, mut away): (f64, usize) = (0.0, 0);
        for seed in 0..16 {
            let found = calibrated_plotter(&robot, seed);
            println!(
                "{name} {seed}: {:.1e} after {} steps, {}",
                found.distance, found.steps, found.chi_square
            );
            farthest = farthest.max(found.distance);
            assert!(found.p_value().unwrap() > 1e-3, "{name}, {seed}: {}", found.chi_square);
            assert!(found.steps <= 60, "{name}, {seed}: {} steps", found.steps);
            away += usize::from(found.status != FitStatus::OneStart);
        }
        println!("{name}: {farthest:.1e} standard deviations from the minimum");
        assert_eq!(away, 0, "{name}: {farthest:.1e} standard deviations from the minimum");
    }
}
