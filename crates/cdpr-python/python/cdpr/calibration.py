"""Calibration: from measurements to a better robot, and to the accuracy that is left.

The files are those of `cdpr calibrate fit`, byte for byte.

>>> import cdpr
>>> robot = cdpr.Robot.from_file("data/robots/caroca.json")
>>> summary = cdpr.calibration.calibrate(
...     robot,
...     "measurements.csv",
...     out="calibrated",
...     model="data/calibration/caroca-tolerances.json",
...     noise={"position": 1e-4, "rotation": 1e-4, "length": 1e-4},
... )
>>> summary["parameters"]["a1.x"]["after"]
"""

from __future__ import annotations

import json
from os import PathLike
from typing import Any, Mapping, Optional, Sequence, Union

from numpy.typing import ArrayLike

from ._core import Robot
from ._core import calibrate as _calibrate
from ._core import calibration_plan as _plan
from ._core import identify as _identify
from ._core import simulate as _simulate

__all__ = ["calibrate", "calibration_plan", "identify", "simulate"]

_Path = Union[str, "PathLike[str]"]


def calibrate(
    robot: Robot,
    measurements: _Path,
    out: _Path,
    *,
    noise: Mapping[str, float] = {},
    model: Optional[_Path] = None,
    parameters: Sequence[str] = (),
    share: Sequence[str] = (),
    unknown: Mapping[str, Optional[float]] = {},
    bounds: Mapping[str, tuple[float, float]] = {},
    markers: Sequence[Sequence[float]] = (),
    loss: str = "squares",
    starts: int = 3,
    seed: int = 1,
    only_identifiable: bool = False,
    folds: int = 5,
    overwrite: bool = False,
    threads: Optional[int] = None,
) -> dict[str, Any]:
    """Fit the parameters of a robot to measurements; write all results to a folder and return the summary.

    measurements: CSV with units in its header, or JSON, as `cdpr calibrate fit` reads them.
    out: folder of the results; made if missing.
    noise: standard deviations of the sensors [SI units]: {"position": 1e-4, "length": 1e-4}, and covariances
        of two columns: {"cov_x_m_y_m": 5e-9}.
    model: file of an error model with the tolerances, the prior; without one all anchor and exit points,
        mass and modulus are sought without prior.
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

    The dictionary is that of `summary.json`. Raises InputError, which names line and column, FileError, and
    NoSolutionError.
    """
    text = _calibrate(
        robot,
        measurements,
        out,
        list(noise.items()),
        model,
        list(parameters),
        list(share),
        list(unknown.items()),
        [(name, (float(least), float(most))) for name, (least, most) in bounds.items()],
        [tuple(marker) for marker in markers],
        loss,
        starts,
        seed,
        only_identifiable,
        folds,
        overwrite,
        threads,
    )
    summary: dict[str, Any] = json.loads(text)
    return summary


def identify(
    robot: Robot,
    poses: ArrayLike,
    *,
    uncertainty: Mapping[str, float],
    noise: Mapping[str, float],
    payload: float = 0.0,
    free: Optional[Sequence[str]] = None,
) -> dict[str, Any]:
    """Find the combinations of uncertain parameters that measurements at poses identify.

    poses: (m, 3) or (m, 7); those that the robot does not hold are left out.
    uncertainty: standard deviations of parameters or groups [SI units]: {"a": 0.002, "mass": 0.5}.
    noise: {"position": 1e-4, "rotation": 1e-4}, "tensions" [N], "lengths" [m]: what is measured.
    payload: known mass added at the platform's centre of mass [kg].
    free: names of the coordinates that are found, for a robot with few cables.

    The dictionary has `poses` (those held), `identifiable` and `unidentifiable` (combinations with
    `signal_to_noise` and `weights` by parameter) and `remaining`: the standard deviation of each parameter
    after such measurements over that before. Raises InputError.
    """
    free = None if free is None else list(free)
    text = _identify(robot, poses, list(uncertainty.items()), list(noise.items()), payload, free)
    found: dict[str, Any] = json.loads(text)
    return found


def calibration_plan(
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
) -> dict[str, Any]:
    """Choose the poses that together leave least uncertainty, beside random and outermost ones.

    poses: candidates, (m, 3) or (m, 7).
    uncertainty, noise, payload, free: as `identify` takes them.
    count: number of poses.
    criterion: "information" (D-optimal), "parameters" (A-optimal), "mean-at-work" or "worst-at-work".
    work: poses where the robot works, (k, 3) or (k, 7); `of` is what is to be exact there: "position" with
        given lengths, or "deflection" by the payload.
    seed: of the random sets.

    The dictionary has `candidates` (those held), `poses`, what the `plan`, `random` sets in the median and
    the `outermost` poses leave, and `growing`: what the first 1, 2, 3 ... poses leave. Raises InputError.
    """
    free = None if free is None else list(free)
    text = _plan(
        robot,
        poses,
        list(uncertainty.items()),
        list(noise.items()),
        count,
        criterion,
        work,
        of,
        payload,
        free,
        seed,
    )
    found: dict[str, Any] = json.loads(text)
    return found


def simulate(
    robot: Robot,
    poses: ArrayLike,
    out: _Path,
    *,
    model: _Path,
    noise: Mapping[str, float],
    unknown: Mapping[str, float] = {},
    markers: Sequence[Sequence[float]] = (),
    tension_at: str = "platform",
    payload: float = 0.0,
    free: Optional[Sequence[str]] = None,
    seed: int = 1,
    overwrite: bool = False,
) -> Robot:
    """Write what a campaign would read with a robot that deviates from its file; return that robot.

    robot: the robot as the controller knows it.
    poses: wanted poses, (m, 3) or (m, 7).
    out: file for the measurements (CSV), which `calibrate` reads.
    model: file of an error model with the tolerances, from which the deviations are drawn.
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
    return _simulate(
        robot,
        poses,
        out,
        model,
        list(noise.items()),
        list(unknown.items()),
        [tuple(marker) for marker in markers],
        tension_at,
        payload,
        None if free is None else list(free),
        seed,
        overwrite,
    )
