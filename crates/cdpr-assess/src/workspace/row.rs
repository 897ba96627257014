//! A row of the table of a workspace.

use crate::capacity::{Capacity, Figure};
use crate::clearance::CableDistance;
use crate::safety::factored::Situation;
use crate::safety::winds::Winds;
use crate::workspace::breaks::AfterBreaks;
use crate::workspace::question::Workspace;
use crate::workspace::results::{BEYOND_LIMITS, Dominant, HELD, WorkspacePose};
use cdpr_statics::limits::in_words;
use cdpr_statics::{Load, StaticsError};
use serde::ser::{Serialize, SerializeMap, Serializer};

/// A row of `workspace.csv`, and an element of each column of `workspace.json`: positions [m], deflection
/// [mm], tensions [N], stiffness [N/m], frequencies [Hz]. Values that do not exist are empty.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
#[allow(missing_docs)]
pub struct WorkspaceRow {
    pub x_m: f64,
    pub y_m: f64,
    pub z_m: f64,
    /// With the lengths kept: `held`; `beyond_limits` where the load takes a tension out of the limits; else
    /// the kind of failure.
    pub status: &'static str,
    pub least_tension_n: Option<f64>,
    pub greatest_tension_n: Option<f64>,
    pub dx_mm: Option<f64>,
    pub dy_mm: Option<f64>,
    pub dz_mm: Option<f64>,
    /// |dp|.
    pub magnitude_mm: Option<f64>,
    pub least_stiffness_n_per_m: Option<f64>,
    /// Frequency with which the platform swings with the load, the mass of cables included.
    pub platform_frequency_hz: Option<f64>,
    /// Share of the platform in the kinetic energy of that motion.
    pub platform_share: Option<f64>,
    /// Lowest natural frequency of platform and cables with the load.
    pub lowest_frequency_hz: Option<f64>,
    /// Their numbers, from 1, with spaces between.
    pub slack_cables: Option<String>,
    /// Tensions out of limits, in words.
    pub out_of_limits: Option<String>,
    /// The cause with the largest share of the variance of |dp|.
    pub dominant: Option<String>,
    pub dominant_share: Option<f64>,
    /// Standard deviation of |dp| from all tolerances.
    pub std_mm: Option<f64>,
    /// Why the pose is not held, or a value is missing.
    pub reason: Option<String>,
    /// `held` where tensions recomputed hold the pose under the load; `beyond_limits` where they are above a
    /// limit or a breaking force; else the kind of failure. This and the following are empty without a load.
    pub recomputed_status: Option<&'static str>,
    pub recomputed_least_tension_n: Option<f64>,
    pub recomputed_greatest_tension_n: Option<f64>,
    pub recomputed_reason: Option<String>,
    /// Greatest mass at the centre of mass [kg], tensions recomputed; this and all that follows is
    /// empty where it was not asked for or does not exist.
    pub payload_recomputed_kg: Option<f64>,
    /// The cables and limits that block it, in words; where it is missing at a pose that is held, why.
    pub payload_recomputed_blocked_by: Option<String>,
    /// Greatest mass at the centre of mass [kg], lengths kept.
    pub payload_kept_kg: Option<f64>,
    pub payload_kept_blocked_by: Option<String>,
    /// Distance of the tensions from the nearest limit [N].
    pub margin_recomputed_n: Option<f64>,
    pub margin_kept_n: Option<f64>,
    /// Distance of the nearest two cables.
    pub nearest_cables_mm: Option<f64>,
    /// Their numbers, from 1.
    pub nearest_cables: Option<String>,
    /// Distance of the cable nearest to the platform.
    pub nearest_to_platform_mm: Option<f64>,
    pub nearest_to_platform: Option<usize>,
    /// How far the platform may tilt in the worst direction.
    pub tilt_deg: Option<f64>,
    /// The azimuth of that direction, from x to y.
    pub tilt_azimuth_deg: Option<f64>,
    /// Largest amplitude of the point in the band by a force there, of the worst direction [mm/N].
    pub amplitude_mm_per_n: Option<f64>,
    pub amplitude_at_hz: Option<f64>,
    /// Largest amplitude of the point in the band by a winch [mm/mm].
    pub winch_mm_per_mm: Option<f64>,
    pub winch_at_hz: Option<f64>,
    /// The number of this winch, from 1.
    pub winch: Option<usize>,
    /// Why a position that is held has no amplitude.
    pub amplitude_reason: Option<String>,
    /// Displacement in the weather and under the load, in wind of the worst direction.
    pub weather_moved_mm: Option<f64>,
    /// The azimuth in which that wind blows, from x to y; empty for a wind of one velocity.
    pub weather_azimuth_deg: Option<f64>,
    /// Least and greatest tension of any cable at the platform or exit point, in wind of any direction.
    pub weather_least_tension_n: Option<f64>,
    pub weather_greatest_tension_n: Option<f64>,
    /// What is wrong in the weather, in words: a wind without a rest, tensions out of limits.
    pub weather_reason: Option<String>,
    /// Greatest utilization of a cable by the factors that are given, or greatest tension over breaking
    /// force: with all cables, each of them broken alone, and in the weather.
    pub utilization: Option<f64>,
    /// The number of this cable, from 1.
    pub utilization_cable: Option<usize>,
    /// `intact`, `weather`, or the number of the broken cable.
    pub utilization_case: Option<String>,
    /// How far the platform moves after the break that moves it farthest.
    pub break_moved_mm: Option<f64>,
    /// The number of the cable that breaks then.
    pub break_cable: Option<String>,
    /// Why the utilization of a case is not known, in words.
    pub break_reason: Option<String>,
}

impl WorkspaceRow {
    /// Whether two cables touch or cross there, or a cable meets the platform, as far as distances are known.
    pub fn is_crossed(&self) -> bool {
        [self.nearest_cables_mm, self.nearest_to_platform_mm].into_iter().flatten().any(|near| near < 0.0)
    }

    /// The row of a pose and its result.
    pub fn new(workspace: &Workspace, pose: &WorkspacePose) -> Self {
        let [moved, azimuth, least, greatest] = in_weather(pose);
        let breaks = pose.breaks.as_deref().and_then(|breaks| breaks.as_ref().ok());
        let most = breaks.and_then(|breaks| breaks.utilization.as_ref());
        let farthest = breaks.and_then(|breaks| breaks.farthest.as_ref());
        Self {
            weather_moved_mm: moved,
            weather_azimuth_deg: azimuth,
            weather_least_tension_n: least,
            weather_greatest_tension_n: greatest,
            weather_reason: pose.weather.as_deref().and_then(wrong_in_weather),
            utilization: most.map(|(most, _)| most.value()),
            utilization_cable: most.map(|(most, _)| most.cable + 1),
            utilization_case: most.map(|(_, situation)| case_name(situation)),
            break_moved_mm: farthest.map(|(moved, _)| 1e3 * moved),
            break_cable: farthest.map(|(_, cables)| joined(cables)),
            break_reason: pose.breaks.as_deref().and_then(open_after_breaks),
            ..Self::in_calm(workspace, pose)
        }
    }

    /// The row without what weather and breaks make of the pose.
    fn in_calm(workspace: &Workspace, pose: &WorkspacePose) -> Self {
        let [x, y, z] = pose.pose.position.into();
        let held = pose.outcome.as_ref().ok();
        let loaded = held.filter(|_| workspace.load != Load::none());
        let displacement = loaded.map(|held| 1e3 * held.displacement);
        let dominant = held.and_then(|held| held.dominant);
        let overflow = dominant.is_some_and(|dominant| !dominant.std.is_finite());
        let dominant = dominant.filter(|_| !overflow);
        let swing = held.and_then(|held| held.swing);
        let recomputed = pose.recomputed.as_ref();
        let tensions = recomputed.and_then(|recomputed| recomputed.as_ref().ok());
        let value = |of: FigureOf| {
            let figure = of(pose.capacity.as_deref()?).as_ref().ok()?;
            Some(figure.value).filter(|value| value.is_finite())
        };
        let clearance = pose.clearance.as_deref().and_then(|clearance| clearance.as_ref().ok());
        let (cables, platform) = (clearance.and_then(|c| c.cables), clearance.and_then(|c| c.platform));
        let tilt = pose.tilt.as_deref().and_then(|tilt| tilt.as_ref().ok()?.least());
        let shaken = pose.shaken.as_deref();
        let shaken_by = shaken.and_then(|shaken| shaken.as_ref().ok());
        let (status, reason) = match &pose.outcome {
            Ok(held) if held.is_within_limits() => (HELD, overflow.then(|| OVERFLOW.to_owned())),
            Ok(held) => (BEYOND_LIMITS, Some(in_words(&held.out_of_limits).join("; "))),
            Err(error) => said(error),
        };
        let again = recomputed.map(|recomputed| match recomputed {
            Ok(within) if within.out_of_limits.is_empty() => (HELD, None),
            Ok(beyond) => (BEYOND_LIMITS, Some(in_words(&beyond.out_of_limits).join("; "))),
            Err(error) => said(error),
        });
        let name = |dominant: Dominant| Some(workspace.tolerances?.inputs.get(dominant.input)?.name.clone());
        Self {
            x_m: x,
            y_m: y,
            z_m: z,
            status,
            least_tension_n: held.map(|held| held.least_tension),
            greatest_tension_n: held.map(|held| held.greatest_tension),
            dx_mm: displacement.map(|dp| dp.x),
            dy_mm: displacement.map(|dp| dp.y),
            dz_mm: displacement.map(|dp| dp.z),
            magnitude_mm: displacement.map(|dp| dp.norm()),
            least_stiffness_n_per_m: held.map(|held| held.least_stiffness),
            platform_frequency_hz: swing.map(|swing| swing.platform),
            platform_share: swing.map(|swing| swing.platform_share),
            lowest_frequency_hz: swing.map(|swing| swing.lowest),
            slack_cables: held
                .map(|held| held.slack.iter().map(|i| (i + 1).to_string()).collect::<Vec<_>>().join(" ")),
            out_of_limits: held
                .filter(|held| !held.out_of_limits.is_empty())
                .map(|held| in_words(&held.out_of_limits).join("; ")),
            dominant: dominant.and_then(name),
            dominant_share: dominant.map(|dominant| dominant.share),
            std_mm: dominant.map(|dominant| 1e3 * dominant.std),
            reason,
            recomputed_status: again.as_ref().map(|(status, _)| *status),
            recomputed_least_tension_n: tensions.map(|recomputed| recomputed.least_tension),
            recomputed_greatest_tension_n: tensions.map(|recomputed| recomputed.greatest_tension),
            recomputed_reason: again.and_then(|(_, reason)| reason),
            payload_recomputed_kg: value(|capacity| &capacity.payload_recomputed),
            payload_recomputed_blocked_by: blocked_by(pose, |capacity| &capacity.payload_recomputed),
            payload_kept_kg: value(|capacity| &capacity.payload_kept),
            payload_kept_blocked_by: blocked_by(pose, |capacity| &capacity.payload_kept),
            margin_recomputed_n: value(|capacity| &capacity.margin_recomputed),
            margin_kept_n: value(|capacity| &capacity.margin_kept),
            nearest_cables_mm: cables.map(|near| 1e3 * near.distance),
            nearest_cables: cables.map(|CableDistance { pair: [i, j], .. }| format!("{} {}", i + 1, j + 1)),
            nearest_to_platform_mm: platform.map(|near| 1e3 * near.distance),
            nearest_to_platform: platform.map(|near| near.cable + 1),
            tilt_deg: tilt.map(|tilt| tilt.angle.to_degrees()),
            tilt_azimuth_deg: tilt.map(|tilt| tilt.azimuth.to_degrees()),
            amplitude_mm_per_n: shaken_by.map(|of| 1e3 * of.per_force.amplitude),
            amplitude_at_hz: shaken_by.map(|of| of.per_force.frequency),
            winch_mm_per_mm: shaken_by.map(|of| of.per_shortening.amplitude),
            winch_at_hz: shaken_by.map(|of| of.per_shortening.frequency),
            winch: shaken_by.map(|of| of.winch + 1),
            amplitude_reason: shaken.and_then(|of| of.as_ref().err().map(ToString::to_string)),
            ..Self::default()
        }
    }
}

/// The status of a failure, and why.
fn said(error: &StaticsError) -> (&'static str, Option<String>) {
    (error.kind(), Some(error.to_string()))
}

/// One figure of a capacity.
type FigureOf = fn(&Capacity) -> &Result<Figure, StaticsError>;

/// What blocks a payload, in words, or why no payload is found. At a pose that is not held, `reason` says
/// why.
fn blocked_by(pose: &WorkspacePose, of: FigureOf) -> Option<String> {
    match of(pose.capacity.as_deref()?) {
        Ok(figure) if figure.value == f64::NEG_INFINITY => {
            Some(format!("even without a payload {}", figure.blocked_by()))
        }
        Ok(figure) => Some(figure.blocked_by()),
        Err(error) => {
            let is_said = pose.outcome.as_ref().is_err_and(|own| own.kind() == error.kind());
            (!is_said).then(|| error.to_string())
        }
    }
}

/// Displacement [mm] and azimuth [deg] in the worst wind, least and greatest tension in any.
fn in_weather(pose: &WorkspacePose) -> [Option<f64>; 4] {
    let Some(Ok(winds)) = pose.weather.as_deref() else { return [None; 4] };
    let worst = winds.farthest();
    [
        worst.map(|worst| 1e3 * worst.moved()),
        worst.and_then(|worst| Some(worst.azimuth?.to_degrees().rem_euclid(360.0))),
        winds.least_tension(),
        winds.tightest().map(|tightest| tightest.greatest_tension().0),
    ]
}

/// What is wrong at a position in weather.
fn wrong_in_weather(weather: &Result<Winds, StaticsError>) -> Option<String> {
    let winds = match weather {
        Err(error) => return Some(error.to_string()),
        Ok(winds) => winds,
    };
    let towards = |azimuth: Option<f64>| match azimuth {
        Some(azimuth) => format!("wind towards {:.0} degrees: ", azimuth.to_degrees().rem_euclid(360.0)),
        None => String::new(),
    };
    let failed = winds.failures.first().map(|(azimuth, error)| format!("{}{error}", towards(*azimuth)));
    failed.or_else(|| {
        let beyond = winds.rests.iter().filter_map(|one| Some((one.azimuth, one.gravest()?)));
        let (azimuth, gravest) = beyond.min_by_key(|(_, gravest)| gravest.limit)?;
        Some(format!("{}{gravest}", towards(azimuth)))
    })
}

/// Numbers of cables (from 0), from 1 with `+` between them.
fn joined(cables: &[usize]) -> String {
    cables.iter().map(|i| (i + 1).to_string()).collect::<Vec<_>>().join("+")
}

/// A case in one cell.
fn case_name(situation: &Situation) -> String {
    match situation {
        Situation::Intact => "intact".to_owned(),
        Situation::Weather(_) => "weather".to_owned(),
        Situation::Broken(cables) => joined(cables),
    }
}

/// Why a utilization is not known.
fn open_after_breaks(breaks: &Result<AfterBreaks, StaticsError>) -> Option<String> {
    match breaks {
        Ok(breaks) => breaks.open.clone(),
        Err(error) => Some(error.to_string()),
    }
}

/// Why a position that is held has no standard deviation.
const OVERFLOW: &str = "the variance by the tolerances is too large a number: std_mm is left out";

/// Values of all rows as one array for each; those that exist nowhere are left out.
pub(super) fn columns<S: Serializer>(rows: &[WorkspaceRow], serializer: S) -> Result<S::Ok, S::Error> {
    let mut columns = serializer.serialize_map(None)?;
    // The pattern has all fields, or the compiler refuses it.
    macro_rules! columns {
        ($($always:ident),+; $($existing:ident),+ $(,)?) => {
            let _complete = |WorkspaceRow { $($always: _,)+ $($existing: _,)+ }: &WorkspaceRow| ();
            $(
                let column = Column(rows, |row: &WorkspaceRow| row.$always);
                columns.serialize_entry(stringify!($always), &column)?;
            )+
            $(
                if rows.iter().any(|row| row.$existing.is_some()) {
                    let column = Column(rows, |row: &WorkspaceRow| row.$existing.clone());
                    columns.serialize_entry(stringify!($existing), &column)?;
                }
            )+
        };
    }
    columns!(
        x_m, y_m, z_m, status;
        least_tension_n,
        greatest_tension_n,
        dx_mm,
        dy_mm,
        dz_mm,
        magnitude_mm,
        least_stiffness_n_per_m,
        platform_frequency_hz,
        platform_share,
        lowest_frequency_hz,
        slack_cables,
        out_of_limits,
        dominant,
        dominant_share,
        std_mm,
        reason,
        recomputed_status,
        recomputed_least_tension_n,
        recomputed_greatest_tension_n,
        recomputed_reason,
        payload_recomputed_kg,
        payload_recomputed_blocked_by,
        payload_kept_kg,
        payload_kept_blocked_by,
        margin_recomputed_n,
        margin_kept_n,
        nearest_cables_mm,
        nearest_cables,
        nearest_to_platform_mm,
        nearest_to_platform,
        tilt_deg,
        tilt_azimuth_deg,
        amplitude_mm_per_n,
        amplitude_at_hz,
        winch_mm_per_mm,
        winch_at_hz,
        winch,
        amplitude_reason,
        weather_moved_mm,
        weather_azimuth_deg,
        weather_least_tension_n,
        weather_greatest_tension_n,
        weather_reason,
        utilization,
        utilization_cable,
        utilization_case,
        break_moved_mm,
        break_cable,
        break_reason
    );
    columns.end()
}

/// One value of all rows.
struct Column<'a, F>(&'a [WorkspaceRow], F);

impl<T: Serialize, F: Fn(&WorkspaceRow) -> T> Serialize for Column<'_, F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.iter().map(&self.1))
    }
}
