//! What of a robot may change, and the robot with other values of it.

use crate::design::file::VariableSpec;
use cdpr_robot::{Parameter, ParameterLayout, Robot, RobotError};
use cdpr_study::InField;
use std::collections::BTreeSet;

/// Something that may change.
#[derive(Clone, Debug)]
pub(crate) struct Variable {
    pub(crate) name: String,
    /// The parameters with the sign of their change relative to that of the first.
    pub(crate) parameters: Vec<(Parameter, f64)>,
    /// Cables whose type it is, from 0, where it has no parameters.
    pub(crate) cables: Vec<usize>,
    pub(crate) domain: Domain,
    /// Its value in the robot as it is.
    pub(crate) nominal: f64,
}

/// The values that a variable may have.
#[derive(Clone, Debug)]
pub(crate) enum Domain {
    Bounds([f64; 2]),
    Choices(Vec<f64>),
}

impl Variable {
    /// Number of its choices; 1 within bounds.
    pub(crate) fn count(&self) -> usize {
        match &self.domain {
            Domain::Bounds(_) => 1,
            Domain::Choices(values) => values.len(),
        }
    }

    /// One of its choices, counted over and over; within bounds the value that is nearest to the robot's.
    pub(crate) fn choice(&self, number: usize) -> f64 {
        match &self.domain {
            Domain::Bounds([low, high]) => self.nominal.clamp(*low, *high),
            Domain::Choices(values) => values[number % values.len()],
        }
    }
}

/// The robot with other values of some variables.
pub(crate) fn with<'a>(
    robot: &Robot,
    values: impl Iterator<Item = (&'a Variable, f64)>,
) -> Result<Robot, RobotError> {
    let mut named = Vec::new();
    for (Variable { parameters, nominal, .. }, value) in values {
        for (k, (parameter, sign)) in parameters.iter().enumerate() {
            let moved = parameter.nominal(robot) + sign * (value - nominal);
            named.push((parameter.to_string(), if k == 0 { value } else { moved }));
        }
    }
    let named: Vec<(&str, f64)> = named.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    robot.with_values(&named)
}

/// An invalid value of a file.
pub(crate) fn wrong<T>(field: &str, value: impl ToString, expected: impl Into<String>) -> Result<T, InField> {
    Err((field.to_owned(), value.to_string(), expected.into()))
}

/// The variables of a file.
pub(crate) fn variables(specs: &[VariableSpec], robot: &Robot) -> Result<Vec<Variable>, InField> {
    let layout = ParameterLayout::of(robot);
    let mut taken = BTreeSet::new();
    let mut found = Vec::with_capacity(specs.len());
    for (j, spec) in specs.iter().enumerate() {
        let field = |of: &str| format!("variables[{j}].{of}");
        let signs = spec.signs.clone().unwrap_or_else(|| vec![1.0; spec.parameters.len()]);
        if signs.len() != spec.parameters.len() || signs.iter().any(|sign| sign.abs() != 1.0) {
            return wrong(&field("signs"), format!("{signs:?}"), "1 or -1 for each of the parameters");
        }
        let mut parameters = Vec::with_capacity(signs.len());
        for (k, (name, sign)) in spec.parameters.iter().zip(&signs).enumerate() {
            let of = field(&format!("parameters[{k}]"));
            let parameter = name.parse::<Parameter>().ok().filter(|one| layout.index(*one).is_some());
            match parameter {
                Some(Parameter::TensionOffset(_) | Parameter::Tilt(..)) | None => {
                    let expected = format!(
                        "a parameter of this robot with {} cables: {}; no dt and no tilt",
                        robot.cables.len(),
                        Parameter::NAMES
                    );
                    return wrong(&of, name, expected);
                }
                Some(Parameter::AnchorPoint(..)) if robot.platform.point => {
                    return wrong(&of, name, "no anchor point: those of a point mass are at it");
                }
                Some(parameter) if taken.insert(parameter) => parameters.push((parameter, sign * signs[0])),
                Some(_) => return wrong(&of, name, "a parameter of one variable alone"),
            }
        }
        let Some((first, _)) = parameters.first() else {
            return wrong(&field("parameters"), "empty", "at least one parameter, such as b1.x");
        };
        let (name, nominal) = (spec.name.clone().unwrap_or_else(|| first.to_string()), first.nominal(robot));
        let domain = domain(spec, &field)?;
        let (of, values) = match &domain {
            Domain::Bounds(bounds) => ("bounds", bounds.to_vec()),
            Domain::Choices(values) => ("choices", values.clone()),
        };
        let variable = Variable { name, parameters, cables: Vec::new(), domain, nominal };
        for value in values {
            if let Err(error) = with(robot, [(&variable, value)].into_iter()) {
                return wrong(&field(of), value, format!("values of a valid robot: {error}"));
            }
        }
        found.push(variable);
    }
    Ok(found)
}

/// The values that a variable may have.
fn domain(spec: &VariableSpec, field: &impl Fn(&str) -> String) -> Result<Domain, InField> {
    match (spec.bounds, &spec.choices) {
        (Some([low, high]), None) if low.is_finite() && high.is_finite() && low < high => {
            Ok(Domain::Bounds([low, high]))
        }
        (Some(bounds), None) => {
            wrong(&field("bounds"), format!("{bounds:?}"), "two finite numbers, the first one smaller")
        }
        (None, Some(values)) => {
            let is_sound = |(k, value): (usize, &f64)| value.is_finite() && !values[..k].contains(value);
            if values.is_empty() || !values.iter().enumerate().all(is_sound) {
                return wrong(
                    &field("choices"),
                    format!("{values:?}"),
                    "different finite numbers, at least one",
                );
            }
            Ok(Domain::Choices(values.clone()))
        }
        (bounds, _) => {
            let found = if bounds.is_some() { "bounds and choices" } else { "without bounds and choices" };
            wrong(&field("bounds"), found, "either `bounds` or `choices`")
        }
    }
}
