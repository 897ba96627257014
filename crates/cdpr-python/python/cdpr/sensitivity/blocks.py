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

    blocks: number of blocks N, at least 16.
    pairs: whether indices of pairs of inputs are wanted.
    groups: names of the inputs of each group, {"cable 1": ["x", "y"]}: the indices are those of groups, and k
        is their number. SALib's dictionary of a problem may have them.
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

        level: confidence of the intervals.
        resamples, seed: of the bootstrap; the same outputs have the same intervals.
        """
        return by_output(
            outputs, lambda _, y: _warned(json.loads(self._native.indices(y, level, resamples, seed)))
        )

    def vector_indices(
        self, outputs: ArrayLike, *, level: float = 0.95, resamples: int = 1000, seed: int = 0
    ) -> SobolIndices:
        """Estimates generalized Sobol' indices of one output of several components in a common unit, (n, m).

        They are shares of the trace of its covariance, such as of a displacement (dx, dy, dz).
        """
        return _warned(json.loads(self._native.vector_indices(outputs, level, resamples, seed)), depth=3)

    def convergence(
        self, outputs: Outputs, *, level: float = 0.95, resamples: int = 1000, seed: int = 0
    ) -> Annotated[Any, list[SobolIndices]]:
        """Estimates the indices of the first eighth, quarter and half of the blocks, and of all.

        The number of blocks is a power of two from 128 on.
        """

        def one(_: str, y: Any) -> list[SobolIndices]:
            return [SobolIndices(of) for of in json.loads(self._native.convergence(y, level, resamples, seed))]

        return by_output(outputs, one)

    def resized(self, blocks: int) -> SaltelliDesign:
        """Returns the design with another number of blocks. The blocks that both have are the same."""
        return self._again(blocks=blocks)


class MorrisDesign(Design):
    """Blocks of k + 1 rows for Morris's elementary effects: radial ones on points of the scrambled Sobol
    sequence, or trajectories.

    blocks: number of blocks, at least 2.
    seed: seed of the scrambling or of the trajectories.
    levels: levels of the trajectories, an even number; None for radial blocks.
    groups: as `SaltelliDesign` takes them: the inputs of a group move together.
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
        """Estimates elementary effects from one output a row."""
        return by_output(
            outputs, lambda _, y: MorrisEffects({"inputs": json.loads(self._native.effects(y, level))})
        )


class ShapleyDesign(Design):
    """Walks of k + 1 rows for Shapley effects, also of correlated inputs.

    walks: number of walks, at least 16 for an estimate.
    seed: seed of the walks.
    correlation: as `SobolDesign` takes it.
    groups: as `SaltelliDesign` takes them; each input is in one group.
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
        """Estimates Shapley effects from one output a row."""
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
