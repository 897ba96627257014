"""Least squares for a campaign by SciPy, with cables of its own; used by campaigns.py.

The unknowns are the deviations of the robot in standard deviations, and in each row the pose and the
logarithms of the tensions. Those of the rows are at their best for each trial of the others (variable
projection). The balance of forces and moments counts as measured with a standard deviation that falls from
stage to stage: far from the minimum the search is not confined to the balance. The derivatives are exact
but for those of one cable, which are central differences of its smooth closed form.
"""

import json

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

# Standard deviation of the balance over the weight of the platform, stage by stage.
BALANCE = (1e-1, 1e-3, 1e-5, 1e-8)
# Largest imbalance over the weight that counts as balance, and largest gain of a further step at a minimum.
BALANCED, AT_MINIMUM = 1e-5, 1e-4


def parameters(robot):
    """Mass, modulus, anchor points, exit points."""
    points = lambda name: [c for cable in robot["cables"] for c in cable[name]]
    first = [robot["platform"]["mass"], robot["cable"]["youngs_modulus"]]
    return np.array([*first, *points("anchor_point"), *points("exit_point")], float)


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


def over_pulleys(robot, span, tension, stiffness):
    """The same of weightless cables over swivelling pulleys, from where they enter them."""
    lengths, forces = np.empty(tension.shape), np.empty(span.shape)
    for i, cable in enumerate(robot["cables"]):
        pulley = cable.get("pulley") or robot.get("pulley")
        k = np.array(pulley.get("axis", [0, 0, 1]), float)
        k /= np.linalg.norm(k)
        r, d = pulley["radius"], span[:, i]
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


def crossed(vectors):
    """Matrices of the cross products with vectors on their left."""
    x, y, z = np.moveaxis(vectors, -1, 0)
    zero = np.zeros_like(x)
    rows = [[zero, -z, y], [z, zero, -x], [-y, x, zero]]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def left_jacobian(vectors):
    """The rotation by which that of a rotation vector changes, by the change of the vector."""
    angle = np.linalg.norm(vectors, axis=-1)[..., None, None]
    small = angle < 1e-4
    safe = np.where(small, 1.0, angle)
    first = np.where(small, 0.5, (1 - np.cos(safe)) / safe**2)
    second = np.where(small, 1 / 6, (safe - np.sin(safe)) / safe**3)
    cross = crossed(vectors)
    return np.eye(3) + first * cross + second * cross @ cross


def steps(r, along, damping):
    """Damped steps of rows, (Rᵀ R + d D) η = -Rᵀ along with the squares D of the columns."""
    count = r.shape[-1]
    pivots = np.abs(np.einsum("rii->ri", r))
    regular = pivots.min(axis=1) > 1e-13 * pivots.max(axis=1)
    square = np.einsum("rki,rkj->rij", r, r)
    diagonal = np.einsum("rii->ri", square)
    floor = 1e-14 * diagonal.max(axis=1)[:, None]
    damped = square + (np.maximum(damping, 1e-14)[:, None] * diagonal + floor)[..., None] * np.eye(count)
    step = -np.linalg.solve(damped, np.einsum("rki,rk->ri", r, along)[..., None])[..., 0]
    plain = regular & (damping == 0)
    if plain.any():
        step[plain] = -np.linalg.solve(r[plain], along[plain][..., None])[..., 0]
    return step


class Campaign:
    """Residuals of a campaign and their derivatives, with pose and tensions of each row as its unknowns."""

    def __init__(self, robot, stds, rows, noise, poses):
        self.robot, self.stds, self.noise = robot, stds, noise
        self.n, self.count = len(robot["cables"]), len(rows)
        self.base = parameters(robot)
        normal = {"xy": 2, "xz": 1, "yz": 0}.get(robot.get("plane"))
        free = [k for k in range(6) if normal is None or (k == normal + 3 if k >= 3 else k != normal)]
        self.free = [k for k in free if k < 3 or not robot["platform"].get("point")]
        self.sought = np.flatnonzero(stds > 0)
        self.own = len(self.free) + self.n
        self.weight = robot["platform"]["mass"] * 9.81
        self.has_pulleys = "pulley" in json.dumps(robot)
        column = lambda name: np.array([float(row[name]) for row in rows])
        cables = range(1, self.n + 1)
        self.lengths = np.stack([column(f"l{i}_m") for i in cables], axis=1)
        self.tensions = np.stack([column(f"t{i}_n") for i in cables], axis=1) if "tension" in noise else None
        self.position = np.stack([column(f"{a}_m") for a in "xyz"], axis=1) if "position" in noise else None
        quaternion = [column(q) for q in ("qx", "qy", "qz", "qw")] if "rotation" in noise else None
        self.rotation = Rotation.from_quat(np.stack(quaternion, axis=1)) if quaternion else None
        self.p0, self.r0 = poses

    def start(self):
        """The robot file and the poses, with tensions near those measured or those that carry the weight."""
        middle = np.median(self.tensions) if self.tensions is not None else self.balanced()
        own = np.zeros((self.count, self.own))
        own[:, len(self.free) :] = np.log(middle)
        return np.zeros(len(self.sought)), own

    def balanced(self):
        """Tensions that carry the weight together, above the least that the robot file asks for."""
        anchors, exits = self.points(self.base)
        rows = []
        for k in range(self.count):
            arm = self.r0[k].apply(anchors)
            span = self.p0[k] + arm - exits
            u = -span / np.linalg.norm(span, axis=1)[:, None]
            w = np.concatenate([u, np.cross(arm, u)], axis=1).T[self.free]
            center = self.r0[k].apply(self.robot["platform"]["center_of_mass"])
            force = np.array([0, 0, -self.weight])
            right = -np.concatenate([force, np.cross(center, force)])[self.free]
            least = max(1.5 * self.weight / self.n, 2 * self.robot["tension_limits"]["min"])
            middle = np.full(self.n, least)
            t = middle + np.linalg.pinv(w) @ (right - w @ middle)
            rows.append(np.maximum(t, 0.2 * np.median(np.abs(t))))
        return np.array(rows)

    def points(self, x):
        return x[2 : 2 + 3 * self.n].reshape(self.n, 3), x[2 + 3 * self.n :].reshape(self.n, 3)

    def cables(self, span, tension, stiffness):
        if self.has_pulleys:
            return over_pulleys(self.robot, span, tension, stiffness)
        return catenary(span, tension, self.robot["cable"]["linear_density"] * 9.81, stiffness)

    def state(self, shared, own):
        """What residuals and derivatives share."""
        x = self.base.copy()
        x[self.sought] += shared * self.stds[self.sought]
        motion = np.zeros((self.count, 6))
        motion[:, self.free] = own[:, : len(self.free)]
        tension = np.exp(own[:, len(self.free) :])
        turn = Rotation.from_rotvec(motion[:, 3:]) * self.r0
        anchors, exits = self.points(x)
        matrices = turn.as_matrix()
        arm = np.einsum("rij,cj->rci", matrices, anchors)
        p = self.p0 + motion[:, :3]
        stiffness = x[1] * self.robot["cable"]["section"]
        return x, motion, tension, turn, matrices, arm, p, (p[:, None] + arm - exits, tension, stiffness)

    def lines(self, shared, own, std):
        """The residuals of each row, its balance first."""
        x, _, tension, turn, matrices, arm, p, of_cables = self.state(shared, own)
        length, force = self.cables(*of_cables)
        center = matrices @ np.array(self.robot["platform"]["center_of_mass"], float)
        weight = np.array([0, 0, -x[0] * 9.81])
        total = force.sum(axis=1) + weight
        moment = np.cross(arm, force).sum(axis=1) + np.cross(center, weight)
        balance = np.concatenate([total, moment], axis=1)[:, self.free] / std
        parts = [balance, (self.lengths - length) / self.noise["length"]]
        if self.tensions is not None:
            parts.append((self.tensions - tension) / self.noise["tension"])
        if self.position is not None:
            parts.append((self.position - p) / self.noise["position"])
        if self.rotation is not None:
            parts.append((self.rotation * turn.inv()).as_rotvec() / self.noise["rotation"])
        return np.concatenate(parts, axis=1)

    def of_cable(self, span, tension, stiffness):
        """Length and force of each cable, (row, cable, 4), by span, logarithm of the tension and stiffness."""
        both = lambda *at: (lambda l, f: np.concatenate([l[..., None], f], axis=-1))(*self.cables(*at))
        slopes = []
        for k in range(3):
            step = np.zeros(3)
            step[k] = 1e-5 * np.linalg.norm(span, axis=-1).mean()
            change = both(span + step, tension, stiffness) - both(span - step, tension, stiffness)
            slopes.append(change / (2 * step[k]))
        few = 1e-5
        up, down = (both(span, tension * np.exp(by), stiffness) for by in (few, -few))
        stiffer, softer = (both(span, tension, stiffness * (1 + by)) for by in (few, -few))
        by_tension, by_stiffness = up - down, stiffer - softer
        return np.stack([*slopes, by_tension / (2 * few), by_stiffness / (2 * few * stiffness)], axis=-1)

    def slopes(self, shared, own, std):
        """Derivatives of each row's residuals by the shared unknowns and by its own."""
        x, motion, tension, turn, matrices, arm, p, of_cables = self.state(shared, own)
        rows, n = self.count, self.n
        slopes = self.of_cable(*of_cables)
        force = self.cables(*of_cables)[1]
        # Changes of spans and lever arms by all parameters and the six motions, (row, cable, 3, input).
        inputs = len(self.base) + 6
        span, lever = np.zeros((2, rows, n, 3, inputs))
        rotated = left_jacobian(motion[:, 3:])
        for i in range(n):
            a, b = 2 + 3 * i, 2 + 3 * n + 3 * i
            lever[:, i, :, a : a + 3] = matrices
            span[:, i, :, b : b + 3] = -np.eye(3)
        lever[..., -3:] = -crossed(arm) @ rotated[:, None]
        span += lever
        span[..., -6:-3] = np.eye(3)
        change = slopes[..., :3] @ span
        change[..., 1] += slopes[..., 4] * self.robot["cable"]["section"]
        length, pulled = change[:, :, 0], change[:, :, 1:]
        weight = np.array([0, 0, -x[0] * 9.81])
        center = matrices @ np.array(self.robot["platform"]["center_of_mass"], float)
        total = pulled.sum(axis=1)
        moment = (crossed(arm) @ pulled - crossed(force) @ lever).sum(axis=1)
        total[:, 2, 0] -= 9.81
        moment[:, :, 0] += np.cross(center, [0, 0, -9.81])
        moment[:, :, -3:] += crossed(weight) @ crossed(center) @ rotated
        by_tension = slopes[..., 1:, 3]
        wrench = np.concatenate([by_tension, np.cross(arm, by_tension)], axis=-1).transpose(0, 2, 1)
        balance = np.concatenate([total, moment], axis=1)[:, self.free]
        diagonal = lambda of: of[..., None] * np.eye(n)
        none = lambda count: np.zeros((rows, count, n))
        parts = [(balance / std, wrench[:, self.free] / std)]
        noise = self.noise["length"]
        parts.append((-length / noise, -diagonal(slopes[..., 0, 3]) / noise))
        motions = np.zeros((rows, 6, inputs))
        motions[:, :3, -6:-3] = np.eye(3)
        motions[:, 3:, -3:] = rotated
        if self.tensions is not None:
            parts.append((np.zeros((rows, n, inputs)), -diagonal(tension) / self.noise["tension"]))
        if self.position is not None:
            parts.append((-motions[:, :3] / self.noise["position"], none(3)))
        if self.rotation is not None:
            left = (self.rotation * turn.inv()).as_rotvec()
            # log(exp(e) exp(-w)) = e - J(-e)^-1 w with the left Jacobian J.
            by = -np.linalg.inv(left_jacobian(-left)) @ motions[:, 3:] / self.noise["rotation"]
            parts.append((by, none(3)))
        by_inputs = np.concatenate([of[0] for of in parts], axis=1)
        by_tensions = np.concatenate([of[1] for of in parts], axis=1)
        motions = by_inputs[:, :, [len(self.base) + k for k in self.free]]
        by_shared = by_inputs[:, :, self.sought] * self.stds[self.sought]
        return by_shared, np.concatenate([motions, by_tensions], axis=2)

    def at_best(self, shared, own, std):
        """Each row's own unknowns at their best, by damped Gauss-Newton."""
        lines = self.lines(shared, own, std)
        cost = (lines**2).sum(axis=1)
        damping = np.zeros(self.count)
        for _ in range(60):
            by_shared, by_own = self.slopes(shared, own, std)
            q, r = np.linalg.qr(by_own)
            along = np.einsum("rik,ri->rk", q, lines)
            if np.all((along**2).sum(axis=1) < 1e-10 + 1e-12 * cost):
                break
            moved = (along**2).sum(axis=1) < 1e-10 + 1e-12 * cost
            for _ in range(12):
                step = steps(r, along, damping)
                tried = np.where(moved[:, None], own, own + self.bounded(step))
                new = self.lines(shared, tried, std)
                after = (new**2).sum(axis=1)
                better = ~moved & (after <= cost)
                own, lines = np.where(better[:, None], tried, own), np.where(better[:, None], new, lines)
                cost = np.where(better, after, cost)
                moved |= better
                damping = np.where(better, 0.1 * damping * (damping > 1e-8), damping)
                damping = np.where(moved, damping, np.maximum(10 * damping, 1e-8))
                if moved.all():
                    break
            if not moved.any():
                break
        return own, lines, by_shared, q, r

    def bounded(self, step):
        """A step by which no tension changes by more than a factor of e."""
        return step / np.maximum(1.0, np.abs(step[:, len(self.free) :]).max(axis=1))[:, None]

    def reduced(self, shared, std):
        """Rows at their best, from where the last trial predicts them."""
        at, before, own = self.last[:3]
        if at != (shared.tobytes(), std):
            if at is not None:
                _, by_shared, q, r = self.last[3:]
                change = q.transpose(0, 2, 1) @ (by_shared @ (shared - before))[..., None]
                predicted = own + self.bounded(steps(r, change[..., 0], np.zeros(self.count)))
                old, new = (np.sum(self.lines(shared, of, std) ** 2, axis=1) for of in (own, predicted))
                own = np.where((new < old)[:, None], predicted, own)
            self.last = ((shared.tobytes(), std), shared.copy(), *self.at_best(shared, own, std))
        return self.last[2:]

    def residuals(self, shared, std):
        return np.concatenate([self.reduced(shared, std)[1].ravel(), shared])

    def jacobian(self, shared, std):
        """That of the residuals with each row at its best (Kaufman's): the rows' own directions taken out."""
        _, _, by_shared, q, _ = self.reduced(shared, std)
        left = by_shared - q @ (q.transpose(0, 2, 1) @ by_shared)
        return np.concatenate([left.reshape(-1, len(shared)), np.eye(len(shared))])

    def fit(self):
        """Chi-square, evaluations, and whether it is that of a minimum in balance."""
        shared, own = self.start()
        self.last, evaluations = (None, None, own), 0
        for share in BALANCE:
            std = share * self.weight
            last = share == BALANCE[-1]
            tight = dict(xtol=1e-12, ftol=1e-10 if last else 1e-5, gtol=1e-10, max_nfev=60)
            found = least_squares(self.residuals, shared, jac=self.jacobian, args=(std,), **tight)
            shared, evaluations = found.x, evaluations + found.nfev
        own, lines, _, q, _ = self.reduced(shared, std)
        balance = np.abs(lines[:, : len(self.free)]).max() * BALANCE[-1]
        gain = np.sum((np.linalg.qr(found.jac)[0].T @ found.fun) ** 2)
        gain += np.sum(np.einsum("rik,ri->rk", q, lines) ** 2)
        return 2 * found.cost, evaluations, bool(balance < BALANCED and gain < AT_MINIMUM)
