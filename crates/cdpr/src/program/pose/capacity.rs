//! `cdpr capacity`: what a robot can carry at a pose, and how far its tensions are from their limits.

mod figure;

use crate::program::answer::{OutOfLimits, decimal};
use crate::program::arguments::{FreeArguments, With, count, with};
use crate::program::error::ProgramError;
use crate::program::output::{Ending, print_sentence, table};
use crate::program::pose::at_pose::{Brief, Failure, RobotAtPose, Row};
use crate::program::questions;
use crate::program::wrenches::WrenchArguments;
use cdpr_assess::{Capacity, Clearance, TiltTowards, WrenchSet, capacity_at, clearance_under, tilt_at};
use cdpr_robot::{Pose, Robot, counted, rounded, significant, visible};
use cdpr_statics::capacity::tension_margin;
use cdpr_statics::{Load, StaticsError, WantedPose};
use figure::{Blocking, Shown, WEIGHTLESS};
use serde::Serialize;

/// The robot, its poses, and the wrenches.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    at: RobotAtPose,
    #[command(flatten)]
    free: FreeArguments,
    #[command(flatten)]
    set: WrenchArguments,
    /// Further figures: tilt or tilt=N, how far the platform may tilt under the load, to 0.01 degrees,
    /// towards N directions (8).
    #[arg(long, value_name = "NAMES", value_parser = with)]
    with: Option<With>,
}

/// Accuracy of the tilt [degrees].
const TILT_ACCURACY: f64 = 0.01;

pub(crate) fn run(Settings { at, free, set, with }: &Settings) -> Result<Ending, ProgramError> {
    let (load, set) = (at.load.load(), set.set()?);
    let with = With::known(with.as_ref(), &["tilt"])?;
    let tilt = with.value("tilt", Some(8), count::<1, 360>)?;
    if tilt.is_some() && !free.free.is_empty() {
        let expected = "--with tilt: expected no --free: there the rotation follows from the position";
        return Err(ProgramError::Usage(expected.to_owned()));
    }
    questions::about_wrenches(&at.robot()?, set.wrenches());
    let solve = |robot: &Robot, pose: &_| {
        let found = capacity_at(robot, WantedPose::at(pose).free(&free.free), &load, &set);
        // Whatever else fails, fails with it.
        if let (Err(error), Err(_)) = (&found.payload_kept, &found.margin_recomputed) {
            return Err(error.clone());
        }
        let clearance = clearance_under(robot, WantedPose::at(pose).free(&free.free), &load);
        let tilted = |count: &usize| tilt_at(robot, pose, &load, *count, TILT_ACCURACY.to_radians());
        let (tilt, no_tilt) = match tilt.as_ref().map(tilted).transpose() {
            Ok(tilt) => (tilt, None),
            Err(error) => (None, Some(error.into())),
        };
        let ends = tilt.iter().flat_map(|tilt| &tilt.directions);
        let tilt = ends.map(|towards| Towards::new(robot, pose, &load, towards)).collect();
        Ok(Answer { no_tilt, ..Answer::new(found, clearance, tilt, &set) })
    };
    at.answer(solve, Answer::print)
}

/// The figures, payloads in kg and margins in N.
#[derive(Serialize)]
struct Answer {
    /// Greatest mass at the centre of mass, tensions recomputed.
    #[serde(rename = "payload_recomputed_kg")]
    payload_recomputed: Shown,
    /// The same, lengths kept.
    #[serde(rename = "payload_kept_kg")]
    payload_kept: Shown,
    /// With the lengths kept until a greatest tension or breaking force is reached, whichever cables are
    /// slack.
    #[serde(rename = "payload_kept_slack_kg")]
    payload_kept_slack: Shown,
    /// Distance of the tensions from the nearest limit, tensions recomputed.
    #[serde(rename = "margin_recomputed_n")]
    margin_recomputed: Shown,
    /// The same, lengths kept.
    #[serde(rename = "margin_kept_n")]
    margin_kept: Shown,
    /// Distance of the surfaces of the nearest two cables, and these, tensions recomputed; `null` where no
    /// tensions bear the load, or all cables share points.
    nearest_cables_mm: Option<f64>,
    nearest_cables: Option<[usize; 2]>,
    /// Distance of the surface of the nearest cable from the hull of the other anchor points, and the cable.
    nearest_to_platform_mm: Option<f64>,
    nearest_to_platform: Option<usize>,
    /// Why there are no distances, where the load is not borne.
    #[serde(skip_serializing_if = "Option::is_none")]
    no_distances: Option<Failure>,
    /// How far the platform may tilt towards each direction, if asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    tilt: Vec<Towards>,
    /// Why it is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    no_tilt: Option<Failure>,
}

/// How far the platform may tilt towards a direction.
#[derive(Serialize)]
struct Towards {
    /// The direction in which the upward axis leans, from x to y.
    azimuth_deg: f64,
    angle_deg: f64,
    /// The limit next to the tensions there; absent where nothing ends it below a right angle, or where the
    /// limit is not found.
    #[serde(skip_serializing_if = "Option::is_none")]
    blocking: Option<Blocking>,
}

impl Towards {
    fn new(robot: &Robot, pose: &Pose, load: &Load, towards: &TiltTowards) -> Self {
        let margin = (!towards.is_free()).then(|| tension_margin(robot, &towards.of(robot, pose), load).ok());
        let blocking = margin.flatten().and_then(|margin| margin.blocking.first().copied());
        let blocking = blocking.and_then(|found| Blocking::new(&found.into()));
        let blocking = blocking.map(|blocking| Blocking { gain: None, ..blocking });
        Self { azimuth_deg: towards.azimuth.to_degrees(), angle_deg: towards.angle.to_degrees(), blocking }
    }
}

impl Row for Answer {
    fn columns(_: &Robot) -> Vec<String> {
        let names = [
            "payload_recomputed_kg",
            "payload_kept_kg",
            "payload_kept_slack_kg",
            "margin_recomputed_n",
            "margin_kept_n",
        ];
        let both = |name: &str| {
            let blocked = name.rsplit_once('_').map_or(name, |(start, _)| start);
            [name.to_owned(), format!("{blocked}_blocked_by")]
        };
        let distances = [
            "nearest_cables_mm",
            "nearest_cables",
            "nearest_to_platform_mm",
            "nearest_to_platform",
            "tilt_deg",
            "tilt_azimuth_deg",
        ];
        names.into_iter().flat_map(both).chain(distances.map(str::to_owned)).collect()
    }

    fn cells(&self) -> Vec<String> {
        let figures = self.all().into_iter().flat_map(|(_, shown)| [shown.number(), shown.words()]);
        let least = self.tilt.iter().min_by(|a, b| a.angle_deg.total_cmp(&b.angle_deg));
        let number = |value: Option<f64>| value.map(|value| format!("{value:?}"));
        let why = |failure: &Option<Failure>| failure.as_ref().map(|failure| failure.message.clone());
        let distances = [
            number(self.nearest_cables_mm),
            self.nearest_cables.map(|[i, j]| format!("{i} {j}")).or_else(|| why(&self.no_distances)),
            number(self.nearest_to_platform_mm),
            self.nearest_to_platform.map(|i| i.to_string()).or_else(|| why(&self.no_distances)),
            number(least.map(|towards| towards.angle_deg)),
            number(least.map(|towards| towards.azimuth_deg)).or_else(|| why(&self.no_tilt)),
        ];
        figures.chain(distances.map(Option::unwrap_or_default)).collect()
    }

    fn brief(&self) -> Vec<Brief> {
        let payload = Brief::Least("payload", "kg", self.payload_recomputed.value);
        vec![payload, Brief::Least("margin", "N", self.margin_recomputed.value)]
    }

    fn wrong(&self) -> String {
        "where cables cross or the platform falls".to_owned()
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        Vec::new()
    }

    /// A platform that falls under the load itself is something wrong, and cables that cross are.
    fn ending(&self) -> Ending {
        let falls =
            |shown: &Shown| shown.value.is_none() && shown.error.as_ref().is_some_and(Failure::is_fall);
        let crosses = !self.crossings().is_empty();
        if crosses || self.all().iter().any(|(_, shown)| falls(shown)) {
            Ending::SomethingWrong
        } else {
            Ending::Well
        }
    }
}

impl Answer {
    fn new(
        found: Capacity,
        clearance: Result<Clearance, StaticsError>,
        tilt: Vec<Towards>,
        set: &WrenchSet,
    ) -> Self {
        let shown = |figure| Shown::new(figure, set);
        let (cables, platform, no_distances) = match clearance {
            Ok(found) => (found.cables, found.platform, None),
            Err(error) => (None, None, Some(error.into())),
        };
        Self {
            payload_recomputed: shown(found.payload_recomputed),
            payload_kept: shown(found.payload_kept),
            payload_kept_slack: shown(found.payload_kept_slack),
            margin_recomputed: shown(found.margin_recomputed),
            margin_kept: shown(found.margin_kept),
            nearest_cables_mm: cables.map(|near| 1e3 * near.distance),
            nearest_cables: cables.map(|near| near.pair.map(|i| i + 1)),
            nearest_to_platform_mm: platform.map(|near| 1e3 * near.distance),
            nearest_to_platform: platform.map(|near| near.cable + 1),
            no_distances,
            tilt,
            no_tilt: None,
        }
    }

    fn all(&self) -> [(&'static str, &Shown); 5] {
        [
            ("greatest payload [kg], tensions recomputed", &self.payload_recomputed),
            ("greatest payload [kg], lengths kept", &self.payload_kept),
            ("greatest payload [kg], lengths kept, slack allowed", &self.payload_kept_slack),
            ("margin [N], tensions recomputed", &self.margin_recomputed),
            ("margin [N], lengths kept", &self.margin_kept),
        ]
    }

    /// The nearest two cables and their distance [mm].
    fn near_cables(&self) -> Option<(f64, [usize; 2])> {
        self.nearest_cables_mm.zip(self.nearest_cables)
    }

    /// The cable nearest to the platform and its distance [mm].
    fn near_platform(&self) -> Option<(f64, usize)> {
        self.nearest_to_platform_mm.zip(self.nearest_to_platform)
    }

    /// Which cables pass through each other or through the platform.
    fn crossings(&self) -> Vec<String> {
        let cables = self.near_cables().filter(|(distance, _)| *distance < 0.0);
        let platform = self.near_platform().filter(|(distance, _)| *distance < 0.0);
        let cables = cables.map(|(distance, [i, j])| {
            format!("Cables {i} and {j} cross: they overlap by {} mm.", visible(-distance, 1))
        });
        let platform = platform.map(|(distance, cable)| {
            format!(
                "Cable {cable} crosses the platform, the hull of the other anchor points, by {} mm.",
                visible(-distance, 1)
            )
        });
        cables.into_iter().chain(platform).collect()
    }

    /// What the robot carries, and how far its tensions are from their limits.
    fn sentences(&self, heading: &str) -> Vec<String> {
        let least = self.tilt.iter().min_by(|a, b| a.angle_deg.total_cmp(&b.angle_deg));
        let tilt = least.map(|towards| {
            let tried = counted(self.tilt.len(), "direction");
            let [angle, azimuth] =
                [(towards.angle_deg, 2), (towards.azimuth_deg, 1)].map(|(x, n)| decimal(x, n));
            if towards.angle_deg < 90.0 {
                let least = format!("towards {azimuth} degrees, the worst of {tried}");
                format!("{heading} may tilt by {angle} degrees {least}.")
            } else {
                format!("{heading} may tilt by 90 degrees, the most that is tried, in {tried}.")
            }
        });
        let payload = &self.payload_recomputed;
        let limit = |of: &Blocking| of.words.split(',').next().unwrap_or_default().to_owned();
        let by =
            payload.blocking.first().map_or_else(String::new, |first| format!("; then {}", limit(first)));
        let carries = match payload.value {
            Some(value) => format!("{heading} carries up to {} kg{by}.", significant(value, 4)),
            None if payload.unbounded => format!("{heading} carries any payload: {WEIGHTLESS}."),
            None if payload.error.is_some() => format!("{heading} carries nothing: {}.", payload.cause()),
            None => format!("{heading} is beyond a limit without any payload{by}."),
        };
        let margin = self.margin_recomputed.value.map(|margin| match margin {
            ..0.0 => format!(
                "No tensions within the limits hold this pose: they miss them by {} N.",
                significant(-margin, 4)
            ),
            _ => format!("Its tensions can stay {} N away from their limits.", significant(margin, 4)),
        });
        [tilt, Some(carries), margin].into_iter().flatten().collect()
    }

    fn print(&self, heading: &str) {
        for sentence in self.sentences(heading).into_iter().chain(self.crossings()) {
            print_sentence(&sentence);
        }
        let mut rows = table(&["", "value", "blocked by"]);
        let mut told: Vec<&str> = Vec::new();
        for (name, shown) in self.all() {
            let value = match shown.value {
                // Beyond there is rounding alone.
                Some(value) => visible(rounded(value, 9), 3),
                None if shown.error.is_some() => "none".to_owned(),
                None if shown.unbounded => "any".to_owned(),
                None => "beyond a limit without it".to_owned(),
            };
            let reason = shown.error.as_ref().map(|error| error.message.as_str());
            let known = reason.is_some_and(|reason| told.contains(&reason));
            told.extend(reason);
            let words = if known { "as above".to_owned() } else { shown.words() };
            rows.add_row([name.to_owned(), value, words]);
        }
        println!("{rows}");
        if let Some((distance @ 0.0.., [i, j])) = self.near_cables() {
            println!("nearest cables {i} and {j}, {} mm apart", visible(distance, 1));
        }
        if let Some((distance @ 0.0.., cable)) = self.near_platform() {
            println!("cable {cable} is nearest to the platform, {} mm", visible(distance, 1));
        }
        if let Some(Failure { message, .. }) = &self.no_tilt {
            print_sentence(&format!("no tilt: {message}"));
        }
        if self.tilt.is_empty() {
            return;
        }
        let mut rows = table(&["tilt towards [deg]", "reached [deg]", "ended by"]);
        for Towards { azimuth_deg, angle_deg, blocking } in &self.tilt {
            let unknown = if *angle_deg < 90.0 { "not found" } else { "" };
            let ended = blocking.as_ref().map_or(unknown, |blocking| blocking.words.as_str());
            rows.add_row([decimal(*azimuth_deg, 1), decimal(*angle_deg, 2), ended.to_owned()]);
        }
        println!("{rows}");
    }
}
