# SPDX-License-Identifier: MIT
"""Records in which a number of the model changes at an instant: a gain that falls, a leak or a
load that begins, a loss that grows. The list was written down before any was diagnosed; cases
that are `kept` are not looked at while the program is changed.

A case is judged by the instant: within the interval of the answer (95 %) and within 0.1 s or half
a step of the truth; of a null, in which nothing changes, nothing may be named.
"""

import dataclasses

import numpy as np

SUBSTEPS = 10


@dataclasses.dataclass(frozen=True)
class System:
    """dx/dt in numbers p, states x and an input u that is held between samples."""

    states: tuple
    rates: str  # of the .ode file, with {a}, {b}, {c} for numbers that may change
    numbers: dict
    step: float
    count: int
    level: float  # mean and swing of the input
    swing: float
    start: tuple

    def rate(self, x, u, p):
        values = dict(zip(self.states, x)) | p | {"u": u, "sin": np.sin}
        return np.array([eval(self.formulas[s], {"__builtins__": {}}, values) for s in self.states])

    @property
    def formulas(self):
        lines = (line.split(" = ") for line in self.rates.strip().splitlines())
        return {left.strip()[1:-3]: right.strip() for left, right in lines}


SYSTEMS = {
    "vessel": System(("h",), "dh/dt = a*u - b*h - c", {"a": 0.1, "b": 0.02, "c": 0.03},
                     1.0, 900, 4.0, 2.0, (12.0,)),
    "heater": System(("T",), "dT/dt = a*u - b*T + c", {"a": 0.06, "b": 0.025, "c": 0.5},
                     2.0, 800, 20.0, 12.0, (40.0,)),
    "motor": System(("w",), "dw/dt = a*u - b*w - c", {"a": 60.0, "b": 3.0, "c": 12.0},
                    0.02, 1500, 6.0, 3.0, (90.0,)),
    "arm": System(("q", "w"), "dq/dt = w\ndw/dt = a*u - b*w - c*sin(q)",
                  {"a": 8.0, "b": 0.8, "c": 14.0}, 0.02, 1500, 0.0, 1.0, (0.2, 0.0)),
    "stage": System(("x", "v"), "dx/dt = v\ndv/dt = a*u - b*v - c*x",
                    {"a": 2.0, "b": 1.2, "c": 30.0}, 0.02, 1500, 0.0, 5.0, (0.1, 0.0)),
}


@dataclasses.dataclass(frozen=True)
class Jump:
    system: str
    number: str  # which changes; "" for a null
    factor: float
    noise: float  # of the standard deviation of a channel
    seed: int
    second: bool  # whether a second record, with the same instant, chooses nothing
    kept: bool

    @property
    def name(self):
        return f"{self.system}_{self.number or 'null'}_{self.seed}"


def all_jumps():
    jumps, k = [], 0
    for _ in range(4):
        for system in SYSTEMS:
            for number in ("a", "b", "c"):
                rng = np.random.default_rng(9500 + k)
                factor = rng.choice((rng.uniform(0.4, 0.8), rng.uniform(1.25, 1.8)))
                noise = float(rng.choice((0.005, 0.02)))
                jumps.append(Jump(system, number, factor, noise, 9500 + k, k % 2 == 1, k % 3 == 2))
                k += 1
    for _ in range(20):
        for system in SYSTEMS:
            noise = (0.005, 0.02)[k % 2]
            jumps.append(Jump(system, "", 1.0, noise, 9500 + k, k % 4 > 1, k % 3 == 2))
            k += 1
    return jumps


JUMPS = all_jumps()


def instant_of(jump):
    system = SYSTEMS[jump.system]
    share = np.random.default_rng([jump.seed, 7]).uniform(0.15, 0.65)
    return system.step * (system.count - 1) * share


def record_of(jump, number):
    """t, the input, measured states."""
    system = SYSTEMS[jump.system]
    rng = np.random.default_rng([jump.seed, number])
    held = int(rng.integers(15, 50))
    levels = system.level + system.swing * rng.uniform(-1, 1, system.count // held + 1)
    u = np.repeat(levels, held)[: system.count]
    before = dict(system.numbers)
    after = before | ({jump.number: before[jump.number] * jump.factor} if jump.number else {})
    at, h = instant_of(jump), system.step / SUBSTEPS
    x, states = np.array(system.start), np.empty((system.count, len(system.states)))
    for k in range(system.count):
        states[k] = x
        for i in range(SUBSTEPS):
            p = before if system.step * k + h * (i + 0.5) < at else after
            first = system.rate(x, u[k], p)
            x = x + h * system.rate(x + 0.5 * h * first, u[k], p)
    noise = jump.noise * states.std(axis=0)
    measured = states + noise * rng.standard_normal(states.shape)
    return system.step * np.arange(system.count), u, measured


def nominal_of(jump):
    system = SYSTEMS[jump.system]
    text = "time s\ninput u hold zero\n" + "".join(f"state {s}\n" for s in system.states)
    rates = system.rates
    for name, value in system.numbers.items():
        for place in (f" {name}*", f" {name}\n"):
            rates = (rates + "\n").replace(place, place.replace(name, f"{value:g}")).rstrip("\n")
    return text + rates + "\n"
