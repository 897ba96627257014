"""What is odd about a robot file, which tolerances to tighten, how reliably a pose is found."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from os import fspath
from typing import Any, NamedTuple, Optional, Union

from .. import _core, _inputs
from .._core import Robot
from .._figures import axes_of
from .._table import Column, Table, Value


class Finding(NamedTuple):
    """Something odd about a robot, and yet no error.

    Attributes
    ----------
    severity : str
        "warning" for what is probably a mistake, "note" for what is worth knowing.
    field : str
        Field of the robot file.
    value : str
        Its value.
    why : str
        Why it is odd.
    remedy : str
        What would be right.
    """

    severity: str
    field: str
    value: str
    why: str
    remedy: str


def check(robot: Union[Robot, _inputs.Path]) -> list[Finding]:
    """Lists what is odd about a robot and yet no error, as `cdpr robot check` does.

    Parameters
    ----------
    robot : Robot or path
        A robot, a robot file, or a name of the library. A file is checked in whatever units it is, also
        where `Robot.from_file` refuses these.

    Returns
    -------
    list of Finding
        What is odd, warnings first.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.
    FileError
        For a file or folder that cannot be read, written or used.

    Examples
    --------
    >>> import cdpr
    >>> [finding.field for finding in cdpr.assess.check("four-cables")]
    ['cables']
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
    cost = Column("cost", "Cost as it is.", "tolerances")
    cost_then = Column("cost_then", "Cost with the factor.", "tolerances")
    mm_per_cost = Column(
        "mm_per_cost", "By how much the quantile falls for a further unit of the cost [mm].", "tolerances"
    )
    calibrations = Value(
        "calibrations", "Calibrations that have a price, dictionaries: `name`, `cost`, `bought`, `saves`."
    )
    limit_mm = Value("limit_mm", "Limit of the error [mm].")
    least_mm = Value("least_mm", "The error without any deviation [mm]: no tolerance goes below it.")
    explained = Value("explained", "Share of the variance that the linear law explains.")
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

    Parameters
    ----------
    study : path or dict
        Study file, or its content as a dictionary, as `cdpr.study.run` takes it; its error model holds
        the tolerances, and its `prices` what these and calibrations cost.
    sampling : str
        Name of the sampling: pose, load and error model.
    limit_mm : float
        Limit of the error [mm].
    of : str, optional
        "deflection" by the load, or "position", the distance from the wanted pose without it; the
        study's output if left out.
    quantile : float, default 0.95
        Share of the robots that are to keep the limit.
    costs : dict of float, optional
        Of the tolerances as they are, by entry of the error model; 1 if left out. Half costs twice as
        much. None where the study has prices.
    observations : int, default 20000
        Independent robots with which the budget is verified.
    threads : int, optional
        Number of threads; all cores if left out.

    Returns
    -------
    ToleranceBudget
        The tolerances, those to tighten most first.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.
    FileError
        For a file or folder that cannot be read, written or used.
    NoSolutionError
        Where there is no answer.

    Examples
    --------
    >>> import cdpr
    >>> study = cdpr.study.template(cdpr.Robot.from_file("cogiro"), [0, 0, 2], payload=40)
    >>> budget = cdpr.assess.tolerances(study, "all", 8.0, observations=200)  # [mm]
    >>> len(budget.factor) == len(budget.names)
    True
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
        """Returns in how many solves of a protocol the true pose was found, and the number of all.

        Parameters
        ----------
        protocol : str
            Name of the protocol.

        Returns
        -------
        tuple[int, int]
            Number of solves in which the true pose was found, and that of all.
        """
        total = self.content["protocols"][protocol]["total"]
        return total["true_pose"], total["solves"]

    def to_dataframe(self) -> Any:
        """Returns a pandas.DataFrame with a row for each protocol and start offset.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
        import pandas

        rows = [{"protocol": name, **row} for name, of in self.content["protocols"].items() for row in of["rows"]]
        return pandas.DataFrame(rows)

    def plot(self, *, ax: Any = None) -> Any:
        """Draws the share of solves in which each protocol found the true pose; returns the matplotlib Figure.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
        axis = axes_of(ax)
        found = [self.found(name) for name in self.protocols]
        axis.bar(self.protocols, [100 * true / max(solves, 1) for true, solves in found])
        axis.set_ylabel("true pose found [%]")
        return axis.figure

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

    Parameters
    ----------
    robot : Robot
        The robot.
    poses : int, default 10000
        Poses of the protocol of Mahnke and Caverly.
    modulus : float, optional
        Young's modulus of all cables in that protocol [Pa]; 35e9 for CoGiRo, else the robot's, if left
        out.
    region : (array_like, array_like), optional
        Least and greatest coordinates of the poses [m]; for CoGiRo the published ones, else the box of
        the exit points, if left out.
    free : sequence of str, optional
        Names of the coordinates that are found, for a robot with fewer cables than free motions.
    seed : int, default 2017
        Of poses and starts.
    out : path, optional
        Folder for tables and figures.
    overwrite : bool, default False
        Replace the results that the folder has already.
    progress : callable, optional
        Function that is called with (done, all) from time to time. What it raises ends the test.
    threads : int, optional
        Number of threads; all cores if left out.

    Returns
    -------
    Robustness
        What was found, by protocol.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.
    FileError
        For a file or folder that cannot be read, written or used.
    NoSolutionError
        Where there is no answer.

    Examples
    --------
    >>> import cdpr
    >>> result = cdpr.assess.robustness(cdpr.Robot.from_file("cogiro"), poses=2)
    >>> list(result.to_dataframe().columns[:1])
    ['protocol']
    """
    box = None if region is None else tuple([float(value) for value in corner] for corner in region)
    text = _core.robustness(robot, poses, modulus, box, _inputs.names(free), seed, out, overwrite, progress, threads)
    return Robustness(json.loads(text))
