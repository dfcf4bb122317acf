"""Records: arrays, frames, data sets and files as what the library reads."""

from __future__ import annotations

import copyreg
import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from . import _lacuna
from .errors import ArgumentError, DataError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Column = NDArray[np.float64]

Names = str | Sequence[str] | None


class Records:
    """Records of one system, with the roles of their columns.

    Every function that takes data makes one of its arguments; make it yourself to use the same
    records again.

    Parameters
    ----------
    data : path, array, frame, series with a time as index, or a list of one of these
        Paths (or patterns such as ``"run*.csv"``) of files in any format that the command reads.
        Arrays of shape ``(n, m)``: n samples of m states; a list has one record in each. A pandas
        or polars frame, an xarray data set or a mapping has a name for each column. NaN, masked
        and missing values are gaps.
    t : array of shape (n,), float, list or str, optional
        Times, or the sampling step; in a list for each record. The name of the time column where
        columns have names. A datetime index is the time, in seconds from the first one.
    u : array of shape (n, p), optional
        Inputs beside an array of states, or a list.
    x_dot : array of shape (n, m), optional
        Measured derivatives of the states, or a list.
    states, inputs, derivatives : str or list of str, optional
        Columns of a frame or a file with this role; names for the columns of arrays.
    time_unit : str, optional
        Unit of the time: ``"ms"``.
    units : dict, optional
        Units of columns by name; those of ``attrs`` are taken by themselves.
    trajectory : str, optional
        Column that numbers the records in one file or frame.
    names : dict, optional
        Other names for columns: ``{"th": "Winkel"}`` calls the column ``Winkel`` ``th``.
    hold : dict, optional
        How inputs go on after a sample: ``{"u": "zero"}``; zero, linear, smooth, switching, auto.
    embed : dict, optional
        Only q is measured of a system of order N: ``{"q": N}``.
    source : str, optional
        What the record is called in messages and answers.

    Raises
    ------
    ArgumentError
        Arrays whose shapes do not fit.
    DataError
        A column that is not numbers.
    """

    def __init__(
        self,
        data: Any,
        t: Any = None,
        u: Any = None,
        x_dot: Any = None,
        *,
        states: Names = None,
        inputs: Names = None,
        derivatives: Names = None,
        time_unit: str | None = None,
        units: Mapping[str, str] | None = None,
        trajectory: str | None = None,
        names: Mapping[str, str] | None = None,
        hold: Mapping[str, str] | None = None,
        embed: Mapping[str, int] | None = None,
        source: str | None = None,
    ) -> None:
        self._roles: dict[str, Any] = {
            "time_unit": time_unit,
            "trajectory": trajectory,
            "states": _listed(states),
            "inputs": _listed(inputs),
            "derivatives": _listed(derivatives),
            "names": [f"{new}={old}" for new, old in (names or {}).items()],
            "holds": [f"{name}={value}" for name, value in (hold or {}).items()],
            "embed": [f"{name}={order}" for name, order in (embed or {}).items()],
        }
        self._paths: list[str] = []
        self._tables: list[_lacuna.Table] = []
        records = list(data) if _is_list_of_records(data) else [data]
        if t is None:
            records = [_with_coordinates(record) for record in records]
        if not records:
            raise ArgumentError("data", "there is no record", "give at least one")
        is_array = not any(isinstance(one, str | os.PathLike) or _has_names(one) for one in records)
        if not is_array and (u is not None or x_dot is not None):
            raise ArgumentError(
                "u, x_dot",
                "the records have columns with names",
                "say which they are: inputs=, derivatives=",
            )
        if all(isinstance(record, str | os.PathLike) for record in records):
            self._paths = [os.fspath(record) for record in records]
            self._take_time_name(t)
        elif all(_has_names(record) for record in records):
            self._take_frames(records, t, units or {}, source)
        else:
            self._take_arrays(records, t, u, x_dot, units or {}, source)

    def arguments(self, paths: str = "paths", tables: str = "tables") -> dict[str, Any]:
        """The records and the roles of their columns, as the extension takes them."""
        roles = {name: value for name, value in self._roles.items() if value not in (None, "", [])}
        return {**roles, **self.sources(paths, tables)}

    def sources(self, paths: str = "paths", tables: str = "tables") -> dict[str, Any]:
        """The records alone, under these names."""
        return {paths: self._paths} if self._paths else {tables: self._tables}

    def _take_time_name(self, t: Any) -> None:
        if isinstance(t, str):
            self._roles["time"] = t
        elif t is not None:
            self._roles["step"] = float(t)

    def _take_frames(
        self, frames: list[Any], t: Any, units: Mapping[str, str], source: str | None
    ) -> None:
        self._take_time_name(t)
        for number, frame in enumerate(frames):
            columns = {**(_time_index_of(frame) if t is None else {}), **_columns_of(frame)}
            self._tables.append(
                _table(_called(source or "frame", number, len(frames)), columns, units)
            )

    def _take_arrays(
        self,
        arrays: list[Any],
        t: Any,
        u: Any,
        x_dot: Any,
        units: Mapping[str, str],
        source: str | None,
    ) -> None:
        count = len(arrays)
        times, step = _times_of(t, count)
        if step is not None:
            self._roles["step"] = step
        for number, array in enumerate(arrays):
            place = _called(source or "array", number, count)
            blocks = {
                "states": _matrix(array, f"{place}: states"),
                "inputs": _matrix(_one_of(u, number, count, "u"), f"{place}: u"),
                "derivatives": _matrix(_one_of(x_dot, number, count, "x_dot"), f"{place}: x_dot"),
            }
            columns: dict[str, Any] = {} if times is None else {"t": times[number]}
            for role, first in (("states", "x"), ("inputs", "u"), ("derivatives", "d_x")):
                for name, values in self._named(role, first, blocks[role], place):
                    if name in columns:
                        raise ArgumentError(
                            place, f"two columns are called '{name}'", "give each its own name"
                        )
                    columns[name] = values
            if times is not None:
                self._roles["time"] = "t"
            self._tables.append(_table(place, columns, units))

    def _named(self, role: str, first: str, block: Any, place: str) -> list[tuple[str, Any]]:
        """Columns of a block with the names that are given for them, or x0, x1, ..."""
        if block is None:
            return []
        width = block.shape[1]
        given = self._roles[role]
        names = given.split(",") if given else [f"{first}{k}" for k in range(width)]
        if len(names) != width:
            raise ArgumentError(
                place, f"{len(names)} names for {width} {role}", "give a name for each column"
            )
        self._roles[role] = ",".join(names)
        return [(name, block[:, k]) for k, name in enumerate(names)]


def records_of(data: Any, t: Any, u: Any, x_dot: Any, columns: Mapping[str, Any]) -> Records:
    """The records themselves, or made of the arguments of a function."""
    if not isinstance(data, Records):
        return Records(data, t, u, x_dot, **columns)
    if t is not None or u is not None or x_dot is not None or columns:
        raise ArgumentError(
            "records", "they have times, inputs and roles already", "give them to Records()"
        )
    return data


def held_out(data: Any, columns: Mapping[str, Any]) -> dict[str, Any]:
    """Records that are held out, as the extension takes them: no, or with the same roles."""
    if data is None:
        return {}
    records = data if isinstance(data, Records) else Records(data, **columns)
    return records.sources("held_out_paths", "held_out_tables")


def conditions(data: Any, columns: Mapping[str, Any]) -> dict[str, Any]:
    """Conditions of runs to predict, as the extension takes them: none, or with the same roles."""
    if data is None:
        return {}
    records = data if isinstance(data, Records) else Records(data, **columns)
    return records.sources("condition_paths", "condition_tables")


def _listed(names: Names) -> str:
    return names if isinstance(names, str) else ",".join(names or ())


def _called(source: str, number: int, count: int) -> str:
    return source if count == 1 else f"{source} {number + 1}"


def _is_frame(data: Any) -> bool:
    return hasattr(data, "columns") and hasattr(data, "__getitem__")


def _is_xarray(data: Any) -> bool:
    return hasattr(data, "data_vars") and hasattr(data, "coords")


def _with_coordinates(data: Any) -> Any:
    """A series with an index, or an array of xarray, as the frame or data set of its columns."""
    if hasattr(data, "to_frame") and hasattr(data, "index") and not _is_frame(data):
        return data.to_frame("x" if data.name is None else data.name)
    if hasattr(data, "to_dataset") and not _is_xarray(data):
        if data.ndim == 2:
            return data.to_dataset(dim=data.dims[1])
        return data.to_dataset(name="x" if data.name is None else data.name)
    return data


def _has_names(data: Any) -> bool:
    return (
        isinstance(data, Mapping)
        or _is_frame(data)
        or _is_xarray(data)
        or getattr(getattr(data, "dtype", None), "names", None) is not None
    )


def _is_list_of_records(data: Any) -> bool:
    if not isinstance(data, list | tuple):
        return False
    return all(
        isinstance(one, str | os.PathLike) or _has_names(one) or hasattr(one, "__array__")
        for one in data
    )


def _columns_of(frame: Any) -> dict[str, Any]:
    """Columns of a frame by name, with the unit in square brackets."""
    if _is_xarray(frame):
        variables = {name: frame[name] for name in [*frame.coords, *frame.data_vars]}
        return {_header(name, one.attrs.get("units")): one for name, one in variables.items()}
    if isinstance(frame, Mapping):
        return {str(name): values for name, values in frame.items()}
    if not _is_frame(frame):
        return {name: frame[name] for name in frame.dtype.names}
    attributes = getattr(frame, "attrs", {})
    units = attributes.get("units", {}) if isinstance(attributes, Mapping) else {}
    return {_header(name, units.get(name)): frame[name] for name in frame.columns}


def _time_index_of(frame: Any) -> dict[str, Any]:
    """The index of a frame as a column, where it is a time: dates, or numbers with a name."""
    index = getattr(frame, "index", None)
    kind = getattr(getattr(index, "dtype", None), "kind", "")
    if kind in ("m", "M"):
        return {"t [s]": index}
    name = getattr(index, "name", None)
    return {name: index} if kind == "f" and isinstance(name, str) else {}


def _header(name: Any, unit: Any) -> str:
    return f"{name} [{unit}]" if unit else str(name)


def _column(values: Any, place: str) -> Column:
    """One column as float64; gaps are NaN, dates are seconds from the first one."""
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
        column = np.asarray(array, dtype=np.float64)
    except (TypeError, ValueError):
        raise DataError(place, "the values are not numbers", "leave the column out") from None
    if column.ndim != 1:
        raise DataError(place, f"it has {column.ndim} dimensions", "give one value for each sample")
    return column


def _seconds(times: NDArray[Any]) -> Column:
    import numpy as np

    if times.size == 0:
        return np.zeros(0)
    elapsed = times - times[0] if times.dtype.kind == "M" else times
    return np.asarray(elapsed / np.timedelta64(1, "s"), dtype=np.float64)


def _matrix(values: Any, place: str) -> Any:
    """An array of one column for each variable; none where there are none."""
    import numpy as np

    if values is None:
        return None
    array = values if isinstance(values, np.ma.MaskedArray) else np.asarray(values)
    if array.ndim == 1:
        array = array.reshape(-1, 1)
    if array.ndim != 2:
        raise ArgumentError(
            place, f"the array has {array.ndim} dimensions", "give samples x variables"
        )
    return array


def _one_of(values: Any, number: int, count: int, name: str) -> Any:
    """What belongs to one record: an element of a list, or all where there is one record."""
    if values is None or (count == 1 and not _is_list_of_records(values)):
        return values
    if not isinstance(values, list | tuple) or len(values) != count:
        raise ArgumentError(name, f"there are {count} records", "give a list with one for each")
    return values[number]


def _times_of(t: Any, count: int) -> tuple[list[Any] | None, float | None]:
    """Times of each record, or the step."""
    import numpy as np

    if t is None:
        raise ArgumentError("t", "arrays have no time", "give the times or the sampling step")
    if isinstance(t, str):
        raise ArgumentError("t", "arrays have no columns with names", "give the times themselves")
    if not isinstance(t, list | tuple):
        return (None, float(t)) if np.ndim(t) == 0 else ([t] * count, None)
    return [_one_of(t, number, count, "t") for number in range(count)], None


def _table(place: str, columns: Mapping[str, Any], units: Mapping[str, str]) -> _lacuna.Table:
    numbers = {name: _column(values, f"{place}: {name}") for name, values in columns.items()}
    lengths = {len(values) for values in numbers.values()}
    if len(lengths) != 1:
        raise ArgumentError(place, f"columns of {sorted(lengths)} values", "give one length")
    bare = [name.split(" [")[0] for name in numbers]
    table = _lacuna.Table(
        place, list(numbers), [units.get(name, "") for name in bare], lengths.pop()
    )
    for number, values in enumerate(numbers.values()):
        table.fill(number, values)
    return table


def _parts(table: _lacuna.Table) -> tuple[Any, ...]:
    """What a table is made again of, in another process."""
    import numpy as np

    headers = map(_header, table.headers, table.units)
    columns = np.asarray(table.values).T
    return _table, (table.source, dict(zip(headers, columns, strict=True)), {})


copyreg.pickle(_lacuna.Table, _parts)
