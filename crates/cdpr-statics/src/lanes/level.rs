//! Gravity of the robots in the lanes, and the level frame of each, whose z axis points against it.
//!
//! The equations in lanes are those of a level base. Robots with gravity in another direction are rotated at
//! the border: their points, pose and load into the level frame of their lane, and the result back. The
//! rotation is that of [`cdpr_robot::Gravity::level`].

use cdpr_number::Number;
use cdpr_number::dense::{Lanes3, Lanes6, halves};
use cdpr_number::lanes::{Lanes, Mask, Simd};
use cdpr_number::three;
use cdpr_number::vector::dot;

/// Rotation to the level frame of each lane, by its rows.
pub(crate) struct LevelFrame<S: Simd> {
    rows: [Lanes3<S>; 3],
}

impl<S: Simd> LevelFrame<S> {
    /// The level frame where gravity has the components `gravity` [m/s²], its magnitude [m/s²], and the lanes
    /// where it has a direction.
    #[inline(always)]
    pub(crate) fn of_gravity(gravity: &Lanes3<S>) -> (Self, Lanes<S>, Mask<S>) {
        let zero = gravity[0].all(0.0);
        let one = zero.all(1.0);
        let magnitude = dot(gravity, gravity).sqrt();
        let directed = zero.all(f64::MIN_POSITIVE).less_or_equal(magnitude)
            & magnitude.less_or_equal(zero.all(f64::MAX));
        let [x, y, z] = three!(|k| -gravity[k] / magnitude);
        let square = x * x + y * y;
        let horizontal = square.sqrt();
        let vertical = horizontal.less_or_equal(zero);
        let c = vertical.select(one, x / horizontal);
        let s = vertical.select(zero, y / horizontal);
        let upwards = zero.less_or_equal(z);
        let k = upwards.select(square / (one + z), one - z);
        let (cc, cs, ss) = (one - c * c * k, -(c * s * k), one - s * s * k);
        (Self { rows: [[cc, cs, -x], [cs, ss, -y], [x, y, z]] }, magnitude, directed)
    }

    /// Coordinates in the level frame of a vector with coordinates `v` in the base frame.
    #[inline(always)]
    pub(crate) fn to_level(&self, v: &Lanes3<S>) -> Lanes3<S> {
        three!(|i| dot(&self.rows[i], v))
    }

    /// The same of a wrench or a twist.
    #[inline(always)]
    pub(crate) fn both_to_level(&self, v: &Lanes6<S>) -> Lanes6<S> {
        let (first, second) = halves(v);
        let ([a, b, c], [d, e, f]) = (self.to_level(&first), self.to_level(&second));
        [a, b, c, d, e, f]
    }

    /// Coordinates in the base frame of a vector with coordinates `v` in the level frame.
    #[inline(always)]
    pub(crate) fn to_base(&self, v: &Lanes3<S>) -> Lanes3<S> {
        three!(|k| self.rows[0][k] * v[0] + self.rows[1][k] * v[1] + self.rows[2][k] * v[2])
    }
}
