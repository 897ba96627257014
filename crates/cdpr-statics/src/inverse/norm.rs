//! The tensions that a robot's distribution chooses: the optimum (I1), or the least norm (I13).

use super::feasible::search;
use super::maximization::{Aim, Maximization, Maximum};
use super::optimum::Optimum;
use super::problem::InverseProblem;
use crate::error::StaticsError;
use cdpr_robot::{Robot, TensionDistribution, TensionLimits, Vector6};

/// The tensions that the problem asks for.
pub(super) fn chosen<'a>(problem: &InverseProblem<'a>) -> Result<Optimum<'a>, StaticsError> {
    let largest = problem.limits.iter().map(|limits| limits.max).fold(0.0, f64::max);
    let (aim, least) = match problem.distribution {
        TensionDistribution::Nearest | TensionDistribution::LeastTwoNorm => return search(problem),
        TensionDistribution::LeastOneNorm => (Aim::Sum, largest * problem.cables() as f64),
        TensionDistribution::LeastInfinityNorm => {
            let below = TensionLimits { min: -4.0 * largest, max: 0.0 };
            (Aim::Greatest(vec![below; problem.cables()]), largest)
        }
    };
    let components = problem.robot.freedoms().components();
    let maximization = Maximization { aim, range: [-least, 0.0], components };
    let Maximum { value, mut point, solution, iterations } = maximization.solve(problem, problem)?;
    point.multipliers = Vector6::zeros();
    for (k, y) in maximization.components.iter().zip(&solution.multipliers) {
        point.multipliers[*k] = *y;
    }
    let stationarity = (solution.values[problem.cables()] * point.size() - value).max(0.0);
    Ok(Optimum { iterations, stationarity, ..point.optimum() })
}

/// Refuses distributions whose tensions jump from pose to pose.
///
/// # Errors
/// [`StaticsError::Invalid`] for the least 1-norm and infinity-norm.
pub(crate) fn require_smooth(robot: &Robot) -> Result<(), StaticsError> {
    if robot.distribution.is_smooth() {
        return Ok(());
    }
    let expected = "nearest or least_2_norm here: derivatives, paths and observations follow tensions that change \
                    smoothly";
    Err(StaticsError::invalid("distribution".to_owned(), robot.distribution.name(), expected))
}
