"""Cables with a piecewise linear law by integration of their differential equations:

    python3 piecewise.py > piecewise.json

dx/ds = (1 + eps(T)) fx/T, dz/ds = (1 + eps(T)) V/T, V = fz - w (L - s), T = hypot(fx, V), from s = 0 to L, by
the tanh-sinh rule of mpmath (30 digits), split where the integrand has a kink (found by bisection of
T(s) - T_k on a grid). Nothing of the closed form is used.
"""

import json
from mpmath import mp, mpf, quad, hypot

mp.dps = 30

LAWS = {
    "stiffening": [(0, 0.7), (100, 0.8), (500, 1.0), (1000, 1.2)],
    "softening": [(0, 1.5), (300, 0.6)],
    "one": [(0, 1.0)],
}
CASES = [
    # w, EA, L, fx, fz
    ("taut, across a kink", "stiffening", 1.0, 1.28e6, 4.4, 410.0, 288.0),
    ("taut, within a segment", "stiffening", 1.0, 1.28e6, 4.4, 500.0, 300.0),
    ("taut, at a kink", "stiffening", 1.0, 1.28e6, 4.4, 300.0, 400.0),
    ("sagging, two kinks", "stiffening", 20.0, 1e5, 60.0, 90.0, 700.0),
    ("dips below both ends, five crossings", "stiffening", 20.0, 1e5, 100.0, 60.0, 900.0),
    ("pulled from below", "softening", 5.0, 2e4, 80.0, 150.0, -50.0),
    ("soft and heavy", "softening", 30.0, 3e3, 20.0, 100.0, 500.0),
    ("nearly vertical, folded", "softening", 30.0, 5e4, 40.0, 1e-3, 700.0),
    ("light", "stiffening", 1e-6, 1.28e6, 4.4, 300.0, 400.0),
    ("linear", "one", 20.0, 1e5, 60.0, 90.0, 700.0),
]


def strain(segments, ea, t):
    sigma = mpf(0)
    for k, (start, ratio) in enumerate(segments):
        end = segments[k + 1][0] if k + 1 < len(segments) else None
        upper = t if end is None or t < end else mpf(end)
        sigma += (upper - start) / mpf(ratio)
        if end is None or t < end:
            break
    return sigma / ea


def crossings(tension, kinks, length):
    found = []
    grid = [length * k / 397 for k in range(398)]
    for kink in kinks:
        for a, b in zip(grid, grid[1:]):
            if (tension(a) - kink) * (tension(b) - kink) < 0:
                for _ in range(100):
                    m = (a + b) / 2
                    if (tension(a) - kink) * (tension(m) - kink) <= 0:
                        b = m
                    else:
                        a = m
                found.append((a + b) / 2)
    return found


out = []
for name, law, *numbers in CASES:
    w, ea, length, fx, fz = map(mpf, numbers)
    segments = LAWS[law]
    vertical = lambda s: fz - w * (length - s)
    tension = lambda s: hypot(fx, vertical(s))
    stretched = lambda s: (1 + strain(segments, ea, tension(s))) / tension(s)
    cuts = crossings(tension, [start for start, _ in segments[1:]], length)
    # Where the cable is level it bends most.
    level = length - fz / w
    near = [level + k * fx / w for k in (-1000, -100, -10, -1, 0, 1, 10, 100, 1000)]
    points = sorted([mpf(0), length, *cuts, *[s for s in near if 0 < s < length]])
    x = quad(lambda s: stretched(s) * fx, points)
    z = quad(lambda s: stretched(s) * vertical(s), points)
    out.append(
        {
            "kind": name, "segments": segments, "weight_per_length": float(w), "axial_stiffness": float(ea),
            "unstrained_length": float(length), "force": [float(fx), float(fz)],
            "x": mp.nstr(x, 20), "z": mp.nstr(z, 20), "crossings": len(cuts),
        }
    )
print("[\n" + ",\n".join(json.dumps(case) for case in out) + "\n]")
