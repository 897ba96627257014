"""Writes sobol.json: points of scipy.stats.qmc.Sobol(d, scramble=False), as integers k of the value k / 2^30.

    python3 sobol.py        (SciPy 1.17.1)
"""
import json
from pathlib import Path

from scipy.stats import qmc

CASES = {  # dimensions: indices of the points kept
    62: [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 100, 999, 1999, 2047, 65535, 65536, 1000000, 2**22 + 12345],
    1000: [1, 2, 3, 777, 4095],
    2048: [1, 2, 4095, 65535],
}
out = []
for dimensions, indices in CASES.items():
    for index in indices:
        sampler = qmc.Sobol(dimensions, scramble=False)
        if index:
            sampler.fast_forward(index)
        point = sampler.random(1)[0] * 2**30
        assert (point == point.astype(int)).all()
        out.append({"dimensions": dimensions, "index": index, "numerators": [int(k) for k in point]})
lines = ",\n".join(json.dumps(row, separators=(",", ":")) for row in out)
Path(__file__).with_suffix(".json").write_text(
    '{"source":"scipy 1.17.1, scipy.stats.qmc.Sobol(dimensions, scramble=False), '
    'value = numerator / 2^30","points":[\n'
    + lines + "\n]}\n")
