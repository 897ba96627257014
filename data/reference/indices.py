"""Writes indices.json: Sobol' indices and elementary effects by SALib, regression coefficients by NumPy.

The function is Ishigami's, sin x1 + 7 sin^2 x2 + 0.1 x3^4 sin x1, x uniform on [-pi, pi].

    pip install SALib==1.6.0
    python3 indices.py        (SALib 1.6.0, NumPy 2.4.6, SciPy 1.17.1)
"""
import json
from importlib.metadata import version
from pathlib import Path

import numpy as np
from SALib.analyze import morris as analyze_morris
from SALib.analyze import sobol as analyze_sobol
from SALib.sample import sobol as sample_sobol
from scipy.stats import qmc, rankdata

PROBLEM = {"num_vars": 3, "names": ["x1", "x2", "x3"], "bounds": [[-np.pi, np.pi]] * 3}


def ishigami(x):
    return np.sin(x[:, 0]) + 7 * np.sin(x[:, 1]) ** 2 + 0.1 * x[:, 2] ** 4 * np.sin(x[:, 0])


def saltelli(blocks, second):
    x = sample_sobol.sample(PROBLEM, blocks, calc_second_order=second, scramble=False)
    found = analyze_sobol.analyze(PROBLEM, ishigami(x), calc_second_order=second, seed=1)
    return {
        "blocks": blocks,
        "second_order": second,
        "rows": x[: 8 * (8 if second else 5)].tolist(),  # those of the first eight blocks
        "first": found["S1"].tolist(),
        "total": found["ST"].tolist(),
        "second": [found["S2"][i, j] for i in range(3) for j in range(i + 1, 3)] if second else [],
    }


# Levels, 0 to 3, of the rows of MorrisDesign::trajectories(inputs, 6, 4, 1) of this project.
LEVELS = [
    [3, 2, 2], [3, 2, 0], [3, 0, 0], [1, 0, 0],
    [3, 2, 3], [1, 2, 3], [1, 0, 3], [1, 0, 1],
    [3, 1, 2], [3, 1, 0], [1, 1, 0], [1, 3, 0],
    [0, 1, 3], [0, 3, 3], [0, 3, 1], [2, 3, 1],
    [0, 0, 2], [0, 2, 2], [0, 2, 0], [2, 2, 0],
    [2, 1, 3], [2, 1, 1], [0, 1, 1], [0, 3, 1],
]


def morris():
    x = -np.pi + 2 * np.pi * np.array(LEVELS) / 3
    found = analyze_morris.analyze(PROBLEM, x, ishigami(x), num_levels=4, seed=1)
    names = {"mean": "mu", "mean_absolute": "mu_star", "std": "sigma"}
    return {"levels": LEVELS, **{ours: found[theirs].tolist() for ours, theirs in names.items()}}


def coefficients(x, y):
    """SRC from the normal equations, PCC from the inverse of the matrix of all correlations."""
    correlation = np.corrcoef(np.column_stack([x, y]), rowvar=False)
    src = np.linalg.solve(correlation[:-1, :-1], correlation[:-1, -1])
    inverse = np.linalg.inv(correlation)
    pcc = -inverse[:-1, -1] / np.sqrt(np.diag(inverse)[:-1] * inverse[-1, -1])
    r_squared = float(src @ correlation[:-1, -1])
    return {"standardized": src.tolist(), "partial": pcc.tolist(), "r_squared": r_squared}


def regression():
    sampler = qmc.Sobol(3, scramble=False)
    x = -np.pi + 2 * np.pi * sampler.random(128)
    y = ishigami(x)
    ranks = np.column_stack([rankdata(column) for column in x.T])
    return {"points": 128, "values": coefficients(x, y), "ranks": coefficients(ranks, rankdata(y))}


packages = ", ".join(f"{name} {version(name)}" for name in ["SALib", "numpy", "scipy"])
out = {
    "source": f"indices.py, {packages}",
    "saltelli": [saltelli(64, True), saltelli(256, False)],
    "morris": morris(),
    "regression": regression(),
}
Path(__file__).with_suffix(".json").write_text(json.dumps(out, separators=(",", ":")) + "\n")
