//! `cdpr response`: the answer of the library, at a pose and at many.

use crate::common::{cdpr, data_path, data_text, text, unwrapped};
use crate::equilibria::number;
use crate::models::{answer, close};
use cdpr_dynamics::{Damping, FrequencyResponse, worst_amplitude};
use cdpr_robot::{Pose, Robot, Vector3};
use cdpr_statics::{DirectProblem, DirectStart, Load, Unstable, inverse};
use tempfile::TempDir;

#[test]
fn a_shaken_platform_answers_as_the_library_says_in_json_csv_and_figure() {
    let file = data_path("robots/cogiro.json");
    let robot = Robot::from_json(&data_text("robots/cogiro.json")).unwrap();
    let load = Load::payload(10.0);
    let held = inverse(&robot, &Pose::at(0.5, 0.2, 2.0), &load).unwrap();
    let problem = DirectProblem::new(&robot, &held.lengths, &load).unwrap();
    let rest = problem
        .with_unstable(Unstable::Accepted)
        .direct(DirectStart::Near(&held.equilibrium))
        .unwrap()
        .equilibrium;
    let damping = Damping { stretch: 1e-3, drag: 0.2 };
    let response = FrequencyResponse::new(&problem, &rest, 8.0, damping).unwrap();
    let lever = rest.pose.rotation * Vector3::new(0.1, 0.2, 0.3);
    let folder = TempDir::new().unwrap();
    let figure = folder.path().join("response.svg");
    let given =
        ["response", &file, "--pose", "0.5,0.2,2", "--payload", "10", "--below", "8", "--number", "16"];
    let given = [&given[..], &["--with", "damping=1e-3,drag=0.2", "--marker", "0.1,0.2,0.3"]].concat();
    let found = answer(&[&given[..], &["--figure", figure.to_str().unwrap()]].concat());
    let frequencies = found["frequencies"].as_array().unwrap();
    // Those of equal distances, and the natural ones.
    assert!(frequencies.len() > 25, "{}", frequencies.len());
    for at in frequencies {
        let (per_force, per_shortening) = response.at(number(&at["frequency_hz"])).unwrap().at_point(&lever);
        let worst = worst_amplitude(&per_force);
        assert!(close(number(&at["amplitude_mm_per_n"]), 1e3 * worst, 1e-6));
        assert!(close(number(&at["per_force_mm_per_n"][0][1][0]), 1e3 * per_force[(0, 1)].re, 1e-6));
        assert!(close(number(&at["per_winch_mm_per_mm"][3][2][1]), per_shortening[(2, 3)].im, 1e-6));
    }
    let svg = std::fs::read_to_string(&figure).unwrap();
    assert!(svg.contains("amplitude [mm/N]") && svg.contains("worst direction"));
    let rows = text(cdpr(&[&given[..], &["--format", "csv"]].concat()).stdout);
    assert_eq!(rows.lines().count(), frequencies.len() + 1);
    assert!(
        rows.starts_with(
            "frequency_hz,amplitude_mm_per_n,x_mm_per_n,y_mm_per_n,z_mm_per_n,winch_1_mm_per_mm"
        )
    );
    let shown = text(cdpr(&given).stdout);
    assert!(shown.contains("The largest peaks") && shown.contains("0.001 s"), "{shown}");
    // A table of poses has the largest peak of each.
    let poses = folder.path().join("poses.csv");
    std::fs::write(&poses, "x_m,y_m,z_m\n0.5,0.2,2\n0,0,2\n").unwrap();
    let table =
        cdpr(&["response", &file, "--poses", poses.to_str().unwrap(), "--below", "8", "--payload", "10"]);
    let table = text(table.stdout);
    assert!(
        table.lines().count() == 3 && table.contains("amplitude_at_hz,amplitude_mm_per_n,static_mm_per_n")
    );
    for refused in [
        ["--below", "0"],
        ["--below", "nan"],
        ["--with", "drag=-1"],
        ["--with", "air"],
        ["--with", "damping=-1"],
    ] {
        let below = if refused[0] == "--below" { &[][..] } else { &["--below", "5"] };
        let refused = cdpr(&[&["response", &file, "--pose", "0,0,2"], below, &refused].concat());
        assert!(matches!(refused.status.code(), Some(1 | 2)));
        assert!(unwrapped(refused.stderr).contains("expected"));
    }
}

#[test]
fn a_peak_that_nothing_damps_has_no_number() {
    let call =
        ["response", &data_path("robots/cogiro.json"), "--pose", "0,0,2", "--below", "5", "--number", "9"];
    let shown = text(cdpr(&[&call[..], &["--with", "damping=0"]].concat()).stdout).replace('\n', " ");
    assert!(
        shown.contains("a force shakes the point without a bound, at ") && !shown.contains("e1"),
        "{shown}"
    );
    let undamped =
        |format: &str| text(cdpr(&[&call[..], &["--with", "damping=0", "--format", format]].concat()).stdout);
    let json: serde_json::Value = serde_json::from_str(&undamped("json")).unwrap();
    let without = |at: &&serde_json::Value| at["amplitude_mm_per_n"].is_null();
    let unbounded = json["frequencies"].as_array().unwrap().iter().filter(without).count();
    assert!(
        unbounded > 0 && undamped("csv").lines().filter(|line| line.contains(",,,")).count() == unbounded
    );
    let shown = text(cdpr(&[&call[..], &["--with", "drag=0.5"]].concat()).stdout);
    assert!(!shown.contains("bound"), "{shown}");
}

/// A body on one cable, which turns about the cable as it likes.
pub(crate) const HOOK: &str = r#"{"format":"cdpr-robot/1","name":"hook","gravity":9.81,"platform":{"mass":5,
"center_of_mass":[0,0,0],"inertia":[[0.3,0,0],[0,0.5,0],[0,0,0.7]]},
"cable":{"diameter":0.004,"section":8e-6,"linear_density":0,"youngs_modulus":1e11},
"tension_limits":{"min":1,"max":5000},
"cables":[{"exit_point":[0,0,5],"anchor_point":[0,0,0.4]}]}"#;

#[test]
fn what_has_no_bound_is_said_number_by_number() {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("hook.json");
    std::fs::write(&file, HOOK).unwrap();
    let at = ["--pose", "0,0,1.6", "--free", "x,y,roll,pitch,yaw", "--below", "3", "--number", "5"];
    let call = [&["response", file.to_str().unwrap()], &at[..]].concat();
    let finite = |value: &serde_json::Value| !value[0].is_null();
    let found = answer(&call);
    let frequencies = found["frequencies"].as_array().unwrap();
    let unbounded: Vec<_> = frequencies.iter().filter(|at| at["amplitude_mm_per_n"].is_null()).collect();
    // Two motions along x, two along y, which neither a force along another axis nor the winch excites.
    let mut along = [0; 3];
    for at in &unbounded {
        let axes: Vec<usize> = (0..3).filter(|k| !finite(&at["per_force_mm_per_n"][k][k])).collect();
        assert!(matches!(axes[..], [0] | [1]), "{at}");
        along[axes[0]] += 1;
        let vertical = number(&at["per_force_mm_per_n"][2][2][0]);
        assert!((1e-3..1e-2).contains(&vertical), "{at}");
        assert!((number(&at["per_winch_mm_per_mm"][0][2][0]) - 1.0).abs() < 0.01, "{at}");
        assert!(number(&at["per_force_mm_per_n"][1 - axes[0]][1 - axes[0]][0]).abs() < 1e6);
    }
    assert_eq!(along, [2, 2, 0]);
    // Neighbours without a bound are all named.
    let shown = text(cdpr(&call).stdout);
    assert!(shown.contains("at rest it moves it by 69.3 mm/N"), "{shown}");
    for at in unbounded {
        assert!(shown.contains(&format!("{:.4}", number(&at["frequency_hz"]))), "{shown}");
    }
    // Beside the axis of the hook a force turns it without resistance.
    let off = [&call[..], &["--marker", "0.2,0,0", "--with", "drag=0.5"]].concat();
    let still = answer(&off)["frequencies"][0].clone();
    assert!(still["amplitude_mm_per_n"].is_null() && !finite(&still["per_force_mm_per_n"][1][1]), "{still}");
    assert!(
        finite(&still["per_force_mm_per_n"][0][0]) && finite(&still["per_force_mm_per_n"][2][1]),
        "{still}"
    );
    let shown = unwrapped(cdpr(&off).stdout);
    assert!(shown.contains("at rest nothing resists it"), "{shown}");
    // A bounce does not turn the hook, and a turn about the cable does not move it.
    let modes = text(
        cdpr(&["modes", file.to_str().unwrap(), "--pose", "0,0,1.6", "--free", "x,y,roll,pitch,yaw"]).stdout,
    );
    assert!(modes.contains("┆ along z ") && modes.contains("┆ about z "), "{modes}");
}

#[test]
fn a_platform_hung_in_one_point_is_shaken_without_a_word_about_0_hertz() {
    let folder = TempDir::new().unwrap();
    let mut drawn: serde_json::Value = serde_json::from_str(
        &std::fs::read_to_string(data_path("../docs/how-to/planner/drawn.json")).unwrap(),
    )
    .unwrap();
    drawn["cables"].as_array_mut().unwrap().truncate(3);
    let file = folder.path().join("three.json");
    std::fs::write(&file, drawn.to_string()).unwrap();
    let call = [
        "response",
        file.to_str().unwrap(),
        "--pose",
        "10,-5,12",
        "--free",
        "roll,pitch,yaw",
        "--below",
        "0.5",
    ];
    // Its inertia is assumed, as a note says.
    let shown = text(cdpr(&[&call[..], &["--format", "json"]].concat()).stdout);
    let found: serde_json::Value = serde_json::from_str(&shown).unwrap();
    assert!(found["frequencies"][0]["amplitude_mm_per_n"].is_number(), "{found}");
}

#[test]
fn a_band_without_a_peak_says_so_and_has_no_empty_table() {
    let arguments = ["response", &data_path("robots/cogiro.json"), "--pose", "0,0,2", "--number", "9"];
    let still = unwrapped(cdpr(&[&arguments[..], &["--below", "0.1"]].concat()).stdout);
    assert!(still.contains("there is no peak") && !still.contains("largest peaks"), "{still}");
    assert!(!still.contains("frequency [Hz]"), "{still}");
    let shaken = unwrapped(cdpr(&[&arguments[..], &["--below", "6"]].concat()).stdout);
    assert!(shaken.contains("largest peaks") && !shaken.contains("no peak"), "{shaken}");
}

#[test]
fn a_peak_of_cables_without_drag_is_no_answer_and_drag_makes_it_one() {
    let file = data_path("../docs/how-to/planner/stadium.json");
    let call = ["response", &file, "--pose", "0,0,12", "--below", "2", "--number", "9"];
    let said = unwrapped(cdpr(&call).stdout).replace('\n', " ");
    assert!(
        said.starts_with("Stadium camera at (0, 0, 12) m: no bound is known without drag; at rest a force"),
        "{said}"
    );
    assert!(said.contains("The largest peak, ") && said.contains("is far above a real one"), "{said}");
    let damped = unwrapped(cdpr(&[&call[..], &["--with", "drag=0.5"]].concat()).stdout);
    assert!(damped.contains("a force shakes the point by up to "), "{damped}");
    // A table says it apart.
    let folder = TempDir::new().unwrap();
    let poses = folder.path().join("poses.csv");
    std::fs::write(&poses, "x_m,y_m,z_m\n0,0,12\n").unwrap();
    let table = ["response", &file, "--poses", poses.to_str().unwrap(), "--below", "2", "--number", "9"];
    for (arguments, is_noted) in [
        (table.to_vec(), true),
        ([&call[..], &["--format", "csv"]].concat(), true),
        ([&table[..], &["--with", "drag=0.5"]].concat(), false),
    ] {
        let noted = unwrapped(cdpr(&arguments).stderr);
        assert_eq!(noted.contains("note: nothing damps cables across their stretch"), is_noted, "{noted}");
    }
}
