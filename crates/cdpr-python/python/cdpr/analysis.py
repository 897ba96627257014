"""What a table of inputs and outputs says, wherever it comes from.

>>> import numpy
>>> import cdpr
>>> x = numpy.random.default_rng(1).uniform(-1, 1, (500, 3))
>>> found = cdpr.analyse(x, x[:, 0] + 2 * x[:, 1] ** 2, names=["a", "b", "c"])
>>> found.inputs
['a', 'b', 'c']
>>> [name for name, p in zip(found.inputs, found.p_value) if p < 0.001]
['a', 'b']
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy

from ._core import analyse as _analyse
from .errors import InputError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import ArrayLike, NDArray

__all__ = ["Analysis", "analyse"]


class Analysis:
    """What a table says of one output. `content` holds all of it, as `cdpr analyse --json` prints it.

    Arrays have an element for each of the k inputs, NaN where a measure cannot be computed (see `notes`).
    """

    def __init__(self, output: str, content: dict[str, Any], x: NDArray[Any], y: NDArray[Any]) -> None:
        #: Name of the output.
        self.output = output
        #: Everything, as in `cdpr analyse --json`.
        self.content = content
        self._x, self._y = x, y

    @property
    def inputs(self) -> list[str]:
        """Names of the inputs."""
        return [of["input"] for of in self.content["inputs"]]

    @property
    def summary(self) -> dict[str, float]:
        """Count, failed, mean, std, min and max of the outputs."""
        return dict(self.content["summary"])

    @property
    def left_out(self) -> int:
        """Number of rows that are left out because an input is not finite."""
        return int(self.content["left_out"])

    @property
    def notes(self) -> list[str]:
        """What was left out, and what is not to be relied on."""
        return list(self.content["notes"])

    def _of(self, *path: str) -> NDArray[Any]:
        def value(of: Any) -> float:
            for key in path:
                of = None if of is None else of[key]
            return float("nan") if of is None else float(of)

        return numpy.array([value(of) for of in self.content["inputs"]])

    def _interval(self, *path: str) -> NDArray[Any]:
        return numpy.stack([self._of(*path, end) for end in ("low", "high")], axis=1)

    @property
    def effect(self) -> NDArray[Any]:
        """Mean output of the upper half of an input's values less that of the lower half."""
        return self._of("half", "effect")

    @property
    def student(self) -> NDArray[Any]:
        """Student's t of the effect, for independent rows."""
        return self._of("half", "student")

    @property
    def standardised(self) -> NDArray[Any]:
        """Standardised regression coefficients (SRC)."""
        return self._of("standardised")

    @property
    def rank_standardised(self) -> NDArray[Any]:
        """Standardised regression coefficients of ranks (SRRC)."""
        return self._of("rank_standardised")

    @property
    def first(self) -> NDArray[Any]:
        """First-order Sobol' indices by ranks."""
        return self._of("first", "value")

    @property
    def first_interval(self) -> NDArray[Any]:
        """Intervals of these, (k, 2)."""
        return self._interval("first")

    @property
    def expansion_first(self) -> NDArray[Any]:
        """First-order Sobol' indices of the polynomial model."""
        return self._of("shares", "closed")

    @property
    def expansion_total(self) -> NDArray[Any]:
        """Total Sobol' indices of the polynomial model."""
        return self._of("shares", "total")

    @property
    def dependence(self) -> NDArray[Any]:
        """R^2 of the Hilbert-Schmidt independence criterion (HSIC), from 0 to 1."""
        return self._of("dependence", "r_squared")

    @property
    def p_value(self) -> NDArray[Any]:
        """Probability of such a dependence without any."""
        return self._of("dependence", "p_value")

    @property
    def pawn(self) -> NDArray[Any]:
        """PAWN indices: median distances of Kolmogorov and Smirnov."""
        return self._of("pawn", "median")

    @property
    def pawn_noise(self) -> NDArray[Any]:
        """PAWN index that an input without an effect stays below in 95 of 100 tables."""
        return self._of("pawn", "noise")

    @property
    def delta(self) -> NDArray[Any]:
        """Borgonovo's delta."""
        return self._of("delta", "delta", "value")

    @property
    def delta_interval(self) -> NDArray[Any]:
        """Intervals of these, (k, 2)."""
        return self._interval("delta", "delta")

    @property
    def delta_noise(self) -> NDArray[Any]:
        """Delta that an input without an effect stays below in 95 of 100 tables."""
        return self._of("delta", "noise")

    @property
    def target(self) -> NDArray[Any]:
        """Dependence of the failure of the limit on each input, R^2; NaN without a limit."""
        return self._of("limit", "target", "r_squared")

    @property
    def target_p_value(self) -> NDArray[Any]:
        """Probability of such a dependence without any."""
        return self._of("limit", "target", "p_value")

    def to_dataframe(self) -> Any:
        """Returns a pandas.DataFrame with a row for each input."""
        import pandas

        columns = (
            "effect student standardised rank_standardised first expansion_first expansion_total dependence "
            "p_value pawn pawn_noise delta delta_noise"
        ).split()
        if self.content["limit"] is not None:
            columns += ["target", "target_p_value"]
        frame = pandas.DataFrame({name: getattr(self, name) for name in columns}, index=self.inputs)
        frame.index.name = "input"
        return frame

    def plot(self, most: int = 9) -> Any:
        """Draws the output against the leading inputs, and returns the matplotlib Figure."""
        from matplotlib import pyplot

        order = numpy.argsort(-numpy.nan_to_num(self.dependence))[:most]
        columns = min(3, len(order))
        rows = -(-len(order) // columns)
        figure, axes = pyplot.subplots(rows, columns, squeeze=False, sharey=True, layout="constrained")
        for axis, k in zip(axes.flat, order):
            axis.plot(self._x[:, k], self._y, ".", markersize=2)
            axis.set_xlabel(self.inputs[k])
        for axis in axes.flat[len(order) :]:
            axis.set_axis_off()
        for axis in axes[:, 0]:
            axis.set_ylabel(self.output)
        return figure

    def __repr__(self) -> str:
        of = self.summary
        order = numpy.argsort(-numpy.nan_to_num(self.dependence))[:3]
        leading = ", ".join(f"{self.inputs[k][:40]} {self.dependence[k]:.2f}" for k in order)
        return (
            f"<cdpr.analysis.Analysis of {self.output[:40]}: {of['count']} rows, {of['failed']} failed, "
            f"mean {of['mean']:.4g}, std {of['std']:.4g}; strongest (HSIC R^2): {leading}>"
        )


def analyse(
    X: ArrayLike,
    Y: ArrayLike,
    names: Sequence[str] | None = None,
    *,
    problem: Mapping[str, Any] | None = None,
    limit: tuple[str, float] | None = None,
    level: float = 0.95,
    seed: int = 2017,
    dependence_rows: int = 2000,
) -> Any:
    """Analyses rows of inputs and their outputs: which inputs matter, and how.

    X: values of the inputs, (n, k), or a pandas.DataFrame.
    Y: outputs, (n,), NaN where a row failed; or several outputs, (n, m) or a pandas.DataFrame.
    names: names of the inputs; those of the DataFrame, of `problem`, or x1, x2, ... if left out.
    problem: SALib's dictionary of a problem, for its `names`.
    limit: what the outputs are to satisfy, such as ("<", 1.4), with <, <=, > or >=.
    level: confidence level of the intervals.
    seed: seed of all that is random.
    dependence_rows: rows of the dependences (HSIC), whose time grows with the square.

    Returns an Analysis; for several outputs a dictionary of these by their names. Rows in which an input is
    not finite are left out.

    Raises InputError.
    """
    x, y = numpy.asarray(X, dtype=float), numpy.asarray(Y, dtype=float)
    if x.ndim == 1:
        x = x[:, None]
    if names is None and problem is not None:
        names = problem["names"]
    if names is None:
        columns = getattr(X, "columns", None)
        names = [f"x{k + 1}" for k in range(x.shape[-1])] if columns is None else list(columns)
    listed = [str(name) for name in names]
    if y.ndim not in (1, 2):
        raise InputError(f"Y has the shape {y.shape}: expected (n,) or (n, m)")

    def one(output: str, values: NDArray[Any]) -> Analysis:
        text = _analyse(x, values, listed, limit, level, seed, dependence_rows)
        return Analysis(output, json.loads(text), x, values)

    if y.ndim == 1:
        return one(str(getattr(Y, "name", None) or "y"), y)
    columns = getattr(Y, "columns", None)
    outputs = [f"y{k + 1}" for k in range(y.shape[1])] if columns is None else [str(name) for name in columns]
    return {name: one(name, y[:, k]) for k, name in enumerate(outputs)}
