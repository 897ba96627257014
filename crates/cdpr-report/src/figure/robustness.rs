//! Robustness of the direct model: the distance of its answers from the true pose, and the starts from which
//! it finds it.

use crate::drawing::axis::{Axis, Grid, chart};
use crate::drawing::heading::Heading;
use crate::drawing::sheet::Sheet;
use crate::drawing::style::{self, BLUE, GREY, HEIGHT, MARGIN, ORANGE, Pen, VERMILLION, X_AXIS, px};
use crate::error::ReportError;
use crate::text::number;
use cdpr_assess::{Outcome, ProtocolSummary, RobustnessResult, RobustnessRow};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Outcomes with their names and colours. The rare ones are drawn last, over the others.
const OUTCOMES: [(Outcome, &str, RGBColor); 3] = [
    (Outcome::TruePose, "true pose", BLUE),
    (Outcome::OtherEquilibrium, "another stable equilibrium", ORANGE),
    (Outcome::Failed, "failed (without an answer: at the top)", VERMILLION),
];
/// Radius of a mark [px].
const MARK: f64 = 1.8;
/// Largest number of true poses that are drawn. More would hide each other.
const MOST_TRUE_POSES: usize = 2000;
/// Distance below which differences are rounding [m]; nearer answers are drawn at this distance.
const NEAREST: f64 = 1e-16;
/// Height of a row of the grid [px].
const ROW: f64 = 46.0;
/// The dark end of the colours is the least share of the grid, but at most this value.
const BRIGHTEST_DARK: f64 = 0.99;

/// Draws every solve of a test: the distance of its answer from the true pose over the distance of its start.
///
/// Both are root mean square distances over the anchor points. The colour shows the outcome. If there are
/// many true poses, every k-th is drawn.
///
/// # Errors
/// [`ReportError::Empty`] without solves, [`ReportError::Invalid`] for a distance that is not finite.
pub fn found_poses(result: &RobustnessResult) -> Result<String, ReportError> {
    if result.solves.is_empty() {
        return Err(ReportError::Empty { what: "solves" });
    }
    let mut points = Vec::with_capacity(result.solves.len());
    for solve in &result.solves {
        let x = ReportError::finite("start_distance", solve.start_distance)?;
        let y = match &solve.answer {
            Ok(answer) => Some(ReportError::finite("anchor_distance", answer.anchor_distance)?),
            Err(_) => None,
        };
        points.push((x, y.map(|y| y.max(NEAREST).log10()), solve.outcome(result.protocol.found_distance)));
    }
    let found = || points.iter().filter_map(|(_, y, _)| *y);
    // Whole decades, and one more for solves without an answer.
    let low = found().fold(-1.0, f64::min).floor();
    let high = found().fold(0.0, f64::max).ceil();
    let top = if points.iter().any(|(_, y, _)| y.is_none()) { high + 1.0 } else { high };
    let farthest = points.iter().map(|point| point.0).fold(1e-3, f64::max);
    let x = Axis::numbers(0.0..1.03 * farthest, 9, "distance of the start from the true pose [m]");
    let y = decades(low..top, "distance of the answer from the true pose [m]");

    let count = |outcome| points.iter().filter(|point| point.2 == outcome).count();
    let every = count(Outcome::TruePose).div_ceil(MOST_TRUE_POSES).max(1);
    let mut lines = vec![format!(
        "{} solves: {} found the true pose, {} another stable equilibrium, {} failed",
        points.len(),
        count(Outcome::TruePose),
        count(Outcome::OtherEquilibrium),
        count(Outcome::Failed),
    )];
    let shown =
        if every > 1 { format!("; of the true poses one in {every} is shown") } else { String::new() };
    lines.push(format!("distance: root mean square over the anchor points{shown}"));
    let key: Vec<_> = OUTCOMES
        .iter()
        .filter(|(outcome, ..)| count(*outcome) > 0)
        .map(|(_, name, color)| ((*name).to_owned(), Pen::bar(*color)))
        .collect();
    let sheet = Sheet::SCREEN;
    let heading = Heading { title: result.protocol.title, lines: &lines, key: &key };
    style::figure([sheet.width(), sheet.height(heading.height(sheet), HEIGHT)], |area| {
        let chart = chart(&heading.draw(sheet, area)?, &x, &y, Grid::Horizontal)?;
        let plot = chart.plotting_area();
        for (outcome, _, color) in OUTCOMES {
            let step = if outcome == Outcome::TruePose { every } else { 1 };
            for (x, y, _) in points.iter().filter(|point| point.2 == outcome).step_by(step) {
                let point = (*x, y.unwrap_or(high + 0.5));
                plot.draw(&Circle::new(point, px(MARK), color.mix(0.6).filled()))?;
            }
        }
        Ok(())
    })
}

/// Axis of decimal logarithms over whole decades, with the powers at its ticks.
fn decades(range: std::ops::Range<f64>, label: &str) -> Axis {
    let step = ((range.end - range.start) / 8.0).ceil().max(1.0) as i32;
    let ticks = (range.start as i32..=range.end as i32)
        .filter(|power| power % step == 0)
        .map(|power| (f64::from(power), format!("1e{}", number(f64::from(power), 0))))
        .collect();
    Axis::given(range, ticks, label)
}

/// Draws the share of starts that lead to the true pose, over the grid of start distances and angles.
///
/// # Errors
/// [`ReportError::Empty`] without solves, [`ReportError::Invalid`] for a row without distance and angle, or
/// with numbers that are not finite.
pub fn success_share(summary: &ProtocolSummary) -> Result<String, ReportError> {
    let mut cells = Vec::new();
    for row in &summary.rows {
        let (Some(distance), Some(angle)) = (row.distance, row.angle_deg) else {
            return Err(ReportError::invalid("rows", &"a total", "rows of one start offset each"));
        };
        let distance = ReportError::finite("rows.distance", distance)?;
        cells.push((distance, ReportError::finite("rows.angle_deg", angle)?, row));
    }
    if cells.iter().all(|(.., row)| row.solves == 0) {
        return Err(ReportError::Empty { what: "no solves" });
    }
    let shares = summary.rows.iter().filter_map(RobustnessRow::success);
    let darkest = shares.fold(BRIGHTEST_DARK, f64::min);
    let distances = ascending(cells.iter().map(|cell| cell.0));
    let angles = ascending(cells.iter().map(|cell| cell.1));
    let names = |values: &[f64]| values.iter().map(ToString::to_string).collect::<Vec<_>>();
    let x = Axis::names(names(&distances).into_iter(), "distance of the start from the true pose [m]");
    let y = Axis::names(names(&angles).into_iter(), "angle of the start [degrees]");
    let total = &summary.total;
    let lines = [
        format!("{} of {} starts lead to the true pose ({})", total.true_pose, total.solves, percent(total)),
        format!(
            "found: within {} m and {}\u{b0}; colours from {} % (dark) to 100 % (bright)",
            summary.found_distance,
            summary.found_angle_deg,
            number(100.0 * darkest, 2)
        ),
    ];
    let sheet = Sheet::SCREEN;
    let heading = Heading { title: &summary.title, lines: &lines, key: &[] };
    let height = heading.height(sheet) + ROW * angles.len() as f64 + X_AXIS + MARGIN + 4.0;
    style::figure([sheet.width(), height], |area| {
        let chart = chart(&heading.draw(sheet, area)?, &x, &y, Grid::None)?;
        let plot = chart.plotting_area();
        for (distance, angle, row) in &cells {
            let index =
                |values: &[f64], value| values.iter().take_while(|v| **v < value).count() as f64 + 1.0;
            let (i, j) = (index(&distances, *distance), index(&angles, *angle));
            let share = row.success();
            let bright = share.map(|share| (share - darkest) / (1.0 - darkest));
            let color = bright.map_or(GREY, ViridisRGB::get_color);
            plot.draw(&Rectangle::new([(i - 0.5, j - 0.5), (i + 0.5, j + 0.5)], color.filled()))?;
            let ink = if bright.is_some_and(|bright| bright < 0.5) { WHITE } else { BLACK };
            let style = style::font(style::TEXT).color(&ink).pos(Pos::new(HPos::Center, VPos::Center));
            plot.draw(&Text::new(percent(row), (i, j + 0.18), style.clone()))?;
            let counts = format!("{} of {}", row.true_pose, row.solves);
            plot.draw(&Text::new(counts, (i, j - 0.18), style))?;
        }
        Ok(())
    })
}

fn percent(row: &RobustnessRow) -> String {
    row.success().map_or_else(|| "none".to_owned(), |share| format!("{} %", number(100.0 * share, 2)))
}

fn ascending(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}
