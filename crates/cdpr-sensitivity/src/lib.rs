//! Designs of experiments, laws, fits, effects and global sensitivity indices for any model.
//!
//! The crate works on plain numbers and knows no robot.
//!
//! | step | module |
//! |---|---|
//! | choose the inputs, their laws and steps | [`law`], [`design::input`] |
//! | choose the points at which the model runs | [`design`] and its modules |
//! | summarize the output | [`sample::summary`] |
//! | find the law that the output follows | [`law::fit`], [`law::choice`] |
//! | find the inputs that matter | [`measure::effect`], [`measure::morris`], [`measure::dgsm`] |
//! | the same by a linear model | [`measure::regression`] |
//! | share the variance between the inputs and their interactions | [`measure::sobol_indices`] |
//! | the same from any independent sample | [`measure::expansion`] |
//! | the same from values and derivatives | [`measure::gradient_expansion`] |
//! | analyse a table that was not made by a design of this crate | [`given`] |
//! | tighten tolerances until a limit holds | [`measure::allocation`] |
//! | judge the accuracy and the number of runs | [`sample::interval`], [`measure::convergence`] |
//!
//! The following holds throughout:
//!
//! - A row of a design follows from its index alone. A parallel map gives the same numbers on any number of
//!   threads.
//! - Whatever is random has a seed, which is an argument without a default.
//! - A failed observation is `None`. It is counted, and no mean includes it.
//! - An estimator takes the type of design to which the outputs belong. A design that it would misinterpret
//!   does not compile.
//!
//! ```
//! use cdpr_sensitivity::{Input, Law, Sample, SampleDesign, SobolDesign, student_effects};
//!
//! # fn main() -> Result<(), cdpr_sensitivity::SensitivityError> {
//! // y = 3 x1 - x2, and x3 has no effect.
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
//!
#![doc = include_str!("../ESTIMATORS.md")]

#[doc = include_str!("../README.md")]
#[cfg(doctest)]
struct Readme;

pub mod design;
pub mod error;
mod family;
pub mod given;
pub mod law;
pub mod measure;
mod parallel;
pub mod sample;

pub use design::correlated::Correlated;
pub use design::group::Group;
pub use design::halton::Halton;
pub use design::input::{Input, Steps};
pub use design::latin_hypercube::LatinHypercube;
pub use design::morris::MorrisDesign;
pub use design::observation::observe;
pub use design::random::RandomDesign;
pub use design::saltelli::{Order, SaltelliDesign};
pub use design::shapley::ShapleyDesign;
pub use design::sobol::{Sobol, SobolDesign};
pub use design::{IndependentSample, JointSample, Layout, POINTS_VERSION, SampleDesign};
pub use error::{RowPattern, SensitivityError};
pub use family::Family;
pub use given::analysis::{Analyser, Analysis, CorrelatedPair, InputAnalysis};
#[cfg(feature = "faer")]
pub use given::bures::{WassersteinBures, wasserstein_bures};
pub use given::conditions::{Concern, Condition};
pub use given::data::GivenData;
pub use given::delta::{Delta, delta};
pub use given::evidence::Measure;
pub use given::expansion::{GivenExpansion, given_expansion};
pub use given::halves::{Half, halves};
pub use given::hsic::{Dependence, Rows, dependence, dependence_of_event};
pub use given::leading::LeadingInputs;
pub use given::levels::LevelMean;
pub use given::limit::{InputAtLimit, Limit, LimitFailures};
pub use given::pawn::{Pawn, pawn};
pub use given::rank::rank_indices;
pub use given::verdict::{Doubt, Finding, Verdict};
pub use law::fit::{Fit, fit, fit_all, ks_distance};
pub use law::verdict::{BestFit, DECIDED, Evidence, REJECTED, is_possible};
pub use law::{Law, Support};
pub use measure::allocation::allocate;
pub use measure::bracket::{Bracket, brackets};
pub use measure::convergence::{Target, Tightened, convergence, first_tight, until_tight};
pub use measure::dgsm::{DerivativeMeasure, DerivativeMeasures, Slopes, dgsm};
pub use measure::distance::{NormalDistance, normal_distance};
pub use measure::effect::{
    Effect, EffectInterval, EffectSums, Effects, Replicate, effect_intervals, intervals_of_effects,
    student_effects,
};
pub use measure::expansion::basis::Polynomials;
pub use measure::expansion::polynomial::{Power, Truncation};
pub use measure::expansion::{Expansion, PairShare, Shares, Term, expansion};
pub use measure::gradient_expansion::gradient_expansion;
pub use measure::morris::{MorrisEffect, morris_effects};
pub use measure::poincare::poincare_constant;
pub use measure::regression::{Coefficient, Regression, rank_correlation, rank_regression, regression};
pub use measure::shapley::{ShapleyEffect, shapley_effects};
pub use measure::sobol_indices::{PairIndex, SobolIndex, SobolIndices, sobol_indices, vector_sobol_indices};
#[cfg(feature = "faer")]
pub use measure::subspace::{ActiveSubspace, active_subspace};
pub use sample::interval::{Estimate, is_resolved};
pub use sample::random::{Bootstrap, derived_seed};
pub use sample::summary::{Bins, Histogram, Moments, Sample, Summary};
