"""Roots of the balance of robots with fewer cables than free motions, by an independent multistart.

Straight cables without weight are solved from random starts (Newton's method, damped, for thousands of poses
at once), then elastic catenaries by continuation in their weight (unknowns H, V and L of every cable and the
free coordinates). No code is shared with the program. Writes few_roots.json: ten robots, 200 poses each, and for
each pose the taut roots within the limits: free coordinates, and whether the platform stays there.

    nice python3 few_roots.py          (NumPy; some minutes on one core)
"""

import json
import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
POSES, STARTS, LONGEST = 200, 96, 3.0
AXES = ["x", "y", "z", "roll", "pitch", "yaw"]
SEED = 20261126


def load(path):
    with open(os.path.join(HERE, path)) as file:
        return json.load(file)


def some(robot, indices):
    robot = dict(robot)
    robot["cables"] = [robot["cables"][i] for i in indices]
    return robot


def drawn(points, mass, cable, limits, center=(0.0, 0.0, 0.0), **more):
    return {
        "format": "cdpr-robot/1", "name": "drawn", "gravity": 9.81,
        "platform": {"mass": mass, "center_of_mass": list(center)},
        "cable": cable, "tension_limits": {"min": limits[0], "max": limits[1]},
        "cables": [{"exit_point": list(b), "anchor_point": list(a)} for b, a in points], **more,
    }


STEEL = {"section": 8.2e-6, "linear_density": 0.064, "youngs_modulus": 1e11}
HEAVY = {"section": 8e-4, "linear_density": 2.5, "youngs_modulus": 5e10}


def robots():
    """Name, robot, free coordinates, box of x, y, z, and angles of the poses [rad]."""
    library = "../robots/"
    four = load(library + "four-cables.json")
    cogiro, caroca = load(library + "cogiro.json"), load(library + "caroca.json")
    crossed = load("robots/four-crossed-cables.json")
    point = drawn([((-4, 0, 5), (0, 0, 0)), ((4, 1, 6), (0, 0, 0))], 20, STEEL, (5, 3000))
    point["platform"]["point"] = True
    planar = drawn([((-3, 0, 4), (-0.3, 0, 0.1)), ((3, 0, 4), (0.3, 0, 0.1))], 8, STEEL, (2, 2000),
                   (0.02, 0, -0.1), plane="xz")
    led = drawn([((-5, -4, 6), (-0.5, -0.4, 0.3)), ((5, -4, 6), (0.4, -0.5, 0.3)), ((5, 4, 6), (0.5, 0.4, 0.3)),
                 ((-5, 4, 6.5), (-0.4, 0.5, 0.25))], 80, STEEL, (10, 6000), (0.03, 0.02, -0.2),
                pulley={"radius": 0.08, "axis": [0, 0, 1]})
    heavy = drawn([((-8, -6, 9), (-0.5, -0.4, 0.4)), ((8, -6, 9), (0.5, -0.4, 0.4)),
                   ((8, 6, 9), (0.5, 0.4, 0.4)), ((-8, 6, 9), (-0.5, 0.4, 0.4))], 120, HEAVY, (20, 60000),
                  (0.02, 0.03, -0.3), ground_z=-1.0)
    three = drawn([((-3, -2, 4), (-0.3, -0.2, 0.2)), ((3, -2, 4.2), (0.3, -0.2, 0.2)),
                   ((0, 3, 4.1), (0, 0.3, 0.25))], 25, STEEL, (4, 3000), (0.01, 0.02, -0.15), ground_z=0.0)
    rp, none = ["roll", "pitch"], [0.0, 0.0, 0.0]
    return [
        ("four-cables", four, rp, [(-3, 3), (-2.2, 2.2), (0.5, 4)], none),
        ("cogiro on 1 3 5 7", some(cogiro, [0, 2, 4, 6]), rp, [(-4, 4), (-3, 3), (0.5, 3.5)], [0, 0, 0.3]),
        ("cogiro on 2 4 6 8", some(cogiro, [1, 3, 5, 7]), ["roll", "yaw"], [(-3, 3), (-2, 2), (0.8, 3)], none),
        ("caroca on 5", some(caroca, [0, 2, 3, 4, 6]), ["yaw"], [(-2, 2), (-1, 1), (0.5, 2.5)], [0.1, 0.1, 0]),
        ("four crossed cables", crossed, rp, [(-2, 2), (-1.2, 1.2), (0.2, 2.8)], [0, 0, 0.2]),
        ("point mass on 2", point, ["y"], [(-3, 3), (-1, 2), (1, 5)], none),
        ("planar on 2", planar, ["pitch"], [(-2.5, 2.5), (0, 0), (0.5, 3.5)], none),
        ("drawn, four cables over pulleys", led, rp, [(-3, 3), (-2.5, 2.5), (1, 4.5)], [0, 0, 0.05]),
        ("drawn, heavy ropes", heavy, rp, [(-5, 5), (-4, 4), (1, 6)], none),
        ("drawn, three cables", three, ["roll", "pitch", "yaw"], [(-2, 2), (-1.2, 2), (0.8, 3)], none),
    ]


class Robot:
    def __init__(self, robot, free):
        self.free = [AXES.index(name) for name in free]
        self.b = np.array([c["exit_point"] for c in robot["cables"]], float)
        self.a = np.array([c["anchor_point"] for c in robot["cables"]], float)
        self.n = len(self.b)
        own = [c.get("cable", robot.get("cable")) for c in robot["cables"]]
        section = [c.get("section", 0.25 * np.pi * c.get("diameter", 0) ** 2) for c in own]
        self.g = robot["gravity"]
        self.w = np.array([c["linear_density"] for c in own]) * self.g
        self.ea = np.array([c["youngs_modulus"] for c in own]) * np.array(section)
        self.mass = robot["platform"]["mass"]
        self.center = np.array(robot["platform"]["center_of_mass"], float)
        pulleys = [c.get("pulley", robot.get("pulley")) for c in robot["cables"]]
        assert all(p is None or p["axis"] == [0, 0, 1] for p in pulleys) and "lead" not in robot
        self.r = np.array([p["radius"] if p else 0.0 for p in pulleys])
        limits = robot["tension_limits"]
        self.at_exit = limits.get("max_at") == "exit"
        each = [{**limits, **c.get("tension_limits", {})} for c in robot["cables"]]
        self.min, self.max = [np.array([c[k] for c in each]) for k in ("min", "max")]
        self.ground = robot.get("ground_z", -np.inf)
        plane = robot.get("plane")
        self.rows = [0, 2, 4] if plane == "xz" else [0, 1, 2, 3, 4, 5]
        assert plane in (None, "xz")
        if robot["platform"].get("point"):
            self.rows = [0, 1, 2]
        self.size = np.abs(self.b - self.b.mean(0)).max()
        assert self.n + len(self.free) == len(self.rows)

    def placed(self, pose):
        """Lever arms of anchor points and the centre of mass, and spans, for poses (m, 6)."""
        (cr, sr), (cp, sp), (cy, sy) = [(np.cos(v), np.sin(v)) for v in pose[:, 3:].T]
        rotation = np.stack([cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,
                             sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,
                             -sp, cp * sr, cp * cr], -1).reshape(-1, 3, 3)
        arms = np.einsum("mij,nj->mni", rotation, self.a)
        center = np.einsum("mij,j->mi", rotation, self.center)
        return arms, center, pose[:, None, :3] + arms - self.b

    def balance(self, pose, pulls):
        """Wrench of forces (m, n, 3) on the platform and its weight, in the free motions."""
        arms, center, _ = self.placed(pose)
        weight = np.array([0, 0, -self.mass * self.g])
        force = pulls.sum(1) + weight
        moment = np.cross(arms, pulls).sum(1) + np.cross(center, weight)
        return np.concatenate([force, moment / self.arm()], 1)[:, self.rows]

    def arm(self):
        return max(np.sqrt((self.a**2).sum(1).mean()), 1e-2 * self.size)

    def full(self, pose, q):
        pose = np.repeat(pose[None], len(q), 0) if pose.ndim == 1 else pose.copy()
        pose[:, self.free] = q
        return pose

    # -- elastic catenaries ---------------------------------------------------------------------------------
    def ends(self, h, v, length, share):
        """End of a cable (x, z) for the force (h, v) at the anchor point; the arc on a pulley is part of it."""
        w = self.w * share
        # The free part follows from its force at the exit: V0 = V - w * free, arc (1 + T0/EA) = r * wrap.
        free = length
        for _ in range(30 if self.r.any() else 0):
            v0 = v - w * free
            t0 = np.hypot(h, v0)
            free = length - self.r * np.arctan2(h, v0) / (1 + t0 / self.ea)
        v0 = v - w * free
        t, t0 = np.hypot(h, v), np.hypot(h, v0)
        x = h * free / self.ea + h / w * (np.arcsinh(v / h) - np.arcsinh(v0 / h))
        z = (v + v0) * free / (2 * self.ea) + (v + v0) * free / (t + t0)
        return x + self.r * (1 - v0 / t0), z + self.r * h / t0, free, v0

    def catenary_residual(self, poses, x, share):
        n, unit = self.n, self.mass * self.g
        h, v, length = np.exp(x[:, :n]) * unit, x[:, n:2 * n] * unit, np.exp(x[:, 2 * n:3 * n]) * self.size
        pose = self.full(poses, x[:, 3 * n:])
        span = self.placed(pose)[2]
        across = np.linalg.norm(span[:, :, :2], axis=2)
        forward = span[:, :, :2] / across[:, :, None]
        ex, ez, _, _ = self.ends(h, v, length, share)
        pull = -np.concatenate([forward * h[:, :, None], v[:, :, None]], 2)
        return np.concatenate([self.balance(pose, pull) / unit, (ex - across) / self.size,
                               (ez - span[:, :, 2]) / self.size], 1)

    def catenaries(self, poses, tensions, q):
        """Roots of catenaries from those of straight cables; all of them, converged or not."""
        n, unit = self.n, self.mass * self.g
        span = self.placed(self.full(poses, q))[2]
        chord = np.linalg.norm(span, axis=2)
        t = np.maximum(tensions, 1e-2 / n) * unit
        h = t * np.linalg.norm(span[:, :, :2], axis=2) / chord
        v = t * span[:, :, 2] / chord
        length = chord / (1 + t / self.ea) + 0.5 * np.pi * self.r * (self.r > 0)
        x = np.concatenate([np.log(h / unit), v / unit, np.log(length / self.size), q], 1)
        good = np.ones(len(x), bool)
        for share in [0.02, 0.1, 0.25, 0.4, 0.55, 0.7, 0.85, 1.0]:
            def residual(x, rows):
                return self.catenary_residual(poses[rows], x, share)

            x, good = newton(residual, x, 40, 0.3, slice(0, None), 1e-9)
        return x, good

    def facts(self, poses, x):
        """Whether roots are taut, within limits and above the ground, and whether on the edge of it."""
        n, unit = self.n, self.mass * self.g
        h, v, length = np.exp(x[:, :n]) * unit, x[:, n:2 * n] * unit, np.exp(x[:, 2 * n:3 * n]) * self.size
        arms, _, span = self.placed(self.full(poses, x[:, 3 * n:]))
        _, _, free, v0 = self.ends(h, v, length, 1.0)
        t, t0 = np.hypot(h, v), np.hypot(h, v0)
        most = t0 if self.at_exit else t
        chord = np.linalg.norm(span, axis=2)
        anchor = (span + self.b)[:, :, 2]
        sag = np.where(v > 0, v**2 / self.w * (1 / (t + h) + 0.5 / self.ea), 0.0)
        lowest = np.where(v0 < 0, anchor - sag, np.minimum(anchor, self.b[:, 2]))
        margins = np.concatenate([t / self.min - 1, 1 - most / self.max, LONGEST - free / chord,
                                  (lowest - self.ground) / self.size], 1)
        return margins.min(1), length, h, v

    def stable(self, pose, length, h, v):
        """Whether the stiffness with the lengths fixed is positive: of differences of the cables' wrenches."""
        def wrench(pose, h, v):
            arms, center, span = self.placed(pose[None])
            across = np.linalg.norm(span[0, :, :2], axis=1)
            for _ in range(50):
                x, z, _, _ = self.ends(h, v, length, 1.0)
                gap = np.stack([across - x, span[0, :, 2] - z], 1)
                d = 1e-6 * np.maximum(np.hypot(h, v), 1e-9)
                dh = [(a - b) / (2 * d) for a, b in zip(self.ends(h + d, v, length, 1.0)[:2], self.ends(h - d, v, length, 1.0)[:2])]
                dv = [(a - b) / (2 * d) for a, b in zip(self.ends(h, v + d, length, 1.0)[:2], self.ends(h, v - d, length, 1.0)[:2])]
                jacobian = np.stack([np.stack(dh, 1), np.stack(dv, 1)], 2)
                step = np.linalg.solve(jacobian, gap[:, :, None])[:, :, 0]
                share = np.minimum(1, 0.5 * h / np.maximum(np.abs(step[:, 0]), 1e-300))
                h, v = h + share * step[:, 0], v + share * step[:, 1]
                if np.abs(gap).max() < 1e-12 * self.size:
                    break
            forward = span[0, :, :2] / across[:, None]
            pull = -np.concatenate([forward * h[:, None], v[:, None]], 1)
            weight = np.array([0, 0, -self.mass * self.g])
            moment = np.cross(arms[0], pull).sum(0) + np.cross(center[0], weight)
            return np.concatenate([pull.sum(0) + weight, moment])

        columns = []
        for k in self.rows:
            d = 1e-6 * (self.size if k < 3 else 1.0)
            sides = []
            for sign in (1, -1):
                sides.append(wrench(moved(pose, k, sign * d), h, v)[self.rows])
            columns.append(-(sides[0] - sides[1]) / (2 * d))
        stiffness = np.array(columns).T
        scale = np.array([1.0 if k < 3 else 1 / self.arm() for k in self.rows])
        stiffness = 0.5 * (stiffness + stiffness.T) * scale[:, None] * scale
        return float(np.linalg.eigvalsh(stiffness)[0])


def moved(pose, k, d):
    """The pose after a translation along, or a rotation about, an axis of the base frame."""
    pose = pose.copy()
    if k < 3:
        pose[k] += d
        return pose
    (cr, sr), (cp, sp), (cy, sy) = [(np.cos(v), np.sin(v)) for v in pose[3:]]
    rotation = np.array([[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                         [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr], [-sp, cp * sr, cp * cr]])
    i, j = [(1, 2), (2, 0), (0, 1)][k - 3]
    turn = np.eye(3)
    turn[i, i] = turn[j, j] = np.cos(d)
    turn[i, j], turn[j, i] = -np.sin(d), np.sin(d)
    rotation = turn @ rotation
    pose[3:] = [np.arctan2(rotation[2, 1], rotation[2, 2]), -np.arcsin(np.clip(rotation[2, 0], -1, 1)),
                np.arctan2(rotation[1, 0], rotation[0, 0])]
    return pose


def newton(residual, x, iterations, most, bounded, accuracy):
    """Newton's method with shortened steps for many systems at once; residual(x, rows), slopes by differences."""
    active = np.arange(len(x))
    x = x.copy()
    with np.errstate(all="ignore"):
        value = residual(x, active)
        for iteration in range(iterations):
            norm = np.linalg.norm(value[active], axis=1)
            active = active[np.isfinite(norm) & (norm > 1e-13)]
            if not len(active):
                break
            at = x[active]

            jacobian = np.empty((len(active), value.shape[1], x.shape[1]))
            for k in range(x.shape[1]):
                d = 1e-6 * np.maximum(1.0, np.abs(at[:, k]))
                up, down = at.copy(), at.copy()
                up[:, k] += d
                down[:, k] -= d
                difference = residual(up, active) - residual(down, active)
                jacobian[:, :, k] = difference / (2 * d)[:, None]
            normal = np.einsum("mji,mjk->mik", jacobian, jacobian)
            right = np.einsum("mji,mj->mi", jacobian, value[active])
            size = np.trace(normal, axis1=1, axis2=2)
            shift = 1e-15 + 1e-3 * np.minimum(1, norm_of(value[active])) ** 2
            normal += (size * shift)[:, None, None] * np.eye(x.shape[1])
            finite = np.isfinite(normal).all((1, 2)) & np.isfinite(right).all(1)
            normal[~finite], right[~finite] = np.eye(x.shape[1]), 0.0
            direct = np.zeros_like(right)
            try:
                near = norm_of(value[active]) < 1e-2
                direct = -np.linalg.solve(normal, right[:, :, None])[:, :, 0]
                if near.any():
                    direct[near & finite] = -np.linalg.solve(jacobian[near & finite], value[active][near & finite][:, :, None])[:, :, 0]
            except np.linalg.LinAlgError:
                pass
            largest = np.abs(direct[:, bounded]).max(1) / most
            direct /= np.maximum(1, largest)[:, None]
            share = np.ones(len(active))
            done = np.zeros(len(active), bool)
            before = norm_of(value[active])
            for _ in range(8):
                todo = np.flatnonzero(~done)
                if not len(todo):
                    break
                trial = at[todo] + share[todo, None] * direct[todo]
                new = residual(trial, active[todo])
                better = norm_of(new) < before[todo]
                x[active[todo[better]]] = trial[better]
                value[active[todo[better]]] = new[better]
                done[todo[better]] = True
                share[todo[~better]] *= 0.35
            active = active[done]
        return x, norm_of(value) < accuracy


def norm_of(value):
    return np.nan_to_num(np.linalg.norm(value, axis=1), nan=np.inf, posinf=np.inf)


def solve(name, robot_file, free, box, angles):
    robot, k = Robot(robot_file, free), len(free)
    rng = np.random.default_rng([SEED, *name.encode()])
    pose = np.zeros((POSES, 6))
    for axis, (low, high) in enumerate(box):
        pose[:, axis] = rng.uniform(low, high, POSES)
    pose[:, 3:] = rng.uniform(-1, 1, (POSES, 3)) * angles
    pose = np.round(pose, 3)
    pose[:, robot.free] = 0.0
    many = np.repeat(pose, STARTS, 0)
    reach = np.array([np.pi if axis >= 3 else robot.size for axis in robot.free])
    if robot.free == [1]:
        reach = np.array([2 * robot.size])
    wide = np.where(np.arange(len(many)) % 2 == 0, 0.3, 1.0)[:, None]
    starts = rng.uniform(-1, 1, (len(many), k)) * reach * wide
    starts[::STARTS] = 0.0
    n, unit = robot.n, robot.mass * robot.g
    x, found = np.empty((len(many), n + k)), np.empty(len(many), bool)
    for first in range(0, len(many), 4800):
        part = slice(first, first + 4800)
        x[part], found[part] = straight_part(robot, many[part], starts[part])
    # Cables that push by more than their weight lead to loops alone.
    weight = robot.w * 2 * robot.size / unit
    found &= (x[:, :n] > -weight).all(1)
    rows = []
    for p in range(POSES):
        seen = []
        for row in range(p * STARTS, (p + 1) * STARTS):
            q = x[row, n:]
            if found[row] and not any(same(robot, pose[p], q, other) for other in seen):
                seen.append(q)
                rows.append(row)
    rows = np.array(rows, int)
    full, good = robot.catenaries(many[rows], x[rows, :n], x[rows, n:])
    margin, length, h, v = robot.facts(many[rows], full)
    roots = [[] for _ in range(POSES)]
    edge = [False] * POSES
    for i, row in enumerate(rows):
        p = row // STARTS
        if not good[i]:
            continue
        if abs(margin[i]) < 1e-5:
            edge[p] = True
        q = full[i, 3 * n:]
        # Beyond a right angle of the pitch the prescribed angles are others.
        folded = 4 in robot.free and len(robot.rows) == 6 and np.cos(q[robot.free.index(4)]) < 0
        if margin[i] < 0 or folded:
            continue
        if any(same(robot, pose[p], q, np.array(root[:k])) for root in roots[p]):
            continue
        at = robot.full(pose[p], q[None])[0]
        least = robot.stable(at, length[i], h[i], v[i])
        soft = abs(least) < 1e-4 * unit / robot.size
        roots[p].append([round(float(c), 7) for c in q] + [0 if soft else (1 if least > 0 else -1)])
    held = sum(bool(one) for one in roots)
    print(f"{name:30} {len(rows):5} straight roots, {held:3} of {POSES} poses held, "
          f"{sum(len(one) for one in roots)} roots, {sum(edge)} on an edge", flush=True)
    poses = [[round(float(c), 3) for c in one] for one in pose]
    return {"name": name, "free": free, "robot": robot_file, "poses": poses, "roots": roots,
            "edge": [i for i, e in enumerate(edge) if e]}


def straight_part(robot, many, starts):
    n, unit = robot.n, robot.mass * robot.g

    def residual(x, rows):
        pose = robot.full(many[rows], x[:, n:])
        span = robot.placed(pose)[2]
        pull = -span / np.linalg.norm(span, axis=2, keepdims=True) * x[:, :n, None] * unit
        return robot.balance(pose, pull) / unit

    x = np.concatenate([np.full((len(many), n), 1.0 / n), starts], 1)
    return newton(residual, x, 50, 0.5, slice(n, None), 1e-9)


def same(robot, pose, one, other):
    """Whether two sets of free coordinates are the same pose: anchor points and centre coincide."""
    at = robot.full(np.stack([pose, pose]), np.stack([one, other]))
    arms, center, span = robot.placed(at)
    near = np.abs(span[0] - span[1]).max() + np.abs(center[0] - center[1]).max()
    return near < 1e-5 * robot.size


if __name__ == "__main__":
    cases = [solve(*one) for one in robots()]
    document = {"origin": "data/reference/few_roots.py", "longest_chords": LONGEST, "cases": cases}
    with open(os.path.join(HERE, "few_roots.json"), "w") as file:
        file.write(json.dumps(document, separators=(",", ":")) + "\n")
