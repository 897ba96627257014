//! Estimators that need no more than a table: rows of inputs, and one output a row.
//!
//! The rows may come from anywhere: measurements, another program, an earlier study. Only their inputs are
//! assumed to be independent of each other where a module says so.
//!
//! | question | module |
//! |---|---|
//! | which share of the variance does an input cause alone? | [`rank`] |
//! | does the output depend on an input at all, and with which certainty? | [`hsic`] |
//! | which input makes a limit fail? | [`limit`], by [`hsic`] of an event |
//! | how much does an input move the distribution of the output? | [`pawn`], [`delta`] |
//! | which share does it cause, and take part in, by a polynomial model? | [`expansion`] |
//! | which way does it act? | [`halves`]; words: [`levels`] |
//! | which inputs are certain to matter? | [`verdict`], by the tests of [`evidence`] under [`conditions`] |
//! | which inputs depend on each other? | `verdict::dependence`, `joint`; in a design: `sequence`; on the order of the rows: `order` |
//! | do they because runs have failed? | `verdict::selection` |
//! | how much does an input move the distribution of a vector? | `bures` |
//! | all of these and regression beside each other | [`analysis`] |

pub mod analysis;
#[cfg(feature = "faer")]
pub mod bures;
pub mod conditions;
pub mod data;
pub mod delta;
pub mod evidence;
pub mod expansion;
pub mod halves;
pub mod hsic;
pub mod leading;
pub mod levels;
pub mod limit;
mod measures;
pub mod pawn;
pub mod rank;
pub mod verdict;
