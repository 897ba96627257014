//! Conversions between Python and the models: arrays, classes of answers, exceptions, threads.

pub(crate) mod answer;
mod arrays;
mod error;
mod json;
mod question;
mod threads;

pub(crate) use answer::answer;
pub(crate) use arrays::{Array, Cases, Columns, Loads, Numbers, Rows, components, filled, whole};
pub(crate) use error::{Answer, Raised};
pub(crate) use json::{json_text, to_json};
pub(crate) use question::question;
pub(crate) use threads::{each, guarded, run, watched};
