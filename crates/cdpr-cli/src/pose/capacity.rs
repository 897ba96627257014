//! `cdpr capacity`: what a robot can carry at a pose, and how far its tensions are from their limits.

use crate::answer::{OutOfLimits, decimal, vector};
use crate::arguments::{FreeArguments, components};
use crate::error::ProgramError;
use crate::output::{Ending, table};
use crate::pose::at_pose::{Failure, RobotAtPose, Row};
use cdpr_assess::{Block, CableDistance, Capacity, Figure, PlatformDistance, WrenchSet, capacity_at};
use cdpr_robot::{Robot, Vector6, Wrench};
use cdpr_statics::{Limit, StaticsError};
use cdpr_study::{InputKind, read_text};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// The robot, its poses, and the wrenches.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    at: RobotAtPose,
    #[command(flatten)]
    free: FreeArguments,
    #[command(flatten)]
    set: WrenchArguments,
}

/// A set of wrenches that act on the platform beside the load.
#[derive(clap::Args)]
pub(crate) struct WrenchArguments {
    /// Wrench about P: fx,fy,fz,mx,my,mz [N, N m]; several times for a set.
    #[arg(long, value_name = "WRENCH", value_parser = components::<6>, allow_hyphen_values = true)]
    wrench: Vec<[f64; 6]>,
    /// File of wrenches (CSV): fx,fy,fz,mx,my,mz on each line, below a header or without one.
    #[arg(long, value_name = "FILE", conflicts_with = "wrench")]
    wrenches: Option<PathBuf>,
    /// Half widths of a box about each wrench, or about zero, whose corners are the set:
    /// fx,fy,fz,mx,my,mz [N, N m].
    #[arg(long, value_name = "WRENCH", value_parser = components::<6>, allow_hyphen_values = true)]
    wrench_box: Option<[f64; 6]>,
}

impl WrenchArguments {
    pub(crate) fn set(&self) -> Result<WrenchSet, ProgramError> {
        let wrench = |numbers: &[f64; 6]| Wrench::from_vector(&Vector6::from(*numbers));
        let listed = self.wrenches.as_deref().map(wrench_file).transpose()?;
        let set = WrenchSet::of(listed.as_ref().unwrap_or(&self.wrench).iter().map(wrench).collect());
        Ok(self.wrench_box.as_ref().map_or_else(|| set.clone(), |widths| set.widened(&wrench(widths))))
    }
}

/// The wrenches of a file, one a line.
fn wrench_file(path: &Path) -> Result<Vec<[f64; 6]>, ProgramError> {
    let text = read_text(path, InputKind::Poses)?;
    let mut wrenches = Vec::new();
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    for (number, line) in lines {
        match components::<6>(line) {
            Ok(wrench) => wrenches.push(wrench),
            // A header has no number.
            Err(_) if wrenches.is_empty() && !line.contains(|c: char| c.is_ascii_digit()) => {}
            Err(reason) => {
                let place = format!("--wrenches {}, line {}: {reason}", path.display(), number + 1);
                return Err(ProgramError::Usage(place));
            }
        }
    }
    if wrenches.is_empty() {
        let empty = format!("--wrenches {}: expected a wrench on each line", path.display());
        return Err(ProgramError::Usage(empty));
    }
    Ok(wrenches)
}

pub(crate) fn run(Settings { at, free, set }: &Settings) -> Result<Ending, ProgramError> {
    let (load, set) = (at.load.load(), set.set()?);
    let solve = |robot: &Robot, pose: &_| {
        let found = capacity_at(robot, pose, &load, &set, &free.free);
        // Whatever else fails, fails with it.
        if let (Err(error), Err(_)) = (&found.payload_kept, &found.margin_anew) {
            return Err(error.clone());
        }
        Ok(Answer::new(found, &set))
    };
    at.answer(solve, Answer::print)
}

/// The figures, payloads in kg and margins in N.
#[derive(Serialize)]
struct Answer {
    /// Greatest mass at the centre of mass.
    payload: Ways,
    /// With the lengths kept until a greatest tension or breaking force is reached, whichever cables are
    /// slack.
    payload_kept_slack: Shown,
    /// Distance of the tensions from the nearest limit.
    margin: Ways,
    /// The nearest two cables and the cable nearest to the platform [m], tensions distributed anew; `null`
    /// where no tensions bear the load, or all cables share points.
    nearest_cables: Option<NearCables>,
    nearest_to_platform: Option<NearPlatform>,
}

/// Two cables and the distance of their surfaces.
#[derive(Serialize)]
struct NearCables {
    distance: f64,
    cables: [usize; 2],
}

/// A cable and the distance of its surface from the hull of the other anchor points.
#[derive(Serialize)]
struct NearPlatform {
    distance: f64,
    cable: usize,
}

/// Both ways to bear a load.
#[derive(Serialize)]
struct Ways {
    /// Tensions distributed anew.
    anew: Shown,
    /// Lengths kept.
    kept: Shown,
}

/// A figure, or why it does not exist.
#[derive(Serialize)]
struct Shown {
    /// `null` where the figure does not exist or a limit is passed without a payload.
    value: Option<f64>,
    /// The wrench of the set that leaves the least, fx to mz; absent for a single one.
    #[serde(skip_serializing_if = "Option::is_none")]
    wrench: Option<[f64; 6]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    blocking: Vec<Blocking>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<Failure>,
}

/// A limit that blocks a greater value.
#[derive(Serialize)]
struct Blocking {
    cable: usize,
    /// `min`, `max` or `breaking_force`.
    limit: &'static str,
    /// The limit [N].
    value: f64,
    /// By how much the figure grows where the limit gives way [kg/N, N/N].
    #[serde(skip_serializing_if = "Option::is_none")]
    gain: Option<f64>,
}

impl Shown {
    fn new(figure: Result<Figure, StaticsError>, set: &WrenchSet) -> Self {
        let none = Self { value: None, wrench: None, blocking: Vec::new(), error: None };
        let Figure { value, wrench, blocking } = match figure {
            Ok(figure) => figure,
            Err(error) => return Self { error: Some(error.into()), ..none },
        };
        let wrenches = set.wrenches();
        let mut shown = Self {
            value: value.is_finite().then_some(value),
            wrench: (wrenches.len() > 1).then(|| wrenches[wrench].to_vector().into()),
            ..none
        };
        for block in blocking {
            match block {
                Block::Limit { cable, limit, value, gain } => {
                    shown.blocking.push(Blocking { cable: cable + 1, limit: name(limit), value, gain });
                }
                Block::Lost(error) => shown.error = Some(error.into()),
            }
        }
        shown
    }

    /// What blocks, in words.
    fn words(&self) -> String {
        let one = |Blocking { cable, limit, value, .. }: &Blocking| {
            format!("cable {cable} at its {limit}, {} N", decimal(*value, 1))
        };
        let mut words: Vec<_> = self.blocking.iter().map(one).collect();
        if let Some(wrench) = &self.wrench {
            words.push(format!("under the wrench {}", vector(wrench, 1)));
        }
        words.extend(self.error.as_ref().map(|error| error.message.clone()));
        words.join("; ")
    }

    fn number(&self) -> String {
        self.value.map_or_else(String::new, |value| format!("{value:?}"))
    }
}

fn name(limit: Limit) -> &'static str {
    match limit {
        Limit::BreakingForce => "breaking_force",
        Limit::Max | Limit::MaxElsewhere => "max",
        Limit::Min => "min",
    }
}

impl Row for Answer {
    fn columns(_: &Robot) -> Vec<String> {
        let names =
            ["payload_anew_kg", "payload_kept_kg", "payload_kept_slack_kg", "margin_anew_n", "margin_kept_n"];
        let both = |name: &str| {
            let blocked = name.rsplit_once('_').map_or(name, |(start, _)| start);
            [name.to_owned(), format!("{blocked}_blocked_by")]
        };
        let distances =
            ["nearest_cables_m", "nearest_cables", "nearest_to_platform_m", "nearest_to_platform"];
        names.into_iter().flat_map(both).chain(distances.map(str::to_owned)).collect()
    }

    fn cells(&self) -> Vec<String> {
        let figures = self.all().into_iter().flat_map(|(_, shown)| [shown.number(), shown.words()]);
        let cables = self.nearest_cables.as_ref();
        let platform = self.nearest_to_platform.as_ref();
        let distances = [
            cables.map(|near| format!("{:?}", near.distance)),
            cables.map(|NearCables { cables: [i, j], .. }| format!("{i} {j}")),
            platform.map(|near| format!("{:?}", near.distance)),
            platform.map(|near| near.cable.to_string()),
        ];
        figures.chain(distances.map(Option::unwrap_or_default)).collect()
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        Vec::new()
    }
}

impl Answer {
    fn new(found: Capacity, set: &WrenchSet) -> Self {
        let shown = |figure| Shown::new(figure, set);
        let (cables, platform) = found.clearance.map_or((None, None), |found| (found.cables, found.platform));
        Self {
            payload: Ways { anew: shown(found.payload_anew), kept: shown(found.payload_kept) },
            payload_kept_slack: shown(found.payload_kept_slack),
            margin: Ways { anew: shown(found.margin_anew), kept: shown(found.margin_kept) },
            nearest_cables: cables
                .map(|CableDistance { distance, pair }| NearCables { distance, cables: pair.map(|i| i + 1) }),
            nearest_to_platform: platform
                .map(|PlatformDistance { distance, cable }| NearPlatform { distance, cable: cable + 1 }),
        }
    }

    fn all(&self) -> [(&'static str, &Shown); 5] {
        [
            ("greatest payload [kg], tensions distributed anew", &self.payload.anew),
            ("greatest payload [kg], lengths kept", &self.payload.kept),
            ("greatest payload [kg], lengths kept, slack allowed", &self.payload_kept_slack),
            ("margin [N], tensions distributed anew", &self.margin.anew),
            ("margin [N], lengths kept", &self.margin.kept),
        ]
    }

    fn print(&self, heading: &str) {
        println!("{heading}");
        let mut rows = table(&["", "value", "blocked by"]);
        for (name, shown) in self.all() {
            let value = match shown.value {
                Some(value) => decimal(value, 3),
                None if shown.error.is_some() => "none".to_owned(),
                None => "beyond a limit without it".to_owned(),
            };
            rows.add_row([name.to_owned(), value, shown.words()]);
        }
        println!("{rows}");
        if let Some(NearCables { distance, cables: [i, j] }) = self.nearest_cables {
            println!("nearest cables {i} and {j}, {:.1} mm apart", 1e3 * distance);
        }
        if let Some(NearPlatform { distance, cable }) = self.nearest_to_platform {
            println!("cable {cable} is nearest to the platform, {:.1} mm", 1e3 * distance);
        }
    }
}
