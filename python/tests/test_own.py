"""Parts written in Python pass the checks of those of the library, and work in its journeys."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lacuna

Samples = tuple[np.ndarray, np.ndarray]
pytestmark = pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")


def friction(states: list[str], inputs: list[str]) -> list[str]:
    return ["1", *states, *inputs, *(f"{x}*abs({x})" for x in states)]


def least_squares(theta: np.ndarray, y: np.ndarray) -> np.ndarray:
    return np.asarray(np.linalg.lstsq(theta, y, rcond=None)[0])


# The contract of tests/contract/basis_test.cpp.


def test_a_basis_makes_distinct_terms_that_can_be_read_back() -> None:
    basis = lacuna.Basis(friction)
    names = basis.library(["x", "y"], ["u"])
    assert len(set(names)) == len(names) == 6
    assert lacuna.Basis(lambda states, inputs: names).library(["x", "y"], ["u"]) == names
    twice = lacuna.Basis(lambda states, inputs: ["x*x", "x^2", "y"])
    assert twice.library(["x", "y"]) == ["x^2", "y"]


@pytest.mark.parametrize(
    ("function", "error"),
    [
        (lambda states, inputs: [], lacuna.ConfigError),
        (lambda states, inputs: ["sin(q)"], lacuna.ModelError),
        (lambda states, inputs: [1], lacuna.ArgumentError),
        (lambda states, inputs: [np.sin], lacuna.ArgumentError),
        (lambda states, inputs: "sin(x)", lacuna.ArgumentError),
        (lambda states, inputs: None, lacuna.ArgumentError),
        (lambda states: ["x"], TypeError),
    ],
)
def test_a_basis_that_gives_no_terms_is_refused(
    function: Callable[..., Any], error: type[Exception]
) -> None:
    with pytest.raises(error):
        lacuna.Basis(function).library(["x"])


def test_formulas_are_texts(samples: Samples) -> None:
    t, x = samples
    own = lacuna.Pipeline(basis=lacuna.Basis(lambda states, inputs: [np.sin]))  # type: ignore[list-item]
    with pytest.raises(lacuna.ArgumentError, match=r"ufunc 'sin'.* as texts: .*'sin\(x\)'"):
        lacuna.identify(x, t, pipeline=own)
    with pytest.raises(lacuna.ArgumentError, match=r"is no function; .* as texts"):
        lacuna.Basis([np.sin])  # type: ignore[arg-type]


# The contract of tests/contract/regressor_test.cpp.

TRUTH = np.array([0.0, 2.0, 0.0, 0.0, -3.0, 0.0])


def columns(noise: float = 0.0, rows: int = 200) -> tuple[np.ndarray, np.ndarray]:
    random = np.random.default_rng(3)
    theta = random.normal(size=(rows, len(TRUTH)))
    return theta, theta @ TRUTH + noise * random.normal(size=rows)


def test_a_regressor_finds_the_exact_coefficients() -> None:
    np.testing.assert_allclose(lacuna.Regressor(least_squares).fit(*columns()), TRUTH, atol=1e-10)


def test_what_a_regressor_sees_has_the_residuals_of_all_rows() -> None:
    theta, y = columns(0.3)
    random = np.random.default_rng(5)
    tried = random.normal(size=(4, len(TRUTH)))

    def solve(small: np.ndarray, target: np.ndarray) -> np.ndarray:
        assert small.shape == (len(TRUTH) + 1, len(TRUTH))
        for h in tried:
            expected = np.linalg.norm(y - theta @ h)
            np.testing.assert_allclose(np.linalg.norm(target - small @ h), expected, rtol=1e-10)
        return least_squares(small, target)

    found = lacuna.Regressor(solve).fit(theta, y)
    np.testing.assert_allclose(found, least_squares(theta, y), rtol=1e-9)


def test_units_of_the_columns_do_not_matter() -> None:
    theta, y = columns(0.1)
    scale = np.array([1e-6, 1e3, 1.0, 1e6, 1e-3, 1.0])
    plain = np.array(lacuna.Regressor(least_squares).fit(theta, y))
    scaled = np.array(lacuna.Regressor(least_squares).fit(theta * scale, y))
    np.testing.assert_allclose(scaled * scale, plain, rtol=1e-7)


@pytest.mark.parametrize(
    ("answer", "problem"), [([1.0], "1 coefficients for 6"), ([np.nan] * 6, "not finite")]
)
def test_coefficients_that_are_none_are_refused(answer: list[float], problem: str) -> None:
    with pytest.raises(lacuna.ArgumentError, match=problem):
        lacuna.Regressor(lambda theta, y: answer).fit(*columns())


def test_own_parts_are_copied_and_pickled() -> None:
    basis = copy.deepcopy(lacuna.Basis(friction, "friction"))
    again = pickle.loads(pickle.dumps(basis))
    assert again.library(["x"]) == basis.library(["x"]) == ["1", "x", "x*abs(x)"]
    regressor = pickle.loads(pickle.dumps(lacuna.Regressor(least_squares)))
    np.testing.assert_allclose(regressor.fit(*columns()), TRUTH, atol=1e-10)
    assert copy.copy(lacuna.Effect("loss", lambda scope: [])).name == "loss"


# In the journeys.


def test_an_own_basis_is_used_by_identify() -> None:
    t = np.arange(0, 20, 0.02)
    truth = lacuna.Model.from_text("dx/dt = v\ndv/dt = -x - 0.3*v*abs(v)")
    run = lacuna.simulate(truth, [2, 0], t)
    pipeline = lacuna.Pipeline(preset="sindy", basis=lacuna.Basis(friction, "friction"))
    found = lacuna.identify(run.x, t, states=["x", "v"], pipeline=pipeline)
    assert found.pipeline.used.basis.type == "friction"
    assert found.model is not None
    assert found.model.terms["v"] == pytest.approx({"x": -1, "v*abs(v)": -0.3}, rel=1e-3)


def test_an_own_regressor_is_used_by_identify(samples: Samples) -> None:
    def thresholded(theta: np.ndarray, y: np.ndarray) -> np.ndarray:
        h = least_squares(theta, y)
        small = np.abs(h) < 0.05
        h[~small] = least_squares(theta[:, ~small], y)
        h[small] = 0.0
        return h

    t, x = samples
    pipeline = lacuna.Pipeline(
        basis=lacuna.Monomials(max_degree=1), filter="none", pruner="keep-all", refiner="none",
        regressor=lacuna.Regressor(thresholded, "thresholded"),
    )  # fmt: skip
    found = lacuna.identify(x, t, states=["x", "v"], pipeline=pipeline)
    assert found.pipeline.used.regressor.type == "thresholded"
    assert found.model is not None
    assert found.model.terms["v"] == pytest.approx({"x": -4.01, "v": -0.2}, rel=0.02)


def test_an_own_effect_is_named_by_diagnose(inside: Path) -> None:
    seen: list[lacuna.Scope] = []

    def damping(scope: lacuna.Scope) -> list[lacuna.Form]:
        seen.append(scope)
        if scope.equation != "v":
            return []
        return [lacuna.Form("v", "v")]

    effect = lacuna.Effect("loss-of-motion", damping, "oil")
    lacks = lacuna.diagnose("nominal.ode", "run.csv", effects=["cubic-term", effect], max_effects=1)
    assert [one.name for one in lacks.effects] == ["loss-of-motion"]
    assert lacks.model is not None
    assert lacks.model.terms["v"]["v"] == pytest.approx(-0.3, rel=0.05)
    assert seen[0].states == ["x", "v"] and seen[0].inputs == ["u"]
    low, high = seen[0].ranges["x"]
    assert low < 0 < high
    assert seen[0].step == pytest.approx(0.05)


def test_a_form_of_an_unknown_name_is_refused(inside: Path) -> None:
    effect = lacuna.Effect("nothing", lambda scope: [lacuna.Form("sin(q*x)", "x")])
    with pytest.raises(lacuna.Error):
        lacuna.diagnose("nominal.ode", "run.csv", effects=["cubic-term", effect])


def test_errors_of_own_functions_come_out(samples: Samples) -> None:
    def broken(*_: Any) -> list[str]:
        raise ZeroDivisionError("mine")

    t, x = samples
    with pytest.raises(ZeroDivisionError, match="mine"):
        lacuna.identify(x, t, pipeline=lacuna.Pipeline(basis=lacuna.Basis(broken)))
    pipeline = lacuna.Pipeline(preset="sindy", regressor=lacuna.Regressor(broken))
    with pytest.raises(ZeroDivisionError, match="mine"):
        lacuna.identify(x, t, pipeline=pipeline, threads=2)
