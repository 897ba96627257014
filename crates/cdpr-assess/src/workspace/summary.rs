//! A workspace in numbers: settings, counts, extremes.

use crate::boundary::Boundary;
use crate::safety::factors::PartialFactors;
use crate::safety::winds::AnyWeather;
use crate::workspace::question::{Shaking, Way, Workspace};
use crate::workspace::results::{HELD, WorkspacePose};
use crate::workspace::row::{self, WorkspaceRow};
use cdpr_robot::{Pose, Robot, Vector3};
use cdpr_statics::weather::Weather;
use cdpr_study::{Extremes, Grid, robot_hash};
use indexmap::IndexMap;
use serde::Serialize;
use std::collections::BTreeMap;

/// The first format, which did not state its name, had `rows` in place of `columns`.
const WORKSPACE_FORMAT: &str = "cdpr-workspace/2";

/// A workspace with its settings; `workspace.json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WorkspaceSummary {
    /// `cdpr-workspace/2`.
    pub format: &'static str,
    /// Name of the robot.
    pub robot: String,
    /// Hash of the robot ([`robot_hash`]).
    pub robot_hash: String,
    /// Version of the program.
    pub version: String,
    /// Mass added at the platform's centre of mass [kg].
    pub payload: f64,
    /// Force of the load at P [N].
    pub force: [f64; 3],
    /// Moment of the load about P [N m].
    pub moment: [f64; 3],
    /// Orientation of the platform: w, x, y, z.
    pub quaternion: [f64; 4],
    /// The positions [m].
    pub grid: Grid,
    /// Standard deviation of every cause, in SI units.
    pub uncertainties: IndexMap<String, f64>,
    /// Number of positions by status, with the lengths kept under the load.
    pub status: BTreeMap<&'static str, usize>,
    /// Number of positions by status, with the tensions recomputed under the load; empty without a
    /// load.
    pub recomputed_status: BTreeMap<&'static str, usize>,
    /// Number of positions that are left out, by what keeps each from being `held`, with the lengths kept:
    /// the kind of failure, or the cable and the limit that its tension passes.
    pub left_out: BTreeMap<String, usize>,
    /// Number of positions with tensions above a greatest tension or a breaking force.
    pub too_much: usize,
    /// Number of positions held at which two cables touch or cross, or a cable meets the platform; absent
    /// where distances are not asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crossing: Option<usize>,
    /// Number of positions at which each cause dominates.
    pub dominant: BTreeMap<String, usize>,
    /// |dp| [mm] over the positions with status `held`. This and the following are absent without such
    /// positions.
    pub magnitude_mm: Option<Extremes>,
    /// Stiffness of the softest motion [N/m].
    pub least_stiffness_n_per_m: Option<Extremes>,
    /// Frequency with which the platform swings [Hz]; absent without
    /// `platform.inertia`.
    pub platform_frequency_hz: Option<Extremes>,
    /// Lowest natural frequency of platform and cables [Hz]; as that of the platform.
    pub lowest_frequency_hz: Option<Extremes>,
    /// Greatest tension [N].
    pub greatest_tension_n: Option<Extremes>,
    /// Least tension [N].
    pub least_tension_n: Option<Extremes>,
    /// Greatest tension [N] where tensions are recomputed.
    pub recomputed_greatest_tension_n: Option<Extremes>,
    /// Greatest payload [kg], tensions recomputed; this and the following where they are asked for.
    pub payload_recomputed_kg: Option<Extremes>,
    /// Greatest payload [kg], lengths kept.
    pub payload_kept_kg: Option<Extremes>,
    /// Margin of the tensions [N], recomputed.
    pub margin_recomputed_n: Option<Extremes>,
    /// Margin of the tensions [N], lengths kept.
    pub margin_kept_n: Option<Extremes>,
    /// Distance of the nearest two cables [mm].
    pub nearest_cables_mm: Option<Extremes>,
    /// Distance of the cable nearest to the platform [mm].
    pub nearest_to_platform_mm: Option<Extremes>,
    /// Tilt in the worst direction [deg].
    pub tilt_deg: Option<Extremes>,
    /// Largest amplitude by a force [mm/N].
    pub amplitude_mm_per_n: Option<Extremes>,
    /// Largest amplitude by a winch [mm/mm].
    pub winch_mm_per_mm: Option<Extremes>,
    /// Displacement in the weather [mm], in wind of the worst direction.
    pub weather_moved_mm: Option<Extremes>,
    /// Greatest tension in the weather [N], in wind of any direction.
    pub weather_greatest_tension_n: Option<Extremes>,
    /// Greatest utilization of a cable, with all cables, each of them broken and in the weather.
    pub utilization: Option<Extremes>,
    /// Motion of the platform after the break that moves it farthest [mm].
    pub break_moved_mm: Option<Extremes>,
    /// The factors of the utilizations, if asked for.
    pub factors: Option<PartialFactors>,
    /// The weather, if asked for.
    pub weather: Option<WeatherSummary>,
    /// What shakes the platform, if asked for.
    pub shaking: Option<ShakingSummary>,
    /// The boundary of the positions that are held, if asked for.
    pub boundary: Option<BoundarySummary>,
    /// Every position, in the order of the grid; in the file an array for each of their values (`columns`).
    #[serde(rename = "columns", serialize_with = "row::columns")]
    pub rows: Vec<WorkspaceRow>,
}

/// The region of the positions that are held.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BoundarySummary {
    /// How the load is borne: `recomputed` or `kept`.
    pub way: &'static str,
    /// Its area [m²] in a plane, its volume [m³] in a box.
    pub measure: f64,
    /// Estimate of the error of it where the boundary is smooth over a step of the grid.
    pub error: f64,
    /// What of it is in doubt, since parts thinner than a step of the grid are not seen.
    pub doubtful: f64,
    /// `m2` or `m3`.
    pub unit: &'static str,
    /// Polygons of its boundary in a plane, triangles in a box.
    pub parts: usize,
    /// Positions that were asked for.
    pub evaluations: usize,
}

/// The weather of a map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct WeatherSummary {
    /// Speed of a horizontal wind from any direction [m/s]; absent for a wind of one velocity.
    pub speed: Option<f64>,
    /// Velocity of a wind of one velocity [m/s].
    pub velocity: Option<[f64; 3]>,
    /// Roughness length of the ground and height of reference of the wind [m].
    pub wind_profile: Option<[f64; 2]>,
    /// How much warmer it is [K].
    pub warmer: f64,
    /// Thermal expansion of the cables [1/K].
    pub cable_expansion: f64,
    /// Thermal expansion of the frame [1/K].
    pub frame_expansion: f64,
    /// Thickness of the ice [m].
    pub ice: f64,
    /// Creep of the cables.
    pub creep: f64,
    /// Positions that are held without the weather, where in it a tension is out of its limits or no rest was
    /// found.
    pub wrong: usize,
}

impl WeatherSummary {
    fn new(AnyWeather { weather, speed }: &AnyWeather, rows: &[WorkspaceRow]) -> Self {
        let Weather { wind, warmer, cable_expansion, frame_expansion, ice, creep } = *weather;
        let wrong = rows.iter().filter(|row| row.status == HELD && row.weather_reason.is_some());
        Self {
            speed: *speed,
            velocity: (speed.is_none() && !wind.is_calm()).then(|| wind.velocity().into()),
            wind_profile: wind.profile().map(|profile| [profile.roughness, profile.reference]),
            warmer,
            cable_expansion,
            frame_expansion,
            ice,
            creep,
            wrong: wrong.count(),
        }
    }

    /// In words, as in `wind of 20 m/s from any direction, ice of 0.003 m`.
    pub fn conditions(&self) -> String {
        let mut words = Vec::new();
        if let Some(speed) = self.speed {
            words.push(format!("wind of {speed} m/s from any direction"));
        }
        if let Some([x, y, z]) = self.velocity {
            words.push(format!("wind ({x}, {y}, {z}) m/s"));
        }
        if let Some([roughness, reference]) = self.wind_profile {
            words.push(format!("at {reference} m over ground of roughness {roughness} m"));
        }
        for (name, value, unit) in
            [("warmer by", self.warmer, " K"), ("ice of", self.ice, " m"), ("creep of", self.creep, "")]
        {
            if value != 0.0 {
                words.push(format!("{name} {value}{unit}"));
            }
        }
        words.join(", ")
    }
}

/// What shakes the platform, and what damps its cables.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ShakingSummary {
    /// The lowest and the highest frequency [Hz].
    pub band_hz: [f64; 2],
    /// Damping of the stretch of cables [s].
    pub damping_s: f64,
    /// Drag of the air [1/s].
    pub drag_per_s: f64,
    /// The point that is shaken, in the frame of the platform [m].
    pub marker: [f64; 3],
    /// Whether the inertia of the platform is assumed.
    pub inertia_assumed: bool,
}

impl ShakingSummary {
    fn new(robot: &Robot, Shaking { band, damping, marker }: &Shaking) -> Self {
        Self {
            band_hz: *band,
            damping_s: damping.stretch,
            drag_per_s: damping.drag,
            marker: (*marker).into(),
            inertia_assumed: robot.lacks_inertia(),
        }
    }

    /// Band and damping, as in `0 Hz to 20 Hz, damping of the cables: stretch 0.0002 s, drag 0 1/s`.
    pub fn conditions(&self) -> String {
        let Self { band_hz: [from, to], damping_s, drag_per_s, .. } = self;
        format!("{from} Hz to {to} Hz, damping of the cables: stretch {damping_s} s, drag {drag_per_s} 1/s")
    }
}

impl BoundarySummary {
    /// Sums up a boundary.
    pub fn new(way: Way, boundary: &Boundary) -> Self {
        let Boundary { measure, error, doubtful, polygons, triangles, evaluations } = boundary;
        let is_plane = triangles.is_empty();
        Self {
            way: way.name(),
            measure: *measure,
            error: *error,
            doubtful: *doubtful,
            unit: if is_plane { "m2" } else { "m3" },
            parts: if is_plane { polygons.len() } else { triangles.len() },
            evaluations: *evaluations,
        }
    }
}

impl WorkspaceSummary {
    /// Whether there is a load besides the platform's own weight.
    pub fn is_loaded(&self) -> bool {
        self.payload != 0.0 || self.force != [0.0; 3] || self.moment != [0.0; 3]
    }

    /// Load and orientation, as in `payload 50 kg, force (0, 100, 0) N`.
    pub fn conditions(&self) -> String {
        let mut words = vec![format!("payload {} kg", self.payload)];
        for (name, vector, unit) in [("force", self.force, "N"), ("moment", self.moment, "N m")] {
            let [x, y, z] = vector;
            if vector != [0.0; 3] {
                words.push(format!("{name} ({x}, {y}, {z}) {unit}"));
            }
        }
        let [qw, qx, qy, qz] = self.quaternion;
        if [qx, qy, qz] != [0.0; 3] {
            words.push(format!("quaternion ({qw:.4}, {qx:.4}, {qy:.4}, {qz:.4})"));
        }
        words.join(", ")
    }

    /// Summarizes the poses of a workspace.
    pub fn new(workspace: &Workspace, poses: &[WorkspacePose]) -> Self {
        let rows: Vec<_> = poses.iter().map(|pose| WorkspaceRow::new(workspace, pose)).collect();
        let (mut status, mut recomputed_status, mut dominant) =
            (BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
        for row in &rows {
            *status.entry(row.status).or_insert(0) += 1;
            if let Some(recomputed) = row.recomputed_status {
                *recomputed_status.entry(recomputed).or_insert(0) += 1;
            }
            if let Some(name) = &row.dominant {
                *dominant.entry(name.clone()).or_insert(0) += 1;
            }
        }
        let causes = workspace.tolerances.map(|model| model.inputs.as_slice()).unwrap_or_default();
        Self {
            format: WORKSPACE_FORMAT,
            robot: workspace.robot.name.clone(),
            robot_hash: robot_hash(workspace.robot),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            payload: workspace.load.payload,
            force: workspace.load.wrench.force.into(),
            moment: workspace.load.wrench.moment.into(),
            quaternion: Pose { position: Vector3::zeros(), rotation: workspace.rotation }.quaternion(),
            grid: workspace.grid,
            uncertainties: causes.iter().map(|cause| (cause.name.clone(), cause.std())).collect(),
            status,
            recomputed_status,
            left_out: left_out(poses),
            too_much: poses.iter().filter(|pose| pose.is_too_much()).count(),
            crossing: workspace
                .further
                .distances
                .then(|| rows.iter().filter(|row| row.status == HELD && row.is_crossed()).count()),
            dominant,
            magnitude_mm: held_extremes(&rows, |row| row.magnitude_mm),
            least_stiffness_n_per_m: held_extremes(&rows, |row| row.least_stiffness_n_per_m),
            platform_frequency_hz: held_extremes(&rows, |row| row.platform_frequency_hz),
            lowest_frequency_hz: held_extremes(&rows, |row| row.lowest_frequency_hz),
            greatest_tension_n: held_extremes(&rows, |row| row.greatest_tension_n),
            least_tension_n: held_extremes(&rows, |row| row.least_tension_n),
            recomputed_greatest_tension_n: held_extremes(&rows, |row| row.recomputed_greatest_tension_n),
            payload_recomputed_kg: held_extremes(&rows, |row| row.payload_recomputed_kg),
            payload_kept_kg: held_extremes(&rows, |row| row.payload_kept_kg),
            margin_recomputed_n: held_extremes(&rows, |row| row.margin_recomputed_n),
            margin_kept_n: held_extremes(&rows, |row| row.margin_kept_n),
            nearest_cables_mm: held_extremes(&rows, |row| row.nearest_cables_mm),
            nearest_to_platform_mm: held_extremes(&rows, |row| row.nearest_to_platform_mm),
            tilt_deg: held_extremes(&rows, |row| row.tilt_deg),
            amplitude_mm_per_n: held_extremes(&rows, |row| row.amplitude_mm_per_n),
            winch_mm_per_mm: held_extremes(&rows, |row| row.winch_mm_per_mm),
            weather_moved_mm: held_extremes(&rows, |row| row.weather_moved_mm),
            weather_greatest_tension_n: held_extremes(&rows, |row| row.weather_greatest_tension_n),
            utilization: held_extremes(&rows, |row| row.utilization),
            break_moved_mm: held_extremes(&rows, |row| row.break_moved_mm),
            factors: workspace.further.breaks,
            weather: workspace.further.weather.map(|weather| WeatherSummary::new(&weather, &rows)),
            shaking: workspace.further.shaking.map(|shaking| ShakingSummary::new(workspace.robot, &shaking)),
            boundary: None,
            rows,
        }
    }
}

/// What keeps positions from being held, and of how many.
fn left_out(poses: &[WorkspacePose]) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    for pose in poses {
        let why = match &pose.outcome {
            Ok(held) if held.is_within_limits() => continue,
            Ok(held) => match held.out_of_limits.iter().min_by_key(|found| found.limit) {
                Some(found) => format!("beyond_limits: cable {}, {}", found.cable + 1, found.limit.name()),
                None => continue,
            },
            Err(error) => error.kind().to_owned(),
        };
        *counts.entry(why).or_insert(0) += 1;
    }
    counts
}

/// The extremes over the positions with status `held`.
fn held_extremes(rows: &[WorkspaceRow], value: impl Fn(&WorkspaceRow) -> Option<f64>) -> Option<Extremes> {
    let held = rows.iter().filter(|row| row.status == HELD);
    Extremes::of(held.filter_map(|row| Some((value(row)?, [row.x_m, row.y_m, row.z_m]))))
}
