//! What a cable is made of.

use crate::error::{CableError, SMALLEST, check};
use crate::law::ElasticLaw;

/// What a cable is made of, per metre of unstrained length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cable<'a> {
    /// Weight per unstrained length w = rho g [N/m]; zero makes the cable a straight spring.
    pub weight_per_length: f64,
    /// Axial stiffness EA [N]; a piecewise law is given relative to it.
    pub axial_stiffness: f64,
    /// Elastic law: the strain as a function of the tension.
    pub law: ElasticLaw<'a>,
}

impl Cable<'_> {
    /// A linear cable of this weight per unstrained length [N/m] and axial stiffness EA [N].
    pub const fn linear(weight_per_length: f64, axial_stiffness: f64) -> Self {
        Self { weight_per_length, axial_stiffness, law: ElasticLaw::Linear }
    }

    /// Strain at a tension [N].
    #[inline]
    pub fn strain(&self, tension: f64) -> f64 {
        match self.law {
            ElasticLaw::Linear => tension / self.axial_stiffness,
            ElasticLaw::Piecewise(law) => law.scaled_strain(tension) / self.axial_stiffness,
        }
    }

    /// Tension at a strain [N], never negative because a cable does not push.
    pub fn tension(&self, strain: f64) -> f64 {
        match self.law {
            ElasticLaw::Linear => (self.axial_stiffness * strain).max(0.0),
            ElasticLaw::Piecewise(law) => law.tension(self.axial_stiffness * strain),
        }
    }

    /// Tangent stiffness dT/dε [N] at a tension [N].
    pub fn tangent_stiffness(&self, tension: f64) -> f64 {
        match self.law {
            ElasticLaw::Linear => self.axial_stiffness,
            ElasticLaw::Piecewise(law) => self.axial_stiffness * law.ratio(tension),
        }
    }

    /// Checks that the weight is zero or from 1e-30 N/m to 1e30 N/m, the stiffness from 1e-30 N to 1e30 N.
    ///
    /// # Errors
    /// [`CableError::InvalidInput`] names the field.
    pub fn validate(&self) -> Result<(), CableError> {
        let Self { weight_per_length: w, axial_stiffness: ea, .. } = *self;
        check(
            "weight_per_length",
            w,
            w == 0.0 || w >= SMALLEST,
            "a weight per length, zero or from 1e-30 to 1e30 [N/m]",
        )?;
        check("axial_stiffness", ea, ea >= SMALLEST, "an axial stiffness from 1e-30 to 1e30 [N]")?;
        match self.law {
            ElasticLaw::Linear => Ok(()),
            ElasticLaw::Piecewise(_) => {
                let at_rest = self.strain(0.0);
                check("law.strain_at_rest", at_rest, at_rest > -1.0, "a strain above -1")
            }
        }
    }

    /// Whether the weight of this length vanishes beside the stiffness, and its square underflows.
    pub(crate) fn is_weightless(&self, unstrained_length: f64) -> bool {
        self.weight_per_length * unstrained_length <= 1e-100 * self.axial_stiffness
    }
}
