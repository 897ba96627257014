//! Heading of a figure: title, lines and key above the charts.

use crate::drawing::sheet::Sheet;
use crate::drawing::style::{Area, CHARACTER, DrawingError, LINE_HEIGHT, MARGIN, Pen, TEXT, px, text};

/// Line of an entry of a key, its gap to the name, and the room of both with the gap to the next entry [px].
const KEY_LINE: f64 = 24.0;
const KEY_GAP: f64 = 5.0;
const KEY_ENTRY: f64 = KEY_LINE + KEY_GAP + 12.0;

/// Heading above the charts.
pub(crate) struct Heading<'a> {
    pub title: &'a str,
    /// Lines of text below the title.
    pub lines: &'a [String],
    /// Names and pens of the lines and bars. It is empty for a figure without a key.
    pub key: &'a [(String, Pen)],
}

impl Heading<'_> {
    /// Height [px].
    pub(crate) fn height(&self, sheet: Sheet) -> f64 {
        let rows = self.texts(sheet).len() + self.key_rows(sheet).len();
        MARGIN + LINE_HEIGHT * rows as f64 + 4.0
    }

    /// Draws the heading and returns the rest of the area.
    pub(crate) fn draw<'a>(&self, sheet: Sheet, area: &Area<'a>) -> Result<Area<'a>, DrawingError> {
        let (head, rest) = area.split_vertically(px(self.height(sheet)));
        let mut y = MARGIN - 0.5 * LINE_HEIGHT;
        for (line, size) in self.texts(sheet) {
            y += LINE_HEIGHT;
            text(&head, &line, size, (MARGIN, y))?;
        }
        for row in self.key_rows(sheet) {
            y += LINE_HEIGHT;
            let mut x = MARGIN;
            for (name, pen) in row {
                pen.draw(&head, vec![(px(x), px(y)), (px(x + KEY_LINE), px(y))])?;
                text(&head, name, TEXT, (x + KEY_LINE + KEY_GAP, y))?;
                x += width_of(name);
            }
        }
        Ok(rest)
    }

    /// Title and lines, as they fit the width, with their sizes [px].
    fn texts(&self, sheet: Sheet) -> Vec<(String, f64)> {
        let title = sheet.has_title().then_some((self.title, sheet.title_size()));
        let lines = self.lines.iter().map(|line| (line.as_str(), TEXT));
        title.into_iter().chain(lines).flat_map(|(text, size)| sheet.lines_of(text, size)).collect()
    }

    /// Entries of the key, in rows that fit the width.
    fn key_rows(&self, sheet: Sheet) -> Vec<&[(String, Pen)]> {
        let room = sheet.width() - 2.0 * MARGIN + 12.0;
        let (mut rows, mut first, mut used) = (Vec::new(), 0, 0.0);
        for (k, (name, _)) in self.key.iter().enumerate() {
            let width = width_of(name);
            if k > first && used + width > room {
                rows.push(&self.key[first..k]);
                (first, used) = (k, 0.0);
            }
            used += width;
        }
        rows.extend((first < self.key.len()).then(|| &self.key[first..]));
        rows
    }
}

/// Width of an entry of a key with the gap to the next one [px].
fn width_of(name: &str) -> f64 {
    KEY_ENTRY + CHARACTER * TEXT * name.chars().count() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::style::{BLUE, figure};

    #[test]
    fn a_narrow_heading_has_more_lines_of_the_same_letters_and_an_untitled_one_no_title() {
        let key: Vec<_> = (1..=8).map(|k| (format!("cable {k}"), Pen::solid(BLUE, 1.0))).collect();
        let lines = ["from 3.6 mm to 52 mm; 120 of 165 positions held".to_owned()];
        let heading = Heading {
            title: "CoGiRo: static deflection at z = 2 m, payload 50 kg, lengths kept",
            lines: &lines,
            key: &key,
        };
        let drawn = |sheet: Sheet| {
            figure([sheet.width(), 300.0], |area| heading.draw(sheet, area).map(|_| ())).unwrap()
        };
        let (broad, narrow) = (Sheet::paper(180.0), Sheet::paper(88.0));
        for svg in [drawn(broad), drawn(narrow)] {
            let sizes: Vec<&str> =
                svg.split("font-size=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
            let size = |text: &&str| text.parse::<f64>().unwrap();
            assert!(!sizes.is_empty() && sizes.iter().all(|text| (105.0..=120.0).contains(&size(text))));
        }
        assert_eq!(heading.height(narrow) - heading.height(broad), 3.0 * LINE_HEIGHT);
        assert_eq!(heading.height(broad) - heading.height(broad.untitled()), LINE_HEIGHT);
        assert!(drawn(broad).contains("CoGiRo") && !drawn(broad.untitled()).contains("CoGiRo"));
    }
}
