"""Designs of experiments for any model, and measures of sensitivity from its outputs.

A design is made from the law of each input by its name, or from SALib's dictionary of a problem. The model
runs at `design.rows()`, in any place and order of execution; its outputs, one for each row and NaN where the
model failed, go back into the same design.

>>> import numpy
>>> from cdpr.sensitivity import SaltelliDesign, uniform
>>> design = SaltelliDesign({"x": uniform(0, 1), "y": uniform(0, 2)}, 1024, seed=1)
>>> rows = design.rows()
>>> indices = design.indices(rows[:, 0] + rows[:, 1])
>>> numpy.round(indices.first, 2)
array([0.2, 0.8])
>>> list(design.indices({"sum": rows.sum(axis=1), "product": rows.prod(axis=1)}))
['sum', 'product']
"""

from __future__ import annotations

from .blocks import MorrisDesign, SaltelliDesign, ShapleyDesign
from .estimates import (
    ActiveSubspace,
    Brackets,
    DerivativeMeasures,
    EffectIntervals,
    Effects,
    Expansion,
    MorrisEffects,
    Regression,
    ShapleyEffects,
    SobolIndices,
    WassersteinBures,
)
from .fits import Fits, allocate, fit
from .inputs import laws_of_problem
from .law_functions import cdf, mean, pdf, poincare_constant, quantile, std
from .laws import (
    Law,
    beta,
    exponential,
    gumbel,
    laplace,
    logistic,
    lognormal,
    normal,
    stepped,
    triangular,
    truncated_normal,
    uniform,
    weibull,
)
from .samples import (
    HaltonDesign,
    LatinHypercubeDesign,
    RandomDesign,
    SobolDesign,
    effect_intervals,
    wasserstein_bures,
)

__all__ = [
    "ActiveSubspace",
    "Brackets",
    "DerivativeMeasures",
    "EffectIntervals",
    "Effects",
    "Expansion",
    "Fits",
    "HaltonDesign",
    "LatinHypercubeDesign",
    "Law",
    "MorrisDesign",
    "MorrisEffects",
    "RandomDesign",
    "Regression",
    "SaltelliDesign",
    "ShapleyDesign",
    "ShapleyEffects",
    "SobolDesign",
    "SobolIndices",
    "WassersteinBures",
    "allocate",
    "beta",
    "cdf",
    "effect_intervals",
    "exponential",
    "fit",
    "gumbel",
    "laplace",
    "laws_of_problem",
    "logistic",
    "lognormal",
    "mean",
    "normal",
    "pdf",
    "poincare_constant",
    "quantile",
    "std",
    "stepped",
    "triangular",
    "truncated_normal",
    "uniform",
    "wasserstein_bures",
    "weibull",
]
