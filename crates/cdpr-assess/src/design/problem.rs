//! A design file with its robot, checked.

use crate::design::cables::{CableType, ChosenCable, type_at, types};
use crate::design::file::{DESIGN_FORMAT, DesignFile, LimitsSpec, Over};
use crate::design::goal::Goal;
use crate::design::variable::{Domain, Variable, variables, with, wrong};
use cdpr_robot::{Coordinate, Parameter, Pose, Robot, RobotError, Vector6, Wrench, significant};
use cdpr_statics::Load;
use cdpr_study::{ErrorModel, InField, InputKind, StudyError, error_model, from_text, read_text};
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::path::Path;
use std::time::Instant;

/// Step of differences, as a share of the range between the bounds.
pub(crate) const STEP: f64 = 1e-4;
/// Points of a front.
const MOST_POINTS: usize = 1000;
/// Poses of a design.
const MOST_POSES: usize = 10_000;
/// Configurations of the choices, each with all starts of the local search where something has bounds, and
/// of a front.
const MOST_SEARCHES: usize = 100_000;
/// The same of choices alone.
const MOST_CONFIGURATIONS: usize = 1_000_000;

/// A robot, what of it may change, and what is to be as good as possible.
#[derive(Clone, Debug)]
pub struct DesignProblem {
    pub(crate) robot: Robot,
    pub(crate) variables: Vec<Variable>,
    /// Types of cable that variables choose from.
    pub(crate) types: Vec<CableType>,
    pub(crate) poses: Vec<Pose>,
    pub(crate) free: Vec<Coordinate>,
    pub(crate) load: Load,
    /// Deviations from which position errors follow.
    pub(crate) errors: Option<ErrorModel>,
    pub(crate) output: Goal,
    pub(crate) over: Over,
    /// A second objective.
    pub(crate) second: Option<(Goal, Over)>,
    /// Points of the front of both.
    pub(crate) points: usize,
    /// What the second objective has to reach, in its unit.
    pub(crate) bound: Option<f64>,
    pub(crate) limits: LimitsSpec,
    pub(crate) starts: usize,
    pub(crate) seed: Option<u64>,
    /// By which rotations are measured [m]: a constant, that of the robot as it is.
    pub(crate) characteristic_length: f64,
}

impl DesignProblem {
    /// Reads and checks a design file for a robot.
    ///
    /// # Errors
    /// [`StudyError`] naming file, field, value and what would be right.
    pub fn open(path: &Path, robot: Robot) -> Result<Self, StudyError> {
        Self::from_json(&read_text(path, InputKind::Design)?, path, robot)
    }

    /// The same from its text; `path` names it in errors.
    ///
    /// # Errors
    /// As [`DesignProblem::open`].
    pub fn from_json(text: &str, path: &Path, robot: Robot) -> Result<Self, StudyError> {
        let file: DesignFile = from_text(text, path, InputKind::Design)?;
        Self::new(&file, robot).map_err(|(field, value, expected)| {
            StudyError::Invalid { path: path.to_owned(), field, value, expected }.placed(text)
        })
    }

    /// Checks a design file for a robot.
    ///
    /// # Errors
    /// Field, value and what is expected.
    pub fn new(file: &DesignFile, robot: Robot) -> Result<Self, InField> {
        if file.format != DESIGN_FORMAT {
            return wrong("format", &file.format, DESIGN_FORMAT);
        }
        let poses = file.poses.poses().map_err(|(of, value, why)| (format!("poses.{of}"), value, why))?;
        if poses.len() > MOST_POSES {
            return wrong("poses", poses.len(), format!("at most {MOST_POSES} poses"));
        }
        let size = robot.platform_size();
        let (types, of_cables) = types(file, &robot)?;
        let problem = Self {
            variables: variables(&file.variables, &robot)?.into_iter().chain(of_cables).collect(),
            types,
            poses,
            free: file.free.clone(),
            load: load(file)?,
            errors: errors(file, &robot)?,
            output: file.objective.output,
            over: file.objective.over,
            second: file.pareto.map(|second| (second.output, second.over)),
            points: file.pareto.map_or(0, |second| second.points),
            bound: None,
            limits: file.limits,
            starts: file.starts,
            seed: file.seed,
            characteristic_length: if size > 0.0 { size } else { 1.0 },
            robot,
        };
        problem.check()?;
        Ok(problem)
    }

    /// Checks what may change, and that a cost has types of cable.
    fn check_variables(&self) -> Result<(), InField> {
        if self.variables.is_empty() {
            return wrong("variables", "empty", "at least one variable, or types of `cables`");
        }
        if let (Some(limit), true) = (self.limits.cost, self.types.is_empty()) {
            return wrong("limits.cost", limit, "none without types of `cables` with their cost");
        }
        if self.needs(Goal::Cost) && self.types.is_empty() {
            let expected = "types of cable with the cost of a metre, as an objective `cost` needs them";
            return wrong("cables", "empty", expected);
        }
        let by_type =
            |(name, _): &(Parameter, f64)| matches!(name.group(), "youngs_modulus" | "linear_density");
        let by_type = |of: &&Variable| !self.types.is_empty() && of.parameters.iter().any(by_type);
        if let Some(of) = self.variables.iter().find(by_type) {
            return wrong(
                "variables",
                &of.name,
                "no modulus and no linear density, which the type of cable sets",
            );
        }
        Ok(())
    }

    /// Checks the objectives.
    fn check_goals(&self) -> Result<(), InField> {
        let Self { output, .. } = self;
        for (of, goal) in [("objective", Some((*output, self.over))), ("pareto", self.second)] {
            match goal {
                Some((output @ Goal::Amplitude, _)) => {
                    return wrong(&format!("{of}.output"), output, Goal::NAMES);
                }
                Some((output, Over::Mean)) if output.is_of_all_poses() => {
                    let expected = format!("worst, or none: the {output} is one number of all poses");
                    return wrong(&format!("{of}.over"), "mean", expected);
                }
                _ => {}
            }
        }
        if self.second == Some((*output, self.over)) {
            return wrong(
                "pareto",
                format!("the {output} as in `objective`"),
                "another output, or another `over`",
            );
        }
        if self.second.is_some() && !(2..=MOST_POINTS).contains(&self.points) {
            return wrong("pareto.points", self.points, format!("2 to {MOST_POINTS}"));
        }
        Ok(())
    }

    fn check(&self) -> Result<(), InField> {
        let Self { robot, output, load, .. } = self;
        self.check_variables()?;
        self.check_goals()?;
        if self.needs(Goal::Position) && self.errors.is_none() {
            let expected = "the deviations that a position error follows from, such as {\"b\": {\"law\": \
                            {\"normal\": {\"mean\": 0, \"std\": 0.001}}}}";
            return wrong("errors", "missing", expected);
        }
        for (of, limit) in self.limits.all() {
            if !(limit.is_finite() && limit > 0.0) {
                return wrong(
                    &format!("limits.{of}"),
                    limit,
                    match of.unit() {
                        "" => "a finite number above zero".to_owned(),
                        unit => format!("a finite number above zero [{unit}]"),
                    },
                );
            }
        }
        if self.needs(Goal::Deflection) && *load == Load::none() {
            return wrong(
                "payload",
                load.payload,
                "a mass above zero [kg], or a `wrench`: nothing else deflects",
            );
        }
        if (self.needs(Goal::Frequency) || self.needs(Goal::PlatformFrequency)) && robot.lacks_inertia() {
            let expected = "deflection or stiffness, or a robot with `platform.inertia`";
            return wrong("objective.output", output, expected);
        }
        if self.bounded().next().is_some() && !robot.distribution.is_smooth() {
            let expected = "choices instead of bounds, or a robot whose `distribution` is nearest or least_2_norm: \
                            the tensions of other norms jump";
            return wrong("variables", format!("bounds with {}", robot.distribution.name()), expected);
        }
        let missing = robot.freedoms().count().saturating_sub(robot.cables.len());
        let distinct: BTreeSet<_> = self.free.iter().map(|one| one.component()).collect();
        let are_free = distinct.iter().all(|component| robot.freedoms().contains(*component));
        if self.free.len() != missing || distinct.len() != missing || !are_free {
            let names: Vec<_> = self.free.iter().map(ToString::to_string).collect();
            let expected = format!(
                "{missing} different ones of x, y, z, roll, pitch, yaw that `plane` and `point` leave free, \
                 for {} \
                 cables and {} free motions",
                robot.cables.len(),
                robot.freedoms().count()
            );
            return wrong("free", format!("[{}]", names.join(", ")), expected);
        }
        if self.starts == 0 {
            return wrong("starts", self.starts, "1 or more");
        }
        self.check_configurations()
    }

    /// Refuses more configurations than are evaluated, with the time that all of them would take.
    fn check_configurations(&self) -> Result<(), InField> {
        let is_alone = self.bounded().next().is_none() && self.second.is_none();
        let (each, most) = (self.searches_each(), if is_alone { MOST_CONFIGURATIONS } else { MOST_SEARCHES });
        let configurations = self.configurations();
        if configurations.and_then(|count| count.checked_mul(each)).is_some_and(|count| count <= most) {
            return Ok(());
        }
        if configurations == Some(1) {
            let expected = format!("1 or more, and at most {most} configurations with all starts");
            return wrong("starts", self.starts, expected);
        }
        let each = if each == 1 { String::new() } else { format!(" with {each} starts in each") };
        let count = self.variables.iter().map(|of| of.count() as f64).product::<f64>();
        let number = configurations.map_or_else(|| significant(count, 4), |count| count.to_string());
        let value = format!("{number} configurations{each}");
        let seconds = self.pace() * count;
        let time = if seconds < 3600.0 {
            format!("{} s", significant(seconds, 2))
        } else {
            format!("{} h", significant(seconds / 3600.0, 2))
        };
        let expected = format!(
            "choices with at most {most} configurations (with bounds or a second objective {MOST_SEARCHES}, \
             times the starts); to evaluate each of these once would take about {time} here"
        );
        wrong("variables", value, expected)
    }

    /// Seconds for each configuration, by some all over the choices.
    fn pace(&self) -> f64 {
        /// Configurations that are tried, and a time after which no more are [s].
        const TRIED: usize = 256;
        const ENOUGH: f64 = 0.3;
        let (clock, mut tried) = (Instant::now(), 0);
        while tried < TRIED && clock.elapsed().as_secs_f64() < ENOUGH {
            (tried..tried + 16).into_par_iter().for_each(|k| {
                let value = |(j, of): (usize, &Variable)| of.choice(k * (2 * j + 1) + k / of.count());
                let values: Vec<f64> = self.variables.iter().enumerate().map(value).collect();
                let _ = self.evaluate(&values, None);
            });
            tried += 16;
        }
        clock.elapsed().as_secs_f64() / tried as f64
    }

    /// Whether this is the objective or limited.
    pub(crate) fn needs(&self, what: Goal) -> bool {
        let is_second = self.second.is_some_and(|(second, _)| second == what);
        self.output == what || is_second || self.limits.all().any(|(of, _)| of == what)
    }

    /// Indices of the variables with bounds.
    pub(crate) fn bounded(&self) -> impl Iterator<Item = (usize, [f64; 2])> {
        let of = |(j, variable): (usize, &Variable)| match variable.domain {
            Domain::Bounds(bounds) => Some((j, bounds)),
            Domain::Choices(_) => None,
        };
        self.variables.iter().enumerate().filter_map(of)
    }

    /// Values with those of the variables with bounds at a place in the box, whose sides are 1.
    pub(crate) fn placed(&self, mut values: Vec<f64>, place: &[f64]) -> Vec<f64> {
        for ((j, [low, high]), u) in self.bounded().zip(place) {
            // Exact at both ends.
            values[j] = low * (1.0 - u) + high * u;
        }
        values
    }

    /// Number of combinations of the choices; 1 without any, `None` where it is beyond all bounds.
    pub(crate) fn configurations(&self) -> Option<usize> {
        self.variables.iter().try_fold(1_usize, |count, variable| count.checked_mul(variable.count()))
    }

    /// Local searches, or single evaluations, of each configuration.
    pub(crate) fn searches_each(&self) -> usize {
        if self.bounded().next().is_some() { self.starts } else { 1 }
    }

    /// The values of a configuration; variables with bounds have the value that is nearest to the robot's.
    pub(crate) fn configuration(&self, mut number: usize) -> Vec<f64> {
        let of = |variable: &Variable| {
            let value = variable.choice(number);
            number /= variable.count();
            value
        };
        self.variables.iter().map(of).collect()
    }

    /// The robot with these values of the variables.
    ///
    /// # Errors
    /// Those of [`Robot::with_values`].
    pub(crate) fn robot_at(&self, values: &[f64]) -> Result<Robot, RobotError> {
        let mut robot = self.robot.clone();
        if values.iter().zip(&self.variables).any(|(at, of)| !of.cables.is_empty() && *at >= 0.0) {
            // What an import assumed of the cables is of others.
            robot.provenance.assumed.retain(|assumed| !assumed.starts_with("the cables are "));
        }
        for (variable, value) in self.variables.iter().zip(values) {
            for i in &variable.cables {
                type_at(&self.types, *value).into_iter().for_each(|of| of.put_on(&mut robot, *i));
            }
        }
        with(&robot, self.of_parameters().map(|(j, variable)| (variable, values[j])))
    }

    /// The variables of parameters with their indices.
    pub(crate) fn of_parameters(&self) -> impl Iterator<Item = (usize, &Variable)> {
        self.variables.iter().enumerate().filter(|(_, variable)| variable.cables.is_empty())
    }

    /// The types that these values choose, of cables with these lengths [m].
    pub(crate) fn chosen(&self, values: &[f64], lengths: &[f64]) -> Vec<ChosenCable> {
        let of = |(variable, value): (&Variable, &f64)| {
            type_at(&self.types, *value).map(|of| of.chosen(&variable.cables, lengths))
        };
        self.variables.iter().zip(values).filter(|(of, _)| !of.cables.is_empty()).filter_map(of).collect()
    }

    /// Cost of a metre of each cable; zero where its type has none.
    pub(crate) fn costs(&self, values: &[f64]) -> Vec<f64> {
        let mut costs = vec![0.0; self.robot.cables.len()];
        for (variable, value) in self.variables.iter().zip(values) {
            let cost = type_at(&self.types, *value).and_then(|of| of.cost).unwrap_or(0.0);
            variable.cables.iter().for_each(|i| costs[*i] = cost);
        }
        costs
    }

    /// Whether it has a second objective: then its answer is a [`crate::front`].
    pub fn has_front(&self) -> bool {
        self.second.is_some()
    }

    /// The values of the robot as it is.
    pub(crate) fn nominal(&self) -> Vec<f64> {
        self.variables.iter().map(|variable| variable.nominal).collect()
    }
}

/// The load of a file.
fn load(file: &DesignFile) -> Result<Load, InField> {
    if !(file.payload.is_finite() && file.payload >= 0.0) {
        return wrong("payload", file.payload, "a finite mass, zero or more [kg]");
    }
    if !file.wrench.iter().all(|component| component.is_finite()) {
        return wrong("wrench", format!("{:?}", file.wrench), "six finite numbers [N, N m]");
    }
    Ok(Load { payload: file.payload, wrench: Wrench::from_vector(&Vector6::from(file.wrench)) })
}

/// The error model of a file.
fn errors(file: &DesignFile, robot: &Robot) -> Result<Option<ErrorModel>, InField> {
    let Some(entries) = &file.errors else { return Ok(None) };
    let in_errors = |(field, value, expected)| (format!("errors.{field}"), value, expected);
    let model = error_model(entries, robot).map_err(in_errors)?;
    if model.inputs.is_empty() {
        return wrong("errors", "empty", "at least one parameter with the law of its deviation");
    }
    for (input, entry) in model.inputs.iter().zip(&model.entries) {
        let (mean, std) = (input.mean(), input.std());
        if !(mean.abs() <= 1e-9 * std && std.is_finite()) {
            let expected =
                "a law with mean zero and a finite standard deviation; a known mean belongs to the robot";
            return wrong(
                &format!("errors.{entry}.law"),
                format!("of mean {mean} and standard deviation {std}"),
                expected,
            );
        }
    }
    Ok(Some(model))
}
