//! Which combinations of a robot's parameters a calibration can tell, and which poses tell most.
//!
//! Let the parameters be `θ = θ_0 + U x` with their uncertainties on the diagonal of U and x of unit variance, and the measurements
//! `y = y_0 + J U x + N e` with their noise on the diagonal of N. All that matters is the matrix
//!
//! ```text
//! A = N⁻¹ J U = sum s_k w_k v_kᵀ                                                                  (1)
//! ```
//!
//! of all poses, one below the other. The combination `v_k·x` of parameters shows in the measurements with the ratio `s_k` of signal to
//! noise: its standard deviation falls from 1 to `1/sqrt(1 + s_k²)`. Where `s_k = 0` no measurement of this kind tells it, however exact.
//! What is left of the uncertainty is the covariance
//!
//! ```text
//! C = (1 + AᵀA)⁻¹ = sum v_k v_kᵀ/(1 + s_k²)                                                       (2)
//! ```
//!
//! and a further pose with the matrix B adds the information, in bits, and leaves the covariance
//!
//! ```text
//! ½ log2 det(1 + B C Bᵀ),      C - C Bᵀ (1 + B C Bᵀ)⁻¹ B C                                        (3)
//! ```
//!
//! Taking the pose that adds most, one after the other, comes within 1 - 1/e of the information of the best choice (D-optimal design;
//! Nemhauser, Wolsey, Fisher 1978: the information is submodular).

use crate::derivatives::derivatives;
use crate::equations::Inputs;
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::Load;
use cdpr_robot::{Parameter, Pose, Robot};
use nalgebra::{DMatrix, DVector};

/// What is measured at every pose, with the standard deviation of its noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measurement {
    /// The winches wind the lengths of the nominal robot; where the platform then stands is measured.
    Pose {
        /// Noise of each coordinate [m].
        position: f64,
        /// Noise of each component of the rotation [rad].
        rotation: f64,
    },
    /// The same, but the tensions at the platform are measured; noise [N].
    Tensions(f64),
    /// The platform is held at the pose with the set-points of the inverse model; the unstrained lengths are measured; noise [m].
    Lengths(f64),
}

/// Poses at which a robot with uncertain parameters is measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    robot: Robot,
    uncertainties: Vec<f64>,
    /// Places of the uncertain parameters in the parameter vector.
    places: Vec<usize>,
    /// Matrix (1) of each pose.
    poses: Vec<DMatrix<f64>>,
}

/// A combination of parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// s_k: how much a change by its uncertainty shows beside the noise; zero where no measurement tells it.
    pub signal_to_noise: f64,
    /// Parameters with their weights, each in units of its uncertainty, the largest first; the sum of squares is 1. Weights
    /// below 1e-8 of the largest, rounding, are left out.
    pub weights: Vec<(Parameter, f64)>,
}

/// What a calibration tells.
#[derive(Clone, Debug, PartialEq)]
pub struct Identifiability {
    /// Orthogonal combinations from the best told to the least.
    pub told: Vec<Combination>,
    /// A basis of what no measurement tells; each has a parameter that is in no other.
    pub untold: Vec<Combination>,
    /// Each uncertain parameter with its standard deviation after the calibration over that before.
    pub remaining: Vec<(Parameter, f64)>,
}

/// A pose chosen for a calibration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChosenPose {
    /// Number of the pose, in the order in which they were added.
    pub pose: usize,
    /// What it adds to the poses chosen before [bit].
    pub information: f64,
}

/// Singular values below this share of the largest are rounding.
const ROUNDING: f64 = 1e-10;

impl Calibration {
    /// Of a robot whose parameters have the standard deviations `uncertainties` (SI units, in the order of [`Parameter::all`]); a
    /// parameter with zero is known.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] unless there is one finite value, not negative, for each parameter.
    pub fn new(robot: &Robot, uncertainties: &[f64]) -> Result<Self, StaticsError> {
        Inputs::new(robot.cables.len()).check("uncertainties", uncertainties)?;
        let places = (0..uncertainties.len()).filter(|j| uncertainties[*j] > 0.0).collect();
        Ok(Self { robot: robot.clone(), uncertainties: uncertainties.to_vec(), places, poses: Vec::new() })
    }

    /// Adds a pose at which `measurements` are made under the platform's weight and `load`.
    ///
    /// # Errors
    /// Those of [`derivatives`]: the pose is not added; [`StaticsError::Invalid`] for noise that is not positive.
    pub fn add(
        &mut self,
        pose: &Pose,
        load: &Load,
        measurements: &[Measurement],
    ) -> Result<(), StaticsError> {
        let n = self.robot.cables.len();
        let nominal = derivatives(&self.robot, pose, &vec![0.0; n], load)?;
        let lengths = &nominal.deflection.lengths;
        let problem = DirectProblem::new(&self.robot, lengths, load)?;
        let wound = problem.derivatives(&nominal.deflection.loaded.equilibrium)?;
        let mut rows = Vec::new();
        for measurement in measurements {
            match *measurement {
                Measurement::Pose { position, rotation } => {
                    let noise = |row| if row < 3 { position } else { rotation };
                    rows.extend((0..6).map(|row| (wound.pose.row(row).into_owned(), noise(row))));
                }
                Measurement::Tensions(noise) => {
                    rows.extend((0..n).map(|i| (wound.tensions.row(i).into_owned(), noise)));
                }
                Measurement::Lengths(noise) => {
                    rows.extend((0..n).map(|i| (nominal.lengths.row(i).into_owned(), noise)));
                }
            }
        }
        if let Some((_, noise)) = rows.iter().find(|(_, noise)| !(noise.is_finite() && *noise > 0.0)) {
            return Err(StaticsError::Invalid {
                field: "noise".to_owned(),
                value: noise.to_string(),
                expected: "a finite, positive standard deviation".to_owned(),
            });
        }
        self.poses.push(DMatrix::from_fn(rows.len(), self.places.len(), |row, column| {
            let place = self.places[column];
            rows[row].0[place] * self.uncertainties[place] / rows[row].1
        }));
        Ok(())
    }

    /// The uncertain parameters.
    pub fn parameters(&self) -> Vec<Parameter> {
        let all = Parameter::all(self.robot.cables.len());
        self.places.iter().map(|place| all[*place]).collect()
    }

    /// What the measurements at these poses tell, by number; equations (1) and (2).
    pub fn identify(&self, poses: impl IntoIterator<Item = usize>) -> Identifiability {
        let n = self.places.len();
        // The triangular factor has the singular values and right vectors of the whole; a row of zeros adds nothing.
        let triangle = poses.into_iter().filter_map(|pose| self.poses.get(pose)).fold(
            DMatrix::zeros(n, n),
            |above: DMatrix<f64>, block| {
                let mut stacked = above.resize_vertically(n + block.nrows(), 0.0);
                stacked.rows_mut(n, block.nrows()).copy_from(block);
                stacked.qr().r()
            },
        );
        let svd = triangle.svd(false, true);
        let vectors = svd.v_t.unwrap_or_else(|| DMatrix::identity(n, n));
        let values = svd.singular_values;
        let told = values.iter().take_while(|value| **value > ROUNDING * values.max()).count();
        let mut untold = vectors.rows(told, n - told).into_owned();
        own_parameters(&mut untold);
        let combination = |row: DVector<f64>, value| self.combination(&row, value);
        let remaining = |j: usize| {
            let variance: f64 = (0..n).map(|k| vectors[(k, j)].powi(2) / (1.0 + values[k] * values[k])).sum();
            variance.sqrt()
        };
        Identifiability {
            told: (0..told).map(|k| combination(vectors.row(k).transpose(), values[k])).collect(),
            untold: untold.row_iter().map(|row| combination(row.transpose(), 0.0)).collect(),
            remaining: self.parameters().into_iter().enumerate().map(|(j, p)| (p, remaining(j))).collect(),
        }
    }

    fn combination(&self, weights: &DVector<f64>, signal_to_noise: f64) -> Combination {
        let weights = weights.normalize();
        let mut weights: Vec<_> = self.parameters().into_iter().zip(weights.iter().copied()).collect();
        weights.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
        let largest = weights.first().map_or(0.0, |(_, weight)| weight.abs());
        weights.retain(|(_, weight)| weight.abs() >= 1e-8 * largest);
        Combination { signal_to_noise, weights }
    }

    /// The `count` poses that tell most together, each the one that adds most to those before it; equation (3).
    pub fn best_poses(&self, count: usize) -> Vec<ChosenPose> {
        let mut covariance = DMatrix::identity(self.places.len(), self.places.len());
        let mut left: Vec<usize> = (0..self.poses.len()).collect();
        let mut chosen = Vec::new();
        while chosen.len() < count {
            let information = |pose: &usize| {
                let block = &self.poses[*pose];
                let cholesky = (block * &covariance * block.transpose() + identity(block.nrows())).cholesky();
                cholesky
                    .map_or(0.0, |factor| factor.l_dirty().diagonal().iter().map(|d| d.log2()).sum::<f64>())
            };
            let best = left.iter().map(information).enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
            let Some((place, information)) = best else { break };
            let pose = left.remove(place);
            let seen = &self.poses[pose] * &covariance;
            let open = &seen * self.poses[pose].transpose() + identity(seen.nrows());
            if let Some(factor) = open.cholesky() {
                covariance -= seen.transpose() * factor.solve(&seen);
            }
            chosen.push(ChosenPose { pose, information });
        }
        chosen
    }
}

fn identity(size: usize) -> DMatrix<f64> {
    DMatrix::identity(size, size)
}

/// Combines the rows, by Gauss and Jordan with complete pivoting, so that each has a column that is zero in all others.
fn own_parameters(rows: &mut DMatrix<f64>) {
    for k in 0..rows.nrows() {
        let below = rows.rows(k, rows.nrows() - k).iamax_full();
        let (pivot, column) = (k + below.0, below.1);
        rows.swap_rows(k, pivot);
        let own = rows.row(k) / rows[(k, column)];
        rows.set_row(k, &own);
        for other in (0..rows.nrows()).filter(|other| *other != k) {
            let share = rows[(other, column)];
            let mut row = rows.row_mut(other);
            row -= &own * share;
        }
    }
}
