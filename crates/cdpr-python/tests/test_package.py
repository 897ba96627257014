"""The package itself: documentation, examples, import, threads."""

import doctest
import importlib
import os
import re
import runpy
import shutil
import signal
import subprocess
import sys
import threading
import time
from importlib.metadata import files, metadata
from pathlib import Path

import pytest
from conftest import ROOT, command

import cdpr

HERE = Path(__file__).resolve().parents[1]


def python(code, folder=ROOT):
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, capture_output=True, text=True, cwd=folder, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_example_of_the_readme_prints_what_the_paper_robot_does():
    code = re.search(r"```python\n(.*?)```", (HERE / "README.md").read_text(), re.DOTALL).group(1)
    assert len([line for line in code.splitlines() if line]) <= 10
    assert python(code).startswith("1.3312 mm under 50 kg\n")


def test_the_python_code_of_the_first_page_runs(tmp_path):
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)
    assert blocks
    (tmp_path / "data").symlink_to(ROOT / "data")
    assert "1.3312 mm under 50 kg" in python("\n".join(blocks), tmp_path)


def test_the_code_of_the_book_runs(tmp_path):
    text = (ROOT / "docs" / "python.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert len(blocks) >= 3
    (tmp_path / "data").symlink_to(ROOT / "data")
    python("\n".join(blocks), tmp_path)


def test_the_book_says_what_every_command_of_the_program_is_called_in_python():
    text = (ROOT / "docs" / "python.md").read_text()
    table = re.search(r"## What the program does\n(.*?)\n## ", text, re.DOTALL).group(1)
    left = "".join(row.split(" | ")[0] for row in table.splitlines() if row.startswith("| `"))
    groups = command("--help").stdout.split("Options:")[0]
    names = set(re.findall(r"^  (?!Example)([a-z]+(?: [a-z]+)?)  ", groups, re.MULTILINE))
    assert len(names) > 30
    assert not [name for name in names if not re.search(rf"`{name}[` ]", left)]
    for name in re.findall(r"`(cdpr\.[a-z_.]+)", table):
        of = cdpr
        for part in name.split(".")[1:]:
            of = getattr(of, part)


def test_the_stubs_have_the_documentation_of_what_they_describe():
    stubs = runpy.run_path(str(HERE / "stubs.py"))
    text = stubs["STUBS"].read_text()
    assert text == stubs["documented"](cdpr._core, text)
    for method in ("direct", "certify", "path"):
        assert getattr(cdpr.Robot, method).__doc__.splitlines()[0] in text


def test_the_code_of_the_tutorial_prints_what_the_page_shows(tmp_path):
    page = ROOT / "docs" / "tutorials" / "tolerances"
    blocks = re.findall(r"```python\n(.*?)```\n\n```text\n(.*?)```", page.with_suffix(".md").read_text(), re.DOTALL)
    assert len(blocks) >= 4
    shutil.copy(page / "study.json", tmp_path)
    printed = python("".join(f"{code}print('--')\n" for code, _ in blocks), tmp_path)
    assert printed == "".join(f"{shown}--\n" for _, shown in blocks)


def test_the_code_of_the_guides_runs(tmp_path):
    pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    for page in sorted((ROOT / "docs" / "how-to").glob("*.md")):
        python("".join(re.findall(r"```python\n(.*?)```", page.read_text(), re.DOTALL)), tmp_path)


@pytest.mark.parametrize("name", ["cables", "deflection_map"])
def test_an_example_draws_a_figure(name, tmp_path, monkeypatch, caroca_file):
    matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    matplotlib.use("svg")
    figure = tmp_path / "figure.svg"
    arguments = [name, caroca_file, str(figure)] if name == "deflection_map" else [name, str(figure)]
    monkeypatch.setattr(sys, "argv", arguments)
    runpy.run_path(str(HERE / "examples" / f"{name}.py"), run_name="__main__")
    assert figure.stat().st_size > 5_000


def test_fields_of_answers_have_their_unit_and_shape():
    assert "[m], (3,)" in cdpr.DirectSolution.position.__doc__
    for name in dir(cdpr.Robot):
        if not name.startswith("_"):
            assert getattr(cdpr.Robot, name).__doc__, name


@pytest.mark.parametrize("names", [["examples", "tests/typed.py"], ["--package", "cdpr"]])
def test_a_type_checker_finds_nothing_wrong(names):
    pytest.importorskip("mypy", reason="mypy is not installed")
    settings = ["--strict", "--config-file", "pyproject.toml", "--cache-dir", os.devnull]
    # The package that these tests import, also where it is not installed.
    folder = str(Path(cdpr.__file__).parents[1])
    paths = {} if "site-packages" in folder else {"MYPYPATH": folder}
    done = subprocess.run(
        [sys.executable, "-m", "mypy", *settings, *names],
        capture_output=True, text=True, cwd=HERE, env={**os.environ, **paths}, check=False,
    )
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize("name", ["analysis", "assess", "calibration", "designs", "exchange", "sensitivity", "sensitivity.inputs", "study"])
def test_the_examples_of_a_module_print_what_they_say(name):
    module = importlib.import_module(f"cdpr.{name}")
    found = doctest.testmod(module)
    assert found.attempted > 0 and found.failed == 0


def test_the_wheel_says_what_an_index_asks_for():
    about = metadata("cdpr")
    assert about["Version"] == cdpr.__version__ and about["License-Expression"] == "MIT OR Apache-2.0"
    assert about["Requires-Python"] == ">=3.10" and about["Description-Content-Type"].startswith("text/markdown")
    assert (HERE / "README.md").read_text() in about.get_payload()
    assert "Typing :: Typed" in about.get_all("Classifier")
    names = {file.name for file in files("cdpr")}
    assert {"py.typed", "_core.pyi", "LICENSE-MIT", "LICENSE-APACHE"} <= names


def test_the_import_leaves_numpy_to_whoever_uses_it():
    loaded = "print('numpy' in sys.modules, 'pandas' in sys.modules)"
    assert python(f"import sys, cdpr; {loaded}") == "False False\n"


def test_numbers_do_not_depend_on_the_threads(caroca_file):
    code = f"""
import cdpr, numpy
robot = cdpr.Robot.from_file({caroca_file!r})
poses = numpy.random.default_rng(1).uniform(-0.5, 0.5, (500, 3)) + [0, 0, 1.75]
print(robot.deflection(poses, payload=50).magnitude.tobytes().hex())
"""
    one, many = (python(f"import os; os.environ['RAYON_NUM_THREADS'] = '{n}'\n{code}") for n in (1, 4))
    assert one == many


def test_a_forked_process_computes_after_its_parent_did(caroca):
    import multiprocessing

    caroca.inverse([[0, 0, 1.75]] * 10)
    with multiprocessing.get_context("fork").Pool(1) as pool:
        assert pool.apply_async(_least_tension, (caroca,)).get(timeout=60) > 0


def test_a_forked_process_estimates_after_its_parent_did():
    import multiprocessing

    expected = _indices(1)
    with multiprocessing.get_context("fork").Pool(1) as pool:
        assert pool.apply_async(_indices, (1,)).get(timeout=60) == expected


def _indices(seed):
    from cdpr.sensitivity import SaltelliDesign, SobolDesign, uniform

    laws = {"x": uniform(0, 1), "y": uniform(0, 2)}
    design = SaltelliDesign(laws, 256, seed=seed)
    sample = SobolDesign(laws, 256, seed=seed)
    outputs = sample.rows().sum(axis=1)
    return [
        *design.indices(design.rows().sum(axis=1)).first,
        *sample.effects(outputs).effect,
        *sample.expansion(outputs).first,
    ]


def test_ctrl_c_ends_a_workspace(caroca):
    # A shell's background process ignores it, and so do its children.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        caroca.workspace(plane=("z", 1.75), grid=(1000, 1000), payload=50)
    assert time.monotonic() - begun < 20


def _least_tension(robot):
    return robot.inverse([[0, 0, 1.75]] * 10).tensions.min()
