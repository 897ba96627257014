//! WireX: one `.wcrfx` file, XML. <https://gitlab.cc-asp.fraunhofer.de/wek/wirex>
//!
//! The third column of the matrix of a `base`, (a13, a23, a33), is the direction in which the cable enters
//! the pulley. Many files keep values of the template, which are questioned.

use crate::document::{Document, Node};
use crate::draft::{Draft, DraftCable, NoteKind};
use crate::error::ExchangeError;
use cdpr_robot::{CableProperties, Matrix3, Plane, Pulley, Vector3};
use std::collections::{HashMap, HashSet};
use std::f64::consts::PI;

/// Reads a robot.
///
/// # Errors
/// [`ExchangeError::Value`] with file, line and element.
pub(crate) fn read(document: &Document) -> Result<Draft, ExchangeError> {
    let root = document.root();
    let robot = root.need("robot")?;
    let mut draft =
        Draft { source: format!("Imported from {} of WireX.", document.file), ..Draft::default() };
    let name = robot.text_in("@name");
    draft.name = if name.is_empty() { "robot" } else { name }.to_owned();
    for said in ["@description", "@author"].map(|name| robot.text_in(name)) {
        if !said.is_empty() {
            draft.source += &format!(" {said}.");
        }
    }
    let mut properties = None;
    let (mut min, mut max) = (None, None);
    if let Some(cable) = root.get("cable") {
        properties = read_properties(&mut draft, &cable)?;
        min = positive(cable.number_in("@minimum_load")?);
    }
    if let Some(application) = robot.get("application") {
        // Both have to be kept: the cable's and the application's.
        min = strictest(min, positive(application.number_in("@min_cable_load")?), f64::max);
        max = positive(application.number_in("@max_cable_load")?);
    }
    let winches = winch_limits(&mut draft, &root)?;
    for chain in robot.need("geometry")?.all("chain") {
        let (base, platform) = (chain.need("base")?, chain.need("platform")?);
        let radius = base.number_in("@radius")?.unwrap_or(0.0);
        let of_winch = winches.get(chain.text_in("@winchtype")).copied();
        draft.cables.push(DraftCable {
            exit_point: vector(&base, ["@x", "@y", "@z"])?,
            anchor_point: vector(&platform, ["@x", "@y", "@z"])?,
            pulley: if radius > 0.0 { Some(Pulley { radius, axis: vector(&base, AXIS)? }) } else { None },
            min,
            max: strictest(max, of_winch, f64::min),
            properties: properties.clone(),
            ..DraftCable::default()
        });
    }
    read_pattern(&mut draft, &robot)?;
    read_platform(&mut draft, &robot.need("platform")?)?;
    question_axes(&mut draft, &robot);
    draft.list_unread(document, is_harmless)?;
    Ok(draft)
}

/// Attributes of a matrix with the direction in which a cable enters a pulley.
const AXIS: [&str; 3] = ["@a13", "@a23", "@a33"];

fn positive(value: Option<f64>) -> Option<f64> {
    value.filter(|value| *value > 0.0)
}

/// The stricter one of two limits.
fn strictest(a: Option<f64>, b: Option<f64>, stricter: fn(f64, f64) -> f64) -> Option<f64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(stricter(a, b)),
        _ => a.or(b),
    }
}

/// Names, the orientations of platform and pulleys but for the axes, winches, prices, the application's load.
fn is_harmless(within: &str, name: &str) -> bool {
    let of_matrix = name.len() == 4 && name.starts_with("@a");
    within.contains("winch")
        || of_matrix
        || ["@name", "@id", "@version", "@description", "@author", "@generator", "@date"].contains(&name)
        || match within {
            "models" => ["cable", "winch", "controller"].contains(&name),
            "models/cable" => !name.ends_with("_load"),
            "models/robot/platform" => ["@swing_angle", "geometry"].contains(&name),
            "models/robot/application" => ["@load_mass", "@load_moment"].contains(&name),
            "models/robot" => name == "controller",
            _ => false,
        }
}

/// Which motions the platform has.
fn read_pattern(draft: &mut Draft, robot: &Node) -> Result<(), ExchangeError> {
    let Some(pattern) = robot.get("@motionpattern") else { return Ok(()) };
    let (is_planar, held_rotation) = match pattern.text() {
        "" | "3R3T" => (false, false),
        "3T" => (false, true),
        "1R2T" => (true, false),
        "2T" => (true, true),
        _ => return Err(pattern.error("3R3T, 3T, 1R2T or 2T: other robots are not imported")),
    };
    draft.held_rotation = held_rotation;
    if is_planar {
        let lies_in = |plane: &Plane| {
            let first = draft.cables.first().map_or(0.0, |cable| cable.exit_point[plane.normal()]);
            draft.cables.iter().all(|cable| cable.exit_point[plane.normal()] == first)
        };
        let Some(plane) = [Plane::Xy, Plane::Xz, Plane::Yz].into_iter().find(lies_in) else {
            return Err(pattern.error("3R3T, as the exit points lie in no plane of the base frame"));
        };
        draft.plane = Some(plane);
    }
    Ok(())
}

fn vector(node: &Node, names: [&str; 3]) -> Result<Vector3<f64>, ExchangeError> {
    let [x, y, z] = names.map(|name| node.need(name)?.number());
    Ok(Vector3::new(x?, y?, z?))
}

/// Properties of the cables, if the file has all of them.
fn read_properties(draft: &mut Draft, cable: &Node) -> Result<Option<CableProperties>, ExchangeError> {
    let radius = cable.number_in("@radius")?;
    let density = cable.number_in("@weight")?;
    let modulus = cable.number_in("@elasticity")?;
    let breaking_force = cable.number_in("@breaking_load")?;
    let (Some(radius), Some(linear_density), Some(youngs_modulus)) = (radius, density, modulus) else {
        return Ok(None);
    };
    let mut question = |text: &str| draft.note(NoteKind::Questioned, cable, text);
    if (radius, linear_density, youngs_modulus) == (0.006, 0.023, 1.1e11) {
        question("the cable is that of the template: 6 mm radius, 0.023 kg/m, 110 GPa");
    }
    if GRADES.contains(&youngs_modulus) {
        question(
            "the modulus is a grade of steel wire, in N/mm² of strength: a steel rope has about 1e11 Pa",
        );
    }
    Ok(Some(CableProperties {
        diameter: Some(2.0 * radius),
        breaking_force: breaking_force.filter(|force| *force > 0.0),
        ..CableProperties::linear(PI * radius * radius, linear_density, youngs_modulus)
    }))
}

/// Strengths of steel wire [Pa].
const GRADES: [f64; 4] = [1.57e9, 1.77e9, 1.96e9, 2.16e9];

/// Greatest forces of the winches [N] by their names.
fn winch_limits<'a>(draft: &mut Draft, root: &Node<'a>) -> Result<HashMap<&'a str, f64>, ExchangeError> {
    let mut limits = HashMap::new();
    let mut names = HashSet::new();
    for winch in root.all("winch") {
        let name = winch.text_in("@name");
        if !names.insert(name) {
            return Err(winch.value_error(Some("@name"), &format!("{name:?}, there twice"), "one of a name"));
        }
        let Some(limit) = winch.get("cable").and_then(|cable| cable.get("@f_max")) else { continue };
        let max = limit.number()?;
        if max == 720.0 {
            let text = "the greatest force of the winch, 720 N, is that of the template";
            draft.note(NoteKind::Questioned, &limit, text);
        }
        if max > 0.0 {
            limits.insert(name, max);
        }
    }
    draft.notes.dedup_by(|a, b| a.text == b.text);
    Ok(limits)
}

fn read_platform(draft: &mut Draft, platform: &Node) -> Result<(), ExchangeError> {
    let mass = platform.need("@mass")?;
    draft.mass = Some(mass.number()?);
    if let Some(center) = platform.get("centerofgravity") {
        draft.center_of_mass = Some(vector(&center, ["@x", "@y", "@z"])?);
    }
    let of_template = draft.center_of_mass == Some(Vector3::new(0.0, 1.0, 0.2));
    match (draft.mass == Some(25.0), of_template) {
        (true, true) => {
            let text = "the mass of 25 kg and the centre of mass (0, 1, 0.2) m are those of the template";
            draft.note(NoteKind::Questioned, platform, text);
        }
        (false, true) => {
            let text = "the centre of mass (0, 1, 0.2) m is that of the template";
            draft.note(NoteKind::Questioned, platform, text);
        }
        _ => {}
    }
    let Some(inertia) = platform.get("inertiatensor") else { return Ok(()) };
    let names = ["@Ixx", "@Iyy", "@Izz", "@Ixy", "@Ixz", "@Iyz"];
    if names.iter().all(|name| inertia.has(name)) {
        let [xx, yy, zz, xy, xz, yz] = names.map(|name| inertia.need(name)?.number());
        let (xy, xz, yz) = (xy?, xz?, yz?);
        draft.inertia = Some(Matrix3::new(xx?, xy, xz, xy, yy?, yz, xz, yz, zz?));
        draft.assume("the inertia is about the centre of mass");
    } else if inertia.text_in("@Ixx") == "14" {
        draft.note(NoteKind::Questioned, &inertia, "the inertia, Ixx 14 alone, is that of the template");
        inertia.leave_out();
    }
    Ok(())
}

/// Questions axes of the template where exit points lie above the platform.
fn question_axes(draft: &mut Draft, robot: &Node) {
    let upwards = |cable: &DraftCable| cable.pulley.is_some_and(|pulley| pulley.axis == Vector3::z());
    if !draft.cables.is_empty() && draft.cables.iter().all(upwards) {
        let text = "all matrices are those of the template: cables enter all pulleys from below";
        draft.note(NoteKind::Questioned, robot, text);
    }
}
