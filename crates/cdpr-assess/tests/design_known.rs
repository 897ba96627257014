//! Designs whose optimum has a closed form, as cases of the evidence.

use crate::design::{HEIGHT, apart, planar, solve, with};
use cdpr_evidence::accept;
use cdpr_robot::Robot;
use serde_json::json;

/// With the cables at the angle θ to the horizontal, `T = W/(2 sin θ)`, `L = H/sin θ` and `EA (1 + T/EA)/L`
/// along a cable, the stiffness along x is `2/L (EA (1 + T/EA) cos²θ + T sin²θ)`, that is
/// `(2 EA sin θ cos²θ + W)/H`. It is greatest at tan²θ = 1/2, `h = √2 H`, whatever W is.
#[test]
fn a_mass_on_two_cables_is_stiffest_sideways_at_the_square_root_of_two_from_every_seed() {
    let mut worst = 0.0_f64;
    for seed in 0..100_u64 {
        let file = with(apart([-6.0, -0.5], 100.0), "/seed", json!(seed));
        let found = solve(&file, planar(1.0, 1e6));
        let best = found.best.unwrap();
        assert_eq!((found.feasible, best.same), (5, 5), "seed {seed}: {best:?}");
        let to = best.variables[0].to;
        worst = worst.max((to / (-(2.0_f64.sqrt()) * HEIGHT) - 1.0).abs());
        assert!(best.optimal && best.kkt_residual.unwrap() <= 1e-8, "seed {seed}: {best:?}");
        let (stiffness, ea) = ((2.0 * 1e6 * (1.0 / 3.0_f64).sqrt() * 2.0 / 3.0 + 981.0) / HEIGHT, 1e3);
        assert!((best.objective * stiffness / (100.0 * ea) - 1.0).abs() < 1e-6, "{}", best.objective);
        assert_eq!(best.robot.cables[1].exit_point.x, -to);
    }
    accept("V-DESIGN-001", worst);
}

/// A point mass in the middle of four cables from the corners `(±w, ±h)` of a rectangle, without gravity:
/// with the force T in each and `k = EA (1 + T/EA)/L`, the stiffness is `4 (k w² + T h²/L)/L²` along x and
/// `4 (k h² + T w²/L)/L²` along z. For a given h the first one grows with w up to `√2 h` and the second
/// falls. The lower of both is therefore greatest where they are equal: in the square, where the wrench
/// matrix is isotropic, its condition number 1.
#[test]
fn a_mass_between_four_cables_is_stiffest_in_the_square_whose_dexterity_is_one() {
    let (h, corners) = (1.5, [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]]);
    let text = json!({
        "format": "cdpr-robot/1", "name": "Rectangle", "gravity": 0.0, "plane": "xz",
        "platform": {"mass": 10.0, "center_of_mass": [0, 0, 0], "point": true},
        "cable": {"section": 1e-5, "youngs_modulus": 1e11, "linear_density": 0.0},
        "tension_limits": {"min": 1.0, "max": 1e5}, "tension_reference": 500.0,
        "cables": corners.map(|[x, z]| json!({"exit_point": [x, 0, h * z], "anchor_point": [0, 0, 0]})),
    });
    let file = json!({
        "format": "cdpr-design/1",
        "variables": [{"parameters": ["b1.x", "b2.x", "b3.x", "b4.x"], "signs": [1, -1, 1, -1],
            "bounds": [-2.8, -0.4]}],
        "poses": {"list": [{"position": [0, 0, 0]}]},
        "objective": {"output": "stiffness", "over": "worst"}, "starts": 8,
    });
    let found = solve(&file, Robot::from_json(&text.to_string()).unwrap());
    let best = found.best.unwrap();
    // The two stiffnesses are equal there, so that the lower one has no derivative, which the residual says.
    assert!(best.same == 8 && !best.optimal, "{best:?}");
    let [sx, sz] = best.robot.cables.iter().fold([0.0, 0.0], |[sx, sz], cable| {
        let u = cable.exit_point.normalize();
        [sx + u.x * u.x, sz + u.z * u.z]
    });
    accept("V-DESIGN-002", (sx.max(sz) / sx.min(sz)).sqrt() - 1.0);
}
