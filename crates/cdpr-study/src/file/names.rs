//! Names of the files in a folder of results: which are of a study, and that no two parts of it write the
//! same.

use crate::file::study_file::{SamplingSpec, StudyFile};
use crate::names::{REPORT_NAME, ROBOT_NAME, STUDY_NAME, SUMMARY_NAME, TIMINGS_NAME};

/// Figures of the study as a whole.
const OF_ALL: [&str; 3] = ["robot", "anchor_points", "exit_points"];

impl SamplingSpec {
    /// Whether a table or figure has the sampling's name with this behind it.
    fn has_further(&self, rest: &str) -> bool {
        if self.poses.is_none() {
            return ["_effects", "_sensitivity"].contains(&rest);
        }
        // Each layer of a box has maps of its own.
        let map = match rest.rsplit_once("_z") {
            Some((map, layer)) if is_number(layer) => map,
            _ => rest,
        };
        ["_mean", "_std", "_dominant"].contains(&map)
    }
}

impl StudyFile {
    /// Who writes a table or figure of this name, without its ending, though itself called otherwise.
    pub(crate) fn other_writer(&self, name: &str) -> Option<String> {
        if OF_ALL.contains(&name) {
            return Some("the study as a whole".to_owned());
        }
        let mut samplings = self.samplings.iter();
        let further = |(sampling, spec): &(&String, &SamplingSpec)| {
            name.strip_prefix(sampling.as_str()).is_some_and(|rest| spec.has_further(rest))
        };
        samplings.find(further).map(|(sampling, _)| format!("samplings.{sampling}"))
    }

    /// Whether a run of the study may write a file of this name right in its folder of results.
    pub(crate) fn writes(&self, name: &str) -> bool {
        if [STUDY_NAME, ROBOT_NAME, SUMMARY_NAME, TIMINGS_NAME, REPORT_NAME].contains(&name) {
            return true;
        }
        let Some((name, "csv" | "parquet" | "svg")) = name.rsplit_once('.') else { return false };
        self.samplings.contains_key(name)
            || self.surfaces.contains_key(name)
            || self.other_writer(name).is_some()
    }

    /// Names of the files that a run writes right in its folder of results, except maps over poses, which are
    /// known only when they are drawn: tables of observations with this ending, if they are written.
    pub(crate) fn names(&self, table: Option<&str>) -> Vec<String> {
        let mut names: Vec<String> = [SUMMARY_NAME, TIMINGS_NAME, REPORT_NAME].map(str::to_owned).into();
        names.extend(OF_ALL.map(|name| format!("{name}.svg")));
        for (name, spec) in &self.samplings {
            if spec.poses.is_some() {
                names.push(format!("{name}.csv"));
                continue;
            }
            names.extend(table.map(|ending| format!("{name}.{ending}")));
            names.extend(["", "_effects"].map(|of| format!("{name}{of}.svg")));
            if self.sensitivity.is_some() {
                names.extend(["csv", "svg"].map(|ending| format!("{name}_sensitivity.{ending}")));
            }
        }
        names.extend(self.surfaces.keys().flat_map(|name| ["csv", "svg"].map(|of| format!("{name}.{of}"))));
        names
    }
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|digit| digit.is_ascii_digit())
}
