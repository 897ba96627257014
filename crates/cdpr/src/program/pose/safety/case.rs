//! What becomes of the platform without some of its cables, and how it is said.

use crate::program::answer::{OutOfLimits, Residual, decimal, numbers};
use crate::program::pose::at_pose::Failure;
use cdpr_assess::{Broken, BrokenRest, Swing};
use cdpr_robot::significant;
use serde::Serialize;

/// What becomes of the platform without these cables.
#[derive(Serialize)]
pub(super) struct Case {
    /// Their numbers.
    pub(super) cables: Vec<usize>,
    #[serde(flatten)]
    pub(super) rest: Option<Rest>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) error: Option<Failure>,
    /// The motion after the break, if it is followed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) swing: Option<Motion>,
    /// Whether no cable is left.
    #[serde(skip)]
    pub(super) falls: bool,
}

/// How the platform swings, or why that is not known.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum Motion {
    Followed(Swinging),
    Failed { error: String },
}

/// How the platform swings.
#[derive(Serialize)]
pub(super) struct Swinging {
    /// Greatest distance from where it was.
    pub(super) moved_mm: f64,
    /// Whether that was at the end, so that it may move farther.
    pub(super) moves_away: bool,
    #[serde(rename = "peak_tension")]
    pub(super) greatest_tension: Greatest,
    /// When that is [s].
    #[serde(rename = "at_s")]
    pub(super) time: f64,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) out_of_limits: Vec<OutOfLimits>,
    #[serde(flatten)]
    pub(super) factor: Factor,
    pub(super) below_ground: bool,
    /// Difference of two computations in the tensions [N].
    #[serde(rename = "peak_difference_n")]
    pub(super) tension_difference: f64,
    /// The safety factor with tensions that are greater by it; `null` where a breaking force is not known.
    pub(super) safety_factor_at_least: Option<f64>,
    /// Whether such tensions are too great for a cable.
    pub(super) may_be_overloaded: bool,
}

impl Swinging {
    /// Difference of two computations over the greatest tension, above which that is marked.
    const ROUGH: f64 = 0.1;
    /// Error of a factor of which three digits are printed, relative to it, though the last one may differ.
    const KNOWN: f64 = 2e-3;

    /// Whether its tensions are hardly known.
    pub(super) fn is_rough(&self) -> bool {
        self.tension_difference > Self::ROUGH * self.greatest_tension.tension
    }

    /// The greatest tension as far as it is known, with the difference of two computations.
    fn peak(&self) -> String {
        let (peak, differ) = (self.greatest_tension.tension, self.tension_difference);
        let mark = if self.is_rough() { "~ " } else { "" };
        let digits = if differ > 0.01 * peak { 3 } else { 4 };
        let differ = if differ < 1e-3 * peak { significant(differ, 1) } else { significant(differ, 2) };
        format!("{mark}{} ±{differ}", fitting(peak, digits))
    }

    /// Its safety factor where three digits of it are known, or else what it is greater than; a cable that is
    /// not the named one has its number.
    fn factor(&self, named: usize) -> String {
        let (Some(factor), Some(least)) = (self.factor.value, self.safety_factor_at_least) else {
            return String::new();
        };
        if significant(factor, 3) == significant(least, 3) || least >= (1.0 - Self::KNOWN) * factor {
            return self.factor.cell(named);
        }
        // Rounded down.
        let step = 10.0_f64.powf(least.log10().floor() - 1.0);
        format!("> {}", significant((least / step).floor() * step, 2))
    }
}

/// Where the platform comes to rest.
#[derive(Serialize)]
pub(super) struct Rest {
    /// Position of P [m] and quaternion, qw first.
    pub(super) position: [f64; 3],
    pub(super) rotation: [f64; 4],
    pub(super) moved_mm: f64,
    pub(super) turned_deg: f64,
    /// At the platform and at the exit points [N], zero for a broken cable.
    pub(super) tensions: Vec<f64>,
    pub(super) exit_tensions: Vec<f64>,
    pub(super) greatest_tension: Greatest,
    pub(super) slack_cables: Vec<usize>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) out_of_limits: Vec<OutOfLimits>,
    #[serde(flatten)]
    pub(super) factor: Factor,
    pub(super) below_ground: bool,
    /// Whether it is turned by more than a right angle: what its cables touch then is not known.
    pub(super) turns_over: bool,
    pub(super) residual: Residual,
}

/// A tension at either end of a cable [N].
#[derive(Clone, Copy, Serialize)]
pub(super) struct Greatest {
    pub(super) cable: usize,
    #[serde(rename = "tension_n")]
    pub(super) tension: f64,
}

/// The least breaking force over greatest tension; `null` where a breaking force is not known.
#[derive(Clone, Copy, Default, Serialize)]
pub(super) struct Factor {
    #[serde(rename = "safety_factor")]
    pub(super) value: Option<f64>,
    /// Number of its cable, from 1, which may be another one than that with the greatest tension.
    #[serde(rename = "safety_factor_cable")]
    pub(super) cable: Option<usize>,
}

impl From<Option<(f64, usize)>> for Factor {
    fn from(found: Option<(f64, usize)>) -> Self {
        Self { value: found.map(|(factor, _)| factor), cable: found.map(|(_, cable)| cable + 1) }
    }
}

impl Factor {
    /// In a table whose row names a cable: with its own one if that is another; empty where it is not known.
    pub(super) fn cell(self, named: usize) -> String {
        let Self { value: Some(value), cable: Some(cable) } = self else { return String::new() };
        let value = significant(value, 3);
        if cable == named { value } else { format!("{value} (cable {cable})") }
    }
}

impl From<BrokenRest> for Rest {
    fn from(rest: BrokenRest) -> Self {
        let (turns_over, (tension, cable)) = (rest.turns_over(), rest.greatest_tension());
        Self {
            position: rest.pose.position.into(),
            rotation: rest.pose.quaternion(),
            moved_mm: 1e3 * rest.moved,
            turned_deg: rest.turned.to_degrees(),
            tensions: rest.tensions.iter().map(|ends| ends[0]).collect(),
            exit_tensions: rest.tensions.iter().map(|ends| ends[1]).collect(),
            greatest_tension: Greatest { cable: cable + 1, tension },
            slack_cables: rest.slack.iter().map(|i| i + 1).collect(),
            out_of_limits: rest.out_of_limits.into_iter().map(OutOfLimits::new).collect(),
            factor: rest.safety_factor.into(),
            below_ground: rest.below_ground,
            turns_over,
            residual: Residual::new(&rest.residual),
        }
    }
}

impl From<Swing> for Swinging {
    fn from(swing: Swing) -> Self {
        let (tension, cable, time) = swing.greatest;
        Self {
            moved_mm: 1e3 * swing.moved,
            moves_away: swing.moves_away,
            greatest_tension: Greatest { cable: cable + 1, tension },
            time,
            out_of_limits: swing.out_of_limits.into_iter().map(OutOfLimits::new).collect(),
            factor: swing.safety_factor.into(),
            below_ground: swing.below_ground,
            tension_difference: swing.difference.tension,
            safety_factor_at_least: swing.factor_at_least,
            may_be_overloaded: swing.may_be_overloaded,
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
            Ok(rest) => Self { cables, rest: Some(rest.into()), error: None, swing, falls: false },
            Err(error) => Self { cables, rest: None, error: Some(error.into()), swing, falls: false },
        }
    }
}

impl Case {
    /// `cable 3`, `cables 3, 4`.
    pub(super) fn name(&self) -> String {
        format!("cable{} {}", if self.cables.len() > 1 { "s" } else { "" }, numbers(&self.cables))
    }

    /// The motion, where it is known.
    pub(super) fn swinging(&self) -> Option<&Swinging> {
        match &self.swing {
            Some(Motion::Followed(swing)) => Some(swing),
            _ => None,
        }
    }

    /// What is wrong without these cables, at rest or on the way there, or why that is not known.
    pub(super) fn wrong(&self) -> Option<String> {
        self.bad().or_else(|| match &self.swing {
            _ if self.rest.is_none() => Some("no rest was found".to_owned()),
            _ if self.turns_over() => Some("the platform turns over, perhaps into its cables".to_owned()),
            Some(Motion::Failed { .. }) => Some("its motion is not known".to_owned()),
            Some(Motion::Followed(swing)) if swing.may_be_overloaded => {
                Some("its peak is too uncertain".to_owned())
            }
            _ => None,
        })
    }

    /// Whether the platform turns by more than a right angle.
    fn turns_over(&self) -> bool {
        self.rest.as_ref().is_some_and(|rest| rest.turns_over)
    }

    /// Why its rest or its motion is not known.
    pub(super) fn failure(&self) -> Option<&str> {
        match (&self.error, &self.swing) {
            (Some(failure), _) => Some(&failure.message),
            (_, Some(Motion::Failed { error })) => Some(error),
            _ => None,
        }
    }

    /// What is known to be wrong.
    pub(super) fn bad(&self) -> Option<String> {
        if self.falls {
            return Some("no cable is left".to_owned());
        }
        let rest = self.rest.as_ref()?;
        let swing = self.swinging();
        let swinging = swing.map_or(&[][..], |swing| &swing.out_of_limits);
        let at_rest = rest.out_of_limits.iter().map(|one| (one, ""));
        let beyond = at_rest.chain(swinging.iter().map(|one| (one, " on the way")));
        let beyond = beyond.filter(|(one, _)| one.is_too_much());
        // What breaks counts more, then what is passed most.
        let beyond = beyond.min_by(|(a, _), (b, _)| {
            let kind = |of: &OutOfLimits| of.limit != "breaking_force";
            kind(a).cmp(&kind(b)).then(b.excess().total_cmp(&a.excess()))
        });
        let beyond = beyond.map(|(one, when)| match one.limit {
            "breaking_force" => {
                format!("cable {} breaks, too{}{when}", one.cable, if when.is_empty() { "" } else { "," })
            }
            _ => format!("cable {} is above its greatest tension{when}", one.cable),
        });
        let below = self.is_below_ground();
        beyond.or_else(|| below.then(|| "the platform comes below the ground".to_owned()))
    }

    /// How the break ends, in one word: those of `Robot.safety` in Python.
    pub(super) fn ending(&self) -> String {
        let word = match &self.error {
            Some(failure) => failure.kind,
            None if self.is_overloaded() => "overloaded",
            None if self.is_below_ground() => "below_ground",
            None if self.turns_over() => "turned_over",
            None if self.is_unknown() => "unknown",
            None => "held",
        };
        word.to_owned()
    }

    /// Whether the motion is followed, and does not show whether the other cables bear it.
    fn is_unknown(&self) -> bool {
        self.swing.is_some() && self.swinging().is_none_or(|swing| swing.may_be_overloaded)
    }

    /// Whether another cable is loaded too much, at rest or on the way.
    pub(super) fn is_overloaded(&self) -> bool {
        let at_rest = self.rest.iter().flat_map(|rest| &rest.out_of_limits);
        let swinging = self.swinging().into_iter().flat_map(|swing| &swing.out_of_limits);
        at_rest.chain(swinging).any(OutOfLimits::is_too_much)
    }

    /// Whether the platform comes below the ground, at rest or on the way.
    pub(super) fn is_below_ground(&self) -> bool {
        let at_rest = self.rest.as_ref().is_some_and(|rest| rest.below_ground);
        at_rest || self.swinging().is_some_and(|swing| swing.below_ground)
    }

    /// The least safety factor at rest and on the way.
    pub(super) fn factor(&self) -> Factor {
        let at_rest = self.rest.as_ref().map(|rest| rest.factor);
        let swinging = self.swinging().map(|swing| swing.factor);
        let known = at_rest.into_iter().chain(swinging).filter_map(|of| Some((of.value?, of)));
        known.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, of)| of).unwrap_or_default()
    }

    /// How far the platform moves and turns, the greatest tension at rest, its cable, and the factor.
    pub(super) fn at_rest(&self) -> Vec<String> {
        let Some(rest) = &self.rest else { return vec![String::new(); 5] };
        let Greatest { cable, tension } = rest.greatest_tension;
        let (moved, turned) = (significant(1e-3 * rest.moved_mm, 4), decimal(rest.turned_deg, 2));
        vec![moved, turned, significant(tension, 4), cable.to_string(), rest.factor.cell(cable)]
    }

    /// How far the platform moves, the greatest tension at rest; how far it swings, the greatest tension
    /// then, its cable, and the factor.
    pub(super) fn with_swing(&self) -> Vec<String> {
        let rest = self
            .rest
            .as_ref()
            .map(|rest| [fitting(1e-3 * rest.moved_mm, 4), fitting(rest.greatest_tension.tension, 4)]);
        let swing = self.swinging().map(|swing| {
            let cable = swing.greatest_tension.cable;
            let moved =
                format!("{}{}", if swing.moves_away { "> " } else { "" }, fitting(1e-3 * swing.moved_mm, 4));
            let at_rest = self.rest.as_ref().and_then(|rest| rest.factor.value);
            // The rest decides where the motion has surely less.
            let factor = match (at_rest, swing.safety_factor_at_least) {
                (Some(at_rest), Some(least)) if at_rest < least => self.factor().cell(cable),
                _ => swing.factor(cable),
            };
            [moved, swing.peak(), cable.to_string(), factor]
        });
        rest.unwrap_or_default().into_iter().chain(swing.unwrap_or_default()).collect()
    }

    /// What is to be said of it in a table.
    pub(super) fn remark(&self) -> String {
        let Some(rest) = &self.rest else {
            let why = || self.error.as_ref().map(|error| error.message.clone());
            return self.bad().or_else(why).unwrap_or_default();
        };
        let slack =
            (!rest.slack_cables.is_empty()).then(|| format!("slack: {}", numbers(&rest.slack_cables)));
        let wrong = self.wrong().map(|wrong| match &self.swing {
            Some(Motion::Failed { error }) if self.bad().is_none() && !self.turns_over() => {
                format!("{wrong}: {error}")
            }
            _ => wrong,
        });
        wrong.into_iter().chain(slack).collect::<Vec<_>>().join("; ")
    }
}

/// A number of at most seven characters, where it is neither tiny nor huge, so that no line of a table ends
/// within it.
fn fitting(value: f64, digits: usize) -> String {
    const MOST: usize = 7;
    let text = significant(value, digits);
    if text.len() > MOST { format!("{value:.2e}") } else { text }
}
