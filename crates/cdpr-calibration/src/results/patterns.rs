//! Patterns of residuals, which noise does not make: a trend against place or load, means of consecutive rows
//! that do not average out.
//!
//! With the residuals ρ of a column and a coordinate u of their rows, artanh of the correlation r has,
//! without a trend, a standard deviation of nearly `1/sqrt(n - 3)` (Fisher 1921). The mean over m consecutive
//! rows has the variance `σ²/m` if rows do not depend on each other (Allan 1966): the ratio of the two tells
//! drifts and errors of the model that change slowly from pose to pose.
//!
//! Residuals ρ of a length that average to m over n rows have, without a constant error of the length,
//! `m sqrt(n)/s` by Student's law with n - 1 degrees of freedom (s: their standard deviation). Of all cables
//! the means that remain significant by Holm's procedure (1979) are named.
//!
//! What is left of a wrong model is mostly curved, because the parameters take what is straight. Of the n
//! residuals of a column, polynomials of second degree in the place explain the share R². By chance alone
//! `(R²/k)/((1 - R²)/(n - k - 1))` has the law F(k, n - k - 1), with k terms besides the constant.

use crate::campaign::Quantity;
use crate::fitted::{Difference, Fit};
use crate::solve::Svd;
use cdpr_robot::Vector3;
use nalgebra::{DMatrix, DVector};
use serde::Serialize;
use statrs::distribution::{ContinuousCDF, FisherSnedecor, Normal, StudentsT};
use std::collections::BTreeMap;

/// A trend of the residuals of a column.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Trend {
    /// The column.
    pub column: String,
    /// What it follows: `x`, `y`, `z` of the pose, `distance` from the middle of all poses, `payload`, or
    /// `place`, a polynomial of second degree in x, y, z.
    pub against: &'static str,
    /// Correlation, -1 to 1; with a polynomial 0 to 1.
    pub correlation: f64,
    /// Its artanh over the standard deviation of that without a trend; of a polynomial, that of a normal law
    /// with the same probability.
    pub standard_deviations: f64,
}

/// Means of consecutive rows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Split {
    /// Rows in each part.
    pub rows: usize,
    /// Variance of the means of the parts over what independent rows make of it, by sensor: 1 but for chance.
    pub ratio: BTreeMap<&'static str, f64>,
}

/// A trend is named above so many standard deviations.
const CLEAR: f64 = 5.0;

/// Probability that right lengths of any cable are named for their mean residual.
const FALSE_ALARM: f64 = 1e-3;

/// A correlation that leaves nothing.
const ALL: f64 = 1.0 - 1e-12;

/// Rows of a column at least for a trend.
const FEWEST: usize = 8;

/// Rows of a column at least for a polynomial in the place.
const FEWEST_CURVED: usize = 20;

/// The least probability that is told from zero.
const LEAST_PROBABILITY: f64 = 1e-300;

/// Parts at least for the variance of their means.
const FEWEST_PARTS: usize = 4;

impl Fit {
    /// Clear trends of residuals against place and load, the clearest first. The places are those of the
    /// nominal robot: a wrong sensor moves the others.
    pub fn trends(&self) -> Vec<Trend> {
        let poses = &self.poses_before;
        let middle = poses.iter().map(|pose| pose.position).sum::<Vector3<f64>>() / poses.len().max(1) as f64;
        let places = |k: usize| {
            let position = poses[k].position;
            [
                ("x", position.x),
                ("y", position.y),
                ("z", position.z),
                ("distance", (position - middle).norm()),
                ("payload", self.payloads[k]),
            ]
        };
        let mut trends = Vec::new();
        for (column, of) in self.columns() {
            if of.len() < FEWEST {
                continue;
            }
            for index in 0..5 {
                let pairs: Vec<_> =
                    of.iter().map(|of| (places(of.row)[index].1, of.standardized())).collect();
                let correlation = correlation(&pairs);
                let standard_deviations =
                    correlation.clamp(-ALL, ALL).atanh() * (pairs.len() as f64 - 3.0).sqrt();
                if standard_deviations.abs() > CLEAR {
                    let against = places(of[0].row)[index].0;
                    let column = column.clone();
                    trends.push(Trend { column, against, correlation, standard_deviations });
                }
            }
            let offsets: Vec<_> = of.iter().map(|of| poses[of.row].position - middle).collect();
            if let Some((correlation, standard_deviations)) = curved(&of, &offsets)
                && standard_deviations > CLEAR
            {
                trends.push(Trend { column, against: "place", correlation, standard_deviations });
            }
        }
        trends.sort_by(|a, b| b.standard_deviations.abs().total_cmp(&a.standard_deviations.abs()));
        trends
    }

    /// Lengths whose residuals do not average out over the rows, with their means [m], the greatest first.
    pub(super) fn mean_residuals(&self) -> Vec<(Quantity, f64)> {
        let columns = self.columns();
        let lengths = columns.values().filter(|of| matches!(of[0].quantity, Quantity::Length(_)));
        let mut means: Vec<(f64, Quantity, f64)> = lengths.filter_map(|of| mean_residual(of)).collect();
        means.sort_by(|a, b| a.0.total_cmp(&b.0));
        let cables = means.len();
        let significant =
            |(k, of): &(usize, (f64, Quantity, f64))| of.0 * ((cables - k) as f64) < FALSE_ALARM;
        let named = means.into_iter().enumerate().take_while(significant);
        let mut named: Vec<(Quantity, f64)> = named.map(|(_, of)| (of.1, of.2)).collect();
        named.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
        named
    }

    /// Variances of means over 2, 4, 8 ... consecutive rows.
    pub fn splits(&self) -> Vec<Split> {
        let columns = self.columns();
        let most = columns.values().map(Vec::len).max().unwrap_or(0) / FEWEST_PARTS;
        let split = |rows: usize| {
            let mut sums: BTreeMap<&'static str, (f64, f64)> = BTreeMap::new();
            for of in columns.values().filter(|of| of.len() / rows >= FEWEST_PARTS) {
                let values: Vec<f64> = of.iter().map(Difference::standardized).collect();
                let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
                let means: Vec<f64> = values.chunks_exact(rows).map(mean).collect();
                let expected = variance(&values) / rows as f64;
                let sum = sums.entry(of[0].quantity.sensor()).or_default();
                sum.0 += variance(&means);
                sum.1 += expected;
            }
            let ratio = sums.into_iter().filter(|(_, sum)| sum.1 > 0.0);
            Split { rows, ratio: ratio.map(|(sensor, sum)| (sensor, sum.0 / sum.1)).collect() }
        };
        (1..).map(|power| 1 << power).take_while(|rows| *rows <= most).map(split).collect()
    }

    /// The residuals of each column in the order of the rows.
    fn columns(&self) -> BTreeMap<String, Vec<Difference>> {
        let mut columns: BTreeMap<String, Vec<Difference>> = BTreeMap::new();
        for of in &self.after {
            columns.entry(of.quantity.to_string()).or_default().push(*of);
        }
        columns
    }
}

/// The chance of such a mean of the residuals of a length without a constant error, and the mean [m].
fn mean_residual(of: &[Difference]) -> Option<(f64, Quantity, f64)> {
    let values: Vec<f64> = of.iter().map(|of| of.difference).collect();
    let count = values.len() as f64;
    let law = StudentsT::new(0.0, 1.0, count - 1.0).ok()?;
    let mean = values.iter().sum::<f64>() / count;
    let std = (variance(&values) / count).sqrt();
    (std > 0.0).then(|| (2.0 * law.sf((mean / std).abs()), of[0].quantity, mean))
}

/// Multiple correlation of residuals with polynomials of second degree in the place, and how unlikely it is.
fn curved(of: &[Difference], offsets: &[Vector3<f64>]) -> Option<(f64, f64)> {
    if of.len() < FEWEST_CURVED {
        return None;
    }
    let extent = offsets.iter().fold(Vector3::zeros(), |most: Vector3<f64>, offset| most.sup(&offset.abs()));
    let terms = |offset: &Vector3<f64>| {
        let [x, y, z] = [0, 1, 2].map(|k| if extent[k] > 0.0 { offset[k] / extent[k] } else { 0.0 });
        [1.0, x, y, z, x * x, y * y, z * z, x * y, y * z, z * x]
    };
    let terms: Vec<_> = offsets.iter().map(terms).collect();
    let svd = Svd::of(&DMatrix::from_fn(terms.len(), terms[0].len(), |k, j| terms[k][j]));
    let values = DVector::from_iterator(of.len(), of.iter().map(Difference::standardized));
    let rank = svd.values.iter().filter(|value| **value > 1e-6 * svd.values[0]).count();
    let explained = (0..rank).map(|k| svd.left.column(k).dot(&values).powi(2)).sum::<f64>();
    let whole = values.norm_squared() - values.sum().powi(2) / values.len() as f64;
    let left = (values.norm_squared() - explained).max(0.0);
    if rank < 2 || whole <= 0.0 {
        return None;
    }
    let (k, free) = ((rank - 1) as f64, (of.len() - rank) as f64);
    let ratio = ((whole - left).max(0.0) / k) / (left / free).max(f64::MIN_POSITIVE);
    let chance = FisherSnedecor::new(k, free).ok()?.sf(ratio).max(LEAST_PROBABILITY);
    let normal = Normal::standard().inverse_cdf(0.5 * chance);
    Some(((1.0 - left / whole).max(0.0).sqrt(), -normal))
}

fn variance(values: &[f64]) -> f64 {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (count - 1.0)
}

/// Correlation of pairs; zero where one of the two does not vary.
fn correlation(pairs: &[(f64, f64)]) -> f64 {
    let count = pairs.len() as f64;
    let (u, v) = pairs.iter().fold((0.0, 0.0), |sum, pair| (sum.0 + pair.0 / count, sum.1 + pair.1 / count));
    let of = |f: &dyn Fn(f64, f64) -> f64| pairs.iter().map(|pair| f(pair.0 - u, pair.1 - v)).sum::<f64>();
    let product = (of(&|u, _| u * u) * of(&|_, v| v * v)).sqrt();
    if product > 1e-12 * count { of(&|u, v| u * v) / product } else { 0.0 }
}
