//! Every option of every command, as the program's own `--help` lists them, with values that are too small,
//! too large, negative, empty, or no numbers.

use super::PROGRAM;
use super::case::{Case, split};
use std::fs;
use std::io;
use std::path::Path;
use std::process::Command;

/// A good call of each command in the folder of all cases.
const CALLS: [&str; 32] = [
    "cable catenary weight=1,stiffness=1e6 --length 4.3 --end 4,-1",
    "inverse robot.json --pose 0,0,1.75",
    "direct robot.json --lengths 4.44,4.54,4.36,4.26,4.26,4.36,4.54,4.44",
    "deflection robot.json --pose 0,0,1.75 --payload 50",
    "stiffness robot.json --pose 0,0,1.75",
    "capacity robot.json --pose 0,0,1.75",
    "safety robot.json --pose 0,0,1.75",
    "safety robot.json --pose 0,0,1.75 --with permanent=1.35,variable=1.5,accidental=1:0.5,resistance=2",
    "path robot.json --poses poses.txt --payload 50",
    "workspace robot.json --region ::3,::3,1.75 --payload 50 --out out",
    "design robot.json design.json --out out/best.json",
    "explore robot.json --out out/page.html",
    "robot check robot.json",
    "study new robot.json",
    "study run study.json --out out",
    "study merge out",
    "study status out",
    "study extend out --observations 200",
    "calibrate fit robot.json measured.csv --parameters mass --noise position=1e-3,length=1e-3 --out out",
    "calibrate identify robot.json --poses poses.txt --uncertainty a=2e-3 --noise lengths=1e-3",
    "calibrate plan robot.json --poses poses.txt --uncertainty a=2e-3 --noise lengths=1e-3 --number 2",
    "calibrate simulate robot.json --poses poses.txt --uncertainty study.json:table_3 \
     --noise length=1e-3 --seed 1 --out out/measured.csv",
    "calibrate pulleys expo2015-lucia cycle.csv --pose 0,0,2",
    "derivatives robot.json --pose 0,0,1.75 --payload 50",
    "hysteresis robot.json --law law.json --pose 0,0,1.75 --payload 50",
    "cable density --mass 0.203 --length 2",
    "modes robot.json --pose 0,0,1.75 --with servo=1e6,winch=5",
    "response robot.json --pose 0,0,1.75 --below 10 --number 5",
    "path robot.json --poses poses.txt --with seconds=2,shaper=zvd,modes=2,feed-forward,rate=20",
    "simulate robot.json --pose 0,0,1.75 --events events.json --until 0.02",
    "cable modulus record.csv --breaking-force 10290 --section 1.2566e-5 --length 1 --range 5-10",
    "study tolerances study.json --sampling mechanical --observations 100 --limit deflection_mm<1",
];

/// Calls whose commands read other files: their options name files, folders and words.
const OTHERS: [&str; 9] = [
    "robot export robot.json --to mjcf --pose 0,0,1.75 --out out/robot.xml",
    "robot export robot.json --to table --region 0:0.1:2,0,1.75 --out out/table.csv",
    "robot import points.csv --cable steel-4mm --mass 100 --tension-limits 1,5000",
    "analyse measured.csv",
    "study report out",
    "robot list",
    "robot show cogiro",
    "completions bash",
    "man",
];

/// Options that name files to write: other cases give them names.
const WRITTEN: [&str; 4] = ["--out", "--figure", "--truth", "--law"];

const VALUES: [&str; 9] =
    ["", "NaN", "-1", "0", "1e-308", "1e308", "1000000000", "18446744073709551615", "\u{663}"];

/// Places the files that only these calls read.
pub(super) fn prepare(folder: &Path) -> io::Result<()> {
    let row = "4.44,4.54,4.36,4.26,4.26,4.36,4.54,4.44";
    let rows: String = (0..6).map(|k| format!("0,0,1.75{k},{row}\n")).collect();
    let header = "x_m,y_m,z_m,l1_m,l2_m,l3_m,l4_m,l5_m,l6_m,l7_m,l8_m\n";
    let design = r#"{"format": "cdpr-design/1", "variables": [{"parameters": ["b1.x"], "choices": [-3.5, -3]}],
        "poses": {"list": [{"position": [0, 0, 1.75]}]}, "payload": 50,
        "objective": {"output": "deflection", "over": "worst"}}"#;
    fs::write(folder.join("design.json"), design)?;
    fs::write(folder.join("events.json"), "[{\"t\": 0, \"payload\": 1}]")?;
    fs::write(folder.join("measured.csv"), format!("{header}{rows}"))?;
    let cycle = "payload_kg,t1_winch_n,t1_n\n0,400,400\n10,440,410\n20,455,420\n10,390,410\n0,380,400\n";
    fs::write(folder.join("cycle.csv"), cycle)?;
    fs::write(folder.join("points.csv"), "bx,by,bz,ax,ay,az\n1,1,1,0.1,0.1,0\n-1,1,1,-0.1,0.1,0\n")
}

/// All cases, from the help of the program.
///
/// # Errors
/// An error of the system, and a command that no call stands for.
pub(super) fn all() -> io::Result<Vec<Case>> {
    let mut cases = Vec::new();
    for command in names(&help(&[])?) {
        let call = CALLS.iter().chain(&OTHERS).find(|call| starts_with(&split(call), &command));
        let call = call.ok_or_else(|| io::Error::other(format!("no call of `{}`", command.join(" "))))?;
        for option in options(&help(&command)?) {
            if WRITTEN.contains(&option.as_str()) {
                continue;
            }
            // Numbers that are as good as others, but ask for hours.
            let long = ["--observations", "--poses"].contains(&option.as_str());
            for value in VALUES.iter().filter(|value| !(long && value.parse::<u64>().is_ok_and(|n| n > 0))) {
                let mut arguments = without(split(call), &option);
                arguments.push(format!("{option}={value}"));
                let what = format!("{}: {option} is {value:?}", command.join(" "));
                cases.push(Case { what, arguments, may_succeed: true, ..Case::default() });
            }
        }
    }
    Ok(cases)
}

fn starts_with(call: &[String], command: &[String]) -> bool {
    call.len() >= command.len() && call[..command.len()] == *command
}

fn help(command: &[String]) -> io::Result<String> {
    let output = Command::new(PROGRAM).args(command).arg("--help").output()?;
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// The commands, as the help of the program lists them in groups.
fn names(help: &str) -> Vec<Vec<String>> {
    let groups = help.split("Options:").next().unwrap_or_default();
    let lines = groups.lines().filter(|line| line.starts_with("  ") && !line.starts_with("  Example"));
    let words = lines.filter_map(|line| line.trim_start().split("  ").next());
    words.map(|words| words.split(' ').map(str::to_owned).collect()).collect()
}

/// The options with values that a help lists.
fn options(help: &str) -> Vec<String> {
    let option = |line: &str| {
        let line = line.trim_start();
        let option = line.split([' ', '[', '=']).find(|word| word.starts_with("--"))?;
        let rest = &line[line.find(option)? + option.len()..];
        let takes = [" <", "=<", " [<", "[=<"].iter().any(|begin| rest.starts_with(begin));
        (line.starts_with('-') && takes).then(|| option.to_owned())
    };
    help.lines().filter_map(option).collect()
}

/// A call without an option and its value.
fn without(mut call: Vec<String>, option: &str) -> Vec<String> {
    if let Some(place) = call.iter().position(|word| word == option) {
        call.drain(place..(place + 2).min(call.len()));
    }
    call
}

#[test]
fn commands_are_found_in_the_groups_of_the_help() {
    let help = "A\n\nUsage: cdpr <COMMAND>\n\nRobots:\n  inverse            Find it\n  robot list  List\n  \
                Example: cdpr x\n\nOptions:\n  -h, --help  Print help\n";
    assert_eq!(names(help), [vec!["inverse"], vec!["robot", "list"]]);
}

#[test]
fn options_with_values_are_found_in_a_help() {
    let help = "Options:\n      --pose <POSE>\n          Pose: --rpy <X>\n  -o, --out <FILE>\n      \
                --overwrite\n      --with <NAMES>\n      --rpy <ROLL> <PITCH> <YAW>\n";
    assert_eq!(options(help), ["--pose", "--out", "--with", "--rpy"]);
}

#[test]
fn the_value_of_a_call_goes_with_its_option() {
    assert_eq!(without(split("a --b 1 --c 2"), "--b"), ["a", "--c", "2"]);
    assert_eq!(without(split("a --c 2"), "--b"), ["a", "--c", "2"]);
}
