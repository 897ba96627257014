//! Natural modes, and the motions of the stiffness.

use crate::answers::failure::Failure;
use crate::answers::state::Motion;
use crate::question::Motions;
use cdpr_robot::Robot;
use cdpr_statics::vibration::{CableFrequency, NaturalMode};
use cdpr_statics::{DirectProblem, DirectStart};
use serde::Serialize;

/// How the platform moves about an equilibrium.
#[derive(Serialize)]
pub(crate) struct Moves {
    /// Natural modes, the slowest first; empty with a `reason`.
    frequencies: Vec<Natural>,
    /// Why the natural modes are missing.
    reason: Option<String>,
    /// The lowest of each cable between ends at rest [Hz]; `null` for one without mass.
    cable_frequencies: Vec<Option<f64>>,
    /// What follows where one of these is less than twice the lowest of the platform.
    warning: Option<String>,
    /// Motions from the softest to the stiffest.
    motions: Vec<Motion>,
    /// Length that makes rotations comparable with translations [m].
    characteristic_length: f64,
    /// Number of motions that nothing resists.
    neutral: usize,
}

/// A natural mode.
#[derive(Serialize)]
struct Natural {
    /// Natural frequency [Hz].
    frequency: f64,
    /// Translation of P [1/√kg].
    translation: [f64; 3],
    /// Rotation vector [rad/(m √kg)].
    rotation: [f64; 3],
    /// Share of each cable in the energy.
    cables: Vec<f64>,
    /// Share of the weight.
    weight: f64,
}

pub(crate) fn modes(robot: &Robot, given: &Motions) -> Result<Moves, Failure> {
    let (start, load) = (given.start.pose()?, given.load.load());
    let problem = DirectProblem::new(robot, &given.lengths, &load)?;
    let found = problem.direct(DirectStart::Pose(&start))?;
    let (natural, reason) = match problem.modes(&found.equilibrium) {
        Ok(modes) => (modes, None),
        Err(error) => (Vec::new(), Some(error.to_string())),
    };
    let cable_frequencies = problem.cable_frequencies(&found.equilibrium)?;
    let slowest = CableFrequency::slowest(cable_frequencies.iter().copied());
    let platform = natural.iter().map(|mode| mode.frequency).find(|frequency| *frequency > 0.0);
    let warning = slowest.zip(platform).and_then(|(cable, platform)| cable.warning(platform));
    let of = |mode: NaturalMode| Natural {
        frequency: mode.frequency,
        translation: mode.translation.into(),
        rotation: mode.rotation.into(),
        cables: mode.cables,
        weight: mode.weight,
    };
    Ok(Moves {
        frequencies: natural.into_iter().map(of).collect(),
        reason,
        cable_frequencies,
        warning,
        motions: found.stability.modes().iter().map(Motion::from).collect(),
        characteristic_length: found.stability.characteristic_length(),
        neutral: found.stability.neutral().len(),
    })
}
