//! `cargo xtask evidence`: runs the cases of `data/evidence/cases.json`, keeps their figures in
//! `data/evidence` and writes the tables of the book.
//!
//! In a page, `<!-- evidence CABLE -->` stands above the table of the cases `V-CABLE-...`, and
//! `<!-- figure V-CABLE-001 -->` before a figure in a sentence; `<!-- end -->` follows either.

use crate::cargo::{Outcome, cargo_command, done, emptied, read as read_page, root, write as write_page};
use crate::runs;
use cdpr_evidence::{Acceptance, Case, FOLDER, Level, cases, read, write};
use std::path::{Path, PathBuf};

/// Pages with tables or figures of cases.
const PAGES: [&str; 2] = ["docs/trust.md", "README.md"];

/// By what factor a figure may differ from the one that is kept: sums are in another order with another
/// vector unit, and errors near rounding follow.
const CHANGED: f64 = 5.0;
/// Figures below this share of their bound may differ by more.
const FAR_BELOW: f64 = 1e-3;

/// Runs the cases whose identifiers begin with one of these, or all. A check runs nothing: it compares the
/// figures of a folder, which a run of the tests has written, with those that are kept.
pub(crate) fn run(check: bool, begins: &[String]) -> Outcome {
    let all = cases()?;
    if check {
        let folder = std::env::var_os(FOLDER).ok_or_else(|| format!("expected {FOLDER}, the folder"))?;
        return check_all(&all, Path::new(&folder));
    }
    let is_chosen = |case: &&Case| begins.is_empty() || begins.iter().any(|id| case.id.starts_with(id));
    let chosen: Vec<&Case> = all.iter().filter(is_chosen).collect();
    if chosen.is_empty() {
        return Err(format!("no case begins with {}", begins.join(" or ")).into());
    }
    measure(&chosen)?;
    for page in PAGES.map(|page| root().join(page)) {
        let text = read_page(&page)?;
        let filled = filled(&text, &all)?;
        if filled != text {
            write_page(&page, &filled)?;
        }
    }
    Ok(())
}

fn kept() -> PathBuf {
    root().join("data/evidence")
}

/// Runs the tests of cases, and keeps their figures.
fn measure(chosen: &[&Case]) -> Outcome {
    let folder = root().join("target/evidence");
    emptied(&folder)?;
    let mut tests: Vec<&str> = chosen.iter().map(|case| case.test[1].as_str()).collect();
    tests.sort_unstable();
    tests.dedup();
    let mut command = cargo_command(&["test", "--no-fail-fast", "--test", "integration", "--", "--exact"]);
    let passed = done(command.args(tests).env(FOLDER, &folder));
    for case in chosen {
        write(&kept(), &case.id, read(&folder, &case.id)?)?;
    }
    runs::note(chosen.iter().map(|case| case.id.as_str()))?;
    passed
}

fn check_all(all: &[Case], folder: &Path) -> Outcome {
    let mut wrong: Vec<String> = Vec::new();
    for case in all {
        match (read(folder, &case.id), read(&kept(), &case.id)) {
            (Ok(found), Ok(kept)) if is_changed(case, found, kept) => {
                wrong.push(format!("{}: {found:e}, and {kept:e} is kept", case.id));
            }
            (Ok(_), Ok(_)) => {}
            (Err(error), _) | (_, Err(error)) => wrong.push(error),
        }
    }
    for page in PAGES {
        let text = read_page(&root().join(page))?;
        if filled(&text, all)? != text {
            wrong.push(format!("{page} has other figures than data/evidence"));
        }
    }
    if wrong.is_empty() {
        eprintln!("{} cases are as they are kept", all.len());
        return Ok(());
    }
    Err(format!("{}\nexpected the figures of `cargo xtask evidence`", wrong.join("\n")).into())
}

fn is_changed(case: &Case, found: f64, kept: f64) -> bool {
    match case.accepted {
        // Two digits are kept: the last one may differ by one, which the processor decides.
        _ if case.digits => {
            let last = 10_f64.powf(kept.abs().log10().floor() - 1.0);
            (found - kept).abs() > if last > 0.0 { 1.01 * last } else { 0.0 }
        }
        Acceptance::AtMost(bound) => {
            let [least, greatest] = [found.abs().min(kept.abs()), found.abs().max(kept.abs())];
            greatest > CHANGED * least && greatest > FAR_BELOW * bound
        }
        // Shares.
        Acceptance::AtLeast(_) => (found - kept).abs() > 0.01,
    }
}

/// A page with the figures that are kept.
fn filled(page: &str, all: &[Case]) -> Result<String, String> {
    let mut parts = page.split("<!-- ");
    let mut filled = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (mark, rest) = part.split_once(" -->").ok_or("a comment without an end")?;
        filled += &format!("<!-- {mark} -->");
        match mark.split_once(' ') {
            Some(("evidence", group)) => filled += &table(group, all)?,
            Some(("figure", id)) => filled += &shown(read(&kept(), id)?),
            _ => filled += rest,
        }
    }
    Ok(filled)
}

/// The table of the cases of a group.
fn table(group: &str, all: &[Case]) -> Result<String, String> {
    let of_group = all.iter().filter(|case| case.id.split('-').nth(1) == Some(group));
    let rows = of_group.map(row).collect::<Result<Vec<_>, _>>()?;
    if rows.is_empty() {
        return Err(format!("no case is called V-{group}-..."));
    }
    let head = "| case | what | compared with | figure | found | accepted |\n|---|---|---|---|---|---|\n";
    Ok(format!("\n\n{head}{}\n", rows.concat()))
}

fn row(case: &Case) -> Result<String, String> {
    let level = match case.level {
        Level::Analytic => "exact",
        Level::Independent => "independent",
        Level::Experiment => "experiment",
    };
    let found = read(&kept(), &case.id)?;
    let (relation, bound) = match case.accepted {
        Acceptance::AtMost(bound) => ("≤", bound),
        Acceptance::AtLeast(bound) => ("≥", bound),
    };
    let verdict = if case.accepted.accepts(found) { "" } else { " **not accepted**" };
    let unit = if case.unit.is_empty() { String::new() } else { format!(" {}", case.unit) };
    let Case { id, what, reference, metric, .. } = case;
    Ok(format!(
        "| `{id}` | {what} | {level}: {reference} | {metric} | {}{unit} | {relation} {}{unit}{verdict} |\n",
        shown(found),
        shown(bound)
    ))
}

/// A figure as people write it.
fn shown(figure: f64) -> String {
    if figure == 0.0 || (1e-3..1e5).contains(&figure.abs()) {
        figure.to_string()
    } else {
        format!("{figure:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_changes_by_its_order_and_a_share_by_a_percent() {
        let changed = |accepted, digits, found, kept| {
            let case = Case { accepted, digits, ..cases().unwrap().remove(0) };
            is_changed(&case, found, kept)
        };
        let changes = |found, kept| changed(Acceptance::AtMost(1e-11), false, found, kept);
        assert!(!changes(2e-13, 6e-13) && changes(2e-13, 2e-12) && changes(2e-12, 2e-13));
        assert!(!changes(2e-16, 9e-15) && !changes(0.0, 0.0) && changes(1e-12, 0.0));
        let changes = |found, kept| changed(Acceptance::AtLeast(0.9), false, found, kept);
        assert!(!changes(0.999, 0.995) && changes(0.95, 0.999));
    }

    #[test]
    fn a_result_changes_by_its_second_digit() {
        let case = Case { digits: true, ..cases().unwrap().remove(0) };
        let changes = |found, kept| is_changed(&case, found, kept);
        assert!(!changes(0.91, 0.91) && !changes(0.92, 0.91) && changes(0.99, 0.91) && changes(1.4, 0.7));
        assert!(!changes(0.0, 0.0) && changes(0.1, 0.0) && !changes(1.2e-4, 1.1e-4) && changes(2e-4, 1e-4));
    }

    #[test]
    fn what_stands_outside_of_marks_stays() {
        let page = "A page <!-- of ours --> with a comment\n";
        assert_eq!(filled(page, &[]).unwrap(), page);
        assert!(filled("<!-- evidence NONE -->", &[]).is_err());
        assert!(filled("<!-- figure V-NONE-001 -->1<!-- end -->", &[]).is_err());
    }
}
