//! Tensions that are preferred, limited by cable or at the exit point, and named, as a user meets them.

use crate::common::{Bench, answered, cdpr, cdpr_in, data, data_path, json_file, text, unwrapped};
use serde_json::{Value, json};
use tempfile::TempDir;

/// A robot, a pose that it holds, and a tension above those of least norm.
const ROBOTS: [(&str, &str, &str); 5] = [
    ("robots/caroca.json", "0.6,-0.4,1.4", "900"),
    ("robots/caroca-law.json", "0.6,-0.4,1.4", "900"),
    ("robots/cogiro.json", "0.5,1,2", "1200"),
    ("reference/robots/ipanema.json", "0.3,0.2,1.5", "600"),
    ("reference/robots/stadium.json", "-8,-4,10", "1500"),
];

/// Commands about a pose, with a load where they need one.
const AT_POSE: [&[&str]; 4] =
    [&["inverse"], &["deflection", "--payload", "5"], &["stiffness"], &["derivatives", "--payload", "5"]];

/// A folder with a robot file `robot.json` as `change` makes it.
fn robot(file: &str, change: impl FnOnce(&mut Value)) -> TempDir {
    let folder = TempDir::new().unwrap();
    let mut robot = json_file(data(file));
    change(&mut robot);
    std::fs::write(folder.path().join("robot.json"), robot.to_string()).unwrap();
    folder
}

/// Exit code and standard output of a command about the robot of a folder.
fn ended(folder: &TempDir, arguments: &[&str]) -> (i32, String) {
    let output = cdpr_in(folder.path(), &[&arguments[..1], &["robot.json"], &arguments[1..]].concat());
    let message = unwrapped(output.stderr);
    assert!(!message.contains("panicked"), "{message}");
    (output.status.code().unwrap(), text(output.stdout))
}

fn numbers(list: &Value) -> Vec<f64> {
    list.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

#[test]
fn an_option_and_the_robot_file_prefer_the_same_tensions_on_every_command_at_a_pose() {
    for (file, pose, tension) in ROBOTS {
        let n = json_file(data(file))["cables"].as_array().unwrap().len();
        let each = vec![tension; n].join(",");
        for command in AT_POSE {
            let answer = |folder: &TempDir, option: &[&str]| {
                let at = [&["--pose", pose, "--format", "json"][..], option].concat();
                let (code, printed) = ended(folder, &[command, &at].concat());
                assert_eq!(code, 0, "{command:?} {option:?}: {printed}");
                printed
            };
            let plain = robot(file, |_| ());
            let least_norm = answer(&plain, &[]);
            let preferring = |reference: Value| robot(file, |robot| robot["tension_reference"] = reference);
            let number = json(tension);
            let all = answer(&preferring(number.clone()), &[]);
            assert_ne!(all, least_norm, "{file} {command:?}");
            assert_eq!(all, answer(&plain, &["--tension-reference", tension]), "{file} {command:?}");
            assert_eq!(all, answer(&plain, &["--tension-reference", &each]), "{file} {command:?}");
            assert_eq!(all, answer(&preferring(json!(vec![number; n])), &[]), "{file} {command:?}");
            let middle = answer(&preferring(json!("mid")), &[]);
            assert_eq!(middle, answer(&plain, &["--tension-reference", "mid"]), "{file} {command:?}");
            assert_ne!(middle, all, "{file} {command:?}");
            // The option takes the place of the file's.
            assert_eq!(all, answer(&preferring(json!("mid")), &["--tension-reference", tension]));
            assert_eq!(least_norm, answer(&preferring(json!("mid")), &["--tension-reference", "0"]));
        }
    }
}

/// A limit of tolerances, and the number of observations that follows.
const LIMIT: [&str; 5] = ["--sampling", "mechanical", "--limit", "deflection_mm<1.4", "--observations"];

#[test]
fn every_other_command_with_the_inverse_model_takes_preferred_tensions_and_refuses_wrong_ones() {
    let folder = TempDir::new().unwrap();
    let study = data_path("studies/caroca.json");
    let robot = data_path("robots/caroca.json");
    let law = data_path("robots/caroca-law.json");
    let commands: [&[&str]; 4] = [
        &["hysteresis", &law, "--pose", "0,0,1.75", "--payload", "50"],
        &["workspace", &robot, "--region=-1:1:2,0:0:1,1.5:1.5:1", "--payload", "50", "--overwrite"],
        &[
            "calibrate",
            "identify",
            &robot,
            "--region=-1:1:2,0:0:1,1.5:1.5:1",
            "--uncertainty",
            "youngs_modulus=5e9,mass=1",
            "--noise",
            "tensions=1",
        ],
        &[&["study", "tolerances", &study][..], &LIMIT, &["200"]].concat(),
    ];
    let words = |output: &str| {
        // Times differ from run to run.
        let line = |line: &&str| !line.contains(" poses in ");
        let magnitude = output.split("magnitude_mm").nth(1).unwrap_or_default().to_owned();
        output.lines().filter(line).collect::<String>() + &magnitude
    };
    for command in commands {
        let answer = |option: &[&str]| {
            let output = cdpr_in(folder.path(), &[command, option].concat());
            assert!(output.status.success(), "{command:?}: {}", unwrapped(output.stderr));
            words(&text(output.stdout))
        };
        let least_norm = answer(&[]);
        assert_eq!(least_norm, answer(&["--tension-reference", "0"]), "{command:?}");
        assert_ne!(least_norm, answer(&["--tension-reference", "900"]), "{command:?}");
    }
    let others: [&[&str]; 2] = [&["robot", "check", &robot], &["study", "run", &study]];
    for command in commands.iter().chain(&others) {
        for (reference, wrong) in [
            (
                "1,2",
                "tension_reference is a list of 2: expected one tension, or one for each of the 8 cables",
            ),
            ("-5", "tension_reference is -5: expected a finite tension, zero or more [N]"),
            ("middle", "expected a tension [N], one for each cable with commas between, or mid"),
        ] {
            let output = cdpr_in(folder.path(), &[command, &["--tension-reference", reference][..]].concat());
            let message = unwrapped(output.stderr);
            assert!(output.status.code() == Some(2) && message.contains(wrong), "{command:?}: {message}");
        }
    }
}

#[test]
fn a_study_file_an_option_and_a_robot_file_prefer_the_same_tensions() {
    let bench = || {
        Bench::new("caroca.json", |study| {
            study["samplings"].as_object_mut().unwrap().retain(|name, _| name == "mechanical");
            study["samplings"]["mechanical"]["observations"] = json!(20);
            study["replicates"] = json!(0);
            study["surfaces"] = json!({});
        })
    };
    let plain = bench();
    plain.run("least", &[]);
    plain.run("option", &["--tension-reference", "900"]);
    let in_study = bench();
    in_study.change("study.json", |study| study["tension_reference"] = json!(900));
    in_study.run("out", &[]);
    let in_robot = bench();
    in_robot.change("robot.json", |robot| robot["tension_reference"] = json!(900));
    in_robot.run("out", &[]);
    let found = |bench: &Bench, out: &str| {
        let summary = bench.json(&format!("{out}/summary.json"));
        summary["studies"]["mechanical"].clone()
    };
    let option = found(&plain, "option");
    assert_ne!(option["nominal"], found(&plain, "least")["nominal"]);
    assert_eq!(option, found(&in_study, "out"));
    assert_eq!(option, found(&in_robot, "out"));
    let nominal = |tension: &str| {
        let command = ["deflection", "--payload", "50", "--pose", "0,0,1.75", "--format", "json"];
        let robot = data_path("robots/caroca.json");
        let at = [&command[..1], &[&robot], &command[1..]].concat();
        let answer = answered(cdpr(&[&at[..], &["--tension-reference", tension]].concat()));
        json(&answer)["loaded"]["tensions"].clone()
    };
    assert_eq!(option["nominal"]["loaded_tensions"], nominal("900"));
    // What was run is in the folder, and goes on as it was.
    assert_eq!(plain.json("option/study.json")["tension_reference"], json!(900.0));
    plain.done(&["extend", "option", "--observations", "40"]);
    assert!(plain.refused(&["run", "study.json", "--out", "option", "--resume"]).contains("option"));
    in_study.change("study.json", |study| study["tension_reference"] = json!([900, 900]));
    let message = in_study.refused(&["run", "study.json", "--out", "other"]);
    assert!(message.contains("study.json: tension_reference is a list of 2: expected one"), "{message}");
    assert!(message.contains("line "), "{message}");
}

#[test]
fn the_tension_at_the_exit_point_is_printed_as_text_json_and_csv() {
    for (file, pose, _) in ROBOTS {
        let folder = robot(file, |_| ());
        std::fs::write(folder.path().join("poses.csv"), format!("{pose}\n")).unwrap();
        let (_, inverse) = ended(&folder, &["inverse", "--pose", pose, "--format", "json"]);
        let inverse = json(&inverse);
        let (lengths, exits) = (numbers(&inverse["lengths"]), numbers(&inverse["exit_tensions"]));
        let robot = json_file(data(file));
        let weight = robot["cable"]["linear_density"].as_f64().unwrap() * robot["gravity"].as_f64().unwrap();
        for (i, length) in lengths.iter().enumerate() {
            let [fx, fz] = [0, 1].map(|k| inverse["cable_forces"][i][k].as_f64().unwrap());
            let exit = fx.hypot(fz - weight * length);
            assert!((exits[i] - exit).abs() < 1e-9 * exit, "{file}: {} N, not {exit} N", exits[i]);
        }
        let words = format!("{:.3}", exits[0]);
        let (_, printed) = ended(&folder, &["inverse", "--pose", pose]);
        assert!(printed.contains("at exit point [N]") && printed.contains(&words), "{printed}");
        let list: Vec<_> = lengths.iter().map(ToString::to_string).collect();
        let start = ["--lengths", &list.join(","), "--pose", pose];
        let (_, direct) = ended(&folder, &[&["direct", "--format", "json"][..], &start].concat());
        let near = |found: &Value| (numbers(found)[0] - exits[0]).abs() < 1e-6 * exits[0];
        assert!(near(&json(&direct)["exit_tensions"]), "{file}");
        let (_, printed) = ended(&folder, &[&["direct"][..], &start].concat());
        assert!(printed.contains("at exit point [N]"), "{printed}");
        let deflection = ["deflection", "--payload", "5"];
        let (_, found) = ended(&folder, &[&deflection[..], &["--pose", pose, "--format", "json"]].concat());
        assert!(near(&json(&found)["unloaded"]["exit_tensions"]), "{file}");
        let column = |command: &[&str], name: &str| {
            let (code, table) = ended(&folder, &[command, &["--poses", "poses.csv"]].concat());
            assert_eq!(code, 0, "{table}");
            let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
            let place = lines.next().unwrap().iter().position(|column| *column == name).unwrap();
            lines.next().unwrap()[place].parse::<f64>().unwrap()
        };
        assert_eq!(column(&["inverse"], "exit_tension_1_n"), exits[0]);
        let loaded = numbers(&json(&found)["loaded"]["exit_tensions"])[0];
        assert_eq!(column(&deflection, "loaded_exit_tension_1_n"), loaded);
    }
}

/// The limit of one cable is below its tension with the load, and its breaking force below that.
#[test]
fn a_tension_that_is_too_much_in_any_answer_is_named_and_ends_with_code_3() {
    for (file, pose, _) in ROBOTS {
        let plain = robot(file, |_| ());
        let mass = json_file(data(file))["platform"]["mass"].as_f64().unwrap();
        let payload = format!("{}", 0.2 * mass);
        let load = ["--payload", &payload, "--pose", pose];
        let (_, found) = ended(&plain, &[&["deflection", "--format", "json"][..], &load].concat());
        let found = json(&found);
        let [before, after] = ["unloaded", "loaded"].map(|at| numbers(&found[at]["tensions"]));
        let i = (0..after.len()).max_by(|a, b| {
            let grown = |i: usize| after[i] / before[i];
            grown(*a).total_cmp(&grown(*b))
        });
        let i = i.unwrap();
        let limit = 0.5 * (before[i] + after[i]);
        let name = format!("cable {}: its tension of", i + 1);
        let limited = robot(file, |robot| robot["cables"][i]["tension_limits"] = json!({"max": limit}));
        let broken = robot(file, |robot| {
            let cable = robot["cable"].clone();
            robot["cables"].as_array_mut().unwrap().iter_mut().for_each(|one| one["cable"] = cable.clone());
            robot["cables"][i]["cable"]["breaking_force"] = json!(limit);
        });
        for (folder, words) in [(&limited, "above tension_limits.max"), (&broken, "above its breaking force")]
        {
            std::fs::write(folder.path().join("poses.csv"), format!("{pose}\n")).unwrap();
            for command in [&["deflection"][..], &["derivatives"]] {
                let (code, printed) = ended(folder, &[command, &load].concat());
                assert!(code == 3 && printed.contains(&name) && printed.contains(words), "{file}: {printed}");
                let (code, found) = ended(folder, &[command, &load, &["--format", "json"]].concat());
                assert!(code == 3 && found.contains("out_of_limits"), "{file}: {found}");
                let many = [command, &load[..2], &["--poses", "poses.csv"]].concat();
                let (code, table) = ended(folder, &many);
                assert!(code == 3 && table.contains(&name) && table.contains("held"), "{file}: {table}");
            }
            let around: Vec<_> = pose.split(',').map(|at| format!("{at}:{at}:1")).collect();
            let grid = format!("--region={}", around.join(","));
            let (code, printed) =
                ended(folder, &["workspace", "--payload", &payload, &grid, "--out", "map", "--overwrite"]);
            let words = "At 1 position tensions are above tension_limits.max or a breaking force.";
            assert!(code == 3 && printed.contains(words), "{file}: {printed}");
            let table = std::fs::read_to_string(folder.path().join("map/workspace.csv")).unwrap();
            assert!(table.contains(&name) && table.contains("beyond_limits"), "{table}");
        }
        // The inverse model keeps limits of tensions, and not breaking forces.
        let (_, found) = ended(&plain, &[&["inverse", "--format", "json"][..], &load].concat());
        let most = numbers(&json(&found)["tensions"]).into_iter().fold(0.0, f64::max);
        let broken = robot(file, |robot| robot["cable"]["breaking_force"] = json!(0.999 * most));
        for command in ["inverse", "stiffness"] {
            let (code, printed) = ended(&broken, &[&[command][..], &load].concat());
            let is_named = printed.replace('\n', " ").contains("above its breaking force");
            assert!(code == 3 && is_named, "{file}: {printed}");
        }
    }
    let limited = robot("robots/caroca-law.json", |robot| robot["tension_limits"]["max"] = json!(700));
    let (code, printed) = ended(&limited, &["hysteresis", "--pose", "0,0,1.75", "--payload", "50"]);
    assert!(code == 3 && printed.contains("N is above tension_limits.max, 700 N"), "{printed}");
    // A cable below its least tension answers the question.
    let slack =
        robot("robots/caroca.json", |robot| robot["cables"][0]["tension_limits"] = json!({"min": 400}));
    let load = ["--pose", "0,0,1.75", "--force", "0,0,1000"];
    let (code, printed) = ended(&slack, &[&["deflection"][..], &load].concat());
    assert!(code == 0 && printed.contains("N is below tension_limits.min, 400 N"), "{printed}");
}

#[test]
fn a_telescope_is_held_where_its_towers_bear_it() {
    let inverse = |limits: Value| {
        let folder = robot("reference/robots/fast.json", |robot| robot["tension_limits"] = limits);
        ended(&folder, &["inverse", "--pose", "0,0,140"])
    };
    let (code, printed) = inverse(json!({"min": 20e3, "max": 150e3}));
    assert_eq!(code, 0, "{printed}");
    let printed = printed.replace('\n', " ");
    let words = "N at the exit point is above tension_limits.max, 150000 N, of its other end";
    assert!(printed.contains("141186.8") && printed.contains(words), "{printed}");
    let (code, printed) = inverse(json!({"min": 20e3, "max": 150e3, "max_at": "exit"}));
    assert_eq!((code, printed.as_str()), (1, ""));
    let (code, printed) = inverse(json!({"min": 20e3, "max": 154e3, "max_at": "exit"}));
    assert!(code == 0 && !printed.contains("above"), "{printed}");
    let (code, _) = inverse(json!({"min": 20e3, "max": 154e3, "max_at": "tower"}));
    assert_eq!(code, 1);
}

#[test]
fn all_parts_of_a_study_name_a_nominal_robot_that_bears_too_much() {
    let bench = Bench::new("caroca.json", |study| {
        study["samplings"].as_object_mut().unwrap().retain(|name, _| name == "mechanical");
        study["samplings"]["mechanical"]["observations"] = json!(20);
        let mut many = study["samplings"]["mechanical"].clone();
        many.as_object_mut().unwrap().remove("pose");
        many["poses"] = json!({"list": [{"position": [0, 0, 1.75]}, {"position": [0.2, 0, 1.75]}]});
        study["samplings"]["many"] = many;
        for (_, surface) in study["surfaces"].as_object_mut().unwrap() {
            (surface["x"]["points"], surface["y"]["points"]) = (json!(2), json!(2));
        }
        study["replicates"] = json!(0);
    });
    bench.change("robot.json", |robot| robot["cable"]["breaking_force"] = json!(730.0));
    let output = bench.study(&["run", "study.json", "--out", "out"]);
    let message = unwrapped(output.stderr);
    assert_eq!(output.status.code(), Some(3), "{message}");
    let warned = |words: &str| assert!(message.contains(words), "{words}: {message}");
    warned("warning: mechanical, nominal robot with the payload: cables 3, 6: tension up to");
    warned("warning: many, nominal robot at 2 of 2 poses: tensions above tension_limits.max or a breaking");
    let surfaces = bench.json("out/study.json")["surfaces"].as_object().unwrap().len();
    let named = message.lines().filter(|line| line.contains("with the payload: cables 3, 6: ")).count();
    assert_eq!(named, 1 + surfaces, "{message}");
    let table = std::fs::read_to_string(bench.path("out/many.csv")).unwrap();
    assert!(table.contains("with the payload: cables 3, 6: tension up to"), "{table}");
}

#[test]
fn the_inverse_model_says_whether_the_platform_stays_with_its_lengths() {
    let of = |command: &str| -> Value {
        let given = [command, "caroca", "--pose", "0,0,1.75", "--format", "json"];
        serde_json::from_str(&answered(cdpr(&given))).unwrap()
    };
    let (stable, stiffness) = (of("inverse"), of("stiffness"));
    assert_eq!(stable["stable"], true);
    let [found, exact] = [stable, stiffness].map(|of| of["least_stiffness_n_per_m"].as_f64().unwrap());
    assert!((found / exact - 1.0).abs() < 1e-9, "{found} {exact}");
    let printed = answered(cdpr(&["inverse", "caroca", "--pose", "0,0,1.75"]));
    assert!(printed.lines().next().unwrap().ends_with(" N hold it, stable."), "{printed}");

    // A centre of mass far above cables that hang.
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("top-heavy.json");
    let mut robot: Value =
        serde_json::from_str(&std::fs::read_to_string(data("robots/cogiro.json")).unwrap()).unwrap();
    robot["platform"]["center_of_mass"][2] = 4e4.into();
    std::fs::write(&path, robot.to_string()).unwrap();
    let given = ["inverse", path.to_str().unwrap(), "--pose", "0,0,2", "--format", "json"];
    let unstable: Value = serde_json::from_slice(&cdpr(&given).stdout).unwrap();
    assert_eq!(unstable["stable"], false);
    assert!(unstable["least_stiffness_n_per_m"].as_f64().unwrap() < 0.0);
}

#[test]
fn an_option_and_the_robot_file_choose_the_same_least_norm() {
    let at = ["--pose", "0.5,1,2", "--format", "json"];
    let tensions = |folder: &TempDir, option: &[&str]| {
        let (code, printed) = ended(folder, &[&["inverse"], &at[..], option].concat());
        assert_eq!(code, 0, "{option:?}: {printed}");
        numbers(&json(&printed)["tensions"])
    };
    let plain = robot("robots/cogiro.json", |_| ());
    let least_norm = tensions(&plain, &[]);
    let sum = |tensions: &[f64]| tensions.iter().sum::<f64>();
    let greatest = |tensions: &[f64]| tensions.iter().copied().fold(0.0, f64::max);
    for (name, norm) in [("least_1_norm", &sum as &dyn Fn(&[f64]) -> f64), ("least_infinity_norm", &greatest)]
    {
        let by_option = tensions(&plain, &["--distribution", name]);
        assert!(norm(&by_option) < norm(&least_norm), "{name}");
        let chosen = robot("robots/cogiro.json", |robot| robot["distribution"] = json!(name));
        assert_eq!(tensions(&chosen, &[]), by_option);
        // The options take the place of the file's.
        assert_eq!(tensions(&chosen, &["--distribution", "least_2_norm"]), least_norm);
        assert_eq!(tensions(&chosen, &["--tension-reference", "0"]), least_norm);
    }
}

#[test]
fn a_norm_that_jumps_is_refused_where_tensions_have_to_change_smoothly() {
    let folder = TempDir::new().unwrap();
    let (robot, study) = (data_path("robots/caroca.json"), data_path("studies/caroca.json"));
    let expected = "distribution is least_1_norm: expected nearest or least_2_norm";
    for command in [
        &["derivatives", &robot, "--pose", "0,0,1.75", "--payload", "5"][..],
        &[&["study", "tolerances", &study][..], &LIMIT, &["20"]].concat(),
    ] {
        let output = cdpr_in(folder.path(), &[command, &["--distribution", "least_1_norm"]].concat());
        let message = unwrapped(output.stderr);
        assert!(!output.status.success() && message.contains(expected), "{command:?}: {message}");
    }
    let both = ["--distribution", "least_1_norm", "--tension-reference", "900"];
    let output = cdpr_in(folder.path(), &[&["inverse", &robot, "--pose", "0,0,1.75"], &both[..]].concat());
    let message = unwrapped(output.stderr);
    assert!(message.contains("distribution is least_1_norm: expected nearest, as there is"), "{message}");
}
