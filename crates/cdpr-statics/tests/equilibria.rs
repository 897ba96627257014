//! Robots of the equilibria in 40-digit arithmetic (`data/reference/README.md`).

use cdpr_robot::{CableEnd, CableProperties, Platform, Robot, RobotCable, TensionLimits, Vector3};
use serde_json::Value;

/// A number, which may stand as text.
pub(crate) fn number(value: &Value) -> f64 {
    match value {
        Value::String(digits) => digits.parse().unwrap(),
        value => value.as_f64().unwrap(),
    }
}

pub(crate) fn vector(value: &Value) -> Vector3<f64> {
    Vector3::from_fn(|i, _| number(&value[i]))
}

/// The robot of a case.
pub(crate) fn robot(case: &Value) -> Robot {
    let gravity = number(&case["gravity"]);
    let density = number(&case["weight_per_length"]) / gravity;
    let properties = CableProperties::linear(1.0, density, number(&case["axial_stiffness"]));
    let cable = |(exit, anchor): (&Value, &Value)| {
        RobotCable::between(vector(exit), vector(anchor), properties.clone())
    };
    let [exits, anchors] = ["exit_points", "anchor_points"].map(|points| case[points].as_array().unwrap());
    Robot {
        name: case["kind"].as_str().unwrap().to_owned(),
        provenance: Default::default(),
        gravity: gravity.into(),
        platform: Platform::new(number(&case["mass"]), vector(&case["center_of_mass"])),
        tension_limits: TensionLimits { min: 1.0, max: 1e6 },
        max_at: CableEnd::Anchor,
        ground_z: None,
        plane: None,
        tension_reference: None,
        distribution: Default::default(),
        cables: exits.iter().zip(anchors).map(cable).collect(),
    }
}
