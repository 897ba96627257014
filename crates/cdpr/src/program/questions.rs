//! Questions about numbers that are probably not what was meant: asked on the standard error and in JSON. The
//! number is taken as it is, and the program ends with exit code 3.
//!
//! Robots and studies are opened here and nowhere else, so that no command forgets to ask.

use crate::program::error::ProgramError;
use crate::program::said;
use cdpr_assess::{HELD, WorkspaceSummary, doubtful_rest};
use cdpr_dynamics::moves::SetPoint;
use cdpr_dynamics::simulate::{Change, Event, Series};
use cdpr_robot::{Doubt, Pose, Robot, Vector3, Wrench, place_of, plausible, rounded, short, shown};
use cdpr_statics::{DirectSolution, Load};
use cdpr_study::{Access, ErrorModel, InputKind, StoredStudy, Study, is_standard_input, read_text};
use serde::Serialize;
use std::path::Path;
use std::sync::{Mutex, Once, PoisonError};

/// A question.
#[derive(Serialize)]
struct Asked {
    #[serde(flatten)]
    doubt: Doubt,
    /// The file, with line and column of the field where they are known.
    #[serde(skip_serializing_if = "Option::is_none")]
    place: Option<String>,
}

/// What was asked so far.
static ASKED: Mutex<Vec<Asked>> = Mutex::new(Vec::new());

/// Asks what was not asked before.
pub(crate) fn ask(doubts: impl IntoIterator<Item = Doubt>) {
    ask_at(doubts, |_| None);
}

/// Asks about what a file says.
fn ask_in(path: &Path, doubts: impl IntoIterator<Item = Doubt>) {
    // The robot of a library has no file.
    // A pipe is read once.
    let is_read_again = path.is_file() || is_standard_input(path);
    let text = is_read_again.then(|| read_text(path, InputKind::Study).ok()).flatten();
    ask_at(doubts, |field| {
        let text = text.as_deref()?;
        let place = place_of(text, field).filter(|place| *place != place_of(text, "").unwrap_or_default());
        let place =
            place.map_or_else(String::new, |(line, column)| format!(", line {line}, column {column}"));
        Some(format!("{}{place}", path.display()))
    });
}

fn ask_at(doubts: impl IntoIterator<Item = Doubt>, place: impl Fn(&str) -> Option<String>) {
    let mut asked = ASKED.lock().unwrap_or_else(PoisonError::into_inner);
    for doubt in doubts {
        if !asked.iter().any(|before| before.doubt == doubt) {
            eprintln!("question: {doubt}");
            let place = place(&doubt.quantity);
            place.iter().for_each(|place| eprintln!("    in {place}"));
            asked.push(Asked { doubt, place });
        }
    }
}

/// Whether anything was asked.
pub(crate) fn were_asked() -> bool {
    !ASKED.lock().unwrap_or_else(PoisonError::into_inner).is_empty()
}

/// The text of a JSON object with the questions as its last field, if there are any.
pub(crate) fn added_to(object: String) -> serde_json::Result<String> {
    let asked = ASKED.lock().unwrap_or_else(PoisonError::into_inner);
    let Some(open) = object.strip_suffix('}').filter(|_| !asked.is_empty()) else { return Ok(object) };
    let comma = if open == "{" { "" } else { "," };
    Ok(format!("{open}{comma}\"questions\":{}}}", serde_json::to_string(&*asked)?))
}

/// The robot of a file.
pub(crate) fn open_robot(path: &Path) -> Result<Robot, ProgramError> {
    let robot = cdpr_study::open_robot(path)?;
    said::about(&robot.name);
    let cables = robot.cables.len();
    said::detail(format_args!("robot {}: {}, {cables} cables", path.display(), shown(&robot.name)));
    ask_in(path, plausible::robot(&robot));
    Ok(robot)
}

/// The study of a file.
pub(crate) fn open_study(path: &Path) -> Result<Study, ProgramError> {
    let study = Study::open(path)?;
    said::detail(format_args!("study {} of the robot {}", path.display(), shown(&study.robot.name)));
    ask_in(&path.with_file_name(&study.file.robot), plausible::robot(&study.robot));
    ask_in(path, study.doubts());
    Ok(study)
}

/// The study of a folder of results.
pub(crate) fn take_results(folder: &Path, access: Access) -> Result<StoredStudy, ProgramError> {
    let stored = cdpr_study::take_results(folder, access)?;
    ask(plausible::robot(&stored.study.robot).into_iter().chain(stored.study.doubts()));
    Ok(stored)
}

/// The error model of a file.
pub(crate) fn open_errors(path: &Path, robot: &Robot) -> Result<ErrorModel, ProgramError> {
    let model = cdpr_study::open_errors(path, robot)?;
    about_model(robot, &model);
    Ok(model)
}

/// Asks about what a design file says.
pub(crate) fn about_design(path: &Path, doubts: impl IntoIterator<Item = Doubt>) {
    ask_in(path, doubts);
}

/// Asks about the deviations of an error model.
pub(crate) fn about_model(robot: &Robot, model: &ErrorModel) {
    ask(model.doubts(robot));
}

/// Asks about a pose.
pub(crate) fn about_pose(robot: &Robot, name: &str, pose: &Pose) {
    ask(odd_pose(robot, name, pose));
}

/// Asks about the first pose to which a load moves the platform from above into the ground.
pub(crate) fn about_displaced(robot: &Robot, from: &Pose, to: &Pose) {
    static ASKED: Once = Once::new();
    let name = "the pose under the load";
    let doubt =
        plausible::in_ground(robot, name, to).filter(|_| plausible::in_ground(robot, name, from).is_none());
    if let Some(doubt) = doubt {
        ASKED.call_once(|| {
            ask([Doubt { meant: "a smaller load, or a pose that is higher".to_owned(), ..doubt }]);
        });
    }
}

/// A pose that is far away, in the ground, or out of the plane of a planar robot.
fn odd_pose(robot: &Robot, name: &str, pose: &Pose) -> Option<Doubt> {
    plausible::position(robot, name, &pose.position)
        .or_else(|| plausible::in_ground(robot, name, pose))
        .or_else(|| plausible::out_of_plane(robot, name, pose))
}

/// Asks about the first of several poses that is odd, and how many are.
pub(crate) fn about_poses(robot: &Robot, name: &str, poses: &[Pose]) {
    let mut doubts = poses.iter().enumerate().filter_map(|(i, pose)| Some((i, odd_pose(robot, name, pose)?)));
    let Some((i, doubt)) = doubts.next() else { return };
    let others = match doubts.count() {
        0 => String::new(),
        1 => ", and of another pose".to_owned(),
        more => format!(", and of {more} more poses"),
    };
    let quantity = format!("pose {} of {}", i + 1, doubt.quantity);
    ask([Doubt { quantity, value: format!("{}{others}", doubt.value), ..doubt }]);
}

/// Asks about the lowest place of a move that goes into the ground between poses that do not.
pub(crate) fn about_curve(robot: &Robot, poses: &[Pose], points: &[SetPoint]) {
    let in_ground = |name: &str, pose: &Pose| plausible::in_ground(robot, name, pose);
    let lowest = points.iter().min_by(|a, b| a.pose.position.z.total_cmp(&b.pose.position.z));
    let doubt =
        lowest.and_then(|point| in_ground(&format!("the move at {} s", rounded(point.time, 4)), &point.pose));
    let is_known = poses.iter().any(|pose| in_ground("pose", pose).is_some());
    ask(doubt.filter(|_| !is_known).map(|doubt| {
        let meant = format!("more poses: between those that are given a move is curved; {}", doubt.meant);
        Doubt { meant, ..doubt }
    }));
}

/// Asks about the first odd corner of a region, which is called `name`.
pub(crate) fn about_corners(robot: &Robot, name: &str, corners: &[Pose]) {
    let name = format!("a corner of {name}");
    ask(corners.iter().find_map(|pose| odd_pose(robot, &name, pose)));
}

/// Asks about a load.
pub(crate) fn about_load(robot: &Robot, load: &Load) {
    ask(plausible::load(robot, load.payload, &load.wrench));
}

/// Asks about the first wrench of a set that no cables bear.
pub(crate) fn about_wrenches<'a>(robot: &Robot, wrenches: impl IntoIterator<Item = &'a Wrench>) {
    let first = wrenches.into_iter().map(|wrench| plausible::wrench(robot, "wrench: ", wrench));
    ask(first.flatten().take(1));
}

/// Asks about markers on the platform, in the platform frame.
pub(crate) fn about_markers(robot: &Robot, markers: impl IntoIterator<Item = Vector3<f64>>) {
    ask(markers.into_iter().find_map(|marker| plausible::on_platform(robot, "marker", &marker)));
}

/// Asks about a map on which no position is held.
pub(crate) fn about_map(summary: &WorkspaceSummary) {
    let held = summary.rows.iter().any(|row| row.status == HELD || row.recomputed_status == Some(HELD));
    ask((!held).then(|| plausible::nothing_held(summary.rows.len())));
}

/// What is said of a map on which some positions are held, and fewer than half.
pub(crate) fn few_held(summary: &WorkspaceSummary) -> Option<String> {
    let is_held = |status: Option<&str>| status == Some(HELD);
    let rows = &summary.rows;
    let held = rows.iter().filter(|row| is_held(Some(row.status)) || is_held(row.recomputed_status)).count();
    let all = rows.len();
    let ways = if summary.is_loaded() { ", with the lengths kept or with tensions for the load" } else { "" };
    (held > 0 && 2 * held < all)
        .then(|| format!("fewer than half of the positions are held, {held} of {all}{ways}"))
}

/// Asks about where a platform was found to rest with given lengths [m], from a stated start and under a
/// load.
pub(crate) fn about_rest(
    robot: &Robot,
    name: &str,
    given: (&[f64], &Load),
    found: &DirectSolution,
    start: Option<&Pose>,
) {
    ask(doubtful_rest(robot, name, given, found, start));
}

/// Asks about the first event that begins after the end of a motion [s], and about the first one that takes
/// more off the platform than the payload [kg].
pub(crate) fn about_events(events: &[Event], payload: f64, until: f64) {
    let mut order: Vec<(usize, &Event)> = events.iter().enumerate().collect();
    order.sort_by(|one, other| one.1.time.total_cmp(&other.1.time));
    let late = order.iter().find(|(_, event)| event.time > until).map(|(i, event)| {
        let (why, meant) =
            (format!("the motion ends at {until} s, before it"), "a later end, or an earlier event");
        Doubt::new(format!("event {}, t", i + 1), format!("{} s", short(event.time)), why, meant)
    });
    let mut left = payload;
    let too_much = order.iter().find_map(|(i, event)| {
        let Change::Payload(change) = event.change else { return None };
        left += change;
        let why = format!(
            "{} kg of it are the platform's own mass, its inertia unchanged",
            short(rounded(-left, 9))
        );
        let meant = "a load on the platform before that has at least this mass";
        (left < -1e-9 * change.abs()).then(|| {
            Doubt::new(format!("event {}, payload", i + 1), format!("{} kg", short(change)), why, meant)
        })
    });
    ask(late.into_iter().chain(too_much));
}

/// Asks about a motion that strains a cable beyond what the models hold for.
pub(crate) fn about_strain(robot: &Robot, motion: &Series) {
    ask(motion.overstrained(robot));
}

/// Asks about unstrained lengths.
pub(crate) fn about_lengths(robot: &Robot, lengths: &[f64]) {
    ask(plausible::lengths(robot, lengths));
}

/// Asks about standard deviations of sensors by their names.
pub(crate) fn about_noise(robot: &Robot, named: &[(String, f64)]) {
    let unit = |name: &str| match name {
        "position" | "length" | "lengths" | "displacement" | "marker" => "m",
        "rotation" | "swivel" => "rad",
        "tension" | "tensions" => "N",
        _ => "",
    };
    ask(named.iter().filter_map(|(name, std)| plausible::noise(robot, name, unit(name), *std)));
}

/// Asks about the standard deviation of a position that is to be reached [m].
pub(crate) fn about_accuracy(robot: &Robot, accuracy: Option<f64>) {
    let doubt = accuracy.and_then(|std| plausible::noise(robot, "position", "m", std));
    ask(doubt.map(|doubt| Doubt { quantity: "accuracy".to_owned(), ..doubt }));
}

/// Asks about a result of which more than half of the observations are missing.
pub(crate) fn about_failed(name: &str, failed: usize, all: usize) {
    ask(plausible::more_than_half_failed(name, failed, all));
}
