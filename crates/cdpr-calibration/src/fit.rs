//! The fit: damped Gauss-Newton for all unknowns, with those of single rows eliminated.
//!
//! The sum over all residuals ρ of `loss(ρ)` and of the squares of `(x - mean)/std` of the priors is made
//! least. The loss is ρ², or grows less for great residuals: it is then minimised by squares with the weight
//! `loss'(ρ)/2ρ`. Every unknown is counted in its scale ([`crate::Unknown::scale`]): what the data tell less
//! exactly than one scale, they do not tell, and it keeps its value.

use crate::campaign::{Quantity, Row};
use crate::error::CalibrationError;
use crate::fitted::{Difference, Estimate, Fit, FitSettings, UnidentifiableCombination};
use crate::identify::own_parameters;
use crate::model::{Compared, Model, RowState, State};
use crate::plausible::check_columns;
use crate::solve::{Decomposed, Eliminated, reduce, triangle};
use crate::unknowns::{SensorError, Unknowns};
use cdpr_robot::{Axis, Parameter, Pose, Robot, Rotation3, Vector3};
use nalgebra::{DMatrix, DVector, Matrix3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use rayon::prelude::*;

/// A step is done where the minimum is as near as this, in standard deviations.
const NEAR: f64 = 1e-8;

/// Distance at which rounding may stop the search.
const NEAR_ENOUGH: f64 = 1e-5;

/// Distance below which the steps converge quadratically.
const QUADRATIC: f64 = 1e-3;

/// Rounding of the sum of squares, relative to one more than it.
const ROUNDING_OF_COST: f64 = 1e-6;

/// Damping of the first step that did not improve, relative to the square of the greatest singular value.
const LEAST_DAMPING: f64 = 1e-10;

/// Damping beyond which no step is left.
const MOST_DAMPING: f64 = 1e4;

/// All rows linearised at a state.
struct Linearized {
    /// Triangular factor of [A ρ] in scales, without priors.
    data: DMatrix<f64>,
    rows: Vec<Eliminated>,
    cost: f64,
}

/// Residuals of all rows, and their poses.
type Seen = (Vec<Difference>, Vec<Pose>);

/// A campaign to be fitted.
pub(crate) struct Problem<'a> {
    pub(crate) model: Model<'a>,
    pub(crate) rows: &'a [Row],
    settings: FitSettings,
}

/// Fits the unknowns of a robot to rows of measurements.
///
/// # Errors
/// [`CalibrationError::TooFew`] for fewer measurements than unknowns; [`CalibrationError::Row`] and
/// [`CalibrationError::Incomplete`] for a row that the nominal robot cannot answer to.
pub fn fit(
    robot: &Robot,
    rows: &[Row],
    unknowns: &Unknowns,
    settings: &FitSettings,
) -> Result<Fit, CalibrationError> {
    let problem = Problem { model: Model::new(robot, unknowns), rows, settings: *settings };
    problem.check()?;
    let moved =
        [SensorError::LengthOffset, SensorError::DrumScale, SensorError::Frame, SensorError::FrameScale];
    if moved.iter().all(|error| unknowns.sensor(*error).is_none()) {
        check_columns(robot, rows)?;
    }
    let (start, first) = problem.begin()?;
    if settings.only_identifiable {
        let gone = problem.unidentifiable_inputs(&problem.linearized(&start)?);
        if !gone.is_empty() {
            let mut kept = unknowns.clone();
            kept.remove(&gone);
            return fit(robot, rows, &kept, &FitSettings { only_identifiable: false, ..*settings });
        }
    }
    let mut best = problem.search(start, settings.max_steps)?;
    let mut ends = vec![best.1.cost];
    for number in 1..settings.starts.max(1) {
        let Some(start) = problem.start(number) else { continue };
        let Ok(found) = problem.search(start, settings.max_steps) else { continue };
        ends.push(found.1.cost);
        if found.1.cost < best.1.cost {
            best = found;
        }
    }
    let same = ends.iter().filter(|cost| **cost <= best.1.cost * (1.0 + 1e-6) + 1e-6).count();
    problem.conclude(best, first, same)
}

/// Errors of prediction: the rows are split into `folds` parts, every folds-th row into one, and each part is
/// compared with the robot that the others calibrate. The errors of sensors are those of the others, too, and
/// lengths count as they were read.
///
/// # Errors
/// As [`fit`].
pub fn cross_validated(
    robot: &Robot,
    rows: &[Row],
    unknowns: &Unknowns,
    settings: &FitSettings,
    folds: usize,
) -> Result<Vec<Difference>, CalibrationError> {
    let settings = FitSettings { starts: 1, ..*settings };
    let fold = |part: usize| -> Result<Vec<Difference>, CalibrationError> {
        let of = |inside: bool| rows.iter().enumerate().filter(move |(k, _)| (k % folds == part) == inside);
        let others: Vec<Row> = of(false).map(|(_, row)| row.clone()).collect();
        let known = fit(robot, &others, unknowns, &settings)?;
        let exact = |(_, row): (usize, &Row)| {
            let mut row = row.clone();
            row.length_std.iter_mut().for_each(|std| *std = 0.0);
            row
        };
        let left: Vec<Row> = of(true).map(exact).collect();
        let problem = Problem { model: Model::new(robot, &known.unknowns), rows: &left, settings };
        let x: Vec<f64> = known.estimates.iter().map(|estimate| estimate.value).collect();
        let states = left.iter().map(|row| problem.model.begin(row, &x)).collect::<Result<_, _>>()?;
        let mut state = State { x, frame: known.frame, origin: Vector3::zeros(), rows: states };
        state.origin = known.origin - problem.translation(&state);
        let compared = problem.compared(&state, &known.robot)?;
        Ok(problem.differences(&compared))
    };
    Ok((0..folds).map(fold).collect::<Result<Vec<_>, _>>()?.concat())
}

impl Problem<'_> {
    fn check(&self) -> Result<(), CalibrationError> {
        let lengths = |row: &Row| if row.lengths.is_some() { row.length_std.len() } else { 0 };
        let measured = |row: &Row| {
            let noisy = row.length_std.iter().any(|std| *std > 0.0);
            row.readings.len() + if noisy { lengths(row) } else { 0 }
        };
        let own = |row: &Row| {
            let noisy = row.length_std.iter().any(|std| *std > 0.0);
            if noisy || row.lengths.is_none() { self.model.robot.cables.len() } else { 0 }
        };
        let measurements: usize = self.rows.iter().map(measured).sum();
        let nuisances: usize = self.rows.iter().map(own).sum();
        let free = self.model.unknowns.all.iter().filter(|unknown| unknown.prior.is_none()).count();
        if measurements < free + nuisances || measurements == 0 {
            return Err(CalibrationError::TooFew { measurements, unknowns: free + nuisances, nuisances });
        }
        Ok(())
    }

    /// The state of the nominal robot, with its residuals.
    fn begin(&self) -> Result<(State, Seen), CalibrationError> {
        let x: Vec<f64> = vec![0.0; self.model.unknowns.all.len()];
        let rows: Vec<RowState> =
            self.rows.par_iter().map(|row| self.model.begin(row, &x)).collect::<Result<_, _>>()?;
        let mut state = State { x, frame: Rotation3::identity(), origin: Vector3::zeros(), rows };
        self.align(&mut state);
        let robot = self.model.robot;
        let compared = self.compared(&state, robot)?;
        let poses = state.rows.iter().map(|row| *row.pose()).collect();
        Ok((state, (self.differences(&compared), poses)))
    }

    /// Puts an unknown tracker where it fits the positions of the nominal robot best (Kabsch 1976), and
    /// markers whose places are unknown where it sees them in the mean.
    fn align(&self, state: &mut State) {
        let poses: Vec<Pose> = state.rows.iter().map(|row| *row.pose()).collect();
        if self.model.unknowns.sensor(SensorError::Frame).is_some() {
            let mut pairs = Vec::new();
            for (row, pose) in self.rows.iter().zip(&poses) {
                let seen = Axis::ALL.map(|axis| {
                    row.value(Quantity::Position(axis)).or_else(|| row.value(Quantity::Marker(0, axis)))
                });
                if let [Some(x), Some(y), Some(z)] = seen {
                    pairs.push((pose.position, Vector3::new(x, y, z)));
                }
            }
            let count = pairs.len() as f64;
            if count >= 3.0 {
                let sum =
                    pairs.iter().fold((Vector3::zeros(), Vector3::zeros()), |s, p| (s.0 + p.0, s.1 + p.1));
                let (from, to) = (sum.0 / count, sum.1 / count);
                let scatter: Matrix3<f64> =
                    pairs.iter().map(|(a, b)| (b - to) * (a - from).transpose()).sum();
                let svd = scatter.svd(true, true);
                if let (Some(u), Some(v)) = (svd.u, svd.v_t) {
                    let sign = (u * v).determinant().signum();
                    let turn = u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign)) * v;
                    state.frame = Rotation3::from_matrix_unchecked(turn);
                    state.origin = to - turn * from;
                }
            }
        }
        if let Some(first) = self.model.unknowns.sensor(SensorError::Markers) {
            for marker in 0..self.model.unknowns.marker_count {
                let mut places = Vec::new();
                for (row, pose) in self.rows.iter().zip(&poses) {
                    let seen = Axis::ALL.map(|axis| row.value(Quantity::Marker(marker, axis)));
                    if let [Some(x), Some(y), Some(z)] = seen {
                        let point = state.frame.inverse() * (Vector3::new(x, y, z) - state.origin);
                        places.push(pose.rotation.inverse() * (point - pose.position));
                    }
                }
                if !places.is_empty() {
                    let known =
                        self.model.unknowns.markers.get(marker).copied().unwrap_or_else(Vector3::zeros);
                    let mean = places.iter().sum::<Vector3<f64>>() / places.len() as f64 - known;
                    (0..3).for_each(|k| state.x[first + 3 * marker + k] = mean[k]);
                }
            }
        }
    }

    /// A random start.
    fn start(&self, number: usize) -> Option<State> {
        let mut random = ChaCha8Rng::seed_from_u64(self.settings.seed);
        random.set_stream(number as u64);
        let draw = |unknown: &crate::unknowns::Unknown| {
            let normal: f64 = random.sample(StandardNormal);
            let share = if unknown.prior.is_some() { 1.0 } else { 0.01 };
            (share * unknown.scale * normal).clamp(unknown.bounds[0], unknown.bounds[1])
        };
        let x: Vec<f64> = self.model.unknowns.all.iter().map(draw).collect();
        let rows: Result<Vec<RowState>, _> =
            self.rows.par_iter().map(|row| self.model.begin(row, &x)).collect();
        let mut state = State { x, frame: Rotation3::identity(), origin: Vector3::zeros(), rows: rows.ok()? };
        self.align(&mut state);
        Some(state)
    }

    fn compared(&self, state: &State, robot: &Robot) -> Result<Vec<Compared>, CalibrationError> {
        (0..self.rows.len())
            .into_par_iter()
            .map(|k| {
                let row = &self.rows[k];
                self.model.compare(row, state, k, robot).map_err(CalibrationError::row(row.line))
            })
            .collect()
    }

    fn differences(&self, compared: &[Compared]) -> Vec<Difference> {
        let of = |(row, of): (usize, &Compared)| {
            let line = self.rows[row].line;
            (0..of.std.len())
                .map(|r| Difference {
                    row,
                    line,
                    quantity: of.quantities[r],
                    difference: of.residuals[r] * of.std[r],
                    std: of.std[r],
                })
                .collect::<Vec<_>>()
        };
        compared.iter().enumerate().flat_map(of).collect()
    }

    /// Residual and square of the prior of each unknown.
    fn priors(&self, x: &[f64]) -> impl Iterator<Item = (usize, f64, f64)> {
        let of = move |(j, unknown): (usize, &crate::unknowns::Unknown)| {
            let [mean, std] = unknown.prior?;
            Some((j, (x[j] - mean) / std, unknown.scale / std))
        };
        self.model.unknowns.all.iter().enumerate().filter_map(of).collect::<Vec<_>>().into_iter()
    }

    fn cost(&self, compared: &[Compared], x: &[f64]) -> f64 {
        let data: f64 =
            compared.iter().flat_map(|of| of.residuals.iter()).map(|r| self.settings.loss.loss(*r)).sum();
        data + self.priors(x).map(|(_, r, _)| r * r).sum::<f64>()
    }

    fn linearized(&self, state: &State) -> Result<Linearized, CalibrationError> {
        let robot = self.model.deviating(&state.x)?;
        let compared = self.compared(state, &robot)?;
        let cost = self.cost(&compared, &state.x);
        let count = self.model.unknowns.all.len();
        let eliminated = |mut of: Compared| {
            let mut row = DMatrix::zeros(of.std.len(), count + 1);
            for r in 0..of.std.len() {
                let weight = self.settings.loss.weight(of.residuals[r]).sqrt();
                for (j, unknown) in self.model.unknowns.all.iter().enumerate() {
                    row[(r, j)] = weight * of.per_unknown[(r, j)] * unknown.scale;
                }
                row[(r, count)] = weight * of.residuals[r];
                of.per_own.row_mut(r).iter_mut().for_each(|slope| *slope *= weight);
            }
            Eliminated::new(row, &of.per_own)
        };
        let rows: Vec<_> = compared.into_par_iter().map(eliminated).collect();
        Ok(Linearized { data: reduce(&rows, count + 1), rows, cost })
    }

    /// The whole problem in scales: data, priors, and zero columns for unknowns at their bounds.
    fn decomposed(&self, at: &Linearized, x: &[f64], with_priors: bool) -> Decomposed {
        let count = x.len();
        let mut whole = at.data.clone();
        if with_priors {
            let priors: Vec<_> = self.priors(x).collect();
            let mut rows = DMatrix::zeros(priors.len(), count + 1);
            for (r, (j, residual, slope)) in priors.into_iter().enumerate() {
                rows[(r, j)] = slope;
                rows[(r, count)] = residual;
            }
            whole = triangle(whole, &rows);
        }
        let mut matrix = whole.columns(0, count).into_owned();
        let right = whole.column(count).into_owned();
        if with_priors {
            let gradient = matrix.tr_mul(&right);
            for (j, unknown) in self.model.unknowns.all.iter().enumerate() {
                let [least, most] = unknown.bounds;
                if (x[j] <= least && gradient[j] > 0.0) || (x[j] >= most && gradient[j] < 0.0) {
                    matrix.column_mut(j).fill(0.0);
                }
            }
        }
        Decomposed::new(matrix, &right)
    }

    /// The state after a step in scales.
    fn stepped(&self, from: &State, at: &Linearized, step: &DVector<f64>) -> Option<State> {
        let mut x = from.x.clone();
        for (j, unknown) in self.model.unknowns.all.iter().enumerate() {
            x[j] = (x[j] + step[j] * unknown.scale).clamp(unknown.bounds[0], unknown.bounds[1]);
        }
        let mut frame = from.frame;
        if let Some(first) = self.model.unknowns.sensor(SensorError::Frame) {
            let turn: Vec<f64> =
                (first + 3..first + 6).map(|j| step[j] * self.model.unknowns.all[j].scale).collect();
            frame = Rotation3::new(Vector3::new(turn[0], turn[1], turn[2])) * frame;
            // The rotation stands in the frame.
            (first + 3..first + 6).for_each(|j| x[j] = 0.0);
        }
        let robot = self.model.deviating(&x).ok()?;
        let rows: Option<Vec<_>> = (0..self.rows.len())
            .into_par_iter()
            .map(|k| {
                let before = &from.rows[k];
                let own = at.rows[k].own(step);
                let errors: Vec<f64> =
                    self.model.own(before).iter().zip(own.iter()).map(|(e, d)| e + d).collect();
                self.model.follow(&self.rows[k], before, &robot, &x, errors).ok()
            })
            .collect();
        Some(State { x, frame, origin: from.origin, rows: rows? })
    }

    /// Steps until the minimum is near.
    fn search(&self, start: State, most: usize) -> Result<(State, Linearized, usize, f64), CalibrationError> {
        let mut state = start;
        let mut at = self.linearized(&state)?;
        let mut damping: f64 = 0.0;
        let mut steps = 0;
        let mut before = f64::INFINITY;
        loop {
            let decomposed = self.decomposed(&at, &state.x, true);
            let distance = decomposed.distance();
            // Near the minimum rounding of the cost hides what a step gains.
            let is_near = distance < QUADRATIC;
            if distance < NEAR || steps >= most || (is_near && distance > 0.9 * before) {
                return Ok((state, at, steps, distance));
            }
            before = if is_near { distance } else { f64::INFINITY };
            let allowed = if is_near { at.cost + ROUNDING_OF_COST * (1.0 + at.cost) } else { at.cost };
            let greatest = decomposed.values.max().powi(2);
            let mut accepted = false;
            while damping < MOST_DAMPING {
                let step = decomposed.step(damping * greatest);
                let tried = self.stepped(&state, &at, &step).and_then(|next| {
                    let linearized = self.linearized(&next).ok()?;
                    (linearized.cost <= allowed).then_some((next, linearized))
                });
                if let Some((next, linearized)) = tried {
                    (state, at) = (next, linearized);
                    damping = if damping > LEAST_DAMPING { 0.1 * damping } else { 0.0 };
                    accepted = true;
                    break;
                }
                damping = (10.0 * damping).max(LEAST_DAMPING);
            }
            steps += 1;
            if !accepted {
                return Ok((state, at, steps, distance));
            }
        }
    }

    /// Inputs of parameters that have to be known so that the data tell all others.
    fn unidentifiable_inputs(&self, at: &Linearized) -> Vec<usize> {
        let count = self.model.unknowns.all.len();
        let decomposed = self.decomposed(at, &vec![0.0; count], false);
        let rows = unidentifiable(&decomposed, self.model.unknowns.of_parameters());
        rows.row_iter().map(|row| row.transpose().iamax()).collect()
    }

    fn conclude(
        &self,
        (state, at, steps, distance): (State, Linearized, usize, f64),
        (before, poses_before): Seen,
        same: usize,
    ) -> Result<Fit, CalibrationError> {
        let unknowns = self.model.unknowns;
        let robot = self.model.deviating(&state.x)?;
        let compared = self.compared(&state, &robot)?;
        let after = self.differences(&compared);
        let whole = self.decomposed(&at, &state.x, true);
        let data = self.decomposed(&at, &state.x, false);
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
                let told = unknown.prior.is_some() || std_of_data.is_some();
                Estimate {
                    name: unknown.name.clone(),
                    value: state.x[j],
                    std: told.then(|| covariance[(j, j)].max(0.0).sqrt()),
                    std_of_data,
                    prior_std: unknown.prior.map(|[_, std]| std),
                }
            })
            .collect();
        let numbers: usize = after.len();
        let own: usize = compared.iter().map(|of| of.per_own.ncols()).sum();
        let told = (0..count).filter(|k| whole.tells(*k)).count();
        let priors: Vec<_> = self.priors(&state.x).map(|(_, r, _)| r * r).collect();
        let chi_square =
            after.iter().map(|of| of.standardized().powi(2)).sum::<f64>() + priors.iter().sum::<f64>();
        Ok(Fit {
            robot,
            estimates,
            frame: state.frame,
            origin: state.origin + self.translation(&state),
            deviations: unknowns.deviations(Parameter::of(self.model.robot).len(), &state.x),
            covariance,
            unidentifiable: self.unidentifiable(&data),
            chi_square,
            degrees_of_freedom: (numbers + priors.len()).saturating_sub(own + told),
            before,
            after,
            poses_before,
            poses: state.rows.iter().map(|row| *row.pose()).collect(),
            steps,
            converged: distance < NEAR_ENOUGH,
            distance,
            same,
            unknowns: unknowns.clone(),
        })
    }

    fn translation(&self, state: &State) -> Vector3<f64> {
        self.model.unknowns.sensor(SensorError::Frame).map_or_else(Vector3::zeros, |first| {
            Vector3::new(state.x[first], state.x[first + 1], state.x[first + 2])
        })
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

/// A basis of the combinations of the first `columns` unknowns that the data do not tell, one a row, each with
/// an unknown that is in no other.
fn unidentifiable(data: &Decomposed, columns: usize) -> DMatrix<f64> {
    let combinations: Vec<usize> = (0..data.values.len()).filter(|k| !data.tells(*k)).collect();
    let mut rows = DMatrix::from_fn(combinations.len(), columns, |k, j| data.vectors[(combinations[k], j)]);
    own_parameters(&mut rows);
    rows
}
