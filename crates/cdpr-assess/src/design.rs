//! Design of a robot: where its exits go, or which of the places of its pulleys are best, for poses and a
//! load.
//!
//! What has bounds is searched from several starts with exact derivatives (`design/search.rs`): the robot
//! as it is, and points of Sobol's sequence. Of what has choices, every combination is evaluated. A robot
//! counts if it is held at every pose without the load, by tensions within its limits, if with the load,
//! the lengths kept, no tension is above its greatest value or breaking force, and if it meets the
//! demands.

mod at_rest;
mod cables;
mod demand;
mod evaluation;
mod exhaustive;
mod file;
mod front;
mod goal;
mod position;
mod problem;
mod search;
mod starts;
mod unsearched;
mod variable;

use crate::error::AssessError;
pub use cables::ChosenCable;
use cables::left_laws;
use cdpr_robot::Robot;
use cdpr_study::StudyError;
use demand::Demand;
use evaluation::Quantity;
pub use file::{
    CableSpec, DESIGN_FORMAT, DesignFile, LimitsSpec, ObjectiveSpec, Over, ParetoSpec, VariableSpec,
    design_schema,
};
pub use front::{Front, FrontPoint, front};
pub use goal::Goal;
use goal::sense;
use indexmap::IndexMap;
use position::BASIS;
pub use problem::DesignProblem;
use search::{Found, MET, excess, objective};
use serde::Serialize;
use starts::Searched;
pub use unsearched::{Crossings, OwnStiffness};
use unsearched::{crossings, own_stiffness};
use variable::{Domain, Variable};

/// The best robot that was found, and how far that can be relied on.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Design {
    /// What is as good as possible.
    pub output: Goal,
    /// Over the poses.
    pub over: Over,
    /// What a position error is and assumes, where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub basis: Option<&'static str>,
    /// What becomes of measured laws of the cables where types are chosen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_laws: Option<String>,
    /// Number of poses.
    pub poses: usize,
    /// The objective of the robot as it is, in the unit of the output; `None` where it is not held at
    /// every pose, and of a cost, which only the types of the file have.
    pub before: Option<f64>,
    /// Whether the robot as it is is held and meets all demands.
    pub feasible_before: bool,
    /// Combinations of the choices, all of them looked at; 1 without choices.
    pub configurations: usize,
    /// Starts of the local search in each of them; 0 where nothing has bounds.
    pub starts: usize,
    /// Searches, or configurations where nothing has bounds, that led to a robot that counts.
    pub feasible: usize,
    /// Configurations that were left as soon as a pose proved them worse than the two best ones: whether
    /// they count is not known. Only of more than 1000.
    #[serde(skip_serializing_if = "is_none")]
    pub left: usize,
    /// Evaluations of a robot at all poses, of configurations that are left at some of them.
    pub evaluations: usize,
    /// Why the first start leads to no robot that counts, where none does.
    pub reason: Option<String>,
    /// The best robot; `None` where no start led to one that counts.
    pub best: Option<BestDesign>,
}

/// The best robot that was found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BestDesign {
    /// The objective in the unit of the output.
    pub objective: f64,
    /// The output at each pose; a single number for a length or a cost, which are of all poses.
    pub outputs: Vec<f64>,
    /// What changed.
    pub variables: Vec<DesignedVariable>,
    /// The type of cable of each group, where types are chosen.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub cables: Vec<ChosenCable>,
    /// The best robot with each choice of types, in the order of the file; none where these are more than
    /// 1000.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub cable_types: Vec<BestOfTypes>,
    /// Searches that led to these values.
    pub same: usize,
    /// The objective of the best other configuration, where there is one that counts.
    pub next_configuration: Option<f64>,
    /// Residual of the optimality conditions, relative to the objective at the start and to the widths
    /// between the bounds; `None` where nothing has bounds.
    pub kkt_residual: Option<f64>,
    /// Greatest change of the derivatives in this residual if differences have steps twice as long; `None`
    /// where all derivatives are exact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gradient_error: Option<f64>,
    /// Whether that residual is small enough for a local optimum: at most 1e-8, with derivatives by
    /// differences at most 1e-6 with their error; true where nothing has bounds.
    pub optimal: bool,
    /// Demands that keep the objective from being better.
    pub active: Vec<ActiveDemand>,
    /// By how much the objective would be better if the limit of the cost were 1 % wider, to first order;
    /// `None` where it does not keep it from being better.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cost_per_percent: Option<f64>,
    /// The same of the limit of the length.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length_per_percent: Option<f64>,
    /// Cables that touch or cross at a pose, which the search does not look at; `None` without any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crossings: Option<Crossings>,
    /// The stiffness by the characteristic length of this robot, where the search took another one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub own_stiffness: Option<OwnStiffness>,
    /// The robot.
    #[serde(skip)]
    pub robot: Robot,
}

/// The best robot with some types of cable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BestOfTypes {
    /// The type of each group.
    pub types: Vec<String>,
    /// The objective in the unit of the output; `None` where no robot with these types counts.
    pub objective: Option<f64>,
    /// Cost of all cables; `None` where a type has none, or no robot counts.
    pub cost: Option<f64>,
    /// Mass of all cables [kg].
    pub mass: Option<f64>,
    /// Why the first configuration and start with these types does not count, where none does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// A variable of a design.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DesignedVariable {
    /// Its name.
    pub name: String,
    /// SI unit.
    pub unit: &'static str,
    /// Value of the robot as it is.
    pub from: f64,
    /// Value of the best robot.
    pub to: f64,
    /// The bound that it is on: "min" or "max"; of choices never.
    pub bound: Option<&'static str>,
    /// By how much the objective changes for each unit by which an active bound is moved; zero within
    /// bounds.
    pub per_unit: f64,
    /// Whether the objective is flat at an active bound: by the whole width of the bounds it changes by less
    /// than a thousandth.
    #[serde(skip)]
    pub flat: bool,
}

/// A demand that is met with equality, and costs something.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ActiveDemand {
    /// Index of the pose, from 0.
    pub pose: usize,
    /// The output that is limited; `None` for the tension of a cable.
    pub output: Option<Goal>,
    /// Index of the cable whose greatest tension, or limit of the exit tension, is reached, from 0.
    pub cable: Option<usize>,
    /// By how much the objective would be better if the limit were 1 % wider, to first order.
    pub per_percent: f64,
}

fn is_none(count: &usize) -> bool {
    *count == 0
}

/// Values are the same where they differ by less than this share of the range between the bounds.
const SAME_VALUE: f64 = 1e-4;
/// The same of objectives, relative.
const SAME_OBJECTIVE: f64 = 1e-6;

/// Finds the best values of the variables.
///
/// The result does not depend on the number of threads.
///
/// # Errors
/// [`AssessError::Study`] for more variables than Sobol's sequence has dimensions.
pub fn design(problem: &DesignProblem) -> Result<Design, AssessError> {
    let sign = sense(problem.output);
    let searched = Searched::of(problem, &[])?;
    let Searched { starts, each, .. } = searched;
    let feasible = || searched.feasible();
    let best = searched.best();
    let before = problem.evaluate(&problem.nominal(), None).ok();
    let reason = best.is_none().then(|| searched.reason(problem, 0));
    let best = best.map(|(number, best)| {
        let others = feasible().filter(|(k, _)| k / each != number / each).map(|(_, one)| one.objective);
        let next = others.min_by(f64::total_cmp).map(|objective| sign * objective);
        let same = feasible().filter(|(_, one)| is_same(problem, one, best)).count();
        best_design(problem, best, same, next).map(|made| BestDesign {
            cable_types: of_types(problem, &searched, sign),
            crossings: crossings(problem, &made.robot),
            own_stiffness: own_stiffness(problem, &best.values, &made.robot),
            ..made
        })
    });
    Ok(Design {
        output: problem.output,
        over: problem.over,
        basis: problem.needs(Goal::Position).then_some(BASIS),
        left_laws: left_laws(&problem.types, &problem.variables, &problem.robot),
        poses: problem.poses.len(),
        before: before
            .as_ref()
            .filter(|_| problem.output != Goal::Cost)
            .map(|at| sign * objective(problem.over, &at.outputs, sign)),
        feasible_before: before.as_ref().is_some_and(|at| excess(at) <= MET),
        configurations: searched.found.len() / each,
        starts,
        feasible: feasible().count(),
        left: searched.left,
        evaluations: 1 + searched.evaluations,
        reason,
        best: best.transpose()?,
    })
}

fn is_same(problem: &DesignProblem, one: &Found, best: &Found) -> bool {
    let is_near = |((a, b), variable): ((&f64, &f64), &Variable)| match variable.domain {
        Domain::Bounds([low, high]) => (a - b).abs() <= SAME_VALUE * (high - low),
        Domain::Choices(_) => a == b,
    };
    (one.objective - best.objective).abs() <= SAME_OBJECTIVE * best.objective.abs()
        && one.values.iter().zip(&best.values).zip(&problem.variables).all(is_near)
}

/// Share of the objective below which an active bound counts as worth nothing.
const FLAT: f64 = 1e-3;

/// Distance from a bound, as a share of the way between both, within which a search ends next to it.
const NEXT_TO_BOUND: f64 = 1e-6;

fn best_design(
    problem: &DesignProblem,
    best: &Found,
    same: usize,
    next_configuration: Option<f64>,
) -> Result<BestDesign, AssessError> {
    let sign = sense(problem.output);
    let invalid =
        |error: &dyn std::fmt::Display| StudyError::setting("variables", error, "values of a valid robot");
    let robot = problem.robot_at(&best.values).map_err(|error| invalid(&error))?;
    let at = problem.evaluate(&best.values, None).map_err(|error| invalid(&error))?;
    let lengths: Vec<f64> = at.longest.iter().map(|length| length.value).collect();
    let variable = |(j, variable): (usize, &Variable)| {
        let to = best.values[j];
        // A search may end next to a bound towards which the objective improves.
        let near = |[low, high]: [f64; 2], end: f64| (to - end).abs() <= NEXT_TO_BOUND * (high - low);
        let slope = best.gradient.get(j).copied().unwrap_or(0.0);
        let bound = match variable.domain {
            Domain::Bounds(ends @ [low, _]) if to == low || near(ends, low) && slope > 0.0 => Some("min"),
            Domain::Bounds(ends @ [_, high]) if to == high || near(ends, high) && slope < 0.0 => Some("max"),
            _ => None,
        };
        let width = if let Domain::Bounds([low, high]) = variable.domain { high - low } else { 0.0 };
        DesignedVariable {
            name: variable.name.clone(),
            unit: variable.parameters[0].0.unit(),
            from: variable.nominal,
            to,
            per_unit: if bound.is_some() { sign * slope } else { 0.0 },
            flat: bound.is_some() && (slope * width).abs() < FLAT * best.objective.abs(),
            bound,
        }
    };
    let active = || best.active.iter().map(|(k, multiplier)| (problem.demand(*k), 0.01 * multiplier));
    let of_whole = |goal| {
        let is_it = |(demand, _): &(Demand, f64)| matches!(demand, Demand::Whole { of, .. } if *of == goal);
        active().filter(is_it).map(|(_, gain)| gain).reduce(|one, other| one + other)
    };
    let at_pose = |(demand, per_percent): (Demand, f64)| match demand {
        Demand::Output { pose, output, .. } => {
            Some(ActiveDemand { pose, output: Some(output), cable: None, per_percent })
        }
        Demand::Tension { pose, cable } => {
            Some(ActiveDemand { pose, output: None, cable: Some(cable), per_percent })
        }
        Demand::Exit { pose, cable, .. } => {
            Some(ActiveDemand { pose, output: Some(Goal::Tension), cable: Some(cable), per_percent })
        }
        Demand::Whole { .. } | Demand::Second => None,
    };
    let has_bounds = problem.bounded().next().is_some();
    Ok(BestDesign {
        objective: sign * best.objective,
        outputs: by_pose(&at.outputs, problem.poses.len()),
        variables: problem.of_parameters().map(variable).collect(),
        cables: problem.chosen(&best.values, &lengths),
        cable_types: Vec::new(),
        same,
        next_configuration,
        kkt_residual: has_bounds.then_some(best.residual),
        gradient_error: best.gradient_error,
        optimal: best.is_optimal(),
        active: active().filter_map(at_pose).collect(),
        cost_per_percent: of_whole(Goal::Cost),
        length_per_percent: of_whole(Goal::Length),
        crossings: None,
        own_stiffness: None,
        robot,
    })
}

/// The output at each pose: the greatest, where a pose has several.
fn by_pose(outputs: &[Quantity], poses: usize) -> Vec<f64> {
    let greatest = |of: &[Quantity]| of.iter().map(|of| of.value).reduce(f64::max);
    outputs.chunks((outputs.len() / poses).max(1)).filter_map(greatest).collect()
}

/// Choices of types that are listed.
const MOST_CHOICES: usize = 1000;

/// The best robot with each choice of types of cable.
fn of_types(problem: &DesignProblem, searched: &Searched, sign: f64) -> Vec<BestOfTypes> {
    let groups: Vec<usize> =
        (0..problem.variables.len()).filter(|j| !problem.variables[*j].cables.is_empty()).collect();
    // With the first configuration of each choice.
    let mut best: IndexMap<Vec<usize>, (usize, Option<&Found>)> = IndexMap::new();
    for number in 0..searched.found.len() / searched.each {
        let values = problem.configuration(number);
        best.entry(groups.iter().map(|j| values[*j] as usize).collect()).or_insert((number, None));
    }
    for (_, found) in searched.feasible() {
        let (_, of) = best.entry(groups.iter().map(|j| found.values[*j] as usize).collect()).or_default();
        if of.is_none_or(|of| found.objective < of.objective) {
            *of = Some(found);
        }
    }
    let row = |(types, (first, found)): (Vec<usize>, (usize, Option<&Found>))| {
        let chosen = found.and_then(|found| {
            let lengths: Vec<f64> =
                problem.evaluate(&found.values, None).ok()?.longest.iter().map(|of| of.value).collect();
            Some(problem.chosen(&found.values, &lengths))
        });
        BestOfTypes {
            types: types.iter().map(|k| problem.types[*k].name.clone()).collect(),
            objective: found.map(|found| sign * found.objective),
            cost: chosen.as_ref().and_then(|of| of.iter().map(|of| of.cost).sum()),
            mass: chosen.map(|of| of.iter().map(|of| of.mass).sum()),
            reason: found.is_none().then(|| searched.reason(problem, first)),
        }
    };
    match groups.is_empty() || best.len() > MOST_CHOICES {
        true => Vec::new(),
        false => best.into_iter().map(row).collect(),
    }
}
