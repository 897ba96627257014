//! How a point of the platform is shaken, and which of its motions nothing bounds.
//!
//! At a distance d below a natural frequency that nothing damps, every motion is `a + b/d`: those at d and 2
//! d give a and b. Where b is rounding, the motion at the natural frequency is a; elsewhere it has no bound.

use crate::error::DynamicsError;
use crate::response::{Damping, FrequencyResponse, Response};
use cdpr_statics::Vector3;
use nalgebra::{Complex, Matrix3, Matrix3xX};

/// Relative distance d from a natural frequency.
const BESIDE: f64 = 1e-7;

/// Part of the largest a below which b/d is rounding.
const ROUNDING: f64 = 1e-3;

/// The greatest amplitude compared with that at rest: beyond, it is rounding that bounds it. What damps the
/// stretch alone leaves motions across the cables without damping.
const MOST_UNDAMPED: f64 = 1e5;
const MOST_DAMPED: f64 = 1e9;

/// A point of a platform that is shaken.
#[derive(Clone, Debug)]
pub struct ShakenPoint<'a> {
    response: &'a FrequencyResponse,
    lever: Vector3<f64>,
    /// The greatest amplitudes [m/N, m/m].
    most: [f64; 2],
}

/// Complex amplitudes of a point at a frequency; infinite is what nothing bounds.
#[derive(Clone, Debug, PartialEq)]
pub struct PointMotion {
    /// The frequency [Hz].
    pub frequency: f64,
    /// Along x, y and z for forces at the point [m/N].
    pub per_force: Matrix3<Complex<f64>>,
    /// The same for the length that each winch takes in, 3 x n [m/m].
    pub per_shortening: Matrix3xX<Complex<f64>>,
}

impl PointMotion {
    fn new(found: &Response, lever: &Vector3<f64>) -> Self {
        let (per_force, per_shortening) = found.at_point(lever);
        Self { frequency: found.frequency, per_force, per_shortening }
    }
}

impl<'a> ShakenPoint<'a> {
    /// The point at a lever from P in the base frame [m].
    ///
    /// # Errors
    /// [`DynamicsError::Resonance`] for a platform with a singular stiffness.
    pub fn new(response: &'a FrequencyResponse, lever: &Vector3<f64>) -> Result<Self, DynamicsError> {
        let most = if response.damping == Damping::default() { MOST_UNDAMPED } else { MOST_DAMPED };
        let (forces, winches) = response.at(0.0)?.resisted_at_point(lever);
        let most = [largest(forces.iter()), largest(winches.iter())].map(|still| most * still);
        Ok(Self { response, lever: *lever, most })
    }

    /// Its motion at a frequency [Hz].
    ///
    /// # Errors
    /// As [`FrequencyResponse::at`].
    pub fn at(&self, frequency: f64) -> Result<PointMotion, DynamicsError> {
        let near = |share: f64| self.response.at(frequency * (1.0 - share));
        // At a natural frequency the matrix may be singular to the last digit.
        let found =
            near(0.0).or_else(|error| if frequency > 0.0 { near(f64::EPSILON) } else { Err(error) })?;
        let mut found = PointMotion { frequency, ..PointMotion::new(&found, &self.lever) };
        let [forces, winches] = self.most;
        let sizes = [largest(found.per_force.iter()), largest(found.per_shortening.iter())];
        if frequency == 0.0 || (sizes[0] < forces && sizes[1] <= winches) {
            return Ok(found);
        }
        let one = PointMotion::new(&near(BESIDE)?, &self.lever);
        let two = PointMotion::new(&near(2.0 * BESIDE)?, &self.lever);
        without_poles(found.per_force.iter_mut(), one.per_force.iter().zip(&two.per_force));
        without_poles(found.per_shortening.iter_mut(), one.per_shortening.iter().zip(&two.per_shortening));
        Ok(found)
    }
}

/// The largest size of complex numbers.
fn largest<'a>(numbers: impl Iterator<Item = &'a Complex<f64>>) -> f64 {
    numbers.map(|number| number.norm()).fold(0.0, f64::max)
}

fn without_poles<'a>(
    motions: impl Iterator<Item = &'a mut Complex<f64>>,
    neighbours: impl Iterator<Item = (&'a Complex<f64>, &'a Complex<f64>)>,
) {
    let parts: Vec<_> = neighbours.map(|(one, two)| (two * 2.0 - one, (one - two) * 2.0)).collect();
    let least = ROUNDING * largest(parts.iter().map(|(rest, _)| rest));
    for (motion, (rest, pole)) in motions.zip(parts) {
        let unbounded = Complex::new(f64::INFINITY, f64::INFINITY);
        *motion = if pole.norm() > least { unbounded } else { rest };
    }
}
