"""What is estimated from the outputs of a model at the rows of a design."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from .. import _core
from .._table import Column, Interval, Table, Value

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray


class Effects(Table):
    """Effects of k inputs by halves of their domains."""

    _rows, _drawn, _shown = "effects", ("effect",), ("mean", "std", "failed")

    effect = Column("effect", "Mean output in the upper half minus that in the lower half, (k,).", "effects")
    student = Column(
        "student",
        "The paper's t-Student index, (k,). On points of a sequence its significance levels do not hold.",
        "effects",
    )
    mean = Value("outputs.mean", "Mean of the outputs.")
    std = Value("outputs.std", "Standard deviation of the outputs, with n - 1.")
    failed = Value("outputs.failed", "Number of observations without an output.")


class EffectIntervals(Table):
    """Effects of k inputs with intervals, from designs that differ in their seeds."""

    _drawn = ("effect",)

    effect = Column("effect", "Mean effect, (k,).")
    effect_interval = Interval("", "Student's intervals of these, (k, 2).")
    standard_error = Column("standard_error", "Standard error of the mean effect, (k,).")


class Regression(Table):
    """Linear model of standardized values, or of their ranks."""

    _drawn, _shown = ("standardized",), ("r_squared",)

    standardized = Column("standardized", "Standardized coefficients (SRC; SRRC of ranks), (k,).")
    share = Column("share", "Squares of these: shares of the variance if the model is linear, (k,).")
    partial = Column("partial", "Partial correlations (PCC; PRCC of ranks), (k,).")
    r_squared = Value("r_squared", "Share of the variance that the linear model explains.")
    observed = Value("observed", "Number of outputs.")
    failed = Value("failed", "Number of observations without an output.")


class SobolIndices(Table):
    """Sobol' indices of k inputs, or of groups of these, with intervals."""

    _drawn, _shown = ("total", "first"), ("variance", "blocks")

    first = Column("first.value", "Share of the variance that each input causes alone, (k,).")
    first_interval = Interval("first", "Intervals of these, (k, 2).")
    total = Column("total.value", "Share of the variance that each input takes part in, (k,).")
    total_interval = Interval("total", "Intervals of these, (k, 2).")
    second = Column(
        "second.value",
        "Share of the variance that each pair causes together beyond what each causes alone, (pairs,).",
        "pairs",
    )
    second_interval = Interval("second", "Intervals of these, (pairs, 2).", "pairs")
    variance = Value("variance", "Variance of the output; of an output of several components their sum.")
    level = Value("level", "Confidence of the intervals.")
    blocks = Value("blocks", "Number of blocks of the design.")
    failed_blocks = Value("failed_blocks", "Number of blocks with a failed output.")
    reliable = Value("reliable", "Whether the intervals have their level: with a seed, from 64 blocks on.")

    @property
    def pairs(self) -> list[tuple[str, str]]:
        """Names of the pairs of inputs; empty unless the design has pairs."""
        return [(one, other) for one, other in (pair["inputs"] for pair in self.content["pairs"])]

    @property
    def input_blocks(self) -> list[int]:
        """Number of blocks behind the indices of each input."""
        return [row["blocks"] for row in self.content["inputs"]]


class MorrisEffects(Table):
    """Morris's elementary effects of k inputs, or of groups of these, in the unit of the output."""

    _drawn = ("mean_absolute", "std")

    mean = Column("mean", "mu: mean, (k,). Of a group of several inputs it says nothing.")
    mean_absolute = Column("mean_absolute.value", "mu*: mean of absolute values, (k,).")
    mean_absolute_interval = Interval("mean_absolute", "Intervals of these, (k, 2).")
    std = Column("std", "sigma: standard deviation, (k,).")
    reliable = Column(
        "reliable",
        "Whether the intervals have their level, (k,): not where few effects decide the mean, 1 for yes.",
    )
    failed = Column("failed", "Number of effects lost to failed observations, (k,).")


class ShapleyEffects(Table):
    """Shapley effects of k inputs, or of groups of these: shares of the variance that add up to 1."""

    _drawn = ("effect",)

    effect = Column("effect.value", "Share of the variance, (k,). Correlated inputs share what they explain.")
    effect_interval = Interval("effect", "Intervals of these, (k, 2).")
    walks = Column("walks", "Number of walks behind each, (k,).")


class DerivativeMeasures(Table):
    """Derivative-based measures (DGSM) of k inputs, and the bounds that they set on total indices."""

    _drawn, _shown = ("total_bound",), ("variance", "failed")

    mean_square = Column("mean_square.value", "Mean square of the derivative, (k,).")
    mean_square_interval = Interval("mean_square", "Intervals of these, (k, 2).")
    total_bound = Column(
        "total_bound.value",
        "Upper bound of the total index by Poincare's inequality, (k,); NaN for a law without a constant.",
    )
    total_bound_interval = Interval("total_bound", "Intervals of these, (k, 2).")
    reliable = Column("reliable", "Whether enough rows decide the mean square for the intervals to hold, (k,).")
    variance = Value("variance", "Variance of the output.")
    observed = Value("observed", "Number of outputs with a gradient.")
    failed = Value("failed", "Number of observations without an output or gradient.")


class Brackets(Table):
    """Bounds of the Sobol' indices of k inputs, from outputs and gradients.

    They hold up to their intervals: first_lower <= S <= total_upper, total_lower <= T <= total_upper.
    """

    _drawn = ("total_upper", "total_lower", "first_lower")

    first_lower = Column("first_lower.value", "Lower bound of the first-order index, (k,).")
    first_lower_interval = Interval("first_lower", "Intervals of these, (k, 2).")
    total_lower = Column("total_lower.value", "Lower bound of the total index, (k,).")
    total_lower_interval = Interval("total_lower", "Intervals of these, (k, 2).")
    total_upper = Column("total_upper.value", "Upper bound of both indices, (k,).")
    total_upper_interval = Interval("total_upper", "Intervals of these, (k, 2).")


class ActiveSubspace(Table):
    """Directions of all k inputs along which the output varies, from gradients."""

    _drawn, _shown = ("activity",), ("observed",)

    activity = Column("activity", "Share of each input in the mean square of the slopes, (k,).")
    eigenvalues = Column("value", "Mean square of the slope in each direction, descending, (k,).", "eigenvalues")
    eigenvalues_interval = Interval("", "Intervals of these, (k, 2).", "eigenvalues")
    observed = Value("observed", "Number of outputs with a gradient.")
    needed = Value(
        "needed",
        "By share of the sum of all eigenvalues the number of directions that have it, with the ends of its "
        "interval: {0.9: [1, 1, 2]}.",
    )

    @property
    def directions(self) -> NDArray[Any]:
        """Unit direction of each eigenvalue, a row of one component for each input, (k, k).

        A component belongs to an input in standard deviations.
        """
        import numpy

        return numpy.array(self.content["directions"])


class WassersteinBures(Table):
    """How much each of k inputs moves the law of a vector: its mean and its covariance."""

    _drawn = ("index",)

    index = Column("index.value", "Index of Wasserstein and Bures, 0 to 1, (k,).")
    index_interval = Interval("index", "Intervals of these, (k, 2).")
    means = Column("means.value", "Part of it by the means: half of the generalized S, (k,).")
    means_interval = Interval("means", "Intervals of these, (k, 2).")


class Expansion(Table):
    """A sparse polynomial chaos expansion of the output in k inputs."""

    _drawn, _shown = ("total", "first"), ("variance", "degree", "leave_one_out")

    def __init__(self, native: _core.Expansion) -> None:
        self._native = native
        super().__init__(json.loads(native.summary()))

    first = Column("first", "Share of the variance that each input causes alone, (k,).")
    total = Column("total", "Share of the variance that each input takes part in, (k,).")
    mean = Value("mean", "Mean of the output.")
    variance = Value("variance", "Variance of the output.")
    degree = Value("degree", "Degree of the expansion.")
    terms = Value("terms", "Number of terms without the mean.")
    derivatives = Value("derivatives", "Whether gradients took part in the fit.")
    leave_one_out = Value("leave_one_out", "Leave-one-out error, as a share of the variance of the outputs.")
    observed = Value("observed", "Number of outputs.")
    failed = Value("failed", "Number of observations without an output.")

    @property
    def pairs(self) -> list[tuple[str, str]]:
        """Names of the pairs of inputs that occur in a term."""
        return [(one, other) for one, other in (pair["inputs"] for pair in self.content["pairs"])]

    second = Column("share", "Share of the variance that each of these pairs causes together, (pairs,).", "pairs")

    def group(self, names: Sequence[str]) -> tuple[float, float]:
        """Returns the shares of the variance that inputs cause among themselves, and take part in.

        Parameters
        ----------
        names : sequence of str
            Names of the inputs of the group.

        Returns
        -------
        tuple
            The shares: closed, and total.

        Raises
        ------
        InputError
            For a name that no input has.
        """
        return self._native.group(list(names))

    def predict(self, rows: ArrayLike) -> NDArray[Any]:
        """Evaluates the expansion at rows of values of the inputs, (m, k): m outputs.

        Parameters
        ----------
        rows : array_like
            Values of the inputs, (m, k).

        Returns
        -------
        numpy.ndarray
            Outputs, (m,).

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right.
        """
        return self._native.predict(rows)
