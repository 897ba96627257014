//! Maps in lanes: every position is what the scalar models say of it, for robots that differ.

use cdpr_assess::{Further, Workspace, WorkspacePose, compute_workspace};
use cdpr_dynamics::Swing;
use cdpr_robot::{Matrix3, Parameter, Plane, Robot, Rotation3, Vector3, Wrench};
use cdpr_statics::batch::{LoadedPose, PoseSlopes, loaded_poses};
use cdpr_statics::derivatives::derivatives_from;
use cdpr_statics::limits::{OutOfLimits, out_of_limits};
use cdpr_statics::{DirectProblem, Load, StaticsError, deflection, inverse};
use cdpr_study::{Grid, GridAxis};

/// A robot, a box of x, y and z with numbers of points, and a load.
struct Map {
    name: &'static str,
    robot: Robot,
    axes: [(f64, f64, usize); 3],
    load: Load,
}

const CAROCA: &str = include_str!("../../../data/robots/caroca.json");
const COGIRO: &str = include_str!("../../../data/robots/cogiro.json");

/// Boxes that the border of the workspace runs through, where the robot has one.
fn maps() -> Vec<Map> {
    [changed_robots(), robots_of_the_library()].into_iter().flatten().collect()
}

fn robot(json: &str) -> Robot {
    Robot::from_json(json).unwrap()
}

fn map(name: &'static str, robot: Robot, axes: [(f64, f64, usize); 3], load: Load) -> Map {
    Map { name, robot, axes, load }
}

/// CAROCA and CoGiRo, as they are and changed, under several loads.
fn changed_robots() -> Vec<Map> {
    let force = Wrench { force: Vector3::new(30.0, -20.0, 10.0), moment: Vector3::zeros() };
    let moment = Wrench { moment: Vector3::new(0.0, 0.0, 5.0), ..force };
    let tilted = |json: &str, gravity: Vector3<f64>| Robot { gravity: gravity.into(), ..robot(json) };
    let mut weighed = robot(CAROCA);
    weighed.platform.inertia = Some(Matrix3::new(9.0, 1.0, 0.5, 1.0, 7.0, -0.5, 0.5, -0.5, 8.0));
    weighed.platform.center_of_mass = Vector3::new(0.05, -0.03, 0.1);
    let planar = Robot { plane: Some(Plane::Xz), name: "planar".to_owned(), ..weighed.clone() };
    let mut point = robot(COGIRO);
    point.platform.point = true;
    let mut led = tilted(COGIRO, Vector3::new(-0.3, 0.5, -9.8));
    for (i, cable) in led.cables.iter_mut().enumerate() {
        cable.lead = 1.0 + i as f64;
    }
    vec![
        map("CAROCA", robot(CAROCA), [(-3.4, 3.4, 11), (-1.9, 1.9, 9), (0.6, 3.4, 4)], Load::payload(50.0)),
        map(
            "CAROCA with a law, under force and moment",
            robot(include_str!("../../../data/robots/caroca-law.json")),
            [(-3.0, 3.0, 7), (-1.5, 1.5, 7), (1.0, 2.5, 3)],
            Load { payload: 20.0, wrench: moment },
        ),
        map(
            "CAROCA with an inertia, under force and moment",
            weighed,
            [(-3.0, 3.0, 7), (-1.5, 1.5, 7), (1.0, 2.5, 3)],
            Load { payload: 20.0, wrench: moment },
        ),
        map(
            "CAROCA, tilted, under force and moment",
            tilted(CAROCA, Vector3::new(0.6, -0.3, -9.7)),
            [(-3.4, 3.4, 7), (-1.9, 1.9, 7), (0.6, 3.4, 3)],
            Load { payload: 20.0, wrench: moment },
        ),
        map("CoGiRo", robot(COGIRO), [(-7.0, 7.0, 9), (-5.0, 5.0, 9), (0.5, 4.5, 3)], Load::payload(50.0)),
        map(
            "CAROCA in a plane, with an inertia, under force and moment",
            planar,
            [(-3.4, 3.4, 15), (0.0, 0.0, 1), (0.6, 3.4, 7)],
            Load { payload: 20.0, wrench: moment },
        ),
        map(
            "CoGiRo as a point, under a force",
            point,
            [(-7.0, 7.0, 9), (-5.0, 5.0, 9), (0.5, 4.5, 3)],
            Load { payload: 50.0, wrench: force },
        ),
        map(
            "CoGiRo behind leads, tilted",
            led,
            [(-7.0, 7.0, 7), (-5.0, 5.0, 7), (0.5, 4.5, 3)],
            Load::payload(50.0),
        ),
    ]
}

/// Other robots of the library under payloads.
fn robots_of_the_library() -> Vec<Map> {
    vec![
        map(
            "FAST",
            robot(include_str!("../../../data/robots/fast.json")),
            [(-30.0, 30.0, 9), (-30.0, 30.0, 9), (140.1, 140.1, 1)],
            Load::payload(3000.0),
        ),
        map(
            "FAST without a load",
            robot(include_str!("../../../data/robots/fast.json")),
            [(-15.0, 15.0, 5), (-15.0, 15.0, 5), (140.1, 140.1, 1)],
            Load::none(),
        ),
        map(
            "IPAnema 1",
            robot(include_str!("../../../data/robots/ipanema-1.json")),
            [(-1.5, 1.5, 7), (-1.0, 1.0, 7), (0.5, 1.5, 3)],
            Load::payload(2.5),
        ),
        map(
            "IPAnema 2, over pulleys",
            robot(include_str!("../../../data/robots/ipanema-2.json")),
            [(-2.0, 2.0, 7), (-1.0, 1.0, 7), (0.5, 2.5, 3)],
            Load::payload(5.0),
        ),
        map(
            "HRPCables, over pulleys",
            robot(include_str!("../../../data/robots/hrpcables.json")),
            [(-3.0, 3.0, 7), (-2.0, 2.0, 7), (0.5, 2.5, 3)],
            Load::payload(20.0),
        ),
        map(
            "SEGESTA",
            robot(include_str!("../../../data/robots/segesta.json")),
            [(0.1, 0.6, 6), (0.1, 0.6, 6), (0.2, 0.6, 2)],
            Load::payload(0.1),
        ),
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

/// That of SEGESTA: forces balance to 1e-12 of their sum, of which its least tensions are a thousandth.
const SAME_OF_LIGHT_TENSIONS: f64 = 1e-8;

#[test]
fn a_map_says_of_each_position_what_the_scalar_models_say() {
    for Map { name, robot, axes, load } in maps() {
        let workspace = workspace(&robot, axes, load);
        let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
        let held = poses.iter().filter(|pose| pose.outcome.is_ok()).count();
        println!("{name}: {held} of {} positions held", poses.len());
        assert!(held > 10);
        let list: Vec<_> = poses.iter().map(|pose| pose.pose).collect();
        let wanted: Vec<_> = inverse(&robot, &list, &Load::none()).into_iter().flatten().collect();
        let in_lanes = wanted.iter().filter(|wanted| wanted.iterations == 0).count();
        let loaded = loaded_poses::<LoadedPose>(&robot, &wanted.iter().collect::<Vec<_>>(), &load);
        let settled = loaded.into_iter().flatten().filter(|loaded| loaded.scalar.is_none()).count();
        println!("in lanes: {in_lanes} inverse, {settled} loaded of {}", wanted.len());
        assert!(in_lanes > 0 && 2 * settled > wanted.len());
        for pose in &poses {
            let most = if name == "SEGESTA" { SAME_OF_LIGHT_TENSIONS } else { SAME };
            check(&robot, &load, pose, most)
                .unwrap_or_else(|what| panic!("{name} at {:?}: {what}", pose.pose));
        }
    }
}

#[test]
fn derivatives_over_poses_are_those_of_the_scalar_models() {
    for Map { name, robot, axes, load } in maps() {
        let workspace = workspace(&robot, axes, load);
        let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
        let list: Vec<_> = poses.iter().map(|pose| pose.pose).collect();
        let wanted: Vec<_> = inverse(&robot, &list, &Load::none()).into_iter().flatten().collect();
        let parameters = Parameter::of(&robot);
        let size = robot.platform_size();
        let range = |parameter: &Parameter| match parameter {
            Parameter::Mass => 0.05 * robot.platform.mass,
            Parameter::LinearDensity => 0.1 * robot.cables[0].properties.linear_density,
            Parameter::YoungsModulus => 0.2 * robot.cables[0].properties.youngs_modulus,
            Parameter::TensionOffset(_) => 0.04 * robot.platform.mass,
            Parameter::Gravity(_) => 0.05,
            Parameter::Tilt(..) => 0.01,
            _ => 0.01 * size,
        };
        let ranges: Vec<f64> = parameters.iter().map(range).collect();
        let (mut in_lanes, mut worst, mut compared) = (0, 0.0_f64, 0);
        let references: Vec<_> = wanted.iter().collect();
        for (wanted, found) in wanted.iter().zip(loaded_poses::<PoseSlopes>(&robot, &references, &load)) {
            let alone = derivatives_from(&robot, wanted.equilibrium.pose, &load, wanted.clone());
            let (found, alone) = match (found, alone) {
                (Ok(found), Ok(alone)) => (found, alone),
                (Ok(found), Err(StaticsError::NoDerivative { .. })) => {
                    assert_eq!(found.magnitude, None, "{name}");
                    continue;
                }
                (found, alone) => {
                    assert_eq!(found.err().map(|e| e.kind()), alone.err().map(|e| e.kind()), "{name}");
                    continue;
                }
            };
            in_lanes += usize::from(found.loaded.scalar.is_none());
            let (Some(slopes), Ok(alone)) = (found.magnitude, alone.magnitude()) else { continue };
            assert_eq!(slopes.len(), parameters.len());
            let each = || slopes.iter().zip(&alone).zip(&ranges);
            let largest =
                each().fold(0.0_f64, |largest, ((_, slope), range)| largest.max((slope * range).abs()));
            let error =
                each().fold(0.0_f64, |worst, ((one, other), range)| worst.max((one - other).abs() * range));
            assert!(error <= 1e-7 * largest, "{name}: {error:e} of {largest:e}");
            worst = worst.max(error / largest);
            compared += 1;
        }
        println!("{name}: {in_lanes} of {} in lanes, {compared} compared, {worst:.1e}", wanted.len());
        assert!(load == Load::none() || 2 * in_lanes > wanted.len(), "{name}");
    }
}

#[test]
fn threads_change_no_bit_of_a_map() {
    for Map { name, robot, axes, load } in maps() {
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
fn check(robot: &Robot, load: &Load, found: &WorkspacePose, most: f64) -> Result<(), String> {
    let same = |what: &str, one: f64, other: f64| {
        let is_same = (one - other).abs() <= most * other.abs();
        if is_same { Ok(()) } else { Err(format!("{what}: {one} for {other}")) }
    };
    let failures = |what: &str, one: Option<&StaticsError>, other: Option<&StaticsError>| {
        let (one, other) = (one.map(StaticsError::kind), other.map(StaticsError::kind));
        if one == other { Ok(()) } else { Err(format!("{what}: {one:?} for {other:?}")) }
    };
    let recomputed = (*load != Load::none()).then(|| inverse(robot, &found.pose, load));
    failures(
        "recomputed",
        found.recomputed.as_ref().and_then(|recomputed| recomputed.as_ref().err()),
        recomputed.as_ref().and_then(|recomputed| recomputed.as_ref().err()),
    )?;
    if let (Some(Ok(found)), Some(Ok(recomputed))) = (&found.recomputed, recomputed) {
        same(
            "least tension recomputed",
            found.least_tension,
            recomputed.tensions.iter().copied().fold(f64::MAX, f64::min),
        )?;
        same(
            "greatest tension recomputed",
            found.greatest_tension,
            recomputed.tensions.iter().copied().fold(0.0, f64::max),
        )?;
    }
    let kept = deflection(robot, &found.pose, load);
    failures("kept", found.outcome.as_ref().err(), kept.as_ref().err())?;
    let (Ok(held), Ok(kept)) = (&found.outcome, kept) else { return Ok(()) };
    let both = [&kept.unloaded, &kept.loaded];
    let tensions: Vec<f64> = both.iter().flat_map(|solution| solution.equilibrium.tensions()).collect();
    same("least tension", held.least_tension, tensions.iter().copied().fold(f64::MAX, f64::min))?;
    same("greatest tension", held.greatest_tension, tensions.iter().copied().fold(0.0, f64::max))?;
    let (one, other) = (held.displacement, kept.displacement());
    if *load != Load::none() {
        same("displacement", other.norm() + (one - other).norm(), other.norm())?;
    }
    same("least stiffness", held.least_stiffness, kept.loaded.stability.least_stiffness())?;
    let problem = DirectProblem::new(robot, &kept.lengths, load).map_err(|error| error.to_string())?;
    match (held.swing, Swing::new(&problem, &kept.loaded.equilibrium)) {
        (Some(one), Ok(other)) => {
            same("lowest frequency", one.lowest, other.lowest)?;
            same("frequency of the platform", one.platform, other.platform)?;
        }
        (None, Err(_)) => (),
        (one, other) => return Err(format!("frequencies {one:?} for {other:?}")),
    }
    let equilibria = both.map(|solution| &solution.equilibrium);
    let named = |list: &[OutOfLimits]| list.iter().map(|o| (o.cable, o.end, o.limit)).collect::<Vec<_>>();
    let limits = out_of_limits(robot, &kept.lengths, &equilibria);
    if named(&held.out_of_limits) != named(&limits) {
        return Err(format!("out of limits {:?} for {limits:?}", held.out_of_limits));
    }
    if held.slack != kept.loaded.report.slack {
        return Err(format!("slack {:?} for {:?}", held.slack, kept.loaded.report.slack));
    }
    Ok(())
}
