"""Errors and warnings have arguments of functions where the command has options."""

from __future__ import annotations

import inspect
from collections.abc import Callable

import numpy as np
import pytest

import lacuna
from lacuna.wording import ARGUMENTS, PAIRS, SAME, in_python

T = np.arange(0, 4, 0.05)
MODEL = lacuna.Model.from_text("input force\ndx/dt = v\ndv/dt = -4*x + force")
WAVE = np.column_stack([np.cos(2 * T), -2 * np.sin(2 * T)])
NAMED = {"t": T, "x": WAVE[:, 0], "v": WAVE[:, 1]}

CALLS: list[tuple[Callable[[], object], str]] = [
    (lambda: lacuna.sync(MODEL, {**NAMED, "F": T}), "names={'force': 'F'}"),
    (lambda: lacuna.simulate(MODEL, [1, 0, 0], T, inputs=T), "x0=[1.0,0.0,0.0]: 3 numbers"),
    (lambda: lacuna.simulate(MODEL, [1, 0], T), "inputs: the model has inputs"),
    (lambda: lacuna.simulate(MODEL, inputs=T, t=T), "give x0= with one number per state"),
    (lambda: lacuna.identify(NAMED, states="y"), "names={'y': 'COLUMN'}"),
    (lambda: lacuna.identify(WAVE, T, options={"regressor.treshold": 1}), "regressor.treshold"),
    (lambda: lacuna.check({"x": T[::-1], "y": T}, states="y"), "t='NAME'"),
]


@pytest.mark.parametrize(("call", "says"), CALLS)
def test_errors_name_arguments(call: Callable[[], object], says: str) -> None:
    with pytest.raises(lacuna.Error) as raised:
        call()
    assert says in str(raised.value)
    assert "--" not in str(raised.value)


@pytest.mark.parametrize(
    ("option", "argument"),
    [
        ("add it (--map th=Winkel 1)", "add it (names={'th': 'Winkel 1'})"),
        ("--set refiner=none shows it", "options={'refiner': 'none'} shows it"),
        ('--set a.b="c"', "options={'a.b': \"c\"}"),
        ("give the step (--dt 0.01)", "give the step (t=0.01)"),
        ("steps adapt (--integrator auto)", "steps adapt (integrator='auto')"),
        ("give --t-end later than --t-start", "give t_end= later than t_start="),
        # What has no argument of this name, or another form there, is left as it is.
        ("save the model (--model-out) first", "save the model (--model-out) first"),
        ('--set basis={"type": "x"}', '--set basis={"type": "x"}'),
        ("(--map force (N)=COLUMN)", "(--map force (N)=COLUMN)"),
        ("a--b", "a--b"),
    ],
)
def test_options_are_arguments(option: str, argument: str) -> None:
    assert in_python(option) == argument


def test_a_step_is_called_as_by_the_function() -> None:
    assert in_python("take a longer --dt", ["dt"]) == "take a longer dt="
    assert in_python("take a longer --dt", ["threads"]) == "take a longer t="


def test_arguments_are_those_of_functions() -> None:
    functions: list[Callable[..., object]] = [
        lacuna.identify, lacuna.diagnose, lacuna.fit, lacuna.sync, lacuna.simulate, lacuna.Records,
    ]  # fmt: skip
    known = {name for one in functions for name in inspect.signature(one).parameters}
    assert {*ARGUMENTS.values(), *SAME} <= known
    assert {*PAIRS} <= {*ARGUMENTS, *SAME}
