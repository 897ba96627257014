//! Where a search begins.

use crate::campaign::Quantity;
use crate::error::CalibrationError;
use crate::fit::problem::{Problem, Seen};
use crate::model::{RowState, Shared, State, held_lengths};
use crate::unknowns::{SensorError, Unknown};
use cdpr_robot::{Axis, Pose, Rotation3, Vector3};
use nalgebra::Matrix3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use rayon::prelude::*;

impl Problem<'_> {
    /// The state of the nominal robot, with its residuals.
    pub(super) fn begin(&self) -> Result<(State, Seen), CalibrationError> {
        let x = self.model.unknowns.within(self.winches());
        let rows: Vec<RowState> =
            self.rows.par_iter().map(|row| self.model.begin(row, &x)).collect::<Result<_, _>>()?;
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
                let spans = || (0..robot.cables.len()).map(|i| robot.span(&pose, i).norm()).collect();
                let held = held_lengths(robot, &pose).unwrap_or_else(|_| spans());
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
                    state.shared.frame = Rotation3::from_matrix_unchecked(turn);
                    state.shared.origin = to - turn * from;
                }
            }
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

    /// A random start.
    pub(super) fn start(&self, number: usize) -> Option<State> {
        let mut random = ChaCha8Rng::seed_from_u64(self.settings.seed);
        random.set_stream(number as u64);
        let draw = |unknown: &Unknown| {
            let normal: f64 = random.sample(StandardNormal);
            let share = if unknown.prior.is_some() { 1.0 } else { 0.01 };
            share * unknown.scale * normal
        };
        let drawn = self.model.unknowns.all.iter().map(draw);
        let x = self.winches().iter().zip(drawn).map(|(at, drawn)| at + drawn).collect();
        let x = self.model.unknowns.within(x);
        let rows: Result<Vec<RowState>, _> =
            self.rows.par_iter().map(|row| self.model.begin(row, &x)).collect();
        let shared = Shared { x, frame: Rotation3::identity(), origin: Vector3::zeros() };
        let mut state = State { shared, rows: rows.ok()? };
        self.align(&mut state);
        Some(state)
    }
}
