//! The linear part of the outputs of blocks, Eq. (Si6) of [`crate::measure::sobol_indices`].

use crate::design::SampleDesign;
use crate::design::input::Input;
use crate::design::saltelli::SaltelliDesign;
use crate::error::SensitivityError;

/// Least number of blocks from which slopes are separated: 16 of each replicate. Those of fewer follow
/// interactions, and the replicates then scatter less than the estimate errs.
const LEAST_BLOCKS: usize = 2 * 16 * SaltelliDesign::REPLICATES;

/// Slopes of the estimate and of each replicate, for each component of the output.
pub(crate) struct Lines {
    /// None where nothing is separated: of a plain sequence, of groups, of few blocks, and where observations
    /// failed.
    known: Option<Known>,
}

struct Known {
    /// Deviations of the inputs from their means at a and at b of each block.
    points: Vec<f64>,
    /// Variances of the inputs.
    variances: Vec<f64>,
    /// Slopes by unit, component and input.
    slopes: Vec<Vec<Vec<f64>>>,
    units: Vec<usize>,
}

/// The linear part of one component in one block.
pub(crate) struct Line<'a> {
    a: &'a [f64],
    b: &'a [f64],
    slopes: &'a [f64],
    variances: &'a [f64],
}

impl Lines {
    /// Of the outputs of each component.
    pub(crate) fn of(
        design: &SaltelliDesign,
        components: &[&[Option<f64>]],
    ) -> Result<Self, SensitivityError> {
        let (inputs, size, count) = (design.inputs(), design.block_points(), design.blocks());
        let k = inputs.len();
        let is_single = design.groups().len() == k
            && design.groups().iter().enumerate().all(|(i, group)| group.inputs == [i]);
        // Where observations fail, the inputs of the others no longer have their laws.
        let failed = components.iter().any(|outputs| outputs.iter().any(Option::is_none));
        if !design.is_scrambled() || !is_single || count < LEAST_BLOCKS || failed {
            return Ok(Self { known: None });
        }
        let means: Vec<f64> = inputs.iter().map(Input::mean).collect();
        let mut points = vec![0.0; 2 * k * count];
        for (number, ends) in points.chunks_exact_mut(2 * k).enumerate() {
            let (a, b) = ends.split_at_mut(k);
            design.row(number * size, a)?;
            design.row((number + 1) * size - 1, b)?;
            for (value, mean) in ends.iter_mut().zip(means.iter().chain(&means)) {
                *value -= mean;
            }
        }
        let units: Vec<usize> =
            (0..count).map(|number| design.replicate_of(number).map_or(0, |unit| unit + 1)).collect();
        let of_unit = |unit: usize| {
            let of_component = |outputs: &&[Option<f64>]| {
                let slope = |i: usize| {
                    let (mut products, mut squares) = (0.0, 0.0);
                    for number in (0..count).filter(|number| units[*number] == unit) {
                        let (ends, block) = (&points[2 * k * number..], &outputs[size * number..]);
                        if let (Some(a), Some(ab)) = (block[0], block[i + 1]) {
                            let step = ends[k + i] - ends[i];
                            products += (ab - a) * step;
                            squares += step * step;
                        }
                    }
                    if squares > 0.0 { products / squares } else { 0.0 }
                };
                (0..k).map(slope).collect()
            };
            components.iter().map(of_component).collect()
        };
        let slopes = (0..=SaltelliDesign::REPLICATES).map(of_unit).collect();
        let variances = inputs.iter().map(|input| input.std().powi(2)).collect();
        Ok(Self { known: Some(Known { points, variances, slopes, units }) })
    }

    /// That of a component in a block.
    pub(crate) fn at(&self, number: usize, component: usize) -> Option<Line<'_>> {
        let Known { points, variances, slopes, units } = self.known.as_ref()?;
        let k = variances.len();
        let (a, b) = points[2 * k * number..][..2 * k].split_at(k);
        Some(Line { a, b, slopes: &slopes[units[number]][component], variances })
    }
}

impl Line<'_> {
    /// Its values at the rows of a block: a, `ab_1` .., [`ba_1` ..,] b.
    pub(crate) fn values(&self, rows: usize) -> Vec<f64> {
        let sum = |point: &[f64]| -> f64 { self.slopes.iter().zip(point).map(|(s, x)| s * x).sum() };
        let (a, b) = (sum(self.a), sum(self.b));
        let steps = self.slopes.iter().zip(self.a.iter().zip(self.b)).map(|(s, (a, b))| s * (b - a));
        let exchanged = steps.clone().map(|step| a + step).chain(steps.map(|step| b - step));
        [a].into_iter().chain(exchanged.take(rows - 2)).chain([b]).collect()
    }

    /// Variance of the part of one input.
    pub(crate) fn variance(&self, input: usize) -> f64 {
        self.slopes[input] * self.slopes[input] * self.variances[input]
    }
}
