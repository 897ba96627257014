//! Steps that are mixed of those before, for searches that come near the minimum slowly.
//!
//! Where a model leaves something out, residuals stay that are large, and the steps of Gauss and Newton are
//! each too long or too short by about the same share. They show by which: of the states z_j at which these
//! full steps p_j were found, the mixture
//!
//! ```text
//! z_k + β (p_k - Σ γ_j (p_k - p_j)) - Σ γ_j (z_k - z_j),      |p_k - Σ γ_j (p_k - p_j)| least          (K8)
//! ```
//!
//! is where the step would be none if it depended on the state linearly (Anderson 1965). Lengths of steps
//! are in standard deviations.

use crate::solve::{Decomposed, Svd};
use nalgebra::{DMatrix, DVector};

/// Steps before the first mixture: a search that fits converges in fewer.
const SLOW: usize = 6;

/// States that are mixed, at most.
const MOST: usize = 10;

/// β: a full step may be too long.
const SHARE: f64 = 0.5;

/// Singular values of the differences of steps below this share of the greatest show nothing.
const ROUNDING: f64 = 1e-8;

/// The last states of a search, in scales, with the full step that was found at each.
pub(super) struct Mixing {
    at: DVector<f64>,
    known: Vec<(DVector<f64>, DVector<f64>)>,
    count: usize,
}

impl Mixing {
    pub(super) fn new(unknowns: usize) -> Self {
        Self { at: DVector::zeros(unknowns), known: Vec::new(), count: 0 }
    }

    /// Notes a step that was made.
    pub(super) fn moved(&mut self, step: &DVector<f64>) {
        self.at += step;
    }

    /// The step to the mixture (K8), where the search is slow.
    pub(super) fn step(&mut self, here: &Decomposed) -> Option<DVector<f64>> {
        let full = here.step(0.0);
        let moved: Vec<_> = self.known.iter().map(|(at, _)| &self.at - at).collect();
        let changed: Vec<_> = self.known.iter().map(|(_, step)| &full - step).collect();
        self.known.push((self.at.clone(), full.clone()));
        if self.known.len() > MOST {
            self.known.remove(0);
        }
        self.count += 1;
        let seen: Vec<_> = changed.iter().map(|change| here.in_deviations(change)).collect();
        if self.count <= SLOW || seen.iter().any(DVector::is_empty) {
            return None;
        }
        let svd = Svd::of(&DMatrix::from_columns(&seen));
        let along = svd.left.tr_mul(&here.in_deviations(&full));
        let mut shares = DVector::zeros(seen.len());
        for k in (0..svd.values.len()).filter(|k| svd.values[*k] > ROUNDING * svd.values[0]) {
            shares += svd.vectors.row(k).transpose() * (along[k] / svd.values[k]);
        }
        let mut step = full * SHARE;
        for ((moved, changed), share) in moved.iter().zip(&changed).zip(shares.iter()) {
            step -= (moved + changed * SHARE) * *share;
        }
        let is_finite = step.iter().all(|of| of.is_finite());
        is_finite.then(|| here.told_part(&step, f64::INFINITY))
    }
}
