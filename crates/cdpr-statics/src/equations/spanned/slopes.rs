//! Derivatives of a cable between its two points by what it is, in the base frame.

use crate::equations::spanned::{EndResponse, SpannedCable, to_base, to_level};
use cdpr_cable::{Catenary, HeldCable, HeldSlopes, SpatialCable, SpatialSlopes};
use cdpr_robot::{Matrix3, Vector2, Vector3};

impl<'a> SpannedCable<'a, f64> {
    /// The position of the free end of the cable per unstrained length at constant force [m/m], in the base
    /// frame; zero for a slack cable without weight.
    pub(crate) fn end_per_length(&self) -> Vector3<f64> {
        let slope = match &self.response {
            EndResponse::Planar(response) => self.span.plane.lift(response.end_per_length),
            EndResponse::Spatial(spatial) => spatial.end_per_length.into(),
            EndResponse::Slack(_) => [0.0; 3],
        };
        self.based(slope.into())
    }

    /// How the free end of the cable moves with what the cable and its guide are, at constant force and
    /// length, in the base frame.
    pub(crate) fn end_slopes(&self, catenary: &Catenary<'a>) -> SpatialSlopes {
        if let Some(cable) = self.over_a_pulley(catenary) {
            let SpatialSlopes { per_weight, per_stiffness, per_lead, per_radius, per_axis } = cable.slopes();
            return SpatialSlopes {
                per_weight: self.based(per_weight),
                per_stiffness: self.based(per_stiffness),
                per_lead: self.based(per_lead),
                per_radius: self.based(per_radius),
                per_axis: self.based_matrix(&per_axis),
            };
        }
        let lift = |end: Vector2<f64>| self.based(self.span.plane.lift(end.into()).into());
        let per_lead = catenary.end_per_guide().map_or_else(Vector3::zeros, |[lead, _]| lift(lead));
        SpatialSlopes {
            per_weight: lift(catenary.end_per_weight()),
            per_stiffness: lift(catenary.end_per_stiffness()),
            per_lead,
            per_radius: Vector3::zeros(),
            per_axis: Matrix3::zeros(),
        }
    }

    /// Second derivatives of the force on the cable, which must fit its points, between its fixed ends, in
    /// the base frame; `end` [m] leads from its exit to its anchor point in the level frame.
    pub(crate) fn tension_slopes(&self, catenary: &Catenary<'a>, end: Vector3<f64>) -> HeldSlopes {
        self.based_slopes(&HeldCable::of(self.in_space(catenary), end).tension_slopes())
    }

    /// The force K3 d on the cable by which it responds to the unit motion `d` of its anchor point, with its
    /// derivatives between fixed ends, in the base frame.
    pub(crate) fn stiffness_slopes(&self, catenary: &Catenary<'a>, d: Vector3<f64>) -> HeldSlopes {
        let d = to_level(self.level, d.into()).into();
        self.based_slopes(&self.in_space(catenary).stiffness_slopes(d))
    }

    /// The force on the cable where it leaves its guide, with its derivatives between fixed ends, in the base
    /// frame.
    pub(crate) fn leave_force_slopes(&self, catenary: &Catenary<'a>) -> HeldSlopes {
        self.based_slopes(&self.in_space(catenary).leave_force_slopes())
    }

    /// The cable in space, in the level frame, if it runs over a pulley: only there do derivatives leave its
    /// plane.
    fn over_a_pulley(&self, catenary: &Catenary<'a>) -> Option<SpatialCable<'a>> {
        catenary.cable.guide.filter(|guide| guide.radius > 0.0)?;
        Some(self.in_space(catenary))
    }

    /// The cable in space, in the level frame.
    fn in_space(&self, catenary: &Catenary<'a>) -> SpatialCable<'a> {
        let Catenary { cable, unstrained_length, .. } = *catenary;
        SpatialCable { cable, unstrained_length, force: self.span.plane.lift(self.force).into() }
    }

    fn based_slopes(&self, slopes: &HeldSlopes) -> HeldSlopes {
        HeldSlopes {
            value: self.based(slopes.value),
            per_actuation: self.based(slopes.per_actuation),
            per_end: self.based_matrix(&slopes.per_end),
            per_weight: self.based(slopes.per_weight),
            per_stiffness: self.based(slopes.per_stiffness),
            per_lead: self.based(slopes.per_lead),
            per_radius: self.based(slopes.per_radius),
            per_axis: self.based_matrix(&slopes.per_axis),
        }
    }

    fn based(&self, v: Vector3<f64>) -> Vector3<f64> {
        to_base(self.level, v.into()).into()
    }

    pub(super) fn based_matrix(&self, matrix: &Matrix3<f64>) -> Matrix3<f64> {
        self.level.map_or(*matrix, |level| level.transpose() * matrix * level)
    }
}
