"""Calibration: from measurements to a better robot, and to the accuracy that is left.

Nothing is written unless a call is given a folder or file; then the files are those of `cdpr calibrate fit`, byte for
byte.

>>> import cdpr
>>> robot = cdpr.Robot.from_file("cogiro")
>>> tolerances = {"a": {"law": {"normal": {"mean": 0, "std": 0.002}}}}
>>> noise = {"position": 1e-4, "rotation": 1e-4, "length": 1e-4}
>>> poses = [[x, y, z] for x in (-2, 0, 2) for y in (-1, 1) for z in (1.5, 2.5)]
>>> campaign = cdpr.calibration.simulate(robot, poses, model=tolerances, noise=noise)
>>> found = cdpr.calibration.calibrate(robot, campaign.measurements, model=tolerances, noise=noise)
>>> error = found.robot.anchor_points - campaign.robot.anchor_points
>>> bool(abs(error).max() < 2e-3)
True
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Optional

from . import _core, _inputs
from ._core import Robot
from ._table import Column, Table, Value

if TYPE_CHECKING:
    import numpy
    from numpy.typing import ArrayLike, NDArray

__all__ = [
    "Calibrated",
    "Campaign",
    "Combination",
    "Identified",
    "Plan",
    "Quality",
    "Residuals",
    "calibrate",
    "identify",
    "plan",
    "simulate",
]


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
        "std", "Standard deviation after, by data and priors, (k,); NaN where neither tell it.", "parameters"
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
        #: What is known of its errors, a dictionary of the format `cdpr-errors/1`: a `model` for another
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
        """Whether the data alone tell each parameter, (k,)."""
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
    model: Optional[_inputs.Document] = None,
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

    measurements: columns by their names, which have units, `x_m`, `roll_deg`, `l1_m` ..., in a dictionary of
        arrays (m,) or a pandas.DataFrame, NaN for what was not measured; or a file, CSV or JSON, as `cdpr
        calibrate fit` reads it.
    out: folder of the results; made if missing. Without one nothing is written.
    noise: standard deviations of the sensors [SI units]: {"position": 1e-4, "length": 1e-4}, and covariances
        of two columns: {"cov_x_m_y_m": 5e-9}.
    model: error model with the tolerances, the prior: its content as a dictionary, or a file; without one all
        anchor and exit points, mass and modulus are sought without prior.
    parameters: parameters or groups that are sought without prior, in place of a model.
    share: parameters with one deviation in common: groups, "r", or lists, "r1+r2".
    unknown: errors of sensors that are sought, with the standard deviation of a prior or None:
        {"length_offset": None, "tension_bias": 20}.
    bounds: least and greatest deviation of what is sought: {"mass": (-2, 2)}.
    markers: places of markers on the platform [m], (k, 3).
    loss: "squares", "huber" or "cauchy".
    starts, seed: starts of the search, 1 to 1000, and the seed of the random ones. Twice as many are made at
        most, until two agree; with one, nothing shows that its minimum is the least.
    only_identifiable: keep the values of parameters that the data do not tell.
    folds: parts of the rows that are predicted by robots calibrated without them, 0 to 10000.
    overwrite: replace the results that the folder has already.
    threads: number of threads; all cores if left out.

    Raises InputError, which names line and column, FileError, and NoSolutionError.
    """
    calibrated, text = _core.calibrate(
        robot,
        _inputs.table("measurements", measurements),
        out,
        _inputs.numbers(noise),
        None if model is None else _inputs.document("model", model),
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


@dataclass(frozen=True)
class Combination:
    """A combination of uncertain parameters, and how well measurements identify it."""

    #: Its standard deviation before over that of the noise in it.
    signal_to_noise: float
    #: Weight of each parameter, in its standard deviations.
    weights: dict[str, float]


class Identified(Table):
    """What measurements at poses identify of k uncertain parameters."""

    _rows, _name, _drawn, _module = "parameters", "parameter", ("remaining",), "cdpr.calibration"

    remaining = Column(
        "remaining", "Standard deviation after the measurements over that before, (k,).", "parameters"
    )
    held = Value("poses", "Number of poses that the robot holds.")

    @property
    def identifiable(self) -> list[Combination]:
        """Combinations that the measurements identify, the best first."""
        return [Combination(**of) for of in self.content["identifiable"]]

    @property
    def unidentifiable(self) -> list[Combination]:
        """Combinations that they do not."""
        return [Combination(**of) for of in self.content["unidentifiable"]]


def identify(
    robot: Robot,
    poses: ArrayLike,
    *,
    uncertainty: Mapping[str, float],
    noise: Mapping[str, float],
    payload: float = 0.0,
    free: Optional[Sequence[str]] = None,
) -> Identified:
    """Finds the combinations of uncertain parameters that measurements at poses identify.

    poses: (m, 3) or (m, 7); those that the robot does not hold are left out.
    uncertainty: standard deviations of parameters or groups [SI units]: {"a": 0.002, "mass": 0.5}.
    noise: standard deviations of what is measured, "position" [m] and "rotation" [rad], "tension" [N],
        "length" [m]: {"position": 1e-4, "rotation": 1e-4}.
    payload: known mass added at the platform's centre of mass [kg].
    free: names of the coordinates that are found, for a robot with few cables.

    Raises InputError.
    """
    settings = (_inputs.numbers(uncertainty), _inputs.numbers(noise), payload, _inputs.names(free))
    found = json.loads(_core.identify(robot, poses, *settings))
    rows = [{"parameter": name, "remaining": value} for name, value in found["remaining"].items()]
    return Identified({**found, "parameters": rows})


@dataclass(frozen=True)
class Quality:
    """What measurements at a set of poses leave uncertain."""

    #: Information about the parameters [bit].
    information_bits: float
    #: Root mean square of the standard deviations of the parameters after, each over that before.
    parameters: float
    #: Root mean square of the standard deviation of a coordinate where the robot works [m]; None without `work`.
    mean_at_work: Optional[float]
    #: The greatest standard deviation of a coordinate there [m].
    worst_at_work: Optional[float]


class Plan:
    """The poses to measure, compared with random and outermost ones."""

    def __init__(self, content: dict[str, Any]) -> None:
        #: Everything, as JSON has it.
        self.content = content

    @property
    def poses(self) -> NDArray[numpy.float64]:
        """The poses, the one that tells most first, (count, 7)."""
        import numpy

        return numpy.array(self.content["poses"], dtype=float)

    @property
    def candidates(self) -> int:
        """Number of candidates that the robot holds."""
        return int(self.content["candidates"])

    @property
    def quality(self) -> Quality:
        """What the plan leaves uncertain."""
        return Quality(**self.content["plan"])

    @property
    def random(self) -> Quality:
        """What random sets of as many poses leave, in the median."""
        return Quality(**self.content["random"])

    @property
    def outermost(self) -> Quality:
        """What the outermost poses leave."""
        return Quality(**self.content["outermost"])

    @property
    def growing(self) -> list[Quality]:
        """What the first 1, 2, 3 ... poses leave."""
        return [Quality(**of) for of in self.content["growing"]]

    def to_dataframe(self) -> Any:
        """Returns a pandas.DataFrame with a row for each pose, and what the poses up to it leave."""
        import pandas

        places = pandas.DataFrame(self.poses, columns=["x", "y", "z", "qw", "qx", "qy", "qz"])
        return places.join(pandas.DataFrame(self.content["growing"]))

    def plot(self) -> Any:
        """Draws the information over the number of poses, and returns the matplotlib Figure."""
        from matplotlib import pyplot

        figure, axis = pyplot.subplots(layout="constrained")
        counts = range(1, len(self.growing) + 1)
        axis.plot(counts, [of.information_bits for of in self.growing], ".-", label="plan")
        for name, of in (("random", self.random), ("outermost", self.outermost)):
            axis.plot(len(self.growing), of.information_bits, "o", label=name)
        axis.set_xlabel("poses")
        axis.set_ylabel("information [bit]")
        axis.legend()
        return figure

    def __repr__(self) -> str:
        bits = [of.information_bits for of in (self.quality, self.random)]
        return "<cdpr.calibration.Plan of {} poses: {:.4g} bit, at random {:.4g}>".format(len(self.poses), *bits)


def plan(
    robot: Robot,
    poses: ArrayLike,
    *,
    uncertainty: Mapping[str, float],
    noise: Mapping[str, float],
    count: int = 20,
    criterion: str = "information",
    work: Optional[ArrayLike] = None,
    of: str = "position",
    payload: float = 0.0,
    free: Optional[Sequence[str]] = None,
    seed: int = 1,
) -> Plan:
    """Chooses the poses that together leave least uncertainty, compared with random and outermost ones.

    poses: candidates, (m, 3) or (m, 7).
    uncertainty, noise, payload, free: as `identify` takes them.
    count: number of poses.
    criterion: "information" (D-optimal), "parameters" (A-optimal), "mean-at-work" or "worst-at-work".
    work: poses where the robot works, (k, 3) or (k, 7).
    of: what is to be exact there, "position" with given lengths, or "deflection" by the payload.
    seed: of the random sets.

    Raises InputError.
    """
    text = _core.plan(
        robot,
        poses,
        _inputs.numbers(uncertainty),
        _inputs.numbers(noise),
        count,
        criterion,
        work,
        of,
        payload,
        _inputs.names(free),
        seed,
    )
    return Plan(json.loads(text))


@dataclass(frozen=True)
class Campaign:
    """A simulated campaign of measurements."""

    #: The robot as it truly is.
    robot: Robot
    #: Columns of the measurements by their names, which `calibrate` takes: `l1_m`, `x_m`, ..., (m,) each.
    measurements: dict[str, NDArray[numpy.float64]]

    def to_dataframe(self) -> Any:
        """Returns the measurements as a pandas.DataFrame."""
        import pandas

        return pandas.DataFrame(self.measurements)


def simulate(
    robot: Robot,
    poses: ArrayLike,
    out: Optional[_inputs.Path] = None,
    *,
    model: _inputs.Document,
    noise: Mapping[str, float],
    unknown: Optional[Mapping[str, float]] = None,
    markers: Sequence[Sequence[float]] = (),
    tension_at: str = "platform",
    payload: float = 0.0,
    free: Optional[Sequence[str]] = None,
    seed: int = 1,
    overwrite: bool = False,
) -> Campaign:
    """Simulates what the sensors of a robot that deviates from its file would read.

    robot: the robot as the controller knows it.
    poses: wanted poses, (m, 3) or (m, 7).
    out: file for the measurements (CSV); without one nothing is written.
    model: error model with the tolerances, from which the deviations are drawn: its content as a dictionary, or
        a file.
    noise: standard deviations of the sensors that are there: {"position": 1e-4, "length": 1e-4}.
    unknown: errors of sensors to draw, with their standard deviations: {"length_offset": 0.01}.
    markers: places of markers on the platform [m], (k, 3).
    tension_at: where the load cells sit, "platform" or "winch".
    payload: mass added at the platform's centre of mass [kg].
    free: names of the coordinates that are found, for a robot with few cables.
    seed: of deviations and noise.
    overwrite: replace the file if it exists.

    Raises InputError, FileError and NoSolutionError.
    """
    truth, text = _core.simulate(
        robot,
        poses,
        out,
        _inputs.document("model", model),
        _inputs.numbers(noise),
        _inputs.numbers(unknown),
        [tuple(marker) for marker in markers],
        tension_at,
        payload,
        _inputs.names(free),
        seed,
        overwrite,
    )
    return Campaign(truth, _inputs.columns_of(text))
