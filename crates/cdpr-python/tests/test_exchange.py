"""Robots of the library by name, and exported robots in the programs that they are for."""

import subprocess

import numpy as np
import pytest

import cdpr
from conftest import program


def test_a_robot_of_the_library_has_a_name(cogiro):
    assert cdpr.Robot.from_file("cogiro").to_dict() == cogiro.to_dict()
    with pytest.raises(cdpr.InputError, match="near are cogiro"):
        cdpr.Robot.from_file("cogira")


def exported(target, robot, pose, path):
    arguments = ["export", robot, "--to", target, f"--pose={pose}", "--out", str(path)]
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
