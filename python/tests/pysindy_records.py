"""Records of the tasks of PySINDy, and the estimator that they are put to."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

import lacuna
from lacuna.sklearn import ODERegressor

Array = np.ndarray
Task = Callable[[], None]


class Tasks(dict[str, Task]):
    """Tasks by the name of the test whose task it is."""

    def __call__(self, name: str) -> Callable[[Task], Task]:
        """Enter the function that follows under this name."""

        def enter(function: Task) -> Task:
            assert name not in self, name
            self[name] = function
            return function

        return enter


def sindy(**options: Any) -> ODERegressor:
    """Thresholded least squares on monomials up to degree 2."""
    usual: dict[str, Any] = {"preset": "sindy", "degree": 2, "threads": 1}
    return ODERegressor(**{**usual, **options})


def line() -> tuple[Array, Array]:
    """One state that grows steadily: x = 2 t."""
    t = np.linspace(0, 5, 100)
    return 2 * t[:, None], t


def lorenz(start: tuple[float, ...] = (8, 27, -7), n: int = 500) -> tuple[Array, Array]:
    t = np.linspace(0, 5, n)
    return lacuna.simulate("lorenz", start, t).x, t


def three_lorenz() -> tuple[list[Array], list[Array]]:
    runs = [lorenz((8, 27, -7), 300), lorenz((-11, 22, 25), 400), lorenz((-4, -9, 12), 500)]
    return [x for x, _ in runs], [t for _, t in runs]


def forced_lorenz(inputs: int = 1) -> tuple[Array, Array, Array, Callable[[float], Array]]:
    def u(time: float) -> Array:
        return np.array([np.sin(2 * time), np.cos(0.7 * time)])[:inputs]

    names = ["u0", "u1"][:inputs]
    text = "".join(f"input {name} hold smooth\n" for name in names) + (
        f"dx/dt = 10*(y-x) + 5*u0\ndy/dt = x*(28-z) - y {'+ 3*u1' if inputs > 1 else ''}\n"
        "dz/dt = x*y - 8/3*z\n"
    )
    t = np.linspace(0, 5, 1000)
    samples = np.array([u(time) for time in t])
    record = lacuna.Records({"t": t, **dict(zip(names, samples.T, strict=True))}, "t")
    x = lacuna.simulate(lacuna.Model.from_text(text), [8, 27, -7], t, inputs=record).x
    return x, t, samples, u


def logistic(mu: float = 3.6, n: int = 100) -> Array:
    x = [0.5]
    while len(x) < n:
        x.append(mu * x[-1] * (1 - x[-1]))
    return np.array(x)[:, None]


def forced_logistic() -> tuple[Array, Array]:
    u = 0.1 * np.random.default_rng(1).random(100)
    x = [0.5]
    while len(x) < 100:
        x.append(3.4 * x[-1] * (1 - x[-1]) + u[len(x) - 1])
    return np.array(x)[:, None], u
