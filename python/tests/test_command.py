"""Answers are those of the command, to the byte."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from conftest import Command

import lacuna

# What the command is given, and the same call.
Case = tuple[list[str], Callable[[], Any]]

# A short search for an experiment.
NUMBERS = {"draws": 2, "safety_draws": 10, "candidates": 4, "searches": 1, "evaluations": 10}
SEARCH = [text for name, n in NUMBERS.items() for text in ("--" + name.replace("_", "-"), str(n))]

CASES: dict[str, Case] = {
    "identify": (["identify", "orbit.csv"], lambda: lacuna.identify("orbit.csv")),
    "identify-preset": (
        ["identify", "run.csv", "--inputs", "u", "--preset", "sindy"],
        lambda: lacuna.identify("run.csv", inputs="u", preset="sindy"),
    ),
    "identify-degree": (
        ["identify", "run.csv", "--inputs", "u", "--preset", "sindy", "--degree", "1"],
        lambda: lacuna.identify("run.csv", inputs=["u"], preset="sindy", degree=1),
    ),
    "identify-terms": (
        ["identify", "run.csv", "--inputs", "u", "--terms", "x,v,u", "--hold", "u=linear"],
        lambda: lacuna.identify(
            "run.csv", inputs="u", terms=["x", "v", "u"], hold={"u": "linear"}
        ),
    ),
    "identify-set": (
        ["identify", "run.csv", "--inputs", "u", "--preset", "sindy", "--add", "sin(x)",
         "--set", "regressor.threshold=0.05"],
        lambda: lacuna.identify(
            "run.csv", inputs="u", preset="sindy", add="sin(x)",
            options={"regressor.threshold": 0.05},
        ),
    ),
    "identify-constraints": (
        ["identify", "run.csv", "--inputs", "u", "--preset", "sindy", "--degree", "1",
         "--fix", "x: v = 1", "--equation", "v: x,v,u"],
        lambda: lacuna.identify(
            "run.csv", inputs="u", preset="sindy", degree=1, constraints="x: v = 1",
            equations={"v": ["x", "v", "u"]},
        ),
    ),
    "identify-map": (
        ["identify", "map.csv", "--discrete", "--degree", "2"],
        lambda: lacuna.identify("map.csv", discrete=True, degree=2),
    ),
    "identify-embed": (
        ["identify", "run.csv", "--states", "x", "--inputs", "u", "--embed", "x=2",
         "--preset", "sindy", "--degree", "1"],
        lambda: lacuna.identify(
            "run.csv", states="x", inputs="u", embed={"x": 2}, preset="sindy", degree=1
        ),
    ),
    "identify-holdout": (
        ["identify", "run.csv", "--inputs", "u", "--preset", "sindy", "--degree", "1",
         "--holdout", "other.csv"],
        lambda: lacuna.identify(
            "run.csv", inputs="u", preset="sindy", degree=1, holdout="other.csv"
        ),
    ),
    "diagnose": (
        ["diagnose", "--model", "nominal.ode", "run.csv", "--effect", "linear-term"],
        lambda: lacuna.diagnose("nominal.ode", "run.csv", effects="linear-term"),
    ),
    "diagnose-options": (
        ["diagnose", "--model", "nominal.ode", "run.csv", "--holdout", "other.csv",
         "--effect", "linear-term", "--max-effects", "1", "--tolerance", "v:x=5%",
         "--limits", "x=-9:9", "--set", "decision.significance=4"],
        lambda: lacuna.diagnose(
            "nominal.ode", "run.csv", holdout="other.csv", effects=["linear-term"],
            max_effects=1, tolerances="v:x=5%", limits={"x": (-9, 9)},
            options={"decision.significance": 4},
        ),
    ),
    "fit": (["fit", "free.ode", "run.csv"], lambda: lacuna.fit("free.ode", "run.csv")),
    "fit-holdout": (
        ["fit", "free.ode", "run.csv", "--holdout", "other.csv", "--ahead", "5",
         "--restarts", "1"],
        lambda: lacuna.fit("free.ode", "run.csv", holdout="other.csv", ahead=5, restarts=1),
    ),
    "identify-effort": (
        ["identify", "orbit.csv", "--effort", "quick"],
        lambda: lacuna.identify("orbit.csv", effort="quick"),
    ),
    "fit-rivals": (
        ["fit", "free.ode", "nominal.ode", "run.csv", "--restarts", "0"],
        lambda: lacuna.fit(["free.ode", "nominal.ode"], "run.csv", restarts=0),
    ),
    "plan": (
        ["plan", "free.ode", "--input", "u=-2..2, family steps", "--measure", "x=0.01",
         "--duration", "10", "--safe", "x=-3..3", *SEARCH],
        lambda: lacuna.plan(
            "free.ode", inputs={"u": "-2..2, family steps"}, measure={"x": 0.01}, duration=10,
            safe={"x": (-3, 3)}, options=NUMBERS,
        ),
    ),
    "plan-rivals": (
        ["plan", "true.ode", "nominal.ode", "--data", "run.csv", "--start", "x=0..1",
         "--criterion", "box-hill", *SEARCH],
        lambda: lacuna.plan(
            ["true.ode", "nominal.ode"], "run.csv", start={"x": (0, 1)}, criterion="box-hill",
            options=NUMBERS,
        ),
    ),
    "sync": (["sync", "true.ode", "run.csv"], lambda: lacuna.sync("true.ode", "run.csv")),
    "sync-coupling": (
        ["sync", "true.ode", "run.csv", "--coupling", "x=3,v=2"],
        lambda: lacuna.sync("true.ode", "run.csv", coupling={"x": 3, "v": 2}),
    ),
    "compare-model": (
        ["compare", "lorenz", "orbit.csv"], lambda: lacuna.compare("lorenz", "orbit.csv")
    ),
    "compare-records": (
        ["compare", "run.csv", "other.csv", "--states", "x,v"],
        lambda: lacuna.compare("run.csv", "other.csv", states="x,v"),
    ),
    "check": (["check", "run.csv", "other.csv"], lambda: lacuna.check(["run.csv", "other.csv"])),
    "check-model": (
        ["check", "run.csv", "--model", "nominal.ode"],
        lambda: lacuna.check("run.csv", model="nominal.ode"),
    ),
    "check-names": (
        ["check", "run.csv", "--map", "position=x", "--time-unit", "ms"],
        lambda: lacuna.check("run.csv", names={"position": "x"}, time_unit="ms"),
    ),
}  # fmt: skip


@pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")
@pytest.mark.parametrize("name", CASES)
def test_json_and_text_are_those_of_the_command(name: str, inside: Path, command: Command) -> None:
    arguments, call = CASES[name]
    result = call()
    written = inside / f"{name}.json"
    text = command(*arguments, "--json", written, folder=inside)
    assert result.to_json() == written.read_text()
    assert result.summary() == text


@pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")
def test_full_text_and_trail_are_those_of_the_command(inside: Path, command: Command) -> None:
    found = lacuna.identify("run.csv", inputs="u", preset="sindy", degree=1)
    shown = ["identify", "run.csv", "--inputs", "u", "--preset", "sindy", "--degree", "1"]
    asked = ["--digits", "full", "--explain"]
    assert found.summary(full=True, explain=True) == command(*shown, *asked, folder=inside)
    lacks = lacuna.diagnose("nominal.ode", "run.csv", effects="linear-term")
    shown = ["diagnose", "--model", "nominal.ode", "run.csv", "--effect", "linear-term"]
    text = command(*shown, "--explain", folder=inside)
    assert text == lacks.summary() + "\n" + lacks.explain()


def test_a_simulation_is_that_of_the_command(inside: Path, command: Command) -> None:
    run = lacuna.simulate(
        "true.ode", [1, 0], t_end=5, dt=0.25, inputs="input.csv", noise={"x": 0.01}, seed=7
    )
    assert run.to_csv() == command(
        "simulate", "true.ode", "--x0", "1,0", "--t-end", "5", "--dt", "0.25",
        "--input-data", "input.csv", "--noise", "x=0.01", "--seed", "7", folder=inside,
    )  # fmt: skip


def test_texts_about_parts_and_models_are_those_of_the_command(command: Command) -> None:
    assert lacuna.list_parts() == command("list")
    assert lacuna.list_parts("regressor") == command("list", "regressor")
    for name in ("stlsq", "sindy", "lorenz"):
        assert lacuna.describe(name) == command("describe", name)
    for language in ("c", "cpp", "latex", "matlab", "modelica", "python", "spice"):
        assert lacuna.export("lorenz", language) == command(
            "export", "lorenz", "--format", language
        )
    assert lacuna.Model.load("lorenz").to_json() == command("model", "lorenz", "-o", "/dev/stdout")


@pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")
def test_the_page_is_that_of_the_command_but_for_the_call(inside: Path, command: Command) -> None:
    result = lacuna.sync("true.ode", "run.csv")
    page = command("sync", "true.ode", "run.csv", "--report", "-", folder=inside)
    line = "lacuna sync true.ode run.csv --report -"
    assert line in page
    assert result.report() == page.replace(line, "lacuna.sync")
