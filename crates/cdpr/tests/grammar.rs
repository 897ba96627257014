//! What holds for all commands: the standard input and pipes, files for answers, formats, further columns,
//! what is said.

use crate::common::{answered, cdpr, cdpr_in, data_path, data_text, text, unwrapped};
use serde_json::Value;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// `cdpr ...` with a text on the standard input.
fn fed(input: &str, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cdpr"));
    let command = command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut process = command.spawn().unwrap();
    let mut stdin = process.stdin.take().unwrap();
    let input = input.to_owned();
    let writer = std::thread::spawn(move || stdin.write_all(input.as_bytes()));
    let output = process.wait_with_output().unwrap();
    let _ = writer.join().unwrap();
    output
}

#[test]
fn the_standard_input_is_a_file_like_any_other() {
    let robot = data_text("robots/caroca.json");
    let pose = ["--pose", "0,0,1.75"];
    let by_name = answered(cdpr(&[&["inverse", "caroca"], &pose[..]].concat()));
    assert_eq!(answered(fed(&robot, &[&["inverse", "-"], &pose[..]].concat())), by_name);
    let poses = data_text("poses/caroca.csv");
    let file = data_path("poses/caroca.csv");
    assert_eq!(
        answered(fed(&poses, &["inverse", "caroca", "--poses", "-"])),
        answered(cdpr(&["inverse", "caroca", "--poses", &file]))
    );
    let table = data_text("tables/ishigami.csv");
    let analysed: Value =
        serde_json::from_str(&answered(fed(&table, &["analyse", "-", "--format", "json"]))).unwrap();
    assert_eq!(analysed["rows"], 500, "{}", analysed["rows"]);
    let refused = fed("", &["inverse", "-", "--pose", "0,0,1.75"]);
    assert_eq!(refused.status.code(), Some(1), "{}", unwrapped(refused.stderr));
    let refused = unwrapped(fed("mass: 1", &["robot", "check", "-"]).stderr);
    assert!(refused.starts_with("error: -"), "{refused}");
    // It is one file.
    let refused = fed(&robot, &["inverse", "-", "--poses", "-"]);
    assert_eq!(refused.status.code(), Some(2));
    let said = unwrapped(refused.stderr);
    assert!(
        said.starts_with("error: ROBOT and --poses: - is the standard input, which can be one"),
        "{said}"
    );
}

#[test]
fn an_answer_goes_into_no_file_whose_ending_is_that_of_another_format() {
    let folder = TempDir::new().unwrap();
    let call = |format: &str, name: &str| {
        cdpr_in(folder.path(), &["inverse", "caroca", "--pose", "0,0,1.75", "--format", format, "-o", name])
    };
    for (format, name) in [("json", "a.csv"), ("csv", "a.json"), ("text", "a.csv")] {
        let refused = call(format, name);
        assert_eq!(refused.status.code(), Some(2), "{format} {name}");
        let said = unwrapped(refused.stderr);
        assert!(said.starts_with(&format!("error: --out {name}: the answer is ")), "{said}");
        assert!(said.contains(": expected a name that ends in ."), "{said}");
        assert!(!folder.path().join(name).exists(), "{name}");
    }
    for (format, name) in [("json", "b.json"), ("csv", "b.csv"), ("csv", "b.txt"), ("json", "b")] {
        assert_eq!(call(format, name).status.code(), Some(0), "{format} {name}");
    }
    // A folder of results has any name.
    let map =
        ["workspace", "caroca", "--region=0:0.5:2,0:0.5:2,1.75", "--format", "json", "--out", "map.csv"];
    assert_eq!(cdpr_in(folder.path(), &map).status.code(), Some(0));
}

#[cfg(unix)]
#[test]
fn answers_of_the_inverse_model_are_cases_of_the_direct_model() {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("poses.csv"), "x_m,y_m,z_m\n0,0,1.75\n9,9,9\n0.5,0.2,1.5\n").unwrap();
    let program = env!("CARGO_BIN_EXE_cdpr");
    let line = format!(
        "{program} inverse caroca --poses poses.csv --format json | {program} direct caroca --from /dev/stdin \
         --format json"
    );
    let output = Command::new("sh").args(["-c", &line]).current_dir(folder.path()).output().unwrap();
    assert_eq!(output.status.code(), Some(3), "{}", unwrapped(output.stderr));
    let found: Vec<Value> = serde_json::from_slice(&output.stdout).unwrap();
    let close = |k: usize, pose: [f64; 3]| {
        (0..3).all(|axis| (found[k]["position"][axis].as_f64().unwrap() - pose[axis]).abs() < 1e-9)
    };
    assert!(close(0, [0.0, 0.0, 1.75]) && close(2, [0.5, 0.2, 1.5]), "{found:?}");
    let error = found[1]["error"]["message"].as_str().unwrap();
    assert!(error.contains("the inverse model has none"), "{error}");
}

#[test]
fn an_answer_goes_to_the_file_whose_ending_chooses_its_format() {
    let folder = TempDir::new().unwrap();
    let deflection = ["deflection", "caroca", "--pose", "0,0,1.75", "--payload", "50"];
    let run = |more: &[&str]| cdpr_in(folder.path(), &[&deflection[..], more].concat());
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    for (name, format) in [("a.txt", "text"), ("a.json", "json"), ("a.csv", "csv")] {
        let printed = answered(run(&["--format", format]));
        assert_eq!(answered(run(&["-o", name])), "");
        assert_eq!(read(name), printed, "{name}");
    }
    let csv = read("a.csv");
    let lines: Vec<&str> = csv.lines().collect();
    assert!(lines.len() == 2 && lines[0].starts_with("x_m,y_m,z_m,qw,qx,qy,qz,status,dx_mm"), "{csv}");
    std::fs::write(folder.path().join("mine.json"), "mine").unwrap();
    let refused = unwrapped(run(&["-o", "mine.json"]).stderr);
    assert!(refused.contains("--overwrite replaces it"), "{refused}");
    answered(run(&["-o", "mine.json", "--overwrite"]));
    assert_eq!(read("mine.json"), read("a.json"));
    // A list has a row for each entry, another answer a line for each number.
    let findings = text(cdpr(&["robot", "check", "copacabana-handling", "--format", "csv"]).stdout);
    assert!(findings.starts_with("severity,field,"), "{findings}");
    let shown = answered(cdpr(&["robot", "show", "cogiro", "--format", "csv"]));
    assert!(shown.contains("\nmass_kg,91.058\n"), "{shown}");
}

#[test]
fn further_columns_of_poses_are_passed_on_and_rotations_in_another_notation_are_refused() {
    let folder = TempDir::new().unwrap();
    let run = |table: &[u8], format: &str| {
        std::fs::write(folder.path().join("poses.csv"), table).unwrap();
        let inverse = ["inverse", "caroca", "--poses", "poses.csv", "--format", format];
        cdpr_in(folder.path(), &inverse)
    };
    let plain = "t_s,x [mm],y_mm,z_m,status,label\n0.5,100,0,1.75,on,\"a, b\"\n1,200,0,1.75,off,c\n";
    let csv = answered(run(plain.as_bytes(), "csv"));
    let lines: Vec<&str> = csv.lines().collect();
    assert!(
        lines[0].starts_with("x_m,y_m,z_m,qw,qx,qy,qz,t_s,given_status,label,status,length_1_m"),
        "{csv}"
    );
    assert!(lines[1].starts_with("0.1,0.0,1.75,1.0,0.0,0.0,0.0,0.5,on,\"a, b\",held,"), "{csv}");
    let json = answered(run(plain.as_bytes(), "json"));
    let first: Value = serde_json::from_str(json.lines().next().unwrap()).unwrap();
    assert_eq!(first["given"]["t_s"], 0.5);
    assert_eq!(first["given"]["label"], "a, b");
    // The same table as a spreadsheet writes it: semicolons, decimal commas, CRLF, UTF-16 with its mark.
    let german = "t_s;x [mm];y_mm;z_m;status;label\r\n0,5;100;0;1,75;on;a, b\r\n1;200;0;1,75;off;c\r\n";
    let wide = german.encode_utf16().flat_map(u16::to_le_bytes);
    assert_eq!(answered(run(&[0xff, 0xfe].into_iter().chain(wide).collect::<Vec<u8>>(), "csv")), csv);
    for (header, words) in [
        (
            "x,y,z,rz",
            "column rz: expected x_m,y_m,z_m, then none, qw,qx,qy,qz or any of roll_deg,pitch_deg,yaw_deg",
        ),
        ("x,y,z,alpha [deg]", "column alpha [deg]: an angle, and no rotation is named: expected x_m,y_m,z_m"),
        ("x_mm,y_mm,z_mm,Drehung z [°]", "column Drehung z [°]: an angle, and no rotation is named"),
        ("x,y,z,yawn_deg", "column yawn_deg: expected x_m,y_m,z_m"),
        ("x,y,z,q1", "column q1: expected"),
        ("x_kg,y,z,t", "column x_kg: x in a unit of mass: expected x_m"),
    ] {
        let output = run(format!("{header}\n0,0,1.75,0\n").as_bytes(), "csv");
        let said = unwrapped(output.stderr);
        assert!(output.status.code() == Some(1) && said.contains(words), "{header}: {said}");
    }
}

#[test]
fn fewer_than_half_of_the_positions_held_are_an_exit_code_of_their_own() {
    let folder = TempDir::new().unwrap();
    let map = |region: &str, out: &str| {
        let out = folder.path().join(out);
        cdpr(&["workspace", "caroca", "--region", region, "--out", out.to_str().unwrap()])
    };
    let some = map("0,0,1:9:5", "some");
    let said = unwrapped(some.stderr);
    assert_eq!(some.status.code(), Some(3), "{said}");
    assert!(said.contains("warning: fewer than half of the positions are held, 2 of 5"), "{said}");
    assert_eq!(map("0,0,1:3:3", "most").status.code(), Some(0));
    let identify = ["calibrate", "identify", "caroca", "--region", "0,0,1:9:5", "--uncertainty", "a=0.002"];
    let output = cdpr(&[&identify[..], &["--noise", "tension=5"]].concat());
    let said = unwrapped(output.stderr);
    assert!(output.status.code() == Some(3) && said.contains("candidate poses are held, 2 of 5"), "{said}");
}

#[test]
fn less_and_more_is_said_on_request() {
    let pose = ["inverse", "caroca", "--pose", "0,0,1.75"];
    let usual = cdpr(&pose);
    let more = cdpr(&[&pose[..], &["-v"]].concat());
    assert_eq!(usual.stdout, more.stdout);
    let said = unwrapped(more.stderr);
    assert!(
        said.starts_with("robot caroca: CAROCA, 8 cables\n") && said.trim_end().ends_with(" s"),
        "{said}"
    );
    let folder = TempDir::new().unwrap();
    let map = ["workspace", "caroca", "--region", "::3,::3,9", "--overwrite", "--out", "map"];
    let notes = |more: &[&str]| {
        let said = unwrapped(cdpr_in(folder.path(), &[&map[..], more].concat()).stderr);
        (said.contains("note: "), said.contains("question: "))
    };
    assert_eq!((notes(&[]), notes(&["--quiet"])), ((true, true), (false, true)));
    assert_eq!(cdpr(&["-q", "-v", "robot", "list"]).status.code(), Some(2));
}

#[test]
fn an_error_model_is_typed_or_that_of_a_file_or_a_study() {
    let derivatives = |errors: &str| {
        let at = ["derivatives", "caroca", "--pose", "0,0,1.75", "--payload", "50", "--format", "json"];
        cdpr(&[&at[..], &["--uncertainty", errors]].concat())
    };
    let study = data_path("studies/caroca.json");
    let std = |errors: &str| {
        let found: Value = serde_json::from_str(&answered(derivatives(errors))).unwrap();
        found["uncertainty"]["std_mm"].as_f64().unwrap()
    };
    assert!(std(&format!("{study}:table_3")) > 0.0);
    assert!(std(&data_path("calibration/caroca-tolerances.json")) > std("a=1e-6"));
    let several = derivatives(&study);
    let said = unwrapped(several.stderr);
    assert!(
        several.status.code() == Some(2) && said.contains("expected ") && said.contains("table_3"),
        "{said}"
    );
    let missing = unwrapped(derivatives("nowhere.json").stderr);
    assert!(missing.starts_with("error: cannot read nowhere.json"), "{missing}");
    assert!(Path::new(&study).exists());
}

#[test]
fn an_answer_with_poses_is_a_list_of_poses_and_one_with_lengths_a_case() {
    let json = |output: Output| -> Value { serde_json::from_str(&answered(output)).unwrap() };
    let place = ["caroca", "--pose", "0.5,0.2,1.5", "--rpy", "1,-2,3", "--format", "json"];
    let held = answered(cdpr(&[&["inverse"], &place[..]].concat()));
    let found = answered(fed(&held, &["direct", "caroca", "--from", "-", "--format", "json"]));
    let again = |poses: &str| json(fed(poses, &["inverse", "caroca", "--poses", "-", "--format", "json"]));
    let lengths = |of: &Value| -> Vec<f64> {
        of["lengths"].as_array().unwrap().iter().map(|length| length.as_f64().unwrap()).collect()
    };
    let first = lengths(&serde_json::from_str(&held).unwrap());
    let whole = again(&found);
    // The same from a list, and from lines that have their pose.
    for of in [&whole, &again(&format!("[{}]", found.trim())), &again(&whole.to_string())] {
        for (length, expected) in lengths(of).into_iter().zip(&first) {
            assert!((length - expected).abs() < 1e-9, "{length} {expected}");
        }
    }
    let loaded = answered(cdpr(&[&["deflection"], &place[..], &["--payload", "50"]].concat()));
    let rest = json(fed(&loaded, &["direct", "caroca", "--from", "-", "--format", "json"]));
    let expected: Value = serde_json::from_str(&loaded).unwrap();
    for k in 0..3 {
        let [found, expected] = [&rest, &expected["loaded"]].map(|of| of["position"][k].as_f64().unwrap());
        assert!((found - expected).abs() < 1e-9, "{rest}");
    }
    for (given, command, words) in [
        (&loaded, ["inverse", "--poses"], "it has two poses, with the load and without"),
        (&held, ["stiffness", "--poses"], "answer 1: it has no pose: expected a table"),
        (&found, ["direct", "--from"], "unknown field `position`: expected a case of lengths, mass"),
    ] {
        let refused = fed(given, &[command[0], "caroca", command[1], "-"]);
        let said = unwrapped(refused.stderr);
        assert!(refused.status.code() == Some(1) && said.contains(words), "{command:?}: {said}");
    }
}
