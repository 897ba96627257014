//! Large and hostile files: each of these took minutes or gigabytes where a reader compares all with all.

use crate::fixtures::{BODIES, CABLES_OF_CASPR, IRMA, TABLE, WIREX, YAML, all_options, imported};
use cdpr_exchange::{ExchangeError, NoteKind};

const MANY: usize = 100_000;

fn refused(file: &str, text: &str) -> String {
    imported(&[(file, text)], &all_options()).map(|found| found.robot.name).unwrap_err().to_string()
}

/// Texts with so many entries each of which a robot lacks, imported with notes that do not grow with them.
fn questioned(file: &str, text: &str) -> usize {
    let found = imported(&[(file, text)], &all_options()).unwrap_or_else(|error| panic!("{file}: {error}"));
    let length: usize = found.notes.iter().map(|note| note.text.len()).sum();
    assert!(length < 20_000, "{file}: {length}");
    assert!(found.notes.iter().any(|note| note.kind == NoteKind::Questioned), "{file}");
    found.robot.cables.len()
}

#[test]
fn a_hundred_thousand_empty_elements_are_read_one_after_the_other() {
    let one_line = format!("<models>{}</models>", "<a/>".repeat(MANY));
    assert!(refused("r.xml", &one_line).contains("models/robot is missing"));
    let many_lines = format!("<models>{}</models>", "<a/>\n".repeat(MANY));
    assert!(refused("r.xml", &many_lines).contains("models/robot is missing"));
    let different: String = (0..MANY).map(|i| format!("<a{i}/>")).collect();
    let wirex = WIREX.replace("<controller", &format!("{different}<controller"));
    assert_eq!(questioned("r.wcrfx", &wirex), 2);
    let winches: String = (0..MANY / 2).map(|i| format!("<winch name=\"w{i}\"/>")).collect();
    let chains =
        "<chain winchtype=\"w7\"><base x=\"1\" y=\"2\" z=\"3\"/><platform x=\"1\" y=\"2\" z=\"3\"/></chain>";
    let wirex = WIREX
        .replace("<winch name", &format!("{winches}<winch name"))
        .replace("</geometry>", &format!("{}</geometry>", chains.repeat(10_000)));
    assert!(refused("r.wcrfx", &wirex).contains("a list of 10002: expected at most 200 cables"));
    let caspr = CABLES_OF_CASPR.replace("</cables>", &format!("{}</cables>", "<cable_set/>".repeat(MANY)));
    let found = imported(&[("b.xml", BODIES), ("c.xml", &caspr)], &all_options()).unwrap();
    assert_eq!(found.robot.cables.len(), 2);
}

#[test]
fn entities_are_not_expanded() {
    let letters = "a".repeat(4000);
    let uses = "&x;".repeat(500);
    let bomb = format!(
        "<!DOCTYPE models [<!ENTITY x \"{letters}\"><!ENTITY y \"{uses}\">]><models>{}</models>",
        "&y;".repeat(300)
    );
    let error = imported(&[("r.wcrfx", &bomb)], &all_options()).map(drop).unwrap_err();
    assert!(matches!(error, ExchangeError::Syntax { line: 1, column: 1, .. }), "{error}");
    assert!(error.to_string().contains("a document type with entities of its own: expected none"));
    // A type that is declared elsewhere or declares attributes, as in CASPR's files, is not refused.
    assert!(BODIES.contains("<!DOCTYPE bodies_system SYSTEM"));
    let declared = "<!DOCTYPE cables [ <!ATTLIST cable_set id ID #REQUIRED> ]>";
    let end = CABLES_OF_CASPR.find("?>").map_or(0, |found| found + 2);
    let cables = CABLES_OF_CASPR[end..].trim_start();
    let cables = cables
        .strip_prefix("<!DOCTYPE")
        .and_then(|rest| rest.split_once('>'))
        .map_or(cables, |(_, rest)| rest);
    let found =
        imported(&[("b.xml", BODIES), ("c.xml", &format!("{declared}{cables}"))], &all_options()).unwrap();
    assert_eq!(found.robot.cables.len(), 2);
}

#[test]
fn attributes_depths_namespaces_and_numbers_have_bounds_of_their_own() {
    let attributes: String = (0..20_000).map(|i| format!(" a{i}=\"0\"")).collect();
    let too_large = |file: &str, text: &str, said: &str| {
        let error = imported(&[(file, text)], &all_options()).map(drop).unwrap_err();
        assert!(matches!(error, ExchangeError::TooLarge { .. }), "{error}");
        assert!(error.to_string().contains(said), "{error}");
    };
    too_large("r.xml", &format!("<models{attributes}/>"), "more than 200 attributes of an element");
    let spaces: String = (0..100).map(|i| format!("<a xmlns:n{i}=\"u{i}\">")).collect();
    too_large("r.xml", &spaces, "more than 50 namespaces");
    let many = format!("<models>{}</models>", "<a/>".repeat(600_000));
    too_large("r.xml", &many, "more than 500000 elements and attributes");
    let many = format!("points: [{}]", "1, ".repeat(600_000));
    too_large("r.yaml", &many, "more than 500000 elements, attributes and values");
    let deep = format!("{}{}", "<a b='<'>".repeat(2000), "</a>".repeat(2000));
    assert!(refused("r.xml", &deep).contains("nested more than 64 deep"));
    for open in ["<!--", "<![CDATA[", "<?", "<a b=\"", "<!DOCTYPE", "<"] {
        let message = refused("r.xml", &format!("<models>{}", open.repeat(50_000)));
        assert!(message.starts_with("r.xml, line 1, column "), "{message}");
    }
}

#[test]
fn a_hundred_thousand_keys_actuators_and_columns_are_read_one_after_the_other() {
    let keys: String = (0..MANY).map(|i| format!("k{i}: 0\n")).collect();
    assert_eq!(questioned("r.yaml", &format!("{YAML}{keys}")), 8);
    assert!(refused("r.yaml", &keys).contains("it has neither `points` nor `actuator`"));
    let inactive = "{\"active\": false},".repeat(MANY / 2);
    let irma = IRMA.replace("{\"active\": false, \"pulley\": {}, \"winch\": {}},", &inactive);
    let irma = irma.replace("\"platform\"", "\"pos_unknown\": 1, \"platform\"");
    assert_eq!(questioned("r.json", &irma), 1);
    let names: String = (0..MANY).map(|i| format!(",c{i}")).collect();
    let mut lines = TABLE.lines();
    let header = format!("{}{names}", lines.next().unwrap());
    let rows: String = lines.map(|line| format!("{line}{}\n", ",".repeat(MANY))).collect();
    assert_eq!(questioned("r.csv", &format!("{header}\n{rows}")), 2);
    let rows = "2,1.5,3,-0.2,0.1,0,,,,,blue\n".repeat(MANY);
    assert!(refused("r.csv", &format!("{TABLE}{rows}")).contains("expected at most 200 cables"));
}
