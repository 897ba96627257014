//! Where a robot can work, and how well: tensions, deflection, stiffness, natural frequencies and the
//! tolerance that matters most, pose by pose.
//!
//! A load can come onto the platform in two ways. Where the lengths are kept, as in the paper, the platform
//! yields, and its tensions are what the direct model says. Where the winches hold the pose, the tensions are
//! recomputed, by the inverse model with the load. A pose may be held in one way and not in the other.

pub(crate) mod breaks;
pub(crate) mod question;
pub(crate) mod results;
pub(crate) mod row;
pub(crate) mod summary;

use crate::boundary::{Boundary, boundary};
use crate::capacity::capacity_of;
use crate::clearance::clearance_at;
use crate::safety::winds::{AnyWeather, Winds, winds};
use crate::tilt::tilt_at;
use crate::workspace::breaks::after_breaks;
use crate::workspace::question::{Shaking, TiltDirections, Way, Workspace, check};
use crate::workspace::results::{Dominant, Held, Recomputed, WorkspacePose};
use cdpr_dynamics::{LargestInBand, Swing};
use cdpr_robot::{Axis, Platform, Pose, Robot, Vector3};
use cdpr_statics::batch::{LoadedPose, PoseSlopes, loaded_poses};
use cdpr_statics::limits::{OutOfLimits, allowed, out_of_limits};
use cdpr_statics::{
    Deflection, DirectProblem, DirectStart, InverseSolution, Load, StaticsError, Unstable, WantedPose,
    deflection, deflection_from, derivatives, inverse, is_feasible,
};
use cdpr_study::{Grid, StudyError};
use rayon::prelude::*;
use std::borrow::Cow;

/// Positions that are computed together are a multiple of this: the poses of a block of [`inverse`].
const BLOCK: usize = 64;

/// Parts that a large map is cut into. The answers depend on them in the last digits, but not on the
/// threads.
const PARTS: usize = 128;

/// Computes all positions in parallel, in the order of the grid. `tick` is called after each position; a
/// `stop` that returns true ends the run.
///
/// # Errors
/// [`StudyError::Setting`] for an invalid load, error model or number of free coordinates, and for an error
/// model without a load;
/// [`StudyError::Stopped`]. A pose without feasible tensions is not an error.
pub fn compute_workspace(
    workspace: &Workspace,
    tick: &(dyn Fn() + Sync),
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Vec<WorkspacePose>, StudyError> {
    check(workspace)?;
    let Workspace { robot, rotation, load, free, further, .. } = *workspace;
    let order = without_jumps(&workspace.grid);
    let at = |number: &usize| Pose { rotation, ..workspace.grid.pose(*number) };
    let poses: Vec<_> = order.iter().map(at).collect();
    let has_load = load != Load::none();
    let of_part = |poses: &[Pose]| {
        if stop() {
            return vec![Err(StudyError::Stopped)];
        }
        let all_wound_up = |asked: bool, load: &Load| {
            if asked { wound_up(workspace, poses, load) } else { Vec::new() }
        };
        let loaded = all_wound_up(has_load || further.distances, &load);
        let unloaded = all_wound_up(further.capacity.is_some(), &Load::none());
        let one = |((k, pose), outcome): ((usize, &Pose), Result<Held, StaticsError>)| {
            if stop() {
                return Err(StudyError::Stopped);
            }
            let loaded = loaded.get(k).map(|found| found.as_ref().map_err(Clone::clone));
            let recomputed =
                loaded.clone().filter(|_| has_load).map(|found| Recomputed::of(workspace, found?));
            let capacity = further.capacity.zip(unloaded.get(k)).map(|(set, found)| {
                Box::new(capacity_of(robot, pose, &load, set, free, found.as_ref().map_err(Clone::clone)))
            });
            let clearance = loaded.filter(|_| further.distances).map(|found| {
                Box::new(found.and_then(|found| clearance_at(robot, &found.lengths, &found.equilibrium)))
            });
            let tilt = further.tilt.map(|TiltDirections { count, accuracy }| {
                Box::new(tilt_at(robot, pose, &load, count, accuracy))
            });
            let shaken = further.shaking.filter(|_| outcome.is_ok());
            let shaken = shaken.map(|shaking| Box::new(shaken_at(workspace, pose, &shaking)));
            let weather = further.weather.filter(|_| outcome.is_ok());
            let weather = weather.map(|weather| Box::new(blown_at(workspace, pose, &weather)));
            let breaks = further.breaks.map(|factors| Box::new(after_breaks(workspace, pose, &factors)));
            tick();
            let pose = *pose;
            Ok(WorkspacePose {
                pose,
                outcome,
                recomputed,
                capacity,
                clearance,
                tilt,
                shaken,
                weather,
                breaks,
            })
        };
        poses.par_iter().enumerate().zip(outcomes(workspace, poses)).map(one).collect()
    };
    let part = BLOCK * (poses.len() / (BLOCK * PARTS)).max(1);
    let mut found: Vec<_> =
        poses.par_chunks(part).flat_map(of_part).map(|pose| pose.map(Some)).collect::<Result<_, _>>()?;
    let mut places = vec![0; order.len()];
    for (place, number) in order.into_iter().enumerate() {
        places[number] = place;
    }
    Ok(places.into_iter().filter_map(|place| found[place].take()).collect())
}

/// The numbers of all positions in an order in which each is a neighbour of the one before: lines run to and
/// fro.
fn without_jumps(grid: &Grid) -> Vec<usize> {
    let [columns, rows, layers] = Axis::ALL.map(|axis| grid.axis(axis).points);
    let turned = |k: usize, count: usize, back: bool| if back { count - 1 - k } else { k };
    let lines = (0..columns).flat_map(|i| (0..rows).map(move |j| i * rows + turned(j, rows, i % 2 == 1)));
    let line = |(number, line)| (0..layers).map(move |k| line * layers + turned(k, layers, number % 2 == 1));
    lines.enumerate().flat_map(line).collect()
}

/// The results of poses that follow each other.
fn outcomes(workspace: &Workspace, poses: &[Pose]) -> Vec<Result<Held, StaticsError>> {
    let Workspace { robot, ref load, free, .. } = *workspace;
    if !free.is_empty() {
        let one = |pose| {
            let (held, found) = held_free(workspace, pose)?;
            Ok(Held { swing: swing(workspace, &found), ..held })
        };
        return poses.par_iter().map(one).collect();
    }
    let wanted = inverse(robot, poses, &Load::none());
    // No answer depends on those beside it.
    let held: Vec<_> =
        wanted.par_chunks(BLOCK).flat_map_iter(|wanted| loaded_from(workspace, wanted)).collect();
    if robot.lacks_inertia() {
        return held;
    }
    let one = |(held, wanted): (Result<Held, StaticsError>, &Result<InverseSolution, StaticsError>)| {
        let (held, InverseSolution { lengths, equilibrium, .. }) =
            (held?, wanted.as_ref().map_err(Clone::clone)?);
        let found = deflection_from(robot, lengths.clone(), load, equilibrium);
        Ok(Held { swing: found.ok().and_then(|found| swing(workspace, &found)), ..held })
    };
    held.into_par_iter().zip(&wanted).map(one).collect()
}

/// How fast the platform swings with the load.
fn swing(workspace: &Workspace, Deflection { lengths, loaded, .. }: &Deflection) -> Option<Swing> {
    let problem = DirectProblem::new(workspace.robot, lengths, &workspace.load).ok()?;
    Swing::new(&problem, &loaded.equilibrium).ok()
}

/// The largest amplitudes of a platform that is shaken with the load, the lengths kept. An inertia that is
/// missing is assumed.
fn shaken_at(workspace: &Workspace, pose: &Pose, shaking: &Shaking) -> Result<LargestInBand, StaticsError> {
    let Workspace { robot, ref load, free, .. } = *workspace;
    let robot = if robot.lacks_inertia() {
        let platform = Platform { inertia: Some(robot.assumed_inertia()), ..robot.platform };
        Cow::Owned(Robot { platform, ..robot.clone() })
    } else {
        Cow::Borrowed(robot)
    };
    let Deflection { lengths, loaded, .. } = deflection(&robot, WantedPose::at(pose).free(free), load)?;
    let problem = DirectProblem::new(&robot, &lengths, load)?;
    let Shaking { band, damping, marker } = shaking;
    Ok(LargestInBand::new(&problem, &loaded.equilibrium, *band, *damping, marker)?)
}

/// Where the platform rests in weather with the load, the lengths kept, displaced from where it rests without
/// both.
fn blown_at(workspace: &Workspace, pose: &Pose, weather: &AnyWeather) -> Result<Winds, StaticsError> {
    let Workspace { robot, ref load, free, .. } = *workspace;
    let Deflection { lengths, unloaded, loaded } = deflection(robot, WantedPose::at(pose).free(free), load)?;
    let [from, at] = [&unloaded, &loaded].map(|found| &found.equilibrium.pose);
    winds(robot, &lengths, load, [at, from], weather)
}

/// The results with the lengths kept from answers of the inverse model.
fn loaded_from(
    workspace: &Workspace,
    wanted: &[Result<InverseSolution, StaticsError>],
) -> Vec<Result<Held, StaticsError>> {
    let Workspace { robot, ref load, tolerances, .. } = *workspace;
    let answered: Vec<_> = wanted.iter().filter_map(|wanted| wanted.as_ref().ok()).collect();
    let held: Vec<Result<Held, StaticsError>> = match tolerances {
        None => {
            let loaded = loaded_poses::<LoadedPose>(robot, &answered, load).into_iter();
            loaded.map(|loaded| Ok(Held::new(robot, loaded?, None))).collect()
        }
        Some(model) => {
            let with_slopes = |found: Result<PoseSlopes, StaticsError>| {
                let PoseSlopes { loaded, magnitude } = found?;
                Ok(Held::new(robot, loaded, magnitude.and_then(|slopes| Dominant::of(&slopes, model))))
            };
            loaded_poses::<PoseSlopes>(robot, &answered, load).into_iter().map(with_slopes).collect()
        }
    };
    let mut held = held.into_iter();
    let one = |wanted: &Result<InverseSolution, StaticsError>| match wanted {
        Err(refusal) => Some(Err(refusal.clone())),
        Ok(_) => held.next(),
    };
    wanted.iter().filter_map(one).collect()
}

/// How the winches hold poses that follow each other under a load.
fn wound_up(
    workspace: &Workspace,
    poses: &[Pose],
    load: &Load,
) -> Vec<Result<InverseSolution, StaticsError>> {
    let Workspace { robot, free, .. } = *workspace;
    if free.is_empty() {
        return inverse(robot, poses, load);
    }
    poses.par_iter().map(|pose| inverse(robot, WantedPose::at(pose).free(free), load)).collect()
}

/// The tensions, if the pose does not turn over: free coordinates are found whether it does or not.
fn tensions_at_rest<'a>(
    workspace: &Workspace,
    wound_up: &'a InverseSolution,
) -> Result<&'a [f64], StaticsError> {
    let Workspace { robot, ref load, free, .. } = *workspace;
    if !free.is_empty() {
        let InverseSolution { lengths, equilibrium, .. } = wound_up;
        DirectProblem::new(robot, lengths, load)?
            .with_unstable(Unstable::Refused)
            .direct(DirectStart::Near(equilibrium))?;
    }
    Ok(&wound_up.tensions)
}

impl Recomputed {
    fn of(workspace: &Workspace, wound_up: &InverseSolution) -> Result<Self, StaticsError> {
        let [least_tension, greatest_tension] = range(tensions_at_rest(workspace, wound_up)?);
        let (robot, InverseSolution { lengths, equilibrium, .. }) = (workspace.robot, wound_up);
        // Tensions below the least one are those of a platform on few cables, which stands as it does.
        let mut out_of_limits = out_of_limits(robot, lengths, &[equilibrium]);
        out_of_limits.retain(OutOfLimits::is_too_much);
        Ok(Self { least_tension, greatest_tension, out_of_limits })
    }
}

/// The boundary of the positions that are held with all tensions within the limits, the load borne in one
/// way.
///
/// # Errors
/// As [`compute_workspace`], and [`StudyError::Setting`] for a grid that is neither a plane nor a box.
pub fn workspace_boundary(
    workspace: &Workspace,
    way: Way,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Boundary, StudyError> {
    check(workspace)?;
    let Workspace { robot, rotation, grid, ref load, free, .. } = *workspace;
    // Quicker than the inverse model to say no.
    let has_tensions = |pose: &Pose, load: &Load| is_feasible(robot, pose, load).unwrap_or(false);
    let workspace = &Workspace { tolerances: None, ..*workspace };
    let within = |held: Result<Held, StaticsError>| held.is_ok_and(|held| held.is_within_limits());
    let is_inside = |position: &Vector3<f64>| {
        let pose = Pose { position: *position, rotation };
        match (way, free) {
            (Way::Recomputed, []) => has_tensions(&pose, load),
            (Way::Kept, []) if !has_tensions(&pose, &Load::none()) => false,
            (Way::Kept, []) => {
                loaded_from(workspace, &[inverse(robot, &pose, &Load::none())]).into_iter().all(within)
            }
            (Way::Kept, _) => within(held_free(workspace, &pose).map(|(held, _)| held)),
            // Free coordinates are found whatever the limits are.
            (Way::Recomputed, _) => wound_up(workspace, &[pose], load).into_iter().flatten().any(|found| {
                let within = |(i, t): (usize, &f64)| *t <= allowed(robot, i).max && *t >= robot.limits(i).min;
                tensions_at_rest(workspace, &found)
                    .is_ok_and(|tensions| tensions.iter().enumerate().all(within))
            }),
        }
    };
    boundary(&Axis::ALL.map(|axis| grid.axis(axis).coordinates()), &is_inside, stop)
}

/// A pose with free coordinates, with the lengths kept.
fn held_free(workspace: &Workspace, pose: &Pose) -> Result<(Held, Deflection), StaticsError> {
    let Workspace { robot, ref load, tolerances, free, .. } = *workspace;
    let alone = |deflection: Deflection, dominant| {
        (Held::new(robot, LoadedPose::of(robot, &deflection), dominant), deflection)
    };
    let deflected = || deflection(robot, WantedPose::at(pose).free(free), load);
    let Some(model) = tolerances else {
        return Ok(alone(deflected()?, None));
    };
    match derivatives(robot, WantedPose::at(pose).free(free), load) {
        Ok(found) => {
            let dominant = found.magnitude().ok().and_then(|slopes| Dominant::of(&slopes, model));
            Ok(alone(found.deflection, dominant))
        }
        // A pose without a derivative is held nevertheless.
        Err(StaticsError::NoDerivative { .. }) => Ok(alone(deflected()?, None)),
        Err(error) => Err(error),
    }
}

/// The least and the greatest.
fn range(tensions: &[f64]) -> [f64; 2] {
    tensions.iter().fold([f64::INFINITY, 0.0], |[least, greatest], t| [least.min(*t), greatest.max(*t)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use cdpr_study::GridAxis;

    #[test]
    fn neighbours_follow_each_other() {
        let axis = |points| GridAxis { min: 0.0, max: if points == 1 { 0.0 } else { 1.0 }, points };
        for counts in [[3, 4, 5], [2, 3, 2], [1, 4, 3], [5, 1, 1]] {
            let grid = Grid::new(counts.map(axis)).unwrap();
            let order = without_jumps(&grid);
            let mut all = order.clone();
            all.sort_unstable();
            assert!(all.into_iter().eq(0..grid.count()));
            let [_, rows, layers] = counts;
            let place = |k: usize| [k / layers / rows, k / layers % rows, k % layers];
            for pair in order.windows(2) {
                let (one, other) = (place(pair[0]), place(pair[1]));
                let steps: usize = one.iter().zip(other).map(|(a, b)| a.abs_diff(b)).sum();
                assert_eq!(steps, 1, "{one:?} to {other:?} of {counts:?}");
            }
        }
    }
}
