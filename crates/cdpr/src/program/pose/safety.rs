//! `cdpr safety`: what becomes of the platform when a cable breaks.

use crate::program::answer::{OutOfLimits, Residual, decimal, numbers};
use crate::program::arguments::{FreeArguments, With, number, with};
use crate::program::error::ProgramError;
use crate::program::output::{Ending, print_sentence, table};
use crate::program::pose::at_pose::{Failure, RobotAtPose, Row};
use crate::program::pose::modes::with_inertia;
use cdpr_assess::{Breaks, Broken, BrokenRest, Safety, Swing, safety_at};
use cdpr_robot::{Pose, Robot, significant};
use cdpr_statics::WantedPose;
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
    /// without damping.
    #[arg(long, value_name = "NAMES", value_parser = with)]
    with: Option<With>,
}

pub(crate) fn run(Settings { at, free, with }: &Settings) -> Result<Ending, ProgramError> {
    let with = with.clone().unwrap_or_default();
    with.check(&["pairs", "swing"])?;
    let load = at.load.load();
    let breaks = Breaks { pairs: with.has("pairs")?, follow: with.value("swing", None, above_zero)? };
    let solve = |robot: &Robot, pose: &Pose| {
        let robot = if breaks.follow.is_some() { with_inertia(robot) } else { Cow::Borrowed(robot) };
        let found = safety_at(&robot, WantedPose::at(pose).free(&free.free), &load, breaks)?;
        Ok(Answer::from(found))
    };
    at.answer(solve, Answer::print)
}

/// A time [s].
fn above_zero(text: &str) -> Result<f64, String> {
    number(text)
        .and_then(|time| if time > 0.0 { Ok(time) } else { Err("expected a time above 0 s".to_owned()) })
}

/// The robot with each cable broken.
#[derive(Serialize)]
struct Answer {
    /// Unstrained lengths, which the winches keep [m].
    lengths: Vec<f64>,
    /// Tensions before the break [N].
    tensions: Vec<f64>,
    broken: Vec<Case>,
}

/// What becomes of the platform without these cables.
#[derive(Serialize)]
struct Case {
    /// Their numbers.
    cables: Vec<usize>,
    #[serde(flatten)]
    rest: Option<Rest>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<Failure>,
    /// The motion after the break, if it is followed.
    #[serde(skip_serializing_if = "Option::is_none")]
    swing: Option<Motion>,
}

/// How the platform swings, or why that is not known.
#[derive(Serialize)]
#[serde(untagged)]
enum Motion {
    Followed(Swinging),
    Failed { error: String },
}

/// How the platform swings.
#[derive(Serialize)]
struct Swinging {
    /// Greatest distance from where it was [m].
    moved: f64,
    greatest_tension: Greatest,
    /// When that is [s].
    time: f64,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    out_of_limits: Vec<OutOfLimits>,
    safety_factor: Option<f64>,
    below_ground: bool,
    /// Difference of two computations in the tensions [N].
    tension_difference: f64,
}

/// Where the platform comes to rest.
#[derive(Serialize)]
struct Rest {
    /// Position of P [m] and quaternion, qw first.
    position: [f64; 3],
    rotation: [f64; 4],
    moved: f64,
    turned_deg: f64,
    /// At the platform and at the exit points [N], zero for a broken cable.
    tensions: Vec<f64>,
    exit_tensions: Vec<f64>,
    greatest_tension: Greatest,
    slack_cables: Vec<usize>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    out_of_limits: Vec<OutOfLimits>,
    /// Least breaking force over greatest tension; `null` where no breaking force is known.
    safety_factor: Option<f64>,
    below_ground: bool,
    residual: Residual,
}

/// A tension at either end of a cable [N].
#[derive(Clone, Copy, Serialize)]
struct Greatest {
    cable: usize,
    tension: f64,
}

impl From<BrokenRest> for Rest {
    fn from(rest: BrokenRest) -> Self {
        let (tension, cable) = rest.greatest_tension();
        let [_, _, _, qw, qx, qy, qz] = crate::program::arguments::poses::pose_numbers(&rest.pose);
        Self {
            position: rest.pose.position.into(),
            rotation: [qw, qx, qy, qz],
            moved: rest.moved,
            turned_deg: rest.turned.to_degrees(),
            tensions: rest.tensions.iter().map(|ends| ends[0]).collect(),
            exit_tensions: rest.tensions.iter().map(|ends| ends[1]).collect(),
            greatest_tension: Greatest { cable: cable + 1, tension },
            slack_cables: rest.slack.iter().map(|i| i + 1).collect(),
            out_of_limits: rest.out_of_limits.into_iter().map(OutOfLimits::new).collect(),
            safety_factor: rest.safety_factor.map(|(factor, _)| factor),
            below_ground: rest.below_ground,
            residual: Residual::new(&rest.residual),
        }
    }
}

impl From<Swing> for Swinging {
    fn from(swing: Swing) -> Self {
        let (tension, cable, time) = swing.greatest;
        Self {
            moved: swing.moved,
            greatest_tension: Greatest { cable: cable + 1, tension },
            time,
            out_of_limits: swing.out_of_limits.into_iter().map(OutOfLimits::new).collect(),
            safety_factor: swing.safety_factor.map(|(factor, _)| factor),
            below_ground: swing.below_ground,
            tension_difference: swing.difference.tension,
        }
    }
}

impl From<Broken> for Case {
    fn from(Broken { cables, rest, swing }: Broken) -> Self {
        let cables = cables.into_iter().map(|i| i + 1).collect();
        let swing = swing.map(|swing| match swing {
            Ok(swing) => Motion::Followed(swing.into()),
            Err(error) => Motion::Failed { error: error.to_string() },
        });
        match rest {
            Ok(rest) => Self { cables, rest: Some(rest.into()), error: None, swing },
            Err(error) => Self { cables, rest: None, error: Some(error.into()), swing },
        }
    }
}

impl From<Safety> for Answer {
    fn from(Safety { lengths, tensions, broken, .. }: Safety) -> Self {
        Self { lengths, tensions, broken: broken.into_iter().map(Case::from).collect() }
    }
}

impl Case {
    /// `cable 3`, `cables 3, 4`.
    fn name(&self) -> String {
        format!("cable{} {}", if self.cables.len() > 1 { "s" } else { "" }, numbers(&self.cables))
    }

    /// The motion, where it is known.
    fn swinging(&self) -> Option<&Swinging> {
        match &self.swing {
            Some(Motion::Followed(swing)) => Some(swing),
            _ => None,
        }
    }

    /// What is wrong without these cables, at rest or on the way there.
    fn wrong(&self) -> Option<String> {
        let Some(rest) = &self.rest else { return Some("no rest was found".to_owned()) };
        let swing = self.swinging();
        let swinging = swing.map_or(&[][..], |swing| &swing.out_of_limits);
        let at_rest = rest.out_of_limits.iter().map(|one| (one, ""));
        let beyond = at_rest.chain(swinging.iter().map(|one| (one, " on the way")));
        let beyond = beyond.filter(|(one, _)| one.is_too_much());
        let beyond = beyond.min_by_key(|(one, _)| one.limit != "breaking_force");
        let beyond = beyond.map(|(one, when)| match one.limit {
            "breaking_force" => format!("cable {} breaks, too{when}", one.cable),
            _ => format!("cable {} is above its greatest tension{when}", one.cable),
        });
        let below = rest.below_ground || swing.is_some_and(|swing| swing.below_ground);
        beyond.or_else(|| below.then(|| "the platform comes below the ground".to_owned())).or_else(|| {
            matches!(self.swing, Some(Motion::Failed { .. })).then(|| "its motion is not known".to_owned())
        })
    }

    /// How far the platform moves and turns, the greatest tension at rest, its cable, and the factor.
    fn at_rest(&self) -> Vec<String> {
        let Some(rest) = &self.rest else { return vec![String::new(); 5] };
        let Greatest { cable, tension } = rest.greatest_tension;
        let (moved, turned) = (significant(rest.moved, 4), decimal(rest.turned_deg, 2));
        vec![moved, turned, significant(tension, 4), cable.to_string(), factor(rest.safety_factor)]
    }

    /// How far the platform moves, the greatest tension at rest; how far it swings, the greatest tension then, its
    /// cable, and the factor.
    fn with_swing(&self) -> Vec<String> {
        let rest = self
            .rest
            .as_ref()
            .map(|rest| [significant(rest.moved, 4), significant(rest.greatest_tension.tension, 4)]);
        let swing = self.swinging().map(|swing| {
            let Greatest { cable, tension } = swing.greatest_tension;
            let (moved, tension) = (significant(swing.moved, 4), significant(tension, 4));
            [moved, tension, cable.to_string(), factor(swing.safety_factor)]
        });
        rest.unwrap_or_default().into_iter().chain(swing.unwrap_or_default()).collect()
    }

    /// What is to be said of it in a table.
    fn remark(&self) -> String {
        let Some(rest) = &self.rest else {
            return self.error.as_ref().map_or_else(String::new, |error| error.message.clone());
        };
        let slack =
            (!rest.slack_cables.is_empty()).then(|| format!("slack: {}", numbers(&rest.slack_cables)));
        self.wrong().into_iter().chain(slack).collect::<Vec<_>>().join("; ")
    }
}

/// A safety factor in a table; empty where it is not known.
fn factor(factor: Option<f64>) -> String {
    factor.map_or_else(String::new, |factor| significant(factor, 3))
}

impl Answer {
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
        let wrong: Vec<String> = self
            .broken
            .iter()
            .filter_map(|case| case.wrong().map(|what| format!("without {} {what}", case.name())))
            .collect();
        let pairs = self.broken.iter().any(|case| case.cables.len() > 1);
        let all = if pairs { "one or two of them break" } else { "of them breaks" };
        let first = match wrong.as_slice() {
            [] => format!("{heading} comes to rest on its other cables, whichever {all}."),
            [first] => format!("{heading} does not bear every break: {first}."),
            [first, rest @ ..] => format!(
                "{heading} does not bear every break: {} of {} end badly; {first}.",
                rest.len() + 1,
                self.broken.len()
            ),
        };
        let moved = self.greatest(|rest| rest.moved).zip(self.greatest(|rest| rest.turned_deg));
        let moved = moved.map(|((moved, far), (turned, most))| {
            // The rotation of a point mass is held.
            let is_held = turned == 0.0;
            let (moved, turned) = (significant(moved, 4), significant(turned, 4));
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
        let differ = swings().map(|(swing, _)| swing.tension_difference).fold(0.0, f64::max);
        let peaks = swings().map(|(swing, case)| (swing.greatest_tension, case.name()));
        let peak = peaks.max_by(|a, b| a.0.tension.total_cmp(&b.0.tension)).map(|(peak, without)| {
            let (tension, differ) = (significant(peak.tension, 4), significant(differ, 2));
            let reached = format!("{tension} N, in cable {} without {without}", peak.cable);
            format!("In the time followed they reach {reached}; two computations differ by up to {differ} N.")
        });
        [Some(first), moved, tension, peak].into_iter().flatten().collect()
    }

    fn print(&self, heading: &str) {
        for sentence in self.sentences(heading) {
            print_sentence(&sentence);
        }
        let followed = self.broken.iter().any(|case| case.swing.is_some());
        let mut rows = table(match followed {
            true => {
                &["broken", "moves [m]", "at rest [N]", "swings [m]", "peak [N]", "in cable", "factor", ""]
            }
            false => &["broken", "moves [m]", "turns [deg]", "greatest [N]", "in cable", "factor", ""],
        });
        for case in &self.broken {
            let cells = if followed { case.with_swing() } else { case.at_rest() };
            rows.add_row([numbers(&case.cables)].into_iter().chain(cells).chain([case.remark()]));
        }
        println!("{rows}");
        print_sentence(if followed {
            "The winches stand still. Swings and peaks are those of the time followed, without damping."
        } else {
            "These are rests while the winches stand still. On the way there the platform swings and tensions \
             are greater: --with swing=SECONDS follows it."
        });
    }
}

impl Row for Answer {
    fn columns(_: &Robot) -> Vec<String> {
        [
            "moved_m",
            "moved_without",
            "turned_deg",
            "turned_without",
            "greatest_tension_n",
            "greatest_tension_cable",
            "greatest_tension_without",
            "safety_factor",
            "overloaded_without",
            "below_ground_without",
            "no_rest_without",
            "swing_moved_m",
            "peak_tension_n",
            "peak_tension_cable",
            "peak_tension_without",
        ]
        .map(str::to_owned)
        .into()
    }

    fn cells(&self) -> Vec<String> {
        let without = |found: Option<(f64, &Case)>| match found {
            Some((value, case)) => [format!("{value:?}"), self.names(|one| std::ptr::eq(one, case))],
            None => [String::new(), String::new()],
        };
        let tension = self.greatest(|rest| rest.greatest_tension.tension);
        let cable = tension.and_then(|(_, case)| Some(case.rest.as_ref()?.greatest_tension.cable));
        let [value, case] = without(tension);
        let factors = self.broken.iter().filter_map(|case| case.rest.as_ref()?.safety_factor);
        let factor = factors.min_by(f64::total_cmp);
        let is = |case: &Case, what: fn(&Rest) -> bool| case.rest.as_ref().is_some_and(what);
        let last = [
            value,
            cable.map_or_else(String::new, |cable| cable.to_string()),
            case,
            factor.map_or_else(String::new, |factor| format!("{factor:?}")),
            self.names(|case| is(case, |rest| rest.out_of_limits.iter().any(OutOfLimits::is_too_much))),
            self.names(|case| is(case, |rest| rest.below_ground)),
            self.names(|case| case.rest.is_none()),
        ];
        let [moved, turned] = [self.greatest(|rest| rest.moved), self.greatest(|rest| rest.turned_deg)];
        let swings: Vec<_> = self.broken.iter().filter_map(|case| Some((case.swinging()?, case))).collect();
        let far = swings.iter().map(|(swing, _)| swing.moved).max_by(f64::total_cmp);
        let tension = |swing: &Swinging| swing.greatest_tension.tension;
        let peak = swings.iter().max_by(|a, b| tension(a.0).total_cmp(&tension(b.0)));
        let [value, case] = without(peak.map(|(swing, case)| (tension(swing), *case)));
        let far = far.map_or_else(String::new, |far| format!("{far:?}"));
        let cable = peak.map_or_else(String::new, |(swing, _)| swing.greatest_tension.cable.to_string());
        let swing = [far, value, cable, case];
        without(moved).into_iter().chain(without(turned)).chain(last).chain(swing).collect()
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        Vec::new()
    }

    fn ending(&self) -> Ending {
        let is_wrong = self.broken.iter().any(|case| case.wrong().is_some());
        if is_wrong { Ending::SomethingWrong } else { Ending::Well }
    }
}
