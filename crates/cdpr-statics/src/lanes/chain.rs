//! The chain of an observation, one robot in each lane.
//!
//! Its links are the inverse model, the offset set-points, and the direct model without and with the load.
//! The equations are those of `inverse.rs` and `direct/newton.rs`, with one difference: the shape of a cable
//! is not solved for but takes part in the iteration. The unknown of a cable is its horizontal force fx,
//! which at held ends is proportional to its chord force: all derivatives are finite, also at the least
//! tension.
//! With C the flexibility, `e = d(x, z)/dL` and c the misclosure at force and length,
//!
//! ```text
//! C (0, dz) + e dL = c,      C (1, g) + e L' = 0                                                      (L1)
//! ```
//!
//! give the force `(fx, fz + dz)` that closes the cable at the same fx, and its slope `f' = (1, g)` over fx;
//! `t' = û·f'` is that of the tension. With J the wrench of f', w that of the closing force, λ the
//! multipliers of the balance and r the reference, the optimum (I2) and a step towards it are
//!
//! ```text
//! (t - r) t' + J·λ = 0,      sum w + w_ex = 0                                                        (L2)
//! [ sum J Jᵀ/h ] dλ = R2 - sum J R1/h,      dfx = -(R1 + J·dλ)/h,                                  (L3)
//!      R1 = (t + û_z dz - r) t' + J·λ,   R2 = sum w + w_ex,   h = t'² + (t - r) t'' + λ·w''
//! ```
//!
//! Where steps pass limits of the tensions, `chain/program.rs` finds those within them.
//!
//! For a parabola fz is linear in fx and w'' zero; what sag adds is that of the inextensible catenary
//! ([`HeldCable::curvature`]). A cable that begins near the least tension of its span has it for a limit, as
//! in the scalar models; one that comes near it on the way is left to them.
//!
//! A lane stops by its own steps alone: the other lanes of a batch change none of its digits.

pub(crate) mod free;
pub(crate) mod limits;
pub(crate) mod minimum;
mod program;
pub(crate) mod shared;

use crate::equations::{LinearizedCable, Span};
use crate::inverse::NEARLY_ROUNDING;
use crate::lanes::cable::LaneCable;
use crate::lanes::chain::free::{FreeMotion, rest};
use crate::lanes::chain::limits::{demand, limits_at, may_be_slack};
use crate::lanes::chain::minimum::is_least;
use crate::lanes::chain::program::{Row, newton, within_limits};
use crate::lanes::chain::shared::{LAST_DISTRIBUTION, LAST_REMAINDER, LAST_SHARE, MAX_DISTRIBUTIONS, Shared};
use crate::lanes::freedoms::hold;
use crate::lanes::held::HeldCable;
use crate::lanes::load::PlatformLoad;
use crate::lanes::newton::{LaneResidual, LinearizedPlatform, Robots};
use cdpr_cable::kernel::FOLDED;
use cdpr_number::Number;
use cdpr_number::dense::{Lanes2, Lanes3, Lanes6, halves, replace};
use cdpr_number::lanes::{Lanes, Mask, Simd, WithSimd};
use cdpr_number::vector::{dot, wrench};
use cdpr_number::{six, three};

/// Robots at their wanted pose.
pub(crate) struct ChainStart<'a, S: Simd> {
    pub(crate) robots: Robots<'a, S>,
    /// Offset of the tension set-point of each cable [N].
    pub(crate) offsets: Vec<Lanes<S>>,
    /// λ to start from.
    pub(crate) multipliers: Lanes6<S>,
    /// Weight of the payload, and the force and moment of the load at P.
    pub(crate) payload: PlatformLoad<S>,
    /// The free coordinates of robots with fewer cables than motions; mostly none.
    pub(crate) free: Vec<FreeMotion<S>>,
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

/// Step of a cable that sags, relative to its horizontal force, from which on the point that it leads to is
/// compared with others. Without the comparison 14 of 15 040 rows of random robots in `tests/any_lanes.rs`
/// have another minimum than the scalar models find near the nominal robot (27 000 cases), with it one of
/// 14 850, which is the least of all.
const LONGEST_STEP: f64 = 0.3;

/// q² from which a cable sags.
pub(crate) const SAGGING: f64 = 0.02;

/// Least curvature of a step, relative to that of a straight cable.
const LEAST_CURVATURE: f64 = 0.01;

/// Iterations for the length of a cable at its set-point.
const MAX_ITERATIONS: usize = 8;

/// Who keeps the links of a chain.
pub(crate) type Keeper<'k, 'a, S> = Option<&'k mut (dyn Keep<'a, S> + 'k)>;

/// What is kept of the links of a chain.
pub(crate) trait Keep<'a, S: Simd> {
    /// Cable `i` with its tension of the inverse model, found in the lanes `last`; its limits, and the lanes
    /// where it is at either of them.
    fn chosen(
        &mut self,
        _i: usize,
        _cable: &LaneCable<'a, S>,
        _limits: &Lanes2<S>,
        _sides: [Mask<S>; 2],
        _last: Mask<S>,
    ) {
    }

    /// The multipliers of the inverse model.
    fn multipliers(&mut self, _multipliers: &Lanes6<S>) {}

    /// Least and greatest tension of each cable [N].
    fn limits(&mut self, _limits: &[Lanes2<S>]) {}

    /// The robots with their cables wound at the wanted pose, at rest without the load, and with it.
    fn state(&mut self, _robots: &Robots<'a, S>) {}
}

/// Observes every robot: its displacement under the load, with the lengths that give the offset tensions at
/// the wanted pose. All observers share one function for each vector unit.
#[inline(always)]
pub(crate) fn observe<'b, 'a, S: Simd>(
    begin: &'b mut ChainStart<'a, S>,
    shared: &'b Shared,
    keep: Keeper<'b, 'a, S>,
) -> Outcome<S> {
    let simd = begin.robots.weight;
    simd.apart(Chain { begin, shared, keep })
}

struct Chain<'b, 'a, S: Simd> {
    begin: &'b mut ChainStart<'a, S>,
    shared: &'b Shared,
    keep: Keeper<'b, 'a, S>,
}

impl<S: Simd> WithSimd for Chain<'_, '_, S> {
    type Output = Outcome<S>;

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) -> Outcome<S> {
        chain(self.begin, self.shared, self.keep)
    }
}

#[inline(always)]
fn chain<'a, S: Simd>(
    begin: &mut ChainStart<'a, S>,
    shared: &Shared,
    mut keep: Keeper<'_, 'a, S>,
) -> Outcome<S> {
    let ChainStart { robots, offsets: set_points, multipliers, payload, free } = begin;
    let zero = robots.weight.all(0.0);
    let mut spans = Vec::with_capacity(robots.cables.len());
    for (cable, choice) in robots.cables.iter_mut().zip(&shared.choices) {
        let span = cable.span(&robots.position);
        cable.take(&choice.shape.all(zero), &span);
        spans.push(span);
    }
    let freedoms = robots.freedoms;
    let weight = PlatformLoad::weight(robots.weight).wrench(&robots.center);
    let Distributed { converged, sound, demanded } = match free.is_empty() {
        true => {
            let keep = keep.as_mut().map(|keep| &mut **keep as _);
            let (external, spans, offsets) = (&weight, &*spans, &mut **set_points);
            zero.apart(Distribute { robots, external, multipliers, offsets, spans, shared, keep })
        }
        false => {
            let (converged, sound) = rest(robots, free, set_points, &mut spans, shared);
            Distributed { converged, sound, demanded: vec![converged & !converged; spans.len()] }
        }
    };
    let mut platform = LinearizedPlatform::new(zero, spans.len());
    let held = zero.apart(Wind {
        robots,
        platform: &mut platform,
        set_points,
        spans: &spans,
        demanded: &demanded,
        shared,
    });
    if let Some(keep) = &mut keep {
        keep.state(robots);
    }

    let own = PlatformLoad::weight(robots.weight);
    robots.assemble(&own, &mut platform, zero.less_or_equal(zero));
    let (standing, unloaded) = robots.settle(&own, &mut platform, &shared.scale, converged & sound & held);
    let (stood, stiffness) = (robots.position, platform.factored);
    if let Some(keep) = &mut keep {
        keep.state(robots);
    }

    let load = payload.on(own.weight);
    // The first step follows the linearisation at hand.
    let added = hold(freedoms, payload.wrench(&robots.center));
    platform.gradient = six!(|k| platform.gradient[k] - added[k]);
    let (answered, loaded) = robots.settle(&load, &mut platform, &shared.scale, standing);
    let answered = robots.on_branch(&load, &platform, &stiffness, &shared.scale, answered);
    if let Some(keep) = &mut keep {
        keep.state(robots);
    }
    // Eq. (4)
    let displacement = three!(|k| robots.position[k] - stood[k]);
    Outcome { passed: [converged, sound, held, standing, answered], displacement, unloaded, loaded }
}

/// The tensions nearest to their reference at the wanted pose under the wrench `external`, equations (L2) and
/// (L3); `offsets` are added to them and become set-points, towards which cables make a first step.
/// All callers share one function for each vector unit.
pub(crate) struct Distribute<'b, 'a, S: Simd> {
    pub(crate) robots: &'b mut Robots<'a, S>,
    pub(crate) external: &'b Lanes6<S>,
    pub(crate) multipliers: &'b mut Lanes6<S>,
    pub(crate) offsets: &'b mut [Lanes<S>],
    pub(crate) spans: &'b [Span<Lanes<S>>],
    pub(crate) shared: &'b Shared,
    pub(crate) keep: Keeper<'b, 'a, S>,
}

impl<S: Simd> WithSimd for Distribute<'_, '_, S> {
    type Output = Distributed<S>;

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) -> Distributed<S> {
        distribute(self)
    }
}

#[inline(always)]
fn distribute<S: Simd>(task: Distribute<'_, '_, S>) -> Distributed<S> {
    let Distribute { robots, external, multipliers, offsets, spans, shared, mut keep } = task;
    let (zero, freedoms) = (robots.weight.all(0.0), robots.freedoms);
    let compared = [shared.tension, shared.scale.size];
    let last_change = zero.all(LAST_DISTRIBUTION);
    let unbalanced = NEARLY_ROUNDING * shared.forces;
    let arm = shared.scale.characteristic_length;
    let mut going = zero.less_or_equal(zero);
    let mut within = going;
    let mut jumped = !going;
    let mut before = zero.all(1.0);
    let mut all_held = Vec::with_capacity(spans.len());
    let mut convex = Vec::with_capacity(spans.len());
    let mut rows = Vec::with_capacity(spans.len());
    let mut limits = Vec::with_capacity(spans.len());
    for ((cable, span), choice) in robots.cables.iter_mut().zip(spans).zip(&shared.choices) {
        limits.push(limits_at(cable, span, (choice.limits, choice.max_at), compared));
    }
    let mut demanded = vec![jumped; spans.len()];
    let (mut asked, mut left) = (!shared.may_be_slack, MAX_DISTRIBUTIONS);
    while left > 0 {
        all_held.clear();
        convex.clear();
        rows.clear();
        let mut balance = *external;
        let cables = spans.iter().zip(&robots.cables).zip(&shared.choices);
        for ((span, cable), choice) in cables {
            let held = HeldCable::new(cable, span);
            let [fx, fz] = cable.force;
            let closed = [fx, fz + held.closing[0]];
            let pull = wrench(&cable.anchor_arm, &span.plane.force_on_platform(closed));
            for k in 0..6 {
                balance[k] += pull[k];
            }
            let along = span.plane.force_on_platform([zero.all(1.0), held.rise]);
            // w''·λ of a vertical force.
            let [sx, sy, _] = cable.anchor_arm;
            let lifted = multipliers[2] + sy * multipliers[3] - sx * multipliers[4];
            let square = held.tension_slope * held.tension_slope;
            let curvature = square + (held.tension + -choice.reference) * held.curvatures[0]
                - lifted * held.curvatures[1];
            convex.push((square * LEAST_CURVATURE).less_or_equal(curvature));
            let curvature = curvature.abs().max(square * LEAST_CURVATURE);
            rows.push(Row::new(
                wrench(&cable.anchor_arm, &along),
                (held.closed + -choice.reference) * held.tension_slope,
                curvature.recip(),
                multipliers,
            ));
            all_held.push(held);
        }
        if !freedoms.are_all() {
            balance = hold(freedoms, balance);
            for row in &mut rows {
                row.slope = hold(freedoms, row.slope);
            }
        }
        if !asked {
            asked = true;
            let mut slack = jumped;
            for (cable, held) in robots.cables.iter().zip(&all_held) {
                slack = slack | may_be_slack(cable, held);
            }
            if slack.any() {
                let cables = robots.cables.iter_mut().zip(spans).zip(&all_held);
                for (((cable, span), held), (limits, demanded)) in
                    cables.zip(limits.iter_mut().zip(&mut demanded))
                {
                    *demanded = demand(cable, span, held, limits, compared);
                }
                continue;
            }
        }
        left -= 1;
        let (mut step, _) = newton(&rows, &balance);
        let mut outside = zero.less_or_equal(zero);
        outside = outside & !outside;
        for ((row, held), [least, greatest]) in rows.iter_mut().zip(&all_held).zip(&limits) {
            row.raise(&step);
            let tension = held.closed + held.tension_slope * (row.wanted - row.change);
            outside = outside | !(least.less_or_equal(tension) & tension.less_or_equal(*greatest));
        }
        // Limits change nothing in the other lanes.
        let mut settled = !outside;
        let bounded = going & outside;
        if bounded.any() {
            for ((row, held), [least, greatest]) in rows.iter_mut().zip(&all_held).zip(&limits) {
                row.ways = [held.way_to(*least), held.way_to(*greatest)];
            }
            let (raised, solved) = within_limits(&mut rows, &balance, bounded);
            replace(&mut step, &raised, bounded);
            settled = settled | solved;
        }
        let mut moved = zero;
        let cables = spans.iter().zip(&mut robots.cables);
        for ((row, held), (span, cable)) in rows.iter_mut().zip(&all_held).zip(cables) {
            row.sides = [bounded & row.sides[0], bounded & row.sides[1]];
            let d = row.taken(bounded);
            let near = d.abs().less_or_equal(cable.force[0] * LONGEST_STEP);
            let far = going & !near & !held.slackness.less_or_equal(d.all(SAGGING));
            jumped = jumped | far;
            let end = far.any().then(|| cable.held_end(span));
            moved = moved.max(held.change(cable, d, going, compared));
            if let Some(end) = end {
                cable.hang(end, far);
            }
        }
        replace(multipliers, &six!(|k| multipliers[k] + step[k]), going);
        let small = moved.less_or_equal(last_change) & (moved * moved).less_or_equal(before * LAST_REMAINDER);
        // A part of the sum of tensions is a greater one of a cable's own.
        let mut ends = going & moved.less_or_equal(zero.all(LAST_SHARE.sqrt()));
        if ends.any() {
            for ((row, held), cable) in rows.iter().zip(&all_held).zip(&robots.cables) {
                let d = row.taken(bounded);
                ends = ends & held.is_last(cable, d, LAST_SHARE);
            }
        }
        let mut last = settled & (ends | (going & small));
        if last.any() {
            for row in &rows {
                let d = row.taken(bounded);
                balance = six!(|k| balance[k] + row.slope[k] * d);
            }
            let (force, moment) = halves(&balance);
            last = last
                & dot(&force, &force).less_or_equal(zero.all(unbalanced * unbalanced))
                & dot(&moment, &moment).less_or_equal(zero.all(unbalanced * arm * unbalanced * arm));
        }
        before = moved;
        if last.any() {
            // Elsewhere a stationary point may be no minimum: the scalar models decide.
            for (row, convex) in rows.iter().zip(&convex) {
                within = within & (*convex | row.sides[0] | row.sides[1] | !last);
            }
            // Long steps may have led to another minimum than the one that the scalar models find.
            let doubted = last & jumped;
            if doubted.any() {
                let places = spans.iter().zip(&shared.choices).zip(&limits);
                for (cable, ((span, choice), limits)) in robots.cables.iter().zip(places) {
                    let least = is_least(cable, span, multipliers, choice.reference, limits);
                    within = within & (least | !doubted);
                }
            }
            if let Some(keep) = &mut keep {
                let cables = robots.cables.iter().zip(&limits).zip(&rows).enumerate();
                for (i, ((cable, limits), row)) in cables {
                    keep.chosen(i, cable, limits, row.sides, last);
                }
            }
            let cables = rows.iter().zip(&all_held).zip(&mut robots.cables).zip(&mut *offsets);
            for ((((row, held), cable), offset), (limits, demanded)) in
                cables.zip(limits.iter().zip(&demanded))
            {
                let [least, greatest] = *limits;
                let tension = dot(&cable.force, &cable.force).sqrt();
                let chosen = row.sides[0].select(least, row.sides[1].select(greatest, tension));
                let set_point = (chosen + *offset).max(least);
                let set_point = set_point.less_or_equal(greatest).select(set_point, greatest);
                let sound = zero.less_or_equal(cable.force[0])
                    & held.slackness.less_or_equal(zero.all(FOLDED))
                    & held.is_taut(cable, *demanded)
                    & least.less_or_equal(greatest);
                within = within & (sound | !last);
                offset.replace(set_point, last);
                let there = HeldCable { closed: tension, closing: [zero; 2], ..*held };
                there.change(cable, there.way_to(set_point), last, compared);
            }
        }
        going = going & !last;
        if !going.any() {
            break;
        }
    }
    if let Some(keep) = &mut keep {
        keep.limits(&limits);
        keep.multipliers(multipliers);
    }
    Distributed { converged: !going, sound: within, demanded }
}

/// The tensions of the inverse model.
pub(crate) struct Distributed<S: Simd> {
    /// The lanes where they were found.
    pub(crate) converged: Mask<S>,
    /// Those where no cable is folded and no limits exclude each other.
    pub(crate) sound: Mask<S>,
    /// For each cable those where the least tension of its span was asked for.
    pub(crate) demanded: Vec<Mask<S>>,
}

/// Lengths that give the tensions `set_points` at the wanted pose, and the cables linearised there. Returns
/// the lanes where all were found. All callers share one function for each vector unit.
pub(crate) struct Wind<'b, 'a, S: Simd> {
    pub(crate) robots: &'b mut Robots<'a, S>,
    pub(crate) platform: &'b mut LinearizedPlatform<S>,
    pub(crate) set_points: &'b [Lanes<S>],
    pub(crate) spans: &'b [Span<Lanes<S>>],
    pub(crate) demanded: &'b [Mask<S>],
    pub(crate) shared: &'b Shared,
}

impl<S: Simd> WithSimd for Wind<'_, '_, S> {
    type Output = Mask<S>;

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) -> Mask<S> {
        wind(self)
    }
}

#[inline(always)]
fn wind<S: Simd>(task: Wind<'_, '_, S>) -> Mask<S> {
    let Wind { robots, platform, set_points, spans, demanded, shared } = task;
    let zero = robots.weight.all(0.0);
    let compared = [shared.tension, shared.scale.size];
    let mut all = zero.less_or_equal(zero);
    platform.follow_guides(robots);
    let cables = robots.cables.iter_mut().zip(&mut platform.cables);
    for (i, ((span, set_point), (cable, linearized))) in spans.iter().zip(set_points).zip(cables).enumerate()
    {
        let (mut going, mut taut) = (all, all);
        for _ in 0..MAX_ITERATIONS {
            let held = match &cable.guided {
                None => {
                    let response = cable.response();
                    linearized.replace(&LinearizedCable::new(span, cable.force, &response), going);
                    HeldCable::plain(cable, span, &response)
                }
                Some(guided) => HeldCable::leaving(guided, cable, span),
            };
            let folds = zero.all(FOLDED).less_or_equal(held.slackness);
            taut = (!going & taut) | (going & held.is_taut(cable, demanded[i]) & !folds);
            let fx = cable.force[0];
            let inverse = (fx * held.tension_slope).recip();
            let d = (*set_point - held.closed) * fx * inverse;
            // What a step leaves grows with its curvature over its slope.
            let own = d.abs() + held.closing[0].abs() * held.flatness * held.tension_slope;
            let own = own * inverse * (LAST_CHANGE / LAST_OWN_CHANGE);
            let moved = held.change(cable, d, going, compared).max(own);
            going = going & !moved.less_or_equal(zero.all(LAST_CHANGE));
            if !going.any() {
                break;
            }
        }
        cable.keep_length();
        if let Some(guided) = &cable.guided {
            let everywhere = zero.less_or_equal(zero);
            guided.linearise(cable, span, linearized, &mut platform.free[i], everywhere);
        }
        // The last change closes the cable to rounding.
        linearized.predicted = cable.force;
        // A root with a cable of negative length is invalid.
        all = all & !going & taut & zero.less_or_equal(cable.length) & zero.less_or_equal(cable.force[0]);
        let [fx, fz] = cable.force;
        all = all & !cable.may_be_overstrained((fx * fx + fz * fz).sqrt());
    }
    all
}
