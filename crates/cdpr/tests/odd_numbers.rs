//! Tiny, huge and other odd numbers for every number of a command: an answer whose residuals are small, or an
//! error that says which value is wrong; never a panic, never a wait.

use crate::common::{cdpr, text, unwrapped};
use serde_json::Value;
use std::time::{Duration, Instant};

/// Numbers that overflow in a product or a quotient, and texts that are not finite numbers.
const ODD: [&str; 19] = [
    "0",
    "-0",
    "-1",
    "5e-324",
    "1e-300",
    "-1e-300",
    "1e-150",
    "1e-30",
    "1e-12",
    "1e12",
    "1e15",
    "-1e15",
    "1e30",
    "1e150",
    "1e300",
    "-1e300",
    "1.7976931348623157e308",
    "1e400",
    "nan",
];

/// Commands whose number in braces is replaced.
const COMMANDS: [&str; 38] = [
    "inverse caroca --pose 0,0,1.75 --payload {50}",
    "inverse caroca --pose 0,0,{1.75}",
    "inverse caroca --pose 0,0,1.75 --rpy {5},0,0",
    "inverse caroca --pose 0,0,1.75 --force={10},0,0",
    "inverse caroca --pose 0,0,1.75 --moment=0,0,{1}",
    "inverse caroca --pose 0,0,1.75 --tension-reference {900}",
    "inverse four-cables --pose 0.5,0.3,2 --free roll,pitch --payload {5}",
    "inverse four-cables --pose {0.5},0.3,2 --free roll,pitch",
    "direct cogiro --lengths {9},9,9,9,9,9,9,9",
    "direct cogiro --lengths 9,9,9,9,9,9,9,9 --payload {5}",
    "deflection cogiro --pose 0,0,2 --payload {100}",
    "deflection cogiro --pose 0,0,2 --force=0,{100},0",
    "deflection cogiro --pose 0,0,2 --moment=0,{100},0",
    "stiffness caroca --pose {0},0,1.75",
    "stiffness caroca --pose 0,0,1.75 --payload {10}",
    "modes cogiro --pose 0,0,2 --payload {10}",
    "modes cogiro --pose 0,0,2 --inertia {10},20,20",
    "modes cogiro --pose 0,0,2 --number 3 --with servo=1e6,winch={10}",
    "modes cogiro --pose 0,0,2 --number 3 --with servo={1e6},winch=10",
    "derivatives caroca --pose 0,0,1.75 --payload {10}",
    "capacity cogiro --pose 0,0,2 --payload {10}",
    "capacity cogiro --pose 0,0,2 --force=0,{10},0",
    "safety cogiro --pose 0,0,2 --payload {10}",
    "safety caroca --pose 0,0,1.75 --with permanent={1.35},variable=1.5,accidental=1,resistance=2",
    "capacity ipanema-3 --pose 0.2,0.1,{1.3}",
    "hysteresis caroca-law --pose 0,0,1.75 --payload {50} --with steps=3",
    "hysteresis caroca-law --pose 0,0,{1.75} --payload 50 --with steps=3",
    "hysteresis caroca-law --pose 0,0,1.75 --payload 50 --with steps={3}",
    "hysteresis expo2015-lucia --pose 0,0,2 --payload 50 --with steps=2,friction={0.05}",
    "hysteresis expo2015-lucia --pose 0,0,2 --payload 50 --with steps=2,bearing={0.01}",
    "calibrate pulleys expo2015-lucia ../../data/calibration/expo2015-lucia-load-cycle.csv --pose 0.2,0.1,{2}",
    "cable catenary weight={1},stiffness=1e6 --length 11 --end 10,1",
    "cable catenary weight=1,stiffness={1e6} --length 11 --end 10,1",
    "cable catenary weight=1,stiffness=1e6 --length {11} --end 10,1",
    "cable catenary weight=1,stiffness=1e6 --length 11 --end {10},1",
    "cable catenary weight=1,stiffness=1e6 --tension {100} --end 10,1",
    "cable catenary weight=1,stiffness=1e6 --length 11 --end-force {100},50",
    "robot export caroca --pose 0,0,{1.75} --to moorpy",
];

fn arguments(command: &str, number: &str) -> Vec<String> {
    let (before, rest) = command.split_once('{').unwrap();
    let (_, after) = rest.split_once('}').unwrap();
    format!("{before}{number}{after}").split(' ').map(str::to_owned).collect()
}

/// Residual force of every equilibrium in an answer over its greatest tension.
fn residuals(answer: &Value, greatest: &mut f64, worst: &mut f64) {
    match answer {
        Value::Object(fields) => {
            for (name, value) in fields {
                if name.contains("tensions")
                    && let Some(list) = value.as_array()
                {
                    *greatest = list.iter().filter_map(Value::as_f64).fold(*greatest, |a, t| a.max(t.abs()));
                }
                if name == "residual"
                    && let Some(force) = value["force_n"].as_f64()
                {
                    *worst = worst.max(force);
                }
                residuals(value, greatest, worst);
            }
        }
        Value::Array(list) => list.iter().for_each(|value| residuals(value, greatest, worst)),
        _ => {}
    }
}

#[test]
fn odd_numbers_have_an_answer_in_balance_or_an_error_that_names_them() {
    let mut faults = Vec::new();
    for command in COMMANDS {
        for number in ODD {
            let mut arguments = arguments(command, number);
            let is_json = !command.starts_with("robot export");
            if is_json {
                arguments.extend(["--format", "json"].map(str::to_owned));
            }
            let clock = Instant::now();
            let output = cdpr(&arguments.iter().map(String::as_str).collect::<Vec<_>>());
            let took = clock.elapsed();
            let (said, printed) = (unwrapped(output.stderr), text(output.stdout));
            let mut fault = |why: &str| {
                faults.push(format!(
                    "{}: {why}\n    {}",
                    arguments.join(" "),
                    said.lines().next().unwrap_or("")
                ));
            };
            if said.contains("panicked") {
                fault("panics");
            }
            if took > Duration::from_secs(20) {
                fault(&format!("takes {took:.1?}"));
            }
            match output.status.code() {
                Some(1 | 2) if said.trim().is_empty() => fault("no reason"),
                Some(1 | 2) => {}
                Some(0 | 3) if is_json => match serde_json::from_str::<Value>(&printed) {
                    Err(error) => fault(&format!("{error}")),
                    Ok(answer) => {
                        let (mut greatest, mut worst) = (0.0, 0.0);
                        residuals(&answer, &mut greatest, &mut worst);
                        if worst > 1e-8 * greatest {
                            fault(&format!("a residual of {worst} N next to {greatest} N"));
                        }
                    }
                },
                Some(0 | 3) => {}
                code => fault(&format!("ends with {code:?}")),
            }
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}
