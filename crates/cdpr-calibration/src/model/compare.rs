//! A row of measurements beside the model.

use crate::campaign::Quantity;
use crate::model::kink::Kink;
use crate::model::read::Observed;
use crate::model::{Model, RowAt, RowState};
use crate::sensor_error::SensorError;
use cdpr_robot::CableEnd;
use cdpr_statics::StaticsError;
use nalgebra::{DMatrix, DVector, RowDVector};

/// A row at a state: residuals over standard deviations, and their derivatives.
pub(crate) struct Compared {
    pub(crate) quantities: Vec<Quantity>,
    /// Standard deviation of each.
    pub(crate) std: Vec<f64>,
    /// (measured - model)/std.
    pub(crate) standardized: DVector<f64>,
    /// The same or, where the noise of some depends on others, the combinations that do not.
    pub(crate) residuals: DVector<f64>,
    /// Derivatives by the unknowns of all rows.
    pub(crate) per_unknown: DMatrix<f64>,
    /// Derivatives by the unknowns of the row.
    pub(crate) per_own: DMatrix<f64>,
    /// Derivatives of the pose (dp, dφ) and of the tensions by the unknowns of all rows, then by those of the
    /// row; empty where it has none.
    pub(crate) motion: DMatrix<f64>,
    /// Cables between taut and slack, to which slack would suit their measured lengths less: where less
    /// tension would, too, such a row is at its best with the cable as it is.
    pub(crate) between: Vec<usize>,
    /// Tensions of which an elastic law has a kink.
    pub(crate) kinks: Vec<Kink>,
    /// Second derivatives there: further rows of `per_unknown` and `per_own`, without residuals.
    pub(crate) bends: DMatrix<f64>,
}

impl Model<'_> {
    /// The residuals of a row, with their derivatives.
    pub(crate) fn compare(&self, at: &RowAt, state: &RowState) -> Result<Compared, StaticsError> {
        let observed = self.observed(at, state)?;
        let (row, own) = (at.row, state.errors.len());
        let measured_lengths = if row.lengths.is_some() { own } else { 0 };
        let count = row.readings.len() + measured_lengths;
        let mut compared = Compared {
            quantities: Vec::with_capacity(count),
            std: Vec::with_capacity(count),
            standardized: DVector::zeros(count),
            residuals: DVector::zeros(count),
            per_unknown: DMatrix::zeros(count, self.unknowns.all.len()),
            per_own: DMatrix::zeros(count, own),
            motion: if own > 0 { self.motion(at, &observed) } else { DMatrix::zeros(0, 0) },
            between: state.between_taut_and_slack(),
            kinks: Vec::new(),
            bends: DMatrix::zeros(0, self.unknowns.all.len() + own),
        };
        self.compare_readings(at, &observed, &mut compared);
        for i in 0..measured_lengths {
            let r = row.readings.len() + i;
            let std = row.length_std[i].max(f64::MIN_POSITIVE);
            compared.quantities.push(Quantity::Length(i));
            compared.std.push(std);
            compared.residuals[r] = state.errors[i] / std;
            compared.per_own[(r, i)] = 1.0 / std;
        }
        compared.standardized = compared.residuals.clone();
        if let Some(factor) = row.correlation_factor() {
            factor.solve_lower_triangular_mut(&mut compared.residuals);
            factor.solve_lower_triangular_mut(&mut compared.per_unknown);
            factor.solve_lower_triangular_mut(&mut compared.per_own);
        }
        self.compare_kinks(at, state, &observed, &mut compared);
        Ok(compared)
    }

    /// What is read besides lengths.
    fn compare_readings(&self, at: &RowAt, observed: &Observed, compared: &mut Compared) {
        let (unknowns, own) = (self.unknowns.all.len(), compared.per_own.ncols());
        for (r, reading) in at.row.readings.iter().enumerate() {
            let read = observed.read(reading.quantity);
            let difference = match reading.quantity {
                Quantity::Rotation(_) => -read.value,
                Quantity::Angle(_) | Quantity::Swivel(_) => wrapped(reading.value - read.value),
                _ => reading.value - read.value,
            };
            compared.quantities.push(reading.quantity);
            compared.std.push(reading.std);
            compared.residuals[r] = difference / reading.std;
            let by = -1.0 / reading.std;
            let models = self.chained(at, &observed.lengths, &read.models);
            compared.per_unknown.row_mut(r).copy_from(&(models.columns(0, unknowns) * by));
            for (unknown, slope) in read.sensors {
                compared.per_unknown[(r, unknown)] += by * slope;
            }
            compared.per_own.row_mut(r).copy_from(&(models.columns(unknowns, own) * by));
        }
    }

    /// Derivatives by the unknowns of all rows and by those of the row, from those by the inputs of the
    /// models and the lengths.
    pub(super) fn chained(&self, at: &RowAt, lengths: &[f64], models: &RowDVector<f64>) -> RowDVector<f64> {
        let unknowns = self.unknowns.all.len();
        let mut chained = RowDVector::zeros(unknowns + lengths.len());
        for term in &self.unknowns.terms {
            if at.row.mass.is_none() || term.parameter != self.layout.mass() {
                chained[term.input] += term.factor * models[term.parameter];
            }
        }
        let first = models.len() - lengths.len();
        for (i, length) in lengths.iter().enumerate() {
            let per_length = models[first + i] / (1.0 + self.of(SensorError::DrumScale, i, &at.shared.x));
            for (error, slope) in [(SensorError::LengthOffset, -1.0), (SensorError::DrumScale, -length)] {
                if let Some(index) = self.unknowns.sensor(error) {
                    chained[index + i] += per_length * slope;
                }
            }
            chained[unknowns + i] -= per_length;
        }
        chained
    }

    /// [`Compared::motion`].
    fn motion(&self, at: &RowAt, observed: &Observed) -> DMatrix<f64> {
        let of_pose = (0..6).map(|k| observed.motion().row(k).into_owned());
        let of_tension = (0..observed.lengths.len()).map(|i| observed.tension(i, CableEnd::Anchor).1);
        let rows: Vec<_> =
            of_pose.chain(of_tension).map(|models| self.chained(at, &observed.lengths, &models)).collect();
        DMatrix::from_rows(&rows)
    }
}

/// An angle between -π and π.
fn wrapped(angle: f64) -> f64 {
    angle - std::f64::consts::TAU * (angle / std::f64::consts::TAU).round()
}
