//! Derivatives of the deflection of one robot at many poses, one pose in each lane.

use crate::inverse::InverseSolution;
use crate::lanes::adjoint::{Adjoint, Record};
use crate::lanes::chain::Trace;
use crate::lanes::chain::shared::Shared;
use crate::lanes::chain::tensions::CableTension;
use crate::lanes::level::LevelFrame;
use crate::lanes::observer::rows::Rows;
use crate::lanes::poses::placed::{PlacedRobot, each};
use crate::local::platform::Robots;
use crate::state::Load;
use cdpr_number::lanes::{Lanes, MAX_LANES, Simd};
use cdpr_number::{six, three};
use cdpr_robot::{Axis, Parameter, ParameterLayout, Robot, Vector6};
use cdpr_tension::Bound;
use smallvec::SmallVec;

/// Slopes by every parameter in each lane, and the lanes in which they are known.
pub(crate) type SlopesOfLanes = (Vec<[f64; MAX_LANES]>, [bool; MAX_LANES]);

/// Part by which a tension at its limit may differ from it.
const ROUNDING: f64 = 1e-12;

/// The robot without deviations, for its derivatives.
pub(crate) struct Nominal<'a> {
    robot: &'a Robot,
    pub(crate) shared: Shared,
    layout: ParameterLayout,
    /// Deviations of zero.
    none: Vec<f64>,
}

impl<'a> Nominal<'a> {
    pub(crate) fn new(placed: &PlacedRobot<'a>, load: &Load) -> Self {
        let layout = ParameterLayout::of(placed.robot);
        Self { robot: placed.robot, shared: placed.shared(load), none: vec![0.0; layout.count()], layout }
    }

    /// What the adjoint needs of the inverse model, and of the cables with its lengths.
    #[inline(always)]
    pub(crate) fn record<'n, S: Simd>(
        &self,
        simd: S,
        placed: &PlacedRobot,
        wanted: &[&InverseSolution],
        robots: &Robots<'n, S>,
    ) -> Record<'n, S> {
        let zero = Lanes::splat(simd, 0.0);
        let multipliers: SmallVec<[Vector6<f64>; MAX_LANES]> =
            wanted.iter().map(|wanted| placed.both(PlacedRobot::to_level, &wanted.multipliers)).collect();
        let multipliers = six!(|k| each(simd, &multipliers, &|of| of[k]));
        let mut tensions = Vec::with_capacity(robots.cables.len());
        for (i, (cable, choice)) in robots.cables.iter().zip(&self.shared.choices).enumerate() {
            let at = |bound: Bound| {
                let is_there = each(simd, wanted, &|of| f64::from(u8::from(of.active[i] == Some(bound))));
                zero.all(0.5).less_or_equal(is_there)
            };
            let at_limits = [at(Bound::Min), at(Bound::Max)];
            // A least tension that the span demands is that of the cable.
            let least = |of: &&InverseSolution| {
                let min = choice.limits.min;
                let demanded = of.active[i] == Some(Bound::Min) && of.tensions[i] > min * (1.0 + ROUNDING);
                if demanded { of.tensions[i] } else { min }
            };
            let greatest = |of: &&InverseSolution| match of.active[i] {
                Some(Bound::Max) => of.tensions[i],
                // No set-point is beyond it.
                _ => f64::MAX,
            };
            let limits = [each(simd, wanted, &least), each(simd, wanted, &greatest)];
            tensions.push(CableTension { at_limits, ..CableTension::within(cable, limits) });
        }
        let trace = Trace { tensions, states: vec![robots.clone()] };
        Record { offsets: vec![zero; robots.cables.len()], multipliers, trace }
    }

    /// The slopes by all parameters, and the lanes in which they are known.
    #[inline(always)]
    pub(crate) fn slopes_of<S: Simd>(
        &self,
        simd: S,
        robots: &Robots<'_, S>,
        adjoint: &Adjoint<S>,
    ) -> SlopesOfLanes {
        let Self { robot, layout, none, .. } = self;
        let weight = robots.weight;
        let rows = Rows::new(simd, none, layout);
        let level = layout.index(Parameter::Gravity(Axis::X)).map(|_| {
            let gravity = robot.gravity.vector();
            LevelFrame::of_gravity(&three!(|k| weight.all(gravity[k]))).0
        });
        let mut slopes = vec![[0.0; MAX_LANES]; layout.count()];
        rows.write_slopes(robot, adjoint, level.as_ref(), &mut slopes);
        (slopes, (adjoint.decided & rows.rolling(robot, robots)).to_array())
    }
}
