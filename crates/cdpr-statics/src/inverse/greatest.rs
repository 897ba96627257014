//! The greatest payload and the margin of the tensions at a pose, with the tensions distributed again.
//!
//! Both are the greatest z for which tensions exist,
//!
//! ```text
//! maximize  z   subject to   sum w_i(t_i) + w_ex + z w_z = 0,   min_i + κ z <= t_i <= max_i - κ z    (I7)
//! ```
//!
//! - The payload: w_z is the weight of 1 kg at the centre of mass, κ = 0 and z >= 0. A pose that a robot
//!   holds under each wrench of a set belongs to its wrench-feasible workspace (Bosscher, Riechel,
//!   Ebert-Uphoff, *Wrench-feasible workspace generation for cable-driven robots*, IEEE Trans. Robotics 22,
//!   2006; Bouchard, Gosselin, Moore, *On the ability of a cable-driven robot to generate a prescribed set of
//!   wrenches*, J. Mechanisms Robotics 2, 2010).
//! - The margin: w_z = 0 and κ = 1. It is how far every tension can stay away from both of its limits, and
//!   negative where no tensions within the limits balance the wrench: by how much all limits would have to
//!   give way. The capacity margin of Guay, Cardou, Cruz-Ruiz, Caro (*Measuring how well a structure supports
//!   varying external wrenches*, 2014) measures the same distance as a wrench; it has the same sign.
//!
//! The greatest tensions are at most the breaking forces, at either end of a cable. Both figures end at
//! [`cdpr_cable::MAX_STRAIN`], too: no cable gets a tension that strains it more.
//!
//! Of straight cables w_i = u_i t_i and (I7) is a linear program. Sagging ones pull in a direction that
//! depends on the tension: the program linearized at the last chord forces is solved again and again, and the
//! limits that it rests on give Newton's method its equations (Fletcher and Sainz de la Maza, *Nonlinear
//! programming and nonsmooth optimization by successive linear programming*, Math. Programming 43, 1989).

use super::limits::{breaking_limit, strain_limit};
use super::maximization::{Aim, Maximization, Maximum};
use super::problem::InverseProblem;
use super::wanted::whole;
use super::{InverseSolution, PoseLengths};
use crate::error::StaticsError;
use crate::out_of_limits::Limit;
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Load, Residual, Wanted, one_by_one};
use cdpr_robot::{Pose, Robot, TensionLimits, Wrench};

/// The greatest value that the limits of tension allow, with the tensions that reach it.
#[derive(Clone, Debug, PartialEq)]
pub struct Greatest {
    /// The value: a payload [kg] or a margin [N].
    pub value: f64,
    /// Tension of every cable at the platform [N].
    pub tensions: Vec<f64>,
    /// Unstrained length of every cable [m].
    pub lengths: Vec<f64>,
    /// The pose with the cables' forces.
    pub equilibrium: Equilibrium,
    /// The limits that block a greater value, the one with the largest gain first.
    pub blocking: Vec<Blocking>,
    /// Linear programs that were solved.
    pub iterations: usize,
    /// Residuals of all equations.
    pub residual: Residual,
}

/// A limit that blocks a greater value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blocking {
    /// Index of the cable, from 0.
    pub index: usize,
    /// Which of its limits: [`Limit::Min`], [`Limit::Max`], [`Limit::BreakingForce`] or [`Limit::Strain`].
    pub limit: Limit,
    /// The limit at the platform [N]; of a least tension, no less than what the weight of the cable demands.
    /// A breaking force is that of the cable, reached at one of its ends.
    pub value: f64,
    /// By how much the value grows where this limit is moved outwards [kg/N or N/N].
    pub gain: f64,
}

/// The greatest mass [kg] at the platform's centre of mass that tensions within the limits hold at a wanted
/// pose, or at each of many, together with the `wrench` [N, N m] about P. A reference of the tensions does
/// not act.
///
/// It is zero or more. Where the platform is in balance with a mass only, not by its own weight, it is at
/// least that mass. It is infinite where weight does not act along the motions that the platform has.
///
/// # Errors
/// Those of [`crate::inverse`]; [`StaticsError::NoTensions`] where no mass is in balance;
/// [`StaticsError::Invalid`] for free coordinates, which leave no choice of the tensions.
pub fn greatest_payload<W: Wanted>(
    robot: &Robot,
    wanted: W,
    wrench: &Wrench,
) -> W::Results<Result<Greatest, StaticsError>> {
    one_by_one(wanted, |wanted| payload_at(robot, &whole(*wanted)?.pose, wrench))
}

fn payload_at(robot: &Robot, pose: &Pose, wrench: &Wrench) -> Result<Greatest, StaticsError> {
    let gravity = robot.gravity.magnitude();
    let load = Load::wrench(*wrench);
    if gravity == 0.0 {
        return Err(StaticsError::invalid(
            "gravity".to_owned(),
            gravity,
            "an acceleration above zero, because a mass is weighed by it",
        ));
    }
    let bounded = Bounded::new(robot, pose, &load)?;
    // Of a weight of 1 N.
    let mut direction = robot.weight(pose, 0.0).to_vector() / (robot.platform.mass * gravity);
    direction.fixed_rows_mut::<3>(3).unscale_mut(bounded.problem.characteristic_length);
    let direction = robot.freedoms().of_vector(&direction);
    let components = robot.freedoms().components();
    if direction.norm() <= WEIGHTLESS {
        let found = super::inverse_at(robot, pose, &load, None)?;
        let InverseSolution { tensions, lengths, equilibrium, iterations, residual, .. } = found;
        let (value, blocking) = (f64::INFINITY, Vec::new());
        return Ok(Greatest { value, tensions, lengths, equilibrium, blocking, iterations, residual });
    }
    // The wrench of a tension of 1 N has a norm of at most 2.
    let pull: f64 = bounded.problem.limits.iter().map(|limits| 2.0 * limits.max).sum();
    let heaviest = (pull + bounded.problem.external.norm()) / direction.norm();
    let maximization = Maximization { aim: Aim::Wrench(direction), range: [0.0, heaviest], components };
    let found = maximization.solve(&bounded.problem, &bounded.problem);
    let found = found.map_err(|refusal| bounded.reason(refusal))?;
    let payload = found.value / gravity;
    let load = Load { payload, ..load };
    bounded.greatest(&load, Scale { value: payload, unit: 1.0 / gravity }, found, None)
}

/// By how much every tension can stay away from its limits at a wanted pose, or at each of many, under `load`
/// [N]. A reference of the tensions does not act.
///
/// Cables whose own weight demands more than their least tension rest on what it demands.
///
/// # Errors
/// Those of [`crate::inverse`]; [`StaticsError::NoTensions`] where the load cannot be balanced by any pull of
/// the cables, whatever their limits; [`StaticsError::InverseNotConverged`] where tensions hold the pose and
/// their margin was not found; [`StaticsError::Invalid`] for free coordinates, which leave no choice of the
/// tensions.
pub fn tension_margin<W: Wanted>(
    robot: &Robot,
    wanted: W,
    load: &Load,
) -> W::Results<Result<Greatest, StaticsError>> {
    one_by_one(wanted, |wanted| margin_at(robot, &whole(*wanted)?.pose, load))
}

fn margin_at(robot: &Robot, pose: &Pose, load: &Load) -> Result<Greatest, StaticsError> {
    let mut own = InverseProblem::of_whole_pose(robot, pose, load, None)?;
    let mut greatest = vec![Limit::Max; own.cables()];
    for (i, greatest) in greatest.iter_mut().enumerate() {
        own.bound_by_breaking(i, greatest)?;
    }
    let limits = own.limits.clone();
    let largest = limits.iter().map(|limits| limits.max).fold(own.external.norm(), f64::max);
    // Wider than any margin: strains and the least tensions that the cables' weight demands are left.
    let wide = |limits: &TensionLimits| TensionLimits { min: 1e-9 * limits.min, max: 1.5 * WIDEST * largest };
    let problem = InverseProblem { limits: limits.iter().map(wide).collect(), ..own.clone() };
    let bounded = Bounded { problem, greatest: vec![Limit::Max; limits.len()] }.within_strains()?;
    let range = [-WIDEST * largest, largest];
    let components = robot.freedoms().components();
    let maximization = Maximization { aim: Aim::Margin(limits.clone()), range, components };
    let found = maximization.solve(&bounded.problem, &own)?;
    let scale = Scale { value: found.value, unit: 1.0 };
    bounded.greatest(load, scale, found, Some((&limits, &greatest)))
}

/// Part of a weight of 1 N along the motions that the platform has which is rounding.
const WEIGHTLESS: f64 = 1e-12;

/// Greatest tension over the greatest limit where a margin is looked for.
const WIDEST: f64 = 20.0;

/// A problem whose greatest tensions strain no cable too much.
struct Bounded<'a> {
    problem: InverseProblem<'a>,
    /// What limits the greatest tension of each cable.
    greatest: Vec<Limit>,
}

impl InverseProblem<'_> {
    /// Lowers the greatest tension of cable i to its breaking force, if that is less.
    fn bound_by_breaking(&mut self, i: usize, greatest: &mut Limit) -> Result<(), StaticsError> {
        let limits = self.limits[i];
        let force = self.robot.cables[i].properties.breaking_force;
        if force.is_some_and(|force| force < self.robot.limits(i).max) {
            *greatest = Limit::BreakingForce;
        }
        if let Some(max) = breaking_limit(self.robot, self.pose, i, limits)? {
            self.limits[i].max = max.max(limits.min);
            *greatest = Limit::BreakingForce;
        }
        Ok(())
    }
}

/// A value and the unit of z in it.
struct Scale {
    /// [kg] or [N]
    value: f64,
    /// [kg/N] or [N/N]
    unit: f64,
}

impl<'a> Bounded<'a> {
    fn new(robot: &'a Robot, pose: &'a Pose, load: &'a Load) -> Result<Self, StaticsError> {
        let mut problem = InverseProblem::of_whole_pose(robot, pose, load, None)?;
        let mut greatest = vec![Limit::Max; problem.cables()];
        for (i, greatest) in greatest.iter_mut().enumerate() {
            problem.bound_by_breaking(i, greatest)?;
        }
        Self { problem, greatest }.within_strains()
    }

    fn within_strains(mut self) -> Result<Self, StaticsError> {
        let Self { problem, greatest } = &mut self;
        for (i, greatest) in greatest.iter_mut().enumerate() {
            let limits = problem.limits[i];
            if let Some(max) = strain_limit(problem.robot, problem.pose, i, limits)? {
                problem.limits[i].max = max.max(limits.min);
                *greatest = Limit::Strain;
            }
        }
        Ok(self)
    }

    /// Where all tensions that hold a pose strain a cable too much, the refusal says so.
    fn reason(&self, refusal: StaticsError) -> StaticsError {
        let InverseProblem { robot, pose, load, .. } = self.problem;
        if !self.greatest.contains(&Limit::Strain) {
            return refusal;
        }
        match super::inverse_at(robot, pose, load, None) {
            Err(overstrained @ StaticsError::Overstrained { .. }) => overstrained,
            _ => refusal,
        }
    }

    fn greatest(
        &self,
        load: &Load,
        Scale { value, unit }: Scale,
        found: Maximum,
        drawn: Option<(&[TensionLimits], &[Limit])>,
    ) -> Result<Greatest, StaticsError> {
        let Maximum { ref point, iterations, .. } = found;
        let PoseLengths { lengths, equilibrium } = PoseLengths::new(
            self.problem.pose,
            &point.cables.iter().map(|s| s.fixed.catenary).collect::<Vec<_>>(),
        );
        let direct = DirectProblem::new(self.problem.robot, &lengths, load)?;
        direct.check_strains(&equilibrium)?;
        let residual = Residual::of(&direct, &equilibrium);
        let tensions = point.rows.iter().map(|row| row.tension).collect();
        let blocking = self.blocking(&found, unit, drawn);
        Ok(Greatest { value, tensions, lengths, equilibrium, blocking, iterations, residual })
    }

    /// The limits that the multipliers of the last program belong to.
    fn blocking(
        &self,
        Maximum { point, solution, .. }: &Maximum,
        unit: f64,
        drawn: Option<(&[TensionLimits], &[Limit])>,
    ) -> Vec<Blocking> {
        let n = point.cables.len();
        let mut blocking = Vec::new();
        for (index, (row, cable)) in point.rows.iter().zip(&point.cables).enumerate() {
            // A bound on the chord force, and those on the tension that z draws closer.
            let slope = unit * solution.slopes[index] / row.tension_slope;
            let TensionLimits { min, max } = cable.limits;
            let mut each = vec![(Limit::Min, min, -slope), (self.greatest[index], max, slope)];
            if let Some((limits, greatest)) = drawn {
                let TensionLimits { min, max } = limits[index];
                let gain = |side: usize| -unit * solution.slopes[n + 1 + 2 * index + side];
                each.extend([(Limit::Min, min, gain(0)), (greatest[index], max, gain(1))]);
            }
            let breaking = self.problem.robot.cables[index].properties.breaking_force;
            let own = |(limit, value, gain)| match limit {
                Limit::BreakingForce => (limit, breaking.unwrap_or(value), gain),
                _ => (limit, value, gain),
            };
            let each = each.into_iter().map(own).filter(|(.., gain)| *gain > 0.0);
            blocking.extend(each.map(|(limit, value, gain)| Blocking { index, limit, value, gain }));
        }
        blocking.sort_by(|a: &Blocking, b| b.gain.total_cmp(&a.gain));
        // Less than this is rounding.
        let least = 1e-6 * blocking.first().map_or(0.0, |first| first.gain);
        blocking.retain(|block| block.gain > least);
        blocking
    }
}
