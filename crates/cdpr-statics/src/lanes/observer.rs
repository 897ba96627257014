//! Deflections of a robot with deviations of its parameters, many at a time.
//!
//! Robots with cables that are linear or have an elastic law, taut or sagging, at their limits or not, behind
//! leads and over pulleys with vertical axes or without, are observed in the lanes of the vector unit
//! (`lanes/chain.rs`), each from the tensions of the nominal robot, and with fewer cables than free motions
//! also from its free coordinates (`lanes/chain/free.rs`). Any other robot is observed by the scalar models, which
//! decide on every failure.
//!
//! Where the sum of squares of the inverse model has several local minima, a perturbed robot is observed in
//! the one that it shares with the nominal robot, as long as it exists. [`deflection`] of the same robot may
//! find another.

mod motions;
mod slopes;

use crate::error::StaticsError;
use crate::inverse::{Branch, FreeBranch, HeldPose, InverseSolution};
use crate::lanes::algebra::{Frame, rotated, six, three};
use crate::lanes::cable::{Guided, LaneCable, Shape};
use crate::lanes::chain::free::FreeMotion;
use crate::lanes::chain::shared::laws;
use crate::lanes::chain::shared::{Choice, Shared};
use crate::lanes::chain::{ChainStart, Outcome, observe};
use crate::lanes::level::LevelFrame;
use crate::lanes::load::PlatformLoad;
use crate::lanes::newton::{Layout, Robots, Scale};
use crate::lanes::reason::ScalarReason;
use crate::lanes::simd::{Lanes, MAX_LANES, Mask, Simd, WithSimd, dispatch};
use crate::loading::{Deflection, deflection, deflection_beside, deflection_near};
use crate::problem::DirectProblem;
use crate::state::{Equilibrium, Load, Residual, rounding_of_closure};
use cdpr_cable::Catenary;
use cdpr_cable::kernel::{Field, LaneGuide, LaneSegment};
use cdpr_robot::{
    Axis, Coordinate, Parameter, ParameterLayout, Pose, Pulley, Robot, RobotCable, TiltAxis, Vector2,
    Vector3, Vector6,
};
pub use motions::ObservationMotion;
pub use slopes::ObservationSlopes;
use smallvec::SmallVec;
use std::array::from_fn;

/// The deflection of one perturbed robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observation {
    /// dp = p_loaded - p_unloaded [m], Eq. (4).
    pub displacement: Vector3<f64>,
    /// Residuals of the equilibrium under the platform's own weight.
    pub unloaded: Residual,
    /// Residuals of the equilibrium with the load added.
    pub loaded: Residual,
    /// Why the scalar models found it; `None` for one found in lanes.
    pub scalar: Option<ScalarReason>,
}

impl Observation {
    /// |dp| [m], which the paper calls the RMS of the static deflection.
    pub fn rms(&self) -> f64 {
        self.displacement.norm()
    }

    fn one_by_one(deflection: &Deflection) -> Self {
        Self {
            displacement: deflection.displacement(),
            unloaded: deflection.unloaded.report.residual,
            loaded: deflection.loaded.report.residual,
            scalar: Some(ScalarReason::OneByOne),
        }
    }
}

/// A robot whose parameters deviate, observed at a wanted pose under a load.
#[derive(Clone, Debug)]
pub struct Observer<'a> {
    robot: &'a Robot,
    pose: Pose,
    load: Load,
    layout: ParameterLayout,
    wanted: Wanted,
    /// What the lanes start from, or why they would find nothing.
    nominal: Result<Nominal, ScalarReason>,
}

/// The inverse model of the nominal robot, from which that of a deviating one is found.
#[derive(Clone, Debug)]
enum Wanted {
    /// At a whole pose; `None` where it has no answer.
    Pose(Option<Branch>),
    /// Where it rests with free coordinates.
    Rest(FreeBranch),
}

/// The nominal robot at the wanted pose.
#[derive(Clone, Debug)]
struct Nominal {
    multipliers: Vector6<f64>,
    /// The free coordinates in the order of [`Coordinate::ALL`].
    free: Vec<Coordinate>,
    /// Segments of the elastic law of each cable; none of a linear one.
    laws: Vec<Vec<LaneSegment>>,
    shared: Shared,
}

impl<'a> Observer<'a> {
    /// An observer of `robot`, wanted at `pose` under its own weight and then loaded with `load`.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] for a load that is not finite, [`StaticsError::Robot`] for an invalid robot.
    pub fn new(robot: &'a Robot, pose: &Pose, load: &Load) -> Result<Self, StaticsError> {
        robot.validate()?;
        load.validate()?;
        let (solution, branch) = Branch::of(robot, pose).ok().unzip();
        let solution = solution.map(|InverseSolution { lengths, equilibrium, multipliers, .. }| {
            (HeldPose { lengths, equilibrium }, multipliers)
        });
        let nominal = Nominal::new(robot, load, solution, &[]);
        let layout = ParameterLayout::of(robot);
        Ok(Self { robot, pose: *pose, load: *load, layout, wanted: Wanted::Pose(branch), nominal })
    }

    /// As [`Observer::new`], of a robot with fewer cables than free motions: the `free` coordinates of the
    /// pose are found where the platform rests, those of deviating robots from those of the nominal one.
    ///
    /// # Errors
    /// Those of [`Observer::new`] and of [`crate::held_at`].
    pub fn with_free(
        robot: &'a Robot,
        pose: &Pose,
        load: &Load,
        free: &[Coordinate],
    ) -> Result<Self, StaticsError> {
        if free.is_empty() {
            return Self::new(robot, pose, load);
        }
        robot.validate()?;
        load.validate()?;
        let branch = FreeBranch::of(robot, pose, free)?;
        let rest = branch.rest();
        let pose = rest.equilibrium.pose;
        let nominal = Nominal::new(robot, load, Some((rest.clone(), Vector6::zeros())), free);
        let layout = ParameterLayout::of(robot);
        Ok(Self { robot, pose, load: *load, layout, wanted: Wanted::Rest(branch), nominal })
    }

    /// The wanted pose; its free coordinates are those of the nominal robot.
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// Deflection of the robot with `deviations` added to its parameters, in the order of [`Parameter::of`].
    ///
    /// # Errors
    /// [`StaticsError`] says why this robot has no deflection.
    pub fn observe(&self, deviations: &[f64]) -> Result<Observation, StaticsError> {
        Ok(Observation::one_by_one(&self.deflection(deviations)?))
    }

    /// Deflections of any number of robots: `deviations` has a row of all parameters for each, one after the
    /// other.
    ///
    /// An answer depends on its own row alone, to the last digit, and agrees with [`Observer::observe`] to
    /// rounding, but for one row in 10^4 of random robots: where a robot has several minima of its
    /// tensions, `observe` takes the one next to the nominal robot's, and this may take another, mostly the
    /// least of all, as [`deflection`] does (docs/VALIDATION.md). [`Observation::scalar`] says which
    /// ones were left to the scalar models, and why. An incomplete last row is a failure.
    pub fn observe_all(&self, deviations: &[f64]) -> Vec<Result<Observation, StaticsError>> {
        self.each(deviations, dispatch, |row, why| {
            Ok(Observation { scalar: Some(why), ..self.observe(row)? })
        })
    }

    /// The answers of the lanes, and of `alone` to rows that they leave, for a reason, or that are incomplete.
    fn each<'o, T>(
        &'o self,
        deviations: &'o [f64],
        in_lanes: impl FnOnce(Batch<'o>) -> Vec<Result<T, ScalarReason>>,
        alone: impl Fn(&[f64], ScalarReason) -> Result<T, StaticsError>,
    ) -> Vec<Result<T, StaticsError>> {
        let rows = deviations.chunks_exact(self.layout.count());
        let rest = rows.remainder();
        let whole = &deviations[..deviations.len() - rest.len()];
        let found = in_lanes(Batch { observer: self, deviations: whole });
        let answers = found.into_iter().zip(rows).map(|(found, row)| found.or_else(|why| alone(row, why)));
        let incomplete = (!rest.is_empty()).then(|| alone(rest, ScalarReason::OneByOne));
        answers.chain(incomplete).collect()
    }

    fn deflection(&self, deviations: &[f64]) -> Result<Deflection, StaticsError> {
        let perturbed = self.robot.perturbed(deviations)?;
        let (robot, offsets) = (&perturbed.robot, &perturbed.tension_offsets);
        match &self.wanted {
            Wanted::Pose(Some(branch)) => deflection_near(branch, robot, &self.pose, offsets, &self.load),
            Wanted::Pose(None) => deflection(robot, &self.pose, offsets, &self.load),
            Wanted::Rest(branch) => deflection_beside(branch, robot, offsets, &self.load),
        }
    }
}

impl Nominal {
    fn new(
        robot: &Robot,
        load: &Load,
        solution: Option<(HeldPose, Vector6<f64>)>,
        free: &[Coordinate],
    ) -> Result<Self, ScalarReason> {
        if let Some(why) = ScalarReason::of_all(robot, free) {
            return Err(why);
        }
        let (HeldPose { lengths, equilibrium }, multipliers) = solution.ok_or(ScalarReason::NominalRobot)?;
        let (pose, tension) = (&equilibrium.pose, equilibrium.tensions().iter().sum());
        let problem = DirectProblem { robot, lengths: &lengths, load: *load };
        let exits = robot.cables.iter().map(|cable| cable.exit_point.norm()).fold(0.0, f64::max);
        let reference = robot.reference();
        let choice = |(i, reference): (usize, &f64)| {
            Choice::new(robot, i, *reference, shape(robot, i, lengths[i], &equilibrium))
        };
        let shared = Shared {
            choices: reference.iter().enumerate().map(choice).collect(),
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
        Ok(Self { multipliers, free, laws: laws(robot), shared })
    }

    /// Why a lane is left that finds no tensions, and one that must not take them.
    fn no_tensions(&self) -> [ScalarReason; 2] {
        match self.free.is_empty() {
            true => [ScalarReason::Tensions, ScalarReason::Folded],
            false => [ScalarReason::FreeCoordinates; 2],
        }
    }
}

/// The shape of a cable at the wanted pose.
pub(crate) fn shape(robot: &Robot, i: usize, unstrained_length: f64, held: &Equilibrium) -> Shape<f64> {
    let force = held.cable_forces[i];
    let cable = Catenary { cable: robot.cable(i), unstrained_length, force };
    let span = robot.span(&held.pose, i);
    let (mut chord, mut height) = (span.norm(), robot.gravity.level().map_or(span, |level| level * span).z);
    let free = cable.free();
    if cable.cable.guide.is_some() {
        let across = (span.norm_squared() - height * height).max(0.0).sqrt();
        let end = Vector2::new(across, height) - cable.leave_point();
        (chord, height) = (end.norm(), end.y);
    }
    let chord_force = chord / free.response().lateral_flexibility;
    Shape {
        tangent: [force.x / free.exit_tension(), free.exit_vertical_force() / free.exit_tension()],
        chord_force,
        sag_force: force.y - chord_force * height / chord,
        longer: free.unstrained_length - chord,
    }
}

/// Rows of deviations for the lanes.
struct Batch<'a> {
    observer: &'a Observer<'a>,
    deviations: &'a [f64],
}

impl WithSimd for Batch<'_> {
    type Output = Vec<Result<Observation, ScalarReason>>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Observer { robot, pose, load, layout, nominal, .. } = self.observer;
        let parameters = layout.count();
        let rows = self.deviations.len() / parameters;
        let nominal = match nominal {
            Ok(nominal) => nominal,
            Err(why) => return vec![Err(*why); rows],
        };
        let mut found = Vec::with_capacity(rows);
        for rows in self.deviations.chunks(Lanes::<S>::COUNT * parameters) {
            let count = rows.len() / parameters;
            let rows = Rows::new(simd, rows, layout);
            let (mut start, level, valid) = rows.robots(robot, pose, load, nominal);
            let outcome = observe(&mut start, &nominal.shared, None);
            let answers = read(&outcome, level.as_ref(), valid, nominal.no_tensions());
            found.extend(answers.into_iter().take(count));
        }
        found
    }
}

/// The observation in each lane, or the first link that failed; robots are `sound`, and their axes `upright`.
#[inline(always)]
fn read<S: Simd>(
    outcome: &Outcome<S>,
    level: Option<&LevelFrame<S>>,
    [sound, upright]: [Mask<S>; 2],
    [no_tensions, none_to_take]: [ScalarReason; 2],
) -> [Result<Observation, ScalarReason>; MAX_LANES] {
    let [converged, unfolded, held, standing, answered] = outcome.passed;
    let links = [
        (sound, ScalarReason::InvalidRobot),
        (upright, ScalarReason::Pulleys),
        (converged, no_tensions),
        (unfolded, none_to_take),
        (held, ScalarReason::Lengths),
        (standing, ScalarReason::Unloaded),
        (answered, ScalarReason::Loaded),
    ];
    let mut first = outcome.displacement[0].all(links.len() as f64);
    for (i, (passed, _)) in links.iter().enumerate().rev() {
        first = passed.select(first, first.all(i as f64));
    }
    let first_failed = first.to_array();
    let displacement = match level {
        None => outcome.displacement,
        Some(level) => level.to_base(&outcome.displacement),
    };
    let displacement = three!(|k| displacement[k].to_array());
    let (unloaded, loaded) = (outcome.unloaded.norms(), outcome.loaded.norms());
    from_fn(|lane| match links.get(first_failed[lane] as usize) {
        Some((_, why)) => Err(*why),
        None => Ok(Observation {
            displacement: Vector3::from_fn(|k, _| displacement[k][lane]),
            unloaded: unloaded[lane],
            loaded: loaded[lane],
            scalar: None,
        }),
    })
}

/// Rows of deviations, one for each lane; lanes without a row of their own repeat the last one.
struct Rows<'a, S> {
    simd: S,
    rows: [&'a [f64]; MAX_LANES],
    layout: &'a ParameterLayout,
}

impl<'a, S: Simd> Rows<'a, S> {
    #[inline(always)]
    fn new(simd: S, rows: &'a [f64], layout: &'a ParameterLayout) -> Self {
        let (parameters, mut each) = (layout.count(), [rows; MAX_LANES]);
        let last = rows.len() - parameters;
        for (lane, row) in each.iter_mut().enumerate() {
            *row = &rows[last.min(lane * parameters)..];
        }
        Self { simd, rows: each, layout }
    }

    #[inline(always)]
    fn all(&self, value: f64) -> Lanes<S> {
        Lanes::splat(self.simd, value)
    }

    /// One parameter, in the order of [`Parameter::of`]: its nominal value and deviations.
    #[inline(always)]
    fn parameter(&self, index: usize, nominal: f64) -> Lanes<S> {
        let mut values = [0.0; MAX_LANES];
        for (value, row) in values[..Lanes::<S>::COUNT].iter_mut().zip(&self.rows) {
            *value = row[index];
        }
        Lanes::from_array(self.simd, &values) + nominal
    }

    #[inline(always)]
    fn point(&self, first: usize, nominal: &Vector3<f64>) -> [Lanes<S>; 3] {
        [
            self.parameter(first, nominal.x),
            self.parameter(first + 1, nominal.y),
            self.parameter(first + 2, nominal.z),
        ]
    }

    /// The perturbed robots in their level frames, these frames where they are not the base frame, and the
    /// lanes whose robot is valid, and whose pulleys have vertical axes.
    #[inline(always)]
    fn robots<'n>(
        &self,
        robot: &Robot,
        pose: &Pose,
        load: &Load,
        nominal: &'n Nominal,
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
                cables: SmallVec::with_capacity(n),
                position: three!(|k| self.all(pose.position[k])),
                center: rotated(&frame, &self.point(layout.center_of_mass(), &robot.platform.center_of_mass)),
                frame: SmallVec::new(),
                weight: mass * gravity,
            },
            offsets: Vec::with_capacity(n),
            multipliers: six!(|k| self.all(nominal.multipliers[k])),
            payload: PlatformLoad::new(gravity * load.payload, &load.wrench),
            free: self.motions(pose, &nominal.free),
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
                law: &nominal.laws[i],
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
                let (guide, valid, vertical) = self.guide(i, cable, level.as_ref());
                start.robots.cables[i].guided = Some(Box::new(Guided { guide, whole_length: zero }));
                (sound, upright) = (sound & valid, upright & vertical);
            }
        }
        if let Some(level) = &level {
            start.rotate(level);
        }
        (start, level, [sound, upright])
    }

    /// The motions of free coordinates.
    #[inline(always)]
    fn motions(&self, pose: &Pose, free: &[Coordinate]) -> Vec<FreeMotion<S>> {
        let (_, pitch, yaw) = pose.rotation.euler_angles();
        let mut motions = Vec::with_capacity(free.len());
        for coordinate in free {
            let motion = coordinate.motion(yaw, pitch);
            motions.push(match coordinate.is_angle() {
                false => FreeMotion::Along(three!(|k| self.all(motion[k]))),
                true => FreeMotion::About(three!(|k| self.all(motion[3 + k]))),
            });
        }
        motions
    }

    /// The platform frame at the wanted pose by its columns, in the level frames.
    #[inline(always)]
    fn frame(&self, pose: &Pose, level: Option<&LevelFrame<S>>) -> Frame<S> {
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
    ) -> (LaneGuide<Lanes<S>>, Mask<S>, Mask<S>) {
        let zero = self.all(0.0);
        let lead = self.further(Parameter::Lead(i), cable.lead);
        let mut guide = LaneGuide { lead, radius: zero, signed_radius: zero };
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
            guide = LaneGuide { radius, signed_radius: upwards.select(radius, -radius), ..guide };
        }
        (guide, zero.less_or_equal(guide.lead) & zero.less_or_equal(guide.radius), vertical)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::simd::Scalar;

    #[test]
    fn the_vector_unit_changes_no_bit() {
        let robot = Robot::from_json(include_str!("../../../../data/robots/caroca.json")).unwrap();
        let tilted = Robot { gravity: Vector3::new(0.6, -0.3, -9.7).into(), ..robot.clone() };
        let mut guided = robot.clone();
        for (i, cable) in guided.cables.iter_mut().enumerate() {
            cable.pulley = Some(Pulley { radius: 0.045, axis: Vector3::z() });
            cable.lead = i as f64;
        }
        for (robot, parameters) in [(&robot, 62), (&tilted, 65), (&guided, 62 + 8 + 7 + 16)] {
            for pose in [Pose::at(0.0, 0.0, 1.75), Pose::at(3.2, 1.7, 3.0)] {
                let observer = &Observer::new(robot, &pose, &Load::payload(50.0)).unwrap();
                // A sawtooth through the ranges of the paper's Table 3; for gravity 0.1 m/s².
                let half = |parameter: usize| match parameter {
                    0 => 18.0,
                    1 => 0.01,
                    2 => 1.8e10,
                    3..27 | 51..54 => 0.015,
                    27..51 => 0.03,
                    54..62 => 15.0,
                    62..77 if parameters > 65 => 0.001,
                    77.. => 0.0,
                    _ => 0.1,
                };
                let deviations: Vec<f64> = (0..parameters * 100)
                    .map(|i| half(i % parameters) * ((i * 37 % 101) as f64 / 50.0 - 1.0))
                    .collect();
                let scalar = Batch { observer, deviations: &deviations }.with_simd(Scalar);
                let widest = dispatch(Batch { observer, deviations: &deviations });
                assert_eq!(scalar, widest);
                assert!(scalar.iter().filter(|found| found.is_ok()).count() > 90);
            }
        }
    }

    #[test]
    fn the_vector_unit_changes_no_bit_of_robots_with_free_coordinates() {
        let mut robot = Robot::from_json(include_str!("../../../../data/robots/cogiro.json")).unwrap();
        robot.cables = [0, 2, 4, 6].map(|i| robot.cables[i].clone()).to_vec();
        let tilted = Robot { gravity: Vector3::new(0.1, -0.2, -9.8).into(), ..robot.clone() };
        let mut guided = robot.clone();
        for cable in &mut guided.cables {
            (cable.pulley, cable.lead) = (Some(Pulley { radius: 0.045, axis: Vector3::z() }), 1.0);
        }
        for robot in [&robot, &tilted, &guided] {
            let (pose, free) = (Pose::at(1.0, 0.5, 2.0), [Coordinate::Pitch, Coordinate::Roll]);
            let observer = &Observer::with_free(robot, &pose, &Load::payload(9.0), &free).unwrap();
            let half = Parameter::of(robot).into_iter().map(|parameter| match parameter {
                Parameter::Mass => 1.0,
                Parameter::LinearDensity => 0.001,
                Parameter::YoungsModulus => 1e9,
                Parameter::Tilt(..) => 0.0,
                _ => 0.001,
            });
            let half: Vec<f64> = half.collect();
            let deviations: Vec<f64> = (0..half.len() * 100)
                .map(|i| half[i % half.len()] * ((i * 37 % 101) as f64 / 50.0 - 1.0))
                .collect();
            let scalar = Batch { observer, deviations: &deviations }.with_simd(Scalar);
            let widest = dispatch(Batch { observer, deviations: &deviations });
            assert_eq!(scalar, widest);
            assert!(scalar.iter().filter(|found| found.is_ok()).count() > 90);
        }
    }
}
