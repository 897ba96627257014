//! Names of the files in a folder of results.

/// Name of the study file in a folder of results.
pub const STUDY_NAME: &str = "study.json";

/// Name of the robot file in a folder of results.
pub const ROBOT_NAME: &str = "robot.json";

/// Name of the folder of blocks in a folder of results.
pub(crate) const BLOCKS_NAME: &str = "blocks";

/// Name of the summary in a folder of results.
pub(crate) const SUMMARY_NAME: &str = "summary.json";

/// Name of the times in a folder of results.
pub(crate) const TIMINGS_NAME: &str = "timings.json";

/// Name of the report in a folder of results.
pub const REPORT_NAME: &str = "report.html";

/// Name of the file that marks a folder of results. In any other folder a `study.json` belongs to the user.
pub(crate) const MARK_NAME: &str = "cdpr-results.txt";
