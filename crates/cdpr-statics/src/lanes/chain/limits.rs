//! The tensions at the platform that limits allow, as `inverse/limits.rs` has them.
//!
//! A greatest tension at the exit point leaves one at the platform by (C26) of `cdpr_cable`: t + W(t) grows
//! with the height by the weight of the cable. For a linear cable this is a closed form, for others Newton's
//! method for a convex function finds it. Over a pulley the height is that above the leave point of the cable
//! that has this tension, and is found together with it.
//!
//! A span demands a least tension of a cable with weight: where the horizontal force becomes less, the
//! tension rises again. Newton's method for its slope over the logarithm of that force finds it.

use crate::equations::{ABOVE_LEAST, Span};
use crate::lanes::fixed_ends::FixedEnds;
use crate::local::cable::LaneCable;
use crate::local::guided::Guided;
use cdpr_number::dense::{Lanes2, replace};
use cdpr_number::lanes::{Lanes, Mask, Simd};
use cdpr_number::{Number, apart};
use cdpr_robot::{CableEnd, TensionLimits};

/// A change below this, relative to the sum of tensions, the longest cable and the cable's own horizontal
/// force, is the last one.
const LAST_CHANGE: f64 = 1e-7;

const MAX_ITERATIONS: usize = 10;

/// Greatest change of the logarithm of a horizontal force in one step towards the least tension.
const LONGEST_CHANGE: f64 = 0.7;

/// Least and greatest tension at the platform of a cable over `span` [N]; `compared` are the tension and the
/// length that changes are compared with. Where none is found the greatest is below zero.
#[inline(always)]
pub(crate) fn limits_at<S: Simd>(
    cable: &mut LaneCable<'_, S>,
    span: &Span<Lanes<S>>,
    (limits, max_at): (TensionLimits, CableEnd),
    compared: [f64; 2],
) -> Lanes2<S> {
    match (max_at, &cable.guided) {
        (CableEnd::Exit, Some(_)) => {
            let (least, greatest) = (cable.length.all(limits.min), cable.length.all(limits.max));
            [least, below_pulley(cable, span, greatest, compared)]
        }
        _ => plain_limits_at(cable, span, (limits, max_at)),
    }
}

/// The same of a cable without pulley.
#[inline(always)]
pub(crate) fn plain_limits_at<S: Simd>(
    cable: &LaneCable<'_, S>,
    span: &Span<Lanes<S>>,
    (limits, max_at): (TensionLimits, CableEnd),
) -> Lanes2<S> {
    let (least, greatest) = (cable.length.all(limits.min), cable.length.all(limits.max));
    match max_at {
        CableEnd::Anchor => [least, greatest],
        CableEnd::Exit => [least, at_platform(cable, greatest, span.end[1])],
    }
}

/// A cable whose tension exceeds the least one of its span by less than this share of it may come to it.
const NEARBY: f64 = 0.2;

/// Whether a cable may come to the least tension of its span.
#[inline(always)]
pub(crate) fn may_be_slack<S: Simd>(cable: &LaneCable<'_, S>, fixed: &FixedEnds<S>) -> Mask<S> {
    !fixed.exceeds_least(cable, cable.length.all(NEARBY))
}

apart! {
    /// Raises the least tension of a cable that `fixed` shows near the least one that its span demands, to
    /// where the scalar models keep it, and brings a cable below it there. Returns the lanes in which that
    /// was done. Where none is found the greatest tension is below zero.
    #[cold]
    #[inline(never)]
    on(cable.length) pub(crate) fn demand<'a, 'b, S: Simd>(
        cable: &'a mut LaneCable<'b, S>,
        span: &'a Span<Lanes<S>>,
        fixed: &'a FixedEnds<S>,
        limits: &'a mut Lanes2<S>,
        compared: [f64; 2],
    ) -> Mask<S> {
        let zero = cable.length.all(0.0);
        let (length, force) = (cable.length, cable.force);
        let azimuth = cable.guided.as_ref().map(Guided::azimuth);
        let near = may_be_slack(cable, fixed);
        let (mut at_least, mut active) = (*fixed, near);
        for _ in 0..MAX_ITERATIONS {
            let fx = cable.force[0];
            let slope = fx * at_least.tension_slope;
            let curvature = slope + fx * fx * at_least.curvatures[0];
            let change = (-(slope / curvature)).max(zero.all(-LONGEST_CHANGE));
            let change = change.less_or_equal(zero.all(LONGEST_CHANGE)).select(change, zero + LONGEST_CHANGE);
            let moved = at_least.change(cable, fx * change, active, compared);
            active = active & !moved.max(change.abs()).less_or_equal(zero.all(LAST_CHANGE));
            at_least = FixedEnds::new(cable, span);
            if !active.any() {
                break;
            }
        }
        let least = zero.all(ABOVE_LEAST) * at_least.closed;
        limits[0].replace(limits[0].max(least), near);
        limits[1].replace(zero.all(-1.0), near & active);
        // Next to the least tension, where it has no slope: t = t_0 + t'' d²/2.
        let rise = (limits[0] - at_least.closed) * 2.0;
        let d = (rise / at_least.curvatures[0]).max(zero).sqrt();
        at_least.change(cable, d, near, compared);
        let keeps = !near | (zero.less_or_equal(fixed.tension_slope) & limits[0].less_or_equal(fixed.closed));
        cable.length.replace(length, keeps);
        replace(&mut cable.force, &force, keeps);
        if let (Some(guided), Some(azimuth)) = (&mut cable.guided, &azimuth) {
            guided.return_to(azimuth, keeps);
        }
        near
    }
}

/// The tension at the platform [N] of a cable with the tension `exit` [N] at its exit, `height` [m] below it.
#[inline(always)]
pub(crate) fn at_platform<S: Simd>(cable: &LaneCable<'_, S>, exit: Lanes<S>, height: Lanes<S>) -> Lanes<S> {
    match cable.law {
        [] => cable.material().tension_above(exit, height),
        _ => with_law(cable, exit, height),
    }
}

apart! {
    /// [`at_platform`] for a cable with a law.
    #[inline(always)]
    on(exit) fn with_law<'a, 'b, S: Simd>(
        cable: &'a LaneCable<'b, S>,
        exit: Lanes<S>,
        height: Lanes<S>,
    ) -> Lanes<S> {
        cable.material().tension_above(exit, height)
    }

    /// The greatest tension at the platform of a cable with the tension `greatest` at its leave point.
    #[inline(always)]
    on(greatest) fn below_pulley<'a, 'b, S: Simd>(
        cable: &'a mut LaneCable<'b, S>,
        span: &'a Span<Lanes<S>>,
        greatest: Lanes<S>,
        compared: [f64; 2],
    ) -> Lanes<S> {
        let (length, force) = (cable.length, cable.force);
        let (azimuth, everywhere) =
            (cable.guided.as_ref().map(Guided::azimuth), greatest.less_or_equal(greatest));
        let mut active = length.less_or_equal(length);
        let (mut found, mut taut) = (greatest, active);
        // From a cable that is slack Newton's method may lead to a longer one of the same tension.
        let slack = may_be_slack(cable, &FixedEnds::new(cable, span));
        if slack.any() {
            let end = cable.free_end(span);
            let straight = greatest * end[0] / (end[0] * end[0] + end[1] * end[1]).sqrt();
            cable.force[0].replace(straight.max(force[0]), slack);
            cable.hang(end, slack);
        }
        for _ in 0..MAX_ITERATIONS {
            let Some(guided) = &cable.guided else { break };
            let [_, rise] = guided.leave_point(&cable.free()).position;
            found.replace(at_platform(cable, greatest, span.end[1] - rise), active);
            let fixed = FixedEnds::leaving(guided, cable, span);
            taut = (!active & taut) | (active & greatest.all(0.0).less_or_equal(fixed.tension_slope));
            let way = fixed.way_to(found);
            let own = way.abs() / cable.force[0];
            let moved = fixed.change(cable, way, active, compared).max(own);
            active = active & !moved.less_or_equal(moved.all(LAST_CHANGE));
            if !active.any() {
                break;
            }
        }
        (cable.length, cable.force) = (length, force);
        if let (Some(guided), Some(azimuth)) = (&mut cable.guided, &azimuth) {
            guided.return_to(azimuth, everywhere);
        }
        (active | !taut).select(length.all(-1.0), found)
    }
}
