"""What measurements at poses identify, and which poses to measure."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Optional, Union

from .. import _core, _inputs
from .._core import Robot
from .._figures import axes_of
from .._table import Column, Table, Value

if TYPE_CHECKING:
    import numpy
    from numpy.typing import ArrayLike, NDArray


class Combination(Table):
    """A combination of k uncertain parameters, and how well measurements identify it."""

    _rows, _name, _drawn, _module = "parameters", "parameter", ("weight",), "cdpr.calibration"
    _shown = ("signal_to_noise",)

    weight = Column("weight", "Weight of each parameter, in its standard deviations, (k,).", "parameters")
    signal_to_noise = Value("signal_to_noise", "Its standard deviation before over that of the noise in it.")

    def __init__(self, content: dict[str, Any]) -> None:
        rows = [{"parameter": name, "weight": value} for name, value in content["weights"].items()]
        super().__init__({**content, "parameters": rows})

    @property
    def weights(self) -> dict[str, float]:
        """The weights by the names of the parameters."""
        return dict(self.content["weights"])


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
        return [Combination(of) for of in self.content["identifiable"]]

    @property
    def unidentifiable(self) -> list[Combination]:
        """Combinations that they do not."""
        return [Combination(of) for of in self.content["unidentifiable"]]


def identify(
    robot: Robot,
    poses: ArrayLike,
    *,
    uncertainty: Union[Mapping[str, float], _inputs.Document],
    noise: Mapping[str, float],
    payload: float = 0.0,
    free: Optional[Sequence[str]] = None,
) -> Identified:
    """Finds the combinations of uncertain parameters that measurements at poses identify.

    Parameters
    ----------
    robot : Robot
        The robot.
    poses : array_like
        (m, 3) or (m, 7); those that the robot does not hold are left out.
    uncertainty : path or dict
        Standard deviations of parameters or groups [SI units]: {"a": 0.002, "mass": 0.5}; or an error model
        with laws and correlations, its content as a dictionary or a file, such as the posterior of a fit.
    noise : dict of float
        Standard deviations of what is measured, "position" [m] and "rotation" [rad], "tension" [N],
        "length" [m]: {"position": 1e-4, "rotation": 1e-4}.
    payload : float, default 0.0
        Known mass added at the platform's centre of mass [kg].
    free : sequence of str, optional
        Names of the coordinates that are found, for a robot with few cables.

    Returns
    -------
    Identified
        What is identified, a row for each parameter.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.

    Examples
    --------
    >>> import cdpr
    >>> found = identify(
    ...     cdpr.Robot.from_file("cogiro"),
    ...     [[0, 0, 2], [1, 1, 2]],
    ...     uncertainty={"a": 0.002},  # [m]
    ...     noise={"position": 1e-4, "rotation": 1e-4},  # [m], [rad]
    ... )
    >>> found.remaining.shape
    (24,)
    """
    settings = (_inputs.uncertainty(uncertainty), _inputs.numbers(noise), payload, _inputs.names(free))
    found = json.loads(_core.identify(robot, poses, *settings))
    rows = [{"parameter": name, "remaining": value} for name, value in found["remaining"].items()]
    return Identified({**found, "parameters": rows})


@dataclass(frozen=True)
class Quality:
    """What measurements at a set of poses leave uncertain.

    Attributes
    ----------
    information_bits : float
        Information about the parameters [bit].
    parameters : float
        Root mean square of the standard deviations of the parameters after, each over that before.
    mean_at_work : float or None
        Root mean square of the standard deviation of a coordinate where the robot works [m]; None without `work`.
    worst_at_work : float or None
        The greatest standard deviation of a coordinate there [m].
    """

    information_bits: float
    parameters: float
    mean_at_work: Optional[float]
    worst_at_work: Optional[float]


class Plan:
    """The poses to measure, compared with random and outermost ones."""

    def __init__(self, content: dict[str, Any]) -> None:
        #: Everything, as JSON has it.
        self.content = content

    @property
    def poses(self) -> NDArray[numpy.float64]:
        """The poses, the most informative one first, (count, 7)."""
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
        """Returns a pandas.DataFrame with a row for each pose, and what the poses up to it leave.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
        import pandas

        places = pandas.DataFrame(self.poses, columns=["x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"])
        growing = pandas.DataFrame(self.content["growing"])
        return places.join(growing.rename(columns={name: f"{name}_m" for name in ("mean_at_work", "worst_at_work")}))

    def plot(self, *, ax: Any = None) -> Any:
        """Draws the information over the number of poses, and returns the matplotlib Figure.

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
        counts = range(1, len(self.growing) + 1)
        axis.plot(counts, [of.information_bits for of in self.growing], ".-", label="plan")
        for name, of in (("random", self.random), ("outermost", self.outermost)):
            axis.plot(len(self.growing), of.information_bits, "o", label=name)
        axis.set_xlabel("poses")
        axis.set_ylabel("information [bit]")
        axis.legend()
        return axis.figure

    def __repr__(self) -> str:
        bits = [of.information_bits for of in (self.quality, self.random)]
        return "<cdpr.calibration.Plan of {} poses: {:.4g} bit, at random {:.4g}>".format(len(self.poses), *bits)


def plan(
    robot: Robot,
    poses: ArrayLike,
    *,
    uncertainty: Union[Mapping[str, float], _inputs.Document],
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

    Parameters
    ----------
    robot : Robot
        The robot.
    poses : array_like
        candidates, (m, 3) or (m, 7).
    uncertainty : path or dict
        as `identify` takes them.
    noise : dict of float
        as `identify` takes them.
    count : int, default 20
        Number of poses.
    criterion : str, default 'information'
        "information" (D-optimal), "parameters" (A-optimal), "mean-at-work" or "worst-at-work".
    work : array_like, optional
        Poses where the robot works, (k, 3) or (k, 7).
    of : str, default 'position'
        What is to be exact there, "position" with given lengths, or "deflection" by the payload.
    payload : float, default 0.0
        as `identify` takes them.
    free : sequence of str, optional
        as `identify` takes them.
    seed : int, default 1
        Of the random sets.

    Returns
    -------
    Plan
        The poses, and what they leave uncertain.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.

    Examples
    --------
    >>> import cdpr
    >>> chosen = plan(
    ...     cdpr.Robot.from_file("cogiro"),
    ...     [[x, y, 2] for x in (-2, 0, 2) for y in (-2, 0, 2)],
    ...     uncertainty={"a": 0.002},  # [m]
    ...     noise={"position": 1e-4, "rotation": 1e-4},  # [m], [rad]
    ...     count=3,
    ... )
    >>> chosen.poses.shape
    (3, 7)
    """
    text = _core.plan(
        robot,
        poses,
        _inputs.uncertainty(uncertainty),
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
