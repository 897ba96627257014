//! Robots from and to files, texts and dictionaries, and robots with other values.

use crate::convert::{Answer, Numbers, Raised, guarded, json_text};
use crate::robot::{Robot, arguments};
use cdpr_robot::TensionDistribution;
use cdpr_study::open_robot;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;

#[pymethods]
impl Robot {
    /// Reads a robot file (`cdpr-robot/1`), or a robot of the library by its name, `cogiro`.
    ///
    /// Parameters
    /// ----------
    /// path : path
    ///     Path of the file.
    ///
    /// Returns
    /// -------
    /// Robot
    ///     The robot.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     For a file or folder that cannot be read, written or used.
    /// InputError
    ///     The message has line, column, field and what would be right.
    ///
    /// Examples
    /// --------
    /// >>> cdpr.Robot.from_file("cogiro").n_cables
    /// 8
    #[staticmethod]
    fn from_file(path: PathBuf) -> Answer<Self> {
        Self::questioned(guarded(|| open_robot(&path))??)
    }

    /// Makes a robot from the text of a robot file.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     Text of a robot file.
    ///
    /// Returns
    /// -------
    /// Robot
    ///     The robot.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> cdpr.Robot.from_json(robot.to_json()) == robot
    /// True
    #[staticmethod]
    fn from_json(text: &str) -> Answer<Self> {
        Self::questioned(guarded(|| cdpr_robot::Robot::from_json(text))??)
    }

    /// Makes a robot from the dictionary that `json.loads` makes of a robot file.
    ///
    /// It may hold numbers and arrays of NumPy.
    ///
    /// Parameters
    /// ----------
    /// content : dict
    ///     The dictionary.
    ///
    /// Returns
    /// -------
    /// Robot
    ///     The robot.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> content = robot.to_dict()
    /// >>> content["platform"]["mass"] = 100  # [kg]
    /// >>> cdpr.Robot.from_dict(content).mass
    /// 100.0
    #[staticmethod]
    fn from_dict(content: &Bound<PyDict>) -> Answer<Self> {
        Self::from_json(&json_text("content", content)?)
    }

    /// The robot file as text.
    ///
    /// Returns
    /// -------
    /// str
    ///     The text.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> robot.to_json()[0]
    /// '{'
    pub(super) fn to_json(&self) -> String {
        self.robot.to_json()
    }

    /// The robot file as a dictionary.
    ///
    /// Returns
    /// -------
    /// dict
    ///     The dictionary.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> robot.to_dict()["format"]
    /// 'cdpr-robot/1'
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("json")?.call_method1("loads", (self.to_json(),))
    }

    /// Makes a robot whose inverse model prefers other tensions.
    ///
    /// Parameters
    /// ----------
    /// reference : array_like or str, optional
    ///     A number for all cables [N], one for each, "mid" for the middle of the limits, or None for the
    ///     least norm.
    ///
    /// Returns
    /// -------
    /// Robot
    ///     The robot.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     For a negative tension or another number of them than of cables.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> robot.with_tension_reference(500).tension_reference[0]  # [N]
    /// np.float64(500.0)
    #[pyo3(signature = (reference))]
    fn with_tension_reference(&self, reference: Option<Numbers>) -> Answer<Self> {
        let tension_reference = reference.as_ref().map(arguments::reference).transpose()?;
        let distribution = TensionDistribution::Nearest;
        let robot = cdpr_robot::Robot { tension_reference, distribution, ..self.robot.clone() };
        robot.validate()?;
        Ok(Self { robot })
    }

    /// Makes a robot whose inverse model chooses tensions in another way. A norm drops the tension reference.
    ///
    /// Parameters
    /// ----------
    /// distribution : str
    ///     "nearest", "least_1_norm", "least_2_norm" or "least_infinity_norm".
    ///
    /// Returns
    /// -------
    /// Robot
    ///     The robot.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     For another name.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> robot.with_distribution("least_2_norm").distribution
    /// 'least_2_norm'
    #[pyo3(signature = (distribution))]
    fn with_distribution(&self, distribution: &str) -> Answer<Self> {
        let mut robot = self.robot.clone();
        robot.choose(Some(distribution.parse()?), None);
        Ok(Self { robot })
    }

    /// Makes a robot with other values of some parameters [SI units]: `{"mass": 185.0, "a1.x": 0.25}`.
    ///
    /// Names are those in `parameters`. `linear_density` and `youngs_modulus` are those of the first cable,
    /// as there; the other cables change by as much. Offsets dt belong to a set-point and not to a robot:
    /// they can only be zero here; `deflection` takes them as `tension_offsets`.
    ///
    /// Parameters
    /// ----------
    /// values : dict of float
    ///     New values by name [SI units].
    ///
    /// Returns
    /// -------
    /// Robot
    ///     The robot.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     For a name or value that no such robot has.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> robot.with_parameters({"mass": 100, "a1.x": 0.5}).mass  # [kg], [m]
    /// 100.0
    fn with_parameters(&self, values: &Bound<PyDict>) -> Answer<Self> {
        let values: Vec<(String, f64)> = values
            .iter()
            .map(|(name, value)| Ok((name.extract()?, value.extract()?)))
            .collect::<PyResult<_>>()?;
        let offsets: Vec<String> = (1..=self.robot.cables.len()).map(|cable| format!("dt{cable}")).collect();
        let (offsets, named): (Vec<_>, Vec<_>) = values
            .iter()
            .map(|(name, value)| (name.as_str(), *value))
            .partition(|(name, _)| offsets.iter().any(|offset| offset == name));
        if let Some((name, value)) = offsets.iter().find(|(_, value)| *value != 0.0) {
            return Err(Raised::Input(format!(
                "{name} is {value}: expected 0, as offsets belong to set-points; give them as tension_offsets"
            )));
        }
        Ok(Self { robot: self.robot.with_values(&named)? })
    }
}
