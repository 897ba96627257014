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
//! Where a bound is active, distribution (by QP) and catenaries take turns until the platform is in balance.

use crate::direct::Residual;
use crate::error::StaticsError;
use crate::model::{Equilibrium, Load, Model, Span};
use cdpr_cable::{CableError, Catenary, length_for_tension, length_for_tension_near};
use cdpr_robot::{Pose, Robot, Vector3, Vector6};
use cdpr_tension::{Bound, Distribution, Problem, closed_form, distribute};
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
    /// Rounds of distribution and catenaries.
    pub rounds: usize,
    /// Residuals of all equations.
    pub residual: Residual,
}

const MAX_ROUNDS: usize = 100;

/// The unstrained lengths with which the platform rests at `pose` under its weight and `load`, with tensions as near as
/// possible to `reference` [N] (one for each cable) within the robot's limits; `None` for the least-norm tensions.
///
/// # Errors
/// [`StaticsError::Tension`] where no tensions within the limits hold the pose; [`StaticsError::Cable`] where a cable's own
/// weight demands more than its tension; [`StaticsError::InverseNotConverged`].
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
    let zeros = vec![0.0; n];
    let reference = reference.unwrap_or(&zeros);
    StaticsError::one_per_cable("reference", reference, n)?;
    let problem = Inverse { robot, pose, load, reference };
    match problem.newton() {
        Some(solution) => Ok(solution),
        None => problem.alternate(),
    }
}

/// What the inverse model is asked.
struct Inverse<'a> {
    robot: &'a Robot,
    pose: &'a Pose,
    load: &'a Load,
    reference: &'a [f64],
}

impl Inverse<'_> {
    fn cables(&self) -> usize {
        self.reference.len()
    }

    fn wrench(&self) -> Vector6<f64> {
        self.load.total(self.robot, self.pose).to_vector()
    }

    fn spans(&self) -> Vec<Span> {
        (0..self.cables()).map(|i| Span::new(self.robot.span(self.pose, i))).collect()
    }

    /// Pulls of straight cables.
    fn straight(&self) -> Vec<Vector3<f64>> {
        (0..self.cables()).map(|i| -self.robot.span(self.pose, i).normalize()).collect()
    }

    /// Wrench about P of a force `pull` at anchor point i.
    fn wrench_of(&self, i: usize, pull: &Vector3<f64>) -> Vector6<f64> {
        let moment = self.robot.anchor_arm(self.pose, i).cross(pull);
        Vector6::new(pull.x, pull.y, pull.z, moment.x, moment.y, moment.z)
    }

    /// How much of the wrench is open through rounding alone.
    fn rounding(&self, wrench: &Vector6<f64>, tensions: &[f64]) -> f64 {
        1e-14 * (wrench.norm() + tensions.iter().sum::<f64>())
    }

    fn solution(
        &self,
        catenaries: &[Catenary],
        tensions: Vec<f64>,
        active: Vec<Option<Bound>>,
        rounds: usize,
    ) -> Result<InverseSolution, StaticsError> {
        let (lengths, equilibrium) = lengths_and_forces(self.pose, catenaries);
        let residual = Residual::of(&Model::new(self.robot, &lengths, self.load)?, &equilibrium);
        Ok(InverseSolution { lengths, tensions, active, equilibrium, rounds, residual })
    }

    /// Newton's method on (a). `None` where a bound is active, a tension is too small for its span, or it does not converge.
    fn newton(&self) -> Option<InverseSolution> {
        let limits = self.robot.tension_limits;
        let wrench = self.wrench();
        let matrix = self.robot.wrench_matrix(self.pose, &self.straight());
        let straight = Problem { wrench_matrix: &matrix, wrench, reference: self.reference, limits };
        let mut tensions = closed_form(&straight)?.as_slice().to_vec();
        let mut multipliers = Vector6::zeros();
        let spans = self.spans();
        let mut catenaries: Vec<Catenary> = Vec::with_capacity(self.cables());
        let mut open_before = f64::INFINITY;
        for round in 1..=10 {
            if !tensions.iter().all(|t| limits.min <= *t && *t <= limits.max) {
                return None;
            }
            let mut open = wrench;
            let mut unbalanced = 0.0_f64;
            let (mut matrix, mut right) = (Matrix6::zeros(), Vector6::zeros());
            let mut cables = Vec::with_capacity(self.cables());
            for (i, (span, t)) in spans.iter().zip(&tensions).enumerate() {
                let near = catenaries.get(i);
                let solved = match near {
                    Some(near) => length_for_tension_near(near, span.end, *t),
                    None => length_for_tension(&self.robot.cable(i), span.end, *t),
                };
                let catenary = solved.ok()?.catenary;
                match catenaries.get_mut(i) {
                    Some(place) => *place = catenary,
                    None => catenaries.push(catenary),
                }
                let direction = catenary.force / *t;
                let per_length = catenary.compliance().force_per_length();
                let per_tension = per_length / per_length.dot(&direction);
                let w = self.wrench_of(i, &-span.lift(direction));
                let turn = self.wrench_of(i, &-span.lift((per_tension - direction) / *t));
                let left = t - self.reference[i] + w.dot(&multipliers);
                let d = 1.0 + turn.dot(&multipliers);
                let c = w + turn * *t;
                matrix += c * w.transpose() / d;
                right -= c * (left / d);
                open += w * *t;
                unbalanced = unbalanced.max(left.abs());
                cables.push((w, left, d));
            }
            let rounding = self.rounding(&wrench, &tensions);
            let now_open = open.norm().max(unbalanced);
            if now_open <= rounding || (now_open <= 1e3 * rounding && now_open >= 0.5 * open_before) {
                return self.solution(&catenaries, tensions, vec![None; self.cables()], round).ok();
            }
            open_before = now_open;
            let step = matrix.lu().solve(&(right + open))?;
            multipliers += step;
            for (t, (w, left, d)) in tensions.iter_mut().zip(&cables) {
                *t -= (left + w.dot(&step)) / d;
            }
        }
        None
    }

    /// Distribution within the bounds and catenaries by turns.
    fn alternate(&self) -> Result<InverseSolution, StaticsError> {
        let limits = self.robot.tension_limits;
        let wrench = self.wrench();
        let spans = self.spans();
        let mut pulls = self.straight();
        let mut open = f64::INFINITY;
        let mut open_wrench = wrench;
        for round in 1..=MAX_ROUNDS {
            let wrench_matrix = self.robot.wrench_matrix(self.pose, &pulls);
            let problem =
                Problem { wrench_matrix: &wrench_matrix, wrench, reference: self.reference, limits };
            let Distribution { tensions, active, .. } = distribute(&problem)
                .map_err(|source| StaticsError::Tension { position: self.pose.position.into(), source })?;
            // A tension too small for its span is refused only if the rounds end with it: the first ones do not know the sag.
            let mut refusal = None;
            let mut catenaries = Vec::with_capacity(self.cables());
            for (i, span) in spans.iter().enumerate() {
                let with = |tension| length_for_tension(&self.robot.cable(i), span.end, tension);
                let solution = with(tensions[i]).or_else(|error| match error {
                    CableError::TensionTooSmall { least, .. } => {
                        refusal = Some(StaticsError::Cable { index: i, source: error });
                        with(1.01 * least).map_err(StaticsError::cable(i))
                    }
                    error => Err(StaticsError::Cable { index: i, source: error }),
                })?;
                catenaries.push(solution.catenary);
            }
            for ((pull, span), catenary) in pulls.iter_mut().zip(&spans).zip(&catenaries) {
                *pull = -span.lift(catenary.force) / catenary.anchor_tension();
            }
            let matrix = self.robot.wrench_matrix(self.pose, &pulls);
            open_wrench = wrench + matrix * nalgebra::DVector::from_column_slice(&tensions);
            let now_open = open_wrench.norm();
            let rounding = self.rounding(&wrench, &tensions);
            // Each round gains digits, until rounding ends it.
            if now_open <= rounding || (now_open <= 1e3 * rounding && now_open >= 0.5 * open) {
                return match refusal {
                    Some(refusal) => Err(refusal),
                    None => self.solution(&catenaries, tensions, active, round),
                };
            }
            open = now_open;
        }
        Err(StaticsError::InverseNotConverged {
            rounds: MAX_ROUNDS,
            force: open_wrench.fixed_rows::<3>(0).norm(),
            moment: open_wrench.fixed_rows::<3>(3).norm(),
        })
    }
}

fn lengths_and_forces(pose: &Pose, catenaries: &[Catenary]) -> (Vec<f64>, Equilibrium) {
    let lengths = catenaries.iter().map(|catenary| catenary.unstrained_length).collect();
    let cable_forces = catenaries.iter().map(|catenary| catenary.force).collect();
    (lengths, Equilibrium { pose: *pose, cable_forces })
}

/// The unstrained lengths [m] and end forces that give each cable the tension `tensions[i]` [N] at the platform, at `pose`. The
/// platform need not be in balance.
///
/// # Errors
/// [`StaticsError::Cable`] where a cable's own weight demands more than its tension.
pub fn lengths_for_tensions(
    robot: &Robot,
    pose: &Pose,
    tensions: &[f64],
) -> Result<(Vec<f64>, Equilibrium), StaticsError> {
    StaticsError::one_per_cable("tensions", tensions, robot.cables.len())?;
    let spans: Vec<Span> = (0..tensions.len()).map(|i| Span::new(robot.span(pose, i))).collect();
    let solutions = spans.iter().zip(tensions).enumerate().map(|(i, (span, tension))| {
        let solution = length_for_tension(&robot.cable(i), span.end, *tension);
        solution.map(|solution| solution.catenary).map_err(StaticsError::cable(i))
    });
    let catenaries = solutions.collect::<Result<Vec<_>, _>>()?;
    Ok(lengths_and_forces(pose, &catenaries))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn newtons_method_finds_what_turns_of_distribution_and_catenaries_find(
            x in -3.3..3.3f64, y in -1.8..1.8f64, z in 0.3..3.2f64, turn in prop::array::uniform3(-0.1..0.1f64),
            payload in 0.0..50.0f64, reference in 0.0..800.0f64,
        ) {
            let robot = Robot::from_json(include_str!("../../../data/robots/caroca.json")).unwrap();
            let pose = Pose::at(x, y, z).moved(Vector3::zeros(), turn.into());
            let load = Load::payload(payload);
            let problem = Inverse { robot: &robot, pose: &pose, load: &load, reference: &[reference; 8] };
            // The turns need not settle where Newton's method does: near the limits of the workspace they may swing.
            if let (Some(newton), Ok(turns)) = (problem.newton(), problem.alternate()) {
                prop_assert!(turns.active.iter().all(Option::is_none));
                let size = newton.tensions.iter().sum::<f64>();
                for (a, b) in newton.tensions.iter().zip(&turns.tensions) {
                    prop_assert!((a - b).abs() < 1e-9 * size, "{a} {b}");
                }
            }
        }
    }
}
