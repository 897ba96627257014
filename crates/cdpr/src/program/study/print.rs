//! The results of a study on the terminal.

pub(super) mod analysis;
mod sensitivity;

use crate::program::output::{print_sentence, table, wide_table};
use cdpr_robot::{decimals_of, shown, visible};
use cdpr_study::{
    Extremes, Output, Overview, PartVerdict, PosesSummary, Recommendation, StudySummary, Summary, Timings,
};

/// Prints the answer of each part of a study.
pub(super) fn print(summary: &Summary) {
    for (number, (name, part)) in summary.studies.iter().enumerate() {
        if number > 0 {
            println!();
        }
        print_verdict(name, part.verdict());
    }
}

fn print_verdict(name: &str, verdict: &PartVerdict) {
    let mut before = format!("{name}: ");
    for sentence in &verdict.sentences {
        print_sentence(&(std::mem::take(&mut before) + sentence));
    }
    if let Some(recommendation) = &verdict.recommendation {
        print_leading(recommendation);
    }
}

fn print_leading(recommendation: &Recommendation) {
    let mut rows = table(&["input", "share, or index"]);
    for of in recommendation.leading() {
        rows.add_row([of.input.clone(), recommendation.cell(of)]);
    }
    println!("{rows}");
    print_sentence(&recommendation.caption());
}

/// Prints all results of a study, and how long each took.
pub(super) fn print_details(summary: &Summary, timings: &Timings) {
    print_results(summary);
    for (name, study) in &summary.studies {
        if let StudySummary::Sampling(sampling) = study
            && let Some(found) = &sampling.sensitivity
        {
            sensitivity::print(&format!("{name}: {}", shown(&sampling.title)), sampling.output, found);
        }
    }
    for (name, seconds) in &timings.seconds {
        println!("{name:24} {seconds:6.2} s");
    }
    println!("{:24} {:6.2} s", "in total", timings.all);
}

fn print_results(summary: &Summary) {
    println!("{}: {}\n", shown(&summary.robot), shown(&summary.study));
    // One output is that of all parts of a study.
    let output = summary.studies.values().next().map_or_else(Output::default, StudySummary::output);
    let of_unit = ["nominal", "mean", "std", "min", "max"].map(|name| format!("{name} [{}]", output.unit()));
    let header = ["part", "n", "failed"].into_iter().chain(of_unit.iter().map(String::as_str));
    let mut rows = wide_table(&header.chain(["best fit"]).collect::<Vec<_>>());
    for (name, study) in &summary.studies {
        let counts = [study.observations(), study.failed().values().sum()].map(|count| count.to_string());
        let Overview { nominal, mean, std, min, max, best_fit } = study.overview();
        let numbers = [nominal, mean, std, min, max];
        let decimals = decimals_of(numbers.into_iter().flatten(), 3) + 1;
        let numbers = numbers.map(|value| value.map(|value| format!("{value:.decimals$}")));
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
            "{name}: mean {short} from {} {unit} at {min_at:?} m to {} {unit} at {max_at:?} m",
            visible(min, 4),
            visible(max, 4)
        );
    }
    let mut dominant: Vec<_> = summary.dominant.iter().collect();
    dominant.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
    for (parameter, count) in dominant.into_iter().take(5) {
        println!("{name}: {parameter} dominates at {count} poses");
    }
}
