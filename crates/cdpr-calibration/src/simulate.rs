//! Synthetic campaigns: what the sensors of a robot with known deviations would read.

use crate::campaign::{Noise, Quantity, Reading, Row};
use crate::error::CalibrationError;
use crate::unknowns::{SensorError, check_each_once};
use cdpr_cable::SpatialCable;
use cdpr_robot::{Axis, CableEnd, Coordinate, Pose, Robot, Rotation3, TiltAxis, Vector3};
use cdpr_statics::continuation::follow_load;
use cdpr_statics::free_coordinates::{FreeSolution, free_solutions};
use cdpr_statics::{DirectProblem, DirectSolution, DirectStart, Load, StaticsError, WantedPose};
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
    /// Markers on the platform, in its frame, where they are thought to stand [m].
    pub markers: &'a [Vector3<f64>],
    /// Errors of the sensors, each with its numbers in the order of [`crate::Unknowns`].
    pub errors: &'a [(SensorError, Vec<f64>)],
    /// Where the load cells sit.
    pub tension_at: CableEnd,
    /// Seed of the noise.
    pub seed: u64,
}

/// Deviations of all parameters drawn from the laws of an error model.
pub fn drawn(model: &ErrorModel, seed: u64) -> Vec<f64> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(u64::MAX);
    let draw = |input: &cdpr_sensitivity::Input| input.law.quantile(random.random_range(1e-9..1.0 - 1e-9));
    let inputs: Vec<f64> = model.inputs.iter().map(draw).collect();
    model.deviations(&inputs).values().to_vec()
}

/// Errors of sensors drawn from normal laws about zero with these standard deviations.
pub fn drawn_errors(
    robot: &Robot,
    errors: &[(SensorError, f64)],
    markers: usize,
    seed: u64,
) -> Vec<(SensorError, Vec<f64>)> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(u64::MAX - 1);
    let mut draw = |(error, std): &(SensorError, f64)| {
        let count = error.names(robot.cables.len(), markers).len();
        (*error, (0..count).map(|_| std * random.sample::<f64, _>(StandardNormal)).collect())
    };
    errors.iter().map(&mut draw).collect()
}

impl Simulated<'_> {
    /// The number `k` of an error of the sensors.
    fn error(&self, error: SensorError, k: usize) -> f64 {
        let found = self.errors.iter().find(|(own, _)| *own == error);
        found.and_then(|(_, numbers)| numbers.get(k)).copied().unwrap_or(0.0)
    }

    fn triple(&self, error: SensorError, first: usize) -> Vector3<f64> {
        Vector3::from([0, 1, 2].map(|k| self.error(error, first + k)))
    }
}

/// The rows of a campaign, one for each pose that the nominal robot holds.
///
/// # Errors
/// [`CalibrationError::Row`] where the true robot has no equilibrium, or loses it on the way to the load;
/// [`CalibrationError::Robot`] for deviations that make no robot.
pub fn simulate(of: &Simulated) -> Result<Vec<Row>, CalibrationError> {
    check_each_once(of.errors.iter().map(|(error, _)| *error))?;
    let truth = of.nominal.perturbed(of.deviations)?.robot;
    let mut rows = Vec::new();
    for (k, wanted) in of.poses.iter().enumerate() {
        let at = CalibrationError::row(k + 1);
        // The winches are set without the load.
        let Ok(commanded) = free_solutions(of.nominal, WantedPose::at(wanted).free(of.free), &Load::none())
        else {
            continue;
        };
        let FreeSolution { lengths, equilibrium: near, .. } = commanded.first;
        let mut random = ChaCha8Rng::seed_from_u64(of.seed);
        random.set_stream(k as u64);
        let mut draw = || -> f64 { random.sample(StandardNormal) };
        let lengths = &lengths[..];
        let [unloaded, loaded] = rests(&truth, lengths, &near.pose, &of.load).map_err(&at)?;
        let found = loaded.equilibrium;
        let read_by = |(i, length): (usize, &f64)| {
            (1.0 + of.error(SensorError::DrumScale, i)) * length + of.error(SensorError::LengthOffset, i)
        };
        let std = of.noise.length.unwrap_or(0.0);
        let mut row = Row::new(k + 1, of.load);
        row.lengths = Some(lengths.iter().enumerate().map(|of| read_by(of) + std * draw()).collect());
        row.length_std = vec![std; if std > 0.0 { lengths.len() } else { 0 }];
        let mut readings = Vec::new();
        let mut read = |quantity: Quantity, value: f64, std: Option<f64>, noise: f64| {
            readings.extend(std.map(|std| Reading { quantity, value: value + std * noise, std }));
        };
        let pose = found.pose;
        let frame = Rotation3::new(of.triple(SensorError::Frame, 3));
        let scale = 1.0 + of.error(SensorError::FrameScale, 0);
        let origin = of.triple(SensorError::Frame, 0);
        let seen = |place: Vector3<f64>| frame * place * scale + origin;
        for axis in Axis::ALL {
            let value = seen(pose.position)[axis.index()];
            read(Quantity::Position(axis), value, of.noise.position, draw());
        }
        if let Some(std) = of.noise.rotation {
            let turn = Vector3::new(draw(), draw(), draw()) * std;
            row.rotation = Some(Rotation3::new(turn) * frame * pose.rotation);
            Axis::ALL.iter().for_each(|axis| read(Quantity::Rotation(*axis), 0.0, Some(std), 0.0));
        }
        for (m, marker) in of.markers.iter().enumerate() {
            let place = marker + of.triple(SensorError::Markers, 3 * m);
            let place = seen(pose.position + pose.rotation * place);
            let std = of.noise.marker.or(of.noise.position);
            for axis in Axis::ALL {
                read(Quantity::Marker(m, axis), place[axis.index()], std, draw());
            }
        }
        if of.noise.displacement.is_some() {
            let moved = seen(pose.position) - seen(unloaded.equilibrium.pose.position);
            for axis in Axis::ALL {
                read(Quantity::Displacement(axis), moved[axis.index()], of.noise.displacement, draw());
            }
        }
        let problem = DirectProblem::new(&truth, lengths, &of.load).map_err(&at)?;
        let forces = problem.force_derivatives(&found).map_err(&at)?.forces;
        let tensions: Vec<f64> = match of.tension_at {
            CableEnd::Anchor => found.tensions(),
            CableEnd::Exit => {
                let level = truth.gravity.level();
                let exit = |(i, force): (usize, &Vector3<f64>)| {
                    let force = level.map_or(-*force, |level| -(level * force));
                    let cable = SpatialCable { cable: truth.cable(i), unstrained_length: lengths[i], force };
                    if cable.is_limp() { 0.0 } else { cable.in_plane().0.exit_tension() }
                };
                forces.iter().enumerate().map(exit).collect()
            }
        };
        for (i, tension) in tensions.into_iter().enumerate() {
            let (gain, bias) = (of.error(SensorError::TensionGain, i), of.error(SensorError::TensionBias, i));
            let value = (1.0 + gain) * tension + bias;
            read(Quantity::Tension(i, of.tension_at), value, of.noise.tension, draw());
        }
        for (i, force) in forces.iter().enumerate() {
            // The weight of the cable does not turn a pulley with a vertical axis.
            if let Some(pulley) = of.nominal.cables[i].pulley.filter(|pulley| pulley.axis.xy().norm() == 0.0)
            {
                let [u, v] = TiltAxis::ALL.map(|axis| -axis.of(&pulley).dot(force));
                let value = v.atan2(u) + of.error(SensorError::SwivelOffset, i);
                read(Quantity::Swivel(i), value, of.noise.swivel, draw());
            }
        }
        row.readings = readings;
        rows.push(row);
    }
    Ok(rows)
}

/// The equilibrium without the load, near a pose, and what it becomes while the load is raised.
fn rests(
    robot: &Robot,
    lengths: &[f64],
    near: &Pose,
    load: &Load,
) -> Result<[DirectSolution; 2], StaticsError> {
    let unloaded = DirectProblem::new(robot, lengths, &Load::none())?.direct(DirectStart::Pose(near))?;
    let loaded = follow_load(robot, lengths, (&Load::none(), &unloaded), load)?;
    Ok([unloaded, loaded])
}
