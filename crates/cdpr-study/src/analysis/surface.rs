//! Surfaces: the output over a grid of two parameters.

use crate::analysis::verdict::{PartVerdict, number, of_failed, subject};
use crate::file::output::Output;
use crate::model::nominal::too_much;
use crate::model::observed::count_failed;
use crate::model::study::{Surface, SurfaceAxis};
use cdpr_robot::{Deviations, ParameterLayout};
use cdpr_statics::StaticsError;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The output over a grid. `E` says why a point has none: the error itself, or its kind as read back from
/// a table.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceResult<E = StaticsError> {
    /// Values of the first parameter (nominal value plus deviation), in its SI unit.
    pub x: Vec<f64>,
    /// Values of the second parameter.
    pub y: Vec<f64>,
    /// Output in its unit at `x[i], y[j]`, with index `i * y.len() + j`, or the reason of a failure.
    pub values: Vec<Result<f64, E>>,
}

/// Results of one surface; serialized into `summary.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurfaceSummary {
    /// Title.
    pub title: String,
    /// The answer in words.
    pub verdict: PartVerdict,
    /// What is observed.
    #[serde(default, skip_serializing_if = "crate::file::is_default")]
    pub output: Output,
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
    /// Extremes of the output and its nominal value.
    #[serde(rename = "magnitude_mm")]
    pub values: SurfaceValues,
    /// Tensions of the nominal robot above their limits or breaking forces, without or with the payload.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub out_of_limits: Vec<String>,
}

/// Extremes of the output over a surface; absent where no point succeeded.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurfaceValues {
    /// Least value.
    pub min: Option<f64>,
    /// Greatest value.
    pub max: Option<f64>,
    /// Value of the nominal robot.
    pub nominal: f64,
}

/// Runs a surface in parallel; `tick` is called with the number of further points that are done.
pub fn compute_surface(surface: &Surface, tick: &(dyn Fn(usize) + Sync)) -> SurfaceResult {
    let (layout, Surface { x, y, .. }) = (ParameterLayout::of(surface.robot), surface);
    let values = x
        .deviations
        .par_iter()
        .flat_map_iter(|along_x| {
            let mut deviations = Deviations::zeros(&layout, y.deviations.len());
            for (row, along_y) in deviations.rows_mut().zip(&y.deviations) {
                row[x.index] += along_x;
                row[y.index] += along_y;
            }
            tick(deviations.count());
            let outcomes = surface.observer.observe(&deviations).into_iter();
            outcomes.map(|outcome| outcome.map(|measured| measured.value()))
        })
        .collect();
    let of_axis = |axis: &SurfaceAxis| {
        axis.deviations.iter().map(|deviation| axis.parameter.nominal(surface.robot) + deviation).collect()
    };
    SurfaceResult { x: of_axis(x), y: of_axis(y), values }
}

impl SurfaceResult {
    /// The result with the kind of each failure, as a table has it.
    pub fn by_kind(self) -> SurfaceResult<String> {
        let Self { x, y, values } = self;
        let values = values.into_iter().map(|value| value.map_err(|error| error.kind().to_owned())).collect();
        SurfaceResult { x, y, values }
    }
}

impl SurfaceSummary {
    /// Summarizes a surface.
    pub fn new(surface: &Surface, result: &SurfaceResult) -> Self {
        let succeeded = || result.values.iter().filter_map(|value| value.as_ref().ok().copied());
        let failed = count_failed(
            result.values.iter().filter_map(|value| value.as_ref().err()).map(StaticsError::kind),
        );
        let parameters = [&surface.x, &surface.y].map(|axis| axis.parameter.to_string());
        let values = SurfaceValues {
            min: succeeded().reduce(f64::min),
            max: succeeded().reduce(f64::max),
            nominal: surface.nominal_value,
        };
        Self {
            title: surface.title.to_owned(),
            verdict: values.verdict(surface.output, &parameters, &failed, result.values.len()),
            output: surface.output,
            pose: surface.pose.position.into(),
            quaternion: surface.pose.quaternion(),
            observations: result.values.len(),
            failed,
            parameters,
            values,
            out_of_limits: too_much(surface.robot, &surface.nominal),
        }
    }
}

impl SurfaceValues {
    fn verdict(
        &self,
        output: Output,
        [x, y]: &[String; 2],
        failed: &BTreeMap<String, usize>,
        points: usize,
    ) -> PartVerdict {
        let (subject, unit, nominal) = (subject(output), output.unit(), number(self.nominal));
        let mut sentences = vec![match self.min.zip(self.max) {
            Some((min, max)) => {
                let [min, max] = [min, max].map(number);
                format!("{subject} over {x} and {y}: {min} to {max} {unit}, nominal {nominal} {unit}.")
            }
            None => format!("{subject} over {x} and {y}: no point succeeded, nominal {nominal} {unit}."),
        }];
        sentences.extend(of_failed(failed, points));
        PartVerdict { sentences, recommendation: None }
    }
}
