"""What several tests use: the repository, and the command line to compare with."""

import json
import os
import re
import subprocess
from pathlib import Path

import pytest

import cdpr

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def data():
    return ROOT / "data"


@pytest.fixture(scope="session")
def caroca_file(data):
    return str(data / "robots" / "caroca.json")


@pytest.fixture(scope="session")
def caroca(caroca_file):
    return cdpr.Robot.from_file(caroca_file)


@pytest.fixture(scope="session")
def cogiro_file(data):
    return str(data / "robots" / "cogiro.json")


@pytest.fixture(scope="session")
def cogiro(cogiro_file):
    return cdpr.Robot.from_file(cogiro_file)


def program():
    """The command line: CDPR, or what cargo has built last."""
    if "CDPR" in os.environ:
        return os.environ["CDPR"]
    built = [ROOT / "target" / profile / "cdpr" for profile in ("release", "debug")]
    built = [path for path in built if path.exists()]
    assert built, "no program cdpr: run `cargo build -p cdpr`, or name it in the variable CDPR"
    return str(max(built, key=lambda path: path.stat().st_mtime))


def command(*arguments):
    return subprocess.run([program(), *map(str, arguments)], capture_output=True, text=True, check=False)


def answer(*arguments):
    """What a command answers as JSON, numbers to the last bit."""
    done = command(*arguments, "--format", "json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def refusal(*arguments):
    """What a command says as it fails, with the lines that are wrapped at 80 columns joined."""
    done = command(*arguments)
    assert done.returncode == 1, (done.returncode, done.stdout)
    return re.sub(r"\n {2}(?! )", " ", done.stderr.strip()).removeprefix("error: ")
