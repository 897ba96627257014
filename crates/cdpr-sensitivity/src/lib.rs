//! Designs of experiments, laws, fits, effects and global sensitivity indices, for any model: plain numbers in, plain
//! numbers out.
//!
//! | step | module |
//! |---|---|
//! | which inputs, with which law and steps | [`law`], [`design::input`] |
//! | at which points to run the model | [`design`] on [`design::sobol`], [`design::latin_hypercube`], [`design::halton`], [`design::correlated`]; [`design::saltelli`], [`design::morris`] |
//! | what the output looks like | [`sample::summary`] |
//! | which law it follows | [`law::fit`] |
//! | which input matters | [`measure::effect`], [`measure::morris`], [`measure::dgsm`], [`measure::regression`] |
//! | how much of the variance it causes, alone and with others | [`measure::sobol_indices`], [`measure::expansion`] |
//! | which tolerances to tighten for a limit | [`measure::allocation`] |
//! | how sure that is, and how many runs would do | [`sample::interval`], [`measure::convergence`] |
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

pub mod design;
pub mod error;
pub mod law;
pub mod measure;
pub mod sample;

pub use design::correlated::Correlated;
pub use design::halton::Halton;
pub use design::input::{Input, Steps};
pub use design::latin_hypercube::LatinHypercube;
pub use design::morris::MorrisDesign;
pub use design::observation::observe;
pub use design::random::RandomDesign;
pub use design::saltelli::{Order, SaltelliDesign};
pub use design::sobol::{Sobol, SobolDesign};
pub use design::{IndependentSample, JointSample, SampleDesign};
pub use error::SensitivityError;
pub use law::Law;
pub use law::family::Family;
pub use law::fit::{Fit, best, fit, fit_all, ks_distance};
pub use measure::allocation::allocate;
pub use measure::convergence::{Target, Tightened, convergence, first_tight, until_tight};
pub use measure::dgsm::{DerivativeMeasure, DerivativeMeasures, Slopes, dgsm, poincare_constant};
pub use measure::effect::{
    Effect, EffectInterval, EffectSums, Effects, effect_intervals, intervals_of_effects, student_effects,
};
pub use measure::expansion::polynomial::{Power, Truncation};
pub use measure::expansion::{Expansion, Shares, Term, expansion};
pub use measure::morris::{MorrisEffect, morris_effects};
pub use measure::regression::{Coefficient, Regression, rank_correlation, rank_regression, regression};
pub use measure::sobol_indices::{PairIndex, SobolIndex, SobolIndices, sobol_indices};
pub use sample::interval::Estimate;
pub use sample::random::Bootstrap;
pub use sample::summary::{Bins, Histogram, Moments, Sample, Summary};
