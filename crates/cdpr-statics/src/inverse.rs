//! Inverse elasto-geometrical model (IEGM, section 3.1 of the paper): unstrained lengths that hold a pose.
//!
//! Eq. (1) to (3) hold together: the tension distribution needs the directions of the cables at the platform,
//! which the sag changes, and the sag follows from the tensions. With `w_i(t_i) = [u_i; s_i x u_i]` the
//! wrench of a unit tension along the end tangent of cable i,
//!
//! ```text
//! t_i = t_ref,i - w_i·λ,      sum w_i t_i + w_ex = 0                                              (I1)
//! ```
//!
//! is the distribution without active bounds. Newton's method on (t, λ) needs `c_i = d(w_i t_i)/dt_i` of the
//! catenary between its held ends. With `D_i = 1 + dw_i/dt_i·λ = 1 + (c_i - w_i)·λ/t_i` and the residuals
//! `R1_i = t_i - t_ref,i + w_i·λ` and `R2 = sum w_i t_i + w_ex` of (I1), a step is
//!
//! ```text
//! [ sum c_i w_iᵀ/D_i ] dλ = R2 - sum c_i R1_i/D_i,      dt_i = -(R1_i + w_i·dλ)/D_i               (I2)
//! ```
//!
//! A cable that rests on a bound keeps its tension and leaves (I2). Which cables do is found by iteration: a
//! distribution for the directions at hand, then Newton's method with its active bounds. Where that does not
//! end at an optimum within the bounds, its directions, or those of the distribution's tensions, start the
//! next iteration.
//!
//! The least tension of a cable is the robot's, or what its own weight demands over its span where that is
//! more.

use crate::equations::{Span, wrench};
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Load, Residual};
use cdpr_cable::{CableError, Catenary, length_for_tension, length_for_tension_near};
use cdpr_robot::{Pose, Robot, TensionLimits, Vector2, Vector3, Vector6};
use cdpr_tension::{Bound, Distribution, Problem, distribute};
use nalgebra::Matrix6;

/// Unstrained lengths that hold a pose in balance.
#[derive(Clone, Debug, PartialEq)]
pub struct InverseSolution {
    /// Unstrained length of every cable [m].
    pub lengths: Vec<f64>,
    /// Tension of every cable at the platform [N].
    pub tensions: Vec<f64>,
    /// The bound each tension rests on, if any.
    pub active: Vec<Option<Bound>>,
    /// The pose with the cables' forces.
    pub equilibrium: Equilibrium,
    /// Iterations of distribution and Newton's method: 1 unless the active bounds had to be looked for.
    pub iterations: usize,
    /// Residuals of all equations.
    pub residual: Residual,
}

const MAX_ITERATIONS: usize = 100;
const MAX_NEWTON: usize = 12;

/// Factor on the least tension that a span demands: at the least tension itself the length is not determined.
pub(crate) const ABOVE_LEAST: f64 = 1.001;

/// The unstrained lengths with which the platform rests at `pose` under its weight and `load`.
///
/// Within the robot's limits the tensions are as near as possible to `reference` [N], one for each cable;
/// `None` asks for the least-norm tensions.
///
/// # Errors
/// - [`StaticsError::Tension`] where no tensions within the limits hold the pose.
/// - [`StaticsError::Cable`] where a cable's own weight demands more than the greatest tension.
/// - [`StaticsError::Invalid`] for a pose, load or reference that is not finite, or a reference of another
///   number of cables.
/// - [`StaticsError::InverseNotConverged`] where tensions and directions of the cables do not settle
///   together.
pub fn inverse(
    robot: &Robot,
    pose: &Pose,
    load: &Load,
    reference: Option<&[f64]>,
) -> Result<InverseSolution, StaticsError> {
    let n = robot.cables.len();
    load.validate()?;
    if !pose.is_finite() {
        let position = format!("{:?}", pose.position.as_slice());
        return Err(StaticsError::invalid("pose".to_owned(), position, "a finite pose"));
    }
    if let Some(i) = (0..n).find(|i| robot.span(pose, *i).norm() == 0.0) {
        return Err(StaticsError::invalid(
            format!("cables[{i}].exit_point"),
            format!("{:?}", robot.cables[i].exit_point.as_slice()),
            "a point away from the cable's anchor point at this pose",
        ));
    }
    let zeros = vec![0.0; n];
    let reference = reference.unwrap_or(&zeros);
    StaticsError::one_per_cable("reference", reference, n)?;
    Inverse { robot, pose, load, reference }.solve()
}

/// What the inverse model is asked.
struct Inverse<'a> {
    robot: &'a Robot,
    pose: &'a Pose,
    load: &'a Load,
    reference: &'a [f64],
}

impl<'a> Inverse<'a> {
    fn cables(&self) -> usize {
        self.reference.len()
    }

    fn wrench(&self) -> Vector6<f64> {
        self.load.total(self.robot, self.pose).to_vector()
    }

    fn spans(&self) -> Vec<Span<f64>> {
        (0..self.cables()).map(|i| Span::new(self.robot.span(self.pose, i).into())).collect()
    }

    /// Wrench about P of a force (fx, fz) on cable i.
    fn wrench_of(&self, i: usize, span: &Span<f64>, force: Vector2<f64>) -> Vector6<f64> {
        let force = span.plane.force_on_platform(force.into());
        wrench(&self.robot.anchor_arm(self.pose, i), &force.into())
    }

    fn solution(
        &self,
        catenaries: &[Catenary],
        tensions: Vec<f64>,
        active: Vec<Option<Bound>>,
        iterations: usize,
    ) -> Result<InverseSolution, StaticsError> {
        let HeldPose { lengths, equilibrium } = HeldPose::new(self.pose, catenaries);
        let residual = Residual::of(&DirectProblem::new(self.robot, &lengths, self.load)?, &equilibrium);
        Ok(InverseSolution { lengths, tensions, active, equilibrium, iterations, residual })
    }

    fn solve(&self) -> Result<InverseSolution, StaticsError> {
        let wrench = self.wrench();
        let spans = self.spans();
        let mut limits = vec![self.robot.tension_limits; self.cables()];
        let mut pulls: Vec<Vector3<f64>> =
            (0..self.cables()).map(|i| -self.robot.span(self.pose, i).normalize()).collect();
        let mut unbalanced = wrench;
        for iteration in 1..=MAX_ITERATIONS {
            let wrench_matrix = self.robot.wrench_matrix(self.pose, &pulls);
            let problem =
                Problem { wrench_matrix: &wrench_matrix, wrench, reference: self.reference, limits: &limits };
            let distribution = distribute(&problem)
                .map_err(|source| StaticsError::Tension { position: self.pose.position.into(), source })?;
            let end = match self.newton(&spans, &limits, &distribution)? {
                Outcome::Lost => self.catenaries(&spans, &distribution.tensions)?,
                end => end,
            };
            match end {
                Outcome::Solved { catenaries, tensions } => {
                    return self.solution(&catenaries, tensions, distribution.active, iteration);
                }
                Outcome::TooSmall { cable, least } => {
                    let TensionLimits { min, max } = &mut limits[cable];
                    if ABOVE_LEAST * least > *max {
                        let source = CableError::TensionTooSmall { tension: *max, least };
                        return Err(StaticsError::Cable { index: cable, source });
                    }
                    *min = min.max(ABOVE_LEAST * least);
                }
                Outcome::Catenaries(catenaries) => {
                    for ((pull, span), catenary) in pulls.iter_mut().zip(&spans).zip(&catenaries) {
                        let force = Vector3::from(span.plane.force_on_platform(catenary.force.into()));
                        let tangent = force / catenary.anchor_tension();
                        // The first iterations go all the way; later ones are damped, in case they oscillate.
                        let share = if iteration <= 5 { 1.0 } else { 0.5 };
                        *pull = (*pull * (1.0 - share) + tangent * share).normalize();
                    }
                    let matrix = self.robot.wrench_matrix(self.pose, &pulls);
                    unbalanced =
                        wrench + matrix * nalgebra::DVector::from_column_slice(&distribution.tensions);
                }
                Outcome::Lost => {}
            }
        }
        Err(StaticsError::InverseNotConverged {
            iterations: MAX_ITERATIONS,
            force: unbalanced.fixed_rows::<3>(0).norm(),
            moment: unbalanced.fixed_rows::<3>(3).norm(),
        })
    }

    /// All catenaries at given tensions, or the first cable whose span demands more.
    fn catenaries(&self, spans: &[Span<f64>], tensions: &[f64]) -> Result<Outcome<'a>, StaticsError> {
        let mut catenaries = Vec::with_capacity(spans.len());
        for (i, (span, t)) in spans.iter().zip(tensions).enumerate() {
            match length_for_tension(&self.robot.cable(i), span.end.into(), *t) {
                Ok(solution) => catenaries.push(solution.catenary),
                Err(CableError::TensionTooSmall { least, .. }) => {
                    return Ok(Outcome::TooSmall { cable: i, least });
                }
                Err(error) => return Err(StaticsError::cable(i)(error)),
            }
        }
        Ok(Outcome::Catenaries(catenaries))
    }

    /// Newton's method on (I1) with the distribution's active bounds, from its tensions.
    fn newton(
        &self,
        spans: &[Span<f64>],
        limits: &[TensionLimits],
        distribution: &Distribution,
    ) -> Result<Outcome<'a>, StaticsError> {
        let wrench = self.wrench();
        let mut tensions = distribution.tensions.clone();
        let mut multipliers = Vector6::zeros();
        let mut catenaries = match self.catenaries(spans, &tensions)? {
            Outcome::Catenaries(catenaries) => catenaries,
            other => return Ok(other),
        };
        let mut residual_before = f64::INFINITY;
        for round in 0..MAX_NEWTON {
            if round > 0 {
                for (i, ((span, t), place)) in spans.iter().zip(&tensions).zip(&mut catenaries).enumerate() {
                    if distribution.active[i].is_none() {
                        match length_for_tension_near(place, span.end.into(), *t) {
                            Ok(solution) => *place = solution.catenary,
                            // A step too far: the tension at the end need not be too small.
                            Err(_) => return Ok(Outcome::Lost),
                        }
                    }
                }
            }
            let mut balance = wrench;
            let mut largest = 0.0_f64;
            let (mut matrix, mut right) = (Matrix6::zeros(), Vector6::zeros());
            let mut cables = Vec::with_capacity(self.cables());
            for (i, (span, t)) in spans.iter().zip(&tensions).enumerate() {
                let direction = catenaries[i].force / *t;
                let w = self.wrench_of(i, span, direction);
                let left = t - self.reference[i] + w.dot(&multipliers);
                balance += w * *t;
                let mut d = f64::INFINITY;
                if distribution.active[i].is_none() {
                    let per_length = catenaries[i].compliance().force_per_length();
                    let c = self.wrench_of(i, span, per_length / per_length.dot(&direction));
                    d = 1.0 + (c - w).dot(&multipliers) / *t;
                    let share = c / d;
                    matrix += share * w.transpose();
                    right -= share * left;
                    largest = largest.max(left.abs());
                }
                cables.push((w, left, d));
            }
            let size = wrench.norm() + tensions.iter().sum::<f64>();
            let residual = balance.norm().max(largest);
            // Each round squares the residual, until rounding ends it.
            if residual <= 1e-14 * size || (residual <= 1e-10 * size && residual >= 0.5 * residual_before) {
                let optimal = (0..self.cables()).all(|i| match distribution.active[i] {
                    None => limits[i].min <= tensions[i] && tensions[i] <= limits[i].max,
                    Some(Bound::Min) => cables[i].1 >= -1e-9 * size,
                    Some(Bound::Max) => cables[i].1 <= 1e-9 * size,
                });
                return Ok(if optimal {
                    Outcome::Solved { catenaries, tensions }
                } else {
                    Outcome::Catenaries(catenaries)
                });
            }
            residual_before = residual;
            let Some(step) = matrix.lu().solve(&(right + balance)) else { return Ok(Outcome::Lost) };
            multipliers += step;
            for (t, (w, left, d)) in tensions.iter_mut().zip(&cables) {
                *t -= (left + w.dot(&step)) / d;
            }
        }
        Ok(Outcome::Lost)
    }
}

/// How one iteration of the inverse model ends.
enum Outcome<'a> {
    /// The optimum to rounding.
    Solved { catenaries: Vec<Catenary<'a>>, tensions: Vec<f64> },
    /// Catenaries whose directions give a better distribution.
    Catenaries(Vec<Catenary<'a>>),
    /// A cable whose span demands at least this tension [N].
    TooSmall { cable: usize, least: f64 },
    /// Newton's method failed, and nothing is known.
    Lost,
}

/// Unstrained lengths that hold the platform at a pose; held there it need not be in balance.
#[derive(Clone, Debug, PartialEq)]
pub struct HeldPose {
    /// Unstrained length of every cable [m].
    pub lengths: Vec<f64>,
    /// The pose with the cables' forces.
    pub equilibrium: Equilibrium,
}

impl HeldPose {
    fn new(pose: &Pose, catenaries: &[Catenary]) -> Self {
        let lengths = catenaries.iter().map(|catenary| catenary.unstrained_length).collect();
        let cable_forces = catenaries.iter().map(|catenary| catenary.force).collect();
        Self { lengths, equilibrium: Equilibrium { pose: *pose, cable_forces } }
    }
}

/// The unstrained lengths that give each cable the tension `tensions[i]` [N] at the platform, held at `pose`.
///
/// A cable whose own weight demands more over its span gets the least tension that it demands.
///
/// # Errors
/// [`StaticsError::Invalid`] unless there is one tension for each cable; [`StaticsError::Cable`] for a
/// tension that is not positive and finite.
pub fn lengths_for_tensions(robot: &Robot, pose: &Pose, tensions: &[f64]) -> Result<HeldPose, StaticsError> {
    StaticsError::one_per_cable("tensions", tensions, robot.cables.len())?;
    let solutions = tensions.iter().enumerate().map(|(i, tension)| {
        let (cable, end) = (robot.cable(i), Span::new(robot.span(pose, i).into()).end.into());
        let solution = match length_for_tension(&cable, end, *tension) {
            Err(CableError::TensionTooSmall { least, .. }) => {
                length_for_tension(&cable, end, ABOVE_LEAST * least)
            }
            solution => solution,
        };
        solution.map(|solution| solution.catenary).map_err(StaticsError::cable(i))
    });
    Ok(HeldPose::new(pose, &solutions.collect::<Result<Vec<_>, _>>()?))
}
