//! What small motions of the platform about an equilibrium depend on: masses, and the stiffness and the shape
//! of every cable.

use crate::equations::{Balance, SpannedCable, cables_at};
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::Equilibrium;
use cdpr_cable::Catenary;
use cdpr_robot::{Freedoms, Matrix3, Pose, Vector2, Vector3};
use nalgebra::Matrix6;

/// Platform and cables about an equilibrium. Motions are (dp, dφ): the translation of P [m] and a rotation
/// vector [rad], in the base frame.
#[derive(Clone, Debug)]
pub struct SmallMotions<'a> {
    /// Mass matrix of platform and payload about P, M of (V1) [kg, kg m, kg m²]; the mass on the diagonal of
    /// constrained motions.
    pub mass: Matrix6<f64>,
    /// Stiffness of the weight at its lever, the symmetric part [N/m, N, N m].
    pub weight: Matrix6<f64>,
    /// The cables.
    pub cables: Vec<CableAtRest<'a>>,
    /// The components of (dp, dφ) that are not constrained, ascending.
    pub free: Vec<usize>,
}

/// A cable of a platform in equilibrium.
#[derive(Clone, Copy, Debug)]
pub struct CableAtRest<'a> {
    /// Lever s_i of the anchor point about P, in the base frame [m].
    pub lever: Vector3<f64>,
    /// Axes of the cable's vertical plane as columns, in the base frame: horizontally towards the anchor
    /// point, across to the left, and upwards.
    pub axes: Matrix3<f64>,
    /// Whole unstrained length and force at A.
    pub catenary: Catenary<'a>,
    /// Unstrained mass per length [kg/m].
    pub linear_density: f64,
    /// Stiffness of its end, the symmetric part, in the base frame [N/m]; zero of a slack cable without
    /// weight.
    pub end_stiffness: Matrix3<f64>,
    /// Its part of the stiffness of the platform, the symmetric part [N/m, N, N m].
    pub stiffness: Matrix6<f64>,
}

impl<'a> DirectProblem<'a> {
    /// Masses, stiffnesses and cables about an equilibrium.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] for a robot that rotates without `platform.inertia`, and for an equilibrium
    /// that is not finite or has not one force for each cable.
    pub fn small_motions(&self, equilibrium: &Equilibrium) -> Result<SmallMotions<'a>, StaticsError> {
        self.check("equilibrium", equilibrium)?;
        let pose = &equilibrium.pose;
        let mass = self.mass_matrix(pose)?;
        let forces = equilibrium.cable_forces.iter().enumerate();
        let cables = forces.map(|(i, force)| self.at_rest(pose, i, self.catenary_at(pose, i, *force)));
        Ok(SmallMotions {
            mass,
            weight: Balance::of_load(self, pose).symmetric_hessian(Freedoms::ALL),
            cables: cables.collect(),
            free: self.robot.freedoms().components(),
        })
    }

    /// The cables at a pose, each in its own equilibrium, whether the platform is in one or not.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] for a pose that is not finite; [`StaticsError::Cable`] for a cable without
    /// an equilibrium there.
    pub fn cables_at(&self, pose: &Pose) -> Result<Equilibrium, StaticsError> {
        let cables = Equilibrium { pose: *pose, cable_forces: vec![Vector2::zeros(); self.cables()] };
        self.check("pose", &cables)?;
        cables_at(self, pose)
    }

    fn at_rest(&self, pose: &Pose, i: usize, catenary: Catenary<'a>) -> CableAtRest<'a> {
        let cable = SpannedCable::of(self.robot, pose, i, &self.catenary(i, catenary.force));
        let mut own = Balance::nothing();
        let mut end_stiffness = Matrix3::zeros();
        if let Some(linearized) = cable.linearized() {
            end_stiffness = linearized.stiffness();
            own.add_cable(&cable.anchor_arm, &cable.force_on_platform(), &end_stiffness.into());
        }
        CableAtRest {
            lever: cable.anchor_arm.into(),
            axes: cable.axes(),
            catenary,
            linear_density: self.robot.cables[i].properties.linear_density,
            end_stiffness,
            stiffness: own.symmetric_hessian(Freedoms::ALL),
        }
    }

    /// M of (V1) [kg, kg m, kg m²].
    fn mass_matrix(&self, pose: &Pose) -> Result<Matrix6<f64>, StaticsError> {
        let platform = &self.robot.platform;
        let freedoms = self.robot.freedoms();
        let inertia = match platform.inertia {
            Some(inertia) => inertia,
            // A platform that does not rotate needs none.
            None if (3..6).all(|k| !freedoms.contains(k)) => Matrix3::zeros(),
            None => {
                let expected = "the inertia about the centre of mass, 3 x 3 in the platform frame [kg m²]";
                return Err(StaticsError::invalid("platform.inertia".to_owned(), "missing", expected));
            }
        };
        let mass = platform.mass + self.load.payload;
        let lever = (pose.rotation * platform.center_of_mass).cross_matrix();
        let rotation = pose.rotation.matrix();
        let about_p: Matrix3<f64> = rotation * inertia * rotation.transpose() - mass * lever * lever;
        let mut matrix = Matrix6::zeros();
        matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&(mass * Matrix3::identity()));
        matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-mass * lever));
        matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&(mass * lever));
        matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&about_p);
        let mut matrix = freedoms.of_matrix(&matrix);
        (0..6).filter(|k| !freedoms.contains(*k)).for_each(|k| matrix[(k, k)] = mass);
        Ok(matrix)
    }
}
