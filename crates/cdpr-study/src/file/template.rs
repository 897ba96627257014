//! The first study of a user's own robot: a file that runs as it is, and whose numbers the user replaces.

mod notes;
mod tolerances;

use crate::error::StudyError;
use crate::fs::atomic::write_new;
use crate::fs::files::named_file;
use cdpr_robot::library::ROBOTS;
use cdpr_robot::{Coordinate, Parameter, Plane, Pose, Robot, Vector3, rounded};
use cdpr_statics::{Load, WantedPose, deflection};
pub use notes::template_notes;
use std::path::Path;
pub use tolerances::has_tolerance;
use tolerances::{Tolerances, two_digits};

/// How many observations a template makes: few enough for any robot, and for Sobol' indices with intervals.
/// With free coordinates each that the scalar models have to search for takes thousands of times as long, and
/// the measures of sensitivity are left out.
struct Size {
    observations: usize,
    replicates: usize,
    has_sensitivity: bool,
    /// Points of each axis of the surface.
    axis: usize,
}

impl Size {
    fn of(robot: &Robot) -> Self {
        if robot.is_fully_actuated() {
            Self { observations: 2048, replicates: 4, has_sensitivity: true, axis: 21 }
        } else {
            Self { observations: 64, replicates: 0, has_sensitivity: false, axis: 3 }
        }
    }
}

const SALTELLI_BLOCKS: usize = 128;
const MORRIS_BLOCKS: usize = 32;
const DERIVATIVE_POINTS: usize = 256;

/// How many observations each part of the template makes, for people.
pub fn template_cost(robot: &Robot) -> String {
    let inputs = Parameter::of(robot).iter().filter(|parameter| has_tolerance(robot, parameter)).count();
    let Size { observations, replicates, has_sensitivity, axis } = Size::of(robot);
    let part = |count: usize, wanted: bool, part: &str| {
        if wanted { format!("\n  {count:>6}  {part}") } else { String::new() }
    };
    let parts = [
        part(observations, true, "sampling"),
        part(
            replicates * observations,
            replicates > 0,
            "replicates (times the observations of the sampling)",
        ),
        part(
            SALTELLI_BLOCKS * (inputs + 2),
            has_sensitivity,
            "Sobol' indices (saltelli_blocks times inputs + 2)",
        ),
        part(
            MORRIS_BLOCKS * (inputs + 1),
            has_sensitivity,
            "Morris's effects (morris_blocks times inputs + 1)",
        ),
        part(DERIVATIVE_POINTS, true, "exact derivatives (derivative_points)"),
        part(axis * axis, true, "surface (points of x times points of y)"),
    ];
    let lines = parts.concat();
    format!("Observations of each part (`--observations N`: fewer of all but the surface):{lines}")
}

/// A study file for `robot`, in which `robot_path` names the robot file. Without a position it takes one on
/// the vertical through the middle of the exit points, with feasible tensions; without a payload it takes a
/// tenth of the platform's mass [kg]. For a robot with fewer cables than free motions, `free` names the
/// coordinates that are found; where it is empty, they are as many of roll, pitch, yaw, z, y, x as it takes.
///
/// # Errors
/// [`StudyError::Setting`] for another number of free coordinates than cables are missing, for a position
/// without feasible tensions under the payload, or if no position was found.
pub fn template(
    robot: &Robot,
    robot_path: &str,
    position: Option<[f64; 3]>,
    payload: Option<f64>,
    free: &[Coordinate],
) -> Result<String, StudyError> {
    let free = free_coordinates(robot, free)?;
    let payload = payload.unwrap_or_else(|| two_digits(0.1 * robot.platform.mass));
    let (pose, tolerances) = placed(robot, position, payload, &free)?;
    let Size { observations, replicates, has_sensitivity, axis } = Size::of(robot);
    let sensitivity = if has_sensitivity {
        format!(
            r#"
  "sensitivity": {{
    "saltelli_blocks": {SALTELLI_BLOCKS},
    "morris_blocks": {MORRIS_BLOCKS},
    "derivative_points": {DERIVATIVE_POINTS}
  }},"#
        )
    } else {
        String::new()
    };
    let source = source(&tolerances);
    let pose = described(&pose, !free.is_empty());
    let names: Vec<_> = free.iter().map(|name| format!("\"{name}\"")).collect();
    let free =
        if free.is_empty() { String::new() } else { format!("\n      \"free\": [{}],", names.join(", ")) };
    let [name, robot_path] = [format!("Static deflection of {}", robot.name), robot_path.to_owned()]
        .map(|text| serde_json::Value::from(text).to_string());
    Ok(format!(
        r#"{{
  "format": "cdpr-study/1",
  "name": {name},
  "source": {source},
  "robot": {robot_path},
  "payload": {payload:?},
  "seed": 1,
  "replicates": {replicates},
  "confidence": 0.95,
  "bootstrap_resamples": 200,
  "error_models": {{
    "tolerances": {{
{entries}
    }}
  }},
  "samplings": {{
    "all": {{
      "title": "All parameters",
      "pose": {pose},{free}
      "error_model": "tolerances",
      "observations": {observations}
    }}
  }},{sensitivity}
  "surfaces": {{
    "modulus_mass": {{
      "title": "E and m alone",
      "pose": {pose},{free}
      "x": {{ "parameter": "youngs_modulus", "min": -{widest_e:?}, "max": {widest_e:?}, "points": {axis} }},
      "y": {{ "parameter": "mass", "min": -{widest_m:?}, "max": {widest_m:?}, "points": {axis} }}
    }}
  }}
}}
"#,
        entries = tolerances.entries(),
        widest_e = tolerances.half("youngs_modulus"),
        widest_m = tolerances.half("mass"),
    ))
}

/// The pose of a template with tolerances that it bears: at this position, or between the exit points.
fn placed(
    robot: &Robot,
    position: Option<[f64; 3]>,
    payload: f64,
    free: &[Coordinate],
) -> Result<(Pose, Tolerances), StudyError> {
    let held = |position: &[f64; 3]| rest(robot, *position, payload, free);
    let given = match position {
        Some(position) => vec![held(&position).map_err(|error| {
            let expected = format!("a position that the robot holds with {payload} kg: {error}");
            StudyError::setting("position", format!("{position:?}"), expected)
        })?],
        None => Vec::new(),
    };
    let others = candidates(robot, !free.is_empty()).into_iter().filter_map(|place| held(&place).ok());
    let tried = given.into_iter().chain(others.take(if position.is_none() { FEW } else { 0 }));
    let load = Load::payload(payload);
    // Any robot with enough cables is held with small errors.
    let tolerances = |(pose, tension): &(Pose, f64)| match free {
        [] => Some(Tolerances::usual(robot, *tension)),
        free => Tolerances::held(robot, *tension, pose, &load, free),
    };
    with_tolerances(robot, tried, tolerances).map(|((pose, _), tolerances)| (pose, tolerances)).ok_or_else(
        || {
            let expected =
                "x,y,z [m], because the robot holds none of the positions tried between its exit points";
            StudyError::setting("position", "missing", expected)
        },
    )
}

/// Writes the text of [`template`] to a new file; `text` gets the path by which the file names the robot
/// file.
///
/// # Errors
/// [`StudyError::Write`], also if the file exists already; [`StudyError::Read`] of the robot file; those of
/// `text`.
pub fn write_template(
    path: &Path,
    robot: &Path,
    text: impl FnOnce(&str) -> Result<String, StudyError>,
) -> Result<(), StudyError> {
    let whole = |path: &Path| {
        std::fs::canonicalize(path).map_err(|source| StudyError::Read { path: path.to_owned(), source })
    };
    if let Some(file) = named_file(ROBOTS, robot) {
        return write_new(path.to_owned(), text(file.name)?.as_bytes()).map(|_| ());
    }
    let robot = whole(robot)?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let from_here = robot.strip_prefix(whole(folder)?).unwrap_or(&robot);
    let text = text(&from_here.display().to_string())?;
    write_new(path.to_owned(), text.as_bytes()).map(|_| ())
}

/// The first pose with its mean tension [N] that has tolerances, or the first one with the least.
fn with_tolerances(
    robot: &Robot,
    poses: impl Iterator<Item = (Pose, f64)>,
    tolerances: impl Fn(&(Pose, f64)) -> Option<Tolerances>,
) -> Option<((Pose, f64), Tolerances)> {
    let mut first = None;
    for one in poses {
        match tolerances(&one) {
            Some(found) => return Some((one, found)),
            None => first = first.or(Some(one)),
        }
    }
    first.map(|one| (one, Tolerances::least(robot, one.1)))
}

/// Positions of a robot of few cables at which smaller tolerances are tried.
const FEW: usize = 3;

/// Positions above each other in the middle of the exit points, between the lowest and the highest, or below them
/// and above the floor where all have one height; of few cables aside of it, where symmetry holds many poses.
fn candidates(robot: &Robot, is_few: bool) -> Vec<[f64; 3]> {
    let exits = || robot.cables.iter().map(|cable| cable.exit_point);
    let middle = exits().sum::<Vector3<f64>>() / robot.cables.len() as f64;
    let extent = |axis: usize| {
        let values = || exits().map(move |point| point[axis]);
        (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max))
    };
    let normal = robot.plane.map(Plane::normal);
    // In a level plane the positions are along y.
    let [across, along] = [usize::from(normal == Some(0)), if normal == Some(2) { 1 } else { 2 }];
    let ((left, right), (mut low, high)) = (extent(across), extent(along));
    let aside: &[f64] = if is_few { &[0.05, 0.1] } else { &[0.0] };
    if along == 2 && high - low < 0.2 * (right - left) {
        let (below, floor) = (high - 0.5 * (right - left), robot.floor());
        low = if 0.5 * (below + high) < floor { floor } else { below };
    }
    let shares = [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9];
    // To a centimetre: what users see, they change.
    let centimetres = |value: f64| rounded(value, 2);
    let at = |aside: f64, share: f64| {
        let aside = aside * (right - left);
        let mut place = <[f64; 3]>::from(middle);
        place[across] += aside;
        place[1] += if normal.is_none() { 0.6 * aside } else { 0.0 };
        place[along] = low + share * (high - low);
        let mut place = place.map(centimetres);
        if let Some(normal) = normal {
            let anchors = robot.cables.iter().map(|cable| cable.anchor_point[normal]).sum::<f64>();
            place[normal] = middle[normal] - anchors / robot.cables.len() as f64;
        }
        place
    };
    aside.iter().flat_map(|aside| shares.map(|share| at(*aside, share))).collect()
}

/// The coordinates that are found: those that are named, else the angles first.
fn free_coordinates(robot: &Robot, named: &[Coordinate]) -> Result<Vec<Coordinate>, StudyError> {
    use Coordinate::{Pitch, Roll, X, Y, Yaw, Z};
    let freedoms = robot.freedoms();
    let (cables, count) = (robot.cables.len(), freedoms.count());
    let missing = count.saturating_sub(cables);
    if named.is_empty() {
        let free = [Roll, Pitch, Yaw, Z, Y, X].into_iter().filter(|name| freedoms.contains(name.component()));
        return Ok(free.take(missing).collect());
    }
    if named.len() != missing {
        let named: Vec<_> = named.iter().map(ToString::to_string).collect();
        let expected =
            format!("{missing} of x, y, z, roll, pitch, yaw, for {cables} cables and {count} free motions");
        return Err(StudyError::setting("free", format!("[{}]", named.join(", ")), expected));
    }
    Ok(named.to_vec())
}

/// A pose as a study file has it; level, or to a thousandth of a degree. Where coordinates are found, all
/// observations find them near those of the nominal robot at rest.
fn described(pose: &Pose, is_found: bool) -> String {
    let position = if is_found { pose.position.map(|x| rounded(x, 4)) } else { pose.position };
    let position: [f64; 3] = position.into();
    if !is_found {
        return format!("{{ \"position\": {position:?} }}");
    }
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    let angles = [roll, pitch, yaw].map(|angle| rounded(angle.to_degrees(), 3));
    format!("{{ \"position\": {position:?}, \"rpy_deg\": {angles:?} }}")
}

/// Where the nominal robot rests at a position, and its mean tension [N], if tensions are feasible with and
/// without the payload [kg].
fn rest(
    robot: &Robot,
    position: [f64; 3],
    payload: f64,
    free: &[Coordinate],
) -> Result<(Pose, f64), cdpr_statics::StaticsError> {
    let [x, y, z] = position;
    let found = deflection(robot, WantedPose::at(&Pose::at(x, y, z)).free(free), &Load::payload(payload))?;
    let tensions = found.unloaded.equilibrium.tensions();
    let mean = tensions.iter().sum::<f64>() / tensions.len() as f64;
    // Only what is free has moved.
    let pose = if free.is_empty() { Pose::at(x, y, z) } else { found.unloaded.equilibrium.pose };
    Ok((pose, mean))
}

/// Where the numbers of a template come from, as a JSON string.
fn source(tolerances: &Tolerances) -> String {
    let mut text =
        "Template of cdpr study new: every tolerance is an assumption, to be replaced by what is known."
            .to_owned();
    if tolerances.share < 1.0 {
        let smaller = 1.0 / tolerances.share;
        text += &format!(
            " Those of points and set-points are {smaller} times smaller than usual: with larger ones the \
             few cables do not hold all of the coordinates that are given."
        );
    }
    serde_json::Value::from(text).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fs::files::open_robot;
    use crate::model::study::Study;

    fn caroca() -> Robot {
        Robot::from_library("caroca").unwrap()
    }

    #[test]
    fn the_template_of_each_robot_is_a_study_that_its_robot_holds() {
        let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/robots"));
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let robot = open_robot(&path).unwrap();
            let text = template(&robot, path.to_str().unwrap(), None, None, &[]).unwrap();
            assert_eq!(text.contains("\"free\": [\"roll\", \"pitch\"]"), robot.cables.len() == 4);
            let refused =
                template(&robot, "robot.json", None, None, &[Coordinate::Yaw]).unwrap_err().to_string();
            assert!(refused.starts_with("free is [yaw]: expected "), "{refused}");
            let study = Study::from_json(&text, &folder.join("my-study.json")).unwrap();
            assert_eq!(study.robot, robot);
            assert_eq!(study.file.sensitivity.is_some(), robot.is_fully_actuated());
        }
    }

    #[test]
    fn a_point_mass_has_no_tolerances_of_offsets_that_its_format_does_not_know() {
        let cable =
            |[x, y]: [i32; 2]| format!(r#"{{ "exit_point": [{x}, {y}, 30], "anchor_point": [0, 0, 0] }}"#);
        let cables = [[-50, -35], [50, -35], [50, 35], [-50, 35]].map(cable).join(", ");
        let text = format!(
            r#"{{ "format": "cdpr-robot/1", "name": "Stadium camera", "gravity": 9.81,
                "platform": {{ "mass": 40, "center_of_mass": [0, 0, 0], "point": true }},
                "cable": {{ "section": 8.0e-5, "youngs_modulus": 3.8e10, "linear_density": 0.078 }},
                "tension_limits": {{ "min": 100, "max": 8000 }}, "cables": [{cables}] }}"#
        );
        let robot = Robot::from_json(&text).unwrap();
        let study = template(&robot, "stadium.json", None, None, &[]).unwrap();
        assert!(study.contains("\"b\": { \"law\"") && !study.contains("\"a\": {"), "{study}");
        assert!(!study.contains("\"cog\": {"), "{study}");
        let notes = template_notes(&robot);
        assert!(notes.contains("\n    b  ") && !notes.contains("cog"), "{notes}");
        // Four cables: three scalars, twelve coordinates of exit points, four offsets.
        let cost = template_cost(&robot);
        assert!(cost.contains(&(SALTELLI_BLOCKS * (3 + 12 + 4 + 2)).to_string()), "{cost}");
        // Lengths are absolute where there are leads, and that is said of the output that has them.
        let absolute =
            |robot: &Robot| template_notes(robot).contains("with position the lengths are absolute");
        let mut led = caroca();
        led.cables[0].lead = 2.0;
        assert!(!absolute(&robot) && !absolute(&caroca()) && absolute(&led));
    }

    #[test]
    fn a_platform_in_a_plane_stays_in_it() {
        let mut robot = caroca();
        for plane in [Plane::Xy, Plane::Xz, Plane::Yz] {
            robot.plane = Some(plane);
            let k = plane.normal();
            robot.cables.iter_mut().for_each(|of| (of.exit_point[k], of.anchor_point[k]) = (1.25, 0.125));
            assert!(candidates(&robot, false).iter().all(|place| place[k] == 1.125), "{plane:?}");
        }
    }

    #[test]
    fn a_position_out_of_reach_is_refused_with_the_reason() {
        let refused = template(&caroca(), "caroca.json", Some([0.0, 0.0, 9.0]), None, &[]).unwrap_err();
        let begin = "position is [0.0, 0.0, 9.0]: expected a position that the robot holds";
        assert!(refused.to_string().starts_with(begin), "{refused}");
    }
}
