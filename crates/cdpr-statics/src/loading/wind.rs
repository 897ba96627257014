//! A platform whose cables hang in the wind.
//!
//! The drag of each cable is that of (C39), so that a cable hangs in no plane. With the unstrained lengths
//! kept, Newton's method finds the pose at which cables, weight and load balance, Eq. (3), while the drag is
//! raised from zero. The point where a cable leaves its pulley stays where it is without wind. A wind that
//! grows with height follows (C41), over `ground_z` of the robot or z = 0 of the base frame.

use crate::direct::DirectSolution;
use crate::equations::{Balance, CableDerivatives, FORCES, Pins, SpannedCable, in_its_plane, to_base};
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::Residual;
use cdpr_cable::{CableInWind, HeldInWind, SpatialCable, WindOverHeight};
use cdpr_robot::{Pose, Vector3, Vector6};

/// Density of the air at sea level [kg/m³] (ISO 2533:1975, standard atmosphere).
const AIR_DENSITY: f64 = 1.225;

/// Drag coefficient of a rope across the flow below the critical Reynolds number (EN 1991-1-4:2005, 7.9.2 for
/// wires and cables).
const DRAG_COEFFICIENT: f64 = 1.2;

/// Faster winds are in another unit.
const FASTEST: f64 = 120.0;

/// Greatest and least step in which the drag is raised, as shares of it.
const STEPS: [f64; 2] = [0.25, 1.0 / 1024.0];

/// ½ ρ c, drag of a rope per length, diameter and square of the velocity across [kg/m³].
pub(crate) const DRAG_PER_DIAMETER: f64 = 0.5 * AIR_DENSITY * DRAG_COEFFICIENT;

/// A steady wind, the same everywhere or growing with height.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wind {
    velocity: Vector3<f64>,
    profile: Option<WindProfile>,
}

/// How a wind grows with the height above the ground, (C41) of `cdpr_cable`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindProfile {
    /// Roughness length z0 of the ground [m]: 0.003 of a sea to 1 of a town (EN 1991-1-4:2005, Table 4.1).
    pub roughness: f64,
    /// Height above the ground at which the wind has its velocity [m].
    pub reference: f64,
}

impl Wind {
    /// Wind of this velocity in the base frame [m/s].
    ///
    /// Air of another density ρ or cables with another drag coefficient c are as in a wind that is
    /// `sqrt(ρ c/(1.225 · 1.2))` times as fast.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] unless it is finite and at most 120 m/s.
    pub fn new(velocity: Vector3<f64>) -> Result<Self, StaticsError> {
        if velocity.norm() <= FASTEST * (1.0 + 4.0 * f64::EPSILON) {
            return Ok(Self { velocity, profile: None });
        }
        let expected = format!("a velocity of at most {FASTEST} m/s");
        Err(StaticsError::invalid("wind".to_owned(), format!("{:?}", velocity.as_slice()), expected))
    }

    /// The same wind with its velocity at one height, growing with height.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] unless the roughness length is 0.0001 to 10 m and the height 0.1 to 1000 m.
    pub fn over_height(self, profile: WindProfile) -> Result<Self, StaticsError> {
        let WindProfile { roughness, reference } = profile;
        for (field, value, range, expected) in [
            ("wind_profile.roughness", roughness, 1e-4..=10.0, "a roughness length from 0.0001 to 10 m"),
            ("wind_profile.reference", reference, 0.1..=1e3, "a height from 0.1 to 1000 m"),
        ] {
            if !range.contains(&value) {
                return Err(StaticsError::invalid(field.to_owned(), value, expected));
            }
        }
        Ok(Self { profile: Some(profile), ..self })
    }

    /// The same wind with another velocity [m/s].
    ///
    /// # Errors
    /// As [`Wind::new`].
    pub fn with_velocity(self, velocity: Vector3<f64>) -> Result<Self, StaticsError> {
        Ok(Self { profile: self.profile, ..Self::new(velocity)? })
    }

    /// Its velocity in the base frame [m/s], at the height of reference of its profile if it has one.
    pub fn velocity(&self) -> Vector3<f64> {
        self.velocity
    }

    /// How it grows with height; `None` where it is the same everywhere.
    pub fn profile(&self) -> Option<WindProfile> {
        self.profile
    }

    /// Whether there is no wind.
    pub fn is_calm(&self) -> bool {
        self.velocity == Vector3::zeros()
    }
}

/// A platform at rest whose cables hang in the wind, if there is any.
#[derive(Clone, Debug, PartialEq)]
pub struct RestInWeather {
    /// Pose of the platform.
    pub pose: Pose,
    /// Force of each cable on the platform [N].
    pub forces: Vec<Vector3<f64>>,
    /// Tension of each cable at its exit point, or where it leaves its pulley [N].
    pub exit_tensions: Vec<f64>,
    /// Force of the wind on each cable beyond that point [N].
    pub drags: Vec<Vector3<f64>>,
    /// Residual of the equations of this wind.
    pub residual: Residual,
    /// Largest error of the integration along a cable [m].
    pub integration: f64,
    /// Iterations of Newton's method.
    pub iterations: usize,
    /// The cables.
    pub(crate) held: Vec<HeldInWind>,
}

/// A cable in wind with the derivatives of its force on the platform.
pub(crate) struct BlownCable {
    pub(crate) cable: CableDerivatives,
    /// By ½ ρ c d' of its diameter d'.
    pub(crate) per_drag: Vector3<f64>,
    /// By its height above the ground [N/m].
    pub(crate) per_height: Vector3<f64>,
}

impl RestInWeather {
    /// Tension of each cable at the platform [N].
    pub fn tensions(&self) -> Vec<f64> {
        self.forces.iter().map(Vector3::norm).collect()
    }
}

/// A cable beyond its leave point.
struct Hung<'a> {
    cable: CableInWind<'a>,
    /// Where it leaves its exit point or pulley [m].
    leave: Vector3<f64>,
    /// The force there as it was solved last [N].
    force: Vector3<f64>,
}

/// The cables at a pose, each in equilibrium, and the platform.
struct Blown {
    pose: Pose,
    cables: Vec<HeldInWind>,
    balance: Balance,
}

impl DirectProblem<'_> {
    /// Where the platform rests when the wind blows on its cables, with the lengths kept: the equilibrium
    /// that `still`, the one without wind, becomes while the drag is raised.
    ///
    /// Wind on the platform itself is a load.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] for a cable without diameter in a wind; [`StaticsError::Cable`] where the
    /// iteration finds no equilibrium of a cable; [`StaticsError::Unstable`] where the platform would leave
    /// the pose, and [`StaticsError::DirectNotConverged`].
    pub fn in_wind(&self, wind: &Wind, still: &DirectSolution) -> Result<RestInWeather, StaticsError> {
        self.check("still", &still.equilibrium)?;
        if wind.profile.is_some() && !self.robot.gravity.is_base_level() {
            let expected = "a wind that is the same everywhere, or a base frame whose z axis points upwards";
            return Err(StaticsError::invalid("wind_profile".to_owned(), "a tilted base frame", expected));
        }
        let symmetric = self.linearize(&still.equilibrium)?.symmetric_stiffness();
        let pins = Pins::new(self, &still.equilibrium, &symmetric);
        let hung = (0..self.cables()).map(|i| self.hung(still, i, wind));
        let mut hung: Vec<_> = hung.collect::<Result<_, _>>()?;
        let mut at = Blown::at(self, &mut hung, still.equilibrium.pose)?;
        let (mut iterations, [greatest, least]) = (0, STEPS);
        let (mut share, mut step) = (0.0, if wind.is_calm() { 1.0 } else { greatest });
        while share < 1.0 {
            let next = 1.0_f64.min(share + step);
            // The drag is that of the velocity's square.
            let velocity = wind.velocity * next.sqrt();
            hung.iter_mut().for_each(|hung| hung.cable.velocity = velocity);
            match self.balanced(&mut hung, at.pose, &pins) {
                Ok((there, made)) => {
                    (at, share, iterations) = (there, next, iterations + made);
                    step = greatest.min(2.0 * step);
                }
                Err(error) if step <= least || wind.is_calm() => return Err(error),
                Err(_) => {
                    step *= 0.5;
                    hung.iter_mut().zip(&at.cables).for_each(|(hung, held)| hung.force = held.exit_force);
                }
            }
        }
        if pins.pinned(&at.balance.symmetric_hessian(self.robot.freedoms()), 1.0).cholesky().is_none() {
            let least = at.balance.symmetric_hessian(self.robot.freedoms()).symmetric_eigenvalues().min();
            return Err(StaticsError::Unstable { pose: Box::new(at.pose), least_stiffness: least });
        }
        Ok(RestInWeather {
            residual: at.residual(self),
            forces: at.cables.iter().map(|held| -held.anchor_force).collect(),
            exit_tensions: at.cables.iter().map(|held| held.exit_force.norm()).collect(),
            drags: at.cables.iter().map(|held| held.drag).collect(),
            integration: at.cables.iter().map(|held| held.error).fold(0.0, f64::max),
            pose: at.pose,
            iterations,
            held: at.cables,
        })
    }

    /// The cables of a rest in the wind, which is that of `still` without it.
    ///
    /// # Errors
    /// [`StaticsError::NoDerivative`] for a cable on a pulley: the point where it leaves the pulley would
    /// move.
    pub(crate) fn blown_cables(
        &self,
        wind: &Wind,
        still: &DirectSolution,
        rest: &RestInWeather,
    ) -> Result<Vec<BlownCable>, StaticsError> {
        let one = |(i, held): (usize, &HeldInWind)| {
            if self.cable(i).guide.is_some_and(|guide| guide.radius > 0.0) {
                let reason = "it leaves a pulley at a point that is taken as constant";
                return Err(StaticsError::NoDerivative { quantity: "a cable in wind", reason });
            }
            let cable = CableInWind { velocity: wind.velocity, ..self.hung(still, i, wind)?.cable };
            let slopes = cable.slopes(held).map_err(StaticsError::cable(i))?;
            Ok(BlownCable {
                cable: CableDerivatives::in_wind(self.robot, &rest.pose, i, held, &slopes),
                per_drag: -slopes.per_drag,
                per_height: -slopes.per_height,
            })
        };
        rest.held.iter().enumerate().map(one).collect()
    }

    /// Cable i as it hangs before the wind.
    fn hung(&self, still: &DirectSolution, i: usize, wind: &Wind) -> Result<Hung<'_>, StaticsError> {
        let (robot, at) = (self.robot, &still.equilibrium);
        let diameter = match robot.cables[i].properties.diameter {
            Some(diameter) => diameter,
            None if wind.is_calm() => 0.0,
            None => {
                let expected = "a diameter [m], on which the drag of the wind depends";
                return Err(StaticsError::invalid(format!("cables[{i}].diameter"), "not given", expected));
            }
        };
        let catenary = self.catenary(i, at.cable_forces[i]);
        let plane = SpannedCable::of(robot, &at.pose, i, &catenary).span.plane;
        let level = robot.gravity.level();
        let in_base = |v: Vector3<f64>| Vector3::from(to_base(level, v.into()));
        let cable = self.cable(i);
        let in_plane = in_its_plane(robot, &at.pose, i, catenary);
        let [fx, fz] = catenary.force.into();
        let leave = match cable.guide {
            None => Vector3::zeros(),
            Some(_) => {
                let force = plane.lift([fx, fz]).into();
                SpatialCable { cable, unstrained_length: self.lengths[i], force }.response().leave
            }
        };
        let stretch = 1.0 + cable.strain(in_plane.exit_tension());
        let leave = robot.cables[i].exit_point + in_base(leave);
        Ok(Hung {
            cable: CableInWind {
                cable,
                weight: in_base(Vector3::new(0.0, 0.0, -cable.weight_per_length)),
                velocity: Vector3::zeros(),
                drag: DRAG_PER_DIAMETER * diameter,
                unstrained_length: self.lengths[i],
                guided: (self.lengths[i] - in_plane.free_length()) * stretch,
                profile: wind.profile.map(|WindProfile { roughness, reference }| WindOverHeight {
                    roughness,
                    reference,
                    height: leave.z - robot.ground_z.unwrap_or(0.0),
                }),
            },
            leave,
            force: in_base(plane.lift([fx, in_plane.exit_vertical_force()]).into()),
        })
    }

    /// The balance next to a pose, by Newton's method, and the iterations made.
    fn balanced(&self, hung: &mut [Hung], pose: Pose, pins: &Pins) -> Result<(Blown, usize), StaticsError> {
        const MAX_ITERATIONS: usize = 50;
        let freedoms = self.robot.freedoms();
        let (mut at, mut iterations) = (Blown::at(self, hung, pose)?, 0);
        while iterations < MAX_ITERATIONS {
            let opposing = pins.rest(&-at.balance.gradient);
            let step = pins.pinned(&at.balance.hessian(freedoms), 1.0).lu().solve(&opposing);
            let Some(step) = step else { break };
            let before = at.unbalanced(self);
            let Some(next) = at.nearer(self, hung, &step)? else { break };
            (at, iterations) = (next, iterations + 1);
            let after = at.unbalanced(self);
            let is_rounding = after <= at.rounding() && after > 0.5 * before;
            if is_rounding || after <= FORCES * at.forces() {
                break;
            }
        }
        if at.unbalanced(self) <= at.rounding() {
            return Ok((at, iterations));
        }
        let residual = at.residual(self);
        Err(StaticsError::DirectNotConverged { iterations, pose: Box::new(at.pose), residual })
    }
}

/// Unbalanced wrench, relative to all forces, which is rounding where no step lowers it.
const BALANCED: f64 = 1e-9;

impl Blown {
    /// Each cable in equilibrium at a pose.
    fn at(problem: &DirectProblem, hung: &mut [Hung], pose: Pose) -> Result<Self, StaticsError> {
        let mut balance = Balance::of_load(problem, &pose);
        let mut cables = Vec::with_capacity(hung.len());
        for (i, hung) in hung.iter_mut().enumerate() {
            let arm = problem.robot.anchor_arm(&pose, i);
            let end = pose.position + arm - hung.leave;
            let held = hung.cable.held_at(end, hung.force).map_err(StaticsError::cable(i))?;
            hung.force = held.exit_force;
            // The skew part, which the drag makes, is small: without it there are a few more steps.
            let stiffness = 0.5 * (held.stiffness + held.stiffness.transpose());
            balance.add_cable(&arm.into(), &(-held.anchor_force).into(), &stiffness.into());
            cables.push(held);
        }
        Ok(Self { pose, cables, balance })
    }

    /// The cables after a step (dp, dφ) of the platform, or after the longest half, quarter, .. of it that
    /// lowers the unbalanced wrench; `None` where no part does.
    fn nearer(
        &self,
        problem: &DirectProblem,
        hung: &mut [Hung],
        step: &Vector6<f64>,
    ) -> Result<Option<Self>, StaticsError> {
        let before = self.unbalanced(problem);
        let mut failure = None;
        for halvings in 0..12 {
            let part = step * 0.5_f64.powi(halvings);
            let [dp, turn] = [0, 3].map(|row| part.fixed_rows::<3>(row).into_owned());
            hung.iter_mut().zip(&self.cables).for_each(|(hung, held)| hung.force = held.exit_force);
            match Self::at(problem, hung, self.pose.moved(dp, turn)) {
                Ok(next) if next.unbalanced(problem) < before => return Ok(Some(next)),
                Ok(_) => failure = None,
                Err(error) => failure = Some(error),
            }
        }
        failure.map_or(Ok(None), Err)
    }

    /// Norm of the unbalanced wrench [N], moments over the characteristic length.
    fn unbalanced(&self, problem: &DirectProblem) -> f64 {
        let Residual { force, moment, .. } = self.residual(problem);
        force + moment / problem.characteristic_length()
    }

    fn residual(&self, problem: &DirectProblem) -> Residual {
        let gradient = self.balance.free_gradient(problem.robot.freedoms());
        Residual {
            closure: self.cables.iter().map(|held| held.closure).fold(0.0, f64::max),
            force: gradient.fixed_rows::<3>(0).norm(),
            moment: gradient.fixed_rows::<3>(3).norm(),
        }
    }

    /// What rounding and the integration along the cables leave of the balance [N]: stiff cables make much
    /// force of a small error of their end.
    fn rounding(&self) -> f64 {
        let integration = self.cables.iter().map(|held| held.error * held.stiffness.norm());
        (BALANCED * self.forces()).max(integration.sum())
    }

    fn forces(&self) -> f64 {
        self.cables.iter().map(|held| held.anchor_force.norm()).sum()
    }
}
