//! Exact derivatives of amplitudes of a platform that is shaken.
//!
//! A force along the unit vector u at a point, whose lever from P is r, moves the point by J H Jᵀ u. Its size
//! along w, of which w has the phase, is
//!
//! ```text
//! a = wᵀ J H Jᵀ u,      J = [ 1, -[r] ],      x = H Jᵀ u,      p = Hᵀ Jᵀ w
//! da = -pᵀ dD x + w·(x_r x dr) + u·(p_r x dr)                                                      (N19)
//! ```
//!
//! with dH = -H dD H. Along an axis, w is u but for the phase. In the worst direction, u is that of (N23),
//! which makes a stationary, and `w = (J H Jᵀ u)*/a`. As dD is symmetric, pᵀ dD x follows from (N11) for x +
//! p and x - p, with the damped motions of the cables:
//! `4 pᵀ dD x = (x + p)ᵀ dD (x + p) - (x - p)ᵀ dD (x - p)`. The skew part that a moment adds to D is
//! constant.

use crate::derivatives::changes::{Changes, Moved};
use crate::derivatives::{lacking, with_lengths};
use crate::energy::{CableEnergy, Number, Vector, real};
use crate::error::{DynamicsError, positive};
use crate::response::band::WorstDirections;
use crate::response::{Damping, FrequencyResponse};
use cdpr_robot::{Axis, Robot};
use cdpr_statics::derivatives::Inputs;
use cdpr_statics::{
    DMatrix, Deflection, Derivatives, DirectProblem, Equilibrium, Load, StaticsError, Vector3, Vector6,
};
use nalgebra::Matrix3;
use std::f64::consts::TAU;

/// Amplitudes of two directions that are nearer to each other than this, relative to them, are one: it has no
/// derivative.
const SAME: f64 = 1e-6;

/// An amplitude of a platform that is shaken by a force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AmplitudeAt {
    /// The frequency [Hz].
    pub frequency: f64,
    /// What damps the cables.
    pub damping: Damping,
    /// The point that is shaken and that moves, in the frame of the platform [m].
    pub marker: Vector3<f64>,
    /// Axis of the base frame along which the force acts and the motion is measured; without one, the force
    /// acts in the worst direction, and the amplitude is the norm of those along x, y and z.
    pub along: Option<Axis>,
}

/// Derivatives of an amplitude.
#[derive(Clone, Debug, PartialEq)]
pub struct AmplitudeDerivatives {
    /// The amplitude [m/N].
    pub amplitude: f64,
    /// What the columns stand for.
    pub inputs: Inputs,
    /// Derivatives by every input, with the lengths held: pose and tensions follow [m/N per unit].
    pub per_input: Vec<f64>,
    /// By the unstrained length of every cable [1/N].
    pub per_length: Vec<f64>,
    /// By a relative change of the inertia about the centre of mass [m/N].
    pub per_inertia: f64,
}

fn none(reason: &'static str) -> DynamicsError {
    StaticsError::NoDerivative { quantity: "the amplitude", reason }.into()
}

impl AmplitudeAt {
    /// The amplitude at an equilibrium [m/N].
    ///
    /// # Errors
    /// As [`FrequencyResponse::new`] and [`FrequencyResponse::at`].
    pub fn of(&self, problem: &DirectProblem, equilibrium: &Equilibrium) -> Result<f64, DynamicsError> {
        positive("frequency", self.frequency, "a frequency [Hz] above zero")?;
        let response = FrequencyResponse::new(problem, equilibrium, self.frequency, self.damping)?;
        let (found, lever) = (response.at(self.frequency)?, equilibrium.pose.rotation * self.marker);
        Ok(match self.along.map(Axis::index) {
            Some(k) => found.at_point(&lever).0[(k, k)].norm(),
            None => found.by_force(&lever),
        })
    }

    /// Its derivatives.
    ///
    /// # Errors
    /// As [`AmplitudeAt::of`]; [`StaticsError::NoDerivative`] where two directions are shaken alike, where
    /// nothing moves, and for pulleys whose axis is tilted or whose cable has no weight; those of
    /// [`DirectProblem::force_derivatives`].
    pub fn derivatives(
        &self,
        problem: &DirectProblem,
        equilibrium: &Equilibrium,
    ) -> Result<AmplitudeDerivatives, DynamicsError> {
        positive("frequency", self.frequency, "a frequency [Hz] above zero")?;
        let at_rest = problem.small_motions(equilibrium)?;
        lacking(problem, &at_rest).map_or(Ok(()), |reason| Err(none(reason)))?;
        let response = FrequencyResponse::new(problem, equilibrium, self.frequency, self.damping)?;
        let found = response.at(self.frequency)?;
        let lever = equilibrium.pose.rotation * self.marker;
        let (per_force, _) = found.at_point(&lever);
        let Shaken { amplitude, force, measured } = self.shaken(&per_force)?;
        let wrench = |of: &Vector| -> Vector6<Number> {
            Vector6::from_iterator(of.iter().chain(&lever.map(real).cross(of)).copied())
        };
        let x = found.per_wrench * wrench(&force);
        let p = found.per_wrench.tr_mul(&wrench(&measured));
        let gravity = problem.robot().gravity.vector();
        let square = (TAU * self.frequency).powi(2);
        let changes = |v: Vector6<Number>| {
            let (mut forces, mut energies) = (Vec::new(), Vec::new());
            for cable in response.vibrating(&at_rest.cables, &v, self.frequency)? {
                energies.push(cable.as_ref().map(|(_, vibrating)| CableEnergy::new(vibrating, &gravity)));
                forces.push(cable.map_or_else(Vector::zeros, |(force, _)| force));
            }
            Changes::new(problem, equilibrium, Moved { square, v, forces, energies })
        };
        let (sum, difference) = (changes(x + p)?, changes(x - p)?);
        let [x_turn, p_turn] = [x, p].map(|of| -> Vector { of.fixed_rows::<3>(3).into() });
        let slope = |(column, (of_sum, of_difference)): (usize, (Number, Number))| {
            let moved = sum.turned(column).cross(&lever).map(real);
            let of_lever = measured.dot(&x_turn.cross(&moved)) + force.dot(&p_turn.cross(&moved));
            (of_lever - (of_sum - of_difference) * 0.25).re
        };
        let columns = sum.all(&at_rest).into_iter().zip(difference.all(&at_rest));
        let mut per_input: Vec<f64> = columns.enumerate().map(slope).collect();
        let per_length = per_input.split_off(sum.inputs.count());
        if per_input.iter().chain(&per_length).any(|slope| !slope.is_finite()) {
            return Err(none("a cable hangs folded in a plane without width"));
        }
        let per_inertia = 0.25 * (sum.spin() - difference.spin()).re * square;
        Ok(AmplitudeDerivatives { amplitude, inputs: sum.inputs, per_input, per_length, per_inertia })
    }

    /// The amplitude, and what it is that of.
    fn shaken(&self, per_force: &Matrix3<Number>) -> Result<Shaken, DynamicsError> {
        if let Some(axis) = self.along {
            let moved = per_force[(axis.index(), axis.index())];
            let (amplitude, force) = (moved.norm(), Vector3::ith(axis.index(), 1.0).map(real));
            if amplitude == 0.0 {
                return Err(none("the point does not move along this axis"));
            }
            return Ok(Shaken { amplitude, force, measured: force * (moved.conj() / amplitude) });
        }
        let WorstDirections { amplitudes: [amplitude, second, _], directions } =
            WorstDirections::new(per_force);
        if second >= (1.0 - SAME) * amplitude {
            return Err(none("two directions are shaken alike"));
        }
        let force = directions[0].map(real);
        Ok(Shaken { amplitude, force, measured: (per_force * force).conjugate() / real(amplitude) })
    }
}

/// An amplitude [m/N], and u and w of (N19).
struct Shaken {
    amplitude: f64,
    force: Vector,
    measured: Vector,
}

impl AmplitudeDerivatives {
    /// Those of a deflected robot with the load of these derivatives.
    ///
    /// # Errors
    /// As [`AmplitudeAt::derivatives`].
    pub fn of_deflection(
        robot: &Robot,
        load: &Load,
        found: &Derivatives,
        amplitude: &AmplitudeAt,
    ) -> Result<Self, DynamicsError> {
        let Deflection { lengths, loaded, .. } = &found.deflection;
        amplitude.derivatives(&DirectProblem::new(robot, lengths, load)?, &loaded.equilibrium)
    }

    /// The derivatives where the lengths follow the inputs, with their derivatives, n x count
    /// ([`cdpr_statics::Derivatives::lengths`]) [m/N per unit].
    ///
    /// # Panics
    /// Never for derivatives of lengths of the same robot.
    pub fn with_lengths(&self, lengths: &DMatrix<f64>) -> Vec<f64> {
        with_lengths(&self.per_input, &self.per_length, lengths)
    }
}
