# SPDX-License-Identifier: MIT
"""Plants with held, delayed inputs, integrated by Runge-Kutta of order 4; numbers or arrays.

Coefficients, states and inputs may be numbers, or arrays with one entry for each of several
plants that are run at once.
"""

import dataclasses

import numpy as np

SUBSTEPS = 10  # of a sample; dead times are multiples of a tenth of one


def root(x):
    """sqrt(x), 0 below 0."""
    return (0.5 * (x + abs(x))) ** 0.5


def rates_of(shape):
    """rates(c, x, u): derivatives of the states of a shape; c has the coefficients by term.

    Dry friction is left out here: see `advance`.
    """
    rows = []
    for state in shape.states:
        if state in shape.chain:
            rows.append(shape.chain[state])
            continue
        parts = [
            f"c[{(state, term)!r}]*({term.replace('^', '**').replace('sqrt', 'root')})"
            for term in shape.equations[state]
            if not term.startswith("sign(")
        ]
        rows.append(" + ".join(parts))
    names = ", ".join(shape.states), ", ".join(shape.inputs)
    source = f"def rates(c, x, u):\n    ({names[0]},) = x\n    ({names[1]},) = u\n"
    source += f"    return ({', '.join(rows)},)\n"
    scope = {"root": root, "sin": np.sin, "abs": abs}
    exec(source, scope)
    return scope["rates"]


def runge_kutta(rates, x, h):
    k1 = rates(0.0, x)
    k2 = rates(h / 2, tuple(a + h / 2 * b for a, b in zip(x, k1)))
    k3 = rates(h / 2, tuple(a + h / 2 * b for a, b in zip(x, k2)))
    k4 = rates(h, tuple(a + h * b for a, b in zip(x, k3)))
    return tuple(
        a + h / 6 * (b1 + 2 * (b2 + b3) + b4) for a, b1, b2, b3, b4 in zip(x, k1, k2, k3, k4)
    )


def slide(rates, friction, x, h):
    """One step against friction, which holds the second state, a speed, at 0 if it can.

    Also gives the direction of the motion, 0 where it is held.
    """
    pull = rates(0.0, x)[1]
    starts = np.sign(pull) * (abs(pull) > friction)
    direction = np.where(x[1] != 0, np.sign(x[1]), starts)

    def slowed(t, state):
        derivative = rates(t, state)
        return (derivative[0], derivative[1] - friction * direction, *derivative[2:])

    new = runge_kutta(slowed, x, h)
    held = direction == 0
    return (np.where(held, x[0], new[0]), np.where(held, 0.0, new[1]), *new[2:]), direction


def advance(rates, friction, x, h):
    """One step; with friction (None: without) it ends where the speed does, and goes on there."""
    if friction is None:
        return runge_kutta(rates, x, h)
    new, direction = slide(rates, friction, x, h)
    turns = new[1] * direction < 0
    if not np.any(turns):
        return new
    part = np.where(turns, x[1] / np.where(turns, x[1] - new[1], 1.0), 1.0)
    stop, _ = slide(rates, friction, x, part * h)
    stop = (stop[0], np.where(turns, 0.0, stop[1]), *stop[2:])
    after, _ = slide(rates, friction, stop, (1 - part) * h)
    return tuple(np.where(turns, late, early) for late, early in zip(after, new))


class Held:
    """Inputs that a control gives at each sample, and that act later."""

    def __init__(self, control, delays):
        self.control = control
        self.parts = [round(SUBSTEPS * delay) for delay in delays]
        self.recorded = []
        self.act = lambda u: u

    def sample(self, k, measured):
        self.recorded.append(self.control(k, measured))

    def at(self, k, part):
        """What acts in a part of the sample k."""
        return tuple(
            self.act(float(self.recorded[max(0, (k * SUBSTEPS + part - late) // SUBSTEPS)][n]))
            for n, late in enumerate(self.parts)
        )


def friction_of(shape, c):
    """The size of the dry friction of a shape, None without."""
    for state, terms in shape.equations.items():
        for term in terms:
            if term.startswith("sign("):
                return abs(c[(state, term)])
    return None


@dataclasses.dataclass
class Motion:
    """What `simulate` needs of a plant; push(t, x) is added to the last derivative."""

    rates: object
    coefficients: dict
    shape: object
    step: float
    lattice: dict
    push: object = None

    def under(self, u, begin):
        """rates(t, x) from an instant on, while the inputs stay."""
        place = len(self.shape.chain)

        def total(t, state):
            derivative = self.rates(self.coefficients, state, u)
            if self.push is None:
                return derivative
            row = list(derivative)
            row[place] = row[place] + self.push(begin + t, state)
            return tuple(row)

        return total


def simulate(motion, start, held, count):
    """The states at each sample; the control sees the first channel on its lattice."""
    h = motion.step / SUBSTEPS
    friction = friction_of(motion.shape, motion.coefficients)
    lattice = motion.lattice[motion.shape.states[0]]
    x, rows = tuple(float(value) for value in start), []
    for k in range(count):
        rows.append(x)
        held.sample(k, round(float(x[0]) / lattice) * lattice)
        for part in range(SUBSTEPS):
            total = motion.under(held.at(k, part), k * motion.step + part * h)
            x = advance(total, friction, x, h)
    return np.array(rows, float)
