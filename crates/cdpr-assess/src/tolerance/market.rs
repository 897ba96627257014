//! What a budget of tolerances can buy: by the prices of a study, or by costs of halving.

use crate::error::AssessError;
use crate::tolerance::Limit;
use crate::tolerance::purchase::{Offers, Way};
use cdpr_study::{PriceSpec, Sampling, StudyError};

/// Offers of tolerances, in the order of their names, and names of the calibrations.
pub(super) struct Market {
    pub(super) offers: Offers,
    pub(super) calibrations: Vec<String>,
    /// Whether the study has prices.
    pub(super) has_prices: bool,
}

/// The entries of an error model that a budget is about.
pub(super) struct Entries<'a> {
    pub(super) names: &'a [String],
    /// Standard deviations as they are.
    pub(super) stds: &'a [f64],
    /// Parts of the variance, zero of the weather.
    pub(super) variances: &'a [f64],
    /// Which of them are numbers of the weather.
    pub(super) weather: &'a [bool],
}

/// What a tolerance costs nothing for: to stay as it is.
const AS_IT_IS: Way = Way { cost: 0.0, power: 0.0, within: [1.0, 1.0], calibration: None, name: None };

impl Market {
    /// The market of a sampling.
    ///
    /// # Errors
    /// [`StudyError::Setting`] for costs next to prices, and costs and prices that no tolerance can have.
    pub(super) fn of(sampling: &Sampling, limit: &Limit, entries: &Entries) -> Result<Self, AssessError> {
        let prices = &sampling.study.file.prices;
        let Entries { names, variances, weather, .. } = entries;
        let bought = || names.iter().zip(*weather).filter(|(_, weather)| !**weather).map(|(name, _)| name);
        if let Some((name, _)) = limit.costs.iter().find(|(name, _)| !bought().any(|of| of == *name)) {
            let expected = format!("one of the tolerances {}", Vec::from_iter(bought().cloned()).join(", "));
            return Err(StudyError::setting("costs", name, expected).into());
        }
        if let (Some((name, cost)), false) = (limit.costs.first(), prices.is_empty()) {
            let expected = "none next to the `prices` of the study, which has the costs";
            return Err(StudyError::setting(format!("costs.{name}"), cost, expected).into());
        }
        let calibrations: Vec<&String> =
            prices.iter().filter(|(_, of)| !of.leaves.is_empty()).map(|(name, _)| name).collect();
        let mut tolerances = Vec::with_capacity(names.len());
        for j in 0..names.len() {
            let ways = match (weather[j], prices.is_empty()) {
                (true, _) => entries.of_weather(j, prices)?,
                (false, true) => {
                    let cost = limit.costs.get(&names[j]).copied().unwrap_or(1.0);
                    vec![Way { cost, power: 1.0, within: [0.0, 1.0], ..AS_IT_IS }]
                }
                (false, false) => entries.ways(j, prices, &calibrations)?,
            };
            tolerances.push((variances[j], ways));
        }
        let costs = calibrations.iter().map(|name| prices[*name].cost.unwrap_or(0.0)).collect();
        Ok(Self {
            offers: Offers { tolerances, calibrations: costs },
            calibrations: calibrations.into_iter().cloned().collect(),
            has_prices: !prices.is_empty(),
        })
    }
}

type Prices = cdpr_study::IndexMap<String, PriceSpec>;

impl Entries<'_> {
    /// Nothing of the weather is for sale.
    fn of_weather(&self, j: usize, prices: &Prices) -> Result<Vec<Way>, StudyError> {
        let name = &self.names[j];
        let named = |(of, price): &(&String, &PriceSpec)| *of == name || price.leaves.contains_key(name);
        match prices.iter().find(named) {
            Some((of, _)) => {
                let expected = "tolerances and calibrations: the weather stays as it is";
                Err(StudyError::setting(format!("prices.{of}"), name, expected))
            }
            None => Ok(vec![AS_IT_IS]),
        }
    }

    /// The ways of a tolerance: as it is, narrower by its price, and by what calibrations leave.
    fn ways(&self, j: usize, prices: &Prices, calibrations: &[&String]) -> Result<Vec<Way>, StudyError> {
        let (name, now) = (&self.names[j], self.stds[j]);
        let share = |field: String, std: f64| match std < now {
            true => Ok(std / now),
            false => {
                let expected = format!("a standard deviation below the one as it is, {now}");
                Err(StudyError::setting(format!("prices.{field}"), std, expected))
            }
        };
        let price = prices.get(name);
        let as_it_is = Way { cost: price.and_then(|of| of.cost).unwrap_or(0.0), ..AS_IT_IS };
        let mut ways = vec![as_it_is];
        if let Some(PriceSpec { cost: Some(cost), power, least, .. }) = price {
            let least = least.map(|least| share(format!("{name}.least"), least)).transpose()?;
            let (power, within) = (power.unwrap_or(1.0), [least.unwrap_or(0.0), 1.0]);
            ways = vec![Way { cost: *cost, power, within, ..AS_IT_IS }];
        }
        for (k, grade) in price.iter().flat_map(|of| &of.grades).enumerate() {
            let share = share(format!("{name}.grades[{k}].std"), grade.std)?;
            let within = [share, share];
            ways.push(Way { cost: grade.cost, within, name: Some("grade"), ..AS_IT_IS });
        }
        for (k, calibration) in calibrations.iter().enumerate() {
            if let Some(std) = prices[*calibration].leaves.get(name) {
                let share = share(format!("{calibration}.leaves.{name}"), *std)?;
                let way = Way { calibration: Some(k), name: Some("calibration"), ..as_it_is };
                ways.push(Way { within: [share, share], ..way });
            }
        }
        Ok(ways)
    }
}
