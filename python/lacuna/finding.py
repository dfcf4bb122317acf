"""From records to equations, to what a model lacks, to the numbers of a model."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, overload

from . import _lacuna
from .arguments import (
    ModelLike,
    Progress,
    Rivalling,
    Texts,
    assignments,
    bound,
    called,
    conditions_of,
    configuration,
    end_of,
    held_out_of,
    listed,
    model_arguments,
    model_pairs,
    named_models,
    several,
)
from .errors import ArgumentError, warn
from .model import Model
from .own import Effect
from .records import held_out, records_of
from .results import Diagnosis, Fit, Identification, Rivals
from .stages import Pipeline
from .wording import in_python


def identify(
    data: Any,
    t: Any = None,
    u: Any = None,
    *,
    x_dot: Any = None,
    holdout: Any = None,
    preset: str | None = None,
    pipeline: Pipeline | None = None,
    config: str | os.PathLike[str] | Mapping[str, Any] | None = None,
    degree: int | None = None,
    terms: Texts = None,
    add: Texts = None,
    equations: Mapping[str, Texts] | None = None,
    constraints: Texts = None,
    hidden: int | None = None,
    discrete: bool = False,
    integrator: str = "auto",
    options: Mapping[str, Any] | None = None,
    memory: int = 0,
    effort: str | None = None,
    time_limit: float | None = None,
    seed: int = 1,
    threads: int | None = None,
    progress: Progress = False,
    **columns: Any,
) -> Identification:
    """Find the equations of motion in measured data and verify them.

    Parameters
    ----------
    data, t, u, x_dot, **columns
        The records: paths, arrays of shape (n, m) with times and inputs, frames, or `Records`,
        whose description has every argument (``states=``, ``inputs=``, ``units=``, ...).
    holdout : like data, optional
        Records to judge the model by; without them a quarter of the samples, in blocks.
    preset : str, optional
        Composition of stages to start from: algorithm1 (default), paper, robust, sindy.
    pipeline : Pipeline, optional
        Stages that take the place of the preset's, also those written in Python.
    config : path or dict, optional
        JSON configuration that overrides the preset by stages.
    degree : int, optional
        Monomials up to this degree; 3 unless given.
    terms : list of str, optional
        Candidate terms outright: ``["sin(th)", "w", "u"]``.
    add : list of str, optional
        Terms beside those of the library.
    equations : dict, optional
        The terms of single equations: ``{"w": ["sin(th)", "w", "u"]}``.
    constraints : list of str, optional
        What coefficients satisfy: ``"w: sin(th) = -9.81"``, ``"y: x*z, z: x*y = 0"``,
        ``"energy-preserving"``.
    hidden : int, optional
        States that nobody measured: 1.
    discrete : bool, optional
        Find a map x[n+1] = f(x[n]) instead of a flow.
    integrator : str, optional
        Method of the verification.
    options : dict, optional
        Single values by their path: ``{"regressor.threshold": 0.05}``.
    memory : int, optional
        Bytes above which files are read in pieces; 0: never.
    effort : str, optional
        quick: only what an answer needs; normal (default): all stages, as far as something can be
        gained; full: all to their end.
    time_limit : float, optional
        Seconds after which the run ends with the answer that it has by then; ``.stages`` names
        what was left out.
    seed, threads : int, optional
        Start of everything random; threads (all cores unless given). Results do not depend on
        threads.
    progress : bool or function, optional
        Show a bar of tqdm, or call ``progress(activity, fraction)``.

    Returns
    -------
    Identification
        ``.model``, ``.verdict``, ``.trail``, ``.fit``, ...; coefficients in state unit per time
        unit and unit of the term.

    Raises
    ------
    DataError, ConfigError, ModelError, ArgumentError, FileError
        With ``.where``, ``.problem`` and ``.remedy``.

    Warns
    -----
    LacunaWarning
        What the answer warns of.
    """
    arguments = {
        **records_of(data, t, u, x_dot, columns).arguments(),
        **held_out(holdout, columns),
        "preset": preset,
        "degree": degree,
        "terms": listed(terms),
        "add": several(add),
        "equations": [f"{state}: {listed(given)}" for state, given in (equations or {}).items()],
        "constraints": several(constraints),
        "hidden": hidden,
        "discrete": discrete,
        "integrator": integrator,
        "memory": memory,
        "effort": effort,
        "time_limit": time_limit,
        "set": assignments(options),
        **configuration(config, pipeline),
    }
    answer = called(_lacuna.identify, arguments, seed, threads, progress)
    warn(*map(in_python, answer.warnings))
    return Identification(answer, "lacuna.identify")


def diagnose(
    model: ModelLike,
    data: Any,
    t: Any = None,
    u: Any = None,
    *,
    holdout: Any = None,
    effects: Texts | Sequence[str | Effect] = None,
    max_effects: int | None = None,
    limits: Mapping[str, tuple[float | None, float | None]] | None = None,
    tolerances: Texts = None,
    fill_gap: bool = False,
    differentiator: str = "finite-differences",
    config: str | os.PathLike[str] | None = None,
    options: Mapping[str, Any] | None = None,
    effort: str | None = None,
    time_limit: float | None = None,
    seed: int = 1,
    threads: int | None = None,
    progress: Progress = False,
    **columns: Any,
) -> Diagnosis:
    """Find what a nominal model lacks.

    Parameters
    ----------
    model : Model or path
        The nominal model.
    data, t, u, **columns
        The records, as of `identify`; the model says which columns are states and inputs, arrays
        have their columns in its order.
    holdout : like data, optional
        Records to gauge the gap on; the last quarter of the data unless given.
    effects : list of str or Effect, optional
        Try only these (see ``list_parts("effect")``); one written in Python is tried beside them.
    max_effects : int, optional
        Name at most so many.
    limits : dict, optional
        Ends of the range of a channel: ``{"q": (-5, 5)}``.
    tolerances : list of str, optional
        Standard deviations of nominal coefficients: ``"w:sin(th)=5%"``.
    fill_gap : bool, optional
        Fit a black-box function to what the effects leave.
    differentiator : str, optional
        How states without a column are made.
    config, options, effort, time_limit, seed, threads, progress
        As of `identify`; ``options={"decision.significance": 4}``.

    Returns
    -------
    Diagnosis
        ``.verdict``, ``.effects``, ``.gap``, ``.model`` (with what it lacked), ``.rivals``, ...

    Raises
    ------
    DataError, ConfigError, ModelError, ArgumentError, FileError
        With ``.where``, ``.problem`` and ``.remedy``.
    """
    chosen = [effects] if isinstance(effects, str) else list(effects or [])
    arguments = {
        **model_arguments(model),
        **bound(model, data, t, u, columns),
        **held_out_of(model, holdout, columns),
        "effects": [effect for effect in chosen if isinstance(effect, str)],
        "own_effects": [effect.written for effect in chosen if isinstance(effect, Effect)],
        "max_effects": max_effects,
        "limits": [
            f"{name}={end_of(low)}:{end_of(high)}" for name, (low, high) in (limits or {}).items()
        ],
        "tolerances": several(tolerances),
        "fill_gap": fill_gap,
        "differentiator": differentiator,
        "config": None if config is None else os.fspath(config),
        "set": assignments(options),
        "effort": effort,
        "time_limit": time_limit,
    }
    return Diagnosis(
        called(_lacuna.diagnose, arguments, seed, threads, progress), "lacuna.diagnose"
    )


@overload
def fit(model: ModelLike, data: Any, t: Any = None, u: Any = None, **arguments: Any) -> Fit: ...


@overload
def fit(model: Rivalling, data: Any, t: Any = None, u: Any = None, **arguments: Any) -> Rivals: ...


def fit(
    model: ModelLike | Rivalling,
    data: Any,
    t: Any = None,
    u: Any = None,
    *,
    holdout: Any = None,
    start_samples: int = 50,
    start_time: float | None = None,
    ahead: int = 10,
    restarts: int = 8,
    starts: int | None = None,
    profile: bool = False,
    bands: bool = False,
    predict: Any = None,
    effort: str | None = None,
    time_limit: float | None = None,
    seed: int = 1,
    threads: int | None = None,
    progress: Progress = False,
    **columns: Any,
) -> Fit | Rivals:
    """Estimate the numbers of a model of known structure, hidden states too.

    Parameters
    ----------
    model : Model or path, or a list or a dict of them
        The structure with numbers to start from. Several are fitted to the same records and
        compared; a dict has their names.
    data, t, u, holdout, **columns
        As of `diagnose`.
    start_samples : int, optional
        First samples of a held-out record, which give its initial state.
    start_time : float, optional
        Time at which records begin and initial values hold, before the first sample.
    ahead : int, optional
        Samples ahead of the error of prediction.
    restarts : int, optional
        Other starts, at most, where residuals stay above the noise.
    starts : int, optional
        Starts anywhere in the ranges of parameters, at most, wherever the first fit ends;
        None: 40 where a range is wide and residuals are above the noise.
    profile : bool, optional
        Profiles of the likelihood of every number, however long it takes.
    bands : bool, optional
        90 % bands of the free runs and of measured values, in ``.bands``.
    predict : like data, optional
        Times, inputs and initial values (in the first row) of runs to predict, in ``.predicted``.
    effort, time_limit, seed, threads, progress
        As of `identify`.

    Returns
    -------
    Fit
        ``.model`` with estimates, ``.parameters`` with intervals, ``.fit`` by channel, ...
    Rivals
        Of several models: ``.rivals``, the best first; ``.model`` is the best.

    Raises
    ------
    DataError, ConfigError, ModelError, ArgumentError, FileError
        With ``.where``, ``.problem`` and ``.remedy``.
    """
    rivals: list[tuple[str, ModelLike]] = []
    if isinstance(model, Model | str | os.PathLike):
        first: ModelLike = model
    else:
        rivals = named_models(model)
        if not rivals:
            raise ArgumentError("model", "there is no model", "give at least one")
        first = rivals[0][1]
    arguments = {
        **bound(first, data, t, u, columns),
        **held_out_of(first, holdout, columns),
        **conditions_of(first, predict, columns),
        "start_samples": start_samples,
        "start_time": start_time,
        "ahead": ahead,
        "restarts": restarts,
        "starts": starts,
        "profile": profile,
        "bands": bands,
        "effort": effort,
        "time_limit": time_limit,
    }
    if rivals:
        arguments["models"] = model_pairs(rivals)
        answer = called(_lacuna.fit_rivals, arguments, seed, threads, progress)
        return Rivals(answer, "lacuna.fit")
    arguments.update(model_arguments(first))
    return Fit(called(_lacuna.fit, arguments, seed, threads, progress), "lacuna.fit")
