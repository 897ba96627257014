"""The least 1-norm and infinity-norm of the tensions that hold two robots (SciPy, NumPy; some minutes):

python3 norms.py ../robots/cogiro.json robots/stadium.json > norms.json

Of cables without weight both are linear programs, which HiGHS solves (scipy.optimize linprog). Of sagging cables
they are solved by SLSQP on the catenary of drawn.py, from several starts: the infinity-norm as the least bound of
all tensions. Tensions are those at the platform. Nothing of the project's equations, coordinates or solvers is
used.
"""

import json
import sys

import numpy as np
from scipy.optimize import linprog, minimize
from scipy.spatial.transform import Rotation

from capacity import cables_at, straight

# Position [m], then roll, pitch, yaw [degrees].
POSES = {
    "cogiro.json": [
        ([0.0, 0.0, 2.0], [0.0, 0.0, 0.0]),
        ([-1.539, -0.194, 0.804], [0.0, 0.0, 0.0]),
        ([0.158, -0.454, 0.679], [-6.42, 7.78, 3.11]),
        ([2.5, 1.2, 1.6], [0.0, 0.0, 0.0]),
        ([-2.0, 2.0, 2.2], [4.0, -3.0, 10.0]),
        ([3.0, -1.5, 1.0], [0.0, 0.0, 5.0]),
    ],
    "stadium.json": [
        ([0.0, 0.0, 10.0], [0.0, 0.0, 0.0]),
        ([24.0, 16.0, 10.0], [0.0, 0.0, 0.0]),
        ([-36.0, 0.0, 10.0], [0.0, 0.0, 0.0]),
        ([12.0, -16.0, 12.0], [0.0, 0.0, 0.0]),
    ],
}


def of_straight(robot, position, rotation):
    """Both norms of cables without weight, or None."""
    matrix, one = straight(robot, position, rotation)
    limits = (robot["tension_limits"]["min"], robot["tension_limits"]["max"])
    n = matrix.shape[1]
    options = {"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10}
    weight = robot["platform"]["mass"] * one
    total = linprog(np.ones(n), A_eq=matrix, b_eq=-weight, bounds=[limits] * n, method="highs", options=options)
    largest = linprog(
        np.append(np.zeros(n), 1),
        A_ub=np.hstack([np.eye(n), -np.ones((n, 1))]),
        b_ub=np.zeros(n),
        A_eq=np.column_stack([matrix, np.zeros(6)]),
        b_eq=-weight,
        bounds=[limits] * n + [(0, None)],
        method="highs",
        options=options,
    )
    return [float(found.fun) if found.status == 0 else None for found in (total, largest)]


def of_sagging(robot, position, rotation, count=12):
    """Both norms from several starts, or None."""
    cables = cables_at(robot, position, rotation)
    low, high = cables.bounds
    n = len(low)
    level = np.linalg.norm(cables.external)
    rng = np.random.default_rng(0)
    starts = [low + s * (high - low) for s in (0.3, 0.6, 0.9)]
    starts += [low + rng.random(n) * (high - low) for _ in range(count - len(starts))]

    def balance(extra):
        return {
            "type": "eq",
            "fun": lambda x: cables.at(x[:n])[2] / level,
            "jac": lambda x: np.hstack([cables.at(x[:n])[3], np.zeros((6, extra))]) / level,
        }

    def below(x):
        return x[n] - cables.at(x[:n])[0] / level

    def below_slope(x):
        return np.hstack([-np.diag(cables.at(x[:n])[1]) / level, np.ones((n, 1))])

    def best(objective, slope, extra, constraints):
        values = []
        for v in starts:
            x = np.append(v, [cables.at(v)[0].max() / level] * extra)
            try:
                found = minimize(
                    objective,
                    x,
                    jac=slope,
                    bounds=[*zip(low, high)] + [(0, None)] * extra,
                    constraints=constraints,
                    method="SLSQP",
                    options={"maxiter": 500, "ftol": 1e-15},
                )
                residual = np.linalg.norm(cables.at(np.clip(found.x[:n], low, high))[2])
            except (ArithmeticError, ValueError, np.linalg.LinAlgError):
                continue
            if residual < 1e-9 * level:
                values.append(found.fun * level)
        print(np.sort(values)[:5], len(values), file=sys.stderr)
        return float(min(values)) if values else None

    total = best(
        lambda v: cables.at(v)[0].sum() / level, lambda v: cables.at(v)[1] / level, 0, [balance(0)]
    )
    largest = best(
        lambda x: x[n],
        lambda x: np.append(np.zeros(n), 1.0),
        1,
        [balance(1), {"type": "ineq", "fun": below, "jac": below_slope}],
    )
    return [total, largest]


def main(paths):
    rows = []
    for path in paths:
        with open(path) as file:
            robot = json.load(file)
        name = path.split("/")[-1]
        for position, angles in POSES[name]:
            # R = Rz(yaw) Ry(pitch) Rx(roll)
            rotation = Rotation.from_euler("xyz", angles, degrees=True).as_matrix()
            place = np.array(position)
            rows.append(
                {
                    "robot": name,
                    "position": position,
                    "roll_pitch_yaw_deg": angles,
                    "straight": of_straight(robot, place, rotation),
                    "sagging": of_sagging(robot, place, rotation),
                }
            )
            print(rows[-1], file=sys.stderr)
    about = "Made by norms.py, which says how: the least 1-norm and the least infinity-norm of the tensions [N]."
    lines = ",\n  ".join(map(json.dumps, rows))
    print(f'{{\n "about": {json.dumps(about)},\n "poses": [\n  {lines}\n ]\n}}')


if __name__ == "__main__":
    main(sys.argv[1:])
