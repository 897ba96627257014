"""Writes ishigami.csv: 500 random rows of Ishigami's function, x4 without an effect, three failed rows."""

import csv
import math
import random
from pathlib import Path

draw = random.Random(2017)
with Path(__file__).with_suffix(".csv").open("w", newline="") as file:
    table = csv.writer(file, lineterminator="\n")
    table.writerow(["x1", "x2", "x3", "x4", "y", "status"])
    for row in range(1, 501):
        x = [round(draw.uniform(-math.pi, math.pi), 6) for _ in range(4)]
        y = math.sin(x[0]) + 7 * math.sin(x[1]) ** 2 + 0.1 * x[2] ** 4 * math.sin(x[0])
        failed = row in (17, 230, 411)
        table.writerow([*x, "" if failed else round(y, 6), "failed" if failed else "ok"])
