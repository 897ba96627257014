//! Direct solves one after the other, each from the equilibrium before, as in a control loop or a simulation.

use crate::direct::{DirectSolution, DirectStart, direct, follow_change};
use crate::error::StaticsError;
use crate::lanes::cable::LaneCable;
use crate::lanes::load::PlatformLoad;
use crate::lanes::platform::{Layout, LinearizedPlatform, Robots, Scale};
use crate::lanes::reason::ScalarReason;
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Load, Residual, rounding_of_closure};
use cdpr_number::lanes::{Lanes, MAX_LANES, Simd, WithSimd, dispatch};
use cdpr_robot::{Matrix3, Robot, Vector3, Wrench, orthonormalized};
use smallvec::SmallVec;

/// Follows the stable equilibrium of a robot while its cables are wound and its load changes.
///
/// ```
/// use cdpr_robot::{Pose, Robot};
/// use cdpr_statics::{Load, Tracker, inverse};
///
/// let robot = Robot::from_json(include_str!("../../../../data/robots/caroca.json"))?;
/// let wanted = inverse(&robot, &Pose::at(0.0, 0.0, 1.75), &Load::none())?;
/// let mut tracker = Tracker::new(&robot, &wanted.lengths, &Load::none(), &wanted.equilibrium)?;
/// let mut lengths = wanted.lengths.clone();
/// lengths[0] -= 1e-3;
/// let pose = tracker.update(&lengths, &Load::none())?.pose;
/// println!("{:.3} mm", 1e3 * (pose.position - wanted.equilibrium.pose.position).norm());
/// assert!(tracker.residual().force < 1e-8);
/// # Ok::<(), cdpr_statics::StaticsError>(())
/// ```
pub struct Tracker<'a> {
    robot: &'a Robot,
    /// Lengths [m] and load of the equilibrium.
    lengths: Vec<f64>,
    load: Load,
    equilibrium: Equilibrium,
    residual: Residual,
    /// Whether the robot is one for the lanes.
    in_lanes: bool,
    /// Largest distance of an exit point from the origin [m].
    farthest: f64,
}

impl<'a> Tracker<'a> {
    /// Starts at the equilibrium for `lengths` [m] and `load` that [`direct`] finds from `start`.
    ///
    /// # Errors
    /// Those of [`direct`], and [`StaticsError::Robot`] for an invalid robot.
    pub fn new(
        robot: &'a Robot,
        lengths: &[f64],
        load: &Load,
        start: &Equilibrium,
    ) -> Result<Self, StaticsError> {
        robot.validate()?;
        let solution = direct(robot, lengths, load, DirectStart::Near(start))?;
        let farthest = robot.cables.iter().map(|cable| cable.exit_point.norm()).fold(0.0, f64::max);
        let in_lanes = robot.has_plain_cables() && ScalarReason::of_all(robot, &[]).is_none();
        let (equilibrium, residual) = (solution.equilibrium, solution.report.residual);
        Ok(Self { robot, lengths: lengths.to_vec(), load: *load, equilibrium, residual, in_lanes, farthest })
    }

    /// The current equilibrium.
    pub fn equilibrium(&self) -> &Equilibrium {
        &self.equilibrium
    }

    /// The residual of the current equilibrium.
    pub fn residual(&self) -> Residual {
        self.residual
    }

    /// Goes to the equilibrium for other lengths [m] and another load that the current one becomes while both
    /// change in proportion.
    ///
    /// Nothing is allocated where Newton's method ends near its prediction, at a stable equilibrium without
    /// folded cables (up to 32 of them with AVX-512, 16 with AVX2). Otherwise the change is made in steps,
    /// and where these strain a cable too much on the way or do not end, [`direct`] searches near the current
    /// equilibrium.
    ///
    /// # Errors
    /// [`StaticsError::BranchEnds`] where the platform falls on the way, and those of [`direct`]; the
    /// equilibrium is then the one before.
    pub fn update(&mut self, lengths: &[f64], load: &Load) -> Result<&Equilibrium, StaticsError> {
        let problem = DirectProblem::new(self.robot, lengths, load)?;
        let found = self.in_lanes && dispatch(Update { tracker: self, problem: &problem });
        if !found {
            let solution = self.followed(lengths, load)?;
            self.residual = solution.report.residual;
            self.equilibrium = solution.equilibrium;
        }
        self.lengths.copy_from_slice(lengths);
        self.load = *load;
        Ok(&self.equilibrium)
    }

    fn followed(&self, lengths: &[f64], load: &Load) -> Result<DirectSolution, StaticsError> {
        let start = DirectStart::Near(&self.equilibrium);
        let now = direct(self.robot, &self.lengths, &self.load, start)?;
        match follow_change(self.robot, ((&self.lengths, &self.load), &now), (lengths, load)) {
            Err(StaticsError::Overstrained { .. } | StaticsError::DirectNotConverged { .. }) => {
                direct(self.robot, lengths, load, start)
            }
            followed => followed,
        }
    }
}

/// Newton's method for cables, which fill the lanes; it tells whether it found an equilibrium.
struct Update<'a, 'b> {
    tracker: &'a mut Tracker<'b>,
    problem: &'a DirectProblem<'a>,
}

impl WithSimd for Update<'_, '_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let Self { tracker, problem } = self;
        let zero = Lanes::splat(simd, 0.0);
        let everywhere = zero.less_or_equal(zero);
        let mut robots = tracker.in_lanes(simd, problem.lengths);
        let mut linearized = LinearizedPlatform::new(zero, robots.cables.len());
        let load = tracker.load_in_lanes(&robots, &problem.load);
        let size = problem.size();
        let rounding = rounding_of_closure(size, tracker.equilibrium.pose.position.norm() + tracker.farthest);
        let scale = Scale { size, characteristic_length: problem.characteristic_length(), rounding };
        robots.linearize(&load, &mut linearized, everywhere);
        let (found, left) = robots.settle(&load, &mut linearized, &scale, everywhere);
        if !found.any() {
            return false;
        }
        if !linearized.steps.end_near_prediction(&scale).any() {
            let before = tracker.in_lanes(simd, &tracker.lengths);
            let mut platform = LinearizedPlatform::new(zero, before.cables.len());
            before.linearize(&tracker.load_in_lanes(&before, &tracker.load), &mut platform, everywhere);
            if !robots.on_branch(&load, &linearized, &platform.factored, &scale, everywhere).any() {
                return false;
            }
        }
        tracker.take(&robots);
        tracker.residual = left.norms()[0];
        true
    }
}

impl Tracker<'_> {
    /// Coordinates in the level frame, which the lanes hold.
    #[inline(always)]
    fn to_level(&self, v: Vector3<f64>) -> Vector3<f64> {
        self.robot.gravity.level().map_or(v, |level| level * v)
    }

    /// The robot with these lengths [m] where it is, its cables in lanes.
    #[inline(always)]
    fn in_lanes<S: Simd>(&self, simd: S, lengths: &[f64]) -> Robots<'static, S> {
        let Self { robot, equilibrium: Equilibrium { pose, cable_forces }, .. } = self;
        let (n, count, zero) = (lengths.len(), Lanes::<S>::COUNT, Lanes::splat(simd, 0.0));
        let in_last = n - (n - 1) / count * count;
        let last = Lanes::from_fn(simd, |lane| lane as f64).less_or_equal(zero.all(in_last as f64 - 0.5));
        let mut robots = Robots {
            layout: Layout::Cables(last),
            freedoms: robot.freedoms(),
            cables: SmallVec::new(),
            position: vector(simd, &self.to_level(pose.position)),
            center: vector(simd, &self.to_level(pose.rotation * robot.platform.center_of_mass)),
            frame: SmallVec::new(),
            weight: zero.all(robot.platform.mass * robot.gravity.magnitude()),
        };
        for k in 0..3 {
            robots.frame.push(vector(simd, &self.to_level(pose.rotation.matrix().column(k).into())));
        }
        for first in (0..n).step_by(count) {
            let mut values = [[0.0; MAX_LANES]; 11];
            for lane in 0..count {
                // Lanes beyond the last cable repeat it and do not count.
                let i = (first + lane).min(n - 1);
                let (cable, force) = (robot.cable(i), cable_forces[i]);
                let exit = self.to_level(robot.cables[i].exit_point);
                let arm = self.to_level(robot.anchor_arm(pose, i));
                let (weight, flexibility) = (cable.weight_per_length, 1.0 / cable.axial_stiffness);
                let cable = [
                    weight,
                    flexibility,
                    exit.x,
                    exit.y,
                    exit.z,
                    arm.x,
                    arm.y,
                    arm.z,
                    lengths[i],
                    force.x,
                    force.y,
                ];
                for (values, value) in values.iter_mut().zip(cable) {
                    values[lane] = value;
                }
            }
            let column = |k: usize| Lanes::from_array(simd, &values[k]);
            robots.cables.push(LaneCable {
                law: &[],
                weight_per_length: column(0),
                axial_flexibility: column(1),
                exit_point: [column(2), column(3), column(4)],
                anchor_arm: [column(5), column(6), column(7)],
                length: column(8),
                force: [column(9), column(10)],
                guided: None,
            });
        }
        robots
    }

    /// Weight and load on the platform.
    #[inline(always)]
    fn load_in_lanes<S: Simd>(&self, robots: &Robots<'_, S>, load: &Load) -> PlatformLoad<S> {
        let Wrench { force, moment } = load.wrench;
        let wrench = Wrench { force: self.to_level(force), moment: self.to_level(moment) };
        PlatformLoad::new(robots.weight + load.payload * self.robot.gravity.magnitude(), &wrench)
    }

    /// Takes pose and forces from the lanes.
    #[inline(always)]
    fn take<S: Simd>(&mut self, robots: &Robots<'_, S>) {
        let level = self.robot.gravity.level();
        let to_base = |v: Vector3<f64>| level.map_or(v, |level| level.tr_mul(&v));
        let pose = &mut self.equilibrium.pose;
        pose.position = to_base(back(&robots.position));
        let columns = [
            to_base(back(&robots.frame[0])),
            to_base(back(&robots.frame[1])),
            to_base(back(&robots.frame[2])),
        ];
        pose.rotation = orthonormalized(&Matrix3::from_columns(&columns));
        let forces = self.equilibrium.cable_forces.chunks_mut(Lanes::<S>::COUNT);
        for (forces, cable) in forces.zip(&robots.cables) {
            let [x, z] = [cable.force[0].to_array(), cable.force[1].to_array()];
            for (lane, force) in forces.iter_mut().enumerate() {
                (force.x, force.y) = (x[lane], z[lane]);
            }
        }
    }
}

/// A vector in all lanes.
#[inline(always)]
fn vector<S: Simd>(simd: S, v: &Vector3<f64>) -> [Lanes<S>; 3] {
    [Lanes::splat(simd, v.x), Lanes::splat(simd, v.y), Lanes::splat(simd, v.z)]
}

/// The vector that all lanes hold.
#[inline(always)]
fn back<S: Simd>(v: &[Lanes<S>; 3]) -> Vector3<f64> {
    Vector3::new(v[0].first(), v[1].first(), v[2].first())
}
