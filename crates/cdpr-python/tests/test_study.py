"""Studies give the files of `cdpr study run`, byte for byte, with any executor and after any interruption."""

import concurrent.futures
import json
import multiprocessing
import os
import signal
import threading
import time
from pathlib import Path

import numpy
import pytest
from conftest import command

import cdpr

#: Three blocks a design: two whole ones and a short one.
OBSERVATIONS = 33_000


@pytest.fixture(scope="session")
def study(data, tmp_path_factory):
    """The mechanical sampling of CAROCA alone, without replicates."""
    file = json.loads((data / "studies" / "caroca.json").read_text())
    file.update(robot=str(data / "robots" / "caroca.json"), replicates=2, bootstrap_resamples=20)
    file["samplings"] = {"mechanical": file["samplings"]["mechanical"]}
    file.update(surfaces={})
    path = tmp_path_factory.mktemp("study") / "mechanical.json"
    path.write_text(json.dumps(file))
    return str(path)


def files(folder):
    """All results by name but those that tell how long it took."""
    varying = ("timings.json", "report.html")
    paths = [path for path in Path(folder).rglob("*") if path.is_file() and path.name not in varying]
    return {str(path.relative_to(folder)): path.read_bytes() for path in paths}


@pytest.fixture(scope="session")
def expected(study, tmp_path_factory):
    """What the command line writes."""
    out = tmp_path_factory.mktemp("expected") / "out"
    done = command("study", "run", study, "--out", out, "--observations", OBSERVATIONS)
    assert done.returncode == 0, done.stderr
    written = files(out)
    assert sum(name.endswith(".block") for name in written) == 9 and "mechanical.svg" in written
    return written


def check(results, expected):
    found = files(results.folder)
    assert sorted(found) == sorted(expected)
    assert [name for name in expected if found[name] != expected[name]] == []
    report = (results.folder / "report.html").read_bytes()
    # The report draws the robot in space.
    drawn = [name for name in expected if name.endswith(".svg") and name != "robot.svg"]
    assert drawn and all(expected[name] in report for name in drawn)


def test_a_run_writes_what_the_command_line_writes(study, expected, tmp_path):
    calls = []
    results = cdpr.study.run(study, tmp_path / "out", observations=OBSERVATIONS, threads=1,
                             progress=lambda done, total: calls.append((done, total)))
    check(results, expected)
    # The verdict takes derivatives at 256 points.
    assert calls == sorted(calls) and calls[-1] == (3 * OBSERVATIONS + 256,) * 2
    assert results.timings["threads"] == 1
    assert results.notes == []
    table = results.observations("mechanical")
    assert table.dtype.isalignedstruct
    lines = (results.folder / "mechanical.csv").read_text().splitlines()
    assert len(lines) == OBSERVATIONS + 1 and lines[0].split(",") == [*table.dtype.names, "reason"]
    for row in (0, 1, 20_000, OBSERVATIONS - 1):
        written = lines[row + 1].split(",")
        assert written[-2] == table["status"][row]
        assert [float(number) for number in written[:-2]] == list(table[row])[:-1]
    assert results.verdict["mechanical"].startswith("Mean deflection ")
    mean = results.summary["studies"]["mechanical"]["magnitude_mm"]["mean"]
    assert abs(numpy.nanmean(table["magnitude_mm"]) - mean) < 1e-12
    pandas = pytest.importorskip("pandas")
    frame = results.to_dataframe("mechanical")
    assert isinstance(frame, pandas.DataFrame) and len(frame) == OBSERVATIONS


def test_a_study_of_frequencies_has_their_names_and_unit(data, tmp_path):
    file = json.loads((data / "studies" / "caroca.json").read_text())
    file.update(robot=str(data / "robots" / "cogiro.json"), output="frequency", replicates=0, bootstrap_resamples=5)
    sampling = {**file["samplings"]["mechanical"], "pose": {"position": [1.0, 0.5, 2.0]}, "observations": 40}
    error_model = {"mass": {"law": {"uniform": {"min": -4.0, "max": 4.0}}}}
    file.update(samplings={"one": {**sampling, "error_model": "mass"}}, error_models={"mass": error_model})
    file.update(surfaces={})
    path = tmp_path / "study.json"
    path.write_text(json.dumps(file))
    results = cdpr.study.run(str(path), tmp_path / "out")
    table = results.observations("one")
    assert table.dtype.names == ("index", "d_mass", "frequency_hz", "status")
    assert abs(table["frequency_hz"].mean() - results.summary["studies"]["one"]["frequency_hz"]["mean"]) < 1e-12
    robot = cdpr.Robot.from_file(str(data / "robots" / "cogiro.json"))
    nominal = results.summary["studies"]["one"]["frequency_hz"]["nominal"]
    assert 0.5 * nominal < robot.modes([1.0, 0.5, 2.0]).frequencies_hz[0] < 2.0 * nominal


def test_a_process_pool_writes_the_same(study, expected, tmp_path):
    calls = []
    # Forked on purpose, after this process has used its own threads.
    cdpr.catenary([1.0, 2.0], 1e6, length=5.0, end=[4.0, 1.0])
    with concurrent.futures.ProcessPoolExecutor(2, multiprocessing.get_context("fork")) as executor:
        results = cdpr.study.run(study, tmp_path / "out", observations=OBSERVATIONS, executor=executor,
                                 progress=lambda *done: calls.append(done))
    check(results, expected)
    assert len(calls) == 10 and calls[-1] == (3 * OBSERVATIONS + 256,) * 2


def test_a_pool_of_multiprocessing_writes_the_same_in_fewer_tasks(study, expected, tmp_path):
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        results = cdpr.study.run(study, tmp_path / "out", observations=OBSERVATIONS, executor=pool, tasks=4)
    check(results, expected)


def test_after_a_killed_worker_a_resumed_run_ends_with_the_same_bytes(study, expected, tmp_path):
    out = tmp_path / "out"
    with concurrent.futures.ProcessPoolExecutor(1) as executor:

        def kill(done, total):
            if done < total:
                for process in executor._processes.values():
                    os.kill(process.pid, signal.SIGKILL)

        with pytest.raises(concurrent.futures.process.BrokenProcessPool):
            cdpr.study.run(study, out, observations=OBSERVATIONS, executor=executor, progress=kill)
    kept = [name for name in files(out) if name.endswith(".block")]
    assert 1 <= len(kept) < 9
    check(cdpr.study.run(study, out, observations=OBSERVATIONS, resume=True), expected)


def test_what_a_callback_raises_ends_a_run_which_then_goes_on(study, expected, tmp_path):
    out = tmp_path / "out"

    def refuse(done, total):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        cdpr.study.run(study, out, observations=OBSERVATIONS, threads=1, progress=refuse)
    assert not (out / "summary.json").exists()
    with pytest.raises(cdpr.FileError, match="resume"):
        cdpr.study.run(study, out, observations=OBSERVATIONS)
    check(cdpr.study.run(study, out, observations=OBSERVATIONS, resume=True), expected)


def test_ctrl_c_ends_a_run(study, tmp_path):
    # A shell's background process ignores it, and so do its children.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        cdpr.study.run(study, tmp_path / "out", observations=5_000_000, table="none")
    assert time.monotonic() - begun < 30


def test_a_study_over_a_grid_of_poses_is_that_of_the_command_line(data, tmp_path):
    file = json.loads((data / "studies" / "caroca-poses.json").read_text())
    file["robot"] = str(data / "robots" / "caroca.json")
    for axis, points in (("x", 5), ("y", 3)):
        file["samplings"]["plane"]["poses"]["grid"][axis]["points"] = points
    study = tmp_path / "plane.json"
    study.write_text(json.dumps(file))
    done = command("study", "run", study, "--out", tmp_path / "expected")
    assert done.returncode == 0, done.stderr
    with concurrent.futures.ProcessPoolExecutor(2) as executor:
        results = cdpr.study.run(study, tmp_path / "out", executor=executor, tasks=4)
    check(results, files(tmp_path / "expected"))
    poses = results.table("plane")
    assert poses.shape == (15,) and poses["sampling"][3] == "plane/0003"
    held = poses["status"] == "held"
    assert numpy.isnan(poses["mean_mm"]).tolist() == (~held).tolist() and 0 < held.sum() < 15
    assert all(poses["reason"][~held]) and not any(poses["reason"][held])
    held = next(name for name in sorted(files(tmp_path / "out")) if name.endswith(".block")).split("/")
    assert len(results.observations("/".join(held[1:3]))) == 500


@pytest.mark.filterwarnings("ignore")
def test_dask_writes_the_same_though_a_worker_is_killed(study, expected, tmp_path):
    distributed = pytest.importorskip("distributed", reason="Dask is not installed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True,
                                  dashboard_address=None) as cluster, distributed.Client(cluster) as client:
        killed = []

        def kill_one(done, total):
            if not killed:
                killed.append(cluster.workers[0].pid)
                os.kill(killed[0], signal.SIGKILL)

        results = cdpr.study.run(study, tmp_path / "out", observations=OBSERVATIONS, executor=client,
                                 progress=kill_one)
    assert killed
    check(results, expected)


@pytest.mark.filterwarnings("ignore")
def test_ray_writes_the_same(study, expected, tmp_path):
    ray = pytest.importorskip("ray", reason="Ray is not installed")
    pools = pytest.importorskip("ray.util.multiprocessing")
    ray.init(num_cpus=2, include_dashboard=False, logging_level="ERROR")
    try:
        with pools.Pool(2) as pool:
            results = cdpr.study.run(study, tmp_path / "out", observations=OBSERVATIONS, executor=pool)
    finally:
        ray.shutdown()
    check(results, expected)


def test_invalid_settings_are_refused_before_anything_is_removed(study, tmp_path):
    out = tmp_path / "out"
    cdpr.study.run(study, out, observations=100)
    before = files(out)
    for arguments, error, start in (
        ({"table": "xlsx"}, cdpr.InputError, "table is xlsx: expected csv or none"),
        ({"threads": 0}, cdpr.InputError, "threads is 0: expected one or more"),
        ({"resume": True, "overwrite": True}, cdpr.InputError, "resume and overwrite are both True"),
        ({"executor": 3}, TypeError, "executor is 3: expected one with"),
        ({"threads": -1}, cdpr.InputError, "threads is -1: expected one or more"),
        ({"tasks": 0}, cdpr.InputError, "tasks is 0: expected one or more"),
        ({"progress": 3}, TypeError, "progress is 3: expected a function"),
        ({"observations": 2}, cdpr.InputError, "observations is 2: expected at least 3"),
        ({"observations": -2}, cdpr.InputError, "observations is -2: expected a whole number from 0"),
    ):
        with pytest.raises(error) as raised:
            cdpr.study.run(study, out, **{"overwrite": True, **arguments})
        assert str(raised.value).startswith(start), str(raised.value)
        assert files(out) == before, arguments


def test_a_folder_that_holds_no_results_is_refused(study, tmp_path):
    with pytest.raises(cdpr.FileError, match="cannot read .*nowhere"):
        cdpr.study.open_results(tmp_path / "nowhere")

    def refuse(done, total):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError):
        cdpr.study.run(study, tmp_path / "begun", observations=OBSERVATIONS, threads=1, progress=refuse)
    begun = cdpr.study.open_results(tmp_path / "begun")
    assert not begun.status()["complete"]
    for read in (lambda: begun.summary, lambda: begun.timings, lambda: begun.table("mechanical")):
        with pytest.raises(cdpr.FileError, match="expected the results of a run that has ended"):
            read()


def test_observations_need_the_blocks_of_their_sampling_alone(study, tmp_path):
    results = cdpr.study.run(study, tmp_path / "out", observations=100)
    assert results.status()["complete"]
    expected = results.observations("mechanical")
    blocks = tmp_path / "out" / "blocks" / "mechanical"
    for block in blocks.glob("replicate*/*.block"):
        block.unlink()
    assert not results.status()["complete"]
    numpy.testing.assert_array_equal(results.observations("mechanical"), expected)
    next(blocks.glob("sampling/*.block")).unlink()
    with pytest.raises(cdpr.FileError, match="lacks 1 of 1 block,"):
        results.observations("mechanical")


def test_the_table_of_a_surface_has_a_row_a_point(data, tmp_path):
    file = json.loads((data / "studies" / "caroca.json").read_text())
    name, surface = next(iter(file["surfaces"].items()))
    surface["x"]["points"], surface["y"]["points"] = 4, 3
    file.update(robot=str(data / "robots" / "caroca.json"))
    file.update(samplings={}, surfaces={name: surface})
    study = tmp_path / "surface.json"
    study.write_text(json.dumps(file))
    table = cdpr.study.run(study, tmp_path / "out").table(name)
    assert table.dtype.names[2:] == ("magnitude_mm", "status") and table.shape == (12,)
    assert set(table["status"]) == {"ok"} and numpy.all(table["magnitude_mm"] > 0)
    assert len(set(table[table.dtype.names[0]])) == 4


def test_a_study_needs_no_files(study, data, tmp_path, monkeypatch):
    """The study as a dictionary, its robot as a path, a robot or a dictionary."""
    content = json.loads(Path(study).read_text())
    robot = cdpr.Robot.from_file(content["robot"])
    expected = cdpr.study.run(study, tmp_path / "out", observations=200)
    names = [file.name for file in tmp_path.iterdir()]
    monkeypatch.chdir(tmp_path)
    for of in (content["robot"], Path(content["robot"]), robot, robot.to_dict()):
        results = cdpr.study.run({**content, "robot": of}, observations=200)
        assert results.summary["studies"] == expected.summary["studies"]
        numpy.testing.assert_array_equal(results.observations("mechanical"), expected.observations("mechanical"))
    assert [file.name for file in tmp_path.iterdir()] == names
    folder = results.folder
    saved = results.save(tmp_path / "saved")
    assert (saved.folder / "report.html").exists() and not (saved.folder / "mechanical.csv").exists()
    del results
    assert not folder.exists() and saved.summary["studies"] == expected.summary["studies"]
    with pytest.raises(cdpr.FileError, match="saved"):
        saved.save(tmp_path / "saved")
    for wrong, start in (
        ({**content, "payload": -1}, "study: payload is -1: expected a finite mass above zero"),
        ({**content, "robot": "cogira"}, "no file and no robot of the library is called `cogira`"),
        (3, "study is of the type int: expected the path of a file, or its content as a dictionary"),
        ({**content, "payload": numpy.nan}, "study cannot be written as JSON"),
    ):
        with pytest.raises(cdpr.InputError) as raised:
            cdpr.study.run(wrong)
        assert str(raised.value).startswith(start), str(raised.value)
    with pytest.raises(cdpr.InputError, match="out is None: expected the folder of the run"):
        cdpr.study.run(content, resume=True)


@pytest.mark.parametrize("name", ["caroca", "cogiro", "four-cables", "ipanema-3"])
def test_the_template_of_a_robot_runs(name):
    study = cdpr.study.template(cdpr.Robot.from_file(name))
    results = cdpr.study.run(study, observations=16)
    assert all(part["observations"] > 0 for part in results.summary["studies"].values())


def test_what_a_calibration_leaves_is_an_error_model_of_a_study(study, caroca):
    content = json.loads(Path(study).read_text())
    posterior = {
        "format": "cdpr-errors/1",
        "parameters": ["a1.x", "a1.y"],
        "mean": [0.0, 0.0],
        "covariance": [[4e-6, 1e-6], [1e-6, 4e-6]],
    }
    sampling = {**content["samplings"]["mechanical"], "error_model": "posterior"}
    content.update(robot=caroca, error_models={"posterior": posterior}, samplings={"after": sampling})
    table = cdpr.study.run(content, observations=64).observations("after")
    assert [name for name in table.dtype.names if name.startswith("d_")] == ["d_posterior_1", "d_posterior_2"]


@pytest.mark.parametrize("name", ["cogiro", "four-cables"])
def test_a_sampling_has_its_statistics_and_the_effect_of_each_parameter(name):
    study = cdpr.study.template(cdpr.Robot.from_file(name))
    results = cdpr.study.run(study, observations=64)
    found, table = results.sampling("all"), results.observations("all")
    values = table[found.output]
    assert found.mean == pytest.approx(numpy.nanmean(values), rel=1e-12) and found.max == numpy.nanmax(values)
    assert found.observations == 64 and sum(found.failed.values()) == numpy.isnan(values).sum()
    assert [f"d_{parameter}" for parameter in found.inputs] == list(table.dtype.names[1 : len(found.inputs) + 1])
    assert found.effect.shape == found.student.shape == (len(found.inputs),)
    assert found.effect_interval.shape == (len(found.inputs), 2) and found.output == "magnitude_mm"
    surface = next(part for part in results.summary["studies"] if part != "all")
    with pytest.raises(cdpr.InputError, match=f"name is '{surface}': expected a sampling with observations, one of all"):
        results.sampling(surface)
    if name == "cogiro":
        assert list(results.table("all_sensitivity")["input"]) == found.inputs


def test_a_study_in_weather_agrees_with_calls_for_each_observation():
    laws = {"wind_speed": {"weibull": {"shape": 2.0, "scale": 8.0}}, "warmer": {"uniform": {"min": 5, "max": 20}},
            "wind_from_deg": {"uniform": {"min": 0, "max": 360}}, "ice": {"uniform": {"min": 0, "max": 0.001}}}
    expansion = {"cable_expansion": 1.2e-5, "frame_expansion": 1e-5}
    study = {
        "format": "cdpr-study/1", "name": "a year", "robot": "cogiro", "weather": expansion, "seed": 1,
        "replicates": 0, "confidence": 0.95, "bootstrap_resamples": 5,
        "error_models": {"year": {name: {"law": law} for name, law in laws.items()}},
        "samplings": {"point": {"title": "Point", "pose": {"position": [0, 0, 2]}, "error_model": "year",
                                "observations": 6}},
    }
    found = cdpr.study.run(study).observations("point")
    robot = cdpr.Robot.from_file("cogiro")
    columns = [numpy.asarray(found[f"d_{name}"]) for name in ("wind_speed", "wind_from_deg", "warmer", "ice")]
    for speed, azimuth, warmer, ice, size in zip(*columns, numpy.asarray(found["magnitude_mm"])):
        towards = numpy.radians(azimuth + 180)
        wind = speed * numpy.array([numpy.cos(towards), numpy.sin(towards), 0])
        alone = robot.in_weather([0, 0, 2], wind, warmer=warmer, ice=ice, **expansion)
        assert size == pytest.approx(1e3 * alone.magnitude, rel=1e-6, abs=1e-5)
    study["weather"] = {"wind_spede": 3}
    with pytest.raises(cdpr.InputError, match="wind_spede"):
        cdpr.study.run(study)
