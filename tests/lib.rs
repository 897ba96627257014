//! Tests across crates. The code in the README is compiled and run as a documentation test of this package.

// Not in the package, which is built without it.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
