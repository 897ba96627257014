//! What is uncertain: independent causes of the deviations of a robot's parameters.
//!
//! An error model says which causes act on which parameters (M1). Two parameters that one cause acts on are
//! correlated, as those of the posterior of a fit are: the covariance of all is `U Uᵀ`.

use crate::campaign::{STD_EXPECTED, is_std};
use crate::error::CalibrationError;
use crate::unknowns::map_of;
use cdpr_robot::Robot;
use cdpr_study::{ErrorModel, Term};
use nalgebra::{DMatrix, RowDVector};

/// Causes of unit variance.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Causes {
    /// Their names: of a parameter that deviates alone, its own.
    pub(super) names: Vec<String>,
    /// U: how each cause displaces each parameter, in the order of [`cdpr_robot::Parameter::of`].
    map: DMatrix<f64>,
    /// Indices of the parameters that deviate.
    pub(super) uncertain: Vec<usize>,
    /// The rows of U of these, each over the standard deviation of its parameter.
    pub(super) relative: DMatrix<f64>,
}

impl Causes {
    /// The inputs of an error model. One whose steps leave it a single value is known.
    pub(super) fn of_model(robot: &Robot, model: &ErrorModel) -> Result<Self, CalibrationError> {
        model.check(robot)?;
        let stds: Vec<f64> = model.inputs.iter().map(cdpr_sensitivity::Input::std).collect();
        let wrong = stds.iter().position(|std| *std != 0.0 && !is_std(*std));
        if let Some(k) = wrong {
            let field = format!("uncertainty of {}", model.inputs[k].name);
            return Err(CalibrationError::invalid(field, stds[k], STD_EXPECTED));
        }
        let kept: Vec<usize> = (0..stds.len()).filter(|k| stds[*k] > 0.0).collect();
        let term = |term: &Term| {
            let input = kept.iter().position(|input| *input == term.input)?;
            Some(Term { input, ..*term })
        };
        let terms: Vec<Term> = model.terms.iter().filter_map(term).collect();
        let map = map_of(&terms, [model.parameters(), kept.len()], |input| stds[kept[input]]);
        let std: Vec<f64> = map.row_iter().map(|row| row.norm()).collect();
        let uncertain: Vec<usize> = (0..std.len()).filter(|p| std[*p] > 0.0).collect();
        let relative =
            DMatrix::from_fn(uncertain.len(), kept.len(), |k, j| map[(uncertain[k], j)] / std[uncertain[k]]);
        let names = kept.iter().map(|k| model.inputs[*k].name.clone()).collect();
        Ok(Self { names, map, uncertain, relative })
    }

    /// Number of causes.
    pub(super) fn count(&self) -> usize {
        self.map.ncols()
    }

    /// Derivatives by the causes from those by the parameters, which are the first columns of each row.
    pub(super) fn by_causes(&self, rows: &[RowDVector<f64>]) -> DMatrix<f64> {
        let parameters = self.map.nrows();
        let mut found = DMatrix::zeros(rows.len(), self.count());
        for (mut of, row) in found.row_iter_mut().zip(rows) {
            of.copy_from(&(row.columns(0, parameters) * &self.map));
        }
        found
    }
}
