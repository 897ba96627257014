"""The friction of pulleys from a table of tensions at the winches."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Optional

from .. import _core, _inputs
from .._core import Robot
from .._figures import axes_of
from ..assess.friction import FrictionFit

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class PulleyCalibration(FrictionFit):
    """Friction of pulleys from a table of tensions at the winches; `content` has everything."""

    _module = "cdpr.calibration"

    def __init__(self, content: dict[str, Any]) -> None:
        def pair(of: Mapping[str, float]) -> list[float]:
            return [of["value"], of["std"]]

        both = [content["friction"], content["bearing"]]
        found = {
            "coefficients": None if None in both else [pair(of) for of in both],
            "combined": pair(content["combined"]),
            "noise": content["noise_n"],
        }
        super().__init__({**content, **found})

    @property
    def rms(self) -> tuple[float, float]:
        """Root mean square of the residuals without friction, and with it [N]."""
        without, with_friction = self.content["rms_n"]
        return without, with_friction

    @property
    def readings(self) -> dict[str, NDArray[Any]]:
        """The m tensions that are compared, a dictionary of arrays (m,): line, cable, platform_n, ..."""
        import numpy

        rows = self.content["readings"]
        return {name: numpy.array([row[name] for row in rows]) for name in rows[0]}

    def to_dataframe(self) -> Any:
        """Returns the readings as a pandas.DataFrame with a row for each.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
        import pandas

        return pandas.DataFrame(self.readings)

    def plot(self, *, ax: Any = None) -> Any:
        """Draws what friction adds to each tension, as it is measured and modelled; returns the matplotlib Figure.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
        axis, of = axes_of(ax), self.readings
        for name, mark in (("measured", "."), ("modelled", "x")):
            axis.plot(of["platform_n"], of[f"{name}_n"] - of["platform_n"], mark, label=name)
        axis.set_xlabel("tension at the platform [N]")
        axis.set_ylabel("tension at the winch less that [N]")
        axis.legend()
        return axis.figure


def calibrate_pulleys(
    robot: Robot,
    measurements: _inputs.Table,
    pose: Optional[ArrayLike] = None,
    *,
    noise: Optional[Mapping[str, float]] = None,
    free: Optional[Sequence[str]] = None,
) -> PulleyCalibration:
    """Finds the friction of pulleys from tensions at the winches, as `cdpr calibrate pulleys` does.

    Parameters
    ----------
    robot : Robot
        The robot.
    measurements : path, dict of array_like or DataFrame
        Rows in the order in which they were measured: `t1_winch_n` ..., loads (`payload_kg`, ...) or
        poses, and `t1_n` ... at the platform or displacements (`dz_m`) where they were measured.
    pose : array_like, optional
        Pose of the platform under the load of the first row, (3,) or (7,); rows with positions need none.
    noise : dict of float, optional
        Standard deviations of the sensors [SI units], which weigh displacements against tensions.
    free : sequence of str, optional
        Coordinates that a robot with few cables finds itself.

    Returns
    -------
    PulleyCalibration
        Coefficients with standard deviations, or what is identifiable of them, and the residuals.

    Raises
    ------
    InputError
        The message names line and column.
    FileError
        For a file that cannot be read.
    NoSolutionError
        Where the robot has no answer.

    Examples
    --------
    >>> import cdpr
    >>> robot = cdpr.Robot.from_file("expo2015-lucia")
    >>> cycle = cdpr.assess.hysteresis(robot, [0, 0, 2], 50, friction=0.05, steps=10)
    >>> table = {f"t{i + 1}_winch_n": cycle.winch_tensions[:, i] for i in range(8)}
    >>> table["payload_kg"] = cycle.payloads
    >>> found = calibrate_pulleys(robot, table, [0, 0, 2])
    >>> found.rms[1] < 0.1 * found.rms[0]
    True
    """
    found = _core.calibrate_pulleys(
        robot,
        _inputs.table("measurements", measurements),
        pose,
        list(_inputs.numbers(noise)),
        _inputs.names(free),
    )
    return PulleyCalibration(json.loads(found))
