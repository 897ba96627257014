//! The direct model: Newton's method of `direct/newton.rs`, with its cables
//! eliminated.
//!
//! Each lane holds a robot, or a cable of one robot. A lane stops by its own steps alone: the other lanes of
//! a batch change none of its digits.

use crate::equations::{CablePlane, LinearizedCable};
use crate::lanes::cable::{FreeLength, LaneCable};
use crate::lanes::freedoms::{hold, hold_matrix};
use crate::lanes::load::PlatformLoad;
use crate::lanes::skew::Skew;
use crate::state::Residual;
use cdpr_cable::kernel::{FOLDED, LaneEnd};
use cdpr_number::Number;
use cdpr_number::dense::{Lanes3, Lanes6, Lanes6x6, SymmetricFactors, add, halves, replace};
use cdpr_number::lanes::{Lanes, MAX_LANES, Mask, Simd, WithSimd};
use cdpr_number::vector::{cross, dot};
use cdpr_number::{six, three};
use cdpr_robot::Freedoms;
use smallvec::{SmallVec, smallvec};
use std::array::from_fn;

/// What the lanes hold.
#[derive(Clone)]
pub(crate) enum Layout<S: Simd> {
    /// Each lane holds a robot.
    Robots,
    /// Each lane holds a cable of one robot. The mask says which lanes of the last [`LaneCable`] count; the
    /// others repeat a cable.
    Cables(Mask<S>),
}

/// Number of [`LaneCable`]s that are stored without allocation.
const INLINE: usize = 4;

/// Robots, in an equilibrium or near one.
#[derive(Clone)]
pub(crate) struct Robots<'a, S: Simd> {
    pub(crate) layout: Layout<S>,
    /// The motions that are free; what holds the others takes any wrench.
    pub(crate) freedoms: Freedoms,
    pub(crate) cables: SmallVec<[LaneCable<'a, S>; INLINE]>,
    /// Position of the platform [m].
    pub(crate) position: Lanes3<S>,
    /// R c, the lever of the centre of mass [m].
    pub(crate) center: Lanes3<S>,
    /// Other vectors that rotate with the platform.
    pub(crate) frame: SmallVec<[Lanes3<S>; 3]>,
    /// Weight of the platform [N].
    pub(crate) weight: Lanes<S>,
}

impl<S: Simd> LaneResidual<S> {
    /// The norms in each lane.
    #[inline(always)]
    pub(crate) fn norms(&self) -> [Residual; MAX_LANES] {
        let (force, moment) = halves(&self.wrench);
        let (force, moment) =
            (dot(&force, &force).sqrt().to_array(), dot(&moment, &moment).sqrt().to_array());
        let closure = self.closure.sqrt().to_array();
        from_fn(|lane| Residual { closure: closure[lane], force: force[lane], moment: moment[lane] })
    }
}

/// Lengths that positions are compared with [m].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale {
    /// The longest cable.
    pub(crate) size: f64,
    /// The length that makes rotations comparable with translations.
    pub(crate) characteristic_length: f64,
    /// Rounding of a closure.
    pub(crate) rounding: f64,
}

/// Residual of the equations, one for each lane.
#[derive(Clone, Copy)]
pub(crate) struct LaneResidual<S: Simd> {
    /// Largest distance of a cable's end from its anchor point, squared [m²].
    pub(crate) closure: Lanes<S>,
    /// Unbalanced force [N] and moment [N m], with the sign of the potential's gradient: -G of (S4).
    pub(crate) wrench: Lanes6<S>,
}

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

/// The platform between linearised cables.
pub(crate) struct LinearizedPlatform<S: Simd> {
    pub(crate) cables: SmallVec<[LinearizedCable<Lanes<S>>; INLINE]>,
    /// The lengths beyond the leave points of all cables, of robots with guided ones.
    pub(crate) free: Vec<FreeLength<S>>,
    /// Gradient of the potential with the predicted forces.
    pub(crate) gradient: Lanes6<S>,
    /// Its derivative, factored.
    pub(crate) factored: SymmetricFactors<S>,
    /// The steps of the last search.
    pub(crate) steps: Steps<S>,
}

/// The steps (dp, ℓ dφ) of a search.
pub(crate) struct Steps<S: Simd> {
    /// Square of the first one, which the linearisation at the start predicts [m²].
    pub(crate) first: Lanes<S>,
    /// The sum of all others [m].
    pub(crate) others: Lanes6<S>,
}

impl<S: Simd> LinearizedPlatform<S> {
    /// Storage for a linearised platform, all zero, of robots with plain cables.
    #[inline(always)]
    pub(crate) fn new(zero: Lanes<S>, cables: usize) -> Self {
        let cable = LinearizedCable {
            plane: CablePlane { azimuth: [zero; 2] },
            predicted: [zero; 2],
            stiffness: [zero; 3],
            lateral_stiffness: zero,
        };
        Self {
            cables: smallvec![cable; cables],
            free: Vec::new(),
            gradient: [zero; 6],
            factored: SymmetricFactors::new([[zero; 6]; 6]),
            steps: Steps { first: zero, others: [zero; 6] },
        }
    }

    /// Makes room for the lengths beyond leave points.
    #[inline(always)]
    pub(crate) fn follow_guides(&mut self, robots: &Robots<'_, S>) {
        if robots.cables.iter().any(|cable| cable.guided.is_some()) {
            self.free = vec![FreeLength::fixed(robots.weight.all(0.0)); robots.cables.len()];
        }
    }

    /// The lanes whose stiffness is positive definite.
    #[inline(always)]
    pub(crate) fn is_stable(&self) -> Mask<S> {
        self.factored.positive
    }
}

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
    /// Linearises all cables in the lanes that are `going`, and puts the platform between them.
    #[inline(always)]
    pub(crate) fn linearise(
        &self,
        load: &PlatformLoad<S>,
        platform: &mut LinearizedPlatform<S>,
        going: Mask<S>,
    ) {
        self.linearise_cables(platform, going);
        self.assemble(load, platform, going);
    }

    #[inline(always)]
    fn linearise_cables(&self, platform: &mut LinearizedPlatform<S>, going: Mask<S>) {
        for (i, (cable, linearized)) in self.cables.iter().zip(&mut platform.cables).enumerate() {
            if let Some(guided) = &cable.guided {
                guided.linearise(
                    cable,
                    &cable.span(&self.position),
                    linearized,
                    &mut platform.free[i],
                    going,
                );
                continue;
            }
            let span = cable.span(&self.position);
            let response = cable.response();
            linearized.replace(&LinearizedCable::new(&span, cable.force, &response), going);
        }
    }

    /// The upper triangle of the stiffness here (S5), with all cables linearised anew; one on the diagonal
    /// for motions that are held.
    #[inline(always)]
    pub(crate) fn stiffness(
        &self,
        load: &PlatformLoad<S>,
        platform: &mut LinearizedPlatform<S>,
    ) -> Lanes6x6<S> {
        self.linearise_cables(platform, load.weight.less_or_equal(load.weight));
        let (_, hessian) = self.balance(load, platform);
        hessian
    }

    /// Puts the platform between its linearised cables in the lanes that are `going`.
    #[inline(always)]
    pub(crate) fn assemble(
        &self,
        load: &PlatformLoad<S>,
        platform: &mut LinearizedPlatform<S>,
        going: Mask<S>,
    ) {
        let (gradient, hessian) = self.balance(load, platform);
        replace(&mut platform.gradient, &gradient, going);
        platform.factored.replace(&SymmetricFactors::new(hessian), going);
    }

    /// Gradient of the potential with the predicted forces, and the upper triangle of its derivative, which
    /// has one on the diagonal for motions that are held.
    ///
    /// Where moments are out of balance the derivative of the gradient is not symmetric. The skew part is
    /// dropped: it is proportional to the residual moment, which vanishes at equilibrium, and that under a
    /// moment takes part in the steps.
    // Indices as in the formula.
    #[allow(clippy::needless_range_loop)]
    #[inline(always)]
    pub(crate) fn balance(
        &self,
        load: &PlatformLoad<S>,
        platform: &LinearizedPlatform<S>,
    ) -> (Lanes6<S>, Lanes6x6<S>) {
        let zero = self.weight.all(0.0);
        let (mut gradient, mut hessian) = ([zero; 6], [[zero; 6]; 6]);
        for (i, (cable, linearized)) in self.cables.iter().zip(&platform.cables).enumerate() {
            let counted = LinearizedCable {
                plane: linearized.plane,
                predicted: [
                    self.counted(i, linearized.predicted[0]),
                    self.counted(i, linearized.predicted[1]),
                ],
                stiffness: three!(|j| self.counted(i, linearized.stiffness[j])),
                lateral_stiffness: self.counted(i, linearized.lateral_stiffness),
            };
            // -F_i
            let force = counted.plane.lift(counted.predicted);
            add(&mut gradient, &cable.anchor_arm, &force);
            add_stiffness(&mut hessian, &cable.anchor_arm, &force, &counted.stiffness_in_space());
        }
        if let Layout::Cables(_) = self.layout {
            for row in 0..6 {
                gradient[row] = self.total(gradient[row]);
                for column in row..6 {
                    hessian[row][column] = self.total(hessian[row][column]);
                }
            }
        }
        // Weight is vertical and acts at the centre of mass.
        let [cx, cy, cz] = self.center;
        hessian[3][3] -= load.weight * cz;
        hessian[4][4] -= load.weight * cz;
        hessian[3][5] += load.weight * cx * 0.5;
        hessian[4][5] += load.weight * cy * 0.5;
        let wrench = load.wrench(&self.center);
        let gradient = hold(self.freedoms, six!(|k| gradient[k] - wrench[k]));
        hold_matrix(self.freedoms, &mut hessian, zero + 1.0);
        (gradient, hessian)
    }

    /// The value in the lanes of cable `i` that count, zero in the others.
    #[inline(always)]
    fn counted(&self, i: usize, value: Lanes<S>) -> Lanes<S> {
        match self.layout {
            Layout::Cables(last) if i + 1 == self.cables.len() => last.select(value, value.all(0.0)),
            _ => value,
        }
    }

    /// The sum over all cables of a robot, from the sums of its lanes.
    #[inline(always)]
    fn total(&self, sum: Lanes<S>) -> Lanes<S> {
        match self.layout {
            Layout::Robots => sum,
            Layout::Cables(_) => {
                let mut total = 0.0;
                for lane in sum.to_array() {
                    total += lane;
                }
                sum.all(total)
            }
        }
    }

    /// The largest value of all cables of a robot.
    #[inline(always)]
    fn largest(&self, value: Lanes<S>) -> Lanes<S> {
        match self.layout {
            Layout::Robots => value,
            Layout::Cables(_) => {
                let mut largest = 0.0;
                for lane in value.to_array() {
                    largest = f64::max(largest, lane);
                }
                value.all(largest)
            }
        }
    }

    /// The residual, and the lanes that hold: where it is rounding, and all cables are pulled, and neither
    /// folded nor overstrained.
    ///
    /// In the lanes that are `near` the linearisation is moved here and keeps its stiffness.
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

    /// Newton's method on the direct model from a linearisation, in the lanes `alive`.
    ///
    /// Returns the lanes that found a stable equilibrium, and its residual. The linearisation is then one at
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
            // The linearisation is invalid farther away; a comparison with NaN is false, which ends the lane.
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
                self.linearise(load, platform, far);
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

/// Adds a cable with the stiffness K3 and the force -F_i = `f` at the arm s to the upper triangle of the
/// stiffness, equation (S5).
#[inline(always)]
fn add_stiffness<S: Simd>(hessian: &mut Lanes6x6<S>, s: &Lanes3<S>, f: &Lanes3<S>, k: &[Lanes3<S>; 3]) {
    let [sx, sy, sz] = *s;
    // K [s], row by row: k x s.
    let ks = [cross(&k[0], s), cross(&k[1], s), cross(&k[2], s)];
    for row in 0..3 {
        for column in 0..3 {
            hessian[row][3 + column] -= ks[row][column];
        }
        for column in row..3 {
            hessian[row][column] += k[row][column];
            // [s] K [s], column by column: s x K [s].
            let swung = match row {
                0 => sy * ks[2][column] - sz * ks[1][column],
                1 => sz * ks[0][column] - sx * ks[2][column],
                _ => sx * ks[1][column] - sy * ks[0][column],
            };
            hessian[3 + row][3 + column] -= swung;
        }
    }
    // The symmetric part of s fᵀ - (s·f) 1.
    let (x, y, z) = (sx * f[0], sy * f[1], sz * f[2]);
    hessian[3][3] -= y + z;
    hessian[4][4] -= x + z;
    hessian[5][5] -= x + y;
    let half = three!(|j| s[j] * 0.5);
    hessian[3][4] += half[0] * f[1] + half[1] * f[0];
    hessian[3][5] += half[0] * f[2] + half[2] * f[0];
    hessian[4][5] += half[1] * f[2] + half[2] * f[1];
}
