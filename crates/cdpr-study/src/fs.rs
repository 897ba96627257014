//! Files and folders: written whole or not at all, read with their path in every error.

pub(crate) mod atomic;
pub(crate) mod files;
pub(crate) mod input;
