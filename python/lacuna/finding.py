"""From records to equations, to what a model lacks, to the numbers of a model."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping, Sequence
from typing import Any

from . import _lacuna
from .arguments import (
    ModelLike,
    Progress,
    Texts,
    assignments,
    bound,
    called,
    configuration,
    end_of,
    held_out_of,
    listed,
    model_arguments,
    several,
)
from .errors import LacunaWarning
from .own import Effect
from .records import held_out, records_of
from .results import Diagnosis, Fit, Identification
from .stages import Pipeline


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
    integrator: str = "rk4",
    options: Mapping[str, Any] | None = None,
    memory: int = 0,
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
        "set": assignments(options),
        **configuration(config, pipeline),
    }
    answer = called(_lacuna.identify, arguments, seed, threads, progress)
    for text in answer.warnings:
        warnings.warn(text, LacunaWarning, stacklevel=2)
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
    config, options, seed, threads, progress
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
    }
    return Diagnosis(
        called(_lacuna.diagnose, arguments, seed, threads, progress), "lacuna.diagnose"
    )


def fit(
    model: ModelLike,
    data: Any,
    t: Any = None,
    u: Any = None,
    *,
    holdout: Any = None,
    start_samples: int = 50,
    ahead: int = 10,
    restarts: int = 8,
    seed: int = 1,
    threads: int | None = None,
    progress: Progress = False,
    **columns: Any,
) -> Fit:
    """Estimate the numbers of a model of known structure, hidden states too.

    Parameters
    ----------
    model : Model or path
        The structure with numbers to start from.
    data, t, u, holdout, **columns
        As of `diagnose`.
    start_samples : int, optional
        First samples of a held-out record, which give its initial state.
    ahead : int, optional
        Samples ahead of the error of prediction.
    restarts : int, optional
        Other starts, at most, where residuals stay above the noise.
    seed, threads, progress
        As of `identify`.

    Returns
    -------
    Fit
        ``.model`` with estimates, ``.parameters`` with intervals, ``.fit`` by channel, ...

    Raises
    ------
    DataError, ConfigError, ModelError, ArgumentError, FileError
        With ``.where``, ``.problem`` and ``.remedy``.
    """
    arguments = {
        **model_arguments(model),
        **bound(model, data, t, u, columns),
        **held_out_of(model, holdout, columns),
        "start_samples": start_samples,
        "ahead": ahead,
        "restarts": restarts,
    }
    return Fit(called(_lacuna.fit, arguments, seed, threads, progress), "lacuna.fit")
