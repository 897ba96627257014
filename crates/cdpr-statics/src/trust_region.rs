//! Minimisation of the potential energy over the poses, for starts from which Newton's method does not converge.
//!
//! With every cable in its own equilibrium (which is unique), an equilibrium of the platform is a stationary point of
//!
//! ```text
//! Π(p, R) = sum V_i(p + R a_i - b_i) - F·p - F_w·R c
//! ```
//!
//! and a stable one a minimum. A trust region on Π in the variables (dp, ρ dφ), ρ the platform's size, goes downhill from
//! any start; its model is the Hessian of `newton`, and its subproblem is solved in the eigenvectors of that Hessian
//! (Conn, Gould, Toint, *Trust-Region Methods*, 2000, section 7.3). A moment of constant components has no potential; the
//! work it does over each step stands in for one.

use crate::direct::Residual;
use crate::error::StaticsError;
use crate::model::{Equilibrium, Model};
use crate::newton::{Balance, Converged, newton};
use cdpr_cable::end_force;
use cdpr_robot::{Pose, Vector2, Vector3, Vector6};
use nalgebra::{Matrix6, SymmetricEigen};

const MAX_ITERATIONS: usize = 1000;

/// A pose with its cables in equilibrium.
struct Point {
    equilibrium: Equilibrium,
    /// Potential without the work of the load's moment [J].
    potential: f64,
    /// In (dp, ρ dφ) [N].
    gradient: Vector6<f64>,
    /// In (dp, ρ dφ) [N/m].
    hessian: Matrix6<f64>,
}

/// The forces of all cables at a pose, each in its own equilibrium.
pub(crate) fn cables_at(model: &Model, pose: &Pose) -> Result<Equilibrium, StaticsError> {
    let cable_forces = (0..model.cables())
        .map(|i| {
            let solution = end_force(&model.cable(i), model.lengths[i], model.span(pose, i).end);
            solution.map(|s| s.catenary.force).map_err(StaticsError::cable(i))
        })
        .collect::<Result<_, _>>()?;
    Ok(Equilibrium { pose: *pose, cable_forces })
}

impl Point {
    fn new(model: &Model, pose: &Pose) -> Result<Self, StaticsError> {
        let equilibrium = cables_at(model, pose)?;
        let mut balance = Balance::of_load(model, pose);
        let weight = model.robot.weight(pose, model.load.payload).force;
        let center = pose.rotation * model.robot.platform.center_of_mass;
        let mut potential = -(weight + model.load.wrench.force).dot(&pose.position) - weight.dot(&center);
        for (i, force) in equilibrium.cable_forces.iter().enumerate() {
            let span = model.span(pose, i);
            let catenary = model.catenary(i, *force);
            potential += catenary.potential_energy();
            let s = model.robot.anchor_arm(pose, i);
            balance.add_cable(&s, &span.lift(*force), &catenary.stiffness(span.azimuth));
        }
        let scale = scale(model);
        Ok(Self {
            equilibrium,
            potential,
            gradient: balance.gradient.component_mul(&scale),
            hessian: balance.symmetric_hessian().component_mul(&(scale * scale.transpose())),
        })
    }
}

/// From (dp, ρ dφ) to (dp, dφ).
fn scale(model: &Model) -> Vector6<f64> {
    let turn = 1.0 / model.arm();
    Vector6::new(1.0, 1.0, 1.0, turn, turn, turn)
}

/// The minimum of the potential that lies downhill of `start`.
pub(crate) fn minimise(model: &Model, start: &Pose) -> Result<Converged, StaticsError> {
    let size = model.size();
    let scale = scale(model);
    let mut now = Point::new(model, start)?;
    let mut radius = 0.05 * size;
    for iteration in 1..=MAX_ITERATIONS {
        let tensions: f64 = now.equilibrium.cable_forces.iter().map(Vector2::norm).sum();
        if now.gradient.norm() <= 1e-4 * tensions
            && let Some(polished) = newton(model, now.equilibrium.clone())
        {
            let away = now.equilibrium.pose.motion_to(&polished.equilibrium.pose).component_div(&scale);
            if away.norm() <= radius.max(1e-3 * size) {
                return Ok(Converged { iterations: iteration + polished.iterations, ..polished });
            }
        }
        let (step, predicted) = subproblem(&now.gradient, &now.hessian, radius);
        let motion = step.component_mul(&scale);
        let (dp, dphi): (Vector3<f64>, Vector3<f64>) =
            (motion.fixed_rows::<3>(0).into(), motion.fixed_rows::<3>(3).into());
        let Ok(next) = Point::new(model, &now.equilibrium.pose.moved(dp, dphi)) else {
            // A trial pose at which a cable has no answer is none.
            radius = 0.25 * step.norm();
            continue;
        };
        let gain = now.potential - next.potential + model.load.wrench.moment.dot(&dphi);
        let noise = 1e-13 * (now.potential.abs() + next.potential.abs());
        // Where the gain drowns in rounding, the gradient decides.
        let ratio = if predicted <= 10.0 * noise {
            if next.gradient.norm() < now.gradient.norm() { 1.0 } else { 0.0 }
        } else {
            gain / predicted
        };
        if ratio < 0.25 {
            radius = 0.25 * step.norm();
        } else if ratio > 0.75 && step.norm() > 0.9 * radius {
            radius = (2.0 * radius).min(size);
        }
        if ratio > 1e-4 {
            now = next;
        }
        if radius <= 1e-15 * size {
            return Err(not_converged(model, &now, iteration));
        }
    }
    Err(not_converged(model, &now, MAX_ITERATIONS))
}

fn not_converged(model: &Model, best: &Point, iterations: usize) -> StaticsError {
    StaticsError::DirectNotConverged {
        iterations,
        pose: Box::new(best.equilibrium.pose),
        residual: Residual::of(model, &best.equilibrium),
    }
}

/// The step that minimises `g·x + ½ xᵀHx` over `|x| <= radius`, and the decrease it promises.
fn subproblem(gradient: &Vector6<f64>, hessian: &Matrix6<f64>, radius: f64) -> (Vector6<f64>, f64) {
    let eigen = SymmetricEigen::new(*hessian);
    let (values, vectors) = (eigen.eigenvalues, eigen.eigenvectors);
    let g = vectors.transpose() * gradient;
    let at = |shift: f64| g.zip_map(&values, |g, value| -g / (value + shift));
    let least = values.min();
    let largest = values.amax();
    let floor = (-least).max(0.0) + 1e-12 * largest;
    let mut x = at(if least > 1e-12 * largest { 0.0 } else { floor });
    if x.norm() > radius {
        // |x(shift)| falls from above the radius to below it.
        let (mut low, mut high) =
            (if least > 1e-12 * largest { 0.0 } else { floor }, floor + g.norm() / radius);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if at(middle).norm() > radius {
                low = middle;
            } else {
                high = middle;
            }
        }
        x = at(high);
    } else if least < -1e-12 * largest {
        // Negative curvature and no slope along it: go to the edge of the region in that direction.
        let direction = values.imin();
        let rest = x.norm_squared() - x[direction] * x[direction];
        x[direction] = (radius * radius - rest).max(0.0).sqrt().copysign(-g[direction]);
    }
    let predicted = -(g.dot(&x) + 0.5 * x.component_mul(&values).dot(&x));
    (vectors * x, predicted)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_subproblem_is_newtons_step_inside_and_steepest_at_the_edge() {
        let hessian = Matrix6::from_diagonal(&Vector6::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0));
        let gradient = Vector6::new(1.0, -2.0, 3.0, -4.0, 5.0, -6.0);
        let (inside, gain) = subproblem(&gradient, &hessian, 10.0);
        assert!((inside - Vector6::new(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0)).norm() < 1e-12);
        assert!((gain - 10.5).abs() < 1e-12);
        let (edge, _) = subproblem(&gradient, &hessian, 1e-3);
        assert!((edge.norm() - 1e-3).abs() < 1e-12);
        assert!((edge.normalize() + gradient.normalize()).norm() < 1e-2);
    }

    #[test]
    fn negative_curvature_leads_to_the_edge_even_without_slope() {
        let hessian = Matrix6::from_diagonal(&Vector6::new(-1.0, 2.0, 3.0, 4.0, 5.0, 6.0));
        let (step, gain) = subproblem(&Vector6::zeros(), &hessian, 0.5);
        assert!((step.norm() - 0.5).abs() < 1e-9 && (step.x.abs() - 0.5).abs() < 1e-9);
        assert!((gain - 0.125).abs() < 1e-9);
    }
}
