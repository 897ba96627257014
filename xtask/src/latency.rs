//! `cargo xtask latency`: how long a step of a tracker takes, as data, a table and a figure of the book.

use crate::bench::{callgrind, total, valgrind};
use crate::cargo::{
    Outcome, emptied, load, machine, number, read, release_example, root, target, text, text_of, write,
};
use serde_json::{Value, json};
use std::fmt::Write as _;

const DATA: &str = "data/benchmarks/latency.json";

/// Percentiles of the table, by their names in the data.
const QUANTILES: [&str; 4] = ["median", "p99.99", "p99.999", "greatest"];

/// Follows the courses, and writes `data/benchmarks/latency.json`, its table and its figure.
pub(crate) fn run(rest: &[String]) -> Outcome {
    eprintln!("building the example (minutes the first time), then five passes of a course for each robot");
    let before = load();
    let mut robots = lines(&text_of(&mut release_example("cdpr-statics", "latency", rest), &[0])?)?;
    let machine = format!("{}, load average {before} before and {} after", machine(), load());
    save(&machine, &robots)?;
    if valgrind().is_some() {
        count(&mut robots)?;
        save(&machine, &robots)?;
    }
    let table = table(&machine, &robots);
    println!("{table}");
    write(&root().join("data/benchmarks/latency.md"), &table)?;
    write(&root().join("docs/images/latency.svg"), &figure(&robots))
}

/// A value of JSON in each line.
fn lines(text: &str) -> Outcome<Vec<Value>> {
    Ok(text.lines().map(serde_json::from_str).collect::<Result<_, _>>()?)
}

/// Writes the data, a robot in each line.
fn save(machine: &str, robots: &[Value]) -> Outcome {
    let lines: Vec<String> = robots.iter().map(ToString::to_string).collect();
    let text = format!("{{\"machine\": {}, \"robots\": [\n{}\n]}}\n", json!(machine), lines.join(",\n"));
    write(&root().join(DATA), &text)
}

/// Adds the instructions of the step of most iterations, which the example makes again under callgrind.
fn count(robots: &mut [Value]) -> Outcome {
    let folder = target().join("callgrind-latency");
    emptied(&folder)?;
    let example = target().join("release/examples/latency");
    let mut command = callgrind(&folder, "out", "latency::counted", example);
    let steps = text_of(command.arg("count").arg(root().join(DATA)), &[0])?;
    for (number, step) in lines(&steps)?.iter().enumerate() {
        let counted = total(&read(&folder.join(format!("out.{}", number + 1)))?);
        let robot = robots.iter_mut().find(|robot| robot["robot"] == step["robot"]);
        let most = &mut robot.ok_or("an unknown robot")?["most_work"];
        // A step that is not the same has no count.
        if step["iterations"] == most["iterations"] {
            most["instructions"] = json!(counted);
        }
    }
    Ok(())
}

/// A time [us] with three digits.
fn shown(us: &Value) -> String {
    let us = number(us);
    let digits = if us < 9.995 { 2 } else { usize::from(us < 99.95) };
    format!("{us:.digits$}")
}

/// The greatest number of iterations that a step has made.
fn most_iterations(robot: &Value) -> usize {
    let counts = robot["steps_by_iterations"].as_array();
    counts.and_then(|counts| counts.iter().rposition(|count| count.as_u64() != Some(0))).unwrap_or(0)
}

/// Why the longest step of the computation, and that of the first pass, took so long.
fn cause(robot: &Value) -> String {
    let worst = &robot["worst"];
    let end = if worst["converged"] == true { "" } else { ", not converged" };
    let again = worst["of_first_pass"]["us_in_each_pass"].as_array().cloned().unwrap_or_default();
    let (first, others) = (again.first().map_or(f64::NAN, number), again.iter().skip(1).map(number));
    let other = others.fold(f64::INFINITY, f64::min);
    let machine = if other < 0.5 * first {
        format!("the machine: {} µs in another pass", shown(&json!(other)))
    } else {
        "the step itself".to_owned()
    };
    format!("{} iterations{end} | {} | {machine}", worst["iterations"], shown(&json!(first)))
}

fn table(machine: &str, robots: &[Value]) -> String {
    let of = robots.iter().find(|robot| robot["error"].is_null()).unwrap_or(&Value::Null);
    let (steps, profile) = (&of["steps"], of["profile"].as_str().unwrap_or("unknown"));
    let mut table = format!(
        "{machine}, profile {profile}; {steps} steps of each robot\n\n\
         | robot | cables | median [µs] | 99.99 % [µs] | 99.999 % [µs] | greatest [µs] \
         | its cause | greatest of one pass [µs] | its cause | iterations at most | their instructions \
         | with slack cables | not converged |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n"
    );
    for robot in robots {
        let name = text(&robot["robot"]);
        if let Some(error) = robot["error"].as_str() {
            let _ = writeln!(table, "| {name} | {error} | | | | | | | | | | | |");
            continue;
        }
        let times = QUANTILES.map(|quantile| shown(&robot["us"][quantile])).join(" | ");
        let share = |count: &Value| match number(count) {
            0.0 => "0".to_owned(),
            count => format!("{:.3} %", 100.0 * count / number(&robot["steps"])),
        };
        let [slack, left] = ["with_slack_cables", "not_converged"].map(|count| share(&robot[count]));
        let instructions = robot["most_work"]["instructions"].as_u64();
        let instructions = instructions.map_or_else(|| "not counted".to_owned(), |count| count.to_string());
        let guides = if robot["plain"] == true { "" } else { ", guided or with laws" };
        let _ = writeln!(
            table,
            "| {name} | {}{guides} | {times} | {} | {} | {instructions} | {slack} | {left} |",
            robot["cables"],
            cause(robot),
            most_iterations(robot)
        );
    }
    table
}

/// Ends of the axis of time, as powers of ten of 0.1 us: 0.3 us to 30 ms.
const AXIS: [f64; 2] = [0.5, 5.5];
/// Bins of the histograms for each power of ten.
const BINS: f64 = 10.0;
/// Left end of the axis, its length, and the height of a row [pixels].
const LEFT: f64 = 170.0;
const WIDTH: f64 = 500.0;
const ROW: f64 = 28.0;

/// The place of a time on the axis, as a power of ten of 0.1 us [pixels].
fn across(power: f64) -> f64 {
    LEFT + WIDTH * (power.clamp(AXIS[0], AXIS[1]) - AXIS[0]) / (AXIS[1] - AXIS[0])
}

/// A row of bars for each robot: the height is the logarithm of the number of steps, so that one step is seen
/// among a million. Lines are the median (dashed) and the 99.999th percentile.
fn figure(robots: &[Value]) -> String {
    let robots: Vec<&Value> = robots.iter().filter(|robot| robot["error"].is_null()).collect();
    let bottom = 34.0 + ROW * robots.len() as f64;
    let words = |x: f64, y: f64, anchor: &str, words: &str| {
        format!("<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{words}</text>\n")
    };
    let line = |x: f64, foot: f64, top: f64, style: &str| {
        format!("<path d=\"M {x:.1} {foot:.1} V {top:.1}\" stroke={style}/>\n")
    };
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0} {:.0}\" font-family=\"sans-serif\" \
         font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        LEFT + WIDTH + 40.0,
        bottom + 44.0
    );
    svg += &words(LEFT, 18.0, "start", "Steps by their time: one pass (grey), least of all passes (blue)");
    for (power, label) in [(1.0, "1 µs"), (2.0, "10 µs"), (3.0, "100 µs"), (4.0, "1 ms"), (5.0, "10 ms")] {
        svg += &line(across(power), bottom, 26.0, "\"#cccccc\"");
        svg += &words(across(power), bottom + 16.0, "middle", label);
    }
    for (row, robot) in robots.iter().enumerate() {
        let foot = 34.0 + ROW * (row as f64 + 1.0) - 2.0;
        svg += &bars(&robot["histogram_of_first_pass"], foot, &robot["steps"], "#bbbbbb");
        svg += &bars(&robot["histogram"], foot, &robot["steps"], "#0072b2");
        for (quantile, dashes) in [("median", "3 2"), ("p99.999", "none")] {
            let x = across((number(&robot["us"][quantile]) / 0.1).log10());
            svg += &line(x, foot, foot + 4.0 - ROW, &format!("\"#d55e00\" stroke-dasharray=\"{dashes}\""));
        }
        svg += &words(LEFT - 8.0, foot - 6.0, "end", text(&robot["robot"]));
    }
    let axis = "time of a step; heights are logarithms of the number of steps";
    svg + &words(LEFT + 0.5 * WIDTH, bottom + 36.0, "middle", axis) + "</svg>\n"
}

/// The bars of a histogram that stands on `foot` [pixels].
fn bars(histogram: &Value, foot: f64, steps: &Value, color: &str) -> String {
    let mut path = String::new();
    for (bin, count) in histogram.as_array().into_iter().flatten().enumerate() {
        let count = number(count);
        if count > 0.0 {
            let (left, right) = (across(bin as f64 / BINS), across((bin as f64 + 1.0) / BINS));
            let height = (ROW - 6.0) * (1.0 + count).ln() / (1.0 + number(steps)).ln();
            let _ =
                write!(path, "M {left:.1} {foot:.1} v {:.1} h {:.1} V {foot:.1} Z ", -height, right - left);
        }
    }
    format!("<path d=\"{}\" fill=\"{color}\"/>\n", path.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn robot(us_in_each_pass: [f64; 3]) -> Value {
        json!({
            "robot": "a", "cables": 8, "plain": true, "steps": 1000, "profile": "release",
            "not_converged": 0, "with_slack_cables": 1,
            "us": { "median": 2.0, "p99.99": 3.0, "p99.999": 4.0, "greatest": 5.0 },
            "steps_by_iterations": [0, 0, 990, 10, 0], "most_work": { "instructions": 1234 },
            "histogram": [0, 999, 1], "histogram_of_first_pass": [0, 1000],
            "worst": {
                "us": 5.0, "iterations": 3, "converged": true,
                "of_first_pass": { "us_in_each_pass": us_in_each_pass }
            },
        })
    }

    #[test]
    fn a_step_that_is_fast_in_another_pass_was_interrupted() {
        assert!(cause(&robot([900.0, 4.0, 5.0])).contains("the machine: 4.00 µs in another pass"));
        assert!(cause(&robot([5.0, 4.0, 5.0])).ends_with("the step itself"));
    }

    #[test]
    fn a_row_has_the_greatest_number_of_iterations_and_a_robot_without_steps_its_reason() {
        let table = table("here", &[robot([5.0; 3]), json!({ "robot": "b", "error": "no steps" })]);
        assert!(
            table.contains("| a | 8 | 2.00 | 3.00 | 4.00 | 5.00 | 3 iterations | 5.00 | the step itself |")
        );
        assert!(table.contains(" | 3 | 1234 | 0.100 % | 0 |"));
        assert!(table.contains("| b | no steps |"));
    }

    #[test]
    fn one_step_among_many_has_a_bar() {
        let svg = figure(&[robot([5.0; 3])]);
        assert_eq!(svg.matches("Z").count(), 3, "{svg}");
    }
}
