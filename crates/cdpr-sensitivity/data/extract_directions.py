"""Writes `new-joe-kuo-6.2048`: the first 2048 dimensions of Joe and Kuo's `new-joe-kuo-6.21201`.

Source: SciPy's copy of that table, `scipy/stats/_sobol_direction_numbers.npz` (SciPy 1.17.1).
A line holds one dimension, the second one first (the first dimension has no polynomial):
    a m_1 m_2 .. m_s
a = the inner coefficients of the primitive polynomial of degree s, as in the authors' file.

    python3 extract_directions.py
"""
from pathlib import Path

import numpy as np
import scipy

DIMENSIONS = 2048
table = np.load(Path(scipy.__file__).parent / "stats" / "_sobol_direction_numbers.npz")
lines = []
for poly, vinit in zip(table["poly"][1:DIMENSIONS], table["vinit"][1:DIMENSIONS]):
    degree = int(poly).bit_length() - 1
    inner = (int(poly) >> 1) & ((1 << (degree - 1)) - 1)
    assert (vinit[:degree] > 0).all() and (vinit[degree:] == 0).all()
    lines.append(" ".join(str(int(v)) for v in [inner, *vinit[:degree]]))
Path(__file__).with_name(f"new-joe-kuo-6.{DIMENSIONS}").write_text("\n".join(lines) + "\n")
