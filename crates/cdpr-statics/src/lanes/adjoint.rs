//! Derivatives of a deflection by all parameters of a robot, one robot in each lane, by the adjoint of the
//! equations of `derivatives.rs`.
//!
//! The output is |dp|, which grows by `n·(dp_1 - dp_0)` with n = dp/|dp|. At each equilibrium, with H the
//! stiffness of the platform and `G = sum wrenches + w_ex`,
//!
//! ```text
//! Hᵀ y = ±(n, 0),     ±n·dp = y·( ∂G + sum [k_L; s x k_L] dL )                                   (L10)
//! ```
//!
//! so that one twist y stands for all parameters; it moves anchor point i by `y_p + y_r x s_i`. H is
//! symmetric but under a moment and for cables over guides (`lanes/skew.rs`). What y takes from the lengths,
//! Λ_i, goes over (L9) to the set-points and, with `a_i = Λ_i dL_i/dt_i`, to the inverse model. With c_i and
//! D_i of (D6) and the tensions without active bound free,
//!
//! ```text
//! [ sum_free c_i c_iᵀ/D_i ] η = sum_free c_i a_i/D_i,      α_i = (a_i - c_i·η)/D_i               (L11)
//! sum a_i dt_i = -sum_free α_i ∂ρ_i - η·∂G + sum_active (a_i - c_i·η) b_i
//! ```
//!
//! The number of parameters does not matter: each cable is evaluated once more at each of its four states.

mod answer;
mod cable;

use crate::equations::LinearizedCable;
use crate::lanes::adjoint::answer::Answer;
pub(crate) use crate::lanes::adjoint::cable::GuideSlopes;
use crate::lanes::adjoint::cable::{CableSlopes, TensionSlopes, torque};
use crate::lanes::cable::LaneCable;
use crate::lanes::chain::Keep;
use crate::lanes::chain::shared::Shared;
use crate::lanes::freedoms::{hold, hold_matrix};
use crate::lanes::load::PlatformLoad;
use crate::lanes::newton::{LinearizedPlatform, Robots};
use crate::lanes::skew::{Skew, SkewCable};
use cdpr_number::Number;
use cdpr_number::dense::{Lanes2, Lanes3, Lanes6, SymmetricFactors, halves, replace};
use cdpr_number::lanes::{Lanes, Mask, Simd, WithSimd};
use cdpr_number::vector::{cross, dot, wrench};
use cdpr_number::{six, three};
use cdpr_robot::CableEnd;

/// Two tensions that differ by a smaller share may be the same.
const SAME: f64 = 1e-9;

/// A multiplier of a bound below this share of the greatest tension may be rounding, as in `derivatives`.
const NO_MULTIPLIER: f64 = 1e-7;

/// A pivot below this share of its diagonal element is nearly lost in rounding.
const NEARLY_SINGULAR: f64 = 1e-8;

/// A deflection below this share of the longest cable has no direction, as in `derivatives`.
const NO_DEFLECTION: f64 = 1e-12;

/// What an observation keeps for its adjoint.
pub(crate) struct Record<'a, S: Simd> {
    offsets: Vec<Lanes<S>>,
    optimum: Vec<Chosen<'a, S>>,
    multipliers: Lanes6<S>,
    /// The robots with their cables wound, at rest without and with the load.
    states: Vec<Robots<'a, S>>,
}

/// A cable with the tension of the inverse model.
struct Chosen<'a, S: Simd> {
    cable: LaneCable<'a, S>,
    /// Least and greatest tension [N].
    limits: Lanes2<S>,
    /// Whether its tension is at either limit.
    sides: [Mask<S>; 2],
}

impl<'a, S: Simd> Record<'a, S> {
    #[inline(always)]
    pub(crate) fn new(offsets: Vec<Lanes<S>>, multipliers: Lanes6<S>) -> Self {
        Self { offsets, optimum: Vec::new(), multipliers, states: Vec::with_capacity(3) }
    }
}

impl<'a, S: Simd> Keep<'a, S> for Record<'a, S> {
    #[inline(always)]
    fn chosen(
        &mut self,
        i: usize,
        cable: &LaneCable<'a, S>,
        limits: &Lanes2<S>,
        sides: [Mask<S>; 2],
        last: Mask<S>,
    ) {
        let Some(before) = self.optimum.get_mut(i) else {
            return self.optimum.push(Chosen { cable: cable.clone(), limits: *limits, sides });
        };
        let old = &mut before.cable;
        old.length.replace(cable.length, last);
        replace(&mut old.force, &cable.force, last);
        for (old, new) in before.sides.iter_mut().zip(sides) {
            *old = (last & new) | (!last & *old);
        }
    }

    #[inline(always)]
    fn multipliers(&mut self, multipliers: &Lanes6<S>) {
        self.multipliers = *multipliers;
    }

    #[inline(always)]
    fn state(&mut self, robots: &Robots<'a, S>) {
        self.states.push(robots.clone());
    }
}

/// Derivatives of |dp| in the level frame, one robot in each lane.
pub(crate) struct Adjoint<S: Simd> {
    pub(crate) cables: Vec<CableAdjoint<S>>,
    /// By the weight of the platform [m/N].
    pub(crate) weight: Lanes<S>,
    /// By the centre of mass in the platform frame [m/m].
    pub(crate) center: Lanes3<S>,
    /// By turns of gravity [m/rad].
    pub(crate) turn: Lanes3<S>,
    /// By the components of the weight of platform and payload together, for each newton of it [m].
    pub(crate) heavier: Lanes3<S>,
    /// The lanes in which all of them exist, and left and right derivatives are the same.
    pub(crate) decided: Mask<S>,
}

/// Derivatives by what one cable is.
#[derive(Clone, Copy)]
pub(crate) struct CableAdjoint<S: Simd> {
    /// By its exit point [m/m].
    pub(crate) exit: Lanes3<S>,
    /// By its anchor point in the platform frame [m/m].
    pub(crate) anchor: Lanes3<S>,
    /// By its weight per length [m²/N].
    pub(crate) weight: Lanes<S>,
    /// By its axial flexibility [m N].
    pub(crate) flexibility: Lanes<S>,
    /// By the offset of its tension set-point [m/N].
    pub(crate) offset: Lanes<S>,
    /// By its guide; zero without one.
    pub(crate) guide: GuideSlopes<S>,
}

/// Derivatives of |dp| for the robots of `record`; the frame of each is its rotation matrix, by columns.
#[inline(always)]
pub(crate) fn adjoint<S: Simd>(
    record: &Record<'_, S>,
    displacement: &Lanes3<S>,
    payload: &PlatformLoad<S>,
    shared: &Shared,
) -> Option<Adjoint<S>> {
    payload.weight.apart(OfRecord { record, displacement, payload, shared })
}

/// Observations and maps share one function for each vector unit.
struct OfRecord<'r, 'a, S: Simd> {
    record: &'r Record<'a, S>,
    displacement: &'r Lanes3<S>,
    payload: &'r PlatformLoad<S>,
    shared: &'r Shared,
}

impl<S: Simd> WithSimd for OfRecord<'_, '_, S> {
    type Output = Option<Adjoint<S>>;

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) -> Option<Adjoint<S>> {
        adjoint_of(self.record, self.displacement, self.payload, self.shared)
    }
}

#[inline(always)]
fn adjoint_of<S: Simd>(
    record: &Record<'_, S>,
    displacement: &Lanes3<S>,
    payload: &PlatformLoad<S>,
    shared: &Shared,
) -> Option<Adjoint<S>> {
    let [wound, unloaded, loaded] = record.states.as_slice() else { return None };
    let zero = wound.weight.all(0.0);
    let square = dot(displacement, displacement);
    let least = NO_DEFLECTION * shared.scale.size;
    let rms_inv = square.sqrt().recip();
    let none = CableAdjoint {
        exit: [zero; 3],
        anchor: [zero; 3],
        weight: zero,
        flexibility: zero,
        offset: zero,
        guide: GuideSlopes::none(zero),
    };
    let mut found = Adjoint {
        cables: vec![none; wound.cables.len()],
        weight: zero,
        center: [zero; 3],
        turn: [zero; 3],
        heavier: [zero; 3],
        decided: zero.all(least * least).less_or_equal(square),
    };
    let mut lengths = vec![zero; wound.cables.len()];
    let own = PlatformLoad::weight(unloaded.weight);
    let load = payload.on(unloaded.weight);
    let back = three!(|k| -(displacement[k] * rms_inv));
    let arm = shared.scale.characteristic_length;
    found.at_rest(unloaded, &own, &back, &mut lengths, arm);
    found.at_rest(loaded, &load, &three!(|k| -back[k]), &mut lengths, arm);
    // From here on the slopes by the set-points.
    for ((cable, found_cable), slope) in wound.cables.iter().zip(&mut found.cables).zip(&mut lengths) {
        let span = cable.span(&wound.position);
        let (slopes, per_tension) = Answer::of(cable).of_length(&span.plane, *slope);
        *slope = per_tension;
        found_cable.add(&slopes, &wound.frame, &slopes.span);
        let r = three!(|k| wound.position[k] + cable.anchor_arm[k] - cable.exit_point[k]);
        add(&mut found.turn, &torque(&[zero; 3], &[zero; 3], &r, &slopes.span));
    }
    found.of_tensions(record, wound, &lengths, shared);
    found.turn_axes(wound);
    Some(found)
}

/// What the symmetric part of the transposed stiffness lacks.
#[inline(always)]
fn transposed_skew<S: Simd>(
    robots: &Robots<'_, S>,
    load: &PlatformLoad<S>,
    platform: &LinearizedPlatform<S>,
    answers: &[Answer<Lanes<S>>],
) -> Skew<S> {
    let mut skew = Skew { freedoms: robots.freedoms, moment: None, guided: Vec::new() };
    if let Some([x, y, z]) = load.moment {
        skew.moment = Some([-x, -y, -z]);
    }
    for ((cable, linearized), answer) in robots.cables.iter().zip(&platform.cables).zip(answers) {
        if let Some(stiffness) = answer.skew_stiffness() {
            let (arm, plane) = (cable.anchor_arm, linearized.plane);
            skew.guided.push(SkewCable { arm, plane, stiffness });
        }
    }
    skew
}

impl<S: Simd> CableAdjoint<S> {
    /// Adds the slopes of a state with its frame, in which the anchor point has those in `anchor`.
    #[inline(always)]
    fn add(&mut self, slopes: &CableSlopes<S>, frame: &[Lanes3<S>], anchor: &Lanes3<S>) {
        for k in 0..3 {
            self.exit[k] -= slopes.span[k];
        }
        for (sum, column) in self.anchor.iter_mut().zip(frame) {
            *sum += dot(column, anchor);
        }
        self.weight += slopes.weight;
        self.flexibility += slopes.flexibility;
        if let Some(guide) = &slopes.guide {
            self.guide.add(guide);
        }
    }
}

#[inline(always)]
fn add<S: Simd>(sum: &mut Lanes3<S>, more: &Lanes3<S>) {
    for (sum, more) in sum.iter_mut().zip(more) {
        *sum += *more;
    }
}

impl<S: Simd> Adjoint<S> {
    /// Adds what the weight `weight` at the centre of mass adds to an output that grows by `twist`·dw_ex.
    #[inline(always)]
    fn add_weight(&mut self, robots: &Robots<'_, S>, weight: Lanes<S>, twist: &Lanes6<S>) {
        let (moved, turned) = halves(twist);
        let swung = cross(&turned, &robots.center);
        let lever = three!(|k| moved[k] + swung[k]);
        self.weight -= lever[2];
        for (sum, lever) in self.heavier.iter_mut().zip(lever) {
            *sum += lever * weight;
        }
        let zero = weight.all(0.0);
        let arm = cross(&[zero, zero, -weight], &turned);
        for (sum, column) in self.center.iter_mut().zip(&robots.frame) {
            *sum += dot(column, &arm);
        }
    }

    /// Adds the slopes of `motion`·dp at an equilibrium, equation (L10), and those by the lengths.
    #[inline(always)]
    fn at_rest(
        &mut self,
        robots: &Robots<'_, S>,
        load: &PlatformLoad<S>,
        motion: &Lanes3<S>,
        lengths: &mut [Lanes<S>],
        arm: f64,
    ) {
        let zero = load.weight.all(0.0);
        let all = zero.less_or_equal(zero);
        let mut platform = LinearizedPlatform::new(zero, robots.cables.len());
        let mut answers = Vec::with_capacity(robots.cables.len());
        for (cable, linearized) in robots.cables.iter().zip(&mut platform.cables) {
            let span = cable.span(&robots.position);
            let answer = Answer::of(cable);
            *linearized = LinearizedCable::new(&span, cable.force, &answer.response);
            answers.push(answer);
        }
        robots.assemble(load, &mut platform, all);
        let right = [motion[0], motion[1], motion[2], zero, zero, zero];
        let mut twist = platform.factored.solve(&right);
        let skew = transposed_skew(robots, load, &platform, &answers);
        if skew.moment.is_some() || !skew.guided.is_empty() {
            self.decided = self.decided & skew.refine(&platform.factored, &right, &mut twist, arm);
        }
        let (moved, turned) = halves(&twist);
        let cables = robots.cables.iter().zip(&platform.cables).zip(&answers).zip(&mut self.cables);
        for ((((cable, linearized), answer), found), length) in cables.zip(lengths) {
            let swung = cross(&turned, &cable.anchor_arm);
            let twisted = three!(|k| moved[k] + swung[k]);
            let (slopes, per_length) = answer.at_length(linearized, &twisted);
            *length += per_length;
            let force = linearized.plane.lift(cable.force);
            // -y_r·(ds x f)
            let swings = cross(&turned, &force);
            found.add(&slopes, &robots.frame, &three!(|k| slopes.span[k] + swings[k]));
            let r = three!(|k| robots.position[k] + cable.anchor_arm[k] - cable.exit_point[k]);
            add(&mut self.turn, &torque(&force, &three!(|k| -twisted[k]), &r, &slopes.span));
        }
        self.add_weight(robots, load.weight, &twist);
    }

    /// Adds the slopes of `sum a_i d(set-point_i)`, equation (L11).
    #[inline(always)]
    fn of_tensions(
        &mut self,
        record: &Record<'_, S>,
        wound: &Robots<'_, S>,
        per_set_point: &[Lanes<S>],
        shared: &Shared,
    ) {
        let zero = wound.weight.all(0.0);
        let (translation, rotation) = halves(&record.multipliers);
        let mut cables = Vec::with_capacity(per_set_point.len());
        let mut matrix = [[zero; 6]; 6];
        let mut right = [zero; 6];
        let mut largest = zero;
        for Chosen { cable, .. } in &record.optimum {
            largest = largest.max(dot(&cable.force, &cable.force).sqrt());
        }
        for (i, Chosen { cable, limits, sides }) in record.optimum.iter().enumerate() {
            let choice = &shared.choices[i];
            let span = cable.span(&wound.position);
            let slopes = TensionSlopes::of(cable, &span);
            let swung = cross(&rotation, &cable.anchor_arm);
            let motion = three!(|k| translation[k] + swung[k]);
            let tension = dot(&cable.force, &cable.force).sqrt();
            // ρ_i, without the bound's multiplier
            let slope = tension + -choice.reference - dot(&slopes.force_per_tension, &motion);
            let on_bound = sides[0] | sides[1];
            let kept = !slope.abs().less_or_equal(largest * NO_MULTIPLIER);
            let set_point = SetPoint::new(tension, record.offsets[i], *limits, *sides);
            // A least tension that the span demands moves with it: the scalar models have its derivatives.
            let demanded = !limits[0].less_or_equal(zero.all(choice.limits.min));
            let free = !demanded | (set_point.follows & !sides[0]);
            self.decided = self.decided & set_point.decided & (kept | !on_bound) & free;
            if let (CableEnd::Exit, Some(guided)) = (choice.max_at, &cable.guided) {
                // The scalar models have no derivatives of the limit at a leave point that moves.
                self.decided = self.decided & (!(set_point.over | sides[1]) | guided.fixed());
            }
            let a = per_set_point[i];
            self.cables[i].offset += set_point.offset.select(a, zero);
            let by_tension = set_point.follows.select(a, zero);
            // -c_i
            let column = hold(wound.freedoms, wrench(&cable.anchor_arm, &slopes.force_per_tension));
            let curvature = -dot(&slopes.curvature, &motion) + 1.0;
            let curvature_inv = on_bound.select(zero, curvature.recip());
            for row in 0..6 {
                let share = column[row] * curvature_inv;
                right[row] -= share * by_tension;
                for other in row..6 {
                    matrix[row][other] += share * column[other];
                }
            }
            let by_bound = set_point.over.select(a, zero);
            cables.push((span, slopes, motion, column, curvature_inv, by_tension, by_bound));
        }
        hold_matrix(wound.freedoms, &mut matrix, zero + 1.0);
        let factored = SymmetricFactors::new(matrix);
        // Free cables that do not span all wrenches make this matrix singular.
        let diagonal = six!(|k| matrix[k][k]);
        self.decided = self.decided & factored.is_regular(&diagonal, NEARLY_SINGULAR);
        let balanced = factored.solve(&right);
        let (moved, turned) = halves(&balanced);
        for (i, (span, slopes, motion, column, curvature_inv, by_tension, mut by_bound)) in
            cables.into_iter().enumerate()
        {
            let Chosen { cable, sides, .. } = &record.optimum[i];
            let swung = cross(&turned, &cable.anchor_arm);
            let twisted = three!(|k| moved[k] + swung[k]);
            // a_i - c_i·η
            let left = by_tension + dot(&column, &balanced);
            let share = left * curvature_inv;
            by_bound += sides[1].select(left, zero);
            let mut own = slopes.slopes(&twisted, &motion, share);
            own.add_bound(cable, &span.end[1], &shared.choices[i], by_bound);
            let force = span.plane.lift(cable.force);
            let r = three!(|k| wound.position[k] + cable.anchor_arm[k] - cable.exit_point[k]);
            add(&mut self.turn, &torque(&force, &twisted, &r, &own.span));
            let shared_motion = three!(|k| motion[k] * share);
            add(&mut self.turn, &cross(&slopes.force_per_tension, &shared_motion));
            // η_r·(ds x f) and α f_t·(λ_r x ds)
            let (swings, follows) = (cross(&force, &turned), cross(&slopes.force_per_tension, &rotation));
            let arm = three!(|k| swings[k] + follows[k] * share);
            let anchor = three!(|k| own.span[k] + arm[k]);
            self.cables[i].add(&own, &wound.frame, &anchor);
        }
        self.add_weight(wound, wound.weight, &six!(|k| -balanced[k]));
    }

    /// Adds to the derivatives by turns of gravity that the axes k of pulleys stay: by `-k x`(that by k).
    #[inline(always)]
    fn turn_axes(&mut self, robots: &Robots<'_, S>) {
        for (cable, found) in robots.cables.iter().zip(&self.cables) {
            if let Some(guided) = &cable.guided {
                let [x, y, _] = found.guide.axis;
                let upwards = guided.guide.upwards();
                self.turn[0] += y * upwards;
                self.turn[1] -= x * upwards;
            }
        }
    }
}

/// What a set-point follows.
struct SetPoint<S: Simd> {
    /// The tension of the inverse model.
    follows: Mask<S>,
    /// Its offset, as it falls.
    offset: Mask<S>,
    /// The greatest tension.
    over: Mask<S>,
    /// Whether left and right derivatives are known to be the same, but those by the offset of a cable on its
    /// bound.
    decided: Mask<S>,
}

impl<S: Simd> SetPoint<S> {
    #[inline(always)]
    fn new(tension: Lanes<S>, offset: Lanes<S>, limits: [Lanes<S>; 2], sides: [Mask<S>; 2]) -> Self {
        let wanted = tension + offset;
        let [least, greatest] = limits;
        let at = [same(wanted, least), same(wanted, greatest)];
        let under = !at[0] & wanted.less_or_equal(least);
        let over = !at[1] & greatest.less_or_equal(wanted);
        let [low, high] = sides;
        let resting = [same(tension, least) & !low, same(tension, greatest) & !high];
        Self {
            follows: !(under | over),
            offset: !(under | over | at[0]),
            over,
            decided: !(resting[0] | resting[1] | (at[0] & !low) | (at[1] & !high)),
        }
    }
}

#[inline(always)]
fn same<S: Simd>(one: Lanes<S>, other: Lanes<S>) -> Mask<S> {
    (one - other).abs().less_or_equal(one.max(other) * SAME)
}
