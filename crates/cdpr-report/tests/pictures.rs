//! Figures as PDF and PNG.

#![allow(clippy::unwrap_used)]

use cdpr_report::{FigureFile, FigureFormat, figure_file};

const SVG: &str = "<svg width=\"700\" height=\"350\" viewBox=\"0 0 7000 3500\" \
    xmlns=\"http://www.w3.org/2000/svg\"><rect width=\"7000\" height=\"3500\" fill=\"#fff\"/>\
    <text x=\"100\" y=\"900\" font-family=\"sans-serif\" font-size=\"400\">Tension</text></svg>";

fn of(format: FigureFormat, width_mm: f64) -> FigureFile {
    FigureFile { format, width_mm: Some(width_mm), untitled: false }
}

#[test]
fn pdf_and_png_have_the_size_that_is_given_and_the_font_of_the_program() {
    let pdf = figure_file(SVG, of(FigureFormat::Pdf, 127.0)).unwrap();
    let text = String::from_utf8_lossy(&pdf);
    assert!(text.starts_with("%PDF-") && text.contains("/MediaBox [0 0 360 180]"), "{text}");
    assert!(text.contains("DejaVuSans"), "{text}");
    let png = figure_file(SVG, of(FigureFormat::Png, 25.4)).unwrap();
    assert_eq!(png[..8], *b"\x89PNG\r\n\x1a\n");
    let [width, height] = [16, 20].map(|at| u32::from_be_bytes(png[at..at + 4].try_into().unwrap()));
    assert_eq!([width, height], [300, 150]);
}
