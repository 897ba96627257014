//! What is asked of a fit, and what it answers.

use crate::campaign::Quantity;
use crate::sensor_error::SensorError;
use crate::unknowns::{Unknowns, map_of};
use cdpr_robot::{Pose, Robot, Rotation3, Vector3};
use nalgebra::{DMatrix, DVector};
use serde::Serialize;

/// How a residual of several standard deviations counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RobustLoss {
    /// By its square: least squares, the most exact where all noise is normal.
    #[default]
    Squares,
    /// By its square up to 1.345 standard deviations, then in proportion (Huber 1964).
    Huber,
    /// Logarithmically beyond 2.385 standard deviations: outliers hardly count (Cauchy).
    Cauchy,
}

impl RobustLoss {
    pub(crate) fn loss(self, r: f64) -> f64 {
        match self {
            Self::Squares => r * r,
            Self::Huber if r.abs() <= HUBER => r * r,
            Self::Huber => HUBER * (2.0 * r.abs() - HUBER),
            Self::Cauchy => CAUCHY * CAUCHY * (r / CAUCHY).powi(2).ln_1p(),
        }
    }

    /// `loss'(r)/2r`.
    pub(crate) fn weight(self, r: f64) -> f64 {
        match self {
            Self::Squares => 1.0,
            Self::Huber => HUBER / r.abs().max(HUBER),
            Self::Cauchy => 1.0 / (1.0 + (r / CAUCHY).powi(2)),
        }
    }
}

/// 95 % as exact as squares where noise is normal.
const HUBER: f64 = 1.345;

/// 95 % as exact as squares where noise is normal.
const CAUCHY: f64 = 2.385;

/// How a fit is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FitSettings {
    /// How great residuals count.
    pub loss: RobustLoss,
    /// Starts: the nominal robot, and as many less one at random, a standard deviation of the prior or 1 % of
    /// the scale away. Up to twice as many where no two of them end at the least chi-square.
    pub starts: usize,
    /// Seed of the random starts.
    pub seed: u64,
    /// Fix parameters that the data do not tell, instead of leaving them to their priors.
    pub only_identifiable: bool,
    /// Steps at most.
    pub max_steps: usize,
}

impl FitSettings {
    /// Starts at most.
    pub const MOST_STARTS: usize = 1000;

    /// Starts without a wish: two that agree show a minimum, and one may go astray.
    pub const STARTS: usize = 3;
}

impl Default for FitSettings {
    fn default() -> Self {
        Self {
            loss: RobustLoss::Squares,
            starts: Self::STARTS,
            seed: 1,
            only_identifiable: false,
            max_steps: 200,
        }
    }
}

/// A measured number beside the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Index of the row.
    pub row: usize,
    /// Its line in the file.
    pub line: usize,
    /// What was measured.
    pub quantity: Quantity,
    /// Measured less modelled, in the unit of the quantity.
    pub difference: f64,
    /// Standard deviation of the noise.
    pub std: f64,
}

impl Difference {
    /// The difference in standard deviations.
    pub fn standardized(&self) -> f64 {
        self.difference / self.std
    }
}

/// An unknown with its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Its name.
    pub name: String,
    /// The deviation found.
    pub value: f64,
    /// Standard deviation of the posterior, by data and priors; `None` for what they tell less exactly than
    /// one scale. Of the rotation of a frame, that of its rotation vector.
    pub std: Option<f64>,
    /// Standard deviation by the data alone, without any prior but, in the plane of a planar robot, those of
    /// what is out of it; `None` for what they do not tell.
    pub std_of_data: Option<f64>,
    /// Standard deviation of the prior.
    pub prior_std: Option<f64>,
}

impl Estimate {
    /// Whether the data alone tell it, more exactly than its prior or its scale.
    pub fn is_identifiable(&self) -> bool {
        self.std_of_data.is_some()
    }
}

/// Whether a standard deviation is one of something known: below its scale, or at it by its prior alone.
pub(crate) fn is_known(std: f64, scale: f64) -> bool {
    std < (1.0 + 1e-6) * scale
}

/// What is shown of the minimum at which a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FitStatus {
    /// A further step would gain next to nothing, and another start ended there, too.
    Converged,
    /// A further step would still lower chi-square.
    AwayFromMinimum,
    /// A minimum at which no other start ended: another may be lower.
    StartsDisagree,
    /// A minimum, but a single start was made.
    OneStart,
}

impl FitStatus {
    /// What a step may gain of chi-square at a minimum.
    const GAIN: f64 = 1e-6;

    pub(crate) fn of(distance: f64, [made, same]: [usize; 2]) -> Self {
        match (made, same) {
            _ if distance.is_nan() || distance * distance > Self::GAIN => Self::AwayFromMinimum,
            (..=1, _) => Self::OneStart,
            (_, ..=1) => Self::StartsDisagree,
            _ => Self::Converged,
        }
    }
}

/// Chances below this are named: the model or the noise is wrong.
pub(crate) const UNLIKELY: f64 = 1e-4;

/// What constant errors of the lengths would explain of a chi-square that is unlikely, by a linearization.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LengthOffsets {
    /// What they would take from chi-square.
    pub(crate) gain: f64,
    /// The constant error of each cable [m].
    pub(crate) offsets: Vec<f64>,
    /// What one constant error of all cables would take from chi-square, and that error [m].
    pub(crate) common: (f64, f64),
}

impl LengthOffsets {
    /// The cable with the greatest constant error, and that error [m], where such errors are significant and
    /// explain most of what a chi-square with these degrees of freedom exceeds its mean by.
    pub(crate) fn explain(&self, chi_square: f64, degrees: usize) -> Option<(usize, f64)> {
        let greatest =
            self.offsets.iter().copied().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        greatest.filter(|_| explains(self.gain, self.offsets.len(), chi_square, degrees))
    }

    /// The one constant error of all lengths [m], where it explains as much and nearly all that those of
    /// single cables do.
    pub(crate) fn explain_together(&self, chi_square: f64, degrees: usize) -> Option<f64> {
        let (gain, offset) = self.common;
        (gain > SAME * self.gain && explains(gain, 1, chi_square, degrees)).then_some(offset)
    }
}

/// Whether the gain by further unknowns is significant, and is most of what a chi-square exceeds its mean by.
fn explains(gain: f64, unknowns: usize, chi_square: f64, degrees: usize) -> bool {
    let (unknowns, degrees) = (unknowns as f64, degrees as f64);
    let chance = statrs::function::gamma::gamma_ur(0.5 * unknowns, 0.5 * gain.max(f64::MIN_POSITIVE));
    let (excess, left) = (chi_square - degrees, chi_square - gain - (degrees - unknowns));
    chance < UNLIKELY && left < LEFT * excess
}

/// Share of the gain by errors of single cables that one error of all must have.
const SAME: f64 = 0.95;

/// Share of an excess of chi-square that an explanation may leave.
const LEFT: f64 = 0.25;

/// A combination of unknowns that the data do not tell.
#[derive(Clone, Debug, PartialEq)]
pub struct UnidentifiableCombination {
    /// Weights by name, each in units of its scale, the greatest first.
    pub weights: Vec<(String, f64)>,
}

/// Roots of the covariance of the unknowns, in scales.
#[derive(Clone, Debug)]
pub(crate) struct Roots {
    /// With all priors.
    pub(crate) posterior: DMatrix<f64>,
    /// Without priors.
    pub(crate) data: DMatrix<f64>,
    /// With the priors of what is out of the plane of a planar robot alone, if that is sought. Hardly
    /// anything measured depends on it, and how little must not decide what the data show in the plane.
    pub(crate) in_plane: Option<DMatrix<f64>>,
    /// Which unknowns are out of the plane.
    pub(crate) out_of_plane: Vec<bool>,
}

impl Roots {
    /// Standard deviations of a sum of unknowns with these weights: of the posterior, and by the data alone;
    /// none at `scale` or above.
    pub(crate) fn stds(&self, weights: &DVector<f64>, scale: f64) -> [Option<f64>; 2] {
        let mut is_out = weights.iter().zip(&self.out_of_plane).map(|(weight, out)| *weight != 0.0 && *out);
        let in_plane = self.in_plane.as_ref().filter(|_| !is_out.any(|out| out));
        let data = in_plane.unwrap_or(&self.data);
        [&self.posterior, data].map(|root| {
            let std = (root * weights).norm();
            is_known(std, scale).then_some(std)
        })
    }
}

/// A calibrated robot with all that is known of it.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The robot with the deviations found.
    pub robot: Robot,
    /// What was sought.
    pub unknowns: Unknowns,
    /// The value of each unknown: a deviation.
    pub estimates: Vec<Estimate>,
    /// The rotation of the tracker's frame.
    pub frame: Rotation3<f64>,
    /// Where the tracker sees the base frame [m].
    pub origin: Vector3<f64>,
    /// Deviation of each parameter of the robot.
    pub deviations: Vec<f64>,
    /// Covariance of the unknowns, with the prior.
    pub covariance: DMatrix<f64>,
    /// Roots of the covariance, in scales, also of combinations that the data do not determine.
    pub(crate) roots: Roots,
    /// Combinations that the data do not tell.
    pub unidentifiable: Vec<UnidentifiableCombination>,
    /// Sum of the squares of all residuals, priors included.
    pub chi_square: f64,
    /// The part of it that is not of priors, with its degrees of freedom.
    pub of_data: (f64, usize),
    /// Numbers measured and priors less numbers found.
    pub degrees_of_freedom: usize,
    /// Residuals of the nominal robot.
    pub before: Vec<Difference>,
    /// Residuals of the calibrated robot.
    pub after: Vec<Difference>,
    /// The pose of each row by the nominal robot.
    pub poses_before: Vec<Pose>,
    /// The pose of each row by the calibrated robot.
    pub poses: Vec<Pose>,
    /// The line of each row in the file.
    pub lines: Vec<usize>,
    /// The payload of each row [kg].
    pub payloads: Vec<f64>,
    /// Steps made.
    pub steps: usize,
    /// Whether the search ended at a minimum, and what shows that it is the least.
    pub status: FitStatus,
    /// Distance to the minimum by the last linearization, in standard deviations: the root of what a step
    /// would take from chi-square.
    pub distance: f64,
    /// Starts that were made, and how many of them ended at the least chi-square.
    pub starts: [usize; 2],
    /// What offsets of the lengths would explain.
    pub(crate) length_offsets: Option<LengthOffsets>,
}

/// Probability of a chi-square as great as this or greater with these degrees of freedom; 1 with none.
pub(crate) fn chance(chi_square: f64, degrees: usize) -> f64 {
    let half = 0.5 * chi_square.max(f64::MIN_POSITIVE);
    if degrees == 0 { 1.0 } else { statrs::function::gamma::gamma_ur(0.5 * degrees as f64, half) }
}

impl Fit {
    /// Standard deviations of a sum of unknowns with these weights: of the posterior, and by the data alone.
    pub(crate) fn stds(&self, weights: &[(usize, f64)]) -> [Option<f64>; 2] {
        let mut scaled = DVector::zeros(self.estimates.len());
        weights.iter().for_each(|(j, weight)| scaled[*j] += weight * self.unknowns.all[*j].scale);
        self.roots.stds(&scaled, scaled.norm())
    }

    /// Whether the minimum is shown.
    pub fn converged(&self) -> bool {
        self.status == FitStatus::Converged
    }

    /// Probability of a chi-square as great as this or greater, if the model is right and the noise as
    /// stated.
    pub fn p_value(&self) -> Option<f64> {
        (self.degrees_of_freedom > 0).then(|| chance(self.chi_square, self.degrees_of_freedom))
    }

    /// Probability of residuals of the measurements as small as these or smaller, if the noise is as stated.
    pub fn p_value_of_less(&self) -> Option<f64> {
        let (chi_square, degrees) = self.of_data;
        (degrees > 0).then(|| {
            let half = 0.5 * chi_square.max(f64::MIN_POSITIVE);
            statrs::function::gamma::gamma_lr(0.5 * degrees as f64, half)
        })
    }

    /// Measured numbers that lie more than 4 standard deviations of their noise from the model, the farthest
    /// first.
    pub fn outliers(&self) -> Vec<Difference> {
        const FAR: f64 = 4.0;
        let far = |difference: &&Difference| difference.standardized().abs() > FAR;
        let mut outliers: Vec<_> = self.after.iter().filter(far).copied().collect();
        outliers.sort_by(|a, b| b.standardized().abs().total_cmp(&a.standardized().abs()));
        outliers
    }

    /// Covariance of the parameters of the robot, in the order of [`Parameter::of`].
    ///
    /// [`Parameter::of`]: cdpr_robot::Parameter::of
    pub fn parameter_covariance(&self) -> DMatrix<f64> {
        let count = self.deviations.len();
        self.position_covariance().view((0, 0), (count, count)).into_owned()
    }

    /// Covariance of all that a position with given readings of the winches depends on: the parameters, then
    /// what the offset of each winch changes of its length, then what its scale changes of each metre.
    pub(crate) fn position_covariance(&self) -> DMatrix<f64> {
        let map = self.of_position(|_| 1.0);
        &map * &self.covariance * map.transpose()
    }

    /// Derivatives of these by the unknowns, each in its unit.
    fn of_position(&self, unit: impl Fn(usize) -> f64) -> DMatrix<f64> {
        let Unknowns { terms, all, .. } = &self.unknowns;
        let (count, n) = (self.deviations.len(), self.robot.cables.len());
        let mut map = map_of(terms, [count + 2 * n, all.len()], &unit);
        for (k, error) in [SensorError::LengthOffset, SensorError::DrumScale].into_iter().enumerate() {
            let Some(first) = self.unknowns.sensor(error) else { continue };
            for i in 0..n {
                map[(count + k * n + i, first + i)] =
                    -unit(first + i) / (1.0 + self.error_of_winch(SensorError::DrumScale, i));
            }
        }
        map
    }

    /// The error of a winch that was found, 0 for one that was not sought.
    fn error_of_winch(&self, error: SensorError, cable: usize) -> f64 {
        self.unknowns.sensor(error).map_or(0.0, |first| self.estimates[first + cable].value)
    }

    /// Whether errors of the winches were sought: a reading is then no length.
    pub(crate) fn has_errors_of_winches(&self) -> bool {
        let is_sought = |error| self.unknowns.sensor(error).is_some();
        is_sought(SensorError::LengthOffset) || is_sought(SensorError::DrumScale)
    }

    /// The lengths of which the winches read these [m], by the errors that were found.
    pub(crate) fn lengths(&self, read: &[f64]) -> Vec<f64> {
        let length = |(i, read): (usize, &f64)| {
            let [offset, scale] = [SensorError::LengthOffset, SensorError::DrumScale]
                .map(|error| self.error_of_winch(error, i));
            (read - offset) / (1.0 + scale)
        };
        read.iter().enumerate().map(length).collect()
    }

    /// Roots of a covariance of one scale along each combination that neither data nor priors identify: a
    /// combination a column, a row for each row of [`Fit::position_covariance`].
    pub(crate) fn unidentified(&self) -> DMatrix<f64> {
        let map = self.of_position(|input| self.unknowns.all[input].scale);
        let is_unknown = |row: &DVector<f64>| !is_known(row.norm(), 1.0);
        let rows = self.roots.posterior.row_iter().map(|row| row.transpose()).filter(is_unknown);
        let columns: Vec<_> = rows.map(|row| &map * row.normalize()).collect();
        if columns.is_empty() { DMatrix::zeros(map.nrows(), 0) } else { DMatrix::from_columns(&columns) }
    }
}
