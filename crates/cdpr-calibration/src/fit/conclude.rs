//! What a fit answers.

use crate::error::CalibrationError;
use crate::fit::problem::{Problem, Seen};
use crate::fit::search::{Found, Linearized, Priors};
use crate::fitted::{Estimate, Fit, FitStatus, Roots, UNLIKELY, UnidentifiableCombination};
use crate::model::Shared;
use crate::model::read::inverse_of_right;
use crate::sensor_error::SensorError;
use crate::solve::{Decomposed, own_parameters};
use cdpr_robot::{Parameter, UnitQuaternion};
use nalgebra::{DMatrix, DVector};

impl Problem<'_> {
    pub(super) fn conclude(
        &self,
        Found { state, steps, distance, .. }: Found,
        (before, poses_before): Seen,
        starts: [usize; 2],
    ) -> Result<Fit, CalibrationError> {
        let unknowns = self.model.unknowns;
        let robot = self.model.deviating(&state.shared.x)?;
        let compared = self.compared(&state, &robot)?;
        let after = self.differences(&compared);
        let at = self.measured_at(&state)?;
        let [whole, data] =
            [Priors::All, Priors::None].map(|which| self.decomposed(&at, &state.shared, which));
        let count = unknowns.all.len();
        let scales = DVector::from_iterator(count, unknowns.all.iter().map(|unknown| unknown.scale));
        let mut covariance = whole.covariance();
        covariance.iter_mut().enumerate().for_each(|(k, of)| *of *= scales[k / count] * scales[k % count]);
        let weights = self.weights(&state.shared);
        let out_of_plane = unknowns.out_of_plane(self.model.robot);
        let is_any_out = out_of_plane.contains(&true);
        let in_plane = is_any_out.then(|| self.decomposed(&at, &state.shared, Priors::OutOfPlane).root());
        let roots = Roots { posterior: whole.root(), data: data.root(), in_plane, out_of_plane };
        let estimates = (0..count)
            .map(|j| {
                let unknown = &unknowns.all[j];
                let [std, std_of_data] =
                    roots.stds(&weights.column(j).into_owned(), 1.0).map(|std| std.map(|of| of * scales[j]));
                Estimate {
                    name: unknown.name.clone(),
                    value: state.shared.x[j],
                    std,
                    std_of_data,
                    prior_std: unknown.prior.map(|[_, std]| std),
                }
            })
            .collect();
        let numbers: usize = after.len();
        let own: usize = compared.iter().map(|of| of.per_own.ncols()).sum();
        let told = (0..count).filter(|k| whole.tells(*k)).count();
        let priors = self.priors(&state.shared);
        let of_data = compared.iter().map(|of| of.residuals.norm_squared()).sum::<f64>();
        let chi_square = of_data + priors.iter().map(|(_, r, _)| r * r).sum::<f64>();
        let mut fit = Fit {
            robot,
            estimates,
            frame: state.shared.frame,
            origin: state.shared.origin + self.translation(&state),
            deviations: unknowns.deviations(Parameter::of(self.model.robot).len(), &state.shared.x),
            covariance,
            roots,
            unidentifiable: self.unidentifiable(&data),
            chi_square,
            of_data: (of_data, numbers.saturating_sub(own + (0..count).filter(|k| data.tells(*k)).count())),
            degrees_of_freedom: (numbers + priors.len()).saturating_sub(own + told),
            before,
            after,
            poses_before,
            lines: self.rows.iter().map(|row| row.line).collect(),
            payloads: self.rows.iter().map(|row| row.load.payload).collect(),
            poses: state.rows.iter().map(|row| *row.pose()).collect(),
            steps,
            status: FitStatus::of(distance, starts),
            distance,
            starts,
            unknowns: unknowns.clone(),
            length_offsets: None,
        };
        if fit.p_value().is_some_and(|p| p < UNLIKELY) {
            fit.length_offsets = self.length_offsets(&state);
        }
        Ok(fit)
    }

    /// The combination of unknowns that each number printed depends on, in scales: its own unknown, but for a
    /// rotation vector, whose unknowns are a further rotation.
    fn weights(&self, shared: &Shared) -> DMatrix<f64> {
        let count = self.model.unknowns.all.len();
        let mut weights = DMatrix::identity(count, count);
        if let Some(first) = self.model.unknowns.sensor(SensorError::Frame) {
            let turn = UnitQuaternion::from_rotation_matrix(&shared.frame).scaled_axis();
            // log(exp(dφ) exp(r)) = r + J⁻¹ dφ with the left Jacobian J at r, the right one at -r.
            let slopes = inverse_of_right(&-turn);
            weights.view_mut((first + 3, first + 3), (3, 3)).copy_from(&slopes.transpose());
        }
        weights
    }

    /// Inputs of parameters that have to be known so that the data tell all others.
    pub(super) fn unidentifiable_inputs(&self, shared: &Shared, at: &Linearized) -> Vec<usize> {
        let decomposed = self.decomposed(at, shared, Priors::None);
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
