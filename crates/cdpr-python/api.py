"""Writes the reference of the package as pages of Markdown, one for each module, from its documentation.

Run it with the package installed after a change of a documentation comment: python crates/cdpr-python/api.py docs/api
"""

import inspect
import sys
from pathlib import Path

import cdpr

MODULES = [cdpr, cdpr.analysis, cdpr.assess, cdpr.calibration, cdpr.designs, cdpr.exchange, cdpr.sensitivity, cdpr.study]


def signature(name, of):
    """The call as it is typed, without types."""
    try:
        given = inspect.signature(of)
    except (TypeError, ValueError):
        return name
    parameters = [
        parameter.replace(annotation=inspect.Parameter.empty)
        for parameter in given.parameters.values()
        if parameter.name != "self"
    ]
    return name + str(given.replace(parameters=parameters, return_annotation=inspect.Signature.empty))


def text(of):
    """The documentation; the sections of numpydoc become bold lines, and examples code."""
    lines = inspect.cleandoc(of.__doc__ or "").splitlines()
    out, in_code = [], False
    for k, line in enumerate(lines):
        ruled = k + 1 < len(lines) and set(lines[k + 1]) == {"-"}
        if set(line) == {"-"}:
            continue
        starts = line.startswith(">>>")
        if starts and not in_code:
            out.append("```python")
        elif in_code and not line:
            out.append("```")
        in_code = (in_code or starts) and bool(line)
        if in_code:
            out.append(line)
        elif ruled:
            out.append(f"**{line}**")
        elif line.startswith("    "):
            out.append(f"  {line.strip()}")
        elif " : " in line or (k and set(lines[k - 1]) == {"-"}):
            out += ["", f"- `{line}`", ""]
        else:
            out.append(line)
    return "\n".join([*out, "```"] if in_code else out)


def members(of):
    """Public fields and methods of a class, by name."""
    for name in dir(of):
        value = inspect.getattr_static(of, name, None)
        is_inherited = hasattr(tuple, name) or hasattr(Exception, name)
        if not name.startswith("_") and value.__doc__ and not is_inherited and name not in getattr(of, "_fields", ()):
            yield name, getattr(of, name), value


def entry(name, of):
    """A class with its members, or a function."""
    parts = [f"## `{signature(name, of)}`", text(of)]
    if inspect.isclass(of):
        fields = []
        for key, value, static in members(of):
            if inspect.isfunction(static) or type(static).__name__ in ("method_descriptor", "staticmethod"):
                parts += [f"### `{name}.{signature(key, value)}`", text(value)]
            else:
                fields.append(f"| `{key}` | {' '.join((static.__doc__ or '').split()).replace('|', chr(92) + '|')} |")
        if fields:
            parts[2:2] = ["\n".join(["| field | what it is |", "|---|---|", *fields])]
    return "\n\n".join(parts)


def page(module):
    """The page of a module."""
    names = [name for name in module.__all__ if not name.startswith("_") and callable(getattr(module, name))]
    entries = [entry(name, getattr(module, name)) for name in sorted(names) if name != "Law"]
    return "\n\n".join([f"# `{module.__name__}`", text(module), *entries]) + "\n"


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for one in MODULES:
        (folder / f"{one.__name__}.md").write_text(page(one), encoding="utf-8")
