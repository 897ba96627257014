//! The answer of a tolerance budget in words.

use crate::tolerance::{Limited, Reached, ToleranceBudget};
use cdpr_robot::{listing, rounded, significant};
use cdpr_study::{listing_three, little_explained};

impl ToleranceBudget {
    /// Which tolerances to tighten, and what independent robots say of it: one sentence each.
    pub fn sentences(&self) -> Vec<String> {
        let percent = |share: f64| format!("{:.1}", 100.0 * share);
        let of = match self.of {
            Limited::Deflection => "deflection",
            Limited::Position => "position error",
        };
        let (wanted, limit) = (rounded(100.0 * self.quantile, 3), self.limit_mm);
        let reached = |of: &Reached| {
            let [value, low, high] = [of.within.value, of.within.low, of.within.high].map(percent);
            format!("{value} % ({low} to {high})")
        };
        let tightened = self.tolerances.iter().filter(|of| of.factor < 1.0 && of.by != Some("calibration"));
        let tightened =
            Vec::from_iter(tightened.map(|of| format!("{} to {} %", of.name, percent(of.factor))));
        let calibrated = self.calibrations.iter().filter(|of| of.bought);
        let calibrated = Vec::from_iter(calibrated.map(|of| of.name.clone()));
        let mut sentences = if tightened.is_empty() && calibrated.is_empty() {
            vec![
                format!("The tolerances suffice: nothing has to be tightened for {wanted} % of the robots."),
                format!("{} of {} robots have a {of} below {limit} mm.", reached(&self.now), self.now.robots),
            ]
        } else {
            vec![
                self.advice(wanted, &tightened, &calibrated),
                format!(
                    "Then {} of the robots are below it, now {}.",
                    reached(&self.tightened),
                    reached(&self.now)
                ),
            ]
        };
        let last = if tightened.is_empty() && calibrated.is_empty() { &self.now } else { &self.tightened };
        if last.within.high < self.quantile {
            let lower = 2.0 * limit - last.quantile_mm.value;
            let lower = significant(lower, 4);
            sentences.push(format!("That is less than {wanted} %: a limit of {lower} mm leaves a reserve."));
        }
        if let Some(alone) = self.weather_mm {
            let names: Vec<String> =
                self.tolerances.iter().filter(|of| of.weather).map(|of| of.name.clone()).collect();
            let alone = format!(" cannot be bought, and makes {} mm alone.", significant(alone, 4));
            sentences.push(listing("The weather in ", &names, &alone));
        }
        let little = little_explained(self.explained);
        sentences.extend(little.map(|little| format!("{little}: trust the counted robots, not the shares.")));
        sentences
    }

    /// What to do.
    fn advice(&self, wanted: f64, tightened: &[String], calibrated: &[String]) -> String {
        let limit = self.limit_mm;
        if !self.priced {
            let before = format!("For {wanted} % below {limit} mm, tighten the width of ");
            return listing_three(&before, tightened, ".");
        }
        let cost = significant(self.cost[1] - self.cost[0], 4);
        let before = format!("For {wanted} % below {limit} mm spend {cost}: ");
        let mut steps = Vec::from_iter(calibrated.iter().map(|name| format!("do {name}")));
        let tighten = tightened.iter().enumerate();
        steps.extend(tighten.map(|(k, of)| if k == 0 { format!("tighten {of}") } else { of.clone() }));
        listing_three(&before, &steps, ".")
    }
}
