//! Calibration of cable-driven parallel robots: from measurements to a better robot, and to the accuracy that
//! is left.
//!
//! | question | function |
//! |---|---|
//! | which parameters explain the measurements, and how exactly are they known then? | [`fit`] |
//! | what do measurements of this kind tell at all? | [`Calibration::identify`] |
//! | which poses should be measured? | [`Calibration::plan`], [`Calibration::best_poses`] |
//! | what would a campaign read? | [`simulate`] |
//! | which friction of pulleys explains tensions at winches? | [`calibrate_pulleys`] |
//! | all of a calibration, from a table to results and their folder | [`carry_out`] |
#![warn(missing_docs)]

mod campaign;
mod carry_out;
mod error;
mod fit;
mod fitted;
mod identify;
mod model;
mod plan;
mod plausible;
mod results;
mod sensor_error;
mod simulate;
mod solve;
mod table;
mod unknowns;

pub use campaign::{Noise, Quantity, Reading, Row};
pub use carry_out::carry_out;
pub use error::CalibrationError;
pub use fit::friction::{EstimatedValue, PulleyCalibration, PulleyOfCable, WinchResidual, calibrate_pulleys};
pub use fit::{cross_validated, fit};
pub use fitted::{Difference, Estimate, Fit, FitSettings, FitStatus, RobustLoss, UnidentifiableCombination};
pub use identify::measurement::Measurement;
pub use identify::{
    AtWork, Calibration, CauseValue, ChosenPose, Combination, Identifiability, ParameterValue,
};
pub use plan::{Criterion, PosePlan, Quality};
pub use results::arrows;
pub use results::folder::{CALIBRATED_NAME, Calibrated, POSTERIOR_NAME};
pub use results::patterns::{Split, Trend};
pub use results::predicted::UncertaintyMap;
pub use results::summary::{
    CalibrationSummary, Campaign, LengthConstant, OutlierSummary, ParameterSummary, RowApart, SensorSummary,
};
pub use sensor_error::SensorError;
pub use simulate::{Simulated, drawn, drawn_errors, simulate};
pub use table::{MEASUREMENTS_FORMAT, Measurements, read_measurements, write_measurements};
pub use unknowns::{Unknown, Unknowns};
