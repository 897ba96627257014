//! The file of a figure and how it is drawn: `map.pdf,width=90,untitled`.

use crate::program::arguments::endings::check_place;
use crate::program::arguments::{Overwrite, number};
use crate::program::error::ProgramError;
use cdpr_report::{FIGURE_WIDTHS_MM, FigureFile, FigureFormat, Sheet, figure_file};
use std::path::PathBuf;

/// A file for a figure.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FigureArgument {
    pub(crate) path: PathBuf,
    file: FigureFile,
}

impl FigureArgument {
    /// Name of the file without its ending.
    pub(crate) fn stem(&self) -> &str {
        self.path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default()
    }

    /// Writes a figure that `draw` draws as SVG, for the width that is asked for.
    pub(crate) fn write(
        &self,
        overwrite: &Overwrite,
        draw: impl FnOnce(Sheet) -> Result<String, ProgramError>,
    ) -> Result<(), ProgramError> {
        overwrite.write(&self.path, figure_file(&draw(self.file.sheet())?, self.file)?)
    }
}

/// Writes those figures whose names are asked for. `draw` draws all of them for a sheet.
pub(crate) fn write_figures(
    asked: &[FigureArgument],
    draw: impl Fn(Sheet) -> Vec<(String, String)>,
    overwrite: &Overwrite,
) -> Result<(), ProgramError> {
    let mut sheets: Vec<(Sheet, Vec<(String, String)>)> = Vec::new();
    for sheet in asked.iter().map(|file| file.file.sheet()) {
        if sheets.iter().all(|(known, _)| *known != sheet) {
            sheets.push((sheet, draw(sheet)));
        }
    }
    let find = |file: &FigureArgument| {
        let sheet = file.file.sheet();
        let drawn = sheets.iter().filter(|(of, _)| *of == sheet).flat_map(|(_, drawn)| drawn);
        let found = drawn.clone().find(|(name, _)| name == file.stem()).map(|(_, svg)| svg.clone());
        found.ok_or_else(|| {
            let names: Vec<&str> = drawn.map(|(name, _)| name.as_str()).collect();
            ProgramError::Usage(format!(
                "--figure {}: expected the name of a figure of the results: {}",
                file.path.display(),
                names.join(", ")
            ))
        })
    };
    let found = asked.iter().map(find).collect::<Result<Vec<_>, _>>()?;
    asked.iter().zip(found).try_for_each(|(file, svg)| file.write(overwrite, |_| Ok(svg)))
}

/// A name that ends in .svg, .pdf or .png, then settings with commas before them.
pub(crate) fn figure(text: &str) -> Result<FigureArgument, String> {
    let mut parts = text.split(',');
    let path = PathBuf::from(parts.next().unwrap_or_default());
    let Some(format) = FigureFormat::of(&path) else {
        return Err("a figure is SVG, PDF or PNG: expected a name that ends in .svg, .pdf or .png".to_owned());
    };
    if format != FigureFormat::Svg && !FigureFormat::HAS_ALL {
        return Err(
            "this program is built without PDF and PNG: expected a name that ends in .svg, or a program \
                    built with the feature `figures`"
                .to_owned(),
        );
    }
    check_place(&path)?;
    let mut file = FigureFile { format, width_mm: None, untitled: false };
    for part in parts {
        match part.split_once('=') {
            Some(("width", text)) => file.width_mm = Some(width(text)?),
            None if part == "untitled" => file.untitled = true,
            _ => {
                return Err(format!("{part} behind the name: expected width=MM or untitled"));
            }
        }
    }
    Ok(FigureArgument { path, file })
}

/// A width [mm].
fn width(text: &str) -> Result<f64, String> {
    let [least, greatest] = FIGURE_WIDTHS_MM;
    let width = number(text)?;
    let fits = (least..=greatest).contains(&width);
    if fits { Ok(width) } else { Err(format!("width={text}: expected {least} to {greatest} mm")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_stand_behind_the_name_and_others_are_refused() {
        let found = figure("./map.svg,width=90,untitled").unwrap();
        let file = FigureFile { format: FigureFormat::Svg, width_mm: Some(90.0), untitled: true };
        assert_eq!(found, FigureArgument { path: "./map.svg".into(), file });
        assert_eq!(found.stem(), "map");
        for text in [
            "map",
            "map.eps",
            "nowhere/map.svg",
            "map.svg,width",
            "map.svg,width=9",
            "map.svg,90",
            "map.svg,",
        ] {
            assert!(figure(text).is_err(), "{text}");
        }
    }
}
