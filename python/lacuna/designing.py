"""The next experiment, and parts of `identify` compared."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

from . import _lacuna
from .arguments import (
    ModelLike,
    Progress,
    Rivalling,
    assignments,
    bound,
    called,
    end_of,
    model_pairs,
    named_models,
)
from .model import Model
from .records import records_of
from .results import Bench, Plan, Result


def plan(
    models: ModelLike | Rivalling = (),
    data: Any = None,
    t: Any = None,
    u: Any = None,
    *,
    after: Result | str | os.PathLike[str] | None = None,
    inputs: Mapping[str, str | tuple[float, float]] | None = None,
    measure: Mapping[str, float] | None = None,
    start: Mapping[str, float | str | tuple[float, float]] | None = None,
    safe: Mapping[str, tuple[float | None, float | None]] | None = None,
    duration: float | None = None,
    sample: float | None = None,
    times: int | None = None,
    want: str | None = None,
    criterion: str | None = None,
    precision: str | None = None,
    parameters: Sequence[str] = (),
    options: Mapping[str, float] | None = None,
    seed: int = 1,
    threads: int | None = None,
    progress: Progress = False,
    **columns: Any,
) -> Plan:
    """Design the experiment that distinguishes models or determines parameters.

    Parameters
    ----------
    models : Model or path, or a list or a dict of them
        One whose parameters are to be determined, or rivals to be distinguished.
    data, t, u, **columns
        Records that are there already, as of `diagnose`: models are fitted to them first.
    after : Result or path, optional
        What `fit`, `diagnose` or `identify` gave: the models that it leaves possible.
    inputs : dict, optional
        What may be done with an input: a range, or text ``"-5..5, rate 100, hold 0.01, family
        steps|prbs, pieces 8"``.
    measure : dict, optional
        Standard deviation of the noise by channel (output or state).
    start : dict, optional
        Where a state begins: a value, a range in which it can be set, or ``"0 +- 0.1"``; as the
        model has it, else 0, unless given.
    safe : dict, optional
        Range that a state or an output must not leave; None is an open end.
    duration, sample : float, optional
        Time of a run and between two samples, in the model's unit.
    times : int, optional
        So many samples at times that are part of the plan.
    want : str, optional
        rivals, parameters or both.
    criterion : str, optional
        How rivals are compared: bayes-factor (default), box-hill, hunter-reiner.
    precision : str, optional
        What is made large of the information matrix: d (default), a, e, modified-e.
    parameters : list of str, optional
        Parameters that count, no others.
    options : dict, optional
        Numbers of the search: runs, draws, safety_draws, safe_probability, candidates, searches,
        evaluations, spread, decisive.
    seed, threads, progress
        As of `identify`.

    Returns
    -------
    Plan
        ``.input`` (times and values), ``.promise``, ``.safe``, ``.cost``; ``inputs()`` is text for
        a bench.

    Raises
    ------
    DataError, ConfigError, ModelError, ArgumentError, FileError
        With ``.where``, ``.problem`` and ``.remedy``.
    """
    given = named_models([models] if isinstance(models, Model | str | os.PathLike) else models)
    numbers = dict(options or {})
    unknown = numbers.keys() - _SEARCH
    if unknown:
        raise TypeError(f"unknown options: {', '.join(sorted(unknown))}; known: {_SEARCH}")
    arguments: dict[str, Any] = {
        **({} if data is None else _records(given, data, t, u, columns)),
        **numbers,
        "models": model_pairs(given),
        "plan_inputs": [f"{name}={_range(value)}" for name, value in (inputs or {}).items()],
        "channels": [f"{name}={float(sd)!r}" for name, sd in (measure or {}).items()],
        "starts": [f"{name}={_range(value)}" for name, value in (start or {}).items()],
        "safe": [f"{name}={_range(ends)}" for name, ends in (safe or {}).items()],
        "duration": duration,
        "sample": sample,
        "measurements": times,
        "want": want,
        "criterion": criterion,
        "precision": precision,
        "parameters": list(parameters),
    }
    if isinstance(after, Result):
        arguments["answer"] = after.to_json()
    elif after is not None:
        arguments["after"] = os.fspath(after)
    return Plan(called(_lacuna.plan, arguments, seed, threads, progress), "lacuna.plan")


_SEARCH = {
    "runs",
    "draws",
    "safety_draws",
    "safe_probability",
    "candidates",
    "searches",
    "evaluations",
    "spread",
    "decisive",
}


def _records(
    models: list[tuple[str, ModelLike]], data: Any, t: Any, u: Any, columns: Mapping[str, Any]
) -> dict[str, Any]:
    """Records with the columns of the first model; of an earlier answer as they are named."""
    if models:
        return bound(models[0][1], data, t, u, columns)
    return records_of(data, t, u, None, columns).arguments()


def _range(value: Any) -> str:
    """LOW..HIGH, a number, or text as it is."""
    if isinstance(value, str):
        return value
    if isinstance(value, tuple | list):
        low, high = value
        return f"{end_of(low)}..{end_of(high)}"
    return repr(float(value))


def bench(
    data: Any,
    t: Any = None,
    u: Any = None,
    *,
    parts: Mapping[str, str | Sequence[Any]],
    noise: Sequence[float] = (0.0,),
    draws: int = 1,
    samples: int = 2000,
    preset: str | None = None,
    config: str | os.PathLike[str] | None = None,
    degree: int | None = None,
    options: Mapping[str, Any] | None = None,
    seed: int = 1,
    threads: int | None = None,
    progress: Progress = False,
    **columns: Any,
) -> Bench:
    """Compare parts of `identify` on a record or on a test system, with noise added.

    Parameters
    ----------
    data, t, u, **columns
        The record, as of `identify`, or the name of a test system (``list_parts("system")``).
    parts : dict
        What differs, by kind: ``{"regressor": ["ols", "stlsq"], "filter": "all"}``, or numbers of
        the configuration: ``{"regressor.threshold": [0.05, 0.1]}``.
    noise : list of float, optional
        White noise to add, in percent of each state's standard deviation.
    draws : int, optional
        Noisy copies for each noise above 0.
    samples : int, optional
        Samples of a test system.
    preset, config, degree, options
        What all have, as of `identify`; without a refiner unless one is asked for.
    seed, threads, progress
        As of `identify`.

    Returns
    -------
    Bench
        ``.rows`` with ``to_frame()``: structure, error, terms, synchronisation and seconds.

    Raises
    ------
    DataError, ConfigError, ArgumentError, FileError
        With ``.where``, ``.problem`` and ``.remedy``.
    """
    arguments = {
        **records_of(data, t, u, None, columns).arguments(),
        "config": None if config is None else os.fspath(config),
        "parts": [
            f"{kind}={given if isinstance(given, str) else ','.join(map(str, given))}"
            for kind, given in parts.items()
        ],
        "noise": ",".join(repr(float(level)) for level in noise),
        "draws": draws,
        "samples": samples,
        "preset": preset,
        "degree": degree,
        "set": assignments(options),
    }
    return Bench(called(_lacuna.bench, arguments, seed, threads, progress), "lacuna.bench")
