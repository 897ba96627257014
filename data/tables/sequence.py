"""Why first-order indices by ranks refuse rows of a sequence: their errors, and how such rows are recognised.

pip install numpy scipy; python data/tables/sequence.py

Prints for the sum of x_i / i of k inputs the largest mean error over 20 tables of the index by ranks (Eq. (Ra2)
of crates/cdpr-sensitivity/src/given/rank.rs), and the largest z (Ra7) of a table, its least and greatest over the
tables.
"""

import warnings

import numpy as np
from scipy.stats import qmc, rankdata

warnings.simplefilter("ignore")


def index(x, y):
    d = 0.5 * np.diff(y[np.argsort(x)]) ** 2
    return 1 - (d.sum() + (d[0] + d[-1]) / 2) / (len(y) * y.var(ddof=1))


def z(rows):
    u = (np.apply_along_axis(rankdata, 0, rows) - 0.5) / len(rows)
    correlation = np.corrcoef(u.T)
    largest = 0.0
    for i in range(rows.shape[1]):
        apart = np.diff(u[np.argsort(rows[:, i])], axis=0)[:: (len(rows) - 1) // 2048 + 1] ** 2
        found = (apart.mean(axis=0) - (1 - correlation[i] ** 2) / 6) * np.sqrt(20 * len(apart))
        found[i] = 0
        largest = max(largest, found.max())
    return largest


DESIGNS = {
    "random": lambda k, n, seed: np.random.default_rng(seed).random((n, k)),
    "Latin hypercube": lambda k, n, seed: qmc.LatinHypercube(k, seed=seed).random(n),
    "scrambled Sobol'": lambda k, n, seed: qmc.Sobol(k, seed=seed).random(n),
}

print("| inputs | rows | design | mean error | z |")
print("|---|---|---|---|---|")
for k in (5, 20, 62):
    slopes = 1 / np.arange(1, k + 1)
    exact = slopes**2 / np.sum(slopes**2)
    for n in (256, 1024, 4096):
        for name, design in DESIGNS.items():
            tables = [design(k, n, seed) for seed in range(20)]
            errors = [[index(x, rows @ slopes) for x in rows.T] - exact for rows in tables]
            found = [z(rows) for rows in tables[: 20 if k < 60 else 5]]
            error = np.abs(np.mean(errors, axis=0)).max()
            print(f"| {k} | {n} | {name} | {error:.3f} | {min(found):.1f} to {max(found):.1f} |", flush=True)
