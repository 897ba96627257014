"""Cables and platforms in wind, by integration of their differential equations (SciPy):

    python3 wind.py > wind.json

dr/ds = (1 + T/EA) t, dn/ds = w e_z - (1 + T/EA) q, q = rho/2 c d |v_n| v_n, v_n = v - (v.t) t, T = |n|, t = n/T,
from the exit point on, by DOP853. `root` finds the forces at the exit points with which all cables end at their
anchor points and, of a robot, the pose at which the platform is in balance. A rotation is R = exp(phi) R0, by SciPy's
rotation vectors. Nothing of the catenary in closed form is used.

Over height, v(z) = v(z_ref) ln(1 + z/z0)/ln(1 + z_ref/z0) (Richards, Hoxey 1993), with z above the ground, z = 0.
"""

import json
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import root
from scipy.spatial.transform import Rotation

RHO, DRAG = 1.225, 1.2


def ended(cable, wind, start, profile=None):
    """The end of the cable from the exit point, and the force there; `profile`: z0, z_ref and the height of the exit."""
    weight, stiffness, diameter, length = cable

    def slope(_, state):
        force = state[3:]
        tension = np.linalg.norm(force)
        t = force / tension
        v = wind
        if profile:
            roughness, reference, height = profile
            z = max(height + state[2], 0.0)
            v = wind * np.log1p(z / roughness) / np.log1p(reference / roughness)
        across = v - (v @ t) * t
        q = 0.5 * RHO * DRAG * diameter * np.linalg.norm(across) * across
        stretch = 1 + tension / stiffness
        return np.concatenate([stretch * t, weight - stretch * q])

    state = np.concatenate([np.zeros(3), start])
    end = solve_ivp(slope, (0, length), state, method="DOP853", rtol=1e-13, atol=1e-13).y[:, -1]
    return end[:3], end[3:]


def straight(cable, end):
    """A force to start from: that of the chord, and at least the weight of the cable."""
    weight, stiffness, _, length = cable
    chord = np.linalg.norm(end)
    tension = max(stiffness * (chord / length - 1), 2 * np.linalg.norm(weight) * length)
    return tension * end / chord - 0.5 * weight * length


def held(cable, wind, end, profile=None):
    start = straight(cable, end)
    for share in (0, 0.25, 0.5, 0.75, 1):
        found = root(lambda n: ended(cable, np.sqrt(share) * wind, n, profile)[0] - end, start, tol=1e-13)
        start = found.x
    assert np.linalg.norm(found.fun) < 1e-10, found
    return start, ended(cable, wind, start, profile)[1]


def single():
    cases = [
        # kind, w, EA, d, L, end, wind
        ("taut", 0.6, 8e5, 0.004, 9.99, [8, 1, -6], [12, -9, 0]),
        ("sagging", 0.77, 3e6, 0.012, 60, [50, 20, 10], [20, 0, 0]),
        ("along the wind", 0.77, 3e6, 0.012, 42, [40, 0, -5], [25, 0, 0]),
        ("light", 0.02, 2e5, 0.0025, 5.02, [3, 4, 0], [0, 0, 15]),
        ("heavy, level", 85, 1e8, 0.046, 151, [150, 0, 0], [0, 30, 0]),
        ("upwards", 0.23, 1e6, 0.006, 12.1, [1, 2, 11], [-15, 15, 3]),
        ("no wind", 0.77, 3e6, 0.012, 60, [50, 20, 10], [0, 0, 0]),
        # .. and z0, z_ref, height of the exit
        ("over height", 0.77, 3e6, 0.012, 60, [50, 20, -18], [20, 0, 0], [0.05, 10, 30]),
        ("from the ground", 0.6, 8e5, 0.004, 9.99, [8, 1, 6], [12, -9, 0], [0.3, 10, 0]),
    ]
    for kind, w, stiffness, diameter, length, end, wind, *profile in cases:
        cable = (np.array([0, 0, w]), stiffness, diameter, length)
        profile = profile[0] if profile else None
        exit_force, anchor_force = held(cable, np.array(wind, float), np.array(end, float), profile)
        yield {
            "kind": kind, "weight_per_length": w, "axial_stiffness": stiffness, "diameter": diameter,
            "length": length, "end": end, "wind": wind, **({"profile": profile} if profile else {}),
            "exit_force": exit_force.tolist(), "anchor_force": anchor_force.tolist(),
        }


STADIUM = {
    "kind": "stadium", "point": True, "mass": 40.0, "center_of_mass": [0, 0, 0], "gravity": 9.81,
    "weight_per_length": 0.078 * 9.81, "axial_stiffness": 8e-5 * 3.8e10,
    "exit_points": [[-50, -35, 30], [50, -35, 30], [50, 35, 30], [-50, 35, 30]], "anchor_points": [[0, 0, 0]] * 4,
    "unstrained_lengths": [85.302161, 57.024400, 42.997501, 76.546864], "start_position": [20, 10, 12],
    "start_rotation": np.eye(3).tolist(), "diameter": 0.012,
}
DIAMETERS = {"caroca": 0.004, "cogiro": 0.004, "fast": 0.046}


def platforms():
    """Each robot of equilibria.json once, and a camera of a stadium."""
    cases = json.loads((Path(__file__).parent / "equilibria.json").read_text())
    for kind, wind in (("caroca", [15, -10, 0]), ("cogiro", [12, 5, 1]), ("fast", [0, 25, 0])):
        case = next(case for case in cases if case["kind"] == kind)
        case = {key: value for key, value in case.items() if not isinstance(value, str) or key == "kind"}
        for key in ("position", "rotation", "cable_force_horizontal", "cable_force_vertical"):
            case.pop(key, None)
        yield in_both({**case, "point": False, "diameter": DIAMETERS[kind]}, wind)
    yield in_both(STADIUM, [20, 0, 0])
    yield {**solved(STADIUM, [20, 0, 0], [0.3, 10]), "kind": "stadium over height", "profile": [0.3, 10]}


# Warmer by [K], expansion of cables and frame [1/K], ice [m] and creep.
WEATHER = {"warmer": 25, "cable_expansion": 1.2e-5, "frame_expansion": 1.05e-5, "ice": 0.003, "creep": 2e-4}


def in_both(case, wind):
    """The rest in the wind alone, and with the cables and the frame of WEATHER."""
    longer = (1 + WEATHER["cable_expansion"] * WEATHER["warmer"]) * (1 + WEATHER["creep"])
    ice = 900 * np.pi * WEATHER["ice"] * (case["diameter"] + WEATHER["ice"])
    frame = 1 + WEATHER["frame_expansion"] * WEATHER["warmer"]
    changed = {
        **case,
        "unstrained_lengths": [length * longer for length in case["unstrained_lengths"]],
        "exit_points": [[frame * x for x in point] for point in case["exit_points"]],
        "weight_per_length": case["weight_per_length"] / longer + ice * case["gravity"],
        "diameter": case["diameter"] + 2 * WEATHER["ice"],
    }
    keys = "position", "rotation", "tensions"
    rest = solved(changed, wind)
    return {**solved(case, wind), "weather": WEATHER, "in_weather": {key: rest[key] for key in keys}}


def solved(case, velocity, profile=None):
    wind = np.array(velocity, float)
    exits, anchors = np.array(case["exit_points"], float), np.array(case["anchor_points"], float)
    w = np.array([0, 0, case["weight_per_length"]])
    material = [(w, case["axial_stiffness"], case["diameter"], length) for length in case["unstrained_lengths"]]
    position, first = np.array(case["start_position"], float), Rotation.from_matrix(case["start_rotation"])
    weight = np.array([0, 0, -case["mass"] * case["gravity"]])
    n, free, scale = len(material), 3 if case["point"] else 6, np.linalg.norm(weight)

    def rotation(x):
        return first if case["point"] else Rotation.from_rotvec(x[3:6]) * first

    def at_anchors(x, wind):
        forces = scale * x[free:].reshape(n, 3)
        over = [[*profile, exits[i][2]] if profile else None for i in range(n)]
        return [ended(material[i], wind, forces[i], over[i]) for i in range(n)]

    def open_equations(x, wind):
        turn = rotation(x)
        force, moment = weight.copy(), np.cross(turn.apply(case["center_of_mass"]), weight)
        closures = []
        for (end, at_anchor), anchor, exit_point in zip(at_anchors(x, wind), anchors, exits):
            arm = turn.apply(anchor)
            closures.append(end - (x[:3] + arm - exit_point))
            force -= at_anchor
            moment -= np.cross(arm, at_anchor)
        balance = force if case["point"] else np.concatenate([force, moment])
        return np.concatenate([balance / scale, *closures])

    starts = [straight(material[i], position + first.apply(anchors[i]) - exits[i]) for i in range(n)]
    # The cables alone first, then the platform.
    for i, start in enumerate(starts):
        end = position + first.apply(anchors[i]) - exits[i]
        starts[i] = root(lambda f: ended(material[i], 0 * wind, f)[0] - end, start, tol=1e-12).x
    x = np.concatenate([position, np.zeros(free - 3), np.concatenate(starts) / scale])
    for share in (0, 0.25, 0.5, 1):
        found = root(lambda x: open_equations(x, np.sqrt(share) * wind), x, tol=1e-13)
        x = found.x
    assert np.linalg.norm(found.fun) < 1e-9, (case["kind"], found.message, np.linalg.norm(found.fun))
    tensions = [float(np.linalg.norm(force)) for _, force in at_anchors(x, wind)]
    turn = rotation(x).as_matrix().tolist()
    return {**case, "wind": velocity, "position": x[:3].tolist(), "rotation": turn, "tensions": tensions}


if __name__ == "__main__":
    lines = [",\n".join(json.dumps(case) for case in cases) for cases in (single(), platforms())]
    print('{"cables": [\n%s\n],\n"robots": [\n%s\n]}' % tuple(lines))
