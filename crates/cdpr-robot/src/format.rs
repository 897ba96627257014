//! The robot file, `cdpr-robot/1`: JSON, SI units, base frame with z up. Described by [`json_schema`].

pub(crate) mod cable_file;
mod inertia;
pub mod library;

use crate::error::RobotError;
use crate::format::inertia::InertiaEntry;
use crate::freedoms::Plane;
use crate::gravity::Gravity;
use crate::json::from_json;
use crate::law::LawSegment;
use crate::limits::{CableEnd, OwnLimits, TensionDistribution, TensionLimits, TensionReference};
use crate::robot::provenance::{Grade, Provenance};
use crate::robot::{CableProperties, Platform, Pulley, Robot, RobotCable};
use cdpr_cable::{CableError, PiecewiseLaw};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Name and version of the format.
pub const FORMAT: &str = "cdpr-robot/1";

/// A cable-driven parallel robot. SI units; base frame with z up.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "cdpr-robot/1")]
struct RobotFile {
    /// Always "cdpr-robot/1".
    format: String,
    /// Name of the robot.
    name: String,
    /// Where the values come from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    source: Option<String>,
    /// How far the values can be trusted: "surveyed" on the robot itself, from a "paper" or a file of its
    /// makers, or "nominal", with values that somebody has chosen.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    grade: Option<Grade>,
    /// Values that the source does not give and that were chosen, a sentence each.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    assumed: Vec<String>,
    /// Acceleration due to gravity [m/s²]: a number, along -z of the base frame, or a vector in it, [x, y,
    /// z], for a base that is not level.
    gravity: Gravity,
    /// The moving platform.
    platform: PlatformEntry,
    /// Plane of the base frame in which the platform of a planar robot moves: "xy", "xz" or "yz". Motions out
    /// of it are held; in "xz" x, z and the rotation about y are free. Without this field the robot moves in
    /// space.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    plane: Option<Plane>,
    /// Height of the ground in the base frame [m]: no cable and no anchor point may be below it where the
    /// inverse model finds free coordinates. Without this field only the lengths of the cables are bounded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    ground_z: Option<f64>,
    /// Properties of every cable that has none of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    cable: Option<PropertiesEntry>,
    /// Swivelling pulley of every cable that has none of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pulley: Option<PulleyEntry>,
    /// Length between winch and exit point of every cable that has none of its own [m], stretched; elastic
    /// and without weight.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    lead: Option<f64>,
    /// Limits of the tension of every cable that has none of its own.
    tension_limits: LimitsEntry,
    /// Tensions that those of the inverse model come as near to as they can: one for all cables [N], a list
    /// with one for each cable, or "mid", the middle of the limits. Without this field they have the least
    /// norm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    tension_reference: Option<TensionReference>,
    /// Which tensions the inverse model chooses: "nearest" to `tension_reference`, as without this field, or
    /// those of "least_1_norm", "least_2_norm" or "least_infinity_norm", without `tension_reference`.
    #[serde(default, skip_serializing_if = "TensionDistribution::is_nearest")]
    distribution: TensionDistribution,
    /// The cables, one at least. With fewer than the platform has free motions, six in space and three for a
    /// point mass or in a plane, the pose is not free to choose in all coordinates.
    cables: Vec<CableEntry>,
}

#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PlatformEntry {
    /// Mass [kg].
    mass: f64,
    /// Centre of mass in the platform frame [m].
    center_of_mass: [f64; 3],
    /// Inertia about the centre of mass in the platform frame, three rows of three [kg m²]; for natural
    /// frequencies. Of a planar robot a number, the moment about the normal of its plane, is enough.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    inertia: Option<InertiaEntry>,
    /// Whether it is a point mass: its rotation is held, and all anchor points are [0, 0, 0].
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    point: bool,
}

#[derive(Serialize, Deserialize, JsonSchema, Clone)]
#[serde(deny_unknown_fields)]
#[serde(expecting = "its properties, {\"linear_density\": .., \"youngs_modulus\": .., \"diameter\": ..}; \
                 `cdpr robot list` shows those of known cables")]
pub(crate) struct PropertiesEntry {
    /// Diameter [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    diameter: Option<f64>,
    /// Section that carries the tension [m²]; that of the full circle of the diameter if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    section: Option<f64>,
    /// Mass per unstrained length [kg/m].
    linear_density: f64,
    /// Young's modulus [Pa].
    youngs_modulus: f64,
    /// Breaking force [N].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    breaking_force: Option<f64>,
    /// Strain over tension where it is not in proportion; a deviation of the modulus scales it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    law: Option<LawEntry>,
}

#[derive(Serialize, Deserialize, JsonSchema, Clone)]
#[serde(deny_unknown_fields)]
struct LawEntry {
    /// Strain without tension, zero for a new cable.
    #[serde(default)]
    strain_at_rest: f64,
    /// Pieces of constant modulus, from zero tension up.
    segments: Vec<LawSegment>,
}

#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy)]
#[serde(deny_unknown_fields)]
struct PulleyEntry {
    /// Radius to the middle of the cable [m].
    radius: f64,
    /// Swivel axis in the base frame, the direction in which the cable enters at the exit point: [0, 0, 1]
    /// from below, [0, 0, -1] from above, or any other. Its length means nothing.
    axis: [f64; 3],
}

#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct LimitsEntry {
    /// Least tension at the anchor point [N].
    min: f64,
    /// Greatest tension [N].
    max: f64,
    /// Where the greatest tension is limited: "anchor", on the platform, or "exit", where the limit is the
    /// winch's.
    #[serde(default, skip_serializing_if = "CableEnd::is_anchor")]
    max_at: CableEnd,
}

#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct CableEntry {
    /// Exit point in the base frame [m]; with a pulley, where the cable enters it.
    exit_point: [f64; 3],
    /// Anchor point in the platform frame [m].
    anchor_point: [f64; 3],
    /// Properties of this cable, if they differ from the common ones.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    cable: Option<PropertiesEntry>,
    /// Swivelling pulley of this cable, if it differs from the common one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pulley: Option<PulleyEntry>,
    /// Length between winch and exit point of this cable [m], if it differs from the common one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    lead: Option<f64>,
    /// Limits of this cable's tension instead of the robot's, each on its own.
    #[serde(default, skip_serializing_if = "OwnLimits::is_empty")]
    tension_limits: OwnLimits,
}

/// The JSON Schema of the robot file, as pretty-printed text.
pub fn json_schema() -> String {
    format!("{:#}\n", schemars::schema_for!(RobotFile).as_value())
}

impl Robot {
    /// Reads and validates a robot file.
    ///
    /// # Errors
    /// [`RobotError::Format`] with field, line and column for a file of another shape;
    /// [`RobotError::Invalid`] within [`RobotError::At`] for an invalid value, or one in another unit
    /// ([`Robot::check_units`]).
    pub fn from_json(text: &str) -> Result<Self, RobotError> {
        let robot = Self::from_json_in_any_unit(text)?;
        robot.check_units().map_err(|error| error.placed(text))?;
        Ok(robot)
    }

    /// A robot that comes with this crate, by its name in [`library::ROBOTS`].
    ///
    /// # Errors
    /// [`RobotError::Invalid`] for a name that no robot of the library has.
    pub fn from_library(name: &str) -> Result<Self, RobotError> {
        let file = library::named(library::ROBOTS, name).ok_or_else(|| RobotError::Invalid {
            field: "name".to_owned(),
            value: format!("`{name}`"),
            expected: format!(
                "one of {}",
                library::ROBOTS.iter().map(|file| file.name).collect::<Vec<_>>().join(", ")
            ),
        })?;
        Self::from_json(file.text)
    }

    /// Reads and validates a robot file without questioning its units: for an inspection, which names them
    /// all.
    ///
    /// # Errors
    /// As [`Robot::from_json`].
    pub fn from_json_in_any_unit(text: &str) -> Result<Self, RobotError> {
        let file: RobotFile = from_json(text)?;
        file.checked().map_err(|error| error.placed(text))
    }

    /// Writes the robot file; each cable has its own properties unless all are the same.
    pub fn to_json(&self) -> String {
        let entries: Vec<PropertiesEntry> =
            self.cables.iter().map(|cable| entry(&cable.properties)).collect();
        let shared = self.cables.windows(2).all(|pair| pair[0].properties == pair[1].properties);
        let file = RobotFile {
            format: FORMAT.to_owned(),
            name: self.name.clone(),
            source: self.provenance.source.clone(),
            grade: self.provenance.grade,
            assumed: self.provenance.assumed.clone(),
            gravity: self.gravity,
            platform: PlatformEntry {
                mass: self.platform.mass,
                center_of_mass: self.platform.center_of_mass.into(),
                inertia: self.platform.inertia.map(|matrix| InertiaEntry::Tensor(matrix.transpose().into())),
                point: self.platform.point,
            },
            plane: self.plane,
            ground_z: self.ground_z,
            cable: entries.first().filter(|_| shared).cloned(),
            pulley: None,
            lead: None,
            tension_limits: LimitsEntry {
                min: self.tension_limits.min,
                max: self.tension_limits.max,
                max_at: self.max_at,
            },
            tension_reference: self.tension_reference.clone(),
            distribution: self.distribution,
            cables: self
                .cables
                .iter()
                .zip(&entries)
                .map(|(cable, entry)| CableEntry {
                    exit_point: cable.exit_point.into(),
                    anchor_point: cable.anchor_point.into(),
                    cable: (!shared).then(|| entry.clone()),
                    pulley: cable
                        .pulley
                        .map(|Pulley { radius, axis }| PulleyEntry { radius, axis: axis.into() }),
                    lead: (cable.lead != 0.0).then_some(cable.lead),
                    tension_limits: cable.tension_limits,
                })
                .collect(),
        };
        serde_json::to_string_pretty(&file).unwrap_or_default()
    }
}

impl RobotFile {
    fn checked(self) -> Result<Robot, RobotError> {
        if self.format != FORMAT {
            return Err(RobotError::invalid("format", format!("{:?}", self.format), format!("{FORMAT:?}")));
        }
        let robot = self.into_robot()?;
        robot.validate()?;
        // Only a file says more than its robot: deviations of the anchor points are no error.
        let beside = |cable: &RobotCable| cable.anchor_point != Vector3::zeros();
        if let Some(i) = robot.cables.iter().position(|cable| robot.platform.point && beside(cable)) {
            return Err(RobotError::invalid(
                format!("cables[{i}].anchor_point"),
                format!("{:?}", robot.cables[i].anchor_point.as_slice()),
                "[0, 0, 0], as platform.point says that all cables end at a point",
            ));
        }
        Ok(robot)
    }

    fn into_robot(self) -> Result<Robot, RobotError> {
        let shared = self.cable.as_ref().map(|entry| properties(entry, "cable")).transpose()?;
        let cables = self
            .cables
            .iter()
            .enumerate()
            .map(|(i, cable)| {
                let own = cable.cable.as_ref();
                let own = own.map(|entry| properties(entry, &format!("cables[{i}].cable"))).transpose()?;
                let properties = own.or_else(|| shared.clone()).ok_or_else(|| {
                    RobotError::invalid(
                        format!("cables[{i}].cable"),
                        "missing",
                        "properties of this cable, or a common `cable` entry for all",
                    )
                })?;
                Ok(RobotCable {
                    exit_point: Vector3::from(cable.exit_point),
                    anchor_point: Vector3::from(cable.anchor_point),
                    properties,
                    pulley: cable
                        .pulley
                        .or(self.pulley)
                        .map(|PulleyEntry { radius, axis }| Pulley { radius, axis: axis.into() }),
                    lead: cable.lead.or(self.lead).unwrap_or(0.0),
                    tension_limits: cable.tension_limits,
                })
            })
            .collect::<Result<_, RobotError>>()?;
        Ok(Robot {
            name: self.name,
            provenance: Provenance { source: self.source, grade: self.grade, assumed: self.assumed },
            gravity: self.gravity,
            platform: Platform {
                mass: self.platform.mass,
                center_of_mass: Vector3::from(self.platform.center_of_mass),
                inertia: self.platform.inertia.map(|given| given.tensor(self.plane)).transpose()?,
                point: self.platform.point,
            },
            plane: self.plane,
            ground_z: self.ground_z,
            tension_limits: TensionLimits { min: self.tension_limits.min, max: self.tension_limits.max },
            max_at: self.tension_limits.max_at,
            tension_reference: self.tension_reference,
            distribution: self.distribution,
            cables,
        })
    }
}

pub(crate) fn properties(entry: &PropertiesEntry, field: &str) -> Result<CableProperties, RobotError> {
    let full_circle = entry.diameter.map(|d| 0.25 * std::f64::consts::PI * d * d);
    let section = entry.section.or(full_circle).ok_or_else(|| {
        RobotError::invalid(
            format!("{field}.section"),
            "missing",
            "a section [m²], or a diameter [m] to compute it from",
        )
    })?;
    Ok(CableProperties {
        section,
        linear_density: entry.linear_density,
        youngs_modulus: entry.youngs_modulus,
        diameter: entry.diameter,
        breaking_force: entry.breaking_force,
        law: entry.law.as_ref().map(|law| law_of(law, entry.youngs_modulus, section, field)).transpose()?,
    })
}

/// The law of a cable, in proportion to its modulus.
fn law_of(
    entry: &LawEntry,
    youngs_modulus: f64,
    section: f64,
    field: &str,
) -> Result<PiecewiseLaw, RobotError> {
    let segments = LawSegment::in_proportion(&entry.segments, youngs_modulus);
    let scaled_strain = entry.strain_at_rest * youngs_modulus * section;
    PiecewiseLaw::new(scaled_strain, &segments).map_err(|error| match error {
        CableError::InvalidInput { field: of_law, value, expected } => {
            RobotError::invalid(format!("{field}.{of_law}"), value, expected)
        }
        error => RobotError::invalid(format!("{field}.law"), error, "a law of strain over tension"),
    })
}

fn entry(properties: &CableProperties) -> PropertiesEntry {
    PropertiesEntry {
        diameter: properties.diameter,
        section: Some(properties.section),
        linear_density: properties.linear_density,
        youngs_modulus: properties.youngs_modulus,
        breaking_force: properties.breaking_force,
        law: properties.law.as_ref().map(|law| LawEntry {
            strain_at_rest: law.scaled_strain_at_rest() / properties.axial_stiffness(),
            segments: law
                .segments()
                .map(|segment| LawSegment {
                    tension: segment.tension,
                    modulus: segment.ratio * properties.youngs_modulus,
                })
                .collect(),
        }),
    }
}
