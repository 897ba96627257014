"""Which answers are frames of pandas and figures of matplotlib, and why the others are not."""

import inspect

import numpy
import pytest
from test_documentation import MODULES

import cdpr
from cdpr import _core, _figures

#: Classes without `to_dataframe`, and why.
WITHOUT_FRAME = {
    "cdpr.Observer": "makes answers",
    "cdpr.Robot": "is asked about",
    "cdpr._core.Expansion": "native half of the class of sensitivity",
    "cdpr._core.Morris": "native half of MorrisDesign",
    "cdpr._core.Saltelli": "native half of SaltelliDesign",
    "cdpr._core.Sample": "native half of the other designs",
    "cdpr._core.Shapley": "native half of ShapleyDesign",
    "cdpr.assess.Finding": "a sentence; pandas makes a frame of a list of them",
    "cdpr.assess.FrictionFit": "single values",
    "cdpr.calibration.Quality": "single values; the frame of a Plan has them by pose",
    "cdpr.exchange.Exported": "texts",
    "cdpr.exchange.Imported": "a robot and sentences",
    "cdpr.exchange.Note": "a sentence",
}

#: Classes without `plot`, and why.
WITHOUT_FIGURE = {
    **WITHOUT_FRAME,
    "cdpr.Cable": "single values",
    "cdpr.Derivatives": "inputs have different units",
    "cdpr.MotionState": "single values",
    "cdpr.MotionSummary": "single values; the Motion is drawn",
    "cdpr.MoveSummary": "single values; the Move is drawn",
    "cdpr.calibration.Campaign": "columns have different units",
    "cdpr.sensitivity.HaltonDesign": "a dimension for each input",
    "cdpr.sensitivity.LatinHypercubeDesign": "a dimension for each input",
    "cdpr.sensitivity.MorrisDesign": "a dimension for each input",
    "cdpr.sensitivity.RandomDesign": "a dimension for each input",
    "cdpr.sensitivity.SaltelliDesign": "a dimension for each input",
    "cdpr.sensitivity.ShapleyDesign": "a dimension for each input",
    "cdpr.sensitivity.SobolDesign": "a dimension for each input",
    "cdpr.study.Results": "each sampling has its figure",
}


def classes():
    """All classes but exceptions by their names: the public ones, then those of the native half alone."""
    found = {}
    for module in [*MODULES, _core]:
        for name in module.__all__:
            of = getattr(module, name)
            is_class = inspect.isclass(of) and name != "Law" and not issubclass(of, Exception)
            if is_class and of not in found.values():
                found[f"{module.__name__}.{name}"] = of
    return found


@pytest.mark.parametrize("method, without", [("to_dataframe", WITHOUT_FRAME), ("plot", WITHOUT_FIGURE)])
def test_an_answer_is_a_frame_and_a_figure_unless_a_list_says_why_not(method, without):
    found = classes()
    assert len(found) > 60
    assert {name for name, of in found.items() if not hasattr(of, method)} == set(without)


def test_figures_are_drawn_in_axes_that_are_given():
    for name, of in classes().items():
        if hasattr(of, "plot"):
            ax = inspect.signature(of.plot).parameters["ax"]
            assert ax.kind is ax.KEYWORD_ONLY and ax.default is None, name


def test_each_native_answer_with_a_figure_has_a_rule_of_drawing():
    native = {name for name in _core.__all__ if hasattr(getattr(_core, name), "plot")}
    assert native == {*_figures._DRAWN, *_figures._SPECIAL}


def test_answers_of_assessments_plans_and_tables_are_drawn_in_their_own_figure_or_in_another_one():
    matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    matplotlib.use("svg")
    from matplotlib import pyplot

    robot, rows = cdpr.Robot.from_file("cogiro"), numpy.random.default_rng(1).uniform(size=(50, 2))
    poses = [[x, y, 2] for x in (-1, 0, 1) for y in (-1, 1)]
    known = {"uncertainty": {"a": 0.002}, "noise": {"position": 1e-4, "rotation": 1e-4}}
    for answer, axes in (
        (cdpr.analyse(rows, rows @ [1, 2]), 2),
        (cdpr.assess.hysteresis(cdpr.Robot.from_file("caroca-law"), [0, 0, 1.75], 50, steps=3), 1),
        (cdpr.assess.robustness(robot, poses=2), 1),
        (cdpr.calibration.plan(robot, poses, count=3, **known), 1),
        (cdpr.calibration.identify(robot, poses, **known).identifiable[0], 1),
    ):
        figure, given = answer.plot(), pyplot.figure().add_subplot()
        assert len(figure.axes) == axes and answer.plot(ax=given) is given.figure
        assert given.figure.axes == [given] and (given.lines or given.patches), answer
        pyplot.close("all")
