"""Exported FMUs, checked and run by FMPy (`pip install fmpy`)."""

from __future__ import annotations

from pathlib import Path

import fmpy
import numpy as np
import pytest
from conftest import Command
from fmpy.validation import validate_fmu

# Text of a model, its start, the value of its input.
MODELS: dict[str, tuple[str, str, float | None]] = {
    "lorenz": (
        "dx/dt = 10*(y-x)\ndy/dt = x*(28-z) - y\ndz/dt = x*y - 8/3*z\n"
        "initial x = 1\ninitial y = 1\ninitial z = 20\n",
        "1,1,20",
        None,
    ),
    "tanks": (
        "input u [V] hold zero\nparam k1 = 0.5 [1/s] in 0..1\nparam k4 = 0.25 fixed\n"
        "dx1/dt = -k1*sqrt(x1) + k4*u\ndx2/dt = k1*sqrt(x1) - 0.3*sqrt(x2)\n"
        "y = 3*x2 + x1^2 [V]\ninitial x1 = 1\ninitial x2 = 0.5 fixed\n",
        "1,0.5",
        2.0,
    ),
    "pendulum": (
        "input u hold zero\ndth/dt = w\ndw/dt = -19.62*sin(th) - 0.15*w + u\n"
        "initial th = 2\ninitial w = 0\n",
        "2,0",
        0.7,
    ),
    "stiff": (
        "param m = 30\nda/dt = b\ndb/dt = m*(1-a^2)*b - a\nsum = a + b\n"
        "initial a = 2\ninitial b = 0\n",
        "2,0",
        None,
    ),
}


@pytest.mark.parametrize("name", MODELS)
def test_a_run_of_the_fmu_is_that_of_the_command(
    name: str, tmp_path: Path, command: Command
) -> None:
    text, start, value = MODELS[name]
    (tmp_path / "m.ode").write_text(text)
    fmu = tmp_path / "m.fmu"
    command("export", "m.ode", "--format", "fmu", "-o", "m.fmu", folder=tmp_path)
    assert validate_fmu(str(fmu)) == []
    inputs: list[str] = []
    if value is not None:
        (tmp_path / "u.csv").write_text(f"t,u\n0,{value}\n9,{value}\n")
        inputs = ["--input-data", "u.csv"]
    command(
        "simulate", "m.ode", "--x0", start, "--t-end", "2", "--dt", "0.1", *inputs,
        "--integrator", "dopri87", "-o", "run.csv", folder=tmp_path,
    )  # fmt: skip
    expected = np.genfromtxt(tmp_path / "run.csv", delimiter=",", skip_header=1)
    run = fmpy.simulate_fmu(
        str(fmu),
        stop_time=2.0,
        output_interval=0.1,
        start_values={} if value is None else {"u": value},
    )
    assert len(run) == len(expected) == 21
    for column, channel in enumerate(run.dtype.names):
        np.testing.assert_allclose(run[channel], expected[:, column], rtol=1e-8, atol=1e-8)
