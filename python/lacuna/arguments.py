"""What functions are given, as the extension takes it."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from .errors import ArgumentError, Error
from .frames import has_names, is_list_of_records, is_numbered, is_path, says_time, with_columns
from .model import Model
from .own import Basis, Regressor
from .progress import progress_function
from .records import (
    Records,
    conditions,
    held_out,
    records_of,
)
from .stages import Pipeline, Stage
from .wording import reword

Texts = str | Sequence[str] | None
Progress = bool | Callable[[str, float], None]
ModelLike = Model | str | os.PathLike[str]
Rivalling = Sequence[ModelLike] | Mapping[str, ModelLike]


def called(
    function: Callable[[dict[str, Any]], Any],
    arguments: Mapping[str, Any],
    seed: int,
    threads: int | None,
    progress: Progress,
) -> Any:
    """Call the library with what is given; what is not has its default there."""
    given = {name: value for name, value in arguments.items() if value is not None}
    given["seed"] = seed
    given["threads"] = threads or os.cpu_count() or 1
    with progress_function(progress) as report:
        if report is not None:
            given["progress"] = report
        try:
            return function(given)
        except Error as error:
            reword(error, arguments)
            raise


def as_model(model: ModelLike) -> Model:
    """Give the model itself, or load it."""
    return model if isinstance(model, Model) else Model.load(model)


def model_arguments(model: ModelLike) -> dict[str, Any]:
    """A model, by its value or its path."""
    if isinstance(model, Model):
        return {"model": model._system, "model_path": "model"}
    return {"model_path": os.fspath(model)}


def named_models(models: Rivalling) -> list[tuple[str, ModelLike]]:
    """Several models with names: those of a dict, paths, or model 1, model 2, ..."""
    if isinstance(models, Mapping):
        return [(name, as_model(model)) for name, model in models.items()]
    return [
        (f"model {number}" if isinstance(model, Model) else os.fspath(model), model)
        for number, model in enumerate(models, 1)
    ]


def model_pairs(models: list[tuple[str, ModelLike]]) -> list[tuple[str, Any]]:
    """Several models as the extension takes them: name and value, or path and nothing."""
    return [(name, one._system if isinstance(one, Model) else None) for name, one in models]


def bound(model: Any, data: Any, t: Any, u: Any, columns: Mapping[str, Any]) -> dict[str, Any]:
    """Records whose columns are those of a model: arrays have its names unless others are given."""
    named = _with_names_of(model, data, columns)
    if u is not None and "names" not in columns and not isinstance(data, Records):
        named = {"inputs": as_model(model).inputs, **named}
    return records_of(data, t, u, None, named, has_model=True).arguments()


def held_out_of(model: Any, data: Any, columns: Mapping[str, Any]) -> dict[str, Any]:
    """Records that are held out, with the same columns."""
    return held_out(data, _with_names_of(model, data, columns))


def conditions_of(model: Any, data: Any, columns: Mapping[str, Any]) -> dict[str, Any]:
    """Conditions of runs to predict, with the same columns."""
    return conditions(data, _with_names_of(model, data, columns))


def _with_names_of(model: Any, data: Any, columns: Mapping[str, Any]) -> Mapping[str, Any]:
    if data is None or isinstance(data, Records):
        return columns
    one = with_columns(data[0] if is_list_of_records(data) and len(data) > 0 else data)
    if is_path(one) or (has_names(one) and not is_numbered(one)):
        return columns
    known = as_model(model)
    return {"states": known.states, "inputs": known.inputs, **columns}


def input_arguments(model: ModelLike, inputs: Any, t: Any) -> dict[str, Any]:
    """A record that drives a model: arrays are its inputs in their order, at times t."""
    if is_path(inputs) and inputs in as_model(model).inputs and not os.path.exists(inputs):
        raise ArgumentError(
            "inputs",
            f"'{inputs}' is the name of an input, not its values",
            "give a record with a column for each input of the model (Records, a path, a frame), "
            "or an array of shape (n, p) at the times t",
        )
    if isinstance(inputs, Records):
        records = inputs
    elif is_path(inputs) or says_time(inputs):
        records = Records(inputs)
    elif has_names(inputs) and not is_numbered(inputs):
        records = Records(inputs, t)
    else:
        records = Records(inputs, t, states=as_model(model).inputs)
    roles = records.arguments("input_paths", "input_tables")
    named = {"time": "input_time", "names": "names", "input_paths": "", "input_tables": ""}
    return {named[key] or key: value for key, value in roles.items() if key in named}


def configuration(
    config: str | os.PathLike[str] | Mapping[str, Any] | None, pipeline: Pipeline | None
) -> dict[str, Any]:
    """Where stages are said: a file or a dictionary, and a pipeline on top of it."""
    arguments: dict[str, Any] = {}
    said: dict[str, Any] = {}
    if isinstance(config, Mapping):
        said.update({key: _plain(value) for key, value in config.items()})
    elif config is not None:
        arguments["config"] = os.fspath(config)
    for place, stage in (pipeline.stages() if pipeline is not None else {}).items():
        if isinstance(stage, Basis | Regressor):
            arguments[f"own_{place}"] = [stage.written]
        else:
            said[place] = _plain(stage)
    if said:
        arguments["config_text"] = json.dumps(said)
    return arguments


def _plain(value: Any) -> Any:
    return value.to_dict() if isinstance(value, Stage) else value


def several(texts: Texts) -> list[str]:
    """Texts as a list: one alone is a list too."""
    return [texts] if isinstance(texts, str) else list(texts or [])


def listed(texts: Texts) -> str | None:
    """Texts as one, with commas between them."""
    return texts if texts is None or isinstance(texts, str) else ",".join(texts)


def assignments(options: Mapping[str, Any] | None) -> list[str]:
    """Single values by their paths, as the command takes them: ``PATH=VALUE``."""
    return [f"{path}={json.dumps(_plain(value))}" for path, value in (options or {}).items()]


def end_of(value: float | None) -> str:
    """An end of a range; empty where it is open."""
    return "" if value is None else repr(float(value))
