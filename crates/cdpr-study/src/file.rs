//! The files that a user writes, as plain data.

pub(crate) mod cable_law;
pub(crate) mod errors_file;
pub(crate) mod grid;
pub(crate) mod names;
pub(crate) mod output;
pub(crate) mod price;
pub(crate) mod record;
pub(crate) mod sensitivity_spec;
pub(crate) mod study_file;
pub(crate) mod template;
pub(crate) mod weather;

/// Whether a field has the value that it has without being written.
pub(crate) fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}
