"""Models are values."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

import lacuna

TEXT = """
time ms
input u [V]
state x [V]
param k = 2 [1/ms] in 0..5
dx/dt = -k*x + y*sin(x) + 3*u
dy/dt = x^2 - abs(y) + min(x,y)
"""


@pytest.fixture
def model() -> lacuna.Model:
    return lacuna.Model.from_text(TEXT)


def test_what_a_text_says_is_there(model: lacuna.Model) -> None:
    assert model.states == ("x", "y")
    assert model.inputs == ("u",)
    assert model.units == {"x": "V", "u": "V"}
    assert model.parameters == {"k": 2.0}
    assert model.time_unit == "ms"
    assert not model.is_map
    assert model.terms["x"] == {"x": -2.0, "y*sin(x)": 1.0, "u": 3.0}
    assert str(model).startswith("dx/dt = ")


def test_calls_are_vectorised(model: lacuna.Model) -> None:
    rows = np.array([[1.0, 2.0], [-0.5, 3.0], [0.0, -1.0]])
    u = np.array([[0.1], [0.2], [0.3]])
    x, y = rows.T
    expected = np.column_stack(
        [-2 * x + y * np.sin(x) + 3 * u[:, 0], x**2 - np.abs(y) + np.minimum(x, y)]
    )
    np.testing.assert_allclose(model(0.0, rows, u), expected, rtol=1e-15)
    np.testing.assert_allclose(model(np.zeros(3), rows, u), expected, rtol=1e-15)
    np.testing.assert_allclose(model(0.0, rows[0], u[0]), expected[0], rtol=1e-15)
    np.testing.assert_allclose(model(0.0, np.asfortranarray(rows), u), expected, rtol=1e-15)
    np.testing.assert_allclose(model(0.0, rows[::2], u[::2]), expected[::2], rtol=1e-15)


def test_jacobians_are_those_of_differences(model: lacuna.Model) -> None:
    rows, u, step = np.array([[1.0, 2.0], [-0.5, 3.0]]), np.zeros((2, 1)), 1e-6
    exact = model.jacobian(0.0, rows, u)
    assert exact.shape == (2, 2, 2)
    for k in range(2):
        moved = rows.copy()
        moved[:, k] += step
        slope = (model(0.0, moved, u) - model(0.0, rows, u)) / step
        np.testing.assert_allclose(exact[:, :, k], slope, atol=1e-5)
    np.testing.assert_array_equal(model.jacobian(0.0, rows[0], u[0]), exact[0])


def test_shapes_that_do_not_fit_are_said(model: lacuna.Model) -> None:
    calls: list[Callable[[], Any]] = [
        lambda: model(0.0, np.zeros(3), 0.0),
        lambda: model(0.0, np.zeros(2)),
        lambda: model(np.zeros(3), np.zeros((2, 2)), np.zeros((2, 1))),
        lambda: model.jacobian(0.0, np.zeros(2), np.zeros((1, 2))),
    ]
    for bad in calls:
        with pytest.raises(lacuna.ArgumentError) as raised:
            bad()
        assert raised.value.remedy


def test_a_model_is_what_it_is_written_as(model: lacuna.Model, tmp_path: Path) -> None:
    assert lacuna.Model.from_json(model.to_json()) == model
    assert lacuna.Model.from_dict(model.to_dict()) == model
    for name in ("m.json", "m.ode"):
        model.save(tmp_path / name)
        again = lacuna.Model.load(tmp_path / name)
        assert again.terms == model.terms
    assert pickle.loads(pickle.dumps(model)) == model
    assert copy.deepcopy(model) == model
    assert len({model, copy.copy(model), lacuna.Model.load("lorenz")}) == 2
    assert model != lacuna.Model.load("lorenz")
    assert model != 1


def test_terms_make_the_same_model() -> None:
    made = lacuna.Model.from_terms({"x": {"y": 1}, "y": {"sin(x)": -9.81, "u": 2.0}}, ["u"])
    read = lacuna.Model.from_text("input u\ndx/dt = y\ndy/dt = -9.81*sin(x) + 2*u")
    assert made.terms == read.terms
    assert lacuna.Model.from_terms({"x": {"x": 0.5}}, is_map=True).is_map


def test_a_text_that_cannot_be_read_names_the_line() -> None:
    with pytest.raises(lacuna.ModelError, match="pendulum:2") as raised:
        lacuna.Model.from_text("dx/dt = y\ndy/dt = -sin(q)", "pendulum")
    assert "q" in raised.value.problem


def test_latex_is_shown_in_notebooks(model: lacuna.Model) -> None:
    assert r"\dot{x}" in model.to_latex()
    assert model._repr_latex_().startswith(r"\begin{align")


def test_scipy_solves_what_the_library_simulates() -> None:
    model = lacuna.Model.from_text("input u\ndx/dt = y\ndy/dt = -4*x - 0.5*y + u")
    rhs, jac = model.to_scipy(lambda t: [1.0])
    times = np.linspace(0, 5, 26)
    theirs = solve_ivp(rhs, (0, 5), [1, 0], "Radau", times, jac=jac, rtol=1e-9, atol=1e-10)
    inputs = lacuna.Records({"t": [0.0, 5.0], "u": [1.0, 1.0]})
    ours = lacuna.simulate(model, [1, 0], times, inputs=inputs)
    np.testing.assert_allclose(ours.x, theirs.y.T, atol=1e-6)
    np.testing.assert_array_equal(ours.t, times)


def test_a_name_of_an_input_is_not_taken_for_a_file_of_its_values() -> None:
    model = lacuna.Model.from_text("input wind\ndx/dt = wind - x")
    with pytest.raises(lacuna.ArgumentError, match=r"name of an input.*array of shape \(n, p\)"):
        lacuna.simulate(model, [1], np.linspace(0, 1, 5), inputs="wind")
    with pytest.raises(lacuna.FileError, match=r"gale\.csv"):
        lacuna.simulate(model, [1], np.linspace(0, 1, 5), inputs="gale.csv")


@pytest.mark.parametrize("name", ["lorenz", "rossler"])
def test_sympy_has_the_same_values(name: str) -> None:
    model = lacuna.Model.load(name)
    rates = model.to_sympy()
    point = dict(zip(rates, (0.3, -1.2, 2.5), strict=True))
    values = [float(rate.subs(point)) for rate in rates.values()]
    np.testing.assert_allclose(values, model(0.0, [0.3, -1.2, 2.5]), rtol=1e-12)
    assert lacuna.Model.from_sympy(rates).terms == model.terms


def test_every_function_goes_to_sympy_and_back() -> None:
    text = (
        "input u\ndx/dt = abs(x)*sin(u) + max(x,u) - min(x,2) + 3*sign(x) + step(x) + tanh(x)\n"
        "dy/dt = clip(x,-1,1) + exp(-y) + sqrt(abs(y)) + atan(u) + t*x^3"
    )
    model = lacuna.Model.from_text(text)
    again = lacuna.Model.from_sympy(model.to_sympy(), ["u"])
    rows, u = np.random.default_rng(1).normal(size=(50, 2)), np.linspace(-2, 2, 50)[:, None]
    t = np.linspace(0, 1, 50)
    np.testing.assert_allclose(again(t, rows, u), model(t, rows, u), rtol=1e-12)


def test_symbols_that_are_no_states_are_inputs() -> None:
    x, k = sympy.symbols("x k")
    model = lacuna.Model.from_sympy({x: -k * x + sympy.Rational(1, 3)})
    assert model.inputs == ("k",)
    assert model(0.0, [2.0], [3.0])[0] == pytest.approx(-6 + 1 / 3)


numbers = st.floats(-50, 50).filter(lambda value: abs(value) > 1e-3)


@settings(max_examples=50, deadline=None)
@given(
    coefficients=st.dictionaries(
        st.sampled_from(["1", "x", "y", "x*y", "x^2", "sin(x)", "exp(y)"]), numbers, min_size=1
    )
)
def test_any_sum_of_terms_comes_back(coefficients: dict[str, float]) -> None:
    model = lacuna.Model.from_terms({"x": coefficients, "y": {"x": 1.0}})
    assert model.terms["x"] == coefficients
    assert lacuna.Model.from_json(model.to_json()) == model
    assert lacuna.Model.from_text(model.to_text()).terms == model.terms
