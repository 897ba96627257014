//! Inputs of a sampling that belong together: groups, and correlations.

use crate::error::StudyError;
use crate::file::study_file::SamplingSpec;
use crate::model::error_model::ErrorModel;
use crate::model::study::Study;
use cdpr_robot::Parameter;
use cdpr_sensitivity::{Correlated, Group, SampleDesign, SensitivityError, SobolDesign};

impl Study {
    /// The groups of the study file that have inputs in an error model.
    ///
    /// # Errors
    /// [`StudyError::Invalid`] for a name that no input, point or group of parameters has.
    pub(crate) fn groups(&self, errors: &ErrorModel) -> Result<Vec<Group>, StudyError> {
        let mut groups = Vec::new();
        for (name, members) in &self.file.groups {
            let mut inputs = Vec::new();
            for member in members {
                let of_member = |i: &usize| belongs(&errors.inputs[*i].name, errors.group(*i), member);
                let before = inputs.len();
                inputs.extend((0..errors.inputs.len()).filter(of_member));
                if inputs.len() == before && !self.is_known(member) {
                    let expected = "the name of an input such as `b1.x`, of a point (`b1`), of a group of \
                                    parameters (`b`), or of a cause of the error model";
                    return Err(self.invalid(&format!("groups.{name}"), member, expected));
                }
            }
            inputs.sort_unstable();
            inputs.dedup();
            if !inputs.is_empty() {
                groups.push(Group::new(name.clone(), inputs));
            }
        }
        Ok(groups)
    }

    /// Whether a parameter of the robot or an error model of the study has a member of this name: it may be
    /// certain in one sampling and uncertain in another.
    fn is_known(&self, member: &str) -> bool {
        let parameters = Parameter::of(&self.robot);
        parameters.iter().any(|of| belongs(&of.to_string(), of.group(), member))
            || self.file.error_models.values().any(|model| model.contains_key(member))
    }

    /// The correlation matrix of a sampling, `None` where no inputs are correlated.
    ///
    /// # Errors
    /// [`StudyError::Invalid`] for an unknown input, two equal ones, a pair that is listed twice, a value
    /// that is no correlation, and values that contradict each other; [`StudyError::Statistics`] for a design
    /// that starts at point 0.
    pub(crate) fn correlation(
        &self,
        name: &str,
        spec: &SamplingSpec,
        design: &SobolDesign,
    ) -> Result<Option<Vec<Vec<f64>>>, StudyError> {
        if spec.correlations.is_empty() {
            return Ok(None);
        }
        let inputs = design.inputs();
        let diagonal = |i: usize| (0..inputs.len()).map(|j| f64::from(i == j)).collect();
        let mut matrix: Vec<Vec<f64>> = (0..inputs.len()).map(diagonal).collect();
        for (number, of) in spec.correlations.iter().enumerate() {
            let field = format!("samplings.{name}.correlations[{number}]");
            let place = |wanted: &String| {
                inputs.iter().position(|input| input.name == *wanted).ok_or_else(|| {
                    let expected = format!("the name of an input of {}", spec.error_model);
                    self.invalid(&format!("{field}.between"), wanted, &expected)
                })
            };
            let [i, j] = [place(&of.between[0])?, place(&of.between[1])?];
            if i == j || matrix[i][j] != 0.0 {
                let expected = "two different inputs, and each pair once";
                return Err(self.invalid(&format!("{field}.between"), of.between.join(", "), expected));
            }
            if !(of.value > -1.0 && of.value < 1.0 && of.value != 0.0) {
                let expected = "a number above -1 and below 1 that is not zero";
                return Err(self.invalid(&format!("{field}.value"), of.value, expected));
            }
            (matrix[i][j], matrix[j][i]) = (of.value, of.value);
        }
        let checked = Correlated::new(design.clone(), &matrix);
        let field = format!("samplings.{name}.correlations");
        checked.map_err(|source| match source {
            SensitivityError::NotACorrelation { row, column, .. } if row == column => {
                let found = format!("contradictory for `{}`", inputs[row].name);
                let expected = "correlations that are possible together (a positive definite matrix)";
                self.invalid(&field, found, expected)
            }
            source => self.statistics(field, source),
        })?;
        Ok(Some(matrix))
    }
}

/// Whether an input has this name, is a component of a point of this name, or belongs to this group of
/// parameters.
fn belongs(input: &str, group: &str, name: &str) -> bool {
    input == name || group == name || input.strip_prefix(name).is_some_and(|rest| rest.starts_with('.'))
}
