# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Nothing in the package can run what it reads: no eval, no pickle, no shell."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[2] / "hoe_addon"
FILES = sorted(PACKAGE.rglob("*.py"))
CALLS = {
    *("eval", "exec", "compile", "__import__", "execfile", "input", "breakpoint"),
    *("os.system", "os.popen", "os.startfile", "os.fork", "pty.spawn", "builtins.eval"),
    *("builtins.exec", "code.interact", "runpy.run_path", "runpy.run_module", "tempfile.mktemp"),
    *("np.fromregex", "np.lib.format.open_memmap", "np.lib.format.read_array"),
    *("ast.literal_eval", "typing.get_type_hints", "bpy.utils.execfile", "types.FunctionType"),
    *("ctypes.CDLL", "cffi.FFI", "yaml.load", "np.fromstring", "np.memmap"),
}
MODULES = {
    *("pickle", "_pickle", "cPickle", "marshal", "shelve", "dill", "joblib", "yaml", "code"),
    *("codeop", "runpy", "imp", "ctypes", "cffi", "socket", "http", "urllib", "ftplib", "smtplib"),
    *("xmlrpc", "telnetlib", "webbrowser", "requests", "pty", "xml", "plistlib", "tarfile"),
}
ALLOWED = {
    ("cli/__init__.py", "import_module"): "names of the commands, from a list in the file",
    ("blender/__init__.py", "import_module"): "names of the package's own modules",
    ("cli/worker/__init__.py", "import_module"): "modules of a list in the file",
}
"""What is there for a reason, by file and name."""

STARTS_PROCESSES = {
    "ui/jobs/": "renders in a Blender of its own; arguments are a list, and no shell",
}


def name_of(node: ast.expr) -> str:
    """A dotted name such as ``os.system``, or nothing."""
    if isinstance(node, ast.Attribute):
        owner = name_of(node.value)
        return f"{owner}.{node.attr}" if owner else node.attr
    return node.id if isinstance(node, ast.Name) else ""


def imports(tree: ast.AST) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module


def faults(tree: ast.AST, where: str) -> Iterator[str]:
    """List what must not stand in a file."""
    for module in imports(tree):
        first = module.partition(".")[0]
        if first in MODULES:
            yield f"imports {module}"
        if first == "subprocess" and not where.startswith(tuple(STARTS_PROCESSES)):
            yield "imports subprocess"
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call):
            continue
        name = name_of(node.func)
        short = name.rpartition(".")[2]
        if name in CALLS:
            yield f"line {node.lineno}: calls {name}"
        elif short in ("import_module", "__import__") and (where, short) not in ALLOWED:
            yield f"line {node.lineno}: imports by name"
        elif name in ("np.load", "numpy.load"):
            yield f"line {node.lineno}: np.load reads a header by evaluating it"
        for keyword in node.keywords:
            value = keyword.value
            off = isinstance(value, ast.Constant) and value.value is False
            if keyword.arg in ("shell", "allow_pickle") and not off:
                yield f"line {node.lineno}: {keyword.arg}"


def test_no_file_runs_what_it_reads() -> None:
    found: dict[str, list[str]] = {}
    for path in FILES:
        where = path.relative_to(PACKAGE).as_posix()
        found[where] = list(faults(ast.parse(path.read_text(encoding="utf-8")), where))
    assert {where: each for where, each in found.items() if each} == {}
    assert "model/reading.py" in found


def test_what_is_allowed_is_there() -> None:
    for where, name in ALLOWED:
        assert name in (PACKAGE / where).read_text(encoding="utf-8")


@pytest.mark.parametrize(
    "text",
    [
        "eval(text)",
        "import pickle",
        "from yaml import load",
        "import os\nos.system(text)",
        "subprocess.run(text, shell=True)",
        "import subprocess",
        "np.load(file, allow_pickle=True)",
        "np.load(file)",
        "importlib.import_module(name)",
        "import urllib.request",
    ],
)
def test_what_must_not_stand_there_is_found(text: str) -> None:
    assert list(faults(ast.parse(text), "model/x.py"))
