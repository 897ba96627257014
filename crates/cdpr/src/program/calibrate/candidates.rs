//! Where a robot may be measured, what is measured there, and what is uncertain.

use crate::program::arguments::{Region, UncertaintyArgument, region};
use crate::program::calibrate::sensors::NoiseArgument;
use crate::program::error::ProgramError;
use crate::program::lists;
use crate::program::output::{Ending, progress};
use crate::program::questions;
use cdpr_calibration::{Calibration, Measurement};
use cdpr_robot::{Coordinate, Pose, Robot};
use cdpr_statics::Load;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Where a robot may be measured.
#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("where").required(true).args(["poses", "region"]))]
pub(crate) struct Candidates {
    /// Table of candidate poses: x_m,y_m,z_m, then qw,qx,qy,qz or roll_deg,pitch_deg,yaw_deg or nothing; -
    /// for the standard input.
    #[arg(long, value_name = "FILE")]
    poses: Option<PathBuf>,
    /// Candidate positions: x, y and z, each of them a coordinate, min:max or min:max:points [m], such as
    /// -2:2:5,-1:1:3,1:2.5:3.
    #[arg(long, value_parser = region, allow_hyphen_values = true)]
    region: Option<Region>,
}

impl Candidates {
    pub(super) fn read(&self, robot: &Robot) -> Result<Vec<Pose>, ProgramError> {
        let poses = match (&self.region, &self.poses) {
            (Some(region), _) => region.grid(robot)?.poses(),
            (None, Some(path)) => lists::pose_file(path, robot)?.poses,
            (None, None) => return Err(ProgramError::Usage("expected --poses or --region".to_owned())),
        };
        questions::about_poses(robot, "the candidates", &poses);
        Ok(poses)
    }
}

/// Adds the candidates that the robot holds; the others are counted by the reason.
pub(super) fn add(
    calibration: &mut Calibration,
    candidates: Vec<Pose>,
    load: &Load,
    measurements: &[Measurement],
) -> Result<(Vec<Pose>, BTreeMap<&'static str, usize>), ProgramError> {
    let (mut poses, mut refused) = (Vec::new(), BTreeMap::new());
    let bar = progress(candidates.len(), "poses");
    for pose in candidates {
        bar.inc(1);
        match calibration.add(&pose, load, measurements) {
            Ok(()) => poses.push(pose),
            // Noise, payload and free coordinates are the same at all poses: they are no property of a pose.
            Err(error) if ["invalid_input", "free_coordinates"].contains(&error.kind()) => {
                return Err(error.into());
            }
            Err(error) => *refused.entry(error.kind()).or_insert(0) += 1,
        }
    }
    bar.finish_and_clear();
    if poses.is_empty() {
        let reasons: Vec<_> = refused.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        return Err(ProgramError::NoPoseHeld { reasons: reasons.join(", ") });
    }
    Ok((poses, refused))
}

/// What is uncertain, and what is measured with which noise.
#[derive(clap::Args)]
pub(crate) struct Known {
    #[command(flatten)]
    uncertainty: UncertaintyArgument,
    #[command(flatten)]
    noise: NoiseArgument,
}

impl Known {
    /// A calibration without poses of a robot whose parameters are uncertain as stated, correlations
    /// included.
    pub(super) fn calibration(
        &self,
        robot: &Robot,
        free: &[Coordinate],
    ) -> Result<Calibration, ProgramError> {
        Ok(Calibration::of_model(robot, &self.uncertainty.needed(robot)?)?.with_free(free))
    }

    /// What is measured.
    pub(super) fn measurements(&self, robot: &Robot) -> Result<Vec<Measurement>, ProgramError> {
        let named = self.noise.named(robot);
        if named.is_empty() {
            let missing = "expected --noise: what is measured, such as position=1e-4,rotation=1e-4";
            return Err(ProgramError::Usage(missing.to_owned()));
        }
        Measurement::named(robot, named).map_err(|error| ProgramError::Usage(format!("--{error}")))
    }
}

/// The end of a command of which this many candidates of all are held.
pub(super) fn ending(held: usize, all: usize) -> Ending {
    if 2 * held < all {
        eprintln!("warning: fewer than half of the candidate poses are held, {held} of {all}");
        return Ending::SomethingWrong;
    }
    Ending::Well
}
