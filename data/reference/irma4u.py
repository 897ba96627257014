"""IRMA4U's self-calibration from a user's own copy of its files, which have no licence and are not here.

python3 data/reference/irma4u.py ws_selfcalibration_27_final.mat [ws_selfcalibration_8_final.mat]

The files are those of github.com/fzoffoli/UACDPR_SelfCalibration (campaigns of March 2025): `cable_length_meas`
(4 x n, m), `tau_zero` with `loadcell_meas` (4 x n, N), `epsilon_meas` (3 x n, roll, pitch, yaw, rad) and
`swivel_meas` (4 x n, rad). Poses are not measured. Offsets of the four lengths and of the three angles are sought
(`cdpr calibrate`), and the residuals of each sensor are printed beside what the authors report for their own
method: the initial pose to 7.3 mm and 2.2 degrees (27 poses), 10.5 mm and 1.4 degrees (8 poses).

A CSV with the columns l1..l4, t1..t4, roll, pitch, yaw, s1..s4 in these units is taken, too. It needs SciPy for
.mat files, and the program in target/debug or in the variable CDPR.
"""

import csv
import json
import math
import os
import subprocess
import sys
import tempfile

NOISE = "length=5e-3,tension=7,rotation=7e-3,swivel=2e-2"


def campaign(path):
    """Lengths, tensions, angles and swivel angles, a row for each pose."""
    if path.endswith(".csv"):
        with open(path) as file:
            rows = list(csv.DictReader(file))
        pick = lambda names: [[float(row[name]) for name in names] for row in rows]
        cables = lambda letter: [f"{letter}{i}" for i in range(1, 5)]
        return pick(cables("l")), pick(cables("t")), pick(["roll", "pitch", "yaw"]), pick(cables("s"))
    from scipy.io import loadmat

    data = loadmat(path, squeeze_me=True)
    lengths, angles, swivels = (data[name].T.tolist() for name in ("cable_length_meas", "epsilon_meas", "swivel_meas"))
    tensions = data["loadcell_meas"].T.tolist()
    if len(tensions) == len(lengths) - 1:
        tensions = [data["tau_zero"].ravel().tolist(), *tensions]
    return lengths, tensions, angles, swivels


def main():
    program = os.environ.get("CDPR", "target/debug/cdpr")
    for path in sys.argv[1:] or sys.exit(__doc__):
        lengths, tensions, angles, swivels = campaign(path)
        folder = tempfile.mkdtemp()
        table = os.path.join(folder, "measurements.csv")
        cables = range(1, 5)
        with open(table, "w", newline="") as file:
            out = csv.writer(file)
            head = [f"l{i}_m" for i in cables] + [f"t{i}_winch_n" for i in cables] + ["roll_rad", "pitch_rad", "yaw_rad"]
            out.writerow(head + [f"swivel{i}_rad" for i in cables])
            for l, t, a, s in zip(lengths, tensions, angles, swivels):
                # Their swivel angles count from the vertical, ours from the horizontal.
                out.writerow(l + t + a + [angle - math.pi / 2 for angle in s])
        arguments = ["calibrate", "data/robots/irma4u.json", "--measurements", table, "--parameters", "none"]
        arguments += ["--unknown", "length_offset=0.05,angle_offset", "--starts", "10", "--noise", NOISE, "--format", "json"]
        found = subprocess.run([program, *arguments, "--out", os.environ.get("OUT", os.path.join(folder, "out"))], capture_output=True, text=True)
        if found.returncode not in (0, 3):
            sys.exit(found.stderr)
        summary = json.loads(found.stdout)
        print(f"{os.path.basename(path)}: {summary['rows']} poses; the authors: initial pose to 7.3 mm (27), 10.5 mm (8)")
        for sensor, of in summary["residuals"].items():
            scale, unit = {"m": (1e3, "mm"), "rad": (180 / math.pi, "deg"), "N": (1, "N")}[of["unit"]]
            before, after = scale * of["rms_before"], scale * of["rms_after"]
            print(f"  {sensor:10s} {of['count']:4d} numbers, rms {before:8.3f} -> {after:8.3f} {unit}")
        for name, of in summary["sensors"].items():
            std = "-" if of["std"] is None else f"{of['std']:.2e}"
            print(f"  {name:20s} {of['after']:+.5f} {of['unit']}, std {std}")


main()
