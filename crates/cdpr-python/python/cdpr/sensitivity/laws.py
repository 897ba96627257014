"""Laws of inputs, and laws fitted to a sample."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Optional

from .. import _core
from .._table import Column, Table

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

#: A law as in a study file, `{"uniform": {"min": 0, "max": 1}}`; one that `stepped` makes has its steps, too.
Law = dict[str, Any]


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


def lognormal(log_mean: float, log_std: float) -> Law:
    """Law of a positive variable whose natural logarithm has this mean and standard deviation, and is normal."""
    return {"log_normal": {"log_mean": log_mean, "log_std": log_std}}


def weibull(shape: float, scale: float) -> Law:
    """Weibull's law of a positive variable, F = 1 - exp(-(x / scale)^shape)."""
    return {"weibull": {"shape": shape, "scale": scale}}


def exponential(scale: float) -> Law:
    """Exponential law of this mean: Weibull's of the shape 1."""
    return weibull(1.0, scale)


def logistic(location: float, scale: float) -> Law:
    """Logistic law, F = 1 / (1 + exp(-(x - location) / scale))."""
    return {"logistic": {"location": location, "scale": scale}}


def gumbel(location: float, scale: float) -> Law:
    """Gumbel's law of the largest value, F = exp(-exp(-(x - location) / scale))."""
    return {"gumbel": {"location": location, "scale": scale}}


def laplace(location: float, scale: float) -> Law:
    """Laplace's law, density exp(-|x - location| / scale) / (2 scale)."""
    return {"laplace": {"location": location, "scale": scale}}


def stepped(law: Law, step: float, *, equal_mass: bool = False) -> Law:
    """A law whose values are rounded to steps about the middle of its range.

    equal_mass: whether each level of a uniform law has the same probability; otherwise the outermost two have
        half of it.
    """
    return {"law": law, "steps": {"equal_mass" if equal_mass else "nearest": {"step": step}}}


def cdf(law: Law, x: ArrayLike) -> NDArray[Any]:
    """Returns the probability of values up to x, an array as x."""
    return _core.law_values(law, "cdf", x)


def pdf(law: Law, x: ArrayLike) -> NDArray[Any]:
    """Returns the density at x, an array as x."""
    return _core.law_values(law, "pdf", x)


def quantile(law: Law, u: ArrayLike) -> NDArray[Any]:
    """Returns the value of which the probability is u in [0, 1], an array as u."""
    return _core.law_values(law, "quantile", u)


def mean(law: Law) -> float:
    """Returns the mean of a law."""
    return _core.law_moments(law)[0]


def std(law: Law) -> float:
    """Returns the standard deviation of a law."""
    return _core.law_moments(law)[1]


def poincare_constant(law: Law) -> Optional[float]:
    """Returns the least C with Var g <= C E g'^2 for all g of the variable; None where there is none."""
    return _core.law_moments(law)[2]


class Fits(Table):
    """Laws fitted to a sample by maximum likelihood, the smallest AIC first.

    `to_dataframe()` has a row for each family.
    """

    _rows, _name = "fits", "family"
    _drawn = ("probability", "p_value")

    probability = Column("probability", "Probability of each family among these.", "fits")
    p_value = Column("p_value", "Probability of such a Kolmogorov-Smirnov distance in this family.", "fits")
    ks_distance = Column("ks_distance", "Kolmogorov-Smirnov distance.", "fits")
    aic = Column("aic", "Akaike's criterion.", "fits")
    bic = Column("bic", "Schwarz's criterion.", "fits")
    log_likelihood = Column("log_likelihood", "Natural logarithm of the likelihood.", "fits")

    @property
    def families(self) -> list[str]:
        """Names of the families."""
        return self.inputs

    @property
    def laws(self) -> list[Law]:
        """The fitted law of each family."""
        return [fit["law"] for fit in self.content["fits"]]

    @property
    def best_family(self) -> str:
        """The family that fits best: the most probable one that is possible, if one is."""
        return str(self.content["best"]["family"])

    @property
    def best(self) -> Law:
        """The fitted law of that family, whether decided on or not."""
        return self.laws[self.families.index(self.best_family)]

    @property
    def evidence(self) -> str:
        """What the sample says of that family: "decided", "undecided" or "rejected".

        Decided: it alone is possible, with a probability of at least 0.95 and p above 0.05. Undecided: several are,
        or only one was fitted. Rejected: none is.
        """
        return str(self.content["best"]["evidence"])

    def __repr__(self) -> str:
        return f"{super().__repr__()[:-1]}; {self.content['verdict']}>"


def fit(
    values: ArrayLike, family: Optional[str] = None, *, resamples: int = 1000, seed: int = 2017
) -> Fits:
    """Fits laws to a sample: of one family, or of all that apply.

    values: the sample, (n,), at least three values; NaN is left out.
    family: "uniform", "normal", "logistic", "laplace", "gumbel", "log_normal" or "weibull".
    resamples, seed: samples of the bootstrap behind the p-values, and its seed.

    Raises InputError; NoSolutionError where the likelihood has no maximum.
    """
    return Fits(json.loads(_core.fit_laws(values, family, resamples, seed)))


def allocate(variances: ArrayLike, costs: ArrayLike, target: float) -> NDArray[Any]:
    """Returns by which factors to tighten tolerances so that a variance is left at the least cost.

    variances: what each causes of the variance, (k,). costs: of each as it is, (k,); half of it costs twice
    as much. target: the variance that is to be left.

    Raises InputError.
    """
    import numpy

    return _core.allocate(numpy.asarray(variances), numpy.asarray(costs), target)
