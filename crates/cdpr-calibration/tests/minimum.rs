//! Whether a search ends at the minimum, and says so only then: the stiff cables of a router, slack cables
//! without weight.

use cdpr_calibration::{
    Fit, FitSettings, FitStatus, Measurements, Noise, Quantity, Row, Simulated, Unknowns, fit,
    read_measurements, simulate,
};
use cdpr_robot::{Axis, CableEnd, Parameter, Pose, Robot};
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

/// Campaigns 28 and 32 of data/reference/campaigns.py with weightless cables over pulleys, of which tolerances
/// make some slack, and the least chi-squares that are known.
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
