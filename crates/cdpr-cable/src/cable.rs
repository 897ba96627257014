//! What a cable is made of, and what follows from that alone.
//!
//! Between two points of a cable in equilibrium the tension depends on their difference in height z alone:
//! with `T dT = V w ds` and `dz = (V/T)(1 + ε) ds` the arc length s drops out of
//!
//! ```text
//! ∫ (1 + ε(T)) dT = w z      from the lower tension to the upper one                              (C26)
//! ```
//!
//! For a linear cable that is `t + t²/2EA = T0 + T0²/2EA + w z`, whatever its sag.
//!
//! Between ends at rest the slowest motion of a cable of mass ρ per unstrained length is the first one across
//! its plane, that of a string of its mean tension T and stretched length `L (1 + ε)`,
//!
//! ```text
//! f = 1/(2 L) sqrt(T/(ρ (1 + ε)))                                                                (C29)
//! ```
//!
//! In its plane the first symmetric motion is as slow for a straight cable, and faster the more the cable
//! sags; the first antisymmetric one is at 2 f (Irvine 1981, section 3.2).

use crate::error::{CableError, MAX_STRAIN, SMALLEST, check};
use crate::guide::{Entry, Guide, Straight, in_plane};
use crate::kernel::{Material, closure_of_slack};
use crate::law::ElasticLaw;
use nalgebra::{Vector2, Vector3};

/// What a cable is made of, per metre of unstrained length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cable<'a> {
    /// Weight per unstrained length w = rho g [N/m]; zero makes the cable a straight spring.
    pub weight_per_length: f64,
    /// Axial stiffness EA [N]; a piecewise law is given relative to it.
    pub axial_stiffness: f64,
    /// Elastic law: the strain as a function of the tension.
    pub law: ElasticLaw<'a>,
    /// What leads it to the point where it leaves for the platform; `None` for an exit point alone.
    pub guide: Option<Guide>,
}

/// The numbers that the response of a cable depends on, of any kind.
#[derive(Clone, Copy)]
pub(crate) struct Numbers<T> {
    /// w [N/m].
    pub(crate) weight_per_length: T,
    /// 1/EA [1/N].
    pub(crate) axial_flexibility: T,
    /// Lead of the guide [m]; zero without one.
    pub(crate) lead: T,
    /// Radius of the pulley [m]; zero without one.
    pub(crate) radius: T,
    /// Unstrained length L [m].
    pub(crate) length: T,
    /// Direction in which the cable enters a pulley whose axis is tilted.
    pub(crate) axis: [T; 3],
}

impl<T: Copy> Numbers<T> {
    /// The same numbers of another kind.
    #[inline]
    pub(crate) fn map<U>(self, of: impl Fn(T) -> U + Copy) -> Numbers<U> {
        Numbers {
            weight_per_length: of(self.weight_per_length),
            axial_flexibility: of(self.axial_flexibility),
            lead: of(self.lead),
            radius: of(self.radius),
            length: of(self.length),
            axis: self.axis.map(of),
        }
    }
}

impl<'a> Cable<'a> {
    /// The material of a cable with this law and these numbers.
    #[inline]
    pub(crate) fn material<T: Copy>(&self, numbers: &Numbers<T>) -> Material<'a, T> {
        let Numbers { weight_per_length, axial_flexibility, .. } = *numbers;
        Material { law: self.law.terms(), weight_per_length, axial_flexibility }
    }
}

impl Cable<'_> {
    /// A linear cable of this weight per unstrained length [N/m] and axial stiffness EA [N].
    pub const fn linear(weight_per_length: f64, axial_stiffness: f64) -> Self {
        Self { weight_per_length, axial_stiffness, law: ElasticLaw::Linear, guide: None }
    }

    /// The numbers of this cable with an unstrained length [m].
    #[inline]
    pub(crate) fn numbers(&self, length: f64) -> Numbers<f64> {
        let [lead, radius] = self.guide.map_or([0.0; 2], |guide| [guide.lead, guide.radius]);
        let axis = self.guide.map_or([0.0; 3], |guide| guide.entry.axis());
        let axial_flexibility = 1.0 / self.axial_stiffness;
        Numbers { weight_per_length: self.weight_per_length, axial_flexibility, lead, radius, length, axis }
    }

    /// Strain at a tension [N].
    #[inline]
    pub fn strain(&self, tension: f64) -> f64 {
        match self.law {
            ElasticLaw::Linear => tension / self.axial_stiffness,
            ElasticLaw::Piecewise(law) => law.scaled_strain(tension) / self.axial_stiffness,
        }
    }

    /// Strain at a tension [N] that is beyond [`MAX_STRAIN`].
    #[inline]
    pub fn overstrain(&self, tension: f64) -> Option<f64> {
        Some(self.strain(tension)).filter(|strain| *strain > MAX_STRAIN)
    }

    /// Tension at a strain [N], never negative because a cable does not push.
    pub fn tension(&self, strain: f64) -> f64 {
        match self.law {
            ElasticLaw::Linear => (self.axial_stiffness * strain).max(0.0),
            ElasticLaw::Piecewise(law) => law.tension(self.axial_stiffness * strain),
        }
    }

    /// Elastic energy per unstrained length at a tension [N], `T ε - ∫ ε dT` [J/m].
    pub(crate) fn elastic_energy(&self, tension: f64) -> f64 {
        tension * self.strain(tension) - self.energy_per_length(tension)
    }

    /// Length of a straight cable to `end = (x, z)` [m], lead and arc included [m]; that of the chord where
    /// the end lies too near to the pulley for one.
    pub fn straight_length(&self, end: Vector2<f64>) -> f64 {
        self.straight_length_in_space(in_plane(end.into()))
    }

    /// The same for an end in space, z upwards.
    pub fn straight_length_in_space(&self, end: Vector3<f64>) -> f64 {
        let straight = self.guide.and_then(|guide| guide.straight(end));
        straight.map_or_else(|| end.norm(), |straight| straight.free + straight.guided)
    }

    /// The straight cable to `end` [m], the cable without its guide, and the end from where it leaves that.
    ///
    /// # Errors
    /// [`CableError::AtPulley`] for an end within the wheel or behind it.
    pub(crate) fn straightened(
        &self,
        end: Vector3<f64>,
    ) -> Result<(Straight, Self, Vector3<f64>), CableError> {
        let guide = self.guide.unwrap_or(Guide { lead: 0.0, radius: 0.0, entry: Entry::Upwards });
        let straight = guide.straight(end).ok_or_else(|| self.below_the_pulley(end))?;
        let beyond = end - straight.leave;
        Ok((straight, Self { guide: None, ..*self }, beyond))
    }

    pub(crate) fn below_the_pulley(&self, end: Vector3<f64>) -> CableError {
        let axis = self.guide.map_or_else(Vector3::z, |guide| guide.entry.axis().into());
        CableError::AtPulley { distance: (end - axis * end.dot(&axis)).norm() }
    }

    /// Whether it runs over a pulley with a tilted axis: then it is a [`crate::SpatialCable`], whose plane
    /// depends on its force.
    #[inline]
    pub fn leaves_its_plane(&self) -> bool {
        self.guide.is_some_and(|guide| guide.radius > 0.0 && guide.entry.is_tilted())
    }

    /// Closure residual of a slack cable without weight: see [`crate::kernel::closure_of_slack`].
    pub(crate) fn closure_of_slack(&self, end: [f64; 2], rest: f64) -> [f64; 2] {
        let Some(guide) = &self.guide else { return closure_of_slack(end, rest) };
        let open = guide.closure_of_slack(in_plane(end), rest);
        [open.x, open.z]
    }

    /// Tangent stiffness dT/dε [N] at a tension [N].
    pub fn tangent_stiffness(&self, tension: f64) -> f64 {
        match self.law {
            ElasticLaw::Linear => self.axial_stiffness,
            ElasticLaw::Piecewise(law) => self.axial_stiffness * law.ratio(tension),
        }
    }

    /// The integral of the strain over the tension, from zero to a tension [N].
    pub fn energy_per_length(&self, tension: f64) -> f64 {
        match self.law {
            ElasticLaw::Linear => 0.5 * tension * tension / self.axial_stiffness,
            ElasticLaw::Piecewise(law) => law.scaled_energy(tension) / self.axial_stiffness,
        }
    }

    /// Lowest natural frequency [Hz] of a free part of this unstrained length [m] and mean tension [N], with
    /// `linear_density` [kg/m], between ends at rest, (C29); `None` for a cable without mass.
    pub fn lowest_frequency(&self, linear_density: f64, free_length: f64, tension: f64) -> Option<f64> {
        let stretched = linear_density * (1.0 + self.strain(tension));
        let frequency = (tension / stretched).sqrt() / (2.0 * free_length);
        (stretched > 0.0 && frequency.is_finite()).then_some(frequency)
    }

    /// The tension [N] at `height` [m] above a point of the cable where it is `tension` [N], equation (C26);
    /// `None` where even without tension the cable between them weighs more.
    pub fn tension_above(&self, tension: f64, height: f64) -> Option<f64> {
        let above = self.material(&self.numbers(0.0)).tension_above(tension, height);
        Some(above).filter(|above| *above > 0.0)
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
        self.guide.map_or(Ok(()), |guide| guide.validate())?;
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
