//! What the adjoint of an observation takes from each cable: how its force and its length answer to its ends
//! and its material.
//!
//! At constant force and length the end of a cable moves by `e_w dw + e_f dφ` with its weight per length w
//! and its axial flexibility `φ = 1/EA`. With `y = d(h, z) - e_w dw - e_f dφ`, C the flexibility, K its
//! inverse and e the end per length, the force at A changes by
//!
//! ```text
//! df = K (y - e dL)   in the plane,      k_l dl   across it                                           (L8)
//! ```
//!
//! where the length is given. Where the tension is, the force can only turn: with u its direction, n̂ across
//! it in the plane, `N = C n̂` and `Δ = e x N`,
//!
//! ```text
//! df = n̂ (e x y)/Δ + f_t dt,      dL = (y x N - det C dt)/Δ,      f_t = u - n̂ (e x C u)/Δ        (L9)
//! ```
//!
//! Second derivatives of the force by its tension are those of (L9) along `(f_t, L_t)`, found by tangents.

use crate::equations::vector::{cross, dot};
use crate::equations::{CablePlane, LinearizedCable, Span};
use crate::lanes::algebra::{Lanes2, Lanes3, three};
use crate::lanes::cable::LaneCable;
use crate::lanes::shared::Choice;
use crate::lanes::simd::{Lanes, Simd, WithSimd};
use cdpr_cable::kernel::{
    Field, LaneSegment, Lanewise, Response, Tangent, lane_end, lane_law_end, lane_law_response, lane_response,
};
use cdpr_robot::CableEnd;

/// Derivatives of an output by what one cable is, at one equilibrium.
#[derive(Clone, Copy)]
pub(super) struct CableSlopes<S: Simd> {
    /// By the vector from its exit to its anchor point [1/m].
    pub(super) span: Lanes3<S>,
    /// By its weight per length [m/N].
    pub(super) weight: Lanes<S>,
    /// By its axial flexibility [N].
    pub(super) flexibility: Lanes<S>,
}

impl<S: Simd> CableSlopes<S> {
    /// Adds those of an output that grows by `by_bound` for each newton of the greatest tension at the
    /// platform. It changes where that at the exit point is given: (C26) of `cdpr_cable`, for a linear cable.
    #[inline(always)]
    pub(super) fn add_bound(
        &mut self,
        cable: &LaneCable<'_, S>,
        height: &Lanes<S>,
        choice: &Choice,
        by_bound: Lanes<S>,
    ) {
        if choice.max_at == CableEnd::Anchor {
            return;
        }
        let flexibility = cable.axial_flexibility;
        let greatest = by_bound.all(choice.limits.max);
        let work = greatest * (greatest * flexibility * 0.5 + 1.0) + cable.weight_per_length * *height;
        let tension = work * 2.0 * ((work * flexibility * 2.0 + 1.0).sqrt() + 1.0).recip();
        let by_work = by_bound / (tension * flexibility + 1.0);
        self.span[2] += by_work * cable.weight_per_length;
        self.weight += by_work * *height;
        self.flexibility += by_work * (greatest - tension) * (greatest + tension) * 0.5;
    }
}

/// A cable that is given its force and its length.
pub(super) struct Answer<T> {
    pub(super) response: Response<T>,
    /// e_w.
    per_weight: [T; 2],
    /// e_f.
    per_flexibility: [T; 2],
}

/// A cable to be evaluated: law, weight per length, axial flexibility and length, force at A.
struct Question<'a, T> {
    law: &'a [LaneSegment],
    numbers: [T; 3],
    force: [T; 2],
}

impl<T: Lanewise> WithSimd for Question<'_, T> {
    type Output = Answer<T>;

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) -> Self::Output {
        let Self { law, numbers: [w, flexibility, length], force } = self;
        let response = match law {
            [] => lane_response(w, flexibility, length, force),
            law => lane_law_response(law, w, flexibility, length, force),
        };
        let (constant, force) = (
            [Tangent::constant(w), Tangent::constant(flexibility)],
            [Tangent::constant(force[0]), Tangent::constant(force[1])],
        );
        let length = Tangent::constant(length);
        let [heavier, softer] = match law {
            [] => [
                lane_end(Tangent::input(w), constant[1], length, force).end,
                lane_end(constant[0], Tangent::input(flexibility), length, force).end,
            ],
            law => [
                lane_law_end(law, Tangent::input(w), constant[1], length, force).end,
                lane_law_end(law, constant[0], Tangent::input(flexibility), length, force).end,
            ],
        };
        Answer {
            response,
            per_weight: [heavier[0].slope, heavier[1].slope],
            per_flexibility: [softer[0].slope, softer[1].slope],
        }
    }
}

impl<S: Simd> Answer<Lanes<S>> {
    /// The answer of a cable to the force and the length that it has.
    #[inline(always)]
    pub(super) fn of(cable: &LaneCable<'_, S>) -> Self {
        let numbers = [cable.weight_per_length, cable.axial_flexibility, cable.length];
        cable.length.apart(Question { law: cable.law, numbers, force: cable.force })
    }

    /// Slopes of an output that falls by `twisted`·df with the force (L8) on a cable of given length, and
    /// its derivative by the length.
    #[inline(always)]
    pub(super) fn at_length(
        &self,
        linearized: &LinearizedCable<Lanes<S>>,
        twisted: &Lanes3<S>,
    ) -> (CableSlopes<S>, Lanes<S>) {
        let [xx, xz, zz] = linearized.stiffness;
        let (plane, [h, z]) = (linearized.plane, linearized.plane.project(*twisted));
        let pulled = [xx * h + xz * z, xz * h + zz * z];
        let across = sideways(&plane, twisted) * linearized.lateral_stiffness;
        let slopes = self.slopes(&plane, [-pulled[0], -pulled[1]], -across);
        (slopes, dot(&pulled, &self.response.end_per_length))
    }

    /// Slopes of an output that grows by `share`·dL with the length (L9) of a cable of given tension, and
    /// its derivative by the tension.
    #[inline(always)]
    pub(super) fn of_length(
        &self,
        plane: &CablePlane<Lanes<S>>,
        share: Lanes<S>,
    ) -> (CableSlopes<S>, Lanes<S>) {
        let held = Held::of(&self.response);
        let along = [held.length_per_end[0] * share, held.length_per_end[1] * share];
        (self.slopes(plane, along, share.all(0.0)), held.length_per_tension * share)
    }

    /// Slopes of an output that grows by `along`·y and by `across` for each motion across the plane.
    #[inline(always)]
    fn slopes(&self, plane: &CablePlane<Lanes<S>>, along: Lanes2<S>, across: Lanes<S>) -> CableSlopes<S> {
        CableSlopes {
            span: in_space(plane, along, across),
            weight: -dot(&along, &self.per_weight),
            flexibility: -dot(&along, &self.per_flexibility),
        }
    }
}

/// The component of a vector across a plane, along e_l.
#[inline(always)]
fn sideways<S: Simd>(plane: &CablePlane<Lanes<S>>, [x, y, _]: &Lanes3<S>) -> Lanes<S> {
    plane.azimuth[0] * *y - plane.azimuth[1] * *x
}

/// A vector from its components in a plane and across it.
#[inline(always)]
fn in_space<S: Simd>(plane: &CablePlane<Lanes<S>>, along: Lanes2<S>, across: Lanes<S>) -> Lanes3<S> {
    let [x, y, z] = plane.lift(along);
    [x - plane.azimuth[1] * across, y + plane.azimuth[0] * across, z]
}

/// A cable between held ends whose tension is given, equation (L9).
struct Held<T> {
    /// n̂.
    normal: [T; 2],
    /// (-e_z, e_x)/Δ, by which the end turns the force.
    turn_per_end: [T; 2],
    /// (N_z, -N_x)/Δ.
    length_per_end: [T; 2],
    /// f_t.
    force_per_tension: [T; 2],
    /// -det C/Δ.
    length_per_tension: T,
}

impl<T: Lanewise> Held<T> {
    #[inline(always)]
    fn of(response: &Response<T>) -> Self {
        let ([xx, xz, zz], [ux, uz]) = (response.flexibility, response.direction);
        let [ex, ez] = response.end_per_length;
        let across = [xz * ux - xx * uz, zz * ux - xz * uz];
        let inverse = (ex * across[1] - ez * across[0]).recip();
        let stretched = [xx * ux + xz * uz, xz * ux + zz * uz];
        let turned = (ez * stretched[0] - ex * stretched[1]) * inverse;
        Self {
            normal: [-uz, ux],
            turn_per_end: [-(ez * inverse), ex * inverse],
            length_per_end: [across[1] * inverse, -(across[0] * inverse)],
            force_per_tension: [ux - uz * turned, uz + ux * turned],
            length_per_tension: -(response.determinant * inverse),
        }
    }
}

/// A cable between held ends with the derivatives of (L9) by its tension.
pub(super) struct TensionSlopes<S: Simd> {
    plane: CablePlane<Lanes<S>>,
    answer: Answer<Tangent<Lanes<S>>>,
    held: Held<Tangent<Lanes<S>>>,
    /// f_t, in space.
    pub(super) force_per_tension: Lanes3<S>,
    /// df_t/dt, in space [1/N].
    pub(super) curvature: Lanes3<S>,
}

impl<S: Simd> TensionSlopes<S> {
    #[inline(always)]
    pub(super) fn of(cable: &LaneCable<'_, S>, span: &Span<Lanes<S>>) -> Self {
        let first = Held::of(&cable.response());
        let along = |value, slope| Tangent { value, slope };
        let [x, z] = first.force_per_tension;
        let numbers = [
            Tangent::constant(cable.weight_per_length),
            Tangent::constant(cable.axial_flexibility),
            along(cable.length, first.length_per_tension),
        ];
        let force = [along(cable.force[0], x), along(cable.force[1], z)];
        let answer = cable.length.apart(Question { law: cable.law, numbers, force });
        let held = Held::of(&answer.response);
        let [x, z] = held.force_per_tension;
        Self {
            plane: span.plane,
            force_per_tension: span.plane.lift([x.value, z.value]),
            curvature: span.plane.lift([x.slope, z.slope]),
            answer,
            held,
        }
    }

    /// Slopes of an output that grows by `force`·df and by `twisted`·df_t `share` times, df as in (L9) at
    /// constant tension.
    #[inline(always)]
    pub(super) fn slopes(&self, force: &Lanes3<S>, twisted: &Lanes3<S>, share: Lanes<S>) -> CableSlopes<S> {
        let Self { plane, answer, held, .. } = self;
        // Values of the one and slopes of the other.
        let (once, twice) = (plane.project(*force), plane.project(*twisted));
        let normal = &held.normal;
        let once = normal[0] * Tangent::constant(once[0]) + normal[1] * Tangent::constant(once[1]);
        let twice =
            normal[0] * Tangent::constant(twice[0] * share) + normal[1] * Tangent::constant(twice[1] * share);
        let of = |by: [Tangent<Lanes<S>>; 2]| {
            let turn = held.turn_per_end[0] * by[0] + held.turn_per_end[1] * by[1];
            (once * turn).value + (twice * turn).slope
        };
        let (one, zero) = (Tangent::constant(share.all(1.0)), Tangent::constant(share.all(0.0)));
        let lateral = answer.response.lateral_flexibility.recip();
        let across =
            sideways(plane, force) * lateral.value + sideways(plane, twisted) * share * lateral.slope;
        CableSlopes {
            span: in_space(plane, [of([one, zero]), of([zero, one])], across),
            weight: -of(answer.per_weight),
            flexibility: -of(answer.per_flexibility),
        }
    }
}

/// Turns of gravity turn the force of a cable, and its span the other way: the derivative of an output by
/// turns of both, from that by the force and that by the span r.
#[inline(always)]
pub(super) fn torque<S: Simd>(
    force: &Lanes3<S>,
    by_force: &Lanes3<S>,
    r: &Lanes3<S>,
    by_span: &Lanes3<S>,
) -> Lanes3<S> {
    let (turned, opposite) = (cross(force, by_force), cross(r, by_span));
    three!(|k| turned[k] - opposite[k])
}
