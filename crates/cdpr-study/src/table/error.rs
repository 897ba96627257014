//! What is wrong with a table.

/// What is wrong with a table, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TableError {
    /// The bytes are no text.
    #[error("it is {found}: expected a table as text, CSV in UTF-8")]
    NoText {
        /// What they are.
        found: &'static str,
    },
    /// A line with more or fewer cells than the first one.
    #[error(
        "line {line}: {found} cell{}: expected {expected}, as many as in line {first}{}",
        if *found == 1 { "" } else { "s" },
        if *commas { "; with decimal commas, semicolons between cells" } else { "" }
    )]
    Width {
        /// The line, from 1.
        line: usize,
        /// Its cells.
        found: usize,
        /// Cells of the first line.
        expected: usize,
        /// The first line.
        first: usize,
        /// Whether it may have decimal commas between commas.
        commas: bool,
    },
    /// A name that two columns have.
    #[error("line {line}: column {name} is there twice: expected a different name for each column")]
    Twice {
        /// The line of the names.
        line: usize,
        /// The name.
        name: String,
    },
    /// A quote without an end.
    #[error("line {line}: a quote \" is not closed: expected another one behind the text")]
    Quote {
        /// The line, from 1.
        line: usize,
    },
    /// A cell that is not what its column needs.
    #[error("line {line}, column {column}: `{cell}`: expected {expected}")]
    Cell {
        /// The line, from 1.
        line: usize,
        /// Name of the column.
        column: String,
        /// Text of the cell.
        cell: String,
        /// What would be right.
        expected: String,
    },
}
