//! Error models: which parameters are uncertain, by how much, and which of them together.
//!
//! A *cause* is an input whose value x is added to one parameter or, with a factor f, to several:
//!
//! ```text
//! deviation_p = sum over the causes c of p:  f_cp x_c                      (M1)
//! d y / d x_c = sum over the parameters p of c:  f_cp dy/dp                (M2)
//! ```
//!
//! Two exit points on one pulley block share the error of the block, which is a cause of both, beside an
//! error of their own. Their deviations are correlated by `var_block / (var_block + var_own)`, whereas the
//! causes are independent. Therefore every measure of sensitivity holds for the causes, and names what an
//! engineer can change.

use crate::error::StudyError;
use crate::file::study_file::InputSpec;
use cdpr_robot::{Deviations, Parameter, ParameterLayout, Robot};
use cdpr_sensitivity::{Input, Law, SensitivityError};
use indexmap::IndexMap;

/// The causes of an error model, for robots with the same parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorModel {
    /// One input for each cause: parameters in the order of the parameter vector, then causes of several
    /// parameters in the order of the file.
    pub inputs: Vec<Input>,
    /// Entry of the error model that each input comes from.
    pub entries: Vec<String>,
    /// The parameters to which the inputs are added.
    pub terms: Vec<Term>,
    /// The order of the parameters, and the parameters.
    layout: ParameterLayout,
    parameters: Vec<Parameter>,
}

/// A term of equation (M1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// Number of the input.
    pub input: usize,
    /// Index in [`Parameter::of`] of the parameter that it is added to.
    pub parameter: usize,
    /// Its factor.
    pub factor: f64,
}

/// What is wrong with an entry of an error model.
#[derive(Debug)]
pub(crate) enum Wrong {
    /// A field below the model, its value, and what would be right.
    Field { field: String, value: String, expected: String },
    /// A law or its steps.
    Law(SensitivityError),
}

impl Wrong {
    pub(crate) fn field(
        field: impl Into<String>,
        value: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        Self::Field { field: field.into(), value: value.into(), expected: expected.into() }
    }
}

/// The text of messages where a parameter is expected.
fn a_parameter() -> String {
    format!("a parameter ({})", Parameter::NAMES)
}

/// The names of the groups of these parameters, as messages list them.
fn groups(parameters: &[Parameter]) -> String {
    let mut groups: Vec<_> = parameters.iter().map(Parameter::group).collect();
    groups.dedup();
    groups.join(", ")
}

/// The standard deviation of each parameter of a robot [SI units], in the order of [`Parameter::of`], from
/// those that have names: its own, else that of its group, else none.
///
/// # Errors
/// [`StudyError::Setting`] for a name that is neither a parameter nor a group, and a number that is not
/// positive and finite.
pub fn uncertainties(robot: &Robot, named: &[(String, f64)]) -> Result<Vec<f64>, StudyError> {
    let parameters = Parameter::of(robot);
    let known = |name: &str| parameters.iter().any(|p| p.group() == name || p.to_string() == name);
    let wrong = |(name, std): &&(String, f64)| !(known(name) && *std > 0.0 && std.is_finite());
    if let Some((name, std)) = named.iter().find(wrong) {
        let expected = format!(
            "a positive standard deviation of {} or one of their parameters, such as a1.x",
            groups(&parameters)
        );
        return Err(StudyError::setting(format!("uncertainty of {name}"), std, expected));
    }
    let of = |name: &str| named.iter().find(|(given, _)| given == name).map(|(_, std)| *std);
    Ok(parameters.iter().map(|p| of(&p.to_string()).or_else(|| of(p.group())).unwrap_or(0.0)).collect())
}

impl ErrorModel {
    /// The unit of an input by its index; none for a cause of parameters in different units.
    pub fn unit(&self, input: usize) -> Option<&'static str> {
        let mut terms = self.terms.iter().filter(|term| term.input == input);
        let unit = self.parameters[terms.next()?.parameter].unit();
        terms.all(|term| self.parameters[term.parameter].unit() == unit).then_some(unit)
    }

    pub(crate) fn new(model: &IndexMap<String, InputSpec>, robot: &Robot) -> Result<Self, Wrong> {
        let parameters = Parameter::of(robot);
        let names: Vec<String> = parameters.iter().map(ToString::to_string).collect();
        let known = |key: &String| names.contains(key) || parameters.iter().any(|p| p.group() == key);
        let mut found = Self {
            inputs: Vec::new(),
            entries: Vec::new(),
            terms: Vec::new(),
            layout: ParameterLayout::of(robot),
            parameters: parameters.clone(),
        };
        if let Some((key, _)) = model.iter().find(|(key, spec)| spec.parameters.is_none() && !known(key)) {
            let expected = format!(
                "{}, a group of parameters ({}), or an entry with `parameters`",
                a_parameter(),
                groups(&parameters)
            );
            return Err(Wrong::field(key, key, expected));
        }
        for (index, (parameter, own)) in parameters.iter().zip(&names).enumerate() {
            // A cause of several parameters that bears the name of one is refused below.
            let entry = model.get_key_value(own).or_else(|| model.get_key_value(parameter.group()));
            if let Some((entry, spec)) = entry {
                found.add(entry, own, spec, [(index, 1.0)])?;
            }
        }
        for (key, spec) in model {
            let Some(shared) = &spec.parameters else { continue };
            if known(key) || !key.chars().all(|c| c.is_ascii_alphanumeric() || "._-".contains(c)) {
                let expected = "a name of letters, digits, `.`, `_` and `-` that no parameter or group has";
                return Err(Wrong::field(key, key, expected));
            }
            if shared.is_empty() {
                return Err(Wrong::field(format!("{key}.parameters"), "empty", a_parameter()));
            }
            let effect = |(name, factor): (&String, &f64)| {
                let index = names.iter().position(|known| known == name);
                let index =
                    index.ok_or_else(|| Wrong::field(format!("{key}.parameters"), name, a_parameter()))?;
                if !factor.is_finite() || *factor == 0.0 {
                    let expected = "a finite factor that is not zero";
                    return Err(Wrong::field(
                        format!("{key}.parameters.{name}"),
                        factor.to_string(),
                        expected,
                    ));
                }
                Ok((index, *factor))
            };
            found.add(key, key, spec, shared.iter().map(effect).collect::<Result<Vec<_>, _>>()?)?;
        }
        Ok(found)
    }

    /// Independent normal deviations with these standard deviations (SI units, in the order of
    /// [`Parameter::of`]); a parameter with zero is known.
    pub fn normal(robot: &Robot, deviations: &[f64]) -> Self {
        let parameters = Parameter::of(robot);
        let uncertain = || parameters.iter().zip(deviations).enumerate().filter(|(_, (_, std))| **std > 0.0);
        let inputs: Vec<_> = uncertain()
            .map(|(_, (name, std))| Input::continuous(name.to_string(), Law::Normal { mean: 0.0, std: *std }))
            .collect();
        Self {
            entries: inputs.iter().map(|input| input.name.clone()).collect(),
            inputs,
            terms: uncertain()
                .enumerate()
                .map(|(input, (parameter, _))| Term { input, parameter, factor: 1.0 })
                .collect(),
            layout: ParameterLayout::of(robot),
            parameters,
        }
    }

    fn add(
        &mut self,
        entry: &str,
        name: &str,
        spec: &InputSpec,
        effects: impl IntoIterator<Item = (usize, f64)>,
    ) -> Result<(), Wrong> {
        let input = Input { name: name.to_owned(), law: spec.law, steps: spec.steps };
        input.validate().map_err(Wrong::Law)?;
        let number = self.inputs.len();
        self.inputs.push(input);
        self.entries.push(entry.to_owned());
        self.terms.extend(effects.into_iter().map(|(parameter, factor)| Term {
            input: number,
            parameter,
            factor,
        }));
        Ok(())
    }

    /// Length of the parameter vector.
    pub fn parameters(&self) -> usize {
        self.parameters.len()
    }

    /// Checks that it is one for the parameters of `robot`.
    ///
    /// # Errors
    /// [`StudyError::Setting`].
    pub fn check(&self, robot: &Robot) -> Result<(), StudyError> {
        let (given, expected) = (self.parameters(), Parameter::of(robot).len());
        if given == expected {
            return Ok(());
        }
        let expected = format!("one for the {expected} parameters of {}", robot.name);
        Err(StudyError::setting("error model", format!("for {given} parameters"), expected))
    }

    /// Equation (M1): the deviation of each parameter for each of `rows`, vectors one after the other.
    pub fn deviations(&self, rows: &[f64]) -> Deviations<'_> {
        let rows = rows.chunks_exact(self.inputs.len());
        let mut deviations = Deviations::zeros(&self.layout, rows.len());
        for (deviations, row) in deviations.rows_mut().zip(rows) {
            for Term { input, parameter, factor } in &self.terms {
                deviations[*parameter] += factor * row[*input];
            }
        }
        deviations
    }

    /// Equation (M2): derivatives with respect to the inputs from those with respect to the parameters.
    pub fn gradient(&self, slopes: &[f64]) -> Vec<f64> {
        let mut gradient = vec![0.0; self.inputs.len()];
        for Term { input, parameter, factor } in &self.terms {
            gradient[*input] += factor * slopes[*parameter];
        }
        gradient
    }

    /// The variance that each input adds to a quantity with these derivatives with respect to the parameters,
    /// to first order.
    pub fn variances(&self, slopes: &[f64]) -> Vec<f64> {
        let each = self.gradient(slopes).into_iter().zip(&self.inputs);
        each.map(|(slope, input)| (slope * input.law.std()).powi(2)).collect()
    }

    /// Whether tension set-points deviate.
    pub fn has_offsets(&self) -> bool {
        self.terms.iter().any(|term| self.parameters[term.parameter].group() == "dt")
    }

    /// The group of parameters that an input acts on; `shared` where there are several.
    pub fn group(&self, input: usize) -> &'static str {
        let of_input = self.terms.iter().filter(|term| term.input == input);
        let mut groups = of_input.map(|term| self.parameters[term.parameter].group());
        let first = groups.next().unwrap_or("shared");
        if groups.all(|group| group == first) { first } else { "shared" }
    }
}
