//! `cdpr modes`: natural frequencies and motions of platform and cables.

mod massless;

use crate::program::answer::{OutOfLimits, decimal};
use crate::program::arguments::poses::{self, as_numbers};
use crate::program::arguments::{self, FreeArguments, With, number, with};
use crate::program::error::ProgramError;
use crate::program::output::{Ending, print_sentence, table};
use crate::program::pose::at_pose::{Brief, RobotAtPose, Row};
use crate::program::questions;
use crate::program::said::note;
use cdpr_dynamics::{Mode, Modes, Rotor, Swing, Wanted};
use cdpr_robot::{Platform, Pose, Robot, shown, visible};
use cdpr_statics::vibration::PoseModes;
use cdpr_statics::{
    DirectProblem, DirectStart, Equilibrium, StaticsError, Unstable, WantedPose, inverse, rough_pose,
};
use massless::Massless;
use serde::Serialize;
use std::borrow::Cow;
use std::sync::Once;

/// Motions that are listed where nothing else is asked for.
const NUMBER: usize = 12;

/// A robot at a pose or with lengths, a load, and which motions are looked for.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    at: RobotAtPose,
    #[command(flatten)]
    free: FreeArguments,
    /// Unstrained lengths of the cables, in the order of the file: l1,..,ln [m]. The search for their pose
    /// starts from --pose, or where straight cables would hold a point.
    #[arg(long, value_parser = arguments::lengths, conflicts_with = "poses", allow_hyphen_values = true)]
    lengths: Option<arguments::Lengths>,
    /// All natural motions up to this frequency [Hz].
    #[arg(long, value_name = "HZ", allow_negative_numbers = true, conflicts_with_all = ["number", "massless"])]
    below: Option<f64>,
    /// This many natural motions, the slowest; 12 if left out.
    #[arg(long, value_name = "N", value_parser = arguments::count::<1, 10_000>, conflicts_with = "massless")]
    number: Option<usize>,
    /// Cables without mass: the platform alone, with the shares of weight and cables in the energy.
    #[arg(long)]
    massless: bool,
    /// Winches that yield: servo=N/m, the stiffness with which each holds its cable at the drum, and
    /// winch=KG, the inertia of its rotor by the square of the drum's radius; none if left out.
    #[arg(long, value_parser = with, conflicts_with = "massless")]
    with: Option<With>,
}

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    if settings.massless {
        let solve = |robot: &Cow<'_, Robot>, problem: &DirectProblem<'_>, rest| {
            Ok(Massless::new(robot, &PoseModes::new(problem, rest)?))
        };
        return settings.answer(solve, Massless::print);
    }
    let wanted = settings.below.map_or(Wanted::Number(settings.number.unwrap_or(NUMBER)), Wanted::Below);
    let winches = winches(&settings.with.clone().unwrap_or_default())?;
    let solve = |robot: &Cow<'_, Robot>, problem: &DirectProblem<'_>, rest| {
        let found = Modes::on_winches(problem, &rest, wanted, winches)?;
        let swing = Modes::on_winches(problem, &rest, Wanted::OfPlatform, winches);
        let swing = swing.ok().and_then(|found| Swing::of(&found));
        let inertia_assumed = matches!(robot, Cow::Owned(_));
        let winches = winches.map(Winches::from);
        let found_pose = settings.free.found(&rest.pose);
        Ok(Answer { winches, inertia_assumed, found_pose, ..Answer::new(robot, &found, swing) })
    };
    settings.answer(solve, Answer::print)
}

/// `servo=N/m` and `winch=KG`, if one of them is there.
fn winches(with: &With) -> Result<Option<Rotor>, ProgramError> {
    with.check(&["winch", "servo"])?;
    let [mass, stiffness] = ["winch", "servo"].map(|name| with.value(name, None, number));
    match (mass?, stiffness?) {
        (mass, Some(stiffness)) => Ok(Some(Rotor { mass: mass.unwrap_or_default(), stiffness })),
        (None, None) => Ok(None),
        (Some(_), None) => {
            let expected = "expected servo=N/m, too: free rotors hold no platform";
            Err(ProgramError::Usage(format!("--with winch: {expected}")))
        }
    }
}

impl Settings {
    /// Prints what `solve` finds at the equilibrium of the lengths, or at each pose.
    fn answer<T: Row>(
        &self,
        solve: impl Fn(&Cow<'_, Robot>, &DirectProblem<'_>, Equilibrium) -> Result<T, StaticsError> + Sync,
        print: impl Fn(&T, &str),
    ) -> Result<Ending, ProgramError> {
        let load = self.at.load.load();
        let lengths = self.lengths.as_ref().map(arguments::Lengths::listed).transpose()?;
        let Some(lengths) = lengths else {
            let at_pose = |robot: &Robot, pose: &Pose| {
                let robot = with_inertia(robot);
                let held = inverse(&robot, WantedPose::at(pose).free(&self.free.free), &load)?;
                let problem = DirectProblem::new(&robot, &held.lengths, &load)?;
                let rest =
                    problem.with_unstable(Unstable::Accepted).direct(DirectStart::Near(&held.equilibrium))?;
                solve(&robot, &problem, rest.equilibrium)
            };
            return self.at.answer(at_pose, print);
        };
        let (robot, stated) = (self.at.robot()?, self.at.pose()?);
        questions::about_lengths(&robot, lengths);
        let robot = with_inertia(&robot);
        let problem = DirectProblem::new(&robot, lengths, &load)?;
        let start = stated.unwrap_or_else(|| rough_pose(&robot, lengths));
        let found = problem.direct(DirectStart::Pose(&start))?;
        questions::about_rest(&robot, "the equilibrium", (lengths, &load), &found, stated.as_ref());
        let pose = found.equilibrium.pose;
        let answer = solve(&robot, &problem, found.equilibrium)?;
        let heading = format!("{} at {}", shown(&robot.name), poses::place(&pose));
        self.at.print(&robot, &pose, &answer, |answer| print(answer, &heading))
    }
}

/// The robot, with an assumed inertia where it has none and rotates.
pub(super) fn with_inertia(robot: &Robot) -> Cow<'_, Robot> {
    if !robot.lacks_inertia() {
        return Cow::Borrowed(robot);
    }
    static NOTED: Once = Once::new();
    NOTED.call_once(|| {
        note(format_args!(
            "the robot has no inertia: that of a ball with the radius {} m is assumed",
            visible(robot.assumed_radius(), 3)
        ));
    });
    let platform = Platform { inertia: Some(robot.assumed_inertia()), ..robot.platform };
    Cow::Owned(Robot { platform, ..robot.clone() })
}

/// The natural motions of platform and cables.
#[derive(Serialize)]
struct Answer {
    /// The motions, the slowest first.
    modes: Vec<Motion>,
    /// How the platform swings, whether or not that motion is among them; missing where nothing resists any.
    #[serde(skip_serializing_if = "Option::is_none")]
    platform: Option<Swinging>,
    /// How many there are up to this frequency [Hz], by a count that shares no eigenvalues with them.
    counted: usize,
    complete_below_hz: f64,
    /// Whether the inertia of the platform is assumed.
    inertia_assumed: bool,
    /// Missing where the winches hold.
    #[serde(skip_serializing_if = "Option::is_none")]
    winches: Option<Winches>,
    /// The pose with its free coordinates as they are found.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "as_numbers")]
    found_pose: Option<Pose>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    out_of_limits: Vec<OutOfLimits>,
}

/// The winches where they yield.
#[derive(Serialize)]
struct Winches {
    /// Inertia of a rotor by the square of the drum's radius.
    mass_kg: f64,
    stiffness_n_per_m: f64,
}

impl From<Rotor> for Winches {
    fn from(Rotor { mass, stiffness }: Rotor) -> Self {
        Self { mass_kg: mass, stiffness_n_per_m: stiffness }
    }
}

/// The motion that contains most of the platform's slowest one on cables without mass.
#[derive(Serialize)]
struct Swinging {
    frequency_hz: f64,
    /// Share of platform and payload in the kinetic energy.
    platform_share: f64,
}

/// A natural motion of unit mass.
#[derive(Serialize)]
struct Motion {
    frequency_hz: f64,
    /// Greatest relative error of the frequency that the counts leave.
    within: f64,
    /// Share of platform and payload in the kinetic energy.
    platform_share: f64,
    cable_shares: Vec<f64>,
    /// Part of the platform's share that is its slowest motion on cables without mass.
    swing_share: f64,
    /// Translation of P [1/√kg].
    translation: [f64; 3],
    /// Rotation vector [rad/(m √kg)].
    rotation: [f64; 3],
    /// Radius of gyration of the platform [m], zero of one that does not rotate.
    #[serde(skip)]
    gyration: f64,
}

impl Row for Answer {
    fn columns(_: &Robot) -> Vec<String> {
        ["lowest_frequency_hz", "platform_frequency_hz", "platform_share", "counted", "complete_below_hz"]
            .map(str::to_owned)
            .into()
    }

    fn cells(&self) -> Vec<String> {
        let number = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:?}"));
        let platform = self.platform.as_ref();
        vec![
            number(self.lowest()),
            number(platform.map(|mode| mode.frequency_hz)),
            number(platform.map(|mode| mode.platform_share)),
            self.counted.to_string(),
            number(Some(self.complete_below_hz)),
        ]
    }

    fn cases(&self) -> Option<Vec<Vec<String>>> {
        let cables = self.modes.first()?.cable_shares.len();
        let numbered =
            |name: &str, count: usize| (1..=count).map(|k| format!("{name}_{k}")).collect::<Vec<_>>();
        let along = |name: &str| ["x", "y", "z"].map(|axis| format!("{name}_{axis}"));
        let names = ["frequency_hz", "within", "platform_share"].map(str::to_owned).into_iter();
        let names = names.chain(numbered("cable_share", cables)).chain(["swing_share".to_owned()]);
        let names = names.chain(along("translation")).chain(along("rotation"));
        let row = |mode: &Motion| {
            let first = [mode.frequency_hz, mode.within, mode.platform_share];
            let all =
                [&first[..], &mode.cable_shares, &[mode.swing_share], &mode.translation, &mode.rotation];
            all.concat().iter().map(|value| format!("{value:?}")).collect()
        };
        Some([names.collect()].into_iter().chain(self.modes.iter().map(row)).collect())
    }

    fn found_pose(&self) -> Option<Pose> {
        self.found_pose
    }

    fn brief(&self) -> Vec<Brief> {
        let own = self.platform.as_ref().filter(|platform| platform.platform_share >= OWN);
        let platform = Brief::Shown("platform", "Hz", own.map(|platform| platform.frequency_hz));
        vec![Brief::Least("lowest", "Hz", self.lowest()), platform]
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        vec![&self.out_of_limits]
    }
}

/// Share of the energy of a motion from which on it is one of the platform.
pub(crate) const OWN: f64 = 0.5;

/// How fast the platform swings, where a motion is its own.
pub(super) fn swinging(frequency: f64, share: f64) -> String {
    let percent = decimal(100.0 * share, 1);
    if share < OWN {
        format!(
            "The platform swings in many motions of the cables: the one that has most of it, at {frequency:.4} Hz, \
             has {percent} % of its energy there"
        )
    } else {
        format!("The platform swings at {frequency:.4} Hz, with {percent} % of the energy of that motion")
    }
}

impl Answer {
    fn new(robot: &Robot, found: &Modes, swing: Option<Swing>) -> Self {
        let Platform { mass, inertia, .. } = robot.platform;
        let gyration = inertia.map_or(0.0, |inertia| (inertia.trace() / mass).sqrt());
        let motion = |mode: &Mode| Motion {
            frequency_hz: mode.frequency,
            within: mode.within,
            platform_share: mode.platform_share,
            cable_shares: mode.cable_shares.clone(),
            swing_share: mode.swing_share,
            translation: mode.translation.into(),
            rotation: mode.rotation.into(),
            gyration,
        };
        Self {
            modes: found.modes.iter().map(motion).collect(),
            platform: swing
                .map(|swing| Swinging { frequency_hz: swing.platform, platform_share: swing.platform_share }),
            counted: found.counted,
            complete_below_hz: found.complete_below,
            inertia_assumed: false,
            winches: None,
            found_pose: None,
            out_of_limits: OutOfLimits::all(robot, &found.lengths, &[&found.equilibrium]),
        }
    }

    /// The lowest frequency of a vibration [Hz].
    fn lowest(&self) -> Option<f64> {
        self.modes.iter().find(|mode| !mode.is_free()).map(|mode| mode.frequency_hz)
    }

    fn print(&self, heading: &str) {
        let (counted, below) = (self.counted, self.complete_below_hz);
        match self.lowest() {
            Some(lowest) => print_sentence(&format!(
                "{heading}: lowest natural frequency {lowest:.4} Hz; {counted} motions up to {below:.4} Hz."
            )),
            None => print_sentence(&format!("{heading}: no natural frequencies up to {below:.4} Hz.")),
        }
        for mode in self.modes.iter().filter(|mode| mode.is_free()) {
            print_sentence(&format!("Nothing resists a motion of the platform {}.", mode.direction()));
        }
        if let Some(Swinging { frequency_hz, platform_share }) = &self.platform {
            print_sentence(&format!("{}.", swinging(*frequency_hz, *platform_share)));
        }
        let names = ["frequency [Hz]", "platform [%]", "cables [%]", "moves most", "within"];
        let mut rows = table(&names);
        for mode in &self.modes {
            let cells = [
                format!("{:.4}", mode.frequency_hz),
                decimal(100.0 * mode.platform_share, 1),
                most(&mode.cable_shares),
                mode.direction(),
                format!("{:.0e}", mode.within),
            ];
            rows.add_row(cells);
        }
        println!("{rows}");
        println!("shares of the kinetic energy, of the cables the two largest by number");
        println!("within: bound of the relative error of the frequency");
        if let Some(Winches { mass_kg, stiffness_n_per_m }) = &self.winches {
            print_sentence(&format!(
                "winches: rotors of {mass_kg} kg at the drum, with a stiffness of \
                 {stiffness_n_per_m} N/m; the share of a cable contains that of its rotor"
            ));
        }
        OutOfLimits::print(&self.out_of_limits);
    }
}

impl Motion {
    /// Whether it is no vibration, because nothing resists it.
    fn is_free(&self) -> bool {
        self.frequency_hz <= 0.0
    }

    /// The direction in which the platform moves most, and the axis about which it turns most.
    fn direction(&self) -> String {
        /// Share of the platform below which its direction is rounding.
        const LEAST_SHARE: f64 = 1e-4;
        /// Part of the motion of a platform below which a translation or rotation is rounding.
        const ROUNDING: f64 = 1e-7;
        if self.platform_share < LEAST_SHARE {
            return "cables alone".to_owned();
        }
        // Of components that are equal but for rounding the first one.
        let largest = |vector: &[f64; 3]| {
            let most = vector.iter().fold(0.0, |most: f64, component| most.max(component.abs()));
            let axis = vector.iter().position(|component| component.abs() >= (1.0 - 1e-6) * most);
            ["x", "y", "z"][axis.unwrap_or_default()]
        };
        let norm =
            |vector: &[f64; 3]| vector.iter().map(|component| component * component).sum::<f64>().sqrt();
        let [moved, turned] = [norm(&self.translation), self.gyration * norm(&self.rotation)];
        let least = ROUNDING * moved.max(turned);
        match (moved <= least, turned <= least) {
            (_, true) => format!("along {}", largest(&self.translation)),
            (true, false) => format!("about {}", largest(&self.rotation)),
            _ => format!("along {}, about {}", largest(&self.translation), largest(&self.rotation)),
        }
    }
}

/// The cables with the largest shares, by number; of shares that are equal but for rounding the first.
fn most(shares: &[f64]) -> String {
    let mut order: Vec<_> = shares.iter().enumerate().collect();
    order.sort_by(|one, other| (1e6 * other.1).round().total_cmp(&(1e6 * one.1).round()));
    let named = order.iter().take(2).filter(|(_, share)| **share >= 0.0005);
    let named = named.map(|(i, share)| format!("{}: {}", i + 1, decimal(100.0 * **share, 1)));
    named.collect::<Vec<_>>().join(", ")
}
