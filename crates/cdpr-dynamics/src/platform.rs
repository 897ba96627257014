//! A platform on cables with mass, and the number of its natural motions below a frequency.

use crate::cable::{HeldMode, MovingCable};
use crate::error::{DynamicsError, positive};
use crate::free::Rotor;
use cdpr_statics::vibration::SmallMotions;
use cdpr_statics::{DirectProblem, Equilibrium, Matrix6};
use std::f64::consts::TAU;

/// A platform whose cables have mass, about an equilibrium. Its motions are (dp, dφ): the translation of P
/// [m] and a rotation vector [rad], in the base frame.
#[derive(Clone, Debug)]
pub struct MovingPlatform {
    /// Mass of platform and payload, and one on the diagonal of constrained motions.
    pub(crate) mass: Matrix6<f64>,
    /// Stiffness without the mass of cables, zero along constrained motions.
    pub(crate) stiffness: Matrix6<f64>,
    pub(crate) cables: Vec<MovingCable>,
    /// The motions that are not constrained.
    pub(crate) free: Vec<usize>,
    /// Mass of platform, payload and the static shapes of the cables.
    whole_mass: Matrix6<f64>,
    /// The motions of all cables with held ends up to [`FAR`] times the highest frequency, and for the faster
    /// ones the sums of c cᵀ/ω_k^(2j) for j from 1.
    near: Vec<HeldMode>,
    far: [Matrix6<f64>; TERMS],
}

/// Motions of cables beyond this multiple of the highest frequency are summed up as power series with
/// [`TERMS`] terms: what is left out is 16⁻⁸ of the first one.
const FAR: f64 = 4.0;
const TERMS: usize = 8;

impl MovingPlatform {
    /// Platform and cables for frequencies up to `highest` [Hz], on winches that hold.
    ///
    /// # Errors
    /// [`DynamicsError::Statics`] for an equilibrium that is not finite, and for a robot that rotates without
    /// `platform.inertia`; [`DynamicsError::Folded`] for a cable without tension at a point;
    /// [`DynamicsError::Invalid`] for a frequency that is not positive, or so high that a cable has more half
    /// waves than are computed.
    pub fn new(
        problem: &DirectProblem,
        equilibrium: &Equilibrium,
        highest: f64,
    ) -> Result<Self, DynamicsError> {
        Self::on_winches(problem, equilibrium, highest, None)
    }

    /// The same on winches with rotors, if there are any.
    ///
    /// # Errors
    /// As [`MovingPlatform::new`]; [`DynamicsError::Invalid`] for a rotor without mass or stiffness that can
    /// be one, and for a servo that the weight of a cable overcomes.
    pub fn on_winches(
        problem: &DirectProblem,
        equilibrium: &Equilibrium,
        highest: f64,
        winches: Option<Rotor>,
    ) -> Result<Self, DynamicsError> {
        positive("highest frequency", highest, "a frequency [Hz] above zero")?;
        winches.map_or(Ok(()), |rotor| rotor.check(highest))?;
        let SmallMotions { mass, weight, cables, free } = problem.small_motions(equilibrium)?;
        let mut stiffness = cables.iter().fold(weight, |sum, cable| sum + cable.stiffness);
        let moving = cables.iter().enumerate().map(|(i, cable)| MovingCable::new(i, cable, highest, winches));
        let cables = moving.collect::<Result<Vec<_>, _>>()?;
        cables.iter().for_each(|cable: &MovingCable| stiffness -= cable.softer);
        let whole_mass = cables.iter().fold(mass, |sum, cable| sum + cable.mass);
        let last = (FAR * TAU * highest).powi(2);
        let modes = cables.iter().flat_map(|cable: &MovingCable| &cable.modes);
        let (near, fast): (Vec<_>, Vec<_>) = modes.cloned().partition(|mode| mode.square < last);
        let mut far = [Matrix6::zeros(); TERMS];
        for HeldMode { square, coupling } in &fast {
            let mut term = coupling * coupling.transpose();
            for sum in &mut far {
                term /= *square;
                *sum += term;
            }
        }
        Ok(Self { mass, stiffness, cables, free, whole_mass, near, far })
    }

    /// Wrench on the platform [N, N m] for each motion with a frequency [Hz] up to the highest, (N4), with
    /// the mass of platform and cables. Its inverse is the receptance. Nothing is damped: both have poles.
    pub fn dynamic_stiffness(&self, frequency: f64) -> Matrix6<f64> {
        self.stiffness_at((TAU * frequency).powi(2))
    }

    fn stiffness_at(&self, square: f64) -> Matrix6<f64> {
        let far = self.far.iter().rev().fold(Matrix6::zeros(), |sum, term| sum * square + term);
        let mut stiffness = self.stiffness - (self.whole_mass + far * square) * square;
        for mode in &self.near {
            let share = square * square / (mode.square - square);
            stiffness.syger(-share, &mode.coupling, &mode.coupling, 1.0);
        }
        stiffness.fill_upper_triangle_with_lower_triangle();
        stiffness
    }

    /// The number of natural motions below a frequency [Hz] up to the highest: those of the cables with their
    /// ends held, and the negative eigenvalues of the dynamic stiffness (W. H. Wittrick, F. W. Williams, *A
    /// general algorithm for computing natural frequencies of elastic structures*, Q. J. Mech. Appl. Math.
    /// 24, 1971).
    pub fn count(&self, frequency: f64) -> usize {
        let square = (TAU * frequency).powi(2);
        let held: usize = self.cables.iter().map(|cable| cable.slower(square)).sum();
        let stiffness = self.stiffness_at(square);
        let stiffness = nalgebra::DMatrix::from_fn(self.free.len(), self.free.len(), |i, j| {
            stiffness[(self.free[i], self.free[j])]
        });
        held + stiffness.symmetric_eigenvalues().iter().filter(|value| **value < 0.0).count()
    }
}
