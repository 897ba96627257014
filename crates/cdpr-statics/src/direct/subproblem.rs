//! The subproblem of the trust region.

use nalgebra::{Matrix6, SymmetricEigen, Vector6};

/// The step that minimizes `g·x + ½ xᵀHx` over `|x| <= radius`, and the decrease that it predicts.
pub(crate) fn subproblem(
    gradient: &Vector6<f64>,
    hessian: &Matrix6<f64>,
    radius: f64,
) -> (Vector6<f64>, f64) {
    let eigen = SymmetricEigen::new(*hessian);
    let (values, vectors) = (eigen.eigenvalues, eigen.eigenvectors);
    let g = vectors.transpose() * gradient;
    let at = |shift: f64| g.zip_map(&values, |g, value| -g / (value + shift));
    let least = values.min();
    let largest = values.amax();
    if largest == 0.0 {
        // Nothing resists yet, as where all cables are slack: straight downhill to the edge.
        let step = -gradient * (radius / gradient.norm());
        return (step, -gradient.dot(&step));
    }
    let floor = (-least).max(0.0) + 1e-12 * largest;
    let mut x = at(if least > 1e-12 * largest { 0.0 } else { floor });
    if x.norm() > radius {
        // 1/|x(shift)| is almost linear in the shift: Newton's method for |x| = radius, kept between two
        // bounds.
        let (mut low, mut high) =
            (if least > 1e-12 * largest { 0.0 } else { floor }, floor + g.norm() / radius);
        let mut shift = low;
        for _ in 0..50 {
            x = at(shift);
            let length = x.norm();
            if (length - radius).abs() <= 1e-3 * radius {
                break;
            }
            if length > radius {
                low = shift;
            } else {
                high = shift;
            }
            let slope = x.zip_map(&values, |x, value| x * x / (value + shift)).sum();
            let newton = shift + length * length / slope * (length - radius) / radius;
            shift = if low < newton && newton < high { newton } else { 0.5 * (low + high) };
        }
    } else if least < -1e-12 * largest {
        // Negative curvature and no slope along it: go to the edge of the region in that direction.
        let direction = values.imin();
        let rest = x.norm_squared() - x[direction] * x[direction];
        x[direction] = (radius * radius - rest).max(0.0).sqrt().copysign(-g[direction]);
    }
    let predicted = -(g.dot(&x) + 0.5 * x.component_mul(&values).dot(&x));
    (vectors * x, predicted)
}
