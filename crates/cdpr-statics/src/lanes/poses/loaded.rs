//! What a load does to one robot at many poses with the lengths kept, one pose in each lane.
//!
//! From the lengths of the inverse model both equilibria follow by Newton's method of
//! `local/newton.rs`. The stiffness K of the loaded platform is linearized at the second one. Its least
//! eigenvalue in (dp, ℓ dφ) is the stiffness of the softest motion, as [`crate::Stability`] has it. What a
//! lane does not decide is left to the scalar models.

use crate::equations::guided_place;
use crate::error::StaticsError;
use crate::inverse::InverseSolution;
use crate::lanes::adjoint::adjoint;
use crate::lanes::poses::loaded_pose::{Loaded, LoadedPose, PoseSlopes};
use crate::lanes::poses::placed::{PlacedRobot, each};
use crate::lanes::poses::slopes::{Nominal, SlopesOfLanes};
use crate::lanes::reason::ScalarReason;
#[cfg(doc)]
use crate::loading::deflection_from;
use crate::local::freedoms::{constrain, constrain_matrix};
use crate::local::load::PlatformLoad;
use crate::local::newton::solve;
use crate::local::platform::{LaneResidual, LinearizedPlatform, Robots};
use crate::state::Load;
use cdpr_cable::{Catenary, is_slack};
use cdpr_number::Number;
use cdpr_number::dense::{Lanes3, Lanes6x6, SymmetricFactors};
use cdpr_number::eigen::least_eigenvalue;
use cdpr_number::lanes::{Lanes, MAX_LANES, Mask, Simd, WithSimd, dispatch};
use cdpr_number::{six, three};
use cdpr_robot::{Freedoms, Pose, Robot, Vector3};
use smallvec::SmallVec;

/// What `load` does at every pose that the inverse model solved without it, the lengths kept: the figures
/// of [`deflection_from`], and those of [`crate::derivatives`] where they exist.
///
/// Robots with a cable for every free motion are solved in the lanes of the vector unit; derivatives over
/// tilted axes are those of the scalar models. No result depends on the others.
///
/// # Errors
/// Those of [`deflection_from`], for each pose.
pub fn loaded_poses<T: Loaded>(
    robot: &Robot,
    wanted: &[&InverseSolution],
    load: &Load,
) -> Vec<Result<T, StaticsError>> {
    let found = in_lanes(robot, wanted, load, T::WITH_SLOPES).into_iter();
    let one = |(wanted, found): (&&InverseSolution, Result<PoseSlopes, _>)| {
        let alone = |why| PoseSlopes::by_scalar_models(robot, wanted, load, (why, T::WITH_SLOPES));
        found.or_else(alone).map(T::part_of)
    };
    wanted.iter().zip(found).map(one).collect()
}

/// The results of the lanes, with derivatives or without.
fn in_lanes(
    robot: &Robot,
    wanted: &[&InverseSolution],
    load: &Load,
    with_slopes: bool,
) -> Vec<Result<PoseSlopes, ScalarReason>> {
    let reason = ScalarReason::of_all(robot, &[]).or(load.validate().err().map(|_| ScalarReason::OneByOne));
    match (reason, PlacedRobot::of(robot)) {
        (None, Some(placed)) if placed.is_tilted && with_slopes => {
            vec![Err(ScalarReason::Derivatives); wanted.len()]
        }
        (None, Some(placed)) => {
            let slopes = with_slopes.then(|| Nominal::new(&placed, load));
            dispatch(Batch { placed: &placed, wanted, load, slopes: slopes.as_ref() })
        }
        (reason, _) => vec![Err(reason.unwrap_or(ScalarReason::OneByOne)); wanted.len()],
    }
}

/// Poses for the lanes.
struct Batch<'a> {
    placed: &'a PlacedRobot<'a>,
    wanted: &'a [&'a InverseSolution],
    load: &'a Load,
    slopes: Option<&'a Nominal<'a>>,
}

impl WithSimd for Batch<'_> {
    type Output = Vec<Result<PoseSlopes, ScalarReason>>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Self { placed, wanted, load, slopes } = self;
        let mut found = Vec::with_capacity(wanted.len());
        for wanted in wanted.chunks(Lanes::<S>::COUNT) {
            InLanes { simd, placed, wanted, load, slopes }.solve(&mut found);
        }
        found
    }
}

/// Poses, one for each lane; lanes without a pose of their own repeat the last one.
struct InLanes<'a, S> {
    simd: S,
    placed: &'a PlacedRobot<'a>,
    wanted: &'a [&'a InverseSolution],
    load: &'a Load,
    slopes: Option<&'a Nominal<'a>>,
}

/// An equilibrium in each lane.
struct Settled<S: Simd> {
    found: Mask<S>,
    residual: LaneResidual<S>,
    /// Of each cable at the platform and at its exit.
    tensions: SmallVec<[[Lanes<S>; 2]; 8]>,
}

impl<S: Simd> InLanes<'_, S> {
    #[inline(always)]
    fn solve(&self, results: &mut Vec<Result<PoseSlopes, ScalarReason>>) {
        let Self { simd, placed, wanted, load, .. } = *self;
        let (mut robots, zero) = (self.at_lengths(), self.all(0.0));
        let everywhere = zero.less_or_equal(zero);
        let mut record = self.slopes.map(|nominal| nominal.record(simd, placed, wanted, &robots));
        let mut platform = LinearizedPlatform::new(zero, robots.cables.len());
        platform.follow_guides(&robots);
        let mut carried = PlatformLoad::weight(robots.weight);
        robots.linearize(&carried, &mut platform, everywhere);
        let unloaded = self.settled(&mut robots, &mut platform, &carried, everywhere);
        if let Some(record) = &mut record {
            record.trace.states.push(robots.clone());
        }
        let (stood, stiffness) = (robots.position, platform.factored);
        let (mut loaded, mut payload) = (None, PlatformLoad::weight(zero));
        if *load != Load::none() {
            let weight = self.all(load.payload * placed.robot.gravity.magnitude());
            let added = PlatformLoad::new(weight, &placed.wrench_to_level(&load.wrench));
            // The first step follows the linearization at hand.
            let wrench = constrain(robots.freedoms, added.wrench(&robots.center));
            platform.gradient = six!(|k| platform.gradient[k] - wrench[k]);
            carried = added.on(carried.weight);
            payload = added;
            let mut settled = self.settled(&mut robots, &mut platform, &carried, unloaded.found);
            let scale = &placed.scale;
            settled.found = robots.on_branch(&carried, &platform, &stiffness, scale, settled.found);
            loaded = Some(settled);
        }
        let displacement = three!(|k| robots.position[k] - stood[k]);
        let slopes = match (&mut record, self.slopes) {
            (Some(record), Some(nominal)) => {
                record.trace.states.push(robots.clone());
                adjoint(record, &displacement, &payload, &nominal.shared)
                    .map(|adjoint| nominal.slopes_of(simd, &robots, &adjoint))
            }
            _ => None,
        };
        let stiffness = self.least_stiffness(&robots, &mut platform, &carried);
        self.read(
            &robots,
            &displacement,
            (&unloaded, loaded.as_ref().unwrap_or(&unloaded)),
            (stiffness, slopes),
            results,
        );
    }

    #[inline(always)]
    fn all(&self, value: f64) -> Lanes<S> {
        Lanes::splat(self.simd, value)
    }

    /// The robot with its cables with the lengths of the inverse model.
    #[inline(always)]
    fn at_lengths(&self) -> Robots<'_, S> {
        let Self { simd, placed, wanted, .. } = *self;
        let poses: SmallVec<[&Pose; MAX_LANES]> =
            wanted.iter().map(|wanted| &wanted.equilibrium.pose).collect();
        let (mut robots, frame) = placed.at(simd, &poses);
        robots.frame.extend(frame);
        for (i, cable) in robots.cables.iter_mut().enumerate() {
            let length = each(simd, wanted, &|wanted| wanted.lengths[i]);
            cable.force = [
                each(simd, wanted, &|wanted| wanted.equilibrium.cable_forces[i].x),
                each(simd, wanted, &|wanted| wanted.equilibrium.cable_forces[i].y),
            ];
            cable.length = length;
            if let Some(guided) = &mut cable.guided {
                let place = |wanted: &&InverseSolution| {
                    let (cable, at) = (placed.robot.cable(i), &wanted.equilibrium);
                    let unstrained_length = wanted.lengths[i];
                    let catenary = Catenary { cable, unstrained_length, force: at.cable_forces[i] };
                    guided_place(placed.robot, &at.pose, i, catenary)
                };
                let places: SmallVec<[([f64; 2], f64); MAX_LANES]> = wanted.iter().map(place).collect();
                guided.whole_length = length;
                let azimuth = [0, 1].map(|k: usize| each(simd, &places, &|(azimuth, _)| azimuth[k]));
                guided.return_to(&azimuth, length.less_or_equal(length));
                cable.length = each(simd, &places, &|(_, free_length)| *free_length);
            }
        }
        robots
    }

    /// Newton's method from a linearization, in the lanes `alive`.
    #[inline(always)]
    fn settled(
        &self,
        robots: &mut Robots<'_, S>,
        platform: &mut LinearizedPlatform<S>,
        carried: &PlatformLoad<S>,
        alive: Mask<S>,
    ) -> Settled<S> {
        let (found, residual) = solve(robots, carried, platform, &self.placed.scale, alive);
        let mut tensions = SmallVec::new();
        for cable in &robots.cables {
            let [fx, fz] = cable.force;
            let exit = fz - cable.weight_per_length * cable.length;
            tensions.push([(fx * fx + fz * fz).sqrt(), (fx * fx + exit * exit).sqrt()]);
        }
        Settled { found, residual, tensions }
    }

    /// The lanes in which the stiffness at the equilibrium at hand is positive definite, and its least
    /// eigenvalue in (dp, ℓ dφ) [N/m].
    #[inline(always)]
    fn least_stiffness(
        &self,
        robots: &Robots<'_, S>,
        platform: &mut LinearizedPlatform<S>,
        carried: &PlatformLoad<S>,
    ) -> (Mask<S>, Lanes<S>) {
        let mut longest = self.all(0.0);
        for cable in &robots.cables {
            longest = longest.max(cable.guided.as_ref().map_or(cable.length, |guided| guided.whole_length));
        }
        let arm = (longest * 1e-3).max(self.all(self.placed.robot.platform_size()));
        let mut scaled = robots.stiffness(carried, platform);
        let (one, inverse) = (self.all(1.0), arm.recip());
        let scale = [one, one, one, inverse, inverse, inverse];
        for (row, per_row) in scaled.iter_mut().zip(&scale) {
            for (element, per_column) in row.iter_mut().zip(&scale) {
                *element = *element * *per_row * *per_column;
            }
        }
        (SymmetricFactors::new(scaled).positive, least(robots.freedoms, scaled))
    }

    /// The result of each lane, or the first stage that failed; without a load the second equilibrium is the
    /// first.
    #[inline(always)]
    fn read(
        &self,
        robots: &Robots<'_, S>,
        displacement: &Lanes3<S>,
        (unloaded, loaded): (&Settled<S>, &Settled<S>),
        ((stable, least_stiffness), slopes): ((Mask<S>, Lanes<S>), Option<SlopesOfLanes>),
        results: &mut Vec<Result<PoseSlopes, ScalarReason>>,
    ) {
        let Self { placed: PlacedRobot { robot, .. }, wanted, .. } = *self;
        let stands = unloaded.found.to_array();
        let carries = (loaded.found & stable).to_array();
        let displacement = three!(|k| displacement[k].to_array());
        let least_stiffness = least_stiffness.to_array();
        let residuals = [unloaded.residual.norms(), loaded.residual.norms()];
        let tensions = [&unloaded.tensions, &loaded.tensions].map(|settled| {
            let arrays = settled.iter().map(|[one, other]| [one.to_array(), other.to_array()]);
            arrays.collect::<SmallVec<[_; 8]>>()
        });
        let free: SmallVec<[_; 8]> = robots.cables.iter().map(|cable| cable.length.to_array()).collect();
        for lane in 0..wanted.len() {
            if !(stands[lane] && carries[lane]) {
                results.push(Err(if stands[lane] { ScalarReason::Loaded } else { ScalarReason::Unloaded }));
                continue;
            }
            let mut magnitude = None;
            if self.slopes.is_some() {
                let Some((slopes, _)) = slopes.as_ref().filter(|(_, decided)| decided[lane]) else {
                    results.push(Err(ScalarReason::Derivatives));
                    continue;
                };
                magnitude = Some(slopes.iter().map(|slope| slope[lane]).collect());
            }
            let of_lane = |ends: &[[f64; MAX_LANES]; 2]| ends.map(|of| of[lane]);
            let ends = |i: usize| of_lane(&tensions[1][i]);
            let is_slack = |i: &usize| is_slack(robot.cable(*i).weight_per_length * free[*i][lane], ends(*i));
            let loaded = LoadedPose {
                displacement: self.placed.to_base(Vector3::from_fn(|k, _| displacement[k][lane])),
                tensions: [0, 1].map(|k: usize| tensions[k].iter().map(of_lane).collect()),
                residuals: residuals.map(|residuals| residuals[lane]),
                least_stiffness: least_stiffness[lane],
                slack: (0..robot.cables.len()).filter(is_slack).collect(),
                scalar: None,
            };
            results.push(Ok(PoseSlopes { loaded, magnitude }));
        }
    }
}

/// The least eigenvalue of the free motions.
#[inline(always)]
fn least<S: Simd>(freedoms: Freedoms, mut matrix: Lanes6x6<S>) -> Lanes<S> {
    let mut trace = matrix[0][0].all(0.0);
    for (k, row) in matrix.iter().enumerate() {
        trace += row[k];
    }
    // No less than any eigenvalue of a stable stiffness.
    constrain_matrix(freedoms, &mut matrix, trace);
    least_eigenvalue(matrix)
}
