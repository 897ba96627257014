"""The observer of load and cables: the same for one sample and for many, alarms, and what is refused."""

import numpy as np
import pytest

import cdpr

POSE = [0.2, -0.1, 1.75]


@pytest.fixture
def caroca():
    return cdpr.Robot.from_file("caroca")


def test_samples_one_by_one_are_those_of_an_array(caroca):
    found = caroca.deflection(POSE, payload=5)
    rng = np.random.default_rng(1)
    tensions = found.loaded.tensions + 5 * rng.standard_normal((200, 8))
    made = lambda: cdpr.Observer(caroca, found.lengths, POSE, tension_std=5, payload_std=20, center_std=0.1)
    one, many = made(), made()
    samples = many.update(found.lengths, tensions)
    for k, row in enumerate(tensions):
        sample = one.update(found.lengths, row)
        assert sample.payload == samples.payload[k] and sample.alarm == samples.alarm[k] == "none"
    assert abs(samples.payload[-1] - 5) < 4 * samples.payload_std[-1] < 1
    assert samples.center.shape == (200, 3) and np.isnan(samples.center[-1, 2])
    assert np.abs(samples.force[:, 2].mean() + 5 * 9.81) < 3
    assert samples.to_dataframe()["payload_kg"].tolist() == samples.payload.tolist()
    pytest.importorskip("matplotlib", reason="matplotlib is not installed").use("svg")
    for drawn, count in ((samples, 200), (sample, 1)):
        (line,) = drawn.plot().axes[0].lines
        assert len(line.get_ydata()) == count and line.get_ydata()[-1] == samples.payload[-1]


def test_a_cell_that_reads_nothing_more_is_an_alarm(caroca):
    found = caroca.deflection(POSE, payload=5)
    observer = cdpr.Observer(caroca, found.lengths, POSE, tension_std=[2] * 8, payload_std=20)
    zero = np.linspace(-20, 20, 8)
    observer.tare([found.lengths] * 10, found.unloaded.tensions + zero)
    assert observer.update([found.lengths] * 10, found.loaded.tensions + zero).alarm == ["none"] * 10
    tensions = found.loaded.tensions + zero
    tensions[2] = zero[2]
    samples = observer.update([found.lengths] * 4, tensions)
    assert samples.alarm == ["none", "none", "cable_lost", "cable_lost"]
    assert samples.lost[-1].tolist() == [False, False, True] + [False] * 5


def test_bad_input_is_named(caroca):
    lengths = caroca.inverse(POSE).lengths
    with pytest.raises(cdpr.InputError, match="payload_std"):
        cdpr.Observer(caroca, lengths, POSE, tension_std=5, payload_std=-1)
    observer = cdpr.Observer(caroca, lengths, POSE, tension_std=5, payload_std=20)
    with pytest.raises(cdpr.InputError, match="tensions"):
        observer.update(lengths, [100] * 7)
    with pytest.raises(cdpr.InputError, match=r"tensions\[0\]"):
        observer.update(lengths, [np.nan] * 8)
    assert not observer.update(0.01 * lengths, [100] * 8).converged
