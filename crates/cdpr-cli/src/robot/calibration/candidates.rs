//! Where a robot may be measured, what is measured there, and what is uncertain.

use crate::arguments::{self, Named};
use crate::error::ProgramError;
use crate::lists;
use crate::output::progress;
use crate::questions;
use crate::robot::calibrate::Sought;
use cdpr_calibration::{Calibration, Measurement};
use cdpr_robot::{Parameter, Pose, Robot};
use cdpr_statics::Load;
use cdpr_study::Grid;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Where a robot may be measured.
#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("where").required(true).args(["poses", "grid"]))]
pub(crate) struct Candidates {
    /// File of candidate poses (CSV): x_m,y_m,z_m, then qw,qx,qy,qz or roll_deg,pitch_deg,yaw_deg or nothing.
    #[arg(long)]
    poses: Option<PathBuf>,
    /// Grid of candidate positions, min:max:points of each axis: -2:2:5,-1:1:3,0.5:2.5:3.
    #[arg(long, value_parser = arguments::grid, allow_hyphen_values = true)]
    grid: Option<Grid>,
}

impl Candidates {
    pub(super) fn read(&self, robot: &Robot) -> Result<Vec<Pose>, ProgramError> {
        let poses = match (&self.grid, &self.poses) {
            (Some(grid), _) => grid.poses(),
            (None, Some(path)) => lists::pose_file(path)?,
            (None, None) => return Err(ProgramError::Usage("expected --poses or --grid".to_owned())),
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
    /// Standard deviations of the uncertain parameters or groups of them, SI units: a=0.001,b=0.001,mass=0.5.
    ///
    /// All other parameters are known. --model has them in a file.
    #[arg(long, value_parser = arguments::named, conflicts_with = "model", required_unless_present = "model")]
    uncertainty: Option<Named>,
    #[command(flatten)]
    sought: Sought,
    /// What is measured, with its noise, such as position=1e-4,rotation=1e-4.
    ///
    /// Position [m] and rotation [rad] go together; others are tensions [N] and lengths [m].
    #[arg(long, value_parser = arguments::named)]
    noise: Named,
}

impl Known {
    /// The standard deviation of each parameter; correlations of an error model do not count.
    pub(super) fn deviations(&self, robot: &Robot) -> Result<Vec<f64>, ProgramError> {
        match (&self.uncertainty, self.sought.prior(robot)?) {
            (Some(named), _) => arguments::uncertainties(robot, named),
            (None, Some(model)) => {
                let mut variances = vec![0.0; Parameter::of(robot).len()];
                for term in &model.terms {
                    variances[term.parameter] += (term.factor * model.inputs[term.input].law.std()).powi(2);
                }
                Ok(variances.iter().map(|variance: &f64| variance.sqrt()).collect())
            }
            (None, None) => Err(ProgramError::Usage("expected --model or --uncertainty".to_owned())),
        }
    }

    /// What is measured.
    pub(super) fn measurements(&self, robot: &Robot) -> Result<Vec<Measurement>, ProgramError> {
        let Named(named) = &self.noise;
        questions::about_noise(robot, named);
        Measurement::named(named).map_err(|error| ProgramError::Usage(format!("--{error}")))
    }
}
