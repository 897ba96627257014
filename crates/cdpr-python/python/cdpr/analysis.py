"""What a table of inputs and outputs says, wherever it comes from.

>>> import numpy
>>> import cdpr
>>> x = numpy.random.default_rng(1).uniform(-1, 1, (500, 3))
>>> found = cdpr.analyse(x, x[:, 0] + 2 * x[:, 1] ** 2, names=["a", "b", "c"])
>>> found.inputs
['a', 'b', 'c']
>>> found.certain
['b', 'a']
>>> print(found.verdict)
2 of 3 inputs are certain to matter: b (location), a (HSIC)
not settled by 500 rows, more of them may: c
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Annotated, Any, Union

import numpy

from ._core import analyse as _analyse
from ._figures import axes_of
from ._table import Column, Interval, Table, by_output, count_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import ArrayLike, NDArray

__all__ = ["Analysis", "analyse"]


class Analysis(Table):
    """What a table says of one output. `content` holds all of it, as `cdpr analyse --format json` prints it.

    Arrays have an element for each of the k inputs, NaN where a measure cannot be computed (see `notes`).
    """

    _drawn = ("dependence",)

    def __init__(self, output: str, content: dict[str, Any], x: NDArray[Any], y: ArrayLike) -> None:
        super().__init__(content)
        #: Name of the output.
        self.output = output
        self._x, self._y = x, y

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

    @property
    def certain(self) -> list[str]:
        """Inputs that are certain to matter: no more than 5 % of tables name one without an effect."""
        return [finding["input"] for finding in self.content["verdict"]["certain"]]

    @property
    def related(self) -> dict[str, list[str]]:
        """Inputs that are related to the output and need not be causes, with the reasons."""
        return {finding["input"]: finding["reasons"] for finding in self.content["verdict"]["related"]}

    @property
    def conditions(self) -> list[str]:
        """What was found of the conditions of the verdict, and of values that may be wrong."""
        return [condition["text"] for condition in self.content["verdict"]["conditions"]]

    @property
    def verdict(self) -> str:
        """The verdict in words."""
        return "\n".join(self.content["verdict"]["sentences"])

    effect = Column("half.effect", "Mean output of the upper half of an input's values less that of the lower half.")
    student = Column(
        "half.student", "Student's t of the effect, for independent rows; NaN without variance in the halves."
    )
    standardized = Column("standardized", "Standardized regression coefficients (SRC).")
    rank_standardized = Column("rank_standardized", "Standardized regression coefficients of ranks (SRRC).")
    first = Column("first.value", "First-order Sobol' indices by ranks, or by levels where these are few.")
    first_interval = Interval("first", "Intervals of these, (k, 2).")
    expansion_first = Column(
        "shares.closed", "First-order Sobol' indices of the polynomial model, if it explains half of the variance."
    )
    expansion_total = Column("shares.total", "Total Sobol' indices of the polynomial model.")
    dependence = Column(
        "dependence.r_squared", "R^2 of the Hilbert-Schmidt independence criterion (HSIC), from 0 to 1."
    )
    p_value = Column("dependence.p_value", "Probability of such a dependence without any.")
    pawn = Column("pawn.median", "PAWN indices: median distances of Kolmogorov and Smirnov.")
    pawn_noise = Column(
        "pawn.noise", "PAWN index that an input without an effect stays below in 95 of 100 tables."
    )
    delta = Column("delta.delta", "Borgonovo's delta.")
    delta_at_least = Column(
        "delta.at_least", "Lower bounds of these. No table bounds delta from above: there is no interval."
    )
    delta_noise = Column("delta.noise", "Delta that an input without an effect stays below in 95 of 100 tables.")
    target = Column(
        "limit.target.r_squared",
        "Dependence of the failure of the limit on each input, R^2; NaN without a limit.",
    )
    target_p_value = Column("limit.target.p_value", "Probability of such a dependence without any.")

    def to_dataframe(self) -> Any:
        """Returns a pandas.DataFrame with a row for each input; ends of intervals are `.._low`, `.._high`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
        frame = super().to_dataframe()
        given = self.content["limit"] is not None
        return frame if given else frame.drop(columns=["target", "target_p_value"])

    def plot(self, most: int = 9, *, ax: Any = None) -> Any:
        """Draws the output against the leading inputs, and returns the matplotlib Figure.

        Parameters
        ----------
        most : int, default 9
            Greatest number of inputs.
        ax : matplotlib.axes.Axes, optional
            Where to draw the leading input alone; a new figure of all if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
        import numpy

        order = self._leading(most if ax is None else 1)
        columns = min(3, len(order))
        rows = -(-len(order) // columns)
        axes = numpy.reshape(axes_of(ax, nrows=rows, ncols=columns, sharey=True), (rows, columns))
        for axis, k in zip(axes.flat, order):
            axis.plot(self._x[:, k], self._y, ".", markersize=2)
            axis.set_xlabel(self.inputs[k])
        for axis in axes.flat[len(order) :]:
            axis.set_axis_off()
        for axis in axes[:, 0]:
            axis.set_ylabel(self.output)
        return axes[0, 0].figure

    def __repr__(self) -> str:
        of = self.summary
        return (
            f"<cdpr.analysis.Analysis of {self.output[:40]}: {of['count']} rows, {of['failed']} failed, "
            f"mean {of['mean']:.4g}, std {of['std']:.4g}; {self.content['verdict']['sentences'][0]}>"
        )


def _numbers(X: ArrayLike) -> tuple[NDArray[Any], list[list[str]]]:
    """Returns columns of numbers, those of texts as the numbers of their labels, and the labels of each."""
    given = numpy.asarray(X)
    if given.dtype.kind not in "OUS":
        x = given.astype(float)
        x = x[:, None] if x.ndim == 1 else x
        return x, [[] for _ in range(x.shape[-1])]
    given = given[:, None] if given.ndim == 1 else given
    x = numpy.full(given.shape, numpy.nan)
    labels: list[list[str]] = []
    for k in range(given.shape[-1]):
        try:
            x[:, k] = given[:, k].astype(float)
            labels.append([])
        except ValueError:
            missing = [value is None or value != value or value == "" for value in given[:, k]]
            words = [str(value) for value in given[:, k]]
            known = sorted({word for word, none in zip(words, missing) if not none})
            codes = {word: code for code, word in enumerate(known)}
            x[:, k] = [numpy.nan if none else codes[word] for word, none in zip(words, missing)]
            labels.append(known)
    return x, labels


def analyse(
    rows: ArrayLike,
    outputs: Union[ArrayLike, Mapping[str, ArrayLike]],
    names: Sequence[str] | None = None,
    *,
    problem: Mapping[str, Any] | None = None,
    limit: tuple[str, float] | None = None,
    level: float = 0.95,
    seed: int = 2017,
    dependence_rows: int = 2000,
) -> Annotated[Any, Analysis]:
    """Analyses rows of inputs and their outputs: which inputs matter, and how.

    Parameters
    ----------
    rows : array_like
        Values of the inputs, (n, k), or a pandas.DataFrame. Columns of texts are categories.
    outputs : array_like, dict or DataFrame
        One output a row, (n,), NaN where a row failed; or several outputs: a dictionary, a
        pandas.DataFrame or (n, m).
    names : sequence of str, optional
        Names of the inputs; those of the DataFrame, of `problem`, or x1, x2, ... if left out.
    problem : dict, optional
        SALib's dictionary of a problem, for its `names`.
    limit : (str, float), optional
        What the outputs are to satisfy, such as ("<", 1.4), with <, <=, > or >=.
    level : float, default 0.95
        Confidence level of the intervals.
    seed : int, default 2017
        Seed of all that is random.
    dependence_rows : int, default 2000
        Rows of the dependences (HSIC), whose time grows with the square.

    Returns
    -------
    Analysis
        An Analysis; for several outputs a dictionary of these by their names. Rows in which an input is
        not finite are left out.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.

    Examples
    --------
    >>> import cdpr
    >>> x = numpy.random.default_rng(1).uniform(-1, 1, (200, 2))
    >>> cdpr.analyse(x, x[:, 0] ** 3, names=["a", "b"]).certain
    ['a']
    """
    x, labels = _numbers(rows)
    if names is None and problem is not None:
        names = problem["names"]
    if names is None:
        columns = getattr(rows, "columns", None)
        names = [f"x{k + 1}" for k in range(x.shape[-1])] if columns is None else list(columns)
    listed = [str(name) for name in names]

    count = count_of(outputs)

    def one(output: str, values: ArrayLike) -> Analysis:
        text = _analyse(x, values, listed, labels, limit, level, seed, dependence_rows, count)
        return Analysis(output, json.loads(text), x, values)

    return by_output(outputs, one)
