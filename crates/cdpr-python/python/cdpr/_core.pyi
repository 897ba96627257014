# Types of the native half. What each argument and field is stands in the documentation that `help(cdpr.Robot)` shows.

from os import PathLike
from typing import Any, Callable, TypeAlias, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

VERSION: str

Floats: TypeAlias = NDArray[np.float64]
#: A number for one case, an array (m,) for m.
Float: TypeAlias = Any
Bool: TypeAlias = Any
Int: TypeAlias = Any
#: A word for one case, a list for m.
Word: TypeAlias = Any
Reasons: TypeAlias = list[str | None] | None
Path: TypeAlias = str | PathLike[str]
Law: TypeAlias = dict[str, dict[str, float]]
#: A place [m], or from, to and how many.
Places: TypeAlias = float | tuple[float, float, int]

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
    def from_file(path: Path) -> Robot: ...
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
    def anchor_points(self) -> Floats: ...
    @property
    def exit_points(self) -> Floats: ...
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
        x: Places | None = None,
        y: Places | None = None,
        z: Places | None = None,
        plane: tuple[str, float] | None = None,
        grid: tuple[int, int] = ...,
        payload: float = 50.0,
        uncertainty: dict[str, float] | None = None,
    ) -> Workspace: ...

@final
class Catenary:
    force: Floats
    anchor_tension: Float
    exit_tension: Float
    sag: Float
    energy: Float
    unstrained_length: Float
    end: Floats
    residual: Float
    shape: Floats
    reasons: Reasons

@final
class InverseSolution:
    lengths: Floats
    tensions: Floats
    cable_forces: Floats
    active: NDArray[np.int8]
    residual: Floats
    turns: Int
    reasons: Reasons

@final
class DirectSolution:
    position: Floats
    quaternion: Floats
    rotation: Floats
    pose: Floats
    cable_forces: Floats
    tensions: Floats
    stable: Bool
    least_stiffness: Float
    slack: NDArray[np.bool_]
    residual: Floats
    method: Word
    iterations: Int
    reasons: Reasons

@final
class Deflection:
    displacement: Floats
    rms: Float
    turn: Floats
    lengths: Floats
    unloaded: DirectSolution
    loaded: DirectSolution
    reasons: Reasons

@final
class Stiffness:
    matrix: Floats
    eigenvalues: Floats
    translations: Floats
    rotations: Floats
    least_stiffness: Float
    stable: Bool
    arm: Float
    reasons: Reasons

@final
class Derivatives:
    inputs: list[str]
    rms: Floats
    displacement: Floats
    lengths: Floats
    set_points: Floats
    tensions: Floats
    deflection: Deflection
    reasons: Reasons

@final
class Observations:
    displacement: Floats
    rms: Float
    reasons: Reasons

@final
class Workspace:
    shape: tuple[int, int, int]
    positions: Floats
    status: list[str]
    reasons: list[str | None]
    least_tension: Floats
    greatest_tension: Floats
    displacement: Floats
    rms: Floats
    least_stiffness: Floats
    dominant: list[str | None]
    dominant_share: Floats
    std: Floats

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
        cls, inputs: dict[str, Law], points: int, *, first_index: int = 0, seed: int | None = None
    ) -> SobolDesign: ...
    def rows(self) -> Floats: ...
    def effects(self, outputs: ArrayLike) -> Effects: ...
    def expansion(
        self, outputs: ArrayLike, *, max_degree: int = 5, norm: float = 1.0, interactions: int = 2
    ) -> Expansion: ...

@final
class SaltelliDesign:
    def __new__(
        cls,
        inputs: dict[str, Law],
        blocks: int,
        *,
        seed: int | None = None,
        pairs: bool = False,
        first_index: int = 0,
    ) -> SaltelliDesign: ...
    def rows(self) -> Floats: ...
    def indices(
        self, outputs: ArrayLike, *, level: float = 0.95, resamples: int = 1000, seed: int = 0
    ) -> SobolIndices: ...

@final
class MorrisDesign:
    def __new__(cls, inputs: dict[str, Law], blocks: int, *, seed: int) -> MorrisDesign: ...
    def rows(self) -> Floats: ...
    def effects(self, outputs: ArrayLike, *, level: float = 0.95) -> MorrisEffects: ...

@final
class Effects:
    inputs: list[str]
    effect: Floats
    student: Floats
    mean: float
    std: float
    failed: int

@final
class SobolIndices:
    inputs: list[str]
    first: Floats
    first_interval: Floats
    total: Floats
    total_interval: Floats
    pairs: list[tuple[str, str]]
    second: Floats
    second_interval: Floats
    variance: float
    blocks: int
    failed_blocks: int

@final
class MorrisEffects:
    inputs: list[str]
    mean: Floats
    mean_absolute: Floats
    mean_absolute_interval: Floats
    std: Floats

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
    def first(self) -> Floats: ...
    @property
    def total(self) -> Floats: ...
    def predict(self, rows: ArrayLike) -> Floats: ...

def begin(
    study: Path, out: Path, observations: int | None, resume: bool, overwrite: bool
) -> tuple[int, int]: ...
def make_shard(out: Path, index: int, count: int, threads: int) -> int: ...
def carry_out(
    out: Path,
    table: str,
    threads: int | None,
    complete: bool,
    progress: Callable[[int, int], object] | None,
) -> list[str]: ...
def observations(out: Path, sampling: str) -> tuple[list[str], Floats, Floats, list[str | None]]: ...
