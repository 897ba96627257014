//! Rounds of sampling and buying until the limit is kept: κ of (B2) is that of the last sample.

use crate::error::AssessError;
use crate::tolerance::market::Market;
use crate::tolerance::purchase::Purchase;
use crate::tolerance::{Model, left};
use cdpr_study::StudyError;

/// Rounds at most.
const ROUNDS: usize = 40;
/// The quantile meets the limit within this share of the difference between limit and least error.
const SETTLED: f64 = 1e-3;
/// Shares within which two purchases are the same.
const SAME: f64 = 1e-9;

/// The purchase of the last round, and what it follows from.
pub(super) struct Settled {
    pub(super) bought: Purchase,
    pub(super) rounds: usize,
    /// κ² of (B2) as the tolerances are.
    pub(super) first: f64,
    /// The same at the purchase.
    pub(super) inflation: f64,
    /// The variance that it was to leave [mm²]; `None` where nothing is bought.
    pub(super) aim: Option<f64>,
    /// The error that is not of tolerances [mm]: that without deviations, in weather none.
    pub(super) about: f64,
    /// What the weather adds [mm].
    pub(super) stays: f64,
}

impl Model<'_> {
    /// Buys until the limit is kept.
    pub(super) fn settled(&self, market: &Market, weather_mm: Option<f64>) -> Result<Settled, AssessError> {
        // Equation (B3) is (B2) about zero, with a part of the variance that stays.
        let (about, stays) = weather_mm.map_or((self.least_mm, 0.0), |alone| (0.0, alone));
        let limit = self.limit.limit_mm;
        let room = limit - about - stays;
        let free = vec![None; market.calibrations.len()];
        let unmoved = vec![1.0; self.names.len()];
        let inflation = |quantile: f64, shares: &[f64]| {
            let excess = (quantile - about).max(0.0).powi(2) - stays * stays;
            excess.max(0.0) / left(&self.variances, shares)
        };
        let mut predicted = self.rounded_quantile(&unmoved)?;
        let (first, mut rounds) = (inflation(predicted, &unmoved), 1);
        let as_it_is = self.bought(market, f64::INFINITY, &free)?.ok_or_else(|| {
            self.unreachable("no tolerance has an effect on the error, to first order", predicted)
        })?;
        let (mut bought, mut kept) = (as_it_is, None::<(Purchase, f64, f64)>);
        let (mut most, mut aim) = (first, None);
        let mut seen: Vec<Vec<f64>> = Vec::new();
        loop {
            let now = inflation(predicted, &bought.shares());
            if predicted <= limit && kept.as_ref().is_none_or(|(kept, ..)| bought.cost < kept.cost) {
                kept = Some((bought.clone(), now, aim.unwrap_or(f64::INFINITY)));
            }
            let is_settled = aim.is_none() || (bought.is_free() && predicted >= limit - SETTLED * room);
            if (predicted <= limit && is_settled) || rounds == ROUNDS {
                break;
            }
            most = if predicted <= limit { now } else { now.max(most) };
            // The aim lies below the limit by half of the allowed difference.
            let wanted = ((stays + room * (1.0 - 0.5 * SETTLED)).powi(2) - stays * stays) / most;
            aim = Some(wanted);
            if wanted.is_nan() || wanted <= 0.0 {
                return Err(
                    self.unreachable("no tolerance has an effect on the error, to first order", predicted)
                );
            }
            let Some(next) = self.bought(market, wanted, &free)? else {
                let all = market.offers.narrowest().shares();
                let reached = self.rounded_quantile(&all)?;
                return Err(
                    self.unreachable("the best tolerances and all calibrations do not reach it", reached)
                );
            };
            let shares = next.shares();
            let is_same = |of: &Vec<f64>| of.iter().zip(&shares).all(|(a, b)| (a - b).abs() <= SAME * b);
            if kept.is_some() && seen.iter().any(is_same) {
                break;
            }
            predicted = self.rounded_quantile(&shares)?;
            seen.push(shares);
            bought = next;
            rounds += 1;
        }
        let (bought, inflation, aim) =
            kept.ok_or_else(|| self.unreachable("the quantile does not settle", predicted))?;
        let aim = aim.is_finite().then_some(aim);
        Ok(Settled { bought, rounds, first, inflation, aim, about, stays })
    }

    /// The cheapest purchase for a variance.
    pub(super) fn bought(
        &self,
        market: &Market,
        aim: f64,
        decided: &[Option<bool>],
    ) -> Result<Option<Purchase>, AssessError> {
        market.offers.cheapest(aim, decided).map_err(|bounds| {
            let expected = "fewer grades and calibrations, of which the cheapest choice can be proven";
            StudyError::setting("prices", format!("open after {bounds} bounds"), expected).into()
        })
    }
}
