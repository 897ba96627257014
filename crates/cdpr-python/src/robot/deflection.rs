//! `Robot.deflection`: how far a load displaces and rotates the platform.

use crate::convert::{Answer, Columns, Loads, Numbers, Rows, answer, each, plotted};
use crate::robot::Robot;
use crate::robot::direct::{DirectSolution, Found};
use crate::robot::inverse::coordinates;
use cdpr_robot::Vector6;
use cdpr_statics::{StaticsError, WantedPose, deflection};
use pyo3::prelude::*;

answer! {
    /// Static deflections.
    ///
    /// The answer is of one case, or of m: then every field has a first axis of m, with NaN where there is no
    /// answer, and `reasons` says why.
    #[pyclass(frozen, get_all, module = "cdpr")]
    pub(crate) struct Deflection {
        /// Displacement dp of P, the position with the load minus that without [m], (3,).
        displacement: Py<PyAny>,
        /// Norm |dp| of the displacement, the paper's RMS [m].
        magnitude: Py<PyAny>,
        /// Rotation vector from the unloaded to the loaded platform, in the base frame [rad], (3,).
        rotation: Py<PyAny>,
        /// Unstrained lengths of the cables [m], (n,).
        lengths: Py<PyAny>,
        /// The platform under its own weight.
        unloaded: Py<DirectSolution>,
        /// The platform with the load added.
        loaded: Py<DirectSolution>,
        /// Why there is no answer, None if there is one; None for one case.
        reasons: Py<PyAny>,
        /// The kind of each failure, in the same form: `infeasible_tension`, ...
        kinds: Py<PyAny>,
    }
}

plotted!(Deflection);

/// A deflection with its derived quantities, which are computed in parallel.
pub(crate) struct Given {
    magnitude: f64,
    displacement: [f64; 3],
    motion: Vector6<f64>,
    lengths: Vec<f64>,
    unloaded: Found,
    loaded: Found,
}

impl Given {
    pub(crate) fn new(robot: &cdpr_robot::Robot, found: cdpr_statics::Deflection) -> Self {
        Self {
            magnitude: found.magnitude(),
            displacement: found.displacement().into(),
            motion: found.unloaded.equilibrium.pose.motion_to(&found.loaded.equilibrium.pose),
            unloaded: Found::new(robot, &found.lengths, found.unloaded),
            loaded: Found::new(robot, &found.lengths, found.loaded),
            lengths: found.lengths,
        }
    }
}

#[pymethods]
impl Robot {
    /// Computes how far a load displaces and rotates the platform.
    ///
    /// The lengths are set so that the platform rests at the pose under its own weight; then the load is
    /// added. Arguments are of one case, or have a first axis of m cases.
    ///
    /// Parameters
    /// ----------
    /// pose : array_like
    ///     Wanted pose under the platform's own weight, (3,) or (7,).
    /// payload : array_like, optional
    ///     Mass added at the platform's centre of mass [kg].
    /// force, moment : array_like, optional
    ///     On the platform in the base frame, about P [N, N m], (3,).
    /// tension_offsets : array_like, optional
    ///     Offsets added to the tension set-points [N], (n,).
    /// free : sequence of str, optional
    ///     Names of the coordinates of the pose that are found, for a robot with fewer cables than free
    ///     motions, as `Robot.inverse` takes them.
    ///
    /// Returns
    /// -------
    /// Deflection
    ///     Displacements and rotations, and the equilibria without and with the load.
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
    /// >>> given = robot.deflection([0, 0, 2], payload=50)
    /// >>> print(f"{1e3 * given.magnitude:.1f} mm")
    /// 7.7 mm
    #[pyo3(signature = (pose, *, payload=None, force=None, moment=None, tension_offsets=None, free=None))]
    #[allow(clippy::too_many_arguments)]
    fn deflection(
        &self,
        py: Python,
        pose: Numbers,
        payload: Option<Numbers>,
        force: Option<Numbers>,
        moment: Option<Numbers>,
        tension_offsets: Option<Numbers>,
        free: Option<Vec<String>>,
    ) -> Answer<Deflection> {
        let cables = self.robot.cables.len();
        let free = coordinates(free)?;
        let poses = Rows::poses("pose", &pose, &self.robot)?;
        let loads = Loads::given(force.as_ref(), moment.as_ref(), payload.as_ref(), &self.robot)?;
        let offsets = tension_offsets
            .map(|offsets| Rows::of_cables("tension_offsets", &offsets, cables))
            .transpose()?;
        let cases = loads.cases([&poses].into_iter().chain(&offsets))?;
        let robot = &self.robot;
        let outcomes: Vec<Result<Given, StaticsError>> = each(py, cases.count, |case| {
            let offsets = offsets.as_ref().map_or(&[][..], |offsets| offsets.row(case));
            let found = deflection(
                robot,
                WantedPose::at(&poses.pose(case)?).free(&free).tension_offsets(offsets),
                &loads.load(case)?,
            )?;
            Ok(Given::new(robot, found))
        })?;
        let all = Columns::new(py, cases, &outcomes)?;
        Deflection::new(py, &all, cables)
    }
}

impl Deflection {
    pub(crate) fn new(py: Python, all: &Columns<Given>, cables: usize) -> Answer<Self> {
        let unloaded = DirectSolution::new(&all.part(|given| &given.unloaded), cables)?;
        let loaded = DirectSolution::new(&all.part(|given| &given.loaded), cables)?;
        Ok(Self {
            displacement: all.vector(|given| given.displacement)?,
            magnitude: all.number(|given| given.magnitude)?,
            rotation: all.vector(|given| [3, 4, 5].map(|row| given.motion[row]))?,
            lengths: all.numbers(&[cables], |given, out| out.copy_from_slice(&given.lengths))?,
            unloaded: Py::new(py, unloaded)?,
            loaded: Py::new(py, loaded)?,
            reasons: all.reasons(),
            kinds: all.kinds(),
        })
    }
}
