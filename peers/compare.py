"""The same direct problems, inverse models and observations by cdpr and by other programs: peers/run direct.

`crates/cdpr-statics/examples/peer_problem.rs` writes a list of cases with the answers and times of cdpr. Each program
reads it and prints as JSON `version`, `solver` and `cases`, a list of `direct_us`, `direct_position`, `inverse_us`,
`tensions`, `observation_us` and `displacements`; `null` for what it cannot solve. The exit code is 1 where an answer
differs from that of cdpr by more than 1e-6 mm or 1e-6 of the greatest tension.

    compare.py PYTHON_WITH_SCIPY
"""

import json
import math
import os
import subprocess
import sys
from datetime import date

AGREEMENT = {"mm": 1e-6, "tension": 1e-6}
PROBLEM, CERES, RESULT = "target/peers/problem.json", "target/peers/ceres", "target/bench-peers.json"
# The table of docs/PEERS.md.
PAGE = "data/benchmarks/peers.md"
HEAD = "| robot | program | direct | ratio | inverse | ratio | observation | ratio | apart | tensions |\n|" + 10 * "---|"
QUESTIONS = ["direct_us", "inverse_us", "observation_us"]
SYSTEM = "apt install g++ libceres-dev nlohmann-json3-dev"
BUILD = ["g++", "-std=c++17", "-O3", "-DNDEBUG", "-I/usr/include/eigen3", "peers/ceres.cpp", "-o", CERES]
BUILD += ["-lceres", "-lglog"]


def peers(python):
    """Name, packages, a command that succeeds where they are installed, and the command that answers."""
    ceres = ["test", "-x", CERES]
    scipy = [python, "-c", "import scipy.optimize"]
    octave = ["octave-cli", "--version"]
    solve = ["octave-cli", "-q", "peers/direct.m", PROBLEM]
    return [
        ("ceres", SYSTEM, ceres, [CERES, PROBLEM, "tiny"]),
        ("ceres", SYSTEM, ceres, [CERES, PROBLEM]),
        ("scipy", "pip install scipy", scipy, [python, "peers/direct.py", PROBLEM]),
        ("octave", "apt install octave octave-optim", octave, [*solve, "lsqnonlin"]),
        ("octave", "apt install octave octave-optim", octave, [*solve, "fsolve"]),
    ]


def output(command):
    """What a command prints, on one thread; `None` where it fails."""
    threads = dict.fromkeys(["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"], "1")
    try:
        done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, **threads})
    except FileNotFoundError:
        return None
    if done.returncode != 0:
        print(done.stderr[-400:], file=sys.stderr)
    return done.stdout if done.returncode == 0 else None


def apart(answer, ours):
    """Largest differences of two answers: positions [mm], tensions relative to the greatest."""
    points = [(answer["direct_position"], ours["direct_position"])]
    points += zip(answer["displacements"] or [], ours["displacements"], strict=bool(answer["displacements"]))
    tensions = list(zip(answer["tensions"] or [], ours["tensions"], strict=bool(answer["tensions"])))
    greatest = max((other for _, other in tensions), default=1.0)
    return {
        "mm": max(1e3 * math.dist(one, other) for one, other in points),
        "tension": max((abs(one - other) for one, other in tensions), default=0.0) / greatest,
    }


def table(case, answers):
    """Prints the table of a case; returns its times and the largest differences, and its lines for the page."""
    lines = []
    print(f"\n{case['name']}; tensions on a limit: {json.dumps(case['at_limits'])}")
    heads = ["direct [us]", "ratio", "inverse [us]", "ratio", "observation [us]", "ratio", "apart [mm]", "tensions"]
    print(f"{'program':<8}{'version':<9}{'solver':<37}" + "".join(head.rjust(17) for head in heads))
    ours = case["cdpr"]
    rows = [("cdpr", ours, ours), ("cdpr", case["cdpr_alone"], case["cdpr_alone"]), *answers]
    times = {question: {"cdpr": ours[question]} for question in QUESTIONS}
    largest = dict.fromkeys(AGREEMENT, 0.0)
    for name, program, answer in rows:
        found = apart(answer, ours)
        largest = {what: max(largest[what], found[what]) for what in largest}
        cells = []
        for question in QUESTIONS:
            time = answer[question]
            cells += ["-", "-"] if time is None else [f"{time:.1f}", f"{time / ours[question]:.1f}"]
            # Of several solvers of a program the first.
            times[question].setdefault(name, time)
        cells += [f"{found[what]:.1e}" for what in found]
        print(f"{name:<8}{program['version']:<9}{program['solver']:<37}" + "".join(cell.rjust(17) for cell in cells))
        lines.append("| " + " | ".join([case["name"], f"{name} {program['version']} {program['solver']}", *cells]) + " |")
    return {"name": case["name"], **times, **{f"agreement_{what}": largest[what] for what in largest}}, lines


def machine():
    """The date, the commit and the processor of a run."""
    commit = (output(["git", "rev-parse", "--short", "HEAD"]) or "unknown").strip()
    with open("/proc/cpuinfo") as file:
        names = [line.split(": ")[1].strip() for line in file if line.startswith("model name")]
    load = os.getloadavg()[0]
    return f"{date.today()}, {commit}, {names[0] if names else 'unknown'}, {os.cpu_count()} cores, load average {load:.2f}"


def main(python):
    output(BUILD)
    with open(PROBLEM) as file:
        cases = json.load(file)["cases"]
    answers = []
    for name, packages, probe, run in peers(python):
        if output(probe) is None:
            print(f"{name} is not installed: {packages}")
            continue
        print(f"{name}: {' '.join(run)}", file=sys.stderr)
        text = output(run)
        if text is None:
            raise SystemExit(f"{name} has failed")
        answers.append((name, json.loads(text)))
    tables = [table(case, [(name, of, of["cases"][i]) for name, of in answers]) for i, case in enumerate(cases)]
    results = [result for result, _ in tables]
    with open(PAGE, "w") as file:
        file.write("\n".join([machine(), "", HEAD, *(line for _, lines in tables for line in lines)]) + "\n")
    with open(RESULT, "w") as file:
        # The fields at the top are those of the first case, CAROCA.
        json.dump({**results[0], "cases": results}, file, indent=2)
    print(f"\nwritten: {RESULT}, {PAGE}")
    for what, most in AGREEMENT.items():
        if not all(result[f"agreement_{what}"] <= most for result in results):
            raise SystemExit(f"the answers differ by more than {most} {what}")


main(*sys.argv[1:])
