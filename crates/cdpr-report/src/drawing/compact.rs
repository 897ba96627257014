//! The same picture in a shorter text: lines of one pen are one path, and a column of cells one group.

use std::fmt::Write;

/// The fewest cells in a run that become a group.
const CELLS: usize = 8;

/// Shortens the elements of a figure of plotters, which has each element on a line of its own.
pub(crate) fn compact(svg: &str) -> String {
    let mut text = String::with_capacity(svg.len());
    let mut lines = svg.lines().peekable();
    while let Some(line) = lines.next() {
        if let Some((pen, points)) = line_of(line) {
            let mut path = Path::default();
            path.add(points);
            while let Some((_, points)) = lines.peek().and_then(|line| line_of(line)).filter(|of| of.0 == pen)
            {
                path.add(points);
                lines.next();
            }
            let _ = writeln!(text, "<path {pen} d=\"{}\"/>", path.text);
        } else if let Some(first) = Cell::of(line) {
            let mut column = vec![first];
            while let Some(cell) = lines.peek().and_then(|line| Cell::of(line)).filter(|c| c.is_above(&first))
            {
                column.push(cell);
                lines.next();
            }
            write_column(&mut text, &column);
        } else {
            text.push_str(line);
            text.push('\n');
        }
    }
    text
}

/// Pen and points of a line. A translucent one stays: where two of them cross, they are darker.
fn line_of(line: &str) -> Option<(&str, &str)> {
    let found = line.strip_prefix("<polyline ")?.strip_suffix(" \"/>")?.split_once(" points=\"");
    found.filter(|(pen, _)| !pen.contains("opacity"))
}

/// Lines as data of a path, each coordinate relative to the one before.
#[derive(Default)]
struct Path {
    text: String,
    at: [i64; 2],
}

impl Path {
    fn add(&mut self, points: &str) {
        self.text.push('m');
        for (k, number) in
            points.split([' ', ',']).filter_map(|number| number.parse::<i64>().ok()).enumerate()
        {
            let moved = number - self.at[k % 2];
            self.at[k % 2] = number;
            let comma = if k == 0 || moved < 0 { "" } else { "," };
            let _ = write!(self.text, "{comma}{moved}");
        }
    }
}

/// A filled rectangle.
#[derive(Clone, Copy)]
struct Cell<'a> {
    /// x, y, width and height.
    sides: [i64; 4],
    color: &'a str,
}

impl<'a> Cell<'a> {
    fn of(line: &'a str) -> Option<Self> {
        let parts: Vec<_> = line.strip_prefix("<rect x=\"")?.strip_suffix("\"/>")?.split('"').collect();
        let [x, " y=", y, " width=", width, " height=", height, " fill=", color] = parts[..] else {
            return None;
        };
        let side = |text: &str| text.parse().ok();
        Some(Self { sides: [side(x)?, side(y)?, side(width)?, side(height)?], color })
    }

    fn is_above(&self, other: &Self) -> bool {
        (self.sides[0], self.sides[2]) == (other.sides[0], other.sides[2])
    }
}

/// Cells of one column: upright lines as broad as the column, if they are many.
fn write_column(text: &mut String, column: &[Cell]) {
    let [x, _, width, _] = column[0].sides;
    if column.len() < CELLS {
        for Cell { sides: [x, y, width, height], color } in column {
            let sides = format!("x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"");
            let _ = writeln!(text, "<rect {sides} fill=\"{color}\"/>");
        }
        return;
    }
    let middle = x as f64 + 0.5 * width as f64;
    let _ = writeln!(text, "<g stroke-width=\"{width}\" transform=\"translate({middle})\">");
    for Cell { sides: [_, y, _, height], color } in column {
        let _ = writeln!(text, "<path stroke=\"{color}\" d=\"M0,{y}v{height}\"/>");
    }
    text.push_str("</g>\n");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_one_pen_are_one_path_and_a_column_of_cells_a_group() {
        let pen = "fill=\"none\" stroke=\"#000000\" stroke-width=\"8\"";
        let line = |points: &str| format!("<polyline {pen} points=\"{points} \"/>\n");
        let lines = line("10,20 13,15") + &line("13,25 7,25") + "<text>\nA\n</text>\n" + &line("1,1 1,1");
        let path = format!("<path {pen} d=\"m10,20,3-5m0,10-6,0\"/>\n<text>\nA\n</text>\n");
        assert_eq!(compact(&lines), path + &format!("<path {pen} d=\"m1,1,0,0\"/>\n"));
        let clear = line("1,1 2,2").replace("fill", "opacity=\"0.5\" fill");
        assert_eq!(compact(&clear), clear);
        let cell = |x: i64, k: i64| {
            format!("<rect x=\"{x}\" y=\"{}\" width=\"5\" height=\"9\" fill=\"#00000{k}\"/>\n", 9 * k)
        };
        let column = |x: i64, count: i64| (0..count).map(|k| cell(x, k)).collect::<String>();
        let few = column(3, 7) + &column(8, 7);
        assert_eq!(compact(&few), few);
        let many = compact(&(column(3, 8) + &column(8, 2)));
        let group = "<g stroke-width=\"5\" transform=\"translate(5.5)\">";
        assert!(many.starts_with(&format!("{group}\n<path stroke=\"#000000\" d=\"M0,0v9\"/>\n")));
        assert!(many.contains("d=\"M0,63v9\"/>\n</g>\n<rect x=\"8\"") && many.ends_with(&column(8, 2)));
    }
}
