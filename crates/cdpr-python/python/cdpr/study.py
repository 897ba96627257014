"""Studies: which uncertain parameters of a robot matter. The same files as `cdpr study run` writes, byte for byte.

>>> import cdpr
>>> results = cdpr.study.run("data/studies/caroca.json", out="results", observations=500)
>>> results.summary["studies"]["mechanical"]["rms_mm"]["mean"]
>>> results.observations("mechanical")["rms_mm"]
"""

from __future__ import annotations

import concurrent.futures
import json
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Iterator, Optional, Union

from . import _core

if TYPE_CHECKING:
    import numpy

__all__ = ["Results", "open_results", "run"]

#: Told how many observations of how many are there.
Progress = Callable[[int, int], object]


class Results:
    """A folder of results."""

    def __init__(self, folder: Union[str, "PathLike[str]"]) -> None:
        #: The folder.
        self.folder = Path(folder)
        #: What a run could not draw, and damaged blocks that it made again.
        self.notes: list[str] = []

    @property
    def summary(self) -> dict[str, Any]:
        """`summary.json`: moments, fitted laws, effects and measures of sensitivity of each sampling, and the comparison with the paper."""
        return json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))

    @property
    def timings(self) -> dict[str, Any]:
        """`timings.json`: threads and seconds."""
        return json.loads((self.folder / "timings.json").read_text(encoding="utf-8"))

    def observations(self, sampling: str) -> "numpy.ndarray[Any, Any]":
        """The observations of a sampling as a structured array, with the columns of its table but for `reason`: `index`, `d_mass`, ... [SI units],
        `dx_mm`, `dy_mm`, `dz_mm`, `rms_mm` (NaN where it failed), `status` (`ok` or the kind of failure). Of a sampling at several poses
        those at one of them, by its name: `plane/0003`."""
        import numpy

        names, rows, deflections, failures = _core.observations(self.folder, sampling)
        status = numpy.array([failure or "ok" for failure in failures])
        columns = {f"d_{name}": column for name, column in zip(names, rows.T)}
        columns.update(zip(("dx_mm", "dy_mm", "dz_mm", "rms_mm"), deflections.T))
        fields = [("index", "i8"), *((name, "f8") for name in columns), ("status", status.dtype)]
        table = numpy.empty(len(rows), dtype=fields)
        table["index"] = numpy.arange(len(rows))
        for name, column in columns.items():
            table[name] = column
        table["status"] = status
        return table

    def frame(self, sampling: str) -> Any:
        """The same as a `pandas.DataFrame`, with the index as its index."""
        import pandas

        return pandas.DataFrame(self.observations(sampling)).set_index("index")

    def __repr__(self) -> str:
        return f"<cdpr.study.Results {self.folder}>"


def open_results(folder: Union[str, "PathLike[str]"]) -> Results:
    """The results in a folder that `run` or `cdpr study run` has written."""
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

    observations: of each sampling, in place of the file's.
    resume: go on with what the folder holds of this study; overwrite: begin anew. Else a folder that holds blocks is refused.
    table: "csv", or "none" for no tables of observations; csv if left out, but none of samplings at several poses.
    threads: of this process; all cores if left out. The numbers do not depend on it.
    progress: told (done, all) observations from time to time, in the thread that called; what it raises ends the run, as Ctrl-C does.
    executor: who makes the blocks of observations, in place of this process: an executor of `concurrent.futures`, Dask's client, or a pool with
        `imap_unordered`, such as those of `multiprocessing` and `ray.util.multiprocessing`. Its workers need this package and the same folder.
    tasks: in how many tasks; one for each block of 16 384 observations, but 256 at most, if left out. Each uses one thread.

    Blocks are whole or not there: a run that ended in any way goes on with `resume=True`, to the same bytes.

    Raises InputError, FileError, NoSolutionError where the nominal robot cannot hold a pose, and what the executor raises.
    """
    out = fspath(out)
    blocks, total = _core.begin(study, out, observations, resume, overwrite)
    if executor is not None:
        done = 0
        count = max(1, min(blocks, 256) if tasks is None else tasks)
        # Workers may stand elsewhere in the file system.
        shards = [(str(Path(out).resolve()), number, count) for number in range(1, count + 1)]
        for made in _completed(executor, shards):
            done += made
            if progress is not None:
                progress(done, total)
    results = Results(out)
    told = progress if executor is None else None
    results.notes = _core.carry_out(out, table, threads, executor is not None, told)
    if executor is not None and progress is not None:
        progress(total, total)
    return results


def _make_shard(shard: tuple[str, int, int]) -> int:
    """A task, on a worker."""
    folder, number, count = shard
    return _core.make_shard(folder, number, count, 1)


def _completed(executor: Any, shards: list[tuple[str, int, int]]) -> Iterator[int]:
    """Observations of each task, as they are done."""
    if hasattr(executor, "get_executor"):
        # Dask's client: tasks write files, so that two of the same arguments are not one.
        executor = executor.get_executor(pure=False)
    if hasattr(executor, "submit"):
        futures = [executor.submit(_make_shard, shard) for shard in shards]
        try:
            for future in concurrent.futures.as_completed(futures):
                yield future.result()
        finally:
            for future in futures:
                future.cancel()
    elif hasattr(executor, "imap_unordered"):
        yield from executor.imap_unordered(_make_shard, shards)
    else:
        raise TypeError(f"executor is {executor!r}: expected one with `submit` or `imap_unordered`")
