"""The calibration of CAROCA by SciPy's least_squares, around `cdpr direct`, for tests of cdpr-calibration.

Run in the root of the repository, with the program in target/debug: python3 data/reference/calibration.py
It simulates a campaign (`cdpr calibrate simulate`), minimises the same sum of squares with a Jacobian by
differences, and writes data/reference/calibration.json.
"""

import csv
import json
import os
import subprocess
import sys
import tempfile
import time

import numpy as np
import scipy
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

PROGRAM = os.environ.get("CDPR", "target/debug/cdpr")
ROBOT = "data/robots/caroca.json"
MODEL = "data/calibration/caroca-tolerances.json"
POSES = "data/calibration/caroca-candidates.csv"
ROWS, NOISE, STEP = 24, 1e-4, 0.02


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], check=True, capture_output=True, text=True).stdout


def parameters(robot, model):
    """Names and standard deviations in the order of the parameter vector."""
    std = {name: entry["law"]["normal"]["std"] for name, entry in model.items()}
    n = len(robot["cables"])
    names = ["mass", "youngs_modulus"]
    names += [f"a{i + 1}.{axis}" for i in range(n) for axis in "xyz"]
    names += [f"b{i + 1}.{axis}" for i in range(n) for axis in "xyz"]
    group = lambda name: name if name in std else name[0]
    return names, np.array([std[group(name)] for name in names])


def deviating(robot, names, deviations):
    robot = json.loads(json.dumps(robot))
    for name, deviation in zip(names, deviations):
        if name == "mass":
            robot["platform"]["mass"] += deviation
        elif name == "youngs_modulus":
            robot["cable"]["youngs_modulus"] += deviation
        else:
            point = "anchor_point" if name[0] == "a" else "exit_point"
            place, axis = name[1:].split(".")
            robot["cables"][int(place) - 1][point]["xyz".index(axis)] += deviation
    return robot


def main():
    with open(ROBOT) as file:
        robot = json.load(file)
    with open(MODEL) as file:
        model = json.load(file)
    names, std = parameters(robot, model)
    folder = tempfile.mkdtemp()
    with open(POSES) as file:
        lines = file.read().splitlines()
    few = os.path.join(folder, "poses.csv")
    with open(few, "w") as file:
        file.write("\n".join([lines[0], *lines[1 :: max(1, (len(lines) - 1) // ROWS)]][: ROWS + 1]) + "\n")
    table = os.path.join(folder, "measurements.csv")
    noise = f"position={NOISE},rotation={NOISE}"
    run("calibrate", "simulate", ROBOT, "--poses", few, "--uncertainty", MODEL, "--noise", noise, "--seed", "5", "--out", table)
    with open(table) as file:
        text = file.read()
    rows = list(csv.DictReader(text.splitlines()))
    lengths = [[float(row[f"l{i + 1}_m"]) for i in range(8)] for row in rows]
    position = np.array([[float(row[f"{axis}_m"]) for axis in "xyz"] for row in rows])
    rotation = Rotation.from_quat([[float(row[q]) for q in ("qx", "qy", "qz", "qw")] for row in rows])
    quaternion = [[float(row[q]) for q in ("qw", "qx", "qy", "qz")] for row in rows]
    cases = os.path.join(folder, "cases.json")
    with open(cases, "w") as file:
        starts = [[*p, *q] for p, q in zip(position.tolist(), quaternion)]
        json.dump([{"lengths": l, "pose": s} for l, s in zip(lengths, starts)], file)

    def residuals(x):
        path = os.path.join(folder, "robot.json")
        with open(path, "w") as file:
            json.dump(deviating(robot, names, x * std), file)
        found = json.loads(run("direct", path, "--from", cases, "--format", "json"))
        at = np.array([one["position"] for one in found])
        turn = Rotation.from_matrix([one["rotation"] for one in found])
        apart = (rotation * turn.inv()).as_rotvec()
        return np.concatenate([((position - at) / NOISE).ravel(), (apart / NOISE).ravel(), x])

    def jacobian(x):
        """By differences over steps of STEP standard deviations, exact to the fourth order."""
        columns = []
        for k in range(len(x)):
            at = lambda steps: residuals(x + steps * STEP * np.eye(len(x))[k])
            columns.append((8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * STEP))
        return np.stack(columns, axis=1)

    clock = time.perf_counter()
    found = least_squares(residuals, np.zeros(len(std)), jac=jacobian, method="lm", xtol=1e-14, ftol=1e-15, gtol=1e-14)
    seconds = time.perf_counter() - clock
    covariance = np.linalg.inv(found.jac.T @ found.jac)
    result = {
        "source": f"data/reference/calibration.py: SciPy {scipy.__version__} least_squares (MINPACK's lmder) around cdpr direct, "
        "Jacobian by differences of the fourth order",
        "robot": ROBOT,
        "model": MODEL,
        "noise": NOISE,
        "seconds": round(seconds, 2),
        "chi_square": float(2 * found.cost),
        "parameters": {
            name: {"deviation": float(x * s), "std": float(s * np.sqrt(covariance[k, k]))}
            for k, (name, x, s) in enumerate(zip(names, found.x, std))
        },
        "measurements": text,
    }
    with open("data/reference/calibration.json", "w") as file:
        json.dump(result, file, indent=1)
        file.write("\n")
    print(f"{len(rows)} rows, {found.nfev} evaluations, {seconds:.1f} s, gradient {found.optimality:.1e}", file=sys.stderr)


main()
