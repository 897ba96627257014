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

/// Name of the list of the files that runs have written into a folder. Other files belong to the user.
pub(crate) const MANIFEST_NAME: &str = "cdpr-results.json";

/// Name of the file that a process locks while it writes into a folder of results.
pub(crate) const LOCK_NAME: &str = "cdpr-results.lock";
