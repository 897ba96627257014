//! The field `sensitivity` of the study file: how many observations each measure of sensitivity has.

use crate::file::output::VectorOutput;
use cdpr_sensitivity::given::bures::MIN_ROWS;
use cdpr_sensitivity::measure::shapley::MIN_WALKS;
use cdpr_sensitivity::{Expansion, SobolIndices, Truncation};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Points with exact derivatives behind the verdict on a sampling whose study has no measures of sensitivity.
pub(crate) const VERDICT_POINTS: usize = 256;

/// Observations behind the measures of sensitivity, for k inputs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SensitivitySpec {
    /// Number of observations, the first of the sampling, behind t-Student, regressions and expansion: 3 to
    /// 65536, but no more than the sampling has.
    pub observations: usize,
    /// Saltelli's blocks behind Sobol' indices, of k + 2 observations: 16 to 1048576, or 0 for none.
    pub saltelli_blocks: usize,
    /// Bootstrap resamples behind the intervals of Sobol' indices: 2 to 1048576.
    pub bootstrap_resamples: usize,
    /// Blocks behind Morris's elementary effects, of k + 1 observations: 2 to 1048576.
    pub morris_blocks: usize,
    /// Levels of the grid on which trajectories take the place of radial blocks behind Morris's effects: an
    /// even number, 2 to 1024. Their effects are bounded where the output jumps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub morris_levels: Option<u32>,
    /// Points at which exact derivatives are taken: 2 to 1048576. The bounds of first-order and total indices
    /// on both sides need 40.
    pub derivative_points: usize,
    /// Walks behind Shapley effects, of k + 1 observations: 16 to 1048576, or 0 for none. They share the
    /// variance between the inputs, also between correlated ones.
    #[serde(skip_serializing_if = "crate::file::is_default")]
    pub shapley_walks: usize,
    /// Random observations behind the index of Wasserstein and Bures: how much a parameter moves the law of
    /// the vector below, or of another output. 64 to 1048576, or 0 for none.
    #[serde(skip_serializing_if = "crate::file::is_default")]
    pub bures_observations: usize,
    /// The vector of the indices of vectors and of Wasserstein and Bures: "displacement" without the field,
    /// or {"pose": {"characteristic_length": L}} for displacement and rotation times L [m].
    #[serde(skip_serializing_if = "crate::file::is_default")]
    pub vector: VectorOutput,
    /// Whether an expansion is fitted to the derivatives as well, at the points where they are taken.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub gradient_expansion: bool,
    /// Products of polynomials that the chaos expansion chooses from.
    pub expansion: Truncation,
}

impl Default for SensitivitySpec {
    fn default() -> Self {
        Self {
            observations: 2000,
            saltelli_blocks: 4096,
            bootstrap_resamples: 1000,
            morris_blocks: 128,
            morris_levels: None,
            derivative_points: 256,
            shapley_walks: 0,
            bures_observations: 0,
            vector: VectorOutput::Displacement,
            gradient_expansion: false,
            expansion: Truncation { max_degree: 3, norm: 0.75, interactions: 2 },
        }
    }
}

impl SensitivitySpec {
    /// Keeps this share of all observations, of blocks a power of two, and no fewer than each measure needs.
    /// Points with derivatives take little time and remain.
    pub(crate) fn shorten(&mut self, share: f64) {
        let fewer = |count: usize, least: usize| ((share * count as f64) as usize).max(least.min(count));
        let power = |count: usize| if count == 0 { 0 } else { 1 << count.ilog2() };
        self.observations = fewer(self.observations, 3);
        self.saltelli_blocks = power(fewer(self.saltelli_blocks, SobolIndices::MIN_BLOCKS));
        self.morris_blocks = power(fewer(self.morris_blocks, 2));
        self.shapley_walks = fewer(self.shapley_walks, MIN_WALKS);
        self.bures_observations = fewer(self.bures_observations, MIN_ROWS);
    }

    /// The first invalid setting: field, value, and what is expected.
    pub(crate) fn invalid(&self) -> Option<(&'static str, String, String)> {
        const MOST: usize = 1 << 20;
        let Truncation { max_degree, norm, interactions } = self.expansion;
        let counts = [
            ("observations", self.observations, 3..=1 << 16),
            (
                "saltelli_blocks",
                self.saltelli_blocks.max(SobolIndices::MIN_BLOCKS),
                SobolIndices::MIN_BLOCKS..=MOST,
            ),
            ("bootstrap_resamples", self.bootstrap_resamples, 2..=MOST),
            ("morris_blocks", self.morris_blocks, 2..=MOST),
            ("derivative_points", self.derivative_points, 2..=MOST),
            ("shapley_walks", self.shapley_walks.max(MIN_WALKS), MIN_WALKS..=MOST),
            ("bures_observations", self.bures_observations.max(MIN_ROWS), MIN_ROWS..=MOST),
            ("expansion.max_degree", max_degree, 1..=Expansion::MAX_DEGREE),
            ("expansion.interactions", interactions, 1..=MOST),
        ];
        // Zero leaves these out.
        let few = [
            ("saltelli_blocks", self.saltelli_blocks, SobolIndices::MIN_BLOCKS),
            ("shapley_walks", self.shapley_walks, MIN_WALKS),
            ("bures_observations", self.bures_observations, MIN_ROWS),
        ];
        let few = few.into_iter().find(|(_, value, least)| (1..*least).contains(value));
        let of_few = |(field, value, least): (_, usize, usize)| {
            (field, value.to_string(), format!("0, or at least {least}"))
        };
        let count = counts.into_iter().find(|(_, value, range)| !range.contains(value));
        let of_count = |(field, value, range): (_, usize, std::ops::RangeInclusive<usize>)| {
            (field, value.to_string(), format!("{} to {}", range.start(), range.end()))
        };
        let uneven =
            self.morris_levels.filter(|levels| !(levels.is_multiple_of(2) && (2..=1024).contains(levels)));
        let of_levels =
            |levels: u32| ("morris_levels", levels.to_string(), "an even number from 2 to 1024".to_owned());
        let length = match self.vector {
            VectorOutput::Pose { characteristic_length: length } => Some(length),
            VectorOutput::Displacement => None,
        };
        let unsound = length.filter(|length| !(length.is_finite() && *length > 0.0));
        let of_length = |length: f64| {
            ("vector.pose.characteristic_length", length.to_string(), "a length above 0 [m]".to_owned())
        };
        let sound_norm = norm > 0.0 && norm <= 1.0;
        let of_norm = || ("expansion.norm", norm.to_string(), "a number above 0, at most 1".to_owned());
        count
            .map(of_count)
            .or_else(|| few.map(of_few))
            .or_else(|| uneven.map(of_levels))
            .or_else(|| unsound.map(of_length))
            .or_else(|| (!sound_norm).then(of_norm))
    }
}
