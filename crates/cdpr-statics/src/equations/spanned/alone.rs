//! The force of one cable alone between its two points, and the plane that it hangs in.

use crate::equations::spanned::{SpannedCable, azimuth, end};
use crate::problem::DirectProblem;
use crate::state::Equilibrium;
use cdpr_cable::{CableError, Catenary, spatial_end_force};
use cdpr_robot::{Pose, Robot, Vector2};

impl<'a> DirectProblem<'a> {
    /// The force (fx, fz) [N] of cable i in its own equilibrium at a pose, searched from a force at a pose
    /// nearby.
    pub(crate) fn force_at(
        &self,
        pose: &Pose,
        i: usize,
        near: Option<(&Pose, &Vector2<f64>)>,
    ) -> Result<Vector2<f64>, CableError> {
        let now = end(self.robot, pose, i);
        let near = near.and_then(|(before, force)| {
            let cable = SpannedCable::of(self.robot, before, i, &self.catenary(i, *force));
            let way = self.robot.span(pose, i) - self.robot.span(before, i);
            let predicted = cable.linearized()?.force_after(way.into());
            let is_near = (0.3 * force.x..3.0 * force.x).contains(&predicted[0]);
            Some(cable.span.plane.lift(if is_near { predicted } else { cable.force }).into())
        });
        let force = spatial_end_force(&self.cable(i), self.lengths[i], now, near)?.force;
        Ok(Vector2::new(force.xy().norm(), force.z))
    }

    /// Cable i in its vertical plane, with the force (fx, fz) [N] at a pose.
    #[inline]
    pub(crate) fn catenary_at(&self, pose: &Pose, i: usize, force: Vector2<f64>) -> Catenary<'a> {
        in_its_plane(self.robot, pose, i, self.catenary(i, force))
    }
}

/// Azimuth of the plane that a cable hangs in, and its unstrained length beyond the leave point [m].
pub(crate) fn guided_place(robot: &Robot, pose: &Pose, i: usize, catenary: Catenary) -> ([f64; 2], f64) {
    let azimuth = azimuth(robot, pose, i, &catenary);
    let cable = catenary.cable.turned(azimuth);
    (azimuth, Catenary { cable, ..catenary }.free_length())
}

/// Cable i of a robot at a pose, its pulley seen in the plane that it hangs in.
#[inline]
pub(crate) fn in_its_plane<'a>(robot: &Robot, pose: &Pose, i: usize, catenary: Catenary<'a>) -> Catenary<'a> {
    if !catenary.cable.leaves_its_plane() {
        return catenary;
    }
    Catenary { cable: catenary.cable.turned(azimuth(robot, pose, i, &catenary)), ..catenary }
}

impl Equilibrium {
    /// Tension of every cable at its exit point [N], for the robot and unstrained lengths [m] that it is an
    /// equilibrium of; over a pulley where the cable leaves it.
    pub fn exit_tensions(&self, robot: &Robot, lengths: &[f64]) -> Vec<f64> {
        let each = self.cable_forces.iter().zip(lengths).enumerate();
        each.map(|(i, (force, length))| {
            let catenary = Catenary { cable: robot.cable(i), unstrained_length: *length, force: *force };
            in_its_plane(robot, &self.pose, i, catenary).exit_tension()
        })
        .collect()
    }
}
