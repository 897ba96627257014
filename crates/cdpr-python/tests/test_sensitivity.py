"""Designs and estimators on models of Python, against what is known of these."""

import pickle
import threading
import time

import numpy
import pytest

import cdpr
from cdpr.sensitivity import MorrisDesign, SaltelliDesign, SobolDesign, normal, uniform

PI = numpy.pi
ISHIGAMI = {name: uniform(-PI, PI) for name in ("x1", "x2", "x3")}
# The exact shares of the variance: T. Ishigami, T. Homma (1990).
VARIANCE = 7.0**2 / 8 + 0.1 * PI**4 / 5 + 0.01 * PI**8 / 18 + 0.5
FIRST = numpy.array([0.5 * (1 + 0.1 * PI**4 / 5) ** 2, 7.0**2 / 8, 0.0]) / VARIANCE
THIRD = 8 * 0.01 * PI**8 / 225 / VARIANCE
TOTAL = FIRST + numpy.array([THIRD, 0.0, THIRD])


def ishigami(rows):
    x, y, z = rows.T
    return numpy.sin(x) + 7 * numpy.sin(y) ** 2 + 0.1 * z**4 * numpy.sin(x)


def test_sobol_indices_of_ishigamis_function_lie_in_their_intervals():
    design = SaltelliDesign(ISHIGAMI, 2048, seed=3, pairs=True)
    rows = design.rows()
    assert rows.shape == (2048 * 8, 3)
    found = design.indices(ishigami(rows), level=0.999)
    assert found.inputs == ["x1", "x2", "x3"] and found.blocks == 2048
    for interval, exact in ((found.first_interval, FIRST), (found.total_interval, TOTAL)):
        assert numpy.all((interval[:, 0] <= exact + 1e-12) & (exact <= interval[:, 1] + 1e-12))
    for pair, (low, high) in zip(found.pairs, found.second_interval):
        assert low <= (THIRD if pair == ("x1", "x3") else 0.0) <= high, pair


def test_failed_outputs_are_missed_by_the_indices_of_their_input():
    design = SaltelliDesign(ISHIGAMI, 64, seed=3)
    outputs = ishigami(design.rows())
    outputs[7] = numpy.nan
    found = design.indices(outputs)
    assert found.failed_blocks == 1 and found.reliable
    assert found.input_blocks == [64, 62, 64]


def test_intervals_without_a_seed_are_called_an_indication():
    design = SaltelliDesign(ISHIGAMI, 64)
    with pytest.warns(UserWarning, match="indication"):
        assert not design.indices(ishigami(design.rows())).reliable


def test_an_expansion_finds_the_shares_and_predicts():
    design = SobolDesign(ISHIGAMI, 1024, seed=1)
    rows = design.rows()
    found = design.expansion(ishigami(rows), max_degree=10)
    numpy.testing.assert_allclose(found.first, FIRST, atol=5e-3)
    numpy.testing.assert_allclose(found.total, TOTAL, atol=5e-3)
    other = SobolDesign(ISHIGAMI, 64, seed=2).rows()
    numpy.testing.assert_allclose(found.predict(other), ishigami(other), atol=0.2)
    assert found.leave_one_out < 1e-3


def test_effects_of_a_linear_model_are_slopes_times_half_the_range():
    design = SobolDesign({"x": uniform(-1, 1), "y": uniform(0, 4)}, 1024)
    rows = design.rows()
    found = design.effects(3 * rows[:, 0] - 0.5 * rows[:, 1])
    numpy.testing.assert_allclose(found.effect, [3.0, -1.0], atol=0.01)
    assert found.student[0] > found.student[1] > 0


def test_elementary_effects_of_a_linear_model_are_its_slopes():
    design = MorrisDesign({"x": uniform(-1, 1), "y": uniform(0, 4)}, 8, seed=5)
    rows = design.rows()
    assert rows.shape == (24, 2)
    found = design.effects(3 * rows[:, 0] - 0.5 * rows[:, 1])
    numpy.testing.assert_allclose(found.mean, [6.0, -2.0], rtol=1e-12)
    numpy.testing.assert_allclose(found.mean_absolute, [6.0, 2.0], rtol=1e-12)
    assert numpy.all(found.std < 1e-9)


def test_the_same_seed_gives_the_same_rows_and_none_the_plain_sequence():
    law = {"x": normal(0, 1)}
    numpy.testing.assert_array_equal(
        SobolDesign(law, 8, seed=1).rows(), SobolDesign(law, 8, seed=1).rows()
    )
    assert numpy.any(SobolDesign(law, 8, seed=1).rows() != SobolDesign(law, 8, seed=2).rows())
    numpy.testing.assert_array_equal(
        SobolDesign({"x": uniform(0, 1)}, 4).rows()[:, 0], [0.0, 0.5, 0.75, 0.25]
    )


def test_a_design_or_expansion_goes_to_another_process():
    laws = {"x": normal(0.1, 1 / 3), "y": uniform(0, 4)}
    designs = [SobolDesign(laws, 32, seed=7), SobolDesign(laws, 32, first_index=3),
               SaltelliDesign(laws, 16, seed=7), SaltelliDesign(laws, 16, first_index=1, pairs=True),
               MorrisDesign(laws, 4, seed=7)]
    for design in designs:
        copy = pickle.loads(pickle.dumps(design))
        assert repr(copy) == repr(design)
        numpy.testing.assert_array_equal(copy.rows(), design.rows())
    assert repr(designs[2]) == "<cdpr.sensitivity.SaltelliDesign of 2 inputs, 64 rows>"
    rows = designs[0].rows()
    expansion = designs[0].expansion(rows[:, 0] * rows[:, 1])
    copy = pickle.loads(pickle.dumps(expansion))
    numpy.testing.assert_array_equal(copy.predict(rows), expansion.predict(rows))
    assert repr(copy) == repr(expansion)
    assert repr(copy).startswith("<cdpr.sensitivity.Expansion of 2 inputs, variance ")


def test_other_threads_run_while_indices_are_estimated():
    design = SaltelliDesign(ISHIGAMI, 4096, seed=3)
    outputs = ishigami(design.rows())
    done, ticks = threading.Event(), []

    def tick():
        while not done.wait(0.01):
            ticks.append(time.monotonic())

    thread = threading.Thread(target=tick)
    thread.start()
    begun = time.monotonic()
    design.indices(outputs, resamples=500_000)
    ended = time.monotonic()
    done.set()
    thread.join()
    assert sum(begun < moment < ended for moment in ticks) >= 5, ended - begun


def test_an_invalid_law_or_number_is_refused():
    for call, start in (
        (lambda: SobolDesign({"x": {"uniform": {"min": 1}}}, 8), "law of input `x`: line 1"),
        (lambda: SobolDesign({"x": uniform(1, 0)}, 8), "input `x`: max = 0: expected"),
        (lambda: SobolDesign({"x": normal(0, 1)}, 8), "input `x` is unbounded below"),
        (lambda: SobolDesign({"x": uniform(0, 1)}, 8).effects([1.0]), "outputs: length 1, expected 8"),
        (lambda: SobolDesign({}, 8), "dimensions = 0: expected 1 to 2048"),
    ):
        with pytest.raises(cdpr.InputError) as raised:
            call()
        assert str(raised.value).startswith(start), str(raised.value)


def test_a_design_over_the_parameters_of_a_robot_finds_what_its_derivatives_say(caroca):
    laws = {"mass": uniform(170.0, 190.0), "youngs_modulus": uniform(0.9e11, 1.1e11)}
    nominal = {name: 0.5 * (law["uniform"]["min"] + law["uniform"]["max"]) for name, law in laws.items()}
    design = SobolDesign(laws, 128, seed=1)
    outputs = [
        caroca.with_parameters(dict(zip(laws, row))).deflection([0, 0, 1.75], payload=50).magnitude
        for row in design.rows()
    ]
    found = design.effects(outputs)
    slopes = caroca.with_parameters(nominal).derivatives([0, 0, 1.75], payload=50)
    halves = [0.5 * (law["uniform"]["max"] - law["uniform"]["min"]) for law in laws.values()]
    expected = [slopes.magnitude[slopes.inputs.index(name)] * half for name, half in zip(laws, halves)]
    # 1/E is not linear over 10 %: its third order is 0.5 % of the largest effect, and the points are out of
    # balance by about as much.
    numpy.testing.assert_allclose(found.effect, expected, atol=0.01 * numpy.abs(expected).max())
