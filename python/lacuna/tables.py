"""Columns with their roles, and the tables of them that the extension reads."""

from __future__ import annotations

import copyreg
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from . import _lacuna
from .errors import ArgumentError, warn
from .frames import Columns, bare, column, header, named_time


@dataclass
class Part:
    """A column of a record: its role (none: found by its name), header, values, own label."""

    role: str
    header: str
    values: Any
    label: Any = None


def with_time(parts: list[Part], name: str, values: Any, place: str) -> list[Part]:
    """Columns with the time in front, and without the one that was called so."""
    import numpy as np

    times = column(values, f"{place}: {name}")
    named = named_time([part.header for part in parts if part.role == ""])
    kept = []
    for number, part in enumerate(parts):
        if part.role != "" or not (number == named or part.header == name):
            kept.append(part)
        elif not np.array_equal(column(part.values, f"{place}: {part.header}"), times):
            warn(f"{place}: column '{part.header}' is not used, as the time is given beside it")
    return [Part("time", name, values), *kept]


def free_names(parts: list[Part]) -> list[str]:
    """Names of the columns of a record that may be states."""
    unsaid = [part for part in parts if part.role == ""]
    named = named_time([part.header for part in unsaid])
    states = [part for part in parts if part.role == "states"]
    states += [part for number, part in enumerate(unsaid) if number != named]
    return [bare(part.header) for part in states]


def named_time_of(table: _lacuna.Table) -> int | None:
    """The number of the column whose name says that it is the time."""
    return named_time(list(map(header, table.headers, table.units)))


def table_of(place: str, columns: Columns, units: Mapping[str, str]) -> _lacuna.Table:
    """A table of columns; a unit that is given by name goes before that of a header.

    Raises
    ------
    ArgumentError
        Columns of different lengths.
    """
    numbers = [column(values, f"{place}: {name}") for name, values in columns]
    lengths = {len(values) for values in numbers}
    if len(lengths) != 1:
        raise ArgumentError(place, f"columns of {sorted(lengths)} values", "give one length")
    names = [name for name, _ in columns]
    table = _lacuna.Table(
        place, names, [units.get(bare(name), "") for name in names], lengths.pop()
    )
    for number, values in enumerate(numbers):
        table.fill(number, values)
    return table


def _parts(table: _lacuna.Table) -> tuple[Any, ...]:
    """What a table is made again of, in another process."""
    import numpy as np

    headers = map(header, table.headers, table.units)
    columns = np.asarray(table.values).T
    return table_of, (table.source, list(zip(headers, columns, strict=True)), {})


copyreg.pickle(_lacuna.Table, _parts)
