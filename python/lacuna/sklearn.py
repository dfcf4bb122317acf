"""The conventions of scikit-learn, with the argument names of PySINDy."""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from sklearn.base import BaseEstimator, RegressorMixin
from sklearn.metrics import r2_score
from sklearn.utils.validation import check_is_fitted, validate_data

from . import _lacuna
from .errors import ArgumentError, LacunaWarning
from .finding import identify
from .model import Model
from .proving import simulate
from .records import Records
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
        Names of the states; those of a frame, or x0, x1, ..., unless given.
    discrete_time : bool
        Find a map x[n+1] = f(x[n]).
    t_default : float
        Sampling step where `fit` gets no times.
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
        t_default: float = 1.0,
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
        X : array of shape (n, m), or a list of them
            Samples of m states; a list has one record in each.
        y : ignored
        t : array of shape (n,) or float, or a list, optional
            Times, or the sampling step.
        u : array of shape (n, p), or a list, optional
            Inputs.
        x_dot : array of shape (n, m), or a list, optional
            Measured derivatives.

        Raises
        ------
        DataError, ConfigError, ArgumentError
            As of `lacuna.identify`; each is a `ValueError`.
        """
        if t is None and _increases(y):
            warnings.warn(
                "y increases as times do and is not used; times are given as t=",
                LacunaWarning,
                stacklevel=2,
            )
        several = _several(X)
        parts = [
            self._checked(one, number == 0) for number, one in enumerate(X if several else [X])
        ]
        names: Any = self.feature_names or getattr(self, "feature_names_in_", ())
        records = Records(
            parts if several else parts[0],
            self.t_default if t is None else t,
            u,
            x_dot,
            states=[str(name) for name in names] or None,
        )
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
        """Rates at states (of a map: the next samples), of the shape of X; a list of a list."""
        check_is_fitted(self)
        if _several(X):
            return [self.predict(*record) for record in _records(X, u, t)]
        states = self._checked(X, False)
        inputs = u if u is None or np.ndim(u) != 1 else np.asarray(u).reshape(len(states), -1)
        return self.model_(t, states, inputs)

    def simulate(
        self,
        x0: ArrayLike,
        t: Any,
        u: Any = None,
        integrator: str = "auto",
    ) -> Array:
        """States of shape (n, m) from a start.

        Parameters
        ----------
        x0 : array of shape (m,)
            Start.
        t : array of shape (n,) or int
            Times; of a map their number.
        u : array of shape (n, p) or function of time, optional
            Inputs: samples at these times.
        integrator : str, optional
            Method, see ``lacuna.list_parts("integrator")``.

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
        times = np.arange(int(t)) if np.ndim(t) == 0 else np.asarray(t)
        inputs = None
        if u is not None:
            given = np.array([np.atleast_1d(u(time)) for time in times]) if callable(u) else u
            columns = np.asarray(given).reshape(len(times), -1).T
            named = dict(zip(self.model_.inputs, columns, strict=True))
            inputs = Records({"t": times, **named}, "t")
        return simulate(self.model_, x0, times, inputs=inputs, integrator=integrator).x

    def differentiate(self, X: Any, t: Any = None) -> Any:
        """Rates of the samples by the estimator's method, of the shape of X; a list of a list.

        Raises
        ------
        RuntimeError
            The samples of a map have no rates.
        """
        if self.discrete_time:
            raise RuntimeError("the samples of a map have no rates")
        if _several(X):
            return [self.differentiate(*record) for record in _records(X, t)]
        states = self._checked(X, False)
        step = self.t_default if t is None else t
        times = np.arange(len(states)) * float(step) if np.ndim(step) == 0 else np.asarray(step)
        method = self.differentiation_method or "finite-differences"
        name, options = (
            (method.name, method.to_dict()) if isinstance(method, Stage) else (method, {})
        )
        text = json.dumps(options)
        return np.asarray(_lacuna.derivatives(name, text, times.astype(float), states))

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
        parts = _records(X, t, u, x_dot) if _several(X) else [(X, t, u, x_dot)]
        pairs = [self._rates(*part) for part in parts]
        return float(metric(*map(np.concatenate, zip(*pairs, strict=True))))

    def _rates(self, X: Any, t: Any, u: Any, x_dot: Any) -> tuple[Array, Array]:
        """Rates of the samples, and those of the model there."""
        states = self._checked(X, False)
        if self.discrete_time and x_dot is None:
            inputs = None if u is None else np.asarray(u)[:-1]
            return states[1:], self.predict(states[:-1], inputs)
        target = self.differentiate(states, t) if x_dot is None else np.asarray(x_dot)
        return target.reshape(states.shape), self.predict(states, u)

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


def _records(*lists: Any) -> list[tuple[Any, ...]]:
    """What belongs to each record: elements of lists, or what all have."""
    count = len(lists[0])
    for given in lists:
        if isinstance(given, list) and len(given) != count:
            raise ArgumentError("X", f"there are {count} records", "give a list with one for each")
    return [
        tuple(given[k] if isinstance(given, list) else given for given in lists)
        for k in range(count)
    ]


def _increases(y: Any) -> bool:
    """Whether a target is one increasing column, as times are."""
    values = np.asarray(y)
    is_column = values.ndim == 1 and values.dtype.kind in "fiu" and len(values) > 1
    return is_column and bool((np.diff(values) > 0).all())
