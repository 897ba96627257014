//! Cables of SAP2000 beside Irvine's elastic catenary and ours (`data/reference/sap2000.json`).

use cdpr_cable::{Cable, length_for_tension};
use cdpr_evidence::accept;
use nalgebra::Vector2;
use serde_json::Value;

/// Printed digits: lengths to 1e-12 m, forces to 1e-9 N, both rounded.
const LENGTH_PRINTED: f64 = 0.5e-12;
const FORCE_PRINTED: f64 = 0.5e-9;

#[test]
fn cables_of_sap2000_are_irvines_and_that_program_comes_as_near_as_it_iterates() {
    let data: Value = serde_json::from_str(include_str!("../../../data/reference/sap2000.json")).unwrap();
    let number = |value: &Value| value.as_f64().unwrap();
    let (span, weight) = (number(&data["span"]), number(&data["weight_per_length"]));
    let stiffness = number(&data["axial_stiffness"]);
    let cable = Cable::linear(weight, stiffness);
    let rows = data["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 20);
    let mut worst = [0.0_f64; 5];
    for row in rows {
        let (exact, sap) = (&row["exact"], &row["sap"]);
        let end = Vector2::new(span, number(&row["drop"]));
        // The tension at J has all printed digits; that at I is rounded.
        let found = length_for_tension(&cable, end, number(&exact["tension_j"])).unwrap().catenary;
        let (length, horizontal) = (found.unstrained_length, found.force.x);
        assert!((found.exit_tension() - number(&row["tension_i"])).abs() < 0.5e-4 + 1e-9);

        // Irvine, with the vertical forces at both ends.
        let (upper, lower) = (found.force.y, found.force.y - weight * length);
        let slope = |force: f64| (force / horizontal).asinh();
        let x = horizontal * length / stiffness + horizontal / weight * (slope(upper) - slope(lower));
        let tension = |force: f64| force.hypot(horizontal);
        let z = (upper * upper - lower * lower) / (2.0 * stiffness * weight)
            + (tension(upper) - tension(lower)) / weight;
        let closure = (x - end.x).abs().max((z - end.y).abs()) / end.norm();

        let off = |value: f64, of: &Value, name: &str| (value - number(&of[name])).abs();
        let errors = [
            closure,
            off(length, exact, "unstrained_length"),
            off(horizontal, exact, "horizontal"),
            off(length, sap, "unstrained_length"),
            off(horizontal, sap, "horizontal"),
        ];
        worst.iter_mut().zip(errors).for_each(|(worst, error)| *worst = worst.max(error));
    }
    let [closure, length, horizontal, sap_length, sap_horizontal] = worst;
    accept("V-CABLE-006", closure);
    accept("V-CABLE-007", sap_length);
    // H follows from the tension at J, which is printed with the same digits.
    assert!(length < LENGTH_PRINTED + 1e-12, "{length:e}");
    assert!(horizontal < 3.0 * FORCE_PRINTED, "{horizontal:e}");
    assert!(sap_length <= 2.2e-9 && sap_horizontal <= 8.21e-4, "{sap_length:e} {sap_horizontal:e}");
}
