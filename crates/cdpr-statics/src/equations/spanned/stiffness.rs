//! The stiffness of a cable between its two points.

use crate::equations::cable::{CablePlane, LinearizedCable};
use crate::equations::spanned::{Answer, SpannedCable, to_base, to_level};
use cdpr_cable::Catenary;
use cdpr_robot::{Matrix3, Vector3};

impl<'a> SpannedCable<'a, f64> {
    /// The misclosure in space of a cable over a tilted axis [m], in the level frame.
    fn open(&self) -> Vector3<f64> {
        self.span.plane.lift(self.misclosure()).into()
    }

    /// The cable linearised about its force; `None` for a slack cable without weight, which resists nothing.
    #[inline(always)]
    pub(crate) fn linearized(&self) -> Option<SpannedStiffness<'a>> {
        match &self.answer {
            Answer::Planar(response) if self.level.is_none() => {
                Some(SpannedStiffness::Level(LinearizedCable::new(&self.span, self.force, response)))
            }
            _ => self.turned(),
        }
    }

    #[cold]
    fn turned(&self) -> Option<SpannedStiffness<'a>> {
        let (plane, level) = (self.span.plane, self.level);
        let (predicted, stiffness) = match &self.answer {
            Answer::Planar(response) => {
                let planar = LinearizedCable::new(&self.span, self.force, response);
                (plane.lift(planar.predicted).into(), planar.stiffness_in_space().into())
            }
            Answer::Spatial(spatial) => {
                let stiffness = spatial.flexibility.try_inverse().unwrap_or_else(Matrix3::zeros);
                let predicted = Vector3::from(plane.lift(self.force)) + stiffness * self.open();
                (predicted, 0.5 * (stiffness + stiffness.transpose()))
            }
            Answer::Limp(_) => return None,
        };
        let leaves = matches!(self.answer, Answer::Spatial(_));
        Some(SpannedStiffness::Turned(Box::new(Turned { plane, predicted, stiffness, leaves, level })))
    }

    /// Skew part of the stiffness in space [N/m], in the base frame, besides the symmetric one of
    /// [`SpannedStiffness::stiffness`]: of a cable over a guide, whose flexibility is not quite symmetric
    /// (C22).
    pub(crate) fn skew_stiffness(&self, catenary: &Catenary) -> Option<Matrix3<f64>> {
        catenary.cable.guide?;
        let skew = match &self.answer {
            Answer::Planar(response) => {
                let asymmetry = catenary.asymmetry();
                let determinant = response.determinant + asymmetry * asymmetry;
                let forwards = Vector3::from(self.span.plane.lift([1.0, 0.0]));
                let up = Vector3::z();
                (up * forwards.transpose() - forwards * up.transpose()) * (asymmetry / determinant)
            }
            Answer::Spatial(spatial) => {
                let stiffness = spatial.flexibility.try_inverse()?;
                0.5 * (stiffness - stiffness.transpose())
            }
            Answer::Limp(_) => return None,
        };
        Some(self.based_matrix(&skew))
    }
}

/// The stiffness of a cable in space, with the force on which it bears.
pub(crate) enum SpannedStiffness<'a> {
    /// In the vertical plane of its span, on a level base.
    Level(LinearizedCable<f64>),
    /// Any other.
    Turned(Box<Turned<'a>>),
}

/// A cable in the level frame, and the way to the base frame.
pub(crate) struct Turned<'a> {
    pub(crate) plane: CablePlane<f64>,
    /// Force on the cable at A [N].
    predicted: Vector3<f64>,
    /// Symmetric part of the stiffness [N/m].
    stiffness: Matrix3<f64>,
    /// Whether the plane depends on the force.
    leaves: bool,
    level: Option<&'a Matrix3<f64>>,
}

impl SpannedStiffness<'_> {
    /// Stiffness K3 [N/m] in the base frame, equation (S3): a symmetric matrix.
    #[inline(always)]
    pub(crate) fn stiffness(&self) -> [[f64; 3]; 3] {
        match self {
            Self::Level(cable) => cable.stiffness_in_space(),
            Self::Turned(cable) => cable.stiffness(),
        }
    }

    /// The force on the platform that the cable would have if it fitted its points [N].
    #[inline(always)]
    pub(crate) fn predicted(&self) -> [f64; 3] {
        match self {
            Self::Level(cable) => cable.plane.force_on_platform(cable.predicted),
            Self::Turned(cable) => to_base(cable.level, (-cable.predicted).into()),
        }
    }
}

impl Turned<'_> {
    #[cold]
    fn stiffness(&self) -> [[f64; 3]; 3] {
        self.level.map_or(self.stiffness, |level| level.transpose() * self.stiffness * level).into()
    }

    /// The force (fx, fz) on the cable [N] after a displacement of A in space [m].
    #[cold]
    pub(crate) fn force_after(&self, displacement: [f64; 3]) -> [f64; 2] {
        let force = self.predicted + self.stiffness * Vector3::from(to_level(self.level, displacement));
        if self.leaves { [force.xy().norm(), force.z] } else { self.plane.project(force.into()) }
    }
}
