"""Other processes and interpreters: forked, spawned, of the same process."""

from __future__ import annotations

import copy
import os
import pickle
import subprocess
import sys
import threading
from multiprocessing import get_context
from typing import Any

import numpy as np
import pytest

import lacuna

Samples = tuple[np.ndarray, np.ndarray]
pytestmark = pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")


def forked(call: Any) -> int:
    """Status of a forked process that makes a call and ends without Python's own end."""
    child = os.fork()
    if child == 0:
        try:
            os._exit(0 if call() else 1)
        finally:
            os._exit(2)
    return os.waitpid(child, 0)[1]


def test_a_forked_process_answers(samples: Samples) -> None:
    t, x = samples

    def answer() -> str:
        return lacuna.identify(x, t, preset="sindy", threads=2).to_json()

    here = answer()  # threads have been used
    assert forked(lambda: answer() == here) == 0
    assert answer() == here


def test_a_process_forked_during_a_call_answers(samples: Samples) -> None:
    t, x = samples
    status: list[int] = []

    def fork(activity: str, fraction: float) -> None:
        if not status:
            status.append(forked(lambda: bool(lacuna.check(x, t).to_json())))

    many = np.tile(x, (12, 1))
    lacuna.identify(many, 0.05, preset="robust", progress=fork)
    assert status == [0]


def identified(records: lacuna.Records) -> tuple[lacuna.Model, lacuna.Identification]:
    found = lacuna.identify(records, preset="sindy")
    return found.model, found


def test_spawned_processes_answer(samples: Samples) -> None:
    """Records go there, models and answers come back."""
    t, x = samples
    records = lacuna.Records(x, t, np.cos(t), states=["q", "w"], units={"q": "m"})
    model, found = identified(records)
    with get_context("spawn").Pool(2) as pool:
        answers = pool.map(identified, [records, records])
    for there, answer in answers:
        assert there == model
        assert answer.to_json() == found.to_json()
        assert answer.summary() == found.summary()


def refused(solver: lacuna.Stage) -> None:
    lacuna.check(np.zeros((5, 2, 2)), 0.1)


def test_errors_come_from_spawned_processes(samples: Samples) -> None:
    with get_context("spawn").Pool(1) as pool, pytest.raises(lacuna.ArgumentError) as raised:
        pool.apply(refused, (lacuna.Stlsq(threshold=0.1),))
    assert "3 dimensions" in raised.value.problem
    assert raised.value.where and raised.value.remedy


def test_values_are_copied_and_pickled(samples: Samples) -> None:
    t, x = samples
    records = lacuna.Records(x, t, states=["q", "w"], units={"q": "m", "t": "ms"})
    run = lacuna.simulate("lorenz", [1, 1, 20], np.arange(0, 1, 0.1))
    for again in (pickle.loads(pickle.dumps(records)), copy.deepcopy(records)):
        assert lacuna.check(again).to_json() == lacuna.check(records).to_json()
    for same in (pickle.loads(pickle.dumps(run)), copy.deepcopy(run)):
        assert same.to_csv() == run.to_csv()
        assert (same.names, same.units, same.time_unit) == (run.names, run.units, run.time_unit)
        np.testing.assert_array_equal(same.x, run.x)
        np.testing.assert_array_equal(same.t, run.t)


SECOND = """
import sys
try:
    import _interpreters as interpreters
except ImportError:
    import _xxsubinterpreters as interpreters
import lacuna
code = '''
try:
    import lacuna
except ImportError as error:
    print("refused", error, flush=True)
'''
other = interpreters.create()
interpreters.run_string(other, code)
interpreters.destroy(other)
print(len(lacuna.check({"t": [0.0, 0.1, 0.2, 0.3], "x": [1.0, 2.0, 3.0, 4.0]}).records))
"""


def test_a_second_interpreter_is_refused() -> None:
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", SECOND], capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0, done.stderr
    first, last = done.stdout.splitlines()
    assert first.startswith("refused ") and "interpreter" in first
    assert last == "1"


def test_calls_in_threads_give_the_same(samples: Samples) -> None:
    t, x = samples
    alone = lacuna.identify(x, t, preset="sindy").to_json()
    found: list[str] = []

    def call() -> None:
        found.append(lacuna.identify(x, t, preset="sindy").to_json())

    workers = [threading.Thread(target=call) for _ in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert found == [alone] * 4
