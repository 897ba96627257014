//! WireX: one `.wcrfx` file, XML. <https://gitlab.cc-asp.fraunhofer.de/wek/wirex>
//!
//! The third column of the matrix of a `base`, (a13, a23, a33), is the direction in which the cable enters
//! the pulley. Many files keep values of the template, which are questioned.

use crate::document::{Document, Node};
use crate::draft::{Draft, DraftCable, NoteKind};
use crate::error::ExchangeError;
use cdpr_robot::{CableProperties, Matrix3, Pulley, Vector3};
use std::f64::consts::PI;

/// Reads a robot.
///
/// # Errors
/// [`ExchangeError::Value`] with file, line and element.
pub(crate) fn read(document: &Document) -> Result<Draft, ExchangeError> {
    let robot = document.root.need("robot")?;
    let mut draft =
        Draft { source: format!("Imported from {} of WireX.", document.file), ..Draft::default() };
    let name = robot.get("@name").map_or("", Node::text);
    draft.name = if name.is_empty() { "robot" } else { name }.to_owned();
    for said in ["@description", "@author"].into_iter().filter_map(|name| robot.get(name)) {
        draft.source += &format!(" {}.", said.text());
    }
    let properties = match document.root.get("cable") {
        Some(cable) => read_properties(&mut draft, document, cable)?,
        None => None,
    };
    let min = match document.root.get("cable") {
        Some(cable) => cable.number_in("@minimum_load")?,
        None => None,
    };
    for chain in robot.need("geometry")?.all("chain") {
        let (base, platform) = (chain.need("base")?, chain.need("platform")?);
        let radius = base.number_in("@radius")?.unwrap_or(0.0);
        let axis = vector(base, ["@a13", "@a23", "@a33"]);
        let pulley = if radius > 0.0 { Some(Pulley { radius, axis: axis? }) } else { None };
        let max = winch_limit(&mut draft, document, chain)?;
        draft.cables.push(DraftCable {
            exit_point: vector(base, ["@x", "@y", "@z"])?,
            anchor_point: vector(platform, ["@x", "@y", "@z"])?,
            pulley,
            min,
            max,
            properties: properties.clone(),
            stiffness: None,
        });
    }
    read_platform(&mut draft, document, robot.need("platform")?)?;
    question_axes(&mut draft, document, robot);
    draft.notes.dedup_by(|a, b| a.text == b.text);
    draft.list_unread(document);
    Ok(draft)
}

fn vector(node: &Node, names: [&str; 3]) -> Result<Vector3<f64>, ExchangeError> {
    let [x, y, z] = names.map(|name| node.need(name)?.number());
    Ok(Vector3::new(x?, y?, z?))
}

/// Properties of the cables, if the file has all of them.
fn read_properties(
    draft: &mut Draft,
    document: &Document,
    cable: &Node,
) -> Result<Option<CableProperties>, ExchangeError> {
    let radius = cable.number_in("@radius")?;
    let density = cable.number_in("@weight")?;
    let modulus = cable.number_in("@elasticity")?;
    let breaking_force = cable.number_in("@breaking_load")?;
    let (Some(radius), Some(linear_density), Some(youngs_modulus)) = (radius, density, modulus) else {
        return Ok(None);
    };
    let mut question = |text: &str| draft.note(NoteKind::Questioned, document, cable, text);
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

/// Greatest force of the winch of a chain [N].
fn winch_limit(draft: &mut Draft, document: &Document, chain: &Node) -> Result<Option<f64>, ExchangeError> {
    let kind = chain.get("@winchtype").map(Node::text);
    let of_kind = |winch: &&Node| winch.get("@name").map(Node::text) == kind;
    let Some(winch) = document.root.all("winch").find(of_kind) else { return Ok(None) };
    let Some(cable) = winch.get("cable") else { return Ok(None) };
    let Some(limit) = cable.get("@f_max") else { return Ok(None) };
    let max = limit.number()?;
    if max == 720.0 {
        let text = "the greatest force of the winch, 720 N, is that of the template";
        draft.note(NoteKind::Questioned, document, limit, text);
    }
    Ok(Some(max).filter(|max| *max > 0.0))
}

fn read_platform(draft: &mut Draft, document: &Document, platform: &Node) -> Result<(), ExchangeError> {
    let mass = platform.need("@mass")?;
    draft.mass = Some(mass.number()?);
    if let Some(center) = platform.get("centerofgravity") {
        draft.center_of_mass = Some(vector(center, ["@x", "@y", "@z"])?);
    }
    let of_template = draft.center_of_mass == Some(Vector3::new(0.0, 1.0, 0.2));
    match (draft.mass == Some(25.0), of_template) {
        (true, true) => {
            let text = "the mass of 25 kg and the centre of mass (0, 1, 0.2) m are those of the template";
            draft.note(NoteKind::Questioned, document, platform, text);
        }
        (false, true) => {
            let text = "the centre of mass (0, 1, 0.2) m is that of the template";
            draft.note(NoteKind::Questioned, document, platform, text);
        }
        _ => {}
    }
    let names = ["@Ixx", "@Iyy", "@Izz", "@Ixy", "@Ixz", "@Iyz"];
    if let Some(inertia) =
        platform.get("inertiatensor").filter(|node| names.iter().all(|name| node.has(name)))
    {
        let [xx, yy, zz, xy, xz, yz] = names.map(|name| inertia.need(name)?.number());
        let (xy, xz, yz) = (xy?, xz?, yz?);
        draft.inertia = Some(Matrix3::new(xx?, xy, xz, xy, yy?, yz, xz, yz, zz?));
        draft.assume("the inertia is about the centre of mass");
    }
    Ok(())
}

/// Questions axes of the template where exit points lie above the platform.
fn question_axes(draft: &mut Draft, document: &Document, robot: &Node) {
    let upwards = |cable: &DraftCable| cable.pulley.is_some_and(|pulley| pulley.axis == Vector3::z());
    if !draft.cables.is_empty() && draft.cables.iter().all(upwards) {
        let text = "all matrices are those of the template: cables enter all pulleys from below";
        draft.note(NoteKind::Questioned, document, robot, text);
    }
}
