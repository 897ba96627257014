//! What a robot can carry at a pose, and how far a set of wrenches stays away from the limits of tension.
//!
//! A pose is wrench-feasible for a set of wrenches if tensions within the limits balance each of them
//! (Bosscher, Riechel, Ebert-Uphoff, *Wrench-feasible workspace generation for cable-driven robots*, IEEE
//! Trans. Robotics 22, 2006). Two figures say by how much:
//!
//! ```text
//! payload = min over the set of the greatest mass at the centre of mass that is held beside the wrench (W1)
//! margin = min over the set of the distance from the tensions to the nearest limit (W2)
//! ```
//!
//! With the tensions *recomputed* they are the best that the limits allow, see
//! [`cdpr_statics::capacity::greatest_payload`] and [`cdpr_statics::capacity::tension_margin`]; both are
//! concave in the wrench if the cables are straight, so that the corners of a box stand for all of it
//! (Bouchard, Gosselin, Moore, *On the ability of a cable-driven robot to generate a prescribed set of
//! wrenches*, J. Mechanisms Robotics 2, 2010). With the *lengths kept* that hold the pose under the
//! platform's own weight, the tensions are those of the direct model. The payload then is the one at which
//! the first limit is reached, or the platform falls, while it grows from zero.

mod rising;

use cdpr_robot::{Coordinate, Pose, Robot, Wrench, visible};
use cdpr_statics::capacity::{Blocking, Greatest, greatest_payload, tension_margin};
use cdpr_statics::continuation::follow_load;
use cdpr_statics::free_coordinates::rest_near;
use cdpr_statics::limits::Limit;
use cdpr_statics::{
    DirectProblem, DirectSolution, DirectStart, Equilibrium, InverseSolution, Load, MAX_STRAIN, PoseLengths,
    StaticsError, Unstable, WantedPose, direct, inverse,
};
use rising::{Rising, nearest};
use std::fmt;

/// Loads whose effect on a robot is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct WrenchSet {
    /// Wrenches about P in the base frame [N, N m], at least one.
    wrenches: Vec<Wrench>,
}

impl WrenchSet {
    /// These wrenches [N, N m]; without any the zero wrench.
    pub fn of(wrenches: Vec<Wrench>) -> Self {
        if wrenches.is_empty() { Self { wrenches: vec![Wrench::none()] } } else { Self { wrenches } }
    }

    /// The corners of a box about each of the wrenches, of these half widths [N, N m].
    #[must_use]
    pub fn widened(&self, half_widths: &Wrench) -> Self {
        let widths = half_widths.to_vector();
        let mut corners: Vec<_> = self.wrenches.iter().map(Wrench::to_vector).collect();
        for k in (0..6).filter(|k| widths[*k] != 0.0) {
            let both = |corner| {
                [-1.0, 1.0].map(|sign| {
                    let mut corner: cdpr_robot::Vector6<f64> = corner;
                    corner[k] += sign * widths[k];
                    corner
                })
            };
            corners = corners.into_iter().flat_map(both).collect();
        }
        Self { wrenches: corners.iter().map(Wrench::from_vector).collect() }
    }

    /// The set with a wrench [N, N m] added to each.
    #[must_use]
    pub fn shifted(&self, by: Wrench) -> Self {
        Self { wrenches: self.wrenches.iter().map(|wrench| *wrench + by).collect() }
    }

    /// The wrenches [N, N m].
    pub fn wrenches(&self) -> &[Wrench] {
        &self.wrenches
    }
}

/// What can be carried at a pose.
#[derive(Clone, Debug, PartialEq)]
pub struct Capacity {
    /// Greatest payload [kg], tensions recomputed.
    pub payload_recomputed: Result<Figure, StaticsError>,
    /// Greatest payload [kg] with the lengths kept: until a tension reaches any of its limits.
    pub payload_kept: Result<Figure, StaticsError>,
    /// Greatest payload [kg] with the lengths kept, whichever cables become slack: until a tension reaches
    /// its greatest value or a breaking force.
    pub payload_kept_slack: Result<Figure, StaticsError>,
    /// Margin of the tensions [N], recomputed.
    pub margin_recomputed: Result<Figure, StaticsError>,
    /// Margin of the tensions [N] with the lengths kept.
    pub margin_kept: Result<Figure, StaticsError>,
}

/// A payload [kg] or margin [N], for the wrench of the set that leaves the least.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// The value; a payload is negative infinity where a limit is passed even without one, and infinite where
    /// none is too much.
    pub value: f64,
    /// Index of the wrench.
    pub wrench: usize,
    /// What blocks a greater value, the limit that gives most first.
    pub blocking: Vec<Block>,
}

impl Figure {
    /// What blocks a greater value, in words.
    pub fn blocked_by(&self) -> String {
        if self.value == f64::INFINITY {
            return "nothing: the weight does not pull at the cables".to_owned();
        }
        self.blocking.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
    }
}

impl fmt::Display for Block {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lost(StaticsError::BranchEnds(end)) => write!(f, "the platform {}", end.fall()),
            Self::Lost(error) => error.fmt(f),
            Self::Limit { cable, limit, value, .. } => {
                let value = visible(*value, 1);
                let limit = match limit {
                    Limit::BreakingForce => "breaking force".to_owned(),
                    Limit::Strain => format!("greatest strain of {:.0} %", 100.0 * MAX_STRAIN),
                    Limit::Max | Limit::MaxElsewhere | Limit::Min => limit.name().to_owned(),
                };
                write!(f, "cable {} at its {limit}, {value} N", cable + 1)
            }
        }
    }
}

/// What blocks a greater value.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A limit of a tension.
    Limit {
        /// Index of the cable, from 0.
        cable: usize,
        /// Which of its limits.
        limit: Limit,
        /// The limit [N].
        value: f64,
        /// By how much the figure grows where the limit gives way [kg/N, N/N], if that is known.
        gain: Option<f64>,
    },
    /// The equilibrium ends, or is not found, beyond this payload.
    Lost(StaticsError),
}

/// What the cables can carry at a pose besides the platform.
///
/// Margins are those under the whole `load`; payloads are found beside its wrench, in place of its payload.
/// The wrenches of `set` add to the load. Free coordinates are found under each load, if the tensions are
/// recomputed.
pub fn capacity_at<'a>(
    robot: &Robot,
    wanted: impl Into<WantedPose<'a>>,
    load: &Load,
    set: &WrenchSet,
) -> Capacity {
    let wanted = wanted.into();
    let wound_up = inverse(robot, wanted, &Load::none());
    let WantedPose { pose, free, .. } = wanted;
    capacity_of(robot, &pose, load, set, free, wound_up.as_ref().map_err(Clone::clone))
}

/// [`capacity_at`] at a pose that the winches hold so under the platform's own weight.
pub(crate) fn capacity_of(
    robot: &Robot,
    pose: &Pose,
    load: &Load,
    set: &WrenchSet,
    free: &[Coordinate],
    wound_up: Result<&InverseSolution, StaticsError>,
) -> Capacity {
    let set = set.shifted(load.wrench);
    let loaded = |payload: f64, wrench: &Wrench| Load { payload, wrench: *wrench };
    let first = wound_up.map(|InverseSolution { lengths, equilibrium, .. }| Rest {
        lengths: lengths.clone(),
        equilibrium: equilibrium.clone(),
        stands: None,
    });
    // Weights and forces that are rounding.
    let gravity = robot.gravity.magnitude();
    let carried: f64 = first.iter().flat_map(|rest| rest.equilibrium.tensions()).sum();
    let smallest_force = ROUNDED * (robot.platform.mass * gravity + carried);
    let smallest = if gravity > 0.0 { smallest_force / gravity } else { ROUNDED * robot.platform.mass };
    // Lengths that are kept hold no unstable pose.
    let unloaded = first.clone().and_then(|Rest { lengths, equilibrium, .. }| {
        let none = Load::none();
        let found = DirectProblem::new(robot, &lengths, &none)?
            .with_unstable(Unstable::Refused)
            .direct(DirectStart::Near(&equilibrium))?;
        Ok(Rest { lengths, equilibrium, stands: Some((none, found)) })
    });
    let recomputed = |load: &Load, near: &Rest| rest_on(robot, near, load, free);
    let kept = |load: &Load, near: &Rest| near.under(robot, load);
    let payload = |(first, answer): Way, counts: fn(Limit) -> bool| {
        set.least(smallest, |wrench| {
            let answer = &|mass, near: &Rest| answer(&loaded(mass, wrench), near);
            Rising { robot, answer, counts }.top(&first.clone()?)
        })
    };
    let margin = |(first, answer): Way| {
        set.least(smallest_force, |wrench| {
            let rest = answer(&loaded(load.payload, wrench), &first.clone()?)?;
            let nearest = nearest(robot, &rest, |limit| limit != Limit::Strain);
            Ok((nearest.distance, vec![nearest.block()]))
        })
    };
    let (recomputed, kept): (Way, Way) = ((&first, &recomputed), (&unloaded, &kept));
    let any = |limit| limit != Limit::MaxElsewhere;
    let payload_kept = payload(kept, any);
    let is_max = |limit: Limit| matches!(limit, Limit::Max | Limit::BreakingForce | Limit::Strain);
    let first_is_max = payload_kept.as_ref().is_ok_and(|figure| {
        figure.blocking.iter().all(|block| matches!(block, Block::Limit { limit, .. } if is_max(*limit)))
    });
    Capacity {
        payload_recomputed: if free.is_empty() {
            set.least(smallest, |wrench| greatest_payload(robot, pose, wrench).map(found))
        } else {
            payload(recomputed, any)
        },
        payload_kept_slack: if first_is_max && set.wrenches.len() == 1 {
            payload_kept.clone()
        } else {
            payload(kept, |limit| matches!(limit, Limit::Max | Limit::BreakingForce | Limit::Strain))
        },
        payload_kept,
        margin_recomputed: if free.is_empty() {
            set.least(smallest_force, |wrench| {
                tension_margin(robot, pose, &loaded(load.payload, wrench)).map(found)
            })
        } else {
            margin(recomputed)
        },
        margin_kept: margin(kept),
    }
}

/// Force that is rounding, relative to the platform's weight and the tensions.
const ROUNDED: f64 = 1e-9;

/// Lengths and equilibrium at a load.
#[derive(Clone)]
struct Rest {
    lengths: Vec<f64>,
    equilibrium: Equilibrium,
    /// The load and the equilibrium that the direct model found, where lengths are kept.
    stands: Option<(Load, DirectSolution)>,
}

/// The first rest, and how another one under a load is found from one nearby.
type Way<'a> = (&'a Result<Rest, StaticsError>, &'a dyn Fn(&Load, &Rest) -> Result<Rest, StaticsError>);

impl Rest {
    /// What it becomes under another load with the lengths kept.
    fn under(&self, robot: &Robot, load: &Load) -> Result<Self, StaticsError> {
        let Self { lengths, equilibrium, stands } = self;
        let found = match stands {
            Some((own, from)) => follow_load(robot, lengths, (own, from), load)?,
            None => direct(robot, lengths, load, DirectStart::Near(equilibrium))?,
        };
        let equilibrium = found.equilibrium.clone();
        Ok(Self { lengths: lengths.clone(), equilibrium, stands: Some((*load, found)) })
    }
}

/// The rest under a load on the branch of another one, in or out of the limits.
fn rest_on(robot: &Robot, near: &Rest, load: &Load, free: &[Coordinate]) -> Result<Rest, StaticsError> {
    let PoseLengths { lengths, equilibrium } = rest_near(robot, &near.equilibrium, load, free)?;
    Ok(Rest { lengths, equilibrium, stands: None })
}

fn found(Greatest { value, blocking, .. }: Greatest) -> (f64, Vec<Block>) {
    (value, blocking.into_iter().map(Block::from).collect())
}

impl From<Blocking> for Block {
    fn from(Blocking { index, limit, value, gain }: Blocking) -> Self {
        Self::Limit { cable: index, limit, value, gain: Some(gain) }
    }
}

impl WrenchSet {
    /// The least figure over the set, zero within `rounding`; the first failure if there is one.
    fn least(
        &self,
        rounding: f64,
        figure: impl Fn(&Wrench) -> Result<(f64, Vec<Block>), StaticsError>,
    ) -> Result<Figure, StaticsError> {
        let mut least = Figure { value: f64::INFINITY, wrench: 0, blocking: Vec::new() };
        for (wrench, one) in self.wrenches.iter().enumerate() {
            let (value, blocking) = figure(one)?;
            if value < least.value {
                let value = if value.abs() <= rounding { 0.0 } else { value };
                least = Figure { value, wrench, blocking };
            }
        }
        Ok(least)
    }
}
