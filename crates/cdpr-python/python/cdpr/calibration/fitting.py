"""The parameters of a robot from measurements."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Optional, Union

from .. import _core, _inputs
from .._core import Robot
from .._table import Column, Table, Value

if TYPE_CHECKING:
    import numpy
    from numpy.typing import NDArray


class Residuals(Table):
    """Measured less modelled of each of m numbers, by the robot before and after a calibration.

    `to_dataframe()` has a row for each number.
    """

    _rows, _name, _drawn, _module = "residuals", "column", ("before", "after"), "cdpr.calibration"

    line = Column("line", "Line of the number in the table, (m,).", "residuals")
    before = Column("before", "With the robot before, in the unit of the column, (m,).", "residuals")
    after = Column("after", "With the calibrated robot, (m,).", "residuals")
    std = Column("std", "Standard deviation of the noise, (m,).", "residuals")

    @property
    def columns(self) -> list[str]:
        """Column of each number in the table."""
        return self.inputs


class Calibrated(Table):
    """A calibrated robot with all that is known of it, a row for each parameter that was sought."""

    _rows, _name, _drawn, _module = "parameters", "parameter", ("moved",), "cdpr.calibration"
    _shown = ("chi_square", "degrees_of_freedom")

    before = Column("before", "Value in the robot before [SI unit], (k,).", "parameters")
    after = Column("after", "Value that was found [SI unit], (k,).", "parameters")
    moved = Column(
        "moved_by_prior_std", "The change in standard deviations before, (k,); NaN without a prior.", "parameters"
    )
    std = Column(
        "std", "Standard deviation after, by data and priors, (k,); NaN where both leave it open.", "parameters"
    )
    std_of_data = Column("std_of_data", "Standard deviation by the data alone, (k,).", "parameters")
    prior_std = Column("prior_std", "Standard deviation before, (k,).", "parameters")
    chi_square = Value("chi_square", "Sum of squares of all residuals in standard deviations, priors included.")
    degrees_of_freedom = Value("degrees_of_freedom", "Its expectation, if model and noise are right.")
    p_value = Value("p_value", "Probability of such a chi-square or a greater one; None without stated noise.")
    status = Value("status", "Whether the search ended at a minimum: `converged`, `starts_disagree`, ...")

    def __init__(self, robot: Robot, found: dict[str, Any]) -> None:
        summary = found["summary"]
        rows = [{"parameter": name, **of} for name, of in summary["parameters"].items()]
        super().__init__({**summary, "parameters": rows})
        #: The calibrated robot.
        self.robot = robot
        #: What is known of its errors, a dictionary of the format `cdpr-errors/1`: the `uncertainty` of another
        #: calibration, or an error model of a study.
        self.posterior: dict[str, Any] = found["posterior"]
        #: Content of `summary.json`.
        self.summary: dict[str, Any] = summary
        #: Measured less modelled, before and after.
        self.residuals = Residuals({"residuals": found["residuals"]})
        self._poses = found["poses"], found["poses_before"]

    @property
    def parameters(self) -> list[str]:
        """Names of the parameters that were sought."""
        return self.inputs

    @property
    def identifiable(self) -> NDArray[numpy.bool_]:
        """Whether the data alone determine each parameter, (k,)."""
        import numpy

        return numpy.array([row["identifiable"] for row in self.content["parameters"]], dtype=bool)

    @property
    def sensors(self) -> dict[str, dict[str, Any]]:
        """The errors of sensors that were sought, by their names, with `after`, `std` and others."""
        return dict(self.summary.get("sensors", {}))

    @property
    def poses(self) -> NDArray[numpy.float64]:
        """Pose of each row by the calibrated robot, (rows, 7)."""
        import numpy

        return numpy.array(self._poses[0], dtype=float)

    @property
    def poses_before(self) -> NDArray[numpy.float64]:
        """Pose of each row by the robot before, (rows, 7)."""
        import numpy

        return numpy.array(self._poses[1], dtype=float)

    @property
    def warnings(self) -> list[str]:
        """What is odd about the result, a sentence each."""
        return list(self.summary["warnings"])


def calibrate(
    robot: Robot,
    measurements: _inputs.Table,
    out: Optional[_inputs.Path] = None,
    *,
    noise: Optional[Mapping[str, float]] = None,
    uncertainty: Optional[Union[Mapping[str, float], _inputs.Document]] = None,
    parameters: Sequence[str] = (),
    share: Sequence[str] = (),
    unknown: Optional[Mapping[str, Optional[float]]] = None,
    bounds: Optional[Mapping[str, tuple[float, float]]] = None,
    markers: Sequence[Sequence[float]] = (),
    loss: str = "squares",
    starts: int = 3,
    seed: int = 1,
    only_identifiable: bool = False,
    folds: int = 5,
    overwrite: bool = False,
    threads: Optional[int] = None,
) -> Calibrated:
    """Fits the parameters of a robot to measurements.

    Parameters
    ----------
    robot : Robot
        The robot.
    measurements : path, dict of array_like or DataFrame
        Columns by their names, which have units, `x_m`, `roll_deg`, `l1_m` ..., in a dictionary of
        arrays (m,) or a pandas.DataFrame, NaN for what was not measured; or a file, CSV or JSON, as
        `cdpr calibrate fit` reads it.
    out : path, optional
        Folder of the results; made if missing. Without one nothing is written.
    noise : dict of float, optional
        Standard deviations of the sensors [SI units]: {"position": 1e-4, "length": 1e-4}, and
        covariances of two columns: {"cov_x_m_y_m": 5e-9}.
    uncertainty : path or dict, optional
        The tolerances, the prior: standard deviations by names of parameters or groups, {"a": 0.002},
        or an error model, its content or its file; without it all anchor and exit points, mass and
        modulus are sought without prior.
    parameters : sequence of str, optional
        Parameters or groups that are sought without prior, instead of `uncertainty`.
    share : sequence of str, optional
        Parameters with one deviation in common: groups, "r", or lists, "r1+r2".
    unknown : dict of float or None, optional
        Errors of sensors that are sought, with the standard deviation of a prior or None:
        {"length_offset": None, "tension_bias": 20}.
    bounds : dict of (float, float), optional
        Least and greatest deviation of what is sought: {"mass": (-2, 2)}.
    markers : sequence of (float, float, float), optional
        Places of markers on the platform [m], (k, 3).
    loss : str, default 'squares'
        "squares", "huber" or "cauchy".
    starts : int, default 3
        Starts of the search, 1 to 1000. Twice as many are made at most, until two agree; with one,
        nothing shows that its minimum is the least.
    seed : int, default 1
        Of the random starts.
    only_identifiable : bool, default False
        Keep the values of parameters that the data do not determine.
    folds : int, default 5
        Parts of the rows that are predicted by robots calibrated without them, 0 to 10000.
    overwrite : bool, default False
        Replace the results that the folder has already.
    threads : int, optional
        Number of threads; all cores if left out.

    Returns
    -------
    Calibrated
        The robot that was found, and what is known of it.

    Raises
    ------
    InputError
        The message names line and column.
    FileError
        For a file or folder that cannot be read, written or used.
    NoSolutionError
        Where there is no answer.

    Examples
    --------
    >>> import cdpr
    >>> robot = cdpr.Robot.from_file("cogiro")
    >>> tolerances = {"mass": 2}  # [kg]
    >>> noise = {"position": 1e-5, "rotation": 1e-5, "length": 1e-6}  # [m], [rad], [m]
    >>> poses = [[x, y, 2] for x in (-1, 0, 1) for y in (-1, 1)]
    >>> campaign = simulate(robot, poses, uncertainty=tolerances, noise=noise)
    >>> calibrate(robot, campaign.measurements, uncertainty=tolerances, noise=noise).parameters
    ['mass']
    """
    calibrated, text = _core.calibrate(
        robot,
        _inputs.table("measurements", measurements),
        out,
        _inputs.numbers(noise),
        None if uncertainty is None else _inputs.uncertainty(uncertainty),
        list(parameters),
        list(share),
        list((unknown or {}).items()),
        [(name, (float(least), float(most))) for name, (least, most) in (bounds or {}).items()],
        [tuple(marker) for marker in markers],
        loss,
        starts,
        seed,
        only_identifiable,
        folds,
        overwrite,
        threads,
    )
    return Calibrated(calibrated, json.loads(text))
