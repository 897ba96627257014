//! The robot, its load and the choice of its tensions.

use crate::program::arguments::{components, mass};
use crate::program::error::ProgramError;
use crate::program::questions;
use crate::program::said::{self, about};
use cdpr_robot::{Coordinate, Pose, Robot, TensionDistribution, TensionReference, Wrench, plausible};
use cdpr_statics::Load;
use cdpr_study::{Output, Study, open_robot_in_any_unit};
use std::path::{Path, PathBuf};

/// The robot, always the first argument.
#[derive(clap::Args)]
pub(crate) struct RobotArgument {
    /// Robot: a file (JSON, `cdpr-robot/1`), a name of `cdpr robot list`, or - for the standard input.
    robot: PathBuf,
}

impl RobotArgument {
    /// The file or name.
    pub(crate) fn path(&self) -> &Path {
        &self.robot
    }
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

impl FreeArguments {
    /// The pose that is found, if any coordinate is free.
    pub(crate) fn found(&self, pose: &Pose) -> Option<Pose> {
        (!self.free.is_empty()).then_some(*pose)
    }
}

/// The components of a force [N].
fn force(text: &str) -> Result<[f64; 3], String> {
    components(text).map_err(|error| match text.contains("kg") {
        true => format!("{error}; a force is in N, and a mass in kg is `--payload`"),
        false => error,
    })
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
    /// Instead of those in the file; without either the tensions have the least norm.
    #[arg(long, value_name = "TENSIONS", allow_hyphen_values = true)]
    pub(crate) tension_reference: Option<TensionReference>,
    /// Which tensions the inverse model chooses, instead of that in the file: nearest to the
    /// reference, or of least_1_norm, least_2_norm or least_infinity_norm.
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
        let robot = open_robot_in_any_unit(path)?;
        about(&robot.name);
        self.given_to(robot)
    }

    fn given_to(&self, mut robot: Robot) -> Result<Robot, ProgramError> {
        let is_chosen = self.distribution.is_some() || self.tension_reference.is_some();
        if is_chosen && robot.cables.len() == robot.freedoms().count() {
            said::note(format_args!(
                "{} cables and as many free motions: the balance alone gives the tensions, none is chosen",
                robot.cables.len()
            ));
        }
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
        if study.file.output == Output::Position && study.file.load() != Load::none() {
            said::note(format_args!(
                "a position is that without load: the load of the study has no effect on it"
            ));
        }
        Ok(study)
    }
}
