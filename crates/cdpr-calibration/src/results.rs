//! What comes out of a calibration: the robot, what is known of it, a summary, and the folder of all.

pub(crate) mod patterns;
pub(crate) mod predicted;

use crate::error::CalibrationError;
use crate::fitted::{Difference, Fit};
use crate::results::patterns::{Split, Trend};
use crate::results::predicted::{UncertaintyMap, uncertainty_map};
use cdpr_robot::{Axis, Parameter, Robot};
use cdpr_statics::{DirectProblem, Load};
use cdpr_study::{ERRORS_FORMAT, ErrorModel, ErrorsFile, ResultsFolder, ResultsOf, StudyError};
use indexmap::IndexMap;
use nalgebra::DMatrix;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;

/// Name of the calibrated robot in a folder of results.
pub const CALIBRATED_NAME: &str = "calibrated.json";

/// Name of what is known of its errors.
pub const POSTERIOR_NAME: &str = "posterior.json";

const SUMMARY_NAME: &str = "summary.json";

const RESIDUALS_NAME: &str = "residuals.csv";

const REPORT_NAME: &str = "report.html";

/// A parameter before and after, in its SI unit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParameterSummary {
    /// SI unit.
    pub unit: &'static str,
    /// Value in the robot file; of a tilt or an error of a sensor, zero.
    pub before: f64,
    /// Value found.
    pub after: f64,
    /// Standard deviation of what is left; none for what neither data nor a prior tell.
    pub std: Option<f64>,
    /// Standard deviation before.
    pub prior_std: Option<f64>,
    /// The change in standard deviations before.
    pub moved_by_prior_std: Option<f64>,
    /// Whether the data alone tell it: more exactly than the prior or, without one, than to its own size.
    pub identifiable: bool,
}

/// Residuals of the sensors of one kind.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SensorSummary {
    /// SI unit.
    pub unit: &'static str,
    /// Numbers measured.
    pub count: usize,
    /// Root mean square of measured less modelled, with the robot file.
    pub rms_before: f64,
    /// With the calibrated robot.
    pub rms_after: f64,
    /// With the calibrated robot, in standard deviations of the noise.
    pub standardized_rms_after: f64,
    /// Root mean square of errors of prediction, with robots calibrated without the rows predicted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rms_predicted: Option<f64>,
}

/// A measured number far from the model.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OutlierSummary {
    /// Line in the file of measurements.
    pub line: usize,
    /// Column.
    pub column: String,
    /// Measured less modelled.
    pub difference: f64,
    /// In standard deviations of the noise.
    pub standard_deviations: f64,
}

/// A summary of a calibration.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CalibrationSummary {
    /// Name of the robot.
    pub robot: String,
    /// Version of the program.
    pub version: &'static str,
    /// Rows of measurements.
    pub rows: usize,
    /// The parameters by name.
    pub parameters: IndexMap<String, ParameterSummary>,
    /// Errors of sensors by name.
    #[serde(skip_serializing_if = "IndexMap::is_empty")]
    pub sensors: IndexMap<String, ParameterSummary>,
    /// Sum of squares of all residuals in standard deviations, priors included.
    pub chi_square: f64,
    /// Its expectation, if model and noise are right.
    pub degrees_of_freedom: usize,
    /// Probability of such a chi-square or a greater one.
    pub p_value: Option<f64>,
    /// Factor by which standard deviations were multiplied, because no noise is stated: that of the
    /// residuals.
    pub noise_scale: f64,
    /// Combinations of parameters that the data do not tell, weights in units of their scales.
    pub not_identifiable: Vec<Vec<(String, f64)>>,
    /// Residuals by sensor.
    pub residuals: BTreeMap<&'static str, SensorSummary>,
    /// Measured numbers that are far from the model.
    pub outliers: Vec<OutlierSummary>,
    /// Clear trends of residuals against place and load.
    pub trends: Vec<Trend>,
    /// Variances of means over consecutive rows.
    pub splits: Vec<Split>,
    /// Standard deviation of the position over the plane of the measured poses; none with relative lengths.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub workspace: Option<UncertaintyMap>,
    /// Mean standard deviation of the position at the poses measured, per coordinate, before [m]; none
    /// without prior.
    pub position_std_before: Option<f64>,
    /// The same after [m].
    pub position_std_after: Option<f64>,
    /// Steps of the search.
    pub steps: usize,
    /// Whether it ended at a minimum.
    pub converged: bool,
    /// Starts, and how many of them ended there.
    pub starts: [usize; 2],
    /// What is odd about the result, a sentence each.
    pub warnings: Vec<String>,
}

/// What a summary takes besides the fit.
#[derive(Clone, Copy, Debug)]
pub struct Context<'a> {
    /// The robot before.
    pub nominal: &'a Robot,
    /// The error model before, if there is one.
    pub prior: Option<&'a ErrorModel>,
    /// Whether the noise of any sensor is stated; if not, it is that of the residuals.
    pub noise_is_stated: bool,
    /// Errors of prediction, if they were computed.
    pub predicted: Option<&'a [Difference]>,
    /// Starts of the search.
    pub starts: usize,
    /// Number of rows.
    pub rows: usize,
}

/// Chances below this are named: the model or the noise is wrong.
const UNLIKELY: f64 = 1e-4;

impl Fit {
    /// Factor of all standard deviations: 1, or where no noise is stated that of the residuals.
    fn noise_scale(&self, stated: bool) -> f64 {
        if stated || self.degrees_of_freedom == 0 {
            return 1.0;
        }
        (self.chi_square / self.degrees_of_freedom as f64).sqrt()
    }

    /// What is known of the errors of the calibrated robot: parameters that were sought, and those of the
    /// prior that were not.
    pub fn posterior(&self, context: &Context) -> ErrorsFile {
        let parameters = Parameter::of(context.nominal);
        let mut covariance = self.parameter_covariance();
        covariance *= self.noise_scale(context.noise_is_stated).powi(2);
        let sought: Vec<usize> = self.unknowns.terms.iter().map(|term| term.parameter).collect();
        let mut is_there: Vec<bool> = (0..parameters.len()).map(|p| sought.contains(&p)).collect();
        if let Some(prior) = context.prior {
            let gone = |name: &String| !self.unknowns.all.iter().any(|unknown| unknown.name == *name);
            for (input, of) in prior.inputs.iter().enumerate().filter(|(_, of)| gone(&of.name)) {
                // Inputs that were not sought keep their laws.
                let terms: Vec<_> = prior.terms.iter().filter(|term| term.input == input).collect();
                let variance = of.law.std().powi(2);
                for one in &terms {
                    for other in &terms {
                        covariance[(one.parameter, other.parameter)] += variance * one.factor * other.factor;
                    }
                    is_there[one.parameter] = true;
                }
            }
        }
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

    /// The calibrated robot with where its values come from.
    pub fn calibrated(&self, context: &Context, measurements: &str) -> Robot {
        let mut robot = self.robot.clone();
        let before = context.nominal.provenance.source.as_deref().unwrap_or("a robot file");
        robot.provenance.source = Some(format!(
            "calibrated by cdpr {} with {} rows of {measurements}, {} parameters sought, chi-square {:.1} \
             with {} degrees of freedom; before: {before}",
            env!("CARGO_PKG_VERSION"),
            context.rows,
            self.unknowns.of_parameters(),
            self.chi_square,
            self.degrees_of_freedom
        ));
        robot
    }

    /// Mean variance of a coordinate of P at the poses of the rows, for a covariance of the parameters [m²].
    fn position_variance(
        &self,
        robot: &Robot,
        covariance: &DMatrix<f64>,
        lengths: &[Vec<f64>],
    ) -> Option<f64> {
        let count = covariance.nrows();
        let mut sum = (0.0, 0);
        for (pose, lengths) in self.poses.iter().zip(lengths) {
            let problem = DirectProblem::new(robot, lengths, &Load::none()).ok()?;
            let found = problem.direct(cdpr_statics::Start::Pose(pose)).ok()?;
            let slopes = problem.derivatives(&found.equilibrium).ok()?.pose;
            for k in 0..3 {
                let row = slopes.row(k).columns(0, count).into_owned();
                sum.0 += (&row * covariance * row.transpose())[0];
                sum.1 += 1;
            }
        }
        (sum.1 > 0).then(|| sum.0 / f64::from(sum.1))
    }

    /// The summary. `rows` are the rows that were fitted.
    pub fn summary(&self, context: &Context, rows: &[crate::Row]) -> CalibrationSummary {
        let scale = self.noise_scale(context.noise_is_stated);
        let all = Parameter::of(context.nominal);
        let covariance = self.parameter_covariance() * (scale * scale);
        let mut parameters = IndexMap::new();
        let prior = context.prior.map(|prior| prior_covariance(prior, all.len()));
        for (index, parameter) in all.iter().enumerate() {
            let inputs: Vec<usize> = self
                .unknowns
                .terms
                .iter()
                .filter(|term| term.parameter == index)
                .map(|term| term.input)
                .collect();
            if inputs.is_empty() {
                continue;
            }
            let estimates: Vec<_> = inputs.iter().map(|input| &self.estimates[*input]).collect();
            let known = estimates.iter().all(|estimate| estimate.std.is_some());
            let alone = match estimates[..] {
                [one] if one.prior_std.is_none() => one.std.map(|std| std * scale),
                _ => None,
            };
            let prior_std = prior.as_ref().map(|prior| prior[(index, index)].sqrt()).filter(|std| *std > 0.0);
            let before = parameter.nominal(context.nominal);
            let moved = self.deviations[index];
            parameters.insert(
                parameter.to_string(),
                ParameterSummary {
                    unit: parameter.unit(),
                    before,
                    after: before + moved,
                    std: alone.or(known.then(|| covariance[(index, index)].max(0.0).sqrt())),
                    prior_std,
                    moved_by_prior_std: prior_std.map(|std| moved / std),
                    identifiable: estimates.iter().all(|estimate| estimate.is_identifiable()),
                },
            );
        }
        let mut sensors = IndexMap::new();
        for (error, first) in &self.unknowns.sensors {
            let next =
                self.unknowns.sensors.iter().map(|(_, other)| *other).filter(|other| other > first).min();
            for k in *first..next.unwrap_or(self.estimates.len()) {
                let estimate = &self.estimates[k];
                let rotation = UnitVector::of(self.frame);
                let after = match (*error, k - first) {
                    (crate::SensorError::Frame, at @ 0..3) => self.origin[at],
                    (crate::SensorError::Frame, at) => rotation.0[at - 3],
                    _ => estimate.value,
                };
                sensors.insert(
                    estimate.name.clone(),
                    ParameterSummary {
                        unit: error.unit(k - first),
                        before: 0.0,
                        after,
                        std: estimate.std.map(|std| std * scale),
                        prior_std: estimate.prior_std,
                        moved_by_prior_std: estimate.prior_std.map(|std| estimate.value / std),
                        identifiable: estimate.is_identifiable(),
                    },
                );
            }
        }
        let lengths: Vec<Vec<f64>> = rows.iter().filter_map(|row| row.lengths.clone()).collect();
        let lengths = if lengths.len() == rows.len() { lengths } else { Vec::new() };
        let relative = self.unknowns.sensor(crate::SensorError::LengthOffset).is_some();
        let std_of = |robot: &Robot, covariance: &DMatrix<f64>| {
            if relative { None } else { self.position_variance(robot, covariance, &lengths).map(f64::sqrt) }
        };
        let p_value = self.p_value().filter(|_| context.noise_is_stated);
        let mut summary = CalibrationSummary {
            robot: context.nominal.name.clone(),
            version: env!("CARGO_PKG_VERSION"),
            rows: context.rows,
            parameters,
            sensors,
            chi_square: self.chi_square,
            degrees_of_freedom: self.degrees_of_freedom,
            p_value,
            noise_scale: scale,
            not_identifiable: self
                .unidentifiable
                .iter()
                .map(|combination| combination.weights.clone())
                .collect(),
            residuals: self.by_sensor(context.predicted),
            outliers: self
                .outliers()
                .iter()
                .filter(|_| context.noise_is_stated)
                .map(|of| OutlierSummary {
                    line: of.line,
                    column: of.quantity.to_string(),
                    difference: of.difference,
                    standard_deviations: of.standardized(),
                })
                .collect(),
            trends: if context.noise_is_stated { self.trends() } else { Vec::new() },
            splits: self.splits(),
            workspace: uncertainty_map(self, context.nominal, prior.as_ref(), &covariance)
                .filter(|_| !relative),
            position_std_before: prior.as_ref().and_then(|prior| std_of(context.nominal, prior)),
            position_std_after: std_of(&self.robot, &covariance),
            steps: self.steps,
            converged: self.converged,
            starts: [context.starts, self.same],
            warnings: Vec::new(),
        };
        summary.warnings = self.warnings(&summary, context);
        summary
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

    /// Sentences about what is odd.
    fn warnings(&self, summary: &CalibrationSummary, context: &Context) -> Vec<String> {
        let mut warnings = Vec::new();
        if !self.converged {
            warnings.push(format!(
                "the search ended {:.1e} standard deviations from the minimum after {} steps",
                self.distance, self.steps
            ));
        }
        if !context.noise_is_stated {
            warnings.push(
                "no noise is stated: standard deviations follow from the residuals, the model is not tested"
                    .to_owned(),
            );
        }
        if summary.p_value.is_some_and(|p| p < UNLIKELY) {
            warnings.push(format!(
                "chi-square is {:.1} with {} degrees of freedom: the model, the noise or some rows are wrong",
                self.chi_square, self.degrees_of_freedom
            ));
        }
        if let Some(Trend { column, against, correlation, .. }) = summary.trends.first() {
            warnings.push(format!(
                "the residuals of {column} follow {against} (correlation {correlation:+.2}): the model leaves \
                 something out"
            ));
        }
        if let Some((line, share)) = self.worst_row() {
            warnings.push(format!(
                "line {line} alone makes {:.0} % of the sum of squares: it may be of another robot or pose",
                100.0 * share
            ));
        }
        if let Some((column, rms)) = self.worst_column() {
            warnings.push(format!(
                "column {column} is off by {rms:.1} standard deviations, many times more than the others \
                 of its kind: columns may be swapped, its unit or sign may be wrong"
            ));
        }
        warnings
    }

    /// The line with most of the sum of squares, if that is far more than its share.
    fn worst_row(&self) -> Option<(usize, f64)> {
        let mut sums: BTreeMap<usize, f64> = BTreeMap::new();
        for of in &self.after {
            *sums.entry(of.line).or_insert(0.0) += of.standardized().powi(2);
        }
        let total: f64 = sums.values().sum();
        let (line, sum) = sums.into_iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
        let rows = self.poses.len() as f64;
        let numbers = self.after.len() as f64 / rows;
        (rows > 2.0 && sum > 0.5 * total && sum > 10.0 * numbers).then_some((line, sum / total))
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

/// The rotation vector of a frame.
struct UnitVector([f64; 3]);

impl UnitVector {
    fn of(rotation: cdpr_robot::Rotation3<f64>) -> Self {
        Self(cdpr_robot::UnitQuaternion::from_rotation_matrix(&rotation).scaled_axis().into())
    }
}

/// Covariance of the parameters by an error model.
fn prior_covariance(model: &ErrorModel, count: usize) -> DMatrix<f64> {
    let mut map: DMatrix<f64> = DMatrix::zeros(count, model.inputs.len());
    for term in &model.terms {
        map[(term.parameter, term.input)] += term.factor * model.inputs[term.input].law.std();
    }
    &map * map.transpose()
}

/// Makes a folder for a calibration, or takes one of an earlier calibration: before anything is computed.
///
/// # Errors
/// As [`ResultsFolder::begin`].
pub fn begin_calibration(folder: &Path) -> Result<ResultsFolder, StudyError> {
    let names = [CALIBRATED_NAME, POSTERIOR_NAME, SUMMARY_NAME, RESIDUALS_NAME, REPORT_NAME];
    ResultsFolder::begin(folder, ResultsOf::Calibration, |name| names.contains(&name))
}

/// Writes `calibrated.json`, `posterior.json`, `residuals.csv`, `report.html` and, last of all,
/// `summary.json`.
///
/// # Errors
/// As [`ResultsFolder::claim`].
pub fn write_calibration(
    folder: &ResultsFolder,
    found: &Fit,
    summary: &CalibrationSummary,
    context: &Context,
    measurements: &str,
    report: Option<&str>,
) -> Result<(), CalibrationError> {
    folder.remove(SUMMARY_NAME)?;
    let robot = found.calibrated(context, measurements).to_json() + "\n";
    folder.write(CALIBRATED_NAME, robot.as_bytes())?;
    folder.write_json(POSTERIOR_NAME, &found.posterior(context))?;
    let header =
        ["line", "column", "unit", "before", "after", "std", "standardized_after"].map(str::to_owned);
    let rows = found.before.iter().zip(&found.after).map(|(before, after)| {
        vec![
            after.line.to_string(),
            after.quantity.to_string(),
            after.quantity.unit().to_owned(),
            before.difference.to_string(),
            after.difference.to_string(),
            after.std.to_string(),
            after.standardized().to_string(),
        ]
    });
    folder.write_csv(RESIDUALS_NAME, header.to_vec(), rows)?;
    if let Some(report) = report {
        folder.write(REPORT_NAME, report.as_bytes())?;
    }
    folder.conclude(SUMMARY_NAME, summary, &[])?;
    Ok(())
}

/// Displacement of P of each row, measured less modelled, before and after [m], with the pose: arrows in
/// space.
pub fn arrows(found: &Fit) -> Vec<([f64; 3], [f64; 3], [f64; 3])> {
    let of = |differences: &[Difference], row: usize| {
        Axis::ALL.map(|axis| {
            let is = |of: &&Difference| of.row == row && of.quantity == crate::Quantity::Position(axis);
            differences.iter().find(is).map(|of| of.difference)
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
