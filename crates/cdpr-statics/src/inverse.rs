//! Inverse elasto-geometrical model (IEGM): unstrained lengths that hold a pose.
//!
//! Eq. (1)-(3) hold together: the tension distribution needs the directions of the cables at the platform, which sag turns,
//! and the sag follows from the tensions. With `w_i(t_i)` the wrench of a unit tension in cable i along its end tangent,
//!
//! ```text
//! t_i = t_ref,i - w_i·λ,      sum w_i t_i + w_ex = 0                                              (a)
//! ```
//!
//! is the distribution without active bounds. Newton's method on (t, λ) needs `w_i' = dw_i/dt_i` from the catenary between
//! its held ends; with `D_i = 1 + w_i'·λ`, `c_i = w_i + t_i w_i'` and the left-overs `F1`, `F2` of (a)
//!
//! ```text
//! [ sum c_i w_iᵀ/D_i ] dλ = F2 - sum c_i F1_i/D_i,      dt_i = -(F1_i + w_i·dλ)/D_i               (b)
//! ```
//!
//! A cable that rests on a bound keeps its tension and leaves (b). Which cables do is found by turns: a distribution for the
//! directions at hand, then Newton's method with its active bounds; where that does not end at an optimum within the
//! bounds, its directions, or those of the distribution's tensions, make the next turn.
//!
//! The least tension of a cable is the robot's, or what its own weight demands over its span where that is more.

use crate::equations::{Span, wrench};
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Load, Residual};
use cdpr_cable::{CableError, Catenary, length_for_tension, length_for_tension_near};
use cdpr_robot::{Pose, Robot, TensionLimits, Vector2, Vector3, Vector6};
use cdpr_tension::{Bound, Distribution, Problem, distribute};
use nalgebra::Matrix6;

/// Lengths that hold a pose.
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

const MAX_TURNS: usize = 100;
const MAX_NEWTON: usize = 12;

/// A tension this much above the least that a span demands: at the least itself, the length is not determined.
pub(crate) const ABOVE_LEAST: f64 = 1.001;

/// The unstrained lengths with which the platform rests at `pose` under its weight and `load`, with tensions as near as
/// possible to `reference` [N] (one for each cable) within the robot's limits; `None` for the least-norm tensions.
///
/// # Errors
/// [`StaticsError::Tension`] where no tensions within the limits hold the pose; [`StaticsError::Cable`] where a cable's own
/// weight demands more than the greatest tension; [`StaticsError::Invalid`] for a pose or reference that is none;
/// [`StaticsError::InverseNotConverged`].
pub fn inverse(
    robot: &Robot,
    pose: &Pose,
    load: &Load,
    reference: Option<&[f64]>,
) -> Result<InverseSolution, StaticsError> {
    let n = robot.cables.len();
    load.validate()?;
    if !pose.is_finite() {
        return Err(StaticsError::Invalid {
            field: "pose".to_owned(),
            value: format!("{:?}", pose.position.as_slice()),
            expected: "a finite pose".to_owned(),
        });
    }
    if let Some(i) = (0..n).find(|i| robot.span(pose, *i).norm() == 0.0) {
        return Err(StaticsError::Invalid {
            field: format!("cables[{i}].exit_point"),
            value: format!("{:?}", robot.cables[i].exit_point.as_slice()),
            expected: "a point away from the cable's anchor point at this pose".to_owned(),
        });
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
        let (lengths, equilibrium) = lengths_and_forces(self.pose, catenaries);
        let residual = Residual::of(&DirectProblem::new(self.robot, &lengths, self.load)?, &equilibrium);
        Ok(InverseSolution { lengths, tensions, active, equilibrium, iterations, residual })
    }

    fn solve(&self) -> Result<InverseSolution, StaticsError> {
        let wrench = self.wrench();
        let spans = self.spans();
        let mut limits = vec![self.robot.tension_limits; self.cables()];
        let mut pulls: Vec<Vector3<f64>> =
            (0..self.cables()).map(|i| -self.robot.span(self.pose, i).normalize()).collect();
        let mut open = wrench;
        for turn in 1..=MAX_TURNS {
            let wrench_matrix = self.robot.wrench_matrix(self.pose, &pulls);
            let problem =
                Problem { wrench_matrix: &wrench_matrix, wrench, reference: self.reference, limits: &limits };
            let distribution = distribute(&problem)
                .map_err(|source| StaticsError::Tension { position: self.pose.position.into(), source })?;
            let end = match self.newton(&spans, &limits, &distribution)? {
                Turn::Lost => self.catenaries(&spans, &distribution.tensions)?,
                end => end,
            };
            match end {
                Turn::Solved { catenaries, tensions } => {
                    return self.solution(&catenaries, tensions, distribution.active, turn);
                }
                Turn::TooSmall { cable, least } => {
                    let TensionLimits { min, max } = &mut limits[cable];
                    if ABOVE_LEAST * least > *max {
                        let source = CableError::TensionTooSmall { tension: *max, least };
                        return Err(StaticsError::Cable { index: cable, source });
                    }
                    *min = min.max(ABOVE_LEAST * least);
                }
                Turn::Catenaries(catenaries) => {
                    for ((pull, span), catenary) in pulls.iter_mut().zip(&spans).zip(&catenaries) {
                        let force = Vector3::from(span.plane.force_on_platform(catenary.force.into()));
                        let tangent = force / catenary.anchor_tension();
                        // The first turns go all the way; later ones are damped, should they swing.
                        let share = if turn <= 5 { 1.0 } else { 0.5 };
                        *pull = (*pull * (1.0 - share) + tangent * share).normalize();
                    }
                    let matrix = self.robot.wrench_matrix(self.pose, &pulls);
                    open = wrench + matrix * nalgebra::DVector::from_column_slice(&distribution.tensions);
                }
                Turn::Lost => {}
            }
        }
        Err(StaticsError::InverseNotConverged {
            iterations: MAX_TURNS,
            force: open.fixed_rows::<3>(0).norm(),
            moment: open.fixed_rows::<3>(3).norm(),
        })
    }

    /// All catenaries at given tensions, or the first cable whose span demands more.
    fn catenaries(&self, spans: &[Span<f64>], tensions: &[f64]) -> Result<Turn<'a>, StaticsError> {
        let mut catenaries = Vec::with_capacity(spans.len());
        for (i, (span, t)) in spans.iter().zip(tensions).enumerate() {
            match length_for_tension(&self.robot.cable(i), span.end.into(), *t) {
                Ok(solution) => catenaries.push(solution.catenary),
                Err(CableError::TensionTooSmall { least, .. }) => {
                    return Ok(Turn::TooSmall { cable: i, least });
                }
                Err(error) => return Err(StaticsError::cable(i)(error)),
            }
        }
        Ok(Turn::Catenaries(catenaries))
    }

    /// Newton's method on (a) with the distribution's active bounds, from its tensions.
    fn newton(
        &self,
        spans: &[Span<f64>],
        limits: &[TensionLimits],
        distribution: &Distribution,
    ) -> Result<Turn<'a>, StaticsError> {
        let wrench = self.wrench();
        let mut tensions = distribution.tensions.clone();
        let mut multipliers = Vector6::zeros();
        let mut catenaries = match self.catenaries(spans, &tensions)? {
            Turn::Catenaries(catenaries) => catenaries,
            other => return Ok(other),
        };
        let mut open_before = f64::INFINITY;
        for round in 0..MAX_NEWTON {
            if round > 0 {
                for (i, ((span, t), place)) in spans.iter().zip(&tensions).zip(&mut catenaries).enumerate() {
                    if distribution.active[i].is_none() {
                        match length_for_tension_near(place, span.end.into(), *t) {
                            Ok(solution) => *place = solution.catenary,
                            // A step too far: the tension at the end need not be too small.
                            Err(_) => return Ok(Turn::Lost),
                        }
                    }
                }
            }
            let mut open = wrench;
            let mut unbalanced = 0.0_f64;
            let (mut matrix, mut right) = (Matrix6::zeros(), Vector6::zeros());
            let mut cables = Vec::with_capacity(self.cables());
            for (i, (span, t)) in spans.iter().zip(&tensions).enumerate() {
                let direction = catenaries[i].force / *t;
                let w = self.wrench_of(i, span, direction);
                let left = t - self.reference[i] + w.dot(&multipliers);
                open += w * *t;
                let mut d = f64::INFINITY;
                if distribution.active[i].is_none() {
                    let per_length = catenaries[i].compliance().force_per_length();
                    let per_tension = per_length / per_length.dot(&direction);
                    let turn = self.wrench_of(i, span, (per_tension - direction) / *t);
                    d = 1.0 + turn.dot(&multipliers);
                    let c = w + turn * *t;
                    matrix += c * w.transpose() / d;
                    right -= c * (left / d);
                    unbalanced = unbalanced.max(left.abs());
                }
                cables.push((w, left, d));
            }
            let size = wrench.norm() + tensions.iter().sum::<f64>();
            let now_open = open.norm().max(unbalanced);
            // Each round squares what is open, until rounding ends it.
            if now_open <= 1e-14 * size || (now_open <= 1e-10 * size && now_open >= 0.5 * open_before) {
                let optimal = (0..self.cables()).all(|i| match distribution.active[i] {
                    None => limits[i].min <= tensions[i] && tensions[i] <= limits[i].max,
                    Some(Bound::Min) => cables[i].1 >= -1e-9 * size,
                    Some(Bound::Max) => cables[i].1 <= 1e-9 * size,
                });
                return Ok(if optimal {
                    Turn::Solved { catenaries, tensions }
                } else {
                    Turn::Catenaries(catenaries)
                });
            }
            open_before = now_open;
            let Some(step) = matrix.lu().solve(&(right + open)) else { return Ok(Turn::Lost) };
            multipliers += step;
            for (t, (w, left, d)) in tensions.iter_mut().zip(&cables) {
                *t -= (left + w.dot(&step)) / d;
            }
        }
        Ok(Turn::Lost)
    }
}

/// What one turn of the inverse model ends with.
enum Turn<'a> {
    /// The optimum, to rounding.
    Solved { catenaries: Vec<Catenary<'a>>, tensions: Vec<f64> },
    /// Catenaries whose directions make a better distribution.
    Catenaries(Vec<Catenary<'a>>),
    /// A cable whose span demands at least this tension [N].
    TooSmall { cable: usize, least: f64 },
    /// Nothing to go by.
    Lost,
}

fn lengths_and_forces(pose: &Pose, catenaries: &[Catenary]) -> (Vec<f64>, Equilibrium) {
    let lengths = catenaries.iter().map(|catenary| catenary.unstrained_length).collect();
    let cable_forces = catenaries.iter().map(|catenary| catenary.force).collect();
    (lengths, Equilibrium { pose: *pose, cable_forces })
}

/// The unstrained lengths [m] and end forces that give each cable the tension `tensions[i]` [N] at the platform, at `pose`, or
/// the least that its own weight demands over its span where that is more. The platform need not be in balance.
///
/// # Errors
/// [`StaticsError::Invalid`] unless there is one tension a cable; [`StaticsError::Cable`] for a tension that is none.
pub fn lengths_for_tensions(
    robot: &Robot,
    pose: &Pose,
    tensions: &[f64],
) -> Result<(Vec<f64>, Equilibrium), StaticsError> {
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
    let catenaries = solutions.collect::<Result<Vec<_>, _>>()?;
    Ok(lengths_and_forces(pose, &catenaries))
}
