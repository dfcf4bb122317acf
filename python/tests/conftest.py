"""Records and models of the tests, and the command that answers are compared with."""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("LACUNA_COMMAND", str(ROOT / "build/quick/lacuna"))

OSCILLATOR = """
input u [N]
state x [m]
state v [m/s]
dx/dt = v
dv/dt = -4*x - 0.3*v + 1.5*u
"""
NOMINAL = """
input u [N]
state x [m]
state v [m/s]
dx/dt = v
dv/dt = -4*x + 1.5*u
"""
FREE = """
param k = 3 [1/s^2] in 0..20
param d = 0.1 [1/s] in 0..5
input u [N]
state x [m]
state v [m/s]
dx/dt = v
dv/dt = -k*x - d*v + 1.5*u
"""

Command = Callable[..., str]

# Where tests run in the background Ctrl-C is ignored, also by the processes that they start.
signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session")
def command() -> Command:
    """The command line of the same build: arguments in, standard output out."""

    # A sanitizer of the extension is none of the program, which limits its own memory.
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}

    def run(*arguments: str | Path, folder: Path | None = None) -> str:
        done = subprocess.run(
            [PROGRAM, *map(str, arguments)],
            capture_output=True, text=True, cwd=folder, check=False, env=environment,
        )  # fmt: skip
        assert done.returncode in (0, 1), done.stderr
        return done.stdout

    return run


def _input(t: np.ndarray) -> np.ndarray:
    return np.sin(0.7 * t) + 0.5 * np.sin(2.3 * t)


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory, command: Command) -> Path:
    """A folder with models and records that the command has made."""
    place = tmp_path_factory.mktemp("records")
    for name, text in (("true", OSCILLATOR), ("nominal", NOMINAL), ("free", FREE)):
        (place / f"{name}.ode").write_text(text)
    times = np.arange(0, 30, 0.05)
    rows = [f"{t!r},{u!r}" for t, u in zip(times.tolist(), _input(times).tolist(), strict=True)]
    (place / "input.csv").write_text("t [s],u [N]\n" + "\n".join(rows) + "\n")
    for name, start, seed in (("run", "1,0", "1"), ("other", "-0.5,1", "2")):
        text = command(
            "simulate", "true.ode", "--x0", start, "--t-end", "29.9", "--dt", "0.05",
            "--input-data", "input.csv", "--noise", "x=0.002,v=0.002", "--seed", seed,
            folder=place,
        )  # fmt: skip
        (place / f"{name}.csv").write_text(text)
    (place / "orbit.csv").write_text(
        command("simulate", "lorenz", "--x0", "1,1,20", "--t-end", "20", "--dt", "0.02")
    )
    (place / "map.ode").write_text("x[n+1] = 1 - 1.4*x^2 + y\ny[n+1] = 0.3*x\n")
    (place / "map.csv").write_text(
        command("simulate", place / "map.ode", "--x0", "0.1,0.1", "--t-end", "300")
    )
    return place


@pytest.fixture
def inside(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The same as working folder, so that names of files are the same everywhere."""
    monkeypatch.chdir(folder)
    return folder


@pytest.fixture(scope="session")
def samples() -> tuple[np.ndarray, np.ndarray]:
    """Times and states of a damped oscillation, float64, (400,) and (400, 2)."""
    t = np.linspace(0, 20, 400)
    x = np.exp(-0.1 * t) * np.cos(2 * t)
    v = np.exp(-0.1 * t) * (-0.1 * np.cos(2 * t) - 2 * np.sin(2 * t))
    return t, np.column_stack([x, v])
