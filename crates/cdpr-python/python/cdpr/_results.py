"""The results of a study, in their folder."""

from __future__ import annotations

import csv
import json
import shutil
from os import fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Optional

from . import _core, _inputs
from ._table import Column, Interval, Table, Value
from .errors import FileError, InputError

if TYPE_CHECKING:
    import numpy

#: Columns of tables that hold text.
_TEXTS = ("sampling", "input", "status", "dominant", "reason")

#: Numbers of cells that are none.
_NUMBERS = {"": "nan", "true": "1", "false": "0"}


class Sampling(Table):
    """The results of a sampling at one pose, a row for each uncertain parameter.

    Numbers are in the unit that the name of the output has, `output`.
    """

    _rows, _name, _drawn, _module = "effects", "input", ("effect",), "cdpr.study"
    _shown = ("mean", "std")

    effect = Column("effect", "Mean output in the upper half of the range minus that in the lower half, (k,).", "effects")
    effect_interval = Interval("", "Intervals of these, (k, 2); NaN without replicates.", "effects")
    student = Column("student", "The paper's t-Student index, (k,).", "effects")
    mean = Value("values.mean", "Mean of the output.")
    std = Value("values.std", "Standard deviation of the output, with n - 1.")
    min = Value("values.min", "Least output.")
    max = Value("values.max", "Greatest output.")
    median = Value("values.median", "Median of the output.")
    nominal = Value("values.nominal", "Output of the nominal robot.")

    def __init__(self, output: str, summary: dict[str, Any]) -> None:
        given = next(of for name, of in summary.items() if name.startswith("signed_effects"))
        effects = [
            {"input": name, "student": student, **given.get(name, {"effect": None, "low": None, "high": None})}
            for name, student in summary["t_student"].items()
        ]
        super().__init__({**summary, "effects": effects, "values": summary[output]})
        #: Name of the output with its unit, `magnitude_mm`.
        self.output = output

    @property
    def observations(self) -> int:
        """Number of observations, failed ones included."""
        return int(self.content["observations"])

    @property
    def failed(self) -> dict[str, int]:
        """Failed observations by kind."""
        return dict(self.content["failed"])

    @property
    def notes(self) -> list[str]:
        """What could not be computed, and why."""
        return list(self.content["notes"])

    @property
    def verdict(self) -> str:
        """The answer in words, as the program prints it."""
        return "\n".join(self.content["verdict"]["sentences"])

    def __repr__(self) -> str:
        return f"<cdpr.study.Sampling: {' '.join(self.content['verdict']['sentences'][:2])}>"


class Results:
    """The results of a study, in their folder."""

    def __init__(self, folder: _inputs.Path) -> None:
        #: The folder; one that is removed with these results where none was given.
        self.folder = Path(folder)
        #: Figures that a run could not draw, and damaged blocks that it made again.
        self.notes: list[str] = []

    @property
    def summary(self) -> dict[str, Any]:
        """Content of `summary.json`.

        It has the verdict of each part (`["studies"][name]["verdict"]`: its sentences and the recommended
        measure of each input), moments, fitted laws, effects and measures of sensitivity.
        """
        summary: dict[str, Any] = json.loads(self._text("summary.json"))
        return summary

    @property
    def verdict(self) -> dict[str, str]:
        """The answer of each part of the study in words, as the program prints it."""
        studies = self.summary["studies"].items()
        return {name: "\n".join(part["verdict"]["sentences"]) for name, part in studies}

    def sampling(self, name: str) -> Sampling:
        """Reads the results of a sampling at one pose.

        Parameters
        ----------
        name : str
            Name of the sampling.

        Returns
        -------
        Sampling
            Statistics of the output, and the effect of each parameter.

        Raises
        ------
        FileError
            For a run that has not ended.
        InputError
            For a name that no sampling at one pose has, and for one with fewer than two observations that
            succeeded.
        """
        studies = self.summary["studies"]
        summary = studies.get(name, {})
        statistics = (key for key, of in summary.items() if isinstance(of, dict) and {"mean", "nominal"} <= set(of))
        output = next(statistics, None)
        if "t_student" not in summary or output is None:
            known = ", ".join(key for key, of in studies.items() if "t_student" in of)
            raise InputError(f"name is {name!r}: expected a sampling with observations, one of {known}")
        return Sampling(output, summary)

    @property
    def timings(self) -> dict[str, Any]:
        """Content of `timings.json`: threads and seconds."""
        timings: dict[str, Any] = json.loads(self._text("timings.json"))
        return timings

    def status(self) -> dict[str, Any]:
        """Returns how far the study is: blocks, observations and failures of each design.

        It reads all blocks. The content is that of `cdpr study status --format json`.

        Returns
        -------
        dict
            Blocks, observations and failures of each design.
        """
        status: dict[str, Any] = json.loads(_core.status(self.folder))
        return status

    def table(self, name: str) -> "numpy.ndarray[Any, Any]":
        """Returns the table `NAME.csv` as a structured array, NaN or "" where a cell is empty, 1 for true.

        A sampling at several poses has a row for each pose, a surface a row for each point, `SAMPLING_sensitivity` a
        row for each parameter with all measures.

        Parameters
        ----------
        name : str
            Name of a sampling at several poses, of a surface, or of another table.

        Returns
        -------
        numpy.ndarray
            A structured array with a row for each pose or point.
        """
        import numpy

        header, *rows = csv.reader(self._text(f"{name}.csv").splitlines(keepends=True))
        columns = [
            numpy.array(column, dtype=str)
            if head in _TEXTS
            else numpy.array([_NUMBERS.get(cell, cell) for cell in column], dtype="f8")
            for head, column in zip(header, zip(*rows))
        ]
        return _records(dict(zip(header, columns)))

    def observations(self, sampling: str) -> "numpy.ndarray[Any, Any]":
        """Returns the observations of a sampling as a structured array.

        Columns are those of its table without `reason`: `index`, `d_mass`, ... [SI units], those of the
        output (NaN where it failed), `status` (`ok` or the kind of failure). Deflections have `dx_mm`, `dy_mm`,
        `dz_mm`, `magnitude_mm`, and frequencies `frequency_hz`. A sampling at several poses has one for each
        of them, named `plane/0003`.

        Parameters
        ----------
        sampling : str
            Name of the sampling.

        Returns
        -------
        numpy.ndarray
            A structured array with a row for each observation.
        """
        import numpy

        names, rows, output, cells, failures = _core.observations(self.folder, sampling)
        columns = {"index": numpy.arange(len(rows), dtype="i8")}
        columns.update((f"d_{name}", column) for name, column in zip(names, rows.T))
        columns.update(zip(output, cells.T))
        columns["status"] = numpy.array([failure or "ok" for failure in failures])
        return _records(columns)

    def save(self, folder: _inputs.Path) -> Results:
        """Copies the folder to one that does not exist yet, and returns the results there.

        Parameters
        ----------
        folder : path
            The folder.

        Returns
        -------
        Results
            The results in the new folder.

        Raises
        ------
        FileError
            For a file or folder that cannot be read, written or used.
        """
        try:
            shutil.copytree(self.folder, fspath(folder))
        except OSError as error:
            raise FileError(f"cannot write {fspath(folder)}: {error}: expected a folder that can be made") from error
        return Results(folder)

    def report(
        self,
        out: Optional[_inputs.Path] = None,
        *,
        workspace: Optional[_inputs.Path] = None,
        overwrite: bool = False,
    ) -> Path:
        """Writes the report (HTML) again and returns its path, as `cdpr study report` does.

        Parameters
        ----------
        out : path, optional
            File for the report; `report.html` in the folder if left out.
        workspace : path, optional
            Folder that `cdpr workspace --with boundary` has written: its region is drawn around the robot.
        overwrite : bool, default False
            Replace the file `out` if it exists.

        Returns
        -------
        Path
            Path of the report.

        Raises
        ------
        FileError
            For a file or folder that cannot be read, written or used.
        InputError
            For an invalid value; the message names it and what would be right.
        """
        return Path(_core.write_report(self.folder, out, workspace, overwrite))

    def to_dataframe(self, sampling: str) -> Any:
        """Returns the observations of a sampling as a `pandas.DataFrame`, with `index` as its index.

        Parameters
        ----------
        sampling : str
            Name of the sampling.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
        import pandas

        return pandas.DataFrame(self.observations(sampling)).set_index("index")

    def _text(self, name: str) -> str:
        path = self.folder / name
        try:
            return path.read_text(encoding="utf-8")
        except OSError as error:
            expected = "expected the results of a run that has ended"
            raise FileError(f"cannot read {path}: {error.strerror}: {expected}") from error

    def __repr__(self) -> str:
        return f"<cdpr.study.Results {self.folder}>"


def _records(columns: "dict[str, numpy.ndarray[Any, Any]]") -> "numpy.ndarray[Any, Any]":
    """Makes a structured array of columns, with aligned fields."""
    import numpy

    dtype = numpy.dtype([(name, column.dtype) for name, column in columns.items()], align=True)
    table = numpy.empty(len(next(iter(columns.values()))), dtype)
    for name, column in columns.items():
        table[name] = column
    return table
