//! Deflections stay on the branch of the unloaded platform, or say where it ends.

use crate::common::{alone, caroca, cogiro, ipanema, observed, stadium, suspended};
use cdpr_robot::{ParameterLayout, Platform, Pose, Pulley, Robot, RobotCable, Rotation3, Vector3, Wrench};
use cdpr_statics::batch::{LoadedPose, Observation, loaded_poses};
use cdpr_statics::continuation::follow_load;
use cdpr_statics::{
    DirectMethod, DirectProblem, DirectSolution, DirectStart, InverseSolution, Load, Observer, StaticsError,
    Unstable, deflection, deflection_from, inverse,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// (dp, ℓ dφ) over the longest cable.
fn away(robot: &Robot, size: f64, from: &DirectSolution, to: &DirectSolution) -> f64 {
    let mut motion = from.equilibrium.pose.motion_to(&to.equilibrium.pose);
    motion.fixed_rows_mut::<3>(3).scale_mut(robot.platform_size());
    motion.norm() / size
}

/// The equilibrium under a load that grows in small shares, each of which moves the platform little, or the
/// share at which this ends.
fn crept(
    robot: &Robot,
    lengths: &[f64],
    unloaded: &DirectSolution,
    load: &Load,
) -> Result<DirectSolution, f64> {
    let size = lengths.iter().copied().fold(0.0, f64::max);
    let at = |share: f64| Load {
        payload: share * load.payload,
        wrench: Wrench { force: load.wrench.force * share, moment: load.wrench.moment * share },
    };
    let (mut share, mut step, mut now) = (0.0, 2e-3, unloaded.clone());
    while share < 1.0 {
        let next = f64::min(share + step, 1.0);
        let load = at(next);
        let problem = DirectProblem::new(robot, lengths, &load).unwrap();
        let found =
            problem.with_unstable(Unstable::Accepted).direct(DirectStart::Near(&now.equilibrium)).ok();
        match found.filter(|found| found.stability.is_stable() && away(robot, size, &now, found) < 1e-3) {
            Some(found) => {
                (share, now) = (next, found);
                step = f64::min(2.0 * step, 2e-3);
            }
            None if step > 1e-8 => step *= 0.5,
            None => return Err(share),
        }
    }
    Ok(now)
}

fn drawn_load(rng: &mut ChaCha8Rng, robot: &Robot, most: f64) -> Load {
    let weight = most * 9.81 * robot.platform.mass;
    let arm = robot.platform_size();
    let mut draw = |most: f64| Vector3::from_fn(|_, _| most * rng.random_range(-1.0..1.0));
    let wrench = Wrench { force: draw(weight), moment: draw(weight * arm) };
    Load { payload: rng.random_range(0.0..0.5) * robot.platform.mass, wrench }
}

fn guided() -> Robot {
    let mut robot = cogiro();
    for cable in &mut robot.cables {
        (cable.pulley, cable.lead) = (Some(Pulley { radius: 0.1, axis: Vector3::z() }), 1.0);
    }
    robot
}

/// Robots, each with a pose around which it is loaded, and forces over its weight.
fn loaded_robots() -> [(&'static str, Robot, Pose, f64); 6] {
    [
        ("suspended", suspended(), Pose::at(0.0, 0.0, 1.6), 1.5),
        ("CoGiRo", cogiro(), Pose::at(0.2, 0.1, 1.8), 0.5),
        ("CAROCA", caroca(), Pose::at(0.2, 0.1, 1.8), 1.0),
        ("sagging", stadium(), Pose::at(3.0, -2.0, 10.0), 0.5),
        ("light and prestressed", ipanema(), Pose::at(0.2, 0.1, 1.0), 3.0),
        ("over pulleys", guided(), Pose::at(0.2, 0.1, 1.8), 0.5),
    ]
}

/// A held pose near `centre`.
fn drawn_pose(rng: &mut ChaCha8Rng, robot: &Robot, centre: &Pose) -> InverseSolution {
    let reach = robot.platform_size().min(1.0);
    loop {
        let mut draw = |most: f64| Vector3::from_fn(|_, _| most * rng.random_range(-1.0..1.0));
        let pose = centre.moved(draw(reach), draw(0.1));
        if let Ok(wound) = inverse(robot, &pose, &Load::none()) {
            return wound;
        }
    }
}

#[test]
fn a_deflection_is_that_of_fine_steps_or_ends_where_they_end() {
    for (name, robot, centre, most) in loaded_robots() {
        let mut rng = ChaCha8Rng::seed_from_u64(7);
        let (mut newton, mut continued, mut ended) = (0, 0, 0);
        for _ in 0..14 {
            let wound = drawn_pose(&mut rng, &robot, &centre);
            let load = drawn_load(&mut rng, &robot, most);
            let found = deflection_from(&robot, wound.lengths.clone(), &load, &wound.equilibrium);
            let problem = DirectProblem::new(&robot, &wound.lengths, &Load::none()).unwrap();
            let unloaded = problem
                .with_unstable(Unstable::Refused)
                .direct(DirectStart::Near(&wound.equilibrium))
                .unwrap();
            match (found, crept(&robot, &wound.lengths, &unloaded, &load)) {
                (Ok(found), Ok(crept)) => {
                    let apart = away(&robot, 1.0, &found.loaded, &crept);
                    assert!(apart < 1e-7, "{name}: {apart} m from the branch under {load:?}");
                    match found.loaded.report.method {
                        DirectMethod::Newton => newton += 1,
                        _ => continued += 1,
                    }
                }
                (Err(StaticsError::BranchEnds(end)), Err(share)) => {
                    assert!((end.share - share).abs() < 1e-5, "{name}: {end}, and not at {share}");
                    ended += 1;
                }
                (found, crept) => panic!("{name}: {:?}, {:?}", found.err(), crept.err()),
            }
        }
        println!("{name}: {newton} by Newton's method, {continued} by continuation, {ended} end");
        assert!(newton > 0 && (name != "suspended" || ended > 3), "{name}");
    }
}

#[test]
fn a_platform_that_falls_on_the_way_says_at_which_share_of_the_load_and_where_to() {
    let robot = suspended();
    let [roll, pitch, yaw] = [3.0, -4.0, 6.0].map(f64::to_radians);
    let rotation = Rotation3::from_euler_angles(roll, pitch, yaw);
    let pose = Pose { position: Vector3::new(0.6, -0.4, 1.6), rotation };
    let under = |s: f64| {
        let wrench = Wrench { force: Vector3::zeros(), moment: s * Vector3::new(400.0, -300.0, 100.0) };
        deflection(&robot, &pose, &Load { payload: 2.0 * s, wrench })
    };
    let before = under(0.92).unwrap();
    assert!((1e3 * before.displacement() - Vector3::new(-11.8, 43.9, 79.7)).norm() < 0.1);
    for s in [0.925, 1.0, 2.0] {
        let error = under(s).unwrap_err();
        assert_eq!(error.kind(), "branch_ends");
        let StaticsError::BranchEnds(end) = &error else { panic!("{error}") };
        assert!((end.share * s - 0.9225).abs() < 0.0025, "{}", end.share * s);
        // It was near where it stood shortly before, and falls to where the smallest steps downhill lead.
        let last = before.loaded.equilibrium.pose.motion_to(&end.pose).norm();
        let fallen = end.falls_to.as_ref().unwrap();
        let turned = end.pose.rotation.angle_to(&fallen.rotation).to_degrees();
        let expected = Vector3::new(0.6129, -0.1692, 1.9716);
        assert!(last < 0.1 && (fallen.position - expected).norm() < 2e-4, "{error}");
        assert!((turned - 28.2).abs() < 0.1, "{error}");
        let text = error.to_string();
        assert!(
            text.starts_with(&format!("at {:.2} % of the load the platform falls from (", 92.25 / s)[..5])
        );
    }
}

/// A post on cables around its foot, with its centre of mass at its top, which two cables hold along x alone;
/// all are shorter than their chords by a share.
fn post(strain: f64) -> (Robot, Vec<f64>) {
    let properties = caroca().cables[0].properties.clone();
    let mut cables = Vec::new();
    for (x, y) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        for z in [1.0, -1.0] {
            let (exit, anchor) = (Vector3::new(3.0 * x, 3.0 * y, z), Vector3::new(0.1 * x, 0.1 * y, 0.0));
            cables.push(RobotCable::between(exit, anchor, properties.clone()));
        }
    }
    for x in [3.0, -3.0] {
        cables.push(RobotCable::between(
            Vector3::new(x, 0.0, 1.0),
            Vector3::new(0.0, 0.0, 1.0),
            properties.clone(),
        ));
    }
    for cable in &mut cables {
        cable.properties.linear_density = 0.0;
    }
    let robot = Robot { platform: Platform::new(5.0, Vector3::z()), cables, ..caroca() };
    let upright = Pose::at(0.0, 0.0, 0.0);
    let lengths = (0..10).map(|i| robot.span(&upright, i).norm() * (1.0 - strain)).collect();
    (robot, lengths)
}

#[test]
fn a_post_that_buckles_leans_more_and_more_and_has_not_fallen() {
    let (robot, lengths) = post(4e-3);
    let none = Load::none();
    let upright = Pose::at(0.0, 0.0, 0.0);
    let problem = DirectProblem::new(&robot, &lengths, &none).unwrap();
    let unloaded = problem.with_unstable(Unstable::Refused).direct(DirectStart::Pose(&upright)).unwrap();
    let lean = |payload: f64| {
        let found = follow_load(&robot, &lengths, (&none, &unloaded), &Load::payload(payload)).unwrap();
        assert!(found.stability.is_stable());
        (found.equilibrium.pose.rotation * Vector3::z()).y.abs()
    };
    let leans: Vec<_> = (1..=20).map(|k| lean(100.0 * f64::from(k))).collect();
    let buckled = leans.iter().position(|lean| *lean > 1e-3).unwrap();
    assert!(buckled > 1 && buckled < 15 && leans[..buckled].iter().all(|lean| *lean < 1e-6), "{leans:?}");
    assert!(leans[buckled..].windows(2).all(|pair| pair[0] < pair[1] && pair[1] < 0.5), "{leans:?}");
}

#[test]
fn a_post_whose_cables_become_slack_as_it_leans_falls() {
    let (robot, lengths) = post(2e-3);
    let none = Load::none();
    let problem = DirectProblem::new(&robot, &lengths, &none).unwrap();
    let unloaded =
        problem.with_unstable(Unstable::Refused).direct(DirectStart::Pose(&Pose::at(0.0, 0.0, 0.0))).unwrap();
    let under = |payload: f64| follow_load(&robot, &lengths, (&none, &unloaded), &Load::payload(payload));
    assert!(under(400.0).is_ok());
    for payload in [500.0, 2000.0] {
        let error = under(payload).unwrap_err();
        let StaticsError::BranchEnds(end) = &error else { panic!("{error}") };
        assert!((end.share * payload - 478.3).abs() < 0.5, "{error}");
        let turned = end.pose.rotation.angle_to(&end.falls_to.as_ref().unwrap().rotation).to_degrees();
        assert!((turned - 1.7).abs() < 0.1, "{error}");
    }
}

#[test]
fn maps_and_observations_end_with_the_branch() {
    let robot = suspended();
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let wanted: Vec<_> = (0..40).map(|_| drawn_pose(&mut rng, &robot, &Pose::at(0.0, 0.0, 1.6))).collect();
    let wanted: Vec<_> = wanted.iter().collect();
    let load = Load::wrench(Wrench { force: Vector3::zeros(), moment: Vector3::new(600.0, -400.0, 0.0) });
    let (mut held, mut ended) = (0, 0);
    for (wound, found) in wanted.iter().zip(loaded_poses::<LoadedPose>(&robot, &wanted, &load)) {
        let scalar = deflection_from(&robot, wound.lengths.clone(), &load, &wound.equilibrium);
        match (&scalar, &found) {
            (Ok(alone), Ok(found)) => {
                assert!((alone.displacement() - found.displacement).norm() < 1e-9);
                held += 1;
            }
            (Err(alone), Err(found)) => {
                assert_eq!((alone, alone.kind()), (found, "branch_ends"));
                ended += 1;
            }
            _ => panic!("{scalar:?} {found:?}"),
        }
        let observer = Observer::new(&robot, wound.equilibrium.pose, &load).unwrap();
        let mut deviations = vec![0.0; ParameterLayout::of(&robot).count()];
        deviations[0] = 0.1;
        let observed = observed::<Observation>(&observer, &deviations).remove(0);
        let alone = alone::<Observation>(&observer, &deviations);
        assert_eq!(observed.as_ref().err(), alone.as_ref().err());
        if let (Ok(observed), Ok(alone)) = (observed, alone) {
            assert!((observed.displacement - alone.displacement).norm() < 1e-9);
        }
    }
    assert!(held > 5 && ended > 5, "{held} held, {ended} ended");
}

#[test]
fn ordinary_loads_stay_in_lanes() {
    for (robot, pose) in [caroca(), cogiro(), stadium(), ipanema()].into_iter().zip([
        Pose::at(0.4, -0.3, 1.6),
        Pose::at(1.0, -0.5, 2.0),
        Pose::at(3.0, -2.0, 10.0),
        Pose::at(0.2, 0.1, 1.0),
    ]) {
        let mut rng = ChaCha8Rng::seed_from_u64(5);
        let wanted: Vec<_> = (0..50).map(|_| drawn_pose(&mut rng, &robot, &pose)).collect();
        let wanted: Vec<_> = wanted.iter().collect();
        let found = loaded_poses::<LoadedPose>(&robot, &wanted, &Load::payload(0.5 * robot.platform.mass));
        let left = found.iter().filter(|found| found.as_ref().is_ok_and(|f| f.scalar.is_some())).count();
        assert_eq!(left, 0, "{}", robot.name);
    }
}
