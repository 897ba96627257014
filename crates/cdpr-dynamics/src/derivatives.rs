//! Exact derivatives of natural frequencies.
//!
//! Of a motion x of unit mass, `xᵀ M x = 1`, with the platform's part v,
//!
//! ```text
//! d(ω²) = xᵀ (dK - ω² dM) x = sum [ dQ_i + 2 (K_dyn,i u_i)·(v_r x ds_i) ] + d(vᵀ K_g v) - ω² d(vᵀ M v)     (N11)
//! vᵀ K_g v = -sum F_i·(v_r x (v_r x s_i)) - F_w·(v_r x (v_r x R c))
//! ```
//!
//! with Q_i of (N8) and the motions `u_i = v_p + v_r x s_i` of the anchor points; M is the mass of platform
//! and payload. Pose and forces of the equilibrium change with every input. The motion comes from inverse
//! iteration on (N6) with all motions of the cables, which are eliminated.

pub(crate) mod amplitude;
mod changes;

use crate::cable::{Motions, Parts};
use crate::derivatives::changes::{Changes, Moved};
use crate::energy::{CableEnergy, Vibrating, real};
use crate::error::DynamicsError;
use crate::modes::{Modes, Wanted};
use crate::motion::{Motion, end, none};
use cdpr_robot::Robot;
use cdpr_statics::derivatives::Inputs;
use cdpr_statics::vibration::{CableAtRest, SmallMotions};
use cdpr_statics::{DMatrix, Deflection, Derivatives, DirectProblem, Load, Vector6};
use std::f64::consts::TAU;

/// Natural frequencies nearer to each other than this, relative to them, are one: neither has a derivative.
const SAME: f64 = 1e-6;

/// Derivatives of a natural frequency of platform and cables.
///
/// They hold for changes of the frequency that are small compared with its distance from the next one, `gap`:
/// beyond that two motions exchange their shapes.
#[derive(Clone, Debug, PartialEq)]
pub struct FrequencyDerivatives {
    /// The frequency [Hz].
    pub frequency: f64,
    /// Share of platform and payload in the kinetic energy of its motion.
    pub platform_share: f64,
    /// Distance of the nearest other natural frequency, relative to it.
    pub gap: f64,
    /// What the columns stand for.
    pub inputs: Inputs,
    /// Derivatives by every input, with the lengths held: pose and tensions follow [Hz per unit].
    pub per_input: Vec<f64>,
    /// By the unstrained length of every cable [Hz/m].
    pub per_length: Vec<f64>,
    /// By a relative change of the inertia about the centre of mass [Hz].
    pub per_inertia: f64,
}

impl FrequencyDerivatives {
    /// Those of `modes.modes[number]`, natural motions of `problem` about an equilibrium.
    ///
    /// # Errors
    /// [`DynamicsError::Invalid`] for a number without motion; [`StaticsError::NoDerivative`] where another
    /// motion has the same frequency or nothing resists it, and for pulleys whose axis is tilted or whose
    /// cable has no weight; those of [`crate::MovingPlatform::new`] and of
    /// [`DirectProblem::force_derivatives`].
    pub fn new(problem: &DirectProblem, modes: &Modes, number: usize) -> Result<Self, DynamicsError> {
        let gap = gap(modes, number)?;
        let mode = &modes.modes[number];
        let equilibrium = &modes.equilibrium;
        let at_rest = problem.small_motions(equilibrium)?;
        lacking(problem, &at_rest).map_or(Ok(()), |reason| Err(none(reason)))?;
        let parts = at_rest.cables.iter().enumerate().map(|(i, cable)| {
            // A cable without mass and force resists nothing.
            let is_shapeless = cable.linear_density == 0.0 && cable.catenary.is_slack_and_weightless();
            (!is_shapeless).then(|| Parts::new(i, cable, 1.1 * mode.frequency, None)).transpose()
        });
        let parts = parts.collect::<Result<Vec<_>, _>>()?;
        let start = Vector6::from_iterator(mode.translation.iter().chain(&mode.rotation).copied());
        let motion = Motion::near(&at_rest, &parts, mode.frequency, start)?;
        let gravity = problem.robot().gravity.vector();
        let energy = |(number, cable): (usize, &CableAtRest)| {
            let vibrating = natural((number, cable, parts[number].as_ref()?), &motion)?;
            Some(CableEnergy::new(&vibrating, &gravity))
        };
        let moved = Moved {
            square: motion.square,
            v: motion.v.map(real),
            forces: motion.forces.iter().map(|force| force.map(real)).collect(),
            energies: at_rest.cables.iter().enumerate().map(energy).collect(),
        };
        let changes = Changes::new(problem, equilibrium, moved)?;
        let frequency = motion.square.sqrt() / TAU;
        let per_square = 1.0 / (2.0 * TAU * TAU * frequency);
        let slopes = changes.all(&at_rest).into_iter().map(|slope| per_square * slope.re);
        let mut per_input: Vec<f64> = slopes.collect();
        let per_length = per_input.split_off(changes.inputs.count());
        if per_input.iter().chain(&per_length).any(|slope| !slope.is_finite()) {
            return Err(none("a cable hangs folded in a plane without width"));
        }
        let per_inertia = -per_square * motion.square * changes.spin().re;
        let platform_share = (motion.v.transpose() * at_rest.mass * motion.v)[0];
        let inputs = changes.inputs;
        Ok(Self { frequency, platform_share, gap, inputs, per_input, per_length, per_inertia })
    }

    /// Those of [`Modes::of_platform`].
    ///
    /// # Errors
    /// As [`FrequencyDerivatives::new`].
    pub fn of_platform(problem: &DirectProblem, modes: &Modes) -> Result<Self, DynamicsError> {
        let number = modes.number_of_platform().ok_or_else(|| none("nothing resists the platform"))?;
        Self::new(problem, modes, number)
    }

    /// Those of the lowest natural frequency of a deflected robot with the load of these derivatives.
    ///
    /// # Errors
    /// As [`Modes::new`] and [`FrequencyDerivatives::new`].
    pub fn lowest_of_deflection(
        robot: &Robot,
        load: &Load,
        found: &Derivatives,
    ) -> Result<Self, DynamicsError> {
        let Deflection { lengths, loaded, .. } = &found.deflection;
        let problem = DirectProblem::new(robot, lengths, load)?;
        let modes = Modes::slowest(&problem, &loaded.equilibrium)?;
        let number = modes.modes.iter().position(|mode| mode.frequency > 0.0);
        Self::new(&problem, &modes, number.ok_or_else(|| none("nothing resists the platform"))?)
    }

    /// Those of the platform of a deflected robot with the load of these derivatives.
    ///
    /// # Errors
    /// As [`Modes::new`] and [`FrequencyDerivatives::new`].
    pub fn of_deflection(robot: &Robot, load: &Load, found: &Derivatives) -> Result<Self, DynamicsError> {
        let Deflection { lengths, loaded, .. } = &found.deflection;
        let problem = DirectProblem::new(robot, lengths, load)?;
        Self::of_platform(&problem, &Modes::new(&problem, &loaded.equilibrium, Wanted::OfPlatform)?)
    }

    /// The derivatives where the lengths follow the inputs, with their derivatives, n x count
    /// ([`cdpr_statics::Derivatives::lengths`]) [Hz per unit].
    ///
    /// # Panics
    /// Never for derivatives of lengths of the same robot.
    pub fn with_lengths(&self, lengths: &DMatrix<f64>) -> Vec<f64> {
        with_lengths(&self.per_input, &self.per_length, lengths)
    }
}

/// Derivatives by inputs that the lengths follow.
fn with_lengths(per_input: &[f64], per_length: &[f64], lengths: &DMatrix<f64>) -> Vec<f64> {
    let of = |(j, slope): (usize, &f64)| {
        let following = per_length.iter().enumerate().map(|(i, per)| per * lengths[(i, j)]);
        slope + following.sum::<f64>()
    };
    per_input.iter().enumerate().take(lengths.ncols()).map(of).collect()
}

/// How a cable vibrates in a natural motion; none over a wheel with a tilted axis, which is [`lacking`].
fn natural<'a>(
    (number, at_rest, parts): (usize, &'a CableAtRest<'a>, &'a Parts),
    motion: &Motion,
) -> Option<Vibrating<'a>> {
    let Motions::Apart { in_plane: plane, across: side } = &parts.motions else { return None };
    let end = at_rest.axes.tr_mul(&end(at_rest, &motion.v));
    let amplitudes = &motion.amplitudes[number];
    let (in_plane, across) = amplitudes.split_at(plane.condensed.modes.len());
    let in_plane = plane.condensed.unknowns([end.x, end.z], in_plane);
    let across = side.condensed.unknowns([end.y], across);
    let complex = |unknowns: Vec<f64>| unknowns.into_iter().map(real).collect();
    Some(Vibrating {
        number,
        at_rest,
        elements: &parts.elements,
        in_plane: (&plane.beginning, complex(in_plane)),
        across: (&side.beginning, complex(across)),
        square: real(motion.square),
        viscous: real(0.0),
    })
}

/// The relative distance of a frequency from the others, and from that up to which they are known.
fn gap(modes: &Modes, number: usize) -> Result<f64, DynamicsError> {
    let Some(mode) = modes.modes.get(number) else {
        return Err(DynamicsError::Invalid {
            field: "number of the motion",
            value: number.to_string(),
            expected: format!("less than {}, the motions that are known", modes.modes.len()),
        });
    };
    if mode.frequency == 0.0 {
        return Err(none("nothing resists the motion"));
    }
    let others = modes.modes.iter().enumerate().filter(|(k, _)| *k != number);
    let others = others.map(|(_, other)| other.frequency).chain([modes.complete_below]);
    let gap = others.map(|other| (other / mode.frequency - 1.0).abs()).fold(f64::INFINITY, f64::min);
    if gap <= SAME { Err(none("two motions have it")) } else { Ok(gap) }
}

/// Why the pulleys of a robot leave no derivatives.
fn lacking(problem: &DirectProblem, at_rest: &SmallMotions) -> Option<&'static str> {
    let gravity = problem.robot().gravity.magnitude();
    for cable in &at_rest.cables {
        let of = &cable.catenary.cable;
        if of.guide.is_none_or(|guide| guide.radius == 0.0) {
            continue;
        }
        if of.leaves_its_plane() {
            return Some("the axis of a pulley is tilted");
        }
        if cable.linear_density * gravity == 0.0 {
            return Some("a cable over a pulley has no weight");
        }
    }
    None
}
