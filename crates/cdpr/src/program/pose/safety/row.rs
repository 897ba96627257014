//! Answers of `cdpr safety` as rows of tables: one for each pose, and one for each case of a pose.

use crate::program::answer::OutOfLimits;
use crate::program::output::Ending;
use crate::program::pose::at_pose::{Brief, Row};
use crate::program::pose::safety::Answer;
use crate::program::pose::safety::case::{Case, Factor, Swinging};
use crate::program::pose::safety::proof::{self, Proof, Verdict};
use crate::program::pose::safety::weather::{self, InWeather};
use cdpr_assess::{CaseFactors, FactoredCase, Situation};
use cdpr_robot::{Pose, Robot};

/// Columns of a table with a row for each case.
const CASES: [&str; 24] = [
    "case",
    "broken",
    "azimuth_deg",
    "ending",
    "permanent",
    "variable",
    "resistance",
    "cable",
    "tension_n",
    "breaking_force_n",
    "design_resistance_n",
    "utilization",
    "verdict",
    "safety_factor",
    "safety_factor_cable",
    "moved_mm",
    "turned_deg",
    "slack",
    "below_ground",
    "swing_moved_mm",
    "peak_tension_n",
    "peak_tension_cable",
    "peak_difference_n",
    "reason",
];

/// All digits of a number; an unknown number is an empty cell.
fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| format!("{value:?}"))
}

/// Numbers of cables with `+` between them.
fn joined(cables: &[usize]) -> String {
    cables.iter().map(ToString::to_string).collect::<Vec<_>>().join("+")
}

impl Answer {
    /// How a case ends without factors, its safety factor then, and what is to be said of it.
    fn without_factors(&self, situation: &Situation) -> (String, Factor, String) {
        match situation {
            Situation::Intact => ("held".to_owned(), self.factor, String::new()),
            Situation::Broken(_) => {
                let broken = proof::broken(situation);
                let case = self.broken.iter().find(|case| case.cables == broken);
                case.map(|case| (case.ending(), case.factor(), case.remark())).unwrap_or_default()
            }
            Situation::Weather(_) => {
                let of = |weather: &InWeather| {
                    let wrong = weather.wrong().unwrap_or_default();
                    (weather.ending(), weather.factor(), wrong.to_owned())
                };
                self.in_weather.as_ref().map(of).unwrap_or_default()
            }
        }
    }

    /// A row of [`CASES`].
    fn case_cells(&self, case: &FactoredCase) -> Vec<String> {
        let (rest, known) = (case.rest.as_ref().ok(), case.known());
        let broken = proof::broken(&case.situation);
        let swing = self.broken.iter().find(|given| given.cables == broken).and_then(Case::swinging);
        let (ending, factor, remark) = self.without_factors(&case.situation);
        let loaded = case.most_loaded();
        let CaseFactors { permanent, variable, resistance } = case.factors;
        let open = case.open().filter(|open| self.proof.is_some() && !remark.contains(open.as_str()));
        let reasons = [Some(remark), open].into_iter().flatten().filter(|reason| !reason.is_empty());
        let slack: Vec<usize> = rest.iter().flat_map(|rest| &rest.slack).map(|i| i + 1).collect();
        vec![
            proof::word(&case.situation).to_owned(),
            joined(&broken),
            number(proof::azimuth(&case.situation)),
            ending,
            number(Some(permanent)),
            number(Some(variable)),
            number(Some(resistance)),
            loaded.map_or_else(String::new, |(cable, _)| (cable + 1).to_string()),
            number(loaded.map(|(_, tension)| tension)),
            number(known.and_then(|most| self.breaking_forces[most.cable])),
            number(known.map(|most| most.resistance)),
            number(case.utilization().map(|most| most.value())),
            if self.proof.is_some() { Verdict::of(case).word().to_owned() } else { String::new() },
            number(factor.value),
            factor.cable.map_or_else(String::new, |cable| cable.to_string()),
            number(rest.map(|rest| 1e3 * rest.moved)),
            number(rest.map(|rest| rest.turned.to_degrees())),
            joined(&slack),
            rest.map_or_else(String::new, |rest| rest.below_ground.to_string()),
            number(swing.map(|swing| swing.moved_mm)),
            number(swing.map(|swing| swing.greatest_tension.tension)),
            swing.map_or_else(String::new, |swing| swing.greatest_tension.cable.to_string()),
            number(swing.map(|swing| swing.tension_difference)),
            reasons.collect::<Vec<_>>().join("; "),
        ]
    }
}

impl Row for Answer {
    fn columns(_: &Robot) -> Vec<String> {
        [
            "moved_mm",
            "moved_without",
            "turned_deg",
            "turned_without",
            "greatest_tension_n",
            "greatest_tension_cable",
            "greatest_tension_without",
            "safety_factor",
            "safety_factor_cable",
            "safety_factor_without",
            "overloaded_without",
            "below_ground_without",
            "no_rest_without",
            "swing_moved_mm",
            "peak_tension_n",
            "peak_tension_cable",
            "peak_tension_without",
        ]
        .into_iter()
        .chain(weather::COLUMNS)
        .chain(proof::COLUMNS)
        .map(str::to_owned)
        .collect()
    }

    fn cells(&self) -> Vec<String> {
        let without = |found: Option<(f64, &Case)>| match found {
            Some((value, case)) => [format!("{value:?}"), self.names(|one| std::ptr::eq(one, case))],
            None => [String::new(), String::new()],
        };
        let tension = self.greatest(|rest| rest.greatest_tension.tension);
        let cable = tension.and_then(|(_, case)| Some(case.rest.as_ref()?.greatest_tension.cable));
        let [value, case] = without(tension);
        let factors = self.broken.iter().filter_map(|case| Some((case.factor().value?, case)));
        let least = factors.min_by(|a, b| a.0.total_cmp(&b.0));
        let factor_cable = least.and_then(|(_, case)| case.factor().cable);
        let [factor, factor_case] = without(least);
        let last = [
            value,
            cable.map_or_else(String::new, |cable| cable.to_string()),
            case,
            factor,
            factor_cable.map_or_else(String::new, |cable| cable.to_string()),
            factor_case,
            self.names(Case::is_overloaded),
            self.names(Case::is_below_ground),
            self.names(|case| case.rest.is_none()),
        ];
        let [moved, turned] = [self.greatest(|rest| rest.moved_mm), self.greatest(|rest| rest.turned_deg)];
        let swings: Vec<_> = self.broken.iter().filter_map(|case| Some((case.swinging()?, case))).collect();
        let far = swings.iter().map(|(swing, _)| swing.moved_mm).max_by(f64::total_cmp);
        let tension = |swing: &Swinging| swing.greatest_tension.tension;
        let peak = swings.iter().max_by(|a, b| tension(a.0).total_cmp(&tension(b.0)));
        let [value, case] = without(peak.map(|(swing, case)| (tension(swing), *case)));
        let far = far.map_or_else(String::new, |far| format!("{far:?}"));
        let cable = peak.map_or_else(String::new, |(swing, _)| swing.greatest_tension.cable.to_string());
        let swing = [far, value, cable, case];
        let weather = self.in_weather.as_ref().map(InWeather::cells);
        let weather = weather.unwrap_or_else(|| vec![String::new(); weather::COLUMNS.len()]);
        let proof = self.proof.as_ref().map(Proof::cells).unwrap_or_default();
        let numbers = without(moved).into_iter().chain(without(turned)).chain(last).chain(swing);
        numbers.chain(weather).chain(proof).collect()
    }

    fn remark(&self) -> String {
        self.proof.as_ref().and_then(Proof::remark).unwrap_or_default()
    }

    fn cases(&self) -> Option<Vec<Vec<String>>> {
        let names = CASES.map(str::to_owned).to_vec();
        Some([names].into_iter().chain(self.cases.iter().map(|case| self.case_cells(case))).collect())
    }

    fn found_pose(&self) -> Option<Pose> {
        self.found_pose
    }

    fn brief(&self) -> Vec<Brief> {
        let moved = self.greatest(|rest| rest.moved_mm).map(|(moved, _)| 1e-3 * moved);
        let tension = self.greatest(|rest| rest.greatest_tension.tension).map(|(tension, _)| tension);
        vec![Brief::Most("moves", "m", moved), Brief::Most("tension", "N", tension)]
    }

    fn wrong(&self) -> String {
        "where not every case is safe".to_owned()
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        Vec::new()
    }

    fn ending(&self) -> Ending {
        let in_weather = self.in_weather.as_ref().is_some_and(|weather| weather.wrong().is_some());
        let proved = self.proof.as_ref().is_none_or(|proof| proof.verdict() == Verdict::Within);
        let is_wrong = !proved || in_weather || self.broken.iter().any(|case| case.wrong().is_some());
        if is_wrong { Ending::SomethingWrong } else { Ending::Well }
    }
}
