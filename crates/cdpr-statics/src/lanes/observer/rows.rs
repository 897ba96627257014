//! The nominal robot, and robots that deviate from it, one in each lane.

use crate::equations::Ends;
use crate::inverse::PoseLengths;
use crate::lanes::chain::free::FreeMotion;
use crate::lanes::chain::shared::{Choice, Shared};
use crate::lanes::chain::{ChainStart, Stage};
use crate::lanes::level::LevelFrame;
use crate::lanes::reason::{ScalarReason, has_tilted_axes};
use crate::local::cable::{LaneCable, Shape, law};
use crate::local::freedoms::constrain;
use crate::local::guided::Guided;
use crate::local::load::PlatformLoad;
use crate::local::platform::{Layout, Robots, Scale};
use crate::problem::DirectProblem;
use crate::state::{Load, rounding_of_closure};
use cdpr_cable::kernel::{GuideTerms, SwivelAxis};
use cdpr_number::Number;
use cdpr_number::dense::{Frame, rotated};
use cdpr_number::lanes::{Lanes, MAX_LANES, Mask, Simd};
use cdpr_number::{six, three};
use cdpr_robot::{
    Axis, Coordinate, Parameter, ParameterLayout, Pose, Pulley, Robot, RobotCable, Rotation3, TiltAxis,
    Vector3, Vector6,
};
use nalgebra::Unit;
use smallvec::SmallVec;
use std::array::from_fn;

/// What deviating robots may change of a tension and of the least one of its span, as a ratio.
const DEVIATION: f64 = 2.0;

/// The nominal robot at the wanted pose.
#[derive(Clone, Debug)]
pub(crate) struct Nominal {
    multipliers: Vector6<f64>,
    /// The free coordinates in the order of [`Coordinate::ALL`].
    pub(crate) free: Vec<Coordinate>,
    /// Whether pulleys have tilted axes.
    pub(crate) is_tilted: bool,
    pub(crate) shared: Shared,
}

impl Nominal {
    pub(crate) fn new(
        robot: &Robot,
        load: &Load,
        solution: Option<(PoseLengths, Vector6<f64>)>,
        free: &[Coordinate],
    ) -> Result<Self, ScalarReason> {
        if let Some(why) = ScalarReason::of_all(robot, free) {
            return Err(why);
        }
        let (PoseLengths { lengths, equilibrium }, multipliers) =
            solution.ok_or(ScalarReason::NominalRobot)?;
        let (pose, tensions) = (&equilibrium.pose, equilibrium.tensions());
        let tension = tensions.iter().sum();
        let problem = DirectProblem::new(robot, &lengths, load).map_err(|_| ScalarReason::NominalRobot)?;
        let exits = robot.cables.iter().map(|cable| cable.exit_point.norm()).fold(0.0, f64::max);
        let reference = robot.reference();
        let choice = |(i, reference): (usize, &f64)| {
            Choice::new(robot, i, *reference, Shape::of(robot, i, lengths[i], &equilibrium))
        };
        let near_least = |i: usize| tensions[i] <= DEVIATION * Ends::of(robot, pose, i).floor();
        let shared = Shared {
            may_be_slack: (0..robot.cables.len()).any(near_least),
            choices: reference.iter().enumerate().map(choice).collect(),
            ground: Shared::ground(robot),
            tension,
            forces: tension,
            scale: Scale {
                size: problem.size(),
                characteristic_length: problem.characteristic_length(),
                rounding: rounding_of_closure(problem.size(), pose.position.norm() + exits),
            },
        };
        let mut free = free.to_vec();
        free.sort_unstable();
        Ok(Self { multipliers, free, is_tilted: has_tilted_axes(robot), shared })
    }

    /// The axes with which lanes are evaluated, one after the other, until each lane has its own.
    pub(crate) fn axes(&self) -> &'static [Axes] {
        if self.is_tilted { &[Axes::Any] } else { &[Axes::Vertical, Axes::Any] }
    }

    /// Why a lane is left that fails at a stage.
    pub(crate) fn why(&self, stage: Stage) -> ScalarReason {
        match stage {
            Stage::Parameters => ScalarReason::InvalidRobot,
            Stage::Axes => ScalarReason::Derivatives,
            Stage::Tensions | Stage::Limits if !self.free.is_empty() => ScalarReason::FreeCoordinates,
            Stage::Tensions => ScalarReason::Tensions,
            Stage::Limits => ScalarReason::Folded,
            Stage::Lengths => ScalarReason::Lengths,
            Stage::Unloaded => ScalarReason::Unloaded,
            Stage::Loaded => ScalarReason::Loaded,
        }
    }
}

/// The swivel axes of the pulleys in all lanes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Axes {
    /// Vertical ones: other lanes are invalid.
    Vertical,
    /// Any.
    Any,
}

/// Rows of deviations, one for each lane; lanes without a row of their own repeat the last one.
pub(crate) struct Rows<'a, S> {
    simd: S,
    rows: [&'a [f64]; MAX_LANES],
    pub(crate) layout: &'a ParameterLayout,
}

impl<'a, S: Simd> Rows<'a, S> {
    #[inline(always)]
    pub(crate) fn new(simd: S, rows: &'a [f64], layout: &'a ParameterLayout) -> Self {
        let (parameters, mut each) = (layout.count(), [rows; MAX_LANES]);
        let last = rows.len() - parameters;
        for (lane, row) in each.iter_mut().enumerate() {
            *row = &rows[last.min(lane * parameters)..];
        }
        Self { simd, rows: each, layout }
    }

    #[inline(always)]
    pub(crate) fn all(&self, value: f64) -> Lanes<S> {
        Lanes::splat(self.simd, value)
    }

    /// One parameter, in the order of [`Parameter::of`]: its nominal value and deviations.
    #[inline(always)]
    pub(crate) fn parameter(&self, index: usize, nominal: f64) -> Lanes<S> {
        let mut values = [0.0; MAX_LANES];
        for (value, row) in values[..Lanes::<S>::COUNT].iter_mut().zip(&self.rows) {
            *value = row[index];
        }
        Lanes::from_array(self.simd, &values) + nominal
    }

    #[inline(always)]
    pub(crate) fn point(&self, first: usize, nominal: &Vector3<f64>) -> [Lanes<S>; 3] {
        [
            self.parameter(first, nominal.x),
            self.parameter(first + 1, nominal.y),
            self.parameter(first + 2, nominal.z),
        ]
    }

    /// The perturbed robots in their level frames, these frames where they are not the base frame, and the
    /// lanes whose robot is valid, and whose pulleys have such axes.
    #[inline(always)]
    pub(crate) fn robots<'n>(
        &self,
        robot: &'n Robot,
        pose: &Pose,
        load: &Load,
        nominal: &'n Nominal,
        axes: Axes,
    ) -> (ChainStart<'n, S>, Option<LevelFrame<S>>, [Mask<S>; 2]) {
        let n = robot.cables.len();
        let (layout, frame) = (self.layout, self.frame(pose, None));
        let (zero, tiny) = (self.all(0.0), self.all(f64::MIN_POSITIVE));
        let mass = self.parameter(layout.mass(), robot.platform.mass);
        let mut sound = tiny.less_or_equal(mass);
        let (level, gravity) = match layout.index(Parameter::Gravity(Axis::X)) {
            None => (None, self.all(robot.gravity.magnitude())),
            Some(first) => {
                let vector = self.point(first, &robot.gravity.vector());
                let (level, magnitude, directed) = LevelFrame::of_gravity(&vector);
                sound = sound & directed;
                (Some(level), magnitude)
            }
        };
        let mut start = ChainStart {
            robots: Robots {
                layout: Layout::Robots,
                freedoms: robot.freedoms(),
                cables: SmallVec::with_capacity(n),
                position: three!(|k| self.all(pose.position[k])),
                center: rotated(&frame, &self.point(layout.center_of_mass(), &robot.platform.center_of_mass)),
                frame: SmallVec::new(),
                weight: mass * gravity,
            },
            offsets: Vec::with_capacity(n),
            multipliers: six!(|k| self.all(nominal.multipliers[k])),
            payload: PlatformLoad::new(gravity * load.payload, &load.wrench),
            free: self.motions(robot, pose, &nominal.free),
        };
        for (i, cable) in robot.cables.iter().enumerate() {
            let density = self.parameter(layout.linear_density(), cable.properties.linear_density);
            let modulus = self.parameter(layout.youngs_modulus(), cable.properties.youngs_modulus);
            let offset = self.parameter(layout.tension_offset(i), 0.0);
            // NaN is not equal to itself.
            sound = sound
                & zero.less_or_equal(density)
                & tiny.less_or_equal(modulus)
                & offset.less_or_equal(offset);
            start.offsets.push(offset);
            start.robots.cables.push(LaneCable {
                law: law(cable),
                weight_per_length: density * gravity,
                axial_flexibility: (modulus * cable.properties.section).recip(),
                exit_point: self.point(layout.exit_point(i), &cable.exit_point),
                anchor_arm: rotated(&frame, &self.point(layout.anchor_point(i), &cable.anchor_point)),
                length: zero,
                force: [zero; 2],
                guided: None,
            });
        }
        let mut upright = zero.less_or_equal(zero);
        for (i, cable) in robot.cables.iter().enumerate() {
            if cable.pulley.is_some() || cable.lead != 0.0 {
                let (mut guide, valid, vertical) = self.guide(i, cable, level.as_ref());
                sound = sound & valid;
                match (axes, &cable.pulley) {
                    (Axes::Any, Some(pulley)) => {
                        guide.axis = self.axis(i, pulley, guide.radius, level.as_ref());
                    }
                    _ => upright = upright & vertical,
                }
                start.robots.cables[i].guided = Some(Guided::new(guide));
            }
        }
        start.multipliers = constrain(robot.freedoms(), start.multipliers);
        if let Some(level) = &level {
            start.rotate(level);
        }
        (start, level, [sound, upright])
    }

    /// The motions of free coordinates.
    #[inline(always)]
    fn motions(&self, robot: &Robot, pose: &Pose, free: &[Coordinate]) -> Vec<FreeMotion<S>> {
        let mut motions = Vec::with_capacity(free.len());
        for coordinate in free {
            let motion = robot.motion(*coordinate, pose);
            motions.push(match coordinate.is_angle() {
                false => FreeMotion::Along(three!(|k| self.all(motion[k]))),
                true => FreeMotion::About(three!(|k| self.all(motion[3 + k]))),
            });
        }
        motions
    }

    /// The platform frame at the wanted pose by its columns, in the level frames.
    #[inline(always)]
    pub(crate) fn frame(&self, pose: &Pose, level: Option<&LevelFrame<S>>) -> Frame<S> {
        from_fn(|k| {
            let column = three!(|row| self.all(pose.rotation.matrix()[(row, k)]));
            level.map_or(column, |level| level.to_level(&column))
        })
    }

    /// A parameter that not every robot has.
    #[inline(always)]
    fn further(&self, parameter: Parameter, nominal: f64) -> Lanes<S> {
        match self.layout.index(parameter) {
            Some(index) => self.parameter(index, nominal),
            None => self.all(nominal),
        }
    }

    /// The guide of a cable, and the lanes in which it is valid, and vertical.
    #[inline(always)]
    fn guide(
        &self,
        i: usize,
        cable: &RobotCable,
        level: Option<&LevelFrame<S>>,
    ) -> (GuideTerms<Lanes<S>>, Mask<S>, Mask<S>) {
        let zero = self.all(0.0);
        let lead = self.further(Parameter::Lead(i), cable.lead);
        let mut guide = GuideTerms { lead, radius: zero, axis: SwivelAxis::Vertical(zero) };
        let mut vertical = zero.less_or_equal(zero);
        if let Some(Pulley { radius, axis }) = cable.pulley {
            let radius = self.further(Parameter::PulleyRadius(i), radius);
            let axis = three!(|k| self.all(axis[k]));
            let [x, y, z] = match level {
                None => axis,
                Some(level) => level.to_level(&axis),
            };
            let tolerance = z * Pulley::VERTICAL;
            vertical = (x * x + y * y).less_or_equal(tolerance * tolerance);
            for about in TiltAxis::ALL {
                let tilt = self.further(Parameter::Tilt(i, about), 0.0);
                vertical = vertical & tilt.less_or_equal(zero) & zero.less_or_equal(tilt);
            }
            vertical = vertical | radius.less_or_equal(zero);
            let upwards = zero.less_or_equal(z);
            let axis = SwivelAxis::Vertical(upwards.select(radius, -radius));
            guide = GuideTerms { radius, axis, ..guide };
        }
        (guide, zero.less_or_equal(guide.lead) & zero.less_or_equal(guide.radius), vertical)
    }
}

impl<'a, S: Simd> Rows<'a, S> {
    /// The swivel axis of a pulley of this radius [m], of any direction: as unit vectors in the level frames.
    #[cold]
    #[inline(never)]
    fn axis(
        &self,
        i: usize,
        pulley: &Pulley,
        radius: Lanes<S>,
        level: Option<&LevelFrame<S>>,
    ) -> SwivelAxis<Lanes<S>> {
        let (mut axes, nominal) = ([[0.0; MAX_LANES]; 3], pulley.axis.normalize());
        let tilts =
            TiltAxis::ALL.map(|about| (about.of(pulley), self.layout.index(Parameter::Tilt(i, about))));
        for (lane, row) in self.rows[..Lanes::<S>::COUNT].iter().enumerate() {
            let mut axis = nominal;
            for (about, index) in &tilts {
                if let Some(index) = index {
                    axis = Rotation3::from_axis_angle(&Unit::new_unchecked(*about), row[*index]) * axis;
                }
            }
            for k in 0..3 {
                axes[k][lane] = axis[k];
            }
        }
        let axis = three!(|k| Lanes::from_array(self.simd, &axes[k]));
        let axis = level.map_or(axis, |level| level.to_level(&axis));
        // A pulley without radius does not matter.
        let (none, zero) = (radius.less_or_equal(radius.all(0.0)), radius.all(0.0));
        SwivelAxis::Along([
            none.select(zero, axis[0]),
            none.select(zero, axis[1]),
            none.select(zero + 1.0, axis[2]),
        ])
    }
}

impl<S: Simd> ChainStart<'_, S> {
    /// Rotates the robots from the base frame into their level frames.
    #[inline(always)]
    fn rotate(&mut self, level: &LevelFrame<S>) {
        let Self { robots, multipliers, payload, free, .. } = self;
        for motion in free {
            *motion.axis() = level.to_level(motion.axis());
        }
        for cable in &mut robots.cables {
            cable.exit_point = level.to_level(&cable.exit_point);
            cable.anchor_arm = level.to_level(&cable.anchor_arm);
        }
        robots.position = level.to_level(&robots.position);
        robots.center = level.to_level(&robots.center);
        *multipliers = level.both_to_level(multipliers);
        payload.force = level.to_level(&payload.force);
        if let Some(moment) = &mut payload.moment {
            *moment = level.to_level(moment);
        }
    }
}
