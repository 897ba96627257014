"""Writes the documentation of the native half into its stubs, where editors look for it.

Run it after a change of a documentation comment, with the package installed: python crates/cdpr-python/stubs.py
"""

import ast
import inspect
from pathlib import Path

STUBS = Path(__file__).parent / "python" / "cdpr" / "_core.pyi"


def documentation(module, node, owner=None):
    """The documentation of a class, function or method of the stubs; None without one."""
    of = getattr(module if owner is None else owner, node.name, None)
    if owner is not None and node.name.startswith("__"):
        return None
    return None if of is None or not of.__doc__ else inspect.cleandoc(of.__doc__)


def first_of_each(nodes):
    """The functions among these, of several overloads the first."""
    functions = {}
    for node in nodes:
        if isinstance(node, ast.FunctionDef):
            functions.setdefault(node.name, node)
    return list(functions.values())


def documented(module, text):
    """The stubs with the documentation of the module."""
    lines = text.splitlines()
    body = ast.parse(text).body
    edits = [(node, documentation(module, node)) for node in first_of_each(body)]
    for node in body:
        if isinstance(node, ast.ClassDef):
            owner = getattr(module, node.name)
            edits.append((node, documentation(module, node)))
            edits += [(of, documentation(module, of, owner)) for of in first_of_each(node.body)]
    for node, doc in sorted(edits, key=lambda edit: -edit[0].lineno):
        first = node.body[0]
        old = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant) and first.value.value is not ...
        start, indent = first.lineno - 1, " " * (node.col_offset + 4)
        if old:
            del lines[start : first.end_lineno]
        if doc is None:
            continue
        quoted = f'"""{doc}"""' if "\n" not in doc else f'"""{doc}\n"""'
        block = [(indent + line).rstrip() for line in quoted.splitlines()]
        if isinstance(node, ast.FunctionDef) and not old:
            head = lines[start]
            assert head.endswith(": ..."), head
            lines[start] = head.removesuffix(" ...")
            lines[start + 1 : start + 1] = block
        else:
            lines[start:start] = [*block, ""] if isinstance(node, ast.ClassDef) and not old else block
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    from cdpr import _core

    STUBS.write_text(documented(_core, STUBS.read_text()))
