//! The linear law of an output of robots that deviate, and how much of the variance it explains.
//!
//! With v the output where the inputs are `x0`, a number or a vector, and G its exact derivatives there,
//!
//! ```text
//! y(x) = |v + G (x - x0)|                                                              (Ll1)
//! explained = 1 - var(observed y - y(x)) / var(observed y)                             (Ll2)
//! ```

use crate::model::error_model::ErrorModel;
use cdpr_robot::significant;
use cdpr_sensitivity::{SampleDesign, SobolDesign};
use cdpr_statics::batch::Observation;
use cdpr_statics::{Derivatives, Observer};

/// Share of the variance below which a linear law explains little.
const LITTLE: f64 = 0.9;

/// An output of robots to first order, Eq. (Ll1).
#[derive(Clone, Debug, PartialEq)]
pub struct LinearLaw {
    /// The inputs about which it is: `x0`.
    pub about: Vec<f64>,
    /// The output there: a number, or the components of a vector.
    pub value: Vec<f64>,
    /// Derivatives of each component with respect to the inputs.
    pub slopes: Vec<Vec<f64>>,
}

impl LinearLaw {
    /// The output where the inputs are `x0`.
    pub fn nominal(&self) -> f64 {
        norm(self.value.iter().copied())
    }

    /// Sum of the squares of the derivatives of all components, of each input.
    pub fn squares(&self) -> Vec<f64> {
        (0..self.about.len()).map(|i| self.slopes.iter().map(|row| row[i] * row[i]).sum()).collect()
    }

    /// The output for these inputs, Eq. (Ll1).
    pub fn at(&self, inputs: &[f64]) -> f64 {
        let moved = |row: &Vec<f64>| -> f64 {
            row.iter()
                .zip(inputs.iter().zip(&self.about))
                .map(|(slope, (x, about))| slope * (x - about))
                .sum()
        };
        norm(self.value.iter().zip(&self.slopes).map(|(value, row)| value + moved(row)))
    }
}

fn norm(components: impl Iterator<Item = f64>) -> f64 {
    components.map(|component| component * component).sum::<f64>().sqrt()
}

/// Share of the variance of outputs that their linear law explains, Eq. (Ll2), at least 0. A pair has the
/// value of the law and the output; `None` for outputs that do not vary.
pub fn explained(pairs: &[(f64, f64)]) -> Option<f64> {
    let variance = |of: &dyn Fn(&(f64, f64)) -> f64| {
        let mean = pairs.iter().map(of).sum::<f64>() / pairs.len() as f64;
        pairs.iter().map(|pair| (of(pair) - mean).powi(2)).sum::<f64>()
    };
    let (left, all) =
        (variance(&|(linear, observed)| observed - linear), variance(&|(_, observed)| *observed));
    let share = (1.0 - left / all).max(0.0);
    (pairs.len() > 2 && all > 0.0 && share.is_finite()).then_some(share)
}

/// Robots that say how much a linear law explains, and the seed of their sequence.
const DRAWN: usize = 256;
const SEED: u64 = 1;

/// Share of the variance of |dp| that the derivatives of the nominal robot explain, of robots of an error
/// model.
pub fn explained_deflection(observer: &Observer, model: &ErrorModel, found: &Derivatives) -> Option<f64> {
    let inputs = model.inputs.len();
    let law = LinearLaw {
        about: vec![0.0; inputs],
        value: vec![found.deflection.magnitude()],
        slopes: vec![model.gradient(&found.magnitude().ok()?)],
    };
    let design = SobolDesign::scrambled(model.inputs.clone(), DRAWN, SEED).ok()?;
    let mut rows = vec![0.0; inputs * DRAWN];
    rows.chunks_exact_mut(inputs).enumerate().try_for_each(|(i, row)| design.row(i, row)).ok()?;
    let observed = observer.observe::<Observation>(&model.deviations(&rows)).into_iter();
    let pairs = rows.chunks_exact(inputs).zip(observed);
    let pairs: Vec<_> =
        pairs.filter_map(|(row, found)| Some((law.at(row), found.ok()?.magnitude()))).collect();
    explained(&pairs)
}

/// The beginning of a sentence about a linear law that explains little of the variance.
pub fn little_explained(explained: Option<f64>) -> Option<String> {
    let share = explained.filter(|share| *share < LITTLE)?;
    Some(format!("The linear law explains only {} % of the variance", significant(100.0 * share, 2)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_output_is_explained_whole_and_a_square_not_at_all() {
        let law = LinearLaw { about: vec![1.0], value: vec![5.0], slopes: vec![vec![2.0]] };
        let inputs: Vec<f64> = (-50..=50).map(|i| 1.0 + 0.02 * f64::from(i)).collect();
        let pairs = |of: &dyn Fn(f64) -> f64| -> Vec<(f64, f64)> {
            inputs.iter().map(|x| (law.at(&[*x]), of(*x))).collect()
        };
        assert_eq!(explained(&pairs(&|x| 3.0 + 2.0 * x)), Some(1.0));
        // A square about x0 has no linear part: the law adds its own variance.
        assert_eq!(explained(&pairs(&|x| (x - 1.0).powi(2))), Some(0.0));
        // x + c (3 x² - 1) / 2: the variances of both parts are 1/3 and c²/5.
        let half = explained(&pairs(&|x| 2.0 * (x - 1.0) + 1.5 * (x - 1.0).powi(2))).unwrap();
        let expected = 1.0 - 0.2 / (4.0 / 3.0 + 0.2);
        assert!((half - expected).abs() < 0.01, "{half} {expected}");
        assert_eq!(explained(&pairs(&|_| 1.0)), None);
        assert_eq!((law.nominal(), law.squares()), (5.0, vec![4.0]));
        let vector = LinearLaw { about: vec![0.0], value: vec![0.0; 2], slopes: vec![vec![3.0], vec![4.0]] };
        assert_eq!((vector.at(&[-2.0]), vector.squares()), (10.0, vec![25.0]));
    }

    #[test]
    fn little_is_said_of_a_law_that_explains_little() {
        assert_eq!(little_explained(Some(0.95)), None);
        assert_eq!(
            little_explained(Some(0.1234)).as_deref(),
            Some("The linear law explains only 12 % of the variance")
        );
    }
}
