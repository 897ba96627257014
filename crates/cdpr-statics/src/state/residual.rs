//! Residual of the equations of an equilibrium.

/// Residual of the original `6 + 2n` equations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// Largest distance between the end of a cable and its anchor point [m].
    pub closure: f64,
    /// Unbalanced force on the platform [N].
    pub force: f64,
    /// Unbalanced moment about P [N m].
    pub moment: f64,
}

/// Rounding error of the closure of a cable [m], for lengths up to `size` and coordinates up to `coordinates`
/// [m].
pub(crate) fn rounding_of_closure(size: f64, coordinates: f64) -> f64 {
    1e-13 * size + 4.0 * f64::EPSILON * coordinates
}
