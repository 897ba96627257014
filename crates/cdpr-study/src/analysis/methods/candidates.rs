//! What the methods say of the inputs in the form in which one of them is recommended.

use crate::analysis::measures::InputMeasures;
use crate::analysis::methods::run::{MethodSummary, Run};
use crate::analysis::verdict::recommendation::{
    Basis, Candidate, Said, TotalBounds, by_expansion, joint_level,
};
use cdpr_robot::significant;
use cdpr_sensitivity::{
    Expansion, SaltelliDesign, SensitivityError, Slopes, SobolDesign, SobolIndices, brackets, dgsm,
    sobol_indices,
};

/// Level of each input for the confidence of all together, by derivatives and by Sobol' indices where the
/// study has both.
fn level(run: &Run) -> f64 {
    let bases = if run.spec.saltelli_blocks > 0 { 2 } else { 1 };
    joint_level(run.settings.confidence, run.inputs().len() * bases)
}

/// Bounds of the total shares by derivatives, for all inputs together.
pub(super) fn of_derivatives(
    run: &Run,
    design: &SobolDesign,
    slopes: &[Option<Slopes>],
    summary: &MethodSummary,
) -> Result<Candidate, SensitivityError> {
    let level = level(run);
    let together = brackets(design, slopes, level, run.settings.seed)?;
    let squares = dgsm(design, slopes, level)?.inputs;
    let bounds = together.iter().zip(&squares).map(|(of, square)| TotalBounds {
        low: of.total_lower.low.max(0.0),
        // Estimates of the two bounds may cross.
        at_least: of.total_lower.value.max(0.0).min(of.total_upper.value),
        at_most: of.total_upper.value,
        high: of.total_upper.high.min(1.0),
        few: !square.reliable,
        by_others: square.total_bound.is_none(),
    });
    let points = summary.observations;
    Ok(Candidate {
        basis: Basis::Derivatives,
        measure: "total share of the variance, bounded by ",
        by: format!("exact derivatives at {points} points"),
        failed: summary.failed,
        count: points,
        observations: 1,
        said: Said::Bounds(bounds.collect()),
    })
}

/// The total shares of an expansion within its error.
pub(super) fn of_model(model: &Expansion, summary: &MethodSummary) -> Candidate {
    let bounds = model.indices().into_iter().map(|shares| by_expansion(shares.total, model.leave_one_out));
    let error = significant(100.0 * model.leave_one_out, 2);
    Candidate {
        basis: Basis::Expansion,
        measure: "total share of the variance by ",
        by: format!("a polynomial model, whose error is {error} % of it"),
        failed: summary.failed,
        count: summary.observations,
        observations: 1,
        said: Said::Bounds(bounds.collect()),
    }
}

/// Total Sobol' indices, for all inputs together.
pub(super) fn of_sobol(
    run: &Run,
    design: &SaltelliDesign,
    outputs: &[Option<f64>],
    summary: &MethodSummary,
) -> Result<Candidate, SensitivityError> {
    let level = level(run);
    let SobolIndices { inputs, blocks, .. } = sobol_indices(design, outputs, run.bootstrap(), level)?;
    let bounds = inputs.iter().map(|of| TotalBounds {
        low: of.total.low.max(0.0),
        at_least: of.total.value,
        at_most: of.total.value,
        high: of.total.high.min(1.0),
        few: false,
        by_others: false,
    });
    Ok(Candidate {
        basis: Basis::Sobol,
        measure: "total share of the variance, by ",
        by: format!("{blocks} blocks of Sobol' indices"),
        failed: summary.failed,
        count: blocks,
        observations: run.inputs().len() + 2,
        said: Said::Bounds(bounds.collect()),
    })
}

/// Shapley effects, each with its own interval.
pub(super) fn of_shapley(run: &Run, inputs: &[InputMeasures], summary: &MethodSummary) -> Option<Candidate> {
    let value = |of: &InputMeasures| Some((of.shapley?, Some([of.shapley_low?, of.shapley_high?])));
    let confidence = 100.0 * run.settings.confidence;
    Some(Candidate {
        basis: Basis::Shapley,
        measure: "Shapley effect: share of the variance, ",
        by: format!("{confidence} % confidence for each input"),
        failed: summary.failed,
        count: run.spec.shapley_walks,
        observations: run.inputs().len() + 1,
        said: Said::Values(inputs.iter().map(value).collect::<Option<_>>()?),
    })
}

/// The regression of ranks, which has no bounds. A share that may be chance alone is not resolved.
pub(super) fn of_ranks(inputs: &[InputMeasures], summary: &MethodSummary) -> Option<Candidate> {
    let rows = summary.observations - summary.failed;
    let chance = share_by_chance(inputs.len(), rows, summary.r_squared.unwrap_or(0.0));
    let value = |of: &InputMeasures| {
        let share = of.rank_regression_share?;
        Some((share, (share <= chance).then_some([0.0, (share + chance).min(1.0)])))
    };
    Some(Candidate {
        basis: Basis::Ranks,
        measure: "squared coefficient of ",
        by: "a regression of ranks, without bounds".to_owned(),
        failed: summary.failed,
        count: summary.observations,
        observations: 1,
        said: Said::Values(inputs.iter().map(value).collect::<Option<_>>()?),
    })
}

/// What the greatest squared coefficient of a regression on `inputs` inputs with `rows` rows is by chance
/// alone, at most, in nineteen of twenty cases. A coefficient has the variance (1 - R²)/(n - k - 1) of
/// independent inputs, times (n - 1)/(n - k) for what the columns of so few rows have in common; the tail of
/// a normal law is below exp(-z²/2), and k of them are one twentieth together.
fn share_by_chance(inputs: usize, rows: usize, r_squared: f64) -> f64 {
    if rows <= inputs + 1 {
        return f64::INFINITY;
    }
    let (n, k) = (rows as f64, inputs as f64);
    let variance = (1.0 - r_squared) / (n - k - 1.0) * (n - 1.0) / (n - k);
    2.0 * (20.0 * k).ln() * variance
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::verdict::recommendation::recommend;

    /// What is said of inputs with these shares in a regression of ranks.
    fn said(shares: &[f64], rows: usize, r_squared: f64) -> Vec<String> {
        let of =
            |share: &f64| InputMeasures { rank_regression_share: Some(*share), ..InputMeasures::default() };
        let inputs: Vec<InputMeasures> = shares.iter().map(of).collect();
        let summary =
            MethodSummary { observations: rows, r_squared: Some(r_squared), ..MethodSummary::default() };
        let names: Vec<String> = (1..=shares.len()).map(|i| format!("x{i}")).collect();
        let candidate = of_ranks(&inputs, &summary).unwrap();
        recommend(&names, vec![candidate], 0.95).unwrap().sentences()
    }

    #[test]
    fn a_regression_on_nearly_as_many_inputs_as_rows_leads_nowhere() {
        let noise: Vec<f64> = (0..131).map(|i| 0.2 / f64::from(1 + i)).collect();
        let few = said(&noise, 200, 0.508);
        assert_eq!(few[0], "Leading, without bounds: none.");
        assert!(few[1].starts_with("The regression of ranks explains 0 % of the variance"), "{few:?}");
        // Of many rows the same shares are no chance.
        assert_eq!(said(&noise, 100_000, 0.9)[0], "Leading, without bounds: x1, x2, x3.");
        // Without a degree of freedom nothing is known.
        assert_eq!(said(&noise, 132, 1.0)[0], "Leading, without bounds: none.");
    }
}
