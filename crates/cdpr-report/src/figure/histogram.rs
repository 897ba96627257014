//! Distribution of the output and the laws fitted to it: Fig. 4a and 5a of the paper.

use crate::drawing::axis::{Axis, Grid, chart};
use crate::drawing::heading::Heading;
use crate::drawing::sheet::Sheet;
use crate::drawing::style::{self, BLUE, GREEN, HEIGHT, Pen, VERMILLION};
use crate::error::ReportError;
use crate::text::number;
use cdpr_sensitivity::{Histogram, Support};
use cdpr_study::{FitSummary, SamplingSummary};
use plotters::prelude::*;

/// Colour of the bars, sky blue halfway to white, because the laws are drawn over it.
const BARS: RGBColor = RGBColor(0xAB, 0xDA, 0xF4);
const NOMINAL: Pen = Pen { color: BLACK, width: 1.4, dash: Some(2.5) };
/// Pens of the three best laws, best first.
const LAWS: [Pen; 3] = [
    Pen::solid(VERMILLION, 2.6),
    Pen { color: BLUE, width: 1.5, dash: Some(8.0) },
    Pen { color: GREEN, width: 1.5, dash: Some(4.0) },
];
/// Number of points of a curve, about one per pixel.
const POINTS: usize = 600;

/// Draws the histogram of the output as a density, with the densities of fitted laws.
///
/// The laws are the preferred one and the two others with the least AIC. A vertical line shows the output of
/// the nominal robot.
///
/// # Errors
/// [`ReportError::Empty`] without counts, [`ReportError::Invalid`] for bins without width, unless there is
/// one edge more than bins, or for a value that is not finite.
pub fn histogram(summary: &SamplingSummary, sheet: Sheet) -> Result<String, ReportError> {
    let empty = ReportError::Empty { what: "histogram" };
    let (Some(histogram), Some(values)) = (&summary.histogram, &summary.values) else { return Err(empty) };
    let (bars, output) = (densities(histogram)?, summary.output);
    let nominal = ReportError::finite(&format!("{}.nominal", output.name()), values.nominal)?;
    let mut fits: Vec<&FitSummary> = summary.fits.iter().collect();
    // The preferred law comes first, then the others by AIC.
    fits.sort_by(|one, other| {
        let rank = |fit: &FitSummary| (summary.best_fit.is_none_or(|best| best.family != fit.law), fit.aic);
        rank(one).partial_cmp(&rank(other)).unwrap_or(std::cmp::Ordering::Equal)
    });
    fits.truncate(LAWS.len());

    let (least, greatest) = (bars[0].0, bars[bars.len() - 1].1);
    let (least, greatest) = (least.min(nominal), greatest.max(nominal));
    let margin = 0.05 * (greatest - least);
    let (low, high) = (least - margin, greatest + margin);
    let curves: Vec<Vec<(f64, f64)>> = fits
        .iter()
        .map(|fit| {
            let Support { min: first, max: last } = fit.parameters.support();
            // Both sides of the ends of the support, because the density may jump there.
            let ends = [first.next_down(), first, last, last.next_up()];
            let mut points: Vec<f64> =
                (0..=POINTS).map(|k| low + (high - low) * k as f64 / POINTS as f64).collect();
            points.extend(ends.iter().filter(|end| (low..high).contains(*end)));
            points.sort_by(f64::total_cmp);
            let density = |x: f64| fit.parameters.ln_pdf(x).exp();
            points.into_iter().map(|x| (x, density(x))).filter(|point| point.1.is_finite()).collect()
        })
        .collect();
    let top =
        bars.iter().map(|bar| bar.2).chain(curves.iter().flatten().map(|point| point.1)).fold(0.0, f64::max);

    let density = match output.unit() {
        "N/m" => "density [m/N]".to_owned(),
        unit => format!("density [1/{unit}]"),
    };
    let x = Axis::numbers(low..high, 9, output.axis());
    let y = Axis::numbers(0.0..1.06 * top, 7, &density);
    let failed: usize = summary.failed.values().sum();
    let key: Vec<(String, Pen)> = [("observed".to_owned(), Pen::bar(BARS))]
        .into_iter()
        .chain(fits.iter().zip(LAWS).map(|(fit, pen)| (legend(fit, fits[0]), pen)))
        .chain([("nominal".to_owned(), NOMINAL)])
        .collect();
    let heading = Heading {
        title: &summary.title,
        lines: &[format!(
            "mean {}, standard deviation {}, min {}, max {}, nominal {} {}; {} observations, {failed} failed",
            number(values.mean, 3),
            number(values.std, 3),
            number(values.min, 3),
            number(values.max, 3),
            number(nominal, 3),
            output.unit(),
            summary.observations,
        )],
        key: &key,
    };
    style::figure([sheet.width(), sheet.height(heading.height(sheet), HEIGHT)], |area| {
        let chart = chart(&heading.draw(sheet, area)?, &x, &y, Grid::Horizontal)?;
        let plot = chart.plotting_area();
        for &(from, to, density) in &bars {
            plot.draw(&Rectangle::new([(from, 0.0), (to, density)], BARS.filled()))?;
            Pen::solid(WHITE, 0.8)
                .draw(plot, vec![(from, 0.0), (from, density), (to, density), (to, 0.0)])?;
        }
        NOMINAL.draw(plot, vec![(nominal, 0.0), (nominal, y.range.end)])?;
        // The best law comes last, over the others.
        for (curve, pen) in curves.into_iter().zip(LAWS).rev() {
            pen.draw(plot, curve)?;
        }
        Ok(())
    })
}

/// Lower edge, upper edge and density of each bin.
fn densities(histogram: &Histogram) -> Result<Vec<(f64, f64, f64)>, ReportError> {
    let Histogram { edges, counts } = histogram;
    let total: usize = counts.iter().sum();
    if total == 0 {
        return Err(ReportError::Empty { what: "histogram.counts" });
    }
    if edges.len() != counts.len() + 1 {
        return Err(ReportError::invalid("histogram.edges", &edges.len(), "one edge more than counts"));
    }
    let bins = edges.windows(2).zip(counts);
    bins.map(|(edges, count)| {
        let width = edges[1] - edges[0];
        if !(width > 0.0 && width.is_finite()) {
            return Err(ReportError::invalid("histogram.edges", &width, "bins of a positive width"));
        }
        Ok((edges[0], edges[1], *count as f64 / (total as f64 * width)))
    })
    .collect()
}

/// Entry of a law in the key.
fn legend(fit: &FitSummary, preferred: &FitSummary) -> String {
    if fit == preferred {
        format!("{} (preferred)", fit.law)
    } else {
        let difference = number(fit.aic - preferred.aic, 0);
        let sign = if difference.starts_with('\u{2212}') { "" } else { "+" };
        format!("{} (AIC {sign}{difference})", fit.law)
    }
}
