//! What a search takes as it is: bounds that are in other units than the robot; of the robot that it finds,
//! cables that cross and the stiffness by its own size.

use crate::clearance::HangingCables;
use crate::design::file::{LimitsSpec, Over};
use crate::design::goal::Goal;
use crate::design::problem::DesignProblem;
use crate::design::variable::{Domain, Variable};
use cdpr_robot::{Doubt, Robot, short};
use cdpr_statics::{WantedPose, deflection};
use serde::Serialize;

/// Cables that touch or cross at a pose, as they hang under the load.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Crossings {
    /// Index of the first such pose, from 0.
    pub pose: usize,
    /// Indices of the cables of each pair, from 0.
    pub pairs: Vec<[usize; 2]>,
}

/// The stiffness of a robot whose rotations count with its own characteristic length.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct OwnStiffness {
    /// The characteristic length of the robot as it is, which the search takes [m].
    pub taken_length: f64,
    /// That of the robot that is found [m].
    pub own_length: f64,
    /// Lowest stiffness of all poses by it [N/m].
    pub stiffness: f64,
}

/// Cables of a robot that touch, cross or pass within their thickness at a pose of a design.
pub(crate) fn crossings(problem: &DesignProblem, robot: &Robot) -> Option<Crossings> {
    problem.poses.iter().enumerate().find_map(|(pose, at)| {
        let found = deflection(robot, WantedPose::at(at).free(&problem.free), &problem.load).ok()?;
        let cables = HangingCables::new(robot, &found.lengths, &found.loaded.equilibrium).ok()?;
        let all = (0..robot.cables.len()).flat_map(|j| (0..j).map(move |i| [i, j]));
        let pairs: Vec<_> = all.filter(|[i, j]| cables.touching(*i, *j).is_some()).collect();
        (!pairs.is_empty()).then_some(Crossings { pose, pairs })
    })
}

/// The stiffness of the robot with these values by its own size, where a stiffness is searched or limited and
/// the size is another than before.
pub(crate) fn own_stiffness(problem: &DesignProblem, values: &[f64], robot: &Robot) -> Option<OwnStiffness> {
    /// Lengths that differ by a smaller share are one.
    const SAME: f64 = 1e-9;
    let (taken, own) = (problem.characteristic_length, robot.platform_size());
    if !problem.needs(Goal::Stiffness) || own <= 0.0 || (own - taken).abs() <= SAME * taken {
        return None;
    }
    let by_own = DesignProblem {
        characteristic_length: own,
        output: Goal::Stiffness,
        over: Over::Worst,
        second: None,
        limits: LimitsSpec::default(),
        ..problem.clone()
    };
    let found = by_own.evaluate(values, None).ok()?;
    let stiffness = found.outputs.iter().map(|of| of.value).reduce(f64::min)?;
    Some(OwnStiffness { taken_length: taken, own_length: own, stiffness })
}

impl DesignProblem {
    /// Lengths that may change within bounds, or have choices, that are in mm where the robot is in m.
    pub fn doubts(&self) -> Vec<Doubt> {
        self.of_parameters().filter_map(|(j, variable)| in_millimetres(j, variable)).collect()
    }
}

/// A variable whose value is outside of its bounds, and within a thousandth of them.
fn in_millimetres(j: usize, variable: &Variable) -> Option<Doubt> {
    const MM: f64 = 1e-3;
    let (field, values) = match &variable.domain {
        Domain::Bounds(ends) => ("bounds", &ends[..]),
        Domain::Choices(values) => ("choices", &values[..]),
    };
    let least = values.iter().copied().reduce(f64::min)?;
    let greatest = values.iter().copied().reduce(f64::max)?;
    let is_within = |scale: f64| (scale * least..=scale * greatest).contains(&variable.nominal);
    if variable.parameters[0].0.unit() != "m" || is_within(1.0) || !is_within(MM) {
        return None;
    }
    let list = |scale: f64| {
        let [least, greatest] = [least, greatest].map(|of| short(scale * of));
        format!("{least} to {greatest} m")
    };
    let why = format!("{} is {} m in the robot file", variable.name, short(variable.nominal));
    let meant = format!("{}, if it is in mm", list(MM));
    Some(Doubt::new(format!("variables[{j}].{field}"), list(1.0), why, meant))
}
