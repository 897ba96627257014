"""Where platforms rest after a cable is cut, by MoorDyn (pip install moordyn==2.7.2 numpy; half an hour):

python3 cuts.py CDPR FOLDER > cuts.json
python3 cuts.py CDPR FOLDER caroca 2 10      one cable of one robot, with this many segments, on the terminal

CDPR is the program, which writes the robot at its pose for MoorDyn with the lengths that hold it (`cdpr robot export`).
Of its rests after cuts nothing is used. FOLDER gets the files of MoorDyn. In them:

- the line of the cut cable is left out; the others start as catenaries between the ends that they have at the pose;
- a line has SEGMENTS straight segments with its mass in the nodes, twice: the difference shows what they cost;
- MoorDyn's water has rho = 1 kg/m3 and is everywhere: all is moved down, below its surface, and the seabed is far
  below. Its buoyancy is put on the mass of the lines again, so that their weight in it is that of the robot's cables;
- damping, which is zero where nothing moves, so that it has no part in the rest:
  lines: BA = h sqrt(EA mu), h being the length of a segment, so that a wave that passes it is damped; drag across and
  along the line of DRAG mu |v| v for each metre, by the coefficients Cd and CdAx;
  platform: nine dashpots, lines of one segment without EA and mass to points far away along x, y and z, from three
  points of the platform. Together they are RATE times the mass against motion, and RATE times m r^2 against rotation,
  r being the radius of inertia.

The final pose is that after UNTIL seconds; `late` is how far P has moved in the last of them [m].
"""

import concurrent.futures
import importlib.metadata
import json
import math
import os
import subprocess
import sys

import moordyn
import numpy

#: Robot, pose, the cable that is cut (from 1), segments of a line, damping of the platform [1/s].
CASES = [
    ("ipanema-1", [0, 0, 1], 1, [4, 8], 2.0),
    ("cogiro", [0, 0, 2], 1, [10, 20], 2.0),
    ("caroca", [0.4, 0.3, 1.75], 2, [5, 10], 2.0),
    ("caroca", [0.4, 0.3, 1.75], 3, [5, 10], 2.0),
    ("fast", [0, 0, 140.1], 1, [40, 80], 0.5),
]

UNTIL = 60
DRAG = 20.0
WATER = 1.0
FAR = 1e4


def tables(text):
    """The rows of the tables of MoorDyn's file, as words."""
    found, heading = {}, None
    for line in text.splitlines():
        if line.startswith("---"):
            heading, skip = line.strip("- "), 0 if "OPTIONS" in line else 2
            found[heading] = []
        elif skip:
            skip -= 1
        else:
            found[heading].append(line.split())
    return found


def exported(program, folder, robot, pose, segments):
    """What `cdpr robot export` writes."""
    path = f"{folder}/{robot}-exported-{segments}.txt"
    at = "--pose=" + ",".join(map(str, pose))
    arguments = [program, "robot", "export", robot, "--to", "moordyn", at, "--out", path, "--overwrite", "--quiet"]
    subprocess.run(arguments, check=True, capture_output=True)
    with open(path) as file:
        return tables(file.read())


class System:
    """The robot without some of its cables, for MoorDyn."""

    def __init__(self, found, cut, segments, rate):
        options = {name: value for value, name in found["OPTIONS"]}
        self.gravity = float(options["g"])
        kinds, lines = found["LINE TYPES"], found["LINES"]
        self.count = len(lines)
        self.segments, self.rate = segments, rate
        places = [[float(word) for word in row[2:5]] for row in found["POINTS"]]
        self.exits, self.anchors = places[: self.count], places[self.count :]
        row = found["BODIES"][0]
        self.pose, self.mass = [float(word) for word in row[2:5]], float(row[8])
        self.center, self.inertia = row[9], [float(word) for word in row[10].split("|")]
        self.kept = [i for i in range(self.count) if i + 1 != cut]
        self.lengths = [float(line[4]) for line in lines]
        self.kinds = [tuple(map(float, kind[1:4])) for kind in kinds]
        # All is below the surface.
        self.shift = -10.0 - max(z for _, _, z in self.exits) - max(self.lengths)
        # RK4 follows the axial waves of the segments below 1.41 h/c, c being the speed of such waves.
        waves = [length * math.sqrt(mu / ea) for length, (_, mu, ea) in zip(self.lengths, self.kinds)]
        self.step = 0.5 * min(waves) / segments

    def radius(self):
        """The radius of inertia [m]."""
        return math.sqrt(sum(self.inertia) / (3 * self.mass))

    def text(self):
        types, points, lines = [], [], []
        for i, (diameter, mu, ea) in enumerate(self.kinds):
            buoyancy = WATER * math.pi / 4 * diameter**2
            damping = math.sqrt(ea * mu) * self.lengths[i] / self.segments
            drag = DRAG * mu / (0.5 * WATER * diameter)
            elastic, drags = f"{ea!r} {damping!r} 0", f"{drag!r} 0 {drag / math.pi!r} 0"
            types.append(f"cable{i + 1} {diameter!r} {mu + buoyancy!r} {elastic} {drags}")
        for x, y, z in self.exits:
            points.append(f"{len(points) + 1} Fixed {x!r} {y!r} {z + self.shift!r} 0 0 0 0")
        for x, y, z in self.anchors:
            points.append(f"{len(points) + 1} Body1 {x!r} {y!r} {z!r} 0 0 0 0")
        for i in self.kept:
            lines.append(f"{i + 1} cable{i + 1} {i + 1} {self.count + i + 1} {self.lengths[i]!r} {self.segments} -")
        # Each of nine dashpots has a third of what acts along its direction. Those along y and z turn about x, from
        # the points on the axes z and y.
        dashpot = self.rate * self.mass / 3
        types.append(f"dashpot 1e-6 0 0 {dashpot * 2 * FAR!r} 0 0 0 0 0")
        for at in numpy.identity(3) * math.sqrt(1.5) * self.radius():
            points.append(f"{len(points) + 1} Body1 {at[0]:.17g} {at[1]:.17g} {at[2]:.17g} 0 0 0 0")
            of = len(points)
            for away in numpy.identity(3) * FAR * [1, 1, -1]:
                far = numpy.array(self.pose) + [0, 0, self.shift] + at + away
                points.append(f"{len(points) + 1} Fixed {far[0]:.17g} {far[1]:.17g} {far[2]:.17g} 0 0 0 0")
                # Twice as long as the distance: never taut.
                lines.append(f"{len(points)} dashpot {len(points)} {of} {2 * FAR!r} 1 -")
        lines = [f"{i + 1} " + line.split(" ", 1)[1] for i, line in enumerate(lines)]
        x, y, z = self.pose
        body = f"1 Free {x!r} {y!r} {z + self.shift!r} 0 0 0 {self.mass!r} {self.center} "
        body += "|".join(map(repr, self.inertia)) + " 0 0 0"
        sections = [
            ("LINE TYPES", "Name Diam Mass EA BA EI Cd Ca CdAx CaAx", types),
            ("BODIES", "ID Attachment X0 Y0 Z0 r0 p0 y0 Mass CG I Volume CdA Ca", [body]),
            ("POINTS", "ID Attachment X Y Z Mass Volume CdA Ca", points),
            ("LINES", "ID LineType AttachA AttachB UnstrLen NumSegs Outputs", lines),
        ]
        text = "--- MoorDyn v2 input file ---\n"
        for name, head, rows in sections:
            text += f"--- {name} ---\n{head}\n(-)\n" + "\n".join(rows) + "\n"
        options = [f"{self.gravity!r} g", f"{WATER!r} rho", f"{10 * FAR!r} WtrDpth", "rk4 tScheme"]
        options += [f"{self.step!r} dtM", "0 TmaxIC"]
        return text + "--- OPTIONS ---\n" + "\n".join(options) + "\n--- need this line ---\n"

    def place(self, system):
        """Position of P and the rotation, of where the anchor points are."""
        at = numpy.array([moordyn.GetPointPos(moordyn.GetPoint(system, self.count + i + 1)) for i in range(self.count)])
        of = numpy.array(self.anchors)
        u, _, v = numpy.linalg.svd((at - at.mean(0)).T @ (of - of.mean(0)))
        rotation = u @ numpy.diag([1, 1, numpy.linalg.det(u @ v)]) @ v
        position = moordyn.GetBodyPos(moordyn.GetBody(system, 1))
        apart = numpy.abs(position + of @ rotation.T - at).max()
        assert apart < 1e-6, apart
        return numpy.array(position) - [0, 0, self.shift], rotation


def quaternion(rotation):
    """Of a rotation of less than half a turn: w, x, y, z."""
    w = math.sqrt(max(1 + numpy.trace(rotation), 0)) / 2
    a = rotation - rotation.T
    return [w, a[2, 1] / (4 * w), a[0, 2] / (4 * w), a[1, 0] / (4 * w)]


def rest(program, folder, robot, pose, cut, segments, rate):
    """The robot, and where the platform is at the end."""
    of = System(exported(program, folder, robot, pose, segments), cut, segments, rate)
    name = f"{robot}-{cut}-{segments}"
    with open(f"{folder}/{name}.txt", "w") as file:
        file.write(of.text())
    # MoorDyn prints all that it reads.
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    system = moordyn.Create(f"{folder}/{name}.txt")
    if moordyn.Init(system, [], []) != 0:
        raise SystemExit(f"MoorDyn does not take {folder}/{name}.txt")
    track, seen = [of.place(system)[0]], open(f"{folder}/{name}.csv", "w")
    for second in range(UNTIL):
        moordyn.Step(system, [], [], float(second), 1.0)
        position, rotation = of.place(system)
        track.append(position)
        print(second + 1, *position, *quaternion(rotation), sep=",", file=seen, flush=True)
    tensions = [0.0] * of.count
    for k, i in enumerate(of.kept):
        # What it pulls at the platform with, the weight of half a segment included.
        force = moordyn.GetLineNodeForce(moordyn.GetLine(system, k + 1), segments)
        tensions[i] = float(numpy.linalg.norm(force))
    moordyn.Close(system)
    return of, {
        "segments": segments,
        "step_s": of.step,
        "position": track[-1].tolist(),
        "rotation": quaternion(rotation),
        "tensions": tensions,
        "late_m": float(numpy.linalg.norm(track[-1] - track[-2])),
        "farthest_m": float(max(numpy.linalg.norm(position - track[0]) for position in track)),
    }


def case(robot, pose, cut, rate, of, rests):
    """The case with both rests, and what they tend to: errors are as the square of a segment."""
    coarse, fine = rests
    share = 1.0 / ((fine["segments"] / coarse["segments"]) ** 2 - 1.0)
    tends = {}
    for name in ("position", "rotation", "tensions"):
        one, other = numpy.array(coarse[name]), numpy.array(fine[name])
        tends[name] = (other + share * (other - one)).tolist()
    tends["rotation"] = (numpy.array(tends["rotation"]) / numpy.linalg.norm(tends["rotation"])).tolist()
    damping = {"platform_rate_per_s": rate, "radius_m": of.radius(), "drag_per_m": DRAG}
    head = {"robot": robot, "pose": pose, "cut": cut, "lengths": of.lengths, "damping": damping}
    return head | {"rests": rests} | tends


def main(program, folder, *one):
    wanted = CASES
    if one:
        of, cut, segments = one[0], int(one[1]), int(one[2])
        _, pose, _, _, rate = next(case for case in CASES if case[0] == of)
        wanted = [(of, pose, cut, [segments], rate)]
    with concurrent.futures.ProcessPoolExecutor(2, max_tasks_per_child=1) as pool:
        runs = [
            [pool.submit(rest, program, folder, robot, pose, cut, segments, rate) for segments in both]
            for robot, pose, cut, both, rate in wanted
        ]
        done = [[run.result() for run in both] for both in runs]
    if one:
        print(json.dumps(done[0][0][1]))
        return
    cases = []
    for (robot, pose, cut, _, rate), both in zip(wanted, done):
        cases.append(case(robot, pose, cut, rate, both[0][0], [found for _, found in both]))
    about = {
        "what": __doc__.split("\n")[0].split(" (")[0] + ": poses (w, x, y, z), tensions at the platform [N].",
        "moordyn": importlib.metadata.version("moordyn"),
        "seconds": UNTIL,
        "how": "cuts.py, which says how the damping acts. position, rotation and tensions are extrapolated from both "
        "rests, with errors as the square of a segment's length.",
    }
    json.dump({"about": about, "cases": cases}, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main(*sys.argv[1:])
