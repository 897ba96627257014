//! Arguments that several commands share, and parsers of those that are more than a number or a path.
//!
//! A parser says what is wrong with the text; clap adds the argument and the value.

use crate::error::ProgramError;
use cdpr_robot::{Pose, Robot, Rotation3, UnitQuaternion, Vector3, Wrench, shown};
use cdpr_statics::Load;
use cdpr_study::{Grid, GridAxis, InputKind, StudyError, open_robot, read_text};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// How the results are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Format {
    /// Tables.
    Text,
    /// JSON, numbers to the last bit.
    Json,
}

impl Format {
    /// Prints an answer as one line of JSON, or as `text` does.
    pub(crate) fn print<T: Serialize>(self, answer: &T, text: impl FnOnce(&T)) -> serde_json::Result<()> {
        match self {
            Self::Json => println!("{}", serde_json::to_string(answer)?),
            Self::Text => text(answer),
        }
        Ok(())
    }
}

/// How many threads compute.
#[derive(clap::Args)]
pub(crate) struct Threads {
    /// Threads; all cores if left out. The numbers do not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) threads: Option<u16>,
}

impl Threads {
    /// Starts the threads that were asked for; all cores by default.
    pub(crate) fn start(&self) -> Result<(), ProgramError> {
        let Some(threads) = self.threads else { return Ok(()) };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
        pool.map_err(|source| ProgramError::Threads { threads, source })
    }
}

/// A robot at a pose with a load, and how the answer is printed.
#[derive(clap::Args)]
pub(crate) struct RobotAtPose {
    /// Robot file (JSON, `cdpr-robot/1`).
    robot: PathBuf,
    /// Pose that the lengths hold: x,y,z [m], or x,y,z,qw,qx,qy,qz with a quaternion.
    #[arg(long, value_parser = pose, allow_hyphen_values = true)]
    pub(crate) pose: Pose,
    /// How the results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    pub(crate) load: LoadArguments,
}

impl RobotAtPose {
    /// The robot.
    pub(crate) fn open(&self) -> Result<Robot, StudyError> {
        open_robot(&self.robot)
    }

    /// Prints an answer as one line of JSON, or as `text` does below a heading: the robot and the position.
    pub(crate) fn print<T: Serialize>(
        &self,
        robot: &Robot,
        answer: &T,
        text: impl FnOnce(&T, &str),
    ) -> Result<(), ProgramError> {
        let [x, y, z] = self.pose.position.into();
        let heading = format!("{} at ({x}, {y}, {z}) m", shown(&robot.name));
        Ok(self.format.print(answer, |answer| text(answer, &heading))?)
    }
}

/// A finite number.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| format!("`{}` is not a finite number", text.trim()))
}

/// Finite numbers separated by commas.
pub(crate) fn numbers(text: &str) -> Result<Vec<f64>, String> {
    text.split(',').map(number).collect()
}

/// Finite numbers of one argument.
#[derive(Clone)]
pub(crate) struct List(pub(crate) Vec<f64>);

/// Finite numbers separated by commas.
pub(crate) fn list(text: &str) -> Result<List, String> {
    numbers(text).map(List)
}

/// N finite numbers separated by commas.
pub(crate) fn components<const N: usize>(text: &str) -> Result<[f64; N], String> {
    numbers(text)?
        .try_into()
        .map_err(|given: Vec<f64>| format!("{} numbers: expected {N}, separated by commas", given.len()))
}

/// A mass, zero or more [kg].
pub(crate) fn mass(text: &str) -> Result<f64, String> {
    let mass = number(text)?;
    if mass >= 0.0 { Ok(mass) } else { Err("expected a mass, zero or more [kg]".to_owned()) }
}

/// A mass above zero, whose effect is observed [kg].
pub(crate) fn payload(text: &str) -> Result<f64, String> {
    let mass = number(text)?;
    if mass > 0.0 { Ok(mass) } else { Err("expected a mass above zero [kg]".to_owned()) }
}

/// `x,y,z` [m], followed by the quaternion `qw,qx,qy,qz` where the platform is rotated.
pub(crate) fn pose(text: &str) -> Result<Pose, String> {
    let numbers = numbers(text).map_err(|error| format!("{error}: {POSE}"))?;
    pose_of(&numbers)
}

const POSE: &str = "expected x,y,z [m] or x,y,z,qw,qx,qy,qz";

/// `qw,qx,qy,qz`.
pub(crate) fn rotation(text: &str) -> Result<Rotation3<f64>, String> {
    let pose = Pose::with_quaternion(Vector3::zeros(), components(text)?);
    pose.map(|pose| pose.rotation).ok_or_else(|| NO_ROTATION.to_owned())
}

const NO_ROTATION: &str = "the quaternion is zero: expected one that can be normalised";

/// The pose of three or seven finite numbers.
pub(crate) fn pose_of(numbers: &[f64]) -> Result<Pose, String> {
    match *numbers {
        [x, y, z] => Ok(Pose::at(x, y, z)),
        [x, y, z, qw, qx, qy, qz] => Pose::with_quaternion(Vector3::new(x, y, z), [qw, qx, qy, qz])
            .ok_or_else(|| NO_ROTATION.to_owned()),
        _ => Err(format!("{} numbers: {POSE}", numbers.len())),
    }
}

/// The load: what acts on the platform besides its own weight.
#[derive(clap::Args)]
pub(crate) struct LoadArguments {
    /// Force, in the base frame: fx,fy,fz [N].
    #[arg(long, value_parser = components::<3>, default_value = "0,0,0", allow_hyphen_values = true)]
    force: [f64; 3],
    /// Moment about P, of constant components in the base frame: mx,my,mz [N m].
    #[arg(long, value_parser = components::<3>, default_value = "0,0,0", allow_hyphen_values = true)]
    moment: [f64; 3],
    /// Mass added at the platform's centre of mass [kg].
    #[arg(long, value_parser = mass, default_value = "0", allow_hyphen_values = true)]
    payload: f64,
}

impl LoadArguments {
    /// The load as the models take it.
    pub(crate) fn load(&self) -> Load {
        let wrench = Wrench { force: self.force.into(), moment: self.moment.into() };
        Load { payload: self.payload, wrench }
    }

    /// The load, which must displace the platform.
    pub(crate) fn some_load(&self) -> Result<Load, ProgramError> {
        match self.load() {
            load if load == Load::none() => Err(ProgramError::Usage(
                "nothing displaces the platform: expected --payload, --force or --moment".to_owned(),
            )),
            load => Ok(load),
        }
    }
}

/// Position and quaternion (w, x, y, z), as [`pose`] reads them.
pub(crate) fn pose_numbers(pose: &Pose) -> [f64; 7] {
    let [x, y, z] = pose.position.into();
    let q = UnitQuaternion::from_rotation_matrix(&pose.rotation);
    [x, y, z, q.w, q.i, q.j, q.k]
}

/// Poses from a file, one a line.
pub(crate) fn pose_file(path: &Path) -> Result<Vec<Pose>, ProgramError> {
    let lines = read_text(path, InputKind::Poses)?;
    let lines = lines.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let at_line = |line| move |reason| ProgramError::Poses { path: path.to_owned(), line, reason };
    lines.map(|(i, line)| pose(line).map_err(at_line(i + 1))).collect()
}

/// Positions on a grid: `min:max:points` of each axis [m], separated by commas.
pub(crate) fn grid(text: &str) -> Result<Grid, String> {
    let expected = "expected min:max:points of x, y and z, such as -2:2:5,-1:1:3,0.5:2.5:3";
    let axis = |text: &str| {
        let [min, max, points] = text.split(':').collect::<Vec<_>>()[..] else { return None };
        let points = points.trim().parse().ok().filter(|points| *points > 0)?;
        Some(GridAxis { min: number(min).ok()?, max: number(max).ok()?, points })
    };
    let axes: Option<Vec<_>> = text.split(',').map(axis).collect();
    let axes = axes.and_then(|axes| <[GridAxis; 3]>::try_from(axes).ok());
    Grid::new(axes.ok_or_else(|| expected.to_owned())?).map_err(|error| error.to_string())
}

/// Numbers by their names.
#[derive(Clone)]
pub(crate) struct Named(pub(crate) Vec<(String, f64)>);

/// `name=number`, separated by commas.
pub(crate) fn named(text: &str) -> Result<Named, String> {
    let one = |text: &str| -> Result<(String, f64), String> {
        let (name, value) = text.split_once('=').ok_or_else(|| format!("`{text}`: expected name=number"))?;
        Ok((name.trim().to_owned(), number(value)?))
    };
    let named: Vec<(String, f64)> = text.split(',').map(one).collect::<Result<_, _>>()?;
    let again =
        |(i, (name, _)): &(usize, &(String, f64))| named[..*i].iter().any(|(before, _)| before == name);
    match named.iter().enumerate().find(again) {
        Some((_, (name, _))) => Err(format!("`{name}` is given twice: expected each name once")),
        None => Ok(Named(named)),
    }
}

/// The standard deviation of each parameter of `--uncertainty`.
pub(crate) fn uncertainties(robot: &Robot, Named(named): &Named) -> Result<Vec<f64>, ProgramError> {
    cdpr_study::uncertainties(robot, named).map_err(|error| ProgramError::Usage(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pose_is_three_numbers_or_seven() {
        assert_eq!(pose("1,-2.5, 3e-1"), Ok(Pose::at(1.0, -2.5, 0.3)));
        let turned = pose("0,0,1,0,0,0,2").unwrap();
        assert!((turned.rotation * Vector3::x() + Vector3::x()).norm() < 1e-15);
        for (text, words) in [
            ("", "`` is not a finite number: expected x,y,z"),
            ("1,2", "2 numbers: expected x,y,z"),
            ("1,2,3,1", "4 numbers"),
            ("1,2,nan", "`nan` is not a finite number"),
            ("1,2,up", "`up` is not"),
            ("1,2,3,0,0,0,0", "the quaternion is zero"),
        ] {
            let error = pose(text).unwrap_err();
            assert!(error.starts_with(words), "{error}");
        }
    }

    #[test]
    fn a_grid_has_its_ends_and_a_list_its_names() {
        let poses = grid("-1:1:3,0:0:1,2:3:2").unwrap().poses();
        assert_eq!(poses.len(), 6);
        assert_eq!((poses[0], poses[5]), (Pose::at(-1.0, 0.0, 2.0), Pose::at(1.0, 0.0, 3.0)));
        for text in ["", "0:1:2", "0:1:0,0:1:1,0:1:1", "0:1:2,0:1:2,0:x:2", "0:1:2,0:1:2,0:1:2,0:1:2"] {
            assert!(grid(text).is_err_and(|error| error.starts_with("expected min:max:points")), "{text}");
        }
        let Named(named) = named("a=0.1, mass=2").unwrap();
        assert_eq!(named, [("a".to_owned(), 0.1), ("mass".to_owned(), 2.0)]);
        assert!(
            super::named("a").is_err() && super::named("a=b").is_err() && super::named("a=1,a=1").is_err()
        );
    }

    #[test]
    fn a_pose_is_read_as_it_is_written() {
        let turned = pose("1,2,3,0.5,0.5,-0.5,0.5").unwrap();
        assert!(
            (0..7)
                .all(|i| (pose_numbers(&turned)[i] - [1.0, 2.0, 3.0, 0.5, 0.5, -0.5, 0.5][i]).abs() < 1e-15)
        );
    }
}
