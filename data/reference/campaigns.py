"""Calibrations of ten robots by `cdpr calibrate fit` and by SciPy's least_squares (campaign_fit.py).

python3 data/reference/campaigns.py [CAMPAIGNS] [WITH_SCIPY] [ROBOT...], with the program in target/debug or where CDPR says. For each robot it draws robots from
tolerances and simulates campaigns (`cdpr calibrate simulate`). The program calibrates each; then SciPy
does so for the first WITH_SCIPY of them, from the same start, robot by robot: it may be ended at any time.
data/reference/campaigns.json gets the chi-squares and how often the truth lies within 1.96 of the standard
deviations printed. Robots that are not named keep what is there.
"""

import csv
import json
import os
import subprocess
import sys
import tempfile

import numpy as np
import scipy
from scipy.spatial.transform import Rotation

os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
sys.path.insert(0, "data/reference")

from campaign_fit import Campaign, parameters  # noqa: E402

PROGRAM = os.environ.get("CDPR", "target/debug/cdpr")
RECORD = "data/reference/campaigns.json"
EXTERNAL = {"position": 1e-4, "rotation": 1e-4, "length": 1e-4}


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
    """A robot with eight cables at random places of a frame, the upper ones crossed."""
    random = np.random.default_rng(46)
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (0, 1)])
    robot = library("caroca")
    robot["name"] = "drawn"
    for cable, corner in zip(robot["cables"], corners):
        exit_point = corner * [3, 2.5, 3.2] + random.uniform(-0.3, 0.3, 3)
        crossed = corner * [1 - 2 * corner[2], 1, 1]
        anchor = crossed * [0.3, 0.25, 0.4] + random.uniform(-0.05, 0.05, 3)
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
        lambda: library("four-cables"), 2e-3, [0.3, 0.3, 2], [0.15, 0.1, 0.4], 0.0, "roll,pitch", EXTERNAL, 30),
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
    arguments = ["--poses", at("poses.csv"), "--uncertainty", at("model.json"), "--noise", given, "--seed", str(seed)]
    arguments += ["--out", at("rows.csv"), "--truth", at("truth.json"), "--overwrite"]
    run("calibrate", "simulate", at("robot.json"), *arguments, *(["--free", free] if free else []))
    with open(at("rows.csv")) as file:
        rows = list(csv.DictReader(file))
    with open(at("truth.json")) as file:
        truth = parameters(json.load(file))
    return robot, stds, rows, truth, given, (places, rotations)


def calibrated(folder, given):
    at = lambda name: os.path.join(folder, name)
    arguments = [at("rows.csv"), "--uncertainty", at("model.json"), "--noise", given, "--with", "folds=0"]
    text = run("calibrate", "fit", at("robot.json"), *arguments, "--out", at("out"), "--overwrite", "--format", "json",
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


def by_program(folder, case, seed):
    """Chi-square by the program, none yet by SciPy, status, parameters printed and those of them inside."""
    robot, _, _, truth, given, _ = simulated(folder, case, seed)
    summary = calibrated(folder, given)
    printed = inside = 0
    for parameter, value in zip(names(robot), truth):
        of = summary["parameters"].get(parameter)
        if of and of["std"] is not None:
            printed += 1
            inside += bool(abs(of["after"] - value) <= 1.959964 * of["std"])
    return [round(summary["chi_square"], 5), None, summary["status"], printed, inside]


def by_scipy(folder, case, seed):
    """Chi-square by SciPy, None where it found no minimum."""
    robot, stds, rows, _, _, poses = simulated(folder, case, seed)
    campaign = Campaign(robot, stds, rows, case[6], started(robot, rows, case[6], poses))
    try:
        chi_square, _, is_minimum = campaign.fit()
    except ValueError:
        # A step has led to numbers that are not finite.
        return None
    return round(float(chi_square), 5) if is_minimum else None


def summarized(campaigns, tried):
    both = [of for of in campaigns if of[1] is not None]
    above = [of[0] - of[1] for of in both if of[2] == "converged"]
    shares = np.array([100 * of[4] / of[3] for of in campaigns])
    printed, inside = (sum(of[k] for of in campaigns) for k in (3, 4))
    return {
        "campaigns": len(campaigns),
        "not_converged": sum(of[2] != "converged" for of in campaigns),
        "printed": printed,
        "inside_95": round(100 * inside / printed, 2),
        "error_of_inside": round(float(shares.std() / max(1, len(shares) - 1) ** 0.5), 2),
        "tried_by_scipy": tried,
        "compared_with_scipy": len(both),
        "most_above_scipy": round(max(above), 5) if above else None,
        "chi_squares": campaigns,
    }


def write(found):
    about = (
        f"data/reference/campaigns.py, SciPy {scipy.__version__}; of each campaign: chi-square of the program, of "
        "SciPy (null where it found no minimum), status, parameters printed, those of them within 95 %; "
        "error_of_inside is the standard error of inside_95 over the campaigns; most_above_scipy is over those that "
        "say converged"
    )
    known = [name for name in ROBOTS if name in found]
    robots = ",\n".join(f"  {json.dumps(name)}: {json.dumps(found[name])}" for name in known)
    with open(RECORD + ".part", "w") as file:
        file.write(f'{{\n "source": {json.dumps(about)},\n "robots": {{\n{robots}\n }}\n}}\n')
    os.replace(RECORD + ".part", RECORD)


def main():
    campaigns = int(sys.argv[1]) if len(sys.argv) > 1 else 50
    with_scipy = int(sys.argv[2]) if len(sys.argv) > 2 else campaigns
    only = sys.argv[3:] or list(ROBOTS)
    folder = tempfile.mkdtemp()
    found = {}
    if os.path.exists(RECORD):
        with open(RECORD) as file:
            found = json.load(file)["robots"]
    done = {name: [] for name in only}
    for name in only:
        for seed in range(1, campaigns + 1):
            done[name].append(by_program(folder, ROBOTS[name], seed))
        found[name] = summarized(done[name], 0)
        write(found)
        figures = {k: v for k, v in found[name].items() if k != "chi_squares"}
        print(name, figures, file=sys.stderr, flush=True)
    for seed in range(1, min(campaigns, with_scipy) + 1):
        for name in only:
            done[name][seed - 1][1] = by_scipy(folder, ROBOTS[name], seed)
            found[name] = summarized(done[name], seed)
            write(found)
        print(f"{seed} by SciPy", file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
