"""Designs whose rows are a sample of the inputs, and their estimators."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Optional, TypeVar, Union

from .. import _core
from .._table import by_output
from .estimates import (
    ActiveSubspace,
    Brackets,
    DerivativeMeasures,
    Effects,
    Expansion,
    Regression,
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
        """Returns the values of the inputs, (rows, k).

        Returns
        -------
        numpy.ndarray
            Values, (rows, k).
        """
        return self._native.rows()  # type: ignore[no-any-return]

    def to_dataframe(self) -> Any:
        """Returns the rows as a pandas.DataFrame with a column for each input.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
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
        """Returns the design of the same inputs and size under another seed.

        Parameters
        ----------
        seed : int
            Seed of the other design.

        Returns
        -------
        same class
            The design.
        """
        return self._again(seed=seed, **({"first_index": 0} if "first_index" in self._settings else {}))

    def effects(self, outputs: Outputs) -> Annotated[Any, Effects]:
        """Estimates the effect of each input from one output a row.

        Parameters
        ----------
        outputs : array_like, dict or DataFrame
            Output of each row, (n,), NaN where the model failed; or several, a dictionary, a DataFrame or
            (n, m).

        Returns
        -------
        Effects
            Effects of the inputs; of several outputs a dictionary of these.
        """
        return by_output(outputs, lambda _, y: Effects(json.loads(self._native.effects(y))))

    def regression(self, outputs: Outputs, *, ranks: bool = False) -> Annotated[Any, Regression]:
        """Fits a linear model (SRC, PCC), or one of ranks (SRRC, PRCC). The inputs may be correlated.

        Parameters
        ----------
        outputs : array_like, dict or DataFrame
            Output of each row, (n,), NaN where the model failed; or several, a dictionary, a DataFrame or
            (n, m).
        ranks : bool, default False
            Whether values are replaced by their ranks.

        Returns
        -------
        Regression
            The model; of several outputs a dictionary of these.
        """
        return by_output(outputs, lambda _, y: Regression(json.loads(self._native.regression(y, ranks))))

    def expansion(
        self, outputs: Outputs, *, max_degree: int = 5, norm: float = 1.0, interactions: int = 2
    ) -> Annotated[Any, Expansion]:
        """Fits a sparse polynomial chaos expansion, which gives all Sobol' indices and predicts.

        Parameters
        ----------
        outputs : array_like, dict or DataFrame
            Output of each row, (n,), NaN where the model failed; or several, a dictionary, a DataFrame or
            (n, m).
        max_degree : int, default 5
            Largest degree that is tried.
        norm : float, default 1.0
            Q in (0, 1] of the hyperbolic truncation; 1 for all products up to the degree.
        interactions : int, default 2
            Largest number of inputs in one product.

        Returns
        -------
        Expansion
            The expansion; of several outputs a dictionary of these.
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

        Parameters
        ----------
        outputs : array_like, dict or DataFrame
            Output of each row, (n,), NaN where the model failed; or several, a dictionary, a DataFrame or
            (n, m).
        gradients : object
            As `derivative_measures` takes them.
        max_degree : int, default 5
            Largest degree that is tried.
        norm : float, default 1.0
            Exponent q in (0, 1] of the hyperbolic truncation; 1 for all products up to the degree.
        interactions : int, default 2
            Largest number of inputs in one product.

        Returns
        -------
        Expansion
            The expansion; of several outputs a dictionary of these.
        """

        def one(_: str, y: Any, slopes: Any) -> Expansion:
            return Expansion(self._native.gradient_expansion(y, slopes, max_degree, norm, interactions))

        return by_output(outputs, one, gradients)

    def derivative_measures(
        self, outputs: Outputs, gradients: Any, *, level: float = 0.95
    ) -> Annotated[Any, DerivativeMeasures]:
        """Estimates derivative-based measures (DGSM) and the upper bounds that they set on total indices.

        Parameters
        ----------
        outputs : array_like, dict or DataFrame
            Output of each row, (n,), NaN where the model failed; or several, a dictionary, a DataFrame or
            (n, m).
        gradients : object
            Derivatives of the output by each input, (n, k), NaN where they are unknown; of several outputs
            (n, m, k), or a dictionary.
        level : float, default 0.95
            Confidence of the intervals.

        Returns
        -------
        DerivativeMeasures
            The measures; of several outputs a dictionary of these.
        """

        def one(_: str, y: Any, slopes: Any) -> DerivativeMeasures:
            return DerivativeMeasures(json.loads(self._native.derivative_measures(y, slopes, level)))

        return by_output(outputs, one, gradients)

    def brackets(
        self, outputs: Outputs, gradients: Any, *, level: float = 0.95, seed: int = 2017
    ) -> Annotated[Any, Brackets]:
        """Bounds the Sobol' indices from both sides, from at least 40 outputs with gradients.

        Parameters
        ----------
        outputs : array_like, dict or DataFrame
            Output of each row, (n,), NaN where the model failed; or several, a dictionary, a DataFrame or
            (n, m).
        gradients : object
            As `derivative_measures` takes them.
        level : float, default 0.95
            Confidence of the intervals.
        seed : int, default 2017
            Deals the rows to the groups of the jackknife, which makes the intervals.

        Returns
        -------
        Brackets
            The bounds; of several outputs a dictionary of these.
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

        Parameters
        ----------
        outputs : array_like, dict or DataFrame
            Output of each row, (n,), NaN where the model failed; or several, a dictionary, a DataFrame or
            (n, m).
        gradients : object
            As `derivative_measures` takes them.
        shares : sequence of float, default (0.9, 0.99)
            Shares of the sum of all eigenvalues for which `needed` counts the directions.
        level : float, default 0.95
            Confidence of the intervals.
        resamples : int, default 200
            of the bootstrap behind the intervals.
        seed : int, default 2017
            of the bootstrap behind the intervals.

        Returns
        -------
        ActiveSubspace
            The directions; of several outputs a dictionary of these.
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
