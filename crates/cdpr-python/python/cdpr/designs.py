"""The best robot for poses and a load, and what has to be given up of one objective for another.

>>> import cdpr
>>> robot = cdpr.Robot.from_file("caroca")
>>> found = cdpr.design(
...     robot,
...     {
...         "format": "cdpr-design/1",
...         "variables": [{"parameters": ["b1.z", "b2.z"], "bounds": [3.0, 4.0]}],
...         "poses": {"list": [{"position": [0, 0, 1.75]}]},
...         "payload": 50,
...         "objective": {"output": "deflection", "over": "worst"},
...         "starts": 2,
...     },
... )
>>> found.objective < found.before and found.optimal
True
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Optional

from . import _core, _inputs
from ._core import Robot
from ._figures import axes_of, draw

if TYPE_CHECKING:
    import numpy
    from numpy.typing import NDArray

__all__ = ["Designed", "DesignFront", "design", "design_front"]

#: Units of the outputs; a cost is in any currency.
_UNITS = {"deflection": "mm", "position": "mm", "stiffness": "N/m", "tension": "N", "length": "m"}
_UNITS |= {"frequency": "Hz", "platform_frequency": "Hz"}
#: Outputs that are a single number for all poses.
_OF_ALL_POSES = ("length", "cost")


@dataclass(frozen=True, eq=False, repr=False)
class Designed:
    """The best robot that was found, for k variables and m poses.

    Where no robot counts, `robot` is None, numbers and arrays are NaN, and `reason` says why.

    Attributes
    ----------
    content : dict
        Everything, as `cdpr design --format json` prints it.
    robot : Robot or None
        The best robot.
    names : list of str
        Names of the variables.
    values : numpy.ndarray
        Their values in the best robot, in the SI unit of each, (k,).
    per_unit : numpy.ndarray
        By how much the objective changes for each unit by which an active bound is moved, zero within
        bounds, (k,).
    outputs : numpy.ndarray
        The output at each pose, in its unit: mm, N, N/m or Hz, (m,); of a length [m] or a cost, which are of all
        poses together, a single number, (1,).
    objective : float
        Their worst or mean.
    before : float
        That of the robot as it is; NaN where it is not held at every pose, and of a cost.
    kkt_residual : float
        Residual of the optimality conditions; NaN where nothing has bounds.
    gradient_error : float
        Error of derivatives by differences in it, for position errors; zero where all derivatives are
        exact.
    optimal : bool
        Whether the residual is small enough for a local optimum; of choices alone, whether there is a best
        one.
    reason : str or None
        Why there is no best robot.
    """

    content: dict[str, Any]
    robot: Optional[Robot]
    names: list[str]
    values: NDArray[numpy.float64]
    per_unit: NDArray[numpy.float64]
    outputs: NDArray[numpy.float64]
    objective: float
    before: float
    kkt_residual: float
    gradient_error: float
    optimal: bool
    reason: Optional[str]

    def __repr__(self) -> str:
        """Shows the objective before and after."""
        return f"Designed({self.content['output']}: {self.before:.6g} -> {self.objective:.6g})"

    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each variable.

        Returns
        -------
        pandas.DataFrame
            The frame: its unit, values before and after, the bound that it is on, what moving this changes.
        """
        import pandas

        best = self.content["best"] or {"variables": []}
        columns = ["name", "unit", "from", "to", "bound", "per_unit"]
        return pandas.DataFrame(best["variables"], columns=columns).set_index("name")

    def plot(self, *, ax: Any = None) -> Any:
        """Draws the output at each pose and the objective before, and returns the matplotlib Figure.

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
        draw(axis, self.outputs, (_label(self.content["output"]), "pose"), single=True)
        axis.axhline(self.before, color="k", linestyle="--", label=f"{self.content['over']} before")
        axis.legend()
        return axis.figure


@dataclass(frozen=True, eq=False, repr=False)
class DesignFront:
    """Robots of which none is better in both of two objectives: p points for k variables.

    Attributes
    ----------
    content : dict
        Everything, as `cdpr design --format json` prints it.
    robots : list of Robot
        The robots, from the best first objective to the best second one.
    names : list of str
        Names of the variables.
    objectives : numpy.ndarray
        Both objectives, in the units of their outputs, (p, 2).
    values : numpy.ndarray
        Values of the variables, in the SI unit of each, (p, k).
    exchange : numpy.ndarray
        By how much the first objective changes along the front for each unit of the second one, (p,); NaN
        at the ends, and where nothing has bounds.
    optimal : numpy.ndarray
        Whether the residual of the optimality conditions is small enough for a local optimum, (p,).
    """

    content: dict[str, Any]
    robots: list[Robot]
    names: list[str]
    objectives: NDArray[numpy.float64]
    values: NDArray[numpy.float64]
    exchange: NDArray[numpy.float64]
    optimal: NDArray[numpy.bool_]

    def __repr__(self) -> str:
        """Shows the outputs and the number of points."""
        return f"DesignFront({' against '.join(self.content['outputs'])}: {len(self.robots)} points)"

    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each point.

        Returns
        -------
        pandas.DataFrame
            The frame: both objectives as `worst_magnitude_mm`, the exchange, whether it is an optimum, the
            variables.
        """
        import pandas

        frame = pandas.DataFrame(self.objectives, columns=self.content["names"])
        frame["exchange"], frame["optimal"] = self.exchange, self.optimal
        return frame.join(pandas.DataFrame(self.values, columns=self.names))

    def plot(self, *, ax: Any = None) -> Any:
        """Draws the second objective over the first one, and returns the matplotlib Figure.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
        axis, (first, second) = axes_of(ax), map(_label, self.content["outputs"], self.content["over"])
        axis.plot(*self.objectives.T, "o-")
        axis.set(xlabel=first, ylabel=second)
        return axis.figure


def _label(output: str, over: str = "") -> str:
    """The label of an axis: an output with its unit."""
    unit = _UNITS.get(output)
    words = f"{'' if output in _OF_ALL_POSES else over} {output.replace('_', ' ')}".strip()
    return words if unit is None else f"{words} [{unit}]"


def design(robot: Robot, design: _inputs.Document, *, threads: Optional[int] = None) -> Designed:
    """Finds the values of a robot that make it as good as possible for poses and a load.

    The answer is that of `cdpr design`.

    Parameters
    ----------
    robot : Robot
        The robot as it is.
    design : path or dict
        Design file (`cdpr-design/1`), or its content as a dictionary: what may change, the poses, the load,
        what is to be as good as possible, and what is demanded.
    threads : int, optional
        Number of threads; all cores if left out. The answer does not depend on it.

    Returns
    -------
    Designed
        The best robot, and how far that can be relied on.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.
    FileError
        For a file or folder that cannot be read, written or used.

    Examples
    --------
    >>> import cdpr
    >>> wanted = {
    ...     "format": "cdpr-design/1",
    ...     "variables": [{"name": "height", "parameters": ["b1.z", "b2.z"], "choices": [3.0, 3.5]}],
    ...     "poses": {"list": [{"position": [0, 0, 1.75]}]},
    ...     "payload": 50,
    ...     "objective": {"output": "deflection", "over": "worst"},
    ... }
    >>> found = cdpr.design(cdpr.Robot.from_file("caroca"), wanted)
    >>> found.objective <= found.before and found.values.shape == (1,)
    True
    """
    import numpy

    text, robots = _core.design(robot, _inputs.document("design", design), False, threads)
    content = json.loads(text)
    best = content["best"] or {}
    variables = best.get("variables", [])

    def number(value: Any) -> float:
        return float("nan") if value is None else float(value)

    return Designed(
        content=content,
        robot=robots[0] if robots else None,
        names=[variable["name"] for variable in variables],
        values=numpy.array([variable["to"] for variable in variables], dtype=float),
        per_unit=numpy.array([variable["per_unit"] for variable in variables], dtype=float),
        outputs=numpy.array(best.get("outputs", []), dtype=float),
        objective=number(best.get("objective")),
        before=number(content["before"]),
        kkt_residual=number(best.get("kkt_residual")),
        gradient_error=number(best.get("gradient_error", 0.0)),
        optimal=bool(best.get("optimal", False)),
        reason=content["reason"],
    )


def design_front(robot: Robot, design: _inputs.Document, *, threads: Optional[int] = None) -> DesignFront:
    """Finds the Pareto front of both objectives of a design, as `cdpr design` does.

    Parameters
    ----------
    robot : Robot
        The robot as it is.
    design : path or dict
        Design file (`cdpr-design/1`) with a second objective, `pareto`, or its content as a dictionary.
    threads : int, optional
        Number of threads; all cores if left out. The answer does not depend on it.

    Returns
    -------
    DesignFront
        Robots of which none is better in both objectives; without points where no robot counts.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.
    FileError
        For a file or folder that cannot be read, written or used.

    Examples
    --------
    >>> import cdpr
    >>> wanted = {
    ...     "format": "cdpr-design/1",
    ...     "variables": [{"name": "height", "parameters": ["b1.z", "b2.z"], "choices": [3.0, 3.5]}],
    ...     "poses": {"list": [{"position": [0, 0, 1.75]}]},
    ...     "payload": 50,
    ...     "objective": {"output": "deflection", "over": "worst"},
    ...     "pareto": {"output": "stiffness", "over": "mean"},
    ... }
    >>> front = cdpr.design_front(cdpr.Robot.from_file("caroca"), wanted)
    >>> front.objectives.shape == (len(front.robots), 2)
    True
    """
    import numpy

    text, robots = _core.design(robot, _inputs.document("design", design), True, threads)
    content = json.loads(text)
    points, names = content["points"], [name for name, _ in content["variables"]]

    def array(key: str, *shape: int) -> Any:
        return numpy.array([point[key] for point in points], dtype=float).reshape(len(points), *shape)

    return DesignFront(
        content=content,
        robots=robots,
        names=names,
        objectives=array("objectives", 2),
        values=array("variables", len(names)),
        exchange=array("exchange"),
        optimal=numpy.array([point["optimal"] for point in points], dtype=bool),
    )
