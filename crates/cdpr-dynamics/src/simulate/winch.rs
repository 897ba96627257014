//! How winches take cable in and pay it out.

use crate::error::DynamicsError;
use std::f64::consts::PI;
use std::sync::Arc;

/// How a length, or the way of a platform, changes over the duration of a change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Profile {
    /// At constant speed, with jumps of the speed at both ends.
    Linear,
    /// A third of the time at constant acceleration, a third at constant speed, a third at constant
    /// deceleration.
    Trapezoid,
    /// `(1 - cos(π t/T))/2`, with jumps of the acceleration at both ends.
    #[default]
    Cosine,
    /// `10 x³ - 15 x⁴ + 6 x⁵` of `x = t/T`, without jumps of speed and acceleration.
    Polynomial,
}

impl Profile {
    /// Those without a jump of the speed, with their names.
    pub const SMOOTH: [(&str, Self); 3] =
        [("trapezoid", Self::Trapezoid), ("cosine", Self::Cosine), ("polynomial", Self::Polynomial)];

    /// Share of the change at `x = t/T`, and its first and second derivative with respect to x.
    pub fn at(self, x: f64) -> [f64; 3] {
        if !(0.0..=1.0).contains(&x) {
            return [if x < 0.0 { 0.0 } else { 1.0 }, 0.0, 0.0];
        }
        match self {
            Self::Linear => [x, 1.0, 0.0],
            Self::Trapezoid if x > 0.5 => {
                let [share, slope, curvature] = self.at(1.0 - x);
                [1.0 - share, slope, -curvature]
            }
            Self::Trapezoid if x < 1.0 / 3.0 => [2.25 * x * x, 4.5 * x, 4.5],
            Self::Trapezoid => [0.25 + 1.5 * (x - 1.0 / 3.0), 1.5, 0.0],
            Self::Cosine => {
                let (sine, cosine) = (PI * x).sin_cos();
                [0.5 * (1.0 - cosine), 0.5 * PI * sine, 0.5 * PI * PI * cosine]
            }
            Self::Polynomial => [
                x * x * x * (10.0 + x * (6.0 * x - 15.0)),
                30.0 * x * x * (1.0 + x * (x - 2.0)),
                60.0 * x * (1.0 + x * (2.0 * x - 3.0)),
            ],
        }
    }
}

/// Unstrained lengths over time as a table, between whose rows cubic splines run. The winches rest before the
/// first and after the last row.
#[derive(Clone, Debug, PartialEq)]
pub struct WinchLengths(Arc<Table>);

#[derive(Debug, PartialEq)]
struct Table {
    /// Times [s], ascending from zero.
    times: Vec<f64>,
    /// Of each cable: length [m] and its second derivative [m/s²] at each time.
    cables: Vec<Vec<[f64; 2]>>,
}

impl WinchLengths {
    /// A row of lengths [m], one for each cable, at each time [s]; the first time is the begin.
    ///
    /// # Errors
    /// [`DynamicsError::Invalid`] for fewer than two rows, rows of different lengths, times that do not
    /// ascend, and lengths that are not above zero.
    pub fn new(times: &[f64], rows: &[Vec<f64>]) -> Result<Self, DynamicsError> {
        let wrong = |field, value: String, expected: &str| {
            Err(DynamicsError::Invalid { field, value, expected: expected.to_owned() })
        };
        if times.len() < 2 || rows.len() != times.len() {
            let value = format!("{} rows at {} times", rows.len(), times.len());
            return wrong("lengths over time", value, "a row at each of two times or more");
        }
        let ascends = |k: &usize| times[*k] - times[*k - 1] >= 1e-6;
        if let Some(k) = (1..times.len()).find(|k| !ascends(k)) {
            let value = format!("{:?} s after {:?} s", times[k], times[k - 1]);
            return wrong("time", value, "times that ascend by a microsecond or more");
        }
        let first = &rows[0];
        for row in rows {
            if row.len() != first.len() || !row.iter().all(|length| length.is_finite() && *length > 0.0) {
                let expected = "a length [m] above zero for each cable, as many in each row";
                return wrong("lengths over time", format!("{row:?}"), expected);
            }
        }
        let shifted: Vec<f64> = times.iter().map(|time| time - times[0]).collect();
        let spline = |i: usize| {
            let lengths: Vec<f64> = rows.iter().map(|row| row[i]).collect();
            let bends = bends(&shifted, &lengths);
            lengths.into_iter().zip(bends).map(|(length, bend)| [length, bend]).collect()
        };
        let cables = (0..first.len()).map(spline).collect();
        Ok(Self(Arc::new(Table { times: shifted, cables })))
    }

    /// Number of cables.
    pub fn cables(&self) -> usize {
        self.0.cables.len()
    }

    /// How long the winches move [s].
    pub fn duration(&self) -> f64 {
        self.0.times.last().copied().unwrap_or_default()
    }

    /// The length of a cable [m] at a time since the begin [s], with its rate [m/s] and the rate of that
    /// [m/s²].
    pub fn at(&self, cable: usize, time: f64) -> [f64; 3] {
        let Table { times, cables } = &*self.0;
        let values = &cables[cable];
        let last = times.len() - 1;
        if time <= 0.0 {
            return [values[0][0], 0.0, 0.0];
        }
        if time >= times[last] {
            return [values[last][0], 0.0, 0.0];
        }
        let k = times.partition_point(|knot| *knot <= time).clamp(1, last) - 1;
        let h = times[k + 1] - times[k];
        let (b, a) = ((time - times[k]) / h, (times[k + 1] - time) / h);
        let ([from, bend], [to, next]) = (values[k], values[k + 1]);
        let length = a * from + b * to + ((a * a * a - a) * bend + (b * b * b - b) * next) * h * h / 6.0;
        let rate = (to - from) / h + ((1.0 - 3.0 * a * a) * bend + (3.0 * b * b - 1.0) * next) * h / 6.0;
        [length, rate, a * bend + b * next]
    }

    /// The shortest and the longest length of a cable in the table [m].
    pub(super) fn extremes(&self, cable: usize) -> [f64; 2] {
        let lengths = self.0.cables[cable].iter().map(|[length, _]| *length);
        lengths.fold([f64::INFINITY, 0.0], |[least, most], length| [least.min(length), most.max(length)])
    }
}

/// Second derivatives of the cubic spline through points whose slope is zero at both ends.
fn bends(times: &[f64], values: &[f64]) -> Vec<f64> {
    let last = times.len() - 1;
    let (mut diagonal, mut right, mut above) =
        (vec![0.0; last + 1], vec![0.0; last + 1], vec![0.0; last + 1]);
    for k in 0..last {
        let h = times[k + 1] - times[k];
        let slope = (values[k + 1] - values[k]) / h;
        diagonal[k] += h / 3.0;
        diagonal[k + 1] += h / 3.0;
        above[k] = h / 6.0;
        right[k] += slope;
        right[k + 1] -= slope;
    }
    for k in 1..=last {
        let factor = above[k - 1] / diagonal[k - 1];
        diagonal[k] -= factor * above[k - 1];
        right[k] -= factor * right[k - 1];
    }
    let mut found = vec![0.0; last + 1];
    for k in (0..=last).rev() {
        let next = if k < last { above[k] * found[k + 1] } else { 0.0 };
        found[k] = (right[k] - next) / diagonal[k];
    }
    found
}

/// What a winch does from a time on.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Reeling {
    /// It takes in a length.
    Ramp {
        /// Begin and duration [s].
        from: f64,
        over: f64,
        /// Unstrained length [m].
        by: f64,
        profile: Profile,
    },
    /// It follows the lengths of a cable.
    Table { from: f64, cable: usize, lengths: WinchLengths },
}

impl Reeling {
    /// The length that is in at a time [m] and its rate [m/s].
    pub(super) fn at(&self, time: f64) -> [f64; 2] {
        match self {
            Self::Ramp { from, over, by, profile } => {
                let x = (time - from) / over;
                if x >= 1.0 {
                    return [*by, 0.0];
                }
                let [share, slope, _] = profile.at(x);
                [by * share, by * slope / over]
            }
            Self::Table { from, cable, lengths } => {
                let [length, rate, _] = lengths.at(*cable, time - from);
                [lengths.at(*cable, 0.0)[0] - length, -rate]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn profiles_begin_and_end_and_their_derivatives_are_those_of_differences() {
        use Profile::{Cosine, Linear, Polynomial, Trapezoid};
        for profile in [Linear, Trapezoid, Cosine, Polynomial] {
            assert_eq!([-1.0, 0.0, 2.0].map(|x| profile.at(x)[0]), [0.0, 0.0, 1.0], "{profile:?}");
            assert!((profile.at(1.0)[0] - 1.0).abs() < 1e-15 && (profile.at(0.5)[0] - 0.5).abs() < 1e-15);
            let h = 1e-6;
            for x in [0.05, 0.2, 0.4, 0.55, 0.8, 0.95] {
                let [before, at, after] = [x - h, x, x + h].map(|x| profile.at(x));
                assert!(((after[0] - before[0]) / (2.0 * h) - at[1]).abs() < 1e-8, "{profile:?} at {x}");
                assert!(((after[1] - before[1]) / (2.0 * h) - at[2]).abs() < 1e-6, "{profile:?} at {x}");
            }
        }
    }

    #[test]
    fn a_table_of_lengths_is_a_smooth_curve_through_its_rows() {
        let times: Vec<f64> = (0..=100).map(|k| 3.0 + f64::from(k) / 100.0).collect();
        let length = |x: f64| 5.0 - 2.0 * Profile::Polynomial.at(x)[0];
        let rows: Vec<_> = times.iter().map(|time| vec![7.0, length(time - 3.0)]).collect();
        let table = WinchLengths::new(&times, &rows).unwrap();
        assert!(table.cables() == 2 && (table.duration() - 1.0).abs() < 1e-12);
        for x in [0.013, 0.25, 0.5123, 0.987] {
            let [value, rate, bend] = table.at(1, x);
            let [_, slope, curvature] = Profile::Polynomial.at(x);
            assert!((value - length(x)).abs() < 1e-7, "{x}: {value}");
            assert!((rate + 2.0 * slope).abs() < 1e-4 && (bend + 2.0 * curvature).abs() < 2e-2, "{x}");
            assert!((table.at(0, x)[0] - 7.0).abs() < 1e-12);
        }
        assert_eq!((table.at(1, -1.0), table.at(1, 2.0)), ([5.0, 0.0, 0.0], [3.0, 0.0, 0.0]));
        let refused =
            |times: &[f64], rows: &[Vec<f64>]| WinchLengths::new(times, rows).unwrap_err().to_string();
        assert!(refused(&[0.0], &[vec![1.0]]).contains("two times or more"));
        assert!(refused(&[0.0, 0.0], &[vec![1.0], vec![1.0]]).contains("ascend"));
        assert!(refused(&[0.0, 1.0], &[vec![1.0], vec![1.0, 2.0]]).contains("as many in each row"));
        assert!(refused(&[0.0, 1.0], &[vec![1.0], vec![f64::NAN]]).contains("above zero"));
    }
}
