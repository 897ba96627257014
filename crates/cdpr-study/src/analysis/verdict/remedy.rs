//! What would settle the inputs that a recommendation leaves open.

use crate::analysis::verdict::recommendation::{Basis, Candidate, MATTERS, Said, TotalBounds};
use cdpr_robot::listing;

/// How many times as many points are tried first where few of them decide a bound.
const TRIED: f64 = 4.0;

/// Blocks of Sobol' indices that are tried first.
const BLOCKS: usize = 64;

/// Most points or blocks that a remedy names.
const MOST: f64 = (1 << 20) as f64;

impl TotalBounds {
    /// How many times as many points or blocks put the bounds on one side of [`MATTERS`]; their
    /// distance from the estimates falls with the root of the number. `None` where the estimates are on both
    /// sides.
    fn growth(&self) -> Option<f64> {
        if self.few {
            return Some(TRIED);
        }
        let times = if self.at_least > MATTERS {
            (self.at_least - self.low) / (self.at_least - MATTERS)
        } else if self.at_most < MATTERS {
            (self.high - self.at_most) / (MATTERS - self.at_most)
        } else {
            return None;
        };
        // An estimate that is near the limit by chance moves away from it as its bounds become narrow.
        let narrow = (self.high - self.low) / MATTERS;
        Some(if narrow > 1.0 { times.min(narrow) } else { times }.powi(2))
    }
}

impl Candidate {
    /// How many points or blocks put an input on one side of [`MATTERS`], if any number does.
    fn wanted_by(&self, of: &TotalBounds) -> Option<usize> {
        let wanted = (self.count as f64 * of.growth()?.max(1.0)).min(2.0 * MOST).ceil() as usize;
        Some(wanted.next_power_of_two()).filter(|count| *count as f64 <= MOST)
    }

    /// How many points or blocks settle the inputs that are open, if any number does.
    pub(crate) fn wanted(&self) -> Option<usize> {
        let Said::Bounds(bounds) = &self.said else { return None };
        let open = bounds.iter().filter(|of| of.is_open());
        open.map(|of| self.wanted_by(of)).collect::<Option<Vec<_>>>()?.into_iter().max()
    }

    /// What settles the inputs that are open.
    pub(crate) fn remedy(&self, names: &[String]) -> Option<String> {
        let Said::Bounds(bounds) = &self.said else {
            return (self.basis != Basis::Shapley).then(|| {
                format!(
                    "Bounds need independent inputs and {BLOCKS} `sensitivity.saltelli_blocks` without a failure."
                )
            });
        };
        let open = || names.iter().zip(bounds).filter(|(_, of)| of.is_open());
        open().next()?;
        let more = |count: usize| count.saturating_sub(self.count) * self.observations;
        Some(match (self.basis, self.wanted()) {
            (Basis::Derivatives, Some(count)) => format!(
                "To settle it: about {} more points with derivatives \
                 (`sensitivity.derivative_points`: {count}).",
                more(count)
            ),
            (Basis::Sobol, Some(count)) => format!(
                "To settle it: about {} more observations (`sensitivity.saltelli_blocks`: {count}).",
                more(count)
            ),
            (Basis::Derivatives, None) => format!(
                "To settle it: Sobol' indices, as derivatives alone cannot; {BLOCKS} \
                 `sensitivity.saltelli_blocks` at first, {} observations.",
                BLOCKS * (names.len() + 2)
            ),
            (Basis::Expansion, _) => format!(
                "To settle it: more than {} `observations` of the sampling and of `sensitivity`, or Sobol' \
                 indices.",
                self.count
            ),
            _ => {
                let near = open().filter(|(_, of)| self.wanted_by(of).is_none());
                let near: Vec<&str> = near.map(|(name, _)| name.as_str()).collect();
                let (subject, object) =
                    if near.len() == 1 { ("The share of ", "it") } else { ("The shares of ", "them") };
                let verb = if near.len() == 1 { "is" } else { "are" };
                let end = format!(" {verb} so near {} % that no study settles {object}.", 100.0 * MATTERS);
                listing(subject, &near, &end)
            }
        })
    }
}
