# SPDX-License-Identifier: MIT
"""Benches that were written after the diagnosis had been changed, and changed nothing in it."""

import numpy as np
from benches import BEYOND, Bench, bench, noisy, on_lattice, simulate, steps, switch


@bench("untouched", lacks=("v:quadratic-term", "v:quadratic-drag"))
def rotor_thrust(rng):
    """The thrust grows with the square of the speed of a rotor."""
    time = np.arange(2500) * 0.02
    speed = steps(rng, 2500, 60, 110, 40, 150)
    x = simulate(lambda t, x, u: 1.2e-3 * u**2 - 9 - 0.4 * x, [0], time, speed)[:, 0]
    model = (
        "time s\ninput n [1/s] hold zero\nparam k = 0.2\nparam c = 0.5\ndv/dt = k*n - 17 - c*v\n"
    )
    return Bench(time, {"v [m/s]": noisy(rng, x, 0.5)}, {"n [1/s]": speed}, model)


@bench("untouched", lacks=("T:cross-term",))
def heater_resistance(rng):
    """The resistance of the heater rises with its temperature, the voltage is held."""
    time = np.arange(2400) * 5.0
    power = steps(rng, 2400, 0, 200, 40, 200)
    x = simulate(lambda t, x, u: 2e-3 * u * (1 - 2e-3 * x) - 2e-3 * (x - 20), [20], time, power, 4)
    model = (
        "time s\ninput P [W] hold zero\nparam a = 1.7e-3\nparam b = 2.3e-3\n"
        "dT/dt = a*P - b*(T-20)\n"
    )
    return Bench(time, {"T [degC]": noisy(rng, x[:, 0], 0.2)}, {"P [W]": power}, model)


SWING = """time s
param w2 = 22
param c = 0.1
dth/dt = w
dw/dt = -w2*sin(th) - c*w
"""


@bench("untouched", lacks=("w:coulomb-friction",))
def pendulum_dry(rng):
    """Swings out, its angle on a lattice of an encoder."""
    time = np.arange(3000) * 0.01
    x = simulate(
        lambda t, x, u: np.array(
            [x[1], -20 * np.sin(x[0]) - 0.05 * x[1] - 0.4 * switch(x[1], 0.01)]
        ),
        [2.6, 0],
        time,
    )
    return Bench(time, {"th [rad]": on_lattice(x[:, 0], 2 * np.pi / 2048)}, {}, SWING)


@bench("untouched")
def pendulum_complete(rng):
    time = np.arange(3000) * 0.01
    x = simulate(
        lambda t, x, u: np.array([x[1], -20 * np.sin(x[0]) - 0.15 * x[1]]), [2.6, 0], time
    )
    return Bench(time, {"th [rad]": on_lattice(x[:, 0], 2 * np.pi / 2048)}, {}, SWING)


@bench("untouched", lacks=("N:exponential-rate", "N:cross-term"))
def growth_warm(rng):
    """A culture whose growth doubles every 8 degrees."""
    time = np.arange(1500) * 0.05
    warmth = steps(rng, 1500, 15, 35, 30, 120)

    def rates(t, x, u):
        return 0.4 * 2 ** ((u - 25) / 8) * x * (1 - x / 5) - 0.3 * x

    x = simulate(rates, [1], time, warmth)[:, 0]
    model = (
        "time h\ninput T [degC] hold zero\nparam r = 0.5\nparam q = 0.1\nparam d = 0.3\n"
        "dN/dt = r*N - q*N^2 - d*N\n"
    )
    return Bench(time, {"N [g/l]": noisy(rng, x, 1)}, {"T [degC]": warmth}, model)


@bench("untouched", lacks=("q:backlash", "q:hysteresis"))
def valve_play(rng):
    """The stem has a play of 0.8 V."""
    time = np.arange(3000) * 0.02
    volts = np.cumsum(steps(rng, 3000, -0.15, 0.15, 10, 60))
    volts = volts - np.linspace(0, volts[-1], 3000)
    stem = np.zeros(3000)
    for at in range(1, 3000):
        stem[at] = np.clip(stem[at - 1], volts[at] - 0.4, volts[at] + 0.4)
    x = simulate(lambda t, x, u: 3 * u - 2 * x, [0], time, stem)[:, 0]
    model = "time s\ninput u [V] hold zero\nparam a = 2.5\nparam b = 2.3\ndq/dt = a*u - b*q\n"
    return Bench(time, {"q [l/s]": noisy(rng, x, 0.5)}, {"u [V]": volts}, model)


@bench("untouched", lacks=("T:delay",))
def pipe(rng):
    """Water from the boiler needs 37 s to the tank."""
    time = np.arange(2500) * 2.0
    inlet = steps(rng, 2500, 30, 70, 40, 150)
    late = np.concatenate([np.full(18, inlet[0]), inlet[:-18]])
    half = np.concatenate([np.full(19, inlet[0]), inlet[:-19]])
    x = simulate(lambda t, x, u: 5e-3 * (u - x), [inlet[0]], time, 0.5 * (late + half), 4)[:, 0]
    model = "time s\ninput Tin [degC] hold zero\nparam k = 4e-3\ndT/dt = k*(Tin - T)\n"
    return Bench(time, {"T [degC]": noisy(rng, x, 0.3)}, {"Tin [degC]": inlet}, model)


@bench("untouched", also=("w:channel-skew",))
def speed_from_counts(rng):
    """The speed is the difference of counts in a step, and late by half of it."""
    time = np.arange(4000) * 0.01
    volts = steps(rng, 4000, -6, 6, 20, 120)
    x = simulate(lambda t, x, u: np.array([8 * u - 2 * x[0], x[0]]), [0, 0], time, volts)
    counts = np.round(x[:, 1] * 1000 / (2 * np.pi))
    speed = np.concatenate([[0], np.diff(counts)]) * 2 * np.pi / 1000 / 0.01
    model = "time s\ninput u [V] hold zero\nparam a = 7\nparam b = 2.4\ndw/dt = a*u - b*w\n"
    return Bench(time, {"w [rad/s]": speed}, {"u [V]": volts}, model)


@bench(
    "untouched",
    lacks=("v:cubic-stiffness", "v:coulomb-friction"),
    also=("v:cubic-stiffness", "v:coulomb-friction"),
)
def mass_cubic_and_dry(rng):
    time = np.arange(4000) * 0.005
    push = steps(rng, 4000, -20, 20, 30, 100)

    def rates(t, x, u):
        return np.array(
            [x[1], -100 * x[0] - 1500 * x[0] ** 3 - x[1] - 2 * switch(x[1], 0.01) + u]
        )

    x = simulate(rates, [0, 0], time, push)
    model = (
        "time s\ninput F [N] hold zero\nparam k = 120\nparam c = 1.2\n"
        "dx/dt = v\ndv/dt = -k*x - c*v + F\n"
    )
    return Bench(time, {"x [m]": noisy(rng, x[:, 0], 0.3)}, {"F [N]": push}, model)


@bench("untouched", lacks=("y:saturating-rate", "x:saturating-rate"))
def predation_sated(rng):
    time = np.arange(900) * 0.1

    def rates(t, x, u):
        eaten = 0.04 * x[0] * x[1] / (1 + 0.015 * x[0])
        return np.array([x[0] * (1 - x[0] / 150) - eaten, 0.4 * eaten - 0.45 * x[1]])

    x = simulate(rates, [60, 15], time)
    model = (
        "time d\nparam a = 0.9\nparam q = 0.007\nparam b = 0.025\nparam c = 0.4\nparam d = 0.01\n"
        "dx/dt = a*x - q*x^2 - b*x*y\ndy/dt = d*x*y - c*y\n"
    )
    channels = {"x [1]": noisy(rng, x[:, 0], 1), "y [1]": noisy(rng, x[:, 1], 1)}
    return Bench(time, channels, {}, model)


@bench("untouched", lacks=("w:change",))
def motor_load_put_on(rng):
    """In the middle of the record a flywheel is put on."""
    time = np.arange(3000) * 0.01
    volts = steps(rng, 3000, -6, 6, 20, 120)

    def rates(t, x, u):
        return (8 * u - 2 * x) / (1 if t < 9 else 1.6)

    x = simulate(rates, [0], time, volts)[:, 0]
    model = "time s\ninput u [V] hold zero\nparam a = 7\nparam b = 2.4\ndw/dt = a*u - b*w\n"
    return Bench(time, {"w [rad/s]": noisy(rng, x, 0.5)}, {"u [V]": volts}, model)


@bench("untouched", lacks=("h:extra-state", "h:lag"))
def tanks_in_series(rng):
    """The model knows the lower tank only."""
    time = np.arange(2400) * 2.0
    pump = steps(rng, 2400, 2, 8, 40, 200)
    x = simulate(
        lambda t, x, u: np.array([0.1 * u - 0.02 * x[0], 0.02 * x[0] - 0.012 * x[1]]),
        [25, 40],
        time,
        pump,
        4,
    )
    model = "time s\ninput u [V] hold zero\nparam k = 0.08\nparam a = 0.01\ndh/dt = k*u - a*h\n"
    return Bench(time, {"h [cm]": noisy(rng, x[:, 1], 0.3)}, {"u [V]": pump}, model)


@bench("untouched", lacks=("v:unmeasured-input",))
def car_on_hills(rng):
    time = np.arange(2400) * 0.25
    push = steps(rng, 2400, 0.3, 1.5, 40, 160)
    slope = np.convolve(rng.normal(size=2520), np.hanning(120) / 8, "valid")[:2400] * 0.3

    def rates(t, x, u):
        return u - 0.05 * x + slope[min(int(t / 0.25), 2399)]

    x = simulate(rates, [15], time, push)[:, 0]
    model = "time s\ninput a [m/s^2] hold zero\nparam r = 0.06\ndv/dt = a - r*v\n"
    return Bench(time, {"v [m/s]": noisy(rng, x, 0.3)}, {"a [m/s^2]": push}, model)


@bench("untouched")
def filter_with_gaps(rng):
    """A tenth of the rows are missing, in stretches."""
    time = np.arange(3000) * 0.1
    source = steps(rng, 3000, -1, 2, 10, 80)
    x = simulate(lambda t, x, u: (u - x) / 2, [0], time, source)[:, 0]
    shown = noisy(rng, x, 0.3)
    for begin in (300, 900, 1500, 2100, 2700):
        shown[begin : begin + 60] = np.nan
    model = "time ms\ninput u [V] hold zero\nparam tau = 2.2\ndV/dt = (u - V)/tau\n"
    return Bench(time, {"V [V]": shown}, {"u [V]": source}, model)
