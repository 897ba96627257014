//! Arguments that several commands share, and parsers of those that are more than a number or a path.
//!
//! A parser says what is wrong with the text; clap adds the argument and the value.

use crate::error::ProgramError;
use crate::questions;
use cdpr_assess::PoseRegion;
use cdpr_robot::{
    Coordinate, Parameter, Robot, TensionDistribution, TensionReference, Wrench, counted, plausible, shown,
};
use cdpr_statics::Load;
use cdpr_study::{
    ErrorModel, Grid, GridAxis, IfExists, Study, Unit, check_replaceable, open_robot_in_any_unit, write_text,
};
use serde::Serialize;
use std::borrow::Cow;
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
            Self::Json => println!("{}", questions::added_to(serde_json::to_string(answer)?)?),
            Self::Text => text(answer),
        }
        Ok(())
    }
}

/// What becomes of files and results that are there already.
#[derive(clap::Args)]
pub(crate) struct Overwrite {
    /// Replace the file, or the results in the folder, that are there already.
    #[arg(long)]
    overwrite: bool,
}

impl Overwrite {
    /// What becomes of them.
    pub(crate) fn if_exists(&self) -> IfExists {
        IfExists::overwriting(self.overwrite)
    }

    /// Writes a text to a file of the user's choice.
    pub(crate) fn write(&self, path: &Path, text: &str) -> Result<(), ProgramError> {
        self.write_all(&[(path, text)])
    }

    /// Writes texts to files of the user's choice: all of them, or none where one must not be replaced.
    pub(crate) fn write_all(&self, files: &[(&Path, &str)]) -> Result<(), ProgramError> {
        files.iter().try_for_each(|(path, text)| check_replaceable(path, text, self.if_exists()))?;
        Ok(files.iter().try_for_each(|(path, text)| write_text(path, text, self.if_exists()))?)
    }
}

/// How many threads compute.
#[derive(clap::Args)]
pub(crate) struct Threads {
    /// Threads; all cores if left out. The numbers do not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=MOST_THREADS))]
    pub(crate) threads: Option<u16>,
}

/// Greatest number of threads.
const MOST_THREADS: i64 = 1024;

/// Variable of the environment with the number of threads where `--threads` is left out.
pub(crate) const THREAD_VARIABLE: &str = "RAYON_NUM_THREADS";

/// Checks the number of threads of the environment. Without a number, all cores compute.
pub(crate) fn check_thread_variable(value: Option<&str>) -> Result<(), ProgramError> {
    match value.map(|text| (text, text.trim().parse::<f64>())) {
        Some((text, Ok(threads))) if !(0.0..=MOST_THREADS as f64).contains(&threads) => {
            let expected = format!(
                "{THREAD_VARIABLE} is {text}: expected 1 to {MOST_THREADS} threads, or 0 for all cores"
            );
            Err(ProgramError::Usage(expected))
        }
        _ => Ok(()),
    }
}

impl Threads {
    /// Starts the threads that were asked for; all cores by default.
    pub(crate) fn start(&self) -> Result<(), ProgramError> {
        let Some(threads) = self.threads else { return Ok(()) };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
        pool.map_err(|source| ProgramError::Threads { threads, source })
    }
}

/// A name for results of a robot in the current folder: that of its file, and what they are of.
pub(crate) fn named_after(robot: &Path, of: &str) -> PathBuf {
    let stem = robot.file_stem().map_or_else(|| "robot".into(), |stem| stem.to_string_lossy());
    PathBuf::from(format!("{stem}-{of}"))
}

/// A count between two bounds, both of them allowed.
pub(crate) fn count<const LEAST: usize, const MOST: usize>(text: &str) -> Result<usize, String> {
    let count = text.trim().parse().ok().filter(|count| (LEAST..=MOST).contains(count));
    // Zeros beyond nine digits are not counted by eye.
    let most = if MOST < 10_000_000_000 { MOST.to_string() } else { format!("{MOST:e}") };
    count.ok_or_else(|| format!("expected a count, {LEAST} to {most}"))
}

/// A seed of random numbers.
pub(crate) fn seed(text: &str) -> Result<u64, String> {
    text.trim().parse().map_err(|_| "expected a seed, a whole number, 0 to 1.8e19".to_owned())
}

/// A finite number.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let finite = |text: &str| text.parse().ok().filter(|number: &f64| number.is_finite());
    let hint = || match finite(&text.replacen(',', ".", 1)) {
        Some(meant) => format!(": expected a decimal point, {meant}"),
        None => {
            let end = text.trim_end_matches(|c: char| c.is_alphabetic() || c == ' ').len();
            let (value, unit) = text.split_at(end);
            match (finite(value), Unit::of(unit)) {
                (Some(meant), Some(Unit { factor: 1.0, .. })) => {
                    format!(": expected {meant}, without a unit")
                }
                (Some(_), _) => ": expected a number alone, in the unit that `--help` states".to_owned(),
                (None, _) => String::new(),
            }
        }
    };
    finite(text).ok_or_else(|| format!("`{text}` is not a finite number{}", hint()))
}

/// The parts of a list: between semicolons, commas or blanks. Behind semicolons and blanks commas are decimal.
pub(crate) fn parts(text: &str) -> Vec<Cow<'_, str>> {
    let is_apart = |part: &str| !part.starts_with(',') && !part.ends_with(',');
    let decimal = |part: &str| match part.matches(',').count() {
        1 => part.replace(',', ".").into(),
        _ => part.to_owned().into(),
    };
    let mut words = text.split_whitespace();
    if text.contains(';') {
        text.split(';').map(decimal).collect()
    } else if text.split_whitespace().count() > 1 && words.all(is_apart) {
        text.split_whitespace().map(decimal).collect()
    } else {
        text.split(',').map(Cow::from).collect()
    }
}

/// Finite numbers separated by commas, semicolons or blanks.
pub(crate) fn numbers(text: &str) -> Result<Vec<f64>, String> {
    parts(text).iter().map(|part| number(part)).collect()
}

/// Finite numbers of one argument.
#[derive(Clone)]
pub(crate) struct List(pub(crate) Vec<f64>);

/// Finite numbers, as [`numbers`].
pub(crate) fn list(text: &str) -> Result<List, String> {
    numbers(text).map(List)
}

/// N finite numbers separated by commas.
pub(crate) fn components<const N: usize>(text: &str) -> Result<[f64; N], String> {
    numbers(text)?
        .try_into()
        .map_err(|given: Vec<f64>| format!("{}: expected {N}", counted(given.len(), "number")))
}

/// The components of a force [N].
fn force(text: &str) -> Result<[f64; 3], String> {
    components(text).map_err(|error| match text.contains("kg") {
        true => format!("{error}; a force is in N, and a mass in kg is `--payload`"),
        false => error,
    })
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

/// The coordinates of a pose that are found.
#[derive(clap::Args)]
pub(crate) struct FreeArguments {
    /// Coordinates of the pose that are found, for a robot with fewer cables than free motions: as many of x,
    /// y, z, roll, pitch, yaw as cables are missing.
    ///
    /// They start from the pose and end where the platform rests. R = Rz(yaw) Ry(pitch) Rx(roll).
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(crate) free: Vec<Coordinate>,
}

/// The load: what acts on the platform besides its own weight.
#[derive(clap::Args)]
pub(crate) struct LoadArguments {
    /// Force, in the base frame: fx,fy,fz [N].
    #[arg(long, value_parser = force, default_value = "0,0,0", allow_hyphen_values = true)]
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

/// The tensions that the inverse model prefers.
#[derive(clap::Args)]
pub(crate) struct Preference {
    /// Tensions that those of the inverse model come as near to as they can: one for all cables or t1,..,tn
    /// [N], or `mid`, the middle of the limits.
    ///
    /// In place of those in the file; without either the tensions have the least norm.
    #[arg(long, value_name = "TENSIONS", allow_hyphen_values = true)]
    pub(crate) tension_reference: Option<TensionReference>,
    /// Which tensions the inverse model chooses, in place of the choice in the file: nearest to the reference, or of
    /// least_1_norm, least_2_norm or least_infinity_norm.
    #[arg(long, value_name = "NAME")]
    pub(crate) distribution: Option<TensionDistribution>,
}

impl Preference {
    /// The robot of a file, with this preference if there is one.
    pub(crate) fn open_robot(&self, path: &Path) -> Result<Robot, ProgramError> {
        self.given_to(questions::open_robot(path)?)
    }

    /// As [`Preference::open_robot`], for a robot whose values may be in another unit.
    pub(crate) fn open_robot_in_any_unit(&self, path: &Path) -> Result<Robot, ProgramError> {
        self.given_to(open_robot_in_any_unit(path)?)
    }

    fn given_to(&self, mut robot: Robot) -> Result<Robot, ProgramError> {
        robot.choose(self.distribution, self.tension_reference.clone());
        if self.tension_reference.is_some() {
            robot.validate().map_err(|error| ProgramError::Usage(format!("--tension-reference: {error}")))?;
            questions::ask(plausible::reference(&robot));
        }
        Ok(robot)
    }

    /// The study of a file, with this preference if there is one.
    pub(crate) fn open_study(&self, path: &Path) -> Result<Study, ProgramError> {
        let mut study = questions::open_study(path)?;
        if self.distribution.is_some() || self.tension_reference.is_some() {
            self.given_to(study.robot.clone())?;
            study.choose_tensions(self.distribution, self.tension_reference.clone())?;
        }
        Ok(study)
    }
}

/// Positions on a grid: `min:max:points` of each axis [m], separated by commas.
pub(crate) fn grid(text: &str) -> Result<Grid, String> {
    let expected = "expected min:max:points of x, y and z, such as -2:2:5,-1:1:3,0.5:2.5:3";
    let axis = |text: &str| {
        let [min, max, points] = text.split(':').collect::<Vec<_>>()[..] else { return None };
        let points = points.trim().parse().ok().filter(|points| *points > 0)?;
        Some(GridAxis { min: number(min).ok()?, max: number(max).ok()?, points })
    };
    let axes: Option<Vec<_>> = parts(text).iter().map(|text| axis(text)).collect();
    let axes = axes.and_then(|axes| <[GridAxis; 3]>::try_from(axes).ok());
    Grid::new(axes.ok_or_else(|| expected.to_owned())?).map_err(|error| error.to_string())
}

/// A box: `min:max` of each axis [m], separated by commas; rotations in it go up to 30 degrees.
pub(crate) fn region(text: &str) -> Result<PoseRegion, String> {
    let axis = |text: &str| {
        let (min, max) = text.split_once(':')?;
        Some((number(min).ok()?, number(max).ok()?)).filter(|(min, max)| min <= max)
    };
    let axes: Option<Vec<_>> = parts(text).iter().map(|text| axis(text)).collect();
    let Some([x, y, z]) = axes.and_then(|axes| <[(f64, f64); 3]>::try_from(axes).ok()) else {
        return Err("expected min:max of x, y and z, such as -2:2,-1:1,0.5:2.5".to_owned());
    };
    Ok(PoseRegion { low: [x.0, y.0, z.0], high: [x.1, y.1, z.1], max_angle: std::f64::consts::FRAC_PI_6 })
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
    let named: Vec<(String, f64)> = parts(text).iter().map(|text| one(text)).collect::<Result<_, _>>()?;
    let again =
        |(i, (name, _)): &(usize, &(String, f64))| named[..*i].iter().any(|(before, _)| before == name);
    match named.iter().enumerate().find(again) {
        Some((_, (name, _))) => Err(format!("`{name}` is given twice: expected each name once")),
        None => Ok(Named(named)),
    }
}

/// The error model whose effects are wanted.
#[derive(clap::Args)]
pub(crate) struct ErrorModelArguments {
    /// Standard deviations of the uncertain parameters or groups of them, SI units: a=0.001,b=0.001,mass=0.5.
    #[arg(long, value_parser = named)]
    uncertainty: Option<Named>,
    /// Study file whose error model gives the standard deviations.
    #[arg(long, conflicts_with = "uncertainty", requires = "error_model")]
    study: Option<PathBuf>,
    /// Name of the study's error model.
    #[arg(long, requires = "study")]
    error_model: Option<String>,
}

impl ErrorModelArguments {
    /// The error model of a robot, if one was given.
    pub(crate) fn model(&self, robot: &Robot) -> Result<Option<ErrorModel>, ProgramError> {
        if let (Some(path), Some(name)) = (&self.study, &self.error_model) {
            return study_errors(path, name, robot).map(Some);
        }
        let deviations = self.uncertainty.as_ref().map(|named| uncertainties(robot, named)).transpose()?;
        Ok(deviations.map(|deviations| ErrorModel::normal(robot, &deviations)))
    }
}

/// An error model of a study, for a robot that has the same parameters as the study's.
pub(crate) fn study_errors(path: &Path, name: &str, robot: &Robot) -> Result<ErrorModel, ProgramError> {
    let study = questions::open_study(path)?;
    if Parameter::of(&study.robot) != Parameter::of(robot) {
        return Err(ProgramError::Usage(format!(
            "--error-model {}: its study is of the robot {}, whose parameters are not those of {}: \
             expected a study of this robot",
            shown(name),
            shown(&study.robot.name),
            shown(&robot.name)
        )));
    }
    Ok(study.tolerances(name)?)
}

/// The standard deviation of each parameter of `--uncertainty`.
pub(crate) fn uncertainties(robot: &Robot, Named(named): &Named) -> Result<Vec<f64>, ProgramError> {
    let deviations =
        cdpr_study::uncertainties(robot, named).map_err(|error| ProgramError::Usage(error.to_string()))?;
    questions::about_model(robot, &ErrorModel::normal(robot, &deviations));
    Ok(deviations)
}

#[cfg(test)]
mod tests {
    use super::*;
    use cdpr_robot::Pose;

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
}
