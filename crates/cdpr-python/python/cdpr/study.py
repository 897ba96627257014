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
from ._results import Results, Sampling
from .errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike

__all__ = ["Results", "Sampling", "open_results", "run", "template"]

#: Called with the number of observations that are done, and that of all.
Progress = Callable[[int, int], object]


def open_results(folder: _inputs.Path) -> Results:
    """Opens the results in a folder that `run` or `cdpr study run` has written.

    Parameters
    ----------
    folder : path
        The folder.

    Returns
    -------
    Results
        The results.

    Raises
    ------
    FileError
        For a folder without results.

    Examples
    --------
    >>> import cdpr
    >>> study = cdpr.study.template(cdpr.Robot.from_file("cogiro"), [0, 0, 2])
    >>> results = cdpr.study.run(study, observations=16)
    >>> cdpr.study.open_results(results.folder).status()["complete"]
    True
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

    Parameters
    ----------
    robot : Robot
        The robot.
    position : array_like, optional
        Of the platform [m], (3,); one on the vertical through the middle of the exit points if left
        out.
    payload : float, optional
        Mass that is added [kg]; a tenth of the platform's if left out.
    free : sequence of str, optional
        Names of the coordinates that are found, for a robot with fewer cables than free motions.

    Returns
    -------
    dict
        The study, to be edited and run; its `robot` is the robot.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right; also where the robot does
        not hold the position.

    Examples
    --------
    >>> import cdpr
    >>> study = template(cdpr.Robot.from_file("cogiro"), [0, 0, 2], payload=40)  # [m], [kg]
    >>> study["payload"], list(study["samplings"])
    (40.0, ['all'])
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

    A block is whole or not there: a run that ended in any way continues with `resume=True`, to the same
    bytes.

    Parameters
    ----------
    study : path or dict
        Study file (`cdpr-study/1`), or its content as a dictionary. `robot` in it is a path, a name of
        the library, a `Robot` or the dictionary of one; other paths start from the working directory.
    out : path, optional
        Folder for the results. If left out, they are in one of the system that is removed when nothing
        refers to the results any more.
    observations : int, optional
        Number of observations of each sampling, instead of the study's.
    resume : bool, default False
        Continue with the blocks of this study that the folder holds. Without this or `overwrite`, a
        folder that holds blocks is refused.
    overwrite : bool, default False
        Remove what the folder holds, and start again.
    table : str, optional
        "csv", or "none" for no tables of observations in the folder. If left out, samplings at one pose
        have tables as csv, and those at several poses, and without `out`, have none.
    threads : int, optional
        Number of threads of this process; all cores if left out. The numbers do not depend on it.
    progress : callable, optional
        Function that is called with (done, all) observations from time to time, in the thread that
        called. What it raises ends the run, as Ctrl-C does.
    executor : object, optional
        What makes the blocks of observations, instead of this process: an executor of
        `concurrent.futures`, Dask's client, or a pool with `imap_unordered`, such as those of
        `multiprocessing` and `ray.util.multiprocessing`. Its workers need this package and the same
        folder. A pool of `multiprocessing` does not notice that a worker was killed, and the run waits
        forever.
    tasks : int, optional
        Number of tasks for the executor, each of which uses one thread. If left out, one for each block
        of 16 384 observations, and at most 256.

    Returns
    -------
    Results
        The results.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.
    FileError
        For a file or folder that cannot be read, written or used.
    NoSolutionError
        Where the nominal robot cannot hold a pose.

    Examples
    --------
    >>> import cdpr
    >>> study = template(cdpr.Robot.from_file("cogiro"), [0, 0, 2], payload=40)  # [m], [kg]
    >>> table = run(study, observations=16).observations("all")
    >>> table["magnitude_mm"].shape
    (16,)
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
