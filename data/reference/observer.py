"""Writes observer.json: batch least squares of payload, its moment and the modulus from lengths and tensions.

The robot is CAROCA with cables without weight: straight springs. Equilibria by Newton's method whose Jacobian is
taken by complex steps, derivatives by the implicit function theorem, the batch by Gauss and Newton with the prior as
further residuals. It shares no code with the project. Run: python data/reference/observer.py
"""

import json
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).parent
ROBOT = json.loads((FOLDER / "../robots/caroca.json").read_text())
ANCHORS = np.array([cable["anchor_point"] for cable in ROBOT["cables"]], float)
EXITS = np.array([cable["exit_point"] for cable in ROBOT["cables"]], float)
MASS, CENTER = ROBOT["platform"]["mass"], np.array(ROBOT["platform"]["center_of_mass"], float)
EA = ROBOT["cable"]["section"] * ROBOT["cable"]["youngs_modulus"]
GRAVITY = np.array([0.0, 0.0, -ROBOT.get("gravity", 9.81)])
TENSION_STD, LENGTH_STD = 5.0, 2e-5
PRIOR = np.array([20.0, 2.0, 2.0, 2.0, 0.05])
TRUTH = np.array([5.0, 0.6, -0.4, 0.3, 1.01])


def rotation(v):
    """The rotation by a vector, for complex numbers, too."""
    square = v @ v
    skew = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    if abs(square) < 1e-8:
        return np.eye(3) + (1 - square / 6) * skew + (0.5 - square / 24) * skew @ skew
    angle = np.sqrt(square)
    return np.eye(3) + np.sin(angle) / angle * skew + (1 - np.cos(angle)) / square * skew @ skew


def model(x, lengths, unknowns):
    """Wrench about P and tensions at a pose (position, rotation vector)."""
    turn = rotation(x[3:])
    arms = ANCHORS @ turn.T
    spans = x[:3] + arms - EXITS
    chords = np.sqrt((spans * spans).sum(axis=1))
    tensions = unknowns[4] * EA * (chords - lengths) / lengths
    tensions = np.where(tensions.real > 0, tensions, 0)
    pulls = -(tensions / chords)[:, None] * spans
    moment = turn @ ((MASS + unknowns[0]) * CENTER + unknowns[1:4])
    force = (MASS + unknowns[0]) * GRAVITY
    wrench = np.concatenate([pulls.sum(axis=0) + force, np.cross(arms, pulls).sum(axis=0) + np.cross(moment, GRAVITY)])
    return wrench, tensions


def jacobian(of, at):
    """The derivatives of `of` by complex steps, a column for each input."""
    columns = []
    for k in range(len(at)):
        moved = np.array(at, complex)
        moved[k] += 1e-30j
        columns.append(np.imag(of(moved)) / 1e-30)
    return np.array(columns).T


def rest(x, lengths, unknowns):
    for _ in range(50):
        wrench = model(x, lengths, unknowns)[0]
        step = np.linalg.solve(jacobian(lambda y: model(y, lengths, unknowns)[0], x), -wrench)
        x = x + step
        if np.abs(step).max() < 1e-14:
            break
    return x


def sample(x, lengths, unknowns):
    """Pose, tensions, and their derivatives by the unknowns and by the lengths."""
    x = rest(x, lengths, unknowns)
    both = lambda y, l, u: np.concatenate(model(y, l, u))
    per_pose = jacobian(lambda y: both(y, lengths, unknowns), x)
    per_unknown = jacobian(lambda u: both(x, lengths, u), unknowns)
    per_length = jacobian(lambda l: both(x, l, unknowns), lengths)
    total = lambda partial: partial[6:] - per_pose[6:] @ np.linalg.solve(per_pose[:6], partial[:6])
    return x, model(x, lengths, unknowns)[1], total(per_unknown), total(per_length)


def noise(per_length):
    return TENSION_STD**2 * np.eye(len(EXITS)) + LENGTH_STD**2 * per_length @ per_length.T


def batch(starts, lengths, readings):
    """The unknowns of least squares of all samples and the prior, and their covariance."""
    nominal = np.array([0, 0, 0, 0, 1.0])
    unknowns = nominal.copy()
    for _ in range(20):
        information, right = np.diag(PRIOR**-2.0), (nominal - unknowns) / PRIOR**2
        for x, l, reading in zip(starts, lengths, readings):
            _, tensions, rows, per_length = sample(x, l, unknowns)
            weight = np.linalg.inv(noise(per_length))
            information = information + rows.T @ weight @ rows
            right = right + rows.T @ weight @ (reading - tensions)
        step = np.linalg.solve(information, right)
        unknowns = unknowns + step
        if np.abs(step / PRIOR).max() < 1e-12:
            break
    return unknowns, np.linalg.inv(information)


def main():
    rng = np.random.default_rng(51)
    poses = [
        np.array([0.6 * s, 0.4 * np.sin(3 * s), 1.6 + 0.2 * s, 0.1 * np.sin(2 * s), 0.12 * np.cos(3 * s), 0.2 * s])
        for s in np.linspace(-1, 1, 60)
    ]
    # Lengths with which each cable would pull with 500 N at the pose; the platform then finds its rest.
    lengths, starts, readings = [], [], []
    for pose in poses:
        spans = pose[:3] + ANCHORS @ rotation(pose[3:]).T - EXITS
        wanted = np.linalg.norm(spans, axis=1) / (1 + 500 / EA)
        x = rest(pose, wanted, np.array([0, 0, 0, 0, 1.0]))
        tensions = model(rest(x, wanted, TRUTH), wanted, TRUTH)[1]
        assert (tensions > 20).all(), tensions
        lengths.append(wanted)
        starts.append(x)
        readings.append(tensions + TENSION_STD * rng.standard_normal(len(tensions)))
    unknowns, covariance = batch(starts, lengths, readings)
    first, first_covariance = batch(starts[:1], lengths[:1], readings[:1])
    _, tensions, _, per_length = sample(starts[0], lengths[0], first)
    left, away = readings[0] - tensions, (first - [0, 0, 0, 0, 1]) / PRIOR
    result = {
        "about": "CAROCA with cables without weight. `first` is the least squares of one sample and its "
        "chi-square, `batch` that of all; unknowns: mass [kg], moment about the "
        "platform's centre of mass [kg m], modulus as a multiple. Written by observer.py.",
        "tension_std": TENSION_STD,
        "length_std": LENGTH_STD,
        "prior": PRIOR.tolist(),
        "truth": TRUTH.tolist(),
        "start": starts[0].tolist(),
        "lengths": np.array(lengths).tolist(),
        "tensions": np.array(readings).tolist(),
        "first": {
            "unknowns": first.tolist(),
            "chi_square": float(left @ np.linalg.solve(noise(per_length), left) + away @ away),
            "covariance": first_covariance.tolist(),
        },
        "batch": {"unknowns": unknowns.tolist(), "covariance": covariance.tolist()},
    }
    (FOLDER / "observer.json").write_text(json.dumps(result, indent=1) + "\n")
    print("batch", unknowns, "std", np.sqrt(np.diag(covariance)))
    print("first", result["first"]["unknowns"])


if __name__ == "__main__":
    main()
