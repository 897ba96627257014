//! Files and folders: written whole or not at all, by one owner, read with their path in every error.

pub(crate) mod atomic;
pub(crate) mod disk;
pub(crate) mod files;
pub(crate) mod finite;
pub(crate) mod input;
pub(crate) mod lock;
pub(crate) mod manifest;
pub(crate) mod owned;
pub(crate) mod single;
