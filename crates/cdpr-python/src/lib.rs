//! The native half of the Python package `cdpr`: the models on NumPy arrays, studies, designs of experiments. Each module has one class or
//! one function of the package, with the documentation that Python shows; the other half is in `python/cdpr`.
//!
//! Arguments and answers are of one case or have a first axis of cases (`arrays`, `answer`), which are computed in parallel without
//! Python's lock (`threads`). What a model refuses is an exception (`error`).

mod answer;
mod arrays;
mod catenary;
mod deflection;
mod derivatives;
mod designs;
mod direct;
mod error;
mod estimates;
mod inverse;
mod observe;
mod robot;
mod stiffness;
mod study;
mod threads;
mod workspace;

use pyo3::prelude::*;

/// Native half of the package cdpr.
#[pymodule]
mod _core {
    #[pymodule_export]
    use crate::catenary::{Catenary, catenary};
    #[pymodule_export]
    use crate::deflection::Deflection;
    #[pymodule_export]
    use crate::derivatives::Derivatives;
    #[pymodule_export]
    use crate::designs::{MorrisDesign, SaltelliDesign, SobolDesign};
    #[pymodule_export]
    use crate::direct::DirectSolution;
    #[pymodule_export]
    use crate::estimates::{Effects, Expansion, MorrisEffects, SobolIndices};
    #[pymodule_export]
    use crate::inverse::InverseSolution;
    #[pymodule_export]
    use crate::observe::Observations;
    #[pymodule_export]
    use crate::robot::Robot;
    #[pymodule_export]
    use crate::stiffness::Stiffness;
    #[pymodule_export]
    use crate::study::{begin, carry_out, make_shard, observations, open_results, status};
    #[pymodule_export]
    use crate::workspace::Workspace;
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
