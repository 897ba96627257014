//! The tensions at the platform that limits allow, as `inverse/limits.rs` has them.
//!
//! A greatest tension at the exit point of a linear cable leaves one at the platform that (C26) of
//! `cdpr_cable` gives in closed form: t + t²/2EA grows with the height by the weight of the cable. Over a
//! pulley the height is that above the leave point of the cable that has this tension, and is found together
//! with it.

use crate::equations::Span;
use crate::lanes::algebra::Lanes2;
use crate::lanes::cable::LaneCable;
use crate::lanes::held::HeldCable;
use crate::lanes::simd::{Lanes, Simd, WithSimd};
use cdpr_cable::kernel::Field;
use cdpr_robot::{CableEnd, TensionLimits};

/// A change below this, relative to the sum of tensions or the longest cable, is the last one.
const LAST_CHANGE: f64 = 1e-7;

const MAX_ITERATIONS: usize = 8;

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
            [least, cable.length.apart(BelowPulley { cable, span, greatest, compared })]
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

/// The tension at the platform [N] of a cable with the tension `exit` [N] at its exit, `height` [m] below it.
#[inline(always)]
fn at_platform<S: Simd>(cable: &LaneCable<'_, S>, exit: Lanes<S>, height: Lanes<S>) -> Lanes<S> {
    let half = cable.axial_flexibility * 0.5;
    let whole = exit + exit * exit * half + cable.weight_per_length * height;
    whole * 2.0 * ((whole * half * 4.0 + 1.0).sqrt() + 1.0).recip()
}

/// The greatest tension at the platform of a cable with the tension `greatest` at its leave point.
struct BelowPulley<'a, 'b, S: Simd> {
    cable: &'a mut LaneCable<'b, S>,
    span: &'a Span<Lanes<S>>,
    greatest: Lanes<S>,
    compared: [f64; 2],
}

impl<S: Simd> WithSimd for BelowPulley<'_, '_, S> {
    type Output = Lanes<S>;

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) -> Lanes<S> {
        let Self { cable, span, greatest, compared } = self;
        let (length, force) = (cable.length, cable.force);
        let mut going = length.less_or_equal(length);
        let mut found = greatest;
        for _ in 0..MAX_ITERATIONS {
            let Some(guided) = &cable.guided else { break };
            let [_, rise] = guided.leave_point(cable).position;
            found.replace(at_platform(cable, greatest, span.end[1] - rise), going);
            let held = HeldCable::leaving(guided, cable, span);
            let moved = held.change(cable, held.way_to(found), going, compared);
            going = going & !moved.less_or_equal(moved.all(LAST_CHANGE));
            if !going.any() {
                break;
            }
        }
        (cable.length, cable.force) = (length, force);
        going.select(length.all(-1.0), found)
    }
}
