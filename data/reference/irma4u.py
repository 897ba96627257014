"""IRMA4U's self-calibration from a user's own copy of its files, which have no licence and are not here.

python3 data/reference/irma4u.py ws_selfcalibration_27_final.mat [ws_selfcalibration_8_final.mat]

The files are those of github.com/fzoffoli/UACDPR_SelfCalibration (campaigns of March 2025):
`cable_length_meas` (4 x n, m), `tau_zero` with `loadcell_meas` (4 x n, N), `epsilon_meas` (3 x n, roll,
pitch, yaw, rad) and `swivel_meas` (4 x n, rad). Poses are not measured. Two fits are made by
`cdpr calibrate fit`:

- offsets: lengths count from the homing; offsets of the lengths (50 mm) and of the three angles are sought;
- relative: as the authors weigh it. Lengths, swivel angles and yaw count from anywhere; 10 mm, 10 N,
  2 degrees, 1 degree.

The angles are those of Rz(yaw) Ry(pitch) Rx(roll): the authors take them as of Rx Ry Rz, but that fits worse
(roll and pitch 0.57 and 0.66 degrees in place of 0.34 and 0.27, 27 poses).

Printed are the residuals of each sensor; those of the tensions without and with friction of the pulleys, by
`cdpr calibrate pulleys` at the fitted poses; and how far the first pose lies from the one that the authors take
as true, `zeta_0_real`, which their pose estimation makes of the lengths and angles: beside the distance of
their own self-calibration in the same file (7.3 mm for 27 poses, 10.5 mm for 8).

A CSV with the columns l1..l4, t1..t4, roll, pitch, yaw, s1..s4 in these units is taken, too. It needs SciPy
for .mat files, and the program in target/debug or in the variable CDPR.
"""

import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import warnings

ROBOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../robots/irma4u.json")

NOWHERE = "angle_offset.roll=-1e-9:1e-9,angle_offset.pitch=-1e-9:1e-9"

FITS = {
    "offsets": [
        "--unknown",
        "length_offset=0.05,angle_offset",
        "--noise",
        "length=5e-3,tension=7,rotation=7e-3,swivel=2e-2",
    ],
    "relative": [
        *["--unknown", "length_offset,swivel_offset,angle_offset", "--bounds", NOWHERE],
        *["--noise", "length=1e-2,tension=10,rotation=0.0349,swivel=0.01745"],
    ],
}


def campaign(path):
    """Lengths, tensions, angles and swivel angles, a row for each pose; the authors' poses and distance."""
    if path.endswith(".csv"):
        with open(path) as file:
            rows = list(csv.DictReader(file))
        pick = lambda names: [[float(row[name]) for name in names] for row in rows]
        cables = lambda letter: [f"{letter}{i}" for i in range(1, 5)]
        return (pick(cables("l")), pick(cables("t")), pick(["roll", "pitch", "yaw"]), pick(cables("s"))), None
    from scipy.io import loadmat

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of an object without a name
        data = loadmat(path, squeeze_me=True)
    lengths, angles, swivels = (
        data[name].T.tolist() for name in ("cable_length_meas", "epsilon_meas", "swivel_meas")
    )
    tensions = data["loadcell_meas"].T.tolist()
    if len(tensions) == len(lengths) - 1:
        tensions = [data["tau_zero"].ravel().tolist(), *tensions]
    theirs = None
    if "zeta_0_real" in data:
        theirs = data["zeta_0_real"].tolist()[:3], float(data["InitialPositionErrorNorm"])
    return (lengths, tensions, angles, swivels), theirs


def table(columns, path):
    lengths, tensions, angles, swivels = columns
    cables = range(1, 5)
    with open(path, "w", newline="") as file:
        out = csv.writer(file)
        head = (
            [f"l{i}_m" for i in cables]
            + [f"t{i}_winch_n" for i in cables]
            + ["roll_rad", "pitch_rad", "yaw_rad"]
        )
        out.writerow(head + [f"swivel{i}_rad" for i in cables])
        for l, t, a, s in zip(lengths, tensions, angles, swivels):
            # Their swivel angles count from the vertical, ours from the horizontal.
            out.writerow(l + t + a + [angle - math.pi / 2 for angle in s])


def rms(values):
    return math.sqrt(sum(value * value for value in values) / len(values))


def residuals(path):
    """Measured less modelled, by column."""
    columns = {}
    with open(path) as file:
        for row in csv.DictReader(file):
            name = re.sub(r"[1-4]?(_winch)?_(m|n|rad)$", "", row["column"])
            columns.setdefault((name, row["unit"]), []).append((float(row["before"]), float(row["after"])))
    return columns


def with_friction(program, out, columns):
    """Residuals of the tensions without and with friction of the pulleys, at the poses of a fit."""
    lengths, tensions, _, _ = columns
    cables = range(1, 5)
    path = os.path.join(out, "winches.csv")
    names = ["x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"]
    with open(os.path.join(out, "poses.csv")) as poses, open(path, "w", newline="") as file:
        write = csv.writer(file)
        write.writerow(names + [f"l{i}_m" for i in cables] + [f"t{i}_winch_n" for i in cables])
        for pose, l, t in zip(csv.DictReader(poses), lengths, tensions):
            write.writerow([pose[name] for name in names] + l + t)
    robot = os.path.join(out, "calibrated.json")
    command = [program, "calibrate", "pulleys", robot, path, "--free", "roll,pitch", "--format", "json"]
    found = subprocess.run(command, capture_output=True, text=True, check=False)
    if found.returncode != 0:
        print(f"  friction of the pulleys: {found.stderr.strip().splitlines()[-1].replace(out, '')}")
        return
    found = json.loads(found.stdout)
    without, rms = found["rms_n"]
    (one, other), of = found["combination"], found["combined"]
    print(f"  tension residuals at {len(found['readings'])} readings: {without:.3f} N without friction, {rms:.3f} N with")
    print(f"  {one:.3f} friction + {other:.3f} bearing = {of['value']:.4f} +- {of['std']:.4f}")


def main():
    program = os.environ.get("CDPR", "target/debug/cdpr")
    for path in sys.argv[1:] or sys.exit(__doc__):
        columns, theirs = campaign(path)
        folder = tempfile.mkdtemp()
        measurements = os.path.join(folder, "measurements.csv")
        table(columns, measurements)
        for name, arguments in FITS.items():
            out = os.path.join(folder, name)
            command = [
                program,
                "calibrate",
                "fit",
                ROBOT,
                measurements,
                "--parameters",
                "none",
                "--out",
                out,
            ]
            found = subprocess.run(
                [*command, *arguments, "--with", "starts=10", "--format", "json"],
                capture_output=True,
                text=True,
                check=False,
            )
            if found.returncode not in (0, 3):
                sys.exit(found.stderr)
            summary = json.loads(found.stdout)
            chi, degrees = summary["chi_square"], summary["degrees_of_freedom"]
            title = f"{os.path.basename(path)}, {name}: {summary['rows']} poses"
            print(f"{title}, chi-square {chi:.1f} with {degrees} degrees of freedom")
            for (column, unit), pairs in residuals(os.path.join(out, "residuals.csv")).items():
                scale, unit = {"m": (1e3, "mm"), "rad": (180 / math.pi, "deg"), "N": (1, "N")}[unit]
                before, after = (scale * rms(side) for side in zip(*pairs))
                print(f"  {column:10s} {len(pairs):4d} numbers, rms {before:8.3f} -> {after:8.3f} {unit}")
            if theirs:
                with open(os.path.join(out, "poses.csv")) as file:
                    first = next(csv.DictReader(file))
                place = [float(first[axis]) for axis in ("x_m", "y_m", "z_m")]
                distance = math.dist(place, theirs[0])
                print(
                    f"  first pose {1e3 * distance:.1f} mm from zeta_0_real, the authors' {1e3 * theirs[1]:.1f} mm"
                )
            with_friction(program, out, columns)
            if name == "offsets":
                for sensor, of in summary["sensors"].items():
                    std = "-" if of["std"] is None else f"{of['std']:.2e}"
                    print(f"  {sensor:20s} {of['after']:+.5f} {of['unit']}, std {std}")


main()
