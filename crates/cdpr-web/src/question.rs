//! What can be asked of a robot.

use cdpr_robot::{Coordinate, Pose, Vector3, Wrench};
use cdpr_statics::{Load, StaticsError};
use cdpr_study::StudyFile;
use serde::{Deserialize, Serialize};

/// A question, as JSON an object with one field.
#[derive(Debug, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Question {
    /// What the robot is, and where it stands first.
    Describe {
        /// A study of it with the first pose, payload and tolerances; those that are assumed, as by
        /// [`cdpr_study::template`], if left out.
        #[serde(default)]
        study: Option<Box<StudyFile>>,
    },
    /// The deflection at a pose: tensions distributed for it under the platform's own weight, then the load.
    Hold(Hold),
    /// Where the platform stands on given lengths.
    Stand(Stand),
    /// Where the platform goes while lengths and load change, and where it jumps.
    Wind(Follow),
    /// Natural modes, and motions from the softest to the stiffest.
    Modes(Motions),
    /// The study to observe; its sampling is named `all`.
    Study {
        /// A study file (`cdpr-study/1`). The robot that it names is not read.
        text: Box<StudyFile>,
    },
    /// Observations of one design of the study.
    Observe(ObserveReplicate),
    /// The observations of the study's own design with their inputs.
    Table {},
    /// Signed effects from the opaque `effects` of the replicates 1, 2, .. of the study.
    Effects {
        /// Those of each replicate.
        of: Vec<cdpr_sensitivity::Effects>,
    },
    /// Rows of a plane through the workspace.
    Slice(Slice),
}

/// A pose: position of P [m], then the unit quaternion w, x, y, z of its rotation.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
#[serde(transparent)]
pub struct PoseGiven(pub [f64; 7]);

/// A load on the platform.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct LoadGiven {
    /// Mass added at the centre of mass [kg].
    pub payload: f64,
    /// Force in the base frame [N].
    pub force: [f64; 3],
    /// Moment in the base frame, about P [N m].
    pub moment: [f64; 3],
}

/// The fields of [`Question::Hold`].
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Hold {
    /// The wanted pose.
    pub pose: PoseGiven,
    /// The load.
    #[serde(default)]
    pub load: LoadGiven,
    /// Coordinates that are found, as many as cables are missing.
    #[serde(default)]
    pub free: Vec<Coordinate>,
}

/// The fields of [`Question::Stand`].
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Stand {
    /// Unstrained lengths [m].
    pub lengths: Vec<f64>,
    /// The load.
    #[serde(default)]
    pub load: LoadGiven,
    /// A pose from which the equilibrium is searched.
    pub start: PoseGiven,
}

/// The fields of [`Question::Wind`]: from the first setting to the second.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Follow {
    /// Unstrained lengths before and after [m].
    pub lengths: [Vec<f64>; 2],
    /// Loads before and after.
    #[serde(default)]
    pub load: [LoadGiven; 2],
    /// A pose near the first equilibrium.
    pub start: PoseGiven,
}

/// The fields of [`Question::Modes`].
pub type Motions = Stand;

/// The fields of [`Question::Observe`].
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ObserveReplicate {
    /// 0 for the sampling's own design, else the number of a scrambled replicate.
    pub replicate: usize,
}

/// The fields of [`Question::Slice`]: a plane across an axis of the base frame.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Slice {
    /// The axis across the plane.
    pub normal: SliceAxis,
    /// Where the plane is on it [m].
    pub at: f64,
    /// Rotation of the platform, w, x, y, z.
    pub quaternion: [f64; 4],
    /// Least and greatest coordinate [m], and number of positions, along the first axis of the plane.
    pub u: (f64, f64, usize),
    /// The same along the second axis.
    pub v: (f64, f64, usize),
    /// The rows wanted: indices along v, from the first to before the second.
    pub rows: [usize; 2],
    /// The load.
    #[serde(default)]
    pub load: LoadGiven,
    /// Coordinates that are found, as many as cables are missing.
    #[serde(default)]
    pub free: Vec<Coordinate>,
}

/// An axis of the base frame.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SliceAxis {
    /// The plane of y and z.
    X,
    /// The plane of x and z.
    Y,
    /// The plane of x and y.
    Z,
}

impl SliceAxis {
    /// Indices of the axis across the plane, and of the first and second one in it.
    pub(crate) fn axes(self) -> [usize; 3] {
        match self {
            Self::X => [0, 1, 2],
            Self::Y => [1, 0, 2],
            Self::Z => [2, 0, 1],
        }
    }
}

impl PoseGiven {
    /// # Errors
    /// [`StaticsError::Invalid`] for a position that is not finite or a quaternion without length.
    pub(crate) fn pose(self) -> Result<Pose, StaticsError> {
        let Self([x, y, z, quaternion @ ..]) = self;
        let pose = Pose::with_quaternion(Vector3::new(x, y, z), quaternion).filter(Pose::is_finite);
        pose.ok_or_else(|| StaticsError::Invalid {
            field: "pose".to_owned(),
            value: format!("{:?}", self.0),
            expected: "a finite position and a quaternion w, x, y, z that is not zero".to_owned(),
        })
    }
}

impl From<&Pose> for PoseGiven {
    fn from(pose: &Pose) -> Self {
        let ([x, y, z], [qw, qx, qy, qz]) = (pose.position.into(), pose.quaternion());
        Self([x, y, z, qw, qx, qy, qz])
    }
}

impl LoadGiven {
    pub(crate) fn load(self) -> Load {
        let Self { payload, force, moment } = self;
        Load { payload, wrench: Wrench { force: force.into(), moment: moment.into() } }
    }
}
