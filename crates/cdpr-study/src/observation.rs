//! Observations: the deflection of perturbed robots.
//!
//! One observation perturbs all parameters of the robot; the inverse model runs on the *perturbed* robot at the wanted pose;
//! its tensions are offset by dt_i and the unstrained lengths computed for the offset tensions; the direct model runs on the
//! perturbed robot with those lengths, under its own weight and with the payload added; dp is the difference (Eq. (4)).

use crate::study::Sampling;
use cdpr_robot::{Parameter, Pose, Robot, Vector3};
use cdpr_sensitivity::{SampleDesign, SobolDesign};
use cdpr_statics::{Load, StaticsError, deflection};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Deflection of one perturbed robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observation {
    /// dp [m].
    pub displacement: Vector3<f64>,
}

impl Observation {
    /// What the paper calls the RMS of the static deflection: |dp|, in millimetres.
    pub fn rms_mm(&self) -> f64 {
        1e3 * self.displacement.norm()
    }
}

/// All observations of a sampling, in the order of its design.
#[derive(Clone, Debug, PartialEq)]
pub struct Observations {
    /// One for each row of the design: what was observed, or why nothing was.
    pub outcomes: Vec<Result<Observation, StaticsError>>,
}

impl Observations {
    /// RMS [mm] of each observation, `None` where it failed.
    pub fn rms_mm(&self) -> Vec<Option<f64>> {
        self.outcomes.iter().map(|outcome| outcome.as_ref().ok().map(Observation::rms_mm)).collect()
    }

    /// Number of failed observations by kind of failure; the usual kinds are always listed.
    pub fn failed(&self) -> BTreeMap<String, usize> {
        count_failed(self.outcomes.iter().filter_map(|outcome| outcome.as_ref().err()))
    }
}

/// Failures by kind; the usual kinds are always listed.
pub(crate) fn count_failed<'a>(errors: impl Iterator<Item = &'a StaticsError>) -> BTreeMap<String, usize> {
    let usual = ["infeasible_tension", "inverse_not_converged", "direct_not_converged"];
    let mut failed: BTreeMap<String, usize> = usual.map(|kind| (kind.to_owned(), 0)).into();
    for error in errors {
        *failed.entry(error.kind().to_owned()).or_default() += 1;
    }
    failed
}

/// Deflection of `robot` with `deviations` added to its parameters (in the order of [`Parameter::all`]).
///
/// # Errors
/// [`StaticsError`]: the reason why this observation fails.
pub(crate) fn observe_one(
    robot: &Robot,
    pose: &Pose,
    load: &Load,
    deviations: &[f64],
) -> Result<Observation, StaticsError> {
    let perturbed = robot.perturbed(deviations)?;
    let deflection = deflection(&perturbed.robot, pose, &perturbed.tension_offsets, load)?;
    Ok(Observation { displacement: deflection.displacement() })
}

/// Runs all observations of a sampling in parallel; `tick` is called after each.
pub fn observe(sampling: &Sampling, tick: &(dyn Fn() + Sync)) -> Observations {
    observe_design(sampling, &sampling.design, tick)
}

/// The same for another design over the same inputs.
pub(crate) fn observe_design(
    sampling: &Sampling,
    design: &SobolDesign,
    tick: &(dyn Fn() + Sync),
) -> Observations {
    let parameters = Parameter::all(sampling.robot.cables.len()).len();
    let outcomes = (0..design.points())
        .into_par_iter()
        .map_init(
            || (vec![0.0; sampling.places.len()], vec![0.0; parameters]),
            |(row, deviations), index| {
                // The index is below the number of points and the row as long as the inputs.
                let drawn = design.row(index, row);
                debug_assert_eq!(drawn, Ok(()));
                for (place, value) in sampling.places.iter().zip(row.iter()) {
                    deviations[*place] = *value;
                }
                let outcome = observe_one(sampling.robot, &sampling.pose, &sampling.load, deviations);
                tick();
                outcome
            },
        )
        .collect();
    Observations { outcomes }
}
