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

    fn all<const D: usize>(cable: &CableAtRest, modes: &[Clamped<D>]) -> Vec<Self> {
        modes.iter().map(|mode| Self::new(cable, mode.square, in_space(mode.coupling))).collect()
    }
}

/// The axes of a cable along its plane and upwards (2), across its plane (1), or both (3).
fn axes<const D: usize>() -> &'static [usize] {
    match D {
        1 => &[1],
        2 => &[0, 2],
        _ => &[0, 1, 2],
    }
}

/// A vector along the axes of the cable.
fn in_space<const D: usize>(parts: [f64; D]) -> Vector3<f64> {
    let mut found = Vector3::zeros();
    axes::<D>().iter().zip(parts).for_each(|(axis, part)| found[*axis] = part);
    found
}

/// The motions of a cable in its plane, across it, or in both, as polynomials.
pub(crate) struct Part<const D: usize> {
    pub(crate) beginning: Beginning<D>,
    pub(crate) condensed: Condensed<D>,
}

impl<const D: usize> Part<D> {
    /// With A at an unstrained length [N]; `None` for a cable that hangs folded.
    fn new(
        elements: &[Element],
        beginning: Beginning<D>,
        density: f64,
        modulus: impl Fn(f64) -> [[f64; D]; D],
    ) -> Option<Self> {
        let condensed = Condensed::new(&assemble(elements, &beginning, density, modulus))?;
        Some(Self { beginning, condensed })
    }

    /// Adds the mass of the static shapes along the axes of the cable [kg].
    fn add_mass(&self, mass: &mut Matrix3<f64>) {
        for (i, row) in axes::<D>().iter().zip(self.condensed.mass) {
            axes::<D>().iter().zip(row).for_each(|(j, value)| mass[(*i, *j)] += value);
        }
    }

    fn yielding(&self, unknown: usize) -> (Vector3<f64>, f64) {
        let (motion, flexibility) = self.condensed.yielding(unknown);
        (in_space(motion), flexibility)
    }
}

/// The motions of a cable: those in its plane and those across it, which a wheel with a tilted axis couples.
// Each is moved once, where it is made.
#[allow(clippy::large_enum_variant)]
pub(crate) enum Motions {
    Apart { in_plane: Part<2>, across: Part<1> },
    Together(Part<3>),
}

/// A cable as elements.
pub(crate) struct Parts {
    pub(crate) elements: Vec<Element>,
    pub(crate) motions: Motions,
    /// The unknown of the plane or of space, behind those of the end, that is the rotor of a winch.
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
        let (begins, rotor) = free.beginnings(cable, winch);
        let density = cable.linear_density;
        let folded = || match winch {
            None => DynamicsError::Folded { cable: i },
            Some(Rotor { stiffness, .. }) => DynamicsError::Invalid {
                field: "stiffness of the winches",
                value: format!("{stiffness:?} N/m"),
                expected: format!("more: cable {} hangs folded or runs out by its own weight", i + 1),
            },
        };
        let motions = match begins {
            Beginnings::Apart { in_plane, across } => {
                Part::new(&elements, in_plane, density, |s| free.modulus(s))
                    .zip(Part::new(&elements, across, density, |s| [[1.0 / free.slenderness(s)]]))
                    .map(|(in_plane, across)| Motions::Apart { in_plane, across })
            }
            Beginnings::Together(begins) => {
                Part::new(&elements, begins, density, |s| free.modulus_in_space(s)).map(Motions::Together)
            }
        };
        Ok(Self { elements, motions: motions.ok_or_else(folded)?, rotor })
    }

    /// The motions with the end held: those in the plane, then those across it.
    pub(crate) fn held(&self, cable: &CableAtRest) -> Vec<HeldMode> {
        match &self.motions {
            Motions::Apart { in_plane, across } => {
                let mut all = HeldMode::all(cable, &in_plane.condensed.modes);
                all.extend(HeldMode::all(cable, &across.condensed.modes));
                all
            }
            Motions::Together(part) => HeldMode::all(cable, &part.condensed.modes),
        }
    }

    /// Fewer, which act as all of them do on motions up to `square` = ω² [1/s²].
    fn reduced(&self, cable: &CableAtRest, square: f64) -> Vec<HeldMode> {
        match &self.motions {
            Motions::Apart { in_plane, across } => {
                let mut all = HeldMode::all(cable, &in_plane.condensed.reduced(square));
                all.extend(HeldMode::all(cable, &across.condensed.reduced(square)));
                all
            }
            Motions::Together(part) => HeldMode::all(cable, &part.condensed.reduced(square)),
        }
    }

    /// How far the rotor moves with the end, and by a force on it while the end is held [m/N].
    fn yielding(&self) -> Option<(Vector3<f64>, f64)> {
        self.rotor.map(|rotor| match &self.motions {
            Motions::Apart { in_plane, .. } => in_plane.yielding(rotor),
            Motions::Together(part) => part.yielding(rotor),
        })
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
        let softer = parts.yielding().map_or_else(Matrix6::zeros, |(motion, flexibility)| {
            let yielding = HeldMode::new(cable, 0.0, motion).coupling;
            yielding * yielding.transpose() / flexibility
        });
        let sorted = |mut modes: Vec<HeldMode>| {
            modes.sort_by(|one, other| one.square.total_cmp(&other.square));
            modes
        };
        let square = (KEPT * TAU * highest).powi(2);
        let reduced = sorted(parts.reduced(cable, square));
        Ok(Self { mass: Self::mass(cable, &parts), softer, modes: sorted(parts.held(cable)), reduced })
    }

    /// Mass of the static shapes of a cable [kg, kg m, kg m²].
    pub(crate) fn mass(cable: &CableAtRest, parts: &Parts) -> Matrix6<f64> {
        let mut mass = Matrix3::zeros();
        match &parts.motions {
            Motions::Apart { in_plane, across } => {
                in_plane.add_mass(&mut mass);
                across.add_mass(&mut mass);
            }
            Motions::Together(part) => part.add_mass(&mut mass),
        }
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
