//! How platform and cables answer to forces and winches that vibrate.
//!
//! A force `f sin ωt` on the platform, or a winch that takes in `δ sin ωt`, moves the platform by
//!
//! ```text
//! v = H (f - sum Jᵀ F_i δ_i),      H = D⁻¹,      J = [ 1, -[s_i] ]                                 (N12)
//! ```
//!
//! with the dynamic stiffness D of the platform and the force F_i on the held end of cable i by its winch.
//! Where the cable begins, the winch moves it by `-(1 + ε) t` for each metre. With damping
//!
//! ```text
//! A = EA (1 + i ω τ) t tᵀ + (1 - t tᵀ) N/(1 + ε),      -ω² μ  becomes  -ω² μ + i ω μ c             (N13)
//! ```
//!
//! (Kelvin and Voigt's in the stretch of the cable, and a drag of air along its motion), all is complex:
//! amplitude and phase. The cables are the polynomials of (N3), of which only the ends are kept at every
//! frequency.

pub(crate) mod band;

use crate::cable::Parts;
use crate::element::{Beginning, Matrices, assemble};
use crate::error::{DynamicsError, positive};
use crate::free::Free;
use cdpr_statics::vibration::{CableAtRest, SmallMotions};
use cdpr_statics::{DMatrix, DirectProblem, Equilibrium, Matrix6, Vector3};
use nalgebra::{Complex, Matrix3, Matrix3xX, Matrix6xX};
use std::f64::consts::TAU;

/// Next to a resonance errors of the polynomials grow: they are made for frequencies higher by this factor.
const MARGIN: f64 = 1.25;

/// What damps the cables. By default nothing does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Damping {
    /// τ of (N13) [s]: a cable that is stretched at a rate dε/dt bears EA τ dε/dt more.
    pub stretch: f64,
    /// c of (N13) [1/s]: a force of c μ for each m/s on a metre of cable.
    pub drag: f64,
}

/// A platform on cables with mass that is shaken.
#[derive(Clone, Debug)]
pub struct FrequencyResponse {
    damping: Damping,
    highest: f64,
    mass: Matrix6<f64>,
    /// Without what the ends of the cables resist with.
    stiffness: Matrix6<f64>,
    free: Vec<usize>,
    cables: Vec<Option<ShakenCable>>,
}

/// The answer at a frequency. Motions are complex amplitudes of (dp, dφ) about P in the base frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// The frequency [Hz].
    pub frequency: f64,
    /// Motion per wrench about P, H of (N12) [m/N, rad/N, m/(N m), rad/(N m)].
    pub per_wrench: Matrix6<Complex<f64>>,
    /// Motion per length that each winch takes in, 6 x n [m/m, rad/m].
    pub per_shortening: Matrix6xX<Complex<f64>>,
}

impl Response {
    /// Translation of a point of the platform per force there [m/N], and per length that each winch takes in,
    /// 3 x n; `lever` from P in the base frame [m].
    pub fn at_point(&self, lever: &Vector3<f64>) -> (Matrix3<Complex<f64>>, Matrix3xX<Complex<f64>>) {
        let mut motion = nalgebra::Matrix3x6::<Complex<f64>>::zeros();
        motion.fixed_view_mut::<3, 3>(0, 0).copy_from(&Matrix3::identity().map(real));
        motion.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-lever.cross_matrix()).map(real));
        (motion * self.per_wrench * motion.transpose(), motion * &self.per_shortening)
    }
}

/// A cable whose ends are shaken.
#[derive(Clone, Debug)]
struct ShakenCable {
    axes: Matrix3<f64>,
    lever: Vector3<f64>,
    in_plane: Shaken,
    across: Shaken,
}

/// Unknowns of a cable in its plane or across it.
#[derive(Clone, Debug)]
struct Shaken {
    stiffness: DMatrix<f64>,
    /// The part of the stiffness that damps.
    damped: DMatrix<f64>,
    mass: DMatrix<f64>,
    winch: Winch,
}

/// Stiffness of the end of a cable [N/m], and the force on its held end per length that its winch takes in
/// [N/m].
type StiffnessAndPull = (Matrix3<Complex<f64>>, nalgebra::Vector3<Complex<f64>>);

/// Dynamic stiffness of all cables at the platform, and the pulls of their winches.
type CablesAndPulls = (Matrix6<Complex<f64>>, Matrix6xX<Complex<f64>>);

/// What a winch does to the unknowns of a cable, per length that it takes in.
#[derive(Clone, Debug, Default)]
struct Winch {
    /// The unknown that it moves, and how far.
    moved: Option<(usize, f64)>,
    /// Unknowns that it pulls at through the compliance of a pulley, and the force [N/m].
    pulled: Vec<(usize, f64)>,
}

fn real(value: f64) -> Complex<f64> {
    Complex::new(value, 0.0)
}

impl FrequencyResponse {
    /// For frequencies up to `highest` [Hz].
    ///
    /// # Errors
    /// As [`crate::MovingPlatform::new`]; [`DynamicsError::Invalid`] for damping that is negative or not
    /// finite.
    pub fn new(
        problem: &DirectProblem,
        equilibrium: &Equilibrium,
        highest: f64,
        damping: Damping,
    ) -> Result<Self, DynamicsError> {
        positive("highest frequency", highest, "a frequency [Hz] above zero")?;
        for (field, value, unit) in [("damping", damping.stretch, "s"), ("drag", damping.drag, "1/s")] {
            if !(value.is_finite() && value >= 0.0) {
                let expected = format!("zero or more [{unit}]");
                return Err(DynamicsError::Invalid { field, value: format!("{value:?}"), expected });
            }
        }
        let SmallMotions { mass, weight, cables, free } = problem.small_motions(equilibrium)?;
        let mut stiffness = cables.iter().fold(weight, |sum, cable| sum + cable.stiffness);
        for cable in &cables {
            stiffness -= on_platform(&cable.lever, &cable.end_stiffness);
        }
        let shaken = |(i, cable): (usize, &CableAtRest)| {
            // A cable without mass and force resists nothing.
            let is_shapeless = cable.linear_density == 0.0 && cable.catenary.is_slack_and_weightless();
            (!is_shapeless).then(|| ShakenCable::new(i, cable, highest)).transpose()
        };
        let cables = cables.iter().enumerate().map(shaken).collect::<Result<_, _>>()?;
        Ok(Self { damping, highest, mass, stiffness, free, cables })
    }

    /// The answer at a frequency [Hz].
    ///
    /// # Errors
    /// [`DynamicsError::Invalid`] for one that is not between zero and the highest;
    /// [`DynamicsError::Resonance`] where nothing damps and the frequency is a natural one.
    pub fn at(&self, frequency: f64) -> Result<Response, DynamicsError> {
        if !(frequency.is_finite() && (0.0..=self.highest).contains(&frequency)) {
            let expected = format!("from 0 to {} Hz", self.highest);
            return Err(DynamicsError::Invalid {
                field: "frequency",
                value: format!("{frequency:?} Hz"),
                expected,
            });
        }
        let resonance = || DynamicsError::Resonance { frequency };
        let omega = TAU * frequency;
        let (cables, pulls) = self.of_cables(frequency)?;
        let dynamic = (self.stiffness - self.mass * (omega * omega)).map(real) + cables;
        let free = &self.free;
        let block = DMatrix::from_fn(free.len(), free.len(), |i, j| dynamic[(free[i], free[j])]);
        let inverse = block.try_inverse().ok_or_else(resonance)?;
        let mut per_wrench = Matrix6::zeros();
        for (i, row) in free.iter().enumerate() {
            free.iter().enumerate().for_each(|(j, column)| per_wrench[(*row, *column)] = inverse[(i, j)]);
        }
        if per_wrench.iter().any(|value| !(value.re.is_finite() && value.im.is_finite())) {
            return Err(resonance());
        }
        let per_shortening = -(per_wrench * pulls);
        Ok(Response { frequency, per_wrench, per_shortening })
    }
}

impl FrequencyResponse {
    /// What the cables add to the dynamic stiffness of the platform, and the wrench on the held platform for
    /// each length that a winch takes in, 6 x n [N/m, N].
    pub(crate) fn of_cables(&self, frequency: f64) -> Result<CablesAndPulls, DynamicsError> {
        let omega = TAU * frequency;
        let mut dynamic = Matrix6::zeros();
        let mut pulls = Matrix6xX::zeros(self.cables.len());
        for (i, cable) in self.cables.iter().enumerate() {
            let Some(cable) = cable else { continue };
            let found = cable.at(omega, &self.damping);
            let (stiffness, pull) = found.ok_or(DynamicsError::Resonance { frequency })?;
            dynamic += on_platform(&cable.lever.map(real), &stiffness);
            let moment = cable.lever.map(real).cross(&pull);
            pulls.fixed_view_mut::<3, 1>(0, i).copy_from(&pull);
            pulls.fixed_view_mut::<3, 1>(3, i).copy_from(&moment);
        }
        Ok((dynamic, pulls))
    }
}

/// Jᵀ K J.
fn on_platform<T: nalgebra::ComplexField>(
    lever: &nalgebra::Vector3<T>,
    stiffness: &Matrix3<T>,
) -> Matrix6<T> {
    let mut motion = nalgebra::Matrix3x6::<T>::zeros();
    motion.fixed_view_mut::<3, 3>(0, 0).copy_from(&Matrix3::identity());
    let [x, y, z] = [lever[0].clone(), lever[1].clone(), lever[2].clone()];
    let o = T::zero();
    let cross = Matrix3::new(o.clone(), -z.clone(), y.clone(), z, o.clone(), -x.clone(), -y, x, o);
    motion.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-cross));
    motion.transpose() * stiffness * motion
}

impl ShakenCable {
    fn new(i: usize, cable: &CableAtRest, highest: f64) -> Result<Self, DynamicsError> {
        let free = Free { cable: i, free: cable.catenary.free() };
        // Checks that it hangs nowhere without tension.
        let Parts { elements, across, .. } = Parts::new(i, cable, MARGIN * highest)?;
        let (beginning, damped, winch) = driven(&free, cable)?;
        let density = cable.linear_density;
        let matrices = assemble(&elements, &beginning, density, |s| free.modulus(s));
        let stretched = |s: f64| {
            let tension = free.tension(s);
            let (t, modulus) = (tension.normalize(), free.free.cable.tangent_stiffness(tension.norm()));
            [[modulus * t.x * t.x, modulus * t.x * t.y], [modulus * t.x * t.y, modulus * t.y * t.y]]
        };
        let damping = Beginning { matrices: damped, directions: beginning.directions.clone() };
        let damped = assemble(&elements, &damping, 0.0, stretched).stiffness;
        let in_plane = Shaken { stiffness: matrices.stiffness, damped, mass: matrices.mass, winch };
        let matrices = assemble(&elements, &across.beginning, density, |s| [[1.0 / free.slenderness(s)]]);
        let damped = DMatrix::zeros(matrices.stiffness.nrows(), matrices.stiffness.nrows());
        let winch = Winch::default();
        let across = Shaken { stiffness: matrices.stiffness, damped, mass: matrices.mass, winch };
        Ok(Self { axes: cable.axes, lever: cable.lever, in_plane, across })
    }

    /// Stiffness of its end, and the force on its held end by its winch, in the base frame.
    fn at(&self, omega: f64, damping: &Damping) -> Option<StiffnessAndPull> {
        let (in_plane, winch) = self.in_plane.at::<2>(omega, damping)?;
        let (across, _) = self.across.at::<1>(omega, damping)?;
        let o = real(0.0);
        let [[xx, xz], [zx, zz]] = in_plane;
        let local = Matrix3::new(xx, o, xz, o, across[0][0], o, zx, o, zz);
        let axes = self.axes.map(real);
        Some((axes * local * axes.transpose(), axes * nalgebra::Vector3::new(winch[0], o, winch[1])))
    }
}

impl Shaken {
    /// Stiffness of the end, and the force on the held end by the winch.
    #[allow(clippy::type_complexity)]
    fn at<const D: usize>(
        &self,
        omega: f64,
        damping: &Damping,
    ) -> Option<([[Complex<f64>; D]; D], [Complex<f64>; D])> {
        let inertia = Complex::new(-omega * omega, omega * damping.drag);
        let value = |i: usize, j: usize| {
            Complex::new(self.stiffness[(i, j)], omega * damping.stretch * self.damped[(i, j)])
                + inertia * self.mass[(i, j)]
        };
        let moved = self.winch.moved;
        let size = self.stiffness.nrows();
        let inside: Vec<usize> = (D..size).filter(|i| moved.is_none_or(|(winch, _)| winch != *i)).collect();
        let matrix = DMatrix::from_fn(inside.len(), inside.len(), |i, j| value(inside[i], inside[j]));
        // Columns: motions of the end, then the winch.
        let mut right = DMatrix::from_fn(inside.len(), D + 1, |i, j| match (j < D, moved) {
            (true, _) => -value(inside[i], j),
            (false, Some((winch, far))) => -value(inside[i], winch) * far,
            (false, None) => real(0.0),
        });
        for (unknown, force) in &self.winch.pulled {
            if let Some(i) = inside.iter().position(|i| i == unknown) {
                right[(i, D)] += real(*force);
            }
        }
        let shapes = matrix.lu().solve(&right)?;
        let force = |k: usize, j: usize| -> Complex<f64> {
            inside.iter().enumerate().map(|(i, unknown)| value(k, *unknown) * shapes[(i, j)]).sum()
        };
        let by_winch = |k: usize| moved.map_or(real(0.0), |(winch, far)| value(k, winch) * far) + force(k, D);
        Some((
            std::array::from_fn(|k| std::array::from_fn(|j| value(k, j) + force(k, j))),
            std::array::from_fn(by_winch),
        ))
    }
}

/// Where a cable begins with a winch that moves it: its unknowns, their part that damps, and the winch.
fn driven(free: &Free, cable: &CableAtRest) -> Result<(Beginning<2>, Matrices, Winch), DynamicsError> {
    let tension = free.tension(0.0);
    let (along, stretch) = (tension.normalize(), 1.0 + free.free.cable.strain(tension.norm()));
    let guide = cable.catenary.cable.guide;
    if guide.is_some_and(|guide| guide.radius == 0.0 && guide.lead > 0.0) {
        let start = Beginning { directions: vec![[1.0]], matrices: Matrices::zeros(1) };
        let (beginning, damped) = free.behind_lead(cable, &start);
        // The first unknown is the exit point, the second one the winch.
        return Ok((beginning, damped, Winch { moved: Some((2 + 1, -stretch)), pulled: Vec::new() }));
    }
    let (mut beginning, _) = free.beginnings(cable)?;
    let soft = beginning.directions.len();
    let mut winch = Winch::default();
    let mut rest = along;
    // Where cable slides upwards, the tension behind it is smaller by its weight, as in (N7).
    let slid = free.free.cable.weight_per_length * along.y;
    for (k, [x, z]) in beginning.directions.iter().enumerate() {
        let part = along.x * x + along.y * z;
        rest -= nalgebra::Vector2::new(*x, *z) * part;
        winch.pulled.push((2 + k, part * (slid - stretch * beginning.matrices.stiffness[(k, k)])));
    }
    /// Part of the direction below which a pulley yields along all of it.
    const ROUNDING: f64 = 1e-9;
    if rest.norm() > ROUNDING {
        beginning.directions.push(rest.normalize().into());
        let Matrices { stiffness, mass } = beginning.matrices;
        let [stiffness, mass] = [stiffness, mass].map(|matrix| matrix.resize(soft + 1, soft + 1, 0.0));
        beginning.matrices = Matrices { stiffness, mass };
        winch.moved = Some((2 + soft, -stretch * rest.norm()));
    }
    let damped = Matrices::zeros(beginning.matrices.stiffness.nrows());
    Ok((beginning, damped, winch))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::cable::tests::of_reference;
    use serde_json::Value;

    #[test]
    fn cables_shaken_at_both_ends_answer_as_transfer_matrices_do() {
        let file: Value = serde_json::from_str(include_str!("../../../data/reference/motion.json")).unwrap();
        let number = |value: &Value| value.as_f64().unwrap();
        let mut compared = 0;
        for case in file["cables"].as_array().unwrap() {
            let Some(references) = case["dynamic_stiffness"].as_array() else { continue };
            let cable = of_reference(case);
            let catenary = cable.catenary;
            let highest = references.iter().map(|at| number(&at["frequency_hz"])).fold(0.1, f64::max);
            let shaken = ShakenCable::new(0, &cable, highest).unwrap();
            let free = Free { cable: 0, free: catenary };
            let tension = free.tension(0.0);
            let winch = -tension.normalize() * (1.0 + catenary.cable.strain(tension.norm()));
            for reference in references {
                let omega = TAU * number(&reference["frequency_hz"]);
                let (stiffness, pull) = shaken.at(omega, &Damping::default()).unwrap();
                let of = |i: usize, j: usize| number(&reference["matrix_6x6"][3 + i][j]);
                let expected = Matrix3::from_fn(|i, j| of(i, 3 + j));
                let error = (stiffness.map(|value| value.re) - expected).norm() / expected.norm();
                let by_winch = Vector3::from_fn(|i, _| of(i, 0) * winch.x + of(i, 2) * winch.y);
                let off = (pull.map(|value| value.re) - by_winch).norm() / expected.norm();
                assert!(error < 1e-8 && off < 1e-8, "{}: {error:e} {off:e}", case["name"]);
                compared += 1;
            }
        }
        assert!(compared > 10, "{compared}");
    }
}
