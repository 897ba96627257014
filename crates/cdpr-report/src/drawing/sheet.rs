//! Where a figure is shown: how wide it is laid out, and how its text is broken into lines.

use crate::drawing::style::{CHARACTER, MARGIN, SMALL, TEXT};

/// Widths that can be asked for [mm].
pub const FIGURE_WIDTHS_MM: [f64; 2] = [20.0, 1000.0];

/// Where a figure is shown: how wide it is, and whether it has a title.
///
/// On paper its letters have 7 to 8 points at any width from 78 mm to 235 mm. A narrower figure is that of
/// 78 mm, made smaller, and a broader one that of 235 mm, made larger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheet {
    /// Width of the layout [px].
    width: f64,
    /// Size of the title [px].
    title: f64,
    untitled: bool,
}

/// Size of the letters on paper [pt].
const PAPER_TEXT: f64 = 8.0;
/// Least and greatest width of a layout [px].
const LAYOUTS: [f64; 2] = [330.0, 1000.0];
/// Height of a narrow chart over the width of its figure.
const NARROW_RATIO: f64 = 0.65;
/// Height of a narrow plot, one of several, over the width of its figure.
const PLOT_RATIO: f64 = 0.42;

impl Sheet {
    /// A page on a screen, 700 px wide, with titles.
    pub const SCREEN: Self = Self { width: 700.0, title: 15.0, untitled: false };

    /// A figure of this width in print [mm].
    #[must_use]
    pub fn paper(width_mm: f64) -> Self {
        let [least, greatest] = FIGURE_WIDTHS_MM;
        let points = width_mm.clamp(least, greatest) / 25.4 * 72.0;
        let [least, greatest] = LAYOUTS;
        // Tenths are what coordinates are rounded to.
        let width = (10.0 * (points * TEXT / PAPER_TEXT).clamp(least, greatest)).round() / 10.0;
        Self { width, title: TEXT, untitled: false }
    }

    /// The same without titles, which the captions have.
    #[must_use]
    pub fn untitled(self) -> Self {
        Self { untitled: true, ..self }
    }

    /// Width of the layout [px].
    pub(crate) fn width(self) -> f64 {
        self.width
    }

    /// Size of the title [px].
    pub(crate) fn title_size(self) -> f64 {
        self.title
    }

    pub(crate) fn has_title(self) -> bool {
        !self.untitled
    }

    /// Whether what stands side by side on a screen has to stand one below the other.
    pub(crate) fn is_narrow(self) -> bool {
        self.width < 0.9 * Self::SCREEN.width
    }

    /// Height of a figure of one chart below a heading of this height [px]: at most `most`.
    pub(crate) fn height(self, heading: f64, most: f64) -> f64 {
        (heading + NARROW_RATIO * self.width).min(most.max(heading + 0.5 * most))
    }

    /// Height of one of several plots below each other [px]: at most `most`.
    pub(crate) fn plot_height(self, most: f64) -> f64 {
        most.min(PLOT_RATIO * self.width)
    }

    /// A text between the margins, at most of this size [px]: in one line of smaller letters, if these are no
    /// smaller than the smallest ones, else in several lines. Each line has its size.
    pub(crate) fn lines_of(self, text: &str, size: f64) -> Vec<(String, f64)> {
        let room = (self.width - 2.0 * MARGIN) / CHARACTER;
        let fits = room / text.chars().count().max(1) as f64;
        if fits >= SMALL {
            return vec![(text.to_owned(), fits.min(size))];
        }
        let size = size.min(TEXT);
        lines(text, (room / size) as usize).into_iter().map(|line| (line, size)).collect()
    }
}

/// A text broken between words into lines of at most this number of characters; a longer word has its own
/// line.
pub(crate) fn lines(text: &str, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let words: Vec<&str> = text.split(' ').collect();
    for word in words.chunk_by(|number, unit| belong_together(number, unit)).map(|words| words.join(" ")) {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= most => {
                line.push(' ');
                line.push_str(&word);
            }
            _ => lines.push(word),
        }
    }
    lines
}

/// Whether a word is the unit of the number before it.
fn belong_together(number: &str, unit: &str) -> bool {
    let is_number = number.chars().all(|c| c.is_ascii_digit() || ".,()\u{2212}".contains(c));
    let letters = unit.trim_end_matches([',', ';', '.']).chars().count();
    is_number && letters <= 4 && unit.starts_with(|c: char| c.is_alphabetic() || c == '%')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_have_eight_points_at_the_widths_of_journals() {
        for width_mm in [80.0, 88.0, 90.0, 180.0, 230.0] {
            let points = TEXT / Sheet::paper(width_mm).width() * width_mm / 25.4 * 72.0;
            assert!((points - PAPER_TEXT).abs() < 0.01, "{width_mm} mm: {points} pt");
        }
        assert_eq!(Sheet::paper(20.0).width(), LAYOUTS[0]);
        assert_eq!(Sheet::paper(1000.0).width(), LAYOUTS[1]);
    }

    #[test]
    fn texts_are_broken_between_words() {
        assert_eq!(lines("a bc def gh", 5), ["a bc", "def", "gh"]);
        assert_eq!(lines("abcdefg h", 3), ["abcdefg", "h"]);
        assert_eq!(lines("", 3), [""]);
        // Numbers keep their units.
        assert_eq!(lines("at 2 m, 50 kg", 6), ["at", "2 m,", "50 kg"]);
    }
}
