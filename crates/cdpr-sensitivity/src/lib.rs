//! Designs of experiments, laws, fits, effects and global sensitivity indices, for any model: plain numbers in, plain
//! numbers out.
//!
//! | step | module |
//! |---|---|
//! | which inputs, with which law and steps | [`law`], [`input`] |
//! | at which points to run the model | [`design`] on [`sobol`], [`latin_hypercube`], [`halton`], [`correlated`]; [`saltelli`], [`morris`] |
//! | what the output looks like | [`summary`] |
//! | which law it follows | [`mod@fit`] |
//! | which input matters | [`effect`], [`morris`], [`mod@dgsm`], [`mod@regression`] |
//! | how much of the variance it causes, alone and with others | [`sobol_indices`](mod@sobol_indices), [`pce`] |
//! | which tolerances to tighten for a limit | [`allocation`] |
//! | how sure that is, and how many runs would do | [`interval`], [`mod@convergence`] |
//!
//! What holds throughout:
//!
//! - a row of a design is had from its index alone: a parallel map gives the same numbers on any number of threads;
//! - what is random has a seed, an argument without a default;
//! - an observation that failed is `None`: counted beside the results, part of no mean;
//! - an estimator takes the design that the outputs belong to, and no design that it would misread.
//!
//! ```
//! use cdpr_sensitivity::{Input, Law, Sample, SampleDesign, SobolDesign, student_effects};
//!
//! # fn main() -> Result<(), cdpr_sensitivity::SensitivityError> {
//! // y = 3 x1 - x2, and an x3 that does nothing.
//! let unit = Law::Uniform { min: -1.0, max: 1.0 };
//! let inputs = ["x1", "x2", "x3"].map(|name| Input::continuous(name, unit)).to_vec();
//! let design = SobolDesign::new(inputs, 0, 2048)?;
//!
//! let mut row = [0.0; 3];
//! let mut outputs = Vec::new();
//! for index in 0..design.points() {
//!     design.row(index, &mut row)?;
//!     outputs.push(Some(3.0 * row[0] - row[1]));
//! }
//!
//! let effects = student_effects(&design, &outputs)?;
//! let signed: Vec<f64> = effects.effects.iter().map(|effect| effect.effect).collect();
//! assert!((signed[0] - 3.0).abs() < 0.01); // b (max - min) / 2
//! assert!((signed[1] + 1.0).abs() < 0.01);
//! assert!(signed[2].abs() < 0.01);
//!
//! let median = Sample::new(&outputs)?.quantile(0.5)?;
//! assert!(median.abs() < 0.01);
//! # Ok(())
//! # }
//! ```

#[doc = include_str!("../README.md")]
#[cfg(doctest)]
struct Readme;

pub mod allocation;
pub mod convergence;
pub mod correlated;
pub mod design;
pub mod dgsm;
pub mod effect;
pub mod error;
mod estimate;
pub mod fit;
pub mod halton;
pub mod input;
pub mod interval;
pub mod latin_hypercube;
pub mod law;
mod least_squares;
pub mod morris;
mod normal;
pub mod observation;
pub mod pce;
pub mod polynomial;
mod pursuit;
pub mod regression;
pub mod saltelli;
pub mod sobol;
pub mod sobol_indices;
pub mod summary;

pub use allocation::allocate;
pub use convergence::{Target, Tightened, convergence, first_tight, until_tight};
pub use correlated::Correlated;
pub use design::{IndependentSample, JointSample, RandomDesign, SampleDesign, SobolDesign};
pub use dgsm::{DerivativeMeasure, DerivativeMeasures, Slopes, dgsm, poincare_constant};
pub use effect::{
    Effect, EffectInterval, EffectSums, Effects, effect_intervals, intervals_of_effects, student_effects,
};
pub use error::SensitivityError;
pub use fit::{Bootstrap, Family, Fit, best, fit, fit_all, ks_distance};
pub use halton::Halton;
pub use input::{Input, Steps};
pub use interval::Estimate;
pub use latin_hypercube::LatinHypercube;
pub use law::Law;
pub use morris::{MorrisDesign, MorrisEffect, morris_effects};
pub use observation::observe;
pub use pce::{Expansion, Shares, Term, expansion};
pub use polynomial::{Power, Truncation};
pub use regression::{Coefficient, Regression, rank_correlation, rank_regression, regression};
pub use saltelli::{Order, SaltelliDesign};
pub use sobol::Sobol;
pub use sobol_indices::{PairIndex, SobolIndex, SobolIndices, sobol_indices};
pub use summary::{Bins, Histogram, Moments, Sample, Summary};
