//! The friction of pulleys from measured tensions at the winches.
//!
//! Least squares over the readings k of wheels that slip, with T_w of (F2) and standard deviation σ of a
//! reading from the residuals:
//!
//! ```text
//! min Σ (T_k - T0_k g(θ_k, s_k; μ, c))²,    J = U diag(a1, a2) Vᵀ,    covariance σ² V diag(1/a²) Vᵀ   (F5)
//! ```
//!
//! To first order in μ θ and c, both effects are `g = 1 + s x` with `x = μ θ + 2 c sin(θ/2)`. Readings at one
//! wrap identify x alone; μ and c are identified by how θ/sin(θ/2) differs between wraps. What terms of the
//! second order tell, (a² + ab + b²)/2 with both parts a and b of x, does not count: they are those of this
//! law of friction alone.

use super::wheel::PulleyFriction;
use crate::error::StaticsError;
use nalgebra::{DVector, Matrix2, MatrixXx2, Vector2};

/// Tensions on both sides of a wheel that slips.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WinchReading {
    /// Angle over which the cable lies on the wheel [rad].
    pub wrap: f64,
    /// Tension where the cable leaves for the platform [N], of the model or measured.
    pub tension: f64,
    /// Tension measured at the winch [N].
    pub winch_tension: f64,
    /// 1 where cable runs towards the winch, -1 where it runs towards the platform.
    pub slip: f64,
}

/// A value with its standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Its standard deviation.
    pub deviation: f64,
}

/// Friction of pulleys from readings at winches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionFit {
    /// μ and c; `None` where the readings do not identify them one by one.
    pub coefficients: Option<[Estimate; 2]>,
    /// Unit vector of the sum of μ and c that the readings identify best.
    pub combination: [f64; 2],
    /// This sum, `combination·(μ, c)`.
    pub combined: Estimate,
    /// Standard deviation of a reading, from the residuals [N].
    pub noise: f64,
    /// Singular values of the derivatives of all readings by μ and c [N], the larger one first.
    pub singular_values: [f64; 2],
}

/// Ratio of the singular values below which μ and c differ by no more than terms in which one law of friction
/// is as good as another.
pub(super) const SEPARABLE: f64 = 0.01;

/// Standard deviation beyond which a coefficient is not identified: that of a pulley is hardly greater.
const UNCERTAIN: f64 = 0.1;

const MAX_ITERATIONS: usize = 50;

/// The coefficients of friction that fit readings of wheels which slip in known directions, (F5).
///
/// Of a wheel that sticks only bounds are known: such readings are no part of it.
///
/// # Errors
/// [`StaticsError::Invalid`] for fewer than three readings, a wrap or a tension that is not positive, a slip
/// that is neither -1 nor 1, and readings that no coefficients fit.
pub fn fit_friction(readings: &[WinchReading]) -> Result<FrictionFit, StaticsError> {
    check(readings)?;
    let n = readings.len();
    let (mut at, mut is_separable) = (Vector2::zeros(), None);
    for _ in 0..MAX_ITERATIONS {
        let residuals = DVector::from_iterator(n, readings.iter().map(|reading| reading.residual(at)));
        let slopes = MatrixXx2::from_fn(n, |k, column| readings[k].slope(at, column));
        let svd = slopes.svd(true, true);
        let (Some(u), Some(v_t)) = (svd.u, svd.v_t) else { break };
        let v = Matrix2::from_fn(|i, j| v_t[(j, i)]);
        let singular = svd.singular_values;
        // Without friction the columns are s T0 θ and 2 s T0 sin(θ/2): what the wraps alone can identify.
        let separable = *is_separable.get_or_insert(singular[1] > SEPARABLE * singular[0]);
        let along = u.transpose() * &residuals;
        let mut step = v.column(0) * (along[0] / singular[0]);
        if separable {
            step += v.column(1) * (along[1] / singular[1]);
        } else {
            // The shortest (μ, c) with the combination that is identified
            step -= v.column(1) * v.column(1).dot(&at);
        }
        at += step;
        if at.amax() > 1.0 || !at.amax().is_finite() {
            break;
        }
        if step.amax() <= 1e-13 {
            let known = if separable { 2 } else { 1 };
            let noise = (residuals.norm_squared() / (n - known) as f64).sqrt();
            return Ok(concluded(at, v, [singular[0], singular[1]], separable, noise));
        }
    }
    let expected = "tensions greater at the winch than at the platform where cable runs towards the winch";
    Err(StaticsError::invalid("winch_tension".to_owned(), format!("a list of {n}"), expected))
}

/// The fit at its minimum, with the right singular vectors.
pub(super) fn concluded(
    at: Vector2<f64>,
    v: Matrix2<f64>,
    singular_values: [f64; 2],
    separable: bool,
    noise: f64,
) -> FrictionFit {
    let deviations = singular_values.map(|value| noise / value);
    let coefficient = |i: usize| Estimate {
        value: at[i],
        deviation: (v[(i, 0)] * deviations[0]).hypot(v[(i, 1)] * deviations[1]),
    };
    let coefficients = Some([coefficient(0), coefficient(1)])
        .filter(|both| separable && both.iter().all(|one| one.deviation <= UNCERTAIN));
    // The sign for which both coefficients add up
    let first = v.column(0) * v.column(0).sum().signum();
    let combined = Estimate { value: first.dot(&at), deviation: deviations[0] };
    FrictionFit { coefficients, combination: first.into(), combined, noise, singular_values }
}

fn check(readings: &[WinchReading]) -> Result<(), StaticsError> {
    if readings.len() < 3 {
        let value = format!("a list of {}", readings.len());
        return Err(StaticsError::invalid(
            "readings".to_owned(),
            value,
            "three or more for two coefficients",
        ));
    }
    for (k, reading) in readings.iter().enumerate() {
        let WinchReading { wrap, tension, winch_tension, slip } = *reading;
        let positive = |value: f64| value.is_finite() && value > 0.0;
        for (field, value, is_valid, expected) in [
            (
                "wrap",
                wrap,
                positive(wrap) && wrap < std::f64::consts::TAU,
                "an angle above 0 and below 2π [rad]",
            ),
            ("tension", tension, positive(tension), "a finite, positive tension [N]"),
            ("winch_tension", winch_tension, positive(winch_tension), "a finite, positive tension [N]"),
            ("slip", slip, slip.abs() == 1.0, "1 towards the winch or -1 towards the platform"),
        ] {
            if !is_valid {
                return Err(StaticsError::invalid(format!("{field}[{k}]"), value, expected));
            }
        }
    }
    Ok(())
}

impl WinchReading {
    fn winch(&self, at: Vector2<f64>) -> f64 {
        self.tension * PulleyFriction { friction: at.x, bearing: at.y }.ratio(self.wrap, self.slip)
    }

    /// Measured less modelled tension [N].
    fn residual(&self, at: Vector2<f64>) -> f64 {
        self.winch_tension - self.winch(at)
    }

    /// Derivative of the modelled tension by μ or c [N], by central differences: the minimum does not depend
    /// on their error of 1e-10.
    fn slope(&self, at: Vector2<f64>, column: usize) -> f64 {
        const STEP: f64 = 1e-5;
        let mut step = Vector2::zeros();
        step[column] = STEP;
        (self.winch(at + step) - self.winch(at - step)) / (2.0 * STEP)
    }
}
