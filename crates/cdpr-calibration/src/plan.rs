//! Which poses to measure: sets of poses that together leave least uncertainty, by exchange.
//!
//! With the matrices A of the poses (K1) a set leaves the covariance `C = (1 + sum AᵀA)⁻¹`. A further pose B
//! changes it by
//!
//! ```text
//! C' = C - C Bᵀ (1 + B C Bᵀ)⁻¹ B C                                                                 (K4)
//! ```
//!
//! D-optimal sets maximize `-½ log2 det C`, A-optimal ones minimize the trace of C; sets for the work
//! minimize the mean or the greatest of `t C tᵀ` over rows t, which tell how the parameters displace the
//! platform where it works. A set grows by the pose that gains most. Then each of its poses is exchanged for
//! the candidate that gains most, until no exchange gains (Fedorov 1972): a local optimum.

use crate::identify::Calibration;
use nalgebra::DMatrix;
use rand::SeedableRng;
use rand::seq::index::sample;
use rand_chacha::ChaCha8Rng;

/// What a set of poses is to be best in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// Information about all parameters together (D).
    Information,
    /// Mean variance of the parameters, each in units of its uncertainty (A).
    Parameters,
    /// Mean variance of the position or displacement where the robot works.
    MeanAtWork,
    /// Greatest variance of the position or displacement where the robot works (G).
    WorstAtWork,
}

/// What a set of poses leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// Information about the parameters [bit].
    pub information: f64,
    /// Root mean square of the standard deviations of the parameters after, each over that before.
    pub parameters: f64,
    /// Root mean square of the standard deviation of a coordinate where the robot works [m]; none where that
    /// is not said.
    pub mean_at_work: Option<f64>,
    /// The greatest standard deviation of a coordinate there [m].
    pub worst_at_work: Option<f64>,
}

/// A set of poses and what it leaves.
#[derive(Clone, Debug, PartialEq)]
pub struct PosePlan {
    /// Indices of the poses.
    pub poses: Vec<usize>,
    /// What it leaves.
    pub quality: Quality,
    /// What the first 1, 2, 3 ... poses leave of a set that grows one by one.
    pub growing: Vec<Quality>,
    /// What random sets of as many poses leave in the median.
    pub random: Quality,
    /// What the outermost poses leave.
    pub corners: Quality,
}

/// Random sets to compare with.
const RANDOM_SETS: usize = 25;

/// Rounds of exchanges at most.
const MOST_ROUNDS: usize = 20;

/// A gain below this share is rounding.
const GAIN: f64 = 1e-9;

impl Calibration {
    /// A set of `count` of the poses that is locally best. `seed` is that of the random sets beside it.
    pub fn plan(&self, count: usize, criterion: Criterion, seed: u64) -> PosePlan {
        let candidates: Vec<usize> = (0..self.count()).collect();
        let count = count.min(candidates.len());
        let mut poses: Vec<usize> = Vec::new();
        let mut growing = Vec::new();
        while poses.len() < count {
            let covariance = self.covariance(&poses);
            let Some(best) = self.best(&covariance, &poses, criterion) else { break };
            poses.push(best.0);
            growing.push(self.quality(&poses));
        }
        for _ in 0..MOST_ROUNDS {
            let mut exchanged = false;
            for place in 0..poses.len() {
                let mut others = poses.clone();
                let old = others.remove(place);
                let covariance = self.covariance(&others);
                let now = self.loss(&covariance, &self.matrices()[old], criterion);
                if let Some((best, loss)) = self.best(&covariance, &others, criterion)
                    && best != old
                    && loss < now - GAIN * now.abs()
                {
                    poses[place] = best;
                    exchanged = true;
                }
            }
            if !exchanged {
                break;
            }
        }
        poses.sort_unstable();
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut sets: Vec<Quality> = (0..RANDOM_SETS)
            .map(|_| self.quality(&sample(&mut random, candidates.len(), count).into_vec()))
            .collect();
        let key = |quality: &Quality| match criterion {
            Criterion::Information => -quality.information,
            Criterion::Parameters => quality.parameters,
            Criterion::MeanAtWork => quality.mean_at_work.unwrap_or_default(),
            Criterion::WorstAtWork => quality.worst_at_work.unwrap_or_default(),
        };
        sets.sort_by(|a, b| key(a).total_cmp(&key(b)));
        PosePlan {
            quality: self.quality(&poses),
            growing,
            random: sets[RANDOM_SETS / 2],
            corners: self.quality(&self.outermost(count)),
            poses,
        }
    }

    /// What the measurements at these poses leave.
    pub fn quality(&self, poses: &[usize]) -> Quality {
        let covariance = self.covariance(poses);
        let n = covariance.nrows().max(1) as f64;
        let variances = self.at_work(&covariance);
        let determinant = covariance.clone().cholesky().map(|factor| {
            factor.l_dirty().diagonal().iter().map(|pivot| 2.0 * pivot.abs().log2()).sum::<f64>()
        });
        let has_work = !variances.is_empty();
        let mean = variances.iter().sum::<f64>() / variances.len().max(1) as f64;
        let worst = variances.iter().copied().fold(0.0, f64::max);
        Quality {
            information: determinant.map_or(f64::NAN, |determinant| -0.5 * determinant),
            parameters: (covariance.trace() / n).sqrt(),
            mean_at_work: has_work.then(|| mean.sqrt()),
            worst_at_work: has_work.then(|| worst.sqrt()),
        }
    }

    /// C of a set of poses.
    fn covariance(&self, poses: &[usize]) -> DMatrix<f64> {
        let n = self.parameters().len();
        let mut covariance = DMatrix::identity(n, n);
        for pose in poses {
            if let Some((_, half)) = added(&covariance, &self.matrices()[*pose]) {
                covariance -= half.transpose() * half;
                covariance.fill_lower_triangle_with_upper_triangle();
            }
        }
        covariance
    }

    /// Variances of the coordinates where the robot works [m²].
    fn at_work(&self, covariance: &DMatrix<f64>) -> Vec<f64> {
        let work = self.work();
        (work * covariance).component_mul(work).row_iter().map(|row| row.sum()).collect()
    }

    /// The candidate that gains most, with what is then left by the criterion.
    fn best(
        &self,
        covariance: &DMatrix<f64>,
        chosen: &[usize],
        criterion: Criterion,
    ) -> Option<(usize, f64)> {
        let left = (0..self.count()).filter(|pose| !chosen.contains(pose));
        left.map(|pose| (pose, self.loss(covariance, &self.matrices()[pose], criterion)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// What the criterion minimizes, with a further pose.
    fn loss(&self, covariance: &DMatrix<f64>, matrix: &DMatrix<f64>, criterion: Criterion) -> f64 {
        let Some((factor, half)) = added(covariance, matrix) else { return f64::INFINITY };
        let at_work = || {
            let gained = &half * self.work().transpose();
            let before =
                self.at_work(covariance).into_iter().zip(gained.column_iter().map(|g| g.norm_squared()));
            before.map(|(before, gain)| before - gain).collect::<Vec<_>>()
        };
        match criterion {
            Criterion::Information => -factor.diagonal().iter().map(|pivot| pivot.log2()).sum::<f64>(),
            Criterion::Parameters => covariance.trace() - half.norm_squared(),
            Criterion::MeanAtWork => at_work().iter().sum(),
            Criterion::WorstAtWork => at_work().into_iter().fold(0.0, f64::max),
        }
    }
}

/// The lower factor of `1 + B C Bᵀ` of (K4), and its inverse times `B C`, for a further pose B.
fn added(covariance: &DMatrix<f64>, matrix: &DMatrix<f64>) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    let seen = matrix * covariance;
    let inner = DMatrix::identity(matrix.nrows(), matrix.nrows()) + &seen * matrix.transpose();
    let factor = inner.cholesky()?.unpack();
    let half = factor.solve_lower_triangular(&seen)?;
    Some((factor, half))
}
