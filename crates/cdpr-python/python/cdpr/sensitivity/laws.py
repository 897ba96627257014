"""Laws of inputs."""

from __future__ import annotations

from typing import Any

#: A law as in a study file, `{"uniform": {"min": 0, "max": 1}}`; one that `stepped` makes has its steps, too.
Law = dict[str, Any]


def uniform(min: float, max: float) -> Law:
    """Constant density on [min, max].

    Parameters
    ----------
    min : float
        Least value.
    max : float
        Greatest value.

    Returns
    -------
    dict
        The law, as a study file has it.

    Examples
    --------
    >>> uniform(0, 1)
    {'uniform': {'min': 0, 'max': 1}}
    """
    return {"uniform": {"min": min, "max": max}}


def normal(mean: float, std: float) -> Law:
    """Gauss's law.

    Parameters
    ----------
    mean : float
        Mean.
    std : float
        Standard deviation.

    Returns
    -------
    dict
        The law, as a study file has it.

    Examples
    --------
    >>> mean(normal(2.0, 0.5))
    2.0
    """
    return {"normal": {"mean": mean, "std": std}}


def truncated_normal(mean: float, std: float, min: float, max: float) -> Law:
    """Gauss's law restricted to [min, max]; mean and standard deviation are those of the unrestricted law.

    Parameters
    ----------
    mean : float
        Mean of the unrestricted law.
    std : float
        Standard deviation of the unrestricted law.
    min : float
        Least value.
    max : float
        Greatest value.

    Returns
    -------
    dict
        The law, as a study file has it.

    Examples
    --------
    >>> float(quantile(truncated_normal(0, 1, -1, 1), 0.5))
    0.0
    """
    return {"truncated_normal": {"mean": mean, "std": std, "min": min, "max": max}}


def triangular(min: float, mode: float, max: float) -> Law:
    """Density that rises linearly from min to mode and falls linearly to max.

    Parameters
    ----------
    min : float
        Least value.
    mode : float
        Most probable value.
    max : float
        Greatest value.

    Returns
    -------
    dict
        The law, as a study file has it.

    Examples
    --------
    >>> mean(triangular(0, 1, 2))
    1.0
    """
    return {"triangular": {"min": min, "mode": mode, "max": max}}


def beta(alpha: float, beta: float, min: float, max: float) -> Law:
    """Beta law on [min, max].

    Parameters
    ----------
    alpha : float
        First shape.
    beta : float
        Second shape.
    min : float
        Least value.
    max : float
        Greatest value.

    Returns
    -------
    dict
        The law, as a study file has it.

    Examples
    --------
    >>> mean(beta(2, 2, 0, 4))
    2.0
    """
    return {"beta": {"alpha": alpha, "beta": beta, "min": min, "max": max}}


def lognormal(log_mean: float, log_std: float) -> Law:
    """Law of a positive variable whose natural logarithm has this mean and standard deviation, and is normal.

    Parameters
    ----------
    log_mean : float
        Mean of the natural logarithm.
    log_std : float
        Standard deviation of the natural logarithm.

    Returns
    -------
    dict
        The law, as a study file has it.

    Examples
    --------
    >>> float(quantile(lognormal(0, 0.1), 0.5))
    1.0
    """
    return {"log_normal": {"log_mean": log_mean, "log_std": log_std}}


def weibull(shape: float, scale: float) -> Law:
    """Weibull's law of a positive variable, F = 1 - exp(-(x / scale)^shape).

    Parameters
    ----------
    shape : float
        Shape, without unit.
    scale : float
        Scale, in the unit of the variable.

    Returns
    -------
    dict
        The law, as a study file has it.

    Examples
    --------
    >>> round(mean(weibull(2, 1)), 4)
    0.8862
    """
    return {"weibull": {"shape": shape, "scale": scale}}


def exponential(scale: float) -> Law:
    """Exponential law of this mean: Weibull's of the shape 1.

    Parameters
    ----------
    scale : float
        Scale, in the unit of the variable.

    Returns
    -------
    dict
        The law, as a study file has it.

    Examples
    --------
    >>> mean(exponential(3.0))
    3.0
    """
    return weibull(1.0, scale)


def logistic(location: float, scale: float) -> Law:
    """Logistic law, F = 1 / (1 + exp(-(x - location) / scale)).

    Parameters
    ----------
    location : float
        Location, in the unit of the variable.
    scale : float
        Scale, in the unit of the variable.

    Returns
    -------
    dict
        The law, as a study file has it.

    Examples
    --------
    >>> mean(logistic(1.0, 0.2))
    1.0
    """
    return {"logistic": {"location": location, "scale": scale}}


def gumbel(location: float, scale: float) -> Law:
    """Gumbel's law of the largest value, F = exp(-exp(-(x - location) / scale)).

    Parameters
    ----------
    location : float
        Location, in the unit of the variable.
    scale : float
        Scale, in the unit of the variable.

    Returns
    -------
    dict
        The law, as a study file has it.

    Examples
    --------
    >>> round(mean(gumbel(0.0, 1.0)), 4)
    0.5772
    """
    return {"gumbel": {"location": location, "scale": scale}}


def laplace(location: float, scale: float) -> Law:
    """Laplace's law, density exp(-|x - location| / scale) / (2 scale).

    Parameters
    ----------
    location : float
        Location, in the unit of the variable.
    scale : float
        Scale, in the unit of the variable.

    Returns
    -------
    dict
        The law, as a study file has it.

    Examples
    --------
    >>> mean(laplace(1.0, 0.5))
    1.0
    """
    return {"laplace": {"location": location, "scale": scale}}


def stepped(law: Law, step: float, *, equal_mass: bool = False) -> Law:
    """A law whose values are rounded to steps about the middle of its range.

    Parameters
    ----------
    law : dict
        The law, as the functions of this module make it.
    step : float
        Distance of neighbouring values.
    equal_mass : bool, default False
        Whether each level of a uniform law has the same probability; otherwise the outermost two have
        half of it.

    Returns
    -------
    dict
        The law, as a study file has it.

    Examples
    --------
    >>> stepped(uniform(0, 1), 0.5)["steps"]
    {'nearest': {'step': 0.5}}
    """
    return {"law": law, "steps": {"equal_mass" if equal_mass else "nearest": {"step": step}}}
