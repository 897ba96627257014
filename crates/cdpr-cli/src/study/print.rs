//! The results of a study on the terminal.

pub(super) mod analysis;
mod sensitivity;

use crate::output::table;
use cdpr_robot::shown;
use cdpr_study::{Extremes, Output, Overview, PosesSummary, StudySummary, Summary, Timings};

/// Prints all results of a study, and how long each took.
pub(super) fn print(summary: &Summary, timings: &Timings) {
    print_results(summary);
    for (name, study) in &summary.studies {
        if let StudySummary::Sampling(sampling) = study
            && let Some(found) = &sampling.sensitivity
        {
            sensitivity::print(&format!("{name}: {}", shown(&sampling.title)), sampling.output, found);
        }
    }
    print_comparison(summary);
    for (name, seconds) in &timings.seconds {
        println!("{name:24} {seconds:6.2} s");
    }
    println!("{:24} {:6.2} s", "all", timings.all);
}

fn print_results(summary: &Summary) {
    println!("{}: {}\n", shown(&summary.robot), shown(&summary.study));
    // One output is that of all parts of a study.
    let output = summary.studies.values().next().map_or_else(Output::default, StudySummary::output);
    let last = format!("[{}]  best fit", output.unit());
    let mut rows = table(&["study", "n", "failed", "nominal", "mean", "std", "min", "max", &last]);
    for (name, study) in &summary.studies {
        let counts = [study.observations(), study.failed().values().sum()].map(|count| count.to_string());
        let Overview { nominal, mean, std, min, max, best_fit } = study.overview();
        let numbers = [nominal, mean, std, min, max].map(|value| value.map(|value| format!("{value:.4}")));
        let last = match (study, best_fit) {
            (StudySummary::Poses(_), _) => "means at the poses".to_owned(),
            (_, fit) => fit.map_or_else(String::new, |fit| fit.to_string()),
        };
        let cells = numbers.map(Option::unwrap_or_default).into_iter().chain([last]);
        rows.add_row([name.clone()].into_iter().chain(counts).chain(cells));
    }
    println!("{rows}\n");
    for (name, study) in &summary.studies {
        if let StudySummary::Sampling(s) = study {
            if let Some([least, greatest]) = s.operating_moduli_gpa {
                println!("{name}: E at the operating point {least:.2} to {greatest:.2} GPa");
            }
            for note in &s.notes {
                println!("{name}: {note}");
            }
        }
        if let StudySummary::Poses(s) = study {
            print_poses(name, s);
        }
        for (kind, count) in study.failed().iter().filter(|(_, count)| **count > 0) {
            println!("{name}: {count} failed: {kind}");
        }
    }
}

/// Prints the poses by status, the extremes, and the parameters that dominate.
fn print_poses(name: &str, summary: &PosesSummary) {
    for (status, count) in &summary.status {
        println!("{name}: {count} of {} poses {}", summary.poses, status.replace('_', " "));
    }
    if let Some(Extremes { min, min_at, max, max_at }) = summary.mean {
        let (short, unit) = (summary.output.short(), summary.output.unit());
        println!(
            "{name}: mean {short} from {min:.4} {unit} at {min_at:?} m to {max:.4} {unit} at {max_at:?} m"
        );
    }
    let mut dominant: Vec<_> = summary.dominant.iter().collect();
    dominant.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
    for (parameter, count) in dominant.into_iter().take(5) {
        println!("{name}: {parameter} dominates at {count} poses");
    }
}

fn print_comparison(summary: &Summary) {
    if summary.comparison.is_empty() {
        return;
    }
    let mut rows = table(&["figure", "quantity", "paper", "computed", "unit", "verdict"]);
    for r in &summary.comparison {
        let cells = [
            &r.figure,
            &r.quantity,
            &r.paper.to_string(),
            &r.computed.to_string(),
            &r.unit,
            &r.verdict.to_string(),
        ];
        rows.add_row(cells.map(|cell| shown(cell).into_owned()));
    }
    println!("{rows}");
    println!(
        "reproduced: within half of the published figure's last digit plus 1 % of it; \
         words: the same, laws only if decided"
    );
    println!(
        "points: by the largest t of their coordinates; \
         nearly equal: the largest at most 1.5 times the smallest\n"
    );
}
