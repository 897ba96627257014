//! Derivatives of a cable between its two points by what it is, in the base frame.

use crate::equations::spanned::{EndResponse, SpannedCable, to_base};
use cdpr_cable::{Catenary, HeldSlopes, Property, PropertySlopes, SpatialCable};
use cdpr_robot::{Matrix3, Vector3};

impl<'a> SpannedCable<'a, f64> {
    /// The position of the free end of the cable per unstrained length at constant force [m/m], in the base
    /// frame; zero for a slack cable without weight.
    pub(crate) fn end_per_length(&self) -> Vector3<f64> {
        let slope = match &self.response {
            EndResponse::Planar(response) => self.span.plane.lift(response.end_per_length),
            EndResponse::Spatial(spatial) => spatial.end_per_length.into(),
            EndResponse::Slack(_) => [0.0; 3],
        };
        to_base(self.level, slope).into()
    }

    /// How the free end of the cable moves with what the cable and its guide are, at constant force and
    /// length, in the base frame.
    pub(crate) fn end_slopes(&self, catenary: &Catenary<'a>) -> PropertySlopes {
        turned(&self.axes(), &self.in_its_axes(catenary).slopes())
    }

    /// v = dF/dt of the force on the cable between its fixed ends, with its derivatives at given tension, in
    /// the base frame.
    pub(crate) fn tension_slopes(&self, catenary: &Catenary<'a>) -> HeldSlopes {
        self.in_base(&self.in_its_axes(catenary).tension_slopes())
    }

    /// The force K3 d on the cable by which it responds to the unit motion `d` of its anchor point, with its
    /// derivatives between fixed ends, in the base frame.
    pub(crate) fn stiffness_slopes(&self, catenary: &Catenary<'a>, d: Vector3<f64>) -> HeldSlopes {
        self.in_base(&self.in_its_axes(catenary).stiffness_slopes(self.axes().tr_mul(&d)))
    }

    /// The force on the cable where it leaves its guide, with its derivatives between fixed ends, in the base
    /// frame.
    pub(crate) fn leave_force_slopes(&self, catenary: &Catenary<'a>) -> HeldSlopes {
        self.in_base(&self.in_its_axes(catenary).leave_force_slopes())
    }

    /// Axes of the plane that the cable hangs in as columns, in the base frame: horizontally towards the
    /// anchor point, across to the left, and upwards.
    pub(crate) fn axes(&self) -> Matrix3<f64> {
        let [x, y] = self.span.plane.azimuth;
        let axes = Matrix3::new(x, -y, 0.0, y, x, 0.0, 0.0, 0.0, 1.0);
        self.level.map_or(axes, |level| level.tr_mul(&axes))
    }

    /// The cable in space, in the axes of its plane: that of x and z.
    fn in_its_axes(&self, catenary: &Catenary<'a>) -> SpatialCable<'a> {
        let ([fx, fz], cable) = (self.force, catenary.cable.turned(self.span.plane.azimuth));
        let unstrained_length = catenary.unstrained_length;
        SpatialCable { cable, unstrained_length, force: Vector3::new(fx, 0.0, fz) }
    }

    fn in_base(&self, slopes: &HeldSlopes) -> HeldSlopes {
        let axes = self.axes();
        HeldSlopes {
            value: axes * slopes.value,
            per_actuation: axes * slopes.per_actuation,
            per_end: axes * slopes.per_end * axes.transpose(),
            per_property: turned(&axes, &slopes.per_property),
        }
    }

    pub(super) fn based_matrix(&self, matrix: &Matrix3<f64>) -> Matrix3<f64> {
        self.level.map_or(*matrix, |level| level.transpose() * matrix * level)
    }
}

/// Derivatives of a vector in the frame whose axes are given as columns, in the base frame: so is the
/// direction in which the cable enters its pulley.
fn turned(axes: &Matrix3<f64>, slopes: &PropertySlopes) -> PropertySlopes {
    let mut turned = axes * slopes;
    let mut per_axis = turned.fixed_columns_mut::<3>(Property::Axis as usize);
    per_axis.copy_from(&(per_axis.clone_owned() * axes.transpose()));
    turned
}
