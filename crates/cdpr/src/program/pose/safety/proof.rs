//! A proof by partial factors, and how it is said.

use crate::program::answer::{decimal, numbers};
use crate::program::arguments::towards;
use crate::program::output::{print_sentence, table};
use cdpr_assess::{CaseFactors, FactoredCase, PartialFactors, Situation, governing};
use cdpr_robot::significant;
use serde::Serialize;

/// Its columns in a table with a row for each pose.
pub(super) const COLUMNS: [&str; 4] = ["utilization", "utilization_cable", "utilization_case", "verdict"];

/// How a proof ends.
#[derive(Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Verdict {
    /// No tension is greater than its design resistance.
    Within,
    /// One is, whatever else is not known.
    Exceeds,
    /// A case is open.
    Unknown,
}

impl Verdict {
    pub(super) fn of(case: &FactoredCase) -> Self {
        match (case.is_exceeded(), case.open()) {
            (true, _) => Self::Exceeds,
            (false, None) if case.known().is_some() => Self::Within,
            (false, _) => Self::Unknown,
        }
    }

    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Within => "within",
            Self::Exceeds => "exceeds",
            Self::Unknown => "unknown",
        }
    }
}

/// A proof.
#[derive(Serialize)]
pub(super) struct Proof {
    verdict: Verdict,
    /// The greatest utilization; `null` where a case is open and none exceeds 1.
    utilization: Option<f64>,
    cases: Vec<ProvedCase>,
    #[serde(skip)]
    factors: PartialFactors,
}

/// A case of a proof.
#[derive(Serialize)]
struct ProvedCase {
    /// `intact`, `broken` or `weather`.
    situation: &'static str,
    /// The cables that are broken.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    broken: Vec<usize>,
    /// Direction in which the wind blows, from x to y.
    #[serde(skip_serializing_if = "Option::is_none")]
    azimuth_deg: Option<f64>,
    /// γ_G, γ_Q and γ_R.
    permanent: f64,
    variable: f64,
    resistance: f64,
    verdict: Verdict,
    /// The cable with the greatest utilization that is known, or else with the greatest tension, its tension
    /// under the design loads, and its breaking force over γ_R [N].
    #[serde(skip_serializing_if = "Option::is_none")]
    cable: Option<usize>,
    #[serde(rename = "tension_n")]
    tension: Option<f64>,
    #[serde(rename = "design_resistance_n")]
    design_resistance: Option<f64>,
    /// `null` where the case is open and what is known does not exceed 1.
    utilization: Option<f64>,
    /// Why the case is open.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    /// From where the platform is held without factors.
    #[serde(skip_serializing_if = "Option::is_none")]
    moved_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    turned_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    below_ground: Option<bool>,
    /// The greater one of each cable at the platform and at the exit point [N].
    #[serde(skip_serializing_if = "Vec::is_empty")]
    tensions: Vec<f64>,
    /// `without cable 3`.
    #[serde(skip)]
    name: String,
}

/// `intact`, `broken` or `weather`.
pub(super) fn word(situation: &Situation) -> &'static str {
    match situation {
        Situation::Intact => "intact",
        Situation::Broken(_) => "broken",
        Situation::Weather(_) => "weather",
    }
}

/// The numbers of the cables that are broken.
pub(super) fn broken(situation: &Situation) -> Vec<usize> {
    match situation {
        Situation::Broken(cables) => cables.iter().map(|i| i + 1).collect(),
        _ => Vec::new(),
    }
}

/// Where the wind blows [degrees].
pub(super) fn azimuth(situation: &Situation) -> Option<f64> {
    match situation {
        Situation::Weather(azimuth) => azimuth.map(|azimuth| azimuth.to_degrees().rem_euclid(360.0)),
        _ => None,
    }
}

/// `with all cables`, `without cable 3`, `in wind towards 30 degrees`.
fn name(situation: &Situation) -> String {
    match situation {
        Situation::Intact => "with all cables".to_owned(),
        Situation::Broken(cables) => {
            let many = if cables.len() > 1 { "s" } else { "" };
            format!("without cable{many} {}", numbers(&broken(situation)))
        }
        Situation::Weather(None) => "in the weather".to_owned(),
        Situation::Weather(azimuth) => format!("in wind{}", towards(*azimuth)),
    }
}

impl ProvedCase {
    fn new(case: &FactoredCase) -> Self {
        let (rest, known, loaded) = (case.rest.as_ref().ok(), case.known(), case.most_loaded());
        let CaseFactors { permanent, variable, resistance } = case.factors;
        Self {
            situation: word(&case.situation),
            broken: broken(&case.situation),
            azimuth_deg: azimuth(&case.situation),
            permanent,
            variable,
            resistance,
            verdict: Verdict::of(case),
            cable: loaded.map(|(cable, _)| cable + 1),
            tension: loaded.map(|(_, tension)| tension),
            design_resistance: known.map(|most| most.resistance),
            utilization: case.utilization().map(|most| most.value()),
            reason: case.open(),
            moved_mm: rest.map(|rest| 1e3 * rest.moved),
            turned_deg: rest.map(|rest| rest.turned.to_degrees()),
            below_ground: rest.map(|rest| rest.below_ground),
            tensions: rest.map(|rest| rest.tensions.clone()).unwrap_or_default(),
            name: name(&case.situation),
        }
    }

    /// Its row of the table that is printed, with the reason where reasons differ.
    fn row(&self, has_reasons: bool) -> Vec<String> {
        let force = |value: Option<f64>| value.map_or_else(String::new, |value| significant(value, 4));
        let case = match self.situation {
            "broken" => numbers(&self.broken),
            "weather" => self.azimuth_deg.map_or("weather".to_owned(), |to| format!("wind to {to:.0}°")),
            _ => "none".to_owned(),
        };
        vec![
            case,
            force(self.tension),
            self.cable.map_or_else(String::new, |cable| cable.to_string()),
            force(self.design_resistance),
            self.utilization.map_or_else(String::new, |most| decimal(most, 3)),
            force(self.moved_mm.map(|moved| 1e-3 * moved)),
            self.reason.clone().filter(|_| has_reasons).unwrap_or_default(),
        ]
    }
}

impl Proof {
    pub(super) fn new(factors: PartialFactors, cases: &[FactoredCase]) -> Self {
        let each = || cases.iter().map(Verdict::of);
        let verdict = match each().any(|one| one == Verdict::Exceeds) {
            true => Verdict::Exceeds,
            false => each().find(|one| *one == Verdict::Unknown).unwrap_or(Verdict::Within),
        };
        let most = governing(cases).map(|(_, most)| most.value());
        Self { verdict, utilization: most, cases: cases.iter().map(ProvedCase::new).collect(), factors }
    }

    pub(super) fn verdict(&self) -> Verdict {
        self.verdict
    }

    /// The case with the greatest utilization.
    fn worst(&self) -> Option<&ProvedCase> {
        self.cases.iter().find(|case| case.utilization.is_some() && case.utilization == self.utilization)
    }

    /// The cases that are open.
    fn open(&self) -> Vec<&ProvedCase> {
        self.cases.iter().filter(|case| case.verdict == Verdict::Unknown).collect()
    }

    /// The reason that all cases have, which is no matter of one.
    fn common_reason(&self) -> Option<&str> {
        let first = self.cases.first()?.reason.as_deref()?;
        self.cases.iter().all(|case| case.reason.as_deref() == Some(first)).then_some(first)
    }

    /// Why nothing is known of a case.
    fn why(&self, case: &ProvedCase) -> String {
        let reason = case.reason.clone().unwrap_or_default();
        if self.common_reason().is_some() { reason } else { format!("{}: {reason}", case.name) }
    }

    /// What is known where a case is open.
    fn known(&self) -> String {
        let known = self.cases.iter().filter_map(|case| Some((case.utilization?, case)));
        let Some((most, case)) = known.max_by(|a, b| a.0.total_cmp(&b.0)) else { return String::new() };
        let cable = case.cable.unwrap_or_default();
        format!(" The others are within it: at most {}, of cable {cable} {}.", decimal(most, 3), case.name)
    }

    /// Whether the tensions are within the design resistance, with the worst case.
    fn sentence(&self, heading: &str) -> String {
        let (all, open) = (self.cases.len(), self.open());
        let further = match open.len() {
            0 => String::new(),
            count => format!(" Nothing is known of {count} of {all} cases."),
        };
        let Some(worst) = self.worst() else {
            let why = open.first().map(|case| self.why(case)).unwrap_or_default();
            let within = "whether it is within its design resistance is not known";
            let further = if open.len() < 2 || self.common_reason().is_some() { "" } else { &further };
            return format!("{heading}: {within}; {why}.{further}{}", self.known());
        };
        let most = decimal(worst.utilization.unwrap_or_default(), 3);
        let of = format!("{most}, of cable {} {}", worst.cable.unwrap_or_default(), worst.name);
        if self.verdict == Verdict::Within {
            return format!("{heading} is within its design resistance: utilization at most {of}.");
        }
        let many = self.cases.iter().filter(|case| case.verdict == Verdict::Exceeds).count();
        let many = format!("{many} of {all} cases exceed it");
        format!("{heading} exceeds its design resistance: utilization {of}; {many}.{further}")
    }

    pub(super) fn print(&self, heading: &str, is_followed: bool) {
        print_sentence(&self.sentence(heading));
        let mut rows =
            table(&["broken", "tension [N]", "cable", "resistance [N]", "utilized", "moves [m]", ""]);
        let has_reasons = self.common_reason().is_none();
        for case in &self.cases {
            rows.add_row(case.row(has_reasons));
        }
        println!("{rows}");
        let PartialFactors { persistent, accidental } = self.factors;
        print_sentence(&format!("With all cables: {persistent}."));
        print_sentence(&format!("Without a cable: {accidental}."));
        if !is_followed {
            let greater = "on the way there tensions are greater: --with swing=SECONDS counts them";
            print_sentence(&format!("Breaks count at rest; {greater}."));
        }
        print_sentence(
            "Weights are those of platform and cables. The winches keep the lengths that hold the pose \
             without partial factors.",
        );
        println!("\nWithout partial factors:");
    }

    /// What is open, in one cell.
    pub(super) fn remark(&self) -> Option<String> {
        let open = self.open();
        Some(format!("utilization: {}", self.why(open.first()?)))
    }

    /// Its cells in a table with a row for each pose.
    pub(super) fn cells(&self) -> [String; 4] {
        let worst = self.worst();
        let case = worst.map(|case| match case.situation {
            "broken" => case.broken.iter().map(ToString::to_string).collect::<Vec<_>>().join("+"),
            other => other.to_owned(),
        });
        [
            self.utilization.map_or_else(String::new, |most| format!("{most:?}")),
            worst.and_then(|case| case.cable).map_or_else(String::new, |cable| cable.to_string()),
            case.unwrap_or_default(),
            self.verdict.word().to_owned(),
        ]
    }
}
