//! The inverse model at poses that follow each other, most of which are solved by other means.
//!
//! Where the last pose had no tensions, the next one is likely to have none, and the tensions that came
//! nearest to a balance there are near the least residual here.

use super::feasible::refused;
use super::optimum::Point;
use super::problem::InverseProblem;
use super::{InverseSolution, inverse_at};
use crate::error::StaticsError;
use crate::state::Load;
use cdpr_robot::{Pose, Robot};

/// A robot and its load at one pose after the other.
pub(crate) struct InTurn<'a> {
    robot: &'a Robot,
    load: &'a Load,
    /// The tensions [N] that came nearest to a balance at the last pose, if it has no balance.
    nearest: Option<Vec<f64>>,
}

impl<'a> InTurn<'a> {
    pub(crate) fn new(robot: &'a Robot, load: &'a Load) -> Self {
        Self { robot, load, nearest: None }
    }

    /// The result of [`crate::inverse`] at the next pose.
    pub(crate) fn solve(&mut self, pose: &Pose) -> Result<InverseSolution, StaticsError> {
        match self.refusal(pose) {
            Some(refusal) => Err(refusal),
            None => self.solution(pose),
        }
    }

    /// The proof that a pose has no tensions, from the last pose that had none.
    pub(crate) fn refusal(&mut self, pose: &Pose) -> Option<StaticsError> {
        let nearest = self.nearest.as_ref()?;
        let problem = InverseProblem::of_whole_pose(self.robot, pose, self.load, None).ok()?;
        let refusal = refused(&problem, &Point::new(&problem, nearest).ok()?, None)?;
        self.keep(&refusal);
        Some(refusal)
    }

    /// The result of [`crate::inverse`] at a pose that is not refused.
    pub(crate) fn solution(&mut self, pose: &Pose) -> Result<InverseSolution, StaticsError> {
        self.nearest = None;
        inverse_at(self.robot, pose, self.load, None).inspect_err(|refusal| self.keep(refusal))
    }

    /// The last pose has a solution, found by other means.
    pub(crate) fn solved_elsewhere(&mut self) {
        self.nearest = None;
    }

    fn keep(&mut self, refusal: &StaticsError) {
        if let StaticsError::NoTensions { tensions, .. } = refusal {
            self.nearest = Some(tensions.clone());
        }
    }
}
