//! Synthetic campaigns: what the sensors of a robot with known deviations would read.

use crate::campaign::{Noise, Quantity, Reading, Row};
use crate::error::CalibrationError;
use crate::sensor_error::{SensorError, check_each_once};
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
        // The winches are set without the load.
        let Ok(commanded) = free_solutions(of.nominal, WantedPose::at(wanted).free(of.free), &Load::none())
        else {
            continue;
        };
        rows.push(measured(of, &truth, k, &commanded.first).map_err(CalibrationError::row(k + 1))?);
    }
    Ok(rows)
}

/// What the sensors read of the true robot with the lengths that are commanded for pose `k`.
fn measured(of: &Simulated, truth: &Robot, k: usize, commanded: &FreeSolution) -> Result<Row, StaticsError> {
    let lengths = &commanded.lengths[..];
    let [unloaded, loaded] =
        rests(truth, lengths, &commanded.equilibrium.pose, &of.load)?.map(|found| found.equilibrium);
    let mut random = ChaCha8Rng::seed_from_u64(of.seed);
    random.set_stream(k as u64);
    let mut sensors = Sensors { of, random, row: Row::new(k + 1, of.load) };
    sensors.read_lengths(lengths);
    sensors.read_pose(&loaded.pose);
    sensors.read_displacement(&(loaded.pose.position - unloaded.pose.position));
    let problem = DirectProblem::new(truth, lengths, &of.load)?;
    let forces_at = |end| problem.force_derivatives(&loaded, end).map(|found| found.forces);
    sensors.read_tensions(&forces_at(of.tension_at)?);
    sensors.read_swivels(&forces_at(CableEnd::Exit)?);
    Ok(sensors.row)
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

/// The sensors at one pose, with their errors and noise, and what they have read so far.
struct Sensors<'a> {
    of: &'a Simulated<'a>,
    random: ChaCha8Rng,
    row: Row,
}

impl Sensors<'_> {
    /// The number `k` of an error of the sensors.
    fn error(&self, error: SensorError, k: usize) -> f64 {
        let found = self.of.errors.iter().find(|(own, _)| *own == error);
        found.and_then(|(_, numbers)| numbers.get(k)).copied().unwrap_or(0.0)
    }

    fn triple(&self, error: SensorError, first: usize) -> Vector3<f64> {
        Vector3::from([0, 1, 2].map(|k| self.error(error, first + k)))
    }

    fn draw(&mut self) -> f64 {
        self.random.sample(StandardNormal)
    }

    /// Reads a value with noise; the noise of a sensor that is not there is drawn, too.
    fn read(&mut self, quantity: Quantity, value: f64, std: Option<f64>) {
        let noise = self.draw();
        self.row.readings.extend(std.map(|std| Reading { quantity, value: value + std * noise, std }));
    }

    fn read_vector(&mut self, of: impl Fn(Axis) -> Quantity, values: Vector3<f64>, std: Option<f64>) {
        Axis::ALL.iter().for_each(|axis| self.read(of(*axis), values[axis.index()], std));
    }

    fn read_lengths(&mut self, lengths: &[f64]) {
        let std = self.of.noise.length.unwrap_or(0.0);
        let mut read = |(i, length): (usize, &f64)| {
            let scaled = (1.0 + self.error(SensorError::DrumScale, i)) * length;
            scaled + self.error(SensorError::LengthOffset, i) + std * self.draw()
        };
        let lengths = lengths.iter().enumerate().map(&mut read).collect::<Vec<_>>();
        self.row.length_std = vec![std; if std > 0.0 { lengths.len() } else { 0 }];
        self.row.lengths = Some(lengths);
    }

    /// Rotation and scale of a displacement by the tracker.
    fn turned(&self, displacement: Vector3<f64>) -> Vector3<f64> {
        let frame = Rotation3::new(self.triple(SensorError::Frame, 3));
        frame * displacement * (1.0 + self.error(SensorError::FrameScale, 0))
    }

    /// A place as the tracker sees it.
    fn seen(&self, place: Vector3<f64>) -> Vector3<f64> {
        self.turned(place) + self.triple(SensorError::Frame, 0)
    }

    /// Position, orientation and markers.
    fn read_pose(&mut self, pose: &Pose) {
        let of = self.of;
        let position = self.seen(pose.position);
        self.read_vector(Quantity::Position, position, of.noise.position);
        if let Some(std) = of.noise.rotation {
            let turn = Vector3::new(self.draw(), self.draw(), self.draw()) * std;
            let frame = Rotation3::new(self.triple(SensorError::Frame, 3));
            self.row.rotation = Some(Rotation3::new(turn) * frame * pose.rotation);
            let zero = |axis| Reading { quantity: Quantity::Rotation(axis), value: 0.0, std };
            self.row.readings.extend(Axis::ALL.map(zero));
        }
        for (m, marker) in of.markers.iter().enumerate() {
            let place = marker + self.triple(SensorError::Markers, 3 * m);
            let place = self.seen(pose.position + pose.rotation * place);
            let std = of.noise.marker.or(of.noise.position);
            self.read_vector(|axis| Quantity::Marker(m, axis), place, std);
        }
    }

    fn read_displacement(&mut self, moved: &Vector3<f64>) {
        let std = self.of.noise.displacement;
        if std.is_some() {
            self.read_vector(Quantity::Displacement, self.turned(*moved), std);
        }
    }

    /// Tensions by the forces where the load cells sit.
    fn read_tensions(&mut self, forces: &[Vector3<f64>]) {
        for (i, force) in forces.iter().enumerate() {
            let gain = 1.0 + self.error(SensorError::TensionGain, i);
            let value = gain * force.norm() + self.error(SensorError::TensionBias, i);
            self.read(Quantity::Tension(i, self.of.tension_at), value, self.of.noise.tension);
        }
    }

    /// Swivel angles of pulleys with a vertical axis by the forces at their leave points.
    fn read_swivels(&mut self, forces: &[Vector3<f64>]) {
        for (i, force) in forces.iter().enumerate() {
            let pulley = self.of.nominal.cables[i].pulley;
            if let Some(pulley) = pulley.filter(|pulley| pulley.axis.xy().norm() == 0.0) {
                let [u, v] = TiltAxis::ALL.map(|axis| axis.of(&pulley).dot(force));
                let value = v.atan2(u) + self.error(SensorError::SwivelOffset, i);
                self.read(Quantity::Swivel(i), value, self.of.noise.swivel);
            }
        }
    }
}
