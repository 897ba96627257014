//! `cdpr study tolerances`: the tolerances to tighten so that an error stays below a limit.

use crate::program::arguments::{self, Named, Preference, Printing, Threads};
use crate::program::error::ProgramError;
use crate::program::output::{Details, patiently, print_sentence, table};
use cdpr_assess::{Limit, Limited, PricedCalibration, Reached, Tolerance, ToleranceBudget, tolerance_budget};
use cdpr_robot::{shown, significant};
use cdpr_study::{ErrorModel, Estimate, OutputLimit};
use std::path::PathBuf;

/// The study, the sampling and the limit.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// Study file (JSON, `cdpr-study/1`), whose error model holds the tolerances.
    study: PathBuf,
    /// Name of the sampling: pose, load and error model; may be left out where the study has one only.
    #[arg(long)]
    sampling: Option<String>,
    /// What is limited: deflection_mm<VALUE, the static deflection under the load, or
    /// position_error_mm<VALUE, the distance from the wanted pose without load [mm].
    #[arg(long, value_name = "COLUMN<VALUE", value_parser = arguments::limit)]
    limit: (String, OutputLimit),
    /// Share of the robots that are to keep the limit.
    #[arg(long, value_parser = arguments::number, default_value = "0.95", allow_hyphen_values = true)]
    quantile: f64,
    /// Costs of the tolerances as they are, by entry of the error model: a=2,b=1; 1 if left out.
    ///
    /// Half the tolerance costs twice as much. Instead, `prices` of the study may say what tolerances and
    /// calibrations cost.
    #[arg(long, value_parser = arguments::named)]
    costs: Option<Named>,
    /// Independent robots that the budget is verified with.
    #[arg(long, default_value_t = 20_000, value_parser = arguments::count::<2, 100_000_000>)]
    observations: usize,
    #[command(flatten)]
    preference: Preference,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    details: Details,
    #[command(flatten)]
    printing: Printing,
}

pub(super) fn run(settings: &Settings) -> Result<(), ProgramError> {
    settings.threads.start()?;
    let (column, limit_mm) = arguments::upper(&settings.limit, &["deflection_mm", arguments::POSITION])
        .map_err(ProgramError::Usage)?;
    let limit = Limit {
        of: Some(if column == arguments::POSITION { Limited::Position } else { Limited::Deflection }),
        limit_mm,
        quantile: settings.quantile,
        costs: settings.costs.clone().map(|Named(costs)| costs.into_iter().collect()).unwrap_or_default(),
        verified_with: settings.observations,
    };
    limit.check()?;
    let study = patiently("checking the study", || settings.preference.open_study(&settings.study))?;
    let names: Vec<String> = study.sampling_names().collect();
    let name = match (&settings.sampling, names.as_slice()) {
        (Some(name), _) | (None, [name]) => name,
        (None, names) => {
            let expected = format!("expected --sampling with one of {}", names.join(", "));
            return Err(ProgramError::Usage(expected));
        }
    };
    let sampling = study.sampling(name)?;
    let budget = patiently("looking for the tolerances", || tolerance_budget(&sampling, &limit))?;
    let text = |budget: &ToleranceBudget| {
        print(budget, &sampling.errors);
        if settings.details.details {
            print_details(sampling.title, budget);
        }
    };
    Ok(settings.printing.format().print(&budget, text)?)
}

/// The answer, and each tolerance as it is and as it is to be.
fn print(budget: &ToleranceBudget, errors: &ErrorModel) {
    budget.sentences().iter().for_each(|sentence| print_sentence(sentence));
    let mut rows = match budget.priced {
        false => table(&["tolerance", "std now", "tighten to", "times", "share of variance [%]"]),
        true => table(&["tolerance", "std now", "std then", "share [%]", "spend", "by"]),
    };
    for tolerance in &budget.tolerances {
        let input = errors.entries.iter().position(|entry| *entry == tolerance.name);
        let unit = input.and_then(|input| errors.unit(input)).unwrap_or_default();
        let std = |value: f64| format!("{} {unit}", significant(value, 4)).trim_end().to_owned();
        let kept = tolerance.factor == 1.0;
        let tightened = |text: String| if kept { "-".to_owned() } else { text };
        let mut cells = vec![
            tolerance.name.clone(),
            std(tolerance.std),
            tightened(std(tolerance.std * tolerance.factor)),
            format!("{:.2}", 100.0 * tolerance.share),
        ];
        if budget.priced {
            cells.push(tightened(significant(tolerance.cost_then - tolerance.cost, 4)));
            cells.push(tolerance.by.unwrap_or_default().to_owned());
        } else {
            cells.insert(3, tightened(format!("{:.3}", tolerance.factor)));
        }
        rows.add_row(cells);
    }
    println!("{rows}");
    if budget.calibrations.is_empty() {
        return;
    }
    let mut rows = table(&["calibration", "cost", "do it", "saves"]);
    for PricedCalibration { name, cost, bought, saves } in &budget.calibrations {
        let saves = saves.map_or_else(|| "needed".to_owned(), |saves| significant(saves, 4));
        let bought = if *bought { "yes" } else { "no" };
        rows.add_row([name.clone(), significant(*cost, 4), bought.to_owned(), saves]);
    }
    println!("{rows}");
}

/// What each tolerance does alone and costs, and what independent robots say.
fn print_details(title: &str, budget: &ToleranceBudget) {
    println!("\n{}; without any deviation {:.4} mm", shown(title), budget.least_mm);
    if let Some(share) = budget.explained {
        println!("The linear law explains {} % of the variance.", significant(100.0 * share, 3));
    }
    let columns = ["tolerance", "quantile if it alone is halved [mm]", "cost now", "cost then"];
    let mut rows = table(&columns);
    for tolerance in &budget.tolerances {
        let bought = |digits: usize, number: f64| match tolerance.weather {
            true => "-".to_owned(),
            false => format!("{number:.digits$}"),
        };
        rows.add_row([
            tolerance.name.clone(),
            bought(4, tolerance.halved_mm),
            bought(3, tolerance.cost),
            bought(3, tolerance.cost_then),
        ]);
    }
    println!("{rows}");
    println!("cost {:.3} -> {:.3}\n", budget.cost[0], budget.cost[1]);
    let is_free = |of: &&Tolerance| budget.priced && of.factor < 1.0 && of.by.is_none();
    if let Some(buys) = budget.tolerances.iter().find(is_free).and_then(|of| of.mm_per_cost) {
        let buys = significant(buys, 3);
        println!("At the optimum a further unit of cost lowers the quantile by {buys} mm.\n");
    }
    let mut rows = table(&["verified", "robots", "failed", "quantile [mm]", "within the limit [%]"]);
    for (name, reached) in [("as it is", &budget.now), ("tightened", &budget.tightened)] {
        let Reached { quantile_mm, within, robots, failed } = reached;
        rows.add_row([
            name.to_owned(),
            robots.to_string(),
            failed.to_string(),
            interval(quantile_mm, 1.0, 4),
            interval(within, 100.0, 2),
        ]);
    }
    println!("{rows}");
}

fn interval(estimate: &Estimate, scale: f64, decimals: usize) -> String {
    let [value, low, high] = [estimate.value, estimate.low, estimate.high].map(|number| scale * number);
    format!("{value:.decimals$} ({low:.decimals$} to {high:.decimals$})")
}
