//! The inverse model at poses of one robot, one in each lane.

use crate::equations::Span;
use crate::inverse::InverseSolution;
use crate::lanes::chain::lengths::find_lengths;
use crate::lanes::chain::minimum::is_least;
use crate::lanes::chain::shared::Shared;
use crate::lanes::chain::tensions::{CableTension, Distribute, Distributed, SAGGING};
use crate::lanes::fixed_ends::FixedEnds;
use crate::lanes::poses::placed::{PlacedRobot, each};
use crate::local::cable::Shape;
use crate::local::freedoms::constrain;
use crate::local::load::PlatformLoad;
use crate::local::platform::{LinearizedPlatform, Robots};
use crate::state::{Equilibrium, Load, Residual};
use cdpr_number::dense::{Lanes2, Lanes6};
use cdpr_number::lanes::{Lanes, MAX_LANES, Mask, Simd};
use cdpr_number::six;
use cdpr_number::vector::{dot, wrench};
use cdpr_robot::{Pose, Vector2, Vector3, Vector6};
use cdpr_tension::Bound;
use smallvec::SmallVec;

/// What all poses have in common.
pub(crate) struct Setting<'a> {
    pub(crate) placed: PlacedRobot<'a>,
    pub(crate) load: &'a Load,
    pub(crate) shared: Shared,
}

/// A result, from which the next one is found.
#[derive(Clone)]
pub(crate) struct Near {
    /// Of the platform [m].
    pub(crate) position: Vector3<f64>,
    pub(crate) shapes: Vec<Shape<f64>>,
    /// λ in the level frame.
    pub(crate) multipliers: Vector6<f64>,
}

/// A pose with what its lane starts from.
pub(crate) struct Asked<'a> {
    pub(crate) pose: &'a Pose,
    pub(crate) near: &'a Near,
}

/// Solution of one lane, its equations still to be checked, and what it is for the next pose.
pub(crate) type LaneSolution = (InverseSolution, Near);

/// Poses, one for each lane; lanes without a pose of their own repeat the last one.
pub(crate) struct InLanes<'a, S> {
    pub(crate) simd: S,
    pub(crate) setting: &'a Setting<'a>,
    pub(crate) asked: &'a [Asked<'a>],
}

impl<S: Simd> InLanes<'_, S> {
    #[inline(always)]
    pub(crate) fn solutions(&self) -> Vec<Option<LaneSolution>> {
        let Setting { placed, load, shared } = self.setting;
        let (robot, zero) = (placed.robot, self.all(0.0));
        let (mut robots, spans) = self.shaped();
        let weight = self.all((robot.platform.mass + load.payload) * robot.gravity.magnitude());
        let whole = PlatformLoad::new(weight, &placed.wrench_to_level(&load.wrench));
        let external = constrain(robots.freedoms, whole.wrench(&robots.center));
        let mut multipliers = six!(|k| self.each(&|asked| asked.near.multipliers[k]));
        let mut set_points = vec![zero; spans.len()];
        let Distributed { converged, sound, cables } = zero.apart(Distribute {
            robots: &mut robots,
            external: &external,
            multipliers: &mut multipliers,
            offsets: &mut set_points,
            spans: &spans,
            shared,
        });
        let (demanded, limits): (Vec<_>, Vec<_>) =
            cables.iter().map(|CableTension { demanded, limits, .. }| (*demanded, *limits)).unzip();
        let mut platform = LinearizedPlatform::new(zero, spans.len());
        let with_lengths = find_lengths(&mut robots, &mut platform, &set_points, (&spans, &demanded), shared);
        let found = converged & sound & with_lengths;
        let found = found & self.is_least(&robots, &spans, &multipliers, &limits);
        self.read(found, &robots, &spans, &multipliers, (&set_points, &limits))
    }

    #[inline(always)]
    fn all(&self, value: f64) -> Lanes<S> {
        Lanes::splat(self.simd, value)
    }

    #[inline(always)]
    fn each(&self, value: &dyn Fn(&Asked) -> f64) -> Lanes<S> {
        each(self.simd, self.asked, value)
    }

    /// The robot at the poses, its cables as they were at the poses before, between their new ends.
    #[inline(always)]
    fn shaped(&self) -> (Robots<'_, S>, Vec<Span<Lanes<S>>>) {
        let poses: SmallVec<[&Pose; MAX_LANES]> = self.asked.iter().map(|asked| asked.pose).collect();
        let (mut robots, _) = self.setting.placed.at(self.simd, &poses);
        let mut spans = Vec::with_capacity(robots.cables.len());
        for (i, cable) in robots.cables.iter_mut().enumerate() {
            let span = cable.span(&robots.position);
            let mut numbers = [self.all(0.0); 7];
            let count = if cable.guided.is_some() { 7 } else { 3 };
            for (k, number) in numbers[..count].iter_mut().enumerate() {
                *number = self.each(&|asked| asked.near.shapes[i].numbers()[k]);
            }
            let shape = Shape::of_numbers(numbers);
            cable.take(&shape, &span);
            spans.push(span);
        }
        (robots, spans)
    }

    /// The lanes without another minimum: no cable sags, or none has another tension that is better.
    #[inline(always)]
    fn is_least(
        &self,
        robots: &Robots<'_, S>,
        spans: &[Span<Lanes<S>>],
        multipliers: &Lanes6<S>,
        limits: &[Lanes2<S>],
    ) -> Mask<S> {
        let zero = self.all(0.0);
        let mut straight = zero.less_or_equal(zero);
        for cable in &robots.cables {
            straight = straight & cable.end().slackness.less_or_equal(self.all(SAGGING));
        }
        let mut least = zero.less_or_equal(zero);
        if (!straight).any() {
            let choices = &self.setting.shared.choices;
            for ((cable, span), (choice, limits)) in
                robots.cables.iter().zip(spans).zip(choices.iter().zip(limits))
            {
                least = least & is_least(cable, span, multipliers, choice.reference, limits);
            }
        }
        straight | least
    }

    /// The results of the lanes that `found` one.
    #[inline(always)]
    fn read(
        &self,
        found: Mask<S>,
        robots: &Robots<'_, S>,
        spans: &[Span<Lanes<S>>],
        multipliers: &Lanes6<S>,
        (set_points, limits): (&[Lanes<S>], &[Lanes2<S>]),
    ) -> Vec<Option<LaneSolution>> {
        let found = found.to_array();
        let multipliers_of = multipliers.map(Lanes::to_array);
        let count = spans.len();
        let Setting { placed, shared, .. } = self.setting;
        let result = |lane: usize| {
            let pose = *self.asked[lane].pose;
            let multipliers = Vector6::from_fn(|k, _| multipliers_of[k][lane]);
            let solution = InverseSolution {
                lengths: Vec::with_capacity(count),
                tensions: Vec::with_capacity(count),
                active: Vec::with_capacity(count),
                multipliers: placed.both(PlacedRobot::to_base, &multipliers),
                equilibrium: Equilibrium { pose, cable_forces: Vec::with_capacity(count) },
                iterations: 0,
                stationarity: 0.0,
                residual: Residual { closure: f64::NAN, force: f64::NAN, moment: f64::NAN },
            };
            (solution, Near { position: pose.position, shapes: Vec::with_capacity(count), multipliers })
        };
        let mut results: Vec<_> =
            (0..self.asked.len()).map(|lane| found[lane].then(|| result(lane))).collect();
        let choices = &shared.choices;
        for (i, (cable, span)) in robots.cables.iter().zip(spans).enumerate() {
            let fixed = FixedEnds::new(cable, span);
            let pull = wrench(&cable.anchor_arm, &fixed.pull_slope(cable, span));
            // (I2)
            let slope =
                (fixed.tension + -choices[i].reference) + dot(multipliers, &pull) / fixed.tension_slope;
            let shape = cable.shape(span);
            let length = cable.guided.as_ref().map_or(cable.length, |guided| guided.whole_length);
            let [slope, length, tension, x, z, least, greatest] =
                [slope, length, set_points[i], cable.force[0], cable.force[1], limits[i][0], limits[i][1]]
                    .map(Lanes::to_array);
            let numbers = shape.numbers().map(Lanes::to_array);
            for (lane, result) in results.iter_mut().enumerate() {
                let Some((result, near)) = result else { continue };
                let (active, stationarity) = match tension[lane] {
                    t if t == least[lane] => (Some(Bound::Min), (-slope[lane]).max(0.0)),
                    t if t == greatest[lane] => (Some(Bound::Max), slope[lane].max(0.0)),
                    _ => (None, slope[lane].abs()),
                };
                near.shapes.push(Shape::of_numbers(numbers.map(|number| number[lane])));
                result.lengths.push(length[lane]);
                result.equilibrium.cable_forces.push(Vector2::new(x[lane], z[lane]));
                result.tensions.push(tension[lane]);
                result.active.push(active);
                result.stationarity = result.stationarity.max(stationarity);
            }
        }
        results
    }
}
