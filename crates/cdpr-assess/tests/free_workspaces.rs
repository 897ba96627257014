//! Workspaces of robots with free coordinates.

use crate::workspace::caroca;
use cdpr_assess::{Further, Workspace, WorkspaceSummary, compute_workspace};
use cdpr_robot::{Coordinate, Parameter, Robot, Rotation3};
use cdpr_statics::{Load, StaticsError, WantedPose, deflection, inverse};
use cdpr_study::{ErrorModel, Grid, GridAxis};

#[test]
fn a_robot_with_four_cables_has_a_workspace_of_its_held_coordinates() {
    let robot = Robot::from_json(include_str!("../../../data/robots/four-cables.json")).unwrap();
    let model = ErrorModel::normal(&robot, &vec![1e-3; Parameter::of(&robot).len()]);
    let free = [Coordinate::Roll, Coordinate::Pitch];
    let axis = |min, max, points| GridAxis { min, max, points };
    let workspace = Workspace {
        robot: &robot,
        grid: Grid::new([axis(0.3, 0.5, 2), axis(0.3, 0.4, 2), axis(1.5, 2.0, 2)]).unwrap(),
        rotation: Rotation3::identity(),
        load: Load::payload(20.0),
        tolerances: Some(&model),
        free: &free,
        further: Further::default(),
    };
    let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
    assert_eq!(poses.len(), 8);
    for found in &poses {
        let held = found.outcome.as_ref().unwrap();
        let exact = deflection(&robot, WantedPose::at(&found.pose).free(&free), &workspace.load).unwrap();
        assert_eq!(held.displacement, exact.displacement());
        assert_eq!(held.least_stiffness, exact.loaded.stability.least_stiffness());
        assert!(held.swing.unwrap().lowest > 0.0 && held.dominant.is_some());
        let recomputed = inverse(&robot, WantedPose::at(&found.pose).free(&free), &workspace.load)
            .unwrap()
            .equilibrium
            .tensions();
        let range = found.recomputed.clone().unwrap().unwrap();
        assert!(recomputed.contains(&range.least_tension) && recomputed.contains(&range.greatest_tension));
    }
    let workspace = Workspace { free: &free[..1], ..workspace };
    let message = compute_workspace(&workspace, &|| (), &|| false).unwrap_err().to_string();
    assert!(message.starts_with("free is [roll]: expected 2 of x, y, z, roll, pitch, yaw"), "{message}");
}

#[test]
fn tensions_of_a_map_with_free_coordinates_are_within_their_limits() {
    let robot = Robot::from_json(include_str!("../../../data/robots/four-cables.json")).unwrap();
    let axis = |min, max, points| GridAxis { min, max, points };
    let workspace = Workspace {
        robot: &robot,
        grid: Grid::new([axis(0.3, 0.6, 4), axis(0.2, 0.4, 3), axis(1.5, 2.5, 3)]).unwrap(),
        rotation: Rotation3::identity(),
        load: Load::payload(1e-3),
        tolerances: None,
        free: &[Coordinate::Roll, Coordinate::Pitch],
        further: Further::default(),
    };
    let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
    let recomputed: Vec<_> =
        poses.iter().filter_map(|found| found.recomputed.as_ref()?.as_ref().ok()).collect();
    assert_eq!((poses.len(), recomputed.len()), (36, 27));
    assert!(recomputed.iter().all(|range| range.least_tension >= 10.0 && range.greatest_tension <= 5000.0));
}

#[test]
fn a_position_that_is_held_upside_down_alone_is_unstable() {
    let robot = Robot::from_json(include_str!("../../../data/robots/grab.json")).unwrap();
    let axis = |min, max, points| GridAxis { min, max, points };
    let workspace = Workspace {
        robot: &robot,
        grid: Grid::new([axis(0.94, 1.36, 2), axis(0.06, 0.48, 2), axis(-0.92, -0.92, 1)]).unwrap(),
        rotation: Rotation3::identity(),
        load: Load::payload(0.5),
        tolerances: None,
        free: &[Coordinate::Roll, Coordinate::Pitch],
        further: Further::default(),
    };
    let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
    let kind = |error: &StaticsError| error.kind();
    for found in poses {
        // The platform is upright on the line y = 0.06 m alone.
        let upright = found.pose.position.y < 0.1;
        let recomputed = found.recomputed.as_ref().unwrap();
        assert_eq!(found.outcome.as_ref().err().map(kind), (!upright).then_some("unstable"));
        assert_eq!(recomputed.as_ref().err().map(kind), (!upright).then_some("unstable"));
    }
}

#[test]
fn tensions_recomputed_above_a_breaking_force_hold_nothing() {
    let mut robot = caroca();
    robot.cables.iter_mut().for_each(|cable| cable.properties.breaking_force = Some(700.0));
    let at = |z| GridAxis { min: z, max: z, points: 1 };
    let workspace = Workspace {
        robot: &robot,
        grid: Grid::new([at(0.0), at(0.0), at(1.75)]).unwrap(),
        rotation: Rotation3::identity(),
        load: Load::payload(50.0),
        tolerances: None,
        free: &[],
        further: Further::default(),
    };
    let row = |workspace: &Workspace| {
        let found = compute_workspace(workspace, &|| (), &|| false).unwrap();
        WorkspaceSummary::new(workspace, &found).rows.remove(0)
    };
    let breaking = row(&workspace);
    assert_eq!(breaking.status, "beyond_limits");
    let held = breaking.recomputed_status == Some("held");
    assert!(!held || breaking.recomputed_greatest_tension_n.unwrap() <= 700.0 * (1.0 + 1e-9));
    // A platform on few cables hangs as it does, whatever breaks.
    let mut few = Robot::from_library("four-cables").unwrap();
    few.cables.iter_mut().for_each(|cable| cable.properties.breaking_force = Some(1.0));
    let grid = Grid::new([at(0.5), at(0.3), at(2.0)]).unwrap();
    let workspace =
        Workspace { robot: &few, grid, free: &[Coordinate::Roll, Coordinate::Pitch], ..workspace };
    let breaking = row(&workspace);
    assert_eq!((breaking.status, breaking.recomputed_status), ("beyond_limits", Some("beyond_limits")));
    assert!(breaking.recomputed_reason.unwrap().contains("above its breaking force, 1 N"));
}
