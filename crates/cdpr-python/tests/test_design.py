"""Designs: the answers of the program as arrays, from files and dictionaries."""

import json
from pathlib import Path

import numpy
import pytest

import cdpr

DATA = Path(__file__).parents[3] / "data"


def mass_on_two_cables():
    """A point mass in a plane below exits that are 2 m higher, on cables that hardly stretch."""
    return cdpr.Robot(
        [[0, 0, 0]] * 2,
        [[-1, 0, 2], [1, 0, 2]],
        mass=100,
        section=1e-5,
        linear_density=0.0,
        youngs_modulus=1e16,
        tension_limits=(1.0, 1e6),
        point=True,
        plane="xz",
    )


def apart(**more):
    return {
        "format": "cdpr-design/1",
        "variables": [{"name": "half", "parameters": ["b1.x", "b2.x"], "signs": [1, -1], "bounds": [-6, -0.5]}],
        "poses": {"list": [{"position": [0, 0, 0]}]},
        "objective": {"output": "position", "over": "worst"},
        "errors": {"b": {"law": {"normal": {"mean": 0, "std": 1e-3}}}},
        "starts": 3,
        **more,
    }


def test_the_position_error_of_a_mass_on_two_cables_is_least_at_45_degrees():
    found = cdpr.design(mass_on_two_cables(), apart(), threads=2)
    assert found.names == ["half"] and found.values.shape == (1,)
    numpy.testing.assert_allclose(found.values, [-2], atol=1e-4)
    # Both coordinates deviate by 1 mm: Rayleigh's law.
    assert found.objective == pytest.approx(numpy.sqrt(-2 * numpy.log(0.05)), rel=1e-6)
    assert found.outputs.shape == (1,) and found.objective < found.before
    assert found.optimal and found.kkt_residual + found.gradient_error < 1e-6
    assert found.robot.exit_points[1, 0] == -found.values[0]
    frame = found.to_dataframe()
    assert frame.loc["half", "to"] == found.values[0] and frame.loc["half", "unit"] == "m"
    assert repr(found).startswith("Designed(position: ")
    pytest.importorskip("matplotlib", reason="matplotlib is not installed").use("svg")
    (axis,) = found.plot().axes
    assert [bar.get_height() for bar in axis.patches] == list(found.outputs)
    assert axis.lines[0].get_ydata()[0] == found.before and axis.get_ylabel() == "position [mm]"


def test_a_file_and_its_content_have_the_same_best_robot():
    path = DATA / "designs" / "caroca-pulleys.json"
    robot = cdpr.Robot.from_file("caroca")
    found = cdpr.design(robot, path)
    again = cdpr.design(robot, json.loads(path.read_text()), threads=1)
    assert found.content == again.content and found.robot == again.robot
    deflection = found.robot.deflection([0, 0, 1.75], payload=50).magnitude
    assert 1e3 * deflection == pytest.approx(found.outputs[0], rel=1e-9)
    assert numpy.isnan(found.kkt_residual) and found.reason is None


def test_a_front_has_no_point_that_another_dominates():
    pareto = {"output": "stiffness", "over": "worst", "points": 4}
    given = apart(objective={"output": "position", "over": "mean"}, pareto=pareto)
    front = cdpr.design_front(mass_on_two_cables(), given)
    points = len(front.robots)
    assert front.objectives.shape == (points, 2) and front.values.shape == (points, 1)
    assert (numpy.diff(front.objectives, axis=0) > 0).all()
    assert front.exchange.shape == front.optimal.shape == (points,)
    frame = front.to_dataframe()
    assert list(frame.columns) == ["mean_position_error_mm", "worst_least_stiffness_n_per_m", "exchange", "optimal", "half"]
    for robot, values in zip(front.robots, front.values):
        assert robot.exit_points[0, 0] == values[0]
    pytest.importorskip("matplotlib", reason="matplotlib is not installed").use("svg")
    (axis,) = front.plot().axes
    numpy.testing.assert_array_equal(axis.lines[0].get_xydata(), front.objectives)
    assert (axis.get_xlabel(), axis.get_ylabel()) == ("mean position [mm]", "worst stiffness [N/m]")


def test_what_no_robot_can_do_has_a_reason_and_wrong_designs_are_refused():
    lost = cdpr.design(mass_on_two_cables(), apart(limits={"position": 0.1}))
    assert lost.robot is None and numpy.isnan(lost.objective) and "its limit" in lost.reason
    assert len(lost.to_dataframe()) == 0 and not lost.optimal
    pytest.importorskip("matplotlib", reason="matplotlib is not installed").use("svg")
    assert not lost.plot().axes[0].patches
    with pytest.raises(cdpr.InputError, match="pareto is missing"):
        cdpr.design_front(mass_on_two_cables(), apart())
    pareto = {"output": "stiffness", "over": "worst"}
    with pytest.raises(cdpr.InputError, match="pareto is given"):
        cdpr.design(mass_on_two_cables(), apart(pareto=pareto))
    with pytest.raises(cdpr.InputError, match="starts is 0: expected 1 or more"):
        cdpr.design(mass_on_two_cables(), apart(starts=0))
    with pytest.raises(cdpr.FileError):
        cdpr.design(mass_on_two_cables(), "no-such-file.json")


def test_the_least_tension_and_length_of_a_mass_on_two_cables_are_those_below_the_exits():
    for output, expected in [("tension", 981 / 2 * numpy.hypot(0.5, 2) / 2), ("length", 2 * numpy.hypot(0.5, 2))]:
        found = cdpr.design(mass_on_two_cables(), apart(objective={"output": output}))
        assert found.optimal and found.values == [-0.5]
        assert found.objective == pytest.approx(expected, rel=1e-6) and found.outputs.shape == (1,)
    cable = {"section": 1e-5, "linear_density": 0.0, "youngs_modulus": 1e16}
    types = [{"name": "dear", "cost": 3, **cable}, {"name": "cheap", "cost": 2, **cable}]
    found = cdpr.design(mass_on_two_cables(), apart(objective={"output": "cost"}, cables=types))
    assert found.content["best"]["cables"][0]["name"] == "cheap" and numpy.isnan(found.before)
    assert found.objective == pytest.approx(4 * numpy.hypot(0.5, 2), rel=1e-6)
    with pytest.raises(cdpr.InputError, match="limits.tension is 0"):
        cdpr.design(mass_on_two_cables(), apart(limits={"tension": 0}))
