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
//!
//! (C24) gives the derivatives of A at constant force and length. If the axis k turns by dκ within the
//! plane, towards the cable, u turns by -k dκ and ψ by dκ; m stays normal to τ. If k turns across the plane,
//! u and m turn with it by cos ψ/sin ψ and 1/sin ψ of its angle:
//!
//! ```text
//! dA/dκ = -ρ e_z + r/(1 + ε) dA/dL  in the plane,      r (1 + cos ψ)/sin ψ = B_x/τ_x  across it  (C31)
//! ```

use super::response::Response;
use super::series::elevation;
use cdpr_number::Lanewise;
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
    /// α [rad].
    elevation: T,
    /// a + d [m].
    guided: T,
    /// 1 + ε(T0), and its inverse.
    stretch: T,
    stretch_inv: T,
}

/// Derivatives of the end of a cable over a guide at constant force and length, (C24) and (C31).
#[derive(Clone, Copy, Debug)]
pub struct LaneEndSlopes<T> {
    /// Per weight per length [m²/N].
    pub per_weight: [T; 2],
    /// Per axial flexibility 1/EA [N m].
    pub per_flexibility: [T; 2],
    /// Per lead [m/m].
    pub per_lead: [T; 2],
    /// Per radius of the pulley [m/m].
    pub per_radius: [T; 2],
    /// Per turn of the axis k towards the cable, in its plane [m/rad].
    pub per_axis: [T; 2],
    /// Across the plane, per turn of k across it [m/rad].
    pub across_per_axis: T,
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
        let elevation = elevation([tx, tz]);
        let guided = self.lead + self.radius * FRAC_PI_2 - self.signed_radius * elevation;
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
            elevation,
            guided,
            stretch,
            stretch_inv,
        }
    }

    /// k_z: 1 for a cable that enters from below, -1 from above, 0 without a pulley.
    #[inline(always)]
    pub fn upwards(&self) -> T {
        T::select(self.radius.at_most(0.0), self.radius * 0.0, self.signed_radius / self.radius)
    }

    /// How the end moves with what the cable of `way` and this guide are. The part beyond the leave point has
    /// the unstrained length `free` [m], and an end that moves by `heavier` per weight per length and by
    /// `softer` per axial flexibility.
    #[inline(always)]
    pub fn end_slopes(
        &self,
        way: &LaneWay<T>,
        [axial_flexibility, free]: [T; 2],
        [heavier, softer]: [[T; 2]; 2],
    ) -> LaneEndSlopes<T> {
        let LaneWay { leave: LeavePoint { position, tangent: [tx, tz], .. }, stretch_inv, .. } = *way;
        let [ex, ez] = way.end_per_length;
        let hung = way.kappa * tz * free * way.free_per_length;
        let strained = (way.stretch + -1.0) / axial_flexibility;
        let softened = way.guided * strained * stretch_inv * stretch_inv;
        let upwards = self.upwards();
        let wound = (-(upwards * way.elevation) + FRAC_PI_2) * stretch_inv;
        let unwound = self.radius * stretch_inv;
        LaneEndSlopes {
            per_weight: [heavier[0] - hung * tx, heavier[1] - hung * tz],
            per_flexibility: [softer[0] + softened * ex, softer[1] + softened * ez],
            per_lead: [-(ex * stretch_inv), -(ez * stretch_inv)],
            per_radius: [-(upwards * tz) + 1.0 - wound * ex, upwards * tx - wound * ez],
            per_axis: [unwound * ex, unwound * ez - self.signed_radius],
            across_per_axis: position[0] / tx,
        }
    }
}

impl<T: Lanewise> LaneWay<T> {
    /// Half the difference `dx/dfz - dz/dfx` of the flexibility (C22) [m/N].
    #[inline(always)]
    pub fn asymmetry(&self) -> T {
        let Self { leave: LeavePoint { tangent: [tx, tz], .. }, kappa, coupled: [px, pz], .. } = *self;
        kappa * (tx * pz - tz * px) * 0.5
    }

    /// The response of the whole cable from that of its free part to `fx` [N] forwards, (C22), (C23).
    #[inline(always)]
    pub fn response(&self, fx: T, free: &Response<T>) -> Response<T> {
        let Self { leave: LeavePoint { position, tangent: [tx, tz], .. }, kappa, coupled: [px, pz], .. } =
            *self;
        let [xx, xz, zz] = free.flexibility;
        let twist = self.asymmetry();
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
    use crate::catenary::spatial::SpatialCable;
    use crate::guide::{Entry, Guide};
    use crate::kernel::{
        LaneSegment, lane_end, lane_law_end, lane_law_response, lane_law_stretch, lane_response,
    };
    use crate::law::{ElasticLaw, PiecewiseLaw, Segment};
    use approx::assert_relative_eq;
    use cdpr_number::Dual;
    use nalgebra::{Vector2, Vector3};
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
        close(way.asymmetry(), catenary.asymmetry(), way.kappa);
        compare_slopes(catenary, &in_lanes, &way, segments);
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

    fn compare_slopes(
        catenary: &Catenary,
        guide: &LaneGuide<f64>,
        way: &LaneWay<f64>,
        segments: &[LaneSegment],
    ) {
        let Catenary { cable, force, .. } = *catenary;
        let (w, flexibility, free) =
            (cable.weight_per_length, 1.0 / cable.axial_stiffness, catenary.free_length());
        let force = <[f64; 2]>::from(force).map(Dual::<_, 1>::constant);
        let end = |w, flexibility| {
            let free = Dual::constant(free);
            let end = match segments {
                [] => lane_end(w, flexibility, free, force),
                law => lane_law_end(law, w, flexibility, free, force),
            };
            end.end.map(|component| component.slopes[0])
        };
        let heavier = end(Dual::input(w, 0), Dual::constant(flexibility));
        let softer = end(Dual::constant(w), Dual::input(flexibility, 0));
        let found = guide.end_slopes(way, [flexibility, free], [heavier, softer]);
        let close = |found: [f64; 2], expected: Vector2<f64>, scale: f64| {
            assert_relative_eq!(Vector2::from(found), expected, epsilon = 1e-10 * scale);
        };
        let weight = catenary.end_per_weight();
        close(found.per_weight, weight, weight.norm());
        let softer = catenary.end_per_stiffness() * -cable.axial_stiffness.powi(2);
        close(found.per_flexibility, softer, softer.norm());
        let [lead, radius] = catenary.end_per_guide().unwrap();
        close(found.per_lead, lead, 1.0);
        if guide.radius > 0.0 {
            close(found.per_radius, radius, 3.0);
            let force = Vector3::new(catenary.force.x, 0.0, catenary.force.y);
            let unstrained_length = catenary.unstrained_length;
            let axis = SpatialCable { cable, unstrained_length, force }.slopes().per_axis;
            close(found.per_axis, Vector2::new(axis[(0, 0)], axis[(2, 0)]), guide.radius);
            assert_relative_eq!(axis[(1, 0)], 0.0, epsilon = 1e-10);
            close([found.across_per_axis, 0.0], Vector2::new(axis[(1, 1)], axis[(2, 1)]), axis.norm());
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
