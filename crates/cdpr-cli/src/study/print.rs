//! The results of a study on the terminal.

mod sensitivity;

use crate::output::table;
use cdpr_study::{Extremes, PosesSummary, StudySummary, Summary, Timings};

/// Prints all results of a study, and how long each took.
pub(super) fn print(summary: &Summary, timings: &Timings) {
    print_results(summary);
    for (name, study) in &summary.studies {
        if let StudySummary::Sampling(sampling) = study
            && let Some(found) = &sampling.sensitivity
        {
            sensitivity::print(&format!("{name}: {}", sampling.title), found);
        }
    }
    print_comparison(summary);
    for (name, seconds) in &timings.seconds {
        println!("{name:24} {seconds:6.2} s");
    }
    println!("{:24} {:6.2} s", "all", timings.all);
}

fn print_results(summary: &Summary) {
    println!("{}: {}\n", summary.robot, summary.study);
    let mut rows = table(&["study", "n", "failed", "nominal", "mean", "std", "min", "max", "[mm]  best fit"]);
    for (name, study) in &summary.studies {
        rows.add_row(match study {
            StudySummary::Sampling(s) => {
                let best = s.fits.iter().find(|fit| Some(fit.law) == s.best_fit);
                let best = best.map(|fit| format!("{}, p = {:.3}", fit.law, fit.p_value));
                let rms = s.rms_mm.as_ref();
                let rms = rms.map_or([None; 5], |r| [r.nominal, r.mean, r.std, r.min, r.max].map(Some));
                let counts = [s.observations, s.failed.values().sum()].map(|count| count.to_string());
                row(name, counts, rms, best.unwrap_or_default())
            }
            StudySummary::Surface(s) => {
                let rms = [Some(s.rms_mm.nominal), None, None, s.rms_mm.min, s.rms_mm.max];
                let counts = [s.observations, s.failed.values().sum()].map(|count| count.to_string());
                row(name, counts, rms, String::new())
            }
            StudySummary::Poses(s) => {
                let means = [s.mean_mm.map(|mean| mean.min), s.mean_mm.map(|mean| mean.max)];
                let counts = [s.observations, s.failed.values().sum()].map(|count| count.to_string());
                row(name, counts, [None, None, None, means[0], means[1]], "means at the poses".to_owned())
            }
        });
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
    if let Some(Extremes { min, min_at, max, max_at }) = summary.mean_mm {
        println!("{name}: mean RMS from {min:.4} mm at {min_at:?} m to {max:.4} mm at {max_at:?} m");
    }
    let mut dominant: Vec<_> = summary.dominant.iter().collect();
    dominant.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
    for (parameter, count) in dominant.into_iter().take(5) {
        println!("{name}: {parameter} dominates at {count} poses");
    }
}

fn row(name: &str, counts: [String; 2], rms: [Option<f64>; 5], last: String) -> Vec<String> {
    let rms = rms.map(|value| value.map_or_else(String::new, |value| format!("{value:.4}")));
    [name.to_owned()].into_iter().chain(counts).chain(rms).chain([last]).collect()
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
        rows.add_row(cells.map(String::clone));
    }
    println!("{rows}");
    println!("reproduced: within half of the published figure's last digit plus 1 % of it; words: the same");
    println!(
        "points: by the largest t of their coordinates; \
         nearly equal: the largest at most 1.5 times the smallest\n"
    );
}
