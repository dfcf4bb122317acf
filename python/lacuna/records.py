"""Records: arrays, frames, data sets and files as what the library reads."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from . import _lacuna
from .errors import ArgumentError, DataError
from .frames import (
    are_dates,
    bare,
    check_index,
    columns_of,
    columns_of_array,
    has_names,
    is_list_of_records,
    is_numbered,
    is_path,
    labels_of,
    named_time,
    time_of,
    twice,
    with_columns,
)
from .tables import Part, free_names, named_time_of, table_of, with_time

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

Names = str | Sequence[str] | None


@dataclass
class Samples:
    """One record as arrays: times or the step, states (n x m), inputs, derivatives."""

    time: Array | float
    states: Array
    inputs: Array | None
    derivatives: Array | None


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
        columns have names. Unless given, an index of dates (in seconds from the first one) or of
        numbers with a name or with decimals is the time, else the column ``t`` or ``time``, else
        the only column of dates; of files, and of frames whose states are named, the first one.
    u : array of shape (n, p), frame, series, or names of columns, optional
        Inputs beside the states, or a list. Frames and series keep their names.
    x_dot : array of shape (n, m), frame, series, or names of columns, optional
        Measured derivatives of the states, or a list; columns called as the states are theirs.
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
        records = [with_columns(one) for one in (data if is_list_of_records(data) else [data])]
        named = [record for record in records if has_names(record)]
        self._written = {str(label) for record in named for label in labels_of(record)}
        self._roles: dict[str, Any] = {
            "time_unit": time_unit,
            "trajectory": self._bare(trajectory),
            "states": self._listed(states),
            "inputs": self._listed(inputs),
            "derivatives": self._listed(derivatives),
            "names": [f"{new}={self._bare(old)}" for new, old in (names or {}).items()],
            "holds": [f"{self._bare(name)}={value}" for name, value in (hold or {}).items()],
            "embed": [f"{self._bare(name)}={order}" for name, order in (embed or {}).items()],
        }
        t = self._bare(t)
        units = {self._bare(name): unit for name, unit in (units or {}).items()}
        self._paths: list[str] = []
        self._tables: list[_lacuna.Table] = []
        self._labels: list[dict[str, Any]] = []
        self._dates: list[set[str]] = []
        if not records:
            raise ArgumentError("data", "there is no record", "give at least one")
        u, x_dot = self._take_names("inputs", u), self._take_names("derivatives", x_dot)
        if all(is_path(record) for record in records):
            if u is not None or x_dot is not None:
                raise ArgumentError(
                    "u, x_dot",
                    "the records are files, whose columns have names",
                    "say which they are: inputs=, derivatives=",
                )
            self._paths = [os.fspath(record) for record in records]
            self._take_time_or_step(t)
        elif any(is_path(record) for record in records):
            raise ArgumentError("data", "files and arrays are mixed", "give files or arrays")
        else:
            self._take(records, t, u, x_dot, units, source)

    def arguments(self, paths: str = "paths", tables: str = "tables") -> dict[str, Any]:
        """The records and the roles of their columns, as the extension takes them."""
        roles = {name: value for name, value in self._roles.items() if value not in (None, "", [])}
        return {**roles, **self.sources(paths, tables)}

    def sources(self, paths: str = "paths", tables: str = "tables") -> dict[str, Any]:
        """The records alone, under these names."""
        return {paths: self._paths} if self._paths else {tables: self._tables}

    def state_labels(self, number: int) -> list[Any]:
        """What a frame calls the columns that are its states, in the order of the states."""
        return [self._labels[number][name] for name in self._states(number)]

    def call_states(self, names: Sequence[str]) -> None:
        """Give the states other names, in their order.

        Raises
        ------
        ArgumentError
            Another number of names than of states.
        """
        known = self._states(0)
        if len(names) != len(known):
            raise _unlike("names", len(names), len(known), "states")
        pairs = zip(names, known, strict=True)
        self._roles["names"] += [f"{new}={old}" for new, old in pairs if new != old]

    def check_free(self) -> None:
        """Refuse records of which a time would be taken for a state, or a state for the time.

        Raises
        ------
        ArgumentError
            A frame without a time, whose states no argument names.
        DataError
            A column of dates among the states.
        """
        is_said = self._named("states") or "step" in self._roles or "time" in self._roles
        for number, table in enumerate(self._tables):
            if not is_said and named_time_of(table) is None:
                raise ArgumentError(
                    "t",
                    f"{table.source} has no time: no index with times, no column called t or time",
                    "give t= (times, the step or the name of a column), or the time as its index",
                )
            for name in self._dates[number].intersection(self._states(number)):
                label = self._labels[number][name]
                raise DataError(
                    f"{table.source}: {label}",
                    "it has dates, and is not the time",
                    f"t='{label}' makes it the time; else leave the column out",
                )

    def samples(self) -> list[Samples]:
        """Arrays and frames as arrays, with a column for each name of a role."""
        import numpy as np

        found = []
        for number, table in enumerate(self._tables):
            values: Array = np.asarray(table.values)
            names = list(table.names)
            roles = [self._states(number), self._named("inputs"), self._named("derivatives")]
            states, inputs, derivatives = (
                values[:, [names.index(name) for name in role]] if role else None for role in roles
            )
            time = self._time_name(number)
            assert states is not None
            times = self._roles["step"] if time is None else values[:, names.index(time)]
            found.append(Samples(times, states, inputs, derivatives))
        return found

    def _bare(self, name: Any) -> Any:
        """The name of a column that is called as a frame has it, with its unit."""
        return bare(name) if isinstance(name, str) and name in self._written else name

    def _listed(self, names: Names) -> str:
        given = names.split(",") if isinstance(names, str) else names or ()
        return ",".join(self._bare(name) for name in given)

    def _take_names(self, role: str, given: Any) -> Any:
        """Names in the place of columns say which columns have the role."""
        names = [given] if isinstance(given, str) else given
        if not isinstance(names, list | tuple) or not names:
            return given
        if not all(isinstance(name, str) for name in names):
            return given
        self._roles[role] = self._listed(names)
        return None

    def _take_time_or_step(self, t: Any) -> None:
        if isinstance(t, str):
            self._roles["time"] = t
        elif t is not None:
            self._roles["step"] = float(t)

    def _take(
        self,
        records: list[Any],
        t: Any,
        u: Any,
        x_dot: Any,
        units: Mapping[str, str],
        source: str | None,
    ) -> None:
        count = len(records)
        times = _times_of(t, count)
        if times is None:
            self._take_time_or_step(t)
        for number, record in enumerate(records):
            place = _called(source or ("frame" if has_names(record) else "array"), number, count)
            parts = self._own(record, place)
            if times is not None:
                parts = with_time(parts, "t", times[number], place)
            elif index := self._index(record, t, parts, place):
                parts = with_time(parts, *index, place)
            elif t is None and parts[0].role == "states":
                raise ArgumentError("t", "arrays have no time", "give the times or the step")
            elif isinstance(t, str) and not has_names(record):
                raise ArgumentError("t", "arrays have no columns with names", "give the times")
            parts += self._beside("inputs", "u", _one_of(u, number, count, "u"), record, place)
            rates = _one_of(x_dot, number, count, "x_dot")
            taken = [self._roles["trajectory"], *self._named("inputs")]
            free = [name for name in free_names(parts) if name not in taken]
            states = self._named("states") or free
            parts += self._beside("derivatives", "d_x", rates, record, place, states)
            self._add(place, parts, units)

    def _own(self, record: Any, place: str) -> list[Part]:
        """The columns of a record; those of arrays, and of frames without names, are states."""
        if not has_names(record):
            return self._called("states", "x", columns_of_array(record, f"{place}: states"), place)
        labels = labels_of(record)
        if is_numbered(record):
            columns = [record[label] for label in labels]
            parts = self._called("states", "x", columns, place)
        else:
            parts = [Part("", *pair) for pair in columns_of(record, place)]
        for part, label in zip(parts, labels, strict=True):
            part.label = label
        return parts

    def _index(self, record: Any, t: Any, parts: list[Part], place: str) -> tuple[str, Any] | None:
        """Name and values of the index of a frame, where it is the time."""
        index = getattr(record, "index", None)
        if isinstance(t, str):
            is_meant = getattr(index, "name", None) == t and all(part.label != t for part in parts)
            return (t, index) if is_meant else None
        if t is not None or not has_names(record):
            return None
        return time_of(record, [part.header for part in parts], place)

    def _beside(
        self,
        role: str,
        first: str,
        given: Any,
        record: Any,
        place: str,
        states: Sequence[str] = (),
    ) -> list[Part]:
        """Columns that are given beside a record, with their own names where they have them."""
        place = f"{place}: {'u' if role == 'inputs' else 'x_dot'}"
        given = with_columns(given)
        if given is None:
            return []
        if not has_names(given) or is_numbered(given):
            return self._called(role, first, columns_of_array(given, place), place)
        check_index(given, record, place)
        columns = dict(columns_of(given, place))
        time = named_time(list(columns))
        if time is not None and bare(list(columns)[time]) not in self._named(role):
            del columns[list(columns)[time]]
        by_name = {bare(name): (name, values) for name, values in columns.items()}
        chosen = self._named(role) or list(states)
        if chosen and set(chosen) <= set(by_name):
            by_name = {name: by_name[name] for name in chosen}
        elif self._named(role):
            return self._called(role, first, list(columns.values()), place)
        if role == "derivatives":  # called as their states, whose units are others
            own = {name: f"d_{name}" if name in states else by_name[name][0] for name in by_name}
            return [Part(role, own[name], values) for name, (_, values) in by_name.items()]
        return [Part(role, name, values) for name, values in by_name.values()]

    def _called(self, role: str, first: str, columns: list[Any], place: str) -> list[Part]:
        """Columns with the names that are given for them, or x0, x1, ..."""
        names = self._named(role) or [f"{first}{k}" for k in range(len(columns))]
        if len(names) != len(columns):
            raise _unlike(place, len(names), len(columns), role)
        return [Part(role, name, values) for name, values in zip(names, columns, strict=True)]

    def _add(self, place: str, parts: list[Part], units: Mapping[str, str]) -> None:
        """Make the table of a record, and note which of its columns have which role."""
        headers = [part.header for part in parts]
        for name in headers:
            if headers.count(name) > 1:
                raise twice(place, name)
        table = table_of(place, [(part.header, part.values) for part in parts], units)
        names = list(table.names)
        for role in ("states", "inputs", "derivatives"):
            own = [name for name, part in zip(names, parts, strict=True) if part.role == role]
            if own:
                self._roles[role] = ",".join(own)
        if parts[0].role == "time" and named_time(headers) != 0:
            self._roles["time"] = names[0]
        self._tables.append(table)
        pairs = zip(names, parts, strict=True)
        self._labels.append({name: part.label for name, part in pairs})
        pairs = zip(names, parts, strict=True)
        self._dates.append({name for name, part in pairs if are_dates(part.values)})

    def _named(self, role: str) -> list[str]:
        """The names that a role has."""
        given = self._roles[role]
        return given.split(",") if given else []

    def _time_name(self, number: int) -> str | None:
        """The column of a record that is its time; none where the step is given."""
        if "step" in self._roles:
            return None
        table = self._tables[number]
        return self._roles.get("time") or table.names[named_time_of(table) or 0]

    def _states(self, number: int) -> list[str]:
        """Names of the columns of a record that are states."""
        table = self._tables[number]
        if self._named("states"):
            return self._named("states")
        time = self._time_name(number)
        unused = named_time_of(table) if time is None else None
        others = {
            time, self._roles["trajectory"], *self._named("inputs"), *self._named("derivatives")
        }  # fmt: skip
        return [name for k, name in enumerate(table.names) if name not in others and k != unused]


def records_of(
    data: Any,
    t: Any,
    u: Any,
    x_dot: Any,
    columns: Mapping[str, Any],
    has_model: bool = False,
) -> Records:
    """The records themselves, or made of the arguments of a function; a model names states."""
    if not isinstance(data, Records):
        records = Records(data, t, u, x_dot, **columns)
    elif t is not None or u is not None or x_dot is not None or columns:
        raise ArgumentError(
            "records", "they have times, inputs and roles already", "give them to Records()"
        )
    else:
        records = data
    if not has_model:
        records.check_free()
    return records


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


def _called(source: str, number: int, count: int) -> str:
    return source if count == 1 else f"{source} {number + 1}"


def _unlike(place: str, names: int, columns: int, role: str) -> ArgumentError:
    return ArgumentError(
        place, f"{names} names for {columns} {role}", "give a name for each column"
    )


def _one_of(values: Any, number: int, count: int, name: str) -> Any:
    """What belongs to one record: an element of a list, or all where there is one record."""
    if values is None or (count == 1 and not is_list_of_records(values)):
        return values
    if not isinstance(values, list | tuple) or len(values) != count:
        raise ArgumentError(name, f"there are {count} records", "give a list with one for each")
    return values[number]


def _times_of(t: Any, count: int) -> list[Any] | None:
    """Times of each record; nothing where the step, a name or nothing is given."""
    import numpy as np

    if isinstance(t, list | tuple):
        return [_one_of(t, number, count, "t") for number in range(count)]
    return None if t is None or isinstance(t, str) or np.ndim(t) == 0 else [t] * count
