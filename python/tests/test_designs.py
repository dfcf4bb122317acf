"""Plans of experiments, parts compared, structures compared: values beside their texts."""

from __future__ import annotations

import csv
import io
import pickle
from pathlib import Path
from typing import Any

import pytest
from conftest import FREE, NOMINAL, OSCILLATOR, Command

import lacuna

pytestmark = pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")

NUMBERS = {"draws": 2, "safety_draws": 10, "candidates": 4, "searches": 1, "evaluations": 10}


@pytest.fixture(scope="module")
def planned() -> lacuna.Plan:
    """An experiment that is to show whether there is friction."""
    rivals = {
        "free": lacuna.Model.from_text(NOMINAL),
        "damped": lacuna.Model.from_text(OSCILLATOR),
    }
    return lacuna.plan(
        rivals, inputs={"u": (-2, 2)}, measure={"x": 0.01}, duration=10, sample=0.1,
        options=NUMBERS,
    )  # fmt: skip


def test_models_in_memory_are_rivals(planned: lacuna.Plan) -> None:
    assert planned.ok
    pairs = {(pair.truth, pair.rival) for pair in planned.promise.pairs}
    assert pairs == {("free", "damped"), ("damped", "free")}
    rows = list(csv.reader(io.StringIO(planned.inputs())))
    assert [float(row[-1]) for row in rows[1:] if abs(float(row[-1])) > 2] == []
    assert len(rows) > 50
    assert "double" in planned.inputs("c")
    with pytest.raises(lacuna.ConfigError, match="csv, c, awg"):
        planned.inputs("nonsense")


def test_a_plan_goes_to_other_processes(planned: lacuna.Plan) -> None:
    again = pickle.loads(pickle.dumps(planned))
    assert again.to_json() == planned.to_json()
    assert again.inputs("c") == planned.inputs("c")
    with pytest.raises(lacuna.ConfigError, match="csv, c, awg"):
        again.inputs("nonsense")


def test_a_plan_takes_its_models_from_an_answer(inside: Path) -> None:
    found = lacuna.fit("free.ode", "run.csv", restarts=0)
    (inside / "found.json").write_text(found.to_json())
    given: dict[str, Any] = {"inputs": {"u": (-2, 2)}, "duration": 5, "options": NUMBERS}
    of_value, of_file = lacuna.plan(after=found, **given), lacuna.plan(after="found.json", **given)
    assert of_value.to_json() == of_file.to_json()
    assert {one.name for one in of_value.promise.parameters} == {"k", "d", "v: u"}


def test_what_is_not_known_of_a_plan_is_refused() -> None:
    model = lacuna.Model.from_text(FREE)
    with pytest.raises(lacuna.ConfigError, match="bayes-factor"):
        lacuna.plan(model, inputs={"u": (-1, 1)}, measure={"x": 1}, duration=1, criterion="none")
    with pytest.raises(lacuna.ConfigError, match="duration"):
        lacuna.plan(model, inputs={"u": (-1, 1)}, measure={"x": 1})
    with pytest.raises(TypeError, match="draw"):
        lacuna.plan(model, options={"drawz": 1})


def test_parts_are_compared_as_by_the_command(inside: Path, command: Command) -> None:
    compared = lacuna.bench(
        "rossler", parts={"regressor": ["ols", "stlsq"]}, noise=[0, 0.1], samples=500
    )
    command(
        "bench", "rossler", "--parts", "regressor=ols,stlsq", "--noise", "0,0.1",
        "--samples", "500", "--csv", "out.csv", folder=inside,
    )  # fmt: skip

    def cells(text: str) -> list[dict[str, str]]:
        rows = list(csv.DictReader(io.StringIO(text)))
        return [{key: row[key] for key in row if "second" not in key and "ms" not in key}
                for row in rows]  # fmt: skip

    assert cells(compared.to_csv()) == cells((inside / "out.csv").read_text())
    assert [row.regressor for row in compared.rows] == ["ols", "ols", "stlsq", "stlsq"]
    assert len(compared.rows.to_frame()) == 4
    assert pickle.loads(pickle.dumps(compared)).to_csv() == compared.to_csv()
    with pytest.raises(TypeError, match="no JSON"):
        compared.to_json()


def test_parts_are_compared_on_arrays(samples: tuple[Any, Any]) -> None:
    t, x = samples
    compared = lacuna.bench(
        x, t, parts={"regressor.threshold": [0.01, 0.1]}, preset="sindy", degree=1
    )
    assert compared.ok
    assert len(compared.rows) == 2
    with pytest.raises(lacuna.ConfigError, match="nonsense"):
        lacuna.bench(x, t, parts={"regressor": ["nonsense"]})


def test_structures_in_memory_are_compared(inside: Path) -> None:
    free, nominal = lacuna.Model.load("free.ode"), lacuna.Model.load("nominal.ode")
    rivals = lacuna.fit({"with": free, "without": nominal}, "run.csv", restarts=0)
    assert isinstance(rivals, lacuna.Rivals)
    assert [one.model for one in rivals.rivals] == ["with", "without"]
    with pytest.raises(lacuna.ArgumentError, match="no model"):
        lacuna.fit([], "run.csv")
    assert rivals.model.parameters["d"] == pytest.approx(0.3, rel=0.05)


def test_a_limit_of_time_ends_a_call_with_an_answer(inside: Path) -> None:
    found = lacuna.identify("orbit.csv", time_limit=1e-3)
    assert found.model is not None
    assert not all(stage.done for stage in found.stages)
    with pytest.raises(lacuna.ArgumentError, match="seconds"):
        lacuna.identify("orbit.csv", time_limit=-1)
    with pytest.raises(lacuna.ConfigError, match="quick"):
        lacuna.identify("orbit.csv", effort="nonsense")
