"""Analyses of tables, against what is known of their models."""

import numpy
import pytest

import cdpr

PI = numpy.pi


def table(rows, seed=1):
    x = numpy.random.default_rng(seed).uniform(-PI, PI, (rows, 4))
    return x, numpy.sin(x[:, 0]) + 7 * numpy.sin(x[:, 1]) ** 2 + 0.1 * x[:, 2] ** 4 * numpy.sin(x[:, 0])


def test_ishigamis_function_is_recognized_from_its_rows_alone():
    x, y = table(2000)
    found = cdpr.analyse(x, y)
    exact = numpy.array([0.3139, 0.4424, 0.0, 0.0])
    half = 0.5 * (found.first_interval[:, 1] - found.first_interval[:, 0])
    assert numpy.all(numpy.abs(found.first - exact) < 2 * half) and numpy.all(half < 0.1)
    numpy.testing.assert_allclose(found.expansion_total, [0.5576, 0.4424, 0.2437, 0.0], atol=0.02)
    assert numpy.all(found.p_value[:3] < 1e-3) and found.p_value[3] > 1e-3
    assert found.delta[3] < 2 * found.delta_noise[3] and found.pawn[1] > found.pawn_noise[1]
    # x2 has 0.42.
    assert 0.3 < found.delta_at_least[1] < 0.42 and numpy.all(found.delta_at_least <= found.delta)
    assert len(repr(found)) < 400 and "x2" in repr(found)


def test_names_come_from_pandas_or_from_a_problem_of_salib():
    pandas = pytest.importorskip("pandas")
    x, y = table(100)
    frame = pandas.DataFrame(x, columns=list("abcd"))
    found = cdpr.analyse(frame, pandas.Series(y, name="height"))
    assert found.inputs == list("abcd") and found.output == "height"
    assert list(found.to_dataframe().index) == list("abcd")
    problem = {"num_vars": 4, "names": ["p", "q", "r", "s"], "bounds": [[-PI, PI]] * 4}
    several = cdpr.analyse(x, numpy.stack([y, -y], axis=1), problem=problem)
    assert list(several) == ["y1", "y2"] and several["y1"].inputs == problem["names"]
    numpy.testing.assert_allclose(several["y1"].effect, -several["y2"].effect)


def test_failures_are_counted_and_a_limit_shows_its_cause():
    x, y = table(400)
    y[x[:, 0] > 2.6] = numpy.nan
    x[7, 2] = numpy.inf
    found = cdpr.analyse(x, y, limit=("<", 9.0))
    assert found.left_out == 1
    assert found.summary["failed"] + found.summary["count"] == 399
    assert found.content["limit"]["count"] == numpy.sum(numpy.delete(y, 7) >= 9.0)
    assert numpy.isfinite(found.target).all() and found.target_p_value[3] > 1e-3
    assert found.content["inputs"][0]["failure"]["p_value"] < 0.01


def test_wrong_tables_are_refused():
    x, y = table(50)
    for wrong in (
        lambda: cdpr.analyse(x, y[:-1]),
        lambda: cdpr.analyse(x, y, names=["a"]),
        lambda: cdpr.analyse(x, numpy.ones(50)),
        lambda: cdpr.analyse(x, y, limit=("=", 1.0)),
        lambda: cdpr.analyse(x, y[:, None, None]),
    ):
        with pytest.raises(cdpr.InputError):
            wrong()


def test_texts_are_categories_and_the_verdict_is_that_of_the_program():
    generator = numpy.random.default_rng(2)
    a, colour = generator.uniform(size=300), generator.choice(["red", "blue", "green"], 300)
    x = numpy.array([a, colour, generator.uniform(size=300)], dtype=object).T
    found = cdpr.analyse(x, 2 * a + 3 * (colour == "blue"), names=["a", "colour", "inert"])
    assert sorted(found.certain) == ["a", "colour"] and found.related == {}
    assert found.verdict.startswith("2 of 3 inputs are certain to matter: ")
    levels = found.content["inputs"][1]["levels"]
    assert [level["level"] for level in levels] == ["blue", "green", "red"]
    assert numpy.isnan(found.effect[1]) and not numpy.isnan(found.effect[0])


def test_a_constant_column_has_no_measure_and_is_a_condition():
    x = numpy.random.default_rng(3).uniform(size=(60, 2))
    x[:, 1] = 4.0
    found = cdpr.analyse(x, x[:, 0])
    assert numpy.isnan(found.effect[1]) and numpy.isnan(found.first[1]) and numpy.isnan(found.p_value[1])
    assert "constant" in found.conditions[0]
