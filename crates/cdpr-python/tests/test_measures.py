"""Measures of sensitivity against exact values of linear models and of Ishigami's function."""

import pickle

import numpy
import pytest

import cdpr
from cdpr import sensitivity
from cdpr.sensitivity import (
    HaltonDesign,
    LatinHypercubeDesign,
    MorrisDesign,
    RandomDesign,
    SaltelliDesign,
    ShapleyDesign,
    SobolDesign,
    normal,
    uniform,
)
from test_sensitivity import FIRST, ISHIGAMI, PI, THIRD, TOTAL, ishigami

SAMPLES = [
    lambda laws, points, **more: SobolDesign(laws, points, seed=1, **more),
    lambda laws, points, **more: HaltonDesign(laws, points, seed=1, **more),
    lambda laws, points, **more: LatinHypercubeDesign(laws, points, seed=1, **more),
    lambda laws, points, **more: LatinHypercubeDesign(laws, points, seed=1, centred=True, **more),
    lambda laws, points, **more: RandomDesign(laws, points, seed=1, **more),
]
LINEAR = {"a": uniform(-1, 3), "b": normal(0, 0.5)}


def gradients(rows):
    """Derivatives of Ishigami's function."""
    x, y, z = rows.T
    by_x, by_z = (1 + 0.1 * z**4) * numpy.cos(x), 0.4 * z**3 * numpy.sin(x)
    return numpy.stack([by_x, 14 * numpy.sin(y) * numpy.cos(y), by_z], axis=1)


@pytest.mark.parametrize("make", SAMPLES)
def test_a_linear_model_has_its_coefficients_on_every_sample(make):
    design = make(LINEAR, 1000)
    rows = design.rows()
    assert rows.shape == (len(design), 2) and design.to_dataframe().shape == rows.shape
    copy = pickle.loads(pickle.dumps(design))
    assert repr(copy) == repr(design) and copy.inputs == design.inputs
    numpy.testing.assert_array_equal(copy.rows(), rows)
    assert numpy.any(design.replicate(2).rows() != rows)
    outputs = 3 * rows[:, 0] - 2 * rows[:, 1]
    found = design.regression(outputs)
    expected = numpy.array([3, -2]) * rows.std(axis=0) / outputs.std()
    numpy.testing.assert_allclose(found.standardized, expected, rtol=1e-9)
    numpy.testing.assert_allclose(found.share, expected**2, rtol=1e-9)
    assert found.r_squared == pytest.approx(1.0, abs=1e-12) and found.failed == 0
    # exp keeps the order of the outputs, but is not linear.
    bent = numpy.exp(outputs)
    assert design.regression(bent).r_squared < 0.9
    numpy.testing.assert_allclose(
        design.regression(bent, ranks=True).standardized,
        design.regression(outputs, ranks=True).standardized,
        rtol=1e-12,
    )
    # b (max - min) / 2, and for a normal law 2 b std sqrt(2 / pi).
    exact = [3 * 2, -2 * 2 * 0.5 * numpy.sqrt(2 / PI)]
    numpy.testing.assert_allclose(design.effects(outputs).effect, exact, atol=0.7)


def test_a_centred_latin_hypercube_has_the_middles_of_its_cells():
    rows = LatinHypercubeDesign({"x": uniform(0, 1)}, 8, seed=4, centred=True).rows()
    numpy.testing.assert_allclose(sorted(rows[:, 0]), (numpy.arange(8) + 0.5) / 8)


@pytest.mark.parametrize("make", SAMPLES)
def test_correlated_inputs_have_their_correlation_and_no_effects(make):
    laws = {"a": normal(0, 1), "b": normal(2, 3)}
    design = make(laws, 4096, correlation={("a", "b"): 0.6})
    rows = design.rows()
    assert numpy.corrcoef(rows.T)[0, 1] == pytest.approx(0.6, abs=0.05)
    numpy.testing.assert_array_equal(make(laws, 4096, correlation=[[1, 0.6], [0.6, 1]]).rows(), rows)
    assert design.regression(rows[:, 0]).standardized == pytest.approx([1, 0], abs=1e-9)
    with pytest.raises(cdpr.InputError, match="correlation is given: `effects` expects independent inputs"):
        design.effects(rows[:, 0])


def test_groups_have_the_indices_of_all_their_inputs():
    groups = {"outer": ["x1", "x3"], "inner": ["x2"]}
    design = SaltelliDesign(ISHIGAMI, 1024, seed=5, groups=groups)
    assert len(design) == 1024 * 4
    found = design.indices(ishigami(design.rows()), level=0.999)
    assert found.inputs == ["outer", "inner"]
    # x2 takes part in no interaction: S = T for both groups.
    exact = numpy.array([1 - FIRST[1], FIRST[1]])
    for interval in (found.first_interval, found.total_interval):
        assert numpy.all((interval[:, 0] <= exact) & (exact <= interval[:, 1]))
    assert pickle.loads(pickle.dumps(design)).rows().tolist() == design.rows().tolist()
    expansion = SobolDesign(ISHIGAMI, 1024, seed=1)
    expansion = expansion.expansion(ishigami(expansion.rows()), max_degree=10)
    assert expansion.group(["x1", "x3"]) == pytest.approx((1 - FIRST[1], 1 - FIRST[1]), abs=5e-3)
    pairs = dict(zip(expansion.pairs, expansion.second))
    assert pairs["x1", "x3"] == pytest.approx(THIRD, abs=5e-3)


@pytest.mark.parametrize("levels", [None, 4])
def test_elementary_effects_of_a_linear_model_are_its_coefficients_times_the_ranges(levels):
    laws = {"a": uniform(0, 2), "b": uniform(-1, 0), "c": uniform(5, 6)}
    design = MorrisDesign(laws, 8, seed=2, levels=levels)
    found = design.effects(design.rows() @ [1.5, -4.0, 0.0])
    numpy.testing.assert_allclose(found.mean, [3, -4, 0], atol=1e-9)
    numpy.testing.assert_allclose(found.mean_absolute, [3, 4, 0], atol=1e-9)
    numpy.testing.assert_allclose(found.std, 0, atol=1e-9)
    grouped = MorrisDesign(laws, 8, seed=2, levels=levels, groups={"ab": ["a", "b"], "c": ["c"]})
    found = grouped.effects(grouped.rows() @ [1.5, -4.0, 0.0])
    assert found.inputs == ["ab", "c"] and found.mean_absolute[0] > 0 and found.mean_absolute[1] < 1e-9


def test_shapley_effects_of_correlated_normal_inputs_are_owen_and_prieurs():
    # A. B. Owen, C. Prieur, On Shapley value for measuring importance of dependent inputs (2017), section 3.
    a, b, rho = 2.0, 1.0, 0.5
    laws, pair = {"a": normal(0, 1), "b": normal(0, 1)}, {("a", "b"): rho}
    design = ShapleyDesign(laws, 4000, seed=3, correlation=pair)
    found = design.effects(design.rows() @ [a, b], level=0.999)
    variance = a * a + b * b + 2 * rho * a * b
    joint = rho * a * b + 0.5 * rho**2 * (b * b - a * a)
    exact = numpy.array([a * a + joint, b * b + rho * a * b + 0.5 * rho**2 * (a * a - b * b)]) / variance
    assert exact.sum() == pytest.approx(1.0)
    assert numpy.all((found.effect_interval[:, 0] <= exact) & (exact <= found.effect_interval[:, 1]))
    assert found.effect.sum() == pytest.approx(1.0)
    grouped = ShapleyDesign(laws, 16, seed=3, correlation=pair, groups={"both": ["a", "b"]})
    assert grouped.effects(grouped.rows() @ [a, b]).effect == pytest.approx([1.0])


def test_gradients_bracket_the_indices():
    design = SobolDesign(ISHIGAMI, 1024, seed=6)
    rows = design.rows()
    outputs, slopes = ishigami(rows), gradients(rows)
    found = design.brackets(outputs, slopes, level=0.999)
    assert numpy.all(found.first_lower_interval[:, 0] <= FIRST + 1e-12)
    assert numpy.all(found.total_lower_interval[:, 0] <= TOTAL + 1e-12)
    assert numpy.all(TOTAL <= found.total_upper_interval[:, 1])
    assert numpy.all(found.total_lower <= found.total_upper)
    measures = design.derivative_measures(outputs, slopes)
    # E (df/dx2)^2 = 7^2 / 2.
    assert measures.mean_square[1] == pytest.approx(24.5, rel=0.01)
    numpy.testing.assert_allclose(
        measures.total_bound, 4 * measures.mean_square / outputs.var(ddof=1), rtol=1e-9
    )  # (2 pi)^2 / pi^2
    slopes[3, 1] = numpy.nan
    assert design.derivative_measures(outputs, slopes).failed == 1


def test_poincares_bound_is_the_total_index_of_a_linear_model_of_normal_inputs():
    design = RandomDesign({"a": normal(0, 2), "b": normal(1, 1)}, 200, seed=1)
    rows = design.rows()
    outputs = rows @ [1.0, 3.0]
    found = design.derivative_measures(outputs, numpy.tile([1.0, 3.0], (200, 1)))
    numpy.testing.assert_allclose(found.total_bound, [4 / outputs.var(ddof=1), 9 / outputs.var(ddof=1)])


def test_an_output_along_one_direction_has_one_active_direction():
    design = SobolDesign({name: normal(0, std) for name, std in (("a", 1), ("b", 2), ("c", 1))}, 256, seed=1)
    w = numpy.array([2.0, 0.5, 0.0])
    along = design.rows() @ w
    found = design.active_subspace(numpy.sin(along), numpy.cos(along)[:, None] * w, shares=[0.9])
    direction = w * [1, 2, 1] / numpy.linalg.norm(w * [1, 2, 1])
    assert abs(found.directions[0] @ direction) == pytest.approx(1.0)
    numpy.testing.assert_allclose(found.eigenvalues[1:], 0, atol=1e-12)
    numpy.testing.assert_allclose(found.activity, direction**2, atol=1e-12)
    assert list(found.needed[0.9]) == [1, 1, 1]


def test_generalized_indices_are_shares_of_the_trace():
    design = SaltelliDesign({"a": uniform(0, 1), "b": uniform(0, 1)}, 512, seed=2)
    a, b = design.rows().T
    found = design.vector_indices(numpy.stack([a, 2 * b], axis=1), level=0.999)
    for low, high in (found.first_interval[0], found.total_interval[0]):
        assert low <= 0.2 <= high
    assert found.variance == pytest.approx(5 / 12, rel=0.05)


def test_several_outputs_have_results_of_their_own():
    pandas = pytest.importorskip("pandas", reason="pandas is not installed")
    design = SobolDesign(LINEAR, 64, seed=1)
    rows = design.rows()
    one, two = rows @ [1.0, 2.0], rows @ [3.0, 0.0]
    alone = design.effects(one).effect
    for several, names in (
        ({"u": one, "v": two}, ["u", "v"]),
        (numpy.stack([one, two], axis=1), ["y1", "y2"]),
        (pandas.DataFrame({"u": one, "v": two}), ["u", "v"]),
        ([[a, b] for a, b in zip(one, two)], ["y1", "y2"]),
    ):
        found = design.effects(several)
        assert list(found) == names
        numpy.testing.assert_array_equal(found[names[0]].effect, alone)
    slopes = numpy.tile([[[1.0, 2.0], [3.0, 0.0]]], (64, 1, 1))
    found = design.derivative_measures(numpy.stack([one, two], axis=1), slopes)
    numpy.testing.assert_allclose(found["y2"].mean_square, [9, 0])
    found = design.derivative_measures({"u": one}, {"u": slopes[:, 0]})
    numpy.testing.assert_allclose(found["u"].mean_square, [1, 4])


def test_effects_of_replicates_have_intervals():
    designs = [SobolDesign(LINEAR, 128, seed=seed) for seed in range(8)]
    outputs = [design.rows() @ [3.0, -2.0] for design in designs]
    found = sensitivity.effect_intervals(list(zip(designs, outputs)), level=0.999)
    exact = numpy.array([6, -2 * numpy.sqrt(2 / PI)])
    assert numpy.all((found.effect_interval[:, 0] <= exact) & (exact <= found.effect_interval[:, 1]))
    with pytest.raises(cdpr.InputError, match="replicate 1: expected a seed that no other replicate has"):
        sensitivity.effect_intervals([(designs[0], outputs[0])] * 2)


def test_convergence_ends_with_the_indices_of_all_blocks():
    design = SaltelliDesign(ISHIGAMI, 512, seed=3)
    outputs = ishigami(design.rows())
    steps = design.convergence(outputs)
    assert [step.blocks for step in steps] == [64, 128, 256, 512]
    numpy.testing.assert_array_equal(steps[-1].total, design.indices(outputs).total)
    half = design.resized(256)
    numpy.testing.assert_array_equal(half.rows(), design.rows()[: len(half)])


def all_results():
    saltelli = SaltelliDesign(ISHIGAMI, 64, seed=3, pairs=True)
    sample = SobolDesign(ISHIGAMI, 128, seed=3)
    rows = sample.rows()
    outputs, slopes = ishigami(rows), gradients(rows)
    drawn = LatinHypercubeDesign(ISHIGAMI, 128, seed=3).rows()
    morris, shapley = MorrisDesign(ISHIGAMI, 8, seed=1), ShapleyDesign(ISHIGAMI, 64, seed=1)
    return [
        saltelli.indices(ishigami(saltelli.rows())),
        sample.effects(outputs),
        sample.regression(outputs),
        sample.expansion(outputs),
        sample.gradient_expansion(outputs, slopes),
        sensitivity.wasserstein_bures(drawn, numpy.stack([ishigami(drawn), drawn[:, 1]], axis=1)),
        sample.brackets(outputs, slopes),
        sample.derivative_measures(outputs, slopes),
        sample.active_subspace(outputs, slopes),
        morris.effects(ishigami(morris.rows())),
        shapley.effects(ishigami(shapley.rows())),
        sensitivity.fit(outputs),
    ]


@pytest.mark.parametrize("found", all_results(), ids=lambda found: type(found).__name__)
def test_every_result_prints_numbers_and_goes_to_pandas_and_matplotlib(found):
    pytest.importorskip("pandas", reason="pandas is not installed")
    matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    matplotlib.use("svg")
    from matplotlib import pyplot

    frame = found.to_dataframe()
    assert list(frame.index) == found.inputs and frame.shape[1] >= 1
    # What is shown first is the largest, with its number.
    name = found._drawn[0]
    largest = frame[name].abs().idxmax()
    assert f"{largest} {name} {frame[name][largest]:.4g}" in repr(found)
    for figure in (found.plot(), found.plot(ax=pyplot.figure().add_subplot())):
        labels = [text.get_text() for text in figure.axes[0].get_yticklabels()]
        assert sorted(labels) == sorted(found.inputs)
    pyplot.close("all")
    copy = pickle.loads(pickle.dumps(found))
    assert repr(copy) == repr(found)
    for field in (name for name in dir(type(found)) if not name.startswith("_")):
        assert getattr(type(found), field).__doc__, field


def test_gradients_bring_an_expansion_nearer():
    design = SobolDesign({"x": uniform(0, 1), "y": normal(0, 0.3), "z": uniform(0, 2)}, 20, seed=1)
    x, y, z = design.rows().T
    outputs = numpy.exp(x + y) / (1 + z)
    slopes = numpy.stack([outputs, outputs, -outputs / (1 + z)], axis=1)
    many = SobolDesign(design.inputs, 4096, seed=2)
    x, y, z = many.rows().T
    exact = many.expansion(numpy.exp(x + y) / (1 + z)).total
    plain, found = design.expansion(outputs), design.gradient_expansion(outputs, slopes)
    assert found.derivatives and not plain.derivatives
    errors = [numpy.abs(of.total - exact).max() for of in (found, plain)]
    assert 3 * errors[0] < errors[1], errors
    slopes[3] = numpy.nan
    assert design.gradient_expansion(outputs, slopes).failed == 1


def test_the_law_of_a_vector_moves_by_the_exact_index_of_a_linear_model():
    rows = RandomDesign({name: normal(0, 1) for name in "abcd"}, 8192, seed=1).rows()
    a, b, c, _ = rows.T
    vectors = numpy.stack([3 * a + 4 * b, 2 * c], axis=1)
    found = sensitivity.wasserstein_bures(rows, vectors, list("abcd"))
    # Variances 25 and 4; 16 or 9 of the first are left.
    exact, means = [5 / 29, 10 / 29, 4 / 29, 0], [9 / 58, 16 / 58, 4 / 58, 0]
    numpy.testing.assert_allclose(found.index, exact, atol=0.02)
    numpy.testing.assert_allclose(found.means, means, atol=0.02)
    assert found.inputs == list("abcd") and (found.index_interval[:, 0] < found.index).all()
    assert sensitivity.wasserstein_bures(rows[:200], vectors[:200]).inputs == ["x1", "x2", "x3", "x4"]
    for call, said in (
        (lambda: sensitivity.wasserstein_bures(rows, vectors[:-1]), "rows has 8192 rows and outputs 8191"),
        (lambda: sensitivity.wasserstein_bures(rows, vectors, ["a"]), "names has 1 names: expected 4"),
        (lambda: sensitivity.wasserstein_bures(rows[:9], vectors[:9]), "observed outputs = 9: expected at least 64"),
    ):
        with pytest.raises(cdpr.InputError, match=said):
            call()


def test_a_mean_of_effects_that_rests_on_few_is_not_called_reliable():
    design = MorrisDesign({f"x{i}": uniform(0, 1) for i in range(10)}, 64, seed=1, levels=4)
    products = numpy.cumprod(design.rows(), axis=1)
    found = design.effects((products * (-1.0) ** numpy.arange(10)).sum(axis=1))
    assert found.reliable[0] == 1 and found.reliable[9] == 0


def test_wrong_arguments_are_named_with_their_values():
    design = SobolDesign(ISHIGAMI, 64, seed=1)
    outputs = ishigami(design.rows())
    slopes = gradients(design.rows())
    for call, said in (
        (lambda: SobolDesign([1, 2], 8), r"inputs is \[1, 2\]: expected a dictionary of laws"),
        (lambda: SobolDesign(ISHIGAMI, -1), "points is -1: expected a whole number"),
        (lambda: RandomDesign(ISHIGAMI, 8, seed=1.5), "seed is 1.5: expected a whole number"),
        (lambda: RandomDesign(ISHIGAMI, 8, seed=None), "seed is None"),
        (lambda: SobolDesign(ISHIGAMI, 8, first_index=1, seed=1), "first_index is 1: expected 0"),
        (lambda: SobolDesign(ISHIGAMI, 8, seed=1, correlation=[[1]]), r"correlation has the shape \(1, 1\)"),
        (lambda: SobolDesign(ISHIGAMI, 8, seed=1, correlation={("x1", "z"): 0.1}), "correlation has 'z'"),
        (
            lambda: SobolDesign(ISHIGAMI, 8, seed=1, correlation={("x1", "x2"): 2.0}),
            r"correlation\[0\]\[1\] = 2|correlation\[1\]\[",
        ),
        (lambda: SaltelliDesign(ISHIGAMI, 16, groups={"g": ["z"]}), "group `g` has 'z': expected names"),
        (lambda: MorrisDesign(ISHIGAMI, 4, seed=1, levels=3), "levels = 3: expected an even number"),
        (lambda: ShapleyDesign(ISHIGAMI, 1, seed=1), "walks = 1: expected at least 2"),
        (lambda: design.effects(outputs[:-1]), "outputs: length 63, expected 64"),
        (lambda: design.effects([[1.0], [1.0, 2.0]]), "outputs is not an array of numbers"),
        (lambda: design.expansion(outputs, norm=2.0), "norm = 2: expected a number above 0"),
        (lambda: design.brackets(outputs, slopes[:, :2]), r"gradients has the shape \[64, 2\]"),
        (lambda: design.brackets(outputs, slopes, level=1.0), "level = 1: expected a number between 0 and 1"),
        (lambda: design.active_subspace(outputs, slopes, shares=[1.5]), "share = 1.5"),
        (lambda: design.active_subspace(outputs, slopes, resamples=0), "resamples = 0"),
    ):
        with pytest.raises(cdpr.InputError, match=said):
            call()
