//! What many poses have as a whole: a sentence, and on a terminal a table of few columns.

use crate::program::arguments::poses::place;
use crate::program::output::{Ending, print_sentence, table};
use crate::program::pose::at_pose::row::{Brief, Failure, Row};
use cdpr_robot::{Pose, counted, significant};

/// Poses that the table has a row for.
const SHOWN: usize = 20;

/// Kinds of failures that the sentence names.
const KINDS: usize = 2;

/// The poses so far.
#[derive(Default)]
pub(crate) struct Along {
    /// Lines of the table of poses, if it has lines.
    lines: Option<Vec<usize>>,
    poses: usize,
    held: usize,
    jumps: usize,
    /// What is wrong, at how many poses, and the first of them.
    wrong: Vec<(String, usize, usize)>,
    /// Why the first pose without an answer has none.
    reason: Option<String>,
    extremes: Vec<Extreme>,
    /// Cells of the first poses, and the headers of what is brief in them.
    headers: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// What a number was at the poses so far.
struct Extreme {
    brief: Brief,
    /// Index of the pose of its extreme.
    pose: usize,
}

impl Extreme {
    fn pass(&mut self, brief: Brief, pose: usize) {
        let is_farther = match (&mut self.brief, &brief) {
            (Brief::Tensions(_, [least, greatest]), Brief::Tensions(_, [low, high])) => {
                (*least, *greatest) = (least.min(*low), greatest.max(*high));
                false
            }
            (Brief::Most(_, _, known), Brief::Most(_, _, value)) => *value > *known,
            (Brief::Least(_, _, known), Brief::Least(_, _, value)) => {
                value.is_some_and(|value| known.is_none_or(|known| value < known))
            }
            _ => false,
        };
        if is_farther {
            *self = Self { brief, pose };
        }
    }

    /// In the sentence, if it is known.
    fn words(&self) -> Option<String> {
        let at = |name: &str, end: &str, value: f64, unit: &str| {
            let value = significant(value, 3);
            let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
            format!("{name} {end} {value}{unit} at pose {}", self.pose + 1)
        };
        match self.brief {
            Brief::Tensions(words, ends) => {
                let [least, greatest] = ends.map(|tension| significant(tension, 3));
                Some(format!("{words} {least} to {greatest} N"))
            }
            Brief::Most(name, unit, value) => value.map(|value| at(name, "up to", value, unit)),
            Brief::Least(name, unit, value) => value.map(|value| at(name, "down to", value, unit)),
            Brief::Shown(..) => None,
        }
    }
}

impl Along {
    /// Of poses that stand in these lines of a table.
    pub(super) fn of(lines: Option<Vec<usize>>) -> Self {
        Self { lines, ..Self::default() }
    }

    /// Adds the next pose.
    pub(super) fn pass<T: Row>(&mut self, pose: &Pose, answer: &Result<T, Failure>) {
        let number = self.poses;
        self.poses += 1;
        let (status, brief) = match answer {
            Ok(answer) => {
                self.held += 1;
                self.jumps += usize::from(answer.jumps());
                if answer.ending() == Ending::SomethingWrong {
                    self.add(answer.wrong(), number);
                }
                ("held".to_owned(), answer.brief())
            }
            Err(failure) => {
                self.add(words(failure.kind), number);
                if self.reason.is_none() {
                    self.reason = Some(format!("{}: {}.", self.place(number), failure.message));
                }
                let status = match failure.kind {
                    "infeasible_tension" => "no tensions".to_owned(),
                    kind => kind.replace('_', " "),
                };
                (status, Vec::new())
            }
        };
        if self.rows.len() < SHOWN {
            self.show(pose, status, &brief);
        }
        for (k, brief) in brief.into_iter().enumerate() {
            match self.extremes.get_mut(k) {
                Some(known) => known.pass(brief, number),
                None => self.extremes.push(Extreme { brief, pose: number }),
            }
        }
    }

    fn add(&mut self, what: String, pose: usize) {
        match self.wrong.iter_mut().find(|(known, ..)| *known == what) {
            Some((_, count, _)) => *count += 1,
            None => self.wrong.push((what, 1, pose)),
        }
    }

    /// Keeps a row of the table.
    fn show(&mut self, pose: &Pose, status: String, brief: &[Brief]) {
        if self.headers.is_empty() {
            self.headers = brief.iter().flat_map(Brief::headers).collect();
        }
        let number = |value: Option<f64>| value.map_or_else(String::new, |value| significant(value, 4));
        let cells = brief.iter().flat_map(Brief::values).map(number);
        let first = [self.place(self.poses - 1), place(pose), status];
        self.rows.push(first.into_iter().chain(cells).collect());
    }

    /// Where a pose stands: `line 3`, or `pose 3` where the list has no lines.
    fn place(&self, pose: usize) -> String {
        match self.lines.as_ref().and_then(|lines| lines.get(pose)) {
            Some(line) => format!("line {line}"),
            None => format!("pose {}", pose + 1),
        }
    }

    /// How many poses are held, why others are not, and the extremes of those that are.
    pub(super) fn sentence(&self) -> String {
        let held = format!("{} of {} held", self.held, counted(self.poses, "pose"));
        let mut wrong: Vec<_> = self.wrong.iter().collect();
        wrong.sort_by_key(|(_, count, first)| (std::cmp::Reverse(*count), *first));
        let kind = |(what, count, first): &&(String, usize, usize)| {
            let first_of = if *count > 1 { "first at" } else { "at" };
            format!("{count} {what}, {first_of} {}", self.place(*first))
        };
        let named: Vec<String> = wrong.iter().take(KINDS).map(kind).collect();
        let others: usize = wrong.iter().skip(KINDS).map(|(_, count, _)| count).sum();
        let others = (others > 0).then(|| format!("{others} with other reasons"));
        let wrong: Vec<String> = named.into_iter().chain(others).collect();
        let mut extremes: Vec<String> = self.extremes.iter().filter_map(Extreme::words).collect();
        if self.jumps > 0 {
            extremes.push(format!("{} of the lengths", counted(self.jumps, "jump")));
        }
        let extremes = extremes.join(", ");
        match (wrong.is_empty(), extremes.is_empty()) {
            (true, true) => format!("{held}."),
            (true, false) => format!("{held}, {extremes}."),
            (false, true) => format!("{held}; {}.", wrong.join("; ")),
            (false, false) => format!("{held}; {}. Those held: {extremes}.", wrong.join("; ")),
        }
    }

    /// Prints the sentence and a table of few columns, with what the whole one is asked for by.
    pub(super) fn print(&self) {
        print_sentence(&self.sentence());
        let headers = ["pose", "at", "status"].into_iter().chain(self.headers.iter().map(String::as_str));
        let headers: Vec<_> = headers.collect();
        let mut rows = table(&headers);
        for cells in &self.rows {
            let blank = vec![String::new(); headers.len().saturating_sub(cells.len())];
            rows.add_row([cells.clone(), blank].concat());
        }
        println!("{rows}");
        self.reason.iter().for_each(|reason| print_sentence(reason));
        let more = match self.poses - self.rows.len() {
            0 => String::new(),
            more => format!("{} not shown. ", counted(more, "further pose")),
        };
        print_sentence(&format!("{more}All columns and reasons: --out FILE.csv, or --format csv."));
    }
}

/// A kind of failure behind a count of poses.
fn words(kind: &str) -> String {
    match kind {
        "infeasible_tension" => "without feasible tensions".to_owned(),
        "inverse_not_converged" | "direct_not_converged" => "without a solution that was found".to_owned(),
        "branch_ends" => "at which the platform falls".to_owned(),
        "cable_overstrained" => "with a cable that is strained too much".to_owned(),
        other => other.replace('_', " "),
    }
}
