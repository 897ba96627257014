//! Single cuts of all robots of the library, at poses that are drawn: each rest again by the direct model, on
//! a robot that never had the cable. Some of them against the motion of an independent program.

use cdpr_assess::{Breaks, Safety, safety_at};
use cdpr_evidence::accept;
use cdpr_robot::{Coordinate, Pose, Robot, UnitQuaternion, Vector3, library};
use cdpr_statics::{DirectProblem, DirectStart, Load, StaticsError, WantedPose};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::time::Instant;

/// Poses in the middle of what each robot holds.
const MIDDLES: [(&str, [f64; 3]); 20] = [
    ("acrobot", [0.57, 0.57, 0.9]),
    ("cable-robot-simulator", [5.93, 7.64, 4.3]),
    ("caroca", [0.0, 0.0, 1.75]),
    ("caroca-law", [0.0, 0.0, 1.75]),
    ("cogiro", [0.03, -0.03, 1.67]),
    ("copacabana-handling", [-0.09, 0.3, 1.18]),
    ("copacabana-inspection", [0.34, 0.21, 1.44]),
    ("expo2015-lucia", [-0.53, -0.02, 5.43]),
    ("expo2015-roberto", [0.43, -0.07, 5.43]),
    ("fast", [0.0, 0.0, 140.1]),
    ("four-cables", [0.5, 0.3, 2.0]),
    ("grab", [1.29, -0.11, 0.0]),
    ("hrpcables", [-0.03, 0.01, 0.72]),
    ("ipanema-1", [0.0, 0.0, 1.0]),
    ("ipanema-2", [-0.04, -0.06, 2.61]),
    ("ipanema-3", [-0.25, 0.17, 1.33]),
    ("irma4u", [0.11, 0.06, 1.31]),
    ("macarm", [1.17, 1.17, 1.17]),
    ("nist-robocrane", [0.0, 0.0, 1.5]),
    ("segesta", [0.0, 0.0, 0.5]),
];

/// How many poses of each robot are cut.
///
/// `CDPR_CASES=100 cargo test -p cdpr-assess --test integration cuts:: -- --nocapture`
fn count() -> usize {
    std::env::var("CDPR_CASES").map_or(2, |count| count.parse().unwrap())
}

/// Numbers from 0 to 1 (G. Steele, D. Lea, C. Flood, *Fast splittable pseudorandom number generators*, 2014).
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The middle of a robot, then positions around it: up to a fifth of its frame away along x and y, less along
/// z.
fn positions(robot: &Robot, middle: [f64; 3]) -> impl Iterator<Item = Pose> {
    let [x, y, _] = cdpr_robot::plausible::frame(robot).map(|[low, high]| high - low);
    let reach = Vector3::new(0.2 * x, 0.2 * y, 0.05 * x.min(y));
    let mut draw = Draw(robot.cables.len() as u64);
    let middle = Vector3::from(middle);
    let drawn = std::iter::repeat_with(move || {
        let at = Vector3::from_fn(|_, _| 2.0 * draw.next() - 1.0);
        middle + at.component_mul(&reach)
    });
    let level = |position: Vector3<f64>| Pose::at(position.x, position.y, position.z);
    std::iter::once(middle).chain(drawn).map(level)
}

/// The robot that never had this cable.
fn without(robot: &Robot, cable: usize) -> Robot {
    let mut others = robot.clone();
    others.cables.remove(cable);
    others.tension_reference = None;
    others
}

fn named(name: &str) -> Robot {
    Robot::from_json(library::named(library::ROBOTS, name).unwrap().text).unwrap()
}

/// How far the rests that two searches find are apart, over the size of the robot: P, and the rotation [rad].
fn apart(one: &Pose, other: &Pose, size: f64) -> f64 {
    let [a, b] = [one, other].map(|pose| UnitQuaternion::from_rotation_matrix(&pose.rotation));
    ((one.position - other.position).norm() / size).max(a.angle_to(&b))
}

/// Confirms every rest of the single cuts of a pose. Counts those that are confirmed, and why the others have
/// none; adds the time that the searches take.
fn confirm(robot: &Robot, found: &Safety, reasons: &mut BTreeMap<String, usize>, seconds: &mut f64) -> usize {
    let size = cdpr_robot::plausible::frame(robot).map(|[low, high]| high - low);
    let size = size.into_iter().fold(0.0, f64::max);
    let mut confirmed = 0;
    for broken in &found.broken {
        let [gone] = broken.cables[..] else { panic!("{:?}", broken.cables) };
        let others = without(robot, gone);
        let mut lengths = found.lengths.clone();
        lengths.remove(gone);
        let problem = DirectProblem::new(&others, &lengths, &Load::none()).unwrap();
        let clock = Instant::now();
        let released = problem.direct(DirectStart::Released(&found.pose));
        *seconds += clock.elapsed().as_secs_f64();
        let named = || format!("{} at {:?} without {}", robot.name, found.pose.position.as_slice(), gone + 1);
        let rest = match (&broken.rest, released) {
            (Ok(rest), Ok(released)) => {
                let far = apart(&rest.pose, &released.equilibrium.pose, size);
                assert!(far < 1e-9, "{}: {far:e} from the released state", named());
                rest
            }
            (Err(error), Err(again)) => {
                assert_eq!(error.kind(), again.kind(), "{}: {error}", named());
                *reasons.entry(error.kind().to_owned()).or_default() += 1;
                continue;
            }
            (one, other) => panic!("{}: {one:?} but {other:?}", named()),
        };
        // The rest is an equilibrium of its own, and a stable one: Newton's method stays there.
        let again = problem.direct(DirectStart::Pose(&rest.pose)).unwrap();
        let far = apart(&rest.pose, &again.equilibrium.pose, size);
        let soft = !again.stability.neutral().is_empty();
        assert!(again.stability.is_stable() && (far < 1e-6 || soft), "{}: {far:e}", named());
        confirmed += 1;
    }
    confirmed
}

#[test]
fn every_rest_after_a_single_cut_is_confirmed_from_the_released_state() {
    let names: Vec<&str> = library::ROBOTS.iter().map(|file| file.name).collect();
    assert_eq!(names, MIDDLES.map(|(name, _)| name));
    for (name, middle) in MIDDLES {
        let robot = named(name);
        let few = [Coordinate::Roll, Coordinate::Pitch];
        let free: &[Coordinate] = if robot.cables.len() == 4 { &few } else { &[] };
        let wanted = |pose: &Pose| {
            safety_at(&robot, WantedPose::at(pose).free(free), &Load::none(), Breaks::default())
        };
        let at = |pose: Pose| match wanted(&pose) {
            Ok(found) => Some(found),
            Err(StaticsError::Invalid { .. }) => panic!("{name}: a pose that is refused"),
            Err(_) => None,
        };
        let mut seconds = 0.0;
        let mut reasons = BTreeMap::new();
        let (mut cuts, mut confirmed, mut poses) = (0, 0, 0);
        for found in positions(&robot, middle).take(100 * count()).filter_map(at).take(count()) {
            poses += 1;
            cuts += found.broken.len();
            confirmed += confirm(&robot, &found, &mut reasons, &mut seconds);
        }
        let each = 1e3 * seconds / f64::from(u32::try_from(cuts).unwrap());
        println!(
            "{name}: {poses} poses, {confirmed} of {cuts} rests confirmed {reasons:?}, {each:.2} ms each"
        );
        assert_eq!(poses, count(), "{name}: poses that are held");
        assert_eq!(confirmed, cuts, "{name}: {reasons:?}");
    }
}

/// `data/reference/cuts.json`.
#[derive(Deserialize)]
struct Cuts {
    cases: Vec<Cut>,
}

/// Where a platform rests 60 s after a cable was cut.
#[derive(Deserialize)]
struct Cut {
    robot: String,
    pose: [f64; 3],
    /// Number of the cable, from 1.
    cut: usize,
    lengths: Vec<f64>,
    position: [f64; 3],
    rotation: [f64; 4],
    tensions: Vec<f64>,
}

#[test]
fn platforms_rest_where_a_damped_motion_of_moordyn_ends() {
    let file: Cuts = serde_json::from_str(include_str!("../../../data/reference/cuts.json")).unwrap();
    let robots: std::collections::BTreeSet<&str> = file.cases.iter().map(|cut| cut.robot.as_str()).collect();
    assert!(robots.len() >= 3, "{robots:?}");
    for cut in &file.cases {
        let (robot, [x, y, z]) = (named(&cut.robot), cut.pose);
        let pose = Pose::at(x, y, z);
        let found = safety_at(&robot, WantedPose::at(&pose), &Load::none(), Breaks::default()).unwrap();
        let name = format!("{} without {}", cut.robot, cut.cut);
        // The motion was of cables of these lengths.
        for (here, there) in found.lengths.iter().zip(&cut.lengths) {
            assert!(
                (here - there).abs() < 1e-9 * there,
                "{name}: length {here} m, and {there} m in the file"
            );
        }
        let rest = found.broken[cut.cut - 1].rest.as_ref().unwrap_or_else(|error| panic!("{name}: {error}"));
        let there = Pose::with_quaternion(cut.position.into(), cut.rotation).unwrap();
        let off = (rest.pose.position - there.position).norm();
        let [turned, other] =
            [&rest.pose, &there].map(|pose| UnitQuaternion::from_rotation_matrix(&pose.rotation));
        let turned = turned.angle_to(&other);
        let greatest = cut.tensions.iter().copied().fold(0.0, f64::max);
        let apart = rest.tensions.iter().zip(&cut.tensions).map(|([at, _], there)| (at - there).abs());
        let tension = apart.fold(0.0, f64::max) / greatest;
        println!("{name}: moves {:.4} m and {off:.1e} m, {turned:.1e} rad apart", rest.moved);
        accept("V-SAFETY-001", off);
        accept("V-SAFETY-002", turned);
        accept("V-SAFETY-003", tension);
    }
}
