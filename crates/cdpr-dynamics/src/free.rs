//! The free part of a cable at rest: its tension, its elements, and how it begins.

use crate::element::{Beginning, Element, Matrices, assemble};
use crate::error::DynamicsError;
use cdpr_cable::{Catenary, ElasticLaw};
use cdpr_statics::vibration::CableAtRest;
use nalgebra::{Matrix2, Matrix3, Vector2};
use std::f64::consts::TAU;

/// Degree of an element beyond 1.6 for each half wave: Legendre's polynomials need π points a wave.
const MORE_DEGREES: usize = 12;
const DEGREES_PER_HALF_WAVE: f64 = 1.6;

/// Half waves of one cable at the greatest frequency that are computed.
const MOST_HALF_WAVES: f64 = 400.0;

/// Elements are halved until the points of no tension, in the complex plane, are this share of their length
/// away: there the direction of the cable turns.
const NEAREST_TURN: f64 = 0.8;

/// Halvings after which a cable is folded.
const MOST_HALVINGS: usize = 30;

/// Compliance of a pulley below this share of the cable's is rounding.
const ROUNDING: f64 = 1e-9;

/// The rotor of a winch, and the servo that holds it. Both are taken at the cable on the drum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotor {
    /// Inertia about its axis by the square of the drum's radius [kg].
    pub mass: f64,
    /// Stiffness of the servo [N/m]: a cable that runs out by a metre is pulled back by so much.
    pub stiffness: f64,
}

impl Rotor {
    /// Refuses a negative mass, a stiffness that is not positive, values that are not finite, and a rotor so
    /// slow that rounding hides the motions up to a frequency [Hz].
    pub(crate) fn check(&self, highest: f64) -> Result<(), DynamicsError> {
        /// Greatest square of the highest frequency over that of the rotor on its servo.
        const SLOWEST: f64 = 1e8;
        let Self { mass, stiffness } = *self;
        let invalid = |field, value: f64, expected: &str| {
            let (value, expected) = (format!("{value:?}"), expected.to_owned());
            Err(DynamicsError::Invalid { field, value, expected })
        };
        if !(mass.is_finite() && mass >= 0.0) {
            return invalid("mass of the winches", mass, "a finite mass, zero or more [kg]");
        }
        if !(stiffness.is_finite() && stiffness > 0.0) {
            let expected = "a finite stiffness above zero [N/m]: free rotors hold no platform";
            return invalid("stiffness of the winches", stiffness, expected);
        }
        let most = SLOWEST * stiffness / (TAU * highest).powi(2);
        if mass > most {
            return invalid(
                "mass of the winches",
                mass,
                &format!("at most {most:.3e} kg with this stiffness"),
            );
        }
        Ok(())
    }

    /// The beginning of a straight cable at the drum.
    fn start(&self) -> Beginning<1> {
        let mut matrices = Matrices::zeros(1);
        (matrices.stiffness[(0, 0)], matrices.mass[(0, 0)]) = (self.stiffness, self.mass);
        Beginning { directions: vec![[1.0]], matrices }
    }
}

/// How a cable begins: in its plane and across it, which a wheel with a tilted axis couples.
pub(crate) enum Beginnings {
    Apart { in_plane: Beginning<2>, across: Beginning<1> },
    Together(Beginning<3>),
}

/// The free part of a cable, beyond its exit or leave point.
pub(crate) struct Free<'a> {
    pub(crate) cable: usize,
    pub(crate) free: Catenary<'a>,
}

impl Free<'_> {
    /// Tension vector (along the plane, upwards) at an unstrained length from the exit [N].
    pub(crate) fn tension(&self, s: f64) -> Vector2<f64> {
        let Catenary { cable, unstrained_length, force } = &self.free;
        Vector2::new(force.x, force.y - cable.weight_per_length * (unstrained_length - s))
    }

    /// (1 + ε)/N [1/N].
    pub(crate) fn slenderness(&self, s: f64) -> f64 {
        let tension = self.tension(s).norm();
        (1.0 + self.free.cable.strain(tension)) / tension
    }

    /// A of (N2) in the plane [N].
    pub(crate) fn modulus(&self, s: f64) -> [[f64; 2]; 2] {
        let tension = self.tension(s);
        let along = self.free.cable.tangent_stiffness(tension.norm());
        let across = self.slenderness(s).recip();
        let t = tension.normalize();
        let modulus = Matrix2::identity() * across + t * t.transpose() * (along - across);
        [[modulus[(0, 0)], modulus[(0, 1)]], [modulus[(1, 0)], modulus[(1, 1)]]]
    }

    /// The same in space: along the plane, across it, upwards.
    pub(crate) fn modulus_in_space(&self, s: f64) -> [[f64; 3]; 3] {
        let [[xx, xz], [zx, zz]] = self.modulus(s);
        [[xx, 0.0, xz], [0.0, self.slenderness(s).recip(), 0.0], [zx, 0.0, zz]]
    }

    /// Elements that end where the law of the cable has a kink, and that are short where it turns.
    pub(crate) fn elements(&self, density: f64, highest: f64) -> Result<Vec<Element>, DynamicsError> {
        let length = self.free.unstrained_length;
        let mut ends = vec![0.0];
        ends.extend(self.kinks());
        ends.push(length);
        let mut elements = Vec::new();
        for pair in ends.windows(2) {
            self.halve([pair[0], pair[1]], MOST_HALVINGS, &mut elements)?;
        }
        let per_hertz: Vec<f64> = elements.iter().map(|ends| self.half_waves(*ends, density)).collect();
        let limit = MOST_HALF_WAVES / per_hertz.iter().sum::<f64>();
        if highest > limit {
            let expected = format!(
                "{limit:.4} Hz at most, where cable {} has {MOST_HALF_WAVES} half waves",
                self.cable + 1
            );
            return Err(DynamicsError::Invalid {
                field: "highest frequency",
                value: format!("{highest:?} Hz"),
                expected,
            });
        }
        let element = |(ends, per_hertz): ([f64; 2], f64)| {
            let degree = (DEGREES_PER_HALF_WAVE * per_hertz * highest).ceil() as usize + MORE_DEGREES;
            Element { ends, degree }
        };
        Ok(elements.into_iter().zip(per_hertz).map(element).collect())
    }

    /// Unstrained lengths from the exit at which the law has another modulus.
    fn kinks(&self) -> Vec<f64> {
        let Catenary { cable, unstrained_length: length, force } = &self.free;
        let ElasticLaw::Piecewise(law) = &cable.law else { return Vec::new() };
        let weight = cable.weight_per_length;
        let mut kinks: Vec<f64> = law
            .segments()
            .filter(|_| weight > 0.0)
            .filter_map(|segment| {
                let square = segment.tension * segment.tension - force.x * force.x;
                (square > 0.0).then(|| square.sqrt())
            })
            .flat_map(|height| [height, -height].map(|fz| length - (force.y - fz) / weight))
            .filter(|s| *s > 1e-9 * length && *s < (1.0 - 1e-9) * length)
            .collect();
        kinks.sort_by(f64::total_cmp);
        kinks
    }

    fn halve(
        &self,
        [from, to]: [f64; 2],
        left: usize,
        found: &mut Vec<[f64; 2]>,
    ) -> Result<(), DynamicsError> {
        let Catenary { cable, unstrained_length, force } = &self.free;
        let weight = cable.weight_per_length;
        let turn = if weight > 0.0 {
            let lowest = unstrained_length - force.y / weight;
            (lowest - lowest.clamp(from, to)).hypot(force.x / weight)
        } else if *force == Vector2::zeros() {
            0.0
        } else {
            f64::INFINITY
        };
        if turn >= NEAREST_TURN * (to - from) {
            found.push([from, to]);
            return Ok(());
        }
        if left == 0 {
            return Err(DynamicsError::Folded { cable: self.cable });
        }
        let middle = 0.5 * (from + to);
        self.halve([from, middle], left - 1, found)?;
        self.halve([middle, to], left - 1, found)
    }

    /// Half waves across a part of the cable for each hertz [s]: 2 ∫ sqrt(μ (1 + ε)/N) ds.
    fn half_waves(&self, [from, to]: [f64; 2], density: f64) -> f64 {
        let points = crate::polynomial::gauss(8);
        let sum: f64 = points
            .iter()
            .map(|[x, weight]| {
                weight * (density * self.slenderness(from + 0.5 * (1.0 + x) * (to - from))).sqrt()
            })
            .sum();
        (to - from) * sum
    }

    /// How the point moves where the free part begins, in the plane and across it.
    ///
    /// Without pulley, a lead of stretched length d moves it along the cable: a bar between winch and exit
    /// point with mass. The tension changes by `w` for each metre that the cable slides upwards,
    ///
    /// ```text
    /// K = (bar) + w t_z/(1 + ε)                                                                    (N7)
    /// ```
    ///
    /// Over a pulley it moves as its static compliance says, the difference of the compliances of the whole
    /// cable and of its free part; cable on the wheel and behind it has no mass.
    ///
    /// A winch whose rotor of the mass m is held with the stiffness k feeds x, which moves the point by x t.
    /// Over a pulley the part t_i of t along a direction that its compliance K_i⁻¹ frees is fed through it:
    ///
    /// ```text
    /// K_xx = k + sum t_i² (K_i - σ) + (1 - sum t_i²) σ,   K_xi = -t_i (K_i - σ),   σ = w t_z/(1 + ε)   (N20)
    /// ```
    ///
    /// The second one is the row of the rotor, in the plane or in space.
    pub(crate) fn beginnings(
        &self,
        cable: &CableAtRest,
        rotor: Option<Rotor>,
    ) -> (Beginnings, Option<usize>) {
        let guide = cable.catenary.cable.guide;
        if guide.is_some_and(|guide| guide.radius == 0.0 && guide.lead > 0.0) {
            let start = rotor.map_or_else(Beginning::fixed, |rotor| rotor.start());
            let in_plane = self.behind_lead(cable, &start).0;
            // The first unknown is the exit point.
            return (Beginnings::Apart { in_plane, across: Beginning::fixed() }, rotor.map(|_| 1));
        }
        let mut begins = match guide {
            Some(guide) if guide.radius > 0.0 => self.on_pulley(cable),
            _ => Beginnings::Apart { in_plane: Beginning::fixed(), across: Beginning::fixed() },
        };
        let along = self.tension(0.0).normalize();
        let row = rotor.map(|rotor| match &mut begins {
            Beginnings::Apart { in_plane, .. } => self.fed_by(&rotor, along.into(), in_plane),
            Beginnings::Together(begins) => self.fed_by(&rotor, [along.x, 0.0, along.y], begins),
        });
        (begins, row)
    }

    /// Adds the rotor of a winch to a beginning with this direction of the cable, by (N20); its row.
    fn fed_by<const D: usize>(&self, rotor: &Rotor, along: [f64; D], beginning: &mut Beginning<D>) -> usize {
        let tension = self.tension(0.0);
        let stretch = 1.0 + self.free.cable.strain(tension.norm());
        let slid = self.free.cable.weight_per_length * tension.y / (tension.norm() * stretch);
        let row = beginning.directions.len();
        let Matrices { stiffness, mass } = &beginning.matrices;
        let [mut stiffness, mut mass] = [stiffness, mass].map(|of| of.clone().resize(row + 1, row + 1, 0.0));
        let (mut rest, mut own) = (along, rotor.stiffness);
        for (k, direction) in beginning.directions.iter().enumerate() {
            let part: f64 = along.iter().zip(direction).map(|(one, other)| one * other).sum();
            let pull = part * (stiffness[(k, k)] - slid);
            rest.iter_mut().zip(direction).for_each(|(rest, of)| *rest -= of * part);
            own += part * pull;
            (stiffness[(k, row)], stiffness[(row, k)]) = (-pull, -pull);
        }
        stiffness[(row, row)] = own + slid * rest.iter().map(|part| part * part).sum::<f64>();
        mass[(row, row)] = rotor.mass;
        beginning.matrices = Matrices { stiffness, mass };
        beginning.directions.push(rest);
        row
    }

    /// How the exit point moves in front of a lead that begins like that, and the stiffness of its stretch
    /// alone. The first unknown is the motion along the cable, then come those of the beginning of the lead.
    pub(crate) fn behind_lead(&self, cable: &CableAtRest, start: &Beginning<1>) -> (Beginning<2>, Matrices) {
        let tension = self.tension(0.0);
        let stretch = 1.0 + self.free.cable.strain(tension.norm());
        let modulus = self.free.cable.tangent_stiffness(tension.norm());
        let lead = cable.catenary.cable.guide.map_or(0.0, |guide| guide.lead);
        let bar = Element { ends: [0.0, lead / stretch], degree: MORE_DEGREES };
        let mut matrices = assemble(&[bar], start, cable.linear_density, |_| [[modulus]]);
        let stretched = Matrices { stiffness: matrices.stiffness.clone(), mass: 0.0 * &matrices.mass };
        let along = tension.normalize();
        matrices.stiffness[(0, 0)] += self.free.cable.weight_per_length * along.y / stretch;
        (Beginning { directions: vec![along.into()], matrices }, stretched)
    }

    fn on_pulley(&self, cable: &CableAtRest) -> Beginnings {
        let response = self.free.response();
        let ([xx, xz, zz], yy) = (response.flexibility, response.lateral_flexibility);
        let free = Matrix3::new(xx, 0.0, xz, 0.0, yy, 0.0, xz, 0.0, zz);
        let whole = cable.axes.transpose() * cable.end_stiffness * cable.axes;
        let rounding = ROUNDING * Matrix2::new(xx, xz, xz, zz).norm();
        if cable.catenary.cable.leaves_its_plane() {
            let whole = 0.5 * (whole + whole.transpose());
            let more = whole.try_inverse().map_or_else(Matrix3::zeros, |whole| whole - free);
            return Beginnings::Together(Beginning::yielding(more.into(), rounding));
        }
        let in_plane = Matrix2::new(whole.m11, whole.m13, whole.m13, whole.m33);
        let free = Matrix2::new(xx, xz, xz, zz);
        let more = in_plane.try_inverse().map_or_else(Matrix2::zeros, |whole| whole - free);
        Beginnings::Apart {
            in_plane: Beginning::yielding(more.into(), rounding),
            across: Beginning::yielding([[whole.m22.recip() - yy]], ROUNDING * yy),
        }
    }
}
