//! Which natural motions a move excites, and the shaper for them.
//!
//! While the platform accelerates along d by `d u''`, a natural motion x of unit mass and angular frequency ω
//! is pushed by `-xᵀ M d u''`. At the end of the move P swings in it by
//!
//! ```text
//! A = |x_P| |xᵀ M d| U(ω)/ω,      U(ω) = |∫ u''(t) exp(iωt) dt|                                      (N18)
//! ```
//!
//! without damping, and a shaper multiplies it by V of (N14). M is the mass of the platform with the static
//! shapes of its cables.

use super::shaper::{Shaper, ShaperKind};
use super::{Motion, Move};
use crate::error::DynamicsError;
use crate::modes::{Modes, Wanted};
use crate::platform::MovingPlatform;
use crate::response::{Damping, FrequencyResponse};
use crate::simulate::Profile;
use cdpr_robot::Vector6;
use cdpr_statics::{DirectProblem, DirectStart, Equilibrium, inverse};
use nalgebra::Complex;
use std::f64::consts::TAU;

/// A natural motion that a move excites.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excited {
    /// Natural frequency [Hz].
    pub frequency: f64,
    /// Share of critical damping.
    pub damping_ratio: f64,
    /// Share of platform and payload in the kinetic energy.
    pub platform_share: f64,
    /// `|x_P| |xᵀ M d|/ω` of (N18) [m s].
    reach: f64,
}

impl Excited {
    /// Amplitude of P after a move, (N18) [m]: the greatest one for frequencies that are up to 5 % off.
    pub fn amplitude(&self, profile: Profile, seconds: f64, shaper: &Shaper) -> f64 {
        const OFF: [f64; 5] = [0.95, 0.975, 1.0, 1.025, 1.05];
        let own = seconds - shaper.duration();
        let at = |off: f64| {
            let frequency = off * self.frequency;
            let spectrum = spectrum(profile, TAU * frequency * own) / own;
            self.reach * spectrum * shaper.residual(frequency, self.damping_ratio)
        };
        OFF.map(at).into_iter().fold(0.0, f64::max)
    }
}

impl Move<'_> {
    /// The move with a shaper of a kind for the natural motions that swing most at its end, `most` at most,
    /// and these. The cables have the damping `damping` [s], the ratio of their viscous to their elastic
    /// modulus.
    ///
    /// The duration remains: what the shaper takes is taken from the profile, which is then faster. A motion
    /// gets a shaper only as long as this makes the sum of all amplitudes smaller.
    ///
    /// # Errors
    /// As [`Move::plan`] and [`Modes::new`]; those of [`Shaper::new`].
    pub fn shaped(
        &self,
        kind: ShaperKind,
        most: usize,
        damping: f64,
    ) -> Result<(Self, Vec<Excited>), DynamicsError> {
        /// Motions that are tried: those with the greatest amplitudes.
        const TRIED: usize = 12;
        let mut found = self.clone();
        let mut chosen = Vec::new();
        let excited = self.excited(damping)?;
        let left = |shaper: &Shaper| -> f64 {
            excited.iter().map(|one| one.amplitude(self.profile, self.seconds, shaper)).sum()
        };
        let mut least = left(&found.shaper);
        while chosen.len() < most {
            let mut best = None;
            for one in excited.iter().take(TRIED) {
                let shaper = found.shaper.then(&Shaper::new(kind, one.frequency, one.damping_ratio)?);
                if shaper.duration() < self.seconds && left(&shaper) < least {
                    least = left(&shaper);
                    best = Some((*one, shaper));
                }
            }
            let Some((one, shaper)) = best else { break };
            chosen.push(one);
            found.shaper = shaper;
        }
        Ok((found, chosen))
    }

    /// The natural motions at the end of the move, the ones with the greatest amplitudes first.
    ///
    /// # Errors
    /// As [`Move::shaped`].
    pub fn excited(&self, damping: f64) -> Result<Vec<Excited>, DynamicsError> {
        /// Periods in the move beyond which a profile hardly excites a motion.
        const MOST_PERIODS: f64 = 20.0;
        let way = self.check()?;
        let end = way.at([1.0, 1.0, 0.0]);
        let held = inverse(self.robot, &end.pose, &self.load)?;
        let problem = DirectProblem::new(self.robot, &held.lengths, &self.load)?;
        let rest = problem.direct(DirectStart::Near(&held.equilibrium))?.equilibrium;
        let massless = problem.modes(&rest)?;
        let frequencies = || massless.iter().map(|mode| mode.frequency).filter(|frequency| *frequency > 0.0);
        let slowest = frequencies().fold(f64::INFINITY, f64::min);
        let fastest = frequencies().fold(0.0, f64::max);
        if fastest == 0.0 {
            return Ok(Vec::new());
        }
        let bound = (1.2 * fastest).min(MOST_PERIODS / self.seconds).max(1.5 * slowest);
        let found = Modes::new(&problem, &rest, Wanted::Below(bound))?;
        let excited = excited((&problem, &rest, bound), &end, &found, damping)?;
        let amplitude = |one: &Excited| one.amplitude(self.profile, self.seconds, &self.shaper);
        let mut excited: Vec<_> = excited.into_iter().map(|one| (amplitude(&one), one)).collect();
        excited.sort_by(|one, other| other.0.total_cmp(&one.0));
        Ok(excited.into_iter().map(|(_, one)| one).collect())
    }
}

fn excited(
    (problem, rest, bound): (&DirectProblem, &Equilibrium, f64),
    end: &Motion,
    found: &Modes,
    damping: f64,
) -> Result<Vec<Excited>, DynamicsError> {
    let platform = MovingPlatform::new(problem, rest, bound)?;
    let mass = platform.cables.iter().fold(platform.mass, |sum, cable| sum + cable.mass);
    let damped = Damping { stretch: damping, ..Damping::default() };
    let damped = FrequencyResponse::new(problem, rest, bound, damped)?;
    let mut excited = Vec::new();
    for mode in found.modes.iter().filter(|mode| mode.frequency > 0.0) {
        let omega = TAU * mode.frequency;
        let motion = Vector6::from_iterator(mode.translation.iter().chain(&mode.rotation).copied());
        let mut damping_ratio = 0.0;
        if damping > 0.0 {
            // To first order 2 ζ ω² is the imaginary part of the dynamic stiffness.
            let lost = damped.of_cables(mode.frequency)?.0.map(|value| value.im);
            damping_ratio =
                (0.5 * (motion.transpose() * lost * motion)[0] / (omega * omega)).clamp(0.0, 0.99);
        }
        let push = (motion.transpose() * mass * end.velocity)[0];
        let reach = (mode.translation.norm() * push / omega).abs();
        let (frequency, platform_share) = (mode.frequency, mode.platform_share);
        excited.push(Excited { frequency, damping_ratio, platform_share, reach });
    }
    Ok(excited)
}

/// |∫ s'' exp(iφx) dx| of a profile.
fn spectrum(profile: Profile, phase: f64) -> f64 {
    const POINTS: usize = 600;
    let term = |k: usize| {
        let x = (k as f64 + 0.5) / POINTS as f64;
        Complex::from_polar(profile.at(x)[2], phase * x)
    };
    ((0..POINTS).map(term).sum::<Complex<f64>>() / POINTS as f64).norm()
}
