//! What an error model makes of a deflection.

use crate::program::output::print_sentence;
use cdpr_robot::visible;
use cdpr_statics::{Derivatives, StaticsError};
use cdpr_study::{ErrorModel, little_explained};
use indexmap::IndexMap;
use serde::Serialize;

/// What an error model makes of |dp|, to first order.
#[derive(Serialize)]
pub(super) struct Uncertainty {
    /// Standard deviation of |dp|.
    std_mm: f64,
    /// The share of each cause in its variance, the largest first.
    shares: IndexMap<String, f64>,
    /// Share of the variance that derivatives explain, of robots of the error model.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) explained: Option<f64>,
}

/// Causes that are named.
const NAMED: usize = 5;

/// The least share that is not rounded to 0.0 %.
const LEAST: f64 = 5e-4;

impl Uncertainty {
    pub(super) fn new(model: &ErrorModel, found: &Derivatives) -> Result<Self, StaticsError> {
        let [left, right] =
            [found.magnitude()?, found.right().magnitude()?].map(|slopes| model.variances(&slopes));
        let parts: Vec<f64> = left.iter().zip(&right).map(|(left, right)| 0.5 * (left + right)).collect();
        let variance: f64 = parts.iter().sum();
        let share = |part: f64| if variance > 0.0 { part / variance } else { 0.0 };
        let causes = model.inputs.iter().zip(&parts);
        let mut shares: IndexMap<_, _> =
            causes.map(|(input, part)| (input.name.clone(), share(*part))).collect();
        shares.sort_by(|_, one, _, other| other.total_cmp(one));
        Ok(Self { std_mm: 1e3 * variance.sqrt(), shares, explained: None })
    }

    pub(super) fn print(&self, heading: &str, dp: f64) {
        let named = self.shares.iter().take(NAMED).filter(|(_, share)| **share >= LEAST);
        let named: Vec<_> = named.map(|(name, share)| format!("{name} {:.1} %", 100.0 * share)).collect();
        let (std, named) = (self.std_mm, named.join(", "));
        print_sentence(&format!(
            "{heading}: |dp| = {} mm with a standard deviation of {} mm.",
            visible(dp, 5),
            visible(std, 5)
        ));
        if !named.is_empty() {
            print_sentence(&format!("Shares of the variance: {named}."));
        }
        let little = little_explained(self.explained);
        little.iter().for_each(|little| print_sentence(&format!("{little}: these numbers are rough.")));
    }
}
