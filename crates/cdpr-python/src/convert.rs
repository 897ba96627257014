//! Conversions between Python and the models: arrays, classes of answers, exceptions, threads.

pub(crate) mod answer;
mod arrays;
mod cases;
mod columns;
mod error;
mod json;
mod question;
mod threads;

pub(crate) use answer::{answer, plotted};
pub(crate) use arrays::{Array, Numbers, components, filled, whole};
pub(crate) use cases::{Cases, Loads, Rows};
pub(crate) use columns::Columns;
pub(crate) use error::{Answer, Raised};
pub(crate) use json::{json_text, to_json};
pub(crate) use question::question;
pub(crate) use threads::{each, guarded, run, watched};
