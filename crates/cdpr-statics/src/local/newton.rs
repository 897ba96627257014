//! The direct model: Newton's method of `direct/newton.rs`, with its cables eliminated.
//!
//! A lane stops by its own steps alone: the other lanes of a batch change none of its digits.

use crate::equations::LinearizedCable;
use crate::local::cable::FOLDED;
use crate::local::freedoms::constrain;
use crate::local::guided::{is_next_to_wheel, whole_end};
use crate::local::load::PlatformLoad;
use crate::local::platform::{LaneResidual, LinearizedPlatform, Robots, Scale, Steps};
use crate::local::skew::{Skew, refine};
use cdpr_cable::kernel::LaneEnd;
use cdpr_number::Number;
use cdpr_number::dense::{Lanes3, Lanes6, add, halves, replace};
use cdpr_number::lanes::{Lanes, Mask, Simd};
use cdpr_number::vector::{cross, dot};
use cdpr_number::{apart, six, three};

/// Iterations at rest, of which cables that become slack need the most.
const MAX_ITERATIONS: usize = 12;

/// Part of its horizontal force by which a cable may change while its stiffness is kept.
const SMALL_CHANGE: f64 = 0.01;

/// Greatest part of its horizontal force that Newton's step may take away from a cable.
const GREATEST_LOSS: f64 = 0.5;

/// A step below this, relative to the longest cable, ends at rest or next to it.
///
/// From there the stiffness is kept, and each further step reduces the residual by as much again.
const SMALL_STEP: f64 = 1e-7;

/// Square of the last step of guided cables, relative to that of a small one: they keep the symmetric part of
/// their stiffness alone, so that a step leaves more than its square.
const LAST_OF_GUIDED: f64 = 1e-6;

/// Length that may be missing beyond a leave point, relative to the longest cable: its effect is known to the
/// first order.
const LAST_MISSING: f64 = 1e-10;

/// Slackness q² from which a cable over a pulley is left to the scalar models.
const FOLDED_ON_WHEEL: f64 = 0.9;

/// Rounding of a sum of forces, relative to that of their magnitudes.
const FORCE_ROUNDING: f64 = 1e-12;

impl<S: Simd> Steps<S> {
    /// Adds a step in the lanes that are `active`.
    #[inline(always)]
    // Loops over arrays by value take the compiler minutes.
    #[allow(clippy::needless_range_loop)]
    fn add(&mut self, step: &Lanes6<S>, characteristic_length: f64, active: Mask<S>) {
        let scaled = six!(|k| if k < 3 { step[k] } else { step[k] * characteristic_length });
        if self.count == 0 {
            *self = Self { count: 1, first: scaled, others: [step[0].all(0.0); 6] };
            return;
        }
        self.count += 1;
        for k in 0..6 {
            self.others[k] += active.select(scaled[k], scaled[k].all(0.0));
        }
    }
}

/// Sums over cables.
struct Sums<S: Simd> {
    /// Of their forces and moments, against their sign: those that they have, and those predicted.
    wrench: Lanes6<S>,
    gradient: Lanes6<S>,
    tensions: Lanes<S>,
}

impl<S: Simd> Sums<S> {
    #[inline(always)]
    fn new(zero: Lanes<S>) -> Self {
        Self { wrench: [zero; 6], gradient: [zero; 6], tensions: zero }
    }
}

impl<S: Simd> Robots<'_, S> {
    /// The residual, and the lanes that are solved: where it is rounding, and all cables are pulled, and
    /// neither folded nor overstrained.
    ///
    /// In the lanes that are `near` the linearization is moved here and keeps its stiffness.
    #[inline(always)]
    fn update(
        &self,
        load: &PlatformLoad<S>,
        scale: &Scale,
        platform: &mut LinearizedPlatform<S>,
        near: Mask<S>,
    ) -> (LaneResidual<S>, Mask<S>) {
        let zero = self.weight.all(0.0);
        let wrench = load.wrench(&self.center);
        let mut all = Sums::new(zero);
        let (mut closure, mut failed) = (zero, zero);
        let stride = self.stride();
        for first in 0..stride {
            let mut sums = Sums::new(zero);
            let mut i = first;
            while i < self.cables.len() {
                let [open, fails] = self.update_cable(i, scale, platform, &mut sums, near);
                (closure, failed) = (closure.max(open), failed.max(fails));
                i += stride;
            }
            for k in 0..6 {
                all.wrench[k] = self.total(first, all.wrench[k], sums.wrench[k]);
                all.gradient[k] = self.total(first, all.gradient[k], sums.gradient[k]);
            }
            all.tensions = self.total(first, all.tensions, sums.tensions);
        }
        let residual = LaneResidual {
            closure: self.largest(closure),
            wrench: constrain(self.freedoms, six!(|k| all.wrench[k] - wrench[k])),
        };
        let gradient = constrain(self.freedoms, six!(|k| all.gradient[k] - wrench[k]));
        replace(&mut platform.gradient, &gradient, near);
        let tensions = all.tensions + load.weight;
        let (force, moment) = halves(&residual.wrench);
        let unbalanced =
            dot(&force, &force).sqrt() + dot(&moment, &moment).sqrt() * (1.0 / scale.characteristic_length);
        let solved = self.largest(failed).less_or_equal(zero)
            & residual.closure.less_or_equal(zero.all(scale.rounding * scale.rounding))
            & unbalanced.less_or_equal(tensions * FORCE_ROUNDING);
        (residual, solved)
    }

    /// The same of one cable: the square of its misclosure [m²], and one where it is not solved, else zero.
    #[inline(always)]
    fn update_cable(
        &self,
        i: usize,
        scale: &Scale,
        platform: &mut LinearizedPlatform<S>,
        sums: &mut Sums<S>,
        near: Mask<S>,
    ) -> [Lanes<S>; 2] {
        let (cable, zero) = (&self.cables[i], self.weight.all(0.0));
        let (mut span, mut across, mut failed) = (cable.span(&self.position), zero, zero);
        let LaneEnd { end, tension, slackness } = match &cable.guided {
            None => cable.end(),
            Some(guided) => {
                let found = whole_end(guided, cable.free(), span);
                (span, across) = (found.span, found.across);
                platform.free[i].update(found.missing, near);
                let most = zero.all(LAST_MISSING * scale.size);
                failed = found.missing.abs().less_or_equal(most).select(zero, zero.all(1.0));
                found.end
            }
        };
        let linearized = &mut platform.cables[i];
        let miss = span.misclosure(end);
        let mut closure = dot(&miss, &miss);
        let predicted = linearized.after(cable.force, miss);
        let mut moved = LinearizedCable { plane: span.plane, predicted, ..*linearized };
        if let Some(swivel) = platform.swivels.get_mut(i) {
            closure += across * across;
            let sideways = swivel.close(&mut moved, miss, across, near);
            add(&mut sums.gradient, &cable.anchor_arm, &three!(|k| self.counted(i, sideways[k])));
        }
        let [fx, fz] = [self.counted(i, cable.force[0]), self.counted(i, cable.force[1])];
        let [x, z] = [self.counted(i, moved.predicted[0]), self.counted(i, moved.predicted[1])];
        add(&mut sums.wrench, &cable.anchor_arm, &moved.plane.lift([fx, fz]));
        add(&mut sums.gradient, &cable.anchor_arm, &moved.plane.lift([x, z]));
        linearized.replace(&moved, near);
        sums.tensions += self.counted(i, tension);
        // A slack cable may hang from either side of its wheel.
        let folded = if cable.guided.is_some() { FOLDED_ON_WHEEL } else { FOLDED };
        let sound = zero.less_or_equal(fx)
            & slackness.less_or_equal(zero.all(folded))
            & !cable.may_be_overstrained(tension);
        [closure, failed.max((!sound).select(zero.all(1.0), zero))]
    }

    /// Moves the platforms and the forces of their cables where `active`. Returns the lanes in which no cable
    /// changed so much that its stiffness is another one, and those in which none became slack next to
    /// its wheel, from either side of which it may hang.
    #[inline(always)]
    fn apply(
        &mut self,
        translation: &Lanes3<S>,
        rotation: &Lanes3<S>,
        square: Lanes<S>,
        platform: &LinearizedPlatform<S>,
        active: Mask<S>,
    ) -> [Mask<S>; 2] {
        let (mut steady, mut clear) = (active, active);
        // sin φ/φ and (1 - cos φ)/φ² to rounding for φ up to 0.1.
        let x = -square;
        let a =
            (((x * (1.0 / 72.0) + 1.0) * x * (1.0 / 42.0) + 1.0) * x * (1.0 / 20.0) + 1.0) * x * (1.0 / 6.0)
                + 1.0;
        let b =
            (((x * (1.0 / 90.0) + 1.0) * x * (1.0 / 56.0) + 1.0) * x * (1.0 / 30.0) + 1.0) * x * (1.0 / 24.0)
                + 0.5;
        for (i, (cable, linearized)) in self.cables.iter_mut().zip(&platform.cables).enumerate() {
            let (swung, arm) = rotate(&cable.anchor_arm, rotation, a, b);
            let r = three!(|k| translation[k] + swung[k]);
            let (mut force, mut swivelled) = (linearized.force_after(r), None);
            if let Some(swivel) = platform.swivels.get(i) {
                let after = swivel.force_after(linearized, r);
                (force, swivelled) = (after.in_plane, Some(after));
            }
            // A cable that becomes slack: the step of 1/fx instead, of which fx remains positive.
            let [fx, fz] = cable.force;
            let lost = fx - force[0];
            let changed = active & !lost.abs().less_or_equal(fx * SMALL_CHANGE);
            if changed.any() {
                steady = steady & !changed;
                let slackening = changed & !lost.less_or_equal(fx * GREATEST_LOSS);
                let share = slackening.select(fx / (fx + lost), fx.all(1.0));
                force = [fx - lost * share, fz + (force[1] - fz) * share];
                if let Some(guided) = &cable.guided {
                    let next_to = is_next_to_wheel(guided, cable.free(), cable.span(&self.position));
                    clear = clear & !(slackening & next_to);
                }
            }
            if let Some(guided) = &mut cable.guided {
                let mut length = cable.length + platform.free[i].change(&cable.force, &force);
                if let Some(after) = swivelled {
                    length += after.free_length;
                    guided.swing(after.across / force[0], active);
                    force[0] = (force[0] * force[0] + after.across * after.across).sqrt();
                }
                cable.length.replace(length, active);
            }
            replace(&mut cable.force, &force, active);
            replace(&mut cable.anchor_arm, &arm, active);
        }
        for vector in self.frame.iter_mut().chain([&mut self.center]) {
            let (_, turned) = rotate(vector, rotation, a, b);
            replace(vector, &turned, active);
        }
        let position = three!(|k| self.position[k] + translation[k]);
        replace(&mut self.position, &position, active);
        [steady, clear]
    }
}

apart! {
    /// Newton's method on the direct model from a linearization, in the lanes `alive`.
    ///
    /// Returns the lanes that found a stable equilibrium, and its residual. The linearization is then one at
    /// this equilibrium, with a stiffness from nearby.
    #[inline(always)]
    on(robots.weight) pub(crate) fn solve<'b, 'a, S: Simd>(
        robots: &'b mut Robots<'a, S>,
        load: &'b PlatformLoad<S>,
        platform: &'b mut LinearizedPlatform<S>,
        scale: &'b Scale,
        alive: Mask<S>,
    ) -> (Mask<S>, LaneResidual<S>) {
        let zero = robots.weight.all(0.0);
        let (farthest, turned_most) = (zero + (0.3 * scale.size).powi(2), zero + 0.1 * 0.1);
        let small_step = zero + (SMALL_STEP * scale.size).powi(2);
        let (mut active, mut found) = (alive, alive & !alive);
        let mut residual = LaneResidual { closure: small_step, wrench: platform.gradient };
        platform.steps.count = 0;
        for _ in 0..MAX_ITERATIONS {
            let gradient = six!(|k| -platform.gradient[k]);
            let mut step = platform.factored.solve(&gradient);
            if load.moment.is_some() {
                // Where this does not converge, the steps do not either.
                let skew = Skew { freedoms: robots.freedoms, moment: load.moment, guided: Vec::new() };
                refine(&skew, &platform.factored, &gradient, &mut step, scale.characteristic_length);
            }
            let (translation, rotation) = halves(&step);
            let turned = dot(&rotation, &rotation);
            let moved = dot(&translation, &translation)
                + turned * (scale.characteristic_length * scale.characteristic_length);
            // The linearization is invalid farther away; a comparison with NaN is false, which ends the lane.
            active = active & moved.less_or_equal(farthest) & turned.less_or_equal(turned_most);
            platform.steps.add(&step, scale.characteristic_length, active);
            let [steady, clear] = robots.apply(&translation, &rotation, turned, platform, active);
            let [steady, clear] = [robots.of_robot(steady), robots.of_robot(clear)];
            active = active & clear;
            let near = active & steady & moved.less_or_equal(small_step);
            if near.any() {
                let (left, solved) = robots.update(load, scale, platform, near);
                let mut done = near & solved & platform.factored.positive;
                if !platform.free.is_empty() {
                    done = done & moved.less_or_equal(small_step * LAST_OF_GUIDED);
                }
                residual = left;
                (found, active) = (found | done, active & !done);
            }
            let far = active & !near;
            if far.any() {
                robots.linearize(load, platform, far);
            } else if !active.any() {
                break;
            }
        }
        (found, residual)
    }
}

/// φ x v, and v + a φ x v + b φ x (φ x v).
#[inline(always)]
pub(crate) fn rotate<S: Simd>(
    v: &Lanes3<S>,
    rotation: &Lanes3<S>,
    a: Lanes<S>,
    b: Lanes<S>,
) -> (Lanes3<S>, Lanes3<S>) {
    let once = cross(rotation, v);
    let twice = cross(rotation, &once);
    (once, three!(|k| v[k] + a * once[k] + b * twice[k]))
}
