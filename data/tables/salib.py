"""Prints what SALib and `cdpr analyse` say of a table.

pip install SALib; cargo build --release -p cdpr; python data/tables/salib.py target/release/cdpr [ROWS]
"""

import csv
import json
import math
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy
from SALib.analyze import delta, pawn, rbd_fast

program, rows = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 2000
A = [0, 1, 4.5, 9, 99]


def ishigami(x):
    return math.sin(x[0]) + 7 * math.sin(x[1]) ** 2 + 0.1 * x[2] ** 4 * math.sin(x[0])


def sobol_g(x):
    return math.prod((abs(4 * x - 2) + a) / (1 + a) for x, a in zip(x, A))


draw = random.Random(1)
for name, model, bounds in (
    ("Ishigami", ishigami, [[-math.pi, math.pi]] * 4),
    ("Sobol' g", sobol_g, [[0, 1]] * 5),
):
    x = [[draw.uniform(*ends) for ends in bounds] for _ in range(rows)]
    y = [model(row) for row in x]
    names = [f"x{k + 1}" for k in range(len(bounds))]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "table.csv"
        with path.open("w") as file:
            csv.writer(file).writerows([[*names, "y"], *([*row, y] for row, y in zip(x, y))])
        start = time.perf_counter()
        found = subprocess.run([program, "analyse", path, "--format", "json"], check=True, capture_output=True)
        ours = time.perf_counter() - start
    inputs = json.loads(found.stdout)["outputs"]["y"]["inputs"]
    problem = {"num_vars": len(names), "names": names, "bounds": bounds}
    x, y = numpy.array(x), numpy.array(y)
    theirs, seconds = {}, {}
    for label, run in (
        ("delta", lambda: delta.analyze(problem, x, y, num_resamples=30, seed=1)),
        ("pawn", lambda: pawn.analyze(problem, x, y, S=10, seed=1)),
        ("rbd_fast", lambda: rbd_fast.analyze(problem, x, y, seed=1)),
    ):
        start = time.perf_counter()
        theirs[label] = run()
        seconds[label] = time.perf_counter() - start
    print(f"{name}, {rows} rows; all of cdpr analyse {ours:.2f} s, SALib", end=" ")
    print(", ".join(f"{label} {time:.2f} s" for label, time in seconds.items()))
    print("| input | S ranks | SALib delta S1 | RBD-FAST | delta | at least | SALib | PAWN | SALib |")
    for k, of in enumerate(inputs):
        numbers = [
            of["first"]["value"],
            theirs["delta"]["S1"][k],
            theirs["rbd_fast"]["S1"][k],
            of["delta"]["delta"],
            of["delta"]["at_least"],
            theirs["delta"]["delta_balanced"][k],
            of["pawn"]["median"],
            theirs["pawn"]["median"][k],
        ]
        print(f"| {of['input']} |", " | ".join(f"{number:.3f}" for number in numbers), "|")
