"""Direct model and one observation with SciPy: python3 direct.py PROBLEM.json, result as JSON on stdout.

Unknowns of the direct model: p, rotation vector v with R = exp([v]), force (fx, fz) on every cable at its
anchor point A_i. Equations, with r_i = p + R a_i - b_i, Eq. (1), h_i and z_i its horizontal length and
height, e_i = (r_x/h, r_y/h):

    sum F_i + m g = 0,  F_i = -(fx e_i, fz),  g = (0, 0, -9.81) m/s^2                  [N]     Eq. (3)
    sum (R a_i) x F_i + (R c) x m g = 0                                                [N m]   Eq. (3)
    h = fx L/EA + fx/w (asinh(fz/fx) - asinh((fz - w L)/fx))                           [mm]    Eq. (2a)
    z = fz L/EA - w L^2/(2 EA) + (sqrt(fx^2 + fz^2) - sqrt(fx^2 + (fz - w L)^2))/w     [mm]    Eq. (2b)

Inverse model, with the direction (cos s, sin s) of each cable's force, R = 1:

    minimize  sum t_i^2  over t, s, L   subject to   (3) without payload, (2a), (2b) with fx = t cos s,
    fz = t sin s, and least_i <= t_i <= greatest_i

Observation: inverse model of the robot with deviations, tension offsets dt, lengths for these, direct model
without and with the payload, difference of the positions.

Solvers: least_squares with forward differences ("lm" of MINPACK is faster here than "trf" and "dogbox"), and
minimize with SLSQP.
"""

import json
import math
import sys
import time

import numpy as np
import scipy
from scipy.optimize import least_squares, minimize

# Steps end it (1e-8 is the default); the sum of squares goes down to rounding.
OPTIONS = {"method": "lm", "x_scale": "jac", "xtol": 1e-8, "ftol": 1e-15, "gtol": 1e-15}
# Unknowns and residuals are of order one.
SLSQP = {"ftol": 1e-12, "maxiter": 1000}
# Largest residual that an answer may leave.
CLOSED = 1e-11


def catenary(fx, fz, length, w, ea):
    """End (x, z) of a cable: (2)."""
    v0 = fz - w * length
    x = fx * length / ea + fx / w * (np.arcsinh(fz / fx) - np.arcsinh(v0 / fx))
    z = fz * length / ea - w * length**2 / (2 * ea) + (np.sqrt(fx**2 + fz**2) - np.sqrt(fx**2 + v0**2)) / w
    return x, z


def turned(v):
    """Rotation exp([v])."""
    x, y, z = v
    angle = math.sqrt(x * x + y * y + z * z)
    half = math.sin(0.5 * angle) / angle if angle > 0 else 0.5
    # From the quaternion (cos(angle/2), half v).
    w, x, y, z = math.cos(0.5 * angle), half * x, half * y, half * z
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


class Robot:
    """Robot with the parameter vector: mass, density, modulus, a (3m), b (3m), centre of mass, dt (m)."""

    def __init__(self, problem, parameters):
        self.g = problem["gravity"]
        self.mass, density, modulus = parameters[:3]
        self.w, self.ea = density * self.g, modulus * problem["section"]
        self.m = m = len(problem["lengths"])
        self.a = parameters[3 : 3 + 3 * m].reshape(m, 3)
        self.b = parameters[3 + 3 * m : 3 + 6 * m].reshape(m, 3)
        self.center, self.dt = parameters[3 + 6 * m : 6 + 6 * m], parameters[6 + 6 * m :]
        self.least, self.greatest = np.array(problem["least"]), np.array(problem["greatest"])

    def wrench(self, mass, center):
        """Weight of `mass` at `center` from P: force and moment."""
        return -mass * self.g * np.array([0, 0, 1, center[1], -center[0], 0])

    def span(self, position, arms):
        """Horizontal directions of the cables, end (h, z) of each."""
        r = position + arms - self.b
        h = np.hypot(r[:, 0], r[:, 1])
        return r[:, :2] / h[:, None], h, r[:, 2]

    def residual(self, x, lengths, mass):
        """The 6 + 2m equations."""
        rotation = turned(x[3:6])
        fx, fz = x[6::2], x[7::2]
        arms = self.a @ rotation.T
        e, h, z = self.span(x[:3], arms)
        forces = np.column_stack([fx[:, None] * e, fz])
        m = arms.T @ forces
        moment = [m[1, 2] - m[2, 1], m[2, 0] - m[0, 2], m[0, 1] - m[1, 0]]
        balance = np.concatenate([forces.sum(0), moment]) - self.wrench(mass, rotation @ self.center)
        xc, zc = catenary(fx, fz, lengths, self.w, self.ea)
        return np.concatenate([balance, 1e3 * (h - xc), 1e3 * (z - zc)])

    def direct(self, lengths, payload, start):
        """Unknowns at the equilibrium."""
        return least_squares(self.residual, start, args=(lengths, self.mass + payload), **OPTIONS).x

    def held(self, tensions, h, z, start):
        """Angles and lengths of cables with given ends and tensions."""

        def residual(x):
            angles, lengths = x[: self.m], x[self.m :]
            fx, fz = tensions * np.cos(angles), tensions * np.sin(angles)
            xc, zc = catenary(fx, fz, lengths, self.w, self.ea)
            return np.concatenate([h - xc, z - zc])

        x = least_squares(residual, start, **OPTIONS).x
        return x[: self.m], x[self.m :]

    def inverse(self, position):
        """Least-norm tensions within the limits, angles, lengths at a position with R = 1."""
        e, h, z = self.span(position, self.a)
        chord = np.hypot(h, z)
        weight = self.wrench(self.mass, self.center)
        force, arm = np.linalg.norm(weight), np.abs(self.a).max()

        # Unknowns: tensions in units of the weight, angles, lengths in units of the chord.
        def open_equations(x):
            t, angles, lengths = force * x[: self.m], x[self.m : 2 * self.m], chord * x[2 * self.m :]
            fx, fz = t * np.cos(angles), t * np.sin(angles)
            forces = np.column_stack([fx[:, None] * e, fz])
            moment = np.cross(self.a, forces).sum(0)
            xc, zc = catenary(fx, fz, lengths, self.w, self.ea)
            balance = np.concatenate([forces.sum(0) - weight[:3], (moment - weight[3:]) / arm]) / force
            return np.concatenate([balance, (h - xc) / chord, (z - zc) / chord])

        def complex_step(x):
            """Jacobian: with differences SLSQP stops early where cables are nearly straight."""
            return np.column_stack([open_equations(x + 1e-30j * row).imag / 1e-30 for row in np.eye(len(x))])

        angles = np.arctan2(z, h)
        pulls = np.column_stack([np.cos(angles)[:, None] * e, np.sin(angles)])
        straight = np.linalg.pinv(np.vstack([pulls.T, np.cross(self.a, pulls).T])) @ weight
        within = np.clip(straight, self.least, self.greatest)
        start = np.concatenate([within / force, angles, np.ones(self.m)])
        # A cable leaves its anchor point towards its exit point: else it would push.
        quarter, free = (-0.5 * np.pi, 0.5 * np.pi), (None, None)
        bounds = [*zip(self.least / force, self.greatest / force), *[quarter] * self.m, *[free] * self.m]
        found = minimize(
            lambda x: 0.5 * x[: self.m] @ x[: self.m],
            start,
            jac=lambda x: np.concatenate([x[: self.m], np.zeros(2 * self.m)]),
            method="SLSQP",
            bounds=bounds,
            constraints={"type": "eq", "fun": open_equations, "jac": complex_step},
            options=SLSQP,
        )
        # Rounding ends the line search of nearly straight cables before `ftol` does.
        if not np.abs(open_equations(found.x)).max() < CLOSED:
            raise RuntimeError(f"SLSQP: {found.message}")
        t, angles, lengths = found.x.reshape(3, self.m)
        return force * t, angles, chord * lengths

    def observation(self, position, payload):
        """Displacement dp under the payload."""
        tensions, angles, lengths = self.inverse(position)
        _, h, z = self.span(position, self.a)
        # A set-point stays within the limits.
        tensions = np.clip(tensions + self.dt, self.least, self.greatest)
        angles, lengths = self.held(tensions, h, z, np.concatenate([angles, lengths]))
        forces = np.column_stack([tensions * np.cos(angles), tensions * np.sin(angles)])
        unloaded = self.direct(lengths, 0.0, np.concatenate([position, np.zeros(3), forces.ravel()]))
        return self.direct(lengths, payload, unloaded)[:3] - unloaded[:3]


def timed(solve, repeats):
    """Result, and CPU times [us]; the first call is not timed."""
    result, times = solve(), []
    for _ in range(repeats):
        begin = time.process_time()
        solve()
        times.append(1e6 * (time.process_time() - begin))
    return result, times


def answer(problem, repeats):
    """Answers and times of a case."""
    nominal, position = np.array(problem["parameters"]), np.array(problem["position"])
    payload, lengths = problem["payload"], np.array(problem["lengths"])
    start = np.concatenate([position, np.zeros(3), np.ravel(problem["forces"])])
    robot = Robot(problem, nominal)
    direct, direct_times = timed(lambda: robot.direct(lengths, payload, start), repeats)
    held, inverse_times = timed(lambda: robot.inverse(position), repeats)
    displacements, times = [], []
    try:
        for deviation in np.array(problem["deviations"]):
            observe = lambda: Robot(problem, nominal + deviation).observation(position, payload)
            result, taken = timed(observe, repeats)
            displacements.append(result.tolist())
            times += taken
    except RuntimeError as error:
        print(f"{problem['name']}, observation {len(displacements) + 1}: {error}", file=sys.stderr)
        displacements = times = None
    return {
        "direct_us": np.median(direct_times),
        "direct_position": direct[:3].tolist(),
        "inverse_us": np.median(inverse_times),
        "tensions": held[0].tolist(),
        "observation_us": np.median(times) if times else None,
        "displacements": displacements,
    }


def main():
    with open(sys.argv[1]) as file:
        problem = json.load(file)
    answers = {
        "version": scipy.__version__,
        "solver": f"least_squares {OPTIONS['method']}, SLSQP; differences",
        "cases": [answer(case, problem["repeats"]) for case in problem["cases"]],
    }
    json.dump(answers, sys.stdout)


main()
