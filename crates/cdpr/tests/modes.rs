//! `cdpr modes`: natural motions of platform and cables, and what says that cables have no mass.

use crate::common::{cdpr, data_path, data_text, text, unwrapped};
use crate::equilibria::number;
use crate::models::{answer, close, joined, numbers, printed};
use crate::response::HOOK;
use cdpr_robot::{Pose, Robot};
use cdpr_statics::vibration::modes_at;
use cdpr_statics::{Load, inverse};
use serde_json::Value;
use tempfile::TempDir;

#[test]
fn natural_frequencies_are_those_of_the_library_by_pose_and_by_lengths() {
    let file = data_path("robots/cogiro.json");
    let robot = Robot::from_json(&data_text("robots/cogiro.json")).unwrap();
    let pose = Pose::at(0.5, 0.2, 2.0);
    let modes = modes_at(&robot, pose, &Load::none()).unwrap().modes;
    let expected: Vec<_> = modes.iter().map(|mode| mode.frequency).collect();
    let at_pose = answer(&["modes", &file, "--massless", "--pose", "0.5,0.2,2"]);
    assert_eq!(numbers(&at_pose["frequencies_hz"]), expected);
    let lengths = joined(&inverse(&robot, &pose, &Load::none()).unwrap().lengths);
    let by_lengths = answer(&["modes", &file, "--massless", "--lengths", &lengths, "--start", "0,0,2.5"]);
    for (one, other) in numbers(&by_lengths["frequencies_hz"]).into_iter().zip(&expected) {
        assert!(close(one, *other, 1e-9));
    }
    let printed = printed(&["modes", &file, "--massless", "--pose", "0.5,0.2,2"]);
    assert!(printed.contains(&format!("{:.4}", expected[0])), "{printed}");
}

#[test]
fn platform_and_cables_vibrate_together_and_none_of_their_motions_is_missing() {
    let file = data_path("robots/cogiro.json");
    let found = answer(&["modes", &file, "--pose", "0,0,2", "--below", "6"]);
    let modes = found["modes"].as_array().unwrap();
    assert_eq!(found["counted"].as_u64().unwrap() as usize, modes.len());
    assert!(found["inertia_assumed"] == false && found["complete_below_hz"] == 6.0);
    let frequencies: Vec<f64> = modes.iter().map(|mode| number(&mode["frequency_hz"])).collect();
    assert!(frequencies.is_sorted() && frequencies.iter().all(|frequency| *frequency < 6.0));
    for mode in modes {
        let sum = number(&mode["platform_share"]) + numbers(&mode["cable_shares"]).iter().sum::<f64>();
        assert!((sum - 1.0).abs() < 1e-8);
    }
    // The lowest one is the answer.
    let printed = text(cdpr(&["modes", &file, "--pose", "0,0,2", "--number", "5"]).stdout);
    let words = format!("CoGiRo at (0, 0, 2) m: lowest natural frequency {:.4} Hz; ", frequencies[0]);
    assert!(printed.starts_with(&words), "{printed}");
    let first = answer(&["modes", &file, "--pose", "0,0,2", "--number", "5"]);
    assert_eq!(first["modes"].as_array().unwrap().len(), 5);
    for (one, other) in first["modes"].as_array().unwrap().iter().zip(&frequencies) {
        assert!(close(number(&one["frequency_hz"]), *other, 2e-6));
    }
    let lengths = joined(
        &inverse(
            &Robot::from_json(&data_text("robots/cogiro.json")).unwrap(),
            &Pose::at(0.0, 0.0, 2.0),
            &Load::none(),
        )
        .unwrap()
        .lengths,
    );
    let by_lengths = answer(&["modes", &file, "--lengths", &lengths, "--start", "0,0,2.2", "--below", "6"]);
    assert_eq!(by_lengths["counted"], found["counted"]);
    // Robots without inertia say what is assumed.
    let assumed = cdpr(&["modes", "caroca", "--pose", "0,0,1.75", "--format", "json"]);
    let answer: Value = serde_json::from_slice(&assumed.stdout).unwrap();
    assert!(assumed.status.success() && answer["inertia_assumed"] == true);
    assert!(unwrapped(assumed.stderr).contains("the robot has no inertia"));
    for (option, value) in [("--below", "0"), ("--below", "1e9"), ("--number", "0"), ("--below", "nan")] {
        let refused = cdpr(&["modes", &file, "--pose", "0,0,2", option, value]);
        assert!(matches!(refused.status.code(), Some(1 | 2)), "{option} {value}");
        assert!(unwrapped(refused.stderr).contains("expected"), "{option} {value}");
    }
}

#[test]
fn winches_that_yield_make_a_robot_slower_and_stiff_ones_do_not() {
    let at = ["modes", "cogiro", "--pose", "0.5,0.2,2", "--number", "4"];
    let with = |winches: &str| answer(&[&at[..], &["--with", winches]].concat());
    let lowest = |found: &Value| number(&found["modes"][0]["frequency_hz"]);
    let platform = |found: &Value| number(&found["platform"]["frequency_hz"]);
    let (fixed, stiff, soft) = (answer(&at), with("servo=1e15"), with("servo=2e5,winch=20"));
    assert!(fixed.get("winches").is_none() && soft["winches"]["mass_kg"] == 20.0);
    assert!(close(lowest(&stiff), lowest(&fixed), 2e-6) && close(platform(&stiff), platform(&fixed), 2e-6));
    assert!(platform(&soft) < 0.95 * platform(&fixed), "{soft}");
    assert!(printed(&[&at[..], &["--with", "servo=2e5,winch=20"]].concat()).contains("rotors of 20 kg"));
    for (winches, said) in [
        ("winch=20", "expected servo=N/m, too: free rotors hold no platform"),
        ("servo=0", "free rotors hold no platform"),
        ("servo=1e6,winch=-1", "mass of the winches is -1.0: expected a finite mass"),
        ("rotor=3", "expected winch, servo"),
    ] {
        let refused = cdpr(&[&at[..], &["--with", winches]].concat());
        let error = unwrapped(refused.stderr);
        assert!(!refused.status.success() && error.contains(said), "{winches}: {error}");
    }
}

#[test]
fn without_mass_of_cables_an_answer_says_how_slowly_the_cables_themselves_vibrate() {
    let file = data_path("robots/cogiro.json");
    let modes = answer(&["modes", &file, "--massless", "--pose", "0,0,2"]);
    let lowest = number(&modes["lowest_cable_frequency_hz"]);
    let cables = numbers(&modes["cable_frequencies_hz"]);
    assert_eq!((cables.len(), cables.into_iter().fold(f64::INFINITY, f64::min)), (8, lowest));
    assert!(lowest < 2.0 * numbers(&modes["frequencies_hz"])[0]);
    assert!(modes["warning"].as_str().unwrap().contains("less than twice 4.158 Hz"));
}

#[test]
fn paths_maps_and_derivatives_have_the_frequencies_of_platform_and_cables() {
    let file = data_path("robots/cogiro.json");
    let modes = answer(&["modes", &file, "--pose", "0,0,2", "--below", "8"]);
    let modes = modes["modes"].as_array().unwrap();
    let share = |mode: &&Value| number(&mode["platform_share"]);
    let swing = |mode: &&Value| number(&mode["swing_share"]);
    let platform = modes.iter().max_by(|one, other| swing(one).total_cmp(&swing(other))).unwrap();
    let (first, platform, share) =
        (&modes[0]["frequency_hz"], number(&platform["frequency_hz"]), share(&platform));
    let check = |found: &Value| {
        assert!(close(number(&found["platform_frequency_hz"]), platform, 2e-6), "{found}");
        assert!(close(number(&found["platform_share"]), share, 1e-4), "{found}");
        assert!(close(number(&found["lowest_frequency_hz"]), number(first), 2e-6), "{found}");
    };
    let folder = TempDir::new().unwrap();
    let poses = folder.path().join("poses.csv");
    std::fs::write(&poses, "x_m,y_m,z_m\n0,0,2\n").unwrap();
    let path = cdpr(&["path", &file, "--poses", poses.to_str().unwrap(), "--format", "json"]);
    check(&serde_json::from_slice(&path.stdout).unwrap());
    // A payload of 10 g lowers the frequency by less than a thousandth.
    let found = answer(&["derivatives", &file, "--pose", "0,0,2", "--payload", "0.01"]);
    let (found, share_found) = (number(&found["platform_frequency_hz"]), number(&found["platform_share"]));
    assert!(close(found, platform, 1e-3) && close(share_found, share, 0.1), "{found} {share_found}");
    let out = folder.path().join("map");
    let map = ["workspace", &file, "--region=0:1:2,0:1:2,2:2:1", "--out", out.to_str().unwrap()];
    let map = cdpr(&map);
    assert!(map.status.success(), "{}", unwrapped(map.stderr));
    let rows: Value =
        serde_json::from_str(&std::fs::read_to_string(out.join("workspace.json")).unwrap()).unwrap();
    let of_first = ["platform_frequency_hz", "platform_share", "lowest_frequency_hz"]
        .map(|name| (name.to_owned(), rows["columns"][name][0].clone()));
    check(&Value::Object(of_first.into_iter().collect()));
}

#[test]
fn a_heading_has_the_pose_at_which_free_coordinates_are_found() {
    let file = data_path("robots/four-cables.json");
    let at = [&file, "--pose", "0.5,0.3,2", "--free", "roll,pitch"];
    let held = answer(&[&["inverse"], &at[..]].concat());
    let further: [&[&str]; 5] = [
        &["modes", "--number", "3"],
        &["response", "--below", "2"],
        &["stiffness"],
        &["safety"],
        &["deflection"],
    ];
    for more in further {
        let load: &[&str] = if more[0] == "deflection" { &["--payload", "5"] } else { &[] };
        let call = [&more[..1], &at[..], &more[1..], load].concat();
        let found = numbers(&answer(&call)["found_pose"]);
        let apart = found.iter().zip(numbers(&held["found_pose"])).map(|(one, other)| (one - other).abs());
        assert!(found.len() == 7 && apart.fold(0.0, f64::max) < 1e-9, "{more:?}: {found:?}");
        let text = printed(&call).replace('\n', " ");
        assert!(text.starts_with("four cables at (0.5, 0.3, 2) m, roll 3.07"), "{more:?}: {text}");
    }
    assert!(answer(&["modes", &data_path("robots/cogiro.json"), "--pose", "0,0,2"])["found_pose"].is_null());
}

#[test]
fn the_table_of_a_pose_has_a_row_for_each_motion() {
    let ask = ["modes", "cogiro", "--pose", "0,0,2", "--number", "3"];
    let found = answer(&ask);
    let table = printed(&[&ask[..], &["--format", "csv"]].concat());
    let lines: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(lines.len(), 4, "{table}");
    let of = |name: &str, row: usize| {
        let column = lines[0].iter().position(|cell| *cell == name).unwrap();
        lines[row][column].parse::<f64>().unwrap()
    };
    for (k, mode) in found["modes"].as_array().unwrap().iter().enumerate() {
        assert_eq!(of("frequency_hz", k + 1), number(&mode["frequency_hz"]));
        assert_eq!(of("cable_share_8", k + 1), numbers(&mode["cable_shares"])[7]);
        assert_eq!(of("rotation_z", k + 1), numbers(&mode["rotation"])[2]);
    }
}

#[test]
fn a_motion_that_nothing_resists_is_no_vibration() {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("hook.json");
    std::fs::write(&file, HOOK).unwrap();
    let ask = [
        "modes",
        file.to_str().unwrap(),
        "--free",
        "x,y,roll,pitch,yaw",
        "--pose",
        "0,0,1.6",
        "--number",
        "3",
    ];
    let modes = answer(&ask)["modes"].clone();
    let lowest = number(&modes[1]["frequency_hz"]);
    assert!(number(&modes[0]["frequency_hz"]) == 0.0 && lowest > 0.1);
    let said = printed(&ask);
    assert!(said.contains(&format!("{lowest:.4} Hz; 3 motions")), "{said}");
    assert!(said.contains("Nothing resists a motion of the platform about z."), "{said}");
    let table = folder.path().join("poses.csv");
    std::fs::write(&table, "x,y,z\n0,0,1.6\n0,0,1.7\n").unwrap();
    let rows = printed(&[&ask[..4], &["--poses", table.to_str().unwrap()]].concat());
    let first = rows.lines().nth(1).unwrap().split(',').nth(8).unwrap();
    assert!((first.parse::<f64>().unwrap() - lowest).abs() < 1e-9, "{rows}");
}
