"""Designs in blocks for Sobol' indices, elementary effects and Shapley effects, and their estimators."""

from __future__ import annotations

import json
import warnings
from typing import TYPE_CHECKING, Annotated, Any, Optional

from .. import _core
from .._table import by_output
from .designs import Design, Outputs
from .estimates import MorrisEffects, ShapleyEffects, SobolIndices
from .inputs import Correlation, Groups, Inputs, groups_of, indices_of, laws_of, matrix_of, native_inputs

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class SaltelliDesign(Design):
    """Blocks of k + 2 rows for Sobol' indices (2k + 2 for those of pairs).

    With a seed half of the blocks lie on one scrambled sequence, the others on 8 replicates of it, which show
    the error; without a seed they lie on the plain one. Other arguments are as of `SobolDesign`.

    Parameters
    ----------
    inputs : dict
        Law of each input by its name, or SALib's dictionary of a problem.
    blocks : int
        Number of blocks N, at least 16.
    seed : int, optional
        Seed of all that is random.
    pairs : bool, default False
        Whether indices of pairs of inputs are wanted.
    first_index : int, default 0
        Index of the first row in the plain sequence.
    groups : dict of sequence of str, optional
        Names of the inputs of each group, {"cable 1": ["x", "y"]}: the indices are those of groups, and
        k is their number. SALib's dictionary of a problem may have them.

    Examples
    --------
    >>> design = SaltelliDesign({"x": uniform(0, 1), "y": uniform(0, 1)}, 64, seed=1)
    >>> design.rows().shape
    (256, 2)
    """

    def __init__(
        self,
        inputs: Inputs,
        blocks: int,
        *,
        seed: Optional[int] = None,
        pairs: bool = False,
        first_index: int = 0,
        groups: Optional[Groups] = None,
    ) -> None:
        laws, groups = laws_of(inputs), groups_of(inputs, groups)
        self._settings = {"inputs": laws, "blocks": blocks, "seed": seed, "pairs": pairs}
        self._settings |= {"first_index": first_index, "groups": groups}
        listed = indices_of(groups, laws)
        self._native = _core.Saltelli(native_inputs(laws), blocks, seed, pairs, first_index, listed)

    def indices(
        self, outputs: Outputs, *, level: float = 0.95, resamples: int = 1000, seed: int = 0
    ) -> Annotated[Any, SobolIndices]:
        """Estimates Sobol' indices with intervals from one output a row.

        It warns where the intervals do not have their level: without a seed, or with fewer than 64 blocks.

        Parameters
        ----------
        outputs : array_like, dict or DataFrame
            Output of each row, (n,), NaN where the model failed; or several, a dictionary, a DataFrame or
            (n, m).
        level : float, default 0.95
            Confidence of the intervals.
        resamples : int, default 1000
            of the bootstrap; the same outputs have the same intervals.
        seed : int, default 0
            of the bootstrap; the same outputs have the same intervals.

        Returns
        -------
        SobolIndices
            The indices; of several outputs a dictionary of these.
        """
        return by_output(
            outputs, lambda _, y: _warned(json.loads(self._native.indices(y, level, resamples, seed)))
        )

    def vector_indices(
        self, outputs: ArrayLike, *, level: float = 0.95, resamples: int = 1000, seed: int = 0
    ) -> SobolIndices:
        """Estimates generalized Sobol' indices of one output of several components in a common unit, (n, m).

        They are shares of the trace of its covariance, such as of a displacement (dx, dy, dz).

        Parameters
        ----------
        outputs : array_like
            Output of each row, (n,), NaN where the model failed; or several, a dictionary, a DataFrame or
            (n, m).
        level : float, default 0.95
            Confidence of the intervals.
        resamples : int, default 1000
            Number of samples of the bootstrap behind the intervals.
        seed : int, default 0
            Seed of all that is random.

        Returns
        -------
        SobolIndices
            The indices; of several outputs a dictionary of these.
        """
        return _warned(json.loads(self._native.vector_indices(outputs, level, resamples, seed)), depth=3)

    def convergence(
        self, outputs: Outputs, *, level: float = 0.95, resamples: int = 1000, seed: int = 0
    ) -> Annotated[Any, list[SobolIndices]]:
        """Estimates the indices of the first eighth, quarter and half of the blocks, and of all.

        The number of blocks is a power of two from 128 on.

        Parameters
        ----------
        outputs : array_like, dict or DataFrame
            Output of each row, (n,), NaN where the model failed; or several, a dictionary, a DataFrame or
            (n, m).
        level : float, default 0.95
            Confidence of the intervals.
        resamples : int, default 1000
            Number of samples of the bootstrap behind the intervals.
        seed : int, default 0
            Seed of all that is random.

        Returns
        -------
        list[SobolIndices]
            The indices of each number of blocks; of several outputs a dictionary of these.
        """

        def one(_: str, y: Any) -> list[SobolIndices]:
            return [SobolIndices(of) for of in json.loads(self._native.convergence(y, level, resamples, seed))]

        return by_output(outputs, one)

    def resized(self, blocks: int) -> SaltelliDesign:
        """Returns the design with another number of blocks. The blocks that both have are the same.

        Parameters
        ----------
        blocks : int
            Number of blocks of the other design.

        Returns
        -------
        SaltelliDesign
            The design.
        """
        return self._again(blocks=blocks)


class MorrisDesign(Design):
    """Blocks of k + 1 rows for Morris's elementary effects: radial ones on points of the scrambled Sobol
    sequence, or trajectories.

    Parameters
    ----------
    inputs : dict
        Law of each input by its name, or SALib's dictionary of a problem.
    blocks : int
        Number of blocks, at least 2.
    seed : int
        Seed of the scrambling or of the trajectories.
    levels : int, optional
        Levels of the trajectories, an even number; None for radial blocks.
    groups : dict of sequence of str, optional
        As `SaltelliDesign` takes them: the inputs of a group move together.

    Examples
    --------
    >>> MorrisDesign({"x": uniform(0, 1), "y": uniform(0, 1)}, 8, seed=1).rows().shape
    (24, 2)
    """

    def __init__(
        self,
        inputs: Inputs,
        blocks: int,
        *,
        seed: int,
        levels: Optional[int] = None,
        groups: Optional[Groups] = None,
    ) -> None:
        laws, groups = laws_of(inputs), groups_of(inputs, groups)
        self._settings = {"inputs": laws, "blocks": blocks, "seed": seed, "levels": levels, "groups": groups}
        self._native = _core.Morris(native_inputs(laws), blocks, seed, levels, indices_of(groups, laws))

    def effects(self, outputs: Outputs, *, level: float = 0.95) -> Annotated[Any, MorrisEffects]:
        """Estimates elementary effects from one output a row.

        Parameters
        ----------
        outputs : array_like, dict or DataFrame
            Output of each row, (n,), NaN where the model failed; or several, a dictionary, a DataFrame or
            (n, m).
        level : float, default 0.95
            Confidence of the intervals.

        Returns
        -------
        MorrisEffects
            The effects; of several outputs a dictionary of these.
        """
        return by_output(
            outputs, lambda _, y: MorrisEffects({"inputs": json.loads(self._native.effects(y, level))})
        )


class ShapleyDesign(Design):
    """Walks of k + 1 rows for Shapley effects, also of correlated inputs.

    Parameters
    ----------
    inputs : dict
        Law of each input by its name, or SALib's dictionary of a problem.
    walks : int
        Number of walks, at least 16 for an estimate.
    seed : int
        Seed of the walks.
    correlation : array_like or dict, optional
        As `SobolDesign` takes it.
    groups : dict of sequence of str, optional
        As `SaltelliDesign` takes them; each input is in one group.

    Examples
    --------
    >>> ShapleyDesign({"x": uniform(0, 1), "y": uniform(0, 1)}, 32, seed=1).rows().shape
    (96, 2)
    """

    def __init__(
        self,
        inputs: Inputs,
        walks: int,
        *,
        seed: int,
        correlation: Optional[Correlation] = None,
        groups: Optional[Groups] = None,
    ) -> None:
        laws, groups = laws_of(inputs), groups_of(inputs, groups)
        matrix = matrix_of(correlation, list(laws))
        self._settings = {"inputs": laws, "walks": walks, "seed": seed, "correlation": matrix, "groups": groups}
        self._native = _core.Shapley(native_inputs(laws), walks, seed, matrix, indices_of(groups, laws))

    def effects(self, outputs: Outputs, *, level: float = 0.95) -> Annotated[Any, ShapleyEffects]:
        """Estimates Shapley effects from one output a row.

        Parameters
        ----------
        outputs : array_like, dict or DataFrame
            Output of each row, (n,), NaN where the model failed; or several, a dictionary, a DataFrame or
            (n, m).
        level : float, default 0.95
            Confidence of the intervals.

        Returns
        -------
        ShapleyEffects
            The effects; of several outputs a dictionary of these.
        """
        return by_output(
            outputs, lambda _, y: ShapleyEffects({"inputs": json.loads(self._native.effects(y, level))})
        )


def _warned(content: dict[str, Any], depth: int = 5) -> SobolIndices:
    """The indices, with a warning where their intervals do not have their level.

    depth: calls from here to the user's code.
    """
    if not content["reliable"]:
        message = "intervals are an indication: they have their level with a seed, from 64 blocks on"
        warnings.warn(message, UserWarning, stacklevel=depth)
    return SobolIndices(content)
