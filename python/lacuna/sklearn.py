"""The conventions of scikit-learn, with the argument names of PySINDy."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import ArgumentError, optional, warn

optional("sklearn", "sklearn")

# ruff: noqa: E402 (that it is not installed is said first)
from sklearn.base import BaseEstimator, RegressorMixin
from sklearn.metrics import r2_score
from sklearn.utils.validation import check_is_fitted, validate_data

from . import _lacuna
from .finding import identify
from .frames import (
    bare,
    framed,
    in_order,
    is_frame,
    is_numbered,
    is_pandas,
    labels_of,
    row_labels,
    says_time,
    seconds_since,
)
from .model import Model, check_inputs
from .proving import simulate
from .records import Records, Samples
from .results import Simulation
from .stages import Pipeline, Stage

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]


class ODERegressor(RegressorMixin, BaseEstimator):  # type: ignore[misc]
    """Differential equations (or a map) as an estimator.

    Parameters
    ----------
    preset : str
        Composition of stages to start from: algorithm1, paper, robust, sindy.
    degree : int, optional
        Monomials up to this degree.
    feature_library, differentiation_method, optimizer : Stage, own part or str, optional
        Basis, differentiator and regressor in place of the preset's.
    options : dict, optional
        Single values by path, as of `lacuna.identify`.
    feature_names : list of str, optional
        Names of the states, and behind them of inputs; those of frames, or x0, x1, ..., u0, ...,
        unless given.
    discrete_time : bool
        Find a map x[n+1] = f(x[n]).
    t_default : float, optional
        Sampling step where there are no times: neither ``t=``, nor a frame with a time as its
        index or with a column ``t`` or ``time``. Unless given it is 1 for arrays and maps, and
        a frame of a flow is refused.
    seed : int
        Start of everything random.
    threads : int, optional
        All cores unless given.

    Attributes
    ----------
    model_ : Model
        The equations.
    result_ : Identification
        The whole answer.
    n_features_in_ : int
        Number m of states.
    input_names_in_ : list of str
        Columns of frames that are inputs, where ``u=`` names them.
    time_name_in_ : str or None
        Column of frames that is the time, where ``t=`` names it.
    has_times_ : bool
        Whether `fit` had times, or a step, as ``t=`` or in a frame.

    Notes
    -----
    ``y`` is there for the conventions of scikit-learn and is not used: the target is the rate of
    the samples.
    """

    def __init__(
        self,
        preset: str = "algorithm1",
        degree: int | None = None,
        feature_library: Any = None,
        differentiation_method: Any = None,
        optimizer: Any = None,
        options: dict[str, Any] | None = None,
        feature_names: Sequence[str] | None = None,
        discrete_time: bool = False,
        t_default: float | None = None,
        seed: int = 1,
        threads: int | None = None,
    ) -> None:
        self.preset = preset
        self.degree = degree
        self.feature_library = feature_library
        self.differentiation_method = differentiation_method
        self.optimizer = optimizer
        self.options = options
        self.feature_names = feature_names
        self.discrete_time = discrete_time
        self.t_default = t_default
        self.seed = seed
        self.threads = threads

    def fit(
        self, X: Any, y: Any = None, *, t: Any = None, u: Any = None, x_dot: Any = None
    ) -> ODERegressor:
        """Identify the equations.

        Parameters
        ----------
        X : array of shape (n, m), frame, or a list of them
            Samples of m states; a list has one record in each. A frame may have the time (its
            index or a column) and columns of inputs beside the states.
        y : ignored
        t : array of shape (n,), float or str, or a list, optional
            Times, or the sampling step, or the column of a frame that is the time.
        u : array of shape (n, p), frame or series, or a list; or names of columns, optional
            Inputs.
        x_dot : array of shape (n, m) or frame, or a list; or names of columns, optional
            Measured derivatives.

        Raises
        ------
        DataError, ConfigError, ArgumentError
            As of `lacuna.identify`; each is a `ValueError`.
        """
        self.has_times_ = _says_time(X, t)
        self.input_names_in_ = _names_in(u)
        self.time_name_in_ = t if isinstance(t, str) else None
        records, _ = self._read(X, self._timed(X, t, y), u, x_dot, is_first=True)
        self.result_ = identify(
            records,
            preset=self.preset,
            degree=self.degree,
            pipeline=Pipeline(
                basis=self.feature_library,
                differentiator=self.differentiation_method,
                regressor=self.optimizer,
            ),
            options=self.options,
            discrete=self.discrete_time,
            seed=self.seed,
            threads=self.threads,
        )
        self.model_: Model = self.result_.model
        return self

    def predict(self, X: Any, u: Any = None, t: Any = 0.0) -> Any:
        """Rates at states (of a map: the next samples), of the shape of X; a list of a list.

        A frame of pandas gives a frame with its index and the columns of the states.
        """
        check_is_fitted(self)
        if _several(X):
            return [self.predict(*record) for record in _records(X, u, t)]
        records, (states,) = self._read(X, self._timed(X, caller="predict", is_used=False), u)
        rates = self.model_(t, states, records.samples()[0].inputs)
        return framed(rates, X, records.state_labels(0))

    def simulate(
        self,
        x0: ArrayLike,
        t: Any,
        u: Any = None,
        integrator: str = "auto",
    ) -> Any:
        """States of shape (n, m) from a start.

        Parameters
        ----------
        x0 : array of shape (m,), or a series with the names of the states
            Start.
        t : array of shape (n,) or int
            Times; of a map their number.
        u : array of shape (n, p), frame, series or function of time, optional
            Inputs: samples at these times.
        integrator : str, optional
            Method, see ``lacuna.list_parts("integrator")``.

        Returns
        -------
        array, or a frame
            A frame of pandas where the start is a row of one, or times or inputs have its index.

        Raises
        ------
        ArgumentError
            A number in the place of the times of a flow.
        NoAnswerError
            The model has no finite solution as long as that.
        """
        check_is_fitted(self)
        if np.ndim(t) == 0 and not self.discrete_time:
            raise ArgumentError("t", "a flow has no number of steps", "give the times")
        times = np.arange(int(t)) if np.ndim(t) == 0 else t
        names = _names_in(u)
        check_inputs(self.model_, ", ".join(names) if names else u, "u")
        inputs = in_order(u, self.model_.inputs)
        if callable(u):
            inputs = np.array([np.atleast_1d(u(time)) for time in np.asarray(times)])
        run = simulate(
            self.model_, x0, seconds_since(u, times), inputs=inputs, integrator=integrator
        )
        labels = row_labels(times, None, len(run)), row_labels(None, u, len(run))
        index = next((label for label in labels if label is not None), None)
        is_of_pandas = index is not None or hasattr(x0, "iloc")
        return Simulation(run._orbit, index).to_frame() if is_of_pandas else run.x

    def differentiate(self, X: Any, t: Any = None) -> Any:
        """Rates of the samples by the estimator's method, of the shape of X; a list of a list.

        A frame of pandas gives a frame, as of `predict`.

        Raises
        ------
        RuntimeError
            The samples of a map have no rates.
        """
        if self.discrete_time:
            raise RuntimeError("the samples of a map have no rates")
        t = self._timed(X, t, caller="differentiate")
        if _several(X):
            return [self.differentiate(*record) for record in _records(X, t)]
        records, (states,) = self._read(X, t)
        rates = self._differentiated(states, records.samples()[0])
        return framed(rates, X, records.state_labels(0)) if is_pandas(X) else rates

    def score(
        self,
        X: Any,
        y: Any = None,
        *,
        t: Any = None,
        u: Any = None,
        x_dot: Any = None,
        metric: Callable[..., float] = r2_score,
    ) -> float:
        """Hold predicted rates against those of the samples (of a map: the next samples)."""
        check_is_fitted(self)
        t = self._timed(X, t, y, caller="score", is_used=x_dot is None)
        parts = _records(X, t, u, x_dot) if _several(X) else [(X, t, u, x_dot)]
        pairs = [self._rates(*part) for part in parts]
        return float(metric(*map(np.concatenate, zip(*pairs, strict=True))))

    def _rates(self, X: Any, t: Any, u: Any, x_dot: Any) -> tuple[Array, Array]:
        """Rates of the samples, and those of the model there."""
        records, (states,) = self._read(X, t, u, x_dot)
        (record,) = records.samples()
        if self.discrete_time and x_dot is None:
            inputs = None if record.inputs is None else record.inputs[:-1]
            return states[1:], self.model_(0.0, states[:-1], inputs)
        target = record.derivatives
        if target is None:
            target = self._differentiated(states, record)
        return target, self.model_(0.0, states, record.inputs)

    def _differentiated(self, states: Array, record: Samples) -> Array:
        method = self.differentiation_method or "finite-differences"
        name, options = (
            (method.name, method.to_dict()) if isinstance(method, Stage) else (method, {})
        )
        times: Any = record.time
        if not isinstance(times, np.ndarray):
            times = np.arange(len(states)) * times
        return np.asarray(_lacuna.derivatives(name, json.dumps(options), times, states))

    def _read(
        self, X: Any, t: Any = None, u: Any = None, x_dot: Any = None, is_first: bool = False
    ) -> tuple[Records, list[Array]]:
        """The records, and their states as scikit-learn has checked them."""
        parts = list(X) if _several(X) else [X]
        firsts = [is_first and number == 0 for number in range(len(parts))]
        states: list[Any] = [
            part if is_frame(part) else self._checked(part, first)
            for part, first in zip(parts, firsts, strict=True)
        ]
        if not is_first:
            u = self._inputs_of(parts, u)
        names = [str(name) for name in self.feature_names or ()]
        count = 0 if is_frame(states[0]) else states[0].shape[1]
        behind = names[count:] if count else []
        records = Records(
            states if _several(X) else states[0],
            t,
            u,
            x_dot,
            states=names[:count] or None,
            inputs=None if u is None else (behind if is_first else self.model_.inputs) or None,
        )
        records.check_free()
        for number, part in enumerate(states):
            if not is_frame(part):
                continue
            labels = records.state_labels(number)
            states[number] = self._checked(part[labels], firsts[number])
            if firsts[number] and not self.has_times_ and _increases(states[number][:, 0]):
                warn(
                    f"column '{labels[0]}' increases as times do and is taken as a state; "
                    f"t='{labels[0]}' makes it the time"
                )
            if firsts[number] and names:
                records.call_states(names[: len(labels)])
        return records, states

    def _timed(
        self, X: Any, t: Any = None, y: Any = None, caller: str = "fit", is_used: bool = True
    ) -> Any:
        """What says the times: ``t``, nothing where frames do, else the step of the estimator."""
        parts = X if _several(X) else [X]
        time = getattr(self, "time_name_in_", None)
        if t is None and caller != "fit" and all(time in _names_of(part) for part in parts):
            t = time
        is_said = _says_time(X, t)
        is_known = is_said or self.discrete_time or self.t_default is not None or not is_used
        if t is None and _increases(y):
            if not is_known:
                raise ArgumentError(
                    "y", "it increases as times do, and is not used", f"write {caller}(X, t=t)"
                )
            warn("y increases as times do and is not used; times are given as t=")
        has_names = any(is_frame(part) and not is_numbered(part) for part in parts)
        if is_said or (has_names and not is_known):
            return t  # records without any time are refused
        if not is_known and caller != "fit" and getattr(self, "has_times_", False):
            warn(f"{caller} has no times, as fit had, and takes the step 1; give t= or t_default=")
        return 1.0 if self.t_default is None else self.t_default

    def _inputs_of(self, parts: list[Any], u: Any) -> Any:
        """Inputs, or the columns of frames that were these in `fit`, in the order of the model."""
        inputs = getattr(self, "input_names_in_", [])
        if u is None and inputs and all(_names_of(part) >= set(inputs) for part in parts):
            return inputs
        known = list(self.model_.inputs) if hasattr(self, "model_") else []
        given = {bare(name): name for name in _names_in(u)}
        if not given or not set(known) & set(given):
            return u
        if set(known) != set(given):
            raise ArgumentError(
                "u", f"the inputs of the model are {', '.join(known)}", "name a column for each"
            )
        return [given[name] for name in known]

    @property
    def complexity(self) -> int:
        """Number of terms of all equations."""
        check_is_fitted(self)
        return sum(len(sums) for sums in self.model_.terms.values())

    def get_feature_names(self) -> list[str]:
        """Terms that stand in some equation, in order."""
        check_is_fitted(self)
        return list(dict.fromkeys(term for sums in self.model_.terms.values() for term in sums))

    def coefficients(self) -> Array:
        """Coefficients of shape (m, L), of the terms of `get_feature_names`."""
        names = self.get_feature_names()
        return np.array([[s.get(n, 0.0) for n in names] for s in self.model_.terms.values()])

    def equations(self, precision: int = 3) -> list[str]:
        """Right-hand sides with so many digits."""
        check_is_fitted(self)
        return [line.split(" = ", 1)[1] for line in self._lines(precision)]

    def print(self, precision: int = 3) -> None:
        """Print the equations."""
        check_is_fitted(self)
        print("\n".join(self._lines(precision)))

    def _lines(self, precision: int) -> list[str]:
        return self.model_.equations(precision).splitlines()

    def _checked(self, X: Any, is_first: bool) -> Array:
        states: Array = validate_data(
            self,
            X,
            reset=is_first,
            dtype=np.float64,
            ensure_all_finite="allow-nan",
            ensure_min_samples=2 if is_first else 1,
        )
        return states

    def __sklearn_tags__(self) -> Any:
        tags = super().__sklearn_tags__()
        tags.input_tags.allow_nan = True
        tags.target_tags.required = False
        tags.regressor_tags.poor_score = True
        return tags


def _several(X: Any) -> bool:
    """Whether a list holds records, not rows."""
    return isinstance(X, list) and all(hasattr(one, "__array__") for one in X)


def _says_time(X: Any, t: Any) -> bool:
    """Whether times are given, or all records are frames that have them."""
    parts = X if _several(X) else [X]
    return t is not None or all(is_frame(part) and says_time(part) for part in parts)


def _names_of(part: Any) -> set[str]:
    """The names of the columns of a frame, with their units and without."""
    labels = [str(label) for label in labels_of(part)] if is_frame(part) else []
    return {*labels, *map(bare, labels)}


def _names_in(u: Any) -> list[str]:
    """Names of columns in the place of inputs."""
    names = [u] if isinstance(u, str) else u
    is_list = isinstance(names, list | tuple) and all(isinstance(name, str) for name in names)
    return list(names) if is_list else []


def _records(*lists: Any) -> list[tuple[Any, ...]]:
    """What belongs to each record: elements of lists, or what all have."""
    count = len(lists[0])
    is_list = [isinstance(given, list) and not _names_in(given) for given in lists]
    for given, splits in zip(lists, is_list, strict=True):
        if splits and len(given) != count:
            raise ArgumentError("X", f"there are {count} records", "give a list with one for each")
    return [
        tuple(given[k] if splits else given for given, splits in zip(lists, is_list, strict=True))
        for k in range(count)
    ]


def _increases(y: Any) -> bool:
    """Whether a target is one increasing column, as times are."""
    values = np.asarray(y)
    is_column = values.ndim == 1 and values.dtype.kind in "fiu" and len(values) > 1
    return is_column and bool((np.diff(values) > 0).all())
