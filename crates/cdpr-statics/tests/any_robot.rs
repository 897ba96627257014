//! The direct model over random robots, poses, lengths, loads and starts: an equilibrium to rounding, or an
//! outcome that is true.

use cdpr_cable::CableError;
use cdpr_robot::{
    CableEnd, CableProperties, Plane, Platform, Pose, Pulley, Robot, RobotCable, Rotation3, TensionLimits,
    Vector3, Wrench,
};
use cdpr_statics::{DirectProblem, DirectStart, Load, StaticsError, direct};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// `CDPR_CASES` takes the place of this number and of the next one.
const CASES: u64 = 20_000;

/// Robots as they are built are slower.
const CASES_AS_BUILT: u64 = 4_000;

/// Every so many answers one is certified.
const CERTIFIED: u64 = 10;

/// A robot with cables wound out, loaded, and where the search for its pose begins.
struct Case {
    robot: Robot,
    lengths: Vec<f64>,
    load: Load,
    start: Pose,
}

fn log_uniform(rng: &mut ChaCha8Rng, from: f64, to: f64) -> f64 {
    from * (to / from).powf(rng.random::<f64>())
}

fn direction(rng: &mut ChaCha8Rng) -> Vector3<f64> {
    loop {
        let v = Vector3::from_fn(|_, _| rng.random_range(-1.0..1.0));
        if (0.1..1.0).contains(&v.norm()) {
            return v.normalize();
        }
    }
}

/// Robots of 1 m to 300 m, suspended or held from all sides; steel to rubber, light to heavy cables; taut to
/// slack.
fn case(seed: u64) -> Case {
    let rng = &mut ChaCha8Rng::seed_from_u64(seed);
    let n = rng.random_range(6..=16);
    let size = log_uniform(rng, 1.0, 300.0);
    let platform = size * log_uniform(rng, 0.02, 0.3);
    let mass = log_uniform(rng, 0.1, 100.0) * size;
    let weight = mass * 9.81;
    let suspended = rng.random_bool(0.5);
    // All cables together weigh from a ten thousandth of the platform to ten times as much.
    let density = log_uniform(rng, 1e-4, 10.0) * mass / (size * n as f64);
    // The platform's weight stretches one cable by 1e-6 to 1e-2 of its length.
    let modulus = weight / log_uniform(rng, 1e-6, 1e-2) / 1e-5;
    let properties = CableProperties::linear(1e-5, density, modulus);
    let cables = (0..n)
        .map(|_| {
            let exit = Vector3::from_fn(|_, _| rng.random_range(-0.5..0.5) * size);
            let height = if suspended { 0.5 * size * (1.0 + 0.2 * exit.z / size) } else { exit.z };
            RobotCable::between(
                Vector3::new(exit.x, exit.y, height),
                Vector3::from_fn(|_, _| rng.random_range(-0.5..0.5) * platform),
                properties.clone(),
            )
        })
        .collect();
    let center_of_mass = Vector3::from_fn(|_, _| rng.random_range(-0.2..0.2) * platform);
    let robot = Robot {
        name: format!("random robot {seed}"),
        provenance: Default::default(),
        gravity: 9.81.into(),
        platform: Platform::new(mass, center_of_mass),
        tension_limits: TensionLimits { min: 1.0, max: 1e9 },
        max_at: CableEnd::Anchor,
        ground_z: None,
        plane: None,
        tension_reference: None,
        distribution: Default::default(),
        cables,
    };
    let position = Vector3::from_fn(|_, _| rng.random_range(-0.3..0.3) * size);
    let turn = direction(rng) * rng.random_range(0.0..0.5);
    let pose = Pose { position, rotation: Rotation3::new(turn) };
    let looseness = [1e-4, 1e-2, 0.3][rng.random_range(0..3)];
    let lengths = (0..n)
        .map(|i| robot.span(&pose, i).norm() * (1.0 + looseness * rng.random_range(-0.05..1.0)))
        .collect();
    let away = [0.003, 0.05, 0.5][rng.random_range(0..3)];
    let start = pose.moved(direction(rng) * away * size, direction(rng) * (2.0 * away).min(3.0));
    let wrench = if rng.random_bool(0.3) {
        let force = direction(rng) * weight * rng.random_range(0.0..0.5);
        let moment = direction(rng) * weight * platform * 0.1 * f64::from(u8::from(rng.random_bool(0.3)));
        Wrench { force, moment }
    } else {
        Wrench::none()
    };
    let payload = if rng.random_bool(0.5) { mass * rng.random_range(0.0..0.5) } else { 0.0 };
    Case { robot, lengths, load: Load { payload, wrench }, start }
}

/// The same with what real robots have: pulleys with vertical and tilted axes, leads, one to five cables, a
/// base that is not level, point masses and planes.
fn as_built(seed: u64) -> Case {
    let rng = &mut ChaCha8Rng::seed_from_u64(seed);
    let Case { mut robot, mut lengths, mut load, mut start } = case(seed);
    robot.name = format!("robot {seed} as built");
    if rng.random_bool(0.5) {
        let n = rng.random_range(1..=5);
        robot.cables.truncate(n);
        lengths.truncate(n);
    }
    if rng.random_bool(0.3) {
        let tilt = direction(rng) * 3.0;
        robot.gravity = Vector3::new(tilt.x, tilt.y, -9.2 + 0.1 * tilt.z).into();
    }
    match rng.random_range(0..6) {
        0 => {
            robot.platform.point = true;
            robot.platform.center_of_mass = Vector3::zeros();
            robot.cables.iter_mut().for_each(|cable| cable.anchor_point = Vector3::zeros());
            start.rotation = Rotation3::identity();
            load.wrench.moment = Vector3::zeros();
        }
        1 => {
            robot.plane = Some(Plane::Xz);
            start.rotation = Rotation3::new(Vector3::new(0.0, start.rotation.scaled_axis().y, 0.0));
        }
        _ => {}
    }
    let span = lengths.iter().copied().fold(f64::INFINITY, f64::min);
    let radius = rng.random_bool(0.7).then(|| log_uniform(rng, 1e-3, 0.05) * span);
    let (tilted, led) = (rng.random_bool(0.5), rng.random_bool(0.5));
    for (cable, length) in robot.cables.iter_mut().zip(&mut lengths) {
        if led {
            cable.lead = log_uniform(rng, 0.01, 1.0) * span;
            *length += cable.lead;
        }
        if let Some(radius) = radius {
            let upright = Vector3::z() * if cable.exit_point.z > start.position.z { 1.0 } else { -1.0 };
            let axis = if tilted { upright + 0.5 * direction(rng) } else { upright };
            cable.pulley = Some(Pulley { radius, axis });
            *length += 0.5 * std::f64::consts::PI * radius;
        }
    }
    let pulleys = ["upright", "tilted"][usize::from(tilted)];
    robot.name = format!(
        "{}: {} cables, {}, {}, {}{}",
        robot.name,
        robot.cables.len(),
        if robot.platform.point {
            "point"
        } else if robot.plane.is_some() {
            "planar"
        } else {
            "space"
        },
        radius.map_or("no pulleys", |_| pulleys),
        if led { "led, " } else { "" },
        if robot.gravity.level().is_some() { "not level" } else { "level" },
    );
    Case { robot, lengths, load, start }
}

/// What became of a case; the certificate of an equilibrium beside it.
fn outcome(case: &Case, certified: bool) -> (String, Option<String>) {
    let Case { robot, lengths, load, start } = case;
    let weight = (robot.platform.mass + load.payload) * robot.gravity.magnitude();
    let size = lengths.iter().copied().fold(0.0, f64::max);
    match direct(robot, lengths, load, DirectStart::Pose(start)) {
        Ok(found) => {
            let residual = found.report.residual;
            assert!(
                residual.force <= 1e-8 * weight
                    && residual.moment <= 1e-8 * weight * size
                    && residual.closure <= 1e-10 * size,
                "{}: {residual:?}",
                robot.name
            );
            assert!(found.stability.is_stable() && found.stability.least_stiffness() > 0.0, "{}", robot.name);
            let prove = || match DirectProblem::new(robot, lengths, load).unwrap().certify(&found) {
                Ok(proof) => {
                    assert!(proof.position <= 1e-6 * size, "{}: {proof:?}", robot.name);
                    if proof.is_stable() { "proved, stable" } else { "proved, stability open" }.to_owned()
                }
                Err(error) => error.to_string().split(" (").next().unwrap().to_owned(),
            };
            (format!("stable equilibrium by {:?}", found.report.method), certified.then(prove))
        }
        Err(error @ StaticsError::Overstrained { index, length, distance, strain }) => {
            assert!(strain > 0.1 && distance > length && length == lengths[index], "{}: {error}", robot.name);
            (error.kind().to_owned(), None)
        }
        // A moment is not conservative: the platform may turn for ever, and only then is there no minimum.
        Err(error) => {
            assert!(load.wrench.moment != Vector3::zeros(), "{}: {error}", robot.name);
            let StaticsError::EquilibriumLost { share, .. } = error else {
                panic!("{}: {error}", robot.name)
            };
            assert!((0.0..1.0).contains(&share), "{}: {error}", robot.name);
            (error.kind().to_owned(), None)
        }
    }
}

fn cases(usual: u64) -> u64 {
    std::env::var("CDPR_CASES").map_or(usual, |cases| cases.parse().unwrap())
}

#[test]
fn any_robot_as_it_is_built_finds_an_equilibrium_or_says_truly_why_not() {
    let cases = cases(CASES_AS_BUILT);
    let outcomes: Vec<_> = (0..cases).into_par_iter().map(|seed| outcome_as_built(&as_built(seed))).collect();
    let mut counts = BTreeMap::<&str, u64>::new();
    for outcome in outcomes {
        *counts.entry(outcome).or_default() += 1;
    }
    println!("{cases} random robots as they are built:");
    for (outcome, count) in &counts {
        println!("{count:8} {outcome}");
    }
    let of = |outcome: &str| counts.get(outcome).copied().unwrap_or_default();
    assert!(of("stable equilibrium") >= cases * 92 / 100, "{counts:?}");
    // A cable of a robot that hangs on one may end where it would lean back towards the axis of its pulley.
    assert!(of("below a pulley") <= cases * 3 / 100, "{counts:?}");
    assert!(of("not converged") <= cases / 500, "{counts:?}");
}

/// What became of a case of [`as_built`].
fn outcome_as_built(case: &Case) -> &'static str {
    let Case { robot, lengths, load, start } = case;
    let name = &robot.name;
    match direct(robot, lengths, load, DirectStart::Pose(start)) {
        Ok(found) => {
            let weight = (robot.platform.mass + load.payload) * robot.gravity.magnitude();
            let (size, residual) = (lengths.iter().copied().fold(0.0, f64::max), found.report.residual);
            assert!(residual.force <= 1e-8 * weight, "{name}: {residual:?}");
            assert!(residual.moment <= 1e-8 * weight * size, "{name}: {residual:?}");
            assert!(residual.closure <= 1e-10 * size, "{name}: {residual:?}");
            assert!(found.stability.is_stable(), "{name}");
            let motions = found.stability.eigenvalues().len() + found.stability.neutral().len();
            assert_eq!(motions, robot.freedoms().count(), "{name}");
            "stable equilibrium"
        }
        Err(StaticsError::Overstrained { .. }) => "overstrained",
        Err(StaticsError::EquilibriumLost { .. }) => {
            assert!(load.wrench.moment != Vector3::zeros(), "{name}");
            "equilibrium lost"
        }
        Err(StaticsError::Cable { source: CableError::AtPulley { .. }, .. }) => "below a pulley",
        Err(StaticsError::Indifferent { .. }) => {
            // It hangs straight down from a pulley that is free to swivel.
            assert!(robot.cables.len() == 1 && robot.cables[0].pulley.is_some(), "{name}");
            "indifferent"
        }
        Err(error) => {
            println!("{name}: {error}");
            "not converged"
        }
    }
}

#[test]
fn any_robot_finds_an_equilibrium_or_says_truly_why_not() {
    let cases = cases(CASES);
    let outcomes: Vec<_> =
        (0..cases).into_par_iter().map(|seed| outcome(&case(seed), seed % CERTIFIED == 0)).collect();
    let mut counts = BTreeMap::<String, u64>::new();
    for (outcome, proof) in outcomes {
        *counts.entry(outcome).or_default() += 1;
        if let Some(proof) = proof {
            *counts.entry(format!("    {proof}")).or_default() += 1;
        }
    }
    println!("{cases} random robots, lengths, loads and starts:");
    for (outcome, count) in &counts {
        println!("{count:8} {outcome}");
    }
    let found = counts
        .iter()
        .filter(|(outcome, _)| outcome.starts_with("stable equilibrium"))
        .map(|(_, n)| n)
        .sum::<u64>();
    assert!(found >= cases * 98 / 100, "{counts:?}");
    let proved: u64 =
        counts.iter().filter(|(outcome, _)| outcome.starts_with("    proved")).map(|(_, n)| n).sum();
    assert!(proved >= cases / CERTIFIED * 98 / 100, "{counts:?}");
}
