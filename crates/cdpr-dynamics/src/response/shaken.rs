//! A cable whose winch and whose anchor point are shaken, and what damps it, (N13).

use crate::cable::{Motions, MovingCable, Parts};
use crate::element::{Beginning, Element, Matrices, assemble};
use crate::energy::{Number, Vector, Vibrating, real};
use crate::error::DynamicsError;
use crate::free::Free;
use cdpr_cable::SpatialCable;
use cdpr_statics::vibration::CableAtRest;
use cdpr_statics::{DMatrix, Matrix6, Vector3};
use nalgebra::{Complex, Matrix3};

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

impl Damping {
    /// Damping where none is given: of the stretch alone.
    pub const USUAL: Self = Self { stretch: 2e-4, drag: 0.0 };
}

/// A cable whose ends are shaken.
#[derive(Clone, Debug)]
pub(super) struct ShakenCable {
    axes: Matrix3<f64>,
    pub(super) lever: Vector3<f64>,
    /// Stiffness of its end at 0 Hz as the polynomials say [N/m].
    pub(super) still: Matrix3<f64>,
    /// By how much the pull of its winch at 0 Hz exceeds that of the polynomials [N/m].
    pub(super) more_pull: Vector3<f64>,
    /// Mass of its static shapes, seen from the platform [kg, kg m, kg m²].
    pub(super) static_mass: Matrix6<f64>,
    elements: Vec<Element>,
    motions: ShakenMotions,
}

/// Those in the plane of a cable and across it, which a wheel with a tilted axis couples.
// Each is moved once, where it is made.
#[derive(Clone, Debug)]
#[allow(clippy::large_enum_variant)]
enum ShakenMotions {
    Apart { in_plane: Shaken<2>, across: Shaken<1> },
    Together(Shaken<3>),
}

/// Unknowns of a cable in its plane, across it, or in both.
#[derive(Clone, Debug)]
struct Shaken<const D: usize> {
    beginning: Beginning<D>,
    stiffness: DMatrix<f64>,
    /// The part of the stiffness that damps.
    damped: DMatrix<f64>,
    mass: DMatrix<f64>,
    winch: Winch,
}

/// Stiffness of the end of a cable [N/m], and the force on its held end per length that its winch takes in
/// [N/m].
pub(crate) type StiffnessAndPull = (Matrix3<Number>, Vector);

/// What a winch does to the unknowns of a cable, per length that it takes in.
#[derive(Clone, Debug, Default)]
struct Winch {
    /// The unknown that it moves, and how far.
    moved: Option<(usize, f64)>,
    /// Unknowns that it pulls at through the compliance of a pulley, and the force [N/m].
    pulled: Vec<(usize, f64)>,
}

impl ShakenCable {
    pub(super) fn new(i: usize, cable: &CableAtRest, highest: f64) -> Result<Self, DynamicsError> {
        let free = Free { cable: i, free: cable.catenary.free() };
        // Checks that it hangs nowhere without tension.
        let parts = Parts::new(i, cable, MARGIN * highest, None)?;
        let static_mass = MovingCable::mass(cable, &parts);
        let Parts { elements, motions, .. } = parts;
        let density = cable.linear_density;
        let motions = match motions {
            Motions::Apart { in_plane, across } => {
                let driven = driven(&free, cable, in_plane.beginning);
                let in_plane = Shaken::new(&elements, driven, density, |s| {
                    let tension = free.tension(s);
                    [free.modulus(s), stretched(&free, s, tension.into())]
                });
                let still = (across.beginning, Winch::default());
                let across = Shaken::new(&elements, undamped(still), density, |s| {
                    [[[1.0 / free.slenderness(s)]], [[0.0]]]
                });
                ShakenMotions::Apart { in_plane, across }
            }
            Motions::Together(part) => {
                let along = |s: f64| {
                    let tension = free.tension(s);
                    [tension.x, 0.0, tension.y]
                };
                let driven = undamped(on_wheel(&free, part.beginning, along(0.0)));
                ShakenMotions::Together(Shaken::new(&elements, driven, density, |s| {
                    [free.modulus_in_space(s), stretched(&free, s, along(s))]
                }))
            }
        };
        let (still, more_pull) = (Matrix3::zeros(), Vector3::zeros());
        let (axes, lever) = (cable.axes, cable.lever);
        let found = Self { axes, lever, still, more_pull, static_mass, elements, motions };
        let at_rest = found.at(0.0, &Damping::default()).ok_or(DynamicsError::Folded { cable: i })?;
        let still = at_rest.0.map(|value| value.re);
        let more_pull = static_pull(cable)
            .map_or_else(Vector3::zeros, |pull| axes * pull - at_rest.1.map(|value| value.re));
        Ok(Self { still, more_pull, ..found })
    }

    /// Stiffness of its end, and the force on its held end by its winch, in the base frame.
    pub(super) fn at(&self, omega: f64, damping: &Damping) -> Option<StiffnessAndPull> {
        let o = real(0.0);
        let (local, winch) = match &self.motions {
            ShakenMotions::Apart { in_plane, across } => {
                let ([[xx, xz], [zx, zz]], [x, z]) = in_plane.at(omega, damping)?;
                let ([[yy]], _) = across.at(omega, damping)?;
                (Matrix3::new(xx, o, xz, o, yy, o, zx, o, zz), Vector::new(x, o, z))
            }
            ShakenMotions::Together(all) => {
                let (local, winch) = all.at(omega, damping)?;
                (Matrix3::from_fn(|i, j| local[i][j]), winch.into())
            }
        };
        let axes = self.axes.map(real);
        Some((axes * local * axes.transpose(), axes * winch))
    }

    /// How cable `number` vibrates while its winch holds and its end moves by `end`; none over a wheel with a
    /// tilted axis.
    pub(super) fn vibrating<'a>(
        &'a self,
        (number, at_rest): (usize, &'a CableAtRest<'a>),
        end: &Vector,
        omega: f64,
        damping: &Damping,
    ) -> Option<Vibrating<'a>> {
        let ShakenMotions::Apart { in_plane, across } = &self.motions else { return None };
        let end = self.axes.map(real).tr_mul(end);
        Some(Vibrating {
            number,
            at_rest,
            elements: &self.elements,
            in_plane: (&in_plane.beginning, in_plane.unknowns([end.x, end.z], omega, damping)?),
            across: (&across.beginning, across.unknowns([end.y], omega, damping)?),
            square: Complex::new(omega * omega, -omega * damping.drag),
            viscous: Complex::new(0.0, omega * damping.stretch),
        })
    }
}

impl<const D: usize> Shaken<D> {
    /// From how it begins, the part of that which damps, and its winch; with A at an unstrained length and the
    /// part of it that damps [N].
    fn new(
        elements: &[Element],
        (beginning, damped, winch): Driven<D>,
        density: f64,
        modulus: impl Fn(f64) -> [[[f64; D]; D]; 2],
    ) -> Self {
        let Matrices { stiffness, mass } = assemble(elements, &beginning, density, |s| modulus(s)[0]);
        let damping = Beginning { matrices: damped, directions: beginning.directions.clone() };
        let damped = assemble(elements, &damping, 0.0, |s| modulus(s)[1]).stiffness;
        Self { beginning, stiffness, damped, mass, winch }
    }

    /// Its dynamic stiffness.
    fn value(&self, i: usize, j: usize, omega: f64, damping: &Damping) -> Number {
        Complex::new(self.stiffness[(i, j)], omega * damping.stretch * self.damped[(i, j)])
            + Complex::new(-omega * omega, omega * damping.drag) * self.mass[(i, j)]
    }

    /// The unknowns for unit motions of the end, and in the last column for the winch.
    fn shapes(&self, omega: f64, damping: &Damping) -> Option<DMatrix<Number>> {
        let value = |i: usize, j: usize| self.value(i, j, omega, damping);
        let (moved, size) = (self.winch.moved, self.stiffness.nrows());
        let mut shapes = DMatrix::zeros(size, D + 1);
        (0..D).for_each(|k| shapes[(k, k)] = real(1.0));
        moved.iter().for_each(|(winch, far)| shapes[(*winch, D)] = real(*far));
        let inside: Vec<usize> = (D..size).filter(|i| moved.is_none_or(|(winch, _)| winch != *i)).collect();
        let matrix = DMatrix::from_fn(inside.len(), inside.len(), |i, j| value(inside[i], inside[j]));
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
        let found = matrix.lu().solve(&right)?;
        inside.iter().enumerate().for_each(|(i, unknown)| shapes.set_row(*unknown, &found.row(i)));
        Some(shapes)
    }

    /// Stiffness of the end, and the force on the held end by the winch.
    #[allow(clippy::type_complexity)]
    fn at(&self, omega: f64, damping: &Damping) -> Option<([[Number; D]; D], [Number; D])> {
        let shapes = self.shapes(omega, damping)?;
        let force = |k: usize, j: usize| -> Number {
            (0..shapes.nrows()).map(|i| self.value(k, i, omega, damping) * shapes[(i, j)]).sum()
        };
        let stiffness = std::array::from_fn(|k| std::array::from_fn(|j| force(k, j)));
        Some((stiffness, std::array::from_fn(|k| force(k, D))))
    }

    /// The unknowns for a motion of the end.
    fn unknowns(&self, end: [Number; D], omega: f64, damping: &Damping) -> Option<Vec<Number>> {
        let shapes = self.shapes(omega, damping)?;
        let of = |i: usize| end.iter().enumerate().map(|(j, end)| shapes[(i, j)] * end).sum();
        Some((0..shapes.nrows()).map(of).collect())
    }
}

/// Force on the held end of a cable over a pulley per length that its winch takes in slowly, along its axes
/// [N/m].
fn static_pull(cable: &CableAtRest) -> Option<Vector3<f64>> {
    let of = &cable.catenary;
    of.cable.guide.filter(|guide| guide.radius > 0.0)?;
    let force = Vector3::new(of.force.x, 0.0, of.force.y);
    let response =
        SpatialCable { cable: of.cable, unstrained_length: of.unstrained_length, force }.response();
    let pull = response.flexibility.try_inverse()? * response.end_per_length;
    pull.iter().all(|part| part.is_finite()).then_some(pull)
}

/// Where a cable begins with a winch that moves it: its unknowns, their part that damps, and the winch.
type Driven<const D: usize> = (Beginning<D>, Matrices, Winch);

/// A cable in its plane, which begins like that on a winch that holds.
fn driven(free: &Free, cable: &CableAtRest, held: Beginning<2>) -> Driven<2> {
    let tension = free.tension(0.0);
    let guide = cable.catenary.cable.guide;
    if guide.is_some_and(|guide| guide.radius == 0.0 && guide.lead > 0.0) {
        let start = Beginning { directions: vec![[1.0]], matrices: Matrices::zeros(1) };
        let (beginning, damped) = free.behind_lead(cable, &start);
        let stretch = 1.0 + free.free.cable.strain(tension.norm());
        // The first unknown is the exit point, the second one the winch.
        return (beginning, damped, Winch { moved: Some((2 + 1, -stretch)), pulled: Vec::new() });
    }
    undamped(on_wheel(free, held, tension.into()))
}

fn undamped<const D: usize>((beginning, winch): (Beginning<D>, Winch)) -> Driven<D> {
    let damped = Matrices::zeros(beginning.matrices.stiffness.nrows());
    (beginning, damped, winch)
}

/// A cable that begins at a point or a wheel, with its tension there, and its winch.
fn on_wheel<const D: usize>(
    free: &Free,
    mut beginning: Beginning<D>,
    tension: [f64; D],
) -> (Beginning<D>, Winch) {
    let size = norm(tension);
    let (along, stretch) = (tension.map(|part| part / size), 1.0 + free.free.cable.strain(size));
    let soft = beginning.directions.len();
    let mut winch = Winch::default();
    let mut rest = along;
    // Where cable slides upwards, the tension behind it is smaller by its weight, as in (N7).
    let slid = free.free.cable.weight_per_length * along[D - 1];
    for (k, direction) in beginning.directions.iter().enumerate() {
        let part: f64 = along.iter().zip(direction).map(|(one, other)| one * other).sum();
        rest.iter_mut().zip(direction).for_each(|(rest, of)| *rest -= of * part);
        winch.pulled.push((D + k, part * (slid - stretch * beginning.matrices.stiffness[(k, k)])));
    }
    /// Part of the direction below which a pulley yields along all of it.
    const ROUNDING: f64 = 1e-9;
    let left = norm(rest);
    if left > ROUNDING {
        beginning.directions.push(rest.map(|part| part / left));
        let Matrices { stiffness, mass } = beginning.matrices;
        let [stiffness, mass] = [stiffness, mass].map(|matrix| matrix.resize(soft + 1, soft + 1, 0.0));
        beginning.matrices = Matrices { stiffness, mass };
        winch.moved = Some((D + soft, -stretch * left));
    }
    (beginning, winch)
}

fn norm<const D: usize>(of: [f64; D]) -> f64 {
    of.iter().map(|part| part * part).sum::<f64>().sqrt()
}

/// The part of A along a cable with this tension at an unstrained length [N], which damps.
fn stretched<const D: usize>(free: &Free, s: f64, tension: [f64; D]) -> [[f64; D]; D] {
    let size = norm(tension);
    let modulus = free.free.cable.tangent_stiffness(free.tension(s).norm());
    let t = tension.map(|part| part / size);
    t.map(|one| t.map(|other| modulus * one * other))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::cable::tests::of_reference;
    use serde_json::Value;
    use std::f64::consts::TAU;

    #[test]
    fn cables_shaken_at_both_ends_answer_as_transfer_matrices_do() {
        let file: Value = serde_json::from_str(include_str!("../../data/motion.json")).unwrap();
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
