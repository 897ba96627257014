//! Settings of a test of robustness, and the two protocols for which results of other programs are published.

use cdpr_robot::{Axis, Coordinate, Robot, Vector3, rounded};
use cdpr_sensitivity::{Input, Law, RandomDesign};
use cdpr_study::StudyError;
use serde::Serialize;
use std::f64::consts::PI;

/// Where poses are drawn from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseRegion {
    /// Least coordinates of P [m].
    pub low: [f64; 3],
    /// Greatest coordinates of P [m].
    pub high: [f64; 3],
    /// Greatest angle of the rotation [rad]. Axis and angle are uniformly distributed. With free coordinates
    /// poses are drawn level.
    pub max_angle: f64,
}

/// How far a start is from the true pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartOffset {
    /// Distance of P [m].
    pub distance: f64,
    /// Angle of rotation [rad].
    pub angle: f64,
    /// Published results of another program from starts as far away.
    pub published: Option<Published>,
}

/// Poses that another program found, and how many it was given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Published {
    /// Name of the program.
    pub program: &'static str,
    /// Poses found.
    pub found: usize,
    /// Poses given to it.
    pub of: usize,
}

/// How poses and start offsets are combined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Assignment {
    /// Each pose from one start offset; the offsets take turns.
    InTurn,
    /// Each pose from all start offsets, in the same direction.
    Each,
}

/// Settings of a protocol.
#[derive(Clone, Debug, PartialEq)]
pub struct Protocol {
    /// Name, for files and tables.
    pub name: &'static str,
    /// Title, for tables and figures.
    pub title: &'static str,
    /// Young's modulus of all cables [Pa] in place of the robot's.
    pub youngs_modulus: Option<f64>,
    /// Where poses are drawn from.
    pub region: PoseRegion,
    /// Coordinates of the drawn poses that are found, for a robot with fewer cables than free motions.
    pub free: Vec<Coordinate>,
    /// The true pose is found if P is this near [m] and the rotation within
    /// [`FOUND_ANGLE`](super::FOUND_ANGLE).
    pub found_distance: f64,
    /// Number of stable poses that are collected and solved.
    pub poses: usize,
    /// Start offsets.
    pub starts: Vec<StartOffset>,
    /// How poses and start offsets are combined.
    pub assignment: Assignment,
    /// Seed of poses and directions.
    pub seed: u64,
}

const MOST_POSES: usize = 10_000_000;
/// Draws made for each pose wanted before the test is given up, and at least.
const DRAWS_PER_POSE: usize = 100;
const DRAWS: usize = 1000;
/// The same with free coordinates, where each refusal is a search from many starts.
const FREE_DRAWS_PER_POSE: usize = 10;
const FREE_DRAWS: usize = 200;

impl Protocol {
    /// The test of Mahnke and Caverly for the forward kinematics of CoGiRo with sagging cables: E = 35 GPa,
    /// poses all over the room with rotations up to 30 degrees, starts up to 1 m and 40 degrees away.
    pub fn mahnke_caverly(poses: usize, seed: u64) -> Self {
        let distances = [0.0, 0.25, 0.5, 0.75, 1.0];
        let start = |distance| {
            [2.0_f64, 10.0, 20.0, 30.0, 40.0].map(|degrees| StartOffset {
                distance,
                angle: degrees.to_radians(),
                published: None,
            })
        };
        Self {
            name: "mahnke_caverly",
            title: "Protocol of Mahnke and Caverly",
            youngs_modulus: Some(35e9),
            region: PoseRegion::cogiro(),
            free: Vec::new(),
            found_distance: 0.1,
            poses,
            starts: distances.into_iter().flat_map(start).collect(),
            assignment: Assignment::InTurn,
            seed,
        }
    }

    /// Thirty poses of CoGiRo with its own modulus, each from 0.5 m and 0.25 rad, and from 0.2 m and 0.1 rad
    /// away.
    pub fn thirty_poses(seed: u64) -> Self {
        let start = |distance, angle, found| {
            let published = Some(Published { program: "WireX", found, of: 30 });
            StartOffset { distance, angle, published }
        };
        Self {
            name: "thirty_poses",
            title: "Thirty poses",
            youngs_modulus: None,
            region: PoseRegion::cogiro(),
            free: Vec::new(),
            found_distance: 0.1,
            poses: 30,
            starts: vec![start(0.5, 0.25, 22), start(0.2, 0.1, 25)],
            assignment: Assignment::Each,
            seed,
        }
    }

    /// The protocol in the room of another robot, with the modulus of its file: poses are drawn from
    /// `region`, and all distances change as its diagonal does, to two digits. Nothing is published of it.
    pub fn in_region(self, region: PoseRegion) -> Self {
        let scale = region.diagonal() / self.region.diagonal();
        let scale = rounded(scale, 1 - scale.log10().floor() as i32);
        let start = |start: &StartOffset| StartOffset {
            distance: start.distance * scale,
            angle: start.angle,
            published: None,
        };
        Self {
            starts: self.starts.iter().map(start).collect(),
            found_distance: self.found_distance * scale,
            youngs_modulus: None,
            region,
            ..self
        }
    }

    /// Solves that the test makes.
    pub fn solves(&self) -> usize {
        match self.assignment {
            Assignment::InTurn => self.poses,
            Assignment::Each => self.poses.saturating_mul(self.starts.len()),
        }
    }

    /// Checks all settings.
    ///
    /// # Errors
    /// [`StudyError::Setting`] naming the field, its value and what would be right.
    pub fn validate(&self) -> Result<(), StudyError> {
        if !(1..=MOST_POSES).contains(&self.poses) {
            return Err(StudyError::setting("poses", self.poses, format!("1 to {MOST_POSES}")));
        }
        if let Some(modulus) = self.youngs_modulus
            && !(modulus.is_finite() && modulus > 0.0)
        {
            return Err(StudyError::setting("youngs_modulus", modulus, "a finite, positive modulus [Pa]"));
        }
        if self.starts.is_empty() {
            return Err(StudyError::setting("starts", "empty", "at least one start offset"));
        }
        for (i, StartOffset { distance, angle, .. }) in self.starts.iter().enumerate() {
            for (name, value) in [("distance", *distance), ("angle", *angle)] {
                if !(value.is_finite() && value >= 0.0) {
                    let field = format!("starts[{i}].{name}");
                    return Err(StudyError::setting(field, value, "a finite number, zero or more [m, rad]"));
                }
            }
        }
        self.design().map(|_| ())
    }

    /// The robot with the test's modulus.
    pub(super) fn robot(&self, robot: &Robot) -> Robot {
        let mut robot = robot.clone();
        if let Some(modulus) = self.youngs_modulus {
            robot.cables.iter_mut().for_each(|cable| cable.properties.youngs_modulus = modulus);
        }
        robot
    }

    /// Ten numbers a draw: position, rotation, and the directions of both start offsets.
    pub(super) fn design(&self) -> Result<RandomDesign, StudyError> {
        let PoseRegion { low, high, max_angle } = self.region;
        let input = |name: &str, min, max| Input::continuous(name, Law::Uniform { min, max });
        let mut inputs: Vec<Input> = Axis::ALL
            .iter()
            .zip(low.iter().zip(high))
            // Where all exit points lie in a plane, so do the poses: see `PoseRegion::place`.
            .map(|(axis, (a, b))| input(axis.letter(), *a, if *a == b { b + 1.0 } else { b }))
            .collect();
        inputs.push(input("angle", 0.0, max_angle));
        for name in ["axis", "start direction", "start axis"] {
            // The height on the unit sphere and the azimuth: each area is as likely as any other of its size.
            inputs.push(input(name, -1.0, 1.0));
            inputs.push(input(name, -PI, PI));
        }
        RandomDesign::new(inputs, self.most_draws(), self.seed).map_err(|source| {
            StudyError::setting("region", format!("{:?}", self.region), format!("finite ranges ({source})"))
        })
    }

    fn most_draws(&self) -> usize {
        let (each, least) = self.draws();
        self.poses.saturating_mul(each).max(least)
    }

    /// Draws for each pose wanted, and at least.
    fn draws(&self) -> (usize, usize) {
        if self.free.is_empty() { (DRAWS_PER_POSE, DRAWS) } else { (FREE_DRAWS_PER_POSE, FREE_DRAWS) }
    }

    /// Whether so few of the drawn poses are held that the others will not be either.
    pub(super) fn holds_too_few(&self, held: usize, drawn: usize) -> bool {
        let (each, least) = self.draws();
        drawn >= least && held.saturating_mul(each) < drawn
    }
}

/// Both protocols for a robot: that of Mahnke and Caverly, with another modulus [Pa] if there is one, and the
/// thirty poses. In the room of another robot than CoGiRo, or in a region that is given, their distances
/// change with its size.
pub fn protocols(
    robot: &Robot,
    poses: usize,
    modulus: Option<f64>,
    region: Option<PoseRegion>,
    free: &[Coordinate],
    seed: u64,
) -> [Protocol; 2] {
    let room = match region {
        None if robot.name == "CoGiRo" => None,
        None => Some(PoseRegion::of(robot)),
        given => given,
    };
    let own = |protocol: Protocol| Protocol {
        free: free.to_vec(),
        ..match room {
            Some(room) => protocol.in_region(room),
            None => protocol,
        }
    };
    let first = own(Protocol::mahnke_caverly(poses, seed));
    let youngs_modulus = modulus.or(first.youngs_modulus);
    [Protocol { youngs_modulus, ..first }, own(Protocol::thirty_poses(seed))]
}

impl PoseRegion {
    /// Nearly all of the room inside of CoGiRo's frame, with rotations up to 30 degrees.
    pub fn cogiro() -> Self {
        Self { low: [-6.75, -4.75, 0.0], high: [6.75, 4.75, 4.75], max_angle: PI / 6.0 }
    }

    /// The room of a robot, with rotations up to 30 degrees: the box of its exit points, narrower by a
    /// twentieth of its size on all sides. Under exit points that are all nearly as high, it is half as high
    /// as it is wide.
    pub fn of(robot: &Robot) -> Self {
        let exits = || robot.cables.iter().map(|cable| cable.exit_point);
        let start = |value| Vector3::repeat(value);
        let mut low = exits().fold(start(f64::INFINITY), |low, exit| low.inf(&exit));
        let high = exits().fold(start(f64::NEG_INFINITY), |high, exit| high.sup(&exit));
        let wide = (high - low).xy().max();
        if high.z - low.z < 0.25 * wide {
            low.z = high.z - 0.5 * wide;
        }
        let margin = 0.05 * (high - low);
        Self { low: (low + margin).into(), high: (high - margin).into(), max_angle: PI / 6.0 }
    }

    /// The place in its box for a drawn one [m].
    pub(super) fn place(&self, drawn: [f64; 3]) -> Vector3<f64> {
        Vector3::from(drawn).sup(&self.low.into()).inf(&self.high.into())
    }

    /// The diagonal of its box [m].
    fn diagonal(&self) -> f64 {
        (Vector3::from(self.high) - Vector3::from(self.low)).norm()
    }
}
