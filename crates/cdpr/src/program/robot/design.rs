//! `cdpr design`: values of a robot that make it as good as possible for poses and a load.

mod words;

use crate::program::arguments::{
    Format, Overwrite, Preference, RobotArgument, Threads, endings, print_record,
};
use crate::program::error::ProgramError;
use crate::program::output::{Ending, patiently, print_sentence, table};
use crate::program::questions;
use crate::program::robot::design::words::{
    WITHIN, crossing, evaluations, noun, optimum, own, titled, tried, value,
};
use cdpr_assess::{
    ActiveDemand, BestDesign, BestOfTypes, ChosenCable, Design, DesignProblem, DesignedVariable, Front,
    FrontPoint, Goal, design, front,
};
use cdpr_robot::{Robot, counted, shown, significant};
use std::path::PathBuf;
use std::time::Instant;

/// The robot and what may change.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    robot: RobotArgument,
    /// What may change, for which poses and load, and what is to be as good as possible (JSON,
    /// `cdpr-design/1`).
    design: PathBuf,
    #[command(flatten)]
    preference: Preference,
    /// Robot file of the best robot; of a front best-1.json, best-2.json and so on for best.json.
    #[arg(short, long, value_parser = endings::json())]
    out: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
    #[command(flatten)]
    threads: Threads,
    /// How the results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    settings.threads.start()?;
    let robot = settings.preference.open_robot(settings.robot.path())?;
    let problem = DesignProblem::open(&settings.design, robot.clone())?;
    questions::about_design(&settings.design, problem.doubts());
    if problem.has_front() {
        let found = patiently("looking for the best robots", || front(&problem))?;
        return answer_front(settings, &robot, &found);
    }
    let clock = Instant::now();
    let found = patiently("looking for the best robot", || design(&problem))?;
    let seconds = clock.elapsed().as_secs_f64();
    if let (Some(out), Some(best)) = (&settings.out, &found.best) {
        settings.overwrite.write(out, format!("{}\n", best.robot.to_json()))?;
    }
    settings.format.print(&found, |found| {
        print(&robot, found, seconds);
        if let (Some(out), Some(best)) = (&settings.out, &found.best) {
            println!("{}: {}", out.display(), shown(&best.robot.name));
        }
    })?;
    Ok(if found.best.is_some() { Ending::Well } else { Ending::SomethingWrong })
}

/// Writes and prints a front.
fn answer_front(settings: &Settings, robot: &Robot, found: &Front) -> Result<Ending, ProgramError> {
    let mut written = Vec::new();
    if let Some(out) = &settings.out {
        let stem = out.file_stem().unwrap_or_default().to_string_lossy();
        for (k, point) in found.points.iter().enumerate() {
            let path = out.with_file_name(format!("{stem}-{}.json", k + 1));
            settings.overwrite.write(&path, format!("{}\n", point.robot.to_json()))?;
            written.push(path.display().to_string());
        }
    }
    if settings.format == Format::Csv {
        print_table(found);
    } else {
        settings.format.print(found, |found| {
            print_front(robot, found);
            if let ([first, ..], Some(last)) = (&written[..], written.last()) {
                println!("{first} to {last}");
            }
        })?;
    }
    Ok(if found.points.is_empty() { Ending::SomethingWrong } else { Ending::Well })
}

/// A front as CSV: a row for each point.
fn print_table(found: &Front) {
    let columns = ["exchange", "kkt_residual", "optimal"].map(str::to_owned);
    let variables = found.variables.iter().map(|(name, _)| name.clone());
    let cables = has_types(found).then(|| "cables".to_owned());
    print_record(
        &found.names.iter().cloned().chain(columns).chain(variables).chain(cables).collect::<Vec<_>>(),
    );
    for point in &found.points {
        let FrontPoint { objectives, variables, exchange, kkt_residual, optimal, .. } = point;
        let number = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:?}"));
        let [one, two] = objectives.map(|value| number(Some(value)));
        let cells = [one, two, number(*exchange), number(*kkt_residual), optimal.to_string()];
        let variables = variables.iter().map(|value| number(Some(*value)));
        let cables = has_types(found).then(|| types(&point.cables));
        print_record(&cells.into_iter().chain(variables).chain(cables).collect::<Vec<_>>());
    }
}

/// Whether a front chooses types of cable.
fn has_types(found: &Front) -> bool {
    found.points.iter().any(|point| !point.cables.is_empty())
}

/// The types of the groups, in their order.
fn types(chosen: &[ChosenCable]) -> String {
    chosen.iter().map(|of| shown(&of.name)).collect::<Vec<_>>().join(", ")
}

fn print_front(robot: &Robot, found: &Front) {
    /// Variables with columns of their own.
    const MOST: usize = 4;
    let [one, two] = [0, 1].map(|i| noun(found.over[i], found.outputs[i], found.poses));
    let name = shown(&robot.name);
    let tried = tried(found.starts, found.configurations);
    if found.points.is_empty() {
        let reason =
            found.reason.as_ref().map_or_else(String::new, |reason| format!(" The first one: {reason}."));
        print_sentence(&format!("{name}: no robot was found that holds all poses, in {tried}.{reason}"));
        return;
    }
    let points = counted(found.points.len(), "robot");
    let each = if found.starts == 0 { ", all of them evaluated" } else { " for each" };
    print_sentence(&format!(
        "{name}: the {one} against the {two}, {points} of which none is better in both ({tried}{each})."
    ));
    found.basis.iter().for_each(|basis| print_sentence(basis));
    found.left_laws.iter().for_each(|laws| print_sentence(laws));
    let held = found.points.len() + found.dominated;
    let made = match found.starts {
        0 => format!("{held} of {} hold {WITHIN}", counted(found.configurations, "configuration")),
        _ => evaluations(found.evaluations),
    };
    let dominated = match found.dominated {
        0 => String::new(),
        count => format!("; {count} of {held} robots left out, as good as another or worse in both"),
    };
    let lost = match found.lost {
        0 => String::new(),
        count => format!("; no robot was found for {} between the ends", counted(count, "step")),
    };
    print_sentence(&format!("{made}{dominated}{lost}."));
    let doubtful: Vec<String> =
        (1..).zip(&found.points).filter(|(_, of)| !of.optimal).map(|(k, _)| k.to_string()).collect();
    if !doubtful.is_empty() {
        print_sentence(&format!("No local optimum, by the KKT residual: {}.", doubtful.join(", ")));
    }
    let exchange = match found.outputs.map(Goal::unit) {
        ["", ""] => "exchange".to_owned(),
        [unit, ""] => format!("exchange [{unit}]"),
        ["", unit] => format!("exchange [1/({unit})]"),
        [one, two] => format!("{one} per {two}"),
    };
    let [one, two] = found.outputs.map(titled);
    let mut header = vec!["".to_owned(), one, two];
    if found.starts > 0 {
        header.push(exchange);
    }
    let named = if found.variables.len() > MOST { &[][..] } else { &found.variables[..] };
    header.extend(named.iter().map(|(name, unit)| format!("{} [{unit}]", shown(name))));
    if has_types(found) {
        header.push("cables".to_owned());
    }
    let mut rows = table(&header.iter().map(String::as_str).collect::<Vec<_>>());
    for (k, point) in (1..).zip(&found.points) {
        let mut cells = vec![k.to_string()];
        cells.extend(point.objectives.map(|value| significant(value, 4)));
        if found.starts > 0 {
            cells.push(point.exchange.map_or_else(String::new, |rate| significant(rate, 3)));
        }
        cells.extend(point.variables.iter().take(named.len()).map(|of| value(*of)));
        if has_types(found) {
            cells.push(types(&point.cables));
        }
        rows.add_row(&cells);
    }
    println!("{rows}");
    if named.len() < found.variables.len() {
        print_sentence("--format csv and json have the values of the variables.");
    }
}

fn print(robot: &Robot, found: &Design, seconds: f64) {
    let Some(best) = &found.best else {
        print_sentence(&none(robot, found));
        return;
    };
    let basis = found.basis.map(str::to_owned);
    let first =
        [Some(verdict(robot, found, best)), basis, found.left_laws.clone(), Some(ends(found, best, seconds))];
    for sentence in first
        .into_iter()
        .chain([optimum(found.output, best), demands(found, best), own(best), crossing(best)])
        .flatten()
    {
        print_sentence(&sentence);
    }
    let per_unit = format!("{} per unit", found.output.unit()).trim_start().to_owned();
    // Choices have no bounds.
    let columns = if found.starts == 0 { 3 } else { 5 };
    let mut rows = table(&["variable", "from", "to", "bound", &per_unit][..columns]);
    for DesignedVariable { name, unit, from, to, bound, per_unit, flat } in &best.variables {
        let worth = || if *flat { "flat".to_owned() } else { significant(*per_unit, 3) };
        let per_unit = bound.map_or_else(String::new, |_| worth());
        let name = format!("{} [{unit}]", shown(name));
        let cells = [name, value(*from), value(*to), bound.unwrap_or_default().to_owned(), per_unit];
        rows.add_row(&cells[..columns]);
    }
    if !best.variables.is_empty() {
        println!("{rows}");
    }
    if !best.cables.is_empty() {
        print_cables(found, best);
    }
}

/// The types of cable that are chosen, and what the others lead to.
fn print_cables(found: &Design, best: &BestDesign) {
    /// Combinations of types with rows of their own.
    const MOST: usize = 12;
    let optional =
        |number: Option<f64>, digits| number.map_or_else(String::new, |of| significant(of, digits));
    let mut rows = table(&["cables", "type", "length [m]", "mass [kg]", "cost"]);
    for ChosenCable { cables, name, length, mass, cost } in &best.cables {
        let numbers = cables.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        let [length, mass] = [length, mass].map(|of| significant(*of, 4));
        rows.add_row([numbers, shown(name).into(), length, mass, optional(*cost, 4)]);
    }
    println!("{rows}");
    if best.cable_types.len() > MOST || best.cable_types.is_empty() {
        print_sentence("--format json has the best robot of each choice of types, up to 1000 choices.");
        return;
    }
    // A cost has its column anyway.
    let with_objective = found.output != Goal::Cost;
    let objective = titled(found.output);
    let mut columns = vec!["best with", &objective, "mass [kg]", "cost"];
    if !with_objective {
        columns.remove(1);
    }
    let mut rows = table(&columns);
    let mut reasons = Vec::new();
    for BestOfTypes { types, objective, cost, mass, reason } in &best.cable_types {
        let types = types.iter().map(|name| shown(name)).collect::<Vec<_>>().join(", ");
        reasons.extend(reason.iter().map(|reason| format!("With {types} no robot counts: {reason}.")));
        let objective = objective.map_or_else(|| "none".to_owned(), |of| significant(of, 4));
        let cost =
            cost.map_or_else(|| if with_objective { "" } else { "none" }.to_owned(), |of| significant(of, 4));
        let mut cells = vec![types, objective, optional(*mass, 4), cost];
        if !with_objective {
            cells.remove(1);
        }
        rows.add_row(cells);
    }
    println!("{rows}");
    reasons.iter().for_each(|reason| print_sentence(reason));
}

fn none(robot: &Robot, found: &Design) -> String {
    let poses = if found.poses == 1 { "the pose".to_owned() } else { format!("all {} poses", found.poses) };
    let reason =
        found.reason.as_ref().map_or_else(String::new, |reason| format!(" The first one: {reason}."));
    let name = shown(&robot.name);
    format!(
        "{name}: no robot was found that holds {poses} within the limits, in {}.{reason}",
        tried(found.starts, found.configurations)
    )
}

/// What becomes of the objective, and of how many it is the best.
fn verdict(robot: &Robot, found: &Design, best: &BestDesign) -> String {
    /// A smaller share is rounding, and no change.
    const NONE: f64 = 1e-9;
    let after = best.objective;
    let amount = |value| found.output.amount(&significant(value, 4));
    let becomes = match found.before {
        Some(before) if (after - before).abs() <= NONE * before.abs() => {
            format!("stays at {}", amount(after))
        }
        Some(before) => {
            let verb = if after < before { "falls" } else { "rises" };
            format!("{verb} from {} to {}", significant(before, 4), amount(after))
        }
        None => format!("becomes {}", amount(after)),
    };
    let all = match (found.starts, found.left) {
        (0, 0) => ", all of them evaluated",
        (0, _) => ", all of them compared",
        _ => "",
    };
    format!(
        "{}: the {} {becomes} (best of {}{all}).",
        shown(&robot.name),
        noun(found.over, found.output, found.poses),
        tried(found.starts, found.configurations)
    )
}

/// How many starts or configurations lead where, in which time, and what the robot as it is lacks.
fn ends(found: &Design, best: &BestDesign, seconds: f64) -> String {
    let total = found.configurations * found.starts.max(1);
    let lost = total - found.feasible;
    let searches = if found.starts == 0 {
        let left = match found.left {
            0 => String::new(),
            left => format!("; {left} were left at a pose where they are worse than the two best ones"),
        };
        format!("{} of {total} configurations hold {WITHIN}{left}", found.feasible)
    } else {
        let elsewhere = found.feasible - best.same;
        let what = if found.configurations == 1 { "starts" } else { "searches" };
        let lost =
            if lost == 0 { String::new() } else { format!(", {lost} at no robot that holds {WITHIN}") };
        format!("{} of {total} {what} end there, {elsewhere} elsewhere{lost}", best.same)
    };
    let next = best.next_configuration.map_or_else(String::new, |next| {
        format!("; the next best configuration has {}", found.output.amount(&significant(next, 4)))
    });
    let before = match (found.before, found.feasible_before) {
        (_, true) => "",
        (Some(_), false) => " The robot as it is does not meet the limits.",
        (None, false) if found.output == Goal::Cost => {
            " The robot as it is does not hold all poses within the limits."
        }
        (None, false) => " The robot as it is does not hold all poses.",
    };
    let work = match found.starts {
        0 => format!("; all in {} s on this machine", significant(seconds, 2)),
        _ => format!("; {}", evaluations(found.evaluations)),
    };
    format!("{searches}{next}{work}.{before}")
}

/// The demands that keep the objective from being better.
fn demands(found: &Design, best: &BestDesign) -> Option<String> {
    const MOST: usize = 4;
    let gain = |of| format!("{} for 1 %", found.output.amount(&significant(of, 2)));
    let one = |ActiveDemand { pose, output, cable, per_percent }: &ActiveDemand| {
        let what = match (output, cable) {
            (Some(output), Some(cable)) => {
                format!("the limit of the {} of cable {}", output.noun(), cable + 1)
            }
            (Some(output), None) => format!("the limit of the {}", output.noun()),
            (None, cable) => format!("the greatest tension of cable {}", cable.unwrap_or(0) + 1),
        };
        format!("{what} at pose {} ({})", pose + 1, gain(*per_percent))
    };
    let mut active: Vec<&ActiveDemand> = best.active.iter().collect();
    active.sort_by(|a, b| b.per_percent.total_cmp(&a.per_percent));
    let mut named: Vec<String> = active.iter().take(MOST).map(|demand| one(demand)).collect();
    for (goal, rate) in [("cost", best.cost_per_percent), ("length", best.length_per_percent)] {
        named.extend(rate.map(|of| format!("the limit of the {goal} ({})", gain(of))));
    }
    let more = active.len().saturating_sub(MOST);
    let more = if more == 0 { String::new() } else { format!(", and {more} more") };
    (!named.is_empty()).then(|| format!("What prevents a better one: {}{more}.", named.join(", ")))
}
