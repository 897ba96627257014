//! When readings deviate by more than chance.
//!
//! A sample deviates where a statistic exceeds the quantile of probability `1 - α`. An alarm takes c such
//! samples in a row, which independent samples have with a probability of `αᶜ` at most. With the stated
//! probability p of a false alarm
//!
//! ```text
//! α = p^(1/c)                                                                                     (O5)
//! ```

use statrs::distribution::{ChiSquared, ContinuousCDF, Normal};

/// What the readings say that the model does not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Alarm {
    /// The load has changed by more than the estimate allowed; the observer searches for it again.
    LoadChanged,
    /// Another load explains the readings, and this cable, number from 0, reads no tension although the model
    /// had it taut with the load before: it has become slack, or it is broken and the robot has too few
    /// cables to distinguish these.
    CableSlack(usize),
    /// No plausible load explains the readings, and this cable, number from 0, reads no tension although the
    /// model has it taut: it is broken, slack or off its pulley, or its sensor has failed.
    ///
    /// Of several such cables it is the one with the greatest tension in the model.
    CableLost(usize),
    /// No plausible load explains the readings, and no cable stands out.
    Inconsistent,
}

/// What the readings say about a cable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CableState {
    /// It reads a tension.
    Taut,
    /// It reads no more than noise and its own weight, as the model allows.
    Slack,
    /// It reads no more than that, while the model has it taut and no plausible load explains the readings.
    Lost,
}

/// Quantiles of a sample.
#[derive(Clone)]
pub(crate) struct Thresholds {
    /// Of the chi-square with a degree of freedom for each cable.
    pub(crate) chi_square: f64,
    /// Of a standard normal number.
    pub(crate) normal: f64,
}

impl Thresholds {
    /// Equation (O5).
    pub(crate) fn new(cables: usize, false_alarm: f64, consecutive: usize) -> Self {
        let share = false_alarm.powf(1.0 / consecutive as f64);
        let beyond = |x: f64| ChiSquared::new(cables as f64).map_or(0.0, |law| law.sf(x));
        Self { chi_square: quantile(share, beyond), normal: quantile(share, |x| Normal::standard().sf(x)) }
    }
}

/// The positive number beyond which a law has this probability, by bisection.
fn quantile(share: f64, beyond: impl Fn(f64) -> f64) -> f64 {
    let mut high = 1.0;
    while beyond(high) > share {
        high *= 2.0;
    }
    let mut low = 0.0;
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if beyond(middle) > share { low = middle } else { high = middle }
    }
    high
}

/// Counts samples in a row.
#[derive(Clone, Copy, Default)]
pub(crate) struct Run(usize);

impl Run {
    /// Counts a sample, and says whether it is one of `consecutive` deviating ones in a row.
    pub(crate) fn count(&mut self, deviates: bool, consecutive: usize) -> bool {
        self.0 = if deviates { (self.0 + 1).min(consecutive) } else { 0 };
        self.0 == consecutive
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_tables() {
        // Abramowitz and Stegun 1964, tables 26.8 (8 degrees of freedom, Q = 0.001) and 26.1 (Q = 0.001).
        let thresholds = Thresholds::new(8, 1e-9, 3);
        assert!((thresholds.chi_square - 26.125).abs() < 1e-3, "{}", thresholds.chi_square);
        assert!((thresholds.normal - 3.0902).abs() < 1e-4, "{}", thresholds.normal);
    }
}
