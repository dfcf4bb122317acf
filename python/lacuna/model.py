"""Models as values: equations that can be called, differentiated, written and compared."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from . import _lacuna
from .errors import ArgumentError
from .frames import framed, in_order

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray


def check_inputs(model: Model, given: Any, place: str) -> None:
    """Refuse to evaluate a model without its inputs, or with names in the place of samples.

    Raises
    ------
    ArgumentError
        Names the inputs.
    """
    names = ", ".join(model.inputs)
    if names and given is None:
        raise ArgumentError(
            place, f"the model has the input{'s' * (len(model.inputs) > 1)} {names}",
            f"give {place}=",
        )  # fmt: skip
    if isinstance(given, str):
        raise ArgumentError(
            place, f"'{given}' names a column, but there is no frame", "give its samples"
        )


class Model:
    """Equations dx/dt = f(t, x, u), or a map x[n+1] = f(t, x, u), with named parameters.

    A value: equal where its equations are, and picklable. Make one by `from_text`, `from_terms`,
    `from_dict`, `from_sympy` or `load`; answers have one as ``.model``.
    """

    def __init__(self, system: _lacuna.SystemModel) -> None:
        self._system = system
        self._compiled: _lacuna.Evaluator | None = None

    @classmethod
    def from_text(cls, text: str, source: str = "model") -> Model:
        """Read the text of an ``.ode`` file, one statement a line.

        Raises
        ------
        ModelError
            Names source, line and column of what cannot be read.

        Examples
        --------
        >>> Model.from_text("dx/dt = -2*x").states
        ('x',)
        """
        return cls(_lacuna.SystemModel.from_text(text, source))

    @classmethod
    def from_terms(
        cls,
        terms: Mapping[str, Mapping[str, float]],
        inputs: Sequence[str] = (),
        time_unit: str = "s",
        is_map: bool = False,
    ) -> Model:
        """Make a model of coefficients by state and term.

        Parameters
        ----------
        terms : dict of dict
            ``{"x": {"y": 1.0}, "y": {"sin(x)": -9.81, "u": 1.0}}``.
        inputs : list of str, optional
            Names of inputs.
        time_unit : str, optional
            Unit of the time.
        is_map : bool, optional
            Whether the sums are the next sample, not the rate.
        """
        lists = [[(float(c), term) for term, c in sums.items()] for sums in terms.values()]
        return cls(
            _lacuna.SystemModel.from_terms(list(terms), list(inputs), lists, time_unit, is_map)
        )

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> Model:
        """Make a model of what `to_dict` gave, or a ``lacuna.model/1`` document."""
        return cls.from_json(json.dumps(values))

    @classmethod
    def from_json(cls, text: str, source: str = "model") -> Model:
        """Read JSON text of the format ``lacuna.model/1``."""
        return cls(_lacuna.SystemModel.from_json(text, source))

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Model:
        """Read a model file (``.ode`` or ``.json``), or a test system by its name."""
        return cls(_lacuna.SystemModel.load(os.fspath(path)))

    @classmethod
    def from_sympy(cls, rates: Mapping[Any, Any], inputs: Sequence[Any] = ()) -> Model:
        """Make a model of SymPy expressions by state symbol: ``{x: y, y: -sin(x) + u}``."""
        from .symbolic import from_sympy

        return from_sympy(rates, inputs)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write a model file: text where the name ends in ``.ode``, else JSON."""
        name = os.fspath(path)
        with open(name, "w", encoding="utf-8") as file:
            file.write(self.to_text() if name.endswith(".ode") else self.to_json())

    @property
    def states(self) -> tuple[str, ...]:
        """Names of the m states."""
        return tuple(name for name, _ in self._system.states())

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of the p inputs."""
        return tuple(name for name, _ in self._system.inputs())

    @property
    def units(self) -> dict[str, str]:
        """Units of states and inputs that have one."""
        return {
            name: unit for name, unit in [*self._system.states(), *self._system.inputs()] if unit
        }

    @property
    def parameters(self) -> dict[str, float]:
        """Values of the named parameters."""
        return dict(self._system.parameters())

    @property
    def terms(self) -> dict[str, dict[str, float]]:
        """Coefficients by state and term, with numbers for the parameters."""
        return {
            state: {term: coefficient for coefficient, term in summands}
            for state, summands in zip(self.states, self._system.terms(), strict=True)
        }

    @property
    def time_unit(self) -> str:
        """Unit of the time."""
        return self._system.time_unit()

    @property
    def is_map(self) -> bool:
        """Whether the equations give the next sample, not the rate."""
        return self._system.is_map()

    def __call__(
        self, t: ArrayLike, x: ArrayLike, u: ArrayLike | None = None
    ) -> NDArray[np.float64]:
        """Evaluate the right-hand sides.

        Parameters
        ----------
        t : float or array of shape (n,)
            Times.
        x : array of shape (m,) or (n, m), or a frame
            States, one row for each time; of a frame the columns with their names.
        u : array of shape (p,) or (n, p), or of one input (n,), or a frame, optional
            Inputs.

        Returns
        -------
        array of the shape of x, or a frame with its index
            dx/dt in state units per time unit; of a map the next states.

        Raises
        ------
        ArgumentError
            Shapes that do not fit.
        """
        import numpy as np

        rates: NDArray[np.float64] = self._evaluator().rates(*self._points(t, x, u))
        if np.ndim(x) == 1:
            return rates.reshape(-1)
        framed_rates: NDArray[np.float64] = framed(rates, x, list(self.states))
        return framed_rates

    def jacobian(
        self, t: ArrayLike, x: ArrayLike, u: ArrayLike | None = None
    ) -> NDArray[np.float64]:
        """Evaluate df_k/dx_j: shape (m, m), or (n, m, m) for n rows; arguments as of a call."""
        import numpy as np

        slopes: NDArray[np.float64] = self._evaluator().jacobians(*self._points(t, x, u))
        return slopes.reshape(slopes.shape[1:]) if np.ndim(x) == 1 else slopes

    def to_scipy(
        self, u: Callable[[float], ArrayLike] | None = None
    ) -> tuple[Callable[..., Any], Callable[..., Any]]:
        """Right-hand side and Jacobian for ``scipy.integrate.solve_ivp``.

        Parameters
        ----------
        u : function of time, optional
            Inputs of shape (p,) at a time.

        Examples
        --------
        >>> rhs, jac = model.to_scipy()
        >>> solve_ivp(rhs, (0, 10), x0, method="BDF", jac=jac)
        """

        def rate(t: float, x: NDArray[np.float64]) -> NDArray[np.float64]:
            return self(t, x, None if u is None else u(t))

        def jacobian(t: float, x: NDArray[np.float64]) -> NDArray[np.float64]:
            return self.jacobian(t, x, None if u is None else u(t))

        return rate, jacobian

    def to_text(self) -> str:
        """The model as text of an ``.ode`` file."""
        return self._system.to_text()

    def to_json(self) -> str:
        """The model as JSON of the format ``lacuna.model/1``, to the last bit."""
        return self._system.to_json()

    def to_dict(self) -> dict[str, Any]:
        """The same as dictionaries and lists."""
        values: dict[str, Any] = json.loads(self.to_json())
        return values

    def to_latex(self) -> str:
        """The equations as an ``align*`` environment."""
        return self.export("latex")

    def to_sympy(self) -> dict[Any, Any]:
        """Right-hand sides as SymPy expressions, by state symbol."""
        from .symbolic import to_sympy

        return to_sympy(self)

    def export(self, format: str) -> str:
        """The model as source text of another program: c, cpp, latex, matlab, modelica, ...

        Raises
        ------
        ConfigError
            No such format.
        ModelError
            The format has no way to write the model.
        """
        return self._system.export(format)

    def equations(self, digits: int | None = None) -> str:
        """Equations for people, one a line, with so many digits or all."""
        return self._system.equations(digits)

    def _evaluator(self) -> _lacuna.Evaluator:
        if self._compiled is None:
            self._compiled = self._system.compile()
        return self._compiled

    def _points(self, t: ArrayLike, x: ArrayLike, u: ArrayLike | None) -> tuple[Any, Any, Any]:
        import numpy as np

        states = np.atleast_2d(np.asarray(in_order(x, self.states), dtype=np.float64))
        times = np.atleast_1d(np.asarray(t, dtype=np.float64))
        check_inputs(self, u, "u")
        if u is None:
            return times, states, np.zeros((len(states), 0))
        inputs = np.asarray(in_order(u, self.inputs), dtype=np.float64)
        if len(self.inputs) == 1 and inputs.shape == (len(states),):
            inputs = inputs.reshape(-1, 1)
        if inputs.ndim < 2:
            inputs = np.broadcast_to(np.atleast_1d(inputs), (len(states), inputs.size))
        return times, states, inputs

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Model) and self.to_json() == other.to_json()

    def __hash__(self) -> int:
        return hash(self.to_json())

    def __reduce__(self) -> tuple[Callable[[str], Model], tuple[str]]:
        return Model.from_json, (self.to_json(),)

    def __str__(self) -> str:
        return self.equations(6)

    def __repr__(self) -> str:
        return f"<lacuna.Model\n{self}>"

    def _repr_latex_(self) -> str:
        text = self.to_latex()
        rows = [line for line in text.splitlines() if not line.lstrip().startswith("%")]
        return "\n".join(rows)
