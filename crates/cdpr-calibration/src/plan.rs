//! Which poses to measure: sets of poses that together leave least uncertainty, by exchange.
//!
//! With the matrices A of the poses (K1) a set leaves the covariance `C = (1 + sum AᵀA)⁻¹`. A further pose B
//! changes it by
//!
//! ```text
//! C' = C - C Bᵀ (1 + B C Bᵀ)⁻¹ B C                                                                 (K4)
//! ```
//!
//! D-optimal sets maximize `-½ log2 det C`, A-optimal ones minimize the mean of `w C wᵀ` over rows w, which
//! tell how the causes displace each parameter in units of its uncertainty. Sets for the work minimize the
//! mean or the greatest of `t C tᵀ` over rows t, which tell how the causes displace the platform where it
//! works. A set grows by the pose that gains most. Then each of its poses is exchanged for the candidate that
//! gains most, until no exchange gains (Fedorov 1972): a local optimum. Where the outermost poses are better
//! yet, as they may be for the greatest variance, the exchanges begin again with them.

use crate::identify::Calibration;
use nalgebra::DMatrix;
use rand::SeedableRng;
use rand::seq::index::sample;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

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

impl Quality {
    /// The standard deviation of a coordinate where the robot works [m] that a criterion is about: the
    /// greatest for [`Criterion::WorstAtWork`], else the mean.
    pub fn at_work(&self, criterion: Criterion) -> Option<f64> {
        match criterion {
            Criterion::WorstAtWork => self.worst_at_work,
            _ => self.mean_at_work,
        }
    }

    /// What the criterion minimizes, or what increases with it.
    fn loss(&self, criterion: Criterion) -> f64 {
        match criterion {
            Criterion::Information => -self.information,
            Criterion::Parameters => self.parameters,
            Criterion::MeanAtWork | Criterion::WorstAtWork => self.at_work(criterion).unwrap_or_default(),
        }
    }
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

/// Numbers of poses whose sets are searched for together.
const TOGETHER: usize = 8;

/// Random sets to compare with.
const RANDOM_SETS: usize = 25;

/// Rounds of exchanges at most.
const MOST_ROUNDS: usize = 20;

/// A gain below this share is rounding.
const GAIN: f64 = 1e-9;

impl Calibration {
    /// A set of `count` of the poses that is locally best. `seed` is that of the random sets beside it.
    pub fn plan(&self, count: usize, criterion: Criterion, seed: u64) -> PosePlan {
        let count = count.min(self.count());
        let one_by_one = self.one_by_one(count, criterion);
        let growing = (1..=one_by_one.len()).map(|k| self.quality(&one_by_one[..k])).collect();
        let poses = self.best_set(&one_by_one, criterion);
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut sets: Vec<Quality> = (0..RANDOM_SETS)
            .map(|_| self.quality(&sample(&mut random, self.count(), count).into_vec()))
            .collect();
        sets.sort_by(|a, b| a.loss(criterion).total_cmp(&b.loss(criterion)));
        PosePlan {
            quality: self.quality(&poses),
            growing,
            random: sets[RANDOM_SETS / 2],
            corners: self.quality(&self.outermost(count)),
            poses,
        }
    }

    /// The least number of poses, `most` at most, whose plan by [`Calibration::plan`] leaves what `reaches`.
    pub fn needed(
        &self,
        most: usize,
        criterion: Criterion,
        reaches: impl Fn(&Quality) -> bool + Sync,
    ) -> Option<usize> {
        let one_by_one = self.one_by_one(most.min(self.count()), criterion);
        let is_enough =
            |count: &usize| reaches(&self.quality(&self.best_set(&one_by_one[..*count], criterion)));
        let counts: Vec<usize> = (1..=one_by_one.len()).collect();
        counts.chunks(TOGETHER).find_map(|some| some.par_iter().copied().find_first(is_enough))
    }

    /// A set that grows by the pose that gains most.
    fn one_by_one(&self, count: usize, criterion: Criterion) -> Vec<usize> {
        let mut poses: Vec<usize> = Vec::new();
        while poses.len() < count {
            let covariance = self.covariance(&poses);
            let Some(best) = self.best(&covariance, &poses, criterion) else { break };
            poses.push(best.0);
        }
        poses
    }

    /// The better of the sets that exchanges lead to, from a set that has grown and from the outermost poses.
    fn best_set(&self, one_by_one: &[usize], criterion: Criterion) -> Vec<usize> {
        let found = self.exchanged(one_by_one.to_vec(), criterion);
        let corners = self.outermost(one_by_one.len());
        let [left, by_corners] = [&found, &corners].map(|poses| self.quality(poses).loss(criterion));
        if by_corners < left { self.exchanged(corners, criterion) } else { found }
    }

    /// The set that exchanges of its poses lead to, in order.
    fn exchanged(&self, mut poses: Vec<usize>, criterion: Criterion) -> Vec<usize> {
        for _ in 0..MOST_ROUNDS {
            let mut exchanged = false;
            for place in 0..poses.len() {
                let mut others = poses.clone();
                let old = others.remove(place);
                let covariance = self.covariance(&others);
                let before = self.variances(&covariance, criterion);
                let now = self.loss(&covariance, &before, old, criterion);
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
        poses
    }

    /// What the measurements at these poses leave.
    pub fn quality(&self, poses: &[usize]) -> Quality {
        let covariance = self.covariance(poses);
        let parameters = self.relative().nrows().max(1) as f64;
        let of_parameters: f64 = variances_along(self.relative(), &covariance).iter().sum();
        let variances = variances_along(self.work(), &covariance);
        let determinant = covariance.clone().cholesky().map(|factor| {
            factor.l_dirty().diagonal().iter().map(|pivot| 2.0 * pivot.abs().log2()).sum::<f64>()
        });
        let has_work = !variances.is_empty();
        let mean = variances.iter().sum::<f64>() / variances.len().max(1) as f64;
        let worst = variances.iter().copied().fold(0.0, f64::max);
        Quality {
            information: determinant.map_or(f64::NAN, |determinant| -0.5 * determinant),
            parameters: (of_parameters / parameters).sqrt(),
            mean_at_work: has_work.then(|| mean.sqrt()),
            worst_at_work: has_work.then(|| worst.sqrt()),
        }
    }

    /// C of a set of poses.
    fn covariance(&self, poses: &[usize]) -> DMatrix<f64> {
        let n = self.causes();
        let mut covariance = DMatrix::identity(n, n);
        for pose in poses {
            if let Some((_, half)) = added(&covariance, &self.matrices()[*pose]) {
                covariance -= half.transpose() * half;
                covariance.fill_lower_triangle_with_upper_triangle();
            }
        }
        covariance
    }

    /// The candidate that gains most, with what is then left by the criterion.
    fn best(
        &self,
        covariance: &DMatrix<f64>,
        chosen: &[usize],
        criterion: Criterion,
    ) -> Option<(usize, f64)> {
        let left = (0..self.count()).filter(|pose| !chosen.contains(pose));
        let before = self.variances(covariance, criterion);
        left.map(|pose| (pose, self.loss(covariance, &before, pose, criterion)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The rows whose variances a criterion is about; none for the determinant.
    fn rows(&self, criterion: Criterion) -> Option<&DMatrix<f64>> {
        match criterion {
            Criterion::Information => None,
            Criterion::Parameters => Some(self.relative()),
            Criterion::MeanAtWork | Criterion::WorstAtWork => Some(self.work()),
        }
    }

    /// The variances that a criterion is about.
    fn variances(&self, covariance: &DMatrix<f64>, criterion: Criterion) -> Vec<f64> {
        self.rows(criterion).map_or_else(Vec::new, |rows| variances_along(rows, covariance))
    }

    /// What the criterion minimizes, with a further pose; `before` are its variances without.
    fn loss(&self, covariance: &DMatrix<f64>, before: &[f64], pose: usize, criterion: Criterion) -> f64 {
        let Some((factor, half)) = added(covariance, &self.matrices()[pose]) else { return f64::INFINITY };
        let Some(rows) = self.rows(criterion) else {
            return -factor.diagonal().iter().map(|pivot| pivot.log2()).sum::<f64>();
        };
        let gained = half * rows.transpose();
        let left = before.iter().zip(gained.column_iter()).map(|(before, of)| before - of.norm_squared());
        if criterion == Criterion::WorstAtWork { left.fold(0.0, f64::max) } else { left.sum() }
    }
}

/// `r C rᵀ` for each of some rows.
fn variances_along(rows: &DMatrix<f64>, covariance: &DMatrix<f64>) -> Vec<f64> {
    (rows * covariance).component_mul(rows).row_iter().map(|row| row.sum()).collect()
}

/// The lower factor of `1 + B C Bᵀ` of (K4), and its inverse times `B C`, for a further pose B.
fn added(covariance: &DMatrix<f64>, matrix: &DMatrix<f64>) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    let seen = matrix * covariance;
    let inner = DMatrix::identity(matrix.nrows(), matrix.nrows()) + &seen * matrix.transpose();
    let factor = inner.cholesky()?.unpack();
    let half = factor.solve_lower_triangular(&seen)?;
    Some((factor, half))
}
