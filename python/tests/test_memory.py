"""Arrays live as long as they are used, nothing is kept, want of memory is said."""

from __future__ import annotations

import gc
import subprocess
import sys
import threading
import tracemalloc
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import lacuna

Samples = tuple[np.ndarray, np.ndarray]
pytestmark = pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")


# Arrays in use.


def test_arrays_are_let_go(samples: Samples) -> None:
    t, x = samples
    owned = x.copy()
    before = sys.getrefcount(owned)
    records = lacuna.Records(owned, t)
    for _ in range(20):
        lacuna.check(records)
    del records
    gc.collect()
    assert sys.getrefcount(owned) == before
    lent = lacuna.Records(x.copy(), t)  # the array itself is gone
    gc.collect()
    assert lacuna.check(lent).to_json() == lacuna.check(x, t).to_json()


def test_an_array_may_go_or_change_during_a_call(samples: Samples) -> None:
    mine = np.tile(samples[1], (12, 1))
    alone = lacuna.identify(mine, 0.05, preset="robust", degree=2).to_json()
    begun = threading.Event()
    found: list[str] = []

    def call(array: np.ndarray) -> None:
        def tell(activity: str, fraction: float) -> None:
            begun.set()

        found.append(
            lacuna.identify(array, 0.05, preset="robust", degree=2, progress=tell).to_json()
        )

    worker = threading.Thread(target=call, args=(mine,))
    worker.start()
    assert begun.wait(60)
    mine[:] = np.nan
    del mine
    gc.collect()
    worker.join()
    assert found == [alone]


def test_arrays_outlive_what_they_are_of() -> None:
    def churn() -> None:
        gc.collect()
        for _ in range(50):
            np.full((500, 3), np.nan)

    def first_curve() -> Any:
        model = lacuna.Model.from_text("dx/dt = v\ndv/dt = -4*x - 0.2*v")
        run = lacuna.simulate(model, [1, 0], np.arange(0, 20, 0.05))
        return lacuna.sync(model, run.x, run.t, states=["x", "v"]).figures()

    run = lacuna.simulate("lorenz", [1, 1, 20], np.arange(0, 5, 0.01))
    x, t, copies = run.x, run.t, (run.x.copy(), run.t.copy())
    del run
    churn()
    np.testing.assert_array_equal(x, copies[0])
    np.testing.assert_array_equal(t, copies[1])
    with pytest.raises(ValueError, match="read-only"):
        x[0, 0] = 1.0
    figure = next(one for one in first_curve().values() if one["kind"] == "lines")
    curve = figure["series"][0]["y"]
    expected = curve.copy()
    del figure
    churn()
    np.testing.assert_array_equal(curve, expected)


# Want of memory.

POOR = """
import resource, sys, lacuna, numpy as np
x = np.zeros((2_000_000, 3))
t = np.arange(400) * 0.05
small = np.cos(t)
model = lacuna.Model.load("lorenz")
def used():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[5]) * resource.getpagesize()
limit = used() + (30 << 20)
resource.setrlimit(resource.RLIMIT_DATA, (limit, resource.RLIM_INFINITY))
try:
    CALL
except MemoryError:
    print("no memory")
resource.setrlimit(resource.RLIMIT_DATA, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
print(len(lacuna.check(small, t).records))
"""


@pytest.mark.unsanitized
@pytest.mark.parametrize(
    "call",
    [
        "lacuna.check(x, 0.1)",
        "lacuna.identify(x, 0.1, threads=1)",
        "lacuna.simulate('lorenz', [1, 1, 20], t_end=1e5, dt=1e-2)",
        "model(0.0, x)",
        "model.jacobian(0.0, x)",
        "lacuna.Records(x, 0.1)",
    ],
)
def test_want_of_memory_is_a_memory_error(call: str) -> None:
    """And the interpreter goes on."""
    done = subprocess.run(
        [sys.executable, "-c", POOR.replace("CALL", call)],
        capture_output=True, text=True, timeout=120,
    )  # fmt: skip
    assert (done.returncode, done.stdout) == (0, "no memory\n1\n"), done.stderr


# Nothing is kept.


def every_kind_of_call(samples: Samples) -> Callable[[int], None]:
    t, x = (part[:60] for part in samples)
    model = lacuna.Model.load("lorenz")
    identity = lacuna.Basis(lambda states, inputs: [*states])
    solver = lacuna.Regressor(lambda theta, y: np.linalg.lstsq(theta, y, rcond=None)[0])
    pipeline = lacuna.Pipeline(preset="sindy", basis=identity, regressor=solver)

    def calls(count: int) -> None:
        for number in range(count):
            lacuna.check(lacuna.Records(x, t)).to_json()
            model(0.0, [1.0, 2.0, 3.0])
            model.jacobian(0.0, [1.0, 2.0, 3.0])
            lacuna.Stlsq(threshold=0.2)
            lacuna.Model.from_text("dx/dt = -2*x")
            lacuna.simulate(model, [1, 1, 20], [0.0, 0.1]).x
            with pytest.raises(lacuna.DataError):
                lacuna.check(np.full((9, 1), np.inf), 0.1)
            if number % 20 == 0:
                lacuna.identify(x, t, pipeline=pipeline, threads=1).summary()

    return calls


def resident() -> int:
    """Pages."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1])


@pytest.mark.unsanitized
def test_nothing_is_kept_over_a_thousand_calls(samples: Samples) -> None:
    """Neither objects of Python, nor memory of its allocator, nor that of the process."""
    calls = every_kind_of_call(samples)
    calls(200)
    gc.collect()
    tracemalloc.start()
    calls(20)
    gc.collect()
    objects, memory = len(gc.get_objects()), tracemalloc.get_traced_memory()[0]
    calls(100)
    gc.collect()
    assert len(gc.get_objects()) - objects < 20
    assert tracemalloc.get_traced_memory()[0] - memory < 20_000
    tracemalloc.stop()
    pages = resident()
    calls(1000)
    assert resident() - pages < 200  # 0.8 MB


def test_the_extension_leaves_nothing_behind() -> None:
    """It says itself what has not been deleted by the end of the interpreter."""
    script = """
import lacuna, numpy as np
t = np.arange(400) * 0.05
x = np.column_stack([np.cos(t), -np.sin(t)])
basis = lacuna.Basis(lambda states, inputs: [*states])
found = lacuna.identify(x, t, pipeline=lacuna.Pipeline(preset="sindy", basis=basis))
found.report(), found.figures(), found.model(0.0, x)
lacuna.simulate(found.model, [1, 0], t).x
"""
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", script], capture_output=True, text=True, timeout=60
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
