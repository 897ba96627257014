//! `cdpr direct`: where the platform stands for given unstrained lengths.
//!
//! Cases come one from the arguments, or one or many from a file.

use crate::program::answer::Found;
use crate::program::arguments::poses::{self, PoseArguments};
use crate::program::arguments::{self, Printing, RobotArgument};
use crate::program::error::ProgramError;
use crate::program::output::{Ending, patiently, print_sentence, progress};
use crate::program::pose::at_pose::Failure;
use crate::program::questions;
use cdpr_robot::{Robot, Vector3, Wrench, from_json, plausible, shown};
use cdpr_statics::{Certificate, DirectProblem, DirectStart, Load, StaticsError, check_lengths, rough_pose};
use cdpr_study::{InputKind, StudyError, other_kind, read_text};
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// The robot, the lengths and the load.
#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("what").required(true).args(["lengths", "from"]))]
pub(crate) struct Settings {
    #[command(flatten)]
    robot: RobotArgument,
    /// Unstrained lengths of the cables, in the order of the file: l1,..,ln [m].
    #[arg(long, value_parser = arguments::lengths, allow_hyphen_values = true)]
    lengths: Option<arguments::Lengths>,
    /// Mass of the platform with all it carries, instead of the file's [kg].
    #[arg(long, value_parser = arguments::number, allow_hyphen_values = true)]
    mass: Option<f64>,
    /// Force on the platform, in the base frame: fx,fy,fz [N].
    #[arg(long, value_parser = arguments::components::<3>, allow_hyphen_values = true)]
    force: Option<[f64; 3]>,
    /// Moment about P, of constant components in the base frame: mx,my,mz [N m].
    #[arg(long, value_parser = arguments::components::<3>, allow_hyphen_values = true)]
    moment: Option<[f64; 3]>,
    /// Mass added at the platform's centre of mass [kg].
    #[arg(long, value_parser = arguments::mass, allow_hyphen_values = true)]
    payload: Option<f64>,
    /// Where the search starts; if left out, where straight cables would hold a point.
    #[command(flatten)]
    pose: PoseArguments,
    /// certificate: prove how close the exact equilibrium is.
    #[arg(long, value_name = "NAMES", value_parser = arguments::with)]
    with: Option<arguments::With>,
    /// JSON file with cases: one, a list, or one a line, as `inverse` and `deflection` print them with
    /// `--format json`; - for the standard input.
    ///
    /// A case: {"lengths": [..], "mass": .., "force": [..], "moment": [..], "payload": .., "pose": [..]}.
    #[arg(long, value_name = "FILE")]
    #[arg(conflicts_with_all = ["lengths", "mass", "force", "moment", "payload", "pose", "rpy"])]
    from: Option<PathBuf>,
    #[command(flatten)]
    printing: Printing,
}

/// A direct problem, also as a file has it. The fields behind `certify` are those of an answer of `inverse` or
/// `deflection`, which are of no importance here.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Case {
    lengths: Vec<f64>,
    mass: Option<f64>,
    force: Option<[f64; 3]>,
    moment: Option<[f64; 3]>,
    payload: Option<f64>,
    /// Start of the search: position, or position and quaternion, three or seven numbers.
    pose: Option<Vec<f64>>,
    /// Where the inverse model has found a rest with free coordinates: the start then.
    found_pose: Option<Vec<f64>>,
    certify: bool,
    tensions: IgnoredAny,
    exit_tensions: IgnoredAny,
    cable_forces: IgnoredAny,
    stable: IgnoredAny,
    least_stiffness: IgnoredAny,
    neutral: IgnoredAny,
    report: IgnoredAny,
    out_of_limits: IgnoredAny,
    jump: IgnoredAny,
    questions: IgnoredAny,
    given: IgnoredAny,
    roll_pitch_yaw_deg: IgnoredAny,
    loops: IgnoredAny,
    iterations: IgnoredAny,
    residual: IgnoredAny,
    others: IgnoredAny,
    deflection_mm: IgnoredAny,
    magnitude_mm: IgnoredAny,
    rounding_mm: IgnoredAny,
    rotation_deg: IgnoredAny,
    unloaded: IgnoredAny,
    loaded: IgnoredAny,
    /// Why the inverse model has no lengths.
    error: Option<CaseError>,
}

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    let robot = questions::open_robot(settings.robot.path())?;
    let (name, certify) = (shown(&robot.name), settings.certify()?);
    let cases = match (&settings.from, &settings.lengths) {
        (Some(path), _) => Cases::read(path)?,
        (None, lengths) => Cases::One(Box::new(settings.case(lengths.as_ref())?)),
    };
    match cases {
        Cases::One(case) => {
            case.question(&robot);
            let answer = patiently("solving", || solve(&robot, &case, "the equilibrium", certify));
            let answer = match &settings.from {
                Some(path) => answer.map_err(ProgramError::in_file(path))?,
                None => answer?,
            };
            settings.printing.format().print(&answer, |answer| answer.print(&name, &case.lengths))?;
            Ok(answer.ending())
        }
        Cases::List(cases) => {
            cases.iter().for_each(|case| case.question(&robot));
            let progress = progress(cases.len(), "cases");
            let answer = |(i, case): (usize, &Case)| {
                let name = format!("the equilibrium of case {}", i + 1);
                let answer = solve(&robot, case, &name, certify).into();
                progress.inc(1);
                answer
            };
            let answers: Vec<Entry> = cases.iter().enumerate().map(answer).collect();
            progress.finish_and_clear();
            settings.printing.format().print(&answers, |answers| {
                for (i, (entry, case)) in answers.iter().zip(&cases).enumerate() {
                    entry.print(&format!("Case {}", i + 1), &case.lengths);
                }
            })?;
            let well = answers.iter().all(|entry| entry.ending() == Ending::Well);
            Ok(if well { Ending::Well } else { Ending::SomethingWrong })
        }
    }
}

impl Settings {
    fn certify(&self) -> Result<bool, ProgramError> {
        let with = self.with.clone().unwrap_or_default();
        with.check(&["certificate"])?;
        with.has("certificate")
    }

    fn case(&self, lengths: Option<&arguments::Lengths>) -> Result<Case, ProgramError> {
        let pose = self.pose.given()?.map(|pose| poses::pose_numbers(&pose).to_vec());
        Ok(Case {
            lengths: lengths.map_or(Ok(Vec::new()), |lengths| lengths.listed().map(<[f64]>::to_vec))?,
            mass: self.mass,
            force: self.force,
            moment: self.moment,
            payload: self.payload,
            pose,
            certify: self.certify()?,
            ..Case::default()
        })
    }
}

impl Case {
    /// Where the search starts.
    fn start(&self) -> Option<&Vec<f64>> {
        self.found_pose.as_ref().or(self.pose.as_ref())
    }

    /// Asks about lengths, mass, load and start.
    fn question(&self, robot: &Robot) {
        questions::about_lengths(robot, &self.lengths);
        // A mass that is not positive is refused.
        let mass = self.mass.filter(|mass| *mass > 0.0);
        questions::ask(mass.and_then(|mass| plausible::mass(robot, "mass", mass)));
        questions::about_load(robot, &self.load());
        if let Some(start) = self.start().and_then(|numbers| poses::stated_pose(numbers).ok()) {
            questions::about_pose(robot, "pose", &start);
        }
    }

    fn load(&self) -> Load {
        let vector = |components: Option<[f64; 3]>| components.map_or_else(Vector3::zeros, Vector3::from);
        let wrench = Wrench { force: vector(self.force), moment: vector(self.moment) };
        Load { payload: self.payload.unwrap_or(0.0), wrench }
    }
}

/// Why a case has no lengths.
#[derive(Deserialize)]
struct CaseError {
    message: String,
}

enum Cases {
    One(Box<Case>),
    List(Vec<Case>),
}

/// What a file has.
const CASE: &str = "expected a case of lengths, mass, force, moment, payload, pose and certify, or what `inverse` \
                    or `deflection` prints with --format json";

impl Cases {
    fn read(path: &Path) -> Result<Self, StudyError> {
        let text = read_text(path, InputKind::Cases)?;
        let lines: Vec<&str> = text.lines().filter(|line| !line.trim().is_empty()).collect();
        let is_one_a_line = lines.len() > 1 && lines.iter().all(|line| line.trim_end().ends_with('}'));
        let cases = if text.trim_start().starts_with('[') {
            from_json(&text).map(Self::List)
        } else if is_one_a_line && lines.iter().all(|line| line.starts_with('{')) {
            from_json(&format!("[{}]", lines.join(",\n"))).map(Self::List)
        } else {
            from_json(&text).map(|case| Self::One(Box::new(case)))
        };
        cases.map_err(|mut source| {
            // The list of serde has the fields of answers, too.
            if let Some((unknown, _)) = source.message.split_once("`, expected") {
                source.message = format!("{unknown}`: {CASE}");
            }
            let other = other_kind(path, &text, InputKind::Cases);
            other.unwrap_or_else(|| StudyError::Format { path: path.to_owned(), source })
        })
    }
}

/// The equilibrium of a case.
#[derive(Serialize)]
struct Answer {
    #[serde(flatten)]
    found: Found,
    #[serde(skip_serializing_if = "Option::is_none")]
    certificate: Option<Proof>,
}

/// The proof of how close the exact equilibrium is, or why there is no proof.
#[derive(Serialize)]
#[serde(untagged)]
enum Proof {
    Given { position: f64, rotation: f64, force: f64, least_stiffness: f64, stable: bool },
    None { error: Failure },
}

/// The answer to one case of a list.
#[derive(Serialize)]
#[serde(untagged)]
enum Entry {
    Answer(Box<Answer>),
    Failed { error: Failure },
}

/// Solves a case and asks about the answer, which is called `name`.
fn solve(robot: &Robot, case: &Case, name: &str, prove: bool) -> Result<Answer, StaticsError> {
    let mut robot = robot.clone();
    if let Some(mass) = case.mass {
        robot.platform.mass = mass;
        robot.validate()?;
    }
    if let Some(CaseError { message }) = &case.error {
        return Err(StaticsError::Invalid {
            field: "lengths".to_owned(),
            value: "missing".to_owned(),
            expected: format!("lengths; the inverse model has none: {message}"),
        });
    }
    let load = case.load();
    let start = match case.start() {
        Some(numbers) => poses::stated_pose(numbers).map_err(|_| StaticsError::Invalid {
            field: "pose".to_owned(),
            value: format!("{numbers:?}"),
            expected: "x,y,z [m] or x,y,z,qw,qx,qy,qz, with a unit quaternion, qw first".to_owned(),
        })?,
        None => rough_pose(&robot, &case.lengths),
    };
    if !start.is_finite() {
        return Err(StaticsError::Invalid {
            field: "lengths".to_owned(),
            value: format!("{:?}", case.lengths),
            expected: "lengths within reach of the robot's frame [m]".to_owned(),
        });
    }
    check_lengths(&robot, &case.lengths)?;
    let problem = DirectProblem::new(&robot, &case.lengths, &load)?;
    let solution = problem.direct(DirectStart::Pose(&start)).inspect_err(|_| {
        if case.start().is_some() {
            questions::ask(plausible::lengths_at(&robot, &case.lengths, &start));
        }
    })?;
    questions::about_rest(&robot, name, (&case.lengths, &load), &solution, case.start().map(|_| &start));
    let certificate = (prove || case.certify).then(|| problem.certify(&solution).into());
    Ok(Answer { found: Found::new(&robot, &case.lengths, &solution), certificate })
}

impl Answer {
    fn ending(&self) -> Ending {
        match self.certificate {
            Some(Proof::None { .. }) => Ending::SomethingWrong,
            _ => self.found.ending(),
        }
    }

    fn print(&self, name: &str, lengths: &[f64]) {
        self.found.print(name, lengths);
        match &self.certificate {
            Some(Proof::Given { position, rotation, force, least_stiffness, .. }) => {
                print_sentence(&format!(
                    "proved: an exact equilibrium is within {position:.1e} m, {rotation:.1e} rad and {force:.1e} N of \
                     this one, whose residuals are what is left of the equations here; softest motion at least \
                     {least_stiffness:.1} N/m"
                ));
            }
            Some(Proof::None { error }) => print_sentence(&error.message),
            None => {}
        }
    }
}

impl Entry {
    fn ending(&self) -> Ending {
        match self {
            Self::Answer(answer) => answer.ending(),
            Self::Failed { .. } => Ending::SomethingWrong,
        }
    }

    fn print(&self, name: &str, lengths: &[f64]) {
        match self {
            Self::Answer(answer) => answer.print(name, lengths),
            Self::Failed { error } => print_sentence(&format!("{name} has no answer: {}", error.message)),
        }
    }
}

impl From<Result<Answer, StaticsError>> for Entry {
    fn from(answer: Result<Answer, StaticsError>) -> Self {
        match answer {
            Ok(answer) => Self::Answer(Box::new(answer)),
            Err(error) => Self::Failed { error: error.into() },
        }
    }
}

impl From<Result<Certificate, StaticsError>> for Proof {
    fn from(certificate: Result<Certificate, StaticsError>) -> Self {
        match certificate {
            Ok(proof) => Self::Given {
                position: proof.position,
                rotation: proof.rotation,
                force: proof.force,
                least_stiffness: proof.least_stiffness,
                stable: proof.is_stable(),
            },
            Err(error) => Self::None { error: error.into() },
        }
    }
}
