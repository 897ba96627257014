"""What cables dissipate, their moduli and their mass."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Optional

from .. import _core, _inputs
from .._core import Robot
from .._figures import axes_of
from .._table import Column, Table, Value

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


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

    @property
    def gap(self) -> float:
        """Greatest distance of the ways up and down at the same payload [m]."""
        return float(self.content["gap"])

    def _of_pulleys(self, name: str) -> Optional[NDArray[Any]]:
        import numpy

        pulleys = self.content["pulleys"]
        return None if pulleys is None else numpy.array(pulleys[name])

    @property
    def winch_tensions(self) -> Optional[NDArray[Any]]:
        """Tension of each cable at its winch at each step [N], (steps, n); None without friction."""
        return self._of_pulleys("winch_tensions")

    @property
    def leave_tensions(self) -> Optional[NDArray[Any]]:
        """Tension of each cable where it leaves its pulley [N], (steps, n); None without friction."""
        return self._of_pulleys("leave_tensions")

    @property
    def wraps(self) -> Optional[NDArray[Any]]:
        """Angle over which each cable lies on its pulley [rad], (steps, n); None without friction."""
        return self._of_pulleys("wraps")

    @property
    def slips(self) -> Optional[NDArray[Any]]:
        """1 where cable runs to the winch, -1 to the platform, between them a wheel sticks, (steps, n)."""
        return self._of_pulleys("slips")

    def to_dataframe(self) -> Any:
        """Returns a pandas.DataFrame with a row for each step: payload, position and tensions.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
        import pandas

        columns = {"payload_kg": self.payloads, **dict(zip(("x_m", "y_m", "z_m"), self.positions.T))}
        columns.update((f"tension_{k + 1}_n", column) for k, column in enumerate(self.tensions.T))
        return pandas.DataFrame(columns)

    def plot(self, *, ax: Any = None) -> Any:
        """Draws the payload over the way down, and returns the matplotlib Figure.

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
        down, turn = 1e3 * (self.positions[0, 2] - self.positions[:, 2]), self.content["turn"]
        axis.plot(down[:turn], self.payloads[:turn], label="payload put on")
        axis.plot(down[turn:], self.payloads[turn:], label="payload taken off")
        axis.set_xlabel("way down [mm]")
        axis.set_ylabel("payload [kg]")
        axis.legend()
        return axis.figure

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
    friction: float = 0.0,
    bearing: float = 0.0,
) -> LoadCycle:
    """Puts a payload on the platform and takes it off again, as `cdpr hysteresis` does.

    Parameters
    ----------
    robot : Robot
        The robot.
    pose : array_like
        Under the platform's own weight, (3,) or (7,).
    payload : float
        Mass that is put on the centre of mass [kg].
    record : path, dict of array_like or DataFrame, optional
        load-elongation record of the cables, a file (CSV) or columns by their names as `modulus` takes
        it, length of its specimen [m] and its section [m^2], that of the cables if left out.
    length : float, optional
        load-elongation record of the cables, a file (CSV) or columns by their names as `modulus` takes
        it, length of its specimen [m] and its section [m^2], that of the cables if left out.
    section : float, optional
        load-elongation record of the cables, a file (CSV) or columns by their names as `modulus` takes
        it, length of its specimen [m] and its section [m^2], that of the cables if left out.
    law : path or dict, optional
        File of a law (`cdpr-law/1`), or its content as a dictionary, instead of a record. Without
        both, the cables have the laws of the robot file, by which they lose no energy.
    unloading : str, default 'turning-point'
        The part of the unloading curve that a cable follows, from the "turning-point" or that of the
        "same-tension".
    steps : int, default 50
        Steps of the payload each way.
    free : sequence of str, optional
        Names of the coordinates that are found, for a robot with fewer cables than free motions.
    friction : float, default 0.0
        Coefficient of the cables on the wheels of their pulleys, 0 to 1.
    bearing : float, default 0.0
        Friction radius of the bearing of a pulley (its radius times its coefficient) over the radius of
        the wheel, 0 to 0.5. With friction, cables without a law have a constant modulus.

    Returns
    -------
    LoadCycle
        States on the way up and down.

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
    >>> law = {"section": 1.2e-5, "loading": [{"tension": 0.0, "modulus": 1e11}]}
    >>> cycle = cdpr.assess.hysteresis(
    ...     cdpr.Robot.from_file("caroca"), [0, 0, 1.75], 50, law={"format": "cdpr-law/1", "law": law}, steps=5
    ... )
    >>> cycle.positions.shape  # [m]
    (12, 3)
    """
    measured = None if record is None else _inputs.table("record", record)
    known = None if law is None else _inputs.document("law", law)
    settings = (length, section, known, unloading, steps, _inputs.names(free), friction, bearing)
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

    Parameters
    ----------
    record : path, dict of array_like or DataFrame
        CSV with the columns `force_n`, `elongation_mm` and `phase`, "loading" or "unloading"; or these
        columns by their names, a dictionary of arrays (m,) or a pandas.DataFrame.
    length, section, breaking_force : float
        Of the specimen [m, m^2, N].
    ranges : sequence of (float, float)
        Of load in percent of the breaking force, [(10, 30)].
    force_error : float, default 1.0
        greatest errors [N, m, m, m^2].
    elongation_error : float, default 3e-05
        greatest errors [N, m, m, m^2].
    length_error : float, default 0.0
        greatest errors [N, m, m, m^2].
    section_error : float, default 0.0
        greatest errors [N, m, m, m^2].

    Returns
    -------
    Moduli
        Moduli with their uncertainties, a row for each range.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.
    FileError
        For a file or folder that cannot be read, written or used.

    Examples
    --------
    >>> import cdpr
    >>> record = {
    ...     "force_n": [0, 500, 1000, 500, 0],
    ...     "elongation_mm": [0.0, 0.5, 1.0, 0.5, 0.0],
    ...     "phase": ["loading", "loading", "loading", "unloading", "unloading"],
    ... }
    >>> moduli = cdpr.assess.modulus(
    ...     record, length=1.0, section=1e-5, breaking_force=10000, ranges=[(1, 9)]
    ... )
    >>> moduli.loading.round(-6).tolist()  # [Pa]
    [100000000000.0]
    """
    pairs = [(float(low), float(high)) for low, high in ranges]
    errors = (force_error, elongation_error, length_error, section_error)
    source = _inputs.table("record", record)
    return Moduli(json.loads(_core.modulus(source, length, section, breaking_force, pairs, *errors)))


def linear_density(
    mass: float, length: float, *, mass_error: float = 0.0, length_error: float = 0.0
) -> tuple[float, float]:
    """Returns the mass per length of a weighed piece of cable and its greatest error [kg/m].

    Parameters
    ----------
    mass : float
        Mass of the piece [kg].
    length : float
        Length of the piece [m].
    mass_error : float, default 0.0
        Greatest error of the mass [kg].
    length_error : float, default 0.0
        Greatest error of the length [m].

    Returns
    -------
    tuple
        The mass per length, and its greatest error.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.

    Examples
    --------
    >>> import cdpr
    >>> cdpr.assess.linear_density(0.2, 2.0)  # [kg/m]
    (0.1, 0.0)
    """
    return _core.linear_density(mass, length, mass_error, length_error)
