"""The models give the numbers of the command line, bit for bit, for one case and for arrays."""

import concurrent.futures
import copy
import multiprocessing
import pickle

import numpy
import pytest
from conftest import answer, command, refusal

import cdpr
from cdpr.sensitivity import MorrisDesign, SaltelliDesign, SobolDesign, normal, uniform

POSE = [0.0, 0.0, 1.75]
TURNED = [0.4, -0.3, 1.6, 0.99, 0.02, -0.03, 0.05]
LENGTHS = [4.44, 4.54, 4.36, 4.26, 4.26, 4.36, 4.54, 4.44]


def words(numbers):
    return ",".join(repr(float(number)) for number in numbers)


def same(array, expected):
    numpy.testing.assert_array_equal(array, numpy.array(expected))


def test_a_cable_is_that_of_the_command_line():
    for given in (
        {"length": 4.3, "end": [4.1, -1.7]},
        {"length": 4.3, "force": [30.0, -12.0]},
        {"end": [4.1, -1.7], "tension": 55.0},
    ):
        names = {"force": "end-force"}
        flags = [f"--{names.get(name, name)}={words(numpy.atleast_1d(value))}" for name, value in given.items()]
        printed = answer("cable", "catenary", "weight=0.9957,stiffness=1.28e6", *flags)
        cable = cdpr.catenary(0.9957, 1.28e6, **given)
        same(cable.force, printed["force_n"])
        same(cable.end, printed["end_m"])
        assert cable.anchor_tension == printed["tension"]["anchor_n"]
        assert cable.exit_tension == printed["tension"]["exit_n"]
        assert (cable.sag, cable.energy) == (printed["sag_m"], printed["energy_j"])
        assert cable.unstrained_length == printed["unstrained_length_m"]
        assert cable.residual == printed["residual_m"]
        same(cable.shape[0], [0.0, 0.0])
        numpy.testing.assert_allclose(cable.shape[-1], printed["end_m"], atol=1e-12)


@pytest.mark.parametrize("pose", [POSE, TURNED])
def test_the_inverse_model_is_that_of_the_command_line(caroca, caroca_file, pose):
    printed = answer("inverse", caroca_file, f"--pose={words(pose)}", "--payload=12.5", "--force=5,-3,2")
    found = caroca.inverse(pose, payload=12.5, force=[5, -3, 2])
    same(found.lengths, printed["lengths"])
    same(found.tensions, printed["tensions"])
    same(found.cable_forces, printed["cable_forces"])
    same(found.residual, [printed["report"]["residual"][name] for name in ("closure_m", "force_n", "moment_nm")])
    assert found.iterations == printed["report"]["iterations"]


def check_direct(found, printed):
    for name in ("position", "rotation", "cable_forces", "tensions"):
        same(getattr(found, name), printed[name])
    assert found.stable == printed["stable"]
    assert found.least_stiffness == printed["report"]["least_stiffness_n_per_m"]
    assert (found.method, found.iterations) == (printed["report"]["method"], printed["report"]["iterations"])
    assert [i + 1 for i in numpy.flatnonzero(found.slack)] == printed["report"]["slack_cables"]
    same(found.residual, [printed["residual"][name] for name in ("closure_m", "force_n", "moment_nm")])


def test_the_direct_model_is_that_of_the_command_line(caroca, caroca_file):
    flags = (f"--lengths={words(LENGTHS)}", "--force=20,0,-30", "--moment=1,2,3")
    given = {"force": [20, 0, -30], "moment": [1, 2, 3]}
    check_direct(caroca.direct(LENGTHS, **given), answer("direct", caroca_file, *flags))
    start = (f"--pose={words(TURNED)}",)
    check_direct(caroca.direct(LENGTHS, start=TURNED, **given), answer("direct", caroca_file, *flags, *start))
    heavier = caroca.with_parameters({"mass": 200.0})
    printed = answer("direct", caroca_file, f"--lengths={words(LENGTHS)}", "--mass=200")
    check_direct(heavier.direct(LENGTHS), printed)


def test_the_deflection_is_that_of_the_command_line(caroca, caroca_file):
    printed = answer("deflection", caroca_file, f"--pose={words(TURNED)}", "--payload=50", "--moment=3,0,-2")
    given = caroca.deflection(TURNED, payload=50, moment=[3, 0, -2])
    same(1e3 * given.displacement, printed["deflection_mm"])
    assert 1e3 * given.magnitude == printed["magnitude_mm"]
    # The command line has degrees.
    numpy.testing.assert_allclose(numpy.degrees(given.rotation), printed["rotation_deg"], rtol=1e-15)
    same(given.lengths, printed["lengths"])
    check_direct(given.unloaded, printed["unloaded"])
    check_direct(given.loaded, printed["loaded"])


def test_the_natural_motions_are_those_of_the_command_line(cogiro, cogiro_file):
    printed = answer("modes", cogiro_file, "--massless", "--pose=0.5,0.2,2", "--payload=50")
    found = cogiro.massless_modes([0.5, 0.2, 2], payload=50)
    same(found.frequencies_hz, printed["frequencies_hz"])
    same(found.cable_frequencies_hz, printed["cable_frequencies_hz"])
    same(found.translations, [mode["translation"] for mode in printed["modes"]])
    same(found.cable_shares, [mode["cable_shares"] for mode in printed["modes"]])
    assert numpy.allclose(found.cable_shares.sum(axis=1) + found.weight_shares, 1)
    printed = answer("modes", cogiro_file, "--below=6", "--pose=0.5,0.2,2", "--payload=50")
    found = cogiro.modes([0.5, 0.2, 2], below=6, payload=50)
    for field, key in {"frequencies_hz": "frequency_hz", "platform_shares": "platform_share",
                       "cable_shares": "cable_shares", "translations": "translation"}.items():
        expected = [mode[key] for mode in printed["modes"]]
        numpy.testing.assert_allclose(getattr(found, field), expected, rtol=1e-5, atol=1e-9)
    assert found.complete_below_hz == printed["complete_below_hz"] == 6
    assert len(found.frequencies_hz) == printed["counted"]
    printed = answer("modes", cogiro_file, "--below=6", "--pose=0.5,0.2,2", "--with=servo=1e6,winch=40")
    found = cogiro.modes([0.5, 0.2, 2], below=6, servo=1e6, winch=40)
    same(found.frequencies_hz, [mode["frequency_hz"] for mode in printed["modes"]])
    with pytest.raises(cdpr.errors.InputError, match="free rotors"):
        cogiro.modes([0.5, 0.2, 2], winch=40)
    both = cogiro.modes([[0.5, 0.2, 2], [0, 0, 2]], number=3)
    assert both.frequencies_hz.shape == (2, 3) and both.cable_shares.shape == (2, 3, 8)


def test_the_stiffness_is_that_of_the_command_line(caroca, caroca_file):
    printed = answer("stiffness", caroca_file, f"--pose={words(TURNED)}", "--payload=50")
    found = caroca.stiffness(TURNED, payload=50)
    same(found.matrix, printed["stiffness"])
    same(found.eigenvalues, [mode["stiffness_n_per_m"] for mode in printed["eigenvalues"]])
    same(found.translations, [mode["translation"] for mode in printed["eigenvalues"]])
    same(found.rotations, [mode["rotation"] for mode in printed["eigenvalues"]])
    assert (found.least_stiffness, found.stable) == (printed["least_stiffness_n_per_m"], printed["stable"])
    assert found.characteristic_length == printed["characteristic_length_m"]


def test_the_capacity_is_that_of_the_command_line(caroca, caroca_file):
    flags = ["--payload=50", "--wrench=100,0,0,0,0,0", "--wrench=0,0,-200,0,0,0", "--with=tilt=4"]
    printed = answer("capacity", caroca_file, f"--pose={words(TURNED)}", *flags)
    wrenches = [[100, 0, 0, 0, 0, 0], [0, 0, -200, 0, 0, 0]]
    found = caroca.capacity(TURNED, payload=50, wrenches=wrenches, tilt=4)
    for kind, unit in [("payload_recomputed", "kg"), ("payload_kept", "kg"), ("payload_kept_slack", "kg"),
                       ("margin_recomputed", "n"), ("margin_kept", "n")]:
        assert getattr(found, kind) == printed[f"{kind}_{unit}"]["value"]
    assert 1e3 * found.nearest_cables == printed["nearest_cables_mm"]
    assert 1e3 * found.nearest_to_platform == printed["nearest_to_platform_mm"]
    reached = numpy.degrees(found.tilt) - [towards["angle_deg"] for towards in printed["tilt"]]
    assert numpy.abs(reached).max() <= 0.01 + 1e-9
    block = printed["margin_recomputed_n"]["blocking"][0]
    assert f"cable {block['cable']} at its {block['limit']}" in found.blocked_by[3]
    with pytest.raises(cdpr.InputError, match="wrenches has the shape"):
        caroca.capacity(TURNED, wrenches=[1, 2, 3])


def test_the_derivatives_are_those_of_the_command_line(caroca, caroca_file):
    printed = answer("derivatives", caroca_file, f"--pose={words(TURNED)}", "--payload=50")
    found = caroca.derivatives(TURNED, payload=50)
    count = len(printed["parameters"])
    assert found.inputs[:count] == printed["parameters"]
    assert found.inputs[count:] == ["payload", "x", "y", "z", "rx", "ry", "rz"]
    same(1e3 * found.magnitude[:count], printed["magnitude_mm"])
    same(1e3 * found.displacement[:, :count].T, printed["deflection_mm"])
    same(found.lengths[:, :count].T, printed["lengths"])
    assert not found.one_sided.any() and "one_sided" not in printed
    same(found.magnitude_right, found.magnitude)
    same(found.least_stiffness[:count], printed["least_stiffness_n_per_m"])
    assert numpy.isnan(found.frequency).all(), "CAROCA has no inertia"
    unloaded = caroca.derivatives(TURNED)
    same(unloaded.lengths, found.lengths)
    assert numpy.isnan(unloaded.magnitude).all()
    numpy.testing.assert_allclose(unloaded.displacement[:, :count], 0, atol=1e-9)
    assert unloaded.displacement[2, count] < 0, "each kilogram lowers the platform"


def test_left_and_right_derivatives_of_cables_on_their_least_tension_differ(caroca):
    # One cable is on its limit there; on an axis of symmetry the others would not act on all motions.
    pose = [0.4, 0.3, 1.75]
    tensions = caroca.inverse(pose).tensions
    robot = cdpr.Robot.from_dict({**caroca.to_dict(), "tension_limits": {"min": 1.001 * tensions.min(),
                                                                        "max": 10290.0}})
    cables = numpy.flatnonzero(robot.inverse(pose).tensions == 1.001 * tensions.min())
    found = robot.derivatives(pose, payload=50)
    names = [name for name, one in zip(found.inputs, found.one_sided) if one]
    assert names == [f"dt{cable + 1}" for cable in cables] and names
    for cable in cables:
        column = found.inputs.index(f"dt{cable + 1}")
        assert found.set_points[cable, column] == 0 and found.set_points_right[cable, column] == 1
        assert (found.lengths[:, column] == 0).all() and found.lengths_right[cable, column] < 0
    same(found.tensions[:, ~found.one_sided], found.tensions_right[:, ~found.one_sided])


def test_a_moment_makes_the_stiffness_unsymmetric(caroca):
    moment = numpy.array([5.0, -3.0, 8.0])
    found = caroca.stiffness(TURNED, moment=moment)
    skew = (found.matrix - found.matrix.T)[3:, 3:]
    cross = numpy.array([[0, -moment[2], moment[1]], [moment[2], 0, -moment[0]], [-moment[1], moment[0], 0]])
    numpy.testing.assert_allclose(skew, -cross, atol=1e-6)
    same(found.symmetric_part, 0.5 * (found.matrix + found.matrix.T))


def test_quaternions_in_doubt_are_questioned(caroca):
    with pytest.raises(cdpr.InputError, match="has the length 2.0000: expected the length 1"):
        caroca.inverse([0, 0, 1.75, 2, 0, 0, 0])
    with pytest.warns(UserWarning, match="as if it were qx,qy,qz,qw"):
        caroca.inverse([[0, 0, 1.75, 0, 0, 0, 1]])
    with pytest.raises(cdpr.InputError, match="20 GPa is 2e10"):
        cdpr.Robot(caroca.anchor_points, caroca.exit_points, mass=180, section=1e-5, linear_density=0.1,
                   youngs_modulus=20, tension_limits=(1, 1e4))
    with pytest.raises(cdpr.InputError, match="expected lengths in m"):
        caroca.direct(1000 * caroca.inverse(POSE).lengths)


def test_a_workspace_is_that_of_the_command_line(caroca, caroca_file, tmp_path):
    printed = answer("workspace", caroca_file, "--region=-3:3:7,-1:1:3,1.75:1.75:1", "--payload=50",
                  "--uncertainty=a=0.002,b=0.002", "--out", tmp_path)
    found = caroca.workspace(x=(-3, 3, 7), y=(-1, 1, 3), z=1.75, payload=50,
                             uncertainty={"a": 0.002, "b": 0.002})
    assert found.shape == (7, 3, 1)

    def column(name):
        return printed["columns"].get(name, [None] * 21)

    assert found.status == column("status")
    assert found.reasons == column("reason")
    assert found.dominant == column("dominant")
    assert found.recomputed_status == column("recomputed_status")
    assert found.recomputed_reasons == column("recomputed_reason")
    for name in ("least_tension_n", "greatest_tension_n", "least_stiffness_n_per_m", "dominant_share",
                 "recomputed_least_tension_n", "recomputed_greatest_tension_n", "magnitude_mm", "dx_mm"):
        printed_column = [numpy.nan if value is None else value for value in column(name)]
        # From metres to millimetres is one rounding more.
        numpy.testing.assert_allclose(found.to_dataframe()[name], printed_column, rtol=1e-15)
    bare = caroca.workspace(x=(-3, 3, 7), y=0, z=1.75, payload=0)
    assert numpy.isnan(bare.magnitude).all() and not numpy.isnan(bare.least_stiffness).any()
    assert numpy.isnan(bare.lowest_frequency).all()
    content = caroca.to_dict()
    content["platform"]["inertia"] = numpy.diag([4.0, 5.0, 6.0]).tolist()
    massive = cdpr.Robot.from_dict(content)
    found = massive.workspace(x=0, y=0, z=1.75, payload=0)
    assert abs(found.lowest_frequency[0] / massive.modes([0, 0, 1.75]).frequencies_hz[0] - 1) < 3e-6
    plane = caroca.workspace(plane=("z", 1.75), grid=(3, 2), payload=50)
    assert plane.shape == (3, 2, 1)
    same(plane.positions[0], [-3.5, -2.0, 1.75])


def test_a_row_of_an_array_is_what_the_case_is_alone(caroca):
    generator = numpy.random.default_rng(1)
    poses = numpy.array(POSE) + generator.uniform(-0.5, 0.5, (40, 3))
    loads = generator.uniform(-30, 30, (40, 3))
    wanted = caroca.inverse(poses)
    direct = caroca.direct(wanted.lengths, force=loads, start=POSE)
    deflection = caroca.deflection(poses, force=loads, payload=10.0)
    payloads = numpy.linspace(0, 50, 40)
    stiffness = caroca.stiffness(poses, payload=payloads)
    derivatives = caroca.derivatives(poses[:5], payload=50)
    for i, (pose, load) in enumerate(zip(poses, loads)):
        lengths = caroca.inverse(pose).lengths
        same(wanted.lengths[i], lengths)
        alone = caroca.direct(lengths, force=load, start=POSE)
        same(direct.pose[i], alone.pose)
        same(direct.slack[i], alone.slack)
        assert direct.method[i] == alone.method
        assert deflection.magnitude[i] == caroca.deflection(pose, force=load, payload=10.0).magnitude
        same(stiffness.matrix[i], caroca.stiffness(pose, payload=payloads[i]).matrix)
        if i < 5:
            same(derivatives.lengths[i], caroca.derivatives(pose, payload=50).lengths)
    assert wanted.reasons == [None] * 40
    assert wanted.active.dtype == numpy.int8 and direct.stable.dtype == bool


def test_robots_that_deviate_are_observed_as_they_are_alone(caroca):
    generator = numpy.random.default_rng(2)
    names = list(caroca.parameters)
    uncertain = {"mass": 5.0, "linear_density": 1e-3, "youngs_modulus": 5e9}
    sizes = numpy.array([uncertain.get(name, 2e-3) for name in names])
    deviations = sizes * generator.uniform(-1, 1, (600, len(names)))
    deviations[7, 0] = -1e4
    found = caroca.observe(POSE, deviations, payload=50)
    assert found.reasons[7].startswith("platform.mass is -") and numpy.isnan(found.magnitude[7])
    same(found.displacement[300:], caroca.observe(POSE, deviations[300:], payload=50).displacement)
    for row in (0, 100, 599):
        values = dict(zip(names, numpy.array(list(caroca.parameters.values())) + deviations[row]))
        offsets = [values.pop(f"dt{i + 1}") for i in range(8)]
        alone = caroca.with_parameters(values).deflection(POSE, payload=50, tension_offsets=offsets)
        numpy.testing.assert_allclose(found.displacement[row], alone.displacement, atol=1e-12)
        assert abs(caroca.observe(POSE, deviations[row], payload=50).magnitude - alone.magnitude) < 1e-12


def test_no_case_is_an_empty_answer(caroca):
    found = caroca.direct(numpy.empty((0, 8)))
    assert found.position.shape == (0, 3) and found.reasons == [] and found.method == []


def test_a_case_without_an_answer_is_nan_in_an_array_and_raises_alone(caroca, caroca_file):
    far = [9.0, 0.0, 1.75]
    poses = numpy.array([POSE, far, POSE])
    found = caroca.deflection(poses, payload=50)
    assert numpy.isnan(found.magnitude).tolist() == [False, True, False]
    assert numpy.isnan(found.loaded.tensions[1]).all()
    text = refusal("deflection", caroca_file, "--pose=9,0,1.75", "--payload=50")
    assert found.reasons == [None, text, None]
    with pytest.raises(cdpr.NoSolutionError) as raised:
        caroca.deflection(far, payload=50)
    assert str(raised.value) == text
    assert raised.value.kind == "infeasible_tension"


def test_bad_input_is_refused_with_field_value_and_what_would_be_right(caroca, caroca_file, tmp_path):
    for call, start in (
        (lambda: caroca.direct([1.0, 2.0]),
         "lengths is a list of 2: expected one value for each of the 8 cables"),
        (lambda: caroca.direct([-1.0] * 8),
         "lengths[0] is -1: expected a finite, positive unstrained length"),
        (lambda: caroca.inverse([0, 0]), "pose has 2 numbers a row: expected x,y,z [m] or"),
        (lambda: caroca.inverse([0, 0, 1, 0, 0, 0, 0]),
         "pose is [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0], whose quaternion is zero or not finite: expected"),
        (lambda: caroca.inverse([0, 0, numpy.nan]), "pose is [0.0, 0.0, NaN]: expected finite numbers"),
        (lambda: caroca.inverse([[[0]]]), "pose has the shape [1, 1, 1]: expected"),
        (lambda: caroca.inverse(POSE, force=[1, 2]), "force has 2 numbers a row: expected 3"),
        (lambda: caroca.inverse([POSE] * 3, payload=[1, 2]),
         "pose has 3 rows: expected one for all cases, or 2"),
        (lambda: caroca.inverse(POSE, payload=-1), "payload is -1: expected a mass, zero or more"),
        (lambda: caroca.observe(POSE, [0.0] * 61, payload=50),
         "61 deviations for a robot with 62 parameters: expected one for each of them"),
        (lambda: caroca.observe([POSE, POSE], [0.0] * 62, payload=50),
         "pose or load has a row for each case"),
        (lambda: cdpr.catenary(1, 1e6, length=4, end=[3, 0], points=1), "points is 1: expected 2 or more"),
        (lambda: caroca.with_parameters({"a9.x": 1.0}), "no parameter is named `a9.x`"),
        (lambda: caroca.with_parameters({"mass": -1.0}),
         "platform.mass is -1: expected a finite, positive mass"),
        (lambda: caroca.workspace(x=0, y=0, z=0, payload=50, uncertainty={"q": 1}),
         "uncertainty of q is 1: expected"),
        (lambda: caroca.workspace(x=0, y=0, z=0, payload=50, uncertainty={"mass": numpy.inf}),
         "uncertainty of mass is inf"),
        (lambda: caroca.with_parameters({"dt1": 5.0}),
         "dt1 is 5: expected 0, as offsets belong to set-points"),
        (lambda: cdpr.catenary(1, 1e6, length=4), "expected two of what is known"),
        (lambda: cdpr.Robot.from_json("{}"), "line 1, column 2: "),
    ):
        with pytest.raises(cdpr.InputError) as raised:
            call()
        assert str(raised.value).startswith(start), str(raised.value)
        assert isinstance(raised.value, (cdpr.CdprError, ValueError))
    broken = tmp_path / "broken.json"
    broken.write_text(open(caroca_file).read().replace('"mass"', '"masse"'))
    with pytest.raises(cdpr.InputError) as raised:
        cdpr.Robot.from_file(broken)
    assert str(raised.value) == refusal("robot", "check", broken)
    with pytest.raises(cdpr.FileError) as raised:
        cdpr.Robot.from_file(tmp_path / "none.json")
    assert str(raised.value) == refusal("robot", "check", tmp_path / "none.json")


def test_a_robot_with_its_own_parameters_is_itself(caroca):
    assert caroca.with_parameters(caroca.parameters) == caroca
    assert caroca.with_parameters({"mass": 200.0}) != caroca and caroca != 3
    again = cdpr.Robot.from_dict(caroca.to_dict())
    assert again == caroca and hash(again) == hash(caroca)


def test_a_robot_tells_what_it_was_made_of(caroca):
    content = caroca.to_dict()
    assert (caroca.mass, caroca.gravity) == (content["platform"]["mass"], content["gravity"])
    assert caroca.tension_limits == (content["tension_limits"]["min"], content["tension_limits"]["max"])
    same(caroca.center_of_mass, content["platform"]["center_of_mass"])
    softer = caroca.with_parameters({"youngs_modulus": 8e10})
    same(softer.youngs_modulus, [8e10] * 8)
    same(caroca.linear_density, [content["cable"]["linear_density"]] * 8)
    made = cdpr.Robot(caroca.anchor_points, caroca.exit_points, mass=caroca.mass, section=caroca.section,
                      linear_density=caroca.linear_density, youngs_modulus=caroca.youngs_modulus,
                      tension_limits=caroca.tension_limits, center_of_mass=caroca.center_of_mass,
                      gravity=caroca.gravity, name=caroca.name)
    assert made.parameters == caroca.parameters
    same(made.section, caroca.section)


def test_gravity_is_a_number_or_a_vector(caroca):
    content = caroca.to_dict()
    content["gravity"] = [0.3, 0.0, -9.805]
    tilted = cdpr.Robot.from_dict(content)
    same(tilted.gravity, content["gravity"])
    assert tilted.to_dict()["gravity"] == content["gravity"] and tilted.parameters["gravity.x"] == 0.3
    arguments = dict(mass=caroca.mass, section=caroca.section, linear_density=caroca.linear_density,
                     youngs_modulus=caroca.youngs_modulus, tension_limits=caroca.tension_limits,
                     center_of_mass=caroca.center_of_mass)
    made = cdpr.Robot(caroca.anchor_points, caroca.exit_points, gravity=tilted.gravity, **arguments)
    pose = [0.1, 0.2, 1.75]
    same(made.inverse(pose).lengths, tilted.inverse(pose).lengths)
    # The same robot with its base level.
    g, tilt = numpy.hypot(0.3, 9.805), numpy.arctan2(0.3, 9.805)
    turn = numpy.array([[numpy.cos(tilt), 0, numpy.sin(tilt)], [0, 1, 0], [-numpy.sin(tilt), 0, numpy.cos(tilt)]])
    level = cdpr.Robot(caroca.anchor_points, caroca.exit_points @ turn.T, gravity=g, **arguments)
    quaternion = [numpy.cos(tilt / 2), 0, numpy.sin(tilt / 2), 0]
    found = level.inverse([*(turn @ pose), *quaternion])
    assert numpy.allclose(found.lengths, made.inverse(pose).lengths, rtol=0, atol=1e-10)
    assert made.with_parameters({"gravity.x": 0.0}).inverse(pose).lengths[0] != found.lengths[0]
    for wrong, message in [([1, 2], "gravity has the shape [2]"), (-1, "gravity is -1"),
                           ([0, numpy.nan, -9.81], "gravity")]:
        with pytest.raises(cdpr.InputError) as raised:
            cdpr.Robot(caroca.anchor_points, caroca.exit_points, gravity=wrong, **arguments)
        assert message in str(raised.value)


def answers(robot):
    """One of every class of answers, of one case and of two."""
    yield cdpr.catenary(1.0, 1e6, length=5.0, end=[4.0, 1.0])
    far = [POSE, [9.0, 0.0, 1.75]]
    for poses in (POSE, far):
        yield robot.inverse(poses)
        yield robot.deflection(poses, payload=50)
        yield robot.stiffness(poses, payload=50)
        yield robot.derivatives(poses, payload=50)
        yield robot.capacity(poses, payload=50, tilt=2)
    yield robot.direct([LENGTHS, LENGTHS], force=[20, 0, -30])
    for lengths in (LENGTHS, [LENGTHS, LENGTHS]):
        yield robot.certify(lengths)
    yield robot.path(far, payload=50)
    yield robot.observe(POSE, numpy.zeros((2, 62)), payload=50)
    yield robot.workspace(x=(-9, 0, 2), y=0, z=1.75, payload=50, uncertainty={"a": 0.002})
    laws = {"x": uniform(0, 1), "y": normal(2, 1)}
    design = SobolDesign(laws, 64, seed=3)
    yield design.effects(design.rows()[:, 0])
    blocks = SaltelliDesign(laws, 16, seed=3, pairs=True)
    yield blocks.indices(blocks.rows()[:, 0])
    radial = MorrisDesign(laws, 4, seed=3)
    yield radial.effects(radial.rows()[:, 0])


def fields(answer):
    named = {name: getattr(answer, name) for name in dir(answer) if not name.startswith("_")}
    return {name: value for name, value in named.items() if not callable(value)}


def check_same(one, other):
    assert type(one) is type(other)
    for name, value in fields(one).items():
        if type(value).__module__.startswith("cdpr"):
            check_same(value, getattr(other, name))
        elif isinstance(value, list):
            assert value == getattr(other, name), name
        else:
            numpy.testing.assert_array_equal(value, getattr(other, name), name)


def test_an_answer_goes_to_another_process_and_is_summed_up(caroca):
    classes = set()
    for answer in answers(caroca):
        classes.add(type(answer).__name__)
        check_same(answer, pickle.loads(pickle.dumps(answer)))
        check_same(answer, copy.deepcopy(answer))
        public = type(answer).__module__.removesuffix(".estimates")
        assert repr(answer).startswith(f"<{public}.{type(answer).__name__} ")
        assert len(repr(answer)) < 560
    assert classes == {"Capacity", "Catenary", "InverseSolution", "Deflection", "Stiffness", "Derivatives",
                       "DirectSolution", "Observations", "Workspace", "Effects", "SobolIndices",
                       "MorrisEffects", "Certificate", "PathStates"}
    one = caroca.deflection(POSE, payload=50)
    numbers = ", ".join(f"{value:.6g}" for value in one.displacement)
    assert f"displacement [{numbers}], magnitude {one.magnitude:.6g}, " in repr(one)
    found = caroca.deflection([POSE, POSE], payload=50)
    assert repr(found) == (
        "<cdpr.Deflection displacement (2, 3), magnitude (2,), rotation (2, 3), lengths (2, 8), "
        "unloaded DirectSolution, loaded DirectSolution, reasons [2], kinds [2]>"
    )
    with pytest.raises(TypeError, match="missing"):
        cdpr.Deflection(1, 2)


def test_answers_are_frames_of_pandas_with_a_row_for_each_case(caroca):
    pytest.importorskip("pandas", reason="pandas is not installed")
    for answer in answers(caroca):
        frame = answer.to_dataframe()
        assert len(frame.columns) >= 1 and len(frame) >= 1, answer
    far = [POSE, [9.0, 0.0, 1.75]]
    found = caroca.derivatives(far, payload=50)
    frame = found.to_dataframe()
    slopes = found.magnitude[:, found.inputs.index("a1.x")]
    numpy.testing.assert_array_equal(frame["magnitude_mm/a1.x"], 1e3 * slopes)
    numpy.testing.assert_array_equal(frame["length_8_m/mass"], found.lengths[:, 7, found.inputs.index("mass")])
    assert list(frame["kind"]) == found.kinds and numpy.isnan(frame["magnitude_mm/a1.x"][1])
    assert caroca.inverse(POSE).to_dataframe()["tension_3_n"][0] == caroca.inverse(POSE).tensions[2]
    plane = caroca.workspace(plane=("z", 1.75), grid=(3, 3), payload=50)
    frame = plane.to_dataframe()
    assert list(frame["status"]) == plane.status and list(frame["y_m"]) == list(plane.positions[:, 1])


@pytest.mark.parametrize("name", ["caroca", "ipanema-3", "cogiro"])
def test_columns_of_frames_are_those_of_the_program_with_the_same_numbers(name, tmp_path):
    pandas = pytest.importorskip("pandas", reason="pandas is not installed")
    robot = cdpr.Robot.from_file(name)
    poses = [[0.0, 0.0, 1.3], [0.1, 0.05, 1.3]] if name == "ipanema-3" else [[0, 0, 1.75], [0.1, 0.2, 1.8]]
    file, table = tmp_path / "poses.csv", tmp_path / "table.csv"
    file.write_text("\n".join(",".join(map(str, pose)) for pose in poses))
    path = robot.path(poses, payload=5, uncertainty={"a": 0.002})
    load = ["--payload", "5"]
    answers = {
        "inverse": (robot.inverse(poses), [], {"active", "iterations"}),
        "deflection": (robot.deflection(poses, payload=5), load, set()),
        "stiffness": (robot.stiffness(poses), [], {"symmetric_part", "translation", "rotation"}),
        "capacity": (robot.capacity(poses), [], {"blocked_by"}),
        "derivatives": (robot.derivatives(poses, payload=5), load, {"set_point", "tension", "amplitude", "right", "one_sided"}),
        "path": (path, [*load, "--uncertainty", "a=0.002"], set()),
    }
    own = {"reason", "kind", "residual", "cable_force", "out_of_limits", "x_m", "stable", "jump", "others"}
    for command_name, (found, more, python_alone) in answers.items():
        done = command(command_name, name, "--poses", file, *more, "--out", table, "--overwrite")
        assert done.returncode == 0, done.stderr
        theirs, ours = pandas.read_csv(table), found.to_dataframe()
        if command_name == "path":
            ours = pandas.concat([ours, found.std.to_dataframe().drop(columns="reason")], axis=1)
        of_pose = [f"/{one}" for one in ("payload", *"xyz", "rx", "ry", "rz")]
        compared = [
            column for column in ours
            if not column.startswith((*own, *python_alone)) and not column.endswith(tuple(of_pose))
        ]
        assert len(compared) > 4 and set(compared) <= set(theirs.columns), command_name
        numpy.testing.assert_allclose(ours[compared].astype(float), theirs[compared].astype(float), rtol=1e-12)


def test_answers_come_back_from_a_process_pool(caroca):
    poses = [POSE, TURNED]
    with concurrent.futures.ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as executor:
        for pose, found in zip(poses, executor.map(caroca.stiffness, poses)):
            check_same(found, caroca.stiffness(pose))


def test_a_robot_is_made_of_arrays_and_read_back_to_the_last_bit(caroca):
    content = caroca.to_dict()
    cable = content["cable"]
    made = cdpr.Robot(
        caroca.anchor_points,
        caroca.exit_points,
        mass=content["platform"]["mass"],
        center_of_mass=content["platform"]["center_of_mass"],
        section=cable["section"] if "section" in cable else numpy.pi * cable["diameter"] ** 2 / 4,
        linear_density=cable["linear_density"],
        youngs_modulus=numpy.full(8, cable["youngs_modulus"]),
        tension_limits=(content["tension_limits"]["min"], content["tension_limits"]["max"]),
        gravity=content["gravity"],
    )
    assert made.parameters == caroca.parameters
    assert len(made.parameters) == 62
    for again in (cdpr.Robot.from_dict(content), pickle.loads(pickle.dumps(caroca))):
        same(again.inverse(TURNED).lengths, caroca.inverse(TURNED).lengths)
    assert f"{1e3 * made.deflection(POSE, payload=50).magnitude:.4f}" == "1.3312"
    stiffer = caroca.with_parameters({"youngs_modulus": 2e11, "a1.x": 0.25})
    assert stiffer.parameters["youngs_modulus"] == 2e11 and stiffer.anchor_points[0, 0] == 0.25
    assert caroca.parameters["youngs_modulus"] != 2e11


def test_along_a_path_lengths_are_continuous_and_jumps_are_reported(caroca):
    xs = numpy.linspace(-1.0, 1.0, 21)
    poses = numpy.column_stack([xs, 0 * xs, 1.75 + 0 * xs])
    found = caroca.inverse(poses, path=True)
    assert found.jump.shape == (21,) and not found.jump.any()
    numpy.testing.assert_allclose(found.lengths, caroca.inverse(poses).lengths, rtol=1e-12)
    assert caroca.inverse(poses).jump is None
    assert caroca.inverse(poses[0], path=True).jump is False
    references = [[0.0] * 8] + [[700.0] * 8] * 3
    slow = caroca.inverse([poses[0]] * 4, path=True, tension_change=2, reference=references)
    changes = numpy.abs(numpy.diff(slow.tensions, axis=0))
    assert changes.max() <= 2 * (1 + 1e-9) and changes[0].max() > 1.99
    with pytest.raises(cdpr.InputError, match="tension_change is 20"):
        caroca.inverse(poses, tension_change=20)
def test_tensions_come_nearer_to_those_that_are_preferred(caroca):
    pose = [0.6, -0.4, 1.4]
    least_norm = caroca.inverse(pose)
    same(caroca.tension_reference, [0.0] * 8)
    preferring = caroca.with_tension_reference(900.0)
    same(preferring.tension_reference, [900.0] * 8)
    found = preferring.inverse(pose)
    same(found.tensions, caroca.inverse(pose, reference=[900.0] * 8).tensions)
    distance = [numpy.linalg.norm(t - 900.0) for t in (found.tensions, least_norm.tensions)]
    assert distance[0] < distance[1]
    assert numpy.linalg.norm(found.tensions) > numpy.linalg.norm(least_norm.tensions)
    loaded = preferring.deflection(pose, payload=50.0)
    numpy.testing.assert_allclose(loaded.unloaded.tensions, found.tensions, rtol=1e-9)
    middle = caroca.with_tension_reference("mid")
    same(middle.tension_reference, [sum(caroca.tension_limits) / 2] * 8)
    assert cdpr.Robot.from_json(middle.to_json()) == middle
    assert middle.with_tension_reference(None) == caroca
    for wrong in (-1.0, [1.0, 2.0], "middle", [[1.0]]):
        with pytest.raises(cdpr.InputError, match="tension"):
            caroca.with_tension_reference(wrong)


def test_a_distribution_of_tensions_has_the_least_norm_of_its_name(caroca):
    pose = [0.6, -0.4, 1.4]
    names = {"least_1_norm": 1, "least_2_norm": 2, "least_infinity_norm": numpy.inf}
    found = {name: caroca.with_distribution(name).inverse(pose).tensions for name in names}
    for name, order in names.items():
        norms = {other: numpy.linalg.norm(t, order) for other, t in found.items()}
        assert all(norms[name] <= norm * (1 + 1e-9) for norm in norms.values()), norms
    numpy.testing.assert_allclose(found["least_2_norm"], caroca.inverse(pose).tensions, rtol=1e-9)
    assert caroca.distribution == "nearest"
    even = caroca.with_tension_reference(900.0).with_distribution("least_infinity_norm")
    assert even.distribution == "least_infinity_norm"
    same(even.tension_reference, [0.0] * 8)
    assert cdpr.Robot.from_json(even.to_json()) == even
    # Tensions that are stated are those to come near to.
    same(even.inverse(pose, reference=[0.0] * 8).tensions, caroca.inverse(pose).tensions)
    for refused in (lambda: caroca.with_distribution("least"), lambda: even.derivatives(pose, payload=50.0)):
        with pytest.raises(cdpr.InputError, match="distribution"):
            refused()


def test_limits_of_a_cable_and_at_exit_points_are_kept_and_named(caroca):
    pose = [0.6, -0.4, 1.4]
    found = caroca.inverse(pose)
    exits = found.exit_tensions
    assert numpy.all(exits > found.tensions) and numpy.all(found.out_of_limits == 0)
    highest = int(numpy.argmax(exits))
    limits = caroca.cable_limits
    limits[highest, 1] = 0.99 * exits[highest]
    made = cdpr.Robot(caroca.anchor_points, caroca.exit_points, mass=caroca.mass, section=caroca.section,
                      linear_density=caroca.linear_density, youngs_modulus=caroca.youngs_modulus,
                      center_of_mass=caroca.center_of_mass, gravity=caroca.gravity,
                      tension_limits=limits, max_at="exit", tension_reference=found.tensions)
    same(made.cable_limits, limits)
    assert made.max_at == ["exit"] * 8
    kept = made.inverse(pose)
    assert kept.active[highest] == 1
    assert abs(kept.exit_tensions[highest] / limits[highest, 1] - 1) < 1e-11
    loaded = made.deflection(pose, payload=50.0).loaded
    above = loaded.exit_tensions[highest] > limits[highest, 1] * (1 + 1e-9)
    assert loaded.out_of_limits[highest] == int(above)
    with pytest.raises(cdpr.InputError, match="max_at"):
        cdpr.Robot(caroca.anchor_points, caroca.exit_points, mass=1, section=1, linear_density=1,
                   youngs_modulus=1, tension_limits=(1, 2), max_at="winch")


def test_derivatives_and_workspaces_of_four_cables_take_free_coordinates(data):
    robot = cdpr.Robot.from_file(str(data / "robots" / "four-cables.json"))
    pose, free = [0.5, 0.3, 2.0], ["roll", "pitch"]
    found = robot.derivatives(pose, payload=5, free=free)
    given = robot.deflection(pose, payload=5, free=free)
    assert found.deflection.magnitude == given.magnitude
    column = list(found.inputs).index("mass")
    step = 0.01
    heavier, lighter = (
        robot.with_parameters({"mass": robot.parameters["mass"] + change}).deflection(pose, payload=5, free=free)
        for change in (step, -step)
    )
    difference = (heavier.magnitude - lighter.magnitude) / (2 * step)
    assert abs(found.magnitude[column] - difference) < 1e-3 * abs(difference)
    deviations = numpy.zeros((2, len(robot.parameters)))
    deviations[1, found.inputs.index("mass")] = 0.5
    observed = robot.observe(pose, deviations, payload=5, free=free)
    assert abs(observed.magnitude[0] - given.magnitude) < 1e-9
    slope = found.magnitude[found.inputs.index("mass")]
    assert abs((observed.magnitude[1] - observed.magnitude[0]) / 0.5 - slope) < 0.05 * abs(slope)
    space = robot.workspace(x=0.5, y=0.3, z=(1.5, 2.0, 2), payload=5, free=free)
    assert abs(space.magnitude[1] - given.magnitude) < 1e-12
    with pytest.raises(cdpr.InputError, match="free is"):
        robot.workspace(x=0.5, y=0.3, z=(1.5, 2.0, 2), payload=5)


def test_robots_have_a_ground_below_which_nothing_hangs(data):
    path = data / "robots" / "four-cables.json"
    assert cdpr.Robot.from_file(path).ground_z is None
    robot = cdpr.Robot.from_json(path.read_text().replace('"grade"', '"ground_z": 2.25, "grade"'))
    assert robot.ground_z == 2.25
    with pytest.raises(cdpr.NoSolutionError, match="below the ground at 2.25 m"):
        robot.inverse([0.5, 0.3, 2.0], free=["roll", "pitch"])


def test_cables_are_a_list_and_their_number_is_its_length(caroca):
    assert caroca.n_cables == len(caroca.cables) == 8
    cable = caroca.cables[2]
    assert cable.number == 3 and cable.section == caroca.section[2] and cable.max_at == "anchor"
    numpy.testing.assert_array_equal(cable.anchor_point, caroca.anchor_points[2])
    numpy.testing.assert_array_equal(cable.tension_limits, caroca.cable_limits[2])
    assert pickle.loads(pickle.dumps(cable)).youngs_modulus == cable.youngs_modulus


def test_further_rests_are_answers_like_the_first():
    robot = cdpr.Robot.from_file("four-cables")
    found = robot.inverse([0.5, 0.3, 2.0], free=["roll", "pitch"])
    assert all(other.pose.shape == (7,) and other.lengths.shape == (4,) for other in found.others)
    for other in found.others:
        assert isinstance(other.stable, bool) and other.out_of_limits.dtype == numpy.int8


@pytest.mark.parametrize("name", ["caroca", "cogiro", "ipanema-3", "four-cables"])
def test_answers_can_be_drawn(name):
    matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    matplotlib.use("svg")
    from matplotlib import pyplot

    robot = cdpr.Robot.from_file(name)
    free = ["roll", "pitch"] if name == "four-cables" else None
    middle = robot.exit_points.mean(axis=0)
    pose = [0.5, 0.3, 2.0] if free else [*middle[:2], 0.5 * robot.exit_points[:, 2].max()]
    poses = [pose, [pose[0], pose[1], pose[2] + 0.05]]
    answers = [
        robot.inverse(pose, free=free),
        robot.deflection(poses, payload=1, free=free),
        robot.deflection(pose, payload=1, free=free).loaded,
        robot.stiffness(poses, free=free),
        robot.capacity(poses, free=free),
        cdpr.catenary([1.0, 2.0], 1e6, length=5.0, end=[4.0, 1.0]),
        cdpr.catenary(1.0, 1e6, length=5.0, end=[4.0, 1.0]),
    ]
    if free is None:
        answers += [
            robot.path(poses, payload=1, uncertainty={"a": 0.001}),
            robot.path(poses, payload=1, uncertainty={"a": 0.001}).std,
            robot.workspace(plane=("z", pose[2]), grid=(4, 3), payload=1),
            robot.workspace(x=pose[0], y=pose[1], z=(pose[2], pose[2] + 0.2, 3), payload=1),
            robot.boundary(plane=("z", pose[2]), grid=(4, 3), payload=1),
            robot.boundary(x=(-0.5, 0.5, 3), y=(-0.5, 0.5, 3), z=(pose[2], pose[2] + 0.2, 3), payload=1),
        ]
    for answer in answers:
        figure = answer.plot()
        axis = figure.axes[0]
        given = pyplot.figure().add_subplot(projection=axis.name)
        assert answer.plot(ax=given) is given.figure
        for drawn in (axis, given):
            assert drawn.get_ylabel() and (drawn.lines or drawn.patches or drawn.collections), answer
        if axis.name == "3d":
            with pytest.raises(cdpr.InputError, match="ax has the projection 'rectilinear': expected \"3d\""):
                answer.plot(ax=pyplot.figure().add_subplot())
        pyplot.close("all")


def test_a_map_over_powers_of_ten_has_colours_by_them():
    pytest.importorskip("matplotlib").use("svg")
    robot = cdpr.Robot.from_file("cogiro")
    # In a vertical plane it deflects much farther near the height of its exits than at the ground.
    for plane, norm in [(("y", 0.0), "LogNorm"), (("z", 2.0), "Normalize")]:
        found = robot.workspace(plane=plane, grid=(9, 9), payload=50)
        assert type(found.plot().axes[0].collections[0].norm).__name__ == norm


def test_the_wind_blows_on_cables():
    robot = cdpr.Robot.from_file("cogiro")
    one = robot.in_weather([0, 0, 2], [15, 0, 0])
    assert one.drags.shape == (8, 3) and (one.drags[:, 0] > 0).all() and one.displacement[0] > 0
    assert one.force_residual < 1e-6 and one.reasons is None
    several = robot.in_weather([0, 0, 2], [[0, 0, 0], [15, 0, 0], [-15, 0, 0]], payload=[0, 0, 50])
    assert several.magnitude.shape == (3,) and several.magnitude[0] < 1e-8
    assert several.magnitude[1] == one.magnitude and several.magnitude[2] > several.magnitude[1]
    with pytest.raises(cdpr.InputError, match="at most 120 m/s"):
        robot.in_weather([0, 0, 2], [500, 0, 0])
    low = robot.in_weather([0, 0, 2], [15, 0, 0], wind_profile=(0.3, 10))
    assert numpy.linalg.norm(low.drags.sum(axis=0)) < numpy.linalg.norm(one.drags.sum(axis=0))
    with pytest.raises(cdpr.InputError, match="wind_profile.roughness"):
        robot.in_weather([0, 0, 2], [15, 0, 0], wind_profile=(-1, 10))


def test_heat_lengthens_cables_and_ice_loads_them():
    robot = cdpr.Robot.from_file("cogiro")
    hot = robot.in_weather([0, 0, 2], warmer=30, cable_expansion=1.2e-5)
    creeping = robot.in_weather([0, 0, 2], creep=30 * 1.2e-5)
    assert hot.displacement[2] < -1e-3 and numpy.allclose(hot.displacement, creeping.displacement, atol=1e-12)
    assert (robot.in_weather([0, 0, 2], ice=0.01).exit_tensions > hot.exit_tensions).all()
    with pytest.raises(cdpr.InputError, match="warmer"):
        robot.in_weather([0, 0, 2], warmer=30)


def test_derivatives_in_weather_are_those_of_differences():
    robot = cdpr.Robot.from_file("cogiro")

    def at(speed, azimuth, warmer, **more):
        wind = speed * numpy.array([numpy.cos(azimuth), numpy.sin(azimuth), 0])
        return robot.in_weather([0, 0, 2], wind, warmer=warmer, cable_expansion=1.2e-5, payload=20, **more)

    found = at(12, 0.4, 9, slopes=True)
    assert found.slopes.shape == (3, len(found.inputs)) and found.inputs[0] == "mass"
    assert at(12, 0.4, 9).slopes is None and at(12, 0.4, 9).inputs is None
    steps = {"wind": (0.2, 0, 0), "wind_direction": (0, 0.02, 0), "warmer": (0, 0, 1)}
    for name, (speed, azimuth, warmer) in steps.items():
        one, other = (at(12 + k * speed, 0.4 + k * azimuth, 9 + k * warmer).displacement for k in (1, -1))
        difference = (one - other) / (2 * (speed + azimuth + warmer))
        slope = found.slopes[:, found.inputs.index(name)]
        assert numpy.linalg.norm(slope - difference) < 2e-3 * numpy.linalg.norm(difference), name
    with pytest.raises(cdpr.NoSolutionError, match="pulley"):
        cdpr.Robot.from_file("ipanema-3").in_weather([0, 0, 1], [5, 0, 0], slopes=True)


def test_the_platform_rests_when_a_cable_breaks(caroca):
    one = caroca.safety(POSE)
    assert one.broken == [str(i) for i in range(1, 9)] and set(one.endings) == {"held"}
    assert one.moved.shape == (8,) and one.poses.shape == (8, 7) and one.tensions.shape == (8, 8)
    assert (one.moved > 0).all() and (numpy.diag(one.tensions) == 0).all()
    several = caroca.safety([POSE, [0, 0, 1e3]], pairs=True)
    assert several.moved.shape == (2, 36) and several.broken[0][8] == "1+2"
    numpy.testing.assert_array_equal(several.moved[0, :8], one.moved)
    assert several.kinds[0] is None and several.kinds[1] is not None and numpy.isnan(several.moved[1]).all()
    with pytest.raises(cdpr.NoSolutionError):
        caroca.safety([0, 0, 1e3])
    with pytest.raises(cdpr.InputError, match="inertia"):
        caroca.safety(POSE, swing=0.1)


def test_partial_factors_divide_the_breaking_force(caroca):
    factors = {"permanent": 1.0, "variable": 1.0, "resistance": 2.0, "accidental": 1.0}
    found = caroca.safety(POSE, factors=factors)
    assert found.utilization.shape == (9,) and found.utilization_reasons == [""] * 9
    numpy.testing.assert_allclose(found.utilization[1:], 2.0 / found.safety_factor, rtol=1e-12)
    heavy = caroca.safety([POSE, POSE], factors={**factors, "permanent": 1.35, "resistance": (2.0, 1.0)})
    assert heavy.utilization.shape == (2, 9) and heavy.utilization[0, 0] > 1.3 * found.utilization[0]
    numpy.testing.assert_allclose(heavy.utilization[0, 1:], 0.5 * found.utilization[1:], rtol=1e-12)
    assert numpy.isnan(caroca.safety(POSE).utilization).all() and caroca.safety(POSE).utilization_reasons == []
    cogiro = cdpr.Robot.from_file("cogiro").safety([0, 0, 2], factors=factors)
    assert numpy.isnan(cogiro.utilization).all()
    assert set(cogiro.utilization_reasons) == {"no cable has a breaking_force"}
    with pytest.raises(cdpr.InputError, match="accidental"):
        caroca.safety(POSE, factors={"permanent": 1.35, "variable": 1.5, "resistance": 2.0})
    with pytest.raises(cdpr.InputError, match="from 0.1 to 10"):
        caroca.safety(POSE, factors={**factors, "permanent": 135})


def test_the_platform_swings_when_a_cable_breaks():
    robot = cdpr.Robot.from_file("cogiro")
    found = robot.safety([0, 0, 2], swing=0.3)
    assert (found.peak_tension >= found.tensions.max(axis=1) * 0.2).all() and (found.swing_moved > 0).all()
    assert numpy.isnan(robot.safety([0, 0, 2]).peak_tension).all()
    with pytest.raises(cdpr.InputError, match="above 0 s"):
        robot.safety([0, 0, 2], swing=-1)
