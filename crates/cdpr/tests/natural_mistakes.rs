//! What people type and save without thinking of this program: it is understood, or refused with its cause,
//! its place and what to do.

use crate::common::{answered, cdpr, cdpr_in, data_path, data_text, unwrapped};
use serde_json::{Value, json};
use std::path::Path;
use tempfile::TempDir;

/// A folder with these files.
fn folder(files: &[(&str, &[u8])]) -> TempDir {
    let folder = TempDir::new().unwrap();
    for (name, bytes) in files {
        std::fs::write(folder.path().join(name), bytes).unwrap();
    }
    folder
}

fn utf16(text: &str) -> Vec<u8> {
    [0xff, 0xfe].into_iter().chain(text.encode_utf16().flat_map(u16::to_le_bytes)).collect()
}

/// The message of a command that must be refused, without a number that is too long to be read.
fn refused(folder: &Path, arguments: &[&str]) -> String {
    let output = cdpr_in(folder, arguments);
    let error = unwrapped(output.stderr);
    assert!(matches!(output.status.code(), Some(1 | 2)), "{arguments:?}: {error}");
    assert!(output.stdout.is_empty() && !error.contains("panicked"), "{arguments:?}: {error}");
    let digits = |part: &str| part.chars().filter(char::is_ascii_digit).count();
    let is_number = |c: char| c.is_ascii_digit() || c == '.';
    let longest = error.split(|c| !is_number(c)).map(digits).max();
    assert!(longest <= Some(10), "a long number: {error}");
    assert!(!error.contains("struct ") && !error.contains("18446744073709551615"), "{error}");
    error
}

fn contains(error: &str, words: &[&str]) {
    for words in words {
        assert!(error.contains(words), "`{words}` is not in: {error}");
    }
}

#[test]
fn poses_are_read_as_spreadsheets_and_scripts_save_them() {
    let robot = data_path("robots/cogiro.json");
    let lengths = |bytes: &[u8]| {
        let folder = folder(&[("poses.csv", bytes)]);
        let printed =
            cdpr_in(folder.path(), &["inverse", &robot, "--poses", "poses.csv", "--format", "json"]);
        let lines: Vec<Value> =
            answered(printed).lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        lines.iter().map(|line| line["lengths"].clone()).collect::<Vec<_>>()
    };
    let plain = lengths(b"x_m,y_m,z_m\n0.5,-0.25,2\n0,0.5,2\n");
    for text in [
        "x;y;z\n0.5;-0.25;2\n0;0.5;2\n",
        "x;y;z\n0,5;-0,25;2\n0;0,5;2\n",
        "x\ty\tz\n0.5\t-0.25\t2\n0\t0.5\t2\n",
        "x y z\n0.5 -0.25 2\n  0  0.5  2\n",
        "0.5 -0.25 2\n0 0.5 2\n",
        "0,5;-0,25;2,0\n0,0;0,5;2,0\n",
        "sep=;\nx;y;z\n0.5;-0.25;2\n0;0.5;2\n",
        "X,Y,Z\r\n0.5,-0.25,2\r\n0,0.5,2\r\n",
        "X [mm],Y [mm],Z [m]\n500,-250,2\n0,500,2\n",
        "x_mm,y_mm,z_mm\n500,-250,2000\n0,500,2000\n",
        "t,x_m,y_m,z_m,note\n0,0.5,-0.25,2,start\n0.1,0,0.5,2,\n",
        "# from the tracker\n\"x_m\",\"y_m\",\"z_m\"\n\"0,5\",\"-0,25\",2\n0,\"0,5\",2\n",
    ] {
        assert_eq!(lengths(text.as_bytes()), plain, "{text}");
        assert_eq!(lengths(&utf16(text)), plain, "UTF-16 of {text}");
    }
    let turned = lengths(b"x,y,z,yaw_deg\n0,0,2,45\n");
    let radians = format!("x,y,z,roll_rad,pitch_rad,yaw_rad\n0,0,2,0,0,{}\n", 45f64.to_radians());
    for (one, other) in
        turned[0].as_array().unwrap().iter().zip(lengths(radians.as_bytes())[0].as_array().unwrap())
    {
        assert!((one.as_f64().unwrap() - other.as_f64().unwrap()).abs() < 1e-12);
    }
    assert_eq!(lengths(b"qw;qx;qy;qz;x;y;z\n1;0;0;0;0,5;-0,25;2\n1;0;0;0;0;0,5;2\n"), plain);
}

#[test]
fn lists_that_are_in_doubt_are_refused_with_their_line_and_column() {
    let robot = data_path("robots/cogiro.json");
    for (content, words) in [
        ("x;y;z\n1,250;0;2\n", "line 2, column x: `1,250`: expected 1250 or 1.250: a comma of thousands"),
        ("x,y,z\n0,5,0,2\n", "line 2: 4 cells: expected 3, as many as in line 1; with decimal commas, semi"),
        (
            "x_m,y_m,z_m,roll_rad\n0,0,2,30\n",
            "line 2: roll is 30: expected less than a turn; degrees are called",
        ),
        ("x_m,y_m,z_m,q3\n0,0,2,1\n", "line 1: column q3: expected x_m,y_m,z_m, then none"),
        ("x_m,y_m,z_deg\n0,0,2\n", "line 1: column z_deg: z in a unit of angle: expected x_m,y_m,z_m"),
        ("x_m,x_mm,y,z\n0,0,0,2\n", "line 1: column x_mm: x is there twice"),
        ("x_ft,y_ft,z_ft\n0,0,2\n", "columns x_ft,y_ft,z_ft: x_ft has the unit ft, which is not known"),
        ("x,y,z\n0,0,2\n0,,2\n", "line 3, column y: ``: expected a finite number"),
        ("0,0,2,0,0,90\n", "line 1: 6 numbers: expected x,y,z [m]; angles go apart"),
        ("x,y,z,qw,qx\n0,0,2,1,0\n", "line 1: columns x,y,z,qw,qx: expected"),
    ] {
        let folder = folder(&[("poses.csv", content.as_bytes())]);
        let error = refused(folder.path(), &["inverse", &robot, "--poses", "poses.csv"]);
        contains(&error, &["error: --poses poses.csv, ", words]);
    }
    let wrenches = |content: &str| {
        let folder = folder(&[("w.csv", content.as_bytes())]);
        cdpr_in(
            folder.path(),
            &["capacity", &robot, "--pose", "0,0,2", "--wrench", "w.csv", "--format", "json"],
        )
    };
    let plain = answered(wrenches("fx,fy,fz,mx,my,mz\n10,0,-500,0,0,1\n"));
    assert_eq!(plain, answered(wrenches("10;0;-500;0;0;1\n")));
    assert_eq!(
        plain,
        answered(wrenches("Fz [kN];Fx [N];Fy [N];Mx [N m];My [N m];Mz [kNm]\n-0,5;10;0;0;0;0,001\n"))
    );
    assert!(unwrapped(wrenches("fx,fy\n1,2\n").stderr).contains("columns fx,fy: expected fx_N,fy_N,fz_N"));
}

#[test]
fn numbers_of_an_option_stand_between_commas_semicolons_or_blanks() {
    let robot = data_path("robots/cogiro.json");
    let inverse = |arguments: &[&str]| answered(cdpr(&[&["inverse", &robot], arguments].concat()));
    let plain = inverse(&["--pose", "0,-0.5,2", "--rpy", "0,0,10"]);
    for arguments in [
        &["--pose", "0", "-0.5", "2", "--rpy", "0", "0", "10"][..],
        &["--pose", "0 -0.5 2", "--rpy=0,0,10"],
        &["--pose", "0;-0,5;2", "--rpy", "0;0;10"],
        &["--pose", "0,", "-0.5,", "2", "--rpy", "0, 0, 10"],
        &["--pose=0", "-0.5", "2", "--rpy", "0 0 10"],
    ] {
        assert_eq!(inverse(arguments), plain, "{arguments:?}");
    }
    let here = Path::new(".");
    for (arguments, words) in [
        (&["--pose", "0,0,2,0,0,10"][..], "6 numbers: expected x,y,z [m]; angles go apart, `--rpy 0,0,10`"),
        (&["--pose", "0 0"], "2 numbers: expected x,y,z [m] or x,y,z,qw,qx,qy,qz"),
        (&["--pose", "0,0,2,0,0,0.0871557,0.9961947"], "expected qw,qx,qy,qz, which would be 0.996195,0,0"),
        (
            &["--pose", "0,0,2", "--payload", "1,5"],
            "`1,5` is not a finite number: expected a decimal point, 1.5",
        ),
        (
            &["--pose", "0,0,2", "--payload", "20kg"],
            "`20kg` is not a finite number: expected 20, without a unit",
        ),
        (
            &["--pose", "0,0,2000mm"],
            "`2000mm` is not a finite number: expected a number alone, in the unit that `--help` states",
        ),
        (&["--pose", "0,0,2", "--force", "0,0,-20kg"], "a force is in N, and a mass in kg is `--payload`"),
        (&["--pose", "0,0,2", "--force", "20"], "1 number: expected 3"),
        (&["--pose", "0,0,2", "--mass", "20"], "a mass on the platform is `--payload` [kg]; its own is in"),
    ] {
        contains(&refused(here, &[&["inverse", &robot], arguments].concat()), &[words]);
    }
}

#[test]
fn slips_in_a_robot_file_have_cause_place_and_remedy() {
    let robot = data_text("robots/caroca.json");
    let mut own: Value = serde_json::from_str(&robot).unwrap();
    own["cables"][2]["linear_density"] = json!(0.1);
    let own = format!("{own:#}");
    for (from, to, words) in [
        (
            "\"platform\"",
            "// its platform\n\"platform\"",
            "line 11, column 3: the whole text: a comment, which JSON",
        ),
        (
            "\"mass\": 180.0,",
            "\"mass\": 180.0,,",
            "line 11, column 30: platform: two commas in a row: remove one",
        ),
        ("180.0", "180,5", "platform: 180,5 has a decimal comma: expected a point, 180.5"),
        ("[-3.5, 2, 3.5]", "[-3,5, 2, 3,5]", "-3,5 has a decimal comma: expected a point, -3.5"),
        (
            "\"mass\": 180.0,",
            "\"mass\": 180.0, \"inertia\": [9, 9, 9],",
            "a diagonal matrix is [[a, 0, 0], [0, b, 0]",
        ),
        ("\"max\": 10290.0", "\"max\": \"10 kN\"", "tension_limits.max: invalid type: string"),
    ] {
        assert!(robot.contains(from), "{from}");
        let folder = folder(&[("robot.json", robot.replacen(from, to, 1).as_bytes())]);
        contains(&refused(folder.path(), &["robot", "check", "robot.json"]), &["robot.json: line 1", words]);
    }
    let mut named: Value = serde_json::from_str(&robot).unwrap();
    named["cable"] = json!("steel-4mm");
    let files = [("named.json", format!("{named:#}")), ("own.json", own)];
    let folder = folder(&files.each_ref().map(|(name, text)| (*name, text.as_bytes())));
    contains(
        &refused(folder.path(), &["robot", "check", "named.json"]),
        &["string \"steel-4mm\", expected its properties, {"],
    );
    let error = refused(folder.path(), &["robot", "check", "own.json"]);
    contains(
        &error,
        &["cable 3, cables[2].linear_density", "the properties of one cable are in its `cable`"],
    );
    contains(&refused(folder.path(), &["robot", "check", "."]), &[". is a folder: expected a robot file"]);
    contains(&refused(folder.path(), &["robot", "check", "corgiro"]), &["near are cogiro"]);
    let lengths = ["direct", "cogiro", "--lengths", "4.44,4.54,4.36,4.26"];
    contains(
        &refused(folder.path(), &lengths),
        &["lengths is a list of 4: expected one value for each of the 8"],
    );
}

#[test]
fn a_uniform_law_of_the_template_may_become_normal() {
    let folder = folder(&[]);
    answered(cdpr_in(folder.path(), &["study", "new", "caroca", "--out", "study.json"]));
    let path = folder.path().join("study.json");
    let study = std::fs::read_to_string(&path).unwrap();
    let mut study: Value = serde_json::from_str(&study).unwrap();
    let mut changed = 0;
    for model in study["error_models"].as_object_mut().unwrap().values_mut() {
        for input in model.as_object_mut().unwrap().values_mut() {
            if let Some(half) = input["law"]["uniform"]["max"].as_f64() {
                input["law"] = json!({"normal": {"mean": 0.0, "std": half}});
                changed += 1;
            }
        }
    }
    assert!(changed > 0, "{study}");
    for seed in [json!(-1), json!(1.5), json!(1e20)] {
        let mut other = study.clone();
        other["seed"] = seed;
        std::fs::write(&path, other.to_string()).unwrap();
        contains(
            &refused(folder.path(), &["study", "run", "study.json"]),
            &["seed: invalid ", "expected a whole number, 0 to 1.8e19"],
        );
    }
    let table = data_path("tables/ishigami.csv");
    for seed in ["-1", "1.5"] {
        contains(
            &refused(folder.path(), &["analyse", &table, &format!("--seed={seed}")]),
            &["expected a seed, a whole number, 0 to 1.8e19"],
        );
    }
    std::fs::write(&path, study.to_string()).unwrap();
    let checked =
        cdpr_in(folder.path(), &["study", "run", "study.json", "--observations", "200", "--out", "out"]);
    let said = unwrapped(checked.stderr);
    assert!(checked.status.success(), "{said}");
    contains(
        &refused(folder.path(), &["study", "run", "study.json", "--observations", "2"]),
        &["expected a count, 3 to 1e10"],
    );
}

#[test]
fn no_column_of_a_table_goes_without_a_word() {
    let rows = |line: &dyn Fn(f64) -> String| (0..60).map(|k| line(f64::from(k))).collect::<String>();
    let decimal = |x: f64| format!("{x:.2}").replace('.', ",");
    let wave = |k: f64| (0.7 * k).sin() + 1.5;
    let table = format!("a;b;y\n{}", rows(&|k| format!("{};{};{}\n", decimal(wave(k)), wave(3.1 * k), k)));
    let words = format!("a;b;note\n{}", rows(&|k| format!("{};{};text\n", wave(k), wave(3.1 * k))));
    let thousands =
        format!("a,b,y\n{}", rows(&|k| format!("{},{},\"{},000.5\"\n", wave(k), wave(3.1 * k), k + 1.0)));
    let asked = format!("a;b;y\n{}", rows(&|k| format!("{};{};{},250\n", wave(k), wave(3.1 * k), k + 1.0)));
    let error = format!("a,b,y\n{}5,6,failed\n", rows(&|k| format!("{},{},{k}\n", wave(k), wave(3.1 * k))));
    let files =
        [("t.csv", table), ("n.csv", words), ("k.csv", thousands), ("q.csv", asked), ("e.csv", error)];
    let folder = folder(&files.each_ref().map(|(name, text)| (*name, text.as_bytes())));
    let printed = answered(cdpr_in(folder.path(), &["analyse", "t.csv", "--format", "json"]));
    let found: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!((&found["inputs"], found["rows"].as_u64()), (&json!(["a", "b"]), Some(60)));
    let printed = answered(cdpr_in(folder.path(), &["analyse", "n.csv", "--output", "b", "--input", "a"]));
    assert!(printed.contains("not analysed: note"), "{printed}");
    for (name, words) in [
        ("k.csv", "k.csv: line 2, column y: `1,000.5`: expected a number without marks of thousands"),
        ("q.csv", "q.csv: line 2, column y: `1,250`: expected 1250 or 1.250: a comma of thousands"),
        (
            "e.csv",
            "e.csv: line 62, column y: `failed`: expected a number, as elsewhere in this column, or an empty",
        ),
    ] {
        contains(&refused(folder.path(), &["analyse", name]), &[words]);
    }
    let error = refused(folder.path(), &["analyse", "n.csv", "--output", "note"]);
    contains(&error, &["output is note: expected a column of numbers, one of a, b"]);
    let analyze = answered(cdpr_in(folder.path(), &["analyze", "t.csv"]));
    assert_eq!(analyze, answered(cdpr_in(folder.path(), &["analyse", "t.csv"])));
}

#[test]
fn numbers_in_messages_can_be_read() {
    let here = Path::new(".");
    let [robot, cogiro] = ["robots/caroca.json", "robots/cogiro.json"].map(data_path);
    for (arguments, words) in [
        (
            vec!["inverse", &cogiro, "--pose", "-2.98,-2.1999999999999997,100"],
            "at position (-2.98, -2.2, 100) m",
        ),
        (vec!["direct", &robot, "--lengths", "1e308,4,4,4,4,4,4,4"], "e308"),
        (vec!["inverse", &robot, "--pose", "0,0,4.123456789123456"], "4.12346"),
        (
            vec!["cable", "catenary", "weight=1,stiffness=1000", "--length", "3", "--end", "4,-1"],
            "a tension of 374.738 N",
        ),
    ] {
        contains(&refused(here, &arguments), &[words]);
    }
}

#[test]
fn a_missing_comma_and_lengths_too_short_for_a_pose_are_placed_and_measured() {
    let robot = data_text("robots/cogiro.json");
    let (before, behind) = robot.split_once("\"gravity\": 9.81,").unwrap();
    let text = format!("{before}\"gravity\": 9.81{behind}");
    let line = before.lines().count();
    let folder = folder(&[("robot.json", text.as_bytes())]);
    contains(
        &refused(folder.path(), &["robot", "check", "robot.json"]),
        &[&format!("line {line}, column 18: the whole text: a comma is missing here")],
    );
    // The cables need 9.2 to 9.8 m for this pose.
    let robot = data_path("robots/cogiro.json");
    for (pose, lengths, words) in [
        (
            "0,0,2",
            "9.7,5,9.4,9.5,9.8,9.2,9.5,9.6",
            "length 2 is 5 m: at position (0, 0, 2) m the points of cable 2 are 9.183 m apart, 4.183 m more",
        ),
        ("0,0,2", "5,5,5,5,5,5,5,5", "; 8 of 8 cables are too short"),
    ] {
        let error = refused(folder.path(), &["direct", &robot, "--lengths", lengths, "--pose", pose]);
        contains(&error, &[words, "meant? the lengths that the inverse model has for this pose, in m"]);
    }
    // A start that is far from where the lengths hold the platform is no fault.
    let lengths = "9.738847,9.179206,9.421124,9.469644,9.764403,9.192981,9.496613,9.557590";
    let found = cdpr(&["direct", &robot, "--lengths", lengths, "--pose", "2,1.5,3"]);
    assert!(found.status.success(), "{}", unwrapped(found.stderr));
}
