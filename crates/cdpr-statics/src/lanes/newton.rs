//! The direct model: Newton's method of `direct/newton.rs`, with its cables eliminated.
//!
//! A lane stops by its own steps alone: the other lanes of a batch change none of its digits.

use crate::equations::LinearizedCable;
use crate::lanes::cable::FOLDED;
use crate::lanes::freedoms::hold;
use crate::lanes::load::PlatformLoad;
use crate::lanes::platform::{LaneResidual, LinearizedPlatform, Robots, Scale, Steps};
use crate::lanes::skew::Skew;
use cdpr_cable::kernel::LaneEnd;
use cdpr_number::Number;
use cdpr_number::dense::{Lanes3, Lanes6, add, halves, replace};
use cdpr_number::lanes::{Lanes, Mask, Simd, WithSimd};
use cdpr_number::vector::{cross, dot};
use cdpr_number::{six, three};

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
    /// Takes a step of the square `moved` in the lanes that are `going`.
    #[inline(always)]
    fn take(
        &mut self,
        iteration: usize,
        moved: Lanes<S>,
        step: &Lanes6<S>,
        characteristic_length: f64,
        going: Mask<S>,
    ) {
        let zero = moved.all(0.0);
        if iteration == 0 {
            *self = Self { first: moved, others: [zero; 6] };
            return;
        }
        for (k, (sum, part)) in self.others.iter_mut().zip(step).enumerate() {
            let scaled = if k < 3 { *part } else { *part * characteristic_length };
            *sum += going.select(scaled, zero);
        }
    }
}

impl<S: Simd> Robots<'_, S> {
    /// The residual, and the lanes that hold: where it is rounding, and all cables are pulled, and neither
    /// folded nor overstrained.
    ///
    /// In the lanes that are `near` the linearization is moved here and keeps its stiffness.
    #[inline(always)]
    fn revise(
        &self,
        load: &PlatformLoad<S>,
        scale: &Scale,
        platform: &mut LinearizedPlatform<S>,
        near: Mask<S>,
    ) -> (LaneResidual<S>, Mask<S>) {
        let zero = self.weight.all(0.0);
        let wrench = load.wrench(&self.center);
        let mut residual = LaneResidual { closure: zero, wrench: [zero; 6] };
        let mut gradient = [zero; 6];
        let (mut tensions, mut failed) = (zero, zero);
        for (i, (cable, linearized)) in self.cables.iter().zip(&mut platform.cables).enumerate() {
            let span = cable.span(&self.position);
            let LaneEnd { end, tension, slackness } = match &cable.guided {
                None => cable.end(),
                Some(guided) => {
                    let (end, missing) = guided.end(cable);
                    platform.free[i].revise(missing, near);
                    let most = zero.all(LAST_MISSING * scale.size);
                    failed = failed.max(missing.abs().less_or_equal(most).select(zero, zero.all(1.0)));
                    end
                }
            };
            let miss = span.misclosure(end);
            residual.closure = residual.closure.max(dot(&miss, &miss));
            let predicted = linearized.answer(cable.force, miss);
            let moved = LinearizedCable { plane: span.plane, predicted, ..*linearized };
            let [fx, fz] = [self.counted(i, cable.force[0]), self.counted(i, cable.force[1])];
            let [x, z] = [self.counted(i, moved.predicted[0]), self.counted(i, moved.predicted[1])];
            add(&mut residual.wrench, &cable.anchor_arm, &moved.plane.lift([fx, fz]));
            add(&mut gradient, &cable.anchor_arm, &moved.plane.lift([x, z]));
            linearized.replace(&moved, near);
            tensions += self.counted(i, tension);
            // A slack cable may hang from either side of its wheel.
            let folded = if cable.guided.is_some() { FOLDED_ON_WHEEL } else { FOLDED };
            let sound = zero.less_or_equal(fx)
                & slackness.less_or_equal(zero.all(folded))
                & !cable.may_be_overstrained(tension);
            failed = failed.max((!sound).select(zero.all(1.0), zero));
        }
        residual.closure = self.largest(residual.closure);
        residual.wrench = hold(self.freedoms, six!(|k| self.total(residual.wrench[k]) - wrench[k]));
        let gradient = hold(self.freedoms, six!(|k| self.total(gradient[k]) - wrench[k]));
        replace(&mut platform.gradient, &gradient, near);
        tensions = self.total(tensions) + load.weight;
        let (force, moment) = halves(&residual.wrench);
        let unbalanced =
            dot(&force, &force).sqrt() + dot(&moment, &moment).sqrt() * (1.0 / scale.characteristic_length);
        let holds = self.largest(failed).less_or_equal(zero)
            & residual.closure.less_or_equal(zero.all(scale.rounding * scale.rounding))
            & unbalanced.less_or_equal(tensions * FORCE_ROUNDING);
        (residual, holds)
    }

    /// Newton's method on the direct model from a linearization, in the lanes `alive`.
    ///
    /// Returns the lanes that found a stable equilibrium, and its residual. The linearization is then one at
    /// this equilibrium, with a stiffness from nearby. All callers share one function for each vector unit.
    #[inline(always)]
    pub(crate) fn settle(
        &mut self,
        load: &PlatformLoad<S>,
        platform: &mut LinearizedPlatform<S>,
        scale: &Scale,
        alive: Mask<S>,
    ) -> (Mask<S>, LaneResidual<S>) {
        self.weight.apart(Settle { robots: self, load, platform, scale, alive })
    }

    #[inline(always)]
    fn settle_here(
        &mut self,
        load: &PlatformLoad<S>,
        platform: &mut LinearizedPlatform<S>,
        scale: &Scale,
        alive: Mask<S>,
    ) -> (Mask<S>, LaneResidual<S>) {
        let zero = self.weight.all(0.0);
        let (farthest, turned_most) = (zero + (0.3 * scale.size).powi(2), zero + 0.1 * 0.1);
        let small_step = zero + (SMALL_STEP * scale.size).powi(2);
        let (mut going, mut found) = (alive, alive & !alive);
        let mut residual = LaneResidual { closure: small_step, wrench: platform.gradient };
        for iteration in 0..MAX_ITERATIONS {
            let gradient = six!(|k| -platform.gradient[k]);
            let mut step = platform.factored.solve(&gradient);
            if load.moment.is_some() {
                // Where this does not converge, the steps do not either.
                let skew = Skew { freedoms: self.freedoms, moment: load.moment, guided: Vec::new() };
                skew.refine(&platform.factored, &gradient, &mut step, scale.characteristic_length);
            }
            let (translation, rotation) = halves(&step);
            let turned = dot(&rotation, &rotation);
            let moved = dot(&translation, &translation)
                + turned * (scale.characteristic_length * scale.characteristic_length);
            // The linearization is invalid farther away; a comparison with NaN is false, which ends the lane.
            going = going & moved.less_or_equal(farthest) & turned.less_or_equal(turned_most);
            platform.steps.take(iteration, moved, &step, scale.characteristic_length, going);
            let [steady, held] = self.apply(&translation, &rotation, turned, platform, going);
            going = going & held;
            let near = going & steady & moved.less_or_equal(small_step);
            if near.any() {
                let (left, holds) = self.revise(load, scale, platform, near);
                let mut done = near & holds & platform.factored.positive;
                if !platform.free.is_empty() {
                    done = done & moved.less_or_equal(small_step * LAST_OF_GUIDED);
                }
                residual = left;
                (found, going) = (found | done, going & !done);
            }
            let far = going & !near;
            if far.any() {
                self.linearize(load, platform, far);
            } else if !going.any() {
                break;
            }
        }
        (found, residual)
    }

    /// Moves the platforms and the forces of their cables where `going`. Returns the lanes in which no cable
    /// changed so much that its stiffness is another one, and those in which none became slack beside
    /// its wheel, from either side of which it may hang.
    #[inline(always)]
    fn apply(
        &mut self,
        translation: &Lanes3<S>,
        rotation: &Lanes3<S>,
        square: Lanes<S>,
        platform: &LinearizedPlatform<S>,
        going: Mask<S>,
    ) -> [Mask<S>; 2] {
        let (mut steady, mut held) = (going, going);
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
            let mut force = linearized.force_after(r);
            // A cable that becomes slack: the step of 1/fx instead, of which fx remains positive.
            let [fx, fz] = cable.force;
            let lost = fx - force[0];
            let changed = going & !lost.abs().less_or_equal(fx * SMALL_CHANGE);
            if changed.any() {
                steady = steady & !changed;
                let slackening = changed & !lost.less_or_equal(fx * GREATEST_LOSS);
                let share = slackening.select(fx / (fx + lost), fx.all(1.0));
                force = [fx - lost * share, fz + (force[1] - fz) * share];
                if let Some(guided) = &cable.guided {
                    held = held & !(slackening & guided.is_beside(cable, &self.position));
                }
            }
            if cable.guided.is_some() {
                let length = cable.length + platform.free[i].change(&cable.force, &force);
                cable.length.replace(length, going);
            }
            replace(&mut cable.force, &force, going);
            replace(&mut cable.anchor_arm, &arm, going);
        }
        for vector in self.frame.iter_mut().chain([&mut self.center]) {
            let (_, turned) = rotate(vector, rotation, a, b);
            replace(vector, &turned, going);
        }
        let position = three!(|k| self.position[k] + translation[k]);
        replace(&mut self.position, &position, going);
        [steady, held]
    }
}

/// The arguments of [`Robots::settle`].
struct Settle<'b, 'a, S: Simd> {
    robots: &'b mut Robots<'a, S>,
    load: &'b PlatformLoad<S>,
    platform: &'b mut LinearizedPlatform<S>,
    scale: &'b Scale,
    alive: Mask<S>,
}

impl<S: Simd> WithSimd for Settle<'_, '_, S> {
    type Output = (Mask<S>, LaneResidual<S>);

    #[inline(always)]
    fn with_simd<Same: Simd>(self, _: Same) -> Self::Output {
        self.robots.settle_here(self.load, self.platform, self.scale, self.alive)
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
