//! The tensions that a robot's distribution chooses: the optimum (I1), or the least norm (I13).

use super::feasible::search;
use super::maximization::{Aim, Maximization, Maximum};
use super::optimum::Optimum;
use super::question::Question;
use crate::error::StaticsError;
use cdpr_robot::{Robot, TensionDistribution, TensionLimits, Vector6};

/// The tensions that the question asks for.
pub(super) fn chosen<'a>(question: &Question<'a>) -> Result<Optimum<'a>, StaticsError> {
    let largest = question.limits.iter().map(|limits| limits.max).fold(0.0, f64::max);
    let (aim, least) = match question.distribution {
        TensionDistribution::Nearest | TensionDistribution::LeastTwoNorm => return search(question),
        TensionDistribution::LeastOneNorm => (Aim::Sum, largest * question.cables() as f64),
        TensionDistribution::LeastInfinityNorm => {
            let below = TensionLimits { min: -4.0 * largest, max: 0.0 };
            (Aim::Greatest(vec![below; question.cables()]), largest)
        }
    };
    let components = question.robot.freedoms().components();
    let maximization = Maximization { aim, range: [-least, 0.0], components };
    let Maximum { value, mut point, solution, iterations } = maximization.solve(question, question)?;
    point.multipliers = Vector6::zeros();
    for (k, y) in maximization.components.iter().zip(&solution.multipliers) {
        point.multipliers[*k] = *y;
    }
    let stationarity = (solution.values[question.cables()] * point.size() - value).max(0.0);
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
