//! One robot whose cables fill the lanes: Newton's method for one direct problem.
//!
//! Slack cables without weight have no shape and resist nothing. They are left out of the lanes, and the
//! equilibrium is refused where one of them would be strained.

use crate::equations::{end, guided_place};
use crate::local::cable::{LaneCable, law};
use crate::local::guided::Guided;
use crate::local::load::PlatformLoad;
use crate::local::newton;
use crate::local::platform::{Layout, LinearizedPlatform, Robots, Scale};
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Residual, rounding_of_closure};
use cdpr_cable::Catenary;
use cdpr_cable::kernel::{GuideTerms, SwivelAxis};
use cdpr_number::lanes::{Lanes, MAX_LANES, Simd, WithSimd, dispatch};
use cdpr_robot::{Matrix3, Pose, Robot, Vector2, Vector3, Vector6, Wrench, orthonormalized};
use nalgebra::Matrix6;
use smallvec::SmallVec;

/// A stable equilibrium to which Newton's method converged.
pub(crate) struct Solved {
    pub(crate) iterations: usize,
    pub(crate) residual: Residual,
    /// The first step (dp, ℓ dφ), which the linearization at the start predicts [m].
    pub(crate) first_step: Vector6<f64>,
    /// Symmetric part of the stiffness, (S5); zero for constrained motions.
    pub(crate) stiffness: Matrix6<f64>,
}

/// Indices of cables, without allocation for 16 of them.
pub(crate) type Pulled = SmallVec<[usize; 16]>;

/// Whether the lanes have the mechanics of this robot: cables of the same material, and a level base under a
/// planar robot.
pub(crate) fn fits_lanes(robot: &Robot) -> bool {
    let Some(of_first) = robot.cables.first().map(law) else { return false };
    // The level frame, which deviates with gravity, constrains other motions than the base frame.
    let inclined = robot.plane.is_some() && robot.gravity.is_vector();
    !inclined && robot.cables.iter().all(|cable| law(cable) == of_first)
}

/// The stable equilibrium to which Newton's method converges from `state`, which it assigns: `None` where it
/// does not converge to one near, with cables that carry forces and are neither folded nor overstrained, or
/// where fewer cables than free motions may leave motions that nothing resists.
pub(crate) fn solve(problem: &DirectProblem, state: &mut Equilibrium) -> Option<Solved> {
    let robot = problem.robot;
    let resisted = problem.pulled(state).len() >= robot.freedoms().count();
    if resisted && fits_lanes(robot) { dispatch(Solve { problem, state }) } else { None }
}

struct Solve<'a, 'b> {
    problem: &'a DirectProblem<'b>,
    state: &'a mut Equilibrium,
}

impl WithSimd for Solve<'_, '_> {
    type Output = Option<Solved>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Self { problem, state } = self;
        let zero = Lanes::splat(simd, 0.0);
        let everywhere = zero.less_or_equal(zero);
        let (mut robots, mut platform, load) = problem.linearized(simd, state);
        let scale = problem.scale(state);
        let (found, residual) = newton::solve(&mut robots, &load, &mut platform, &scale, everywhere);
        if !found.any() {
            return None;
        }
        let pose = problem.pose(&robots);
        if problem.strains_slack(&pose, state) {
            return None;
        }
        problem.take(&robots, pose, state);
        let upper = robots.stiffness(&load, &mut platform);
        let first = &platform.steps.first;
        let mut first_step = Vector6::from_fn(|k, _| first[k].first());
        let mut stiffness = Matrix6::from_fn(|i, j| upper[i.min(j)][i.max(j)].first());
        if let Some(level) = problem.robot.gravity.level() {
            let mut both = Matrix6::zeros();
            [0, 3].into_iter().for_each(|k| both.fixed_view_mut::<3, 3>(k, k).copy_from(level));
            (first_step, stiffness) = (both.tr_mul(&first_step), both.tr_mul(&stiffness) * both);
        }
        Some(Solved {
            iterations: platform.steps.count,
            residual: residual.norms()[0],
            first_step,
            stiffness: problem.robot.freedoms().of_matrix(&stiffness),
        })
    }
}

impl<'a> DirectProblem<'a> {
    /// The robot linearized at an equilibrium that need not be its own, with its cables in the lanes, and
    /// what acts on it.
    #[inline(always)]
    pub(crate) fn linearized<S: Simd>(
        &self,
        simd: S,
        at: &Equilibrium,
    ) -> (Robots<'a, S>, LinearizedPlatform<S>, PlatformLoad<S>) {
        let zero = Lanes::splat(simd, 0.0);
        let robots = self.in_lanes(simd, at);
        let mut platform = LinearizedPlatform::new(zero, robots.cables.len());
        platform.follow_guides(&robots);
        let load = self.load_in_lanes(&robots);
        robots.linearize(&load, &mut platform, zero.less_or_equal(zero));
        (robots, platform, load)
    }

    /// Coordinates in the level frame, which the lanes have.
    #[inline(always)]
    fn in_level_frame(&self, v: Vector3<f64>) -> Vector3<f64> {
        self.robot.gravity.level().map_or(v, |level| level * v)
    }

    /// Lengths that positions are compared with.
    #[inline(always)]
    pub(crate) fn scale(&self, near: &Equilibrium) -> Scale {
        let size = self.size();
        let rounding = rounding_of_closure(size, self.coordinates(&near.pose));
        Scale { size, characteristic_length: self.characteristic_length(), rounding }
    }

    /// A cable that is slack at an equilibrium and has no weight.
    #[inline(always)]
    fn slack(&self, i: usize, at: &Equilibrium) -> Option<Catenary<'a>> {
        let force = at.cable_forces[i];
        let carries_nothing = force == Vector2::zeros();
        carries_nothing.then(|| self.catenary(i, force)).filter(Catenary::is_slack_and_weightless)
    }

    /// The cables that fill the lanes.
    #[inline(always)]
    pub(crate) fn pulled(&self, at: &Equilibrium) -> Pulled {
        (0..self.cables()).filter(|&i| self.slack(i, at).is_none()).collect()
    }

    /// Whether a cable that the lanes do not have would be strained at another pose.
    pub(crate) fn strains_slack(&self, pose: &Pose, at: &Equilibrium) -> bool {
        (0..self.cables()).filter_map(|i| Some((i, self.slack(i, at)?))).any(|(i, slack)| {
            slack.length_at_rest() < slack.cable.straight_length_in_space(end(self.robot, pose, i))
        })
    }

    #[inline(always)]
    fn in_lanes<S: Simd>(&self, simd: S, at: &Equilibrium) -> Robots<'a, S> {
        let (robot, Equilibrium { pose, cable_forces }) = (self.robot, at);
        let pulled = &self.pulled(at);
        let (n, count, zero) = (pulled.len(), Lanes::<S>::COUNT, Lanes::splat(simd, 0.0));
        let in_last = n - (n - 1) / count * count;
        let last = Lanes::from_fn(simd, |lane| lane as f64).less_or_equal(zero.all(in_last as f64 - 0.5));
        let mut robots = Robots {
            layout: Layout::Cables(last),
            freedoms: robot.freedoms(),
            cables: SmallVec::new(),
            position: vector(simd, &self.in_level_frame(pose.position)),
            center: vector(simd, &self.in_level_frame(pose.rotation * robot.platform.center_of_mass)),
            frame: SmallVec::new(),
            weight: zero.all(robot.platform.mass * robot.gravity.magnitude()),
        };
        for k in 0..3 {
            robots.frame.push(vector(simd, &self.in_level_frame(pose.rotation.matrix().column(k).into())));
        }
        // All cables of a robot, however many fill the lanes, have the same equations.
        let is_guided = robot.cables.iter().any(|cable| cable.guide(None).is_some());
        for first in (0..n).step_by(count) {
            let mut values = [[0.0; MAX_LANES]; 11];
            for lane in 0..count {
                // Lanes beyond the last cable repeat it and do not count.
                let i = pulled[(first + lane).min(n - 1)];
                let (properties, force) = (&robot.cables[i].properties, cable_forces[i]);
                let exit = self.in_level_frame(robot.cables[i].exit_point);
                let arm = self.in_level_frame(robot.anchor_arm(pose, i));
                let of_cable = [
                    properties.linear_density * robot.gravity.magnitude(),
                    1.0 / properties.axial_stiffness(),
                    exit.x,
                    exit.y,
                    exit.z,
                    arm.x,
                    arm.y,
                    arm.z,
                    self.lengths[i],
                    force.x,
                    force.y,
                ];
                for (values, value) in values.iter_mut().zip(of_cable) {
                    values[lane] = value;
                }
            }
            let column = |k: usize| Lanes::from_array(simd, &values[k]);
            let mut cable = LaneCable {
                law: law(&robot.cables[0]),
                weight_per_length: column(0),
                axial_flexibility: column(1),
                exit_point: [column(2), column(3), column(4)],
                anchor_arm: [column(5), column(6), column(7)],
                length: column(8),
                force: [column(9), column(10)],
                guided: None,
            };
            if is_guided {
                self.lead(simd, &mut cable, &pulled[first..], at);
            }
            robots.cables.push(cable);
        }
        robots
    }

    /// Gives the first of these cables their guides.
    #[cold]
    #[inline(never)]
    fn lead<S: Simd>(&self, simd: S, cable: &mut LaneCable<'_, S>, cables: &[usize], at: &Equilibrium) {
        let (count, zero) = (Lanes::<S>::COUNT, cable.length.all(0.0));
        let mut values = [[0.0; MAX_LANES]; 9];
        let tilted = (0..self.cables()).any(|i| self.robot.cable(i).leaves_its_plane());
        for lane in 0..count {
            let i = cables[lane.min(cables.len() - 1)];
            let catenary = self.catenary(i, at.cable_forces[i]);
            let ([c, s], free) = guided_place(self.robot, &at.pose, i, catenary);
            let (lead, radius, [x, y, z]) = match catenary.cable.guide {
                None => (0.0, 0.0, [0.0, 0.0, 1.0]),
                Some(guide) => (guide.lead, guide.radius, guide.entry.axis()),
            };
            let of_cable = [lead, radius, x, y, z, c, s, free, radius * z];
            for (values, value) in values.iter_mut().zip(of_cable) {
                values[lane] = value;
            }
        }
        let column = |k: usize| Lanes::from_array(simd, &values[k]);
        let axis = match tilted {
            true => SwivelAxis::Along([column(2), column(3), column(4)]),
            false => SwivelAxis::Vertical(column(8)),
        };
        let mut guided = Guided::new(GuideTerms { lead: column(0), radius: column(1), axis });
        guided.return_to(&[column(5), column(6)], zero.less_or_equal(zero));
        guided.whole_length = cable.length;
        cable.length = column(7);
        cable.guided = Some(guided);
    }

    /// Weight and load on the platform.
    #[inline(always)]
    fn load_in_lanes<S: Simd>(&self, robots: &Robots<'_, S>) -> PlatformLoad<S> {
        let Wrench { force, moment } = self.load.wrench;
        let wrench = Wrench { force: self.in_level_frame(force), moment: self.in_level_frame(moment) };
        PlatformLoad::new(robots.weight + self.load.payload * self.robot.gravity.magnitude(), &wrench)
    }

    /// The pose in the lanes.
    #[inline(always)]
    pub(crate) fn pose<S: Simd>(&self, robots: &Robots<'_, S>) -> Pose {
        let level = self.robot.gravity.level();
        let to_base = |v: Vector3<f64>| level.map_or(v, |level| level.tr_mul(&v));
        let columns = [
            to_base(back(&robots.frame[0])),
            to_base(back(&robots.frame[1])),
            to_base(back(&robots.frame[2])),
        ];
        let rotation = orthonormalized(&Matrix3::from_columns(&columns));
        Pose { position: to_base(back(&robots.position)), rotation }
    }

    /// Assigns a pose and the forces in the lanes to the equilibrium that these began with.
    #[inline(always)]
    pub(crate) fn take<S: Simd>(&self, robots: &Robots<'_, S>, pose: Pose, equilibrium: &mut Equilibrium) {
        let pulled = self.pulled(equilibrium);
        for (indices, cable) in pulled.chunks(Lanes::<S>::COUNT).zip(&robots.cables) {
            let [x, z] = [cable.force[0].to_array(), cable.force[1].to_array()];
            for (lane, &i) in indices.iter().enumerate() {
                equilibrium.cable_forces[i] = Vector2::new(x[lane], z[lane]);
            }
        }
        equilibrium.pose = pose;
    }
}

/// A vector in all lanes.
#[inline(always)]
fn vector<S: Simd>(simd: S, v: &Vector3<f64>) -> [Lanes<S>; 3] {
    [Lanes::splat(simd, v.x), Lanes::splat(simd, v.y), Lanes::splat(simd, v.z)]
}

/// The vector that all lanes have.
#[inline(always)]
fn back<S: Simd>(v: &[Lanes<S>; 3]) -> Vector3<f64> {
    Vector3::new(v[0].first(), v[1].first(), v[2].first())
}
