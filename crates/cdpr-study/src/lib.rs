//! Studies: which parameters of a robot are uncertain and by how much, where and under which load its deflection is
//! observed, and what comes out.
//!
//! A study file (`cdpr-study/1`, JSON) names a robot file, error models, and any number of *samplings* (all parameters
//! perturbed at once, as in section 5 of Baklouti, Caro, Courteille 2017) and *surfaces* (two parameters over a grid). Each
//! runs in parallel with the same numbers on any number of threads. An observation that fails is data: counted by reason, named
//! in the table, never an end.
//!
//! Where the study asks for them, [`measure`] puts all measures of sensitivity of a sampling beside each other.
//!
//! [`tolerance_budget`] says which tolerances to tighten for a limit on deflection or position.
//!
//! [`run_robustness`] asks another question: how often the direct model finds the true pose from a wrong start.
//!
//! ```no_run
//! use cdpr_study::{Study, analyse, observe};
//!
//! let study = Study::open("data/studies/caroca.json".as_ref())?;
//! let sampling = study.sampling("mechanical")?;
//! let tally = observe(&sampling, &|_| ());
//! let summary = analyse(&sampling, &tally, &|_| ());
//! if let Some(rms) = summary.rms_mm {
//!     println!("{:.3} mm +- {:.3} mm", rms.mean, rms.std);
//! }
//! # Ok::<(), cdpr_study::StudyError>(())
//! ```

mod comparison;
mod error;
mod error_model;
mod file;
mod observation;
mod output;
mod record;
mod robustness;
mod sampling;
mod sensitivity;
mod study;
mod surface;
mod tolerance;

pub use cdpr_sensitivity::{Estimate, Family, Truncation};
pub use cdpr_statics::Observation;
pub use comparison::{ComparisonRow, Value, Verdict, compare};
pub use error::StudyError;
pub use error_model::{ErrorModel, Term};
pub use file::{
    AxisSpec, ComparisonSpec, InputSpec, PoseSpec, STUDY_FORMAT, SamplingSpec, SensitivitySpec, Statistic,
    StudyFile, SurfaceSpec, json_schema,
};
pub use indexmap::IndexMap;
pub use observation::{Block, FITTED, KEPT, Tally, observe, observe_into};
pub use output::{
    ObservationTable, StudySummary, Summary, check_folder, remove_summary, write_figure, write_refused,
    write_robustness, write_sensitivity, write_solves, write_summary, write_surface,
};
pub use record::open_record;
pub use robustness::{
    Answer, Assignment, Draws, FOUND_ANGLE, FOUND_DISTANCE, Outcome, PoseRegion, Protocol, ProtocolSummary,
    Published, Refusal, RefusedPose, RobustnessResult, RobustnessRow, RobustnessSummary, Solve, Spread,
    StartOffset, anchor_distance, run_robustness,
};
pub use sampling::{FitSummary, NominalSummary, RmsSummary, SamplingSummary, SignedEffect, analyse};
pub use sensitivity::{
    Agreement, InputMeasures, Measure, MethodSummary, RANKED, SHARES, SensitivitySummary, measure,
};
pub use study::{Sampling, Study, Surface, open_robot};
pub use surface::{SurfaceResult, SurfaceRms, SurfaceSummary, compute_surface};
pub use tolerance::{Limit, Limited, Reached, Tolerance, ToleranceBudget, tolerance_budget};
