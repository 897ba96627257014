//! Tests across crates. The code in the README is compiled and run as a documentation test of this package.

#[doc = include_str!("../README.md")]
pub struct Readme;
