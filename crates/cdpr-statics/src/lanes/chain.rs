//! The chain of an observation, one robot in each lane.
//!
//! Its links are the inverse model (`chain/tensions.rs`, `chain/lengths.rs`), with free coordinates
//! `chain/free.rs`, and the direct model without and with the load (`local/newton.rs`).

pub(crate) mod free;
pub(crate) mod lengths;
pub(crate) mod limits;
pub(crate) mod minimum;
pub(crate) mod shared;
pub(crate) mod tensions;

use crate::lanes::chain::free::{FreeMotion, rest};
use crate::lanes::chain::lengths::find_lengths;
use crate::lanes::chain::shared::Shared;
use crate::lanes::chain::tensions::{CableTension, Distribute, Distributed};
use crate::local::freedoms::constrain;
use crate::local::load::PlatformLoad;
use crate::local::newton::solve;
use crate::local::platform::{LaneResidual, LinearizedPlatform, Robots};
use cdpr_number::dense::{Lanes3, Lanes6};
use cdpr_number::lanes::{Lanes, MAX_LANES, Mask, Simd};
use cdpr_number::{apart, six, three};
use smallvec::SmallVec;

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

/// What an observation has to pass, in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stage {
    /// The parameters are within their ranges.
    Parameters,
    /// The pulleys have vertical axes.
    Axes,
    /// Tensions that are nearest to their reference.
    Tensions,
    /// No cable is folded, and limits do not exclude each other.
    Limits,
    /// Lengths for the set-points.
    Lengths,
    /// A stable equilibrium without the load, converged to rounding.
    Unloaded,
    /// That with the load.
    Loaded,
}

impl Stage {
    const ALL: [Self; 7] = [
        Self::Parameters,
        Self::Axes,
        Self::Tensions,
        Self::Limits,
        Self::Lengths,
        Self::Unloaded,
        Self::Loaded,
    ];
}

/// The first stage that each lane has failed.
#[derive(Clone, Copy)]
pub(crate) struct Failures<S: Simd>(Lanes<S>);

impl<S: Simd> Failures<S> {
    #[inline(always)]
    fn none(zero: Lanes<S>) -> Self {
        Self(zero + Stage::ALL.len() as f64)
    }

    /// Adds the lanes that have not `passed` a stage.
    #[inline(always)]
    pub(crate) fn add(&mut self, stage: Stage, passed: Mask<S>) {
        let here = self.0.all(stage as usize as f64);
        self.0 = (passed | self.0.less_or_equal(here)).select(self.0, here);
    }

    #[inline(always)]
    pub(crate) fn of_lanes(&self) -> [Option<Stage>; MAX_LANES] {
        self.0.to_array().map(|first| Stage::ALL.get(first as usize).copied())
    }
}

/// The outcome for every robot.
pub(crate) struct Outcome<S: Simd> {
    pub(crate) failures: Failures<S>,
    /// dp [m].
    pub(crate) displacement: Lanes3<S>,
    pub(crate) unloaded: LaneResidual<S>,
    pub(crate) loaded: LaneResidual<S>,
    /// The platform frames without and with the load, where robots have them.
    pub(crate) frames: [SmallVec<[Lanes3<S>; 3]>; 2],
}

/// What an observation leaves behind for its derivatives.
pub(crate) struct Trace<'a, S: Simd> {
    /// The tensions of the inverse model; none with free coordinates.
    pub(crate) tensions: Vec<CableTension<S>>,
    /// The robots at the wanted pose, at rest without the load, and with it, where they are asked for.
    pub(crate) states: Vec<Robots<'a, S>>,
}

apart! {
    /// Observes every robot: its displacement under the load, with the lengths that give the offset tensions
    /// at the wanted pose; `traced` with its states.
    #[inline(always)]
    on(begin.robots.weight) pub(crate) fn observe<'b, 'a, S: Simd>(
        begin: &'b mut ChainStart<'a, S>,
        shared: &'b Shared,
        traced: bool,
    ) -> (Outcome<S>, Trace<'a, S>) {
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
        let Distributed { converged, sound, cables: tensions } = match free.is_empty() {
            true => {
                let (external, spans, offsets) = (&weight, &*spans, &mut **set_points);
                zero.apart(Distribute { robots, external, multipliers, offsets, spans, shared })
            }
            false => {
                let (converged, sound) = rest(robots, free, set_points, &mut spans, shared);
                Distributed { converged, sound, cables: Vec::new() }
            }
        };
        let mut demanded = vec![converged & !converged; spans.len()];
        for (demanded, found) in demanded.iter_mut().zip(&tensions) {
            *demanded = found.demanded;
        }
        let mut platform = LinearizedPlatform::new(zero, spans.len());
        let with_lengths = find_lengths(robots, &mut platform, set_points, (&spans, &demanded), shared);
        let mut states = Vec::new();
        let mut keep = |robots: &Robots<'a, S>| {
            if traced {
                states.push(robots.clone());
            }
        };
        keep(robots);

        let own = PlatformLoad::weight(robots.weight);
        robots.assemble(&own, &mut platform, zero.less_or_equal(zero));
        let (standing, unloaded) =
            solve(robots, &own, &mut platform, &shared.scale, converged & sound & with_lengths);
        let (stood, stiffness) = (robots.position, platform.factored);
        let frame = robots.frame.clone();
        keep(robots);

        let load = payload.on(own.weight);
        // The first step follows the linearization at hand.
        let added = constrain(freedoms, payload.wrench(&robots.center));
        platform.gradient = six!(|k| platform.gradient[k] - added[k]);
        let (standing_loaded, loaded) = solve(robots, &load, &mut platform, &shared.scale, standing);
        let standing_loaded = robots.on_branch(&load, &platform, &stiffness, &shared.scale, standing_loaded);
        keep(robots);
        let mut failures = Failures::none(zero);
        failures.add(Stage::Tensions, converged);
        failures.add(Stage::Limits, sound);
        failures.add(Stage::Lengths, with_lengths);
        failures.add(Stage::Unloaded, standing);
        failures.add(Stage::Loaded, standing_loaded);
        // Eq. (4)
        let displacement = three!(|k| robots.position[k] - stood[k]);
        let frames = [frame, robots.frame.clone()];
        (Outcome { failures, displacement, unloaded, loaded, frames }, Trace { tensions, states })
    }
}
