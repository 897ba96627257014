//! Colours of values that range over powers of ten.
//!
//! ```text
//! t(v) = log10 v                        of positive values                            (DC1)
//! t(v) = sign(v) log10(1 + |v| / v0)    of values of both signs, v0 the finest        (DC2)
//! ```

use crate::drawing::axis::extent;
use crate::text::digits;
use std::ops::Range;

/// Ratio of the greatest to the least size from which values range over decades.
const RATIO: f64 = 10.0;
/// Powers of ten that (DC2) shows at most.
const MOST: f64 = 1e4;
/// Part of the sizes below the one from which (DC2) counts decades, where the least value is zero.
const SMALLEST: f64 = 0.05;

/// A scale of decades.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Decades {
    /// v0 of (DC2); `None` for (DC1).
    finest: Option<f64>,
}

impl Decades {
    /// The scale of some values, if they range over decades.
    pub(crate) fn of(values: impl Iterator<Item = f64>) -> Option<Self> {
        let mut values: Vec<f64> = values.collect();
        values.sort_by(f64::total_cmp);
        let (least, greatest) = (*values.first()?, *values.last()?);
        if least > 0.0 {
            return (greatest >= RATIO * least).then_some(Self { finest: None });
        }
        let larger = greatest.max(-least);
        let smaller = if least < 0.0 && greatest > 0.0 {
            greatest.min(-least)
        } else {
            let mut sizes: Vec<f64> =
                values.iter().map(|value| value.abs()).filter(|size| *size > 0.0).collect();
            sizes.sort_by(f64::total_cmp);
            *sizes.get((SMALLEST * sizes.len() as f64) as usize)?
        };
        let finest = (smaller / RATIO).max(larger / MOST).log10().floor();
        (larger >= RATIO * smaller).then(|| Self { finest: Some(10.0_f64.powf(finest)) })
    }

    /// Place of a value on the scale.
    pub(crate) fn place(self, value: f64) -> f64 {
        match self.finest {
            None => value.log10(),
            Some(finest) => value.signum() * (1.0 + value.abs() / finest).log10(),
        }
    }

    /// Places and texts of the ticks of values in a range.
    pub(crate) fn ticks(self, Range { start, end }: Range<f64>) -> Vec<(f64, String)> {
        let places = extent([start, end].into_iter().map(|end| self.place(end)));
        let (span, sizes) = (places.end - places.start, start.abs().max(end.abs()));
        let lowest =
            self.finest.map_or(start.min(end), |finest| if span < 2.0 { finest } else { RATIO * finest });
        let steps: &[u8] =
            if span < 3.0 && (self.finest.is_none() || span < 2.0) { &[1, 2, 5] } else { &[1] };
        let powers = lowest.log10().floor() as i32..=sizes.log10().ceil() as i32;
        // Written and read, no rounding shows.
        let value = |(power, step): (i32, &u8)| format!("{step}e{power}").parse::<f64>().unwrap_or_default();
        let sizes = powers.flat_map(|power| steps.iter().map(move |step| (power, step))).map(value);
        let both = sizes.flat_map(|size| if self.finest.is_some() { vec![size, -size] } else { vec![size] });
        let zero = self.finest.map(|_| 0.0);
        let shown = both.chain(zero).map(|value| (self.place(value), digits(value, 1)));
        let mut ticks: Vec<_> =
            shown.filter(|(place, _)| (places.start..=places.end).contains(place)).collect();
        ticks.sort_by(|one, other| one.0.total_cmp(&other.0));
        ticks
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(scale: Decades, range: Range<f64>) -> Vec<String> {
        scale.ticks(range).into_iter().map(|tick| tick.1.replace('\u{2212}', "-")).collect()
    }

    #[test]
    fn values_within_a_power_of_ten_have_no_decades() {
        for values in [vec![1.0, 9.0], vec![-3.0, 5.0], vec![0.0, 5.0, 9.0], vec![2.0], vec![0.0], vec![]] {
            assert_eq!(Decades::of(values.iter().copied()), None, "{values:?}");
        }
    }

    #[test]
    fn margins_of_both_signs_have_their_zero_and_room_for_the_smaller_side() {
        let scale = Decades::of([-13_861.0, -50.0, 270.0].into_iter()).unwrap();
        assert_eq!(texts(scale, -13_861.0..270.0), ["-10000", "-1000", "-100", "0", "100"]);
        let [low, zero, high] = [-13_861.0, 0.0, 270.0].map(|value| scale.place(value));
        assert_eq!(zero, 0.0);
        assert!((high - zero) / (high - low) > 0.3, "{low} {high}");
        // Rounding does not take the colours.
        let scale = Decades::of([-1000.0, 1e-9].into_iter()).unwrap();
        assert_eq!(texts(scale, -1000.0..1e-9), ["-1000", "-100", "-10", "-1", "0"]);
    }

    #[test]
    fn positive_values_have_logarithms() {
        let scale = Decades::of([266.0, 67_363.0].into_iter()).unwrap();
        assert_eq!(scale.place(1000.0), 3.0);
        let shown = ["500", "1000", "2000", "5000", "10000", "20000", "50000"];
        assert_eq!(texts(scale, 266.0..67_363.0), shown);
        let zeros = (0..200).map(|k| if k < 60 { 0.0 } else { 1e-6 * f64::from(k).powi(4) });
        assert!(Decades::of(zeros).is_some());
    }
}
