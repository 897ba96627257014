//! The YAML of oKermorgant's cdpr for ROS and Gazebo. <https://github.com/oKermorgant/cdpr>
//!
//! Its `cable` describes the rods of the simulator and no cable.

use crate::document::Document;
use crate::draft::{Draft, DraftCable};
use crate::error::ExchangeError;
use cdpr_robot::{Matrix3, Vector3};

/// Reads a robot.
///
/// # Errors
/// [`ExchangeError::Value`] with file, line and element.
pub(crate) fn read(document: &Document) -> Result<Draft, ExchangeError> {
    let root = &document.root;
    let stem = document.file.rsplit(['/', '\\']).next().unwrap_or("robot");
    let mut draft = Draft {
        name: stem.split('.').next().unwrap_or(stem).to_owned(),
        source: format!("Imported from {} of oKermorgant's cdpr.", document.file),
        center_of_mass: Some(Vector3::zeros()),
        ..Draft::default()
    };
    draft.assume("the platform's origin is its centre of mass, as in the simulator");
    let platform = root.need("platform")?;
    draft.mass = platform.number_in("mass")?;
    if let Some(inertia) = platform.get("inertia") {
        let [xx, yy, zz, xy, xz, yz] = inertia.components()?;
        draft.inertia = Some(Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz));
    }
    let limits = root.get("joints").and_then(|joints| joints.get("actuated"));
    let limit = |name: &str| limits.map_or(Ok(None), |limits| limits.number_in(name));
    let (min, max) = (limit("min")?, limit("effort")?);
    for point in root.need("points")?.elements() {
        draft.cables.push(DraftCable {
            exit_point: point.need("frame")?.vector()?,
            anchor_point: point.need("platform")?.vector()?,
            pulley: None,
            min,
            max,
            properties: None,
            stiffness: None,
        });
    }
    draft.list_unread(document);
    Ok(draft)
}
