//! One cable between two points.

use crate::convert::{Answer, Cases, Columns, Numbers, Raised, Rows, answer, each, plotted};
use cdpr_cable::{Cable, CableError, Known, Solution, Vector2};
use pyo3::prelude::*;

answer! {
    /// Cables in equilibrium, in their vertical planes.
    ///
    /// The exit point is the origin, the anchor point is at (x, z), and z points up.
    ///
    /// The answer is of one cable, or of m: then every field has a first axis of m, with NaN where there is
    /// no answer, and `reasons` says why.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct Catenary {
        /// Force (fx, fz) on the cable at the anchor point [N], (2,).
        force: Py<PyAny>,
        /// Tension at the anchor point [N].
        anchor_tension: Py<PyAny>,
        /// Tension at the exit point [N].
        exit_tension: Py<PyAny>,
        /// Greatest height of the chord above the cable [m].
        sag: Py<PyAny>,
        /// Elastic energy plus potential energy of the weight, zero at the height of the exit point [J].
        energy: Py<PyAny>,
        /// Unstrained length [m].
        unstrained_length: Py<PyAny>,
        /// Position (x, z) of the anchor point [m], (2,).
        end: Py<PyAny>,
        /// Closure residual: distance between the given end and that of the catenary [m].
        residual: Py<PyAny>,
        /// Points (x, z) from exit to anchor point, at equal unstrained distances [m], (points, 2).
        shape: Py<PyAny>,
        /// Why there is no answer, None if there is one; None for one cable.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

plotted!(Catenary);

/// Computes an elastic cable from two of its unstrained length, end, force and tension.
///
/// Given are `length` and `end`, `length` and `force`, or `end` and `tension`. Arguments are of one cable, or
/// have a first axis of m cables.
///
/// Parameters
/// ----------
/// weight : array_like
///     Weight per unstrained length [N/m]; 0 makes the cable a straight spring.
/// stiffness : array_like
///     Axial stiffness EA [N].
/// length : array_like, optional
///     Unstrained length [m].
/// end : array_like, optional
///     Position (x, z) of the anchor point [m], (2,); x >= 0, z up.
/// force : array_like, optional
///     Force (fx, fz) on the cable at the anchor point [N], (2,).
/// tension : array_like, optional
///     Tension at the anchor point [N].
/// points : int, default 51
///     Number of points of `shape`, at least 2.
///
/// Returns
/// -------
/// Catenary
///     Forces, tensions and shapes.
///
/// Raises
/// ------
/// InputError
///     For an invalid value; the message names it and what would be right.
/// NoSolutionError
///     For one cable without an answer; of several, its row has NaN and a reason.
///
/// Examples
/// --------
/// >>> import cdpr
/// >>> cable = cdpr.catenary(1.0, 1e6, length=5.0, end=[4.0, 1.0])  # [N/m], [N], [m], [m]
/// >>> cable.shape.shape
/// (51, 2)
#[pyfunction]
#[pyo3(signature = (weight, stiffness, *, length=None, end=None, force=None, tension=None, points=51))]
#[allow(clippy::too_many_arguments)]
pub(crate) fn catenary(
    py: Python,
    weight: Numbers,
    stiffness: Numbers,
    length: Option<Numbers>,
    end: Option<Numbers>,
    force: Option<Numbers>,
    tension: Option<Numbers>,
    points: usize,
) -> Answer<Catenary> {
    if points < 2 {
        return Err(Raised::Input(format!("points is {points}: expected 2 or more")));
    }
    let weight = Rows::scalars("weight", &weight)?;
    let stiffness = Rows::scalars("stiffness", &stiffness)?;
    let scalars = |name, array: Option<Numbers>| array.map(|array| Rows::scalars(name, &array)).transpose();
    let vectors = |name, array: Option<Numbers>| {
        array.map(|array| Rows::components::<2>(name, Some(&array))).transpose()
    };
    let (length, tension) = (scalars("length", length)?, scalars("tension", tension)?);
    let (end, force) = (vectors("end", end)?, vectors("force", force)?);
    let given = [&length, &end, &force, &tension].into_iter().flatten();
    let arguments: Vec<_> = [&weight, &stiffness].into_iter().chain(given).collect();
    let known = Known::from_given(length.as_ref(), end.as_ref(), force.as_ref(), tension.as_ref());
    let known = known.ok_or_else(|| {
        let expected = "length and end, length and force, or end and tension";
        Raised::Input(format!("expected two of what is known: {expected}"))
    })?;
    let cases = Cases::of(&arguments)?;
    let one = |i| {
        let known = known.map(|rows| rows.scalar(i), |rows| Vector2::from(rows.vector::<2>(i)));
        known.solve(&Cable::linear(weight.scalar(i), stiffness.scalar(i)))
    };
    let outcomes = each(py, cases.count, one)?;
    Catenary::new(py, cases, &outcomes, points)
}

impl Catenary {
    fn new(
        py: Python,
        cases: Cases,
        outcomes: &[Result<Solution<'static>, CableError>],
        points: usize,
    ) -> Answer<Self> {
        let all = Columns::new(py, cases, outcomes)?;
        Ok(Self {
            force: all.vector(|solution| solution.catenary.force.into())?,
            anchor_tension: all.number(|solution| solution.catenary.anchor_tension())?,
            exit_tension: all.number(|solution| solution.catenary.exit_tension())?,
            sag: all.number(|solution| solution.catenary.vertical_sag())?,
            energy: all.number(|solution| solution.catenary.potential_energy())?,
            unstrained_length: all.number(|solution| solution.catenary.unstrained_length)?,
            end: all.vector(|solution| solution.end.into())?,
            residual: all.number(|solution| solution.residual)?,
            shape: all.numbers(&[points, 2], |solution, out| {
                for (out, point) in out.chunks_exact_mut(2).zip(solution.catenary.profile(points)) {
                    out.copy_from_slice(point.as_slice());
                }
            })?,
            reasons: all.reasons(),
            kinds: all.kinds(),
        })
    }
}
