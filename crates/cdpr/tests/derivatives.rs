//! `cdpr derivatives` as a user meets it: the numbers of the library, and every kind of bad input.

use crate::common::{cdpr, data, data_path, data_text, text, unwrapped};
use cdpr_dynamics::{AmplitudeAt, AmplitudeDerivatives, Damping, FrequencyDerivatives};
use cdpr_robot::{Axis, Coordinate, Pose, Robot, Vector3};
use cdpr_statics::{Load, WantedPose, derivatives};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Output;

fn caroca() -> PathBuf {
    data("robots/caroca.json")
}

fn run(robot: &Path, arguments: &[&str]) -> Output {
    cdpr(&[&["derivatives", robot.to_str().unwrap()], arguments].concat())
}

#[test]
fn json_holds_the_numbers_of_the_library() {
    let robot = Robot::from_json(&std::fs::read_to_string(caroca()).unwrap()).unwrap();
    let turned = Pose::with_quaternion(Vector3::new(-0.4, 0.3, 1.5), [0.99, 0.05, 0.0, -0.1]).unwrap();
    for (argument, pose) in
        [("0,0,1.75", Pose::at(0.0, 0.0, 1.75)), ("-0.4,0.3,1.5,0.99,0.05,0,-0.1", turned)]
    {
        let output = run(&caroca(), &["--pose", argument, "--payload", "50", "--format", "json"]);
        assert!(output.status.success() && output.stderr.is_empty(), "{}", unwrapped(output.stderr));
        let json: Value = serde_json::from_slice(&output.stdout).unwrap();
        let keys: Vec<_> = json.as_object().unwrap().keys().map(String::as_str).collect();
        let lists = ["parameters", "magnitude_mm", "deflection_mm", "lengths", "least_stiffness_n_per_m"];
        assert_eq!(keys, [&lists[..], &["without", "unit"]].concat());
        assert!(json["without"][0].as_str().unwrap().contains("platform.inertia"));
        assert_eq!(json["unit"], "per SI unit of the parameter");
        let exact = derivatives(&robot, &pose, &Load::payload(50.0)).unwrap();
        let (magnitude, displacement) = (exact.magnitude().unwrap(), exact.displacement());
        let lists: Vec<_> = lists.iter().map(|key| json[key].as_array().unwrap()).collect();
        let (_, stiffness) = exact.least_stiffness(&robot, &Load::payload(50.0)).unwrap();
        assert!(lists.iter().all(|list| list.len() == 62));
        for (j, parameter) in exact.inputs.parameters.iter().enumerate() {
            assert_eq!(lists[0][j], parameter.to_string());
            assert_eq!(lists[1][j].as_f64(), Some(1e3 * magnitude[j]));
            assert_eq!(lists[4][j].as_f64(), Some(stiffness[j]));
            for axis in 0..3 {
                assert_eq!(lists[2][j][axis].as_f64(), Some(1e3 * displacement[(axis, j)]));
            }
            let lengths: Vec<_> = lists[3][j].as_array().unwrap().iter().map(Value::as_f64).collect();
            let expected: Vec<_> = exact.lengths.column(j).iter().copied().map(Some).collect();
            assert_eq!(lengths, expected);
        }
    }
}

#[test]
fn a_platform_with_inertia_has_derivatives_of_its_frequency() {
    let (name, pose, load) = ("robots/cogiro.json", Pose::at(1.0, 0.5, 2.0), Load::payload(50.0));
    let robot = Robot::from_json(&data_text(name)).unwrap();
    let found = derivatives(&robot, &pose, &load).unwrap();
    let exact = FrequencyDerivatives::of_deflection(&robot, &load, &found).unwrap();
    let slopes = exact.with_lengths(&found.lengths);
    let at = ["--pose", "1,0.5,2", "--payload", "50"];
    let output = run(&data(name), &[&at[..], &["--format", "json"]].concat());
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(json.get("without").is_none());
    assert_eq!(json["platform_frequency_hz"].as_f64(), Some(exact.frequency));
    assert!(json["platform_share"].as_f64().unwrap() > 0.5 && json["frequency_gap"].as_f64().unwrap() > 1e-3);
    for (found, exact) in json["frequency_hz"].as_array().unwrap().iter().zip(&slopes) {
        assert_eq!(found.as_f64(), Some(*exact));
    }
    assert!(text(run(&data(name), &[&at[..], &["--details"]].concat()).stdout).contains("d frequency [mHz]"));
}

#[test]
fn without_a_load_there_are_all_derivatives_but_those_of_the_displacement() {
    let poses = [
        ("robots/cogiro.json", "1,0.5,2", Pose::at(1.0, 0.5, 2.0)),
        ("robots/caroca.json", "0,0,1.75", Pose::at(0.0, 0.0, 1.75)),
    ];
    for (name, at, pose) in poses {
        let robot = Robot::from_json(&data_text(name)).unwrap();
        let found = derivatives(&robot, &pose, &Load::none()).unwrap();
        let output = run(&data(name), &["--pose", at, "--format", "json"]);
        assert_eq!(output.status.code(), Some(0));
        let json: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert!(json.get("magnitude_mm").is_none() && json.get("deflection_mm").is_none());
        let why = "the displacement and its derivatives need a load: --payload, --force or --moment";
        assert_eq!(json["without"][0], why);
        let (_, stiffness) = found.least_stiffness(&robot, &Load::none()).unwrap();
        for (j, slope) in stiffness.iter().take(found.inputs.parameters.len()).enumerate() {
            assert_eq!(json["least_stiffness_n_per_m"][j].as_f64(), Some(*slope));
            assert_eq!(json["lengths"][j][0].as_f64(), Some(found.lengths[(0, j)]));
        }
        let shown = unwrapped(run(&data(name), &["--pose", at]).stdout);
        assert!(shown.contains(why) && !shown.contains("|dp|"), "{shown}");
        // The parameters that change the lowest stiffness most come first.
        let first = shown.lines().find(|line| line.starts_with('\u{2502}')).unwrap();
        assert!(first.contains("d stiffness") && first.contains("largest dL [mm]"), "{shown}");
        let row = text(run(&data(name), &["--pose", at, "--format", "csv"]).stdout);
        let mut lines = csv::Reader::from_reader(row.as_bytes());
        let names = lines.headers().unwrap().clone();
        let cells = lines.records().next().unwrap().unwrap();
        let cell = |column: &str| &cells[names.iter().position(|name| name == column).unwrap()];
        assert_eq!((cell("magnitude_mm/mass"), cell("dz_mm/mass")), ("", ""));
        assert_eq!(cell("least_stiffness_n_per_m/mass").parse::<f64>().unwrap(), stiffness[0]);
    }
}

#[test]
fn the_amplitude_of_a_shaken_platform_has_derivatives_where_they_are_asked_for() {
    let (name, pose, load) = ("robots/cogiro.json", Pose::at(1.0, 0.5, 2.0), Load::payload(50.0));
    let robot = Robot::from_json(&data_text(name)).unwrap();
    let found = derivatives(&robot, &pose, &load).unwrap();
    let at = ["--pose", "1,0.5,2", "--payload", "50", "--marker", "0.1,0,-0.3"];
    for (along, axis) in [("", None), (",along=z", Some(Axis::Z))] {
        let shaken = AmplitudeAt {
            frequency: 3.5,
            damping: Damping { stretch: 1e-3, drag: 0.5 },
            marker: Vector3::new(0.1, 0.0, -0.3),
            along: axis,
        };
        let exact = AmplitudeDerivatives::of_deflection(&robot, &load, &found, &shaken).unwrap();
        let with = format!("amplitude=3.5,damping=1e-3,drag=0.5{along}");
        let asked = [&at[..], &["--with", &with]].concat();
        let output = run(&data(name), &[&asked[..], &["--format", "json"]].concat());
        let json: Value = serde_json::from_slice(&output.stdout).unwrap();
        let of = &json["amplitude"];
        assert_eq!(of["amplitude_mm_per_n"].as_f64(), Some(1e3 * exact.amplitude));
        assert_eq!((&of["inertia_assumed"], of["frequency_hz"].as_f64()), (&Value::from(false), Some(3.5)));
        let listed = of["derivatives_mm_per_n"].as_array().unwrap();
        assert_eq!(listed.len(), json["parameters"].as_array().unwrap().len());
        for (found, exact) in listed.iter().zip(exact.with_lengths(&found.lengths)) {
            assert_eq!(found.as_f64(), Some(1e3 * exact));
        }
        let shown = unwrapped(run(&data(name), &asked).stdout);
        let direction = axis.map_or("in the worst direction", |_| "along z");
        assert!(shown.contains(&format!("At 3.5 Hz a force {direction} shakes the point by")), "{shown}");
        assert_eq!(shown.contains("mm/N along z"), axis.is_some(), "{shown}");
        assert!(shown.contains("d amplitude ["), "{shown}");
    }
    for wrong in [
        &["--with", "drag=1"][..],
        &["--with", "amplitude=0"],
        &["--with", "amplitude=3,along=w"],
        &["--with", "amplitude=3,damping=-1"],
        &["--with", "amplitude=3", "--format", "csv"],
        &[],
    ] {
        let refused = run(&data(name), &[&at[..], wrong].concat());
        assert!(matches!(refused.status.code(), Some(1 | 2)), "{wrong:?}");
        assert!(unwrapped(refused.stderr).contains("expected"), "{wrong:?}");
    }
}

#[test]
fn a_parameter_with_two_sides_has_both_in_json_table_and_csv() {
    let file = std::fs::read_to_string(data("reference/robots/ipanema.json")).unwrap();
    let robot = Robot::from_json(&file).unwrap();
    let load = ["--pose", "0.2,0.1,1", "--payload", "2"];
    let ipanema = data("reference/robots/ipanema.json");
    let output = run(&ipanema, &[&load[..], &["--format", "json"]].concat());
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    let left = derivatives(&robot, &Pose::at(0.2, 0.1, 1.0), &Load::payload(2.0)).unwrap();
    let right = left.right();
    let one_sided = json["one_sided"].as_array().unwrap();
    assert!(!one_sided.is_empty() && one_sided.len() == left.one_sided.len());
    let table = text(run(&ipanema, &[&load[..], &["--details"]].concat()).stdout);
    for (found, exact) in one_sided.iter().zip(&left.one_sided) {
        let name = left.inputs.parameters[exact.column].to_string();
        assert_eq!(found["parameter"], name);
        let cable = exact.cables[0].cable + 1;
        assert_eq!(name, format!("dt{cable}"));
        assert_eq!((&found["cables"][0], &found["bounds"][0]), (&Value::from(cable), &Value::from("min")));
        for (side, exact_side) in [("left", &left), ("right", &right)] {
            assert_eq!(found[side]["magnitude_mm"], 1e3 * exact_side.magnitude().unwrap()[exact.column]);
            for i in 0..8 {
                let length = &found[side]["lengths"][i];
                assert_eq!(*length, exact_side.lengths[(i, exact.column)]);
            }
            assert!(table.contains(&format!("{name}, {side}")), "{table}");
        }
        assert_eq!(found["left"]["magnitude_mm"], 0.0);
        assert_ne!(found["right"]["magnitude_mm"], 0.0);
        assert!(
            table.contains(&format!("{name}: cable {cable} leaves its minimum tension on one side only"))
        );
    }
    let directory = tempfile::tempdir().unwrap();
    let poses = directory.path().join("poses.csv");
    std::fs::write(&poses, "0.2,0.1,1\n").unwrap();
    let list = run(&ipanema, &["--poses", poses.to_str().unwrap(), "--payload", "2"]);
    let list = text(list.stdout);
    let mut lines = csv::Reader::from_reader(list.as_bytes());
    let column = lines.headers().unwrap().iter().position(|name| name == "one_sided").unwrap();
    let row = lines.records().next().unwrap().unwrap();
    let names: Vec<_> = one_sided.iter().map(|one| one["parameter"].as_str().unwrap()).collect();
    assert_eq!(row[column], names.join(" "));
}

#[test]
fn the_table_begins_with_what_matters_most() {
    let printed = |more: &[&str]| {
        text(run(&caroca(), &[&["--pose", "0,0,1.75", "--payload", "50"], more].concat()).stdout)
    };
    let short = printed(&[]);
    assert_eq!(short.lines().filter(|line| line.starts_with('\u{2502}')).count(), 11, "{short}");
    assert!(short.contains("52 more, and other derivatives: with --details"), "{short}");
    let table = printed(&["--details"]);
    let lines: Vec<_> = table.lines().collect();
    assert_eq!(lines[0], "CAROCA at (0, 0, 1.75) m: |dp| = 1.33124 mm under the load.");
    assert!(
        lines[4].contains("youngs_modulus") && lines[4].contains("-12.88879") && lines[4].contains("GPa")
    );
    assert!(!table.contains("-0.00000 "));
    assert_eq!(lines.len(), 4 + 62 + 3);
    assert!(lines[67].contains("platform.inertia"));
}

#[test]
fn bad_input_is_named_with_what_would_be_right() {
    let pose = ["--pose", "0,0,1.75"];
    let with = |arguments: [&'static str; 2]| [pose.as_slice(), &arguments].concat();
    for (robot, arguments, words) in [
        (
            caroca(),
            with(["--payload", "heavy"]),
            "invalid value 'heavy' for '--payload <PAYLOAD>': `heavy` is not a finite number",
        ),
        (caroca(), with(["--payload", "inf"]), "`inf` is not a finite number"),
        (
            caroca(),
            with(["--uncertainty", "mass=1"]),
            "error: --uncertainty: expected --payload, --force or --moment, whose displacement is uncertain",
        ),
        (
            caroca(),
            vec!["--pose", "0,0", "--payload", "50"],
            "'--pose <POSE>': 2 numbers: expected x,y,z [m] or x,y,z,qw,qx,qy,qz",
        ),
        (
            caroca(),
            vec!["--pose", "0,0,9", "--payload", "50"],
            "error: at position (0, 0, 9) m: no tensions between 1 N and 10290 N",
        ),
        (
            caroca(),
            [&with(["--payload", "50"])[..], &["--format", "xml"]].concat(),
            "invalid value 'xml' for '--format",
        ),
        ("nowhere.json".into(), with(["--payload", "50"]), "error: cannot read nowhere.json: No such file"),
    ] {
        let output = run(&robot, &arguments);
        let text = unwrapped(output.stderr);
        assert_ne!(output.status.code(), Some(0), "{text}");
        assert!(text.contains(words) && !text.contains("panicked"), "`{words}` is not in: {text}");
    }
}

#[test]
fn derivatives_of_a_robot_with_four_cables_need_and_take_free_coordinates() {
    let robot = data_path("robots/four-cables.json");
    let arguments = ["derivatives", &robot, "--pose", "0.5,0.3,2", "--payload", "5", "--format", "json"];
    let found: Value = serde_json::from_str(&{
        let output = cdpr(&[&arguments[..], &["--free", "roll,pitch"]].concat());
        assert_eq!(output.status.code(), Some(0));
        text(output.stdout)
    })
    .unwrap();
    let of = Robot::from_json(&data_text("robots/four-cables.json")).unwrap();
    let free = [Coordinate::Roll, Coordinate::Pitch];
    let (pose, load) = (Pose::at(0.5, 0.3, 2.0), Load::payload(5.0));
    let exact = derivatives(&of, WantedPose::at(&pose).free(&free), &load).unwrap();
    for (j, magnitude) in exact.magnitude().unwrap().iter().take(exact.inputs.parameters.len()).enumerate() {
        assert_eq!(found["magnitude_mm"][j].as_f64(), Some(1e3 * magnitude));
    }
    let refused = unwrapped(cdpr(&arguments).stderr);
    assert!(refused.contains("expected `--free` with as many names"), "{refused}");
}

#[test]
fn shares_that_are_rounded_to_zero_are_not_named() {
    let call = ["derivatives", "caroca", "--pose", "0,0,1.75", "--payload", "50", "--uncertainty"];
    let said = |model: &str| unwrapped(cdpr(&[&call[..], &[model]].concat()).stdout).replace('\n', " ");
    let one = said("mass=9,b=1e-9");
    assert!(one.contains("Shares of the variance: mass 100.0 %."), "{one}");
    let several = said("a=0.002,b=0.005");
    assert!(several.contains(" %, ") && !several.contains(" 0.0 %"), "{several}");
}
