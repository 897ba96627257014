//! `cdpr.design`, `cdpr.design_front`: the search for the best robot, as the command `design` makes it.

use crate::convert::{Answer, Raised, to_json, watched};
use crate::robot::Robot;
use crate::source::Source;
use cdpr_assess::{design as search, front};
use pyo3::prelude::*;

/// The best robot by a design, or the front of its two objectives: what was found as JSON, and the robots.
#[pyfunction]
pub(crate) fn design(
    py: Python,
    robot: &Robot,
    design: Source,
    is_front: bool,
    threads: Option<usize>,
) -> Answer<(String, Vec<Robot>)> {
    let problem = design.design(&robot.robot)?;
    if problem.has_front() != is_front {
        let message = match is_front {
            true => "pareto is missing: expected a second objective, or a call of design",
            false => "pareto is given: expected one objective, or a call of design_front",
        };
        return Err(Raised::Input(message.to_owned()));
    }
    let made = |robot: &cdpr_robot::Robot| Robot { robot: robot.clone() };
    watched(
        py,
        threads,
        |_| Ok(()),
        |_| -> Answer<(String, Vec<Robot>)> {
            if is_front {
                let found = front(&problem)?;
                return Ok((to_json(&found)?, found.points.iter().map(|point| made(&point.robot)).collect()));
            }
            let found = search(&problem)?;
            Ok((to_json(&found)?, found.best.iter().map(|best| made(&best.robot)).collect()))
        },
    )?
}
