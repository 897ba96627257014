"""Elasto-statics of cable-driven parallel robots: platforms held by sagging, elastic cables.

All units are SI; the base frame has z up. A pose is x, y, z [m] or x, y, z, qw, qx, qy, qz.

Every call takes one case, or arrays with a first axis of m cases, which are computed on all cores. The answer
then has that axis, too, with NaN where there is no answer, and the reasons next to it. A single case without
an answer raises.

>>> import cdpr
>>> robot = cdpr.Robot.from_file("data/robots/caroca.json")
>>> given = robot.deflection([0, 0, 1.75], payload=50)
>>> print(f"{1e3 * given.magnitude:.4f} mm")
1.3312 mm
"""

from . import errors
from ._core import (
    VERSION as __version__,
    Boundary,
    Cable,
    Capacity,
    Catenary,
    Certificate,
    Deflection,
    Derivatives,
    DirectSolution,
    InverseSolution,
    LoadEstimates,
    MasslessModes,
    Modes,
    Motion,
    MotionState,
    MotionSummary,
    Move,
    MoveSummary,
    Observations,
    Observer,
    OtherSolution,
    PathDeviations,
    PathStates,
    Response,
    RestInWeather,
    Robot,
    Safety,
    Stiffness,
    Workspace,
    catenary,
    pose,
)
from .errors import CdprError, FaultError, FileError, InputError, NoSolutionError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from . import analysis, assess, calibration, designs, exchange, sensitivity, study
    from .analysis import analyse
    from .designs import design, design_front

__all__ = [
    "Boundary",
    "Cable",
    "Capacity",
    "Catenary",
    "CdprError",
    "Certificate",
    "Deflection",
    "Derivatives",
    "DirectSolution",
    "FileError",
    "FaultError",
    "InputError",
    "InverseSolution",
    "LoadEstimates",
    "NoSolutionError",
    "Observations",
    "Observer",
    "OtherSolution",
    "PathDeviations",
    "PathStates",
    "Response",
    "RestInWeather",
    "Robot",
    "MasslessModes",
    "Modes",
    "Motion",
    "MotionState",
    "MotionSummary",
    "Move",
    "MoveSummary",
    "Safety",
    "Stiffness",
    "Workspace",
    "__version__",
    "analyse",
    "analysis",
    "assess",
    "calibration",
    "catenary",
    "design",
    "design_front",
    "designs",
    "errors",
    "exchange",
    "pose",
    "sensitivity",
    "study",
]


def __getattr__(name: str) -> object:
    # These are loaded when they are first used: the modules that they need take longer than all the rest.
    if name in ("analysis", "assess", "calibration", "designs", "exchange", "sensitivity", "study"):
        import importlib

        return importlib.import_module(f"cdpr.{name}")
    if name == "analyse":
        from .analysis import analyse

        return analyse
    if name in ("design", "design_front"):
        from . import designs

        return getattr(designs, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
