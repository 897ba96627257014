//! The lengths that give the tensions of set-points at the wanted pose, one robot in each lane.

use crate::equations::{LinearizedCable, Span};
use crate::lanes::chain::shared::Shared;
use crate::lanes::fixed_ends::FixedEnds;
use crate::local::cable::FOLDED;
use crate::local::guided::{GuidedLinearization, linearize_guided};
use crate::local::platform::{LinearizedPlatform, Robots};
use cdpr_number::lanes::{Lanes, Mask, Simd};
use cdpr_number::{Number, apart};

/// A change of lengths and forces below this, relative to the longest cable or the sum of tensions, is the
/// last one at the wanted pose.
const LAST_CHANGE: f64 = 1e-7;

/// The same for a change of a cable's force, relative to its own tension, which may be a small part of the
/// sum. What is left of it is of second order: for a cable near its least tension 1e-12 of its length.
const LAST_OWN_CHANGE: f64 = 1e-6;

/// Iterations for the length of a cable at its set-point.
const MAX_ITERATIONS: usize = 8;

apart! {
    /// Lengths that give the tensions `set_points` at the wanted pose, and the cables linearized there: the
    /// lanes where all were found. For each cable `demanded` has those where the least tension of its span is
    /// known.
    #[inline(always)]
    on(robots.weight) pub(crate) fn find_lengths<'b, 'a, S: Simd>(
        robots: &'b mut Robots<'a, S>,
        platform: &'b mut LinearizedPlatform<S>,
        set_points: &'b [Lanes<S>],
        of_cables: (&'b [Span<Lanes<S>>], &'b [Mask<S>]),
        shared: &'b Shared,
    ) -> Mask<S> {
        let (spans, demanded) = of_cables;
        let zero = robots.weight.all(0.0);
        let compared = [shared.tension, shared.scale.size];
        let mut all = zero.less_or_equal(zero);
        platform.follow_guides(robots);
        let cables = robots.cables.iter_mut().zip(&mut platform.cables);
        let each = spans.iter().zip(set_points).zip(cables).enumerate();
        for (i, ((span, set_point), (cable, linearized))) in each {
            let (mut active, mut taut) = (all, all);
            for _ in 0..MAX_ITERATIONS {
                let fixed = match &cable.guided {
                    None => {
                        let response = cable.response();
                        linearized.replace(&LinearizedCable::new(span, cable.force, &response), active);
                        FixedEnds::plain(cable, span, &response)
                    }
                    Some(guided) => FixedEnds::leaving(guided, cable, span),
                };
                let folds = zero.all(FOLDED).less_or_equal(fixed.slackness);
                taut = (!active & taut) | (active & fixed.is_taut(cable, demanded[i]) & !folds);
                let fx = cable.force[0];
                let inverse = (fx * fixed.tension_slope).recip();
                let d = (*set_point - fixed.closed) * fx * inverse;
                // What a step leaves grows with its curvature over its slope.
                let own = d.abs() + fixed.closing[0].abs() * fixed.flatness * fixed.tension_slope;
                let own = own * inverse * (LAST_CHANGE / LAST_OWN_CHANGE);
                let moved = fixed.change(cable, d, active, compared).max(own);
                active = active & !moved.less_or_equal(zero.all(LAST_CHANGE));
                if !active.any() {
                    break;
                }
            }
            cable.keep_length();
            let mut swivel = platform.swivels.get_mut(i);
            if let Some(guided) = &cable.guided {
                let everywhere = zero.less_or_equal(zero);
                let (free, swivel) = (&mut platform.free[i], swivel.as_deref_mut());
                let places = GuidedLinearization { cable: linearized, free, swivel };
                linearize_guided(guided, cable.free(), *span, places, everywhere);
            }
            // The last change closes the cable to rounding.
            linearized.predicted = cable.force;
            if let Some(swivel) = swivel {
                swivel.predicted = zero;
            }
            // A root with a cable of negative length is invalid.
            let [fx, fz] = cable.force;
            all = all & !active & taut & zero.less_or_equal(cable.length) & zero.less_or_equal(fx);
            all = all & !cable.may_be_overstrained((fx * fx + fz * fz).sqrt());
        }
        all
    }
}
