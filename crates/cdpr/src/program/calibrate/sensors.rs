//! The sensors of a campaign: their noise, their errors, markers.

use crate::program::arguments::{self, Named};
use crate::program::error::ProgramError;
use crate::program::questions;
use cdpr_calibration::SensorError;
use cdpr_robot::{Robot, Vector3};

/// The noise of what is measured.
#[derive(clap::Args)]
pub(crate) struct NoiseArgument {
    /// Standard deviations of what is measured, SI units: position=1e-4,rotation=1e-4,length=1e-4,tension=5.
    ///
    /// Also displacement, marker and swivel; in a fit covariances of two columns, cov_x_m_y_m=5e-9, too.
    /// Lengths without noise are exact.
    #[arg(long, value_parser = arguments::named)]
    noise: Option<Named>,
}

impl NoiseArgument {
    /// The standard deviations by their names, once they are compared with the robot.
    pub(super) fn named(&self, robot: &Robot) -> &[(String, f64)] {
        let named = self.noise.as_ref().map_or(&[][..], |Named(named)| named);
        questions::about_noise(robot, named);
        named
    }
}

/// Errors of sensors, and the markers.
#[derive(clap::Args)]
pub(crate) struct SensorArguments {
    /// Errors of sensors, with their standard deviations: length_offset=0.01,drum_scale=0.01,tension_bias=20,
    /// tension_gain,swivel_offset,angle_offset,markers,frame,frame_scale.
    ///
    /// A fit seeks them, without a prior where no standard deviation is given; a simulation draws them.
    #[arg(long, value_name = "ERRORS", value_delimiter = ',')]
    unknown: Vec<String>,
    /// Place of a marker on the platform: x,y,z [m], once for each in their order.
    #[arg(long = "marker", value_parser = arguments::components::<3>, allow_hyphen_values = true)]
    markers: Vec<[f64; 3]>,
}

impl SensorArguments {
    /// The markers [m], once they are compared with the robot.
    pub(super) fn markers(&self, robot: &Robot) -> Vec<Vector3<f64>> {
        let markers: Vec<_> = self.markers.iter().map(|marker| Vector3::from(*marker)).collect();
        questions::about_markers(robot, markers.iter().copied());
        markers
    }

    /// The errors with their standard deviations, where these are given.
    pub(super) fn errors(&self) -> Result<Vec<(SensorError, Option<f64>)>, ProgramError> {
        let of = |text: &String| {
            let (name, std) = match text.split_once('=') {
                Some((name, std)) => (name, Some(arguments::payload(std).map_err(ProgramError::Usage)?)),
                None => (text.as_str(), None),
            };
            let error = SensorError::from_name(name.trim());
            Ok((error.map_err(|error| ProgramError::Usage(format!("--unknown: {error}")))?, std))
        };
        self.unknown.iter().map(of).collect()
    }
}
