//! One cable of a platform at rest: its elements, its lead and pulley, and what the platform feels of it.

use crate::condensed::{Clamped, Condensed};
use crate::element::{Beginning, Element, Matrices, assemble};
use crate::error::DynamicsError;
use cdpr_cable::{Catenary, ElasticLaw};
use cdpr_statics::vibration::CableAtRest;
use cdpr_statics::{Matrix6, Vector3, Vector6};
use nalgebra::{Matrix2, Matrix3, Vector2};
use std::f64::consts::TAU;

/// Motions of the cable with its end held are kept up to this multiple of the highest frequency.
const KEPT: f64 = 2.0;

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

/// A cable with mass, seen from the platform. Motions are (dp, dφ) about P in the base frame.
#[derive(Clone, Debug)]
pub(crate) struct MovingCable {
    /// Mass of its static shapes [kg, kg m, kg m²].
    pub(crate) mass: Matrix6<f64>,
    /// Its natural motions with its end held, the slowest first.
    pub(crate) modes: Vec<HeldMode>,
    /// Fewer, which act as all of them do on motions up to the highest frequency.
    pub(crate) reduced: Vec<HeldMode>,
}

/// A natural motion of a cable whose end is held, of unit mass.
#[derive(Clone, Debug)]
pub(crate) struct HeldMode {
    /// ω_k² [1/s²].
    pub(crate) square: f64,
    /// How motions of the platform drive it [√kg, √kg m].
    pub(crate) coupling: Vector6<f64>,
}

impl MovingCable {
    /// Cable `i`, for frequencies up to `highest` [Hz].
    ///
    /// # Errors
    /// [`DynamicsError::Folded`] for a cable without tension at a point; [`DynamicsError::Invalid`] for a
    /// frequency at which it has too many half waves.
    pub(crate) fn new(i: usize, cable: &CableAtRest, highest: f64) -> Result<Self, DynamicsError> {
        if cable.linear_density == 0.0 {
            return Ok(Self { mass: Matrix6::zeros(), modes: Vec::new(), reduced: Vec::new() });
        }
        let free = Free { cable: i, free: cable.catenary.free() };
        let elements = free.elements(cable.linear_density, highest)?;
        let (in_plane, across) = free.beginnings(cable)?;
        let density = cable.linear_density;
        let in_plane = assemble(&elements, &in_plane, density, |s| free.modulus(s));
        let across = assemble(&elements, &across, density, |s| [[1.0 / free.slenderness(s)]]);
        let folded = || DynamicsError::Folded { cable: i };
        let in_plane = Condensed::<2>::new(&in_plane).ok_or_else(folded)?;
        let across = Condensed::<1>::new(&across).ok_or_else(folded)?;
        let square = (KEPT * TAU * highest).powi(2);
        Ok(Self::on_platform(cable, (&in_plane, &across), square))
    }

    fn on_platform(
        cable: &CableAtRest,
        (in_plane, across): (&Condensed<2>, &Condensed<1>),
        square: f64,
    ) -> Self {
        let [[xx, xz], [_, zz]] = in_plane.mass;
        let [[yy]] = across.mass;
        let mass = Matrix3::new(xx, 0.0, xz, 0.0, yy, 0.0, xz, 0.0, zz);
        let mass = cable.axes * mass * cable.axes.transpose();
        let lever = cable.lever.cross_matrix();
        let mut on_platform = Matrix6::zeros();
        on_platform.fixed_view_mut::<3, 3>(0, 0).copy_from(&mass);
        on_platform.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-mass * lever));
        on_platform.fixed_view_mut::<3, 3>(3, 0).copy_from(&(lever * mass));
        on_platform.fixed_view_mut::<3, 3>(3, 3).copy_from(&(-lever * mass * lever));
        let mode = |square: f64, local: Vector3<f64>| {
            let force = cable.axes * local;
            let moment = cable.lever.cross(&force);
            let coupling = Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
            HeldMode { square, coupling }
        };
        let all = |in_plane: &[Clamped<2>], across: &[Clamped<1>]| {
            let in_plane = in_plane
                .iter()
                .map(|Clamped { square, coupling: [x, z] }| mode(*square, Vector3::new(*x, 0.0, *z)));
            let across = across
                .iter()
                .map(|Clamped { square, coupling: [y] }| mode(*square, Vector3::new(0.0, *y, 0.0)));
            let mut modes: Vec<_> = in_plane.chain(across).collect();
            modes.sort_by(|one, other| one.square.total_cmp(&other.square));
            modes
        };
        let reduced = all(&in_plane.reduced(square), &across.reduced(square));
        Self { mass: on_platform, modes: all(&in_plane.modes, &across.modes), reduced }
    }

    /// The number of motions with the end held that are slower than `square` = ω² [1/s²].
    pub(crate) fn slower(&self, square: f64) -> usize {
        self.modes.partition_point(|mode| mode.square < square)
    }
}

/// The free part of a cable, beyond its exit or leave point.
struct Free<'a> {
    cable: usize,
    free: Catenary<'a>,
}

impl Free<'_> {
    /// Tension vector (along the plane, upwards) at an unstrained length from the exit [N].
    fn tension(&self, s: f64) -> Vector2<f64> {
        let Catenary { cable, unstrained_length, force } = &self.free;
        Vector2::new(force.x, force.y - cable.weight_per_length * (unstrained_length - s))
    }

    /// (1 + ε)/N [1/N].
    fn slenderness(&self, s: f64) -> f64 {
        let tension = self.tension(s).norm();
        (1.0 + self.free.cable.strain(tension)) / tension
    }

    /// A of (N2) in the plane [N].
    fn modulus(&self, s: f64) -> [[f64; 2]; 2] {
        let tension = self.tension(s);
        let along = self.free.cable.tangent_stiffness(tension.norm());
        let across = self.slenderness(s).recip();
        let t = tension.normalize();
        let modulus = Matrix2::identity() * across + t * t.transpose() * (along - across);
        [[modulus[(0, 0)], modulus[(0, 1)]], [modulus[(1, 0)], modulus[(1, 1)]]]
    }

    /// Elements that end where the law of the cable has a kink, and that are short where it turns.
    fn elements(&self, density: f64, highest: f64) -> Result<Vec<Element>, DynamicsError> {
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
    fn beginnings(&self, cable: &CableAtRest) -> Result<(Beginning<2>, Beginning<1>), DynamicsError> {
        let Some(guide) = cable.catenary.cable.guide else {
            return Ok((Beginning::fixed(), Beginning::fixed()));
        };
        if guide.radius > 0.0 {
            return Ok(self.on_pulley(cable));
        }
        if guide.lead == 0.0 {
            return Ok((Beginning::fixed(), Beginning::fixed()));
        }
        let tension = self.tension(0.0);
        let stretch = 1.0 + self.free.cable.strain(tension.norm());
        let modulus = self.free.cable.tangent_stiffness(tension.norm());
        let bar = Element { ends: [0.0, guide.lead / stretch], degree: MORE_DEGREES };
        let mut matrices = assemble(&[bar], &Beginning::<1>::fixed(), cable.linear_density, |_| [[modulus]]);
        let along = tension.normalize();
        matrices.stiffness[(0, 0)] += self.free.cable.weight_per_length * along.y / stretch;
        Ok((Beginning { directions: vec![along.into()], matrices }, Beginning::fixed()))
    }

    fn on_pulley(&self, cable: &CableAtRest) -> (Beginning<2>, Beginning<1>) {
        let response = self.free.response();
        let [xx, xz, zz] = response.flexibility;
        let free = Matrix2::new(xx, xz, xz, zz);
        let whole = cable.axes.transpose() * cable.end_stiffness * cable.axes;
        let in_plane = Matrix2::new(whole.m11, whole.m13, whole.m13, whole.m33);
        let rounding = ROUNDING * free.norm();
        let more = in_plane.try_inverse().map_or_else(Matrix2::zeros, |whole| whole - free).symmetric_eigen();
        let soft: Vec<_> = (0..2).filter(|k| more.eigenvalues[*k] > rounding).collect();
        let mut matrices = Matrices::zeros(soft.len());
        for (row, k) in soft.iter().enumerate() {
            matrices.stiffness[(row, row)] = more.eigenvalues[*k].recip();
        }
        let directions = soft.iter().map(|k| more.eigenvectors.column(*k).into_owned().into()).collect();
        let across = whole.m22.recip() - response.lateral_flexibility;
        let mut beside = Beginning::fixed();
        if across > ROUNDING * response.lateral_flexibility {
            beside = Beginning { directions: vec![[1.0]], matrices: Matrices::zeros(1) };
            beside.matrices.stiffness[(0, 0)] = across.recip();
        }
        (Beginning { directions, matrices }, beside)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use cdpr_cable::Cable;
    use serde_json::Value;

    fn number(value: &Value) -> f64 {
        value.as_f64().unwrap()
    }

    /// K_dyn of the end of a cable at a frequency [Hz], (N4).
    fn dynamic_stiffness(cable: &CableAtRest, moving: &MovingCable, frequency: f64) -> Matrix3<f64> {
        let square = (TAU * frequency).powi(2);
        let mass: Matrix3<f64> = moving.mass.fixed_view::<3, 3>(0, 0).into();
        moving.modes.iter().fold(cable.end_stiffness - mass * square, |sum, mode| {
            let coupling: Vector3<f64> = mode.coupling.fixed_rows::<3>(0).into();
            sum - coupling * coupling.transpose() * (square * square / (mode.square - square))
        })
    }

    #[test]
    fn single_cables_answer_as_transfer_matrices_do_and_vibrate_as_often() {
        let file: Value = serde_json::from_str(include_str!("../../../data/reference/motion.json")).unwrap();
        let (mut stiffnesses, mut frequencies) = (0, 0);
        for case in file["cables"].as_array().unwrap() {
            let density = number(&case["linear_density"]);
            let catenary = Catenary {
                cable: Cable::linear(density * number(&case["gravity"]), number(&case["axial_stiffness"])),
                unstrained_length: number(&case["unstrained_length"]),
                force: Vector2::new(number(&case["end_force_x"]), number(&case["end_force_z"])),
            };
            let cable = CableAtRest {
                lever: Vector3::zeros(),
                axes: Matrix3::identity(),
                catenary,
                linear_density: density,
                end_stiffness: catenary.stiffness(Vector2::x()),
                stiffness: Matrix6::zeros(),
            };
            let expected: Vec<f64> = case["frequencies_hz"].as_array().unwrap().iter().map(number).collect();
            let at = case["dynamic_stiffness"].as_array().map_or(&[][..], Vec::as_slice);
            let all = at.iter().map(|at| number(&at["frequency_hz"])).chain(expected.iter().copied());
            let moving = MovingCable::new(0, &cable, 1.25 * all.fold(0.0, f64::max)).unwrap();
            for (mode, expected) in moving.modes.iter().zip(&expected) {
                let found = mode.square.sqrt() / TAU;
                assert!((found / expected - 1.0).abs() < 1e-8, "{}: {found} {expected}", case["name"]);
                frequencies += 1;
            }
            for at in at {
                let found = dynamic_stiffness(&cable, &moving, number(&at["frequency_hz"]));
                let expected = Matrix3::from_fn(|i, j| number(&at["matrix_6x6"][3 + i][3 + j]));
                let error = (found - expected).norm() / expected.norm();
                assert!(error < 1e-8, "{} at {}: {error:e}", case["name"], at["frequency_hz"]);
                stiffnesses += 1;
            }
        }
        assert!(frequencies > 100 && stiffnesses > 10, "{frequencies} {stiffnesses}");
    }
}
