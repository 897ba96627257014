//! Studies: which parameters of a robot are uncertain and by how much, where and under which load its
//! deflection is
//! observed, and what comes out.
//!
//! A study file (`cdpr-study/1`, JSON) names a robot file, error models, and any number of *samplings* (all
//! parameters
//! perturbed at once, as in section 5 of Baklouti, Caro, Courteille 2017) and *surfaces* (two parameters over
//! a grid). Each
//! runs in parallel with the same numbers on any number of threads. An observation that fails is data:
//! counted by reason, named
//! in the table, never an end.
//!
//! Where the study asks for them, [`measure`] puts all measures of sensitivity of a sampling beside each
//! other.
//!
//! A run may keep what it observes in a folder of results, [`begin`], block by block: a [`Session`] with
//! these goes on where another ended,
//! and gives the same results to the last bit. A [`Plan`] numbers the blocks of a study, of which
//! [`observe_shard`] makes a share and a [`BlockMaker`]
//! any; [`status`] says how many are there.
//!
//! A sampling may be at many poses, [`observe_poses`]: its results are a row a pose. Poses that the nominal
//! robot does not hold are data, too.
//!
//! ```no_run
//! use cdpr_study::{Session, Study, analyse, observe};
//!
//! let study = Study::open("data/studies/caroca.json".as_ref())?;
//! let sampling = study.sampling("mechanical")?;
//! let session = Session::in_memory();
//! let tally = observe(&sampling, &session)?;
//! let summary = analyse(&sampling, &tally, &session)?;
//! if let Some(magnitude) = summary.values {
//!     println!("{:.3} mm +- {:.3} mm", magnitude.mean, magnitude.std);
//! }
//! # Ok::<(), cdpr_study::StudyError>(())
//! ```

mod analysis;
mod error;
mod file;
mod fs;
mod given;
mod kind;
mod model;
mod names;
mod observe;
mod results;
mod run;
mod store;
mod table;

pub use analysis::extremes::Extremes;
pub use analysis::linear_law::{LinearLaw, explained, explained_deflection, little_explained};
pub use analysis::measures::{GroupMeasures, InputMeasures, MEASURES, Measure, Quantity, SubspaceSummary};
pub use analysis::methods::run::MethodSummary;
pub use analysis::part::{Overview, StudySummary};
pub use analysis::poses::{HELD, PoseRow, PosesResult, PosesSummary, observe_poses};
pub use analysis::sampling::{
    FitSummary, NominalSummary, SamplingSummary, SignedEffect, analyse, effects_of_replicates,
};
pub use analysis::sensitivity::{Agreement, SensitivitySummary, measure};
pub use analysis::summary::Summary;
pub use analysis::surface::{SurfaceResult, SurfaceSummary, SurfaceValues, compute_surface};
pub use analysis::values::ValueSummary;
pub use analysis::verdict::recommendation::{Basis, MATTERS, Recommendation, RecommendedIndex, Standing};
pub use analysis::verdict::{PartVerdict, listing_three};
pub use cdpr_sensitivity::{
    Analyser, Analysis, BestFit, Delta, Dependence, Estimate, Evidence, Family, Finding, InputAnalysis,
    LeadingInputs, LevelMean, Limit as OutputLimit, LimitFailures, Pawn, Truncation, is_resolved,
};
pub use error::StudyError;
pub use file::cable_law::{CableLaw, LAW_FORMAT, LawFile, UnloadingCurve, law_json, law_schema};
pub use file::errors_file::{ERRORS_FORMAT, ErrorsFile, errors_schema};
pub use file::grid::{GridAxis, GridSpec};
pub use file::output::{AlongAxis, AmplitudeSpec, Output, VectorOutput};
pub use file::price::{GradeSpec, PriceSpec};
pub use file::record::{RecordTextError, open_record, read_record};
pub use file::sensitivity_spec::SensitivitySpec;
pub use file::study_file::{
    AxisSpec, CorrelationSpec, InputSpec, PoseSpec, PosesSpec, STUDY_FORMAT, SamplingSpec, StudyFile,
    SurfaceSpec, json_schema,
};
pub use file::template::{has_tolerance, template, template_cost, template_notes, write_template};
pub use file::weather::{WeatherQuantity, WeatherSpec, WindProfileSpec};
pub use fs::files::{open_cable, open_robot, open_robot_in_any_unit};
pub use fs::finite::is_not_finite;
pub use fs::input::{
    check_table, from_text, is_standard_input, other_kind, read_bytes, read_table, read_text,
};
pub use fs::lock::Access;
pub use fs::manifest::{ResultsOf, read_result};
pub use fs::owned::ResultsFolder;
pub use fs::single::{IfExists, check_replaceable, write_file};
pub use given::{
    BadCell, GivenColumn, GivenTable, TableAnalysis, TableRequest, VectorAnalysis, analyse_table,
    begin_analysis, open_table, write_analysis,
};
pub use indexmap::IndexMap;
pub use kind::InputKind;
pub use model::cable_law::{elastic_laws, open_law, read_law};
pub use model::error_model::{ErrorModel, Term, uncertainties};
pub use model::errors::{error_model, open_errors, read_errors};
pub use model::grid::{Grid, GridSpan, free_along};
pub use model::hash::robot_hash;
pub use model::observed::{Failure, Measured, MeasuredQuantity, Observed, ScalarCount};
pub use model::observer::{OutputObserver, position_slopes};
pub use model::pose_set::InField;
pub use model::study::{NominalPose, Sampling, Study, Surface, SurfaceAxis};
pub use names::{REPORT_NAME, ROBOT_NAME, STUDY_NAME};
pub use observe::observation::{
    FITTED, KEPT, Part, Session, Tally, observe, observe_into, observe_replicate, observe_rows,
};
pub use observe::pace::ScalarSampling;
pub use observe::plan::{BlockMaker, Plan, observe_shard};
pub use observe::shard::Shard;
pub use observe::status::{
    DesignStatus, Provisional, SamplingStatus, SoFar, Status, check_complete, check_observed, status,
};
pub use results::read::Results;
pub use results::table::{ObservationTable, Rows, TableFormat};
pub use results::write::{Timings, write_figure, write_summary, write_surface, write_timings};
pub use run::{Draw, Drawable, Figure, Run, Watcher, run};
pub use store::block::BLOCK;
pub use store::blocks::Blocks;
pub use store::folder::{Existing, StoredStudy, begin, open_results, take_results};
pub use table::{Blank, Cells, Column, Dimension, Table, TableError, Unit};
