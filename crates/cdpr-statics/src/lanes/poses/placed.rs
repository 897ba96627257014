//! One robot at several poses, one in each lane, in its level frame.

use crate::lanes::chain::shared::{Choice, Shared};
use crate::lanes::reason::{ScalarReason, has_tilted_axes};
use crate::local::cable::{LaneCable, Shape, law};
use crate::local::guided::Guided;
use crate::local::platform::{Layout, Robots, Scale};
use crate::state::{Load, rounding_of_closure};
use cdpr_cable::kernel::{GuideTerms, SwivelAxis};
use cdpr_number::Number;
use cdpr_number::dense::{Frame, rotated};
use cdpr_number::lanes::{Lanes, MAX_LANES, Simd};
use cdpr_number::three;
use cdpr_robot::{Matrix3, Pose, Robot, Vector3, Vector6, Wrench};
use smallvec::SmallVec;

/// Forces that changes are compared with, relative to the sum of tensions: steps end when even a small
/// tension is exact to nine digits.
const NARROWER: f64 = 0.01;

/// A robot whose poses fill the lanes.
pub(crate) struct PlacedRobot<'a> {
    pub(crate) robot: &'a Robot,
    /// Whether pulleys have tilted axes.
    pub(crate) is_tilted: bool,
    /// Lengths that positions are compared with, at any pose.
    pub(crate) scale: Scale,
}

impl<'a> PlacedRobot<'a> {
    /// `None` where lanes lack the robot's mechanics, or the least norm of tensions that it chooses.
    pub(crate) fn of(robot: &'a Robot) -> Option<Self> {
        if !robot.distribution.is_smooth() || ScalarReason::of_all(robot, &[]).is_some() {
            return None;
        }
        let exits = || robot.cables.iter().map(|cable| cable.exit_point);
        let size = exits().map(|b| exits().map(|c| (b - c).norm()).fold(0.0, f64::max)).fold(0.0, f64::max);
        let farthest = exits().map(|exit| exit.norm()).fold(0.0, f64::max);
        let scale = Scale {
            size,
            characteristic_length: robot.platform_size().max(1e-3 * size),
            // Of two cables that begin as far apart one has half of this length. The last steps keep their
            // stiffness, and those of slack cables end at the bound: a fifth of it.
            rounding: rounding_of_closure(0.1 * size, farthest),
        };
        Some(Self { robot, is_tilted: has_tilted_axes(robot), scale })
    }

    /// What its poses under `load` share, from whatever shape their cables begin.
    pub(crate) fn shared(&self, load: &Load) -> Shared {
        let Self { robot, scale, .. } = *self;
        let reference = robot.reference();
        let nowhere =
            Shape { turn: [1.0, 0.0], tangent: [0.0; 2], chord_force: 0.0, sag_force: 0.0, longer: 0.0 };
        let choice = |(i, reference): (usize, &f64)| Choice::new(robot, i, *reference, nowhere);
        let choices: Vec<_> = reference.iter().enumerate().map(choice).collect();
        // No more than the sum of all tensions, or twice as much.
        let least: f64 = choices.iter().map(|choice| choice.limits.min).sum();
        let weight = (robot.platform.mass + load.payload) * robot.gravity.magnitude();
        Shared {
            choices,
            tension: NARROWER * (weight + least),
            forces: weight + least,
            scale,
            may_be_slack: true,
            ground: Shared::ground(robot),
        }
    }

    /// Components in the level frame of a vector in the base frame.
    pub(crate) fn to_level(&self, v: Vector3<f64>) -> Vector3<f64> {
        self.robot.gravity.level().map_or(v, |level| level * v)
    }

    /// Components in the base frame of a vector in the level frame.
    pub(crate) fn to_base(&self, v: Vector3<f64>) -> Vector3<f64> {
        self.robot.gravity.level().map_or(v, |level| level.tr_mul(&v))
    }

    /// Components in the level frame of a wrench in the base frame.
    pub(crate) fn wrench_to_level(&self, wrench: &Wrench) -> Wrench {
        Wrench { force: self.to_level(wrench.force), moment: self.to_level(wrench.moment) }
    }

    /// A wrench or a twist after `turn`.
    pub(crate) fn both(
        &self,
        turn: fn(&Self, Vector3<f64>) -> Vector3<f64>,
        v: &Vector6<f64>,
    ) -> Vector6<f64> {
        let [first, second] = [0, 3].map(|row| turn(self, v.fixed_rows::<3>(row).into()));
        Vector6::new(first.x, first.y, first.z, second.x, second.y, second.z)
    }

    /// The robot at poses, lane by lane, with the columns of its platform frames; its cables have neither
    /// force nor length yet. Lanes without a pose of their own repeat the last one.
    #[inline(always)]
    pub(crate) fn at<S: Simd>(&self, simd: S, poses: &[&Pose]) -> (Robots<'_, S>, Frame<S>) {
        let Self { robot, .. } = *self;
        let all = |value: f64| Lanes::splat(simd, value);
        let point = |v: Vector3<f64>| three!(|k| all(v[k]));
        let mut positions = [Vector3::zeros(); MAX_LANES];
        let mut rotations = [Matrix3::zeros(); MAX_LANES];
        for (lane, (position, rotation)) in positions.iter_mut().zip(&mut rotations).enumerate() {
            let pose = poses[lane.min(poses.len() - 1)];
            *position = self.to_level(pose.position);
            let turned = pose.rotation.matrix();
            *rotation = robot.gravity.level().map_or(*turned, |level| level * turned);
        }
        let frame =
            three!(|column| three!(|row| Lanes::from_fn(simd, |lane| rotations[lane][(row, column)])));
        let gravity = robot.gravity.magnitude();
        let mut robots = Robots {
            layout: Layout::Robots,
            freedoms: robot.freedoms(),
            cables: SmallVec::with_capacity(robot.cables.len()),
            position: three!(|k| Lanes::from_fn(simd, |lane| positions[lane][k])),
            center: rotated(&frame, &point(robot.platform.center_of_mass)),
            frame: SmallVec::new(),
            weight: all(robot.platform.mass * gravity),
        };
        for cable in &robot.cables {
            let properties = &cable.properties;
            let guide = cable.guide(robot.gravity.level()).map(|guide| {
                let [x, y, z] = guide.entry.axis();
                let axis = match self.is_tilted && guide.radius > 0.0 {
                    true => SwivelAxis::Along([all(x), all(y), all(z)]),
                    false => SwivelAxis::Vertical(all(guide.radius * z)),
                };
                GuideTerms { lead: all(guide.lead), radius: all(guide.radius), axis }
            });
            robots.cables.push(LaneCable {
                law: law(cable),
                weight_per_length: all(properties.linear_density * gravity),
                axial_flexibility: all(properties.axial_stiffness()).recip(),
                exit_point: point(self.to_level(cable.exit_point)),
                anchor_arm: rotated(&frame, &point(cable.anchor_point)),
                length: all(0.0),
                force: [all(0.0); 2],
                guided: guide.map(Guided::new),
            });
        }
        (robots, frame)
    }
}

/// A number of each lane; lanes without one of their own repeat the last one.
#[inline(always)]
pub(crate) fn each<S: Simd, T>(simd: S, items: &[T], value: &dyn Fn(&T) -> f64) -> Lanes<S> {
    let last = items.len() - 1;
    Lanes::from_fn(simd, |lane| value(&items[lane.min(last)]))
}
