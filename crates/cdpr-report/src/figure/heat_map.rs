//! Maps of a robot's behaviour over a plane of its workspace.

use crate::drawing::color_map::ColorMap;
use crate::drawing::heading::Heading;
use crate::drawing::name_map::name_map;
use crate::drawing::plane::{Paint, Plane};
use crate::drawing::sheet::Sheet;
use crate::error::ReportError;
use crate::figure::pose_map::NamedMap;
use crate::text::digits;
use cdpr_assess::{Boundary, HELD, WorkspaceRow, WorkspaceSummary};
use cdpr_robot::Robot;
use rayon::prelude::*;

/// Quantity that is drawn over the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapQuantity {
    /// Deflection |dp| under the load.
    Deflection,
    /// Stiffness of the softest motion.
    LeastStiffness,
    /// Natural frequency of the platform with the load, of a robot with `platform.inertia`.
    PlatformFrequency,
    /// Greatest tension of any cable, without and with the load.
    GreatestTension,
    /// Greatest tension of any cable where tensions are recomputed under the load.
    GreatestTensionRecomputed,
    /// Greatest payload where tensions are recomputed.
    PayloadRecomputed,
    /// Greatest payload with the lengths kept.
    PayloadKept,
    /// Distance of the tensions, recomputed, from the nearest limit.
    MarginRecomputed,
    /// Distance of the nearest two cables.
    NearestCables,
    /// Distance of the cable nearest to the platform.
    NearestToPlatform,
    /// Tilt in the worst direction.
    Tilt,
    /// Largest amplitude by a force in a band of frequencies.
    Amplitude,
    /// Largest amplitude by a winch in a band of frequencies.
    WinchAmplitude,
    /// Displacement in the weather and under the load, in wind of the worst direction.
    Weather,
    /// Greatest utilization of a cable, with all cables, each of them broken and in the weather.
    Utilization,
    /// Motion of the platform after the break that moves it farthest.
    AfterBreak,
}

impl MapQuantity {
    /// All quantities.
    pub const ALL: [Self; 16] = [
        Self::Deflection,
        Self::LeastStiffness,
        Self::PlatformFrequency,
        Self::GreatestTension,
        Self::GreatestTensionRecomputed,
        Self::PayloadRecomputed,
        Self::PayloadKept,
        Self::MarginRecomputed,
        Self::NearestCables,
        Self::NearestToPlatform,
        Self::Tilt,
        Self::Amplitude,
        Self::WinchAmplitude,
        Self::Weather,
        Self::Utilization,
        Self::AfterBreak,
    ];

    /// Name of its figure file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Deflection => "deflection",
            Self::LeastStiffness => "least_stiffness",
            Self::PlatformFrequency => "platform_frequency",
            Self::GreatestTension => "greatest_tension",
            Self::GreatestTensionRecomputed => "greatest_tension_recomputed",
            Self::PayloadRecomputed => "payload_recomputed",
            Self::PayloadKept => "payload_kept",
            Self::MarginRecomputed => "margin_recomputed",
            Self::NearestCables => "nearest_cables",
            Self::NearestToPlatform => "nearest_to_platform",
            Self::Tilt => "tilt",
            Self::Amplitude => "amplitude",
            Self::WinchAmplitude => "winch_amplitude",
            Self::Weather => "weather",
            Self::Utilization => "utilization",
            Self::AfterBreak => "after_break",
        }
    }

    /// Whether it exists in this workspace.
    fn exists(self, summary: &WorkspaceSummary) -> bool {
        match self {
            Self::Deflection | Self::GreatestTensionRecomputed => summary.is_loaded(),
            Self::LeastStiffness | Self::GreatestTension => true,
            _ => summary.rows.iter().any(|row| self.value(row).is_some()),
        }
    }

    /// How the load is borne, for the title.
    fn under_load(self) -> &'static str {
        if self.is_recomputed() { "tensions recomputed" } else { "lengths kept" }
    }

    /// Whether a position is held, with all tensions within the limits.
    fn is_held(self, row: &WorkspaceRow) -> bool {
        match row.recomputed_status {
            Some(status) if self.is_recomputed() => status == HELD,
            // Without a load both ways are one.
            _ => row.status == HELD,
        }
    }

    fn is_recomputed(self) -> bool {
        !matches!(
            self,
            Self::Deflection
                | Self::LeastStiffness
                | Self::PlatformFrequency
                | Self::GreatestTension
                | Self::PayloadKept
                | Self::Weather
        ) && !self.is_amplitude()
    }

    fn is_amplitude(self) -> bool {
        matches!(self, Self::Amplitude | Self::WinchAmplitude)
    }

    /// Words for the title, label of the colour bar, and unit, empty of a ratio.
    fn words(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Self::Deflection => ("static deflection", "|dp|", "mm"),
            Self::LeastStiffness => ("stiffness of the softest motion", "least stiffness", "kN/m"),
            Self::PlatformFrequency => ("natural frequency of the platform", "frequency", "Hz"),
            Self::GreatestTension | Self::GreatestTensionRecomputed => {
                ("greatest tension", "greatest tension", "N")
            }
            Self::PayloadRecomputed | Self::PayloadKept => ("greatest payload", "payload", "kg"),
            Self::MarginRecomputed => ("distance of the tensions from their limits", "margin", "N"),
            Self::NearestCables => ("distance of the nearest two cables", "distance", "mm"),
            Self::NearestToPlatform => ("distance of cables and platform", "distance", "mm"),
            Self::Tilt => ("tilt in the worst direction", "tilt", "degrees"),
            Self::Amplitude => ("largest amplitude by a force", "amplitude", "mm/N"),
            Self::WinchAmplitude => ("largest amplitude by a winch", "amplitude", "mm/mm"),
            Self::Weather => ("displacement in the weather", "|dp|", "mm"),
            Self::Utilization => ("greatest utilization, whole and after each break", "utilization", ""),
            Self::AfterBreak => ("motion after the worst break", "|dp|", "mm"),
        }
    }

    /// Value in the unit of the label.
    fn value(self, row: &WorkspaceRow) -> Option<f64> {
        match self {
            Self::Deflection => row.magnitude_mm,
            Self::LeastStiffness => row.least_stiffness_n_per_m.map(|stiffness| 1e-3 * stiffness),
            Self::PlatformFrequency => row.platform_frequency_hz,
            Self::GreatestTension => row.greatest_tension_n,
            Self::GreatestTensionRecomputed => row.recomputed_greatest_tension_n,
            Self::PayloadRecomputed => row.payload_recomputed_kg.map(beyond_rounding),
            Self::PayloadKept => row.payload_kept_kg.map(beyond_rounding),
            Self::MarginRecomputed => row.margin_recomputed_n,
            Self::NearestCables => row.nearest_cables_mm,
            Self::NearestToPlatform => row.nearest_to_platform_mm,
            Self::Tilt => row.tilt_deg,
            Self::Amplitude => row.amplitude_mm_per_n,
            Self::WinchAmplitude => row.winch_mm_per_mm,
            Self::Weather => row.weather_moved_mm,
            Self::Utilization => row.utilization,
            Self::AfterBreak => row.break_moved_mm,
        }
    }
}

/// A payload below a gram is a rounding error of two tensions [kg].
fn beyond_rounding(payload: f64) -> f64 {
    if payload < 1e-3 { 0.0 } else { payload }
}

/// Draws a quantity over a plane in colour, with the exit points and the rectangle around them.
///
/// Positions without feasible tensions are hatched in grey. Positions at which the load takes a tension out
/// of its limits are hatched in colour.
///
/// # Errors
/// [`ReportError::Invalid`] for a workspace that is not a plane, [`ReportError::Empty`] if no position has
/// feasible tensions.
pub fn heat_map(
    robot: &Robot,
    summary: &WorkspaceSummary,
    quantity: MapQuantity,
    sheet: Sheet,
) -> Result<String, ReportError> {
    values(&plane_of(summary)?, robot, summary, quantity, sheet)
}

fn values(
    plane: &Plane,
    robot: &Robot,
    summary: &WorkspaceSummary,
    quantity: MapQuantity,
    sheet: Sheet,
) -> Result<String, ReportError> {
    let (words, label, unit) = quantity.words();
    let rows: Vec<_> = plane.positions.iter().map(|position| &summary.rows[*position]).collect();
    let values = rows.iter().map(|row| quantity.value(row)).collect();
    let (label, unit) = match unit {
        "" => (label.to_owned(), String::new()),
        unit => (format!("{label} [{unit}]"), format!(" {unit}")),
    };
    let map = ColorMap::new(plane.cells()?, values, quantity.name(), &label)?.by_decades();
    let mut lines = Vec::new();
    if let Some(shaking) = summary.shaking.filter(|_| quantity.is_amplitude()) {
        lines.push(format!("shaken from {}", shaking.conditions()));
    }
    if let Some(weather) = summary.weather.filter(|_| quantity == MapQuantity::Weather) {
        lines.push(weather.conditions());
    }
    if let Some(factors) = summary.factors.filter(|_| quantity == MapQuantity::Utilization) {
        lines.push(factors.conditions());
    }
    let hatched = |index: usize| !quantity.is_held(rows[index]);
    let held = (0..rows.len()).filter(|index| !hatched(*index)).count();
    // A payload is borne in one way or the other without a load, too.
    let is_payload = matches!(quantity, MapQuantity::PayloadKept | MapQuantity::PayloadRecomputed);
    let is_borne = summary.is_loaded() || is_payload;
    let borne = if is_borne { format!(", {}", quantity.under_load()) } else { String::new() };
    lines.insert(
        0,
        format!(
            "{}{unit} to {}{unit}{}; {held} of {} positions held with all tensions within limits, the others \
                are hatched",
            digits(map.least, 4),
            digits(map.greatest, 4),
            if map.by_decades { ", colours by powers of ten" } else { "" },
            rows.len()
        ),
    );
    let heading = Heading {
        title: &format!("{}: {words} at {}, {}{borne}", summary.robot, plane.words(), summary.conditions()),
        lines: &lines,
        key: &plane.key(),
    };
    plane.figure(robot, &heading, &Paint::Values(map), hatched, sheet)
}

/// Draws, over a plane, the tolerance that contributes most to the variance of |dp|. Positions without
/// feasible tensions are hatched.
///
/// # Errors
/// As [`heat_map`], and [`ReportError::Empty`] for a workspace without tolerances.
pub fn tolerance_map(robot: &Robot, summary: &WorkspaceSummary, sheet: Sheet) -> Result<String, ReportError> {
    names(&plane_of(summary)?, robot, summary, sheet)
}

fn names(
    plane: &Plane,
    robot: &Robot,
    summary: &WorkspaceSummary,
    sheet: Sheet,
) -> Result<String, ReportError> {
    let rows = plane.positions.iter().map(|position| &summary.rows[*position]);
    let names: Vec<_> = rows.map(|row| row.dominant.as_deref()).collect();
    let shown = names.iter().flatten().count();
    if shown == 0 {
        return Err(ReportError::Empty { what: "no tolerance at any position" });
    }
    let title = format!(
        "{}: tolerance with the largest share of the variance of |dp| at {}, {}",
        summary.robot,
        plane.words(),
        summary.conditions()
    );
    let line = format!("{shown} of {} positions, the others are hatched", names.len());
    name_map(plane, robot, &title, line, &names, sheet)
}

/// Draws all maps of a plane, or of `most` layers of a box, spread evenly from the lowest to the highest one.
/// The names of layers end in their numbers, `_z00`, ... A boundary that was computed is drawn in each of them.
pub fn workspace_maps(
    robot: &Robot,
    summary: &WorkspaceSummary,
    boundary: Option<&Boundary>,
    most: usize,
    sheet: Sheet,
) -> Vec<NamedMap> {
    let shown: Vec<_> = MapQuantity::ALL.into_iter().filter(|of| of.exists(summary)).collect();
    let of_plane = |plane: &Plane| {
        let name = |quantity: &str| format!("{quantity}{}", plane.suffix());
        let map = |of: &MapQuantity| NamedMap {
            name: name(of.name()),
            svg: values(plane, robot, summary, *of, sheet),
        };
        let mut maps: Vec<_> = shown.iter().map(map).collect();
        if !summary.uncertainties.is_empty() {
            let svg = names(plane, robot, summary, sheet);
            maps.push(NamedMap { name: name("dominant_tolerance"), svg });
        }
        maps
    };
    let borne = match summary.boundary.as_ref().map(|boundary| boundary.way) {
        Some("kept") => "boundary, lengths kept",
        _ => "boundary, tensions recomputed",
    };
    let bounded = |plane: Plane| match boundary {
        Some(boundary) => plane.with_boundary(boundary, borne),
        None => plane,
    };
    let planes: Vec<Plane> = Plane::of(&summary.grid).into_iter().map(bounded).collect();
    spread(planes.len(), most).into_par_iter().flat_map(|layer| of_plane(&planes[layer])).collect()
}

/// The number of layers that maps have: one of a plane, none where a line or a point was asked for.
pub fn layers(summary: &WorkspaceSummary) -> usize {
    Plane::of(&summary.grid).len()
}

/// At most `most` of `count` numbers from 0, spread evenly; the first one and, of several, the last one are
/// among them.
fn spread(count: usize, most: usize) -> Vec<usize> {
    let chosen = count.min(most);
    let last = count.saturating_sub(1);
    (0..chosen).map(|k| if chosen > 1 { (k * last + (chosen - 1) / 2) / (chosen - 1) } else { 0 }).collect()
}

fn plane_of(summary: &WorkspaceSummary) -> Result<Plane, ReportError> {
    let mut planes = Plane::of(&summary.grid);
    match (planes.pop(), planes.is_empty()) {
        (Some(plane), true) => Ok(plane),
        _ => Err(ReportError::invalid("grid", &summary.rows.len(), "one coordinate along one axis: a plane")),
    }
}
