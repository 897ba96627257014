"""Frames of pandas of the native answers: the names and the units of the program's tables."""

from __future__ import annotations

import re
from typing import Any

#: Degrees of a radian, as Rust has them.
_DEGREES = 57.29577951308232
_PLACE = ["x{}_m", "y{}_m", "z{}_m"]
_ROTATION = ["qw{}", "qx{}", "qy{}", "qz{}"]
_MOVED = (["dx{}_mm", "dy{}_mm", "dz{}_mm"], 1e3)

#: Fields whose last axis has this length: the names of its elements, in which `{}` has the indices of further axes,
#: and what their numbers are multiplied with.
_VECTORS: dict[tuple[str, int], tuple[list[str], float]] = {
    ("pose", 7): (_PLACE + _ROTATION, 1),
    ("poses", 7): (_PLACE + _ROTATION, 1),
    ("position", 3): (_PLACE, 1),
    ("positions", 3): (_PLACE, 1),
    ("quaternion", 4): (_ROTATION, 1),
    ("displacement", 3): _MOVED,
    ("slopes", 3): _MOVED,
    ("rotation", 3): (["rx{}_deg", "ry{}_deg", "rz{}_deg"], _DEGREES),
    ("residual", 3): (["residual{}_closure_m", "residual{}_force_n", "residual{}_moment_nm"], 1),
    ("impulses", 2): (["impulse{}_s", "impulse{}_amplitude"], 1),
}

#: Fields with another name or unit in tables, and what their numbers are multiplied with.
_NUMBERS: dict[str, tuple[str, float]] = {
    "amplitude": ("amplitude{}_mm_per_n", 1e3),
    "amplitude_frequency": ("amplitude_at_hz", 1),
    "amplitudes": ("amplitude{}_mm_per_n", 1e3),
    "closure_residual": ("residual_closure_m", 1),
    "force_residual": ("residual_force_n", 1),
    "magnitude": ("magnitude{}_mm", 1e3),
    "moment_residual": ("residual_moment_nm", 1),
    "moved": ("moved{}_mm", 1e3),
    "nearest_cables": ("nearest_cables_mm", 1e3),
    "nearest_to_platform": ("nearest_to_platform_mm", 1e3),
    "out_of_limits": ("out_of_limits{}", 1),
    "per_force": ("per_force{}_mm_per_n", 1e3),
    "per_shortening": ("per_winch{}_mm_per_mm", 1),
    "std": ("std_mm", 1e3),
    "swing_moved": ("swing_moved{}_mm", 1e3),
    "tilt": ("tilt{}_deg", _DEGREES),
    "times": ("t_s", 1),
    "turned": ("turned{}_deg", _DEGREES),
    "winch_amplitude": ("winch_mm_per_mm", 1),
    "winch_frequency": ("winch_at_hz", 1),
}

#: The same of one class.
_OF_CLASS: dict[tuple[str, str], tuple[str, float]] = {
    ("Motion", "tensions"): ("t_anchor{}_n", 1),
    ("Motion", "exit_tensions"): ("t_exit{}_n", 1),
    ("MoveSummary", "amplitude"): ("amplitude_m", 1),
}

#: Entries of a stiffness in the halves of its rows and columns: of translations, then of rotations.
_STIFFNESS = (("n_per_m", "n_per_rad"), ("n", "nm_per_rad"))


def _unit(doc: str) -> str:
    """The ending for the one unit that a documentation names; empty where it names none, or several."""
    found = {text.removesuffix(" per unit") for text in re.findall(r"\[([^\]]+)\]", doc)}
    unit = found.pop() if len(found) == 1 else ""
    if re.search(r"[,(]", unit):
        return ""
    return unit.lower().replace("/", "_per_").replace(" ", "").replace("²", "2")


def _singular(name: str) -> str:
    """The name of an element of a list."""
    if name.endswith("ies"):
        return f"{name[:-3]}y"
    return name[:-1] if name.endswith("s") and not name.endswith(("ss", "us")) else name


def _template(kind: str, name: str, doc: str, is_list: bool) -> tuple[str, float]:
    """The name of a column, in which `{}` has the indices of an element, and the factor of its numbers."""
    known = _OF_CLASS.get((kind, name)) or _NUMBERS.get(name)
    if known is not None:
        return known
    unit = _unit(doc)
    stem = name.removesuffix(f"_{unit}") if unit else name
    return f"{_singular(stem) if is_list else stem}{{}}{'_' if unit else ''}{unit}", 1


def _columns(kind: str, name: str, doc: str, shape: tuple[int, ...]) -> list[tuple[tuple[int, ...], str, float]]:
    """Index, name and factor of each element of a field of this shape."""
    import numpy

    if kind == "Stiffness" and shape == (6, 6):
        stem = "k" if name == "matrix" else name
        unit = [[_STIFFNESS[row > 2][column > 2] for column in range(6)] for row in range(6)]
        return [((i, j), f"{stem}_{i + 1}{j + 1}_{unit[i][j]}", 1) for i, j in numpy.ndindex(6, 6)]
    vector = _VECTORS.get((name, shape[-1])) if shape else None
    if vector is not None and not (name == "rotation" and len(shape) > 1):
        names, factor = vector
        templates = [(name, factor) for name in names]
    else:
        templates = []
    own = _template(kind, name, doc, bool(shape))
    found = []
    for index in numpy.ndindex(*shape):
        template, factor = templates[index[-1]] if templates else own
        labels = "".join(f"_{k + 1}" for k in (index[:-1] if templates else index))
        found.append((index, template.format(labels), factor))
    return found


def frame_of(answer: Any, names: list[str]) -> Any:
    """A pandas.DataFrame of the fields of a native answer with these names, a row for each case or time."""
    import numpy
    import pandas

    kind, rows = type(answer).__name__, getattr(answer, "reasons", None)
    if rows is None:
        rows = getattr(answer, "times", None)
    single, count = rows is None, 1 if rows is None else len(rows)
    inputs = getattr(answer, "inputs", None) or []
    prefix = "std_" if kind == "PathDeviations" else ""
    columns: dict[str, Any] = {}
    for name in names:
        value = getattr(answer, name)
        if isinstance(value, list):
            if not single and len(value) == count:
                columns[_singular(name)] = pandas.Series(value, dtype=object)  # None stays None
            continue
        if value is None or isinstance(value, (dict, tuple)) or type(value).__module__ == "cdpr":
            continue
        array = numpy.asarray(value)[None] if single else numpy.asarray(value)
        if array.ndim == 0 or len(array) != count:
            continue
        shape, doc = array.shape[1:], getattr(type(answer), name).__doc__ or ""
        is_of_inputs = bool(inputs) and bool(shape) and shape[-1] == len(inputs)
        ends = [f"/{of}" for of in inputs] if is_of_inputs else [""]
        side = "right_" if name.endswith("_right") else ""
        fields = _columns(kind, name.removesuffix("_right"), doc, shape[:-1] if is_of_inputs else shape)
        for k, end in enumerate(ends):
            for index, head, factor in fields:
                at: Any = (slice(None), *index, *([k] if is_of_inputs else []))
                column = array[at]
                columns[f"{prefix}{side}{head}{end}"] = column if factor == 1 else factor * column
    return pandas.DataFrame(columns)
