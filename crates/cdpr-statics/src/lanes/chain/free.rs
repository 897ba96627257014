//! The rest of platforms with fewer cables than free motions, one robot in each lane.
//!
//! Unknowns of the balance (I6) of `inverse/free.rs` are the horizontal forces of the cables, as in (L1), and
//! the free coordinates q. A free coordinate shifts the platform or turns it about an axis ω; its anchor
//! points then move by d, in the plane of the cable (d_h, d_z) and across it d_l. At constant fx this changes
//! the closed force of a cable, with h the horizontal distance of its ends, by (L19) over a tilted axis, else
//! by
//!
//! ```text
//! dF = -(dz e_z + (fx/h) d_l e_l),      C (0, dz) + e dL = (d_h, d_z)                             (L15)
//! ```
//!
//! and the balance by `[dF; s x dF + ds x F]` and by the lever of the weight. Newton's steps solve the six
//! equations for as many unknowns, the last of which are the reactions of what constrains a point or a planar
//! platform. Angles are those of R = Rz(yaw) Ry(pitch) Rx(roll): with the axes at R,
//!
//! ```text
//! R' = Rot(e_z, dyaw) Rot(Rz e_y, dpitch) Rot(R e_x, droll) R                                      (L16)
//! ```
//!
//! has the angles of R and their changes, so that a step rotates all vectors about one axis after the other.
//! A rotation by 2 atan(dq/2) is one by dq but for the third order, and needs no sine.

use crate::equations::Span;
use crate::inverse::{NEARLY_ROUNDING, NEXT_TO_POSE};
use crate::lanes::chain::limits::limits_at;
use crate::lanes::chain::shared::{LAST_DISTRIBUTION, MAX_DISTRIBUTIONS, Shared};
use crate::lanes::fixed_ends::FixedEnds;
use crate::local::cable::FOLDED;
use crate::local::freedoms::constrain;
use crate::local::load::PlatformLoad;
use crate::local::newton::rotate;
use crate::local::platform::{LinearizedPlatform, Robots};
use cdpr_cable::MAX_STRAIN;
use cdpr_number::Number;
use cdpr_number::dense::{Lanes3, Lanes6, add, solve_columns};
use cdpr_number::lanes::{Lanes, Mask, Simd, WithSimd};
use cdpr_number::vector::{cross, dot};
use cdpr_number::{six, three};

/// Motions of a platform in space.
const MOTIONS: usize = 6;

/// Greatest first step, in the measure of [`Rest::step`].
const GREATEST_STEP: f64 = 0.3;

/// Ratio of one step to that before: an upper bound. From a solution of the nominal robot Newton's method
/// then stays with the one that belongs to it.
const CONTRACTION: f64 = 0.5;

/// The motion of the platform with a free coordinate.
#[derive(Clone, Copy)]
pub(crate) enum FreeMotion<S: Simd> {
    /// Along an axis [m].
    Along(Lanes3<S>),
    /// About an axis through P [rad].
    About(Lanes3<S>),
}

impl<S: Simd> FreeMotion<S> {
    /// Its axis.
    #[inline(always)]
    pub(crate) fn axis(&mut self) -> &mut Lanes3<S> {
        let (Self::Along(axis) | Self::About(axis)) = self;
        axis
    }

    /// Motion of a point of the platform with the arm `arm`.
    #[inline(always)]
    fn of(&self, arm: &Lanes3<S>) -> Lanes3<S> {
        match self {
            Self::Along(axis) => *axis,
            Self::About(axis) => cross(axis, arm),
        }
    }

    /// Adds the moment of a force whose point of attack moves.
    #[inline(always)]
    fn add_lever(&self, column: &mut Lanes6<S>, moved: &Lanes3<S>, force: &Lanes3<S>) {
        if let Self::About(_) = self {
            let moment = cross(moved, force);
            for k in 0..3 {
                column[3 + k] += moment[k];
            }
        }
    }
}

/// Moves platforms to where they rest under their own weight near the given pose, and gives their cables
/// the forces and lengths that they have there. `free` are the motions of the free coordinates in the order
/// of [`cdpr_robot::Coordinate::ALL`], as many as cables are missing; `offsets` become set-points.
///
/// Returns the lanes where the rest was found, and those where it is stable, close to the given pose and its
/// tensions are within the limits: the scalar models then search for no other.
#[cold]
#[inline(never)]
pub(crate) fn rest<S: Simd>(
    robots: &mut Robots<'_, S>,
    free: &mut [FreeMotion<S>],
    offsets: &mut [Lanes<S>],
    spans: &mut [Span<Lanes<S>>],
    shared: &Shared,
) -> (Mask<S>, Mask<S>) {
    let (zero, one) = (robots.weight.all(0.0), robots.weight.all(1.0));
    let frame = [[one, zero, zero], [zero, one, zero], [zero, zero, one]];
    zero.apart(Rest { robots, free, offsets, spans, frame, shared })
}

struct Rest<'r, 'a, S: Simd> {
    robots: &'r mut Robots<'a, S>,
    free: &'r mut [FreeMotion<S>],
    offsets: &'r mut [Lanes<S>],
    spans: &'r mut [Span<Lanes<S>>],
    /// How the axes of the level frame have turned with the platform.
    frame: [Lanes3<S>; 3],
    shared: &'r Shared,
}

impl<S: Simd> WithSimd for Rest<'_, '_, S> {
    type Output = (Mask<S>, Mask<S>);

    #[inline(always)]
    fn with_simd<Same: Simd>(mut self, _: Same) -> Self::Output {
        let zero = self.robots.weight.all(0.0);
        let mut size = zero;
        for span in &*self.spans {
            size = size.max(span.chord());
        }
        let (start, everywhere) = (self.robots.position, zero.less_or_equal(zero));
        let (mut active, mut found) = (everywhere, !everywhere);
        let mut before = zero.all(GREATEST_STEP / CONTRACTION);
        for _ in 0..MAX_DISTRIBUTIONS {
            let (moved, balanced) = self.step(active);
            let small = zero.all(LAST_DISTRIBUTION);
            let last = active & balanced & moved.less_or_equal(small);
            found = found | last;
            active = active & !last & moved.less_or_equal((before * CONTRACTION).max(small));
            before = moved;
            if !active.any() {
                break;
            }
        }
        let shift = three!(|k| self.robots.position[k] - start[k]);
        let mut turned = zero;
        for (k, column) in self.frame.iter_mut().enumerate() {
            column[k] = column[k] + -1.0;
            turned += dot(column, column);
        }
        // Half the sum of squares is 4 sin²(φ/2): φ² is no more than this for such angles.
        let turned = turned * 0.5;
        let away = dot(&shift, &shift) / (size * size) + turned + turned * turned * (1.0 / 11.0);
        let is_near = away.less_or_equal(zero.all(NEXT_TO_POSE * NEXT_TO_POSE));
        (found, is_near & self.within_limits() & self.is_stable())
    }
}

impl<S: Simd> Rest<'_, '_, S> {
    /// Newton's step where `active`. Returns the greatest change relative to the sum of tensions, the longest
    /// cable and an angle of 1, and the lanes that were balanced before it.
    #[inline(always)]
    fn step(&mut self, active: Mask<S>) -> (Lanes<S>, Mask<S>) {
        let Self { robots, free, spans, frame, shared, .. } = self;
        let zero = robots.weight.all(0.0);
        let (cables, compared) = (spans.len(), [shared.tension, shared.scale.size]);
        let own = PlatformLoad::weight(robots.weight);
        let mut balance = own.wrench(&robots.center);
        let mut columns = [[zero; 6]; MOTIONS];
        let mut all_fixed = Vec::with_capacity(cables);
        for (i, (span, cable)) in spans.iter().zip(&robots.cables).enumerate() {
            let (fixed, ends) = FixedEnds::with_end_slopes(cable, span);
            let (arm, plane) = (&cable.anchor_arm, cable.plane(span));
            let pull = fixed.pull(cable, span);
            add(&mut balance, arm, &pull);
            add(&mut columns[i], arm, &fixed.pull_slope(cable, span));
            for (motion, column) in free.iter().zip(&mut columns[cables..]) {
                let moved = motion.of(arm);
                let [h, z] = plane.project(moved);
                let along = [h, plane.across(moved), z];
                let ([x, y], across) = (plane.azimuth, dot(&ends[0], &along));
                add(column, arm, &[across * y, -(across * x), -dot(&ends[1], &along)]);
                motion.add_lever(column, &moved, &pull);
            }
            all_fixed.push((fixed, ends));
        }
        for (motion, column) in free.iter().zip(&mut columns[cables..]) {
            motion.add_lever(column, &motion.of(&robots.center), &[zero, zero, -robots.weight]);
        }
        let constrained = (0..MOTIONS).filter(|k| !robots.freedoms.contains(*k));
        for (k, column) in constrained.zip(&mut columns[cables + free.len()..]) {
            column[k] = zero.all(1.0);
        }
        let per_arm = 1.0 / shared.scale.characteristic_length;
        for column in columns.iter_mut().chain([&mut balance]) {
            for moment in &mut column[3..] {
                *moment = *moment * per_arm;
            }
        }
        let step = solve_columns(&columns, &six!(|k| -balance[k]));
        balance = constrain(robots.freedoms, balance);
        let mut moved = zero;
        for (i, (span, cable)) in spans.iter().zip(&mut robots.cables).enumerate() {
            let (mut fixed, ends) = all_fixed[i];
            let mut displacement = [zero; 3];
            for (motion, change) in free.iter().zip(&step[cables..]) {
                let of = motion.of(&cable.anchor_arm);
                displacement = three!(|k| displacement[k] + of[k] * *change);
            }
            let plane = cable.plane(span);
            let [h, z] = plane.project(displacement);
            let along = [h, plane.across(displacement), z];
            fixed.across[0] += dot(&ends[0], &along);
            fixed.closing[0] += dot(&ends[1], &along);
            fixed.closing[1] += dot(&ends[2], &along);
            moved = moved.max(fixed.change(cable, step[i], active, compared));
        }
        for k in 0..free.len() {
            let change = active.select(step[cables + k], zero);
            moved = moved.max(match free[k] {
                FreeMotion::Along(_) => change.abs() * (1.0 / shared.scale.size),
                FreeMotion::About(_) => change.abs(),
            });
            let (earlier, rest) = free.split_at_mut(k);
            robots.moved(&rest[0], change, earlier, frame);
        }
        for (span, cable) in spans.iter_mut().zip(&robots.cables) {
            *span = cable.span(&robots.position);
        }
        let unbalanced = NEARLY_ROUNDING * shared.forces;
        let balanced = dot(&balance, &balance).less_or_equal(zero.all(unbalanced * unbalanced));
        (moved, balanced)
    }

    /// The lanes whose cables are taut and have tensions within the limits at both ends; offsets become
    /// set-points.
    #[inline(always)]
    fn within_limits(&mut self) -> Mask<S> {
        let Self { robots, offsets, spans, shared, .. } = self;
        let zero = robots.weight.all(0.0);
        let compared = [shared.tension, shared.scale.size];
        let mut within = zero.less_or_equal(zero);
        let none = !within;
        let cables = robots.cables.iter_mut().zip(&**spans).zip(&mut **offsets);
        for (((cable, span), offset), choice) in cables.zip(&shared.choices) {
            let fixed = FixedEnds::new(cable, span);
            let [least, greatest] = limits_at(cable, span, (choice.limits, choice.max_at), compared);
            let bearable = zero.all(choice.bearable);
            let [fx, fz] = cable.force;
            let exit = [fx, fz - cable.weight_per_length * cable.length];
            within = within
                & zero.less_or_equal(fx)
                & fixed.slackness.less_or_equal(zero.all(FOLDED))
                & fixed.is_taut(cable, none)
                & least.less_or_equal(fixed.tension)
                & fixed.tension.less_or_equal(greatest)
                & fixed.tension.less_or_equal(bearable)
                & dot(&exit, &exit).sqrt().less_or_equal(bearable);
            if shared.ground > f64::NEG_INFINITY {
                let anchor = robots.position[2] + cable.anchor_arm[2];
                // At most how far the cable hangs below its anchor point, where it is level between its ends:
                // fz²/w (t + fx), stretched by no more than the strain at which the models end.
                let depth =
                    fz * fz * (1.0 + MAX_STRAIN) * (cable.weight_per_length * (fixed.tension + fx)).recip();
                let lowest = anchor - depth;
                let is_lower_end = fz.less_or_equal(zero) | zero.less_or_equal(exit[1]);
                let ground = zero.all(shared.ground);
                let above = ground.less_or_equal(lowest) | (anchor - span.end[1]).less_or_equal(lowest);
                within = within & ground.less_or_equal(anchor) & (is_lower_end | above);
            }
            let set_point = (fixed.tension + *offset).max(least);
            *offset = set_point.less_or_equal(greatest).select(set_point, greatest);
        }
        within
    }

    /// The lanes whose platform stays where it rests.
    #[inline(always)]
    fn is_stable(&mut self) -> Mask<S> {
        let robots = &mut *self.robots;
        let zero = robots.weight.all(0.0);
        for cable in &mut robots.cables {
            cable.keep_length();
        }
        let mut platform = LinearizedPlatform::new(zero, robots.cables.len());
        platform.follow_guides(robots);
        let own = PlatformLoad::weight(robots.weight);
        robots.linearize(&own, &mut platform, zero.less_or_equal(zero));
        platform.factored.positive
    }
}

impl<S: Simd> Robots<'_, S> {
    /// Moves the platforms, and the axes of the angles before this one with them, (L16), and `frame`.
    #[inline(always)]
    fn moved(
        &mut self,
        motion: &FreeMotion<S>,
        change: Lanes<S>,
        earlier: &mut [FreeMotion<S>],
        frame: &mut [Lanes3<S>; 3],
    ) {
        let axis = match motion {
            FreeMotion::Along(axis) => {
                self.position = three!(|k| self.position[k] + axis[k] * change);
                return;
            }
            FreeMotion::About(axis) => axis,
        };
        // tan φ/2, sin φ and 1 - cos φ
        let half = change * 0.5;
        let narrow = (half * half + 1.0).recip();
        let (sine, versine) = (change * narrow, change * half * narrow);
        let arms = self.cables.iter_mut().map(|cable| &mut cable.anchor_arm);
        let axes = earlier.iter_mut().filter(|motion| matches!(motion, FreeMotion::About(_)));
        let own = self.frame.iter_mut().chain([&mut self.center]);
        for vector in arms.chain(own).chain(axes.map(FreeMotion::axis)).chain(frame) {
            (_, *vector) = rotate(vector, axis, sine, versine);
        }
    }
}
