//! Minimization of the potential energy over the poses, for starts from which Newton's method does not
//! converge.
//!
//! With every cable in its own equilibrium (which is unique), an equilibrium of the platform is a stationary
//! point of
//!
//! ```text
//! Π(p, R) = sum V_i(p + R a_i - b_i) - F·p - F_w·R c
//! ```
//!
//! and a stable one a minimum. A trust region on Π in the variables (dp, l dφ), with l half of the robot's
//! size, goes downhill from any start. Its model is the Hessian (S5), and its subproblem is solved in the
//! eigenvectors of that Hessian (Conn, Gould, Toint, *Trust-Region Methods*, 2000, section 7.3). The length l
//! limits rotations: a region that allows steps of a tenth of the robot rotates the platform by a fifth of a
//! radian at most, which keeps the search in the valley where it started.
//!
//! Taut cables make valleys that are steep across and curved along. A step that goes uphill may therefore be
//! followed by two more before it is accepted or taken back (a non-monotone method, their chapter 10): steps
//! along the valley are then several times longer.
//!
//! A moment of constant components has no potential; the work that it does over each step takes the place of
//! one.

use crate::direct::newton::{Converged, newton, pinned_newton};
use crate::direct::subproblem::subproblem;
use crate::equations::{Balance, SpannedCable, cables_at, per_length};
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Residual};
use cdpr_robot::{Pose, Vector2, Vector6};
use nalgebra::Matrix6;

const MAX_ITERATIONS: usize = 3000;

/// Radius of the first region, relative to the robot's size.
const FIRST_RADIUS: f64 = 0.05;

/// Number of steps that may follow an uphill one before it is taken back.
const SECOND_LOOKS: usize = 2;

/// Resistance below this share of the greatest one may be none at all.
const NEARLY_NEUTRAL: f64 = 1e-9;

/// A slope below this share of the tensions may be rounding.
const ROUNDED_SLOPE: f64 = 1e-10;

/// A pose with its cables in equilibrium.
struct Point {
    equilibrium: Equilibrium,
    /// Potential without the work of the load's moment [J].
    potential: f64,
    /// Rounding error of the potential [J].
    noise: f64,
    /// Gradient in (dp, l dφ) [N].
    gradient: Vector6<f64>,
    /// Hessian in (dp, l dφ) [N/m].
    hessian: Matrix6<f64>,
}

impl Point {
    fn new(problem: &DirectProblem, equilibrium: Equilibrium) -> Self {
        let pose = &equilibrium.pose;
        let mut balance = Balance::of_load(problem, pose);
        let weight = problem.robot.weight(pose, problem.load.payload).force;
        let center = pose.rotation * problem.robot.platform.center_of_mass;
        let mut potential = -(weight + problem.load.wrench.force).dot(&pose.position) - weight.dot(&center);
        let mut noise = f64::EPSILON * potential.abs();
        for (i, force) in equilibrium.cable_forces.iter().enumerate() {
            let catenary = problem.catenary(i, *force);
            let cable = SpannedCable::of(problem.robot, pose, i, &catenary);
            let Some(linearized) = cable.linearized() else { continue };
            potential += problem.catenary_at(pose, i, *force).potential_energy();
            // The span itself is rounded, and the force is the slope of the energy over it.
            noise += f64::EPSILON * force.norm() * (cable.span.chord() + pose.position.norm());
            let stiffness = linearized.stiffness().into();
            balance.add_cable(&cable.anchor_arm, &cable.force_on_platform(), &stiffness);
        }
        let freedoms = problem.robot.freedoms();
        let scale = scale(problem);
        Self {
            gradient: balance.free_gradient(freedoms).component_mul(&scale),
            hessian: balance.symmetric_hessian(freedoms).component_mul(&(scale * scale.transpose())),
            potential,
            noise,
            equilibrium,
        }
    }

    /// The point a step (dp, l dφ) away, or which cable has no equilibrium there.
    fn moved(&self, problem: &DirectProblem, step: &Vector6<f64>) -> Result<Self, StaticsError> {
        let motion = problem.robot.freedoms().of_vector(&step.component_mul(&scale(problem)));
        let pose =
            self.equilibrium.pose.moved(motion.fixed_rows::<3>(0).into(), motion.fixed_rows::<3>(3).into());
        let solve = |(i, force): (usize, &Vector2<f64>)| {
            problem.force_at(&pose, i, Some((&self.equilibrium.pose, force))).map_err(StaticsError::cable(i))
        };
        let cable_forces =
            self.equilibrium.cable_forces.iter().enumerate().map(solve).collect::<Result<_, _>>()?;
        Ok(Self::new(problem, Equilibrium { pose, cable_forces }))
    }

    /// By how much the potential falls, less the work of the load's moment, on the way to `next` by `step`.
    fn gain(&self, problem: &DirectProblem, next: &Self, step: &Vector6<f64>) -> f64 {
        let noise = self.noise + next.noise;
        let moment = problem.load.wrench.moment * scale(problem)[3];
        let gain = self.potential - next.potential + moment.dot(&step.fixed_rows::<3>(3));
        if gain.abs() > 100.0 * noise {
            return gain;
        }
        // Where rounding hides the difference, the slopes at both ends give it.
        -0.5 * (self.gradient + next.gradient).dot(step)
    }
}

/// From (dp, l dφ) to (dp, dφ).
fn scale(problem: &DirectProblem) -> Vector6<f64> {
    per_length(0.5 * problem.size())
}

/// The minimum of the potential that lies downhill of `start`.
pub(crate) fn minimize(problem: &DirectProblem, start: &Pose) -> Result<Converged, StaticsError> {
    let size = problem.size();
    let mut now = Point::new(problem, cables_at(problem, start)?);
    let mut radius = FIRST_RADIUS * size;
    let mut polish_below = f64::INFINITY;
    for iteration in 1..=MAX_ITERATIONS {
        let slope = now.gradient.norm();
        let tensions: f64 = now.equilibrium.cable_forces.iter().map(Vector2::norm).sum();
        if slope <= (1e-4 * tensions).min(polish_below) {
            // The slope of a saddle is rounding, too.
            polish_below = (0.1 * slope).max(ROUNDED_SLOPE * tensions);
            if let Some(minimum) = polish(problem, &now, radius) {
                return Ok(Converged { iterations: iteration + minimum.iterations, ..minimum });
            }
        }
        let (step, predicted) = subproblem(&now.gradient, &now.hessian, radius);
        if predicted.is_nan() || predicted <= 0.0 {
            // Neither slope nor negative curvature, or NaN: there is nowhere to go.
            return Err(not_converged(problem, &now, iteration));
        }
        let mut next = match now.moved(problem, &step) {
            Ok(next) => next,
            // Downhill lie poses at which a cable has no shape.
            Err(error) if step.norm() <= 1e-12 * size => return Err(error),
            Err(_) => {
                radius = 0.25 * step.norm();
                continue;
            }
        };
        let mut gain = now.gain(problem, &next, &step);
        // In a curved valley a step leaves the floor, and further steps of the same kind return to it.
        for _ in 0..SECOND_LOOKS {
            if gain >= 0.25 * predicted {
                break;
            }
            let (second, _) = subproblem(&next.gradient, &next.hessian, radius);
            let Ok(after) = next.moved(problem, &second) else { break };
            gain += next.gain(problem, &after, &second);
            next = after;
        }
        if gain < 0.25 * predicted {
            radius = 0.25 * step.norm();
        } else if gain > 0.75 * predicted && step.norm() > 0.9 * radius {
            radius = (2.0 * radius).min(size);
        }
        if gain > 1e-4 * predicted {
            now = next;
        }
        if radius <= 1e-15 * size {
            return Err(not_converged(problem, &now, iteration));
        }
    }
    Err(not_converged(problem, &now, MAX_ITERATIONS))
}

/// The minimum that Newton's method finds from a point, if what it finds is a minimum and near.
fn polish(problem: &DirectProblem, point: &Point, radius: f64) -> Option<Converged> {
    let nearly_neutral = || {
        let eigenvalues = point.hessian.symmetric_eigenvalues();
        eigenvalues.min() <= NEARLY_NEUTRAL * eigenvalues.amax()
    };
    let minimum = newton(problem, point.equilibrium.clone())
        .or_else(|| nearly_neutral().then(|| pinned_newton(problem, point.equilibrium.clone())).flatten())?;
    let motion = point.equilibrium.pose.motion_to(&minimum.equilibrium.pose);
    let away = motion.component_div(&scale(problem)).norm();
    (minimum.stability.is_stable() && away <= radius.max(1e-3 * problem.size())).then_some(minimum)
}

fn not_converged(problem: &DirectProblem, last: &Point, iterations: usize) -> StaticsError {
    let pose = Box::new(last.equilibrium.pose);
    let residual = Residual::of(problem, &last.equilibrium);
    let resistance = problem.robot.freedoms().block(&last.hessian).symmetric_eigenvalues();
    let is_indifferent = resistance.amin() <= NEARLY_NEUTRAL * resistance.amax();
    if is_indifferent && residual.is_rounding(problem, &last.equilibrium) {
        return StaticsError::Indifferent { pose };
    }
    StaticsError::DirectNotConverged { iterations, pose, residual }
}
