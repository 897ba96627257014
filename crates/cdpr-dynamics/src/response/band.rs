//! The largest amplitudes of a platform in a band of frequencies.
//!
//! Without damping `w·H w` grows with the frequency between two natural ones, whatever the wrench w: its size
//! is largest at an end of such an interval. Little damping moves the peaks a little and limits them. Next to
//! a peak 1/a² is nearly a parabola of the frequency, whose lowest point is approached from the natural
//! frequency.

use crate::energy::Number;
use crate::error::{DynamicsError, positive};
use crate::modes::{Modes, Wanted};
use crate::response::{Damping, FrequencyResponse, Response};
use cdpr_statics::{DirectProblem, Equilibrium, Vector3};
use nalgebra::{Complex, Matrix3};

/// An amplitude and its frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// The frequency [Hz].
    pub frequency: f64,
    /// The amplitude [m/N] by a force, [m/m] by a winch.
    pub amplitude: f64,
}

/// The largest amplitudes of a point of the platform in a band of frequencies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LargestInBand {
    /// By a force at the point, of the worst direction [m/N]: the norm of its motions along x, y and z.
    pub per_force: Peak,
    /// By the winch that moves the point most, per length that it takes in [m/m].
    pub per_shortening: Peak,
    /// This winch, from 0.
    pub winch: usize,
}

/// Amplitudes at a natural frequency below this share of the largest one are not looked at more closely.
const RIVAL: f64 = 0.3;

/// Distances, relative to the frequency, at which parabolas are drawn, one after the other.
const STEPS: [f64; 4] = [1e-3, 1e-4, 1e-5, 1e-6];

/// A peak is climbed until the parabola of one that is broader than the distance promises less, relative to
/// 1/a².
const GAIN: f64 = 1e-9;

impl Response {
    /// Largest amplitude of a point by a force there of any direction [m/N]; `lever` from P in the base frame
    /// [m].
    ///
    /// It is the greatest norm of the complex amplitudes along x, y and z over all directions of the force:
    /// infinite where one moves the point along a motion that nothing resists.
    pub fn by_force(&self, lever: &Vector3<f64>) -> f64 {
        worst_amplitude(&self.at_point(lever).0)
    }

    /// The winch, from 0, that moves a point most, and by how much for each length that it takes in [m/m];
    /// `None` without cables.
    pub fn by_winch(&self, lever: &Vector3<f64>) -> Option<(usize, f64)> {
        let (_, motions) = self.at_point(lever);
        let sizes = motions.column_iter().map(|motion| motion.norm()).enumerate();
        sizes.max_by(|one, other| one.1.total_cmp(&other.1))
    }
}

/// The greatest norm of H u over all directions u of a force, by the motion per force H [m/N]; infinite where
/// H is.
pub fn worst_amplitude(per_force: &Matrix3<Complex<f64>>) -> f64 {
    if per_force.iter().any(|entry| entry.re.is_infinite()) {
        return f64::INFINITY;
    }
    WorstDirections::new(per_force).amplitudes[0]
}

/// Directions of a force at a point, the one that moves the point most first.
///
/// A force along the unit vector u moves it by H u. The square of its size, the norm of the complex
/// amplitudes along x, y and z, is
///
/// ```text
/// |H u|² = uᵀ Re(Hᴴ H) u                                                                           (N23)
/// ```
pub(crate) struct WorstDirections {
    /// |H u| [m/N], descending.
    pub(crate) amplitudes: [f64; 3],
    /// The u.
    pub(crate) directions: [Vector3<f64>; 3],
}

impl WorstDirections {
    /// By the motion per force H [m/N].
    pub(crate) fn new(per_force: &Matrix3<Number>) -> Self {
        let (re, im) = (per_force.map(|entry| entry.re), per_force.map(|entry| entry.im));
        let eigen = (re.tr_mul(&re) + im.tr_mul(&im)).symmetric_eigen();
        let mut order = [0, 1, 2];
        order.sort_by(|one, other| eigen.eigenvalues[*other].total_cmp(&eigen.eigenvalues[*one]));
        Self {
            amplitudes: order.map(|k| eigen.eigenvalues[k].max(0.0).sqrt()),
            directions: order.map(|k| eigen.eigenvectors.column(k).into()),
        }
    }
}

impl LargestInBand {
    /// Those between two frequencies [Hz], which may be one, at the equilibrium, of the point `marker` in the
    /// frame of the platform [m].
    ///
    /// # Errors
    /// As [`FrequencyResponse::new`] and [`Modes::new`]; [`DynamicsError::Invalid`] for a band whose ends
    /// descend; [`DynamicsError::Resonance`] where nothing damps and a natural frequency is in it, and for a
    /// band from 0 Hz where a force moves the point along a motion that nothing resists.
    pub fn new(
        problem: &DirectProblem,
        equilibrium: &Equilibrium,
        [from, to]: [f64; 2],
        damping: Damping,
        marker: &Vector3<f64>,
    ) -> Result<Self, DynamicsError> {
        positive("highest frequency", to, "a frequency [Hz] above zero")?;
        if !(0.0..=to).contains(&from) {
            let (value, expected) = (format!("{from:?} Hz"), format!("from 0 to {to} Hz"));
            return Err(DynamicsError::Invalid { field: "lowest frequency", value, expected });
        }
        let response = FrequencyResponse::new(problem, equilibrium, to, damping)?;
        let modes = Modes::new(problem, equilibrium, Wanted::Below(to))?.modes;
        let natural = modes.iter().map(|mode| mode.frequency);
        let natural = natural.filter(|natural| *natural > from && *natural <= to);
        let places: Vec<f64> = [from].into_iter().chain(natural).chain([to]).collect();
        if let ([_, frequency, .., _], true) = (&places[..], damping == Damping::default()) {
            return Err(DynamicsError::Resonance { frequency: *frequency });
        }
        let lever = equilibrium.pose.rotation * marker;
        let found = places.iter().map(|at| response.at(*at)).collect::<Result<Vec<_>, _>>()?;
        if let Some(at) = found.iter().find(|at| at.by_force(&lever).is_infinite()) {
            return Err(DynamicsError::Resonance { frequency: at.frequency });
        }
        let largest = |size: &dyn Fn(&Response) -> f64| {
            let peaks = found.iter().map(|at| Peak { frequency: at.frequency, amplitude: size(at) });
            response.largest(&peaks.collect::<Vec<_>>(), size)
        };
        let per_force = largest(&|at| at.by_force(&lever))?;
        let per_shortening = largest(&|at| at.by_winch(&lever).map_or(0.0, |(_, size)| size))?;
        let winch = response.at(per_shortening.frequency)?.by_winch(&lever).map_or(0, |(winch, _)| winch);
        Ok(Self { per_force, per_shortening, winch })
    }
}

impl FrequencyResponse {
    /// The largest of amplitudes at the ends of a band and at the natural frequencies between, once those
    /// that come near the largest one are climbed.
    fn largest(&self, places: &[Peak], size: &dyn Fn(&Response) -> f64) -> Result<Peak, DynamicsError> {
        let higher = |one: Peak, other: Peak| if other.amplitude > one.amplitude { other } else { one };
        let mut best = places.iter().copied().fold(places[0], higher);
        let rival = RIVAL * best.amplitude;
        for three in places.windows(3).filter(|three| three[1].amplitude >= rival) {
            let limits = [three[0], three[2]].map(|next| 0.5 * (next.frequency + three[1].frequency));
            best = higher(best, self.climb(three[1], limits, size)?);
        }
        Ok(best)
    }

    /// The peak next to a frequency, between two others.
    fn climb(
        &self,
        mut best: Peak,
        [low, high]: [f64; 2],
        size: &dyn Fn(&Response) -> f64,
    ) -> Result<Peak, DynamicsError> {
        for step in STEPS {
            let Peak { frequency, amplitude } = best;
            let step = (step * frequency).min(frequency - low).min(high - frequency);
            if step <= 0.0 || amplitude <= 0.0 {
                break;
            }
            let at = |frequency: f64| -> Result<Peak, DynamicsError> {
                Ok(Peak { frequency, amplitude: size(&self.at(frequency)?) })
            };
            let nearby = [at(frequency - step)?, at(frequency + step)?];
            // Of 1/a², in units of that in the middle.
            let [left, right] = nearby.map(|peak| (amplitude / peak.amplitude).powi(2) - 1.0);
            let gain = 0.125 * (left - right).powi(2) / (left + right);
            if left.min(right) > 0.0 && left.max(right) < 1.0 && gain < GAIN {
                break;
            }
            let vertex = 0.5 * step * (left - right) / (left + right);
            let vertex = (left + right > 0.0).then(|| (frequency + vertex).clamp(low, high));
            let vertex = vertex.filter(|vertex| vertex.is_finite()).map(at).transpose()?;
            for found in nearby.into_iter().chain(vertex) {
                best = if found.amplitude > best.amplitude { found } else { best };
            }
        }
        Ok(best)
    }
}
