//! A platform in weather, with wind of one velocity or from any direction in the horizontal plane.
//!
//! From any direction, the wind blows at [`DIRECTIONS`] azimuths. Around those that move the platform
//! farthest, or nearly so, those of the greatest and of the least tension, and those in which a cable has the
//! greatest part of what it may bear, golden-section searches look for directions that are worse still (R. P.
//! Brent, *Algorithms for Minimization without Derivatives*, 1973,
//! chapter 5). Between the azimuths nothing is proven.

use crate::inspection::is_below_floor;
use crate::tilt::to_base;
use cdpr_robot::{Pose, Robot, RobotCable, UnitQuaternion, Vector3};
use cdpr_statics::limits::{Limit, OutOfLimits, tensions_out_of_limits};
use cdpr_statics::weather::{RestInWeather, Weather, Wind};
use cdpr_statics::{DirectProblem, DirectSolution, DirectStart, Load, StaticsError};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Azimuths from which the searches for the worst ones begin.
pub const DIRECTIONS: usize = 24;

/// Steps of a golden-section search: the interval shrinks to a fiftieth, 0.6 degrees.
const STEPS: usize = 8;

/// What a peak may lie below the greatest one, over the range of all: that of a cosine is up to 0.9 % of half
/// its range above the nearest of [`DIRECTIONS`].
const NEARLY: f64 = 0.03;

/// Weather with a wind of one velocity, or of one speed from any direction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AnyWeather {
    /// The weather. Where `speed` is given, the velocity of its wind does not matter.
    pub weather: Weather,
    /// Speed of a horizontal wind from any direction [m/s].
    pub speed: Option<f64>,
}

/// The platform in one wind.
#[derive(Clone, Debug, PartialEq)]
pub struct InWind {
    /// Direction in which the wind blows, from x to y of the base frame [rad]; `None` for a wind of one
    /// velocity.
    pub azimuth: Option<f64>,
    /// Where the platform rests.
    pub rest: RestInWeather,
    /// Displacement of P [m].
    pub displacement: Vector3<f64>,
    /// Angle of the rotation [rad], at most π.
    pub turned: f64,
    /// Tensions that are out of limits.
    pub out_of_limits: Vec<OutOfLimits>,
    /// Least breaking force over greatest tension, and the index of that cable; `None` where a
    /// breaking force is not known.
    pub safety_factor: Option<(f64, usize)>,
    /// Greatest tension over what the cable may bear, its limit or its breaking force.
    pub share_of_limit: f64,
    /// Whether P or an anchor point is below `ground_z`, or, where the file has none, below what robots stand
    /// on.
    pub below_ground: bool,
}

impl InWind {
    /// Distance of P from where it was [m].
    pub fn moved(&self) -> f64 {
        self.displacement.norm()
    }

    /// The greatest tension at either end [N], and the index of its cable.
    pub fn greatest_tension(&self) -> (f64, usize) {
        let each = self.rest.tensions().into_iter().zip(&self.rest.exit_tensions).enumerate();
        let each = each.map(|(i, (anchor, exit))| (anchor.max(*exit), i));
        each.fold((0.0, 0), |a, b| if b.0 > a.0 { b } else { a })
    }

    /// The most serious limit that a tension passes at the end where it is limited, and of such ones that
    /// which is passed most.
    pub fn gravest(&self) -> Option<&OutOfLimits> {
        let passed = self.out_of_limits.iter().filter(|one| one.limit != Limit::MaxElsewhere);
        passed.min_by(|a, b| a.limit.cmp(&b.limit).then(b.excess().total_cmp(&a.excess())))
    }
}

/// A platform in wind from all directions, or in one wind.
#[derive(Clone, Debug, PartialEq)]
pub struct Winds {
    /// Every azimuth that was looked at [rad], with why no rest was found in that wind: those of the first
    /// [`DIRECTIONS`], then those of the searches.
    pub failures: Vec<(Option<f64>, StaticsError)>,
    /// The winds with a rest, in the same order.
    pub rests: Vec<InWind>,
}

impl Winds {
    /// The wind that moves the platform farthest.
    pub fn farthest(&self) -> Option<&InWind> {
        self.rests.iter().max_by(|a, b| a.moved().total_cmp(&b.moved()))
    }

    /// The wind with the greatest tension.
    pub fn tightest(&self) -> Option<&InWind> {
        self.rests.iter().max_by(|a, b| a.greatest_tension().0.total_cmp(&b.greatest_tension().0))
    }

    /// The wind with the least safety factor.
    pub fn least_safe(&self) -> Option<(&InWind, f64, usize)> {
        let each = self.rests.iter().filter_map(|one| one.safety_factor.map(|(factor, i)| (one, factor, i)));
        each.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The least tension at the platform [N].
    pub fn least_tension(&self) -> Option<f64> {
        self.rests.iter().flat_map(|one| one.rest.tensions()).min_by(f64::total_cmp)
    }
}

/// How a platform that rests at `at` under a load rests in weather, on winches that do not move.
/// Displacements are those from `from`.
///
/// # Errors
/// [`StaticsError::Invalid`] for weather that cannot be and for a cable without a diameter in wind or ice;
/// those of the direct model without the wind.
pub fn winds(
    robot: &Robot,
    lengths: &[f64],
    load: &Load,
    [at, from]: [&Pose; 2],
    question: &AnyWeather,
) -> Result<Winds, StaticsError> {
    let changed = question.weather.robot(robot)?;
    winds_upon(&changed, &question.weather.lengths(lengths), load, [at, from], question)
}

/// The same for a robot and lengths as the weather has made them.
pub(super) fn winds_upon(
    robot: &Robot,
    lengths: &[f64],
    load: &Load,
    [at, from]: [&Pose; 2],
    question: &AnyWeather,
) -> Result<Winds, StaticsError> {
    let AnyWeather { weather, speed } = question;
    let problem = DirectProblem::new(robot, lengths, load)?;
    let calm = problem.direct(DirectStart::Pose(at))?;
    let blown = Blown { problem: &problem, calm: &calm, from };
    let Some(speed) = *speed else {
        return sorted(vec![(None, blown.by(None, &weather.wind))]);
    };
    let to_base = to_base(robot);
    let by = |azimuth: f64| {
        let velocity = speed * to_base * Vector3::new(azimuth.cos(), azimuth.sin(), 0.0);
        let wind = weather.wind.with_velocity(velocity);
        (Some(azimuth), wind.and_then(|wind| blown.by(Some(azimuth), &wind)))
    };
    let step = TAU / DIRECTIONS as f64;
    let mut found: Vec<_> = (0..DIRECTIONS).into_par_iter().map(|k| by(step * k as f64)).collect();
    let places = |measure: &fn(&InWind) -> f64| -> Vec<_> {
        let values: Vec<f64> = found.iter().map(|(_, outcome)| worse(*measure, outcome)).collect();
        nearly_greatest(&values).into_iter().map(|k| (*measure, k as f64)).collect()
    };
    // Where cables bear alike, the greatest tension decides.
    let alike = robot.cables.iter().all(|cable| {
        let bears = |of: &RobotCable| (of.properties.breaking_force, of.tension_limits);
        bears(cable) == bears(&robot.cables[0])
    });
    let measures = &MEASURES[..if alike { 3 } else { 4 }];
    let searches: Vec<_> = measures.iter().flat_map(places).collect();
    let search = |(measure, k): (fn(&InWind) -> f64, f64)| {
        golden_section([k - 1.0, k + 1.0].map(|k| k * step), by, |outcome| worse(measure, &outcome.1))
    };
    found.extend(searches.into_par_iter().map(search).collect::<Vec<_>>().into_iter().flatten());
    sorted(found)
}

type Outcome = Result<InWind, StaticsError>;

/// What makes a wind worse than another.
const MEASURES: [fn(&InWind) -> f64; 4] = [
    InWind::moved,
    |one| one.greatest_tension().0,
    |one| -one.rest.tensions().into_iter().fold(f64::INFINITY, f64::min),
    |one| one.share_of_limit,
];

/// How bad a wind is by a measure.
fn worse(measure: fn(&InWind) -> f64, outcome: &Outcome) -> f64 {
    outcome.as_ref().map_or(f64::NEG_INFINITY, measure)
}

/// Places of a circle whose values are not below those next to them, and less than [`NEARLY`] below the
/// greatest one.
fn nearly_greatest(values: &[f64]) -> Vec<usize> {
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let [least, most] = [finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max)];
    let n = values.len();
    let is_peak = |k: &usize| {
        let (before, here, after) = (values[(k + n - 1) % n], values[*k], values[(k + 1) % n]);
        // Of equal values next to each other the last one counts.
        here >= before && here > after && here >= most - NEARLY * (most - least)
    };
    (0..n).filter(is_peak).collect()
}

/// What was found at the places where the greatest value between two bounds was sought.
fn golden_section<T>(
    [mut low, mut high]: [f64; 2],
    at: impl Fn(f64) -> T,
    value: impl Fn(&T) -> f64,
) -> Vec<T> {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let mut inner = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let mut outcomes = inner.map(&at);
    let mut found = Vec::with_capacity(STEPS + 2);
    for _ in 0..STEPS {
        // The part beyond the lesser of two inner points is left out.
        let upper = value(&outcomes[1]) > value(&outcomes[0]);
        let next = if upper {
            low = inner[0];
            inner = [inner[1], low + GOLDEN * (high - low)];
            inner[1]
        } else {
            high = inner[1];
            inner = [high - GOLDEN * (high - low), inner[0]];
            inner[0]
        };
        outcomes.swap(0, 1);
        found.push(std::mem::replace(&mut outcomes[usize::from(upper)], at(next)));
    }
    found.extend(outcomes);
    found
}

/// Rests and failures; what is wrong with the question itself is an error.
fn sorted(found: Vec<(Option<f64>, Outcome)>) -> Result<Winds, StaticsError> {
    let mut winds = Winds { failures: Vec::new(), rests: Vec::new() };
    for (azimuth, outcome) in found {
        match outcome {
            Ok(rest) => winds.rests.push(rest),
            Err(error @ StaticsError::Invalid { .. }) => return Err(error),
            Err(error) => winds.failures.push((azimuth, error)),
        }
    }
    Ok(winds)
}

/// A robot whose cables the wind blows on.
struct Blown<'a> {
    problem: &'a DirectProblem<'a>,
    calm: &'a DirectSolution,
    from: &'a Pose,
}

impl Blown<'_> {
    fn by(&self, azimuth: Option<f64>, wind: &Wind) -> Result<InWind, StaticsError> {
        let robot = self.problem.robot();
        let rest = self.problem.in_wind(wind, self.calm)?;
        let ends = rest.tensions().into_iter().zip(&rest.exit_tensions);
        let ends: Vec<[f64; 2]> = ends.map(|(anchor, exit)| [anchor, *exit]).collect();
        let all: Vec<usize> = (0..ends.len()).collect();
        let [before, after] =
            [self.from, &rest.pose].map(|pose| UnitQuaternion::from_rotation_matrix(&pose.rotation));
        Ok(InWind {
            azimuth,
            displacement: rest.pose.position - self.from.position,
            turned: before.angle_to(&after),
            out_of_limits: tensions_out_of_limits(robot, std::slice::from_ref(&ends)),
            safety_factor: safety_factor(robot, &all, &ends),
            share_of_limit: share_of_limit(robot, &ends),
            below_ground: is_below_floor(robot, self.from, &rest.pose),
            rest,
        })
    }
}

/// Greatest tension over limit or breaking force of all cables.
fn share_of_limit(robot: &Robot, tensions: &[[f64; 2]]) -> f64 {
    let of_cable = |(i, [anchor, exit]): (usize, &[f64; 2])| {
        let limited = if robot.max_at(i).is_anchor() { *anchor } else { *exit };
        let breaking = robot.cables[i].properties.breaking_force.unwrap_or(f64::INFINITY);
        (limited / robot.limits(i).max).max(anchor.max(*exit) / breaking)
    };
    tensions.iter().enumerate().map(of_cable).fold(0.0, f64::max)
}

/// Least breaking force over greatest tension of these cables; `None` where one of them has no breaking
/// force: it may be the first to break.
pub(super) fn safety_factor(robot: &Robot, cables: &[usize], tensions: &[[f64; 2]]) -> Option<(f64, usize)> {
    let factor = |i: &usize| {
        let force = robot.cables[*i].properties.breaking_force?;
        Some((force / tensions[*i][0].max(tensions[*i][1]), *i))
    };
    let factors: Vec<_> = cables.iter().map(factor).collect::<Option<_>>()?;
    factors.into_iter().min_by(|a, b| a.0.total_cmp(&b.0))
}
