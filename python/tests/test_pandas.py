"""Frames of pandas are read alike by every function, and come back where they were given."""

from __future__ import annotations

import pickle
import warnings
from typing import Any

import numpy as np
import pandas as pd
import pytest
from sklearn.linear_model import Lasso, LinearRegression

import lacuna
from lacuna.sklearn import ODERegressor

pytestmark = pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")

TANK = "input inflow\ndlevel/dt = -0.7*level + 1.3*inflow"


@pytest.fixture(scope="module")
def tank() -> pd.DataFrame:
    """A level and its inflow, with the time as index."""
    t = np.arange(0, 12, 0.02)
    index = pd.Index(t, name="t")
    inflow = pd.DataFrame({"inflow": np.sin(0.9 * t) + 0.4 * np.cos(2.3 * t)}, index=index)
    run = lacuna.simulate(lacuna.Model.from_text(TANK), [2.0], inputs=inflow)
    return pd.DataFrame({"level": run["level"], "inflow": inflow["inflow"]}, index=index)


def as_given(frame: pd.DataFrame, how: str) -> pd.DataFrame:
    """The same record with its time elsewhere."""
    t = frame.index.to_numpy()
    if how == "index":
        return frame
    if how == "index without a name":
        return frame.set_axis(t, axis=0)
    if how == "index called otherwise":
        return frame.rename_axis("Zeit")
    if how == "column":
        return frame.reset_index()
    if how == "last column":
        return frame.assign(time=t)[[*frame.columns, "time"]].reset_index(drop=True)
    dates = pd.Timestamp("2026-05-01") + pd.to_timedelta(t, unit="s")
    if how == "dates":
        return frame.set_axis(dates, axis=0)
    assert how == "dates and column"
    return frame.assign(t=t).set_axis(dates, axis=0)


PLACES = [
    "index", "index without a name", "index called otherwise", "column", "last column", "dates",
    "dates and column",
]  # fmt: skip
TERMS = {"level": {"level": pytest.approx(-0.7, rel=1e-3), "inflow": pytest.approx(1.3, rel=1e-3)}}


@pytest.mark.parametrize("place", PLACES)
def test_the_time_is_found_by_every_function(tank: pd.DataFrame, place: str) -> None:
    frame = as_given(tank, place)
    options: dict[str, Any] = {"preset": "sindy", "degree": 1}
    assert lacuna.identify(frame, u="inflow", **options).model.terms == TERMS
    fit = ODERegressor(**options).fit(frame, u="inflow")
    assert fit.model_.terms == TERMS
    assert fit.score(frame) > 0.999
    assert fit.differentiate(frame)["level"].iloc[50] == pytest.approx(
        -0.7 * tank["level"].iloc[50] + 1.3 * tank["inflow"].iloc[50], rel=1e-3
    )
    model = "param k = 0.5 in 0..5\ninput inflow\ndlevel/dt = -k*level + 1.3*inflow"
    fitted = lacuna.fit(lacuna.Model.from_text(model), frame, restarts=0)
    assert fitted.model.parameters["k"] == pytest.approx(0.7, rel=1e-3)
    nominal = lacuna.Model.from_text("input inflow\ndlevel/dt = 1.3*inflow")
    lacks = lacuna.diagnose(nominal, frame, max_effects=1, effects=["linear-term"])
    assert lacks.model.terms["level"]["level"] == pytest.approx(-0.7, rel=1e-2)
    run = lacuna.simulate(lacuna.Model.from_text(TANK), [2.0], inputs=frame)
    np.testing.assert_allclose(run.x[:, 0], tank["level"], rtol=1e-6)


def test_times_beside_a_frame_are_taken(tank: pd.DataFrame) -> None:
    t = tank.index.to_numpy()
    frame = tank.reset_index()
    for times in (t, list(t), frame["t"], 0.02):
        fit = ODERegressor(preset="sindy", degree=1).fit(frame, t=times, u="inflow")
        assert fit.model_.terms == TERMS
        found = lacuna.identify(frame, times, inputs="inflow", preset="sindy", degree=1)
        assert found.model.terms == TERMS
    halves = [tank.iloc[:300], tank.iloc[300:]]
    fit = ODERegressor(preset="sindy", degree=1).fit(halves, u=["inflow"])
    assert fit.model_.terms == TERMS
    assert [len(rates) for rates in fit.predict(halves)] == [300, 300]
    assert fit.score(halves) > 0.999


def test_inputs_and_derivatives_keep_their_names(tank: pd.DataFrame) -> None:
    options: dict[str, Any] = {"preset": "sindy", "degree": 1}
    t, level, inflow = tank.index.to_numpy(), tank[["level"]], tank["inflow"]
    rates = pd.DataFrame({"level": -0.7 * tank["level"] + 1.3 * inflow})
    for u in (inflow, tank[["inflow"]]):
        assert ODERegressor(**options).fit(level, u=u, x_dot=rates).model_.terms == TERMS
        assert lacuna.identify(level, u=u, **options).model.terms == TERMS
        of_arrays = lacuna.identify(level.to_numpy(), t, u, states="level", **options)
        assert of_arrays.model.terms == TERMS
    named = ODERegressor(feature_names=["level", "inflow"], **options)
    assert named.fit(level.to_numpy(), t=t, u=inflow.to_numpy()).model_.terms == TERMS
    other = ODERegressor(feature_names=["h"], **options).fit(level, u=inflow)
    assert other.model_.states == ("h",) and other.model_.inputs == ("inflow",)


def test_derivatives_belong_to_the_states_of_their_names() -> None:
    t = np.arange(0, 10, 0.05)
    x = pd.DataFrame({"a": np.cos(t), "b": np.exp(-t)}, index=pd.Index(t, name="t"))
    rates = pd.DataFrame({"b": -x["b"], "a": -np.sin(t)}, index=x.index)
    for record in (x, x.reset_index()):
        found = lacuna.identify(record, x_dot=rates, preset="sindy", terms=["b"])
        assert found.model.states == ("a", "b")
        assert found.model.terms["b"] == pytest.approx({"b": -1}, rel=1e-9)


def test_rows_of_other_times_are_refused(tank: pd.DataFrame) -> None:
    with pytest.raises(lacuna.ArgumentError, match="index is not that of the states"):
        lacuna.identify(tank[["level"]].iloc[1:], u=tank["inflow"].iloc[:-1])
    texts = tank.set_axis([f"row {k}" for k in range(len(tank))], axis=0)
    with pytest.raises(lacuna.ArgumentError, match="index has no times"):
        lacuna.identify(texts, inputs="inflow")
    with pytest.raises(lacuna.ArgumentError, match="two columns are called 'level'"):
        lacuna.identify(pd.concat([tank, tank[["level"]]], axis=1))


def test_a_frame_without_a_time_has_the_step_of_the_estimator(tank: pd.DataFrame) -> None:
    bare = tank.reset_index(drop=True)
    fit = ODERegressor(preset="sindy", degree=1, t_default=0.02).fit(bare, u="inflow")
    assert fit.model_.terms == TERMS
    counted = bare.assign(stand=np.arange(len(bare)) * 0.02)[["stand", "level"]]
    with pytest.warns(lacuna.LacunaWarning, match="t='stand' makes it the time"):
        ODERegressor(preset="sindy", degree=1, t_default=0.02).fit(counted)
    named = counted.assign(inflow=bare["inflow"])
    fit = ODERegressor(preset="sindy", degree=1).fit(named, t="stand", u="inflow")
    assert fit.model_.terms == TERMS
    assert fit.score(named) > 0.999
    assert list(fit.predict(named).columns) == ["level"]


def test_a_frame_without_a_time_gives_up_no_state() -> None:
    t = np.arange(0, 4, 0.02)
    frame = pd.DataFrame({"growth": np.exp(0.3 * t), "other": 2 * np.exp(-0.4 * t)})
    options: dict[str, Any] = {"preset": "sindy", "degree": 1}
    fit = ODERegressor(**options)
    for of in (lacuna.identify, lacuna.check, fit.fit, fit.differentiate):
        with pytest.raises(lacuna.ArgumentError, match=r"frame has no time: .* give t="):
            of(frame)
    for given in (t, 0.02):
        assert lacuna.identify(frame, given, **options).model.states == ("growth", "other")
        fit.fit(frame, t=given)
        assert fit.model_.terms["growth"] == pytest.approx({"growth": 0.3}, rel=1e-3)
    assert fit.predict(frame).shape == frame.shape  # rates of a model need no times
    with pytest.raises(lacuna.ArgumentError, match="frame has no time"):
        fit.score(frame)
    assert ODERegressor(t_default=0.02, **options).fit(frame).score(frame) > 0.999
    steps = pd.DataFrame({"n": 1.5 * 0.9 ** np.arange(50)})
    assert ODERegressor(degree=1, discrete_time=True).fit(steps).model_.states == ("n",)


def test_a_column_of_dates_is_the_time_or_refused_by_its_name(tank: pd.DataFrame) -> None:
    dates = pd.Timestamp("2026-05-01") + pd.to_timedelta(tank.index, unit="s")
    dated = tank.assign(when=dates).reset_index(drop=True)
    options: dict[str, Any] = {"preset": "sindy", "degree": 1}
    for t in (None, "when"):
        fit = ODERegressor(**options).fit(dated, t=t, u="inflow")
        assert fit.model_.terms == TERMS
        assert fit.score(dated) > 0.999
        assert lacuna.identify(dated, t, u="inflow", **options).model.terms == TERMS
    timed = dated.assign(t=tank.index)
    for of in (lacuna.identify, ODERegressor().fit):
        with pytest.raises(lacuna.DataError, match=r"when: it has dates.* t='when' makes it"):
            of(timed, u="inflow")


def test_inputs_are_those_of_their_names() -> None:
    t = np.arange(0, 8, 0.02)
    index = pd.Index(t, name="t")
    both = pd.DataFrame({"force": np.sin(1.3 * t), "wind": np.cos(0.7 * t)}, index=index)
    model = lacuna.Model.from_text("input force\ninput wind\ndy/dt = -y + 2*force - 3*wind")
    frame = both.assign(y=lacuna.simulate(model, [1.0], inputs=both)["y"])
    fit = ODERegressor(preset="sindy", degree=1).fit(frame, u=["force", "wind"])
    swapped = fit.predict(frame, u=["wind", "force"])
    pd.testing.assert_frame_equal(swapped, fit.predict(frame))
    assert fit.score(frame, u=["wind", "force"]) > 0.999
    with pytest.raises(lacuna.ArgumentError, match="inputs of the model are force, wind"):
        fit.predict(frame.assign(gust=0.0), u=["wind", "gust"])


def test_columns_may_be_named_with_their_units(tank: pd.DataFrame) -> None:
    frame = tank.rename(columns={"level": "level [m]", "inflow": "inflow [m/s]"})
    options: dict[str, Any] = {"preset": "sindy", "degree": 1}
    for name in ("inflow", "inflow [m/s]"):
        fit = ODERegressor(**options).fit(frame, u=name)
        assert fit.model_.terms == TERMS
        assert fit.score(frame) > 0.999
        assert fit.model_(0.0, frame, frame).shape == (len(frame), 1)
        found = lacuna.identify(frame, states="level [m]", inputs=name, **options)
        assert found.model.terms == TERMS
    for label in ("inflow[m/s]", "inflow (m/s)"):
        other = frame.rename(columns={"inflow [m/s]": label})
        assert ODERegressor(**options).fit(other, u=label).score(other, u=[label]) > 0.999
    clocked = frame.rename_axis("clock").reset_index().rename(columns={"clock": "clock [s]"})
    fit = ODERegressor(**options).fit(clocked, t="clock [s]", u="inflow [m/s]")
    assert fit.model_.terms == TERMS
    assert fit.score(clocked) > 0.999


def test_numbers_in_the_place_of_names_are_those_of_an_array(tank: pd.DataFrame) -> None:
    t = tank.index.to_numpy()
    frame = pd.DataFrame(tank.to_numpy(), index=t)
    assert lacuna.check(frame).columns == lacuna.check(tank.to_numpy(), t).columns
    with pytest.raises(lacuna.ArgumentError, match="no time"):
        lacuna.check(pd.DataFrame(tank.to_numpy()))


def test_a_frame_is_answered_by_a_frame(tank: pd.DataFrame) -> None:
    fit = ODERegressor(preset="sindy", degree=1).fit(tank, u="inflow")
    level = tank[["level"]]
    for rates in (fit.predict(tank), fit.predict(level, u=tank["inflow"]), fit.differentiate(tank)):
        assert isinstance(rates, pd.DataFrame)
        pd.testing.assert_index_equal(rates.index, tank.index)
        assert list(rates.columns) == ["level"]
    run = fit.simulate(tank.iloc[0], tank.index, u=tank["inflow"])
    pd.testing.assert_index_equal(run.index, tank.index)
    pd.testing.assert_frame_equal(run, level, atol=1e-3)
    plain = fit.simulate([2.0], tank.index.to_numpy(), u=tank["inflow"].to_numpy())
    assert isinstance(plain, np.ndarray)
    with pytest.warns(UserWarning, match="valid feature names"):  # as of any estimator
        assert isinstance(fit.predict(level.to_numpy(), u=tank["inflow"].to_numpy()), np.ndarray)


def test_dates_come_back_from_a_simulation(tank: pd.DataFrame) -> None:
    dated = as_given(tank, "dates")
    model = lacuna.Model.from_text(TANK)
    whole = lacuna.simulate(model, {"level": 2.0}, inputs=dated)
    pd.testing.assert_index_equal(whole.to_frame().index, dated.index)
    later = dated.index[100:200]
    part = lacuna.simulate(model, tank.iloc[100], later, inputs=dated)
    np.testing.assert_allclose(part.x[:, 0], tank["level"].iloc[100:200], rtol=1e-4)
    assert part.t[0] == pytest.approx(2.0)
    again = pickle.loads(pickle.dumps(part)).to_frame()
    pd.testing.assert_index_equal(again.index, later)


def test_a_model_takes_columns_by_their_names() -> None:
    model = lacuna.Model.from_text("dx/dt = v\ndv/dt = -4*x")
    frame = pd.DataFrame({"v": [1.0, 2.0], "other": [9.0, 9.0], "x": [3.0, 4.0]}, index=[7, 8])
    expected = pd.DataFrame({"x": [1.0, 2.0], "v": [-12.0, -16.0]}, index=[7, 8])
    pd.testing.assert_frame_equal(model(0.0, frame), expected)
    np.testing.assert_array_equal(model(0.0, frame.iloc[0]), [1.0, -12.0])
    with pytest.raises(lacuna.ArgumentError, match="there is no 'x'"):
        model(0.0, frame[["v", "other"]])


@pytest.mark.filterwarnings("always::lacuna.LacunaWarning")
def test_a_warning_names_the_line_of_the_user_once(tank: pd.DataFrame) -> None:
    odd = tank.assign(t=5.0)
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        ODERegressor(preset="sindy", degree=1).fit(odd, u="inflow")
        lacuna.identify(odd, u="inflow", preset="sindy", degree=1)
        lacuna.check(odd)
    assert len(seen) >= 2
    assert {one.filename for one in seen} == {__file__}
    lines = [(one.lineno, str(one.message)) for one in seen]
    assert len(set(lines)) == len(lines)


@pytest.mark.parametrize(
    ("optimizer", "use"),
    [
        (Lasso(), r"Lasso is no part of lacuna; use lacuna.ElasticNet\(mix=1.0\)"),
        (LinearRegression(), r"lacuna.Ols\(\)"),
        (object(), r"lacuna.Regressor\(function\)"),
        (lacuna.Stlsq, r"Stlsq is a class; give Stlsq\(\)"),
    ],
)
def test_parts_of_other_libraries_are_refused_with_what_to_use(
    tank: pd.DataFrame, optimizer: Any, use: str
) -> None:
    with pytest.raises(lacuna.ConfigError, match=use):
        ODERegressor(optimizer=optimizer).fit(tank)
    with pytest.raises(lacuna.ConfigError, match=use):
        lacuna.Pipeline(regressor=optimizer)


def test_what_to_use_is_there() -> None:
    from lacuna.stages import _INSTEAD

    for use in _INSTEAD.values():
        assert callable(getattr(lacuna, use.split("(")[0]))


def test_bases_are_added_and_multiplied(tank: pd.DataFrame) -> None:
    lines, waves = lacuna.Monomials(max_degree=1), lacuna.Fourier(harmonics=1)
    sums = lines + waves
    assert sums == lacuna.Sum(first=lines, second=waves)
    assert (lines * waves) == lacuna.Product(first=lines, second=waves)
    own = lacuna.Basis(lambda states, inputs: [f"abs({x})" for x in states])
    assert (lines + own).library(["x"]) == ["1", "x", "abs(x)"]
    assert (own + lines + own).library(["x"]) == ["abs(x)", "1", "x"]
    assert (lines * own).library(["x"]) == ["abs(x)", "x*abs(x)"]
    assert (lines + waves).library(["x"]) == ["1", "x", "sin(x)", "cos(x)"]
    fit = ODERegressor(preset="sindy", feature_library=lines + own).fit(tank, u="inflow")
    assert fit.model_.terms["level"]["level"] == pytest.approx(-0.7, rel=1e-2)
    with pytest.raises(TypeError):
        lines + "fourier"
