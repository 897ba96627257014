"""Assessments of a robot and its cables: what is odd about its file, which tolerances to tighten, how reliably
its pose is found, what its cables dissipate.

>>> import cdpr
>>> for finding in cdpr.assess.check(cdpr.Robot.from_file("four-cables")):
...     print(finding.severity, finding.field, finding.value)
note cables 4 for 6 free motions
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from os import fspath
from typing import TYPE_CHECKING, Any, Callable, NamedTuple, Optional, Union

from . import _core, _inputs
from ._core import Robot
from ._table import Column, Interval, Table, Value

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = [
    "Finding",
    "LoadCycle",
    "Moduli",
    "Robustness",
    "ToleranceBudget",
    "check",
    "hysteresis",
    "linear_density",
    "modulus",
    "robustness",
    "tolerances",
]

class Finding(NamedTuple):
    """Something odd about a robot, and yet no error."""

    #: "warning" for what is probably a mistake, "note" for what is worth knowing.
    severity: str
    #: Field of the robot file.
    field: str
    #: Its value.
    value: str
    #: Why it is odd.
    why: str
    #: What would be right.
    remedy: str


def check(robot: Union[Robot, _inputs.Path]) -> list[Finding]:
    """Lists what is odd about a robot and yet no error, as `cdpr robot check` does.

    robot: a robot, a robot file, or a name of the library. A file is checked in whatever units it is, also where
        `Robot.from_file` refuses these.

    Raises InputError and FileError.
    """
    text = _core.check(robot) if isinstance(robot, Robot) else _core.check_file(fspath(robot))
    return [Finding(**finding) for finding in json.loads(text)]


class ToleranceBudget(Table):
    """Tolerances with the factors by which to tighten them, those to tighten most first."""

    _rows, _name, _drawn, _module = "tolerances", "name", ("share", "factor"), "cdpr.assess"
    _shown = ("limit_mm", "least_mm")

    std = Column("std", "Standard deviation now, in the unit of the deviation.", "tolerances")
    factor = Column("factor", "Factor of each tolerance; 1 if it may stay as it is.", "tolerances")
    share = Column("share", "Share of the variance that it causes, to first order.", "tolerances")
    halved_mm = Column("halved_mm", "Predicted quantile [mm] if it alone is halved.", "tolerances")
    cost = Column("cost", "Cost now; tightened, it is divided by the factor.", "tolerances")
    limit_mm = Value("limit_mm", "Limit of the error [mm].")
    least_mm = Value("least_mm", "The error without any deviation [mm]: no tolerance goes below it.")
    now = Value("now", "What the tolerances reach as they are, a dictionary: `quantile_mm`, `within`, ...")
    tightened = Value("tightened", "What the tightened tolerances reach, a dictionary as `now`.")

    @property
    def names(self) -> list[str]:
        """Entries of the error model."""
        return self.inputs


def tolerances(
    study: _inputs.Document,
    sampling: str,
    limit_mm: float,
    *,
    of: Optional[str] = None,
    quantile: float = 0.95,
    costs: Optional[Mapping[str, float]] = None,
    observations: int = 20_000,
    threads: Optional[int] = None,
) -> ToleranceBudget:
    """Finds the tolerances to tighten so that an error stays below a limit, as `cdpr study tolerances` does.

    study: study file, or its content as a dictionary, as `cdpr.study.run` takes it; its error model holds the
        tolerances.
    sampling: name of the sampling: pose, load and error model.
    limit_mm: limit of the error [mm].
    of: "deflection" by the load, or "position", the distance from the wanted pose without it; the study's output
        if left out.
    quantile: share of the robots that are to keep the limit.
    costs: of the tolerances as they are, by entry of the error model; 1 if left out. Half costs twice as much.
    observations: independent robots with which the budget is verified.
    threads: number of threads; all cores if left out.

    Raises InputError, FileError, NoSolutionError.
    """
    source, robot = _inputs.study(study)
    given = dict(_inputs.numbers(costs))
    text = _core.tolerances(source, robot, sampling, limit_mm, of, quantile, given, observations, threads)
    return ToleranceBudget(json.loads(text))


class Robustness:
    """How often the direct model finds the true pose from a wrong start.

    `content` is that of `robustness.json`, which is written to a folder.
    """

    def __init__(self, content: dict[str, Any]) -> None:
        #: Everything, as in `robustness.json`.
        self.content = content

    @property
    def protocols(self) -> list[str]:
        """Names of the protocols."""
        return list(self.content["protocols"])

    def found(self, protocol: str) -> tuple[int, int]:
        """Returns in how many solves of a protocol the true pose was found, and the number of all."""
        total = self.content["protocols"][protocol]["total"]
        return total["true_pose"], total["solves"]

    def to_dataframe(self) -> Any:
        """Returns a pandas.DataFrame with a row for each protocol and start offset."""
        import pandas

        rows = [{"protocol": name, **row} for name, of in self.content["protocols"].items() for row in of["rows"]]
        return pandas.DataFrame(rows)

    def plot(self) -> Any:
        """Draws the share of solves in which each protocol found the true pose; returns the matplotlib Figure."""
        from matplotlib import pyplot

        figure, axis = pyplot.subplots(layout="constrained")
        found = [self.found(name) for name in self.protocols]
        axis.bar(self.protocols, [100 * true / max(solves, 1) for true, solves in found])
        axis.set_ylabel("true pose found [%]")
        return figure

    def __repr__(self) -> str:
        parts = ["{} {} of {}".format(name, *self.found(name)) for name in self.protocols]
        return f"<cdpr.assess.Robustness of {self.content['robot']}: found {', '.join(parts)}>"


def robustness(
    robot: Robot,
    *,
    poses: int = 10_000,
    modulus: Optional[float] = None,
    region: Optional[tuple[Sequence[float], Sequence[float]]] = None,
    free: Optional[Sequence[str]] = None,
    seed: int = 2017,
    out: Optional[_inputs.Path] = None,
    overwrite: bool = False,
    progress: Optional[Callable[[int, int], object]] = None,
    threads: Optional[int] = None,
) -> Robustness:
    """Tests how often the direct model finds the true pose from a wrong start.

    poses: poses of the protocol of Mahnke and Caverly.
    modulus: Young's modulus of all cables in that protocol [Pa]; 35e9 for CoGiRo, else the robot's, if left out.
    region: least and greatest coordinates of the poses [m]; for CoGiRo the published ones, else the box of the
        exit points, if left out.
    free: names of the coordinates that are found, for a robot with fewer cables than free motions.
    seed: of poses and starts.
    out: folder for tables and figures.
    overwrite: replace the results that the folder has already.
    progress: function that is called with (done, all) from time to time. What it raises ends the test.
    threads: number of threads; all cores if left out.

    Raises InputError, FileError, NoSolutionError.
    """
    box = None if region is None else tuple([float(value) for value in corner] for corner in region)
    text = _core.robustness(robot, poses, modulus, box, _inputs.names(free), seed, out, overwrite, progress, threads)
    return Robustness(json.loads(text))


class LoadCycle:
    """A payload that is put on and taken off again, in SI units; `content` has everything."""

    def __init__(self, content: dict[str, Any]) -> None:
        #: All fields as lists.
        self.content = content

    def _array(self, name: str) -> NDArray[Any]:
        import numpy

        return numpy.array(self.content[name])

    @property
    def deflection(self) -> NDArray[Any]:
        """Displacement by the whole payload [m], (3,)."""
        return self._array("deflection")

    @property
    def residual(self) -> NDArray[Any]:
        """Displacement that is left when the payload is gone [m], (3,)."""
        return self._array("residual")

    @property
    def payload_work(self) -> float:
        """Energy that the payload gave [J]."""
        return float(self.content["payload_work"])

    @property
    def dissipated(self) -> NDArray[Any]:
        """Energy in the loop of each cable [J], (n,)."""
        return self._array("dissipated")

    @property
    def middle_tensions(self) -> NDArray[Any]:
        """Tension at the middle of each cable under own weight, with the payload, without it [N], (n, 3)."""
        return self._array("middle_tensions")

    @property
    def lengths(self) -> NDArray[Any]:
        """Unstrained lengths [m], (n,)."""
        return self._array("lengths")

    @property
    def payloads(self) -> NDArray[Any]:
        """Payload at each step, up and down again [kg], (steps,)."""
        return self._array("payloads")

    @property
    def positions(self) -> NDArray[Any]:
        """Position of P at each step [m], (steps, 3)."""
        return self._array("positions")

    @property
    def tensions(self) -> NDArray[Any]:
        """Tension of each cable at the platform at each step [N], (steps, n)."""
        return self._array("tensions")

    def to_dataframe(self) -> Any:
        """Returns a pandas.DataFrame with a row for each step: payload, position and tensions."""
        import pandas

        columns = {"payload": self.payloads, **dict(zip(("x", "y", "z"), self.positions.T))}
        columns.update((f"tensions_{k + 1}", column) for k, column in enumerate(self.tensions.T))
        return pandas.DataFrame(columns)

    def plot(self) -> Any:
        """Draws the payload over the way down, and returns the matplotlib Figure."""
        from matplotlib import pyplot

        figure, axis = pyplot.subplots(layout="constrained")
        down, turn = 1e3 * (self.positions[0, 2] - self.positions[:, 2]), self.content["turn"]
        axis.plot(down[:turn], self.payloads[:turn], label="payload put on")
        axis.plot(down[turn:], self.payloads[turn:], label="payload taken off")
        axis.set_xlabel("way down [mm]")
        axis.set_ylabel("payload [kg]")
        axis.legend()
        return figure

    def __repr__(self) -> str:
        return (
            f"<cdpr.assess.LoadCycle of {self.payloads.max():g} kg: {1e3 * -self.deflection[2]:.4f} mm down, "
            f"{1e3 * -self.residual[2]:.5f} mm stay, {self.payload_work:.4g} J given>"
        )


def hysteresis(
    robot: Robot,
    pose: ArrayLike,
    payload: float,
    *,
    record: Optional[_inputs.Table] = None,
    length: Optional[float] = None,
    section: Optional[float] = None,
    law: Optional[_inputs.Document] = None,
    unloading: str = "turning-point",
    steps: int = 50,
    free: Optional[Sequence[str]] = None,
) -> LoadCycle:
    """Puts a payload on the platform and takes it off again, as `cdpr hysteresis` does.

    pose: under the platform's own weight, (3,) or (7,).
    payload: mass that is put on the centre of mass [kg].
    record, length, section: load-elongation record of the cables, a file (CSV) or columns by their names as
        `modulus` takes it, length of its specimen [m] and its section [m^2], that of the cables if left out.
    law: file of a law (`cdpr-law/1`), or its content as a dictionary, in place of a record. Without both, the cables have the laws of the robot
        file, by which they lose no energy.
    unloading: the part of the unloading curve that a cable follows, from the "turning-point" or that of the
        "same-tension".
    steps: steps of the payload each way.
    free: names of the coordinates that are found, for a robot with fewer cables than free motions.

    Raises InputError, FileError, NoSolutionError.
    """
    measured = None if record is None else _inputs.table("record", record)
    known = None if law is None else _inputs.document("law", law)
    settings = (length, section, known, unloading, steps, _inputs.names(free))
    return LoadCycle(json.loads(_core.hysteresis(robot, pose, payload, measured, *settings)))


class Moduli(Table):
    """Secant moduli of a cable over ranges of load, in SI units."""

    _rows, _name, _drawn, _module = "ranges", "range", ("loading", "unloading"), "cdpr.assess"
    _shown = ("dissipated",)

    loading = Column("loading.modulus", "Modulus while the load grows [Pa].", "ranges")
    loading_standard = Column("loading.standard", "Its uncertainty from independent errors [Pa].", "ranges")
    loading_greatest = Column("loading.greatest", "Its uncertainty where all errors add up [Pa].", "ranges")
    unloading = Column("unloading.modulus", "Modulus while the load falls [Pa].", "ranges")
    unloading_standard = Column("unloading.standard", "Its uncertainty from independent errors [Pa].", "ranges")
    unloading_greatest = Column("unloading.greatest", "Its uncertainty where all errors add up [Pa].", "ranges")
    dissipated = Value("dissipated", "Energy of the loop of the specimen [J].")


def modulus(
    record: _inputs.Table,
    *,
    length: float,
    section: float,
    breaking_force: float,
    ranges: Sequence[tuple[float, float]],
    force_error: float = 1.0,
    elongation_error: float = 3e-5,
    length_error: float = 0.0,
    section_error: float = 0.0,
) -> Moduli:
    """Finds the moduli of a cable from a load-elongation record, as `cdpr cable modulus` does.

    record: CSV with the columns `force_n`, `elongation_mm` and `phase`, "loading" or "unloading"; or these columns
        by their names, a dictionary of arrays (m,) or a pandas.DataFrame.
    length, section, breaking_force: of the specimen [m, m^2, N].
    ranges: of load in percent of the breaking force, [(10, 30)].
    force_error, elongation_error, length_error, section_error: greatest errors [N, m, m, m^2].

    Raises InputError and FileError.
    """
    pairs = [(float(low), float(high)) for low, high in ranges]
    errors = (force_error, elongation_error, length_error, section_error)
    source = _inputs.table("record", record)
    return Moduli(json.loads(_core.modulus(source, length, section, breaking_force, pairs, *errors)))


def linear_density(
    mass: float, length: float, *, mass_error: float = 0.0, length_error: float = 0.0
) -> tuple[float, float]:
    """Returns the mass per length of a weighed piece of cable and its greatest error [kg/m].

    Raises InputError.
    """
    return _core.linear_density(mass, length, mass_error, length_error)
