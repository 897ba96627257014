//! Tilts of pulleys: derivatives about the axes of the robot that deviates, and of the nominal one.

use crate::model::Model;
use cdpr_robot::{Parameter, Pulley, Robot, Rotation3, TiltAxis, Vector3};
use cdpr_statics::derivatives::ForceDerivatives;
use nalgebra::{Dim, Dyn, Matrix, StorageMut};

impl Model<'_> {
    /// Replaces the derivatives by the tilts of the deviating robot, about its own axes, by those about the
    /// axes of the nominal robot, in its order.
    pub(super) fn turn_tilts(&self, robot: &Robot, slopes: &mut ForceDerivatives) {
        for (i, cable) in self.robot.cables.iter().enumerate() {
            let (Some(nominal), Some(now)) = (&cable.pulley, &robot.cables[i].pulley) else { continue };
            let [first, second] = TiltAxis::ALL.map(|axis| self.layout.index(Parameter::Tilt(i, axis)));
            let (Some(first), Some(second)) = (first, second) else { continue };
            let k = now.axis.normalize();
            let own = TiltAxis::ALL.map(|axis| axis.of(now).cross(&k));
            let turns = tilt_axes(nominal, now).map(|axis| own.map(|own| axis.cross(&k).dot(&own)));
            combine([first, second], turns, &mut slopes.per_input);
            combine([first, second], turns, &mut slopes.pose);
        }
    }
}

/// Replaces two columns by combinations of them with these weights.
fn combine<R: Dim, S: StorageMut<f64, R, Dyn>>(
    columns: [usize; 2],
    weights: [[f64; 2]; 2],
    matrix: &mut Matrix<f64, R, Dyn, S>,
) {
    for mut row in matrix.row_iter_mut() {
        let [one, two] = columns.map(|column| row[column]);
        for (column, weight) in columns.into_iter().zip(weights) {
            row[column] = one * weight[0] + two * weight[1];
        }
    }
}

/// The axes about which further tilts turn the swivel axis k of a pulley: k = exp(v τ_v) exp(u τ_u) k_0, so
/// that the second turn turns the axis of the first.
fn tilt_axes(nominal: &Pulley, now: &Pulley) -> [Vector3<f64>; 2] {
    let [u, v] = TiltAxis::ALL.map(|axis| axis.of(nominal));
    let across = |pulley: &Pulley| {
        let k = pulley.axis.normalize();
        k - v * k.dot(&v)
    };
    let (from, to) = (across(nominal), across(now));
    let angle = v.dot(&from.cross(&to)).atan2(from.dot(&to));
    [Rotation3::from_scaled_axis(v * angle) * u, v]
}
