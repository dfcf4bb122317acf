"""Tasks of PySINDy's tests of systems with inputs; see test_pysindy_tasks.py."""

from __future__ import annotations

import numpy as np
import pytest
from pysindy_records import Tasks, forced_logistic, forced_lorenz, line, sindy
from sklearn.exceptions import NotFittedError
from sklearn.utils.validation import check_is_fitted

import lacuna

pytestmark = pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")

task = Tasks()


@task("test_sindyc: test_get_feature_names_len")
def _() -> None:
    x, t, u, _ = forced_lorenz()
    trail = lacuna.identify(x, t, u, preset="sindy", degree=2, threads=1).trail
    assert len({row.term for row in trail}) == 15


@task("test_sindyc: test_not_fitted")
def _() -> None:
    x, t, u, function = forced_lorenz()
    with pytest.raises(NotFittedError):
        sindy().predict(x, u=u)
    with pytest.raises(NotFittedError):
        sindy().simulate(x[0], t=t, u=function)


@task("test_sindyc: test_improper_shape_input")
def _() -> None:
    x, t = line()
    u = np.ones_like(x)
    check_is_fitted(sindy().fit(x, u=u, t=t))
    check_is_fitted(sindy().fit(x, u=u.ravel(), t=t, x_dot=x.ravel()))
    with pytest.raises(ValueError):
        sindy().fit(x[:-1], u=u, t=t[:-1])


@task("test_sindyc: test_mixed_inputs")
def _() -> None:
    for count in (1, 2):
        x, t, u, _ = forced_lorenz(count)
        check_is_fitted(sindy().fit(x, u=u, t=2))
        check_is_fitted(sindy().fit(x, u=u, x_dot=x))
        check_is_fitted(sindy().fit(x, u=u, t=t, x_dot=x))


@task("test_sindyc: test_bad_control_input")
def _() -> None:
    x, t, u, _ = forced_lorenz()
    with pytest.raises((TypeError, ValueError)):
        sindy().fit(x, u=set(u.ravel()), t=t)


@task("test_sindyc: test_bad_t")
def _() -> None:
    x, t, u, _ = forced_lorenz()
    twice = np.array(t)
    twice[3] = twice[5]
    for bad in ("1", -1, t[:-1], twice):
        with pytest.raises(ValueError):
            sindy().fit(x, u=u, t=bad)


@task("test_sindyc: test_t_default")
def _() -> None:
    for count in (1, 2):
        x, t, u, _ = forced_lorenz(count)
        step = t[1] - t[0]
        given, usual = sindy().fit(x, u=u, t=step), sindy(t_default=step).fit(x, u=u)
        np.testing.assert_allclose(given.coefficients(), usual.coefficients())
        np.testing.assert_almost_equal(given.score(x, u=u, t=step), usual.score(x, u=u))


@task("test_sindyc: test_predict")
def _() -> None:
    for count in (1, 2):
        x, t, u, _ = forced_lorenz(count)
        for optimizer in ("stlsq", "sr3", "elastic-net", "ols"):
            model = sindy(optimizer=optimizer).fit(x, u=u, t=t)
            assert model.predict(x, u=u).shape == x.shape


@task("test_sindyc: test_simulate")
def _() -> None:
    for count in (1, 2):
        x, t, u, function = forced_lorenz(count)
        assert len(sindy().fit(x, u=u, t=t).simulate(x[0], t=t, u=function)) == len(t)


@task("test_sindyc: test_simulate_with_interp")
def _() -> None:
    x, t, u, _ = forced_lorenz()
    model = sindy().fit(x, u=u, t=t)
    run = model.simulate(x[0], t=t[:-1], u=lambda time: np.interp(time, t, u[:, 0]))
    assert len(run) == len(t) - 1


@task("test_sindyc: test_score")
def _() -> None:
    for count in (1, 2):
        x, t, u, _ = forced_lorenz(count)
        model = sindy().fit(x, u=u, t=t)
        assert model.score(x, u=u) <= 1
        assert model.score(x, u=u, t=t) <= 1
        assert model.score(x, u=u, x_dot=x) <= 1
        assert model.score(x, u=u, t=t, x_dot=x) <= 1


@task("test_sindyc: test_fit_multiple_trajectores")
def _() -> None:
    x, t, u, _ = forced_lorenz()
    parts = [slice(0, 400), slice(400, 1000)]
    xs, ts, us = [x[p] for p in parts], [t[p] for p in parts], [u[p] for p in parts]
    assert sindy().fit(xs, u=us, t=ts).score(xs, u=us, t=ts) > 0.8
    with pytest.raises(ValueError):
        sindy().fit(xs, u=us[0], t=ts)
    with pytest.raises(ValueError):
        sindy().fit(xs[0], u=us, t=ts[0])
    with pytest.raises(ValueError):
        sindy().fit(xs[:1], u=us, t=ts[:1])


@task("test_sindyc: test_predict_multiple_trajectories")
def _() -> None:
    x, t, u, _ = forced_lorenz()
    xs, ts, us = [x[:400], x[400:]], [t[:400], t[400:]], [u[:400], u[400:]]
    assert len(sindy().fit(xs, u=us, t=ts).predict(xs, u=us)) == len(xs)


@task("test_sindyc: test_score_multiple_trajectories")
def _() -> None:
    x, t, u, _ = forced_lorenz()
    xs, ts, us = [x[:400], x[400:]], [t[:400], t[400:]], [u[:400], u[400:]]
    model = sindy().fit(xs, u=us, t=ts)
    assert model.score(xs, u=us) <= 1
    assert model.score(xs, u=us, t=ts, x_dot=xs) <= 1


@task("test_sindyc: test_fit_discrete_time")
def _() -> None:
    x, u = forced_logistic()
    check_is_fitted(sindy(discrete_time=True).fit(x, u=u))


@task("test_sindyc: test_simulate_discrete_time")
def _() -> None:
    x, u = forced_logistic()
    assert len(sindy(discrete_time=True).fit(x, u=u).simulate(x[0], t=len(x), u=u)) == len(x)


@task("test_sindyc: test_predict_discrete_time")
def _() -> None:
    x, u = forced_logistic()
    model = sindy(discrete_time=True).fit(x, u=u)
    assert len(model.predict(x, u=u[:, None])) == len(x)


@task("test_sindyc: test_score_discrete_time")
def _() -> None:
    x, u = forced_logistic()
    model = sindy(discrete_time=True).fit(x, u=u)
    assert model.score(x, u=u[:, None]) > 0.75
    assert model.score(x, u=u[:, None], x_dot=x) < 1


@task("test_sindyc: test_simulate_errors")
def _() -> None:
    x, t, u, _ = forced_lorenz()
    with pytest.raises(ValueError):
        sindy().fit(x, u=u, t=t).simulate(x[0], t=1, u=u)


@task("test_sindyc: test_u_omitted")
def _() -> None:
    x, t, u, _ = forced_lorenz()
    model = sindy().fit(x, u=u, t=t)
    for call in (
        lambda: model.predict(x),
        lambda: model.score(x),
        lambda: model.simulate(x[0], t=t),
    ):
        with pytest.raises((TypeError, ValueError)):
            call()


@pytest.mark.parametrize("name", task)
def test_a_task_has_the_value_asserted_there(name: str) -> None:
    task[name]()
