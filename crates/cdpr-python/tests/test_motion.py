"""Motions over time and responses to shaking, against the program and against what must hold."""

import json
import pickle

import numpy
import pytest

import cdpr
from conftest import answer

#: Robots that differ, with a pose and the coordinates that are found there.
ROBOTS = [
    ("caroca", [0.4, 0.3, 1.75], None),
    ("cogiro", [0.0, 0.0, 2.0], None),
    ("fast", [0.0, 0.0, 140.0], None),
    ("ipanema-1", [0.0, 0.0, 1.0], None),
    ("ipanema-3", [0.5, 0.2, 1.5], None),
    ("four-cables", [0.3, 0.2, 2.0], ["roll", "pitch"]),
]


def with_inertia(name):
    """The robot, with the moments of a ball where it has none."""
    content = cdpr.Robot.from_file(name).to_dict()
    platform = content["platform"]
    if "inertia" not in platform:
        points = numpy.array([cable["anchor_point"] for cable in content["cables"]])
        moment = 0.4 * platform["mass"] * float(numpy.linalg.norm(points, axis=1).max()) ** 2
        platform["inertia"] = numpy.diag([moment] * 3).tolist()
    return cdpr.Robot.from_dict(content)


def text(values):
    return ",".join(map(repr, values))


@pytest.mark.parametrize(("name", "pose", "free"), ROBOTS)
def test_a_motion_is_that_of_the_program(name, pose, free, tmp_path):
    robot = with_inertia(name)
    mass = robot.to_dict()["platform"]["mass"]
    events = [{"t": 0.02, "payload": 0.1 * mass}, {"t": 0, "force": numpy.array([0.01 * mass, 0, 0])}]
    motion = robot.simulate(pose, until=0.1, rate=1000, events=events, free=free, damping=2e-4)
    (tmp_path / "robot.json").write_text(robot.to_json())
    plain = [events[0], {"t": 0, "force": events[1]["force"].tolist()}]
    (tmp_path / "events.json").write_text(json.dumps(plain))
    arguments = ["simulate", tmp_path / "robot.json", f"--pose={text(pose)}", "--events", tmp_path / "events.json"]
    arguments += ["--until", "0.1", "--rate", "1000", "--damping", "2e-4"]
    arguments += ["--free", ",".join(free)] if free else []
    expected = answer(*arguments)
    rows = numpy.array(expected["samples"])
    n = robot.n_cables
    numpy.testing.assert_array_equal(motion.times, rows[:, 0])
    numpy.testing.assert_array_equal(motion.poses[:, :3], rows[:, 1:4])
    numpy.testing.assert_array_equal(motion.poses[:, 3:], rows[:, -4:])
    numpy.testing.assert_array_equal(motion.exit_tensions, rows[:, 7 : 7 + 2 * n : 2])
    numpy.testing.assert_array_equal(motion.tensions, rows[:, 8 : 8 + 2 * n : 2])
    summary = motion.summary
    numpy.testing.assert_array_equal(summary.lengths, expected["lengths"])
    assert summary.position_difference == expected["difference"]["position_m"]
    assert summary.energy_drift == expected["energy"]["drift_j"] and summary.steps == expected["steps"]
    assert motion.poses.shape == (101, 7)
    assert motion.velocities.shape == motion.angular_velocities.shape == (101, 3)
    middle = (motion.poses[2:, :3] - motion.poses[:-2, :3]) / 0.002
    speed = numpy.abs(motion.velocities).max()
    numpy.testing.assert_allclose(motion.velocities[1:-1], middle, atol=0.5 * speed)


def test_winches_follow_an_array_and_the_platform_follows_them(cogiro):
    times = numpy.linspace(0, 1, 101)
    down = 2 - 0.05 * (10 * times**3 - 15 * times**4 + 6 * times**5)
    wanted = numpy.column_stack([numpy.zeros((101, 2)), down])
    lengths = cogiro.inverse(wanted).lengths
    event = {"t": 0, "lengths": {"times": times, "lengths": lengths}}
    motion = cogiro.simulate([0, 0, 2], until=1, events=[event], damping=2e-4)
    assert numpy.abs(motion.poses[:, :3] - wanted).max() < 2e-3
    assert abs(motion.poses[-1, 2] - 1.95) < 1e-3 and not motion.summary.slack.any()


def test_a_control_sees_the_state_and_pulls_until_the_next_sample(cogiro):
    seen = []

    def pull(t, state):
        seen.append((t, state.pose.copy(), state.tensions.copy()))
        return [100.0, 0, 0] if t >= 0.05 else None

    motion = cogiro.simulate([0, 0, 2], until=0.1, control=pull)
    same = cogiro.simulate([0, 0, 2], until=0.1, events=[{"t": 0.05, "force": [100, 0, 0]}])
    numpy.testing.assert_allclose(motion.poses, same.poses, atol=1e-8)
    assert motion.summary.given_energy > 0
    # Two computations, each with all samples.
    assert len(seen) == 22
    for t, pose, tensions in seen:
        k = round(100 * t)
        numpy.testing.assert_allclose(pose, motion.poses[k], atol=1e-5)
        numpy.testing.assert_allclose(tensions, motion.tensions[k], rtol=0.05)
    moment = cogiro.simulate([0, 0, 2], until=0.1, control=lambda t, state: numpy.array([0, 0, 0, 0, 0, 30.0]))
    assert moment.angular_velocities[1, 2] > 0


def test_a_control_ends_a_motion_or_raises_through_it(cogiro):
    def stop(t, state):
        if t > 0.0449:
            raise StopIteration
        return None

    assert cogiro.simulate([0, 0, 2], until=1, control=stop).times[-1] == 0.05
    for wrong, words in [
        (lambda t, state: [1, 2], r"what control returns at 0.0 s has the shape \[2\]: expected a force"),
        (lambda t, state: [1, 2, numpy.nan], "has NaN: expected finite numbers"),
        (lambda t, state: "left", "expected real numbers"),
    ]:
        with pytest.raises(cdpr.InputError, match=words):
            cogiro.simulate([0, 0, 2], until=1, control=wrong)
    with pytest.raises(ZeroDivisionError):
        cogiro.simulate([0, 0, 2], until=1, control=lambda t, state: 1 / 0)


def test_what_is_not_possible_is_refused_with_its_name(cogiro):
    for arguments, words in [
        ({"events": [{"t": 0, "cut": 9}]}, "event 1, cut is 9: expected the number of a cable, 1 to 8"),
        ({"events": [{"t": 0, "cutt": 1}]}, "unknown field `cutt`"),
        ({"events": {"t": 0}}, "events: "),
        ({"rate": -1}, "rate is -1"),
        ({"damping": 2}, "damping is 2"),
        ({"elements": 0}, "elements is 0"),
        ({"payload": [1, 2]}, "expected one motion a call"),
    ]:
        with pytest.raises(cdpr.InputError, match=words):
            cogiro.simulate([0, 0, 2], until=0.1, **arguments)
    with pytest.raises(cdpr.InputError, match="pose and lengths are both missing"):
        cogiro.simulate(until=0.1)
    with pytest.raises(cdpr.InputError, match="frequencies has the shape"):
        cogiro.response([0, 0, 2], [0.0])
    with pytest.raises(cdpr.InputError, match="inertia"):
        content = cogiro.to_dict()
        del content["platform"]["inertia"]
        cdpr.Robot.from_dict(content).response([0, 0, 2], [1.0])


@pytest.mark.parametrize(("name", "pose", "free"), ROBOTS)
def test_a_response_is_that_of_the_program_and_static_at_rest(name, pose, free, tmp_path):
    robot = with_inertia(name)
    (tmp_path / "robot.json").write_text(robot.to_json())
    arguments = ["response", tmp_path / "robot.json", f"--pose={text(pose)}", "--below", "3", "--number", "5"]
    arguments += ["--with", "damping=0.001,drag=0.5", "--marker=0.1,0,0.2"]
    expected = answer(*arguments, *(["--free", ",".join(free)] if free else []))["frequencies"]
    frequencies = [at["frequency_hz"] for at in expected]
    found = robot.response(pose, frequencies, damping=0.001, drag=0.5, marker=[0.1, 0, 0.2], free=free)
    numpy.testing.assert_array_equal(1e3 * found.amplitudes, [at["amplitude_mm_per_n"] for at in expected])
    for field, factor, name in [("per_force", 1e3, "per_force_mm_per_n"), ("per_shortening", 1, "per_winch_mm_per_mm")]:
        theirs = numpy.array([at[name] for at in expected])
        numpy.testing.assert_array_equal(factor * getattr(found, field), theirs[..., 0] + 1j * theirs[..., 1])
    assert found.per_wrench.shape == (len(frequencies), 6, 6)
    at_rest = found.per_wrench[0]
    numpy.testing.assert_allclose(at_rest, at_rest.T, atol=1e-9 * numpy.abs(at_rest).max())
    assert numpy.abs(at_rest.imag).max() == 0


def test_responses_of_several_poses_have_a_row_for_each(cogiro):
    frequencies = [0.0, 1.0, 2.5]
    found = cogiro.response([[0, 0, 2], [9, 9, 9], [1, 0, 2]], frequencies, drag=0.1)
    assert found.amplitudes.shape == (3, 3) and found.per_wrench.shape == (3, 3, 6, 6)
    assert found.reasons[0] is None and found.reasons[1] and numpy.isnan(found.amplitudes[1]).all()
    one = cogiro.response([1, 0, 2], frequencies, drag=0.1)
    numpy.testing.assert_array_equal(found.per_shortening[2], one.per_shortening)


def test_motions_and_responses_are_pickled_drawn_and_made_frames(cogiro):
    motion = cogiro.simulate([0, 0, 2], until=0.07, events=[{"t": 0, "payload": 10}])
    response = cogiro.response([0, 0, 2], [0.0, 1.0, 2.0])
    again = pickle.loads(pickle.dumps(motion))
    numpy.testing.assert_array_equal(again.poses, motion.poses)
    assert again.summary.steps == motion.summary.steps
    assert repr(motion).startswith("<cdpr.Motion times (8,), poses (8, 7), ")
    assert len(repr(motion.summary)) < 700 and repr(response).startswith("<cdpr.Response ")
    pytest.importorskip("pandas", reason="pandas is not installed")
    # Eight samples of a robot with eight cables: rows are samples.
    frame = motion.to_dataframe()
    assert len(frame) == 8 and list(frame["t_s"]) == list(motion.times)
    assert list(frame["t_anchor_8_n"]) == list(motion.tensions[:, 7])
    assert len(motion.summary.to_dataframe()) == len(response.to_dataframe()) == 1
    matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    matplotlib.use("svg")
    from matplotlib import pyplot

    move = cogiro.move([[0, 0, 2], [0.1, 0, 2]], 0.5, rate=20)
    assert len(move.to_dataframe()) == len(move.times) == 11 and len(move.summary.to_dataframe()) == 1
    poses = [[0, 0, 2], [1, 0, 2]]
    alike = [move, response, cogiro.response(poses, [0.0, 1.0]), cogiro.massless_modes(poses)]
    for one, axes in [(motion, 3), *((one, 1) for one in alike)]:
        figure = one.plot()
        assert len(figure.axes) == axes and all(axis.lines and axis.get_ylabel() for axis in figure.axes)
        # A motion has room for its tensions there.
        given = pyplot.figure().add_subplot()
        assert one.plot(ax=given) is given.figure and given.lines and len(given.figure.axes) == 1
        pyplot.close("all")


@pytest.mark.parametrize("with_", ["shaper=zvd,residual=0.3", "feed-forward,profile=polynomial"])
def test_a_move_is_that_of_the_program(cogiro, tmp_path, with_):
    poses = [[-0.5, 0, 2], [0.5, 0, 2]]
    (tmp_path / "poses.csv").write_text("x,y,z\n-0.5,0,2\n0.5,0,2\n")
    (tmp_path / "robot.json").write_text(cogiro.to_json())
    arguments = ["path", tmp_path / "robot.json", "--poses", tmp_path / "poses.csv"]
    expected = answer(*arguments, "--with", f"seconds=1.5,rate=100,{with_}")
    shaped = {"shaper": "zvd", "residual": 0.3}
    move = cogiro.move(poses, 1.5, rate=100, **(shaped if "zvd" in with_ else {"feed_forward": "cables"}))
    rows, n = numpy.array(expected["set_points"]), cogiro.n_cables
    of_cables = [move.lengths, move.feed_forward, move.tensions, move.exit_tensions]
    numpy.testing.assert_array_equal(numpy.hstack([move.times[:, None], move.poses, *of_cables]), rows)
    assert rows.shape == (151, 8 + 4 * n)
    summary = move.summary
    numpy.testing.assert_array_equal(summary.impulses, expected["impulses"])
    frequencies = [mode["frequency_hz"] for mode in expected["shaped"]]
    numpy.testing.assert_array_equal(summary.frequencies_hz, frequencies)
    if "residual" in expected:
        assert summary.amplitude == expected["residual"]["amplitude_m"] < summary.unshaped_amplitude
        assert summary.deviation == expected["residual"]["deviation_m"] and not summary.slack.any()
    else:
        assert numpy.isnan(summary.amplitude) and numpy.abs(move.feed_forward).max() > 1e-4


def test_a_move_is_an_event_and_what_it_cannot_be_is_refused(cogiro):
    poses = [[-0.1, 0, 2], [0.1, 0, 2]]
    move = cogiro.move(poses, 1.0, feed_forward="cables")
    follow = {"t": 0, "lengths": {"times": move.times, "lengths": move.lengths}}
    moved = cogiro.simulate(poses[0], until=1, events=[follow], rate=200, damping=2e-4)
    assert numpy.abs(moved.poses[:, :3] - move.poses[:, :3]).max() < 1e-3
    assert numpy.abs(moved.tensions - move.tensions).max() < 0.1 * move.tensions.max()
    again = pickle.loads(pickle.dumps(move))
    numpy.testing.assert_array_equal(again.lengths, move.lengths)
    for wrong, words in [
        ({"profile": "linear"}, "profile is \"linear\": expected trapezoid, cosine, polynomial"),
        ({"shaper": "zvdd"}, "expected zv, zvd, ei"),
        ({"feed_forward": "all"}, "expected platform, cables"),
        ({"rate": -1}, "rate is -1"),
        ({"payload": [1, 2]}, "expected one load for the whole move"),
    ]:
        with pytest.raises(cdpr.InputError, match=words):
            cogiro.move(poses, 1.0, **wrong)
    with pytest.raises(cdpr.NoSolutionError, match="too fast"):
        cogiro.move([[-0.5, 0, 2], [0.5, 0, 2]], 0.3, feed_forward="cables")


def test_the_largest_amplitudes_over_a_plane_are_those_of_the_program(cogiro, tmp_path):
    settings = {"band": (1.0, 4.0), "damping": 1e-3, "drag": 0.5, "marker": [0.1, 0, -0.3]}
    found = cogiro.workspace(x=(-1, 1, 2), y=0, z=(1.5, 2, 2), payload=20, **settings)
    (tmp_path / "robot.json").write_text(cogiro.to_json())
    columns = answer("workspace", tmp_path / "robot.json", "--region=-1:1:2,0,1.5:2:2", "--payload=20",
                     "--with=amplitude=1:4,damping=1e-3,drag=0.5", "--marker=0.1,0,-0.3",
                     "--out", tmp_path / "out")["columns"]
    numpy.testing.assert_array_equal(1e3 * found.amplitude, columns["amplitude_mm_per_n"])
    numpy.testing.assert_array_equal(found.amplitude_frequency, columns["amplitude_at_hz"])
    numpy.testing.assert_array_equal(found.winch_amplitude, columns["winch_mm_per_mm"])
    numpy.testing.assert_array_equal(found.winch_frequency, columns["winch_at_hz"])
    assert found.amplitude_reasons == [None] * 4
    assert numpy.isnan(cogiro.workspace(x=0, y=0, z=2, payload=0).amplitude).all()
    with pytest.raises(cdpr.InputError, match="band is"):
        cogiro.workspace(x=0, y=0, z=2, payload=0, band=(4, 1))


def test_derivatives_of_an_amplitude_are_those_of_the_program(cogiro, tmp_path):
    settings = {"shaken": 3.0, "damping": 1e-3, "drag": 0.5, "marker": [0.1, 0, -0.3]}
    found = cogiro.derivatives([0.5, 0.2, 2], payload=20, **settings)
    (tmp_path / "robot.json").write_text(cogiro.to_json())
    expected = answer("derivatives", tmp_path / "robot.json", "--pose=0.5,0.2,2", "--payload=20",
                      "--with=amplitude=3,damping=1e-3,drag=0.5", "--marker=0.1,0,-0.3")
    theirs = expected["amplitude"]["derivatives_mm_per_n"]
    assert found.inputs[: len(theirs)] == expected["parameters"]
    numpy.testing.assert_array_equal(1e3 * found.amplitude[: len(theirs)], theirs)
    assert numpy.isnan(cogiro.derivatives([0.5, 0.2, 2], payload=20).amplitude).all()
    with pytest.raises(cdpr.InputError, match="frequency is"):
        cogiro.derivatives([0.5, 0.2, 2], payload=20, shaken=-1)
