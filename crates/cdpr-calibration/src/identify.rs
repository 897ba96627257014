//! Which combinations of a robot's parameters a calibration identifies, and which poses identify most.
//!
//! Let the parameters be `θ = θ_0 + U x` with causes x of unit variance that do not depend on each other, so
//! that `U Uᵀ` is their covariance (U is diagonal where they are independent), and the measurements
//! `y = y_0 + J U x + N e` with their noise on the diagonal of N. All that matters is the matrix
//!
//! ```text
//! A = N⁻¹ J U = sum s_k w_k v_kᵀ                                                                  (K1)
//! ```
//!
//! of all poses, one below the other. Where lengths are measured with the noise σ, the true ones are unknowns
//! of their pose, `y = y_0 + J U x + σ L l + N e` with l of unit variance, and A is what elimination of l
//! leaves, by the triangular factor of
//!
//! ```text
//! [ 1        0      ]
//! [ N⁻¹ σ L  N⁻¹ J U ]                                                                         (K6)
//! ```
//!
//! The combination `v_k·x` of causes shows in the measurements with
//! the ratio `s_k` of signal to noise: its standard deviation falls from 1 to `1/sqrt(1 + s_k²)`. Where
//! `s_k = 0` the combination is not identifiable: no measurement of this kind shows it, however exact. The
//! uncertainty that remains has the covariance
//!
//! ```text
//! C = (1 + AᵀA)⁻¹ = sum v_k v_kᵀ/(1 + s_k²)                                                    (K2)
//! ```
//!
//! With the triangular factor of `C⁻¹ = RᵀR`, a further pose with the matrix B adds the information,
//! in bits,
//!
//! ```text
//! ½ log2 det(1 + B C Bᵀ) = ½ log2 det(1 + YᵀY),      Rᵀ Y = Bᵀ                               (K3)
//! ```
//!
//! which is the sum of log2 of the diagonal of the triangular factor of `[Y; 1]`; the factor of `[R; B]` is
//! the next R. Neither forms a square whose rounding exceeds the unit matrix where measurements are precise.
//!
//! Taking the pose that adds most, one after the other, comes within 1 - 1/e of the information of the best
//! choice (D-optimal design; Nemhauser, Wolsey, Fisher 1978: the information is submodular).

mod causes;
pub(crate) mod measurement;

use crate::campaign::{STD_EXPECTED, is_std};
use crate::error::CalibrationError;
use crate::identify::causes::Causes;
use crate::identify::measurement::Measurement;
use crate::sensor_error::free_axes;
use crate::solve::{Svd, own_parameters, triangle};
use cdpr_robot::{CableEnd, Coordinate, Parameter, Pose, Robot, Vector3};
use cdpr_statics::{DirectProblem, Load, WantedPose, deflection, derivatives};
use cdpr_study::ErrorModel;
use nalgebra::{DMatrix, DVector, RowDVector};

/// Poses at which a robot with uncertain parameters is measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    robot: Robot,
    causes: Causes,
    /// Matrix A of each pose, equation (K1).
    poses: Vec<DMatrix<f64>>,
    places: Vec<Pose>,
    /// Coordinates that are found, for a robot with few cables.
    free: Vec<Coordinate>,
    /// Derivatives of a coordinate where the robot works by each cause in units of its uncertainty [m].
    work: DMatrix<f64>,
}

/// What is to be exact where the robot works.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AtWork {
    /// The position with given lengths.
    Position,
    /// The displacement by the load.
    Deflection,
}

/// A parameter with a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterValue {
    /// The parameter.
    pub parameter: Parameter,
    /// The number.
    pub value: f64,
}

/// A cause with a number.
#[derive(Clone, Debug, PartialEq)]
pub struct CauseValue {
    /// Name of the cause: that of a parameter which deviates alone, or of a cause of several.
    pub cause: String,
    /// The number.
    pub value: f64,
}

/// A combination of causes: of parameters, where they are independent.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// s_k: signal of a change by its uncertainty over noise; zero where the combination is not identifiable.
    pub signal_to_noise: f64,
    /// Causes with their weights, each in units of its uncertainty, the largest first; the sum of squares is
    /// 1. Weights below 1e-8 of the largest, rounding, are left out.
    pub weights: Vec<CauseValue>,
}

/// What a calibration identifies.
#[derive(Clone, Debug, PartialEq)]
pub struct Identifiability {
    /// Orthogonal combinations that are identifiable, from the best to the least.
    pub identifiable: Vec<Combination>,
    /// A basis of the combinations that are not identifiable; each has a cause that is in no other.
    pub unidentifiable: Vec<Combination>,
    /// Each uncertain parameter with its standard deviation after the calibration over that before.
    pub remaining: Vec<ParameterValue>,
}

/// A pose chosen for a calibration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChosenPose {
    /// Index of the pose, in the order in which they were added.
    pub pose: usize,
    /// Information that it adds to that of the poses chosen before [bit].
    pub information: f64,
}

/// Singular values below this share of the largest are rounding.
const ROUNDING: f64 = 1e-10;

impl Calibration {
    /// A calibration of a robot whose parameters have the standard deviations `uncertainties`.
    ///
    /// They are in SI units and in the order of [`Parameter::of`]; a parameter with zero is known.
    ///
    /// # Errors
    /// [`CalibrationError::Invalid`] unless there is one finite value, not negative, for each parameter.
    pub fn new(robot: &Robot, uncertainties: &[f64]) -> Result<Self, CalibrationError> {
        let count = Parameter::of(robot).len();
        let wrong = uncertainties.iter().position(|std| *std != 0.0 && !is_std(*std));
        let expected = format!("a finite number, zero or more, for each of the {count} parameters");
        if uncertainties.len() != count {
            let value = format!("a list of {}", uncertainties.len());
            return Err(CalibrationError::invalid("uncertainties", value, expected));
        }
        if let Some(k) = wrong {
            return Err(CalibrationError::invalid(format!("uncertainties[{k}]"), uncertainties[k], expected));
        }
        Self::of_model(robot, &ErrorModel::normal(robot, uncertainties))
    }

    /// A calibration of a robot with an error model, correlations of parameters included: those of causes
    /// that act on several, and of the posterior of a fit.
    ///
    /// # Errors
    /// [`CalibrationError::Study`] for a model of another robot; [`CalibrationError::Invalid`] for a standard
    /// deviation that is negative or not finite.
    pub fn of_model(robot: &Robot, model: &ErrorModel) -> Result<Self, CalibrationError> {
        let causes = Causes::of_model(robot, model)?;
        let work = DMatrix::zeros(0, causes.count());
        let (poses, places, free) = (Vec::new(), Vec::new(), Vec::new());
        Ok(Self { robot: robot.clone(), causes, poses, places, free, work })
    }

    /// The same for poses of which these coordinates are found, where a robot has few cables.
    pub fn with_free(self, free: &[Coordinate]) -> Self {
        Self { free: free.to_vec(), ..self }
    }

    /// Adds a pose where the robot works, under `load`: plans can make it most exact there.
    ///
    /// # Errors
    /// Those of [`derivatives`].
    pub fn add_work(&mut self, pose: &Pose, load: &Load, of: AtWork) -> Result<(), CalibrationError> {
        let found = derivatives(&self.robot, WantedPose::at(pose).free(&self.free), load)?;
        let rows = match of {
            AtWork::Deflection => found.displacement(),
            AtWork::Position => {
                let lengths = &found.deflection.lengths;
                let problem = DirectProblem::new(&self.robot, lengths, load)?;
                let pose = problem.derivatives(&found.deflection.loaded.equilibrium)?.pose;
                pose.fixed_rows::<3>(0).into_owned()
            }
        };
        // What holds a planar robot in its plane holds that coordinate of P.
        let rows: Vec<RowDVector<f64>> =
            free_axes(&self.robot).iter().map(|k| rows.row(*k).into_owned()).collect();
        let first = self.work.nrows();
        self.work.resize_vertically_mut(first + rows.len(), 0.0);
        self.work.rows_mut(first, rows.len()).copy_from(&self.causes.by_causes(&rows));
        Ok(())
    }

    /// The nominal robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Number of poses added.
    pub fn count(&self) -> usize {
        self.poses.len()
    }

    pub(crate) fn matrices(&self) -> &[DMatrix<f64>] {
        &self.poses
    }

    pub(crate) fn work(&self) -> &DMatrix<f64> {
        &self.work
    }

    /// The poses farthest from the middle of all, and from each other.
    pub(crate) fn outermost(&self, count: usize) -> Vec<usize> {
        let middle =
            self.places.iter().map(|pose| pose.position).sum::<Vector3<f64>>() / self.count().max(1) as f64;
        let mut chosen: Vec<usize> = Vec::new();
        while chosen.len() < count.min(self.count()) {
            let far = |k: &usize| {
                let at = self.places[*k].position;
                let others = chosen.iter().map(|other| (at - self.places[*other].position).norm());
                others.fold((at - middle).norm(), f64::min)
            };
            let left = (0..self.count()).filter(|k| !chosen.contains(k));
            let Some(next) = left.max_by(|a, b| far(a).total_cmp(&far(b))) else { break };
            chosen.push(next);
        }
        chosen
    }

    /// Adds a pose at which `measurements` are made under the platform's weight and `load`.
    ///
    /// # Errors
    /// Those of [`deflection`] and [`DirectProblem::force_derivatives`]: the pose is not added;
    /// [`CalibrationError::Invalid`] for noise that is not positive, and for lengths alone.
    pub fn add(
        &mut self,
        pose: &Pose,
        load: &Load,
        measurements: &[Measurement],
    ) -> Result<(), CalibrationError> {
        let n = self.robot.cables.len();
        let lengths = deflection(&self.robot, WantedPose::at(pose).free(&self.free), load)?;
        let problem = DirectProblem::new(&self.robot, &lengths.lengths, load)?;
        let at = problem.force_derivatives(&lengths.loaded.equilibrium, CableEnd::Anchor)?;
        let (mut rows, mut of_lengths) = (Vec::new(), 0.0);
        for measurement in measurements {
            let noises = match *measurement {
                Measurement::Pose { position, rotation } => {
                    let (count, turn) = rotation.map_or((3, position), |turn| (6, turn));
                    let noise = |row| if row < 3 { position } else { turn };
                    rows.extend((0..count).map(|row| at.pose.row(row) / noise(row)));
                    [position, turn]
                }
                Measurement::Tensions(noise) => {
                    // A tension changes by what its force changes along itself.
                    let along = |i: usize| {
                        let pull = at.forces[i].normalize();
                        pull.transpose() * at.per_input.fixed_rows::<3>(3 * i) / noise
                    };
                    rows.extend((0..n).map(along));
                    [noise; 2]
                }
                Measurement::Lengths(noise) => {
                    of_lengths = noise;
                    [noise; 2]
                }
            };
            if let Some(noise) = noises.iter().find(|noise| !is_std(**noise)) {
                return Err(CalibrationError::invalid("noise", noise, STD_EXPECTED));
            }
        }
        if rows.is_empty() {
            return Err(Measurement::lengths_alone());
        }
        let inputs = at.pose.ncols() - n;
        let shown = self.causes.by_causes(&rows);
        let moved = DMatrix::from_fn(rows.len(), n, |row, i| rows[row][inputs + i] * of_lengths);
        self.places.push(*pose);
        self.poses.push(if of_lengths == 0.0 { shown } else { without(&moved, &shown) });
        Ok(())
    }

    /// The uncertain parameters.
    pub fn parameters(&self) -> Vec<Parameter> {
        let all = Parameter::of(&self.robot);
        self.causes.uncertain.iter().map(|index| all[*index]).collect()
    }

    /// The rows of U of the uncertain parameters, each over the standard deviation of its parameter.
    pub(crate) fn relative(&self) -> &DMatrix<f64> {
        &self.causes.relative
    }

    /// Number of the causes.
    pub(crate) fn causes(&self) -> usize {
        self.causes.count()
    }

    /// What the measurements at the poses with these indices identify, equations (K1) and (K2).
    pub fn identify(&self, poses: impl IntoIterator<Item = usize>) -> Identifiability {
        let n = self.causes.count();
        // The triangular factor has the singular values and right vectors of the whole; a row of zeros adds
        // nothing.
        let blocks = poses.into_iter().filter_map(|pose| self.poses.get(pose));
        let triangle = blocks.fold(DMatrix::zeros(n, n), triangle);
        let Svd { vectors, values, .. } = Svd::of(&triangle);
        let rank = values.iter().take_while(|value| **value > ROUNDING * values.max()).count();
        let mut free = vectors.rows(rank, n - rank).into_owned();
        own_parameters(&mut free);
        let combination = |row: DVector<f64>, value| self.combination(&row, value);
        // C along the deviation of each parameter, in units of its uncertainty before.
        let along = self.relative() * vectors.transpose();
        let remaining = |(j, parameter)| {
            let variance: f64 = (0..n).map(|k| along[(j, k)].powi(2) / (1.0 + values[k] * values[k])).sum();
            ParameterValue { parameter, value: variance.sqrt() }
        };
        Identifiability {
            identifiable: (0..rank).map(|k| combination(vectors.row(k).transpose(), values[k])).collect(),
            unidentifiable: free.row_iter().map(|row| combination(row.transpose(), 0.0)).collect(),
            remaining: self.parameters().into_iter().enumerate().map(remaining).collect(),
        }
    }

    fn combination(&self, weights: &DVector<f64>, signal_to_noise: f64) -> Combination {
        let weights = weights.normalize();
        let of = |(cause, value): (&String, &f64)| CauseValue { cause: cause.clone(), value: *value };
        let mut weights: Vec<_> = self.causes.names.iter().zip(weights.iter()).map(of).collect();
        weights.sort_by(|a, b| b.value.abs().total_cmp(&a.value.abs()));
        let largest = weights.first().map_or(0.0, |weight| weight.value.abs());
        weights.retain(|weight| weight.value.abs() >= 1e-8 * largest);
        Combination { signal_to_noise, weights }
    }

    /// The `count` poses that identify most together, each the one that adds most to those before it,
    /// equation (K3).
    pub fn best_poses(&self, count: usize) -> Vec<ChosenPose> {
        let n = self.causes.count();
        let mut factor = DMatrix::identity(n, n);
        let mut left: Vec<usize> = (0..self.poses.len()).collect();
        let mut chosen = Vec::new();
        while chosen.len() < count {
            let information = |pose: &usize| {
                let mut seen = self.poses[*pose].transpose();
                // R has no singular value below 1.
                factor.tr_solve_upper_triangular_unchecked_mut(&mut seen);
                let size = seen.ncols();
                let bits = triangle(seen, &DMatrix::identity(size, size)).diagonal().map(|d| d.abs().log2());
                bits.sum()
            };
            let best = left.iter().map(information).enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
            let Some((index, information)) = best else { break };
            let pose = left.remove(index);
            factor = triangle(factor, &self.poses[pose]);
            chosen.push(ChosenPose { pose, information });
        }
        chosen
    }
}

/// What rows show of the parameters when the unit unknowns of `moved` are eliminated, (K6).
fn without(moved: &DMatrix<f64>, shown: &DMatrix<f64>) -> DMatrix<f64> {
    let n = moved.ncols();
    let mut both = DMatrix::zeros(moved.nrows(), n + shown.ncols());
    both.columns_mut(0, n).copy_from(moved);
    both.columns_mut(n, shown.ncols()).copy_from(shown);
    let factor = triangle(DMatrix::identity(n, n + shown.ncols()), &both);
    factor.view((n, n), (factor.nrows() - n, shown.ncols())).into_owned()
}
