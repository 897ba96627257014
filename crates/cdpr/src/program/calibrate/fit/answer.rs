//! What is said of a fit.

use crate::program::output::{print_sentence, table, wide_table};
use cdpr_calibration::{
    CalibrationSummary, Fit, LengthConstant, OutlierSummary, ParameterSummary, RobustLoss, RowApart,
    SensorError,
};
use cdpr_robot::{counted, listing, shown, significant};

/// Chi-square for each degree of freedom above which the model is another one.
const MISFIT: f64 = 100.0;

/// Parameters in the table of the answer.
const LEADING: usize = 5;

/// Significant digits of a value at most.
const DIGITS: f64 = 9.0;

/// The accuracy that is left, how well the model fits, and the parameters that moved most.
pub(super) fn print(summary: &CalibrationSummary, loss: RobustLoss) {
    let all = || summary.parameters.iter().chain(&summary.sensors);
    let (unknowns, identifiable) = (all().count(), all().filter(|(_, of)| of.identifiable).count());
    let (robot, rows) = (shown(&summary.robot), counted(summary.rows, "row"));
    let have = if summary.rows == 1 { "has" } else { "have" };
    let apart = summary.row_apart.filter(|_| summary.is_unlikely());
    let (known, condition) = if summary.is_unlikely() && !apart.is_some_and(|row| row.others_fit) {
        ("would be known", ", if they did fit")
    } else {
        ("is known", "")
    };
    let mut sentences: Vec<String> = summary
        .position_std_after
        .iter()
        .map(|after| {
            let before = summary.position_std_before;
            let before = before.map_or_else(String::new, |std| format!(" (before {} mm)", digits(1e3 * std)));
            let after = digits(1e3 * after);
            format!("{robot}: at these poses a coordinate {known} to {after} mm{before}{condition}.")
        })
        .collect();
    if let [first, others @ ..] = &summary.position_depends_on[..] {
        let others = if others.is_empty() { String::new() } else { format!(" and {} more", others.len()) };
        sentences.push(format!(
            "{robot}: the position is not known: it depends on {first}{others}, which neither measurements \
             nor priors identify."
        ));
    }
    let misfit = summary.chi_square / summary.degrees_of_freedom.max(1) as f64;
    if let Some(row) = apart {
        sentences.insert(0, about_apart(summary, row, loss));
    } else if let Some(LengthConstant { metres, share }) = summary.length_constant {
        let (size, to) = (digits(1e3 * metres.abs()), if metres < 0.0 { "short" } else { "long" });
        sentences.insert(
            0,
            format!(
                "The measurements do not fit {robot}: lengths that are all {size} mm too {to} explain {:.0} % of \
                 the \
                 misfit. Is a constant missing, such as the lead of all cables?",
                100.0 * share
            ),
        );
    } else if misfit > MISFIT {
        sentences.insert(
            0,
            format!(
                "The measurements do not fit {robot}: they are {} standard deviations off on average. Are \
                 they \
                 of this robot, in this order of the cables, in these units?",
                significant(misfit.sqrt(), 3)
            ),
        );
    } else if summary.is_unlikely() {
        sentences.insert(0, format!("The measurements do not fit {robot} within their noise."));
    }
    let known = all().filter(|(_, of)| of.std.is_some()).count();
    sentences.push(of_identifiable(&robot, [identifiable, known, unknowns]));
    sentences.push(format!(
        "The {rows} {have} a chi-square of {} for {} degrees of freedom.",
        significant(summary.chi_square, 4),
        summary.degrees_of_freedom
    ));
    if !summary.outliers.is_empty() {
        let lines: Vec<String> =
            summary.outliers.iter().map(|of| format!("line {} ({})", of.line, of.column)).collect();
        sentences.push(listing("Far from the model: ", &lines, "."));
    }
    sentences.extend(of_winches(summary));
    sentences.extend(summary.warnings.iter().map(|warning| format!("warning: {warning}")));
    sentences.iter().for_each(|sentence| print_sentence(sentence));
    print_moved(all());
}

/// The parameters that moved most.
fn print_moved<'a>(all: impl Iterator<Item = (&'a String, &'a ParameterSummary)>) {
    // A frame begins anywhere: where it is tells nothing of the robot.
    let mut moved: Vec<_> = all.filter(|(name, _)| !name.starts_with("frame.")).collect();
    let share = |of: &ParameterSummary| {
        of.std.filter(|std| *std > 0.0).map_or(0.0, |std| ((of.after - of.before) / std).abs())
    };
    moved.sort_by(|one, other| share(other.1).total_cmp(&share(one.1)));
    let mut rows = table(&["moved most", "before", "after", "std", "unit", "identifiable"]);
    for (name, of) in moved.into_iter().take(LEADING) {
        let [before, after, std] = values(of);
        rows.add_row([
            name.as_str(),
            &before,
            &after,
            &std,
            of.unit,
            if of.identifiable { "yes" } else { "no" },
        ]);
    }
    println!("{rows}");
}

/// Which row does not fit, where it is one.
fn about_apart(
    summary: &CalibrationSummary,
    RowApart { line, share, others_fit }: RowApart,
    loss: RobustLoss,
) -> String {
    let robot = shown(&summary.robot);
    let of_line = |of: &&OutlierSummary| of.line == line;
    let column =
        summary.outliers.iter().find(of_line).map_or(String::new(), |of| format!(" ({})", of.column));
    if others_fit {
        return format!("Line {line}{column} does not fit {robot}, all other rows do.");
    }
    let less = match loss {
        RobustLoss::Squares => ", or let it count less: --with loss=huber",
        RobustLoss::Huber => ", or let it count still less: --with loss=cauchy",
        RobustLoss::Cauchy => "",
    };
    format!(
        "The measurements do not fit {robot}: line {line}{column} makes {:.0} % of the misfit. Is it of \
         another pose, or mistyped? Leave it out{less}.",
        100.0 * share
    )
}

/// How many unknowns the measurements alone identify, how many are known with what was known before, of all.
fn of_identifiable(robot: &str, [identifiable, known, all]: [usize; 3]) -> String {
    let of = format!("of {} of {robot}", counted(all, "unknown"));
    let alone = match identifiable {
        0 => format!("none {of} is"),
        count => format!("{count} {of} are"),
    };
    let before = match known {
        known if known <= identifiable => String::new(),
        known if known == all => " With what was known before, all are estimated.".to_owned(),
        known => format!(" With what was known before, {known} are estimated."),
    };
    format!("From the measurements alone, {alone} identifiable.{before}")
}

/// What a parameter was, is, and its standard deviation. Both values have the digits that two digits of the
/// standard deviation leave them.
fn values(of: &ParameterSummary) -> [String; 3] {
    let value = |value: f64| {
        let size = |of: f64| of.abs().log10().floor();
        let digits = of.std.map_or(DIGITS, |std| (size(value) - size(std) + 2.0).clamp(1.0, DIGITS));
        significant(value, digits as usize)
    };
    let std = of.std.map_or_else(|| "-".to_owned(), |std| significant(std, 2));
    [value(of.before), value(of.after), std]
}

/// What a controller and a study have to know of errors of the winches that were sought.
fn of_winches(summary: &CalibrationSummary) -> Option<String> {
    let errors = [SensorError::LengthOffset, SensorError::DrumScale].map(SensorError::name);
    let is_sought = |name: &String| errors.iter().any(|error| name.starts_with(error));
    summary.sensors.keys().any(is_sought).then(|| {
        "At the length l a winch reads o + (1 + s) l: o and s are length_offset and drum_scale in \
          summary.json, 0 where they are not sought. posterior.json does not contain them or their \
          correlations: a study of positions with it has another accuracy."
            .to_owned()
    })
}

/// Three digits of a length.
fn digits(value: f64) -> String {
    significant(value, 3)
}

pub(super) fn print_details(summary: &CalibrationSummary, found: &Fit) {
    println!(
        "{}: {}, {}, chi-square {:.1} with {} degrees of freedom",
        shown(&summary.robot),
        counted(summary.rows, "row"),
        counted(found.estimates.len(), "unknown"),
        summary.chi_square,
        summary.degrees_of_freedom
    );
    let mut rows =
        wide_table(&["sensor", "numbers", "rms before", "rms after", "after/noise", "predicted", "unit"]);
    for (name, of) in &summary.residuals {
        rows.add_row([
            (*name).to_owned(),
            of.count.to_string(),
            format!("{:.3e}", of.rms_before),
            format!("{:.3e}", of.rms_after),
            format!("{:.2}", of.standardized_rms_after),
            of.rms_predicted.map_or_else(|| "-".to_owned(), |rms| format!("{rms:.3e}")),
            of.unit.to_owned(),
        ]);
    }
    println!("{rows}");
    let columns = [
        "parameter",
        "before",
        "after",
        "std",
        "std by data alone",
        "unit",
        "moved [prior std]",
        "identifiable",
    ];
    let mut rows = wide_table(&columns);
    for (name, of) in summary.parameters.iter().chain(&summary.sensors) {
        let [before, after, std] = values(of);
        rows.add_row([
            name.clone(),
            before,
            after,
            std,
            of.std_of_data.map_or_else(|| "-".to_owned(), |std| significant(std, 2)),
            of.unit.to_owned(),
            of.moved_by_prior_std.map_or_else(|| "-".to_owned(), |moved| format!("{moved:+.2}")),
            if of.identifiable { "yes" } else { "no" }.to_owned(),
        ]);
    }
    println!("{rows}");
    let [starts, same] = summary.starts;
    if starts > 1 {
        println!("{same} of {starts} starts ended at this chi-square");
    }
    if let Some(after) = summary.position_std_after {
        let before = summary.position_std_before;
        let before = before.map_or_else(|| "unknown".to_owned(), |std| format!("{:.4} mm", 1e3 * std));
        println!(
            "standard deviation of the position, a coordinate: {before} before, {:.4} mm after",
            1e3 * after
        );
    }
    for combination in summary.not_identifiable.iter().take(10) {
        let parts = combination.iter().take(5).map(|(name, weight)| format!("{weight:+.2} {name}"));
        println!("not identifiable: {}", parts.collect::<Vec<_>>().join(" "));
    }
    for outlier in summary.outliers.iter().take(10) {
        println!(
            "far from the model: line {}, {}: {:.1} standard deviations",
            outlier.line, outlier.column, outlier.standard_deviations
        );
    }
}

#[cfg(test)]
mod tests {
    use super::of_identifiable;

    #[test]
    fn what_measurements_alone_do_not_identify_may_be_known_with_what_was_before() {
        let said = |counts: [usize; 3]| of_identifiable("Arena", counts);
        let (begin, before) = ("From the measurements alone,", "With what was known before,");
        assert_eq!(said([3, 3, 3]), format!("{begin} 3 of 3 unknowns of Arena are identifiable."));
        assert_eq!(
            said([0, 17, 17]),
            format!("{begin} none of 17 unknowns of Arena is identifiable. {before} all are estimated.")
        );
        assert_eq!(
            said([2, 4, 5]),
            format!("{begin} 2 of 5 unknowns of Arena are identifiable. {before} 4 are estimated.")
        );
    }
}
