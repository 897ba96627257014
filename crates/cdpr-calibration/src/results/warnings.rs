//! What is odd about a calibration.

use crate::fitted::{Fit, FitStatus, UNLIKELY, chance};
use crate::model::held::{HeldReading, farthest_held};
use crate::results::patterns::Trend;
use crate::results::summary::{CalibrationSummary, Campaign, LengthConstant, RowApart};
use crate::sensor_error::SensorError;
use cdpr_robot::{counted, significant};
use std::collections::BTreeMap;

impl Fit {
    /// Sentences about what is odd.
    pub(super) fn warnings(&self, summary: &CalibrationSummary, campaign: &Campaign) -> Vec<String> {
        let mut warnings = Vec::new();
        let [starts, _] = self.starts;
        match self.status {
            FitStatus::Converged => {}
            FitStatus::AwayFromMinimum => warnings.push(format!(
                "the search ended {:.1e} standard deviations from the minimum after {}: an estimate may be off \
                 by that many of its own; make more starts, or seek fewer parameters",
                self.distance,
                counted(self.steps, "step")
            )),
            FitStatus::StartsDisagree => warnings.push(format!(
                "of {starts} starts no other ended at this chi-square: another minimum may be lower; make \
                 more starts, or seek fewer parameters"
            )),
            FitStatus::OneStart => warnings
                .push("a single start was made: nothing shows that no other minimum is lower".to_owned()),
        }
        for (unknown, estimate) in self.unknowns.all.iter().zip(&self.estimates) {
            if unknown.bounds.contains(&estimate.value) {
                warnings.push(format!(
                    "{} ends at its bound, a deviation of {}: it counts as known there",
                    estimate.name, estimate.value
                ));
            }
        }
        if !campaign.measured.noise_is_stated {
            warnings.push(
                "no noise is stated: standard deviations follow from the residuals, the model is not tested"
                    .to_owned(),
            );
        }
        if summary.is_unlikely() {
            warnings.push(format!(
                "chi-square is {:.1} with {} degrees of freedom: the model, the noise or some rows are wrong",
                self.chi_square, self.degrees_of_freedom
            ));
        }
        if summary.p_value_of_less.is_some_and(|p| p < UNLIKELY) {
            let (chi_square, degrees) = self.of_data;
            warnings.push(format!(
                "chi-square of the measurements is {chi_square:.3} with {degrees} degrees of freedom, far \
                 too small: is the noise stated in mm where it is m, or too large?"
            ));
        }
        if let Some(constant) = self.constant_errors(summary) {
            warnings.push(constant);
        }
        if let Some(Trend { column, against, correlation, .. }) = summary.trends.first() {
            warnings.push(format!(
                "the residuals of {column} follow {against} (correlation {correlation:+.2}): the model \
                 leaves something out"
            ));
        }
        warnings.extend(self.held_coordinates(campaign));
        if let Some(RowApart { line, share, .. }) = summary.row_apart {
            warnings.push(format!(
                "line {line} alone makes {:.0} % of the sum of squares: it may be of another robot or pose",
                100.0 * share
            ));
        } else if let Some((column, rms)) = self.worst_column().filter(|_| summary.length_constant.is_none())
        {
            warnings.push(format!(
                "column {column} is off by {rms:.1} standard deviations, many times more than the others \
                 of its kind: columns may be swapped, its unit or sign may be wrong"
            ));
        }
        warnings
    }

    /// What is measured of coordinates that the robot holds, where noise does not explain it.
    fn held_coordinates(&self, campaign: &Campaign) -> Option<String> {
        const FAR: f64 = 5.0;
        let Campaign { robot, measured, .. } = campaign;
        let HeldReading { line, quantity, off, standard_deviations } =
            farthest_held(robot, &self.unknowns, &measured.rows)
                .filter(|of| measured.noise_is_stated && of.standard_deviations > FAR)?;
        let (is_angle, is_point) = (quantity.unit() == "rad", robot.plane.is_none());
        let (off, unit) = if is_angle { (off.to_degrees(), "degrees") } else { (1e3 * off, "mm") };
        let column = if is_angle { "the orientation".to_owned() } else { format!("column {quantity}") };
        let held = if is_point { "a point mass does not rotate" } else { "the robot cannot leave its plane" };
        Some(format!(
            "{column} is {} {unit} off in line {line}, {standard_deviations:.0} standard deviations, though \
             {held}: what guides it, or the frame of the measurements, may be another; it does not count",
            significant(off, 2)
        ))
    }

    /// What shows that lengths have constant errors which are not sought: means of their residuals or, where
    /// the parameters sought take those, chi-square.
    fn constant_errors(&self, summary: &CalibrationSummary) -> Option<String> {
        if self.unknowns.sensor(SensorError::LengthOffset).is_some() {
            return None;
        }
        let text = |metres: f64| significant(1e3 * metres, 2);
        if let Some(LengthConstant { metres, share }) = summary.length_constant {
            return Some(format!(
                "one constant error of all lengths, {} mm, explains {:.0} % of chi-square: correct the \
                 lengths, or fit length_offset, too",
                text(metres),
                100.0 * share
            ));
        }
        let remedy = "incremental encoders have constant errors of lengths: fit length_offset, too";
        if let [(greatest, mean), others @ ..] = &self.mean_residuals()[..] {
            let others = match others.len() {
                0 => String::new(),
                more => format!(", and of {} such a mean is significant, too", counted(more, "more cable")),
            };
            return Some(format!(
                "residuals of cable {}, {greatest}, average {} mm{others}: {remedy}",
                greatest.cable()? + 1,
                text(*mean)
            ));
        }
        let degrees = summary.p_value.map(|_| self.degrees_of_freedom)?;
        let offsets = self.length_offsets.as_ref()?;
        let (cable, offset) = offsets.explain(self.chi_square, degrees)?;
        Some(format!(
            "constant errors of the lengths explain {:.0} % of chi-square, with {} mm in cable {}: {remedy}",
            100.0 * offsets.gain / self.chi_square,
            text(offset),
            cable + 1
        ))
    }

    /// The one constant error of all lengths that explains an unlikely chi-square.
    pub(super) fn length_constant(&self) -> Option<LengthConstant> {
        let offsets = self.length_offsets.as_ref()?;
        let metres = offsets.explain_together(self.chi_square, self.degrees_of_freedom)?;
        Some(LengthConstant { metres, share: offsets.common.0 / self.chi_square })
    }

    /// The row with most of the sum of squares, if that is far more than its share.
    pub(super) fn row_apart(&self) -> Option<RowApart> {
        let mut sums: BTreeMap<usize, (f64, usize)> = BTreeMap::new();
        for of in &self.after {
            let (sum, count) = sums.entry(of.line).or_default();
            *sum += of.standardized().powi(2);
            *count += 1;
        }
        let total: f64 = sums.values().map(|(sum, _)| sum).sum();
        let (line, (sum, count)) = sums.into_iter().max_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
        let rows = self.poses.len() as f64;
        let numbers = self.after.len() as f64 / rows;
        let others_fit = chance(total - sum, self.of_data.1.saturating_sub(count)) >= UNLIKELY;
        let is_apart = rows > 2.0 && sum > 0.5 * total && sum > 10.0 * numbers;
        is_apart.then_some(RowApart { line, share: sum / total, others_fit })
    }

    /// The column that fits by far worst among the same sensors, before the fit spreads its error.
    fn worst_column(&self) -> Option<(String, f64)> {
        let mut sums: BTreeMap<String, (&'static str, f64, usize)> = BTreeMap::new();
        for of in &self.after {
            let entry = sums.entry(of.quantity.to_string()).or_insert((of.quantity.sensor(), 0.0, 0));
            entry.1 += of.standardized().powi(2);
            entry.2 += 1;
        }
        let rms: Vec<(String, &str, f64)> = sums
            .into_iter()
            .map(|(name, (sensor, sum, count))| (name, sensor, (sum / count as f64).sqrt()))
            .collect();
        let (name, sensor, worst) = rms.iter().max_by(|a, b| a.2.total_cmp(&b.2))?;
        let mut others: Vec<f64> =
            rms.iter().filter(|of| of.1 == *sensor && of.0 != *name).map(|of| of.2).collect();
        others.sort_by(f64::total_cmp);
        let median = *others.get(others.len() / 2)?;
        (*worst > 5.0 && *worst > 3.0 * median).then(|| (name.clone(), *worst))
    }
}
