//! The first answers: what is certain, in sentences of 80 columns, and one recommended measure.

use crate::common::{answered, cdpr, cdpr_in, data_path, json_file, text, unwrapped};
use serde_json::{Value, json};
use std::path::Path;
use tempfile::TempDir;

/// Six robots that differ, each at a pose that it holds.
const ROBOTS: [(&str, &str, &[&str]); 6] = [
    ("caroca", "0,0,1.75", &[]),
    ("cogiro", "0,0,2", &[]),
    ("fast", "0,0,140.1", &[]),
    ("ipanema-1", "0,0,1", &[]),
    ("four-cables", "0.5,0.3,2", &["--free", "roll,pitch"]),
    ("ipanema-3", "0,0,1.3", &[]),
];

/// Refuses a line that a terminal of 80 columns breaks.
fn assert_narrow(printed: &str) {
    for line in printed.lines() {
        assert!(line.chars().count() <= 80, "{} columns: {line}", line.chars().count());
    }
}

/// The template study of a robot, without surfaces.
fn template(folder: &Path, robot: &str) {
    answered(cdpr_in(folder, &["study", "new", robot, "--out", "study.json"]));
    let path = folder.join("study.json");
    let mut study = json_file(&path);
    study["surfaces"] = json!({});
    std::fs::write(path, study.to_string()).unwrap();
}

fn leading(summary: &Value) -> Value {
    summary["studies"]["all"]["verdict"]["recommendation"]["inputs"][0].clone()
}

#[test]
fn the_template_study_says_what_is_certain_and_fewer_observations_leave_its_bounds_as_they_are() {
    let folder = TempDir::new().unwrap();
    template(folder.path(), "cogiro");
    let run = |out: &str, more: &[&str]| -> (String, Value) {
        let arguments = [&["study", "run", "study.json", "--out", out], more].concat();
        let printed = answered(cdpr_in(folder.path(), &arguments));
        (printed, json_file(folder.path().join(out).join("summary.json")))
    };
    let (printed, summary) = run("all", &[]);
    assert_narrow(&printed);
    let lines: Vec<&str> = printed.lines().collect();
    assert!(lines[0].starts_with("all: Mean deflection 1.206 mm, std 0.066"), "{printed}");
    assert_eq!(lines[1], "Certain to matter (above 1 % of the variance): youngs_modulus.");
    assert!(lines[2].starts_with("Certainly below 1 % each: mass, linear_density, "), "{printed}");
    assert!(printed.contains("bounded by exact derivatives at 256 points; 95 %"), "{printed}");
    assert!(!printed.contains("left out") && !printed.contains("Sobol"), "{printed}");
    // The modulus alone has 99.28 %, by the derivatives of the nominal robot.
    let modulus = leading(&summary);
    let [low, high] = ["low", "high"].map(|end| modulus[end].as_f64().unwrap());
    assert!(low > 0.9 && low < 0.9928 && 0.9928 < high && high < 1.0, "{modulus}");
    assert_eq!((&modulus["input"], &modulus["standing"]), (&json!("youngs_modulus"), &json!("matters")));

    let (few, of_few) = run("few", &["--observations", "200"]);
    assert_eq!(leading(&of_few), modulus);
    assert!(few.contains("exact derivatives at 256 points"), "{few}");
    // Sobol' indices of 16 blocks have intervals wider than they are.
    let (details, _) = run("details", &["--observations", "200", "--details"]);
    assert!(details.contains("Sobol' total") && details.contains("not resolved"), "{details}");
    assert!(!details.contains("left out: sobol"), "{details}");
    // A sum of what is not resolved has no number.
    let row = |begin: &str| -> Vec<String> {
        let cells =
            |line: &str| line.split(['\u{2502}', '\u{2506}']).map(|cell| cell.trim().to_owned()).collect();
        let mut lines = details.lines().map(cells);
        // The verdict has a table with inputs, too.
        lines.find(|cells: &Vec<String>| cells.len() > 8 && cells.iter().any(|cell| cell == begin)).unwrap()
    };
    let (names, sums) = (row("input"), row("sum of a"));
    let of = |name: &str| &sums[names.iter().position(|cell| cell == name).unwrap()];
    assert_eq!(
        (of("Sobol' total").as_str(), of("derivatives").is_empty()),
        ("", false),
        "{names:?} {sums:?}"
    );

    // The report has the same words.
    let page = std::fs::read_to_string(folder.path().join("all/report.html")).unwrap();
    for sentence in summary["studies"]["all"]["verdict"]["sentences"].as_array().unwrap() {
        assert!(page.contains(sentence.as_str().unwrap()), "{sentence}");
    }
}

#[test]
fn a_study_without_measures_of_sensitivity_has_a_recommended_one_and_names_what_would_settle_the_rest() {
    let folder = TempDir::new().unwrap();
    template(folder.path(), "caroca");
    let path = folder.path().join("study.json");
    let mut study = json_file(&path);
    study.as_object_mut().unwrap().remove("sensitivity");
    study["samplings"]["all"]["observations"] = json!(64);
    std::fs::write(&path, study.to_string()).unwrap();
    let printed = answered(cdpr_in(folder.path(), &["study", "run", "study.json", "--out", "out"]));
    assert_narrow(&printed);
    assert!(printed.contains("Certain to matter (above 1 % of the variance): youngs_modulus"), "{printed}");
    let summary = json_file(folder.path().join("out/summary.json"));
    assert!(summary["studies"]["all"]["sensitivity"].is_null());
    assert_eq!(summary["studies"]["all"]["verdict"]["recommendation"]["basis"], "derivatives");
    // Correlated inputs have no shares by derivatives; ranks are not asked for either.
    study["samplings"]["all"]["correlations"] =
        json!([{"between": ["mass", "linear_density"], "value": 0.5}]);
    std::fs::write(&path, study.to_string()).unwrap();
    let output = cdpr_in(folder.path(), &["study", "run", "study.json", "--out", "correlated", "--details"]);
    let printed = text(output.stdout);
    assert!(printed.contains("all: bounds of shares: the inputs are correlated"), "{printed}");
}

/// A table of Ishigami's function `sin x1 + 7 sin² x2 + 0.1 x3⁴ sin x1` and of `x5` with noise, 500 rows of
/// twelve independent inputs.
fn ishigami_among_twelve(folder: &Path) {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    // Multiplicative congruential generator of P. L'Ecuyer (1999), its upper 53 bits.
    let mut uniform = || {
        state = state.wrapping_mul(2_862_933_555_777_941_757).wrapping_add(3_037_000_493);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let names: Vec<String> = (1..=12).map(|i| format!("x{i}")).collect();
    let mut table = names.join(",") + ",y,z\n";
    for _ in 0..500 {
        let x: Vec<f64> = (0..12).map(|_| std::f64::consts::PI * (2.0 * uniform() - 1.0)).collect();
        let y = x[0].sin() + 7.0 * x[1].sin().powi(2) + 0.1 * x[2].powi(4) * x[0].sin();
        let z = x[4] + uniform();
        let cells = x.iter().chain([&y, &z]).map(|x| format!("{x:.5}")).collect::<Vec<_>>();
        table += &(cells.join(",") + "\n");
    }
    std::fs::write(folder.join("table.csv"), table).unwrap();
}

#[test]
fn of_twelve_inputs_of_ishigami_three_are_certain_to_matter_and_x2_is_first() {
    let folder = TempDir::new().unwrap();
    ishigami_among_twelve(folder.path());
    let analyse = ["analyse", "table.csv", "--output", "y,z"];
    let printed = answered(cdpr_in(folder.path(), &analyse));
    assert_narrow(&printed);
    let first = printed.lines().next().unwrap();
    let certain = first.strip_prefix("y: 3 of 12 inputs are certain to matter: ").unwrap();
    let names: Vec<&str> = certain.split(", ").filter_map(|of| of.split_once(" (")).map(|of| of.0).collect();
    assert_eq!(names, ["x2", "x1", "x3"], "{printed}");
    assert!(printed.contains("not settled by 500 rows, more of them may: x4, x5, x6"), "{printed}");
    assert!(printed.contains("z: 1 of 12 inputs is certain to matter: x5 (trend)"), "{printed}");
    let found: Value = serde_json::from_str(&answered(cdpr_in(
        folder.path(),
        &[&analyse[..], &["--format", "json"]].concat(),
    )))
    .unwrap();
    let verdict = &found["outputs"]["y"]["verdict"];
    assert_eq!(verdict["sentences"][0].as_str().unwrap(), first.strip_prefix("y: ").unwrap());
    assert!(verdict["certain"].as_array().unwrap().iter().all(|of| of["p_value"].as_f64().unwrap() < 0.05));
}

#[test]
fn tolerances_begin_with_what_to_tighten_and_what_independent_robots_say_of_it() {
    let study = data_path("studies/caroca.json");
    let run = |limit: &str, more: &[&str]| {
        let arguments =
            ["study", "tolerances", &study, "--sampling", "geometrical_asymmetric", "--limit", limit];
        answered(cdpr(&[&arguments[..], more].concat()))
    };
    let printed = run("deflection_mm<0.9", &["--costs", "b=3"]);
    assert_narrow(&printed);
    assert!(printed.starts_with("For 95 % below 0.9 mm, tighten the width of b to 8"), "{printed}");
    // 4096 robots have found the factors, and 20 000 others miss the limit by a little.
    for line in [
        "\nThen 94.5 % (94.2 to 94.8) of the robots are below it, now 91.",
        "\nThat is less than 95 %: a limit of 0.898",
    ] {
        assert!(printed.contains(line), "{printed}");
    }
    let enough = run("deflection_mm<1", &[]);
    assert!(enough.starts_with("The tolerances suffice: nothing has to be tightened for 95 %"), "{enough}");
    assert!(run("deflection_mm<0.9", &["--details"]).contains("quantile if it alone is halved [mm]"));
}

#[test]
fn each_robot_says_first_what_it_carries_how_much_of_a_plane_it_holds_and_what_a_path_demands() {
    let folder = TempDir::new().unwrap();
    for (robot, pose, free) in ROBOTS {
        let capacity = [&["capacity", robot, "--pose", pose], free].concat();
        let printed = answered(cdpr_in(folder.path(), &capacity));
        assert_narrow(&printed);
        let sentences: String = printed.lines().take_while(|line| !line.starts_with('\u{250c}')).collect();
        assert!(sentences.contains(" carries up to ") && sentences.contains(" kg; then cable "), "{printed}");

        let (x, z) = (pose.split(',').next().unwrap(), pose.rsplit(',').next().unwrap());
        let (x, z): (f64, f64) = (x.parse().unwrap(), z.parse().unwrap());
        let grid = format!("--region={}:{x}:2,0:0.2:2,{z}:{z}:1", x - 0.1);
        let workspace = [&["workspace", robot, &grid, "--payload", "1", "--out", robot], free].concat();
        let output = cdpr_in(folder.path(), &workspace);
        let printed = text(output.stdout);
        assert_narrow(&printed);
        let words = [" of 4 positions (", "payload 1 kg"];
        assert!(words.iter().all(|words| printed.contains(words)), "{robot}: {printed}");
        if free.is_empty() {
            let poses = folder.path().join("poses.csv");
            std::fs::write(&poses, format!("x_m,y_m,z_m\n{pose}\n")).unwrap();
            let path = ["path", robot, "--poses", "poses.csv", "--payload", "1"];
            let output = cdpr_in(folder.path(), &path);
            let said = unwrapped(output.stderr);
            assert!(said.starts_with("1 of 1 pose held, unloaded at "), "{robot}: {said}");
            assert_narrow(said.lines().next().unwrap());
        }
    }
}

#[test]
fn a_campaign_is_planned_read_and_fitted_with_the_answer_first() {
    let folder = TempDir::new().unwrap();
    let candidates = data_path("calibration/caroca-candidates.csv");
    let run = |words: &str, more: &[&str]| {
        let words: Vec<&str> = words.split_whitespace().collect();
        let printed = text(cdpr_in(folder.path(), &[&words[..], more].concat()).stdout);
        assert_narrow(&printed);
        printed
    };
    let noise = "--noise position=1e-4,rotation=1e-4,lengths=1e-4 --uncertainty a=0.002,b=0.005";
    let plan = format!("calibrate plan caroca --number 12 {noise} --out poses.csv --poses");
    let planned = run(&plan, &[&candidates]);
    assert!(planned.starts_with("12 poses of CAROCA leave "), "{planned}");
    assert!(planned.contains(" % of parameters' std (random "), "{planned}");
    let (model, exact) =
        (data_path("calibration/caroca-tolerances.json"), "--noise position=1e-4,rotation=1e-4,length=1e-4");
    let simulate = "calibrate simulate caroca --poses poses.csv --seed 1 --out measured.csv --uncertainty";
    run(&format!("{simulate} {model} {exact}"), &[]);
    let calibrate = "calibrate fit caroca measured.csv --with folds=0,starts=1 --out fitted --uncertainty";
    let fitted = run(&format!("{calibrate} {model} {exact}"), &[]);
    assert!(fitted.lines().next().unwrap().contains("CAROCA"), "{fitted}");
    assert!(fitted.contains("From the measurements alone, "), "{fitted}");
    assert!(fitted.contains(" are identifiable.") && fitted.contains("chi-square"), "{fitted}");
}
