//! What a fit answers.

use crate::error::CalibrationError;
use crate::fit::problem::{Problem, Seen};
use crate::fit::search::{Found, Linearized, NEAR_ENOUGH};
use crate::fitted::{Estimate, Fit, UnidentifiableCombination};
use crate::identify::own_parameters;
use crate::solve::Decomposed;
use cdpr_robot::Parameter;
use nalgebra::{DMatrix, DVector};

impl Problem<'_> {
    pub(super) fn conclude(
        &self,
        Found { state, at, steps, distance }: Found,
        (before, poses_before): Seen,
        same: usize,
    ) -> Result<Fit, CalibrationError> {
        let unknowns = self.model.unknowns;
        let robot = self.model.deviating(&state.shared.x)?;
        let compared = self.compared(&state, &robot)?;
        let after = self.differences(&compared);
        let whole = self.decomposed(&at, &state.shared.x, true);
        let data = self.decomposed(&at, &state.shared.x, false);
        let count = unknowns.all.len();
        let scales = DVector::from_iterator(count, unknowns.all.iter().map(|unknown| unknown.scale));
        let scaled = |mut matrix: DMatrix<f64>| {
            for i in 0..count {
                for j in 0..count {
                    matrix[(i, j)] *= scales[i] * scales[j];
                }
            }
            matrix
        };
        let covariance = scaled(whole.covariance());
        // By the data alone, each unknown's share of every combination, however little the data tell it.
        let of_data = |j: usize| {
            let floor = crate::solve::ROUNDING * data.values.max().max(1.0);
            let of = |k: usize| data.vectors[(k, j)] / data.values[k].max(floor);
            let variance: f64 = (0..count).map(|k| of(k).powi(2)).sum();
            // In scales: below 1 it is told.
            (variance < 1.0).then(|| variance.sqrt() * scales[j])
        };
        let estimates = (0..count)
            .map(|j| {
                let unknown = &unknowns.all[j];
                let std_of_data = of_data(j);
                // Without a prior, what a combination that keeps its value adds counts, too.
                let with_prior = unknown.prior.map(|_| covariance[(j, j)].max(0.0).sqrt());
                Estimate {
                    name: unknown.name.clone(),
                    value: state.shared.x[j],
                    std: with_prior.or(std_of_data),
                    std_of_data,
                    prior_std: unknown.prior.map(|[_, std]| std),
                }
            })
            .collect();
        let numbers: usize = after.len();
        let own: usize = compared.iter().map(|of| of.per_own.ncols()).sum();
        let told = (0..count).filter(|k| whole.tells(*k)).count();
        let priors: Vec<_> = self.priors(&state.shared.x).map(|(_, r, _)| r * r).collect();
        let chi_square =
            compared.iter().map(|of| of.residuals.norm_squared()).sum::<f64>() + priors.iter().sum::<f64>();
        Ok(Fit {
            robot,
            estimates,
            frame: state.shared.frame,
            origin: state.shared.origin + self.translation(&state),
            deviations: unknowns.deviations(Parameter::of(self.model.robot).len(), &state.shared.x),
            covariance,
            unidentifiable: self.unidentifiable(&data),
            chi_square,
            degrees_of_freedom: (numbers + priors.len()).saturating_sub(own + told),
            before,
            after,
            poses_before,
            lines: self.rows.iter().map(|row| row.line).collect(),
            payloads: self.rows.iter().map(|row| row.load.payload).collect(),
            poses: state.rows.iter().map(|row| *row.pose()).collect(),
            steps,
            converged: distance < NEAR_ENOUGH,
            distance,
            same,
            unknowns: unknowns.clone(),
        })
    }

    /// Inputs of parameters that have to be known so that the data tell all others.
    pub(super) fn unidentifiable_inputs(&self, at: &Linearized) -> Vec<usize> {
        let count = self.model.unknowns.all.len();
        let decomposed = self.decomposed(at, &vec![0.0; count], false);
        let rows = unidentifiable(&decomposed, self.model.unknowns.of_parameters());
        // A combination of errors of sensors alone has no parameter to fix.
        let has_parameter = |row: &DVector<f64>| row.amax() > 1e-6;
        let rows = rows.row_iter().map(|row| row.transpose()).filter(has_parameter);
        let mut inputs: Vec<usize> = rows.map(|row| row.iamax()).collect();
        inputs.sort_unstable();
        inputs.dedup();
        inputs
    }

    fn unidentifiable(&self, data: &Decomposed) -> Vec<UnidentifiableCombination> {
        let rows = unidentifiable(data, self.model.unknowns.all.len());
        let of = |row: nalgebra::DVector<f64>| {
            let row = row.normalize();
            let mut weights: Vec<_> =
                self.model.unknowns.all.iter().zip(row.iter()).map(|(u, w)| (u.name.clone(), *w)).collect();
            weights.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
            weights.retain(|(_, weight)| weight.abs() > 1e-3);
            UnidentifiableCombination { weights }
        };
        rows.row_iter().map(|row| of(row.transpose())).collect()
    }
}

/// A basis of the combinations of the first `columns` unknowns that the data do not tell, one a row, each
/// with an unknown that is in no other.
fn unidentifiable(data: &Decomposed, columns: usize) -> DMatrix<f64> {
    let combinations: Vec<usize> = (0..data.values.len()).filter(|k| !data.tells(*k)).collect();
    let mut rows = DMatrix::from_fn(combinations.len(), columns, |k, j| data.vectors[(combinations[k], j)]);
    own_parameters(&mut rows);
    rows
}
