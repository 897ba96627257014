//! The report and the explorer in a real browser.
//!
//! Screenshots for a person to look at are left in `target/report-screenshots`. `.ci/run` runs this test by
//! its name; a plain `cargo test` leaves it out, because it needs Chromium.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::print_stdout)]

#[path = "../common.rs"]
mod common;
mod explorer;
mod fields;
mod kinds;
mod layout;
mod page;
mod points;
mod report;
mod timeline;
