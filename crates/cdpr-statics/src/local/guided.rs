//! Cables over guides, one in each lane: a lead, and a pulley whose axis is vertical or tilted.
//!
//! The length of such a cable is that beyond its leave point, which closes with the force in the same
//! iteration: at the force F and the whole length L that it was given,
//!
//! ```text
//! dLf = (L - L(F, Lf))/β + q·dF/β,      A(F, L) = A(F, Lf) + dA/dL (L - L(F, Lf))                   (L12)
//! ```
//!
//! with (C21) to (C23) of `cdpr_cable`; what is left out is of second order.
//!
//! Over a tilted axis the cable hangs in a vertical plane that does not contain its entry point. The azimuth
//! e_h of that plane is an unknown of the cable, as its force is: with the components of r_i along e_h,
//! across it to the left and upwards,
//!
//! ```text
//! (h, l, z) - A(F, L) = 0,      dF = (dfx, fx dθ, dfz)                                              (L19)
//! ```
//!
//! with the leave point and the flexibility of (C19) and (C22) in these axes; a turn by dθ is the force
//! `fx dθ` across the plane.

use crate::equations::{CablePlane, LinearizedCable, Span};
use crate::local::free::FreeCable;
use crate::local::swivel::{Swivel, in_space};
use cdpr_cable::kernel::{GuideTerms, LaneEnd, LeavePoint, Response, SwivelAxis, Way};
use cdpr_number::Number;
use cdpr_number::apart;
use cdpr_number::dense::{Lanes2, replace};
use cdpr_number::lanes::{Lanes, Mask, Simd};

/// Horizontal distance of a cable's end from its leave point, in radii of its wheel, within which a slack
/// cable may hang from either side of the wheel.
const NEXT_TO_WHEEL: f64 = 4.0;

/// A guide, and the cable that was given to it.
#[derive(Clone)]
pub(crate) struct Guided<S: Simd> {
    /// The guide; a tilted axis has the components along x, y and z of the level frame.
    pub(crate) guide: GuideTerms<Lanes<S>>,
    /// Unstrained length L, lead and arc included [m].
    pub(crate) whole_length: Lanes<S>,
    /// Direction e_h of the plane that a cable over a tilted axis hangs in, to go back to with
    /// [`Guided::return_to`].
    pub(crate) azimuth: Lanes2<S>,
}

/// How the length beyond the leave point follows the force, (L12).
#[derive(Clone, Copy)]
pub(crate) struct FreeLength<S: Simd> {
    /// (L - L(F, Lf))/β [m].
    missing: Lanes<S>,
    /// q/β [m/N].
    per_force: Lanes2<S>,
}

impl<S: Simd> FreeLength<S> {
    /// A length that does not change.
    #[inline(always)]
    pub(crate) fn fixed(zero: Lanes<S>) -> Self {
        Self { missing: zero, per_force: [zero; 2] }
    }

    /// Assigns another one in the lanes that are `active`.
    #[inline(always)]
    fn replace(&mut self, other: &Self, active: Mask<S>) {
        self.update(other.missing, active);
        replace(&mut self.per_force, &other.per_force, active);
    }

    /// Assigns a missing length in the lanes that are `active`.
    #[inline(always)]
    pub(crate) fn update(&mut self, missing: Lanes<S>, active: Mask<S>) {
        self.missing.replace(missing, active);
    }

    /// dLf for a change of the force in the plane.
    #[inline(always)]
    pub(crate) fn change(&self, from: &Lanes2<S>, to: &Lanes2<S>) -> Lanes<S> {
        self.missing + self.per_force[0] * (to[0] - from[0]) + self.per_force[1] * (to[1] - from[1])
    }
}

/// The end of a whole cable.
pub(crate) struct GuidedEnd<S: Simd> {
    /// Its span in the plane that it hangs in.
    pub(crate) span: Span<Lanes<S>>,
    pub(crate) end: LaneEnd<Lanes<S>>,
    /// Misclosure across the plane [m]; zero under a vertical axis.
    pub(crate) across: Lanes<S>,
    /// Missing length beyond the leave point [m].
    pub(crate) missing: Lanes<S>,
}

impl<S: Simd> Guided<S> {
    #[inline(always)]
    pub(crate) fn new(guide: GuideTerms<Lanes<S>>) -> Self {
        let zero = guide.radius.all(0.0);
        Self { guide, whole_length: zero, azimuth: [zero + 1.0, zero] }
    }

    /// Whether its axis is a tilted one, in any lane.
    #[inline(always)]
    pub(crate) fn is_tilted(&self) -> bool {
        matches!(self.guide.axis, SwivelAxis::Along(_))
    }

    /// The guide as it is in the plane of the cable.
    #[inline(always)]
    pub(crate) fn in_plane(&self) -> GuideTerms<Lanes<S>> {
        match self.guide.axis {
            SwivelAxis::Vertical(_) => self.guide,
            SwivelAxis::Along([x, y, z]) => {
                let [c, s] = self.azimuth;
                GuideTerms { axis: SwivelAxis::Along([c * x + s * y, c * y - s * x, z]), ..self.guide }
            }
        }
    }

    /// The plane of a cable over a tilted axis.
    #[inline(always)]
    pub(crate) fn plane(&self) -> CablePlane<Lanes<S>> {
        CablePlane { azimuth: self.azimuth }
    }

    /// The span in the plane that the cable hangs in, and its component across that [m].
    #[inline(always)]
    pub(crate) fn seen(&self, span: &Span<Lanes<S>>) -> (Span<Lanes<S>>, Lanes<S>) {
        match self.is_tilted() {
            true => span.seen_in(self.plane()),
            false => (*span, self.whole_length.all(0.0)),
        }
    }

    /// Turns the plane of a cable over a tilted axis from that of its two points, by cosine and sine.
    #[inline(always)]
    pub(crate) fn turn(&mut self, [c, s]: Lanes2<S>, plane: &CablePlane<Lanes<S>>) {
        let [x, y] = plane.azimuth;
        self.azimuth = [c * x - s * y, c * y + s * x];
    }

    /// Turns the plane by an angle that has the tangent `tangent`, in the lanes that are `active`.
    #[inline(always)]
    pub(crate) fn swing(&mut self, tangent: Lanes<S>, active: Mask<S>) {
        let c = (tangent * tangent + 1.0).sqrt().recip();
        let ([x, y], s) = (self.azimuth, tangent * c);
        replace(&mut self.azimuth, &[c * x - s * y, c * y + s * x], active);
    }

    /// Assigns an azimuth in the lanes that are `active`.
    #[inline(always)]
    pub(crate) fn return_to(&mut self, azimuth: &Lanes2<S>, active: Mask<S>) {
        replace(&mut self.azimuth, azimuth, active);
    }

    /// Where the cable leaves its guide.
    #[inline(always)]
    pub(crate) fn leave_point(&self, free: &FreeCable<'_, Lanes<S>>) -> LeavePoint<Lanes<S>> {
        match self.is_tilted() {
            true => tilted_way(self, *free).leave,
            false => self.guide.leave_point(free.material.weight_per_length, free.length, free.force),
        }
    }

    /// The lanes in which it has no pulley, and the leave point does not move.
    #[inline(always)]
    pub(crate) fn fixed(&self) -> Mask<S> {
        self.guide.radius.less_or_equal(self.guide.radius.all(0.0))
    }

    #[inline(always)]
    pub(crate) fn way(&self, free: &FreeCable<'_, Lanes<S>>) -> Way<Lanes<S>> {
        match self.is_tilted() {
            true => tilted_way(self, *free),
            false => way(&self.guide, free),
        }
    }
}

/// The way of a cable over a guide as it is in the plane of the cable.
#[inline(always)]
fn way<S: Simd>(guide: &GuideTerms<Lanes<S>>, free: &FreeCable<'_, Lanes<S>>) -> Way<Lanes<S>> {
    let weight_per_length = free.material.weight_per_length;
    let leave = guide.leave_point(weight_per_length, free.length, free.force);
    let stretch = free.material.stretch(leave.tension);
    guide.way(weight_per_length, free.length, leave, stretch)
}

/// The places of a guided cable in the linearized platform.
pub(crate) struct GuidedLinearization<'a, S: Simd> {
    pub(crate) cable: &'a mut LinearizedCable<Lanes<S>>,
    pub(crate) free: &'a mut FreeLength<S>,
    /// Of robots with tilted axes.
    pub(crate) swivel: Option<&'a mut Swivel<S>>,
}

apart! {
    /// The way over a tilted axis: vertical ones are more frequent, and their code is faster without it.
    #[inline(always)]
    on(free.length) fn tilted_way<'a, 'b, S: Simd>(
        guided: &'a Guided<S>,
        free: FreeCable<'b, Lanes<S>>,
    ) -> Way<Lanes<S>> {
        way(&guided.in_plane(), &free)
    }

    /// Linearizes the whole cable of a guide in the lanes that are `active`, with the end of (L12).
    #[cold]
    #[inline(never)]
    on(free.length) pub(crate) fn linearize_guided<'a, 'b, S: Simd>(
        guided: &'a Guided<S>,
        free: FreeCable<'b, Lanes<S>>,
        span: Span<Lanes<S>>,
        linearized: GuidedLinearization<'a, S>,
        active: Mask<S>,
    ) {
        let (way, fx) = (guided.way(&free), free.force[0]);
        let missing = guided.whole_length - way.length;
        let change = FreeLength { missing: missing * way.free_per_length, per_force: way.free_per_force };
        linearized.free.replace(&change, active);
        match linearized.swivel {
            Some(swivel) if guided.is_tilted() => {
                let (span, across) = guided.seen(&span);
                let space = way.in_space(fx, &free.response());
                let (cable, own) = in_space(&span, across, free.force, missing, &space);
                linearized.cable.replace(&cable, active);
                swivel.replace(&own, active);
            }
            _ => {
                let response = way.response(fx, &free.response());
                let response = Response { end: moved(response.end, &way, missing), ..response };
                let cable = LinearizedCable::new(&span, free.force, &response);
                linearized.cable.replace(&cable, active);
            }
        }
    }

    /// The lanes in which the cable over `span` ends within [`NEXT_TO_WHEEL`] radii of its leave point.
    #[cold]
    #[inline(never)]
    on(free.length) pub(crate) fn is_next_to_wheel<'a, 'b, S: Simd>(
        guided: &'a Guided<S>,
        free: FreeCable<'b, Lanes<S>>,
        span: Span<Lanes<S>>,
    ) -> Mask<S> {
        let [beyond, _] = guided.seen(&span).0.misclosure(guided.leave_point(&free).position);
        beyond.less_or_equal(guided.guide.radius * NEXT_TO_WHEEL)
    }

    /// The end of the whole cable of a guide, (L12). A cable that is too short for its guide has a slackness
    /// of 2.
    #[cold]
    #[inline(never)]
    on(free.length) pub(crate) fn whole_end<'a, 'b, S: Simd>(
        guided: &'a Guided<S>,
        free: FreeCable<'b, Lanes<S>>,
        span: Span<Lanes<S>>,
    ) -> GuidedEnd<S> {
        let zero = free.length.all(0.0);
        let (way, LaneEnd { end: [x, z], tension, slackness }) = (guided.way(&free), free.end());
        let missing = guided.whole_length - way.length;
        let (span, mut across) = guided.seen(&span);
        if guided.is_tilted() {
            let [leave, per_length] = way.across();
            across = across - leave - per_length * missing;
        }
        let [from_x, from_z] = way.leave.position;
        let end = moved([from_x + x, from_z + z], &way, missing);
        let slackness = zero.less_or_equal(free.length).select(slackness, zero.all(2.0));
        let end = LaneEnd { end, tension, slackness };
        GuidedEnd { span, end, across, missing: missing * way.free_per_length }
    }
}

#[inline(always)]
fn moved<S: Simd>([x, z]: Lanes2<S>, way: &Way<Lanes<S>>, missing: Lanes<S>) -> Lanes2<S> {
    [x + way.end_per_length[0] * missing, z + way.end_per_length[1] * missing]
}
