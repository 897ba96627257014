//! Questions about a workspace that are refused, or ended.

use crate::workspace::{caroca, grid};
use cdpr_assess::{Further, Way, Workspace, compute_workspace, workspace_boundary};
use cdpr_robot::{Coordinate, Robot, Rotation3};
use cdpr_statics::Load;
use cdpr_study::{ErrorModel, Grid, StudyError, uncertainties};
use std::sync::atomic::{AtomicUsize, Ordering};

#[test]
fn a_map_over_a_coordinate_that_is_free_is_refused() {
    let robot = Robot::from_json(include_str!("../../../data/robots/four-cables.json")).unwrap();
    fn map<'a>(robot: &'a Robot, free: &'a [Coordinate]) -> Workspace<'a> {
        let grid = Grid::over_frame(robot, cdpr_robot::Axis::Z, 2.0, [3, 3]).unwrap();
        let rotation = Rotation3::identity();
        Workspace {
            robot,
            grid,
            rotation,
            load: Load::none(),
            tolerances: None,
            free,
            further: Further::default(),
        }
    }
    for free in [[Coordinate::X, Coordinate::Y], [Coordinate::Roll, Coordinate::Y]] {
        let name = free.into_iter().find(|one| !one.is_angle()).unwrap();
        for error in [
            compute_workspace(&map(&robot, &free), &|| (), &|| false).unwrap_err(),
            workspace_boundary(&map(&robot, &free), Way::Kept, &|| false).unwrap_err(),
        ] {
            let error = error.to_string();
            assert!(error.starts_with(&format!("free is {name}: expected coordinates")), "{error}");
        }
    }
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
        further: Further::default(),
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
        further: Further::default(),
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
