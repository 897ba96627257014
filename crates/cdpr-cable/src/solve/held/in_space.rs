//! Cables over a pulley with a tilted axis.
//!
//! The equations are those of [`crate::SpatialCable`] in space. With the flexibility A = dA/dF of (C22) and
//! `F_L = -A⁻¹ dA/dL` the force between held ends changes with the length. Its change with the chord force
//! `σ = fx c/h` of (C16), with the horizontal part of the force at A, is
//!
//! ```text
//! F' = F_L h/(c fx_L),      L' = h/(c fx_L),      fx_L = e_h·F_L                                  (C27)
//! ```
//!
//! Second derivatives are (C27) differentiated by dual numbers.

use super::{HeldCable, per_horizontal};
use crate::cable::{Cable, Numbers};
use crate::catenary::Catenary;
use crate::catenary::spatial::{SpatialCable, flat, horizontal, response, solve};
use crate::error::CableError;
use cdpr_number::{Dual, Real};
use nalgebra::Vector3;

impl<'a> HeldCable<'a> {
    /// d²F/dσ² [1/N].
    pub(super) fn curvature_in_space(&self) -> Vector3<f64> {
        let along = |value: f64, slope: f64| Dual { value, slopes: [slope] };
        let now = self.in_space();
        let force = [0, 1, 2].map(|k| along(now.force[k], self.force_slope[k]));
        let plain = now.numbers();
        let length = along(plain.length, self.length_slope);
        let numbers = Numbers { length, ..plain.map(Dual::<f64, 1>::of) };
        let per_length = force_per_length(&now.cable, &numbers, &force);
        let (_, [c, s]) = horizontal(&force);
        let fx = c * per_length[0] + s * per_length[1];
        let share = 1.0 / per_horizontal(self.end);
        Vector3::from(per_length.map(|slope| (slope * share / fx).slopes[0]))
    }

    /// The derivatives of a cable in space.
    pub(super) fn at_in_space(
        catenary: Catenary<'a>,
        azimuth: [f64; 2],
        end: Vector3<f64>,
        chord_force: f64,
    ) -> Self {
        let zero = Vector3::zeros();
        let held = Self { catenary, azimuth, end, chord_force, force_slope: zero, length_slope: 0.0 };
        let SpatialCable { cable, force, .. } = held.in_space();
        let numbers = cable.numbers(catenary.unstrained_length);
        let per_length = Vector3::from(force_per_length(&cable, &numbers, &force.into()));
        let [c, s] = azimuth;
        let length_slope = 1.0 / (per_horizontal(end) * (c * per_length.x + s * per_length.y));
        Self { force_slope: per_length * length_slope, length_slope, ..held }
    }

    /// Newton's method for force and length at a chord force.
    pub(super) fn close_in_space(
        cable: &Cable<'a>,
        end: Vector3<f64>,
        chord_force: f64,
        (force, unstrained_length): (Vector3<f64>, f64),
    ) -> Result<Self, CableError> {
        const MAX_ITERATIONS: usize = 50;
        let fx = chord_force / per_horizontal(end);
        let mut now = SpatialCable { cable: *cable, unstrained_length, force };
        let mut before = f64::INFINITY;
        for iteration in 1..=MAX_ITERATIONS {
            let response = now.response();
            let residual = end - response.end;
            let failed = CableError::NotConverged { iterations: iteration, residual: residual.norm() };
            let inverse = response.flexibility.try_inverse().ok_or_else(|| failed.clone())?;
            let (closing, per_length) = (inverse * residual, -inverse * response.end_per_length);
            let (own, [c, s]) = horizontal(&now.force.into());
            let forwards = |v: &Vector3<f64>| c * v.x + s * v.y;
            let length = (fx - own - forwards(&closing)) / forwards(&per_length);
            let force = closing + per_length * length;
            if !(length.is_finite() && force.norm().is_finite()) {
                return Err(failed);
            }
            let bounded = (now.unstrained_length + length)
                .clamp(0.5 * now.unstrained_length, 2.0 * now.unstrained_length);
            now = SpatialCable { force: now.force + force, unstrained_length: bounded, ..now };
            // The azimuth of a long step is that of the tangent: the horizontal part is known.
            let (reached, _) = horizontal(&now.force.into());
            if reached > 0.0 {
                now.force.x *= fx / reached;
                now.force.y *= fx / reached;
            }
            let forces = now.force.norm() + now.cable.weight_per_length * now.unstrained_length;
            let small = |limit: f64| force.norm() <= limit * forces && length.abs() <= limit * end.norm();
            if small(1e-8) || (small(1e-6) && residual.norm() >= 0.5 * before) {
                let (force, azimuth) = flat(now.force);
                let catenary = Catenary { cable: *cable, unstrained_length: now.unstrained_length, force };
                return Ok(Self::at_in_space(catenary, azimuth, end, chord_force));
            }
            before = residual.norm();
        }
        Err(CableError::NotConverged { iterations: MAX_ITERATIONS, residual: before })
    }
}

/// F_L between held ends.
fn force_per_length<T: Real>(cable: &Cable, numbers: &Numbers<T>, force: &[T; 3]) -> [T; 3] {
    let found = response(cable, numbers, force);
    solve(&found.flexibility, &found.end_per_length).map(|slope| -slope)
}
