//! What the sensors would read, and how that depends on the unknowns.
//!
//! The model of a row is the direct model: the robot with its deviations, the lengths that the winches give
//! and the load make the platform rest at a pose, with a force in every cable. With the errors of the sensors
//!
//! ```text
//! L_i = (l_i - o_i - e_i)/(1 + κ_i)               length l read by a winch, offset o, scale κ, noise e  
//! (R1) y   = (1 + σ) Q (p + R m) + q                   place of P (m = 0) or of a marker m, in the tracker's
//! frame t   = (1 + γ_i) |F_i| + β_i                     load cell of cable i
//! ```
//!
//! Where lengths have noise, their errors e are unknowns of the row with the residual e/std. Where lengths
//! are not measured at all, they are unknowns of the row without residual.
//!
//! The tension at the exit point and the swivel angle belong to the pull F0 at the leave point. With
//! `F_i` the force of the cable on the platform, the free length Lf, `τ = F0/T0`, the axis k of the pulley,
//! its wrap `π - ψ`, `s = sin ψ`, and arc and lead together of the stretched length a,
//!
//! ```text
//! F0 = -F_i - w Lf up,    Lf = L - a/(1 + ε(T0)),   dF0 = g - w up dLf,   g = -dF_i - Lf dw up          
//! (R2) dLf (1 + w α·up) = β + α·g,       α = [ r (k - τ (τ·k))/(T0 s) + a ε' τ/(1 + ε) ]/(1 + ε)
//! β = dL - [ (π - ψ) dr + dd - r τ·dk/s - a dε/(1 + ε) ]/(1 + ε)
//! ```

use crate::campaign::{Quantity, Row};
use crate::error::CalibrationError;
use crate::unknowns::{SensorError, Unknowns};
use cdpr_cable::Catenary;
use cdpr_robot::{
    Axis, CableEnd, Coordinate, Matrix6xX, Parameter, ParameterLayout, Pose, Pulley, Robot, Rotation3,
    TiltAxis, UnitQuaternion, Vector3, Vector6,
};
use cdpr_statics::{
    DirectProblem, Equilibrium, ForceDerivatives, Load, Start, StaticsError, inverse, rough_pose,
};
use nalgebra::{DMatrix, DVector, Matrix3, RowDVector};

/// Where the search stands.
#[derive(Clone, Debug)]
pub(crate) struct State {
    /// The unknowns of all rows.
    pub(crate) x: Vec<f64>,
    /// Q: from the base frame to the frame of the tracker.
    pub(crate) frame: Rotation3<f64>,
    /// q where the search began [m].
    pub(crate) origin: Vector3<f64>,
    pub(crate) rows: Vec<RowState>,
}

/// The state of a row.
#[derive(Clone, Debug)]
pub(crate) struct RowState {
    /// Lengths that the winches read or, where they read none, that the search began with [m].
    read: Vec<f64>,
    /// e_i [m]; empty where lengths are exact.
    errors: Vec<f64>,
    loaded: Equilibrium,
    /// Without the load, where a displacement is measured.
    unloaded: Option<Equilibrium>,
}

impl RowState {
    /// The pose under the load.
    pub(crate) fn pose(&self) -> &Pose {
        &self.loaded.pose
    }
}

/// A row at a state: residuals over standard deviations, and their derivatives.
pub(crate) struct Compared {
    pub(crate) quantities: Vec<Quantity>,
    /// Standard deviation of each.
    pub(crate) std: Vec<f64>,
    /// (measured - model)/std.
    pub(crate) residuals: DVector<f64>,
    /// Derivatives by the unknowns of all rows.
    pub(crate) per_unknown: DMatrix<f64>,
    /// Derivatives by the unknowns of the row.
    pub(crate) per_own: DMatrix<f64>,
}

/// The model of a campaign.
pub(crate) struct Model<'a> {
    pub(crate) robot: &'a Robot,
    pub(crate) unknowns: &'a Unknowns,
    layout: ParameterLayout,
}

/// Derivatives of what is read by everything it may depend on.
struct Slopes {
    /// By the inputs of the models and the lengths.
    models: RowDVector<f64>,
    /// By errors of sensors.
    sensors: Vec<(usize, f64)>,
}

impl<'a> Model<'a> {
    pub(crate) fn new(robot: &'a Robot, unknowns: &'a Unknowns) -> Self {
        Self { robot, unknowns, layout: ParameterLayout::of(robot) }
    }

    /// The robot with its deviations.
    pub(crate) fn deviating(&self, x: &[f64]) -> Result<Robot, StaticsError> {
        let deviations = self.unknowns.deviations(self.layout.count(), x);
        Ok(self.robot.perturbed(&deviations)?.robot)
    }

    fn of(&self, error: SensorError, k: usize, x: &[f64]) -> f64 {
        self.unknowns.sensor(error).map_or(0.0, |first| x[first + k])
    }

    fn slope(&self, error: SensorError, k: usize, value: f64) -> Option<(usize, f64)> {
        self.unknowns.sensor(error).map(|first| (first + k, value))
    }

    /// Equation (R1).
    fn lengths(&self, row: &RowState, x: &[f64]) -> Vec<f64> {
        let length = |(i, read): (usize, &f64)| {
            let error = row.errors.get(i).copied().unwrap_or(0.0);
            (read - self.of(SensorError::LengthOffset, i, x) - error)
                / (1.0 + self.of(SensorError::DrumScale, i, x))
        };
        row.read.iter().enumerate().map(length).collect()
    }

    fn load(&self, row: &Row, robot: &Robot) -> Load {
        let payload = row.load.payload + row.mass.map_or(0.0, |mass| mass - robot.platform.mass);
        Load { payload, ..row.load }
    }

    fn without_load(&self, row: &Row, robot: &Robot) -> Load {
        let mass = row.mass.map_or(0.0, |mass| mass - robot.platform.mass);
        Load::payload(mass)
    }

    /// The state of a row where the search begins.
    pub(crate) fn begin(&self, row: &Row, x: &[f64]) -> Result<RowState, CalibrationError> {
        let at = CalibrationError::row(row.line);
        let robot = self.deviating(x).map_err(&at)?;
        let load = self.load(row, &robot);
        let measured = self.measured_pose(row);
        let is_displaced = row.readings.iter().any(|of| matches!(of.quantity, Quantity::Displacement(_)));
        let n = robot.cables.len();
        let (read, errors) = match &row.lengths {
            Some(read) => {
                let noisy = row.length_std.iter().any(|std| *std > 0.0);
                (read.clone(), if noisy { vec![0.0; n] } else { Vec::new() })
            }
            None => {
                let Some(pose) = measured else {
                    let reason = "neither lengths nor a pose are measured: expected one of them";
                    return Err(CalibrationError::Incomplete { line: row.line, reason: reason.to_owned() });
                };
                if row.readings.len() < n {
                    let reason = format!(
                        "{} numbers are measured for {n} lengths that are not: expected the lengths l1_m.., \
                         or more numbers",
                        row.readings.len()
                    );
                    return Err(CalibrationError::Incomplete { line: row.line, reason });
                }
                // The load bears on lengths that were found without it.
                let lengths = inverse(&robot, &pose, &Load::none(), None).map_err(&at)?.lengths;
                (lengths, vec![0.0; n])
            }
        };
        let nowhere = Equilibrium { pose: Pose::at(0.0, 0.0, 0.0), cable_forces: Vec::new() };
        let mut state = RowState { read, errors, loaded: nowhere, unloaded: None };
        let lengths = self.lengths(&state, x);
        let found = |load: &Load, near: Option<&Pose>| -> Result<Equilibrium, StaticsError> {
            let problem = DirectProblem::new(&robot, &lengths, load)?;
            let rough = rough_pose(&robot, &lengths);
            let first = near.map(|pose| problem.direct(Start::Pose(pose)));
            match first {
                Some(Ok(found)) => Ok(found.equilibrium),
                _ => problem.direct(Start::Pose(&rough)).map(|found| found.equilibrium),
            }
        };
        // In the frame of an unknown tracker the measured pose is of no help.
        let near = measured.filter(|_| self.unknowns.sensor(SensorError::Frame).is_none());
        state.loaded = found(&load, near.as_ref()).map_err(&at)?;
        if is_displaced {
            let near = state.loaded.pose;
            state.unloaded = Some(found(&self.without_load(row, &robot), Some(&near)).map_err(&at)?);
        }
        Ok(state)
    }

    /// The pose that is measured, level where only the position is.
    fn measured_pose(&self, row: &Row) -> Option<Pose> {
        let coordinate = |axis| row.value(Quantity::Position(axis));
        let [x, y, z] = Axis::ALL.map(coordinate);
        let angle = |k| row.value(Quantity::Angle(k)).unwrap_or(0.0);
        let rotation =
            row.rotation.unwrap_or_else(|| Rotation3::from_euler_angles(angle(0), angle(1), angle(2)));
        Some(Pose { position: Vector3::new(x?, y?, z?), rotation })
    }

    /// Follows a row to other unknowns.
    pub(crate) fn follow(
        &self,
        row: &Row,
        from: &RowState,
        robot: &Robot,
        x: &[f64],
        errors: Vec<f64>,
    ) -> Result<RowState, StaticsError> {
        let mut state = RowState { errors, ..from.clone() };
        let lengths = self.lengths(&state, x);
        let rest = |load: &Load, near: &Equilibrium| {
            let problem = DirectProblem::new(robot, &lengths, load)?;
            problem.direct(Start::Near(near)).map(|found| found.equilibrium)
        };
        state.loaded = rest(&self.load(row, robot), &from.loaded)?;
        if let Some(unloaded) = &from.unloaded {
            state.unloaded = Some(rest(&self.without_load(row, robot), unloaded)?);
        }
        Ok(state)
    }

    /// Own errors of a row in its state.
    pub(crate) fn own<'s>(&self, state: &'s RowState) -> &'s [f64] {
        &state.errors
    }

    /// The residuals of a row, with their derivatives.
    pub(crate) fn compare(
        &self,
        row: &Row,
        at: &State,
        k: usize,
        robot: &Robot,
    ) -> Result<Compared, StaticsError> {
        let (state, x) = (&at.rows[k], &at.x[..]);
        let lengths = self.lengths(state, x);
        let problem = DirectProblem::new(robot, &lengths, &self.load(row, robot))?;
        let mut slopes = problem.force_derivatives(&state.loaded)?;
        self.turn_tilts(robot, &mut slopes);
        let mut unloaded = None;
        if let Some(rest) = &state.unloaded {
            let problem = DirectProblem::new(robot, &lengths, &self.without_load(row, robot))?;
            let mut slopes = problem.force_derivatives(rest)?;
            self.turn_tilts(robot, &mut slopes);
            unloaded = Some((rest, slopes));
        }
        let own = state.errors.len();
        let measured_lengths = if own > 0 && row.lengths.is_some() { own } else { 0 };
        let count = row.readings.len() + measured_lengths;
        let mut compared = Compared {
            quantities: Vec::with_capacity(count),
            std: Vec::with_capacity(count),
            residuals: DVector::zeros(count),
            per_unknown: DMatrix::zeros(count, self.unknowns.all.len()),
            per_own: DMatrix::zeros(count, own),
        };
        for (r, reading) in row.readings.iter().enumerate() {
            let (value, read) =
                self.read(reading.quantity, row, robot, at, state, &lengths, &slopes, unloaded.as_ref());
            let measured =
                if matches!(reading.quantity, Quantity::Rotation(_)) { 0.0 } else { reading.value };
            let difference = match reading.quantity {
                Quantity::Angle(_) | Quantity::Swivel(_) => wrapped(measured - value),
                _ => measured - value,
            };
            compared.quantities.push(reading.quantity);
            compared.std.push(reading.std);
            compared.residuals[r] = difference / reading.std;
            let by = -1.0 / reading.std;
            let at_models = &read.models;
            for term in &self.unknowns.terms {
                if row.mass.is_some() && term.parameter == self.layout.mass() {
                    continue;
                }
                compared.per_unknown[(r, term.input)] += by * term.factor * at_models[term.parameter];
            }
            for (unknown, slope) in read.sensors {
                compared.per_unknown[(r, unknown)] += by * slope;
            }
            let first = at_models.len() - lengths.len();
            for (i, length) in lengths.iter().enumerate() {
                let stretch = 1.0 + self.of(SensorError::DrumScale, i, x);
                let per_length = by * at_models[first + i] / stretch;
                for (error, slope) in [(SensorError::LengthOffset, -1.0), (SensorError::DrumScale, -length)] {
                    if let Some(index) = self.unknowns.sensor(error) {
                        compared.per_unknown[(r, index + i)] += per_length * slope;
                    }
                }
                if own > 0 {
                    compared.per_own[(r, i)] -= per_length;
                }
            }
        }
        for i in 0..measured_lengths {
            let r = row.readings.len() + i;
            let std = row.length_std[i].max(f64::MIN_POSITIVE);
            compared.quantities.push(Quantity::Length(i));
            compared.std.push(std);
            compared.residuals[r] = state.errors[i] / std;
            compared.per_own[(r, i)] = 1.0 / std;
        }
        Ok(compared)
    }

    /// A quantity as the sensor would read it, with its slopes; of a rotation the vector from the measured
    /// one, with the opposite sign.
    #[allow(clippy::too_many_arguments)]
    fn read(
        &self,
        quantity: Quantity,
        row: &Row,
        robot: &Robot,
        at: &State,
        state: &RowState,
        lengths: &[f64],
        slopes: &ForceDerivatives,
        unloaded: Option<&(&Equilibrium, ForceDerivatives)>,
    ) -> (f64, Slopes) {
        let (pose, x) = (&state.loaded.pose, &at.x[..]);
        let of_pose = |per_motion: Vector6<f64>, matrix: &Matrix6xX<f64>| per_motion.transpose() * matrix;
        let none = |models| Slopes { models, sensors: Vec::new() };
        match quantity {
            Quantity::Position(axis) => self.place(at, pose, Vector3::zeros(), None, axis, slopes),
            Quantity::Marker(marker, axis) => {
                let mut place = self.unknowns.markers.get(marker).copied().unwrap_or_else(Vector3::zeros);
                let first = self.unknowns.sensor(SensorError::Markers).map(|first| first + 3 * marker);
                if let Some(first) = first {
                    place += Vector3::new(x[first], x[first + 1], x[first + 2]);
                }
                self.place(at, pose, place, first, axis, slopes)
            }
            Quantity::Rotation(axis) => {
                let measured = row.rotation.unwrap_or_else(Rotation3::identity);
                let relative = measured * (at.frame * pose.rotation).inverse();
                let vector = UnitQuaternion::from_rotation_matrix(&relative).scaled_axis();
                // log(exp(r) exp(-dφ)) = r - J⁻¹ dφ, and J⁻¹ Q turns (dφ) of the base frame.
                let slope = inverse_of_right(&vector).row(axis.index()).into_owned();
                let in_base = slope * at.frame.matrix();
                let per_motion = Vector6::new(0.0, 0.0, 0.0, in_base[0], in_base[1], in_base[2]);
                let mut sensors = Vec::new();
                if let Some(first) = self.unknowns.sensor(SensorError::Frame) {
                    sensors.extend((0..3).map(|k| (first + 3 + k, slope[k])));
                }
                (-vector[axis.index()], Slopes { models: of_pose(per_motion, &slopes.pose), sensors })
            }
            Quantity::Angle(k) => {
                let rotation = at.frame * pose.rotation;
                let (roll, pitch, yaw) = rotation.euler_angles();
                let columns = Coordinate::ALL.map(|coordinate| coordinate.motion(yaw, pitch));
                let turns =
                    Matrix3::from_columns(&[3, 4, 5].map(|c| columns[c].fixed_rows::<3>(3).into_owned()));
                let slope = turns.try_inverse().unwrap_or_else(Matrix3::zeros).row(k).into_owned();
                let in_base = slope * at.frame.matrix();
                let per_motion = Vector6::new(0.0, 0.0, 0.0, in_base[0], in_base[1], in_base[2]);
                let mut sensors: Vec<_> = self.slope(SensorError::AngleOffset, k, 1.0).into_iter().collect();
                if let Some(first) = self.unknowns.sensor(SensorError::Frame) {
                    sensors.extend((0..3).map(|c| (first + 3 + c, slope[c])));
                }
                let value = [roll, pitch, yaw][k] + self.of(SensorError::AngleOffset, k, x);
                (value, Slopes { models: of_pose(per_motion, &slopes.pose), sensors })
            }
            Quantity::Displacement(axis) => {
                let Some((rest, at_rest)) = unloaded else {
                    return (0.0, none(RowDVector::zeros(slopes.pose.ncols())));
                };
                let turned = at.frame.matrix().row(axis.index()).into_owned();
                let moved = pose.position - rest.pose.position;
                let per_motion = Vector6::new(turned[0], turned[1], turned[2], 0.0, 0.0, 0.0);
                let models = of_pose(per_motion, &slopes.pose) - of_pose(per_motion, &at_rest.pose);
                let scale = 1.0 + self.of(SensorError::FrameScale, 0, x);
                let mut sensors: Vec<_> =
                    self.slope(SensorError::FrameScale, 0, (turned * moved)[0]).into_iter().collect();
                if let Some(first) = self.unknowns.sensor(SensorError::Frame) {
                    let seen = at.frame * moved;
                    sensors.extend(
                        (0..3).map(|c| {
                            (first + 3 + c, scale * Vector3::ith(c, 1.0).cross(&seen)[axis.index()])
                        }),
                    );
                }
                (scale * (turned * moved)[0], Slopes { models: models * scale, sensors })
            }
            Quantity::Tension(i, end) => {
                let (tension, models) = match end {
                    CableEnd::Anchor => {
                        let force = slopes.forces[i];
                        let direction = force.try_normalize(0.0).unwrap_or_else(Vector3::zeros);
                        (force.norm(), direction.transpose() * slopes.per_input.fixed_rows::<3>(3 * i))
                    }
                    CableEnd::Exit => {
                        let pull = self.pull(robot, i, lengths, state, slopes);
                        let direction = pull.force.try_normalize(0.0).unwrap_or_else(Vector3::zeros);
                        (pull.force.norm(), direction.transpose() * pull.slopes)
                    }
                };
                let gain = 1.0 + self.of(SensorError::TensionGain, i, x);
                let sensors = [
                    self.slope(SensorError::TensionBias, i, 1.0),
                    self.slope(SensorError::TensionGain, i, tension),
                ];
                let value = gain * tension + self.of(SensorError::TensionBias, i, x);
                let models =
                    RowDVector::from_iterator(models.ncols(), models.iter().map(|slope| gain * slope));
                (value, Slopes { models, sensors: sensors.into_iter().flatten().collect() })
            }
            Quantity::Swivel(i) => {
                let pull = self.pull(robot, i, lengths, state, slopes);
                let Some(pulley) = &self.robot.cables[i].pulley else {
                    return (0.0, none(RowDVector::zeros(slopes.pose.ncols())));
                };
                let [u, v] = TiltAxis::ALL.map(|axis| axis.of(pulley));
                let (along, across) = (u.dot(&pull.force), v.dot(&pull.force));
                let per_force = (v * along - u * across) / (along * along + across * across);
                let models = per_force.transpose() * pull.slopes;
                let value = across.atan2(along) + self.of(SensorError::SwivelOffset, i, x);
                let models = RowDVector::from_iterator(models.ncols(), models.iter().copied());
                let sensors = self.slope(SensorError::SwivelOffset, i, 1.0).into_iter().collect();
                (value, Slopes { models, sensors })
            }
            Quantity::Length(_) => (0.0, none(RowDVector::zeros(slopes.pose.ncols()))),
        }
    }

    /// A coordinate of a place on the platform in the frame of the tracker.
    fn place(
        &self,
        at: &State,
        pose: &Pose,
        place: Vector3<f64>,
        unknown: Option<usize>,
        axis: Axis,
        slopes: &ForceDerivatives,
    ) -> (f64, Slopes) {
        let (x, k) = (&at.x[..], axis.index());
        let arm = pose.rotation * place;
        let scale = 1.0 + self.of(SensorError::FrameScale, 0, x);
        let row = at.frame.matrix().row(k) * scale;
        let seen = at.frame * (pose.position + arm);
        let turned = arm.cross(&row.transpose());
        let per_motion = Vector6::new(row[0], row[1], row[2], turned[0], turned[1], turned[2]);
        let mut value = scale * seen[k] + at.origin[k];
        let mut sensors: Vec<_> = self.slope(SensorError::FrameScale, 0, seen[k]).into_iter().collect();
        if let Some(first) = self.unknowns.sensor(SensorError::Frame) {
            value += x[first + k];
            sensors.push((first + k, 1.0));
            sensors.extend((0..3).map(|c| (first + 3 + c, scale * Vector3::ith(c, 1.0).cross(&seen)[k])));
        }
        if let Some(first) = unknown {
            let per_place = row * pose.rotation.matrix();
            sensors.extend((0..3).map(|c| (first + c, per_place[c])));
        }
        (value, Slopes { models: per_motion.transpose() * &slopes.pose, sensors })
    }

    /// The pull at the leave point, equation (R2).
    fn pull(
        &self,
        robot: &Robot,
        i: usize,
        lengths: &[f64],
        state: &RowState,
        slopes: &ForceDerivatives,
    ) -> Pull {
        let cable = robot.cable(i);
        let catenary = Catenary { cable, unstrained_length: lengths[i], force: state.loaded.cable_forces[i] };
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
    fn turn_tilts(&self, robot: &Robot, slopes: &mut ForceDerivatives) {
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
struct Pull {
    force: Vector3<f64>,
    /// 3 x columns.
    slopes: DMatrix<f64>,
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

/// An angle between -π and π.
fn wrapped(angle: f64) -> f64 {
    angle - std::f64::consts::TAU * (angle / std::f64::consts::TAU).round()
}

/// Inverse of the right Jacobian of rotations at the vector r.
fn inverse_of_right(r: &Vector3<f64>) -> Matrix3<f64> {
    let angle = r.norm();
    let cross = r.cross_matrix();
    let second = if angle < 1e-4 {
        1.0 / 12.0
    } else {
        1.0 / (angle * angle) - (1.0 + angle.cos()) / (2.0 * angle * angle.sin())
    };
    Matrix3::identity() + cross * 0.5 + cross * cross * second
}
