//! What is sought: deviations of the robot's parameters, and errors of the sensors.

use crate::error::CalibrationError;
use crate::sensor_error::{SensorError, size};
use cdpr_robot::{Parameter, Robot, Vector3};
use cdpr_study::{ErrorModel, Term};
use nalgebra::DMatrix;

/// One number that is sought: a deviation from where the search begins.
#[derive(Clone, Debug, PartialEq)]
pub struct Unknown {
    /// Its name.
    pub name: String,
    /// Unit: the standard deviation of its prior or, without one, a change so great that a number known no
    /// better is not known.
    pub scale: f64,
    /// Mean and standard deviation of its prior, if it has one.
    pub prior: Option<[f64; 2]>,
    /// Least and greatest value.
    pub bounds: [f64; 2],
}

/// All unknowns: inputs of an error model, then errors of sensors.
#[derive(Clone, Debug, PartialEq)]
pub struct Unknowns {
    /// The numbers.
    pub all: Vec<Unknown>,
    /// Which parameters follow the first of them, with factors.
    pub(crate) terms: Vec<Term>,
    /// Errors of sensors with the index of their first number.
    pub(crate) sensors: Vec<(SensorError, usize)>,
    /// Where markers stand on the platform, or are thought to stand [m].
    pub(crate) markers: Vec<Vector3<f64>>,
    /// Markers whose places are sought.
    pub(crate) marker_count: usize,
    /// Inputs that have a deviation in common with others, by the names that they had.
    pub(crate) shared: Vec<String>,
}

impl Unknowns {
    /// The inputs of an error model, each with its mean and standard deviation, steps included, as the prior.
    pub fn of_model(model: &ErrorModel) -> Self {
        let unknown = |input: &cdpr_sensitivity::Input| Unknown {
            name: input.name.clone(),
            scale: input.std(),
            prior: Some([input.mean(), input.std()]),
            bounds: [f64::NEG_INFINITY, f64::INFINITY],
        };
        Self { all: model.inputs.iter().map(unknown).collect(), terms: model.terms.clone(), ..Self::none() }
    }

    /// Nothing.
    pub(crate) fn none() -> Self {
        Self {
            all: Vec::new(),
            terms: Vec::new(),
            sensors: Vec::new(),
            markers: Vec::new(),
            marker_count: 0,
            shared: Vec::new(),
        }
    }

    /// The named parameters or groups of parameters, without prior; of a planar robot, coordinates in its
    /// plane.
    ///
    /// # Errors
    /// [`CalibrationError::Invalid`] for a name that the robot does not have, for a coordinate at right
    /// angles to its plane, and for offsets of tension set-points, which no measurement with given lengths
    /// depends on.
    pub fn free(robot: &Robot, names: &[&str]) -> Result<Self, CalibrationError> {
        let parameters = Parameter::of(robot);
        let is = |p: &Parameter, name: &str| p.group() == name || p.to_string() == name;
        if let Some(out) =
            parameters.iter().find(|p| leaves_plane(robot, **p) && names.contains(&&*p.to_string()))
        {
            let expected = "coordinates in the plane of the robot: nothing measured depends on others";
            return Err(CalibrationError::invalid("unknown", out, expected));
        }
        let is_known = |p: &Parameter| !is_anchor_of_point(robot, *p);
        let known =
            |name: &&&str| parameters.iter().any(|p| is(p, name) && is_known(p)) && !name.starts_with("dt");
        if let Some(name) = names.iter().find(|name| !known(name)) {
            let of_point = if robot.platform.point { ", no anchor point of a point mass" } else { "" };
            let expected = format!("parameters of the robot ({}){of_point}", Parameter::NAMES);
            return Err(CalibrationError::invalid("unknown", name, expected));
        }
        let mut unknowns = Self::none();
        for (index, parameter) in parameters.iter().enumerate() {
            let is_left_out = leaves_plane(robot, *parameter) || !is_known(parameter);
            if names.iter().any(|name| is(parameter, name)) && !is_left_out {
                unknowns.terms.push(Term { input: unknowns.all.len(), parameter: index, factor: 1.0 });
                unknowns.all.push(Unknown {
                    name: parameter.to_string(),
                    scale: natural_scale(robot, *parameter),
                    prior: None,
                    bounds: bounds(robot, *parameter),
                });
            }
        }
        Ok(unknowns)
    }

    /// The parameters that are sought if nothing is said: anchor and exit points, mass and modulus; of a
    /// point mass no anchor points.
    pub fn usual(robot: &Robot) -> Self {
        let names: &[&str] = if robot.platform.point { &["b"] } else { &["a", "b"] };
        // Every robot has these.
        Self::free(robot, &[names, &["mass", "youngs_modulus"]].concat()).unwrap_or_else(|_| Self::none())
    }

    /// The inputs of an error model or, without one, the named parameters or groups, `none` or the usual
    /// ones, where each of the groups `share` has one deviation.
    ///
    /// # Errors
    /// As [`Unknowns::free`] and [`Unknowns::share`].
    pub fn sought(
        robot: &Robot,
        prior: Option<&ErrorModel>,
        names: &[&str],
        share: &[&str],
    ) -> Result<Self, CalibrationError> {
        let mut unknowns = match (prior, names) {
            (Some(model), _) => Self::of_model(model).without_anchors_of_point(robot)?,
            (None, []) => Self::usual(robot),
            (None, ["none"]) => Self::free(robot, &[])?,
            (None, names) => Self::free(robot, names)?,
        };
        share.iter().try_for_each(|group| unknowns.share(robot, group))?;
        Ok(unknowns)
    }

    /// The same without anchor points of a point mass, which are at P: they keep the laws of the prior.
    fn without_anchors_of_point(mut self, robot: &Robot) -> Result<Self, CalibrationError> {
        let parameters = Parameter::of(robot);
        let is_anchor = |term: &&Term| is_anchor_of_point(robot, parameters[term.parameter]);
        let mut gone: Vec<usize> = self.terms.iter().filter(is_anchor).map(|term| term.input).collect();
        gone.sort_unstable();
        gone.dedup();
        let others = self.terms.iter().find(|term| gone.contains(&term.input) && !is_anchor(term));
        if let Some(mixed) = others {
            let expected = "a cause without anchor points: the cables of a point mass meet at P";
            return Err(CalibrationError::invalid("unknown", &self.all[mixed.input].name, expected));
        }
        self.remove(&gone);
        Ok(self)
    }

    /// Gives parameters one deviation in common: those of a group, `r`, or of a list of names and groups,
    /// `r1+r2`. They become one unknown of that name, with the prior of the first.
    ///
    /// # Errors
    /// [`CalibrationError::Invalid`] where a name of the list is not sought.
    pub fn share(&mut self, robot: &Robot, group: &str) -> Result<(), CalibrationError> {
        let mut inputs = Vec::new();
        for name in group.split('+') {
            let of_name = self.inputs(robot, name.trim());
            if of_name.is_empty() {
                let expected = "parameters that are sought, or groups of them: r, or r1+r2";
                return Err(CalibrationError::invalid("share", group, expected));
            }
            inputs.extend(of_name);
        }
        inputs.sort_unstable();
        inputs.dedup();
        let (first, gone) = (inputs[0], &inputs[1..]);
        self.shared.extend(inputs.iter().map(|input| self.all[*input].name.clone()));
        group.clone_into(&mut self.all[first].name);
        for term in &mut self.terms {
            if inputs.contains(&term.input) {
                term.input = first;
            }
        }
        self.remove(gone);
        Ok(())
    }

    /// Keeps unknowns within bounds: deviations of a parameter or group, or an error of the sensors or one
    /// number of it.
    ///
    /// # Errors
    /// [`CalibrationError::Invalid`] where nothing of this name is sought, and for bounds in the wrong order.
    pub fn bound(&mut self, robot: &Robot, name: &str, bounds: [f64; 2]) -> Result<(), CalibrationError> {
        if bounds[0].is_nan() || bounds[1].is_nan() || bounds[0] >= bounds[1] {
            let given = format!("{}:{}", bounds[0], bounds[1]);
            return Err(CalibrationError::invalid(format!("bounds of {name}"), given, "least:greatest"));
        }
        let mut inputs = self.inputs(robot, name);
        if let Ok(error) = SensorError::from_name(name)
            && let Some(first) = self.sensor(error)
        {
            inputs.extend(first..first + error.names(robot.cables.len(), self.marker_count).len());
        }
        inputs.extend(self.all.iter().position(|unknown| unknown.name == name));
        if inputs.is_empty() {
            return Err(CalibrationError::invalid("bounds", name, "the name of something that is sought"));
        }
        for input in inputs {
            let own = &mut self.all[input].bounds;
            let both = [own[0].max(bounds[0]), own[1].min(bounds[1])];
            if both[0] >= both[1] {
                let given = format!("{}:{}", bounds[0], bounds[1]);
                let expected =
                    format!("a range with a part between {} and {}, its other bounds", own[0], own[1]);
                return Err(CalibrationError::invalid(format!("bounds of {name}"), given, expected));
            }
            *own = both;
        }
        Ok(())
    }

    /// Whether each unknown only moves points of a planar robot at right angles to its plane.
    pub(crate) fn out_of_plane(&self, robot: &Robot) -> Vec<bool> {
        let parameters = Parameter::of(robot);
        let leaves = |term: &Term| leaves_plane(robot, parameters[term.parameter]);
        let of = |input: usize| {
            let mut terms = self.terms.iter().filter(|term| term.input == input).peekable();
            terms.peek().is_some() && terms.all(leaves)
        };
        (0..self.all.len()).map(of).collect()
    }

    /// The inputs that move a parameter or a group.
    fn inputs(&self, robot: &Robot, name: &str) -> Vec<usize> {
        let parameters = Parameter::of(robot);
        let is = |p: &Parameter| p.group() == name || p.to_string() == name;
        self.terms.iter().filter(|term| is(&parameters[term.parameter])).map(|term| term.input).collect()
    }

    /// Values within their bounds.
    pub(crate) fn within(&self, mut x: Vec<f64>) -> Vec<f64> {
        for (x, unknown) in x.iter_mut().zip(&self.all) {
            *x = x.clamp(unknown.bounds[0], unknown.bounds[1]);
        }
        x
    }

    /// Adds an error of the sensors, with a prior about zero of that standard deviation if there is one.
    /// Markers begin where `markers` says, in the platform frame [m].
    pub fn add(&mut self, robot: &Robot, error: SensorError, std: Option<f64>, markers: usize) {
        self.sensors.push((error, self.all.len()));
        self.marker_count = markers;
        for (k, name) in error.names(robot.cables.len(), markers).into_iter().enumerate() {
            self.all.push(Unknown {
                name,
                scale: std.unwrap_or_else(|| error.scale(robot, k)),
                prior: std.map(|std| [0.0, std]),
                bounds: [f64::NEG_INFINITY, f64::INFINITY],
            });
        }
    }

    /// Where markers stand on the platform, or are thought to stand [m].
    pub fn set_markers(&mut self, markers: Vec<Vector3<f64>>) {
        self.markers = markers;
    }

    /// Index of the first number of an error of the sensors.
    pub(crate) fn sensor(&self, error: SensorError) -> Option<usize> {
        self.sensors.iter().find(|(own, _)| *own == error).map(|(_, first)| *first)
    }

    /// Number of the unknowns that are deviations of parameters: the first ones.
    pub fn of_parameters(&self) -> usize {
        self.sensors.first().map_or(self.all.len(), |(_, first)| *first)
    }

    /// Leaves out inputs of parameters: they keep their values.
    pub(crate) fn remove(&mut self, inputs: &[usize]) {
        let kept: Vec<usize> = (0..self.all.len()).filter(|input| !inputs.contains(input)).collect();
        let place = |input: usize| kept.iter().position(|old| *old == input);
        self.terms.retain_mut(|term| match place(term.input) {
            Some(input) => {
                term.input = input;
                true
            }
            None => false,
        });
        for (_, first) in &mut self.sensors {
            *first -= inputs.iter().filter(|input| **input < *first).count();
        }
        self.all = kept.into_iter().map(|old| self.all[old].clone()).collect();
    }

    /// Deviation of each parameter of a robot with `count` of them.
    pub(crate) fn deviations(&self, count: usize, x: &[f64]) -> Vec<f64> {
        let mut deviations = vec![0.0; count];
        for term in &self.terms {
            deviations[term.parameter] += term.factor * x[term.input];
        }
        deviations
    }
}

/// Derivatives of `parameters` parameters by `inputs` inputs, each in its unit.
pub(crate) fn map_of(
    terms: &[Term],
    [parameters, inputs]: [usize; 2],
    unit: impl Fn(usize) -> f64,
) -> DMatrix<f64> {
    let mut map = DMatrix::zeros(parameters, inputs);
    for term in terms {
        map[(term.parameter, term.input)] += term.factor * unit(term.input);
    }
    map
}

/// Whether a parameter moves a point out of the plane of a planar robot.
fn leaves_plane(robot: &Robot, parameter: Parameter) -> bool {
    let normal = robot.plane.map(cdpr_robot::Plane::normal);
    let (Parameter::ExitPoint(_, axis) | Parameter::AnchorPoint(_, axis) | Parameter::CenterOfMass(axis)) =
        parameter
    else {
        return false;
    };
    normal == Some(axis.index())
}

/// Whether a parameter is a coordinate of an anchor point of a point mass, whose cables meet at P.
fn is_anchor_of_point(robot: &Robot, parameter: Parameter) -> bool {
    robot.platform.point && matches!(parameter, Parameter::AnchorPoint(..))
}

/// A change of a parameter so great that a value known no better is not known.
fn natural_scale(robot: &Robot, parameter: Parameter) -> f64 {
    match parameter {
        Parameter::Mass | Parameter::LinearDensity | Parameter::YoungsModulus => parameter.nominal(robot),
        Parameter::ExitPoint(..) => 0.1 * size(robot),
        Parameter::AnchorPoint(..) | Parameter::CenterOfMass(_) => robot.platform_size(),
        Parameter::PulleyRadius(_) => parameter.nominal(robot).max(1e-2),
        Parameter::Lead(_) => size(robot),
        Parameter::TensionOffset(i) => robot.limits(i).max,
        Parameter::Tilt(..) => 1.0,
        Parameter::Gravity(_) => robot.gravity.magnitude(),
    }
}

/// Deviations that keep a robot valid.
fn bounds(robot: &Robot, parameter: Parameter) -> [f64; 2] {
    let nominal = parameter.nominal(robot);
    match parameter {
        Parameter::Mass | Parameter::YoungsModulus => [-0.95 * nominal, f64::INFINITY],
        Parameter::LinearDensity | Parameter::PulleyRadius(_) | Parameter::Lead(_) => {
            [-nominal, f64::INFINITY]
        }
        _ => [f64::NEG_INFINITY, f64::INFINITY],
    }
}
