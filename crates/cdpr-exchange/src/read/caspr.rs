//! CASPR: bodies and cables, two XML files. <https://github.com/darwinlau/CASPR>
//!
//! `attachment_reference="com"` shifts anchor points by the centre of mass. `K` of a linear spring is EA [N].
//! A pulley enters at `fixed_location` along `cable_entry_vector`, as in a robot file. The joint moves from
//! the `location` of its parent: it is the origin of the base frame, so that P has the joint's coordinates.

use crate::document::{Document, Node};
use crate::draft::{Draft, DraftCable, ImportOptions, NoteKind};
use crate::error::ExchangeError;
use cdpr_robot::{Matrix3, Plane, Pulley, Vector3};

/// Reads the bodies and the cables of a robot with one body.
///
/// # Errors
/// [`ExchangeError::Value`] with file, line and element; [`ExchangeError::CableSet`] where there are several.
pub(crate) fn read(
    bodies: &Document,
    cables: &Document,
    options: &ImportOptions,
) -> Result<Draft, ExchangeError> {
    let mut draft = Draft::default();
    let origin = read_body(&mut draft, bodies)?;
    let root = cables.root();
    let set = cable_set(&root, options)?;
    let set_name = set.need("@id")?.text();
    let others: Vec<Node> = root.all("cable_set").filter(|other| *other != set).collect();
    others.iter().for_each(Node::leave_out);
    let others: Vec<String> = others.iter().map(|other| other.text_in("@id").to_owned()).collect();
    if !others.is_empty() {
        draft.note(NoteKind::NoPlace, &root, format!("further cable sets: {}", others.join(", ")));
        draft.cable_sets = Some((set_name.to_owned(), others));
    }
    let center_of_mass = draft.center_of_mass.unwrap_or_default();
    for cable in set.elements() {
        let cable = read_cable(&cable, &center_of_mass);
        let mut cable = cable.map_err(|source| draft.of_cable_set(source))?;
        cable.exit_point -= origin;
        draft.cables.push(cable);
    }
    draft.source =
        format!("Imported from {} and {} of CASPR, cable set {set_name}.", bodies.file, cables.file);
    question(&mut draft, bodies);
    draft.list_unread(bodies, is_harmless)?;
    draft.list_unread(cables, is_harmless)?;
    Ok(draft)
}

/// Ranges, starts, pictures and names.
fn is_harmless(_: &str, name: &str) -> bool {
    ["@display_range", "@view_angle", "end_location", "diameter", "@num", "@name"].contains(&name)
        || name.starts_with("@q_")
        || name.starts_with("@tau_")
}

/// Reads the body and returns the origin of its joint in the frame of the file.
fn read_body(draft: &mut Draft, bodies: &Document) -> Result<Vector3<f64>, ExchangeError> {
    let root = bodies.root();
    let links: Vec<_> = root.need("links")?.elements().collect();
    let [link] = links[..] else {
        let expected = "one link: robots with several bodies are not imported";
        return Err(match links.get(1) {
            Some(second) => second.value_error(None, "a further one", expected),
            None => root.value_error(Some("links/link_rigid"), "missing", expected),
        });
    };
    if link.name() != "link_rigid" {
        return Err(link.value_error(None, link.name(), "link_rigid"));
    }
    draft.name = match link.text_in("@name") {
        "" => "robot".to_owned(),
        name => name.to_owned(),
    };
    let joint = link.need("joint")?.need("@type")?;
    (draft.plane, draft.held_rotation) = match joint.text() {
        "PLANAR_XY" => (Some(Plane::Xy), false),
        "PLANAR_XZ" => (Some(Plane::Xz), false),
        "PLANAR_YZ" => (Some(Plane::Yz), false),
        "P_XY" => (Some(Plane::Xy), true),
        "P_XZ" => (Some(Plane::Xz), true),
        "P_YZ" => (Some(Plane::Yz), true),
        "T_XYZ" | "P_XYZ" => (None, true),
        spatial if spatial.starts_with("SPATIAL_") => (None, false),
        _ => {
            let expected =
                "SPATIAL_*, T_XYZ, or PLANAR_ or P_ with XY, XZ or YZ: other joints are not imported";
            return Err(joint.error(expected));
        }
    };
    let mut origin = Vector3::zeros();
    if let Some(parent) = link.get("parent") {
        if let Some(number) = parent.get("num")
            && number.number()? != 0.0
        {
            return Err(number.error("0, the frame: robots with several bodies are not imported"));
        }
        if let Some(location) = parent.get("location") {
            origin = location.vector()?;
        }
    }
    if origin != Vector3::zeros() {
        let [x, y, z]: [f64; 3] = origin.into();
        draft.assume(format!(
            "the origin of the base frame is the joint's, ({x}, {y}, {z}) m in the frame of the file: the \
             coordinates of P are the joint's"
        ));
    }
    let physical = link.need("physical")?;
    let mass = physical.need("mass")?.number()?;
    let center_of_mass = physical.need("com_location")?.vector()?;
    draft.mass = Some(mass);
    draft.center_of_mass = Some(center_of_mass);
    if let Some(inertia) = physical.get("inertia") {
        draft.inertia = Some(read_inertia(&inertia, mass, &center_of_mass)?);
    }
    Ok(origin)
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
fn cable_set<'a>(root: &Node<'a>, options: &ImportOptions) -> Result<Node<'a>, ExchangeError> {
    let default = root.get("@default_cable_set").map(|name| name.text());
    let wanted = options.cable_set.as_deref().or(default);
    let is_wanted = |set: &Node| wanted.is_none_or(|name| set.get("@id").is_some_and(|id| id.text() == name));
    let mut found = root.all("cable_set").filter(is_wanted);
    match (found.next(), found.next()) {
        (Some(set), None) => Ok(set),
        (Some(set), Some(_)) if wanted.is_none() => Ok(set),
        (Some(_), Some(second)) => {
            Err(second.need("@id")?.value_error(None, "there twice", "one set of a name"))
        }
        (None, _) => {
            let names: Vec<_> = root.all("cable_set").map(|set| set.text_in("@id")).collect();
            let value = wanted.map_or_else(|| "missing".to_owned(), |name| format!("{name:?}"));
            Err(root.value_error(Some("cable_set"), &value, &format!("one of {}", names.join(", "))))
        }
    }
}

fn read_cable(cable: &Node, center_of_mass: &Vector3<f64>) -> Result<DraftCable, ExchangeError> {
    let properties = cable.get("properties");
    let stiffness = match cable.name() {
        "cable_ideal" => None,
        "cable_linear_spring" => Some(cable.need("properties")?.need("K")?.number()?),
        other => {
            let expected = "cable_ideal or cable_linear_spring: other cables are not imported";
            return Err(cable.value_error(None, other, expected));
        }
    };
    let limit = |name: &str| properties.map_or(Ok(None), |properties: Node| properties.number_in(name));
    let (min, max) = (limit("force_min")?, limit("force_max")?);
    let shift = match cable.get("@attachment_reference").map(|reference| (reference.text(), reference)) {
        None | Some(("joint", _)) => Vector3::zeros(),
        Some(("com", _)) => *center_of_mass,
        Some((_, reference)) => return Err(reference.error("joint or com")),
    };
    let attachments = cable.need("attachments")?;
    let (mut exit, mut anchor) = (None, None);
    for attachment in attachments.elements() {
        match attachment.name() {
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
                return Err(attachment.value_error(None, other, expected));
            }
        }
    }
    let (Some((exit_point, pulley)), Some(anchor_point)) = (exit, anchor) else {
        let expected = "an attachment to link 0, the frame, and one to link 1, the platform";
        return Err(attachments.value_error(None, "incomplete", expected));
    };
    Ok(DraftCable { exit_point, anchor_point, pulley, min, max, stiffness, ..DraftCable::default() })
}

fn question(draft: &mut Draft, bodies: &Document) {
    if draft.mass == Some(1.0) {
        let text = "the mass is 1 kg, as in models whose mass is not known";
        draft.note(NoteKind::Questioned, &bodies.root(), text);
    }
    let Some(inertia) = draft.inertia else { return };
    let of_ball = inertia == Matrix3::identity() * inertia[(0, 0)];
    if of_ball && [1.0, 10.0, 14.0, 1e4].contains(&inertia[(0, 0)]) {
        let text = format!(
            "the inertia is {} kg m² about every axis, as in models where it is not known",
            inertia[(0, 0)]
        );
        draft.note(NoteKind::Questioned, &bodies.root(), text);
    }
}
