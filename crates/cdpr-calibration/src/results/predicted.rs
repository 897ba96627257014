//! What is left uncertain over the workspace.

use crate::fitted::Fit;
use crate::model::row::held_lengths;
use crate::sensor_error::free_axes;
use cdpr_robot::{Axis, CableEnd, Pose, Robot, Vector3};
use cdpr_statics::{DirectProblem, DirectStart, Load};
use nalgebra::DMatrix;
use rayon::prelude::*;
use serde::ser::{Serialize, SerializeMap, Serializer};

/// Standard deviations of the position over a plane, before and after a calibration: that of a planar robot,
/// else a level one. A file has its coordinates by the names of their axes: lists `x` and `y`, a number `z`.
#[derive(Clone, Debug, PartialEq)]
pub struct UncertaintyMap {
    /// Axes of the columns and of the rows, and the axis at right angles to the plane.
    pub axes: [Axis; 3],
    /// Coordinates of the columns [m].
    pub columns: Vec<f64>,
    /// Coordinates of the rows [m].
    pub rows: Vec<f64>,
    /// Where the plane is along its axis [m]: the mean of the measured poses.
    pub at: f64,
    /// Standard deviation of a coordinate of P with given lengths, before [m], a row after the other; none
    /// without prior, with errors of the winches, and where the level platform is not held.
    pub before: Vec<Option<f64>>,
    /// After [m].
    pub after: Vec<Option<f64>>,
}

impl Serialize for UncertaintyMap {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let [column, row, normal] = self.axes.map(|axis| axis.to_string());
        let mut map = serializer.serialize_map(Some(5))?;
        map.serialize_entry(&column, &self.columns)?;
        map.serialize_entry(&row, &self.rows)?;
        map.serialize_entry(&normal, &self.at)?;
        map.serialize_entry("before", &self.before)?;
        map.serialize_entry("after", &self.after)?;
        map.end()
    }
}

/// Points of the map along each axis.
const POINTS: usize = 9;

/// Mean variance of the free coordinates of P near a pose [m²], with these lengths, for a covariance as that
/// of [`Fit::position_covariance`].
pub(super) fn variance_at(
    robot: &Robot,
    lengths: &[f64],
    pose: &Pose,
    covariance: &DMatrix<f64>,
) -> Option<f64> {
    let problem = DirectProblem::new(robot, lengths, &Load::none()).ok()?;
    let found = problem.direct(DirectStart::Pose(pose)).ok()?;
    let pose = problem.force_derivatives(&found.equilibrium, CableEnd::Anchor).ok()?.pose;
    let n = lengths.len();
    let count = covariance.nrows() - 2 * n;
    let by_lengths = pose.columns(pose.ncols() - n, n);
    let mut slopes = DMatrix::zeros(3, covariance.nrows());
    slopes.columns_mut(0, count).copy_from(&pose.view((0, 0), (3, count)));
    for (i, length) in lengths.iter().enumerate() {
        for k in 0..3 {
            slopes[(k, count + i)] = by_lengths[(k, i)];
            slopes[(k, count + n + i)] = by_lengths[(k, i)] * length;
        }
    }
    let axes = free_axes(robot);
    let variance = |k: &usize| (slopes.row(*k) * covariance * slopes.row(*k).transpose())[0];
    Some((axes.iter().map(variance).sum::<f64>() / axes.len() as f64).max(0.0))
}

/// The map over the box of the measured poses of a fit, for covariances before and after, as that of
/// [`Fit::position_covariance`].
pub(crate) fn uncertainty_map(
    fit: &Fit,
    nominal: &Robot,
    before: Option<&DMatrix<f64>>,
    after: &DMatrix<f64>,
) -> Option<UncertaintyMap> {
    let count = fit.poses.len() as f64;
    let axis = |k: usize| -> Vec<f64> {
        let all = || fit.poses.iter().map(|pose| pose.position[k]);
        let (least, most) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
        (0..POINTS).map(|i| least + (most - least) * i as f64 / (POINTS - 1) as f64).collect()
    };
    let [u, v, w] = match free_axes(nominal)[..] {
        [u, v] => [u, v, 3 - u - v],
        _ => [0, 1, 2],
    };
    let (columns, rows) = (axis(u), axis(v));
    let at = fit.poses.iter().map(|pose| pose.position[w]).sum::<f64>() / count;
    let place = |column: f64, row: f64| {
        let mut position = Vector3::zeros();
        (position[u], position[v], position[w]) = (column, row, at);
        Pose::at(position.x, position.y, position.z)
    };
    let places: Vec<Pose> =
        rows.iter().flat_map(|row| columns.iter().map(move |column| place(*column, *row))).collect();
    let map = |robot: &Robot, covariance: &DMatrix<f64>| -> Vec<Option<f64>> {
        let variance = |pose| variance_at(robot, &held_lengths(robot, pose).ok()?, pose, covariance);
        places.par_iter().map(|pose| variance(pose).map(f64::sqrt)).collect()
    };
    let after = map(&fit.robot, after);
    let before = before.map_or_else(|| vec![None; after.len()], |before| map(nominal, before));
    let axes = [u, v, w].map(|k| Axis::ALL[k]);
    let is_held = after.iter().any(Option::is_some);
    is_held.then_some(UncertaintyMap { axes, columns, rows, at, before, after })
}
