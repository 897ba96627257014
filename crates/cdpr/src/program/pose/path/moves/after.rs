//! What swings after a move, in words.

use crate::program::output::print_sentence;
use cdpr_dynamics::moves::{Move, Residual, Shaper};
use cdpr_robot::significant;
use cdpr_statics::limits::cables_in_words;
use serde::Serialize;

/// What swings after a move.
#[derive(Serialize)]
pub(super) struct After {
    /// For how long it is watched.
    watched_s: f64,
    /// Greatest distance of P from its rest.
    amplitude_m: f64,
    /// The same of the move without shaper and feed-forward, and the ratio of both; `null` where the motion
    /// is below `difference_m`.
    unshaped_amplitude_m: f64,
    ratio: Option<f64>,
    /// The same with feed-forward alone, where the move has a shaper, too.
    #[serde(skip_serializing_if = "Option::is_none")]
    feed_forward_amplitude_m: Option<f64>,
    /// Greatest distance from the way, with and without.
    deviation_m: f64,
    unshaped_deviation_m: f64,
    /// Greatest difference to a coarser computation.
    difference_m: f64,
    /// Numbers of the cables that lose their tension, from 1, and of those that do without both.
    slack_cables: Vec<usize>,
    unshaped_slack_cables: Vec<usize>,
    /// Whether the move has a shaper.
    #[serde(skip)]
    is_shaped: bool,
}

/// Whether a move has a shaper.
pub(super) fn is_shaped(planned: &Move) -> bool {
    planned.shaper != Shaper::default()
}

pub(super) fn mm(metres: f64) -> String {
    significant(1e3 * metres, 3)
}

/// That cables lose their tension, behind the beginning of a sentence.
fn losing(cables: &[usize]) -> String {
    let named: Vec<usize> = cables.iter().map(|cable| cable - 1).collect();
    let (lose, their) = if cables.len() == 1 { ("loses", "its") } else { ("lose", "their") };
    format!("{} {lose} {their} tension", cables_in_words(&named))
}

pub(super) fn percent(ratio: f64) -> String {
    significant(100.0 * ratio, 3)
}

impl After {
    /// Of a move, compared with that without shaper and feed-forward, and where it has both with that with
    /// feed-forward alone.
    pub(super) fn new(
        planned: &Move,
        left: &Residual,
        (without, alone): (&Residual, Option<&Residual>),
        watched_s: f64,
    ) -> Self {
        let difference = [left, without].into_iter().chain(alone).map(|of| of.difference).fold(0.0, f64::max);
        // Of a motion below the error of its computation nothing is known but that.
        let ratio = if left.amplitude > difference { left.amplitude / without.amplitude } else { f64::NAN };
        let from_one = |of: &Residual| of.slack.iter().map(|i| i + 1).collect();
        Self {
            watched_s,
            amplitude_m: left.amplitude,
            unshaped_amplitude_m: without.amplitude,
            ratio: ratio.is_finite().then_some(ratio),
            feed_forward_amplitude_m: alone.map(|of| of.amplitude),
            deviation_m: left.deviation,
            unshaped_deviation_m: without.deviation,
            difference_m: difference,
            slack_cables: from_one(left),
            unshaped_slack_cables: from_one(without),
            is_shaped: is_shaped(planned),
        }
    }

    pub(super) fn print(&self, name: &str) {
        let differs = match self.is_known() {
            true => format!(" A coarser computation differs by up to {} mm.", mm(self.difference_m)),
            false => String::new(),
        };
        print_sentence(&format!(
            "{name}: {} On the way it is up to {} mm off, without both {} mm.{differs}",
            self.sentence(),
            mm(self.deviation_m),
            mm(self.unshaped_deviation_m)
        ));
        if let Some(alone) = self.feed_forward_amplitude_m {
            print_sentence(&self.of_feed_forward(alone));
        } else if self.is_worse() {
            print_sentence("The shaper makes it worse: take more seconds, fewer modes or none.");
        }
        if !self.slack_cables.is_empty() {
            print_sentence(&format!("On the way {}.", losing(&self.slack_cables)));
        }
        if !self.unshaped_slack_cables.is_empty() {
            print_sentence(&format!(
                "Without shaper and feed-forward {}.",
                losing(&self.unshaped_slack_cables)
            ));
        }
    }

    /// Whether the motion is larger than the error of its computation.
    fn is_known(&self) -> bool {
        self.amplitude_m > self.difference_m
    }

    /// How much P swings after the move, and without shaper and feed-forward.
    fn sentence(&self) -> String {
        let [swing, without, error] =
            [self.amplitude_m, self.unshaped_amplitude_m, self.difference_m].map(mm);
        let (is_known, is_without_known) = (self.is_known(), self.unshaped_amplitude_m > self.difference_m);
        let swings = match is_known {
            true => format!("by up to {swing} mm"),
            false => format!("by less than {error} mm, the error of the simulation"),
        };
        let of_both = "without shaper and feed-forward";
        let compared = match (self.ratio, is_without_known) {
            (Some(ratio), true) if is_known => {
                format!(", {} % of the {without} mm {of_both}", percent(ratio))
            }
            (_, true) => format!("; {of_both} by up to {without} mm"),
            (_, false) if is_known => format!("; {of_both} by less than {error} mm"),
            (_, false) => format!("; {of_both}, too"),
        };
        format!("in {} s after the move P swings {swings}{compared}.", significant(self.watched_s, 3))
    }

    /// What P does with feed-forward alone, and which of both is better.
    fn of_feed_forward(&self, alone: f64) -> String {
        let swings = match alone > self.difference_m {
            true => format!("by up to {} mm", mm(alone)),
            false => format!("by less than {} mm", mm(self.difference_m)),
        };
        let better = if self.is_worse() {
            "the shaper makes it worse: leave it out, or take more seconds or fewer modes"
        } else if self.amplitude_m + self.difference_m < alone {
            "the shaper makes it less"
        } else {
            "the simulation shows no gain of the shaper"
        };
        format!("With feed-forward alone P swings {swings}: {better}.")
    }

    /// Whether P swings more with a shaper than without it, by more than the computation may be off: a linear
    /// motion at rest, for which it is chosen, does not know slack cables and feed-forward.
    pub(super) fn is_worse(&self) -> bool {
        let without = self
            .feed_forward_amplitude_m
            .map_or(self.unshaped_amplitude_m, |alone| alone.min(self.unshaped_amplitude_m));
        self.is_shaped && self.amplitude_m > without + self.difference_m
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_swing_below_the_error_of_the_simulation_is_said_to_be_less_than_that() {
        let shaped = |amplitude_m: f64, unshaped_amplitude_m: f64| {
            let ratio = (amplitude_m > 1e-4).then_some(amplitude_m / unshaped_amplitude_m);
            After {
                watched_s: 2.0,
                amplitude_m,
                unshaped_amplitude_m,
                ratio,
                feed_forward_amplitude_m: None,
                deviation_m: 0.0,
                unshaped_deviation_m: 0.0,
                difference_m: 1e-4,
                slack_cables: Vec::new(),
                unshaped_slack_cables: Vec::new(),
                is_shaped: true,
            }
        };
        let said = |amplitude_m: f64, unshaped_amplitude_m: f64| {
            let sentence = shaped(amplitude_m, unshaped_amplitude_m).sentence();
            sentence
                .strip_prefix("in 2.00 s after the move P swings by ")
                .map(str::to_owned)
                .unwrap_or(sentence)
        };
        let both = "without shaper and feed-forward";
        let error = "less than 0.100 mm, the error of the simulation";
        assert_eq!(said(2e-4, 8e-4), format!("up to 0.200 mm, 25.0 % of the 0.800 mm {both}."));
        assert_eq!(said(5e-5, 8e-4), format!("{error}; {both} by up to 0.800 mm."));
        assert_eq!(said(5e-5, 6e-5), format!("{error}; {both}, too."));
        assert_eq!(said(2e-4, 5e-5), format!("up to 0.200 mm; {both} by less than 0.100 mm."));
        let with_feed_forward = |alone: f64| {
            let after = After { feed_forward_amplitude_m: Some(alone), ..shaped(1e-3, 2e-3) };
            (after.of_feed_forward(alone), after.is_worse())
        };
        let (worse, is_worse) = with_feed_forward(2e-4);
        assert!(worse.contains("up to 0.200 mm: the shaper makes it worse") && is_worse, "{worse}");
        let (better, is_worse) = with_feed_forward(1.5e-3);
        assert!(better.contains("the shaper makes it less") && !is_worse, "{better}");
        let (same, is_worse) = with_feed_forward(9.5e-4);
        assert!(same.contains("no gain") && !is_worse, "{same}");
        assert_eq!(losing(&[2]), "cable 2 loses its tension");
        assert_eq!(losing(&[1, 2, 3]), "cables 1 to 3 lose their tension");
    }
}
