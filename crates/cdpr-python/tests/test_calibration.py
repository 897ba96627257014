"""Calibrations give the files of `cdpr calibrate`, and plans the poses of `cdpr calibration plan`."""

import json
from pathlib import Path

import numpy
import pytest
from conftest import answer, command

import cdpr

NOISE = {"position": 1e-4, "rotation": 1e-4, "length": 1e-4}


@pytest.fixture(scope="module")
def model(data):
    return str(data / "calibration" / "caroca-tolerances.json")


@pytest.fixture(scope="module")
def candidates():
    axes = numpy.linspace(-2, 2, 4), numpy.linspace(-1, 1, 3), numpy.linspace(1, 2.5, 4)
    return numpy.stack([axis.ravel() for axis in numpy.meshgrid(*axes, indexing="ij")], axis=1)


@pytest.fixture(scope="module")
def measurements(data, model, caroca_file, tmp_path_factory):
    path = tmp_path_factory.mktemp("campaign") / "measurements.csv"
    poses = str(data / "calibration" / "caroca-candidates.csv")
    noise = ",".join(f"{name}={std}" for name, std in NOISE.items())
    arguments = ["--poses", poses, "--model", model, "--noise", noise, "--seed", "2", "--out", path]
    done = command("calibration", "simulate", caroca_file, *arguments)
    assert done.returncode == 0, done.stderr
    lines = path.read_text().splitlines()
    path.write_text("\n".join([lines[0], *lines[1::9]]) + "\n")
    return path


def test_files_are_those_of_the_program(caroca, caroca_file, measurements, model, tmp_path):
    ours, theirs = tmp_path / "ours", tmp_path / "theirs"
    summary = cdpr.calibration.calibrate(caroca, measurements, ours, model=model, noise=NOISE)
    noise = ",".join(f"{name}={std}" for name, std in NOISE.items())
    arguments = ["--measurements", measurements, "--model", model, "--noise", noise, "--out", theirs]
    printed = answer("calibrate", caroca_file, *arguments)
    assert summary == printed == json.loads((ours / "summary.json").read_text())
    for name in ("calibrated.json", "posterior.json", "residuals.csv", "report.html"):
        assert (ours / name).read_bytes() == (theirs / name).read_bytes(), name
    robot = cdpr.Robot.from_file(ours / "calibrated.json")
    assert robot.parameters["a1.x"] == summary["parameters"]["a1.x"]["after"]


def test_errors_of_sensors_are_sought(caroca, measurements, model, tmp_path):
    def change(line):
        cells = line.split(",")
        return ",".join([str(float(cells[0]) + 0.25), *cells[1:]])

    lines = Path(measurements).read_text().splitlines()
    moved = tmp_path / "moved.csv"
    moved.write_text("\n".join([lines[0], *map(change, lines[1:])]) + "\n")
    sought = {"model": model, "noise": NOISE, "unknown": {"length_offset": None}}
    found = cdpr.calibration.calibrate(caroca, moved, tmp_path / "out", **sought)
    offset = found["sensors"]["length_offset1"]
    assert abs(offset["after"] - 0.25) < 5 * offset["std"] + 1e-6


def test_what_is_wrong_is_named(caroca, measurements, tmp_path):
    lines = Path(measurements).read_text().splitlines()
    wrong = tmp_path / "wrong.csv"
    wrong.write_text("\n".join([lines[0], lines[1].replace(lines[1].split(",")[2], "nan", 1)]) + "\n")
    with pytest.raises(cdpr.InputError, match="line 2, column l3_m"):
        cdpr.calibration.calibrate(caroca, wrong, tmp_path / "out", noise=NOISE)
    with pytest.raises(cdpr.InputError, match="error of sensors is drum"):
        cdpr.calibration.calibrate(caroca, measurements, tmp_path / "out", unknown={"drum": None})
    with pytest.raises(cdpr.FileError):
        cdpr.calibration.calibrate(caroca, tmp_path / "nothing.csv", tmp_path / "out", noise=NOISE)


def test_plans_are_those_of_the_program(caroca, caroca_file, candidates):
    noise = {"position": 1e-4, "rotation": 1e-4}
    uncertainty = {"a": 0.002, "b": 0.002, "youngs_modulus": 5e9}
    known = {"uncertainty": uncertainty, "noise": noise}
    found = cdpr.calibration.calibration_plan(caroca, candidates, count=6, **known)
    assert len(found["poses"]) == 6 and len(found["growing"]) == 6
    assert found["plan"]["information_bits"] > found["random"]["information_bits"]
    told = cdpr.calibration.identify(caroca, found["poses"], **known)
    assert told["poses"] == 6
    bits = sum(0.5 * numpy.log2(1 + of["signal_to_noise"] ** 2) for of in told["identifiable"])
    assert bits == pytest.approx(found["plan"]["information_bits"], rel=1e-6)
    arguments = ["--grid=-2:2:4,-1:1:3,1:2.5:4", "--count", 6, "--noise", "position=1e-4,rotation=1e-4"]
    theirs = answer(
        "calibration", "plan", caroca_file, *arguments, "--uncertainty", "a=0.002,b=0.002,youngs_modulus=5e9"
    )
    for name in ("information_bits", "parameters"):
        assert found["plan"][name] == pytest.approx(theirs["plan"][name], rel=1e-9)
    assert numpy.array(found["poses"]) == pytest.approx(numpy.array(theirs["poses"]), abs=1e-12)
    with pytest.raises(cdpr.InputError, match="work has no pose"):
        cdpr.calibration.calibration_plan(caroca, candidates, criterion="mean-at-work", **known)
