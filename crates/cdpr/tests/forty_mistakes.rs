//! Forty natural mistakes, each as it is typed: it is understood, questioned or refused, with its cause, its
//! place and what to do.

use crate::common::{cdpr_in, data, data_text, text, unwrapped};
use std::path::Path;
use tempfile::TempDir;

/// Tables of poses that are understood, all with the pose (0.5, -0.25, 2) m.
const POSES: [(&str, &str); 10] = [
    ("semicolons", "x;y;z\n0.5;-0.25;2\n"),
    ("tabs", "x\ty\tz\n0.5\t-0.25\t2\n"),
    ("blanks", "x y z\n0.5 -0.25 2\n"),
    ("a line for a spreadsheet", "sep=;\nx;y;z\n0.5;-0.25;2\n"),
    ("decimal commas", "x;y;z\n0,5;-0,25;2\n"),
    ("capital names", "X,Y,Z\n0.5,-0.25,2\n"),
    ("millimetres in the names", "x_mm,y_mm,z_mm\n500,-250,2000\n"),
    ("radians in the names", "x,y,z,roll_rad,pitch_rad,yaw_rad\n0.5,-0.25,2,0,0,0\n"),
    ("a column of times", "t,x,y,z\n0,0.5,-0.25,2\n"),
    ("UTF-16 of PowerShell", "x,y,z\r\n0.5,-0.25,2\r\n"),
];

/// Robot files with a slip: a name, the robot that is changed, the text that is replaced, and by what.
const ROBOTS: [(&str, &str, &str, &str); 16] = [
    ("comment", "caroca", "\"gravity\"", "// of Earth\n\"gravity\""),
    ("two-commas", "caroca", "\"mass\": 180.0,", "\"mass\": 180.0,,"),
    ("decimal-comma", "caroca", "180.0", "180,5"),
    ("diagonal", "caroca", "\"mass\": 180.0,", "\"mass\": 180.0, \"inertia\": [9, 9, 9],"),
    ("name-of-cable", "caroca", "\"cable\": {", "\"cable\": \"steel-4mm\", \"pulley\": {"),
    ("own-density", "caroca", "[0.2, 0.15, 0.125]", "[0.2, 0.15, 0.125], \"linear_density\": 0.1"),
    ("point-too-high", "caroca", "\"gravity\"", "\"point\": true, \"gravity\""),
    ("millimetres", "caroca", "\"anchor_point\": [", "\"anchor_point\": [0e0, 0, 0], \"exit_point\": ["),
    (
        "gram-millimetres",
        "cogiro",
        "[[36.598, -0.453, 3.012], [-0.453, 35.982, -1.539], [3.012, -1.539, 25.439]]",
        "[[3.66e10, 0, 0], [0, 3.6e10, 0], [0, 0, 2.54e10]]",
    ),
    (
        "full-circle",
        "cogiro",
        "\"section\": 8.2051e-6, \"linear_density\": 0.064",
        "\"linear_density\": 0.0613",
    ),
    ("lead", "cogiro", "\"cables\": [\n    {", "\"cables\": [\n    {\"lead\": 3000,"),
    (
        "radius",
        "cogiro",
        "\"tension_limits\"",
        "\"pulley\": {\"radius\": 40, \"axis\": [0, 0, 1]}, \"tension_limits\"",
    ),
    ("diameter", "cogiro", "\"diameter\": 0.004", "\"diameter\": 4"),
    ("sign", "cogiro", "[-7.3911, 5.194, 5.3976]", "[-7.3911, 5.194, -5.3976]"),
    ("modulus", "cogiro", "1.0e11", "100"),
    ("swapped", "cogiro", "[0.5032, -0.4928, 0]", "[-0.5097, 0.3508, 0.9976]"),
];

/// Commands in the folder, with words of what is said: cause, place, remedy.
const COMMANDS: [(&str, &str, &[&str]); 40] = [
    ("blanks between the numbers", "inverse cogiro --pose 0 0 2", &["tensions of", "hold it"]),
    ("six numbers", "inverse cogiro --pose 0,0,2,0,0,10", &["6 numbers", "--rpy 0,0,10"]),
    ("commas between the angles", "inverse cogiro --pose 0,0,2 --rpy 0,0,10", &["yaw 10 degrees"]),
    (
        "order of SciPy",
        "inverse cogiro --pose 0,0,2,0,0,0.0871557,0.9961947",
        &["qw,qx,qy,qz", "0.996195,0,0"],
    ),
    (
        "radians for degrees",
        "inverse cogiro --pose 0,0,2 --rpy 0,0,1.5708",
        &["--rpy is 0, 0, 1.571 degrees", "90 degrees in radians", "angles in degrees"],
    ),
    ("degrees for radians", "inverse cogiro --poses turned.csv", &["line 2", "roll is 30", "roll_deg"]),
    ("comment", "robot check comment.json", &["line 10", "a comment", "remove it"]),
    ("two commas", "robot check two-commas.json", &["platform: two commas", "remove one"]),
    ("decimal comma", "robot check decimal-comma.json", &["180,5 has a decimal comma", "a point, 180.5"]),
    (
        "three numbers for an inertia",
        "robot check diagonal.json",
        &["platform.inertia", "[[a, 0, 0], [0, b, 0]"],
    ),
    (
        "name of a cable",
        "robot check name-of-cable.json",
        &["\"steel-4mm\"", "expected its properties, {", "`cdpr robot list` shows"],
    ),
    (
        "density of one cable",
        "robot check own-density.json",
        &["cable 1, cables[0].linear_density", "are in its `cable`"],
    ),
    ("a field too high", "robot check point-too-high.json", &["`point`", "it is a field of `platform`"]),
    ("normal for uniform", "study run normal.json --out n", &["Mean deflection"]),
    (
        "mass instead of its deviation",
        "study run mass.json --out m",
        &["mean of mass in tolerances is 180 kg", "deviations count from 180 kg"],
    ),
    ("modulus in GPa", "study run modulus-20.json --out e", &["is 20 Pa", "2.000e10 Pa, if 20 is in GPa"]),
    (
        "points in mm",
        "study run points.json --out p",
        &["std of b in tolerances is 10 m", "0.01 m, if 10 is in mm"],
    ),
    (
        "units of uncertainties",
        "derivatives caroca --pose 0,0,1.75 --payload 50 --uncertainty a=1,b=3,youngs_modulus=20",
        &["std of a is 1 m", "0.001 m, if 1 is in mm", "2.000e10 Pa, if 20 is in GPa"],
    ),
    (
        "noise in mm",
        "calibrate identify caroca --region=-1:1:3,-1:1:3,1:2:2 --uncertainty a=0.002 --noise position=0.1",
        &["noise of position is 0.1 m", "1.000e-4 m, if 0.1 is in mm"],
    ),
    (
        "inertia in g mm2",
        "robot check gram-millimetres.json",
        &["platform.inertia", "36.6 kg m", "is in g mm"],
    ),
    ("no section", "robot check full-circle.json", &["cable.section", "the full circle", "no material"]),
    ("lead in mm", "robot check lead.json", &["cables[0].lead is 3000 m", "3 m, if 3000 is in mm"]),
    ("radius in mm", "robot check radius.json", &["pulley.radius is 40 m", "0.04 m, if 40 is in mm"]),
    ("diameter in mm", "robot check diameter.json", &["cable.diameter is 4 m", "0.004 m, if 4 is in mm"]),
    ("lost sign", "robot check sign.json", &["cables[2].exit_point", "z = 5.3976"]),
    (
        "modulus of a robot in GPa",
        "robot check modulus.json",
        &["youngs_modulus is 100 Pa", "if 100 is in GPa"],
    ),
    ("one anchor twice", "robot check swapped.json", &["cable 2, cables[1].anchor_point", "the same place"]),
    ("position in mm", "inverse cogiro --pose 0,0,1200", &["--pose is (0, 0, 1200) m", "(0, 0, 1.2) m, if"]),
    (
        "plane in mm",
        "workspace cogiro --region ::3,::3,1200 --out w",
        &["the map is empty", "1.2) m, if it is in mm"],
    ),
    (
        "lengths of another robot",
        "direct caroca --lengths 9.7388,9.1792,9.4211,9.4696,9.7644,9.1930,9.4966,9.5576",
        &["below the floor", "lengths of this robot, in m and in the order of its cables"],
    ),
    ("lengths of fewer cables", "direct cogiro --lengths 4.4,4.5,4.3,4.2", &["a list of 4", "each of the 8"]),
    (
        "payload for mass",
        "direct caroca --lengths 4.44,4.54,4.36,4.26,4.26,4.36,4.54,4.44 --mass 50",
        &["mass is 50 kg", "less than half of the platform's own 180 kg", "a payload"],
    ),
    (
        "cables counted from 0",
        "derivatives caroca --pose 0,0,1.75 --payload 5 --uncertainty a0.x=1e-3",
        &["a0.x", "such as a1.x"],
    ),
    (
        "load in kg",
        "deflection cogiro --pose 0,0,2 --force 0,0,-50kg",
        &["a force is in N", "is `--payload`"],
    ),
    ("few observations", "study run normal.json --observations 2", &["expected a count, 3 to 1e10"]),
    ("input as output", "analyse table.csv --output a", &["y looks like an output", "name the outputs"]),
    ("words as output", "analyse table.csv --output note", &["output is note", "one of a, b, y"]),
    ("folder for a file", "robot check .", &[". is a folder", "expected a robot file"]),
    ("misspelt robot", "inverse corgiro --pose 0,0,2", &["called `corgiro`", "near are cogiro"]),
    (
        "robot for a study",
        "study run cogiro",
        &["cogiro is a robot", "`cdpr study new` writes a study of it"],
    ),
];

/// Writes all files that are named above.
fn prepare(folder: &Path) {
    let write = |name: &str, content: &str| std::fs::write(folder.join(name), content).unwrap();
    for (name, robot, from, to) in ROBOTS {
        let robot = data_text(&format!("robots/{robot}.json"));
        assert!(robot.contains(from), "{name}: {from}");
        write(&format!("{name}.json"), &robot.replacen(from, to, 1));
    }
    write("turned.csv", "x_m,y_m,z_m,roll_rad\n0,0,2,30\n");
    let row = |k: i32| format!("{},{},{k},text\n", f64::from(k * k % 17), f64::from(k * k % 23));
    write("table.csv", &format!("a,b,y,note\n{}", (0..60).map(row).collect::<String>()));
    let study = cdpr_in(folder, &["study", "new", "caroca", "--out", "template.json"]);
    assert!(study.status.success(), "{}", unwrapped(study.stderr));
    let mut study: serde_json::Value = crate::common::json_file(folder.join("template.json"));
    study.as_object_mut().unwrap().remove("sensitivity");
    (study["replicates"], study["surfaces"]) = (0.into(), serde_json::json!({}));
    study["samplings"]["all"]["observations"] = 64.into();
    let model = study["samplings"]["all"]["error_model"].as_str().unwrap().to_owned();
    for (name, input, mean, std) in [
        ("normal", "mass", 0.0, 0.5),
        ("mass", "mass", 180.0, 0.2),
        ("modulus-20", "youngs_modulus", 0.0, 20.0),
        ("points", "b", 0.0, 10.0),
    ] {
        let mut other = study.clone();
        other["error_models"][&model][input]["law"] =
            serde_json::json!({"normal": {"mean": mean, "std": std}});
        write(&format!("{name}.json"), &other.to_string());
    }
    assert!(data("robots/caroca.json").exists());
}

#[test]
fn forty_natural_mistakes_have_cause_place_and_remedy() {
    let folder = TempDir::new().unwrap();
    prepare(folder.path());
    for (what, command, words) in COMMANDS {
        let output = cdpr_in(folder.path(), &command.split(' ').collect::<Vec<_>>());
        let said = (unwrapped(output.stderr) + &text(output.stdout)).replace('\n', " ");
        assert!(output.status.code().is_some() && !said.contains("panicked"), "{what}: {said}");
        for words in words {
            assert!(said.contains(words), "{what}: `{words}` is not in: {said}");
        }
    }
    for (what, table) in POSES {
        let bytes = match what.starts_with("UTF-16") {
            true => [0xff, 0xfe].into_iter().chain(table.encode_utf16().flat_map(u16::to_le_bytes)).collect(),
            false => table.as_bytes().to_vec(),
        };
        std::fs::write(folder.path().join("poses.csv"), bytes).unwrap();
        let output = cdpr_in(folder.path(), &["inverse", "cogiro", "--poses", "poses.csv"]);
        let said = unwrapped(output.stderr) + &text(output.stdout);
        assert!(said.contains("\n0.5,-0.25,2.0,1.0,0.0,0.0,0.0,"), "{what}: {said}");
    }
}
