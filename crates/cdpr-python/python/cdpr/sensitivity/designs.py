"""Designs whose rows are a sample of the inputs, and their estimators."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Optional, TypeVar, Union

from .. import _core
from .._table import by_output
from ..errors import InputError
from .estimates import (
    ActiveSubspace,
    Brackets,
    DerivativeMeasures,
    EffectIntervals,
    Effects,
    Expansion,
    Regression,
    WassersteinBures,
)
from .inputs import Correlation, Inputs, laws_of, matrix_of, native_inputs
from .laws import Law

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

_Self = TypeVar("_Self", bound="Design")
#: An output for each row, (n,), or several: a dictionary, a DataFrame or an array (n, m).
Outputs = Union["ArrayLike", Mapping[str, "ArrayLike"]]


class Design:
    """A design: the laws of its inputs and its rows.

    An estimator takes an output for each row, (n,), NaN where the model failed, and returns a result. Of
    several outputs - a dictionary, a pandas.DataFrame or an array (n, m) - it returns a dictionary of results
    by their names, y1, y2, ... if they have none. To a type checker both are Any: a union would refuse what
    only one of them can do.
    """

    #: The native design, and arguments that make the design again.
    _native: Any
    _settings: dict[str, Any]

    @property
    def inputs(self) -> dict[str, Law]:
        """Laws of the inputs by their names, in the order of the columns."""
        return dict(self._settings["inputs"])

    def rows(self) -> NDArray[Any]:
        """Returns the values of the inputs, (rows, k)."""
        return self._native.rows()  # type: ignore[no-any-return]

    def to_dataframe(self) -> Any:
        """Returns the rows as a pandas.DataFrame with a column for each input."""
        import pandas

        return pandas.DataFrame(self.rows(), columns=list(self.inputs))

    def __len__(self) -> int:
        return int(self._native.size())

    def __repr__(self) -> str:
        return f"<cdpr.sensitivity.{type(self).__name__} of {len(self.inputs)} inputs, {len(self)} rows>"

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (type(self), self._settings)

    def _again(self: _Self, **settings: Any) -> _Self:
        return _again(type(self), {**self._settings, **settings})


def _again(of: type[_Self], settings: dict[str, Any]) -> _Self:
    """Makes a design of its arguments."""
    return of(**settings)


class _Sample(Design):
    """A sample of the joint law of the inputs."""

    #: Name of the native design.
    _class: ClassVar[str]

    def _made(
        self,
        inputs: Inputs,
        points: int,
        correlation: Optional[Correlation],
        **settings: Any,
    ) -> None:
        laws = laws_of(inputs)
        matrix = matrix_of(correlation, list(laws))
        self._settings = {"inputs": laws, "points": points, "correlation": matrix, **settings}
        centred = "Centred" if settings.get("centred") else ""
        first_index, seed = settings.get("first_index", 0), settings["seed"]
        self._native = _core.Sample(centred + self._class, native_inputs(laws), points, first_index, seed, matrix)

    def replicate(self: _Self, seed: int) -> _Self:
        """Returns the design of the same inputs and size under another seed."""
        return self._again(seed=seed, **({"first_index": 0} if "first_index" in self._settings else {}))

    def effects(self, outputs: Outputs) -> Annotated[Any, Effects]:
        """Estimates the effect of each input from one output a row."""
        return by_output(outputs, lambda _, y: Effects(json.loads(self._native.effects(y))))

    def regression(self, outputs: Outputs, *, ranks: bool = False) -> Annotated[Any, Regression]:
        """Fits a linear model (SRC, PCC), or one of ranks (SRRC, PRCC). The inputs may be correlated."""
        return by_output(outputs, lambda _, y: Regression(json.loads(self._native.regression(y, ranks))))

    def expansion(
        self, outputs: Outputs, *, max_degree: int = 5, norm: float = 1.0, interactions: int = 2
    ) -> Annotated[Any, Expansion]:
        """Fits a sparse polynomial chaos expansion, which gives all Sobol' indices and predicts.

        max_degree: largest degree that is tried.
        norm: q in (0, 1] of the hyperbolic truncation; 1 for all products up to the degree.
        interactions: largest number of inputs in one product.
        """
        return by_output(
            outputs, lambda _, y: Expansion(self._native.expansion(y, max_degree, norm, interactions))
        )

    def gradient_expansion(
        self,
        outputs: Outputs,
        gradients: Any,
        *,
        max_degree: int = 5,
        norm: float = 1.0,
        interactions: int = 2,
    ) -> Annotated[Any, Expansion]:
        """Fits an expansion to outputs and gradients together, which takes fewer rows.

        `derivatives` of the result says whether the gradients took part: they are left out where the outputs
        alone predict better. Other arguments are as of `expansion`.

        gradients: as `derivative_measures` takes them.
        """

        def one(_: str, y: Any, slopes: Any) -> Expansion:
            return Expansion(self._native.gradient_expansion(y, slopes, max_degree, norm, interactions))

        return by_output(outputs, one, gradients)

    def derivative_measures(
        self, outputs: Outputs, gradients: Any, *, level: float = 0.95
    ) -> Annotated[Any, DerivativeMeasures]:
        """Estimates derivative-based measures (DGSM) and the upper bounds that they set on total indices.

        gradients: derivatives of the output by each input, (n, k), NaN where there are none; of several
            outputs (n, m, k), or a dictionary.
        """

        def one(_: str, y: Any, slopes: Any) -> DerivativeMeasures:
            return DerivativeMeasures(json.loads(self._native.derivative_measures(y, slopes, level)))

        return by_output(outputs, one, gradients)

    def brackets(
        self, outputs: Outputs, gradients: Any, *, level: float = 0.95, seed: int = 2017
    ) -> Annotated[Any, Brackets]:
        """Bounds the Sobol' indices from both sides, from at least 40 outputs with gradients.

        gradients: as `derivative_measures` takes them.
        seed: deals the rows to the groups of the jackknife, which makes the intervals.
        """

        def one(_: str, y: Any, slopes: Any) -> Brackets:
            return Brackets({"inputs": json.loads(self._native.brackets(y, slopes, level, seed))})

        return by_output(outputs, one, gradients)

    def active_subspace(
        self,
        outputs: Outputs,
        gradients: Any,
        *,
        shares: Sequence[float] = (0.9, 0.99),
        level: float = 0.95,
        resamples: int = 200,
        seed: int = 2017,
    ) -> Annotated[Any, ActiveSubspace]:
        """Finds the directions of all inputs along which the output varies.

        gradients: as `derivative_measures` takes them.
        shares: shares of the sum of all eigenvalues for which `needed` counts the directions.
        resamples, seed: of the bootstrap behind the intervals.
        """
        wanted = [float(share) for share in shares]

        def one(_: str, y: Any, slopes: Any) -> ActiveSubspace:
            text, needed = self._native.active_subspace(y, slopes, wanted, level, resamples, seed)
            content = json.loads(text)
            rows = zip(self.inputs, content["activity"])
            content["inputs"] = [{"input": name, "activity": activity} for name, activity in rows]
            content["needed"] = dict(zip(wanted, needed))
            return ActiveSubspace(content)

        return by_output(outputs, one, gradients)


class SobolDesign(_Sample):
    """Consecutive points of Sobol's sequence in the laws of k inputs.

    The sequence is plain or, with a seed, under a nested scrambling. Sizes of 2^m, from index 0, keep its
    balance.

    inputs: law of each input by its name (see `uniform`, `normal` and the other laws), or SALib's dictionary
        of a problem, whose groups are for the designs that have groups.
    points: number of rows.
    first_index: index of the first row in the plain sequence; 1 where a law has no lower end.
    seed: seed of the scrambling; None for the plain sequence.
    correlation: of the normal scores of the inputs (Gaussian copula), a matrix (k, k) or those of pairs,
        {("x", "y"): 0.5}; independent inputs if left out.

    Raises InputError.
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

    centred: whether the values lie in the middle of their cells. Other arguments are as of `SobolDesign`.
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
    """Independent random rows. Arguments are as of `SobolDesign`."""

    _class = "RandomDesign"

    def __init__(
        self, inputs: Inputs, points: int, *, seed: int, correlation: Optional[Correlation] = None
    ) -> None:
        self._made(inputs, points, correlation, seed=seed)


def effect_intervals(
    replicates: Sequence[tuple[_Sample, ArrayLike]], *, level: float = 0.95
) -> EffectIntervals:
    """Estimates effects with intervals from designs that differ in their seeds, with an output a row of each.

    replicates: at least two designs with their outputs; see `SobolDesign.replicate`.

    Raises InputError.
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

    rows: values of the inputs, (n, k), at least 64 rows.
    outputs: components in a common unit, (n, m); a row with NaN has failed.
    names: of the inputs; x1, x2, ... if left out.
    seed: deals the rows to the groups of the jackknife, which makes the intervals.

    Raises InputError.
    """
    found = json.loads(_core.wasserstein_bures(rows, outputs, level, seed))
    given = [f"x{i + 1}" for i in range(len(found))] if names is None else list(names)
    if len(given) != len(found):
        raise InputError(f"names has {len(given)} names: expected {len(found)}, one for each input")
    return WassersteinBures({"inputs": [{"input": name, **of} for name, of in zip(given, found)]})
