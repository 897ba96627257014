//! How platform and cables answer to forces and winches that vibrate.
//!
//! A force `f sin ωt` on the platform, or a winch that takes in `δ sin ωt`, moves the platform by
//!
//! ```text
//! v = H (f - sum Jᵀ F_i δ_i),      H = D⁻¹,      J = [ 1, -[s_i] ]                                 (N12)
//! ```
//!
//! with the dynamic stiffness D of the platform and the force F_i on the held end of cable i by its winch.
//! Where the cable begins, the winch moves it by `-(1 + ε) t` for each metre. With damping
//!
//! ```text
//! A = EA (1 + i ω τ) t tᵀ + (1 - t tᵀ) N/(1 + ε),      -ω² μ  becomes  -ω² μ + i ω μ c             (N13)
//! ```
//!
//! (Kelvin and Voigt's in the stretch of the cable, and a drag of air along its motion), all is complex:
//! amplitude and phase. The cables are the polynomials of (N3), of which only the ends are kept at every
//! frequency. They say how D and F differ from those of slow motions, which the static models know:
//!
//! ```text
//! D = K - ω² M + sum J_iᵀ (A_i(ω) - A_i(0)) J_i,      F_i = F_i(0) + (those of the polynomials)    (N21)
//! ```
//!
//! with the whole K, which a moment makes unsymmetric, and the dynamic stiffness A_i of the end of a cable. A
//! wheel with a tilted axis couples motions in the plane of its cable with those across it.
//! A motion n with `K n = 0` has no bound at 0 Hz. All others are those of low frequencies there:
//!
//! ```text
//! [ K     M n ] [ v ]   [ f ]
//! [ nᵀ M   0  ] [ λ ] = [ 0 ]                                                                      (N22)
//! ```

pub(crate) mod band;
pub(crate) mod point;
pub(crate) mod shaken;

use crate::energy::{Number, Vector, Vibrating, real};
use crate::error::{DynamicsError, positive};
use crate::response::shaken::{ShakenCable, StiffnessAndPull};
use cdpr_statics::vibration::{CableAtRest, SmallMotions};
use cdpr_statics::{DMatrix, DirectProblem, Equilibrium, Matrix6, Vector3, stiffness};
use nalgebra::{Complex, Matrix3, Matrix3xX, Matrix6xX, Vector6};
use std::f64::consts::TAU;

pub use shaken::Damping;

/// Dynamic stiffness of all cables at the platform, and the pulls of their winches.
type CablesAndPulls = (Matrix6<Complex<f64>>, Matrix6xX<Complex<f64>>);

/// A platform on cables with mass that is shaken.
#[derive(Clone, Debug)]
pub struct FrequencyResponse {
    damping: Damping,
    highest: f64,
    mass: Matrix6<f64>,
    /// Without what the ends of the cables resist with.
    stiffness: Matrix6<f64>,
    free: Vec<usize>,
    cables: Vec<Option<ShakenCable>>,
    /// Motions that nothing resists, `|translation|² + ℓ² |rotation|² = 1`.
    neutral: Vec<Vector6<f64>>,
}

/// The answer at a frequency. Motions are complex amplitudes of (dp, dφ) about P in the base frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// The frequency [Hz].
    pub frequency: f64,
    /// Motion per wrench about P, H of (N12) [m/N, rad/N, m/(N m), rad/(N m)]; without those of `neutral`.
    pub per_wrench: Matrix6<Complex<f64>>,
    /// Motion per length that each winch takes in, 6 x n [m/m, rad/m].
    pub per_shortening: Matrix6xX<Complex<f64>>,
    /// At 0 Hz the motions (dp, dφ) that nothing resists, `|translation|² + ℓ² |rotation|² = 1`; none
    /// elsewhere.
    pub neutral: Vec<Vector6<f64>>,
}

impl Response {
    /// Translation of a point of the platform per force there [m/N], and per length that each winch takes in,
    /// 3 x n; `lever` from P in the base frame [m].
    ///
    /// Infinite where a force moves the point along a motion that nothing resists.
    pub fn at_point(&self, lever: &Vector3<f64>) -> (Matrix3<Complex<f64>>, Matrix3xX<Complex<f64>>) {
        let (mut per_force, per_shortening) = self.resisted_at_point(lever);
        for n in &self.neutral {
            let moved = n.fixed_rows::<3>(0) + n.fixed_rows::<3>(3).cross(lever);
            for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
                if moved[i].abs() > UNMOVED && moved[j].abs() > UNMOVED {
                    per_force[(i, j)] = real(f64::INFINITY);
                }
            }
        }
        (per_force, per_shortening)
    }

    /// The same without the motions that nothing resists.
    pub fn resisted_at_point(
        &self,
        lever: &Vector3<f64>,
    ) -> (Matrix3<Complex<f64>>, Matrix3xX<Complex<f64>>) {
        let mut motion = nalgebra::Matrix3x6::<Complex<f64>>::zeros();
        motion.fixed_view_mut::<3, 3>(0, 0).copy_from(&Matrix3::identity().map(real));
        motion.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-lever.cross_matrix()).map(real));
        (motion * self.per_wrench * motion.transpose(), motion * &self.per_shortening)
    }
}

/// Part of a motion of `|translation|² + ℓ² |rotation|² = 1` below which a point does not move.
const UNMOVED: f64 = 1e-7;

impl FrequencyResponse {
    /// For frequencies up to `highest` [Hz].
    ///
    /// # Errors
    /// As [`crate::MovingPlatform::new`]; [`DynamicsError::Invalid`] for damping that is negative or not
    /// finite.
    pub fn new(
        problem: &DirectProblem,
        equilibrium: &Equilibrium,
        highest: f64,
        damping: Damping,
    ) -> Result<Self, DynamicsError> {
        positive("highest frequency", highest, "a frequency [Hz] above zero")?;
        for (field, value, unit) in [("damping", damping.stretch, "s"), ("drag", damping.drag, "1/s")] {
            if !(value.is_finite() && value >= 0.0) {
                let expected = format!("zero or more [{unit}]");
                return Err(DynamicsError::Invalid { field, value: format!("{value:?}"), expected });
            }
        }
        let SmallMotions { mass, cables, free, .. } = problem.small_motions(equilibrium)?;
        let shaken = |(i, cable): (usize, &CableAtRest)| {
            // A cable without mass and force resists nothing.
            let is_shapeless = cable.linear_density == 0.0 && cable.catenary.is_slack_and_weightless();
            (!is_shapeless).then(|| ShakenCable::new(i, cable, highest)).transpose()
        };
        let cables = cables.iter().enumerate().map(shaken).collect::<Result<Vec<_>, _>>()?;
        // (N21)
        let mut stiffness = *problem.linearize(equilibrium)?.stiffness();
        for cable in cables.iter().flatten() {
            stiffness -= on_platform(&cable.lever, &cable.still);
        }
        let along = |mode: &stiffness::Mode| {
            Vector6::from_iterator(mode.translation.iter().chain(&mode.rotation).copied())
        };
        let neutral = problem.stability(equilibrium)?.neutral().iter().map(along).collect();
        Ok(Self { damping, highest, mass, stiffness, free, cables, neutral })
    }

    /// The answer at a frequency [Hz].
    ///
    /// # Errors
    /// [`DynamicsError::Invalid`] for one that is not between zero and the highest;
    /// [`DynamicsError::Resonance`] where nothing damps and the frequency is a natural one.
    pub fn at(&self, frequency: f64) -> Result<Response, DynamicsError> {
        if !(frequency.is_finite() && (0.0..=self.highest).contains(&frequency)) {
            let expected = format!("from 0 to {} Hz", self.highest);
            return Err(DynamicsError::Invalid {
                field: "frequency",
                value: format!("{frequency:?} Hz"),
                expected,
            });
        }
        let resonance = || DynamicsError::Resonance { frequency };
        let omega = TAU * frequency;
        let (cables, pulls) = self.of_cables(frequency)?;
        let dynamic = (self.stiffness - self.mass * (omega * omega)).map(real) + cables;
        let free = &self.free;
        let neutral = if frequency == 0.0 { &self.neutral[..] } else { &[] };
        let (n, size) = (free.len(), free.len() + neutral.len());
        let held: Vec<_> = neutral.iter().map(|motion| self.whole_mass() * motion).collect();
        // (N22)
        let block = DMatrix::from_fn(size, size, |i, j| match (i < n, j < n) {
            (true, true) => dynamic[(free[i], free[j])],
            (true, false) => real(held[j - n][free[i]]),
            (false, true) => real(held[i - n][free[j]]),
            (false, false) => real(0.0),
        });
        let inverse = block.try_inverse().ok_or_else(resonance)?;
        let mut per_wrench = Matrix6::zeros();
        for (i, row) in free.iter().enumerate() {
            free.iter().enumerate().for_each(|(j, column)| per_wrench[(*row, *column)] = inverse[(i, j)]);
        }
        if per_wrench.iter().any(|value| !(value.re.is_finite() && value.im.is_finite())) {
            return Err(resonance());
        }
        let per_shortening = -(per_wrench * pulls);
        Ok(Response { frequency, per_wrench, per_shortening, neutral: neutral.to_vec() })
    }

    /// Mass of platform, payload and the static shapes of the cables.
    fn whole_mass(&self) -> Matrix6<f64> {
        self.cables.iter().flatten().fold(self.mass, |sum, cable| sum + cable.static_mass)
    }
}

impl FrequencyResponse {
    /// The force on the end of each cable, and how the cables vibrate, while the platform moves by `v` and
    /// the winches hold.
    pub(crate) fn vibrating<'a>(
        &'a self,
        at_rest: &'a [CableAtRest<'a>],
        v: &nalgebra::Vector6<Number>,
        frequency: f64,
    ) -> Result<Vec<Option<(Vector, Vibrating<'a>)>>, DynamicsError> {
        let omega = TAU * frequency;
        let one = |(number, cable): (usize, &'a Option<ShakenCable>)| {
            let Some(cable) = cable else { return Ok(None) };
            let (moved, turn): (Vector, Vector) = (v.fixed_rows::<3>(0).into(), v.fixed_rows::<3>(3).into());
            let end = moved + turn.cross(&cable.lever.map(real));
            let found = cable.at(omega, &self.damping).and_then(|(stiffness, _)| {
                let vibrating = cable.vibrating((number, &at_rest[number]), &end, omega, &self.damping)?;
                Some((stiffness * end, vibrating))
            });
            Ok(Some(found.ok_or(DynamicsError::Resonance { frequency })?))
        };
        self.cables.iter().enumerate().map(one).collect()
    }

    /// What the cables add to the dynamic stiffness of the platform, and the wrench on the held platform for
    /// each length that a winch takes in, 6 x n [N/m, N].
    pub(crate) fn of_cables(&self, frequency: f64) -> Result<CablesAndPulls, DynamicsError> {
        let mut dynamic = Matrix6::zeros();
        let mut pulls = Matrix6xX::zeros(self.cables.len());
        for (i, (cable, found)) in self.cables.iter().zip(self.of_each_cable(frequency)?).enumerate() {
            let (Some(cable), Some((stiffness, pull))) = (cable, found) else { continue };
            dynamic += on_platform(&cable.lever.map(real), &stiffness);
            let moment = cable.lever.map(real).cross(&pull);
            pulls.fixed_view_mut::<3, 1>(0, i).copy_from(&pull);
            pulls.fixed_view_mut::<3, 1>(3, i).copy_from(&moment);
        }
        Ok((dynamic, pulls))
    }

    /// The same of the end of each cable, in the base frame; `None` of one without mass and force.
    pub(crate) fn of_each_cable(
        &self,
        frequency: f64,
    ) -> Result<Vec<Option<StiffnessAndPull>>, DynamicsError> {
        let one = |cable: &ShakenCable| {
            let (stiffness, pull) = cable.at(TAU * frequency, &self.damping)?;
            Some((stiffness, pull + cable.more_pull.map(real)))
        };
        let found = |cable: &Option<ShakenCable>| {
            let Some(cable) = cable else { return Ok(None) };
            one(cable).map(Some).ok_or(DynamicsError::Resonance { frequency })
        };
        self.cables.iter().map(found).collect()
    }
}

/// Jᵀ K J.
fn on_platform<T: nalgebra::ComplexField>(
    lever: &nalgebra::Vector3<T>,
    stiffness: &Matrix3<T>,
) -> Matrix6<T> {
    let mut motion = nalgebra::Matrix3x6::<T>::zeros();
    motion.fixed_view_mut::<3, 3>(0, 0).copy_from(&Matrix3::identity());
    let [x, y, z] = [lever[0].clone(), lever[1].clone(), lever[2].clone()];
    let o = T::zero();
    let cross = Matrix3::new(o.clone(), -z.clone(), y.clone(), z, o.clone(), -x.clone(), -y, x, o);
    motion.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-cross));
    motion.transpose() * stiffness * motion
}
