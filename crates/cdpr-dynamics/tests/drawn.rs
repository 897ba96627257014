//! Motions of robots that are drawn at random.

use crate::robots::{ROBOTS, free_coordinates, robot, wanted};
use crate::simulated::{at, moved};
use cdpr_dynamics::DynamicsError;
use cdpr_dynamics::simulate::{Change, CutAt, Settings, simulate};
use cdpr_robot::{Pose, Robot, Rotation3, Vector3};
use cdpr_statics::{DirectProblem, DirectStart, Equilibrium, Load, inverse};

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

    fn within(&mut self, most: f64) -> f64 {
        most * (2.0 * self.next() - 1.0)
    }

    /// A factor of up to this or its inverse.
    fn factor(&mut self, most: f64) -> f64 {
        most.powf(self.within(1.0))
    }
}

/// A robot with its lengths, its load and its rest; none where the robot that was drawn has no stable rest.
struct Drawn {
    robot: Robot,
    lengths: Vec<f64>,
    load: Load,
    rest: Equilibrium,
}

impl Drawn {
    fn new(seed: u64) -> Option<Self> {
        let mut draw = Draw(seed);
        let (file, [x, y, z], free) = ROBOTS[(seed % 6) as usize];
        let mut robot = robot(file);
        let size = robot.platform_size();
        let (mass, density, modulus) = (draw.factor(3.0), draw.factor(10.0), draw.factor(5.0));
        robot.platform.mass *= mass;
        robot.platform.inertia = robot.platform.inertia.map(|inertia| inertia * mass);
        let has_lead = draw.next() < 0.3;
        for cable in &mut robot.cables {
            let span = (cable.exit_point - Vector3::new(x, y, z)).norm();
            let mut shift = |most: f64| Vector3::new(draw.within(most), draw.within(most), draw.within(most));
            cable.exit_point += shift(0.03 * span);
            cable.anchor_point += shift(0.05 * size);
            cable.properties.linear_density *= density * draw.factor(1.3);
            cable.properties.youngs_modulus *= modulus * draw.factor(1.3);
            if has_lead {
                cable.lead = 0.3 * span * draw.next();
            }
        }
        let mut pose = Pose::at(x, y, z);
        pose.position += Vector3::new(draw.within(1.0), draw.within(1.0), draw.within(1.0)) * size;
        if free.is_empty() {
            let [roll, pitch, yaw] = [0.1, 0.1, 0.2].map(|most| draw.within(most));
            pose.rotation = Rotation3::from_euler_angles(roll, pitch, yaw);
        }
        let load = Load::payload(robot.platform.mass * 0.5 * draw.next());
        let held = inverse(&robot, wanted(&pose, &free_coordinates(free)), &load).ok()?;
        let problem = DirectProblem::new(&robot, &held.lengths, &load).ok()?;
        let rest = problem.direct(DirectStart::Near(&held.equilibrium)).ok()?.equilibrium;
        Some(Self { lengths: held.lengths, load, rest, robot })
    }

    fn all() -> impl Iterator<Item = (u64, Self)> {
        let cases = std::env::var("CDPR_CASES").map_or(60, |count| count.parse().unwrap());
        (0..).filter_map(|seed| Some((seed, Self::new(seed)?))).take(cases)
    }
}

/// `CDPR_CASES=1000 cargo test -p cdpr-dynamics --test integration drawn:: -- --nocapture`
#[test]
fn robots_that_are_drawn_at_rest_stay_at_rest() {
    let (mut faults, mut greatest) = (Vec::new(), [0.0_f64; 2]);
    for (seed, Drawn { robot, lengths, load, rest }) in Drawn::all() {
        let problem = DirectProblem::new(&robot, &lengths, &load).unwrap();
        match simulate(&problem, &rest, &[], &Settings { rate: 20.0, ..Settings::until(1.0) }) {
            Ok(series) => {
                // Cables of elements rest next to where catenaries do.
                let begin = series.samples[0].pose;
                let longest = lengths.iter().copied().fold(0.0, f64::max);
                let apart = rest.pose.motion_to(&begin).norm();
                let way = [moved(&series, &begin), apart / longest];
                greatest = [0, 1].map(|k| greatest[k].max(way[k]));
                let most = if longest > 100.0 { 2e-8 * longest } else { 1e-9 };
                if way[0] > 1e-9 || apart > most {
                    faults.push(format!("{seed}, {}: {:e} {:e}", robot.name, way[0], way[1]));
                }
            }
            Err(error) => faults.push(format!("{seed}, {}: {error}", robot.name)),
        }
    }
    println!("up to {:.1e} m; the rest {:.1e} of the longest cable off", greatest[0], greatest[1]);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn cables_of_drawn_robots_part_with_an_answer_or_a_reason() {
    let (mut reasons, mut count) = (Vec::new(), 0);
    for (seed, Drawn { robot, lengths, load, rest }) in Drawn::all() {
        let mut draw = Draw(seed + 1_000_000);
        let cable = (draw.next() * robot.cables.len() as f64) as usize;
        let end = if draw.next() < 0.5 { CutAt::Anchor } else { CutAt::Exit };
        let problem = DirectProblem::new(&robot, &lengths, &load).unwrap();
        let settings = Settings { damping: 2e-4, ..Settings::until(0.05) };
        count += 1;
        match simulate(&problem, &rest, &[at(0.01, Change::Cut { cable, at: end })], &settings) {
            Ok(series) => {
                assert_eq!(series.samples.len(), 6, "{seed}");
                let numbers = series.samples.iter().flat_map(|sample| {
                    sample.pose.position.iter().chain(sample.tensions.iter().flatten()).copied()
                });
                assert!(numbers.into_iter().all(f64::is_finite), "{seed}, {}", robot.name);
            }
            Err(DynamicsError::Stalled { time }) => {
                reasons.push(format!("{seed}, {}: stalled at {time} s", robot.name));
            }
            Err(error) => panic!("{seed}, {}: {error}", robot.name),
        }
    }
    println!("{} of {count} are not followed\n{}", reasons.len(), reasons.join("\n"));
    assert!(20 * reasons.len() <= count, "{}", reasons.join("\n"));
}
