//! Direct solves one after the other, each from the equilibrium before, as in a control loop or a simulation.

use crate::direct::{DirectSolution, DirectStart, direct, follow_change};
use crate::equations::CableShape;
use crate::error::StaticsError;
use crate::local::newton::solve;
use crate::local::one_robot::fits_lanes;
use crate::local::platform::Robots;
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Load, Residual};
use cdpr_number::lanes::{Lanes, Simd, WithSimd, dispatch};
use cdpr_robot::Robot;
use std::borrow::Borrow;

/// Follows the stable equilibrium of a robot while its lengths and its load change.
///
/// It borrows the robot, or owns it, as in an [`std::sync::Arc`].
///
/// ```
/// use cdpr_robot::{Pose, Robot};
/// use cdpr_statics::{Load, Tracker, inverse};
///
/// let robot = Robot::from_library("caroca")?;
/// let wanted = inverse(&robot, &Pose::at(0.0, 0.0, 1.75), &Load::none())?;
/// let mut tracker = Tracker::new(&robot, &wanted.lengths, &Load::none(), &wanted.equilibrium)?;
/// let mut lengths = wanted.lengths.clone();
/// lengths[0] -= 1e-3;
/// let pose = tracker.update(&lengths, &Load::none())?.pose;
/// println!("{:.3} mm", 1e3 * (pose.position - wanted.equilibrium.pose.position).norm());
/// assert!(tracker.residual().force < 1e-8);
/// # Ok::<(), cdpr_statics::StaticsError>(())
/// ```
pub struct Tracker<R: Borrow<Robot>> {
    robot: R,
    tracked: Tracked,
}

/// An equilibrium of a robot that is followed, apart from how the robot is kept.
struct Tracked {
    /// Lengths [m] and load of the equilibrium.
    lengths: Vec<f64>,
    load: Load,
    equilibrium: Equilibrium,
    residual: Residual,
    /// Whether lanes have the robot, and something resists every motion of its platform at the start.
    in_lanes: bool,
    /// The same where the last search ended: a slack cable without weight resists nothing.
    resisted: bool,
}

/// What [`Tracker::step`] has done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TrackerStep {
    /// Iterations of Newton's method, at most 12.
    pub iterations: usize,
    /// Whether they ended at the equilibrium that the last one becomes; if not, the tracker keeps the last
    /// one.
    pub converged: bool,
}

impl<R: Borrow<Robot>> Tracker<R> {
    /// Starts at the equilibrium for `lengths` [m] and `load` that [`direct`] finds from `start`.
    ///
    /// # Errors
    /// Those of [`direct`], and [`StaticsError::Robot`] for an invalid robot.
    pub fn new(robot: R, lengths: &[f64], load: &Load, start: &Equilibrium) -> Result<Self, StaticsError> {
        let tracked = Tracked::new(robot.borrow(), lengths, load, start)?;
        Ok(Self { robot, tracked })
    }

    /// The current equilibrium.
    pub fn equilibrium(&self) -> &Equilibrium {
        &self.tracked.equilibrium
    }

    /// The residual of the current equilibrium.
    pub fn residual(&self) -> Residual {
        self.tracked.residual
    }

    /// The shape of cable `i` at the current equilibrium, as [`DirectProblem::shape`] has it.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] for a cable that the robot does not have.
    pub fn shape(&self, i: usize, on_pulley: usize, free: usize) -> Result<CableShape, StaticsError> {
        let Tracked { lengths, load, equilibrium, .. } = &self.tracked;
        DirectProblem::new(self.robot.borrow(), lengths, load)?.shape(equilibrium, i, on_pulley, free)
    }

    /// Goes to the equilibrium for other lengths [m] and another load that the current one becomes while both
    /// change in proportion.
    ///
    /// Nothing is allocated where Newton's method ends near its prediction, at a stable equilibrium without
    /// folded cables (up to 16 cables, or 4 on x86-64 without AVX2). Otherwise the change
    /// is made in steps, and where these strain a cable too much on the way or do not end, [`direct`]
    /// searches near the current equilibrium.
    ///
    /// # Errors
    /// [`StaticsError::BranchEnds`] where the platform falls on the way, and those of [`direct`]; the
    /// equilibrium is then the one before.
    pub fn update(&mut self, lengths: &[f64], load: &Load) -> Result<&Equilibrium, StaticsError> {
        self.tracked.update(self.robot.borrow(), lengths, load)?;
        Ok(&self.tracked.equilibrium)
    }

    /// Whether [`Tracker::step`] takes the robot: one with cables of one elastic law, with a level base where
    /// it is planar, and without a motion that nothing resists at the start.
    pub fn takes_steps(&self) -> bool {
        self.tracked.in_lanes
    }

    /// Goes to the equilibrium for other lengths [m] and another load by Newton's method alone, from the last
    /// equilibrium and in at most 12 iterations: the time of a step is bounded.
    ///
    /// Where the iterations do not converge, or not certainly to the equilibrium that the last one becomes,
    /// the tracker keeps the last equilibrium with its lengths and its load; so it does where a cable without
    /// weight becomes slack or taut, which [`Tracker::update`] follows. Nothing is allocated (up to 16
    /// cables, or 4 on x86-64 without AVX2). Where it converges, the digits are those of [`Tracker::update`].
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] unless there is one finite, positive length for each cable and the load is
    /// finite, and for a robot that it does not take ([`Tracker::takes_steps`]).
    pub fn step(&mut self, lengths: &[f64], load: &Load) -> Result<TrackerStep, StaticsError> {
        let robot: &Robot = self.robot.borrow();
        if !self.takes_steps() {
            let expected = "one with cables of one elastic law and no motion that nothing resists";
            return Err(StaticsError::invalid("robot".to_owned(), &robot.name, expected));
        }
        self.tracked.newton(robot, lengths, load)
    }
}

impl Tracked {
    fn new(robot: &Robot, lengths: &[f64], load: &Load, start: &Equilibrium) -> Result<Self, StaticsError> {
        robot.validate()?;
        let solution = direct(robot, lengths, load, DirectStart::Near(start))?;
        let (equilibrium, residual) = (solution.equilibrium, solution.report.residual);
        let resisted = solution.stability.neutral().is_empty();
        let in_lanes = fits_lanes(robot) && resisted;
        Ok(Self { lengths: lengths.to_vec(), load: *load, equilibrium, residual, in_lanes, resisted })
    }

    fn update(&mut self, robot: &Robot, lengths: &[f64], load: &Load) -> Result<(), StaticsError> {
        if !self.newton(robot, lengths, load)?.converged {
            let solution = self.followed(robot, lengths, load)?;
            self.resisted = solution.stability.neutral().is_empty();
            self.residual = solution.report.residual;
            self.equilibrium = solution.equilibrium;
            self.lengths.copy_from_slice(lengths);
            self.load = *load;
        }
        Ok(())
    }

    /// A step of a robot for the lanes; others do not converge.
    fn newton(&mut self, robot: &Robot, lengths: &[f64], load: &Load) -> Result<TrackerStep, StaticsError> {
        let problem = &DirectProblem::new(robot, lengths, load)?;
        if !(self.in_lanes && self.resisted) {
            return Ok(TrackerStep { iterations: 0, converged: false });
        }
        let before = &DirectProblem { lengths: &self.lengths, load: self.load, ..*problem };
        let (iterations, found) = dispatch(Update { problem, before, equilibrium: &mut self.equilibrium });
        if let Some(residual) = found {
            self.residual = residual;
            self.lengths.copy_from_slice(lengths);
            self.load = *load;
        }
        Ok(TrackerStep { iterations, converged: found.is_some() })
    }

    fn followed(&self, robot: &Robot, lengths: &[f64], load: &Load) -> Result<DirectSolution, StaticsError> {
        let start = DirectStart::Near(&self.equilibrium);
        let now = direct(robot, &self.lengths, &self.load, start)?;
        match follow_change(robot, ((&self.lengths, &self.load), &now), (lengths, load)) {
            Err(StaticsError::Overstrained { .. } | StaticsError::DirectNotConverged { .. }) => {
                direct(robot, lengths, load, start)
            }
            followed => followed,
        }
    }
}

/// Newton's method for cables that fill the lanes. Its output is the number of iterations, and the residual
/// where it found an equilibrium, which is then assigned.
struct Update<'a> {
    problem: &'a DirectProblem<'a>,
    before: &'a DirectProblem<'a>,
    equilibrium: &'a mut Equilibrium,
}

impl WithSimd for Update<'_> {
    type Output = (usize, Option<Residual>);

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Self { problem, before, equilibrium } = self;
        let (iterations, found) = follow(simd, problem, before, equilibrium);
        let residual = found.map(|(robots, residual)| {
            problem.take(&robots, problem.pose(&robots), equilibrium);
            residual
        });
        (iterations, residual)
    }
}

/// The robot of `problem` in the equilibrium that `now`, one of the problem `before`, becomes, and the number
/// of iterations.
#[inline(always)]
fn follow<'a, S: Simd>(
    simd: S,
    problem: &DirectProblem<'a>,
    before: &DirectProblem,
    now: &Equilibrium,
) -> (usize, Option<(Robots<'a, S>, Residual)>) {
    let zero = Lanes::splat(simd, 0.0);
    let everywhere = zero.less_or_equal(zero);
    if problem.pulled(now).is_empty() {
        return (0, None);
    }
    let (mut robots, mut platform, load) = problem.linearized(simd, now);
    let scale = problem.scale(now);
    let (found, left) = solve(&mut robots, &load, &mut platform, &scale, everywhere);
    let iterations = platform.steps.count;
    if !found.any() || problem.strains_slack(&problem.pose(&robots), now) {
        return (iterations, None);
    }
    if !platform.steps.end_near_prediction(&scale).any() {
        let (_, unloaded, _) = before.linearized(simd, now);
        if !robots.on_branch(&load, &platform, &unloaded.factored, &scale, everywhere).any() {
            return (iterations, None);
        }
    }
    (iterations, Some((robots, left.norms()[0])))
}
