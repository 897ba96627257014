//! Workspaces: every position is what the models say of it alone.

use cdpr_assess::{
    Further, TiltDirections, Way, Workspace, WorkspaceRow, WorkspaceSummary, WrenchSet, capacity_at,
    clearance_under, compute_workspace, tilt_at, workspace_boundary,
};
use cdpr_dynamics::{Modes, Wanted};
use cdpr_evidence::accept;
use cdpr_robot::{Matrix3, Parameter, Pose, Robot, Rotation3, Vector3, Wrench};
use cdpr_statics::{DirectProblem, Load, StaticsError, deflection, derivatives, inverse};
use cdpr_study::{ErrorModel, Grid, GridAxis};
use serde_json::Value;
use std::f64::consts::FRAC_PI_2;

pub(crate) fn caroca() -> Robot {
    Robot::from_json(include_str!("../../../data/robots/caroca.json")).unwrap()
}

/// Greatest relative difference of a map, which lanes answer, from the scalar models.
const SAME: f64 = 1e-9;

/// These are the least and the greatest of the tensions.
fn assert_range(tensions: &[f64], range: [f64; 2]) {
    let exact = [
        tensions.iter().copied().fold(f64::INFINITY, f64::min),
        tensions.iter().copied().fold(0.0, f64::max),
    ];
    assert!(range.iter().zip(exact).all(|(found, exact)| (found - exact).abs() < SAME * exact), "{range:?}");
}

pub(crate) fn grid() -> Grid {
    let axis = |min, max, points| GridAxis { min, max, points };
    Grid::new([axis(-1.0, 1.0, 3), axis(-0.5, 0.5, 2), axis(1.0, 9.0, 2)]).unwrap()
}

/// Both refuse a pose by a proof; the least residuals are found from different tensions.
fn assert_same_refusal(found: &StaticsError, exact: &StaticsError) {
    let numbers = |error: &StaticsError| match error {
        StaticsError::NoTensions {
            position,
            min,
            max,
            starts,
            refuted: true,
            rank_deficient,
            force,
            moment,
            tensions,
            blocked,
        } => {
            let limits: Vec<_> = blocked.iter().map(|limit| (limit.index, limit.bound)).collect();
            let all: Vec<f64> =
                [*force, force + moment].into_iter().chain(tensions.iter().copied()).collect();
            ((*position, *min, *max, *starts, *rank_deficient, limits), all)
        }
        other => panic!("{other:?}"),
    };
    let ((what, found), (exactly, exact)) = (numbers(found), numbers(exact));
    assert_eq!((what, found.len()), (exactly, exact.len()));
    assert!(found.iter().zip(&exact).all(|(a, b)| (a - b).abs() < SAME * b), "{found:?} for {exact:?}");
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
        further: Further::default(),
    };
    let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
    assert_eq!(poses.len(), 12);
    for (found, pose) in poses.iter().zip(grid().poses()) {
        assert_eq!(found.pose, pose);
        let exact = derivatives(&robot, &pose, &Load::payload(50.0));
        let (held, exact) = match (&found.outcome, exact) {
            (Ok(held), Ok(exact)) => (held, exact),
            (Err(found), Err(exact)) => {
                assert_same_refusal(found, &exact);
                assert_eq!(pose.position.z, 9.0);
                continue;
            }
            (found, exact) => panic!("{found:?} for {exact:?}"),
        };
        let displacement = exact.deflection.displacement();
        assert!((held.displacement - displacement).norm() < SAME * displacement.norm());
        let both = [&exact.deflection.unloaded, &exact.deflection.loaded];
        let tensions: Vec<f64> = both.iter().flat_map(|solution| solution.equilibrium.tensions()).collect();
        assert_range(&tensions, [held.least_tension, held.greatest_tension]);
        let stiffness = exact.deflection.loaded.stability.least_stiffness();
        assert!((held.least_stiffness - stiffness).abs() < SAME * stiffness);
        assert_eq!(held.swing, None);
        assert!(held.is_within_limits());
        let recomputed = inverse(&robot, &pose, &Load::payload(50.0)).unwrap().tensions;
        let found = found.recomputed.clone().unwrap().unwrap();
        assert_range(&recomputed, [found.least_tension, found.greatest_tension]);

        let variances: Vec<f64> = deviations.iter().map(|std| std * std).collect();
        let (left, right) = (exact.magnitude().unwrap(), exact.right().magnitude().unwrap());
        let squares = left.iter().zip(&right).map(|(left, right)| 0.5 * (left * left + right * right));
        let parts: Vec<f64> = squares.zip(&variances).map(|(square, variance)| square * variance).collect();
        let variance: f64 = parts.iter().sum();
        let dominant = held.dominant.unwrap();
        let index = Parameter::of(&robot)
            .iter()
            .position(|p| p.to_string() == model.inputs[dominant.input].name)
            .unwrap();
        assert!((parts[index] / variance - dominant.share).abs() < 1e-12);
        assert!(parts.iter().all(|part| part / variance <= dominant.share + 1e-12));
        assert!((variance.sqrt() - dominant.std).abs() < 1e-12 * dominant.std);
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
        further: Further::default(),
    };
    let summary =
        WorkspaceSummary::new(&workspace, &compute_workspace(&workspace, &|| (), &|| false).unwrap());
    assert_eq!(summary.rows[0].status, "beyond_limits");
    assert!(summary.rows[0].greatest_tension_n.unwrap() > 650.0);
    assert!(summary.rows[0].reason.as_ref().unwrap().contains("above tension_limits.max, 650 N"));
    assert!(summary.rows[1].reason.as_ref().unwrap().contains("no tensions between"));
    let [(first, 1), (second, 1)] =
        summary.left_out.iter().map(|(why, n)| (why.as_str(), *n)).collect::<Vec<_>>()[..]
    else {
        panic!("{:?}", summary.left_out)
    };
    assert!(first.starts_with("beyond_limits: cable ") && first.ends_with(", max"), "{first}");
    assert_eq!(second, "infeasible_tension");
    assert_eq!(summary.rows[1].status, "infeasible_tension");
    assert_eq!(
        (summary.magnitude_mm, summary.rows[1].magnitude_mm, summary.rows[0].dominant.clone()),
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
        let workspace = Workspace {
            robot: &robot,
            grid,
            rotation,
            load,
            tolerances: None,
            free: &[],
            further: Further::default(),
        };
        let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
        let rows = file["poses"].as_array().unwrap().iter().filter(|row| row[0] == payload);
        let rows: Vec<_> = rows.collect();
        assert_eq!(rows.len(), poses.len());
        let (mut kept, mut recomputed, mut independent) = (0, 0, 0);
        for (row, found) in rows.iter().zip(&poses) {
            let position = found.pose.position;
            assert_eq!((row[1].as_f64(), row[2].as_f64()), (Some(position.x), Some(position.y)));
            kept += usize::from(found.outcome.as_ref().is_ok_and(cdpr_assess::Held::is_within_limits));
            let tensions = inverse(&robot, &found.pose, &load);
            recomputed += usize::from(tensions.is_ok());
            if let Some(status) = &found.recomputed {
                assert_eq!(status.is_ok(), tensions.is_ok());
            }
            if let Some(least) = row[3].as_f64() {
                independent += 1;
                let norm = tensions.unwrap().tensions.iter().map(|t| t * t).sum::<f64>().sqrt();
                accept("V-CAPACITY-006", (norm / least - 1.0).abs());
            }
        }
        println!(
            "{payload} kg: held at {kept} positions with the lengths kept, at {recomputed} with the tensions \
            recomputed, at {independent} by the independent program"
        );
        assert!(recomputed >= independent && independent > 0);
    }
}

#[test]
fn a_platform_with_an_inertia_swings_with_its_cables_under_the_load() {
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
            further: Further::default(),
        };
        let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
        let summary = WorkspaceSummary::new(&workspace, &poses);
        let mut lowest = f64::INFINITY;
        for (found, row) in poses.iter().zip(&summary.rows) {
            let Ok(held) = &found.outcome else { continue };
            let swing = held.swing.unwrap();
            assert_eq!(row.lowest_frequency_hz, Some(swing.lowest));
            assert_eq!(
                (row.platform_frequency_hz, row.platform_share),
                (Some(swing.platform), Some(swing.platform_share))
            );
            // The lengths are those without the load.
            let exact = deflection(&robot, &found.pose, &load).unwrap();
            let problem = DirectProblem::new(&robot, &exact.lengths, &load).unwrap();
            let modes = Modes::new(&problem, &exact.loaded.equilibrium, Wanted::Number(1)).unwrap().modes;
            assert!((modes[0].frequency / swing.lowest - 1.0).abs() < 2e-6);
            lowest = lowest.min(swing.lowest);
        }
        println!("{} kg: {lowest} Hz", load.payload);
        assert_eq!(summary.lowest_frequency_hz.unwrap().min, lowest);
    }
}

#[test]
fn further_columns_are_what_is_said_of_each_pose() {
    let robot = caroca();
    let set = WrenchSet::of(Vec::new());
    let tilt = TiltDirections { count: 4, accuracy: 1e-3 };
    let load = Load::payload(20.0);
    let workspace = Workspace {
        robot: &robot,
        grid: grid(),
        rotation: Rotation3::identity(),
        load,
        tolerances: None,
        free: &[],
        further: Further { capacity: Some(&set), distances: true, tilt: Some(tilt), ..Further::default() },
    };
    let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
    let summary = WorkspaceSummary::new(&workspace, &poses);
    for (found, row) in poses.iter().zip(&summary.rows) {
        let pose = &found.pose;
        let capacity = capacity_at(&robot, pose, &load, &set);
        assert_eq!(row.payload_recomputed_kg, capacity.payload_recomputed.ok().map(|figure| figure.value));
        assert_eq!(row.margin_recomputed_n, capacity.margin_recomputed.ok().map(|figure| figure.value));
        let tilt = tilt_at(&robot, pose, &load, 4, 1e-3).ok();
        let least = tilt.as_ref().and_then(|tilt| tilt.least());
        assert_eq!(row.tilt_deg, least.map(|least| least.angle.to_degrees()));
        assert_eq!(row.tilt_deg.is_some(), row.recomputed_status == Some("held"));
        let near = clearance_under(&robot, pose, &load).ok().and_then(|found| found.cables);
        assert_eq!(row.nearest_cables_mm.is_some(), near.is_some());
        if let (Some(found), Some(near)) = (row.nearest_cables_mm, near) {
            // In lanes the tensions have other last digits.
            assert!((found - 1e3 * near.distance).abs() < 1e-6, "{found} and {near:?} mm");
        }
    }
    let crosses = |row: &&WorkspaceRow| {
        let near = [row.nearest_cables_mm, row.nearest_to_platform_mm];
        row.status == "held" && near.into_iter().flatten().any(|near| near < 0.0)
    };
    assert_eq!(summary.crossing, Some(summary.rows.iter().filter(crosses).count()));
    assert!(summary.tilt_deg.unwrap().min > 1.0 && summary.payload_recomputed_kg.unwrap().max > 1000.0);
    let left: usize = summary.left_out.values().sum();
    assert_eq!(left + summary.status["held"], poses.len());
}

#[test]
fn the_platform_is_held_at_the_tilt_reached_and_not_beyond() {
    let robots = [caroca(), Robot::from_json(include_str!("../../../data/robots/cogiro.json")).unwrap()];
    for robot in robots {
        let pose = Pose::at(0.3, -0.2, 1.75);
        let accuracy = 1e-5;
        let tilt = tilt_at(&robot, &pose, &Load::none(), 8, accuracy).unwrap();
        for towards in &tilt.directions {
            let axis = Vector3::new(-towards.azimuth.sin(), towards.azimuth.cos(), 0.0);
            let held = |angle: f64| {
                let tilted = Pose { rotation: Rotation3::new(angle * axis) * pose.rotation, ..pose };
                inverse(&robot, &tilted, &Load::none()).is_ok()
            };
            let angle = towards.angle;
            println!(
                "{}: {:.3} degrees towards {:.0}",
                robot.name,
                angle.to_degrees(),
                towards.azimuth.to_degrees()
            );
            assert!(held(angle));
            // Without a limit it ends at a right angle.
            let is_right = angle == FRAC_PI_2;
            assert!(is_right || !held(angle + 2.0 * accuracy), "{towards:?}");
            assert!((0..20).all(|k| held(angle * f64::from(k) / 20.0)));
            let up = Rotation3::new(angle * axis) * Vector3::z();
            assert!(up.x * towards.azimuth.cos() + up.y * towards.azimuth.sin() > 0.0);
        }
    }
    let mut point = caroca();
    point.platform.point = true;
    point.cables.iter_mut().for_each(|cable| cable.anchor_point = Vector3::zeros());
    let refused = tilt_at(&point, &Pose::at(0.0, 0.0, 1.75), &Load::none(), 8, 1e-3).unwrap_err();
    assert!(refused.to_string().starts_with("platform.point is true"), "{refused}");
}

#[test]
fn the_boundary_runs_between_what_is_held_and_what_is_not() {
    let robot = Robot::from_json(include_str!("../../../data/robots/cogiro.json")).unwrap();
    let axis = |min, max, points| GridAxis { min, max, points };
    let plane =
        |points| Grid::new([axis(-8.0, 8.0, points), axis(-6.0, 6.0, points), axis(1.0, 1.0, 1)]).unwrap();
    let workspace = |grid| Workspace {
        robot: &robot,
        grid,
        rotation: Rotation3::identity(),
        load: Load::payload(100.0),
        tolerances: None,
        free: &[],
        further: Further::default(),
    };
    let coarse = workspace_boundary(&workspace(plane(9)), Way::Recomputed, &|| false).unwrap();
    let fine = workspace_boundary(&workspace(plane(17)), Way::Recomputed, &|| false).unwrap();
    println!("{} +- {} m2, {} +- {} m2", coarse.measure, coarse.error, fine.measure, fine.error);
    assert!((coarse.measure - fine.measure).abs() < coarse.error + fine.error);
    assert!(fine.error < 2e-3 * fine.measure && coarse.error < 1e-2 * coarse.measure);
    let center = Vector3::new(0.0, 0.0, 1.0);
    let held = |p: Vector3<f64>| inverse(&robot, &Pose::at(p.x, p.y, p.z), &Load::payload(100.0)).is_ok();
    let points = &fine.polygons[0];
    assert!(points.len() > 100);
    let between = points.iter().filter(|p| held(center.lerp(p, 0.995)) && !held(center.lerp(p, 1.005)));
    assert!(between.count() > points.len() * 9 / 10);

    let space = Grid::new([axis(-8.0, 8.0, 5), axis(-6.0, 6.0, 5), axis(0.0, 4.0, 3)]).unwrap();
    let mesh = workspace_boundary(&workspace(space), Way::Kept, &|| false).unwrap();
    println!("{} +- {} m3 in {} triangles", mesh.measure, mesh.error, mesh.triangles.len());
    assert!(mesh.measure > 200.0 && mesh.measure < 16.0 * 12.0 * 4.0 && !mesh.triangles.is_empty());
    let open: Vector3<f64> = mesh.triangles.iter().map(|[p, q, r]| (q - p).cross(&(r - p))).sum();
    assert!(open.norm() < 1e-9, "the mesh is closed");

    let line = Grid::new([axis(-1.0, 1.0, 3), axis(0.0, 0.0, 1), axis(1.0, 1.0, 1)]).unwrap();
    let refused = workspace_boundary(&workspace(line), Way::Recomputed, &|| false).unwrap_err();
    assert!(
        refused.to_string().starts_with("grid is [3, 1, 1] points: expected a plane or a box"),
        "{refused}"
    );
}

#[test]
fn a_payload_that_is_missing_at_a_position_that_is_held_has_its_reason() {
    let robot = caroca();
    // No tensions balance so great a force sideways.
    let axis = |at| GridAxis { min: at, max: at, points: 1 };
    let set = WrenchSet::of(vec![Wrench { force: Vector3::new(1e5, 0.0, 0.0), moment: Vector3::zeros() }]);
    let workspace = Workspace {
        robot: &robot,
        grid: Grid::new([axis(0.0), axis(0.0), axis(1.75)]).unwrap(),
        rotation: Rotation3::identity(),
        load: Load::none(),
        tolerances: None,
        free: &[],
        further: Further { capacity: Some(&set), ..Further::default() },
    };
    let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
    for row in &WorkspaceSummary::new(&workspace, &poses).rows {
        assert_eq!((row.status, row.payload_recomputed_kg, row.payload_kept_kg), ("held", None, None));
        let recomputed = row.payload_recomputed_blocked_by.as_ref().unwrap();
        let kept = row.payload_kept_blocked_by.as_ref().unwrap();
        println!("{recomputed}\n{kept}");
        assert!(recomputed.contains("no tensions between") && !kept.is_empty());
    }
}
