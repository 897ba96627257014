//! `cdpr simulate` as a user types it.

use crate::common::{cdpr, data, data_path, text, unwrapped};
use crate::models::answer;
use crate::safety::point_mass;
use serde_json::Value;
use tempfile::TempDir;

fn events(folder: &TempDir, text: &str) -> String {
    let path = folder.path().join("events.json");
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn a_dropped_payload_makes_a_series_and_a_summary() {
    let folder = TempDir::new().unwrap();
    let robot = data_path("robots/cogiro.json");
    let events = data_path("events/payload-dropped.json");
    let out = folder.path().join("series.csv");
    let out = out.to_str().unwrap();
    let call =
        ["simulate", &robot, "--pose", "0,0,2", "--payload", "50", "--events", &events, "--until", "0.2"];
    let printed = cdpr(&[&call[..], &["--rate", "50", "--damping", "2e-4", "--out", out]].concat());
    let summary = text(printed.stdout);
    assert_eq!(printed.status.code(), Some(0), "{}", unwrapped(printed.stderr));
    assert!(summary.starts_with("CoGiRo moves up to 15.4 mm and 0.0793 deg"), "{summary}");
    assert!(summary.lines().all(|line| line.chars().count() <= 80), "{summary}");
    let series = std::fs::read_to_string(out).unwrap();
    let mut lines = series.lines();
    let header = lines.next().unwrap();
    assert!(header.starts_with("t_s,x_m,y_m,z_m,rx_rad,ry_rad,rz_rad,t_exit_1_n,t_anchor_1_n,t_exit_2_n"));
    assert!(header.ends_with("t_exit_8_n,t_anchor_8_n,qw,qx,qy,qz"), "{header}");
    assert_eq!(lines.count(), 11);
    let again = cdpr(&[&call[..], &["--out", out]].concat());
    assert_eq!(again.status.code(), Some(1));
    assert!(unwrapped(again.stderr).contains("--overwrite"));
    assert_eq!(std::fs::read_to_string(out).unwrap(), series);

    let whole = cdpr(&[&call[..], &["--rate", "50", "--damping", "2e-4", "--format", "json"]].concat());
    let whole: Value = serde_json::from_str(&text(whole.stdout)).unwrap();
    assert_eq!(whole["samples"].as_array().unwrap().len(), 11);
    assert_eq!(whole["columns"].as_array().unwrap().len(), whole["samples"][0].as_array().unwrap().len());
    assert!((whole["greatest_distance_m"].as_f64().unwrap() - 0.0154).abs() < 1e-4);
    assert!(whole["difference"]["position_m"].as_f64().unwrap() < 1e-6);
    let table = cdpr(&[&call[..], &["--rate", "50", "--damping", "2e-4", "--format", "csv"]].concat());
    assert_eq!(text(table.stdout), series);
}

#[test]
fn a_series_is_a_table_of_poses_and_a_figure_has_motion_and_tensions() {
    let folder = TempDir::new().unwrap();
    let [out, figure] =
        ["series.csv", "motion.svg"].map(|name| folder.path().join(name).display().to_string());
    let robot = data_path("robots/caroca.json");
    let events = events(&folder, r#"[{"t": 0, "payload": 20}]"#);
    let call =
        ["simulate", &robot, "--pose", "0,0,1.75", "--rpy", "1,2,3", "--events", &events, "--until", "0.05"];
    let found = cdpr(&[&call[..], &["--out", &out, "--figure", &figure]].concat());
    assert_eq!(found.status.code(), Some(0), "{}", unwrapped(found.stderr));
    let svg = std::fs::read_to_string(&figure).unwrap();
    for words in ["Motion of ", "x, cable 1", "cable 8", "from the rest [mm]", "tension at the platform [N]"]
    {
        assert!(svg.contains(words), "{words}");
    }
    // The platform is turned as in the series, not as its rotation vector from the rest says.
    let found = cdpr(&["deflection", &robot, "--payload", "20", "--poses", &out, "--format", "json"]);
    assert_eq!(found.status.code(), Some(0), "{}", unwrapped(found.stderr));
    let found = cdpr(&["inverse", &robot, "--poses", &out, "--format", "csv"]);
    let rows = text(found.stdout);
    let held = cdpr(&["inverse", &robot, "--pose", "0,0,1.75", "--rpy", "1,2,3", "--format", "json"]);
    let held: Value = serde_json::from_str(&text(held.stdout)).unwrap();
    let mut lines = rows.lines();
    let place = lines.next().unwrap().split(',').position(|name| name.ends_with("length_1_m")).unwrap();
    let first: f64 = lines.next().unwrap().split(',').nth(place).unwrap().parse().unwrap();
    assert!((first - held["lengths"][0].as_f64().unwrap()).abs() < 1e-6, "{rows}");
}

#[test]
fn lengths_are_searched_for_their_pose_and_a_tension_above_its_limit_ends_with_3() {
    let folder = TempDir::new().unwrap();
    let events = events(&folder, r#"[{"t": 0.01, "force": [0, 0, -20000]}]"#);
    let robot = data_path("robots/four-cables.json");
    let call = ["simulate", &robot, "--lengths", "5.2,5.2,5.3,5.3", "--events", &events, "--until", "0.1"];
    let found = cdpr(&call);
    assert_eq!(found.status.code(), Some(3), "{}", unwrapped(found.stderr));
    let summary = text(found.stdout);
    assert!(summary.contains("tension_limits.max 5000"), "{summary}");
    assert!(summary.lines().all(|line| line.chars().count() <= 80), "{summary}");
}

#[test]
fn what_is_wrong_is_named() {
    let folder = TempDir::new().unwrap();
    let robot = data_path("robots/cogiro.json");
    let solve = |text_of: &str, more: &[&str]| {
        let events = events(&folder, text_of);
        let call = ["simulate", &robot, "--pose", "0,0,2", "--events", &events];
        let found = cdpr(&[&call[..], more].concat());
        assert_ne!(found.status.code(), Some(0));
        assert!(found.stdout.is_empty());
        unwrapped(found.stderr)
    };
    let until = ["--until", "0.1"];
    assert!(
        solve(r#"[{"t": 0, "cut": 9}]"#, &until)
            .contains("event 1, cut is 9: expected the number of a cable")
    );
    let twice = r#"[{"t": 0.02, "cut": 1}, {"t": 0.01, "cut": 1}]"#;
    let gone = "cut is 1: expected a cable that is still there, not one that parts at 0.01 s";
    assert!(solve(twice, &until).contains(&format!("event 1, {gone}")));
    let loose =
        r#"[{"t": 0, "cut": 2, "at": "exit"}, {"t": 0.01, "shorten": {"cable": 2, "by": 0.1, "over": 1}}]"#;
    assert!(
        solve(loose, &until).contains("event 2, shorten.cable is 2: expected a cable that is still there")
    );
    assert!(solve("[]", &["--until", "-1"]).contains("until is -1.0: expected a time"));
    assert!(solve("[{]", &until).contains("events.json: events: line 1, column 3"));
    assert!(solve("[]", &[]).contains("--until"));
    assert!(solve("[]", &["--until", "0"]).contains("until is 0.0: expected a time [s] above zero"));
    assert!(solve("[]", &["--until", "1", "--rate", "0"]).contains("rate is 0.0"));
    assert!(solve("[]", &["--until", "1", "--damping=-1"]).contains("damping is -1.0"));
    assert!(
        solve("[]", &["--until", "1", "--with", "mesh=3"]).contains("expected elements, degree, tolerance")
    );
}

#[test]
fn few_samples_hide_neither_how_far_the_platform_moves_nor_how_it_swings() {
    // A mass on a spring that loses a load m: it swings by m g/k about its new rest, with the stiffness
    // k = EA/L of the cable.
    let folder = TempDir::new().unwrap();
    let robot = point_mass(&folder, &[[0.0, 0.0, 5.0]], true);
    let events = events(&folder, r#"[{"t": 0, "payload": -5}]"#);
    let call = ["simulate", &robot, "--lengths", "2.97", "--payload", "5", "--events", &events];
    let amplitude = 5.0 * 9.81 * 2.97 / 1e4;
    for rate in ["1", "1000"] {
        let whole = answer(&[&call[..], &["--until", "0.9", "--rate", rate]].concat());
        let of = |name: &str| whole[name].as_f64().unwrap();
        assert!((of("greatest_distance_m") / (2.0 * amplitude) - 1.0).abs() < 0.01, "{rate}: {whole}");
        // The mean place of part of a period is not its middle.
        assert!((0.8..1.6).contains(&(of("swing_m") / amplitude)), "{rate}: {whole}");
        let samples = whole["samples"].as_array().unwrap();
        assert_eq!(samples.len(), if rate == "1" { 1 } else { 901 });
    }
}

#[test]
fn a_greatest_tension_holds_for_the_end_where_it_is_limited() {
    // At rest cable 3 has 543.5 N at the platform, where it is limited to 550 N, and 557.3 N at its exit.
    let folder = TempDir::new().unwrap();
    let stadium = std::fs::read_to_string(data("../docs/how-to/loads/stadium.json")).unwrap();
    let robot = folder.path().join("stadium.json");
    std::fs::write(&robot, stadium.replace("\"max\": 8000", "\"max\": 550")).unwrap();
    let robot = robot.to_str().unwrap();
    let events = events(&folder, r#"[{"t": 0.1, "payload": 0.001}]"#);
    let held = answer(&["inverse", robot, "--pose", "20,10,12"]);
    let call = ["simulate", robot, "--pose", "20,10,12", "--events", &events, "--until", "0.2"];
    let found = answer(&call);
    for (cable, exit) in
        found["cables"].as_array().unwrap().iter().zip(held["exit_tensions"].as_array().unwrap())
    {
        assert!(cable["above"].is_null(), "{cable}");
        assert!((cable["rest_n"].as_f64().unwrap() - exit.as_f64().unwrap()).abs() < 1e-2, "{cable} {exit}");
    }
}

#[test]
fn events_that_do_nothing_or_take_from_the_platform_are_questioned() {
    let folder = TempDir::new().unwrap();
    let robot = point_mass(&folder, &[[0.0, 0.0, 5.0]], true);
    let given = r#"[{"t": 0.2, "payload": -5}, {"t": 0, "payload": -2}, {"t": 0.01, "payload": 1}]"#;
    let events = events(&folder, given);
    let found = cdpr(&["simulate", &robot, "--lengths", "2.97", "--events", &events, "--until", "0.05"]);
    assert_eq!(found.status.code(), Some(3));
    let asked = unwrapped(found.stderr);
    assert!(asked.contains("question: event 1, t is 0.2 s: the motion ends at 0.05 s, before it"), "{asked}");
    assert!(
        asked.contains("question: event 2, payload is -2 kg: 2 kg of it are the platform's own"),
        "{asked}"
    );
}

#[test]
fn a_cable_that_is_cut_at_either_end_is_slack_only_if_it_was_so_before() {
    let folder = TempDir::new().unwrap();
    let robot = point_mass(&folder, &[[-3.0, 0.0, 5.0], [3.0, 0.0, 5.0], [0.5, 0.0, 5.0]], true);
    for at in ["anchor", "exit"] {
        let events = events(&folder, &format!(r#"[{{"t": 0.01, "cut": 3, "at": "{at}"}}]"#));
        let call = ["simulate", &robot, "--pose", "0.2,0,2", "--events", &events, "--until", "0.04"];
        let found = cdpr(&call);
        let summary = text(found.stdout);
        assert!(summary.contains("\u{2506} no, cut") && !summary.contains("yes"), "{at}: {summary}");
        // Without the cable it rests elsewhere.
        assert!(summary.contains("from its start"), "{summary}");
        assert!(summary.contains("Its start is at (0.2, 0, 2) m"), "{summary}");
        let found = answer(&call);
        let cable = |k: usize| &found["cables"][k];
        assert!(cable(2)["slack"] == false && cable(2)["cut_at_s"] == 0.01, "{found}");
        assert!(cable(0)["slack"] == false && cable(0)["cut_at_s"].is_null(), "{found}");
    }
}

#[test]
fn a_platform_that_falls_below_the_ground_is_reported_and_no_moment_acts_on_a_point() {
    // From z = 2.03 m less the stretch the mass falls freely to the floor, below which 0.1 m are an error of
    // surveying at most.
    let folder = TempDir::new().unwrap();
    let robot = point_mass(&folder, &[[0.0, 0.0, 5.0]], true);
    let cut = events(&folder, r#"[{"t": 0, "cut": 1}]"#);
    let call = ["simulate", &robot, "--lengths", "2.97", "--events", &cut, "--until", "0.7"];
    let found = cdpr(&call);
    assert_eq!(found.status.code(), Some(3), "{}", unwrapped(found.stderr));
    let said = text(found.stdout).replace('\n', " ");
    assert!(said.contains("The platform comes below the ground: at 0.6"), "{said}");
    assert!(said.contains("below the floor of the base frame, z = 0"), "{said}");
    let found = text(cdpr(&[&call[..], &["--format", "json"]].concat()).stdout);
    let found: Value = serde_json::from_str(&found).unwrap();
    let at = found["below_ground"]["at_s"].as_f64().unwrap();
    let fall = |height: f64| (2.0 * height / 9.81_f64).sqrt();
    assert!((fall(1.99)..fall(2.13) + 0.01).contains(&at), "{at}");
    let short = answer(&[&call[..6], &["--until", "0.3"]].concat());
    assert!(short["below_ground"].is_null(), "{short}");

    let turned = events(&folder, r#"[{"t": 0, "moment": [0, 0, 5]}]"#);
    let refused = cdpr(&[&call[..5], &[&turned[..], "--until", "0.1"]].concat());
    let said = unwrapped(refused.stderr);
    assert!(
        said.contains("event 1, moment is [0.0, 0.0, 5.0]: expected zeros: the platform is a point"),
        "{said}"
    );
    let asked =
        ["deflection", &robot, "--pose", "0,0,2", "--free", "x", "--payload", "1", "--moment", "0,5,0"];
    let said = unwrapped(cdpr(&asked).stderr);
    assert!(said.contains("moment is 5 N m: the platform is a point mass, which no moment turns"), "{said}");
}
