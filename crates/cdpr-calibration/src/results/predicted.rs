//! What is left uncertain over the workspace.

use crate::fitted::Fit;
use crate::model::row::held_lengths;
use cdpr_robot::{Pose, Robot};
use cdpr_statics::{DirectProblem, DirectStart, Load};
use nalgebra::DMatrix;
use rayon::prelude::*;
use serde::Serialize;

/// Standard deviations of the position over a plane, before and after a calibration.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UncertaintyMap {
    /// Coordinates of the columns [m].
    pub x: Vec<f64>,
    /// Coordinates of the rows [m].
    pub y: Vec<f64>,
    /// Height of the plane [m]: the mean of the measured poses.
    pub z: f64,
    /// Standard deviation of a coordinate of P with given lengths, before [m], x fastest; none without prior
    /// and where the level platform is not held.
    pub before: Vec<Option<f64>>,
    /// After [m].
    pub after: Vec<Option<f64>>,
}

/// Points of the map along each axis.
const POINTS: usize = 9;

/// Mean variance of the coordinates of P near a pose [m²], with these lengths.
pub(super) fn variance_at(
    robot: &Robot,
    lengths: &[f64],
    pose: &Pose,
    covariance: &DMatrix<f64>,
) -> Option<f64> {
    let problem = DirectProblem::new(robot, lengths, &Load::none()).ok()?;
    let found = problem.direct(DirectStart::Pose(pose)).ok()?;
    let slopes = problem.derivatives(&found.equilibrium).ok()?.pose;
    let position = slopes.view((0, 0), (3, covariance.nrows()));
    Some(((position * covariance * position.transpose()).trace() / 3.0).max(0.0))
}

/// The map over the box of the measured poses of a fit, for covariances of the parameters before and after.
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
    let (x, y) = (axis(0), axis(1));
    let z = fit.poses.iter().map(|pose| pose.position.z).sum::<f64>() / count;
    let places: Vec<Pose> = y.iter().flat_map(|y| x.iter().map(move |x| Pose::at(*x, *y, z))).collect();
    let map = |robot: &Robot, covariance: &DMatrix<f64>| -> Vec<Option<f64>> {
        let variance = |pose| variance_at(robot, &held_lengths(robot, pose).ok()?, pose, covariance);
        places.par_iter().map(|pose| variance(pose).map(f64::sqrt)).collect()
    };
    let after = map(&fit.robot, after);
    let before = before.map_or_else(|| vec![None; after.len()], |before| map(nominal, before));
    after.iter().any(Option::is_some).then_some(UncertaintyMap { x, y, z, before, after })
}
