//! The cheapest purchase of tolerances and calibrations that leaves a variance.
//!
//! Tolerance j causes the part `v_j` of the variance at its width, and `v_j s_j²` at the share `s_j` of it.
//! It is on offer in several ways o, a grade being one with `l = h`, some of which need a calibration to be
//! bought:
//!
//! ```text
//! cost_o(s) = c_o / s^k_o,   l_o <= s <= h_o                                                   (B4)
//! min  sum cost_o(s_j) + costs of the calibrations    subject to    sum v_j s_j² <= V         (B5)
//! ```
//!
//! With a price μ of the variance, each tolerance is bought for itself:
//!
//! ```text
//! s = (k c / (2 μ v))^(1/(k+2)) within l and h, of the way o with the least cost_o(s) + μ v s²      (B6)
//! g(μ) = sum of these least values + costs of the calibrations that are bought - μ V                (B7)
//! ```
//!
//! g(μ) is a lower bound of (B5) for any μ (weak duality). It is concave, and its greatest value is where
//! the variance of (B6) passes V. Where every tolerance has one way, (B5) is convex in ln s, and the bound
//! is reached. Otherwise ways and calibrations are chosen one by one, and a choice is left where its bound
//! is not below the cost of the best purchase: what is found is proven to be the cheapest.

/// A way in which a tolerance can be bought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Way {
    /// c and k of (B4).
    pub(super) cost: f64,
    pub(super) power: f64,
    /// l and h of (B4).
    pub(super) within: [f64; 2],
    /// The calibration that has to be bought.
    pub(super) calibration: Option<usize>,
    /// What it is called in an answer: "grade", "calibration", or nothing.
    pub(super) name: Option<&'static str>,
}

/// What is on offer.
#[derive(Clone, Debug, Default)]
pub(super) struct Offers {
    /// Part of the variance and ways of each tolerance.
    pub(super) tolerances: Vec<(f64, Vec<Way>)>,
    /// Costs of the calibrations.
    pub(super) calibrations: Vec<f64>,
}

/// What is bought.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Purchase {
    /// Way and share of each tolerance.
    pub(super) tolerances: Vec<(Way, f64)>,
    /// Which calibrations.
    pub(super) calibrations: Vec<bool>,
    /// Of all together.
    pub(super) cost: f64,
}

/// Choices that are bounded before a search is given up.
const MOST_BOUNDS: usize = 50_000;
/// Rounding of the last term of (B7), relative.
const ROUNDING: f64 = 1e-12;
/// A choice is left where its bound is not below the best cost by more than this share of it.
const PROVEN: f64 = 1e-9;

impl Way {
    /// (B4).
    pub(super) fn cost_at(&self, share: f64) -> f64 {
        self.cost * share.powf(-self.power)
    }

    /// By how much the variance falls for a further unit of the cost; `None` of a fixed share.
    pub(super) fn variance_per_cost(&self, share: f64, variance: f64) -> Option<f64> {
        let is_wide = self.within[0] < self.within[1];
        is_wide.then(|| 2.0 * variance * share.powf(self.power + 2.0) / (self.power * self.cost))
    }

    /// (B6) for a part v of the variance; also the value that it makes least.
    fn at(&self, price: f64, variance: f64) -> (f64, f64) {
        let [low, high] = self.within;
        let free = (self.power * self.cost / (2.0 * price * variance)).powf(1.0 / (self.power + 2.0));
        let share = if low < high { free.max(low).min(high) } else { high };
        (share, self.cost_at(share) + price * variance * share * share)
    }
}

impl Purchase {
    /// The variance that it leaves.
    fn variance(&self, offers: &Offers) -> f64 {
        let part = |((_, share), (v, _)): (&(Way, f64), &(f64, Vec<Way>))| v * share * share;
        self.tolerances.iter().zip(&offers.tolerances).map(part).sum()
    }

    /// Whether a tolerance is within the bounds of its offer.
    pub(super) fn is_free(&self) -> bool {
        self.tolerances.iter().any(|(way, share)| way.within[0] < *share && *share < way.within[1])
    }

    /// The shares of all tolerances.
    pub(super) fn shares(&self) -> Vec<f64> {
        self.tolerances.iter().map(|(_, share)| *share).collect()
    }
}

impl Offers {
    /// Buys at a price of the variance: (B6) and (B7) without its last term. Calibrations that are not
    /// decided cost the bound nothing, and the purchase what they cost where they are used.
    fn at(&self, price: f64, decided: &[Option<bool>]) -> (Purchase, f64) {
        let mut bound: f64 = self.calibrations.iter().zip(decided).map(|(c, d)| paid(*c, *d)).sum();
        let mut calibrations: Vec<bool> = decided.iter().map(|decided| *decided == Some(true)).collect();
        let mut tolerances = Vec::with_capacity(self.tolerances.len());
        for (variance, ways) in &self.tolerances {
            let allowed = |way: &&Way| way.calibration.is_none_or(|k| decided[k] != Some(false));
            let each = ways.iter().filter(allowed).map(|way| (way, way.at(price, *variance)));
            let Some((way, (share, value))) = each.min_by(|a, b| a.1.1.total_cmp(&b.1.1)) else { continue };
            bound += value;
            way.calibration.iter().for_each(|k| calibrations[*k] = true);
            tolerances.push((*way, share));
        }
        let of_tolerances: f64 = tolerances.iter().map(|(way, share)| way.cost_at(*share)).sum();
        let of_calibrations: f64 =
            self.calibrations.iter().zip(&calibrations).filter(|(_, bought)| **bought).map(|(c, _)| c).sum();
        (Purchase { tolerances, calibrations, cost: of_tolerances + of_calibrations }, bound)
    }

    /// The narrowest of all tolerances, with all calibrations.
    pub(super) fn narrowest(&self) -> Purchase {
        self.at(1e100, &vec![None; self.calibrations.len()]).0
    }

    /// The greatest value of (B7), and a purchase that leaves the variance; `None` where none does.
    fn bound(&self, target: f64, decided: &[Option<bool>]) -> Option<(f64, Purchase)> {
        let free = self.at(0.0, decided);
        if free.0.variance(self) <= target {
            return Some((free.1, free.0));
        }
        let (mut low, mut high) = (-300.0_f64, 300.0_f64);
        let mut kept = self.at(high.exp(), decided).0;
        if kept.variance(self) > target {
            return None;
        }
        let mut best = f64::NEG_INFINITY;
        while high - low > 1e-14 * (1.0 + high.abs()) {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            let (bought, bound) = self.at(middle.exp(), decided);
            best = best.max(bound - middle.exp() * target * (1.0 + ROUNDING));
            if bought.variance(self) <= target {
                (high, kept) = (middle, bought);
            } else {
                low = middle;
            }
        }
        Some((best, kept))
    }

    /// The cheapest purchase that leaves at most a variance, with calibrations that are decided; `None`
    /// where none does.
    ///
    /// # Errors
    /// The number of choices that were bounded, where these did not end.
    pub(super) fn cheapest(&self, target: f64, decided: &[Option<bool>]) -> Result<Option<Purchase>, usize> {
        let mut best: Option<Purchase> = None;
        let mut open = vec![(self.clone(), decided.to_vec())];
        let mut bounds = 0;
        while let Some((offers, decided)) = open.pop() {
            bounds += 1;
            if bounds > MOST_BOUNDS {
                return Err(MOST_BOUNDS);
            }
            let Some((bound, kept)) = offers.bound(target, &decided) else { continue };
            if best.as_ref().is_none_or(|best| kept.cost < best.cost) {
                best = Some(kept.clone());
            }
            if best.as_ref().is_some_and(|best| bound >= best.cost - PROVEN * best.cost.abs()) {
                continue;
            }
            open.extend(offers.divided(&decided, &kept));
        }
        Ok(best)
    }

    /// The same choices in two or more parts, that of the purchase last; none where there is no choice.
    fn divided(&self, decided: &[Option<bool>], kept: &Purchase) -> Vec<(Self, Vec<Option<bool>>)> {
        if let Some(k) = decided.iter().position(Option::is_none) {
            let part = |bought: bool| {
                let mut decided = decided.to_vec();
                decided[k] = Some(bought);
                (self.clone(), decided)
            };
            return vec![part(!kept.calibrations[k]), part(kept.calibrations[k])];
        }
        let allowed = |way: &Way| way.calibration.is_none_or(|k| decided[k] != Some(false));
        let several = |(_, ways): &(f64, Vec<Way>)| ways.iter().filter(|way| allowed(way)).count() > 1;
        let Some(j) = self.tolerances.iter().position(several) else { return Vec::new() };
        let part = |way: &Way| {
            let mut offers = self.clone();
            offers.tolerances[j].1 = vec![*way];
            (offers, decided.to_vec())
        };
        let (first, _) = kept.tolerances[j];
        let others = self.tolerances[j].1.iter().filter(|way| allowed(way) && **way != first);
        others.chain([&first]).map(part).collect()
    }
}

/// What a calibration adds to the bound.
fn paid(cost: f64, decided: Option<bool>) -> f64 {
    if decided == Some(true) { cost } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FREE: Way = Way { cost: 1.0, power: 1.0, within: [0.0, 1.0], calibration: None, name: None };

    fn grades(of: &[[f64; 2]]) -> Vec<Way> {
        let way = |[share, cost]: &[f64; 2]| Way { cost: *cost, power: 0.0, within: [*share; 2], ..FREE };
        of.iter().map(way).collect()
    }

    fn buy(offers: &Offers, target: f64) -> Option<Purchase> {
        offers.cheapest(target, &vec![None; offers.calibrations.len()]).unwrap()
    }

    #[test]
    fn costs_over_widths_are_least_where_the_closed_form_says() {
        // sum c_i / s_i with sum v_i s_i² = V: s_i in proportion to (c_i / v_i)^(1/3).
        let (v, c) = ([4.0, 1.0, 9.0], [2.0, 1.0, 30.0]);
        let tolerances = v.iter().zip(c).map(|(v, cost)| (*v, vec![Way { cost, ..FREE }])).collect();
        let found = buy(&Offers { tolerances, calibrations: Vec::new() }, 0.5).unwrap();
        let weights: Vec<f64> = v.iter().zip(c).map(|(v, c)| (c / v).cbrt()).collect();
        let scale = (0.5 / v.iter().zip(&weights).map(|(v, w)| v * w * w).sum::<f64>()).sqrt();
        for (share, weight) in found.shares().iter().zip(weights) {
            assert!((share / (scale * weight) - 1.0).abs() < 1e-10, "{share}");
        }
        assert_eq!(found.shares().len(), 3);
    }

    #[test]
    fn powers_and_least_widths_meet_the_conditions_of_the_optimum() {
        let way = |cost, power, low| vec![Way { cost, power, within: [low, 1.0], ..FREE }];
        let v = [1.0, 2.0, 3.0, 1e-3];
        let ways = [way(1.0, 2.0, 0.0), way(5.0, 0.5, 0.0), way(0.1, 1.0, 0.6), way(3.0, 1.0, 0.0)];
        let offers = Offers { tolerances: v.into_iter().zip(ways).collect(), calibrations: Vec::new() };
        let found = buy(&offers, 2.5).unwrap();
        assert!((found.variance(&offers) - 2.5).abs() < 1e-12);
        let rate = |j: usize| {
            let (way, share) = found.tolerances[j];
            way.variance_per_cost(share, v[j]).unwrap()
        };
        let shares = found.shares();
        assert!((rate(0) / rate(1) - 1.0).abs() < 1e-9 && shares[2] == 0.6 && shares[3] == 1.0, "{shares:?}");
        // On its least width more would buy much, as it is little.
        assert!(rate(2) > rate(0) && rate(3) < rate(0));
        // The least width of the third leaves 3 · 0.36.
        assert!(buy(&offers, 1.09).is_some() && buy(&offers, 1.07).is_none());
    }

    #[test]
    fn grades_and_calibrations_are_the_cheapest_of_all_choices() {
        let mut number = 1_u64;
        let mut next = || {
            number = number.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (number >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut reached = 0;
        for round in 0..300 {
            let calibrations = vec![0.5 + 2.0 * next(), 0.5 + 3.0 * next()];
            let tolerances: Vec<_> = (0..5)
                .map(|_| {
                    let (first, second) = (0.4 + 0.5 * next(), 0.4 * next());
                    let mut ways = grades(&[[1.0, 0.0], [first, next()], [second, 1.0 + 2.0 * next()]]);
                    let calibration = if next() < 0.4 { Some(usize::from(next() < 0.5)) } else { None };
                    let left = Way { within: [0.3 * next(); 2], ..ways[0] };
                    ways.extend(calibration.map(|k| Way { calibration: Some(k), ..left }));
                    (next(), ways)
                })
                .collect();
            let offers = Offers { tolerances, calibrations };
            let target = 2.5 * next();
            let mut least = f64::INFINITY;
            for code in 0..4_usize.pow(5) {
                let ways: Option<Vec<Way>> = (0..5)
                    .map(|j| offers.tolerances[j].1.get(code / 4_usize.pow(j as u32) % 4).copied())
                    .collect();
                let Some(ways) = ways else { continue };
                let part = |(way, (v, _)): (&Way, &(f64, Vec<Way>))| v * way.within[0].powi(2);
                if ways.iter().zip(&offers.tolerances).map(part).sum::<f64>() <= target {
                    let used = |k: usize| ways.iter().any(|way| way.calibration == Some(k));
                    let of_calibrations = (0..2).filter(|k| used(*k)).map(|k| offers.calibrations[k]);
                    let cost = ways.iter().map(|way| way.cost).chain(of_calibrations).sum::<f64>();
                    least = least.min(cost);
                }
            }
            match buy(&offers, target) {
                None => assert!(least.is_infinite(), "{round}: {least}"),
                Some(found) => {
                    reached += 1;
                    assert!((found.cost - least).abs() < 1e-9, "{round}: {} {least}", found.cost);
                }
            }
        }
        assert!(reached > 100, "{reached}");
    }
}
