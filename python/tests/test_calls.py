"""Calls let the interpreter go on, end by Ctrl-C, and leave it whole."""

from __future__ import annotations

import faulthandler
import os
import signal
import subprocess
import sys
import threading
import time
from typing import Any

import numpy as np
import pytest

import lacuna

pytestmark = pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")


@pytest.fixture(scope="module")
def long_record() -> lacuna.Records:
    """A record that identify works on for longer than a test waits."""
    t = np.arange(60_000) * 0.01
    run = lacuna.simulate("lorenz", [1, 1, 20], t)
    noisy = run.x + 0.05 * np.random.default_rng(1).normal(size=run.x.shape)
    return lacuna.Records(noisy, t, states=["x", "y", "z"])


def interrupt(call: Any, after: float) -> None:
    """Ctrl-C after some seconds of a call; one that goes on for a minute more ends the tests."""
    timer = threading.Timer(after, lambda: os.kill(os.getpid(), signal.SIGINT))
    faulthandler.dump_traceback_later(after + 60, exit=True)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        call()
    timer.join()
    faulthandler.cancel_dump_traceback_later()


@pytest.mark.parametrize("after", [0.05, 0.4])
def test_an_interrupt_ends_a_call(
    long_record: lacuna.Records, after: float, samples: tuple[np.ndarray, np.ndarray]
) -> None:
    interrupt(lambda: lacuna.identify(long_record, preset="robust"), after)
    t, x = samples
    assert lacuna.check(x, t).records[0].rows == 400  # what comes after works


def test_an_interrupt_ends_an_evaluation() -> None:
    model = lacuna.Model.load("lorenz")
    many = np.zeros((5_000_000, 3))

    def evaluate() -> None:
        while True:
            model(0.0, many)

    interrupt(evaluate, 0.2)


def test_other_threads_go_on_during_a_call(long_record: lacuna.Records) -> None:
    counted = [0]
    stop = threading.Event()

    def count() -> None:
        while not stop.is_set():
            counted[0] += 1
            time.sleep(0.001)

    other = threading.Thread(target=count)
    other.start()
    interrupt(lambda: lacuna.identify(long_record, preset="robust"), 0.5)
    stop.set()
    other.join()
    assert counted[0] > 50


def test_progress_is_told(samples: tuple[np.ndarray, np.ndarray]) -> None:
    told: list[tuple[str, float]] = []
    t, x = samples
    wide = lacuna.Records(np.tile(x, (60, 1)), np.arange(60 * len(t)) * 0.05)
    lacuna.identify(wide, preset="robust", progress=lambda what, share: told.append((what, share)))
    assert told
    assert all(0.0 <= share <= 1.0 for _, share in told)
    assert any(what for what, _ in told)
    lacuna.identify(x, t, preset="sindy", progress=True)


def test_an_error_of_the_progress_function_ends_the_call(long_record: lacuna.Records) -> None:
    def refuse(activity: str, fraction: float) -> None:
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        lacuna.identify(long_record, preset="robust", progress=refuse)


def test_threads_do_not_change_an_answer(samples: tuple[np.ndarray, np.ndarray]) -> None:
    t, x = samples
    answers = {lacuna.identify(x, t, degree=2, threads=n).to_json() for n in (1, 2, 5)}
    assert len(answers) == 1


def test_the_interpreter_ends_while_a_call_is_left_to_itself() -> None:
    script = """
import os, signal, threading, lacuna, numpy as np
signal.signal(signal.SIGINT, signal.default_int_handler)
t = np.arange(40000) * 0.01
x = np.random.default_rng(1).normal(size=(len(t), 3))
threading.Timer(0.1, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    lacuna.identify(x, t, preset="robust", degree=4)
except KeyboardInterrupt:
    print("interrupted")
"""
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, timeout=60
    )
    assert (done.returncode, done.stdout) == (0, "interrupted\n"), done.stderr
