//! How winches change the lengths of cables.

use std::f64::consts::PI;

/// How a length changes over the duration of a change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Profile {
    /// At constant speed, with jumps of the speed at both ends.
    Linear,
    /// `(1 - cos(π t/T))/2`, with jumps of the acceleration at both ends.
    #[default]
    Cosine,
    /// `10 x³ - 15 x⁴ + 6 x⁵` of `x = t/T`, without jumps of speed and acceleration.
    Polynomial,
}

/// What the winch of one cable does.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Winch {
    ramps: Vec<Ramp>,
    splines: Vec<Spline>,
}

/// A cable that is taken in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ramp {
    /// Begin and duration [s].
    pub(super) from: f64,
    pub(super) over: f64,
    /// Unstrained length [m].
    pub(super) by: f64,
    pub(super) profile: Profile,
}

/// A length that is given at some times: a cubic spline through them, which begins and ends without speed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Spline {
    /// Times [s], ascending, and what is taken in by then [m].
    times: Vec<f64>,
    values: Vec<f64>,
    /// Speeds there [m/s].
    speeds: Vec<f64>,
}

impl Winch {
    /// The length that is in at a time [m] and its rate [m/s].
    pub(super) fn at(&self, time: f64) -> [f64; 2] {
        let ramps = self.ramps.iter().map(|ramp| ramp.at(time));
        let all = ramps.chain(self.splines.iter().map(|spline| spline.at(time)));
        all.fold([0.0; 2], |sum, [by, rate]| [sum[0] + by, sum[1] + rate])
    }

    pub(super) fn ramp(&mut self, ramp: Ramp) {
        self.ramps.push(ramp);
    }

    pub(super) fn follow(&mut self, spline: Spline) {
        self.splines.push(spline);
    }
}

impl Ramp {
    fn at(&self, time: f64) -> [f64; 2] {
        let x = (time - self.from) / self.over;
        if x >= 1.0 {
            return [self.by, 0.0];
        }
        if x < 0.0 {
            return [0.0; 2];
        }
        let [share, slope] = match self.profile {
            Profile::Linear => [x, 1.0],
            Profile::Cosine => [0.5 * (1.0 - (PI * x).cos()), 0.5 * PI * (PI * x).sin()],
            Profile::Polynomial => {
                [x * x * x * (10.0 + x * (6.0 * x - 15.0)), 30.0 * x * x * (1.0 + x * (x - 2.0))]
            }
        };
        [self.by * share, self.by * slope / self.over]
    }
}

impl Spline {
    /// The spline of lengths [m] at ascending times [s], as what is taken in since the first.
    pub(super) fn new(times: Vec<f64>, lengths: impl Iterator<Item = f64>) -> Self {
        let mut values: Vec<f64> = lengths.collect();
        let first = values.first().copied().unwrap_or(0.0);
        values.iter_mut().for_each(|value| *value = first - *value);
        let n = values.len();
        // Continuous accelerations are a tridiagonal system for the speeds inside.
        let (mut speeds, mut above) = (vec![0.0; n], vec![0.0; n]);
        for k in 1..n.saturating_sub(1) {
            let [before, after] = [times[k] - times[k - 1], times[k + 1] - times[k]].map(f64::recip);
            let right = 3.0
                * ((values[k] - values[k - 1]) * before * before
                    + (values[k + 1] - values[k]) * after * after);
            let pivot = 2.0 * (before + after) - before * above[k - 1];
            above[k] = after / pivot;
            speeds[k] = (right - before * speeds[k - 1]) / pivot;
        }
        for k in (1..n.saturating_sub(1)).rev() {
            speeds[k] -= above[k] * speeds[k + 1];
        }
        Self { times, values, speeds }
    }

    fn at(&self, time: f64) -> [f64; 2] {
        let next = self.times.partition_point(|at| *at <= time);
        if next == 0 || next == self.times.len() {
            let at_rest = if next == 0 { self.values.first() } else { self.values.last() };
            return [at_rest.copied().unwrap_or(0.0), 0.0];
        }
        let k = next - 1;
        let h = self.times[next] - self.times[k];
        let x = (time - self.times[k]) / h;
        let rise = self.values[next] - self.values[k];
        // Cubic of Hermite with the excesses of both speeds over the mean one.
        let (p, q) = (h * self.speeds[k] - rise, h * self.speeds[next] - rise);
        let value = self.values[k] + x * (rise + (1.0 - x) * (p * (1.0 - x) - q * x));
        let slope = rise + p * (1.0 - x) * (1.0 - 3.0 * x) - q * x * (2.0 - 3.0 * x);
        [value, slope / h]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spline_passes_its_lengths_with_continuous_speed_and_acceleration() {
        let times = vec![0.0, 0.3, 0.5, 1.1];
        let lengths = [4.0, 3.8, 4.1, 4.2];
        let spline = Spline::new(times.clone(), lengths.into_iter());
        for (time, length) in times.iter().zip(lengths) {
            let (at, [before, after]) = (spline.at(*time), [time - 1e-6, time + 1e-6].map(|t| spline.at(t)));
            assert!((at[0] - (4.0 - length)).abs() < 1e-15, "{time}: {at:?}");
            assert!((before[1] - after[1]).abs() < 1e-4, "{time}: {before:?} {after:?}");
            if (0.1..1.0).contains(time) {
                let [left, right] = [at[1] - before[1], after[1] - at[1]].map(|change| change / 1e-6);
                assert!((left - right).abs() < 1e-2, "{time}: {left} {right}");
            }
        }
        assert_eq!([spline.at(-1.0), spline.at(2.0)], [[0.0, 0.0], [4.0 - 4.2, 0.0]]);
        let difference = (spline.at(0.4 + 1e-6)[0] - spline.at(0.4 - 1e-6)[0]) / 2e-6;
        assert!((difference - spline.at(0.4)[1]).abs() < 1e-8);
    }
}
