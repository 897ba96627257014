//! The friction of pulleys from whatever a model of them predicts: it decides itself which wheels slip.
//!
//! Damped Gauss-Newton steps for (F5) with 0 ≤ μ ≤ 1 and 0 ≤ c ≤ 0.5. A wheel begins to slip or to stick
//! where the coefficients change: the residuals are continuous there and their derivatives are not, and the
//! best of several starts is taken.

use super::fit::{FrictionFit, SEPARABLE, concluded};
use super::wheel::PulleyFriction;
use crate::error::StaticsError;
use nalgebra::{DVector, Matrix2, MatrixXx2, SVD, Vector2};

/// Coefficients so small that every wheel slips whose tension changes.
const SMALL: f64 = 1e-4;

/// Sizes of the coefficients from which the search starts.
const STARTS: [f64; 6] = [0.003, 0.01, 0.03, 0.07, 0.15, 0.3];

/// Greatest coefficients, those of [`PulleyFriction::validate`].
const MOST: Vector2<f64> = Vector2::new(1.0, 0.5);

/// Step of the central differences.
const STEP: f64 = 1e-6;

/// Change of the coefficients at which the search ends.
const SAME: f64 = 1e-11;

const MAX_ITERATIONS: usize = 200;

/// The coefficients of friction that leave a model the least residuals, and what the residuals identify.
///
/// `residuals` [N] are measured less modelled; those of sensors other than load cells are scaled to the noise
/// of a tension.
///
/// # Errors
/// [`StaticsError::Invalid`] for fewer than three residuals, wheels that all stick, and measurements that no
/// coefficients fit; those of the model.
pub fn fit_friction_model<E: From<StaticsError>>(
    residuals: impl Fn(PulleyFriction) -> Result<Vec<f64>, E>,
) -> Result<(FrictionFit, PulleyFriction), E> {
    let read = |at: Vector2<f64>| residuals(coefficients(at)).map(DVector::from_vec);
    let n = read(Vector2::repeat(SMALL))?.len();
    let invalid = |value: String, expected: &str| {
        E::from(StaticsError::invalid("winch_tension".to_owned(), value, expected))
    };
    if n < 3 {
        return Err(invalid(format!("a list of {n}"), "three or more for two coefficients"));
    }
    let small = Decomposed::of(&read, Vector2::repeat(SMALL))?;
    let sticks = || {
        let expected = "changes of tension that let wheels slip, such as those of greater loads";
        invalid(format!("a list of {n} at wheels that stick"), expected)
    };
    if small.singular[0] == 0.0 {
        return Err(sticks());
    }
    let best = small.v.column(0).abs();
    let separable = small.singular[1] > SEPARABLE * small.singular[0];
    let at = least(&read, first(&read, best)?, (!separable).then_some(best))?;
    let here = Decomposed::of(&read, at)?;
    if here.singular[0] <= 1e-9 * small.singular[0] {
        return Err(sticks());
    }
    let separable = separable && here.singular[1] > SEPARABLE * here.singular[0];
    let freedom = n - if separable { 2 } else { 1 };
    let noise = (here.residuals.norm_squared() / freedom as f64).sqrt();
    // Without friction: where the residuals want the best identified sum to be
    let along = &here.slopes * best;
    let wanted = along.dot(&here.residuals) / along.norm_squared();
    let unexplained = here.residuals.norm_squared() - wanted.powi(2) * along.norm_squared();
    let deviation = (unexplained.max(0.0) / freedom as f64).sqrt() / along.norm();
    let is_negative = at.amax() == 0.0 && wanted < -(3.0 * deviation).max(1e-9);
    if is_negative || at.x >= MOST.x || at.y >= MOST.y {
        let expected =
            "tensions greater at the winch than at the platform where cable runs towards the winch";
        return Err(invalid(format!("a list of {n}"), expected));
    }
    Ok((concluded(at, here.v, here.singular, separable, noise), coefficients(at)))
}

fn coefficients(at: Vector2<f64>) -> PulleyFriction {
    PulleyFriction { friction: at.x, bearing: at.y }
}

/// The best start along a direction.
fn first<E>(
    read: &impl Fn(Vector2<f64>) -> Result<DVector<f64>, E>,
    direction: Vector2<f64>,
) -> Result<Vector2<f64>, E> {
    let mut start = (Vector2::repeat(SMALL), f64::INFINITY);
    let mut failed = None;
    for size in STARTS {
        let at = (direction * size).zip_map(&MOST, f64::min);
        match read(at) {
            Ok(found) if found.norm_squared() < start.1 => start = (at, found.norm_squared()),
            Ok(_) => {}
            Err(error) => failed = Some(error),
        }
    }
    match failed {
        Some(error) if start.1.is_infinite() => Err(error),
        _ => Ok(start.0),
    }
}

/// The minimum near a start, along a direction if one is given.
fn least<E: From<StaticsError>>(
    read: &impl Fn(Vector2<f64>) -> Result<DVector<f64>, E>,
    mut at: Vector2<f64>,
    direction: Option<Vector2<f64>>,
) -> Result<Vector2<f64>, E> {
    let mut damping = 1e-3;
    let mut here = Decomposed::of(read, at)?;
    for _ in 0..MAX_ITERATIONS {
        let step = here.step(at, direction, damping);
        let next = (at + step).zip_map(&MOST, f64::min).map(|value| value.max(0.0));
        if (next - at).amax() <= SAME {
            return Ok(at);
        }
        // Where the model has no answer the step is too long.
        let lower = Decomposed::of(read, next)
            .ok()
            .filter(|found| found.residuals.norm_squared() < here.residuals.norm_squared());
        match lower {
            Some(found) => (at, here, damping) = (next, found, (0.1 * damping).max(1e-12)),
            None => damping *= 10.0,
        }
    }
    let expected = "tensions that depend on the friction of the pulleys as the model has it";
    let value = format!("a list of {}", here.residuals.len());
    Err(StaticsError::invalid("winch_tension".to_owned(), value, expected).into())
}

/// Residuals, their derivatives by μ and c with the opposite sign, singular values and right vectors.
struct Decomposed {
    residuals: DVector<f64>,
    slopes: MatrixXx2<f64>,
    v: Matrix2<f64>,
    singular: [f64; 2],
}

impl Decomposed {
    fn of<E>(read: &impl Fn(Vector2<f64>) -> Result<DVector<f64>, E>, at: Vector2<f64>) -> Result<Self, E> {
        let residuals = read(at)?;
        let mut slopes = MatrixXx2::zeros(residuals.len());
        for i in 0..2 {
            let (mut high, mut low) = (at, at);
            (high[i], low[i]) = ((at[i] + STEP).min(MOST[i]), (at[i] - STEP).max(0.0));
            slopes.set_column(i, &((read(low)? - read(high)?) / (high[i] - low[i])));
        }
        let SVD { v_t, singular_values, .. } = slopes.clone().svd(false, true);
        let v = v_t.map_or_else(Matrix2::identity, |v_t| Matrix2::from_fn(|i, j| v_t[(j, i)]));
        let at = |k: usize| singular_values.get(k).copied().unwrap_or(0.0);
        Ok(Self { residuals, slopes, v, singular: [at(0), at(1)] })
    }

    /// A damped step; coefficients at a bound that would pass it stay there.
    fn step(&self, at: Vector2<f64>, direction: Option<Vector2<f64>>, damping: f64) -> Vector2<f64> {
        let down = self.slopes.tr_mul(&self.residuals);
        let square = self.slopes.tr_mul(&self.slopes);
        if let Some(direction) = direction {
            let curved = direction.dot(&(square * direction)) * (1.0 + damping);
            return if curved > 0.0 { direction * (direction.dot(&down) / curved) } else { Vector2::zeros() };
        }
        let stays = [0, 1].map(|i| at[i] <= 0.0 && down[i] < 0.0 || at[i] >= MOST[i] && down[i] > 0.0);
        let curved = |i: usize| square[(i, i)] * (1.0 + damping);
        match stays {
            [true, true] => Vector2::zeros(),
            [true, false] => Vector2::new(0.0, down.y / curved(1)),
            [false, true] => Vector2::new(down.x / curved(0), 0.0),
            [false, false] => {
                let mut damped = square;
                (damped[(0, 0)], damped[(1, 1)]) = (curved(0), curved(1));
                damped.try_inverse().map_or_else(Vector2::zeros, |inverse| inverse * down)
            }
        }
    }
}
