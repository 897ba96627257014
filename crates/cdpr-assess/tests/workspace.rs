//! Workspaces: every position is what the models say of it alone.

use cdpr_assess::{Workspace, WorkspaceSummary, compute_workspace};
use cdpr_robot::{Coordinate, Matrix3, Parameter, Robot, Rotation3, Vector3};
use cdpr_statics::{DirectProblem, Load, deflection, deflection_free, derivatives, held_at, inverse};
use cdpr_study::{ErrorModel, Grid, GridAxis, StudyError, uncertainties};
use serde_json::Value;
use std::sync::atomic::{AtomicUsize, Ordering};

fn caroca() -> Robot {
    Robot::from_json(include_str!("../../../data/robots/caroca.json")).unwrap()
}

fn grid() -> Grid {
    let axis = |min, max, points| GridAxis { min, max, points };
    Grid::new([axis(-1.0, 1.0, 3), axis(-0.5, 0.5, 2), axis(1.0, 9.0, 2)]).unwrap()
}

#[test]
fn every_position_is_what_the_models_say_of_it() {
    let robot = caroca();
    let mut deviations = vec![0.0; 62];
    deviations[0] = 2.0;
    deviations[2] = 5e9;
    deviations[5] = 0.003;
    let model = ErrorModel::normal(&robot, &deviations);
    let workspace = Workspace {
        robot: &robot,
        grid: grid(),
        rotation: Rotation3::identity(),
        load: Load::payload(50.0),
        tolerances: Some(&model),
        free: &[],
    };
    let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
    assert_eq!(poses.len(), 12);
    for (found, pose) in poses.iter().zip(grid().poses()) {
        assert_eq!(found.pose, pose);
        let exact = derivatives(&robot, &pose, &[0.0; 8], &Load::payload(50.0));
        let (held, exact) = match (&found.outcome, exact) {
            (Ok(held), Ok(exact)) => (held, exact),
            (Err(found), Err(exact)) => {
                assert_eq!((found, pose.position.z), (&exact, 9.0));
                continue;
            }
            (found, exact) => panic!("{found:?} for {exact:?}"),
        };
        assert_eq!(held.displacement, exact.deflection.displacement());
        let both = [&exact.deflection.unloaded, &exact.deflection.loaded];
        let tensions: Vec<f64> = both.iter().flat_map(|solution| solution.equilibrium.tensions()).collect();
        assert!(tensions.iter().all(|t| (held.least_tension..=held.greatest_tension).contains(t)));
        assert!(tensions.contains(&held.least_tension) && tensions.contains(&held.greatest_tension));
        assert_eq!(held.least_stiffness, exact.deflection.loaded.stability.least_stiffness());
        assert_eq!(held.lowest_frequency, None);
        assert!(held.is_within_limits());
        let anew = inverse(&robot, &pose, &Load::payload(50.0), None).unwrap().tensions;
        let found = found.anew.clone().unwrap().unwrap();
        assert!(anew.contains(&found.least_tension) && anew.contains(&found.greatest_tension));
        assert!(anew.iter().all(|t| (found.least_tension..=found.greatest_tension).contains(t)));

        let variances: Vec<f64> = deviations.iter().map(|std| std * std).collect();
        let budget = exact.variance_budget(&variances).unwrap();
        let dominant = held.dominant.unwrap();
        let index = Parameter::of(&robot)
            .iter()
            .position(|p| p.to_string() == model.inputs[dominant.input].name)
            .unwrap();
        assert!((budget.shares[index] - dominant.share).abs() < 1e-12);
        assert!(budget.shares.iter().all(|share| *share <= dominant.share + 1e-12));
        assert!((budget.std - dominant.std).abs() < 1e-12 * budget.std);
    }
}

#[test]
fn a_load_beyond_the_limits_is_told_from_a_pose_that_is_not_held() {
    let mut robot = caroca();
    // At the middle of the frame the platform alone asks for 577 N, with 50 kg for 739 N.
    robot.tension_limits.max = 650.0;
    let at = |z| GridAxis { min: z, max: z, points: 1 };
    let grid = Grid::new([at(0.0), at(0.0), GridAxis { min: 1.75, max: 9.0, points: 2 }]).unwrap();
    let workspace = Workspace {
        robot: &robot,
        grid,
        rotation: Rotation3::identity(),
        load: Load::payload(50.0),
        tolerances: None,
        free: &[],
    };
    let summary =
        WorkspaceSummary::new(&workspace, &compute_workspace(&workspace, &|| (), &|| false).unwrap());
    assert_eq!(summary.rows[0].status, "beyond_limits");
    assert!(summary.rows[0].greatest_tension.unwrap() > 650.0 && summary.rows[0].reason.is_none());
    assert_eq!(summary.rows[1].status, "infeasible_tension");
    assert_eq!(
        (summary.rms_mm, summary.rows[1].rms_mm, summary.rows[0].dominant.clone()),
        (None, None, None)
    );
}

/// `data/reference/drawn.py` looks for tensions with a solver and a catenary of its own.
#[test]
fn the_stadium_robot_is_held_wherever_an_independent_program_finds_tensions() {
    let robot = Robot::from_json(include_str!("../../../data/reference/robots/stadium.json")).unwrap();
    let file: Value = serde_json::from_str(include_str!("../../../data/reference/stadium.json")).unwrap();
    let axis = |min, max, points| GridAxis { min, max, points };
    let grid = Grid::new([axis(-48.0, 48.0, 9), axis(-32.0, 32.0, 5), axis(10.0, 10.0, 1)]).unwrap();
    for payload in [0.0, 40.0] {
        let load = Load::payload(payload);
        let rotation = Rotation3::identity();
        let workspace = Workspace { robot: &robot, grid, rotation, load, tolerances: None, free: &[] };
        let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
        let rows = file["poses"].as_array().unwrap().iter().filter(|row| row[0] == payload);
        let rows: Vec<_> = rows.collect();
        assert_eq!(rows.len(), poses.len());
        let (mut kept, mut anew, mut independent) = (0, 0, 0);
        for (row, found) in rows.iter().zip(&poses) {
            let position = found.pose.position;
            assert_eq!((row[1].as_f64(), row[2].as_f64()), (Some(position.x), Some(position.y)));
            kept += usize::from(found.outcome.as_ref().is_ok_and(cdpr_assess::Held::is_within_limits));
            let tensions = inverse(&robot, &found.pose, &load, None);
            anew += usize::from(tensions.is_ok());
            if let Some(status) = &found.anew {
                assert_eq!(status.is_ok(), tensions.is_ok());
            }
            if let Some(least) = row[3].as_f64() {
                independent += 1;
                let norm = tensions.unwrap().tensions.iter().map(|t| t * t).sum::<f64>().sqrt();
                assert!((norm / least - 1.0).abs() < 1e-9, "{position:?}: {norm} {least}");
            }
        }
        println!(
            "{payload} kg: held at {kept} positions with the lengths kept, at {anew} with the tensions \
            distributed anew, at {independent} by the independent program"
        );
        assert!(anew >= independent && independent > 0);
    }
}

#[test]
fn a_platform_with_an_inertia_has_its_lowest_frequency_under_the_load() {
    let mut robot = caroca();
    robot.platform.inertia = Some(Matrix3::from_diagonal(&Vector3::new(4.0, 5.0, 6.0)));
    for load in [Load::none(), Load::payload(50.0)] {
        let workspace = Workspace {
            robot: &robot,
            grid: grid(),
            rotation: Rotation3::identity(),
            load,
            tolerances: None,
            free: &[],
        };
        let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
        let summary = WorkspaceSummary::new(&workspace, &poses);
        let mut lowest = f64::INFINITY;
        for (found, row) in poses.iter().zip(&summary.rows) {
            let Ok(held) = &found.outcome else { continue };
            let frequency = held.lowest_frequency.unwrap();
            assert_eq!(row.lowest_frequency_hz, Some(frequency));
            // The lengths are those without the load.
            let exact = deflection(&robot, &found.pose, &[0.0; 8], &load).unwrap();
            let problem = DirectProblem::new(&robot, &exact.lengths, &load).unwrap();
            let modes = problem.modes(&exact.loaded.equilibrium).unwrap();
            assert!(modes.iter().all(|mode| mode.frequency >= frequency));
            assert!((modes[0].frequency / frequency - 1.0).abs() < 1e-9);
            lowest = lowest.min(frequency);
        }
        println!("{} kg: {lowest} Hz", load.payload);
        assert_eq!(summary.lowest_frequency_hz.unwrap().min, lowest);
    }
}

#[test]
fn a_robot_with_four_cables_has_a_workspace_of_its_held_coordinates() {
    let mut robot = Robot::from_json(include_str!("../../../data/robots/cogiro.json")).unwrap();
    robot.cables = [0, 2, 4, 6].map(|i| robot.cables[i].clone()).to_vec();
    let model = ErrorModel::normal(&robot, &vec![1e-3; Parameter::of(&robot).len()]);
    let free = [Coordinate::Roll, Coordinate::Pitch];
    let axis = |min, max, points| GridAxis { min, max, points };
    let workspace = Workspace {
        robot: &robot,
        grid: Grid::new([axis(0.5, 1.5, 2), axis(0.3, 0.7, 2), axis(1.5, 2.0, 2)]).unwrap(),
        rotation: Rotation3::identity(),
        load: Load::payload(20.0),
        tolerances: Some(&model),
        free: &free,
    };
    let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
    assert_eq!(poses.len(), 8);
    for found in &poses {
        let held = found.outcome.as_ref().unwrap();
        let exact = deflection_free(&robot, &found.pose, &[0.0; 4], &workspace.load, &free).unwrap();
        assert_eq!(held.displacement, exact.displacement());
        assert_eq!(held.least_stiffness, exact.loaded.stability.least_stiffness());
        assert!(held.lowest_frequency.unwrap() > 0.0 && held.dominant.is_some());
        let anew = held_at(&robot, &found.pose, &workspace.load, &free).unwrap().equilibrium.tensions();
        let range = found.anew.clone().unwrap().unwrap();
        assert!(anew.contains(&range.least_tension) && anew.contains(&range.greatest_tension));
    }
    let workspace = Workspace { free: &free[..1], ..workspace };
    let message = compute_workspace(&workspace, &|| (), &|| false).unwrap_err().to_string();
    assert!(message.starts_with("free is [roll]: expected 2 of x, y, z, roll, pitch, yaw"), "{message}");
}

#[test]
fn tolerances_of_another_robot_are_refused() {
    let robot = caroca();
    let seven = Robot { cables: robot.cables[..7].to_vec(), ..robot.clone() };
    let model = ErrorModel::normal(&seven, &[1.0; 55]);
    let workspace = Workspace {
        robot: &robot,
        grid: grid(),
        rotation: Rotation3::identity(),
        load: Load::payload(50.0),
        tolerances: Some(&model),
        free: &[],
    };
    let message = compute_workspace(&workspace, &|| (), &|| false).unwrap_err().to_string();
    assert_eq!(message, "error model is for 55 parameters: expected one for the 62 parameters of CAROCA");
    let workspace = Workspace { load: Load::payload(f64::NAN), tolerances: None, ..workspace };
    let message = compute_workspace(&workspace, &|| (), &|| false).unwrap_err().to_string();
    assert_eq!(message, "payload is NaN: expected a finite mass, zero or more [kg]");
}

#[test]
fn a_workspace_ends_where_it_is_told_to() {
    let robot = caroca();
    let workspace = Workspace {
        robot: &robot,
        grid: grid(),
        rotation: Rotation3::identity(),
        load: Load::payload(50.0),
        tolerances: None,
        free: &[],
    };
    let done = AtomicUsize::new(0);
    let tick = || {
        done.fetch_add(1, Ordering::Relaxed);
    };
    let found = compute_workspace(&workspace, &tick, &|| done.load(Ordering::Relaxed) > 0);
    assert!(matches!(found, Err(StudyError::Stopped)));
    // Each thread may have begun one position before the stop.
    assert!((1..=rayon::current_num_threads()).contains(&done.into_inner()));
}

#[test]
fn uncertainties_are_of_a_parameter_or_its_group_positive_and_finite() {
    let robot = caroca();
    let of = |name: &str, std: f64| uncertainties(&robot, &[(name.to_owned(), std)]);
    let named = [("a".to_owned(), 0.002), ("a1.x".to_owned(), 0.001)];
    let found = uncertainties(&robot, &named).unwrap();
    assert_eq!((found[0], found[3], found[4], found[27]), (0.0, 0.001, 0.002, 0.0));
    for (name, std, start) in [
        ("spring", 1.0, "uncertainty of spring is 1: expected a positive standard deviation"),
        ("mass", 0.0, "uncertainty of mass is 0: expected"),
        ("mass", f64::INFINITY, "uncertainty of mass is inf: expected"),
        ("mass", f64::NAN, "uncertainty of mass is NaN: expected"),
    ] {
        let message = of(name, std).unwrap_err().to_string();
        assert!(message.starts_with(start), "{message}");
    }
}
