"""Functions of a law: probabilities, densities, quantiles, moments."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

from .. import _core
from .laws import Law

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


def cdf(law: Law, x: ArrayLike) -> NDArray[Any]:
    """Returns the probability of values up to x, an array as x.

    Parameters
    ----------
    law : dict
        The law, as the functions of this module make it.
    x : array_like
        Values, an array of any shape.

    Returns
    -------
    numpy.ndarray
        Probabilities, an array as x.

    Examples
    --------
    >>> cdf(uniform(0, 4), [1, 2]).tolist()
    [0.25, 0.5]
    """
    return _core.law_values(law, "cdf", x)


def pdf(law: Law, x: ArrayLike) -> NDArray[Any]:
    """Returns the density at x, an array as x.

    Parameters
    ----------
    law : dict
        The law, as the functions of this module make it.
    x : array_like
        Values, an array of any shape.

    Returns
    -------
    numpy.ndarray
        Densities, an array as x.

    Examples
    --------
    >>> float(pdf(uniform(0, 4), 1))
    0.25
    """
    return _core.law_values(law, "pdf", x)


def quantile(law: Law, u: ArrayLike) -> NDArray[Any]:
    """Returns the value of which the probability is u in [0, 1], an array as u.

    Parameters
    ----------
    law : dict
        The law, as the functions of this module make it.
    u : array_like
        Probabilities, an array of any shape.

    Returns
    -------
    numpy.ndarray
        Values, an array as u.

    Examples
    --------
    >>> quantile(uniform(0, 4), [0.25, 0.5]).tolist()
    [1.0, 2.0]
    """
    return _core.law_values(law, "quantile", u)


def mean(law: Law) -> float:
    """Returns the mean of a law.

    Parameters
    ----------
    law : dict
        The law, as the functions of this module make it.

    Returns
    -------
    float
        The mean.

    Examples
    --------
    >>> mean(uniform(0, 4))
    2.0
    """
    return _core.law_moments(law)[0]


def std(law: Law) -> float:
    """Returns the standard deviation of a law.

    Parameters
    ----------
    law : dict
        The law, as the functions of this module make it.

    Returns
    -------
    float
        The standard deviation.

    Examples
    --------
    >>> round(std(uniform(0, 1)), 4)
    0.2887
    """
    return _core.law_moments(law)[1]


def poincare_constant(law: Law) -> Optional[float]:
    """Returns the least C with Var g <= C E g'^2 for all g of the variable; None without such a C.

    Parameters
    ----------
    law : dict
        The law, as the functions of this module make it.

    Returns
    -------
    Optional
        The constant; None without one.

    Examples
    --------
    >>> round(poincare_constant(uniform(0, 1)), 4)
    0.1013
    """
    return _core.law_moments(law)[2]
