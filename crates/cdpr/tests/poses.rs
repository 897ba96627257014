//! Poses in files, rotations by angles, quaternions in doubt, and the payload of the direct model.

use crate::common::{answered, cdpr, data_path, is_all_held, text, unwrapped};
use crate::equilibria::{number, vector};
use serde_json::Value;
use tempfile::TempDir;

/// A robot file and a position that its cables hold.
const ROBOTS: [(&str, [f64; 3]); 2] =
    [("robots/caroca.json", [0.5, -0.2, 1.75]), ("robots/cogiro.json", [0.5, -0.2, 2.0])];

/// Commands that take poses, with a load where they need one.
const COMMANDS: [&[&str]; 4] = [
    &["inverse", "--payload", "20"],
    &["deflection", "--payload", "20"],
    &["stiffness"],
    &["derivatives", "--payload", "20"],
];

/// A folder with a file of poses.
struct File {
    folder: TempDir,
}

impl File {
    fn new(content: &str) -> Self {
        let file = Self { folder: TempDir::new().unwrap() };
        std::fs::write(file.folder.path().join("poses.csv"), content).unwrap();
        file
    }

    fn path(&self) -> String {
        self.folder.path().join("poses.csv").to_str().unwrap().to_owned()
    }

    /// Standard output of a command with these poses that must end with the code.
    fn run(&self, code: i32, arguments: &[&str]) -> String {
        let output = cdpr(&[arguments, &["--poses", &self.path()]].concat());
        let said = unwrapped(output.stderr).replace('\n', " ");
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {said}");
        // How many poses are held and where others are not, and nothing else.
        let is_held = said.contains(" held; 1 without feasible tensions, at line ");
        let is_said = if code == 0 { is_all_held(&said) } else { is_held };
        assert!(is_said && said.matches(". ").count() <= 2, "{said}");
        text(output.stdout)
    }

    /// Message of a command with these poses that must end with the code.
    fn refused(&self, code: i32, arguments: &[&str]) -> String {
        let output = cdpr(&[arguments, &["--poses", &self.path()]].concat());
        let error = unwrapped(output.stderr);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {error}");
        assert!(output.stdout.is_empty());
        error
    }
}

fn answer(arguments: &[&str]) -> Value {
    serde_json::from_str(&answered(cdpr(&[arguments, &["--format", "json"]].concat()))).unwrap()
}

fn lines(text: &str) -> Vec<Value> {
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn joined(numbers: &[f64]) -> String {
    numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(",")
}

/// All numbers of an answer in their order.
fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(items) => items.iter().flat_map(flat).collect(),
        other => vec![number(other)],
    }
}

#[test]
fn each_pose_of_a_file_is_answered_as_it_is_alone_and_one_that_fails_has_its_reason() {
    for (robot, position) in ROBOTS {
        let robot = data_path(robot);
        let at = joined(&position);
        let file = File::new(&format!(
            "x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg\n{at},2,-3,5\n\n0,0,60,0,0,0\n{at},0,0,0\n"
        ));
        for command in COMMANDS {
            let alone = [&command[..1], &[&robot], &command[1..]].concat();
            let found = lines(&file.run(3, &[&alone[..], &["--format", "json"]].concat()));
            assert_eq!(found.len(), 3);
            for (line, rpy) in [(&found[0], ["2", "-3", "5"]), (&found[2], ["0", "0", "0"])] {
                let pose = ["--pose", &at, "--rpy", rpy[0], rpy[1], rpy[2]];
                let mut line = line.clone();
                let given = line.as_object_mut().unwrap().remove("pose").unwrap();
                assert_eq!(flat(&given)[..3], position);
                assert_eq!(line, answer(&[&alone[..], &pose].concat()), "{command:?}");
            }
            let refused = cdpr(&[&alone[..], &["--pose", "0,0,60"]].concat());
            assert_eq!(refused.status.code(), Some(1));
            let reason = found[1]["error"]["message"].as_str().unwrap();
            assert_eq!(unwrapped(refused.stderr), format!("error: {reason}\n"));
            assert_eq!(found[1]["error"]["kind"], "infeasible_tension");
            assert_eq!(found[1].as_object().unwrap().len(), 2);
        }
    }
}

#[test]
fn a_table_has_the_numbers_of_the_lines_of_json_to_the_last_bit() {
    for (robot, position) in ROBOTS {
        let robot = data_path(robot);
        let at = joined(&position);
        let file = File::new(&format!("{at}\n0,0,60\n"));
        for command in COMMANDS {
            let arguments = [&command[..1], &[&robot], &command[1..]].concat();
            let json = lines(&file.run(3, &[&arguments[..], &["--format", "json"]].concat()));
            let table = file.run(3, &arguments);
            let mut rows = csv::Reader::from_reader(table.as_bytes());
            let header = rows.headers().unwrap().clone();
            // The reader refuses rows of another length.
            let rows: Vec<_> = rows.records().map(Result::unwrap).collect();
            let cell = |row: usize, name: &str| {
                rows[row].get(header.iter().position(|column| column == name).unwrap()).unwrap()
            };
            let numbers = |row: usize, names: &[String]| -> Vec<f64> {
                names.iter().map(|name| cell(row, name).parse().unwrap()).collect()
            };
            // Of frequencies near those of the cables the table warns as the line of JSON does.
            let warning = json[0]["warning"].as_str().unwrap_or_default().replace('\n', " ");
            assert_eq!((cell(0, "status"), cell(0, "reason")), ("held", warning.as_str()));
            assert_eq!((cell(1, "status"), cell(1, "z_m")), ("infeasible_tension", "60.0"));
            assert_eq!(cell(1, "reason"), json[1]["error"]["message"]);
            let pose = ["x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"].map(str::to_owned);
            assert_eq!(numbers(0, &pose), flat(&json[0]["pose"]));
            let cables = |name: &str, unit: &str| (1..=8).map(|i| format!("{name}_{i}_{unit}")).collect();
            let names = |names: &[&str]| names.iter().map(ToString::to_string).collect();
            let compared: Vec<(Vec<String>, &Value)> = match command[0] {
                "inverse" => vec![
                    (cables("length", "m"), &json[0]["lengths"]),
                    (cables("tension", "n"), &json[0]["tensions"]),
                ],
                "deflection" => vec![
                    (names(&["dx_mm", "dy_mm", "dz_mm"]), &json[0]["deflection_mm"]),
                    (names(&["magnitude_mm"]), &json[0]["magnitude_mm"]),
                    (names(&["rx_deg", "ry_deg", "rz_deg"]), &json[0]["rotation_deg"]),
                    (cables("length", "m"), &json[0]["lengths"]),
                    (cables("unloaded_tension", "n"), &json[0]["unloaded"]["tensions"]),
                    (cables("loaded_tension", "n"), &json[0]["loaded"]["tensions"]),
                ],
                "stiffness" => {
                    let units = [["n_per_m", "n_per_rad"], ["n", "nm_per_rad"]];
                    let unit = |i: usize, j: usize| units[usize::from(i > 3)][usize::from(j > 3)];
                    let entry = |i| (1..=6).map(move |j| format!("k_{i}{j}_{}", unit(i, j)));
                    let entries = (1..=6).flat_map(entry).collect();
                    let length = &json[0]["characteristic_length_m"];
                    vec![
                        (entries, &json[0]["stiffness"]),
                        (names(&["least_stiffness_n_per_m"]), &json[0]["least_stiffness_n_per_m"]),
                        (names(&["eigenvalue_1_n_per_m"]), &json[0]["eigenvalues"][0]["stiffness_n_per_m"]),
                        (names(&["eigenvalue_6_n_per_m"]), &json[0]["eigenvalues"][5]["stiffness_n_per_m"]),
                        (names(&["characteristic_length_m"]), length),
                    ]
                }
                _ => {
                    let parameters = json[0]["parameters"].as_array().unwrap();
                    let all = |output: &str| {
                        let name = |parameter: &Value| format!("{output}/{}", parameter.as_str().unwrap());
                        parameters.iter().map(name).collect::<Vec<_>>()
                    };
                    let last = parameters.len() - 1;
                    let parameter = parameters[last].as_str().unwrap();
                    let vector = ["dx_mm", "dy_mm", "dz_mm"].map(|name| format!("{name}/{parameter}"));
                    let lengths = (1..=8).map(|i| format!("length_{i}_m/{parameter}")).collect();
                    vec![
                        (all("magnitude_mm"), &json[0]["magnitude_mm"]),
                        (vector.to_vec(), &json[0]["deflection_mm"][last]),
                        (lengths, &json[0]["lengths"][last]),
                    ]
                }
            };
            for (names, expected) in compared {
                assert_eq!(numbers(0, &names), flat(expected), "{command:?} {names:?}");
            }
        }
    }
}

#[test]
fn a_long_file_keeps_its_order_and_ends_well_where_all_poses_are_held() {
    let robot = data_path("robots/caroca.json");
    let xs: Vec<f64> = (0..2500).map(|i| -1.0 + 2.0 * f64::from(i) / 2499.0).collect();
    let poses: String = xs.iter().map(|x| format!("{x},0,1.75\n")).collect();
    let found = lines(&File::new(&poses).run(0, &["inverse", &robot, "--format", "json"]));
    assert_eq!(found.iter().map(|line| number(&line["pose"][0])).collect::<Vec<_>>(), xs);
    let alone = answer(&["inverse", &robot, "--pose", &format!("{},0,1.75", xs[2000])]);
    assert_eq!(found[2000]["lengths"], alone["lengths"]);
}

#[test]
fn columns_are_found_by_their_names() {
    let robot = data_path("robots/cogiro.json");
    let lengths = |content: &str| {
        lines(&File::new(content).run(0, &["inverse", &robot, "--format", "json"]))[0]["lengths"].clone()
    };
    let turned = lengths("0.5,0,2,0.6,0,0,0.8");
    assert_eq!(turned, lengths("x,y,z,qw,qx,qy,qz\n0.5,0,2,0.6,0,0,0.8\n"));
    assert_eq!(turned, lengths("qx, qy, qz, qw, x_m, y_m, z_m\n0, 0, 0.8, 0.6, 0.5, 0, 2\n"));
    assert_eq!(lengths("z_m,x_m,y_m\n2,0.5,0"), lengths("0.5,0,2"));
    // Its order is given by names: a rotation far from level needs no question.
    lengths("x,y,z,qw,qx,qy,qz\n0,0,2,0.34,0,0,0.94");
}

#[test]
fn a_file_that_is_no_list_of_poses_is_refused_with_its_line() {
    let robot = data_path("robots/caroca.json");
    let columns = "expected x_m,y_m,z_m, then none, qw,qx,qy,qz or any of roll_deg,pitch_deg,yaw_deg";
    for (content, words) in [
        ("0,0,1.75\n\n0,0\n", "line 3: 2 cells: expected 3, as many as in line 1"),
        ("0,0,up\n", "line 1, column column3: `up`: expected a number"),
        ("x,y\n0,0\n", &format!("line 1: columns x,y: {columns}")),
        ("x,y,z,roll,pitch,yaw\n", "line 1: column roll has no unit: expected roll_deg or roll_rad"),
        ("x,y,z\n0,0,1\n0,0,1,2\n", "line 3: 4 cells: expected 3, as many as in line 1"),
        ("x,y,z\n0,0,1\nx,y,z\n", "line 3, column x: `x`: expected a number"),
        ("0,0,1,1,0,0,1\n", "line 1: the quaternion 1,0,0,1 has the length 1.4142: expected the length 1"),
        ("x,y,z,qw,qx,qy,qz\n0,0,1,2,0,0,0\n", "line 2: the quaternion 2,0,0,0 has the length 2.0000"),
        ("0,0,1,0,0,0,1\n", "line 1: the quaternion 0,0,0,1 has a small qw and a large qz"),
    ] {
        let error = File::new(content).refused(1, &["inverse", &robot]);
        assert!(error.starts_with("error: --poses ") && error.contains(words), "`{words}` not in: {error}");
    }
    for (content, found) in
        [("", "the file is empty"), ("x,y,z\n", "nothing but a header"), ("\n\n", "the file is empty")]
    {
        let error = File::new(content).refused(2, &["inverse", &robot]);
        assert!(error.contains(found), "{error}");
    }
}

/// A printed answer without its residuals, which are rounding errors.
fn without_residuals(printed: &str) -> Vec<&str> {
    printed.lines().filter(|line| !line.starts_with("residuals")).collect()
}

#[test]
fn angles_and_a_quaternion_are_one_rotation_which_stands_in_the_heading() {
    for (robot, position) in ROBOTS {
        let (path, at) = (data_path(robot), joined(&position));
        // About z by 10 degrees.
        let half = 5.0_f64.to_radians();
        let quaternion = format!("{at},{},0,0,{}", half.cos(), half.sin());
        let by_angles = ["--pose", &at, "--rpy", "0", "0", "10"];
        for command in COMMANDS {
            let alone = [&command[..1], &[&path], &command[1..]].concat();
            let printed = answered(cdpr(&[&alone[..], &by_angles].concat()));
            let heading = "m, roll 0, pitch 0, yaw 10 degrees";
            assert!(printed.lines().next().unwrap().contains(heading), "{printed}");
            let other = answered(cdpr(&[&alone[..], &["--pose", &quaternion]].concat()));
            assert_eq!(without_residuals(&printed), without_residuals(&other));
            let level = answered(cdpr(&[&alone[..], &["--pose", &at]].concat()));
            assert!(!level.lines().next().unwrap().contains("yaw"), "{level}");
        }
        let hysteresis = ["hysteresis", &path, "--law", &data_path("cables/caroca-4mm-law.json")];
        let hysteresis = [&hysteresis[..], &["--payload", "20", "--with", "steps=2"]].concat();
        assert_eq!(
            answered(cdpr(&[&hysteresis[..], &by_angles].concat())),
            answered(cdpr(&[&hysteresis[..], &["--pose", &quaternion]].concat()))
        );
        let lengths = joined(&flat(&answer(&[&["inverse", &path], &by_angles[..]].concat())["lengths"]));
        let direct = ["direct", &path, "--lengths", &lengths];
        let found = answer(&[&direct[..], &["--pose", &at, "--rpy", "0", "0", "10"]].concat());
        let level = answer(&[&direct[..], &["--pose", &at]].concat());
        let iterations = |found: &Value| found["report"]["iterations"].as_u64().unwrap();
        assert!(iterations(&found) < iterations(&level), "{found} {level}");
        let apart = vector(&found["position"]) - vector(&Value::from(position.to_vec()));
        assert!(apart.norm() < 1e-9, "{found}");
    }
}

#[test]
fn a_workspace_takes_angles_too() {
    let folder = TempDir::new().unwrap();
    let (robot, out) = (data_path("robots/caroca.json"), folder.path().join("out"));
    let run = |rotation: &[&str]| {
        let place = ["workspace", &robot, "--region", "0,0,1.75", "--format", "json"];
        let answer = answered(cdpr(&[&place[..], &["--out", out.to_str().unwrap()], rotation].concat()));
        serde_json::from_str::<Value>(&answer).unwrap()
    };
    let found = run(&["--rpy", "0", "-90", "0"]);
    let half = 0.5_f64.sqrt();
    for (component, expected) in flat(&found["quaternion"]).iter().zip([half, 0.0, -half, 0.0]) {
        assert!((component - expected).abs() < 1e-15, "{found}");
    }
}

#[test]
fn rotations_in_doubt_are_questioned() {
    let robot = data_path("robots/cogiro.json");
    let no_rotation = "the pose has a quaternion and --rpy: expected one of them";
    let lengths = "10,10,10,10,10,10,10,10";
    let at = "0.5,0,2,0,0,0.0871557,0.9961947";
    let reordered = "expected qw,qx,qy,qz, which would be 0.996195,0,0,0.087156";
    for (arguments, words) in [
        (vec!["inverse", &robot, "--pose", "0,0,2,1,1,0,0"], "such as 0.707107,0.707107,0,0"),
        (vec!["stiffness", &robot, "--pose", at], reordered),
        (vec!["direct", &robot, "--lengths", lengths, "--pose", at], reordered),
        (vec!["inverse", &robot, "--pose", "0,0,2,0,0,0,1"], "would be 1,0,0,0"),
        (vec!["inverse", &robot, "--pose", "0,0,2,0,0,0,2"], "has the length 2.0000"),
        (vec!["inverse", &robot, "--pose", "0,0,2,0.6,0,0,0.8", "--rpy", "0", "0", "9"], no_rotation),
        (vec!["inverse", &robot, "--pose", "0,0,2", "--rpy", "0", "9"], "2 numbers: expected 3"),
        (vec!["direct", &robot, "--lengths", lengths, "--rpy", "0", "0", "9"], "expected --pose, too"),
    ] {
        let output = cdpr(&arguments);
        let error = unwrapped(output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
        assert!(error.contains(words), "`{words}` not in: {error}");
    }
}

#[test]
fn the_direct_model_under_a_payload_finds_the_loaded_platform_of_the_deflection() {
    for (robot, position) in ROBOTS {
        let (path, at) = (data_path(robot), joined(&position));
        let deflection = answer(&["deflection", &path, "--pose", &at, "--payload", "50"]);
        let lengths = joined(&flat(&deflection["lengths"]));
        let direct = ["direct", &path, "--lengths", &lengths, "--pose", &at];
        let found = answer(&[&direct[..], &["--payload", "50"]].concat());
        let apart = vector(&found["position"]) - vector(&deflection["loaded"]["position"]);
        assert!(apart.norm() < 1e-9, "{robot}: {apart}");
        let moved = vector(&found["position"]) - vector(&deflection["unloaded"]["position"]);
        assert!(moved.norm() > 1e-4, "{robot}: {moved}");

        let folder = TempDir::new().unwrap();
        let file = folder.path().join("case.json");
        let case = format!("{{\"lengths\": [{lengths}], \"payload\": 50, \"pose\": [{at}]}}");
        std::fs::write(&file, case).unwrap();
        assert_eq!(answer(&["direct", &path, "--from", file.to_str().unwrap()]), found);

        let output = cdpr(&[&direct[..], &["--payload", "-1"]].concat());
        assert_eq!(output.status.code(), Some(2));
        assert!(unwrapped(output.stderr).contains("expected a mass, zero or more [kg]"));
    }
}

#[test]
fn millimetres_are_metres_without_rounding_and_a_temperature_of_a_sweep_may_be_zero() {
    let table = File::new("x_mm,y_mm,z_mm\n1380,0,2000\n").run(0, &["inverse", "caroca"]);
    assert!(table.lines().nth(1).unwrap().starts_with("1.38,0.0,2.0,"), "{table}");
    let call = ["deflection", "caroca", "--pose", "0,0,2", "--payload", "5", "--with"];
    let warm =
        |kelvin: &str| answer(&[&call[..], &[&format!("warmer={kelvin},cable_expansion=1.2e-5")]].concat());
    let [none, some] = ["0", "1e-9"].map(|kelvin| number(&warm(kelvin)["in_weather"]["deflection_mm"][2]));
    assert!((none / some - 1.0).abs() < 1e-6, "{none} {some}");
}

#[test]
fn along_a_path_lengths_are_continuous_and_jumps_have_a_column() {
    let robot = data_path("reference/robots/stadium.json");
    let path: String = (0..=20).map(|k| format!("{},-4.667,10\n", -2.5 + 0.25 * f64::from(k))).collect();
    let file = File::new(&format!("{path}0,0,100\n2.5,-4.667,10\n"));
    let along = ["inverse", &robot, "--with", "path"];
    let found = lines(&file.run(3, &[&along[..], &["--format", "json"]].concat()));
    let held: Vec<_> = found.iter().filter(|line| line["error"].is_null()).collect();
    assert_eq!((found.len(), held.len()), (23, 22));
    assert!(held.iter().all(|line| line["jump"] == false));
    for pair in held.windows(2) {
        let [a, b] = [flat(&pair[0]["lengths"]), flat(&pair[1]["lengths"])];
        assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 0.5), "{a:?} {b:?}");
    }
    let table = file.run(3, &along);
    let mut rows = csv::Reader::from_reader(table.as_bytes());
    let jump = rows.headers().unwrap().iter().position(|column| column == "jump").unwrap();
    let cells: Vec<_> = rows.records().map(|row| row.unwrap()[jump].to_owned()).collect();
    assert!(cells.iter().enumerate().all(|(k, cell)| cell == if k == 21 { "" } else { "false" }));
    let alone = cdpr(&["inverse", &robot, "--pose", "0,0,10", "--with", "path"]);
    assert_eq!(alone.status.code(), Some(2));
}

#[test]
fn tables_of_massless_frequencies_warn_where_cables_vibrate_as_slowly_as_the_platform() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("poses.csv");
    std::fs::write(&path, "x_m,y_m,z_m\n0,0,2\n").unwrap();
    let poses = path.to_str().unwrap();
    let output = cdpr(&["modes", "cogiro", "--payload", "10", "--poses", poses, "--massless"]);
    let printed = text(output.stdout);
    let mut table = csv::Reader::from_reader(printed.as_bytes());
    let headers = table.headers().unwrap().clone();
    let row = table.records().next().unwrap().unwrap();
    let cell = |name: &str| &row[headers.iter().position(|header| header == name).unwrap()];
    assert!(cell("lowest_cable_frequency_hz").parse::<f64>().unwrap() > 1.0, "{printed}");
    assert!(cell("reason").contains("itself vibrates"), "{}", cell("reason"));
}
