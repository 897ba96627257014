//! Mass per length of a cable from the weighing of a piece of it.

use crate::error::{CableError, SMALLEST, check};

/// A measured quantity with its absolute error, both in the same unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The value.
    pub value: f64,
    /// Its greatest error.
    pub error: f64,
}

/// Mass per length [kg/m] of a piece of cable of mass m [kg] and length L [m]: `ρ = m/L`.
///
/// Its error `δρ = (m δL + L δm)/L²` is that of section 4.2.2 of Baklouti, Caro, Courteille (CableCon 2017),
/// in which both errors add up.
///
/// ```
/// use cdpr_cable::{Measured, linear_density};
///
/// // Two metres, measured to 1 mm, on a balance that shows grams.
/// let mass = Measured { value: 0.203, error: 0.001 };
/// let length = Measured { value: 2.0, error: 0.001 };
/// let density = linear_density(mass, length)?;
/// assert!((density.value - 0.1015).abs() < 1e-15);
/// assert!((density.error - 0.00055075).abs() < 1e-15);
/// # Ok::<(), cdpr_cable::CableError>(())
/// ```
///
/// # Errors
/// [`CableError::InvalidInput`] for a mass or length that is not positive, or an error that is negative.
pub fn linear_density(mass: Measured, length: Measured) -> Result<Measured, CableError> {
    check("mass", mass.value, mass.value >= SMALLEST, "a mass from 1e-30 to 1e30 [kg]")?;
    check("length", length.value, length.value >= SMALLEST, "a length from 1e-30 to 1e30 [m]")?;
    check("mass_error", mass.error, mass.error >= 0.0, "an error up to 1e30, zero or more [kg]")?;
    check("length_error", length.error, length.error >= 0.0, "an error up to 1e30, zero or more [m]")?;
    let value = mass.value / length.value;
    Ok(Measured { value, error: value * (length.error / length.value) + mass.error / length.value })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_weighing_without_mass_or_length_is_refused() {
        let measured = |value, error| Measured { value, error };
        let field = |mass, length| match linear_density(mass, length) {
            Err(CableError::InvalidInput { field, .. }) => field,
            other => panic!("{other:?}"),
        };
        assert_eq!(field(measured(0.0, 0.0), measured(1.0, 0.0)), "mass");
        assert_eq!(field(measured(1.0, 0.0), measured(-1.0, 0.0)), "length");
        assert_eq!(field(measured(1.0, -1e-3), measured(1.0, 0.0)), "mass_error");
        assert_eq!(field(measured(1.0, 0.0), measured(1.0, f64::NAN)), "length_error");
    }
}
