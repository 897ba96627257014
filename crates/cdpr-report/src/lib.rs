//! Figures of study results, ready for a paper, and [`report()`], which shows them in one HTML file.
//!
//! Each figure is one function from results to SVG text. [`draw()`] draws all figures of a finished part of a
//! study from memory, for [`cdpr_study::run`]. Nothing here reads or writes files.
//!
//! | figure of the paper | content | function |
//! |---|---|---|
//! | | the robot at the poses of a study | [`robot_view`] |
//! | 3 | load over elongation, and other cycles | [`cycle`] |
//! | 4a, 5a | distribution of the magnitude with its fitted laws | [`histogram`] |
//! | 4b, 4c | magnitude over two parameters | [`surface`] |
//! | 5b, 5c | t-Student index of the coordinates of points | [`point_effects`] |
//! | | signed effects with their intervals | [`signed_effects`] |
//! | | shares of the variance by all measures | [`shares`] |
//! | | deflection, stiffness or tension over a plane of the workspace | [`heat_map`] |
//! | | the dominant tolerance over a plane | [`tolerance_map`] |
//! | | all maps of a plane or of the layers of a box | [`workspace_maps`] |
//! | | results of a sampling at many poses over the workspace | [`pose_maps`] |
//! | | tensions, deflection, stiffness along a path, with bands of uncertainty | [`path_view`] |
//! | | answers of the direct model from wrong starts | [`found_poses`], [`success_share`] |
//!
//! The paper is Baklouti, Caro, Courteille, *Sensitivity Analysis of the Elasto-Geometrical Model of
//! Cable-Driven Parallel Robots*, 2017. Figures are on white, as wide as a [`Sheet`]: 700 px on a screen, or of a width in print. Their colours are those of
//! Okabe and Ito and viridis, which are safe for the colour-blind. The same results give the same bytes.
//! [`figure_file`] makes files of them: SVG, and with the feature `figures` PDF and PNG.
//!
//! ```no_run
//! use cdpr_report::Sheet;
//! use cdpr_study::{Session, Study, analyse, observe};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let study = Study::open("data/studies/caroca.json".as_ref())?;
//! let sampling = study.sampling("mechanical")?;
//! let session = Session::in_memory();
//! let summary = analyse(&sampling, &observe(&sampling, &session)?, &session)?;
//! std::fs::write("mechanical.svg", cdpr_report::histogram(&summary, Sheet::SCREEN)?)?;
//! # Ok(())
//! # }
//! ```

mod draw;
mod drawing;
mod error;
mod explorer;
mod figure;
mod file;
mod live;
mod page;
mod parameters;
mod scene;
mod text;

pub use draw::{draw, figures};
pub use drawing::sheet::{FIGURE_WIDTHS_MM, Sheet};
pub use error::ReportError;
pub use explorer::{Explored, explorer};
pub use figure::cycle::{Cycle, CycleBranch, cycle};
pub use figure::heat_map::{MapQuantity, heat_map, layers, tolerance_map, workspace_maps};
pub use figure::histogram::histogram;
pub use figure::motion::{Quantity, over_time};
pub use figure::path::path_view;
pub use figure::points::{NamedSampling, Points, point_effects};
pub use figure::pose_map::{NamedMap, pose_maps};
pub use figure::response::{Amplitudes, amplitudes};
pub use figure::robot_view::robot_view;
pub use figure::robustness::{found_poses, success_share};
pub use figure::shares::shares;
pub use figure::signed_effects::signed_effects;
pub use figure::surface::surface;
pub use file::{FigureFile, FigureFormat, figure_file};
pub use live::explored_study;
pub use page::{analysis_report, calibration_report, report, report_with};
