//! Surfaces: the deflection over a grid of two parameters.

use crate::model::nominal::too_much;
use crate::model::observed::{count_failed, rms_mm};
use crate::model::study::{Surface, SurfaceAxis};
use cdpr_robot::Parameter;
use cdpr_statics::StaticsError;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The deflection over a grid. `E` says why a point has none: the error itself, or its kind as read back from
/// a table.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceResult<E = StaticsError> {
    /// Values of the first parameter (nominal value plus deviation), in its SI unit.
    pub x: Vec<f64>,
    /// Values of the second parameter.
    pub y: Vec<f64>,
    /// RMS [mm] at `x[i], y[j]`, with index `i * y.len() + j`, or the reason of a failure.
    pub rms_mm: Vec<Result<f64, E>>,
}

/// Results of one surface; serialised into `summary.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurfaceSummary {
    /// Title.
    pub title: String,
    /// Position of the wanted pose [m].
    pub pose: [f64; 3],
    /// Its rotation as a unit quaternion (w, x, y, z), w >= 0.
    pub quaternion: [f64; 4],
    /// Points of the grid.
    pub observations: usize,
    /// Failed points by kind.
    pub failed: BTreeMap<String, usize>,
    /// Parameters of the two axes.
    pub parameters: [String; 2],
    /// Extremes of the RMS and its nominal value [mm].
    pub rms_mm: SurfaceRms,
    /// Tensions of the nominal robot above their limits or breaking forces, without or with the payload.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub out_of_limits: Vec<String>,
}

/// Extremes of the RMS over a surface [mm]; absent where no point succeeded.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurfaceRms {
    /// Least value.
    pub min: Option<f64>,
    /// Greatest value.
    pub max: Option<f64>,
    /// Value of the nominal robot.
    pub nominal: f64,
}

/// Runs a surface in parallel; `tick` is called with the number of further points that are done.
pub fn compute_surface(surface: &Surface, tick: &(dyn Fn(usize) + Sync)) -> SurfaceResult {
    let parameters = Parameter::of(surface.robot).len();
    let Surface { x, y, .. } = surface;
    let columns = y.deviations.len();
    let rms_mm = (0..x.deviations.len() * columns)
        .into_par_iter()
        .fold_chunks(columns, Vec::new, |mut rows, k| {
            let first = rows.len();
            rows.resize(first + parameters, 0.0);
            rows[first + x.index] += x.deviations[k / columns];
            rows[first + y.index] += y.deviations[k % columns];
            rows
        })
        .flat_map_iter(|rows| {
            tick(columns);
            let outcomes = surface.observer.observe_all(&rows).into_iter();
            outcomes.map(|outcome| outcome.map(|observation| rms_mm(observation.rms())))
        })
        .collect();
    let values = |axis: &SurfaceAxis| {
        axis.deviations.iter().map(|deviation| axis.parameter.nominal(surface.robot) + deviation).collect()
    };
    SurfaceResult { x: values(x), y: values(y), rms_mm }
}

impl SurfaceResult {
    /// The result with the kind of each failure, as a table has it.
    pub fn by_kind(self) -> SurfaceResult<String> {
        let Self { x, y, rms_mm } = self;
        let rms_mm = rms_mm.into_iter().map(|rms| rms.map_err(|error| error.kind().to_owned())).collect();
        SurfaceResult { x, y, rms_mm }
    }
}

impl SurfaceSummary {
    /// Summarises a surface.
    pub fn new(surface: &Surface, result: &SurfaceResult) -> Self {
        let succeeded = || result.rms_mm.iter().filter_map(|rms| rms.as_ref().ok().copied());
        let failed =
            count_failed(result.rms_mm.iter().filter_map(|rms| rms.as_ref().err()).map(StaticsError::kind));
        Self {
            title: surface.title.to_owned(),
            pose: surface.pose.position.into(),
            quaternion: surface.pose.quaternion(),
            observations: result.rms_mm.len(),
            failed,
            parameters: [&surface.x, &surface.y].map(|axis| axis.parameter.to_string()),
            rms_mm: SurfaceRms {
                min: succeeded().reduce(f64::min),
                max: succeeded().reduce(f64::max),
                nominal: 1e3 * surface.nominal.rms(),
            },
            out_of_limits: too_much(surface.robot, &surface.nominal),
        }
    }
}
