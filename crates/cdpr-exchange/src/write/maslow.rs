//! Maslow's kinematics in FluidNC: the corners of a frame, in the YAML of its configuration.
//!
//! Source: MaslowCNC/Maslow_4, `FluidNC/src/Kinematics/MaslowKinematics.cpp` at commit b83d0adcd540. The
//! length of a belt is `sqrt((d - beltEndExtension - armLength)² + (z + tlZ)²)` with the distance d in the
//! plane of the work. `blX`, `blY` and `brY` are zero, the sides have 500 to 5000 mm, and X and Y begin where
//! the diagonals cross. The stretch of the belts is that of pull request #1060, `beltAxialStiffness` and
//! `sledWeight` [N], open in 2026: both are written as comments, because the firmware of today does not know
//! them.

use crate::error::ExchangeError;
use crate::write::anchors::{Anchors, fixed, millimetres};
use crate::write::scene::Exported;
use cdpr_robot::{Plane, Pose, Robot, Vector2, Vector3};
use std::fmt::Write;

/// Lengths of the sides of a frame that the firmware accepts [m].
const SIDES: std::ops::RangeInclusive<f64> = 0.5..=5.0;

/// A lower side that rises by a smaller share of its length is along the axis of the robot file.
const LEVEL: f64 = 1e-9;

/// The corners in the order of the firmware: top left, top right, bottom left, bottom right.
const NAMES: [&str; 4] = ["tl", "tr", "bl", "br"];

pub(crate) fn write(robot: &Robot, pose: &Pose) -> Result<Exported, ExchangeError> {
    let no_place = |field: &str, value: &str| {
        let expected = "a planar robot with four cables, from the corners of a frame with sides of 500 to \
                        5000 mm";
        Err(ExchangeError::no_place(field, value, expected))
    };
    let Some(plane) = robot.plane else {
        return no_place("plane", "not given");
    };
    if robot.cables.len() != NAMES.len() {
        return no_place("cables", &format!("a list of {}", robot.cables.len()));
    }
    let Anchors { points, mut notes } = Anchors::new(robot, pose)?;
    let axes = axes(plane);
    let in_plane = |point: &Vector3<f64>| Vector2::new(axes[0].dot(point), axes[1].dot(point));
    let order = corners(&points.iter().map(in_plane).collect::<Vec<_>>());
    let placed: Vec<Vector2<f64>> = order.iter().map(|i| in_plane(&points[*i])).collect();
    let (origin, along) = (placed[2], placed[3] - placed[2]);
    let along = along / along.norm();
    let frame = |point: &Vector2<f64>| {
        let from = point - origin;
        Vector2::new(from.dot(&along), along.perp(&from))
    };
    let corners: Vec<Vector2<f64>> = placed.iter().map(frame).collect();
    let Some(center) = center(&corners) else {
        return no_place("cables", "not at the corners of such a frame");
    };
    let mut text = "kinematics:\n  MaslowKinematics:\n".to_owned();
    for (name, (corner, i)) in NAMES.into_iter().zip(corners.iter().zip(order)) {
        let height = axes[2].dot(&(pose.position - points[i]));
        for (axis, value) in ['X', 'Y', 'Z'].into_iter().zip([corner.x, corner.y, height]) {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "    {name}{axis}: {}", millimetres(value));
        }
    }
    text += "    beltEndExtension: 0\n    armLength: 0\n";
    let stiffness = robot.cables[0].properties.axial_stiffness();
    let _ = writeln!(
        text,
        "    # With pull request 1060 of Maslow_4:\n    # beltAxialStiffness: {}\n    # sledWeight: {}",
        fixed(stiffness),
        fixed(robot.platform.mass * robot.gravity.magnitude()),
    );
    if robot.cables.iter().any(|cable| cable.properties.axial_stiffness() != stiffness) {
        notes.push("beltAxialStiffness is EA of the first cable: that of the others has no place".to_owned());
    }
    let start = origin + along * center.x + Vector2::new(-along.y, along.x) * center.y;
    let normal = axes[2].dot(&pose.position);
    let place = |[x, y, z]: [f64; 3]| format!("({}, {}, {})", fixed(x), fixed(y), fixed(z));
    let zero = place((axes[0] * start.x + axes[1] * start.y + axes[2] * normal).into());
    let turned = if along.y.abs() > LEVEL {
        let x_axis = place((axes[0] * along.x + axes[1] * along.y).into());
        format!("; its X axis points along {x_axis}, from the bottom left to the bottom right corner")
    } else {
        String::new()
    };
    notes.push(format!("X = Y = Z = 0 of the firmware is {zero} m, where the diagonals cross{turned}"));
    notes.push(
        "the robot file has no arms between belts and sled: armLength and beltEndExtension are 0".to_owned(),
    );
    Ok(Exported { files: vec![(".yaml", text)], notes })
}

/// Right, up and out of the work in the base frame. A vertical frame in the planes of z is upright.
fn axes(plane: Plane) -> [Vector3<f64>; 3] {
    match plane {
        Plane::Xy => [Vector3::x(), Vector3::y(), Vector3::z()],
        Plane::Xz => [Vector3::x(), Vector3::z(), -Vector3::y()],
        Plane::Yz => [Vector3::y(), Vector3::z(), Vector3::x()],
    }
}

/// Indices of the corners: top left, top right, bottom left, bottom right.
fn corners(points: &[Vector2<f64>]) -> Vec<usize> {
    let mut by_height: Vec<usize> = (0..points.len()).collect();
    by_height.sort_by(|one, other| points[*other].y.total_cmp(&points[*one].y));
    for pair in by_height.chunks_mut(2) {
        pair.sort_by(|one, other| points[*one].x.total_cmp(&points[*other].x));
    }
    by_height
}

/// Where the diagonals cross, if the corners are those of a frame that the firmware accepts.
fn center(corners: &[Vector2<f64>]) -> Option<Vector2<f64>> {
    let &[tl, tr, bl, br] = corners else { return None };
    let sides = [tr - tl, br - tr, br - bl, tl - bl];
    let is_frame = tl.x < tr.x && bl.x < br.x && tl.y > 0.0 && tr.y > 0.0;
    if !is_frame || sides.iter().any(|side| !SIDES.contains(&side.norm())) {
        return None;
    }
    // bl + s (tr - bl) = br + t (tl - br)
    let (one, other) = (tr - bl, tl - br);
    let s = (br - bl).perp(&other) / one.perp(&other);
    s.is_finite().then(|| bl + one * s)
}
