//! Inverse elasto-geometrical model (IEGM, section 3.1 of the paper): unstrained lengths that hold a pose.
//!
//! Eq. (1) to (3) leave the choice of the tensions open. Among all that hold the pose, with every cable in
//! the shape that its own tension gives it, those nearest to a reference r are chosen:
//!
//! ```text
//! minimize  1/2 sum (t_i - r_i)²   subject to   sum w_i(t_i) + w_ex = 0,   min_i <= t_i <= max_i    (I1)
//! ```
//!
//! w_i is the wrench of cable i on the platform, t_i its tension there, on the branch where the tension falls
//! as cable is paid out. The direction of a sagging cable changes with its tension, and the derivative
//! dw_i/dt_i contains that change. With multipliers λ of the balance the optimum has
//!
//! ```text
//! t_i - r_i + λ·dw_i/dt_i = 0  on free cables,   >= 0 at min_i,   <= 0 at max_i                     (I2)
//! ```
//!
//! r is zero, or what the robot prefers. A robot may choose the least 1-norm or infinity-norm instead, by
//! `norm`. The limits of a cable are its own or the robot's; its least tension is at least [`ABOVE_LEAST`]
//! times what its own weight demands over its span, and a greatest tension at its exit point is converted to
//! the platform by `limits`.
//!
//! The modules below solve it in the chord force σ_i of each cable (`cdpr_cable::HeldCable`), in which all
//! derivatives are finite: `optimum` by Newton's method, `feasible` from several starts before a pose is
//! called infeasible, `branch` from the optimum at a pose nearby.

mod branch;
mod cable;
mod feasibility;
mod feasible;
mod free;
mod greatest;
mod in_turn;
mod limits;
mod maximization;
mod norm;
mod optimum;
mod problem;
mod start;
mod wanted;

#[cfg(doc)]
use crate::equations::ABOVE_LEAST;
use crate::equations::Ends;
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Load, Residual, Wanted, WantedPose, one_by_one};
use branch::KnownOptimum;
use cdpr_cable::Catenary;
use cdpr_robot::{Pose, Robot, Vector6};
use cdpr_tension::Bound;
pub use feasibility::is_feasible;
use feasible::search;
pub(crate) use free::{FreeBranch, NEXT_TO_POSE};
pub use free::{FreeSolution, FreeSolutions, LONGEST, free_solutions, rest_near};
pub(crate) use free::{lengths_at, rest};
pub use greatest::{Blocking, Greatest, greatest_payload, tension_margin};
pub(crate) use in_turn::InTurn;
pub use limits::limits_at;
use norm::chosen;
pub(crate) use norm::require_smooth;
pub(crate) use optimum::NEARLY_ROUNDING;
use optimum::Optimum;
use problem::InverseProblem;
use std::borrow::Borrow;
pub(crate) use wanted::refuse_offsets;
use wanted::{pose_alone, whole};

/// Unstrained lengths that hold a pose in balance.
///
/// With free coordinates the balance leaves no choice of the tensions: no bound is active, and multipliers
/// and `stationarity` are zero.
#[derive(Clone, Debug, PartialEq)]
pub struct InverseSolution {
    /// Unstrained length of every cable [m].
    pub lengths: Vec<f64>,
    /// Tension of every cable at the platform [N].
    pub tensions: Vec<f64>,
    /// The bound each tension rests on, if any.
    pub active: Vec<Option<Bound>>,
    /// Multipliers λ of the balance in (I2): of its forces [N], of its moments [N/m]; where a 1-norm or
    /// infinity-norm is least, its derivatives by the wrench [1, 1/m].
    pub multipliers: Vector6<f64>,
    /// The pose with the cables' forces.
    pub equilibrium: Equilibrium,
    /// Iterations of Newton's method, of all starts, or linear programs; zero for one of many poses that was
    /// found in lanes.
    pub iterations: usize,
    /// What is left of (I2) in the worst cable, or what a norm would gain to first order [N].
    pub stationarity: f64,
    /// Residuals of all equations.
    pub residual: Residual,
}

/// [`crate::inverse`] at a whole pose.
///
/// # Errors
/// Those of [`crate::inverse`].
pub(crate) fn inverse_at(
    robot: &Robot,
    pose: &Pose,
    load: &Load,
    reference: Option<&[f64]>,
) -> Result<InverseSolution, StaticsError> {
    let problem = InverseProblem::of_whole_pose(robot, pose, load, reference)?;
    InverseSolution::new(&problem, chosen(&problem)?)
}

/// The inverse model along a path: each pose is solved on the branch of the one before.
///
/// (I1) may have several local minima. While pose, load and reference go straight from one problem to the
/// next, a strict local minimum moves along a curve, its branch, until it ceases to be a minimum or to exist.
/// The branch is followed, so that lengths are continuous, also where another branch becomes better. Only
/// where it ends is the next pose solved as by [`crate::inverse`]; this is a jump.
///
/// The path borrows the robot, or owns it, as in an [`std::sync::Arc`].
///
/// ```
/// use cdpr_robot::{Pose, Robot};
/// use cdpr_statics::{InversePath, Load};
///
/// let robot = Robot::from_library("caroca")?;
/// let mut path = InversePath::new(&robot);
/// for k in 0..=10 {
///     let found = path.solve(Pose::at(0.1 * f64::from(k), 0.0, 1.75), &Load::none())?;
///     assert!(!found.jump && found.solution.lengths.len() == 8);
/// }
/// # Ok::<(), cdpr_statics::StaticsError>(())
/// ```
#[derive(Clone, Debug)]
pub struct InversePath<R: Borrow<Robot>> {
    robot: R,
    last: Option<KnownOptimum>,
    /// The tensions at the last pose that has a solution [N].
    tensions: Vec<f64>,
    /// Greatest change of a tension from one pose to the next [N].
    change: f64,
}

/// A pose of a path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathSolution {
    /// The unstrained lengths that hold it.
    pub solution: InverseSolution,
    /// Whether the branch of the last solution ended on the way, so that the lengths may jump.
    pub jump: bool,
}

impl<R: Borrow<Robot>> InversePath<R> {
    /// A path of `robot` that has yet to begin.
    pub fn new(robot: R) -> Self {
        Self { robot, last: None, tensions: Vec::new(), change: f64::INFINITY }
    }

    /// Allows no tension at the platform to change by more than `change` [N] from one pose to the next: a
    /// new reference, or the lengths after a jump, are then approached pose by pose.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] unless it is positive; infinity is no limit.
    pub fn limit_change(&mut self, change: f64) -> Result<(), StaticsError> {
        if change > 0.0 {
            self.change = change;
            return Ok(());
        }
        Err(StaticsError::invalid("change".to_owned(), change, "a positive tension [N]"))
    }

    /// The lengths at the next pose; the first one is solved as by [`crate::inverse`].
    ///
    /// # Errors
    /// Those of [`crate::inverse`], and [`StaticsError::Invalid`] for free coordinates, which a path does not
    /// take, and for a distribution that jumps from pose to pose; [`StaticsError::TensionChange`] where no
    /// tensions as near to the last ones as [`InversePath::limit_change`] demands hold the pose. The path
    /// then goes on from the last pose that has a solution.
    pub fn solve<'w>(
        &mut self,
        wanted: impl Into<WantedPose<'w>>,
        load: &Load,
    ) -> Result<PathSolution, StaticsError> {
        let WantedPose { pose, tension_reference, .. } = whole(wanted.into())?;
        let robot: &Robot = self.robot.borrow();
        if tension_reference.is_none() {
            require_smooth(robot)?;
        }
        let mut problem = InverseProblem::of_whole_pose(robot, &pose, load, tension_reference)?;
        let limited = self.change.is_finite() && self.last.is_some();
        let too_far = |source| match limited {
            true => StaticsError::TensionChange { change: self.change, source: Box::new(source) },
            false => source,
        };
        if limited {
            problem.narrow(&self.tensions, self.change).map_err(too_far)?;
        }
        let followed = self.last.as_ref().and_then(|last| last.followed(&problem));
        let jump = self.last.is_some() && followed.is_none();
        let optimum = followed.map_or_else(|| search(&problem), Ok).map_err(too_far)?;
        let known = KnownOptimum::new(&problem, &optimum);
        let solution = InverseSolution::new(&problem, optimum)?;
        self.last = Some(known);
        self.tensions.clone_from(&solution.tensions);
        Ok(PathSolution { solution, jump })
    }
}

/// The optimum of a robot at a pose, from which those of robots that differ from it are found.
#[derive(Clone, Debug)]
pub(crate) struct Branch(KnownOptimum);

impl Branch {
    /// The inverse model of `robot` at `pose` under its own weight, as [`crate::inverse`] finds it.
    ///
    /// # Errors
    /// Those of [`crate::inverse`].
    pub(crate) fn of(robot: &Robot, pose: &Pose) -> Result<(InverseSolution, Self), StaticsError> {
        let none = Load::none();
        let problem = InverseProblem::of_whole_pose(robot, pose, &none, None)?;
        let optimum = search(&problem)?;
        let branch = Self(KnownOptimum::new(&problem, &optimum));
        Ok((InverseSolution::new(&problem, optimum)?, branch))
    }

    /// The inverse model of a robot that differs a little: the local minimum of (I1) to which Newton's method
    /// leads from this one, or else the one that [`crate::inverse`] finds.
    ///
    /// # Errors
    /// Those of [`crate::inverse`].
    pub(crate) fn nearby(&self, robot: &Robot, pose: &Pose) -> Result<InverseSolution, StaticsError> {
        let none = Load::none();
        let problem = InverseProblem::of_whole_pose(robot, pose, &none, None)?;
        let near = self.0.corrected(&problem, &mut 0).or_else(|| self.0.optimized(&problem));
        let optimum = near.map_or_else(|| search(&problem), |point| Ok(point.optimum()))?;
        InverseSolution::new(&problem, optimum)
    }
}

impl InverseSolution {
    fn new(problem: &InverseProblem, optimum: Optimum) -> Result<Self, StaticsError> {
        let Optimum { catenaries, tensions, active, multipliers, iterations, stationarity, .. } = optimum;
        let PoseLengths { lengths, equilibrium } = PoseLengths::new(problem.pose, &catenaries);
        let direct = DirectProblem::new(problem.robot, &lengths, problem.load)?;
        direct.check_strains(&equilibrium)?;
        let residual = Residual::of(&direct, &equilibrium);
        Ok(Self { lengths, tensions, active, multipliers, equilibrium, iterations, stationarity, residual })
    }
}

/// Unstrained lengths that give tensions at a pose; fixed there the platform need not be in balance.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseLengths {
    /// Unstrained length of every cable [m].
    pub lengths: Vec<f64>,
    /// The pose with the cables' forces.
    pub equilibrium: Equilibrium,
}

impl PoseLengths {
    fn new(pose: &Pose, catenaries: &[Catenary]) -> Self {
        let lengths = catenaries.iter().map(|catenary| catenary.unstrained_length).collect();
        let cable_forces = catenaries.iter().map(|catenary| catenary.force).collect();
        Self { lengths, equilibrium: Equilibrium { pose: *pose, cable_forces } }
    }
}

/// The unstrained lengths that give each cable the tension `tensions[i]` [N] at the platform, fixed at a pose
/// or at each of many.
///
/// A cable whose own weight demands more over its span, or nearly as much, gets 1.001 times the least tension
/// that it demands.
///
/// # Errors
/// [`StaticsError::Invalid`] unless there is one tension for each cable, and for free coordinates, offsets or
/// a reference of the tensions; [`StaticsError::Cable`] for a tension that is not positive and finite.
pub fn lengths_for_tensions<W: Wanted>(
    robot: &Robot,
    wanted: W,
    tensions: &[f64],
) -> W::Results<Result<PoseLengths, StaticsError>> {
    one_by_one(wanted, |wanted| with_tensions(robot, &pose_alone(*wanted)?, tensions))
}

fn with_tensions(robot: &Robot, pose: &Pose, tensions: &[f64]) -> Result<PoseLengths, StaticsError> {
    StaticsError::one_per_cable("tensions", tensions, robot.cables.len())?;
    let catenaries = tensions.iter().enumerate().map(|(i, tension)| {
        let ends = Ends::of(robot, pose, i);
        let at_tension = || Ok(ends.at_tension(ends.least_allowed(*tension)?)?.catenary);
        at_tension().map_err(StaticsError::cable(i))
    });
    Ok(PoseLengths::new(pose, &catenaries.collect::<Result<Vec<_>, _>>()?))
}
