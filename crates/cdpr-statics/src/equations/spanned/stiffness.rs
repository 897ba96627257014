//! The stiffness of a cable between its two points.

use crate::equations::cable::{CablePlane, LinearizedCable};
use crate::equations::spanned::{EndResponse, SpannedCable, to_base, to_level};
use cdpr_cable::Catenary;
use cdpr_robot::{Matrix3, Vector3};

impl<'a> SpannedCable<'a, f64> {
    /// The misclosure in space of a cable over a tilted axis [m], in the level frame.
    fn open(&self) -> Vector3<f64> {
        self.span.plane.lift(self.misclosure()).into()
    }

    /// The cable linearized about its force; `None` for a slack cable without weight, which resists nothing.
    pub(crate) fn linearized(&self) -> Option<LinearizedInSpace<'a>> {
        let (plane, level) = (self.span.plane, self.level);
        let (predicted, stiffness) = match &self.response {
            EndResponse::Planar(response) => {
                let planar = LinearizedCable::new(&self.span, self.force, response);
                (plane.lift(planar.predicted).into(), planar.stiffness_in_space().into())
            }
            EndResponse::Spatial(spatial) => {
                let stiffness = spatial.flexibility.try_inverse().unwrap_or_else(Matrix3::zeros);
                let predicted = Vector3::from(plane.lift(self.force)) + stiffness * self.open();
                (predicted, 0.5 * (stiffness + stiffness.transpose()))
            }
            EndResponse::Slack(_) => return None,
        };
        let leaves = matches!(self.response, EndResponse::Spatial(_));
        Some(LinearizedInSpace { plane, predicted, stiffness, leaves, level })
    }

    /// Skew part of the stiffness in space [N/m], in the base frame, besides the symmetric one of
    /// [`LinearizedInSpace::stiffness`]: of a cable over a guide, whose flexibility is not quite symmetric
    /// (C22).
    pub(crate) fn skew_stiffness(&self, catenary: &Catenary) -> Option<Matrix3<f64>> {
        catenary.cable.guide?;
        let skew = match &self.response {
            EndResponse::Planar(response) => {
                let asymmetry = catenary.asymmetry();
                let determinant = response.determinant + asymmetry * asymmetry;
                let forwards = Vector3::from(self.span.plane.lift([1.0, 0.0]));
                let up = Vector3::z();
                (up * forwards.transpose() - forwards * up.transpose()) * (asymmetry / determinant)
            }
            EndResponse::Spatial(spatial) => {
                let stiffness = spatial.flexibility.try_inverse()?;
                0.5 * (stiffness - stiffness.transpose())
            }
            EndResponse::Slack(_) => return None,
        };
        Some(self.based_matrix(&skew))
    }
}

/// A cable linearized in the level frame, and the way to the base frame.
pub(crate) struct LinearizedInSpace<'a> {
    pub(crate) plane: CablePlane<f64>,
    /// Force on the cable at A that it would have if it fitted its points [N].
    predicted: Vector3<f64>,
    /// Symmetric part of the stiffness [N/m].
    stiffness: Matrix3<f64>,
    /// Whether the plane depends on the force.
    leaves: bool,
    level: Option<&'a Matrix3<f64>>,
}

impl LinearizedInSpace<'_> {
    /// Stiffness K3 [N/m] in the base frame, equation (S3): a symmetric matrix.
    pub(crate) fn stiffness(&self) -> Matrix3<f64> {
        self.level.map_or(self.stiffness, |level| level.transpose() * self.stiffness * level)
    }

    /// The force on the platform that the cable would have if it fitted its points [N].
    pub(crate) fn predicted(&self) -> [f64; 3] {
        to_base(self.level, (-self.predicted).into())
    }

    /// The force (fx, fz) on the cable [N] after a displacement of A in space [m].
    pub(crate) fn force_after(&self, displacement: [f64; 3]) -> [f64; 2] {
        let force = self.predicted + self.stiffness * Vector3::from(to_level(self.level, displacement));
        if self.leaves { [force.xy().norm(), force.z] } else { self.plane.project(force.into()) }
    }
}
