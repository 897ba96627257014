//! The catenary against values computed in 40-digit arithmetic (`data/reference/README.md`).

use cdpr_cable::{Cable, Catenary, Matrix2, Vector2, end_force, length_for_tension};
use cdpr_evidence::accept;

/// The error that rounding of the inputs alone causes, times a small count of operations.
///
/// The end position is known to `epsilon (|r| + L)`, and the force to that times the stiffness.
fn conditioned_bound(catenary: &Catenary, end: Vector2<f64>) -> f64 {
    let stiffness: Matrix2<f64> = catenary.in_plane_stiffness();
    4.0 * f64::EPSILON * stiffness.norm() * (end.norm() + catenary.unstrained_length)
}

struct Case {
    kind: String,
    cable: Cable<'static>,
    length: f64,
    end: Vector2<f64>,
    force: Vector2<f64>,
}

fn reference_cases() -> Vec<Case> {
    let text = include_str!("../../../data/reference/catenary.json");
    let cases: Vec<serde_json::Value> = serde_json::from_str(text).unwrap();
    let number = |case: &serde_json::Value, key: &str| match &case[key] {
        serde_json::Value::String(digits) => digits.parse().unwrap(),
        value => value.as_f64().unwrap(),
    };
    cases
        .iter()
        .map(|case| Case {
            kind: case["kind"].as_str().unwrap().to_owned(),
            cable: Cable::linear(number(case, "weight_per_length"), number(case, "axial_stiffness")),
            length: number(case, "unstrained_length"),
            end: Vector2::new(number(case, "x"), number(case, "z")),
            force: Vector2::new(number(case, "force_x"), number(case, "force_z")),
        })
        .collect()
}

#[test]
fn end_forces_match_40_digit_arithmetic() {
    let cases = reference_cases();
    assert_eq!(cases.len(), 64);
    for case in &cases {
        let solution = end_force(&case.cable, case.length, case.end).unwrap();
        let error = (solution.catenary.force - case.force).norm();
        let relative = error / case.force.norm();
        let bound = conditioned_bound(&solution.catenary, case.end);
        assert!(
            relative <= 1e-10 || error <= bound,
            "{}: {relative:e} relative, {error:e} N, conditioned {bound:e} N",
            case.kind
        );
        // The small component too, where it is what the case is about.
        let slope = solution.catenary.in_plane_stiffness();
        let small = (solution.catenary.force.x - case.force.x).abs();
        let small_bound = 4.0 * f64::EPSILON * slope.row(0).norm() * (case.end.norm() + case.length);
        assert!(small <= 1e-10 * case.force.x || small <= small_bound, "{}: fx {small:e}", case.kind);
        accept("V-CABLE-001", relative);
    }
}

#[test]
fn end_positions_match_40_digit_arithmetic() {
    for case in reference_cases() {
        let catenary = Catenary { cable: case.cable, unstrained_length: case.length, force: case.force };
        let error = (catenary.end_position() - case.end).norm() / case.end.norm();
        accept("V-CABLE-002", error / (1.0 + case.length / case.end.norm()));
    }
}

#[test]
fn the_length_for_a_tension_is_the_inverse_of_the_end_force() {
    let mut on_shorter_branch = 0;
    for case in reference_cases() {
        let solution = length_for_tension(&case.cable, case.end, case.force.norm()).unwrap();
        let length = solution.catenary.unstrained_length;
        if (length - case.length).abs() < 1e-6 * case.length {
            on_shorter_branch += 1;
            accept("V-CABLE-003", (length / case.length - 1.0).abs());
        } else {
            // The same tension occurs with less cable: then the answer is that shorter one.
            assert!(length < case.length, "{}: {length} against {}", case.kind, case.length);
        }
        assert!((solution.catenary.anchor_tension() / case.force.norm() - 1.0).abs() < 1e-9, "{}", case.kind);
        assert!(
            (solution.catenary.end_position() - case.end).norm() < 1e-13 * (case.length + case.end.norm())
        );
    }
    assert!(on_shorter_branch >= 40, "{on_shorter_branch}");
}

/// Values that other programs publish, recomputed in 40-digit arithmetic.
///
/// The columns are x, z, L, EA, w, H and the tension at the top.
#[test]
fn published_cases_of_other_programs() {
    let moorpy = [
        (400.0, 200.0, 500.0, 7.51e12, 200.0, 43694.6046220687, 77634.410545808),
        (89.9, 59.2, 130.0, 7.51e8, 881.05, 31373.2348763057, 87886.1612999649),
        (
            246.22420940032947,
            263.55766330843164,
            360.63566262396927,
            7e8,
            3.08735,
            58377.24142265,
            63044.4129559172,
        ),
        (8.0, 4.0, 8.95, 820510.0, 0.62784, 34.9618378936994, 20.3205540878714),
    ];
    for (x, z, length, ea, w, horizontal, top) in moorpy {
        let cable = Cable::linear(w, ea);
        let catenary = end_force(&cable, length, Vector2::new(x, z)).unwrap().catenary;
        let bound = conditioned_bound(&catenary, Vector2::new(x, z));
        let error = catenary.force - Vector2::new(horizontal, top);
        let tension = horizontal.hypot(top);
        accept("V-CABLE-004", error.norm() / tension);
        assert!(error.norm() < (1e-10 * tension).max(bound), "{x} {z}: {error} of {tension}");
    }
}

#[test]
fn a_vertical_cable_taut_and_folded() {
    let cable = Cable::linear(0.62784, 820_510.0);
    // B low, A 4 m above: force at the top is the force at A, force at the bottom V0.
    let up = Vector2::new(0.0, 4.0);
    let taut = end_force(&cable, 3.99, up).unwrap().catenary;
    assert!((taut.force.y / 2057.66858090025 - 1.0).abs() < 1e-10, "{}", taut.force.y);
    assert!((taut.exit_vertical_force() / 2055.16349930025 - 1.0).abs() < 1e-10);
    let folded = end_force(&cable, 5.0, up).unwrap().catenary;
    assert!((folded.force.y / 2.82527759794328 - 1.0).abs() < 1e-10, "{}", folded.force.y);
    assert!((folded.exit_vertical_force() / -0.313922402056718 - 1.0).abs() < 1e-10);
    assert_eq!(folded.force.x, 0.0);
}
