"""Calibrations of ten robots by `cdpr calibrate` and by SciPy's least_squares, for tests of cdpr-calibration.

python3 data/reference/campaigns.py [CAMPAIGNS] [WITH_SCIPY] [ROBOT...] (or `cargo xtask calibration campaigns`),
with the program in target/debug or where CDPR says.
For each robot it draws robots from tolerances and simulates campaigns (`cdpr calibration simulate`). The program
calibrates each; SciPy does so for the first WITH_SCIPY of them, from the same start, with straight or sagging
cables of its own and poses and tensions as unknowns of each row. It writes data/reference/campaigns.json: the
chi-squares and how often the truth lies within 1.96 of the standard deviations printed.
"""

import csv
import json
import os
import subprocess
import sys
import tempfile

import numpy as np
import scipy
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
PROGRAM = os.environ.get("CDPR", "target/debug/cdpr")
EXTERNAL = {"position": 1e-4, "rotation": 1e-4, "length": 1e-4}
# Standard deviation of the balance of forces [N] and moments [N m]: so small that it holds exactly.
BALANCE = 1e-5


def halton(count, base):
    def at(k):
        value, share = 0.0, 1.0
        while k > 0:
            share /= base
            value += share * (k % base)
            k //= base
        return 2 * value - 1

    return np.array([at(k + 1) for k in range(count)])


def library(name):
    with open(f"data/robots/{name}.json") as file:
        return json.load(file)


def drawn():
    """A robot with eight cables at random places of a frame."""
    random = np.random.default_rng(46)
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (0, 1)])
    robot = library("caroca")
    robot["name"] = "drawn"
    for cable, corner in zip(robot["cables"], corners):
        exit_point = corner * [3, 2.5, 3.2] + random.uniform(-0.3, 0.3, 3)
        anchor = corner * [0.3, 0.25, 0.4] + random.uniform(-0.05, 0.05, 3)
        cable["exit_point"], cable["anchor_point"] = exit_point.tolist(), anchor.tolist()
    robot["platform"] = {"mass": 40.0, "center_of_mass": [0.02, -0.01, 0.1]}
    robot["tension_limits"] = {"min": 50, "max": 5000}
    return robot


def planar():
    """A platform in a vertical plane on four cables."""
    exits = [[-1.5, 0, 0], [1.5, 0, 0], [-1.5, 0, 2.4], [1.5, 0, 2.4]]
    anchors = [[-0.2, 0, 0.1], [0.2, 0, 0.1], [-0.2, 0, -0.1], [0.2, 0, -0.1]]
    cables = [{"exit_point": b, "anchor_point": a} for a, b in zip(anchors, exits)]
    cable = {"diameter": 0.004, "section": 8e-6, "linear_density": 0.06, "youngs_modulus": 9e10}
    return {
        "format": "cdpr-robot/1", "name": "planar platform", "gravity": 9.81, "plane": "xz",
        "platform": {"mass": 12.0, "center_of_mass": [0, 0, 0.02]}, "cable": cable,
        "tension_limits": {"min": 20, "max": 2000}, "cables": cables,
    }


def point():
    """A point mass in space on six cables."""
    exits = [[2 * np.cos(t), 1.8 * np.sin(t), z] for t, z in zip(np.arange(6) * np.pi / 3, [0, 2.8] * 3)]
    cables = [{"exit_point": list(map(float, b)), "anchor_point": [0, 0, 0]} for b in exits]
    cable = {"diameter": 0.004, "section": 8e-6, "linear_density": 0.06, "youngs_modulus": 9e10}
    return {
        "format": "cdpr-robot/1", "name": "point mass", "gravity": 9.81,
        "platform": {"mass": 10.0, "center_of_mass": [0, 0, 0], "point": True}, "cable": cable,
        "tension_limits": {"min": 20, "max": 2000}, "cables": cables,
    }


def router():
    with open("data/reference/router/nominal.json") as file:
        return json.load(file)


def weightless(name):
    """A robot with pulleys and straight cables."""
    robot = library(name)
    robot["cable"]["linear_density"] = 0.0
    return robot


def fast():
    """A telescope's cabin; its cables hold few level poses with the tensions that the file asks for."""
    robot = library("fast")
    robot["tension_limits"]["min"] = 2e4
    return robot


# Robot, standard deviation of a point, centre and half of the region, rotation, free coordinates, noise, rows
STIFF = {"length": 2e-4, "tension": 2.0}
ROBOTS = {
    "caroca": (lambda: library("caroca"), 2e-3, [0, 0, 1.9], [2, 1, 0.7], 0.1, "", EXTERNAL, 30),
    "cogiro": (lambda: library("cogiro"), 2e-3, [0, 0, 2], [3, 2, 0.8], 0.1, "", EXTERNAL, 30),
    "fast, large and sagging": (fast, 2e-2, [0, 0, 140], [30, 30, 8], 0.0, "", EXTERNAL, 20),
    "ipanema-1, light and prestressed": (
        lambda: library("ipanema-1"), 2e-3, [0, 0, 0.0], [0.8, 0.8, 0.4], 0.05, "", {"tension": 2.0, **EXTERNAL}, 20),
    "four cables": (
        lambda: library("four-cables"), 2e-3, [0, 0, 1.8], [0.15, 0.1, 0.3], 0.0, "roll,pitch", EXTERNAL, 30),
    "ipanema-3, pulleys": (
        lambda: weightless("ipanema-3"), 2e-3, [0, 0, 1.3], [1.5, 1.5, 0.5], 0.05, "", EXTERNAL, 25),
    "router, stiff planar point": (router, 1e-2, [1.5, 1.05, 0], [1.0, 0.6, 0], 0.0, "", STIFF, 12),
    "planar platform": (planar, 3e-3, [0, 0, 1.2], [0.8, 0, 0.5], 0.0, "", STIFF, 16),
    "point mass": (point, 3e-3, [0, 0, 1.3], [0.8, 0.7, 0.6], 0.0, "", {"position": 2e-4, **STIFF}, 16),
    "drawn": (drawn, 2e-3, [0, 0, 1.5], [0.8, 0.6, 0.5], 0.05, "", EXTERNAL, 25),
}


def run(*arguments, codes=(0,)):
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)
    if done.returncode not in codes:
        raise RuntimeError(" ".join(arguments) + "\n" + done.stderr)
    return done.stdout


def catenary(span, tension, weight, stiffness):
    """Unstrained length, and force on the platform, of cables with this tension at the platform."""
    distance = np.linalg.norm(span, axis=-1)
    direction = span / distance[..., None]
    if weight == 0.0:
        return distance / (1 + tension / stiffness), -direction * tension[..., None]
    across = np.hypot(span[..., 0], span[..., 1])
    level = span[..., :2] / across[..., None]
    height = span[..., 2]
    length = distance / (1 + tension / stiffness)
    angle = np.arctan2(height, across) + 0.5 * weight * length * across / distance / tension
    for _ in range(30):
        h, v = tension * np.cos(angle), tension * np.sin(angle)
        below = v - weight * length
        t = np.hypot(h, below)
        turns = np.arcsinh(v / h) - np.arcsinh(below / h)
        x = h * length / stiffness + h / weight * turns - across
        z = (v + below) * length / (2 * stiffness) + (tension - t) / weight - height
        xl, zl = h / stiffness + h / t, below / stiffness + below / t
        dh, dv = -v, h
        xa = dh * (length / stiffness + turns / weight)
        xa = xa + h / weight * ((dv - v * dh / h) / tension - (dv - below * dh / h) / t)
        za = dv * length / stiffness - (h * dh + below * dv) / (weight * t)
        det = xa * zl - xl * za
        da, dl = -(x * zl - xl * z) / det, -(xa * z - za * x) / det
        angle, length = angle + da, length + dl
        if np.max(np.abs(dl) / length) < 1e-14:
            break
    h, v = tension * np.cos(angle), tension * np.sin(angle)
    return length, -np.concatenate([level * h[..., None], v[..., None]], axis=-1)


def over_pulleys(robot, exits, anchors, tension, stiffness):
    """Lengths and forces of weightless cables over swivelling pulleys."""
    lengths, forces = np.empty(tension.shape), np.empty(anchors.shape)
    for i, cable in enumerate(robot["cables"]):
        pulley = cable.get("pulley") or robot.get("pulley")
        k = np.array(pulley.get("axis", [0, 0, 1]), float)
        k /= np.linalg.norm(k)
        r, d = pulley["radius"], anchors[:, i] - exits[i]
        h = d @ k
        u = d - h[:, None] * k
        out = np.linalg.norm(u, axis=1)
        u /= out[:, None]
        x = out - r
        far = np.hypot(x, h)
        leave = np.arctan2(h, x) + np.arccos(r / far)
        free = np.sqrt(far**2 - r**2)
        point = r * (np.cos(leave)[:, None] * u + np.sin(leave)[:, None] * k) + r * u
        total = free + r * (np.pi - leave) + (cable.get("lead") or 0.0)
        lengths[:, i] = total / (1 + tension[:, i] / stiffness)
        forces[:, i] = -(d - point) / free[:, None] * tension[:, i, None]
    return lengths, forces


class Campaign:
    """Residuals of a campaign, with pose and tensions of each row as its unknowns."""

    def __init__(self, robot, stds, rows, noise):
        self.robot, self.stds, self.rows, self.noise = robot, stds, rows, noise
        self.n = len(robot["cables"])
        self.base = parameters(robot)
        normal = {"xy": 2, "xz": 1, "yz": 0}.get(robot.get("plane"))
        free = [k for k in range(6) if normal is None or (k == normal + 3 if k >= 3 else k != normal)]
        self.free = [k for k in free if k < 3 or not robot["platform"].get("point")]
        self.is_sought = stds > 0
        self.shared = int(self.is_sought.sum())
        self.own = len(self.free) + self.n
        column = lambda name: np.array([float(row[name]) for row in rows])
        cables = range(1, self.n + 1)
        self.lengths = np.stack([column(f"l{i}_m") for i in cables], axis=1)
        self.tensions = np.stack([column(f"t{i}_n") for i in cables], axis=1) if "tension" in noise else None
        self.position = np.stack([column(f"{a}_m") for a in "xyz"], axis=1) if "position" in noise else None
        quaternion = [column(q) for q in ("qx", "qy", "qz", "qw")] if "rotation" in noise else None
        self.rotation = Rotation.from_quat(np.stack(quaternion, axis=1)) if quaternion else None

    def start(self, poses):
        """Wanted poses, and tensions near those of the nominal robot."""
        self.p0, self.r0 = poses
        own = np.zeros((len(self.rows), self.own))
        middle = np.median(self.tensions) if self.tensions is not None else self.balanced()
        own[:, len(self.free) :] = np.log(middle)
        return own

    def balanced(self):
        """Tensions that carry the weight together, at least the weight of the cables."""
        anchors, exits = self.points(self.base)
        weight = self.base[0] * 9.81
        rows = []
        for k in range(len(self.rows)):
            arm = self.r0[k].apply(anchors)
            span = self.p0[k] + arm - exits
            u = -span / np.linalg.norm(span, axis=1)[:, None]
            w = np.concatenate([u, np.cross(arm, u)], axis=1).T[self.free]
            center = self.r0[k].apply(self.robot["platform"]["center_of_mass"])
            force = np.array([0, 0, -weight])
            right = -np.concatenate([force, np.cross(center, force)])[self.free]
            middle = np.full(self.n, max(1.5 * weight / self.n, 2 * self.robot["tension_limits"]["min"]))
            t = middle + np.linalg.pinv(w) @ (right - w @ middle)
            rows.append(np.maximum(t, 0.2 * np.median(np.abs(t))))
        return np.array(rows)

    def points(self, x):
        return x[2 : 2 + 3 * self.n].reshape(self.n, 3), x[2 + 3 * self.n :].reshape(self.n, 3)

    def lines(self, shared, own):
        """A line of residuals for each row."""
        x = self.base.copy()
        x[self.is_sought] += shared * self.stds[self.is_sought]
        anchors, exits = self.points(x)
        motion = np.zeros((len(self.rows), 6))
        motion[:, self.free] = own[:, : len(self.free)]
        tension = np.exp(own[:, len(self.free) :])
        turn = Rotation.from_rotvec(motion[:, 3:]) * self.r0
        p = self.p0 + motion[:, :3]
        matrices = turn.as_matrix()
        arm = np.einsum("rij,cj->rci", matrices, anchors)
        cable = self.robot["cable"]
        stiffness = x[1] * cable["section"]
        places = p[:, None] + arm
        if "pulley" in json.dumps(self.robot):
            length, force = over_pulleys(self.robot, exits, places, tension, stiffness)
        else:
            length, force = catenary(places - exits, tension, cable["linear_density"] * 9.81, stiffness)
        center = np.einsum("rij,j->ri", matrices, np.array(self.robot["platform"]["center_of_mass"], float))
        weight = np.array([0, 0, -x[0] * 9.81])
        total = force.sum(axis=1) + weight
        moment = np.cross(arm, force).sum(axis=1) + np.cross(center, weight)
        balance = np.concatenate([total, moment], axis=1)[:, self.free] / BALANCE
        parts = [balance, (self.lengths - length) / self.noise["length"]]
        if self.tensions is not None:
            parts.append((self.tensions - tension) / self.noise["tension"])
        if self.position is not None:
            parts.append((self.position - p) / self.noise["position"])
        if self.rotation is not None:
            parts.append((self.rotation * turn.inv()).as_rotvec() / self.noise["rotation"])
        return np.concatenate(parts, axis=1)

    def own_jacobian(self, shared, own, lines):
        """Derivatives of each row's residuals by its own unknowns, (rows, residuals, own)."""
        columns = []
        for k in range(self.own):
            step = np.zeros(own.shape)
            step[:, k] = 1e-7
            columns.append((self.lines(shared, own + step) - self.lines(shared, own - step)) / 2e-7)
        return np.stack(columns, axis=2)

    def at_best(self, shared, own):
        """Each row's own unknowns at their best, by damped Gauss-Newton, with residuals and the basis Q."""
        lines = self.lines(shared, own)
        cost = (lines**2).sum(axis=1)
        for _ in range(60):
            q, r = np.linalg.qr(self.own_jacobian(shared, own, lines))
            along = np.einsum("rik,ri->rk", q, lines)
            gain = (along**2).sum(axis=1)
            if np.all(gain < 1e-9 + 1e-13 * cost):
                break
            step = -np.linalg.solve(r, along[..., None])[..., 0]
            share = np.where(gain < 1e-9 + 1e-13 * cost, 0.0, 1.0)
            # No tension changes by more than a factor of e at once.
            most = np.abs(step[:, len(self.free) :]).max(axis=1)
            share = np.minimum(share, 1.0 / np.maximum(most, 1e-12))
            for _ in range(12):
                tried = own + share[:, None] * step
                new = self.lines(shared, tried)
                after = (new**2).sum(axis=1)
                better = (after < cost) & np.isfinite(after)
                own = np.where(better[:, None], tried, own)
                lines = np.where(better[:, None], new, lines)
                cost = np.where(better, after, cost)
                share = np.where(better, 0.0, 0.3 * share)
                if np.all(share < 1e-4):
                    break
        return own, lines, q

    def reduced(self, shared):
        key = shared.tobytes()
        if self.last[0] != key:
            own, lines, q = self.at_best(shared, self.last[1])
            self.last = (key, own, lines, q)
        return self.last[1:]

    def vector(self, shared):
        return np.concatenate([self.reduced(shared)[1].ravel(), shared])

    def jacobian(self, shared):
        """That of the residuals with each row at its best (Kaufman's): the rows' own directions taken out."""
        own, lines, q = self.reduced(shared)
        columns = []
        for k in range(self.shared):
            step = np.zeros(self.shared)
            step[k] = 1e-3
            change = (self.lines(shared + step, own) - self.lines(shared - step, own)) / 2e-3
            columns.append((change - np.einsum("rik,rk->ri", q, np.einsum("rik,ri->rk", q, change))).ravel())
        return np.concatenate([np.stack(columns, axis=1), np.eye(self.shared)])

    def fit(self, poses):
        self.last = (None, self.start(poses), None, None)
        tight = dict(method="trf", xtol=1e-12, ftol=1e-12, gtol=1e-10, max_nfev=100)
        found = least_squares(self.vector, np.zeros(self.shared), jac=self.jacobian, **tight)
        lines = self.reduced(found.x)[1]
        balance = np.abs(lines[:, : len(self.free)]).max() * BALANCE
        return 2 * found.cost, balance, found.nfev


def parameters(robot):
    """Mass, modulus, anchor points, exit points."""
    points = lambda name: [c for cable in robot["cables"] for c in cable[name]]
    first = [robot["platform"]["mass"], robot["cable"]["youngs_modulus"]]
    return np.array([*first, *points("anchor_point"), *points("exit_point")], float)


def deviations(robot, tolerance):
    point_anchor = 0.0 if robot["platform"].get("point") else tolerance
    n = len(robot["cables"])
    mass, modulus = 0.01 * robot["platform"]["mass"], 0.05 * robot["cable"]["youngs_modulus"]
    return np.array([mass, modulus, *[point_anchor] * (3 * n), *[tolerance] * (3 * n)])


def names(robot):
    n = range(1, len(robot["cables"]) + 1)
    return ["mass", "youngs_modulus", *[f"{p}{i}.{a}" for p in "ab" for i in n for a in "xyz"]]


def simulated(folder, case, seed):
    make, tolerance, center, half, tilt, free, noise, count = case
    robot = make()
    at = lambda name: os.path.join(folder, name)
    with open(at("robot.json"), "w") as file:
        json.dump(robot, file)
    stds = deviations(robot, tolerance)
    law = lambda std: {"law": {"normal": {"mean": 0.0, "std": std}}}
    laws = {"mass": law(stds[0]), "youngs_modulus": law(stds[1]), "b": law(tolerance)}
    if not robot["platform"].get("point"):
        laws["a"] = law(tolerance)
    with open(at("model.json"), "w") as file:
        json.dump(laws, file)
    offsets = np.stack([halton(count, base) for base in (2, 3, 5)], axis=1) * half
    turns = np.stack([halton(count, base) for base in (7, 11, 13)], axis=1) * tilt
    places, rotations = np.array(center) + offsets, Rotation.from_rotvec(turns)
    with open(at("poses.csv"), "w") as file:
        file.write("x_m,y_m,z_m,qw,qx,qy,qz\n")
        for p, (x, y, z, w) in zip(places, rotations.as_quat()):
            file.write(",".join(map(str, [*p, w, x, y, z])) + "\n")
    given = ",".join(f"{name}={std}" for name, std in noise.items())
    arguments = ["--poses", at("poses.csv"), "--model", at("model.json"), "--noise", given, "--seed", str(seed)]
    arguments += ["--out", at("rows.csv"), "--truth", at("truth.json"), "--overwrite"]
    run("calibration", "simulate", at("robot.json"), *arguments, *(["--free", free] if free else []))
    with open(at("rows.csv")) as file:
        rows = list(csv.DictReader(file))
    with open(at("truth.json")) as file:
        truth = parameters(json.load(file))
    return robot, stds, rows, truth, given, (places, rotations)


def calibrated(folder, given):
    at = lambda name: os.path.join(folder, name)
    arguments = ["--measurements", at("rows.csv"), "--model", at("model.json"), "--noise", given, "--folds", "0"]
    text = run("calibrate", at("robot.json"), *arguments, "--out", at("out"), "--overwrite", "--format", "json",
               codes=(0, 3))
    return json.loads(text)


def started(robot, rows, noise, poses):
    """Measured poses, or those that were wanted."""
    column = lambda name: np.array([float(row[name]) for row in rows])
    places, rotations = poses
    if len(rows) != len(places):
        raise RuntimeError(f"{robot['name']}: {len(rows)} rows of {len(places)} poses")
    if "position" in noise:
        measured = np.stack([column(f"{a}_m") for a in "xyz"], axis=1)
        normal = {"xy": 2, "xz": 1, "yz": 0}.get(robot.get("plane"))
        if normal is not None:
            measured[:, normal] = places[:, normal]
        places = measured
    if "rotation" in noise:
        rotations = Rotation.from_quat(np.stack([column(q) for q in ("qx", "qy", "qz", "qw")], axis=1))
    return places, rotations


def main():
    campaigns = int(sys.argv[1]) if len(sys.argv) > 1 else 50
    with_scipy = int(sys.argv[2]) if len(sys.argv) > 2 else campaigns
    only = sys.argv[3:] or list(ROBOTS)
    folder = tempfile.mkdtemp()
    found = {}
    for name in only:
        case = ROBOTS[name]
        chi_squares, inside, printed, unsure, worst = [], 0, 0, 0, -np.inf
        failed = 0
        for seed in range(1, campaigns + 1):
            robot, stds, rows, truth, given, poses = simulated(folder, case, seed)
            summary = calibrated(folder, given)
            status = summary["status"]
            unsure += status != "converged"
            before = parameters(robot)
            for parameter, index in zip(names(robot), range(len(before))):
                of = summary["parameters"].get(parameter)
                if of and of["std"] is not None:
                    printed += 1
                    inside += abs(of["after"] - truth[index]) <= 1.959964 * of["std"]
            if seed <= with_scipy:
                campaign = Campaign(robot, stds, rows, case[6])
                least, balance, evaluations = campaign.fit(started(robot, rows, case[6], poses))
                if balance > 1e-3 * max(1.0, 9.81 * before[0]):
                    failed += 1
                    continue
                chi_squares.append([round(summary["chi_square"], 4), round(least, 4), status])
                if status == "converged":
                    worst = max(worst, summary["chi_square"] - least)
        found[name] = {
            "campaigns": campaigns,
            "not_converged": unsure,
            "printed": printed,
            "inside_95": float(round(100 * inside / printed, 2)),
            "compared_with_scipy": len(chi_squares),
            "scipy_without_balance": failed,
            "most_above_scipy": None if worst == -np.inf else float(round(worst, 6)),
            "chi_squares": chi_squares,
        }
        print(name, {k: v for k, v in found[name].items() if k != "chi_squares"}, file=sys.stderr, flush=True)
    about = (
        f"data/reference/campaigns.py, SciPy {scipy.__version__}: chi-squares of the program, of SciPy, and the "
        "status; most_above_scipy is over those that say converged"
    )
    with open("data/reference/campaigns.json", "w") as file:
        robots = ",\n".join(f"  {json.dumps(name)}: {json.dumps(of)}" for name, of in found.items())
        file.write(f'{{\n "source": {json.dumps(about)},\n "robots": {{\n{robots}\n }}\n}}\n')


if __name__ == "__main__":
    main()
