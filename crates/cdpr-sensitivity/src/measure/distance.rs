//! The distance that a share of normal displacements in space keeps, whatever their directions.
//!
//! In the principal axes of its covariance, with the variances `λ_i`, a normal displacement with mean zero is
//! `√λ_i ρ u_i`: u is uniform on the unit sphere, and ρ² has the law F of χ² with three degrees of freedom,
//! independent of u. Hence
//!
//! ```text
//! P(|δ| <= r) = E F(r²/s),      s = sum λ_i u_i²                                        (Di1)
//! ∂(r²)/∂λ_i = r² E[f(r²/s) u_i²/s²] / E[f(r²/s)/s],      f = F'                        (Di2)
//! ```
//!
//! The mean over the sphere is that of one octant: Gauss and Legendre's rule along the axis of the greatest
//! variance, where F is flat to all orders at the equator if the others vanish, and equidistant points around
//! it.

use crate::error::{SensitivityError, require};
use crate::law::normal::{standard_normal_cdf, standard_normal_quantile};
use crate::measure::expansion::basis::gauss_legendre;
use std::f64::consts::{FRAC_PI_2, PI};

/// Points along the axis, and around it: r is right to 1e-10.
const POINTS: [usize; 2] = [24, 16];
/// Relative change of r² at which Newton's method ends.
const LAST_CHANGE: f64 = 1e-14;

/// The distance that a share of normal displacements keeps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalDistance {
    /// The distance, in the unit of the displacement.
    pub distance: f64,
    /// Its derivatives by the variances along the principal axes; infinite where all of these are zero.
    pub per_variance: [f64; 3],
}

/// The distance that a share of displacements keeps, which are normal with mean zero and have these variances
/// along their principal axes, Eq. (Di1).
///
/// ```
/// use cdpr_sensitivity::normal_distance;
///
/// let along_a_line = normal_distance([4.0, 0.0, 0.0], 0.95)?;
/// assert!((along_a_line.distance - 2.0 * 1.959964).abs() < 1e-6);
/// # Ok::<(), cdpr_sensitivity::SensitivityError>(())
/// ```
///
/// # Errors
/// [`SensitivityError::InvalidParameter`] for a variance that is negative or not finite, and a share outside
/// 0.9 to 1.
pub fn normal_distance(variances: [f64; 3], share: f64) -> Result<NormalDistance, SensitivityError> {
    for variance in variances {
        let is_valid = variance.is_finite() && variance >= 0.0;
        require(is_valid, "variance", variance, "a finite number, zero or more")?;
    }
    require((0.9..1.0).contains(&share), "share", share, "0.9 or more, and below 1")?;
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| variances[*b].total_cmp(&variances[*a]));
    let greatest = variances[order[0]];
    if greatest == 0.0 {
        return Ok(NormalDistance { distance: 0.0, per_variance: [f64::INFINITY; 3] });
    }
    let nodes = nodes(order.map(|i| variances[i] / greatest));
    // On a line, and beyond what it is in space.
    let mut low = standard_normal_quantile(0.5 + 0.5 * share).powi(2);
    let (mut high, mut square) = (6.0 * low, low);
    loop {
        let sum = |of: &dyn Fn(f64, f64) -> f64| -> f64 {
            nodes.iter().map(|node| node.weight * of(square / node.s, node.s)).sum()
        };
        let missing = share - sum(&|t, _| distribution(t));
        *(if missing > 0.0 { &mut low } else { &mut high }) = square;
        let newton = square + missing / sum(&|t, s| density(t) / s);
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        let change = (next - square).abs();
        square = next;
        if change <= LAST_CHANGE * square {
            break;
        }
    }
    let (mut slopes, mut all) = ([0.0; 3], 0.0);
    for Node { squares, s, weight } in &nodes {
        let each = weight * density(square / s) / s;
        all += each;
        squares.iter().zip(order).for_each(|(square, i)| slopes[i] += each * square / s);
    }
    let distance = (greatest * square).sqrt();
    // d r = d(r²) / (2 r), of r² and λ in units of the greatest variance.
    let per_variance = slopes.map(|slope| square * slope / all / (2.0 * distance));
    Ok(NormalDistance { distance, per_variance })
}

/// A direction of an octant.
struct Node {
    /// `u_i²`.
    squares: [f64; 3],
    s: f64,
    weight: f64,
}

fn nodes(variances: [f64; 3]) -> Vec<Node> {
    let [along, around] = POINTS;
    let node = |(z, w): (f64, f64), k: usize| {
        let (axis, angle) = (0.5 * (z + 1.0), FRAC_PI_2 * (k as f64 + 0.5) / around as f64);
        let square = axis * axis;
        let squares = [square, (1.0 - square) * angle.cos().powi(2), (1.0 - square) * angle.sin().powi(2)];
        let s = variances.iter().zip(squares).map(|(variance, square)| variance * square).sum();
        Node { squares, s, weight: 0.5 * w / around as f64 }
    };
    let rule = gauss_legendre(along);
    rule.into_iter().flat_map(|point| (0..around).map(move |k| node(point, k))).collect()
}

/// F of χ² with three degrees of freedom.
fn distribution(t: f64) -> f64 {
    2.0 * standard_normal_cdf(t.sqrt()) - 1.0 - 2.0 * density(t)
}

/// f.
fn density(t: f64) -> f64 {
    (t / (2.0 * PI)).sqrt() * (-0.5 * t).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn distance(variances: [f64; 3], share: f64) -> f64 {
        normal_distance(variances, share).unwrap().distance
    }

    #[test]
    fn distances_on_a_line_in_a_plane_and_in_space_are_those_of_chi() {
        for share in [0.9_f64, 0.95, 0.999] {
            let line = standard_normal_quantile(0.5 + 0.5 * share);
            assert!((distance([0.0, 9.0, 0.0], share) / (3.0 * line) - 1.0).abs() < 1e-9);
            // Rayleigh's law.
            let plane = (-2.0 * (1.0 - share).ln()).sqrt();
            assert!((distance([4.0, 0.0, 4.0], share) / (2.0 * plane) - 1.0).abs() < 1e-9);
        }
        // The quantile of χ with three degrees of freedom, by scipy.stats.chi.ppf.
        assert!((distance([1e-6; 3], 0.95) - 2.7954834829151074e-3).abs() < 1e-12);
    }

    /// The mean over directions of an octant by 200 x 200 points with SciPy (`chi2.cdf`, `brentq`).
    #[test]
    fn distances_of_unequal_variances_are_those_of_another_rule() {
        for (variances, reference) in [
            ([1.0, 0.5, 0.0], 2.151344464921418),
            ([1e-4, 1.0, 1e-3], 1.9602447443445652),
            ([0.3, 0.01, 1.0], 2.05780561640175),
            ([1.0, 0.9, 0.001], 2.3868023864433168),
        ] {
            let found = distance(variances, 0.95);
            assert!((found - reference).abs() < 1e-9, "{variances:?}: {found} {reference}");
        }
    }

    #[test]
    fn derivatives_by_variances_are_differences_and_scale_with_the_size() {
        let variances = [2.0, 0.7, 0.1];
        let found = normal_distance(variances, 0.95).unwrap();
        for i in 0..3 {
            let moved = |by: f64| {
                let mut moved = variances;
                moved[i] += by;
                distance(moved, 0.95)
            };
            let difference = (moved(1e-5) - moved(-1e-5)) / 2e-5;
            assert!((found.per_variance[i] - difference).abs() < 1e-8, "{i}: {found:?} {difference}");
        }
        // Euler: r is of degree 1/2 in the variances.
        let sum: f64 = found.per_variance.iter().zip(variances).map(|(slope, x)| slope * x).sum();
        assert!((sum / (0.5 * found.distance) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn what_is_no_variance_and_no_share_is_refused_and_nothing_moves_without_variance() {
        assert_eq!(distance([0.0; 3], 0.95), 0.0);
        assert!(normal_distance([1.0, -1.0, 0.0], 0.95).is_err());
        assert!(normal_distance([1.0, f64::NAN, 0.0], 0.95).is_err());
        assert!(normal_distance([1.0; 3], 1.0).is_err() && normal_distance([1.0; 3], 0.5).is_err());
    }
}
