//! What the adjoint of an observation takes from each cable: derivatives of an output by its ends, its
//! material and its guide.
//!
//! They follow from how its force and its length respond, (L8) and (L9). Second derivatives of the force by
//! its tension are those of (L9) along `(f_t, L_t)`, found by tangents.

use crate::equations::{CablePlane, LinearizedCable, Span};
use crate::lanes::adjoint::response::{AtTension, CableResponse};
use crate::lanes::chain::limits::at_platform;
use crate::lanes::chain::shared::Choice;
use crate::local::cable::LaneCable;
use cdpr_number::dense::Lanes3;
use cdpr_number::lanes::{Lanes, Simd};
use cdpr_number::three;
use cdpr_number::vector::{cross, dot};
use cdpr_number::{Dual, Lanewise};
use cdpr_robot::CableEnd;

/// Derivatives of an output by what one cable is, at one equilibrium.
pub(super) struct CableSlopes<S: Simd> {
    /// By the vector from its exit to its anchor point [1/m].
    pub(super) span: Lanes3<S>,
    /// By its weight per length [m/N].
    pub(super) weight: Lanes<S>,
    /// By its axial flexibility [N].
    pub(super) flexibility: Lanes<S>,
    /// By its guide.
    pub(super) guide: Option<GuideSlopes<S>>,
}

/// Derivatives of an output by the guide of one cable.
#[derive(Clone, Copy)]
pub(crate) struct GuideSlopes<S: Simd> {
    /// By the lead [1/m].
    pub(crate) lead: Lanes<S>,
    /// By the radius of the pulley [1/m].
    pub(crate) radius: Lanes<S>,
    /// By the direction k of its axis [1].
    pub(crate) axis: Lanes3<S>,
}

impl<S: Simd> GuideSlopes<S> {
    #[inline(always)]
    pub(super) fn none(zero: Lanes<S>) -> Self {
        Self { lead: zero, radius: zero, axis: [zero; 3] }
    }

    #[inline(always)]
    pub(super) fn add(&mut self, more: &Self) {
        self.lead += more.lead;
        self.radius += more.radius;
        for k in 0..3 {
            self.axis[k] += more.axis[k];
        }
    }
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
        let greatest = by_bound.all(choice.limits.max);
        let tension = at_platform(cable, greatest, *height);
        let material = cable.material();
        let by_work = by_bound / (material.strain(tension) + 1.0);
        self.span[2] += by_work * cable.weight_per_length;
        self.weight += by_work * *height;
        let energy = material.energy(greatest) - material.energy(tension);
        self.flexibility += by_work * energy / cable.axial_flexibility;
    }
}

impl<S: Simd> CableResponse<Lanes<S>> {
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
        let mut pulled = [xx * h + xz * z, xz * h + zz * z];
        if let Some(skew) = self.skew_stiffness() {
            pulled[0] += skew * z;
            pulled[1] -= skew * h;
        }
        let across = plane.across(*twisted) * linearized.lateral_stiffness;
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
        let at_tension = AtTension::of(self);
        let along = [at_tension.length_per_end[0] * share, at_tension.length_per_end[1] * share];
        (self.slopes(plane, along, share.all(0.0)), at_tension.length_per_tension * share)
    }
}

/// What is taken of a number: a number itself, or the slope of a dual one.
trait Taken<S: Simd>: Lanewise {
    fn taken(self) -> Lanes<S>;
}

impl<S: Simd> Taken<S> for Lanes<S> {
    #[inline(always)]
    fn taken(self) -> Self {
        self
    }
}

impl<S: Simd> Taken<S> for Dual<Lanes<S>, 1> {
    #[inline(always)]
    fn taken(self) -> Lanes<S> {
        self.slopes[0]
    }
}

impl<T: Lanewise> CableResponse<T> {
    /// Slopes of an output that grows by `along`·y in the plane and by `across` for each motion across it.
    #[inline(always)]
    fn slopes<S: Simd>(&self, plane: &CablePlane<Lanes<S>>, along: [T; 2], across: T) -> CableSlopes<S>
    where
        T: Taken<S>,
    {
        let guide = match &self.guide {
            None => None,
            Some(guide) => {
                let end = &guide.end;
                let forwards = -dot(&along, &end.per_axis);
                let sideways = -(across * end.across_per_axis);
                Some(GuideSlopes {
                    lead: -dot(&along, &end.per_lead).taken(),
                    radius: -dot(&along, &end.per_radius).taken(),
                    axis: plane.in_space([forwards.taken(), plane.azimuth[0].all(0.0)], sideways.taken()),
                })
            }
        };
        CableSlopes {
            span: plane.in_space([along[0].taken(), along[1].taken()], across.taken()),
            weight: -dot(&along, &self.per_weight).taken(),
            flexibility: -dot(&along, &self.per_flexibility).taken(),
            guide,
        }
    }
}

/// A cable between fixed ends with the derivatives of (L9) by its tension.
pub(super) struct TensionSlopes<S: Simd> {
    plane: CablePlane<Lanes<S>>,
    found: CableResponse<Dual<Lanes<S>, 1>>,
    at_tension: AtTension<Dual<Lanes<S>, 1>>,
    /// f_t, in space.
    pub(super) force_per_tension: Lanes3<S>,
    /// df_t/dt, in space [1/N].
    pub(super) curvature: Lanes3<S>,
}

impl<S: Simd> TensionSlopes<S> {
    #[inline(always)]
    pub(super) fn of(cable: &LaneCable<'_, S>, span: &Span<Lanes<S>>) -> Self {
        let found = CableResponse::along_tension(cable);
        let at_tension = AtTension::of(&found);
        let [x, z] = at_tension.force_per_tension;
        Self {
            plane: span.plane,
            force_per_tension: span.plane.lift([x.value, z.value]),
            curvature: span.plane.lift([x.slopes[0], z.slopes[0]]),
            found,
            at_tension,
        }
    }

    /// Slopes of an output that grows by `force`·df and by `twisted`·df_t `share` times, df as in (L9) at
    /// constant tension.
    #[inline(always)]
    pub(super) fn slopes(&self, force: &Lanes3<S>, twisted: &Lanes3<S>, share: Lanes<S>) -> CableSlopes<S> {
        let Self { plane, found, at_tension: AtTension { normal, turn_per_end, .. }, .. } = self;
        // Values of what `force` takes and slopes of what `twisted` takes are slopes of these products.
        let (once, twice) = (plane.project(*force), plane.project(*twisted));
        let along = Dual { value: twice[0] * share, slopes: [once[0]] };
        let upwards = Dual { value: twice[1] * share, slopes: [once[1]] };
        let turned = normal[0] * along + normal[1] * upwards;
        let aside = Dual { value: plane.across(*twisted) * share, slopes: [plane.across(*force)] };
        let along = [turned * turn_per_end[0], turned * turn_per_end[1]];
        found.slopes(plane, along, aside / found.response.lateral_flexibility)
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
