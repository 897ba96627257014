//! Careless users and strangers' files: what they hold is shown and not obeyed, and nothing hangs or panics.

use crate::common::{Bench, answered, data_path, text, unwrapped};
use serde_json::json;
use std::fs::File;
use std::process::Command;

fn cdpr() -> Command {
    Command::new(env!("CARGO_BIN_EXE_cdpr"))
}

#[test]
fn a_name_neither_moves_the_cursor_nor_adds_a_line_and_json_keeps_it() {
    let bench = Bench::new("caroca.json", |_| ());
    // Longer names are shortened.
    let name = "\u{1b}\u{202e}X\nY";
    bench.change("robot.json", |robot| robot["name"] = json!(name));
    let robot = bench.path("robot.json");
    let inverse = |format: &str| {
        let arguments = ["--pose", "0,0,1.75", "--format", format];
        answered(cdpr().arg("inverse").arg(&robot).args(arguments).output().unwrap())
    };
    let table = inverse("text");
    assert!(table.starts_with("\\u001b\\u202eX\\u000aY at (0, 0, 1.75) m: "), "{table}");
    bench.change("study.json", |study| {
        study["samplings"] = json!({});
        study["surfaces"].as_object_mut().unwrap().values_mut().for_each(|surface| {
            surface["x"]["points"] = json!(3);
            surface["y"]["points"] = json!(3);
        });
    });
    let json = bench.run("out", &["--format", "json"]);
    assert!(json.is_ascii() || !json.contains('\u{202e}'), "{json}");
    assert_eq!(serde_json::from_str::<serde_json::Value>(&json).unwrap()["robot"], json!(name));
}

#[cfg(unix)]
#[test]
fn a_pipe_that_nobody_writes_into_is_refused_at_once() {
    let bench = Bench::new("caroca.json", |_| ());
    let pipe = bench.path("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let robot = data_path("robots/caroca.json");
    for arguments in [
        &["robot", "check", "pipe"][..],
        &["study", "run", "pipe"],
        &["direct", &robot, "--from", "pipe"],
        &[
            "cable",
            "modulus",
            "pipe",
            "--breaking-force",
            "1e4",
            "--section",
            "1e-5",
            "--length",
            "1",
            "--range",
            "5-10",
        ],
        &["hysteresis", &robot, "--law", "pipe", "--pose", "0,0,1.75", "--payload", "50"],
        &[
            "calibrate",
            "identify",
            &robot,
            "--poses",
            "pipe",
            "--uncertainty",
            "a=0.002",
            "--noise",
            "length=0.001",
        ],
    ] {
        let output = bench.command(env!("CARGO_BIN_EXE_cdpr")).args(arguments).output().unwrap();
        let error = unwrapped(output.stderr);
        assert_eq!(output.status.code(), Some(1), "{error}");
        assert!(error.contains("pipe is a pipe without content: expected a"), "{error}");
    }
}

/// A study of 50 observations and nothing else.
#[cfg(unix)]
fn bench_of_one_sampling() -> Bench {
    Bench::new("caroca.json", |study| {
        study["samplings"].as_object_mut().unwrap().retain(|name, _| name == "mechanical");
        study["samplings"]["mechanical"]["observations"] = json!(50);
        study["replicates"] = json!(0);
        study["surfaces"] = json!({});
    })
}

#[cfg(unix)]
#[test]
fn links_in_a_circle_among_the_blocks_are_not_followed() {
    let bench = bench_of_one_sampling();
    bench.run("out", &[]);
    for name in ["a", "b"] {
        std::os::unix::fs::symlink(bench.path("out/blocks"), bench.path("out/blocks").join(name)).unwrap();
    }
    let refused = bench.refused(&["run", "study.json", "--out", "out"]);
    assert!(refused.contains("contains 1 block of this study"), "{refused}");
    bench.run("out", &["--resume"]);
}

#[cfg(unix)]
#[test]
fn paths_that_are_not_utf_8_cause_no_panic() {
    use std::os::unix::ffi::OsStrExt;
    let bench = bench_of_one_sampling();
    let out = std::ffi::OsStr::from_bytes(b"out\xff");
    let run = |arguments: &[&str]| {
        let mut command = bench.study_command(arguments);
        text(command.arg("--out").arg(out).args(["--format", "json"]).output().unwrap().stdout)
    };
    assert!(run(&["run", "study.json", "--shard", "1/1"]).contains("out\u{fffd}"));
    assert!(run(&["run", "study.json", "--resume"]).contains("mechanical"));
    let block = bench.path("").join(out).join("blocks/mechanical/sampling/000000.block");
    std::fs::write(block, "damaged").unwrap();
    let status = bench.study_command(&["status", "--format", "json"]).arg(out).output().unwrap();
    assert!(text(status.stdout).contains("out\u{fffd}/blocks"));
}

#[cfg(target_os = "linux")]
#[test]
fn help_that_cannot_be_printed_is_a_failure() {
    for arguments in [&["--help"][..], &["--version"], &["study", "run", "--help"], &["help", "inverse"]] {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = cdpr().args(arguments).stdout(full).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(unwrapped(output.stderr).contains("cannot write to the standard output"));
    }
}

#[test]
fn what_no_machine_could_hold_is_refused_before_the_work_with_what_is_possible() {
    let refused = |change: &dyn Fn(&mut serde_json::Value), words: &str| {
        let bench = Bench::new("caroca.json", change);
        let message = bench.refused(&["run", "study.json"]);
        assert!(message.contains(words), "{message}");
        assert!(!bench.path("results").exists());
    };
    refused(
        &|study| {
            let surface = &mut study["surfaces"]["surface_E_rho"];
            (surface["x"]["points"], surface["y"]["points"]) = (json!(10_000), json!(10_000));
        },
        "surfaces.surface_E_rho is 10000 x 10000 points: expected at most 1000000 points, such as 1000 x 1000",
    );
    refused(
        &|study| study["confidence"] = json!(0.999_999_999_999_999_9),
        "confidence is 0.9999999999999999: expected a number above 0, at most 0.999999",
    );
    refused(
        &|study| {
            let sampling = study["samplings"]["mechanical"].clone();
            study["samplings"]["x".repeat(255)] = sampling;
        },
        "samplings is 255 characters: expected at most 200 characters: they name files",
    );
    refused(
        &|study| {
            study["replicates"] = json!(10_000);
            study["samplings"]["mechanical"]["observations"] = json!(1_000_000_000);
        },
        "samplings.mechanical.observations is 10001000000256: expected at most 10000000000",
    );
    let bench = Bench::new("caroca-sensitivity.json", |study| {
        study["sensitivity"]["observations"] = json!(1 << 16);
        study["samplings"]["mechanical"]["error_model"] = json!("table_3");
    });
    bench.change("robot.json", |robot| {
        let cable = |k: u32| {
            let angle = 0.1 * f64::from(k);
            json!({"exit_point": [4.0 * angle.cos(), 4.0 * angle.sin(), 3.0 + 0.001 * f64::from(k)],
                "anchor_point": [0.2 * angle.sin(), 0.2 * angle.cos(), 0.1]})
        };
        robot["cables"] = (0..201).map(cable).collect();
    });
    let message = bench.refused(&["run", "study.json"]);
    assert!(message.contains("cables is a list of 201: expected at most 200 cables"), "{message}");
    let message = bench.misused(&["run", "study.json", "--threads", "65535"]);
    assert!(message.contains("65535 is not in 1..=1024"), "{message}");
}

#[test]
fn a_tension_that_no_cable_bears_is_printed_and_ends_with_code_3_and_a_slack_one_with_0() {
    let bench = Bench::new("caroca.json", |_| ());
    let ended = |load: &[&str], code: i32, words: &str| {
        let mut command = cdpr();
        command.arg("deflection").arg(bench.path("robot.json")).args(["--pose", "0,0,1.75"]).args(load);
        let output = command.output().unwrap();
        let printed = text(output.stdout);
        assert_eq!(output.status.code(), Some(code), "{printed}");
        assert!(printed.contains("dp = (") && printed.contains(words), "{printed}");
        let json: serde_json::Value =
            serde_json::from_slice(&command.args(["--format", "json"]).output().unwrap().stdout).unwrap();
        assert_eq!(json["loaded"]["out_of_limits"].is_array(), !words.is_empty());
    };
    ended(&["--payload", "50"], 0, "");
    bench.change("robot.json", |robot| robot["tension_limits"]["max"] = json!(700.0));
    ended(&["--payload", "50"], 3, "N is above tension_limits.max, 700 N\n");
    bench.change("robot.json", |robot| robot["cable"]["breaking_force"] = json!(730.0));
    ended(&["--payload", "50"], 3, "N is above its breaking force, 730 N\n");
    bench.change("robot.json", |robot| robot["tension_limits"]["min"] = json!(400.0));
    ended(&["--force", "0,0,1000"], 0, "N is below tension_limits.min, 400 N\n");
}

#[test]
fn a_study_without_a_result_or_with_a_nominal_robot_that_breaks_ends_with_code_3() {
    let few = |change: &dyn Fn(&mut serde_json::Value)| {
        Bench::new("caroca.json", |study| {
            study["samplings"].as_object_mut().unwrap().retain(|name, _| name == "mechanical");
            study["samplings"]["mechanical"]["observations"] = json!(20);
            study["replicates"] = json!(0);
            study["surfaces"] = json!({});
            change(study);
        })
    };
    let ended = |bench: &Bench, code: i32, words: &str| {
        let output = bench.study(&["run", "study.json", "--out", "out"]);
        let message = unwrapped(output.stderr);
        assert_eq!(output.status.code(), Some(code), "{message}");
        assert!(message.contains(words), "{message}");
        assert!(bench.path("out/summary.json").exists() && bench.path("out/report.html").exists());
    };
    ended(&few(&|_| ()), 0, "");
    let heavy = json!({"law": {"uniform": {"min": 1e6, "max": 2e6}}});
    let bench = few(&|study| study["error_models"]["table_3"]["mass"] = heavy.clone());
    ended(&bench, 3, "question: mechanical is the result of 0 observations: 20 of 20 failed (100 %)");
    let bench = few(&|_| ());
    bench.change("robot.json", |robot| robot["cable"]["breaking_force"] = json!(730.0));
    ended(&bench, 3, "warning: mechanical, nominal robot with the payload: cables 3, 6: tension up to");
}

#[cfg(unix)]
#[test]
fn the_end_of_a_job_says_how_to_go_on() {
    let bench = Bench::new("caroca.json", |study| {
        study["samplings"].as_object_mut().unwrap().retain(|name, _| name == "mechanical");
        study["samplings"]["mechanical"]["observations"] = json!(10_000_000);
        study["surfaces"] = json!({});
    });
    let mut command = bench.study_command(&["run", "study.json", "--out", "out"]);
    let mut child =
        command.stdout(std::process::Stdio::null()).stderr(std::process::Stdio::piped()).spawn().unwrap();
    while !bench.path("out/blocks/mechanical/sampling/000000.block").exists() {
        assert!(child.try_wait().unwrap().is_none());
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    assert!(Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    let message = unwrapped(output.stderr);
    assert_eq!(output.status.code(), Some(130), "{message}");
    assert!(message.contains("go on with: cdpr study run out/study.json --out out --resume"), "{message}");
}

#[test]
fn a_deflection_below_rounding_is_zero_with_its_bound_and_has_no_law() {
    let bench = Bench::new("caroca.json", |study| {
        study["samplings"].as_object_mut().unwrap().retain(|name, _| name == "mechanical");
        study["samplings"]["mechanical"]["observations"] = json!(100);
        study["replicates"] = json!(2);
        study["surfaces"] = json!({});
        study["payload"] = json!(1e-300);
    });
    bench.run("out", &[]);
    let found = &bench.json("out/summary.json")["studies"]["mechanical"];
    assert_eq!((&found["magnitude_mm"]["mean"], &found["magnitude_mm"]["max"]), (&json!(0.0), &json!(0.0)));
    assert_eq!((&found["best_fit"], &found["fits"]), (&json!(null), &json!([])));
    assert!(found["notes"][0].as_str().unwrap().contains("zero within this bound"));
    // A gram is far above it.
    bench.change("study.json", |study| study["payload"] = json!(1e-3));
    bench.run("gram", &[]);
    assert!(
        bench.json("gram/summary.json")["studies"]["mechanical"]["magnitude_mm"]["mean"].as_f64().unwrap()
            > 1e-6
    );

    let dp = |payload: &str| {
        let arguments = ["--pose", "0,0,1.75", "--format", "json", "--payload", payload];
        let output = cdpr().arg("deflection").arg(bench.path("robot.json")).args(arguments).output().unwrap();
        serde_json::from_str::<serde_json::Value>(&answered(output)).unwrap()
    };
    let (none, gram) = (dp("1e-300"), dp("1e-3"));
    let bound = none["rounding_mm"].as_f64().unwrap();
    assert!(none["magnitude_mm"] == json!(0.0) && bound > 0.0 && bound < 1e-7, "{bound}");
    assert!(gram["magnitude_mm"].as_f64().unwrap() > 10.0 * bound);
}

#[test]
fn files_of_other_programs_are_imported_questioned_or_refused_at_once() {
    let bench = Bench::new("caroca.json", |_| ());
    let import = |files: &[&str], options: &[&str]| {
        let arguments = files.iter().chain(options).copied();
        let output = bench
            .command(env!("CARGO_BIN_EXE_cdpr"))
            .args(["robot", "import"])
            .args(arguments)
            .output()
            .unwrap();
        (output.status.code().unwrap(), text(output.stdout), unwrapped(output.stderr))
    };
    let cable = ["--cable", "steel-4mm"];
    let nested = data_path("reference/exchange/nested-model.yaml");
    let (code, robot, _) = import(&[&nested], &cable);
    assert_eq!((code, robot.contains("\"max\": 900")), (0, true), "{robot}");
    // The answer is above the notes.
    let (_, printed, _) = import(&[&nested], &[&cable[..], &["--out", "nested.json"]].concat());
    assert!(printed.starts_with("nested.json: ") && printed.contains("\nno place for:"), "{printed}");
    let two = format!("{}---\nlimits: {{min: 3}}\n", std::fs::read_to_string(&nested).unwrap());
    std::fs::write(bench.path("two.yaml"), two).unwrap();
    let (code, _, said) = import(&["two.yaml"], &cable);
    assert_eq!(code, 3, "{said}");
    assert!(said.contains("questioned: two.yaml, line 19: a further document: not known"), "{said}");
    let (letters, uses) = ("b".repeat(4000), "&a;".repeat(1500));
    let bomb = format!("<!DOCTYPE models [<!ENTITY a \"{letters}\">]><models>{uses}</models>");
    std::fs::write(bench.path("bomb.wcrfx"), bomb).unwrap();
    let (code, _, said) = import(&["bomb.wcrfx"], &cable);
    assert_eq!(code, 1);
    assert!(
        said.contains("bomb.wcrfx, line 1, column 1: a document type with entities of its own"),
        "{said}"
    );
    let folder = data_path("reference/exchange/caspr-parent-offset");
    let cables = std::fs::read_to_string(format!("{folder}/plate_cables.xml")).unwrap();
    let other = "</cable_set><cable_set id=\"b\"/></cables>";
    let cables = cables.replace("</cable_set></cables>", other).replacen("cable_ideal ", "cable_vsd ", 1);
    std::fs::write(bench.path("cables.xml"), cables.replacen("</cable_ideal", "</cable_vsd", 1)).unwrap();
    let (code, _, said) = import(&[&format!("{folder}/plate_bodies.xml"), "cables.xml"], &cable);
    assert_eq!(code, 1);
    assert!(said.contains("the cable set a, the file also has b: `FILE:SET` chooses one"), "{said}");
}

#[test]
fn the_first_sentence_says_which_cables_break_and_one_line_names_all_that_pass_a_limit() {
    let printed =
        |arguments: &[&str]| text(cdpr().arg("deflection").args(arguments).output().unwrap().stdout);
    let broken = printed(&["caroca", "--pose", "0,0,1.2", "--force", "0,0,-50000"]);
    let first = broken.split("dp = ").next().unwrap().replace('\n', " ");
    assert!(first.contains(" mm; cables 1 to 8 break. ") && !first.contains("stable"), "{broken}");
    let line = "cables 1 to 8: tension up to 13331.346 N is above its breaking force, 10290 N";
    assert_eq!(broken.matches("its breaking force").count(), 1, "{broken}");
    assert!(broken.contains(line), "{broken}");
    // A tension that reads like its limit is not said to be below it.
    let slack = printed(&["ipanema-1", "--pose", "0,0,1", "--payload", "2.5"]);
    assert!(
        slack.contains("cables 5 to 8: tension is up to 0.00015 N below tension_limits.min, 1 N"),
        "{slack}"
    );
    assert!(slack.contains("it stays stable") && !slack.contains("1.000 N is below"), "{slack}");
}
