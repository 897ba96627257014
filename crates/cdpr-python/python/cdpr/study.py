"""Studies, which find out which uncertain parameters of a robot matter.

A study is a file (`cdpr-study/1`) or the dictionary of one, whose robot may be a `Robot`. Without a folder for
the results they are kept until nothing refers to them; with one, its files are those of `cdpr study run`, byte
for byte.

>>> import cdpr
>>> study = cdpr.study.template(cdpr.Robot.from_file("cogiro"), [0, 0, 2], payload=40)
>>> results = cdpr.study.run(study, observations=64)
>>> results.observations("all")["status"][:2].tolist()
['ok', 'ok']
"""

from __future__ import annotations

import concurrent.futures
import csv
import json
import shutil
import tempfile
import weakref
from collections.abc import Callable, Iterator
from os import fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Optional

from . import _core, _inputs
from ._core import Robot
from .errors import FileError, InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy
    from numpy.typing import ArrayLike

__all__ = ["Results", "open_results", "run", "template"]

#: Columns of tables that hold text.
_TEXTS = ("sampling", "status", "dominant", "reason")

#: Called with the number of observations that are done, and that of all.
Progress = Callable[[int, int], object]


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

        It has moments, fitted laws, effects and measures of sensitivity of each sampling, and the comparison
        with the paper.
        """
        summary: dict[str, Any] = json.loads(self._text("summary.json"))
        return summary

    @property
    def timings(self) -> dict[str, Any]:
        """Content of `timings.json`: threads and seconds."""
        timings: dict[str, Any] = json.loads(self._text("timings.json"))
        return timings

    def status(self) -> dict[str, Any]:
        """Returns how far the study is: blocks, observations and failures of each design.

        It reads all blocks. The content is that of `cdpr study status --format json`.
        """
        status: dict[str, Any] = json.loads(_core.status(self.folder))
        return status

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
        `dz_mm`, `magnitude_mm`, and frequencies `frequency_hz`. A sampling at several poses has one for each
        of them, named `plane/0003`.
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

        Raises FileError.
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

        out: file for the report; `report.html` in the folder if left out.
        workspace: folder that `cdpr workspace --with boundary` has written: its region is drawn around the robot.
        overwrite: replace the file `out` if it exists.

        Raises FileError and InputError.
        """
        return Path(_core.write_report(self.folder, out, workspace, overwrite))

    def to_dataframe(self, sampling: str) -> Any:
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


def open_results(folder: _inputs.Path) -> Results:
    """Opens the results in a folder that `run` or `cdpr study run` has written.

    Raises FileError for a folder without results.
    """
    _core.open_results(folder)
    return Results(folder)


def template(
    robot: Robot,
    position: Optional[ArrayLike] = None,
    *,
    payload: Optional[float] = None,
    free: Optional[Sequence[str]] = None,
) -> dict[str, Any]:
    """Makes a study of a robot with usual tolerances, as `cdpr study new` does: a dictionary to be edited and run.

    position: of the platform [m], (3,); one on the vertical through the middle of the exit points if left out.
    payload: mass that is added [kg]; a tenth of the platform's if left out.
    free: names of the coordinates that are found, for a robot with fewer cables than free motions.

    Raises InputError, also where the robot does not hold the position.
    """
    text = _core.template(robot, position, payload, _inputs.names(free))
    return {**json.loads(text), "robot": robot}


def run(
    study: _inputs.Document,
    out: Optional[_inputs.Path] = None,
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
    """Runs a study and returns its results, in a folder if one is given.

    study: study file (`cdpr-study/1`), or its content as a dictionary. `robot` in it is a path, a name of the
        library, a `Robot` or the dictionary of one; other paths start from the working directory.
    out: folder for the results. If left out, they are in one of the system that is removed when nothing
        refers to the results any more.
    observations: number of observations of each sampling, in place of the study's.
    resume: continue with the blocks of this study that the folder holds. overwrite: start again. Without
        either, a folder that holds blocks is refused.
    table: "csv", or "none" for no tables of observations in the folder. If left out, samplings at one pose have
        tables as csv, and those at several poses, and without `out`, have none.
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
    if resume and out is None:
        raise InputError("out is None: expected the folder of the run that is to be continued")
    source, robot = _inputs.study(study)
    results = _temporary() if out is None else Results(out)
    table = "none" if out is None and table is None else table
    out = fspath(results.folder)
    blocks, total = _core.begin(source, robot, out, observations, resume, overwrite, table, threads)
    if executor is not None:
        done = 0
        count = max(1, min(blocks, 256) if tasks is None else tasks)
        # Workers may have another working directory.
        shards = [(str(Path(out).resolve()), number, count) for number in range(1, count + 1)]
        for made in _completed(executor, shards):
            done += made
            if progress is not None:
                progress(done, total)
    watcher = progress if executor is None else None
    results.notes = _core.carry_out(out, table, threads, executor is not None, total, watcher)
    if executor is not None and progress is not None:
        progress(total, total)
    return results


def _temporary() -> Results:
    """Results in a folder of the system, which is removed with them."""
    results = Results(tempfile.mkdtemp(prefix="cdpr-"))
    weakref.finalize(results, shutil.rmtree, results.folder, ignore_errors=True)
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
