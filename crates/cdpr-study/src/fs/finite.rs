//! Tables have no NaN and no infinity: such a cell is empty.

use std::io::{self, Write};

/// Whether a cell is the text of a number that is not finite.
pub fn is_not_finite(cell: &str) -> bool {
    ["NaN", "inf", "-inf"].contains(&cell)
}

/// Longest text of a number that is not finite.
const LONGEST: usize = 4;

/// Writes CSV and leaves the cells of numbers that are not finite empty.
pub(crate) struct FiniteCells<W> {
    inner: W,
    /// Begin of the cell, as long as it may be such a number.
    cell: Option<Vec<u8>>,
    is_quoted: bool,
}

impl<W: Write> FiniteCells<W> {
    pub(crate) fn new(inner: W) -> Self {
        Self { inner, cell: Some(Vec::new()), is_quoted: false }
    }

    /// What is below, with all that was written.
    pub(crate) fn into_inner(mut self) -> io::Result<W> {
        let cell = self.cell.take().unwrap_or_default();
        if !is_not_finite(&String::from_utf8_lossy(&cell)) {
            self.inner.write_all(&cell)?;
        }
        Ok(self.inner)
    }
}

impl<W: Write> Write for FiniteCells<W> {
    fn write(&mut self, text: &[u8]) -> io::Result<usize> {
        let mut out = Vec::with_capacity(text.len() + LONGEST);
        for byte in text {
            self.is_quoted ^= *byte == b'"';
            if matches!(byte, b',' | b'\n' | b'\r') && !self.is_quoted {
                let cell = self.cell.take().unwrap_or_default();
                if !is_not_finite(&String::from_utf8_lossy(&cell)) {
                    out.extend(cell);
                }
                out.push(*byte);
                self.cell = Some(Vec::new());
                continue;
            }
            match &mut self.cell {
                Some(cell) if cell.len() < LONGEST => cell.push(*byte),
                cell => {
                    out.extend(cell.take().unwrap_or_default());
                    out.push(*byte);
                }
            }
        }
        self.inner.write_all(&out)?;
        Ok(text.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_that_are_not_finite_are_empty_and_all_others_are_as_they_were() {
        let text = "a,inf,b\nNaN,1.5,-inf\n\"x,inf,y\",info,\"\"\"\"\r\n,,NaNs\ninf";
        for size in [1, 2, 3, 7, 100] {
            let mut cells = FiniteCells::new(Vec::new());
            text.as_bytes().chunks(size).for_each(|part| cells.write_all(part).unwrap());
            let found = String::from_utf8(cells.into_inner().unwrap()).unwrap();
            assert_eq!(found, "a,,b\n,1.5,\n\"x,inf,y\",info,\"\"\"\"\r\n,,NaNs\n");
        }
    }
}
