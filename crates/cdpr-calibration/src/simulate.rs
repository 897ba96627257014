//! Synthetic campaigns: what the sensors of a robot with known deviations would read.

use crate::campaign::{Noise, Quantity, Reading, Row};
use crate::error::CalibrationError;
use crate::model::{Model, RowAt, RowState, Shared};
use crate::sensor_error::{SensorError, check_each_once};
use crate::unknowns::Unknowns;
use cdpr_robot::{Axis, CableEnd, Coordinate, Pose, Pulley, Robot, Rotation3, Vector3};
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

/// Deviations of all parameters drawn from the laws of an error model, in their steps.
pub fn drawn(model: &ErrorModel, seed: u64) -> Vec<f64> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(u64::MAX);
    let draw = |input: &cdpr_sensitivity::Input| input.value(random.random_range(1e-9..1.0 - 1e-9));
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
    let (unknowns, shared) = sensors(of);
    let model = Model::new(of.nominal, &unknowns, &[]);
    let mut random = ChaCha8Rng::seed_from_u64(of.seed);
    random.set_stream(k as u64);
    let mut draw = || -> f64 { random.sample(StandardNormal) };

    let exact = model.readings(lengths, &shared.x);
    let std = of.noise.length.unwrap_or(0.0);
    let mut row = Row::new(k + 1, of.load);
    row.lengths = Some(exact.iter().map(|length| length + std * draw()).collect());
    row.length_std = vec![std; if std > 0.0 { lengths.len() } else { 0 }];
    let quantities = quantities(of);
    let reading =
        |(quantity, std): &(_, Option<f64>)| Some(Reading { quantity: *quantity, value: 0.0, std: (*std)? });
    row.readings = quantities.iter().filter_map(reading).collect();

    let state = RowState::new(exact, loaded, of.noise.displacement.map(|_| unloaded));
    let at = RowAt { row: &row, shared: &shared, robot: truth };
    let observed = model.observed(&at, &state)?;
    let mut turn = Vector3::zeros();
    let mut readings = Vec::with_capacity(row.readings.len());
    for (quantity, std) in quantities {
        // The noise of a sensor that is not there is drawn, too.
        let noise = draw();
        let Some(std) = std else { continue };
        let value = match quantity {
            Quantity::Rotation(axis) => {
                turn[axis.index()] = std * noise;
                0.0
            }
            _ => observed.read(quantity).value + std * noise,
        };
        readings.push(Reading { quantity, value, std });
    }
    let rotation = Rotation3::new(turn) * shared.frame * state.pose().rotation;
    Ok(Row { readings, rotation: of.noise.rotation.map(|_| rotation), ..row })
}

/// Everything that is read besides lengths, with the standard deviation of its noise; `None` for a sensor
/// that is not there. Swivel angles are those of pulleys with a vertical axis.
fn quantities(of: &Simulated) -> Vec<(Quantity, Option<f64>)> {
    let Noise { position, rotation, displacement, marker, tension, swivel, .. } = of.noise;
    let vector = |quantity: &dyn Fn(Axis) -> Quantity, std| Axis::ALL.map(|axis| (quantity(axis), std));
    let mut all = vector(&Quantity::Position, position).to_vec();
    all.extend(rotation.iter().flat_map(|std| vector(&Quantity::Rotation, Some(*std))));
    let marker = marker.or(position);
    all.extend((0..of.markers.len()).flat_map(|m| vector(&|axis| Quantity::Marker(m, axis), marker)));
    all.extend(displacement.iter().flat_map(|std| vector(&Quantity::Displacement, Some(*std))));
    let cables = of.nominal.cables.iter().enumerate();
    all.extend(cables.clone().map(|(i, _)| (Quantity::Tension(i, of.tension_at), tension)));
    let is_upright = |pulley: &Pulley| pulley.axis.xy().norm() == 0.0;
    let upright = cables.filter(|(_, cable)| cable.pulley.as_ref().is_some_and(is_upright));
    all.extend(upright.map(|(i, _)| (Quantity::Swivel(i), swivel)));
    all
}

/// The errors of the sensors as unknowns, with their numbers.
fn sensors(of: &Simulated) -> (Unknowns, Shared) {
    let mut unknowns = Unknowns::none();
    unknowns.set_markers(of.markers.to_vec());
    let mut x = Vec::new();
    for (error, numbers) in of.errors {
        unknowns.add(of.nominal, *error, None, of.markers.len());
        x.extend(numbers);
        x.resize(unknowns.all.len(), 0.0);
    }
    let turn = |first: usize| Rotation3::new(Vector3::new(x[first + 3], x[first + 4], x[first + 5]));
    let frame = unknowns.sensor(SensorError::Frame).map_or_else(Rotation3::identity, turn);
    (unknowns, Shared { x, frame, origin: Vector3::zeros() })
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
