"""Designs of experiments for any model, and measures of sensitivity from its outputs.

A design is made from the law of each input by its name. The model runs at `design.rows()`, in any place and
order of execution; its outputs, one for each row and NaN where the model failed, go back into the same
design.

>>> import numpy
>>> from cdpr.sensitivity import SaltelliDesign, uniform
>>> design = SaltelliDesign({"x": uniform(0, 1), "y": uniform(0, 2)}, 1024, seed=1)
>>> rows = design.rows()
>>> indices = design.indices(rows[:, 0] + rows[:, 1])
>>> numpy.round(indices.first, 2)
array([0.2, 0.8])
"""

from __future__ import annotations

from ._core import (
    Effects,
    Expansion,
    MorrisDesign,
    MorrisEffects,
    SaltelliDesign,
    SobolDesign,
    SobolIndices,
)

__all__ = [
    "Effects",
    "Expansion",
    "Law",
    "MorrisDesign",
    "MorrisEffects",
    "SaltelliDesign",
    "SobolDesign",
    "SobolIndices",
    "beta",
    "normal",
    "triangular",
    "truncated_normal",
    "uniform",
]

#: A law as in a study file.
Law = dict[str, dict[str, float]]


def uniform(min: float, max: float) -> Law:
    """Constant density on [min, max]."""
    return {"uniform": {"min": min, "max": max}}


def normal(mean: float, std: float) -> Law:
    """Gauss's law."""
    return {"normal": {"mean": mean, "std": std}}


def truncated_normal(mean: float, std: float, min: float, max: float) -> Law:
    """Gauss's law restricted to [min, max]; mean and standard deviation are those of the unrestricted law."""
    return {"truncated_normal": {"mean": mean, "std": std, "min": min, "max": max}}


def triangular(min: float, mode: float, max: float) -> Law:
    """Density that rises linearly from min to mode and falls linearly to max."""
    return {"triangular": {"min": min, "mode": mode, "max": max}}


def beta(alpha: float, beta: float, min: float, max: float) -> Law:
    """Beta law on [min, max]."""
    return {"beta": {"alpha": alpha, "beta": beta, "min": min, "max": max}}
