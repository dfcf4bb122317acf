"""Frames, series, data sets and arrays as columns with names."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from . import _lacuna
from .errors import ArgumentError, DataError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Column = NDArray[np.float64]

Columns = list[tuple[str, Any]]


def is_path(data: Any) -> bool:
    """Whether a record is a file."""
    return isinstance(data, str | os.PathLike)


def is_frame(data: Any) -> bool:
    """Whether it is a frame: of pandas, polars or what behaves as they do."""
    return hasattr(data, "columns") and hasattr(data, "__getitem__")


def is_pandas(data: Any) -> bool:
    """Whether it is a frame of pandas."""
    return is_frame(data) and hasattr(data, "iloc")


def has_names(data: Any) -> bool:
    """Whether the columns of a record have names."""
    return (
        isinstance(data, Mapping)
        or is_frame(data)
        or _is_xarray(data)
        or getattr(getattr(data, "dtype", None), "names", None) is not None
    )


def is_list_of_records(data: Any) -> bool:
    """Whether a list has records in it, not rows."""
    if not isinstance(data, list | tuple):
        return False
    return all(is_path(one) or has_names(one) or getattr(one, "ndim", 0) > 0 for one in data)


def with_columns(data: Any) -> Any:
    """A series, or an array of xarray, as the frame or data set of its columns."""
    if hasattr(data, "to_frame") and hasattr(data, "dtype") and not is_frame(data):
        return data.to_frame(0) if data.name is None else data.to_frame()
    if hasattr(data, "to_dataset") and not _is_xarray(data):
        if data.ndim == 2:
            return data.to_dataset(dim=data.dims[1])
        return data.to_dataset(name="x" if data.name is None else data.name)
    return data


def is_numbered(frame: Any) -> bool:
    """Whether the columns of a frame have numbers, 0, 1, ..., in the place of names."""
    kind = getattr(getattr(getattr(frame, "columns", None), "dtype", None), "kind", "")
    return kind in ("i", "u")


def labels_of(frame: Any) -> list[Any]:
    """What the columns of a frame are called there, in the order of `columns_of`."""
    if _is_xarray(frame):
        return [*frame.coords, *frame.data_vars]
    if isinstance(frame, Mapping):
        return list(frame)
    return list(frame.columns if is_frame(frame) else frame.dtype.names)


def columns_of(frame: Any, place: str) -> Columns:
    """Columns of a frame by name, with the unit in square brackets; x0, x1, ... without names.

    Raises
    ------
    ArgumentError
        Two columns of one name.
    """
    labels = labels_of(frame)
    for label in labels:
        if labels.count(label) > 1:
            raise twice(place, label)
    units = _units_of(frame, labels)
    first = "x" if is_numbered(frame) else ""
    return [(header(f"{first}{label}", units.get(label)), frame[label]) for label in labels]


def twice(place: str, name: Any) -> ArgumentError:
    """Two columns of one name, as an error."""
    return ArgumentError(place, f"two columns are called '{name}'", "give each its own name")


def named_time(headers: list[str]) -> int | None:
    """The number of the column whose name says that it is the time, as in a file."""
    return _lacuna.time_column(headers) if headers else None


def time_of(frame: Any, headers: list[str], place: str) -> tuple[str, Any] | None:
    """Name and values of the time of a frame where no name of a column says it, else nothing.

    It is the index where that has dates, or numbers and a name of the time. Where no column has
    such a name, numbers with any name are the time too, and those with decimals; else the
    coordinate of an xarray data set, or the column of dates where there is one.

    Raises
    ------
    ArgumentError
        An index that is neither times nor numbers of rows, and no column for the time.
    """
    index: Any = getattr(frame, "index", None)
    kind = getattr(getattr(index, "dtype", None), "kind", "")
    name: Any = getattr(index, "name", None)
    if kind in ("m", "M"):
        return "t [s]", index
    is_called = isinstance(name, str) and name != ""
    if kind in ("f", "i", "u") and is_called and named_time([name]) is not None:
        return name, index
    if named_time(headers) is not None:
        return None
    if kind == "f" or (kind in ("i", "u") and is_called):
        return (name if is_called else "t"), index
    if times := _times_among(frame, headers):
        return times
    if kind not in ("", "f", "i", "u"):
        raise ArgumentError(
            place, "the index has no times", "make it dates or numbers, or name the time column: t="
        )
    return None


def says_time(record: Any) -> bool:
    """Whether a frame has a time, by its index or by the name of a column."""
    record = with_columns(record)
    if not has_names(record):
        return False
    headers = [name for name, _ in columns_of(record, "frame")]
    return time_of(record, headers, "frame") is not None or named_time(headers) is not None


def are_dates(values: Any) -> bool:
    """Whether values are dates or durations."""
    import numpy as np

    dtype = getattr(values, "dtype", None)
    kind = getattr(dtype, "kind", None) or np.asarray(values).dtype.kind
    return kind in ("m", "M")


def header(name: Any, unit: Any) -> str:
    """A name with its unit, as in the header of a file."""
    return f"{name} [{unit}]" if unit else str(name)


def bare(name: str) -> str:
    """A header without its unit, as the library reads it."""
    return str(_lacuna.Table("frame", [name], [""], 0).names[0]) if name else name


def column(values: Any, place: str) -> Column:
    """One column as float64; gaps are NaN, dates are seconds from the first one.

    Raises
    ------
    DataError
        What is not numbers.
    """
    import numpy as np

    if isinstance(values, np.ma.MaskedArray):
        masked: Any = values
        values = masked.astype(np.float64).filled(np.nan)
    kind = getattr(getattr(values, "dtype", None), "kind", "")
    if kind in ("m", "M"):
        return _seconds(np.asarray(values, dtype=f"{kind}8[ns]"))
    if not isinstance(values, np.ndarray) and hasattr(values, "to_numpy"):
        try:
            values = values.to_numpy(dtype="float64", na_value=np.nan)
        except (TypeError, ValueError, AttributeError):
            values = values.to_numpy()
    array = np.asarray(values)
    if array.dtype.kind in "mM":
        return _seconds(array)
    if array.dtype.kind == "c":
        raise DataError(place, "the values are complex", "give real and imaginary part as columns")
    try:
        numbers = np.asarray(array, dtype=np.float64)
    except (TypeError, ValueError):
        raise DataError(place, "the values are not numbers", "leave the column out") from None
    if numbers.ndim != 1:
        raise DataError(
            place, f"it has {numbers.ndim} dimensions", "give one value for each sample"
        )
    return numbers


def matrix(values: Any, place: str) -> Any:
    """An array of one column for each variable.

    Raises
    ------
    ArgumentError
        More than two dimensions.
    """
    import numpy as np

    array = values if isinstance(values, np.ma.MaskedArray) else np.asarray(values)
    if array.ndim == 1:
        array = array.reshape(-1, 1)
    if array.ndim != 2:
        raise ArgumentError(
            place, f"the array has {array.ndim} dimensions", "give samples x variables"
        )
    return array


def check_index(given: Any, record: Any, place: str) -> None:
    """Refuse rows that belong to others than those of the record.

    Raises
    ------
    ArgumentError
        Both have an index of their own, and they differ.
    """
    indices = [getattr(frame, "index", None) for frame in (given, record)]
    if any(not hasattr(index, "equals") or hasattr(index, "step") for index in indices):
        return  # without an index, or with one of row numbers
    if not indices[0].equals(indices[1]):  # type: ignore[union-attr]
        raise ArgumentError(
            place, "its index is not that of the states", "align them: .reindex(x.index)"
        )


def columns_of_array(values: Any, place: str) -> list[Any]:
    """The columns of an array, or of a frame whose columns have numbers."""
    if is_numbered(values):
        return [values[label] for label in labels_of(values)]
    block = matrix(values, place)
    return [block[:, k] for k in range(block.shape[1])]


def in_order(values: Any, names: tuple[str, ...] | list[str]) -> Any:
    """Values of variables in the order of their names, where they have names; else as they are.

    Raises
    ------
    ArgumentError
        A variable that is not there.
    """
    import numpy as np

    is_series = hasattr(values, "to_frame") and hasattr(values, "to_dict")
    if not is_series and not has_names(values):
        return values
    labels = list(values.index) if is_series else labels_of(values)
    known = {bare(str(label)): label for label in labels} | {label: label for label in labels}
    if is_series:
        is_named = all(name in known for name in names)
        return np.array([values[known[name]] for name in names], float) if is_named else values
    if len(labels) == len(names) and not any(name in known for name in names):
        return np.asarray(values)  # names of another kind, or none: in their order
    lacking = [name for name in names if name not in known]
    if lacking:
        raise ArgumentError("names", f"there is no '{lacking[0]}'", f"give {', '.join(names)}")
    given = [values[known[name]] for name in names]
    return np.array(given, float) if np.ndim(given[0]) == 0 else np.column_stack(given)


def flat(values: Any) -> Any:
    """Values one after the other."""
    import numpy as np

    return np.ravel(np.asarray(values, dtype=np.float64))


def seconds_since(first: Any, times: Any) -> Column:
    """Times as numbers: dates in seconds from the first one of a frame, where that has dates."""
    index: Any = getattr(first, "index", None)
    kinds = [getattr(getattr(one, "dtype", None), "kind", "") for one in (index, times)]
    return column(times - index[0] if kinds == ["M", "M"] else times, "t")


def row_labels(times: Any, frame: Any, count: int) -> Any:
    """The index of pandas that rows at these times have, or that of a frame; else nothing."""
    is_index = hasattr(times, "get_indexer")
    index: Any = times if is_index else getattr(frame, "index", None) if times is None else None
    return index if hasattr(index, "get_indexer") and len(index) == count else None


def framed(values: Any, like: Any, columns: list[Any]) -> Any:
    """A result as a frame of pandas with the index of the argument, where that was one."""
    if not is_pandas(like):
        return values
    import pandas

    return pandas.DataFrame(values, index=like.index, columns=columns)


def _times_among(frame: Any, headers: list[str]) -> tuple[str, Any] | None:
    """The only coordinate of a data set, or the only column of dates, by its header."""
    labels = labels_of(frame)
    if _is_xarray(frame):
        found = [label for label in frame.coords if label in frame.dims]
    else:
        found = [label for label in labels if are_dates(frame[label])]
    return (headers[labels.index(found[0])], frame[found[0]]) if len(found) == 1 else None


def _is_xarray(data: Any) -> bool:
    return hasattr(data, "data_vars") and hasattr(data, "coords")


def _units_of(frame: Any, labels: list[Any]) -> Mapping[Any, Any]:
    if _is_xarray(frame):
        return {label: frame[label].attrs.get("units") for label in labels}
    attributes = getattr(frame, "attrs", {})
    units = attributes.get("units", {}) if isinstance(attributes, Mapping) else {}
    return units if isinstance(units, Mapping) else {}


def _seconds(times: NDArray[Any]) -> Column:
    import numpy as np

    if times.size == 0:
        return np.zeros(0)
    elapsed = times - times[0] if times.dtype.kind == "M" else times
    return np.asarray(elapsed / np.timedelta64(1, "s"), dtype=np.float64)
