//! `cdpr safety` as a user types it: short motions, and what is not known.

use crate::common::{cdpr, text, unwrapped};
use crate::models::answer;
use serde_json::json;
use tempfile::TempDir;

/// A point mass of 10 kg on light cables from these exit points [m].
pub(crate) fn point_mass(folder: &TempDir, exits: &[[f64; 3]], plane: bool) -> String {
    let cables: Vec<_> =
        exits.iter().map(|exit| json!({"exit_point": exit, "anchor_point": [0, 0, 0]})).collect();
    let mut robot = json!({
        "format": "cdpr-robot/1", "name": "Point mass", "gravity": 9.81,
        "platform": {"mass": 10, "center_of_mass": [0, 0, 0], "point": true},
        "cable": {"diameter": 0.004, "section": 1e-5, "youngs_modulus": 1e9, "linear_density": 0.01},
        "tension_limits": {"min": 1, "max": 1000}, "cables": cables
    });
    if plane {
        robot["plane"] = json!("xz");
    }
    let path = folder.path().join("robot.json");
    std::fs::write(&path, robot.to_string()).unwrap();
    path.display().to_string()
}

const FOUR: [[f64; 3]; 4] = [[3.0, 2.0, 4.0], [-3.0, 2.0, 4.0], [-3.0, -2.0, 4.0], [3.0, -2.0, 4.0]];

#[test]
fn a_motion_shorter_than_a_hundredth_of_a_second_is_that_of_the_force_that_is_missing() {
    let folder = TempDir::new().unwrap();
    let robot = point_mass(&folder, &FOUR, false);
    let call = ["safety", &robot, "--pose", "0,0,1", "--with", "swing=0.005"];
    let (found, printed) = (answer(&call), text(cdpr(&call).stdout));
    for (i, tension) in found["tensions"].as_array().unwrap().iter().enumerate() {
        // a t²/2 with a = T/m, where T and m are the tension before and the mass.
        let expected = 0.5 * tension.as_f64().unwrap() / 10.0 * 0.005_f64.powi(2);
        let moved = found["broken"][i]["swing"]["moved"].as_f64().unwrap();
        assert!((moved / expected - 1.0).abs() < 0.02, "{moved:e} {expected:e}");
        // No number is broken over two lines of the table.
        assert!(printed.contains(&format!(" {moved:.2e} ")), "{printed}");
    }
}

#[test]
fn what_is_not_known_is_not_said_to_end_badly() {
    let folder = TempDir::new().unwrap();
    let robot = point_mass(&folder, &FOUR, false);
    let long = cdpr(&["safety", &robot, "--pose", "0,0,1", "--with", "swing=1e6"]);
    assert_eq!(long.status.code(), Some(2));
    assert!(
        unwrapped(long.stderr).contains("--with swing=1e6: expected a time above 0 s, and 1e5 s at most")
    );
    let alone = point_mass(&folder, &[[0.0, 0.0, 5.0]], true);
    let alone = cdpr(&["safety", &alone, "--pose", "0,0,2", "--free", "x"]);
    let printed = text(alone.stdout);
    assert_eq!(alone.status.code(), Some(3));
    assert!(printed.contains("does not bear every break: without cable 1 no cable is\nleft."), "{printed}");
}

#[test]
fn the_table_begins_with_the_whole_robot_and_names_the_forces_that_its_factors_are_of() {
    let folder = TempDir::new().unwrap();
    let robot = point_mass(&folder, &FOUR, false);
    let printed = text(cdpr(&["safety", &robot, "--pose", "0,0,1"]).stdout).replace('\n', " ");
    assert!(printed.contains("no breaking force is known, so that there are no factors"), "{printed}");
    let strong =
        std::fs::read_to_string(&robot).unwrap().replace("\"section\"", "\"breaking_force\":600,\"section\"");
    std::fs::write(&robot, strong).unwrap();
    let call = ["safety", &robot, "--pose", "0,0,1"];
    let (found, printed) = (answer(&call), text(cdpr(&call).stdout));
    assert!(
        printed.contains("The greatest tension allowed is 1000.0 N; the breaking force is 600.00 N."),
        "{printed}"
    );
    let exits = found["exit_tensions"].as_array().unwrap().iter().map(|tension| tension.as_f64().unwrap());
    let greatest = exits.fold(0.0, f64::max);
    assert_eq!(found["greatest_tension"]["tension"], greatest);
    assert_eq!(found["safety_factor"], 600.0 / greatest);
    let whole = printed.lines().find(|line| line.starts_with("│ none ")).unwrap();
    assert!(whole.contains(&format!(" {:.1} ", 600.0 / greatest)), "{whole}");
}
