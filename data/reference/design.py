"""The best exits of CAROCA with cables without weight (SciPy, NumPy; some minutes):

python3 design.py ../robots/caroca.json > design.json

The exits are at (-x, y, z), symmetric to both middle planes, as in ../designs/caroca-pulleys.json, within the
box BOUNDS, where CAROCA has an optimum on one bound and within the two others. The objective is the greatest
deflection of POSES by PAYLOAD. Cables are straight springs: the tensions of least norm are those of SLSQP,
and the platform with the payload is where the resultants of the springs vanish (scipy.optimize.root). The
optimum is that of differential evolution over the whole box, from seeds 1 to 3, then Nelder and Mead's
method. Nothing of the project's equations, coordinates or solvers is used.
"""

import json
import sys

import numpy as np
from scipy.optimize import differential_evolution, minimize, root
from scipy.spatial.transform import Rotation

BOUNDS = [[1.5, 4.5], [0.8, 3.5], [2.5, 6.0]]
POSES = [[0.0, 0.0, 1.75], [1.0, 0.4, 1.2], [-1.0, 0.2, 2.0]]
PAYLOAD = 50.0


def exits(robot, values):
    """Exit points with half length, half width and height."""
    return np.array([np.sign(c["exit_point"]) * values for c in robot["cables"]])


def directions(robot, b, pose):
    """Spans, unit pulls and lever arms at a pose (position, rotation vector)."""
    arms = Rotation.from_rotvec(pose[3:]).apply([c["anchor_point"] for c in robot["cables"]])
    spans = b - (pose[:3] + arms)
    return np.linalg.norm(spans, axis=1), spans / np.linalg.norm(spans, axis=1)[:, None], arms


def least_norm(robot, b, position):
    """Spans and tensions of least norm; None where none within the limits hold the platform."""
    spans, pulls, arms = directions(robot, b, np.append(position, np.zeros(3)))
    matrix = np.vstack([pulls.T, np.cross(arms, pulls).T])
    weight = np.array([0, 0, robot["platform"]["mass"] * robot["gravity"], 0, 0, 0])
    limits = robot["tension_limits"]
    t = np.linalg.lstsq(matrix, weight, rcond=None)[0]
    scale = np.linalg.norm(weight)
    if np.linalg.norm(matrix @ t - weight) > 1e-9 * scale:
        return spans, None
    if t.min() < limits["min"] or t.max() > limits["max"]:
        found = minimize(
            lambda t: 0.5 * t @ t / scale**2,
            np.clip(t, limits["min"], limits["max"]),
            jac=lambda t: t / scale**2,
            bounds=[(limits["min"], limits["max"])] * len(t),
            constraints={
                "type": "eq",
                "fun": lambda t: (matrix @ t - weight) / scale,
                "jac": lambda t: matrix / scale,
            },
            method="SLSQP",
            options={"ftol": 1e-15, "maxiter": 500},
        )
        t = found.x
        if np.linalg.norm(matrix @ t - weight) > 1e-8 * scale:
            return spans, None
    return spans, t


def deflection(robot, b, position):
    """Deflection at a pose [mm]; infinite where it is not held."""
    spans, t = least_norm(robot, b, position)
    if t is None:
        return np.inf
    ea = robot["cable"]["section"] * robot["cable"]["youngs_modulus"]
    lengths = spans / (1 + t / ea)
    weight = (robot["platform"]["mass"] + PAYLOAD) * robot["gravity"]

    def residual(pose):
        spans, pulls, arms = directions(robot, b, pose)
        forces = np.maximum(ea * (spans / lengths - 1), 0)[:, None] * pulls
        return np.append(forces.sum(axis=0) - [0, 0, weight], np.cross(arms, forces).sum(axis=0)) / weight

    found = root(residual, np.append(position, np.zeros(3)), method="hybr", options={"xtol": 1e-14})
    if np.linalg.norm(residual(found.x)) > 1e-8:
        return np.inf
    return 1e3 * np.linalg.norm(found.x[:3] - position)


def main():
    robot = json.load(open(sys.argv[1]))

    def worst(values):
        b = exits(robot, np.clip(values, *np.transpose(BOUNDS)))
        return min(max(deflection(robot, b, np.array(p)) for p in POSES), 1e3)

    rows = []
    for seed in (1, 2, 3):
        settings = {"popsize": 12, "tol": 1e-10, "maxiter": 120, "polish": False}
        found = differential_evolution(worst, BOUNDS, seed=seed, **settings)
        options = {"xatol": 1e-9, "fatol": 1e-13, "maxiter": 4000, "maxfev": 8000}
        polished = minimize(worst, found.x, method="Nelder-Mead", bounds=BOUNDS, options=options)
        rows.append((float(polished.fun), polished.x.tolist()))
        print(seed, rows[-1], file=sys.stderr)
    best = min(rows)
    content = {
        "source": "design.py by SciPy, of data/robots/caroca.json without the weight of the cables",
        "bounds": BOUNDS,
        "poses": POSES,
        "payload": PAYLOAD,
        "deflection_mm": best[0],
        "values": best[1],
        "deflections_mm": [row[0] for row in rows],
    }
    print(json.dumps(content, indent=1))


main()
