//! Allocation of tolerances: by how much to tighten each, so that a variance is reached at the least cost.
//!
//! Input j causes the part `v_j` of the variance of an output. Tightened to the share `s_j` of its deviation,
//! it causes `v_j s_j²`. A tolerance costs `c_j / s_j`, the reciprocal law of machining. The least cost that
//! leaves the variance V satisfies Lagrange's conditions:
//!
//! ```text
//! min  sum c_j / s_j    subject to    sum v_j s_j² = V,    s_j <= 1                    (Al1)
//! s_j = min(1, (μ c_j / v_j)^(1/3))                                                    (Al2)
//! μ^(2/3) = (V - sum_kept v_j) / sum_tightened c_j^(2/3) v_j^(1/3)                     (Al3)
//! ```
//!
//! M. F. Spotts, *Allocation of tolerances to minimize cost of assembly*, J. Eng. Ind. 95 (1973); K. W.
//! Chase, W. H. Greenwood, *Design issues in mechanical tolerance analysis*, Manufacturing Review 1 (1988).
//! The order of `v_j / c_j` decides which tolerances are kept. (Al3) is exact after at most one iteration per
//! input.

use crate::error::{SensitivityError, check_length, require};

/// Factors `s_j` of the tolerances, in (0, 1], that leave the variance `target` at the least cost.
///
/// `variances` are the parts that the inputs cause, `costs` those of their tolerances. All factors are 1 if
/// the variance is small enough already.
///
/// ```
/// use cdpr_sensitivity::allocate;
///
/// // The second input causes most of the variance and is tightened. The third causes nothing and is not.
/// let factors = allocate(&[1.0, 8.0, 0.0], &[1.0, 1.0, 1.0], 3.0)?;
/// let left: f64 = [1.0, 8.0].iter().zip(&factors).map(|(v, s)| v * s * s).sum();
/// assert!((left - 3.0).abs() < 1e-12);
/// assert!(factors[1] < factors[0] && factors[2] == 1.0);
/// # Ok::<(), cdpr_sensitivity::SensitivityError>(())
/// ```
///
/// # Errors
/// [`SensitivityError::InvalidParameter`] for a variance that is negative or not finite, and for a cost or a
/// target that is not positive and finite; [`SensitivityError::LengthMismatch`] unless each variance has a
/// cost.
pub fn allocate(variances: &[f64], costs: &[f64], target: f64) -> Result<Vec<f64>, SensitivityError> {
    check_length("costs", costs.len(), variances.len())?;
    for (&variance, &cost) in variances.iter().zip(costs) {
        let valid = variance.is_finite() && variance >= 0.0;
        require(valid, "variance", variance, "a finite number, zero or more")?;
        require(cost.is_finite() && cost > 0.0, "cost", cost, "a positive finite number")?;
    }
    require(target.is_finite() && target > 0.0, "target", target, "a positive finite number")?;
    let mut tightened: Vec<usize> = (0..variances.len()).filter(|j| variances[*j] > 0.0).collect();
    tightened.sort_by(|i, j| (variances[*j] / costs[*j]).total_cmp(&(variances[*i] / costs[*i])));
    let mut kept = 0.0;
    let mut factors = vec![1.0; variances.len()];
    while let Some(&least) = tightened.last() {
        let weight = |j: &usize| costs[*j].powf(2.0 / 3.0) * variances[*j].cbrt();
        let mu = ((target - kept) / tightened.iter().map(weight).sum::<f64>()).max(0.0).powf(1.5);
        if mu * costs[least] < variances[least] {
            for j in tightened {
                factors[j] = (mu * costs[j] / variances[j]).cbrt();
            }
            break;
        }
        kept += variances[least];
        tightened.pop();
    }
    Ok(factors)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cost (Al1), and the variance that is left.
    fn judge(factors: &[f64], variances: &[f64], costs: &[f64]) -> (f64, f64) {
        let cost = factors.iter().zip(costs).map(|(s, c)| c / s).sum();
        (cost, factors.iter().zip(variances).map(|(s, v)| v * s * s).sum())
    }

    #[test]
    fn the_variance_is_kept_and_no_exchange_between_two_tolerances_is_cheaper() {
        let variances = [4.0, 1.0, 0.25, 0.0, 9.0, 1e-6];
        let costs = [1.0, 2.0, 1.0, 5.0, 30.0, 1.0];
        for target in [13.0, 8.0, 2.0, 0.1, 1e-4] {
            let factors = allocate(&variances, &costs, target).unwrap();
            let (cost, left) = judge(&factors, &variances, &costs);
            assert!((left / target - 1.0).abs() < 1e-12, "{left} for {target}");
            assert!(factors.iter().all(|s| *s > 0.0 && *s <= 1.0));
            for i in [0, 1, 2, 4, 5] {
                for j in [0, 1, 2, 4, 5] {
                    // Loosen i, tighten j by what keeps the variance.
                    let mut other = factors.clone();
                    other[i] *= 1.001;
                    let rest = variances[j] * factors[j].powi(2)
                        - variances[i] * (other[i].powi(2) - factors[i].powi(2));
                    if i == j || other[i] > 1.0 || rest <= 0.0 {
                        continue;
                    }
                    other[j] = (rest / variances[j]).sqrt();
                    assert!(judge(&other, &variances, &costs).0 >= cost, "{i} against {j} at {target}");
                }
            }
        }
    }

    #[test]
    fn nothing_is_tightened_where_the_variance_is_small_enough() {
        assert_eq!(allocate(&[1.0, 2.0], &[1.0, 1.0], 3.0).unwrap(), [1.0, 1.0]);
        assert_eq!(allocate(&[], &[], 3.0).unwrap(), [0.0; 0]);
    }

    #[test]
    fn an_invalid_variance_cost_or_target_is_named() {
        let message =
            |variance, cost, target| allocate(&[variance], &[cost], target).unwrap_err().to_string();
        assert_eq!(message(-1.0, 1.0, 1.0), "variance = -1: expected a finite number, zero or more");
        assert_eq!(message(1.0, 0.0, 1.0), "cost = 0: expected a positive finite number");
        assert_eq!(message(1.0, 1.0, f64::NAN), "target = NaN: expected a positive finite number");
        assert!(allocate(&[1.0], &[], 1.0).is_err());
    }
}
