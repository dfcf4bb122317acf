"""Tasks of PySINDy's tests of settings and parts; see test_pysindy_tasks.py."""

from __future__ import annotations

import numpy as np
import pytest
from pysindy_records import Tasks, forced_logistic, forced_lorenz, line, lorenz, sindy
from sklearn.model_selection import RandomizedSearchCV, TimeSeriesSplit
from sklearn.utils.validation import check_is_fitted

import lacuna

pytestmark = pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")

task = Tasks()


@task("test_pysindy: test_t_default")
def _() -> None:
    x, t = lorenz()
    step = t[1] - t[0]
    for bad in (0, "1"):
        with pytest.raises(ValueError):
            sindy(t_default=bad).fit(x)
    given, usual = sindy().fit(x, t=step), sindy(t_default=step).fit(x)
    np.testing.assert_allclose(given.coefficients(), usual.coefficients())
    np.testing.assert_almost_equal(given.score(x, t=step), usual.score(x))
    np.testing.assert_almost_equal(given.differentiate(x, t=step), usual.differentiate(x))


@task("test_pysindy: test_differentiate_returns_compatible_data_type")
def _() -> None:
    for x, _ in (line(), lorenz()):
        assert isinstance(sindy().differentiate(x), type(x))


@task("test_pysindy: test_integration_smoothed_finite_difference")
def _() -> None:
    x, t = lorenz()
    check_is_fitted(sindy(differentiation_method=lacuna.SavitzkyGolay()).fit(x, t=t))


@task("test_pysindy: test_integration_derivative_methods")
def _() -> None:
    x, t = lorenz()
    for method in ("finite-differences", "smoothing-spline", "spectral", "kalman"):
        model = sindy(differentiation_method=method).fit(x, t=t)
        check_is_fitted(model)
        assert model.result_.pipeline.used.formulation.differentiator.type == method


@task("test_pysindy: test_cross_validation")
def _() -> None:
    x, t = lorenz()
    grid = {
        "optimizer": [lacuna.Stlsq(threshold=0.01), lacuna.Stlsq(threshold=0.1)],
        "differentiation_method": ["smoothing-spline", "finite-differences"],
        "degree": [1, 2],
    }
    model = sindy(t_default=t[1] - t[0])
    search = RandomizedSearchCV(model, grid, cv=TimeSeriesSplit(3), n_iter=5, random_state=1)
    check_is_fitted(search.fit(x))


@task("test_pysindy: test_linear_constraints")
def _() -> None:
    x, t = lorenz()
    found = lacuna.identify(
        x, t, states=["x", "y", "z"], preset="sindy", degree=2, threads=1,
        constraints=["x: z = 1", "y: 1 = 0.3333333333333333"],
    )  # fmt: skip
    assert found.model.terms["x"]["z"] == pytest.approx(1, abs=1e-7)
    assert found.model.terms["y"]["1"] == pytest.approx(1 / 3, abs=1e-7)


@task("test_sindyc: test_simulate_with_vector_control_input")
def _() -> None:
    for count in (1, 2):
        x, t, u, _ = forced_lorenz(count)
        assert len(sindy().fit(x, u=u, t=t).simulate(x[0], t=t, u=u)) == len(t)


@task("test_sindyc: test_fit_discrete_time_multiple_trajectories")
def _() -> None:
    x, u = forced_logistic()
    model = sindy(discrete_time=True).fit([x[:60], x[60:]], u=[u[:60], u[60:]])
    check_is_fitted(model)


@task("test_sindyc: test_predict_discrete_time_multiple_trajectories")
def _() -> None:
    x, u = forced_logistic()
    records = [x[:60], x[60:]], [u[:60], u[60:]]
    predicted = sindy(discrete_time=True).fit(records[0], u=records[1]).predict(*records)
    assert len(predicted) == len(records[0])


@task("test_sindyc: test_score_discrete_time_multiple_trajectories")
def _() -> None:
    x, u = forced_logistic()
    xs, us = [x[:60], x[60:]], [u[:60], u[60:]]
    assert sindy(discrete_time=True).fit(xs, u=us).score(xs, u=us) > 0.75


@pytest.mark.parametrize("name", task)
def test_a_task_has_the_value_asserted_there(name: str) -> None:
    task[name]()
