//! Heading of a figure: title, lines and key above the charts.

use crate::drawing::style::{Area, CHARACTER, DrawingError, LINE_HEIGHT, MARGIN, Pen, TEXT, WIDTH, px, text};

const TITLE: f64 = 15.0;
/// Height at which the title stands [px].
pub(crate) const TITLE_AT: f64 = MARGIN + 0.5 * LINE_HEIGHT;
/// Smallest readable text of a key [px].
const SMALL: f64 = 9.0;
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
    pub(crate) fn height(&self) -> f64 {
        let rows = 1 + self.lines.len() + self.key_rows().count();
        MARGIN + LINE_HEIGHT * rows as f64 + 4.0
    }

    /// Draws the heading and returns the rest of the area.
    pub(crate) fn draw<'a>(&self, area: &Area<'a>) -> Result<Area<'a>, DrawingError> {
        let (head, rest) = area.split_vertically(px(self.height()));
        let mut y = TITLE_AT;
        text(&head, self.title, TITLE, (MARGIN, y))?;
        for line in self.lines {
            y += LINE_HEIGHT;
            text(&head, line, TEXT, (MARGIN, y))?;
        }
        for row in self.key_rows() {
            y += LINE_HEIGHT;
            let size = key_size(row);
            let mut x = MARGIN;
            for (name, pen) in row {
                pen.draw(&head, vec![(px(x), px(y)), (px(x + KEY_LINE), px(y))])?;
                text(&head, name, size, (x + KEY_LINE + KEY_GAP, y))?;
                x += KEY_ENTRY + CHARACTER * size * name.chars().count() as f64;
            }
        }
        Ok(rest)
    }

    /// Splits the key into two rows if its text would be too small in one.
    fn key_rows(&self) -> impl Iterator<Item = &[(String, Pen)]> {
        let rows = if key_size(self.key) < SMALL { 2 } else { 1 };
        self.key.chunks(self.key.len().div_ceil(rows).max(1))
    }
}

/// Size of the text in a row of a key [px].
fn key_size(row: &[(String, Pen)]) -> f64 {
    let characters: usize = row.iter().map(|(name, _)| name.chars().count()).sum();
    let room = WIDTH - 2.0 * MARGIN - KEY_ENTRY * row.len() as f64;
    TEXT.min(room / (CHARACTER * characters as f64))
}
