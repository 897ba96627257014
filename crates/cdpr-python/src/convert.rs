//! Conversions between Python and the models: arrays, classes of answers, exceptions, threads.

pub(crate) mod answer;
pub(crate) mod arrays;
pub(crate) mod error;
pub(crate) mod json;
pub(crate) mod threads;
