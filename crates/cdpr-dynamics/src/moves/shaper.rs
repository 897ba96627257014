//! Input shapers: a command that is split over a few times, after which a vibration is gone.
//!
//! A shaper has amplitudes A_i at times t_i whose sum is one. A command u becomes `sum A_i u(t - t_i)`. It
//! leaves of the vibration of a motion with the angular frequency ω and the damping ratio ζ the share
//!
//! ```text
//! V(ω, ζ) = exp(-ζ ω t_n) |sum A_i exp(ζ ω t_i) exp(i ω √(1 - ζ²) t_i)|                            (N14)
//! ```
//!
//! (N. C. Singer, W. P. Seering, *Preshaping command inputs to reduce system vibration*, J. Dyn. Syst. Meas.
//! Control 112, 1990). With `K = exp(-ζ π/√(1 - ζ²))` and half the period between two impulses,
//!
//! ```text
//! ZV   ~ 1, K              V = 0 at ω
//! ZVD  ~ 1, 2 K, K²        V = dV/dω = 0 at ω
//! EI   ~ (1 + v)/4, K (1 - v)/2, K² (1 + v)/4      V = V_e at ω, zero on either side of it         (N15)
//! ```
//!
//! (the last one W. Singhose, W. Seering, N. Singer, *Residual vibration reduction using vector diagrams to
//! generate shaped inputs*, J. Mech. Des. 116, 1994, there without damping; `v = V_e` where nothing is
//! damped).

use crate::error::{DynamicsError, positive};
use std::f64::consts::{PI, TAU};

/// A kind of shaper, from the shortest to the least sensitive one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShaperKind {
    /// No vibration at the frequency: half a period.
    Zv,
    /// Nor a derivative of it: a whole period.
    Zvd,
    /// A vibration of [`ShaperKind::EI_LEVEL`] at the frequency, and a wider range: a whole period.
    Ei,
}

impl ShaperKind {
    /// Share of the vibration that [`ShaperKind::Ei`] leaves at its frequency, V_e of (N15).
    pub const EI_LEVEL: f64 = 0.05;

    /// All kinds with their names.
    pub const NAMED: [(&str, Self); 3] = [("zv", Self::Zv), ("zvd", Self::Zvd), ("ei", Self::Ei)];

    /// Its name: zv, zvd or ei.
    pub fn name(self) -> &'static str {
        match self {
            Self::Zv => "zv",
            Self::Zvd => "zvd",
            Self::Ei => "ei",
        }
    }
}

/// Impulses of an input shaper.
#[derive(Clone, Debug, PartialEq)]
pub struct Shaper {
    /// Time [s], ascending from zero, and amplitude of each; the amplitudes add up to one.
    pub impulses: Vec<[f64; 2]>,
}

impl Default for Shaper {
    /// The one that changes nothing.
    fn default() -> Self {
        Self { impulses: vec![[0.0, 1.0]] }
    }
}

impl Shaper {
    /// The shaper of a kind for a natural frequency [Hz] and a damping ratio, (N15).
    ///
    /// # Errors
    /// [`DynamicsError::Invalid`] for a frequency that is not above zero, and for a damping ratio that is not
    /// between zero and one.
    pub fn new(kind: ShaperKind, frequency: f64, damping_ratio: f64) -> Result<Self, DynamicsError> {
        positive("frequency", frequency, "a natural frequency [Hz] above zero")?;
        if !(0.0..1.0).contains(&damping_ratio) {
            return Err(DynamicsError::Invalid {
                field: "damping ratio",
                value: format!("{damping_ratio:?}"),
                expected: "zero or more and less than one".to_owned(),
            });
        }
        let root = (1.0 - damping_ratio * damping_ratio).sqrt();
        let half = 0.5 / (frequency * root);
        let k = (-damping_ratio * PI / root).exp();
        let amplitudes = match kind {
            ShaperKind::Zv => vec![1.0, k],
            ShaperKind::Zvd => vec![1.0, 2.0 * k, k * k],
            ShaperKind::Ei => {
                // So that V is the level, also with damping.
                let level = ShaperKind::EI_LEVEL;
                let v = level * (1.0 + k).powi(2) / (4.0 * k * k - level * (1.0 - k).powi(2));
                vec![0.25 * (1.0 + v), 0.5 * k * (1.0 - v), 0.25 * k * k * (1.0 + v)]
            }
        };
        let sum: f64 = amplitudes.iter().sum();
        let impulses = amplitudes.iter().enumerate().map(|(i, a)| [i as f64 * half, a / sum]).collect();
        Ok(Self { impulses })
    }

    /// One shaper after the other: it leaves the product of what both leave.
    #[must_use]
    pub fn then(&self, other: &Self) -> Self {
        let both = |[time, a]: &[f64; 2]| {
            let (time, a) = (*time, *a);
            other.impulses.iter().map(move |[later, b]| [time + later, a * b])
        };
        let mut impulses: Vec<[f64; 2]> = self.impulses.iter().flat_map(both).collect();
        impulses.sort_by(|one, other| one[0].total_cmp(&other[0]));
        Self { impulses }
    }

    /// Time of the last impulse [s].
    pub fn duration(&self) -> f64 {
        self.impulses.last().map_or(0.0, |[time, _]| *time)
    }

    /// The share of a vibration that is left, (N14).
    pub fn residual(&self, frequency: f64, damping_ratio: f64) -> f64 {
        let omega = TAU * frequency;
        let damped = omega * (1.0 - damping_ratio * damping_ratio).sqrt();
        let last = self.duration();
        let [mut cosine, mut sine] = [0.0; 2];
        for [time, amplitude] in &self.impulses {
            let grown = amplitude * (damping_ratio * omega * (time - last)).exp();
            let (s, c) = (damped * time).sin_cos();
            cosine += grown * c;
            sine += grown * s;
        }
        cosine.hypot(sine)
    }

    /// Insensitivity of Singer and Seering: the range of frequencies about one [Hz], relative to it, in which
    /// at most the share `level` of a vibration is left; `None` where more is left at the frequency itself.
    pub fn insensitivity(&self, frequency: f64, damping_ratio: f64, level: f64) -> Option<f64> {
        const STEP: f64 = 1e-4;
        const FARTHEST: usize = 20_000;
        let exceeds = |share: f64| self.residual(frequency * share, damping_ratio) > level;
        if exceeds(1.0) {
            return None;
        }
        let side = |sign: f64| (1..FARTHEST).find(|k| exceeds((1.0 + sign * STEP * *k as f64).max(0.0)));
        let side = |sign: f64| side(sign).map_or(f64::INFINITY, |k| STEP * (k - 1) as f64);
        Some(side(-1.0) + side(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ShaperKind::{Ei, Zv, Zvd};

    #[test]
    fn shapers_leave_nothing_or_the_level_at_their_frequency_with_damping_or_without() {
        for damping in [0.0, 0.003, 0.05, 0.3] {
            for (kind, expected) in [(Zv, 0.0), (Zvd, 0.0), (Ei, ShaperKind::EI_LEVEL)] {
                let shaper = Shaper::new(kind, 4.2, damping).unwrap();
                let sum: f64 = shaper.impulses.iter().map(|[_, amplitude]| amplitude).sum();
                let left = shaper.residual(4.2, damping);
                assert!((sum - 1.0).abs() < 1e-14 && (left - expected).abs() < 1e-13, "{kind:?} {left}");
            }
        }
    }

    #[test]
    fn ranges_of_frequency_are_the_published_ones() {
        // Without damping at 5 %: 0.06, 0.29 and 0.40 of the frequency.
        let of = |kind| Shaper::new(kind, 1.0, 0.0).unwrap().insensitivity(1.0, 0.0, 0.05 + 1e-9).unwrap();
        for (kind, expected) in [(Zv, 0.0637), (Zvd, 0.2871), (Ei, 0.3994)] {
            assert!((of(kind) - expected).abs() < 3e-4, "{kind:?} {}", of(kind));
        }
    }

    #[test]
    fn the_residual_is_that_of_a_mass_on_a_spring() {
        // A mass on a spring whose end moves by the impulses: x'' + 2 ζ ω x' + ω² x = ω² u.
        let (frequency, damping) = (2.0, 0.04);
        let omega = TAU * frequency;
        let wrong = 1.15;
        for kind in [Zv, Zvd, Ei] {
            let shaper = Shaper::new(kind, wrong * frequency, damping).unwrap();
            let amplitude = |impulses: &[[f64; 2]]| {
                let end = shaper.duration();
                let damped = omega * (1.0f64 - damping * damping).sqrt();
                let free = |time: f64| (-damping * omega * time).exp() * (damped * time).sin();
                let slope = |time: f64| {
                    (-damping * omega * time).exp() * (damped * time).cos() * damped
                        - damping * omega * free(time)
                };
                let x: f64 = impulses.iter().map(|[time, a]| a * free(end - time)).sum();
                let v: f64 = impulses.iter().map(|[time, a]| a * slope(end - time)).sum();
                x.hypot((v + damping * omega * x) / damped)
            };
            let share = amplitude(&shaper.impulses) / amplitude(&[[shaper.duration(), 1.0]]);
            assert!((share - shaper.residual(frequency, damping)).abs() < 1e-12, "{kind:?}");
        }
    }

    #[test]
    fn shapers_one_after_the_other_leave_the_product() {
        let [one, other] = [4.0, 7.0].map(|frequency| Shaper::new(Zvd, frequency, 0.01).unwrap());
        let both = one.then(&other);
        assert!((both.duration() - one.duration() - other.duration()).abs() < 1e-15);
        for frequency in [1.0, 3.5, 5.0, 8.0] {
            let product = one.residual(frequency, 0.01) * other.residual(frequency, 0.01);
            assert!((both.residual(frequency, 0.01) - product).abs() < 1e-14);
        }
        assert!(Shaper::new(Zv, 0.0, 0.0).is_err() && Shaper::new(Zv, 1.0, 1.0).is_err());
    }
}
