"""Samples of the joint law of the inputs: points of sequences, Latin hypercubes, random rows."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import TYPE_CHECKING, Optional

from .. import _core
from ..errors import InputError
from .designs import _Sample
from .estimates import EffectIntervals, WassersteinBures
from .inputs import Correlation, Inputs

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class SobolDesign(_Sample):
    """Consecutive points of Sobol's sequence in the laws of k inputs.

    The sequence is plain or, with a seed, under a nested scrambling. Sizes of 2^m, from index 0, keep its
    balance.

    Parameters
    ----------
    inputs : dict
        Law of each input by its name (see `uniform`, `normal` and the other laws), or SALib's
        dictionary of a problem, whose groups are for the designs that have groups.
    points : int
        Number of rows.
    first_index : int, default 0
        Index of the first row in the plain sequence; 1 where a law has no lower end.
    seed : int, optional
        Seed of the scrambling; None for the plain sequence.
    correlation : array_like or dict, optional
        Of the normal scores of the inputs (Gaussian copula), a matrix (k, k) or those of pairs, {("x",
        "y"): 0.5}; independent inputs if left out.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.

    Examples
    --------
    >>> SobolDesign({"x": uniform(0, 1), "y": uniform(0, 2)}, 4).rows().tolist()[1]
    [0.5, 1.0]
    """

    _class = "SobolDesign"

    def __init__(
        self,
        inputs: Inputs,
        points: int,
        *,
        first_index: int = 0,
        seed: Optional[int] = None,
        correlation: Optional[Correlation] = None,
    ) -> None:
        self._made(inputs, points, correlation, first_index=first_index, seed=seed)


class HaltonDesign(_Sample):
    """Consecutive points of Halton's sequence, plain or, with a seed, under random permutations of digits.

    Arguments are as of `SobolDesign`.

    Parameters
    ----------
    inputs : dict
        Law of each input by its name, or SALib's dictionary of a problem.
    points : int
        Number of rows.
    first_index : int, default 0
        Index of the first row in the plain sequence.
    seed : int, optional
        Seed of all that is random.
    correlation : array_like or dict, optional
        Correlations of the normal scores of the inputs, a matrix (k, k) or those of pairs, {("x", "y"):
        0.5}; independent inputs if left out.

    Examples
    --------
    >>> HaltonDesign({"x": uniform(0, 1)}, 4).rows()[1:, 0].tolist()
    [0.5, 0.25, 0.75]
    """

    _class = "HaltonDesign"

    def __init__(
        self,
        inputs: Inputs,
        points: int,
        *,
        first_index: int = 0,
        seed: Optional[int] = None,
        correlation: Optional[Correlation] = None,
    ) -> None:
        self._made(inputs, points, correlation, first_index=first_index, seed=seed)


class LatinHypercubeDesign(_Sample):
    """A Latin hypercube: each input has one value in each of as many cells of equal probability as rows.

    Parameters
    ----------
    inputs : dict
        Law of each input by its name, or SALib's dictionary of a problem.
    points : int
        Number of rows.
    seed : int
        Seed of all that is random.
    centred : bool, default False
        Whether the values lie in the middle of their cells. Other arguments are as of `SobolDesign`.
    correlation : array_like or dict, optional
        Correlations of the normal scores of the inputs, a matrix (k, k) or those of pairs, {("x", "y"):
        0.5}; independent inputs if left out.

    Examples
    --------
    >>> rows = LatinHypercubeDesign({"x": uniform(0, 1)}, 4, seed=1, centred=True).rows()
    >>> sorted(rows[:, 0].tolist())
    [0.125, 0.375, 0.625, 0.875]
    """

    _class = "LatinHypercube"

    def __init__(
        self,
        inputs: Inputs,
        points: int,
        *,
        seed: int,
        centred: bool = False,
        correlation: Optional[Correlation] = None,
    ) -> None:
        self._made(inputs, points, correlation, seed=seed, centred=centred)


class RandomDesign(_Sample):
    """Independent random rows. Arguments are as of `SobolDesign`.

    Parameters
    ----------
    inputs : dict
        Law of each input by its name, or SALib's dictionary of a problem.
    points : int
        Number of rows.
    seed : int
        Seed of all that is random.
    correlation : array_like or dict, optional
        Correlations of the normal scores of the inputs, a matrix (k, k) or those of pairs, {("x", "y"):
        0.5}; independent inputs if left out.

    Examples
    --------
    >>> RandomDesign({"x": uniform(0, 1)}, 5, seed=1).rows().shape
    (5, 1)
    """

    _class = "RandomDesign"

    def __init__(
        self, inputs: Inputs, points: int, *, seed: int, correlation: Optional[Correlation] = None
    ) -> None:
        self._made(inputs, points, correlation, seed=seed)


def effect_intervals(
    replicates: Sequence[tuple[_Sample, ArrayLike]], *, level: float = 0.95
) -> EffectIntervals:
    """Estimates effects with intervals from designs that differ in their seeds, with an output a row of each.

    Parameters
    ----------
    replicates : sequence of (design, array_like)
        At least two designs with their outputs; see `SobolDesign.replicate`.
    level : float, default 0.95
        Confidence of the intervals.

    Returns
    -------
    EffectIntervals
        The effects with their intervals.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.

    Examples
    --------
    >>> design = SobolDesign({"x": uniform(0, 1)}, 64, seed=1)
    >>> designs = [design, design.replicate(2)]
    >>> effects = effect_intervals([(one, one.rows()[:, 0]) for one in designs])
    >>> effects.effect.round(1).tolist()
    [0.5]
    """
    samples, outputs = [design._native for design, _ in replicates], [given for _, given in replicates]
    return EffectIntervals({"inputs": json.loads(_core.effect_intervals(samples, outputs, level))})


def wasserstein_bures(
    rows: ArrayLike,
    outputs: ArrayLike,
    names: Optional[Sequence[str]] = None,
    *,
    level: float = 0.95,
    seed: int = 2017,
) -> WassersteinBures:
    """Estimates how much each input moves the law of a vector, its mean and its covariance, from any table.

    The rows are independent of each other, as those of `RandomDesign`: rows of a sequence are refused. The
    inputs may be correlated.

    Parameters
    ----------
    rows : array_like
        Values of the inputs, (n, k), at least 64 rows.
    outputs : array_like
        Components in a common unit, (n, m); a row with NaN has failed.
    names : sequence of str, optional
        Of the inputs; x1, x2, ... if left out.
    level : float, default 0.95
        Confidence of the intervals.
    seed : int, default 2017
        Deals the rows to the groups of the jackknife, which makes the intervals.

    Returns
    -------
    WassersteinBures
        The indices with their intervals.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.

    Examples
    --------
    >>> x = RandomDesign({"x": uniform(0, 1), "y": uniform(0, 1)}, 256, seed=1).rows()
    >>> wasserstein_bures(x, x * [3, 1]).index.shape
    (2,)
    """
    found = json.loads(_core.wasserstein_bures(rows, outputs, level, seed))
    given = [f"x{i + 1}" for i in range(len(found))] if names is None else list(names)
    if len(given) != len(found):
        raise InputError(f"names has {len(given)} names: expected {len(found)}, one for each input")
    return WassersteinBures({"inputs": [{"input": name, **of} for name, of in zip(given, found)]})
