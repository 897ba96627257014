"""The friction of pulleys from measured tensions."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Optional

from .. import _core

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class FrictionFit:
    """Friction of pulleys from measured tensions; `content` has everything."""

    _module = "cdpr.assess"

    def __init__(self, content: dict[str, Any]) -> None:
        #: All fields as lists.
        self.content = content

    def _coefficient(self, index: int) -> Optional[tuple[float, float]]:
        both = self.content["coefficients"]
        return None if both is None else (both[index][0], both[index][1])

    @property
    def friction(self) -> Optional[tuple[float, float]]:
        """Coefficient of the cables on the wheels and its standard deviation; None if not identifiable."""
        return self._coefficient(0)

    @property
    def bearing(self) -> Optional[tuple[float, float]]:
        """Coefficient of the bearings and its standard deviation; None if not identifiable."""
        return self._coefficient(1)

    @property
    def combination(self) -> NDArray[Any]:
        """Unit vector of the sum of friction and bearing that is identified best, (2,)."""
        import numpy

        return numpy.array(self.content["combination"])

    @property
    def combined(self) -> tuple[float, float]:
        """This sum and its standard deviation."""
        value, deviation = self.content["combined"]
        return value, deviation

    @property
    def noise(self) -> float:
        """Standard deviation of a measured tension, from the residuals [N]."""
        return float(self.content["noise"])

    def __repr__(self) -> str:
        if self.friction is None or self.bearing is None:
            (one, other), (value, deviation) = self.combination, self.combined
            said = (
                f"{one:.3f} friction + {other:.3f} bearing = {value:.5f} +- {deviation:.5f}; each of them "
                "is not identifiable, because the wraps differ too little for the noise"
            )
        else:
            said = ", ".join(
                f"{name} {value:.5f} +- {deviation:.5f}"
                for name, (value, deviation) in (("friction", self.friction), ("bearing", self.bearing))
            )
        return f"<{self._module}.{type(self).__name__}: {said}>"


def pulley_friction(
    wraps: ArrayLike, tensions: ArrayLike, winch_tensions: ArrayLike, slips: ArrayLike
) -> FrictionFit:
    """Fits the friction of pulleys to tensions on both sides of wheels that slip.

    Capstan and bearing act nearly alike: only wraps that differ identify both coefficients.

    Parameters
    ----------
    wraps : array_like
        Angles over which the cables lie on their wheels [rad], of any shape.
    tensions : array_like
        Tensions where the cables leave for the platform [N], of the same shape.
    winch_tensions : array_like
        Tensions measured at the winches [N], of the same shape.
    slips : array_like
        1 where cable runs towards the winch, -1 where it runs towards the platform, of the same shape.
        Readings with values between them, of wheels that stick, are left out.

    Returns
    -------
    FrictionFit
        Coefficients with standard deviations, or what is identifiable of them.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.

    Examples
    --------
    >>> import cdpr
    >>> robot = cdpr.Robot.from_file("expo2015-lucia")
    >>> cycle = cdpr.assess.hysteresis(robot, [0, 0, 2], 50, friction=0.05, bearing=0.01, steps=10)
    >>> fit = cdpr.assess.pulley_friction(
    ...     cycle.wraps, cycle.leave_tensions, cycle.winch_tensions, cycle.slips
    ... )
    >>> fit.combined[0] > 0
    True
    """
    import numpy

    given = (wraps, tensions, winch_tensions, slips)
    lists = [numpy.asarray(values, dtype=float).ravel() for values in given]
    slipping = numpy.abs(lists[3]) >= 1
    if all(len(values) == len(slipping) for values in lists):
        lists = [values[slipping] for values in lists]
    return FrictionFit(json.loads(_core.pulley_friction(*(values.tolist() for values in lists))))
