//! Where a search begins.

use crate::campaign::{Quantity, Row};
use crate::error::CalibrationError;
use crate::fit::frame::RigidMotion;
use crate::fit::problem::{Problem, Seen};
use crate::fit::search::SEEN;
use crate::model::row::held_lengths;
use crate::model::{RowState, Shared, State};
use crate::plausible::straight_length;
use crate::sensor_error::{SensorError, size};
use crate::solve::Decomposed;
use crate::unknowns::Unknown;
use cdpr_robot::{Axis, Pose, Rotation3, Vector3};
use nalgebra::DVector;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use rayon::prelude::*;

impl Problem<'_> {
    /// The state of the nominal robot, with its residuals.
    pub(super) fn begin(&self) -> Result<(State, Seen), CalibrationError> {
        let begun = |x: Vec<f64>| -> Result<_, CalibrationError> {
            let x = self.model.unknowns.within(x);
            let rows = self.rows.par_iter().map(|row| self.model.begin(row, &x));
            Ok((rows.collect::<Result<Vec<RowState>, _>>()?, x))
        };
        // Errors of winches that no row bears are worse than none.
        let zero = vec![0.0; self.model.unknowns.all.len()];
        let (rows, x) = begun(self.winches()).or_else(|error| begun(zero).map_err(|_| error))?;
        let shared = Shared { x, frame: Rotation3::identity(), origin: Vector3::zeros() };
        let mut state = State { shared, rows };
        self.align(&mut state);
        let robot = self.model.robot;
        let compared = self.compared(&state, robot)?;
        let poses = state.rows.iter().map(|row| *row.pose()).collect();
        Ok((state, (self.differences(&compared), poses)))
    }

    /// Unknown offsets and scales of winches where they fit the lengths that hold the measured poses best,
    /// and zero for all other unknowns.
    fn winches(&self) -> Vec<f64> {
        let unknowns = self.model.unknowns;
        let mut x = vec![0.0; unknowns.all.len()];
        let [offset, scale] =
            [SensorError::LengthOffset, SensorError::DrumScale].map(|error| unknowns.sensor(error));
        if (offset.is_none() && scale.is_none()) || unknowns.sensor(SensorError::Frame).is_some() {
            return x;
        }
        let robot = self.model.robot;
        let held: Vec<(Vec<f64>, &Vec<f64>)> = self
            .rows
            .par_iter()
            .filter_map(|row| {
                let pose = self.model.measured_pose(row)?;
                let straight = || (0..robot.cables.len()).map(|i| straight_length(robot, &pose, i)).collect();
                let held = held_lengths(robot, &pose).unwrap_or_else(|_| straight());
                Some((held, row.lengths.as_ref()?))
            })
            .collect();
        let count = held.len() as f64;
        for i in (0..robot.cables.len()).filter(|_| !held.is_empty()) {
            let mean = |of: &dyn Fn(f64, f64) -> f64| {
                held.iter().map(|(lengths, read)| of(lengths[i], read[i])).sum::<f64>() / count
            };
            let (length, read) = (mean(&|length, _| length), mean(&|_, read| read));
            let spread = mean(&|of, _| (of - length).powi(2));
            let slope = match (offset, scale) {
                (None, Some(_)) => read / length,
                (Some(_), Some(_)) if spread > 0.0 => {
                    mean(&|of, seen| (of - length) * (seen - read)) / spread
                }
                _ => 1.0,
            };
            if let Some(first) = scale {
                x[first + i] = slope - 1.0;
            }
            if let Some(first) = offset {
                x[first + i] = read - slope * length;
            }
        }
        x
    }

    /// Puts an unknown tracker where it fits the positions of the nominal robot best, unless a prior says
    /// where it is, and markers whose places are unknown where it sees them in the mean.
    fn align(&self, state: &mut State) {
        let poses: Vec<Pose> = state.rows.iter().map(|row| *row.pose()).collect();
        let frame = self.model.unknowns.sensor(SensorError::Frame);
        if frame.is_some_and(|first| self.model.unknowns.all[first].prior.is_none())
            && let Some(found) = RigidMotion::between(&self.seen(&poses))
        {
            state.shared.frame = found.rotation;
            state.shared.origin = found.translation;
        }
        if let Some(first) = self.model.unknowns.sensor(SensorError::Markers) {
            for marker in 0..self.model.unknowns.marker_count {
                let mut places = Vec::new();
                for (row, pose) in self.rows.iter().zip(&poses) {
                    let seen = Axis::ALL.map(|axis| row.value(Quantity::Marker(marker, axis)));
                    if let [Some(x), Some(y), Some(z)] = seen {
                        let point =
                            state.shared.frame.inverse() * (Vector3::new(x, y, z) - state.shared.origin);
                        places.push(pose.rotation.inverse() * (point - pose.position));
                    }
                }
                if !places.is_empty() {
                    let known =
                        self.model.unknowns.markers.get(marker).copied().unwrap_or_else(Vector3::zeros);
                    let mean = places.iter().sum::<Vector3<f64>>() / places.len() as f64 - known;
                    (0..3).for_each(|k| state.shared.x[first + 3 * marker + k] = mean[k]);
                }
            }
        }
    }

    /// A further start: where lengths are exact, from a fit in which they are not, then at random.
    /// Combinations that the data do not tell have the values that they have at `found`, because searches
    /// keep them.
    pub(super) fn start(&self, number: usize, found: &[f64], told: &Decomposed) -> Option<State> {
        let is_exact = |row: &Row| row.lengths.is_some() && row.length_std.iter().all(|std| *std == 0.0);
        if number == 1 && self.rows.iter().any(is_exact) {
            return self.softened(&SOFT[..1]);
        }
        let mut random = ChaCha8Rng::seed_from_u64(self.settings.seed);
        random.set_stream(number as u64);
        let draw = |unknown: &Unknown| {
            let normal: f64 = random.sample(StandardNormal);
            let share = if unknown.prior.is_some() { 1.0 } else { 0.01 };
            share * unknown.scale * normal
        };
        let drawn = self.model.unknowns.all.iter().map(draw);
        let all = &self.model.unknowns.all;
        let wanted: Vec<f64> = self.winches().iter().zip(drawn).map(|(at, drawn)| at + drawn).collect();
        let away = (0..all.len()).map(|j| (wanted[j] - found[j]) / all[j].scale);
        let away = told.told_part(&DVector::from_iterator(all.len(), away), FARTHEST);
        let x = (0..all.len()).map(|j| found[j] + all[j].scale * away[j]).collect();
        self.at(self.model.unknowns.within(x))
    }

    /// The state of all rows at these unknowns.
    fn at(&self, mut x: Vec<f64>) -> Option<State> {
        if let Some(first) = self.model.unknowns.sensor(SensorError::Frame) {
            // The place of a frame begins at its alignment.
            x[first..first + 6].fill(0.0);
        }
        let rows: Result<Vec<RowState>, _> =
            self.rows.par_iter().map(|row| self.model.begin(row, &x)).collect();
        let shared = Shared { x, frame: Rotation3::identity(), origin: Vector3::zeros() };
        let mut state = State { shared, rows: rows.ok()? };
        self.align(&mut state);
        Some(state)
    }

    /// A start at the unknowns that suit lengths with greater errors, then smaller ones: they show which
    /// cables are taut in truth, where with the lengths of a wrong robot others are.
    pub(super) fn softened(&self, shares: &[f64]) -> Option<State> {
        let mut start = None;
        for share in shares {
            let std = share * size(self.model.robot);
            let soften = |row: &Row| {
                let mut row = row.clone();
                row.length_std.resize(row.lengths.as_ref().map_or(0, Vec::len), 0.0);
                row.length_std.iter_mut().for_each(|of| *of = of.max(std));
                row
            };
            let rows: Vec<Row> = self.rows.iter().map(soften).collect();
            let soft = Problem {
                model: self.model.seeking(self.model.unknowns),
                rows: &rows,
                settings: self.settings,
            };
            let from = start.map_or_else(|| Some(soft.begin().ok()?.0), |x| soft.at(x))?;
            let from = soft.with_best_rows(from).ok()?;
            start = Some(soft.search(from, SEEN, FEW).ok()?.state.shared.x);
        }
        self.at(start?)
    }
}

/// How far from the minimum that was found others begin at most, in standard deviations.
const FARTHEST: f64 = 30.0;

/// Steps that show where lengths with greater errors lead, at most.
const FEW: usize = 30;

/// Errors of lengths for a start, over the robot's size.
pub(super) const SOFT: [f64; 4] = [1e-3, 3e-4, 1e-4, 3e-5];
