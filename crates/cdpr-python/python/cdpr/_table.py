"""Estimates with a row for each input: arrays, `repr`, pandas and matplotlib."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Callable, Optional, TypeVar, Union, overload

from ._figures import axes_of

if TYPE_CHECKING:
    import numpy
    from numpy.typing import NDArray

_T = TypeVar("_T")


class Column:
    """An array with an element for each row, NaN for a row without one; `path` leads to it in a row."""

    def __init__(self, path: str, doc: str, rows: str = "inputs") -> None:
        self.path, self.rows, self.__doc__ = [key for key in path.split(".") if key], rows, doc

    @overload
    def __get__(self, of: None, owner: Any = None) -> Column: ...
    @overload
    def __get__(self, of: Table, owner: Any = None) -> NDArray[numpy.float64]: ...
    def __get__(self, of: Optional[Table], owner: Any = None) -> Union[Column, NDArray[numpy.float64]]:
        return self if of is None else self._array(of)

    def _array(self, of: Table) -> NDArray[numpy.float64]:
        import numpy

        return numpy.array(self._numbers(of, self.path), dtype=float)

    def _numbers(self, of: Table, path: list[str]) -> list[float]:
        def number(row: Any) -> float:
            for key in path:
                row = None if row is None else row[key]
            return float("nan") if row is None else float(row)

        return [number(row) for row in of.content[self.rows]]


class Interval(Column):
    """Intervals of estimates, (k, 2)."""

    def _array(self, of: Table) -> NDArray[numpy.float64]:
        import numpy

        ends = [self._numbers(of, [*self.path, end]) for end in ("low", "high")]
        return numpy.array(ends, dtype=float).T


class Value:
    """A value of the content, a number unless the documentation says otherwise."""

    def __init__(self, path: str, doc: str) -> None:
        self.path, self.__doc__ = path.split("."), doc

    def __get__(self, of: Any, owner: Any = None) -> Any:
        if of is None:
            return self
        value = of.content
        for key in self.path:
            value = value[key]
        return value


class Table:
    """Estimates with a row for each input. `content` has everything, as JSON has it."""

    #: Key of the rows in the content, and of the name of a row.
    _rows, _name = "inputs", "input"
    #: Columns that `plot` draws, of which the first decides the order. `repr` shows them.
    _drawn: tuple[str, ...] = ()
    #: Numbers that `repr` shows.
    _shown: tuple[str, ...] = ()
    #: Where `help` and errors say that the class is.
    _module = "cdpr.sensitivity"

    def __init__(self, content: dict[str, Any]) -> None:
        self.content = content

    @property
    def inputs(self) -> list[str]:
        """Names of the inputs, or of groups of these."""
        return [row[self._name] for row in self.content[self._rows]]

    def _leading(self, most: int) -> NDArray[Any]:
        """Indices of the rows with the greatest values of the first column that is drawn."""
        import numpy

        return numpy.argsort(-numpy.nan_to_num(numpy.abs(getattr(self, self._drawn[0]))), kind="stable")[:most]

    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each input; ends of intervals are `.._low`, `.._high`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
        import pandas

        columns: dict[str, NDArray[Any]] = {}
        for name, field in vars(type(self)).items():
            if isinstance(field, Interval) and field.rows == self._rows:
                stem = name.removesuffix("_interval")
                columns[f"{stem}_low"], columns[f"{stem}_high"] = getattr(self, name).T
            elif isinstance(field, Column) and field.rows == self._rows:
                columns[name] = getattr(self, name)
        return pandas.DataFrame(columns, index=pandas.Index(self.inputs, name=self._name))

    def plot(self, most: int = 20, *, ax: Any = None) -> Any:
        """Draws bars of the leading inputs with their intervals.

        Parameters
        ----------
        most : int, default 20
            Greatest number of inputs.
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
        import numpy

        order = self._leading(most)[::-1]
        axis = axes_of(ax, figsize=(6.4, 1.2 + 0.3 * len(order)))
        height = 0.8 / len(self._drawn)
        for k, name in enumerate(self._drawn):
            values, at = getattr(self, name)[order], numpy.arange(len(order)) - k * height
            ends = getattr(self, f"{name}_interval", None)
            # The estimate lies within its interval but for rounding.
            error = None if ends is None else numpy.abs(ends[order].T - values)
            axis.barh(at, values, height, xerr=error, label=name.replace("_", " "))
        axis.set_yticks(numpy.arange(len(order)) - 0.4 + height / 2, [self.inputs[k] for k in order])
        axis.legend()
        return axis.figure

    def __repr__(self) -> str:
        columns = {name: getattr(self, name) for name in self._drawn}
        rows = [
            " ".join([self.inputs[k][:40], *(f"{name} {column[k]:.4g}" for name, column in columns.items())])
            for k in self._leading(3)
        ]
        count = len(self.inputs)
        rest = ["..."] if count > len(rows) else []
        values = "".join(f", {name} {getattr(self, name):.4g}" for name in self._shown)
        name = f"{self._module}.{type(self).__name__}"
        names = f"{self._name[:-1]}ies" if self._name.endswith("y") else f"{self._name}s"
        return f"<{name} of {count} {names}{values}: {'; '.join(rows + rest)}>"


def count_of(outputs: Any) -> int:
    """The number of outputs that `by_output` takes apart."""
    import numpy

    if isinstance(outputs, Mapping):
        return len(outputs)
    try:
        shape = numpy.shape(outputs)
    except ValueError:  # of rows of different lengths
        return 1
    return int(shape[1]) if len(shape) == 2 else 1


def by_output(
    outputs: Any, one: Callable[..., _T], *more: Any, single: str = "y"
) -> Union[_T, dict[str, _T]]:
    """Calls `one(name, outputs, ..)` for an output a row, or for each of several outputs.

    Several outputs are a dictionary, a pandas.DataFrame or an array (n, m), whose outputs are called y1, y2,
    ... What else each of them has (`more`) is a dictionary with these names, or has an axis of m after that
    of the rows.
    """
    import numpy

    if isinstance(outputs, Mapping):
        names, columns = list(outputs), list(outputs.values())
    else:
        try:
            array = numpy.asarray(outputs)
        except ValueError:  # of rows of different lengths, which `one` refuses
            return one(single, outputs, *more)
        if array.ndim != 2:
            return one(str(getattr(outputs, "name", None) or single), outputs, *more)
        heads = getattr(outputs, "columns", None)
        names = [f"y{k + 1}" for k in range(array.shape[1])] if heads is None else [str(head) for head in heads]
        columns = list(array.T)

    def part(of: Any, k: int) -> Any:
        if isinstance(of, Mapping):
            return of[names[k]]
        array = numpy.asarray(of)
        return array[:, k] if array.ndim == 3 and array.shape[1] == len(names) else array

    return {
        name: one(name, column, *(part(of, k) for of in more))
        for k, (name, column) in enumerate(zip(names, columns))
    }
