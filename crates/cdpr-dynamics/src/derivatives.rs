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

use crate::cable::Parts;
use crate::energy::{CableEnergy, Change};
use crate::error::DynamicsError;
use crate::modes::{Modes, Wanted};
use crate::motion::{Motion, end, none};
use cdpr_robot::{CableEnd, Parameter, Robot};
use cdpr_statics::derivatives::{ForceDerivatives, Inputs};
use cdpr_statics::vibration::{CableAtRest, SmallMotions};
use cdpr_statics::{DMatrix, Deflection, Derivatives, DirectProblem, Equilibrium, Load, Vector3, Vector6};
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
        check(problem, &at_rest)?;
        let parts = at_rest.cables.iter().enumerate().map(|(i, cable)| {
            // A cable without mass and force resists nothing.
            let is_shapeless = cable.linear_density == 0.0 && cable.catenary.is_slack_and_weightless();
            (!is_shapeless).then(|| Parts::new(i, cable, 1.1 * mode.frequency)).transpose()
        });
        let parts = parts.collect::<Result<Vec<_>, _>>()?;
        let start = Vector6::from_iterator(mode.translation.iter().chain(&mode.rotation).copied());
        let motion = Motion::near(&at_rest, &parts, mode.frequency, start)?;
        let changes = Changes::new(problem, equilibrium, &at_rest, &parts, &motion)?;
        let frequency = motion.square.sqrt() / TAU;
        let per_square = 1.0 / (2.0 * TAU * TAU * frequency);
        let slopes = changes.all(&at_rest, &motion).into_iter().map(|slope| per_square * slope);
        let mut per_input: Vec<f64> = slopes.collect();
        let per_length = per_input.split_off(changes.inputs.count());
        if per_input.iter().chain(&per_length).any(|slope| !slope.is_finite()) {
            return Err(none("a cable hangs folded in a plane without width"));
        }
        let per_inertia = -per_square * motion.square * changes.spin(&motion);
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
        let of = |(j, slope): (usize, &f64)| {
            let following = self.per_length.iter().enumerate().map(|(i, per)| per * lengths[(i, j)]);
            slope + following.sum::<f64>()
        };
        self.per_input.iter().enumerate().take(lengths.ncols()).map(of).collect()
    }
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

/// Refuses pulleys whose cables have no derivatives.
fn check(problem: &DirectProblem, at_rest: &SmallMotions) -> Result<(), DynamicsError> {
    let gravity = problem.robot().gravity.magnitude();
    for cable in &at_rest.cables {
        let of = &cable.catenary.cable;
        if of.guide.is_none_or(|guide| guide.radius == 0.0) {
            continue;
        }
        if of.leaves_its_plane() {
            return Err(none("the axis of a pulley is tilted"));
        }
        if cable.linear_density * gravity == 0.0 {
            return Err(none("a cable over a pulley has no weight"));
        }
    }
    Ok(())
}

/// What changes with the inputs: parameters, payload, pose and, after these, the lengths.
struct Changes<'a> {
    problem: &'a DirectProblem<'a>,
    equilibrium: &'a Equilibrium,
    inputs: Inputs,
    /// Of the forces at the anchor points and at the exits, and of K3 z where a cable is on a pulley.
    anchors: ForceDerivatives,
    exits: ForceDerivatives,
    resistances: Option<ForceDerivatives>,
    energies: Vec<Option<CableEnergy>>,
}

impl<'a> Changes<'a> {
    fn new(
        problem: &'a DirectProblem<'a>,
        equilibrium: &'a Equilibrium,
        at_rest: &SmallMotions,
        parts: &[Option<Parts>],
        motion: &Motion,
    ) -> Result<Self, DynamicsError> {
        let gravity = problem.robot().gravity.vector();
        let energy = |(i, cable): (usize, &CableAtRest)| {
            let parts = parts[i].as_ref()?;
            let end = end(cable, &motion.v);
            Some(CableEnergy::new((i, cable, parts), &end, &motion.amplitudes[i], motion.square, &gravity))
        };
        let energies: Vec<_> = at_rest.cables.iter().enumerate().map(energy).collect();
        let z: Vec<_> =
            energies.iter().map(|of| of.as_ref().map_or_else(Vector3::zeros, |energy| energy.z)).collect();
        let on_pulleys = z.iter().any(|z| *z != Vector3::zeros());
        let resistances = on_pulleys.then(|| problem.resistance_derivatives(equilibrium, &z)).transpose()?;
        Ok(Self {
            problem,
            equilibrium,
            inputs: Inputs { parameters: Parameter::of(problem.robot()) },
            anchors: problem.force_derivatives(equilibrium, CableEnd::Anchor)?,
            exits: problem.force_derivatives(equilibrium, CableEnd::Exit)?,
            resistances,
            energies,
        })
    }

    /// v_r·R J_c Rᵀ v_r [kg m²/(kg m²)].
    fn spin(&self, motion: &Motion) -> f64 {
        let inertia = self.problem.robot().platform.inertia;
        let turn = self.equilibrium.pose.rotation.inverse() * motion.turn();
        inertia.map_or(0.0, |inertia| turn.dot(&(inertia * turn)))
    }

    /// d(ω²) by every input and length, (N11).
    fn all(&self, at_rest: &SmallMotions, motion: &Motion) -> Vec<f64> {
        let columns = self.inputs.count() + at_rest.cables.len();
        (0..columns)
            .map(|column| {
                let parameter = self.inputs.parameters.get(column);
                let turned: Vector3<f64> = self.anchors.pose.fixed_view::<3, 1>(3, column).into();
                let of_cables = (0..at_rest.cables.len())
                    .map(|i| self.of_cable((i, &at_rest.cables[i]), motion, column, &turned));
                of_cables.sum::<f64>() + self.of_platform(parameter, motion, column, &turned)
            })
            .collect()
    }

    fn of_cable(
        &self,
        (i, cable): (usize, &CableAtRest),
        motion: &Motion,
        column: usize,
        turned: &Vector3<f64>,
    ) -> f64 {
        let Some(energy) = &self.energies[i] else { return 0.0 };
        let robot = self.problem.robot();
        let of = |all: &ForceDerivatives| -> Vector3<f64> {
            all.per_input.fixed_view::<3, 1>(3 * i, column).into()
        };
        let force = of(&self.anchors);
        let mut change = Change {
            // On the platform the cable pulls with -n, on what leads it with n.
            anchor: -force,
            exit: of(&self.exits),
            // The derivatives are those of -K3 z.
            resistance: self.resistances.as_ref().map_or_else(Vector3::zeros, |all| -of(all)),
            ..Change::default()
        };
        let mut arm = turned.cross(&cable.lever);
        match self.inputs.parameters.get(column) {
            Some(Parameter::LinearDensity) => change.density = 1.0,
            Some(Parameter::YoungsModulus) => {
                change.modulus = robot.cables[i].properties.youngs_modulus.recip();
            }
            Some(Parameter::AnchorPoint(of, axis)) if *of == i => {
                arm += self.equilibrium.pose.rotation.matrix().column(axis.index());
            }
            Some(Parameter::Lead(of)) if *of == i => change.lead = 1.0,
            Some(Parameter::Gravity(axis)) => change.gravity[axis.index()] = 1.0,
            _ => {}
        }
        if column == self.inputs.count() + i {
            change.length = 1.0;
        }
        let turn = motion.turn();
        let twice = |v: &Vector3<f64>| turn.cross(&turn.cross(v));
        energy.change(&change) + 2.0 * motion.forces[i].dot(&turn.cross(&arm))
            - force.dot(&twice(&cable.lever))
            - self.anchors.forces[i].dot(&twice(&arm))
    }

    /// Of the weight and of the mass of platform and payload.
    fn of_platform(
        &self,
        parameter: Option<&Parameter>,
        motion: &Motion,
        column: usize,
        turned: &Vector3<f64>,
    ) -> f64 {
        let robot = self.problem.robot();
        let (pose, gravity) = (&self.equilibrium.pose, robot.gravity.vector());
        let mass = robot.platform.mass + self.problem.load().payload;
        let center = pose.rotation * robot.platform.center_of_mass;
        let (mut heavier, mut moved, mut pull) = (0.0, turned.cross(&center), Vector3::zeros());
        match parameter {
            Some(Parameter::Mass) => heavier = 1.0,
            Some(Parameter::CenterOfMass(axis)) => moved += pose.rotation.matrix().column(axis.index()),
            Some(Parameter::Gravity(axis)) => pull[axis.index()] = mass,
            _ if column == self.inputs.payload() => heavier = 1.0,
            _ => {}
        }
        let turn = motion.turn();
        let twice = |v: &Vector3<f64>| turn.cross(&turn.cross(v));
        let of_weight = -(pull + heavier * gravity).dot(&twice(&center)) - mass * gravity.dot(&twice(&moved));
        let velocity: Vector3<f64> = motion.v.fixed_rows::<3>(0) + turn.cross(&center);
        let inertia = robot.platform.inertia.map_or_else(Vector3::zeros, |inertia| {
            pose.rotation * (inertia * (pose.rotation.inverse() * turn))
        });
        let of_mass = heavier * velocity.norm_squared()
            + 2.0 * mass * velocity.dot(&turn.cross(&moved))
            + 2.0 * turned.dot(&inertia.cross(&turn));
        of_weight - motion.square * of_mass
    }
}
