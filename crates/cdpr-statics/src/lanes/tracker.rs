//! Direct solves one after the other, each from the equilibrium before, as in a control loop or a simulation.

use crate::direct::{DirectSolution, DirectStart, direct, follow_change};
use crate::error::StaticsError;
use crate::local::newton::solve;
use crate::local::one_robot::fits_lanes;
use crate::local::platform::Robots;
use crate::problem::{DirectProblem, Unstable};
use crate::state::{Equilibrium, Load, Residual};
use cdpr_number::lanes::{Lanes, Simd, WithSimd, dispatch};
use cdpr_robot::Robot;

/// Follows the stable equilibrium of a robot while its lengths and its load change.
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
        let (equilibrium, residual) = (solution.equilibrium, solution.report.residual);
        let in_lanes = fits_lanes(robot);
        Ok(Self { robot, lengths: lengths.to_vec(), load: *load, equilibrium, residual, in_lanes })
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
    /// folded cables and without guides (up to 32 cables with AVX-512, 16 with AVX2). Otherwise the change is
    /// made in steps, and where these strain a cable too much on the way or do not end, [`direct`] searches
    /// near the current equilibrium.
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

/// Newton's method for cables that fill the lanes; its output is whether it found an equilibrium.
struct Update<'a, 'b> {
    tracker: &'a mut Tracker<'b>,
    problem: &'a DirectProblem<'a>,
}

impl WithSimd for Update<'_, '_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let Self { tracker, problem } = self;
        let (robots, residual) = {
            let before = DirectProblem {
                robot: tracker.robot,
                lengths: &tracker.lengths,
                load: tracker.load,
                length_of_rotations: None,
                unstable: Unstable::Left,
            };
            match follow(simd, problem, &before, &tracker.equilibrium) {
                Some(found) => found,
                None => return false,
            }
        };
        problem.take(&robots, &mut tracker.equilibrium);
        tracker.residual = residual;
        true
    }
}

/// The robot of `problem` in the equilibrium that `now`, one of the problem `before`, becomes.
#[inline(always)]
fn follow<'a, S: Simd>(
    simd: S,
    problem: &DirectProblem<'a>,
    before: &DirectProblem,
    now: &Equilibrium,
) -> Option<(Robots<'a, S>, Residual)> {
    let zero = Lanes::splat(simd, 0.0);
    let everywhere = zero.less_or_equal(zero);
    let (mut robots, mut platform, load) = problem.linearized(simd, now);
    let scale = problem.scale(now);
    let (found, left) = solve(&mut robots, &load, &mut platform, &scale, everywhere);
    if !found.any() {
        return None;
    }
    if !platform.steps.end_near_prediction(&scale).any() {
        let (_, unloaded, _) = before.linearized(simd, now);
        if !robots.on_branch(&load, &platform, &unloaded.factored, &scale, everywhere).any() {
            return None;
        }
    }
    Some((robots, left.norms()[0]))
}
