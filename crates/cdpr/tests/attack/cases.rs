//! The cases: good files with every value of them made bad in turn, damaged texts, arguments, and what
//! strangers have put into folders.

use super::case::{Case, split};
use serde_json::{Value, json};
use std::fs;
use std::io;
use std::path::Path;

/// A kind of file with a good example, and the command that reads it.
struct Kind {
    name: &'static str,
    good: String,
    command: &'static str,
}

/// Places a small study, its robot and other good inputs in the folder.
pub(super) fn prepare(folder: &Path) -> io::Result<()> {
    for Kind { name, good, .. } in kinds()? {
        fs::write(folder.join(name), good)?;
    }
    fs::write(folder.join("victim.csv"), "somebody's own")
}

fn kinds() -> io::Result<[Kind; 6]> {
    let read = |file: &str| {
        let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data");
        fs::read_to_string(data.join(file))
    };
    let study = small(serde_json::from_str(&read("studies/caroca.json")?)?);
    Ok([
        Kind {
            name: "robot.json",
            good: read("robots/caroca.json")?,
            command: "inverse robot.json --pose 0,0,1.75 --format json",
        },
        Kind { name: "study.json", good: study.to_string(), command: "study run study.json --format json" },
        Kind {
            name: "law.json",
            good: read("cables/caroca-4mm-law.json")?,
            command: "hysteresis robot.json --law law.json --pose 0,0,1.75 --payload 50 --format json",
        },
        Kind {
            name: "record.csv",
            good: read("cables/caroca-4mm-record.csv")?,
            command: "cable modulus record.csv --breaking-force 10290 --section 1.2566e-5 --length 1 --range 5-10",
        },
        Kind {
            name: "case.json",
            good: json!({"lengths": [4.44, 4.54, 4.36, 4.26, 4.26, 4.36, 4.54, 4.44], "mass": 180.0,
                "force": [0.0, 0.0, -10.0], "moment": [0.0, 0.0, 0.0], "start": [0.0, 0.0, 1.75]})
            .to_string(),
            command: "direct robot.json --from case.json --format json",
        },
        Kind {
            name: "poses.txt",
            good: "0,0,1.75\n0.5,0,1.5\n0,0.5,2,1,0,0,0\n".to_owned(),
            command: "calibrate identify robot.json --poses poses.txt --uncertainty a=2e-3 \
                      --noise lengths=1e-3",
        },
    ])
}

/// A study that takes a tenth of a second.
fn small(mut study: Value) -> Value {
    study["robot"] = json!("robot.json");
    study["replicates"] = json!(2);
    study["bootstrap_resamples"] = json!(2);
    for (field, value) in [("samplings", "observations"), ("surfaces", "")] {
        let Some(parts) = study[field].as_object_mut() else { continue };
        let first: Vec<String> = parts.keys().skip(1).cloned().collect();
        first.iter().for_each(|name| {
            parts.remove(name);
        });
        for part in parts.values_mut() {
            if value.is_empty() {
                (part["x"]["points"], part["y"]["points"]) = (json!(3), json!(3));
            } else {
                part[value] = json!(20);
            }
        }
    }
    study
}

/// All cases.
pub(super) fn all() -> io::Result<Vec<Case>> {
    let mut cases = Vec::new();
    for kind in kinds()? {
        damaged(&kind, &mut cases);
        if let Ok(good) = serde_json::from_str::<Value>(&kind.good) {
            mutated(&kind, &good, &mut cases);
        }
    }
    arguments(&mut cases);
    strangers(&kinds()?, &mut cases)?;
    Ok(cases)
}

impl Kind {
    /// The case of a bad content of such a file.
    fn case(&self, what: String, content: Vec<u8>, may_succeed: bool) -> Case {
        // The good file of this name stays.
        let bad = format!("bad-{}", self.name);
        let mut arguments = split(&self.command.replace(&format!(" {}", self.name), &format!(" {bad}")));
        if self.name == "study.json" {
            arguments.extend(split("--out out"));
        }
        Case {
            what: format!("{}: {what}", self.name),
            files: vec![(bad, content)],
            arguments,
            may_succeed,
            ..Case::default()
        }
    }
}

/// A text cut off, with bytes of another encoding, or of another file.
fn damaged(kind: &Kind, cases: &mut Vec<Case>) {
    let good = kind.good.as_bytes();
    for k in 0..8 {
        let end = k * good.len() / 8;
        // Lines of a record or a list of poses that remain are good ones.
        let may_succeed = !kind.name.ends_with("json");
        cases.push(kind.case(format!("cut off after {end} bytes"), good[..end].to_vec(), may_succeed));
    }
    for (what, content) in [
        ("not UTF-8", [&good[..good.len() / 2], b"\xff\xfe", &good[good.len() / 2..]].concat()),
        ("NUL", vec![0; 1000]),
        ("deeply nested", vec![b'['; 200_000]),
        ("deeply nested objects", "{\"a\":".repeat(100_000).into_bytes()),
        ("one long line", vec![b'x'; 1_000_000]),
        ("a long number", vec![b'9'; 1_000_000]),
        ("many lines", "0,0\n".repeat(100_000).into_bytes()),
        ("escape sequences", "{\"\u{1b}[2J\u{202e}\": 1}".to_owned().into_bytes()),
    ] {
        cases.push(kind.case(what.to_owned(), content, false));
    }
    let marked = [b"\xef\xbb\xbf", good].concat();
    cases.push(kind.case("a byte order mark".to_owned(), marked, true));
    let wide = [b"\xff\xfe".to_vec(), good.iter().flat_map(|byte| [*byte, 0]).collect()].concat();
    // Tables are read in it, JSON is not.
    cases.push(kind.case("UTF-16".to_owned(), wide, !kind.name.ends_with("json")));
}

/// Each value replaced by others, left out, or given twice.
fn mutated(kind: &Kind, good: &Value, cases: &mut Vec<Case>) {
    let replacements = [
        json!(null),
        json!(-1),
        json!(0),
        json!(1e308),
        json!(5e-324),
        json!(u64::MAX),
        json!("\u{1b}]0;x\u{7}\u{202e}"),
        json!([]),
        json!({}),
        json!("x".repeat(300)),
    ];
    for (k, path) in paths(good).iter().enumerate() {
        // All replacements of the first places, and some of the others: cables are alike.
        let chosen = replacements.iter().enumerate().filter(|(r, _)| k < 24 || (r + k) % 5 == 0);
        for (_, replacement) in chosen {
            let mut bad = good.clone();
            if let Some(value) = bad.pointer_mut(path) {
                *value = replacement.clone();
            }
            let words: String = replacement.to_string().chars().take(20).collect();
            cases.push(kind.case(format!("{path} is {words}"), bad.to_string().into_bytes(), true));
        }
        let (parent, key) = path.rsplit_once('/').unwrap_or_default();
        let mut bad = good.clone();
        if let Some(map) = bad.pointer_mut(parent).and_then(Value::as_object_mut) {
            map.remove(key);
            cases.push(kind.case(format!("{path} is missing"), bad.to_string().into_bytes(), true));
        }
        if let Some(value) = good.pointer(path).filter(|_| !parent.is_empty() || good.is_object()) {
            let entry = format!("\"{key}\":{value}");
            let twice = good.to_string().replacen(&entry, &format!("{entry},{entry}"), 1);
            if twice.len() > good.to_string().len() {
                cases.push(kind.case(format!("{path} is given twice"), twice.into_bytes(), false));
            }
        }
    }
}

/// Pointers to all values within a value.
fn paths(value: &Value) -> Vec<String> {
    let inner: Vec<(String, &Value)> = match value {
        Value::Object(map) => map.iter().map(|(key, value)| (key.clone(), value)).collect(),
        Value::Array(list) => list.iter().enumerate().map(|(i, value)| (i.to_string(), value)).collect(),
        _ => Vec::new(),
    };
    let below = |(key, value): &(String, &Value)| {
        let path = format!("/{key}");
        let inner = paths(value).into_iter().map(|inner| format!("{path}{inner}")).collect::<Vec<_>>();
        [vec![path], inner].concat()
    };
    inner.iter().flat_map(below).collect()
}

/// Options with values that no option has.
fn arguments(cases: &mut Vec<Case>) {
    const VALUES: [&str; 14] = [
        "",
        "NaN",
        "inf",
        "-inf",
        "-1",
        "0",
        "1e308",
        "1e-308",
        "1e999",
        "18446744073709551616",
        "x",
        "1,2",
        "\u{663}",
        "0,0,1e308",
    ];
    const OPTIONS: [(&str, &str); 19] = [
        ("inverse robot.json", "--pose"),
        ("inverse robot.json --pose 0,0,1.75", "--payload"),
        ("inverse robot.json --pose 0,0,1.75", "--force"),
        ("deflection robot.json --pose 0,0,1.75", "--payload"),
        ("deflection robot.json --pose 0,0,1.75", "--moment"),
        ("stiffness robot.json --pose 0,0,1.75", "--payload"),
        ("derivatives robot.json --pose 0,0,1.75", "--payload"),
        ("direct robot.json", "--lengths"),
        ("direct robot.json --lengths 4.44,4.54,4.36,4.26,4.26,4.36,4.54,4.44", "--mass"),
        ("direct robot.json --lengths 4.44,4.54,4.36,4.26,4.26,4.36,4.54,4.44", "--pose"),
        ("cable catenary weight=1,stiffness=1e6 --end 4,-1", "--length"),
        ("cable catenary weight=1,stiffness=1e6 --end 4,-1", "--tension"),
        ("workspace robot.json --out out", "--region"),
        ("study run study.json --out out", "--observations"),
        ("study run study.json --out out", "--threads"),
        ("study run study.json --out out", "--shard"),
        ("cable density --length 2", "--mass"),
        ("cable density --mass 0.2", "--length"),
        ("study tolerances study.json --sampling mechanical --observations 100", "--limit"),
    ];
    for (command, option) in OPTIONS {
        // Numbers that are as good as others, but ask for hours.
        let long = ["--poses", "--observations"].contains(&option);
        for value in VALUES.iter().filter(|value| !long || value.parse::<usize>().is_err()) {
            let mut arguments = split(command);
            arguments.push(format!("{option}={value}"));
            let what = format!("{option} is {value}");
            cases.push(Case { what, arguments, may_succeed: true, ..Case::default() });
        }
    }
}

/// What strangers give, and what a careless user types.
fn strangers(kinds: &[Kind; 6], cases: &mut Vec<Case>) -> io::Result<()> {
    let [robot, study, ..] = kinds;
    let mut push = |what: &str, shell: Option<&str>, command: &str| {
        let (what, shell, arguments) = (what.to_owned(), shell.map(str::to_owned), split(command));
        cases.push(Case { what, shell, arguments, ..Case::default() });
    };
    for kind in kinds {
        for (what, path, shell) in [
            ("a device that never ends", "/dev/zero", None),
            ("a pipe that nobody writes into", "pipe", Some("mkfifo pipe")),
            ("a folder", ".", None),
            ("a link to itself", "loop", Some("ln -s loop loop")),
            ("the memory of the process", "/proc/self/mem", None),
            ("a file of a terabyte", "hole", Some("truncate -s 1T hole")),
        ] {
            let command = kind.command.replace(&format!(" {}", kind.name), &format!(" {path}"));
            let out = if kind.name == "study.json" { " --out out" } else { "" };
            push(&format!("{}: {what}", kind.name), shell, &format!("{command}{out}"));
        }
    }
    for command in [
        "run study.json",
        "merge out",
        "report out",
        "check study.json",
        "study run robot.json --out out",
        "study run study.json --out out --payload 50",
        "study run study.json --out out --threads 65535",
        "direct robot.json --payload 3",
        "study status nowhere",
        "study report nowhere",
        "study merge robot.json",
        "study extend out --observations 99",
    ] {
        push("a slip", None, command);
    }
    let mut push = |kind: &Kind, what: &str, change: &dyn Fn(&mut Value)| -> io::Result<()> {
        let mut bad: Value = serde_json::from_str(&kind.good)?;
        change(&mut bad);
        cases.push(kind.case(what.to_owned(), bad.to_string().into_bytes(), false));
        Ok(())
    };
    push(study, "a surface of 10000 x 10000", &|study| {
        for surface in study["surfaces"].as_object_mut().into_iter().flat_map(|all| all.values_mut()) {
            (surface["x"]["points"], surface["y"]["points"]) = (json!(10_000), json!(10_000));
        }
    })?;
    for confidence in [0.999_999_999_999_999_9, 0.0, 1.0, -0.5] {
        push(study, "a confidence", &|study| study["confidence"] = json!(confidence))?;
    }
    for name in
        ["x".repeat(255), "../victim".to_owned(), "a/b".to_owned(), String::new(), "\u{1b}".to_owned()]
    {
        push(study, "a name of a sampling", &|study| {
            let sampling = study["samplings"]["mechanical"].clone();
            study["samplings"][&name] = sampling;
        })?;
    }
    push(study, "observations without end", &|study| {
        study["samplings"]["mechanical"]["observations"] = json!(u64::MAX);
    })?;
    push(robot, "400 cables", &|robot| {
        let cable = |k: u32| {
            let angle = 0.1 * f64::from(k);
            json!({"exit_point": [4.0 * angle.cos(), 4.0 * angle.sin(), 3.0 + 0.001 * f64::from(k)],
                "anchor_point": [0.2 * angle.sin(), 0.2 * angle.cos(), 0.1]})
        };
        robot["cables"] = (0..400).map(cable).collect();
    })
}
