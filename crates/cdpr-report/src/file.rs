//! Figures as files: SVG, and with the feature `figures` PDF and PNG.

use crate::drawing::sheet::{FIGURE_WIDTHS_MM, Sheet};
use crate::error::ReportError;
use std::borrow::Cow;
use std::path::Path;

/// Units of an SVG in a millimetre: 96 in an inch.
const UNITS_PER_MM: f64 = 96.0 / 25.4;

/// Resolution of a PNG [1/inch].
#[cfg(feature = "figures")]
const PNG_RESOLUTION: f64 = 300.0;

/// Format of the file of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FigureFormat {
    /// SVG, the format in which figures are drawn.
    Svg,
    /// PDF with the font embedded.
    Pdf,
    /// PNG of 300 pixels an inch.
    Png,
}

impl FigureFormat {
    /// Whether this crate has been built with PDF and PNG.
    pub const HAS_ALL: bool = cfg!(feature = "figures");

    /// The format that the ending of a name says.
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "svg" => Some(Self::Svg),
            "pdf" => Some(Self::Pdf),
            "png" => Some(Self::Png),
            _ => None,
        }
    }
}

/// How a figure becomes a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FigureFile {
    /// Format of the file.
    pub format: FigureFormat,
    /// Width [mm]; as it is drawn, 185 mm, if left out.
    pub width_mm: Option<f64>,
    /// Whether the title above the figure is left out, because its caption has it.
    pub untitled: bool,
}

impl FigureFile {
    /// The sheet on which its figure is drawn.
    #[must_use]
    pub fn sheet(self) -> Sheet {
        let sheet = self.width_mm.map_or(Sheet::SCREEN, Sheet::paper);
        if self.untitled { sheet.untitled() } else { sheet }
    }
}

/// The content of the file of a figure that is drawn as SVG on its [`FigureFile::sheet`].
///
/// # Errors
/// [`ReportError::Invalid`] for a width outside of [`FIGURE_WIDTHS_MM`], [`ReportError::Drawing`] for a text
/// that is no figure of this crate, and for PDF and PNG without the feature `figures`.
pub fn figure_file(svg: &str, file: FigureFile) -> Result<Vec<u8>, ReportError> {
    let mut svg = Cow::from(svg);
    if let Some(width) = file.width_mm {
        svg = resized(&svg, width)?.into();
    }
    match file.format {
        FigureFormat::Svg => Ok(svg.into_owned().into_bytes()),
        #[cfg(feature = "figures")]
        FigureFormat::Pdf => pdf(&svg),
        #[cfg(feature = "figures")]
        FigureFormat::Png => png(&svg),
        #[cfg(not(feature = "figures"))]
        _ => Err(failed(
            "this program is built without PDF and PNG (feature `figures`): expected a name that ends in .svg",
        )),
    }
}

fn failed(reason: impl ToString) -> ReportError {
    ReportError::Drawing { reason: reason.to_string() }
}

/// Value of an attribute of the first element that has it.
fn attribute<'a>(svg: &'a str, name: &str) -> Option<&'a str> {
    svg.split_once(&format!(" {name}=\""))?.1.split('"').next()
}

/// Width and height of a figure [px].
fn size(svg: &str) -> Option<[f64; 2]> {
    Some([attribute(svg, "width")?.parse().ok()?, attribute(svg, "height")?.parse().ok()?])
}

fn with_size(svg: &str, [width, height]: [f64; 2], [new_width, new_height]: [f64; 2]) -> String {
    let text = |width: f64, height: f64| format!("width=\"{width}\" height=\"{height}\"");
    svg.replacen(&text(width, height), &text(new_width, new_height), 1)
}

/// The figure with another width [mm] and the height that belongs to it.
fn resized(svg: &str, width_mm: f64) -> Result<String, ReportError> {
    let [least, greatest] = FIGURE_WIDTHS_MM;
    if !(least..=greatest).contains(&width_mm) {
        return Err(ReportError::invalid("width", &width_mm, "20 to 1000 mm"));
    }
    let [width, height] = size(svg).ok_or_else(|| failed("the figure has no size"))?;
    let thousandths = |units: f64| (1e3 * units).round() / 1e3;
    let new_width = thousandths(width_mm * UNITS_PER_MM);
    Ok(with_size(svg, [width, height], [new_width, thousandths(new_width * height / width)]))
}

/// The figure with its texts in DejaVu Sans, which comes with the program: the same on every machine.
#[cfg(feature = "figures")]
fn tree(svg: &str) -> Result<svg2pdf::usvg::Tree, ReportError> {
    let mut options = svg2pdf::usvg::Options::default();
    let fonts = options.fontdb_mut();
    fonts.load_font_data(dejavu::sans::regular().to_vec());
    fonts.set_sans_serif_family("DejaVu Sans");
    svg2pdf::usvg::Tree::from_str(svg, &options).map_err(failed)
}

#[cfg(feature = "figures")]
fn pdf(svg: &str) -> Result<Vec<u8>, ReportError> {
    // A page as large as the figure: 96 units an inch.
    let page = svg2pdf::PageOptions { dpi: 96.0 };
    svg2pdf::to_pdf(&tree(svg)?, svg2pdf::ConversionOptions::default(), page).map_err(failed)
}

#[cfg(feature = "figures")]
fn png(svg: &str) -> Result<Vec<u8>, ReportError> {
    use resvg::tiny_skia::{Pixmap, Transform};
    let (tree, scale) = (tree(svg)?, (PNG_RESOLUTION / 96.0) as f32);
    let [width, height] = [tree.size().width(), tree.size().height()].map(|size| (scale * size).round());
    let mut picture = Pixmap::new(width as u32, height as u32)
        .ok_or_else(|| ReportError::invalid("width", &width, "fewer pixels"))?;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut picture.as_mut());
    picture.encode_png().map_err(failed)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SVG: &str = "<svg width=\"700\" height=\"350\" viewBox=\"0 0 7000 3500\" \
        xmlns=\"http://www.w3.org/2000/svg\"><rect width=\"7000\" height=\"3500\" fill=\"#fff\"/>\
        <text x=\"100\" y=\"900\" font-family=\"sans-serif\" font-size=\"400\">Tension</text></svg>";

    #[test]
    fn the_ending_of_a_name_says_the_format() {
        for (name, format) in [
            ("a.svg", Some(FigureFormat::Svg)),
            ("b/a.PDF", Some(FigureFormat::Pdf)),
            ("a.png", Some(FigureFormat::Png)),
            ("a.eps", None),
            ("svg", None),
        ] {
            assert_eq!(FigureFormat::of(Path::new(name)), format, "{name}");
        }
    }

    fn of(format: FigureFormat, width_mm: Option<f64>) -> FigureFile {
        FigureFile { format, width_mm, untitled: false }
    }

    #[test]
    fn a_width_scales_the_figure_and_not_what_is_in_it() {
        let file = figure_file(SVG, of(FigureFormat::Svg, Some(127.0))).unwrap();
        let file = String::from_utf8(file).unwrap();
        assert!(file.starts_with("<svg width=\"480\" height=\"240\" viewBox=\"0 0 7000 3500\""), "{file}");
        assert!(file.contains("<rect width=\"7000\""));
        assert_eq!(figure_file(SVG, of(FigureFormat::Svg, None)).unwrap(), SVG.as_bytes());
        for width in [0.0, -1.0, 19.9, 1001.0, f64::NAN, f64::INFINITY] {
            assert!(figure_file(SVG, of(FigureFormat::Svg, Some(width))).is_err(), "{width}");
        }
    }

    #[test]
    fn a_file_is_drawn_for_its_width_and_without_the_title_that_its_caption_has() {
        let file = of(FigureFormat::Svg, None);
        assert_eq!(file.sheet(), Sheet::SCREEN);
        assert_eq!(FigureFile { untitled: true, ..file }.sheet(), Sheet::SCREEN.untitled());
        assert_eq!(of(FigureFormat::Svg, Some(88.0)).sheet(), Sheet::paper(88.0));
    }

    #[cfg(not(feature = "figures"))]
    #[test]
    fn pdf_and_png_are_refused_where_they_are_not_built() {
        for format in [FigureFormat::Pdf, FigureFormat::Png] {
            let error = figure_file(SVG, of(format, None)).unwrap_err().to_string();
            assert!(error.contains("without PDF and PNG"), "{error}");
        }
    }
}
