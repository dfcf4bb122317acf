"""Tasks of PySINDy's tests and tutorials, put to lacuna: the values asserted there hold here.

Each task has the name of the test whose task it is; docs/pysindy-tasks.md is the table, with the
reasons of what is not there.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from conftest import ROOT
from pysindy_records import Tasks, line, logistic, lorenz, sindy, three_lorenz
from sklearn.exceptions import NotFittedError
from sklearn.model_selection import GridSearchCV, TimeSeriesSplit
from sklearn.utils.validation import check_is_fitted
from test_pysindy_inputs import task as task_with_inputs
from test_pysindy_settings import task as task_of_settings

import lacuna

pytestmark = pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")

task = Tasks()

PRINTED = [
    "test_pysindy: test_equations",
    "test_pysindy: test_print_discrete_time",
    "test_pysindy: test_print_discrete_time_multiple_trajectories",
]


# Fitting, predicting, simulating, scoring of flows.


@task("test_pysindy: test_get_feature_names_len")
def _() -> None:
    trail = lacuna.identify(*lorenz(), preset="sindy", degree=2, threads=1).trail
    assert len({row.term for row in trail}) == 10


@task("test_pysindy: test_not_fitted")
def _() -> None:
    x, t = line()
    with pytest.raises(NotFittedError):
        sindy().predict(x)
    with pytest.raises(NotFittedError):
        sindy().get_feature_names()
    with pytest.raises(NotFittedError):
        sindy().coefficients()
    with pytest.raises(NotFittedError):
        sindy().equations()
    with pytest.raises(NotFittedError):
        sindy().simulate(x[0], t)


@task("test_pysindy: test_nan_derivatives")
def _() -> None:
    x, t = lorenz()
    gaps = np.array(x)
    gaps[[0, -1]] = np.nan
    model = sindy(feature_names=["x", "y", "z"]).fit(gaps, t=t)
    assert model.model_.terms["x"] == pytest.approx({"x": -10, "y": 10}, rel=0.02)


@task("test_pysindy: test_mixed_inputs")
def _() -> None:
    for x, t in (line(), lorenz()):
        check_is_fitted(sindy().fit(x, t=2))
        check_is_fitted(sindy().fit(x, x_dot=x))
        check_is_fitted(sindy().fit(x, t=t, x_dot=x))


@task("test_pysindy: test_bad_t")
def _() -> None:
    for x, t in (line(), lorenz()):
        swapped, twice = np.array(t), np.array(t)
        swapped[[2, 4]] = swapped[[4, 2]]
        twice[3] = twice[5]
        for bad in (-1, t[:-1], swapped, twice):
            with pytest.raises(ValueError):
                sindy().fit(x, t=bad)


@task("test_pysindy: test_predict")
def _() -> None:
    for x, t in (line(), lorenz()):
        for optimizer in ("stlsq", "sr3", "elastic-net", "ols"):
            assert sindy(optimizer=optimizer).fit(x, t=t).predict(x).shape == x.shape


@task("test_pysindy: test_simulate")
def _() -> None:
    for x, t in (line(), lorenz()):
        assert len(sindy().fit(x, t=t).simulate(x[0], t)) == len(t)


@task("test_pysindy: test_libraries")
def _() -> None:
    x, t = lorenz()
    own = lacuna.Basis(lambda states, inputs: [f for s in states for f in (s, f"{s}^2")])
    for library in (lacuna.Monomials(max_degree=3), lacuna.Fourier(), own):
        assert sindy(degree=None, feature_library=library).fit(x, t=t).score(x, t=t) <= 1


@task("test_pysindy: test_score")
def _() -> None:
    for x, t in (line(), lorenz()):
        model = sindy().fit(x, t=t)
        assert model.score(x) <= 1
        assert model.score(x, t=t) <= 1
        assert model.score(x, x_dot=x) <= 1
        assert model.score(x, t=t, x_dot=x) <= 1


@task("test_pysindy: test_fit_multiple_trajectores")
def _() -> None:
    x, t = three_lorenz()
    assert sindy().fit(x, t=t).score(x, t=t) > 0.8
    check_is_fitted(sindy().fit(x, x_dot=x))
    check_is_fitted(sindy().fit(x, t=t, x_dot=x))


@task("test_pysindy: test_predict_multiple_trajectories")
def _() -> None:
    x, t = three_lorenz()
    predicted = sindy().fit(x, t=t).predict(x)
    assert [one.shape for one in predicted] == [one.shape for one in x]


@task("test_pysindy: test_score_multiple_trajectories")
def _() -> None:
    x, t = three_lorenz()
    model = sindy().fit(x, t=t)
    assert model.score(x) <= 1
    assert model.score(x, t=t) <= 1
    assert model.score(x, x_dot=x) <= 1
    assert model.score(x, t=t, x_dot=x) <= 1


@task("test_pysindy: test_coefficients")
def _() -> None:
    x, t = lorenz()
    assert np.count_nonzero(sindy().fit(x, t=t).coefficients()) < 10


@task("test_pysindy: test_complexity")
def _() -> None:
    x, t = lorenz()
    assert sindy().fit(x, t=t).complexity < 10


@task("test_pysindy: test_differentiate")
def _() -> None:
    x, t = lorenz()
    assert sindy().differentiate(x, t).shape == x.shape
    several, times = three_lorenz()
    assert len(sindy().differentiate(several, times)) == 3
    with pytest.raises(RuntimeError):
        sindy(discrete_time=True).differentiate(x)


@task("test_pysindy: test_simulate_errors")
def _() -> None:
    x, t = lorenz()
    with pytest.raises(ValueError):
        sindy().fit(x, t=t).simulate(x[0], t=1)


@task("test_pysindy: test_fit_warn")
def _() -> None:
    x, t = lorenz()
    too_large = lacuna.Stlsq(threshold=100, scale="coefficient")
    with pytest.warns(UserWarning):
        sindy(optimizer=too_large).fit(x, t=t)


@task("test_pysindy: test_multiple_trajectories_errors")
def _() -> None:
    x, t = three_lorenz()
    with pytest.raises(ValueError):
        sindy().fit(x, t=t[:2])
    with pytest.raises(ValueError):
        sindy().fit(x, t=t, x_dot=x[:2])


@pytest.fixture
def printed(capsys: pytest.CaptureFixture[str]) -> Callable[[], str]:
    return lambda: capsys.readouterr().out


def test_equations_are_printed_only_when_asked(printed: Callable[[], str]) -> None:
    """The tasks of PRINTED."""
    for x, t in (line(), lorenz()):
        model = sindy().fit(x, t=t)
        assert printed() == ""
        model.print(precision=2)
        assert len(printed()) > 0
    maps: list[Any] = [logistic(), [logistic(), logistic(3.5)]]
    for x in maps:
        sindy(discrete_time=True).fit(x).print()
        assert len(printed()) > 1


# Maps.


@task("test_pysindy: test_fit_discrete_time")
def _() -> None:
    check_is_fitted(sindy(discrete_time=True).fit(logistic()))


@task("test_pysindy: test_simulate_discrete_time")
def _() -> None:
    x = logistic()
    assert len(sindy(discrete_time=True).fit(x).simulate(x[0], len(x))) == len(x)


@task("test_pysindy: test_predict_discrete_time")
def _() -> None:
    x = logistic()
    assert len(sindy(discrete_time=True).fit(x).predict(x)) == len(x)


@task("test_pysindy: test_score_discrete_time")
def _() -> None:
    x = logistic()
    model = sindy(discrete_time=True).fit(x)
    assert model.score(x) > 0.75
    assert model.score(x, x_dot=x) < 1


@task("test_pysindy: test_fit_discrete_time_multiple_trajectories")
def _() -> None:
    check_is_fitted(sindy(discrete_time=True).fit([logistic(3.6), logistic(3.6, 60)]))


@task("test_pysindy: test_predict_discrete_time_multiple_trajectories")
def _() -> None:
    x = [logistic(3.6), logistic(3.6, 60)]
    assert len(sindy(discrete_time=True).fit(x).predict(x)) == len(x)


@task("test_pysindy: test_score_discrete_time_multiple_trajectories")
def _() -> None:
    x = [logistic(3.6), logistic(3.6, 60)]
    model = sindy(discrete_time=True).fit(x)
    assert model.score(x) > 0.75
    assert model.score(x, x_dot=x) < 1


# Derivatives, regressors, libraries.


@task("test_differentiation_methods: test_finite_difference")
def _() -> None:
    t = np.arange(1.0, 101.0)
    for slopes in ([2.0], [2.0, -10.0]):
        rates = sindy().differentiate(np.outer(t, slopes), t)
        np.testing.assert_allclose(rates, np.tile(slopes, (100, 1)))


@task("test_differentiation_methods: test_derivative_output_shape")
def _() -> None:
    x = np.outer(np.arange(1.0, 101.0), [2.0, -10.0])
    for name in ("spectral", "smoothing-spline", "savitzky-golay", "kalman", "finite-differences"):
        assert sindy(differentiation_method=name).differentiate(x, 1.0).shape == x.shape


@task("test_optimizers: test_fit")
def _() -> None:
    theta = 2 * np.arange(1.0, 101.0)[:, None]
    for name in ("stlsq", "sr3", "elastic-net"):
        model = sindy(degree=1, optimizer=name).fit(theta, t=1.0)
        check_is_fitted(model)
        assert model.complexity >= 0


@task("test_optimizers: test_general_bad_parameters")
def _() -> None:
    for part in (lacuna.Stlsq, lacuna.Sr3):
        for bad in ({"threshold": -1}, {"max_iterations": 0}, {"nonsense": 1}):
            with pytest.raises(ValueError):
                part(**bad)


@task("test_optimizers: test_sr3_bad_parameters")
def _() -> None:
    for bad in ({"relaxation": 0}, {"relaxation": -1}, {"max_iterations": -1}):
        with pytest.raises(ValueError):
            lacuna.Sr3(**bad)


@task("test_feature_library: test_output_shape")
def _() -> None:
    x, t = lorenz()
    fourier = lacuna.Fourier(harmonics=1, with_linear=False)
    own = lacuna.Basis(lambda states, inputs: [f for s in states for f in (s, f"{s}^2")])
    for library, count in ((lacuna.Monomials(max_degree=2), 10), (fourier, 6), (own, 6)):
        pipeline = lacuna.Pipeline(preset="sindy", basis=library)
        trail = lacuna.identify(x, t, pipeline=pipeline, threads=1).trail
        assert len({row.term for row in trail}) == count


@task("test_feature_library: test_bad_parameters")
def _() -> None:
    refused: list[Callable[[], Any]] = [
        lambda: lacuna.Monomials(max_degree=-1),
        lambda: lacuna.Monomials(max_degree=1.5),
        lambda: lacuna.Fourier(harmonics=-1),
        lambda: lacuna.Fourier(harmonics=2.2),
    ]
    for bad in refused:
        with pytest.raises(ValueError):
            bad()


# Tutorials.


@task("notebook 1_feature_overview")
def _() -> None:
    t = np.arange(0, 10, 0.002)
    x = lacuna.simulate("lorenz", [-8, 8, 27], t).x
    model = sindy(feature_names=["x", "y", "z"]).fit(x, t=t)
    terms = model.model_.terms
    assert terms["x"] == pytest.approx({"x": -10, "y": 10}, rel=2e-3)
    assert terms["y"] == pytest.approx({"x": 28, "y": -1, "x*z": -1}, rel=6e-3)
    assert terms["z"] == pytest.approx({"z": -2.667, "x*y": 1}, rel=2e-3)
    other_t = np.arange(0, 15, 0.002)
    other = lacuna.simulate("lorenz", [8, 7, 15], other_t).x
    assert model.score(other, t=other_t) == pytest.approx(1.0, abs=1e-3)
    noisy = x + np.random.default_rng(1).normal(scale=0.1, size=x.shape)
    smooth = sindy(differentiation_method=lacuna.SavitzkyGolay(window=41)).fit(noisy, t=t)
    assert smooth.score(x, t=t) > 0.99


@task("notebook 2_introduction_to_sindy")
def _() -> None:
    t = np.linspace(0, 1, 100)
    x = np.column_stack([3 * np.exp(-2 * t), 0.5 * np.exp(t)])
    model = sindy(feature_names=["x", "y"]).fit(x, t=t)
    assert model.model_.terms["x"] == pytest.approx({"x": -2.0}, rel=5e-3)
    assert model.model_.terms["y"] == pytest.approx({"y": 1.0}, rel=5e-3)
    start = np.array([6.0, -0.1])
    truth = start * np.column_stack([np.exp(-2 * t), np.exp(t)])
    np.testing.assert_allclose(model.simulate(start, t), truth, atol=0.02)


def _found_by_paper(text: str, start: list[float], end: float, degree: int) -> None:
    truth = lacuna.Model.from_text(text)
    t = np.arange(0, end, 0.01)
    run = lacuna.simulate(truth, start, t)
    model = sindy(degree=degree, feature_names=list(truth.states)).fit(run.x, t=t)
    for state, terms in truth.terms.items():
        assert model.model_.terms[state] == pytest.approx(terms, rel=0.02), state


@task("notebook 3_original_paper")
def _() -> None:
    linear = "dx/dt = -0.1*x + 2*y\ndy/dt = -2*x - 0.1*y"
    cubic = "dx/dt = -0.1*x^3 + 2*y^3\ndy/dt = -2*x^3 - 0.1*y^3"
    _found_by_paper(linear, [2, 0], 25, 5)
    _found_by_paper(cubic, [2, 0], 25, 3)
    _found_by_paper(linear + "\ndz/dt = -0.3*z", [2, 0, 1], 25, 2)
    mean_field = "dx/dt = 0.1*x - y - x*z\ndy/dt = x + 0.1*y - y*z\ndz/dt = x^2 + y^2 - z"
    _found_by_paper(mean_field, [0.001, 0, 0.1], 95, 2)


@task("notebook 4_scikit_learn_compatibility")
def _() -> None:
    t = np.arange(0, 4, 0.002)
    x = lacuna.simulate("lorenz", [-8, 8, 27], t).x
    grid = {"degree": [1, 2], "optimizer": [lacuna.Stlsq(threshold=c) for c in (0.01, 0.1)]}
    search = GridSearchCV(sindy(t_default=0.002), grid, cv=TimeSeriesSplit(3)).fit(x)
    assert search.best_params_["degree"] == 2
    assert search.best_estimator_.score(x) > 0.999


@task("notebook 5_differentiation")
def _() -> None:
    t = np.linspace(0, 2 * np.pi, 200)
    clean = np.sin(t)[:, None]
    exact = sindy().differentiate(clean, t)[:, 0]
    assert np.abs(exact - np.cos(t)).max() < 0.01
    noisy = clean + np.random.default_rng(1).normal(scale=0.01, size=clean.shape)
    raw = sindy().differentiate(noisy, t)[:, 0]
    methods = (lacuna.SavitzkyGolay(window=21), lacuna.SmoothingSpline())
    for method in methods:
        smooth = sindy(differentiation_method=method).differentiate(noisy, t)[:, 0]
        assert np.std(smooth - np.cos(t)) < 0.5 * np.std(raw - np.cos(t))


@task("notebook 7: logistic map with a parameter")
def _() -> None:
    rates = [2.5, 2.75, 3.0, 3.25, 3.5, 3.75, 3.8, 3.85, 3.9, 3.95]
    model = sindy(degree=3, discrete_time=True, feature_names=["x"])
    model.fit([logistic(r, 400) for r in rates], u=[np.full(400, r) for r in rates])
    assert model.model_.terms["x"] == pytest.approx({"x*u0": 1, "x^2*u0": -1}, rel=1e-6)


@pytest.mark.parametrize("name", task)
def test_a_task_has_the_value_asserted_there(name: str) -> None:
    task[name]()


def test_the_table_has_every_task() -> None:
    table, rest = (ROOT / "docs/pysindy-tasks.md").read_text().split("## What is not there")
    named = re.findall(r"\| `((?:test_\w+: test_\w+)|(?:notebook [^`]+))`", table)
    tasks = {*task, *task_with_inputs, *task_of_settings, *PRINTED}
    assert sorted(named) == sorted(tasks)
    assert not set(re.findall(r"`(test_\w+: test_\w+)`", rest)) & set(tasks)
    tests = [name for name in tasks if name.startswith("test_")]
    assert len(tests) >= 40
    assert len(tasks) - len(tests) >= 6
