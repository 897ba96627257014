//! CASPR: bodies and cables, two XML files. <https://github.com/darwinlau/CASPR>
//!
//! `attachment_reference="com"` shifts anchor points by the centre of mass. `K` of a linear spring is EA [N].
//! A pulley enters at `fixed_location` along `cable_entry_vector`, as in a robot file.

use crate::document::{Document, Node};
use crate::draft::{Draft, DraftCable, ImportOptions, NoteKind};
use crate::error::ExchangeError;
use cdpr_robot::{Matrix3, Plane, Pulley, Vector3};

/// Reads the bodies and the cables of a robot with one body.
///
/// # Errors
/// [`ExchangeError::Value`] with file, line and element.
pub(crate) fn read(
    bodies: &Document,
    cables: &Document,
    options: &ImportOptions,
) -> Result<Draft, ExchangeError> {
    let mut draft = Draft::default();
    read_body(&mut draft, bodies)?;
    let set = cable_set(&cables.root, options)?;
    let set_name = set.need("@id")?.text();
    let center_of_mass = draft.center_of_mass.unwrap_or_default();
    for cable in set.elements() {
        draft.cables.push(read_cable(cable, &center_of_mass)?);
    }
    draft.source =
        format!("Imported from {} and {} of CASPR, cable set {set_name}.", bodies.file, cables.file);
    let others: Vec<&Node> = cables.root.all("cable_set").filter(|other| other.path != set.path).collect();
    others.iter().for_each(|other| other.leave_out());
    let others: Vec<_> = others.iter().filter_map(|other| Some(other.get("@id")?.text())).collect();
    if !others.is_empty() {
        let text = format!("further cable sets: {}", others.join(", "));
        draft.note(NoteKind::NoPlace, cables, &cables.root, text);
    }
    question(&mut draft, bodies);
    draft.list_unread(bodies);
    draft.list_unread(cables);
    Ok(draft)
}

fn read_body(draft: &mut Draft, bodies: &Document) -> Result<(), ExchangeError> {
    let links: Vec<_> = bodies.root.need("links")?.elements().collect();
    let [link] = links[..] else {
        let element = format!("{}/links", bodies.root.path);
        let value = format!("a list of {}", links.len());
        let at = links.get(1).copied().unwrap_or(&bodies.root);
        return Err(at.error_at(
            element,
            value,
            "one link: robots with several bodies are not imported".to_owned(),
        ));
    };
    if link.name != "link_rigid" {
        return Err(link.error_at(link.path.clone(), link.name.clone(), "link_rigid".to_owned()));
    }
    draft.name = link.get("@name").map_or("robot", Node::text).to_owned();
    let joint = link.need("joint")?.need("@type")?;
    draft.plane = match joint.text() {
        "PLANAR_XY" => Some(Plane::Xy),
        "PLANAR_XZ" => Some(Plane::Xz),
        "PLANAR_YZ" => Some(Plane::Yz),
        spatial if spatial.starts_with("SPATIAL_") => None,
        _ => return Err(joint.error("SPATIAL_* or PLANAR_XY, _XZ or _YZ: other joints are not imported")),
    };
    if let Some(parent) = link.get("parent")
        && let Some(number) = parent.get("num")
        && number.number()? != 0.0
    {
        return Err(number.error("0, the frame: robots with several bodies are not imported"));
    }
    let physical = link.need("physical")?;
    let mass = physical.need("mass")?.number()?;
    let center_of_mass = physical.need("com_location")?.vector()?;
    draft.mass = Some(mass);
    draft.center_of_mass = Some(center_of_mass);
    if let Some(inertia) = physical.get("inertia") {
        draft.inertia = Some(read_inertia(inertia, mass, &center_of_mass)?);
    }
    Ok(())
}

/// Inertia about the centre of mass: of one about the joint, the part of the mass is taken off.
fn read_inertia(node: &Node, mass: f64, c: &Vector3<f64>) -> Result<Matrix3<f64>, ExchangeError> {
    let entry = |name: &str| node.need(name)?.number();
    let [xx, yy, zz] = [entry("Ixx")?, entry("Iyy")?, entry("Izz")?];
    let [xy, xz, yz] = [entry("Ixy")?, entry("Ixz")?, entry("Iyz")?];
    let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    match node.get("@ref").map(|reference| (reference.text(), reference)) {
        None | Some(("com", _)) => Ok(inertia),
        Some(("joint", _)) => {
            Ok(inertia - mass * (Matrix3::identity() * c.norm_squared() - c * c.transpose()))
        }
        Some((_, reference)) => Err(reference.error("com or joint")),
    }
}

/// The set of that name, or the default one.
fn cable_set<'a>(root: &'a Node, options: &ImportOptions) -> Result<&'a Node, ExchangeError> {
    let default = root.get("@default_cable_set").map(Node::text);
    let is_named = |set: &&Node, name: &str| set.get("@id").is_some_and(|id| id.text() == name);
    let wanted = options.cable_set.as_deref().or(default);
    let found = match wanted {
        Some(name) => root.all("cable_set").find(|set| is_named(set, name)),
        None => root.all("cable_set").next(),
    };
    found.ok_or_else(|| {
        let names: Vec<_> = root.all("cable_set").filter_map(|set| Some(set.get("@id")?.text())).collect();
        let value = wanted.map_or_else(|| "missing".to_owned(), |name| format!("{name:?}"));
        root.error_at(format!("{}/cable_set", root.path), value, format!("one of {}", names.join(", ")))
    })
}

fn read_cable(cable: &Node, center_of_mass: &Vector3<f64>) -> Result<DraftCable, ExchangeError> {
    let properties = cable.get("properties");
    let stiffness = match cable.name.as_str() {
        "cable_ideal" => None,
        "cable_linear_spring" => Some(cable.need("properties")?.need("K")?.number()?),
        other => {
            let expected = "cable_ideal or cable_linear_spring: other cables are not imported";
            return Err(cable.error_at(cable.path.clone(), other.to_owned(), expected.to_owned()));
        }
    };
    let limit = |name: &str| properties.map_or(Ok(None), |properties| properties.number_in(name));
    let (min, max) = (limit("force_min")?, limit("force_max")?);
    let shift = match cable.get("@attachment_reference").map(|reference| (reference.text(), reference)) {
        None | Some(("joint", _)) => Vector3::zeros(),
        Some(("com", _)) => *center_of_mass,
        Some((_, reference)) => return Err(reference.error("joint or com")),
    };
    let attachments = cable.need("attachments")?;
    let (mut exit, mut anchor) = (None, None);
    for attachment in attachments.elements() {
        match attachment.name.as_str() {
            "attachment" => {
                let link = attachment.need("link")?;
                let location = attachment.need("location")?.vector()?;
                match link.text() {
                    "0" if exit.is_none() => exit = Some((location, None)),
                    "1" if anchor.is_none() => anchor = Some(location + shift),
                    "0" | "1" => {
                        return Err(link.error("one attachment to the frame and one to the platform"));
                    }
                    _ => return Err(link.error("0, the frame, or 1, the platform")),
                }
            }
            "base_rotating_pulley" if exit.is_none() => {
                let pulley = Pulley {
                    radius: attachment.need("pulley_radius")?.number()?,
                    axis: attachment.need("cable_entry_vector")?.vector()?,
                };
                exit = Some((attachment.need("fixed_location")?.vector()?, Some(pulley)));
            }
            other => {
                let expected = "attachment or base_rotating_pulley: others are not imported";
                return Err(attachment.error_at(
                    attachment.path.clone(),
                    other.to_owned(),
                    expected.to_owned(),
                ));
            }
        }
    }
    let (Some((exit_point, pulley)), Some(anchor_point)) = (exit, anchor) else {
        let expected = "an attachment to link 0, the frame, and one to link 1, the platform";
        return Err(attachments.error_at(
            attachments.path.clone(),
            "incomplete".to_owned(),
            expected.to_owned(),
        ));
    };
    Ok(DraftCable { exit_point, anchor_point, pulley, min, max, properties: None, stiffness })
}

fn question(draft: &mut Draft, bodies: &Document) {
    if draft.mass == Some(1.0) {
        let text = "the mass is 1 kg, as in models whose mass is not known";
        draft.note(NoteKind::Questioned, bodies, &bodies.root, text);
    }
    let Some(inertia) = draft.inertia else { return };
    let of_ball = inertia == Matrix3::identity() * inertia[(0, 0)];
    if of_ball && [1.0, 10.0, 14.0, 1e4].contains(&inertia[(0, 0)]) {
        let text = format!(
            "the inertia is {} kg m² about every axis, as in models where it is not known",
            inertia[(0, 0)]
        );
        draft.note(NoteKind::Questioned, bodies, &bodies.root, text);
    }
}
