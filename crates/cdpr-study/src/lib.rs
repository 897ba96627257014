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
//! A run may keep what it observes in a folder of results, [`begin`], block by block: a [`Session`] with these goes on where another ended,
//! and gives the same results to the last bit. A [`Plan`] numbers the blocks of a study, of which [`observe_shard`] makes a share and a [`BlockMaker`]
//! any; [`status`] says how many are there.
//!
//! A sampling may be at many poses, [`observe_poses`]: its results are a row a pose. Poses that the nominal robot does not hold are data, too.
//!
//! [`compute_workspace`] tells where the robot can work and how it gives there, [`inspect`] what is odd about it.
//!
//! [`tolerance_budget`] says which tolerances to tighten for a limit on deflection or position.
//!
//! [`run_robustness`] asks another question: how often the direct model finds the true pose from a wrong start.
//!
//! ```no_run
//! use cdpr_study::{Session, Study, analyse, observe};
//!
//! let study = Study::open("data/studies/caroca.json".as_ref())?;
//! let sampling = study.sampling("mechanical")?;
//! let session = Session::in_memory();
//! let tally = observe(&sampling, &session)?;
//! let summary = analyse(&sampling, &tally, &session)?;
//! if let Some(rms) = summary.rms_mm {
//!     println!("{:.3} mm +- {:.3} mm", rms.mean, rms.std);
//! }
//! # Ok::<(), cdpr_study::StudyError>(())
//! ```

mod atomic;
mod block;
mod cable_law;
mod comparison;
mod designs;
mod error;
mod error_model;
mod file;
mod folder;
mod grid;
mod inspection;
mod names;
mod observation;
mod operating_point;
mod output;
#[cfg(feature = "parquet")]
mod parquet;
mod plan;
mod pose_set;
mod poses;
mod record;
mod results;
mod robustness;
mod sampling;
mod sensitivity;
mod shard;
mod status;
mod store;
mod study;
mod surface;
mod table;
mod template;
mod tolerance;
mod workspace;

pub use block::BLOCK;
pub use cable_law::{CableLaw, LAW_FORMAT, LawFile, UnloadingCurve, law_json, law_schema, open_law};
pub use cdpr_sensitivity::{Estimate, Family, Truncation};
pub use comparison::{ComparisonRow, Value, Verdict};
pub use error::StudyError;
pub use error_model::{ErrorModel, Term, uncertainties};
pub use file::{
    AxisSpec, ComparisonSpec, GridSpec, InputSpec, PoseSpec, PosesSpec, STUDY_FORMAT, SamplingSpec,
    SensitivitySpec, Statistic, StudyFile, SurfaceSpec, json_schema,
};
pub use folder::{
    Existing, REPORT_NAME, ROBOT_NAME, STUDY_NAME, Timings, begin, open_results, write_timings,
};
pub use grid::{Grid, GridAxis, frame, letter};
pub use indexmap::IndexMap;
pub use inspection::{Finding, Severity, inspect};
pub use observation::{FITTED, Failure, KEPT, Observed, Part, Session, Tally, observe, observe_into};
pub use output::{
    StudySummary, Summary, check_folder, write_figure, write_poses, write_refused, write_robustness,
    write_sensitivity, write_solves, write_summary, write_surface, write_text, write_workspace,
};
pub use plan::{BlockMaker, Plan, observe_shard};
pub use poses::{HELD, PoseRow, PosesSummary, observe_poses};
pub use record::{open_record, read_record};
pub use results::Results;
pub use robustness::{
    Answer, Assignment, Draws, FOUND_ANGLE, FOUND_DISTANCE, Outcome, PoseRegion, Protocol, ProtocolSummary,
    Published, Refusal, RefusedPose, RobustnessResult, RobustnessRow, RobustnessSummary, Solve, Spread,
    StartOffset, anchor_distance, run_robustness,
};
pub use sampling::{FitSummary, NominalSummary, RmsSummary, SamplingSummary, SignedEffect, analyse};
pub use sensitivity::{
    Agreement, InputMeasures, Measure, MethodSummary, RANKED, SHARES, SensitivitySummary, measure,
};
pub use shard::Shard;
pub use status::{DesignStatus, Provisional, SamplingStatus, Status, check_complete, check_observed, status};
pub use store::Blocks;
pub use study::{Sampling, Study, Surface, open_robot};
pub use surface::{SurfaceResult, SurfaceRms, SurfaceSummary, compute_surface};
pub use table::{ObservationTable, Rows, TableFormat};
pub use template::{TEMPLATE_NOTES, template, write_template};
pub use tolerance::{Limit, Limited, Reached, Tolerance, ToleranceBudget, tolerance_budget};
pub use workspace::{
    Dominant, Extremes, Held, Workspace, WorkspacePose, WorkspaceRow, WorkspaceSummary, compute_workspace,
};
