//! The YAML of oKermorgant's cdpr for ROS and Gazebo. <https://github.com/oKermorgant/cdpr>
//!
//! Its `cable` describes the rods of the simulator and no cable. The robot may lie within other entries, such
//! as `model`. The lower corner of the `frame`, less the radius of its bars, is the ground.

use crate::document::{Document, Node};
use crate::draft::{Draft, DraftCable};
use crate::error::ExchangeError;
use cdpr_robot::{Matrix3, Vector3};

/// Whether a file has a robot.
///
/// # Errors
/// [`ExchangeError::Value`] where it has several.
pub(crate) fn has_robot(document: &Document) -> Result<bool, ExchangeError> {
    Ok(find(document)?.is_some())
}

/// The node with a robot, in whichever of the documents it lies.
fn find(document: &Document) -> Result<Option<Node<'_>>, ExchangeError> {
    let mut open = vec![document.all()];
    let mut found: Option<Node> = None;
    while let Some(node) = open.pop() {
        if node.has("points") {
            if let Some(first) = found {
                let first = format!("one, as there is one in line {}, too", first.line());
                return Err(node.value_error(Some("points"), "a further robot", &first));
            }
            found = Some(node);
        } else {
            open.extend(node.children());
        }
    }
    Ok(found)
}

/// Reads a robot.
///
/// # Errors
/// [`ExchangeError::Value`] with file, line and element.
pub(crate) fn read(document: &Document) -> Result<Draft, ExchangeError> {
    let robot = find(document)?.unwrap_or_else(|| document.first());
    robot.reach();
    let mut draft = Draft::of_file(&document.file, "oKermorgant's cdpr");
    draft.center_of_mass = Some(Vector3::zeros());
    draft.assume("the platform's origin is its centre of mass, as in the simulator");
    let platform = robot.need("platform")?;
    draft.mass = platform.number_in("mass")?;
    if let Some(inertia) = platform.get("inertia") {
        let [xx, yy, zz, xy, xz, yz] = inertia.components()?;
        draft.inertia = Some(Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz));
    }
    let limits = robot.get("joints").and_then(|joints| joints.get("actuated"));
    let limit = |name: &str| limits.map_or(Ok(None), |limits| limits.number_in(name));
    let (min, max) = (limit("min")?, limit("effort")?);
    if let Some(frame) = robot.get("frame")
        && let Some(lower) = frame.get("lower")
    {
        draft.ground_z = Some(lower.vector()?.z - frame.number_in("radius")?.unwrap_or(0.0));
    }
    for point in robot.need("points")?.elements() {
        draft.cables.push(DraftCable {
            exit_point: point.need("frame")?.vector()?,
            anchor_point: point.need("platform")?.vector()?,
            min,
            max,
            ..DraftCable::default()
        });
    }
    let around = robot.plain_path();
    draft.list_unread(document, |within, name| is_harmless(&around, within, name))?;
    Ok(draft)
}

/// Pictures, the simulator's rods, the start, and entries of the file outside of the robot.
fn is_harmless(robot: &str, within: &str, name: &str) -> bool {
    // Another document.
    if name.is_empty() {
        return false;
    }
    let Some(within) = within.strip_prefix(robot) else { return true };
    match within.trim_start_matches('/') {
        "" => ["cable", "sim_cables", "name", "controllers"].contains(&name),
        "frame" => ["color", "type", "upper", "mass"].contains(&name),
        "platform" => ["color", "size", "type", "visual", "position", "mesh", "name"].contains(&name),
        "joints" => name == "passive",
        "joints/actuated" => ["damping", "velocity"].contains(&name),
        _ => false,
    }
}
