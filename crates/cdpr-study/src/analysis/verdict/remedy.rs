//! What would settle the inputs that a recommendation leaves open.

use crate::analysis::verdict::recommendation::{Basis, Candidate, MATTERS, Said, TotalBounds};
use cdpr_robot::listing;

/// How many times as many points are tried first where few of them decide a bound.
const TRIED: f64 = 4.0;

/// Blocks of Sobol' indices that are tried first.
const BLOCKS: usize = 64;

/// Points from which on an upper bound that still rests on few of them counts as one that more points do not
/// narrow: the squares of the derivatives have a heavy tail.
const HEAVY: usize = 1024;

/// How many times as many observations blocks have to need where points for some inputs are named, too.
const MUCH: usize = 4;

/// Most points or blocks that a remedy names.
const MOST: f64 = (1 << 20) as f64;

impl TotalBounds {
    /// How many times as many as `count` points or blocks put the bounds on one side of [`MATTERS`]; their
    /// distance from the estimates falls with the root of the number. `None` where the estimates are on both
    /// sides, and where more points do not narrow the upper bound.
    fn growth(&self, count: usize) -> Option<f64> {
        if self.at_least <= MATTERS && (self.by_others || (self.few && count >= HEAVY)) {
            return None;
        }
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

/// Inputs that are open.
struct Open<'a> {
    names: Vec<&'a str>,
    bounds: Vec<&'a TotalBounds>,
}

impl Candidate {
    /// How many points or blocks put an input on one side of [`MATTERS`], if any number does.
    fn wanted_by(&self, of: &TotalBounds) -> Option<usize> {
        let wanted = (self.count as f64 * of.growth(self.count)?.max(1.0)).min(2.0 * MOST).ceil() as usize;
        Some(wanted.next_power_of_two()).filter(|count| *count as f64 <= MOST)
    }

    /// How many points or blocks settle some inputs, if any number does.
    fn wanted(&self, open: &Open) -> Option<usize> {
        open.bounds.iter().map(|of| self.wanted_by(of)).collect::<Option<Vec<_>>>()?.into_iter().max()
    }

    /// Observations that settle some inputs, if any number does.
    fn cost(&self, open: &Open) -> Option<usize> {
        Some(self.wanted(open)?.saturating_sub(self.count) * self.observations)
    }

    /// The inputs that are open and of which `is_own` is true for their place and bounds.
    fn open<'a>(&'a self, names: &'a [String], is_own: impl Fn(usize, &TotalBounds) -> bool) -> Open<'a> {
        let Said::Bounds(bounds) = &self.said else { return Open { names: Vec::new(), bounds: Vec::new() } };
        let inputs = names.iter().zip(bounds).enumerate();
        let open = inputs.filter(|(place, (_, of))| of.is_open() && is_own(*place, of));
        let (names, bounds) = open.map(|(_, (name, of))| (name.as_str(), of)).unzip();
        Open { names, bounds }
    }

    /// What settles the inputs that are open.
    pub(crate) fn remedy(&self, names: &[String]) -> Option<String> {
        if let Said::Values(_) = &self.said {
            return (self.basis != Basis::Shapley).then(|| {
                format!(
                    "Bounds need independent inputs and {BLOCKS} `sensitivity.saltelli_blocks` without a \
                     failure."
                )
            });
        }
        self.remedy_of("it", &self.open(names, |_, _| true), names.len())
    }

    /// What settles the inputs that are open: more points for those that derivatives settle, blocks for the
    /// others.
    pub(crate) fn remedy_with(&self, blocks: Option<&Self>, names: &[String]) -> Option<String> {
        let Said::Bounds(bounds) = &self.said else {
            return blocks.and_then(|blocks| blocks.remedy(names)).or_else(|| self.remedy(names));
        };
        if self.basis != Basis::Derivatives {
            return self.remedy(names);
        }
        let is_by_points = |of: &TotalBounds| self.wanted_by(of).is_some();
        let by_points = self.open(names, |_, of| is_by_points(of));
        let others = self.open(names, |_, of| !is_by_points(of));
        let is_other = |place: usize, _: &TotalBounds| !is_by_points(&bounds[place]);
        let by_blocks = |subject: &str| {
            let of_blocks =
                blocks.and_then(|of| of.remedy_of(subject, &of.open(names, is_other), names.len()));
            of_blocks.or_else(|| self.remedy_of(subject, &others, names.len()))
        };
        if others.names.is_empty() {
            return self.remedy(names);
        }
        // Blocks settle all inputs: points for some of them have to be much cheaper.
        let points = self.cost(&by_points);
        let first = BLOCKS * (names.len() + 2);
        let most = blocks.map_or(Some(first), |of| of.cost(&of.open(names, is_other)));
        if by_points.names.is_empty() || points.zip(most).is_some_and(|(points, most)| MUCH * points > most) {
            let of_blocks = blocks.and_then(|of| of.remedy(names));
            return of_blocks.or_else(|| self.remedy_of("it", &others, names.len()));
        }
        let all = |names: &[&str]| listing("", names, "");
        let first = self.remedy_of(&all(&by_points.names), &by_points, names.len())?;
        Some(format!("{first} {}", by_blocks(&all(&others.names))?))
    }

    /// What settles some inputs of all, of which the sentence speaks as `subject`.
    fn remedy_of(&self, subject: &str, open: &Open, inputs: usize) -> Option<String> {
        open.names.first()?;
        let more = |count: usize| count.saturating_sub(self.count) * self.observations;
        Some(match (self.basis, self.wanted(open)) {
            (Basis::Derivatives, Some(count)) => format!(
                "To settle {subject}: about {} more points with derivatives \
                 (`sensitivity.derivative_points`: {count}).",
                more(count)
            ),
            (Basis::Sobol, Some(count)) => format!(
                "To settle {subject}: about {} more observations (`sensitivity.saltelli_blocks`: {count}).",
                more(count)
            ),
            (Basis::Derivatives, None) => format!(
                "To settle {subject}: Sobol' indices, as derivatives alone cannot; {BLOCKS} \
                 `sensitivity.saltelli_blocks` at first, {} observations.",
                BLOCKS * (inputs + 2)
            ),
            (Basis::Expansion, _) => format!(
                "To settle {subject}: more than {} `observations` of the sampling and of `sensitivity`, or \
                 Sobol' indices.",
                self.count
            ),
            _ => {
                let near = open.names.iter().zip(&open.bounds).filter(|(_, of)| self.wanted_by(of).is_none());
                let near: Vec<&str> = near.map(|(name, _)| *name).collect();
                let (subject, object) =
                    if near.len() == 1 { ("The share of ", "it") } else { ("The shares of ", "them") };
                let verb = if near.len() == 1 { "is" } else { "are" };
                let end = format!(" {verb} so near {} % that no study settles {object}.", 100.0 * MATTERS);
                listing(subject, &near, &end)
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::verdict::recommendation::recommend;

    const CERTAIN: [f64; 4] = [0.9, 0.95, 0.95, 0.97];

    fn bounds([low, at_least, at_most, high]: [f64; 4]) -> TotalBounds {
        TotalBounds { low, at_least, at_most, high, few: false, by_others: false }
    }

    fn remedy(candidates: Vec<(Basis, usize, Vec<TotalBounds>)>) -> String {
        let inputs = candidates[0].2.len();
        let names: Vec<String> = (0..inputs).map(|i| format!("x{i}")).collect();
        let candidate = |(basis, count, of)| Candidate {
            basis,
            measure: "measure by ",
            by: String::new(),
            failed: 0,
            count,
            observations: if basis == Basis::Sobol { inputs + 2 } else { 1 },
            said: Said::Bounds(of),
        };
        let candidates = candidates.into_iter().map(candidate).collect();
        recommend(&names, candidates, 0.95).unwrap().remedy.unwrap()
    }

    #[test]
    fn an_input_without_a_bound_by_derivatives_is_settled_by_blocks() {
        // The upper end comes from what the others have and does not fall with the number of points.
        let heavy = TotalBounds { by_others: true, ..bounds([0.0, 0.0, 0.0018, 0.0855]) };
        let near = bounds([0.0098, 0.0108, 0.0109, 0.0120]);
        let alone = remedy(vec![(Basis::Derivatives, 64, vec![bounds(CERTAIN), heavy])]);
        assert!(alone.starts_with("To settle it: Sobol' indices"), "{alone}");
        assert!(alone.contains("256 observations"), "{alone}");
        let both = remedy(vec![(Basis::Derivatives, 64, vec![bounds(CERTAIN), near, heavy])]);
        assert!(both.starts_with("To settle x1: about 64 more points with derivatives"), "{both}");
        assert!(both.contains("To settle x2: Sobol' indices, as derivatives alone cannot"), "{both}");
        // Points for one of two inputs that cost more than the blocks, which settle both.
        let far = bounds([0.0, 0.0101, 0.0102, 0.012]);
        let dear = remedy(vec![(Basis::Derivatives, 8192, vec![bounds(CERTAIN), far, heavy])]);
        assert!(dear.starts_with("To settle it: Sobol' indices"), "{dear}");
        // With blocks, of which more settle both.
        let [mass, density] = [[0.0, 0.0103, 0.0103, 0.026], [0.0, 0.0, 0.0, 0.016]];
        let blocks = vec![bounds(CERTAIN), bounds(mass), bounds(density)];
        let derivatives = (Basis::Derivatives, 64, vec![bounds(CERTAIN), near, heavy]);
        let found = remedy(vec![derivatives, (Basis::Sobol, 128, blocks)]);
        assert!(found.starts_with("To settle x1: about 64 more points with derivatives"), "{found}");
        assert!(found.contains("To settle x2: about 1920 more observations"), "{found}");
        assert!(found.ends_with("(`sensitivity.saltelli_blocks`: 512)."), "{found}");
    }

    #[test]
    fn shares_that_derivatives_bound_have_one_form() {
        let names = ["x0", "x1"].map(str::to_owned);
        let of = vec![bounds([0.944, 0.994, 0.994, 0.994]), bounds([0.0023, 0.0024, 0.0025, 0.0026])];
        let (measure, by) = ("measure by ", String::new());
        let (basis, said) = (Basis::Derivatives, Said::Bounds(of));
        let only = Candidate { basis, measure, by, failed: 0, count: 64, observations: 1, said };
        let found = recommend(&names, vec![only], 0.95).unwrap();
        let cells: Vec<String> = found.inputs.iter().map(|of| found.cell(of)).collect();
        assert_eq!(cells, ["94.4 to 99.4 %", "0.230 to 0.260 %"]);
    }

    #[test]
    fn points_that_stay_few_are_not_multiplied_for_ever() {
        let few = TotalBounds { few: true, ..bounds([0.0, 0.0, 1e-3, 0.2]) };
        let of = |count| remedy(vec![(Basis::Derivatives, count, vec![bounds(CERTAIN), few])]);
        assert!(of(64).contains("`sensitivity.derivative_points`: 256"), "{}", of(64));
        assert!(of(1024).contains("Sobol' indices, as derivatives alone cannot"), "{}", of(1024));
    }

    #[test]
    fn an_input_that_matters_is_settled_by_points_without_a_bound_by_derivatives() {
        let open = TotalBounds { by_others: true, ..bounds([0.0, 0.02, 0.3, 0.4]) };
        let found = remedy(vec![(Basis::Derivatives, 64, vec![bounds(CERTAIN), open])]);
        assert!(found.contains("`sensitivity.derivative_points`: 256"), "{found}");
    }
}
