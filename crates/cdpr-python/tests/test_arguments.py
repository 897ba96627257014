"""What goes into the calls: arrays of any layout, numbers of NumPy, and what is refused with its name."""

import datetime

import numpy
import pytest

import cdpr
from cdpr.sensitivity import MorrisDesign, SaltelliDesign, SobolDesign, uniform

POSE = [0.0, 0.0, 1.75]
LENGTHS = [4.44, 4.54, 4.36, 4.26, 4.26, 4.36, 4.54, 4.44]


def layouts(values):
    """The same numbers in other layouts of memory, by name."""
    packed = numpy.zeros(len(values), [("id", "i4"), ("value", "f8", values.shape[1:])])
    packed["value"] = values
    yield "packed records", packed["value"]
    yield "unaligned", numpy.frombuffer(b"\0" + values.tobytes(), dtype="f8", offset=1).reshape(values.shape)
    yield "backwards", values[::-1].copy()[::-1]
    yield "every other row", numpy.repeat(values, 2, axis=0)[::2]
    yield "column by column", numpy.asfortranarray(values)
    yield "swapped bytes", values.astype(">f8")
    yield "list", values.tolist()


def test_numbers_are_the_same_however_they_lie_in_memory(caroca):
    payloads = numpy.array([0.0, 10.0, 20.0, 30.0])
    poses = numpy.array(POSE) + numpy.random.default_rng(3).uniform(-0.5, 0.5, (4, 3))
    expected = caroca.deflection(poses, payload=payloads).magnitude
    assert len(set(expected)) == 4
    for (name, payload), (_, pose) in zip(layouts(payloads), layouts(poses)):
        numpy.testing.assert_array_equal(caroca.deflection(pose, payload=payload).magnitude, expected, name)


def test_a_robot_is_the_same_however_its_arrays_lie_in_memory(caroca):
    moduli = numpy.linspace(0.9e11, 1.1e11, 8)
    made = [
        cdpr.Robot(anchors, exits, mass=caroca.mass, section=caroca.section,
                   linear_density=caroca.linear_density, youngs_modulus=modulus, tension_limits=(1.0, 1e4))
        for (_, anchors), (_, exits), (_, modulus) in zip(
            layouts(caroca.anchor_points), layouts(caroca.exit_points), layouts(moduli)
        )
    ]
    assert made[0].youngs_modulus.tolist() == moduli.tolist()
    numpy.testing.assert_array_equal(made[0].anchor_points, caroca.anchor_points)
    assert all(robot == made[0] for robot in made)


def test_designs_take_outputs_however_they_lie_in_memory():
    design = SobolDesign({"x": uniform(0, 1), "y": uniform(0, 2)}, 256, seed=1)
    rows = design.rows()
    outputs = rows[:, 0] + rows[:, 1] ** 2
    expansion = design.expansion(outputs)
    for (name, column), (_, matrix) in zip(layouts(outputs), layouts(rows)):
        assert design.effects(column).effect.tolist() == design.effects(outputs).effect.tolist(), name
        numpy.testing.assert_array_equal(expansion.predict(matrix), expansion.predict(rows), name)


def test_arrays_of_a_wrong_width_raise_however_many_cases_there_are(caroca):
    expected = "expected one value for each of the 8 cables"
    design = SobolDesign({"x": uniform(0, 1)}, 64)
    for call, start in (
        (lambda: caroca.direct(numpy.full((3, 7), 4.4)), f"lengths is a list of 7: {expected}"),
        (lambda: caroca.direct(numpy.empty((0, 7))), f"lengths is a list of 7: {expected}"),
        (lambda: caroca.inverse([POSE] * 3, reference=numpy.zeros(7)),
         f"reference is a list of 7: {expected}"),
        (lambda: caroca.deflection([POSE] * 3, payload=1, tension_offsets=numpy.zeros(9)),
         f"tension_offsets is a list of 9: {expected}"),
        (lambda: design.expansion(numpy.arange(64.0)).predict(numpy.empty((0, 2))),
         "rows has the shape [0, 2]: expected (m, 1)"),
    ):
        with pytest.raises(cdpr.InputError) as raised:
            call()
        assert str(raised.value).startswith(start), str(raised.value)


def test_a_value_that_cannot_be_is_a_row_without_an_answer_and_raises_alone(caroca):
    found = caroca.deflection(POSE, payload=[50, -1, numpy.nan, 50])
    assert found.kinds == [None, "invalid_input", "invalid_input", None]
    assert found.reasons[1] == "payload is -1: expected a mass, zero or more [kg]"
    assert numpy.isnan(found.magnitude).tolist() == [False, True, True, False]
    cables = cdpr.catenary(1, 1e6, length=[4, -4], end=[3, 0])
    assert cables.kinds == [None, "invalid_input"] and numpy.isnan(cables.sag).tolist() == [False, True]
    for call in (
        lambda: caroca.deflection(POSE, payload=-1),
        lambda: caroca.deflection(POSE, payload=numpy.nan),
        lambda: cdpr.catenary(1, 1e6, length=-4, end=[3, 0]),
    ):
        with pytest.raises(cdpr.InputError):
            call()


def test_failures_are_counted_by_their_kinds(caroca):
    found = caroca.inverse([POSE, [9, 0, 1.75], [9, 0, 1.75]])
    assert found.kinds == [None, "infeasible_tension", "infeasible_tension"]
    assert caroca.inverse(POSE).kinds is None
    loaded = caroca.deflection([POSE, [9, 0, 1.75]], payload=50)
    assert loaded.kinds == loaded.loaded.kinds == [None, "infeasible_tension"]


def test_what_is_no_array_of_real_numbers_is_refused_with_its_name(caroca):
    design = SobolDesign({"x": uniform(0, 1)}, 2)
    for call, start in (
        (lambda: caroca.inverse([[0, 0, 1], [0, 0]]), "pose is not an array of numbers ("),
        (lambda: caroca.inverse(["0", "0", "1"]), "pose is an array of <U1: expected real numbers"),
        (lambda: caroca.inverse([0, 0, "up"]), "pose is an array of <U"),
        (lambda: caroca.inverse([0, 0, 1 + 1j]), "pose is an array of complex128: expected real numbers"),
        (lambda: caroca.inverse([object()] * 3), "pose is not an array of numbers ("),
        (lambda: caroca.inverse(POSE, payload=datetime.date(2017, 8, 2)),
         "payload is not an array of numbers ("),
        (lambda: design.effects([1, 2j]), "outputs is an array of complex128"),
        (lambda: cdpr.Robot([[1, 2], [3]], caroca.exit_points, mass=1, section=1, linear_density=1,
                            youngs_modulus=1, tension_limits=(1, 2)),
                             "anchor_points is not an array of numbers ("),
        (lambda: cdpr.Robot(caroca.anchor_points, caroca.exit_points, mass=1, section=1, linear_density=1,
                            youngs_modulus=1, tension_limits=(1, 2, 3)),
                             "tension_limits has the shape [3]: expected 2"),
        (lambda: caroca.workspace(x=(-1, 1, 2.5), y=0, z=1.75, payload=50),
         "x is (-1, 1, 2.5): expected a coordinate [m], or"),
        (lambda: caroca.workspace(x=(-1, 1), y=0, z=1.75, payload=50),
         "x is (-1, 1): expected a coordinate [m], or"),
        (lambda: caroca.workspace(x="left", y=0, z=1.75, payload=50),
         "x is an array of <U4: expected real numbers"),
        (lambda: SobolDesign({"x": uniform(0, 1)}, 8, seed=-1), "seed is -1: expected a whole number from 0"),
        (lambda: SaltelliDesign({"x": uniform(0, 1)}, 16, seed=0.5),
         "seed is 0.5: expected a whole number from 0"),
        (lambda: SobolDesign({"x": uniform(0, 1)}, -8), "points is -8: expected a whole number from 0"),
        (lambda: SaltelliDesign({"x": uniform(0, 1)}, 16, seed=1).indices(numpy.arange(48), seed=-1),
         "seed is -1"),
        (lambda: SobolDesign({"x": {"uniform": object()}}, 8),
         "law of input `x` cannot be written as JSON ("),
    ):
        with pytest.raises(cdpr.InputError) as raised:
            call()
        assert str(raised.value).startswith(start), str(raised.value)


def test_numbers_of_numpy_are_numbers(caroca):
    low, high = numpy.array([0, 1])
    expected = SobolDesign({"x": uniform(0, 1)}, 8).rows()
    for law in (uniform(low, high), uniform(numpy.float32(0), numpy.float32(1))):
        numpy.testing.assert_array_equal(SobolDesign({"x": law}, numpy.int64(8)).rows(), expected)
    content = caroca.to_dict()
    content["platform"]["mass"] = numpy.float32(content["platform"]["mass"])
    content["platform"]["center_of_mass"] = numpy.array(content["platform"]["center_of_mass"])
    assert cdpr.Robot.from_dict(content) == caroca
    alike = [caroca.workspace(x=x, y=numpy.float32(0), z=1.75, payload=50)
             for x in ((-1, 1, 3), [-1, 1, 3], (-1, 1, 3.0), numpy.array([-1, 1, 3]))]
    expected = alike[0].magnitude.tolist()
    assert all(found.magnitude.tolist() == expected and found.shape == (3, 1, 1) for found in alike)


def test_what_does_not_fit_in_memory_raises():
    with pytest.raises(MemoryError, match="does not fit in memory"):
        cdpr.catenary(1.0, 1e6, length=5.0, end=[4.0, 1.0], points=10**14)
    many = {f"x{k}": uniform(0, 1) for k in range(2048)}
    with pytest.raises(MemoryError, match="does not fit in memory"):
        SobolDesign(many, 2**32).rows()
    with pytest.raises(MemoryError, match="does not fit in memory"):
        MorrisDesign(dict(list(many.items())[:1000]), 2**32, seed=1).rows()
    message = "blocks = 4294967296: their points do not fit in memory, ask for fewer"
    with pytest.raises(cdpr.InputError, match=message):
        SaltelliDesign(dict(list(many.items())[:1000]), 2**32)


def test_a_load_is_asked_for_where_it_is_the_question(caroca):
    for call in (lambda: caroca.deflection(POSE), lambda: caroca.observe(POSE, numpy.zeros(62))):
        message = "nothing displaces the platform: expected payload, force or moment"
        with pytest.raises(cdpr.InputError, match=message):
            call()
    assert caroca.deflection(POSE, payload=[0.0, 50.0]).magnitude[0] < 1e-12
    with pytest.raises(TypeError, match="payload"):
        caroca.workspace(plane=("z", 1.75))
    with pytest.raises(cdpr.InputError, match="expected x, y and z, or plane with its grid"):
        caroca.workspace(x=0, y=0, z=1.75, grid=(3, 3), payload=50)
