"""Studies, which find out which uncertain parameters of a robot matter.

The files are those of `cdpr study run`, byte for byte.

>>> import cdpr
>>> results = cdpr.study.run("data/studies/caroca.json", out="results", observations=500)
>>> results.summary["studies"]["mechanical"]["rms_mm"]["mean"]
>>> results.observations("mechanical")["rms_mm"]
"""

from __future__ import annotations

import concurrent.futures
import csv
import json
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Iterator, Optional, Union

from . import _core
from .errors import FileError, InputError

if TYPE_CHECKING:
    import numpy

__all__ = ["Results", "open_results", "run"]

_Path = Union[str, "PathLike[str]"]

#: Columns of tables that hold text.
_TEXTS = ("sampling", "status", "dominant", "reason")

#: Called with the number of observations that are done, and that of all.
Progress = Callable[[int, int], object]


class Results:
    """A folder of results."""

    def __init__(self, folder: Union[str, "PathLike[str]"]) -> None:
        #: The folder.
        self.folder = Path(folder)
        #: Figures that a run could not draw, and damaged blocks that it made again.
        self.notes: list[str] = []

    @property
    def summary(self) -> dict[str, Any]:
        """Content of `summary.json`.

        It has the verdict of each part (`["studies"][name]["verdict"]`: its sentences and the recommended
        measure of each input), moments, fitted laws, effects and measures of sensitivity.
        """
        return json.loads(self._text("summary.json"))

    @property
    def timings(self) -> dict[str, Any]:
        """Content of `timings.json`: threads and seconds."""
        return json.loads(self._text("timings.json"))

    def status(self) -> dict[str, Any]:
        """Returns how far the study is: blocks, observations and failures of each design.

        It reads all blocks. The content is that of `cdpr study status --format json`.
        """
        return json.loads(_core.status(self.folder))

    def table(self, name: str) -> "numpy.ndarray[Any, Any]":
        """Returns the table `NAME.csv` as a structured array, with NaN or "" where a cell is empty.

        A sampling at several poses has a row for each pose, a surface a row for each point.
        """
        import numpy

        header, *rows = csv.reader(self._text(f"{name}.csv").splitlines(keepends=True))
        columns = [
            numpy.array(column, dtype=str)
            if head in _TEXTS
            else numpy.array([cell or "nan" for cell in column], dtype="f8")
            for head, column in zip(header, zip(*rows))
        ]
        return _records(dict(zip(header, columns)))

    def observations(self, sampling: str) -> "numpy.ndarray[Any, Any]":
        """Returns the observations of a sampling as a structured array.

        Columns are those of its table without `reason`: `index`, `d_mass`, ... [SI units], those of the
        output (NaN where it failed), `status` (`ok` or the kind of failure). Deflections have `dx_mm`, `dy_mm`,
        `dz_mm`, `rms_mm`, and frequencies `frequency_hz`. A sampling at several poses has one for each of
        them, named `plane/0003`.
        """
        import numpy

        names, rows, output, cells, failures = _core.observations(self.folder, sampling)
        columns = {"index": numpy.arange(len(rows), dtype="i8")}
        columns.update((f"d_{name}", column) for name, column in zip(names, rows.T))
        columns.update(zip(output, cells.T))
        columns["status"] = numpy.array([failure or "ok" for failure in failures])
        return _records(columns)

    def report(
        self, out: Optional[_Path] = None, *, workspace: Optional[_Path] = None, overwrite: bool = False
    ) -> Path:
        """Writes the report (HTML) again and returns its path, as `cdpr report` does.

        out: file for the report; `report.html` in the folder if left out.
        workspace: folder that `cdpr workspace --boundary` has written: its region is drawn around the robot.
        overwrite: replace the file `out` if it exists.

        Raises FileError and InputError.
        """
        return Path(_core.write_report(self.folder, out, workspace, overwrite))

    def frame(self, sampling: str) -> Any:
        """Returns the observations of a sampling as a `pandas.DataFrame`, with `index` as its index."""
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


def open_results(folder: Union[str, "PathLike[str]"]) -> Results:
    """Opens the results in a folder that `run` or `cdpr study run` has written.

    Raises FileError for a folder without results.
    """
    _core.open_results(folder)
    return Results(folder)


def run(
    study: Union[str, "PathLike[str]"],
    out: Union[str, "PathLike[str]"] = "results",
    *,
    observations: Optional[int] = None,
    resume: bool = False,
    overwrite: bool = False,
    table: Optional[str] = None,
    threads: Optional[int] = None,
    progress: Optional[Progress] = None,
    executor: Any = None,
    tasks: Optional[int] = None,
) -> Results:
    """Runs a study file (`cdpr-study/1`) and writes its results into a folder.

    observations: number of observations of each sampling, in place of the file's.
    resume: continue with the blocks of this study that the folder holds. overwrite: start anew. Without
        either, a folder that holds blocks is refused.
    table: "csv", or "none" for no tables of observations. If left out, samplings at one pose have tables as
        csv, and those at several poses have none.
    threads: number of threads of this process; all cores if left out. The numbers do not depend on it.
    progress: function that is called with (done, all) observations from time to time, in the thread that
        called. What it raises ends the run, as Ctrl-C does.
    executor: what makes the blocks of observations, in place of this process: an executor of
        `concurrent.futures`, Dask's client, or a pool with `imap_unordered`, such as those of
        `multiprocessing` and `ray.util.multiprocessing`. Its workers need this package and the same folder. A
        pool of `multiprocessing` does not notice that a worker was killed, and the run waits forever.
    tasks: number of tasks for the executor, each of which uses one thread. If left out, one for each block of
        16 384 observations, and at most 256.

    A block is whole or not there: a run that ended in any way continues with `resume=True`, to the same
    bytes.

    Raises InputError, FileError, NoSolutionError where the nominal robot cannot hold a pose, and what the
    executor raises.
    """
    # All arguments are checked before anything is removed or made.
    for name, number in (("threads", threads), ("tasks", tasks)):
        if number is not None and number < 1:
            raise InputError(f"{name} is {number}: expected one or more")
    if progress is not None and not callable(progress):
        raise TypeError(f"progress is {progress!r}: expected a function of two numbers")
    if not (executor is None or hasattr(executor, "submit") or hasattr(executor, "imap_unordered")):
        raise TypeError(f"executor is {executor!r}: expected one with `submit` or `imap_unordered`")
    out = fspath(out)
    blocks, total = _core.begin(study, out, observations, resume, overwrite, table, threads)
    if executor is not None:
        done = 0
        count = max(1, min(blocks, 256) if tasks is None else tasks)
        # Workers may have another working directory.
        shards = [(str(Path(out).resolve()), number, count) for number in range(1, count + 1)]
        for made in _completed(executor, shards):
            done += made
            if progress is not None:
                progress(done, total)
    results = Results(out)
    watcher = progress if executor is None else None
    results.notes = _core.carry_out(out, table, threads, executor is not None, total, watcher)
    if executor is not None and progress is not None:
        progress(total, total)
    return results


def _records(columns: "dict[str, numpy.ndarray[Any, Any]]") -> "numpy.ndarray[Any, Any]":
    """Makes a structured array of columns, with aligned fields."""
    import numpy

    dtype = numpy.dtype([(name, column.dtype) for name, column in columns.items()], align=True)
    table = numpy.empty(len(next(iter(columns.values()))), dtype)
    for name, column in columns.items():
        table[name] = column
    return table


def _make_shard(shard: tuple[str, int, int]) -> int:
    """Runs one task on a worker."""
    folder, number, count = shard
    return _core.make_shard(folder, number, count, 1)


def _completed(executor: Any, shards: list[tuple[str, int, int]]) -> Iterator[int]:
    """Yields the number of observations of each task when it is done."""
    if hasattr(executor, "get_executor"):
        # Dask's client: tasks write files, so that two tasks with the same arguments must both run.
        executor = executor.get_executor(pure=False)
    if hasattr(executor, "submit"):
        futures = [executor.submit(_make_shard, shard) for shard in shards]
        try:
            for future in concurrent.futures.as_completed(futures):
                yield future.result()
        finally:
            for future in futures:
                future.cancel()
    else:
        yield from executor.imap_unordered(_make_shard, shards)
