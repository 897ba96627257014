//! The pull of a cable at its leave point.
//!
//! The tension at the exit point and the swivel angle belong to the pull F0 at the leave point. With
//! `F_i` the force of the cable on the platform, the free length Lf, `τ = F0/T0`, the axis k of the pulley,
//! its wrap `π - ψ`, `s = sin ψ`, and arc and lead together of the stretched length a,
//!
//! ```text
//! F0 = -F_i - w Lf up,    Lf = L - a/(1 + ε(T0)),   dF0 = g - w up dLf,   g = -dF_i - Lf dw up     (R2)
//! dLf (1 + w α·up) = β + α·g,       α = [ r (k - τ (τ·k))/(T0 s) + a ε' τ/(1 + ε) ]/(1 + ε)
//! β = dL - [ (π - ψ) dr + dd - r τ·dk/s - a dε/(1 + ε) ]/(1 + ε)
//! ```

use crate::model::Model;
use cdpr_cable::SpatialCable;
use cdpr_robot::{Parameter, Pulley, Robot, Rotation3, TiltAxis, Vector3};
use cdpr_statics::derivatives::ForceDerivatives;
use nalgebra::{DMatrix, RowDVector};

impl Model<'_> {
    /// The pull at the leave point, equation (R2).
    pub(super) fn pull(&self, robot: &Robot, i: usize, lengths: &[f64], slopes: &ForceDerivatives) -> Pull {
        let cable = robot.cable(i);
        // In space: where the axis of a pulley is tilted, the wrap depends on the direction of the cable.
        let level = robot.gravity.level();
        let force = level.map_or(-slopes.forces[i], |level| -(level * slopes.forces[i]));
        let spatial = SpatialCable { cable, unstrained_length: lengths[i], force };
        if spatial.is_limp() {
            // A slack cable without weight pulls nowhere.
            return Pull { force: Vector3::zeros(), slopes: DMatrix::zeros(3, slopes.per_input.ncols()) };
        }
        let (catenary, _) = spatial.in_plane();
        let (g, density) = (robot.gravity.magnitude(), robot.cables[i].properties.linear_density);
        let gravity = robot.gravity.vector();
        let up = gravity.try_normalize(0.0).map_or_else(Vector3::z, |down| -down);
        let (weight, free) = (density * g, catenary.free_length());
        let force = -slopes.forces[i] - up * (weight * free);
        let tension = force.norm();
        let columns = slopes.per_input.ncols();
        let mut pull = DMatrix::zeros(3, columns);
        pull -= slopes.per_input.rows(3 * i, 3);
        let parameters = Parameter::of(robot);
        // g of every column: the weight per length and its direction change, too.
        for (column, parameter) in parameters.iter().enumerate() {
            match *parameter {
                Parameter::LinearDensity => {
                    let mut of = pull.column_mut(column);
                    of -= up * (g * free);
                }
                Parameter::Gravity(axis) => pull[(axis.index(), column)] += density * free,
                _ => {}
            }
        }
        // β of every column.
        let mut beta = RowDVector::zeros(columns);
        beta[columns - lengths.len() + i] = 1.0;
        let mut alpha = Vector3::zeros();
        if let (Some(guide), true) = (cable.guide, tension > 0.0) {
            let tau = force / tension;
            let strain = cable.strain(tension);
            let per_tension = 1.0 / cable.tangent_stiffness(tension);
            let stretched = (lengths[i] - free) * (1.0 + strain);
            let mut over = 0.0;
            if let Some(pulley) = robot.cables[i].pulley.filter(|_| guide.radius > 0.0) {
                let k = pulley.axis.normalize();
                let (c, s) = (-tau.dot(&k), tau.cross(&k).norm());
                let wrap = std::f64::consts::PI - s.atan2(c);
                alpha += (k - tau * tau.dot(&k)) * (guide.radius / (tension * s));
                for (column, parameter) in parameters.iter().enumerate() {
                    match *parameter {
                        Parameter::PulleyRadius(own) if own == i => beta[column] -= wrap / (1.0 + strain),
                        Parameter::Tilt(own, axis) if own == i => {
                            if let Some(nominal) = &self.robot.cables[i].pulley {
                                let turned = tilt_axes(nominal, &pulley)[axis as usize].cross(&k);
                                beta[column] += guide.radius * tau.dot(&turned) / (s * (1.0 + strain));
                            }
                        }
                        _ => {}
                    }
                }
                over = wrap * guide.radius;
            }
            debug_assert!((over + guide.lead - stretched).abs() < 1e-6 * (1.0 + stretched));
            alpha += tau * (stretched * per_tension / (1.0 + strain));
            alpha /= 1.0 + strain;
            for (column, parameter) in parameters.iter().enumerate() {
                match *parameter {
                    Parameter::Lead(own) if own == i => beta[column] -= 1.0 / (1.0 + strain),
                    // In proportion to the modulus, the strain of a tension falls with it.
                    Parameter::YoungsModulus => {
                        let modulus = robot.cables[i].properties.youngs_modulus;
                        beta[column] -=
                            stretched * per_tension * tension / (modulus * (1.0 + strain).powi(2));
                    }
                    _ => {}
                }
            }
        }
        let free_slopes = (beta + alpha.transpose() * &pull) / (1.0 + weight * alpha.dot(&up));
        pull -= up * weight * free_slopes;
        Pull { force, slopes: pull }
    }

    /// Replaces the derivatives by the tilts of the deviating robot, about its own axes, by those about the
    /// axes of the nominal robot, in its order.
    pub(super) fn turn_tilts(&self, robot: &Robot, slopes: &mut ForceDerivatives) {
        for (i, cable) in self.robot.cables.iter().enumerate() {
            let (Some(nominal), Some(now)) = (&cable.pulley, &robot.cables[i].pulley) else { continue };
            let [first, second] = TiltAxis::ALL.map(|axis| self.layout.index(Parameter::Tilt(i, axis)));
            let (Some(first), Some(second)) = (first, second) else { continue };
            let k = now.axis.normalize();
            let own = TiltAxis::ALL.map(|axis| axis.of(now).cross(&k));
            let [a, b] = tilt_axes(nominal, now).map(|axis| own.map(|own| axis.cross(&k).dot(&own)));
            let turn = |matrix: &mut DMatrix<f64>| {
                let (one, two) = (matrix.column(first).into_owned(), matrix.column(second).into_owned());
                matrix.set_column(first, &(&one * a[0] + &two * a[1]));
                matrix.set_column(second, &(&one * b[0] + &two * b[1]));
            };
            turn(&mut slopes.per_input);
            let (one, two) =
                (slopes.pose.column(first).into_owned(), slopes.pose.column(second).into_owned());
            slopes.pose.set_column(first, &(one * a[0] + two * a[1]));
            slopes.pose.set_column(second, &(one * b[0] + two * b[1]));
        }
    }
}

/// The pull of a cable at its leave point, towards the platform.
pub(super) struct Pull {
    pub(super) force: Vector3<f64>,
    /// 3 x columns.
    pub(super) slopes: DMatrix<f64>,
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
