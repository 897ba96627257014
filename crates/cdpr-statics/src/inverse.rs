//! Inverse elasto-geometrical model (IEGM): unstrained lengths that hold a pose.
//!
//! Eq. (1)-(3) hold together: the tension distribution needs the directions of the cables at the platform, which sag turns,
//! and the sag follows from the tensions. Distribution and catenaries take turns until the platform is in balance.

use crate::direct::Residual;
use crate::error::StaticsError;
use crate::model::{Equilibrium, Load, Model, Span};
use cdpr_cable::{CableError, length_for_tension};
use cdpr_robot::{Pose, Robot, Vector3};
use cdpr_tension::{Bound, Distribution, Problem, distribute};

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
    let wrench = load.total(robot, pose).to_vector();
    let spans: Vec<Span> = (0..n).map(|i| Span::new(robot.span(pose, i))).collect();
    // First round: straight cables.
    let mut pulls: Vec<Vector3<f64>> = (0..n).map(|i| -robot.span(pose, i).normalize()).collect();
    let mut open = f64::INFINITY;
    let mut open_wrench = wrench;
    for round in 1..=MAX_ROUNDS {
        let wrench_matrix = robot.wrench_matrix(pose, &pulls);
        let problem =
            Problem { wrench_matrix: &wrench_matrix, wrench, reference, limits: robot.tension_limits };
        let Distribution { tensions, active, .. } = distribute(&problem)
            .map_err(|source| StaticsError::Tension { position: pose.position.into(), source })?;
        // A tension too small for its span is refused only if the rounds end with it: the first ones do not know the sag.
        let mut refusal = None;
        let mut catenaries = Vec::with_capacity(n);
        for (i, span) in spans.iter().enumerate() {
            let with = |tension| length_for_tension(&robot.cable(i), span.end, tension);
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
        open_wrench =
            wrench + robot.wrench_matrix(pose, &pulls) * nalgebra::DVector::from_column_slice(&tensions);
        let now_open = open_wrench.norm();
        let rounding = 1e-14 * (wrench.norm() + tensions.iter().sum::<f64>());
        // Each round gains digits, until rounding ends it.
        if now_open <= rounding || (now_open <= 1e3 * rounding && now_open >= 0.5 * open) {
            if let Some(refusal) = refusal {
                return Err(refusal);
            }
            let lengths: Vec<f64> = catenaries.iter().map(|catenary| catenary.unstrained_length).collect();
            let cable_forces = catenaries.iter().map(|catenary| catenary.force).collect();
            let equilibrium = Equilibrium { pose: *pose, cable_forces };
            let residual = Residual::of(&Model::new(robot, &lengths, load)?, &equilibrium);
            return Ok(InverseSolution { lengths, tensions, active, equilibrium, rounds: round, residual });
        }
        open = now_open;
    }
    Err(StaticsError::InverseNotConverged {
        rounds: MAX_ROUNDS,
        force: open_wrench.fixed_rows::<3>(0).norm(),
        moment: open_wrench.fixed_rows::<3>(3).norm(),
    })
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
    let lengths = catenaries.iter().map(|catenary| catenary.unstrained_length).collect();
    let cable_forces = catenaries.iter().map(|catenary| catenary.force).collect();
    Ok((lengths, Equilibrium { pose: *pose, cable_forces }))
}
