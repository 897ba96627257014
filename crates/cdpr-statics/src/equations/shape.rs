//! The shape of a cable in space, from the winch's end of its pulley to the platform.

use crate::equations::cable::Span;
use crate::equations::spanned::{SpannedCable, to_base};
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::Equilibrium;
use cdpr_robot::{Vector2, Vector3};

/// The shape of a cable in the base frame.
#[derive(Clone, Debug, PartialEq)]
pub struct CableShape {
    /// Points on the pulley, from where the cable enters it, and beyond to the anchor point [m].
    pub points: Vec<Vector3<f64>>,
    /// The wheel: points around it, of which the last is the first [m]; empty without a pulley.
    pub wheel: Vec<Vector3<f64>>,
    /// Angle over which the cable lies on its pulley [rad]; zero without one.
    pub wrap: f64,
    /// Greatest distance of the free cable across its chord [m].
    pub sag: f64,
}

impl DirectProblem<'_> {
    /// The sag of every cable at an equilibrium [m]: the greatest distance across its chord, beyond its
    /// pulley.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] unless the equilibrium is finite and has one force for each cable.
    pub fn sags(&self, equilibrium: &Equilibrium) -> Result<Vec<f64>, StaticsError> {
        self.check("equilibrium", equilibrium)?;
        let forces = equilibrium.cable_forces.iter().enumerate();
        Ok(forces.map(|(i, force)| self.catenary_at(&equilibrium.pose, i, *force).sag()).collect())
    }

    /// The shape of cable `i` at an equilibrium: `on_pulley` points on its pulley, if it has one, and `free`
    /// points beyond, both at equal distances along the cable.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] unless the equilibrium is finite and has one force for each cable, and for a
    /// cable that the robot does not have.
    pub fn shape(
        &self,
        equilibrium: &Equilibrium,
        i: usize,
        on_pulley: usize,
        free: usize,
    ) -> Result<CableShape, StaticsError> {
        self.check("equilibrium", equilibrium)?;
        if i >= self.cables() {
            let expected = format!("a cable of 0 to {}", self.cables() - 1);
            return Err(StaticsError::invalid("cable".to_owned(), i, expected));
        }
        let (pose, force) = (&equilibrium.pose, equilibrium.cable_forces[i]);
        let catenary = self.catenary_at(pose, i, force);
        let Span { plane, .. } = SpannedCable::of(self.robot, pose, i, &self.catenary(i, force)).span;
        let exit = self.robot.cables[i].exit_point;
        let forwards = Vector3::from(plane.lift([1.0, 0.0]));
        let across = Vector3::z().cross(&forwards);
        // From forwards, across and upwards.
        let in_space = |point: Vector3<f64>| {
            let level = forwards * point.x + across * point.y + Vector3::z() * point.z;
            exit + Vector3::from(to_base(self.robot.gravity.level(), level.into()))
        };
        let sideways = catenary.leave_beside();
        let in_plane = |point: Vector2<f64>| Vector3::new(point.x, sideways, point.y);
        let beyond = catenary.profile(free).into_iter().map(in_plane);
        Ok(CableShape {
            points: catenary.on_the_pulley(on_pulley).into_iter().chain(beyond).map(in_space).collect(),
            wrap: catenary.wrap(),
            wheel: catenary.wheel(4 * on_pulley).into_iter().map(in_space).collect(),
            sag: catenary.sag(),
        })
    }
}
