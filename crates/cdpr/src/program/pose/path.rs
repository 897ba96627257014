//! `cdpr path`: what a robot does along a path of poses.

mod moves;

use crate::program::answer::OutOfLimits;
use crate::program::arguments::{self, FigureArgument, UncertaintyArgument, With, figure};
use crate::program::error::ProgramError;
use crate::program::output::Ending;
use crate::program::pose::at_pose::{Brief, RobotAtPose, Row, cells, numbered};
use crate::program::said::{missing_frequencies, note};
use cdpr_assess::{Bands, Path, PathPose};
use cdpr_report::path_view;
use cdpr_robot::Robot;
use cdpr_statics::{Deflection, Load};
use moves::INSTEAD;
use serde::Serialize;

/// The robot, its poses, and what is uncertain.
// A single pose is no path.
#[derive(clap::Args)]
#[command(mut_arg("pose", |pose| pose.hide(true)), mut_arg("rpy", |rpy| rpy.hide(true)))]
pub(crate) struct Settings {
    #[command(flatten)]
    at: RobotAtPose,
    #[command(flatten)]
    errors: UncertaintyArgument,
    /// File for a figure of the path (.svg, .pdf, .png); behind its name: width=MM, untitled. With an error
    /// model it has bands of two standard deviations.
    #[arg(long, value_name = "FILE", value_parser = figure)]
    figure: Option<FigureArgument>,
    /// A move along the poses instead, as set points of the winches over time: seconds=S, its duration [s],
    /// and profile=trapezoid, cosine or polynomial, shaper=zv, zvd or ei, modes=N, feed-forward, rate=HZ.
    ///
    /// The shaper is for the N motions that swing most (2), `damping=S` their damping as in `simulate`; its
    /// duration is part of the seconds. `feed-forward` accounts for the inertia of platform and cables,
    /// `feed-forward=platform` without the cables; its profile is the polynomial. `residual=S` simulates the
    /// move and what swings for S seconds after it (two periods), with and without shaper and feed-forward;
    /// with --uncertainty also of robots that are drawn, `robots=N` (100) from `seed=N`.
    #[arg(long, value_name = "NAMES", value_parser = arguments::with)]
    with: Option<With>,
}

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    let Settings { at, errors, figure, with } = settings;
    if let Some(with) = with {
        if figure.is_some() {
            let reason = "--figure: expected a path without seconds; the set points of a move are a table";
            return Err(ProgramError::Usage(reason.to_owned()));
        }
        return moves::run(at, errors, with);
    }
    let (robot, load) = (at.robot()?, at.load.load());
    ProgramError::unless_chosen(&robot, || INSTEAD.to_owned())?;
    let model = errors.model(&robot)?;
    let mut path = Path::new(&robot, load, model.as_ref())?;
    let mut passed = Vec::new();
    let mut solve = |pose: &_| {
        let found = path.solve(pose);
        if figure.is_some() {
            passed.push(found.clone().ok());
        }
        found
    };
    let ending = if model.is_some() {
        at.answer_in_order(&robot, |pose| Ok(Banded(Passed::new(&robot, &load, solve(pose)?))))?
    } else {
        at.answer_in_order(&robot, |pose| Ok(Passed::new(&robot, &load, solve(pose)?)))?
    };
    missing_frequencies(&robot).iter().for_each(|why| note(format_args!("{why}")));
    if let Some(file) = figure {
        file.write(&at.printing.overwrite, |sheet| Ok(path_view(&robot, &load, &passed, sheet)?))?;
    }
    Ok(ending)
}

/// A pose of a path, in SI units unless a name says otherwise.
#[derive(Serialize)]
struct Passed {
    #[serde(skip)]
    is_loaded: bool,
    /// Whether the lengths may jump here.
    jump: bool,
    /// Unstrained lengths.
    lengths: Vec<f64>,
    /// At the platform, without the load.
    tensions: Vec<f64>,
    exit_tensions: Vec<f64>,
    /// Greatest distance of each cable across its chord.
    sags: Vec<f64>,
    /// dp under the load.
    deflection_mm: [f64; 3],
    /// |dp|.
    magnitude_mm: f64,
    /// Stiffness of the softest motion with the load.
    #[serde(rename = "least_stiffness_n_per_m")]
    least_stiffness: f64,
    /// With which the platform swings with the load, the mass of cables included; `null` for a robot that
    /// lacks `platform.inertia`.
    platform_frequency_hz: Option<f64>,
    /// Share of the platform in the kinetic energy of that motion.
    platform_share: Option<f64>,
    /// The lowest one of platform and cables.
    lowest_frequency_hz: Option<f64>,
    /// Numbers, from 1, of the cables that are slack with the load.
    slack_cables: Vec<usize>,
    /// Absent without an error model, and where the pose has no derivatives; `null` of a number without them.
    #[serde(skip_serializing_if = "Option::is_none")]
    standard_deviations: Option<Deviations>,
    /// Tensions without and with the load.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    out_of_limits: Vec<OutOfLimits>,
}

/// Standard deviations of the numbers of a pose that have these names.
#[derive(Serialize)]
struct Deviations {
    lengths: Vec<f64>,
    tensions: Vec<f64>,
    deflection_mm: [f64; 3],
    magnitude_mm: Option<f64>,
    #[serde(rename = "least_stiffness_n_per_m")]
    least_stiffness: Option<f64>,
    platform_frequency_hz: Option<f64>,
}

impl From<Bands> for Deviations {
    fn from(bands: Bands) -> Self {
        let Bands { lengths, tensions, displacement, magnitude, least_stiffness, platform_frequency } = bands;
        Self {
            lengths,
            tensions,
            deflection_mm: displacement.map(|std| 1e3 * std),
            magnitude_mm: magnitude.map(|std| 1e3 * std),
            least_stiffness,
            platform_frequency_hz: platform_frequency,
        }
    }
}

impl Passed {
    fn new(robot: &Robot, load: &Load, found: PathPose) -> Self {
        let PathPose { jump, tensions, exit_tensions, sags, deflection, bands, .. } = found;
        let dp = 1e3 * deflection.displacement();
        let Deflection { lengths, unloaded, loaded } = deflection;
        Self {
            is_loaded: *load != Load::none(),
            jump,
            tensions,
            exit_tensions,
            sags,
            deflection_mm: dp.into(),
            magnitude_mm: dp.norm(),
            least_stiffness: loaded.stability.least_stiffness(),
            platform_frequency_hz: found.swing.map(|swing| swing.platform),
            platform_share: found.swing.map(|swing| swing.platform_share),
            lowest_frequency_hz: found.swing.map(|swing| swing.lowest),
            slack_cables: loaded.report.slack.iter().map(|i| i + 1).collect(),
            standard_deviations: bands.map(Deviations::from),
            out_of_limits: OutOfLimits::all(robot, &lengths, &[&unloaded.equilibrium, &loaded.equilibrium]),
            lengths,
        }
    }
}

impl Row for Passed {
    fn columns(robot: &Robot) -> Vec<String> {
        let cables = robot.cables.len();
        let of_cables = [("length", "m"), ("tension", "n"), ("exit_tension", "n"), ("sag", "m")];
        let of_cables = of_cables.into_iter().flat_map(|(name, unit)| numbered(name, unit, cables));
        let of_platform = [
            "dx_mm",
            "dy_mm",
            "dz_mm",
            "magnitude_mm",
            "least_stiffness_n_per_m",
            "platform_frequency_hz",
            "platform_share",
            "lowest_frequency_hz",
            "slack_cables",
        ];
        let platform = of_platform.into_iter().map(str::to_owned);
        ["jump".to_owned()].into_iter().chain(of_cables).chain(platform).collect()
    }

    fn cells(&self) -> Vec<String> {
        let Self { lengths, tensions, exit_tensions, sags, deflection_mm, .. } = self;
        let of_cables = lengths.iter().chain(tensions).chain(exit_tensions).chain(sags);
        let numbers = of_cables.chain(deflection_mm).chain([&self.magnitude_mm, &self.least_stiffness]);
        let slack: Vec<_> = self.slack_cables.iter().map(ToString::to_string).collect();
        let frequencies = [self.platform_frequency_hz, self.platform_share, self.lowest_frequency_hz];
        let frequencies = frequencies.map(|of| of.map_or_else(String::new, |of| format!("{of:?}")));
        let first = [self.jump.to_string()].into_iter().chain(cells(numbers));
        first.chain(frequencies).chain([slack.join(" ")]).collect()
    }

    fn brief(&self) -> Vec<Brief> {
        let least = Brief::Shown("stiffness", "N/m", Some(self.least_stiffness));
        match self.is_loaded {
            false => vec![Brief::tensions("tensions", &self.tensions), least],
            true => {
                let tensions = Brief::tensions("unloaded at", &self.tensions);
                vec![tensions, Brief::Most("|dp|", "mm", Some(self.magnitude_mm)), least]
            }
        }
    }

    fn jumps(&self) -> bool {
        self.jump
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        vec![&self.out_of_limits]
    }
}

/// A pose of a path with its standard deviations in the table.
#[derive(Serialize)]
#[serde(transparent)]
struct Banded(Passed);

impl Row for Banded {
    fn columns(robot: &Robot) -> Vec<String> {
        let of_cables = [("std_length", "m"), ("std_tension", "n")];
        let of_cables =
            of_cables.into_iter().flat_map(|(name, unit)| numbered(name, unit, robot.cables.len()));
        let of_platform =
            ["dx_mm", "dy_mm", "dz_mm", "magnitude_mm", "least_stiffness_n_per_m", "platform_frequency_hz"];
        let platform = of_platform.into_iter().map(|name| format!("std_{name}"));
        Passed::columns(robot).into_iter().chain(of_cables).chain(platform).collect()
    }

    fn cells(&self) -> Vec<String> {
        let Self(passed) = self;
        let Some(std) = &passed.standard_deviations else {
            let empty = vec![String::new(); 2 * passed.lengths.len() + 6];
            return passed.cells().into_iter().chain(empty).collect();
        };
        let numbers = cells(std.lengths.iter().chain(&std.tensions).chain(&std.deflection_mm));
        let others = [std.magnitude_mm, std.least_stiffness, std.platform_frequency_hz];
        let others = others.map(|std| std.map(|std| format!("{std:?}")).unwrap_or_default());
        passed.cells().into_iter().chain(numbers).chain(others).collect()
    }

    fn brief(&self) -> Vec<Brief> {
        self.0.brief()
    }

    fn jumps(&self) -> bool {
        self.0.jump
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        self.0.out_of_limits()
    }
}
