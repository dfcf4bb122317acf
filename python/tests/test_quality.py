"""Types, style and stubs; the memory of a call. Times: benchmarks/studies/python/calls.py."""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import PROGRAM, ROOT

import lacuna
from lacuna import _lacuna

SAMPLES = 10_000


def run(*arguments: str, folder: Path = ROOT) -> str:
    done = subprocess.run(
        [sys.executable, "-m", *arguments], capture_output=True, text=True, cwd=folder, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.unsanitized
@pytest.mark.skipif(sys.version_info < (3, 11), reason="NumPy for 3.10 has no default types")
def test_types_are_strict() -> None:
    settings = ["mypy", "--config-file", str(ROOT / "pyproject.toml")]
    run(*settings, "-p", "lacuna", folder=ROOT / "build")
    run(*settings, ".", folder=ROOT / "python/tests")


@pytest.mark.unsanitized
def test_style_is_kept() -> None:
    run("ruff", "check", "python", "examples/notebooks")
    run("ruff", "format", "--check", "python")


def names_in(body: list[ast.stmt]) -> set[str]:
    """What a stub names, without what Python itself calls."""
    functions = {node.name for node in body if isinstance(node, ast.FunctionDef | ast.ClassDef)}
    values = {
        node.target.id
        for node in body
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name)
    }
    return {name for name in functions | values if not name.startswith("__")}


# What stubtest says of types that are as they have to be.
EXPECTED = [
    # Functions and classes of nanobind are of types of their own.
    r"lacuna\._lacuna\.\S+ is not a function",
    r"lacuna\._lacuna\.\S+ is inconsistent, (metaclass differs|stub is a staticmethod .*)",
    r"lacuna\._lacuna\.\S+ is a disjoint base .*",
    r"lacuna\._lacuna\.\S+ is inconsistent, stub does not have \*+\w+ parameter .*",
    # What it gives depends on its first argument; options of both are the same.
    r"lacuna\.finding\.fit is inconsistent, stub does not have parameter .*",
    # Only for types.
    r"lacuna\.\w+\.(Array|Column|Printer@\d+) is not present at runtime",
    # Made by scikit-learn.
    r"lacuna\.sklearn\.ODERegressor\.set_\w+_request is not present in stub",
]


@pytest.mark.unsanitized
def test_stubs_agree_with_the_modules() -> None:
    settings = ["--mypy-config-file", str(ROOT / "pyproject.toml"), "--concise"]
    done = subprocess.run(
        [sys.executable, "-m", "mypy.stubtest", "lacuna", *settings],
        capture_output=True, text=True, cwd=ROOT / "build", check=False,
    )  # fmt: skip
    said = done.stdout.splitlines()
    assert said, done.stderr
    others = [one for one in said if not any(re.fullmatch(known, one) for known in EXPECTED)]
    assert others == []


@pytest.mark.unsanitized
def test_stubs_name_what_the_extension_has() -> None:
    stub = ast.parse(Path(_lacuna.__file__).with_name("_lacuna.pyi").read_text())
    assert names_in(stub.body) == {name for name in dir(_lacuna) if not name.startswith("__")}
    for node in stub.body:
        if isinstance(node, ast.ClassDef):
            kind = getattr(_lacuna, node.name)
            assert names_in(node.body) == {name for name in vars(kind) if not name.startswith("__")}


def test_files_are_small() -> None:
    sources = sorted((ROOT / "python").rglob("*.py"))
    assert len(sources) > 20
    for path in sources:
        assert len(path.read_text().splitlines()) <= 450, path


def test_every_public_name_has_a_docstring() -> None:
    for name in lacuna.__all__:
        assert (getattr(lacuna, name).__doc__ or "").strip(), name
    for name in ("identify", "diagnose", "fit", "sync", "simulate", "compare", "check"):
        text = str(getattr(lacuna, name).__doc__)
        for heading in ("Parameters", "Returns", "Raises"):
            assert heading in text, (name, heading)


def peak(*arguments: str) -> float:
    """Largest memory of a process that does this, in MB."""
    process = subprocess.Popen(arguments, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = status
    assert status == 0
    return usage.ru_maxrss / 1024


@pytest.mark.unsanitized
def test_an_array_takes_little_memory_beside_the_call(tmp_path: Path) -> None:
    """Beyond what each program takes by itself, at most 10 MB more than the command takes."""
    t = np.arange(SAMPLES) * 0.01
    file = tmp_path / "record.npy"
    np.save(file, np.column_stack([t, lacuna.simulate("lorenz", [1, 1, 20], t).x]))
    script = f"import lacuna, numpy as np; a = np.load({str(file)!r}); t, x = a[:, 0], a[:, 1:]"
    call = "; lacuna.identify(x, t, preset='sindy', threads=1)"
    added = peak(sys.executable, "-W", "ignore", "-c", script + call) - peak(
        sys.executable, "-c", script
    )
    command = [PROGRAM, "identify", str(file), "--preset", "sindy", "--threads", "1"]
    assert added < peak(*command) - peak(PROGRAM, "--version") + 10
