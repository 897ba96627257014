//! The JSON of IRMA, with commas that trail. <https://github.com/IRMA-LAB/cdpr_matlab>
//!
//! A pulley enters at `pos_OD_glob` along `vers_k`; actuators that are not `active` are left out.

use crate::document::{Document, short};
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
    let root = document.root();
    let mut draft = Draft::of_file(&document.file, "IRMA");
    if let Some(pattern) = root.get("motion_pattern")
        && !["THREE_R_THREE_T", "3R3T"].contains(&pattern.text())
    {
        let text = format!("motion_pattern {}: the platform has all six motions", short(pattern.text()));
        draft.note(NoteKind::Questioned, &pattern, text);
    }
    let mut inactive: Vec<usize> = Vec::new();
    let actuators = root.need("actuator")?;
    for (i, actuator) in actuators.elements().enumerate() {
        if actuator.get("active").is_some_and(|active| active.text() == "false") {
            inactive.push(i + 1);
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
            ..DraftCable::default()
        });
    }
    if !inactive.is_empty() {
        let mut numbers: Vec<_> = inactive.iter().take(20).map(ToString::to_string).collect();
        if inactive.len() > numbers.len() {
            numbers.push(format!("{} more", inactive.len() - numbers.len()));
        }
        let text = format!("actuators that are not active: {}", numbers.join(", "));
        draft.note(NoteKind::NoPlace, &actuators, text);
    }
    let platform = root.need("platform")?;
    draft.mass = platform.number_in("mass")?;
    if draft.mass == Some(1.0) {
        let text = "the mass is 1 kg: inertias are those per kilogram";
        draft.note(NoteKind::Questioned, &platform, text);
    }
    draft.center_of_mass = platform.get("pos_PG_loc").map(|point| point.vector()).transpose()?;
    if let Some(inertia) = platform.get("inertia_mat_G_loc") {
        draft.inertia = Some(Matrix3::from_row_slice(&inertia.components::<9>()?));
    }
    if let Some(axis) = platform.get("gravity_axis").or(platform.get("grav_ax")) {
        let up = axis.vector()?;
        if up.norm() < 1e-9 {
            return Err(axis.error("a direction, up"));
        }
        draft.gravity = Some(-EARTH * up.normalize());
        draft.assume(format!("gravity is {EARTH} m/s² against the gravity_axis of the file"));
    }
    for load in ["ext_force_loc", "ext_torque_loc"] {
        if let Some(load) = platform.get(load)
            && load.numbers()?.iter().any(|component| *component != 0.0)
        {
            let text = format!("{}: loads are arguments of the commands", load.name());
            draft.note(NoteKind::Questioned, &load, text);
        }
    }
    draft.list_unread(document, is_harmless)?;
    Ok(draft)
}

/// Winches, angles of pulleys, and how a pose is written.
fn is_harmless(within: &str, name: &str) -> bool {
    match within {
        "" => ["permutation_mask", "rotation_parametrization", "name", "version"].contains(&name),
        "platform" => ["rotation_parametrization", "name"].contains(&name),
        _ => !(name.starts_with("pos_") || name.contains("force") || name.contains("tension")),
    }
}
