"""Figures of the answers of a robot and of cables, by matplotlib."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .errors import InputError

#: What is drawn of an answer: a field, its label, and what its elements are of.
_DRAWN = {
    "Capacity": ("payload_recomputed", "greatest payload [kg]", "pose"),
    "Certificate": ("position", "bound on the distance of P [m]", "case"),
    "Deflection": ("magnitude", "displacement |dp| [m]", "case"),
    "DirectSolution": ("tensions", "tension [N]", "cable"),
    "InverseSolution": ("tensions", "tension [N]", "cable"),
    "MasslessModes": ("frequencies_hz", "natural frequency [Hz]", "motion"),
    "Modes": ("frequencies_hz", "natural frequency [Hz]", "motion"),
    "OtherSolution": ("tensions", "tension [N]", "cable"),
    "PathDeviations": ("tensions", "standard deviation of the tension [N]", "cable"),
    "PathStates": ("tensions", "tension [N]", "cable"),
    "RestInWeather": ("magnitude", "displacement |dp| [m]", "case"),
    "Safety": ("moved", "the platform moves [m]", "break"),
    "Stiffness": ("eigenvalues", "stiffness [N/m]", "motion"),
}


def axes_of(ax: Any, **settings: Any) -> Any:
    """Where to draw: axes that are given, or those of a new figure with such settings."""
    if ax is not None:
        return ax
    from matplotlib import pyplot

    return pyplot.subplots(layout="constrained", **settings)[1]


def figure_of(answer: Any, ax: Any = None) -> Any:
    """Draws an answer: of one case a bar for each element, of several a line over the cases."""
    kind = type(answer).__name__
    if kind == "Motion" and ax is None:
        return _motion(answer)
    if kind == "Boundary" and len(answer.triangles) > 0:
        return _surface(answer, ax)
    axis = axes_of(ax)
    special = _SPECIAL.get(kind)
    if special is not None:
        special(answer, axis)
    else:
        field, label, elements = _DRAWN[kind]
        single = getattr(answer, "reasons", None) is None
        draw(axis, getattr(answer, field), (label, elements), single=single)
    return axis.figure


def draw(axis: Any, values: Any, labels: tuple[str, str], *, single: bool) -> None:
    """Draws bars of the elements of one case, or lines over several, with the labels of values and elements."""
    import numpy

    array = numpy.atleast_1d(values)
    label, elements = labels
    axis.set_ylabel(label)
    if single:
        places = numpy.arange(1, len(array) + 1)
        axis.bar(places, array)
        axis.set_xticks(places)
        axis.set_xlabel(elements)
        return
    for k, column in enumerate(array.reshape(len(array), -1).T):
        axis.plot(column, ".-", label=str(k + 1))
    if array.ndim > 1:
        axis.legend(title=elements, ncols=4)
    axis.set_xlabel("case")


def _shape(answer: Any, axis: Any) -> None:
    import numpy

    for points in numpy.reshape(answer.shape, (-1, *numpy.shape(answer.shape)[-2:])):
        axis.plot(points[:, 0], points[:, 1])
    axis.set_aspect("equal", adjustable="datalim")
    axis.set_xlabel("x [m]")
    axis.set_ylabel("z [m]")


def _motion(answer: Any) -> Any:
    """Motion of P and turn from the rest, and the tensions at the platform, over the time."""
    import numpy

    rest, (place, turn, pull) = answer.summary.pose, axes_of(None, nrows=3, sharex=True)
    for k, name in enumerate("xyz"):
        place.plot(answer.times, 1e3 * (answer.poses[:, k] - rest[k]), label=name)
    share = numpy.abs(answer.poses[:, 3:] @ rest[3:])
    turn.plot(answer.times, numpy.rad2deg(2 * numpy.arccos(numpy.minimum(share, 1))))
    place.legend(ncols=3)
    place.set_ylabel("from the rest [mm]")
    turn.set_ylabel("turn [deg]")
    _pulls(answer, pull)
    return pull.figure


def _pulls(answer: Any, axis: Any) -> None:
    """The tensions at the platform over the time."""
    for k, tensions in enumerate(answer.tensions.T):
        axis.plot(answer.times, tensions, label=str(k + 1))
    axis.legend(title="cable", ncols=4)
    axis.set(xlabel="time [s]", ylabel="tension [N]")


def _amplitudes(answer: Any, axis: Any) -> None:
    """Amplitudes over the frequency, of several poses a curve for each."""
    import numpy

    curves = zip(numpy.atleast_2d(answer.frequencies_hz), numpy.atleast_2d(answer.amplitudes))
    for frequencies, amplitudes in curves:
        axis.semilogy(frequencies, 1e3 * amplitudes)
    axis.set(xlabel="frequency [Hz]", ylabel="largest amplitude [mm/N]")


def _payload(answer: Any, axis: Any) -> None:
    """The payload with its standard deviation over the samples."""
    import numpy

    known = numpy.atleast_1d(answer.payload)
    axis.errorbar(numpy.arange(1, len(known) + 1), known, numpy.atleast_1d(answer.payload_std), fmt=".-")
    axis.set(xlabel="sample", ylabel="payload [kg]")


def _distribution(answer: Any, axis: Any) -> None:
    import numpy

    values = numpy.atleast_1d(answer.magnitude)
    axis.hist(1e3 * values[numpy.isfinite(values)], bins="auto")
    axis.set_xlabel("displacement |dp| [mm]")
    axis.set_ylabel("robots")


def _map(answer: Any, axis: Any) -> None:
    """|dp| over a plane; over a box in its middle plane along z. Positions without an answer stay empty."""
    import numpy

    grid = answer.positions.reshape(*answer.shape, 3)
    values = 1e3 * answer.magnitude.reshape(answer.shape)
    thin = answer.shape.index(1) if 1 in answer.shape else 2
    middle = answer.shape[thin] // 2
    across, up = (k for k in range(3) if k != thin)
    plane, places = numpy.take(values, middle, axis=thin), numpy.take(grid, middle, axis=thin)
    if min(plane.shape) < 2:
        axis.plot(places[..., across if plane.shape[0] > 1 else up].ravel(), plane.ravel(), ".-")
        axis.set_xlabel(f"{'xyz'[across if plane.shape[0] > 1 else up]} [m]")
        axis.set_ylabel("displacement |dp| [mm]")
        return
    known = plane[numpy.isfinite(plane)]
    wide = known.size > 0 and 0 < 10 * known.min() <= known.max()
    norm = "log" if wide else None
    image = axis.pcolormesh(places[..., across], places[..., up], plane, shading="nearest", norm=norm)
    axis.figure.colorbar(image, ax=axis, label="displacement |dp| [mm]")
    axis.set_aspect("equal")
    axis.set_xlabel(f"{'xyz'[across]} [m]")
    axis.set_ylabel(f"{'xyz'[up]} [m]")


def _boundary(answer: Any, axis: Any) -> None:
    """The polygons in a plane, along its two axes."""
    import numpy

    parts = answer.polygons
    points = numpy.concatenate(parts) if parts else numpy.zeros((1, 3))
    across, up = sorted(numpy.argsort(-numpy.ptp(points, axis=0), kind="stable")[:2])
    for part in parts:
        closed = numpy.vstack([part, part[:1]])
        axis.plot(closed[:, across], closed[:, up], "k-")
    axis.set_aspect("equal", adjustable="datalim")
    axis.set_xlabel(f"{'xyz'[across]} [m]")
    axis.set_ylabel(f"{'xyz'[up]} [m]")


def _surface(answer: Any, ax: Any) -> Any:
    """The triangles of a region in space."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    axis = axes_of(ax, subplot_kw={"projection": "3d"})
    if axis.name != "3d":
        raise InputError(f'ax has the projection {axis.name!r}: expected "3d" for a region in space')
    axis.add_collection3d(Poly3DCollection(answer.triangles, edgecolor="k", linewidth=0.3, alpha=0.5))
    points = answer.triangles.reshape(-1, 3)
    axis.set(**{f"{name}lim": (low, high) for name, low, high in zip("xyz", points.min(axis=0), points.max(axis=0))})
    axis.set(xlabel="x [m]", ylabel="y [m]", zlabel="z [m]", aspect="equal")
    return axis.figure


_SPECIAL: dict[str, Callable[[Any, Any], None]] = {
    "Boundary": _boundary,
    "Catenary": _shape,
    "LoadEstimates": _payload,
    "Motion": _pulls,
    "Move": _pulls,
    "Observations": _distribution,
    "Response": _amplitudes,
    "Workspace": _map,
}
