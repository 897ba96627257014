//! Shapley effects: shares of the variance that add up to 1, also of correlated inputs.
//!
//! With c(u) = Var E (f | x_u) the variance that the inputs u explain,
//!
//! ```text
//! φ_i = mean over all orders of the inputs:  c(those up to i) - c(those before i)      (SH2)
//! Sh_i = φ_i / V,   Σ Sh_i = 1,   S_i <= Sh_i <= T_i for independent inputs            (SH3)
//! ```
//!
//! A. B. Owen, *Sobol' indices and Shapley value*, SIAM/ASA J. Uncertain. Quantif. 2 (2014); E. Song, B. L.
//! Nelson, J. Staum, *Shapley effects for global sensitivity analysis: theory and computation*, SIAM/ASA J.
//! Uncertain. Quantif. 4 (2016). Correlated inputs share what they explain together, so that none counts
//! twice and an input that acts only through another one has an effect, too.
//!
//! With `w_0 .. w_k` the outputs of a walk ([`crate::design::shapley`], Eq. (SH1)) in which input i changes
//! in row j, and V = mean((w_k - w_0)² / 2),
//!
//! ```text
//! φ_i = mean((w_k - (w_(j-1) + w_j) / 2) (w_j - w_(j-1)))                 (SH4)
//! ```
//!
//! Rows j and k have the first j inputs of the walk in common and are independent given these, so that
//! `E w_k w_j = E (E (f | x_u))²`: the difference of two rows is that of two c(u). The squares in (SH4) have
//! mean zero, since all rows have the same law, and make the effects of each walk add up to its part of V.
//! For independent inputs this is the estimator of T. Goda (2021). It takes k + 1 runs a walk, where that of
//! Song, Nelson and Staum takes 3 (k - 1) or more; it is exact in the mean for any number of inputs, unlike
//! estimators by nearest neighbours (B. Broto, F. Bachoc, M. Depecker, *Variance reduction for estimation of
//! Shapley effects and adaptation to unknown input distribution*, SIAM/ASA J. Uncertain. Quantif. 8 (2020)),
//! which need no runs but whose neighbours are far away with more than a few inputs.
//!
//! The walks are independent. The interval is Student's with the variance of a quotient to first order. No
//! unit.

use serde::{Deserialize, Serialize};

use crate::design::observation::check_outputs;
use crate::design::shapley::ShapleyDesign;
use crate::error::{SensitivityError, check_level, check_range};
use crate::sample::interval::Estimate;
use crate::sample::summary::{Spread, check_varies};

/// Shapley effect of one input, or of a group.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub struct ShapleyEffect {
    /// Name of the input, or of the group.
    pub input: String,
    /// Number of walks behind it: those whose outputs were observed at both ends, before and after its
    /// change.
    pub walks: usize,
    /// Share of the variance (SH3).
    pub effect: Estimate,
}

/// Least number of walks.
pub const MIN_WALKS: usize = 16;

/// Estimates the effects (SH3) of all inputs from one output per row of the design, `None` for a failed
/// observation, with intervals of the confidence `level` in (0, 1).
///
/// # Errors
/// - [`SensitivityError::LengthMismatch`] unless there is one output per row;
/// - [`SensitivityError::NotFinite`] for a value that is not finite;
/// - [`SensitivityError::InvalidInput`] with [`SensitivityError::OutOfRange`] for an input with fewer than
///   [`MIN_WALKS`] walks;
/// - [`SensitivityError::ConstantSample`] if all outputs are equal;
/// - [`SensitivityError::InvalidParameter`] for a level outside (0, 1).
pub fn shapley_effects(
    design: &ShapleyDesign,
    outputs: &[Option<f64>],
    level: f64,
) -> Result<Vec<ShapleyEffect>, SensitivityError> {
    check_level(level)?;
    check_outputs(design, outputs)?;
    check_varies(&outputs.iter().copied().flatten().collect::<Vec<f64>>())?;
    let groups = design.groups();
    // For each input (φ, V) of each walk.
    let mut found: Vec<Vec<[f64; 2]>> = vec![Vec::new(); groups.len()];
    for (walk, rows) in outputs.chunks(groups.len() + 1).enumerate() {
        let (Some(first), Some(last)) = (rows[0], rows[groups.len()]) else { continue };
        let whole = 0.5 * (last - first).powi(2);
        for (pair, group) in rows.windows(2).zip(design.order(walk)) {
            if let [Some(before), Some(after)] = *pair {
                found[group].push([(last - 0.5 * (before + after)) * (after - before), whole]);
            }
        }
    }
    groups.iter().zip(&found).map(|(group, terms)| effect(&group.name, terms, level)).collect()
}

fn effect(name: &str, terms: &[[f64; 2]], level: f64) -> Result<ShapleyEffect, SensitivityError> {
    check_range("walks", terms.len() as u64, MIN_WALKS as u64, u64::MAX).map_err(|source| {
        SensitivityError::InvalidInput { name: name.to_owned(), source: Box::new(source) }
    })?;
    let n = terms.len() as f64;
    let [part, whole] = [0, 1].map(|k| terms.iter().map(|term| term[k]).sum::<f64>() / n);
    if whole == 0.0 {
        return Err(SensitivityError::ConstantSample { value: 0.0, count: terms.len() });
    }
    let share = part / whole;
    let residuals: Vec<f64> = terms.iter().map(|[part, of]| (part - share * of) / whole).collect();
    let effect = Estimate::of_variance(share, Spread::of(&residuals).variance() / n, n - 1.0, level)?;
    Ok(ShapleyEffect { input: name.to_owned(), walks: terms.len(), effect })
}
