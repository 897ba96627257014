//! Broken files: each message names element and line.

use crate::fixtures::{BODIES, CABLES_OF_CASPR, IRMA, TABLE, WIREX, YAML, all_options, imported};

/// Files, what is replaced in them by what, the line that the message names, and what it says.
type Case<'a> = (&'a [(&'a str, &'a str)], &'a str, &'a str, usize, &'a str);

/// The message of files in one of which `from` is replaced by `to`.
fn message(files: &[(&str, &str)], from: &str, to: &str) -> String {
    let broken: Vec<(&str, String)> =
        files.iter().map(|(name, text)| (*name, text.replacen(from, to, 1))).collect();
    let is_changed = broken.iter().zip(files).any(|((_, broken), (_, text))| broken != text);
    assert!(is_changed, "{from} does not occur");
    let broken: Vec<(&str, &str)> = broken.iter().map(|(name, text)| (*name, text.as_str())).collect();
    imported(&broken, &all_options()).map(|found| found.robot.name).unwrap_err().to_string()
}

#[test]
fn broken_files_of_caspr_are_refused_with_element_and_line() {
    let caspr = [("b.xml", BODIES), ("c.xml", CABLES_OF_CASPR)];
    all_refused(&[
        (&caspr, "</physical>", "", 17, "b.xml"),
        (&caspr, "<mass>91.058</mass>", "", 7, "physical/mass is missing"),
        (&caspr, "91.058", "heavy", 8, "physical/mass is \"heavy\": expected a finite number"),
        (
            &caspr,
            "-0.034 -0.013 0.264",
            "-0.034 -0.013",
            9,
            "com_location is a list of 2: expected 3 numbers",
        ),
        (&caspr, "SPATIAL_EULER_XYZ", "R_Z", 6, "joint/@type is \"R_Z\": expected SPATIAL_*"),
        (&caspr, "ref=\"com\"", "ref=\"world\"", 11, "inertia/@ref is \"world\": expected com or joint"),
        (
            &caspr,
            "</link_rigid>",
            "</link_rigid><link_rigid/>",
            17,
            "links/link_rigid[2] is a further one: expected one link",
        ),
        (&caspr, "<num>0</num>", "<num>1</num>", 16, "parent/num is \"1\": expected 0, the frame"),
        (
            &caspr,
            "set=\"pulleys\"",
            "set=\"other\"",
            1,
            "cable_set is \"other\": expected one of pulleys, springs",
        ),
        (
            &caspr,
            "<fixed_location>1.659 -2.850 3.221",
            "<fixed_location>1.659 -2.850 nan",
            7,
            "fixed_location is",
        ),
        (
            &caspr,
            "<pulley_radius>0.045</pulley_radius>",
            "",
            6,
            "base_rotating_pulley/pulley_radius is missing",
        ),
        (&caspr, "cable_ideal name=\"1\"", "cable_vsd_flexure_linear name=\"1\"", 13, "c.xml"),
        (
            &caspr,
            "<link>1</link>",
            "<link>2</link>",
            11,
            "link is \"2\": expected 0, the frame, or 1, the platform",
        ),
        (
            &caspr,
            "reference=\"joint\"",
            "reference=\"end\"",
            3,
            "@attachment_reference is \"end\": expected joint or com",
        ),
        (&caspr, "base_rotating_pulley>\n", "screw_drive_rotating_pulley>\n", 10, "c.xml"),
    ]);
}

#[test]
fn other_broken_files_are_refused_with_element_and_line() {
    let (wirex, yaml) = ([("r.wcrfx", WIREX)], [("r.yaml", YAML)]);
    let (irma, table) = ([("r.json", IRMA)], [("r.csv", TABLE)]);
    all_refused(&[
        (&wirex, "z=\"5.462\"", "", 5, "chain[1]/base/@z is missing"),
        (&wirex, "a33=\"0.8\"", "a33=\"up\"", 5, "chain[1]/base/@a33 is \"up\": expected a finite number"),
        (&wirex, "mass=\"25\"", "mass=\"\"", 13, "platform/@mass is empty: expected a finite number"),
        (&wirex, "<geometry>", "<geometry", 4, "r.wcrfx"),
        (&wirex, "models version=\"0.31\"", "modells", 20, "r.wcrfx"),
        (&yaml, "mass: 150", "mass: heavy", 9, "platform/mass is \"heavy\": expected a finite number"),
        (&yaml, "[3.5, -2.0, 3.5]", "[3.5, -2.0]", 15, "points[3]/frame is a list of 2: expected 3 numbers"),
        (&yaml, "  mass: 150", "  mass: [150", 11, "r.yaml"),
        (&irma, "\"pos_OD_glob\"", "\"pos_PD_loc\"", 5, "actuator[1]/pulley/pos_OD_glob is missing"),
        (&irma, "\"mass\": 1,", "\"mass\": 1, \"mass\": 2,", 10, "the key `mass` stands twice"),
        (&table, "anchor_z,radius", "anchor_w,radius", 1, "anchor_z is missing: expected the columns exit_x"),
        (&table, "2,1.5,3", "2,left,3", 3, "column exit_y: `left`: expected a number"),
        (&table, "-1,red", ",red", 2, "axis_z is empty: expected a finite number"),
    ]);
}

/// Each of these changes is refused in these words.
fn all_refused(cases: &[Case]) {
    let mut wrong = Vec::new();
    for (files, from, to, line, said) in cases {
        let message = message(files, from, to);
        println!("{message}");
        if !(message.contains(&format!("line {line}, column ")) && message.contains(said)) {
            wrong.push(format!("{from} -> {to}: expected line {line}, {said}: {message}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn files_that_do_not_go_together_and_files_of_unknown_formats_are_refused() {
    let refused =
        |files: &[(&str, &str)]| imported(files, &all_options()).map(|_| ()).unwrap_err().to_string();
    assert_eq!(
        refused(&[("b.xml", BODIES)]),
        "b.xml: expected the cables of CASPR (*_cables.xml) with the bodies"
    );
    assert_eq!(
        refused(&[("r.yaml", YAML), ("r.csv", TABLE)]),
        "r.yaml, r.csv: expected the files of one robot"
    );
    assert!(refused(&[("r.xml", "<robot/>")]).starts_with("r.xml: its root is <robot>: expected the bodies"));
    for (from, to, said) in [
        (
            "cable_ideal",
            "cable_vsd_flexure_linear",
            "line 3, column 5: cables/cable_set[1]/cable_vsd_flexure_linear[1]",
        ),
        (
            "base_rotating",
            "screw_drive_rotating",
            "line 6, column 9: cables/cable_set[1]/cable_ideal[1]/attachments/",
        ),
    ] {
        let message = refused(&[("b.xml", BODIES), ("c.xml", &CABLES_OF_CASPR.replace(from, to))]);
        assert!(message.contains(said), "{message}");
        let others = "are not imported; this is the cable set pulleys, the file also has springs";
        assert!(message.ends_with(others), "{message}");
    }
    let empty = CABLES_OF_CASPR.replace("set=\"pulleys\"", "set=\"none\"");
    let empty = empty.replace("</cables>", "<cable_set id=\"none\"/></cables>");
    let message = refused(&[("b.xml", BODIES), ("c.xml", &empty)]);
    let others = "at least one cable; this is the cable set none, the file also has pulleys, springs";
    assert!(message.ends_with(others), "{message}");
    assert!(refused(&[("r.json", "{\"format\": 1}")]).contains("it is a file of this program"));
    let deep = format!("{}{}", "[".repeat(10_000), "]".repeat(10_000));
    assert!(
        refused(&[("r.json", &deep)]).contains("r.json, line 1, column "),
        "{}",
        refused(&[("r.json", &deep)])
    );
    let deep = format!("{}{}", "<a>".repeat(10_000), "</a>".repeat(10_000));
    assert!(refused(&[("r.xml", &deep)]).contains("nested more than 64 deep"));
}

#[test]
fn a_robot_that_cannot_be_is_refused_by_its_field() {
    let twice = message(
        &[("r.yaml", YAML)],
        "{frame: [-3.5, -2.0, 3.5], platform: [-0.6, 0.3, 0.2]}",
        "{frame: [-3.5, -2.0, 3.5], platform: [0.6, -0.3, -0.2]}",
    );
    assert!(twice.starts_with("the files make no robot: cable 2, cables[1] is coincident"), "{twice}");
}
