"""Natural frequencies of a point mass on one cable whose winch yields (Python alone; a minute):

python3 winches.py > winches.json

A point mass M hangs on an elastic, sagging cable in its plane and is pulled by a constant horizontal force H. The
tension vector n(s), along growing unstrained length s, is n(L) - w (L - s) up with n(L) = (H, -M g), and the shape
is the integral of n (1/N + 1/EA). A small motion y sin(om t) of the cable obeys, with v = dn the change of n,

    y' = A^-1 v,    v' = -mu om^2 y,    A^-1 = (1/N + 1/EA) I - n n^T/N^3

Where the cable leaves the exit, its point moves by x along t = n/N, and the tension there is N + t.v - w t_z x/(1 + e):
another point of the cable has come there. A rotor of the mass m (inertia over the square of the radius) that a servo
holds with the stiffness k has -m om^2 x = t.v - w t_z x/(1 + e) - k x. A straight lead of stretched length d between
rotor and exit is a bar, EA X'' + mu om^2 X = 0 over d/(1 + e), with the same condition at each of its ends.

The frequencies are where motions that obey all this at the exit have v(L) = M om^2 y(L), in the plane and across it.
They are integrated by Runge and Kutta's method of order 4 with three numbers of steps, extrapolated twice, and
bracketed by changes of sign. Nothing of the project's polynomials, modes or counts is used.
"""

import json
import math
import sys

STEPS = 240


class Cable:
    """A cable with a point mass, pulled sideways."""

    def __init__(self, case):
        self.mu, self.ea = case["linear_density"][0], case["axial_stiffness"][0]
        self.mass, self.force = case["mass"], case["force"][0]
        self.gravity = -case["gravity"][2]
        self.winch, self.servo, self.lead = case["winch_mass"], case["winch_stiffness"], case["lead"][0]
        self.w = self.mu * self.gravity
        self.length = case["free_length"]

    def tension(self, s):
        return self.force, -self.mass * self.gravity - self.w * (self.length - s)

    def soft(self, s):
        """A^-1 as xx, xz, zz, and 1/N + 1/EA."""
        x, z = self.tension(s)
        n = math.hypot(x, z)
        e = 1.0 / n + 1.0 / self.ea
        cube = n**3
        return e - x * x / cube, -x * z / cube, e - z * z / cube, e

    def stretch(self):
        return 1.0 + math.hypot(*self.tension(0.0)) / self.ea

    def shape(self):
        """Where the mass rests, by the rule of Gauss with 5 points on 400 parts."""
        root = [math.sqrt(5.0 - 2.0 * math.sqrt(10.0 / 7.0)) / 3.0, math.sqrt(5.0 + 2.0 * math.sqrt(10.0 / 7.0)) / 3.0]
        weight = [(322.0 + 13.0 * math.sqrt(70.0)) / 900.0, (322.0 - 13.0 * math.sqrt(70.0)) / 900.0]
        rule = [(0.0, 128.0 / 225.0)] + [(sign * r, w) for r, w in zip(root, weight) for sign in (-1.0, 1.0)]
        parts, at = 400, [0.0, 0.0]
        h = self.length / parts
        for k in range(parts):
            for x, weight in rule:
                s = (k + 0.5 * (1.0 + x)) * h
                e = self.soft(s)[3]
                n = self.tension(s)
                at = [a + 0.5 * h * weight * c * e for a, c in zip(at, n)]
        return at

    def across(self, om, steps):
        """v(L) - M om^2 y(L) of the motion across the plane that begins with v = 1."""
        end = self.march([0.0, 1.0], om, steps, self.slope_across)
        return end[1] - self.mass * om * om * end[0]

    def slope_across(self, s, state, om):
        y, v = state
        return [self.soft(s)[3] * v, -self.mu * om * om * y]

    def in_plane(self, om, steps):
        """The determinant of v(L) - M om^2 y(L) of two motions that obey the conditions at the exit."""
        x, z = self.tension(0.0)
        n = math.hypot(x, z)
        t = (x / n, z / n)
        slid = self.w * t[1] / self.stretch()
        # x = 1 at the rotor: motion and pull at the exit, behind the lead.
        moved, pull = 1.0, self.servo - self.winch * om * om
        if self.lead > 0.0:
            bar, wave = self.lead / self.stretch(), om * math.sqrt(self.mu / self.ea)
            c, si = math.cos(wave * bar), math.sin(wave * bar)
            at = [moved, pull / (self.ea * wave)]
            moved, pull = at[0] * c + at[1] * si, self.ea * wave * (at[1] * c - at[0] * si)
        pull += slid * moved
        starts = [[moved * t[0], moved * t[1], pull * t[0], pull * t[1]], [0.0, 0.0, -t[1], t[0]]]
        ends = [self.march(start, om, steps, self.slope_in_plane) for start in starts]
        rows = [[end[2 + k] - self.mass * om * om * end[k] for k in (0, 1)] for end in ends]
        return rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]

    def slope_in_plane(self, s, state, om):
        xx, xz, zz, _ = self.soft(s)
        x, z, vx, vz = state
        square = -self.mu * om * om
        return [xx * vx + xz * vz, xz * vx + zz * vz, square * x, square * z]

    def march(self, state, om, steps, slope):
        h = self.length / steps
        for k in range(steps):
            s = k * h
            k1 = slope(s, state, om)
            k2 = slope(s + 0.5 * h, [a + 0.5 * h * b for a, b in zip(state, k1)], om)
            k3 = slope(s + 0.5 * h, [a + 0.5 * h * b for a, b in zip(state, k2)], om)
            k4 = slope(s + h, [a + h * b for a, b in zip(state, k3)], om)
            state = [a + h / 6.0 * (b + 2.0 * c + 2.0 * d + e) for a, b, c, d, e in zip(state, k1, k2, k3, k4)]
        return state


def extrapolated(of, om):
    """A determinant without its errors of order 4 and 5 in the step."""
    coarse, middle, fine = (of(om, steps) for steps in (STEPS, 2 * STEPS, 4 * STEPS))
    first, second = middle + (middle - coarse) / 15.0, fine + (fine - middle) / 15.0
    return second + (second - first) / 31.0


def roots(of, bound):
    """All frequencies [Hz] up to a bound at which a determinant changes its sign."""
    grid = [2.0 * math.pi * bound * (k + 0.5) / 500.0 for k in range(500)]
    values = [of(om, STEPS) for om in grid]
    found = []
    for low, high, left, right in zip(grid, grid[1:], values, values[1:]):
        if (left < 0.0) == (right < 0.0):
            continue
        left, right = extrapolated(of, low), extrapolated(of, high)
        for _ in range(60):
            # Regula falsi by Illinois, then the bracket is at rounding.
            middle = (low * right - high * left) / (right - left)
            value = extrapolated(of, middle)
            if (value < 0.0) == (right < 0.0):
                high, right = middle, value
                left *= 0.5
            else:
                low, left = high, right
                high, right = middle, value
            if abs(high - low) < 1e-14 * high or value == 0.0:
                break
        found.append(high / (2.0 * math.pi))
    return found


def case(name, mass, force, ea, mu, length, winch, servo, lead, bound):
    of = {
        "name": name,
        "point_mass": True,
        "gravity": [0, 0, -9.81],
        "mass": mass,
        "center_of_mass": [0, 0, 0],
        "inertia_about_com": None,
        "exit_points": [[0, 0, 0]],
        "anchor_points": [[0, 0, 0]],
        "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
        "axial_stiffness": [ea],
        "linear_density": [mu],
        "lead": [lead],
        "free_length": length,
        "force": [force, 0, 0],
        "winch_mass": winch,
        "winch_stiffness": servo,
        "bound_hz": bound,
    }
    cable = Cable(of)
    x, z = cable.shape()
    of["position"] = [x, 0, z]
    of["unstrained_lengths"] = [length + lead / cable.stretch()]
    found = roots(cable.in_plane, bound) + roots(cable.across, bound)
    of["frequencies_hz"] = sorted(float(f"{one:.13g}") for one in found)
    print(name, len(found), file=sys.stderr)
    return of


def main():
    cases = [
        case("steep, a light rotor", 40.0, 150.0, 1e5, 0.3, 6.0, 3.0, 4e4, 0.0, 60.0),
        case("steep, a heavy rotor", 40.0, 150.0, 1e5, 0.3, 6.0, 200.0, 4e4, 0.0, 60.0),
        case("flat with sag, a soft servo", 8.0, 300.0, 3e5, 0.8, 12.0, 15.0, 3e3, 0.0, 20.0),
        case("flat with sag behind a lead", 8.0, 300.0, 3e5, 0.8, 12.0, 15.0, 3e4, 5.0, 20.0),
    ]
    about = "Natural frequencies of a point mass on one cable whose winch yields, SI; by winches.py, which says how."
    print(json.dumps({"about": about, "cases": cases}, indent=1))


main()
