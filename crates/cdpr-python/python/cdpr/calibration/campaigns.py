"""Simulated campaigns of measurements."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Optional, Union

from .. import _core, _inputs
from .._core import Robot

if TYPE_CHECKING:
    import numpy
    from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class Campaign:
    """A simulated campaign of measurements.

    Attributes
    ----------
    robot : Robot
        The robot as it truly is.
    measurements : dict of numpy.ndarray
        Columns of the measurements by their names, which `calibrate` takes: `l1_m`, `x_m`, ..., (m,) each.
    """

    robot: Robot
    measurements: dict[str, NDArray[numpy.float64]]

    def to_dataframe(self) -> Any:
        """Returns the measurements as a pandas.DataFrame.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
        import pandas

        return pandas.DataFrame(self.measurements)


def simulate(
    robot: Robot,
    poses: ArrayLike,
    out: Optional[_inputs.Path] = None,
    *,
    uncertainty: Union[Mapping[str, float], _inputs.Document],
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

    Parameters
    ----------
    robot : Robot
        The robot as the controller knows it.
    poses : array_like
        Wanted poses, (m, 3) or (m, 7).
    out : path, optional
        File for the measurements (CSV); without one nothing is written.
    uncertainty : path or dict
        The tolerances, from which the deviations are drawn: standard deviations by names of
        parameters or groups, {"a": 0.002}, or an error model, its content or its file.
    noise : dict of float
        Standard deviations of the sensors that are there: {"position": 1e-4, "length": 1e-4}.
    unknown : dict of float, optional
        Errors of sensors to draw, with their standard deviations: {"length_offset": 0.01}.
    markers : sequence of (float, float, float), optional
        Places of markers on the platform [m], (k, 3).
    tension_at : str, default 'platform'
        Where the load cells sit, "platform" or "winch".
    payload : float, default 0.0
        Mass added at the platform's centre of mass [kg].
    free : sequence of str, optional
        Names of the coordinates that are found, for a robot with few cables.
    seed : int, default 1
        Of deviations and noise.
    overwrite : bool, default False
        Replace the file if it exists.

    Returns
    -------
    Campaign
        The robot as it truly is, and the measurements.

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
    >>> campaign = simulate(
    ...     cdpr.Robot.from_file("cogiro"),
    ...     [[0, 0, 2], [1, 1, 2]],
    ...     uncertainty={"a": 0.002},  # [m]
    ...     noise={"length": 1e-4},  # [m]
    ... )
    >>> campaign.measurements["l1_m"].shape
    (2,)
    """
    truth, text = _core.simulate(
        robot,
        poses,
        out,
        _inputs.uncertainty(uncertainty),
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
