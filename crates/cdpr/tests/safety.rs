//! `cdpr safety` as a user types it: short motions, and what is not known.

use crate::common::{cdpr, json_file, text, unwrapped};
use crate::models::answer;
use cdpr_robot::significant;
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

/// The answer as JSON of a robot that does not bear every break.
fn judged(arguments: &[&str]) -> serde_json::Value {
    let output = cdpr(&[arguments, &["--format", "json"]].concat());
    assert_eq!(output.status.code(), Some(3));
    serde_json::from_slice(&output.stdout).unwrap()
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
        let moved = found["broken"][i]["swing"]["moved_mm"].as_f64().unwrap() * 1e-3;
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
    assert!(printed.contains("no breaking force is known, so that there are no safety factors"), "{printed}");
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
    assert_eq!(found["greatest_tension"]["tension_n"], greatest);
    assert_eq!(found["safety_factor"], 600.0 / greatest);
    let whole = printed.lines().find(|line| line.starts_with("│ none ")).unwrap();
    assert!(whole.contains(&format!(" {:.1} ", 600.0 / greatest)), "{whole}");
}

/// The cable that breaks first is not the one that pulls most where cables are of two types.
#[test]
fn a_factor_of_another_cable_than_the_most_loaded_one_names_its_cable() {
    let folder = TempDir::new().unwrap();
    let path = strong_point(&folder, "2000");
    let mut robot = json_file(&path);
    let mut weak = robot["cable"].clone();
    weak["breaking_force"] = json!(220);
    robot["cables"][2]["cable"] = weak;
    std::fs::write(&path, robot.to_string()).unwrap();
    // Cables 1 and 4 are steepest there.
    let call = ["safety", &path, "--pose", "1.5,0,1"];
    let (found, printed) = (answer(&call), text(cdpr(&call).stdout));
    let exits = found["exit_tensions"].as_array().unwrap();
    let factor = 220.0 / exits[2].as_f64().unwrap();
    assert_ne!(found["greatest_tension"]["cable"], 3);
    assert_eq!((&found["safety_factor"], &found["safety_factor_cable"]), (&json!(factor), &json!(3)));
    let whole = printed.lines().find(|line| line.starts_with("│ none ")).unwrap();
    assert!(whole.contains(&format!(" {} (cable", significant(factor, 3))), "{printed}");
    assert_ne!(found["broken"][2]["safety_factor_cable"], json!(3));
    let table = text(cdpr(&[&call[..], &["--format", "csv"]].concat()).stdout);
    let mut rows = csv::Reader::from_reader(table.as_bytes());
    let column = rows.headers().unwrap().iter().position(|name| name == "safety_factor_cable").unwrap();
    assert_eq!(&rows.records().next().unwrap().unwrap()[column], "3");
}

/// A point mass of 10 kg on four cables of this breaking force.
fn strong_point(folder: &TempDir, force: &str) -> String {
    let robot = point_mass(folder, &FOUR, false);
    let strong = std::fs::read_to_string(&robot).unwrap();
    let strong = strong.replace("\"section\"", &format!("\"breaking_force\":{force},\"section\""));
    std::fs::write(&robot, strong).unwrap();
    robot
}

const FACTORS: &str = "permanent=1.35,variable=1.5,resistance=1.5,accidental=1.0";

#[test]
fn partial_factors_have_a_verdict_with_the_worst_case() {
    let folder = TempDir::new().unwrap();
    let robot = strong_point(&folder, "600");
    let call = ["safety", &robot, "--pose", "0,0,1", "--payload", "2", "--with", FACTORS];
    let (within, printed) = (answer(&call), cdpr(&call));
    assert_eq!(printed.status.code(), Some(0), "{}", text(printed.stderr));
    let printed = text(printed.stdout).replace('\n', " ");
    let proof = &within["proof"];
    assert_eq!((&proof["verdict"], proof["cases"].as_array().unwrap().len()), (&json!("within"), 5));
    let most = proof["utilization"].as_f64().unwrap();
    assert!(printed.starts_with("Point mass at (0, 0, 1) m is within its design resistance"), "{printed}");
    assert!(printed.contains(&format!("utilization at most {most:.3}, of cable ")), "{printed}");
    // Where accidental loads are not multiplied, the rests are those without factors.
    for (case, broken) in
        proof["cases"].as_array().unwrap()[1..].iter().zip(within["broken"].as_array().unwrap())
    {
        let factor = broken["safety_factor"].as_f64().unwrap();
        let expected = 1.5 / factor;
        assert!((case["utilization"].as_f64().unwrap() / expected - 1.0).abs() < 1e-12, "{case}");
        assert_eq!(case["moved_mm"], broken["moved_mm"]);
        assert_eq!((&case["permanent"], &case["resistance"]), (&json!(1.0), &json!(1.5)));
    }
    // The weak cables of another robot are not within theirs.
    let robot = strong_point(&folder, "60");
    let call = ["safety", &robot, "--pose", "0,0,1", "--payload", "2", "--with", FACTORS];
    let weak = cdpr(&call);
    assert_eq!(weak.status.code(), Some(3));
    let printed = text(weak.stdout).replace('\n', " ");
    assert!(printed.contains("exceeds its design resistance: utilization "), "{printed}");
    let robot = point_mass(&folder, &FOUR, false);
    let unknown = cdpr(&["safety", &robot, "--pose", "0,0,1", "--with", FACTORS]);
    assert_eq!(unknown.status.code(), Some(3));
    let printed = text(unknown.stdout).replace('\n', " ");
    let expected = "whether it is within its design resistance is not known; no cable has a breaking_force.";
    assert!(printed.contains(expected) && !printed.contains("The others are within it"), "{printed}");
    let robot = strong_point(&folder, "600");
    let mut one_unknown: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(&robot).unwrap()).unwrap();
    one_unknown["cables"][0]["cable"] = one_unknown["cable"].clone();
    one_unknown["cables"][0]["cable"].as_object_mut().unwrap().remove("breaking_force");
    std::fs::write(&robot, one_unknown.to_string()).unwrap();
    let printed = text(cdpr(&["safety", &robot, "--pose", "0,0,1", "--with", FACTORS]).stdout);
    let printed = printed.replace('\n', " ");
    assert!(printed.contains("with all cables: cable 1 has no breaking_force."), "{printed}");
    assert!(printed.contains("The others are within it: at most 0."), "{printed}");
}

#[test]
fn factors_come_together_and_are_plausible() {
    let folder = TempDir::new().unwrap();
    let robot = strong_point(&folder, "600");
    for (with, expected) in [
        ("permanent=1.35,variable=1.5", "expected resistance=FACTOR, accidental=FACTOR, too"),
        (
            "permanent=135,variable=1.5,resistance=1.5,accidental=1",
            "factors.persistent.permanent is 135: expected a factor from 0.1 to 10",
        ),
        (
            "permanent=1.35,variable=1.5,resistance=x,accidental=1",
            "--with resistance=x: expected a number or two, such as 1.5 or 1.5:1.2",
        ),
    ] {
        let refused = cdpr(&["safety", &robot, "--pose", "0,0,1", "--with", with]);
        let said = unwrapped(refused.stderr);
        assert!(refused.status.code() == Some(2) && said.contains(expected), "{said}");
    }
}

#[test]
fn the_table_of_a_pose_has_a_row_for_each_case_with_all_that_is_known() {
    let folder = TempDir::new().unwrap();
    let robot = strong_point(&folder, "600");
    let table = |more: &[&str]| -> Vec<Vec<String>> {
        let call =
            [&["safety", &robot, "--pose", "0,0,1", "--payload", "2", "--format", "csv"], more].concat();
        let printed = text(cdpr(&call).stdout);
        let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(printed.as_bytes());
        reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect()
    };
    let with = format!("{FACTORS},pairs,swing=0.01");
    let (plain, factored) = (table(&[]), table(&["--with", &with]));
    assert_eq!((plain.len(), factored.len()), (1 + 1 + 4, 1 + 1 + 4 + 6));
    let cell = |rows: &[Vec<String>], row: usize, name: &str| {
        let column = rows[0].iter().position(|own| own == name).unwrap_or_else(|| panic!("{name}"));
        rows[row][column].clone()
    };
    let number = |rows: &[Vec<String>], row: usize, name: &str| -> f64 {
        cell(rows, row, name).parse().unwrap_or_else(|_| panic!("{name}: {:?}", rows[row]))
    };
    assert_eq!(cell(&plain, 1, "case"), "intact");
    for row in 1..plain.len() {
        // Without factors the utilization is that of the safety factor, and there is no verdict.
        let product = number(&plain, row, "utilization") * number(&plain, row, "safety_factor");
        assert!((product - 1.0).abs() < 1e-12 && cell(&plain, row, "verdict").is_empty());
        assert_eq!(number(&plain, row, "breaking_force_n"), 600.0);
        assert_eq!(cell(&plain, row, "permanent"), "1.0");
        assert_eq!(cell(&factored, row, "verdict"), "within");
        assert_eq!(number(&factored, row, "design_resistance_n"), 400.0);
        let tension = number(&factored, row, "tension_n");
        assert!((number(&factored, row, "utilization") - tension / 400.0).abs() < 1e-12);
        assert_eq!(cell(&factored, row, "ending"), "held");
    }
    assert_eq!([cell(&factored, 2, "broken"), cell(&factored, 6, "broken")], ["1", "1+2"]);
    assert!(number(&factored, 2, "peak_tension_n") > 0.0 && number(&factored, 2, "swing_moved_mm") > 0.0);
    let windy = table(&["--with", &format!("{FACTORS},wind=20")]);
    let last = windy.len() - 1;
    assert_eq!(cell(&windy, last, "case"), "weather");
    assert!((0.0..360.0).contains(&number(&windy, last, "azimuth_deg")));
    assert!(number(&windy, last, "utilization") > number(&windy, 1, "utilization"));
}

/// A camera of 6 kg on three cables that break at 80 N.
fn camera(folder: &TempDir) -> String {
    let robot = point_mass(folder, &[[-6.0, -4.0, 7.0], [6.0, -4.5, 6.6], [0.5, 5.0, 7.2]], false);
    let mut file: serde_json::Value = serde_json::from_slice(&std::fs::read(&robot).unwrap()).unwrap();
    file["platform"]["mass"] = json!(6);
    file["cable"] = json!({
        "diameter": 0.0025, "section": 2.8e-6, "linear_density": 0.0045, "youngs_modulus": 4.5e10,
        "breaking_force": 80
    });
    file["tension_limits"] = json!({"min": 3, "max": 900});
    std::fs::write(&robot, file.to_string()).unwrap();
    robot
}

#[test]
fn a_row_of_a_break_names_the_cable_whose_limit_is_passed_most() {
    let folder = TempDir::new().unwrap();
    let robot = camera(&folder);
    let call = ["safety", &robot, "--pose", "1,0.5,3", "--payload", "2", "--with", "swing=1.5"];
    let (found, printed) = (judged(&call), text(cdpr(&call).stdout));
    let swing = &found["broken"][2]["swing"];
    let beyond = swing["out_of_limits"].as_array().unwrap();
    assert!(beyond.len() > 1, "{swing}");
    let most = swing["peak_tension"]["cable"].as_u64().unwrap();
    assert_ne!(beyond[0]["cable"], most, "{swing}");
    let words = printed.replace('\n', " ");
    assert!(words.contains(&format!("Without 3: cable {most} breaks, too, on the way")), "{printed}");
}

#[test]
fn a_ground_that_is_assumed_is_named_where_the_platform_comes_below_it() {
    let folder = TempDir::new().unwrap();
    let robot = point_mass(&folder, &FOUR, false);
    let low = ["safety", &robot, "--pose", "0,0,0.3", "--with", "pairs"];
    let (found, said) = (judged(&low), unwrapped(cdpr(&low).stdout).replace('\n', " "));
    assert!(found["assumed_ground_m"].as_f64().unwrap() < 0.0, "{found}");
    assert!(said.contains("The robot file has no `ground_z`: the ground is assumed at z = -"), "{said}");
    let high = ["safety", &robot, "--pose", "0,0,3"];
    assert_eq!(answer(&high)["assumed_ground_m"], serde_json::Value::Null);
    let text = std::fs::read_to_string(&robot).unwrap().replacen('{', "{\"ground_z\":0,", 1);
    std::fs::write(&robot, text).unwrap();
    let said = unwrapped(cdpr(&low).stdout).replace('\n', " ");
    assert!(said.contains("below the ground") && !said.contains("is assumed"), "{said}");
}

#[test]
fn wind_without_a_force_is_said_to_be_that_on_the_cables() {
    let folder = TempDir::new().unwrap();
    let robot = point_mass(&folder, &FOUR, false);
    let says = |more: &[&str]| {
        let call = [&["safety", &robot, "--pose", "0,0,1", "--with"], more].concat();
        unwrapped(cdpr(&call).stdout).replace('\n', " ").contains("The wind is that on the cables.")
    };
    assert!(says(&["wind=12"]) && says(&["wind=12:0:0"]));
    assert!(!says(&["ice=0.002"]) && !says(&["wind=12", "--force", "5,0,0"]));
}

#[test]
fn a_factor_in_the_table_is_the_least_of_rest_and_motion() {
    let folder = TempDir::new().unwrap();
    let robot = camera(&folder);
    let call = ["safety", &robot, "--pose", "1,0.5,3", "--with", "swing=0.001"];
    let (found, printed) = (answer(&call), text(cdpr(&call).stdout));
    let case = &found["broken"][0];
    let [rest, swing] = [case, &case["swing"]].map(|of| of["safety_factor"].as_f64().unwrap());
    assert!(rest < swing, "{case}");
    let row = printed.lines().find(|line| line.starts_with("│ 1 ")).unwrap();
    assert!(row.contains(&format!(" {} ", cdpr_robot::significant(rest, 3))), "{row} {rest}");
}

#[test]
fn a_peak_has_the_difference_of_its_own_break_and_a_factor_that_is_known() {
    let folder = TempDir::new().unwrap();
    let robot = point_mass(&folder, &FOUR, false);
    let mut file: serde_json::Value = serde_json::from_slice(&std::fs::read(&robot).unwrap()).unwrap();
    let cable =
        json!({"section": 1e-5, "youngs_modulus": 5e10, "linear_density": 0.08, "breaking_force": 9000});
    (file["cable"], file["tension_limits"]["max"]) = (cable, json!(9000));
    std::fs::write(&robot, file.to_string()).unwrap();
    let call = ["safety", &robot, "--pose", "1,0.5,1.5", "--with", "swing=1"];
    let (found, printed) = (answer(&call), text(cdpr(&call).stdout));
    let cases = found["broken"].as_array().unwrap();
    let peak = |case: &serde_json::Value| case["swing"]["peak_tension"]["tension_n"].as_f64().unwrap();
    let differ = |case: &serde_json::Value| case["swing"]["peak_difference_n"].as_f64().unwrap();
    let worst = cases.iter().max_by(|a, b| peak(a).total_cmp(&peak(b))).unwrap();
    assert!(cases.iter().any(|case| differ(case) > 1.5 * differ(worst)), "{found}");
    let said = format!("two computations of it differ by up to {} N.", significant(differ(worst), 2));
    assert!(printed.replace('\n', " ").contains(&said), "{said}: {printed}");
    let mut marked = 0;
    for (case, name) in cases.iter().zip(1..) {
        let row = printed.lines().find(|line| line.starts_with(&format!("│ {name} "))).unwrap();
        assert_eq!(row.contains("┆ ~ "), differ(case) > 0.1 * peak(case), "{row} {case}");
        marked += usize::from(row.contains("┆ ~ "));
        let least = 9000.0 / (peak(case) + differ(case));
        let stated = case["swing"]["safety_factor_at_least"].as_f64().unwrap();
        assert!((stated / least - 1.0).abs() < 1e-9, "{case}");
        assert!(row.contains(&format!(" > {} ", least.floor())), "{row} {least}");
    }
    assert!((1..cases.len()).contains(&marked), "{printed}");
}
