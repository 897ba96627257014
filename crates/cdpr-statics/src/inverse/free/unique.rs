//! Whether a rest with free coordinates is the only one near it.
//!
//! Where one equation of the balance follows from the others, the slopes of (I6) have a kernel, and a line of
//! solutions passes through each solution: tensions that no equation determines, or a height at which every
//! length is right. Slopes that are singular to rounding are no proof. So the balance is solved again after a
//! step along the kernel: from an isolated solution the search returns to it. A motion that nothing resists
//! ([`Stability::neutral`]) leaves lengths and tensions as they are, and is no reason to refuse them.
//!
//! [`Stability::neutral`]: crate::Stability::neutral

use super::search::{Outcome, Point, SINGULAR_VALUES, Search, Unknowns};
use crate::error::StaticsError;
use crate::inverse::PoseLengths;
use nalgebra::{DVector, SVD};

/// Singular values below this share of the greatest may be those of a kernel.
const KERNEL: f64 = 1e-7;

/// Greatest part of a step along the kernel: the logarithm of a chord force, an angle [rad], or a position
/// relative to the longest span.
const STEP: f64 = 0.05;

/// Share of the step that is left where solutions go on along it.
const LEFT: f64 = 0.5;

/// Change of a tension relative to the greatest, or of a length relative to the longest span, beyond which it
/// is another solution and no rounding.
const CHANGED: f64 = 1e-7;

impl Search<'_> {
    /// Refuses a solution through which a line of solutions with other lengths or tensions passes.
    ///
    /// # Errors
    /// [`StaticsError::NotUnique`].
    pub(super) fn check_unique(&self, found: &Unknowns) -> Result<(), StaticsError> {
        let Some(point) = self.point(&found.changes, &found.chord_forces) else { return Ok(()) };
        for direction in self.kernel(found, &point) {
            let Some(other) = self.along(found, &direction) else { continue };
            let Some((cable, change)) = self.greatest_change(&point.found, &other.found) else { continue };
            if change > CHANGED {
                let lengths = [&point, &other].map(|one| one.found.lengths[cable]);
                let tensions = [&point, &other].map(|one| one.found.equilibrium.tensions()[cable]);
                let position = point.found.equilibrium.pose.position.into();
                return Err(StaticsError::NotUnique { position, cable, lengths, tensions });
            }
        }
        Ok(())
    }

    /// Directions in (ln σ, q) along which the residual does not change, to first order.
    fn kernel(&self, at: &Unknowns, point: &Point) -> Vec<DVector<f64>> {
        let svd = self
            .slopes(&at.changes, &at.chord_forces, point)
            .and_then(|slopes| slopes.try_svd(false, true, f64::EPSILON, SINGULAR_VALUES));
        let Some(SVD { v_t: Some(rows), singular_values, .. }) = svd else { return Vec::new() };
        let least = KERNEL * singular_values.max();
        let all = rows.row_iter().zip(singular_values.iter());
        all.filter(|(_, value)| **value <= least).map(|(row, _)| row.transpose()).collect()
    }

    /// The solution to which the search leads after a step along a direction; `None` where it leads back.
    fn along(&self, at: &Unknowns, direction: &DVector<f64>) -> Option<Point> {
        let step = direction * (STEP / direction.amax());
        let (changes, chord_forces, _) = self.moved(&at.changes, &at.chord_forces, &step)?;
        let Outcome::Found(other, end, _) = self.descend(Unknowns { changes, chord_forces }) else {
            return None;
        };
        let forces = end.chord_forces.iter().zip(&at.chord_forces).map(|(one, other)| (one / other).ln());
        let places = end.changes.iter().zip(&at.changes).map(|(one, other)| one - other);
        let moved = DVector::from_iterator(step.len(), forces.chain(places));
        (moved.dot(&step) >= LEFT * step.norm_squared()).then_some(other)
    }

    /// The cable whose length or tension differs most between two solutions, and by how much: relative to the
    /// longest span, or to the greatest tension.
    fn greatest_change(&self, one: &PoseLengths, other: &PoseLengths) -> Option<(usize, f64)> {
        let [before, after] = [one, other].map(|of| of.equilibrium.tensions());
        let most = before.iter().copied().fold(0.0, f64::max);
        let change = |i: usize| {
            let of_length = (one.lengths[i] - other.lengths[i]).abs() / self.size;
            (i, of_length.max((before[i] - after[i]).abs() / most))
        };
        (0..before.len()).map(change).max_by(|one, other| one.1.total_cmp(&other.1))
    }
}
