"""Answers as values: the numbers, the text, the pictures and the page of one call."""

from __future__ import annotations

import csv
import html
import io
import json
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from . import _lacuna
from .errors import ConfigError, Error, optional
from .model import Model

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class Fields(dict[str, Any]):
    """A JSON object whose values are attributes too: ``result.validation.verdict``."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"there is no '{name}'; there are {', '.join(self)}") from None

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self})


class Rows(list[Fields]):
    """A list of JSON objects, for a table of which pandas is asked: ``trail.to_frame()``."""

    def to_frame(self) -> Any:
        """The rows as a pandas data frame; pandas has to be installed."""
        return optional("pandas", "frames").DataFrame([dict(row) for row in self])


def _as_values(value: Any) -> Any:
    if isinstance(value, dict):
        return Fields({name: _as_values(one) for name, one in value.items()})
    if isinstance(value, list):
        values = [_as_values(one) for one in value]
        return Rows(values) if all(isinstance(one, Fields) for one in values) else values
    return value


class Result:
    """What a call answers; its attributes have the names of the JSON.

    Attributes
    ----------
    model : Model or None
        What was identified, fitted, or the nominal model with what it lacks.
    ok : bool
        Whether the numbers allow an answer; the command's exit status is 0 then.
    failure : str
        Why they do not; empty where they do.
    """

    def __init__(self, answer: _lacuna.Answer | Shown, call: str) -> None:
        self._answer = answer
        self._call = call
        self._values: Fields | None = None

    @property
    def model(self) -> Model | None:
        """The model of the answer, where it has one."""
        system = self._answer.model
        return None if system is None else Model(system)

    @property
    def failure(self) -> str:
        """Why the numbers do not allow an answer; empty where they do."""
        return str(self._answer.failure)

    @property
    def ok(self) -> bool:
        """Whether the numbers allow an answer."""
        return not self.failure

    def to_json(self) -> str:
        """The answer as the command writes it with ``--json``, to the byte."""
        return str(self._answer.json())

    def to_dict(self) -> dict[str, Any]:
        """The same as dictionaries and lists."""
        values: dict[str, Any] = json.loads(self.to_json())
        return values

    def summary(self, full: bool = False, explain: bool = False) -> str:
        """The text that the command prints.

        With ``full`` numbers have all their digits; with ``explain`` an identification shows
        how it came about.
        """
        return str(self._answer.text(full, explain))

    def report(self, path: str | os.PathLike[str] | None = None) -> str:
        """The answer with its pictures as one HTML page, written where a path is given."""
        page = str(self._answer.html(self._call))
        if path is not None:
            with open(path, "w", encoding="utf-8") as file:
                file.write(page)
        return page

    def pictures(self) -> dict[str, str]:
        """Every picture of the report as SVG, by name."""
        return dict(self._answer.pictures())

    def figures(self) -> dict[str, dict[str, Any]]:
        """The numbers of every picture of the report, by name."""
        return {figure["name"]: figure for figure in self._answer.figures()}

    def plot(self, name: str | None = None, ax: Any = None) -> Any:
        """Draw a picture of the report on matplotlib axes; the first one without a name.

        Parameters
        ----------
        name : str, optional
            One of ``figures()``.
        ax : matplotlib axes, optional
            Where; new ones where none are given.

        Returns
        -------
        matplotlib axes
        """
        from .plot import draw

        figures = self.figures()
        if name is not None and name not in figures:
            raise KeyError(f"there is no picture '{name}'; there are {', '.join(figures)}")
        return draw(figures[name or next(iter(figures))], ax)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self._fields(), name)

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self._fields()})

    def _fields(self) -> Fields:
        if self._values is None:
            self._values = _as_values(self.to_dict())
        return self._values

    def __str__(self) -> str:
        return self.summary()

    def __repr__(self) -> str:
        return f"<lacuna.{type(self).__name__}\n{self.summary()}>"

    def _repr_html_(self) -> str:
        # A frame of its own: ids and styles of two answers on one page do not meet.
        page = html.escape(self.report(), quote=True)
        return (
            f'<iframe srcdoc="{page}" title="lacuna {type(self).__name__}" '
            'style="width:100%;height:30em;border:0" sandbox="allow-scripts"></iframe>'
        )

    def __reduce__(self) -> tuple[Callable[..., Any], tuple[Any, ...]]:
        answer = self._answer
        return type(self), (answer if isinstance(answer, Shown) else Shown(answer), self._call)


class _Modelled(Result):
    """An answer that has a model."""

    @property
    def model(self) -> Model:
        """The model of the answer."""
        system = self._answer.model
        assert system is not None
        return Model(system)


class Identification(_Modelled):
    """What `identify` found; ``.trail`` has what became of every candidate term."""


class Diagnosis(_Modelled):
    """What `diagnose` found; ``.rivals`` has every composite model that was judged."""

    def explain(self) -> str:
        """Every composite model that was judged and the number that decided, for people."""
        return str(self._answer.trail())


class Fit(_Modelled):
    """What `fit` found: ``.parameters`` with their intervals, ``.fit`` by channel."""


class Rivals(_Modelled):
    """Several models fitted to the same records: ``.rivals``, the best first."""


class Plan(Result):
    """The next experiment: ``.input``, ``.promise``, ``.safe``, ``.cost``."""

    def inputs(self, format: str = "csv") -> str:
        """The inputs as text for a bench: csv, c, or awg (waveform generators).

        Raises
        ------
        ConfigError
            No such format.
        ArgumentError
            A waveform of more than one input, of several runs or of uneven times.
        """
        return str(self._answer.inputs(format))


class Bench(Result):
    """Parts of `identify` compared: ``.rows``, one for each composition and noise."""

    def to_json(self) -> str:
        """Refuse: the command writes no JSON of it either."""
        raise TypeError("Bench has no JSON; it has rows and to_csv()")

    def to_csv(self) -> str:
        """A line for each cell, as the command writes it with ``--csv``, to the byte."""
        return str(self._answer.csv())

    def to_dict(self) -> dict[str, Any]:
        """The same as a list of rows."""
        lines = csv.DictReader(io.StringIO(self.to_csv()))
        return {"rows": [{name: _cell(text) for name, text in line.items()} for line in lines]}


def _cell(text: str) -> float | str | None:
    """A cell of a table: a number, a text, or nothing."""
    try:
        return float(text)
    except ValueError:
        return text or None


class Sync(Result):
    """How far a model that is driven by a record stays from it."""


class _Unpictured(Result):
    """An answer that has no page."""

    def report(self, path: str | os.PathLike[str] | None = None) -> str:
        """Refuse: the command writes no page of this answer either."""
        raise TypeError(f"{type(self).__name__} has no report; it has summary()")

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self.summary())}</pre>"


class Comparison(_Unpictured):
    """Measures of two attractors beside one another."""


class Check(_Unpictured):
    """What would be read of records, and what is odd about them."""


@dataclass
class Orbit:
    """A solution apart from the library, for another process."""

    time: NDArray[np.float64]
    states: NDArray[np.float64]
    columns: list[tuple[str, str]]
    time_unit: str
    text: str

    def csv(self) -> str:
        """As `_lacuna.Orbit.csv`."""
        return self.text


class Simulation:
    """A solution of a model: states and outputs at times.

    Attributes
    ----------
    t : array of shape (n,)
        Times, in the model's unit.
    x : array of shape (n, m)
        States, and behind them outputs that are called otherwise.
    names : list of str
        Names of the columns of ``x``.
    """

    def __init__(self, orbit: _lacuna.Orbit | Orbit, index: Any = None) -> None:
        self._orbit: Any = orbit
        self._index = index
        self.names: list[str] = [name for name, _ in orbit.columns]
        self.units: dict[str, str] = {name: unit for name, unit in orbit.columns if unit}
        self.time_unit: str = orbit.time_unit

    @property
    def t(self) -> NDArray[np.float64]:
        """Times."""
        times: NDArray[np.float64] = self._orbit.time
        return times

    @property
    def x(self) -> NDArray[np.float64]:
        """States, one column each."""
        states: NDArray[np.float64] = self._orbit.states
        return states

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        return self.x[:, self.names.index(name)]

    def __iter__(self) -> Iterator[NDArray[np.float64]]:
        return iter((self.t, self.x))

    def __len__(self) -> int:
        return len(self.t)

    def to_csv(self) -> str:
        """The text that the command writes, to the byte."""
        return str(self._orbit.csv())

    def to_frame(self) -> Any:
        """The columns as a pandas data frame with the time as index, or that of the inputs."""
        pandas = optional("pandas", "frames")
        frame = pandas.DataFrame(self.x.copy(), columns=self.names)
        is_own = self._index is not None
        frame.index = self._index if is_own else pandas.Index(self.t.copy(), name="t")
        frame.attrs["units"] = dict(self.units)
        return frame

    def __reduce__(self) -> tuple[type[Simulation], tuple[Orbit, Any]]:
        orbit = self._orbit
        return Simulation, (
            Orbit(orbit.time, orbit.states, orbit.columns, orbit.time_unit, orbit.csv()),
            self._index,
        )

    def __repr__(self) -> str:
        return f"<lacuna.Simulation of {', '.join(self.names)}: {len(self)} samples>"


def _written(answer: _lacuna.Answer, format: str) -> str | Error:
    """The inputs of a plan, or why they are not written so."""
    try:
        return answer.inputs(format)
    except Error as error:
        return error


class Shown:
    """An answer apart from the library: all that it is shown as, for another process."""

    def __init__(self, answer: _lacuna.Answer) -> None:
        self._json = answer.json()
        self._csv = answer.csv()
        self._inputs = {format: _written(answer, format) for format in ("csv", "c", "awg")}
        self._texts = {
            (full, explain): answer.text(full, explain)
            for full in (False, True)
            for explain in (False, True)
        }
        self._trail = answer.trail() if answer.has_trail else ""
        self._page = answer.html("") if answer.has_page else ""
        self._pictures = dict(answer.pictures())
        self._figures = list(answer.figures())
        self._model = None if answer.model is None else answer.model.to_json()
        self.failure = answer.failure

    @property
    def model(self) -> _lacuna.SystemModel | None:
        """The model, made again from its JSON."""
        text = self._model
        return None if text is None else _lacuna.SystemModel.from_json(text, "model")

    def json(self) -> str:
        """As `Answer.json`."""
        return self._json

    def csv(self) -> str:
        """As `Answer.csv`."""
        return self._csv

    def inputs(self, format: str) -> str:
        """As `Answer.inputs`."""
        if format not in self._inputs:
            raise ConfigError("format", f"'{format}' is not known", "give one of csv, c, awg")
        written = self._inputs[format]
        if isinstance(written, Error):
            raise written
        return written

    def text(self, full: bool, explain: bool) -> str:
        """As `Answer.text`."""
        return self._texts[full, explain]

    def trail(self) -> str:
        """As `Answer.trail`."""
        return self._trail

    def html(self, call: str) -> str:
        """As `Answer.html`."""
        return self._page

    def pictures(self) -> dict[str, str]:
        """As `Answer.pictures`."""
        return self._pictures

    def figures(self) -> list[dict[str, Any]]:
        """As `Answer.figures`."""
        return self._figures
