"""Laws, fits and SALib's problems."""

import math

import numpy
import pytest

import cdpr
from cdpr import sensitivity
from cdpr.sensitivity import MorrisDesign, RandomDesign, SaltelliDesign, SobolDesign

LAWS = {
    "uniform": (sensitivity.uniform(1, 3), 2, 2 / math.sqrt(12)),
    "normal": (sensitivity.normal(-1, 2), -1, 2),
    "truncated": (sensitivity.truncated_normal(0, 1, -1, 1), 0, 0.539560),
    "triangular": (sensitivity.triangular(0, 1, 2), 1, math.sqrt(1 / 6)),
    "beta": (sensitivity.beta(2, 2, 0, 1), 0.5, math.sqrt(0.05)),
    "lognormal": (sensitivity.lognormal(0.5, 0.25), math.exp(0.53125), math.exp(0.53125) * math.sqrt(math.expm1(0.0625))),
    "weibull": (sensitivity.weibull(2, 1), math.gamma(1.5), math.sqrt(1 - math.gamma(1.5) ** 2)),
    "exponential": (sensitivity.exponential(3), 3, 3),
    "logistic": (sensitivity.logistic(1, 2), 1, 2 * math.pi / math.sqrt(3)),
    "gumbel": (sensitivity.gumbel(0, 1), 0.5772156649, math.pi / math.sqrt(6)),
    "laplace": (sensitivity.laplace(1, 2), 1, math.sqrt(8)),
}


@pytest.mark.parametrize("name", LAWS)
def test_a_law_has_its_moments_and_its_density_is_the_slope_of_its_distribution(name):
    law, mean, std = LAWS[name]
    assert sensitivity.mean(law) == pytest.approx(mean, rel=1e-6, abs=1e-9)
    assert sensitivity.std(law) == pytest.approx(std, rel=1e-5)
    u = numpy.array([[0.05, 0.3], [0.6, 0.9]])
    x = sensitivity.quantile(law, u)
    assert x.shape == u.shape
    numpy.testing.assert_allclose(sensitivity.cdf(law, x), u, atol=1e-9)
    step = 1e-4
    slope = (sensitivity.cdf(law, x + step) - sensitivity.cdf(law, x - step)) / (2 * step)
    numpy.testing.assert_allclose(sensitivity.pdf(law, x), slope, rtol=1e-4)
    rows = RandomDesign({"x": law}, 20_000, seed=1).rows()
    assert rows.mean() == pytest.approx(mean, abs=5 * std / math.sqrt(20_000))


def test_steps_round_values_and_poincares_constants_are_known():
    rows = SobolDesign({"x": sensitivity.stepped(sensitivity.uniform(0, 1), 0.25)}, 64).rows()
    assert set(rows[:, 0]) == {0.0, 0.25, 0.5, 0.75, 1.0}
    even = sensitivity.stepped(sensitivity.uniform(0, 1), 0.25, equal_mass=True)
    values, counts = numpy.unique(SobolDesign({"x": even}, 1000, seed=1).rows(), return_counts=True)
    assert len(values) == 5 and numpy.ptp(counts) <= 4
    assert sensitivity.poincare_constant(sensitivity.uniform(0, 2)) == pytest.approx(4 / math.pi**2)
    assert sensitivity.poincare_constant(sensitivity.lognormal(0, 1)) is None


def test_a_sample_of_a_normal_law_is_found_and_a_few_values_are_undecided():
    law = sensitivity.normal(5, 2)
    values = RandomDesign({"x": law}, 400, seed=1).rows()[:, 0]
    found = sensitivity.fit(values)
    assert found.best_family == "normal"
    normal = found.families.index("normal")
    mean, std = found.best["normal"]["mean"], found.best["normal"]["std"]
    assert (mean, std) == pytest.approx((values.mean(), values.std()))
    likelihood = -400 * math.log(std * math.sqrt(2 * math.pi)) - ((values - mean) ** 2).sum() / (2 * std**2)
    assert found.aic[normal] == pytest.approx(4 - 2 * likelihood)
    assert found.p_value[normal] > 0.05 > found.p_value[found.families.index("uniform")]
    assert found.probability.sum() == pytest.approx(1.0)
    assert found.evidence == "decided" and "normal, p = " in repr(found) and " families" in repr(found)
    few = sensitivity.fit(values[:5])
    assert few.evidence == "undecided" and "(undecided)" in repr(few)
    peaks = sensitivity.fit(numpy.concatenate([values, values + 100]))
    assert peaks.evidence == "rejected" and "best of those tried, and rejected (p <= 0.001)" in repr(peaks)
    with pytest.raises(cdpr.InputError, match="no continuous law has such values"):
        sensitivity.fit([0.0, 1.0] * 20)
    only = sensitivity.fit(values, "uniform")
    assert only.families == ["uniform"]
    assert only.best == {"uniform": {"min": values.min(), "max": values.max()}}
    for call, said in (
        (lambda: sensitivity.fit([1.0, 2.0]), "observed outputs = 2: expected at least 3"),
        (lambda: sensitivity.fit([-1.0, 1.0, 2.0], "weibull"), "Weibull law fits positive values only"),
        (lambda: sensitivity.fit(values, "cauchy"), "family: .*cauchy"),
        (lambda: sensitivity.cdf({"uniform": {"min": 1, "max": 0}}, 0), "max = 0: expected"),
        (lambda: sensitivity.quantile(law, 1.5), "u is 1.5: expected a probability"),
    ):
        with pytest.raises(cdpr.InputError, match=said):
            call()


def test_tolerances_are_allocated_as_lagranges_conditions_say():
    # min sum c / s with sum v s^2 = V: v s^3 / c is the same for all that are tightened.
    factors = sensitivity.allocate([4.0, 1.0, 0.0], [1.0, 2.0, 1.0], 2.0)
    assert 4 * factors[0] ** 2 + factors[1] ** 2 == pytest.approx(2.0) and factors[2] == 1
    assert factors[1] == 1 or 4 * factors[0] ** 3 == pytest.approx(0.5 * factors[1] ** 3)
    with pytest.raises(cdpr.InputError, match="target = 0"):
        sensitivity.allocate([1.0], [1.0], 0.0)


PROBLEM = {
    "num_vars": 6,
    "names": ["u", "n", "t", "l", "w", "c"],
    "bounds": [[0, 2], [1, 0.5], [1, 3, 0.25], [0, 0.5], [1.5, 2], [-1, 2, 0, 1]],
    "dists": ["unif", "norm", "triang", "lognorm", "weibull", "truncnorm"],
    "groups": ["a", "a", "b", "b", "b", "c"],
}


def test_a_problem_of_salib_is_laws_and_groups():
    laws = sensitivity.laws_of_problem(PROBLEM)
    # The middle of each law, by its formula: SALib's manual, "non-uniform distributions".
    middles = [sensitivity.quantile(law, 0.5) for law in laws.values()]
    triangle = 3 - math.sqrt(0.5 * 2 * 1.5)  # above the peak at 1.5
    truncated = sensitivity.quantile(
        sensitivity.normal(0, 1), 0.5 * sum(sensitivity.cdf(sensitivity.normal(0, 1), [-1, 2]))
    )
    numpy.testing.assert_allclose(
        middles, [1, 1, triangle, 1, 2 * math.log(2) ** (1 / 1.5), truncated], rtol=1e-9
    )
    design = SobolDesign(PROBLEM, 64, seed=1)
    assert list(design.inputs) == PROBLEM["names"]
    numpy.testing.assert_array_equal(design.rows(), SobolDesign(laws, 64, seed=1).rows())
    assert len(SaltelliDesign(PROBLEM, 16, seed=1)) == 16 * (3 + 2)
    assert len(MorrisDesign(PROBLEM, 16, seed=1)) == 16 * (3 + 1)
    plain = {"num_vars": 2, "names": ["x", "y"], "bounds": [[0, 1], [0, 2]]}
    assert len(SaltelliDesign(plain, 16, seed=1)) == 16 * (2 + 2)
    assert SobolDesign(plain, 8).inputs == {"x": sensitivity.uniform(0, 1), "y": sensitivity.uniform(0, 2)}


def test_rows_of_a_problem_are_those_of_salib():
    sampling = pytest.importorskip("SALib.util", reason="SALib is not installed")
    uniform = {"num_vars": 6, "names": PROBLEM["names"], "bounds": [[0, 1]] * 6}
    points = SobolDesign(uniform, 256, seed=2).rows()
    scaled = sampling._nonuniform_scale_samples(points, PROBLEM["bounds"], PROBLEM["dists"])
    numpy.testing.assert_allclose(SobolDesign(PROBLEM, 256, seed=2).rows(), scaled, rtol=1e-7, atol=1e-9)


def test_a_problem_that_has_no_laws_here_is_refused():
    for change, said in (
        ({"dists": ["logunif"]}, "dists of `x` is 'logunif': expected one of unif.*log x is uniform"),
        ({"dists": ["cauchy"]}, "dists of `x` is 'cauchy': expected one of unif"),
        ({"bounds": [[0, 1, 2]]}, r"bounds of `x` is \[0, 1, 2\]: expected 2 numbers: lower, upper"),
        ({"bounds": [["a", 1]]}, r"bounds of `x` is \['a', 1\]"),
        ({"bounds": [[0, 1], [0, 1]]}, "bounds has the length 2: expected 1, as num_vars"),
        ({"num_vars": 2}, "names has the length 1: expected 2"),
        ({"groups": ["a", "b"]}, "groups has the length 2: expected 1"),
        ({"bounds": [[1, 0]]}, "input `x`: max = 0: expected"),
    ):
        problem = {"num_vars": 1, "names": ["x"], "bounds": [[0, 1]], **change}
        with pytest.raises(cdpr.InputError, match=said):
            SaltelliDesign(problem, 16, seed=1)
    with pytest.raises(cdpr.InputError, match="names is"):
        SobolDesign({"names": ["x", "x"], "bounds": [[0, 1]] * 2}, 8)
