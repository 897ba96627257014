"""What CoGiRo can carry, the margin of its tensions, and the distances of its cables at 20 poses
(SciPy, NumPy; a minute):

python3 capacity.py ../robots/cogiro.json > capacity.json

Of cables without weight the payload and the margin are linear programs, which HiGHS solves (scipy.optimize
linprog): directions are those of the chords. Of sagging cables the programs are solved by SLSQP on the catenary
of drawn.py, from the solution of the linear program and from random starts. Distances are those of points
sampled on that catenary: 400 a cable, then 400 between the neighbours of the nearest two, five times. The shapes are
those of the tensions of the lengths that the file states beside them: the least-norm tensions by drawn.py.
Nothing of the project's equations, coordinates or solvers is used.
"""

import itertools
import json
import sys

import numpy as np
from scipy.optimize import linprog, minimize
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

import drawn

# Half widths of a box of forces [N] and moments [N m].
BOX = [100.0, 100.0, 100.0, 20.0, 20.0, 20.0]


def poses():
    """20 poses in the frame, level ones and tilted ones."""
    rng = np.random.default_rng(20)
    rows = []
    for k in range(20):
        position = rng.uniform([-3.5, -2.5, 0.5], [3.5, 2.5, 3.0]).round(3)
        angles = (rng.uniform(-8, 8, 3) if k % 2 else np.zeros(3)).round(2)
        rows.append((position, angles))
    return rows


def straight(robot, position, rotation):
    """Wrench matrix of straight cables and the wrench of the platform and of 1 kg about P."""
    arms = np.array([rotation @ c["anchor_point"] for c in robot["cables"]])
    spans = position + arms - np.array([c["exit_point"] for c in robot["cables"]])
    pulls = -spans / np.linalg.norm(spans, axis=1)[:, None]
    matrix = np.vstack([pulls.T, np.cross(arms, pulls).T])
    weight = np.array([0, 0, -robot["gravity"]])
    one = np.append(weight, np.cross(rotation @ robot["platform"]["center_of_mass"], weight))
    return matrix, one


def lp_payload(robot, position, rotation):
    matrix, one = straight(robot, position, rotation)
    limits = robot["tension_limits"]
    n = matrix.shape[1]
    found = linprog(
        np.append(np.zeros(n), -1),
        A_eq=np.column_stack([matrix, one]),
        b_eq=-robot["platform"]["mass"] * one,
        bounds=[(limits["min"], limits["max"])] * n + [(0, None)],
        method="highs",
        options={"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10},
    )
    return float(found.x[-1]) if found.status == 0 else None


def lp_margin(robot, position, rotation, wrench):
    matrix, one = straight(robot, position, rotation)
    limits = robot["tension_limits"]
    n = matrix.shape[1]
    identity, ones = np.eye(n), np.ones((n, 1))
    found = linprog(
        np.append(np.zeros(n), -1),
        # t >= min + z, t <= max - z
        A_ub=np.vstack([np.hstack([-identity, ones]), np.hstack([identity, ones])]),
        b_ub=np.append(np.full(n, -limits["min"]), np.full(n, limits["max"])),
        A_eq=np.column_stack([matrix, np.zeros(6)]),
        b_eq=-(robot["platform"]["mass"] * one + wrench),
        bounds=[(0, None)] * n + [(None, None)],
        method="highs",
        options={"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10},
    )
    return float(found.x[-1]) if found.status == 0 else None


def cables_at(robot, position, rotation, payload=0.0):
    properties, limits = robot["cable"], robot["tension_limits"]
    return drawn.Cables(
        {
            "rotation": rotation,
            "position": position,
            "gravity": robot["gravity"],
            "mass": robot["platform"]["mass"] + payload,
            "center_of_mass": robot["platform"]["center_of_mass"],
            "limits": [limits["min"], limits["max"]],
            "force": np.zeros(3),
            "moment": np.zeros(3),
            "cables": [
                {
                    "exit": cable["exit_point"],
                    "anchor": cable["anchor_point"],
                    "weight": robot["gravity"] * properties["linear_density"],
                    "stiffness": properties["youngs_modulus"] * properties["section"],
                }
                for cable in robot["cables"]
            ],
        }
    )


def sagging_payload(robot, position, rotation, first):
    """The greatest payload on sagging cables, from several starts."""
    cables = cables_at(robot, position, rotation)
    one = straight(robot, position, rotation)[1].copy()
    one[3:] /= cables.arm
    low, high = cables.bounds
    level = robot["tension_limits"]["max"]
    n = len(low)
    rng = np.random.default_rng(0)
    best = None
    for k in range(6):
        v = low + (rng.random(n) if k else np.full(n, 0.2)) * (high - low)
        found = minimize(
            lambda x: -x[n],
            np.append(v, first / 1000),
            jac=lambda x: np.append(np.zeros(n), -1.0),
            bounds=[*zip(low, high), (0, 10)],
            constraints={
                "type": "eq",
                "fun": lambda x: (cables.at(x[:n])[2] + 1000 * x[n] * one) / level,
                "jac": lambda x: np.column_stack([cables.at(x[:n])[3], 1000 * one]) / level,
            },
            method="SLSQP",
            options={"maxiter": 300, "ftol": 1e-14},
        )
        residual = np.linalg.norm(cables.at(np.clip(found.x[:n], low, high))[2] + 1000 * found.x[n] * one)
        if residual < 1e-7 * level and (best is None or found.x[n] > best):
            best = found.x[n]
    return None if best is None else float(1000 * best)


def least_norm(cables):
    """The least-norm tensions on sagging cables, as ln a."""
    low, high = cables.bounds
    level = 1000.0
    found = minimize(
        lambda v: 0.5 * np.sum((cables.at(v)[0] / level) ** 2),
        low + 0.6 * (high - low),
        jac=lambda v: cables.at(v)[0] * cables.at(v)[1] / level**2,
        bounds=list(zip(low, high)),
        constraints={
            "type": "eq",
            "fun": lambda v: cables.at(v)[2] / level,
            "jac": lambda v: cables.at(v)[3] / level,
        },
        method="SLSQP",
        options={"maxiter": 300, "ftol": 1e-15},
    )
    assert np.linalg.norm(cables.at(found.x)[2]) < 1e-6, found
    return found.x


def shapes(cables, exits, v, shares):
    """Points [m] of every cable at shares of its unstrained length from the exit point."""
    a = np.exp(v)
    across, up, _ = cables.forces(v)
    # Length of each cable: a = h/H and the elastic share e give L = EA a e; e by the weight V - V0 = w L.
    curves = []
    for i in range(len(v)):
        w, ea = cables.w[i], cables.ea[i]
        log_e = length_share(cables, v)[i]
        length = ea * a[i] * np.exp(log_e)
        force, end = across[i], up[i]
        vertical = end - w * length * (1 - shares[i])
        start = end - w * length
        s = shares[i] * length
        x = force * s / ea + force / w * (np.arcsinh(vertical / force) - np.arcsinh(start / force))
        z = (start * s + 0.5 * w * s**2) / ea + (np.hypot(force, vertical) - np.hypot(force, start)) / w
        plan = cables.azimuth[i]
        curves.append(exits[i] + np.column_stack([x * plan[0], x * plan[1], z]))
    return curves


def length_share(cables, v):
    """ln of the elastic share e of every a, by bisection of the misfit."""
    a = np.exp(v)
    low, high = np.full(len(v), -40.0), np.zeros(len(v)) - 1e-15
    with np.errstate(over="ignore", invalid="ignore"):
        sign = np.sign(cables.misfit(a, low)[0])
        for _ in range(200):
            middle = 0.5 * (low + high)
            same = np.sign(cables.misfit(a, middle)[0]) == sign
            low, high = np.where(same, middle, low), np.where(same, high, middle)
    return 0.5 * (low + high)


def hull_distance(points, corners):
    """Distance of each point to the convex hull of the corners."""
    equations = ConvexHull(corners).equations
    best = []
    for point in points:
        if np.all(equations @ np.append(point, 1) <= 0):
            best.append(0.0)
            continue
        # Least |sum of shares times corners - point| over shares of a convex combination.
        n = len(corners)
        found = minimize(
            lambda s: np.sum((s @ corners - point) ** 2),
            np.full(n, 1 / n),
            jac=lambda s: 2 * corners @ (s @ corners - point),
            bounds=[(0, 1)] * n,
            constraints={"type": "eq", "fun": lambda s: s.sum() - 1, "jac": lambda s: np.ones(n)},
            method="SLSQP",
            options={"ftol": 1e-16, "maxiter": 200},
        )
        best.append(np.sqrt(found.fun))
    return np.array(best)


def distances(robot, position, rotation):
    """The nearest two cables and the cable nearest to the hull of the other anchor points, axis to axis [m]."""
    cables = cables_at(robot, position, rotation)
    v = least_norm(cables)
    exits = np.array([c["exit_point"] for c in robot["cables"]])
    n = len(exits)
    count = 400

    def between(i, j):
        shares = [np.zeros(1)] * n
        low, high = np.zeros(2), np.ones(2)
        for _ in range(5):
            both = [np.linspace(low[k], high[k], count) for k in range(2)]
            shares[i], shares[j] = both
            curves = shapes(cables, exits, v, shares)
            gaps = np.linalg.norm(curves[i][:, None] - curves[j][None], axis=2)
            least, at = gaps.min(), np.unravel_index(gaps.argmin(), gaps.shape)
            low = np.array([both[m][max(at[m] - 1, 0)] for m in range(2)])
            high = np.array([both[m][min(at[m] + 1, count - 1)] for m in range(2)])
        return least

    coarse = shapes(cables, exits, v, [np.linspace(0, 1, 200)] * n)
    rough = {
        (i, j): np.linalg.norm(coarse[i][:, None] - coarse[j][None], axis=2).min()
        for i, j in itertools.combinations(range(n), 2)
    }
    nearest = sorted(rough, key=rough.get)[:3]
    pairs = {pair: between(*pair) for pair in nearest}
    pair = min(pairs, key=pairs.get)

    anchors = np.array([position + rotation @ c["anchor_point"] for c in robot["cables"]])
    hulls = []
    for i in range(n):
        others = np.delete(anchors, i, axis=0)
        low, high = 0.0, 1.0
        for _ in range(5):
            share = np.linspace(low, high, 41)
            shares = [np.zeros(1)] * n
            shares[i] = share
            gaps = hull_distance(shapes(cables, exits, v, shares)[i], others)
            k = int(gaps.argmin())
            low, high = share[max(k - 1, 0)], share[min(k + 1, 40)]
        hulls.append(float(gaps.min()))
    hull = int(np.argmin(hulls))
    return {
        "tensions": cables.at(v)[0].tolist(),
        "cables": float(pairs[pair]),
        "pair": [pair[0] + 1, pair[1] + 1],
        "hull": hulls[hull],
        "hull_cable": hull + 1,
    }


def main(path):
    with open(path) as file:
        robot = json.load(file)
    rows = []
    for position, angles in poses():
        # R = Rz(yaw) Ry(pitch) Rx(roll)
        rotation = Rotation.from_euler("xyz", angles, degrees=True).as_matrix()
        corners = [np.array(c) * BOX for c in itertools.product([-1, 1], repeat=6)]
        margins = [lp_margin(robot, position, rotation, corner) for corner in corners]
        payload = lp_payload(robot, position, rotation)
        row = {
            "position": position.tolist(),
            "roll_pitch_yaw_deg": angles.tolist(),
            "straight_payload": payload,
            "straight_margin": lp_margin(robot, position, rotation, np.zeros(6)),
            "straight_box_margin": None if None in margins else min(margins),
        }
        if payload is not None:
            row["payload"] = sagging_payload(robot, position, rotation, payload)
            row["distances"] = distances(robot, position, rotation)
        rows.append(row)
        print(row, file=sys.stderr)
    about = "Made by capacity.py, which says how. Payloads in kg, margins and tensions in N, distances in m."
    lines = ",\n  ".join(map(json.dumps, rows))
    print(f'{{\n "about": {json.dumps(about)},\n "box": {BOX},\n "poses": [\n  {lines}\n ]\n}}')


if __name__ == "__main__":
    main(sys.argv[1])
