"""Certificates and assessments, against the program and against what must hold, on robots that differ."""

import json

import numpy
import pytest
from conftest import answer, command, refusal

import cdpr
from cdpr import assess

ROBOTS = {"cogiro": [0, 0, 2], "caroca": [0, 0, 1.75], "ipanema-3": [0, 0, 1.3], "fast": None, "four-cables": None,
          "copacabana-handling": None}


@pytest.mark.parametrize("name", ROBOTS)
def test_findings_are_those_of_the_program(name):
    done = command("robot", "check", name, "--format", "json")
    theirs = json.loads(done.stdout)
    ours = assess.check(cdpr.Robot.from_file(name))
    assert [finding._asdict() for finding in ours] == theirs
    assert assess.check(name) == ours
    assert (done.returncode == 3) == any(finding.severity == "warning" for finding in ours)


def test_a_file_in_other_units_is_checked_all_the_same(caroca, tmp_path):
    content = caroca.to_dict()
    content["cable"]["youngs_modulus"] = 100.0  # GPa
    path = tmp_path / "robot.json"
    path.write_text(json.dumps(content))
    with pytest.raises(cdpr.InputError):
        cdpr.Robot.from_file(path)
    warned = [finding.field for finding in assess.check(path) if finding.severity == "warning"]
    assert "cable.youngs_modulus" in warned
    with pytest.raises(cdpr.FileError):
        assess.check(tmp_path / "none.json")


@pytest.mark.parametrize("name", ["cogiro", "caroca"])
def test_certificates_are_those_of_the_program(name):
    robot = cdpr.Robot.from_file(name)
    lengths = robot.inverse(ROBOTS[name]).lengths
    given = ",".join(map(repr, lengths.tolist()))
    theirs = answer("direct", name, "--lengths", given, "--payload", "2", "--with", "certificate")["certificate"]
    found = robot.certify(lengths, payload=2)
    for field, unit in [("position", "_m"), ("rotation", "_rad"), ("force", "_n"), ("least_stiffness", "_n_per_m"),
                        ("stable", "")]:
        assert getattr(found, field) == theirs[field + unit]
    numpy.testing.assert_array_equal(found.pose, robot.direct(lengths, payload=2).pose)
    both = robot.certify([lengths, lengths + 1e-4], payload=2)
    assert both.position.shape == (2,) and both.position[0] == found.position and both.stable.all()
    assert both.reasons == [None, None]


def test_what_cannot_be_certified_says_why():
    robot = cdpr.Robot.from_file("ipanema-3")  # with pulleys
    lengths = robot.inverse([0, 0, 1.3]).lengths
    with pytest.raises(cdpr.NoSolutionError, match="certificates are for plain cables") as raised:
        robot.certify(lengths)
    found = robot.certify([lengths, lengths])
    assert numpy.isnan(found.position).all() and found.kinds == [raised.value.kind] * 2


def test_a_budget_of_tolerances_is_that_of_the_program(data):
    pytest.importorskip("pandas", reason="pandas is not installed")
    study = data / "studies" / "caroca.json"
    theirs = answer("study", "tolerances", study, "--sampling", "mechanical", "--limit", "deflection_mm<1.4", "--observations", "1000",
                    "--costs", "mass=2")
    ours = assess.tolerances(study, "mechanical", 1.4, observations=1000, costs={"mass": 2})
    assert ours.content == theirs
    assert ours.names == [tolerance["name"] for tolerance in theirs["tolerances"]]
    assert ours.tightened["within"]["value"] >= 0.9 and "limit_mm 1.4" in repr(ours)
    assert list(ours.to_dataframe().index) == ours.names
    for call, said in (
        (lambda: assess.tolerances(study, "none", 1.4), "none"),
        (lambda: assess.tolerances(study, "mechanical", -1.0), "limit"),
        (lambda: assess.tolerances(study, "mechanical", 1.4, of="x"), "of is \"x\": expected deflection or position"),
        (lambda: assess.tolerances(study, "mechanical", 1.4, costs={"zzz": 1}), "zzz"),
    ):
        with pytest.raises(cdpr.InputError, match=said):
            call()
    with pytest.raises(cdpr.InputError, match="expected one that tolerances reach"):
        assess.tolerances(study, "mechanical", 1.0, observations=1000)


def test_prices_of_a_study_buy_tolerances_and_calibrations(data):
    study = json.loads((data / "studies" / "caroca.json").read_text())
    study["robot"] = cdpr.Robot.from_file("caroca")

    def budget(prices, limit_mm):
        priced = {**study, "prices": prices}
        return assess.tolerances(priced, "geometrical", limit_mm, of="position", observations=200)

    prices = {"b": {"grades": [{"std": 0.01, "cost": 10}]}, "survey": {"cost": 30, "leaves": {"b": 0.0025}}}
    wide = budget(prices, 1000.0)
    assert not wide.calibrations[0]["bought"] and wide.calibrations[0]["saves"] == -30
    assert (wide.cost_then == 0).all() and numpy.isnan(wide.mm_per_cost).all()
    now = wide.now["quantile_mm"]["value"]
    assert budget(prices, 0.97 * now).cost_then.sum() == 10
    tight = budget({"b": {"cost": 5, "power": 2}}, 0.8 * now)
    assert tight.names[0] == "b" and tight.mm_per_cost[0] > 0
    assert abs(tight.cost_then[0] - 5 / tight.factor[0] ** 2) < 1e-9
    with pytest.raises(cdpr.InputError, match="prices.z is z: expected an entry of an error model"):
        budget({"z": {"cost": 1}}, 1000.0)


@pytest.mark.parametrize("name, free", [("cogiro", None), ("four-cables", ["roll", "pitch"])])
def test_robustness_is_the_same_again_and_its_counts_add_up(name, free, tmp_path):
    robot, calls = cdpr.Robot.from_file(name), []
    ours = assess.robustness(
        robot, poses=5, free=free, out=tmp_path / "ours", progress=lambda done, of: calls.append(done)
    )

    def untimed(content):
        """Without times, which differ from run to run."""
        if isinstance(content, dict):
            return {key: untimed(value) for key, value in content.items() if key != "microseconds"}
        return [untimed(value) for value in content] if isinstance(content, list) else content

    again = assess.robustness(robot, poses=5, free=free)
    assert untimed(ours.content) == untimed(again.content)
    assert untimed(ours.content) == untimed(json.loads((tmp_path / "ours" / "robustness.json").read_text()))
    found, all = ours.found("thirty_poses")
    assert all == 60 and f"thirty_poses {found} of 60" in repr(ours)
    assert calls == sorted(calls)
    for call, said in (
        (lambda: assess.robustness(robot, poses=0), "poses is 0"),
        (lambda: assess.robustness(robot, poses=5, modulus=-1.0), "youngs_modulus is -1"),
        (lambda: assess.robustness(robot, poses=5, free=["u"]), "u"),
    ):
        with pytest.raises(cdpr.InputError, match=said):
            call()


def test_friction_of_pulleys_is_that_of_the_program_and_is_found_again(data):
    file = data / "reference" / "robots" / "suspended-leads.json"
    theirs = answer("hysteresis", file, "--pose", "0,0,1.5", "--payload", "40",
                    "--with", "steps=10,friction=0.05,bearing=0.01")
    robot = cdpr.Robot.from_file(file)
    ours = assess.hysteresis(robot, [0, 0, 1.5], 40, steps=10, friction=0.05, bearing=0.01)
    numpy.testing.assert_allclose(1e3 * ours.residual, theirs["residual_mm"], rtol=1e-12, atol=1e-15)
    assert 1e3 * ours.gap == pytest.approx(theirs["pulleys"]["gap_mm"])
    winches = [at["winch_tension_n"] for at in theirs["pulleys"]["cables"]]
    numpy.testing.assert_array_equal(ours.winch_tensions[[0, 10, -1]].T, winches)
    assert ours.slips.shape == ours.wraps.shape == ours.leave_tensions.shape == (22, 8)
    fit = assess.pulley_friction(ours.wraps, ours.leave_tensions, ours.winch_tensions, ours.slips)
    if fit.friction is None:
        assert fit.bearing is None and "is not identifiable" in repr(fit)
    one, other = fit.combination
    assert fit.combined[0] == pytest.approx(0.05 * one + 0.01 * other, rel=0.02)
    wraps = numpy.tile([0.5, 1.5, 2.5], 20)
    slips = numpy.where(numpy.arange(60) % 2, 1.0, -1.0)
    grown = numpy.exp(0.05 * slips * wraps)
    square = 1 + grown**2 - 2 * grown * numpy.cos(wraps) - (0.01 * numpy.sin(wraps)) ** 2
    ratio = (grown - 1e-4 * numpy.cos(wraps) + 0.01 * slips * numpy.sqrt(square)) / (1 - 1e-4)
    fit = assess.pulley_friction(wraps, 500 + 0 * wraps, 500 * ratio, slips)
    assert fit.friction[0] == pytest.approx(0.05, abs=1e-9)
    assert fit.bearing[0] == pytest.approx(0.01, abs=1e-9)
    assert "friction 0.0" in repr(fit)
    elastic = assess.hysteresis(cdpr.Robot.from_file("caroca-law"), [0, 0, 1.75], 50, steps=2)
    assert elastic.winch_tensions is None and elastic.gap < 1e-9
    for call, said in (
        (lambda: assess.hysteresis(cdpr.Robot.from_file("caroca"), [0, 0, 1.75], 5, friction=0.1), "without pulleys"),
        (lambda: assess.hysteresis(robot, [0, 0, 1.5], 5, bearing=-1.0), "bearing is -1"),
        (lambda: assess.pulley_friction([1.0], [1.0, 2.0], [1.0], [1.0]), "tensions has 2 values"),
        (lambda: assess.pulley_friction([1.0], [1.0], [1.0], [1.0]), "readings"),
    ):
        with pytest.raises(cdpr.InputError, match=said):
            call()


def test_a_load_cycle_is_that_of_the_program(caroca, caroca_file, data):
    record = data / "cables" / "caroca-4mm-record.csv"
    theirs = answer("hysteresis", caroca_file, "--law", record, "--length", "1", "--pose", "0,0,1.75",
                    "--payload", "50")
    ours = assess.hysteresis(caroca, [0, 0, 1.75], 50, record=record, length=1)
    numpy.testing.assert_allclose(1e3 * ours.deflection, theirs["deflection_mm"], rtol=1e-12, atol=1e-15)
    numpy.testing.assert_allclose(1e3 * ours.residual, theirs["residual_mm"], rtol=1e-12, atol=1e-15)
    assert ours.payload_work == theirs["payload_work_j"]
    numpy.testing.assert_array_equal(ours.dissipated, [cable["dissipated_j"] for cable in theirs["cables"]])
    assert ours.middle_tensions[0, 1] == theirs["cables"][0]["tension_payload_n"]
    # The work of the payload is the area of the loop of payload and height.
    way = 9.81 * numpy.trapezoid(ours.payloads, -ours.positions[:, 2])
    assert ours.payload_work == pytest.approx(way, rel=1e-3)
    assert ours.payloads.max() == 50 and ours.tensions.shape == (len(ours.payloads), 8)
    assert "50 kg" in repr(ours)
    law = data / "cables" / "caroca-4mm-law.json"
    assert assess.hysteresis(caroca, [0, 0, 1.75], 50, law=law).payload_work > 0
    own = assess.hysteresis(cdpr.Robot.from_file(data / "robots" / "caroca-law.json"), [0, 0, 1.75], 50)
    assert abs(own.payload_work) < 1e-6 * 50 * 9.81 and numpy.allclose(own.residual, 0, atol=1e-9)
    for call, said in (
        (lambda: assess.hysteresis(caroca, [0, 0, 1.75], 50), "no cable of the robot has a law"),
        (lambda: assess.hysteresis(caroca, [0, 0, 1.75], 50, record=record), "length is None"),
        (lambda: assess.hysteresis(caroca, [0, 0, 1.75], 50, record=record, law=law, length=1), "both given"),
        (lambda: assess.hysteresis(caroca, [0, 0, 1.75], -5, law=law), "payload is -5"),
        (lambda: assess.hysteresis(caroca, [[0, 0, 1.75]] * 2, 5, law=law), "pose has 2 rows"),
        (lambda: assess.hysteresis(caroca, [0, 0, 1.75], 5, law=law, unloading="x"), "unloading is \"x\""),
    ):
        with pytest.raises(cdpr.InputError, match=said):
            call()


def test_moduli_of_a_record_and_a_weighing_are_those_of_the_program(data):
    record = data / "cables" / "caroca-4mm-record.csv"
    theirs = answer("cable", "modulus", record, "--breaking-force", "10290", "--section", "1.2566370614e-5", "--length", "1",
                    "--range", "5-10", "--range", "10-30")
    known = {"length": 1, "section": 1.2566370614e-5, "breaking_force": 10290}
    ours = assess.modulus(record, **known, ranges=[(5, 10), (10, 30)])
    for phase in ("loading", "unloading"):
        expected = [found[phase]["modulus_gpa"] for found in theirs["ranges"]]
        numpy.testing.assert_allclose(1e-9 * getattr(ours, phase), expected, rtol=1e-12)
        expected = [found[phase]["greatest_uncertainty_gpa"] for found in theirs["ranges"]]
        numpy.testing.assert_allclose(1e-9 * getattr(ours, f"{phase}_greatest"), expected, rtol=1e-12)
    assert ours.dissipated == theirs["dissipated_energy_j"] and "10-30 %" in repr(ours)
    with pytest.raises(cdpr.InputError, match="length"):
        assess.modulus(record, **{**known, "length": 0}, ranges=[(5, 10)])
    weighed = answer("cable", "density", "--mass", "0.203", "--length", "2", "--errors", "mass=0.001,length=0.001")
    assert assess.linear_density(0.203, 2, mass_error=0.001, length_error=0.001) == (
        weighed["linear_density_kg_per_m"], weighed["error_kg_per_m"]
    )
    with pytest.raises(cdpr.InputError, match="mass = -1|mass is -1"):
        assess.linear_density(-1, 2)


@pytest.mark.parametrize("name, more", [
    ("caroca", {"a": 0.002, "mass": 0.5}), ("cogiro", {"b": 0.005}), ("segesta", None), ("ipanema-3", {"a": 0.001}),
])
def test_a_path_is_that_of_the_program(name, more, tmp_path):
    robot = cdpr.Robot.from_file(name)
    middle = {"segesta": 0.5, "ipanema-3": 1.3}.get(name, 1.75)
    poses = [[x, 0.02, middle] for x in (0.0, 0.05, 0.1)] + [[80.0, 0, middle], [0.1, 0.0, middle]]
    file = tmp_path / "poses.csv"
    file.write_text("\n".join(",".join(map(str, pose)) for pose in poses))
    given = [] if more is None else ["--uncertainty", ",".join(f"{key}={value}" for key, value in more.items())]
    done = command("path", name, "--poses", file, "--payload", "5", *given, "--format", "json")
    theirs = [json.loads(line) for line in done.stdout.splitlines()]
    ours = robot.path(poses, payload=5, uncertainty=more)
    assert ours.kinds == [pose.get("error", {}).get("kind") for pose in theirs]
    assert ours.kinds[:3] + ours.kinds[4:] == [None] * 4 and ours.kinds[3] is not None
    for k, pose in enumerate(theirs):
        if "error" in pose:
            assert numpy.isnan(ours.lengths[k]).all()
            continue
        for field in ("jump", "lengths", "tensions", "exit_tensions", "sags"):
            numpy.testing.assert_array_equal(getattr(ours, field)[k], pose[field])
        assert ours.least_stiffness[k] == pose["least_stiffness_n_per_m"]
        assert 1e3 * ours.magnitude[k] == pytest.approx(pose["magnitude_mm"], rel=1e-12)
        slack = [cable + 1 for cable in numpy.flatnonzero(ours.loaded.slack[k])]
        assert slack == pose["slack_cables"]
        if more is not None:
            for field, name, factor in [
                ("lengths", "lengths", 1), ("tensions", "tensions", 1), ("displacement", "deflection_mm", 1e3),
                ("magnitude", "magnitude_mm", 1e3), ("least_stiffness", "least_stiffness_n_per_m", 1),
                ("platform_frequency", "platform_frequency_hz", 1),
            ]:
                expected = numpy.array(pose["standard_deviations"][name], dtype=float)  # NaN for None
                numpy.testing.assert_array_equal(factor * getattr(ours.std, field)[k], expected)
    assert (ours.std is None) == (more is None)
    with pytest.raises(cdpr.InputError, match="expected one load for the whole path"):
        robot.path(poses, payload=[1, 2, 3, 4, 5])


@pytest.mark.parametrize("name, plane, payload, way", [
    ("cogiro", ("z", 1.5), 100, "recomputed"), ("caroca", ("z", 1.75), 50, "kept"),
    ("ipanema-3", ("z", 1.3), 10, "recomputed"), ("segesta", ("z", 0.5), 1, "recomputed"),
])
def test_a_boundary_is_that_of_the_program(name, plane, payload, way, tmp_path):
    boundary = "boundary" if way == "recomputed" else f"boundary={way}"
    done = command("workspace", name, "--region", f"::5,::4,{plane[1]}", "--payload", payload, "--with", boundary,
                   "--out", tmp_path / "theirs")
    # It ends with 3 where less than half of the positions are held, as around a region.
    assert done.returncode in (0, 3), done.stderr
    theirs = json.loads((tmp_path / "theirs" / "workspace.json").read_text())["boundary"]
    ours = cdpr.Robot.from_file(name).boundary(plane=plane, grid=(5, 4), payload=payload, way=way)
    numbers = [value for value in theirs.values() if isinstance(value, (int, float))]
    assert ours.measure in numbers and ours.error in numbers and ours.doubtful in numbers
    assert ours.triangles.shape == (0, 3, 3)
    # The area by the polygons, which have the region on their left.
    area = sum(0.5 * numpy.sum(x * numpy.roll(y, -1) - numpy.roll(x, -1) * y)
               for x, y in (polygon[:, :2].T for polygon in ours.polygons))
    assert ours.measure > 0 and area == pytest.approx(ours.measure, rel=0.05, abs=3 * ours.error)
    with pytest.raises(cdpr.InputError, match='way is "x": expected recomputed or kept'):
        cdpr.Robot.from_file(name).boundary(plane=plane, payload=payload, way="x")


def test_a_report_is_written_recomputed(data, tmp_path):
    results = cdpr.study.run(data / "studies" / "caroca.json", tmp_path / "results", observations=64)
    before = (tmp_path / "results" / "report.html").read_text()
    (tmp_path / "results" / "report.html").unlink()
    assert results.report() == tmp_path / "results" / "report.html"
    assert (tmp_path / "results" / "report.html").read_text().count("<svg") == before.count("<svg") > 0
    elsewhere = results.report(tmp_path / "other.html")
    assert command("study", "report", tmp_path / "results", "--out", tmp_path / "theirs.html").returncode == 0
    assert elsewhere.read_bytes() == (tmp_path / "theirs.html").read_bytes()
    with pytest.raises(cdpr.FileError) as raised:
        cdpr.study.Results(tmp_path).report()
    assert str(raised.value).startswith(refusal("study", "report", tmp_path).splitlines()[0][:30])


def test_records_laws_and_studies_need_no_files(caroca, data, tmp_path, monkeypatch):
    record = data / "cables" / "caroca-4mm-record.csv"
    rows = [line.split(",") for line in record.read_text().splitlines() if line and not line.startswith("#")]
    columns = dict(zip(rows[0], (numpy.array(column) for column in zip(*rows[1:]))))
    columns = {name: column if name == "phase" else column.astype(float) for name, column in columns.items()}
    law = json.loads((data / "cables" / "caroca-4mm-law.json").read_text())
    study = json.loads((data / "studies" / "caroca.json").read_text())
    known = {"length": 1, "section": 1.2566370614e-5, "breaking_force": 10290, "ranges": [(5, 10), (10, 30)]}
    expected = assess.modulus(record, **known)
    cycle = assess.hysteresis(caroca, [0, 0, 1.75], 50, record=record, length=1)
    elastic = assess.hysteresis(caroca, [0, 0, 1.75], 50, law=data / "cables" / "caroca-4mm-law.json")
    budget = assess.tolerances(data / "studies" / "caroca.json", "mechanical", 1.4, observations=200)
    monkeypatch.chdir(tmp_path)
    tables = [columns]
    try:
        import pandas
    except ImportError:
        pass
    else:
        tables.append(pandas.read_csv(record, comment="#"))
    for table in tables:
        assert assess.modulus(table, **known).content == expected.content
        assert assess.hysteresis(caroca, [0, 0, 1.75], 50, record=table, length=1).content == cycle.content
    assert assess.hysteresis(caroca, [0, 0, 1.75], 50, law=law).content == elastic.content
    found = assess.tolerances({**study, "robot": caroca}, "mechanical", 1.4, observations=200)
    assert found.content == budget.content
    with pytest.raises(cdpr.InputError, match="record: line 1: header is force_kg"):
        assess.modulus({"force_kg": [1.0], "elongation_mm": [1.0], "phase": ["loading"]}, **known)
    with pytest.raises(cdpr.InputError, match="law: format is cdpr-law/9"):
        assess.hysteresis(caroca, [0, 0, 1.75], 50, law={**law, "format": "cdpr-law/9"})
