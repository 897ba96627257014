//! Cables of a plane as cables in space, whose plane is that of x and z.

use cdpr_cable::{Catenary, Property, PropertySlopes, SpatialCable, Vector2, Vector3};

pub(crate) fn in_space<'a>(catenary: &Catenary<'a>) -> SpatialCable<'a> {
    let Catenary { cable, unstrained_length, force } = *catenary;
    SpatialCable { cable, unstrained_length, force: Vector3::new(force.x, 0.0, force.y) }
}

/// The derivative by a property, in the plane.
pub(crate) fn by(slopes: &PropertySlopes, property: Property) -> Vector2<f64> {
    slopes.fixed_columns::<1>(property as usize).xz()
}

/// A vector of the plane over the x axis in space.
pub(crate) fn lifted(v: Vector2<f64>) -> Vector3<f64> {
    Vector3::new(v.x, 0.0, v.y)
}
