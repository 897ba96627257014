//! Robots from and for other programs.
//!
//! [`import`] makes a robot of the files of another program. What they lack is asked for by name
//! ([`ExchangeError::Lacking`]); what was assumed, what looks like a value of a template or is not known, and
//! what a robot file has no place for are listed ([`Note`]). Nothing is dropped in silence. Reading takes
//! time and memory in proportion to the files.
//!
//! [`export`] writes a robot for MuJoCo, CASPR or MoorPy, with the lengths with which it rests at a pose, and
//! the points of its lines for firmware. [`correction_table`] writes lengths on a grid of positions.
//!
//! The crate does no input or output: it reads and writes text in memory.

mod document;
mod draft;
mod error;
mod read;
mod write;

pub use draft::{ImportOptions, Imported, Note, NoteKind};
pub use error::{ExchangeError, FORMATS, Lacking, instead};
pub use read::{ForeignFile, import};
pub use write::scene::Exported;
pub use write::table::{CorrectionTable, TableErrors, correction_table};
pub use write::{Target, export, takers};
