//! The types of cable of a design: which one each group of cables has, what the cables weigh and cost.

use crate::design::file::{CableSpec, DesignFile};
use crate::design::goal::Goal;
use crate::design::variable::{Domain, Variable, wrong};
use cdpr_robot::{CableProperties, Robot};
use cdpr_study::InField;
use serde::Serialize;

/// Value of a variable that leaves the cables of its group as they are in the robot.
const AS_IT_IS: f64 = -1.0;

/// A type of cable.
#[derive(Clone, Debug)]
pub(crate) struct CableType {
    pub(crate) name: String,
    properties: CableProperties,
    /// Of a metre.
    pub(crate) cost: Option<f64>,
}

/// The type that is chosen for a group of cables.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChosenCable {
    /// Numbers of the cables, from 1.
    pub cables: Vec<usize>,
    /// Name of their type.
    pub name: String,
    /// Sum of their unstrained lengths [m], lead included, each at the pose where it is longest.
    pub length: f64,
    /// Mass of these lengths [kg].
    pub mass: f64,
    /// Their cost; `None` for a type without one.
    pub cost: Option<f64>,
}

/// The types of a file, and a variable for each group of cables.
pub(crate) fn types(file: &DesignFile, robot: &Robot) -> Result<(Vec<CableType>, Vec<Variable>), InField> {
    let count = robot.cables.len();
    let groups = match (&file.cable_groups[..], &file.cables[..]) {
        ([], []) => return Ok((Vec::new(), Vec::new())),
        (groups, []) => {
            return wrong("cable_groups", format!("{groups:?}"), "none without types in `cables`");
        }
        ([], _) => vec![(1..=count).collect()],
        (groups, _) => groups.to_vec(),
    };
    let mut sorted: Vec<usize> = groups.iter().flatten().copied().collect();
    sorted.sort_unstable();
    if sorted != (1..=count).collect::<Vec<_>>() || groups.iter().any(Vec::is_empty) {
        let expected = format!("each of the cables 1 to {count} in one group");
        return wrong("cable_groups", format!("{groups:?}"), expected);
    }
    let mut types: Vec<CableType> = Vec::with_capacity(file.cables.len());
    for (k, spec) in file.cables.iter().enumerate() {
        let found = cable_type(spec).map_err(|(of, value, why)| (format!("cables[{k}].{of}"), value, why))?;
        if types.iter().any(|one| one.name == found.name) {
            return wrong(&format!("cables[{k}].name"), &spec.name, "another name for each type");
        }
        let mut with_it = robot.clone();
        (0..count).for_each(|i| found.put_on(&mut with_it, i));
        if let Err(error) = with_it.validate() {
            return wrong(&format!("cables[{k}]"), &spec.name, format!("a type for a valid robot: {error}"));
        }
        types.push(found);
    }
    if let Some(limit) = file.limits.cost
        && !(limit.is_finite() && limit > 0.0)
    {
        return wrong("limits.cost", limit, "a finite number above zero");
    }
    let second = file.pareto.map(|second| second.output);
    let needed = match (file.limits.cost, [Some(file.objective.output), second].contains(&Some(Goal::Cost))) {
        (Some(_), _) => "`limits.cost`",
        (None, true) => "the objective `cost`",
        (None, false) => "",
    };
    if let (false, Some(k)) = (needed.is_empty(), types.iter().position(|one| one.cost.is_none())) {
        let expected = format!("the cost of a metre, as {needed} needs it");
        return wrong(&format!("cables[{k}].cost"), "missing", expected);
    }
    let of = |(k, cables): (usize, &Vec<usize>)| Variable {
        name: if groups.len() == 1 { "cables".to_owned() } else { format!("cables {}", k + 1) },
        parameters: Vec::new(),
        cables: cables.iter().map(|number| number - 1).collect(),
        domain: Domain::Choices((0..types.len()).map(|k| k as f64).collect()),
        nominal: AS_IT_IS,
    };
    let variables = groups.iter().enumerate().map(of).collect();
    Ok((types, variables))
}

fn cable_type(spec: &CableSpec) -> Result<CableType, InField> {
    let CableSpec { name, diameter, section, linear_density, youngs_modulus, breaking_force, cost } = spec;
    let Some(section) = section.or(diameter.map(|d| 0.25 * std::f64::consts::PI * d * d)) else {
        return wrong("section", "missing", "a section [m²], or a diameter [m] to compute it from");
    };
    if let Some(cost) = cost.filter(|cost| !(cost.is_finite() && *cost >= 0.0)) {
        return wrong("cost", cost, "a finite number, zero or more");
    }
    let properties = CableProperties {
        section,
        linear_density: *linear_density,
        youngs_modulus: *youngs_modulus,
        diameter: *diameter,
        breaking_force: *breaking_force,
        law: None,
    };
    Ok(CableType { name: name.clone(), properties, cost: *cost })
}

impl CableType {
    /// Whether cable `i` of a robot is of this type already, whatever its measured law.
    fn is_that_of(&self, robot: &Robot, i: usize) -> bool {
        let (one, other) = (&self.properties, &robot.cables[i].properties);
        let numbers = |of: &CableProperties| [of.section, of.linear_density, of.youngs_modulus];
        numbers(one) == numbers(other)
    }

    /// Gives cable `i` this type; its greatest tension is at most the breaking force. A measured law stays
    /// where the type is that of the robot's own cable.
    pub(crate) fn put_on(&self, robot: &mut Robot, i: usize) {
        let breaking = self.properties.breaking_force.filter(|force| *force < robot.limits(i).max);
        let keeps_law = self.is_that_of(robot, i);
        let cable = &mut robot.cables[i];
        let law = cable.properties.law.take().filter(|_| keeps_law);
        cable.properties = CableProperties { law, ..self.properties.clone() };
        if breaking.is_some() {
            cable.tension_limits.max = breaking;
        }
    }

    /// What is chosen where these cables, from 0, are of this type.
    pub(crate) fn chosen(&self, cables: &[usize], lengths: &[f64]) -> ChosenCable {
        let length = cables.iter().map(|i| lengths[*i]).sum::<f64>();
        ChosenCable {
            cables: cables.iter().map(|i| i + 1).collect(),
            name: self.name.clone(),
            length,
            mass: self.properties.linear_density * length,
            cost: self.cost.map(|cost| cost * length),
        }
    }
}

/// What is said of cables with a measured law that may become ones of a type, which have none.
pub(crate) fn left_laws(types: &[CableType], variables: &[Variable], robot: &Robot) -> Option<String> {
    let loses = |i: &usize| {
        robot.cables[*i].properties.law.is_some() && !types.iter().all(|one| one.is_that_of(robot, *i))
    };
    let mut cables: Vec<usize> = variables.iter().flat_map(|of| &of.cables).copied().filter(loses).collect();
    cables.sort_unstable();
    if cables.is_empty() {
        return None;
    }
    let all = robot.cables.len();
    let numbers: Vec<String> = cables.iter().map(|i| (i + 1).to_string()).collect();
    let which = match numbers.len() {
        1 => format!("cable {} has", numbers[0]),
        count if count == all => "all cables have".to_owned(),
        _ => format!("cables {} have", numbers.join(", ")),
    };
    Some(format!(
        "The types of cable are linear, by their youngs_modulus: the measured law that {which} in the robot \
         file is not that of other cables, and only the robot as it is has it."
    ))
}

/// The type that a variable has with this value; `None` for one of parameters and for a robot as it is.
pub(crate) fn type_at(types: &[CableType], value: f64) -> Option<&CableType> {
    if value < 0.0 { None } else { types.get(value as usize) }
}
