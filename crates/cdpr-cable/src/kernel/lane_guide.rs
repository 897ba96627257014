//! Cables over pulleys with vertical axes and behind leads in lanes, (C19) to (C23) of `catenary/guided.rs`.
//!
//! The unknowns are the force at A and the unstrained length Lf beyond the leave point B, from which all else
//! follows without iteration. With τ the direction at B, α its elevation, and ρ the radius r with the sign
//! of k_z, positive for a cable that enters from below,
//!
//! ```text
//! B = (r - ρ τ_z, ρ τ_x),      a = r π/2 - ρ α,      L = Lf + (a + d)/(1 + ε(T0))              (C30)
//! dB = -ρ τ dα,   da = -ρ dα,   q = ρ n/((1 + ε) T0) + (a + d) ε' τ/(1 + ε)²,   n = (-τ_z, τ_x)
//! ```
//!
//! (C22) gives the flexibility in the plane; across it A swings about the axis, x/fx with the distance x from
//! D. Only the angle α needs more than a root or a quotient, and only where L is asked for.

use super::field::Lanewise;
use super::response::Response;
use super::series::elevation;
use std::f64::consts::FRAC_PI_2;

/// A pulley with a vertical axis, and a lead before it.
#[derive(Clone, Copy, Debug)]
pub struct LaneGuide<T> {
    /// Stretched length between winch and D [m].
    pub lead: T,
    /// Radius r of the pulley [m]; zero without one.
    pub radius: T,
    /// ρ [m]: the radius, negative for a cable that enters from above.
    pub signed_radius: T,
}

/// Where a cable leaves its pulley.
#[derive(Clone, Copy, Debug)]
pub struct LeavePoint<T> {
    /// Position B from D [m].
    pub position: [T; 2],
    /// Direction τ of the cable.
    pub tangent: [T; 2],
    /// T0 [N].
    pub tension: T,
    /// 1/T0 [1/N].
    pub tension_inv: T,
}

/// The way of a cable over its guide.
#[derive(Clone, Copy, Debug)]
pub struct LaneWay<T> {
    /// Where it leaves.
    pub leave: LeavePoint<T>,
    /// Unstrained length L, lead and arc included [m].
    pub length: T,
    /// dLf/dF at constant L, q/β of (C21) [m/N].
    pub free_per_force: [T; 2],
    /// dLf/dL at constant F, 1/β.
    pub free_per_length: T,
    /// dA/dL at constant F, (C23).
    pub end_per_length: [T; 2],
    /// κ [m/N] and τ - γ q of (C22).
    kappa: T,
    coupled: [T; 2],
}

impl<T: Lanewise> LaneGuide<T> {
    /// B for the direction τ, (C30).
    #[inline(always)]
    pub fn leave_position(&self, [tx, tz]: [T; 2]) -> [T; 2] {
        [self.radius - self.signed_radius * tz, self.signed_radius * tx]
    }

    /// Where a cable of weight `w` [N/m] and unstrained length `free` [m] beyond its leave point leaves it,
    /// with the force `[fx, fz]` [N] at A.
    #[inline(always)]
    pub fn leave_point(&self, w: T, free: T, [fx, fz]: [T; 2]) -> LeavePoint<T> {
        let v0 = fz - w * free;
        let tension = (fx * fx + v0 * v0).sqrt();
        let tension_inv = tension.recip();
        let tangent = [fx * tension_inv, v0 * tension_inv];
        LeavePoint { position: self.leave_position(tangent), tangent, tension, tension_inv }
    }

    /// The way of the cable of [`LaneGuide::leave_point`]; `stretch` has 1 + ε(T0) and ε'(T0) [1/N].
    #[inline(always)]
    pub fn way(&self, w: T, free: T, leave: LeavePoint<T>, [stretch, flexibility]: [T; 2]) -> LaneWay<T> {
        let LeavePoint { tangent: [tx, tz], tension_inv, .. } = leave;
        let guided = self.lead + self.radius * FRAC_PI_2 - self.signed_radius * elevation([tx, tz]);
        let stretch_inv = stretch.recip();
        let across = self.signed_radius * stretch_inv * tension_inv;
        let kappa = guided * flexibility * stretch_inv;
        let along = kappa * stretch_inv;
        let [qx, qz] = [along * tx - across * tz, along * tz + across * tx];
        let free_per_length = (w * qz + 1.0).recip();
        let gamma = w * tz * free_per_length;
        let paid_out = stretch - kappa * gamma;
        LaneWay {
            leave,
            length: free + guided * stretch_inv,
            free_per_force: [qx * free_per_length, qz * free_per_length],
            free_per_length,
            end_per_length: [tx * paid_out, tz * paid_out],
            kappa,
            coupled: [tx - gamma * qx, tz - gamma * qz],
        }
    }
}

impl<T: Lanewise> LaneWay<T> {
    /// The response of the whole cable from that of its free part to `fx` [N] forwards, (C22), (C23).
    #[inline(always)]
    pub fn response(&self, fx: T, free: &Response<T>) -> Response<T> {
        let Self { leave: LeavePoint { position, tangent: [tx, tz], .. }, kappa, coupled: [px, pz], .. } =
            *self;
        let [xx, xz, zz] = free.flexibility;
        let twist = kappa * (tx * pz - tz * px) * 0.5;
        let mixed = (tx * pz + tz * px) * 0.5;
        let more = xx * tz * pz + zz * tx * px - xz * mixed * 2.0;
        Response {
            end: [position[0] + free.end[0], position[1] + free.end[1]],
            flexibility: [xx + kappa * tx * px, xz + kappa * mixed, zz + kappa * tz * pz],
            determinant: free.determinant + kappa * more - twist * twist,
            lateral_flexibility: free.lateral_flexibility + position[0] / fx,
            end_per_length: self.end_per_length,
            ..*free
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cable::Cable;
    use crate::catenary::Catenary;
    use crate::guide::{Entry, Guide};
    use crate::kernel::{LaneSegment, lane_law_response, lane_law_stretch, lane_response};
    use crate::law::{ElasticLaw, PiecewiseLaw, Segment};
    use approx::assert_relative_eq;
    use nalgebra::Vector2;
    use proptest::prelude::*;

    fn law() -> PiecewiseLaw {
        let segments = [(0.0, 0.7), (400.0, 1.3)].map(|(tension, ratio)| Segment { tension, ratio });
        PiecewiseLaw::new(0.0, &segments).unwrap()
    }

    /// A cable on a guide and the force at A.
    fn led() -> impl Strategy<Value = (Cable<'static>, f64, Vector2<f64>)> {
        let guide =
            (prop_oneof![Just(0.0), 0.1..5.0f64], prop_oneof![Just(0.0), 0.01..0.5f64], any::<bool>());
        (guide, 0.0..5.0f64, 1e4..1e7f64, 2.0..30.0f64, 1.0..2e3f64, -2.0..3.0f64).prop_map(
            |((lead, radius, up), w, ea, length, fx, slope)| {
                let entry = if up { Entry::Upwards } else { Entry::Downwards };
                let guide = Some(Guide { lead, radius, entry });
                (Cable { guide, ..Cable::linear(w, ea) }, length, Vector2::new(fx, slope * fx))
            },
        )
    }

    fn compare(catenary: &Catenary, segments: &[LaneSegment]) {
        let Catenary { cable, unstrained_length, force } = *catenary;
        let (w, flexibility, guide) =
            (cable.weight_per_length, 1.0 / cable.axial_stiffness, cable.guide.unwrap());
        let (free, force) = (catenary.free_length(), force.into());
        let in_lanes = LaneGuide {
            lead: guide.lead,
            radius: guide.radius,
            signed_radius: guide.radius * guide.entry.axis()[2],
        };
        let leave = in_lanes.leave_point(w, free, force);
        let (free_response, stretch) = match segments {
            [] => {
                (lane_response(w, flexibility, free, force), [leave.tension * flexibility + 1.0, flexibility])
            }
            law => (
                lane_law_response(law, w, flexibility, free, force),
                lane_law_stretch(law, flexibility, leave.tension),
            ),
        };
        let way = in_lanes.way(w, free, leave, stretch);
        let (found, expected) = (way.response(force[0], &free_response), catenary.response());
        let point = catenary.leave_point();
        let close = |a: f64, b: f64, scale: f64| assert_relative_eq!(a, b, epsilon = 1e-11 * scale);
        close(way.length, unstrained_length, unstrained_length);
        close(way.leave.position[0], point.x, guide.radius + f64::MIN_POSITIVE);
        close(way.leave.position[1], point.y, guide.radius + f64::MIN_POSITIVE);
        let size = expected.flexibility[0] + expected.flexibility[2];
        for k in 0..3 {
            close(found.flexibility[k], expected.flexibility[k], size);
        }
        for k in 0..2 {
            close(found.end[k], expected.end[k], unstrained_length + guide.radius);
            close(found.end_per_length[k], expected.end_per_length[k], 1.0);
        }
        close(found.determinant, expected.determinant, expected.determinant);
        close(found.lateral_flexibility, expected.lateral_flexibility, expected.lateral_flexibility);
        // dLf by the force and by the length, against differences.
        let at = |length: f64, force: [f64; 2]| {
            Catenary { unstrained_length: length, force: force.into(), ..*catenary }.free_length()
        };
        let step = 1e-4 * force[0];
        let slopes = [
            (at(unstrained_length, [force[0] + step, force[1]])
                - at(unstrained_length, [force[0] - step, force[1]]))
                / (2.0 * step),
            (at(unstrained_length, [force[0], force[1] + step])
                - at(unstrained_length, [force[0], force[1] - step]))
                / (2.0 * step),
            (at(unstrained_length + 1e-4, force) - at(unstrained_length - 1e-4, force)) / 2e-4,
        ];
        let kinked = !segments.is_empty() && (leave.tension - 400.0).abs() < 2.0 * step + 10.0;
        if !kinked {
            let error = 1e-10 * unstrained_length / step;
            let scale = (guide.radius + guide.lead * leave.tension * flexibility) / leave.tension;
            for (k, slope) in way.free_per_force.into_iter().enumerate() {
                assert_relative_eq!(slope, slopes[k], epsilon = 1e-5 * scale + error);
            }
            assert_relative_eq!(way.free_per_length, slopes[2], epsilon = 1e-6);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn a_cable_over_a_pulley_answers_in_lanes_as_alone((cable, length, force) in led()) {
            let guide = cable.guide.unwrap();
            let length = length + guide.lead + 4.0 * guide.radius;
            compare(&Catenary { cable, unstrained_length: length, force }, &[]);
            let law = law();
            let cable = Cable { law: ElasticLaw::Piecewise(&law), ..cable };
            let catenary = Catenary { cable, unstrained_length: length, force };
            // Lanes do not take cables that cross more than one kink.
            let free = catenary.free();
            if free.force.y * free.exit_vertical_force() > 0.0 {
                compare(&catenary, &law.lane_segments());
            }
        }
    }
}
