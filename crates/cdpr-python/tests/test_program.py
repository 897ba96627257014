"""The command `cdpr` of the wheel answers as the program does."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from conftest import command

HERE = Path(sys.executable).with_name("cdpr.exe" if os.name == "nt" else "cdpr")
#: The command that the wheel installs, and the module.
CALLS = [[str(HERE)], [sys.executable, "-m", "cdpr"]]


def run(call, *arguments):
    return subprocess.run([*call, *arguments], capture_output=True, text=True, check=False)


@pytest.mark.parametrize("call", CALLS, ids=["command", "module"])
@pytest.mark.parametrize(
    "arguments",
    [
        ["deflection", "caroca", "--pose", "0,0,1.75", "--payload", "50", "--format", "json"],
        ["robot", "list"],
        ["--help"],
        # Out of the limits of tensions, and a mistake.
        ["inverse", "caroca", "--pose", "0,0,9"],
        ["inverse", "caroca", "--pose", "nowhere"],
        [],
    ],
    ids=lambda arguments: " ".join(arguments[:2]) or "nothing",
)
def test_the_command_answers_and_ends_as_the_program_does(call, arguments):
    given, expected = run(call, *arguments), command(*arguments)
    assert (given.returncode, given.stdout, given.stderr) == (expected.returncode, expected.stdout, expected.stderr)


def test_the_command_is_of_the_same_version():
    import cdpr

    assert run(CALLS[0], "--version").stdout.split()[:2] == ["cdpr", cdpr.__version__]


@pytest.mark.skipif(os.name == "nt", reason="Windows has no bytes in paths, and no such signals")
def test_the_command_takes_any_path_and_ends_by_a_signal(tmp_path, caroca_file):
    odd = os.fsencode(tmp_path) + b"/\xff.json"
    Path(os.fsdecode(odd)).write_bytes(Path(caroca_file).read_bytes())
    done = subprocess.run([*CALLS[0], "robot", "check", odd], capture_output=True, check=False)
    assert done.returncode in (0, 3), done.stderr
    out = str(tmp_path / "out")
    study = run(CALLS[0], "study", "new", "caroca").stdout
    (tmp_path / "study.json").write_text(study)
    call = [*CALLS[0], "study", "run", str(tmp_path / "study.json"), "--out", out, "--observations", "100000000"]
    process = subprocess.Popen(call, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(3)
    assert process.poll() is None
    process.send_signal(signal.SIGINT)
    assert process.wait(30) in (130, -signal.SIGINT)
