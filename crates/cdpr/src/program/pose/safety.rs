//! `cdpr safety`: what becomes of the platform when a cable breaks.

use crate::program::answer::{OutOfLimits, Residual, decimal, numbers};
use crate::program::arguments::{FreeArguments, With, with};
use crate::program::error::ProgramError;
use crate::program::output::{Ending, print_sentence, table};
use crate::program::pose::at_pose::{Failure, RobotAtPose, Row};
use cdpr_assess::{Broken, BrokenRest, Safety, safety_at};
use cdpr_robot::{Pose, Robot, significant};
use cdpr_statics::WantedPose;
use serde::Serialize;

/// The robot, its poses, and what breaks.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    at: RobotAtPose,
    #[command(flatten)]
    free: FreeArguments,
    /// pairs: break every pair of cables, too.
    #[arg(long, value_name = "NAMES", value_parser = with)]
    with: Option<With>,
}

pub(crate) fn run(Settings { at, free, with }: &Settings) -> Result<Ending, ProgramError> {
    let with = with.clone().unwrap_or_default();
    with.check(&["pairs"])?;
    let (load, pairs) = (at.load.load(), with.has("pairs")?);
    let solve = |robot: &Robot, pose: &Pose| {
        let found = safety_at(robot, WantedPose::at(pose).free(&free.free), &load, pairs)?;
        Ok(Answer::from(found))
    };
    at.answer(solve, Answer::print)
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
    #[serde(skip)]
    overloaded: bool,
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
            overloaded: rest.is_overloaded(),
            out_of_limits: rest.out_of_limits.into_iter().map(OutOfLimits::new).collect(),
            safety_factor: rest.safety_factor.map(|(factor, _)| factor),
            below_ground: rest.below_ground,
            residual: Residual::new(&rest.residual),
        }
    }
}

impl From<Broken> for Case {
    fn from(Broken { cables, rest }: Broken) -> Self {
        let cables = cables.into_iter().map(|i| i + 1).collect();
        match rest {
            Ok(rest) => Self { cables, rest: Some(rest.into()), error: None },
            Err(error) => Self { cables, rest: None, error: Some(error.into()) },
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

    /// What is wrong without these cables.
    fn wrong(&self) -> Option<String> {
        let Some(rest) = &self.rest else { return Some("no rest was found".to_owned()) };
        let beyond = rest.out_of_limits.iter().filter(|_| rest.overloaded);
        let beyond = beyond.min_by_key(|one| one.limit != "breaking_force").map(|one| match one.limit {
            "breaking_force" => format!("cable {} breaks, too", one.cable),
            _ => format!("cable {} is above its greatest tension", one.cable),
        });
        beyond.or_else(|| rest.below_ground.then(|| "the platform comes below the ground".to_owned()))
    }

    /// What is to be said of it in a table.
    fn remark(&self) -> String {
        let (Some(rest), error) = (&self.rest, &self.error) else {
            return self.error.as_ref().map_or_else(String::new, |error| error.message.clone());
        };
        debug_assert!(error.is_none());
        let slack =
            (!rest.slack_cables.is_empty()).then(|| format!("slack: {}", numbers(&rest.slack_cables)));
        self.wrong().into_iter().chain(slack).collect::<Vec<_>>().join("; ")
    }
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
        [Some(first), moved, tension].into_iter().flatten().collect()
    }

    fn print(&self, heading: &str) {
        for sentence in self.sentences(heading) {
            print_sentence(&sentence);
        }
        let mut rows =
            table(&["broken", "moves [m]", "turns [deg]", "greatest [N]", "in cable", "factor", ""]);
        for case in &self.broken {
            let figures = case.rest.as_ref().map(|rest| {
                let Greatest { cable, tension } = rest.greatest_tension;
                let factor = rest.safety_factor.map_or_else(String::new, |factor| significant(factor, 3));
                [
                    significant(rest.moved, 4),
                    decimal(rest.turned_deg, 2),
                    significant(tension, 4),
                    cable.to_string(),
                    factor,
                ]
            });
            let figures = figures.unwrap_or_default();
            rows.add_row([numbers(&case.cables)].into_iter().chain(figures).chain([case.remark()]));
        }
        println!("{rows}");
        print_sentence(
            "These are rests while the winches stand still. On the way there the platform swings and tensions \
             are greater: `cdpr simulate` follows it.",
        );
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
            self.names(|case| is(case, |rest| rest.overloaded)),
            self.names(|case| is(case, |rest| rest.below_ground)),
            self.names(|case| case.rest.is_none()),
        ];
        let [moved, turned] = [self.greatest(|rest| rest.moved), self.greatest(|rest| rest.turned_deg)];
        without(moved).into_iter().chain(without(turned)).chain(last).collect()
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        Vec::new()
    }

    fn ending(&self) -> Ending {
        let is_wrong = self.broken.iter().any(|case| case.wrong().is_some());
        if is_wrong { Ending::SomethingWrong } else { Ending::Well }
    }
}
