//! Tensions of a move whose lengths do not account for the motion.
//!
//! The tensions are those of the direct model under the wrench with which platform and cables resist the
//! motion, (N17). Vibrations about this equilibrium are not in it.

use super::way::Way;
use super::{Motion, Move, SetPoint, Wrenches};
use crate::error::DynamicsError;
use cdpr_statics::{DirectProblem, DirectStart, Equilibrium, StaticsError};

impl Move<'_> {
    /// Set points with lengths at rest, with the tensions of the motion.
    pub(super) fn with_tensions(
        &self,
        way: &Way,
        mut points: Vec<SetPoint>,
    ) -> Result<Vec<SetPoint>, DynamicsError> {
        let wrenches = Wrenches::new(self, way)?;
        let mut last: Option<Equilibrium> = None;
        let end = points.len() - 1;
        for point in &mut points[1..end] {
            let motion = way.at(self.share_at(point.time));
            let found = self.carried(&wrenches, &motion, point, last.as_ref()).map_err(|source| {
                let position = motion.pose.position.into();
                DynamicsError::TooFast { time: point.time, position, cable: None, source: Box::new(source) }
            })?;
            point.tensions = found.tensions();
            point.exit_tensions = found.exit_tensions(self.robot, &point.lengths);
            last = Some(found);
        }
        Ok(points)
    }

    /// The platform in motion with the lengths of a set point.
    fn carried(
        &self,
        wrenches: &Wrenches,
        motion: &Motion,
        point: &SetPoint,
        last: Option<&Equilibrium>,
    ) -> Result<Equilibrium, StaticsError> {
        let load = wrenches.load(point.time, motion);
        let problem = DirectProblem::new(self.robot, &point.lengths, &load)?;
        let start = last.map_or(DirectStart::Pose(&point.pose), DirectStart::Near);
        Ok(problem.direct(start)?.equilibrium)
    }
}
