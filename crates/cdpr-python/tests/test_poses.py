"""Poses from positions and rotations in the forms that people have them in."""

import numpy
import pytest

import cdpr

YAW = numpy.deg2rad(40)
LEVEL = [0.0, 0.0, 1.75]


def test_a_pose_without_rotation_is_level():
    assert cdpr.pose(LEVEL).tolist() == [*LEVEL, 1, 0, 0, 0]
    assert cdpr.pose([LEVEL] * 3).shape == (3, 7)


def test_angles_quaternions_and_rotations_of_scipy_are_the_same_pose():
    spatial = pytest.importorskip("scipy.spatial.transform", reason="SciPy is not installed")
    angles = numpy.random.default_rng(1).uniform(-50, 50, (20, 3))
    rotations = spatial.Rotation.from_euler("xyz", angles, degrees=True)
    expected = cdpr.pose(LEVEL, rpy_deg=angles)
    numpy.testing.assert_allclose(cdpr.pose(LEVEL, rotations), expected, atol=1e-15)
    x, y, z, w = rotations.as_quat().T
    numpy.testing.assert_allclose(cdpr.pose(LEVEL, numpy.stack([w, x, y, z], axis=1)), expected, atol=1e-15)
    numpy.testing.assert_allclose(cdpr.pose(LEVEL, rotations[3]), expected[3], atol=1e-15)
    half = spatial.Rotation.from_euler("z", 180, degrees=True)
    numpy.testing.assert_allclose(abs(cdpr.pose(LEVEL, half)[3:]), [0, 0, 0, 1], atol=1e-15)


@pytest.mark.parametrize("name", ["caroca", "cogiro", "ipanema-3"])
def test_a_robot_rests_at_a_turned_pose(name):
    robot = cdpr.Robot.from_file(name)
    height = {"ipanema-3": 1.3}.get(name, 1.75)
    turned = cdpr.pose([0, 0, height], rpy_deg=[0, 0, 3])
    lengths = robot.inverse(turned).lengths
    found = robot.direct(lengths, start=turned)
    numpy.testing.assert_allclose(found.pose, turned, atol=1e-9)
    assert not numpy.allclose(lengths, robot.inverse([0, 0, height]).lengths)


def test_a_quaternion_in_the_order_of_scipy_is_refused_with_what_to_write():
    scalar_last = [0, 0, numpy.sin(YAW / 2), numpy.cos(YAW / 2)]
    with pytest.raises(cdpr.InputError) as raised:
        cdpr.pose(LEVEL, scalar_last)
    for words in ("rotation: the quaternion 0,0,0.34202,0.939693", "would be 0.939693,0,0,0.34202", "rpy_deg"):
        assert words in str(raised.value), str(raised.value)
    # As a pose of seven numbers it may be what an answer was: it is questioned.
    with pytest.warns(UserWarning, match="as if it were qx,qy,qz,qw"):
        cdpr.catenary(1, 1e6, length=5, end=[4, 1])
        cdpr.Robot.from_file("caroca").inverse([[*LEVEL, *scalar_last]])


def test_what_makes_no_pose_is_refused():
    for arguments, words in (
        ({"rotation": [1, 0, 0, 0], "rpy_deg": [0, 0, 0]}, "rotation and rpy_deg are both given"),
        ({"rotation": [1, 0, 0]}, "rotation has 3 numbers a row: expected 4"),
        ({"rotation": [2, 0, 0, 0]}, "rotation: the quaternion 2,0,0,0 has the length 2"),
        ({"rpy_deg": [[0, 0, 0]] * 2, "position": [LEVEL] * 3}, "rpy_deg has 2 rows: expected one for all"),
        ({"rpy_deg": [0, 0, numpy.nan]}, "rpy_deg has NaN: expected finite numbers"),
        ({"position": [0, 0]}, "position has 2 numbers a row: expected 3"),
    ):
        with pytest.raises(cdpr.InputError) as raised:
            cdpr.pose(**{"position": LEVEL, **arguments})
        assert str(raised.value).startswith(words), str(raised.value)
