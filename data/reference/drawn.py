"""Least-norm tensions by SciPy's SLSQP, from many starts (SciPy, NumPy; some minutes each):

cargo run -p cdpr-statics --example drawn_robots -- 200 | python3 drawn.py > drawn.json
python3 drawn.py robots/stadium.json > stadium.json

A cable ends (h, z) away from its exit point with the force (H, V) on it and V0 = V - w L, T, T0 its tensions at
both ends:

    h = H (L/EA + 2 atanh(w q)/w),    z = (V + V0) (L/2EA + q),    q = L/(T + T0)

With a = h/H, of which the share e is elastic, u = w a (1 - e)/2 and q = tanh(u)/w leave one equation for e:

    L = EA a e,    V + V0 = 2 z/(a e + 2 q),    L = 2 sinh(u)/w sqrt(H^2 + ((V + V0)/2 cosh(u))^2)

The unknowns of SLSQP are ln a, one for each cable, between their values at its limits; derivatives are complex
steps. Nothing of the project's equations, coordinates or solvers is used.
"""

import json
import sys

import numpy as np
from scipy.optimize import least_squares, minimize

STEP = 1e-30
# The least tension allowed over the least that the span demands.
MARGIN = 1.001


class Cables:
    """The cables of a robot at its pose."""

    def __init__(self, robot):
        rotation = np.reshape(robot["rotation"], (3, 3))
        cables = robot["cables"]
        self.arms = np.array([rotation @ c["anchor"] for c in cables])
        spans = np.array(robot["position"]) + self.arms - np.array([c["exit"] for c in cables])
        self.h = np.hypot(spans[:, 0], spans[:, 1])
        self.z = spans[:, 2]
        self.chord = np.hypot(self.h, self.z)
        self.azimuth = spans[:, :2] / self.h[:, None]
        self.w = np.array([c["weight"] for c in cables])
        self.ea = np.array([c["stiffness"] for c in cables])
        weight = np.array([0.0, 0.0, -robot["mass"] * robot["gravity"]])
        center = rotation @ robot["center_of_mass"]
        self.arm = max(np.linalg.norm(self.arms, axis=1).max(), 1e-3 * self.chord.max())
        moment = np.array(robot["moment"]) + np.cross(center, weight)
        self.external = np.append(robot["force"] + weight, moment / self.arm)
        self.bounds = self.limits(*robot["limits"])

    def over_weight(self, function, u, p):
        """function(w p)/w, which is p for a weightless cable."""
        return np.where(self.w == 0, p, function(u) / np.where(self.w == 0, 1, self.w))

    def misfit(self, a, log_e):
        """The logarithm of the equation for e, and L and V + V0."""
        e = np.exp(log_e)
        p = 0.5 * a * (1 - e)
        u = self.w * p
        length = self.ea * a * e
        both = 2 * self.z / (a * e + 2 * self.over_weight(np.tanh, u, p))
        pull = np.sqrt((self.h / a) ** 2 + (0.5 * both / np.cosh(u)) ** 2)
        return np.log(length / (2 * self.over_weight(np.sinh, u, p) * pull)), length, both

    def forces(self, log_a):
        """H, V and T of every cable."""
        a = np.exp(log_a)
        # Newton's method from the share of the inextensible cable.
        u = 0.5 * self.w * a.real
        length = np.hypot(self.z, self.h * np.where(u == 0, 1, np.sinh(u) / np.where(u == 0, 1, u)))
        log_e = np.log(length / (length + self.ea * a.real)) + 0 * a
        for _ in range(30):
            slope = self.misfit(a.real, log_e.real + 1j * STEP)[0].imag / STEP
            change = -self.misfit(a, log_e)[0] / slope
            log_e = log_e + np.clip(change.real, -2, 2) + (change - change.real)
            # One more step after rounding in the real part, for the imaginary part.
            if np.abs(change.real).max() < 1e-12:
                break
        else:
            raise ArithmeticError("a cable is not closed")
        _, length, both = self.misfit(a, log_e)
        across, up = self.h / a, 0.5 * (both + self.w * length)
        return across, up, np.sqrt(across**2 + up**2)

    def limits(self, least, greatest):
        """ln a of every cable at the greatest and at the least tension allowed."""
        tension = lambda v: self.forces(v)[2]

        def root(rises, low, high):
            for _ in range(200):
                middle = 0.5 * (low + high)
                up = rises(middle)
                low, high = np.where(up, low, middle), np.where(up, middle, high)
            return 0.5 * (low + high)

        tight = np.log(self.chord / (4 * greatest))
        loose = np.log(np.where(self.w == 0, 4 * self.chord / least, 24 / np.where(self.w == 0, 1, self.w)))
        loose = np.maximum(loose, tight)
        slope = lambda v: self.forces(v + 1j * STEP)[2].imag
        loose = root(lambda v: slope(v) > 0, tight, loose)
        lower = np.maximum(least, np.where(self.w == 0, 0, MARGIN * tension(loose)))
        return (
            root(lambda v: tension(v) < greatest, tight, loose),
            root(lambda v: tension(v) < lower, tight, loose),
        )

    def at(self, v):
        """Tensions, residual of the balance, and their derivatives by v."""
        across, up, tension = self.forces(v + 1j * STEP)
        pull = -np.column_stack([self.azimuth * across[:, None], up])
        wrench = np.column_stack([pull, np.cross(self.arms, pull) / self.arm])
        residual = wrench.real.sum(axis=0) + self.external
        return tension.real, tension.imag / STEP, residual, wrench.imag.T / STEP


def solve(cables, start, level):
    """The minimum near a start: norm and relative residual; None if none is found."""
    low, high = cables.bounds
    last = {}

    def at(v):
        if "v" not in last or not np.array_equal(last["v"], v):
            last.update(v=v.copy(), value=cables.at(np.clip(v, low, high)))
        return last["value"]

    try:
        found = minimize(
            lambda v: 0.5 * np.sum((at(v)[0] / level) ** 2),
            np.clip(start, low, high),
            jac=lambda v: at(v)[0] * at(v)[1] / level**2,
            bounds=list(zip(low, high)),
            constraints={
                "type": "eq",
                "fun": lambda v: at(v)[2] / level,
                "jac": lambda v: at(v)[3] / level,
            },
            method="SLSQP",
            options={"maxiter": 200, "ftol": 1e-13},
        )
        # SLSQP leaves a residual; free cables make up for it.
        v = np.clip(found.x, low, high)
        for _ in range(3):
            _, _, residual, jacobian = cables.at(v)
            free = (v > low) & (v < high)
            v[free] -= np.linalg.lstsq(jacobian[:, free], residual, rcond=1e-10)[0]
            v = np.clip(v, low, high)
    except (ArithmeticError, np.linalg.LinAlgError, ValueError):
        return None
    tension, _, residual, _ = cables.at(v)
    residual = np.linalg.norm(residual) / (np.linalg.norm(cables.external) + tension.sum())
    return (float(np.linalg.norm(tension)), float(residual)) if residual < 1e-12 else None


def balanced(cables, start):
    """Tensions near a start that balance, nearly; None if the least residual is not zero."""
    low, high = cables.bounds
    inside = np.clip(start, low + 1e-6 * (high - low), high - 1e-6 * (high - low))
    scale = np.linalg.norm(cables.external)
    found = least_squares(
        lambda v: cables.at(v)[2] / scale,
        inside,
        jac=lambda v: cables.at(v)[3].copy() / scale,
        bounds=(low, high),
        max_nfev=60,
    )
    return found.x if np.linalg.norm(found.fun) < 1e-3 else None


def best(robot, count=24, balance=False):
    """The least norm from all starts, its residual, how many led there, and how many found tensions."""
    cables = Cables(robot)
    rng = np.random.default_rng(robot["seed"])
    low, high = cables.bounds
    level = np.sqrt(robot["limits"][0] * robot["limits"][1])
    starts = [low + s * (high - low) for s in (0.25, 0.5, 0.75)]
    starts += [low + rng.random(len(low)) * (high - low) for _ in range(count - len(starts))]
    if balance:
        starts = [v for v in (balanced(cables, start) for start in starts) if v is not None]
    found = [result for result in (solve(cables, start, level) for start in starts) if result]
    if not found:
        return None
    norm, residual = min(found)
    return norm, residual, sum(other < norm * (1 + 1e-8) for other, _ in found), len(found)


def table(columns, name, rows):
    rows = ",\n  ".join(map(json.dumps, rows))
    print(f'{{\n "columns": {json.dumps(columns)},\n "{name}": [\n  {rows}\n ]\n}}')


def random_robots():
    rows = []
    for line in sys.stdin:
        robot = json.loads(line)
        rows.append([robot["seed"], float(np.linalg.norm(robot["drawn"])), *(best(robot) or [None] * 4)])
        print(rows[-1], file=sys.stderr)
    table(["seed", "drawn_norm", "least_norm", "residual", "starts_there", "starts_held"], "robots", rows)


def poses(path):
    """A level robot over a plane, without and with a payload."""
    with open(path) as file:
        content = json.load(file)
    gravity, platform, limits = content["gravity"], content["platform"], content["tension_limits"]
    properties = content["cable"]
    cables = [
        {
            "exit": cable["exit_point"],
            "anchor": cable["anchor_point"],
            "weight": gravity * properties["linear_density"],
            "stiffness": properties["youngs_modulus"] * properties["section"],
        }
        for cable in content["cables"]
    ]
    rows = []
    for payload in (0, 40):
        for x in range(-48, 49, 12):
            for y in range(-32, 33, 16):
                robot = {
                    "seed": 0,
                    "gravity": gravity,
                    "mass": platform["mass"] + payload,
                    "center_of_mass": platform["center_of_mass"],
                    "limits": [limits["min"], limits["max"]],
                    "position": [x, y, 10],
                    "rotation": np.eye(3),
                    "force": np.zeros(3),
                    "moment": np.zeros(3),
                    "cables": cables,
                }
                rows.append([payload, x, y, (best(robot, 6, balance=True) or [None])[0]])
                print(rows[-1], file=sys.stderr)
    table(["payload", "x", "y", "least_norm"], "poses", rows)


if __name__ == "__main__":
    poses(sys.argv[1]) if len(sys.argv) > 1 else random_robots()
