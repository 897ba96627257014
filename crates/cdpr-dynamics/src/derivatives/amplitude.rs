//! Exact derivatives of amplitudes of a platform that is shaken.
//!
//! A force along w at a point, whose lever from P is r, moves the point by a along w:
//!
//! ```text
//! a = wᵀ J H Jᵀ w,      da = -xᵀ dD x + 2 w·(x_r x dr),      x = H Jᵀ w,      J = [ 1, -[r] ]      (N19)
//! ```
//!
//! as D is symmetric: dH = -H dD H. `xᵀ dD x` is that of (N11), with the damped motions of the cables. In the
//! worst direction the amplitude is the largest singular value of J H Jᵀ, and w its vector, `J H Jᵀ w = a w*`
//! (T. Takagi, *On an algebraic problem related to an analytic theorem of Carathéodory and Fejér*, Jpn. J.
//! Math. 1, 1925).

use crate::derivatives::changes::{Changes, Moved};
use crate::derivatives::{lacking, with_lengths};
use crate::energy::{CableEnergy, Number, Vector, real};
use crate::error::{DynamicsError, positive};
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
    /// Axis of the base frame along which the force acts and the motion is measured; without one, the worst
    /// direction.
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
        let (per_force, _) =
            response.at(self.frequency)?.at_point(&(equilibrium.pose.rotation * self.marker));
        Ok(match self.along.map(Axis::index) {
            Some(k) => per_force[(k, k)].norm(),
            None => per_force.singular_values().max(),
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
        let (amplitude, direction, phase) = self.direction(&per_force)?;
        let moment = lever.map(real).cross(&direction);
        let wrench = Vector6::from_iterator(direction.iter().chain(&moment).copied());
        let v = found.per_wrench * wrench;
        let gravity = problem.robot().gravity.vector();
        let (mut forces, mut energies) = (Vec::new(), Vec::new());
        for cable in response.vibrating(&at_rest.cables, &v, self.frequency)? {
            energies.push(cable.as_ref().map(|(_, vibrating)| CableEnergy::new(vibrating, &gravity)));
            forces.push(cable.map_or_else(Vector::zeros, |(force, _)| force));
        }
        let square = (TAU * self.frequency).powi(2);
        let changes = Changes::new(problem, equilibrium, Moved { square, v, forces, energies })?;
        let turn: Vector = v.fixed_rows::<3>(3).into();
        let slope = |(column, of_stiffness): (usize, Number)| {
            let moved = changes.turned(column).cross(&lever);
            (phase * (direction.dot(&turn.cross(&moved.map(real))) * 2.0 - of_stiffness)).re
        };
        let mut per_input: Vec<f64> = changes.all(&at_rest).into_iter().enumerate().map(slope).collect();
        let per_length = per_input.split_off(changes.inputs.count());
        if per_input.iter().chain(&per_length).any(|slope| !slope.is_finite()) {
            return Err(none("a cable hangs folded in a plane without width"));
        }
        let per_inertia = (phase * changes.spin()).re * square;
        Ok(AmplitudeDerivatives { amplitude, inputs: changes.inputs, per_input, per_length, per_inertia })
    }

    /// The amplitude, w of (N19), and what turns a into a real number.
    fn direction(&self, per_force: &Matrix3<Number>) -> Result<(f64, Vector, Number), DynamicsError> {
        if let Some(axis) = self.along {
            let moved = per_force[(axis.index(), axis.index())];
            let amplitude = moved.norm();
            if amplitude == 0.0 {
                return Err(none("the point does not move along this axis"));
            }
            return Ok((amplitude, Vector3::ith(axis.index(), 1.0).map(real), moved.conj() / amplitude));
        }
        let svd = per_force.svd(true, true);
        let (Some(u), Some(v)) = (svd.u, svd.v_t) else { return Err(none("it has no direction")) };
        let mut sizes: Vec<(usize, f64)> = svd.singular_values.iter().copied().enumerate().collect();
        sizes.sort_by(|one, other| other.1.total_cmp(&one.1));
        let (largest, amplitude) = sizes[0];
        if sizes[1].1 >= (1.0 - SAME) * amplitude {
            return Err(none("two directions are shaken alike"));
        }
        // u* = c v with |c| = 1, as the matrix is symmetric.
        let v: Vector = v.row(largest).adjoint();
        let c = v.dotc(&u.column(largest).conjugate());
        Ok((amplitude, v * c.sqrt(), real(1.0)))
    }
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
