//! Which places of CAROCA's pulleys make its deflection least sensitive to the errors of the paper's study.
//!
//! `cargo run -p cdpr-study --example reconfiguration -- STUDY` evaluates every configuration at the poses of
//! two samplings of the study. `cargo xtask caroca-study` runs it.
//!
//! The pulleys move in steps on a frame of 7 x 4 x 3 m (section 2 of the paper), which gives neither their
//! size nor a symmetry. Assumed are places in steps of 0.25 m inside that frame, whose
//! upper corners are the exit points of Table 1, and two sets of pulleys, those of the upper and those of the
//! lower anchor points, each symmetric to both middle planes of the frame.
//!
//! The standard deviation of the deflection is that of the first order, `σ² = sum (σ_j d|dp|/dx_j)²`, with
//! exact derivatives of each configuration from the lanes. That of the best configuration is compared with a
//! sampling.

#![allow(clippy::print_stdout)]
#![cfg_attr(test, allow(clippy::unwrap_used))]

use cdpr_robot::{Axis, Deviations, Parameter, Robot, significant};
use cdpr_sensitivity::SampleDesign;
use cdpr_statics::batch::{Observation, ObservationSlopes};
use cdpr_statics::{Observer, StaticsError};
use cdpr_study::{Sampling, Study, observe_rows};
use rayon::prelude::*;
use std::error::Error;
use std::path::Path;
use std::time::Instant;

const SAMPLINGS: [&str; 2] = ["geometrical", "geometrical_asymmetric"];
/// Step of the places along each axis [m].
const STEP: f64 = 0.25;
/// Least half length, least half width and least height of the exits [m].
const LEAST: [f64; 3] = [2.0, 1.0, 0.5];
/// Those of the paper, which are the greatest [m].
const GREATEST: [f64; 3] = [3.5, 2.0, 3.5];
/// Observations of each configuration that holds both poses.
const TRIED: usize = 500;
/// Rows of a table, and parameters that are named.
const SHOWN: usize = 6;

/// Half length, half width and height of the exits of a set [m].
type Place = [f64; 3];

/// A configuration at a pose: deflection and its standard deviation [mm], and whether lanes have found them.
#[derive(Clone, Copy)]
struct AtPose {
    deflection: f64,
    std: f64,
    in_lanes: bool,
}

/// Places of the sets with the upper and the lower anchor points, and what is observed at each pose; `None`
/// where no tensions within the limits hold the pose.
struct Configuration {
    sets: [Place; 2],
    poses: [Option<AtPose>; 2],
    /// Whether it is evaluated: some cables may balance the platform at the first pose.
    evaluated: bool,
    /// Whether something else is why a pose is not observed.
    failed: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("expected the file of the paper's study")?;
    let study = Study::open(Path::new(&path))?;
    let samplings = [study.sampling(SAMPLINGS[0])?, study.sampling(SAMPLINGS[1])?];
    let clock = Instant::now();
    let places = places();
    let each: Vec<Vec<Configuration>> = places
        .par_iter()
        .map(|upper| with_upper(&samplings, *upper, &places))
        .collect::<Result<_, StaticsError>>()?;
    let all: Vec<Configuration> = each.into_iter().flatten().collect();
    let seconds = clock.elapsed().as_secs_f64();
    print_counts(&all, places.len());
    print_rankings(&samplings, &all)?;
    let rate = all.iter().filter(|of| of.evaluated).count() as f64 / seconds;
    println!(
        "\nPlaces: half length, half width, height [m]; deflection ± standard deviation, first order.\n\
         {} evaluated configurations a second with all derivatives, on {} threads",
        significant(rate, 2),
        rayon::current_num_threads()
    );
    Ok(())
}

/// All places of a set.
fn places() -> Vec<Place> {
    let along = |k: usize| {
        let count = ((GREATEST[k] - LEAST[k]) / STEP).round() as usize;
        (0..=count).map(move |i| LEAST[k] + STEP * i as f64)
    };
    along(2).flat_map(|z| along(0).flat_map(move |x| along(1).map(move |y| [x, y, z]))).collect()
}

/// The set of a cable: 0 for an anchor point above P, 1 for one below.
fn set_of(robot: &Robot, cable: usize) -> usize {
    usize::from(robot.cables[cable].anchor_point.z < 0.0)
}

/// Coordinate of the exit of a cable in the corner where it is, for a place of its set [m].
fn coordinate(robot: &Robot, cable: usize, place: Place, axis: Axis) -> f64 {
    let k = axis.index();
    if k == 2 { place[2] } else { place[k].copysign(robot.cables[cable].exit_point[k]) }
}

/// The robot in a configuration.
fn placed(robot: &Robot, sets: [Place; 2]) -> Robot {
    let mut placed = robot.clone();
    for (i, cable) in placed.cables.iter_mut().enumerate() {
        for axis in Axis::ALL {
            cable.exit_point[axis.index()] = coordinate(robot, i, sets[set_of(robot, i)], axis);
        }
    }
    placed
}

/// All configurations with one place of the upper set, the lower sets of a height together; the second pose
/// of those that hold the first one.
fn with_upper(
    samplings: &[Sampling; 2],
    upper: Place,
    places: &[Place],
) -> Result<Vec<Configuration>, StaticsError> {
    let mut all = Vec::with_capacity(places.len());
    for level in places.chunk_by(|one, other| one[2] == other[2]) {
        let first = all.len();
        all.extend(level.iter().map(|lower| Configuration {
            sets: [upper, *lower],
            poses: [None; 2],
            evaluated: false,
            failed: false,
        }));
        for (k, sampling) in samplings.iter().enumerate() {
            let is_open =
                |of: &&mut Configuration| (k == 0 || of.poses[0].is_some()) && can_balance(sampling, of.sets);
            let mut open: Vec<&mut Configuration> = all[first..].iter_mut().filter(is_open).collect();
            let lower: Vec<Place> = open.iter().map(|of| of.sets[1]).collect();
            for (of, found) in open.iter_mut().zip(observed(sampling, upper, &lower)?) {
                of.failed |=
                    matches!(&found, Err(error) if !matches!(error, StaticsError::NoTensions { .. }));
                of.poses[k] = found.ok();
                of.evaluated = true;
            }
        }
    }
    Ok(all)
}

/// Whether some exit is farther than its anchor point in each direction of the horizontal plane, and some
/// exit is above: a cable pulls towards its exit there, and its weight down, so that all others hold no
/// platform.
fn can_balance(sampling: &Sampling, sets: [Place; 2]) -> bool {
    let robot = sampling.robot;
    let is_there = |axis: Axis, sign: f64| {
        (0..robot.cables.len()).any(|i| {
            let anchor = (sampling.pose.position + sampling.pose.rotation * robot.cables[i].anchor_point)
                [axis.index()];
            sign * (coordinate(robot, i, sets[set_of(robot, i)], axis) - anchor) > 0.0
        })
    };
    [(Axis::X, 1.0), (Axis::X, -1.0), (Axis::Y, 1.0), (Axis::Y, -1.0), (Axis::Z, 1.0)]
        .into_iter()
        .all(|(axis, sign)| is_there(axis, sign))
}

/// The configurations with these places of the lower set, all at one height, at the pose of a sampling.
fn observed(
    sampling: &Sampling,
    upper: Place,
    lower: &[Place],
) -> Result<Vec<Result<AtPose, StaticsError>>, StaticsError> {
    let Some(&[.., height]) = lower.first() else { return Ok(Vec::new()) };
    // The lanes start from this one, which has to hold the pose where any other does.
    let start: Place = std::array::from_fn(|k| match k {
        2 => height,
        _ if sampling.pose.position[k].abs() > LEAST[k] => GREATEST[k],
        _ => 0.5 * (LEAST[k] + GREATEST[k]),
    });
    let robot = placed(sampling.robot, [upper, start]);
    let observer = Observer::new(&robot, sampling.pose, &sampling.load)?;
    let mut deviations = Deviations::zeros(observer.layout(), lower.len());
    for (row, place) in deviations.rows_mut().zip(lower) {
        for i in (0..robot.cables.len()).filter(|i| set_of(&robot, *i) == 1) {
            for axis in Axis::ALL {
                if let Some(column) = observer.layout().index(Parameter::ExitPoint(i, axis)) {
                    let from = robot.cables[i].exit_point[axis.index()];
                    row[column] = coordinate(&robot, i, *place, axis) - from;
                }
            }
        }
    }
    let at_pose = |of: ObservationSlopes| AtPose {
        deflection: 1e3 * of.observation.magnitude(),
        std: 1e3 * sampling.errors.variances(&of.magnitude).iter().sum::<f64>().sqrt(),
        in_lanes: of.observation.scalar.is_none(),
    };
    Ok(observer.observe(&deviations).into_iter().map(|of| of.map(at_pose)).collect())
}

/// Standard deviation of the first observations of a sampling in a configuration [mm]; `None` where one of
/// them fails.
fn sampled(sampling: &Sampling, sets: [Place; 2], observations: usize) -> Result<Option<f64>, StaticsError> {
    let robot = placed(sampling.robot, sets);
    let observer = Observer::new(&robot, sampling.pose, &sampling.load)?;
    let values: Option<Vec<f64>> = observe_rows(&sampling.design, 0..observations, |rows| {
        let found = observer.observe::<Observation>(&sampling.errors.deviations(rows));
        found.into_iter().map(|of| of.ok().map(|of| 1e3 * of.magnitude())).collect()
    })
    .into_iter()
    .collect();
    Ok(values.map(|values| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let square: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        (square / (values.len() as f64 - 1.0)).sqrt()
    }))
}

/// How many configurations there are and hold which pose.
fn print_counts(all: &[Configuration], places: usize) {
    let held = |k: usize| all.iter().filter_map(move |of| of.poses[k]);
    let lanes: usize = (0..2).map(|k| held(k).filter(|of| of.in_lanes).count()).sum();
    let [one, two] = [held(0).count(), held(1).count()];
    println!(
        "{} configurations, {} of them evaluated; the others have no exit on one side of the platform,\n\
         or none above, and hold nothing. {places} places of each of two sets of four pulleys (those of\n\
         the upper and of the lower anchor points), in steps of {STEP} m: half length {} to {} m, half\n\
         width {} to {} m, height {} to {} m. Steps, symmetry and places are assumed.",
        all.len(),
        all.iter().filter(|of| of.evaluated).count(),
        LEAST[0],
        GREATEST[0],
        LEAST[1],
        GREATEST[1],
        LEAST[2],
        GREATEST[2]
    );
    println!(
        "{one} hold the symmetric pose, {two} of them the non-symmetric one ({:.1} % found in lanes);\n\
         {} fail for another reason than tensions.",
        100.0 * lanes as f64 / (one + two) as f64,
        all.iter().filter(|of| of.failed).count()
    );
}

/// A configuration with the number by which it is ranked.
type Ranked<'a> = (f64, &'a Configuration);

/// The configurations with the least standard deviations, and that of the paper.
fn print_rankings(samplings: &[Sampling; 2], all: &[Configuration]) -> Result<(), Box<dyn Error>> {
    let both: Vec<&Configuration> = all.iter().filter(|of| of.poses[1].is_some()).collect();
    // The deflection at the second pose bends too much for the first order.
    let rank = |of: &&'_ Configuration| {
        let [one, two] = [sampled(&samplings[0], of.sets, TRIED)?, sampled(&samplings[1], of.sets, TRIED)?];
        Ok(one.zip(two).map(|(one, two)| one.max(two)))
    };
    let found: Vec<Option<f64>> = both.par_iter().map(rank).collect::<Result<_, StaticsError>>()?;
    let at_both: Vec<Ranked> = found.iter().zip(&both).filter_map(|(std, of)| Some(((*std)?, *of))).collect();
    println!(
        "\nBoth poses, by the greater standard deviation of {TRIED} observations [mm]:\n\
         {} configurations; {} others lose a pose in one of these observations",
        at_both.len(),
        both.len() - at_both.len()
    );
    print_ranking(samplings, at_both)?;
    let first: Vec<Ranked> = all.iter().filter_map(|of| Some((of.poses[0]?.std, of))).collect();
    println!(
        "\nThe symmetric pose alone, by the standard deviation of the first order [mm]: {} configurations",
        first.len()
    );
    print_ranking(&samplings[..1], first)
}

/// The first configurations of a ranking, that of the paper, and what dominates in the best one.
fn print_ranking(samplings: &[Sampling], mut ranked: Vec<Ranked>) -> Result<(), Box<dyn Error>> {
    ranked.sort_by(|one, other| one.0.total_cmp(&other.0));
    let poses = ["symmetric [mm]", "non-symmetric [mm]"];
    let columns: String = poses.iter().take(samplings.len()).map(|of| format!("{of:>20}")).collect();
    println!("  rank  ranked by  upper anchors [m]   lower anchors [m] {columns}");
    let paper = ranked.iter().position(|(_, of)| of.sets == [GREATEST; 2]);
    for rank in (0..ranked.len().min(SHOWN)).chain(paper.filter(|rank| *rank >= SHOWN)) {
        let (std, Configuration { sets, poses, .. }) = ranked[rank];
        let [upper, lower] = sets.map(|of| format!("{:.2} {:.2} {:.2}", of[0], of[1], of[2]));
        let at = |of: &AtPose| format!("{:>20}", format!("{:.3} ± {:.4}", of.deflection, of.std));
        let columns: String = poses.iter().take(samplings.len()).flatten().map(at).collect();
        let note = if Some(rank) == paper { "  the paper's" } else { "" };
        println!("{:>6} {std:>10.4}  {upper:<18}  {lower:<18}{columns}{note}", rank + 1);
    }
    let (_, best) = ranked.first().ok_or("no configuration holds the poses")?;
    samplings.iter().try_for_each(|sampling| print_best(sampling, best.sets))
}

/// The parameters that dominate in a configuration, and its standard deviation in a sampling.
fn print_best(sampling: &Sampling, sets: [Place; 2]) -> Result<(), Box<dyn Error>> {
    let robot = placed(sampling.robot, sets);
    let observer = Observer::new(&robot, sampling.pose, &sampling.load)?;
    let zero = Deviations::zeros(observer.layout(), 1);
    let Some(Ok(found)) = observer.observe::<ObservationSlopes>(&zero).pop() else { return Ok(()) };
    let variances = sampling.errors.variances(&found.magnitude);
    let whole: f64 = variances.iter().sum();
    let mut named: Vec<(&str, f64)> =
        sampling.errors.inputs.iter().map(|input| &*input.name).zip(variances).collect();
    named.sort_by(|one, other| other.1.total_cmp(&one.1));
    let shares: Vec<String> = named
        .iter()
        .take(SHOWN)
        .map(|(name, variance)| format!("{name} {:.1} %", 100.0 * variance / whole))
        .collect();
    let points = sampling.design.points();
    let of_sampling = sampled(sampling, sets, points)?
        .map_or_else(|| "one of them fails".to_owned(), |std| format!("{std:.4} mm"));
    println!("Best, {}: {}", sampling.name, shares.join(", "));
    println!("  first order {:.4} mm, {points} observations {of_sampling}", 1e3 * whole.sqrt());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use cdpr_statics::{Load, deflection, inverse};

    fn study() -> Study {
        Study::open(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/studies/caroca.json")))
            .unwrap()
    }

    #[test]
    fn a_configuration_deflects_as_the_robot_with_these_exits() {
        let study = study();
        let sampling = study.sampling(SAMPLINGS[0]).unwrap();
        let upper = [3.0, 1.25, 3.25];
        for lower in [[2.0, 1.0, 2.75], [3.5, 2.0, 2.75], [2.5, 1.5, 2.75]] {
            let found = observed(&sampling, upper, &[lower]).unwrap().pop().unwrap().unwrap();
            let mut robot = study.robot.clone();
            for (i, cable) in robot.cables.iter_mut().enumerate() {
                let [x, y, z] = if [0, 3, 4, 7].contains(&i) { upper } else { lower };
                let [sx, sy] = [if i % 2 == 0 { -1.0 } else { 1.0 }, if i < 4 { 1.0 } else { -1.0 }];
                cable.exit_point = [sx * x, sy * y, z].into();
            }
            let load = Load::payload(50.0);
            let of = |robot: &Robot| 1e3 * deflection(robot, &sampling.pose, &load).unwrap().magnitude();
            assert!((found.deflection / of(&robot) - 1.0).abs() < 1e-9, "{lower:?}");
            // The law of the modulus alone, by a difference.
            let moved = |by: f64| {
                let mut robot = robot.clone();
                robot.cables.iter_mut().for_each(|cable| cable.properties.youngs_modulus += by);
                of(&robot)
            };
            let alone = (moved(1e8) - moved(-1e8)).abs() / 2e8 * 4e9 / 12.0_f64.sqrt();
            assert!(alone < found.std && found.std < 1.6 * alone, "{lower:?}: {alone} {}", found.std);
        }
    }

    #[test]
    fn what_cannot_balance_has_no_tensions() {
        let study = study();
        let places: Vec<Place> = places().into_iter().step_by(41).collect();
        let (mut tried, sampling) = (0, study.sampling(SAMPLINGS[1]).unwrap());
        for sets in places.iter().flat_map(|one| places.iter().map(move |two| [*one, *two])) {
            if !can_balance(&sampling, sets) {
                let found = inverse(&placed(&study.robot, sets), &sampling.pose, &Load::none());
                assert!(matches!(found, Err(StaticsError::NoTensions { .. })), "{sets:?}: {found:?}");
                tried += 1;
            }
        }
        assert!(tried > 50, "{tried}");
    }
}
