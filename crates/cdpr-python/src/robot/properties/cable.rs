//! `Robot.cables`: what each cable is.

use crate::convert::answer;
use cdpr_robot::{CableEnd, Robot, TensionLimits};
use numpy::PyArray1;
use pyo3::prelude::*;

answer! {
    /// A cable of a robot.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct Cable {
        /// Number of the cable, from 1.
        number: usize,
        /// Point A_i in the platform frame [m], (3,).
        anchor_point: Py<PyAny>,
        /// Point B_i in the base frame [m], (3,).
        exit_point: Py<PyAny>,
        /// Section that carries the tension [m²].
        section: f64,
        /// Mass per unstrained length [kg/m].
        linear_density: f64,
        /// Young's modulus [Pa].
        youngs_modulus: f64,
        /// Least and greatest tension [N], (2,).
        tension_limits: Py<PyAny>,
        /// The end at which the greatest tension is limited: "anchor" or "exit".
        max_at: String,
    }
}

impl Cable {
    pub(crate) fn of(py: Python, robot: &Robot, i: usize) -> Self {
        let (cable, TensionLimits { min, max }) = (&robot.cables[i], robot.limits(i));
        let array = |values: &[f64]| PyArray1::from_slice(py, values).into_any().unbind();
        Self {
            number: i + 1,
            anchor_point: array(cable.anchor_point.as_slice()),
            exit_point: array(cable.exit_point.as_slice()),
            section: cable.properties.section,
            linear_density: cable.properties.linear_density,
            youngs_modulus: cable.properties.youngs_modulus,
            tension_limits: array(&[min, max]),
            max_at: name_of(robot.max_at(i)).to_owned(),
        }
    }
}

/// The name of an end of a cable.
pub(crate) fn name_of(end: CableEnd) -> &'static str {
    match end {
        CableEnd::Anchor => "anchor",
        CableEnd::Exit => "exit",
    }
}
