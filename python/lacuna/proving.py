"""What a model does, compared with records; records, models and parts by themselves."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from . import _lacuna
from .arguments import (
    ModelLike,
    Progress,
    as_model,
    bound,
    called,
    input_arguments,
    model_arguments,
)
from .errors import NoAnswerError, warn
from .frames import flat, in_order, row_labels, seconds_since
from .model import Model
from .records import records_of
from .results import Check, Comparison, Simulation, Sync
from .wording import in_python


def sync(
    model: ModelLike,
    data: Any,
    t: Any = None,
    u: Any = None,
    *,
    coupling: Mapping[str, float] | None = None,
    integrator: str = "auto",
    differentiator: str = "finite-differences",
    threads: int | None = None,
    progress: Progress = False,
    **columns: Any,
) -> Sync:
    """Drive a model with a record and measure how far from it the model stays.

    Parameters
    ----------
    model, data, t, u, **columns
        As of `diagnose`.
    coupling : dict, optional
        Strength by state, in 1/time unit; all states by the record's own time scale unless given.
    integrator, differentiator : str, optional
        Methods by name.
    threads, progress
        As of `identify`.

    Returns
    -------
    Sync
        ``.median``, ``.relative``, ``.holds``, ``.sentence``, ...

    Raises
    ------
    DataError, ConfigError, ModelError, ArgumentError, FileError
        With ``.where``, ``.problem`` and ``.remedy``.
    """
    arguments = {
        **model_arguments(model),
        **bound(model, data, t, u, columns),
        "coupling": ",".join(f"{name}={float(k)!r}" for name, k in (coupling or {}).items()),
        "integrator": integrator,
        "differentiator": differentiator,
    }
    return Sync(called(_lacuna.sync, arguments, 1, threads, progress), "lacuna.sync")


def simulate(
    model: ModelLike,
    x0: Any = None,
    t: Any = None,
    *,
    t_start: float | None = None,
    t_end: float | None = None,
    dt: float | None = None,
    inputs: Any = None,
    noise: Mapping[str, float] | None = None,
    hold: Mapping[str, str] | None = None,
    integrator: str = "auto",
    seed: int = 1,
    progress: Progress = False,
) -> Simulation:
    """Solve a model from a given start.

    Parameters
    ----------
    model : Model or path
        The model.
    x0 : array of shape (m,), series or mapping, optional
        Start, in the order of the model or with the names of its states; what the model has as
        ``initial`` unless given.
    t : array of shape (n,), optional
        Times of the output, in the model's unit; in place of ``t_start``, ``t_end``, ``dt``.
        Dates are seconds from the first one of the inputs, else from their own.
    t_start, t_end, dt : float, optional
        First and last time and step of the output. Unless given the first is that of the
        model's initial values, else that of the inputs, else 0; the others are those of the
        inputs.
    inputs : Records, path, frame or array of shape (n, p), optional
        A record with a column for each input of the model; of an array, and of a frame without
        times, the rows are at the times ``t``.
    noise : dict, optional
        Standard deviation of white noise that is added, by state or output.
    hold : dict, optional
        How inputs go on after a sample: ``{"u": "zero"}``.
    integrator : str, optional
        Method, see ``list_parts("integrator")``.
    seed, progress
        As of `identify`.

    Returns
    -------
    Simulation
        ``.t``, ``.x``, ``.names``; the rows of ``.to_frame()`` have the labels of ``t`` or of the
        inputs, where these are an index or a frame of pandas.

    Raises
    ------
    NoAnswerError
        The model has no finite solution as long as that.
    DataError, ConfigError, ModelError, ArgumentError, FileError
        With ``.where``, ``.problem`` and ``.remedy``.
    """
    times = None if t is None else seconds_since(inputs, t)
    start = None if x0 is None else in_order(x0, as_model(model).states)
    arguments = {
        **model_arguments(model),
        **({} if inputs is None else input_arguments(model, inputs, times)),
        "x0": "" if start is None else ",".join(repr(float(value)) for value in flat(start)),
        "t_start": None if t_start is None else float(t_start),
        "t_end": None if t_end is None else float(t_end),
        "dt": dt,
        "times": None if times is None else times.tolist(),
        "noise": [f"{name}={float(sd)!r}" for name, sd in (noise or {}).items()],
        "integrator": integrator,
    }
    arguments["holds"] = [f"{name}={value}" for name, value in (hold or {}).items()]
    orbit = called(_lacuna.simulate, arguments, seed, None, progress)
    if orbit.problem:
        raise NoAnswerError("simulate", orbit.problem, "end earlier or start elsewhere")
    warn(*map(in_python, orbit.notes))
    return Simulation(orbit, row_labels(t, inputs, len(orbit.time)))


def compare(
    first: Any,
    data: Any,
    t: Any = None,
    u: Any = None,
    *,
    integrator: str = "auto",
    differentiator: str = "finite-differences",
    progress: Progress = False,
    **columns: Any,
) -> Comparison:
    """Compare a model with a record, or two records, as orbits of an attractor.

    Parameters
    ----------
    first : Model, path or like data
        The model (a path that ends in ``.ode`` or ``.json``), or a record of the same columns.
    data, t, u, **columns
        The other record, as of `identify`.
    integrator, differentiator : str, optional
        Methods by name.
    progress
        As of `identify`.

    Returns
    -------
    Comparison
        ``.measures``, each of both with its interval, ``.agree``.

    Raises
    ------
    NoAnswerError
        The model has no orbit as long as the record.
    DataError, ConfigError, ModelError, ArgumentError, FileError
        With ``.where``, ``.problem`` and ``.remedy``.
    """
    is_model = isinstance(first, Model | str | os.PathLike)
    arguments = {
        **(
            bound(first, data, t, u, columns)
            if is_model
            else records_of(data, t, u, None, columns).arguments()
        ),
        **(
            model_arguments(first)
            if is_model
            else records_of(first, t, u, None, columns).sources("first_paths", "first_tables")
        ),
        "integrator": integrator,
        "differentiator": differentiator,
    }
    answer = called(_lacuna.compare, arguments, 1, None, progress)
    if answer.failure:
        raise NoAnswerError("compare", answer.failure, "shorten the record or mend the model")
    return Comparison(answer, "lacuna.compare")


def check(
    data: Any,
    t: Any = None,
    u: Any = None,
    *,
    model: ModelLike | None = None,
    differentiator: str = "finite-differences",
    **columns: Any,
) -> Check:
    """Show what would be read: columns, roles, step, noise, what is odd.

    Parameters
    ----------
    data, t, u, **columns
        The records, as of `identify`.
    model : Model or path, optional
        Says the roles; slips of units, signs and columns are looked for.
    differentiator : str, optional
        How states without a column are made.

    Returns
    -------
    Check
        ``.records``, ``.columns``, ``.hints``, ``.notes``.

    Raises
    ------
    DataError, ConfigError, ModelError, ArgumentError, FileError
        With ``.where``, ``.problem`` and ``.remedy``.
    """
    if model is None:
        arguments = records_of(data, t, u, None, columns).arguments()
    else:
        arguments = {**model_arguments(model), **bound(model, data, t, u, columns)}
    arguments["differentiator"] = differentiator
    return Check(called(_lacuna.check, arguments, 1, None, False), "lacuna.check")


def export(model: ModelLike, format: str) -> str:
    """Write a model as source text of another program.

    Parameters
    ----------
    model : Model or path
        The model.
    format : str
        c, cpp, latex, matlab, modelica, python, spice.

    Raises
    ------
    ConfigError, ModelError
        No such format; a model that the format has no way to write.
    """
    return as_model(model).export(format)


def list_parts(kind: str = "") -> str:
    """Every part by kind, with a sentence; of one kind where it is given.

    Raises
    ------
    ConfigError
        There is no such kind.
    """
    return _lacuna.list_parts(kind)


def describe(name: str) -> str:
    """The options of a part, a preset or a test system with units, ranges, defaults and source.

    Raises
    ------
    ConfigError
        Nothing has that name.
    """
    return _lacuna.describe(name)
