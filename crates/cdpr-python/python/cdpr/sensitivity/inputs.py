"""Inputs of designs: laws by name or problems of SALib, groups, correlations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Optional, Union

from ..errors import InputError
from .laws import Law, lognormal, normal, triangular, truncated_normal, uniform, weibull

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

#: Inputs of a design: laws by name, or SALib's dictionary of a problem.
Inputs = Mapping[str, Any]
#: Correlations of normal scores: a matrix, or those of pairs by their names.
Correlation = Union["ArrayLike", Mapping[tuple[str, str], float]]
#: Names of the inputs of each group.
Groups = Mapping[str, Sequence[str]]

#: Parameters of SALib's distributions, and the law of these.
_SALIB: dict[str, tuple[tuple[str, ...], Any]] = {
    "unif": (("lower", "upper"), uniform),
    "norm": (("mean", "standard deviation"), normal),
    "lognorm": (("mean of the logarithm", "its standard deviation"), lognormal),
    "weibull": (("shape", "scale"), weibull),
    "triang": (
        ("lower", "upper", "peak as a share of the width"),
        lambda min, max, peak: triangular(min, min + peak * (max - min), max),
    ),
    "truncnorm": (
        ("lower", "upper", "mean", "standard deviation"),
        lambda min, max, mean, std: truncated_normal(mean, std, min, max),
    ),
}


def is_problem(inputs: Mapping[str, Any]) -> bool:
    """Whether this is SALib's dictionary of a problem, not one of laws by name."""
    return "names" in inputs and "bounds" in inputs


def laws_of_problem(problem: Mapping[str, Any]) -> dict[str, Law]:
    """Makes laws by name from SALib's dictionary of a problem.

    Parameters
    ----------
    problem : dict
        `names`, `bounds`, and `dists` (`unif` if left out); `num_vars` is compared with these, and
        everything else is left to others.

    Returns
    -------
    dict of dict
        The laws, in the order of `names`.

    Raises
    ------
    InputError
        For a distribution that has no law here.

    Examples
    --------
    >>> laws_of_problem({"num_vars": 1, "names": ["x"], "bounds": [[0, 3, 0.5]], "dists": ["triang"]})
    {'x': {'triangular': {'min': 0.0, 'mode': 1.5, 'max': 3.0}}}
    """
    names = [str(name) for name in problem["names"]]
    bounds = list(problem["bounds"])
    dists = list(problem.get("dists") or ["unif"] * len(names))
    count = problem.get("num_vars", len(names))
    for field, length in (("names", len(names)), ("bounds", len(bounds)), ("dists", len(dists))):
        if length != count:
            raise InputError(f"problem: {field} has the length {length}: expected {count}, as num_vars")
    if len(set(names)) < len(names):
        raise InputError(f"problem: names is {names}: expected each name once")
    laws = {}
    for name, numbers, dist in zip(names, bounds, dists):
        if dist not in _SALIB:
            # A variable that is uniform in its logarithm is the exponential of a uniform one.
            hint = "; log x is uniform: make it the input" if dist == "logunif" else ""
            raise InputError(f"problem: dists of `{name}` is {dist!r}: expected one of {', '.join(_SALIB)}{hint}")
        parameters, law = _SALIB[dist]
        try:
            values = [float(number) for number in numbers]
        except (TypeError, ValueError):
            values = []
        if len(values) != len(parameters):
            expected = f"{len(parameters)} numbers: {', '.join(parameters)}"
            raise InputError(f"problem: bounds of `{name}` is {numbers!r}: expected {expected}")
        laws[name] = law(*values)
    return laws


def groups_of_problem(problem: Mapping[str, Any]) -> Optional[dict[str, list[str]]]:
    """Returns the names of the inputs in each of SALib's groups, None where it has no groups."""
    groups = problem.get("groups")
    if groups is None or list(groups) == list(problem["names"]):
        return None
    if len(groups) != len(problem["names"]):
        expected = f"{len(problem['names'])}, one for each input"
        raise InputError(f"problem: groups has the length {len(groups)}: expected {expected}")
    found: dict[str, list[str]] = {}
    for name, group in zip(problem["names"], groups):
        found.setdefault(str(group), []).append(str(name))
    return found


def laws_of(inputs: Inputs) -> dict[str, Law]:
    """Laws by name, of a dictionary of these or of a problem of SALib."""
    if not isinstance(inputs, Mapping):
        expected = "a dictionary of laws by name, or SALib's dictionary of a problem"
        raise InputError(f"inputs is {inputs!r}: expected {expected}")
    return laws_of_problem(inputs) if is_problem(inputs) else dict(inputs)


def native_inputs(laws: dict[str, Law]) -> list[tuple[str, Any, Any]]:
    """Name, law and steps of each input."""
    return [
        (name, law["law"], law.get("steps")) if isinstance(law, Mapping) and "law" in law else (name, law, None)
        for name, law in laws.items()
    ]


def groups_of(inputs: Inputs, groups: Optional[Groups]) -> Optional[dict[str, list[str]]]:
    """Groups that are given, or those of a problem of SALib."""
    if groups is not None:
        return {name: [str(of) for of in names] for name, names in groups.items()}
    return groups_of_problem(inputs) if is_problem(inputs) else None


def indices_of(groups: Optional[Groups], laws: dict[str, Law]) -> Optional[list[tuple[str, list[int]]]]:
    """Groups with the indices of their inputs."""
    if groups is None:
        return None
    return [(group, [_index(of, laws, f"group `{group}`") for of in names]) for group, names in groups.items()]


def _index(name: str, names: Any, what: str) -> int:
    known = list(names)
    if name not in known:
        raise InputError(f"{what} has {name!r}: expected names of inputs, {', '.join(known)}")
    return known.index(name)


def matrix_of(correlation: Optional[Correlation], names: list[str]) -> Optional[list[list[float]]]:
    """The correlation matrix of all inputs."""
    import numpy

    if correlation is None:
        return None
    if isinstance(correlation, Mapping):
        matrix = numpy.eye(len(names))
        for pair, value in correlation.items():
            if len(pair) != 2 or pair[0] == pair[1]:
                raise InputError(f"correlation has {pair!r}: expected pairs of two inputs")
            i, j = (_index(name, names, "correlation") for name in pair)
            matrix[i, j] = matrix[j, i] = value
    else:
        matrix = numpy.asarray(correlation, dtype=float)
        if matrix.shape != (len(names), len(names)):
            expected = f"({len(names)}, {len(names)}), a row and a column for each input"
            raise InputError(f"correlation has the shape {matrix.shape}: expected {expected}")
    return [[float(value) for value in row] for row in matrix]
