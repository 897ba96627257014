//! Published figures compared with the results of a study.
//!
//! `cargo run -p cdpr-study --example published -- FIGURES RESULTS` reads a file of published figures
//! (`cdpr-published/1`, such as `data/reference/published.json`) and a folder of results, and prints a row
//! for each figure of a part that the study has. `cargo xtask caroca-study` runs it.
//!
//! The rule: a number is *reproduced* if it is within half of the published figure's last digit plus 1 % of
//! it; a word is reproduced if it is the same. A law is compared by its name only where the observations
//! decide on one: it is *undecided* while they leave the published one possible, and not reproduced once they
//! reject it.

#![allow(clippy::print_stdout)]
#![cfg_attr(test, allow(clippy::unwrap_used))]

use cdpr_robot::{Axis, from_json, rounded};
use cdpr_sensitivity::is_possible;
use cdpr_study::{
    Evidence, Family, FitSummary, Results, SamplingSummary, StudySummary, Summary, SurfaceSummary,
};
use serde::Deserialize;
use std::error::Error;
use std::fmt;
use std::path::Path;

/// Format of the file.
const FORMAT: &str = "cdpr-published/1";

/// Published figures.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Published {
    format: String,
    /// Where they are published.
    source: String,
    figures: Vec<PublishedFigure>,
}

/// A published figure: a number or a word, and which of ours to compare it with.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct PublishedFigure {
    /// Where it is published, such as `4a`.
    figure: String,
    /// What it is, in words.
    quantity: String,
    /// Name of the sampling or surface.
    study: String,
    /// The statistic of ours.
    statistic: Statistic,
    /// What is published.
    paper: Value,
    /// Unit; empty for a word.
    unit: String,
    /// Last printed digit of a published number, such as 0.01; 0 for a word.
    #[serde(default)]
    last_digit: f64,
    /// What is known of it, such as why it cannot be reproduced.
    #[serde(default)]
    note: Option<String>,
}

/// A number or word of ours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Statistic {
    /// Mean of the RMS [mm].
    Mean,
    /// Its standard deviation [mm].
    Std,
    /// Its least value [mm].
    Min,
    /// Its greatest value [mm].
    Max,
    /// Greatest minus least value [mm].
    Spread,
    /// Greatest minus least value over the mean [%].
    RelativeSpread,
    /// The law that fits best; its name where the observations decide on it.
    BestFit,
    /// The two anchor points with the largest t (largest of their coordinates).
    DominantAnchorPoints,
    /// The two exit points with the largest t.
    DominantExitPoints,
    /// Whether the largest t of an anchor point is at most 1.5 times the smallest: `nearly equal` or
    /// `unequal`.
    AnchorPointEquality,
    /// The same of the exit points.
    ExitPointEquality,
    /// Largest tension of the nominal robot under its own weight [N].
    UnloadedTension,
    /// Largest tension of the nominal robot with the payload [N].
    LoadedTension,
}

/// A number or a word.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged, expecting = "expected a number or a word")]
enum Value {
    Number(f64),
    Text(String),
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            // Four decimals, without zeros that say nothing.
            Self::Number(number) => write!(f, "{}", rounded(*number, 4)),
            Self::Text(text) => f.write_str(text),
        }
    }
}

/// Whether a published figure is reproduced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    /// Within the rule.
    Reproduced,
    /// Outside it.
    NotReproduced,
    /// The observations do not say.
    Undecided,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Reproduced => "reproduced",
            Self::NotReproduced => "not reproduced",
            Self::Undecided => "undecided",
        })
    }
}

/// The largest t of a point may be this many times the smallest for all to count as nearly equal.
const NEARLY_EQUAL: f64 = 1.5;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [figures, folder] = &arguments[..] else {
        return Err("expected a file of published figures and a folder of results".into());
    };
    let published: Published = from_json(&std::fs::read_to_string(figures)?)?;
    if published.format != FORMAT {
        return Err(format!("{figures}: format is `{}`: expected `{FORMAT}`", published.format).into());
    }
    let summary = Results::read(Path::new(folder))?.summary;
    println!("{} compared with {}\n", summary.study, published.source);
    print(&compare(&published.figures, &summary));
    Ok(())
}

/// A published figure, the computed one, and whether they agree.
type Row<'a> = (&'a PublishedFigure, Value, Verdict);

/// Compares the figures of the parts that a study has. A statistic that a part does not have is `none`.
fn compare<'a>(figures: &'a [PublishedFigure], summary: &Summary) -> Vec<Row<'a>> {
    let compared = |figure: &'a PublishedFigure| {
        let part = summary.studies.get(&figure.study)?;
        let computed = computed(figure.statistic, part).unwrap_or_else(|| Value::Text("none".to_owned()));
        let is_open = match part {
            StudySummary::Sampling(of) => figure.statistic == Statistic::BestFit && open(&figure.paper, of),
            _ => false,
        };
        let verdict = match is_open {
            true => Verdict::Undecided,
            false => verdict(&figure.paper, &computed, figure.last_digit),
        };
        Some((figure, computed, verdict))
    };
    figures.iter().filter_map(compared).collect()
}

fn print(rows: &[Row]) {
    println!(
        "{:<12} {:<22} {:<24} {:>16} {:>16} {:<4} verdict",
        "figure", "part", "quantity", "paper", "computed", "unit"
    );
    for (figure, computed, verdict) in rows {
        let PublishedFigure { figure, quantity, study, paper, unit, note, .. } = figure;
        let note = note.as_ref().map_or_else(String::new, |note| format!(" ({note})"));
        println!(
            "{figure:<12} {study:<22} {quantity:<24} {:>16} {:>16} {unit:<4} {verdict}{note}",
            paper.to_string(),
            computed.to_string()
        );
    }
    let reproduced = rows.iter().filter(|(.., verdict)| *verdict == Verdict::Reproduced).count();
    println!(
        "\n{reproduced} of {} figures are reproduced: within half of the last digit plus 1 % of the",
        rows.len()
    );
    println!("figure; words: the same, laws only if decided. Points are ranked by the largest t of their");
    println!(
        "coordinates; they are nearly equal if the largest is at most {NEARLY_EQUAL} times the smallest."
    );
}

fn verdict(paper: &Value, computed: &Value, last_digit: f64) -> Verdict {
    let within = match (paper, computed) {
        (Value::Number(paper), Value::Number(computed)) => {
            (computed - paper).abs() <= 0.5 * last_digit + 0.01 * paper.abs()
        }
        (paper, computed) => paper == computed,
    };
    if within { Verdict::Reproduced } else { Verdict::NotReproduced }
}

fn computed(statistic: Statistic, study: &StudySummary) -> Option<Value> {
    match study {
        StudySummary::Sampling(sampling) => of_sampling(statistic, sampling),
        StudySummary::Surface(surface) => of_surface(statistic, surface),
        // The study file has no such row.
        StudySummary::Poses(_) => None,
    }
}

fn of_sampling(statistic: Statistic, sampling: &SamplingSummary) -> Option<Value> {
    let values = sampling.values.as_ref()?;
    let largest = |tensions: &[f64]| tensions.iter().copied().reduce(f64::max);
    let number = match statistic {
        Statistic::Mean => values.mean,
        Statistic::Std => values.std,
        Statistic::Min => values.min,
        Statistic::Max => values.max,
        Statistic::Spread => values.max - values.min,
        Statistic::RelativeSpread => 100.0 * (values.max - values.min) / values.mean,
        Statistic::UnloadedTension => largest(&sampling.nominal.unloaded_tensions)?,
        Statistic::LoadedTension => largest(&sampling.nominal.loaded_tensions)?,
        Statistic::BestFit => {
            let best = sampling.best_fit?;
            let text = match best.evidence {
                Evidence::Decided => name(best.family)?,
                Evidence::Undecided | Evidence::Rejected => best.to_string(),
            };
            return Some(Value::Text(text));
        }
        Statistic::DominantAnchorPoints => return dominant(&point_effects(sampling, 'a')),
        Statistic::DominantExitPoints => return dominant(&point_effects(sampling, 'b')),
        Statistic::AnchorPointEquality => return equality(&point_effects(sampling, 'a')),
        Statistic::ExitPointEquality => return equality(&point_effects(sampling, 'b')),
    };
    Some(Value::Number(number))
}

/// Name of a family as a study file has it.
fn name(family: Family) -> Option<String> {
    Some(serde_json::to_value(family).ok()?.as_str()?.to_owned())
}

/// Whether the observations leave several laws possible, the published one among them.
fn open(paper: &Value, sampling: &SamplingSummary) -> bool {
    let published = |fit: &&FitSummary| name(fit.law).map(Value::Text).as_ref() == Some(paper);
    sampling.best_fit.is_some_and(|best| best.evidence == Evidence::Undecided)
        && sampling.fits.iter().find(published).is_some_and(|fit| is_possible(fit.probability, fit.p_value))
}

fn of_surface(statistic: Statistic, surface: &SurfaceSummary) -> Option<Value> {
    let (min, max) = (surface.values.min?, surface.values.max?);
    match statistic {
        Statistic::Min => Some(Value::Number(min)),
        Statistic::Max => Some(Value::Number(max)),
        Statistic::Spread => Some(Value::Number(max - min)),
        _ => None,
    }
}

/// Largest t of the coordinates of each point `a1`, `a2`, ... (or `b1`, ...), in the order of their numbers.
fn point_effects(sampling: &SamplingSummary, letter: char) -> Vec<(String, f64)> {
    (1..)
        .map_while(|i| {
            let point = format!("{letter}{i}");
            let t = Axis::ALL.iter().filter_map(|axis| sampling.t_student.get(&format!("{point}.{axis}")));
            t.copied().reduce(f64::max).map(|t| (point, t))
        })
        .collect()
}

fn dominant(effects: &[(String, f64)]) -> Option<Value> {
    let mut effects = effects.to_vec();
    effects.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut names: Vec<String> = effects.get(..2)?.iter().map(|(name, _)| name.to_uppercase()).collect();
    names.sort();
    Some(Value::Text(names.join(" ")))
}

fn equality(effects: &[(String, f64)]) -> Option<Value> {
    let largest = effects.iter().map(|(_, t)| *t).reduce(f64::max)?;
    let smallest = effects.iter().map(|(_, t)| *t).reduce(f64::min)?;
    let equal = largest <= NEARLY_EQUAL * smallest;
    Some(Value::Text(if equal { "nearly equal" } else { "unequal" }.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use cdpr_study::{IndexMap, Session, Study, analyse, compute_surface, observe};

    #[test]
    fn the_verdict_follows_the_rule_at_its_edges() {
        let number = Value::Number;
        // 1.34 printed to 0.01: 0.005 + 0.0134.
        assert_eq!(verdict(&number(1.34), &number(1.3583), 0.01), Verdict::Reproduced);
        assert_eq!(verdict(&number(1.34), &number(1.3585), 0.01), Verdict::NotReproduced);
        assert_eq!(verdict(&number(1.34), &number(1.3215), 0.01), Verdict::NotReproduced);
        let word = |text: &str| Value::Text(text.to_owned());
        assert_eq!(verdict(&word("normal"), &word("normal"), 0.0), Verdict::Reproduced);
        assert_eq!(verdict(&word("normal"), &word("uniform"), 0.0), Verdict::NotReproduced);
        assert_eq!(verdict(&number(1.0), &word("none"), 0.01), Verdict::NotReproduced);
    }

    #[test]
    fn points_are_ranked_and_judged_by_their_largest_coordinate() {
        let effects =
            [("b1", 1.0), ("b2", 9.0), ("b3", 2.0), ("b4", 8.0)].map(|(name, t)| (name.to_owned(), t));
        assert_eq!(dominant(&effects), Some(Value::Text("B2 B4".to_owned())));
        assert_eq!(equality(&effects), Some(Value::Text("unequal".to_owned())));
        assert_eq!(equality(&effects[1..2]), Some(Value::Text("nearly equal".to_owned())));
    }

    /// A file of `data`.
    fn data(file: &str) -> String {
        format!("{}/../../data/{file}", env!("CARGO_MANIFEST_DIR"))
    }

    #[test]
    fn few_observations_of_caroca_reproduce_the_deflections_of_the_paper_and_decide_on_no_law() {
        let mut study = Study::open(data("studies/caroca.json").as_ref()).unwrap();
        study.set_observations(64).unwrap();
        (study.file.replicates, study.file.bootstrap_resamples) = (2, 10);
        let mut studies = IndexMap::new();
        for name in study.file.samplings.keys() {
            let (sampling, session) = (study.sampling(name).unwrap(), Session::in_memory());
            let summary = analyse(&sampling, &observe(&sampling, &session).unwrap(), &session).unwrap();
            studies.insert(name.clone(), StudySummary::Sampling(Box::new(summary)));
        }
        for name in study.file.surfaces.keys() {
            let surface = study.surface(name).unwrap();
            let summary = SurfaceSummary::new(&surface, &compute_surface(&surface, &|_| ()));
            studies.insert(name.clone(), StudySummary::Surface(summary));
        }
        let summary = Summary::new(&study, studies).unwrap();
        let text = std::fs::read_to_string(data("reference/published.json")).unwrap();
        let published: Published = from_json(&text).unwrap();
        let rows = compare(&published.figures, &summary);
        assert_eq!(rows.len(), 22);
        let reproduced = rows.iter().filter(|(.., verdict)| *verdict == Verdict::Reproduced);
        let figures: Vec<_> = reproduced.map(|(row, ..)| row.figure.as_str()).collect();
        assert_eq!(figures, [&["4a"; 5][..], &["5a"; 3], &["section 5.1"]].concat());
        // 64 observations leave several laws possible, and ten samples of a bootstrap reject none.
        let laws: Vec<_> = rows.iter().filter(|(row, ..)| row.quantity == "law").collect();
        assert!(laws.len() == 2 && laws.iter().all(|(.., verdict)| *verdict == Verdict::Undecided));
        assert!(laws.iter().all(|(_, computed, _)| computed.to_string().contains(" (undecided), p ")));
    }
}
