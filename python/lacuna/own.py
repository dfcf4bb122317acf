"""Parts written in Python: a basis, a regressor, an effect."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any

from . import _lacuna
from .errors import ArgumentError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]


class _Own:
    """A part that is made again of what it was made of: pickled, copied, cloned."""

    def __init__(self, *given: Any) -> None:
        self._given = given

    def __reduce__(self) -> tuple[type[_Own], tuple[Any, ...]]:
        return type(self), self._given


class Composable:
    """What is added to another and multiplied with it, where both are bases: a + b, a * b."""

    def __add__(self, other: Any) -> Any:
        return _composed("sum", self, other)

    def __mul__(self, other: Any) -> Any:
        return _composed("product", self, other)


@dataclass(frozen=True)
class _Composition:
    """The terms of two bases of which one is written in Python, as a function."""

    kind: str
    first: Any
    second: Any

    def __call__(self, states: list[str], inputs: list[str]) -> list[str]:
        first, second = (one.library(states, inputs) for one in (self.first, self.second))
        written = {"type": "expressions"}
        both = {"first": {**written, "terms": first}, "second": {**written, "terms": second}}
        return _lacuna.library(self.kind, json.dumps(both), states, inputs)


def _composed(kind: str, first: Any, second: Any) -> Any:
    """A registered composition, or one in Python where a basis is written there."""
    from .stages import Stage, classes

    if not (hasattr(first, "library") and hasattr(second, "library")):
        return NotImplemented  # one of them is no basis
    if isinstance(first, Stage) and isinstance(second, Stage):
        made = {one.name: one for one in classes().values() if one.kind == "basis"}
        return made[kind](first=first, second=second)
    return Basis(_Composition(kind, first, second), kind)


_TEXTS = "give a function that lists formulas as texts: lambda states, inputs: ['x', 'sin(x)']"


def _formulas(name: str, terms: Any, states: list[str], inputs: list[str]) -> list[str]:
    """What a function gives for these variables, where that is texts."""
    given = terms(states, inputs)
    made = [given] if isinstance(given, str) or not isinstance(given, Iterable) else list(given)
    wrong = [one for one in made if not isinstance(one, str)]
    if wrong or made == [given]:
        raise ArgumentError(name, f"{(wrong or made)[0]!r} is no list of formulas", _TEXTS)
    return made


class Basis(Composable, _Own):
    """Candidate terms made by a function.

    Parameters
    ----------
    terms : function
        From names of states and of inputs to formulas: ``f(states, inputs) -> ["x", "sin(x)"]``.
        Terms that are there twice are one; formulas are in states, inputs and ``t``.
    name : str, optional
        What the basis is called in answers.

    Raises
    ------
    ArgumentError
        Something else than a function; from the call that uses it: terms that are no texts.
    ModelError
        From the call that uses it: a formula that cannot be read.
    ConfigError
        No term is left.
    """

    def __init__(
        self, terms: Callable[[list[str], list[str]], Iterable[str]], name: str = "python-basis"
    ) -> None:
        super().__init__(terms, name)
        if not callable(terms):
            raise ArgumentError(name, f"{terms!r} is no function", _TEXTS)
        self.written = _lacuna.WrittenBasis(name, partial(_formulas, name, terms))

    def library(self, states: Sequence[str], inputs: Sequence[str] = ()) -> list[str]:
        """Names of the terms for these variables, as the library has them."""
        return self.written.library(list(states), list(inputs))


class Regressor(_Own):
    """Coefficients of one equation, found by a function.

    Parameters
    ----------
    solve : function
        From the least-squares problem to coefficients: ``f(theta, y) -> h`` with theta of shape
        (k, L), y of shape (k,) and h of shape (L,). A term whose coefficient is 0 goes. The
        k = L + 1 rows are the triangular factor of the record's rows: for every h,
        ``|y - theta h|`` is that of all samples.
    name : str, optional
        What the regressor is called in answers.

    Raises
    ------
    ArgumentError
        From the call that uses it: a wrong number of coefficients, one that is not finite.
    """

    def __init__(
        self, solve: Callable[[Array, Array], ArrayLike], name: str = "python-regressor"
    ) -> None:
        super().__init__(solve, name)
        self.written = _lacuna.WrittenRegressor(name, solve)

    def fit(self, theta: Array, y: Array) -> list[float]:
        """Coefficients of all columns of theta (n x L) for a target y (n), as in a pipeline."""
        return self.written.fit(theta, y.reshape(-1, 1))


@dataclass(frozen=True)
class Form:
    """A form that an equation may lack; the coefficient in front of it is free.

    Parameters
    ----------
    formula : str
        In states, inputs, ``t`` and the names of the shapes: ``"max(x-edge,0)"``.
    argument : str
        What it is a function of: ``"x"``.
    shapes : dict, optional
        Range of each number inside the formula: ``{"edge": (0.1, 2.0)}``; searched on a
        logarithmic scale where it is above 0.
    starts : list, optional
        Starting points of the search, a number for each shape; the middle of the ranges unless
        given.
    """

    formula: str
    argument: str
    shapes: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    starts: Sequence[Sequence[float]] = ()


@dataclass(frozen=True)
class Scope:
    """What an effect may look at: never the residual itself.

    Attributes
    ----------
    equation : str
        State in whose equation forms are sought.
    states, inputs : list of str
        Variables of the model.
    ranges : dict
        Smallest and largest value of each variable in the records, in its unit.
    step, duration : float
        Time between samples, and of the longest record.
    """

    equation: str
    states: list[str]
    inputs: list[str]
    ranges: dict[str, tuple[float, float]]
    step: float
    duration: float


class Effect(_Own):
    """A named family of forms that a model may lack, for `diagnose`.

    Parameters
    ----------
    name : str
        What the effect is called in answers.
    forms : function
        From a `Scope` to forms for its equation: ``f(scope) -> [Form(...), ...]``.
    cause : str, optional
        What usually causes it.

    Raises
    ------
    ModelError
        From the call that uses it: a formula that uses an unknown name.
    """

    def __init__(
        self, name: str, forms: Callable[[Scope], Iterable[Form]], cause: str = ""
    ) -> None:
        super().__init__(name, forms, cause)
        self.name = name
        self.written = _lacuna.WrittenEffect(name, forms, cause)
