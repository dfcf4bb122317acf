"""Registered parts as classes: ``Stlsq(threshold=0.1)``; pipelines of them."""

from __future__ import annotations

import json
import keyword
from collections.abc import Sequence
from typing import Any

from . import _lacuna
from .own import Basis, Composable, Regressor

# The places of a pipeline, by the kind of part that stands there.
_PLACES = ("basis", "formulation", "filter", "regressor", "pruner", "refiner")
_KINDS = (*_PLACES, "differentiator", "l1-solver")


class Stage(Composable):
    """A registered part with its options; each name of the registry is a class of its own.

    Options are keyword arguments; what is not given has its default. Values with the same options
    are equal.

    Raises
    ------
    ConfigError
        An unknown option, or a value out of its range (a `ValueError` too).
    """

    kind: str = ""
    name: str = ""

    def __init__(self, **options: Any) -> None:
        given = {key: _plain(value) for key, value in options.items()}
        self._options: dict[str, Any] = json.loads(
            _lacuna.checked_stage(self.kind, self.name, json.dumps(given))
        )

    def to_dict(self) -> dict[str, Any]:
        """Name as ``type`` and every option with its value."""
        return dict(self._options)

    def __getattr__(self, name: str) -> Any:
        options = self.__dict__.get("_options", {})
        if name in options:
            return options[name]
        raise AttributeError(f"{type(self).__name__} has no option '{name}'")

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self._options})

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Stage) and self.to_dict() == other.to_dict()

    def __hash__(self) -> int:
        return hash(json.dumps(self.to_dict(), sort_keys=True))

    def __reduce__(self) -> tuple[Any, ...]:
        options = {key: value for key, value in self._options.items() if key != "type"}
        return _made, (type(self).__name__, options)

    def __repr__(self) -> str:
        options = (f"{key}={value!r}" for key, value in self._options.items() if key != "type")
        return f"{type(self).__name__}({', '.join(options)})"


class BasisStage(Stage):
    """A registered basis; ``a + b`` has the terms of both, ``a * b`` their products."""

    def library(self, states: Sequence[str], inputs: Sequence[str] = ()) -> list[str]:
        """Names of the terms for these variables."""
        return _lacuna.library(self.name, json.dumps(self._options), list(states), list(inputs))


# What does the work of parts of scikit-learn and PySINDy, by the names of their classes.
_INSTEAD = {
    "LinearRegression": "Ols()", "Ridge": "Ridge()", "HuberRegressor": "Irls()",
    "Lasso": "ElasticNet(mix=1.0)", "LassoCV": "ElasticNet(mix=1.0)", "ElasticNet": "ElasticNet()",
    "OrthogonalMatchingPursuit": "Frols()", "STLSQ": "Stlsq(threshold=..., scale='coefficient')",
    "SR3": "Sr3()", "FROLS": "Frols()", "MIOSR": "BestSubset()", "EnsembleOptimizer": "Ensemble()",
    "PolynomialLibrary": "Monomials(max_degree=...)", "FourierLibrary": "Fourier()",
    "IdentityLibrary": "Monomials(max_degree=1)", "CustomLibrary": "Basis(function)",
    "FiniteDifference": "FiniteDifferences()", "SmoothedFiniteDifference": "SavitzkyGolay()",
    "SpectralDerivative": "Spectral()",
}  # fmt: skip


def _checked_part(place: str, part: Any) -> None:
    """Refuse what is no part, or one of another place.

    Raises
    ------
    ConfigError
        With what to use.
    """
    from .errors import ConfigError

    where = f"Pipeline({place}=...)"
    see = f"see lacuna.list_parts('{place}')"
    if isinstance(part, Stage):
        if part.kind != place:
            raise ConfigError(where, f"{part.name} is a {part.kind}", see)
        return
    own = {"basis": Basis, "regressor": Regressor}.get(place)
    if isinstance(part, str) or (own is not None and isinstance(part, own)):
        return
    if isinstance(part, type):
        raise ConfigError(where, f"{part.__name__} is a class", f"give {part.__name__}(), {see}")
    name = type(part).__name__
    use = _INSTEAD.get(name) or ("" if own is None else f"{own.__name__}(function)")
    raise ConfigError(
        where, f"{name} is no part of lacuna", f"use lacuna.{use}, {see}" if use else see
    )


class Pipeline:
    """A composition of stages; a place that is not given has the preset's.

    Parameters
    ----------
    basis : Stage, str or Basis, optional
        Candidate terms.
    formulation, filter, pruner, refiner, differentiator : Stage or str, optional
        The other places, as classes or names.
    regressor : Stage, str or Regressor, optional
        Coefficients of an equation.
    preset : str, optional
        Composition to start from.

    Raises
    ------
    ConfigError
        A stage in a place that is not its own, or a part of another library.
    """

    def __init__(
        self,
        *,
        basis: Stage | Basis | str | None = None,
        formulation: Stage | str | None = None,
        differentiator: Stage | str | None = None,
        filter: Stage | str | None = None,
        regressor: Stage | Regressor | str | None = None,
        pruner: Stage | str | None = None,
        refiner: Stage | str | None = None,
        preset: str | None = None,
    ) -> None:
        given = {
            "basis": basis,
            "formulation": formulation,
            "differentiator": differentiator,
            "filter": filter,
            "regressor": regressor,
            "pruner": pruner,
            "refiner": refiner,
        }
        self._stages: dict[str, Any] = {key: one for key, one in given.items() if one is not None}
        for place, stage in self._stages.items():
            _checked_part(place, stage)
        if preset is not None:
            self._stages["preset"] = preset

    @classmethod
    def preset(cls, name: str, paper: bool = False) -> Pipeline:
        """All stages of a preset; ``paper``: with the raw tolerances of the publication.

        Raises
        ------
        ConfigError
            No such preset, or one without such tolerances.
        """
        stages = json.loads(_lacuna.preset(name, paper))
        made: dict[str, Any] = {place: _stage_of(place, one) for place, one in stages.items()}
        return cls(**made)

    def stages(self) -> dict[str, Any]:
        """The stages that are given, by place."""
        return dict(self._stages)

    def __repr__(self) -> str:
        return f"Pipeline({', '.join(f'{key}={one!r}' for key, one in self._stages.items())})"


def _plain(value: Any) -> Any:
    return value.to_dict() if isinstance(value, Stage) else value


def _stage_of(place: str, values: dict[str, Any]) -> Stage:
    name = next(n for n, c in classes().items() if c.kind == place and c.name == values["type"])
    return _made(name, {key: value for key, value in values.items() if key != "type"})


def _made(name: str, options: dict[str, Any]) -> Stage:
    return classes()[name](**options)


def _class_name(kind: str, name: str, taken: dict[str, Any]) -> str:
    """``irls-l1`` is IrlsL1; a name that another kind has too gets its kind behind it."""
    plain = "".join(word.capitalize() for word in name.split("-"))
    is_free = plain not in taken and not keyword.iskeyword(plain)
    return plain if is_free else plain + "".join(word.capitalize() for word in kind.split("-"))


def _documented(part: dict[str, Any]) -> str:
    lines = [part["summary"].rstrip(".") + ".", "", "Parameters", "----------"]
    for option in part["options"]:
        unit = f" [{option['unit']}]" if option["unit"] else ""
        span = f", {option['range']}" if option["range"] else ""
        lines.append(
            f"{option['name']} : {option['type']}{unit}{span}; default {option['default']}"
        )
        lines.append(f"    {option['text']}")
    if part["reference"]:
        lines += ["", "Notes", "-----", f"Source: {part['reference']}"]
    return "\n".join(lines)


_classes: dict[str, type[Stage]] = {}


def classes() -> dict[str, type[Stage]]:
    """A class for each registered part of a pipeline, made from the registry once."""
    if not _classes:
        for part in _lacuna.parts():
            if part["kind"] not in _KINDS:
                continue
            name = _class_name(part["kind"], part["name"], {**_classes, "None": 0})
            _classes[name] = type(
                name,
                (BasisStage if part["kind"] == "basis" else Stage,),
                {
                    "__doc__": _documented(part),
                    "__module__": "lacuna",
                    "kind": part["kind"],
                    "name": part["name"],
                },
            )
    return _classes
