//! SDF of Gazebo as oKermorgant's `gen_cdpr.py` makes it of a YAML file.
//!
//! SDF has no cables. Those of this script are rods: link `virt_X0` stands at the exit point, `virt_Xpf0` at
//! the anchor point, and joint `cable0` slides the rod with an effort, its greatest tension.

use crate::document::{Document, Node};
use crate::draft::{Draft, DraftCable, NoteKind};
use crate::error::ExchangeError;
use cdpr_robot::{Matrix3, Pose, Rotation3, Vector3};
use std::collections::HashMap;

/// Reads a robot.
///
/// # Errors
/// [`ExchangeError::Value`] with file, line and element; for a model without such rods, what to import.
pub(crate) fn read(document: &Document) -> Result<Draft, ExchangeError> {
    let root = document.root();
    let model = match root.get("world") {
        Some(world) => world.need("model")?,
        None => root.need("model")?,
    };
    let mut links: HashMap<&str, Node> = HashMap::new();
    for link in model.all("link") {
        let name = link.need("@name")?;
        if links.insert(name.text(), link).is_some() {
            return Err(name.value_error(None, &format!("{:?}, there twice", name.text()), "one of a name"));
        }
    }
    let joints: HashMap<&str, Node> =
        model.all("joint").map(|joint| (joint.text_in("@name"), joint)).collect();
    let (Some(platform), true) = (links.get("platform"), links.contains_key("virt_X0")) else {
        let expected = "the links `platform`, `virt_X0`, `virt_Xpf0`, .. of oKermorgant's gen_cdpr.py, as \
                        SDF has no element for cables: import the YAML file that the model was made of, or a \
                        table of points (CSV)";
        return Err(model.value_error(Some("link"), "none of a cable", expected));
    };
    let mut draft = Draft::of_file(&document.file, "oKermorgant's cdpr, SDF");
    if let Some(name) = model.get("@name") {
        // The script takes the path of the YAML file.
        draft.name = name.text().rsplit('/').next().unwrap_or_default().to_owned();
    }
    let base = pose_of(&model)?;
    let held = pose_of(platform)?;
    let inertial = platform.need("inertial")?;
    let center = pose_of(&inertial)?;
    draft.mass = inertial.number_in("mass")?;
    draft.center_of_mass = Some(center.position);
    if let Some(inertia) = inertial.get("inertia") {
        let of = |name: &str| Ok::<_, ExchangeError>(inertia.number_in(name)?.unwrap_or(0.0));
        let (xx, yy, zz) = (of("ixx")?, of("iyy")?, of("izz")?);
        let (xy, xz, yz) = (of("ixy")?, of("ixz")?, of("iyz")?);
        let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        draft.inertia = Some(center.rotation * inertia * center.rotation.inverse());
    }
    let mut limited = true;
    for i in 0..links.len() {
        let (exit, anchor) = (format!("virt_X{i}"), format!("virt_Xpf{i}"));
        let Some(exit) = links.get(exit.as_str()) else { break };
        let Some(anchor) = links.get(anchor.as_str()) else {
            return Err(exit.value_error(None, "without an anchor point", &format!("a link {anchor}, too")));
        };
        let (exit, anchor) = (pose_of(exit)?, pose_of(anchor)?);
        let joint = joints.get(format!("cable{i}").as_str());
        let limit = joint.and_then(|joint| joint.get("axis")).and_then(|axis| axis.get("limit"));
        let max = limit.map_or(Ok(None), |limit| limit.number_in("effort"))?;
        limited &= max.is_some();
        draft.cables.push(DraftCable {
            exit_point: base.position + base.rotation * exit.position,
            anchor_point: held.rotation.inverse() * (anchor.position - held.position),
            max,
            ..DraftCable::default()
        });
    }
    if limited {
        let text =
            "the efforts of the joints are the greatest tensions: the least one is in the YAML file alone";
        draft.note(NoteKind::Questioned, &model, text);
    }
    draft.note(NoteKind::NoPlace, &model, "points to 1e-6 m, as the script has rounded them");
    // Rods, pictures and plugins: none of it is a part of the robot.
    draft.list_unread(document, |_, name| !["include", "model", "frame"].contains(&name))?;
    Ok(draft)
}

/// Position and angles of a link in its model, or of an inertia in its link.
fn pose_of(node: &Node) -> Result<Pose, ExchangeError> {
    let Some(pose) = node.get("pose") else { return Ok(Pose::at(0.0, 0.0, 0.0)) };
    if pose.has("@relative_to") || pose.has("@rotation_format") || pose.has("@degrees") {
        return Err(pose.value_error(
            None,
            "one with attributes",
            "six numbers in the frame around, in m and rad",
        ));
    }
    let [x, y, z, roll, pitch, yaw] = pose.components()?;
    let rotation = Rotation3::from_euler_angles(roll, pitch, yaw);
    Ok(Pose { position: Vector3::new(x, y, z), rotation })
}
