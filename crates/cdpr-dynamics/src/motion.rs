//! One natural motion with all motions of the cables, by inverse iteration on (N6).

use crate::cable::{HeldMode, MovingCable, Parts};
use crate::error::DynamicsError;
use cdpr_statics::vibration::{CableAtRest, SmallMotions};
use cdpr_statics::{DMatrix, Matrix6, StaticsError, Vector3, Vector6};
use std::f64::consts::TAU;

const QUANTITY: &str = "the natural frequency";

/// That a natural frequency has no derivative.
pub(crate) fn none(reason: &'static str) -> DynamicsError {
    StaticsError::NoDerivative { quantity: QUANTITY, reason }.into()
}

/// A natural motion of unit mass, with all motions of the cables.
pub(crate) struct Motion {
    /// ω² [1/s²].
    pub(crate) square: f64,
    /// That of the platform.
    pub(crate) v: Vector6<f64>,
    /// Amplitudes of the motions of each cable with its end held.
    pub(crate) amplitudes: Vec<Vec<f64>>,
    /// Force on the end of each cable, K_dyn u [N].
    pub(crate) forces: Vec<Vector3<f64>>,
}

impl Motion {
    /// That next to a frequency [Hz] whose platform moves nearly by `v`.
    pub(crate) fn near(
        at_rest: &SmallMotions,
        parts: &[Option<Parts>],
        frequency: f64,
        mut v: Vector6<f64>,
    ) -> Result<Self, DynamicsError> {
        const ITERATIONS: usize = 4;
        /// Next to the frequency, not on it.
        const OFF: f64 = 1e-9;
        let shift = (TAU * frequency).powi(2) * (1.0 + OFF);
        let cables = at_rest.cables.iter().zip(parts);
        let held: Vec<Vec<HeldMode>> = cables
            .clone()
            .map(|(cable, parts)| parts.as_ref().map_or_else(Vec::new, |p| p.held(cable)))
            .collect();
        let masses: Vec<_> = cables
            .map(|(cable, parts)| parts.as_ref().map_or_else(Matrix6::zeros, |p| MovingCable::mass(cable, p)))
            .collect();
        let mass = masses.iter().fold(at_rest.mass, |sum, mass| sum + mass);
        let stiffness = at_rest.cables.iter().fold(at_rest.weight, |sum, cable| sum + cable.stiffness);
        let all: Vec<&HeldMode> = held.iter().flatten().collect();
        let mut q: Vec<f64> =
            all.iter().map(|mode| shift * mode.coupling.dot(&v) / (mode.square - shift)).collect();
        let free = &at_rest.free;
        let mut dynamic = stiffness - mass * shift;
        for mode in &all {
            let share = shift * shift / (mode.square - shift);
            dynamic -= mode.coupling * mode.coupling.transpose() * share;
        }
        let dynamic = DMatrix::from_fn(free.len(), free.len(), |i, j| dynamic[(free[i], free[j])]).lu();
        for _ in 0..ITERATIONS {
            let momenta: Vec<f64> = all.iter().zip(&q).map(|(mode, q)| mode.coupling.dot(&v) + q).collect();
            let mut right = mass * v;
            for ((mode, q), momentum) in all.iter().zip(&q).zip(&momenta) {
                right += mode.coupling * (q + shift * momentum / (mode.square - shift));
            }
            let right = nalgebra::DVector::from_fn(free.len(), |i, _| right[free[i]]);
            let next = dynamic.solve(&right).ok_or_else(|| none("its equations are singular there"))?;
            v = Vector6::zeros();
            free.iter().zip(next.iter()).for_each(|(component, value)| v[*component] = *value);
            let amplitude = |(mode, momentum): (&&HeldMode, &f64)| {
                (momentum + shift * mode.coupling.dot(&v)) / (mode.square - shift)
            };
            q = all.iter().zip(&momenta).map(amplitude).collect();
            let of_cables = all.iter().zip(&q).map(|(mode, q)| q * (q + 2.0 * mode.coupling.dot(&v)));
            let size = ((v.transpose() * mass * v)[0] + of_cables.sum::<f64>()).sqrt();
            v /= size;
            q.iter_mut().for_each(|q| *q /= size);
        }
        let potential = all.iter().zip(&q).map(|(mode, q)| mode.square * q * q).sum::<f64>();
        let square = (v.transpose() * stiffness * v)[0] + potential;
        let mut rest = q.into_iter();
        let amplitudes: Vec<Vec<f64>> =
            held.iter().map(|held| rest.by_ref().take(held.len()).collect()).collect();
        let force = |i: usize| {
            let of_mass = masses[i].fixed_view::<3, 6>(0, 0) * v;
            let each = held[i].iter().zip(&amplitudes[i]);
            let momentum = each.fold(of_mass, |sum, (mode, q)| sum + mode.coupling.fixed_rows::<3>(0) * *q);
            at_rest.cables[i].end_stiffness * end(&at_rest.cables[i], &v) - momentum * square
        };
        let forces = (0..held.len()).map(force).collect();
        Ok(Self { square, v, amplitudes, forces })
    }
}

/// Motion of the anchor point [m].
pub(crate) fn end(cable: &CableAtRest, v: &Vector6<f64>) -> Vector3<f64> {
    let turn: Vector3<f64> = v.fixed_rows::<3>(3).into();
    v.fixed_rows::<3>(0) + turn.cross(&cable.lever)
}
