//! The JSON of IRMA, with commas that trail. <https://github.com/IRMA-LAB/cdpr_matlab>
//!
//! A pulley enters at `pos_OD_glob` along `vers_k`; actuators that are not `active` are left out.

use crate::document::{Document, Node};
use crate::draft::{Draft, DraftCable, NoteKind};
use crate::error::ExchangeError;
use cdpr_robot::{Matrix3, Pulley};

/// Acceleration due to gravity along the axis of the file, which has a direction alone [m/s²].
const EARTH: f64 = 9.81;

/// Reads a robot.
///
/// # Errors
/// [`ExchangeError::Value`] with file, line and element.
pub(crate) fn read(document: &Document) -> Result<Draft, ExchangeError> {
    let root = &document.root;
    let stem = document.file.rsplit(['/', '\\']).next().unwrap_or("robot");
    let mut draft = Draft {
        name: stem.split('.').next().unwrap_or(stem).to_owned(),
        source: format!("Imported from {} of IRMA.", document.file),
        ..Draft::default()
    };
    for actuator in root.need("actuator")?.elements() {
        if actuator.get("active").is_some_and(|active| active.text() == "false") {
            draft.note(
                NoteKind::NoPlace,
                document,
                actuator,
                format!("{}, which is not active", actuator.path),
            );
            actuator.leave_out();
            continue;
        }
        let (pulley, winch) = (actuator.need("pulley")?, actuator.need("winch")?);
        let radius = pulley.number_in("radius")?.unwrap_or(0.0);
        let axis = pulley.get("vers_k");
        draft.cables.push(DraftCable {
            exit_point: pulley.need("pos_OD_glob")?.vector()?,
            anchor_point: winch.need("pos_PA_loc")?.vector()?,
            pulley: match axis {
                Some(axis) if radius > 0.0 => Some(Pulley { radius, axis: axis.vector()? }),
                None if radius > 0.0 => return Err(pulley.error("an entry vers_k, the swivel axis")),
                _ => None,
            },
            min: None,
            max: None,
            properties: None,
            stiffness: None,
        });
    }
    let platform = root.need("platform")?;
    draft.mass = platform.number_in("mass")?;
    if draft.mass == Some(1.0) {
        let text = "the mass is 1 kg: inertias are those per kilogram";
        draft.note(NoteKind::Questioned, document, platform, text);
    }
    draft.center_of_mass = platform.get("pos_PG_loc").map(Node::vector).transpose()?;
    if let Some(inertia) = platform.get("inertia_mat_G_loc") {
        draft.inertia = Some(Matrix3::from_row_slice(&inertia.components::<9>()?));
    }
    if let Some(axis) = platform.get("gravity_axis") {
        let up = axis.vector()?;
        if up.norm() < 1e-9 {
            return Err(axis.error("a direction, up"));
        }
        draft.gravity = Some(-EARTH * up.normalize());
        draft.assume(format!("gravity is {EARTH} m/s² against the gravity_axis of the file"));
    }
    draft.list_unread(document);
    Ok(draft)
}
