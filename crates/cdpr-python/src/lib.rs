//! The native half of the Python package `cdpr`: the models on NumPy arrays, studies, designs of experiments.
//!
//! Each module has one class or function of the package, with the documentation that Python shows; the other
//! half is in `python/cdpr`.
//!
//! Arguments and answers are of one case, or have a first axis of cases (`convert::arrays`,
//! `convert::answer`). Cases are computed in parallel without Python's lock (`convert::threads`). What a
//! model refuses becomes an exception (`convert::error`).

mod assess;
mod calibration;
mod catenary;
mod convert;
mod design;
mod exchange;
mod explorer;
mod observer;
mod program;
mod robot;
mod sensitivity;
mod source;
mod study;

use pyo3::prelude::*;

/// Native half of the package cdpr.
#[pymodule]
mod _core {
    #[pymodule_export]
    use crate::assess::{
        check, check_file, hysteresis, linear_density, modulus, pulley_friction, robustness, tolerances,
    };
    #[pymodule_export]
    use crate::calibration::{calibrate, calibrate_pulleys, identify, plan, simulate};
    #[pymodule_export]
    use crate::catenary::{Catenary, catenary};
    #[pymodule_export]
    use crate::design::design;
    #[pymodule_export]
    use crate::exchange::{export_robot, import_robot, library};
    #[pymodule_export]
    use crate::explorer::explorer_parts;
    #[pymodule_export]
    use crate::observer::{LoadEstimates, Observer};
    #[pymodule_export]
    use crate::program::run_program;
    #[pymodule_export]
    use crate::robot::Robot;
    #[pymodule_export]
    use crate::robot::bearing::capacity::Capacity;
    #[pymodule_export]
    use crate::robot::bearing::safety::Safety;
    #[pymodule_export]
    use crate::robot::bearing::weather::RestInWeather;
    #[pymodule_export]
    use crate::robot::boundary::Boundary;
    #[pymodule_export]
    use crate::robot::certify::Certificate;
    #[pymodule_export]
    use crate::robot::deflection::Deflection;
    #[pymodule_export]
    use crate::robot::derivatives::Derivatives;
    #[pymodule_export]
    use crate::robot::direct::DirectSolution;
    #[pymodule_export]
    use crate::robot::inverse::{InverseSolution, OtherSolution};
    #[pymodule_export]
    use crate::robot::motion::modes::{MasslessModes, Modes};
    #[pymodule_export]
    use crate::robot::motion::moves::{Move, MoveSummary};
    #[pymodule_export]
    use crate::robot::motion::response::Response;
    #[pymodule_export]
    use crate::robot::motion::simulate::{Motion, MotionState, MotionSummary};
    #[pymodule_export]
    use crate::robot::observe::Observations;
    #[pymodule_export]
    use crate::robot::path::{PathDeviations, PathStates};
    #[pymodule_export]
    use crate::robot::pose::pose;
    #[pymodule_export]
    use crate::robot::properties::cable::Cable;
    #[pymodule_export]
    use crate::robot::stiffness::Stiffness;
    #[pymodule_export]
    use crate::robot::workspace::Workspace;
    #[pymodule_export]
    use crate::sensitivity::analysis::{analyse, wasserstein_bures};
    #[pymodule_export]
    use crate::sensitivity::designs::{Morris, Saltelli, Sample, Shapley, effect_intervals};
    #[pymodule_export]
    use crate::sensitivity::expansion::Expansion;
    #[pymodule_export]
    use crate::sensitivity::laws::{allocate, fit_laws, law_moments, law_values};
    #[pymodule_export]
    use crate::study::{
        begin, carry_out, make_shard, observations, open_results, status, template, write_report,
    };
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
