"""Load cycles over pulleys with friction, by integration of tension and stretch along lead, arc and free cable:

    python3 friction.py > friction.json

On the wheel dT/dphi = s mu T and du/dphi = r/(1 + T/EA), by DOP853 from the leave point back to where the cable
enters; there the bearing adds s c |T0 tau - Tw k|, solved by bisection. The lead holds d/(1 + Tw/EA). Beyond the
leave point dr/ds = (1 + T/EA) n/T with n = n0 + w s, by Gauss' rule of 60 points. Newton's method finds pose, forces
at the leave points and slips s with which all cables end at their anchor points, the platform is in balance, and
every wheel sticks (Tw as before) or slips (s = 1 or -1). Which one it does is found by trial: a wheel that would have
to transmit more than full slip begins to slip, and one whose lead would change the other way sticks again.

Robots with six cables: the lengths follow from the pose. With eight, the lengths are those of `cdpr inverse`.
"""

import json
import sys
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

NODES, WEIGHTS = np.polynomial.legendre.leggauss(60)
POINTS, WEIGHTS = 0.5 * (NODES + 1), 0.5 * WEIGHTS


class Wire:
    def __init__(self, robot, i, gravity):
        cable, kind = robot["cables"][i], robot["cable"]
        pulley = cable.get("pulley") or robot["pulley"]
        self.exit, self.anchor = np.array(cable["exit_point"], float), np.array(cable["anchor_point"], float)
        self.radius, self.lead = pulley["radius"], cable.get("lead", 0.0)
        self.axis = np.array(pulley["axis"], float) / np.linalg.norm(pulley["axis"])
        self.weight = np.array([0, 0, kind["linear_density"] * gravity])
        self.stiffness = kind["youngs_modulus"] * kind["section"]

    def run(self, n0, slip, friction):
        """Leave point, winch tension, wrap and unstrained lengths of lead and arc for the force n0 there."""
        mu, c = friction
        tension = np.linalg.norm(n0)
        tau = n0 / tension
        cos = -tau @ self.axis
        psi = np.arccos(cos)
        away = tau + cos * self.axis
        u = away / np.linalg.norm(away)
        leave = self.exit + self.radius * (u + cos * u + np.sin(psi) * self.axis)
        wrap = np.pi - psi
        slope = lambda _, y: [slip * mu * y[0], self.radius / (1 + y[0] / self.stiffness)]
        arc = solve_ivp(slope, (0, wrap), [tension, 0], method="DOP853", rtol=1e-13, atol=1e-13).y[:, -1]
        balance = lambda t: t - arc[0] - slip * c * np.linalg.norm(tension * tau - t * self.axis)
        winch = brentq(balance, 0.2 * arc[0], 5 * arc[0], xtol=1e-13, rtol=1e-15)
        return leave, winch, wrap, arc[1] + self.lead / (1 + winch / self.stiffness)

    def ended(self, n0, slip, friction, length):
        """End of the cable, force on its end, winch tension, wrap."""
        leave, winch, wrap, led = self.run(n0, slip, friction)
        free = length - led
        n = n0 + np.outer(POINTS * free, self.weight)
        t = np.linalg.norm(n, axis=1)
        end = leave + free * (WEIGHTS * (1 + t / self.stiffness) / t) @ n
        return end, n0 + self.weight * free, winch, wrap


class Robot:
    def __init__(self, robot, friction):
        self.gravity = robot["gravity"]
        self.wires = [Wire(robot, i, self.gravity) for i in range(len(robot["cables"]))]
        self.mass, self.center = robot["platform"]["mass"], np.array(robot["platform"]["center_of_mass"], float)
        self.friction, self.size = friction, self.mass * self.gravity

    def wrench(self, forces, turn, payload):
        weight = np.array([0, 0, -(self.mass + payload) * self.gravity])
        total = np.concatenate([weight, np.cross(turn.apply(self.center), weight)])
        for wire, force in zip(self.wires, forces):
            total -= np.concatenate([force, np.cross(turn.apply(wire.anchor), force)])
        return total / self.size

    def newton(self, residual, x):
        for _ in range(60):
            f, jacobian = residual(x)
            step = np.linalg.solve(jacobian, -f)
            # The first steps may go too far.
            step *= min(1, 0.2 / np.abs(step).max()) if np.abs(f).max() > 1e-3 else 1
            x = x + step
            if np.abs(step).max() < 3e-14 * max(1, np.abs(x).max()):
                break
        assert np.abs(residual(x)[0]).max() < 1e-11, np.abs(residual(x)[0]).max()
        return x

    def inverse(self, pose):
        """Lengths and forces (over the weight) at the leave points that hold six cables at a pose, no slip."""
        n = len(self.wires)

        def residual(x):
            def of(i, y):
                return self.wires[i].ended(self.size * y[:3], 0.0, self.friction, y[3])

            ends, jacobian = [], np.zeros((4 * n, 4 * n))
            place = [np.array(pose) + wire.anchor for wire in self.wires]
            balance = lambda all: self.wrench(all, Rotation.identity(), 0.0)
            base = [of(i, x[4 * i : 4 * i + 4]) for i in range(n)]
            forces = [b[1] for b in base]
            for i in range(n):
                ends.append(base[i][0] - place[i])
                for k in range(4):
                    y = x[4 * i : 4 * i + 4].copy()
                    h = 1e-6
                    y[k] += h
                    end, force, *_ = of(i, y)
                    jacobian[3 * i : 3 * i + 3, 4 * i + k] = (end - base[i][0]) / h
                    moved = forces[:i] + [force] + forces[i + 1 :]
                    jacobian[3 * n :, 4 * i + k] = (balance(moved) - balance(forces)) / h
            return np.concatenate([*ends, balance(forces)]), jacobian

        start = []
        chords = [np.array(pose) + w.anchor - w.exit for w in self.wires]
        columns = np.array([np.concatenate([c, np.cross(w.anchor, c)]) / np.linalg.norm(c)
                            for c, w in zip(chords, self.wires)]).T
        pulls = np.linalg.solve(columns, self.wrench([], Rotation.identity(), 0.0))
        for w, chord, pull in zip(self.wires, chords, pulls):
            distance = np.linalg.norm(chord)
            start += [*(pull * chord / distance), distance + w.lead + 1.5 * w.radius]
        return self.newton(residual, np.array(start)).reshape(n, 4)

    def rest(self, start, lengths, payload, modes, held):
        """Equilibrium with every wheel in its mode: 0 sticks at the tension held, 1 and -1 slip."""
        position, turn, forces, slips = start
        n = len(self.wires)

        def residual(x):
            p, r = x[:3], Rotation.from_rotvec(x[3:6]) * turn
            place = lambda p, r: [p + r.apply(wire.anchor) for wire in self.wires]

            def of(i, y):
                end, force, winch, _ = self.wires[i].ended(self.size * y[:3], y[3], self.friction, lengths[i])
                rule = y[3] - modes[i] if modes[i] else (winch - held[i]) / self.size
                return np.append(end, rule), force

            jacobian = np.zeros((6 + 4 * n, 6 + 4 * n))
            base = [of(i, x[6 + 4 * i : 10 + 4 * i]) for i in range(n)]
            forces = [b[1] for b in base]
            balance, ends = self.wrench(forces, r, payload), place(p, r)
            f = [balance]
            for i in range(n):
                f.append(base[i][0] - np.append(ends[i], 0))
                for k in range(4):
                    h = 1e-6
                    y = x[6 + 4 * i : 10 + 4 * i].copy()
                    y[k] += h
                    end, force = of(i, y)
                    at = 6 + 4 * i
                    jacobian[at : at + 4, at + k] = (end - base[i][0]) / h
                    moved = forces[:i] + [force] + forces[i + 1 :]
                    jacobian[:6, at + k] = (self.wrench(moved, r, payload) - balance) / h
            for k in range(6):
                h, y = 1e-6, x[:6].copy()
                y[k] += h
                p2, r2 = y[:3], Rotation.from_rotvec(y[3:6]) * turn
                jacobian[:6, k] = (self.wrench(forces, r2, payload) - balance) / h
                for i, end in enumerate(place(p2, r2)):
                    jacobian[6 + 4 * i : 9 + 4 * i, k] = -(end - ends[i]) / h
            return np.concatenate(f), jacobian

        x = np.concatenate([position, np.zeros(3), np.column_stack([forces, slips]).ravel()])
        x = self.newton(residual, x)
        rest = x[6:].reshape(n, 4)
        return x[:3], Rotation.from_rotvec(x[3:6]) * turn, rest[:, :3], rest[:, 3]

    def winches(self, state, lengths):
        return [w.ended(self.size * f, s, self.friction, length)
                for w, f, s, length in zip(self.wires, state[2], state[3], lengths)]

    def next(self, state, lengths, payload, held):
        """The next equilibrium of a history."""
        n = len(self.wires)
        modes = [0] * n
        for _ in range(30):
            found = self.rest(state, lengths, payload, modes, held)
            ended, wanted = self.winches(found, lengths), list(modes)
            for i, (_, _, winch, _) in enumerate(ended):
                if modes[i] == 0 and abs(found[3][i]) > 1:
                    wanted[i] = int(np.sign(found[3][i]))
                # Cable that runs towards the winch leaves more of it in the lead, at less tension.
                if modes[i] and modes[i] * (winch - held[i]) > 0:
                    wanted[i] = 0
            if wanted == modes:
                return found, [e[2] for e in ended], [e[3] for e in ended]
            modes = wanted
        raise AssertionError((payload, modes))


def cycle(case):
    robot = Robot(case["robot"], (case["friction"], case["bearing"]))
    pose, payload, steps = case["pose"], case["payload"], case["steps"]
    if case.get("lengths") is None:
        rest = robot.inverse(pose)
        lengths, forces = rest[:, 3], rest[:, :3]
    else:
        lengths = np.array(case["lengths"])
        chords = [np.array(pose) + w.anchor - w.exit for w in robot.wires]
        forces = np.array([t * c / np.linalg.norm(c) / robot.size for t, c in zip(case["tensions"], chords)])
    state = (np.array(pose, float), Rotation.identity(), forces, np.zeros(len(lengths)))
    # Before the cycle no wheel slips.
    frictionless = Robot(case["robot"], (0.0, 0.0))
    state = frictionless.rest(state, lengths, 0.0, [1] * len(lengths), None)
    state = (*state[:3], np.zeros(len(lengths)))
    ended = robot.winches(state, lengths)
    winch, wraps = [e[2] for e in ended], [e[3] for e in ended]
    found = []
    loads = [payload * k / steps for k in range(steps + 1)]
    for k, load in enumerate(loads + loads[-2::-1]):
        if k:
            state, winch, wraps = robot.next(state, lengths, load, winch)
        found.append({
            "payload": load, "position": list(state[0]), "rotation": state[1].as_matrix().tolist(),
            "leave": [float(robot.size * np.linalg.norm(f)) for f in state[2]], "winch": list(map(float, winch)),
            "slip": list(map(float, state[3])), "wrap": list(map(float, wraps)),
        })
        print(case["kind"], load, state[0], [round(float(s), 2) for s in state[3]], file=sys.stderr, flush=True)
    case.pop("tensions", None)
    return {**case, "lengths": list(map(float, lengths)), "found": found}


def six(tilt, friction, bearing):
    """The NIST RoboCrane over pulleys with leads, its centre of mass off the middle."""
    robot = json.loads((Path(__file__).parent / "../robots/nist-robocrane.json").read_text())
    robot["platform"]["center_of_mass"] = [0.05, -0.03, -0.1]
    for i, cable in enumerate(robot["cables"]):
        lean = tilt * np.array([0.1 * (i - 2), 0.07 * (3 - i)])
        cable["pulley"] = {"radius": 0.04 + 0.01 * i, "axis": [*lean, 1.0]}
        cable["lead"] = 2.0 + 1.5 * i
    return {"kind": f"six cables, axes {'tilted' if tilt else 'upright'}", "robot": robot, "pose": [0.2, 0.1, 0.5],
            "payload": 60.0, "steps": 3, "friction": friction, "bearing": bearing}


# Unstrained lengths [m] of `cdpr inverse`, and tensions [N] to start from.
GIVEN = {
    "ipanema-3": (
        [12.449557677382241, 12.59179719837937, 13.227996605503218, 13.149298742893455,
         12.08664183085104, 12.302054084423412, 13.123563819104302, 12.924528370219141],
        [442, 421, 412, 414, 106, 110, 100, 100],
    ),
    "expo2015-lucia": (
        [7.973589381057534, 7.946855170087909, 7.742159005273069, 7.745655911671793,
         7.693992776646687, 7.447617280506027, 7.238534258657544, 7.475916096384051],
        [553, 17, 16, 577, 322, 412, 404, 322],
    ),
}


def eight(name, pose, payload, lead, friction, bearing):
    """A robot of the library with leads."""
    robot = json.loads((Path(__file__).parent / f"../robots/{name}.json").read_text())
    for cable in robot["cables"]:
        cable["lead"] = lead
    lengths, tensions = GIVEN[name]
    return {"kind": name, "robot": robot, "pose": pose, "payload": payload, "steps": 3, "friction": friction,
            "bearing": bearing, "lengths": lengths, "tensions": tensions}


if __name__ == "__main__":
    cases = [
        six(0, 0.08, 0.0), six(0, 0.0, 0.05), six(1, 0.06, 0.02),
        eight("ipanema-3", [0.3, 0.2, 1.5], 10.0, 3.0, 0.03, 0.01),
        eight("expo2015-lucia", [0.2, 0.1, 2.0], 40.0, 0.0, 0.05, 0.02),
    ]
    done = ",\n".join(json.dumps(cycle(case)) for case in cases)
    print('{"cases": [\n%s\n]}' % done)
