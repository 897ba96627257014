//! What comes out of a calibration: the robot, what is known of it, a summary, and the folder of all.

pub(crate) mod folder;
pub(crate) mod patterns;
pub(crate) mod predicted;
pub(crate) mod summary;
mod warnings;

use crate::campaign::{Quantity, Row};
use crate::fitted::{Difference, Fit};
use crate::results::predicted::{uncertainty_map, variance_at};
use crate::results::summary::{
    CalibrationSummary, Campaign, OutlierSummary, ParameterSummary, SensorSummary,
};
use crate::sensor_error::{SensorError, free_axes};
use crate::table::Measurements;
use crate::unknowns::map_of;
use cdpr_robot::{Axis, Parameter, Robot, UnitQuaternion};
use cdpr_study::{ERRORS_FORMAT, ErrorModel, ErrorsFile, Term};
use indexmap::IndexMap;
use nalgebra::DMatrix;
use std::collections::BTreeMap;

impl Fit {
    /// Factor of all standard deviations: 1, or where no noise is stated that of the residuals.
    pub(crate) fn noise_scale(&self, stated: bool) -> f64 {
        if stated || self.degrees_of_freedom == 0 {
            return 1.0;
        }
        (self.chi_square / self.degrees_of_freedom as f64).sqrt()
    }

    /// What is known of the errors of the calibrated robot: parameters that were sought, and those of the
    /// prior that were not.
    pub fn posterior(&self, campaign: &Campaign) -> ErrorsFile {
        let parameters = Parameter::of(campaign.robot);
        let covariance = self.whole_covariance(campaign);
        let not_sought = self.not_sought(campaign);
        let known = self.unknowns.terms.iter().chain(&not_sought);
        let known: Vec<usize> = known.map(|term| term.parameter).collect();
        let is_there: Vec<bool> = (0..parameters.len()).map(|p| known.contains(&p)).collect();
        let kept: Vec<usize> = (0..parameters.len()).filter(|p| is_there[*p]).collect();
        ErrorsFile {
            format: ERRORS_FORMAT.to_owned(),
            parameters: kept.iter().map(|p| parameters[*p].to_string()).collect(),
            mean: vec![0.0; kept.len()],
            covariance: kept
                .iter()
                .map(|i| kept.iter().map(|j| 0.5 * (covariance[(*i, *j)] + covariance[(*j, *i)])).collect())
                .collect(),
        }
    }

    /// The terms of the prior whose inputs were not sought: these keep their laws.
    fn not_sought(&self, campaign: &Campaign) -> Vec<Term> {
        let Some(prior) = campaign.prior else { return Vec::new() };
        let is_gone = |term: &&Term| {
            let name = &prior.inputs[term.input].name;
            let is_sought = self.unknowns.all.iter().any(|unknown| unknown.name == *name);
            !is_sought && !self.unknowns.shared.contains(name)
        };
        prior.terms.iter().filter(is_gone).copied().collect()
    }

    /// Covariance of all that a position depends on after the fit, the parameters first, with those of the
    /// prior that were not sought.
    fn whole_covariance(&self, campaign: &Campaign) -> DMatrix<f64> {
        let scale = self.noise_scale(campaign.measured.noise_is_stated);
        let covariance = self.position_covariance() * (scale * scale);
        let count = covariance.nrows();
        campaign.prior.iter().fold(covariance, |covariance, prior| {
            covariance + prior_covariance(prior, &self.not_sought(campaign), count)
        })
    }

    /// The calibrated robot with where its values come from.
    pub fn calibrated(&self, campaign: &Campaign) -> Robot {
        let mut robot = self.robot.clone();
        let before = campaign.robot.provenance.source.as_deref().unwrap_or("a robot file");
        robot.provenance.source = Some(format!(
            "calibrated by cdpr {} with {} rows of {}, {} parameters sought, chi-square {:.1} \
             with {} degrees of freedom; before: {before}",
            env!("CARGO_PKG_VERSION"),
            campaign.measured.rows.len(),
            campaign.name,
            self.unknowns.of_parameters(),
            self.chi_square,
            self.degrees_of_freedom
        ));
        robot
    }

    /// Mean variance of a coordinate of P at the poses of the rows [m²], for a covariance of all that it
    /// depends on.
    fn position_variance(
        &self,
        robot: &Robot,
        covariance: &DMatrix<f64>,
        lengths: &[Vec<f64>],
    ) -> Option<f64> {
        let rows = self.poses.iter().zip(lengths);
        let variances = rows.map(|(pose, lengths)| variance_at(robot, lengths, pose, covariance));
        let variances = variances.collect::<Option<Vec<f64>>>().filter(|all| !all.is_empty())?;
        Some(variances.iter().sum::<f64>() / variances.len() as f64)
    }

    /// The summary, with errors of prediction if they were computed.
    pub fn summary(&self, campaign: &Campaign, predicted: Option<&[Difference]>) -> CalibrationSummary {
        let Measurements { rows, noise_is_stated, .. } = campaign.measured;
        let scale = self.noise_scale(*noise_is_stated);
        let stated = |value: Option<f64>| value.filter(|_| *noise_is_stated);
        let covariance = self.whole_covariance(campaign);
        let prior = campaign.prior.map(|prior| prior_covariance(prior, &prior.terms, covariance.nrows()));
        let of_row = |row: &Row| row.lengths.as_deref().map(|read| self.lengths(read));
        let lengths: Option<Vec<Vec<f64>>> = rows.iter().map(of_row).collect();
        let std_of = |robot: &Robot, covariance: &DMatrix<f64>| {
            let lengths = lengths.as_ref()?;
            self.position_variance(robot, covariance, lengths).map(f64::sqrt)
        };
        // Before, nothing says what the winches read.
        let before = prior.as_ref().filter(|_| !self.has_errors_of_winches());
        let map = || uncertainty_map(self, campaign.robot, before, &covariance);
        let after = std_of(&self.robot, &covariance);
        let open = self.unidentified();
        let by_open = (open.ncols() > 0).then(|| std_of(&self.robot, &(&open * open.transpose()))).flatten();
        let is_open = by_open.zip(after).is_some_and(|(open, after)| open > NEGLIGIBLE * after);
        let unknown = || self.estimates.iter().filter(|of| of.std.is_none()).map(|of| of.name.clone());
        let length_constant = self.length_constant();
        let mut summary = CalibrationSummary {
            robot: campaign.robot.name.clone(),
            version: env!("CARGO_PKG_VERSION"),
            rows: rows.len(),
            parameters: self.parameters(campaign, prior.as_ref(), scale),
            sensors: self.errors_of_sensors(scale),
            chi_square: self.chi_square,
            degrees_of_freedom: self.degrees_of_freedom,
            p_value: stated(self.p_value()),
            p_value_of_less: stated(self.p_value_of_less()),
            noise_scale: scale,
            not_identifiable: self.unidentifiable.iter().map(|of| of.weights.clone()).collect(),
            residuals: self.by_sensor(predicted),
            outliers: if *noise_is_stated { self.outlier_summaries() } else { Vec::new() },
            row_apart: self.row_apart().filter(|_| length_constant.is_none()),
            length_constant,
            trends: if *noise_is_stated { self.trends() } else { Vec::new() },
            splits: self.splits(),
            workspace: if is_open { None } else { map() },
            position_std_before: before.and_then(|prior| std_of(campaign.robot, prior)),
            position_std_after: after.filter(|_| !is_open),
            position_depends_on: if is_open { unknown().collect() } else { Vec::new() },
            steps: self.steps,
            status: self.status,
            starts: self.starts,
            warnings: Vec::new(),
        };
        let measured = campaign.measured;
        let columns = summary.outliers.iter_mut().map(|of| &mut of.column);
        columns.for_each(|column| *column = measured.in_its_names(column));
        let warnings = self.warnings(&summary, campaign);
        summary.warnings = warnings.iter().map(|text| measured.in_its_names(text)).collect();
        summary
    }

    /// The parameters that were sought, standard deviations times `scale`.
    fn parameters(
        &self,
        campaign: &Campaign,
        prior: Option<&DMatrix<f64>>,
        scale: f64,
    ) -> IndexMap<String, ParameterSummary> {
        let summary = |(index, parameter): (usize, &Parameter)| {
            let terms = self.unknowns.terms.iter().filter(|term| term.parameter == index);
            let weights: Vec<_> = terms.map(|term| (term.input, term.factor)).collect();
            if weights.is_empty() {
                return None;
            }
            let [std, std_of_data] = self.stds(&weights).map(|std| std.map(|std| std * scale));
            let prior_std = prior.map(|prior| prior[(index, index)].sqrt()).filter(|std| *std > 0.0);
            let (before, moved) = (parameter.nominal(campaign.robot), self.deviations[index]);
            let summary =
                ParameterSummary::new(before, moved, [std, std_of_data, prior_std], parameter.unit());
            Some((parameter.to_string(), summary))
        };
        Parameter::of(campaign.robot).iter().enumerate().filter_map(summary).collect()
    }

    /// The errors of sensors that were sought, standard deviations times `scale`.
    fn errors_of_sensors(&self, scale: f64) -> IndexMap<String, ParameterSummary> {
        let mut sensors = IndexMap::new();
        let rotation = UnitQuaternion::from_rotation_matrix(&self.frame).scaled_axis();
        for (error, first) in &self.unknowns.sensors {
            let later = self.unknowns.sensors.iter().map(|(_, other)| *other).filter(|other| other > first);
            for k in *first..later.min().unwrap_or(self.estimates.len()) {
                let estimate = &self.estimates[k];
                let [std, std_of_data] =
                    [estimate.std, estimate.std_of_data].map(|std| std.map(|std| std * scale));
                let stds = [std, std_of_data, estimate.prior_std];
                let mut summary = ParameterSummary::new(0.0, estimate.value, stds, error.unit(k - first));
                if *error == SensorError::Frame {
                    let at = k - first;
                    summary.after = if at < 3 { self.origin[at] } else { rotation[at - 3] };
                }
                sensors.insert(estimate.name.clone(), summary);
            }
        }
        sensors
    }

    fn outlier_summaries(&self) -> Vec<OutlierSummary> {
        let summary = |of: &Difference| OutlierSummary {
            line: of.line,
            column: of.quantity.to_string(),
            difference: of.difference,
            standard_deviations: of.standardized(),
        };
        self.outliers().iter().map(summary).collect()
    }

    fn by_sensor(&self, predicted: Option<&[Difference]>) -> BTreeMap<&'static str, SensorSummary> {
        let mut sensors: BTreeMap<&'static str, SensorSummary> = BTreeMap::new();
        let rms = |of: &[Difference], name: &str, standard: bool| {
            let squares: Vec<f64> = of
                .iter()
                .filter(|of| of.quantity.sensor() == name)
                .map(|of| if standard { of.standardized() } else { of.difference }.powi(2))
                .collect();
            (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
        };
        for of in &self.after {
            let name = of.quantity.sensor();
            sensors.entry(name).or_insert_with(|| SensorSummary {
                unit: of.quantity.unit(),
                count: self.after.iter().filter(|of| of.quantity.sensor() == name).count(),
                rms_before: rms(&self.before, name, false),
                rms_after: rms(&self.after, name, false),
                standardized_rms_after: rms(&self.after, name, true),
                rms_predicted: predicted
                    .filter(|of| of.iter().any(|of| of.quantity.sensor() == name))
                    .map(|predicted| rms(predicted, name, false)),
            });
        }
        sensors
    }
}

/// Share of the standard deviation of a position below which what is not identified counts as no part of it.
const NEGLIGIBLE: f64 = 0.1;

/// Covariance of the parameters by these terms of an error model.
fn prior_covariance(model: &ErrorModel, terms: &[Term], count: usize) -> DMatrix<f64> {
    let map = map_of(terms, [count, model.inputs.len()], |input| model.inputs[input].std());
    &map * map.transpose()
}

/// Displacement of P of each row, measured less modelled, before and after [m], with the pose: arrows in
/// space, of a planar robot in its plane.
pub fn arrows(found: &Fit) -> Vec<([f64; 3], [f64; 3], [f64; 3])> {
    let free = free_axes(&found.robot);
    let of = |differences: &[Difference], row: usize| {
        Axis::ALL.map(|axis| {
            let is = |of: &&Difference| of.row == row && of.quantity == Quantity::Position(axis);
            let measured = differences.iter().find(is).map(|of| of.difference);
            measured.or_else(|| (!free.contains(&axis.index())).then_some(0.0))
        })
    };
    (0..found.poses.len())
        .filter_map(|row| {
            let [before, after] = [of(&found.before, row), of(&found.after, row)];
            let whole = |of: [Option<f64>; 3]| Some([of[0]?, of[1]?, of[2]?]);
            Some((found.poses[row].position.into(), whole(before)?, whole(after)?))
        })
        .collect()
}
