//! One cable of a platform at rest: its motions, and what the platform feels of them.

use crate::condensed::{Clamped, Condensed};
use crate::element::{Beginning, Element, assemble};
use crate::error::DynamicsError;
use crate::free::{Beginnings, Free, Rotor};
use cdpr_statics::vibration::CableAtRest;
use cdpr_statics::{Matrix6, Vector3, Vector6};
use nalgebra::Matrix3;
use std::f64::consts::TAU;

/// Motions of the cable with its end held are kept up to this multiple of the highest frequency.
const KEPT: f64 = 2.0;

/// A cable with mass, seen from the platform. Motions are (dp, dφ) about P in the base frame.
#[derive(Clone, Debug)]
pub(crate) struct MovingCable {
    /// Mass of its static shapes [kg, kg m, kg m²].
    pub(crate) mass: Matrix6<f64>,
    /// By how much a winch that yields makes it softer than the static models say [N/m, N, N m].
    pub(crate) softer: Matrix6<f64>,
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

impl HeldMode {
    /// One with this coupling along the axes of the cable.
    fn new(cable: &CableAtRest, square: f64, local: Vector3<f64>) -> Self {
        let force = cable.axes * local;
        let moment = cable.lever.cross(&force);
        Self { square, coupling: Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z) }
    }

    fn in_plane(cable: &CableAtRest, Clamped { square, coupling: [x, z] }: &Clamped<2>) -> Self {
        Self::new(cable, *square, Vector3::new(*x, 0.0, *z))
    }

    fn across(cable: &CableAtRest, Clamped { square, coupling: [y] }: &Clamped<1>) -> Self {
        Self::new(cable, *square, Vector3::new(0.0, *y, 0.0))
    }
}

/// The motions of a cable in its plane, or across it, as polynomials.
pub(crate) struct Part<const D: usize> {
    pub(crate) beginning: Beginning<D>,
    pub(crate) condensed: Condensed<D>,
}

/// A cable as elements.
pub(crate) struct Parts {
    pub(crate) elements: Vec<Element>,
    pub(crate) in_plane: Part<2>,
    pub(crate) across: Part<1>,
    /// The unknown of the plane, behind those of the end, that is the rotor of a winch.
    rotor: Option<usize>,
}

impl Parts {
    /// Cable `i`, for frequencies up to `highest` [Hz], on a winch that holds or yields.
    ///
    /// # Errors
    /// As [`MovingCable::new`].
    pub(crate) fn new(
        i: usize,
        cable: &CableAtRest,
        highest: f64,
        winch: Option<Rotor>,
    ) -> Result<Self, DynamicsError> {
        let free = Free { cable: i, free: cable.catenary.free() };
        let elements = free.elements(cable.linear_density, highest)?;
        let Beginnings { in_plane, across, rotor } = free.beginnings(cable, winch);
        let density = cable.linear_density;
        let folded = || match winch {
            None => DynamicsError::Folded { cable: i },
            Some(Rotor { stiffness, .. }) => DynamicsError::Invalid {
                field: "stiffness of the winches",
                value: format!("{stiffness:?} N/m"),
                expected: format!("more: cable {} hangs folded or runs out by its own weight", i + 1),
            },
        };
        let matrices = assemble(&elements, &in_plane, density, |s| free.modulus(s));
        let condensed = Condensed::new(&matrices).ok_or_else(folded)?;
        let in_plane = Part { beginning: in_plane, condensed };
        let matrices = assemble(&elements, &across, density, |s| [[1.0 / free.slenderness(s)]]);
        let condensed = Condensed::new(&matrices).ok_or_else(folded)?;
        Ok(Self { elements, in_plane, across: Part { beginning: across, condensed }, rotor })
    }

    /// The motions with the end held: those in the plane, then those across it.
    pub(crate) fn held(&self, cable: &CableAtRest) -> Vec<HeldMode> {
        let in_plane = self.in_plane.condensed.modes.iter().map(|mode| HeldMode::in_plane(cable, mode));
        let across = self.across.condensed.modes.iter().map(|mode| HeldMode::across(cable, mode));
        in_plane.chain(across).collect()
    }
}

impl MovingCable {
    /// Cable `i`, for frequencies up to `highest` [Hz], on a winch that holds or yields.
    ///
    /// # Errors
    /// [`DynamicsError::Folded`] for a cable without tension at a point; [`DynamicsError::Invalid`] for a
    /// frequency at which it has too many half waves, and for a servo that the weight of the cable overcomes.
    pub(crate) fn new(
        i: usize,
        cable: &CableAtRest,
        highest: f64,
        winch: Option<Rotor>,
    ) -> Result<Self, DynamicsError> {
        let is_shapeless = winch.is_none() || cable.catenary.is_slack_and_weightless();
        if cable.linear_density == 0.0 && is_shapeless {
            let [mass, softer] = [Matrix6::zeros(); 2];
            return Ok(Self { mass, softer, modes: Vec::new(), reduced: Vec::new() });
        }
        let parts = Parts::new(i, cable, highest, winch)?;
        let softer = parts.rotor.map_or_else(Matrix6::zeros, |rotor| {
            let ([x, z], flexibility) = parts.in_plane.condensed.yielding(rotor);
            let yielding = HeldMode::new(cable, 0.0, Vector3::new(x, 0.0, z)).coupling;
            yielding * yielding.transpose() / flexibility
        });
        let (in_plane, across) = (&parts.in_plane.condensed, &parts.across.condensed);
        let sorted = |mut modes: Vec<HeldMode>| {
            modes.sort_by(|one, other| one.square.total_cmp(&other.square));
            modes
        };
        let square = (KEPT * TAU * highest).powi(2);
        let slow = (in_plane.reduced(square), across.reduced(square));
        let in_plane = slow.0.iter().map(|mode| HeldMode::in_plane(cable, mode));
        let reduced = in_plane.chain(slow.1.iter().map(|mode| HeldMode::across(cable, mode)));
        let reduced = sorted(reduced.collect());
        Ok(Self { mass: Self::mass(cable, &parts), softer, modes: sorted(parts.held(cable)), reduced })
    }

    /// Mass of the static shapes of a cable [kg, kg m, kg m²].
    pub(crate) fn mass(cable: &CableAtRest, parts: &Parts) -> Matrix6<f64> {
        let (in_plane, across) = (&parts.in_plane.condensed, &parts.across.condensed);
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
        on_platform
    }

    /// The number of motions with the end held that are slower than `square` = ω² [1/s²].
    pub(crate) fn slower(&self, square: f64) -> usize {
        self.modes.partition_point(|mode| mode.square < square)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use cdpr_cable::{Cable, Catenary};
    use nalgebra::Vector2;
    use serde_json::Value;

    fn number(value: &Value) -> f64 {
        value.as_f64().unwrap()
    }

    /// A cable of `motion.json` in its own plane.
    pub(crate) fn of_reference(case: &Value) -> CableAtRest<'static> {
        let density = number(&case["linear_density"]);
        let catenary = Catenary {
            cable: Cable::linear(density * number(&case["gravity"]), number(&case["axial_stiffness"])),
            unstrained_length: number(&case["unstrained_length"]),
            force: Vector2::new(number(&case["end_force_x"]), number(&case["end_force_z"])),
        };
        CableAtRest {
            lever: Vector3::zeros(),
            axes: Matrix3::identity(),
            catenary,
            linear_density: density,
            end_stiffness: catenary.stiffness(Vector2::x()),
            stiffness: Matrix6::zeros(),
        }
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
        let file: Value = serde_json::from_str(include_str!("../data/motion.json")).unwrap();
        let (mut stiffnesses, mut frequencies) = (0, 0);
        for case in file["cables"].as_array().unwrap() {
            let cable = of_reference(case);
            let expected: Vec<f64> = case["frequencies_hz"].as_array().unwrap().iter().map(number).collect();
            let at = case["dynamic_stiffness"].as_array().map_or(&[][..], Vec::as_slice);
            let all = at.iter().map(|at| number(&at["frequency_hz"])).chain(expected.iter().copied());
            let moving = MovingCable::new(0, &cable, 1.25 * all.fold(0.0, f64::max), None).unwrap();
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
