//! What is observed of a robot at the poses of a design, with derivatives by the variables.

use crate::design::at_rest::AtRest;
use crate::design::file::Over;
use crate::design::goal::{Goal, sense};
use crate::design::problem::DesignProblem;
use crate::design::variable::Variable;
use cdpr_dynamics::{FrequencyDerivatives, Modes, Swing};
use cdpr_robot::{CableEnd, Parameter, Robot};
use cdpr_statics::derivatives::derivatives_from;
use cdpr_statics::limits::allowed;
use cdpr_statics::{
    Deflection, Derivatives, DirectProblem, Load, StaticsError, WantedPose, deflection, deflection_from,
    derivatives, inverse,
};

/// A number with its derivatives by the variables, which are empty where none were wanted.
#[derive(Clone, Debug)]
pub(crate) struct Quantity {
    pub(crate) value: f64,
    pub(crate) slopes: Vec<f64>,
}

/// What is observed of a robot.
#[derive(Clone, Debug, Default)]
pub(crate) struct Evaluation {
    /// The objective in its unit: a number for each pose, one for each cable of each pose where the greatest
    /// tension counts, or one of all poses together.
    pub(crate) outputs: Vec<Quantity>,
    /// The same of a second objective, where there is one.
    pub(crate) seconds: Vec<Quantity>,
    /// By how much a demand is passed, as a share of its limit; zero or less where it is met. Their order is
    /// that of `design/demand.rs`.
    pub(crate) excesses: Vec<Quantity>,
    /// Greatest unstrained length of each cable over the poses [m].
    pub(crate) longest: Vec<Quantity>,
}

impl DesignProblem {
    /// What is observed of the robot with these values, with derivatives or without: those of position errors
    /// by differences over this share of the range between the bounds, all others exact.
    ///
    /// # Errors
    /// Why it is not held at a pose, or has no derivatives there.
    pub(crate) fn evaluate(&self, values: &[f64], step: Option<f64>) -> Result<Evaluation, StaticsError> {
        let robot = self.robot_at(values)?;
        let positions =
            if self.needs(Goal::Position) { self.position_errors(values, step)? } else { Vec::new() };
        let mut positions = positions.into_iter();
        let mut found = Evaluation::default();
        let none = Load::none();
        let mut solved = if self.free.is_empty() { inverse(&robot, &self.poses, &none) } else { Vec::new() };
        let in_lanes = step.is_none() && self.is_for_lanes(&robot);
        let loaded = if in_lanes { self.loaded(&robot, std::mem::take(&mut solved))? } else { Vec::new() };
        let (mut solved, mut loaded) = (solved.into_iter(), loaded.into_iter());
        let at_exits = (0..robot.cables.len()).any(|i| !robot.max_at(i).is_anchor());
        let needs_exits = self.needs(Goal::Tension) || (self.tensions_each() > 0 && at_exits);
        for pose in &self.poses {
            let wanted = WantedPose::at(pose).free(&self.free);
            let alone = |found: Deflection| (AtRest::Alone(Box::new(found)), None);
            let (rest, slopes) = match (loaded.next(), solved.next().transpose()?, step.is_some()) {
                (Some(rest), ..) => (rest, None),
                (None, Some(held), true) => sloped(derivatives_from(&robot, wanted, &self.load, held)?),
                (None, None, true) => sloped(derivatives(&robot, wanted, &self.load)?),
                (None, Some(held), false) => {
                    alone(deflection_from(&robot, held.lengths, &self.load, &held.equilibrium)?)
                }
                (None, None, false) => alone(deflection(&robot, wanted, &self.load)?),
            };
            let position = positions.next();
            let exits = Vec::new();
            let mut at = AtPose { problem: self, robot: &robot, rest, slopes, exits, position };
            if needs_exits {
                at.exits = at.exit_tensions()?;
            }
            at.objective(self.output, self.over, &mut found.outputs)?;
            if let Some((second, over)) = self.second {
                at.objective(second, over, &mut found.seconds)?;
            }
            for (of, limit) in self.limits.each() {
                let sign = sense(of);
                found.excesses.push(at.output(of)?.scaled(sign / limit, -sign));
            }
            if let Some(limit) = self.limits.tension {
                found.excesses.extend(at.exits.iter().map(|of| of.clone().scaled(1.0 / limit, -1.0)));
            }
            if self.tensions_each() > 0 {
                at.tensions(&mut found.excesses);
            }
            at.lengthen(&mut found.longest);
        }
        let whole = |of: Goal, longest: &[Quantity]| match of {
            Goal::Cost => total(longest, &self.costs(values)),
            _ => total(longest, &vec![1.0; longest.len()]),
        };
        for (of, limit) in self.limits.whole() {
            found.excesses.push(whole(of, &found.longest).scaled(1.0 / limit, -1.0));
        }
        if self.output.is_of_all_poses() {
            found.outputs.push(whole(self.output, &found.longest));
        }
        if let Some((second, _)) = self.second.filter(|(second, _)| second.is_of_all_poses()) {
            found.seconds.push(whole(second, &found.longest));
        }
        if let (Some((second, over)), Some(bound)) = (self.second, self.bound) {
            let sign = sense(second);
            let excess = |of: Quantity| of.scaled(sign / bound.abs(), -sign * bound.signum());
            found.excesses.extend(over.of(&found.seconds).into_iter().map(excess));
        }
        Ok(found)
    }
}

impl Over {
    /// The quantities of which the worst counts: those of the poses, or their mean.
    pub(crate) fn of(self, poses: &[Quantity]) -> Vec<Quantity> {
        let share = 1.0 / poses.len() as f64;
        let slope = |j: usize| share * poses.iter().map(|of| of.slopes[j]).sum::<f64>();
        match (self, poses) {
            (Self::Mean, [first, ..]) => vec![Quantity {
                value: share * poses.iter().map(|of| of.value).sum::<f64>(),
                slopes: (0..first.slopes.len()).map(slope).collect(),
            }],
            _ => poses.to_vec(),
        }
    }
}

/// The sum of `factors` times the quantities.
fn total(quantities: &[Quantity], factors: &[f64]) -> Quantity {
    let sum = |of: &dyn Fn(&Quantity) -> f64| {
        quantities.iter().zip(factors).map(|(q, factor)| factor * of(q)).sum()
    };
    let count = quantities.first().map_or(0, |first| first.slopes.len());
    Quantity { value: sum(&|q| q.value), slopes: (0..count).map(|j| sum(&|q| q.slopes[j])).collect() }
}

fn sloped(found: Derivatives) -> (AtRest, Option<Derivatives>) {
    (AtRest::Alone(Box::new(found.deflection.clone())), Some(found))
}

/// A robot at a pose, with derivatives or without.
struct AtPose<'a> {
    problem: &'a DesignProblem,
    robot: &'a Robot,
    rest: AtRest,
    slopes: Option<Derivatives>,
    /// Tensions at the exit points under the load [N], where they are needed.
    exits: Vec<Quantity>,
    /// The position error, where it is needed.
    position: Option<Quantity>,
}

impl AtPose<'_> {
    /// Adds what an objective is at this pose; nothing where it is of all poses together.
    fn objective(&self, of: Goal, over: Over, into: &mut Vec<Quantity>) -> Result<(), StaticsError> {
        match of {
            Goal::Length | Goal::Cost => {}
            // The greatest of several numbers has no derivative where two are equal: each is one of those of
            // which the worst counts.
            Goal::Tension if over == Over::Worst => into.extend(self.exits.iter().cloned()),
            _ => into.push(self.output(of)?),
        }
        Ok(())
    }

    /// An output in its unit.
    fn output(&self, of: Goal) -> Result<Quantity, StaticsError> {
        let Self { problem: DesignProblem { load, characteristic_length, .. }, robot, rest, .. } = self;
        let problem = || DirectProblem::new(robot, rest.lengths(), load);
        let missing = || StaticsError::NoDerivative { quantity: of.noun(), reason: "it is not observed" };
        Ok(match (of, &self.slopes) {
            (Goal::Tension, _) => {
                let greatest = self.exits.iter().max_by(|a, b| a.value.total_cmp(&b.value));
                greatest.cloned().ok_or_else(missing)?
            }
            // Length and cost are of all poses, and an amplitude is no output of designs.
            (Goal::Position | Goal::Length | Goal::Cost | Goal::Amplitude, _) => {
                self.position.clone().ok_or_else(missing)?
            }
            (Goal::Deflection, None) => self.quantity(1e3 * rest.magnitude(), &[]),
            (Goal::Deflection, Some(found)) => {
                self.quantity(rest.magnitude(), &found.magnitude()?).scaled(1e3, 0.0)
            }
            (Goal::Stiffness, None) => {
                let least = match rest {
                    AtRest::Lanes(_, found) => found.least_stiffness,
                    AtRest::Alone(found) => problem()?
                        .with_characteristic_length(*characteristic_length)
                        .stability(&found.loaded.equilibrium)?
                        .least_stiffness(),
                };
                self.quantity(least, &[])
            }
            (Goal::Stiffness, Some(found)) => {
                let (value, slopes) = found.least_stiffness_with(robot, load, *characteristic_length)?;
                self.quantity(value, &slopes)
            }
            (Goal::Frequency, None) => {
                let modes = Modes::slowest(&problem()?, rest.equilibrium().ok_or_else(missing)?)?;
                self.quantity(modes.lowest().map_or(0.0, |mode| mode.frequency), &[])
            }
            (Goal::Frequency, Some(found)) => {
                let lowest = FrequencyDerivatives::lowest_of_deflection(robot, load, found)?;
                self.quantity(lowest.frequency, &lowest.with_lengths(&found.lengths))
            }
            (Goal::PlatformFrequency, None) => {
                let at = rest.equilibrium().ok_or_else(missing)?;
                self.quantity(Swing::new(&problem()?, at)?.platform, &[])
            }
            (Goal::PlatformFrequency, Some(found)) => {
                let of = FrequencyDerivatives::of_deflection(robot, load, found)?;
                self.quantity(of.frequency, &of.with_lengths(&found.lengths))
            }
        })
    }

    /// Keeps the greatest length of each cable.
    fn lengthen(&self, longest: &mut Vec<Quantity>) {
        for (i, length) in self.rest.lengths().iter().enumerate() {
            let row =
                self.slopes.as_ref().map_or_else(Vec::new, |of| of.lengths.row(i).iter().copied().collect());
            let length = self.quantity(*length, &row);
            match longest.get_mut(i) {
                Some(most) if most.value >= length.value => {}
                Some(most) => *most = length,
                None => longest.push(length),
            }
        }
    }

    /// Adds by how much the greatest tension of each cable is passed under the load.
    fn tensions(&self, excesses: &mut Vec<Quantity>) {
        let Self { robot, rest, slopes, .. } = self;
        for (i, anchor) in rest.tensions().into_iter().enumerate() {
            let tension = match (&slopes, robot.max_at(i).is_anchor()) {
                (_, false) => self.exits[i].clone(),
                (None, true) => self.quantity(anchor, &[]),
                (Some(found), true) => {
                    let row: Vec<f64> = found.loaded.tensions.row(i).iter().copied().collect();
                    self.quantity(anchor, &row)
                }
            };
            excesses.push(tension.scaled(1.0 / allowed(robot, i).max, -1.0));
        }
    }

    /// The tensions at the exit points under the load [N].
    fn exit_tensions(&self) -> Result<Vec<Quantity>, StaticsError> {
        let Self { robot, rest, slopes, problem, .. } = self;
        let tensions = rest.exit_tensions(robot);
        let Some(found) = slopes else {
            return Ok(tensions.into_iter().map(|tension| self.quantity(tension, &[])).collect());
        };
        let at_rest = DirectProblem::new(robot, rest.lengths(), &problem.load)?;
        let exits = at_rest.force_derivatives(&found.deflection.loaded.equilibrium, CableEnd::Exit)?;
        let (count, n) = (found.inputs.count(), robot.cables.len());
        let of = |(i, tension): (usize, f64)| {
            // The lengths follow the parameters.
            let along = exits.forces[i].normalize().transpose() * exits.per_input.rows(3 * i, 3);
            let whole = along.columns(0, count) + along.columns(count, n) * &found.lengths;
            self.quantity(tension, &whole.iter().copied().collect::<Vec<_>>())
        };
        Ok(tensions.into_iter().enumerate().map(of).collect())
    }

    /// A number with its derivatives by the variables, from those by the inputs.
    fn quantity(&self, value: f64, per_input: &[f64]) -> Quantity {
        let Some(Derivatives { inputs, .. }) = &self.slopes else {
            return Quantity { value, slopes: Vec::new() };
        };
        let of_part = |(parameter, sign): &(Parameter, f64)| {
            inputs.column(*parameter).map_or(0.0, |column| sign * per_input[column])
        };
        let of = |variable: &Variable| variable.parameters.iter().map(of_part).sum();
        Quantity { value, slopes: self.problem.variables.iter().map(of).collect() }
    }
}

impl Quantity {
    /// `factor` times the quantity, plus `shift`.
    fn scaled(mut self, factor: f64, shift: f64) -> Self {
        self.value = factor * self.value + shift;
        self.slopes.iter_mut().for_each(|slope| *slope *= factor);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::problem::STEP;
    use cdpr_robot::library::{ROBOTS, named};
    use std::path::Path;

    /// All derivatives of a design against differences over this share of each value.
    fn check(robot: &str, design: &str, share: f64) {
        let robot = Robot::from_json(robot).unwrap();
        let problem = DesignProblem::from_json(design, Path::new("design.json"), robot).unwrap();
        let values = problem.nominal();
        let all = |values: &[f64], with_slopes: bool| {
            let Evaluation { outputs, excesses, .. } =
                problem.evaluate(values, with_slopes.then_some(STEP)).unwrap();
            [outputs, excesses].concat()
        };
        let found = all(&values, true);
        for (j, value) in values.iter().enumerate() {
            let step = share * value.abs().max(1.0);
            let moved = |side: f64| {
                let mut values = values.clone();
                values[j] += side * step;
                all(&values, false)
            };
            for (k, ((one, low), high)) in found.iter().zip(moved(-1.0)).zip(moved(1.0)).enumerate() {
                let difference = (high.value - low.value) / (2.0 * step);
                let slope = one.slopes[j];
                // Values have at least eight digits.
                let error = 1e-3 * slope.abs() + 1e-8 * one.value.abs().max(1e-3) / step;
                assert!((slope - difference).abs() < error, "{k} by {j}: {slope} {difference}");
            }
        }
    }

    #[test]
    fn derivatives_of_outputs_and_tensions_are_their_differences() {
        let caroca = named(ROBOTS, "caroca").unwrap().text;
        let design = |output: &str| {
            format!(
                r#"{{"format": "cdpr-design/1", "payload": 50, "limits": {{"deflection": 3, "stiffness": 1e4}},
                "objective": {{"output": "{output}", "over": "worst"}},
                "poses": {{"list": [{{"position": [0.3, 0.2, 1.75]}}, {{"position": [-1, 0.4, 1.5]}}]}},
                "variables": [
                    {{"parameters": ["b1.x", "b3.x"], "bounds": [-4, -2]}},
                    {{"parameters": ["b1.z", "b2.z"], "signs": [1, -1], "bounds": [3, 4]}},
                    {{"parameters": ["a5.y"], "bounds": [0, 1]}}, {{"parameters": ["mass"], "bounds": [100, 200]}}
                ]}}"#
            )
        };
        check(caroca, &design("deflection"), 1e-4);
        check(
            &caroca.replace("\"max\": 10290.0", "\"max\": 10290.0, \"max_at\": \"exit\""),
            &design("stiffness"),
            1e-4,
        );
        let on_pulleys = named(ROBOTS, "ipanema-3").unwrap().text;
        let limited = design("tension").replace("\"stiffness\": 1e4", "\"tension\": 900, \"length\": 60");
        for (robot, design) in
            [(caroca, limited.clone()), (caroca, limited.replace("tension\", \"over", "length\", \"over"))]
        {
            check(robot, &design, 1e-4);
        }
        let here = r#"{"list": [{"position": [0.3, 0.2, 1.5]}]}"#;
        let on_pulleys_too = r#"{"format": "cdpr-design/1", "payload": 20, "limits": {"length": 90},
            "objective": {"output": "tension"}, "poses": HERE, "variables": [
                {"parameters": ["b1.z"], "bounds": [0, 9]}, {"parameters": ["a5.y"], "bounds": [-1, 1]}]}"#;
        check(on_pulleys, &on_pulleys_too.replace("HERE", here), 1e-4);
        let inertia = "\"center_of_mass\": [0, 0, 0], \"inertia\": [[9, 0, 0], [0, 8, 0], [0, 0, 7]]";
        check(&caroca.replace("\"center_of_mass\": [0, 0, 0]", inertia), &design("frequency"), 1e-4);
    }

    #[test]
    fn derivatives_of_position_errors_are_those_of_their_values() {
        let design = r#"{"format": "cdpr-design/1", "limits": {"position": 3},
            "objective": {"output": "position", "over": "mean"},
            "errors": {"b": {"law": {"uniform": {"min": -0.01, "max": 0.01}}},
                "mass": {"law": {"normal": {"mean": 0, "std": 5}}},
                "dt": {"law": {"normal": {"mean": 0, "std": 15}}}},
            "poses": {"list": [{"position": [0.3, 0.2, 1.75]}, {"position": [-1, 0.4, 1.5]}]},
            "variables": [{"parameters": ["b1.x", "b3.x"], "bounds": [-4, -2]},
                {"parameters": ["b1.z", "b2.z"], "signs": [1, -1], "bounds": [3.5, 4]},
                {"parameters": ["b5.z"], "bounds": [3, 3.5]}]}"#;
        check(named(ROBOTS, "caroca").unwrap().text, design, 1e-4);
    }

    #[test]
    fn derivatives_with_free_coordinates_are_their_differences() {
        let design = r#"{"format": "cdpr-design/1", "payload": 5, "free": ["roll", "pitch"],
            "objective": {"output": "deflection", "over": "mean"},
            "poses": {"list": [{"position": [0.5, 0.3, 2]}]},
            "variables": [{"parameters": ["b1.x"], "bounds": [-9, 9]}, {"parameters": ["b2.z"], "bounds": [1, 9]}]}"#;
        // Near the border of the poses that it holds: 1e-2 m farther there is no rest.
        check(named(ROBOTS, "four-cables").unwrap().text, design, 1e-5);
    }
}
