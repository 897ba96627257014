"""What a type checker sees of answers; `mypy --strict` checks it, nothing runs it."""

from typing import assert_type

import numpy as np
from numpy.typing import NDArray

import cdpr

Floats = NDArray[np.float64]

robot = cdpr.Robot.from_file("cogiro")
one = robot.deflection([0, 0, 2], payload=50)
assert_type(one.magnitude, float)
assert_type(one.displacement, Floats)
assert_type(one.reasons, None)
assert_type(one.loaded.stable, bool)
assert_type(one.loaded.method, str)

many = robot.deflection([[0, 0, 2], [0, 1, 2]], payload=50)
assert_type(many.magnitude, Floats)
assert_type(many.kinds, list[str | None])
assert_type(many.loaded.stable, NDArray[np.bool_])
assert_type(robot.deflection([0, 0, 2], payload=[1.0, 2.0]).magnitude, Floats)

assert_type(robot.stiffness([0, 0, 2]).least_stiffness, float)
assert_type(robot.stiffness([[0, 0, 2]]).least_stiffness, Floats)
assert_type(robot.response([0, 0, 2], [1.0]).reasons, None)
assert_type(robot.response([[0, 0, 2]], [1.0]).per_force, NDArray[np.complex128])
assert_type(robot.simulate([0, 0, 2], until=0.1, control=lambda t, state: state.velocity).summary.slack, NDArray[np.bool_])
assert_type(cdpr.catenary(1, 1e6, length=5, end=[4, 1]).sag, float)
assert_type(cdpr.catenary([1, 2], 1e6, length=5, end=[4, 1]).sag, Floats)
assert_type(robot.cables[0].section, float)
assert_type(robot.inverse(cdpr.pose([0, 0, 2], rpy_deg=[0, 0, 5])).lengths, Floats)


def softest(answer: cdpr.Stiffness[Floats]) -> float:
    """An answer for several poses as an argument."""
    return float(answer.least_stiffness.min())


plan = cdpr.calibration.plan(robot, [[0, 0, 2]], uncertainty={"a": 0.002}, noise={"position": 1e-4, "rotation": 1e-4})
assert_type(plan.poses, Floats)
assert_type(plan.quality.information_bits, float)
assert_type(cdpr.design(robot, "design.json").values, Floats)
assert_type(cdpr.design_front(robot, "design.json").objectives, Floats)
