"""Calibrations give the files of `cdpr calibrate fit`, and plans the poses of `cdpr calibrate plan`."""

import json
import os
import subprocess
import sys
from pathlib import Path

import cdpr
import numpy
import pytest
from conftest import answer, command, program

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
    arguments = ["--poses", poses, "--uncertainty", model, "--noise", noise, "--seed", "2", "--out", path]
    done = command("calibrate", "simulate", caroca_file, *arguments)
    assert done.returncode == 0, done.stderr
    lines = path.read_text().splitlines()
    path.write_text("\n".join([lines[0], *lines[1::9]]) + "\n")
    return path


def test_files_are_those_of_the_program(caroca, caroca_file, measurements, model, tmp_path):
    ours, theirs = tmp_path / "ours", tmp_path / "theirs"
    found = cdpr.calibration.calibrate(caroca, measurements, ours, uncertainty=model, noise=NOISE)
    summary = found.summary
    noise = ",".join(f"{name}={std}" for name, std in NOISE.items())
    arguments = [measurements, "--uncertainty", model, "--noise", noise, "--out", theirs]
    printed = answer("calibrate", "fit", caroca_file, *arguments)
    assert summary == printed == json.loads((ours / "summary.json").read_text())
    for name in ("calibrated.json", "posterior.json", "residuals.csv", "poses.csv", "report.html"):
        assert (ours / name).read_bytes() == (theirs / name).read_bytes(), name
    robot = cdpr.Robot.from_file(ours / "calibrated.json")
    assert robot.parameters["a1.x"] == summary["parameters"]["a1.x"]["after"]
    assert robot == found.robot and found.posterior == json.loads((ours / "posterior.json").read_text())
    assert found.parameters[:2] == ["mass", "youngs_modulus"] or "a1.x" in found.parameters
    lines = (ours / "residuals.csv").read_text().splitlines()[1:]
    assert found.residuals.after.tolist() == [float(line.split(",")[4]) for line in lines]
    assert found.residuals.columns == [line.split(",")[1] for line in lines]
    lines = (ours / "poses.csv").read_text().splitlines()[1:]
    assert found.poses.tolist() == [[float(cell) for cell in line.split(",")[1:8]] for line in lines]


def test_errors_of_sensors_are_sought(caroca, measurements, model, tmp_path):
    def change(line):
        cells = line.split(",")
        return ",".join([str(float(cells[0]) + 0.25), *cells[1:]])

    lines = Path(measurements).read_text().splitlines()
    moved = tmp_path / "moved.csv"
    moved.write_text("\n".join([lines[0], *map(change, lines[1:])]) + "\n")
    sought = {"uncertainty": model, "noise": NOISE, "unknown": {"length_offset": None}}
    found = cdpr.calibration.calibrate(caroca, moved, **sought)
    offset = found.sensors["length_offset1"]
    assert abs(offset["after"] - 0.25) < 5 * offset["std"] + 1e-6


def test_bounds_hold_and_groups_move_together(caroca, measurements, tmp_path):
    sought = {
        "noise": NOISE,
        "parameters": ["a", "b", "mass"],
        "share": ["b1.z+b2.z"],
        "bounds": {"mass": (-1e-3, 1e-3)},
    }
    found = cdpr.calibration.calibrate(caroca, measurements, **sought).summary["parameters"]
    moved = [found[name]["after"] - found[name]["before"] for name in ("b1.z", "b2.z", "mass")]
    # Differences of masses near 180 kg are rounded.
    assert moved[0] == pytest.approx(moved[1], abs=1e-12) and abs(moved[2]) <= 1e-3 + 1e-12
    sought["share"] = ["b1.z+r1"]
    with pytest.raises(cdpr.InputError, match=r"share is b1.z\+r1: expected parameters that are sought"):
        cdpr.calibration.calibrate(caroca, measurements, tmp_path / "out", **sought)


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
    found = cdpr.calibration.plan(caroca, candidates, count=6, **known)
    assert found.poses.shape == (6, 7) and len(found.growing) == 6
    assert found.quality.information_bits > found.random.information_bits
    told = cdpr.calibration.identify(caroca, found.poses, **known)
    assert told.held == 6 and len(told.remaining) == len(told.inputs)
    bits = sum(0.5 * numpy.log2(1 + of.signal_to_noise**2) for of in told.identifiable)
    assert bits == pytest.approx(found.quality.information_bits, rel=1e-6)
    best = told.identifiable[0]
    assert list(best.weights.values()) == list(best.weight) and f"signal_to_noise {best.signal_to_noise:.4g}" in repr(best)
    assert numpy.sum(best.weight**2) == pytest.approx(1)
    pytest.importorskip("pandas", reason="pandas is not installed")
    assert dict(best.to_dataframe()["weight"]) == best.weights
    arguments = ["--region=-2:2:4,-1:1:3,1:2.5:4", "--number", 6, "--noise", "position=1e-4,rotation=1e-4"]
    theirs = answer(
        "calibrate", "plan", caroca_file, *arguments, "--uncertainty", "a=0.002,b=0.002,youngs_modulus=5e9"
    )
    for name in ("information_bits", "parameters"):
        assert getattr(found.quality, name) == pytest.approx(theirs["plan"][name], rel=1e-9)
    assert found.poses == pytest.approx(numpy.array(theirs["poses"]), abs=1e-12)
    with pytest.raises(cdpr.InputError, match="work has no pose"):
        cdpr.calibration.plan(caroca, candidates, criterion="mean-at-work", **known)


def test_readings_of_pulleys_are_a_frame_and_a_figure():
    robot = cdpr.Robot.from_file("expo2015-lucia")
    cycle = cdpr.assess.hysteresis(robot, [0, 0, 2], 50, friction=0.05, steps=10)
    table = {f"t{i + 1}_winch_n": cycle.winch_tensions[:, i] for i in range(8)}
    found = cdpr.calibration.calibrate_pulleys(robot, {**table, "payload_kg": cycle.payloads}, [0, 0, 2])
    pytest.importorskip("pandas", reason="pandas is not installed")
    frame = found.to_dataframe()
    assert list(frame.columns) == ["line", "cable", "platform_n", "measured_n", "modelled_n", "slip"]
    assert list(frame["measured_n"]) == list(found.readings["measured_n"])
    pytest.importorskip("matplotlib", reason="matplotlib is not installed").use("svg")
    measured, modelled = found.plot().axes[0].lines
    for line, name in ((measured, "measured_n"), (modelled, "modelled_n")):
        numpy.testing.assert_array_equal(line.get_ydata(), frame[name] - frame["platform_n"])


def test_plans_take_laws_as_the_program_does(caroca, caroca_file, candidates, tmp_path):
    laws = {
        "a": {"law": {"uniform": {"min": -0.003, "max": 0.003}}},
        "mass": {"law": {"uniform": {"min": -1.5, "max": 1.5}}, "steps": {"nearest": {"step": 1.5}}},
    }
    model = tmp_path / "model.json"
    model.write_text(json.dumps(laws))
    noise = {"position": 1e-4, "rotation": 1e-4}
    found = [
        cdpr.calibration.plan(caroca, candidates, count=4, uncertainty=given, noise=noise) for given in (laws, model)
    ]
    assert found[0].content == found[1].content
    arguments = ["--region=-2:2:4,-1:1:3,1:2.5:4", "--number", 4, "--noise", "position=1e-4,rotation=1e-4"]
    theirs = answer("calibrate", "plan", caroca_file, *arguments, "--uncertainty", model)
    assert found[0].quality.information_bits == pytest.approx(theirs["plan"]["information_bits"], rel=1e-9)
    told = cdpr.calibration.identify(caroca, found[0].poses, uncertainty=laws, noise=noise)
    assert "mass" in told.inputs and told.held == 4
    with pytest.raises(cdpr.InputError, match="uniform"):
        cdpr.calibration.identify(caroca, found[0].poses, uncertainty={"a": {"law": {"even": {}}}}, noise=noise)


def test_irma4u_is_read_as_its_authors_write_it(data, tmp_path):
    """A simulated campaign in the form of the authors' files."""
    grid, measured = tmp_path / "poses.csv", tmp_path / "measured.csv"
    places = [(x, y, z) for x in (-0.4, 0.0, 0.4) for y in (-0.4, 0.0, 0.4) for z in (0.6, 0.9, 1.2)]
    grid.write_text("\n".join(["x_m,y_m,z_m", *[",".join(map(str, place)) for place in places]]) + "\n")
    model = tmp_path / "model.json"
    model.write_text('{"mass": {"law": {"normal": {"mean": 0, "std": 1e-6}}}}')
    noise = "position=1e-9,rotation=7e-3,length=1e-4,tension=7"
    robot = json.loads((data / "robots" / "irma4u.json").read_text())
    random = numpy.random.default_rng(1)
    arguments = [
        "--poses",
        grid,
        "--free",
        "roll,pitch",
        "--with",
        "winch-cells",
        "--seed",
        "1",
        "--uncertainty",
        model,
    ]
    arguments += ["--noise", noise, "--unknown", "length_offset=0.01", "--out", measured]
    done = command("calibrate", "simulate", str(data / "robots" / "irma4u.json"), *arguments)
    assert done.returncode == 0, done.stderr
    rows = [
        dict(zip(lines[0], cells))
        for lines in [[line.split(",") for line in measured.read_text().splitlines()]]
        for cells in lines[1:]
    ]
    theirs = []
    for row in rows:
        w, x, y, z = (float(row[name]) for name in ("qw", "qx", "qy", "qz"))
        # R = Rz(yaw) Ry(pitch) Rx(roll)
        angles = [
            numpy.arctan2(2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
            numpy.arcsin(2 * (w * y - x * z)),
            numpy.arctan2(2 * (x * y + w * z), 1 - 2 * (y * y + z * z)),
        ]
        lengths, tensions = (
            [float(row[f"{name}{i}{unit}"]) for i in range(1, 5)]
            for name, unit in (("l", "_m"), ("t", "_winch_n"))
        )
        # The pulleys swivel about ±x: from y (times the sign) towards z, and the authors count from there on.
        turn = numpy.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
            ]
        )
        place = [float(row[name]) for name in ("x_m", "y_m", "z_m")]
        swivels = []
        for cable in robot["cables"]:
            along = place + turn @ cable["anchor_point"] - cable["exit_point"]
            angle = numpy.arctan2(along[2], cable["pulley"]["axis"][0] * along[1])
            swivels.append(angle + numpy.pi / 2 + 2e-2 * random.standard_normal())
        theirs.append([*lengths, *tensions, *angles, *swivels])
    table = numpy.array(theirs)
    names = [f"{letter}{i}" for letter in "lt" for i in range(1, 5)] + ["roll", "pitch", "yaw"]
    names += [f"s{i}" for i in range(1, 5)]
    numpy.savetxt(
        tmp_path / "campaign.csv", table, delimiter=",", header=",".join(names), comments="", fmt="%.17g"
    )
    files = [tmp_path / "campaign.csv"]
    try:
        from scipy.io import savemat
    except ImportError:
        pass
    else:
        parts = {
            "cable_length_meas": table[:, :4].T,
            "tau_zero": table[0, 4:8],
            "loadcell_meas": table[1:, 4:8].T,
        }
        parts |= {"epsilon_meas": table[:, 8:11].T, "swivel_meas": table[:, 11:].T}
        savemat(tmp_path / "campaign.mat", parts)
        files.append(tmp_path / "campaign.mat")
    script = data / "reference" / "irma4u.py"
    answers = []
    for file in files:
        done = subprocess.run(
            [sys.executable, script, file],
            capture_output=True,
            text=True,
            env={**os.environ, "CDPR": program()},
            check=False,
        )
        assert done.returncode == 0, done.stderr
        answers.append(done.stdout.replace(file.name, ""))
    assert all(of == answers[0] for of in answers)
    after = {
        line.split()[0]: float(line.split()[-2]) for line in answers[0].splitlines() if " numbers, " in line
    }
    # The last fit weighs as the authors do; the noise is that of the sensors in both.
    for name, unit, std in (("t", 1, 7), ("roll", 57.3, 7e-3), ("swivel", 57.3, 2e-2)):
        assert 0.5 * unit * std < after[name] < 1.3 * unit * std, answers[0]


@pytest.mark.parametrize("name, free", [("caroca", None), ("cogiro", None), ("four-cables", ["roll", "pitch"])])
def test_a_simulated_campaign_is_that_of_the_program(name, free, tmp_path):
    robot = cdpr.Robot.from_file(name)
    model = tmp_path / "model.json"
    law = {"law": {"normal": {"mean": 0.0, "std": 0.002}}}
    model.write_text(json.dumps({"a": law, "mass": law}))
    poses = [[x, 0.1, 1.75] for x in (0.0, 0.1, 0.2)]
    candidates = tmp_path / "poses.csv"
    candidates.write_text("\n".join(",".join(map(str, pose)) for pose in poses))
    more = [] if free is None else ["--free", ",".join(free)]
    done = command("calibrate", "simulate", name, "--poses", candidates, "--uncertainty", model, "--seed", "3",
                   "--noise", "position=1e-4,length=1e-4", "--unknown", "length_offset=0.01",
                   "--out", tmp_path / "theirs.csv", "--truth", tmp_path / "truth.json", *more)
    assert done.returncode == 0, done.stderr
    campaign = cdpr.calibration.simulate(
        robot, poses, tmp_path / "ours.csv", uncertainty=model, noise={"position": 1e-4, "length": 1e-4},
        unknown={"length_offset": 0.01}, free=free, seed=3,
    )
    assert (tmp_path / "ours.csv").read_bytes() == (tmp_path / "theirs.csv").read_bytes()
    assert campaign.robot.to_dict() == cdpr.Robot.from_file(tmp_path / "truth.json").to_dict()
    with pytest.raises(cdpr.InputError, match='tension_at is "x": expected platform or winch'):
        cdpr.calibration.simulate(robot, poses, uncertainty=model, noise={}, tension_at="x")


def test_a_calibration_needs_no_files(caroca, measurements, model, data, tmp_path, monkeypatch):
    """Measurements as a dictionary of arrays or a DataFrame and tolerances as a dictionary."""
    header, *lines = [line.split(",") for line in Path(measurements).read_text().splitlines()]
    columns = dict(zip(header, numpy.array(lines, dtype=float).T))
    tolerances = json.loads(Path(model).read_text())
    expected = cdpr.calibration.calibrate(caroca, measurements, uncertainty=model, noise=NOISE)
    monkeypatch.chdir(tmp_path)
    tables = [columns]
    try:
        import pandas
    except ImportError:
        pass
    else:
        tables.append(pandas.DataFrame({**columns, "operator": ["me"] * len(lines)}))
    for table in tables:
        found = cdpr.calibration.calibrate(caroca, table, uncertainty=tolerances, noise=NOISE)
        assert found.summary == expected.summary and found.posterior == expected.posterior
        numpy.testing.assert_array_equal(found.robot.anchor_points, expected.robot.anchor_points)
    assert list(tmp_path.iterdir()) == []
    again = cdpr.calibration.calibrate(found.robot, columns, uncertainty=found.posterior, noise=NOISE)
    assert again.parameters == found.parameters
    for wrong, words in (
        ({"l1_m": [1.0, 2.0], "l2_m": [1.0]}, "measurements: l2_m has 1 rows: expected 2 rows, as l1_m"),
        ({"l1_m": [[1.0]]}, r"measurements: l1_m has the shape \(1, 1\): expected \(m,\)"),
        ({"l1_x": [1.0]}, "l1_x"),
        (3, "measurements is of the type int: expected the path of a file, a dictionary of arrays"),
    ):
        with pytest.raises(cdpr.InputError, match=words):
            cdpr.calibration.calibrate(caroca, wrong, noise=NOISE)
    with pytest.raises(cdpr.InputError, match="uncertainty: .*nonsense"):
        cdpr.calibration.calibrate(caroca, columns, uncertainty={"nonsense": {"law": {"normal": {"mean": 0, "std": 1}}}})


@pytest.mark.parametrize("name, free", [("cogiro", None), ("four-cables", ["roll", "pitch"]), ("ipanema-3", None)])
def test_a_simulated_campaign_in_memory_leads_back_to_the_true_robot(name, free):
    robot = cdpr.Robot.from_file(name)
    middle = robot.exit_points.mean(axis=0)
    height = robot.exit_points[:, 2].max()
    poses = [[*(middle[:2] + [x, y]), z * height] for x in (-0.3, 0, 0.3) for y in (-0.2, 0.2) for z in (0.4, 0.5)]
    tolerances = {"a": {"law": {"normal": {"mean": 0.0, "std": 0.001}}}}
    noise = {"position": 1e-6, "rotation": 1e-6, "length": 1e-6}
    campaign = cdpr.calibration.simulate(robot, poses, uncertainty=tolerances, noise=noise, free=free)
    assert len({len(column) for column in campaign.measurements.values()}) == 1
    found = cdpr.calibration.calibrate(robot, campaign.measurements, uncertainty=tolerances, noise=noise)
    before = abs(robot.anchor_points - campaign.robot.anchor_points).max()
    assert abs(found.robot.anchor_points - campaign.robot.anchor_points).max() < 0.5 * before
