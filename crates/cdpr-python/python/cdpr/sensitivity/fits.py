"""Laws fitted to a sample, and the share of a variance among tolerances."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Optional

from .. import _core
from .._table import Column, Table
from .laws import Law

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


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

    Parameters
    ----------
    values : array_like
        The sample, (n,), at least three values; NaN is left out.
    family : str, optional
        "uniform", "normal", "logistic", "laplace", "gumbel", "log_normal" or "weibull".
    resamples : int, default 1000
        samples of the bootstrap behind the p-values, and its seed.
    seed : int, default 2017
        samples of the bootstrap behind the p-values, and its seed.

    Returns
    -------
    Fits
        Laws, the smallest AIC first.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.
    NoSolutionError
        Where the likelihood has no maximum.

    Examples
    --------
    >>> fits = fit(quantile(normal(0, 1), [k / 200 for k in range(1, 200)]), "normal", resamples=100)
    >>> fits.best_family
    'normal'
    """
    return Fits(json.loads(_core.fit_laws(values, family, resamples, seed)))


def allocate(variances: ArrayLike, costs: ArrayLike, target: float) -> NDArray[Any]:
    """Returns by which factors to tighten tolerances so that a variance is left at the least cost.

    Parameters
    ----------
    variances : array_like
        What each causes of the variance, (k,). costs: of each as it is, (k,); half of it costs twice as
        much. target: the variance that is to be left.
    costs : array_like
        Cost of each as it is, (k,); half of it costs twice as much.
    target : float
        Variance that is to be left.

    Returns
    -------
    numpy.ndarray
        Factors, (k,), at most 1.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.

    Examples
    --------
    >>> allocate([3.0, 1.0], [1.0, 1.0], target=2.0).round(2).tolist()
    [0.63, 0.9]
    """
    import numpy

    return _core.allocate(numpy.asarray(variances), numpy.asarray(costs), target)
