//! Elastic laws of a cable: a strain in proportion to the tension, or with pieces of different stiffness.
//!
//! The strain is a continuous, strictly increasing function of the tension. It is written as `ε(T) = σ(T)/EA`
//! with the cable's axial stiffness EA as a scale, so that a change of the modulus scales the whole law:
//!
//! ```text
//! linear:      σ = T                                                                           (C14)
//! piecewise:   σ = σ_k + (T - T_k)/κ_k      for T_k <= T < T_{k+1},   κ_k = EA_k/EA            (C15)
//! ```
//!
//! Within a segment `1 + ε = α_k + T/EA_k` with `α_k = 1 + (σ_k - T_k/κ_k)/EA`, and the complementary energy
//! per length is `∫ ε dT = c_k + (α_k - 1) T + T²/2EA_k` with a constant c_k.

use crate::error::{CableError, check};
use crate::kernel::LawSegment;

/// Strain as a function of the tension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ElasticLaw<'a> {
    /// The strain is T/EA.
    Linear,
    /// The strain has segments of different stiffness.
    Piecewise(&'a PiecewiseLaw),
}

impl<'a> ElasticLaw<'a> {
    /// The segments as [`crate::kernel::Material`] takes them; none of a linear law.
    #[inline]
    pub(crate) fn terms(&self) -> &'a [LawSegment] {
        match self {
            Self::Linear => &[],
            Self::Piecewise(law) => law.terms(),
        }
    }
}

/// A strain that grows with the tension by segments of different stiffness.
#[derive(Clone, Debug, PartialEq)]
pub struct PiecewiseLaw(Vec<LawSegment>);

/// A range of tensions over which the stiffness of a law is constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Tension T_k at which it begins [N]; zero for the first one.
    pub tension: f64,
    /// Its stiffness over the cable's, κ_k = EA_k/EA.
    pub ratio: f64,
}

impl PiecewiseLaw {
    /// A law from its segments, the first of which begins at zero tension.
    ///
    /// `scaled_strain_at_rest` is the strain without tension times the cable's axial stiffness [N], zero for
    /// a new cable.
    ///
    /// # Errors
    /// [`CableError::InvalidInput`] for no segment, tensions that do not grow from zero, or a stiffness ratio
    /// that is not between 1e-6 and 1e6.
    pub fn new(scaled_strain_at_rest: f64, segments: &[Segment]) -> Result<Self, CableError> {
        check("law.segments", segments.len() as f64, !segments.is_empty(), "one segment at least")?;
        check("law.strain_at_rest", scaled_strain_at_rest, true, "a finite strain")?;
        let mut law: Vec<LawSegment> = Vec::with_capacity(segments.len());
        for &Segment { tension, ratio } in segments {
            let begins = law.last().map_or(tension == 0.0, |before| tension > before.from);
            let expected = "tensions that grow from 0 [N], where each segment begins";
            check("law.segments.tension", tension, begins, expected)?;
            let expected = "a stiffness from 1e-6 to 1e6 of the cable's";
            check("law.segments.ratio", ratio, (1e-6..=1e6).contains(&ratio), expected)?;
            let (strain, energy) = law.last().map_or((scaled_strain_at_rest, 0.0), |before| {
                (before.strain_at(tension), before.energy_at(tension))
            });
            let (offset, flexibility) = (strain - tension / ratio, 1.0 / ratio);
            law.push(LawSegment { from: tension, ratio, strain, offset, flexibility, energy });
        }
        Ok(Self(law))
    }

    /// The segments, from zero tension up.
    pub fn segments(&self) -> impl Iterator<Item = Segment> {
        self.0.iter().map(|segment| Segment { tension: segment.from, ratio: segment.ratio })
    }

    /// Strain without tension, times the cable's axial stiffness [N].
    pub fn scaled_strain_at_rest(&self) -> f64 {
        self.0[0].strain
    }

    /// Strain at a tension [N], times the cable's axial stiffness [N].
    pub fn scaled_strain(&self, tension: f64) -> f64 {
        self.at(tension).strain_at(tension)
    }

    /// Integral of the strain from zero tension to a tension [N], times the cable's axial stiffness [N²].
    pub fn scaled_energy(&self, tension: f64) -> f64 {
        self.at(tension).energy_at(tension)
    }

    /// Stiffness at a tension [N] over the cable's, κ; at a kink it is that of the segment above.
    pub fn ratio(&self, tension: f64) -> f64 {
        self.at(tension).ratio
    }

    /// Stiffness of the secant between two tensions [N] over the cable's.
    ///
    /// Where the two are the same it is [`PiecewiseLaw::ratio`].
    pub fn secant_ratio(&self, from: f64, to: f64) -> f64 {
        if from == to {
            self.ratio(to)
        } else {
            (to - from) / (self.scaled_strain(to) - self.scaled_strain(from))
        }
    }

    /// Tension [N] at a strain times the cable's axial stiffness [N]; zero below the strain at rest.
    pub fn tension(&self, scaled_strain: f64) -> f64 {
        let above = self.0.partition_point(|segment| segment.strain <= scaled_strain);
        let LawSegment { from, ratio, strain, .. } = self.0[above.max(1) - 1];
        (from + (scaled_strain - strain) * ratio).max(0.0)
    }

    fn at(&self, tension: f64) -> &LawSegment {
        let above = self.0.partition_point(|segment| segment.from <= tension);
        &self.0[above.max(1) - 1]
    }

    /// The segments as [`crate::kernel::Material`] takes them.
    pub fn terms(&self) -> &[LawSegment] {
        &self.0
    }
}

impl LawSegment {
    fn strain_at(&self, tension: f64) -> f64 {
        self.strain + (tension - self.from) / self.ratio
    }

    fn energy_at(&self, tension: f64) -> f64 {
        let more = tension - self.from;
        self.energy + more * (self.strain + 0.5 * more / self.ratio)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Material;
    use approx::assert_relative_eq;

    fn segment((tension, ratio): (f64, f64)) -> Segment {
        Segment { tension, ratio }
    }

    fn stiffening() -> PiecewiseLaw {
        PiecewiseLaw::new(3.0, &[(0.0, 0.5), (100.0, 1.0), (300.0, 2.0)].map(segment)).unwrap()
    }

    #[test]
    fn strain_and_tension_are_inverse_of_each_other() {
        let law = stiffening();
        assert_eq!(law.scaled_strain(100.0), 203.0);
        assert_eq!(law.scaled_strain(300.0), 403.0);
        assert_eq!(law.scaled_strain(500.0), 503.0);
        for tension in [0.0, 1.0, 100.0, 250.0, 300.0, 1e4] {
            assert_relative_eq!(law.tension(law.scaled_strain(tension)), tension, epsilon = 1e-12);
        }
        assert_eq!(law.tension(2.0), 0.0);
    }

    #[test]
    fn a_secant_lies_between_the_segments_that_it_spans() {
        let law = stiffening();
        // 200 N in each of the two pieces, of κ = 1 and 2.
        assert_relative_eq!(law.secant_ratio(100.0, 500.0), 400.0 / 300.0, max_relative = 1e-15);
        assert_relative_eq!(law.secant_ratio(500.0, 100.0), 400.0 / 300.0, max_relative = 1e-15);
        assert_eq!(law.secant_ratio(120.0, 180.0), 1.0);
        assert_eq!(law.secant_ratio(300.0, 300.0), 2.0);
    }

    #[test]
    fn the_material_has_the_law_and_its_integral() {
        let (law, ea) = (stiffening(), 1e4);
        let mut energy = 0.0;
        let step = 0.25;
        for k in 0..2000 {
            let (middle, high) = (step * (f64::from(k) + 0.5), step * f64::from(k + 1));
            energy += step * law.scaled_strain(middle) / ea;
            let material = Material { law: law.terms(), weight_per_length: 0.0, axial_flexibility: 1.0 / ea };
            let [stretch, flexibility] = material.stretch(high);
            assert_relative_eq!(stretch, 1.0 + law.scaled_strain(high) / ea, max_relative = 1e-14);
            assert_relative_eq!(flexibility, 1.0 / (ea * law.ratio(high)), max_relative = 1e-14);
            let closed = material.energy(high);
            assert_relative_eq!(closed, energy, max_relative = 1e-12);
        }
    }

    #[test]
    fn a_law_that_does_not_grow_is_refused() {
        let field = |segments: &[(f64, f64)]| {
            let segments: Vec<_> = segments.iter().copied().map(segment).collect();
            match PiecewiseLaw::new(0.0, &segments) {
                Err(CableError::InvalidInput { field, .. }) => field,
                other => panic!("{other:?}"),
            }
        };
        assert_eq!(field(&[]), "law.segments");
        assert_eq!(field(&[(1.0, 1.0)]), "law.segments.tension");
        assert_eq!(field(&[(0.0, 1.0), (0.0, 2.0)]), "law.segments.tension");
        assert_eq!(field(&[(0.0, 0.0)]), "law.segments.ratio");
        assert_eq!(field(&[(0.0, 1.0), (5.0, f64::NAN)]), "law.segments.ratio");
    }
}
