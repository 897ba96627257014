//! `cdpr response`: how a platform that is shaken moves.

use crate::program::answer::{OutOfLimits, decimal};
use crate::program::arguments::poses::as_numbers;
use crate::program::arguments::{
    self, FigureArgument, Format, FreeArguments, NO_DRAG, With, figure, print_record, with,
};
use crate::program::error::ProgramError;
use crate::program::output::{Ending, print_sentence, table};
use crate::program::pose::at_pose::{Brief, RobotAtPose, Row};
use crate::program::pose::modes::{OWN, with_inertia};
use crate::program::said;
use cdpr_dynamics::{
    Damping, FrequencyResponse, Mode, Modes, PointMotion, ShakenPoint, Wanted, worst_amplitude,
};
use cdpr_report::{Amplitudes, Sheet, amplitudes};
use cdpr_robot::{Pose, Robot, Vector3, shown, significant};
use cdpr_statics::{DirectProblem, DirectStart, StaticsError, Unstable, WantedPose, inverse};
use serde::Serialize;

/// Frequencies at equal distances where no other number is given.
const NUMBER: usize = 200;

/// What is printed where nothing damps a motion.
const NO_BOUND: &str = "no bound";

/// Peaks that are listed.
const LISTED: usize = 12;

/// A robot at a pose, what shakes it, and what damps its cables.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    at: RobotAtPose,
    #[command(flatten)]
    free: FreeArguments,
    /// The highest frequency [Hz].
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    below: f64,
    /// This many frequencies at equal distances, 200 if left out; the natural ones come on top.
    #[arg(long, value_name = "N", value_parser = arguments::count::<1, 10_000>)]
    number: Option<usize>,
    /// damping=TAU and drag=RATE, what damps the cables; 2e-4 s and none if left out.
    ///
    /// A cable that is stretched at a rate dε/dt bears EA TAU dε/dt more [s]. The air takes RATE times the
    /// mass per length for each m/s [1/s].
    #[arg(long, value_name = "NAMES", value_parser = with)]
    with: Option<With>,
    /// Point of the platform that is shaken and that moves: x,y,z in its frame [m]; P if left out.
    #[arg(long, value_parser = arguments::components::<3>, allow_hyphen_values = true)]
    marker: Option<[f64; 3]>,
    /// File for a figure of the amplitudes (.svg, .pdf, .png); behind its name: width=MM, untitled.
    #[arg(long, value_name = "FILE", value_parser = figure, conflicts_with = "poses")]
    figure: Option<FigureArgument>,
}

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    let Settings { at, figure, .. } = settings;
    let with = With::known(settings.with.as_ref(), &["damping", "drag"])?;
    let damping = with.damping()?.unwrap_or(Damping::USUAL);
    let pose = at.pose()?;
    if damping.drag == 0.0 && (pose.is_none() || at.printing.format() == Format::Csv) {
        // The text of an answer says it where the peaks are, and JSON has the drag.
        said::note(format_args!("{NO_DRAG}"));
    }
    let is_table = matches!(at.printing.format(), Format::Csv) && pose.is_some();
    if !is_table && figure.is_none() {
        return at.answer(|robot, pose| settings.solve(robot, pose, damping), Answer::print);
    }
    let robot = at.robot()?;
    let Some(pose) = pose else {
        return Err(ProgramError::Usage("--figure: expected --pose x,y,z".to_owned()));
    };
    let answer = settings.solve(&robot, &pose, damping)?;
    if let Some(file) = figure {
        file.write(&at.printing.overwrite, |sheet| answer.figure(&robot, sheet))?;
    }
    if is_table {
        answer.print_table();
        return Ok(answer.ending());
    }
    at.print(&robot, &pose, &answer, |answer| answer.print(&shown(&robot.name)))
}

impl Settings {
    fn solve(&self, robot: &Robot, pose: &Pose, damping: Damping) -> Result<Answer, StaticsError> {
        let (robot, load) = (with_inertia(robot), self.at.load.load());
        let held = inverse(&robot, WantedPose::at(pose).free(&self.free.free), &load)?;
        let problem = DirectProblem::new(&robot, &held.lengths, &load)?;
        let rest = problem
            .with_unstable(Unstable::Accepted)
            .direct(DirectStart::Near(&held.equilibrium))?
            .equilibrium;
        let response = FrequencyResponse::new(&problem, &rest, self.below, damping)?;
        let natural = Modes::new(&problem, &rest, Wanted::Below(self.below))?;
        let number = self.number.unwrap_or(NUMBER);
        let equal = (0..=number).map(|k| self.below * k as f64 / number as f64);
        let mut frequencies: Vec<f64> =
            equal.chain(natural.modes.iter().map(|mode| mode.frequency)).collect();
        frequencies.sort_by(f64::total_cmp);
        frequencies.dedup();
        let lever = rest.pose.rotation * Vector3::from(self.marker.unwrap_or_default());
        let point = ShakenPoint::new(&response, &lever)?;
        let at = |frequency: &f64| Ok(At::from(&point.at(*frequency)?));
        let frequencies: Vec<At> = frequencies.iter().map(at).collect::<Result<_, StaticsError>>()?;
        Ok(Answer {
            damping_s: damping.stretch,
            drag_per_s: damping.drag,
            inertia_assumed: matches!(robot, std::borrow::Cow::Owned(_)),
            is_of_cables: is_of_cables(&frequencies, &natural),
            frequencies,
            found_pose: self.free.found(&rest.pose),
            out_of_limits: OutOfLimits::all(&robot, &held.lengths, &[&rest]),
        })
    }
}

/// How a platform that is shaken moves.
#[derive(Serialize)]
struct Answer {
    damping_s: f64,
    drag_per_s: f64,
    /// Whether the inertia of the platform is assumed.
    inertia_assumed: bool,
    /// Whether the largest amplitude is that of a motion of the cables.
    #[serde(skip)]
    is_of_cables: bool,
    /// Without motion first.
    frequencies: Vec<At>,
    /// The pose with its free coordinates as they are found.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "as_numbers")]
    found_pose: Option<Pose>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    out_of_limits: Vec<OutOfLimits>,
}

/// What is found at a frequency.
#[derive(Serialize)]
struct At {
    frequency_hz: f64,
    /// Largest amplitude of the point for a force there of any direction, the norm of those along x, y and z.
    /// What nothing bounds is infinite here and below, `null` in JSON.
    amplitude_mm_per_n: f64,
    /// Amplitude in x, y and z for forces in these directions, row by row: real and imaginary part.
    per_force_mm_per_n: [[[f64; 2]; 3]; 3],
    /// The same for the length that each winch takes in, cable by cable.
    per_winch_mm_per_mm: Vec<[[f64; 2]; 3]>,
}

impl From<&PointMotion> for At {
    fn from(PointMotion { frequency, per_force, per_shortening }: &PointMotion) -> Self {
        Self {
            frequency_hz: *frequency,
            amplitude_mm_per_n: 1e3 * worst_amplitude(per_force),
            per_force_mm_per_n: [0, 1, 2]
                .map(|i| [0, 1, 2].map(|j| [1e3 * per_force[(i, j)].re, 1e3 * per_force[(i, j)].im])),
            per_winch_mm_per_mm: per_shortening
                .column_iter()
                .map(|of| [0, 1, 2].map(|i| [of[i].re, of[i].im]))
                .collect(),
        }
    }
}

impl At {
    /// Amplitudes for forces along the axes, each in its own direction [mm/N].
    fn along(&self) -> [f64; 3] {
        [0, 1, 2].map(|k| size(&self.per_force_mm_per_n[k][k]))
    }

    /// Amplitude of the point for each winch [mm/mm].
    fn of_winches(&self) -> Vec<f64> {
        let norm = |of: &[[f64; 2]; 3]| of.iter().flatten().map(|part| part * part).sum::<f64>().sqrt();
        self.per_winch_mm_per_mm.iter().map(norm).collect()
    }
}

/// The largest amplitude.
fn peak(frequencies: &[At]) -> Option<&At> {
    frequencies.iter().max_by(|one, other| one.amplitude_mm_per_n.total_cmp(&other.amplitude_mm_per_n))
}

/// Whether the natural motion nearest to the largest amplitude is one of the cables.
fn is_of_cables(frequencies: &[At], natural: &Modes) -> bool {
    let Some(peak) = peak(frequencies) else { return false };
    let away = |mode: &&Mode| (mode.frequency - peak.frequency_hz).abs();
    let nearest = natural.modes.iter().min_by(|one, other| away(one).total_cmp(&away(other)));
    nearest.is_some_and(|mode| mode.platform_share < OWN)
}

/// The largest of amplitudes, zero of none.
fn largest_of(amplitudes: &[f64]) -> f64 {
    amplitudes.iter().copied().fold(0.0, f64::max)
}

fn size([re, im]: &[f64; 2]) -> f64 {
    re.hypot(*im)
}

/// An amplitude [mm/N], or that nothing bounds it.
fn bounded(value: f64) -> String {
    if value.is_finite() { significant(value, 3) } else { NO_BOUND.to_owned() }
}

/// A number of a table, empty where nothing bounds it.
fn cell(value: f64) -> String {
    if value.is_finite() { format!("{value:?}") } else { String::new() }
}

impl Answer {
    /// The largest amplitude beyond rest.
    fn peak(&self) -> Option<&At> {
        peak(&self.frequencies)
    }

    /// Whether the largest amplitude is a number that nothing real has: the air damps motions across cables,
    /// and the model has none.
    fn is_without_air(&self) -> bool {
        self.drag_per_s == 0.0 && self.is_of_cables
    }

    /// Frequencies whose amplitude no neighbour exceeds, and those without a bound, the largest first.
    fn peaks(&self) -> Vec<&At> {
        let sizes: Vec<f64> = self.frequencies.iter().map(|at| at.amplitude_mm_per_n).collect();
        let without_bound = |at: &At| largest_of(&at.of_winches()).max(at.amplitude_mm_per_n).is_infinite();
        let is_peak = |k: usize| {
            let is_between = k + 1 < sizes.len();
            without_bound(&self.frequencies[k])
                || (is_between && sizes[k] >= sizes[k - 1] && sizes[k] > sizes[k + 1])
        };
        let mut peaks: Vec<&At> =
            (1..sizes.len()).filter(|k| is_peak(*k)).map(|k| &self.frequencies[k]).collect();
        peaks.sort_by(|one, other| other.amplitude_mm_per_n.total_cmp(&one.amplitude_mm_per_n));
        peaks
    }

    fn print(&self, heading: &str) {
        if let (Some(still), Some(most)) = (self.frequencies.first(), self.peak()) {
            let at_rest = match bounded(still.amplitude_mm_per_n).as_str() {
                NO_BOUND => "at rest nothing resists it".to_owned(),
                at_rest => format!("at rest it moves it by {at_rest} mm/N"),
            };
            let most_of = match bounded(most.amplitude_mm_per_n).as_str() {
                NO_BOUND => "without a bound".to_owned(),
                most => format!("by up to {most} mm/N"),
            };
            let at = format!("at {:.4} Hz", most.frequency_hz);
            if self.is_without_air() && most.amplitude_mm_per_n.is_finite() {
                let at_rest = at_rest.replace("it moves it", "a force moves the point");
                print_sentence(&format!("{heading}: no bound is known without drag; {at_rest}."));
                print_sentence(&format!(
                    "The largest peak, {} mm/N {at}, is one of the cables, which nothing damps across their \
                     stretch: it is far above a real one; --with drag=RATE.",
                    bounded(most.amplitude_mm_per_n)
                ));
            } else {
                print_sentence(&format!("{heading}: a force shakes the point {most_of}, {at}; {at_rest}."));
            }
        }
        let peaks = self.peaks();
        let damping =
            format!("Damping of the cables: stretch {} s, drag {} 1/s.", self.damping_s, self.drag_per_s);
        if peaks.is_empty() {
            let end = self.frequencies.last().map_or(0.0, |at| at.frequency_hz);
            print_sentence(&format!(
                "{damping} No frequency between 0 and {} Hz has a larger amplitude than those next to it: \
                 there is no peak; --below HZ looks further.",
                significant(end, 4)
            ));
        } else {
            println!("{damping} The largest peaks:");
            Self::print_peaks(&peaks);
        }
        if self.drag_per_s == 0.0 && !self.is_without_air() {
            print_sentence(NO_DRAG);
        }
        OutOfLimits::print(&self.out_of_limits);
    }

    fn print_peaks(peaks: &[&At]) {
        let names = ["frequency [Hz]", "amplitude [mm/N]", "x, y, z along [mm/N]", "winches [mm/mm]"];
        let mut rows = table(&names);
        for at in peaks.iter().take(LISTED) {
            let winches = largest_of(&at.of_winches());
            let along = at.along().map(bounded).join(" ");
            let cells = [
                format!("{:.4}", at.frequency_hz),
                bounded(at.amplitude_mm_per_n),
                along,
                if winches.is_finite() { decimal(winches, 2) } else { NO_BOUND.to_owned() },
            ];
            rows.add_row(cells);
        }
        println!("{rows}");
        println!("amplitude: of a force in the worst direction, |(x, y, z)| of the motion");
        println!("x, y, z along: by a force along the axis");
        println!("winches: the one that moves the point most");
    }

    /// A line of CSV for each frequency.
    fn print_table(&self) {
        let cables = self.frequencies.first().map_or(0, |at| at.per_winch_mm_per_mm.len());
        let winches = (1..=cables).map(|i| format!("winch_{i}_mm_per_mm"));
        let names = ["frequency_hz", "amplitude_mm_per_n", "x_mm_per_n", "y_mm_per_n", "z_mm_per_n"];
        print_record(&names.map(str::to_owned).into_iter().chain(winches).collect::<Vec<_>>());
        for at in &self.frequencies {
            let numbers = [at.frequency_hz, at.amplitude_mm_per_n].into_iter().chain(at.along());
            let numbers = numbers.chain(at.of_winches());
            print_record(&numbers.map(cell).collect::<Vec<_>>());
        }
    }

    fn figure(&self, robot: &Robot, sheet: Sheet) -> Result<String, ProgramError> {
        let curve = |name: &str, of: &dyn Fn(&At) -> f64| {
            let points = self.frequencies.iter().map(|at| (at.frequency_hz, of(at)));
            let points = points.filter(|(_, amplitude)| amplitude.is_finite()).collect();
            (name.to_owned(), points)
        };
        let curves = [
            curve("worst direction", &|at| at.amplitude_mm_per_n),
            curve("x", &|at| at.along()[0]),
            curve("y", &|at| at.along()[1]),
            curve("z", &|at| at.along()[2]),
        ];
        let title = format!("{} shaken by a force", shown(&robot.name));
        let lines =
            [format!("damping of the cables: stretch {} s, drag {} 1/s", self.damping_s, self.drag_per_s)];
        let given = Amplitudes { title: &title, lines: &lines, y: "amplitude [mm/N]", curves: &curves };
        Ok(amplitudes(&given, sheet)?)
    }
}

impl Row for Answer {
    fn columns(_: &Robot) -> Vec<String> {
        ["amplitude_at_hz", "amplitude_mm_per_n", "static_mm_per_n"].map(str::to_owned).into()
    }

    fn cells(&self) -> Vec<String> {
        let number = |value: Option<f64>| value.map_or_else(String::new, cell);
        vec![
            number(self.peak().map(|at| at.frequency_hz)),
            number(self.peak().map(|at| at.amplitude_mm_per_n)),
            number(self.frequencies.first().map(|at| at.amplitude_mm_per_n)),
        ]
    }

    fn found_pose(&self) -> Option<Pose> {
        self.found_pose
    }

    fn brief(&self) -> Vec<Brief> {
        let peak = self.peak();
        let most = Brief::Most("peak", "mm/N", peak.map(|at| at.amplitude_mm_per_n));
        vec![most, Brief::Shown("peak at", "Hz", peak.map(|at| at.frequency_hz))]
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        vec![&self.out_of_limits]
    }
}
