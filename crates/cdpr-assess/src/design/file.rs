//! The design file, `cdpr-design/1`: what of a robot may change, and for which poses, loads and purpose.

use crate::design::goal::Goal;
use cdpr_robot::Coordinate;
use cdpr_study::{IndexMap, InputSpec, PosesSpec};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Name and version of the format.
pub const DESIGN_FORMAT: &str = "cdpr-design/1";

/// What of a robot may change, and what is to be as good as possible. SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "cdpr-design/1")]
pub struct DesignFile {
    /// Always "cdpr-design/1".
    pub format: String,
    /// Where its values come from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<String>,
    /// What may change: lengths, points, masses, each within bounds or among choices.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub variables: Vec<VariableSpec>,
    /// Types of cable, of which one is chosen for all cables or for each of `cable_groups`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cables: Vec<CableSpec>,
    /// Groups of cables that are of one type, by their numbers from 1; all cables in one group if left out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cable_groups: Vec<Vec<usize>>,
    /// Poses that the platform takes.
    pub poses: PosesSpec,
    /// Coordinates of the poses that are found where the platform rests, for a robot with fewer cables
    /// than free motions: as many of x, y, z, roll, pitch, yaw as cables are missing.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub free: Vec<Coordinate>,
    /// Mass added at the platform's centre of mass [kg].
    #[serde(default)]
    pub payload: f64,
    /// Force and moment about P, of constant components in the base frame: fx, fy, fz [N], mx, my, mz [N
    /// m].
    #[serde(default)]
    pub wrench: [f64; 6],
    /// Deviations of parameters from which a position error follows, as an error model of a study has them:
    /// laws with mean zero.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub errors: Option<IndexMap<String, InputSpec>>,
    /// What is to be as good as possible.
    pub objective: ObjectiveSpec,
    /// A second objective: what is searched is the Pareto front of both, robots of which none is better in
    /// both.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pareto: Option<ParetoSpec>,
    /// What is demanded at every pose.
    #[serde(default, skip_serializing_if = "LimitsSpec::is_empty")]
    pub limits: LimitsSpec,
    /// Starts of the local search: the robot as it is, and points of Sobol's sequence where it is held.
    #[serde(default = "DesignFile::usual_starts")]
    pub starts: usize,
    /// Seed of a scrambling of these points; without it the sequence is the plain one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
}

impl DesignFile {
    fn usual_starts() -> usize {
        16
    }
}

/// Something that may change: one number, with `bounds` or `choices`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VariableSpec {
    /// Its name in results; that of the first parameter if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Parameters that change together (`b1.x`, `a3.z`, `mass`). The number is the value of the first; the
    /// others change by as much from what they are.
    pub parameters: Vec<String>,
    /// Sign of the change of each parameter, 1 or -1, for symmetry; 1 for all if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub signs: Option<Vec<f64>>,
    /// Least and greatest value of the first parameter, in its SI unit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bounds: Option<[f64; 2]>,
    /// The only values that the first parameter may have, such as places of a pulley that moves in steps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub choices: Option<Vec<f64>>,
}

/// A type of cable, with the fields that the cables of a robot file have. SI units.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CableSpec {
    /// Name of the type.
    pub name: String,
    /// Diameter [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diameter: Option<f64>,
    /// Section that carries the tension [m²]; that of the full circle of the diameter if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub section: Option<f64>,
    /// Mass per unstrained length [kg/m].
    pub linear_density: f64,
    /// Young's modulus [Pa].
    pub youngs_modulus: f64,
    /// Breaking force [N], which is the greatest tension if it is below that of the robot.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub breaking_force: Option<f64>,
    /// Cost of a metre, in any currency.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cost: Option<f64>,
}

/// What is to be as good as possible.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ObjectiveSpec {
    /// "deflection", "position", "tension", "length" or "cost", which are to be small, or "stiffness",
    /// "frequency" or "platform_frequency", which are to be great.
    pub output: Goal,
    /// Over the poses: "worst" if left out. Length and cost are of all poses together.
    #[serde(default)]
    pub over: Over,
}

/// A second objective.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ParetoSpec {
    /// As that of the objective.
    pub output: Goal,
    /// Over the poses, as that of the objective.
    #[serde(default)]
    pub over: Over,
    /// Points of the front that are looked for, its ends included; of choices without bounds all are found.
    #[serde(default = "ParetoSpec::usual_points")]
    pub points: usize,
}

impl ParetoSpec {
    fn usual_points() -> usize {
        9
    }
}

/// Which number of several poses counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Over {
    /// The mean of the poses.
    Mean,
    /// The pose where it is worst: the greatest deflection, the least stiffness or frequency.
    #[default]
    Worst,
}

/// Demands at every pose, on top of the limits of the tensions, and of all poses together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LimitsSpec {
    /// Greatest deflection [mm].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub deflection: Option<f64>,
    /// Greatest position error [mm], within which 95 % of the robots of `errors` are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position: Option<f64>,
    /// Least stiffness [N/m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<f64>,
    /// Least natural frequency [Hz].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frequency: Option<f64>,
    /// Greatest tension of a cable at its exit point under the load [N]: what its winch pulls.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tension: Option<f64>,
    /// Greatest length of all cables [m]: the sum of their unstrained lengths, lead included, of each at the
    /// pose where it is longest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<f64>,
    /// Greatest cost of all cables: that of a metre of their types times the length that each needs, lead
    /// included, at the pose where it is longest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cost: Option<f64>,
}

impl LimitsSpec {
    fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// The demands on one number of each pose: of what, and its limit.
    pub(crate) fn each(&self) -> impl Iterator<Item = (Goal, f64)> {
        let of = |output, limit: Option<f64>| limit.map(|limit| (output, limit));
        [
            of(Goal::Deflection, self.deflection),
            of(Goal::Position, self.position),
            of(Goal::Stiffness, self.stiffness),
            of(Goal::Frequency, self.frequency),
        ]
        .into_iter()
        .flatten()
    }

    /// The demands on all poses together.
    pub(crate) fn whole(&self) -> impl Iterator<Item = (Goal, f64)> {
        let of = |output, limit: Option<f64>| limit.map(|limit| (output, limit));
        [of(Goal::Cost, self.cost), of(Goal::Length, self.length)].into_iter().flatten()
    }

    /// All demands.
    pub(crate) fn all(&self) -> impl Iterator<Item = (Goal, f64)> {
        let tension = self.tension.map(|limit| (Goal::Tension, limit));
        self.each().chain(tension).chain(self.whole())
    }
}

/// The JSON Schema of the design file, as pretty-printed text.
pub fn design_schema() -> String {
    format!("{:#}\n", schemars::schema_for!(DesignFile).as_value())
}
