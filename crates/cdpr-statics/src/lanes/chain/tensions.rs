//! The tensions of the inverse model, one robot in each lane: nearest to their reference, within their
//! limits, in balance at the wanted pose.
//!
//! The shape of a cable is not solved for but takes part in the iteration. The unknown of a cable is its
//! horizontal force fx, which at fixed ends is proportional to its chord force: all derivatives are finite,
//! also at the least tension. With C the flexibility, `e = d(x, z)/dL` and c the misclosure at force and
//! length,
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
//! Where steps pass limits of the tensions, `cdpr_tension::box_problem` finds those within them.
//!
//! For a parabola fz is linear in fx and w'' zero; what sag adds is that of the inextensible catenary
//! ([`FixedEnds::curvature`]). A cable that begins near the least tension of its span has it for a limit, as
//! in the scalar models; one that comes near it on the way is left to them.
//!
//! A lane stops by its own steps alone: the other lanes of a batch change none of its digits.

use crate::equations::Span;
use crate::inverse::NEARLY_ROUNDING;
use crate::lanes::chain::limits::{demand, limits_at, may_be_slack};
use crate::lanes::chain::minimum::is_least;
use crate::lanes::chain::shared::{LAST_DISTRIBUTION, LAST_REMAINDER, LAST_SHARE, MAX_DISTRIBUTIONS, Shared};
use crate::lanes::fixed_ends::FixedEnds;
use crate::local::cable::{FOLDED, LaneCable};
use crate::local::freedoms::constrain;
use crate::local::platform::Robots;
use cdpr_number::Number;
use cdpr_number::dense::{Lanes2, Lanes6, halves, replace};
use cdpr_number::lanes::{Lanes, Mask, Simd, WithSimd};
use cdpr_number::six;
use cdpr_number::vector::{dot, wrench};
use cdpr_tension::box_problem::{BoundedUnknown, solve_within_bounds, unbounded_step};

/// Step of a cable that sags, relative to its horizontal force, from which on the point that it leads to is
/// compared with others. Without the comparison 14 of 15 040 rows of random robots in `tests/any_lanes.rs`
/// have another minimum than the scalar models find near the nominal robot (27 000 cases), with it one of
/// 14 850, which is the least of all.
const LONGEST_STEP: f64 = 0.3;

/// q² from which a cable sags.
pub(crate) const SAGGING: f64 = 0.02;

/// Iterations for the bounds that are active in a step.
const MAX_ITERATIONS: usize = 16;

/// Least curvature of a step, relative to that of a straight cable.
const LEAST_CURVATURE: f64 = 0.01;

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
}

/// The tensions of the inverse model.
pub(crate) struct Distributed<S: Simd> {
    /// The lanes where they were found.
    pub(crate) converged: Mask<S>,
    /// Those where no cable is folded and no limits exclude each other.
    pub(crate) sound: Mask<S>,
    pub(crate) cables: Vec<CableTension<S>>,
}

/// A cable with the tension of the inverse model.
#[derive(Clone, Copy)]
pub(crate) struct CableTension<S: Simd> {
    /// Its unstrained length, beyond the leave point of a pulley [m].
    pub(crate) length: Lanes<S>,
    /// Force at A [N].
    pub(crate) force: Lanes2<S>,
    /// Least and greatest tension allowed [N].
    pub(crate) limits: Lanes2<S>,
    /// The lanes where its tension is at either limit.
    pub(crate) at_limits: [Mask<S>; 2],
    /// Those where the least tension of its span is known, and is one of the limits.
    pub(crate) demanded: Mask<S>,
}

impl<S: Simd> CableTension<S> {
    /// A cable as it is, at none of its limits.
    #[inline(always)]
    pub(crate) fn within(cable: &LaneCable<'_, S>, limits: Lanes2<S>) -> Self {
        let zero = cable.length.all(0.0);
        let never = !zero.less_or_equal(zero);
        let LaneCable { length, force, .. } = *cable;
        Self { length, force, limits, at_limits: [never; 2], demanded: never }
    }

    /// Assigns the state of a cable in the lanes `last`.
    #[inline(always)]
    fn keep(&mut self, cable: &LaneCable<'_, S>, at_limits: [Mask<S>; 2], last: Mask<S>) {
        self.length.replace(cable.length, last);
        replace(&mut self.force, &cable.force, last);
        let ([low, high], [was_low, was_high]) = (at_limits, self.at_limits);
        self.at_limits = [(last & low) | (!last & was_low), (last & high) | (!last & was_high)];
    }
}

impl<S: Simd> WithSimd for Distribute<'_, '_, S> {
    type Output = Distributed<S>;

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) -> Distributed<S> {
        let mut search = Search::new(self);
        let (mut asked, mut left) = (!search.task.shared.may_be_slack, MAX_DISTRIBUTIONS);
        while left > 0 {
            let balance = search.linearize();
            if !asked {
                asked = true;
                if search.demand_least_tensions() {
                    continue;
                }
            }
            left -= 1;
            let step = search.step(&balance);
            let moved = search.advance(&step);
            let last = search.last(&step, balance, moved);
            search.before = moved;
            if last.any() {
                search.conclude(last);
            }
            search.active = search.active & !last;
            if !search.active.any() {
                break;
            }
        }
        Distributed { converged: !search.active, sound: search.sound, cables: search.cables }
    }
}

/// The search for the tensions.
struct Search<'b, 'a, S: Simd> {
    task: Distribute<'b, 'a, S>,
    cables: Vec<CableTension<S>>,
    /// The cables where they are, and their rows of (L3).
    fixed: Vec<FixedEnds<S>>,
    rows: Vec<BoundedUnknown<S>>,
    /// For each cable the lanes where its curvature is positive.
    convex: Vec<Mask<S>>,
    active: Mask<S>,
    sound: Mask<S>,
    /// The lanes that have made a long step.
    jumped: Mask<S>,
    /// The greatest change of the step before.
    before: Lanes<S>,
}

/// A step of the search.
struct Step<S: Simd> {
    multipliers: Lanes6<S>,
    /// The lanes in which it meets limits.
    bounded: Mask<S>,
    /// Those in which it is within them.
    settled: Mask<S>,
}

impl<'b, 'a, S: Simd> Search<'b, 'a, S> {
    #[inline(always)]
    fn new(mut task: Distribute<'b, 'a, S>) -> Self {
        let zero = task.robots.weight.all(0.0);
        let (active, count) = (zero.less_or_equal(zero), task.spans.len());
        let mut cables = Vec::with_capacity(count);
        let Distribute { robots, spans, shared, .. } = &mut task;
        let compared = [shared.tension, shared.scale.size];
        for ((cable, span), choice) in robots.cables.iter_mut().zip(*spans).zip(&shared.choices) {
            let limits = limits_at(cable, span, (choice.limits, choice.max_at), compared);
            cables.push(CableTension::within(cable, limits));
        }
        Self {
            task,
            cables,
            fixed: Vec::with_capacity(count),
            rows: Vec::with_capacity(count),
            convex: Vec::with_capacity(count),
            active,
            sound: active,
            jumped: !active,
            before: zero.all(1.0),
        }
    }

    /// Tension and length that changes are compared with.
    #[inline(always)]
    fn compared(&self) -> [f64; 2] {
        [self.task.shared.tension, self.task.shared.scale.size]
    }

    /// Linearizes the cables about their forces. Returns the balance R2 of the closing forces.
    #[inline(always)]
    fn linearize(&mut self) -> Lanes6<S> {
        let Distribute { robots, external, multipliers, spans, shared, .. } = &self.task;
        let freedoms = robots.freedoms;
        self.fixed.clear();
        self.rows.clear();
        self.convex.clear();
        let mut balance = **external;
        let cables = spans.iter().zip(&robots.cables).zip(&shared.choices);
        for ((span, cable), choice) in cables {
            let fixed = FixedEnds::new(cable, span);
            let pull = wrench(&cable.anchor_arm, &fixed.pull(cable, span));
            for k in 0..6 {
                balance[k] += pull[k];
            }
            let along = fixed.pull_slope(cable, span);
            // w''·λ of a vertical force.
            let [sx, sy, _] = cable.anchor_arm;
            let lifted = multipliers[2] + sy * multipliers[3] - sx * multipliers[4];
            let square = fixed.tension_slope * fixed.tension_slope;
            let curvature = square + (fixed.tension + -choice.reference) * fixed.curvatures[0]
                - lifted * fixed.curvatures[1];
            self.convex.push((square * LEAST_CURVATURE).less_or_equal(curvature));
            let curvature = curvature.abs().max(square * LEAST_CURVATURE);
            self.rows.push(BoundedUnknown::new(
                wrench(&cable.anchor_arm, &along),
                (fixed.closed + -choice.reference) * fixed.tension_slope,
                curvature.recip(),
                multipliers,
            ));
            self.fixed.push(fixed);
        }
        if !freedoms.are_all() {
            balance = constrain(freedoms, balance);
            for row in &mut self.rows {
                row.column = constrain(freedoms, row.column);
            }
        }
        balance
    }

    /// Finds the least tensions that spans demand of the cables that come near them. Returns whether there
    /// are any.
    #[inline(always)]
    fn demand_least_tensions(&mut self) -> bool {
        let compared = self.compared();
        let Distribute { robots, spans, .. } = &mut self.task;
        let mut slack = self.jumped;
        for (cable, fixed) in robots.cables.iter().zip(&self.fixed) {
            slack = slack | may_be_slack(cable, fixed);
        }
        if !slack.any() {
            return false;
        }
        let cables = robots.cables.iter_mut().zip(*spans).zip(&self.fixed);
        for (((cable, span), fixed), found) in cables.zip(&mut self.cables) {
            found.demanded = demand(cable, span, fixed, &mut found.limits, compared);
        }
        true
    }

    /// The step of (L3), within the limits.
    #[inline(always)]
    fn step(&mut self, balance: &Lanes6<S>) -> Step<S> {
        let mut multipliers = unbounded_step(&self.rows, balance);
        let mut outside = !self.active & self.active;
        for ((row, fixed), found) in self.rows.iter_mut().zip(&self.fixed).zip(&self.cables) {
            row.prepare(&multipliers);
            let [least, greatest] = found.limits;
            let tension = fixed.closed + fixed.tension_slope * (row.free - row.change);
            outside = outside | !(least.less_or_equal(tension) & tension.less_or_equal(greatest));
        }
        // Limits change nothing in the other lanes.
        let (mut settled, bounded) = (!outside, self.active & outside);
        if bounded.any() {
            for ((row, fixed), found) in self.rows.iter_mut().zip(&self.fixed).zip(&self.cables) {
                row.bounds = found.limits.map(|limit| fixed.way_to(limit));
            }
            let (raised, solved) = solve_within_bounds(&mut self.rows, balance, bounded, MAX_ITERATIONS);
            replace(&mut multipliers, &raised, bounded);
            settled = settled | solved;
        }
        for row in &mut self.rows {
            row.active = [bounded & row.active[0], bounded & row.active[1]];
        }
        Step { multipliers, bounded, settled }
    }

    /// Takes a step. Returns its greatest change, relative to what changes are compared with.
    #[inline(always)]
    fn advance(&mut self, step: &Step<S>) -> Lanes<S> {
        let (compared, active) = (self.compared(), self.active);
        let Distribute { robots, multipliers, spans, .. } = &mut self.task;
        let mut moved = self.before.all(0.0);
        let cables = spans.iter().zip(&mut robots.cables);
        for ((row, fixed), (span, cable)) in self.rows.iter().zip(&self.fixed).zip(cables) {
            let d = row.solution(step.bounded);
            let near = d.abs().less_or_equal(cable.force[0] * LONGEST_STEP);
            let far = active & !near & !fixed.slackness.less_or_equal(d.all(SAGGING));
            self.jumped = self.jumped | far;
            let end = far.any().then(|| cable.free_end(span));
            moved = moved.max(fixed.change(cable, d, active, compared));
            if let Some(end) = end {
                cable.hang(end, far);
            }
        }
        let raised = six!(|k| multipliers[k] + step.multipliers[k]);
        replace(multipliers, &raised, active);
        moved
    }

    /// The lanes in which a step was the last one: it is small, and its forces are in balance.
    #[inline(always)]
    fn last(&self, step: &Step<S>, mut balance: Lanes6<S>, moved: Lanes<S>) -> Mask<S> {
        let Distribute { robots, shared, .. } = &self.task;
        let small = moved.less_or_equal(moved.all(LAST_DISTRIBUTION))
            & (moved * moved).less_or_equal(self.before * LAST_REMAINDER);
        // A part of the sum of tensions is a greater one of a cable's own.
        let mut ends = self.active & moved.less_or_equal(moved.all(LAST_SHARE.sqrt()));
        if ends.any() {
            for ((row, fixed), cable) in self.rows.iter().zip(&self.fixed).zip(&robots.cables) {
                ends = ends & fixed.is_last(cable, row.solution(step.bounded), LAST_SHARE);
            }
        }
        let last = step.settled & (ends | (self.active & small));
        if !last.any() {
            return last;
        }
        for row in &self.rows {
            let d = row.solution(step.bounded);
            balance = six!(|k| balance[k] + row.column[k] * d);
        }
        let (force, moment) = halves(&balance);
        let unbalanced = NEARLY_ROUNDING * shared.forces;
        let arm = shared.scale.characteristic_length;
        last & dot(&force, &force).less_or_equal(moved.all(unbalanced * unbalanced))
            & dot(&moment, &moment).less_or_equal(moved.all(unbalanced * arm * unbalanced * arm))
    }

    /// Keeps the tensions of the lanes that are at their end, judges them, and makes set-points of them.
    #[inline(always)]
    fn conclude(&mut self, last: Mask<S>) {
        self.judge(last);
        let compared = self.compared();
        let Distribute { robots, offsets, .. } = &mut self.task;
        let zero = self.before.all(0.0);
        let cables = self.rows.iter().zip(&self.fixed).zip(&mut robots.cables).zip(&mut **offsets);
        for ((((row, fixed), cable), offset), found) in cables.zip(&mut self.cables) {
            let [least, greatest] = found.limits;
            let [low, high] = row.active;
            found.keep(cable, row.active, last);
            let tension = dot(&cable.force, &cable.force).sqrt();
            let chosen = low.select(least, high.select(greatest, tension));
            let set_point = (chosen + *offset).max(least);
            let set_point = set_point.less_or_equal(greatest).select(set_point, greatest);
            let sound = zero.less_or_equal(cable.force[0])
                & fixed.slackness.less_or_equal(zero.all(FOLDED))
                & fixed.is_taut(cable, found.demanded)
                & least.less_or_equal(greatest);
            self.sound = self.sound & (sound | !last);
            offset.replace(set_point, last);
            let across = [zero, fixed.across[1]];
            let there = FixedEnds { closed: tension, closing: [zero; 2], across, ..*fixed };
            there.change(cable, there.way_to(set_point), last, compared);
        }
    }

    /// Leaves the lanes to the scalar models that may have another minimum than these find.
    #[inline(always)]
    fn judge(&mut self, last: Mask<S>) {
        let Distribute { robots, multipliers, spans, shared, .. } = &self.task;
        // Elsewhere a stationary point may be no minimum.
        for (row, convex) in self.rows.iter().zip(&self.convex) {
            self.sound = self.sound & (*convex | row.active[0] | row.active[1] | !last);
        }
        // Long steps may have led to another minimum.
        let doubted = last & self.jumped;
        if !doubted.any() {
            return;
        }
        let places = spans.iter().zip(&shared.choices).zip(&self.cables);
        for (cable, ((span, choice), found)) in robots.cables.iter().zip(places) {
            let least = is_least(cable, span, multipliers, choice.reference, &found.limits);
            self.sound = self.sound & (least | !doubted);
        }
    }
}
