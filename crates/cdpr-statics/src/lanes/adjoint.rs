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
//! symmetric but under a moment and for cables over guides (`local/skew.rs`). What y takes from the lengths,
//! Λ_i, goes over (L9) to the set-points and, with `a_i = Λ_i dL_i/dt_i`, to the inverse model. With c_i and
//! D_i of (D6) and the tensions without active bound free,
//!
//! ```text
//! [ sum_free c_i c_iᵀ/D_i ] η = sum_free c_i a_i/D_i,      α_i = (a_i - c_i·η)/D_i               (L11)
//! sum a_i dt_i = -sum_free α_i ∂ρ_i - η·∂G + sum_active (a_i - c_i·η) b_i
//! ```
//!
//! The number of parameters does not matter: each cable is evaluated once more at each of its four states.

mod cable;
mod response;
mod tensions;

use crate::equations::{LinearizedCable, between};
pub(crate) use crate::lanes::adjoint::cable::GuideSlopes;
use crate::lanes::adjoint::cable::{CableSlopes, torque};
use crate::lanes::adjoint::response::CableResponse;
use crate::lanes::chain::Trace;
use crate::lanes::chain::shared::Shared;
use crate::local::load::PlatformLoad;
use crate::local::platform::{LinearizedPlatform, Robots};
use crate::local::skew::{Skew, SkewCable, refine};
use cdpr_number::dense::{Lanes3, Lanes6, halves};
use cdpr_number::lanes::{Lanes, Mask, Simd};
use cdpr_number::vector::{cross, dot};
use cdpr_number::{Number, apart, three};

/// A deflection below this share of the longest cable has no direction, as in `derivatives`.
const NO_DEFLECTION: f64 = 1e-12;

/// What the adjoint needs of an observation.
pub(crate) struct Record<'a, S: Simd> {
    /// Offset of the set-point of each cable [N].
    pub(crate) offsets: Vec<Lanes<S>>,
    pub(crate) multipliers: Lanes6<S>,
    pub(crate) trace: Trace<'a, S>,
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

apart! {
    /// Derivatives of |dp| for the robots of `record`; the frame of each is its rotation matrix, by columns.
    #[inline(always)]
    on(payload.weight) pub(crate) fn adjoint<'r, 'a, S: Simd>(
        record: &'r Record<'a, S>,
        displacement: &'r Lanes3<S>,
        payload: &'r PlatformLoad<S>,
        shared: &'r Shared,
    ) -> Option<Adjoint<S>> {
        let [placed, unloaded, loaded] = record.trace.states.as_slice() else { return None };
        let zero = placed.weight.all(0.0);
        let square = dot(displacement, displacement);
        let least = NO_DEFLECTION * shared.scale.size;
        let magnitude_inv = square.sqrt().recip();
        let none = CableAdjoint {
            exit: [zero; 3],
            anchor: [zero; 3],
            weight: zero,
            flexibility: zero,
            offset: zero,
            guide: GuideSlopes::none(zero),
        };
        let mut found = Adjoint {
            cables: vec![none; placed.cables.len()],
            weight: zero,
            center: [zero; 3],
            turn: [zero; 3],
            heavier: [zero; 3],
            decided: zero.all(least * least).less_or_equal(square),
        };
        let mut lengths = vec![zero; placed.cables.len()];
        let own = PlatformLoad::weight(unloaded.weight);
        let load = payload.on(unloaded.weight);
        let back = three!(|k| -(displacement[k] * magnitude_inv));
        let arm = shared.scale.characteristic_length;
        // One body of code for both equilibria.
        for (robots, load, sign) in [(unloaded, &own, 1.0), (loaded, &load, -1.0)] {
            found.at_rest(robots, load, &three!(|k| back[k] * sign), &mut lengths, arm);
        }
        // From here on the slopes by the set-points.
        for ((cable, found_cable), slope) in placed.cables.iter().zip(&mut found.cables).zip(&mut lengths) {
            let span = cable.span(&placed.position);
            let (slopes, per_tension) = CableResponse::of(cable).of_length(&span.plane, *slope);
            *slope = per_tension;
            found_cable.add(&slopes, &placed.frame, &slopes.span);
            let r = between(&placed.position, &cable.anchor_arm, &cable.exit_point);
            add(&mut found.turn, &torque(&[zero; 3], &[zero; 3], &r, &slopes.span));
        }
        found.of_tensions(record, placed, &lengths, shared);
        found.turn_axes(placed);
        Some(found)
    }
}

/// What the symmetric part of the transposed stiffness lacks.
#[inline(always)]
fn transposed_skew<S: Simd>(
    robots: &Robots<'_, S>,
    load: &PlatformLoad<S>,
    platform: &LinearizedPlatform<S>,
    responses: &[CableResponse<Lanes<S>>],
) -> Skew<S> {
    let mut skew = Skew { freedoms: robots.freedoms, moment: None, guided: Vec::new() };
    if let Some([x, y, z]) = load.moment {
        skew.moment = Some([-x, -y, -z]);
    }
    for ((cable, linearized), response) in robots.cables.iter().zip(&platform.cables).zip(responses) {
        if let Some(stiffness) = response.skew_stiffness() {
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
        let mut responses = Vec::with_capacity(robots.cables.len());
        for (cable, linearized) in robots.cables.iter().zip(&mut platform.cables) {
            let span = cable.span(&robots.position);
            let response = CableResponse::of(cable);
            *linearized = LinearizedCable::new(&span, cable.force, &response.response);
            responses.push(response);
        }
        robots.assemble(load, &mut platform, all);
        let right = [motion[0], motion[1], motion[2], zero, zero, zero];
        let mut twist = platform.factored.solve(&right);
        let skew = transposed_skew(robots, load, &platform, &responses);
        if skew.moment.is_some() || !skew.guided.is_empty() {
            self.decided = self.decided & refine(&skew, &platform.factored, &right, &mut twist, arm);
        }
        let (moved, turned) = halves(&twist);
        let cables = robots.cables.iter().zip(&platform.cables).zip(&responses).zip(&mut self.cables);
        for ((((cable, linearized), response), found), length) in cables.zip(lengths) {
            let swung = cross(&turned, &cable.anchor_arm);
            let twisted = three!(|k| moved[k] + swung[k]);
            let (slopes, per_length) = response.at_length(linearized, &twisted);
            *length += per_length;
            let force = linearized.plane.lift(cable.force);
            // -y_r·(ds x f)
            let swings = cross(&turned, &force);
            found.add(&slopes, &robots.frame, &three!(|k| slopes.span[k] + swings[k]));
            let r = between(&robots.position, &cable.anchor_arm, &cable.exit_point);
            add(&mut self.turn, &torque(&force, &three!(|k| -twisted[k]), &r, &slopes.span));
        }
        self.add_weight(robots, load.weight, &twist);
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
