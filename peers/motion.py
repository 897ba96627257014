"""The same motions by `cdpr simulate` and by MoorDyn, on the files of `cdpr robot export --to moordyn`.

Arguments: the program cdpr, how it was built, a folder for files, and the result file. MoorDyn has 20 straight
segments for each cable. It is compared with `cdpr simulate` as it is, and with `cdpr simulate` on 20 straight elements:
there both programs have the same masses and springs, with the damping that such elements have in cdpr.
"""

import csv
import importlib.metadata
import json
import math
import os
import subprocess
import sys
import time

import moordyn
import numpy

SEGMENTS = 20
EVERY = 0.01

#: Robot, pose, what happens at once (a payload [kg] comes, or a cable parts at its anchor point), and the end [s].
CASES = [
    ("cogiro", [0, 0, 2], {"payload": 50}, 1.0),
    ("cogiro", [0, 0, 2], {"cut": 1}, 1.0),
    ("caroca", [0.4, 0.3, 1.75], {"payload": 50}, 1.0),
    ("caroca", [0.4, 0.3, 1.75], {"cut": 1}, 1.0),
    ("ipanema-1", [0, 0, 1], {"payload": 2}, 1.0),
    ("ipanema-1", [0, 0, 1], {"cut": 1}, 0.1),
]


def cdpr(program, *arguments):
    """What the program prints, and its time [s]; it may report a tension above a limit."""
    begin = time.perf_counter()
    one_thread = {**os.environ, "RAYON_NUM_THREADS": "1"}
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, env=one_thread)
    if done.returncode not in (0, 3):
        raise SystemExit(done.stderr)
    return done.stdout, time.perf_counter() - begin


def series(path):
    """Positions of P [m]."""
    with open(path, newline="") as file:
        rows = csv.DictReader(file)
        return numpy.array([[float(row[name]) for name in ("x_m", "y_m", "z_m")] for row in rows])


def table(text, heading):
    """The rows of a table of MoorDyn's file, as words."""
    part = text.split(f" {heading} ")[1].splitlines()[3:]
    return [line.split() for line in part[: next(k for k, line in enumerate(part) if line.startswith("---"))]]


def changed(text, event):
    """The file with the payload, and with the damping of straight elements in cdpr.

    It is EA times the time in which a wave passes an element.
    """
    body = table(text, "BODIES")[0]
    loaded = [*body[:8], repr(float(body[8]) + event.get("payload", 0)), *body[9:]]
    text = text.replace(" ".join(body), " ".join(loaded))
    for kind, line in zip(table(text, "LINE TYPES"), table(text, "LINES")):
        stiffness, density, length = float(kind[3]), float(kind[2]), float(line[4])
        damping = math.sqrt(stiffness * density) * length / SEGMENTS
        text = text.replace(" ".join(kind), " ".join([*kind[:4], repr(damping), *kind[5:]]))
    return text


def in_moordyn(path, event, until):
    """Positions of P [m] and the time of the motion [s]."""
    system = moordyn.Create(str(path))
    if moordyn.Init(system, [], []) != 0:
        raise SystemExit(f"MoorDyn does not take {path}")
    if "cut" in event:
        number = event["cut"]
        anchor = moordyn.GetPoint(system, moordyn.GetNumberLines(system) + number)
        moordyn.BreakLine(system, anchor, moordyn.GetLine(system, number))
    body = moordyn.GetBody(system, 1)
    found, begin = [moordyn.GetBodyPos(body)], time.perf_counter()
    for k in range(round(until / EVERY)):
        moordyn.Step(system, [], [], k * EVERY, EVERY)
        found.append(moordyn.GetBodyPos(body))
    taken = time.perf_counter() - begin
    moordyn.Close(system)
    return numpy.array(found), taken


def compared(program, folder, robot, pose, event, until):
    """A row of the table."""
    at = "--pose=" + ",".join(map(str, pose))
    system, events, fine, straight = (f"{folder}/{name}" for name in ("a.txt", "events.json", "b.csv", "c.csv"))
    cdpr(program, "robot", "export", robot, "--to", "moordyn", at, "--out", system, "--overwrite")
    with open(system) as file:
        text = changed(file.read(), event)
    with open(system, "w") as file:
        file.write(text)
    with open(events, "w") as file:
        json.dump([{"t": 0, **event}], file)
    arguments = ["simulate", robot, at, "--events", events, "--until", until, "--rate", 1 / EVERY, "--overwrite"]
    _, taken = cdpr(program, *arguments, "--out", fine)
    elements = ["--with", f"elements={SEGMENTS},degree=1"]
    _, straight_taken = cdpr(program, *arguments, *elements, "--out", straight)
    theirs, moordyn_taken = in_moordyn(system, event, until)
    ours, same = series(fine), series(straight)
    apart = lambda one, other: 1e3 * float(numpy.linalg.norm(one - other, axis=1).max())
    return {
        "robot": robot,
        "pose": pose,
        "event": event,
        "seconds": until,
        "way_mm": apart(ours, ours[:1]),
        "apart_mm": apart(ours, theirs),
        "apart_same_elements_mm": apart(same, theirs),
        "cdpr_s": taken,
        "cdpr_same_elements_s": straight_taken,
        "moordyn_s": moordyn_taken,
    }


def main(program, build, folder, out):
    # MoorDyn prints all that it reads.
    terminal, quiet = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(quiet, 1)
    rows = [compared(program, folder, *case) for case in CASES]
    os.dup2(terminal, 1)
    version = importlib.metadata.version("moordyn")
    with open(out, "w") as file:
        json.dump({"moordyn": version, "segments": SEGMENTS, "build": build, "rows": rows}, file, indent=2)
        file.write("\n")
    names = ["way [mm]", "apart [mm]", "same elements [mm]", "cdpr [s]", "same [s]", "MoorDyn [s]"]
    widths = [10, 12, 20, 10, 10, 13]
    head = "".join(name.rjust(width) for name, width in zip(names, widths))
    print(f"{'robot':<11}{'event':<15}{head}")
    for row in rows:
        event = " ".join(f"{name} {value}" for name, value in row["event"].items())
        numbers = [row["way_mm"], row["apart_mm"], row["apart_same_elements_mm"]]
        numbers += [row["cdpr_s"], row["cdpr_same_elements_s"], row["moordyn_s"]]
        cells = [f"{value:.3g}".rjust(width) for value, width in zip(numbers, widths)]
        print(f"{row['robot']:<11}{event:<15}{''.join(cells)}")


if __name__ == "__main__":
    main(*sys.argv[1:])
