//! Derivatives through the tensions of the inverse model, equation (L11).

use crate::equations::{Span, between};
use crate::lanes::adjoint::cable::{TensionSlopes, torque};
use crate::lanes::adjoint::{Adjoint, Record, add};
use crate::lanes::chain::shared::Shared;
use crate::lanes::chain::tensions::CableTension;
use crate::local::cable::LaneCable;
use crate::local::freedoms::{constrain, constrain_matrix};
use crate::local::platform::Robots;
use cdpr_number::dense::{Lanes3, Lanes6, Lanes6x6, SymmetricFactors, halves};
use cdpr_number::lanes::{Lanes, Mask, Simd};
use cdpr_number::vector::{cross, dot, wrench};
use cdpr_number::{Number, six, three};
use cdpr_robot::CableEnd;

/// Two tensions that differ by a smaller share may be the same.
const SAME: f64 = 1e-9;

/// A multiplier of a bound below this share of the greatest tension may be rounding, as in `derivatives`.
const NO_MULTIPLIER: f64 = 1e-7;

/// A pivot below this share of its diagonal element is nearly lost in rounding.
const NEARLY_SINGULAR: f64 = 1e-8;

/// A cable in the optimum of the tensions.
struct Chosen<'a, S: Simd> {
    cable: LaneCable<'a, S>,
    span: Span<Lanes<S>>,
    slopes: TensionSlopes<S>,
    /// λ_p + λ_r x s.
    motion: Lanes3<S>,
    /// -c_i.
    column: Lanes6<S>,
    /// 1/h; zero of a cable at a limit.
    curvature_inv: Lanes<S>,
    /// The slope of the output by its tension, and by its greatest one.
    by_tension: Lanes<S>,
    by_bound: Lanes<S>,
    /// The lanes where it is at its greatest tension.
    high: Mask<S>,
}

impl<S: Simd> Adjoint<S> {
    /// Adds the slopes of `sum a_i d(set-point_i)`, equation (L11); `placed` are the robots at the wanted
    /// pose.
    #[inline(always)]
    pub(super) fn of_tensions(
        &mut self,
        record: &Record<'_, S>,
        placed: &Robots<'_, S>,
        per_set_point: &[Lanes<S>],
        shared: &Shared,
    ) {
        let zero = placed.weight.all(0.0);
        let mut largest = zero;
        for CableTension { force, .. } in &record.trace.tensions {
            largest = largest.max(dot(force, force).sqrt());
        }
        let mut cables = Vec::with_capacity(per_set_point.len());
        for (i, a) in per_set_point.iter().enumerate() {
            cables.push(self.chosen(record, placed, (i, *a), shared, largest * NO_MULTIPLIER));
        }
        let (matrix, right) = normal_equations(placed, &cables);
        let factored = SymmetricFactors::new(matrix);
        // Free cables that do not span all wrenches make this matrix singular.
        let diagonal = six!(|k| matrix[k][k]);
        self.decided = self.decided & factored.is_regular(&diagonal, NEARLY_SINGULAR);
        let balanced = factored.solve(&right);
        let (_, rotation) = halves(&record.multipliers);
        for (i, chosen) in cables.iter().enumerate() {
            self.add_chosen(i, chosen, (placed, &rotation), &balanced, shared);
        }
        self.add_weight(placed, placed.weight, &six!(|k| -balanced[k]));
    }

    /// Cable `i` in the optimum, whose set-point has the slope `a`. A multiplier below `least` may be zero.
    #[inline(always)]
    fn chosen<'a>(
        &mut self,
        record: &Record<'_, S>,
        placed: &Robots<'a, S>,
        (i, a): (usize, Lanes<S>),
        shared: &Shared,
        least: Lanes<S>,
    ) -> Chosen<'a, S> {
        let CableTension { length, force, limits, at_limits, .. } = record.trace.tensions[i];
        let (choice, zero) = (&shared.choices[i], a.all(0.0));
        let cable = LaneCable { length, force, ..placed.cables[i].clone() };
        let span = cable.span(&placed.position);
        let slopes = TensionSlopes::of(&cable, &span);
        let (translation, rotation) = halves(&record.multipliers);
        let swung = cross(&rotation, &cable.anchor_arm);
        let motion = three!(|k| translation[k] + swung[k]);
        let tension = dot(&force, &force).sqrt();
        // ρ_i, without the bound's multiplier
        let slope = tension + -choice.reference - dot(&slopes.force_per_tension, &motion);
        let [low, high] = at_limits;
        let on_bound = low | high;
        let kept = !slope.abs().less_or_equal(least);
        let set_point = SetPoint::new(tension, record.offsets[i], limits, at_limits);
        // A least tension that the span demands moves with it: the scalar models have its derivatives.
        let demanded = !limits[0].less_or_equal(zero.all(choice.limits.min));
        let free = !demanded | (set_point.follows & !low);
        self.decided = self.decided & set_point.decided & (kept | !on_bound) & free;
        if let (CableEnd::Exit, Some(guided)) = (choice.max_at, &cable.guided) {
            // The scalar models have no derivatives of the limit at a leave point that moves.
            self.decided = self.decided & (!(set_point.over | high) | guided.fixed());
        }
        self.cables[i].offset += set_point.offset.select(a, zero);
        let column = constrain(placed.freedoms, wrench(&cable.anchor_arm, &slopes.force_per_tension));
        let curvature = -dot(&slopes.curvature, &motion) + 1.0;
        Chosen {
            span,
            motion,
            column,
            curvature_inv: on_bound.select(zero, curvature.recip()),
            by_tension: set_point.follows.select(a, zero),
            by_bound: set_point.over.select(a, zero),
            high,
            slopes,
            cable,
        }
    }

    /// Adds the slopes of cable `i` with the motion η = `balanced` and the rotation of the multipliers.
    #[inline(always)]
    fn add_chosen(
        &mut self,
        i: usize,
        chosen: &Chosen<'_, S>,
        (placed, rotation): (&Robots<'_, S>, &Lanes3<S>),
        balanced: &Lanes6<S>,
        shared: &Shared,
    ) {
        let Chosen { cable, span, slopes, motion, column, curvature_inv, by_tension, by_bound, high } =
            chosen;
        let (moved, turned) = halves(balanced);
        let swung = cross(&turned, &cable.anchor_arm);
        let twisted = three!(|k| moved[k] + swung[k]);
        // a_i - c_i·η
        let left = *by_tension + dot(column, balanced);
        let share = left * *curvature_inv;
        let by_bound = *by_bound + high.select(left, left.all(0.0));
        let mut own = slopes.slopes(&twisted, motion, share);
        own.add_bound(cable, &span.end[1], &shared.choices[i], by_bound);
        let force = span.plane.lift(cable.force);
        let r = between(&placed.position, &cable.anchor_arm, &cable.exit_point);
        add(&mut self.turn, &torque(&force, &twisted, &r, &own.span));
        let shared_motion = three!(|k| motion[k] * share);
        add(&mut self.turn, &cross(&slopes.force_per_tension, &shared_motion));
        // η_r·(ds x f) and α f_t·(λ_r x ds)
        let (swings, follows) = (cross(&force, &turned), cross(&slopes.force_per_tension, rotation));
        let arm = three!(|k| swings[k] + follows[k] * share);
        let anchor = three!(|k| own.span[k] + arm[k]);
        self.cables[i].add(&own, &placed.frame, &anchor);
    }
}

/// The upper triangle of `sum c_i c_iᵀ/h_i`, and `-sum c_i a_i/h_i`.
#[inline(always)]
fn normal_equations<S: Simd>(placed: &Robots<'_, S>, cables: &[Chosen<'_, S>]) -> (Lanes6x6<S>, Lanes6<S>) {
    let zero = placed.weight.all(0.0);
    let (mut matrix, mut right) = ([[zero; 6]; 6], [zero; 6]);
    for Chosen { column, curvature_inv, by_tension, .. } in cables {
        for row in 0..6 {
            let share = column[row] * *curvature_inv;
            right[row] -= share * *by_tension;
            for other in row..6 {
                matrix[row][other] += share * column[other];
            }
        }
    }
    constrain_matrix(placed.freedoms, &mut matrix, zero + 1.0);
    (matrix, right)
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
