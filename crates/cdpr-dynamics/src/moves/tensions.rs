//! Tensions of a move.
//!
//! Those of the direct model under the wrench with which platform and cables resist the motion, (N17), with
//! what each cable needs for its own motion, (N24). Vibrations about this equilibrium are not in it.

use super::inertia::{Resistance, outwards};
use super::way::Way;
use super::{Move, SetPoint, Wrenches};
use crate::error::DynamicsError;
use cdpr_statics::{DirectProblem, DirectStart, Equilibrium, Load, StaticsError};

impl Move<'_> {
    /// Set points with lengths, with the tensions of the motion.
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
            let own = wrenches.own(point.time, &motion);
            let load = wrenches.load(&motion, &own);
            let found = self.carry(point, &load, &own, last.as_ref()).map_err(|source| {
                let position = motion.pose.position.into();
                DynamicsError::TooFast { time: point.time, position, cable: None, source: Box::new(source) }
            })?;
            last = Some(found);
        }
        Ok(points)
    }

    /// Sets the tensions of a set point; the platform in motion with its lengths.
    fn carry(
        &self,
        point: &mut SetPoint,
        load: &Load,
        own: &[Resistance],
        last: Option<&Equilibrium>,
    ) -> Result<Equilibrium, StaticsError> {
        let problem = DirectProblem::new(self.robot, &point.lengths, load)?;
        let start = last.map_or(DirectStart::Pose(&point.pose), DirectStart::Near);
        let found = problem.direct(start)?.equilibrium;
        let cables = problem.small_motions(&found)?.cables;
        let at_exit = found.exit_tensions(self.robot, &point.lengths);
        point.tensions.clear();
        point.exit_tensions.clear();
        // (N24)
        for ((cable, own), at_exit) in cables.iter().zip(own).zip(at_exit) {
            let pull = outwards(cable) * cable.catenary.force.norm();
            point.tensions.push((pull - own.force).norm());
            point.exit_tensions.push((at_exit + own.at_exit).max(0.0));
        }
        Ok(found)
    }
}
