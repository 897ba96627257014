//! The chain of an observation, one robot in each lane.
//!
//! Its links are the inverse model, the offset set-points, and the direct model without and with the load.
//! The equations are those of `inverse.rs` and `direct/newton.rs`, with one difference: the shape of a cable
//! is not solved for but takes part in the iteration. With û the direction of the force at its end, n̂ the
//! normal to it, C the flexibility, `e = d(x, z)/dL` and c its misclosure at force and length,
//!
//! ```text
//! C (û dt + n̂ t dθ) + e dL = c      gives      dθ = α + β dt,    dL = γ + δ dt                         (L1)
//! ```
//!
//! for a change dt of its tension. With w the wrench of a unit tension, n its derivative with respect to θ,
//! and λ the multipliers of the balance, the optimum (I2) for the reference r and a step towards it are
//!
//! ```text
//! t - r + c·λ = 0,      sum t w + w_ex = 0,      c = w + t β n                                         (L2)
//! [ sum c cᵀ/D ] dλ = R2 - sum c R1/D,      dt = -(R1 + c·dλ)/D,                                       (L3)
//!      R1 = t - r + (c + α (n - t β w))·λ,   R2 = sum t (w + α n) + w_ex,   D = 1 - t β² w·λ
//! ```
//!
//! c is the derivative of the cable's wrench with respect to its tension. D holds the derivative of c for a
//! parabola, whose direction turns in proportion to 1/t; for a taut cable little is missing. A cable that
//! hangs at the least tension that its length allows has no such slope: its lane finds nothing.
//!
//! A lane stops by its own steps alone: the other lanes of a batch change none of its digits.

use crate::equations::vector::{dot, wrench};
use crate::equations::{LinearizedCable, Span};
use crate::lanes::algebra::{Lanes2, Lanes3, Lanes6, SymmetricFactors, six, three};
use crate::lanes::cable::LaneCable;
use crate::lanes::newton::{LaneResidual, LinearizedPlatform, MAX_ITERATIONS, PlatformLoad, Robots, Scale};
use crate::lanes::simd::{Lanes, Mask, Simd};
use cdpr_cable::kernel::{FOLDED, Field, Response};
use cdpr_robot::{CableEnd, TensionLimits};
use cdpr_tension::Bound;

/// Robots at their wanted pose, with lengths and forces to start from.
pub(crate) struct ChainStart<S: Simd> {
    pub(crate) robots: Robots<S>,
    /// Offset of the tension set-point of each cable [N].
    pub(crate) offsets: Vec<Lanes<S>>,
    /// λ to start from.
    pub(crate) multipliers: Lanes6<S>,
    /// Weight of the payload, and the force of the load at P.
    pub(crate) payload: PlatformLoad<S>,
}

/// The tensions that a cable may have, and the one that is preferred.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Choice {
    /// r [N].
    pub(crate) reference: f64,
    /// Least and greatest tension allowed [N].
    pub(crate) limits: TensionLimits,
    /// Where the greatest tension is limited.
    pub(crate) max_at: CableEnd,
    /// The limit at which the nominal robot has it.
    pub(crate) active: Option<Bound>,
}

/// What all robots of a batch share.
#[derive(Clone, Debug)]
pub(crate) struct Shared {
    /// For each cable.
    pub(crate) choices: Vec<Choice>,
    /// Sum of the tensions that changes are compared with [N].
    pub(crate) tension: f64,
    /// Lengths that positions are compared with.
    pub(crate) scale: Scale,
}

/// The answer for every robot.
pub(crate) struct Outcome<S: Simd> {
    /// The lanes that passed each link: tensions that are nearest to their reference, no cable folded and
    /// limits that do not exclude each other, lengths, and an equilibrium without and with the load that is
    /// stable and converged to rounding.
    pub(crate) passed: [Mask<S>; 5],
    /// dp [m].
    pub(crate) displacement: Lanes3<S>,
    pub(crate) unloaded: LaneResidual<S>,
    pub(crate) loaded: LaneResidual<S>,
}

/// A change of lengths and forces below this, relative to the longest cable or the sum of tensions, is the
/// last one at the wanted pose.
const LAST_CHANGE: f64 = 1e-7;

/// The same for a change of a cable's force, relative to its own tension, which may be a small part of the
/// sum. What is left of it is of second order: for a cable near its least tension 1e-12 of its length.
const LAST_OWN_CHANGE: f64 = 1e-6;

/// The same for tensions that are still to be offset: their error then changes no position by more than 1e-12
/// m.
const LAST_DISTRIBUTION: f64 = 1e-9;

/// Greatest -t/L dL/dt of a cable. It is 1/EA of the tension for a straight cable and grows without bound
/// towards the least tension of a span; a level cable has 8 at 1.001 times that tension, a steep one less.
const STEEPEST: f64 = 2.0;

/// Iterations for the tensions, whose limits may change on the way.
const MAX_DISTRIBUTIONS: usize = 20;

/// Observes every robot: its displacement under the load, with the lengths that give the offset tensions at
/// the wanted pose.
#[inline(always)]
pub(crate) fn observe<S: Simd>(begin: ChainStart<S>, shared: &Shared) -> Outcome<S> {
    let ChainStart { mut robots, offsets, multipliers, payload } = begin;
    let robots = &mut robots;
    let zero = robots.weight.all(0.0);
    let mut spans = Vec::with_capacity(robots.cables.len());
    for cable in &robots.cables {
        spans.push(cable.span(&robots.position));
    }
    let mut set_points = offsets;
    let (converged, sound) = distribute(robots, multipliers, &mut set_points, &spans, shared);
    let mut platform = LinearizedPlatform::new(zero, spans.len());
    let held = hold(robots, &mut platform, &set_points, &spans, shared);

    let own = PlatformLoad { weight: robots.weight, force: [zero; 3] };
    robots.assemble(&own, &mut platform, zero.less_or_equal(zero));
    let (standing, unloaded) = robots.settle(&own, &mut platform, &shared.scale, converged & sound & held);
    let stood = robots.position;

    let load = PlatformLoad { weight: own.weight + payload.weight, force: payload.force };
    // The first step follows the linearisation at hand.
    let added = payload.wrench(&robots.center);
    platform.gradient = six(|k| platform.gradient[k] - added[k]);
    let (answered, loaded) = robots.settle(&load, &mut platform, &shared.scale, standing);
    // Eq. (4)
    let displacement = three(|k| robots.position[k] - stood[k]);
    Outcome { passed: [converged, sound, held, standing, answered], displacement, unloaded, loaded }
}

impl<S: Simd> LaneCable<S> {
    /// The tensions at the platform that the limits allow [N], as `limits_at` has them.
    #[inline(always)]
    fn limits(&self, span: &Span<Lanes<S>>, choice: &Choice) -> [Lanes<S>; 2] {
        let (least, greatest) = (self.length.all(choice.limits.min), self.length.all(choice.limits.max));
        match choice.max_at {
            CableEnd::Anchor => [least, greatest],
            CableEnd::Exit => {
                // (C26) of `cdpr_cable`, for a linear cable: t + t²/2EA grows with the height by its weight.
                let half = self.axial_flexibility * 0.5;
                let whole = greatest + greatest * greatest * half + self.weight_per_length * span.end[1];
                [least, whole * 2.0 * ((whole * half * 4.0 + 1.0).sqrt() + 1.0).recip()]
            }
        }
    }
}

/// The lanes in which a cable is held at the least of its tensions, and at the greatest.
#[derive(Clone, Copy)]
struct AtLimit<S: Simd> {
    limits: [Lanes<S>; 2],
    sides: [Mask<S>; 2],
    /// Whether it is held in any lane.
    any: bool,
}

impl<S: Simd> AtLimit<S> {
    #[inline(always)]
    fn new(limits: [Lanes<S>; 2], active: Option<Bound>) -> Self {
        let all = limits[0].less_or_equal(limits[0]);
        let none = all & !all;
        let sides = match active {
            None => [none, none],
            Some(Bound::Min) => [all, none],
            Some(Bound::Max) => [none, all],
        };
        Self { limits, sides, any: active.is_some() }
    }

    /// `free` in the lanes in which the cable is held at no limit, in the others `held` or, at the least
    /// tension, `least`.
    #[inline(always)]
    fn select(&self, free: Lanes<S>, [least, greatest]: [Lanes<S>; 2]) -> Lanes<S> {
        self.sides[0].select(least, self.sides[1].select(greatest, free))
    }

    /// Holds the cable where its tension has passed a limit, and frees it where the sum to be minimised falls
    /// with a tension on the right side: (I2) of `inverse.rs`, whose slope over the tension is `slope`.
    /// Returns the lanes in which nothing changes.
    #[inline(always)]
    fn revise(&mut self, tension: Lanes<S>, slope: Lanes<S>, going: Mask<S>) -> Mask<S> {
        let zero = slope.all(0.0);
        let [low, high] = self.sides;
        let free = !(low | high);
        let below = free & !self.limits[0].less_or_equal(tension);
        let above = free & !tension.less_or_equal(self.limits[1]);
        let (rises, falls) = (low & !zero.less_or_equal(slope), high & !slope.less_or_equal(zero));
        let changed = going & (below | above | rises | falls);
        self.sides = [
            (low & !(changed & rises)) | (changed & below),
            (high & !(changed & falls)) | (changed & above & !below),
        ];
        self.any |= changed.any();
        !changed
    }
}

/// A cable at its held ends, equation (L1).
#[derive(Clone, Copy)]
struct HeldCable<S: Simd> {
    tension: Lanes<S>,
    /// q².
    slackness: Lanes<S>,
    /// û.
    along: Lanes2<S>,
    alpha: Lanes<S>,
    beta: Lanes<S>,
    gamma: Lanes<S>,
    delta: Lanes<S>,
}

impl<S: Simd> HeldCable<S> {
    #[inline(always)]
    fn new(cable: &LaneCable<S>, span: &Span<Lanes<S>>, response: &Response<Lanes<S>>) -> Self {
        let [fx, fz] = cable.force;
        let [xx, xz, zz] = response.flexibility;
        let along = response.direction;
        let miss = span.misclosure(response.end);
        let rotation = [xz * fx - xx * fz, zz * fx - xz * fz];
        let give = [xx * along[0] + xz * along[1], xz * along[0] + zz * along[1]];
        let longer = response.end_per_length;
        let area = |a: &Lanes2<S>, b: &Lanes2<S>| a[0] * b[1] - a[1] * b[0];
        let inverse = area(&rotation, &longer).recip();
        Self {
            tension: response.tension,
            slackness: response.slackness,
            along,
            alpha: area(&miss, &longer) * inverse,
            beta: -area(&give, &longer) * inverse,
            gamma: area(&rotation, &miss) * inverse,
            delta: -area(&rotation, &give) * inverse,
        }
    }

    /// Where the tension falls as cable is paid out, and is not next to the least one that the span demands,
    /// at which the scalar models hold the cable.
    #[inline(always)]
    fn is_taut(&self, cable: &LaneCable<S>) -> Mask<S> {
        let zero = self.delta.all(0.0);
        self.delta.less_or_equal(zero) & (-(self.delta * self.tension)).less_or_equal(cable.length * STEEPEST)
    }

    /// Changes the tension by `dt` where `going`. Returns the largest relative change made.
    #[inline(always)]
    fn change(&self, cable: &mut LaneCable<S>, dt: Lanes<S>, going: Mask<S>, shared: &Shared) -> Lanes<S> {
        let across = (self.alpha + self.beta * dt) * self.tension;
        let longer = self.gamma + self.delta * dt;
        let [ux, uz] = self.along;
        let [fx, fz] = cable.force;
        cable.force =
            [going.select(fx + ux * dt - uz * across, fx), going.select(fz + uz * dt + ux * across, fz)];
        cable.length = going.select(cable.length + longer, cable.length);
        let force = (dt.abs() + across.abs()) * (1.0 / shared.tension);
        force.max(longer.abs() * (1.0 / shared.scale.size))
    }
}

/// The tensions nearest to their reference at the wanted pose, equations (L2) and (L3); `offsets` are added
/// to them and become set-points, towards which cables make a first step. Returns the lanes where they were
/// found, and those where no cable is folded and no limits exclude each other.
///
/// A cable that is held at a limit of its tension has a known dt and drops out of the matrix. Which ones are
/// held is known of the nominal robot; where the optimum of a lane says otherwise, that lane goes on.
#[inline(always)]
fn distribute<S: Simd>(
    robots: &mut Robots<S>,
    mut multipliers: Lanes6<S>,
    offsets: &mut [Lanes<S>],
    spans: &[Span<Lanes<S>>],
    shared: &Shared,
) -> (Mask<S>, Mask<S>) {
    let zero = robots.weight.all(0.0);
    let last_change = zero.all(LAST_DISTRIBUTION);
    let weight = PlatformLoad { weight: robots.weight, force: [zero; 3] }.wrench(&robots.center);
    let mut going = zero.less_or_equal(zero);
    let mut within = going;
    let mut linear = Vec::with_capacity(spans.len());
    let mut at_limits = Vec::with_capacity(spans.len());
    for ((span, cable), choice) in spans.iter().zip(&robots.cables).zip(&shared.choices) {
        at_limits.push(AtLimit::new(cable.limits(span, choice), choice.active));
    }
    for _ in 0..MAX_DISTRIBUTIONS {
        linear.clear();
        let mut matrix = [[zero; 6]; 6];
        let mut right = weight;
        let cables = spans.iter().zip(&robots.cables).zip(&shared.choices);
        for (((span, cable), choice), at_limit) in cables.zip(&at_limits) {
            let held = HeldCable::new(cable, span, &cable.response());
            let [ux, uz] = held.along;
            let pull = wrench(&cable.anchor_arm, &span.plane.force_on_platform(held.along));
            let rotation = wrench(&cable.anchor_arm, &span.plane.force_on_platform([-uz, ux]));
            let (pulled, rotated) = (dot(&pull, &multipliers), dot(&rotation, &multipliers));
            let bent = held.tension * held.beta;
            let mut d_inv = (-(bent * held.beta * pulled) + 1.0).recip();
            let beyond = held.tension + -choice.reference;
            let left = beyond + pulled + bent * rotated + held.alpha * (rotated - bent * pulled);
            let slope = six(|k| pull[k] + rotation[k] * bent);
            let mut known = zero;
            if at_limit.any {
                let [low, high] = at_limit.limits;
                known = at_limit.select(zero, [low - held.tension, high - held.tension]);
                d_inv = at_limit.select(d_inv, [zero; 2]);
                for k in 0..6 {
                    right[k] += slope[k] * known;
                }
            }
            for k in 0..6 {
                let c = slope[k] * d_inv;
                right[k] += (pull[k] + rotation[k] * held.alpha) * held.tension - c * left;
                for l in k..6 {
                    matrix[k][l] += c * slope[l];
                }
            }
            linear.push((held, slope, left, d_inv, known));
        }
        let step = SymmetricFactors::new(matrix).solve(&right);
        let mut moved = zero;
        for ((held, slope, left, d_inv, known), cable) in linear.iter().zip(&mut robots.cables) {
            let dt = *known - (*left + dot(slope, &step)) * *d_inv;
            moved = moved.max(held.change(cable, dt, going, shared));
        }
        multipliers = six(|k| going.select(multipliers[k] + step[k], multipliers[k]));
        let mut last = going & moved.less_or_equal(last_change);
        if last.any() {
            let here = last;
            let cables = linear.iter().zip(&robots.cables).zip(&mut at_limits);
            for (((_, slope, left, ..), cable), at_limit) in cables {
                let tension = dot(&cable.force, &cable.force).sqrt();
                last = last & at_limit.revise(tension, *left + dot(slope, &step), here);
            }
            let cables = linear.iter().zip(&mut robots.cables).zip(&mut *offsets);
            for ((((held, ..), cable), offset), at_limit) in cables.zip(&at_limits) {
                let [least, greatest] = at_limit.limits;
                let tension = dot(&cable.force, &cable.force).sqrt();
                let set_point = (at_limit.select(tension, at_limit.limits) + *offset).max(least);
                let set_point = set_point.less_or_equal(greatest).select(set_point, greatest);
                let sound = zero.less_or_equal(cable.force[0])
                    & held.slackness.less_or_equal(zero.all(FOLDED))
                    & held.is_taut(cable)
                    & least.less_or_equal(greatest);
                within = within & (sound | !last);
                *offset = last.select(set_point, *offset);
                let closed = HeldCable { alpha: zero, gamma: zero, ..*held };
                closed.change(cable, set_point - tension, last, shared);
            }
        }
        going = going & !last;
        if !going.any() {
            break;
        }
    }
    (!going, within)
}

/// Lengths that give the tensions `set_points` at the wanted pose, and the cables linearised there. Returns
/// the lanes where all were found.
#[inline(always)]
fn hold<S: Simd>(
    robots: &mut Robots<S>,
    platform: &mut LinearizedPlatform<S>,
    set_points: &[Lanes<S>],
    spans: &[Span<Lanes<S>>],
    shared: &Shared,
) -> Mask<S> {
    let zero = robots.weight.all(0.0);
    let mut all = zero.less_or_equal(zero);
    let cables = robots.cables.iter_mut().zip(&mut platform.cables);
    for ((span, set_point), (cable, linearized)) in spans.iter().zip(set_points).zip(cables) {
        let (mut going, mut taut) = (all, all);
        for _ in 0..MAX_ITERATIONS {
            let response = cable.response();
            let held = HeldCable::new(cable, span, &response);
            taut = (!going & taut) | (going & held.is_taut(cable));
            linearized.replace(&LinearizedCable::new(span, cable.force, &response), going);
            let dt = *set_point - held.tension;
            let own = (dt / held.tension).abs() + (held.alpha + held.beta * dt).abs();
            // t/L dL/dt grows without bound towards the least tension, and with it what a step leaves.
            let steepness = held.delta.abs() * held.tension * (1.0 / (10.0 * shared.scale.size));
            let longer = (held.gamma + held.delta * dt).abs() * steepness * (1.0 / shared.scale.size);
            let own = (own * (LAST_CHANGE / LAST_OWN_CHANGE)).max(longer);
            let moved = held.change(cable, dt, going, shared).max(own);
            going = going & !moved.less_or_equal(zero.all(LAST_CHANGE));
            if !going.any() {
                break;
            }
        }
        // The last change closes the cable to rounding.
        linearized.predicted = cable.force;
        // A root with a cable of negative length is invalid.
        all = all & !going & taut & zero.less_or_equal(cable.length) & zero.less_or_equal(cable.force[0]);
    }
    all
}
