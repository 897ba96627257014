//! Kinds of number for equations that are written once.
//!
//! | kind | for |
//! |---|---|
//! | `f64` | one problem |
//! | [`Dual`] | its derivatives, over any kind of number; nested for second ones |
//! | [`Interval`] | proofs: results that enclose the exact ones |
//! | [`lanes::Lanes`] | several problems at a time, in the lanes of the vector unit |
//!
//! A formula takes the least that it needs: [`Number`] for sums, products, quotients and roots, [`Lanewise`]
//! where it chooses between two numbers, [`Real`] where it branches.
//!
//! ```
//! use cdpr_number::{Dual, Number};
//!
//! fn norm<T: Number>(x: T, y: T) -> T {
//!     (x * x + y * y).sqrt()
//! }
//! assert_eq!(norm(3.0, 4.0), 5.0);
//! let [x, y] = [Dual::input(3.0, 0), Dual::input(4.0, 1)];
//! let Dual { value, slopes: [per_x, per_y] } = norm(x, y);
//! assert!(value == 5.0 && (per_x - 0.6).abs() < 1e-15 && (per_y - 0.8).abs() < 1e-15);
//! ```

pub mod dense;
mod dual;
pub mod eigen;
mod interval;
pub mod lanes;
mod number;
pub mod vector;

pub use dual::Dual;
pub use interval::Interval;
pub use number::{Lanewise, Number, Real};
