"""Robots from and for other programs, and those that come with the package.

>>> import cdpr
>>> "cogiro" in cdpr.exchange.robots()
True
>>> cogiro = cdpr.Robot.from_file("cogiro")
>>> exported = cdpr.exchange.export(cogiro, [0, 0, 2], to="mjcf")
>>> exported.text[:7]
'<mujoco'
"""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, Optional, Union

from . import _core, _inputs
from ._core import Robot
from .errors import FileError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["Exported", "Imported", "Note", "cables", "export", "read", "robots"]


def robots() -> list[str]:
    """Lists the names of the robots that come with the package, which `Robot.from_file` takes.

    Returns
    -------
    list of str
        Names, which `Robot.from_file` takes.

    Examples
    --------
    >>> "cogiro" in robots()
    True
    """
    return _core.library()[0]


def cables() -> list[str]:
    """Lists the names of the cables that come with the package, which `read` takes.

    Returns
    -------
    list of str
        Names, which `read` takes.

    Examples
    --------
    >>> "steel-4mm" in cables()
    True
    """
    return _core.library()[1]


class Note(NamedTuple):
    """What to know of an import.

    Attributes
    ----------
    kind : str
        "assumed", "questioned" or "no place for".
    place : (str, int) or None
        File and line; None without a place in a file.
    text : str
        A sentence.
    """

    kind: str
    place: Optional[tuple[str, int]]
    text: str


class Imported(NamedTuple):
    """A robot made of the files of another program.

    Attributes
    ----------
    robot : Robot
        The robot.
    notes : list of Note
        What was assumed, what is questioned, what a robot file has no place for.
    """

    robot: Robot
    notes: list[Note]


def read(
    files: Union[_inputs.Path, Sequence[_inputs.Path]],
    *,
    cable: Optional[_inputs.Path] = None,
    mass: Optional[float] = None,
    center_of_mass: Optional[ArrayLike] = None,
    tension_limits: Optional[ArrayLike] = None,
    cable_set: Optional[str] = None,
) -> Imported:
    """Makes a robot of the files of another program, as `cdpr robot import` does.

    Parameters
    ----------
    files : path or sequence of path
        Bodies and cables of CASPR or the folder that has them, a .wcrfx file of WireX, a model of
        MuJoCo, YAML of oKermorgant's cdpr or the SDF made of it, JSON of IRMA, a system of MoorPy or
        MoorDyn, or a table of points (CSV).
    cable : path, optional
        Cable of all cables: a cable file, or a name of `cables()`.
    mass : float, optional
        Mass of the platform [kg], instead of that in the files.
    center_of_mass : array_like, optional
        In the platform frame [m], (3,), instead of that in the files.
    tension_limits : array_like, optional
        Least and greatest tension [N], (2,), instead of those in the files.
    cable_set : str, optional
        Cable set of CASPR; the default one if left out.

    Returns
    -------
    Imported
        The robot, and notes.

    Raises
    ------
    InputError
        The message names file, line and element, or what the files lack.
    FileError
        For a file or folder that cannot be read, written or used.

    Examples
    --------
    >>> import cdpr, pathlib, tempfile
    >>> folder = pathlib.Path(tempfile.mkdtemp())
    >>> exported = cdpr.exchange.export(cdpr.Robot.from_file("cogiro"), [0, 0, 2], to="mjcf")
    >>> _ = (folder / "cogiro.xml").write_text(exported.text)
    >>> cdpr.exchange.read(folder / "cogiro.xml", tension_limits=[1, 5000]).robot.n_cables
    8
    """
    given = [files] if isinstance(files, (str, PathLike)) else list(files)
    paths: list[str] = []
    for path in map(Path, given):
        of_folder = sorted(path.glob("*.xml")) if path.is_dir() else [path]
        if not of_folder:
            raise FileError(f"files is {path}: expected a folder with the XML files of CASPR")
        paths += map(fspath, of_folder)
    robot, notes = _core.import_robot(paths, cable, mass, center_of_mass, tension_limits, cable_set)
    return Imported(robot, [Note(*note) for note in notes])


class Exported(NamedTuple):
    """A robot in the files of another program.

    Attributes
    ----------
    files : dict of str
        Texts by the ends of the files' names: {".xml": ...}.
    notes : list of str
        What was assumed, and what the format has no place for.
    """

    files: dict[str, str]
    notes: list[str]

    @property
    def text(self) -> str:
        """The text of the first file."""
        return next(iter(self.files.values()))


def export(robot: Robot, pose: ArrayLike, to: str) -> Exported:
    """Makes the files of a robot that rests at a pose for another program, as `cdpr robot export` does.

    Parameters
    ----------
    robot : Robot
        A robot without what the format has no place for.
    pose : array_like
        (3,) or (7,).
    to : str
        "mjcf" (MuJoCo), "caspr", "moorpy" or "moordyn", or firmware: "klipper", "rrf" (RepRapFirmware) or
        "maslow".

    Returns
    -------
    Exported
        The files, and notes.

    Raises
    ------
    InputError
        For what the format has no place for.
    NoSolutionError
        Where the robot does not hold the pose.

    Examples
    --------
    >>> import mujoco  # doctest: +SKIP
    >>> model = mujoco.MjModel.from_xml_string(exported.text)  # doctest: +SKIP
    """
    files, notes = _core.export_robot(robot, pose, to)
    return Exported(dict(files), notes)
