"""Frames, data sets and mappings are read as files with the same columns are."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import polars as pl
import pytest
import xarray as xr

import lacuna

pytestmark = pytest.mark.filterwarnings("ignore::lacuna.LacunaWarning")


@pytest.fixture
def frame(folder: Path) -> pd.DataFrame:
    return pd.read_csv(folder / "run.csv", float_precision="round_trip")


def test_a_frame_gives_the_answer_of_its_file(inside: Path, frame: pd.DataFrame) -> None:
    options: dict[str, Any] = {"inputs": "u", "preset": "sindy", "degree": 1}
    of_file = lacuna.identify("run.csv", **options)
    of_frame = lacuna.identify(frame, source="run.csv", **options)
    of_polars = lacuna.identify(pl.from_pandas(frame), source="run.csv", **options)
    assert of_frame.to_json() == of_file.to_json()
    assert of_polars.to_json() == of_file.to_json()
    assert of_frame.summary() == of_file.summary()


def test_a_model_finds_its_columns_in_a_frame(inside: Path, frame: pd.DataFrame) -> None:
    shuffled = frame[["u [N]", "v [m/s]", "t [s]", "x [m]"]]
    of_file = lacuna.fit("free.ode", "run.csv", restarts=0)
    of_frame = lacuna.fit("free.ode", shuffled, source="run.csv", restarts=0)
    assert of_frame.to_json() == of_file.to_json()
    renamed = frame.rename(columns={"x [m]": "Weg [m]"})
    assert (
        lacuna.fit("free.ode", renamed, source="run.csv", restarts=0, names={"x": "Weg"}).parameters
        == of_file.parameters
    )


def test_units_come_from_attributes(frame: pd.DataFrame) -> None:
    bare = frame.rename(columns=lambda name: name.split(" [")[0])
    bare.attrs["units"] = {"x": "m", "v": "m/s", "u": "N", "t": "s"}
    units = {c.name: c.unit for c in lacuna.check(bare, inputs="u").columns}
    assert units == {"x": "m", "v": "m/s", "u": "N"}
    data = xr.Dataset(
        {"x": ("t", bare["x"].to_numpy(), {"units": "mm"}), "v": ("t", bare["v"].to_numpy())},
        coords={"t": ("t", bare["t"].to_numpy(), {"units": "ms"})},
    )
    summary = lacuna.check(data)
    assert {c.name: c.unit for c in summary.columns} == {"x": "mm", "v": ""}
    assert summary.time_unit == "ms"


def test_dates_are_seconds_from_the_first() -> None:
    t = pd.date_range("2026-03-01", periods=50, freq="250ms")
    wave = np.sin(np.arange(50.0))
    by_index = lacuna.check(pd.DataFrame({"x": wave}, index=t))
    by_column = lacuna.check(pl.DataFrame({"t": t.to_numpy(), "x": wave}))
    elapsed = lacuna.check(pd.DataFrame({"x": wave}, index=t - t[0]))
    for summary in (by_index, by_column, elapsed):
        assert summary.records[0].begin == 0.0
        assert summary.records[0].step == pytest.approx(0.25)
    assert by_index.time_unit == "s"


def test_a_series_and_an_array_of_xarray_have_their_times() -> None:
    t, names = np.arange(50) * 0.25, ["x", "v"]
    wave = np.column_stack([np.sin(t), np.cos(t)])
    frame = lacuna.check(pd.DataFrame(wave, columns=names, index=pd.Index(t, name="t")))
    series = lacuna.check(pd.Series(wave[:, 0], index=pd.to_timedelta(t, unit="s")))
    array = xr.DataArray(wave, dims=("t", "state"), coords={"t": t, "state": names})
    assert lacuna.check(array).columns == frame.columns
    assert lacuna.check(array[:, 0].drop_vars("state").rename("x")).records == frame.records
    assert series.records == frame.records
    assert lacuna.check(pd.Series(wave[:, 0]), 0.25).records[0].step == 0.25


def test_missing_values_are_gaps() -> None:
    wave = np.sin(0.3 * np.arange(60.0))
    gappy = wave.copy()
    gappy[30] = np.nan
    lacks = [None if np.isnan(value) else value for value in gappy]
    plain = lacuna.check({"x": gappy}, 0.1)
    nullable = pd.DataFrame({"x": pd.array(lacks, dtype="Float64")})
    assert lacuna.check(nullable, 0.1).records == _named(plain.records)
    assert lacuna.check(pl.DataFrame({"x": lacks}), 0.1).records == _named(plain.records)
    assert len(plain.records) == 2


def _named(records: Any) -> Any:
    return records


def test_mappings_structures_and_several_frames_are_taken(frame: pd.DataFrame) -> None:
    fields = frame.to_records(index=False)
    assert len(lacuna.check(fields).columns) == 3
    summary = lacuna.check([frame, frame])
    assert [record.source for record in summary.records] == ["frame 1", "frame 2"]


def test_the_time_is_the_column_that_is_named(frame: pd.DataFrame) -> None:
    clock = frame.rename(columns={"t [s]": "clock [s]"})[["x [m]", "v [m/s]", "clock [s]"]]
    assert {c.name for c in lacuna.check(clock, "clock").columns} == {"x", "v"}


def test_words_in_a_column_are_refused() -> None:
    with pytest.raises(lacuna.DataError, match="label"):
        lacuna.check({"x": np.zeros(5), "label": list("abcde")}, 0.1)


def test_a_time_by_another_name_is_a_coordinate_or_a_column_of_dates() -> None:
    t, wave = np.arange(50) * 0.25, np.sin(np.arange(50.0))
    data = xr.Dataset({"x": ("clock", wave)}, coords={"clock": ("clock", t, {"units": "ms"})})
    assert [c.name for c in lacuna.check(data).columns] == ["x"]
    assert lacuna.check(data).time_unit == "ms"
    dates = pd.date_range("2026-03-01", periods=50, freq="250ms").to_numpy()
    for dated in ({"x": wave, "when": dates}, pl.DataFrame({"x": wave, "when": dates})):
        assert [c.name for c in lacuna.check(dated).columns] == ["x"]
        assert lacuna.check(dated).records[0].step == pytest.approx(0.25)
    for bare in ({"x": t, "v": wave}, pl.DataFrame({"x": t, "v": wave})):
        with pytest.raises(lacuna.ArgumentError, match="no time"):
            lacuna.check(bare)
