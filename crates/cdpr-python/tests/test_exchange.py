"""Robots of the library by name, and exported robots in the programs that they are for."""

import subprocess

import numpy as np
import pytest

import cdpr
from conftest import answer, program


def test_a_robot_of_the_library_has_a_name(cogiro):
    assert cdpr.Robot.from_file("cogiro").to_dict() == cogiro.to_dict()
    with pytest.raises(cdpr.InputError, match="near are cogiro"):
        cdpr.Robot.from_file("cogira")


def exported(target, robot, pose, path):
    arguments = ["robot", "export", robot, "--to", target, f"--pose={pose}", "--out", str(path)]
    subprocess.run([program(), *arguments], check=True, capture_output=True)
    return str(path)


@pytest.mark.parametrize(
    ("robot", "pose"),
    [
        ("cogiro", "0.3,-0.2,2"),
        ("caroca", "0.5,0.2,1.75,0.998,0,0,0.0632139"),
        ("nist-robocrane", "0,0,1.5"),
        ("segesta", "0,0,0.5"),
    ],
)
def test_mujoco_stands_at_the_pose_of_the_exported_robot(robot, pose, tmp_path):
    mujoco = pytest.importorskip("mujoco", reason="MuJoCo is not installed")
    model = mujoco.MjModel.from_xml_path(exported("mjcf", robot, pose, tmp_path / "robot.xml"))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    weight = model.body_mass.sum() * 9.81
    assert np.abs(data.qfrc_passive - data.qfrc_bias).max() < 1e-6 * weight
    # From 5 mm beside it, with damping that the export leaves to its user.
    size = np.linalg.norm(model.site_pos[model.site_bodyid > 0], axis=1).max()
    frequency = np.sqrt(model.tendon_stiffness.sum() / model.body_mass.sum())
    model.dof_damping[:3] = model.body_mass.sum() * frequency
    model.dof_damping[3:] = model.body_mass.sum() * frequency * size**2
    model.opt.timestep = min(model.opt.timestep, 0.05 / frequency)
    data.qpos[:3] += [0.003, -0.003, 0.003]
    for _ in range(40_000):
        mujoco.mj_step(model, data)
    assert np.linalg.norm(data.qpos[:3] - model.qpos0[:3]) < 1e-3
    assert np.linalg.norm(data.qpos[3:] - model.qpos0[3:]) < 1e-3


def test_moorpy_finds_the_tensions_of_the_exported_robot(tmp_path, cogiro):
    moorpy = pytest.importorskip("moorpy", reason="MoorPy is not installed")
    system = moorpy.System(exported("moorpy", "cogiro", "0,0,2", tmp_path / "robot.txt"))
    system.initialize()
    theirs = np.array([line.TB for line in system.lineList])
    ours = cogiro.inverse([0, 0, 2])
    # MoorPy closes each line to 1e-4 m.
    cable = cogiro.to_dict()["cable"]
    stiffness = cable["youngs_modulus"] * cable["section"] / np.array(ours.lengths)
    assert (np.abs(theirs - ours.tensions) < 1e-4 * stiffness).all()


def in_moordyn(moordyn, path, steps, every):
    """Poses of the body, and where the anchor points are at first."""
    system = moordyn.Create(path)
    assert moordyn.Init(system, [], []) == 0
    lines = [moordyn.GetLine(system, k + 1) for k in range(moordyn.GetNumberLines(system))]
    anchors = [moordyn.GetLineNodePos(line, moordyn.GetLineN(line)) for line in lines]
    found = [moordyn.GetBodyState(moordyn.GetBody(system, 1))[0]]
    for k in range(steps):
        moordyn.Step(system, [], [], k * every, every)
        found.append(moordyn.GetBodyState(moordyn.GetBody(system, 1))[0])
    moordyn.Close(system)
    return np.array(found), np.array(anchors)


@pytest.mark.parametrize(("name", "pose"), [
    ("cogiro", [0.3, -0.2, 2]), ("caroca", [0.4, 0.3, 1.75]), ("ipanema-1", [0, 0, 1]),
])
def test_an_exported_robot_moves_in_moordyn_as_it_is_simulated(name, pose, tmp_path):
    moordyn = pytest.importorskip("moordyn", reason="MoorDyn is not installed")
    robot = cdpr.Robot.from_file(name)
    turned = cdpr.pose(pose, rpy_deg=[1, -2, 3])
    text = cdpr.exchange.export(robot, turned, "moordyn").text
    (tmp_path / "rest.txt").write_text(text)
    still, anchors = in_moordyn(moordyn, str(tmp_path / "rest.txt"), 10, 0.01)
    rest = robot.direct(robot.inverse(turned).lengths, start=turned)
    np.testing.assert_allclose(anchors, rest.position + robot.anchor_points @ rest.rotation.T, atol=1e-9)
    # A payload that comes: its mass is in the file, the lengths are those without it.
    mass = robot.to_dict()["platform"]["mass"]
    body = next(line for line in text.splitlines() if " Free " in line)
    words = body.split(" ")
    words[8] = str(1.2 * mass)
    (tmp_path / "loaded.txt").write_text(text.replace(body, " ".join(words)))
    theirs, _ = in_moordyn(moordyn, str(tmp_path / "loaded.txt"), 10, 0.01)
    heavier = {**robot.to_dict()}
    if not heavier["platform"].get("inertia"):
        notes = cdpr.exchange.export(robot, turned, "moordyn").notes
        assert any("inertia" in note for note in notes)
        moments = [float(value) for value in words[10].split("|")]
        heavier["platform"] = {**heavier["platform"], "inertia": np.diag(moments).tolist()}
        robot = cdpr.Robot.from_dict(heavier)
    ours = robot.simulate(turned, until=0.1, events=[{"t": 0, "payload": 0.2 * mass}])
    way = np.linalg.norm(ours.poses[:, :3] - turned[:3], axis=1).max()
    apart = np.linalg.norm(ours.poses[:, :3] - theirs[:, :3], axis=1).max()
    settles = np.linalg.norm(still[:, :3] - turned[:3], axis=1).max()
    assert settles < 0.05 * way and apart < 0.05 * way, (name, settles, apart, way)


@pytest.mark.parametrize("target, name, pose", [
    ("moordyn", "caroca", [0, 0, 1.75]),
    ("mjcf", "cogiro", [0, 0, 2]), ("moorpy", "caroca", [0, 0, 1.75]), ("caspr", "ipanema-3", [0, 0, 1.3]),
    ("mjcf", "nist-robocrane", [0, 0, 1.5]),
])
def test_exported_files_are_those_of_the_program(target, name, pose, tmp_path):
    found = cdpr.exchange.export(cdpr.Robot.from_file(name), pose, target)
    exported(target, name, ",".join(map(str, pose)), tmp_path / "robot")
    theirs = {path.name.removeprefix("robot"): path.read_text() for path in tmp_path.iterdir()}
    single = len(found.files) == 1
    assert ({"": found.text} if single else found.files) == theirs and found.text in theirs.values()


def test_a_robot_goes_to_caspr_and_back(tmp_path):
    robot = cdpr.Robot.from_file("ipanema-3")
    for ending, text in cdpr.exchange.export(robot, [0, 0, 1.3], "caspr").files.items():
        (tmp_path / f"robot{ending}").write_text(text)
    again, notes = cdpr.exchange.read(tmp_path, cable="steel-4mm", tension_limits=[10, 2000])
    np.testing.assert_allclose(again.exit_points, robot.exit_points, atol=1e-9)
    np.testing.assert_allclose(again.anchor_points, robot.anchor_points, atol=1e-9)
    assert again.mass == pytest.approx(robot.mass) and list(again.tension_limits) == [10, 2000]
    assert {note.kind for note in notes} <= {"assumed", "questioned", "no place for"}
    for call, said in (
        (lambda: cdpr.exchange.export(robot, [0, 0, 1.3], "urdf"), 'to is "urdf": expected one of mjcf, caspr'),
        (lambda: cdpr.exchange.read(tmp_path, cable="steel-400mm", tension_limits=[1, 2]), "steel-400mm"),
        (lambda: cdpr.exchange.read(tmp_path, tension_limits=[1, 2, 3]), "tension_limits has the shape"),
    ):
        with pytest.raises((cdpr.InputError, cdpr.FileError), match=said):
            call()
    with pytest.raises(cdpr.NoSolutionError):
        cdpr.exchange.export(cdpr.Robot.from_file("cogiro"), [0, 0, 50], "mjcf")
    with pytest.raises(cdpr.FileError, match="expected a folder with the XML files"):
        (tmp_path / "empty").mkdir()
        cdpr.exchange.read(tmp_path / "empty")


def test_a_robot_goes_to_mujoco_and_moorpy_and_back(tmp_path, cogiro):
    for target, limits in (("mjcf", None), ("moorpy", list(cogiro.tension_limits))):
        file = tmp_path / f"robot.{target}"
        file.write_text(cdpr.exchange.export(cogiro, [0, 0, 2], target).text)
        again, notes = cdpr.exchange.read(file, tension_limits=limits)
        assert (again.exit_points == cogiro.exit_points).all() and (again.anchor_points == cogiro.anchor_points).all()
        assert again.mass == cogiro.mass and "questioned" not in {note.kind for note in notes}
        np.testing.assert_allclose(again.inverse([0, 0, 2]).lengths, cogiro.inverse([0, 0, 2]).lengths, rtol=1e-12)


def test_the_library_is_that_of_the_program():
    listed = answer("robot", "list")
    names = {kind: [entry["name"] for entry in listed if entry["kind"] == kind] for kind in ("robot", "cable")}
    assert names == {"robot": cdpr.exchange.robots(), "cable": cdpr.exchange.cables()}
