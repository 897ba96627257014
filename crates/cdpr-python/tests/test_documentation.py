"""The documentation of everything public, in the form of numpydoc, and its examples."""

import dataclasses
import doctest
import inspect
import re
import subprocess
import sys
from pathlib import Path

import numpy
import pytest

import cdpr

MODULES = [cdpr, cdpr.analysis, cdpr.assess, cdpr.calibration, cdpr.designs, cdpr.exchange, cdpr.sensitivity, cdpr.study]

#: Types of methods of native classes.
NATIVE = ("method_descriptor", "builtin_function_or_method")
SECTIONS = ["Attributes", "Parameters", "Returns", "Raises", "Examples"]


def public():
    """Everything public by its name: classes and functions of the modules, and their methods."""
    found = {}
    for module in MODULES:
        for name in module.__all__:
            of = getattr(module, name)
            if name.startswith("_") or inspect.ismodule(of) or not callable(of) or name == "Law":
                continue
            found[f"{module.__name__}.{name}"] = of
            if inspect.isclass(of):
                methods = {key: getattr(of, key) for key in dir(of) if not key.startswith("_")}
                found.update(
                    (f"{module.__name__}.{name}.{key}", value)
                    for key, value in methods.items()
                    if (inspect.isfunction(value) or type(value).__name__ in NATIVE) and not hasattr(tuple, key) and not issubclass(of, Exception)
                )
    return found


PUBLIC = public()


def sections(doc):
    """The text of each section by its title."""
    parts = re.split(r"(?m)^(\w+)\n-+\n", inspect.cleandoc(doc))
    assert all(title in SECTIONS for title in parts[1::2]), parts[1::2]
    assert parts[1::2] == [title for title in SECTIONS if title in parts[1::2]], "in another order"
    return {"": parts[0], **dict(zip(parts[1::2], parts[2::2]))}


def parameters(of):
    """The names of the parameters of a function, or of those that make an object of a class."""
    return [
        name
        for name, parameter in inspect.signature(of).parameters.items()
        if name not in ("self", "cls") and parameter.kind not in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD)
    ]


def described(section):
    """The names that a section describes, in their order; each has a text below it."""
    lines = section.splitlines()
    names = []
    for k, line in enumerate(lines):
        if line and not line.startswith(" "):
            assert k + 1 < len(lines) and lines[k + 1].startswith("    "), line
            names += line.split(" : ")[0].split(", ")
    return names


def is_made_by_users(name, of):
    """Whether a class has arguments that its documentation explains: those of answers are made by calls."""
    return name == "cdpr.Robot" or name.endswith("Design")


@pytest.mark.parametrize("name", PUBLIC)
def test_a_public_name_has_the_sections_of_numpydoc(name):
    of = PUBLIC[name]
    assert of.__doc__, "no documentation"
    found = sections(of.__doc__)
    assert "TODO" not in of.__doc__
    first = found[""].splitlines()[0]
    assert first and len(first) <= 110
    if dataclasses.is_dataclass(of) or hasattr(of, "_fields"):
        fields = [field.name for field in dataclasses.fields(of)] if dataclasses.is_dataclass(of) else of._fields
        assert described(found["Attributes"]) == list(fields)
    if inspect.isclass(of) and not is_made_by_users(name, of):
        return
    expected = parameters(of)
    assert described(found.get("Parameters", "")) == expected
    if inspect.isclass(of):
        return
    annotation = getattr(of, "__annotations__", {}).get("return", "something")
    assert ("Returns" in found) == (annotation != "None" and not name.endswith("write_explorer"))
    for error in described(found.get("Raises", "")):
        assert issubclass(getattr(cdpr, error), cdpr.CdprError)


@pytest.mark.parametrize("name", PUBLIC)
def test_the_examples_of_a_public_name_print_what_they_say(name):
    of = PUBLIC[name]
    owner = name.rsplit(".", 1)[0]
    is_call = not inspect.isclass(of) and (owner == "cdpr.Robot" or owner in {module.__name__ for module in MODULES})
    if is_call or (inspect.isclass(of) and is_made_by_users(name, of)):
        assert ">>> " in of.__doc__, "no example"
    names = {"cdpr": cdpr, "numpy": numpy}
    for module in MODULES[1:]:
        if name.startswith(module.__name__):
            names.update((key, getattr(module, key)) for key in module.__all__)
    test = doctest.DocTestParser().get_doctest(of.__doc__, names, name, None, 0)
    said = []
    doctest.DocTestRunner(verbose=False).run(test, out=said.append)
    assert not said, "".join(said)


def test_the_reference_has_a_page_for_each_module(tmp_path):
    script = str(Path(__file__).parents[1] / "api.py")
    subprocess.run([sys.executable, script, str(tmp_path)], check=True)
    assert {page.name for page in tmp_path.iterdir()} == {f"{module.__name__}.md" for module in MODULES}
    pages = {module: (tmp_path / f"{module.__name__}.md").read_text() for module in MODULES}
    for module, page in pages.items():
        for name in module.__all__:
            if f"{module.__name__}.{name}" in PUBLIC:
                assert f"\n## `{name}" in page, name
        assert page.count("```") % 2 == 0
    assert "\n### `Robot.inverse(pose, *, force=None" in pages[cdpr]
    assert "| `displacement` | Displacement dp of P," in pages[cdpr]
    book = Path(__file__).parents[3] / "docs" / "api"
    for page in tmp_path.iterdir():
        kept = (book / page.name).read_text(encoding="utf-8")
        assert kept == page.read_text(encoding="utf-8"), f"docs/api/{page.name}: run: python crates/cdpr-python/api.py docs/api"
