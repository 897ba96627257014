//! Maps in lanes: every position is what the scalar models say of it, for robots that differ.

use cdpr_assess::{Further, Workspace, WorkspacePose, compute_workspace};
use cdpr_robot::{Robot, Rotation3, Vector3, Wrench};
use cdpr_statics::{Load, StaticsError, deflection, inverse};
use cdpr_study::{Grid, GridAxis};

/// A robot, a box of x, y and z with numbers of points, and a load.
struct Map {
    name: &'static str,
    robot: &'static str,
    axes: [(f64, f64, usize); 3],
    load: Load,
}

/// Boxes that the border of the workspace runs through, where the robot has one.
fn maps() -> Vec<Map> {
    let pull = Load {
        payload: 20.0,
        wrench: Wrench { force: Vector3::new(30.0, -20.0, 10.0), moment: Vector3::new(0.0, 0.0, 5.0) },
    };
    vec![
        Map {
            name: "CAROCA",
            robot: include_str!("../../../data/robots/caroca.json"),
            axes: [(-3.4, 3.4, 11), (-1.9, 1.9, 9), (0.6, 3.4, 4)],
            load: Load::payload(50.0),
        },
        Map {
            name: "CAROCA with a law, under force and moment",
            robot: include_str!("../../../data/robots/caroca-law.json"),
            axes: [(-3.0, 3.0, 7), (-1.5, 1.5, 7), (1.0, 2.5, 3)],
            load: pull,
        },
        Map {
            name: "CoGiRo",
            robot: include_str!("../../../data/robots/cogiro.json"),
            axes: [(-7.0, 7.0, 9), (-5.0, 5.0, 9), (0.5, 4.5, 3)],
            load: Load::payload(50.0),
        },
        Map {
            name: "FAST",
            robot: include_str!("../../../data/robots/fast.json"),
            axes: [(-30.0, 30.0, 9), (-30.0, 30.0, 9), (140.1, 140.1, 1)],
            load: Load::payload(3000.0),
        },
        Map {
            name: "IPAnema 1",
            robot: include_str!("../../../data/robots/ipanema-1.json"),
            axes: [(-1.5, 1.5, 7), (-1.0, 1.0, 7), (0.5, 1.5, 3)],
            load: Load::payload(2.5),
        },
        Map {
            name: "SEGESTA, over pulleys or not",
            robot: include_str!("../../../data/robots/segesta.json"),
            axes: [(0.1, 0.6, 6), (0.1, 0.6, 6), (0.2, 0.6, 2)],
            load: Load::payload(0.1),
        },
    ]
}

fn workspace(robot: &Robot, axes: [(f64, f64, usize); 3], load: Load) -> Workspace<'_> {
    Workspace {
        robot,
        grid: Grid::new(axes.map(|(min, max, points)| GridAxis { min, max, points })).unwrap(),
        rotation: Rotation3::identity(),
        load,
        tolerances: None,
        free: &[],
        further: Further::default(),
    }
}

/// The greatest relative difference of two positive numbers that a map may show.
const SAME: f64 = 1e-9;

#[test]
fn a_map_says_of_each_position_what_the_scalar_models_say() {
    for Map { name, robot, axes, load } in maps() {
        let robot = Robot::from_json(robot).unwrap();
        let workspace = workspace(&robot, axes, load);
        let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
        let held = poses.iter().filter(|pose| pose.outcome.is_ok()).count();
        println!("{name}: {held} of {} positions held", poses.len());
        assert!(held > 10);
        for pose in &poses {
            check(&robot, &load, pose).unwrap_or_else(|what| panic!("{name} at {:?}: {what}", pose.pose));
        }
    }
}

#[test]
fn threads_change_no_bit_of_a_map() {
    for Map { name, robot, axes, load } in maps() {
        let robot = Robot::from_json(robot).unwrap();
        let workspace = workspace(&robot, axes, load);
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| compute_workspace(&workspace, &|| (), &|| false).unwrap())
        };
        let one = on(1);
        assert!([2, 3].into_iter().all(|threads| on(threads) == one), "{name}");
    }
}

/// What differs, if anything does.
fn check(robot: &Robot, load: &Load, found: &WorkspacePose) -> Result<(), String> {
    let offsets = vec![0.0; robot.cables.len()];
    let same = |what: &str, one: f64, other: f64| {
        let is_same = (one - other).abs() <= SAME * other.abs();
        if is_same { Ok(()) } else { Err(format!("{what}: {one} for {other}")) }
    };
    let failures = |what: &str, one: Option<&StaticsError>, other: Option<&StaticsError>| {
        let (one, other) = (one.map(StaticsError::kind), other.map(StaticsError::kind));
        if one == other { Ok(()) } else { Err(format!("{what}: {one:?} for {other:?}")) }
    };
    let anew = inverse(robot, &found.pose, load, None);
    let found_anew = found.anew.as_ref().unwrap();
    failures("anew", found_anew.as_ref().err(), anew.as_ref().err())?;
    if let (Ok(found), Ok(anew)) = (found_anew, anew) {
        same(
            "least tension anew",
            found.least_tension,
            anew.tensions.iter().copied().fold(f64::MAX, f64::min),
        )?;
        same(
            "greatest tension anew",
            found.greatest_tension,
            anew.tensions.iter().copied().fold(0.0, f64::max),
        )?;
    }
    let kept = deflection(robot, &found.pose, &offsets, load);
    failures("kept", found.outcome.as_ref().err(), kept.as_ref().err())?;
    let (Ok(held), Ok(kept)) = (&found.outcome, kept) else { return Ok(()) };
    let both = [&kept.unloaded, &kept.loaded];
    let tensions: Vec<f64> = both.iter().flat_map(|solution| solution.equilibrium.tensions()).collect();
    same("least tension", held.least_tension, tensions.iter().copied().fold(f64::MAX, f64::min))?;
    same("greatest tension", held.greatest_tension, tensions.iter().copied().fold(0.0, f64::max))?;
    let (one, other) = (held.displacement, kept.displacement());
    same("displacement", other.norm() + (one - other).norm(), other.norm())?;
    same("least stiffness", held.least_stiffness, kept.loaded.stability.least_stiffness())?;
    if held.slack != kept.loaded.report.slack {
        return Err(format!("slack {:?} for {:?}", held.slack, kept.loaded.report.slack));
    }
    Ok(())
}
