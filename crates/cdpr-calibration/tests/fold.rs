//! Rows beyond the end of the branch of equilibria of the robot of the file: under their load its platform
//! falls, that of the true robot does not.

use cdpr_calibration::{FitSettings, FitStatus, Noise, Row, Simulated, Unknowns, fit, simulate};
use cdpr_robot::{CableEnd, Parameter, Pose, Robot, Rotation3, Vector3, Wrench};
use cdpr_statics::{Load, deflection};

/// Deviations of the centre of mass [m], with which the platform carries the load.
const TRUTH: [(&str, f64); 3] = [("cog.x", 0.02), ("cog.y", 0.02), ("cog.z", -0.15)];

/// Shares of the load at the poses; at the first one the platform of the file falls at 0.92.
const SHARES: [f64; 5] = [1.0, 0.5, 0.0, 0.4, 0.3];

fn robot() -> Robot {
    Robot::from_json(include_str!("../../../data/reference/robots/suspended.json")).unwrap()
}

fn load(share: f64) -> Load {
    let moment = share * Vector3::new(400.0, -300.0, 100.0);
    Load { payload: 2.0 * share, wrench: Wrench { force: Vector3::zeros(), moment } }
}

fn poses() -> Vec<Pose> {
    let turn = [3.0_f64, -4.0, 6.0].map(f64::to_radians);
    let rotation = Rotation3::from_euler_angles(turn[0], turn[1], turn[2]);
    [(0.6, -0.4, 1.6), (-0.8, 0.5, 1.4), (0.2, 0.9, 1.8), (1.2, 0.1, 1.2), (-0.3, -0.9, 1.5)]
        .map(|(x, y, z)| Pose { rotation, ..Pose::at(x, y, z) })
        .to_vec()
}

fn deviations(robot: &Robot) -> Vec<f64> {
    let of = |parameter: &Parameter| TRUTH.iter().find(|(name, _)| *name == parameter.to_string());
    Parameter::of(robot).iter().map(|parameter| of(parameter).map_or(0.0, |(_, value)| *value)).collect()
}

fn campaign(robot: &Robot, noise: Noise) -> Vec<Row> {
    let deviations = deviations(robot);
    let of_pose = |(k, (pose, share)): (usize, (&Pose, &f64))| {
        let simulated = Simulated {
            nominal: robot,
            deviations: &deviations,
            poses: &[*pose],
            free: &[],
            load: load(*share),
            noise,
            markers: &[],
            errors: &[],
            tension_at: CableEnd::Anchor,
            seed: 1 + k as u64,
        };
        let rows = simulate(&simulated).unwrap();
        rows.into_iter().map(move |row| Row { line: k + 2, ..row })
    };
    poses().iter().zip(&SHARES).enumerate().flat_map(of_pose).collect()
}

#[test]
fn rows_beyond_the_end_of_the_nominal_branch_lead_to_the_minimum() {
    let robot = robot();
    let error = deflection(&robot, &poses()[0], &load(SHARES[0])).unwrap_err();
    assert_eq!(error.kind(), "branch_ends");
    let truth = robot.perturbed(&deviations(&robot)).unwrap().robot;
    let names = TRUTH.map(|(name, _)| name);
    let length = Some(1e-3);
    let pose = Noise { length, position: Some(1e-4), rotation: Some(1e-4), ..Noise::default() };
    for noise in
        [Noise { length: Some(1e-4), ..pose }, Noise { length, tension: Some(2.0), ..Noise::default() }]
    {
        let rows = campaign(&robot, noise);
        assert_eq!(rows.len(), SHARES.len());
        let unknowns = Unknowns::free(&robot, &names).unwrap();
        let found = fit(&robot, &rows, &unknowns, &FitSettings::default()).unwrap();
        println!("{} of {}, {:?}", found.chi_square, found.degrees_of_freedom, found.starts);
        assert_eq!(found.status, FitStatus::Converged);
        assert!(found.p_value().unwrap() > 1e-3, "{}", found.chi_square);
        for (estimate, (name, value)) in found.estimates.iter().zip(TRUTH) {
            let away = (estimate.value - value) / estimate.std.unwrap();
            assert!(away.abs() < 4.0, "{name}: {} instead of {value}", estimate.value);
        }
        // The minimum that a search from the true robot finds.
        let from_truth =
            fit(&truth, &rows, &Unknowns::free(&truth, &names).unwrap(), &FitSettings::default());
        let least = from_truth.unwrap().chi_square;
        assert!(found.chi_square < least + 1e-3, "{} {least}", found.chi_square);
    }
}
