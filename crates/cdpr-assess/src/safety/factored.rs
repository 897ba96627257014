//! The cases of a proof by partial factors: the whole robot, each break, the worst wind.
//!
//! The winches stand still with the lengths that hold the pose under the loads without factors. Then the
//! design loads act: where the platform comes to rest downhill of the pose, with which tensions, and how much
//! of the design resistance of its cables they are.

use crate::safety::factors::{CaseFactors, PartialFactors};
use crate::safety::winds::{AnyWeather, InWind, Winds, winds_upon};
use crate::safety::{Broken, BrokenRest, Safety, Swing, rest_without};
use cdpr_robot::{Pose, Robot};
use cdpr_statics::{Load, StaticsError};
use std::f64::consts::FRAC_PI_2;

/// What a case of a proof is about.
#[derive(Clone, Debug, PartialEq)]
pub enum Situation {
    /// No cable is broken, without weather.
    Intact,
    /// Cables with these indices, from 0, are broken.
    Broken(Vec<usize>),
    /// No cable is broken, in the worst wind from any direction or in the weather of one velocity, with the
    /// azimuth in which it blows [rad].
    Weather(Option<f64>),
}

/// A case of a proof.
#[derive(Clone, Debug, PartialEq)]
pub struct FactoredCase {
    /// What it is about.
    pub situation: Situation,
    /// Its factors.
    pub factors: CaseFactors,
    /// Where the platform rests under the design loads, or why no rest was found.
    pub rest: Result<FactoredRest, StaticsError>,
    /// How much the motion after a break makes of the cables, if it is followed.
    pub swing: Option<FactoredSwing>,
}

/// A platform at rest under design loads.
#[derive(Clone, Debug, PartialEq)]
pub struct FactoredRest {
    /// Distance of P from where it was [m].
    pub moved: f64,
    /// Angle of the rotation from where it was [rad], at most π.
    pub turned: f64,
    /// Greatest tension of each cable at either end [N], zero for a broken one.
    pub tensions: Vec<f64>,
    /// Indices of cables that are slack and not broken; none are named in weather.
    pub slack: Vec<usize>,
    /// Whether P or an anchor point is below the ground, as in [`BrokenRest::below_ground`].
    pub below_ground: bool,
    /// The greatest utilization of those cables whose breaking force is known.
    pub utilization: Option<Utilization>,
    /// Indices of the cables that are not broken and whose breaking force is not known.
    pub unknown: Vec<usize>,
}

/// What a motion after a break makes of the cables. Its tensions are those under the loads without factors,
/// multiplied by the greater factor of a load.
#[derive(Clone, Debug, PartialEq)]
pub enum FactoredSwing {
    /// The greatest utilization of those cables whose breaking force is known, and whether the platform comes
    /// below the ground.
    Followed(Option<Utilization>, bool),
    /// Why the motion is not known.
    Failed(String),
}

/// How much of its design resistance the tension of a cable is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Utilization {
    /// Index of the cable, from 0.
    pub cable: usize,
    /// Its greatest tension at either end under the design loads [N].
    pub tension: f64,
    /// Its breaking force over the factor of the resistance [N].
    pub resistance: f64,
}

impl Utilization {
    /// Tension over resistance: more than 1 is too much.
    pub fn value(&self) -> f64 {
        self.tension / self.resistance
    }

    /// The greatest one of these cables.
    fn greatest(robot: &Robot, cables: &[usize], tensions: &[f64], by: f64) -> Option<Self> {
        let of = |i: &usize| {
            let resistance = robot.cables[*i].properties.breaking_force? / by;
            Some(Self { cable: *i, tension: tensions[*i], resistance })
        };
        cables.iter().filter_map(of).max_by(|a, b| a.value().total_cmp(&b.value()))
    }
}

impl FactoredCase {
    /// The greatest utilization that is known, at rest or on the way there.
    pub fn known(&self) -> Option<Utilization> {
        let at_rest = self.rest.as_ref().ok().and_then(|rest| rest.utilization);
        let swinging = match self.swing {
            Some(FactoredSwing::Followed(peak, _)) => peak,
            _ => None,
        };
        at_rest.into_iter().chain(swinging).max_by(|a, b| a.value().total_cmp(&b.value()))
    }

    /// The cable with the greatest known utilization, or else with the greatest tension, and its tension [N].
    pub fn most_loaded(&self) -> Option<(usize, f64)> {
        let tightest = || {
            let all = self.rest.as_ref().ok()?.tensions.iter().copied().enumerate();
            all.max_by(|a, b| a.1.total_cmp(&b.1))
        };
        self.known().map(|most| (most.cable, most.tension)).or_else(tightest)
    }

    /// Whether the tension of a cable is greater than its design resistance.
    pub fn is_exceeded(&self) -> bool {
        self.known().is_some_and(|most| most.value() > 1.0)
    }

    /// The utilization, where nothing about it is open, or so much as is known exceeds the resistance.
    pub fn utilization(&self) -> Option<Utilization> {
        self.known().filter(|_| self.open().is_none() || self.is_exceeded())
    }

    /// Why its utilization is not known, in words: no rest, a platform on the ground or turned over, a cable
    /// without breaking force.
    pub fn open(&self) -> Option<String> {
        let rest = match &self.rest {
            Err(error) => return Some(format!("no rest was found: {error}")),
            Ok(rest) => rest,
        };
        let on_the_way = match &self.swing {
            Some(FactoredSwing::Failed(why)) => return Some(format!("its motion is not known: {why}")),
            Some(FactoredSwing::Followed(_, below)) => *below,
            None => false,
        };
        if rest.below_ground || on_the_way {
            return Some("the platform comes below the ground".to_owned());
        }
        if rest.turned > FRAC_PI_2 {
            return Some("the platform turns over, perhaps into its cables".to_owned());
        }
        match rest.unknown.as_slice() {
            [] if rest.tensions.iter().all(|tension| *tension == 0.0) => Some("no cable is left".to_owned()),
            [] => None,
            [one] => Some(format!("cable {} has no breaking_force", one + 1)),
            _ if rest.utilization.is_none() => Some("no cable has a breaking_force".to_owned()),
            all => {
                let names: Vec<String> = all.iter().map(|i| (i + 1).to_string()).collect();
                Some(format!("cables {} have no breaking_force", names.join(", ")))
            }
        }
    }
}

impl FactoredRest {
    /// The rest of a robot with its given breaking forces.
    fn new(robot: &Robot, rest: &BrokenRest, broken: &[usize], by: f64) -> Self {
        let tensions: Vec<f64> = rest.tensions.iter().map(|ends| ends[0].max(ends[1])).collect();
        let blank = Self::blank(tensions, [rest.moved, rest.turned], rest.below_ground);
        Self { slack: rest.slack.clone(), ..blank }.utilized(robot, broken, by)
    }

    fn in_wind(robot: &Robot, found: &InWind, by: f64) -> Self {
        let ends = found.rest.tensions().into_iter().zip(&found.rest.exit_tensions);
        let tensions = ends.map(|(anchor, exit)| anchor.max(*exit)).collect();
        Self::blank(tensions, [found.moved(), found.turned], found.below_ground).utilized(robot, &[], by)
    }

    fn blank(tensions: Vec<f64>, [moved, turned]: [f64; 2], below_ground: bool) -> Self {
        let (slack, unknown) = (Vec::new(), Vec::new());
        Self { moved, turned, tensions, slack, below_ground, utilization: None, unknown }
    }

    fn utilized(self, robot: &Robot, broken: &[usize], by: f64) -> Self {
        let kept: Vec<usize> = (0..robot.cables.len()).filter(|i| !broken.contains(i)).collect();
        let utilization = Utilization::greatest(robot, &kept, &self.tensions, by);
        let is_known = |i: &usize| robot.cables[*i].properties.breaking_force.is_some();
        Self { utilization, unknown: kept.into_iter().filter(|i| !is_known(i)).collect(), ..self }
    }
}

/// The cases of a proof: the whole robot, each break of `held`, and the weather if there is any.
///
/// In a wind from any direction the worst one is that of the greatest utilization; a wind in which no rest is
/// found is a case of its own. `held` is the robot under the same load without factors, and the winds are
/// those of [`crate::winds`] from there.
///
/// # Errors
/// Those of [`PartialFactors::check`] and of weather that cannot be.
pub fn factored_cases(
    robot: &Robot,
    held: &Safety,
    load: &Load,
    factors: &PartialFactors,
    weather: Option<(&AnyWeather, &Winds)>,
) -> Result<Vec<FactoredCase>, StaticsError> {
    factors.check()?;
    let PartialFactors { persistent, accidental } = *factors;
    let intact = intact(robot, held, load, persistent);
    // Without a rest under the design loads alone the search in the wind begins where the platform was.
    let from = intact.as_ref().map_or(held.pose, |(_, pose)| *pose);
    let mut cases = vec![FactoredCase {
        situation: Situation::Intact,
        factors: persistent,
        rest: intact.map(|(rest, _)| rest),
        swing: None,
    }];
    cases.extend(held.broken.iter().map(|broken| after_break(robot, held, load, broken, accidental)));
    let Some((question, given)) = weather else { return Ok(cases) };
    if persistent.has_given_loads() {
        cases.extend(in_weather(robot, given, persistent));
        return Ok(cases);
    }
    let design = persistent.weather(question)?;
    let changed = persistent.robot_in(&design.weather, robot)?;
    let (lengths, load) = (design.weather.lengths(&held.lengths), persistent.load(load));
    match winds_upon(&changed, &lengths, &load, [&from, &held.pose], &design) {
        Err(error @ StaticsError::Invalid { .. }) => return Err(error),
        Err(error) => cases.push(weather_case(persistent, None, Err(error))),
        Ok(found) => cases.extend(in_weather(robot, &found, persistent)),
    }
    Ok(cases)
}

/// The case with the greatest utilization; `None` where a case is open and none exceeds its resistance.
pub fn governing(cases: &[FactoredCase]) -> Option<(&FactoredCase, Utilization)> {
    let settled =
        cases.iter().any(FactoredCase::is_exceeded) || cases.iter().all(|case| case.open().is_none());
    let known = cases.iter().filter_map(|case| Some((case, case.utilization()?)));
    known.filter(|_| settled).max_by(|a, b| a.1.value().total_cmp(&b.1.value()))
}

/// The whole robot under the design loads, and its pose.
fn intact(
    robot: &Robot,
    held: &Safety,
    load: &Load,
    factors: CaseFactors,
) -> Result<(FactoredRest, Pose), StaticsError> {
    if !factors.has_given_loads() {
        let changed = factors.robot(robot);
        let rest = rest_without(&changed, &[], &held.lengths, &factors.load(load), &held.pose)?;
        let pose = rest.pose;
        return Ok((FactoredRest::new(robot, &rest, &[], factors.resistance), pose));
    }
    // It is where it is held.
    let ends = held.tensions.iter().zip(&held.exit_tensions);
    let tensions = ends.map(|(anchor, exit)| anchor.max(*exit)).collect();
    let rest = FactoredRest::blank(tensions, [0.0; 2], false);
    Ok((rest.utilized(robot, &[], factors.resistance), held.pose))
}

/// A break under the loads of the accidental situation.
fn after_break(
    robot: &Robot,
    held: &Safety,
    load: &Load,
    broken: &Broken,
    factors: CaseFactors,
) -> FactoredCase {
    let cables = &broken.cables;
    let rest = match factors.has_given_loads() {
        true => broken.rest.clone(),
        false => {
            let changed = factors.robot(robot);
            rest_without(&changed, cables, &held.lengths, &factors.load(load), &held.pose)
        }
    };
    let swing = broken.swing.as_ref().map(|swing| match swing {
        Err(error) => FactoredSwing::Failed(error.to_string()),
        Ok(swing) => FactoredSwing::Followed(peak(robot, swing, factors), swing.below_ground),
    });
    FactoredCase {
        situation: Situation::Broken(cables.clone()),
        factors,
        rest: rest.map(|rest| FactoredRest::new(robot, &rest, cables, factors.resistance)),
        swing,
    }
}

/// The greatest utilization in a motion.
fn peak(robot: &Robot, swing: &Swing, factors: CaseFactors) -> Option<Utilization> {
    let (margin, cable) = swing.safety_factor?;
    let force = robot.cables[cable].properties.breaking_force?;
    let tension = factors.of_effects() * force / margin;
    Some(Utilization { cable, tension, resistance: force / factors.resistance })
}

/// The worst wind, one without a rest, and one that takes the platform below the ground.
fn in_weather(robot: &Robot, found: &Winds, factors: CaseFactors) -> Vec<FactoredCase> {
    let case = |wind: &InWind| {
        let rest = FactoredRest::in_wind(robot, wind, factors.resistance);
        weather_case(factors, wind.azimuth, Ok(rest))
    };
    let worst = found.least_safe().map(|(wind, _, _)| wind).or_else(|| found.tightest());
    let is_new = |wind: &&InWind| worst.is_none_or(|worst| !std::ptr::eq(worst, *wind));
    let below = found.rests.iter().find(|wind| wind.below_ground).filter(is_new);
    let failed = found.failures.first();
    let failed = failed.map(|(azimuth, error)| weather_case(factors, *azimuth, Err(error.clone())));
    worst.map(case).into_iter().chain(below.map(case)).chain(failed).collect()
}

fn weather_case(
    factors: CaseFactors,
    azimuth: Option<f64>,
    rest: Result<FactoredRest, StaticsError>,
) -> FactoredCase {
    FactoredCase { situation: Situation::Weather(azimuth), factors, rest, swing: None }
}
