"""What calls take as files, or as what is in such files: dictionaries, arrays, pandas frames."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, Optional, Protocol, Union

from .errors import InputError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ._core import Robot

#: A path.
Path = Union[str, "PathLike[str]"]
#: A path, or the dictionary that `json.loads` makes of such a file.
Document = Union[Path, Mapping[str, Any]]
#: A path, or the text of such a file with its name, as the native half takes it.
Source = Union[str, tuple[str, str]]


class Frame(Protocol):
    """Columns by their names, as a pandas.DataFrame has them."""

    @property
    def columns(self) -> Any: ...
    def __getitem__(self, key: Any, /) -> Any: ...


#: A path, or columns by their names: a dictionary of arrays or a pandas.DataFrame.
Table = Union[Path, Mapping[str, "ArrayLike"], Frame]


def document(name: str, given: Document) -> Source:
    """The file, or the dictionary as the text of one."""
    if isinstance(given, (str, PathLike)):
        return fspath(given)
    if not isinstance(given, Mapping):
        raise InputError(f"{name} is {_kind(given)}: expected the path of a file, or its content as a dictionary")
    try:
        return name, json.dumps(given, default=_plain, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name} cannot be written as JSON ({error}): expected what `json.loads` makes") from error


def study(given: Document) -> tuple[Source, Optional[Robot]]:
    """The study, and its robot where the dictionary has one instead of the path of its file."""
    from ._core import Robot

    if not isinstance(given, Mapping):
        return document("study", given), None
    robot = given.get("robot")
    if isinstance(robot, Mapping):
        robot = Robot.from_dict(dict(robot))
    if isinstance(robot, Robot):
        return document("study", {**given, "robot": robot.name}), robot
    if isinstance(robot, PathLike):
        given = {**given, "robot": fspath(robot)}
    return document("study", given), None


def table(name: str, given: Table) -> Source:
    """The file, or columns by their names as the text of one."""
    import numpy

    if isinstance(given, (str, PathLike)):
        return fspath(given)
    heads = list(given) if isinstance(given, Mapping) else list(getattr(given, "columns", ()))
    expected = "the path of a file, a dictionary of arrays or a pandas.DataFrame"
    if not heads:
        raise InputError(f"{name} is {_kind(given)}: expected {expected}")
    columns = [numpy.asarray(given[head]) for head in heads]
    for head, column in zip(heads, columns):
        if column.ndim != 1:
            shape = f"the shape {column.shape}"
            raise InputError(f"{name}: {head} has {shape}: expected (m,), a number for each row")
        if len(column) != len(columns[0]):
            rows = f"{len(columns[0])} rows, as {heads[0]}"
            raise InputError(f"{name}: {head} has {len(column)} rows: expected {rows}")
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(heads)
    writer.writerows([_cell(value) for value in row] for row in zip(*(column.tolist() for column in columns)))
    return name, text.getvalue()


def columns_of(text: str) -> dict[str, Any]:
    """The columns of a table of numbers, NaN where a cell is empty."""
    import numpy

    header, *rows = csv.reader(text.splitlines())
    cells = list(zip(*rows)) or [()] * len(header)
    return {head: numpy.array([cell or "nan" for cell in column], "f8") for head, column in zip(header, cells)}


def numbers(given: Optional[Mapping[str, float]]) -> list[tuple[str, float]]:
    """Numbers by their names, none if left out."""
    return [(name, float(value)) for name, value in (given or {}).items()]


def uncertainty(given: Union[Document, Mapping[str, float]]) -> Union[Source, list[tuple[str, float]]]:
    """Standard deviations by their names, or the error model as a file or the text of one."""
    if isinstance(given, Mapping) and not any(isinstance(value, (str, Mapping)) for value in given.values()):
        return numbers(given)
    return document("uncertainty", given)


def names(given: Any) -> Optional[list[str]]:
    """A list of names, or None."""
    return None if given is None else list(given)


def _cell(value: Any) -> Any:
    """A cell: numbers to the last bit, nothing for None and NaN."""
    return "" if value is None or value != value else repr(value) if isinstance(value, float) else value


def _kind(given: Any) -> str:
    return f"of the type {type(given).__name__}"


def _plain(value: Any) -> Any:
    """What JSON has for arrays and numbers of NumPy and for robots."""
    for method in ("to_dict", "tolist"):
        if hasattr(value, method):
            return getattr(value, method)()
    raise TypeError(f"{value!r} is a {type(value).__name__}")
