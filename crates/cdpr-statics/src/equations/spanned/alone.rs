//! The force of one cable alone between its two points, and the plane that it hangs in.

use crate::equations::spanned::{SpannedCable, end};
use crate::problem::DirectProblem;
use crate::state::Equilibrium;
use cdpr_cable::{CableError, Catenary, end_force, end_force_near, spatial_end_force};
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
        let mut catenary = self.catenary(i, near.map_or_else(Vector2::zeros, |(_, force)| *force));
        if catenary.cable.leaves_its_plane() {
            return self.spatial_force_at(pose, i, near);
        }
        let span = self.span(pose, i);
        let Some((before, force)) = near else {
            return Ok(end_force(&catenary.cable, self.lengths[i], span.end.into())?.catenary.force);
        };
        let way = Vector2::from(span.end) - Vector2::from(self.span(before, i).end);
        let predicted = force + catenary.in_plane_stiffness() * way;
        if (0.3 * force.x..3.0 * force.x).contains(&predicted.x) {
            catenary.force = predicted;
        }
        Ok(end_force_near(&catenary, span.end.into())?.catenary.force)
    }

    #[cold]
    fn spatial_force_at(
        &self,
        pose: &Pose,
        i: usize,
        near: Option<(&Pose, &Vector2<f64>)>,
    ) -> Result<Vector2<f64>, CableError> {
        let near = near.map(|(pose, force)| {
            let near = SpannedCable::of(self.robot, pose, i, &self.catenary(i, *force));
            near.span.plane.lift(near.force).into()
        });
        let force = spatial_end_force(&self.cable(i), self.lengths[i], end(self.robot, pose, i), near)?.force;
        Ok(Vector2::new(force.xy().norm(), force.z))
    }

    /// Cable i in its vertical plane, with the force (fx, fz) [N] at a pose.
    #[inline]
    pub(crate) fn catenary_at(&self, pose: &Pose, i: usize, force: Vector2<f64>) -> Catenary<'a> {
        in_its_plane(self.robot, pose, i, self.catenary(i, force))
    }
}

/// Cable i of a robot at a pose, its pulley seen in the plane that it hangs in.
#[inline]
pub(crate) fn in_its_plane<'a>(robot: &Robot, pose: &Pose, i: usize, catenary: Catenary<'a>) -> Catenary<'a> {
    if !catenary.cable.leaves_its_plane() {
        return catenary;
    }
    let plane = SpannedCable::of(robot, pose, i, &catenary).span.plane;
    Catenary { cable: catenary.cable.turned(plane.azimuth), ..catenary }
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
