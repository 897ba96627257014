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
use crate::file::weather::{NominalWeather, WeatherNumbers, WeatherQuantity};
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
    /// The numbers of the weather to which they are added: indices in [`WeatherQuantity::ALL`] and factors.
    weather: Vec<Term>,
    /// The order of the parameters, and the parameters.
    layout: ParameterLayout,
    parameters: Vec<Parameter>,
}

/// A term of equation (M1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// Number of the input.
    pub input: usize,
    /// Index of the parameter that it is added to in [`Parameter::of`].
    pub parameter: usize,
    /// Its factor.
    pub factor: f64,
}

/// What an input is added to, by its index: a parameter of the robot, or a number of the weather.
enum Effect {
    Robot(usize),
    Weather(usize),
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

/// The text of messages where a parameter is expected, or also a number of the weather.
fn a_parameter(weather: bool) -> String {
    let names: Vec<_> = WeatherQuantity::ALL.map(WeatherQuantity::name).into();
    let of_weather = if weather { format!("; of the weather {}", names.join(", ")) } else { String::new() };
    format!("a parameter ({}{of_weather})", Parameter::NAMES)
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
        let of_robot = self.terms.iter().map(|term| (term, self.parameters[term.parameter].unit()));
        let of_weather = self.weather.iter().map(|term| (term, WeatherQuantity::ALL[term.parameter].unit()));
        let mut units =
            of_robot.chain(of_weather).filter(|(term, _)| term.input == input).map(|(_, unit)| unit);
        let first = units.next()?;
        units.all(|unit| unit == first).then_some(first)
    }

    /// That of the entries of a study, or of a file. Numbers of the weather are for studies, which have one.
    pub(crate) fn new(
        model: &IndexMap<String, InputSpec>,
        robot: &Robot,
        weather: Option<&NominalWeather>,
    ) -> Result<Self, Wrong> {
        let of_weather = |key: &str| WeatherQuantity::named(key).filter(|_| weather.is_some());
        let parameters = Parameter::of(robot);
        let names: Vec<String> = parameters.iter().map(ToString::to_string).collect();
        let known = |key: &String| {
            names.contains(key)
                || parameters.iter().any(|p| p.group() == key)
                || WeatherQuantity::named(key).is_some()
        };
        let mut found = Self {
            inputs: Vec::new(),
            entries: Vec::new(),
            terms: Vec::new(),
            weather: Vec::new(),
            layout: ParameterLayout::of(robot),
            parameters: parameters.clone(),
        };
        if let Some(key) = model.keys().find(|key| weather.is_none() && WeatherQuantity::named(key).is_some())
        {
            let expected = "no number of the weather: only samplings of a study, with output deflection or \
                            position, are observed in weather";
            return Err(Wrong::field(key, key, expected));
        }
        if let Some((key, _)) = model.iter().find(|(key, spec)| spec.parameters.is_none() && !known(key)) {
            let expected = format!(
                "{}, a group of parameters ({}), or an entry with `parameters`",
                a_parameter(weather.is_some()),
                groups(&parameters)
            );
            return Err(Wrong::field(key, key, expected));
        }
        for (index, (parameter, own)) in parameters.iter().zip(&names).enumerate() {
            // A cause of several parameters that bears the name of one is refused below.
            let entry = model.get_key_value(own).or_else(|| model.get_key_value(parameter.group()));
            if let Some((entry, spec)) = entry {
                found.add(entry, own, spec, [(Effect::Robot(index), 1.0)])?;
            }
        }
        for (index, quantity) in WeatherQuantity::ALL.into_iter().enumerate() {
            if let Some((entry, spec)) = model.get_key_value(quantity.name()) {
                found.add(entry, entry, spec, [(Effect::Weather(index), 1.0)])?;
            }
        }
        for (key, spec) in model {
            let Some(shared) = &spec.parameters else { continue };
            if known(key) || !key.chars().all(|c| c.is_ascii_alphanumeric() || "._-".contains(c)) {
                let expected = "a name of letters, digits, `.`, `_` and `-` that no parameter or group has";
                return Err(Wrong::field(key, key, expected));
            }
            if shared.is_empty() {
                let expected = a_parameter(weather.is_some());
                return Err(Wrong::field(format!("{key}.parameters"), "empty", expected));
            }
            let effect = |(name, factor): (&String, &f64)| {
                let of_robot = names.iter().position(|known| known == name).map(Effect::Robot);
                let index = of_robot.or_else(|| Some(Effect::Weather(of_weather(name)? as usize)));
                let index = index.ok_or_else(|| {
                    Wrong::field(format!("{key}.parameters"), name, a_parameter(weather.is_some()))
                })?;
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
        if let Some(weather) = weather {
            found.check_weather(weather)?;
        }
        Ok(found)
    }

    /// Refuses numbers of the weather that may fall below zero, and a temperature without an expansion.
    fn check_weather(&self, nominal: &NominalWeather) -> Result<(), Wrong> {
        let (mut lowest, mut named) = (nominal.numbers, [None; WeatherQuantity::ALL.len()]);
        for Term { input, parameter, factor } in &self.weather {
            let support = self.inputs[*input].law.support();
            lowest[*parameter] += (factor * support.min).min(factor * support.max);
            named[*parameter] = Some(&self.entries[*input]);
        }
        for (quantity, (lowest, entry)) in WeatherQuantity::ALL.into_iter().zip(lowest.into_iter().zip(named))
        {
            let Some(entry) = entry else { continue };
            // A quantile is rounded.
            if quantity.is_size() && (lowest.is_nan() || lowest < -1e-15) {
                let expected = format!(
                    "a law with which {} stays zero or more, such as weibull, or a truncated_normal from the \
                     least one on",
                    quantity.name()
                );
                return Err(Wrong::field(format!("{entry}.law"), format!("{lowest} and more"), expected));
            }
            let expands = nominal.expands() || named[3..5].iter().any(Option::is_some);
            if quantity == WeatherQuantity::Warmer && !expands {
                let expected =
                    "`cable_expansion` or `frame_expansion` in `weather` [1/K], too, by which it acts";
                return Err(Wrong::field(entry, entry, expected));
            }
        }
        Ok(())
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
            weather: Vec::new(),
            layout: ParameterLayout::of(robot),
            parameters,
        }
    }

    fn add(
        &mut self,
        entry: &str,
        name: &str,
        spec: &InputSpec,
        effects: impl IntoIterator<Item = (Effect, f64)>,
    ) -> Result<(), Wrong> {
        let input = Input { name: name.to_owned(), law: spec.law, steps: spec.steps };
        input.validate().map_err(Wrong::Law)?;
        let number = self.inputs.len();
        self.inputs.push(input);
        self.entries.push(entry.to_owned());
        for (effect, factor) in effects {
            let (terms, parameter) = match effect {
                Effect::Robot(index) => (&mut self.terms, index),
                Effect::Weather(index) => (&mut self.weather, index),
            };
            terms.push(Term { input: number, parameter, factor });
        }
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

    /// Equation (M1) for the numbers of the weather: their deviations for a row of inputs.
    pub(crate) fn of_weather(&self, row: &[f64]) -> WeatherNumbers {
        let mut deviations = [0.0; WeatherQuantity::ALL.len()];
        for Term { input, parameter, factor } in &self.weather {
            deviations[*parameter] += factor * row[*input];
        }
        deviations
    }

    /// The numbers of the weather that inputs are added to, as terms of (M1).
    pub(crate) fn weather_terms(&self) -> impl Iterator<Item = (WeatherQuantity, &Term)> {
        self.weather.iter().map(|term| (WeatherQuantity::ALL[term.parameter], term))
    }

    /// Whether an input is one of the weather, alone or with parameters of the robot.
    pub fn is_of_weather(&self, input: usize) -> bool {
        self.weather.iter().any(|term| term.input == input)
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
        each.map(|(slope, input)| (slope * input.std()).powi(2)).collect()
    }

    /// Whether tension set-points deviate.
    pub fn has_offsets(&self) -> bool {
        self.terms.iter().any(|term| self.parameters[term.parameter].group() == "dt")
    }

    /// The group of parameters that an input acts on, or `weather`; `shared` where there are several.
    pub fn group(&self, input: usize) -> &'static str {
        let of_robot = self.terms.iter().map(|term| (term, self.parameters[term.parameter].group()));
        let of_weather = self.weather.iter().map(|term| (term, WeatherQuantity::GROUP));
        let of_input = of_robot.chain(of_weather).filter(|(term, _)| term.input == input);
        let mut groups = of_input.map(|(_, group)| group);
        let first = groups.next().unwrap_or("shared");
        if groups.all(|group| group == first) { first } else { "shared" }
    }
}
