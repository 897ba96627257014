//! Doubts about the numbers of a study: its deviations, its payload, its poses.

use crate::file::grid::GridSpec;
use crate::file::study_file::{AxisSpec, PoseSpec, PosesSpec};
use crate::model::error_model::{ErrorModel, Term};
use crate::model::study::Study;
use cdpr_robot::{Doubt, Doubts, Parameter, Pose, Robot, Vector3, plausible};
use indexmap::IndexMap;
use std::str::FromStr;

impl ErrorModel {
    /// The first term of each parameter, with mean and standard deviation of the sum of all of its terms: the
    /// inputs are independent.
    fn moments(&self) -> IndexMap<usize, (&Term, [f64; 2])> {
        let mut found = IndexMap::new();
        for term in &self.terms {
            let input = &self.inputs[term.input];
            let (_, [mean, std]) = found.entry(term.parameter).or_insert((term, [0.0, 0.0]));
            *mean += term.factor * input.mean();
            *std = f64::hypot(*std, term.factor * input.std());
        }
        found
    }

    /// Doubts about the means and standard deviations of the deviations of `robot`, one for each group of
    /// parameters of one law.
    pub fn doubts(&self, robot: &Robot) -> Doubts {
        let parameters = Parameter::of(robot);
        let mut seen: Vec<(&str, [f64; 2])> = Vec::new();
        let mut doubts = Doubts::new();
        for (index, (term, moments)) in self.moments() {
            let Some(parameter) = parameters.get(index) else { continue };
            if seen.contains(&(parameter.group(), moments)) {
                continue;
            }
            let of_group = |other: &&Term| {
                parameters.get(other.parameter).map(Parameter::group) == Some(parameter.group())
            };
            let entry = &self.entries[term.input];
            let alone = self
                .terms
                .iter()
                .filter(of_group)
                .filter(|other| self.entries[other.input] != *entry)
                .count()
                == 0;
            let name = if alone { entry.as_str() } else { parameter.group() };
            if let Some(doubt) = plausible::deviation(robot, *parameter, name, moments) {
                seen.push((parameter.group(), moments));
                doubts.push(doubt);
            }
        }
        doubts
    }
}

impl Study {
    /// Doubts about what the study adds to its robot; those about the robot are
    /// [`plausible::robot`].
    pub fn doubts(&self) -> Doubts {
        let (file, robot) = (&self.file, &self.robot);
        let mut doubts = plausible::load(robot, file.payload, &file.load().wrench);
        let weather = self.weather().ok();
        let models = file
            .error_models
            .iter()
            .filter_map(|(name, model)| Some((name, ErrorModel::new(model, robot, weather.as_ref()).ok()?)));
        doubts.extend(models.flat_map(|(name, model)| {
            let named =
                move |doubt: Doubt| Doubt { quantity: format!("{} in {name}", doubt.quantity), ..doubt };
            model.doubts(robot).into_iter().map(named)
        }));
        for (name, spec) in &file.samplings {
            let positions = match &spec.poses {
                Some(PosesSpec::List(poses)) => poses.iter().map(|pose| pose.position).collect(),
                Some(PosesSpec::Grid(grid)) => ends(grid),
                None => spec.pose.iter().map(|pose| pose.position).collect(),
            };
            doubts.extend(first_far(robot, &format!("a position of {name}"), &positions));
            let listed = match &spec.poses {
                Some(PosesSpec::List(poses)) => &poses[..],
                _ => spec.pose.as_slice(),
            };
            doubts.extend(first_turned(&format!("rpy_deg of {name}"), listed));
        }
        for (name, spec) in &file.surfaces {
            doubts.extend(first_far(robot, &format!("the position of {name}"), &[spec.pose.position]));
            doubts.extend(first_turned(&format!("rpy_deg of {name}"), std::slice::from_ref(&spec.pose)));
            doubts.extend([&spec.x, &spec.y].into_iter().filter_map(|axis| self.axis_doubt(name, axis)));
        }
        doubts
    }

    fn axis_doubt(&self, surface: &str, axis: &AxisSpec) -> Option<Doubt> {
        let parameter = Parameter::from_str(&axis.parameter).ok()?;
        let farthest = if axis.min.abs() > axis.max.abs() { axis.min } else { axis.max };
        let doubt = plausible::farthest(&self.robot, parameter, &axis.parameter, farthest)?;
        Some(Doubt { quantity: format!("{} in {surface}", axis.parameter), ..doubt })
    }
}

/// Two corners of a grid.
fn ends(grid: &GridSpec) -> Vec<[f64; 3]> {
    let axes = [&grid.x, &grid.y, &grid.z];
    vec![axes.map(|axis| axis.min), axes.map(|axis| axis.max)]
}

/// The first of some poses whose angles are more than a turn.
fn first_turned(name: &str, poses: &[PoseSpec]) -> Option<Doubt> {
    poses.iter().find_map(|pose| plausible::angles(name, pose.rpy_deg?))
}

fn first_far(robot: &Robot, name: &str, positions: &[[f64; 3]]) -> Option<Doubt> {
    let doubt = |&[x, y, z]: &[f64; 3]| {
        let (far, pose) = (plausible::position(robot, name, &Vector3::new(x, y, z)), Pose::at(x, y, z));
        far.or_else(|| plausible::in_ground(robot, name, &pose))
            .or_else(|| plausible::out_of_plane(robot, name, &pose))
    };
    positions.iter().find_map(doubt)
}
