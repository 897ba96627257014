//! The study file, `cdpr-study/1`: JSON, in SI units unless a name says otherwise. [`json_schema`] describes
//! it.

use crate::file::cable_law::CableLaw;
use crate::file::grid::GridSpec;
use crate::file::output::{AmplitudeSpec, Output};
use crate::file::price::PriceSpec;
use crate::file::sensitivity_spec::SensitivitySpec;
use crate::file::weather::WeatherSpec;
use cdpr_robot::{Coordinate, TensionDistribution, TensionReference, Vector3, Wrench};
use cdpr_sensitivity::{Law, Steps};
use cdpr_statics::Load;
use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Name and version of the format.
pub const STUDY_FORMAT: &str = "cdpr-study/1";

/// A set of samplings and surfaces of one robot. SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "cdpr-study/1")]
pub struct StudyFile {
    /// Always "cdpr-study/1".
    pub format: String,
    /// Name of the study.
    pub name: String,
    /// Where its values come from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<String>,
    /// Robot file, relative to this file, or the name of a robot of the library.
    pub robot: String,
    /// Mass added at the platform's centre of mass, whose effect is the deflection [kg]; other outputs need
    /// none.
    #[serde(default)]
    pub payload: f64,
    /// Force on the platform in the base frame [N], which comes with the payload.
    #[serde(default, skip_serializing_if = "crate::file::is_default")]
    pub force: [f64; 3],
    /// Moment on the platform in the base frame, about P [N m], which comes with the payload.
    #[serde(default, skip_serializing_if = "crate::file::is_default")]
    pub moment: [f64; 3],
    /// The weather that comes after the load. The displacement of P is then that from the pose without load
    /// and weather, and the output a deflection or a position.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weather: Option<WeatherSpec>,
    /// What is observed of every robot: "deflection" unless another output is named.
    #[serde(default, skip_serializing_if = "crate::file::is_default")]
    pub output: Output,
    /// The force that shakes the platform; only where the output is "amplitude".
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub amplitude: Option<AmplitudeSpec>,
    /// Tensions that those of the inverse model come as near to as they can, instead of the robot's: one for
    /// all cables [N], a list with one for each cable, or "mid", the middle of the limits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tension_reference: Option<TensionReference>,
    /// Which tensions the inverse model chooses, instead of the robot's choice: "nearest" to the reference or
    /// of "least_2_norm". The other norms jump from observation to observation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub distribution: Option<TensionDistribution>,
    /// Seed of all random numbers (replicates, bootstrap): the same seed gives the same numbers.
    pub seed: u64,
    /// Number of scrambled replicates of each sampling, which give the intervals of signed effects; 0 or at
    /// least 2.
    pub replicates: usize,
    /// Confidence of those intervals, between 0 and 1.
    pub confidence: f64,
    /// Samples of the parametric bootstrap behind the p-value of each fitted law.
    pub bootstrap_resamples: usize,
    /// Error models by name: the deviation of each uncertain parameter. A key is a parameter (`mass`,
    /// `b3.z`), a group of parameters (`a`, `b`, `cog`, `dt`; of robots that have them `r`, `lead`, `tilt`,
    /// `gravity`), or the name of a cause that acts on several
    /// parameters. The entry of a parameter takes precedence over that of its group.
    ///
    /// A number of the weather is a key, too: `wind_speed`, `wind_from_deg`, `warmer`, `cable_expansion`,
    /// `frame_expansion`, `ice`, `creep`. Its deviation is added to the number in `weather`, which is zero
    /// where it is left out.
    ///
    /// A model `{"file": "posterior.json"}` is that of a file next to this one: `cdpr-errors/1`, or an object
    /// as it would stand here.
    #[schemars(with = "IndexMap<String, ErrorModelForm>")]
    pub error_models: IndexMap<String, IndexMap<String, InputSpec>>,
    /// Samplings by name: all uncertain parameters at once, at points of Sobol's sequence.
    #[serde(default)]
    pub samplings: IndexMap<String, SamplingSpec>,
    /// Measures of sensitivity, computed for every sampling and listed next to each other. Without this field
    /// none is computed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sensitivity: Option<SensitivitySpec>,
    /// Groups of inputs by name, such as a cable or all exits: their measures of sensitivity are listed
    /// next to those of single inputs. A group consists of inputs (`b1.x`, the name of a cause), of the
    /// inputs of a point (`b1`), or of those of a group of parameters (`b`). Groups may overlap.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub groups: IndexMap<String, Vec<String>>,
    /// Prices, from which `cdpr study tolerances` buys: of tolerances by the entries of the error models,
    /// and of calibrations by names of their own. A tolerance without a price stays as it is.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub prices: IndexMap<String, PriceSpec>,
    /// Surfaces by name: two parameters vary over a grid, and all others are nominal.
    #[serde(default)]
    pub surfaces: IndexMap<String, SurfaceSpec>,
}

impl StudyFile {
    /// The load whose effect is the deflection.
    pub fn load(&self) -> Load {
        let [force, moment] = [self.force, self.moment].map(Vector3::from);
        Load { payload: self.payload, wrench: Wrench { force, moment } }
    }
}

/// An error model as a file may have it: where it is read, files are put in their places.
#[derive(JsonSchema)]
#[serde(untagged)]
#[allow(dead_code)]
enum ErrorModelForm {
    /// That of another file.
    File(ErrorModelFile),
    /// Its entries.
    Entries(IndexMap<String, InputSpec>),
}

/// The error model of a file in the folder of the study.
#[derive(JsonSchema)]
#[serde(deny_unknown_fields)]
#[allow(dead_code)]
struct ErrorModelFile {
    /// Path of the file from here: `cdpr-errors/1`, or an object as a study has it in `error_models`.
    file: String,
}

/// Law and steps of a parameter's deviation from its nominal value, in the parameter's SI unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InputSpec {
    /// Law of the deviation.
    pub law: Law,
    /// Steps to which the deviation is rounded. Without this field it is continuous.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steps: Option<Steps>,
    /// Parameters to which this deviation is added, each times its factor, in addition to deviations of their
    /// own. It models a common cause: one pulley block moves two exit points by `{"b1.z": 1, "b2.z": 1}`. The
    /// key of the entry is then the name of the cause.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub parameters: Option<IndexMap<String, f64>>,
    /// Only for `youngs_modulus`: the law of the cables. The modulus follows from it between the tensions
    /// without and with the payload, and the deviation is counted from this modulus. A uniform deviation
    /// extends the range of the moduli of all cables, loaded and unloaded; other laws are refused.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub operating_point: Option<CableLaw>,
}

/// Wanted pose of the platform.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PoseSpec {
    /// Position of P in the base frame [m].
    pub position: [f64; 3],
    /// Unit quaternion (w, x, y, z). Without a rotation the platform is level.
    #[serde(default = "PoseSpec::level")]
    pub quaternion: [f64; 4],
    /// Rotation by the angles roll, pitch, yaw [degrees] instead of a quaternion: R = Rz(yaw) Ry(pitch)
    /// Rx(roll).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rpy_deg: Option<[f64; 3]>,
}

impl PoseSpec {
    /// The quaternion of a level platform.
    pub(crate) fn level() -> [f64; 4] {
        [1.0, 0.0, 0.0, 0.0]
    }
}

/// Wanted poses of the platform.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PosesSpec {
    /// One by one.
    List(Vec<PoseSpec>),
    /// Level poses over a plane or a box, x slowest and z fastest.
    Grid(GridSpec),
}

/// A sampling of all uncertain parameters, at one pose or at each of several.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SamplingSpec {
    /// Title for tables and figures.
    pub title: String,
    /// Wanted pose; leave it out where there are `poses`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pose: Option<PoseSpec>,
    /// Several wanted poses instead of one, each with all observations. They show the output over the
    /// workspace, without replicates and measures of sensitivity.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub poses: Option<PosesSpec>,
    /// Unstrained lengths [m] that every robot has, one for each cable, instead of its own for the pose. The
    /// platform of the nominal robot is then where these lengths hold it near the pose; robots have no
    /// set-points of tensions, and the output is a deflection or a position.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lengths: Option<Vec<f64>>,
    /// Coordinates of the pose that are found where the platform rests, for a robot with fewer cables than
    /// free motions: as many of x, y, z, roll, pitch, yaw as cables are missing.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub free: Vec<Coordinate>,
    /// Name of the error model.
    pub error_model: String,
    /// Number of observations at each pose.
    pub observations: usize,
    /// Index of the first observation in Sobol's sequence; if left out 0, and 1 where inputs are correlated
    /// or a law has no lower bound, which point 0 cannot draw.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub first_index: Option<u32>,
    /// Correlations between inputs (a Gaussian copula); all others are independent. What needs independent
    /// inputs is left out then: of the measures of sensitivity, regressions and Shapley effects remain.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub correlations: Vec<CorrelationSpec>,
}

/// Correlation of two inputs of a sampling. They keep their laws.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CorrelationSpec {
    /// Names of the two inputs: parameters or causes of the error model.
    pub between: [String; 2],
    /// Correlation C of their normal scores, above -1 and below 1. It is that of normal deviations; that of
    /// uniform ones is (6/π) asin(C / 2), which differs by at most 0.02.
    pub value: f64,
}

/// A surface of the output over two parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceSpec {
    /// Title for tables and figures.
    pub title: String,
    /// Wanted pose.
    pub pose: PoseSpec,
    /// Coordinates of the pose that are found where the platform rests, for a robot with fewer cables than
    /// free motions: as many of x, y, z, roll, pitch, yaw as cables are missing.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub free: Vec<Coordinate>,
    /// First axis.
    pub x: AxisSpec,
    /// Second axis.
    pub y: AxisSpec,
}

/// One axis of a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AxisSpec {
    /// Name of the parameter.
    pub parameter: String,
    /// Least deviation from its nominal value, in its SI unit.
    pub min: f64,
    /// Greatest deviation.
    pub max: f64,
    /// Points of the grid, 2 to 10000.
    pub points: usize,
}

/// The JSON Schema of the study file, as pretty-printed text.
pub fn json_schema() -> String {
    format!("{:#}\n", schemars::schema_for!(StudyFile).as_value())
}
