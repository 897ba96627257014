//! Measurements: what sensors have read, a row for each state of the robot.

use cdpr_robot::{Axis, CableEnd, Rotation3};
use cdpr_statics::Load;
use nalgebra::DMatrix;
use std::fmt;

/// A quantity that a sensor reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Coordinate of P, in the frame of the sensor [m].
    Position(Axis),
    /// Component of the rotation vector that leads from the model's to the measured orientation [rad].
    Rotation(Axis),
    /// Roll, pitch or yaw, number 0 to 2, R = Rz(yaw) Ry(pitch) Rx(roll) [rad].
    Angle(usize),
    /// Coordinate of a marker on the platform, in the frame of the sensor [m].
    Marker(usize, Axis),
    /// Displacement of P by the load, from the equilibrium without load [m].
    Displacement(Axis),
    /// Tension of a cable at one of its ends [N].
    Tension(usize, CableEnd),
    /// Swivel angle of a cable's pulley about the axis in which the cable enters, from the horizontal
    /// direction [`cdpr_robot::TiltAxis::U`] towards the other one [rad].
    Swivel(usize),
    /// Unstrained length of a cable [m].
    Length(usize),
}

impl Quantity {
    /// The sensor that reads it: the name of its noise.
    pub fn sensor(self) -> &'static str {
        match self {
            Self::Position(_) => "position",
            Self::Rotation(_) | Self::Angle(_) => "rotation",
            Self::Marker(..) => "marker",
            Self::Displacement(_) => "displacement",
            Self::Tension(..) => "tension",
            Self::Swivel(_) => "swivel",
            Self::Length(_) => "length",
        }
    }

    /// The cable that it is about.
    pub(crate) fn cable(self) -> Option<usize> {
        match self {
            Self::Length(i) | Self::Tension(i, _) | Self::Swivel(i) => Some(i),
            _ => None,
        }
    }

    /// SI unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Position(_) | Self::Marker(..) | Self::Displacement(_) | Self::Length(_) => "m",
            Self::Rotation(_) | Self::Angle(_) | Self::Swivel(_) => "rad",
            Self::Tension(..) => "N",
        }
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Position(axis) => write!(f, "{axis}_m"),
            Self::Rotation(axis) => write!(f, "r{axis}_rad"),
            Self::Angle(k) => write!(f, "{}_rad", ["roll", "pitch", "yaw"][*k]),
            Self::Marker(k, axis) => write!(f, "marker{}_{axis}_m", k + 1),
            Self::Displacement(axis) => write!(f, "d{axis}_m"),
            Self::Tension(i, CableEnd::Anchor) => write!(f, "t{}_n", i + 1),
            Self::Tension(i, CableEnd::Exit) => write!(f, "t{}_winch_n", i + 1),
            Self::Swivel(i) => write!(f, "swivel{}_rad", i + 1),
            Self::Length(i) => write!(f, "l{}_m", i + 1),
        }
    }
}

/// A number that a sensor has read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// What is read.
    pub quantity: Quantity,
    /// The number, in [`Quantity::unit`]; unused for a rotation, which is that of the row.
    pub value: f64,
    /// Standard deviation of its noise.
    pub std: f64,
}

/// What is measured in one state of the robot.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Line in the file, or number of the row from 1: how messages name it.
    pub line: usize,
    /// The known load.
    pub load: Load,
    /// Known mass of the platform in this row, in place of the robot's [kg].
    pub mass: Option<f64>,
    /// Unstrained lengths as the winches tell them [m]; `None` where they are not known.
    pub lengths: Option<Vec<f64>>,
    /// Standard deviation of each [m]; zero for lengths that are exact but for the errors of their sensors.
    pub length_std: Vec<f64>,
    /// Measured orientation, in the frame of the sensor.
    pub rotation: Option<Rotation3<f64>>,
    /// All other readings.
    pub readings: Vec<Reading>,
    /// Covariances of the noise of two quantities, in the product of their units; zero where left out, and
    /// without effect where one of the two is not there.
    pub covariances: Vec<(Quantity, Quantity, f64)>,
}

impl Row {
    /// A row without any measurement.
    pub fn new(line: usize, load: Load) -> Self {
        Self {
            line,
            load,
            mass: None,
            lengths: None,
            length_std: Vec::new(),
            rotation: None,
            readings: Vec::new(),
            covariances: Vec::new(),
        }
    }

    /// The numbers with noise, in the order of the residuals, with their standard deviations.
    fn noisy(&self) -> Vec<(Quantity, f64)> {
        let lengths = self.length_std.iter().enumerate().filter(|(_, std)| **std > 0.0);
        let lengths = lengths.map(|(i, std)| (Quantity::Length(i), *std));
        self.readings.iter().map(|reading| (reading.quantity, reading.std)).chain(lengths).collect()
    }

    /// Triangular factor `C` of the correlation `C Cᵀ` of the numbers with noise; `None` where they do not
    /// depend on each other, or where the matrix is not positive definite.
    pub(crate) fn correlation_factor(&self) -> Option<DMatrix<f64>> {
        let noisy = self.noisy();
        let find = |quantity: Quantity| noisy.iter().position(|(own, _)| *own == quantity);
        let mut matrix = DMatrix::identity(noisy.len(), noisy.len());
        for (one, other, covariance) in &self.covariances {
            if let (Some(i), Some(j)) = (find(*one), find(*other)) {
                let correlation = covariance / (noisy[i].1 * noisy[j].1);
                (matrix[(i, j)], matrix[(j, i)]) = (correlation, correlation);
            }
        }
        if matrix.is_identity(0.0) { None } else { Some(matrix.cholesky()?.unpack()) }
    }

    /// Whether the covariances make a positive definite matrix with the standard deviations.
    pub(crate) fn is_covariance_valid(&self) -> bool {
        let noisy = self.noisy();
        let is_there = |quantity: &Quantity| noisy.iter().any(|(own, _)| own == quantity);
        let count = |(one, other, value): &&(Quantity, Quantity, f64)| {
            *value != 0.0 && is_there(one) && is_there(other)
        };
        self.covariances.iter().filter(count).count() == 0 || self.correlation_factor().is_some()
    }

    /// Refuses numbers that are not finite, and standard deviations out of bounds.
    pub(crate) fn check(&self) -> Result<(), crate::CalibrationError> {
        let wrong = |field: &str, value: f64, expected: &str| {
            crate::CalibrationError::invalid(format!("{field} of line {}", self.line), value, expected)
        };
        for Reading { quantity, value, std } in &self.readings {
            if !value.is_finite() {
                return Err(wrong(&quantity.to_string(), *value, "a finite number"));
            }
            if !is_std(*std) {
                return Err(wrong(&format!("std_{quantity}"), *std, STD_EXPECTED));
            }
        }
        let lengths = self.lengths.iter().flatten().chain(self.mass.iter()).chain([&self.load.payload]);
        if let Some(value) = lengths.chain(self.covariances.iter().map(|of| &of.2)).find(|of| !of.is_finite())
        {
            return Err(wrong("a number", *value, "a finite number"));
        }
        if let Some(std) = self.length_std.iter().find(|std| **std != 0.0 && !is_std(**std)) {
            return Err(wrong("the standard deviation of a length", *std, STD_EXPECTED));
        }
        Ok(())
    }

    /// The number that a sensor has read of this quantity.
    pub fn value(&self, quantity: Quantity) -> Option<f64> {
        self.readings.iter().find(|reading| reading.quantity == quantity).map(|reading| reading.value)
    }
}

/// Whether a number can be a standard deviation: its square, and what is divided by it, are numbers yet.
pub(crate) fn is_std(std: f64) -> bool {
    (1e-15..=1e15).contains(&std)
}

/// What a standard deviation is to be.
pub(crate) const STD_EXPECTED: &str = "a standard deviation from 1e-15 to 1e15, in SI units";

/// Standard deviations of the noise of each kind of sensor, SI units; `None` where it is not stated.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Noise {
    /// Of each coordinate of P [m].
    pub position: Option<f64>,
    /// Of each component of an orientation [rad].
    pub rotation: Option<f64>,
    /// Of each unstrained length [m]; lengths without noise are exact.
    pub length: Option<f64>,
    /// Of each tension [N].
    pub tension: Option<f64>,
    /// Of each component of a displacement [m]; that of two positions if left out.
    pub displacement: Option<f64>,
    /// Of each coordinate of a marker [m]; that of the position if left out.
    pub marker: Option<f64>,
    /// Of each swivel angle [rad]; that of the rotation if left out.
    pub swivel: Option<f64>,
}

impl Noise {
    /// The names of the sensors.
    pub const NAMES: [&str; 7] =
        ["position", "rotation", "length", "tension", "displacement", "marker", "swivel"];

    /// Noise by the name of its sensor; `lengths`, `tensions` and `markers` are understood, too.
    ///
    /// # Errors
    /// [`crate::CalibrationError::Invalid`] for another name, a sensor that is named twice, and a number that
    /// is no standard deviation.
    pub fn named(named: &[(String, f64)]) -> Result<Self, crate::CalibrationError> {
        let mut noise = Self::default();
        for (name, std) in named {
            let wrong =
                |expected: String| crate::CalibrationError::invalid(format!("noise {name}"), std, expected);
            let field = match Self::sensor(name) {
                "position" => &mut noise.position,
                "rotation" => &mut noise.rotation,
                "length" => &mut noise.length,
                "tension" => &mut noise.tension,
                "displacement" => &mut noise.displacement,
                "marker" => &mut noise.marker,
                "swivel" => &mut noise.swivel,
                _ => return Err(wrong(format!("one of {}", Self::NAMES.join(", ")))),
            };
            if !is_std(*std) {
                return Err(wrong(STD_EXPECTED.to_owned()));
            }
            if let Some(before) = field.replace(*std) {
                return Err(wrong(format!("each sensor once; {} is {before} already", Self::sensor(name))));
            }
        }
        Ok(noise)
    }

    /// The name of a sensor by any of its names.
    pub(crate) fn sensor(name: &str) -> &str {
        match name {
            "lengths" => "length",
            "tensions" => "tension",
            "markers" => "marker",
            _ => name,
        }
    }

    /// Standard deviation of a quantity, if it is stated.
    pub fn of(&self, quantity: Quantity) -> Option<f64> {
        match quantity {
            Quantity::Position(_) => self.position,
            Quantity::Rotation(_) | Quantity::Angle(_) => self.rotation,
            Quantity::Marker(..) => self.marker.or(self.position),
            Quantity::Displacement(_) => {
                self.displacement.or(self.position.map(|std| std * std::f64::consts::SQRT_2))
            }
            Quantity::Tension(..) => self.tension,
            Quantity::Swivel(_) => self.swivel.or(self.rotation),
            Quantity::Length(_) => self.length,
        }
    }

    /// Standard deviation of a quantity whose noise is not stated, for a robot of this size [m] and with this
    /// greatest tension [N]: so small that it counts as exact compared with one that is stated.
    pub(crate) fn exact(quantity: Quantity, size: f64, tension: f64) -> f64 {
        match quantity.unit() {
            "N" => EXACT_TENSION * tension,
            "m" => EXACT_LENGTH * size,
            _ => EXACT_ANGLE,
        }
    }
}

/// Error of a place or a length that counts as exact, as a share of the robot's size: 1e-6 m of 10 m.
const EXACT_LENGTH: f64 = 1e-7;

/// Error of a tension that counts as exact, as a share of the greatest one: 1e-3 N of 1 kN.
const EXACT_TENSION: f64 = 1e-6;

/// Error of an angle that counts as exact [rad].
const EXACT_ANGLE: f64 = 1e-6;
