//! Every kind of bad input on the command line and in files, with the whole message as a snapshot.
//!
//! After a change, `INSTA_UPDATE=always cargo test -p cdpr bad_input` writes the snapshot again; read the
//! difference as a user would.

use crate::common::{cdpr_in, data_text as data, unwrapped};
use std::fmt::Write;
use std::path::Path;
use tempfile::TempDir;

/// Files made from CAROCA's robot and study by replacing text.
const ROBOTS: [(&str, &str, &str); 14] = [
    ("no_mass.json", r#""mass": 180.0, "#, ""),
    ("misspelt.json", r#""mass": 180.0"#, r#""mas": 180.0"#),
    ("text_mass.json", r#""mass": 180.0"#, r#""mass": "heavy""#),
    ("nan_mass.json", r#""mass": 180.0"#, r#""mass": NaN"#),
    ("huge_mass.json", r#""mass": 180.0"#, r#""mass": 1e999"#),
    ("negative_mass.json", r#""mass": 180.0"#, r#""mass": -180"#),
    ("negative_modulus.json", "1.022e11", "-1.022e11"),
    ("no_section.json", r#""diameter": 0.004, "section": 1.2566370614e-5, "#, ""),
    ("limits.json", r#""min": 1.0, "max": 10290.0"#, r#""min": 100, "max": 50"#),
    ("format.json", "cdpr-robot/1", "cdpr-robot/9"),
    ("short_point.json", "[-3.5, 2, 3.5]", "[-3.5, 2]"),
    ("coincident.json", "[-0.2, 0.15, -0.125]", "[-0.2, -0.15, 0.125]"),
    ("cut.json", r#""tension_limits""#, "\u{0}"),
    ("weak.json", r#""max": 10290.0"#, r#""max": 100"#),
];
const STUDIES: [(&str, &str, &str); 7] = [
    ("study_payload.json", r#""payload": 50"#, r#""payload": -50"#),
    ("study_no_payload.json", r#""payload": 50"#, r#""payload": 0"#),
    ("study_replicates.json", r#""replicates": "#, r#""replicates": 1000000"#),
    ("study_robot.json", "../robots/caroca.json", "nowhere.json"),
    ("study_law.json", r#""law": "#, r#""low": "#),
    ("study_model.json", r#""error_model": ""#, r#""error_model": "x"#),
    ("study_unknown.json", r#""seed""#, r#""sead""#),
];

fn prepare(folder: &Path) {
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    let (robot, study) = (data("robots/caroca.json"), data("studies/caroca.json"));
    for (name, from, to) in ROBOTS {
        assert!(robot.contains(from), "{from}");
        let text = robot.replacen(from, to, 1);
        write(name, text.split('\u{0}').next().unwrap());
    }
    let study_here = study.replace("../robots/caroca.json", "robot.json");
    for (name, from, to) in STUDIES {
        assert!(study.contains(from), "{from}");
        write(name, &study.replacen(from, to, 1).replace("../robots/caroca.json", "robot.json"));
    }
    write("robot.json", &robot);
    write("study.json", &study_here);
    // Coincident cables need the same exit point: the second with the eighth's anchor point and place.
    let seventh = r#"    {"exit_point": [-3.5, -2, 3.5], "anchor_point": [0.2, -0.15, -0.125]},"#;
    let first = r#"    {"exit_point": [-3.5, 2, 3.5], "anchor_point": [0.2, 0.15, 0.125]},"#;
    write("coincident.json", &robot.replacen(seventh, first, 1));
    let (before, _) = robot.split_once("\"cables\": [").unwrap();
    write("no_cables.json", &format!("{before}\"cables\": []\n}}"));
    write("empty.json", "");
    std::fs::write(folder.join("binary.json"), [0x7f, 0x45, 0x4c, 0x46, 0xff, 0xfe]).unwrap();
    write("list.json", "[1, 2]");
    write("case_unknown.json", "{\"lengths\": [4, 4, 4, 4, 4, 4, 4, 4],\n \"weight\": 3}");
    write("case_text.json", "[{\"lengths\": [4, 4, 4, 4, \"four\", 4, 4, 4]}]");
    let (record, law) = (data("cables/caroca-4mm-record.csv"), data("cables/caroca-4mm-law.json"));
    write("record.csv", &record);
    write("noisy.csv", &record.replace("1543.5,1.48870837248", "1543.5,1.0368"));
    write("no_phase.csv", &record.replace(",loading", ","));
    write("law.json", &law);
    write("law_order.json", &law.replacen(r#""tension": 1029.0"#, r#""tension": 102.9"#, 1));
    write("law_modulus.json", &law.replacen("7.25e10", "-7.25e10", 1));
    write("law_format.json", &law.replace("cdpr-law/1", "cdpr-law/9"));
    let operating =
        data("studies/caroca-operating-point.json").replace("../robots/caroca.json", "robot.json");
    write("study_point.json", &operating.replacen(r#""tension": 514.5"#, r#""tension": -514.5"#, 1));
    std::fs::create_dir(folder.join("folder")).unwrap();
    write("twice.json", &study_here.replacen("\"geometrical\": {", "\"mechanical\": {", 1));
    std::fs::write(folder.join("utf16.json"), [0xff, 0xfe, b'{', 0, b'}', 0]).unwrap();
}

const LENGTHS: &str = "4.44,4.54,4.36,4.26,4.26,4.36,4.54,4.44";

/// What is wrong, and the arguments, separated by spaces.
const CASES: [(&str, &str); 97] = [
    ("unknown command", "invert robot.json"),
    ("missing argument", "inverse robot.json"),
    ("unknown argument", "inverse robot.json --pose 0,0,1.75 --speed 3"),
    ("unknown format", "robot check robot.json --format xml"),
    ("robot file that is not there", "robot check nowhere.json"),
    ("folder for a robot file", "robot check folder"),
    ("empty robot file", "robot check empty.json"),
    ("binary robot file", "robot check binary.json"),
    ("robot file cut off", "robot check cut.json"),
    ("robot file that is a list", "robot check list.json"),
    ("study for a robot", "robot check study.json"),
    ("missing field", "robot check no_mass.json"),
    ("misspelt field", "robot check misspelt.json"),
    ("text for a number", "robot check text_mass.json"),
    ("NaN in a file", "robot check nan_mass.json"),
    ("number out of range", "robot check huge_mass.json"),
    ("negative mass", "robot check negative_mass.json"),
    ("negative modulus", "robot check negative_modulus.json"),
    ("neither section nor diameter", "robot check no_section.json"),
    ("limits the wrong way round", "robot check limits.json"),
    ("another format", "robot check format.json"),
    ("point with two coordinates", "robot check short_point.json"),
    ("no cables", "robot check no_cables.json"),
    ("two cables in one place", "robot check coincident.json"),
    ("pose with two coordinates", "inverse robot.json --pose 0,0"),
    ("pose that is no number", "inverse robot.json --pose 0,0,high"),
    ("NaN in a pose", "inverse robot.json --pose 0,0,NaN"),
    ("quaternion of zeros", "inverse robot.json --pose 0,0,1,0,0,0,0"),
    ("pose above the frame", "inverse robot.json --pose 0,0,9"),
    ("limits too tight for the platform", "inverse weak.json --pose 0,0,1.75"),
    ("negative payload", "deflection robot.json --pose 0,0,1.75 --payload -5"),
    ("no load", "deflection robot.json --pose 0,0,1.75"),
    ("force with two components", "inverse robot.json --pose 0,0,1.75 --force 1,2"),
    ("uncertainty of no displacement", "derivatives robot.json --pose 0,0,1.75 --uncertainty mass=0.5"),
    ("wrong number of lengths", "direct robot.json --lengths 4,4,4"),
    ("negative length", "direct robot.json --lengths 4.44,4.54,-4.36,4.26,4.26,4.36,4.54,4.44"),
    ("lengths that are no numbers", "direct robot.json --lengths long"),
    ("lengths far too short", "direct robot.json --lengths 1,1,1,1,1,1,1,1"),
    ("mass of zero", "direct robot.json --mass 0 --lengths"),
    ("lengths and a file", "direct robot.json --from case_text.json --lengths"),
    ("unknown field in a case", "direct robot.json --from case_unknown.json"),
    ("text in a case of a list", "direct robot.json --from case_text.json"),
    ("cable without anything known", "cable catenary weight=1,stiffness=1e6"),
    ("cable of negative stiffness", "cable catenary weight=1,stiffness=-1e6 --length 4 --end 3,1"),
    ("anchor point behind the exit point", "cable catenary weight=1,stiffness=1e6 --length 4 --end -3,1"),
    ("tension too small for the weight", "cable catenary weight=10,stiffness=1e6 --end 4,0 --tension 3"),
    ("force that pushes", "cable catenary weight=1,stiffness=1e6 --length 4 --end-force -3,1"),
    ("plane without an axis", "workspace robot.json --region 1.75"),
    ("a region with a count of zero", "workspace robot.json --region ::0,::7,1.75"),
    ("box the wrong way round", "workspace robot.json --region=1:-1:3,0:1:2,1:2:2"),
    ("uncertainty of no parameter", "workspace robot.json --region z=1.75 --uncertainty spring=1"),
    ("folder that cannot be made", "workspace robot.json --region z=1.75 --out robot.json/out"),
    ("negative payload in a study", "study run study_payload.json"),
    ("no payload in a study", "study run study_no_payload.json"),
    ("more replicates than memory holds", "study run study_replicates.json"),
    ("too few observations", "study run study.json --observations 2"),
    ("a tolerance without a load", "workspace robot.json --region z=1.75 --uncertainty a=0.001"),
    ("a name given twice", "workspace robot.json --region z=1.75 --uncertainty a=0.001,a=0.002"),
    ("a rotation by a quaternion of zeros", "inverse robot.json --pose 0,0,1.75,0,0,0,0"),
    (
        "lengths beyond any frame",
        "direct robot.json --lengths 1e308,1e308,1e308,1e308,1e308,1e308,1e308,1e308",
    ),
    (
        "candidate poses of which none is held",
        "calibrate identify robot.json --region=0:0:1,0:0:1,9:9:1 --uncertainty a=1e-3 --noise lengths=1e-3",
    ),
    ("robot of a study not there", "study run study_robot.json"),
    ("unknown field deep in a study", "study run study_law.json"),
    ("unknown error model", "study run study_model.json"),
    ("unknown field in a study", "study run study_unknown.json"),
    ("invalid operating point", "study run study_point.json"),
    ("noisy record", "cable modulus noisy.csv --breaking-force 10290 --section 1e-5 --length 1 --range 5-10"),
    ("record without range", "cable modulus record.csv --breaking-force 10290 --section 1e-5 --length 1"),
    (
        "noisy record of cables",
        "hysteresis robot.json --law noisy.csv --length 1 --pose 0,0,1.75 --payload 50",
    ),
    (
        "length in other units",
        "hysteresis robot.json --law record.csv --length 0.001 --pose 0,0,1.75 --payload 50",
    ),
    (
        "record without phase",
        "hysteresis robot.json --law no_phase.csv --length 1 --pose 0,0,1.75 --payload 50",
    ),
    ("record without length", "hysteresis robot.json --law record.csv --pose 0,0,1.75 --payload 50"),
    ("length of a law", "hysteresis robot.json --law law.json --length 1 --pose 0,0,1.75 --payload 50"),
    ("no law at all", "hysteresis robot.json --pose 0,0,1.75 --payload 50"),
    (
        "law whose tensions do not grow",
        "hysteresis robot.json --law law_order.json --pose 0,0,1.75 --payload 50",
    ),
    ("law of negative modulus", "hysteresis robot.json --law law_modulus.json --pose 0,0,1.75 --payload 50"),
    ("another format of law", "hysteresis robot.json --law law_format.json --pose 0,0,1.75 --payload 50"),
    ("robot for a study", "study run robot.json"),
    ("law for a robot", "robot check law.json"),
    ("study for a law", "hysteresis robot.json --law study.json --pose 0,0,1.75 --payload 50"),
    ("robot file in UTF-16", "robot check utf16.json"),
    ("device for a robot", "robot check /dev/zero"),
    ("device for cases", "direct robot.json --from /dev/zero"),
    ("two samplings of one name", "study run twice.json"),
    ("run without study", "run study.json"),
    ("merge without study", "merge results"),
    ("report of a study", "study report results"),
    ("check of a study", "study check study.json"),
    ("forward model", "forward robot.json"),
    ("payload of a study", "study run study.json --payload 50"),
    ("negative payload of the direct model", "direct robot.json --payload -5 --lengths"),
    ("payload of a check", "robot check robot.json --payload 50"),
    ("robot as an option", "inverse --robot robot.json --pose 0,0,1.75"),
    ("pose without option", "inverse robot.json 0,0,1.75"),
    ("JSON as an option", "robot check robot.json --json"),
    ("output", "workspace robot.json --region z=1.75 --output there"),
    ("samples", "study run study.json --samples 100"),
];

#[test]
fn every_kind_of_bad_input_is_refused_with_place_value_and_remedy() {
    let folder = TempDir::new().unwrap();
    prepare(folder.path());
    let mut messages = String::new();
    for (what, line) in CASES {
        let mut arguments: Vec<_> = line.split_whitespace().collect();
        if line.ends_with("--lengths") {
            arguments.push(LENGTHS);
        }
        let output = cdpr_in(folder.path(), &arguments);
        let error = unwrapped(output.stderr);
        let code = output.status.code().unwrap();
        assert!(code == 1 || code == 2, "{what}: {code}: {error}");
        assert!(output.stdout.is_empty(), "{what}");
        assert!(!error.contains("panicked"), "{what}: {error}");
        writeln!(messages, "# {what}\n$ cdpr {}\n[{code}] {}\n", arguments.join(" "), error.trim_end())
            .unwrap();
    }
    insta::assert_snapshot!(messages);
}
