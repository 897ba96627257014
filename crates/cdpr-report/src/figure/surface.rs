//! Output over two parameters: Fig. 4b and 4c of the paper.

use crate::drawing::axis::{Grid, chart};
use crate::drawing::color_map::{Cells, ColorMap, Nodes};
use crate::drawing::heading::Heading;
use crate::drawing::sheet::Sheet;
use crate::drawing::style::{self, GREY, HEIGHT, Pen, px};
use crate::error::ReportError;
use crate::parameters::axis_of;
use crate::text::number;
use cdpr_study::{SurfaceResult, SurfaceSummary};

/// Draws the output over two parameters in colour, with contour lines at the ticks of the colour bar.
///
/// A failed cell is grey and struck through.
///
/// # Errors
/// [`ReportError::Empty`] if every cell failed, [`ReportError::Invalid`] for an invalid grid, an unknown
/// parameter, or a value that is not finite.
pub fn surface<E>(
    summary: &SurfaceSummary,
    result: &SurfaceResult<E>,
    sheet: Sheet,
) -> Result<String, ReportError> {
    let [x, y] = &summary.parameters;
    let cells = Cells { x: nodes("x", x, &result.x)?, y: nodes("y", y, &result.y)? };
    let (output, unit) = (summary.output, summary.output.unit());
    let values = result.values.iter().map(|value| value.as_ref().ok().copied()).collect();
    let map = ColorMap::new(cells, values, output.name(), &format!("{} [{unit}]", output.short()))?;
    let map = map.by_decades();
    let failed = map.values.iter().filter(|value| value.is_none()).count();
    let key = [("failed".to_owned(), Pen::bar(GREY))];
    let heading = Heading {
        title: &summary.title,
        lines: &[format!(
            "{}: min {} {unit}, max {} {unit}, nominal {} {unit}{}; {} grid points, {failed} failed",
            output.label(),
            number(map.least, 4),
            number(map.greatest, 4),
            number(ReportError::finite(&format!("{}.nominal", output.name()), summary.values.nominal)?, 4),
            if map.by_decades { ", colours by powers of ten" } else { "" },
            map.values.len(),
        )],
        key: if failed == 0 { &[] } else { &key },
    };
    let (x, y) = (map.cells.x.axis(), map.cells.y.axis());
    style::figure([sheet.width(), sheet.height(heading.height(sheet), HEIGHT)], |area| {
        let width = px(sheet.width() - map.bar_width());
        let (left, right) = heading.draw(sheet, area)?.split_horizontally(width);
        let chart = chart(&left, &x, &y, Grid::None)?;
        map.draw(chart.plotting_area())?;
        map.cells.hatch(chart.plotting_area(), |cell| map.values[cell].is_none())?;
        map.draw_color_bar(&right)
    })
}

/// Values of a parameter in the unit of its label.
fn nodes(field: &str, name: &str, values: &[f64]) -> Result<Nodes, ReportError> {
    let (label, scale) = axis_of(name)?;
    Nodes::new(field, label, values.iter().map(|value| scale * value).collect())
}
