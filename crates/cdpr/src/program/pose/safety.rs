//! `cdpr safety`: what becomes of the platform when a cable breaks, and in weather.

mod case;
mod proof;
mod row;
mod weather;

use crate::program::answer::numbers;
use crate::program::arguments::poses::as_numbers;
use crate::program::arguments::{
    FACTORS, FreeArguments, WEATHER, With, any_weather, factors, note_pulleys, number, with,
};
use crate::program::error::ProgramError;
use crate::program::output::{Ending, print_sentence, table};
use crate::program::pose::at_pose::RobotAtPose;
use crate::program::pose::modes::with_inertia;
use crate::program::pose::safety::case::{Case, Factor, Greatest, Rest};
use crate::program::pose::safety::proof::Proof;
use crate::program::pose::safety::weather::InWeather;
use cdpr_assess::{
    AnyWeather, Breaks, Broken, FactoredCase, PartialFactors, Safety, assumed_ground, factored_cases,
    safety_at, winds,
};
use cdpr_robot::{Pose, Robot, short, significant};
use cdpr_statics::{Load, StaticsError, WantedPose};
use serde::Serialize;
use std::borrow::Cow;

/// The robot, its poses, and what breaks.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    at: RobotAtPose,
    #[command(flatten)]
    free: FreeArguments,
    /// pairs: break every pair of cables, too. swing=SECONDS: follow the motion after each break for so long,
    /// without damping. wind=SPEED: wind on the cables, all of them whole, from any horizontal direction;
    /// ice= and others. permanent=, variable=, resistance=, accidental=: partial factors of a norm.
    ///
    /// permanent multiplies the weight of platform and cables, variable the payload, force, moment and the
    /// pressure of the wind; resistance divides the breaking forces; accidental multiplies all loads where a
    /// cable is broken. accidental=1:0.5 has one factor for weights and one for the other loads,
    /// resistance=1.5:1.2 a second one for broken cables. All four are given together; none has a value of
    /// its own. With one pose, `--format csv` has a row for each case.
    ///
    /// wind=VX:VY:VZ: wind of one velocity [m/s]. ice=METRES, warmer=KELVIN with cable_expansion=,
    /// frame_expansion=, creep=STRAIN, wind_profile=Z0:ZREF: as those of `deflection`. All cables are whole
    /// in the weather.
    #[arg(long, value_name = "NAMES", value_parser = with)]
    with: Option<With>,
}

pub(crate) fn run(Settings { at, free, with }: &Settings) -> Result<Ending, ProgramError> {
    let with = With::known(with.as_ref(), &[&["pairs", "swing", "wind"], &FACTORS[..], &WEATHER].concat())?;
    let (weather, factors) = (any_weather(&with)?, factors(&with)?);
    let load = at.load.load();
    let breaks = Breaks { pairs: with.has("pairs")?, follow: with.value("swing", None, above_zero)? };
    let solve = |robot: &Robot, pose: &Pose| {
        let robot = if breaks.follow.is_some() { with_inertia(robot) } else { Cow::Borrowed(robot) };
        if let Some(AnyWeather { weather, speed }) = &weather {
            note_pulleys(&robot, speed.is_some() || !weather.wind.is_calm());
        }
        let found = safety_at(&robot, WantedPose::at(pose).free(&free.free), &load, breaks)?;
        let found_pose = free.found(&found.pose);
        Ok(Answer { found_pose, ..Answer::new(&robot, found, &load, weather.as_ref(), factors)? })
    };
    at.answer(solve, Answer::print)
}

/// A time [s].
fn above_zero(text: &str) -> Result<f64, String> {
    const MOST: f64 = 1e5;
    let expected = "expected a time above 0 s, and 1e5 s at most".to_owned();
    number(text).and_then(|time| if time > 0.0 && time <= MOST { Ok(time) } else { Err(expected) })
}

/// The robot with each cable broken.
#[derive(Serialize)]
struct Answer {
    /// Unstrained lengths, which the winches keep [m].
    lengths: Vec<f64>,
    /// Tensions before the break at the platform and at the exit points [N].
    tensions: Vec<f64>,
    exit_tensions: Vec<f64>,
    /// Greatest tension allowed, and breaking force of each cable, `null` where it is not known [N].
    #[serde(rename = "greatest_allowed_n")]
    greatest_allowed: Vec<f64>,
    #[serde(rename = "breaking_forces_n")]
    breaking_forces: Vec<Option<f64>>,
    /// The greatest tension before the break, and the safety factor then.
    greatest_tension: Greatest,
    #[serde(flatten)]
    factor: Factor,
    broken: Vec<Case>,
    /// Height that is taken for the ground where the robot file has none, if the platform comes below it [m].
    #[serde(rename = "assumed_ground_m", skip_serializing_if = "Option::is_none")]
    assumed_ground: Option<f64>,
    /// The pose with its free coordinates as they are found.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "as_numbers")]
    found_pose: Option<Pose>,
    /// The whole robot in the weather, if asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    in_weather: Option<InWeather>,
    /// Utilizations by partial factors, if these are given.
    #[serde(skip_serializing_if = "Option::is_none")]
    proof: Option<Proof>,
    /// The cases of the proof, with factors of 1 where none are given.
    #[serde(skip)]
    cases: Vec<FactoredCase>,
}

impl Answer {
    fn new(
        robot: &Robot,
        found: Safety,
        load: &Load,
        weather: Option<&AnyWeather>,
        factors: Option<PartialFactors>,
    ) -> Result<Self, StaticsError> {
        let blown = weather.map(|weather| {
            let blown = winds(robot, &found.lengths, load, [&found.pose, &found.pose], weather)?;
            Ok::<_, StaticsError>((weather, blown))
        });
        let blown = blown.transpose()?;
        let blown = blown.as_ref().map(|(weather, blown)| (*weather, blown));
        let cases = factored_cases(robot, &found, load, &factors.unwrap_or(PartialFactors::ONE), blown)?;
        let ground = assumed_ground(robot, &found.pose);
        let Safety { lengths, tensions, exit_tensions, safety_factor, broken, .. } = found;
        let all = lengths.len();
        let case = |of: Broken| Case { falls: of.cables.len() == all, ..Case::from(of) };
        let ends = tensions.iter().zip(&exit_tensions).map(|(at, exit)| at.max(*exit));
        let greatest = (1..).zip(ends).max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((1, 0.0));
        let broken: Vec<Case> = broken.into_iter().map(case).collect();
        let in_weather = blown.map(|(weather, blown)| InWeather::new(robot, weather, blown, load));
        let is_below = broken.iter().any(Case::is_below_ground)
            || in_weather.as_ref().is_some_and(InWeather::is_below_ground);
        Ok(Self {
            lengths,
            tensions,
            exit_tensions,
            greatest_allowed: (0..all).map(|i| robot.limits(i).max).collect(),
            breaking_forces: robot.cables.iter().map(|cable| cable.properties.breaking_force).collect(),
            greatest_tension: Greatest { cable: greatest.0, tension: greatest.1 },
            factor: safety_factor.into(),
            broken,
            assumed_ground: ground.filter(|_| is_below),
            found_pose: None,
            in_weather,
            proof: factors.map(|factors| Proof::new(factors, &cases)),
            cases,
        })
    }

    /// The case that is greatest by a figure, with the figure.
    fn greatest(&self, figure: impl Fn(&Rest) -> f64) -> Option<(f64, &Case)> {
        let found = self.broken.iter().filter_map(|case| Some((figure(case.rest.as_ref()?), case)));
        found.max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The names of the cases that are so.
    fn names(&self, is: impl Fn(&Case) -> bool) -> String {
        let cases = self.broken.iter().filter(|case| is(case));
        let name = |case: &Case| case.cables.iter().map(ToString::to_string).collect::<Vec<_>>().join("+");
        cases.map(name).collect::<Vec<_>>().join(" ")
    }

    /// Whether the others hold the platform, and what it does at most.
    fn sentences(&self, heading: &str) -> Vec<String> {
        let cases = |what: fn(&Case) -> Option<String>| -> Vec<String> {
            let said = |case: &Case| what(case).map(|what| format!("without {} {what}", case.name()));
            self.broken.iter().filter_map(said).collect()
        };
        let (bad, wrong) = (cases(Case::bad), cases(Case::wrong));
        let unknown = match wrong.len() - bad.len() {
            unknown if unknown > 0 && !bad.is_empty() => {
                format!(" What {unknown} of {} breaks lead to is not known.", self.broken.len())
            }
            _ => String::new(),
        };
        let pairs = self.broken.iter().any(|case| case.cables.len() > 1);
        let all = if pairs { "one or two of them break" } else { "of them breaks" };
        let first = match bad.as_slice() {
            [] if !wrong.is_empty() => {
                let why = self.broken.iter().find_map(Case::failure);
                let why = why.map_or_else(String::new, |why| format!(" ({why})"));
                format!("{heading}: whether it bears every break is not known; {}{why}.", wrong[0])
            }
            [] => format!("{heading} comes to rest on its other cables, whichever {all}."),
            [first] => format!("{heading} does not bear every break: {first}."),
            [first, rest @ ..] => format!(
                "{heading} does not bear every break: {} of {} end badly; {first}.",
                rest.len() + 1,
                self.broken.len()
            ),
        };
        let moved = self.greatest(|rest| rest.moved_mm).zip(self.greatest(|rest| rest.turned_deg));
        let moved = moved.map(|((moved, far), (turned, most))| {
            // The rotation of a point mass is held.
            let is_held = turned == 0.0;
            let (moved, turned) = (significant(1e-3 * moved, 4), significant(turned, 4));
            let turned = format!(" and turns up to {turned} degrees (without {})", most.name());
            let turned = if is_held { String::new() } else { turned };
            format!("It moves up to {moved} m (without {}){turned}.", far.name())
        });
        let tension = self.greatest(|rest| rest.greatest_tension.tension);
        let tension = tension.and_then(|(tension, case)| Some((tension, case, case.rest.as_ref()?)));
        let tension = tension.map(|(tension, case, rest)| {
            let cable = rest.greatest_tension.cable;
            let tension = significant(tension, 4);
            format!("Tensions at rest reach {tension} N, in cable {cable} without {}.", case.name())
        });
        let swings = || self.broken.iter().filter_map(|case| Some((case.swinging()?, case)));
        let peaks = swings().map(|(swing, case)| (swing.greatest_tension, swing.tension_difference, case));
        let peak = peaks.max_by(|a, b| a.0.tension.total_cmp(&b.0.tension)).map(|(peak, differ, case)| {
            let (tension, differ) = (significant(peak.tension, 4), significant(differ, 2));
            let reached = format!("{tension} N, in cable {} without {}", peak.cable, case.name());
            let differ = format!("two computations of it differ by up to {differ} N");
            format!("In the time followed they reach {reached}; {differ}.")
        });
        [Some(first + &unknown), moved, tension, peak].into_iter().flatten().collect()
    }

    /// What tensions are compared with.
    fn strength(&self) -> String {
        let all = |values: &[f64]| {
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            let greatest = values.iter().copied().fold(0.0, f64::max);
            let [least, greatest] = [least, greatest].map(|force| significant(force, 5));
            if least == greatest { format!("{least} N") } else { format!("{least} to {greatest} N") }
        };
        let allowed = all(&self.greatest_allowed);
        let known: Vec<f64> = self.breaking_forces.iter().copied().flatten().collect();
        let strength = match known.len() {
            0 => "no breaking force is known, so that there are no safety factors".to_owned(),
            some if some < self.breaking_forces.len() => {
                format!(
                    "the breaking force, known of {some} cables, is {}; there is no safety factor with \
                     another cable, which may be the first to break",
                    all(&known)
                )
            }
            _ => format!("the breaking force is {}", all(&known)),
        };
        format!("The greatest tension allowed is {allowed}; {strength}.")
    }

    fn print(&self, heading: &str) {
        let followed = self.broken.iter().any(|case| case.swing.is_some());
        self.proof.iter().for_each(|proof| proof.print(heading, followed));
        let in_weather = self.in_weather.iter().flat_map(|weather| weather.sentences(heading));
        for sentence in in_weather.chain(self.sentences(heading)) {
            print_sentence(&sentence);
        }
        let mut rows = table(match followed {
            true => {
                &["broken", "moves [m]", "at rest [N]", "swings [m]", "peak [N]", "in cable", "safety factor"]
            }
            false => &["broken", "moves [m]", "turns [deg]", "greatest [N]", "in cable", "safety factor"][..],
        });
        let Greatest { cable, tension } = self.greatest_tension;
        let (still, tension) = ("0".to_owned(), significant(tension, 4));
        let [cable, least] = [cable.to_string(), self.factor.cell(cable)];
        rows.add_row(match followed {
            true => ["none".to_owned(), still, tension, String::new(), String::new(), cable, least].to_vec(),
            false => ["none".to_owned(), still.clone(), still, tension, cable, least].to_vec(),
        });
        let mut remarks: Vec<(String, Vec<String>)> = Vec::new();
        for case in &self.broken {
            let cells = if followed { case.with_swing() } else { case.at_rest() };
            rows.add_row([numbers(&case.cables)].into_iter().chain(cells));
            let (remark, cables) = (case.remark(), case.cables.iter().map(ToString::to_string));
            let cables = cables.collect::<Vec<_>>().join("+");
            match remarks.iter_mut().find(|(known, _)| *known == remark) {
                Some((_, cases)) => cases.push(cables),
                None => remarks.push((remark, vec![cables])),
            }
        }
        println!("{rows}");
        for (remark, cases) in remarks.iter().filter(|(remark, _)| !remark.is_empty()) {
            print_sentence(&format!("Without {}: {remark}.", cases.join(" or ")));
        }
        if let Some(ground) = self.assumed_ground {
            print_sentence(&format!(
                "The robot file has no `ground_z`: the ground is assumed at z = {} m.",
                short(ground)
            ));
        }
        print_sentence(&self.strength());
        print_sentence(if followed {
            "The winches stand still. Swings and peaks are those of the time followed, without damping. `±` \
             is how much two computations of the tensions differ, `~` marks a peak of which that is more \
             than 10 %. `>` marks a platform that still moved away at the end, and a safety factor that is \
             greater than this."
        } else {
            "These are rests while the winches stand still. On the way there the platform swings and tensions \
             are greater: --with swing=SECONDS follows it."
        });
    }
}
