//! The commands about one cable and about a robot at a pose, as a user meets them.
//!
//! Their numbers are those of the library and of the references in 40-digit arithmetic.

use crate::common::{answered, cdpr, data_path, data_text, text, unwrapped};
use crate::equilibria::{self, number, vector};
use cdpr_robot::{Pose, Robot, UnitQuaternion, Vector3, Wrench};
use cdpr_statics::{DirectProblem, DirectStart, Load, deflection, direct, inverse};
use serde_json::{Value, json};
use tempfile::TempDir;

fn caroca() -> Robot {
    Robot::from_json(&data_text("robots/caroca.json")).unwrap()
}

pub(crate) fn printed(arguments: &[&str]) -> String {
    answered(cdpr(arguments))
}

pub(crate) fn answer(arguments: &[&str]) -> Value {
    serde_json::from_str(&printed(&[arguments, &["--format", "json"]].concat())).unwrap()
}

pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

pub(crate) fn joined(numbers: &[f64]) -> String {
    numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(",")
}

pub(crate) fn close(a: f64, b: f64, relative: f64) -> bool {
    (a - b).abs() <= relative * b.abs()
}

#[test]
fn a_cable_is_that_of_40_digit_arithmetic_whichever_two_of_its_values_are_known() {
    let cases: Vec<Value> = serde_json::from_str(&data_text("reference/catenary.json")).unwrap();
    for case in cases.iter().take(24) {
        let of = |key: &str| number(&case[key]);
        let (length, end) = (of("unstrained_length"), joined(&[of("x"), of("z")]));
        let cable = format!("weight={},stiffness={}", of("weight_per_length"), of("axial_stiffness"));
        let cable = ["cable", "catenary", &cable];
        // Some of the cables are of no material, which is questioned; the answer is as exact.
        let answer = |arguments: &[&str]| -> Value {
            let output = cdpr(&[arguments, &["--format", "json"]].concat());
            let found: Value = serde_json::from_slice(&output.stdout).unwrap();
            let code = if found["questions"].is_array() { 3 } else { 0 };
            assert_eq!(output.status.code(), Some(code), "{case}: {}", unwrapped(output.stderr));
            found
        };
        let force = Vector3::new(of("force_x"), of("force_z"), 0.0);

        let length_text = length.to_string();
        let known = answer(&[&cable[..], &["--length", &length_text, "--end", &end]].concat());
        let found = numbers(&known["force_n"]);
        let error = (Vector3::new(found[0], found[1], 0.0) - force).norm();
        assert!(error < 1e-8 * force.norm(), "{case}: {known}");
        assert!(close(number(&known["tension"]["anchor_n"]), force.norm(), 1e-8));
        assert!(number(&known["sag_m"]) >= 0.0 && known["energy_j"].is_f64());

        let force_text = joined(&found);
        let end_found =
            answer(&[&cable[..], &["--length", &length_text, "--end-force", &force_text]].concat());
        let apart = vector(&json!([end_found["end_m"][0], end_found["end_m"][1], 0.0]))
            - Vector3::new(of("x"), of("z"), 0.0);
        assert!(apart.norm() < 1e-12 * length, "{case}: {end_found}");

        // The shorter of two cables has the tension: a taut one.
        if case["kind"] == "taut" {
            let tension = number(&known["tension"]["anchor_n"]).to_string();
            let length_found = answer(&[&cable[..], &["--end", &end, "--tension", &tension]].concat());
            assert!(
                close(number(&length_found["unstrained_length_m"]), length, 1e-9),
                "{case}: {length_found}"
            );
        }
    }
    let printed = printed(&["cable", "catenary", "weight=2,stiffness=1e6", "--length", "6", "--end", "5,0"]);
    assert!(printed.contains("anchor point       (5.000000, 0.000000) m"), "{printed}");
}

#[test]
fn the_inverse_model_prints_the_library_s_numbers_to_the_last_bit() {
    let robot = data_path("robots/caroca.json");
    let load = ["--force", "10,0,-20", "--moment", "0,3,0", "--payload", "20"];
    let arguments = [&["inverse", &robot, "--pose", "0.5,-0.3,1.5,0.99,0,0.05,0.1"], &load[..]].concat();
    let found = answer(&arguments);
    let pose = Pose::with_quaternion(Vector3::new(0.5, -0.3, 1.5), [0.99, 0.0, 0.05, 0.1]).unwrap();
    let wrench = Wrench { force: Vector3::new(10.0, 0.0, -20.0), moment: Vector3::new(0.0, 3.0, 0.0) };
    let exact = inverse(&caroca(), &pose, &Load { payload: 20.0, wrench }).unwrap();
    assert_eq!(numbers(&found["lengths"]), exact.lengths);
    assert_eq!(numbers(&found["tensions"]), exact.tensions);
    for (force, exact) in
        found["cable_forces"].as_array().unwrap().iter().zip(&exact.equilibrium.cable_forces)
    {
        assert_eq!(numbers(force), exact.as_slice());
    }
    assert_eq!(number(&found["report"]["residual"]["force_n"]), exact.residual.force);
    assert!(printed(&arguments).contains(&format!("{:.3}", exact.tensions[2])));
}

/// The case for `--from` of a reference.
fn direct_case(case: &Value) -> Value {
    let rotation = cdpr_robot::Matrix3::from_fn(|i, j| number(&case["start_rotation"][i][j]));
    let q = UnitQuaternion::from_matrix(&rotation);
    let p = numbers(&case["start_position"]);
    json!({
        "lengths": numbers(&case["unstrained_lengths"]), "pose": [p[0], p[1], p[2], q.w, q.i, q.j, q.k],
        "force": numbers(&case["external_force"]), "moment": numbers(&case["external_moment"]),
    })
}

#[test]
fn the_direct_model_finds_the_equilibria_of_40_digit_arithmetic_from_a_file() {
    let folder = TempDir::new().unwrap();
    let [robot_path, case_path] = ["robot.json", "case.json"].map(|name| folder.path().join(name));
    let cases: Vec<Value> = serde_json::from_str(&data_text("reference/equilibria.json")).unwrap();
    for expected in cases.iter().take(12) {
        let (robot, case) = (equilibria::robot(expected), direct_case(expected));
        std::fs::write(&robot_path, robot.to_json()).unwrap();
        std::fs::write(&case_path, case.to_string()).unwrap();
        let found = answer(&[
            "direct",
            robot_path.to_str().unwrap(),
            "--from",
            case_path.to_str().unwrap(),
            "--with",
            "certificate",
        ]);
        let far = (vector(&found["position"]) - vector(&expected["position"])).norm();
        assert!(far < 1e-9, "{}: {far} m", robot.name);
        for i in 0..3 {
            for j in 0..3 {
                let difference = number(&found["rotation"][i][j]) - number(&expected["rotation"][i][j]);
                assert!(difference.abs() < 1e-9, "{}: {found}", robot.name);
            }
        }
        for (i, force) in found["cable_forces"].as_array().unwrap().iter().enumerate() {
            let difference = [
                number(&force[0]) - number(&expected["cable_force_horizontal"][i]),
                number(&force[1]) - number(&expected["cable_force_vertical"][i]),
            ];
            assert!(difference[0].hypot(difference[1]) < 1e-6, "{}: {found}", robot.name);
        }
        assert_eq!((&found["stable"], &found["certificate"]["stable"]), (&json!(true), &json!(true)));
        assert!(number(&found["certificate"]["position_m"]) < 1e-10);
        assert!(number(&found["residual"]["force_n"]) < 1e-6);
    }
}

#[test]
fn values_in_another_unit_get_a_question_instead_of_an_answer() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("robot.json");
    std::fs::write(&path, data_text("robots/cogiro.json").replace("1.0e11", "100")).unwrap();
    let soft = cdpr(&["inverse", path.to_str().unwrap(), "--pose", "0,0,2"]);
    let question = unwrapped(soft.stderr);
    assert!(question.contains("cable.youngs_modulus is 100: expected a modulus in Pa"), "{question}");
    assert!(
        question.contains("soft rubber has 1e6: 100 GPa is 1e11, 100 MPa is 1e8 (line 13, column 97)"),
        "{question}"
    );

    let robot = data_path("robots/caroca.json");
    let held = inverse(&caroca(), &Pose::at(0.3, 0.2, 1.4), &Load::none()).unwrap();
    let in_mm: Vec<f64> = held.lengths.iter().map(|length| (1000.0 * length).round()).collect();
    let question = unwrapped(cdpr(&["direct", &robot, "--lengths", &joined(&in_mm)]).stderr);
    assert!(question.contains("expected lengths in m for a robot that is 8.062 m wide: "), "{question}");
    // Slack cables are no mistake.
    let slack: Vec<f64> = held.lengths.iter().map(|length| 20.0 * length).collect();
    let hanging = cdpr(&["direct", &robot, "--lengths", &joined(&slack)]);
    assert!(!unwrapped(hanging.stderr).contains("lengths in m"));
}

#[test]
fn a_case_without_answer_keeps_its_place_among_the_others() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("cases.json");
    let robot = data_path("robots/caroca.json");
    let held = inverse(&caroca(), &Pose::at(0.3, 0.2, 1.4), &Load::none()).unwrap();
    let case = |lengths: &[f64], mass: f64| json!({ "lengths": lengths, "mass": mass });
    let short = [1.0; 8];
    let cases = json!([
        case(&held.lengths, 180.0),
        case(&short, 180.0),
        case(&held.lengths[..7], 180.0),
        case(&held.lengths, 230.0)
    ]);
    std::fs::write(&path, cases.to_string()).unwrap();
    let output = cdpr(&["direct", &robot, "--from", path.to_str().unwrap(), "--format", "json"]);
    assert_eq!(output.status.code(), Some(3));
    let found: Vec<Value> = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(found.len(), 4);
    assert_eq!(found[1]["error"]["kind"], "cable_overstrained");
    assert_eq!(
        found[2]["error"]["message"],
        "lengths is a list of 7: expected one value for each of the 8 cables"
    );
    let alone = answer(&["direct", &robot, "--lengths", &joined(&held.lengths)]);
    assert_eq!(found[0], alone);
    let mut heavier = caroca();
    heavier.platform.mass = 230.0;
    let exact =
        direct(&heavier, &held.lengths, &Load::none(), DirectStart::Pose(&Pose::at(0.3, 0.2, 1.4))).unwrap();
    let apart = vector(&found[3]["position"]) - exact.equilibrium.pose.position;
    assert!(apart.norm() < 1e-12, "{apart}");
    let text = text(cdpr(&["direct", &robot, "--from", path.to_str().unwrap()]).stdout);
    assert!(text.contains("Case 2 has no answer: cable ") && text.contains("Case 4 rests at (0.3"), "{text}");
}

#[test]
fn the_deflection_is_that_of_the_paper_s_nominal_robot() {
    let robot = data_path("robots/caroca.json");
    let arguments = ["deflection", &robot, "--pose", "0,0,1.75", "--payload", "50"];
    let found = answer(&arguments);
    let exact = deflection(&caroca(), &Pose::at(0.0, 0.0, 1.75), &Load::payload(50.0)).unwrap();
    assert_eq!(number(&found["magnitude_mm"]), 1e3 * exact.magnitude());
    assert_eq!(numbers(&found["deflection_mm"]), (1e3 * exact.displacement()).as_slice());
    assert_eq!(numbers(&found["loaded"]["tensions"]), exact.loaded.equilibrium.tensions());
    assert!(printed(&arguments).starts_with(
        "CAROCA at (0, 0, 1.75) m is displaced by 1.33124 mm; it stays stable.\n\
         dp = (0.00000, 0.00000, -1.33124) mm\n"
    ));
}

#[test]
fn the_stiffness_predicts_the_displacement_under_a_small_force() {
    let robot = data_path("robots/caroca.json");
    let arguments = ["stiffness", &robot, "--pose", "0.4,0.2,1.5"];
    let found = answer(&arguments);
    let rows: Vec<Vec<f64>> = found["stiffness"].as_array().unwrap().iter().map(numbers).collect();
    let pose = Pose::at(0.4, 0.2, 1.5);
    let held = inverse(&caroca(), &pose, &Load::none()).unwrap();
    let robot = caroca();
    let problem = DirectProblem::new(&robot, &held.lengths, &Load::none()).unwrap();
    let linearization = problem.linearize(&held.equilibrium).unwrap();
    let wrench = Wrench { force: Vector3::new(1.0, 2.0, -3.0), moment: Vector3::zeros() };
    let motion = linearization.displacement(&wrench);
    for (row, force) in rows.iter().zip(wrench.to_vector().iter()) {
        let balanced: f64 = row.iter().zip(motion.iter()).map(|(k, x)| k * x).sum();
        assert!((balanced - force).abs() < 1e-9, "{balanced} N for {force} N");
    }
    let values: Vec<f64> =
        found["eigenvalues"].as_array().unwrap().iter().map(|v| number(&v["stiffness_n_per_m"])).collect();
    assert!(values.is_sorted() && values[0] > 0.0 && found["stable"] == true);
    assert!(close(values[0], number(&found["least_stiffness_n_per_m"]), 1e-12));
    assert!(
        printed(&arguments).starts_with("CAROCA at (0.4, 0.2, 1.5) m is stable; its softest motion has ")
    );
}

#[test]
fn a_check_ends_with_its_own_code_where_it_warns() {
    let notes = printed(&["robot", "check", &data_path("robots/caroca.json")]);
    assert!(notes.replace('\n', " ").contains("note: cables[*].exit_point is the same for cables 1 and 3, "));
    // One note for all cables that share exit points.
    assert_eq!(notes.matches("two cables at one place").count(), 1, "{notes}");
    assert!(notes.starts_with("CAROCA: 8 cables, no warnings, 2 notes.\n"), "{notes}");
    assert_eq!(answer(&["robot", "check", &data_path("robots/cogiro.json")]), json!([]));

    let folder = TempDir::new().unwrap();
    let path = folder.path().join("robot.json");
    std::fs::write(&path, data_text("robots/cogiro.json").replace("1.0e11", "100")).unwrap();
    let output = cdpr(&["robot", "check", path.to_str().unwrap(), "--format", "json"]);
    assert_eq!(output.status.code(), Some(3));
    let findings: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(findings[0]["severity"], "warning");
    assert_eq!(findings[0]["field"], "cable.youngs_modulus");
    assert_eq!(findings[0]["value"], "100 Pa");
    assert!(findings[0]["remedy"].as_str().unwrap().contains("1.000e11 Pa, if 100 is in GPa"));
}

#[test]
fn loaded_cables_that_sag_are_not_slack() {
    let (robot, lengths) =
        (data_path("robots/caroca.json"), [4.44, 4.54, 4.36, 4.26, 4.26, 4.36, 4.54, 4.44]);
    let report = |longer: f64| {
        let lengths: Vec<f64> =
            lengths.iter().enumerate().map(|(i, l)| if i == 0 { l + longer } else { *l }).collect();
        answer(&["direct", &robot, "--lengths", &joined(&lengths)])["report"].clone()
    };
    let (taut, loose) = (report(0.0), report(0.5));
    assert_eq!((&taut["slack_cables"], &taut["slack_below_own_weights"]), (&json!([]), &json!(1.0)));
    assert!(loose["slack_cables"].as_array().unwrap().contains(&json!(1)), "{loose}");
    assert!(!loose["sagging_cables"].as_array().unwrap().contains(&json!(1)), "{loose}");
}

#[test]
fn a_platform_that_falls_on_the_way_to_its_load_is_an_answer_with_exit_code_3() {
    let robot = data_path("reference/robots/suspended.json");
    let asked = ["deflection", &robot, "--pose", "0.6,-0.4,1.6", "--rpy", "3", "-4", "6", "--payload", "2"];
    let asked = [&asked[..], &["--moment", "400,-300,100"]].concat();
    let fallen = cdpr(&asked);
    assert_eq!(fallen.status.code(), Some(3));
    let said = text(fallen.stdout).replace('\n', " ");
    let fallen = cdpr(&[&asked[..], &["--format", "json"]].concat());
    assert_eq!(fallen.status.code(), Some(3));
    let error = &serde_json::from_str::<Value>(&text(fallen.stdout)).unwrap()["error"];
    assert_eq!(error["kind"], "branch_ends");
    let share = number(&error["share"]);
    assert!((share - 0.9225).abs() < 0.0025, "{error}");
    let falls = format!("at {:.2} % of the load the platform falls from (", 100.0 * share);
    assert!(said.contains(&falls), "{said}");
    let [from, to] = ["falls_from", "falls_to"].map(|name| numbers(&error[name]));
    assert!(from.len() == 7 && (from[0] - to[0]).hypot(from[2] - to[2]) > 0.1, "{error}");
}

#[test]
fn paths_and_capacities_end_with_the_branch() {
    let robot = data_path("reference/robots/suspended.json");
    let folder = tempfile::tempdir().unwrap();
    let poses = folder.path().join("poses.csv");
    std::fs::write(&poses, "x,y,z,roll_deg,pitch_deg,yaw_deg\n0.6,-0.4,1.6,3,-4,6\n").unwrap();
    let load = ["--payload", "2", "--moment", "400,-300,100"];
    let path = cdpr(&[&["path", &robot, "--poses", poses.to_str().unwrap()], &load[..]].concat());
    assert_eq!(path.status.code(), Some(3));
    assert!(text(path.stdout).contains("branch_ends"));
    let at = ["--pose", "0.6,-0.4,1.6", "--rpy", "3", "-4", "6", "--format", "json"];
    let capacity = cdpr(&[&["capacity", &robot][..], &at, &load].concat());
    assert_eq!(capacity.status.code(), Some(3));
    let found: Value = serde_json::from_str(&text(capacity.stdout)).unwrap();
    assert_eq!(found["payload_kept_kg"]["error"]["kind"], "branch_ends", "{found}");
    assert!(found["payload_kept_kg"]["value"].is_null(), "{found}");
}

#[test]
fn a_catenary_beyond_ten_percent_of_strain_is_refused() {
    let refused = cdpr(&["cable", "catenary", "weight=1,stiffness=1000", "--length", "3", "--end", "4,-1"]);
    assert_eq!(refused.status.code(), Some(1));
    let said = unwrapped(refused.stderr);
    assert!(said.contains("strains the cable by") && said.contains("beyond the 10 %"), "{said}");
}

#[test]
fn breaks_that_the_others_do_not_bear_end_with_three() {
    let stadium = format!("{}/../../docs/how-to/broken-cable/stadium.json", env!("CARGO_MANIFEST_DIR"));
    let mut robot: Value = serde_json::from_str(&std::fs::read_to_string(stadium).unwrap()).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("robot.json");
    let mut asked = |ground: f64, more: &[&str]| {
        robot["ground_z"] = ground.into();
        std::fs::write(&path, robot.to_string()).unwrap();
        let file = path.to_str().unwrap();
        cdpr(&[&["safety", file, "--pose", "20,10,12", "--format", "json"], more].concat())
    };
    let whole = asked(-100.0, &[]);
    assert_eq!(whole.status.code(), Some(0), "{}", text(whole.stderr));
    let whole: Value = serde_json::from_str(&text(whole.stdout)).unwrap();
    let broken = whole["broken"].as_array().unwrap();
    assert_eq!(broken.len(), 4);
    assert_eq!(broken[2]["cables"], serde_json::json!([3]));
    assert_eq!(number(&broken[2]["tensions"][2]), 0.0);
    // The rest that the direct model of the robot without this cable finds.
    let [x, y, z] = [0, 1, 2].map(|k| number(&broken[2]["position"][k]));
    assert!((x - 8.143733).abs() < 1e-5 && (y + 6.970618).abs() < 1e-5 && (z - 3.274191).abs() < 1e-5);
    let low = asked(5.0, &[]);
    assert_eq!(low.status.code(), Some(3));
    let low: Value = serde_json::from_str(&text(low.stdout)).unwrap();
    assert_eq!(low["broken"][2]["below_ground"], true);
    let pairs = asked(-100.0, &["--with", "pairs"]);
    let pairs: Value = serde_json::from_str(&text(pairs.stdout)).unwrap();
    assert_eq!(pairs["broken"].as_array().unwrap().len(), 10);
    let refused = asked(0.0, &["--with", "triples"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(refused.stderr).contains("--with triples: expected pairs"));
}

#[test]
fn wind_from_all_directions_has_a_verdict_and_derivatives() {
    let asked = |more: &[&str]| {
        let stadium = format!("{}/../../docs/how-to/loads/stadium.json", env!("CARGO_MANIFEST_DIR"));
        let answer = cdpr(&[&[more[0], &stadium, "--pose", "20,10,12"], &more[1..]].concat());
        (answer.status.code(), text(answer.stdout), text(answer.stderr))
    };
    let json = |text: &str| serde_json::from_str::<Value>(text).unwrap();
    let (code, windy, _) = asked(&["safety", "--with", "wind=15", "--format", "json"]);
    assert_eq!(code, Some(0));
    let farthest = &json(&windy)["in_weather"]["farthest"];
    let azimuth = number(&farthest["azimuth_deg"]).to_radians();
    let wind = format!("{},{},0", 15.0 * azimuth.cos(), 15.0 * azimuth.sin());
    let (_, alone, _) = asked(&["deflection", "--wind", &wind, "--format", "json"]);
    let alone = number(&json(&alone)["in_weather"]["magnitude_mm"]);
    assert!((number(&farthest["moved_mm"]) - alone).abs() < 1e-6 * alone, "{farthest} {alone}");
    let settings =
        ["derivatives", "--force", "50,0,0", "--wind", "15,0,0", "--with", "ice=0.003", "--format", "json"];
    let (_, slopes, said) = asked(&settings);
    let by_weather = json(&slopes)["in_weather"]["by_weather"].clone();
    assert_eq!(by_weather.as_array().map(Vec::len), Some(7), "{said}");
    assert!(number(&by_weather[5]["magnitude_mm"]) > 0.0);
    let (code, _, said) = asked(&["safety", "--with", "wind=-3"]);
    assert!(code == Some(2) && said.contains("expected a speed above 0 m/s"), "{said}");
    let (code, _, said) = asked(&["deflection", "--with", "wind_profile=0.3:10"]);
    assert!(code == Some(2) && said.contains("expected a wind, too"), "{said}");
}
