//! The measures of sensitivity: their names, what they estimate, and where they stand.

use serde::{Deserialize, Serialize};

/// Values of the measures for one input; `None` for a method that has failed or is not asked for.
///
/// Indices of vectors, Shapley effects and others that a study asks for have no column and no key without a
/// value.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct InputMeasures {
    /// Name of the input.
    pub input: String,
    /// The paper's t-Student index (section 5.2).
    pub t_student: Option<f64>,
    /// Mean output in the upper half of its range minus that in the lower half, in the unit of the output.
    #[serde(rename = "signed_effect_mm")]
    pub signed_effect: Option<f64>,
    /// Share of the variance to first order, from exact derivatives at the nominal robot.
    pub derivative_share: Option<f64>,
    /// Squared standardized regression coefficient.
    pub regression_share: Option<f64>,
    /// The same of ranks.
    pub rank_regression_share: Option<f64>,
    /// Morris's mean absolute elementary effect, between probabilities 0 and 1, in the same unit.
    #[serde(rename = "morris_mean_absolute_mm")]
    pub morris_mean_absolute: Option<f64>,
    /// Lower end of its interval.
    #[serde(rename = "morris_low_mm", default)]
    pub morris_low: Option<f64>,
    /// Upper end of its interval.
    #[serde(rename = "morris_high_mm", default)]
    pub morris_high: Option<f64>,
    /// Whether that interval has its confidence: the mean rests on enough effects
    /// ([`cdpr_sensitivity::MorrisEffect::reliable`]).
    #[serde(default)]
    pub morris_reliable: Option<bool>,
    /// Deviation of its elementary effects, in the same unit.
    #[serde(rename = "morris_std_mm")]
    pub morris_std: Option<f64>,
    /// Bound on its total index from derivatives; `None` for a law without a known constant.
    pub dgsm_total_bound: Option<f64>,
    /// Upper end of its interval; `None` where too few rows decide the mean square
    /// ([`cdpr_sensitivity::DerivativeMeasure::reliable`]).
    #[serde(default)]
    pub dgsm_total_bound_high: Option<f64>,
    /// Lower bound of its first-order index, from exact derivatives (`cdpr_sensitivity::brackets`).
    pub first_lower: Option<f64>,
    /// Lower end of the interval of that bound.
    pub first_lower_low: Option<f64>,
    /// Lower bound of its total index.
    pub total_lower: Option<f64>,
    /// Lower end of the interval of that bound.
    pub total_lower_low: Option<f64>,
    /// Upper bound of its total index, and of its first-order index.
    pub total_upper: Option<f64>,
    /// Upper end of the interval of that bound.
    pub total_upper_high: Option<f64>,
    /// Index of the first order of the chaos expansion.
    pub expansion_first: Option<f64>,
    /// Its total index.
    pub expansion_total: Option<f64>,
    /// Index of the first order of the expansion that is fitted to derivatives as well.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gradient_expansion_first: Option<f64>,
    /// Its total index.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gradient_expansion_total: Option<f64>,
    /// Sobol' index of the first order.
    pub sobol_first: Option<f64>,
    /// Lower end of its interval.
    pub sobol_first_low: Option<f64>,
    /// Upper end of its interval.
    pub sobol_first_high: Option<f64>,
    /// Total Sobol' index.
    pub sobol_total: Option<f64>,
    /// Lower end of its interval.
    pub sobol_total_low: Option<f64>,
    /// Upper end of its interval.
    pub sobol_total_high: Option<f64>,
    /// First-order index of the study's vector ([`crate::VectorOutput`]): of the sum of the variances of its
    /// components.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub vector_first: Option<f64>,
    /// Lower end of its interval.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub vector_first_low: Option<f64>,
    /// Upper end of its interval.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub vector_first_high: Option<f64>,
    /// Total index of this vector.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub vector_total: Option<f64>,
    /// Lower end of its interval.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub vector_total_low: Option<f64>,
    /// Upper end of its interval.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub vector_total_high: Option<f64>,
    /// Index of Wasserstein and Bures of this vector, or of another output.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bures: Option<f64>,
    /// Lower end of its interval.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bures_low: Option<f64>,
    /// Upper end of its interval.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bures_high: Option<f64>,
    /// Part of it that the means cause.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bures_means: Option<f64>,
    /// Shapley effect.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shapley: Option<f64>,
    /// Lower end of its interval.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shapley_low: Option<f64>,
    /// Upper end of its interval.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shapley_high: Option<f64>,
    /// Activity score: its part in all directions along which the output varies.
    pub activity: Option<f64>,
}

/// Values of the measures for a group of inputs; `None` for a method that has failed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct GroupMeasures {
    /// Name of the group.
    pub group: String,
    /// Names of its inputs.
    pub inputs: Vec<String>,
    /// Morris's mean absolute elementary effect of the whole group, in the unit of the output.
    #[serde(rename = "morris_mean_absolute_mm")]
    pub morris_mean_absolute: Option<f64>,
    /// Whether it rests on enough effects for an interval.
    #[serde(default)]
    pub morris_reliable: Option<bool>,
    /// Share of the variance that its inputs cause alone and with each other.
    pub sobol_first: Option<f64>,
    /// Lower end of its interval.
    pub sobol_first_low: Option<f64>,
    /// Upper end of its interval.
    pub sobol_first_high: Option<f64>,
    /// Share in which any of its inputs takes part.
    pub sobol_total: Option<f64>,
    /// Lower end of its interval.
    pub sobol_total_low: Option<f64>,
    /// Upper end of its interval.
    pub sobol_total_high: Option<f64>,
}

/// The active subspace of the output, in standard deviations of the inputs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SubspaceSummary {
    /// Mean square of the slope along each direction, in descending order, in the square of the unit of the
    /// output.
    pub eigenvalues: Vec<f64>,
    /// Lower ends of their intervals.
    pub low: Vec<f64>,
    /// Upper ends of their intervals.
    pub high: Vec<f64>,
    /// Number of directions that have 90 % of the sum, with its least and greatest over the bootstrap.
    pub needed_90: [usize; 3],
    /// The same for 99 %.
    pub needed_99: [usize; 3],
    /// The first direction, one component per input.
    pub first: Vec<f64>,
}

impl InputMeasures {
    /// The first-order index lies between these, by derivatives and with the study's confidence at each end.
    #[must_use]
    pub fn first_bracket(&self) -> Option<[f64; 2]> {
        Some([self.first_lower_low?, self.total_upper_high?])
    }

    /// The total index lies between these, by derivatives and with the study's confidence at each end.
    #[must_use]
    pub fn total_bracket(&self) -> Option<[f64; 2]> {
        Some([self.total_lower_low?, self.total_upper_high?])
    }
}

/// A measure of sensitivity.
#[derive(Clone, Copy, Debug)]
pub struct Measure {
    /// Its column in `NAME_sensitivity.csv` and its key in `summary.json`, as those of deflections have it
    /// ([`crate::Output::named`]).
    pub name: &'static str,
    /// Its name in tables and figures.
    pub label: &'static str,
    /// What it estimates.
    pub quantity: Quantity,
    /// Whether inputs are ranked by this measure; one measure of each method ranks them.
    pub ranks: bool,
    /// Its value for an input.
    pub value: fn(&InputMeasures) -> Option<f64>,
    /// The interval of that value, where the method gives one.
    pub interval: fn(&InputMeasures) -> Option<[f64; 2]>,
}

/// What a measure estimates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// An index without a unit whose size only ranks.
    Index,
    /// A change of the output, in its unit.
    Change,
    /// A share of the variance.
    ///
    /// Without interactions, shares of the first order add up to 1, and so do total ones.
    Share,
    /// An upper bound on the total share of the variance.
    Bound,
}

/// All measures, in the order of tables.
pub const MEASURES: [Measure; 18] = [
    Measure::new("t_student", "t-Student", Quantity::Index, |input| input.t_student).ranking(),
    Measure::new("signed_effect_mm", "signed effect", Quantity::Change, |input| input.signed_effect),
    Measure::new("derivative_share", "derivatives", Quantity::Share, |input| input.derivative_share)
        .ranking(),
    Measure::new("regression_share", "SRC\u{b2}", Quantity::Share, |input| input.regression_share).ranking(),
    Measure::new("rank_regression_share", "rank SRC\u{b2}", Quantity::Share, |input| {
        input.rank_regression_share
    })
    .ranking(),
    Measure::new("morris_mean_absolute_mm", "Morris \u{b5}*", Quantity::Change, |input| {
        input.morris_mean_absolute
    })
    .within(|input| Some([input.morris_low?, input.morris_high?]))
    .ranking(),
    Measure::new("morris_std_mm", "Morris \u{3c3}", Quantity::Change, |input| input.morris_std),
    Measure::new("dgsm_total_bound", "DGSM bound", Quantity::Bound, |input| input.dgsm_total_bound).ranking(),
    Measure::new("expansion_first", "expansion", Quantity::Share, |input| input.expansion_first),
    Measure::new("sobol_first", "Sobol' first", Quantity::Share, |input| input.sobol_first)
        .within(|input| Some([input.sobol_first_low?, input.sobol_first_high?])),
    Measure::new("expansion_total", "expansion total", Quantity::Share, |input| input.expansion_total)
        .ranking(),
    Measure::new("gradient_expansion_first", "gradient expansion", Quantity::Share, |input| {
        input.gradient_expansion_first
    }),
    Measure::new("gradient_expansion_total", "gradient expansion total", Quantity::Share, |input| {
        input.gradient_expansion_total
    })
    .ranking(),
    Measure::new("sobol_total", "Sobol' total", Quantity::Share, |input| input.sobol_total)
        .within(|input| Some([input.sobol_total_low?, input.sobol_total_high?]))
        .ranking(),
    Measure::new("vector_first", "vector first", Quantity::Share, |input| input.vector_first)
        .within(|input| Some([input.vector_first_low?, input.vector_first_high?])),
    Measure::new("vector_total", "vector total", Quantity::Share, |input| input.vector_total)
        .within(|input| Some([input.vector_total_low?, input.vector_total_high?])),
    Measure::new("bures", "Wasserstein-Bures", Quantity::Index, |input| input.bures)
        .within(|input| Some([input.bures_low?, input.bures_high?])),
    Measure::new("shapley", "Shapley", Quantity::Share, |input| input.shapley)
        .within(|input| Some([input.shapley_low?, input.shapley_high?])),
];

impl Measure {
    const fn new(
        name: &'static str,
        label: &'static str,
        quantity: Quantity,
        value: fn(&InputMeasures) -> Option<f64>,
    ) -> Self {
        Self { name, label, quantity, ranks: false, value, interval: |_| None }
    }

    const fn ranking(self) -> Self {
        Self { ranks: true, ..self }
    }

    const fn within(self, interval: fn(&InputMeasures) -> Option<[f64; 2]>) -> Self {
        Self { interval, ..self }
    }
}
