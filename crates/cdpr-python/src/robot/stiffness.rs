//! `Robot.stiffness`: the Cartesian stiffness at a pose.

use crate::convert::{Answer, Columns, Loads, Numbers, Rows, answer, each, plotted};
use crate::robot::Robot;
use crate::robot::inverse::coordinates;
use cdpr_robot::Vector3;
use cdpr_statics::stiffness::{Mode, PoseStiffness, stiffness_at};
use cdpr_statics::{StaticsError, WantedPose};
use pyo3::prelude::*;

answer! {
    /// Cartesian stiffness.
    ///
    /// The answer is of one pose, or of m: then every field has a first axis of m, with NaN where there is no
    /// answer, and `reasons` says why.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct Stiffness {
        /// Stiffness K in (dp, dphi), in the base frame about P [N/m, N/rad, N, N m/rad], (6, 6).
        ///
        /// It is the true tangent of the balance, with rotations R <- exp(dphi) R, and not symmetric under a
        /// moment.
        matrix: Py<PyAny>,
        /// Symmetric part of K, (6, 6).
        symmetric_part: Py<PyAny>,
        /// Eigenvalues of the symmetric part of the stiffness in (dp, characteristic_length dphi), from the
        /// softest motion [N/m], (6,); of a point mass or a planar robot (3,), here and below. Motions that
        /// nothing resists are left out, and the last numbers are NaN.
        eigenvalues: Py<PyAny>,
        /// Translation of P in each of these motions [m/m], (6, 3).
        translations: Py<PyAny>,
        /// Rotation in each of these motions [rad/m], (6, 3).
        rotations: Py<PyAny>,
        /// Stiffness of the softest motion [N/m].
        least_stiffness: Py<PyAny>,
        /// Whether the equilibrium is stable.
        stable: Py<PyAny>,
        /// Characteristic length, which makes rotations comparable with translations [m].
        characteristic_length: Py<PyAny>,
        /// Why there is no answer, None if there is one; None for one pose.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

plotted!(Stiffness);

/// A stiffness with its motions.
struct Found {
    stiffness: PoseStiffness,
    modes: Vec<Mode>,
    least_stiffness: f64,
}

#[pymethods]
impl Robot {
    /// Computes the Cartesian stiffness at a pose with a load, including the sag and weight of the cables.
    ///
    /// Arguments are of one case, or have a first axis of m cases.
    ///
    /// Parameters
    /// ----------
    /// pose : array_like
    ///     x, y, z [m], or x, y, z, qw, qx, qy, qz, (3,) or (7,).
    /// payload : array_like, optional
    ///     Mass that the platform carries there, at its centre of mass [kg].
    /// force, moment : array_like, optional
    ///     On the platform in the base frame, about P [N, N m], (3,).
    /// free : sequence of str, optional
    ///     Names of the coordinates of the pose that are found, for a robot with fewer cables than free
    ///     motions, as `Robot.inverse` takes them.
    ///
    /// Returns
    /// -------
    /// Stiffness
    ///     Stiffness matrices and their eigenvalues.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     For an invalid value; the message names it and what would be right.
    /// NoSolutionError
    ///     For one case without an answer; of several, its row has NaN and a reason.
    ///
    /// Examples
    /// --------
    /// >>> import cdpr
    /// >>> robot = cdpr.Robot.from_file("cogiro")
    /// >>> robot.stiffness([0, 0, 2]).matrix.shape
    /// (6, 6)
    #[pyo3(signature = (pose, *, payload=None, force=None, moment=None, free=None))]
    fn stiffness(
        &self,
        py: Python,
        pose: Numbers,
        payload: Option<Numbers>,
        force: Option<Numbers>,
        moment: Option<Numbers>,
        free: Option<Vec<String>>,
    ) -> Answer<Stiffness> {
        let free = coordinates(free)?;
        let poses = Rows::poses("pose", &pose, &self.robot)?;
        let loads = Loads::new(force.as_ref(), moment.as_ref(), payload.as_ref(), &self.robot)?;
        let cases = loads.cases([&poses])?;
        let outcomes = each(py, cases.count, |case| {
            let stiffness = stiffness_at(
                &self.robot,
                WantedPose::at(&poses.pose(case)?).free(&free),
                &loads.load(case)?,
            )?;
            let (modes, least_stiffness) =
                (stiffness.stability.modes(), stiffness.stability.least_stiffness());
            Ok::<_, StaticsError>(Found { stiffness, modes, least_stiffness })
        })?;
        let all = Columns::new(py, cases, &outcomes)?;
        let count = self.robot.freedoms().count();
        let vectors = |vector: fn(&Mode) -> Vector3<f64>| {
            all.numbers(&[count, 3], |found: &Found, out| {
                for (out, mode) in out.chunks_exact_mut(3).zip(&found.modes) {
                    out.copy_from_slice(vector(mode).as_slice());
                }
            })
        };
        Ok(Stiffness {
            matrix: all.numbers(&[6, 6], |found, out| {
                out.copy_from_slice(found.stiffness.matrix.transpose().as_slice());
            })?,
            // nalgebra stores matrices column by column, and this one is its own transpose.
            symmetric_part: all.numbers(&[6, 6], |found, out| {
                out.copy_from_slice(found.stiffness.symmetric_part.as_slice());
            })?,
            eigenvalues: all.numbers(&[count], |found, out| {
                out.iter_mut().zip(&found.modes).for_each(|(out, mode)| *out = mode.stiffness);
            })?,
            translations: vectors(|mode| mode.translation)?,
            rotations: vectors(|mode| mode.rotation)?,
            least_stiffness: all.number(|found| found.least_stiffness)?,
            stable: all.array(false, &[], |found, out| out[0] = found.stiffness.stability.is_stable())?,
            characteristic_length: all.number(|found| found.stiffness.stability.characteristic_length())?,
            reasons: all.reasons(),
            kinds: all.kinds(),
        })
    }
}
