"""The estimator keeps to the conventions of scikit-learn."""

from __future__ import annotations

import pickle
import warnings
from collections.abc import Callable

import numpy as np
import pytest
from sklearn import config_context
from sklearn.base import clone
from sklearn.model_selection import GridSearchCV, TimeSeriesSplit
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler
from sklearn.utils.estimator_checks import estimator_checks_generator

import lacuna
from lacuna.sklearn import ODERegressor

Samples = tuple[np.ndarray, np.ndarray]
pytestmark = pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")

# Checks that make no sense for equations of motion, with the reason.
SENSELESS = {
    "check_regressors_train": "wants a target that does not fit refused; the target is not used",
    "check_supervised_y_2d": "wants a warning about the target, which is not used",
    "check_supervised_y_no_nan": "wants a target that is not finite refused; it is not used",
    "check_array_api_input": "arrays are those of NumPy, whatever SciPy is set to",
}


@pytest.fixture
def fast() -> ODERegressor:
    return ODERegressor(preset="sindy", degree=1, t_default=20 / 399, threads=1)


CHECKS = list(estimator_checks_generator(ODERegressor(preset="sindy", degree=1, threads=1)))


@pytest.mark.parametrize(
    ("estimator", "check"),
    [
        pytest.param(estimator, check, id=check.func.__name__)
        for estimator, check in CHECKS
        if check.func.__name__ not in SENSELESS
    ],
)
def test_checks_of_scikit_learn(
    estimator: ODERegressor, check: Callable[[ODERegressor], None]
) -> None:
    check(estimator)


def test_checks_that_make_no_sense_are_checks() -> None:
    new = {"check_array_api_input"}  # since scikit-learn 1.8, which is for Python 3.11 and later
    assert SENSELESS.keys() - new <= {check.func.__name__ for _, check in CHECKS}


def test_the_equations_are_found(fast: ODERegressor, samples: Samples) -> None:
    t, x = samples
    fast.set_params(feature_names=["x", "v"]).fit(x, t=t)
    assert fast.n_features_in_ == 2
    assert fast.model_.terms["v"] == pytest.approx({"x": -4.01, "v": -0.2}, rel=0.02)
    assert fast.score(x, t=t) > 0.999
    np.testing.assert_allclose(fast.predict(x), fast.model_(0.0, x))
    run = fast.simulate(x[0], t)
    np.testing.assert_allclose(run, x, atol=0.05)
    assert fast.get_feature_names() == ["v", "x"]
    assert fast.coefficients().shape == (2, 2)
    assert len(fast.equations()) == 2


def test_times_in_the_place_of_the_target_are_noticed(fast: ODERegressor, samples: Samples) -> None:
    t, x = samples
    with pytest.warns(lacuna.LacunaWarning, match="given as t="):
        fast.fit(x, t)


def test_times_in_the_place_of_the_target_are_refused_where_no_step_is_known(
    samples: Samples,
) -> None:
    t, x = samples
    fit = ODERegressor(preset="sindy", degree=1)
    with pytest.raises(lacuna.ArgumentError, match=r"write fit\(X, t=t\)"):
        fit.fit(x, t)
    with pytest.raises(lacuna.ArgumentError, match=r"write score\(X, t=t\)"):
        fit.fit(x, t=t).score(x, t)


@pytest.mark.filterwarnings("always::lacuna.LacunaWarning")
def test_times_that_are_forgotten_after_a_fit_with_times_are_noticed(samples: Samples) -> None:
    t, x = samples
    fit = ODERegressor(preset="sindy", degree=1, threads=1).fit([x, x], t=[t, t])
    for method in (fit.score, fit.differentiate):
        with warnings.catch_warnings(record=True) as seen:
            warnings.simplefilter("always")
            method([x, x])
        assert [one.filename for one in seen] == [__file__]
        assert "no times, as fit had, and takes the step 1" in str(seen[0].message)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        fit.predict(x)
        fit.score(x, t=t)
        fit.score(x, x_dot=x)
        fit.differentiate(x, t)
        fit.set_params(t_default=20 / 399).score(x)


def test_times_go_through_a_search(samples: Samples) -> None:
    t, x = samples
    with config_context(enable_metadata_routing=True):
        fit = ODERegressor(preset="sindy", threads=1)
        fit.set_fit_request(t=True).set_score_request(t=True)
        search = GridSearchCV(fit, {"degree": [1, 2]}, cv=TimeSeriesSplit(3)).fit(x, t=t)
    assert search.best_score_ > 0.99


def test_an_input_that_is_forgotten_is_named(fast: ODERegressor) -> None:
    t = np.arange(0, 10, 0.02)
    u = np.sin(1.7 * t)
    truth = lacuna.Model.from_text("input force\ndx/dt = -2*x + 3*force")
    x = lacuna.simulate(truth, [1.0], t, inputs=u).x
    fit = fast.set_params(feature_names=["x", "force"]).fit(x, t=t, u=u)
    calls: list[Callable[[], object]] = [
        lambda: fit.predict(x),
        lambda: fit.score(x, t=t),
        lambda: fit.simulate(x[0], t),
        lambda: fit.model_(t, x),
        lambda: fit.model_.jacobian(t, x),
    ]
    for call in calls:
        with pytest.raises(lacuna.ArgumentError, match="the model has the input force; give u="):
            call()
    with pytest.raises(lacuna.ArgumentError, match="'force' names a column, but there is no frame"):
        fit.simulate(x[0], t, u="force")
    np.testing.assert_array_equal(fit.model_(t, x, u), fit.model_(t, x, u[:, None]))


def test_printed_equations_are_short(
    fast: ODERegressor, samples: Samples, capsys: pytest.CaptureFixture[str]
) -> None:
    t, x = samples
    fast.fit(x, t=t).print(precision=2)
    assert capsys.readouterr().out.startswith("dx0/dt = ")


def test_inputs_and_records_are_taken(fast: ODERegressor) -> None:
    t = np.arange(0, 10, 0.02)
    u = np.sin(t)
    truth = lacuna.Model.from_text("input u\ndx/dt = -2*x + 3*u")
    record = lacuna.Records({"t": t, "u": u}, "t")
    x = lacuna.simulate(truth, [1.0], t, inputs=record).x
    fast.fit([x[:250], x[250:]], t=[t[:250], t[250:]], u=[u[:250], u[250:]])
    assert fast.model_.terms["x0"] == pytest.approx({"x0": -2, "u0": 3}, rel=1e-3)
    np.testing.assert_allclose(fast.simulate(x[0], t, u[:, None]), x, atol=1e-3)
    assert fast.score(x, t=t, u=u[:, None]) > 0.999


def test_a_map_is_found() -> None:
    x = lacuna.simulate(lacuna.Model.from_text("x[n+1] = 3.7*x - 3.7*x^2"), [0.3], t_end=200).x
    fit = ODERegressor(degree=2, discrete_time=True).fit(x)
    assert fit.model_.terms["x0"] == pytest.approx({"x0": 3.7, "x0^2": -3.7}, rel=1e-6)
    assert fit.score(x) > 0.999999


def test_parameters_are_cloned_and_searched(fast: ODERegressor, samples: Samples) -> None:
    _, x = samples
    other = clone(fast.set_params(optimizer=lacuna.Stlsq(threshold=0.1)))
    assert other.get_params() == fast.get_params()
    search = GridSearchCV(
        fast, {"degree": [1, 2], "optimizer": [lacuna.Stlsq(), lacuna.Ols()]},
        cv=TimeSeriesSplit(3),
    )  # fmt: skip
    search.fit(x)
    assert search.best_score_ > 0.99
    assert search.best_estimator_.model_.states == ("x0", "x1")


def test_a_library_of_ones_own_is_cloned(fast: ODERegressor, samples: Samples) -> None:
    t, x = samples
    basis = lacuna.Basis(lambda states, inputs: [*states, *(f"sin({s})" for s in states)])
    fit = clone(fast.set_params(degree=None, feature_library=basis)).fit(x, t=t)
    assert fit.result_.pipeline.used.basis.type == "python-basis"


def test_it_stands_in_a_pipeline(fast: ODERegressor, samples: Samples) -> None:
    _, x = samples
    chain = make_pipeline(StandardScaler(), fast).fit(x)
    assert chain.score(x) > 0.99
    again = pickle.loads(pickle.dumps(chain))
    np.testing.assert_array_equal(again.predict(x), chain.predict(x))


def test_derivatives_are_those_of_the_method(fast: ODERegressor, samples: Samples) -> None:
    t, x = samples
    plain = fast.differentiate(x, t)
    assert np.abs(plain[5:-5, 0] - x[5:-5, 1]).max() < 0.01
    smooth = clone(fast).set_params(differentiation_method=lacuna.SavitzkyGolay())
    assert smooth.differentiate(x, t).shape == x.shape
