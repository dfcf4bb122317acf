"""Arrays of every layout, type and size are read as the same records."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import lacuna

Samples = tuple[np.ndarray, np.ndarray]


def described(*arguments: Any, **columns: Any) -> str:
    return lacuna.check(*arguments, **columns).to_json()


def test_layouts_do_not_matter(samples: Samples) -> None:
    t, x = samples
    plain = described(x, t)
    wide = np.zeros((2 * len(t), 6))
    wide[::2, 1:5:3] = x
    for other in (np.asfortranarray(x), wide[::2, 1:5:3], x[::-1][::-1], np.ma.array(x)):
        assert described(other, t) == plain
    assert described(x, t.tolist()) == plain
    assert described(x.tolist(), t) == plain
    backwards = np.ascontiguousarray(t[::-1])[::-1]
    assert described(x, backwards) == plain


def test_types_that_hold_the_values_do_not_matter(samples: Samples) -> None:
    t, x = samples
    single = x.astype(np.float32)
    assert described(single, t) == described(single.astype(np.float64), t)
    counts = np.rint(100 * x)
    for kind in (np.int16, np.int64, ">f8", np.longdouble):
        assert described(counts.astype(kind), t) == described(counts, t)


def test_names_units_and_roles_are_taken(samples: Samples) -> None:
    t, x = samples
    summary = lacuna.check(
        x, t, np.cos(t), states=["q", "w"], inputs="force", units={"q": "m", "t": "ms"}
    )
    assert [(c.name, c.unit, c.role) for c in summary.columns] == [
        ("q", "m", "state"), ("w", "", "state"), ("force", "", "input"),
    ]  # fmt: skip
    assert summary.time_unit == "ms"


def test_names_are_given_once(samples: Samples) -> None:
    t, x = samples
    for names in (["x", "x"], ["x", "t"], ["x"]):
        with pytest.raises(lacuna.ArgumentError, match=r"are called|names for"):
            lacuna.check(x, t, states=names)
    with pytest.raises(lacuna.ArgumentError, match="are called 'x'"):
        lacuna.check(x, t, np.cos(t), states=["x", "v"], inputs="x")


def test_a_step_is_as_good_as_times() -> None:
    x = np.sin(0.5 * np.arange(100))
    by_step = lacuna.check(x, 0.5)
    by_times = lacuna.check(x, 0.5 * np.arange(100))
    assert by_step.records == by_times.records


def test_a_list_has_a_record_in_each(samples: Samples) -> None:
    t, x = samples
    summary = lacuna.check([x[:100], x[100:]], [t[:100], t[100:]])
    assert [record.rows for record in summary.records] == [100, 300]
    assert len(lacuna.check([x[:100], x[:50]], 0.1).records) == 2
    with pytest.raises(lacuna.ArgumentError, match="2 records"):
        lacuna.check([x, x], t, [t])


def test_gaps_are_cut_or_marked(samples: Samples) -> None:
    t, x = samples
    gappy = x.copy()
    gappy[200, 0] = np.nan
    masked = np.ma.array(x, mask=np.isnan(gappy))
    assert described(gappy, t) == described(masked, t)
    assert [record.rows for record in lacuna.check(gappy, t).records] == [200, 199]
    model = lacuna.Model.from_terms({"x": {"v": 1.0}, "v": {"x": -4.0, "v": -0.2}})
    assert len(lacuna.check(gappy, t, model=model).records) == 1


def test_derivatives_come_with_the_samples(samples: Samples) -> None:
    t, x = samples
    rates = np.column_stack([x[:, 1], -4.01 * x[:, 0] - 0.2 * x[:, 1]])
    found = lacuna.identify(x, t, x_dot=rates, states=["x", "v"], preset="sindy", degree=1)
    assert found.model is not None
    assert found.model.terms["v"]["x"] == pytest.approx(-4.01, rel=1e-6)


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        ((np.zeros((5, 2, 2)), 0.1), "3 dimensions"),
        ((np.zeros((5, 2)),), "no time"),
        ((np.zeros((5, 2)), np.arange(4)), "values"),
        ((np.zeros((5, 2)), "t"), "no columns with names"),
        (([], 0.1), "no record"),
        (("run.csv", 0.1, np.zeros(9)), "columns have names"),
        (({"x": np.zeros(9)}, 0.1, np.zeros(8)), "values"),
        ((np.zeros((5, 2)) * 1j, 0.1), "complex"),
        ((np.array([["a"], ["b"]]), 0.1), "not numbers"),
        ((np.zeros((0, 2)), 0.1), ""),
        ((np.zeros((1, 2)), 0.1), ""),
        ((np.full((9, 1), np.inf), 0.1), ""),
        ((np.zeros((9, 1)), np.zeros(9)), ""),
    ],
)
def test_what_cannot_be_used_is_said(arguments: tuple[Any, ...], problem: str) -> None:
    with pytest.raises(lacuna.Error, match=problem or None) as raised:
        lacuna.check(*arguments)
    assert isinstance(raised.value, ValueError)
    assert raised.value.where
    assert raised.value.remedy


@pytest.mark.parametrize(
    "option", [{"degree": "2"}, {"degree": 2.5}, {"discrete": "yes"}, {"terms": [1]}, {"seed": -1}]
)
def test_an_option_of_a_wrong_type_is_named(samples: Samples, option: dict[str, Any]) -> None:
    t, x = samples
    with pytest.raises((TypeError, ValueError)) as raised:
        lacuna.identify(x, t, **option)
    if not isinstance(raised.value, TypeError):
        assert next(iter(option)) in str(raised.value)


finite = st.floats(-1e6, 1e6, width=32)
shapes = st.tuples(st.integers(0, 40), st.integers(1, 4))


@settings(max_examples=150, deadline=None)
@given(
    values=hnp.arrays(np.float64, shapes, elements=st.one_of(finite, st.just(np.nan))),
    order=st.sampled_from("CF"),
    stride=st.integers(1, 3),
)
def test_any_array_is_read_or_refused(values: np.ndarray, order: str, stride: int) -> None:
    """The same values are the same records, or the same error, however they lie in memory."""

    def outcome(array: np.ndarray) -> str:
        try:
            return described(array, 0.5)
        except lacuna.DataError as error:
            return str(error)

    spread = np.zeros((values.shape[0] * stride, values.shape[1]), order=order)  # type: ignore[call-overload]
    spread[::stride] = values
    assert outcome(spread[::stride]) == outcome(values)


def test_long_arrays_are_read() -> None:
    t = np.arange(300_000) * 0.01
    assert lacuna.check(np.sin(t), t).records[0].rows == 300_000
