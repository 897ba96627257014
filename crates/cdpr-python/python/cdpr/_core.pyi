# Types of the native half of the package. `help(cdpr.Robot)` explains each argument and field.

from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from pathlib import Path
from types import GenericAlias
from typing import Any, Generic, TypeAlias, final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import TypeVar

__all__ = [
    "Boundary",
    "Capacity",
    "Certificate",
    "Catenary",
    "Deflection",
    "Derivatives",
    "DirectSolution",
    "Expansion",
    "InverseSolution",
    "LoadEstimates",
    "MasslessModes",
    "Modes",
    "Morris",
    "Motion",
    "MotionState",
    "MotionSummary",
    "Move",
    "MoveSummary",
    "Observations",
    "Observer",
    "PathStates",
    "Response",
    "RestInWeather",
    "Robot",
    "export_robot",
    "import_robot",
    "library",
    "Safety",
    "Saltelli",
    "Sample",
    "Shapley",
    "Stiffness",
    "VERSION",
    "Workspace",
    "allocate",
    "analyse",
    "begin",
    "calibrate",
    "calibrate_pulleys",
    "plan",
    "pose",
    "template",
    "Cable",
    "OtherSolution",
    "PathDeviations",
    "carry_out",
    "check",
    "check_file",
    "design",
    "hysteresis",
    "linear_density",
    "modulus",
    "pulley_friction",
    "robustness",
    "simulate",
    "tolerances",
    "write_report",
    "catenary",
    "effect_intervals",
    "explorer_parts",
    "fit_laws",
    "identify",
    "law_moments",
    "law_values",
    "make_shard",
    "observations",
    "open_results",
    "run_program",
    "status",
    "wasserstein_bures",
]

VERSION: str

_Floats: TypeAlias = NDArray[np.float64]
_Complex: TypeAlias = NDArray[np.complex128]
_Bools: TypeAlias = NDArray[np.bool_]
_Ints: TypeAlias = NDArray[np.int64]
_Words: TypeAlias = list[str | None]
#: One row of numbers; what has more axes, or any number of them, is an ArrayLike.
_Row: TypeAlias = Sequence[float] | np.ndarray[tuple[int], np.dtype[Any]]
#: The types of an answer's numbers, truth values, counts, words, and reasons: those of one case, or of several.
_N = TypeVar("_N", default=Any)
_B = TypeVar("_B", default=Any)
_I = TypeVar("_I", default=Any)
_W = TypeVar("_W", default=Any)
_R = TypeVar("_R", default=Any)
_Path: TypeAlias = str | PathLike[str]
#: A file, or a text with its name.
_Source: TypeAlias = str | tuple[str, str]
_Law: TypeAlias = dict[str, Any]
#: A coordinate [m], or from, to and the number of points.
_Places: TypeAlias = float | tuple[float, float, int] | NDArray[Any]

@final
class Robot:
    """A cable-driven parallel robot with n cables.

    A robot does not change: `with_parameters` makes another one. Units are SI, and z points up in the base
    frame. A pose is x, y, z [m], or x, y, z, qw, qx, qy, qz.

    Parameters
    ----------
    anchor_points : array_like
        (n, 3), points A_i in the platform frame [m].
    exit_points : array_like
        (n, 3), points B_i in the base frame [m].
    mass : float
        Mass of the platform [kg].
    section : array_like
        Section that carries the tension [m²]; one number, or one for each cable, as for the next two.
    linear_density : array_like
        Mass per unstrained length [kg/m].
    youngs_modulus : array_like
        Young's modulus [Pa].
    tension_limits : array_like
        Least and greatest tension of a cable [N], (2,), or one row for each cable, (n, 2).
    center_of_mass : array_like, optional
        Centre of mass in the platform frame [m]; P if left out.
    gravity : array_like, optional
        Acceleration due to gravity [m/s²], a number along -z of the base frame or a vector in it, (3,);
        9.81 if left out.
    name : str, optional
        Name of the robot; "robot" if left out.
    max_at : str, default 'anchor'
        The end at which the greatest tension is limited, "anchor", on the platform, or "exit", where
        the limit is the winch's.
    tension_reference : array_like or str, optional
        Tensions that those of the inverse model come as near to as they can: a number for all cables
        [N], one for each, or "mid", the middle of the limits; the least norm if left out.
    distribution : str, default 'nearest'
        Which tensions the inverse model chooses: "nearest" to tension_reference, or of "least_1_norm",
        "least_2_norm" or "least_infinity_norm". Derivatives, paths and studies refuse the 1-norm and
        the infinity-norm, whose tensions jump from pose to pose.
    point : bool, default False
        Whether the platform is a point mass: its rotation is held.
    plane : str, optional
        "xy", "xz" or "yz" for a planar robot, whose platform moves in this plane of the base frame.
    ground_z : float, optional
        Height of the ground in the base frame [m]: with free coordinates no cable and no anchor point
        is below it.

    Raises
    ------
    InputError
        The message names the field, its value and what would be right.

    Examples
    --------
    >>> import cdpr
    >>> robot = cdpr.Robot(
    ...     [[0, 0, 0], [0, 0, 0], [0, 0, 0]],
    ...     [[0, 0, 3], [4, 0, 3], [2, 3, 3]],
    ...     mass=10.0,
    ...     section=1.26e-5,
    ...     linear_density=0.1,
    ...     youngs_modulus=1e11,
    ...     tension_limits=(1.0, 5000.0),
    ...     point=True,
    ... )
    >>> robot.inverse([2, 1, 1]).tensions.shape  # [N]
    (3,)
    """

    def __new__(
        cls,
        anchor_points: ArrayLike,
        exit_points: ArrayLike,
        *,
        mass: float,
        section: ArrayLike,
        linear_density: ArrayLike,
        youngs_modulus: ArrayLike,
        tension_limits: ArrayLike,
        center_of_mass: ArrayLike | None = None,
        gravity: ArrayLike | None = None,
        name: str = ...,
        max_at: str = "anchor",
        tension_reference: ArrayLike | str | None = None,
        distribution: str = "nearest",
        point: bool = False,
        plane: str | None = None,
        ground_z: float | None = None,
    ) -> Robot: ...
    @staticmethod
    def from_file(path: _Path) -> Robot:
        """Reads a robot file (`cdpr-robot/1`), or a robot of the library by its name, `cogiro`.

        Parameters
        ----------
        path : path
            Path of the file.

        Returns
        -------
        Robot
            The robot.

        Raises
        ------
        FileError
            For a file or folder that cannot be read, written or used.
        InputError
            The message has line, column, field and what would be right.

        Examples
        --------
        >>> cdpr.Robot.from_file("cogiro").n_cables
        8
        """
    @staticmethod
    def from_json(text: str) -> Robot:
        """Makes a robot from the text of a robot file.

        Parameters
        ----------
        text : str
            Text of a robot file.

        Returns
        -------
        Robot
            The robot.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> cdpr.Robot.from_json(robot.to_json()) == robot
        True
        """
    @staticmethod
    def from_dict(content: dict[str, Any]) -> Robot:
        """Makes a robot from the dictionary that `json.loads` makes of a robot file.

        It may hold numbers and arrays of NumPy.

        Parameters
        ----------
        content : dict
            The dictionary.

        Returns
        -------
        Robot
            The robot.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> content = robot.to_dict()
        >>> content["platform"]["mass"] = 100  # [kg]
        >>> cdpr.Robot.from_dict(content).mass
        100.0
        """
    def to_json(self) -> str:
        """The robot file as text.

        Returns
        -------
        str
            The text.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> robot.to_json()[0]
        '{'
        """
    def to_dict(self) -> dict[str, Any]:
        """The robot file as a dictionary.

        Returns
        -------
        dict
            The dictionary.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> robot.to_dict()["format"]
        'cdpr-robot/1'
        """
    @property
    def name(self) -> str:
        """Name of the robot."""
    @property
    def n_cables(self) -> int:
        """Number of cables n."""
    @property
    def cables(self) -> list[Cable]:
        """The cables, n of them."""
    @property
    def anchor_points(self) -> _Floats:
        """Points A_i in the platform frame [m], (n, 3)."""
    @property
    def exit_points(self) -> _Floats:
        """Points B_i in the base frame [m], (n, 3)."""
    @property
    def mass(self) -> float:
        """Mass of the platform [kg]."""
    @property
    def center_of_mass(self) -> _Floats:
        """Centre of mass in the platform frame [m], (3,)."""
    @property
    def section(self) -> _Floats:
        """Section of each cable that carries its tension [m²], (n,)."""
    @property
    def linear_density(self) -> _Floats:
        """Mass of each cable per unstrained length [kg/m], (n,)."""
    @property
    def youngs_modulus(self) -> _Floats:
        """Young's modulus of each cable [Pa], (n,)."""
    @property
    def tension_limits(self) -> tuple[float, float]:
        """Least and greatest tension of a cable that has no limits of its own [N]."""
    @property
    def cable_limits(self) -> _Floats:
        """Least and greatest tension of each cable [N], (n, 2)."""
    @property
    def max_at(self) -> list[str]:
        """The end at which the greatest tension of each cable is limited: "anchor" or "exit"."""
    @property
    def ground_z(self) -> float | None:
        """Height of the ground in the base frame [m]; None where it is not known."""
    @property
    def tension_reference(self) -> _Floats:
        """Tension of each cable that the inverse model comes as near to as it can [N], (n,); zeros for the least
        norm.
        """
    def with_tension_reference(self, reference: ArrayLike | str | None) -> Robot:
        """Makes a robot whose inverse model prefers other tensions.

        Parameters
        ----------
        reference : array_like or str, optional
            A number for all cables [N], one for each, "mid" for the middle of the limits, or None for the
            least norm.

        Returns
        -------
        Robot
            The robot.

        Raises
        ------
        InputError
            For a negative tension or another number of them than of cables.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> robot.with_tension_reference(500).tension_reference[0]  # [N]
        np.float64(500.0)
        """
    @property
    def distribution(self) -> str:
        """Which tensions the inverse model chooses: "nearest", "least_1_norm", "least_2_norm" or
        "least_infinity_norm".
        """
    def with_distribution(self, distribution: str) -> Robot:
        """Makes a robot whose inverse model chooses tensions in another way. A norm drops the tension reference.

        Parameters
        ----------
        distribution : str
            "nearest", "least_1_norm", "least_2_norm" or "least_infinity_norm".

        Returns
        -------
        Robot
            The robot.

        Raises
        ------
        InputError
            For another name.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> robot.with_distribution("least_2_norm").distribution
        'least_2_norm'
        """
    @property
    def gravity(self) -> Any:
        """Acceleration due to gravity [m/s²] as it was given: a number along -z of the base frame, or a vector
        in it, (3,).
        """
    @property
    def parameters(self) -> dict[str, float]:
        """All parameters that studies know, by name, with their values in SI units.

        They are mass, linear_density, youngs_modulus, a1.x ..., b1.x ..., cog.x ..., dt1 ... (offsets of
        tension set-points, zero), and where the robot has them r1 ... (radii of pulleys), lead1 ..., tilt1.u,
        tilt1.v ... (tilts of swivel axes, zero) and gravity.x ... of a vector. All cables share one linear
        density and one modulus here: the value is the first cable's.
        """
    def with_parameters(self, values: Mapping[str, float]) -> Robot:
        """Makes a robot with other values of some parameters [SI units]: `{"mass": 185.0, "a1.x": 0.25}`.

        Names are those in `parameters`. `linear_density` and `youngs_modulus` are those of the first cable,
        as there; the other cables change by as much. Offsets dt belong to a set-point and not to a robot:
        they can only be zero here; `deflection` takes them as `tension_offsets`.

        Parameters
        ----------
        values : dict of float
            New values by name [SI units].

        Returns
        -------
        Robot
            The robot.

        Raises
        ------
        InputError
            For a name or value that no such robot has.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> robot.with_parameters({"mass": 100, "a1.x": 0.5}).mass  # [kg], [m]
        100.0
        """
    def __eq__(self, value: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def explore(self, *, state: dict[str, Any] | None = None) -> Any:
        """Shows the robot in a notebook, where it computes as it is moved: a widget of the package anywidget.

        Parameters
        ----------
        state : dict, optional
            What is shown first, as `Explorer.state` has it.

        Returns
        -------
        Any
            The widget.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> widget = robot.explore()  # doctest: +SKIP
        """
    def write_explorer(self, path: _Path, *, overwrite: bool = False) -> None:
        """Writes the page of `cdpr explore`: one HTML file on which the robot computes in any browser.

        Parameters
        ----------
        path : path
            The file. overwrite: whether a file that exists is replaced.
        overwrite : bool, default False
            Whether what is there is replaced.

        Raises
        ------
        FileError
            For a file or folder that cannot be read, written or used.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> robot.write_explorer("cogiro.html")  # doctest: +SKIP
        """
    @overload
    def inverse(  # type: ignore[overload-overlap]
        self,
        pose: _Row,
        *,
        force: _Row | None = None,
        moment: _Row | None = None,
        payload: float | None = None,
        reference: _Row | None = None,
        path: bool = False,
        tension_change: float | None = None,
        free: Sequence[str] | None = None,
    ) -> InverseSolution[bool, int, None]:
        """Computes the unstrained lengths that hold the platform at a pose under its weight and a load.

        The tensions are those within their limits that come nearest to a reference. Arguments are of one
        case, or have a first axis of m cases.

        Parameters
        ----------
        pose : array_like
            x, y, z [m], or x, y, z, qw, qx, qy, qz, (3,) or (7,).
        force, moment : array_like, optional
            On the platform in the base frame, about P [N, N m], (3,).
        payload : array_like, optional
            Mass added at the platform's centre of mass [kg].
        reference : array_like, optional
            Tensions that the tensions are nearest to [N], (n,), instead of the robot's own
            `tension_reference`; zeros for the least norm.
        path : bool, default False
            Whether the cases are a path, so that each keeps to the branch of tensions of the one before as
            long as it exists on the straight way between them.
        tension_change : float, optional
            Greatest change of a tension from one pose of a path to the next [N].
        free : sequence of str, optional
            Names of the coordinates of the pose that are found, for a robot with fewer cables than free
            motions: as many of x, y, z, roll, pitch, yaw as cables are missing, with R = Rz(yaw) Ry(pitch)
            Rx(roll). They start from the pose and end where the platform rests, within the limits, with no
            cable longer than three chords or below `ground_z`; a reference does not matter.

        Returns
        -------
        InverseSolution
            Lengths and tensions.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right.
        NoSolutionError
            For one case without an answer; of several, its row has NaN and a reason.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> robot.inverse([0, 0, 2]).lengths.shape  # [m]
        (8,)
        >>> robot.inverse([[0, 0, 2], [1, 0, 2]], payload=50).lengths.shape
        (2, 8)
        """
    @overload
    def inverse(
        self,
        pose: ArrayLike,
        *,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
        payload: ArrayLike | None = None,
        reference: ArrayLike | None = None,
        path: bool = False,
        tension_change: float | None = None,
        free: Sequence[str] | None = None,
    ) -> InverseSolution[_Bools, _Ints, _Words]: ...
    @overload
    def direct(  # type: ignore[overload-overlap]
        self,
        lengths: _Row,
        *,
        force: _Row | None = None,
        moment: _Row | None = None,
        payload: float | None = None,
        start: _Row | None = None,
    ) -> DirectSolution[float, bool, int, str, None]:
        """Finds where the platform stands for given unstrained lengths: a stable equilibrium.

        Arguments are of one case, or have a first axis of m cases.

        Parameters
        ----------
        lengths : array_like
            Unstrained lengths of the cables [m], (n,).
        force, moment : array_like, optional
            On the platform in the base frame, about P [N, N m], (3,).
        payload : array_like, optional
            Mass added at the platform's centre of mass [kg].
        start : array_like, optional
            Start of the search, (3,) or (7,); if left out, where straight cables would hold a point.

        Returns
        -------
        DirectSolution
            The equilibria.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right.
        NoSolutionError
            For one case without an answer; of several, its row has NaN and a reason.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> found = robot.direct(robot.inverse([0, 0, 2]).lengths)
        >>> (found.position.round(6) + 0).tolist()  # [m]
        [0.0, 0.0, 2.0]
        """
    @overload
    def direct(
        self,
        lengths: ArrayLike,
        *,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
        payload: ArrayLike | None = None,
        start: ArrayLike | None = None,
    ) -> DirectSolution[_Floats, _Bools, _Ints, _Words, _Words]: ...
    @overload
    def deflection(  # type: ignore[overload-overlap]
        self,
        pose: _Row,
        *,
        payload: float | None = None,
        force: _Row | None = None,
        moment: _Row | None = None,
        tension_offsets: _Row | None = None,
        free: Sequence[str] | None = None,
    ) -> Deflection[float, bool, int, str, None]:
        """Computes how far a load displaces and rotates the platform.

        The lengths are set so that the platform rests at the pose under its own weight; then the load is
        added. Arguments are of one case, or have a first axis of m cases.

        Parameters
        ----------
        pose : array_like
            Wanted pose under the platform's own weight, (3,) or (7,).
        payload : array_like, optional
            Mass added at the platform's centre of mass [kg].
        force, moment : array_like, optional
            On the platform in the base frame, about P [N, N m], (3,).
        tension_offsets : array_like, optional
            Offsets added to the tension set-points [N], (n,).
        free : sequence of str, optional
            Names of the coordinates of the pose that are found, for a robot with fewer cables than free
            motions, as `Robot.inverse` takes them.

        Returns
        -------
        Deflection
            Displacements and rotations, and the equilibria without and with the load.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right.
        NoSolutionError
            For one case without an answer; of several, its row has NaN and a reason.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> given = robot.deflection([0, 0, 2], payload=50)
        >>> print(f"{1e3 * given.magnitude:.1f} mm")
        7.7 mm
        """
    @overload
    def deflection(
        self,
        pose: ArrayLike,
        *,
        payload: ArrayLike | None = None,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
        tension_offsets: ArrayLike | None = None,
        free: Sequence[str] | None = None,
    ) -> Deflection[_Floats, _Bools, _Ints, _Words, _Words]: ...
    @overload
    def stiffness(  # type: ignore[overload-overlap]
        self,
        pose: _Row,
        *,
        payload: float | None = None,
        force: _Row | None = None,
        moment: _Row | None = None,
        free: Sequence[str] | None = None,
    ) -> Stiffness[float, bool, None]:
        """Computes the Cartesian stiffness at a pose with a load, including the sag and weight of the cables.

        Arguments are of one case, or have a first axis of m cases.

        Parameters
        ----------
        pose : array_like
            x, y, z [m], or x, y, z, qw, qx, qy, qz, (3,) or (7,).
        payload : array_like, optional
            Mass that the platform carries there, at its centre of mass [kg].
        force, moment : array_like, optional
            On the platform in the base frame, about P [N, N m], (3,).
        free : sequence of str, optional
            Names of the coordinates of the pose that are found, for a robot with fewer cables than free
            motions, as `Robot.inverse` takes them.

        Returns
        -------
        Stiffness
            Stiffness matrices and their eigenvalues.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right.
        NoSolutionError
            For one case without an answer; of several, its row has NaN and a reason.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> robot.stiffness([0, 0, 2]).matrix.shape
        (6, 6)
        """
    @overload
    def stiffness(
        self,
        pose: ArrayLike,
        *,
        payload: ArrayLike | None = None,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
        free: Sequence[str] | None = None,
    ) -> Stiffness[_Floats, _Bools, _Words]: ...
    @overload
    def modes(  # type: ignore[overload-overlap]
        self,
        pose: _Row,
        *,
        number: int = 12,
        below: float | None = None,
        servo: float | None = None,
        winch: float = 0.0,
        payload: float | None = None,
        force: _Row | None = None,
        moment: _Row | None = None,
        free: Sequence[str] | None = None,
    ) -> Modes[float, None]:
        """Computes the natural motions of platform and cables, the lengths held.

        Cables have mass: where they vibrate about as fast as the platform, they move together with it. None
        of the motions is missing, which a count proves. Arguments are of one case, or have a first axis of m
        cases.

        Parameters
        ----------
        pose : array_like
            x, y, z [m], or x, y, z, qw, qx, qy, qz, (3,) or (7,).
        number : int, optional
            This many motions, the slowest.
        below : float, optional
            All motions up to this frequency [Hz], instead of a number.
        servo : float, optional
            Stiffness with which each winch holds its cable at the drum [N/m]; without it winches hold.
        winch : float, default 0
            Inertia of the rotor of each winch by the square of the drum's radius [kg], with `servo`. The
            share of a cable contains that of its rotor.
        payload : array_like, optional
            Mass that the platform carries there, at its centre of mass [kg].
        force, moment : array_like, optional
            On the platform in the base frame, about P [N, N m], (3,).
        free : sequence of str, optional
            Names of the coordinates of the pose that are found, for a robot with fewer cables than free
            motions, as `Robot.inverse` takes them.

        Returns
        -------
        Modes
            Frequencies, shares and motions.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right; also where the robot has no
            inertia.
        NoSolutionError
            For one case without an answer; of several, its row has NaN and a reason.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> robot.modes([0, 0, 2], below=6).frequencies_hz.shape  # [Hz]
        (18,)
        """
    @overload
    def modes(
        self,
        pose: ArrayLike,
        *,
        number: int = 12,
        below: float | None = None,
        servo: float | None = None,
        winch: float = 0.0,
        payload: ArrayLike | None = None,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
        free: Sequence[str] | None = None,
    ) -> Modes[_Floats, _Words]: ...
    @overload
    def massless_modes(  # type: ignore[overload-overlap]
        self,
        pose: _Row,
        *,
        payload: float | None = None,
        force: _Row | None = None,
        moment: _Row | None = None,
        free: Sequence[str] | None = None,
    ) -> MasslessModes[None]:
        """Computes the natural motions of the platform on cables without mass, the lengths held.

        Arguments are of one case, or have a first axis of m cases.

        Parameters
        ----------
        pose : array_like
            x, y, z [m], or x, y, z, qw, qx, qy, qz, (3,) or (7,).
        payload : array_like, optional
            Mass that the platform carries there, at its centre of mass [kg].
        force, moment : array_like, optional
            On the platform in the base frame, about P [N, N m], (3,).
        free : sequence of str, optional
            Names of the coordinates of the pose that are found, for a robot with fewer cables than free
            motions, as `Robot.inverse` takes them.

        Returns
        -------
        MasslessModes
            Frequencies and motions.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right; also where the robot has no
            inertia.
        NoSolutionError
            For one case without an answer; of several, its row has NaN and a reason.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> robot.massless_modes([0, 0, 2]).frequencies_hz.shape  # [Hz]
        (6,)
        """
    @overload
    def massless_modes(
        self,
        pose: ArrayLike,
        *,
        payload: ArrayLike | None = None,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
        free: Sequence[str] | None = None,
    ) -> MasslessModes[_Words]: ...
    @overload
    def response(  # type: ignore[overload-overlap]
        self,
        pose: _Row,
        frequencies: _Row,
        *,
        damping: float = 2e-4,
        drag: float = 0.0,
        marker: _Row | None = None,
        payload: float | None = None,
        force: _Row | None = None,
        moment: _Row | None = None,
        free: Sequence[str] | None = None,
    ) -> Response[None]:
        """Computes how the platform moves when a force or a winch shakes it.

        Cables have mass. The winches hold their lengths but for what shakes. Arguments are of one case, or
        have a first axis of m cases; frequencies, damping and marker are those of all cases.

        Parameters
        ----------
        pose : array_like
            x, y, z [m], or x, y, z, qw, qx, qy, qz, (3,) or (7,).
        frequencies : array_like
            Frequencies [Hz], (k,). Peaks are at the natural ones, `Robot.modes(...).frequencies_hz`.
        damping : float, default 2e-4
            Ratio of the viscous to the elastic modulus of the cables [s].
        drag : float, default 0
            Force of the air on a metre of cable over its mass, for each m/s [1/s]. Nothing else damps cables
            across their stretch.
        marker : array_like, optional
            Point of the platform that is shaken and that moves, in its frame [m]; P if left out.
        payload : array_like, optional
            Mass that the platform carries there, at its centre of mass [kg].
        force, moment : array_like, optional
            On the platform in the base frame, about P [N, N m], (3,).
        free : sequence of str, optional
            Names of the coordinates of the pose that are found, for a robot with fewer cables than free
            motions, as `Robot.inverse` takes them.

        Returns
        -------
        Response
            Amplitudes.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right; also where the robot has no
            inertia, and at a natural frequency that nothing damps.
        NoSolutionError
            For one case without an answer; of several, its row has NaN and a reason.

        Examples
        --------
        >>> import cdpr
        >>> import numpy
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> natural = robot.modes([0, 0, 2], below=6).frequencies_hz
        >>> frequencies = numpy.union1d(numpy.linspace(0, 6, 100), natural)
        >>> found = robot.response([0, 0, 2], frequencies, drag=0.5)
        >>> bool(found.amplitudes.max() > found.amplitudes[0])  # more than at rest
        True
        """
    @overload
    def response(
        self,
        pose: ArrayLike,
        frequencies: _Row,
        *,
        damping: float = 2e-4,
        drag: float = 0.0,
        marker: _Row | None = None,
        payload: ArrayLike | None = None,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
        free: Sequence[str] | None = None,
    ) -> Response[_Words]: ...
    def move(
        self,
        poses: ArrayLike,
        seconds: float,
        *,
        profile: str | None = None,
        shaper: str | None = None,
        modes: int = 2,
        feed_forward: str | None = None,
        rate: float = 200.0,
        damping: float = 0.0,
        residual: float | None = None,
        payload: float | None = None,
        force: _Row | None = None,
        moment: _Row | None = None,
    ) -> Move:
        """Plans a move along poses from rest to rest, as `cdpr path --with seconds=S` does.

        The way is one smooth curve through all poses, a straight one between two. The platform does not swing
        where the motion is split by an input shaper, or the lengths account for the inertia.

        Parameters
        ----------
        poses : array_like
            x, y, z [m], or x, y, z, qw, qx, qy, qz, (m, 3) or (m, 7).
        seconds : float
            Duration, that of the shaper included [s].
        profile : {"trapezoid", "cosine", "polynomial"}, optional
            How the share of the way changes over time; "polynomial" with feed-forward, otherwise "cosine".
        shaper : {"zv", "zvd", "ei"}, optional
            Input shaper, from the shortest to the least sensitive one.
        modes : int, default 2
            For how many natural motions at most, those that swing most.
        feed_forward : {"platform", "cables"}, optional
            Which inertia the lengths account for; "cables" is that of platform and cables.
        rate : float, default 200
            Set points for each second [Hz].
        damping : float, default 0
            Ratio of the viscous to the elastic modulus of the cables [s].
        residual : float, optional
            Simulates the move and this long after it [s].
        payload : float, optional
            Mass that the platform carries, at its centre of mass [kg].
        force, moment : array_like, optional
            On the platform in the base frame, about P, all the time [N, N m], (3,).

        Returns
        -------
        Move
            Set points over time; `lengths` and `times` are an event of `Robot.simulate`.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right; also where the robot has no
            inertia.
        NoSolutionError
            Where a pose is not held, the lengths jump, or the move is too fast.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> move = robot.move([[-0.5, 0, 2], [0.5, 0, 2]], 1.0, shaper="zvd", rate=100)
        >>> move.lengths.shape, len(move.summary.frequencies_hz)  # [m]
        ((101, 8), 2)
        """
    def simulate(
        self,
        pose: _Row | None = None,
        *,
        until: float,
        events: Sequence[Mapping[str, Any]] | None = None,
        control: Callable[[float, MotionState], ArrayLike | None] | None = None,
        rate: float = 100.0,
        lengths: _Row | None = None,
        payload: float | None = None,
        force: _Row | None = None,
        moment: _Row | None = None,
        free: Sequence[str] | None = None,
        damping: float = 0.0,
        elements: int | None = None,
        degree: int | None = None,
        tolerance: float = 5e-9,
    ) -> Motion:
        """Follows the motion of the robot from rest after events, with the mass and the sag of its cables.

        It is computed twice, and the differences are in `summary`.

        Parameters
        ----------
        pose : array_like, optional
            Where the platform rests, (3,) or (7,); with `lengths`, where the search for the rest starts.
        until : float
            End [s].
        events : sequence of dict, optional
            What happens, in the words of the event files of `cdpr simulate`, each at a time `t` [s]:
            {"t": 0, "payload": -50} [kg]; {"t": 0, "cut": 1, "at": "anchor"} or "exit"; {"t": 0, "force":
            [100, 0, 0], "moment": [0, 0, 0]} [N, N m]; {"t": 0, "displace": [dx, dy, dz, rx, ry, rz]}
            [m, rad]; {"t": 0, "shorten": {"cable": 1, "by": 0.003, "over": 0.2, "profile": "cosine"}} [m, s];
            {"t": 0, "lengths": {"times": times, "lengths": lengths}} with arrays (k,) and (k, n) [s, m],
            which winches follow.
        control : callable, optional
            Called at each sample with the time [s] and a `MotionState`. It returns what acts until the next
            sample besides the load and the events: a force at P in the base frame [N], (3,), a force and a
            moment [N, N m], (6,), or None; `raise StopIteration` ends the motion. It must depend on its
            arguments alone: each of the computations calls it, from the beginning, with its own states, and
            they run at the same time.
        rate : float, default 100
            Samples for each second [Hz].
        lengths : array_like, optional
            Unstrained lengths of the cables [m], (n,), instead of those that hold `pose`.
        payload : float, optional
            Mass that the platform carries at rest, at its centre of mass [kg].
        force, moment : array_like, optional
            On the platform in the base frame, about P, at rest and all the time [N, N m], (3,).
        free : sequence of str, optional
            Names of the coordinates of the pose that are found, for a robot with fewer cables than free
            motions, as `Robot.inverse` takes them.
        damping : float, default 0
            Ratio of the viscous to the elastic modulus of the cables [s].
        elements, degree : int, optional
            Elements of each cable, and the degree of the polynomial on each; if left out, few elements of a
            high degree, and many straight ones of a cable from when it goes slack.
        tolerance : float, default 5e-9
            Error of a step that is accepted [m].

        Returns
        -------
        Motion
            Poses, velocities and tensions over time.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right; also where the robot has no
            inertia.
        NoSolutionError
            Where the robot has no rest, or its motion cannot be followed.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> motion = robot.simulate([0, 0, 2], until=0.1, events=[{"t": 0, "payload": 50}])
        >>> motion.poses.shape, motion.tensions.shape  # [m], [N]
        ((11, 7), (11, 8))
        >>> brake = lambda t, state: -200 * state.velocity  # [N]
        >>> slower = robot.simulate([0, 0, 2], until=0.1, events=[{"t": 0, "payload": 50}], control=brake)
        >>> bool(slower.poses[-1, 2] > motion.poses[-1, 2])
        True
        """
    @overload
    def derivatives(  # type: ignore[overload-overlap]
        self,
        pose: _Row,
        *,
        payload: float | None = None,
        force: _Row | None = None,
        moment: _Row | None = None,
        free: Sequence[str] | None = None,
        shaken: float | None = None,
        damping: float = 2e-4,
        drag: float = 0.0,
        marker: ArrayLike | None = None,
    ) -> Derivatives[float, bool, int, str, None]:
        """Computes the exact derivatives of lengths, tensions and deflection under a load.

        Arguments are of one case, or have a first axis of m cases.

        Parameters
        ----------
        pose : array_like
            Wanted pose under the platform's own weight, (3,) or (7,).
        payload : array_like, optional
            Mass added at the platform's centre of mass [kg].
        force, moment : array_like, optional
            On the platform in the base frame, about P [N, N m], (3,). Without a load there are no derivatives
            of |dp|.
        free : sequence of str, optional
            Names of the coordinates of the pose that are found, for a robot with fewer cables than free
            motions, as `Robot.inverse` takes them.
        shaken : float, optional
            Frequency of a force that shakes the platform [Hz], for the derivatives of its amplitude.
        damping, drag : float
            What damps the cables, as in `Robot.response` [s, 1/s].
        marker : array_like, optional
            Point of the platform that is shaken and that moves, in its frame [m]; P if left out.

        Returns
        -------
        Derivatives
            Derivatives by each input.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right.
        NoSolutionError
            For one case without an answer; of several, its row has NaN and a reason; also where a
            derivative does not exist.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> slopes = robot.derivatives([0, 0, 2], payload=50)
        >>> slopes.inputs[0], len(slopes.magnitude) == len(slopes.inputs)
        ('mass', True)
        >>> shaken = robot.derivatives([0, 0, 2], payload=50, shaken=3, drag=0.5).amplitude  # [m/N per unit]
        >>> shaken.shape == slopes.magnitude.shape
        True
        """
    @overload
    def derivatives(
        self,
        pose: ArrayLike,
        *,
        payload: ArrayLike | None = None,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
        free: Sequence[str] | None = None,
        shaken: float | None = None,
        damping: float = 2e-4,
        drag: float = 0.0,
        marker: ArrayLike | None = None,
    ) -> Derivatives[_Floats, _Bools, _Ints, _Words, _Words]: ...
    @overload
    def observe(  # type: ignore[overload-overlap]
        self,
        pose: _Row,
        deviations: _Row,
        *,
        payload: float | None = None,
        force: _Row | None = None,
        moment: _Row | None = None,
        free: Sequence[str] | None = None,
    ) -> Observations[float, None]:
        """Computes the deflections under a load of robots whose k parameters deviate from those of this robot.

        This is what a study observes; each robot has lengths set for the pose. Several robots go through
        the vector unit at once: the answers agree with `deflection` to rounding, and each depends on its own
        row alone.

        Parameters
        ----------
        pose : array_like
            Wanted pose under the platform's own weight, (3,) or (7,).
        deviations : array_like
            Deviations of the parameters, in the order of `parameters` [SI units], (k,) or (m, k).
        payload, force, moment : array_like, optional
            One load for all, as in `deflection`.
        free : sequence of str, optional
            Names of the coordinates of the pose that this robot finds, as `Robot.inverse` takes them, for
            one with fewer cables than free motions; deviating robots have lengths for the pose that it finds.

        Returns
        -------
        Observations
            Displacements, a row for each robot.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right.
        NoSolutionError
            For one robot without an answer; of several, its row has NaN and a reason.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> deviations = [[0.0] * len(robot.parameters)] * 3
        >>> robot.observe([0, 0, 2], deviations, payload=50).displacement.shape  # [m]
        (3, 3)
        """
    @overload
    def observe(
        self,
        pose: ArrayLike,
        deviations: ArrayLike,
        *,
        payload: ArrayLike | None = None,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
        free: Sequence[str] | None = None,
    ) -> Observations[_Floats, _Words]: ...
    def boundary(
        self,
        *,
        x: _Places | None = None,
        y: _Places | None = None,
        z: _Places | None = None,
        plane: tuple[str, float] | None = None,
        grid: tuple[int, int] | None = None,
        payload: float,
        way: str = "recomputed",
        free: Sequence[str] | None = None,
    ) -> Boundary:
        """Finds the boundary of the region that the cables hold under a payload, with the platform level.

        Bisection moves it between the positions of a grid to where it is, so that a coarse grid does; a hole
        or an island that lies between the positions is not seen.

        Parameters
        ----------
        x : float or (float, float, int), optional
            as `Robot.workspace` takes them: a plane or a box.
        y : float or (float, float, int), optional
            as `Robot.workspace` takes them: a plane or a box.
        z : float or (float, float, int), optional
            as `Robot.workspace` takes them: a plane or a box.
        plane : (str, float), optional
            as `Robot.workspace` takes them: a plane or a box.
        grid : (int, int), optional
            as `Robot.workspace` takes them: a plane or a box.
        payload : float
            Mass added at the platform's centre of mass [kg].
        way : str, default 'recomputed'
            How the load is borne: with the tensions "recomputed" by the winches, or the lengths "kept".
        free : sequence of str, optional
            Names of the coordinates of the pose that are found, for a robot with fewer cables than free
            motions.

        Returns
        -------
        Boundary
            Polygons or triangles, and their area or volume.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> region = robot.boundary(plane=("z", 2), grid=(4, 4), payload=50)
        >>> region.polygons[0].shape[1], region.measure > 0  # [m], [m²]
        (3, True)
        """
    @overload
    def capacity(  # type: ignore[overload-overlap]
        self,
        pose: _Row,
        *,
        payload: float | None = None,
        force: _Row | None = None,
        moment: _Row | None = None,
        wrenches: ArrayLike | None = None,
        tilt: int = 0,
        free: Sequence[str] | None = None,
    ) -> Capacity[float, None]:
        """Finds what the cables can carry at a pose besides the platform, and how far the limits are.

        Arguments are of one case, or have a first axis of m cases.

        Parameters
        ----------
        pose : array_like
            x, y, z [m], or x, y, z, qw, qx, qy, qz, (3,) or (7,).
        payload : array_like, optional
            Mass that the platform carries there, at its centre of mass [kg].
        force, moment : array_like, optional
            On the platform in the base frame, about P [N, N m], (3,).
        wrenches : array_like, optional
            Wrenches that may act with the load, fx to mz about P [N, N m], (k, 6); all poses have the
            same.
        tilt : int, default 0
            Number of azimuths, from x to y, towards which the platform is tilted as far as tensions within
            the limits hold it; 0 leaves it out.
        free : sequence of str, optional
            Names of the coordinates of the pose that are found, for a robot with fewer cables than free
            motions, as `Robot.inverse` takes them.

        Returns
        -------
        Capacity
            Payloads, margins and distances.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right.
        NoSolutionError
            For one case without an answer; of several, its row has NaN and a reason.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> robot.capacity([[0, 0, 2], [1, 0, 2]]).payload_recomputed.shape  # [kg]
        (2,)
        """
    @overload
    def capacity(
        self,
        pose: ArrayLike,
        *,
        payload: ArrayLike | None = None,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
        wrenches: ArrayLike | None = None,
        tilt: int = 0,
        free: Sequence[str] | None = None,
    ) -> Capacity[_Floats, _Words]: ...
    @overload
    def safety(  # type: ignore[overload-overlap]
        self,
        pose: _Row,
        *,
        payload: float | None = None,
        force: _Row | None = None,
        moment: _Row | None = None,
        pairs: bool = False,
        swing: float | None = None,
        factors: Mapping[str, float | tuple[float, float]] | None = None,
        free: Sequence[str] | None = None,
    ) -> Safety[None]:
        """Finds where the platform comes to rest when a cable breaks, and whether the others bear that.

        The winches keep the lengths that hold the pose. The rest is the equilibrium downhill of the pose; on
        the way there the platform swings and tensions are greater; with `swing` that motion is followed,
        without damping. Arguments are of one case, or have a first axis of m cases.

        Parameters
        ----------
        pose : array_like
            x, y, z [m], or x, y, z, qw, qx, qy, qz, (3,) or (7,).
        payload : array_like, optional
            Mass that the platform carries there, at its centre of mass [kg].
        force, moment : array_like, optional
            On the platform in the base frame, about P [N, N m], (3,).
        pairs : bool, default False
            Whether every pair of cables breaks, too.
        swing : float, optional
            For how long the motion after each break is followed [s].
        factors : dict, optional
            Partial factors of a norm, all four: `permanent` multiplies the weight of platform and cables,
            `variable` payload, force and moment, `resistance` divides the breaking forces (a pair: the second
            one for broken cables), `accidental` multiplies the loads where a cable is broken (a pair:
            weights, other loads).
        free : sequence of str, optional
            Names of the coordinates of the pose that are found, for a robot with fewer cables than free
            motions, as `Robot.inverse` takes them.

        Returns
        -------
        Safety
            The end of each break.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right.
        NoSolutionError
            For one case without an answer; of several, its row has NaN and a reason.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> robot.safety([0, 0, 2]).moved.shape  # [m]
        (8,)
        >>> factors = {"permanent": 1.35, "variable": 1.5, "resistance": 1.5, "accidental": 1.0}
        >>> cdpr.Robot.from_file("caroca").safety([0, 0, 1.75], factors=factors).utilization.shape
        (9,)
        """
    @overload
    def safety(
        self,
        pose: ArrayLike,
        *,
        payload: ArrayLike | None = None,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
        pairs: bool = False,
        swing: float | None = None,
        factors: Mapping[str, float | tuple[float, float]] | None = None,
        free: Sequence[str] | None = None,
    ) -> Safety[_Words]: ...
    @overload
    def in_weather(  # type: ignore[overload-overlap]
        self,
        pose: _Row,
        wind: _Row | None = None,
        *,
        warmer: float = 0.0,
        cable_expansion: float = 0.0,
        frame_expansion: float = 0.0,
        ice: float = 0.0,
        creep: float = 0.0,
        wind_profile: tuple[float, float] | None = None,
        payload: float | None = None,
        force: _Row | None = None,
        moment: _Row | None = None,
        free: Sequence[str] | None = None,
        slopes: bool = False,
    ) -> RestInWeather[float, None]:
        """Finds where the platform rests in wind, at another temperature, with ice or creep; the winches hold.

        The lengths are those with which it rests at the pose under its own weight, without weather. The drag
        is that of round ropes with a coefficient of 1.2 in air of 1.225 kg/m³; with others, take the wind
        that is sqrt(density coefficient/1.47) times as fast. Wind on the platform itself is a `force`.
        `pose`, `wind` and the load are of one case, or have a first axis of m cases: wind from all directions
        is a `wind` with a row for each.

        Parameters
        ----------
        pose : array_like
            Wanted pose under the platform's own weight, (3,) or (7,).
        wind : array_like, optional
            Velocity of the wind in the base frame [m/s], (3,).
        warmer : float
            How much warmer it is [K].
        cable_expansion, frame_expansion : float
            Thermal expansion of the cables, and of the frame from the origin of the base frame [1/K].
        ice : float
            Thickness of the ice around each cable [m], of 900 kg/m³.
        creep : float
            Strain by which each cable has crept.
        wind_profile : tuple of float, optional
            Roughness length of the ground and height above it at which the wind has its velocity [m],
            such as (0.3, 10), of a wind that grows with height from nothing at the ground,
            `ground_z` or z = 0.
        payload : array_like, optional
            Mass added at the platform's centre of mass [kg].
        force, moment : array_like, optional
            On the platform in the base frame, about P [N, N m], (3,).
        free : sequence of str, optional
            Names of the coordinates of the pose that are found, for a robot with fewer cables than free
            motions, as `Robot.inverse` takes them.
        slopes : bool, default False
            Whether the exact derivatives of the displacement are computed, too, also by the numbers of the
            weather. A robot with pulleys has none in wind.

        Returns
        -------
        RestInWeather
            Displacements, tensions and the force of the wind on each cable.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right.
        NoSolutionError
            For one case without an answer; of several, its row has NaN and a reason.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> robot.in_weather([0, 0, 2], [15, 0, 0]).drags.shape  # [N]
        (8, 3)
        >>> bool(robot.in_weather([0, 0, 2], ice=0.005).displacement[2] > 0)  # sag shortens the chords
        True
        >>> robot.in_weather([0, 0, 2], [15, 0, 0], slopes=True).inputs[-2:]
        ['wind', 'wind_direction']
        """
    @overload
    def in_weather(
        self,
        pose: ArrayLike,
        wind: ArrayLike | None = None,
        *,
        warmer: float = 0.0,
        cable_expansion: float = 0.0,
        frame_expansion: float = 0.0,
        ice: float = 0.0,
        creep: float = 0.0,
        wind_profile: tuple[float, float] | None = None,
        payload: ArrayLike | None = None,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
        free: Sequence[str] | None = None,
        slopes: bool = False,
    ) -> RestInWeather[_Floats, _Words]: ...
    @overload
    def certify(  # type: ignore[overload-overlap]
        self,
        lengths: _Row,
        *,
        force: _Row | None = None,
        moment: _Row | None = None,
        payload: float | None = None,
        start: _Row | None = None,
    ) -> Certificate[float, bool, None]:
        """Proves how close the exact equilibrium is to that of `Robot.direct`, and that it is stable.

        It is for six free motions, plain cables and a level base. Arguments are those of `Robot.direct`.

        Parameters
        ----------
        lengths : array_like
            Unstrained lengths of the cables [m], (n,).
        force : array_like, optional
            Force on the platform in the base frame [N], (3,).
        moment : array_like, optional
            Moment on the platform in the base frame, about P [N m], (3,).
        payload : array_like, optional
            Mass added at the platform's centre of mass [kg].
        start : array_like, optional
            Start of the search, (3,) or (7,).

        Returns
        -------
        Certificate
            Bounds.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right.
        NoSolutionError
            For one case without an answer; of several, its row has NaN and a reason, of the kind
            `not_certified` where nothing is proved.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> robot.certify(robot.inverse([0, 0, 2]).lengths).position < 1e-9  # [m]
        True
        """
    @overload
    def certify(
        self,
        lengths: ArrayLike,
        *,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
        payload: ArrayLike | None = None,
        start: ArrayLike | None = None,
    ) -> Certificate[_Floats, _Bools, _Words]: ...
    def path(
        self,
        poses: ArrayLike,
        *,
        payload: ArrayLike | None = None,
        force: ArrayLike | None = None,
        moment: ArrayLike | None = None,
        uncertainty: Mapping[str, float] | None = None,
    ) -> PathStates:
        """Follows a path of poses, as `cdpr path` does.

        Strongly sagging cables may hold a pose with several sets of tensions. Along a path each pose keeps to
        the set of the pose before, as long as it exists. A pose without an answer is left out of the path.

        Parameters
        ----------
        poses : array_like
            x, y, z [m], or x, y, z, qw, qx, qy, qz, (m, 3) or (m, 7).
        payload : array_like, optional
            Mass that the platform carries, at its centre of mass [kg].
        force, moment : array_like, optional
            On the platform in the base frame, about P [N, N m], (3,).
        uncertainty : dict of float, optional
            Standard deviations of parameters or groups [SI units]: {"a": 0.002, "mass": 0.5}.

        Returns
        -------
        PathStates
            States along the path.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> states = robot.path([[x, 0, 2] for x in (0, 0.1, 0.2)], payload=50, uncertainty={"a": 0.002})
        >>> states.tensions.shape, states.std.magnitude.shape  # [N], [m]
        ((3, 8), (3,))
        """
    def workspace(
        self,
        *,
        x: _Places | None = None,
        y: _Places | None = None,
        z: _Places | None = None,
        plane: tuple[str, float] | None = None,
        grid: tuple[int, int] | None = None,
        payload: float,
        uncertainty: Mapping[str, float] | None = None,
        free: Sequence[str] | None = None,
        band: tuple[float, float] | None = None,
        damping: float = 2e-4,
        drag: float = 0.0,
        marker: ArrayLike | None = None,
    ) -> Workspace:
        """Finds where the cables hold the platform under a payload, and how far it gives there.

        Positions are on a grid, with the platform level.

        Parameters
        ----------
        x, y, z : float or (float, float, int), optional
            Coordinates along each axis [m]: a number, or (from, to, points).
        plane : (str, float), optional
            In place of x, y and z, a plane over the frame of the exit points, ("z", 1.75).
        grid : (int, int), optional
            Points of the plane along its two axes; (41, 41) if left out.
        payload : float
            Mass added at the platform's centre of mass [kg]; with 0 there is no deflection.
        uncertainty : dict of float, optional
            Standard deviations of parameters or groups [SI units]: {"a": 0.002, "mass": 0.5}.
        free : sequence of str, optional
            Names of the coordinates of the pose that are found, for a robot with fewer cables than free
            motions, as `Robot.inverse` takes them.
        band : (float, float), optional
            The lowest and the highest frequency of what shakes the platform [Hz], for the largest amplitudes.
            An inertia that the robot lacks is assumed: that of a ball as large as the platform.
        damping, drag : float
            What damps the cables, as in `Robot.response` [s, 1/s].
        marker : array_like, optional
            Point of the platform that is shaken and that moves, in its frame [m]; P if left out.

        Returns
        -------
        Workspace
            Results at each position of the grid.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right. A position that is not held
            is no error.

        Examples
        --------
        >>> import cdpr
        >>> robot = cdpr.Robot.from_file("cogiro")
        >>> found = robot.workspace(plane=("z", 2), grid=(4, 3), payload=50)
        >>> found.shape, found.magnitude.shape  # [m]
        ((4, 3, 1), (12,))
        >>> shaken = robot.workspace(plane=("z", 2), grid=(3, 3), payload=0, band=(0, 4), drag=0.5)
        >>> bool(shaken.amplitude[4] > 0)  # in the middle [m/N]
        True
        """

@final
class Cable:
    """A cable of a robot."""

    def __new__(cls, *fields: Any) -> Cable: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def number(self) -> int:
        """Number of the cable, from 1."""
    @property
    def anchor_point(self) -> _Floats:
        """Point A_i in the platform frame [m], (3,)."""
    @property
    def exit_point(self) -> _Floats:
        """Point B_i in the base frame [m], (3,)."""
    @property
    def section(self) -> float:
        """Section that carries the tension [m²]."""
    @property
    def linear_density(self) -> float:
        """Mass per unstrained length [kg/m]."""
    @property
    def youngs_modulus(self) -> float:
        """Young's modulus [Pa]."""
    @property
    def tension_limits(self) -> _Floats:
        """Least and greatest tension [N], (2,)."""
    @property
    def max_at(self) -> str:
        """The end at which the greatest tension is limited: "anchor" or "exit"."""

@final
class OtherSolution:
    """A further rest of a platform with `free` coordinates."""

    def __new__(cls, *fields: Any) -> OtherSolution: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def pose(self) -> _Floats:
        """Pose at which the platform rests, (7,)."""
    @property
    def lengths(self) -> _Floats:
        """Unstrained length of each cable [m], (n,)."""
    @property
    def tensions(self) -> _Floats:
        """Tension of each cable at the platform [N], (n,)."""
    @property
    def out_of_limits(self) -> NDArray[np.int8]:
        """Whether its tension, at either end, is out of limits, as in `InverseSolution`, (n,)."""
    @property
    def stable(self) -> bool:
        """Whether the platform stays there with these lengths."""

@final
class PathDeviations:
    """Standard deviations at the m poses of a path, NaN where there are no derivatives."""

    def __new__(cls, *fields: Any) -> PathDeviations: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def lengths(self) -> _Floats:
        """Of the unstrained lengths [m], (m, n)."""
    @property
    def tensions(self) -> _Floats:
        """Of the tensions at the platform without the load [N], (m, n)."""
    @property
    def displacement(self) -> _Floats:
        """Of the displacement [m], (m, 3)."""
    @property
    def magnitude(self) -> _Floats:
        """Of its magnitude [m], (m,)."""
    @property
    def least_stiffness(self) -> _Floats:
        """Of the least stiffness [N/m], (m,)."""
    @property
    def platform_frequency(self) -> _Floats:
        """Of the frequency of the platform [Hz], (m,)."""
    @property
    def reasons(self) -> _Words:
        """Why there is no answer, None if there is one, (m,)."""

@final
class Catenary(Generic[_N, _R]):
    """Cables in equilibrium, in their vertical planes.

    The exit point is the origin, the anchor point is at (x, z), and z points up.

    The answer is of one cable, or of m: then every field has a first axis of m, with NaN where there is
    no answer, and `reasons` says why.
    """

    def __new__(cls, *fields: Any) -> Catenary: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def force(self) -> _Floats:
        """Force (fx, fz) on the cable at the anchor point [N], (2,)."""
    @property
    def anchor_tension(self) -> _N:
        """Tension at the anchor point [N]."""
    @property
    def exit_tension(self) -> _N:
        """Tension at the exit point [N]."""
    @property
    def sag(self) -> _N:
        """Greatest height of the chord above the cable [m]."""
    @property
    def energy(self) -> _N:
        """Elastic energy plus potential energy of the weight, zero at the height of the exit point [J]."""
    @property
    def unstrained_length(self) -> _N:
        """Unstrained length [m]."""
    @property
    def end(self) -> _Floats:
        """Position (x, z) of the anchor point [m], (2,)."""
    @property
    def residual(self) -> _N:
        """Closure residual: distance between the given end and that of the catenary [m]."""
    @property
    def shape(self) -> _Floats:
        """Points (x, z) from exit to anchor point, at equal unstrained distances [m], (points, 2)."""
    @property
    def reasons(self) -> _R:
        """Why there is no answer, None if there is one; None for one cable."""
    @property
    def kinds(self) -> _R:
        """The kind of each failure, in the same form: `infeasible_tension`, ..."""

@final
class InverseSolution(Generic[_B, _I, _R]):
    """Unstrained lengths that hold poses.

    The answer is of one pose, or of m: then every field has a first axis of m, with NaN where there is no
    answer, and `reasons` says why.
    """

    def __new__(cls, *fields: Any) -> InverseSolution: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def lengths(self) -> _Floats:
        """Unstrained length of each cable [m], (n,)."""
    @property
    def tensions(self) -> _Floats:
        """Tension of each cable at the platform [N], (n,)."""
    @property
    def exit_tensions(self) -> _Floats:
        """Tension of each cable at its exit point [N], (n,)."""
    @property
    def out_of_limits(self) -> NDArray[np.int8]:
        """Whether its tension, at either end, is out of limits: 2 above the breaking force, 1 above the
        greatest tension, 0 within, (n,).
        """
    @property
    def cable_forces(self) -> _Floats:
        """Force (fx, fz) on each cable at its anchor point, in its vertical plane [N], (n, 2)."""
    @property
    def active(self) -> NDArray[np.int8]:
        """The bound that each tension rests on: -1 the least, 1 the greatest, 0 none, (n,)."""
    @property
    def residual(self) -> _Floats:
        """Residuals of the 6 + 2n equations: closure of the cables [m], force [N], moment [N m], (3,)."""
    @property
    def iterations(self) -> _I:
        """Iterations of distribution and Newton's method; 0 where there is no answer."""
    @property
    def jump(self) -> _B | None:
        """Where the lengths may jump, because the branch of the pose before ends; only along a path, ()."""
    @property
    def pose(self) -> _Floats:
        """Pose at which the platform rests, (7,): the given one but for `free` coordinates."""
    @property
    def stable(self) -> _B | None:
        """Whether the platform stays there with these lengths; only with `free` coordinates."""
    @property
    def others(self) -> list[Any] | None:
        """Further solutions with `free` coordinates, those within the limits first: a list of
        `OtherSolution`, or for m poses a list of m such lists.
        """
    @property
    def reasons(self) -> _R:
        """Why there is no answer, None if there is one; None for one pose."""
    @property
    def kinds(self) -> _R:
        """The kind of each failure, in the same form: `infeasible_tension`, ..."""

@final
class DirectSolution(Generic[_N, _B, _I, _W, _R]):
    """Stable equilibria of the platform.

    The answer is of one case, or of m: then every field has a first axis of m, with NaN (or False, None)
    where there is no answer, and `reasons` says why.
    """

    def __new__(cls, *fields: Any) -> DirectSolution[_N, _B, _I, _W, _R]: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def position(self) -> _Floats:
        """Position of P in the base frame [m], (3,)."""
    @property
    def quaternion(self) -> _Floats:
        """Rotation from the platform to the base frame as a unit quaternion (w, x, y, z), w >= 0, (4,)."""
    @property
    def rotation(self) -> _Floats:
        """Rotation from the platform to the base frame as a matrix, (3, 3)."""
    @property
    def pose(self) -> _Floats:
        """Position and quaternion, a pose as other calls take it, (7,)."""
    @property
    def cable_forces(self) -> _Floats:
        """Force (fx, fz) on each cable at its anchor point, in its vertical plane [N], (n, 2)."""
    @property
    def tensions(self) -> _Floats:
        """Tension of each cable at the platform [N], (n,)."""
    @property
    def exit_tensions(self) -> _Floats:
        """Tension of each cable at its exit point [N], (n,)."""
    @property
    def out_of_limits(self) -> NDArray[np.int8]:
        """Whether its tension, at either end, is out of limits: 2 above the breaking force, 1 above the
        greatest tension, -1 below the least one, 0 within, (n,).
        """
    @property
    def stable(self) -> _B:
        """Whether the equilibrium is stable."""
    @property
    def neutral(self) -> _Floats:
        """Motions that nothing resists, a row for each, (6, 6): translation of P and rotation vector; NaN in
        the rows beyond.
        """
    @property
    def least_stiffness(self) -> _N:
        """Stiffness of the softest motion that is resisted [N/m]."""
    @property
    def slack(self) -> NDArray[np.bool_]:
        """Whether each cable carries at its lower end at most its own weight, (n,)."""
    @property
    def residual(self) -> _Floats:
        """Residuals of the 6 + 2n equations: closure of the cables [m], force [N], moment [N m], (3,)."""
    @property
    def method(self) -> _W:
        """Method that found the equilibrium: newton, trust_region or continuation."""
    @property
    def iterations(self) -> _I:
        """Iterations of that method; 0 where there is no answer."""
    @property
    def reasons(self) -> _R:
        """Why there is no answer, None if there is one; None for one case."""
    @property
    def kinds(self) -> _R:
        """The kind of each failure, in the same form: `infeasible_tension`, ..."""

@final
class Deflection(Generic[_N, _B, _I, _W, _R]):
    """Static deflections.

    The answer is of one case, or of m: then every field has a first axis of m, with NaN where there is no
    answer, and `reasons` says why.
    """

    def __new__(cls, *fields: Any) -> Deflection[_N, _B, _I, _W, _R]: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def displacement(self) -> _Floats:
        """Displacement dp of P, the position with the load minus that without [m], (3,)."""
    @property
    def magnitude(self) -> _N:
        """Norm |dp| of the displacement, the paper's RMS [m]."""
    @property
    def rotation(self) -> _Floats:
        """Rotation vector from the unloaded to the loaded platform, in the base frame [rad], (3,)."""
    @property
    def lengths(self) -> _Floats:
        """Unstrained lengths of the cables [m], (n,)."""
    @property
    def unloaded(self) -> DirectSolution[_N, _B, _I, _W, _R]:
        """The platform under its own weight."""
    @property
    def loaded(self) -> DirectSolution[_N, _B, _I, _W, _R]:
        """The platform with the load added."""
    @property
    def reasons(self) -> _R:
        """Why there is no answer, None if there is one; None for one case."""
    @property
    def kinds(self) -> _R:
        """The kind of each failure, in the same form: `infeasible_tension`, ..."""

@final
class Response(Generic[_R]):
    """How a platform on cables with mass moves when it is shaken, at k frequencies.

    Complex amplitudes: the absolute value is the size, the angle the phase. The answer is of one pose, or
    of m: then every field has a first axis of m, with NaN where there is no answer, and `reasons` says
    why.
    """

    def __new__(cls, *fields: Any) -> Response: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def frequencies_hz(self) -> _Floats:
        """Frequencies [Hz], (k,)."""
    @property
    def amplitudes(self) -> _Floats:
        """Largest amplitude of the point for a force there of any direction [m/N], (k,): the norm of the
        motions along x, y and z. Infinite where the force moves it along a motion that nothing resists.
        """
    @property
    def per_force(self) -> _Complex:
        """Motion of the point along x, y, z for forces there along x, y, z [m/N], (k, 3, 3), complex."""
    @property
    def per_shortening(self) -> _Complex:
        """Motion of the point per length that each winch takes in [m/m], (k, n, 3), complex."""
    @property
    def per_wrench(self) -> _Complex:
        """Translation of P and rotation vector per force at P and moment [m/N, rad/N, m/(N m), rad/(N m)],
        (k, 6, 6), complex; at 0 Hz without motions that nothing resists.
        """
    @property
    def reasons(self) -> _R:
        """Why there is no answer, None if there is one; None for one pose."""
    @property
    def kinds(self) -> _R:
        """The kind of each failure, in the same form: `infeasible_tension`, ..."""

@final
class Motion:
    """A motion of a robot at m times."""

    def __new__(cls, *fields: Any) -> Motion: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def times(self) -> _Floats:
        """Times [s], (m,)."""
    @property
    def poses(self) -> _Floats:
        """Poses, x, y, z, qw, qx, qy, qz, (m, 7)."""
    @property
    def velocities(self) -> _Floats:
        """Velocity of P in the base frame [m/s], (m, 3)."""
    @property
    def angular_velocities(self) -> _Floats:
        """Angular velocity in the base frame [rad/s], (m, 3)."""
    @property
    def tensions(self) -> _Floats:
        """Tension of each cable at the platform [N], (m, n); zero where it has parted."""
    @property
    def exit_tensions(self) -> _Floats:
        """Tension of each cable at its exit point [N], (m, n)."""
    @property
    def summary(self) -> MotionSummary:
        """What the motion is as a whole, and how exact it is."""

@final
class Move:
    """Set points of the winches for a move of a robot, at m times."""

    def __new__(cls, *fields: Any) -> Move: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def times(self) -> _Floats:
        """Times [s], (m,)."""
    @property
    def poses(self) -> _Floats:
        """Wanted poses, x, y, z, qw, qx, qy, qz, (m, 7)."""
    @property
    def lengths(self) -> _Floats:
        """Unstrained lengths [m], (m, n)."""
    @property
    def feed_forward(self) -> _Floats:
        """Their part for the motion: the differences to those at rest there [m], (m, n)."""
    @property
    def tensions(self) -> _Floats:
        """Tension of each cable at the platform in motion [N], (m, n)."""
    @property
    def exit_tensions(self) -> _Floats:
        """Tension of each cable at its exit point in motion [N], (m, n)."""
    @property
    def summary(self) -> MoveSummary:
        """The shaper, and what swings."""

@final
class MoveSummary:
    """The shaper of a move with k impulses for j natural motions, and what swings after the move."""

    def __new__(cls, *fields: Any) -> MoveSummary: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def impulses(self) -> _Floats:
        """Time [s] and amplitude of each impulse of the shaper, (k, 2)."""
    @property
    def frequencies_hz(self) -> _Floats:
        """Natural frequencies that the shaper is for [Hz], (j,)."""
    @property
    def damping_ratios(self) -> _Floats:
        """Share of critical damping of these motions, (j,)."""
    @property
    def platform_shares(self) -> _Floats:
        """Share of the platform in their kinetic energy, (j,)."""
    @property
    def amplitude(self) -> float:
        """Greatest distance of P from its rest after the move [m]; NaN without `residual`, as all below."""
    @property
    def unshaped_amplitude(self) -> float:
        """The same of the move without shaper and feed-forward [m]."""
    @property
    def deviation(self) -> float:
        """Greatest distance of P from the wanted pose on the way [m]."""
    @property
    def unshaped_deviation(self) -> float:
        """The same of the move without shaper and feed-forward [m]."""
    @property
    def position_difference(self) -> float:
        """Greatest difference of the position of P to a coarser computation [m]."""
    @property
    def slack(self) -> _Bools:
        """Whether each cable loses its tension in one of both moves, (n,)."""

@final
class MotionSummary:
    """A motion as a whole."""

    def __new__(cls, *fields: Any) -> MotionSummary: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def pose(self) -> _Floats:
        """Pose at rest before the first event, (7,)."""
    @property
    def lengths(self) -> _Floats:
        """Unstrained lengths there [m], (n,)."""
    @property
    def greatest_tensions(self) -> _Floats:
        """Greatest tension of each cable at either end at any step [N], (n,)."""
    @property
    def greatest_times(self) -> _Floats:
        """When [s], (n,)."""
    @property
    def slack(self) -> _Bools:
        """Whether each cable carries no tension at a point at some time before it is cut, (n,)."""
    @property
    def position_difference(self) -> float:
        """Greatest difference of the position of P to a coarser computation [m]."""
    @property
    def rotation_difference(self) -> float:
        """Greatest difference of the rotation [rad]."""
    @property
    def tension_difference(self) -> float:
        """Greatest difference of a tension [N]."""
    @property
    def kinetic_energy(self) -> float:
        """Greatest kinetic energy of platform and cables [J]."""
    @property
    def given_energy(self) -> float:
        """Work of winches and forces, with the energy of what came and went [J]."""
    @property
    def lost_energy(self) -> float:
        """Energy that damping took [J]."""
    @property
    def energy_drift(self) -> float:
        """Energy that is missing at the end, or too much [J]."""
    @property
    def elements(self) -> _Ints:
        """Elements of each cable at the end, (n,)."""
    @property
    def degree(self) -> _Ints:
        """Degree of the polynomial on them, (n,)."""
    @property
    def steps(self) -> int:
        """Steps of time."""

@final
class MotionState:
    """A robot in motion at a time, as a control sees it."""

    def __new__(cls, *fields: Any) -> MotionState: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def pose(self) -> _Floats:
        """Pose, x, y, z, qw, qx, qy, qz, (7,)."""
    @property
    def velocity(self) -> _Floats:
        """Velocity of P in the base frame [m/s], (3,)."""
    @property
    def angular_velocity(self) -> _Floats:
        """Angular velocity in the base frame [rad/s], (3,)."""
    @property
    def tensions(self) -> _Floats:
        """Tension of each cable at the platform [N], (n,)."""
    @property
    def exit_tensions(self) -> _Floats:
        """Tension of each cable at its exit point [N], (n,)."""

@final
class Modes(Generic[_N, _R]):
    """Natural motions of platform and cables, of unit mass.

    The answer is of one pose, or of m: then every field has a first axis of m, with NaN where there is no
    answer, and `reasons` says why. There are k motions, as many as wanted, or as a frequency bounds: then
    poses with fewer than others have NaN for those that are missing.
    """

    def __new__(cls, *fields: Any) -> Modes: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def frequencies_hz(self) -> _Floats:
        """Natural frequencies, ascending [Hz], (k,)."""
    @property
    def within(self) -> _Floats:
        """Greatest relative error of each frequency that the counts leave, (k,)."""
    @property
    def platform_shares(self) -> _Floats:
        """Share of the platform in the kinetic energy of each motion, (k,)."""
    @property
    def swing_shares(self) -> _Floats:
        """Part of it that is the platform's slowest motion on cables without mass, (k,). The platform swings
        with the motion that has the largest one of all, which may lie above those that are found.
        """
    @property
    def cable_shares(self) -> _Floats:
        """Share of each cable in the kinetic energy of each motion, (k, n)."""
    @property
    def translations(self) -> _Floats:
        """Translation of P in each motion [1/sqrt(kg)], (k, 3)."""
    @property
    def rotations(self) -> _Floats:
        """Rotation in each motion [rad/(m sqrt(kg))], (k, 3)."""
    @property
    def complete_below_hz(self) -> _N:
        """Frequency up to which no motion is missing [Hz]."""
    @property
    def reasons(self) -> _R:
        """Why there is no answer, None if there is one; None for one pose."""
    @property
    def kinds(self) -> _R:
        """The kind of each failure, in the same form: `infeasible_tension`, ..."""

@final
class MasslessModes(Generic[_R]):
    """Natural motions of the platform on cables without mass, of unit mass.

    The answer is of one pose, or of m: then every field has a first axis of m, with NaN where there is no
    answer, and `reasons` says why.
    """

    def __new__(cls, *fields: Any) -> MasslessModes: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def frequencies_hz(self) -> _Floats:
        """Natural frequencies, ascending [Hz], (6,); of a point mass or a planar robot (3,), here and below."""
    @property
    def translations(self) -> _Floats:
        """Translation of P in each motion [1/sqrt(kg)], (6, 3)."""
    @property
    def rotations(self) -> _Floats:
        """Rotation in each motion [rad/(m sqrt(kg))], (6, 3)."""
    @property
    def cable_shares(self) -> _Floats:
        """Share of each cable in the energy of each motion, (6, n)."""
    @property
    def weight_shares(self) -> _Floats:
        """Share of the weight in the energy of each motion, (6,)."""
    @property
    def cable_frequencies_hz(self) -> _Floats:
        """The lowest frequency of each cable between ends at rest [Hz], (n,); NaN for one without mass.
        Where it is less than twice as high, the cables' mass changes the motions: see `Robot.modes`.
        """
    @property
    def reasons(self) -> _R:
        """Why there is no answer, None if there is one; None for one pose."""
    @property
    def kinds(self) -> _R:
        """The kind of each failure, in the same form: `infeasible_tension`, ..."""

@final
class Capacity(Generic[_N, _R]):
    """What can be carried at a pose, for the wrench that leaves the least.

    The answer is of one pose, or of m: then every field has a first axis of m, with NaN where there is no
    answer, and `reasons` says why. A payload is -inf where a limit is passed even without one, and inf
    where its weight does not pull at the cables. With `recomputed` the winches compute the tensions
    again, with `kept` the lengths are kept.
    """

    def __new__(cls, *fields: Any) -> Capacity: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def payload_recomputed(self) -> _N:
        """Greatest mass at the centre of mass [kg]."""
    @property
    def payload_kept(self) -> _N:
        """Greatest mass at the centre of mass until a tension reaches any of its limits [kg]."""
    @property
    def payload_kept_slack(self) -> _N:
        """The same, whichever cables become slack [kg]."""
    @property
    def margin_recomputed(self) -> _N:
        """Distance of the tensions from the nearest limit [N]."""
    @property
    def margin_kept(self) -> _N:
        """Distance of the tensions from the nearest limit [N]."""
    @property
    def blocked_by(self) -> list[Any]:
        """What blocks each of these five, in words, or why it does not exist; a list of five."""
    @property
    def nearest_cables(self) -> _N:
        """Distance of the surfaces of the nearest two cables [m]."""
    @property
    def nearest_to_platform(self) -> _N:
        """Distance of the cable nearest to the platform's hull [m]."""
    @property
    def tilt(self) -> _Floats:
        """How far the platform may tilt towards each azimuth [rad], (tilt,); (0,) if not asked for."""
    @property
    def reasons(self) -> _R:
        """Why there is no answer, None if there is one; None for one pose."""
    @property
    def kinds(self) -> _R:
        """The kind of each failure, in the same form: `infeasible_tension`, ..."""

@final
class RestInWeather(Generic[_N, _R]):
    """A platform at rest in weather.

    The answer is of one case, or of m: then every field has a first axis of m, with NaN where there is no
    answer, and `reasons` says why.
    """

    def __new__(cls, *fields: Any) -> RestInWeather: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def displacement(self) -> _Floats:
        """Displacement of P from the pose without load and weather [m], (3,)."""
    @property
    def magnitude(self) -> _N:
        """Its norm [m]."""
    @property
    def rotation(self) -> _Floats:
        """Rotation vector from the platform without load and weather, in the base frame [rad], (3,)."""
    @property
    def pose(self) -> _Floats:
        """Pose: x, y, z [m], qw, qx, qy, qz, (7,)."""
    @property
    def lengths(self) -> _Floats:
        """Unstrained lengths of the cables [m], (n,)."""
    @property
    def tensions(self) -> _Floats:
        """Tensions at the platform [N], (n,)."""
    @property
    def exit_tensions(self) -> _Floats:
        """Tensions at the exit points [N], (n,)."""
    @property
    def drags(self) -> _Floats:
        """Force of the wind on each cable [N], (n, 3)."""
    @property
    def force_residual(self) -> _N:
        """Unbalanced force on the platform [N]."""
    @property
    def moment_residual(self) -> _N:
        """Unbalanced moment about P [N m]."""
    @property
    def closure_residual(self) -> _N:
        """Largest distance between the end of a cable and its anchor point [m]."""
    @property
    def integration(self) -> _N:
        """Largest error of the integration along a cable [m]."""
    @property
    def inputs(self) -> list[str] | None:
        """Names of the inputs of `slopes`, the parameters of the robot and then the numbers of the weather;
        None unless they are requested.
        """
    @property
    def slopes(self) -> _Floats | None:
        """Derivatives of the displacement by each input [m per unit], (3, k), with NaN where one does not
        exist; None unless they are requested.
        """
    @property
    def reasons(self) -> _R:
        """Why there is no answer, None if there is one; None for one case."""
    @property
    def kinds(self) -> _R:
        """The kind of each failure, in the same form: `infeasible_tension`, ..."""

@final
class Safety(Generic[_R]):
    """What becomes of the platform when cables break, while the winches stand still.

    The k breaks are those of each cable alone, then those of all pairs, if asked for. The answer is of
    one pose, or of m: then every field has a first axis of m, with NaN where there is no answer, and
    `reasons` says why. Where no rest was found after a break, its numbers are NaN.
    """

    def __new__(cls, *fields: Any) -> Safety: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def broken(self) -> list[Any]:
        """Numbers of the broken cables, from 1: `"3"`, `"3+4"`; a list of k."""
    @property
    def endings(self) -> list[Any]:
        """How each break ends: `held`, `overloaded` (another cable is beyond its greatest tension or
        breaking force), `below_ground`, `turned_over` (by more than a right angle), `unknown` (the motion
        is not known, or its peak is too uncertain), or the kind of failure where no rest was found; a
        list of k.
        """
    @property
    def moved(self) -> _Floats:
        """How far the platform moves [m], (k,)."""
    @property
    def turned(self) -> _Floats:
        """How far it turns [rad], (k,)."""
    @property
    def poses(self) -> _Floats:
        """Where it comes to rest: x, y, z [m], qw, qx, qy, qz, (k, 7)."""
    @property
    def tensions(self) -> _Floats:
        """Tensions at the platform there [N], zero in a broken cable, (k, n)."""
    @property
    def exit_tensions(self) -> _Floats:
        """Tensions at the exit points there [N], (k, n)."""
    @property
    def safety_factor(self) -> _Floats:
        """Least breaking force over greatest tension, (k,); NaN where a breaking force is not known."""
    @property
    def swing_moved(self) -> _Floats:
        """Greatest distance of the platform from the pose in the motion that follows [m], (k,); NaN unless
        `swing` is given.
        """
    @property
    def peak_tension(self) -> _Floats:
        """Greatest tension of the other cables in that motion, at either end [N], (k,)."""
    @property
    def utilization(self) -> _Floats:
        """Greatest utilization of a cable by partial factors, of the whole robot, then after each break,
        (k + 1,): tension under the design loads times the factor of the resistance over breaking force,
        at rest and in the motion that follows; NaN unless `factors` is given, and where it is not known.
        """
    @property
    def utilization_reasons(self) -> list[Any]:
        """Why a utilization is not known, empty where it is; a list of k + 1, empty unless `factors` is
        given.
        """
    @property
    def reasons(self) -> _R:
        """Why there is no answer, None if there is one; None for one pose."""
    @property
    def kinds(self) -> _R:
        """The kind of each failure, in the same form: `infeasible_tension`, ..."""

@final
class Boundary:
    """The boundary of the region that the cables hold."""

    def __new__(cls, *fields: Any) -> Boundary: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def measure(self) -> float:
        """Area in a plane [m²], volume in a box [m³]."""
    @property
    def error(self) -> float:
        """Estimate of its error [m², m³]."""
    @property
    def doubtful(self) -> float:
        """What of it is in doubt, since parts thinner than a step of the grid are not seen [m², m³]."""
    @property
    def polygons(self) -> list[_Floats]:
        """Closed polygons in a plane, the region on their left [m]: a list of arrays (.., 3)."""
    @property
    def triangles(self) -> _Floats:
        """Triangles in a box, the region behind them [m], (t, 3, 3)."""
    @property
    def evaluations(self) -> int:
        """Number of positions that were asked for."""

@final
class Certificate(Generic[_N, _B, _R]):
    """Bounds on how far the exact equilibrium is from the one that was found, proved by interval arithmetic.

    The answer is of one case, or of m: then every field has a first axis of m, with NaN (or False) where
    there is no proof, and `reasons` says why.
    """

    def __new__(cls, *fields: Any) -> Certificate: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def pose(self) -> _Floats:
        """Position and quaternion that were found, (7,)."""
    @property
    def position(self) -> _N:
        """Bound on the distance of P from there [m]."""
    @property
    def rotation(self) -> _N:
        """Bound on the angle [rad]."""
    @property
    def force(self) -> _N:
        """Bound on the error of the force of every cable [N]."""
    @property
    def least_stiffness(self) -> _N:
        """Lower bound of the stiffness of the softest motion [N/m]."""
    @property
    def stable(self) -> _B:
        """Whether the exact equilibrium is proved stable."""
    @property
    def reasons(self) -> _R:
        """Why there is no proof, None if there is one; None for one case."""
    @property
    def kinds(self) -> _R:
        """The kind of each failure, in the same form: `not_certified`, ..."""

@final
class LoadEstimates:
    """What is known after each sample, and what the sample says.

    The answer is of one sample, or of m: then every field has a first axis of m.
    """

    def __new__(cls, *fields: Any) -> LoadEstimates: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def payload(self) -> Any:
        """Mass of the load [kg]."""
    @property
    def payload_std(self) -> Any:
        """Its standard deviation [kg]."""
    @property
    def center(self) -> _Floats:
        """Centre of the load in the frame of the platform, from P [m], (3,); NaN where the load is below
        three times its standard deviation, or where the samples have not halved the uncertainty of its
        moment.
        """
    @property
    def center_std(self) -> _Floats:
        """Its standard deviation [m], (3,)."""
    @property
    def modulus(self) -> Any:
        """Modulus of the cables as a multiple of the robot's."""
    @property
    def modulus_std(self) -> Any:
        """Its standard deviation."""
    @property
    def force(self) -> _Floats:
        """Force that the measured tensions hold in addition to the platform's weight, base frame [N], (3,)."""
    @property
    def moment(self) -> _Floats:
        """Its moment about P [N m], (3,)."""
    @property
    def consistency(self) -> Any:
        """Chi-square of the readings for the best plausible load."""
    @property
    def change(self) -> Any:
        """Chi-square of the readings for the load that was known before."""
    @property
    def threshold(self) -> Any:
        """The value beyond which a chi-square deviates."""
    @property
    def alarm(self) -> Any:
        """none, load_changed, cable_slack, cable_lost or inconsistent."""
    @property
    def slack(self) -> _Bools:
        """Cables that read no tension, as the model allows, (n,)."""
    @property
    def lost(self) -> _Bools:
        """Cables that read no tension although the model has them taut, and no plausible load explains it,
        (n,).
        """
    @property
    def converged(self) -> Any:
        """Whether the model found a rest for the lengths; if not, the sample changed nothing."""
    @property
    def reasons(self) -> Any:
        """None for each sample: one without a rest has not converged, and the estimate is that before it."""

@final
class Observer:
    """Observes payload, centre of mass, modulus and broken cables from lengths and measured tensions.

    It keeps the rest of the robot at the last sample, and its estimate with the covariance: recursive least
    squares on the exact derivatives of the direct model. Sensors read the tensions at the platform; their
    errors are independent from sample to sample but for a constant one, which `tare` removes.

    Parameters
    ----------
    robot : Robot
        The robot.
    lengths : array_like
        Unstrained lengths with which it rests without load [m], (n,).
    pose : array_like
        The pose of this rest, or near it, (3,) or (7,).
    tension_std : array_like
        Standard deviation of what the sensors read [N], one or one for each cable.
    payload_std : float
        Standard deviation of the load before the first sample [kg]; its mean is no load.
    center_std : float, optional
        Standard deviation of the distance between its centre and that of the platform along each axis [m].
    length_std : float, optional
        Standard deviation of each length [m]; 0 where lengths count as exact.
    modulus_std : float, optional
        Standard deviation of the modulus as a share of the robot's, 0 to 0.15; 0 where it is known.
    memory : float, optional
        Number of samples after which a sample has lost most of its weight; if left out, none loses any.
    false_alarm : float, optional
        Probability that an alarm begins at a sample although nothing is wrong.
    consecutive : int, optional
        Number of samples in a row that have to deviate for an alarm.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.
    NoSolutionError
        Where the robot does not rest with these lengths.

    Examples
    --------
    >>> import cdpr
    >>> robot = cdpr.Robot.from_file("caroca")
    >>> found = robot.deflection([0, 0, 1.75], payload=5)
    >>> observer = cdpr.Observer(robot, found.lengths, [0, 0, 1.75], tension_std=5, payload_std=20)
    >>> samples = observer.update([found.lengths] * 100, [found.loaded.tensions] * 100)
    >>> f"{samples.payload[-1]:.2f} kg, alarm {samples.alarm[-1]}"
    '5.00 kg, alarm none'
    """

    def __new__(
        cls,
        robot: Robot,
        lengths: ArrayLike,
        pose: ArrayLike,
        *,
        tension_std: ArrayLike,
        payload_std: float,
        center_std: float = 0.0,
        length_std: float = 0.0,
        modulus_std: float = 0.0,
        memory: float = ...,
        false_alarm: float = 1e-9,
        consecutive: int = 3,
    ) -> Observer: ...
    def tare(self, lengths: ArrayLike, tensions: ArrayLike) -> LoadEstimates:
        """Takes samples without load: the mean difference between tensions and model over all such samples is
        the constant error of each sensor, which later samples subtract.

        Parameters
        ----------
        lengths : array_like
            Unstrained lengths [m], (n,) or (m, n).
        tensions : array_like
            Measured tensions at the platform [N], (n,) or (m, n).

        Returns
        -------
        LoadEstimates
            Without chi-squares and alarms.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right.
        """
    def update(self, lengths: ArrayLike, tensions: ArrayLike) -> LoadEstimates:
        """Takes samples, one after the other.

        Parameters
        ----------
        lengths : array_like
            Unstrained lengths [m], (n,) or (m, n).
        tensions : array_like
            Measured tensions at the platform [N], (n,) or (m, n).

        Returns
        -------
        LoadEstimates
            What is known after each sample.

        Raises
        ------
        InputError
            For an invalid value; the message names it and what would be right.
        """

@final
class PathStates:
    """What a robot does at the m poses of a path, NaN where there is no answer, and `reasons` says why.

    The lengths hold each pose under the platform's own weight, on the branch of the pose before; then the
    load comes onto the platform with the lengths kept.
    """

    def __new__(cls, *fields: Any) -> PathStates: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def jump(self) -> NDArray[np.bool_]:
        """Where the lengths may jump, (m,)."""
    @property
    def lengths(self) -> _Floats:
        """Unstrained lengths [m], (m, n)."""
    @property
    def tensions(self) -> _Floats:
        """Tensions at the platform without the load [N], (m, n)."""
    @property
    def exit_tensions(self) -> _Floats:
        """Tensions at the exit points without the load [N], (m, n)."""
    @property
    def sags(self) -> _Floats:
        """Greatest distance of each cable across its chord without the load [m], (m, n)."""
    @property
    def displacement(self) -> _Floats:
        """Displacement of P by the load [m], (m, 3)."""
    @property
    def magnitude(self) -> _Floats:
        """Its length [m], (m,)."""
    @property
    def least_stiffness(self) -> _Floats:
        """Stiffness of the softest motion with the load [N/m], (m,)."""
    @property
    def platform_frequency(self) -> _Floats:
        """Frequency with which the platform swings with the load, the mass of cables included [Hz], (m,);
        NaN for a robot without `inertia`.
        """
    @property
    def platform_share(self) -> _Floats:
        """Share of the platform in the kinetic energy of that motion, (m,)."""
    @property
    def lowest_frequency(self) -> _Floats:
        """Lowest natural frequency of platform and cables with the load [Hz], (m,)."""
    @property
    def std(self) -> PathDeviations | None:
        """Standard deviations by the uncertainty; None without one."""
    @property
    def loaded(self) -> DirectSolution[_Floats, _Bools, _Ints, _Words, _Words]:
        """The equilibria with the load."""
    @property
    def reasons(self) -> list[str | None]:
        """Why there is no answer, None if there is one, (m,)."""
    @property
    def kinds(self) -> list[str | None]:
        """The kind of each failure: `infeasible_tension`, ..."""

@final
class Stiffness(Generic[_N, _B, _R]):
    """Cartesian stiffness.

    The answer is of one pose, or of m: then every field has a first axis of m, with NaN where there is no
    answer, and `reasons` says why.
    """

    def __new__(cls, *fields: Any) -> Stiffness: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def matrix(self) -> _Floats:
        """Stiffness K in (dp, dphi), in the base frame about P [N/m, N/rad, N, N m/rad], (6, 6).

        It is the true tangent of the balance, with rotations R <- exp(dphi) R, and not symmetric under a
        moment.
        """
    @property
    def symmetric_part(self) -> _Floats:
        """Symmetric part of K, (6, 6)."""
    @property
    def eigenvalues(self) -> _Floats:
        """Eigenvalues of the symmetric part of the stiffness in (dp, characteristic_length dphi), from the
        softest motion [N/m], (6,); of a point mass or a planar robot (3,), here and below. Motions that
        nothing resists are left out, and the last numbers are NaN.
        """
    @property
    def translations(self) -> _Floats:
        """Translation of P in each of these motions [m/m], (6, 3)."""
    @property
    def rotations(self) -> _Floats:
        """Rotation in each of these motions [rad/m], (6, 3)."""
    @property
    def least_stiffness(self) -> _N:
        """Stiffness of the softest motion [N/m]."""
    @property
    def stable(self) -> _B:
        """Whether the equilibrium is stable."""
    @property
    def characteristic_length(self) -> _N:
        """Characteristic length, which makes rotations comparable with translations [m]."""
    @property
    def reasons(self) -> _R:
        """Why there is no answer, None if there is one; None for one pose."""
    @property
    def kinds(self) -> _R:
        """The kind of each failure, in the same form: `infeasible_tension`, ..."""

@final
class Derivatives(Generic[_N, _B, _I, _W, _R]):
    """A deflection with its exact derivatives, per SI unit of the k inputs.

    Where a cable leaves a bound on one side of an input only, the derivatives as the input falls (left)
    and as it grows (right) differ: `one_sided` says where. Fields without `right` in their name are left
    ones.

    The answer is of one case, or of m: then every field has a first axis of m, with NaN where there is no
    answer, and `reasons` says why.
    """

    def __new__(cls, *fields: Any) -> Derivatives: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def inputs(self) -> list[str]:
        """Names of the k inputs: the parameters of the robot, `payload`, and the wanted pose.

        The inputs of the pose are `x`, `y`, `z` [m] and `rx`, `ry`, `rz` [rad].
        """
    @property
    def one_sided(self) -> NDArray[np.bool_]:
        """Inputs whose left and right derivatives differ, (k,)."""
    @property
    def magnitude(self) -> _Floats:
        """Derivatives of |dp| [m per unit], (k,); NaN where nothing displaces the platform."""
    @property
    def displacement(self) -> _Floats:
        """Derivatives of dp [m per unit], (3, k)."""
    @property
    def lengths(self) -> _Floats:
        """Derivatives of the unstrained lengths [m per unit], (n, k)."""
    @property
    def set_points(self) -> _Floats:
        """Derivatives of the tension set-points [N per unit], (n, k)."""
    @property
    def tensions(self) -> _Floats:
        """Derivatives of the tensions with the load [N per unit], (n, k)."""
    @property
    def least_stiffness(self) -> _Floats:
        """Derivatives of the lowest stiffness with the load [N/m per unit], (k,); NaN where two motions have
        it.
        """
    @property
    def frequency(self) -> _Floats:
        """Derivatives of the frequency of the platform with the load [Hz per unit], (k,): of its motion
        with the mass of cables, as long as it changes less than its distance from the next. NaN where two
        motions have it, and without inertia of the platform.
        """
    @property
    def amplitude(self) -> _Floats:
        """Derivatives of the amplitude at the frequency `shaken` with the load, in the worst direction
        [m/N per unit], (k,). NaN without `shaken`, where two directions are shaken alike, and without
        inertia of the platform.
        """
    @property
    def magnitude_right(self) -> _Floats:
        """Right derivatives of |dp| [m per unit], (k,)."""
    @property
    def displacement_right(self) -> _Floats:
        """Right derivatives of dp [m per unit], (3, k)."""
    @property
    def lengths_right(self) -> _Floats:
        """Right derivatives of the unstrained lengths [m per unit], (n, k)."""
    @property
    def set_points_right(self) -> _Floats:
        """Right derivatives of the tension set-points [N per unit], (n, k)."""
    @property
    def tensions_right(self) -> _Floats:
        """Right derivatives of the tensions with the load [N per unit], (n, k)."""
    @property
    def least_stiffness_right(self) -> _Floats:
        """Right derivatives of the lowest stiffness [N/m per unit], (k,)."""
    @property
    def frequency_right(self) -> _Floats:
        """Right derivatives of the frequency of the platform [Hz per unit], (k,)."""
    @property
    def amplitude_right(self) -> _Floats:
        """Right derivatives of the amplitude [m/N per unit], (k,)."""
    @property
    def deflection(self) -> Deflection[_N, _B, _I, _W, _R]:
        """The deflection itself."""
    @property
    def reasons(self) -> _R:
        """Why there is no answer, None if there is one; None for one case."""
    @property
    def kinds(self) -> _R:
        """The kind of each failure, in the same form: `infeasible_tension`, ..."""

@final
class Observations(Generic[_N, _R]):
    """Deflections of m robots, or of one; NaN where there is no answer, and `reasons` says why."""

    def __new__(cls, *fields: Any) -> Observations: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def displacement(self) -> _Floats:
        """Displacement dp of P [m], (3,)."""
    @property
    def magnitude(self) -> _N:
        """Norm |dp| of the displacement [m]."""
    @property
    def reasons(self) -> _R:
        """Why there is no answer, None if there is one; None for one robot."""
    @property
    def kinds(self) -> _R:
        """The kind of each failure, in the same form: `infeasible_tension`, ..."""

@final
class Workspace:
    """Results at level positions on a grid, x slowest and z fastest; NaN where there is no answer."""

    def __new__(cls, *fields: Any) -> Workspace: ...
    def __class_getitem__(cls, number: Any) -> GenericAlias: ...
    def plot(self, *, ax: Any = None) -> Any:
        """Draws the answer: of one case a bar for each element, of several a line over the cases.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
    def to_dataframe(self) -> Any:
        """Makes a frame with a row for each case and columns of numbers and words.

        Columns have the names of the program's tables, which end in their units. Elements of arrays
        are numbered from 1, as cables are: `length_1_m`; those of an input have its name:
        `magnitude_mm/a1.x`.

        Returns
        -------
        pandas.DataFrame
            The frame.
        """
    @property
    def shape(self) -> tuple[int, int, int]:
        """Number of positions along x, y and z."""
    @property
    def positions(self) -> _Floats:
        """Positions of P [m], (m, 3)."""
    @property
    def status(self) -> list[str]:
        """`held`, `beyond_limits`, or the kind of failure; m of them.

        The lengths are kept under the load. A position is `beyond_limits` where the load takes a tension
        out of the limits.
        """
    @property
    def reasons(self) -> list[str | None]:
        """Why a position is not held, None if it is; m of them."""
    @property
    def least_tension(self) -> _Floats:
        """Least tension, without and with the load [N], (m,)."""
    @property
    def greatest_tension(self) -> _Floats:
        """Greatest tension, without and with the load [N], (m,)."""
    @property
    def displacement(self) -> _Floats:
        """Displacement dp of P under the payload [m], (m, 3)."""
    @property
    def magnitude(self) -> _Floats:
        """Norm |dp| of the displacement [m], (m,)."""
    @property
    def least_stiffness(self) -> _Floats:
        """Stiffness of the softest motion with the load [N/m], (m,)."""
    @property
    def platform_frequency(self) -> _Floats:
        """Frequency with which the platform swings with the load, the mass of cables included [Hz], (m,);
        NaN for a robot without inertia.
        """
    @property
    def platform_share(self) -> _Floats:
        """Share of the platform in the kinetic energy of that motion, (m,)."""
    @property
    def lowest_frequency(self) -> _Floats:
        """Lowest natural frequency of platform and cables with the load [Hz], (m,)."""
    @property
    def dominant(self) -> list[str | None]:
        """Uncertain parameter with the largest share of the variance of |dp|, or None; m of them."""
    @property
    def dominant_share(self) -> _Floats:
        """Share of that parameter, 0 to 1, (m,)."""
    @property
    def std(self) -> _Floats:
        """Standard deviation of |dp| from all uncertain parameters [m], (m,)."""
    @property
    def recomputed_status(self) -> list[str | None]:
        """`held` where tensions recomputed hold the position under the load, or the kind of failure;
        None without a load; m of them.
        """
    @property
    def recomputed_reasons(self) -> list[str | None]:
        """Why no tensions recomputed hold a position, None if they do; m of them."""
    @property
    def recomputed_least_tension(self) -> _Floats:
        """Least tension, recomputed [N], (m,)."""
    @property
    def recomputed_greatest_tension(self) -> _Floats:
        """Greatest tension, recomputed [N], (m,)."""
    @property
    def amplitude(self) -> _Floats:
        """Largest amplitude of the point in the band by a force there, of the worst direction [m/N], (m,);
        NaN without `band`.
        """
    @property
    def amplitude_frequency(self) -> _Floats:
        """Its frequency [Hz], (m,)."""
    @property
    def winch_amplitude(self) -> _Floats:
        """Largest amplitude of the point in the band by a winch, per length that it takes in [m/m], (m,)."""
    @property
    def winch_frequency(self) -> _Floats:
        """Its frequency [Hz], (m,)."""
    @property
    def amplitude_reasons(self) -> list[str | None]:
        """Why a position that is held has no amplitude, or None; m of them."""

def pose(
    position: ArrayLike, rotation: ArrayLike | Any | None = None, *, rpy_deg: ArrayLike | None = None
) -> _Floats:
    """Makes poses of positions and rotations, as all calls take them.

    Arguments are of one pose, or have a first axis of m poses. The rotation turns the platform frame into the
    base frame; the platform is level if it is left out.

    Parameters
    ----------
    position : array_like
        x, y, z [m], (3,) or (m, 3).
    rotation : array_like or Rotation, optional
        A quaternion qw, qx, qy, qz, (4,) or (m, 4), with the scalar first; or a
        `scipy.spatial.transform.Rotation`, whose own order does not matter then.
    rpy_deg : array_like, optional
        roll, pitch, yaw [degrees], (3,) or (m, 3), instead of a rotation: R = Rz(yaw) Ry(pitch)
        Rx(roll).

    Returns
    -------
    ndarray
        Poses x, y, z [m], qw, qx, qy, qz, (7,) or (m, 7).

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right; also for a quaternion whose
        scalar seems to be the last component, as SciPy has it.

    Examples
    --------
    >>> import cdpr
    >>> cdpr.pose([0, 0, 2], rpy_deg=[0, 0, 60]).round(3).tolist()
    [0.0, 0.0, 2.0, 0.866, 0.0, 0.0, 0.5]
    """
@overload
def catenary(
    weight: float,
    stiffness: float,
    *,
    length: float | None = None,
    end: _Row | None = None,
    force: _Row | None = None,
    tension: float | None = None,
    points: int = 51,
) -> Catenary[float, None]:
    """Computes an elastic cable from two of its unstrained length, end, force and tension.

    Given are `length` and `end`, `length` and `force`, or `end` and `tension`. Arguments are of one cable, or
    have a first axis of m cables.

    Parameters
    ----------
    weight : array_like
        Weight per unstrained length [N/m]; 0 makes the cable a straight spring.
    stiffness : array_like
        Axial stiffness EA [N].
    length : array_like, optional
        Unstrained length [m].
    end : array_like, optional
        Position (x, z) of the anchor point [m], (2,); x >= 0, z up.
    force : array_like, optional
        Force (fx, fz) on the cable at the anchor point [N], (2,).
    tension : array_like, optional
        Tension at the anchor point [N].
    points : int, default 51
        Number of points of `shape`, at least 2.

    Returns
    -------
    Catenary
        Forces, tensions and shapes.

    Raises
    ------
    InputError
        For an invalid value; the message names it and what would be right.
    NoSolutionError
        For one cable without an answer; of several, its row has NaN and a reason.

    Examples
    --------
    >>> import cdpr
    >>> cable = cdpr.catenary(1.0, 1e6, length=5.0, end=[4.0, 1.0])  # [N/m], [N], [m], [m]
    >>> cable.shape.shape
    (51, 2)
    """
@overload
def catenary(
    weight: ArrayLike,
    stiffness: ArrayLike,
    *,
    length: ArrayLike | None = None,
    end: ArrayLike | None = None,
    force: ArrayLike | None = None,
    tension: ArrayLike | None = None,
    points: int = 51,
) -> Catenary[_Floats, _Words]: ...

#: Inputs: name, law and steps.
_Inputs: TypeAlias = list[tuple[str, Any, Any]]
_Groups: TypeAlias = list[tuple[str, list[int]]] | None
_Matrix: TypeAlias = list[list[float]] | None

# Designs are native halves of the classes of `cdpr.sensitivity`; their estimates are JSON.

@final
class Sample:
    """A sample of the joint law of the inputs."""

    def __new__(
        cls,
        kind: str,
        given: _Inputs,
        points: int,
        first_index: int,
        seed: int | None,
        correlation: _Matrix,
    ) -> Sample: ...
    def size(self) -> int: ...
    def rows(self) -> _Floats: ...
    def effects(self, given: ArrayLike) -> str: ...
    def regression(self, given: ArrayLike, ranks: bool) -> str: ...
    def expansion(self, given: ArrayLike, max_degree: int, norm: float, interactions: int) -> Expansion: ...
    def gradient_expansion(
        self, given: ArrayLike, gradients: ArrayLike, max_degree: int, norm: float, interactions: int
    ) -> Expansion: ...
    def derivative_measures(self, given: ArrayLike, gradients: ArrayLike, level: float) -> str: ...
    def brackets(self, given: ArrayLike, gradients: ArrayLike, level: float, seed: int) -> str: ...
    def active_subspace(
        self,
        given: ArrayLike,
        gradients: ArrayLike,
        shares: list[float],
        level: float,
        resamples: int,
        seed: int,
    ) -> tuple[str, list[list[int]]]:
        """The subspace, and for each share of the sum of eigenvalues the number of directions that have it."""

@final
class Saltelli:
    """Blocks for Sobol' indices."""

    def __new__(
        cls, given: _Inputs, blocks: int, seed: int | None, pairs: bool, first_index: int, grouped: _Groups
    ) -> Saltelli: ...
    def size(self) -> int: ...
    def rows(self) -> _Floats: ...
    def indices(self, given: ArrayLike, level: float, resamples: int, seed: int) -> str: ...
    def vector_indices(self, given: ArrayLike, level: float, resamples: int, seed: int) -> str: ...
    def convergence(self, given: ArrayLike, level: float, resamples: int, seed: int) -> str: ...

@final
class Morris:
    """Blocks for elementary effects."""

    def __new__(
        cls, given: _Inputs, blocks: int, seed: int, levels: int | None, grouped: _Groups
    ) -> Morris: ...
    def size(self) -> int: ...
    def rows(self) -> _Floats: ...
    def effects(self, given: ArrayLike, level: float) -> str: ...

@final
class Shapley:
    """Walks for Shapley effects."""

    def __new__(
        cls, given: _Inputs, walks: int, seed: int, correlation: _Matrix, grouped: _Groups
    ) -> Shapley: ...
    def size(self) -> int: ...
    def rows(self) -> _Floats: ...
    def effects(self, given: ArrayLike, level: float) -> str: ...

@final
class Expansion:
    """A sparse polynomial chaos expansion."""

    def __new__(cls, text: str) -> Expansion: ...
    def __getnewargs__(self) -> tuple[str]: ...
    def summary(self) -> str:
        """What it says of the inputs, as JSON."""
    def group(self, names: list[str]) -> tuple[float, float]:
        """Shares of a group of inputs: closed and total."""
    def predict(self, rows: ArrayLike) -> _Floats: ...

def effect_intervals(samples: list[Sample], given: list[ArrayLike], level: float) -> str:
    """Intervals of effects from the outputs of several samples that differ in their seeds, as JSON."""
def wasserstein_bures(rows: ArrayLike, given: ArrayLike, level: float, seed: int) -> str:
    """Indices of Wasserstein and Bures of rows of inputs, (n, k), and of vectors, (n, m), as JSON."""
def law_values(law: _Law, of: str, values: ArrayLike) -> _Floats:
    """A function of a law at each value of an array."""
def law_moments(law: _Law) -> tuple[float, float, float | None]:
    """Mean, standard deviation and constant of Poincaré's inequality."""
def fit_laws(values: ArrayLike, family: str | None, resamples: int, seed: int) -> str:
    """Laws fitted to a sample, of one family or of all that apply, as JSON."""
def allocate(variances: ArrayLike, costs: ArrayLike, target: float) -> _Floats:
    """Factors of tolerances that leave a variance at the least cost."""
def analyse(
    rows: ArrayLike,
    outputs: ArrayLike,
    names: list[str],
    labels: list[list[str]],
    limit: tuple[str, float] | None,
    level: float,
    seed: int,
    dependence_rows: int,
    all_outputs: int,
) -> str:
    """Analyses rows of inputs, (n, k), and an output of them, (n,), one of `all_outputs`: the analysis as JSON.

    An input of words has its labels, and their numbers as values.
    """
def check(robot: Robot) -> str:
    """What is odd about a robot and yet no error, as JSON."""
def check_file(path: _Path) -> str:
    """The same of a robot file, whatever its units."""
def design(
    robot: Robot, design: _Source, is_front: bool, threads: int | None
) -> tuple[str, list[Robot]]:
    """The best robot by a design, or the front of its two objectives: what was found as JSON, and the robots."""
def tolerances(
    study: _Source,
    robot: Robot | None,
    sampling: str,
    limit_mm: float,
    of: str | None,
    quantile: float,
    costs: dict[str, float],
    observations: int,
    threads: int | None,
) -> str:
    """The tolerances to tighten so that an error stays below a limit, as JSON."""
def robustness(
    robot: Robot,
    poses: int,
    modulus: float | None,
    region: Any,
    free: list[str] | None,
    seed: int,
    out: _Path | None,
    overwrite: bool,
    progress: Callable[[int, int], object] | None,
    threads: int | None,
) -> str:
    """How often the direct model finds the true pose from a wrong start: `robustness.json`."""
def hysteresis(
    robot: Robot,
    pose: ArrayLike,
    payload: float,
    record: _Source | None,
    length: float | None,
    section: float | None,
    law: _Source | None,
    unloading: str,
    steps: int,
    free: list[str] | None,
    friction: float,
    bearing: float,
) -> str:
    """A payload that is put on and taken off, in SI units as JSON.

    The cables follow a record (with length and section of its specimen), a law file, or the robot's own laws.
    """
def pulley_friction(
    wraps: list[float], tensions: list[float], winch_tensions: list[float], slips: list[float]
) -> str:
    """The friction of pulleys from tensions on both sides of wheels that slip, as JSON."""
def modulus(
    record: _Source,
    length: float,
    section: float,
    breaking_force: float,
    ranges: list[tuple[float, float]],
    force_error: float,
    elongation_error: float,
    length_error: float,
    section_error: float,
) -> str:
    """The secant moduli of a record over ranges of load, and the energy of its loop, as JSON."""
def linear_density(
    mass: float, length: float, mass_error: float, length_error: float
) -> tuple[float, float]:
    """Mass per length of a weighed piece of cable, and its greatest error [kg/m]."""
def write_report(folder: _Path, out: _Path | None, workspace: _Path | None, overwrite: bool) -> Path:
    """Writes the report of a folder of results; returns its path.

    workspace: folder with the boundary of a workspace, which is drawn around the robot.
    """
def library() -> tuple[list[str], list[str]]:
    """Names of the robots and of the cables that come with the package."""
def import_robot(
    files: list[str],
    cable: _Path | None,
    mass: float | None,
    center_of_mass: ArrayLike | None,
    tension_limits: ArrayLike | None,
    cable_set: str | None,
) -> tuple[Robot, list[tuple[str, tuple[str, int] | None, str]]]:
    """A robot of the files of another program, and notes."""
def export_robot(robot: Robot, pose: ArrayLike, to: str) -> tuple[list[tuple[str, str]], list[str]]:
    """The files of a robot for another program by the ends of their names, and notes."""
def begin(
    study: _Source,
    robot: Robot | None,
    out: _Path,
    observations: int | None,
    resume: bool,
    overwrite: bool,
    table: str | None,
    threads: int | None,
) -> tuple[int, int]:
    """Makes the folder of a study, or continues with it; returns the numbers of blocks and observations.

    All settings of the run are checked before anything is removed.
    """
def make_shard(out: _Path, index: int, count: int, threads: int) -> int:
    """Makes the missing blocks of the `index`-th of `count` shards; returns their number of observations."""
def carry_out(
    out: _Path,
    table: str | None,
    threads: int | None,
    complete: bool,
    all: int,
    progress: Callable[[int, int], object] | None,
) -> list[str]:
    """Makes what is missing in the folder, analyses the whole, and writes all results and the report.

    A folder that must be `complete` is refused if blocks are missing. `progress` is called with the
    observations that are done and `all`.
    """
def observations(
    out: _Path, sampling: str
) -> tuple[list[str], _Floats, list[str], _Floats, list[str | None]]:
    """Reads the observations of a sampling in a folder.

    Returns the names of the inputs, their deviations (m, k), the names of the output's columns, their values
    (m, columns), and the kinds of failure.
    """
def open_results(out: _Path) -> None:
    """Checks that a folder holds results."""
def status(out: _Path) -> str:
    """Returns how far the study in a folder is, as `cdpr study status --format json` prints it."""
def calibrate(
    robot: Robot,
    measurements: _Source,
    out: _Path | None,
    noise: list[tuple[str, float]],
    uncertainty: list[tuple[str, float]] | _Source | None,
    parameters: list[str],
    share: list[str],
    unknown: list[tuple[str, float | None]],
    bounds: list[tuple[str, tuple[float, float]]],
    markers: Any,
    loss: str,
    starts: int,
    seed: int,
    only_identifiable: bool,
    folds: int,
    overwrite: bool,
    threads: int | None,
) -> tuple[Robot, str]:
    """Fits the parameters of a robot to measurements, and writes all results to a folder if one is given.

    Returns the calibrated robot, and as JSON the summary, what is known of the robot's errors, the residuals
    and the poses.
    """
def calibrate_pulleys(
    robot: Robot,
    measurements: _Source,
    pose: Any,
    noise: list[tuple[str, float]],
    free: list[str] | None,
) -> str:
    """The friction of pulleys from tensions at the winches, as JSON."""
def simulate(
    robot: Robot,
    poses: ArrayLike,
    out: _Path | None,
    uncertainty: list[tuple[str, float]] | _Source,
    noise: list[tuple[str, float]],
    unknown: list[tuple[str, float]],
    markers: Any,
    tension_at: str,
    payload: float,
    free: list[str] | None,
    seed: int,
    overwrite: bool,
) -> tuple[Robot, str]:
    """What a campaign would read at poses with a robot that deviates from its file, written to a file if one is
    given: the robot as it truly is, and the measurements as CSV.
    """
def identify(
    robot: Robot,
    poses: ArrayLike,
    uncertainty: list[tuple[str, float]] | _Source,
    noise: list[tuple[str, float]],
    payload: float,
    free: list[str] | None,
) -> str:
    """What measurements at poses determine of uncertain parameters, as JSON."""
def plan(
    robot: Robot,
    poses: ArrayLike,
    uncertainty: list[tuple[str, float]] | _Source,
    noise: list[tuple[str, float]],
    count: int,
    criterion: str,
    work: ArrayLike | None,
    of: str,
    payload: float,
    free: list[str] | None,
    seed: int,
) -> str:
    """The set of candidate poses that leaves least uncertainty, as JSON."""
def template(
    robot: Robot, position: ArrayLike | None, payload: float | None, free: list[str] | None
) -> str:
    """The text of a study file for a robot, with usual tolerances."""
def explorer_parts() -> dict[str, Any]:
    """The packed script, the worker, the style and the packed module of the explorer, for its widget."""
def run_program(arguments: list[str]) -> int:
    """Runs the program `cdpr` with these arguments, its own name the first, and returns its exit code."""
