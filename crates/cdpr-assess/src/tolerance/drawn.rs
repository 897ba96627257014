//! Robots that are drawn under tolerances: the quantile of their errors, and what independent ones reach.

use crate::error::AssessError;
use crate::tolerance::{CERTAIN, FIRST, Model, ROUND, ROUND_IN_WEATHER, Reached};
use cdpr_sensitivity::{Estimate, RandomDesign, SampleDesign, SobolDesign, derived_seed};
use cdpr_statics::StaticsError;
use cdpr_study::{Sampling, StudyError, observe_rows};
use rayon::prelude::*;

impl Model<'_> {
    /// Errors [mm] of the robots of a design under tightened tolerances, in ascending order; infinite for
    /// robots without feasible tensions. The first robots are observed alone, so that tolerances under which
    /// too many have none are refused early.
    fn errors(&self, design: &impl SampleDesign, factors: &[f64]) -> Result<Vec<f64>, AssessError> {
        let robots = design.points();
        let mut errors: Vec<f64> = Vec::new();
        while errors.len() < robots {
            let next = errors.len()..robots.min(FIRST.max(4 * errors.len()));
            errors.extend(observe_rows(design, next, |rows| {
                let outcomes = self.outcomes(rows, factors).into_iter();
                outcomes.map(|outcome| outcome.map_or(f64::INFINITY, |metres| 1e3 * metres)).collect()
            }));
            self.check_failed(&errors, design, factors)?;
        }
        errors.par_sort_by(f64::total_cmp);
        Ok(errors)
    }

    /// The error of each robot [m]; rows of inputs are tightened in place.
    pub(super) fn outcomes(&self, rows: &mut [f64], factors: &[f64]) -> Vec<Result<f64, StaticsError>> {
        for row in rows.chunks_exact_mut(self.inputs.len()) {
            for (value, (tolerance, mean)) in row.iter_mut().zip(&self.inputs) {
                *value = mean + factors[*tolerance] * (*value - mean);
            }
        }
        let Sampling { errors, observer, .. } = self.sampling;
        let outcomes = observer.displacements_of(errors, rows, self.of.output()).into_iter();
        outcomes.map(|outcome| outcome.map(|dp| dp.norm())).collect()
    }

    /// Refuses tolerances under which more robots than the quantile allows have certainly no error.
    fn check_failed(
        &self,
        errors: &[f64],
        design: &impl SampleDesign,
        factors: &[f64],
    ) -> Result<(), AssessError> {
        let failed = errors.iter().filter(|error| error.is_infinite()).count();
        let share = Estimate::of_share(failed, errors.len(), CERTAIN).map_err(|source| self.wrong(source))?;
        if share.low <= 1.0 - self.limit.quantile {
            return Ok(());
        }
        let what = format!("{failed} of {} robots with these tolerances", errors.len());
        let first = errors.iter().position(|error| error.is_infinite());
        let source = first.and_then(|first| {
            let mut why = observe_rows(design, first..first + 1, |rows| self.outcomes(rows, factors));
            why.pop()?.err().map(Box::new)
        });
        Err(AssessError::Unobservable { what, source })
    }

    /// The quantile [mm] that the weather leaves of robots without deviations; `None` where no number of it
    /// deviates.
    pub(super) fn of_weather_alone(&self) -> Result<Option<f64>, AssessError> {
        if !self.weather.contains(&true) {
            return Ok(None);
        }
        let factors: Vec<f64> = self.weather.iter().map(|weather| f64::from(u8::from(*weather))).collect();
        let alone = self.rounded_quantile(&factors)?;
        if self.limit.limit_mm <= alone {
            return Err(self.unreachable("the weather alone passes it, which no tolerance changes", alone));
        }
        Ok(Some(alone))
    }

    /// The quantile [mm] of a round. It uses the same points for all factors, so that it changes with the
    /// factors alone.
    pub(super) fn rounded_quantile(&self, factors: &[f64]) -> Result<f64, AssessError> {
        let ascending = self.errors(&self.round()?, factors)?;
        self.estimate(&ascending).map(|quantile| quantile.value)
    }

    /// The points of a round.
    pub(super) fn round(&self) -> Result<SobolDesign, StudyError> {
        let (study, errors) = (self.sampling.study, &self.sampling.errors);
        let in_weather = self.sampling.observer.is_in_weather(errors);
        let points = if in_weather { ROUND_IN_WEATHER } else { ROUND };
        let design = SobolDesign::scrambled(errors.inputs.clone(), points, study.file.seed);
        design.map_err(|source| self.wrong(source))
    }

    /// Equation (B2) with independent draws.
    pub(super) fn verify(&self, factors: &[f64], draw: u64) -> Result<Reached, AssessError> {
        let file = &self.sampling.study.file;
        let (inputs, robots) = (self.sampling.errors.inputs.clone(), self.limit.verified_with);
        let design = RandomDesign::new(inputs, robots, derived_seed(file.seed, draw));
        let ascending = self.errors(&design.map_err(|source| self.wrong(source))?, factors)?;
        let within = ascending.partition_point(|error| *error <= self.limit.limit_mm);
        Ok(Reached {
            quantile_mm: self.estimate(&ascending)?,
            within: Estimate::of_share(within, robots, file.confidence)
                .map_err(|source| self.wrong(source))?,
            robots,
            failed: ascending.iter().filter(|error| error.is_infinite()).count(),
        })
    }

    fn estimate(&self, ascending: &[f64]) -> Result<Estimate, AssessError> {
        let (quantile, confidence) = (self.limit.quantile, self.sampling.study.file.confidence);
        let found =
            Estimate::of_quantile(ascending, quantile, confidence).map_err(|source| self.wrong(source))?;
        if found.value.is_infinite() {
            let failed = ascending.iter().filter(|error| error.is_infinite()).count();
            let what = format!("{failed} of {} robots with these tolerances", ascending.len());
            return Err(AssessError::Unobservable { what, source: None });
        }
        Ok(found)
    }
}
