# Types of the native half. What each argument and field is stands in the documentation that `help(cdpr.Robot)` shows.

from os import PathLike
from typing import Any, Callable, TypeAlias, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = [
    "Catenary",
    "Deflection",
    "Derivatives",
    "DirectSolution",
    "Effects",
    "Expansion",
    "InverseSolution",
    "MorrisDesign",
    "MorrisEffects",
    "Observations",
    "Robot",
    "SaltelliDesign",
    "SobolDesign",
    "SobolIndices",
    "Stiffness",
    "VERSION",
    "Workspace",
    "begin",
    "carry_out",
    "catenary",
    "make_shard",
    "observations",
]

VERSION: str

_Floats: TypeAlias = NDArray[np.float64]
#: A number for one case, an array (m,) for m.
_Float: TypeAlias = Any
_Bool: TypeAlias = Any
_Int: TypeAlias = Any
#: A word for one case, a list for m.
_Word: TypeAlias = Any
_Reasons: TypeAlias = list[str | None] | None
_Path: TypeAlias = str | PathLike[str]
_Law: TypeAlias = dict[str, dict[str, float]]
#: A place [m], or from, to and how many.
_Places: TypeAlias = float | tuple[float, float, int]

@final
class Robot:
    def __new__(
        cls,
        anchor_points: ArrayLike,
        exit_points: ArrayLike,
        *,
        mass: float,
        section: ArrayLike,
        linear_density: ArrayLike,
        youngs_modulus: ArrayLike,
        tension_limits: tuple[float, float] | list[float],
        center_of_mass: tuple[float, float, float] | list[float] = ...,
        gravity: float = 9.81,
        name: str = ...,
    ) -> Robot: ...
    @staticmethod
    def from_file(path: _Path) -> Robot: ...
    @staticmethod
    def from_json(text: str) -> Robot: ...
    @staticmethod
    def from_dict(content: dict[str, Any]) -> Robot: ...
    def to_json(self) -> str: ...
    def to_dict(self) -> dict[str, Any]: ...
    @property
    def name(self) -> str: ...
    @property
    def cables(self) -> int: ...
    @property
    def anchor_points(self) -> _Floats: ...
    @property
    def exit_points(self) -> _Floats: ...
    @property
    def parameters(self) -> dict[str, float]: ...
    def with_parameters(self, values: dict[str, float]) -> Robot: ...
    def inverse(
        self,
        pose: ArrayLike,
        *,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
        payload: ArrayLike | None = None,
        reference: ArrayLike | None = None,
    ) -> InverseSolution: ...
    def direct(
        self,
        lengths: ArrayLike,
        *,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
        payload: ArrayLike | None = None,
        start: ArrayLike | None = None,
    ) -> DirectSolution: ...
    def deflection(
        self,
        pose: ArrayLike,
        *,
        payload: ArrayLike | None = None,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
        tension_offsets: ArrayLike | None = None,
    ) -> Deflection: ...
    def stiffness(
        self,
        pose: ArrayLike,
        *,
        payload: ArrayLike | None = None,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
    ) -> Stiffness: ...
    def derivatives(
        self,
        pose: ArrayLike,
        *,
        payload: ArrayLike | None = None,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
    ) -> Derivatives: ...
    def observe(
        self,
        pose: ArrayLike,
        deviations: ArrayLike,
        *,
        payload: ArrayLike | None = None,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
    ) -> Observations: ...
    def workspace(
        self,
        *,
        x: _Places | None = None,
        y: _Places | None = None,
        z: _Places | None = None,
        plane: tuple[str, float] | None = None,
        grid: tuple[int, int] = ...,
        payload: float = 50.0,
        uncertainty: dict[str, float] | None = None,
    ) -> Workspace: ...

@final
class Catenary:
    force: _Floats
    anchor_tension: _Float
    exit_tension: _Float
    sag: _Float
    energy: _Float
    unstrained_length: _Float
    end: _Floats
    residual: _Float
    shape: _Floats
    reasons: _Reasons

@final
class InverseSolution:
    lengths: _Floats
    tensions: _Floats
    cable_forces: _Floats
    active: NDArray[np.int8]
    residual: _Floats
    turns: _Int
    reasons: _Reasons

@final
class DirectSolution:
    position: _Floats
    quaternion: _Floats
    rotation: _Floats
    pose: _Floats
    cable_forces: _Floats
    tensions: _Floats
    stable: _Bool
    least_stiffness: _Float
    slack: NDArray[np.bool_]
    residual: _Floats
    method: _Word
    iterations: _Int
    reasons: _Reasons

@final
class Deflection:
    displacement: _Floats
    rms: _Float
    turn: _Floats
    lengths: _Floats
    unloaded: DirectSolution
    loaded: DirectSolution
    reasons: _Reasons

@final
class Stiffness:
    matrix: _Floats
    eigenvalues: _Floats
    translations: _Floats
    rotations: _Floats
    least_stiffness: _Float
    stable: _Bool
    arm: _Float
    reasons: _Reasons

@final
class Derivatives:
    inputs: list[str]
    rms: _Floats
    displacement: _Floats
    lengths: _Floats
    set_points: _Floats
    tensions: _Floats
    deflection: Deflection
    reasons: _Reasons

@final
class Observations:
    displacement: _Floats
    rms: _Float
    reasons: _Reasons

@final
class Workspace:
    shape: tuple[int, int, int]
    positions: _Floats
    status: list[str]
    reasons: list[str | None]
    least_tension: _Floats
    greatest_tension: _Floats
    displacement: _Floats
    rms: _Floats
    least_stiffness: _Floats
    dominant: list[str | None]
    dominant_share: _Floats
    std: _Floats

def catenary(
    weight: ArrayLike,
    stiffness: ArrayLike,
    *,
    length: ArrayLike | None = None,
    end: ArrayLike | None = None,
    force: ArrayLike | None = None,
    tension: ArrayLike | None = None,
    points: int = 51,
) -> Catenary: ...

@final
class SobolDesign:
    def __new__(
        cls, inputs: dict[str, _Law], points: int, *, first_index: int = 0, seed: int | None = None
    ) -> SobolDesign: ...
    def rows(self) -> _Floats: ...
    def effects(self, outputs: ArrayLike) -> Effects: ...
    def expansion(
        self, outputs: ArrayLike, *, max_degree: int = 5, norm: float = 1.0, interactions: int = 2
    ) -> Expansion: ...

@final
class SaltelliDesign:
    def __new__(
        cls,
        inputs: dict[str, _Law],
        blocks: int,
        *,
        seed: int | None = None,
        pairs: bool = False,
        first_index: int = 0,
    ) -> SaltelliDesign: ...
    def rows(self) -> _Floats: ...
    def indices(
        self, outputs: ArrayLike, *, level: float = 0.95, resamples: int = 1000, seed: int = 0
    ) -> SobolIndices: ...

@final
class MorrisDesign:
    def __new__(cls, inputs: dict[str, _Law], blocks: int, *, seed: int) -> MorrisDesign: ...
    def rows(self) -> _Floats: ...
    def effects(self, outputs: ArrayLike, *, level: float = 0.95) -> MorrisEffects: ...

@final
class Effects:
    inputs: list[str]
    effect: _Floats
    student: _Floats
    mean: float
    std: float
    failed: int

@final
class SobolIndices:
    inputs: list[str]
    first: _Floats
    first_interval: _Floats
    total: _Floats
    total_interval: _Floats
    pairs: list[tuple[str, str]]
    second: _Floats
    second_interval: _Floats
    variance: float
    blocks: int
    failed_blocks: int

@final
class MorrisEffects:
    inputs: list[str]
    mean: _Floats
    mean_absolute: _Floats
    mean_absolute_interval: _Floats
    std: _Floats

@final
class Expansion:
    @property
    def inputs(self) -> list[str]: ...
    @property
    def mean(self) -> float: ...
    @property
    def variance(self) -> float: ...
    @property
    def degree(self) -> int: ...
    @property
    def leave_one_out(self) -> float: ...
    @property
    def first(self) -> _Floats: ...
    @property
    def total(self) -> _Floats: ...
    def predict(self, rows: ArrayLike) -> _Floats: ...

def begin(
    study: _Path, out: _Path, observations: int | None, resume: bool, overwrite: bool
) -> tuple[int, int]: ...
def make_shard(out: _Path, index: int, count: int, threads: int) -> int: ...
def carry_out(
    out: _Path,
    table: str | None,
    threads: int | None,
    complete: bool,
    progress: Callable[[int, int], object] | None,
) -> list[str]: ...
def observations(out: _Path, sampling: str) -> tuple[list[str], _Floats, _Floats, list[str | None]]: ...
