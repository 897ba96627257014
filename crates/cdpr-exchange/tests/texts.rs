//! Every text that is exported comes back from an independent parser.

use cdpr_exchange::{Target, export};
use cdpr_robot::library::{ROBOTS, named};
use cdpr_robot::{Pose, Robot};
use proptest::prelude::*;
use roxmltree::{Document, ParsingOptions};

/// A text as XML can have it: characters that it has no place for are written as JSON escapes them.
fn within_xml(text: &str) -> String {
    text.chars()
        .map(|c| match c {
            '\t' | '\n' | '\r' => c.to_string(),
            '\0'..'\u{20}' | '\u{fffe}' | '\u{ffff}' => format!("\\u{:04x}", u32::from(c)),
            c => c.to_string(),
        })
        .collect()
}

fn comes_back(name: &str, source: &str) {
    let mut robot = Robot::from_json(named(ROBOTS, "nist-robocrane").unwrap().text).unwrap();
    robot.name = name.to_owned();
    robot.provenance.source = Some(source.to_owned());
    let pose = Pose::at(0.0, 0.0, 1.5);
    let attribute = |text: &str, tag: &str, name: &str| {
        let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
        let document =
            Document::parse_with_options(text, options).unwrap_or_else(|error| panic!("{error}: {text}"));
        let node = document.descendants().find(|node| node.has_tag_name(tag)).unwrap();
        node.attribute(name).unwrap().to_owned()
    };
    let mujoco = &export(&robot, &pose, Target::Mjcf).unwrap().files[0].1;
    assert_eq!(attribute(mujoco, "mujoco", "model"), within_xml(name));
    assert_eq!(attribute(mujoco, "text", "data"), within_xml(source));
    let caspr = &export(&robot, &pose, Target::Caspr).unwrap().files[0].1;
    assert_eq!(attribute(caspr, "link_rigid", "name"), within_xml(name));
    // MoorPy has no texts of the robot: a line of dashes in one would begin a section.
    let plain = Robot { name: String::new(), provenance: Default::default(), ..robot.clone() };
    let moorpy = |robot: &Robot| export(robot, &pose, Target::Moorpy).unwrap().files;
    assert_eq!(moorpy(&robot), moorpy(&plain));
    assert_eq!(Robot::from_json(&robot.to_json()).unwrap().provenance, robot.provenance);
}

#[test]
fn dashes_and_characters_that_xml_forbids_come_back() {
    for text in [
        "a---b",
        "--",
        "-",
        "a--",
        "\u{fffe}",
        "\u{ffff}",
        "\0\u{1b}[2J",
        "\"'<>&&amp;",
        "]]>",
        "-->",
        "<!--",
        "?>",
        " a\t\n\r\u{85}\u{2028}b ",
        "----- LINES -----",
        "\u{1f916}\u{d7ff}\u{e000}",
    ] {
        comes_back(text, text);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn any_text_comes_back(
        name in any::<String>(),
        source in "(\\PC|[-<>&\"'\u{0}-\u{1f}\u{fffe}\u{ffff}]){0,40}",
    ) {
        comes_back(&name, &source);
    }
}
