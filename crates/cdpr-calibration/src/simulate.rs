//! Synthetic campaigns: what the sensors of a robot with known deviations would read.

use crate::campaign::{Noise, Quantity, Reading, Row};
use crate::error::CalibrationError;
use cdpr_robot::{Axis, CableEnd, Coordinate, Pose, Robot, Rotation3, TiltAxis, Vector3};
use cdpr_statics::{DirectProblem, FreeSolution, Load, Start, inverse_free};
use cdpr_study::ErrorModel;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

/// What a synthetic campaign measures. Every kind of sensor with noise is there.
#[derive(Clone, Debug, PartialEq)]
pub struct Simulated<'a> {
    /// The robot as its controller knows it: it gives the lengths for the wanted poses.
    pub nominal: &'a Robot,
    /// Deviation of each parameter of the true robot.
    pub deviations: &'a [f64],
    /// Wanted poses.
    pub poses: &'a [Pose],
    /// Coordinates that are found, for a robot with few cables.
    pub free: &'a [Coordinate],
    /// The load on the platform.
    pub load: Load,
    /// Noise of the sensors: a sensor without noise is not there, but for lengths, which are then exact.
    pub noise: Noise,
    /// Markers on the platform, in its frame [m].
    pub markers: &'a [Vector3<f64>],
    /// Seed of the noise.
    pub seed: u64,
}

/// Deviations of all parameters drawn from the laws of an error model.
pub fn drawn(model: &ErrorModel, seed: u64) -> Vec<f64> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(u64::MAX);
    let draw = |input: &cdpr_sensitivity::Input| input.law.quantile(random.random_range(1e-9..1.0 - 1e-9));
    let inputs: Vec<f64> = model.inputs.iter().map(draw).collect();
    model.deviations(&inputs)
}

/// The rows of a campaign, one for each pose that the nominal robot holds.
///
/// # Errors
/// [`CalibrationError::Row`] where the true robot has no equilibrium; [`CalibrationError::Robot`] for
/// deviations that make no robot.
pub fn simulate(of: &Simulated) -> Result<Vec<Row>, CalibrationError> {
    let truth = of.nominal.perturbed(of.deviations)?.robot;
    let mut rows = Vec::new();
    for (k, wanted) in of.poses.iter().enumerate() {
        let at = CalibrationError::row(k + 1);
        // The winches are set without the load.
        let Ok(commanded) = inverse_free(of.nominal, wanted, &Load::none(), of.free) else { continue };
        let FreeSolution { lengths, equilibrium: near, .. } = commanded.first;
        let mut random = ChaCha8Rng::seed_from_u64(of.seed);
        random.set_stream(k as u64);
        let mut draw = || -> f64 { random.sample(StandardNormal) };
        let lengths = &lengths[..];
        let problem = DirectProblem::new(&truth, lengths, &of.load).map_err(&at)?;
        let found = problem.direct(Start::Pose(&near.pose)).map_err(&at)?.equilibrium;
        let mut row = Row::new(k + 1, of.load);
        if let Some(std) = of.noise.length {
            row.lengths = Some(lengths.iter().map(|length| length + std * draw()).collect());
            row.length_std = vec![std; lengths.len()];
        } else {
            row.lengths = Some(lengths.to_vec());
        }
        let mut readings = Vec::new();
        let mut read = |quantity: Quantity, value: f64, std: Option<f64>, noise: f64| {
            readings.extend(std.map(|std| Reading { quantity, value: value + std * noise, std }));
        };
        let pose = found.pose;
        for axis in Axis::ALL {
            read(Quantity::Position(axis), pose.position[axis.index()], of.noise.position, draw());
        }
        if let Some(std) = of.noise.rotation {
            let turn = Vector3::new(draw(), draw(), draw()) * std;
            row.rotation = Some(Rotation3::new(turn) * pose.rotation);
            Axis::ALL.iter().for_each(|axis| read(Quantity::Rotation(*axis), 0.0, Some(std), 0.0));
        }
        for (m, marker) in of.markers.iter().enumerate() {
            let place = pose.position + pose.rotation * marker;
            let std = of.noise.marker.or(of.noise.position);
            for axis in Axis::ALL {
                read(Quantity::Marker(m, axis), place[axis.index()], std, draw());
            }
        }
        if of.noise.displacement.is_some() {
            let rest = DirectProblem::new(&truth, lengths, &Load::none()).map_err(&at)?;
            let rest = rest.direct(Start::Pose(&pose)).map_err(&at)?.equilibrium;
            for axis in Axis::ALL {
                let moved = (pose.position - rest.pose.position)[axis.index()];
                read(Quantity::Displacement(axis), moved, of.noise.displacement, draw());
            }
        }
        for (i, tension) in found.tensions().into_iter().enumerate() {
            read(Quantity::Tension(i, CableEnd::Anchor), tension, of.noise.tension, draw());
        }
        for (i, force) in problem.force_derivatives(&found).map_err(&at)?.forces.iter().enumerate() {
            // The weight of the cable does not turn a pulley with a vertical axis.
            if let Some(pulley) = of.nominal.cables[i].pulley.filter(|pulley| pulley.axis.xy().norm() == 0.0)
            {
                let [u, v] = TiltAxis::ALL.map(|axis| -axis.of(&pulley).dot(force));
                read(Quantity::Swivel(i), v.atan2(u), of.noise.swivel, draw());
            }
        }
        row.readings = readings;
        rows.push(row);
    }
    Ok(rows)
}
