"""Functions of Python that calls run: their errors come out, an interrupt ends them."""

from __future__ import annotations

import gc
import subprocess
import sys
import threading
import weakref
from typing import Any

import numpy as np
import pytest

import lacuna

Samples = tuple[np.ndarray, np.ndarray]
pytestmark = pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")


def identified(samples: Samples, solve: Any, **arguments: Any) -> lacuna.Identification:
    t, x = samples
    pipeline = lacuna.Pipeline(preset="sindy", regressor=lacuna.Regressor(solve))
    return lacuna.identify(x, t, degree=1, pipeline=pipeline, **arguments)


def least_squares(theta: np.ndarray, y: np.ndarray) -> np.ndarray:
    return np.asarray(np.linalg.lstsq(theta, y, rcond=None)[0])


def test_an_error_in_another_thread_comes_out_as_it_is(samples: Samples) -> None:
    raised = LookupError("mine")
    threads: list[int] = []

    def broken(theta: np.ndarray, y: np.ndarray) -> np.ndarray:
        threads.append(threading.get_ident())
        raise raised

    with pytest.raises(LookupError) as caught:
        identified(samples, broken, threads=2)
    assert caught.value is raised
    assert "broken" in [entry.name for entry in caught.traceback]
    assert threads and threading.get_ident() not in threads


@pytest.mark.parametrize("kind", [KeyboardInterrupt, SystemExit, MemoryError, lacuna.DataError])
def test_every_kind_of_error_comes_out(samples: Samples, kind: type[BaseException]) -> None:
    def broken(theta: np.ndarray, y: np.ndarray) -> np.ndarray:
        raise kind("here", "mine") if kind is lacuna.DataError else kind("mine")

    with pytest.raises(kind, match="mine" if kind is not SystemExit else None):
        identified(samples, broken)


def test_calls_in_threads_have_errors_of_their_own(samples: Samples) -> None:
    caught: dict[int, str] = {}

    def call(number: int) -> None:
        def broken(theta: np.ndarray, y: np.ndarray) -> np.ndarray:
            raise ValueError(f"error {number}")

        try:
            identified(samples, broken)
        except ValueError as error:
            caught[number] = str(error)

    workers = [threading.Thread(target=call, args=(number,)) for number in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert caught == {number: f"error {number}" for number in range(4)}


class OwnError(Exception):
    pass


def test_functions_and_their_errors_are_let_go(samples: Samples) -> None:
    raised: list[weakref.ref[OwnError]] = []

    def broken(theta: np.ndarray, y: np.ndarray) -> np.ndarray:
        error = OwnError()
        raised.append(weakref.ref(error))
        raise error

    function = weakref.ref(broken)
    with pytest.raises(OwnError):
        identified(samples, broken)
    del broken
    gc.collect()
    assert function() is None
    assert raised[0]() is None


def test_arrays_that_a_function_keeps_stay(samples: Samples) -> None:
    kept: list[np.ndarray] = []
    copies: list[np.ndarray] = []

    def solve(theta: np.ndarray, y: np.ndarray) -> np.ndarray:
        kept.append(theta)
        copies.append(theta.copy())
        return least_squares(theta, y)

    identified(samples, solve)
    gc.collect()
    identified(samples, least_squares)  # what was freed would be used again
    assert kept
    for theta, copy in zip(kept, copies, strict=False):
        np.testing.assert_array_equal(theta, copy)


# What an interrupt does to a function that does not end by itself; `{}` is what it does.
ENDLESS = """
import os, signal, threading, time, lacuna, numpy as np
signal.signal(signal.SIGINT, signal.default_int_handler)
t = np.linspace(0, 20, 400)
x = np.column_stack([np.cos(2 * t), -2 * np.sin(2 * t)])
begun = threading.Event()
def endless(theta, y):
    begun.set()
    while True:
        {}
def interrupt():
    begun.wait()
    os.kill(os.getpid(), signal.SIGINT)
threading.Thread(target=interrupt).start()
pipeline = lacuna.Pipeline(preset="sindy", regressor=lacuna.Regressor(endless))
try:
    lacuna.identify(x, t, pipeline=pipeline)
except KeyboardInterrupt:
    print("interrupted")
print(len(lacuna.check(x, t).records), threading.active_count())
"""


@pytest.mark.parametrize("what", ["pass", "time.sleep(0.01)"])
def test_an_interrupt_ends_an_endless_function(what: str) -> None:
    """The function too: the interpreter ends without a thread of it."""
    done = subprocess.run(
        [sys.executable, "-c", ENDLESS.replace("{}", what)],
        capture_output=True, text=True, timeout=60,
    )  # fmt: skip
    assert (done.returncode, done.stdout) == (0, "interrupted\n1 1\n"), done.stderr
